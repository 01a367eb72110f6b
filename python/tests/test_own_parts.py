# SPDX-License-Identifier: Apache-2.0
"""Scores, cues, samplers and detectors written in Python."""

import gc
import weakref

import numpy as np
import pytest

import ridgeline

RANGES = {"east_m": 3, "north_m": 3, "heading_deg": 4, "pitch_deg": 0, "roll_deg": 0}


def lengths(batch):
    """Length of the visible edges of every pose [px]."""
    segments, pose, _ = batch.segments()
    length = np.hypot(*(segments[:, 2:] - segments[:, :2]).T.astype(np.float64))
    return np.bincount(pose, weights=length, minlength=len(batch))


def test_an_own_score_is_called_with_batches_and_used_everywhere(localizer, query, grid, dataset_path):
    sizes = []

    def score(batch):
        sizes.append(len(batch))
        assert batch.rotations.shape == (len(batch), 3, 3)
        return lengths(batch) / 1000.0

    name = ridgeline.register_score(score, name="edge_length")
    assert name in ridgeline.scores()
    picture = ridgeline.Picture(localizer, query.image, query.camera)
    log_ratios = picture.score(name).log_ratios(grid)
    assert sizes == [9] * 25  # 25 places, 9 headings each
    scene = localizer.scene
    edges = scene.visible_edges(grid[4], picture.camera)["image"]
    expected = np.hypot(*(edges[:, 2:] - edges[:, :2]).T).sum() / 1000.0
    assert log_ratios[4] == pytest.approx(expected, rel=1e-3)
    own = ridgeline.Localizer(localizer.world, {"score.name": name})
    assert own.localize(query.image, query.camera, query.prior, ranges=RANGES).map is not None
    study = ridgeline.study(dataset_path, [name], queries=[query.id], perturb="2,2,0,4", classes=[5])
    assert study[0]["score"] == name
    result = ridgeline.bench(dataset_path, perturb="2,2,0,4", options={"score.name": name})
    assert len(result) == 3


def test_the_same_by_our_own_words_gives_the_same_map(localizer, query):
    """line_energy written in Python agrees with the library's."""
    built_in = ridgeline.Picture(localizer, query.image, query.camera).score("line_energy")
    options = ridgeline.Options()["score.line_energy"]

    def prepare(picture):
        lines = picture.lines[:, :4].astype(np.float64)
        return lines, picture.camera.width, options

    def line_energy(batch):
        lines, width, o = batch.prepared
        segments, pose, _ = batch.segments()
        return np.array([_line_energy(segments[pose == i], lines, width, o) for i in range(len(batch))])

    ridgeline.register_score(line_energy, name="own_line_energy", prepare=prepare, returns="energy")
    own = ridgeline.Picture(localizer, query.image, query.camera).score("own_line_energy")
    ours, theirs = (s.map(query.truth, RANGES).energies for s in (own, built_in))
    np.testing.assert_allclose(ours, theirs, atol=5e-3)


def _line_energy(model, picture, width, options):
    if len(model) == 0:
        return 1.0
    m = model.astype(np.float64)
    along = picture[:, 2:] - picture[:, :2]
    angle = np.arctan2(along[:, 1], along[:, 0])
    model_along = m[:, 2:] - m[:, :2]
    model_angle = np.arctan2(model_along[:, 1], model_along[:, 0])
    difference = np.abs((model_angle[:, None] - angle[None] + np.pi / 2) % np.pi - np.pi / 2)
    normal = np.stack([-model_along[:, 1], model_along[:, 0]], -1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    middle = 0.5 * (picture[:, :2] + picture[:, 2:])
    distance = np.abs(np.einsum("ij,ikj->ik", normal, middle[None] - m[:, None, :2]))
    tau_d = options["max_distance_width"] * width
    fits = (difference <= np.radians(options["max_angle_deg"])) & (distance <= tau_d)
    share = np.where(fits, 1.0 - distance / tau_d, 0.0)
    count = fits.sum(1)
    return 1.0 - np.mean(np.where(count > 0, share.sum(1) / np.maximum(count, 1), 0.0))


def test_an_own_cue_is_one_of_the_evidence(localizer, query, grid):
    ridgeline.register_cue(lambda batch: 0.5 * lengths(batch) / 1000.0, name="own_cue", weight=2.0)
    options = ridgeline.Options()
    assert options["score.weights.own_cue"] == 2.0
    with_cue = ridgeline.Localizer(localizer.world, options)
    score = ridgeline.Picture(with_cue, query.image, query.camera).score()
    assert score.cue_names[-1] == "own_cue"
    cues = score.cues(grid)
    weights = options["score.weights"]
    total = cues.astype(np.float64) @ [weights[name] for name in score.cue_names]
    np.testing.assert_allclose(score.log_ratios(grid), total, rtol=1e-9, atol=1e-9)
    assert (cues[:, -1] > 0).all()
    found = with_cue.localize(query.image, query.camera, query.prior, ranges=RANGES)
    assert found.status
    ridgeline.register_cue(lambda batch: np.zeros(len(batch)), name="own_cue", weight=0.0)


def test_an_own_sampler(localizer, query):
    class Walk:
        """Halton points, to be seen in the search's evaluations."""

        made = []

        def __init__(self, names, periodic, seed, start):
            self.names, self.seen = names, []
            Walk.made.append(self)

        def propose(self, number):
            def radical_inverse(i, base):
                value, digit = 0.0, 1.0
                while i:
                    digit /= base
                    value += digit * (i % base)
                    i //= base
                return value

            return np.array([radical_inverse(number + 1, b) for b in (2, 3, 5, 7, 11, 13)[: len(self.names)]])

        def observe(self, number, point, energy, state):
            self.seen.append((number, energy, state))

    ridgeline.register_sampler(Walk, name="walk")
    assert "walk" in ridgeline.samplers()
    own = ridgeline.Localizer(
        localizer.world,
        {"search.method": "sampler", "search.sampler.name": "walk", "search.evaluations": 30},
    )
    found = own.localize(query.image, query.camera, query.prior, ranges=RANGES)
    assert found.status
    walk = Walk.made[-1]
    assert walk.names == ["east_m", "north_m", "heading_deg"]
    assert len(walk.seen) == 30 and walk.seen[0][2] == "complete"
    sampler = ridgeline.Sampler("walk", [("x", 0.0, 10.0), ("fixed", 2.0, 2.0)])
    trial = sampler.ask()[0]
    assert sampler.params(trial) == {"x": 5.0, "fixed": 2.0}


def test_an_own_detector(localizer, query):
    seen = []

    def border(gray):
        seen.append((gray.shape, gray.dtype))
        height, width = gray.shape
        return np.array([[10.5, 5.5, width - 10.5, 5.5], [20.5, 9.5, 20.5, height - 9.5],
                         [1.5, 1.5, 3.5, 1.5]])

    ridgeline.register_detector(border)
    lines = ridgeline.detect_lines(query.image, "border")
    assert seen == [((480, 640), np.uint8)]
    assert len(lines) == 2  # short ones are left out, as for all detectors
    ends = {tuple(sorted((tuple(line[:2]), tuple(line[2:4])))) for line in lines.tolist()}
    assert ((10.5, 5.5), (629.5, 5.5)) in ends
    own = ridgeline.Localizer(localizer.world, {"lines.detector": "border"})
    assert own.localize(query.image, query.camera, query.prior).status == "too_few_lines"


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize(
    "result, error, words",
    [
        (lambda batch: 1 / 0, ZeroDivisionError, "division"),
        (lambda batch: np.zeros(len(batch) + 1), ridgeline.InputError, r"bad_score.*a result \("),
        (lambda batch: np.full(len(batch), np.nan), ridgeline.InputError, "nan in a result"),
        (lambda batch: "text", ridgeline.InputError, "bad_score"),
        (lambda batch: np.zeros(len(batch), np.int32), ridgeline.InputError, "int32"),
    ],
)
def test_what_a_callback_raises_arrives(localizer, query, grid, threads, result, error, words):
    ridgeline.register_score(result, name="bad_score")
    score = ridgeline.Picture(localizer, query.image, query.camera).score("bad_score")
    with pytest.raises(error, match=words):
        score.energies(grid, threads=threads)
    for method in ("map", "sampler"):  # a sampler's search counts other failures as failed trials
        own = ridgeline.Localizer(
            localizer.world, {"score.name": "bad_score", "search.method": method}
        )
        with pytest.raises(error, match=words):
            own.localize(query.image, query.camera, query.prior, ranges=RANGES, threads=threads)


def test_other_callbacks_that_fail(localizer, query):
    def fail(*arguments, **named):
        raise LookupError("mine")

    ridgeline.register_detector(fail, name="failing")
    with pytest.raises(LookupError, match="mine"):
        ridgeline.detect_lines(query.image, "failing")
    ridgeline.register_sampler(fail, name="failing")
    with pytest.raises(LookupError, match="mine"):
        ridgeline.Sampler("failing", [("x", 0.0, 1.0)])
    ridgeline.register_score(lambda batch: np.zeros(len(batch)), name="failing", prepare=fail)
    with pytest.raises(LookupError, match="mine"):
        ridgeline.Picture(localizer, query.image, query.camera).score("failing")
    ridgeline.register_score(lambda batch: np.full(len(batch), 1.5), name="failing", returns="energy")
    with pytest.raises(ridgeline.InputError, match=r"energies in \[0, 1\]"):
        ridgeline.Picture(localizer, query.image, query.camera).score("failing").map(query.truth, RANGES)


def test_names_that_are_taken_or_none(localizer):
    for register, taken in (
        (ridgeline.register_score, "evidence"),
        (ridgeline.register_cue, "sky"),
        (ridgeline.register_sampler, "tpe"),
        (ridgeline.register_detector, "lsd"),
        (ridgeline.register_detector, "file"),
    ):
        with pytest.raises(ridgeline.InputError, match="a name of its own"):
            register(lambda *a: None, name=taken)
        with pytest.raises(ridgeline.InputError, match="letters, digits"):
            register(lambda *a: None)  # "<lambda>"
        with pytest.raises(ridgeline.InputError, match="a function"):
            register(5, name="five")


def test_a_batch_is_lent_for_one_call(localizer, query, grid):
    kept = []

    def keep(batch):
        kept.append((batch, batch.quats_xyzw))
        return np.zeros(len(batch))

    ridgeline.register_score(keep, name="keeper")
    ridgeline.Picture(localizer, query.image, query.camera).score("keeper").energies(grid)
    batch, quats = kept[0]
    with pytest.raises(ridgeline.InputError, match="after its call"):
        batch.segments()
    np.testing.assert_allclose(np.linalg.norm(quats, axis=1), 1.0)


def test_what_is_registered_anew_lets_the_old_go():
    class Score:
        def __call__(self, batch):
            return np.zeros(len(batch))

    first = Score()
    gone = weakref.ref(first)
    ridgeline.register_score(first, name="replaced")
    del first
    ridgeline.register_score(Score(), name="replaced")
    gc.collect()
    assert gone() is None
