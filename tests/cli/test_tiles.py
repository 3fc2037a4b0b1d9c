#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tiles: a partition of the window for any points [PART-1], against cells cut from the window in exact rationals.

Usage: test_tiles.py COMMAND DATA
"""
import csv
import io
import json
import math
import os
import random
import re
import sys
import tempfile
from fractions import Fraction

from harness import expect, main, nearer_part, run

try:
    import shapely.geometry
    import shapely.ops
    import shapely.validation
    import shapely.wkt
except ImportError:
    print('skipped: shapely is not installed')
    sys.exit(77)

SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
CASES = int(float(os.environ.get('DYADEL_TEST_SCALE', '1')) * 1000)  # sets


def rings_of(text):
    """Of a table in wkt: (row, ring without its repeated end) for each row."""
    out = []
    for row in csv.DictReader(io.StringIO(text)):
        places = re.fullmatch(r'POLYGON \(\((.*)\)\)', row['WKT']).group(1).split(', ')
        ring = [tuple(Fraction(float(v)) for v in place.split(' ')) for place in places]
        assert ring[0] == ring[-1] and len(ring) > 3
        out.append((row, ring[:-1]))
    return out


def area2(ring):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))


def cells(points, window):
    x0, x1, y0, y1 = window
    found = {}
    for i, p in enumerate(points):
        if p in points[:i]:
            continue
        ring = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        for q in sorted(set(points) - {p}, key=lambda q, p=p: (q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2):
            ring = nearer_part(ring, p, q)
            if not ring:
                break
        found[i] = ring
    return found


def check_partition(rings, window, what):
    """Valid for GEOS, areas add up to the window's, and every edge but those of the rim is that of two rings."""
    x0, x1, y0, y1 = window
    assert sum(area2(ring) for _, ring in rings) == 2 * (x1 - x0) * (y1 - y0), what
    edges = set()
    for row, ring in rings:
        assert area2(ring) > 0, what
        said = shapely.validation.explain_validity(shapely.geometry.Polygon([tuple(map(float, z)) for z in ring]))
        assert said == 'Valid Geometry', (what, row, said)
        for a, b in zip(ring, ring[1:] + ring[:1]):
            assert a != b and (a, b) not in edges, (what, row)
            edges.add((a, b))
        area = Fraction(row['area'])
        assert area2(ring) <= 2 * area <= area2(ring) * (1 + Fraction(1, 2 ** 50)), (what, row)
    for a, b in edges:
        rim = (a[0] == b[0] in (x0, x1)) or (a[1] == b[1] in (y0, y1))
        assert rim or (b, a) in edges, (what, [float(v) for v in a + b])


def inside(ring, step):
    """The distances by which the ring's vertices may be off, as the least and largest area of the cell it
    represents."""
    length = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in zip(ring, ring[1:] + ring[:1]))
    return step * (2 * length + 8 * len(ring) * step)


def check_cells(rings, points, window, what):
    """Of exact points: tiles are the cells but for rounding, and the bounds hold the areas of the cells."""
    true = cells(points, window)
    found = {}
    for row, ring in rings:
        found.setdefault(int(row['i']), []).append((row, ring))
    for i, cell in true.items():
        area = area2(cell) / 2 if cell else Fraction(0)
        step = max((Fraction(row['max_coordinate_error']) for row, _ in rings), default=Fraction(0))
        got = sum((area2(ring) / 2 for _, ring in found.get(i, [])), Fraction(0))
        slack = inside(cell, 2 * step) if cell else 0
        assert abs(got - area) <= slack, (what, i, float(got), float(area), float(slack))
        for row, _ in found.get(i, []):
            assert Fraction(row['area_lo']) <= area <= Fraction(row['area_hi']), (what, i, row)
            assert Fraction(row['certain_area']) <= area, (what, i, row)
    assert set(found) <= set(true), what


def uniform(rng, n):
    return [(rng.random(), rng.random()) for _ in range(n)]


def grid(rng, n):
    side, shift = max(2, int(n ** 0.5)), rng.choice((0, 1000003, 0.1))
    return [(x * rng.choice((1, 1)) + shift, y - shift) for x in range(side) for y in range(side)]


def jittered(rng, n):
    tiny = 2.0 ** -rng.randrange(20, 53)
    return [(x + tiny * rng.randrange(-3, 4), y + tiny * rng.randrange(-3, 4)) for x, y in grid(rng, n)]


def line(rng, n):
    a, b = rng.choice(((1, 0), (0, 1), (3, 5), (1, 2 ** 20)))
    places = rng.sample(range(-3 * n, 3 * n), n)
    return [(a * t, b * t) for t in places]


def cluster(rng, n):
    """Points at distances of about the last bits of their coordinates, and some far away."""
    tiny = 2.0 ** -rng.randrange(30, 60)
    cx, cy = rng.random(), rng.random()
    near = [(cx + tiny * rng.randrange(-4, 5), cy + tiny * rng.randrange(-4, 5)) for _ in range(n)]
    return near + uniform(rng, rng.randrange(5))


def slanted(rng, n):
    """Cells as long as the window and about as wide as a step of its grid."""
    tiny, a, b = 2.0 ** -rng.randrange(36, 45), rng.randrange(-5, 6), rng.randrange(1, 6)
    off = rng.choice((0, 2.0 ** -60))
    places = rng.sample(range(rng.choice((1, 2, 3)) * n), n)
    return [(tiny * a * t + off * rng.randrange(-9, 9), tiny * b * t + off * rng.randrange(-9, 9)) for t in places] + \
        uniform(rng, rng.randrange(5))


def circle(rng, n):
    tiny = 2.0 ** -rng.randrange(40, 54)
    all_of = [(x, y) for x in range(-65, 66) for y in range(-65, 66) if x * x + y * y == 4225]
    return [(x + tiny * rng.randrange(-1, 2), y + tiny * rng.randrange(-1, 2)) for x, y in rng.sample(all_of, min(n, 30))]


KINDS = (uniform, grid, jittered, line, cluster, slanted, circle)


def random_window(rng, points):
    """Around all points, or cutting through them, its ends doubles, on vertices now and then."""
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    wide = max(max(xs) - min(xs), max(ys) - min(ys), 2.0 ** -20)
    if rng.random() < 0.3:
        return tuple(Fraction(v) for v in (-1, 2, -1, 2)) if wide < 3 else (
            Fraction(min(xs) - 1), Fraction(max(xs) + 1), Fraction(min(ys) - 1), Fraction(max(ys) + 1))
    x, y = rng.choice(points)
    ends = [x - wide * rng.random(), x + wide * rng.random(), y - wide * rng.random(), y + wide * rng.random()]
    if rng.random() < 0.3:
        ends = [round(x) - 1.5, round(x) + 1.5, round(y) - 0.5, round(y) + 1.5]
    return tuple(map(Fraction, ends))


def numbers(points):
    return ''.join(f'{float(x).hex()} {float(y).hex()}\n' for x, y in points)


def window_option(window):
    return '--window=' + ','.join(float(v).hex() for v in window)


def tiles(text, window, *options):
    found = run('voronoi', '-', '--layer', 'tiles', '--format', 'wkt', window_option(window), *options, stdin=text)
    assert found.code in (0, 3), (text, window, found.err)
    return rings_of(found.out)


def one_set(rng, what):
    kind = rng.choice(KINDS)
    points = kind(rng, rng.randrange(1, 14))
    window = random_window(rng, points)
    if window[0] >= window[1] or window[2] >= window[3]:
        return
    text = numbers(points)
    what = (what, kind.__name__, window_option(window), text)
    rings = tiles(text, window)
    check_partition(rings, window, what)
    check_cells(rings, [tuple(Fraction(float(v)) for v in p) for p in points], window, what)


def test_random_sets():
    for k in range(CASES):
        one_set(random.Random(f'{SEED} {k}'), k)


def test_rectangles():
    """Tiles are the cells of the centres, which is one choice: the bounds hold its areas."""
    for k in range(CASES // 10):
        rng = random.Random(f'{SEED} rectangles {k}')
        boxes = []
        for x, y in rng.choice((uniform, grid))(rng, rng.randrange(1, 10)):
            x, y = Fraction(round(x * 1000), 1000), Fraction(round(y * 1000), 1000)
            boxes.append([(c - w, c + v) for c in (x, y) for w in [Fraction(rng.randrange(200), 999)]
                          for v in [rng.choice((w, 0, 2 * w))]])
        text = ''.join(''.join('[{},{}] '.format(*side) for side in box) + '\n' for box in boxes)
        centres = [tuple((lo + hi) / 2 for lo, hi in box) for box in boxes]
        window = tuple(map(Fraction, (-1, 3, -1.25, 3)))
        rings = tiles(text, window)
        check_partition(rings, window, text)
        check_cells(rings, centres, window, text)


def test_computed_points():
    """The vertices of polygons by cosines are tied, their rectangles are not: the partition holds all the same."""
    for n in (3, 7, 24):
        text = ''.join(f'cos(2*pi*{k}/{n}) sin(2*pi*{k}/{n})\n' for k in range(n)) + '5 5\n'
        window = tuple(map(Fraction, (-2, 2, -2, 2)))
        rings = tiles(text, window)
        check_partition(rings, window, text)
        assert len(rings) == n, (n, len(rings))


def test_coincident_points():
    """Sites without a tile are counted: aliases, and rectangles of one centre."""
    said = run('voronoi', '-', '--layer', 'tiles', stdin='0 0\n0 0\n1 1\n')
    expect(said, 0, r'^i,area,certain_area,area_lo,area_hi$', '^dyadel: 1 points have the place or the centre of an earlier one')
    said = run('voronoi', '-', '--layer', 'tiles', stdin='[-1,1] 0\n[-2,2] 0\n5 5\n')
    expect(said, 3, err='1 points have the place or the centre of an earlier one')


def test_few_points():
    """Of one point all of the window; of none nothing; a window far away has the tile of the nearest point."""
    window = tuple(map(Fraction, (-1, 1, -1, 1)))
    rings = tiles('0.25 3\n', window)
    assert len(rings) == 1 and sorted(rings[0][1]) == [(-1, -1), (-1, 1), (1, -1), (1, 1)]
    rings = tiles('0 0\n1 0\n0 1\n', tuple(map(Fraction, (5, 6, -9, -8))))
    assert [row['i'] for row, _ in rings] == ['1']
    for window in ('0,0.1,0,0.1', '8.2,8.9,47.1,47.5', '-1/3,1/3,0.1,0.7', '1e-9,2e-9,0,1e-9'):
        ends = [Fraction(end) for end in window.split(',')]
        said = run('voronoi', '-', '--layer', 'tiles', '--format', 'wkt', '--window=' + window, stdin='0.01 0.02\n0.05 0.06\n0.09 0.01\n')
        expect(said, 0)
        shown = [xy for _, ring in rings_of(said.out) for xy in ring]
        shown = [f(xy[k] for xy in shown) for k in (0, 1) for f in (min, max)]
        outward = [(a - e) * (-1) ** (k + 1) for k, (a, e) in enumerate(zip(shown, ends))]
        assert all(0 <= o <= abs(e) / 2 ** 52 for o, e in zip(outward, ends)), (window, shown)
    said = run('voronoi', '-', '--layer', 'tiles', '--window=1e300,1.0000000000000003e300,0,1', stdin='0 0\n1 1\n')
    expect(said, 1, err='doubles are too coarse for tiles on this window')


# ---- cut to an area ----

def random_area(rng):
    """Unions of squares, round ones with holes, hulls on a coarse grid: borders meet those of tiles, and each other."""
    kind = rng.randrange(3)
    box = shapely.geometry.box
    if kind == 0:
        squares = [box(x, y, x + rng.choice([1, 2]), y + 1) for x in range(5) for y in range(5) if rng.random() < .5]
        return shapely.ops.unary_union(squares)
    if kind == 1:
        area = shapely.geometry.Point(rng.random() * 4, rng.random() * 4).buffer(rng.random() * 3 + .2, 6)
        for _ in range(rng.randint(0, 3)):
            area = area.difference(shapely.geometry.Point(rng.random() * 4, rng.random() * 4).buffer(rng.random(), 3))
        return area
    places = [(rng.randint(0, 8) / 2, rng.randint(0, 8) / 2) for _ in range(rng.randint(3, 6))]
    return shapely.geometry.MultiPoint(places).convex_hull.difference(box(1, 1, 2, 2))


def parts_of(text):
    return {int(row['i']): (row, shapely.wkt.loads(row['WKT'])) for row in csv.DictReader(io.StringIO(text))}


def exact_area(shape):
    total = Fraction(0)
    for part in getattr(shape, 'geoms', [shape]):
        for ring, sign in [(part.exterior, 1)] + [(hole, -1) for hole in part.interiors]:
            total += sign * abs(area2([(Fraction(x), Fraction(y)) for x, y in ring.coords[:-1]])) / 2
    return total


def one_area(rng, folder):
    area = random_area(rng)
    if area.is_empty or area.geom_type not in ('Polygon', 'MultiPolygon') or not area.is_valid:
        return
    kind, half = rng.randrange(3), lambda: rng.randint(0, 8) / 2
    points = ([(x, y) for x in range(rng.randint(1, 5)) for y in range(rng.randint(1, 5))] if kind == 0 else
              [(half(), half()) for _ in range(rng.randint(1, 12))] if kind == 1 else
              [(rng.random() * 4, rng.random() * 4) for _ in range(rng.randint(1, 15))])
    text = ''.join(f'{x!r} {y!r}\n' for x, y in points)
    path = os.path.join(folder, 'area')
    with open(path, 'w', encoding='utf-8') as out:
        if rng.random() < .5:
            out.write(shapely.wkt.dumps(area, rounding_precision=17))
        else:
            json.dump({'type': 'Feature', 'geometry': shapely.geometry.mapping(area)}, out)
    x0, y0, x1, y1 = (0, 1, 3, 4) if rng.random() < .4 else area.bounds
    view = '--window=' + ','.join(float(v).hex() for v in (x0, x1, y0, y1))
    asked = ['voronoi', '--quiet', '--layer', 'tiles', '--format', 'wkt', view, '-']
    what = f'{area.wkt} {points} {view}'
    result = run(*asked[:-1], '--clip-to', path, '-', stdin=text)
    assert result.code in (0, 3), f'{what}: {result.err}'
    cut, whole = parts_of(result.out), parts_of(run(*asked, stdin=text).out)
    seen = area.intersection(shapely.geometry.box(x0, y0, x1, y1))
    assert abs(float(sum(exact_area(shape) for _, shape in cut.values())) - seen.area) < 1e-11, f'the sum: {what}'
    for i, (row, shape) in cut.items():
        assert shape.is_valid, f'{shapely.validation.explain_validity(shape)}: {what}'
        low, certain, size, high = (float(row[name]) for name in ('area_lo', 'certain_area', 'area', 'area_hi'))
        assert low == certain and low - 1e-9 <= size <= high + 1e-9 and high - low < 1e-8, f'{row}: {what}'
        assert abs(size - shape.area) < 1e-11, f'{row}: {what}'
    for i, (_, tile) in whole.items():
        part = tile.intersection(area)
        left = cut[i][1].symmetric_difference(part).area if i in cut else part.area
        assert left < 1e-9, f'tile {i}: {what}'


def test_clip_to():
    rng = random.Random(SEED + 1)
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(CASES // 10):
            one_area(rng, folder)


def test_clip_to_rectangles():
    """What is certain of a part is at most the part of the inner polygon, and what is possible at least that of the outer."""
    rng = random.Random(SEED + 2)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'area')
        for _ in range(CASES // 50):
            area = shapely.geometry.Point(2, 2).buffer(1.7, 5).difference(shapely.geometry.box(1, 1, 2, 2))
            with open(path, 'w', encoding='utf-8') as out:
                out.write(area.wkt)
            points = [(rng.random() * 4, rng.random() * 4) for _ in range(9)]
            text = ''.join(f'{x!r} {y!r}\n' for x, y in points)
            asked = ['voronoi', '--quiet', '--radius', '0.05', '--format', 'wkt']
            cut = parts_of(run(*asked, '--layer', 'tiles', '--clip-to', path, '-', stdin=text).out)
            true = cells([(Fraction(x), Fraction(y)) for x, y in points], [Fraction(v) for v in (0, 4, 0, 4)])
            for i, ring in true.items():
                part = shapely.geometry.Polygon([(float(x), float(y)) for x, y in ring]).intersection(area).area
                low, high = (float(cut[i][0][name]) for name in ('area_lo', 'area_hi')) if i in cut else (0, 1e-9)
                assert low - 1e-9 <= part <= high + 1e-9, f'{i} {points}'


def test_areas_that_are_none():
    three = '0 0\n1 1\n2 0\n'
    for area, line in (('POLYGON ((0 0,\n 4 4, 4 0, 0 4, 0 0))', '1:11: the edge from (0, 0) on crosses or touches another'),
                       ('POLYGON ((0 0, 1 1, 0 0))', '1:24: a ring of a polygon has at least three different vertices'),
                       ('POLYGON ((0 0, 2 0, 2 2, x 2))', '1:26: a coordinate has to be here, a number'),
                       ('POLYGON ((0 0, 1e400 0, 2 2, 0 0))', '1:16: a coordinate has to be here, a number'),
                       ('{"type": "Polygon", "coordinates": [[[0, 0], [0, -1e309], [2, 2], [0, 0]]]}', 'a coordinate has to be here, a number'),
                       ('POLYGON ((0 0, 2 0, 2 2', 'the polygon has no end here; a bracket is missing'),
                       ('LINESTRING (0 0, 2 0)', 'a polygon has to be here, not a point or line'),
                       ('{"type": "Point",\n"coordinates": [0, 0]}', 'a polygon has to be here, not a point or line'),
                       ('<kml><Polygon></Polygon></kml>', 'make GeoJSON of it: ogr2ogr -f GeoJSON area.geojson FILE'),
                       ('SQLite format 3\0 ... POLYGON', 'neither well-known text nor GeoJSON'),
                       ('1,2\n', 'the file holds no polygon; give well-known text')):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'area')
            with open(path, 'w', encoding='utf-8') as out:
                out.write(area)
            result = run('voronoi', '--layer', 'tiles', '--clip-to', path, '-', stdin=three)
            assert result.code == 1 and result.out == '' and line in result.err, (area, result)
    expect(run('voronoi', '--clip-to', 'x', '-', stdin=three), 2, '', '--clip-to cuts tiles in the plane; give --layer tiles')
    expect(run('voronoi', '--layer', 'tiles', '--clip-to', 'x', '-', stdin=three), 1, '', 'x')


def test_areas_elsewhere():
    """Degrees for the one and metres for the other are valid, but hardly meant; a tile of one point still covers all."""
    for corner, note in ((7, 'no point is within the bounds of the polygons; do both have the same reference system'), (1, r'\Adyadel: window')):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'area')
            with open(path, 'w', encoding='utf-8') as out:
                out.write(f'POLYGON (({corner} {corner}, 9 {corner}, 9 9, {corner} {corner}))')
            expect(run('voronoi', '--layer', 'tiles', '--clip-to', path, '-', stdin='0 0\n1 1\n2 0\n', comments=False), 0, '^1,', note)


def test_areas_beyond_doubles():
    """What no double holds is left out; it once ended the command by a signal."""
    side = '2^700'
    asked = ['voronoi', '--layer', 'tiles', f'--window=-1*{side},1*{side},-1*{side},1*{side}', '-']
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'area')
        with open(path, 'w', encoding='utf-8') as out:
            out.write('POLYGON ((0 0, 6e199 0, 6e199 4e199, 0 4e199, 0 0))')
        for points in ('[2^658,2^659] [2^658,2^659]\n3*2^658 2^657\n', '2^658 2^658\n3*2^658 2^657\n'):
            expect(run(*asked, '--clip-to', path, stdin=points), 0, r'(?m)\A(#.*\n)*i,area,certain_area,area_lo,area_hi\n0,,0,0,\n1,,0,0,\n\Z')


def test_formats():
    """csv and geojson state what wkt does."""
    points = numbers(uniform(random.Random(SEED), 30))
    wkt = run('voronoi', '-', '--layer', 'tiles', '--format', 'wkt', stdin=points).out
    table = run('voronoi', '-', '--layer', 'tiles', stdin=points).out
    text = [line.split('",', 1)[-1].replace('WKT,', '').rsplit(',', 1)[0] for line in wkt.splitlines()]
    assert text == [line for line in table.splitlines() if not line.startswith('#')]
    features = json.loads(run('voronoi', '-', '--layer', 'tiles', '--format', 'geojson', stdin=points).out)['features']
    for (row, ring), feature in zip(rings_of(wkt), features):
        assert feature['geometry']['type'] == 'Polygon'
        assert [tuple(map(Fraction, z)) for z in feature['geometry']['coordinates'][0]] == ring + ring[:1]
        assert all(float(row[name]) == feature['properties'][name] for name in row if name != 'WKT')
    stated = json.loads(run('voronoi', '-', '--layer', 'tiles', '--format', 'json', stdin=points).out)
    for (row, ring), tile in zip(rings_of(wkt), stated['tiles'], strict=True):
        assert [tuple(map(Fraction, z)) for z in tile['rings'][0]] == ring and len(tile['rings']) == 1
        assert [tile['i'], tile['tile_area'], *tile['area']] == [float(row[name]) for name in ('i', 'area', 'area_lo', 'area_hi')]
    mesh = run('voronoi', '-', '--layer', 'tiles', '--format', 'vtk', stdin=points).out.split('\n')
    at = int(re.search(r'POINTS (\d+) double', '\n'.join(mesh)).group(1))
    begin = mesh.index(f'POINTS {at} double') + 1
    corners = [tuple(map(float, line.split()[:2])) for line in mesh[begin:begin + at]]
    assert corners == [tuple(map(float, z)) for _, ring in rings_of(wkt) for z in ring]
    picture = run('voronoi', '-', '--layer', 'tiles', '--format', 'svg', stdin=points).out
    assert sorted(re.findall(r'id="tile-(\d+)"', picture)) == sorted(row['i'] for row, _ in rings_of(wkt))


def test_ring():
    """All vertices of the diagram are within a few steps of the grid, so that tiles lead edges of others through theirs."""
    places = [(math.cos(2 * math.pi * i / 600), math.sin(2 * math.pi * i / 600)) for i in range(600)]
    result = run('voronoi', '-', '--layer', 'tiles', '--format', 'wkt', '--window=-2,2,-2,2',
                 stdin=''.join(f'{x!r} {y!r}\n' for x, y in places))
    assert result.code == 0, result
    check_partition(rings_of(result.out), (-2, 2, -2, 2), 'ring')


def test_formats_of_areas():
    """json has the rings of wkt, a picture one path for each tile with a subpath for each; vtk has no holes."""
    points = numbers(uniform(random.Random(SEED), 30))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'area')
        with open(path, 'w', encoding='utf-8') as out:
            out.write(shapely.geometry.Point(.5, .5).buffer(.45).difference(shapely.geometry.box(.4, .4, .405, .405)).wkt)
        asked = ['voronoi', '-', '--layer', 'tiles', '--clip-to', path, '--format']
        cut = parts_of(run(*asked, 'wkt', stdin=points).out)
        stated = json.loads(run(*asked, 'json', stdin=points).out)['tiles']
        assert [tile['i'] for tile in stated] == list(cut) and any(len(tile['rings']) > 1 for tile in stated)
        picture = run(*asked, 'svg', stdin=points).out
        for tile in stated:
            shape = cut[tile['i']][1]
            rings = [list(ring.coords)[:-1] for part in getattr(shape, 'geoms', [shape]) for ring in (part.exterior, *part.interiors)]
            assert [[tuple(z) for z in ring] for ring in tile['rings']] == rings
            path = re.search(rf'id="tile-{tile["i"]}".*?d="([^"]*)"', picture, re.S).group(1)
            assert path.count('M') == len(rings) == path.count('Z'), path
        expect(run(*asked, 'vtk', stdin=points), 1, '', 'vtk has no polygons with holes, which tiles cut by --clip-to may have')


if __name__ == '__main__':
    main(globals())
