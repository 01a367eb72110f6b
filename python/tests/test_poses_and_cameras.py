# SPDX-License-Identifier: Apache-2.0
import types

import numpy as np
import pytest

import ridgeline


def test_a_pose_to_the_east_looks_along_east():
    pose = ridgeline.Pose.from_view_angles([100.0, 200.0, 3.0], heading_deg=90.0)
    axis = pose.matrix()[:, :3].T @ [0.0, 0.0, 1.0]
    np.testing.assert_allclose(axis, [1.0, 0.0, 0.0], atol=1e-12)


def test_matrix_is_colmaps_cam_from_world():
    pose = ridgeline.Pose.from_view_angles([691000.0, 5334000.0, 520.0], 30.0, 10.0, -5.0)
    matrix = pose.matrix()
    np.testing.assert_allclose(matrix[:, :3] @ pose.center + matrix[:, 3], 0.0, atol=1e-8)
    np.testing.assert_array_equal(matrix[:, 3], pose.translation)


def test_quaternions_are_in_the_order_x_y_z_w():
    pose = ridgeline.Pose([0.0, 0.0, 0.0, 1.0], center=[1.0, 2.0, 3.0])
    np.testing.assert_array_equal(pose.matrix()[:, :3], np.eye(3))
    half = np.sqrt(0.5)  # a quarter turn about the camera's x
    turned = ridgeline.Pose([half, 0.0, 0.0, half], center=[0.0, 0.0, 0.0])
    np.testing.assert_allclose(turned.matrix()[:, :3] @ [0, 1, 0], [0, 0, 1], atol=1e-12)


def test_center_and_translation_say_the_same():
    by_center = ridgeline.Pose.from_view_angles([10.0, 20.0, 30.0], 40.0, 5.0, 6.0)
    by_translation = ridgeline.Pose(by_center.quat_xyzw, translation=by_center.translation)
    np.testing.assert_allclose(by_translation.center, by_center.center, atol=1e-12)
    with pytest.raises(ridgeline.InputError, match="one of the two"):
        ridgeline.Pose([0.0, 0.0, 0.0, 1.0])


def test_what_looks_like_a_pycolmap_pose_or_camera_is_taken():
    rigid = types.SimpleNamespace(
        rotation=types.SimpleNamespace(quat=np.array([0.0, 0.0, 0.0, 1.0])),
        translation=np.array([-1.0, -2.0, -3.0]),
    )
    np.testing.assert_array_equal(ridgeline.Pose.of(rigid).center, [1.0, 2.0, 3.0])
    camera = types.SimpleNamespace(
        model=types.SimpleNamespace(name="SIMPLE_PINHOLE"),
        width=640,
        height=480,
        params=np.array([500.0, 320.0, 240.0]),
    )
    assert ridgeline.Camera.of(camera).params == [500.0, 320.0, 240.0]


def test_distortion_goes_there_and_back():
    camera = ridgeline.Camera("OPENCV", 640, 480, [500, 510, 320, 240, -0.1, 0.02, 1e-3, -2e-3])
    points = np.array([[0.1, -0.2, 1.0], [0.3, 0.1, 2.0]])
    px = camera.img_from_cam(points)
    np.testing.assert_allclose(
        camera.cam_from_img(px), points[:, :2] / points[:, 2:], atol=1e-9
    )
    assert np.isnan(camera.img_from_cam(np.array([[0.0, 0.0, -1.0]]))).all()


def test_poses_are_views_of_one_memory():
    angles = np.array([[10.0, 1.0, 2.0], [200.0, -3.0, 4.0]])
    poses = ridgeline.Poses.from_view_angles(np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]), angles)
    np.testing.assert_allclose(poses.angles_deg, angles, atol=1e-12)
    assert poses.centers.base is not None and not poses.centers.flags.writeable
    again = ridgeline.Poses(
        np.ascontiguousarray(poses.quats_xyzw), np.ascontiguousarray(poses.centers)
    )
    np.testing.assert_array_equal(again.quats_xyzw, poses.quats_xyzw)
    centers = poses.centers
    del poses
    np.testing.assert_array_equal(centers[1], [4.0, 5.0, 6.0])
    assert len(again) == 2 and again[-1].center[0] == 4.0


def test_error_is_that_of_the_benchmark():
    truth = ridgeline.Pose.from_view_angles([0.0, 0.0, 0.0], 0.0)
    pose = ridgeline.Pose.from_view_angles([3.0, 4.0, 12.0], 5.0)
    np.testing.assert_allclose(pose.error(truth), (13.0, 5.0, 5.0))
    np.testing.assert_allclose(ridgeline.Poses([pose]).errors(truth), [[13.0, 5.0, 5.0]])
