# SPDX-License-Identifier: Apache-2.0
"""What mkdocs does not do by itself: pieces of files of the repository in pages, and pages that other
people add.

A line  --8<-- "FILE"  becomes the file,  "FILE:NAME"  what stands between the marks  // [NAME  and
// NAME]  of it. FILE is looked for in docs/, then in the repository.
"""
import pathlib
import re
import textwrap

from mkdocs.exceptions import PluginError

ROOT = pathlib.Path(__file__).resolve().parent.parent
PIECE = re.compile(r'^--8<-- "([^":]+)(?::(\w+))?"$', re.M)
# Pages that join the navigation once they exist.
LATER = {"papers.md": ("Understand", "The papers in the code"), "python.md": ("Reference", "Python")}


def piece(match):
    name, mark = match.groups()
    path = next((p for p in (ROOT / "docs" / name, ROOT / name) if p.is_file()), None)
    if path is None:
        raise PluginError(f"no file {name} for --8<--")
    lines = path.read_text().splitlines()
    if mark:
        begin = [i for i, line in enumerate(lines) if line.strip().lower() == f"// [{mark}".lower()]
        end = [i for i, line in enumerate(lines) if line.strip().lower() == f"// {mark}]".lower()]
        if not begin or not end:
            raise PluginError(f"no marks [{mark} and {mark}] in {name}")
        lines = lines[begin[0] + 1 : end[0]]
    return textwrap.dedent("\n".join(lines))


def on_page_markdown(markdown, **_):
    return PIECE.sub(piece, markdown)


def on_config(config):
    for page, (group, title) in LATER.items():
        if (ROOT / "docs" / page).is_file():
            for entry in config["nav"]:
                if group in entry and not any(page in item.values() for item in entry[group]):
                    entry[group].append({title: page})
    return config
