#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which lines and branches do the tests reach, and why not the others?

Usage: coverage.py [--build FOLDER] [--rooms ROOM...] [--suites SUITE...] [--tests TEST...] [--jobs N] [--renew]

Builds with gcov, without optimization, in FOLDER (a temporary one unless it is named; kept if it is), runs the suites, and
counts for the rooms whose decisions are what users rely on: every line is to be reached or explained, and 95 of 100
branches of each room (93 of io/read); rooms with less are named. Lines not reached are listed in unreached.txt: file, how many times the line and its
branches, the line's text, and why; a line or branch that is not there, or an entry that is reached now, is an error.
An entry of a folder is about all lines in it that fit /EXPRESSION/ and have no entry of their own, each in the first
entry that it fits: more branches than it says are an error. --renew writes entries of lines anew, with "?" for reasons
to be filled in. Conditions of DYD_INVARIANT count as lines only. --rooms: only these, with --suites and --tests.
Takes the better part of an hour: no test of a suite.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = pathlib.Path(__file__).with_name('unreached.txt')
ROOMS = ('predicate', 'legal', 'possible', 'delaunay', 'checker', 'io/read')
SUITES = ('predicate', 'skeleton', 'legal', 'possible', 'delaunay', 'checker', 'tolerance', 'engine', 'io', 'fuzz')
TESTS = ('cli-tables', 'cli-columns', 'cli-input', 'cli-newcomer', 'cli-confidence', 'cli-files', 'cli-nearest', 'cli-plan', 'cli-sphere',
         'cli-globe_radii', 'cli-tiles')
LEAST = {'io/read': 0.93}  # others: 0.95


def build_and_run(build, suites, tests, jobs):
    if not (build / 'build.ninja').exists():
        subprocess.run(['meson', 'setup', build, ROOT, '-Db_coverage=true', '-Dbuildtype=debug', '-Dproofs=disabled',
                        '-Dpython=disabled'], check=True, stdout=subprocess.DEVNULL)
    for data in build.rglob('*.gcda'):
        data.unlink()
    suite = [word for name in suites for word in ('--suite', name)]
    for names in (suite, tests):
        subprocess.run(['meson', 'test', '-C', build, '--setup', 'full', *names, '--num-processes', str(jobs), '--timeout-multiplier', '20'],
                       check=True)


def gcov(build, rooms):
    """{file: {line: (count, [branch count])}}, added up over the armed library, which tests link, and the shared one of the
    command; where invariants make branches differ, those of the armed one count."""
    lines = collections.defaultdict(dict)
    for folder in (*build.glob('libdyadel_armed.a.p'), *build.glob('libdyadel.so*.p')):
        notes = [p for p in sorted(folder.glob('*.gcda')) if p.name.startswith(tuple(f'src_{room}_'.replace('/', '_') for room in rooms))]
        for note in notes:
            told = subprocess.run(['gcov', '--json-format', '--stdout', '--branch-probabilities', note], cwd=build, check=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
            for entry in json.loads(told)['files']:
                name = os.path.relpath(os.path.realpath(build / entry['file']), ROOT)
                if room_of(name, rooms):
                    add_lines(lines[name], entry['lines'])
    return lines


def room_of(name, rooms):
    return next((room for room in rooms if name.startswith(f'src/{room}/')), None)


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
        for (name, text), (lines, branches, why) in known.items():
            if name.endswith('/'):
                print(name, f'{lines}+{branches}', text, why, sep='\t', file=out)
        for (name, text), (lines, branches) in sorted(missing.items()):
            if group_of(known, name, text) and (name, text) not in known:
                continue
            print(name, f'{lines}+{branches}', text, known.get((name, text), (0, 0, '?'))[2], sep='\t', file=out)


def group_of(known, name, text):
    """The entry of a folder that the line fits; None: there is none."""
    return next((key for key in known if key[0].endswith('/') and name.startswith(key[0]) and re.search(key[1].strip('/'), text)), None)


def unexplained(missing, known):
    """Messages on lines and branches not reached that have no entry or one of less."""
    groups = collections.defaultdict(lambda: [0, 0])
    for key, count in missing.items():
        group = None if key in known else group_of(known, *key)
        entry = known.get(key, (0, 0, '?'))
        if group:
            groups[group] = [a + b for a, b in zip(groups[group], count)]
        elif count[0] > entry[0] or count[1] > entry[1] or entry[2] in ('', '?'):
            yield f'{key[0]}: not reached, not explained ({count[0]} lines, {count[1]} branches): {key[1]}'
    for key, count in groups.items():
        if count[0] > known[key][0] or count[1] > known[key][1]:
            yield f'{key[0]}: {key[1]}: {count[0]} lines and {count[1]} branches are not reached, and {known[key][0]} and {known[key][1]} explained'
    yield from (f'{name}: reached now, or gone: {text}' for name, text in known if (name, text) not in missing and (name, text) not in groups)


def report(table, which):
    """Prints the table; the rooms of which too little is reached."""
    rooms = collections.defaultdict(lambda: [0, 0, 0, 0])
    for name, row in sorted(table.items()):
        print(f'{name:44} lines {row[1]:5} of {row[0]:5}   branches {row[3]:5} of {row[2]:5}')
        room = room_of(name, which)
        rooms[room] = [a + b for a, b in zip(rooms[room], row)]
    for room, row in rooms.items():
        print(f'{room:12} lines {100 * row[1] / row[0]:6.2f} %   branches {100 * row[3] / row[2]:6.2f} %')
    return [f'src/{room}: {row[1]} of {row[0]} lines, {row[3]} of {row[2]} branches' for room, row in rooms.items()
            if row[3] < LEAST.get(room, 0.95) * row[2]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=pathlib.Path)
    parser.add_argument('--rooms', nargs='+', default=ROOMS)
    parser.add_argument('--suites', nargs='+', default=SUITES)
    parser.add_argument('--tests', nargs='+', default=TESTS)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--renew', action='store_true')
    parser.add_argument('--no-run', action='store_true', help='look at what an earlier run has left in FOLDER')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        build = (args.build or pathlib.Path(folder) / 'build').resolve()
        if not args.no_run:
            build_and_run(build, args.suites, args.tests, args.jobs)
        missing, table = unreached(gcov(build, args.rooms))
    known = {key: entry for key, entry in read_list().items() if args.renew or room_of(key[0], args.rooms)}
    if args.renew:
        renew(missing, known)
        known = read_list()
    wrong = report(table, args.rooms) + list(unexplained(missing, known))
    print(*wrong, sep='\n')
    sys.exit(1 if wrong else 0)


main()
