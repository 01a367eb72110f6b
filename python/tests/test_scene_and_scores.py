# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import ridgeline

BUILT_IN_SCORES = ridgeline.scores()  # before other tests register theirs


def test_world_arrays_fit_together(world):
    assert world.vertices.shape[1] == 3 and world.triangles.max() < len(world.vertices)
    assert world.triangle_surfaces.max() < len(world.surfaces["class"])
    assert world.surfaces["building"].max() < len(world.building_ids)
    np.testing.assert_allclose(np.linalg.norm(world.surfaces["normal"], axis=1), 1.0, atol=1e-4)
    triangle = world.vertices[world.triangles[0]]
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    outward = world.surfaces["normal"][world.triangle_surfaces[0]]
    np.testing.assert_allclose(normal / np.linalg.norm(normal), outward, atol=1e-3)


def test_terrain_array_and_heights_agree(world):
    east, north = world.terrain_axes
    rows, columns = world.terrain.shape
    assert len(east) == columns and len(north) == rows
    places = np.ascontiguousarray(np.stack([east[3:6], north[3:6]], -1))
    expected = world.terrain[[3, 4, 5], [3, 4, 5]] + world.origin[2]
    np.testing.assert_allclose(world.height_at(places), expected, atol=1e-4)
    assert np.isnan(world.height_at(np.array([[0.0, 0.0]]))).all()


def test_views_keep_the_world_alive(dataset_path):
    vertices = ridgeline.World.of_dataset(dataset_path).vertices
    assert np.isfinite(vertices).all()
    with pytest.raises(ValueError, match="read-only"):
        vertices[0] = 0.0


def test_depth_and_edges_agree(localizer, query):
    scene = localizer.scene
    buffers = scene.render(query.truth, query.camera, normals=True)
    shape = (query.camera.height, query.camera.width)
    assert buffers["depth_m"].shape == shape and buffers["depth_m"].dtype == np.float32
    assert buffers["normal"].shape == shape + (3,)
    sky = np.isinf(buffers["depth_m"])
    assert 0.05 < sky.mean() < 0.95
    np.testing.assert_array_equal(sky, buffers["surface"] == ridgeline.NO_SURFACE)
    edges = scene.visible_edges(query.truth, query.camera)
    assert len(edges["image"]) > 20
    assert {edges[name].shape[0] for name in edges} == {len(edges["image"])}
    middle = 0.5 * (edges["image"][:, :2] + edges["image"][:, 2:])
    column = np.clip(middle[:, 0].astype(int), 0, shape[1] - 1)
    row = np.clip(middle[:, 1].astype(int), 0, shape[0] - 1)
    patches = [
        buffers["depth_m"][max(0, r - 2) : r + 3, max(0, c - 2) : c + 3] for r, c in zip(row, column)
    ]
    near = [np.nanmin(p) - 0.5 <= d <= np.nanmax(p) + 0.5 for p, d in zip(patches, edges["depth_m"])]
    assert np.mean(near) > 0.9  # an edge lies on the surface that the pixels there see


def test_skyline_divides_sky_and_model(localizer, query):
    rows = localizer.scene.skyline(query.truth, query.camera)
    buffers = localizer.scene.render(query.truth, query.camera)
    sky = np.isinf(buffers["depth_m"])
    right = total = 0
    for column in range(0, query.camera.width, 8):
        row = rows[column]
        if np.isnan(row) or not 3 < row < query.camera.height - 3:
            continue
        if buffers["surface"][np.argmin(sky[:, column]), column] == ridgeline.TERRAIN_SURFACE:
            continue  # the skyline is at eye level where the terrain ends below it
        total += 1
        right += sky[int(row) - 3, column] and not sky[int(row) + 2, column]
    assert total > 20 and right > 0.8 * total
    azimuths, elevations = localizer.scene.horizon(query.truth.center)
    assert len(azimuths) == len(elevations) > 1000 and (elevations >= 0).all()


def test_energies_do_not_depend_on_order_or_threads(picture, grid):
    score = picture.score()
    energies = score.energies(grid)
    assert energies.shape == (len(grid),) and energies.dtype == np.float64
    np.testing.assert_array_equal(energies, score.energies(grid, threads=1))
    order = np.random.default_rng(1).permutation(len(grid))
    shuffled = ridgeline.Poses(
        np.ascontiguousarray(grid.quats_xyzw[order]), np.ascontiguousarray(grid.centers[order])
    )
    # the rays of a place are spread over the headings around the middle pose, whichever it is
    np.testing.assert_allclose(score.energies(shuffled), energies[order], atol=0.02)


def test_the_truth_scores_better_than_most(picture, grid, query):
    energies = picture.score().energies(grid)
    assert (energies < picture.score().energies(query.truth)[0]).mean() < 0.1


def test_evidence_is_the_weighted_sum_of_its_cues(picture, grid):
    score = picture.score()
    weights = ridgeline.Options()["score.weights"]
    cues = score.cues(grid)
    assert cues.shape == (len(grid), len(score.cue_names)) and cues.dtype == np.float32
    total = cues.astype(np.float64) @ [weights[name] for name in score.cue_names]
    np.testing.assert_allclose(score.log_ratios(grid), total, rtol=1e-9, atol=1e-9)


def test_every_score_judges(picture, grid):
    for name in BUILT_IN_SCORES:
        energies = picture.score(name).energies(grid)
        assert ((energies >= 0.0) & (energies <= 1.0)).all(), name


def test_given_lines_stand_for_detected_ones(localizer, picture, query, grid):
    given = ridgeline.Picture(localizer, query.image, query.camera, lines=picture.lines)
    assert len(given.lines) == len(picture.lines)
    np.testing.assert_allclose(
        given.score().energies(grid), picture.score().energies(grid), atol=1e-6
    )


def test_an_array_is_what_the_file_is(localizer, picture, query, grid):
    array = ridgeline.read_picture(query.image)
    of_array = ridgeline.Picture(localizer, array, query.camera)
    array[:] = 0  # the picture has its own pixels
    np.testing.assert_array_equal(
        of_array.score().energies(grid), picture.score().energies(grid)
    )


def test_detected_lines_and_skyline(query):
    lines = ridgeline.detect_lines(query.image, "lsd", {"min_length_px": 30})
    assert lines.dtype == np.float32 and lines.shape[1] == 5 and len(lines) > 5
    assert (np.hypot(*(lines[:, 2:4] - lines[:, :2]).T) >= 30).all()
    skyline = ridgeline.detect_skyline(query.image)
    assert len(skyline["x_px"]) == len(skyline["y_px"]) > 100


def test_a_map_has_its_best_near_the_truth(picture, query):
    truth = query.truth
    energy_map = picture.score().map(
        truth, {"east_m": 4, "north_m": 4, "heading_deg": 5, "pitch_deg": 0, "roll_deg": 0}
    )
    assert energy_map.energies.shape == (len(energy_map.north), len(energy_map.east))
    row, column = np.unravel_index(np.nanargmin(energy_map.energies), energy_map.energies.shape)
    best = np.array([energy_map.east[column], energy_map.north[row]])
    assert np.hypot(*(best - truth.center[:2])) < 2.5
    west, east, south, north = energy_map.extent
    assert west < energy_map.east[0] < east and south < energy_map.north[0] < north
