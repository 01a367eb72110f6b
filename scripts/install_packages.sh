#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages of packages.txt that are missing. Says which ones first. Works as root or
# with sudo. Does nothing, quickly, when all are there.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "install_packages.sh: no apt-get here. Install what scripts/packages.txt lists by other means," >&2
  echo "then run: cmake --preset release && cmake --build --preset release" >&2
  exit 2
fi

installed() { dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed; }

missing=''
while read -r package; do
  case $package in '' | '#'*) continue ;; esac
  installed "$package" && continue
  # Node from another source brings its own npm.
  case $package in nodejs) command -v node >/dev/null && continue ;; esac
  case $package in npm) command -v npm >/dev/null && continue ;; esac
  missing="$missing $package"
done < "$here/packages.txt"
if [ -z "$missing" ]; then
  echo "All Debian packages are installed."
  exit 0
fi

as_root=''
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install_packages.sh: needs root to run: apt-get install$missing" >&2
    exit 2
  fi
  as_root='sudo'
fi
echo "Will install these Debian packages and what they depend on:"
echo "$missing" | tr ' ' '\n' | sed '/^$/d; s/^/  /'
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
# shellcheck disable=SC2086  # one word per package
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing \
  > /dev/null
echo "Installed."
