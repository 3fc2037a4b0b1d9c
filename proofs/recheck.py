#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Has coqchk, which shares only the kernel with coqc, check all compiled theories once more.

Usage: recheck.py ROOT FOLDER   (compiles in FOLDER as compile.py does)

The libraries that they use are taken as compiled by their package.
"""
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import compile as theories  # noqa: E402


def main():
    root, folder = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
    target = theories.compile_theories(root, folder)
    names = [word for name in theories.listed(target) for word in ('-norec', f'Dyadel.{name[:-2]}')]
    status = subprocess.run(['coqchk', '-silent', '-R', '.', 'Dyadel', *names], cwd=target, check=False).returncode
    print(f'{len(names) // 2} theories: ' + ('a fault' if status else 'no fault'))
    return status


if __name__ == '__main__':
    sys.exit(main())
