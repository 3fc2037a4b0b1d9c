#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel-proved, the checker of certificates that is proved in Coq, against `dyadel verify`.

Usage: checker.py ROOT DYADEL_PROVED DYADEL [COUNT]

On certificates of the airports and of COUNT random inputs (default 70), on mutants of these, on forgeries, chains and
diagrams among them, and on texts in another spelling: a certificate that verify accepts is accepted, and one that is
proved entirely is so by verify, too; each is accepted or rejected as it must be; of ties at least as much as verify
proves; parts that it does not know are named. The time grows little faster than the number of sites, so do the
triangles that cover the plane.
"""
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile
from fractions import Fraction

SEED = 1
ALL, NOT_ALL, REJECTED = 0, 3, 1
COVER_GROWTH = 1.3


def gaps(answer):
    """Parts reported as not proved, except ties: of them verify proves fewer."""
    rows = answer.stdout.splitlines()
    return [row for row in rows if row.startswith('not proved: ') and 'pairs are ties' not in row]


class Checkers:
    def __init__(self, proved, dyadel, folder):
        self.proved, self.dyadel, self.folder = proved, dyadel, folder
        self.tried = self.rejected = self.all = 0

    def certificate(self, points, *options, command='delaunay'):
        """The text of a certificate; every outcome with a result has one."""
        source, target = self.folder / 'points.txt', self.folder / 'certified.txt'
        source.write_text(points)
        done = subprocess.run([self.dyadel, command, '--quiet', '-o', '/dev/null', '--certificate', target, *options,
                               source], check=False)
        assert done.returncode in (0, 3, 4), done
        return target.read_text()

    def ask(self, *command, text):
        file = self.folder / 'asked.txt'
        file.write_text(text)
        return subprocess.run([*command, file], check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def seconds(self, points):
        """Of the processor, that the proved checker takes for a certificate of points that it proves all of."""
        text = self.certificate(points)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        assert self.ask(self.proved, text=text).returncode == ALL
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    def faults(self, text, name):
        """Where the two differ that must not; counts."""
        here, there = self.ask(self.proved, text=text), self.ask(self.dyadel, 'verify', text=text)
        self.tried += 1
        self.all += here.returncode == ALL
        self.rejected += here.returncode == REJECTED
        if here.returncode not in (ALL, NOT_ALL, REJECTED):
            yield f'{name}: exit status {here.returncode}: {here.stderr}'
        elif here.returncode == ALL and (there.returncode == REJECTED or gaps(there)):
            yield f'{name}: all proved, but verify says: {there.stdout.splitlines()[:1]}{there.stderr}\n{text}'
        elif here.returncode == REJECTED and there.returncode != REJECTED:
            yield f'{name}: {here.stderr}but verify accepts:\n{text}'
        elif here.returncode == REJECTED and (here.stdout or ': rejected: ' not in here.stderr):
            yield f'{name}: rejected without a word: {here}'


def coordinate(rng, kind):
    number = rng.randrange(-40, 41) if kind % 2 else rng.randrange(-10**6, 10**6) / 1024
    if kind == 2:
        return f'[{number},{number + rng.randrange(200)}]'
    if kind == 3:
        return f'{number}/{rng.choice((1, 3, 7, 10))}'
    if kind == 4:
        return f'{number}+-0.001'
    return f'sqrt({abs(number)})' if kind == 5 else f'{number}'


def points(rng):
    """A points file: exact, tied, rational, boxes, reals, mixed."""
    kind = rng.randrange(7)
    count = rng.randrange(40)
    return ''.join(f'{coordinate(rng, kind if kind < 6 else rng.randrange(6))} '
                   f'{coordinate(rng, kind if kind < 6 else rng.randrange(6))}\n' for _ in range(count))


def section(lines, name):
    """Numbers of the first line of a section and of the one behind the last."""
    first = next(k for k, line in enumerate(lines) if line.startswith(f'{name} ')) + 1
    return first, first + int(lines[first - 1].split(' ')[1])


def moved_into_disc(rng, text):
    """The text with one site put where the witness of a pair of others is; None when there are not enough."""
    lines = text.split('\n')
    first, last = section(lines, 'legal')
    sites, end = section(lines, 'sites')
    if first == last or end - sites < 3:
        return None
    i, j, x, y = lines[rng.randrange(first, last)].split(' ')
    others = [k for k in range(sites, end) if k - sites not in (int(i), int(j)) and not lines[k].startswith('=')]
    if not others:
        return None
    lines[rng.choice(others)] = f'{x} {y}'
    return '\n'.join(lines)


def mutants(rng, text):
    """Texts with one number of a site, of a pair or of another line changed, two lines exchanged, one doubled or lost."""
    lines = text.split('\n')
    first, last = section(lines, 'sites')[0], section(lines, 'legal')[1]
    for _ in range(7):
        if last - first < 3:
            return
        k, other = rng.randrange(first, last), rng.randrange(first, last)
        if rng.randrange(5) == 0:
            k = rng.randrange(len(lines) - 1)
        changed, words, way = list(lines), lines[k].split(' '), rng.randrange(8)
        if way == 0:
            changed[k], changed[other] = changed[other], changed[k]
        elif way == 1:
            changed[k:k + 1] = rng.choice(([], [lines[k], lines[k]]))
        else:
            w = rng.randrange(len(words))
            words[w] = rng.choice(('0', '1', '-3*2^1', words[-1], words[0], words[w] + '1', '7*2^40'))
            changed[k] = ' '.join(words)
        if changed != lines:
            yield '\n'.join(changed)


def spellings(text):
    """The same or nearly, in words that the format does not have."""
    yield text[:-1]
    yield text + '\n'
    yield text.replace('\n', '\r\n')
    yield text.replace('capped no', 'capped no ')
    yield text.replace('outcome decided', 'outcome  decided')
    yield text.replace('goal decided', 'goal decided 3')
    yield text.replace('\nend\n', '\n')
    yield text.replace('\n0 0\n', '\n3/9 0\n', 1)
    yield text.replace('\n0 0\n', '\n0+0 0\n', 1)
    first = section(text.split('\n'), 'legal')[0]
    for wrong in ('+1', '01', '-0', '1.0', '0x1', '2*2^1', '1*2^0', '1*2^1048577', '1*2^99999999999999999999', '1_0', '', '1*3^1'):
        lines = text.split('\n')
        lines[first] = ' '.join(lines[first].split(' ')[:3] + [wrong])
        yield '\n'.join(lines)


def try_random(both, count):
    rng = random.Random(SEED)
    for number in range(count):
        text = both.certificate(points(rng), '--max-bits', '200')
        if both.ask(both.proved, text=text).returncode == REJECTED:
            yield f'input {number}: rejected:\n{text}'
        yield from both.faults(text, f'input {number}')
        for mutant in mutants(rng, text):
            yield from both.faults(mutant, f'mutant of input {number}')
        moved = moved_into_disc(rng, text)
        if moved and both.ask(both.proved, text=moved).returncode != REJECTED:
            yield f'input {number}: accepted with a site in the disc of a witness:\n{moved}'
    print(f'seed {SEED}: {count} inputs, {both.tried} certificates and mutants: {both.all} all proved, {both.rejected} rejected')
    if both.rejected * 4 < both.tried or both.all * 16 < both.tried:
        yield 'hardly anything is rejected, or hardly anything proved'


def forgeries(path):
    """The texts of the file, and the remark on each."""
    text = []
    for line in path.read_text().splitlines(keepends=True):
        if line.startswith('---- '):
            yield ''.join(text), line.strip()
            text = []
        else:
            text.append(line)


def forged_chains(text, sites):
    """The text with one chain changed: a blocker lost or replaced, a ray lost or turned."""
    lines = text.split('\n')
    for at, line in enumerate(lines):
        words = line.split(' ')
        if words[0] != 'n':
            continue
        blockers = range(5, len(words), 3)
        turned = [word[1:] if word[0] == '-' else f'-{word}' if word != '0' else word for word in words]
        changed = [words[:k] + words[k + 3:] for k in blockers] + [words[:3] + words[6:]]
        changed += [words[:-2] + turned[-2:], words[:3] + turned[3:5] + words[5:], words[:8] + words[5:6] + words[9:]]
        changed.append(words[:8] + words[5:6] + words[3:5])  # there and back: blocked, but it separates nothing
        changed += [words[:k] + [str(other)] + words[k + 1:] for k in blockers for other in range(sites)]
        yield from ('\n'.join(lines[:at] + [' '.join(some)] + lines[at + 1:]) for some in changed)


def try_chains(both, path):
    """Both refuse the same chains."""
    tried = refused = 0
    for text, said in forgeries(path):
        yield from both.faults(text, f'forgery before {said}')
        if not said.startswith('---- accepted') or '\nn ' not in text:
            continue
        first, last = section(text.split('\n'), 'sites')
        for forged in [text, *forged_chains(text, last - first)]:
            here, there = both.ask(both.proved, text=forged), both.ask(both.dyadel, 'verify', text=forged)
            tried, refused = tried + 1, refused + (there.returncode == REJECTED)
            if (here.returncode == REJECTED) != (there.returncode == REJECTED):
                yield f'a chain: {here.returncode} {here.stderr}, verify {there.returncode} {there.stderr}:\n{forged}'
    print(f'{tried} certificates with chains, of which {refused} are refused')
    if tried < 50 or refused * 2 < tried:
        yield 'hardly any chain was tried, or refused'


def mixed(rng):
    """Points of a lattice, and boxes among them."""
    size = rng.randrange(2, 6)
    lattice = [(x, y) for x in range(size) for y in range(size) if rng.randrange(8)]
    boxes = [(rng.randrange(-8, 8 * size + 8) / 8 + 1 / 16, rng.randrange(-8, 8 * size + 8) / 8 + 1 / 16, rng.choice((1, 8, 64)))
             for _ in range(rng.randrange(1, 4))]
    return ''.join(f'{x} {y}\n' for x, y in lattice) + ''.join(f'[{x},{x + 1 / w}] [{y},{y + 1 / w}]\n' for x, y, w in boxes)


def left_ties(answer):
    """How many ties are said not to be proved."""
    return int((re.search(r'not proved: that (\d+) pairs are ties', answer.stdout) or (0, 0))[1])


def as_tie(text, line):
    """The text with one line on a pair that says it is a tie."""
    return text.replace(f'\n{line}\n', f'\nt {line[2:]}\n')


def try_parts(both, path):
    """Of discs, graphs and places this checker knows nothing: it names them, and never says that all is proved."""
    named = 0
    for text, said in forgeries(path):
        here = both.ask(both.proved, text=text)
        if here.returncode not in (NOT_ALL, REJECTED) or (here.returncode == REJECTED) != ('rejected: ' in here.stderr):
            yield f'{here}: {said}\n{text}'
        if said.startswith('---- accepted'):
            what = re.search('^(discs|graph|nearest) ', text, re.M)[1]
            words = {'discs': 'for points in discs', 'graph': 'the graph', 'nearest': 'which sites are nearest'}[what]
            if here.returncode != NOT_ALL or not any(words in gap for gap in gaps(here)):
                yield f'{what} are not named: {here}\n{text}'
            named += 1
    if named < 50:
        yield 'hardly any part was named'


def try_ties(both, count):
    """Ties beside boxes: those are proved that verify proves, and more; the outcome, too; of a pair that is none it is not said."""
    rng = random.Random(SEED)
    ties = forged = still = 0
    for number in range(count):
        text = both.certificate(mixed(rng))
        here, there = both.ask(both.proved, text=text), both.ask(both.dyadel, 'verify', text=text)
        lines = text[text.index('\npairs\n'):].split('\n')
        ties += sum(line.startswith('t ') for line in lines)
        still += 'checked: the outcome fixpoint' in here.stdout
        if left_ties(here) > left_ties(there):
            yield f'ties of input {number}: {left_ties(here)} left, by verify {left_ties(there)}:\n{text}'
        if 'checked: the outcome' in there.stdout and 'checked: the outcome' not in here.stdout:
            yield f'the outcome of input {number} is not proved, but verify says it is:\n{text}'
        if any(line.startswith('o ') for line in lines) and 'checked: the outcome fixpoint' in here.stdout:
            yield f'the outcome of input {number} is proved with open pairs:\n{text}'
        for line in lines:
            if line.startswith('o '):
                forged += 1
                if left_ties(both.ask(both.proved, text=as_tie(text, line))) != left_ties(here) + 1:
                    yield f'a tie that is none is proved, {line}:\n{text}'
    print(f'seed {SEED}: {count} mixed inputs, {ties} ties, {forged} forged ones, {still} times the outcome fixpoint')
    if ties < 5 * count or forged < count or still * 8 < count:
        yield 'hardly any ties were tried, or forged, or hardly any outcome was a fixpoint'


def try_forged_ties(both):
    """A tie that is stated of a legal pair, of an illegal one, of one with a box: refused, or not proved."""
    unit = '0 0\n1 0\n0 1\n1 1\n'
    text = re.sub(r'\n(area|hausdorff) \S+', r'\n\1 none', both.certificate(unit + '9 [1,2]\n'))
    for line, status in (('0 1', REJECTED), ('0 4', NOT_ALL), ('1 4', REJECTED)):
        pairs = [row for row in text.split('\n') if row.startswith('t ')] + [f't {line}']
        pairs.sort(key=lambda row: [int(word) for word in row[2:].split(' ')])
        head, tail = text.split('\npairs\n')
        tail = '\n'.join(row for row in tail.split('\n') if not row.startswith('t '))
        answer = both.ask(both.proved, text='\n'.join([head, 'pairs', *pairs, tail]))
        if answer.returncode != status or (status == NOT_ALL and left_ties(answer) != 1):
            yield f'tie {line}: {answer}'


def try_fixpoint(both):
    """Ties and a box: a fixpoint, but for a goal on a bound, or when a tie is not listed."""
    text = both.certificate('0 0\n1 0\n0 1\n1 1\n5 [0.5,0.53125]\n')
    for forged, proved in ((text, True), (text.replace('\ngoal decided\n', '\ngoal area 90\n'), False),
                           (without_line(text, 't', 0), False)):
        answer = both.ask(both.proved, text=forged)
        if answer.returncode == REJECTED or ('checked: the outcome fixpoint' in answer.stdout) != proved:
            yield f'fixpoint: {answer}'


def try_certified(both):
    """While pairs are not proved: bounds of the diagram are, and with them the outcome; not those of the triangulation. A
    distance that is said to be unproved proves nothing."""
    ties = '0 0\n1 0\n0 1\n1 1\n5 [0.5,0.53125]\n'
    for command, goal, loose, proved in (('voronoi', 'area:-6', False, True), ('voronoi', 'hausdorff:-4', False, True),
                                         ('voronoi', 'area:-6', True, True), ('voronoi', 'hausdorff:-4', True, False),
                                         ('delaunay', 'area:-6', False, False), ('delaunay', 'hausdorff:-4', False, False)):
        text = without_line(both.certificate(ties, '--until', goal, command=command), 't', 0)
        text = re.sub(r'\n(distance .*)\n', r'\n\1 unproved\n', text) if loose else text
        answer = both.ask(both.proved, text=text)
        said = ['not proved: that pairs among' in answer.stdout, 'checked: the outcome certified' in answer.stdout,
                'not proved: the outcome certified' in answer.stdout, 'not proved: the distance of' in answer.stdout]
        if answer.returncode != NOT_ALL or said != [True, proved, not proved, loose]:
            yield f'certified, {command} {goal}: {answer}'


# A witness of 0 3 whose circle also goes through 1 and 2.
TOUCHED = ('dyadel certificate 1\noutcome fixpoint\ngoal decided\ncapped no\nsites 4\n0 0\n1 0\n0 1\n1 1\nlegal 1\n'
           '0 3 1*2^-1 1*2^-1\nplaces 0\nbridges 0\ncorners 0\npairs\ntriangles 0\nunproved 5\narea none\nhausdorff none\nend\n')


def without_line(text, kind, number):
    """The text without one of the lines on pairs of a kind."""
    lines = text.split('\n')
    places = [k for k, line in enumerate(lines) if line.startswith(f'{kind} ')]
    del lines[places[number]]
    return '\n'.join(lines)


def halved(text, name):
    """The text with half of the bound, which is m*2^e, e no 1."""
    return re.sub(rf'\n{name} (\d+)\*2\^(-?\d+)\n', lambda m: f'\n{name} {m[1]}*2^{int(m[2]) - 1}\n', text)


def try_cases(both, root):
    """Certificates whose verdict is known."""
    table = (root / 'tests/data/airports.csv').read_text()
    columns = ('--columns', 'longitude,latitude')
    crowd = both.certificate(table, *columns, '--radius', '0.05')
    grid = both.certificate(''.join(f'{x} {y}\n' for x in range(5) for y in range(5)))
    triangle, square = '0 0\n5 0\n0 4\n', '0 0\n5 0\n0 4\n6 [5,6]\n'
    for status, said, text in [
            (ALL, '10112 legal pairs', both.certificate(table, *columns)),
            (NOT_ALL, '10109 legal pairs', both.certificate(table, *columns, '--measured')),
            (NOT_ALL, 'open: 13100 ', crowd),
            (NOT_ALL, 'checked: all pairs that are not listed are illegal', crowd),
            (NOT_ALL, 'checked: the bounds of area', crowd),
            (NOT_ALL, 'not proved: that pairs among', without_line(crowd, 'o', 5000)),
            (NOT_ALL, 'not proved: that pairs among', without_line(crowd, 'o', 9000)),
            (REJECTED, '', crowd.replace('\narea ', '\narea -')),
            (REJECTED, '', halved(crowd, 'area')),
            (REJECTED, '', halved(crowd, 'hausdorff')),
            (ALL, 'checked: all pairs that are not listed are illegal', grid),
            (NOT_ALL, 'not proved: that pairs among', without_line(grid, 't', 7)),
            (NOT_ALL, 'the numbers of triangles', grid.replace('\ntriangles 0\n', '\ntriangles 1\n')),
            (REJECTED, '', halved(grid, 'hausdorff')),
            (ALL, 'checked: the distance of undetermined', both.certificate(square, command='voronoi')),
            (ALL, 'the undetermined area of the Voronoi diagram, by 4 polygons', both.certificate(square, command='voronoi')),
            (ALL, 'checked: the outcome certified', both.certificate(square, '--until', 'area:-6', command='voronoi')),
            (ALL, 'checked: the outcome certified', both.certificate(square, '--until', 'hausdorff:-4', command='voronoi')),
            (REJECTED, '', both.certificate(square, '--until', 'area:-6', command='voronoi').replace('area -6', 'area 40')),
            (REJECTED, '', both.certificate(square, '--until', 'hausdorff:-4', command='voronoi').replace('ff -4', 'ff 400')),
            (ALL, 'bounds of area', both.certificate(square)),
            (ALL, 'the outcome certified', both.certificate('sqrt(2) 0\n1 [5,6]\n-4 pi\n7 -2\n', '--until', 'hausdorff:-4')),
            (ALL, 'the outcome decided', both.certificate(triangle)),
            (ALL, '0 legal pairs', both.certificate('1 1/3\n')),
            (ALL, '1 legal pairs', both.certificate('1 1/3\n[1,2] 2\n')),
            (ALL, 'the outcome fixpoint', both.certificate('sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n')),
            (REJECTED, '', both.certificate(square).replace('\narea ', '\narea -')),
            (REJECTED, '', TOUCHED)]:
        answer = both.ask(both.proved, text=text)
        print(answer.stdout.split('\n')[0] or answer.stderr.strip())
        if answer.returncode != status or said not in answer.stdout:
            yield f'exit status {answer.returncode}, not {status}, or not "{said}":\n{answer.stdout}{answer.stderr}'
        yield from both.faults(text, said)
    for text in spellings(both.certificate(triangle)):
        yield from both.faults(text, 'a spelling')
        if both.ask(both.proved, text=text).returncode != REJECTED:
            yield f'accepted:\n{text}'


def dyadic(text):
    """The value of a number of a certificate."""
    man, _, exponent = text.partition('*2^')
    return int(man) * Fraction(2) ** int(exponent or 0)


def spelled(value):
    """A number whose denominator is a power of two as certificates have it."""
    man, exponent = value.numerator, 1 - value.denominator.bit_length()
    while man and man % 2 == 0:
        man, exponent = man // 2, exponent + 1
    return f'{man}*2^{exponent}' if man and exponent else f'{man}'


def reshaped(at):
    """Polygons of the vertices `at` that are wrong: not strictly convex, or not where the polygon was."""
    n = len(at)
    middle = [sum(p[a] for p in at[:2]) / 2 for a in (0, 1)]
    yield at[:1] + [middle] + at[1:]  # a straight angle
    yield at[:2]
    yield at[::-1]
    yield at + at
    yield at[:1] * 2 + at[1:]
    for k in range(n):
        here, before, after = at[k], at[k - 1], at[(k + 1) % n]
        chord = [(before[a] + after[a]) / 2 for a in (0, 1)]
        for part in (Fraction(9, 8), Fraction(17, 16), Fraction(-2), Fraction(-2**40)):  # dents, spikes
            yield at[:k] + [[here[a] + part * (chord[a] - here[a]) for a in (0, 1)]] + at[k + 1:]
    if n > 4:
        yield [at[2 * k % n] for k in range(n)] if n % 2 else at[::2] + at[1::2]


def forged_diagrams(rng, text):
    """The text with its section on the diagram changed for the worse, but for the distance."""
    lines = text.split('\n')
    window, first = next(k for k, line in enumerate(lines) if line.startswith('window ')), lines.index('polygons') + 1
    last = next(k for k, line in enumerate(lines) if line.startswith('undetermined '))
    changed = lambda k, *new: '\n'.join(lines[:k] + list(new) + lines[k + 1:])  # noqa: E731
    ends = [dyadic(word) for word in lines[window].split(' ')[1:]]
    for k, way in enumerate((1, -1, 1, -1)):
        for part in (Fraction(1, 8), Fraction(-1, 8), Fraction(2)):  # narrower, wider, inside out
            moved = ends[:k] + [ends[k] + way * part * (ends[k | 1] - ends[k & 2])] + ends[k + 1:]
            yield changed(window, ' '.join(['window', *map(spelled, moved)]))
    bound = dyadic(lines[last].split(' ')[1])
    for less in (bound / 2, bound * (1 - Fraction(1, 2**12)), Fraction(0), -bound - 1):
        yield changed(last, f'undetermined {spelled(less)}')
    for k in rng.sample(range(first, last), min(3, last - first)):
        words = lines[k].split(' ')
        at = [[dyadic(x), dyadic(y)] for x, y in zip(words[1::2], words[2::2])]
        yield changed(k)
        yield changed(k, lines[k], lines[k])
        yield changed(k, ' '.join(words[:-1]))
        yield changed(k, words[0])
        yield from (changed(k, ' '.join([other.split(' ')[0]] + words[1:])) for other in lines[first:last] if other != lines[k])
        if k > first:
            yield '\n'.join(lines[:k - 1] + [lines[k], lines[k - 1]] + lines[k + 1:])
        for shape in reshaped(at):
            yield changed(k, ' '.join([words[0], *(spelled(z) for p in shape for z in p)]))
    for ends in ('0 0 0 1', '0 1 0 0', '0 -1 0 1', '0 1 0 -1', '0 -1 0 -1', '0 1 0', '0 1 0 x'):  # no area, or no window
        yield '\n'.join(lines[:window] + [f'window {ends}', 'polygons', 'undetermined 2', 'distance none', 'end', ''])


def forged_distances(text):
    """The text with another distance, or window: lower, below zero, said to be unproved, far from the diagram."""
    lines = text.split('\n')
    window, last = (next(k for k, line in enumerate(lines) if line.startswith(f'{word} ')) for word in ('window', 'distance'))
    if lines[last] == 'distance none':
        return
    bound, tail = dyadic(lines[last].split(' ')[1]), lines[last + 1:]
    for part in (Fraction(3, 4), Fraction(1, 2), Fraction(1, 4), Fraction(1, 2**20), Fraction(0), Fraction(-1), Fraction(2**20)):
        yield '\n'.join(lines[:last] + [f'distance {spelled(part * bound)}'] + tail)
    yield '\n'.join(lines[:last] + [f'distance {spelled(bound / 4)} unproved'] + tail)
    x0, x1, y0, y1 = (dyadic(word) for word in lines[window].split(' ')[1:])
    for move, bound in ((8, bound), (8, 16 * (x1 - x0 + y1 - y0)), (0, bound), (0, bound / 4)):
        ends = [x0 + move * (x1 - x0), x1 + move * (x1 - x0), y0, y1]
        yield '\n'.join(lines[:window] + [' '.join(['window', *map(spelled, ends)]), 'polygons',
                                          f'undetermined {spelled((x1 - x0) * (y1 - y0))}', f'distance {spelled(bound)}'] + tail)


def try_reach(both):
    """A distance that reaches just across the window, to the one site that is apart from others, in more digits than boxes
    have."""
    long = 2**60 + 1
    text = both.certificate(f'[0,1] [0,1]\n[0,1] [0,1]\n{3 * long}/{2**60} {4 * long}/{2**60}\n', command='voronoi')
    head = text[:text.index('\nwindow ')]
    for man, status in ((5 * long, 0), (5 * long - 1, REJECTED)):
        forged = f'{head}\nwindow 0 1 0 1\npolygons\nundetermined 1\ndistance {man}*2^-60\nend\n'
        for answer in (both.ask(both.proved, text=forged), both.ask(both.dyadel, 'verify', text=forged)):
            if (answer.returncode == REJECTED) != (status == REJECTED):
                yield f'a distance across the window: {answer}'


def try_diagrams(both, count):
    """Both say the same of the section on the Voronoi diagram."""
    rng = random.Random(SEED)
    tried = refused = far = 0
    for number in range(count):
        exact = ''.join(f'{rng.randrange(-9, 10)} {rng.randrange(-9, 10)}\n' for _ in range(rng.randrange(2, 12)))
        text = both.certificate(exact if number % 4 == 0 else points(rng), '--max-bits', '200', command='voronoi')
        if '\nwindow ' not in text:
            continue
        for forged in [text, *forged_distances(text), *forged_diagrams(rng, text)]:
            here, there = both.ask(both.proved, text=forged), both.ask(both.dyadel, 'verify', text=forged)
            tried, refused = tried + 1, refused + (here.returncode == REJECTED)
            far += 'boxes do not prove the bound of the distance' in here.stderr
            same = here.returncode == REJECTED or 'checked: the undetermined area' in here.stdout
            proved = ['distance of undetermined points' in row for row in here.stdout.split('\n') if row.startswith('checked: ')]
            same &= here.returncode == REJECTED or any(proved) == bool(re.search(r'\ndistance [-0-9*^]+\n', forged))
            if (here.returncode == REJECTED) != (there.returncode == REJECTED) or not same:
                yield f'a diagram: {here.returncode} {here.stderr}, verify {there.returncode} {there.stderr}:\n{forged}'
    print(f'{tried} certificates of diagrams, of which {refused} are refused, {far} as the distance does not hold')
    if tried < 10 * count or refused * 2 < tried or far < 3 * count:
        yield 'hardly any diagram was tried, or refused'


def try_command(both):
    """verify --proved says what the program says; -o; nothing is left where it is rejected."""
    text, target = both.certificate('0 0\n5 0\n0 4\n'), both.folder / 'answer.txt'
    os.environ['PATH'] = f'{both.proved.parent}:{os.environ["PATH"]}'
    for certificate in (text, text.replace('goal decided', 'goal area 5'), text[:-1]):
        alone, by = both.ask(both.proved, text=certificate), both.ask(both.dyadel, 'verify', '--proved', text=certificate)
        if (alone.returncode, alone.stdout, alone.stderr) != (by.returncode, by.stdout, by.stderr):
            yield f'verify --proved differs: {alone} {by}'
        target.unlink(missing_ok=True)
        filed = both.ask(both.dyadel, 'verify', '--proved', '-o', target, text=certificate)
        if filed.returncode != alone.returncode or filed.stdout or target.exists() != (filed.returncode != REJECTED):
            yield f'verify --proved -o: {filed}'
        if target.exists() and target.read_text() != alone.stdout:
            yield 'verify --proved -o writes something else'


def small_boxes(count):
    rng = random.Random(count)
    return ''.join(f'{rng.random()}+-1e-9 {rng.random()}+-1e-9\n' for _ in range(count))


def try_growth(both):
    few, many = both.seconds(small_boxes(1500)), both.seconds(small_boxes(12000))
    print(f'8 times as many sites: {many / few:.1f} times as long')
    if many > 40 * few:  # 64 when quadratic; 8 to 18 on a busy machine
        yield 'the time grows with the square of the number of sites'


def covering(both, size):
    """How many triangles cover the plane, a site, for a square lattice."""
    text = both.certificate(''.join(f'{x} {y}\n' for x in range(size) for y in range(size)))
    said = both.ask(both.proved, text=text).stdout
    return int(re.search(r'by (\d+) triangles that cover the plane', said)[1]) / size ** 2


def try_cover(both):
    few, many = covering(both, 16), covering(both, 48)
    print(f'triangles that cover the plane, a site: {few:.2f}, {many:.2f} for 9 times as many')
    if many > COVER_GROWTH * few:
        yield 'the number of triangles grows faster than that of sites'


def main():
    root, proved, dyadel = (pathlib.Path(arg).resolve() for arg in sys.argv[1:4])
    with tempfile.TemporaryDirectory() as folder:
        both = Checkers(proved, dyadel, pathlib.Path(folder))
        found = list(try_random(both, int(sys.argv[4]) if len(sys.argv) > 4 else 70))
        found += try_chains(both, root / 'tests/checker/forgeries.txt')
        found += try_parts(both, root / 'tests/checker/forgeries_parts.txt')
        found += try_ties(both, 60)
        found += try_forged_ties(both)
        found += try_fixpoint(both)
        found += try_certified(both)
        found += try_reach(both)
        found += try_diagrams(both, 16)
        found += try_cases(both, root)
        found += try_command(both)
        found += try_growth(both)
        found += try_cover(both)
    print('\n'.join(found) or 'no fault')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
