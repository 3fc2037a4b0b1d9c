#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Certificates of discs, their cells, of graphs and of nearest sites: what the command writes is accepted, and all of it proved; what
is changed and accepted all the same is true [CERT-11] [CERT-12] [CERT-13].

Usage: test_parts.py DYADEL   (DYADEL_TEST_SEED chooses the cases; DYADEL_TEST_SCALE multiplies them)

Judged in rationals, apart from the library: a witness of discs by the signs of sums of two square roots; places that are
points by all distances; the others by choices of points at corners, on borders and inside. That a pair of discs is
illegal is judged by the circles that just touch both discs, at many directions: none may be free of all others by more
than doubles are off by.
"""
import itertools
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

DYADEL = sys.argv[1]
SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))
MUTANTS = 6 if os.environ.get('DYADEL_TEST_SANITIZED') else 25


def run(*args):
    return subprocess.run([DYADEL, *map(str, args)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)


# ---- reading a certificate ----


def number(text):
    man, _, exp = text.partition('*2^')
    return Fraction(int(man)) * Fraction(2) ** int(exp or 0)


def side(text):
    if '+' in text:
        lo, width = map(number, text.split('+'))
        return lo, lo + width
    top, _, den = text.partition('/')
    value = number(top) / int(den or 1)
    return value, value


class Certificate:
    """The statements of a certificate, as they stand."""

    def __init__(self, text):
        lines = iter(text.splitlines())
        self.box, self.disc, self.refined, self.rows, self.places = [], {}, [], [], []
        self.legal, self.open, self.graph = [], [], None
        self.window, self.polygons, self.undetermined = None, {}, None
        for line in lines:
            word = line.split()
            if word[0] == 'sites':
                for k in range(int(word[1])):
                    part = next(lines).split()
                    self.box.append(None if part[0] == '=' else (side(part[0]), side(part[1])))
            elif word[0] == 'legal':
                self.legal = [tuple(map(int, next(lines).split()[:2])) for _ in range(int(word[1]))]
            elif word[0] in ('o', 't', 'l', 'n') and not self.disc:
                if word[0] != 'n':
                    self.open.append(tuple(map(int, word[1:3])))
            elif word[0] == 'discs':
                for k in (k for k, box in enumerate(self.box) if box):
                    self.disc[k] = tuple(map(number, next(lines).split()))
            elif word[0] == 'refined':
                self.refined = [next(lines).split() for _ in range(int(word[1]))]
            elif word[0] == 'graph':
                self.graph = word[1]
                self.rows = [next(lines).split() for _ in range(int(word[2]))]
            elif word[0] == 'window':
                self.window = tuple(map(number, word[1:]))
                line = next(lines)
                while not (line := next(lines)).startswith('undetermined '):
                    i, *at = line.split()
                    self.polygons[int(i)] = list(zip(map(number, at[::2]), map(number, at[1::2])))
                self.undetermined = number(line.split()[1])
            elif word[0] == 'nearest':
                self.places = [next(lines).split() for _ in range(int(word[1]))]
        self.sites = [k for k, box in enumerate(self.box) if box]


# ---- discs ----


def root_difference(a, b, s):
    """The sign of sqrt(b) - sqrt(a) - s, s >= 0."""
    d = b - a - s * s
    if d <= 0:
        return -1 if d < 0 or a * s > 0 else 0
    e = d * d - 4 * s * s * a
    return (e > 0) - (e < 0)


def is_disc_witness(c, i, j, x, y):
    for k in c.sites:
        for end in (i, j):
            if k in (i, j):
                continue
            a, b = ((x - c.disc[m][0]) ** 2 + (y - c.disc[m][1]) ** 2 for m in (end, k))
            # a rectangle may show it, too
            if root_difference(a, b, c.disc[end][2] + c.disc[k][2]) <= 0 and not box_is_farther(c, end, k, x, y):
                return False
    return True


def near_far(box, x, y):
    near = sum(max(lo - v, v - hi, 0) ** 2 for v, (lo, hi) in zip((x, y), box))
    far = sum(max(v - lo, hi - v) ** 2 for v, (lo, hi) in zip((x, y), box))
    return near, far


def box_is_farther(c, end, k, x, y):
    return near_far(c.box[k], x, y)[0] > near_far(c.box[end], x, y)[1]


def may_be_edge(c, i, j):
    """Returns whether some circle that both discs meet holds no other disc, by a margin that doubles show."""
    if c.disc[i][2] > c.disc[j][2]:
        i, j = j, i
    ox, oy, r = c.disc[i]
    scale = max([abs(d[a] - c.disc[i][a]) for d in c.disc.values() for a in (0, 1)] + [d[2] for d in c.disc.values()] + [Fraction(1, 2 ** 1000)])
    disc = {k: tuple(float(v / scale) for v in (d[0] - ox, d[1] - oy, d[2])) for k, d in c.disc.items()}
    px, py, rj = disc[j]
    delta, n = rj - disc[i][2], px * px + py * py - (rj - disc[i][2]) ** 2
    if math.hypot(px, py) <= rj + disc[i][2]:
        return True
    def free(angle):
        ux, uy = math.cos(angle), math.sin(angle)
        h = (ux * px + uy * py + delta) / n
        if h <= 1e-6:
            return -1.0
        x, y = ux / (2 * h), uy / (2 * h)
        touch = max(math.hypot(x, y) - disc[i][2], math.hypot(x - px, y - py) - rj, 0)
        return min((math.hypot(x - d[0], y - d[1]) + d[2] - touch for k, d in disc.items() if k not in (i, j)), default=1.0) / (1 + 1 / h)
    steps = 720
    best = max((2 * math.pi * k / steps for k in range(steps)), key=free)
    width = 2 * math.pi / steps
    for _ in range(40):
        best = max((best - width, best, best + width), key=free)
        width /= 1.6
    return free(best) > 1e-9


def judge_discs(c):
    for line in c.refined:
        i, j = int(line[1]), int(line[2])
        if line[0] == 'l' and len(line) > 3 and not is_disc_witness(c, i, j, number(line[3]), number(line[4])):
            return f'{i} {j} has no witness'
        if line[0] == 'n' and len(line) > 3 and may_be_edge(c, i, j):
            return f'{i} {j} may be an edge'
    return None


# ---- graphs, by choices ----


def choice(c, R):
    def value(lo, hi):
        return R.choice((lo, hi, (lo + hi) / 2, lo + (hi - lo) * R.randrange(1001) / 1000))
    return {k: tuple(value(*s) for s in c.box[k]) for k in c.sites}


def distance2(p, q):
    return (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2


def nearest_edges(p):
    """(certain: alone, possible) of one choice."""
    alone, some = set(), set()
    for i in p:
        others = sorted((distance2(p[i], p[k]), k) for k in p if k != i)
        some |= {(i, k) for d, k in others if d == others[0][0]}
        if others and (len(others) == 1 or others[1][0] > others[0][0]):
            alone.add((i, others[0][1]))
    return alone, some


def gabriel_edges(p):
    alone, some = set(), set()
    for i, j in itertools.combinations(p, 2):
        product = [sum((p[k][a] - p[i][a]) * (p[k][a] - p[j][a]) for a in (0, 1)) for k in p if k not in (i, j)]
        if all(v > 0 for v in product):
            alone.add((i, j))
        if all(v >= 0 for v in product):
            some.add((i, j))
    return alone, some


def mst_edges(p):
    """(certain: in each minimum spanning tree, possible: in one) of one choice."""
    alone, some = set(), set()
    for i, j in itertools.combinations(p, 2):
        for found, near in ((alone, lambda d, e: d <= e), (some, lambda d, e: d < e)):
            seen, left = {i}, [i]
            while left:
                k = left.pop()
                more = {m for m in p if m not in seen and {k, m} != {i, j} and
                        near(distance2(p[k], p[m]), distance2(p[i], p[j]))}
                seen |= more
                left += more
            if j not in seen:
                found.add((i, j))
    return alone, some


def judge_graph(c, R, complete, tries=30):
    if c.graph == 'mst' and not complete:
        return None  # statements of certain edges are not proved then
    edges = {'nearest': nearest_edges, 'gabriel': gabriel_edges, 'mst': mst_edges}[c.graph]
    certain = {(int(r[1]), int(r[2])) for r in c.rows if r[0] == 'c'}
    listed = {(int(r[1]), int(r[2])) for r in c.rows}
    for _ in range(tries):
        alone, some = edges(choice(c, R))
        if certain - alone:
            return f'{certain - alone} are not certain'
        if complete and some - listed:
            return f'{some - listed} are edges'
    return None


# ---- places ----


def is_nearer(c, i, k, z, d):
    """Do the rectangles, or the discs, show that i is nearer to z than k?"""
    if d[i][1] < d[k][0]:
        return True
    a, b = (distance2(z, c.disc[m][:2]) for m in (i, k)) if c.disc else (0, 0)
    return bool(c.disc) and root_difference(a, b, c.disc[i][2] + c.disc[k][2]) > 0


def is_within(c, i, z, lo, hi, d):
    """Do they show that the distance of i from z is in [lo, hi]?"""
    near, far = d
    r, between = (c.disc[i][2], distance2(z, c.disc[i][:2])) if c.disc else (0, 0)
    above = number(lo) <= 0 or number(lo) ** 2 <= near or (c.disc and (number(lo) + r) ** 2 <= between)
    below = hi == 'none' or (number(hi) >= 0 and number(hi) ** 2 >= far) or (
        c.disc and number(hi) >= r and (number(hi) - r) ** 2 >= between)
    return above and below


def judge_places(c, R, complete):
    for line in c.places:
        box, rest = (side(line[0]), side(line[1])), line[3:]
        listed = {int(v) for v in rest[::3]}
        at = [(x, y) for x in {*box[0], sum(box[0]) / 2} for y in {*box[1], sum(box[1]) / 2}]
        for x, y in at:
            d = {k: near_far(c.box[k], x, y) for k in c.sites}
            if line[2] == 'c' and not all(is_nearer(c, int(rest[0]), k, (x, y), d) for k in c.sites if k != int(rest[0])):
                return f'{line[:3]}: not certain'
            if complete and any(all(not is_nearer(c, i, k, (x, y), d) for i in c.sites) for k in set(c.sites) - listed):
                return f'{line[:3]}: another one may be nearest'
            for i, lo, hi in zip(rest[::3], rest[1::3], rest[2::3]):
                if not is_within(c, int(i), (x, y), lo, hi, d[int(i)]):
                    return f'{line[:3]}: a distance is out of bounds'
    return None


# ---- the diagram ----


def judge_diagram(c):
    xlo, xhi, ylo, yhi = c.window
    area = (xhi - xlo) * (yhi - ylo)
    for i, at in c.polygons.items():
        turns = [(b[0] - a[0]) * (d[1] - b[1]) - (b[1] - a[1]) * (d[0] - b[0]) for a, b, d in zip(at, at[1:] + at[:1], at[2:] + at[:2])]
        if len(at) < 3 or min(turns) <= 0:
            return f'polygon {i} is not convex'
        for x, y in at:
            d = {k: near_far(c.box[k], x, y) for k in c.sites}
            if not (xlo <= x <= xhi and ylo <= y <= yhi and all(is_nearer(c, i, k, (x, y), d) for k in c.sites if k != i)):
                return f'a vertex of polygon {i} is not inside its cell'
        area -= sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(at, at[1:] + at[:1])) / 2
    return None if area <= c.undetermined else 'more area is undetermined'


def judge(text, R, complete):
    c = Certificate(text)
    wrong = judge_discs(c) if c.disc else None
    if c.graph and not wrong:
        wrong = judge_graph(c, R, complete)
    if c.window and not wrong:
        wrong = judge_diagram(c)
    return wrong or judge_places(c, R, complete)


# ---- cases ----


def points_case(R):
    """csv text with a column of radii: many shapes."""
    n, kind = R.randrange(2, 9), R.randrange(6)
    grid, reach = R.choice((4, 16, 1000)), R.choice((0.2, 0.5, 1))
    rows = []
    for k in range(n):
        x, y = R.randrange(grid), R.randrange(grid)
        r = Fraction(R.randrange(8), 8) * Fraction(reach) * grid / n if R.randrange(4) else Fraction(0)
        if kind == 1:
            r = Fraction(grid, 8)
        if kind == 2:
            x, y = round(math.cos(k) * grid), round(math.sin(k) * grid)
        rows.append([Fraction(x), Fraction(y), r])
    if kind == 3 and n > 2:  # one in another
        rows[1] = [rows[0][0] + Fraction(1, 8), rows[0][1], Fraction(1, 16)]
        rows[0][2] = Fraction(1)
    scale = Fraction(2) ** R.choice((0, 0, 0, -900, 300, -40))
    shift = R.choice((0, 0, 10 ** 6))
    third = R.choice((1, 1, 3))
    return 'x,y,r\n' + ''.join(f'{(v[0] + shift) * scale / third},{(v[1] + shift) * scale / third},{v[2] * scale / third}\n' for v in rows)


def sections(text):
    """Where the part under test begins: before it other tests change everything."""
    found = [m.start() for m in re.finditer(r'^(discs|graph|window|nearest) ', text, re.M)]
    return min(found)


def mutants(text, R, count):
    begin = sections(text)
    sites = text.index('\nsites ')
    for _ in range(count):
        start = begin if R.randrange(5) else sites
        tail = text[start:]
        kind = R.randrange(6)
        lines = tail.split('\n')
        k = R.randrange(len(lines) - 1)
        if kind == 0:
            del lines[k]
        elif kind == 1:
            lines.insert(k, lines[k])
        elif kind == 2:
            lines[k], lines[k - 1] = lines[k - 1], lines[k]
        elif kind == 3:
            words = lines[k].split(' ')
            w = R.randrange(len(words))
            words[w] = R.choice(('c', 'p', 'l', 'n', 'o', '0', '1', 'none', 'nearest', 'gabriel', 'fixed', R.choice(tail.split() or ['0'])))
            lines[k] = ' '.join(words)
        else:
            digits = list(re.finditer(r'-?\d+', lines[k]))
            if not digits:
                continue
            m = R.choice(digits)
            v = int(m[0])
            v = R.choice((v + 1, v - 1, v + 2, -v, v * 2, v // 2, 0, v + R.randrange(-8, 9)))
            lines[k] = lines[k][:m.start()] + str(v) + lines[k][m.end():]
        changed = '\n'.join(lines)
        if R.randrange(3) == 0:  # a forger puts counts right
            changed = re.sub(r'^(refined|graph \w+|nearest) \d+', lambda m: m[0], changed, flags=re.M)
            changed = put_counts(changed)
        if changed != tail:
            yield text[:start] + changed


def put_counts(tail):
    """Counts of the sections become those of their lines."""
    lines = tail.split('\n')
    for k, line in enumerate(lines):
        m = re.match(r'(refined|graph \w+|nearest) \d+$', line)
        if m:
            count = next((n for n, other in enumerate(lines[k + 1:]) if re.match(r'(end|window|graph|discs|refined)', other)), 0)
            lines[k] = f'{m[1]} {count}'
    return '\n'.join(lines)


def reads(text):
    try:
        return Certificate(text)
    except (ValueError, IndexError, StopIteration, RuntimeError, ZeroDivisionError):
        return None


TALLY = {'certificates': 0, 'mutants': 0, 'accepted': 0, 'proved': 0}


def try_mutants(folder, text, R, count):
    forged = folder / 'forged.txt'
    for changed in mutants(text, R, count):
        TALLY['mutants'] += 1
        forged.write_text(changed)
        done = run('verify', forged)
        assert done.returncode in (0, 1, 3), (done, changed)
        if done.returncode == 1:
            assert ': rejected: ' in done.stderr and not done.stdout, done
            continue
        TALLY['accepted'] += 1
        TALLY['proved'] += done.returncode == 0
        assert (done.returncode == 3) == ('not proved: ' in done.stdout), done.stdout
        complete = 'without a row' not in ''.join(re.findall('not proved.*', done.stdout)) and 'do not list' not in done.stdout
        wrong = judge(changed, R, complete)
        assert not wrong, f'{wrong}\n{changed}\n{done.stdout}'


def check_case(folder, R, mutated):
    points = folder / 'points.csv'
    points.write_text(points_case(R))
    reading = ['--columns', 'x,y', '--radius-column', 'r', points]
    places = folder / 'places.txt'
    places.write_text(''.join(f'{R.randrange(-4, 20)}{R.choice(("", "/3", ".5"))} {R.randrange(20)}\n' if R.randrange(3) else
                              f'[{k},{k + R.randrange(1, 4)}] {R.randrange(9)}\n' for k in range(3)))
    certificate = folder / 'certificate.txt'
    for command in (['delaunay', '--discs'], ['delaunay', '--layer', 'graph:nearest'], ['delaunay', '--layer', 'graph:gabriel'],
                    ['delaunay', '--layer', 'graph:mst'],
                    ['nearest', '--queries', places], ['nearest', '--queries', places, '--discs'], ['voronoi', '--discs']):
        certificate.unlink(missing_ok=True)
        done = run(*command, '--quiet', '-o', folder / 'out.csv', '--certificate', certificate, *reading)
        assert done.returncode in (0, 3), (done, points.read_text())
        TALLY['certificates'] += 1
        text = certificate.read_text()
        discs = command[-1] == '--discs'
        verdict = run('verify', certificate, *(['--discs'] if discs else []), '--points', points, *reading[:-1])
        ties = command[0] == 'nearest'
        assert verdict.returncode == 0 or (ties and re.findall('not proved: .*', verdict.stdout) and
                                           all('outcome' in v for v in re.findall('not proved: .*', verdict.stdout))), (verdict, points.read_text(), text)
        if discs and not ties:
            assert run('verify', certificate).returncode == 0, text
        wrong = judge(text, R, True)
        assert not wrong, f'{wrong}\n{text}'
        try_mutants(folder, text, R, mutated)


def main():
    print(f'seed {SEED}')
    with tempfile.TemporaryDirectory() as name:
        for k in range(12 * SCALE):
            check_case(pathlib.Path(name), random.Random(SEED * 1000003 + k), MUTANTS)
    print(TALLY)


if __name__ == '__main__':
    main()
