#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel delaunay --sphere: against exact convex hulls, forms of degrees and radii, formats, refusals [SPH-1] [SPH-2] [SPH-3] [SPH-4] [SPH-5].

Usage: test_sphere.py COMMAND DATA
"""
import csv
import json
import math
import os
import random
import re
import tempfile
import time
import xml.etree.ElementTree

import globe
from globe import Q
from harness import DATA, cases, count, expect, main, run

SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
AIRPORTS = ['--columns', 'longitude,latitude', os.path.join(DATA, 'airports.csv')]
WHOLE, HALVES, APART = globe.Globe(300, 230), globe.Globe(520, 450), globe.Globe(80, 40)
OCTAHEDRON = '0 0\n90 0\n180 0\n270 0\n0 90\n0 -90\n'


def sphere(places, *options):
    """Statuses, and the whole answer."""
    result = run('delaunay', '--sphere', '--quiet', *options, '-', stdin=''.join(f'{x} {y}\n' for x, y in places))
    rows = [line.split(',') for line in result.out.splitlines() if not line.startswith('#')]
    return {(int(i), int(j)): s for i, j, s in rows[1:]}, result


def some_places(r, kind):
    """Degrees with ties: anywhere, on few circles, about a pole, across 180 degrees, in half of the globe, prisms."""
    n = r.randrange(0, 12)
    if kind == 0:
        return WHOLE, [(r.randrange(-180, 361), r.randrange(-90, 91)) for _ in range(n)]
    if kind == 1:
        return WHOLE, [(r.randrange(-12, 24) * 30, r.choice([-90, -60, -45, -30, 0, 30, 45, 60, 90])) for _ in range(n)]
    if kind == 2:
        return WHOLE, [(r.randrange(0, 6) * 60, r.randrange(87, 91) * r.choice([1, 1, 1, -1])) for _ in range(n)]
    if kind == 3:
        return HALVES, [(Q(r.randrange(356, 365), 2) - 360 * r.randrange(2), Q(r.randrange(-4, 5), 2)) for _ in range(n)]
    if kind == 4:
        sides, lat = r.choice([2, 3, 4, 5, 6, 8]), r.choice([10, 30, 45])
        twist = r.choice([0, 180 // sides])
        rings = [(k * 360 // sides + twist * (s > 0), s * lat) for k in range(sides) for s in (-1, 1)]
        return WHOLE, rings + [(r.randrange(360), 90)] * r.randrange(2) + [(0, -90)] * r.randrange(2)
    if kind == 5:
        return APART, [(round(r.uniform(-60, 60), 6), round(r.uniform(-40, 60), 6)) for _ in range(n)]
    return APART, [(round(r.uniform(-180, 180), 7), round(math.degrees(math.asin(r.uniform(-1, 1))), 7)) for _ in range(n)]


def test_random_sets():
    """1,000 sets: statuses, outcome, aliases; sure triangles of every fourth."""
    r = random.Random(SEED)
    for k in range(cases(1000)):
        exact, places = some_places(r, k % 7)
        want = globe.statuses(exact, places)
        got, result = sphere(places)
        assert got == want, (SEED, k, places, got, want)
        assert result.code == (3 if 'tie' in want.values() else 0), (SEED, k, result)
        same, _ = globe.first_of_each(places)
        aliases = [f'# alias {i} {same.index(p)}' for i, p in enumerate(same) if same.index(p) != i]
        assert [line for line in result.out.splitlines() if line.startswith('#')] == aliases, (SEED, k, places)
        if k % 4 == 0:
            text = ''.join(f'{x} {y}\n' for x, y in places)
            rows = run('delaunay', '--sphere', '-q', '--layer', 'triangles', '-', stdin=text).out.splitlines()
            got = {tuple(map(int, row.split(','))) for row in rows if row[0] not in '#i'}
            assert got == globe.triangles(exact, places), (SEED, k, places)


def turned(places, r):
    """Moved by what maps degrees to degrees: along the parallels, to the other half, from east to west."""
    move, mirror, flip = r.randrange(-360, 361), r.choice([1, -1]), r.choice([1, -1])
    return [(mirror * x + move, flip * y) for x, y in places]


def test_turned():
    """Rotations and other orders, and so other points to project from, change nothing."""
    r = random.Random(SEED)
    for k in range(cases(60)):
        _, places = some_places(r, k % 3)
        want, _ = sphere(places)
        got, _ = sphere(turned(places, r))
        assert got == want, (SEED, k, places)
        same, _ = globe.first_of_each(places)
        order = sorted(range(len(places)), key=lambda i: r.random())
        shuffled, _ = sphere([places[i] for i in order])
        named = {frozenset((same[i], same[j])): s for (i, j), s in want.items()}
        assert {frozenset((same[order[i]], same[order[j]])): s for (i, j), s in shuffled.items()} == named, (SEED, k)


def rotated(places, r):
    """Turned about an axis anywhere, in doubles."""
    axis, angle = APART.vector(canonical_somewhere(r)), r.uniform(0, 2 * math.pi)
    u, out = [c / 1e80 for c in axis], []
    for place in places:
        v = [c / 1e80 for c in APART.vector(globe.canonical(place))]
        cross = [u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3] for k in range(3)]
        dot = globe.dot(u, v)
        w = [v[k] * math.cos(angle) + cross[k] * math.sin(angle) + u[k] * dot * (1 - math.cos(angle)) for k in range(3)]
        out.append((round(math.degrees(math.atan2(w[1], w[0])), 12), round(math.degrees(math.atan2(w[2], math.hypot(w[0], w[1]))), 12)))
    return out


def canonical_somewhere(r):
    return globe.canonical((round(r.uniform(-180, 180), 7), round(math.degrees(math.asin(r.uniform(-1, 1))), 7)))


def test_rotated():
    """Points in no special relation have the same neighbours seen from every eye."""
    r = random.Random(SEED)
    for k in range(cases(60)):
        places = [canonical_somewhere(r) for _ in range(r.randrange(4, 12))]
        want, result = sphere([(float(x), float(y)) for x, y in places])
        got, _ = sphere(rotated(places, r))
        assert got == want and result.code == 0, (SEED, k, places)


def solids():
    """The corners of the five regular solids, as expressions; how many faces each corner has, sides of a face."""
    def ring(sides, first, lat):
        return [(Q(360 * k, sides) + first, lat) for k in range(sides)]
    third, half, root = 'asin(1/3)*180/pi', 'atan(1/2)*180/pi', 'atan(sqrt(1/2))*180/pi'
    high, low = ('asin(sqrt((5' + s + '2*sqrt(5))/15))*180/pi' for s in '+-')
    yield [(0, 90)] + ring(3, 0, '-' + third), 6, 0
    yield [(0, 90), (0, -90)] + ring(4, 0, 0), 12, 0
    yield ring(4, 45, root) + ring(4, 45, '-' + root), 12, 12
    yield [(0, 90), (0, -90)] + ring(5, 0, half) + ring(5, 36, '-' + half), 30, 0
    yield ring(5, 36, high) + ring(5, 36, low) + ring(5, 0, '-' + high) + ring(5, 0, '-' + low), 30, 60


def by_doubles(lat):
    return eval(str(lat), {'asin': lambda x: math.asin(x), 'atan': math.atan, 'sqrt': math.sqrt, 'pi': math.pi})


def test_regular_solids():
    """As they are: edges are legal, diagonals of faces stay open, others are none; turned and rounded: against the exact hull."""
    r = random.Random(SEED)
    for corners, edges, diagonals in solids():
        got, result = sphere(corners, '--max-bits', '256')
        about = [[c / 1e80 for c in APART.vector(globe.canonical((x, by_doubles(y))))] for x, y in corners]
        far = {(i, j): math.dist(about[i], about[j]) for j in range(len(about)) for i in range(j)}
        side = min(far.values())
        short = {p for p, d in far.items() if d < side * 1.0001}
        assert {p for p, s in got.items() if s == 'legal'} == short and len(short) == edges, (corners, got)
        beyond = sorted(d for p, d in far.items() if p not in short)[:diagonals]
        assert len(got) == edges + diagonals and all(far[p] <= beyond[-1] + 1e-9 for p in got if p not in short), (corners, got)
        assert result.code == (4 if diagonals else 0), result
        for _ in range(4):
            places = rotated([(x, by_doubles(y)) for x, y in corners], r)
            assert sphere(places)[0] == globe.statuses(APART, places), (SEED, places)


def test_few_points():
    expect(run('delaunay', '--sphere', '--quiet', '-'), 0, r'\Ai,j,status\n\Z', r'\A\Z')
    expect(run('delaunay', '--sphere', '-', stdin='7 8\n'), 0, r'\Ai,j,status\n\Z', r'\A\Z')
    expect(run('delaunay', '--sphere', '-', stdin='7 8\n187 -8\n'), 0, r'\Ai,j,status\n0,1,legal\n\Z', r'\A\Z')
    expect(run('delaunay', '--sphere', '-', stdin='7 8\n7 9\n7 10\n'), 0, r'\Ai,j,status\n0,1,legal\n0,2,legal\n1,2,legal\n\Z')
    expect(run('delaunay', '--sphere', '-', stdin='7 8\n7 9\n7 10\n187 10\n'), 3, '0,2,tie\n(.*\n)*1,3,tie', 'dyadel: 4 legal, 0 ind.* 2 tied')
    expect(run('delaunay', '--sphere', '-', stdin='5 90\n77 90\n-180 1\n180 1\n'), 0, r'\A# alias 1 0\n# alias 3 2\ni,j,status\n0,2,legal\n\Z')


def test_forms():
    """Fractions, expressions, roots: the same places; computable ones are refined."""
    want, _ = sphere([(0, 0), (Q(1, 3), 0), (0, Q(1, 3)), (-20, -30), (40, 80)])
    for third in ('1/3', '[1/3,1/3]', '(1/6)*2', 'root(3*x-1,0,1)'):
        got, result = sphere([(0, 0), (third, 0), (0, third), (-20, -30), (40, 80)])
        assert got == want and result.code == 0, (third, result)
    cube = [(x, s + 'atan(sqrt(2)/2)*180/pi') for s in ('', '-') for x in (45, 135, 225, 315)]
    got, result = sphere(cube + [(0, '89.99999999999999999999999')])
    assert result.code in (0, 3, 4) and 'illegal' not in got.values(), result
    near, result = sphere([(0, 0), (1, 0), (0, 1), ('1+sqrt(2)/10^30', 1), (50, 50)])
    assert result.code == 0 and ((0, 3) in near) != ((1, 2) in near), result


def test_grid():
    """64,800 points at every degree: all is tied, which takes no refinement."""
    text = ''.join(f'{x} {y + 0.5}\n' for y in range(-90, 90) for x in range(-180, 180))
    begin = time.monotonic()
    result = run('delaunay', '--sphere', '-', stdin=text)
    seconds = time.monotonic() - begin
    expect(result, 3, '', '129240 legal, 0 indeterminate, 257400 tied')
    assert count(result.out) == {'legal': 129240, 'tie': 257400}
    print('seconds for the grid', round(seconds, 1))


def test_airports():
    """10,122 edges; the triangles are a closed surface, and convex at each edge, in 80 digits."""
    result = run('delaunay', '--sphere', *AIRPORTS)
    expect(result, 0, r'\Ai,j,status\n', r'\A\Z')
    assert count(result.out) == {'legal': 10122}
    told = run('delaunay', '--sphere', '--stats', *AIRPORTS).err  # of the places, not of their images
    assert re.search(r'^points +3376$', told, re.M) and re.search(r'^pairs legal +10122$', told, re.M), told
    with open(os.path.join(DATA, 'airports.csv'), encoding='utf-8') as file:
        at = [APART.vector(globe.canonical((r['longitude'], r['latitude']))) for r in csv.DictReader(file)]
    rows = run('delaunay', '--sphere', '--layer', 'triangles', *AIRPORTS).out.splitlines()[1:]
    beyond = {}
    for row in rows:
        i, j, k = map(int, row.split(','))
        beyond.update({(i, j): k, (j, k): i, (k, i): j})
    assert len(rows) == 6748 and len(beyond) == 3 * 6748
    for (i, j), k in beyond.items():
        v = [globe.minus(at[l], at[i]) for l in (j, k, beyond[j, i])]
        assert APART.sign(*v) < 0, (i, j, k)
    edges = {tuple(line.split(',')[:2]) for line in result.out.splitlines()[1:]}
    assert edges == {(str(min(e)), str(max(e))) for e in beyond}


def test_airports_hull():
    """The same by another program, where it is there."""
    try:
        import numpy
        import scipy.spatial
    except ImportError:
        print('no scipy: left out')
        return
    with open(os.path.join(DATA, 'airports.csv'), encoding='utf-8') as file:
        lon, lat = numpy.radians([[float(r['longitude']), float(r['latitude'])] for r in csv.DictReader(file)]).T
    hull = scipy.spatial.ConvexHull(numpy.column_stack([numpy.cos(lat) * numpy.cos(lon), numpy.cos(lat) * numpy.sin(lon), numpy.sin(lat)]))
    edges = {tuple(sorted(map(int, e))) for t in hull.simplices for e in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))}
    rows = run('delaunay', '--sphere', *AIRPORTS).out.splitlines()[1:]
    assert edges == {tuple(map(int, row.split(',')[:2])) for row in rows}


# ---- places that are not exact ----

def moved(place, angle, r):
    """A place at most so far away (radians), in degrees; some are as far as possible."""
    lon, lat = math.radians(place[0]), math.radians(place[1])
    far, way = angle * r.choice([1, math.sqrt(r.random())]) * (1 - 1e-9), r.uniform(0, 2 * math.pi)
    z = math.sin(lat) * math.cos(far) + math.cos(lat) * math.sin(far) * math.cos(way)
    east = math.sin(way) * math.sin(far) * math.cos(lat)
    return math.degrees(lon + math.atan2(east, math.cos(far) - math.sin(lat) * z)), math.degrees(math.asin(z))


def refuted(got, places):
    """Returns whether the choice contradicts a pair."""
    want = globe.statuses(APART, [(repr(x), repr(y)) for x, y in places])
    return any(want.get(p) != 'legal' for p, s in got.items() if s == 'legal') or any(p not in got for p in want)


def scattered(r, n, wide):
    """Some anywhere, some about a pole, some across 180 degrees; apart."""
    places = []
    while len(places) < n:
        lat = r.choice([math.degrees(math.asin(r.uniform(-1, 1))), 90 - 20 * r.random(), r.uniform(-20, 20)])
        lon = r.choice([r.uniform(-180, 180), r.uniform(170, 190)])
        p = (round(lon, 3), round(lat, 3))
        at = APART.vector(globe.canonical(p))
        if all(math.dist([c / 1e80 for c in at], [c / 1e80 for c in APART.vector(globe.canonical(q))]) > 3 * wide for q in places):
            places.append(p)
    return places


def test_choices_within_radii():
    """Random choices never contradict a statement; choices in a smaller radius are decided no less."""
    r = random.Random(SEED)
    for k in range(cases(40)):
        metres = r.choice([1000, 50000, 400000])
        places = scattered(r, r.randrange(4, 9), 1.2 * metres / 6371008.8)
        exact = r.randrange(2)  # the first one has no radius of its own
        got, result = sphere(places, '--radius', r.choice([f'{metres}m', f'{metres / 1000}km']))
        assert result.code in (0, 3), result
        for _ in range(6):
            choice = [moved(p, metres / 6371008.8, r) for p in places]
            assert not refuted(got, choice), (SEED, k, metres, places, choice)
        less, _ = sphere(places, '--radius', f'{metres // 4}m')
        assert all(less.get(p) == 'legal' for p, s in got.items() if s == 'legal') and set(less) <= set(got), (SEED, k)


def test_choices_within_boxes():
    """Boxes of degrees, beyond the poles and across 180 degrees, beside exact places."""
    r = random.Random(SEED)
    for k in range(cases(40)):
        half = r.choice([0.01, 0.5, 3])
        places = scattered(r, r.randrange(4, 9), math.radians(2 * half))
        wide = [i > 1 or r.random() < 0.5 for i in range(len(places))]
        text = [(f'{x}+-{half}', f'{y}+-{half}') if w else (x, y) for (x, y), w in zip(places, wide)]
        got, result = sphere(text)
        if result.code == 1:
            assert 'cannot be distinguished from point' in result.err or 'may be nearly anywhere' in result.err, result
            continue
        for _ in range(6):
            choice = []
            for (x, y), w in zip(places, wide):
                x, y = x + w * half * r.uniform(-1, 1), y + w * half * r.uniform(-1, 1)
                choice.append((x + 180, math.copysign(180 - abs(y), y)) if abs(y) > 90 else (x, y))
            assert not refuted(got, choice), (SEED, k, half, places, choice)


def test_thin_boxes_about_poles():
    """Next to a pole many degrees of longitude are few metres."""
    near = '-5+-0.15 89.99+-0.005\n-163±0.25 90±0\n115±0.375 88±0.375\n'
    expect(run('delaunay', '--sphere', '-', stdin='22 -90\n[-113.5,-112.5] [-89.995,-89.985]\n'), 0, '^0,1,legal$')
    expect(run('delaunay', '--sphere', '-', stdin=near), 0, '^0,1,legal\n0,2,legal\n1,2,legal$')
    expect(run('voronoi', '--sphere', '--layer', 'vertices', '-', stdin=near), 0)
    touching = '129 [-90,-89.99875]\n[48.98125,49.21875] -90\n-107 [-89.9925,-89.77125]\n'  # its end is the pole
    expect(run('delaunay', '--sphere', '-', stdin=touching), 3, '^0,1,legal\n0,2,indeterminate\n1,2,indeterminate$')


def test_radius():
    """Degrees widen longitude and latitude; metres are a distance on the ground."""
    square = '0 60\n1 60\n0 60.5\n1 60.5\n50 0\n'
    want = run('delaunay', '--sphere', '-q', '--radius', '0.01deg', '-', stdin=square).out
    for same in (['--radius', '0.01', '--radius-unit', 'deg'], ['--radius', '36arcsec', '--radius-unit', 'm'],
                 ['--radius', '0.6', '--radius-unit', 'arcmin'], ['--radius', '10', '--radius-unit', 'deg', '--radius-scale', '0.001']):
        assert run('delaunay', '--sphere', '-q', *same, '-', stdin=square).out == want, same
    box = json.loads(run('delaunay', '--sphere', '-q', '--format', 'json', '--radius', '30m', '-', stdin='0 60\n10 0\n').out)['sites']
    angle = math.degrees(30 / 6371008.8)
    for site, wide in zip(box, (2, 1)):
        (x0, x1), (y0, y1) = site['x_decimal'], site['y_decimal']
        assert angle * 2 * wide <= x1 - x0 <= angle * 2 * wide * 1.001 and 2 * angle * 0.9999 <= y1 - y0 <= 2 * angle * 1.001, site
    for bare in ('0.01', '30', '1/64'):
        expect(run('delaunay', '--sphere', '--radius', bare, '-', stdin=square), 2, r'\A\Z', 'has no unit; state a unit: --radius-unit m')
    expect(run('delaunay', '--sphere', '--radius', '0', '-', stdin=square), 3, 'i,j,status')  # zero is zero in any unit
    for unit in ('miles', 'M', 'met'):
        expect(run('delaunay', '--sphere', '--radius', '3', '--radius-unit', unit, '-', stdin=square), 2, r'\A\Z', 'is not a unit of radii')
    for scale in ('0', '-1', 'x'):
        expect(run('delaunay', '--sphere', '--radius', '3m', '--radius-scale', scale, '-', stdin=square), 2, r'\A\Z', 'the scale of radii')
    expect(run('delaunay', '--radius', '3', '--radius-unit', 'm', '-', stdin=square), 2, r'\A\Z', 'in the plane .*--radius-scale 0.001')
    for wrong in ('30 miles', 'm', '-1m', '30kmm', '7000km'):
        expect(run('delaunay', '--sphere', '--radius', wrong, '-', stdin=square), 2, r'\A\Z', r'\Adyadel: the radius .*; give')


def table(places, radii):
    return 'lon,lat,acc\n' + ''.join(f'{x},{y},{a}\n' for (x, y), a in zip(places, radii))


COLUMN = ('--columns', 'lon,lat', '--radius-column', 'acc')


def test_radius_column():
    """Each its own unit; what --radius says is added; the same for all is as --radius."""
    square = [(0, 60), (1, 60), (0, 60.5), (1, 60.5), (50, 0)]
    for one in ('30m', '2km', '0.01deg', '1 ft', '1/64arcmin', '0'):
        got = run('delaunay', '--sphere', '-q', *COLUMN, '--format', 'json', '-', stdin=table(square, [one] * 5))
        want = run('delaunay', '--sphere', '-q', '--radius', one, '--format', 'json', '-', stdin=''.join(f'{x} {y}\n' for x, y in square))
        got, want = json.loads(got.out), json.loads(want.out)
        assert got['pairs'] == want['pairs'], one
        for a, b in zip(got['sites'], want['sites']):
            assert all(abs(p - q) < 1e-12 for axis in ('x_decimal', 'y_decimal') for p, q in zip(a[axis], b[axis])), (one, a, b)
    both = run('delaunay', '--sphere', '-q', *COLUMN, '--radius', '0.5km', '--layer', 'points', '-', stdin=table(square, ['1500m', '1.5km', '0m', '1deg', '6arcmin']))
    rows = [[float(v) for v in line.split(',')[1:5]] for line in both.out.splitlines() if line[0] in '01234']
    metre = math.degrees(1 / 6371008.8)
    for (x0, x1, y0, y1), metres, degrees in zip(rows, (2000, 2000, 500, 500, 500), (0, 0, 0, 1, 0.1)):
        assert math.isclose(y1 - y0, 2 * (metres * metre + degrees), rel_tol=1e-9) and x1 - x0 > y1 - y0 - 1e-9, (metres, degrees)
    for wrong in ('30 miles', 'm', '-1m', '30kmm', '-0.1', '1e400km'):
        expect(run('delaunay', '--sphere', *COLUMN, '-', stdin=table(square, ['1m', wrong, '1m', '1m', '1m'])), 1, r'\A\Z', r'-:3:\d+: the radius .*; give (one such as|a smaller one)|-:3:6: the radius is negative; if ')
    expect(run('delaunay', '--sphere', *COLUMN, '-', stdin=table(square, ['1m', '7000km', '1m', '1m', '1m'])), 1, r'\A\Z', 'point 1: the radius is larger than that of the earth')
    expect(run('delaunay', *COLUMN, '-', stdin=table(square, ['30m'] * 5)), 1, r'\A\Z', r'2:8: radii in the plane are in the unit of the coordinates')
    apart = ('--columns', 'lon,lat', '--radius-column', 'lon,acc')
    expect(run('delaunay', '--sphere', *apart, '-', stdin=table(square, ['30m'] * 5)), 1, r'\A\Z', r'2:6: the radii in x and in y differ.*; name one column')


def test_unit_of_column():
    """Stated by --radius-unit, by the name of the column, or by each value; otherwise refused. The value's own holds."""
    square = [(0, 60), (1, 60), (0, 60.5), (1, 60.5), (50, 0)]
    bare = table(square, ['30', '2000', '0', '5', '7'])
    expect(run('delaunay', '--sphere', *COLUMN, '-', stdin=bare), 2, r'\A\Z', 'the radius 30 has no unit; state a unit: --radius-unit m')
    mixed = table(square, ['30m', '2km', '0', '5', '7m'])
    expect(run('delaunay', '--sphere', *COLUMN, '-', stdin=mixed), 2, r'\A\Z', 'the radius 5 has no unit')
    ways = [(table(square, ['30m', '2km', '0', '5m', '7m']), COLUMN), (bare, (*COLUMN, '--radius-unit', 'm')),
            (table(square, ['30', '2km', '0', '500cm', '7']), (*COLUMN, '--radius-unit', 'm')),
            (table(square, ['30000', '2000000', '0', '5000', '7000']), (*COLUMN, '--radius-unit', 'm', '--radius-scale', '1e-3'))]
    ways += [(bare.replace('acc', name), ('--columns', 'lon,lat', '--radius-column', name)) for name in ('sde(m)', 's [m]', 'uncertaintyInMeters')]
    outs = [json.loads(run('delaunay', '--sphere', '-q', *how, '--format', 'json', '-', stdin=text).out)['sites'] for text, how in ways]
    assert all(out == outs[0] for out in outs), outs


def test_order_of_columns():
    """Names that say the other order: an error that gives the right one; in the plane a note."""
    rows = '47.1,8.5\n47.2,8.6\n47.15,8.4\n'
    for names in ('lat,lon', 'Latitude,Longitude', 'stop_lat,stop_lon', 'decimalLatitude,decimalLongitude', 'northing,easting', 'gps.lat,gps.lng',
                  'NORTH,EAST', 'northing,lon', 'lat_deg,lon_deg'):
        x, y = names.split(',')
        expect(run('delaunay', '--sphere', '--columns', names, '-', stdin=names + '\n' + rows), 2, r'\A\Z', f'longitude comes first: --columns {y},{x}')
        expect(run('delaunay', '--sphere', '-q', '--columns', f'{y},{x}', '-', stdin=names + '\n' + rows), 0, 'i,j,status', r'\A\Z')
        expect(run('delaunay', '--columns', names, '-', stdin=names + '\n' + rows), 0, 'i,j,status', 'a mirrored map')
        expect(run('delaunay', '--plane', '--columns', names, '-', stdin=names + '\n' + rows), 0, 'i,j,status', r'\A\Z')
    for names in ('x,y', 'latency,lonely', 'plateau,salon', 'a,lon', 'lat,b', 'easting,northing'):
        expect(run('delaunay', '-q', '--sphere', '--columns', names, '-', stdin=names + '\n' + rows), 0 if names != 'latency,lonely' else 2)


def test_radius_column_merged():
    """Of rows at one place the smallest radius, where it is inside the others; a radius in degrees goes with its box."""
    def box(*radii):
        got = run('delaunay', '--sphere', '-q', *COLUMN, '--merge', '--layer', 'points', '-', stdin=table([(5, 0)] * len(radii) + [(60, 20)], radii + ('0',)))
        low, high = next(line for line in got.out.splitlines() if line.startswith('0,')).split(',')[3:5]
        return float(high) - float(low)
    metre = 2 * math.degrees(1 / 6371008.8)
    assert math.isclose(box('30m', '20m', '40m'), 20 * metre, rel_tol=1e-9)
    assert math.isclose(box('0.3deg', '0.1deg', '0.2deg'), 0.2, rel_tol=1e-9)
    assert math.isclose(box('0.1deg', '30m'), 0.2, rel_tol=1e-9)  # neither is inside the other: the first
    assert math.isclose(box('30m', '0.1deg'), 30 * metre, rel_tol=1e-9)
    assert math.isclose(box('30m', '0'), 0, abs_tol=1e-12)


def test_choices_within_own_radii():
    r = random.Random(SEED)
    for k in range(30):
        metres = [r.choice([0, 1000, 50000, 300000]) for _ in range(r.randrange(4, 9))]
        places = scattered(r, len(metres), 1.2 * 300000 / 6371008.8)
        got = run('delaunay', '--sphere', '-q', *COLUMN, '-', stdin=table(places, [f'{m}m' for m in metres]))
        assert got.code in (0, 3), got
        rows = [line.split(',') for line in got.out.splitlines()[1:] if line[0] != '#']
        stated = {(int(i), int(j)): s for i, j, s in rows}
        for _ in range(6):
            choice = [moved(p, m / 6371008.8, r) for p, m in zip(places, metres)]
            assert not refuted(stated, choice), (SEED, k, metres, places, choice)


def test_crowds():
    """No point is apart from all others: pairs are open, some are decided all the same, and no choice contradicts."""
    r = random.Random(SEED)
    decided = 0
    for k in range(40):
        n, wide = r.randrange(2, 12), r.choice([0.2, 3, 30])
        middle = r.uniform(-180, 180), math.degrees(math.asin(r.uniform(-1, 1)))
        near = [moved(middle, math.radians(wide), r) for _ in range(n)]
        places = [(round(x, 4), round(y, 4)) for p in near for x, y in (p, moved(p, math.radians(wide) / 40, r))]
        metres = int(6371008.8 * math.radians(wide) / 60)
        got, result = sphere(places, '--radius', f'{metres}m')
        assert result.code in (0, 3) and set(got.values()) <= {'legal', 'indeterminate'}, result
        decided += len(got) < len(places) * (len(places) - 1) / 2
        for _ in range(8):
            choice = [moved(p, metres / 6371008.8, r) for p in places]
            assert not refuted(got, choice), (SEED, k, metres, places, choice)
        whole = diagram(''.join(f'{x} {y}\n' for x, y in places), '--radius', f'{metres}m')
        check_cells(whole)
        about = {frozenset((i, j)) for g in whole['regions'] for i in g['sites'] for j in g['sites'] if i < j}
        assert {frozenset(p) for p, s in got.items() if s == 'indeterminate'} <= about and whole['outcome'] == 'fixpoint', (SEED, k)
    assert decided > 10, decided
    around = '0 60\n90 60\n180 60.5\n-90 60.5\n0 -90\n0 0\n90 0\n180 0\n-90 0\n'
    expect(run('delaunay', '--sphere', '--radius', '6000km', '-', stdin=around), 1, r'\A\Z', 'anywhere on the globe.*; give a smaller radius')
    with tempfile.TemporaryDirectory() as folder:
        result = run('delaunay', '--sphere', '--radius', '500km', '--certificate', 'c', '-', stdin='0 0\n1 0\n0 1\n1 1\n', cwd=folder)
        expect(result, 3, '1,2,indeterminate')
        expect(run('verify', 'c', cwd=folder), 0, r'accepted, all of it proved(.|\n)*4 on a sphere')


# ---- formats and messages ----

def test_formats():
    places = '170 20\n-170 10\n180 -45\n0 90\n0 -90\n12 10\n190 10\n'
    whole = json.loads(run('delaunay', '--sphere', '--format', 'json', '-', stdin=places).out)
    assert whole['aliases'] == [[6, 1]] and whole['count']['sites'] == 7 and whole['outcome'] == 'decided'
    assert len(whole['triangles']) == 8 and len(whole['pairs']) == 12
    lines = json.loads(run('delaunay', '--sphere', '--format', 'geojson', '-', stdin=places).out)
    assert 'CRS84' in lines['crs']['properties']['name']
    cut = next(f for f in lines['features'] if (f['properties']['i'], f['properties']['j']) == (0, 1))
    east, west = cut['geometry']['coordinates']
    assert east[0] == [170, 20] and east[-1][0] == 180 and west[0] == [-180, east[-1][1]] and west[-1] == [-170, 10]
    for layer in ('triangles', 'points'):
        shapes = json.loads(run('delaunay', '--sphere', '--format', 'geojson', '--layer', layer, '-', stdin=places).out)
        assert len(shapes['features']) == (8 if layer == 'triangles' else 7)
        flat = re.findall(r'\[(-?[\d.e+-]+), (-?[\d.e+-]+)\]', json.dumps(shapes))
        assert all(abs(float(x)) <= 180 and abs(float(y)) <= 90 for x, y in flat)
    expect(run('delaunay', '--sphere', '--format', 'wkt', '--layer', 'triangles', '-', stdin=places), 0, r'^"MULTIPOLYGON \(\(\(')
    expect(run('delaunay', '--sphere', '--layer', 'points', '-', stdin=places), 0, r'^i,xlo,xhi,ylo,yhi,legal,indeterminate,tie,hull\n0,170,170,20,20,5,0,0,no$')
    back = run('delaunay', '--sphere', '--format', 'wkt', '--layer', 'triangles', '-', stdin='0 0\n1 0\n0 1\n')
    expect(back, 0, r'^"MULTIPOLYGON EMPTY",0,2,1')


def on_the_globe(vectors, places, bound):
    for v, (lon, lat) in zip(vectors, places, strict=True):
        x, y = math.radians(lon), math.radians(lat)
        want = math.cos(y) * math.cos(x), math.cos(y) * math.sin(x), math.sin(y)
        assert all(abs(a - b) <= bound + 1e-15 for a, b in zip(v, want)), (v, want, bound)


def test_meshes():
    """obj and vtk: on the sphere of radius 1, within the bound reported; edges and triangles are those of csv."""
    r = random.Random(SEED)
    places = [(round(r.uniform(-180, 180), 3), round(math.degrees(math.asin(r.uniform(-1, 1))), 3)) for _ in range(40)]
    text = ''.join(f'{x} {y}\n' for x, y in places + places[:1])
    for options in ([], ['--radius', '20km'], ['--radius', '500km']):
        got, _ = sphere(places + places[:1], *options)
        faces = {tuple(map(int, row.split(','))) for row in run('delaunay', '--sphere', '-q', *options, '--layer', 'triangles', '-', stdin=text).out.splitlines()
                 if row[0] not in '#i'}
        obj = run('delaunay', '--sphere', '-q', *options, '--format', 'obj', '-', stdin=text).out.splitlines()
        bound = float(re.search(r'at most (\S+)', obj[1])[1])
        assert bound < (1e-15 if not options else 0.1), bound
        on_the_globe([tuple(map(float, line.split()[1:])) for line in obj if line[0] == 'v'], places + places[:1], bound)
        assert {tuple(int(v) - 1 for v in line.split()[1:]) for line in obj if line[0] == 'l'} == {p for p, s in got.items() if s == 'legal'}
        assert {tuple(int(v) - 1 for v in line.split()[1:]) for line in obj if line[0] == 'f'} == faces
        vtk = run('delaunay', '--sphere', '-q', *options, '--format', 'vtk', '-', stdin=text).out.splitlines()
        assert len(vtk[1]) < 256 and float(re.search(r'within (\S+) of', vtk[1])[1]) == bound
        on_the_globe([tuple(map(float, line.split())) for line in vtk[5:5 + len(places) + 1]], places + places[:1], bound)
        at = next(k for k, line in enumerate(vtk) if line.startswith('LINES'))
        assert {tuple(map(int, line.split()[1:])) for line in vtk[at + 1:at + 1 + int(vtk[at].split()[1])]} == set(got)
        legal = [int(v) for v in vtk[vtk.index('SCALARS legal int 1') + 2:][:len(places)]]
        assert legal == [sum(s == 'legal' and k in p for p, s in got.items()) for k in range(len(places))]
    tilted = [(0, 0), (90, 0), (0, 90), (-140, -40)]
    faces = [line.split()[1:] for line in run('delaunay', '--sphere', '--format', 'obj', '-', stdin=''.join(f'{x} {y}\n' for x, y in tilted)).out.splitlines()
             if line[0] == 'f']
    assert ['1', '2', '3'] in faces, faces  # counter-clockwise from outside


def area(rings):
    """Of polygons of longitude and latitude, on a cylinder of equal areas, in parts of the globe."""
    total = 0
    for (ring,) in rings:
        for (x, y), (z, w) in zip(ring, ring[1:]):
            total -= (z - x) * (math.sin(math.radians(y)) + math.sin(math.radians(w))) / 2
    return total / 720


def test_triangles_cover_the_globe():
    """Poles within, sides across 180 degrees: the parts add up to all of it, none turned inside out."""
    r = random.Random(SEED)
    for k in range(cases(12)):
        places = [(r.randrange(-180, 180), r.randrange(-89, 90)) for _ in range(20)]
        text = OCTAHEDRON + ''.join(f'{x + 0.25} {y}\n' for x, y in places)
        shapes = json.loads(run('delaunay', '--sphere', '-q', '--format', 'geojson', '--layer', 'triangles', '-', stdin=text).out)
        areas = [area(f['geometry']['coordinates']) for f in shapes['features']]
        assert all(a > -1e-5 for a in areas) and abs(sum(areas) - 1) < 1e-3, (SEED, k, sum(areas), min(areas))


# ---- the diagram ----

def diagram(text, *options):
    return json.loads(run('voronoi', '--sphere', '-q', '--format', 'json', *options, '-', stdin=text).out)


def pole_of(places):
    """Longitude and latitude of the pole of the circle through three places, counter-clockwise from outside."""
    a, b, c = ([x / 10 ** 80 for x in map(Q, APART.vector(globe.canonical(p)))] for p in places)
    (p, q, r), (s, t, u) = globe.minus(b, a), globe.minus(c, a)
    n = [float(10 ** 12 * x) for x in (q * u - r * t, r * s - p * u, p * t - q * s)]
    return math.degrees(math.atan2(n[1], n[0])), math.degrees(math.atan2(n[2], math.hypot(n[0], n[1])))


def check_vertex(vertex, places):
    lon, lat = pole_of([places[vertex[c]] for c in 'ijk'])
    (x0, x1), (y0, y1) = vertex['x'], vertex['y']
    assert y0 - 1e-9 <= lat <= y1 + 1e-9 and any(x0 - 1e-6 <= lon + t <= x1 + 1e-6 for t in (-360, 0, 360)), (vertex, lon, lat)


def check_cells(whole):
    """Neighbours in a list share two cells; a vertex is in the cells of its three sites, and of others on their circle."""
    seen, sides = {}, []
    for cell in whole['cells']:
        ring = cell['vertices']
        assert None not in ring or not cell['complete'], cell
        for k, v in enumerate(ring):
            if v is None:
                continue
            seen.setdefault(v, set()).add(cell['i'])
            w = ring[(k + 1) % len(ring)]
            if w is not None and (cell['complete'] or k + 1 < len(ring)):
                sides.append((cell['i'], v, w))
    assert all(len(seen[v] & seen[w]) > 1 for i, v, w in sides), (whole, seen)
    assert all(sides.count((i, v, w)) == 1 for i, v, w in sides), whole
    assert len(seen) == len(whole['vertices']), whole
    for k, vertex in enumerate(whole['vertices']):
        sites = {vertex[c] for c in 'ijk'}
        assert sites <= seen[k] and (sites == seen[k] or any(seen[k] <= set(g['sites']) for g in whole['regions'])), (whole, k)


def test_voronoi_random():
    """Vertices where they are, cells in order; tied cells are in regions."""
    r = random.Random(SEED)
    for k in range(cases(80)):
        exact, places = some_places(r, k % 7)
        whole = diagram(''.join(f'{x} {y}\n' for x, y in places))
        for vertex in whole['vertices']:
            check_vertex(vertex, places)
        check_cells(whole)
        ties = {frozenset(p) for p, s in globe.statuses(exact, places).items() if s == 'tie'}
        inside = {frozenset((i, j)) for g in whole['regions'] for i in g['sites'] for j in g['sites'] if i < j}
        assert ties <= inside and all(g['status'] == 'tie' for g in whole['regions']), (SEED, k, places)
        assert all(c['complete'] for c in whole['cells']), (SEED, k, places)


def test_voronoi_radius():
    """Vertices hold for choices within the radius."""
    r = random.Random(SEED)
    checked = 0
    for k in range(cases(20)):
        metres = r.choice([100, 20000])
        places = scattered(r, 9, 1.2 * metres / 6371008.8)
        whole = diagram(''.join(f'{x} {y}\n' for x, y in places), '--radius', f'{metres}m')
        check_cells(whole)
        for _ in range(4):
            choice = [tuple(map(repr, moved(p, metres / 6371008.8, r))) for p in places]
            for vertex in whole['vertices']:
                check_vertex(vertex, choice)
                checked += 1
    assert checked > 15 * cases(20)


def test_voronoi_of_a_town():
    """Fixes some hundred metres apart, each within ten: vertices within a few times that, their sides in the picture."""
    town = '13.4050 52.5200\n13.4060 52.5210\n13.4080 52.5190\n13.4030 52.5230\n13.4100 52.5220\n13.4070 52.5175\n'
    whole = diagram(town, '--radius', '3m')
    near = [v for v in whole['vertices'] if v['y'][1] - v['y'][0] < 0.003 and v['x'][1] - v['x'][0] < 0.005]
    assert len(near) >= 3 and all(52.51 < v['y'][0] < 52.53 and 13.39 < v['x'][0] < 13.42 for v in near), whole['vertices']


def test_voronoi_layers():
    expect(run('voronoi', '--sphere', '-', stdin=OCTAHEDRON), 0, r'\Ai,complete,vertices\n0,yes,0 2 1 3\n1,yes,3 5 4 0\n')
    expect(run('voronoi', '--sphere', '--layer', 'vertices', '-', stdin=OCTAHEDRON), 0, r'^i,j,k,xlo,xhi,ylo,yhi\n0,1,4,4[45]\.\d+,45[.\d]*,35\.26')
    square = '0 0\n1 0\n0 1\n1 1\n50 50\n-70 -20\n'
    expect(run('voronoi', '--sphere', '-', stdin=square), 3, r'^0,yes,6 0 1\n1,yes,1 3 2 6\n', '11 legal, 0 indeterminate, 2 tied')
    expect(run('voronoi', '--sphere', '-q', '--layer', 'regions', '-', stdin=square), 3, r'\Aface,status,sites\n0,tie,0 1 2 3\n\Z')
    cells = json.loads(run('voronoi', '--sphere', '--format', 'geojson', '-', stdin=OCTAHEDRON).out)
    areas = [area(f['geometry']['coordinates']) for f in cells['features']]
    assert len(areas) == 6 and all(abs(a - 1 / 6) < 1e-3 for a in areas), areas
    for text, cells in (('', 0), ('1 2\n', 1), ('1 2\n3 4\n', 2), ('1 2\n3 4\n5 -6\n', 3)):
        got = diagram(text)
        assert len(got['cells']) == cells and all(c['complete'] for c in got['cells']) and len(got['vertices']) == 2 * (cells == 3)
    expect(run('voronoi', '--sphere', '--flatten', '3', '-', stdin=OCTAHEDRON), 2, r'\A\Z', '--flatten is about the plane')
    expect(run('voronoi', '--sphere', '--format', 'geojson', '--layer', 'regions', '-', stdin=OCTAHEDRON), 2, r'\A\Z', 'does not write geojson; give csv')


def test_pictures():
    """Well-formed, all marks in it, a graticule, nothing that runs across the map from side to side."""
    for command in ('delaunay', 'voronoi'):
        for text in ('', '1 2\n', '-35.9 53\n', '10 50\n11 50\n10 51\n', OCTAHEDRON + '170 20\n-170 10\n'):
            result = run(command, '--sphere', '--format', 'svg', '-', stdin=text)
            expect(result, 0, '<svg')
            xml.etree.ElementTree.fromstring(result.out)
            assert result.out.count('id="point-') == text.count('\n') and 'graticule' in result.out
        for form, magic in (('pdf', '%PDF'), ('png', '\x89PNG')):
            assert run(command, '--sphere', '--format', form, '-', stdin=OCTAHEDRON, binary=True).out.startswith(magic)
    for tiny in ('[-35.9,-35.9] 53/1', '-35.9 53', '12.3 4.5\n12.30000000000000001 4.5'):  # lines of the map below an ulp
        for command in ('delaunay', 'voronoi'):
            assert '<svg' in run(command, '--sphere', '--format', 'svg', '-', stdin=tiny + '\n').out
    assert '<svg' in run('delaunay', '--sphere', '--format', 'svg', '--window=12.3,12.300000000000001,4,4.5', '-', stdin='12.3 4.4\n').out
    drawn = run('delaunay', '--sphere', '--format', 'svg', *AIRPORTS).out
    assert 'legal: 10122' in drawn and drawn.count('id="point-') == 3376


def test_window():
    """Part of the map, over the seam too; cells in it are counted, and cut to it."""
    text = '178 -18\n179.5 -17\n-179 -18.5\n-178 -17\n177 -16.5\n10 10\n10 20\n'
    pairs = [row.split(',') for row in run('delaunay', '--sphere', '-', stdin=text).out.splitlines()[1:]]
    for window, inside in (('176,183,-20,-15', '01234'), ('-184,-177,-20,-15', '01234'), ('9,11,9,21', '56'), ('-100,-99,80,81', '')):
        drawn = run('delaunay', '--sphere', '--format', 'svg', f'--window={window}', '-', stdin=text).out
        assert sorted(re.findall('id="point-([0-9])', drawn)) == list(inside), window
        assert f'{len(inside)} of 7 points (and the lines counted) in this window' in drawn, window
        edges = sum(i in inside or j in inside for i, j, _ in pairs)
        assert re.findall('>legal: ([0-9]+)<', drawn) == [str(edges)] * (edges > 0), (window, edges)
    for narrow in ('-35.90000000000001,-35.9,53,53.00000000000001', '-35.9,-35.8,53,53.1'):  # finer than doubles tell apart
        assert '<svg' in run('delaunay', '--sphere', '--format', 'svg', f'--window={narrow}', '-', stdin='-35.9 53\n').out
    tall = run('delaunay', '--sphere', '--format', 'svg', '--window=178,180,-21,-15', '-', stdin=text).out  # near the bar
    end, bar = re.search('<text x="([0-9.]+)"[^>]*>([^<]* degrees?)<', tall).groups()
    row = re.search('>([^<]* in this window[^<]*)<', tall)[1]
    assert 'carr' in tall and 90 + 7 * len(row) < float(end) - 7 * len(bar), (row, end, bar)
    near = run('delaunay', '--sphere', '--format', 'svg', '-', stdin=text[:-12]).out  # seen around the date line unasked
    assert '>182<' in near and '>178<' in near and 'id="pair-1-3"' in near, re.findall('>[0-9]+<', near)
    crowd = run('delaunay', '--sphere', '--radius', '2km', '-q', '--format', 'svg', *AIRPORTS).out
    assert 'of 4846 indeterminate pairs across a square' in crowd and re.search('2[0-9]{3} of these 3376 points are in a small part', crowd)
    assert '7907 indeterminate' not in crowd and 'legal: 7907' in crowd
    for wrong, why in (('0,361,0,1', '360 degrees'), ('0,1,0,91', 'within -90 and 90'), ('5,1,0,1', 'wrong order')):
        bad = run('delaunay', '--sphere', '--format', 'svg', '--window', wrong, '-', stdin=text)
        assert bad.code in (1, 2) and why in bad.err, bad
    for command in ('delaunay', 'voronoi'):
        expect(run(command, '--sphere', '--window', '0,1,0,1', '-', stdin=text), 2, r'\A\Z', 'the part that a picture shows')
        assert '<svg' in run(command, '--sphere', '--window', '0,1,0,1', '--format', 'svg', '-', stdin=text).out


def test_ids_and_rows():
    """Names, skipped rows, merged rows."""
    text = 'name,lon,lat\na,0,0\nb,,\nc,10,0\nd,0,10\ne,10,0\n'
    args = ('delaunay', '--sphere', '-q', '--columns', 'lon,lat', '--id', 'name', '--skip-missing')
    expect(run(*args, '-', stdin=text), 0, r'\A# alias 4 2\ni,j,status,id_i,id_j\n0,2,legal,a,c\n0,3,legal,a,d\n2,3,legal,c,d\n\Z')


def test_note():
    """Degrees by their names, read as a plane, give one note; none if the values cannot be degrees, or --plane is
    given."""
    note = r'\Adyadel: -: the columns are longitude and latitude by their names.*--sphere; --plane says'
    for head in ('lon,lat', 'Longitude,LATITUDE', 'lng;latitude_deg', 'lon_x,lat_y', 'stop_lon,stop_lat',
                 'decimalLongitude,decimalLatitude', 'gpsLng,gpsLat'):
        names = head.replace(';', ',')
        text = head + '\n0 1\n-180 90\n3 4\n'.replace(' ', head[3] if head[3] == ';' else ',')
        expect(run('delaunay', '--columns', names, '-', stdin=text), 0, 'i,j,status', note + r'[^\n]*\n\Z')
        for quiet in ('--plane', '--quiet', '--sphere'):
            expect(run('delaunay', quiet, '--columns', names, '-', stdin=text), 0, 'i,j,status', r'\A\Z')
    expect(run('tolerance', '--columns', '1,2', '-', stdin='lon,lat\n0,1\n'), 0, '', note)
    for text in ('lon,lat\n181,1\n', 'x,y\n0,1\n', 'lon,lat\n'):
        got = run('delaunay', '--columns', '1,2', '-', stdin=text)
        assert got.code == 0 and 'by their names' not in got.err, (text, got)
    expect(run('delaunay', '--sphere', '--plane', '-', stdin=OCTAHEDRON), 2, r'\A\Z', 'contradict')


def test_certificate():
    """The certificate is about the places, and its statements are proved."""
    with tempfile.TemporaryDirectory() as folder:
        result = run('delaunay', '--sphere', '--certificate', 'c', '-', stdin=OCTAHEDRON, cwd=folder)
        expect(result, 0, 'i,j,status', r'\A\Z')
        expect(run('verify', 'c', cwd=folder), 0, 'accepted, all of it proved(.|\n)*6 on a sphere, projected from one of them: 5 images')


def test_trace():
    """It ends with the outcome of the run on the sphere."""
    with tempfile.TemporaryDirectory() as folder:
        expect(run('delaunay', '--sphere', '--trace', 't', '-', stdin=OCTAHEDRON, cwd=folder), 0, 'i,j,status')
        with open(os.path.join(folder, 't'), encoding='utf-8') as trace:
            assert json.loads(trace.readlines()[-1])['outcome'] == 'decided'


def test_computable_places():
    """Places by their values, whatever they are written as: equal ones are one, modulo 360 and at poles."""
    same = ['cbrt(125)*(-700807/5000)/5 (-19637/5000)+pi-pi', '(-117549/1250)+sqrt(64)-8 (-10063/250)+sqrt(36)-6',
            '(sqrt(7)+1)*(sqrt(7)-1)*(-1375251/10000)/6 18.1148',
            '(sqrt(7)+1)*(sqrt(7)-1)*(-567549/1250)/6 (sqrt(2)+1)*(sqrt(2)-1)*(-10063/250)/1']
    rows = {
        'by their numbers': (same, '# alias 3 1\n', '0,1,legal\n0,2,legal\n1,2,legal\n'),
        'exact and computable': (['18/10 2', 'sqrt(81)/5 sqrt(4)', '10 10'], '# alias 1 0\n', '0,2,legal\n'),
        'a pole': (['sqrt(2) 89+sin(3)^2+cos(3)^2', '7 90', '10 10', '5 89.99'], '# alias 1 0\n',
                   '0,2,legal\n0,3,legal\n2,3,legal\n'),
        'near a pole': (['69 (-90/1)+pi-pi', '144 -89.98'], '', '0,1,legal\n'),
        'on one circle': (['10+pi-pi 30', '(sqrt(7)+1)*(sqrt(7)-1)*20/6 sqrt(900)', '40 30*(sin(3)^2+cos(3)^2)', '70+e-e 30'], '',
                          '0,1,legal\n0,2,tie\n0,3,legal\n1,2,legal\n1,3,tie\n2,3,legal\n'),
        'about a pole, not known to be it': (['69 -90+log(2)+log(3)-log(6)', '144 -89.98', '10 10'], '',
                                             '0,1,legal\n0,2,legal\n1,2,legal\n')}
    for what, (places, aliases, pairs) in rows.items():
        text = '\n'.join(places) + '\n'
        got = run('delaunay', '--sphere', '--quiet', '-', stdin=text)
        assert got.code == (3 if 'tie' in pairs else 0) and got.out == aliases + 'i,j,status\n' + pairs, (what, got)
        with tempfile.TemporaryDirectory() as folder:
            run('delaunay', '--sphere', '--quiet', '--certificate', 'c', '-', stdin=text, cwd=folder)
            assert run('verify', 'c', cwd=folder).code == 0, what
    half = '100 sqrt(3)\nsqrt(2) sqrt(3)\n100 2/7\npi/7 -40\n'  # one coordinate measured, the other computable
    assert run('delaunay', '--sphere', '--quiet', '--measured', '-', stdin=half).code == 4
    unknown = '69 -90+log(2)+log(3)-log(6)\n144 -90\n10 10\n40 -20\n'
    expect(run('delaunay', '--sphere', '-', stdin=unknown), 4, '0,1,legal\n0,2,indeterminate', 'precision limit reached')


def test_failing_oracle():
    """The message names the place that fails, be it one that is projected, or the one that is projected from."""
    places = [(0, 0), (10, 10), (20, 5), (30, 40), (40, -20), (50, 11)]
    program = (f"import sys\nprint('points', 6, flush=True)\nfor line in sys.stdin:\n  _, i, b = line.split()\n  b = int(b) + 1\n"
               f"  x, y = {places}[int(i)]\n  x += 500 * (int(i) == int(sys.argv[1]) and b > 60)\n"
               f"  print(i, *(f'{{(c << b) + k}}*2^{{-b}}' for c, k in ((x, -1), (x, 0), (y, -1), (y, 1))), flush=True)\n")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'places.py')
        with open(path, 'w', encoding='ascii') as f:
            f.write(program)
        for command in ('delaunay', 'converge'):
            for bad in range(len(places)):
                result = run(command, '--sphere', '--start-bits', '100', '--oracle', f'exec python3 {path} {bad}')
                expect(result, 1, r'\A\Z' if command == 'delaunay' else '', f'dyadel: point {bad}: the oracle program was asked "refine {bad} ')


def test_refusals():
    expect(run('delaunay', '--sphere', '-', stdin='0 0\n47 91\n'), 1, r'\A\Z', r'2:4: .*latitude is beyond 90 degrees')
    expect(run('delaunay', '--sphere', '-', stdin='0 0\n47 50+sqrt(2000)\n'), 1, r'\A\Z', r'point 1: .*latitude is beyond 90 degrees')
    for args in (['--discs'], ['--until', 'area:3']):
        expect(run('delaunay', '--sphere', *args, '-', stdin=OCTAHEDRON), 2, r'\A\Z', args[0] + ' is about the plane')
    for command in ('check', 'disc', 'bisector', 'tolerance'):
        expect(run(command, '--sphere', '-', stdin=OCTAHEDRON), 2, r'\A\Z', f'{command} does not take --sphere')
    expect(run('voronoi', '--sphere', '--format', 'obj', '-', stdin=OCTAHEDRON), 2, r'\A\Z', 'does not write obj; give')


def test_converge():
    """A run stage by stage: its last row counts what delaunay counts, for points that are computed, too; nothing is said of a plane."""
    text = '0 45\n60 45+sqrt(2)*2^-45\n120 45\n180 45-sqrt(3)*2^-44\n-120 45\n-60 45+2^-43\n0 -80\n'
    table = run('converge', '--sphere', '--no-times', '-', stdin=text).out
    stages = list(csv.DictReader(l for l in table.splitlines() if not l.startswith('#')))
    legal = run('delaunay', '--sphere', '-', stdin=text).out.count(',legal')
    assert int(stages[-1]['legal']) == legal and stages[-1]['indeterminate'] == '0' and len(stages) > 1, stages
    assert all(row['area'] == row['hausdorff'] == '' for row in stages), stages
    for words, what in ((('--window', '0,1,0,1'), '--window'), (('--of', 'voronoi'), '--of'), (('--until', 'area:3'), '--until'), (('--format', 'html'), 'html')):
        expect(run('converge', '--sphere', *words, '-', stdin=text), 2, r'\A\Z', f'{what} is about the plane')


if __name__ == '__main__':
    main(globals())
