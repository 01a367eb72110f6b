#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian package in a bare Debian 12, localizes a picture of the demo town with it, and
# removes it again: test_deb.sh [DEB]. Needs root and the package debootstrap. The bare system is
# build/bare, made anew each time.
set -eu
cd "$(dirname -- "$0")/.."
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "test_deb.sh: needs root, and apt-get install debootstrap" >&2
  exit 2
fi
if [ $# -gt 0 ]; then
  deb=$1
else
  ./scripts/package.sh
  deb=$(ls build/package/ridgeline_*.deb)
fi
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
root=$PWD/build/bare
leave() {
  umount "$root/proc" 2>/dev/null || true
}
trap leave EXIT
leave
rm -rf "$root"
mkdir -p build
debootstrap --variant=minbase bookworm "$root" "$mirror" > build/debootstrap.log || {
  tail -5 build/debootstrap.log >&2
  exit 1
}
mount -t proc proc "$root/proc"
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp "$deb" "$root/tmp/ridgeline.deb"
in_root() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"; }

echo "== install"
started=$(date +%s)
in_root apt-get update -qq
in_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
  /tmp/ridgeline.deb > build/apt.log 2>&1 || { tail -20 build/apt.log >&2; exit 1; }
installed=$(date +%s)
echo "installed in $((installed - started)) s"

echo "== the first result"
in_root ridgeline synth --out /root/town --queries 1 --tilted 0 --portrait 0 --drone 0
in_root ridgeline localize --dataset /root/town/dataset.json --query street_000 \
  --out /root/result --report /root/result.html
echo "invented a town and found a pose in $(($(date +%s) - installed)) s"

echo "== what is installed"
for file in bin/ridgeline share/man/man1/ridgeline.1 share/man/man1/ridgeline-localize.1 \
  share/bash-completion/completions/ridgeline share/zsh/vendor-completions/_ridgeline \
  share/ridgeline/configs/paper.json share/doc/ridgeline/copyright share/doc/ridgeline/README.md; do
  test -s "$root/usr/$file" || { echo "missing: /usr/$file" >&2; exit 1; }
done
for file in pose.json overlay.png report.json map.geojson energy.tif; do
  test -s "$root/root/result/$file" || { echo "not written: $file" >&2; exit 1; }
done
test -s "$root/root/result.html"
in_root ridgeline doctor
in_root ridgeline localize --dataset /root/town/dataset.json --query street_000 --config paper \
  --set search.evaluations=50 --quiet || [ $? -eq 3 ]  # an abstention is an answer

echo "== remove"
in_root dpkg --purge ridgeline
if in_root sh -c 'command -v ridgeline' || [ -e "$root/usr/share/ridgeline" ] ||
  [ -e "$root/usr/share/doc/ridgeline" ]; then
  echo "the package leaves files behind" >&2
  exit 1
fi
echo "The package works in a bare Debian 12."
