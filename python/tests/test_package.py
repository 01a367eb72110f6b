# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: its stubs, its docstrings, its options."""

import ast
import inspect
import json
from pathlib import Path

import ridgeline
from ridgeline import _ridgeline


def stub_names():
    tree = ast.parse((Path(ridgeline.__file__).parent / "_ridgeline.pyi").read_text())
    names = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = {
                n.name for n in node.body if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef))
            } | {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
        elif isinstance(node, ast.FunctionDef):
            names[node.name] = None
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = None
    return names


def test_the_stubs_name_what_there_is():
    stubs = stub_names()
    there = {n for n in dir(_ridgeline) if not n.startswith("_")}
    assert {n for n in stubs if not n.startswith("_")} == there
    for name in there:
        value = getattr(_ridgeline, name)
        if not inspect.isclass(value) or name == "InputError":
            continue
        members = {m for m in vars(value) if not m.startswith("_")}
        assert {m for m in stubs[name] if not m.startswith("_")} == members, name


def test_every_function_and_class_is_documented():
    for name in ridgeline.__all__:
        value = getattr(ridgeline, name)
        if inspect.isclass(value) or callable(value):
            assert value.__doc__ and len(value.__doc__.strip()) > 20, name


def test_options_are_the_programs(program):
    assert json.loads(program("options").stdout) == _defaults_of_a_fresh_process()


def _defaults_of_a_fresh_process():
    """Own cues of other tests are not among these."""
    import subprocess
    import sys

    done = subprocess.run(
        [sys.executable, "-c", "import ridgeline; print(ridgeline.Options().json())"],
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


def test_shipped_options():
    paper = ridgeline.shipped_options("paper")
    assert paper["score.name"].startswith("line_energy")
    copy = paper.copy()
    copy["search.east_m"] = 3
    assert paper["search.east_m"] != 3
