# SPDX-License-Identifier: LGPL-3.0-or-later
"""The oracle against other ways to the same answers: centres tried one by one, the plane under a stereographic projection,
and annuli at many centres."""
import fractions
import itertools
import math
import os
import random
import sys

import mpmath

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import draws
import oracle

Q = fractions.Fraction
SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))


def edge_by_centres(p, i, j, sites):
    """Tries a centre in each part of the bisector, and the half-planes on both sides of the line."""
    (xi, yi), (xj, yj) = p[i], p[j]
    if p[i] == p[j]:
        return 1
    m, n = (Q(xi + xj) / 2, Q(yi + yj) / 2), (Q(yi - yj), Q(xj - xi))
    cuts = set()
    for k in sites:
        c = oracle.centre(*[tuple(map(Q, p[q])) for q in (i, j, k)]) if k not in (i, j) else None
        if c:
            cuts.add((c[0] - m[0]) / n[0] if n[0] else (c[1] - m[1]) / n[1])
    cuts = sorted(cuts)
    at = [*cuts, *((a + b) / 2 for a, b in zip(cuts, cuts[1:])), *([cuts[0] - 1, cuts[-1] + 1] if cuts else [Q(0)])]
    best = -1
    for t in at:
        c = m[0] + t * n[0], m[1] + t * n[1]
        r, others = oracle.far2(c, p[i]), [oracle.far2(c, p[k]) for k in sites if k not in (i, j)]
        best = max(best, 1 if all(d > r for d in others) else 0 if all(d >= r for d in others) else -1)
    turns = [oracle.turn(p[i], p[j], p[k]) for k in sites]
    return max(best, 0) if min(turns) >= 0 or max(turns) <= 0 else best


def test_edges(rand):
    for _ in range(400):
        n, side = rand.randint(2, 7), rand.choice((2, 3, 9, 100))
        p = [(rand.randint(0, side), rand.randint(0, side)) for _ in range(n)]
        for (i, j), e in oracle.edges(p, range(n)).items():
            assert e == edge_by_centres(p, i, j, range(n)), (p, i, j, e)


def test_corners(rand):
    """A corner is in no triangle, on no segment and at no place of the others."""
    for _ in range(300):
        n, side = rand.randint(2, 7), rand.choice((2, 3, 9))
        p = [(rand.randint(0, side), rand.randint(0, side)) for _ in range(n)]
        for i in range(n):
            rest = [p[k] for k in range(n) if k != i]
            held = any(min(t := [oracle.turn(a, b, p[i]), oracle.turn(b, c, p[i]), oracle.turn(c, a, p[i])]) >= 0 and
                       (max(t) > 0 or p[i] in (a, b, c) or any(oracle.dot(p[i], u, v) < 0 for u, v in ((a, b), (b, c), (c, a))))
                       for a, b, c in itertools.product(rest, repeat=3))
            assert (oracle.corner(p, i, range(n)) == 1) == (not held), (p, i)


def test_sphere(rand):
    """Projected from the north pole, the plane tells the same of all other pairs, and hull corners are the pole's neighbours."""
    for _ in range(80):
        n = rand.randint(4, 7)
        span = rand.choice((99, 3))  # many points on one circle or line, too
        p = sorted({(Q(rand.randint(-span, span), 40), Q(rand.randint(-span, span), 40)) for _ in range(n)})
        n = len(p)
        with mpmath.workprec(1300):
            places = []
            for x, y in p:  # to longitude and latitude: the distance from the pole is 2 atan(1 / r)
                lon = mpmath.atan2(mpmath.mpf(y.numerator) / y.denominator, mpmath.mpf(x.numerator) / x.denominator)
                r = mpmath.sqrt(mpmath.mpf((x * x + y * y).numerator) / (x * x + y * y).denominator)
                lat = 2 * mpmath.atan(r) - mpmath.pi / 2
                places.append(tuple(Q(int(mpmath.nint(c * 180 / mpmath.pi * 2 ** 1250)), 2 ** 1250) for c in (lon, lat)))
        globe, flat = oracle.Sphere([*places, (Q(0), Q(90))], range(n + 1)), oracle.whole(p)[0]
        for i, j in itertools.combinations(range(n), 2):
            e, g = oracle.edge(flat, i, j, range(n)), globe.edge(i, j)
            assert g in (0, e) and (g == e or 0 in globe.known.values()), (p, i, j, e, g)
        for i in range(n):
            e, g = oracle.corner(flat, i, range(n)), globe.edge(i, n)
            assert g in (0, e) and (g == e or 0 in globe.known.values()), (p, i, e, g)


def test_annuli(rand):
    """No centre on the bisector has a larger annulus than the one that is found, and some come near it."""
    for _ in range(60):
        n = rand.randint(3, 6)
        p = [(Q(rand.randint(0, 50)), Q(rand.randint(0, 50))) for _ in range(n)]
        if len(set(p)) < n:
            continue
        w = float(oracle.annulus(p, 0, 1, range(n)))
        f = [tuple(map(float, q)) for q in p]
        best = -math.inf
        for k in range(-4000, 4001):
            t = math.tan(k / 4001 * math.pi / 2)
            c = (f[0][0] + f[1][0]) / 2 - t * (f[1][1] - f[0][1]), (f[0][1] + f[1][1]) / 2 + t * (f[1][0] - f[0][0])
            best = max(best, min(math.dist(c, q) for q in f[2:]) - math.dist(c, f[0]))
        assert best <= w + 1e-6 and best >= w - 0.2 - 0.01 * abs(w), (p, w, best)


def test_witnesses(rand):
    """Each witness is one: no choice has another answer."""
    found = 0
    for _ in range(150):
        n = rand.randint(3, 6)
        regions = {}
        for k in range(n):
            x, y, r = (Q(rand.randint(0, 40)) for _ in range(3))
            r = r / 20
            regions[k] = ('box', x - r, x + r, y - r, y + r / 2) if rand.random() < 0.5 else ('disc', x, y, r)
        for i, j in itertools.combinations(range(n), 2):
            if draws.witness(regions, i, j, range(n)) is None:
                continue
            found += 1
            for p in [*draws.choices([regions[k] for k in range(n)], rand, 6),
                      draws.climb([regions[k] for k in range(n)], range(n), i, j, False, rand, False)]:
                assert oracle.edge(oracle.whole(p)[0], i, j, range(n)) == 1, (regions, i, j, p)
        c = Q(rand.randint(-20, 60)), Q(rand.randint(-20, 60))
        if oracle.witness_holds(regions, 0, 1, c, range(n)):
            for p in draws.choices([regions[k] for k in range(n)], rand, 12):
                d = [oracle.far2(q, c) for q in p]
                assert max(d[:2]) < min(d[2:]), (regions, c, p)
    assert found > 200


for name, test in list(globals().items()):
    if name.startswith('test_'):
        test(random.Random(f'{name} {SEED}'))
print('seed', SEED)
