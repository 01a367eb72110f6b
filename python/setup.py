# SPDX-License-Identifier: Apache-2.0
"""Packs the package that CMake built, which scripts/wheel.sh lays beside this file."""

import re
from pathlib import Path

from setuptools import Distribution, setup

BUILT = Path(__file__).resolve().parent / "ridgeline"
if not (BUILT / "VERSION").exists():
    raise SystemExit(
        "The module is built by CMake with the rest of ridgeline: run scripts/wheel.sh"
    )


class WithModule(Distribution):
    """A package of one platform."""

    def has_ext_modules(self):
        return True


def version():
    text = (BUILT / "VERSION").read_text()
    return re.fullmatch(r"\d+\.\d+\.\d+", text.strip()).group()


setup(
    version=version(),
    packages=["ridgeline"],
    package_data={"ridgeline": ["*.so", "*.pyi", "py.typed", "VERSION", "configs/*.json"]},
    distclass=WithModule,
)
