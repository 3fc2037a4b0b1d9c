#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel delaunay decides every set of computable points in general position, however near it is to a circle, a line or a
lattice [WIT-FLT], with about the bits by which it differs from that. Statuses are compared with brute force in integers.

Usage: test_decided.py COMMAND DATA
"""
import json
import os
import random
import re
import tempfile
from decimal import Decimal
from fractions import Fraction
from itertools import combinations

from mpmath import mp, mpf

from harness import expect, main, run

BITS = 1200
SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))

# Five points of a short arc whose radii differ by multiples of 2^-100: 2,4 is an edge.
ARC = [(81, 31), (32, 40), (25, 15), (46, 39), (9, 67)]


def integers(points):
    """The points as integers in units of 2^-BITS, from texts that mpmath reads as the command does."""
    mp.prec = BITS + 64
    names = {f: getattr(mp, f) for f in ('cos', 'sin', 'sqrt', 'exp')}
    value = lambda t: int(mp.floor(eval(t.replace('^', '**').replace('2**-', 'mpf(2)**-'), {'mpf': mpf, **names}) * mpf(2) ** BITS))
    return [(value(x), value(y)) for x, y in points]


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def incircle(a, b, c, d):
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = rows
    sa, sb, sc = (x * x + y * y for x, y in rows)
    return sa * (bx * cy - by * cx) - sb * (ax * cy - ay * cx) + sc * (ax * by - ay * bx)


def edges(points):
    """Edges of the Delaunay triangulation, from all triangles with an empty circle. No test may be near 0."""
    found, margin = set(), 1 << BITS // 4
    for t in combinations(range(len(points)), 3):
        a, b, c = (points[k] for k in t)
        side = turn(a, b, c)
        assert abs(side) > margin
        signs = [incircle(a, b, c, points[k]) * (1 if side > 0 else -1) for k in range(len(points)) if k not in t]
        assert all(abs(s) > margin for s in signs)
        if all(s < 0 for s in signs):
            found.update(combinations(t, 2))
    return found


def decided(points, most_bits):
    result = run('delaunay', '-', '--stats', stdin=''.join(f'{x} {y}\n' for x, y in points))
    assert result.code == 0, result.err
    rows = {tuple(map(int, r.split(',')[:2])): r.split(',')[2] for r in result.out.split()[1:]}
    want = edges(integers(points))
    assert rows == {e: 'legal' for e in want}, (points, sorted(want), rows)
    bits = int(re.search(r'bits asked, most +(\d+)', result.err).group(1))
    assert bits <= most_bits, (points, bits, most_bits)


def arc(weights, step, bits):
    return [(f'cos({k}/{step})*(1+{a}*2^-{bits})', f'sin({k}/{step})*(1+{b}*2^-{bits})') for k, (a, b) in enumerate(weights)]


def test_five_points_of_an_arc():
    points = arc(ARC, 100, 100)
    assert (2, 4) in edges(integers(points))
    decided(points, 256)


def test_boxes_of_the_arc():
    """The boxes alone are enough: width 2^-152."""
    boxes = [[f'[{v >> BITS - 152}*2^-152,{(v >> BITS - 152) + 1}*2^-152]' for v in p] for p in integers(arc(ARC, 100, 100))]
    result = run('delaunay', '-', stdin=''.join(' '.join(b) + '\n' for b in boxes))
    assert result.code == 0 and '2,4,legal' in result.out.split(), result.err


def test_discs_of_computed_points_hold_them():
    """At every precision the disc used for a computed point with a radius, half as wide as its square and by 2^-50 of
    the coordinates wider, holds the disc around the point [DISC-4]."""
    r = random.Random(SEED)
    for bits in (*range(2, 24), 40, 64, 65):
        texts = [(f'sqrt({r.randint(2, 99)})*2^-{k % 3}', f'exp(1/{r.randint(2, 9)})+{k}') for k in range(6)]
        radius = Fraction(r.randint(1, 40), 64)
        result = run('delaunay', '-', '--radius', str(radius), '--max-bits', str(bits), '--format', 'json',
                     stdin=''.join(f'{x} {y}\n' for x, y in texts))
        assert result.code in (0, 3, 4), result.err
        for place, true in zip(json.loads(result.out)['sites'], integers(texts)):
            sides = [[exact(end) for end in place[axis]] for axis in 'xy']
            room = sum(abs(a + b) + b - a for a, b in sides) / 2 ** 50
            half = (max(b - a for a, b in sides) + room) / 2
            off = [Fraction(t, 1 << BITS) - (a + b) / 2 for t, (a, b) in zip(true, sides)]
            assert half >= radius and sum(d * d for d in off) <= (half - radius) ** 2, (bits, texts, radius)


def discs_of(points, bits, *more):
    """Of a certificate: the sides and the disc of each point."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'cert')
        result = run('delaunay', '-', '--discs', '--max-bits', str(bits), '--certificate', path, *more,
                     stdin=''.join(f'{x} {y}\n' for x, y in points))
        assert result.code in (0, 3, 4), (points, bits, result.err)
        lines = open(path).read().splitlines()
        assert run('verify', path).code in (0, 3)
    n = len(points)
    first, discs = (next(k for k, row in enumerate(lines) if row.startswith(word)) + 1 for word in ('sites ', 'discs '))
    sides = [[(end(side.split('+')[0]), end(side)) for side in row.split()] for row in lines[first:first + n]]
    return sides, [[end(number) for number in row.split()] for row in lines[discs:discs + n]]


def end(text):
    """m*2^e, or one that another number is added to."""
    return sum(map(exact, text.split('+')))


def test_discs_of_bare_points_hold_their_rectangles():
    """Without a radius a point may be anywhere in the rectangle that was reached, in its corners too, and a narrower
    rectangle has its disc inside of that before [DISC-5]."""
    r = random.Random(SEED)
    for _ in range(8):
        points = [(r.choice([f'sqrt({r.randint(2, 99)})', '3', '-7/3']), f'exp(1/{r.randint(2, 9)})*{k}+{k}') for k in range(6)]
        before = [None] * len(points)
        for bits in (2, 3, 4, 6, 9, 20):
            sides, discs = discs_of(points, bits)
            for k, ((xs, ys), (x, y, radius)) in enumerate(zip(sides, discs)):
                assert all((a - x) ** 2 + (b - y) ** 2 <= radius ** 2 for a in xs for b in ys), (points, bits, k)
                if before[k]:
                    was = before[k]
                    assert was[2] >= radius and (was[0] - x) ** 2 + (was[1] - y) ** 2 <= (was[2] - radius) ** 2, (points, bits, k)
                before[k] = x, y, radius


def test_sides_that_rounding_makes_unequal():
    """One side exact, the other computed: a disc all the same; radii that differ are refused."""
    for point in (('3', 'sqrt(7)'), ('sqrt(2)', '1/3')):
        for bits in (2, 3, 7, 30):
            for radius in ((), ('--radius', '0.4'), ('--radius', '1e-30')):
                discs_of([point, ('1', '1'), ('0', 'e')], bits, *radius)
    refused = run('delaunay', '-', '--discs', stdin='3 sqrt(7)+-0.1\n1 1\n')
    assert refused.code == 1 and 'one radius' in refused.err, refused


def test_discs_of_decimals_are_not_rounded():
    """Far from the origin, where 2^-50 of the coordinates is a quarter of a radius, decimals have the discs they state."""
    rows = (('0.0036', '-0.003', '0.000375'), ('0.005', '0.0016', '0.0000375'), ('0.0032', '-0.0014', '0.0005'))
    for x, y in ((0, 0), (-10**9, 10**11), (10**11, -10**9), (3 * 10**11, 0)):
        text = 'x,y,r\n' + ''.join(f'{Decimal(a) + x},{Decimal(b) + y},{r}\n' for a, b, r in rows)
        expect(run('delaunay', '--discs', '--columns', 'x,y', '--radius-column', 'r', '-', stdin=text), 0,
               r'(?s)0,1,legal\n0,2,legal\n1,2,legal\n')


def test_discs_are_refined_as_far_as_they_are_told():
    """Squares may be settled before discs are: 0,1 is legal, whatever precision is requested first."""
    points = """-1.5999999999 6.2999999999+sqrt(3)/25
-2.4999999999+cos(24)*3/50 -6+cbrt(18)/25
6.3+sqrt(10)*3/50 -1.5999999999+sqrt(16+sqrt(2))*3/50
-5.6+exp(15/20)/25 -3.2999999999+cos(27)*3/50
"""
    for more in ((), ('--start-bits', '9'), ('--start-bits', '2'), ('--start-bits', '200')):
        result = run('delaunay', '-', '--discs', '--radius', '0.025', *more, stdin=points)
        assert result.code == 0 and '0,1,legal' in result.out.split() and 'indeterminate' not in result.out, (more, result)
    result = run('delaunay', '-', '--discs', '--radius', '0.025', '--max-bits', '9', stdin=points)
    assert result.code == 4 and '0,1,indeterminate' in result.out.split(), result


def test_discs_beside_exact_points_settle():
    """Exact points next to discs of computed centres, on the circles too: more bits decide no pair."""
    for points in ('3/2+-1 sqrt(3)+-1\n2 -1\n5/2 sqrt(3)+1\nsqrt(2)+1 1/3\n',
                   'sqrt(2)+1+-1 -pi+-1\n1/sqrt(7) sqrt(5)\ne/3+-1 -pi+-1\nsqrt(2) -pi-1\n',
                   '-1/4 -1/2\npi/7 -2\n1/3 2\n0 sqrt(2)+1\n0+-1/2 0+-1/2\n-1/2 -1/2\n',
                   'sqrt(2)+-1/4 0+-1/4\n-sqrt(2)-1/4 -7/4\n-sqrt(2)-1/4 -2\n-sqrt(2)+-1/4 -2+-1/4\n',
                   'e+-1.5 1+-1.5\ne-1.5 -1/2\ne 2.5\n1/3 pi/7\n'):
        result = run('delaunay', '-', '--discs', '--stats', stdin=points)
        most = int(re.search(r'bits asked, most +(\d+)', result.err).group(1))
        assert result.code == 3 and most <= 512 and 'indeterminate' in result.out, (points, most, result)


def test_regions_beside_nearly_collinear_points_settle():
    """Four places within 2^-27 of a parallel that a region crosses: no refinement decides its pairs, and it is known."""
    result = run('delaunay', '-', '--sphere', '--stats',
                 stdin='-92 -39.99999996\n-18 -40\n175 -39.99999995\n75 [-40.49999999,-36.87499999]\n11 -40.00000003\n')
    assert result.code == 3 and int(re.search(r'bits asked, most +(\d+)', result.err).group(1)) < 300, result


def test_regions_that_touch_lines_and_circles_settle():
    """A choice of the regions puts them on the line or circle of exact places, or on one of these."""
    planes = ['sqrt(2) 0\nsqrt(3) 0\n[5,6] 0\n0 0\n', 'sqrt(2) 0\n[2,3] 0\nsqrt(20) 0\n',
              'sqrt(2) 0\n[2,3] [0,1]\nsqrt(20) 0\n0 sqrt(7)\n', '0 sqrt(2)\n0 sqrt(2)*2\n0 -sqrt(3)\n0 [1,4]\n',
              'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n[-1,1] [-3,-1]\n', 'sqrt(2) 0\nsqrt(20) 1\n3 -4\n[3,4] [-4,-2]\n0 9\n']
    globes = ['-29 0\n-76 0\n[160,170] 0\n-145 0\n', '-118 0\n[1.25,3.075] 0\n[-125.875,-122.125] 0\n8 0\n',
              '296 [-70.25,-68.5]\n296 40\n116 1\n296 -78\n', '-27 0\n-76 0\n27 0\n[-78.125,-65] 0\n',
              '0 30\n90 30\n180 30\n[-95,-80] 30\n', '0 30\n90 30\n180 30\n[-95,-80] [30,34]\n']
    for options, sets in (((), planes), (('--sphere',), globes)):
        for points in sets:
            result = run('delaunay', '-', '--stats', *options, stdin=points)
            most = re.search(r'bits asked, most +(\d+)', result.err)
            assert result.code == 3 and int(most.group(1)) < 1000, (points, result)


def exact(text):
    """An exact end: a rational, or m*2^e."""
    number, _, power = text.partition('*2^')
    return Fraction(number) * Fraction(2) ** int(power or 0)


def weights(r, n):
    return [(r.randint(1, 99), r.randint(1, 99)) for _ in range(n)]


def near_circle(r, bits):
    n = r.randint(5, 9)
    return arc(weights(r, n), r.choice([1, 7, 100, 1000]), bits)


def near_line(r, bits):
    n = r.randint(4, 8)
    slope = r.choice(['sqrt(2)', 'exp(1)', '1'])
    return [(f'{k}*sqrt(3)+{a}*2^-{bits}', f'{k}*sqrt(3)*{slope}+{b}*2^-{bits}') for k, (a, b) in enumerate(weights(r, n))]


def near_lattice(r, bits):
    places = r.sample([(x, y) for x in range(3) for y in range(3)], r.randint(5, 9))
    return [(f'{x}*sqrt(2)+{a}*2^-{bits}', f'{y}*sqrt(2)+{b}*2^-{bits}') for (x, y), (a, b) in zip(places, weights(r, 9))]


def test_near_circles_lines_and_lattices():
    """Bits asked: what doubling from 64 may take beyond twice the bits by which the points differ."""
    print(f'# near degenerate sets: DYADEL_TEST_SEED={SEED}')
    r = random.Random(SEED)
    for k in range(90 * SCALE):
        bits = r.choice([30, 55, 70, 90, 130])
        decided((near_circle, near_line, near_lattice)[k % 3](r, bits), 4 * bits + 192)


def test_many_points_near_a_circle():
    """A face of hundreds of points is refined before its pairs are closed: it has a quarter of a million of them."""
    r = random.Random(SEED)
    n = 500
    points = arc(weights(r, n), 20 * n, 100)
    result = run('delaunay', '-', '--stats', '-o', os.devnull, stdin=''.join(f'{x} {y}\n' for x, y in points))
    assert result.code == 0, result.err
    walks = int(re.search(r'cover walks +(\d+)', result.err).group(1))
    assert walks < 20 * n, walks


if __name__ == '__main__':
    main(globals())
