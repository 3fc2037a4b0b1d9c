#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the filters of the theories against those in C, bit for bit.

Usage: definitions.py ROOT FOLDER VECTORS [CASES]   (compiles in FOLDER as compile.py does; VECTORS: the program of
                                                     definitions/vectors.c; CASES: default 1500, some 15 vectors each)

The definitions that the theorems are about compute with Flocq's doubles; extracted they are a program in OCaml.
"""
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import build_checker  # noqa: E402
import compile as theories  # noqa: E402


def build(root, folder):
    """The program that knows the definitions. Raises CalledProcessError when a step fails."""
    compiled, work = theories.compile_theories(root, folder), folder / 'definitions'
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    for name in ('DefinitionsExtract.v', 'definitions.ml'):
        shutil.copy(root / 'proofs/definitions' / name, work)
    subprocess.run(['coqc', '-q', '-R', compiled, 'Dyadel', 'DefinitionsExtract.v'], cwd=work, check=True)
    build_checker.link(work, 'definitions', ['filters.mli', 'filters.ml', 'definitions.ml'])
    return work / 'definitions'


def main():
    root, folder, vectors = (pathlib.Path(arg).resolve() for arg in sys.argv[1:4])
    program = build(root, folder)
    cases = sys.argv[4] if len(sys.argv) > 4 else '1500'
    with subprocess.Popen([vectors, cases], stdout=subprocess.PIPE) as said:
        status = subprocess.run([program], stdin=said.stdout, check=False).returncode
    return status or said.returncode


if __name__ == '__main__':
    sys.exit(main())
