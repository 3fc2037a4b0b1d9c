#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel voronoi against brute force in rationals: cells of exact points are exact and tile the window [GRP-1], inner
and outer polygons of rectangles hold and never leave the window [POLY-1] [POLY-2] [POLY-3]; proved ties bound nothing [GRP-2].

Usage: test_cells.py COMMAND DATA   (DYADEL_TEST_SCALE multiplies the number of sets)
"""
import json
import os
import random
from fractions import Fraction as F
from math import isqrt

from harness import cases, main, run

SEED = 43
SETS = cases(120 * int(os.environ.get('DYADEL_TEST_SCALE', '1')))


def number(text):
    if '*2^' in text:
        m, e = text.split('*2^')
        return int(m) * F(2) ** int(e)
    return F(text)


# ---- sets ----

def grid(r):
    n, m = r.randint(1, 5), r.randint(1, 5)
    return [(F(x), F(y)) for x in range(n) for y in range(m)]


def line(r):
    dx, dy = r.choice([(1, 0), (0, 1), (5, 3), (1, -2)])
    return [(F(k * dx, 2), F(k * dy, 2)) for k in r.sample(range(30), r.randint(1, 9))]


def circle(r):
    far = [(x, y) for x in range(-25, 26) for y in range(-25, 26) if x * x + y * y == 625]
    return [(F(x), F(y)) for x, y in r.sample(far, r.randint(3, 12))] + ([(F(0), F(0))] if r.random() < .5 else [])


def near_tie(r):
    return [(x + F(r.randint(-3, 3), 1 << 40), y + F(r.randint(-3, 3), 1 << 40)) for x, y in grid(r)]


def cluster(r):
    return [(F(r.randint(0, 8)) + F(r.randint(0, 255), 1 << 10), F(r.randint(0, 8)) + F(r.randint(0, 255), 1 << 10))
            for _ in range(r.randint(2, 14))]


def uniform(r):
    return [(F(r.random() * 10), F(r.random() * 10)) for _ in range(r.randint(1, 12))]


def decimals(r):
    return [(F(r.randint(0, 999), 100), F(r.randint(0, 999), 100)) for _ in range(r.randint(1, 12))]


KINDS = [grid, line, circle, near_tie, cluster, uniform, decimals]


def window(r, points):
    """Around the points, or cutting them; its sides often pass through vertices of the diagram."""
    x = [p[0] for p in points]
    y = [p[1] for p in points]
    ends = []
    for v in (x, y):
        lo, hi = min(v), max(v)
        a = F(r.randint(int(4 * lo) - 8, int(4 * hi) + 8), 4)
        ends += [a, a + F(r.randint(1, int(4 * (hi - lo)) + 12), 4)]
    return ends


def diagram(texts, ends):
    result = run('voronoi', '--quiet', '--format', 'json', '--window=' + ','.join(str(e) for e in ends), '-',
                 stdin='\n'.join(texts) + '\n')
    assert result.code in (0, 3), (result.code, result.err)
    return {c['i']: c for c in json.loads(result.out)['cells']}


def ring(vertices):
    return [(number(x), number(y)) for x, y in vertices]


def area2(p):
    return sum((a[0] * b[1] - a[1] * b[0] for a, b in zip(p, p[1:] + p[:1])), F(0))


def inside_window(p, w):
    return all(w[0] <= x <= w[1] and w[2] <= y <= w[3] for x, y in p)


# ---- exact points ----

def true_cell(points, i, w):
    """The window clipped by the half-plane of each other point."""
    p = [(w[0], w[2]), (w[1], w[2]), (w[1], w[3]), (w[0], w[3])]
    for q in points:
        a, b = 2 * (q[0] - points[i][0]), 2 * (q[1] - points[i][1])
        c = q[0] ** 2 + q[1] ** 2 - points[i][0] ** 2 - points[i][1] ** 2
        if (a, b) == (0, 0):
            continue
        new = []
        for u, v in zip(p, p[1:] + p[:1]):
            s, t = a * u[0] + b * u[1] - c, a * v[0] + b * v[1] - c
            if s <= 0:
                new.append(u)
            if s * t < 0:
                new.append((u[0] + (v[0] - u[0]) * s / (s - t), u[1] + (v[1] - u[1]) * s / (s - t)))
        p = new
    return p


def check_points(points, w):
    cells = diagram([f'{x} {y}' for x, y in points], w)
    first = [i for i, p in enumerate(points) if p not in points[:i]]
    assert sorted(cells) == first
    total = F(0)
    for i, c in cells.items():
        true = true_cell(points, i, w)
        error = F(c['vertex_error'])
        assert F(c['exact_area']) == area2(true) / 2, f'area of cell {i}'
        assert c['undetermined'] == 0 and F(c['area'][0]) <= area2(true) / 2 <= F(c['area'][1])
        drawn = ring(c['inner'])
        assert c['outer'] in ([c['inner']], []) and inside_window(drawn, w)
        for x, y in drawn:
            assert any(abs(x - u) <= error and abs(y - v) <= error for u, v in true), f'a vertex of cell {i}'
        total += area2(drawn) / 2
    assert total == (w[1] - w[0]) * (w[3] - w[2]), 'the cells do not tile the window'


def test_points():
    r = random.Random(SEED)
    print('seed', SEED)
    for k in range(SETS):
        points = KINDS[k % len(KINDS)](r)
        w = window(r, points)
        try:
            check_points(points, w)
        except AssertionError as problem:
            raise AssertionError(f'set {k}, {KINDS[k % len(KINDS)].__name__}: {problem}: {points} {w}') from problem


# ---- rectangles ----

def nearest2(z, b):
    return sum(max(b[2 * a] - z[a], 0, z[a] - b[2 * a + 1]) ** 2 for a in range(2))


def farthest2(z, b):
    return sum(max(z[a] - b[2 * a], b[2 * a + 1] - z[a]) ** 2 for a in range(2))


def holds(p, z):
    """Returns whether z is in the closed polygon p."""
    odd = False
    for a, b in zip(p, p[1:] + p[:1]):
        turn = (b[0] - a[0]) * (z[1] - a[1]) - (b[1] - a[1]) * (z[0] - a[0])
        if turn == 0 and min(a[0], b[0]) <= z[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= z[1] <= max(a[1], b[1]):
            return True
        if (a[1] > z[1]) != (b[1] > z[1]):
            odd ^= (turn > 0) == (b[1] > a[1])
    return odd


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def is_simple(p):
    n = len(p)
    for i in range(n):
        a, b = p[i], p[(i + 1) % n]
        for j in range(i + 2, n):
            if i == 0 and j == n - 1:
                continue
            c, d = p[j], p[(j + 1) % n]
            if cross(a, b, c) * cross(a, b, d) < 0 and cross(c, d, a) * cross(c, d, b) < 0:
                return False
            if any(holds([s, t], z) for s, t, z in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))):
                return False
    return True


def check_boxes(r, boxes, w):
    cells = diagram([f'[{a},{b}] [{c},{d}]' for a, b, c, d in boxes], w)
    inner = {i: ring(c['inner']) for i, c in cells.items()}
    outer = {i: [ring(p) for p in c['outer']] for i, c in cells.items()}
    places = [(w[0] + (w[1] - w[0]) * F(r.randint(0, 64), 64), w[2] + (w[3] - w[2]) * F(r.randint(0, 64), 64))
              for _ in range(40)]
    places += [z for p in inner.values() for z in p][:40]
    for i, b in enumerate(boxes):
        if i not in cells:
            assert boxes.index(b) < i
            continue
        for z in inner[i]:
            assert all(farthest2(z, b) < nearest2(z, c) for j, c in enumerate(boxes) if j != i), f'inner of {i}'
        assert all(cross(*(inner[i][(k + m) % len(inner[i])] for m in range(3))) > 0 for k in range(len(inner[i])))
        assert all(inside_window(p, w) for p in [inner[i]] + outer[i]), f'cell {i} leaves the window'
        assert all(is_simple(p) and area2(p) > 0 for p in outer[i]), f'outer of {i} is not simple'
        for z in places:
            if all(nearest2(z, b) <= farthest2(z, c) for c in boxes):
                assert any(holds(p, z) for p in outer[i]), f'outer of {i} lacks {z}'


def test_boxes():
    r = random.Random(SEED + 1)
    print('seed', SEED + 1)
    for k in range(SETS):
        points = KINDS[k % len(KINDS)](r)[:8]
        size = r.choice([F(1, 1024), F(1, 8), F(1, 2), F(2)])
        boxes = [(x, x + r.choice([0, size]), y, y + r.choice([0, size, 2 * size])) for x, y in points]
        w = window(r, points)
        try:
            check_boxes(r, boxes, w)
        except AssertionError as problem:
            raise AssertionError(f'set {k}, {KINDS[k % len(KINDS)].__name__}: {problem}: {boxes} {w}') from problem


# ---- windows and coordinates of any size ----

def test_extents():
    """Five boxes of width 10 near 2^100, whose default window is 2^48 wide; and on a window 2^32 by 2^62: each is done in
    a second, where the work grew with the size of the window against that of the boxes."""
    r = random.Random(SEED + 2)
    print('seed', SEED + 2)
    for _ in range(cases(8)):
        corner = [(2**100 + r.randint(-30, 30), 2**100 + r.randint(-30, 30)) for _ in range(5)]
        text = ''.join(f'[{x},{x + 10}] [{y},{y + 10}]\n' for x, y in corner)
        result = run('voronoi', '--quiet', '-', stdin=text, timeout=20)
        assert result.code == 3 and result.out.count('\n') >= 6, (result.code, result.err, text)
        corner = [(r.randint(0, 2**31), r.randint(0, 2**31)) for _ in range(5)]
        w = [F(-2**31), F(2**31), F(-2**61), F(2**61)]
        check_boxes(r, [(F(x), F(x + 10), F(y), F(y + 10)) for x, y in corner], w)


def test_long_groups():
    """Ties are groups, not pairs in memory: points on one line and on one circle, with the least cap on pairs."""
    line = ''.join(f'{5 * k} {3 * k}\n' for k in range(4000))
    for command in (['voronoi'], ['delaunay', '--layer', 'graph:mst'], ['delaunay', '--list-ties', 'groups'], ['plan']):
        result = run(*command, '--quiet', '--max-pairs', '1', '-', stdin=line, timeout=30)
        assert result.code in (0, 3), (command, result.code, result.err)
    assert len(run('delaunay', '--quiet', '--list-ties', 'groups', '-', stdin=line).out.splitlines()) == 2
    round_ = sorted({(s * x, t * y) for a in range(1, 40) for b in range(1, 40) for x, y in [(a, b)]
                     if a * a + b * b == 1105 for s in (1, -1) for t in (1, -1)})
    text = ''.join(f'{x} {y}\n' for x, y in round_)
    rows = run('delaunay', '--quiet', '--list-ties', 'groups', '--max-pairs', '1', '-', stdin=text).out.splitlines()
    assert len(rows) == 2 and rows[1].startswith('circle,') and len(rows[1].split()) == len(round_), rows
    sites = [round_[int(i)] for i in rows[1].split(',')[1].split()]
    assert all(cross(sites[k - 2], sites[k - 1], sites[k]) > 0 for k in range(len(sites))), 'not in the order of the circle'
    pairs = run('delaunay', '--quiet', '-', stdin=text).out
    assert pairs.count(',tie') == len(round_) * (len(round_) - 3) // 2
    none = run('delaunay', '--quiet', '--list-ties', 'none', '-', stdin=text).out
    assert none == ''.join(x for x in pairs.splitlines(True) if not x.endswith(',tie\n'))


# ---- proved ties ----

ROOT2 = F(isqrt(2 << 4000), 1 << 2000)  # off by less than 2^-1999


def proved_sets(r):
    """Points times sqrt(2) on one circle (also with its centre, and others), on one line, on a grid."""
    d = r.choice([4, 5, 7])
    on = [(F(d * d - m * m, d * d + m * m), F(2 * m * d, d * d + m * m)) for m in r.sample(range(-40, 41), r.randint(5, 24))]
    extra = r.choice([[], [(F(0), F(0))], [(F(3), F(1, 3)), (F(-2), F(5))]])
    yield on + extra
    yield [(F(3 * k), F(k)) for k in r.sample(range(30), r.randint(3, 12))] + r.choice([[], [(F(4), F(9))]])
    yield [(F(x), F(y)) for x in range(r.randint(2, 4)) for y in range(r.randint(2, 4))]


def check_proved(r, points):
    true = [(x * ROOT2, y * ROOT2) for x, y in points]
    w = window(r, [(F(int(x)), F(int(y))) for x, y in true])
    extra = r.choice([[], ['--until', 'area:20'], ['--until', 'hausdorff:20']])
    text = ''.join(f'({x})*sqrt(2) ({y})*sqrt(2)\n' for x, y in points)
    result = run('voronoi', '--quiet', '--format', 'json', '--window=' + ','.join(map(str, w)), *extra, '-', stdin=text)
    assert result.code in (0, 3), (result.code, result.err)
    answer = json.loads(result.out)
    tiny = F(1, 1 << 900)
    left = (w[1] - w[0]) * (w[3] - w[2])
    for c in answer['cells']:
        cell = true_cell(true, c['i'], w)
        inner, area = ring(c['inner']), area2(cell) / 2
        left -= area2(inner) / 2
        assert F(c['area'][0]) - tiny <= area <= F(c['area'][1]) + tiny, f'area of cell {c["i"]}'
        for z in inner:
            own = nearest2(z, (true[c['i']][0], true[c['i']][0], true[c['i']][1], true[c['i']][1]))
            assert all(own <= (z[0] - x) ** 2 + (z[1] - y) ** 2 + tiny for x, y in true), f'inner of {c["i"]}: {z}'
        for z in cell:
            near = [(z[0] + (true[c['i']][0] - z[0]) * tiny, z[1] + (true[c['i']][1] - z[1]) * tiny)]
            assert any(holds(ring(p), z) or holds(ring(p), near[0]) for p in c['outer']), f'outer of {c["i"]} lacks {z}'
    assert left <= number(answer['bounds']['undetermined_area']['exact']), 'the undetermined area'


def test_proved():
    r = random.Random(SEED + 3)
    print('seed', SEED + 3)
    for k in range(SETS // 12):
        for points in proved_sets(r):
            try:
                check_proved(r, points)
            except AssertionError as problem:
                raise AssertionError(f'set {k}: {problem}: {points}') from problem


def test_proved_cost():
    """A circle of 1,000 points sqrt(2) away: neither cells nor graphs look at its 500,000 pairs."""
    text = ''.join(f'sqrt(2)*{10000 - m * m}/{10000 + m * m} sqrt(2)*{200 * m}/{10000 + m * m}\n' for m in range(-500, 500))
    for command in (['voronoi'], ['delaunay', '--layer', 'graph:mst'], ['delaunay', '--list-ties', 'groups']):
        result = run(*command, '--quiet', '-', stdin=text, timeout=30)
        assert result.code == 3 and result.out, (command, result.code, result.err)


def test_aliases():
    """Coincident points are rows of a layer of their own, and a note says when they have none."""
    points = '0 0\n3 0\n0 3\n3 0\n0 0\n'
    for command in ('delaunay', 'voronoi'):
        result = run(command, '--layer', 'aliases', '-', stdin=points)
        assert result.out == 'i,of\n3,1\n4,0\n', result.out
        result = run(command, '--layer', 'aliases', '--format', 'wkt', '-', stdin=points)
        assert [x.split(',')[:3] for x in result.out.splitlines()[1:]] == [['"POINT (3 0)"', '3', '1'],
                                                                         ['"POINT (0 0)"', '4', '0']], result.out
        for form in ('wkt', 'geojson'):
            assert '2 points coincide' in run(command, '--format', form, '-', stdin=points).err
        assert 'coincide' not in run(command, '-', stdin=points).err


if __name__ == '__main__':
    main(globals())
