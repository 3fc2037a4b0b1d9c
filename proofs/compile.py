#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compiles the theories listed in proofs/theories/_CoqProject, in a folder of the build.

Usage: compile.py ROOT FOLDER   (FOLDER/theories gets the sources and the compiled files)

Only changed theories, and those that use them, are compiled again, two files at a time. Runs at the same time wait
for each other.
"""
import fcntl
import pathlib
import subprocess
import sys

JOBS = '2'


def listed(source):
    """Names of the theories in the list, in its order."""
    lines = (source / '_CoqProject').read_text(encoding='utf-8').split('\n')
    return [line for line in lines if line.endswith('.v')]


def breaches(source):
    """Faults of the list."""
    names, there = listed(source), {path.name for path in source.glob('*.v')}
    yield from (f'{name} is listed twice' for name in sorted(set(names)) if names.count(name) > 1)
    yield from (f'{name} is not in proofs/theories/_CoqProject' for name in sorted(there - set(names)))
    yield from (f'{name} is in the list, but does not exist' for name in sorted(set(names) - there))


def copy(source, target):
    """Brings target's sources up to date; a file that has not changed keeps its time."""
    for name in ['_CoqProject'] + listed(source):
        text = (source / name).read_bytes()
        if not (target / name).is_file() or (target / name).read_bytes() != text:
            (target / name).write_bytes(text)
    for path in set(target.glob('*.v')) - {target / name for name in listed(source)}:
        path.unlink()
        path.with_suffix('.vo').unlink(missing_ok=True)


def compile_theories(root, folder):
    """Compiles all; the folder with the result. Raises CalledProcessError when a proof fails."""
    source, target = root / 'proofs/theories', folder / 'theories'
    target.mkdir(parents=True, exist_ok=True)
    with open(folder / 'lock', 'w') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        copy(source, target)
        subprocess.run(['coq_makefile', '-f', '_CoqProject', '-o', 'Makefile'], cwd=target, check=True)
        subprocess.run(['make', '--no-print-directory', '-j', JOBS], cwd=target, check=True)
    return target


def main():
    root, folder = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
    found = list(breaches(root / 'proofs/theories'))
    print('\n'.join(found) or 'the list is complete', flush=True)
    if found:
        return 1
    try:
        compile_theories(root, folder)
    except subprocess.CalledProcessError as error:
        print(f'failed: {" ".join(error.cmd)}')
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
