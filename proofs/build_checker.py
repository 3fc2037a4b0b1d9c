#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Builds dyadel-proved, the checker of certificates that is proved in Coq: extracts it to OCaml and compiles that.

Usage: build_checker.py PROOFS FOLDER OUTPUT   (works in FOLDER/extracted; OUTPUT is the program)

The proofs themselves are not compiled here: the tests of the suite proofs do that, with the same sources.
"""
import pathlib
import shutil
import subprocess
import sys

THEORIES = ('CheckerTree', 'Checker', 'CheckerFaces', 'CheckerBounds', 'CheckerCover', 'CheckerChain', 'CheckerTies',
            'CheckerStill', 'CheckerDiagram', 'CheckerDistance', 'CheckerEnclosure', 'CheckerInverse', 'CheckerAlgebra',
            'CheckerCycle', 'CheckerBlock', 'CheckerVanish', 'CheckerFacts', 'CheckerTied', 'CheckerExtract')
READERS = ('source', 'described', 'reader', 'hints', 'cuts', 'circles', 'crossings', 'vanishing', 'blocks', 'proved')


def link(work, output, sources):
    """A program of the OCaml extracted in `work`, with Zarith, and checks of all bounds."""
    subprocess.run(['ocamlfind', 'ocamlopt', '-package', 'zarith', '-linkpkg', '-w', '-a', '-inline', '100', '-o',
                    output, *sources], cwd=work, check=True)


def build(proofs, folder, output):
    """Raises CalledProcessError when a step fails."""
    work = folder / 'extracted'
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    for name in THEORIES:
        shutil.copy(proofs / f'theories/{name}.v', work)
        subprocess.run(['coqc', '-q', '-R', '.', 'Dyadel', f'{name}.v'], cwd=work, check=True)
    for name in READERS:
        shutil.copy(proofs / f'extraction/{name}.ml', work)
    sources = ['checker.mli', 'checker.ml'] + [f'{name}.ml' for name in READERS]
    link(work, output, sources)


def main():
    build(*(pathlib.Path(arg).resolve() for arg in sys.argv[1:4]))


if __name__ == '__main__':
    main()
