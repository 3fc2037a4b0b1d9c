#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel converge --modulus: for each m the first stage, and the bits known a priori, are never below what the error
needs, for the maps of the paper on 50 sets of points, in 60 digits [RATE-1].

Usage: test_modulus.py COMMAND DATA
"""
import csv
import itertools
import json
import os
import random
import re
import tempfile
from fractions import Fraction

import mpmath
from harness import expect, main, run

mpmath.mp.dps = 60
FORMS = ('sqrt({a})/{b}', 'exp({b}/(9+{a}))', 'cos({a})+{b}/7', '{a}/{b}+pi')


def coordinate(rand):
    return rand.choice(FORMS).format(a=rand.randint(2, 99), b=rand.randint(3, 29))


def value(text):
    """In 60 digits: numbers become mpf before they are divided."""
    return eval(re.sub(r'(\d+)', r'mpmath.mpf(\1)', text), {'mpmath': mpmath, **{name: getattr(mpmath, name) for name in ('sqrt', 'exp', 'cos', 'pi')}})


def exact(text):
    base, _, power = text.partition('*2^')
    return mpmath.mpf(Fraction(base).numerator) / Fraction(base).denominator * mpmath.mpf(2) ** int(power or 0)


def distance(p, q):
    return mpmath.hypot(p[0] - q[0], p[1] - q[1])


def corners(rect):
    return list(itertools.product(rect[:2], rect[2:]))


def error_of_edges(true, rects, rand):
    return max(distance(p, c) for p, r in zip(true, rects) for c in corners(r))


def circle(p, q, r):
    a, b, c, d = q[0] - p[0], q[1] - p[1], r[0] - p[0], r[1] - p[1]
    double = 2 * (a * d - b * c)
    x = (d * (a * a + b * b) - b * (c * c + d * d)) / double
    y = (a * (c * c + d * d) - c * (a * a + b * b)) / double
    return (p[0] + x, p[1] + y), mpmath.hypot(x, y)


def error_of_disc(true, rects, rand):
    centre, radius = circle(*true[:3])
    error = 0
    for choice in itertools.product(*(corners(r) for r in rects[:3])):
        c, r = circle(*choice)
        error = max(error, distance(c, centre) + abs(r - radius))
    return error


def off_diagram(x, sites):
    """The distance of x from the boundaries of the cells: the nearest site's cell is an intersection of half-planes."""
    near = min(sites, key=lambda p: distance(x, p))
    return min((distance(x, q) ** 2 - distance(x, near) ** 2) / (2 * distance(near, q)) for q in sites if q is not near)


def error_of_diagram(true, rects, rand, window):
    """The largest distance found of points of a diagram on the window from another one, one of them the true one."""
    error = 0
    for _ in range(6):
        choice = [rand.choice(corners(r)) for r in rects]
        for here, there in ((true, choice), (choice, true)):
            a, b = ([mpmath.mpf(rand.uniform(*window[2 * k:2 * k + 2])) for k in range(2)] for _ in range(2))
            nearest = [min(range(len(here)), key=lambda i: distance(x, here[i])) for x in (a, b)]
            if nearest[0] == nearest[1]:
                continue
            for _ in range(190):
                mid = [(u + v) / 2 for u, v in zip(a, b)]
                if min(range(len(here)), key=lambda i: distance(mid, here[i])) == nearest[0]:
                    a = mid
                else:
                    b = mid
            error = max(error, off_diagram(a, there))
    return error


def rects_by_stage(trace, n):
    """For each stage the rectangles, and the least bits asked, at its end."""
    rects, bits, out = [None] * n, [0] * n, {}
    for line in open(trace, encoding='utf-8'):
        row = json.loads(line)
        if 'point' in row:
            rects[row['point']] = [exact(end) for side in 'xy' for end in row[side]]
            bits[row['point']] = row['bits']
        if 'stage' in row and None not in rects:
            out[row['stage']] = list(rects), min(bits)
    return out


def test_needs_of_the_error():
    rand, checked = random.Random(7), 0
    window = (-3, 9, -3, 9)
    with tempfile.TemporaryDirectory() as folder:
        trace = os.path.join(folder, 'trace')
        for k in range(50):
            of = ('delaunay', 'disc', 'bisector', 'voronoi')[k % 4]
            n = 2 if of == 'bisector' else 3 if of == 'disc' else rand.randint(3, 6)
            texts = [(coordinate(rand), coordinate(rand)) for _ in range(n)]
            true = [tuple(value(t) for t in point) for point in texts]
            points = ''.join(' '.join(t) + '\n' for t in texts)
            schedule = rand.choice(('uniform', 'adaptive'))
            result = run('converge', '-', '--of', of, '--modulus', '0:22', '--schedule', schedule, '--trace', trace,
                         '--window=' + ','.join(map(str, window)), stdin=points)
            expect(result, 0, r'^m,stage,bits_total,bits_most,bound,apriori_bits,apriori_stage\n0,')
            rows = list(csv.DictReader(line for line in result.out.splitlines() if not line.startswith('#')))
            assert [int(r['m']) for r in rows] == list(range(23))
            stages = rects_by_stage(trace, n)

            def error(rects):
                if of in ('delaunay', 'disc'):
                    return (error_of_edges if of == 'delaunay' else error_of_disc)(true, rects, rand)
                return error_of_diagram(true, rects, rand, window)
            for r in rows:
                goal = mpmath.mpf(2) ** -int(r['m'])
                assert float(r['bound']) <= goal * (1 + mpmath.mpf(10) ** -5), r
                stage = max(s for s in stages if s <= int(r['stage']))
                assert error(stages[stage][0]) <= goal, (k, of, points, r)
                assert r['apriori_bits'], 'points in general position have a modulus'
                for s, (rects, bits) in stages.items():
                    if s >= int(r['apriori_stage']) and bits >= int(r['apriori_bits']):
                        assert error(rects) <= goal, ('a priori', k, of, points, r)
                        checked += 1
                        break
    assert checked > 300, checked


def test_forms():
    """json has the same rows beside the stages; nothing is known a priori of ties, areas and a line."""
    points = 'sqrt(2) 0\n4 sqrt(3)\n0 pi\n'
    rows = list(csv.DictReader(run('converge', '-', '--modulus', '3:9', comments=False, stdin=points).out.splitlines()))
    found = json.loads(run('converge', '-', '--modulus', '3:9', '--format', 'json', stdin=points).out)
    assert len(found['stages']) > 1 and [r['bits_total'] for r in found['modulus']] == [int(r['bits_total']) for r in rows]
    assert [r['apriori_bits'] for r in found['modulus']] == [int(r['apriori_bits']) for r in rows]
    area = run('converge', '-', '--modulus', '3:9', '--until', 'area:2', comments=False, stdin=points)
    expect(area, 0, r'^3,\d+,\d+,\d+,\d[^,]*,,$')
    for tied, of in (('0 0\n1 0\n0 1\n1 1\nsqrt(2) 9\n', 'delaunay'), ('0 0\nsqrt(2) sqrt(2)\n2 2\n', 'disc')):
        found = run('converge', '-', '--modulus', '3:3', '--of', of, '--max-bits', '20', comments=False, stdin=tied)
        assert found.code in (3, 4) and found.out.endswith('\n3,,,,,,\n'), found
    for wrong in ('3', '9:3', ':', 'a:b', '1:2:3', '', '1:99999999'):
        expect(run('converge', '-', '--modulus=' + wrong, stdin=points), 2, r'\A\Z', 'modulus')
    expect(run('converge', '-', '--modulus', '3:9', '--discs', stdin=points), 2, r'\A\Z', 'remove --discs')
    expect(run('converge', '-', '--hindsight', '9', '--of', 'disc', stdin=points), 2, r'\A\Z', 'remove --of')


def test_hindsight():
    """The share of each stage in the best plan; none where the search is cut."""
    points = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)+2^-30\npi e\n'
    how = 'converge', '-', '--no-times', '--start-bits', '4', '--step-bits', '1', '--hindsight'
    rows = list(csv.DictReader(run(*how, '100000', comments=False, stdin=points).out.splitlines()))
    best = json.loads(run(*how, '100000', '--format', 'json', stdin=points).out)['best_bits']
    for r in rows:
        assert 0 <= Fraction(r['ratio']) - Fraction(int(r['bits_total']), best) < Fraction(1, 10 ** 6), r
    assert 1 <= float(rows[-1]['ratio']) < 2
    cut = run(*how, '5', comments=False, stdin=points)
    expect(cut, 0, r'(?m)^1,.*,\Z|^1,.*,$', 'no best plan was found')


main(globals())
