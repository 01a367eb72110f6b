# SPDX-License-Identifier: Apache-2.0
"""How fast poses are scored from Python, against C++, and what an own score and the import cost.

    python_rate.py [DATASET [QUERY]]      (without: an invented town)

The C++ rate is that of the map of a search (Score.map), whose loop is all C++; the Python rate is
that of Score.energies on an array of the same poses. Each is the best of five runs, taken in turn.
"""

import subprocess
import sys
import tempfile
import time

import numpy as np

import ridgeline

EAST_M = 24.0  # 49 x 49 places x 41 headings: 98 441 poses
HEADING_DEG = 20.0


def best_of(count, *functions, clock=time.perf_counter):
    """Least seconds of each function, run in turn."""
    seconds = [[] for _ in functions]
    for _ in range(count):
        for times, function in zip(seconds, functions):
            start = clock()
            function()
            times.append(clock() - start)
    return [min(times) for times in seconds]


def grid_of(truth, reach_m, step_m=1.0):
    """The poses of the map around a pose, whether a camera can be there or not."""
    steps = np.arange(-reach_m, reach_m + step_m / 2, step_m)
    headings = truth.heading_deg + np.arange(-HEADING_DEG, HEADING_DEG + 0.5)
    north, east, heading = np.meshgrid(steps, steps, headings, indexing="ij")
    centers = truth.center + np.stack([east, north, 0 * east], -1).reshape(-1, 3)
    angles = np.stack(
        [heading, np.full_like(heading, truth.pitch_deg), np.full_like(heading, truth.roll_deg)], -1
    )
    return ridgeline.Poses.from_view_angles(centers, angles.reshape(-1, 3))


def rates(localizer, query):
    picture = ridgeline.Picture(localizer, query.image, query.camera)
    score = picture.score()
    ranges = {"east_m": EAST_M, "north_m": EAST_M, "heading_deg": HEADING_DEG, "pitch_deg": 0,
              "roll_deg": 0, "height_m": 0, "free_space": False}
    poses = grid_of(query.truth, EAST_M)
    in_cpp, in_python = best_of(
        5, lambda: score.map(query.truth, ranges), lambda: score.energies(poses)
    )
    print(f"{len(poses)} poses, score {score.name}: C++ {len(poses) / in_cpp:,.0f} poses/s, "
          f"Python {len(poses) / in_python:,.0f} poses/s ({in_cpp / in_python:.1%})")


def own_score(localizer, query):
    """What a map costs beyond the own score's work: the same calls with the work taken out.

    In seconds of the thread's own, which other work on the machine does not change.
    """
    spent = [0.0]

    def busy(batch):
        start = time.thread_time()
        segments, pose, _ = batch.segments()
        length = np.hypot(*(segments[:, 2:] - segments[:, :2]).T)
        value = np.bincount(pose, weights=length, minlength=len(batch))
        for _ in range(20):  # a score that takes 0.1 ms and more a place
            value = np.sort(value) + np.float64(1e-9)
        spent[0] += time.thread_time() - start
        return value

    ridgeline.register_score(busy)
    score = ridgeline.Picture(localizer, query.image, query.camera).score("busy")
    empty = lambda batch: np.zeros(len(batch))  # noqa: E731
    ridgeline.register_score(empty, name="empty")
    bare = ridgeline.Picture(localizer, query.image, query.camera).score("empty")
    ranges = {"east_m": 10, "north_m": 10, "heading_deg": HEADING_DEG, "pitch_deg": 0, "roll_deg": 0,
              "height_m": 0, "free_space": False}
    seconds, without = best_of(
        5, lambda: score.map(query.truth, ranges, threads=1),
        lambda: bare.map(query.truth, ranges, threads=1), clock=time.thread_time)
    own = spent[0] / 5
    print(f"own score in a map of 17 181 poses, one thread: {seconds:.3f} s, of which its own time "
          f"{own:.3f} s; an empty own score {without:.3f} s (visibility from 441 places and calls)")


def import_seconds():
    code = "import time; t = time.process_time(); import ridgeline; print(time.process_time() - t)"
    return min(
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                             check=True).stdout)
        for _ in range(7)
    )


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = sys.argv[1] if len(sys.argv) > 1 else ridgeline.synth(f"{folder}/town")
        dataset = ridgeline.Dataset(path)
        query = dataset[sys.argv[2]] if len(sys.argv) > 2 else dataset[0]
        localizer = ridgeline.Localizer(
            ridgeline.World.of_dataset(path), {"search.map.max_positions": 100_000}
        )
        rates(localizer, query)
        own_score(localizer, query)
    print(f"import: {import_seconds():.3f} s of processor time, with NumPy")


if __name__ == "__main__":
    main()
