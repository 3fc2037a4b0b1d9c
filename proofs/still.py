#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The outcome fixpoint with boxes [CERT-8]: dyadel-proved --still, and `dyadel verify --points` with and without --proved.

Usage: still.py ROOT DYADEL_PROVED DYADEL [COUNT]

On COUNT random inputs (default 60) of each kind: where the outcome is said to be proved, rectangles that may be narrowed are,
and no pair changes; both checkers say the same, with points given; dyadel hands over those sites that stay, and no other;
a list that is none is refused.
"""
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

from checker import ALL, NOT_ALL, SEED, Checkers

NOT_A_LIST = 2
PROVED = 'checked: the outcome fixpoint'

# The pair 0 1 is an edge of every choice, and has a witness once site 5 is known better; no face of an open pair has site 5.
BEYOND = ['[-2.930872,82.930872] 0', '40 -18.615568', '40 41.083296', '4.06152 -28.67108', '75.93848 -28.67108',
          'sqrt(1600.8001) -sqrt(2013.006097621)', '-11.404368 5.585752', '97.61944 -0.96452', '40 -62.773048']

# Two boxes with open pairs, and two rings of points around them.
FAR = '[-2,-1] [0,1]\n[-1.5,-0.5] [0.5,1.5]\n' + ''.join(f'{x} {y}\n' for x, y in (
    (5, 0), (3, 4), (-2, 5), (-5, 2), (-4, -4), (1, -5), (10, 2), (7, 8), (-1, 10), (-8, 7), (-10, -2), (-6, -8), (3, -9),
    (8, -6)))


def spelled(box):
    return f'[{box[0]:.6f},{box[1]:.6f}] [{box[2]:.6f},{box[3]:.6f}]'


def text_of(boxes):
    return ''.join(f'{spelled(box)}\n' for box in boxes)


def statement(text):
    """The legal pairs of a certificate, and the open ones."""
    lines = text.split('\n')
    first = next(k for k, line in enumerate(lines) if line.startswith('legal '))
    legal = [line.split(' ')[:2] for line in lines[first + 1:first + 1 + int(lines[first].split(' ')[1])]]
    return legal, [line.split(' ')[1:] for line in lines if line[:2] in ('o ', 't ')]


class Both(Checkers):
    """With points, and with lists."""

    def with_list(self, text, still):
        file = self.folder / 'still.txt'
        file.write_text(still)
        return subprocess.run([self.proved, self.write(text), '--still', file], check=False, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)

    def write(self, text):
        file = self.folder / 'listed.txt'
        file.write_text(text)
        return file

    def verify(self, text, points, *options):
        """By C, and by the proved checker."""
        source = self.folder / 'verified.txt'
        source.write_text(points)
        command = [self.dyadel, 'verify', '--points', source, *options, self.write(text)]
        return [subprocess.run(command + more, check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                for more in ([], ['--proved'])]


def listed(sites):
    return ''.join(f'{k}\n' for k in sites)


def narrower(rng, box):
    """A part of the box."""
    x0, x1 = sorted(rng.uniform(box[0], box[1]) for _ in range(2))
    y0, y1 = sorted(rng.uniform(box[2], box[3]) for _ in range(2))
    return tuple(round(z, 6) for z in (x0, x1, y0, y1))


def scattered(rng):
    """Points; a few large boxes that stay; small boxes that may be narrowed: all, and how many of these come last."""
    small = rng.choice((1, 1, 2, 4))
    boxes = [(x, x, y, y) for x, y in ((rng.uniform(0, 9), rng.uniform(0, 9)) for _ in range(rng.randrange(20, 70)))]
    for count, width in ((rng.randrange(1, 4), rng.choice((0.3, 0.6, 1))), (small, rng.choice((0.02, 0.1, 0.3)))):
        for _ in range(count):
            x, y, flat = rng.uniform(0, 9), rng.uniform(0, 9), rng.choice((0, 0.1, 1))
            boxes.append((x, x + width, y, y + flat * width))
    return [tuple(round(z, 6) for z in box) for box in boxes], small


def sandwich(rng):
    """A flat box between two points, the lower one with a narrow box beneath it that may be narrowed."""
    a, c, wide, thin = rng.uniform(0.5, 2.5), rng.uniform(0.5, 4), rng.uniform(2, 6), rng.uniform(0, 0.2)
    side, top = rng.uniform(0.8, 5), a + rng.uniform(0.3, 2.5)
    point = lambda x, y: (x, x, y, y)  # noqa: E731
    boxes = [(5 - wide, 5 + wide, 0, 0), point(5, -a), point(5, rng.uniform(4, 12)), point(5 - side, -a - c),
             point(5 + side, -a - c), point(5 - wide - rng.uniform(0.5, 4), rng.uniform(-1, 1)),
             point(5 + wide + rng.uniform(0.5, 4), rng.uniform(-1, 1)), point(5, -top - rng.uniform(3, 6)),
             (5 - thin, 5 + thin, -top - rng.uniform(0.2, 1.5), -top)]
    return [tuple(round(z, 6) for z in box) for box in boxes], 1


def try_narrowed(both, count):
    """Each outcome reported as a fixpoint is one."""
    rng = random.Random(SEED)
    proved = tried = 0
    for kind, times in ((scattered, 3 * count), (sandwich, 4 * count)):
        for number in range(times):
            boxes, small = kind(rng)
            stay = len(boxes) - small
            text = both.certificate(text_of(boxes))
            if '\noutcome fixpoint\n' not in text:
                continue
            answer, tried = both.with_list(text, listed(range(stay))), tried + 1
            if PROVED not in answer.stdout:
                continue
            proved += 1
            for _ in range(4):
                finer = boxes[:stay] + [narrower(rng, box) for box in boxes[stay:]]
                if statement(both.certificate(text_of(finer))) != statement(text):
                    yield f'{kind.__name__} {number} is no fixpoint, {finer}:\n{text}'
                    break
    print(f'seed {SEED}: {tried} results with boxes that may be narrowed, {proved} proved to be fixpoints')
    if proved * 40 < tried or tried < count:
        yield 'hardly any fixpoint was proved, or tried'


def mixed(rng):
    """Points, boxes close together, and computed points away from them, as far as not."""
    middles = [(rng.uniform(1, 8), rng.uniform(1, 8)) for _ in range(rng.randrange(1, 4))]
    rows = []
    for x, y in middles:
        width = rng.choice((0.3, 0.6, 1))
        for _ in range(rng.randrange(1, 4)):
            a, b = x + width * rng.uniform(-0.5, 0.5), y + width * rng.uniform(-0.5, 0.5)
            rows.append(spelled((a, a + width, b, b + width * rng.choice((0.1, 1)))))
    away, share = rng.choice((0.8, 2, 4)), rng.choice((0.05, 0.2, 0.5))
    for _ in range(rng.randrange(12, 80)):
        x, y = rng.uniform(0, 9), rng.uniform(0, 9)
        near = min(max(abs(x - a), abs(y - b)) for a, b in middles)
        rows.append(f'sqrt({x * x:.4f}) {y:.4f}' if near > away and rng.random() < share else f'{x:.4f} {y:.4f}')
    return ''.join(f'{row}\n' for row in rows)


def differences(both, name, text, points, *options):
    """The exit status, whether the outcome is proved; where the two differ."""
    here, there = both.verify(text, points, *options)
    said = [(answer.returncode, PROVED in answer.stdout) for answer in (here, there)]
    both_say = f'verify {here.stdout}{here.stderr}--proved {there.stdout}{there.stderr}'
    return *said[1], [] if said[0] == said[1] else [f'{name}: {both_say}{points}']


def try_mixed(both, count):
    """Both checkers say the same."""
    rng = random.Random(SEED)
    proved = fixpoints = 0
    for number in range(3 * count):
        points = mixed(rng)
        text = both.certificate(points)
        _, is_proved, found = differences(both, f'mixed input {number}', text, points)
        proved, fixpoints = proved + (is_proved and 'sqrt' in points), fixpoints + ('\noutcome fixpoint\n' in text)
        yield from found
    print(f'seed {SEED}: {fixpoints} fixpoints of mixed inputs, {proved} proved although points can be narrowed')
    if proved * 20 < fixpoints:
        yield 'hardly any fixpoint was proved'


def try_cases(both, root):
    """Airports as boxes; goals on bounds; a point that is computed, and in no open face; ties."""
    table = (root / 'tests/data/airports.csv').read_text()
    columns = ('--plane', '--columns', 'longitude,latitude', '--radius')
    beyond = ''.join(f'{row}\n' for row in BEYOND)
    kite = '-3 0\n3 0\n0 1\n[0,0.1] [-9.5,-8.5]\nsqrt(0.02) 12\n0.2 3\n'
    turned = ''.join(reversed(kite.splitlines(keepends=True)))
    tangle = '[0,4] [0,4]\n[1,5] [1,5]\nsqrt(4.5) 2\n20 0\n-9 -12\n-10 14\n'
    for name, points, making, reading, goal, status in [
            ('radius 0.05', table, columns + ('0.05',), columns + ('0.05',), 'decided', ALL),
            ('radius 0.1', table, columns + ('0.1',), columns + ('0.1',), 'decided', ALL),
            ('boxes', FAR, (), (), 'decided', ALL),
            ('boxes, area', FAR, (), (), 'area 60', ALL),
            ('boxes, hausdorff', FAR, (), (), 'hausdorff 60', ALL),
            ('boxes, voronoi area', FAR, (), (), 'voronoi area 60', ALL),
            ('a computed point in an open face', FAR + 'sqrt(0.3) 0.2\n', (), (), 'decided', NOT_ALL),
            ('a computed point in pairs with both', kite, (), (), 'decided', NOT_ALL),
            ('the same, and the first', turned, (), (), 'decided', NOT_ALL),
            ('a computed point in pairs with both ends of a tie', kite.replace('[0,0.1] [-9.5,-8.5]', '0 -9'), (), (), 'decided', ALL),
            ('a computed point in open pairs only', tangle, (), (), 'decided', NOT_ALL),
            ('a computed point far away', FAR + 'sqrt(300) 1\n-sqrt(500) 9\n', (), (), 'decided', ALL),
            ('a computed point far away, area', FAR + 'sqrt(300) 1\n-sqrt(500) 9\n', (), (), 'area 60', NOT_ALL),
            ('a computed point, voronoi area', FAR + 'sqrt(300) 1\n-sqrt(500) 9\n', (), (), 'voronoi area 60', NOT_ALL),
            ('beyond', beyond, ('--start-bits', '1'), (), 'decided', NOT_ALL)]:
        text = re.sub(r'\noutcome .*\ngoal .*\n', f'\noutcome fixpoint\ngoal {goal}\n', both.certificate(points, *making))
        answer, proved, found = differences(both, name, text, points, *reading)
        yield from found
        if answer != status or proved != (status == ALL):
            yield f'{name}: exit status {answer}, not {status}'


def try_incomplete(both):
    """A pair that is missing may be open or not: neither is known."""
    points = FAR + 'sqrt(300) 1\n-sqrt(500) 9\n'
    text = both.certificate(points)
    line = f'o {" ".join(statement(text)[1][0])}\n'
    boxes = int(re.search(r'\nboxes (\d+)\n', text)[1])  # they prove nothing where a pair is left over
    left_out = text.replace(line, '').replace(f'\nboxes {boxes}\n', '\n').replace('\nunproved 0\n', f'\nunproved {boxes + 1}\n')
    answer, proved, found = differences(both, 'a pair left out', left_out, points)
    yield from found
    if answer != NOT_ALL or proved:
        yield f'with a pair left out: exit status {answer}'


def try_lists(both):
    """Without a site of an open pair, or a box in a pair with one, the outcome is not proved.

    A text that is not a list is refused."""
    text = both.certificate('0 0\n5 0\n0 4\n6 [5,6]\n[3,4] [2,5]\n9 9\n[20,21] 3\n')
    everybody = list(range(7))
    answers = {k: PROVED in both.with_list(text, listed(everybody[:k] + everybody[k + 1:])).stdout for k in everybody}
    boxes = [3, 4, 6]  # points cannot be narrowed, whatever is said of them
    opened = {int(k) for pair in statement(text)[1] for k in pair}
    if PROVED not in both.with_list(text, listed(everybody)).stdout or not opened & set(boxes):
        yield 'a fixpoint of boxes is not proved'
    for k in everybody:
        if answers[k] and k in opened and k in boxes or not answers[k] and k not in boxes:
            yield f'the outcome without site {k}: {answers[k]}'
    for wrong in ('1\n0\n', '1\n1\n', '7\n', '-1\n', '0 1\n', '0', ' 0\n', '00\n', '+1\n', '0\n\n1\n', 'all\n', '0\r\n'):
        answer = both.with_list(text, wrong)
        if answer.returncode != NOT_A_LIST or answer.stdout or ': no list of sites: ' not in answer.stderr:
            yield f'a list {wrong!r}: {answer}'
    for args in ([], ['--still'], [both.write(text), '--still'], ['-', '--still', '-'], [both.write(text), 'still', 'x']):
        answer = subprocess.run([both.proved, *args], check=False, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if answer.returncode not in (NOT_A_LIST, 1) or answer.stdout:
            yield f'arguments {args}: {answer}'


def try_handed(both):
    """Instead of the checker a script that prints its input, next to a copy of the command, where it is found first."""
    folder = both.folder / 'instead'
    folder.mkdir()
    script = folder / 'dyadel-proved'
    script.write_text('#!/bin/sh\necho "$2 $3"\ncat\n')
    script.chmod(0o755)
    library = os.environ.get('LD_LIBRARY_PATH', '')
    os.environ['LD_LIBRARY_PATH'] = f'{both.dyadel.parent.parent.parent}:{library}'  # the copy is not where its library is
    command, both.dyadel = both.dyadel, shutil.copy(both.dyadel, folder)
    rows = ['0 0', '[1,2] 5', 'sqrt(2) 0', '1/3 7', 'pi [3,4]', 'sqrt(4) 1', '0 sqrt(3)+9', '2 3']
    exact = rows[:-1] + ['min(2,sqrt(5)) 3']
    for made, read, stay in ((rows, rows, [0, 1, 3, 5, 7]), (rows, exact, [0, 1, 3, 5, 7]),
                             (rows[:-1] + ['[2,2.0000000001] 3'], exact, [0, 1, 3, 5])):  # exact in a wider rectangle
        answer = both.verify(both.certificate('\n'.join(made)), '\n'.join(read))[1]
        if answer.stdout.split('\n')[:len(stay) + 1] != ['--still -', *map(str, stay)] or 'compared' not in answer.stdout:
            yield f'handed over, not {stay}: {answer}'
    if both.verify(both.certificate('\n'.join(rows)), '\n'.join(rows[:-1]))[1].returncode != 1:
        yield 'fewer points than sites are accepted'
    both.dyadel, os.environ['LD_LIBRARY_PATH'] = command, library


def main():
    root, proved, dyadel = (pathlib.Path(arg).resolve() for arg in sys.argv[1:4])
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 60
    os.environ['PATH'] = f'{proved.parent}:{os.environ["PATH"]}'
    with tempfile.TemporaryDirectory() as folder:
        both = Both(proved, dyadel, pathlib.Path(folder))
        found = list(try_cases(both, root)) + list(try_incomplete(both)) + list(try_lists(both)) + list(try_handed(both))
        found += list(try_narrowed(both, count)) + list(try_mixed(both, count))
    print('\n'.join(found) or 'no fault')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
