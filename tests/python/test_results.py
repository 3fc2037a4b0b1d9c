#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What results tell, in all forms: arrays, formats, geometries, pickles; appended and measured points; questions."""
import copy
import csv
import gzip
import importlib.util
import json
import math
import os
import pathlib
import pickle
import struct
import tempfile
from fractions import Fraction

import harness
import numpy as np

import dyadel

RANDOM = np.random.default_rng(harness.seeded('results').randrange(2**32))
RANDOM_FILES = np.random.default_rng(harness.seeded('files').randrange(2**32))
SQUARE = [(0, 0), (1, 0), (0, 1), (1, 1)]
AIRPORTS = dyadel.Text.from_file(f'{harness.DATA}/airports.csv', columns='longitude,latitude')
GPS = dyadel.Text.from_file(f'{harness.DATA}/gps.csv', columns='east,north', radius_columns='accuracy', id='name')


def airports():
    rows = csv.DictReader(AIRPORTS.text.decode().splitlines())
    return np.array([[float(row[axis]) for axis in ('longitude', 'latitude')] for row in rows])


def test_statuses():
    d = dyadel.delaunay(SQUARE)
    assert d.outcome == 'fixpoint' and d.ties.tolist() == [[0, 3], [1, 2]]
    assert d.legal.tolist() == [[0, 1], [0, 2], [1, 3], [2, 3]] and d.indeterminate.shape == (0, 2)
    assert d.pairs.tolist() == [[0, 1, dyadel.LEGAL], [0, 2, 3], [0, 3, dyadel.TIE], [1, 2, 1], [1, 3, 3], [2, 3, 3]]
    assert [d.status(0, j) for j in range(4)] == ['illegal', 'legal', 'legal', 'tie']
    assert d.simplices.shape == d.neighbors.shape == (0, 3) and [h.tolist() for h in d.hull] == [[0, 1, 3, 2]] * 2
    harness.raised(IndexError, d.status, 0, 4)
    harness.raised(IndexError, d.rect, 4)
    harness.raised(IndexError, d.status, -1, 0)
    harness.raised(IndexError, d.status, 2**32, 1)
    d = dyadel.delaunay([(0, 0), (1, 1), ('1/2', 2), ('2/2', '3-2')])
    assert d.aliases.tolist() == [[3, 1]] and len(d.boxes) == len(d) == 4


def test_notions():
    """Of few points, as the command has them; T as a region."""
    a, b, c, r = ((0, 1), (0, '1/2')), ((4, 6), (0, 2)), ((1, '5/2'), (4, 5)), ((2, '5/2'), (2, '5/2'))
    assert dyadel.orientation(a, b, c) == 'counter-clockwise' and dyadel.orientation(a, c, b) == 'clockwise'
    assert dyadel.orientation((0, 0), (1, 0), (2, (0, 1))) == 'unknown'
    assert [dyadel.con(p, a, b, c) for p in (r, ((8, 9), (5, 6)), ((-1, 0), (3, 4)))] == ['inside', 'outside', 'unknown']
    disc = dyadel.disc([a, b, c, r])
    assert (disc.orientation, disc.con, disc.outcome) == ('counter-clockwise', ['inside'], 'decided') and len(disc.circles) == 6
    assert disc.circles[0].labels == 'FCC' and disc.circles[0].x == '-4+4*sqrt(2)' and disc.circles[2].radius_squared == '45/8'
    assert all(k.radius[0] <= k.radius[1] and k.centre[0] <= k.centre[1] for k in disc.circles)
    assert dyadel.disc([(0, 0), (1, 0), (2, 0)]).circles == [] and dyadel.con((1, 1), (0, 0), (1, 0), (2, 0)) == 'unknown'
    assert dyadel.con(('sqrt(2)', 1), (0, 0), ('pi', 0), (1, 'e')) == 'inside'
    near, far = dyadel.bisector([((0, 2), (0, 1)), (5, 4)]).curves
    assert [k.kind for k in near] == ['line'] * 3 and {k.kind for k in far} == {'line', 'parabola'}
    assert near[0].begin is None and near[-1].end is None and near[0].end is not None
    assert dyadel.bisector([((0, 2), (0, 2)), ((1, 3), (1, 3))]).curves == ([], [])
    assert dyadel.hull([(1, '1/3')]) == [(1, Fraction(1, 3))] and dyadel.hull([(0, 0), (1, 2)]) == [(0, 0), (1, 2)]
    assert dyadel.hull([a, b]) == [(0, 0), (6, 0), (6, 2), (4, 2), (0, Fraction(1, 2))] and len(dyadel.hull([a, b, c])) == 6
    for wrong in ([], [a] * 4):
        assert 'one to three points' in str(harness.raised(ValueError, dyadel.hull, wrong))
    assert '3 points are needed' in str(harness.raised(dyadel.Error, dyadel.disc, [a, b]))
    square = dyadel.delaunay(SQUARE).exterior
    assert square[0] == [(0, 0), (0, 1), (1, 1), (1, 0)] and len(square) == 5 and all((Fraction(1, 2),) * 2 in t for t in square[1:])
    assert dyadel.delaunay([(0, 0)]).exterior == []


def test_airports():
    """README's table; the same from arrays and from the text."""
    d = dyadel.delaunay(AIRPORTS)
    assert (d.outcome, len(d.legal)) == ('decided', 10112)
    assert np.array_equal(dyadel.delaunay(airports()).pairs, d.pairs)
    wide = dyadel.delaunay(airports(), radius=0.01)
    assert (wide.outcome, len(wide.legal), len(wide.indeterminate), len(wide.ties)) == ('fixpoint', 8925, 2490, 0)
    discs = wide.discs()
    assert [(discs[:, 2] == s).sum() for s in (dyadel.LEGAL, dyadel.INDETERMINATE)] == [9148, 1996]
    assert np.array_equal(dyadel.delaunay(wide.boxes).pairs, wide.pairs), 'boxes are input again'


def test_carried():
    """Columns that a text's points carry: unchanged, of rows that became points."""
    text = 'name,x,y,"a,b",n\np,0,0,007,\nq,NA,1,u,1\nr,9,1,"two\nlines",2\ns,3,7,\u00e9,3\n'
    read = {'columns': 'x,y', 'skip_missing': True}
    wanted = {'name': ['p', 'r', 's'], 'a,b': ['007', 'two\nlines', '\u00e9'], 'n': ['', '2', '3']}
    for sphere in False, True:
        d = dyadel.delaunay(dyadel.Text(text, carry='all', **read), sphere=sphere)
        assert d.carried == wanted and dyadel.delaunay(dyadel.Text(text, **read), sphere=sphere).carried == {}
    d = dyadel.delaunay(dyadel.Text(text, carry='n,name', **read))
    assert d.carried == {'n': wanted['n'], 'name': wanted['name']} and dyadel.delaunay(SQUARE).carried == {}
    if importlib.util.find_spec('geopandas'):
        for layer in 'tiles', 'cells':
            frame = d.voronoi().to_geodataframe(layer)
            assert frame['name'].tolist() == [wanted['name'][int(row) - (row > 0)] for row in frame['i']], frame


def test_reading_options():
    """Every field of dyd_read_options that the command has is one of Text: it acts as there, and as in other calls."""
    table = 'x,y,c,s,w,n\n' + ''.join(f'"sqrt({k})","cbrt({k * k + 1})",{1 + 9 * (k % 3)},0.{k % 4 + 1},{k % 3},p{k}\n' for k in range(2, 14))
    costs = [1 + 9 * (k % 3) for k in range(2, 14)]
    def work(*points, **options):
        counters = dyadel.delaunay(*points, start_bits=2, **options).counters
        return {name: value for name, value in counters.items() if 'seconds' not in name}
    told = work(dyadel.Text(table, 'x,y', cost_column='c'))
    assert told == work(dyadel.Text(table, 'x,y'), cost=costs) != work(dyadel.Text(table, 'x,y'))
    exact = 'x,y,s,w\n' + ''.join(f'{x},{y},0.25,{x + 1}\n' for x, y in [(0, 0), (4, 0), (5, 3), (1, 4), (2, 1)])
    def tolerance(*names, **options):
        table = dyadel.tolerance(dyadel.Text(exact, 'x,y', **options), **({'sigma': 0.25} if 'sigma' in names else {}))
        return {name: table[name].tolist() for name in table}
    assert tolerance(sigma_column='s') == tolerance('sigma') != tolerance()
    still = dyadel.tolerance(dyadel.Text('x,y,w\n0,0,0\n1,0,0\n0,1,0\n', 'x,y', radius_columns='w', keep_radii=True))
    assert len(still['lo']) and np.isinf(still['lo']).all(), 'a weight of 0: no motion'
    for twice in (1, 2):  # twice the weights: half the motion
        scaled = tolerance(radius_columns='w', keep_radii=True, radius_scale=str(twice))
        assert scaled['lo'] != tolerance()['lo'] and scaled['event'].count('death') == tolerance()['event'].count('death')
        lo = [v / twice for v in scaled['hi']] if twice == 1 else lo
        assert all(v <= 1.0001 * l / twice for v, l in zip(scaled['lo'], lo)), (scaled, lo)
    assert dyadel.delaunay(dyadel.Text('x;y\n1,5;2\n0;0\n', 'x,y', decimal_comma=True, delimiter=';')).boxes[0, 0] == 1.5
    assert len(dyadel.delaunay(dyadel.Text('x,y\n1,2\n1,2\nNA,3\n', 'x,y', merge=True, skip_missing=True))) == 1
    twice = dyadel.Text('n,x,y,r\na,0,0,1\nb,9,0,1\na,0.5,0,1\nc,0,9,1\n', 'x,y', id='n', radius_columns='r', merge_by='id')
    assert len(dyadel.delaunay(twice)) == 3
    for wrong in ({'radius_column': 'w'}, {'columns': 'x,y', 'radius': 0.5}, {'measured': None, 'id ': 'n'}):
        harness.raised(TypeError, dyadel.delaunay, dyadel.Text('0 0\n', **wrong))
    harness.raised(TypeError, dyadel.Text, '0 0\n', degrees=True)


def test_confidence():
    """sigma= and confidence= are the command's --sigma-column and --confidence, of arrays, lists and texts; copies keep it."""
    rand = np.random.default_rng(5)
    points, s = rand.random((40, 2)) * 100, np.round(rand.random((40, 3)), 3)
    s[7, :2] = 0
    d = dyadel.delaunay(points, sigma=s, confidence=0.95)
    k = np.sqrt(2 * np.log(39 / 0.05))
    assert d.confidence.probability == '0.95' and d.confidence.n == 39 and 0 <= d.confidence.k - k <= 1e-14
    half = (d.boxes[:, 1::2] - d.boxes[:, 0::2]) / 2
    assert (half >= k * s[:, :2] * (1 - 1e-13)).all() and (half <= k * s[:, :2] * (1 + 1e-12) + 1e-12).all()
    table = 'x,y,a,b\n' + ''.join(f'{x!r},{y!r},{a!r},{b!r}\n' for (x, y), (a, b, _) in zip(points.tolist(), s.tolist()))
    text = dyadel.delaunay(dyadel.Text(table, 'x,y', sigma_column='a,b', confidence='95%'))
    for other in (dyadel.delaunay(points.tolist(), sigma=s[:, :2], confidence='95%'), text, pickle.loads(pickle.dumps(d)),
                  pickle.loads(pickle.dumps(text))):
        assert other.confidence == d.confidence and np.array_equal(other.pairs, d.pairs)
    assert dyadel.delaunay(points).confidence is None
    one = dyadel.delaunay(points, sigma=0.5, confidence=0.5)
    assert np.array_equal(one.pairs, dyadel.delaunay(points, sigma=np.full(40, 0.5), confidence=0.5).pairs)
    assert len(dyadel.plan(points, sigma=0.5, confidence=0.5)['i']) > 0
    globe = dyadel.delaunay(points / 50, sigma=s, confidence='95%', sphere=True, radius_unit='km')
    assert globe.confidence == d.confidence and np.array_equal(pickle.loads(pickle.dumps(globe)).pairs, globe.pairs)
    for wrong in ({'sigma': 1}, {'confidence': 0.5}, {'sigma': -1, 'confidence': 0.5}, {'sigma': 1, 'confidence': 0.5, 'radius': 1},
                  {'sigma': [1, 2], 'confidence': 0.5}, {'sigma': np.ones((40, 4)), 'confidence': 0.5},
                  {'sigma': [[1, 1, 2]] * 40, 'confidence': 0.5}):
        harness.raised(ValueError, dyadel.delaunay, points, **wrong)
    for wrong in (95, 1, 0, -0.5, 'x'):
        harness.raised(dyadel.Error, dyadel.delaunay, points, sigma=1, confidence=wrong)
    harness.raised(ValueError, dyadel.delaunay, dyadel.Text('0 0\n'), sigma=1, confidence=0.5)
    harness.raised(dyadel.Error, d.append, [(0, 0)], sigma=1, confidence=0.5)


def test_trials():
    """A plan tried on drawn points: the first trials are those of fewer, whatever the threads; exact points take none."""
    d = dyadel.delaunay(GPS)
    for discs in (False, True):
        made, plan = d.simulate(30, seed=7, discs=discs), d.plan(discs=discs)
        assert list(made) == ['rounds', 'points', 'measurements', 'pairs_left'] and not made['pairs_left'].any()
        assert (made['points'] >= len(plan['i'])).all() and (made['measurements'] >= made['points']).all() and (made['rounds'] > 0).all()
        assert (made['measurements'][made['rounds'] == 1] == len(plan['i'])).all()
        for other in (d, dyadel.delaunay(GPS, threads=3)):
            assert other.simulate(12, seed=7, discs=discs).rows == made.rows[:12]
        assert d.simulate(30, discs=discs).rows != made.rows
    assert d.plan(discs=True).undecided < d.plan().undecided == dyadel.plan(GPS).undecided
    assert not any(dyadel.delaunay(SQUARE[:3]).simulate(2)['rounds'])
    harness.raised(ValueError, d.simulate, 0)
    harness.raised(TypeError, dyadel.Trials, 1)


def test_boxes_and_rects():
    points = [('sqrt(2)', '1/3'), (0.5, (1, 2)), (Fraction(1, 10), 7)]
    d = dyadel.delaunay(points)
    for i, (row, text) in enumerate(zip(d.boxes, d.rects())):
        for k, (outward, word, end) in enumerate(zip(row, text.split(), d.rect(i))):
            mantissa, _, exponent = word.partition('*2^')
            assert end == Fraction(mantissa) * Fraction(2)**int(exponent or 0)
            assert (outward >= end if k % 2 else outward <= end) and abs(Fraction(outward) - end) <= Fraction(1, 2**48)
    assert d.rect(2)[:2] == (Fraction(1, 10),) * 2
    assert d.bounds.area >= 0 and d.bounds.hausdorff >= 0
    assert d.counters['stages'] >= 1 and d.counters['spent'] is None


def test_budgets_and_goals():
    roots = [(f'sqrt({k})', f'cbrt({k * k})') for k in range(2, 20)]
    d = dyadel.delaunay(roots, until='hausdorff:100')
    assert d.outcome == 'certified' and d.bounds.hausdorff <= Fraction(1, 2**100)
    assert d.refine(until='area:150').outcome == 'certified' and d.bounds.area <= Fraction(1, 2**150)
    d = dyadel.delaunay([('sqrt(8)', 0), ('2*sqrt(2)', 0), (0, 5)], ties=False, max_bits=100)
    assert d.outcome == 'budget' and d.counters['spent'] == 'bits'
    assert d.refine(ties=True, max_bits=400).aliases.tolist() == [[1, 0]]
    assert dyadel.delaunay(RANDOM.random((200000, 2)), timeout=0.001).outcome == 'budget'
    for until in ('', 'decided:3', 'area', 'near:5', 'area:x'):
        harness.raised(ValueError, dyadel.delaunay, SQUARE, until=until)
    harness.raised(ValueError, dyadel.delaunay, SQUARE, schedule='no')
    for bits in (-1, 0):
        harness.raised(ValueError, dyadel.delaunay, SQUARE, max_bits=bits)
        harness.raised(ValueError, dyadel.check, SQUARE, max_bits=bits)
        harness.raised(ValueError, dyadel.check, SQUARE, schedules=bits)
    harness.raised(TypeError, dyadel.delaunay, SQUARE, wrong=1)


def test_append():
    points = RANDOM.random((300, 2))
    d = dyadel.delaunay(points[:100])
    assert d.append(points[100:200]) is d
    d.append([tuple(p) for p in points[200:]])
    assert np.array_equal(d.pairs, dyadel.delaunay(points).pairs) and len(d.simplices) == len(dyadel.delaunay(points).simplices)
    before = d.pairs
    harness.raised(ValueError, d.append, [(1, 2, 3)])
    assert np.array_equal(d.pairs, before)


def test_remeasure():
    d = dyadel.delaunay([(0, 0), (3, 0), (3, 2.75), (0, 2.7), (1, (2.6, 2.8))])
    assert d.outcome == 'fixpoint'
    assert d.remeasure(4, (1, 1, 2.709, 2.711)).outcome == 'decided' and d.rect(4)[3] == Fraction(2.711)
    error = harness.raised(dyadel.Error, d.remeasure, 4, (5, 5))
    assert error.code == 'contradiction' and error.point == 4 and d.outcome == 'decided'


def test_pickling():
    made = [dyadel.delaunay(RANDOM.random((500, 2)), radius=0.01), dyadel.delaunay(SQUARE), dyadel.delaunay(AIRPORTS),
            dyadel.delaunay([(f'sqrt({k})', k * k) for k in range(2, 12)]).append(RANDOM.random((5, 2))),
            dyadel.delaunay([('sqrt(8)', 0), ('2*sqrt(2)', 0), (0, 5), (1, 1)]),
            dyadel.delaunay(dyadel.Source(6, source)), dyadel.Delaunay(),
            dyadel.delaunay(RANDOM.random((20, 2)), radius=0.2).remeasure(3, (0, 1, 0, 1))]
    for d in made:
        for other in (pickle.loads(pickle.dumps(d)), copy.deepcopy(d)):
            assert len(other) == len(d) and other.outcome == d.outcome
            if d.outcome == 'none':
                continue
            assert np.array_equal(other.pairs, d.pairs) and np.array_equal(other.aliases, d.aliases)
            for i in range(len(d)):
                (a, b, e, f), (p, q, r, s) = d.rect(i), other.rect(i)
                assert a <= p <= q <= b and e <= r <= s <= f
            assert other.refine().outcome == d.outcome
    harness.raised((pickle.PicklingError, AttributeError), pickle.dumps, dyadel.delaunay(dyadel.Source(1, lambda i, bits: (0, 0))))


def source(i, bits):
    return i, i, Fraction(i * i) - Fraction(1, 2**bits), Fraction(i * i) + Fraction(1, 2**bits)


def test_formats():
    d = dyadel.delaunay(GPS)
    for name, about, binary in dyadel.formats():
        if name == 'pgf':  # holds curves of convergence only
            assert 'pgf cannot hold this' in str(harness.raised(dyadel.Error, d.write, name))
            continue
        text = d.write(name)
        assert isinstance(text, bytes if binary else str) and len(text) > 100 and about
    lines = d.write().splitlines()
    assert lines[0] == 'i,j,status,id_i,id_j' and len(lines) == len(d.pairs) + 1
    assert d.write(layer='points').startswith('i,id,xlo')
    assert 'EPSG' in d.write('geojson', epsg=32632)
    error = harness.raised(ValueError, d.write, 'xls')
    assert 'xls' in str(error)
    assert harness.raised(dyadel.Error, d.write, 'obj', 'points').code == 'argument'


def test_geometries():
    d = dyadel.delaunay(RANDOM.random((30, 2)), radius=0.02)
    features = d.__geo_interface__['features']
    assert [(f['properties']['i'], f['properties']['j']) for f in features] == [tuple(p) for p in d.pairs[:, :2].tolist()]
    middle = (d.boxes[:, 0::2] + d.boxes[:, 1::2]) / 2
    for wkb, (i, j, _) in zip(d.to_wkb(), d.pairs.tolist()):
        assert struct.unpack('<BII', wkb[:9]) == (1, 2, 2)
        assert np.allclose(struct.unpack('<4d', wkb[9:]), [*middle[i], *middle[j]], rtol=0, atol=1e-15)
    for wkb, t in zip(d.to_wkb('triangles'), d.simplices.tolist()):
        assert struct.unpack('<BIII', wkb[:13]) == (1, 3, 1, 4) and len(wkb) == 13 + 64
        assert np.allclose(np.reshape(struct.unpack('<8d', wkb[13:]), (4, 2)), middle[t + t[:1]], atol=1e-15)
    assert [struct.unpack('<BIdd', w)[:2] for w in d.to_wkb('points')] == [(1, 1)] * 30
    harness.raised(ValueError, d.to_wkb, 'lines')
    try:
        import geopandas
    except ImportError:
        print('geopandas is not installed: not tried')
        return
    frame = geopandas.GeoDataFrame.from_features(d)
    assert len(frame) == len(d.pairs) and set(frame.status) <= {'legal', 'indeterminate'}
    assert all(geopandas.GeoSeries.from_wkb(d.to_wkb()).geom_equals_exact(frame.geometry, 1e-9))
    assert d.to_geodataframe().drop(columns=['geometry', 'max_coordinate_error']).equals(
        frame[['i', 'j', 'status']].astype({'i': 'int64', 'j': 'int64'}))
    assert len(d.to_geodataframe('triangles')) == len(d.simplices) and len(d.to_geodataframe('graph:mst')) >= 29
    assert d.to_geodataframe(crs='EPSG:2056').crs.to_epsg() == 2056
    v = dyadel.delaunay(GPS).voronoi()
    for layer in ('cells', 'tiles', 'vertices', 'edges', 'regions'):
        ours = v.to_geodataframe(layer, crs='EPSG:2056')
        theirs = geopandas.GeoDataFrame.from_features(json.loads(v.write('geojson', layer))['features'])
        assert ours.crs.to_epsg() == 2056 and len(ours) == len(theirs) > 0 and all(ours.geometry.is_valid), layer
        assert all(ours.geometry.geom_equals_exact(theirs.geometry.set_crs('EPSG:2056'), 1e-9)), layer
        assert set(ours.columns) >= set(theirs.columns) - {'undetermined', 'certain_area', 'xlo', 'xhi', 'ylo', 'yhi'}, layer
        for name in set(ours.columns) & set(theirs.columns) - {'geometry', 'max_coordinate_error'}:
            assert all(a == b or math.isclose(a, b, rel_tol=1e-9) for a, b in zip(ours[name], theirs[name])), (layer, name)
        assert layer not in ('cells', 'tiles') or {'i', 'id', 'area_lo', 'area_hi'} <= set(ours.columns)


def test_save():
    """Files by their ending hold what write() returns; whole, or not at all."""
    d = dyadel.delaunay(RANDOM_FILES.random((30, 2)), radius=0.01)
    v, before = d.voronoi(), os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            for of in (d, v, dyadel.delaunay([(0, 0), (9, 9), (20, 3)], sphere=True)):
                for name in ('a.csv', 'a.json', 'a.svg'):
                    of.save(name)
                    assert pathlib.Path(name).read_text(encoding='utf-8') == of.write(name[2:])
            d.save('a.csv.gz', layer='points')
            assert gzip.decompress(pathlib.Path('a.csv.gz').read_bytes()).decode() == d.write('csv', layer='points')
            d.plan().save(pathlib.Path('plan.csv'))
            with open('plan.csv', encoding='utf-8') as file:
                assert [int(row['i']) for row in csv.DictReader(file)] == d.plan()['i'].tolist()
            run = dyadel.converge([('sqrt(2)', 0), (0, 1), (1, 1)])
            run.save('run.svg')
            assert pathlib.Path('run.svg').read_text(encoding='utf-8') == run.svg
            names = sorted(os.listdir())
            assert '.csv' in str(harness.raised(ValueError, run.save, 'a.pdf')) and '.csv' in str(harness.raised(ValueError, d.plan().save, 'a.svg'))
            assert '.xyz' in str(harness.raised(ValueError, d.save, 'a.xyz')) and 'save' in str(harness.raised(ValueError, d.write, 'a.svg'))
            harness.raised(dyadel.Error, v.save, 'a.obj')
            harness.raised(FileNotFoundError, d.save, 'no/such.csv')
            assert sorted(os.listdir()) == names
            if importlib.util.find_spec('geopandas'):
                import geopandas
                v.save('cells.gpkg', layer='cells', crs='EPSG:2056')
                read = geopandas.read_file('cells.gpkg')
                assert read.crs.to_epsg() == 2056 and len(read) == len(v.certain) + len(v.possible)
            if importlib.util.find_spec('matplotlib'):
                draw_all(d, v)
        finally:
            os.chdir(before)
    for wrong in (d.plot, v.plot):
        harness.raised(ValueError, wrong, 'hull')


def draw_all(d, v):
    import matplotlib
    matplotlib.use('Agg')
    ax = d.plot()
    assert len(ax.collections[0].get_segments()) == len(d.pairs) and d.plot('triangles', ax=ax) is ax
    assert len(v.plot().collections) == 2 and len(v.plot('tiles', values=np.arange(30)).collections[0].get_paths()) == 30
    exact = dyadel.delaunay(d.points)
    assert len(exact.plot('tolerance').collections[0].get_segments()) == len(exact.legal)
    ax.figure.savefig('plot.png')


def test_notebooks():
    d = dyadel.delaunay(SQUARE)
    assert d._repr_svg_().startswith('<?xml') or d._repr_svg_().startswith('<svg')
    assert '<svg' in d._repr_html_() or 'srcdoc' in d._repr_html_()
    assert repr(d) == '<dyadel.Delaunay: 4 points, fixpoint: 4 legal, 0 indeterminate, 2 ties>'
    assert dyadel.delaunay(RANDOM.random((30000, 2)))._repr_svg_() is None
    assert '<svg' in d.voronoi()._repr_html_() or 'srcdoc' in d.voronoi()._repr_html_()


def test_voronoi_of_discs():
    """Cells of discs are those that the command writes; a certain cell is larger, a possible one smaller than for squares."""
    d = dyadel.delaunay([(0, 0), (10, 0), (5, 8), (14, 9)], radius=1)
    discs, squares = d.voronoi(window=(-5, 19, -5, 14), discs=True), d.voronoi(window=(-5, 19, -5, 14))
    assert (discs.areas[:, 0] > squares.areas[:, 0]).all() and (discs.areas[:, 1] < squares.areas[:, 1]).all()
    assert discs.area < squares.area and discs.data['discs'] and 'int' not in discs.data['cells'][0]
    rows = [line.split(',') for line in discs.write('csv').splitlines()[1:]]
    assert [(float(r[5]), float(r[6])) for r in rows] == [tuple(a) for a in discs.areas.tolist()]
    assert dyadel.verify(discs.certificate()).report['diagram']
    error = harness.raised(dyadel.Error, dyadel.delaunay(np.array([(0.0, 1, 0, 3), (5, 6, 5, 6)])).voronoi, discs=True)
    assert 'one radius' in str(error)


def test_voronoi():
    points = RANDOM.random((12, 2))
    d = dyadel.delaunay(points, radius=1e-4)
    v = d.voronoi(window=(0, 1, 0, 1))
    assert v.window == (0, 1, 0, 1) and len(v) == 12 and 0 < v.area < Fraction(1, 20) and v.hausdorff > 0
    for i, cell in enumerate(v):
        for corner in cell.inner:
            assert np.argmin(np.hypot(*(points - corner).T)) == i
        assert cell.area[0] <= cell.area[1] and cell.outer
    assert sum(c.area[0] for c in v) <= 1 <= sum(c.area[1] for c in v)
    assert json.loads(v.write('json'))['cells'] and v.__geo_interface__['features'] and 'kind' in v.write('wkt')
    assert 'Voronoi: 12 cells' in repr(v) and len(v.vertices) and len(v.edges)
    harness.raised(IndexError, lambda: v[12])
    ring = dyadel.delaunay([(f'cos({k}*pi/6)', f'sin({k}*pi/6)') for k in range(12)], ties=False, max_bits=300)
    assert ring.voronoi(until='hausdorff:20').hausdorff <= Fraction(1, 2**20), 'certified at a tie'
    assert dyadel.delaunay([(0, 0), (2, 0), (0, 0), (1, 3)]).voronoi()[2].area[0] > 0, 'an alias has the cell of its point'


def cut(ring, a, b, c):
    """The part of a convex ring with a x + b y <= c, in fractions."""
    out = []
    for (x, y), (u, v) in zip(ring, ring[1:] + ring[:1]):
        here, there = a * x + b * y - c, a * u + b * v - c
        if here <= 0:
            out.append((x, y))
        if here * there < 0:
            out.append((x + (u - x) * here / (here - there), y + (v - y) * here / (here - there)))
    return out


def area_of(ring):
    return sum(x * v - u * y for (x, y), (u, v) in zip(ring, ring[1:] + ring[:1])) / 2


def fractions_of(ring):
    return [(Fraction(x), Fraction(y)) for x, y in ring.tolist()]


def literal_cells(points, window):
    xlo, xhi, ylo, yhi = window
    for x, y in points:
        ring = [(xlo, ylo), (xhi, ylo), (xhi, yhi), (xlo, yhi)]
        for u, v in points:
            if (u, v) != (x, y):
                ring = cut(ring, 2 * (u - x), 2 * (v - y), u * u + v * v - x * x - y * y)
        yield ring


def test_cells_of_exact_points():
    """All cells against half-planes cut in fractions: random sets, a lattice of ties, points on a line, and one alone."""
    window = tuple(map(Fraction, (-1, 2, -2, 2)))
    lattice = np.array([(x, y) for x in range(3) for y in range(3)]) / 4
    for points in (RANDOM.random((25, 2)), lattice, np.array([(k / 4, k / 8) for k in range(5)]), np.zeros((1, 2)),
                   np.array([(0.5, 0.5), (0, 0), (0.5, 0.5), (40, 40)])):
        v = dyadel.delaunay(points).voronoi(window=window)
        exact = [(Fraction(x), Fraction(y)) for x, y in points.tolist()]
        assert v.certain is v.possible and v.area == 0 and v.window == window and len(v.areas) == len(v) == len(points)
        for i, ring in enumerate(literal_cells(exact, window)):
            area = area_of(ring) if ring else 0
            assert v.exact_area(i) == area, (i, v.exact_area(i), area)
            low, high = map(Fraction, v.areas[i].tolist())
            assert low <= area <= high <= low + Fraction(1, 2**40) and v[i].area == (float(low), float(high))
            found, near = fractions_of(v[i].inner), v.certain.rounding.max(initial=0)
            assert all(any(max(abs(x - p), abs(y - q)) <= near for p, q in found) for x, y in ring) or area == 0
        assert sum(area_of(fractions_of(tile)) for tile in map(v.tiles.__getitem__, range(len(v.tiles)))) == 12
        assert v.tiles.points.tolist() == sorted(set(v.tiles.points.tolist()))
    assert len(v.tiles) == 2, 'the alias and the far point have none'


def test_cells_of_rectangles():
    """Rings against the polygons that the command writes exactly; what cannot be a double, too."""
    for points, radius in ((RANDOM.random((60, 2)), 0.02), ([('1/3', '1/7'), ('sqrt(2)', 1), ((1, 2), ('1/3', 2)), (0, 5)], None),
                           ([(1e-300, 0), (0, 1), ((0.5, 1), (0.25, 0.5))], None), (np.zeros((0, 2)), None)):
        v = dyadel.delaunay(points, radius=radius).voronoi(window=(-1, 3, '-1', 6) if len(points) else (0, 1, 0, 1))
        of = {'certain': v.certain, 'possible': v.possible}
        assert v.data['bounds']['undetermined_area'] is not None and len(v.areas) == len(points)
        told = {kind: [] for kind in of}
        for row in v.data['cells']:
            (low, high), (below, above) = v.areas[row['i']].tolist(), map(float, row['area'])  # decimals, rounded again
            assert below <= low <= math.nextafter(below, math.inf) and math.nextafter(above, -math.inf) <= high <= above
            told['certain'] += [(row['i'], row['inner'])] if row['inner'] else []
            told['possible'] += [(row['i'], ring) for ring in row['outer']]
        for kind, rings in of.items():
            assert [i for i, _ in told[kind]] == rings.points.tolist()
            for r, (_, ring) in enumerate(told[kind]):
                assert len(ring) == len(rings[r])
                for (x, y), (u, w) in zip(ring, fractions_of(rings[r])):
                    near = max(abs(number(x) - u), abs(number(y) - w))
                    assert near <= Fraction(float(rings.rounding[r])) <= Fraction(1, 2**45), (kind, r)
        assert sum(cell.area[0] for cell in v) <= 28 and all(v.exact_area(i) is None for i in range(len(v)))


def number(text):
    mantissa, _, exponent = text.partition('*2^')
    return Fraction(mantissa) * Fraction(2) ** int(exponent or 0)


def test_well_known_binary():
    v = dyadel.delaunay(RANDOM.random((30, 2)), radius=0.01).voronoi()
    for rings in (v.certain, v.possible, v.tiles, v.tiles.select(v.tiles.points < 0)):
        for r, record in enumerate(rings.to_wkb()):
            count = len(rings[r]) + 1
            assert struct.unpack('<BIII', record[:13]) == (1, 3, 1, count) and len(record) == 13 + 16 * count
            closed = np.frombuffer(record[13:], '<f8').reshape(-1, 2)
            assert np.array_equal(closed[:-1], rings[r]) and np.array_equal(closed[-1], closed[0])
        assert len(rings.to_wkb()) == len(rings) and rings.closed()[0][-1] == len(rings.closed()[1])
    assert 'polygons' in repr(rings) and len(rings) == 0
    harness.raised(IndexError, lambda: v.tiles[len(v.tiles)])


def test_frame():
    """Vertices, edges and regions as arrays against what json and csv state."""
    random = np.random.default_rng(harness.seeded('frame').randrange(2**32))
    grid = np.array([(x, y) for x in range(4) for y in range(4)], float)
    sets = ((random.random((40, 2)), None), (random.random((40, 2)), 0.02), (grid, None), (np.vstack((grid, [[1.5, 1.4]])), None),
            (np.array([[0, 0], [1, 1], [2, 2.0]]), None), (random.random((30, 2)), 0.1), (grid[:1], None), (grid[[0, 5, 5, 7]], None))
    rays = ties = regions = 0
    for points, radius in sets:
        d = dyadel.delaunay(points, radius)
        v = d.voronoi(window=(-1, 4, -1, 4))
        boxes = np.array([[*row['x'], *row['y']] for row in v.data['vertices']]).reshape(-1, 4)
        assert boxes.shape == v.vertices.boxes.shape and np.allclose(boxes, v.vertices.boxes, rtol=1e-15, atol=1e-300)
        assert [(e['i'], e['j']) for e in v.data['edges']] == list(map(tuple, v.edges.pairs.tolist())) == list(map(tuple, d.legal.tolist()))
        way = iter(v.edges.directions.tolist())
        for e, ends in zip(v.data['edges'], v.edges.ends.tolist()):
            for told, end in zip((e['from'], e['to']), ends):
                if isinstance(told, dict):
                    assert end == dyadel.RAY and np.allclose([*told['ray']['x'], *told['ray']['y']], next(way), rtol=1e-15)
                else:
                    assert end == (dyadel.OPEN if told is None else told)
        assert next(way, None) is None and len(v.edges.rays) == len(v.edges.directions)
        for k, t in enumerate(v.vertices.corners.tolist()):
            assert t == v.vertices[k].tolist() or len(v.vertices[k]) > 3
        lines = [line.split(',') for line in v.write(layer='regions').splitlines()[1:]]
        assert [[int(row[0]), row[5]] for row in lines] == [[f, ' '.join(map(str, v.regions[k]))] for k, f in enumerate(v.regions.faces.tolist())]
        assert np.allclose(np.array([row[1:5] for row in lines], float).reshape(-1, 4), v.regions.boxes, rtol=1e-15)
        for wkb, known, line in zip(v.edges.to_wkb(), v.edges.drawn, v.edges.coordinates):
            count = struct.unpack('<BII', wkb[:9])[2]
            assert count == 2 * known and (not known or np.array_equal(np.frombuffer(wkb[9:], '<f8'), line.ravel()))
        assert [struct.unpack('<BI', w[:5])[1] for w in v.vertices.to_wkb() + v.regions.to_wkb()] == [1] * len(v.vertices) + [3] * len(v.regions)
        rays, ties, regions = rays + len(v.edges.rays), ties + (np.diff(v.vertices.offsets) > 3).sum(), regions + len(v.regions)
        assert 'edges' in repr(v.edges) and 'regions' in repr(v.regions)
    assert rays and ties and regions
    harness.raised(IndexError, lambda: v.vertices[len(v.vertices)])
    harness.raised(ValueError, v.to_geodataframe, 'faces') if importlib.util.find_spec('geopandas') else None


def test_diagram_stays():
    """Facts found later belong to the triangulation of which the diagram was made, or is refused."""
    d = dyadel.delaunay([(0, 0), (1, 0), (0, 1)])
    v = d.voronoi()
    before = v.certain.coordinates.copy(), v.areas.copy(), v.window
    d.append([(1, 1)])
    assert np.array_equal(v.certain.coordinates, before[0]) and np.array_equal(v.areas, before[1]) and v.window == before[2]
    for late in (lambda: v.tiles, lambda: v.data, lambda: v.edges, lambda: v.exact_area(0)):
        assert 'call voronoi() again' in str(harness.raised(RuntimeError, late))
    assert len(d.voronoi().tiles) == 4
    harness.raised(IndexError, d.voronoi().exact_area, 4)
    error = harness.raised(ValueError, lambda: dyadel.delaunay([(0, 0)]).voronoi(window=(0, 0, 0, 1)))
    assert 'window must be' in str(error) and 'xlo < xhi' in str(error)


def turn(a, b, c):
    return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])


def hull_of(points):
    """Counter-clockwise, by one after the other: a side has all others on its left, or between its ends."""
    points, ring = sorted(set(points)), []
    for part in (points, points[::-1]):
        kept = []
        for p in part:
            while len(kept) > 1 and turn(kept[-2], kept[-1], p) <= 0:
                kept.pop()
            kept.append(p)
        ring += kept[:-1] or kept
    return ring


def holds(ring, z):
    ring = list(dict.fromkeys(ring))
    if len(ring) == 2:
        (a, b), (c, d) = min(ring), max(ring)
        return turn(ring[0], ring[1], z) == 0 and a <= z[0] <= c and min(b, d) <= z[1] <= max(b, d)
    return ring == [z] if len(ring) == 1 else all(turn(a, b, z) >= 0 for a, b in zip(ring, ring[1:] + ring[:1]))


def corners_of(box):
    a, b, c, d = map(Fraction, box.tolist())
    return {(x, y) for x in (a, b) for y in (c, d)}


def literal_triangle(d, boxes, z):
    """By all choices of corners, which have the extreme orientations."""
    best = None
    for k, t in enumerate(d.simplices.tolist()):
        sides = [[turn(p, q, z) for p in boxes[i] for q in boxes[j]] for i, j in zip(t, t[1:] + t[:1])]
        if all(min(side) > 0 or side == [0] for side in sides) and (best is None or t < best[0]):
            best = t, k
    if best:
        return best[1]
    return dyadel.UNDECIDED if holds(hull_of([c for box in boxes for c in box]), z) else dyadel.OUTSIDE


def test_find_triangle():
    """All places of a grid and all corners against literal statements: ties, lines, rectangles that overlap, one point."""
    random = np.random.default_rng(harness.seeded('places').randrange(2**32))
    grid = np.stack(np.meshgrid(np.arange(-4, 21) / 4, np.arange(-4, 21) / 4), axis=-1).reshape(-1, 2)
    seen = set()
    for k in range(18):
        points = random.integers(0, 5, (int(random.integers(1, 12)), 2)) * (1 if k % 4 else 1 / 3)
        if k % 6 == 5:
            points[:, 1] = points[:, 0] / 2
        radius = None if k % 3 == 0 else random.choice([0, 0.125, 0.5, 1], len(points), p=[0.4, 0.3, 0.2, 0.1])
        d = dyadel.delaunay(points, radius=radius)
        boxes = [corners_of(box) for box in d.boxes]
        places = np.concatenate((grid, points, random.random((20, 2)) * 5))
        found = d.find_triangle(places)
        for z, t in zip(places.tolist(), found.tolist()):
            assert t == literal_triangle(d, boxes, tuple(map(Fraction, z))), (k, z, t)
        seen |= set(np.sign(found).tolist()) | set(found[found < 0].tolist())
        assert np.array_equal(d.find_triangle(places.reshape(1, -1, 2)), found[None]) and d.find_triangle(places[0]) == found[0]
        for scale in (2.0**1000, 2.0**-1000):
            scaled = dyadel.delaunay(points * scale, radius=None if radius is None else radius * scale)
            same = scaled.find_triangle(places * scale)
            assert np.array_equal(same < 0, found < 0) and np.array_equal(same[same < 0], found[found < 0]), (k, scale)
            assert np.array_equal(scaled.simplices[same[same >= 0]], d.simplices[found[found >= 0]]), (k, scale)
    assert seen >= {dyadel.OUTSIDE, dyadel.UNDECIDED, 1}
    thirds = dyadel.delaunay([('1/3', 0), ('7/3', '1/3'), (1, '7/3')])
    assert thirds.find_triangle([[1, 1], [0.3, 0], [9, 9]]).tolist() == [0, dyadel.OUTSIDE, dyadel.OUTSIDE]


def test_places():
    d = dyadel.delaunay([(0, 0), (1, 0), (0, 1)])
    for wrong in (np.zeros(3), 7, [[1, 2, 3]]):
        assert '(M, 2)' in str(harness.raised(ValueError, d.find_triangle, wrong))
    assert 'place 1' in str(harness.raised(ValueError, d.find_triangle, [[0, 0], [np.nan, 0]]))
    assert 'rounded' in str(harness.raised(ValueError, d.find_triangle, [[2**53 + 1, 0]]))
    assert 'rounded' in str(harness.raised(ValueError, d.nearest, np.array([[Fraction(1, 3), 0]])))
    harness.raised(TypeError, d.find_triangle, [['x', 'y']])
    harness.raised(TypeError, d.nearest, [[0, 0]], timeout=3)
    assert d.find_triangle(np.zeros((0, 2))).shape == (0,) and d.nearest(np.zeros((0, 2))).offsets.tolist() == [0]
    assert '3 points' in str(harness.raised(ValueError, d.interpolate, [1, 2], [[0, 0]]))
    z = d.interpolate([[1, 2], [3, 4], [5, 8]], [[0.25, 0.5], [2, 2]])
    assert z.tolist() == [[3.5, 5.5], [None, None]] and np.isnan(z.data[1]).all() and z.mask.tolist() == [[False] * 2, [True] * 2]
    assert d.interpolate([1j, 2, 3], [0, 1]) == 3
    harness.raised(RuntimeError, dyadel.Delaunay().find_triangle, [[0, 0]])


def test_nearest_of_places():
    """As the nearest points of each place alone, and by distances of boxes in fractions."""
    points, radius = RANDOM.integers(0, 6, (15, 2)), RANDOM.choice([0, 0.25, 1], 15)
    d = dyadel.delaunay(points, radius=radius)
    places = RANDOM.integers(-4, 28, (200, 2)) / 4
    boxes, alias = [list(map(Fraction, box)) for box in d.boxes.tolist()], dict(d.aliases[:, ::1].tolist())
    found = d.nearest(places)
    for k, z in enumerate(places.tolist()):
        near = [sum(max(b[2 * a] - Fraction(z[a]), Fraction(z[a]) - b[2 * a + 1], 0)**2 for a in (0, 1)) for b in boxes]
        far = [sum(max(b[2 * a + 1] - Fraction(z[a]), Fraction(z[a]) - b[2 * a])**2 for a in (0, 1)) for b in boxes]
        wanted = [i for i in range(15) if near[i] <= min(far) and i not in alias]
        assert found.points[found.offsets[k]:found.offsets[k + 1]].tolist() == wanted
        assert found.certain[k] == (len(wanted) == 1) and found.single[k] == (wanted[0] if len(wanted) == 1 else -1)
    assert 0 < found.certain.sum() < 200


def test_hull_in_order():
    d = dyadel.delaunay(np.array([(0, 0), (2, 0), (1, 0), (2, 2), (0, 2), (1, 1), (0, 1)]))
    assert [part.tolist() for part in d.hull] == [[0, 1, 3, 4], [0, 2, 1, 3, 4, 6]]
    for points, ends in ((np.zeros((0, 2)), []), ([(1, 1)], [0]), ([(0, 0), (3, 1)], [0, 1]), ([(0, 0), (1, 1), (2, 2)], [0, 2])):
        assert dyadel.delaunay(points).hull[0].tolist() == ends
    for _ in range(20):
        d = dyadel.delaunay(RANDOM.random((30, 2)), radius=RANDOM.choice([0, 0.001, 0.05], 30))
        ring = [tuple(map(Fraction, d.points[i].tolist())) for i in d.hull[0]]
        turned, first = hull_of(ring), hull_of(ring).index(ring[0])
        assert ring == turned[first:] + turned[:first]
        assert set(d.hull[0].tolist()) <= set(d.hull[1].tolist())


def test_vertex_neighbors():
    for d in (dyadel.delaunay(SQUARE), dyadel.delaunay(RANDOM.random((40, 2)), radius=0.01), dyadel.delaunay([(0, 0), (0, 0)])):
        indptr, indices = d.vertex_neighbors
        for k in range(len(d)):
            assert indices[indptr[k]:indptr[k + 1]].tolist() == [j for j in range(len(d)) if d.status(k, j) == 'legal' and
                                                                 k not in d.aliases[:, 0] and j not in d.aliases[:, 0]]
        assert len(indptr) == len(d) + 1 and d.points.shape == (len(d), 2)


def test_nearest():
    points = RANDOM.random((500, 2))
    d = dyadel.delaunay(points)
    for at in RANDOM.random((50, 2)):
        found = d.nearest(*at)
        distance = np.hypot(*(points - at).T)
        assert found.certain and found.points.tolist() == [distance.argmin()] and found.outcome == 'decided'
        assert found.lo[0] <= distance.min() <= found.hi[0] <= found.lo[0] * (1 + 1e-13)
    tied = dyadel.delaunay(SQUARE).nearest('1/2', '1/2')
    assert tied.points.tolist() == [0, 1, 2, 3] and not tied.certain and tied.tied and tied.outcome == 'fixpoint'
    assert all(lo <= math.sqrt(0.5) <= hi for lo, hi in zip(tied.lo, tied.hi))
    d = dyadel.delaunay([('sqrt(2)', 0), ('sqrt(2)+1e-60', 1), (9, 9)])
    near = d.nearest('sqrt(2)', '1/2')
    assert near.outcome == 'decided' and not near.tied
    assert dyadel.delaunay([('sqrt(2)', 0), ('sqrt(2)', 1), (9, 9)]).nearest('sqrt(2)', '1/2').tied


def test_tolerance():
    points = RANDOM.random((40, 2))
    t = dyadel.tolerance(points, radii=True)
    assert set(t['event']) == {'death'} and (t['lo'] <= t['hi']).all() and 0 < t.lo <= t.hi and len(t.radii) == 40
    moved = points + RANDOM.uniform(-1, 1, (40, 2)) * t.lo / 1.5
    assert np.array_equal(dyadel.delaunay(moved).legal, dyadel.delaunay(points).legal)
    assert len(dyadel.tolerance(points, up_to='0.01')['i']) >= len(t['i'])
    assert harness.raised(dyadel.Error, dyadel.tolerance, [((0, 1), 0), (2, 2)]).point == 0
    box = dyadel.tolerance(points, radii=True, metric='box')
    assert (box['hi'] <= box['lo'] * (1 + 2**-20)).all() and (t['lo'] <= box['hi'] * 1.4143).all() and (box['lo'] <= t['hi']).all()
    moved = points + RANDOM.choice([-1, 1], (40, 2)) * box.lo * (1 - 1e-9)
    assert 0 < box.lo < t.hi and np.array_equal(dyadel.delaunay(moved).legal, dyadel.delaunay(points).legal)
    assert (dyadel.delaunay(points).tolerance(metric='box')['lo'] == box['lo']).all() and (box.radii <= t.radii * 1.0001).all()
    harness.raised(ValueError, dyadel.tolerance, points, metric='max')
    assert t.rows[0]['i'] == t['i'][0] and '<table>' in t._repr_html_() and 'event' in repr(t)


def test_plan():
    d = dyadel.delaunay(GPS)
    plan = d.plan()
    assert plan.left == 0 and (np.asarray(plan['half_width_needed']) < plan['half_width_now']).all() and plan['pairs_decided'].sum() > 0
    for row in plan.rows:
        low, high, bottom, top = (float(end) for end in d.rect(row['i']))
        x, y, r = (low + high) / 2, (bottom + top) / 2, row['half_width_needed'] * 0.999
        d.remeasure(row['i'], (x - r, x + r, y - r, y + r))
    assert d.outcome == 'decided', 'what the plan says is enough'
    assert len(dyadel.plan(RANDOM.random((20, 2)), 0.05, accuracy='1/1000', site=3)['i']) <= 20


def test_converge():
    points = [(f'sqrt({k})', f'sqrt({k * k + 1})') for k in range(2, 14)]
    m = dyadel.converge(points, modulus=(2, 12))
    assert m['m'].tolist() == list(range(2, 13)) and (np.diff(m['stage']) >= 0).all() and (np.diff(m['apriori_bits']) >= 0).all()
    assert (m['bound'] <= 2.0 ** -m['m'] * 1.00001).all() and m.outcome == 'certified'
    for of, until in (('voronoi', 'hausdorff:3'), ('disc', 'area:3'), ('bisector', 'decided')):
        assert len(dyadel.converge(points, of=of, until=until, modulus=(0, 9))['m']) == 10
    few = dyadel.converge([(f'sqrt({k})', f'exp({k}/7)') for k in (2, 3, 5, 7)], start_bits=1, step_bits=1, hindsight=10**5)
    assert few['ratio'][-1] >= 1
    c = dyadel.converge(points, times=False, step_bits=4)
    assert c.outcome == 'decided' and c['stage'].tolist() == list(range(1, len(c['stage']) + 1))
    assert (np.diff(c['indeterminate']) <= 0).all() and (np.diff(c['hausdorff']) <= 0).all() and '<svg' in c._repr_svg_()
    assert c.csv == dyadel.converge(points, times=False, step_bits=4).csv and len(c.rows) == len(c['stage'])
    assert np.isnan(dyadel.converge(points)['v_area']).all()
    assert not np.isnan(dyadel.converge(points, of='voronoi')['v_area']).any()
    assert dyadel.converge([(0, 0), (1, 0), (0, 1)], until='hausdorff:3').outcome in ('decided', 'certified')


def test_certificates():
    points = [(f'sqrt({k})', f'cbrt({k})') for k in range(2, 12)]
    d = dyadel.delaunay(points)
    verdict = dyadel.verify(d.certificate())
    assert verdict.proved and verdict.outcome == 'decided' and verdict.report['legal'] == len(d.legal)
    assert dyadel.verify(d.certificate(), points).report['bound']
    assert dyadel.verify(d.voronoi(window=(0, 4, 0, 3)).certificate()).report['diagram']
    of_discs = dyadel.verify(d.voronoi(window=(0, 4, 0, 3), discs=True).certificate())
    assert of_discs.proved and of_discs.report['diagram']
    text = d.certificate()
    error = harness.raised(dyadel.Error, dyadel.verify, text[:len(text) // 2])
    assert error.code == 'parse' and error.line
    harness.raised(dyadel.Error, dyadel.verify, b'')
    harness.raised(dyadel.Error, dyadel.verify, text, [(5, 5)] * 10)


harness.run_all(globals())
