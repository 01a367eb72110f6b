# SPDX-License-Identifier: Apache-2.0
"""The notebooks run from the first cell to the last, and make their figures."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("matplotlib", reason="matplotlib is not installed")
NOTEBOOKS = Path(__file__).resolve().parents[1] / "notebooks"


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    return tmp_path_factory.mktemp("notebooks")


@pytest.mark.parametrize(
    "name, figure",
    [
        ("a_photo_to_pose", "photo_to_pose"),
        ("b_own_score", "own_score"),
        ("c_compare_methods", "compare_methods"),
        ("d_learn_weights", "learned_weights"),
    ],
)
def test_notebook(work, name, figure):
    environment = {
        **os.environ,
        "RIDGELINE_NOTEBOOKS": str(work),
        "RIDGELINE_FIGURES": os.environ.get("RIDGELINE_FIGURES", str(work / "figures")),
    }
    done = subprocess.run(
        [sys.executable, str(NOTEBOOKS / f"{name}.py")],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (Path(environment["RIDGELINE_FIGURES"]) / f"{figure}.png").stat().st_size > 5000
