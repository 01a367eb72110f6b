# SPDX-License-Identifier: Apache-2.0
"""A small invented town, made once for all tests."""

import json
import os
import shutil
import subprocess

import numpy as np
import pytest

import ridgeline

TOWN = {
    "town.seed": 3,
    "town.blocks_east": 2,
    "town.blocks_north": 2,
    "street": 3,
    "tilted": 0,
    "portrait": 0,
    "drone": 0,
    "width": 640,
    "height": 480,
}


@pytest.fixture(scope="session")
def dataset_path(tmp_path_factory):
    return ridgeline.synth(tmp_path_factory.mktemp("data") / "town", TOWN)


@pytest.fixture(scope="session")
def dataset(dataset_path):
    return ridgeline.Dataset(dataset_path)


@pytest.fixture(scope="session")
def world(dataset_path):
    return ridgeline.World.of_dataset(dataset_path)


@pytest.fixture(scope="session")
def localizer(world):
    return ridgeline.Localizer(world)


@pytest.fixture(scope="session")
def query(dataset):
    return dataset[0]


@pytest.fixture(scope="session")
def picture(localizer, query):
    return ridgeline.Picture(localizer, query.image, query.camera)


@pytest.fixture(scope="session")
def grid(query):
    """Poses around the truth: 5 x 5 places, 9 headings."""
    truth = query.truth
    steps = np.arange(-2.0, 3.0)
    east, north, heading = np.meshgrid(steps, steps, np.arange(-4.0, 5.0), indexing="ij")
    centers = truth.center + np.stack([east, north, 0 * east], -1).reshape(-1, 3)
    angles = np.array([truth.heading_deg, truth.pitch_deg, truth.roll_deg]) + np.stack(
        [heading, 0 * heading, 0 * heading], -1
    ).reshape(-1, 3)
    return ridgeline.Poses.from_view_angles(centers, angles)


@pytest.fixture(scope="session")
def program():
    """Runs the program: program("localize", ...) -> its JSON. Skips without RIDGELINE_PROGRAM."""
    path = os.environ.get("RIDGELINE_PROGRAM") or shutil.which("ridgeline")
    if not path:
        pytest.skip("no ridgeline program: RIDGELINE_PROGRAM names none")

    def run(*arguments, exit_code=0):
        done = subprocess.run(
            [path, *map(str, arguments)], capture_output=True, text=True, check=False
        )
        assert done.returncode == exit_code, done.stderr
        return done

    return run


def without_times(summary):
    """A summary of a benchmark less what a clock says."""
    if isinstance(summary, str):
        summary = json.loads(summary)
    clock = ("seconds_per_query", "pose_evaluations_per_second")
    return {
        key: {name: without_times(s) for name, s in value.items()} if key == "sets" else value
        for key, value in summary.items()
        if key not in clock
    }
