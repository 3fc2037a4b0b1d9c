#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faults put into the functions in C that the theories define are seen by definitions.py.

Usage: definition_faults.py ROOT FOLDER CC LIBRARY [CASES]   (FOLDER as of definitions.py; CC: the compiler with its
                                                              arguments; LIBRARY: libdyadel_armed.a; CASES: default 12000)

The faults are in definitions/faults.txt, in the format of faults.py.
The vectors of that function are written by a program with the fault, and given to the definitions. Each function that is
run must have a fault. A fault that is not seen, or is in spite of its reason, is a failure.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import definitions  # noqa: E402
from faults import faults, with_fault  # noqa: E402

UNITS = ('areas', 'boxes', 'circles', 'expressions', 'fixed', 'intervals', 'near', 'plane', 'stars', 'vectors')
FLAGS = ['-std=c11', '-O1', '-w', '-ffp-contract=off', '-D_POSIX_C_SOURCE=200809L', '-DDYD_VERSION="0"']


class Programs:
    """Programs that write vectors, with faults."""

    def __init__(self, root, cc, library, work):
        self.root, self.cc, self.library, self.work = root, cc.split(), library, work
        for unit in UNITS:
            self.compile(unit, work / f'{unit}.o', [])

    def compile(self, unit, target, first):
        include = [*first, self.root / 'src', self.root / 'include', self.root / 'tests', self.root / 'proofs/definitions']
        subprocess.run([*self.cc, *FLAGS, *(f'-I{folder}' for folder in include), '-c',
                        self.root / f'proofs/definitions/{unit}.c', '-o', target], check=True,
                       env={**os.environ, 'CCACHE_NODIRECT': '1'})  # its direct mode does not notice new files in front of others

    def unit(self, function):
        """Where the vectors of a function come from."""
        for unit in UNITS:
            if f'"{function}", ' in (self.root / f'proofs/definitions/{unit}.c').read_text(encoding='utf-8'):
                return unit
        raise ValueError(f'{function} has no vectors')

    def program(self, function, path, text, replacement):
        """The program in which the file has this fault."""
        folder, unit = self.work / 'fault', self.unit(function)
        changed = folder / path
        changed.parent.mkdir(parents=True, exist_ok=True)
        changed.write_text(with_fault((self.root / 'src' / path).read_text(encoding='utf-8'), function, text, replacement))
        self.compile(unit, self.work / 'changed.o', [folder])
        changed.unlink()
        objects = [self.work / f'{other}.o' for other in UNITS if other != unit]
        subprocess.run([*self.cc, self.work / 'changed.o', *objects, self.library, '-lgmp', '-lmpfr', '-lm', '-pthread',
                        '-o', self.work / 'vectors'], check=True)
        return self.work / 'vectors'


def tried(root, programs, definition, cases):
    """Yields the failures; prints each fault."""
    of = set()
    for function, path, text, replacement, reason in faults(root / 'proofs/definitions/faults.txt'):
        of.add(function)
        program = programs.program(function, path, text, replacement)
        status, said = definitions.compare(definition, [program, cases, function])
        seen = status == 1 and not said.endswith('\n0 differ\n')
        print(f'{function}: "{text}" -> "{replacement}": {"seen" if seen else "not seen"}', flush=True)
        if seen == (reason is not None) or status not in (0, 1):
            yield f'{function}: "{text}" -> "{replacement}" is {"" if seen else "not "}seen'
    for _, name in definitions.check_constants.run_functions(root):
        if name not in of:
            yield f'{name} has no fault'


def main():
    root, folder = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
    cases = sys.argv[5] if len(sys.argv) > 5 else '12000'
    definition = definitions.build(root, folder, 'definition_faults')
    with tempfile.TemporaryDirectory(dir=folder) as work:
        programs = Programs(root, sys.argv[3], pathlib.Path(sys.argv[4]).resolve(), pathlib.Path(work))
        found = list(tried(root, programs, definition, cases))
    print('\n'.join(found) or 'all are seen but those with reasons')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
