#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks a built site: check_site.py FOLDER. Every link within the site leads to a file, and to a place in it
where it names one; no page loads anything from elsewhere. Pages of Doxygen are led to, not looked into."""
import html.parser
import pathlib
import sys
import urllib.parse

# Attributes that make a browser load something.
LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.loaded = set(), [], []
        self.feed(path.read_text(errors="replace"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.update(v for v in (values.get("id"), values.get("name")) if v)
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        is_hint = tag == "link" and values.get("rel") in ("canonical", "prev", "next")
        self.loaded += [values[a] for t, a in LOADED if t == tag and values.get(a) and not is_hint]


def problems(root):
    pages = {p: Page(p) for p in root.rglob("*.html") if "api" not in p.relative_to(root).parts}
    for path, page in pages.items():
        where = path.relative_to(root)
        for link in page.links + page.loaded:
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                if link in page.loaded and url.scheme != "data":
                    yield f"{where}: loads {link}"
                continue
            target = root / url.path.lstrip("/") if url.path.startswith("/") else path.parent / url.path
            target = (path if not url.path else target).resolve()
            if target.is_dir():
                target = target / "index.html"
            if path.name == "404.html":
                continue  # its links count from the server's root
            if not target.is_file():
                yield f"{where}: no file for {link}"
            elif url.fragment and target in pages:
                if urllib.parse.unquote(url.fragment) not in pages[target].ids:
                    yield f"{where}: no place for {link}"
    for style in root.rglob("*.css"):
        if "api" not in style.relative_to(root).parts and "url(http" in style.read_text():
            yield f"{style.relative_to(root)}: loads from elsewhere"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = sorted(set(problems(root)))
    for line in found:
        print(line, file=sys.stderr)
    sys.exit(1 if found else 0)


main()
