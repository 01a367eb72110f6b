# SPDX-License-Identifier: Apache-2.0
"""Packs the package that CMake built: RIDGELINE_BUILT_PACKAGE names its folder (scripts/wheel.sh)."""

import os
import re
from pathlib import Path

from setuptools import Distribution, setup

BUILT = os.environ.get("RIDGELINE_BUILT_PACKAGE")
if not BUILT:
    raise SystemExit(
        "The module is built by CMake with the rest of ridgeline: run scripts/wheel.sh"
    )


class WithModule(Distribution):
    """A package of one platform."""

    def has_ext_modules(self):
        return True


def version():
    text = (Path(BUILT) / "VERSION").read_text()
    return re.fullmatch(r"\d+\.\d+\.\d+", text.strip()).group()


setup(
    version=version(),
    packages=["ridgeline"],
    package_dir={"ridgeline": BUILT},
    package_data={"ridgeline": ["*.so", "*.pyi", "py.typed", "VERSION", "configs/*.json"]},
    distclass=WithModule,
)
