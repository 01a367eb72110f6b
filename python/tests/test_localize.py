# SPDX-License-Identifier: Apache-2.0
import ctypes
import json
import os
import signal
import threading
import time

import numpy as np
import pytest

import ridgeline
from conftest import without_times


def test_from_photo_to_pose(localizer, query):
    found = localizer.localize(query.image, query.camera, query.prior)
    assert found.status in ("ok", "doubtful")
    metres, _, degrees = found.pose.error(query.truth)
    assert metres < 2.0 and degrees < 2.0
    assert found.covariance.shape == (6, 6)
    np.testing.assert_allclose(found.covariance, found.covariance.T, atol=1e-12)
    assert (np.linalg.eigvalsh(found.covariance) > -1e-12).all()
    assert 0.0 <= found.confidence <= 1.0
    pose, energy = found.modes[0]
    assert energy == found.energy and pose.error(found.pose)[0] < 1e-6
    assert found.map.energies.dtype == np.float32
    assert np.nanmin(found.map.energies) >= 0.0
    assert json.loads(found.json())["confidence"] == pytest.approx(found.confidence, abs=1e-8)


def test_the_map_keeps_its_memory(localizer, query):
    energies = localizer.localize(query.image, query.camera, query.prior).map.energies
    assert np.isfinite(energies).any()


def test_same_seed_same_result_on_any_number_of_threads(localizer, query):
    texts = {
        localizer.localize(query.image, query.camera, query.prior, threads=threads).json()
        for threads in (1, 3)
    }
    assert len(texts) == 1


def test_an_abstention_has_no_pose(localizer, query):
    grey = np.full((480, 640), 127, np.uint8)
    found = localizer.localize(grey, query.camera, query.prior)
    assert found.pose is None and found.status == "too_few_lines" and found.reason


def test_json_is_the_programs_to_the_last_bit(program, dataset_path, dataset):
    for query in dataset.queries:
        done = program("localize", "--dataset", dataset_path, "--query", query.id, "--json", "--seed", 7)
        found = ridgeline.localize(dataset=dataset_path, query=query.id, seed=7)
        assert found.json() + "\n" == done.stdout


def test_json_of_a_single_photo_is_the_programs(program, dataset, tmp_path):
    query = dataset[1]
    camera = tmp_path / "camera.json"
    camera.write_text(json.dumps({
        "model": query.camera.model, "width": query.camera.width,
        "height": query.camera.height, "params": query.camera.params}))
    prior = tmp_path / "prior.json"
    prior.write_text(json.dumps({"position": list(query.prior.position), "heading_deg": 12.5}))
    words = ["--camera", camera, "--prior", prior, "--dtm", dataset.dtm, "--crs", dataset.crs,
             "--set", "search.map.modes=5"]
    code = 0
    found = ridgeline.localize(
        query.image, dataset.model, dtm=dataset.dtm, crs=dataset.crs, camera=camera, prior=prior,
        options={"search.map.modes": 5},
    )
    code = 0 if found.pose else 3
    done = program("localize", query.image, "--model", *dataset.model, *words, "--json", exit_code=code)
    assert found.json() + "\n" == done.stdout


def test_bench_json_is_the_programs_but_for_the_clock(program, dataset_path):
    done = program("bench", dataset_path, "--perturb", "3,3,0,5", "--seeds", 2, "--seed", 4, "--json")
    result = ridgeline.bench(dataset_path, perturb="3,3,0,5", seeds=2, seed=4)
    assert without_times(result.json()) == without_times(done.stdout)


def test_bench_rows_are_the_programs(program, dataset_path, tmp_path):
    program("bench", dataset_path, "--perturb", "3,3,0,5", "--out", tmp_path / "out", "--no-report")
    rows = (tmp_path / "out" / "results.csv").read_text().splitlines()
    result = ridgeline.bench(dataset_path, perturb="3,3,0,5")
    assert [r.rsplit(",", 1)[0] for r in rows] == [
        r.rsplit(",", 1)[0] for r in result.csv().splitlines()
    ]


def test_bench_arrays(dataset_path, dataset):
    seen = []
    result = ridgeline.bench(
        dataset_path, perturb="3,3,0,5", progress=lambda done, total: seen.append((done, total))
    )
    arrays = result.arrays()
    count = len(dataset)
    assert seen == [(i + 1, count) for i in range(count)]
    assert {len(values) for values in arrays.values()} == {count}
    assert list(arrays["query"]) == [q.id for q in dataset.queries]
    for i, query in enumerate(dataset.queries):
        found = result[i]
        assert arrays["confidence"][i] == found.confidence
        if found.pose is None:
            assert np.isnan(arrays["east"][i]) and np.isnan(arrays["error_m"][i])
        else:
            np.testing.assert_array_equal(arrays["height"][i], found.pose.center[2])
            assert arrays["error_m"][i] == found.pose.error(query.truth)[0]
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    assert isinstance(ridgeline.to_pandas(result), pandas.DataFrame)


def test_a_failing_progress_function_ends_the_bench(dataset_path):
    def fail(done, total):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        ridgeline.bench(dataset_path, perturb="3,3,0,5", progress=fail)


def test_ctrl_c_ends_a_long_call(localizer, query):
    ranges = {"east_m": 60, "north_m": 60, "heading_deg": 180, "pitch_deg": 20, "roll_deg": 10}
    options = localizer.options
    options["search.map.max_positions"] = 100000
    patient = ridgeline.Localizer(localizer.world, options)
    timer = threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        patient.localize(query.image, query.camera, query.prior, ranges=ranges)
    assert time.monotonic() - start < 30.0  # minutes without it
    assert localizer.localize(query.image, query.camera, query.prior).status


def test_other_threads_go_on_during_a_long_call(localizer, query):
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.01):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    localizer.localize(query.image, query.camera, query.prior)
    end = time.monotonic()
    done.set()
    thread.join()
    assert sum(start < t < end for t in ticks) > 3


def test_tracker_and_study(localizer, dataset_path, query):
    tracker = ridgeline.SkylineTracker(localizer.scene, {"match.method": "3d"})
    off = ridgeline.Pose.from_view_angles(
        query.truth.center, query.truth.heading_deg + 3.0, query.truth.pitch_deg, query.truth.roll_deg
    )
    frame = tracker.track(query.image, query.camera, off)
    assert frame["status"] in (
        "ok", "unusable", "no_model", "far_from_start", "poor_match", "ambiguous")
    if frame["pose"] is not None:
        assert frame["pose"].error(query.truth)[2] < 3.0
    study = ridgeline.study(
        dataset_path, ["evidence", "line_energy"], queries=[query.id], perturb="3,3,0,5",
        classes=[5, 10],
    )
    assert [item["score"] for item in (study[0], study[1])] == ["evidence", "line_energy"]
    assert len(study[0]["sampled"]["energy"]) == 10
    assert study[0]["map"].energies.shape == study[1]["map"].energies.shape
    assert study.summary()
