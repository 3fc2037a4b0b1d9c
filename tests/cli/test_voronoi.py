#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel voronoi: goals, windows, budgets, formats, and bounds that shrink by half per bit.

Usage: test_voronoi.py COMMAND DATA
"""
import csv
import json
import math
import os
import re
import sys
import tempfile
import xml.etree.ElementTree
from fractions import Fraction

import gps
from harness import DATA, expect, main, run

POLYGON = ''.join(f'cos({k}*pi/6) sin({k}*pi/6)\n' for k in range(12))
RADICANDS = [((2, 1, 0), (3, 1, 0)), ((5, 1, 1), (2, 3, 0)), ((7, 2, 0), (11, 1, 0)),
             ((13, 1, -3), (17, 5, 0)), ((19, 2, 1), (23, 2, 0)), ((29, 3, 0), (31, 4, 0))]  # sqrt(a)/b + c
ROOTS = ''.join(' '.join(f'sqrt({a})/{b}+({c})' for a, b, c in p) + '\n' for p in RADICANDS)
TOUCHING = '[0,1] [0,1]\n[1,2] [0,1]\n5 5\n'
# An oracle whose rectangles are exactly as wide as asked for: width 2^-B.
EXACT_WIDTH = f'''
import math, sys
P = {RADICANDS!r}
def side(t, b):
    a, d, c = t
    m = math.isqrt((a << 2 * b) // (d * d)) + (c << b)
    return '%d*2^-%d %d*2^-%d' % (m, b, m + 1, b)
print('points', len(P), flush=True)
for line in sys.stdin:
    _, i, b = line.split()
    b = max(int(b), 0)
    print(i, side(P[int(i)][0], b), side(P[int(i)][1], b), flush=True)
'''


def number(text):
    """m*2^e or a rational."""
    if '*2^' in text:
        m, e = text.split('*2^')
        return int(m) * Fraction(2) ** int(e)
    return Fraction(text)


def decided(points, *options):
    result = run('voronoi', '--quiet', '--format', 'json', *options, '-', stdin=points)
    return result, json.loads(result.out)


def table(text):
    """Comments of a csv, and its rows."""
    lines = text.splitlines()
    return [x for x in lines if x.startswith('#')], list(csv.DictReader(x for x in lines if not x.startswith('#')))


# ---- goals ----

def test_cocircular_points_are_certified():
    for goal, key, bits in (('hausdorff:40', 'distance_to_true_diagram', 40), ('area:30', 'undetermined_area', 30)):
        result, data = decided(POLYGON, '--until', goal)
        expect(result, 0)
        assert data['outcome'] == 'certified' and data['goal_bits'] == bits
        assert data['goal'] == 'voronoi ' + goal.split(':')[0], data['goal']
        assert data['count'] == {'sites': 12, 'legal': 12, 'indeterminate': 0, 'tie': 54}, data['count']
        bound = data['bounds'][key]
        assert number(bound['exact']) <= Fraction(1, 2**bits), bound
        assert Fraction(bound['decimal']) >= number(bound['exact']), bound
        assert len(data['cells']) == 12
        vertex, = data['vertices']  # all have it in common
        assert vertex['sites'] == list(range(12)) and all(vertex[a][0] <= 0 <= vertex[a][1] for a in 'xy'), vertex
        region, = data['regions']
        assert region['sites'] == list(range(12))
        for axis in 'xy':  # the centre of the polygon
            assert region[axis][0] <= 0 <= region[axis][1] < 1e-9, region
        check_cells(data)


def test_decided_goal_of_cocircular_points():
    expect(run('voronoi', '--layer', 'regions', '-', stdin=POLYGON), 3, '^0,', '54 tie')
    result = run('voronoi', '--max-bits', '64', '--ties', 'off', '-', stdin=POLYGON)
    expect(result, 4, '^# distance_to_true_diagram,', '^dyadel: budget: .*raise --max-bits')


def test_exit_of_goals():
    expect(run('voronoi', '--until', 'hausdorff:0', '-', stdin=ROOTS), 0)
    for wrong in ('hausdorff:x', 'area:', 'area', 'hausdorff:1.5', 'volume:3'):
        expect(run('voronoi', '--until', wrong, '-', stdin=ROOTS), 2, r'\A\Z', '--until')


def test_small_budget():
    result = run('voronoi', '--max-bits', '8', '--until', 'hausdorff:60', '-', stdin=ROOTS)
    expect(result, 4, '^5,', '^dyadel: budget: .*raise --max-bits')
    bound = re.search('^# distance_to_true_diagram,(.*)$', result.out, re.M).group(1)
    assert Fraction(1, 2**60) < Fraction(bound) < 1, bound


def test_fixed_rectangles():
    for goal in ('hausdorff:10', 'area:10', 'decided'):
        result, data = decided(TOUCHING, '--until', goal)
        expect(result, 3)
        assert data['outcome'] == 'fixpoint' and len(data['cells']) == 3, data['outcome']
    expect(run('voronoi', '--until', 'hausdorff:10', '-', stdin=TOUCHING), 3, '', '^dyadel: fixpoint')
    apart = '[0,1/8] 0\n[4,33/8] 0\n2 3\n'
    result, data = decided(apart, '--until', 'hausdorff:20')
    expect(result, 3)
    assert data['count']['indeterminate'] == 0 and number(data['bounds']['distance_to_true_diagram']['exact']) > 2**-20
    result, data = decided(apart, '--until', 'hausdorff:0')
    expect(result, 0)


# ---- windows ----

def test_wrong_windows():
    for window, message in (('1,0,0,1', 'wrong order'), ('0,1,1,0', 'wrong order'), ('0,0,0,1', 'no area'),
                            ('0,1,2,2', 'no area'), ('a,b,c,d', 'four exact numbers'), ('0,1', 'four exact numbers'),
                            ('0,1,0,1,2', 'four exact numbers'), ('0,1,0,nan', 'four exact numbers'),
                            ('-inf,inf,0,1', 'four exact numbers'), ('', 'four exact numbers')):
        expect(run('voronoi', '--window', window, '-', stdin=ROOTS), 2, r'\A\Z', f'^dyadel: --window .*{message}')


def test_window_is_stated():
    result, data = decided('0 0\n8 0\n0 4\n')
    expect(result, 0)
    assert [[number(t) for t in data['window'][k]] for k in 'xy'] == [[-2, 10], [-1, 5]], data['window']
    comments, _ = table(run('voronoi', '-', stdin='0 0\n8 0\n0 4\n').out)
    line, = [c for c in comments if c.startswith('# window ')]
    assert [number(t) for t in line.split()[2:]] == [-2, 10, -1, 5], line
    result, data = decided('0 0\n8 0\n0 4\n', '--window=-1/4,3/2,0,2^10')
    expect(result, 0)
    assert [[number(t) for t in data['window'][k]] for k in 'xy'] == [[Fraction(-1, 4), Fraction(3, 2)], [0, 1024]]
    assert sum(Fraction(c['area'][0]) for c in data['cells']) <= 1792 <= sum(Fraction(c['area'][1])
                                                                            for c in data['cells'])


def test_windows_of_unequal_sides():
    """Polygons follow cells no coarser than the window is narrow: y runs 2^60 times as far as x, and the other way."""
    points = [('6', '10*2^60'), ('[3,9]', '[2*2^60,9*2^60]'), ('0', '5*2^60'), ('6', '2^60'), ('[3,8]', '[0,11*2^60]')]
    for swap in (False, True):
        text = ''.join(' '.join(p[::-1] if swap else p) + '\n' for p in points)
        comments, rows = table(run('voronoi', '--quiet', '-', stdin=text, timeout=60).out)
        ends = [number(t) for c in comments if c.startswith('# window ') for t in c.split()[2:]]
        area = (ends[1] - ends[0]) * (ends[3] - ends[2])
        cells = rows
        assert len(cells) == 5 and all(float(r['area_hi']) < 1.5 * area for r in cells), cells
        assert any(float(r['area_lo']) > 0 for r in cells), cells


# ---- regions of undecided faces ----

def regions(points, *options):
    """The window, and the boxes of the regions."""
    comments, rows = table(run('voronoi', '--quiet', '--layer', 'regions', *options, '-', stdin=points).out)
    window = [float(number(t)) for c in comments if c.startswith('# window ') for t in c.split()[2:]]
    return window, [[float(r[k]) for k in ('xlo', 'xhi', 'ylo', 'yhi')] for r in rows]


def test_regions_of_tracks_are_small():
    window, found = regions(gps.points(400, 1))
    area = (window[1] - window[0]) * (window[3] - window[2])
    share = sorted((b[1] - b[0]) * (b[3] - b[2]) / area for b in found)
    assert len(found) > 20 and window not in found, (len(found), found.count(window))
    assert share[len(share) // 2] < 1e-3 and share[-1] < 0.9, (share[len(share) // 2], share[-1])


def test_region_of_a_square():
    """Corners of half-width w: centres at (+-w, +-w) are possible, those farther off than 3 w are not."""
    for bits in (3, 20, 45):
        w = 2.0**-bits
        square = ''.join(f'{x}+-{w!r} {y}+-{w!r}\n' for x in (-1, 1) for y in (-1, 1))
        for window in ('-8,8,-8,8', '-1000000,50,-1/3,12345'):
            _, found = regions(square, '--window=' + window)
            assert len(found) == 1, found
            for lo, hi in (found[0][:2], found[0][2:]):
                assert -3 * w < lo <= -w and w <= hi < 3 * w, (bits, found)


def test_boxes_are_clipped():
    """Enclosures of vertices beyond the window are not on maps, others end at its sides."""
    points = ''.join(f'{x}+-0.01 {y}+-0.01\n' for x, y in ((0, 0), (4, 0), (8, 0.25), (2, 3), (6, 3.5), (3, 6)))
    for layer in ('vertices', 'regions'):
        count = []
        for w, (xlo, xhi, ylo, yhi) in (('-99,99,-99,99', (-99, 99, -99, 99)), ('2,6,1,1.875', (2, 6, 1, 1.875))):
            text = run('voronoi', '--quiet', '--window', w, '--layer', layer, '--format', 'geojson', '-', stdin=points).out
            found = [f['properties'] for f in json.loads(text)['features']]
            assert all(xlo <= b['xlo'] <= b['xhi'] <= xhi and ylo <= b['ylo'] <= b['yhi'] <= yhi for b in found), found
            count.append(len(found))
        assert count[0] > count[1] or layer == 'regions', count
        assert count[1] > 0 or layer == 'regions', count


# ---- the distance where rectangles crowd ----

def distance(points, *options):
    """The bound stated, and the one that a certificate proves."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, 'proof')
        result = run('voronoi', '--quiet', '--certificate', name, *options, '-', stdin=points)
        with open(name, encoding='ascii') as text:
            proved = re.search('^distance (.*)$', text.read(), re.M)[1]
        assert run('verify', name).code in (0, 3)
    return float(re.search('^# distance_to_true_diagram,(.*)$', result.out, re.M)[1]), float(number(proved))


def test_distance_in_a_crowd():
    """No more than the second nearest of the rectangles that are apart: sqrt(148) here, where all that are near meet."""
    crowd = '[-1,1] [-1,1]\n' * 3 + '10 0\n[30,31] [-1,1]\n[30,32] [-1,1]\n'
    stated, proved = distance(crowd, '--window=-2,2,-2,2')
    assert 148 <= stated**2 < 148 * 17 / 16 and proved <= 17 / 16 * stated, (stated, proved)


def test_distance_of_airports():
    result = run('voronoi', '--quiet', '--columns', 'longitude,latitude', '--radius', '0.05', '--window=-90,-85,33,37',
                 os.path.join(DATA, 'airports.csv'))
    assert float(re.search('^# distance_to_true_diagram,(.*)$', result.out, re.M)[1]) <= 0.64, result.out[:300]


# ---- few points, coincident points, points on a line ----

def test_few_points():
    for n, cells in ((0, 0), (1, 1), (2, 2)):
        points = ''.join(f'{k} {k}\n' for k in range(n))
        for form in ('csv', 'json', 'geojson', 'wkt', 'vtk', 'svg'):
            expect(run('voronoi', '--format', form, '-', stdin=points), 0)
        result, data = decided(points)
        assert data['count']['sites'] == n and len(data['cells']) == cells
        assert not data['vertices'] and not data['regions'] and len(data['edges']) == n // 2
        assert number(data['bounds']['distance_to_true_diagram']['exact']) == 0


def test_coincident_points():
    result, data = decided('0 0\n1 1\n0 0\n3 1\n1 1\n0 0\n')
    expect(result, 0)
    assert data['aliases'] == [[2, 0], [4, 1], [5, 0]], data['aliases']
    assert [c['i'] for c in data['cells']] == [0, 1, 3] and len(data['vertices']) == 1
    comments, rows = table(run('voronoi', '-', stdin='0 0\n1 1\n0 0\n').out)
    assert '# alias 2 0' in comments and [r['i'] for r in rows] == ['0', '1']
    result, data = decided('1/3 1/7\n' * 5)
    expect(result, 0)
    assert len(data['cells']) == 1 and len(data['aliases']) == 4


def test_collinear_points():
    result, data = decided('0 0\n1 1\n2 2\n')
    expect(result, 3)  # 0 and 2 share the point at infinity: an exact tie
    assert data['count']['tie'] == 1 and not data['vertices'] and len(data['cells']) == 3
    result, data = decided('0 0\n1 1\n2 2\n', '--until', 'hausdorff:50')
    expect(result, 0)
    result, data = decided('sqrt(2) sqrt(2)\n1 1\n0 0\n', '--until', 'hausdorff:50')
    expect(result, 0)
    assert number(data['bounds']['distance_to_true_diagram']['exact']) <= Fraction(1, 2**50)


# ---- json ----

def signed_area2(ring):
    """Twice the area; exact."""
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))


def check_boundary(boundary, i):
    for chain in boundary['chains']:
        arcs = chain['arcs']
        assert arcs and {a['kind'] for a in arcs} <= {'line', 'parabola', 'window'}
        assert all(i in (a['far'], a['near']) for a in arcs if 'near' in a), arcs
        for a, b in list(zip(arcs, arcs[1:])) + ([(arcs[-1], arcs[0])] if chain['closed'] else []):
            assert a['end']['kind'] == 'infinite' or a['end']['at'] == b['begin']['at'], (a, b)
        if not chain['closed']:
            assert arcs[0]['begin']['kind'] == arcs[-1]['end']['kind'] == 'infinite'


def check_cells(data):
    """Areas of the polygons against the areas stated; arcs join up; the undetermined areas add up."""
    window = [[number(t) for t in data['window'][k]] for k in 'xy']
    whole = (window[0][1] - window[0][0]) * (window[1][1] - window[1][0])
    inside = Fraction(0)
    for cell in data['cells']:
        inner = [[number(t) for t in z] for z in cell['inner']]
        outer = [[[number(t) for t in z] for z in ring] for ring in cell['outer']]
        area = signed_area2(inner) / 2
        if 'exact_area' in cell:  # rounded once, the polygon is the cell
            low, high = (Fraction(a) for a in cell['area'])
            assert low <= Fraction(cell['exact_area']) <= high and outer in ([inner], []), cell['i']
        assert ('exact_area' in cell or Fraction(cell['area'][0]) <= area) and all(signed_area2(ring) > 0 for ring in outer), cell['i']
        assert Fraction(cell['area'][0]) <= Fraction(cell['area'][1]), cell['area']
        assert all(w[0] <= t <= w[1] for z in inner for t, w in zip(z, window))
        inside += area
        check_boundary(cell['int'], cell['i'])
        check_boundary(cell['pos'], cell['i'])
    assert inside <= whole <= sum(Fraction(c['area'][1]) for c in data['cells'])
    assert number(data['bounds']['undetermined_area']['exact']) >= whole - inside


def root(t, bits=400):
    """sqrt(a)/b + c within 2^-bits."""
    a, b, c = t
    return Fraction(math.isqrt(a << 2 * bits), b << bits) + c


def centre(p):
    """Circumcentre of three points."""
    (ax, ay), (bx, by), (cx, cy) = p
    bx, by, cx, cy = bx - ax, by - ay, cx - ax, cy - ay
    d = 2 * (bx * cy - by * cx)
    return (ax + (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d,
            ay + (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d)


def test_tied_vertices():
    """A vertex of four or more sites is one, with all of them, be they exact or proved to be on one circle."""
    for points, sites, at in (('0 0\n1 0\n0 1\n1 1\n', '0 1 2 3', (Fraction(1, 2), Fraction(1, 2))),
                              ('sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n', '0 1 2 3', (0, 0)),
                              ('0 0\n2 0\n0 2\n2 2\n5 1\n', '0 1 2 3', (1, 1))):
        out = run('voronoi', '-', '--layer', 'vertices', stdin=points).out.splitlines()
        assert [line for line in out if line.startswith('# tie')] == ['# tie ' + sites], out
        row, = [line.split(',') for line in out if line.startswith('0,1,2,')]
        box = [Fraction(t) for t in row[3:]]
        assert box[0] <= at[0] <= box[1] and box[2] <= at[1] <= box[3] and box[1] - box[0] < 1e-15, box
        feature, = [f for f in json.loads(run('voronoi', '-', '--layer', 'vertices', '--format', 'geojson',
                                              stdin=points).out)['features'] if f['properties']['k'] == 2]
        assert feature['geometry']['coordinates'] == [float(x) for x in at], feature
    fine = run('voronoi', '-', '--layer', 'vertices', '--until', 'hausdorff:200', stdin=POLYGON).out.splitlines()[-1]
    assert fine.startswith('0,1,2,') and number(fine.split(',')[4]) - number(fine.split(',')[3]) <= Fraction(1, 2**200)
    line = run('voronoi', '-', '--layer', 'vertices', stdin='0 0\n1 1\n2 2\n3 3\n').out
    assert '# tie' not in line and line.endswith('yhi\n'), line  # of a line there is none
    undecided = run('voronoi', '-', '--layer', 'vertices', stdin='0 0\n1 0\n0 1\n[1,1.1] 1\n').out
    assert '# tie' not in undecided and undecided.endswith('yhi\n'), undecided


def test_scales_far_apart_have_polygons():
    """Where no flattening is given, the command takes one with which it can draw the cells."""
    points = '[0,1*2^-100] 0\n1 [0,1]\n[3*2^100,4*2^100] 5\n1*2^-300 [1*2^-310,1*2^-309]\n'
    for layer in ('cells', 'edges', 'regions', 'vertices'):
        expect(run('voronoi', '-', '--layer', layer, stdin=points), 3)
    result = run('voronoi', '-', '--format', 'json', stdin=points)
    expect(result, 3)
    for cell in json.loads(result.out)['cells']:
        assert 0 < cell['area'][0] <= cell['area'][1], cell
    expect(run('voronoi', '-', '--flatten', '2', stdin=points), 1, '', 'give a smaller M by --flatten')


def test_polygons_that_cross_themselves_are_made_finer():
    """As coarse as the goal asks first, a region touches itself: finer, it does not, and the goal is judged."""
    result = run('voronoi', '-', '--measured', '--layer', 'edges', '--until', 'hausdorff:4',
                 '--window=-79,91.000000000116415321826934814453125,-5,5.0000000000072759576141834259033203125',
                 stdin='-44 0\n-16 0\n-70 0\n-70 0\n-74 0\n')
    expect(result, 3, 'i,j,left,right\n0,1,open,open\n2,3,open,open\n', '--until hausdorff:-5 holds')


def test_enclosures_of_vertices_are_whole():
    """A vertex that may be outside of the window has the enclosure in every format that csv has."""
    points, window = '[-4,4] -1\n4 0\n[-3,3] 6\n', '--window=-2,2,1,3'
    lines = run('voronoi', '-', '--layer', 'vertices', window, stdin=points).out.splitlines()
    row, = [[float(t) for t in line.split(',')[3:]] for line in lines if line.startswith('0,1,2,')]
    assert row[0] < -2 or row[1] > 2 or row[2] < 1 or row[3] > 3, row  # or nothing would be cut
    feature, = json.loads(run('voronoi', '-', '--layer', 'vertices', '--format', 'geojson', window,
                              stdin=points).out)['features']
    held = feature['properties']
    assert [held[k] for k in ('xlo', 'xhi', 'ylo', 'yhi')] == row, (held, row)
    for at, low, high in zip(feature['geometry']['coordinates'], row[::2], row[1::2]):
        assert abs(at - low) <= held['max_coordinate_error'] and abs(at - high) <= held['max_coordinate_error'], held
    vertex, = json.loads(run('voronoi', '-', '--format', 'json', window, stdin=points).out)['vertices']
    assert vertex['x'] + vertex['y'] == row, (vertex, row)


def test_vertices_are_as_narrow_as_the_goal():
    points = [tuple(root(t) for t in p) for p in RADICANDS]
    for bits in (10, 100, 300):
        result, data = decided(ROOTS, '--until', f'hausdorff:{bits}')
        expect(result, 0)
        assert data['outcome'] == 'certified' and len(data['vertices']) == 6 and len(data['edges']) == 11
        for vertex in data['vertices']:
            truth = centre([points[i] for i in vertex['sites']])
            for axis, value in zip('xy', truth):
                low, high = (number(t) for t in vertex[axis + '_exact'])
                assert 0 <= high - low <= Fraction(1, 2**bits), (bits, float(high - low))
                assert low - Fraction(1, 2**390) <= value <= high + Fraction(1, 2**390), vertex
                assert Fraction(vertex[axis][0]) <= value <= Fraction(vertex[axis][1]), vertex
        check_cells(data)


def test_rational_vertices():
    """Of exact points the vertices are known: inside their enclosures, and edges join those of their two sites."""
    points = [(Fraction(k * k % 17), Fraction(k * k * k % 23, 3)) for k in range(1, 12)]
    result, data = decided(''.join(f'{x} {y}\n' for x, y in points))
    expect(result, 0)
    n = len(data['vertices'])
    for vertex in data['vertices']:
        for axis, value in zip('xy', centre([points[i] for i in vertex['sites']])):
            low, high = (number(t) for t in vertex[axis + '_exact'])
            assert low <= value <= high, vertex
    rays = 0
    for edge in data['edges']:
        for end in ('from', 'to'):
            if isinstance(edge[end], dict):
                rays += 1
                continue
            assert 0 <= edge[end] < n and {edge['i'], edge['j']} <= set(data['vertices'][edge[end]]['sites']), edge
    assert len(data['edges']) - n == data['count']['sites'] - 1 and 2 * len(data['edges']) == 3 * n + rays  # Euler
    check_cells(data)


# ---- other formats ----

def outputs(*options):
    return {form: run('voronoi', '--quiet', '--until', 'hausdorff:40', '--format', form, *options, '-', stdin=POLYGON)
            for form in ('csv', 'json', 'geojson', 'wkt', 'vtk', 'svg')}


def check_csv(text):
    _, rows = table(text)
    assert [r['i'] for r in rows] == [str(k) for k in range(12)]
    for r in rows:
        assert Fraction(r['xlo']) <= Fraction(r['xhi']) and Fraction(r['ylo']) <= Fraction(r['yhi'])
        low, high = Fraction(r['area_lo']), Fraction(r['area_hi'])
        assert low <= high and 1 - low / high - Fraction(1, 10**15) <= Fraction(r['undetermined']) <= 1


def check_geojson(text):
    kinds = []
    for feature in json.loads(text)['features']:
        kinds.append(feature['properties']['kind'])
        if feature['geometry']['type'] == 'Polygon':
            for ring in feature['geometry']['coordinates']:
                assert len(ring) >= 4 and ring[0] == ring[-1], ring
    assert kinds.count('certain') == kinds.count('possible') == 12, kinds


def check_wkt(text):
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) >= 24 and [r['kind'] for r in rows].count('certain') == 12
    for r in rows:
        shape, body = re.fullmatch(r'(POLYGON|MULTIPOLYGON|POINT|LINESTRING) (\(.*\))', r['WKT']).groups()
        assert body.count('(') == body.count(')')
        points = [[float(t) for t in z.split()] for z in re.sub('[()]', '', body).split(',')]
        assert all(len(z) == 2 for z in points) and (shape != 'POLYGON' or points[0] == points[-1]), r


def check_vtk(text):
    lines = iter(text.splitlines())
    assert next(lines) == '# vtk DataFile Version 3.0' and 'outcome certified' in next(lines)
    assert [next(lines), next(lines)] == ['ASCII', 'DATASET POLYDATA']
    count = int(re.fullmatch(r'POINTS (\d+) double', next(lines)).group(1))
    assert all(len([float(t) for t in next(lines).split()]) == 3 for _ in range(count))
    # Twelve edges from the tied vertex; twelve cells twice, this vertex, and its region.
    cells = 0
    for name in ('LINES', 'POLYGONS'):
        some, size = map(int, re.fullmatch(name + r' (\d+) (\d+)', next(lines)).groups())
        for _ in range(some):
            indices = [int(t) for t in next(lines).split()]
            assert indices[0] == len(indices) - 1 and all(0 <= k < count for k in indices[1:])
            size -= len(indices)
        cells += some
        assert size == 0, name
    assert next(lines) == f'CELL_DATA {cells}'
    rest = list(lines)
    assert rest.count('LOOKUP_TABLE default') == 2 and len(rest) == 2 * cells + 4
    kinds = rest[rest.index('SCALARS kind int 1') + 2:]
    assert sorted(kinds) == ['0'] * 12 + ['1'] * 12 + ['2', '3'] + ['4'] * 12, kinds


def test_formats():
    made = outputs()
    for result in made.values():
        expect(result, 0, '.', r'\A\Z')
    check_csv(made['csv'].out)
    check_geojson(made['geojson'].out)
    check_wkt(made['wkt'].out)
    check_vtk(made['vtk'].out)
    xml.etree.ElementTree.fromstring(made['svg'].out)
    expect(run('voronoi', '--format', 'obj', '-', stdin=POLYGON), 2, r'\A\Z', 'obj')


def test_threads_and_repeats_give_equal_bytes():
    one, again, three = outputs('--threads', '1'), outputs('--threads', '1'), outputs('--threads', '3')
    for form, result in one.items():
        assert result.out == again[form].out == three[form].out, form


# ---- convergence ----

def stages(*options):
    result = run('converge', '--of', 'voronoi', '--schedule', 'uniform', '--step-bits', '1', '--until', 'hausdorff:50', '--max-bits', '44',
                 '--window', '0,4,0,4', '--no-times', *options)
    expect(result, 4)
    return table(result.out)[1]


def check_halving(rows, span):
    """Per bit, over spans of this many bits, on all stages from 8 bits on."""
    rows = [r for r in rows if int(r['bits_least']) >= 8]
    assert len(rows) > 30 and all(r['indeterminate'] == '0' for r in rows)
    for column in ('v_area', 'v_hausdorff'):
        for a, b in zip(rows, rows[span:]):
            per_bit = (float(b[column]) / float(a[column])) ** (1 / span)
            assert 0.35 < per_bit < 0.65, (column, span, a, b)
        for a, b in zip(rows, rows[1:]):
            assert float(b[column]) <= float(a[column]), (column, a, b)
        ratio = float(rows[24][column]) / float(rows[0][column]) * 2**24
        assert 0.8 < ratio < 1.25, (column, ratio)


def test_bounds_fall_by_half_per_bit():
    """Rectangles exactly as wide as asked for: every bit counts."""
    with tempfile.TemporaryDirectory() as folder:
        script = os.path.join(folder, 'oracle.py')
        with open(script, 'w', encoding='ascii') as out:
            out.write(EXACT_WIDTH)
        check_halving(stages('--oracle', f"'{sys.executable}' '{script}'"), 1)


def test_bounds_of_expressions():
    """Expressions narrow by some bits at a time (three, here), so that is the step to look at."""
    with tempfile.TemporaryDirectory() as folder:
        points = os.path.join(folder, 'points.txt')
        with open(points, 'w', encoding='ascii') as out:
            out.write(ROOTS)
        rows = stages(points)
    check_halving(rows, 3)
    check_halving(rows, 24)


def test_airports_on_a_window():
    """A real file: the diagram of a part of the country."""
    result = run('voronoi', '--quiet', '--columns', 'longitude,latitude', '--window=-100,-84,30,46',
                 os.path.join(DATA, 'airports.csv'))
    comments, rows = table(result.out)
    cells = rows
    low, high = (math.fsum(float(r[k]) for r in cells) for k in ('area_lo', 'area_hi'))
    assert result.code in (0, 3) and len(cells) > 100 and low < 256 < high, (result.code, len(cells), low, high)
    assert [c for c in comments if c.startswith('# window ')] == ['# window -100 -84 30 46'], comments


def test_notes_on_goals():
    """Reports the bound requested, the bound reached and the remedy; bounds reported as reached do hold."""
    boxes = '[0,0.125] 0\n4 [0,0.125]\n[0,0.125] 4\n4 4\n'
    endless = 'exp(log(6)/2) 0\n0 sqrt(6)\n-exp(log(6)/2) 0\n0 -sqrt(6)\n'
    for command, goal, text, code, options, why in (
            ('voronoi', 'area', boxes, 3, (), 'better measurements'), ('voronoi', 'hausdorff', boxes, 3, (), 'better measurements'),
            ('delaunay', 'area', boxes, 3, (), 'better measurements'), ('delaunay', 'hausdorff', endless, 4, (), 'max-bits'),
            ('voronoi', 'hausdorff', endless, 4, ('--max-bits', '99'), 'raise --max-bits')):
        result = run(command, '--until', goal + ':200', *options, '-', stdin=text)
        expect(result, code)
        note = re.search(r'is at most 2\^(-?\d+), not 2\^-200 as asked; .*' + why + r'.*; --until (\w+:(-?\d+)) holds$',
                         result.err)
        assert note and int(note[1]) == -int(note[3]) > -200, (command, goal, result.err)
        expect(run(command, '--until', note[2], *options, '-', stdin=text), 0, '', r'\A\Z')
        expect(run(command, '--quiet', '--until', goal + ':200', *options, '-', stdin=text), code, '', r'\A\Z')
    expect(run('voronoi', '--until', 'hausdorff:9', '-', stdin='[0,2] 0\n[1,3] 0\n'), 3, '',
           'the distance to the true diagram is .* 2\\^-9')
    expect(run('voronoi', '-', stdin=boxes), 3, '', '[0-9]+ legal, [0-9]+ indeterminate pairs; only better')


def test_area_goal_out_of_reach_ends():
    """Polygons are as fine as they help, not as fine as a goal that the rectangles cannot reach."""
    boxes = ''.join(f'[{x},{x}.25] [{y},{y}.125]\n' for x in range(4) for y in range(4))
    result = run('voronoi', '--quiet', '--until', 'area:40', '--format', 'json', '-', stdin=boxes)
    expect(result, 3)
    coarse = run('voronoi', '--quiet', '--format', 'json', '-', stdin=boxes)
    bound = [json.loads(r.out)['bounds']['undetermined_area']['decimal'] for r in (result, coarse)]
    assert bound[0] <= bound[1] and len(result.out) < 4 * len(coarse.out), bound


def test_capped():
    """Neighbours are missing, so that the diagram does not exist and no file is made."""
    boxes = ''.join(f'[{k},{k + 9}] [{k % 5},{k % 5 + 9}]\n' for k in range(12))
    with tempfile.TemporaryDirectory() as folder:
        result = run('voronoi', '--max-pairs', '1', '-o', 'out', '-', stdin=boxes, cwd=folder)
        expect(result, 4, r'\A\Z', 'no diagram is written: .*raise --max-pairs')
        assert not os.listdir(folder)


main(globals())
