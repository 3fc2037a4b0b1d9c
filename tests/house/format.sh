#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# All C files are laid out as clang-format lays them out. Skipped where it is not installed. Usage: format.sh ROOT
set -u
command -v clang-format >/dev/null || { echo "clang-format is not installed"; exit 77; }
cd "$1" || exit 1
find src include tests bench -name '*.[ch]' -exec clang-format --dry-run -Werror {} +
