#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# Two builds in folders of different names, one by the compiler and not by ccache, install the same bytes.
# Usage: reproducible.sh ROOT [BUILD]   (BUILD: one of them, complete; where it is no folder in ROOT, it is not used)
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1

# install_new NAME OPTION...: builds a copy of ROOT in a folder of this name, and installs.
install_new() {
  name=$1
  shift
  mkdir "$work/$name" && tar -C "$root" --exclude='./build*' --exclude=./.git -cf - . | tar -C "$work/$name" -xf - &&
    meson setup "$@" -Dtests=disabled -Dproofs=disabled "$work/$name/build-of-two" "$work/$name" >"$work/log" 2>&1 &&
    meson install -C "$work/$name/build-of-two" --destdir "$work/installed-$name" --quiet >>"$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }
}

root=$1
if [ $# -gt 1 ] && [ "$(dirname "$2")" = "$root" ]; then
  meson install -C "$2" --no-rebuild --destdir "$work/installed-one" --quiet >"$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }
  find "$work/installed-one" -name dyadel-proved -delete # OCaml's, which is not built again
  install_new another-longer-one $(meson introspect --buildoptions "$2" | python3 -c 'import json, sys
for o in json.load(sys.stdin):
    if o["section"] in ("base", "user") or o["name"] in ("buildtype", "debug", "optimization", "prefix", "libdir"):
        print("-D{}={}".format(o["name"], str(o["value"]).lower() if isinstance(o["value"], bool) else o["value"]))')
else
  install_new one
  sleep 1 # of clocks in file names and texts
  install_new another-longer-one
fi
[ "$(find "$work/installed-one" -type f | wc -l)" -gt 20 ] || { echo "too little is installed"; exit 1; }
diff -r "$work/installed-one" "$work/installed-another-longer-one" && echo "the same bytes: $(find "$work/installed-one" -type f | wc -l) files"
