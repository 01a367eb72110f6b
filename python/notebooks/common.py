# SPDX-License-Identifier: Apache-2.0
"""What the notebooks share: an invented town to work on, and where figures go."""

import os
from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # figures are files; take it out to see them in a notebook

import ridgeline  # noqa: E402

WORK = Path(os.environ.get("RIDGELINE_NOTEBOOKS", "build/notebooks"))
FIGURES = Path(os.environ.get("RIDGELINE_FIGURES", WORK))


def town(name="town", **options):
    """The dataset.json of a small town, made where it is not there yet."""
    folder = WORK / name
    if not (folder / "dataset.json").exists():
        folder.parent.mkdir(parents=True, exist_ok=True)
        settings = {
            "town.seed": 1,
            "town.blocks_east": 2,
            "town.blocks_north": 2,
            "street": 6,
            "tilted": 0,
            "portrait": 0,
            "drone": 0,
            "width": 640,
            "height": 480,
            **options,
        }
        ridgeline.synth(folder, settings)
    return str(folder / "dataset.json")


def save(figure, name):
    """Writes a figure as a small PNG and says where."""
    FIGURES.mkdir(parents=True, exist_ok=True)
    path = FIGURES / f"{name}.png"
    figure.savefig(path, dpi=100, bbox_inches="tight")
    print(f"figure: {path}")
