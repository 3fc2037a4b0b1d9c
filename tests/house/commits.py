#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the rules for commits (src/CONTRIBUTING.md) on all commits since they are kept.

Usage: commits.py ROOT   (prints every breach; exit status 1 when there is one, 77 without a history)
"""
import re
import subprocess
import sys

SINCE = '428cfdfad457ebcd6dab300ff842252163581a85'
NOT_ONE_THING = re.compile(r'(wip|fixup!|squash!|merge)\b', re.I)
FOLDER = re.compile(r'(^|[\s\'"(])/(tmp|home|work|root|usr|var|opt|mnt|Users)/')
SEEDED = [('Add a row', 1, 0), ('Add a row.', 1, 1), ('X' * 73, 1, 1), ('WIP: boxes', 1, 1), ('fixup! Add a row', 1, 1), ('added', 1, 1),
          ("Merge branch 'main' of /tmp/h/poly", 2, 3), ('Read /home/me/points.txt', 1, 1), ('Mergesort pairs', 1, 0)]


def breaches(subject, parents):
    if len(subject) > 72:
        yield f'{len(subject)} characters, 72 are allowed'
    if not subject[:1].isupper() and not NOT_ONE_THING.match(subject):
        yield 'does not begin with a capital letter'
    if subject.endswith('.'):
        yield 'ends with a full stop'
    if NOT_ONE_THING.match(subject):
        yield 'is not a commit of its own'
    if parents > 1:
        yield 'is a merge: rebase'
    if FOLDER.search(subject):
        yield 'names a folder of one machine'


def main():
    for subject, parents, count in SEEDED:
        if len(list(breaches(subject, parents))) != count:
            sys.exit(f'commits.py does not judge "{subject}" as it should')
    git = ['git', '-C', sys.argv[1]]
    if subprocess.run([*git, 'cat-file', '-e', SINCE], check=False, capture_output=True).returncode:
        print('no history since', SINCE)
        sys.exit(77)
    log = subprocess.run([*git, 'log', '--format=%h%x09%P%x09%s', SINCE + '..HEAD'], check=True, capture_output=True, text=True).stdout
    bad = 0
    for line in log.splitlines():
        name, parents, subject = line.split('\t', 2)
        for what in breaches(subject, len(parents.split())):
            print(f'{name} "{subject}": {what}')
            bad += 1
    print(len(log.splitlines()), 'commits,', bad, 'breaches')
    sys.exit(bad > 0)


if __name__ == '__main__':
    main()
