#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# An oracle program in the shell, with bc: point I is (sqrt(a), -sqrt(b)) for line I of the list of a and b below. bc cuts
# its square roots off after the decimals requested, so the next decimal number above is above the root.
LIST='2 3
5 7
11 1
13 17
4 19
23 29
31 9
37 41'

echo points "$(echo "$LIST" | wc -l)"
while read -r _ i b; do
  [ "$b" -ge 0 ] || b=0
  places=$((b * 31 / 100 + 2)) # 10^-places < 2^-b
  pair=$(echo "$LIST" | sed -n "$((i + 1))p")
  printf 'scale=%d; u=10^-%d; r=sqrt(%d); r; r+u; s=sqrt(%d); -s-u; -s\n' $places $places ${pair% *} ${pair#* } |
    BC_LINE_LENGTH=0 bc | {
    read -r x0 && read -r x1 && read -r y0 && read -r y1
    echo "$i $x0 $x1 $y0 $y1"
  }
done
