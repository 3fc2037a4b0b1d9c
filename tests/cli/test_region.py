#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""T as a region: partial edges and triangles as hulls, and the exterior of all possible edges [EXT-1], against their definitions.

A place is in the exterior if it is in no hull of a possible pair. Places tried: all on a grid, corners and middles of what
is drawn, and beside them.

Usage: test_region.py COMMAND DATA
"""
import csv
import itertools
import random
import re
from fractions import Fraction as Q

from harness import cases, expect, main, run


def table(points, layer, *options):
    result = run('delaunay', '--quiet', '--layer', layer, *options, '-', stdin=points, comments=False)
    assert result.code in (0, 3), result.err
    return list(csv.DictReader(result.out.splitlines()))


def corners(text):
    return [tuple(map(Q, z.split())) for z in text.split(';')]


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def hull(points):
    """By definition: the points that are between no two others and inside of no triangle, by walking around."""
    points = sorted(set(points))
    if len(points) < 3:
        return points
    def half(list_):
        out = []
        for p in list_:
            while len(out) > 1 and turn(out[-2], out[-1], p) <= 0:
                out.pop()
            out.append(p)
        return out[:-1]
    return half(points) + half(points[::-1])


def in_hull(z, ring):
    """In the closed hull."""
    if len(ring) == 1:
        return z == ring[0]
    if len(ring) == 2:
        a, b = ring
        return turn(a, b, z) == 0 and min(a, b) <= z <= max(a, b)
    return all(turn(a, b, z) >= 0 for a, b in zip(ring, ring[1:] + ring[:1]))


def box(xlo, xhi, ylo, yhi):
    return [(x, y) for x in (xlo, xhi) for y in (ylo, yhi)]


def line(r):
    return '[{},{}] [{},{}]'.format(*r)


def winding(z, ring):
    """Twice the number of turns around z; None: z is on the ring."""
    total = 0
    for a, b in zip(ring, ring[1:] + ring[:1]):
        t = turn(a, b, z)
        if t == 0 and min(a, b) <= z <= max(a, b):
            return None
        if (a[1] <= z[1]) != (b[1] <= z[1]):
            total += 1 if b[1] > a[1] and t > 0 else -1 if b[1] <= a[1] and t < 0 else 0
    return total


def in_exterior(z, rings):
    """Of rings: in a bounded component, or outside of the ring of the unbounded one."""
    numbers = [winding(z, ring) for ring in rings]
    if None in numbers:
        return False
    if not rings:
        return True
    assert numbers[0] in (0, -1) and all(n in (0, 1) for n in numbers[1:]) and sum(numbers[1:]) <= 1, numbers
    return sum(numbers[1:]) == 1 or numbers[0] == 0


def judge(rects, places=()):
    text = ''.join(line(r) + '\n' for r in rects)
    boxes = [box(*r) for r in rects]
    rows = table(text, 'hulls')
    pairs = {(int(r['i']), int(r['j'])): r['status'] for r in table(text, 'pairs')}
    assert {(int(r['i']), int(r['j'])): r['status'] for r in rows if not r['k']} == pairs
    hulls = []
    for r in rows:
        own = [boxes[int(r[k])] for k in 'ijk' if r[k]]
        ring = corners(r['corners'])
        assert ring == hull(sum(own, [])), (r, hull(sum(own, [])))
        if r['k']:
            assert r['status'] == 'certain'
        else:
            hulls.append(ring)
    parts = table(text, 'exterior')
    rings = [corners(p['corners']) for p in parts]
    assert [p['part'] for p in parts] == ['unbounded'] * bool(hulls) + ['bounded'] * max(len(rings) - 1, 0)
    for ring in rings:
        assert ring[0] == min(ring) and all(a != b for a, b in zip(ring, ring[1:] + ring[:1])), ring
    drawn = [z for ring in hulls + rings for z in ring]
    middles = [tuple((a + b) / 2 for a, b in zip(p, q)) for ring in hulls + rings for p, q in zip(ring, ring[1:] + ring[:1])]
    tried = set(drawn) | set(middles) | set(places)
    tried |= {(x + Q(dx, 64), y + Q(dy, 81)) for x, y in (drawn + middles)[:60] for dx in (-1, 1) for dy in (-1, 1)}
    for z in tried:
        wanted = not any(in_hull(z, h) for h in hulls)
        assert in_exterior(z, rings) == wanted, (text, z, wanted)
    return rings


def test_small():
    """All sets of two and three points of a small grid, exact and boxes."""
    grid = [(Q(x), Q(y)) for x in (-1, 1, 3) for y in (-1, 1, 3)]
    sides = [(Q(x), Q(x), Q(y), Q(y)) for x in range(3) for y in range(3)]
    for few in (2, 3):
        for some in list(itertools.combinations(sides, few))[::1 if few == 2 else 3]:
            judge(some, grid)
    assert judge([(Q(0), Q(0), Q(0), Q(0))]) == []
    assert judge([(Q(0), Q(0), Q(0), Q(0)), (Q(2), Q(2), Q(1), Q(1))]) == [[(0, 0), (2, 1)]]
    square = judge([(Q(x), Q(x), Q(y), Q(y)) for x in (0, 2) for y in (0, 2)])  # both diagonals are ties: four triangles
    assert len(square) == 5 and [(Q(1), Q(1)) in ring for ring in square] == [False, True, True, True, True]


def test_random():
    rand = random.Random(7)
    for number in range(cases(60)):
        n, wide = rand.randrange(2, 9), rand.choice((0, 1, 2, 4))
        rects = []
        for _ in range(n):
            x, y = rand.randrange(-8, 9), rand.randrange(-8, 9)
            w, h = (rand.randrange(wide + 1) if rand.random() < 0.7 else 0 for _ in range(2))
            rects.append((Q(x, 2), Q(x + w, 2), Q(y, 2), Q(y + h, 2)))
        judge(rects, [(Q(x, 3), Q(y, 3)) for x in range(-15, 16, 4) for y in range(-15, 16, 4)])


def test_exact_rationals_and_large():
    judge([(Q(1, 3), Q(1, 3), Q(1, 7), Q(1, 7)), (Q(5), Q(5), Q(2, 3), Q(2, 3)), (Q(2), Q(2), Q(4), Q(4)), (Q(2), Q(2), Q(9, 5), Q(9, 5))])
    judge([(Q(10**30), Q(10**30) + 1, Q(0), Q(0)), (Q(0), Q(0), Q(0), Q(0)), (Q(0), Q(1), Q(10**30), Q(10**30))])


def test_formats():
    """Polygons of wkt are within the error they state; identifiers; what is refused."""
    points = ''.join(f'{x}+-0.25 {y}+-0.25\n' for x, y in ((0, 0), (9, 1), (4, 8), (5, 3)))
    exact = [corners(r['corners']) for r in table(points, 'exterior')]
    for row, ring in zip(table(points, 'exterior', '--format', 'wkt'), exact):
        shown = [tuple(map(Q, z.split())) for z in re.search(r'\(\(\((.*)\)\)\)', row['WKT'])[1].split(',')]
        error = Q(row['max_coordinate_error'])
        assert shown[0] == shown[-1] and len(shown) == len(ring) + 1
        assert all(abs(a - b) <= error for p, q in zip(shown, ring) for a, b in zip(p, q))
    named = table('x,y,n\n0,0,a\n3,0,b\n0,3,c\n', 'hulls', '--columns', 'x,y', '--id', 'n')
    assert [[r['id_i'], r['id_j'], r['id_k']] for r in named] == [['a', 'b', ''], ['a', 'c', ''], ['b', 'c', ''], ['a', 'b', 'c']]
    for layer in ('exterior', 'hulls', 'ties'):
        expect(run('delaunay', '--discs', '--layer', layer, 'none'), 2, '', f'delaunay --discs does not write --layer {layer}; give')
    for name in ('json', 'obj', 'vtk'):
        expect(run('delaunay', '--discs', '-o', f'x.{name}', 'none'), 2, '', f'delaunay --discs does not write {name}; give')
    expect(run('delaunay', '--max-pairs', '3', '--layer', 'exterior', '-', stdin=''.join(f'[0,1] [{k},{k + 9}]\n' for k in range(9))), 4, r'\A\Z', 'raise --max-pairs')


main(globals())
