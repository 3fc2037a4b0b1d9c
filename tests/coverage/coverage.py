#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which lines and branches do the tests reach, and why not the others?

Usage: coverage.py [--build FOLDER] [--suites SUITE...] [--jobs N] [--renew]

Builds with gcov, without optimization, in FOLDER (a temporary one unless it is named; kept if it is), runs the suites, and
counts for the rooms whose decisions are what users rely on: every line is to be reached, and 95 of 100 branches of each
room; rooms with less are named. Lines not reached are listed in unreached.txt: file, how many times the line and its
branches, the line's text, and why; a line or branch that is not there, or an entry that is reached now, is an error.
--renew writes the file anew, with "?" for reasons to be filled in. Conditions of DYD_INVARIANT count as lines only.
Takes the better part of an hour: no test of a suite.
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = pathlib.Path(__file__).with_name('unreached.txt')
ROOMS = ('predicate', 'legal', 'possible', 'delaunay', 'checker')
SUITES = ('predicate', 'skeleton', 'legal', 'possible', 'delaunay', 'checker', 'tolerance', 'engine')
LEAST = 0.95


def build_and_run(build, suites, jobs):
    if not (build / 'build.ninja').exists():
        subprocess.run(['meson', 'setup', build, ROOT, '-Db_coverage=true', '-Dbuildtype=debug', '-Dproofs=disabled',
                        '-Dpython=disabled'], check=True, stdout=subprocess.DEVNULL)
    for data in build.rglob('*.gcda'):
        data.unlink()
    suite = [word for name in suites for word in ('--suite', name)]
    subprocess.run(['meson', 'test', '-C', build, *suite, '--num-processes', str(jobs), '--timeout-multiplier', '20'],
                   check=True)


def gcov(build):
    """{file: {line: (count, [branch count])}}, added up over the armed library, which tests link, and the shared one of the
    command; where invariants make branches differ, those of the armed one count."""
    lines = collections.defaultdict(dict)
    for folder in (*build.glob('libdyadel_armed.a.p'), *build.glob('libdyadel.so*.p')):
        notes = [p for p in sorted(folder.glob('*.gcda')) if p.name.startswith(tuple(f'src_{room}_' for room in ROOMS))]
        for note in notes:
            told = subprocess.run(['gcov', '--json-format', '--stdout', '--branch-probabilities', note], cwd=build, check=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
            for entry in json.loads(told)['files']:
                name = os.path.relpath(os.path.realpath(build / entry['file']), ROOT)
                if name.split('/')[:1] == ['src'] and name.split('/')[1] in ROOMS:
                    add_lines(lines[name], entry['lines'])
    return lines


def add_lines(known, lines):
    for line in lines:
        count, branches = known.get(line['line_number'], (0, None))
        new = [branch['count'] for branch in line['branches']]
        if branches is None:
            branches = new
        elif len(branches) == len(new):
            branches = [a + b for a, b in zip(branches, new)]
        known[line['line_number']] = (count + line['count'], branches)


def invariants(text):
    """The numbers of lines that belong to DYD_INVARIANT(...);"""
    inside, numbers = False, set()
    for number, line in enumerate(text, 1):
        inside = inside or 'DYD_INVARIANT(' in line
        if inside:
            numbers.add(number)
        inside = inside and not line.rstrip().endswith(';')
    return numbers


def unreached(lines):
    """{(file, text): [lines, branches] not reached}, and for each file [lines, reached, branches, reached]."""
    missing, table = collections.defaultdict(lambda: [0, 0]), {}
    for name in sorted(lines):
        text = (ROOT / name).read_text(encoding='utf-8').splitlines()
        excluded, row = invariants(text), [0, 0, 0, 0]
        for number, (count, branches) in sorted(lines[name].items()):
            branches = [] if number in excluded else branches
            never = sum(1 for b in branches if b == 0)
            row = [row[0] + 1, row[1] + (count > 0), row[2] + len(branches), row[3] + len(branches) - never]
            if count == 0 or never:
                entry = missing[name, text[number - 1].strip()]
                entry[0] += count == 0
                entry[1] += never
        table[name] = row
    return missing, table


def read_list():
    """{(file, text): (lines, branches, why)}"""
    known = {}
    for line in LIST.read_text(encoding='utf-8').splitlines():
        if not line.startswith('#'):
            name, count, text, why = line.split('\t')
            known[name, text] = (*(int(n) for n in count.split('+')), why)
    return known


HEAD = '''# What the suites of coverage.py do not reach: file, lines + branches, the text of the line, why.
# Reasons were found by reading the code; "not constructed" says that nobody has shown that there is no such input.'''


def renew(missing, known):
    with LIST.open('w', encoding='utf-8') as out:
        print(HEAD, file=out)
        for (name, text), (lines, branches) in sorted(missing.items()):
            print(name, f'{lines}+{branches}', text, known.get((name, text), (0, 0, '?'))[2], sep='\t', file=out)


def report(table):
    """Prints the table; the rooms of which too little is reached."""
    rooms = collections.defaultdict(lambda: [0, 0, 0, 0])
    for name, row in sorted(table.items()):
        print(f'{name:44} lines {row[1]:5} of {row[0]:5}   branches {row[3]:5} of {row[2]:5}')
        room = rooms[name.split('/')[1]]
        rooms[name.split('/')[1]] = [a + b for a, b in zip(room, row)]
    for room, row in rooms.items():
        print(f'{room:12} lines {100 * row[1] / row[0]:6.2f} %   branches {100 * row[3] / row[2]:6.2f} %')
    return [f'src/{room}: {row[1]} of {row[0]} lines, {row[3]} of {row[2]} branches' for room, row in rooms.items()
            if row[1] < row[0] or row[3] < LEAST * row[2]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=pathlib.Path)
    parser.add_argument('--suites', nargs='+', default=SUITES)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--renew', action='store_true')
    parser.add_argument('--no-run', action='store_true', help='look at what an earlier run has left in FOLDER')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        build = (args.build or pathlib.Path(folder) / 'build').resolve()
        if not args.no_run:
            build_and_run(build, args.suites, args.jobs)
        missing, table = unreached(gcov(build))
    known = read_list()
    if args.renew:
        renew(missing, known)
        known = read_list()
    wrong = report(table)
    for key, count in missing.items():
        entry = known.get(key, (0, 0, '?'))
        if count[0] > entry[0] or count[1] > entry[1] or entry[2] in ('', '?'):
            wrong.append(f'{key[0]}: not reached, not explained ({count[0]} lines, {count[1]} branches): {key[1]}')
    wrong += [f'{name}: reached now, or gone: {text}' for name, text in known if (name, text) not in missing]
    print(*wrong, sep='\n')
    sys.exit(1 if wrong else 0)


main()
