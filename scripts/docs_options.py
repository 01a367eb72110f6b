#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every key of --set, with its default and what it means, from the sources: docs_options.py > docs/options.md.

The keys are read from the Visit() functions and the tables of plug-ins, defaults and meanings from the
members of the option structs and their comments. configs/default.json, which the program wrote, is
compared with the result: a key that one has and the other has not is an error.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
INTRO = """# Every option

<!-- Written by scripts/docs_options.py from the sources; not to be edited. -->

What `--set KEY=VALUE` and configuration files can set, with the defaults. `ridgeline options` prints the same as a file, `ridgeline options --config paper` those of another configuration. A key that does not exist, a value of a wrong type or out of its range is refused, with the nearest key that exists.
"""


class Struct:
    """An option struct: its comment, its members, and the lines of its Visit()."""

    def __init__(self, comment):
        self.comment = comment
        self.members = {}  # name: (type, default, comment)
        self.visit = ""


def braces(text, start):
    """The text between the brace at or after start and its partner."""
    begin = text.index("{", start)
    depth = 0
    for i in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return text[begin + 1 : i]
    raise ValueError("a brace without its partner")


def sentence(lines):
    return " ".join(line.strip().lstrip("/").strip() for line in lines).strip()


def comment_before(text, position):
    lines = text[:position].rstrip("\n").split("\n")
    above = []
    while lines and lines[-1].strip().startswith("//"):
        above.insert(0, lines.pop())
    return sentence(above)


MEMBER = re.compile(r"^\s*([\w:<>, ]+?)\s+(\w+)(?:\s*=\s*([^;]+)|\{[^;]*\})?;\s*(//.*)?$")


def read_members(struct, body):
    body = re.sub(r"=\s*\n\s*", "= ", body)  # a default on a line of its own
    comment = []
    lines = body.split("\n")
    for i, line in enumerate(lines):
        text = line.strip()
        if text.startswith("//"):
            previous = lines[i - 1].strip() if i else ""
            comment = comment + [text] if previous.startswith("//") else [text]
            continue
        match = MEMBER.match(line)
        if match and not text.startswith(("return", "using", "friend")):
            kind, name, default, trailing = match.groups()
            meaning = sentence(comment)
            if trailing:
                more, j = [trailing], i + 1
                while j < len(lines) and re.match(r"^\s{20,}//", lines[j]):
                    more.append(lines[j])
                    j += 1
                meaning = (meaning + " " if meaning else "") + sentence(more)
            struct.members.setdefault(name, (kind.strip(), (default or "").strip(), meaning))
        elif not text:
            comment = []


def read_sources():
    structs, plugins, cues = {}, {}, {}
    sources = sorted((ROOT / "src").rglob("*.h")) + sorted((ROOT / "src").rglob("*.cc"))
    for path in sources:
        text = path.read_text()
        for match in re.finditer(r"^struct (\w+)[^;{]*\{", text, re.M):
            body = braces(text, match.start())
            if "Visit(OptionVisitor&" not in body:
                continue
            struct = structs.setdefault(match.group(1), Struct(comment_before(text, match.start())))
            read_members(struct, body)
            inline = re.search(r"void Visit\(OptionVisitor& \w+\) \{", body)
            if inline:
                struct.visit = braces(body, inline.start())
        for match in re.finditer(r"\.Add<(\w+)>\(\"(\w+)\"\)", text):
            plugins.setdefault(match.group(2), []).append((path.parent.name, path, match.group(1)))
    for path in sources:
        text = path.read_text()
        for match in re.finditer(r"void (\w+)::Visit\(OptionVisitor& \w+\) \{", text):
            if match.group(1) in structs:
                structs[match.group(1)].visit = braces(text, match.start())
        if path.name.endswith(("_cue.cc", "_cues.cc")):
            head = sentence(re.findall(r"^//.*", text.split("#include")[0], re.M)[1:])
            for names in re.findall(r"CueName \w+\[\w*\] = \{(.*?)\};", text, re.S):
                for name in re.findall(r"\{\"(\w+)\"", names):
                    cues[name] = head
    return structs, plugins, cues


def plugin_of(plugins, name, folder, is_cue):
    for where, path, kind in plugins.get(name, []):
        if where == folder and ("_cue" in path.name) == is_cue:
            return kind
    return None


def shown(default):
    default = re.sub(r"\bk\w+::|std::", "", default)
    return default.strip("{} ") if default.startswith("{") else default.strip('"')


def walk(structs, plugins, cues, name, prefix, rows):
    """Appends (key, default, meaning) of a struct and of what is in it."""
    struct = structs[name]
    for match in re.finditer(
        r"\.(Field|Group)\(\s*\"(\w+)\",\s*(?:\[[^\]]*\]\(OptionVisitor& \w+\) \{\s*(\w+)\.Visit|([\w.]+))?"
        r"|\b(\w+)\.Visit\(v\)",
        struct.visit,
    ):
        word, key, group, member, flat = match.groups()
        if flat in ("groups", "cues"):
            is_cue = flat == "cues"
            folder = "optim" if name == "SamplerOptions" else "score"
            for plugin in plugins:
                kind = plugin_of(plugins, plugin, folder, is_cue)
                if kind:
                    walk(structs, plugins, cues, kind, f"{prefix}{plugin}.", rows)
        elif flat:
            walk(structs, plugins, cues, struct.members[flat][0], prefix, rows)
        elif word == "Field":
            _, default, meaning = struct.members[member]
            rows.append((prefix + key, shown(default), meaning or struct.comment))
        elif group:
            walk(structs, plugins, cues, struct.members[group][0], f"{prefix}{key}.", rows)
        elif key == "weights":
            rows.extend((f"{prefix}weights.{cue}", "", meaning) for cue, meaning in cues.items())


def flat(values, prefix=""):
    for key, value in values.items():
        if isinstance(value, dict):
            yield from flat(value, prefix + key + ".")
        else:
            yield prefix + key, value


def table(rows):
    lines = ["| key | default | what it is |", "|---|---|---|"]
    for key, default, meaning in rows:
        meaning = meaning.replace("|", "\\|").replace("<", "&lt;")
        lines.append(f"| `{key}` | {'`' + default + '`' if default else ''} | {meaning} |")
    return "\n".join(lines)


def section(title, text, rows):
    return f"\n## {title}\n\n{text}\n\n{table(rows)}\n"


def main():
    structs, plugins, cues = read_sources()
    rows = []
    walk(structs, plugins, cues, "LocalizerOptions", "", rows)
    # In the order of the program, with its values.
    found = {key: meaning for key, _, meaning in rows}
    values = dict(flat(json.loads((ROOT / "configs/default.json").read_text())))
    odd = sorted(set(found) ^ set(values))
    if odd:
        sys.exit(f"docs_options.py: not both in the sources and in configs/default.json: {', '.join(odd)}")
    rows = [(key, json.dumps(value).strip('"'), found[key]) for key, value in values.items()]
    silent = [key for key, _, meaning in rows if not meaning]
    if silent:
        sys.exit(f"docs_options.py: without a comment in the sources: {', '.join(silent)}")

    text = INTRO
    titles = {
        "lines": ("Lines of the picture", "`lines`: the detector ([inputs](inputs.md) says how to bring your own lines)."),
        "projection": ("What is seen of the model", "`projection`."),
        "score": ("Score", "`score`: what a pose is judged by ([scores](scores.md))."),
        "search": ("Search", "`search`: where and how is looked ([samplers](samplers.md))."),
        "confidence": ("Confidence", "`confidence`: what is believed ([confidence](confidence.md))."),
    }
    for group, (title, intro) in titles.items():
        text += section(title, intro, [row for row in rows if row[0].split(".")[0] == group])
    others = {
        "SkylineArguments": ("Skylines", "Keys of `ridgeline skyline --set` ([skylines](skyline.md))."),
        "TownDatasetOptions": ("The demo town", "Keys of `ridgeline synth --set` ([the demo town](synth.md))."),
        "WalkOptions": ("A walk through the demo town", "Keys of `ridgeline synth --walk --set`."),
    }
    for struct, (title, intro) in others.items():
        more = []
        walk(structs, plugins, cues, struct, "", more)
        text += section(title, intro, more)
    print(text, end="")


main()
