#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# Each public header compiles alone, in C11 and in C++, without a warning. Usage: headers.sh ROOT
set -u
status=0
for header in "$1"/include/dyadel/*.h; do
  name=dyadel/$(basename "$header")
  printf '#include <%s>\n' "$name" | ${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$1/include" -x c \
    -fsyntax-only - || { echo "$name does not compile alone in C11"; status=1; }
  printf '#include <%s>\n' "$name" | ${CXX:-c++} -std=c++11 -Wall -Wextra -Wpedantic -Werror -I"$1/include" -x c++ \
    -fsyntax-only - || { echo "$name does not compile alone in C++"; status=1; }
done
exit $status
