#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the site into build/site/ from docs/: site.sh. Needs the packages mkdocs and mkdocs-material; with
# doxygen the reference of the C++ library is built, too. Fails for a broken link, within the pages, to
# files, to places in pages, and for anything that a page would load from elsewhere.
set -eu
cd "$(dirname -- "$0")/.."
if ! command -v mkdocs >/dev/null; then
  echo "site.sh: needs apt-get install mkdocs mkdocs-material (and doxygen)" >&2
  exit 2
fi
mkdocs build --strict --quiet --clean
if command -v doxygen >/dev/null; then
  doxygen Doxyfile
else
  mkdir -p build/site/api/html
  echo '<!DOCTYPE html><title>ridgeline</title><p>Built without doxygen.' > build/site/api/html/index.html
fi
python3 scripts/check_site.py build/site
echo "Site: build/site/index.html (python3 -m http.server --directory build/site)"
