#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs what the theories define of the code in C against that code, bit for bit.

Usage: definitions.py ROOT FOLDER VECTORS [CASES]   (compiles in FOLDER as compile.py does; VECTORS: the program of
                                                     definitions/*.c; CASES: default 10000, some 140 vectors each)

The definitions that the theorems are about compute with Flocq's doubles, or with integers; extracted they are a program in
OCaml. Each function in C that a theory quotes has to be among them, with vectors enough.
"""
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import build_checker  # noqa: E402
import compile as theories  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / 'tests/house'))
import check_constants  # noqa: E402

SOURCES = ('quick.ml', 'harness.ml', 'doubles.ml', 'intervals.ml', 'wholes.ml')
LEAST = 1000


def build(root, folder, name):
    """The program that knows the definitions, in FOLDER/name. Raises CalledProcessError when a step fails."""
    compiled, work = theories.compile_theories(root, folder), folder / name
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    for source in ('DefinitionsExtract.v',) + SOURCES:
        shutil.copy(root / 'proofs/definitions' / source, work)
    subprocess.run(['coqc', '-q', '-R', compiled, 'Dyadel', 'DefinitionsExtract.v'], cwd=work, check=True)
    build_checker.link(work, 'definitions', [SOURCES[0], 'filters.mli', 'filters.ml', *SOURCES[1:]])
    return work / 'definitions'


def compare(program, vectors):
    """(exit status, what the definitions say) of what the command `vectors` writes."""
    with subprocess.Popen(vectors, stdout=subprocess.PIPE) as said:
        run = subprocess.run([program], stdin=said.stdout, stdout=subprocess.PIPE, text=True, check=False)
        said.stdout.close()
    return run.returncode or said.returncode, run.stdout


def few(root, text):
    """Functions that are quoted, but hardly run."""
    counted = {name: int(count) for name, count in re.findall(r'^(\w+): (\d+) vectors$', text, re.M)}
    for path, name in check_constants.run_functions(root):
        if counted.get(name, 0) < LEAST:
            yield f'{name} of {path} is quoted in a theory, and run on {counted.get(name, 0)} vectors only'


def main():
    root, folder, vectors = (pathlib.Path(arg).resolve() for arg in sys.argv[1:4])
    program = build(root, folder, 'definitions')
    cases = sys.argv[4] if len(sys.argv) > 4 else '10000'
    status, text = compare(program, [vectors, cases])
    found = list(few(root, text)) if status == 0 else []
    print(text + '\n'.join(found))
    return 1 if status or found else 0


if __name__ == '__main__':
    sys.exit(main())
