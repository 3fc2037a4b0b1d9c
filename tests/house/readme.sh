#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# README shows exactly tests/house/readme_example.c, less its licence line, and its output; with a build folder: the example compiles against
# the installed library, found by pkg-config, and prints that output. Usage: readme.sh ROOT [BUILD]
set -u
root=$1
here=$root/tests/house
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# The fenced block that follows the line "<!-- NAME -->".
block() {
  awk -v mark="<!-- $1 -->" '$0 == mark { on = 1; next } on && /^```/ { if (++fence == 2) exit; next } on { print }' \
    "$root/README.md"
}

block readme_example.c >"$work/example.c"
block readme_example.expected >"$work/expected"
tail -n +2 "$here/readme_example.c" | cmp "$work/example.c" - || { echo "README shows another example"; exit 1; }
cmp "$work/expected" "$here/readme_example.expected" || { echo "README shows another output"; exit 1; }
[ $# -gt 1 ] || exit 0

DESTDIR=$work/root meson install -C "$2" --no-rebuild --quiet >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
folder=$(dirname "$(find "$work/root" -name dyadel.pc)")
export PKG_CONFIG_PATH="$folder" PKG_CONFIG_SYSROOT_DIR="$work/root"
# shellcheck disable=SC2046
${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Werror "$work/example.c" $(pkg-config --cflags --libs dyadel) \
  -o "$work/example" || exit 1
LD_LIBRARY_PATH=$(dirname "$folder") "$work/example" >"$work/printed" || { echo "the example failed"; exit 1; }
diff "$work/expected" "$work/printed"
