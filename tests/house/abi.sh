#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# The ABI of the library is the one of tests/data/abi.xml ("ABI rules" in include/dyadel/dyadel.h): every difference
# fails, and is shown. Usage: abi.sh ROOT [LIBRARY BUILD [--renew]]   (LIBRARY, a target of BUILD, has debug information;
# --renew writes tests/data/abi.xml). Skipped where abigail-tools are not installed, and on other machines than x86-64.
set -u
for tool in abidw abidiff; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed (Debian package abigail-tools)"; exit 77; }
done
[ "$(uname -m)" = x86_64 ] || { echo "skipped: the dump is of x86-64, this is $(uname -m)"; exit 77; }
[ $# -gt 1 ] || { echo "skipped: not in a build with sanitizers, or configure again to find abidw"; exit 77; }
ninja -C "$3" "${2#"$3"/}" >/dev/null || { echo "$2 does not compile"; exit 1; }
known=$1/tests/data/abi.xml
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# Types that are not defined in the public headers or by GMP are opaque; abidw takes a suppression of this name so. (Its
# --headers-dir goes by base names, and src has headers of the same names.)
cat >"$work/private" <<'EOT'
[suppress_type]
  label = Artificial private types suppression specification
  source_location_not_regexp = (include/dyadel/[a-z0-9_]+|gmp)\.h$
  drop = true
EOT
abidw --suppressions "$work/private" --exported-interfaces-only --no-show-locs --no-parameter-names --no-corpus-path \
  --no-comp-dir-path --no-elf-needed --no-write-default-sizes --type-id-style hash "$2" >"$work/abi.xml"
grep -q "elf-symbol name='dyd_version'" "$work/abi.xml" || { echo "abidw finds no interface in $2"; exit 1; }
if [ "${4-}" = --renew ]; then
  cp "$work/abi.xml" "$known" && echo "$known: $(wc -c <"$known") bytes"
  exit
fi

abidiff --no-show-locs "$known" "$work/abi.xml" >"$work/difference"
status=$?
[ $status -eq 0 ] && exit 0
cat "$work/difference"
if [ $((status & 3)) -ne 0 ]; then
  echo "abidiff failed"
elif [ $((status & 8)) -ne 0 ]; then
  echo "The ABI has changed, and programs that exist will break: \"ABI rules\" in include/dyadel/dyadel.h, rule 5."
else
  echo "The ABI has changed: is it an addition, as \"ABI rules\" in include/dyadel/dyadel.h allow? Else rule 5."
fi
echo "If it is meant: meson compile -C BUILD renew-abi"
exit 1
