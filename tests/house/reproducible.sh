#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# Two builds in folders of different names, by the compiler and not by ccache, install the same bytes. Usage: reproducible.sh ROOT
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1
for name in one another-longer-one; do
  mkdir "$work/$name" && tar -C "$1" --exclude='./build*' --exclude=./.git -cf - . | tar -C "$work/$name" -xf - &&
    meson setup -Dtests=disabled -Dproofs=disabled "$work/$name/build-of-two" "$work/$name" >"$work/log" 2>&1 &&
    DESTDIR=$work/installed-$name meson install -C "$work/$name/build-of-two" --quiet >>"$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }
  sleep 1 # of clocks in file names and texts
done
[ "$(find "$work/installed-one" -type f | wc -l)" -gt 20 ] || { echo "too little is installed"; exit 1; }
diff -r "$work/installed-one" "$work/installed-another-longer-one" && echo "the same bytes: $(find "$work/installed-one" -type f | wc -l) files"
