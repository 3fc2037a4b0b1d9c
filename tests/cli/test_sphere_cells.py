#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel voronoi --sphere: cells as polygons, against shapely (where installed) and the nearest points in many digits [SPH-1] [SPH-3] [SPH-4].

Usage: test_sphere_cells.py COMMAND DATA
"""
import csv
import itertools
import json
import math
import os
import random
import re
import sys

import mpmath
try:
    from shapely.geometry import Point, box, shape
    from shapely.ops import unary_union
    from shapely.validation import explain_validity
except ImportError:
    print('skipped: shapely is not installed')
    sys.exit(77)

from harness import DATA, cases, expect, main, run

SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
mpmath.mp.dps = 40


def grid(lons, lats):
    return [(x, y) for x in lons for y in lats]


def cells(places, *options):
    """Polygons by site, as shapely has them; each is checked on its own."""
    result = run('voronoi', '--sphere', '-q', '--format', 'geojson', *options, '-',
                 stdin=''.join(f'{x} {y}\n' for x, y in places))
    assert result.code in (0, 3), result
    answer = json.loads(result.out)
    found, count = {}, 0
    for feature in answer['features']:
        assert feature['properties']['complete'] == 'yes', feature
        shown = shape(feature['geometry'])
        assert not shown.is_empty and shown.is_valid, (SEED, feature, explain_validity(shown))
        rings = [ring for part in feature['geometry']['coordinates'] for ring in part]
        for ring in rings:
            assert ring[0] == ring[-1] and len(set(map(tuple, ring))) == len(ring) - 1, (SEED, 'repeats a place', ring)
            count += len(ring) - 1
        found[feature['properties']['i']] = shown
    return found, answer['max_coordinate_error'], count


def on_map(place):
    """Where the place is on the map, each one: a pole is a line, the edge is on both sides."""
    lon, lat = (float(place[0]) + 180) % 360 - 180, float(place[1])
    return [(lon, lat)] + [(180, lat)] * (lon == -180)


def vector(place):
    lon, lat = (mpmath.mpf(str(c)) * mpmath.pi / 180 for c in place)
    return mpmath.cos(lat) * mpmath.cos(lon), mpmath.cos(lat) * mpmath.sin(lon), mpmath.sin(lat)


def tiles(found, error, count):
    """What a plane program sees sums up to the map, and no two share more than a border."""
    most = error * 720 + count * error * 2 + 1e-9
    assert abs(sum(g.area for g in found.values()) - 64800) < most, (SEED, sum(g.area for g in found.values()))
    for a, b in itertools.combinations(list(found)[:100], 2):
        assert found[a].intersection(found[b]).area < most, (SEED, a, b)


def nearest_hold(places, found, r, count):
    """Places of the globe lie in the cell of their nearest point, unless they are within the chords of its border."""
    at = {i: vector(places[i]) for i in found}
    for _ in range(count):
        p = (round(r.uniform(-180, 180), 6), round(math.degrees(math.asin(r.uniform(-1, 1))), 6))
        v = vector(p)
        near = sorted(at, key=lambda i: -sum(a * b for a, b in zip(at[i], v)))
        inside = [i for i in found if found[i].covers(Point(p))]
        if inside == [near[0]]:
            continue
        # A chord of the map is off its arc by less than the arc is long, and arcs by much less away from the poles.
        far = [mpmath.acos(sum(a * b for a, b in zip(at[i], v))) for i in near[:2]]
        assert inside and set(inside) <= set(near[:3]), (SEED, p, near[:3], inside)
        assert abs(far[1] - far[0]) * 180 / mpmath.pi < 0.25, (SEED, p, far, inside)


def holds(places, *options, r=None, samples=40):
    found, error, count = cells(places, *options)
    for i, g in found.items():
        assert any(g.covers(Point(p)) for p in on_map(places[i])), (SEED, i, places[i])
    tiles(found, error, count)
    nearest_hold(places, found, r or random.Random(SEED), samples)
    return found


def test_few_points():
    """One point: the globe; two: halves; three: two vertices, of which each cell has both."""
    for place in [(10, 20), (0, 90), (180, 0)]:
        found = holds([place])
        assert found[0].equals(box(-180, -90, 180, 90)), place
    assert len(holds([(370, 20), (10, 20)])) == 1
    for pair in [((10, 20), (50, -30)), ((0, 0), (90, 0)), ((0, 0), (180, 0)), ((0, 90), (0, -90)), ((0, 10), (0, 20)),
                 ((-170, 80), (100, -1)), ((0, 90), (0, 0))]:
        assert len(holds(list(pair))) == 2, pair
    half = holds([(0, 90), (0, -90)])
    assert half[0].equals(box(-180, 0, 180, 90)) and half[1].equals(box(-180, -90, 180, 0)), half
    for three in [[(10, 20), (50, -30), (70, 80)], [(0, 0), (90, 0), (200, 0)], [(0, 0), (0, 40), (0, 80)],
                  [(0, 90), (0, -90), (0, 0)]]:
        assert len(holds(three)) == 3, three
    assert run('voronoi', '--sphere', '-q', '--format', 'geojson', '-', stdin='').code == 0


def test_one_circle():
    """All points on a great circle: lunes that meet at its poles; on another one: cells that meet at two places."""
    lunes = holds([(x, 0) for x in range(-180, 180, 30)])
    for i, lune in lunes.items():
        lon = -180 + 30 * i
        want = box(lon - 15, -90, lon + 15, 90) if i else unary_union(
            [box(165, -90, 180, 90), box(-180, -90, -165, 90)])
        assert lune.symmetric_difference(want).area < 1e-6, i
    for places in [[(x, 0) for x in range(0, 100, 10)], [(0, y) for y in range(-80, 90, 20)],
                   [(x, y) for x in (0, 180) for y in range(-80, 90, 20)], [(x, 60) for x in range(0, 360, 30)],
                   [(0, 0), (90, 45), (180, 0), (-90, -45)], [(x, -89) for x in range(0, 360, 45)]]:
        assert len(holds(places)) == len(places), places


def test_grids():
    """Ties everywhere, poles as points, as vertices, within sides, and within cells; sides on the edge of the map."""
    for places in [grid(range(-180, 180, 30), range(-60, 61, 30)), grid(range(-180, 180, 20), range(-85, 90, 10)),
                   grid(range(-175, 180, 10), range(-85, 90, 10)),
                   grid(range(-180, 180, 30), range(-60, 61, 30)) + [(0, 90), (0, -90)],
                   grid((0, 90, 180, 270), (0,)) + [(0, 90), (0, -90)], grid((45, 135, 225, 315), (35, -35)),
                   grid(range(0, 50, 10), range(0, 50, 10)), grid((0, 1, 2), (87, 88, 89)), grid((179, 180, 181), (-1, 0, 1))]:
        assert len(holds(places, samples=15)) == len(places), places


def test_random_sets():
    """Anywhere, about a pole, across 180 degrees, closely together, on few meridians and parallels."""
    r = random.Random(SEED)
    for k in range(cases(40)):
        n = r.randrange(4, 25)
        places = [[(round(r.uniform(-180, 180), 6), round(math.degrees(math.asin(r.uniform(-1, 1))), 6)) for _ in range(n)],
                  [(round(r.uniform(-180, 180), 3), r.choice([1, 1, -1]) * round(90 - r.uniform(0, 0.01), 7)) for _ in range(n)],
                  [(round(180 + r.uniform(-0.001, 0.001), 8), round(r.uniform(-0.001, 0.001), 8)) for _ in range(n)],
                  [(round(2 + r.uniform(0, 1e-6), 10), round(48 + r.uniform(0, 1e-6), 10)) for _ in range(n)],
                  [(30 * r.randrange(12), r.choice([-90, -60, -45, -30, 0, 30, 45, 60, 90])) for _ in range(n)]][k % 5]
        holds(places, r=r, samples=5)


def test_airports():
    path = os.path.join(DATA, 'airports.csv')
    with open(path, newline='') as f:
        places = [(row['longitude'], row['latitude']) for row in csv.DictReader(f)]
    found = holds([(float(x), float(y)) for x, y in places], '--max-arc', '0.1', samples=10)
    assert len(found) == len(set(places))


def test_max_arc():
    """Sides are divided into arcs of at most the degrees given; refused values."""
    places, counts = [(10, 20), (50, -30), (70, 80), (-100, 0)], []
    for most in (0.5, 1, 20, 90):
        found, _, count = cells(places, '--max-arc', str(most))
        counts.append(count)
        for g in found.values():
            for part in getattr(g, 'geoms', [g]):
                ring = list(part.exterior.coords)
                for a, b in zip(ring, ring[1:]):
                    if abs(a[1]) == 90 or abs(b[1]) == 90 or a[0] == b[0]:
                        continue
                    arc = mpmath.acos(min(mpmath.mpf(1), sum(x * y for x, y in zip(vector(a), vector(b)))))
                    assert arc * 180 / mpmath.pi <= most * 1.000001, (most, a, b)
    assert counts == sorted(counts, reverse=True) and counts[0] > counts[1] > counts[2], counts
    assert cells(places)[2] == counts[1], 'the default is 1'
    for wrong in ('0', '-1', '91', 'x', 'nan'):
        expect(run('voronoi', '--sphere', '--max-arc', wrong, '-', stdin='0 0\n'), 2, r'\A\Z', '--max-arc')
    expect(run('voronoi', '--max-arc', '1', '-', stdin='0 0\n'), 2, r'\A\Z', '--max-arc is about the globe; give --sphere')


def test_open_cells():
    """Where a vertex is open the cell says no, and has no polygon; never yes with nothing."""
    r = random.Random(SEED)
    seen = set()
    for k in range(cases(30)):
        n = r.randrange(1, 9)
        text = ''.join(f'{r.uniform(-180, 180):.3f} {r.uniform(-80, 80):.3f}\n' for _ in range(n))
        result = run('voronoi', '--sphere', '-q', '--radius', r.choice(['10km', '1000km', '5deg']), '--format', 'geojson', '-', stdin=text)
        if result.code == 1:
            continue  # they leave no place of the globe free
        for feature in json.loads(result.out)['features']:
            known = feature['properties']['complete'] == 'yes'
            assert known == bool(feature['geometry']['coordinates']), (SEED, k, feature)
            seen.add(known)
    assert seen == {True, False}, seen


def test_vertices():
    """A circle of points is one vertex of all its cells."""
    rows = run('voronoi', '--sphere', '-q', '--format', 'csv', '-', stdin='0 0\n90 0\n180 0\n270 0\n0 90\n45 -40\n135 -40\n225 -40\n315 -40\n').out
    lists = {int(row.split(',')[0]): row.split(',')[2].split() for row in rows.splitlines() if re.match(r'\d', row)}
    assert not any('*' in v for l in lists.values() for v in l), rows
    shared = [v for v in set(sum(lists.values(), [])) if sum(v in l for l in lists.values()) == 4]
    assert len(shared) == 1, rows
    assert all(len(l) == len(set(l)) for l in lists.values()), rows


main(globals())
