#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""`dyadel verify` and dyadel-proved give the same verdict, and neither accepts a false statement [CERT-1] [CERT-5] [CERT-6]
[CERT-7] [CERT-8] [CERT-9] [CERT-10] [CERT-11] [CERT-12] [CERT-13] [CERT-14].

Usage: verdicts.py ROOT DYADEL_PROVED DYADEL [CASES]   (DYADEL_PROVED "-": without it; DYADEL_TEST_SCALE multiplies CASES)

CASES true certificates (default 60; A-B: numbers A to B - 1) of up to nine points: exact ones, ties on circles and lines, boxes, crowds, points
among boxes, roots and their ties, aliases, bounds and diagrams; of discs and their cells, of graphs, places of queries, and
places of a sphere (verdict_parts.py); and ten changes of each: lines, statuses, pairs, numbers,
outcomes, counts, bounds and blocks, the counts put right afterwards. An oracle in exact numbers, below, judges each accepted
certificate for many choices of the points. Verdicts are the exit statuses; where they differ, DIFFERENCES has the
reason, by a name that SOUNDNESS.md explains. Its table is what a run printed.
"""
import collections
import concurrent.futures
import contextlib
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

import verdict_parts

SEED = 1
CHANGES = 10
ALL, NOT_ALL, REJECTED = 0, 3, 1
WORD = {ALL: 'all proved', NOT_ALL: 'not all proved', REJECTED: 'rejected'}

# ---- exact numbers: sums of rational multiples of square roots ----


class Surd:
    """part[d]: the factor of sqrt(d), d > 0 without a square; roots of different ones are independent over the rationals."""

    def __init__(self, part):
        self.part = {d: c for d, c in part.items() if c}

    @staticmethod
    def of(x):
        return x if isinstance(x, Surd) else Surd({1: Fraction(x)})

    def __add__(self, other):
        part = collections.Counter()
        for x in (self, Surd.of(other)):
            for d, c in x.part.items():
                part[d] += c
        return Surd(part)

    def __neg__(self):
        return Surd({d: -c for d, c in self.part.items()})

    def __sub__(self, other):
        return self + -Surd.of(other)

    def __rsub__(self, other):
        return Surd.of(other) + -self

    def __mul__(self, other):
        part = collections.Counter()
        for (d, c), (e, b) in itertools.product(self.part.items(), Surd.of(other).part.items()):
            g = math.gcd(d, e)
            part[d // g * (e // g)] += c * b * g
        return Surd(part)

    __radd__, __rmul__ = __add__, __mul__

    def sign(self):
        """The terms to more and more digits: a sum that is not 0 shows it."""
        if len(self.part) < 2:
            return next(((c > 0) - (c < 0) for c in self.part.values()), 0)
        den = math.lcm(*(c.denominator for c in self.part.values()))
        for bits in itertools.count(64, 64):
            terms = [(int(c * den), math.isqrt(d << 2 * bits)) for d, c in self.part.items()]
            low, error = sum(c * root for c, root in terms), sum(abs(c) for c, _ in terms)
            if abs(low) > error:
                return 1 if low > 0 else -1
        return 0

    def inverse(self):
        """By the conjugates for one prime after another."""
        above, below = Surd.of(1), self
        while set(below.part) - {1}:
            d = next(d for d in below.part if d > 1)
            p = next(p for p in itertools.count(2) if d % p == 0)
            turned = Surd({e: -c if e % p == 0 else c for e, c in below.part.items()})
            above, below = above * turned, below * turned
        return above * (1 / below.part[1])


class Beyond(Exception):
    """A number that is not one of these."""


def sign(x):
    return x.sign() if isinstance(x, Surd) else (x > 0) - (x < 0)


def root(x):
    """Of a rational number."""
    if set(Surd.of(x).part) - {1}:
        raise Beyond
    value = Surd.of(x).part.get(1, Fraction(0))
    n, square = value.numerator * value.denominator, 1
    if n < 0 or n > 10**9:
        raise Beyond
    for k in range(2, math.isqrt(n) + 1):
        while n % (k * k) == 0:
            n, square = n // (k * k), square * k
    return Surd({n: Fraction(square, value.denominator)}) if n else Surd({})


# ---- what a certificate states ----

def dyadic(text):
    man, _, exponent = text.partition('*2^')
    return int(man) * Fraction(2) ** int(exponent or 0)


def side(text):
    low, _, width = text.partition('+')
    num, _, den = low.partition('/')
    value = dyadic(num) / int(den or 1)
    return value, value + dyadic(width) if width else value


class Block:
    """Points that a block describes: {site: (x, y)}."""

    def __init__(self, lines):
        number, self.at, self.facts = [], {}, []
        for _ in range(int(next(lines).split(' ')[1])):
            number.append(self.value(number, next(lines).split(' ')))
        for _ in range(int(next(lines).split(' ')[1])):
            i, a, b = map(int, next(lines).split(' '))
            self.at[i] = number[a], number[b]
        for _ in range(int(next(lines).split(' ')[1])):
            kind, *sites, _ = next(lines).split(' ')
            self.facts.append((kind, [int(k) for k in sites]))

    @staticmethod
    def value(number, words):
        operation, *rest = words
        if operation == '=':
            num, _, den = rest[0].partition('/')
            if not re.fullmatch(r'-?\d+', num) or not re.fullmatch(r'\d*', den):
                raise Beyond
            return Surd.of(Fraction(int(num), int(den or 1)))
        of = [number[int(k)] for k in rest if re.fullmatch(r'\d+', k)]
        if operation == 'sqrt':
            return root(of[0])
        if operation == '^':
            return math.prod([of[0]] * int(rest[1]), start=Surd.of(1))
        if operation not in OPERATIONS:
            raise Beyond
        return OPERATIONS[operation](*of)


OPERATIONS = {'+': lambda a, b: a + b, '-': lambda a, b: a - b, '*': lambda a, b: a * b, '/': lambda a, b: a * b.inverse(),
              'neg': lambda a: -a, 'abs': lambda a: a if sign(a) >= 0 else -a,
              'min': lambda a, b: a if sign(a - b) < 0 else b, 'max': lambda a, b: b if sign(a - b) < 0 else a}


class Statement:
    """What an accepted certificate says, by a reader of its own."""

    def __init__(self, text):
        lines = iter(text.split('\n'))
        next(lines)
        self.outcome = next(lines).split(' ')[1]
        *goal, last = next(lines).split(' ')[1:]
        self.goal, self.goal_bits = (' '.join(goal), int(last)) if goal else (last, 0)
        self.capped = next(lines) == 'capped yes'
        self.rect, self.alias = [], {}
        for k in range(int(next(lines).split(' ')[1])):
            words = next(lines).split(' ')
            if words[0] == '=':
                self.alias[k] = int(words[1])
                self.rect.append(self.rect[int(words[1])])
            else:
                self.rect.append(tuple(map(side, words)))
        self.kind = {(int(i), int(j)): 'L' for i, j, *_ in self.rows(lines)}
        for _ in ('places', 'bridges', 'corners'):
            list(self.rows(lines))
        next(lines)
        for line in lines:
            kind, *words = line.split(' ')
            if kind == 'triangles':
                break
            if kind != 'boxes':
                self.kind[int(words[0]), int(words[1])] = kind
        self.triangles = int(line.split(' ')[1])
        self.unproved = int(next(lines).split(' ')[1])
        self.area, self.hausdorff = (None if word == 'none' else dyadic(word) for word in
                                     (next(lines).split(' ')[1], next(lines).split(' ')[1]))
        self.blocks, self.window, self.polygons, self.distance = [], None, {}, None
        self.rest(lines)
        self.site = [k for k in range(len(self.rect)) if k not in self.alias]

    @staticmethod
    def rows(lines):
        for _ in range(int(next(lines).split(' ')[1])):
            yield next(lines).split(' ')

    def rest(self, lines):
        """Up to the sphere, discs and graphs, which others judge."""
        for line in itertools.takewhile(lambda line: not re.match('sphere|discs |graph ', line), lines):
            if line.startswith('algebra '):
                self.blocks.append(Block(itertools.chain([line], lines)))
            elif line.startswith('window '):
                self.window = [dyadic(word) for word in line.split(' ')[1:]]
            elif re.match(r'\d', line):
                i, *words = line.split(' ')
                at = list(map(dyadic, words))
                self.polygons[int(i)] = list(zip(at[::2], at[1::2]))
            elif line.startswith('undetermined '):
                self.undetermined = dyadic(line.split(' ')[1])
            elif line.startswith('distance ') and re.fullmatch(r'distance [-\d*^]+', line):
                self.distance = dyadic(line.split(' ')[1])

    def described(self):
        return {k: at for block in self.blocks for k, at in block.at.items()}

    def pairs(self):
        return itertools.combinations(self.site, 2)


# ---- the oracle: one choice of points, brute force ----

STRICT, WEAK, NONE, PLACE = 'strict', 'weak', 'none', 'one place'


def whole(at):
    """The points by a common factor, as integers; None where a coordinate is irrational."""
    values = [x for p in at.values() for x in p]
    if any(isinstance(x, Surd) and set(x.part) - {1} for x in values):
        return at
    values = [x.part.get(1, Fraction(0)) if isinstance(x, Surd) else Fraction(x) for x in values]
    den = math.lcm(1, *(x.denominator for x in values))
    values = [int(x * den) for x in values]
    return {k: (values[2 * q], values[2 * q + 1]) for q, k in enumerate(at)}


def status(at, i, j):
    """Is the pair strictly, or only weakly Delaunay, or one place? Centres are middle + t normal; each other point bounds t."""
    (ax, ay), (bx, by) = at[i], at[j]
    dx, dy = bx - ax, by - ay
    low = high = None
    strict = weak = True
    sides = set()
    if sign(dx) == 0 and sign(dy) == 0:
        return PLACE
    for k, (px, py) in at.items():
        if k in (i, j):
            continue
        x, y = px - ax, py - ay
        slope, most = 2 * (dx * y - dy * x), x * x + y * y - x * dx - y * dy
        turn = sign(slope)
        sides.add(turn)
        if turn == 0:
            strict, weak = strict and sign(most) > 0, weak and sign(most) >= 0
        elif turn > 0:
            high = (most, slope) if high is None or sign(most * high[1] - high[0] * slope) < 0 else high
        else:
            low = (-most, -slope) if low is None or sign(-most * low[1] + low[0] * slope) > 0 else low
    gap = 1 if low is None or high is None else sign(high[0] * low[1] - low[0] * high[1])
    if strict and gap > 0:
        return STRICT
    return WEAK if (weak and gap >= 0) or not {1, -1} <= sides else NONE


def choices(rng, s, many):
    """Points in the rectangles: ends of the sides in every combination, or many of them, and random ones."""
    fixed, box = s.described(), [k for k in s.site if s.rect[k][0][0] != s.rect[k][0][1] or s.rect[k][1][0] != s.rect[k][1][1]]
    moving = [k for k in box if k not in fixed]
    still = {k: fixed.get(k) or (s.rect[k][0][0], s.rect[k][1][0]) for k in s.site}
    if not moving:
        yield still
        return
    corners = itertools.product(*[list(itertools.product(*s.rect[k])) for k in moving])
    corners = corners if 4 ** len(moving) <= many else ([tuple(map(rng.choice, s.rect[k])) for k in moving] for _ in range(many))
    inner = ([tuple(a + (b - a) * Fraction(rng.randrange(9), 8) for a, b in s.rect[k]) for k in moving] for _ in range(many))
    for points in itertools.chain(corners, inner):
        yield {**still, **dict(zip(moving, points))}


def hull_area(points):
    """Of the convex hull, exact."""
    points, chain = sorted(set(points)), []
    for line in (points, points[::-1]):
        top = len(chain)
        for p in line:
            while len(chain) > top + 1 and cross(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        chain.pop()
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(chain, chain[1:] + chain[:1])) / 2 if len(chain) > 2 else Fraction(0)


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def corners_of(rect):
    return list(itertools.product(*rect))


def square_root(x, upward):
    """Of a rational, to 2^-200, rounded."""
    scaled = (x.numerator << 400) // x.denominator
    return Fraction(math.isqrt(scaled) + upward, 1 << 200)


def diagonal2(rect):
    return sum((b - a) ** 2 for a, b in rect)


def bounds_are_false(s, possible):
    """Against the sum, and the greatest term, of the pairs that are possible for some choice."""
    legal = [p for p in possible if s.kind.get(p) == 'L']
    if s.area is not None and s.area < sum(hull_area(corners_of(s.rect[i]) + corners_of(s.rect[j])) for i, j in possible):
        return 'the area'
    for i, j in possible if s.hausdorff is not None else ():
        longest = max((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 for a in corners_of(s.rect[i]) for b in corners_of(s.rect[j]))
        term = max(square_root(diagonal2(s.rect[k]), 0) for k in (i, j))
        if s.hausdorff < term + ((i, j) not in legal) * square_root(longest, 0) / 2:
            return 'the Hausdorff bound'
    return None


def near_far(rect, z):
    near = sum(max(a - c, c - b, Fraction(0)) ** 2 for (a, b), c in zip(rect, z))
    return near, sum(max(abs(a - c), abs(b - c)) ** 2 for (a, b), c in zip(rect, z))


def is_nearest(s, i, z):
    """Is z in the cell of i for every choice?"""
    far = near_far(s.rect[i], z)[1]
    return all(far < near_far(s.rect[k], z)[0] for k in s.site if k != i)


def polygons_are_false(s):
    x0, x1, y0, y1 = s.window
    left = (x1 - x0) * (y1 - y0)
    for i, at in s.polygons.items():
        if i in s.alias or not all(x0 <= x <= x1 and y0 <= y <= y1 and is_nearest(s, i, (x, y)) for x, y in at):
            return f'the polygon of {i}'
        left -= hull_area(at)
    return 'the undetermined area' if s.undetermined < left else None


def distance_is_false(rng, s, at):
    """Random points of the window that are in no cell for sure, for one choice: how far they are from its diagram."""
    x0, x1, y0, y1 = s.window
    for _ in range(20):
        z = x0 + (x1 - x0) * Fraction(rng.randrange(65), 64), y0 + (y1 - y0) * Fraction(rng.randrange(65), 64)
        if any(is_nearest(s, i, z) for i in s.site):
            continue
        away = {k: (at[k][0] - z[0]) ** 2 + (at[k][1] - z[1]) ** 2 for k in s.site}
        a = min(away, key=away.get)
        apart = [(away[k] - away[a], (at[k][0] - at[a][0]) ** 2 + (at[k][1] - at[a][1]) ** 2) for k in s.site if at[k] != at[a]]
        if not apart or all(more ** 2 > 4 * s.distance ** 2 * length2 for more, length2 in apart):
            return f'the distance at {z}'
    return None


def triangles_are_false(s, at):
    """T is at most the number of empty triangles of legal edges."""
    legal = {p for p, kind in s.kind.items() if kind == 'L'}
    count = 0
    for a, b, c in itertools.combinations(s.site, 3):
        if {(a, b), (a, c), (b, c)} <= legal:
            way = sign(cross(at[a], at[b], at[c]))
            inside = [k for k in s.site if k not in (a, b, c) and
                      all(sign(cross(at[p], at[q], at[k])) == way for p, q in ((a, b), (b, c), (c, a)))]
            count += way != 0 and not inside
    return 'the number of triangles' if s.triangles > count else None


def facts_are_false(s):
    """Facts and places of described points."""
    for block in s.blocks:
        for k, at in block.at.items():
            if any(sign(x - low) < 0 or sign(high - x) < 0 for x, (low, high) in zip(at, s.rect[k])):
                return f'the place of {k}'
        for kind, sites in block.facts:
            p = [block.at[k] for k in sites]
            if kind == 'same' and any(sign(x - y) for x, y in zip(*p)):
                return f'the fact on {sites}'
            if kind == 'line' and any(sign(cross(p[0], p[1], q)) for q in p[2:]):
                return f'the fact on {sites}'
            if kind == 'circle' and any(sign(in_circle(p[0], p[1], p[2], q)) for q in p[3:]):
                return f'the fact on {sites}'
    return None


def in_circle(*p):
    (ax, ay), (bx, by), (cx, cy) = [(q[0] - p[3][0], q[1] - p[3][1]) for q in p[:3]]
    return (ax * ax + ay * ay) * (bx * cy - cx * by) - (bx * bx + by * by) * (ax * cy - cx * ay) + \
        (cx * cx + cy * cy) * (ax * by - bx * ay)


def aliases_are_false(s):
    """An alias is stated to be its site: seen by places, or by a chain of facts."""
    same = [sites for block in s.blocks for kind, sites in block.facts if kind == 'same']
    for i, of in s.alias.items():
        if all(a == b for a, b in s.rect[of]):
            continue
        reached = {i}
        for _ in same:
            reached |= {k for pair in same if reached & set(pair) for k in pair}
        if of not in reached:
            return f'the alias {i}'
    return None


def reached(s):
    bound = {'area': s.area, 'hausdorff': s.hausdorff, 'voronoi area': s.window and s.undetermined,
             'voronoi hausdorff': s.distance}[s.goal]
    return bound is not None and bound <= Fraction(2) ** -s.goal_bits


def judge(rng, text, answer, many=24):
    """Returns a statement that a checker took for proved and that is false, or None."""
    s = Statement(text)
    everything, ties, complete = answer.status == ALL, answer.ties, answer.complete
    counted = 'not proved: corners and the numbers of triangles' not in answer.stdout
    seen = collections.defaultdict(set)
    listed = collections.Counter(s.kind.values())
    if everything:
        if listed['l'] or s.outcome in ('budget', 'cancelled', 'error'):
            return 'what nothing proves'
        if s.outcome == 'decided' and (set(s.kind.values()) - {'L', 'n'} or s.capped):
            return 'the outcome decided'
        if s.outcome == 'certified' and (s.goal == 'decided' or not reached(s)):
            return 'the outcome certified'
    wrong = facts_are_false(s) or (everything and aliases_are_false(s)) or (s.window and polygons_are_false(s))
    for at in choices(rng, s, many):
        if wrong:
            return wrong
        places = whole(at)
        for pair in s.pairs():
            seen[pair].add(status(places, *pair))
        wrong = (counted and triangles_are_false(s, places)) or (s.distance is not None and not s.described() and
                                                   distance_is_false(rng, s, at))
    if wrong:
        return wrong
    for pair in s.pairs():
        kind = s.kind.get(pair, '')
        if kind == 'L' and not seen[pair] <= {STRICT, PLACE}:
            return f'{pair} is legal'
        if (kind == 'n' or (kind == '' and complete)) and seen[pair] != {NONE}:
            return f'{pair} is illegal'
        if kind == 't' and everything and seen[pair] != {WEAK}:
            return f'{pair} is a tie'
    if ties > sum(kind == 't' and seen[pair] == {WEAK} for pair, kind in s.kind.items()):
        return f'{ties} ties'
    possible = [pair for pair in seen if seen[pair] != {NONE}]
    if everything and s.outcome == 'fixpoint' and s.goal == 'decided' and not s.capped:
        if any(kind == 'o' and len(seen[pair]) > 1 for pair, kind in s.kind.items()):
            return 'the outcome fixpoint'
    return bounds_are_false(s, possible) if complete else None


# ---- true certificates ----

CIRCLE = [(5, 0), (4, 3), (3, 4), (0, 5), (-3, 4), (-4, 3), (-5, 0), (-4, -3), (-3, -4), (0, -5), (3, -4), (4, -3)]


def spread(rng, count, size):
    return [(rng.randrange(size), rng.randrange(size)) for _ in range(count)]


def text_of(points):
    return ''.join(f'{x} {y}\n' for x, y in points)


def exact(rng):
    den = rng.choice((1, 1, 3, 8))
    return text_of((f'{x}/{den}', f'{y}/{den}') for x, y in set(spread(rng, rng.randrange(1, 10), 12)))


def lattice(rng):
    return text_of(set(spread(rng, rng.randrange(4, 10), 3)))


def circles(rng):
    x, y = rng.randrange(3), rng.randrange(3)
    ring = rng.sample(CIRCLE, rng.randrange(4, 7))
    return text_of([(f'{a + x}/3', f'{b + y}/3') for a, b in ring] + [(f'{a}', f'{b}') for a, b in spread(rng, rng.randrange(3), 4)])


def lines(rng):
    dx, dy = rng.randrange(1, 4), rng.randrange(-2, 3)
    row = [(k * dx, k * dy) for k in rng.sample(range(9), rng.randrange(3, 6))]
    return text_of(set(row + [(a, b + 9) for a, b in spread(rng, rng.randrange(3), 9)]))


def box(rng, size, widths):
    ends = []
    for _ in range(2):
        low = Fraction(rng.randrange(8 * size), 8)
        ends.append(f'[{float(low)},{float(low + rng.choice(widths))}]')
    return ' '.join(ends) + '\n'


def boxes(rng):
    return ''.join(box(rng, 12, (Fraction(1, 64), Fraction(1, 4), 1)) for _ in range(rng.randrange(2, 8)))


def crowds(rng):
    return ''.join(box(rng, 4, (1, 2, 3)) for _ in range(rng.randrange(2, 7)))


def mixed(rng):
    return lattice(rng) + ''.join(box(rng, 5, (Fraction(1, 64), Fraction(1, 8), 1)) for _ in range(rng.randrange(1, 3)))


def roots(rng):
    """Points on a circle or a line, or lattice points times a root."""
    r, way = rng.choice((2, 3, 5, 7)), rng.randrange(3)
    if way == 0:
        square = [(f'sqrt({r})', '0'), ('0', f'sqrt({r})'), (f'-sqrt({r})', '0'), ('0', f'-sqrt({r})')]
        return text_of(square[:rng.randrange(3, 5)] + [(f'{a}/4', f'{b}/8+9') for a, b in set(spread(rng, rng.randrange(3), 8))])
    if way == 1:
        return text_of((f'{k}*sqrt({r})', f'{2 * k}*sqrt({r})+1') for k in rng.sample(range(-4, 5), rng.randrange(3, 6)))
    return text_of((f'{x}*sqrt({r})', f'{y}*sqrt({r})') for x, y in set(spread(rng, rng.randrange(4, 8), 3)))


def aliases(rng):
    points = [tuple(p) for p in set(spread(rng, rng.randrange(2, 6), 4))]
    same = rng.choice([('sqrt(8)', '2*sqrt(2)'), ('sqrt(12)', '2*sqrt(3)'), ('sqrt(2)*sqrt(3)', 'sqrt(6)'), ('7', '7')])
    return text_of([*points, (same[0], '5'), (same[1], '5')])


GOALS = ((), (), (), ('--until', 'area:-9'), ('--until', 'hausdorff:-9'), ('--max-bits', '40'))
KINDS = [exact, lattice, circles, lines, boxes, crowds, mixed, roots, aliases]

# ---- changes ----


def section(rows, name):
    first = next(k for k, row in enumerate(rows) if row.startswith(f'{name} ')) + 1
    return first, first + int(rows[first - 1].split(' ')[1])


def with_count(rows, name, more):
    k = section(rows, name)[0] - 1
    rows[k] = f'{name} {int(rows[k].split(" ")[1]) + more}'


def pair_rows(rows):
    """Numbers of the first line on a pair and of the one behind the last."""
    first = rows.index('pairs') + 1
    return first, next(k for k in range(first, len(rows)) if re.match('triangles|boxes', rows[k]))


def with_pair(rows, kind, i, j):
    """A line on the pair more, in its place; no other one is left."""
    first, last = pair_rows(rows)
    key = lambda row: tuple(map(int, row.split(' ')[1:3]))  # noqa: E731
    kept = [row for row in rows[first:last] if key(row) != (i, j)]
    rows[first:last] = sorted([*kept, f'{kind} {i} {j}'], key=key) if kind.strip() else kept
    if 'outcome decided' in rows:
        rows[rows.index('outcome decided')] = 'outcome fixpoint'


def legal_to_open(rng, rows):
    """One to three legal pairs are said to be ties, or legal without a witness, or open, or illegal."""
    for _ in range(rng.randrange(1, 4)):
        first, last = section(rows, 'legal')
        if first == last:
            return
        k = rng.randrange(first, last)
        i, j, *_ = rows.pop(k).split(' ')
        with_count(rows, 'legal', -1)
        with_pair(rows, rng.choice('tttlo '), int(i), int(j)) if rng.randrange(6) else None


def other_status(rng, rows):
    first, last = pair_rows(rows)
    for k in range(first, last):
        if rng.randrange(2) and rows[k][0] in 'otl':
            rows[k] = rng.choice('otl') + rows[k][1:]


def any_pair(rng, rows):
    count = int(next(row for row in rows if row.startswith('sites ')).split(' ')[1])
    if count > 1:
        with_pair(rows, rng.choice('tttlo'), *sorted(rng.sample(range(count), 2)))


def lost_pair(rng, rows):
    first, last = pair_rows(rows)
    if first < last:
        rows.pop(rng.randrange(first, last))


def other_words(rng, rows):
    """An outcome, a goal, the cap."""
    k = rng.randrange(1, 4)
    rows[k] = rng.choice([['outcome decided', 'outcome fixpoint', 'outcome certified', 'outcome budget', 'outcome error'],
                          ['goal decided', 'goal area -9', 'goal area 40', 'goal hausdorff -3', 'goal voronoi area -9',
                           'goal voronoi hausdorff 3'], ['capped no', 'capped yes']][k - 1])


def other_number(rng, rows):
    k = rng.randrange(4, len(rows) - 1)
    words = rows[k].split(' ')
    w = rng.randrange(len(words))
    new = ['0', '1', '3', '-1', '1*2^-1', '3*2^40', words[-1], words[0]]
    words[w] = rng.choice([*new, words[w].replace('2', '3', 1), '-' + words[w].lstrip('-')])
    rows[k] = ' '.join(words)


def moved_site(rng, rows):
    """A site is another point, or box."""
    first, last = section(rows, 'sites')
    if first < last:
        k = rng.randrange(first, last)
        words = rows[k].split(' ')
        words[rng.randrange(len(words))] = rng.choice(['0', '1', '1*2^1', '3', '1/3', '1*2^-2', '0+1', '1+1*2^-1'])
        rows[k] = ' '.join(words)


def other_alias(rng, rows):
    first, last = section(rows, 'sites')
    if last - first > 1:
        k = rng.randrange(first + 1, last)
        rows[k] = f'= {rng.randrange(k - first)}'


def other_lines(rng, rows):
    a, b = (rng.randrange(1, len(rows) - 1) for _ in range(2))
    way = rng.randrange(3)
    if way == 0:
        rows[a], rows[b] = rows[b], rows[a]
    elif way == 1:
        rows.pop(a)
    else:
        rows.insert(a, rows[a])


def other_bound(rng, rows):
    places = [k for k, row in enumerate(rows) if re.match(r'(area|hausdorff|undetermined|distance) ', row)]
    k = rng.choice(places)
    name, word, *_ = rows[k].split(' ')
    if re.match(r'-?\d', word):
        value = dyadic(word) * rng.choice((Fraction(1, 2), Fraction(3, 4), 2, 1, 0, -1))
        rows[k] = f'{name} {spelled(value)}' + rng.choice(('', '', ' unproved' * (name == 'distance')))
    elif rng.randrange(2):
        rows[k] = f'{name} {rng.choice(("0", "1*2^10", "1*2^-3"))}'


def spelled(value):
    man, exponent = value.numerator, 1 - value.denominator.bit_length()
    while man and man % 2 == 0:
        man, exponent = man // 2, exponent + 1
    return f'{man}*2^{exponent}' if man and exponent else f'{man}'


def other_block(rng, rows):
    """A line of the blocks, or facts of other sites, or none."""
    first = next((k for k, row in enumerate(rows) if row.startswith('algebra ')), None)
    if first is None:
        return other_number(rng, rows)
    k = rng.randrange(first, len(rows) - 2)
    words = rows[k].split(' ')
    if words[0] in ('circle', 'line', 'same'):
        words[0] = rng.choice((words[0], 'circle', 'line', 'same'))
        words[-1] = rng.choice(('identity', 'bound'))
        if rng.randrange(2):
            words[1:-1] = rng.sample(words[1:-1], rng.randrange(1, len(words) - 1))
    else:
        w = rng.randrange(len(words))
        words[w] = rng.choice(('0', '1', '2', '3', '+', 'neg', 'sqrt', words[-1], words[0]))
    rows[k] = ' '.join(words)
    return None


WAYS = [legal_to_open, legal_to_open, legal_to_open, other_status, any_pair, lost_pair, other_words, other_number, moved_site,
        other_alias, other_lines, other_bound, other_block]
COUNTS = ((r'there are (\d+) sure', 'triangles'), (r'listed, (\d+) are not proved', 'unproved'), (r'boxes prove (\d+) pairs', 'boxes'))


def without_corners(text):
    return re.sub(r'\ncorners \d+\n.*?\npairs\n', '\ncorners 0\npairs\n', text, flags=re.S)


def counts_right(ask, text):
    """The text with what verify says is wrong put right, where it follows from the rest: counts, and corners, which there
    are none of where the faces are not found."""
    for _ in range(5):
        said = ask(text).stderr
        if 'to be a corner' in said:
            text = without_corners(text)
            continue
        for pattern, name in COUNTS:
            found = re.search(pattern, said)
            if found:
                text = re.sub(rf'\n{name} [^\n]*\n', f'\n{name} {found[1]}\n', text)
                break
        else:
            return text
    return text


# ---- verdicts ----

# name; exit statuses of verify, and of dyadel-proved; patterns of their output
DIFFERENCES = [
    ('points in discs', (ALL, NOT_ALL, REJECTED), (NOT_ALL,), '', 'not proved: [^\n]* (for|of) points in discs'),
    ('places on a sphere', (ALL, NOT_ALL, REJECTED), (NOT_ALL,), '', 'not proved: the projection: '),
    ('nearest places', (ALL, NOT_ALL, REJECTED), (NOT_ALL,), '', 'not proved: which sites are nearest'),
    ('graphs of neighbours', (ALL, NOT_ALL, REJECTED), (NOT_ALL,), '', 'not proved: the graph '),
    ('places and bridges', (REJECTED,), (ALL, NOT_ALL), r'no witness of|the place is not in|a bridge joins', 'not used: places'),
    ('pairs in no open set', (REJECTED,), (ALL, NOT_ALL), 'in no open set', ''),
    ('ties beside boxes', (NOT_ALL,), (ALL,), r'not proved: that \d+ pairs are ties\n$', ''),
    ('fixpoint by faces', (ALL,), (NOT_ALL,), 'checked: the outcome fixpoint', r'\n(?!not proved)[^\n]*\nnot proved: the outcome fixpoint\n$'),
]


class Answer:
    def __init__(self, done):
        self.status, self.stdout, self.stderr = done.returncode, done.stdout, done.stderr
        self.said = self.stdout + self.stderr
        self.ties = int((re.search(r'checked: (\d+) ties,', done.stdout) or (0, 0))[1])
        self.complete = 'checked: all pairs that are not listed are illegal' in done.stdout

    def reason(self):
        """Why not all of it is proved, without numbers."""
        rows = [self.stderr] if self.status == REJECTED else re.findall(r'not proved: [^\n]*', self.stdout)
        return '; '.join(re.sub(r'\d+', 'N', re.sub(r'^.*rejected: ', '', row)).strip() for row in rows)


class Checkers:
    def __init__(self, root, proved, dyadel, folder):
        self.proved, self.dyadel, self.folder = proved, dyadel, folder
        self.parts = verdict_parts.Parts(root, dyadel)

    def ask(self, text, *command):
        with tempfile.NamedTemporaryFile('w', dir=self.folder, suffix='.txt') as file:
            file.write(text)
            file.flush()
            done = subprocess.run([*(command or (self.dyadel, 'verify')), file.name], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, check=False, timeout=300)
        return done

    def certificate(self, points, *options, command='delaunay'):
        target = tempfile.mktemp(dir=self.folder)
        done = self.ask(points, self.dyadel, command, '--quiet', '-o', '/dev/null', '--certificate', target, *options)
        if done.returncode == REJECTED and 'give --window' in done.stderr:  # of one place: there is no window by default
            return self.certificate(points, *options)
        assert done.returncode in (0, 3, 4), (done, points)
        text = pathlib.Path(target).read_text()
        os.unlink(target)
        return text


class Count:
    def __init__(self):
        self.verdicts, self.why, self.beyond, self.judged, self.faults = collections.Counter(), collections.Counter(), 0, 0, []
        self.example = {}


def difference(here, there):
    for name, first, second, verify, proved in DIFFERENCES:
        if here.status in first and there.status in second and re.search(verify, here.said) and re.search(proved, there.said):
            return name
    return None


def judge_parts(both, rng, text, answer, here):
    """Answers about parts that the plane has not: what verify proves of these, and what the rectangles show; of images
    only dyadel-proved's, which proves nothing of their places."""
    wrong = both.parts.judge(rng, text, answer) if here else None
    if wrong or '\ngoal nearest\n' in text or (here and '\nsphere\n' in text):
        return wrong
    answer.status = NOT_ALL
    return judge(rng, text, answer)


def try_text(both, count, rng, text, name):
    """Runs both on one certificate, and the oracle on each that accepts it."""
    here = Answer(both.ask(text))
    there = Answer(both.ask(text, both.proved)) if both.proved else here
    for answer in (here, there):
        if answer.status not in WORD:
            count.faults.append(f'{name}: exit status {answer.status}, {answer.stderr}:\n{text}')
            return
    count.verdicts[name, here.status, there.status] += 1
    if here.status != there.status:
        why = difference(here, there) or f'{WORD[here.status]} ({here.reason()}) but {WORD[there.status]} ({there.reason()})'
        count.why[why] += 1
        count.example.setdefault(why, text)
        if not difference(here, there):
            count.faults.append(f'{name}: {why}')
    for answer in [here] + [there] * (here.status != there.status):
        if answer.status == REJECTED:
            continue
        try:
            more = re.search(r'\n(sphere|discs|graph|goal nearest)\b', text)
            false = judge_parts(both, rng, text, answer, answer is here) if more else judge(rng, text, answer)
            count.judged += 1
        except Beyond:
            count.beyond += 1
            continue
        if false:
            count.faults.append(f'{name}: {false}, {WORD[answer.status]}:\n{answer.stdout}{text}')


def changed(rng, both, text):
    """The text with one change, or two; the counts put right."""
    while True:
        rows = text.split('\n')
        with contextlib.suppress(StopIteration, ValueError, IndexError):  # a second change may find no certificate
            for _ in range(1 if rng.randrange(4) else 2):
                rng.choice(WAYS)(rng, rows)
        other = counts_right(both.ask, '\n'.join(rows))
        if other != text:
            return other


def try_case(both, number):
    """One true certificate and its changes."""
    rng, count = random.Random(SEED * 10**6 + number), Count()
    kind = number % (len(KINDS) + len(both.parts.commands)) - len(KINDS)
    if kind >= 0:
        text = both.parts.certificate(rng, both.parts.commands[kind])
    else:
        command = 'voronoi' if rng.randrange(5) == 0 else 'delaunay'
        text = both.certificate(KINDS[kind](rng), *rng.choice(GOALS), command=command)
    try_text(both, count, rng, text, 'true')
    for _ in range(CHANGES):
        plane = kind < 0 or (rng.randrange(4) == 0 and '\ngoal nearest\n' not in text)
        try_text(both, count, rng, changed(rng, both, text) if plane else both.parts.changed(rng, text), 'changed')
    return count


def main():
    root, proved, dyadel = pathlib.Path(sys.argv[1]), *sys.argv[2:4]
    first, last = 0, 60 * int(os.environ.get('DYADEL_TEST_SCALE', '1'))
    if len(sys.argv) > 4:
        *begin, last = map(int, sys.argv[4].split('-'))
        first = sum(begin)
    total = Count()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        both = Checkers(root, None if proved == '-' else proved, dyadel, folder)
        for count in pool.map(lambda k: try_case(both, k), range(first, last)):
            total.verdicts += count.verdicts
            total.why += count.why
            total.judged, total.beyond = total.judged + count.judged, total.beyond + count.beyond
            total.faults += count.faults
            total.example = {**count.example, **total.example}
    print(f'seed {SEED}, cases {first} to {last - 1}')
    for (name, here, there), many in sorted(total.verdicts.items()):
        print(f'{name}: verify {WORD[here]}, dyadel-proved {WORD[there]}: {many}')
    for why, many in total.why.most_common():
        print(f'{many} times: {why}')
    print(f'judged by the oracle: {total.judged}, beyond it: {total.beyond}')
    said = (root / 'proofs/SOUNDNESS.md').read_text()
    total.faults += [f'SOUNDNESS.md does not name "{name}"' for name, *_ in DIFFERENCES if name not in said]
    if os.environ.get('DYADEL_TEST_EXAMPLES'):
        for why, text in total.example.items():
            print(f'==== {why}\n{text}')
    print('\n'.join(total.faults) or 'no fault')
    return 1 if total.faults else 0


if __name__ == '__main__':
    sys.exit(main())
