# SPDX-License-Identifier: Apache-2.0
"""Wrong shapes, dtypes, layouts and numbers are exceptions that say what is wrong."""

import numpy as np
import pytest

import ridgeline

QUATS = np.tile([0.0, 0.0, 0.0, 1.0], (4, 1))
CENTERS = np.zeros((4, 3))


@pytest.mark.parametrize(
    "quats, centers, words",
    [
        (QUATS[:, :3].copy(), CENTERS, r"quats_xyzw: got \(4, 3\) float64, expected \(n, 4\)"),
        (QUATS, CENTERS[:3], r"centers: got \(3, 3\) float64, expected \(4, 3\)"),
        (QUATS, CENTERS.astype(np.float32), r"centers: got \(4, 3\) float32"),
        (QUATS, CENTERS.astype(np.int64), r"centers: got \(4, 3\) int64"),
        (QUATS, np.zeros((8, 3))[::2], r"centers: got an array that is not contiguous"),
        (QUATS, np.asfortranarray(np.zeros((4, 3))), "not contiguous"),
        (QUATS, np.where(np.eye(4, 3) > 0, np.nan, 0.0), r"centers\[0, 0\]: got nan"),
        (QUATS, np.full((4, 3), np.inf), r"centers\[0, 0\]: got an infinite number"),
        (2.0 * QUATS, CENTERS, r"quats_xyzw\[0\]: got a length of 2.0"),
        ("no array", CENTERS, r"quats_xyzw: got str"),
        (QUATS, None, r"centers: got NoneType"),
    ],
)
def test_poses(quats, centers, words):
    with pytest.raises(ridgeline.InputError, match=words):
        ridgeline.Poses(quats, centers)


def test_input_error_is_a_value_error_with_file_and_field():
    with pytest.raises(ValueError) as caught:
        ridgeline.Poses(QUATS, np.full((4, 3), np.nan))
    assert isinstance(caught.value, ridgeline.InputError)
    assert caught.value.field == "centers[0, 0]"
    assert caught.value.file == ""


@pytest.mark.parametrize(
    "image, words",
    [
        (np.zeros((480, 640), np.float64), r"image: got \(480, 640\) float64"),
        (np.zeros((480, 640, 2), np.uint8), r"image: got \(480, 640, 2\) uint8"),
        (np.zeros((480, 1280, 3), np.uint8)[:, ::2], "not contiguous"),
        (np.zeros((480, 0, 3), np.uint8), r"image: got \(480, 0, 3\) uint8"),
        (np.zeros((48, 64, 3), np.uint8), r"image: got 64 x 48, expected the camera's 640 x 480"),
        (None, "image: got NoneType"),
    ],
)
def test_pictures(localizer, query, image, words):
    with pytest.raises(ridgeline.InputError, match=words):
        ridgeline.Picture(localizer, image, query.camera)


@pytest.mark.parametrize(
    "lines, words",
    [
        (np.zeros((3, 6)), r"lines: got \(3, 6\) float64"),
        (np.zeros((3, 4)), r"lines\[0\]: got a segment of length 0"),
        (np.array([[0.0, 0.0, np.nan, 9.0]]), r"lines\[0, 2\]: got nan"),
        (np.array([[0.0, 0.0, 5.0, 9.0, 0.0]]), r"lines\[0\]: got a strength of 0"),
        (np.zeros((3, 4), np.int32), r"lines: got \(3, 4\) int32"),
    ],
)
def test_lines(localizer, query, lines, words):
    with pytest.raises(ridgeline.InputError, match=words):
        ridgeline.Picture(localizer, query.image, query.camera, lines=lines)


def test_options_name_the_nearest_key():
    with pytest.raises(ridgeline.InputError, match="search.east_m"):
        ridgeline.Options({"search.eats_m": 20})
    with pytest.raises(ridgeline.InputError, match="search.east_m"):
        ridgeline.Options({"search.east_m": -1})
    with pytest.raises(ridgeline.InputError, match="weights"):
        ridgeline.Options()["score.weigths"]
    options = ridgeline.Options()
    with pytest.raises(ridgeline.InputError):
        options.update({"search.east_m": 33, "search.north_m": -1})
    assert options["search.east_m"] == 10.0  # all or none


def test_options_by_path_nested_or_both():
    for values in (
        {"score.weights.sky": 3.0},
        {"score": {"weights": {"sky": 3.0}}},
        {"score.weights": {"sky": 3.0}},
    ):
        options = ridgeline.Options(values)
        assert options["score.weights.sky"] == 3.0
        assert options["score.weights.facades"] == ridgeline.Options()["score.weights.facades"]
    with pytest.raises(ridgeline.InputError, match="skye"):
        ridgeline.Options({"score.weights": {"skye": 3.0}})


def test_the_words_are_the_programs(program, dataset_path):
    bad = "search.eats_m=20"
    said = program("localize", "--dataset", dataset_path, "--query", "street_000", "--set", bad,
                   exit_code=2).stderr
    with pytest.raises(ridgeline.InputError) as caught:
        ridgeline.Options({"search.eats_m": 20})
    assert str(caught.value) in said
    said = program("localize", "--dataset", dataset_path, "--query", "streat_000",
                   exit_code=2).stderr
    with pytest.raises(ridgeline.InputError) as caught:
        ridgeline.localize(dataset=dataset_path, query="streat_000")
    assert str(caught.value) in said


def test_files_that_are_not_there(tmp_path):
    with pytest.raises(ridgeline.InputError, match="nothing.gml"):
        ridgeline.World.load(tmp_path / "nothing.gml")
    with pytest.raises(ridgeline.InputError, match="nothing.json"):
        ridgeline.Dataset(tmp_path / "nothing.json")
    with pytest.raises(ridgeline.InputError, match="nothing.jpg"):
        ridgeline.read_picture(tmp_path / "nothing.jpg")
    with pytest.raises(ridgeline.InputError, match="nothing"):
        ridgeline.shipped_options("nothing")


def test_scores_and_names(picture, grid):
    with pytest.raises(ridgeline.InputError, match="score.name"):
        picture.score("no_score")
    with pytest.raises(ridgeline.InputError, match="unknown cue"):
        picture.score(weights={"no_cue": 1.0})
    with pytest.raises(ridgeline.InputError, match="which has cues"):
        picture.score("line_energy").cues(grid)
    with pytest.raises(ridgeline.InputError, match="poses: got ndarray|poses: got .* float64"):
        picture.score().energies(np.zeros((3, 7)))
    with pytest.raises(ridgeline.InputError, match="lines.detector"):
        ridgeline.detect_lines(np.zeros((10, 10), np.uint8), "no_detector")


def test_priors(localizer, query):
    with pytest.raises(ridgeline.InputError, match="prior.position"):
        ridgeline.Prior([1.0, np.nan])
    with pytest.raises(ridgeline.InputError, match="prior: got list"):
        localizer.localize(query.image, query.camera, [1.0, 2.0])
    with pytest.raises(ridgeline.InputError, match="search.*eest_m|eest_m"):
        localizer.localize(query.image, query.camera, query.prior, ranges={"eest_m": 1})
