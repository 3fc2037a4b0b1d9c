#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# The installed files work in their place; the pkg-config file gives users no include folders but those of GMP; without
# tests, nothing but that is built. Usage: install.sh ROOT BUILD
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

fail() {
  echo "$1"
  exit 1
}

DESTDIR=$work/root meson install -C "$2" --no-rebuild --quiet >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
mv "$work/root" "$work/moved"
command=$(find "$work/moved" -name dyadel -type f -perm -u+x)
printed=$(env -u LD_LIBRARY_PATH "$command" --version) || fail "the installed command does not run"
case $printed in "dyadel "[0-9]*) ;; *) fail "the installed command prints: $printed" ;; esac

# Hardened as Debian's packages are, and symbols with the version that soname counts.
for file in $(find "$work/moved" -type f \( -name 'libdyadel.so*' -o -name 'dyadel' -o -name 'dyadel-gdal' -o -name '_dyadel*.so' \)); do
  head -c 4 "$file" | grep -q ELF || continue
  readelf -dW "$file" | grep -q 'BIND_NOW\|FLAGS.*NOW' || fail "$file binds lazily"
  readelf -lW "$file" | grep -q GNU_RELRO || fail "$file: tables of addresses stay writable"
  readelf -lW "$file" | grep 'GNU_STACK' | grep -q 'RW ' || fail "$file: the stack is executable"
  nm -D "$file" | grep -q '__stack_chk_fail' || fail "$file is built without -fstack-protector-strong"
  nm -D "$file" | grep -q '__[a-z]*_chk' || fail "$file is built without _FORTIFY_SOURCE"
done
library=$(find "$work/moved" -name 'libdyadel.so.*' -type f)
nm -D --defined-only "$library" | grep -v ' dyd_[a-z_0-9]*@@DYADEL_0$\| A DYADEL_0' && fail "$library has symbols without a version"

# dyadel-proved, where it is installed, is found without PATH.
if find "$work/moved" -name dyadel-proved | grep -q .; then
  printf '0 0\n1 0\n0 1\n1 1\n' >"$work/points.txt"
  env -u LD_LIBRARY_PATH "$command" delaunay --quiet -o "$work/pairs.csv" --certificate "$work/certificate.txt" "$work/points.txt"
  env -u LD_LIBRARY_PATH PATH=/nowhere "$command" verify --proved "$work/certificate.txt" | grep -q 'checked: 2 ties' ||
    fail "the installed command does not find dyadel-proved"
fi

PKG_CONFIG_PATH=$(dirname "$(find "$work/moved" -name dyadel.pc)")
export PKG_CONFIG_PATH
pkg-config --cflags dyadel | grep -Eq 'cairo|glib|freetype|jansson' && fail "--cflags: $(pkg-config --cflags dyadel)"
pkg-config --libs dyadel | grep -Eq 'cairo|flint' && fail "--libs: $(pkg-config --libs dyadel)"
pkg-config --static --libs dyadel | grep -q 'lflint-arb' || fail "--static --libs: $(pkg-config --static --libs dyadel)"

# CMake finds the moved installation by its own file, and refuses a version that is not there yet.
if command -v cmake >/dev/null; then
  mkdir "$work/program"
  printf '%s\n' '#include <dyadel/dyadel.h>' '#include <stdio.h>' 'int main(void) { return puts(dyd_version()) < 0; }' >"$work/program/a.c"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.13)' 'project(a C)' "find_package(dyadel \${WANTED} REQUIRED)" 'add_executable(a a.c)' \
    'target_link_libraries(a dyadel::dyadel)' >"$work/program/CMakeLists.txt"
  prefix=$(dirname "$(dirname "$(find "$work/moved" -name dyadel -type d -path '*include*')")")
  {
    cmake -S "$work/program" -B "$work/program/b" -DCMAKE_PREFIX_PATH="$prefix" && cmake --build "$work/program/b"
  } >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  [ "dyadel $("$work/program/b/a")" = "$printed" ] || fail "a program built by CMake runs another library"
  cmake -S "$work/program" -B "$work/program/c" -DCMAKE_PREFIX_PATH="$prefix" -DWANTED=99 >/dev/null 2>&1 && fail "CMake finds version 99"
fi

meson setup -Dtests=disabled "$work/bare" "$1" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
ninja -C "$work/bare" -n install | grep -E 'tests/|bench/|armed' && fail "this is built for an installation"
exit 0
