#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points as users have them: masked arrays, DataFrames, geometries, boxes of either order; names, rows, wrong keywords."""
import copy
import importlib.util
import pickle
from fractions import Fraction

import harness
import numpy as np

import dyadel

RANDOM = harness.seeded('inputs')
PLACES = [(8.5, 47.1), (8.6, 47.2), (8.4, 47.15), (8.45, 47.3)]
LEGAL = dyadel.delaunay(PLACES).legal.tolist()


def there(*names):
    return all(importlib.util.find_spec(name) for name in names)


def words_in(error, *words):
    assert all(word in str(error) for word in words), str(error)


def test_masked():
    m = np.ma.masked_values(np.array([[1, 2], [3, 4], [-9999, -9999], [5, 1.]]), -9999)
    error = harness.raised(dyadel.Error, dyadel.delaunay, m)
    words_in(error, 'row 2', 'masked', 'skip_missing')
    assert error.point == 2
    d = dyadel.delaunay(m, skip_missing=True)
    assert len(d) == 3 and d.rows.tolist() == [0, 1, 3] and d.legal.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert d.write('csv').splitlines()[1:] == ['0,1,legal', '0,3,legal', '1,3,legal']
    assert [cell.area == d.voronoi()[k].area for k, cell in enumerate(d.voronoi())] == [True] * 3
    assert dyadel.delaunay(np.ma.masked_array(PLACES)).legal.tolist() == LEGAL, 'no mask is set'
    radii = np.ma.masked_less(np.array([1e-3, -1, 1e-3, 1e-3]), 0)
    words_in(harness.raised(dyadel.Error, dyadel.delaunay, np.array(PLACES), radii), 'row 1', 'radius')
    d = dyadel.delaunay(np.array(PLACES), radii, skip_missing=True)
    assert d.rows.tolist() == [0, 2, 3] and d.rect(1)[0] < Fraction(8.4) < d.rect(1)[1]
    whole = np.ma.masked_array(np.array([[0, 0], [2**60 + 1, 1], [5, 5]]), mask=[[0, 0], [0, 0], [0, 1]])
    assert dyadel.delaunay(whole, skip_missing=True).rect(1)[0] == 2**60 + 1


def test_one_dimension():
    """Arrays of objects and Series of pairs are lists of pairs; x and y apart, or complex numbers, are refused with a remedy."""
    pairs = np.empty(len(PLACES), object)
    pairs[:] = PLACES
    assert dyadel.delaunay(pairs).legal.tolist() == LEGAL
    words_in(harness.raised(ValueError, dyadel.delaunay, np.array([0., 1, 2])), '(3,)', 'numpy.column_stack((x, y))')
    words_in(harness.raised(ValueError, dyadel.delaunay, np.array([0, 1j, 2])), '(3,)', 'z.real, z.imag')
    words_in(harness.raised(ValueError, dyadel.delaunay, np.zeros((2, 2, 2))), '(2, 2, 2)')
    if there('pandas'):
        import pandas
        assert dyadel.delaunay(pandas.Series(PLACES)).legal.tolist() == LEGAL
        words_in(harness.raised(ValueError, dyadel.delaunay, pandas.Series([0., 1])), 'numpy.column_stack((x, y))')


def test_missing_rows():
    xy = np.array([*PLACES, (np.nan, 1), (2, np.nan), (np.nan, np.nan), (np.nan, 0)])
    error = harness.raised(dyadel.Error, dyadel.delaunay, xy)
    words_in(error, 'rows 4, 5, 6 and 1 more')
    assert error.point == 4
    assert dyadel.delaunay(xy, skip_missing=True).legal.tolist() == LEGAL
    mixed = [(0, 0), ('NA', 1), None, ('sqrt(2)', 1), (float('nan'), 1), (3, None), (1, 5)]
    assert dyadel.delaunay(mixed, skip_missing=True).rows.tolist() == [0, 3, 6]
    harness.raised(TypeError, dyadel.delaunay, [(0, 0), (3, None)])
    words_in(harness.raised(ValueError, dyadel.delaunay, [(0, 0), (np.inf, 1)], skip_missing=True), 'element 1', 'inf')
    for d in (dyadel.delaunay(np.array([(0, 0), (np.nan, 1)]), skip_missing=True, ids=['a', 'b']),):
        d.append([(1, 0), None, (0, 1)], skip_missing=True, ids=['c', 'd', 'e'])
        assert d.rows.tolist() == [0, 2, 4] and d.ids == ['a', 'c', 'e']
        d.append([(5, 5)])
        assert d.rows.tolist() == [0, 2, 4, 5] and d.ids == ['a', 'c', 'e', '']
        again = pickle.loads(pickle.dumps(d))
        assert again.rows.tolist() == [0, 2, 4, 5] and again.ids == d.ids and again.pairs.tolist() == d.pairs.tolist()
    assert dyadel.delaunay(np.full((3, 2), np.nan), skip_missing=True).outcome == 'decided'


def test_boxes():
    boxes = np.array([[x, y, x, y] for x, y in PLACES])
    words_in(harness.raised(ValueError, dyadel.delaunay, boxes), "order='xyxy'", "order='xxyy'")
    assert dyadel.delaunay(boxes, order='xyxy').legal.tolist() == LEGAL
    assert not len(dyadel.delaunay(boxes, order='xxyy').legal)
    swiss = np.array([[2600000 + k, 1200000 + k * k, 2600001 + k, 1200001 + k * k] for k in range(9)], float)
    words_in(harness.raised(ValueError, dyadel.delaunay, swiss), 'order')
    assert dyadel.delaunay(swiss[:, [0, 2, 1, 3]]).pairs.tolist() == dyadel.delaunay(swiss, order='xyxy').pairs.tolist()
    error = harness.raised(dyadel.Error, dyadel.delaunay, np.array([[0, 1, 0, 1], [3, 2, 1, 6.]]))
    assert error.point == 1, 'inverted either way'
    for _ in range(200):  # boxes as they should be, of any size and place, the diagonal included
        n, size = RANDOM.randint(2, 9), 10.0**RANDOM.randint(-3, -1)
        x, y = (np.array([RANDOM.uniform(-3, 3) for _ in range(n)]) for _ in 'xy')
        y = x if RANDOM.random() < 0.3 else y
        if sum(abs(x[i] - x[j]) <= 2 * size for i in range(n) for j in range(i)) * 4 < n * (n - 1):
            assert len(dyadel.delaunay(np.column_stack((x - size, x + size, y - size, y + size)))) == n
    words_in(harness.raised(ValueError, dyadel.delaunay, boxes, order='yxyx'), 'xxyy', 'xyxy')
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, order='xyxy'), 'boxes')


def test_overlap():
    """The share of pairs that overlap, against each pair."""
    from dyadel import _inputs
    for _ in range(100):
        pairs = sorted((RANDOM.randint(0, 9), RANDOM.randint(0, 5)) for _ in range(RANDOM.randint(2, 7)))
        low, high = np.array([a for a, _ in pairs], float), np.array([a + b for a, b in pairs], float)
        meet = sum(low[i] <= high[j] and low[j] <= high[i] for i in range(len(low)) for j in range(i))
        assert abs(_inputs._overlap(low, high) - meet / (len(low) * (len(low) - 1) / 2)) < 1e-12


def test_shapes():
    for shape, words in (((2, 1000), 'points.T'), ((7, 3), 'points[:, :2]'), ((7,), '(7,)'), ((7, 2, 2), '(7, 2, 2)'), ((), '()')):
        words_in(harness.raised(ValueError, dyadel.delaunay, np.zeros(shape)), words, '(N, 2) or (N, 4)')
    for radius in ([1.0, 2.0], np.zeros(3), np.zeros((4, 3)), np.zeros((2, 2, 2))):
        words_in(harness.raised(ValueError, dyadel.delaunay, np.array(PLACES), radius), 'radius')
    words_in(harness.raised(ValueError, dyadel.delaunay, ['x', 'y']), "element 0 of points: 'x'", 'pair')
    words_in(harness.raised(TypeError, dyadel.delaunay, [(0, 0), (0, 1j)]), 'element 1 of points', '1j')


def test_callbacks_are_named():
    def narrow(i, bits):
        return (i, float('nan') if i == 4321 else i * i)
    error = harness.raised(ValueError, dyadel.delaunay, dyadel.Source(5000, narrow))
    words_in(error, 'point 4321', 'bits', 'nan')
    assert error.point == 4321

    def fails(i, bits):
        raise KeyError('mine')
    error = harness.raised(KeyError, dyadel.delaunay, dyadel.Source(3, fails))
    assert error.args == ('mine',) and error.__notes__ == ['point 0, asked for 64 bits']
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, radius=['0.1', '0.1', 'x', '0.1']), 'element 2', "radius 'x'")
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, radius=[1, 2]), '4 values', 'not 2')
    for wrong in 5, {'x': [1, 2], 'y': [3, 4]}, '1 2':
        words_in(harness.raised(TypeError, dyadel.delaunay, wrong), type(wrong).__name__, 'give an array (N, 2)')
    d = dyadel.delaunay(PLACES)
    for window in (0, 1), (1, 0, 0, 1), 7:
        words_in(harness.raised(ValueError, d.voronoi, window), '(xlo, xhi, ylo, yhi)', repr(window))
    words_in(harness.raised(ValueError, d.voronoi, until='area'), "until='area'", 'area:M')
    words_in(harness.raised(TypeError, dyadel.delaunay, PLACES, threads='two'), "threads='two'", 'whole number')
    for function, name, wrong in ((dyadel.delaunay, 'until', 30), (dyadel.delaunay, 'until', None), (dyadel.converge, 'until', 30),
                                  (dyadel.converge, 'modulus', 20), (dyadel.converge, 'modulus', '4:20'),
                                  (dyadel.converge, 'hindsight', 'x'), (dyadel.delaunay, 'progress', 3), (dyadel.delaunay, 'trace', 3),
                                  (dyadel.delaunay, 'ids', 3), (dyadel.delaunay, 'carry', 1.5), (dyadel.delaunay, 'cost', 'x'),
                                  (dyadel.check, 'moves', 3), (dyadel.tolerance, 'sigma', [1])):
        words_in(harness.raised((TypeError, ValueError), function, PLACES, **{name: wrong}), f'{name}={wrong!r}; give ')
    for name, wrong in (('format', 3), ('layer', 3), ('epsg', '2056')):
        words_in(harness.raised(TypeError, d.write, **{name: wrong}), f'{name}={wrong!r}; give ')
    words_in(harness.raised(TypeError, dyadel.delaunay, dyadel.Text('0 0', radius=1)), 'radius=1; give a text')
    words_in(harness.raised(TypeError, dyadel.Source, print, 3), ', 3)', 'give the number of points, then the function')


def test_keywords():
    calls = [(dyadel.delaunay, PLACES), (dyadel.plan, PLACES), (dyadel.converge, PLACES), (dyadel.tolerance, PLACES),
             (dyadel.check, PLACES), (dyadel.Delaunay, PLACES)]
    for function, *arguments in calls:
        words_in(harness.raised(TypeError, function, *arguments, raduis=0.1), "'raduis'", "'radius'", function.__name__ + '()')
    words_in(harness.raised(TypeError, dyadel.check, PLACES, schedule=3), 'check()', "'schedules'")
    d = dyadel.delaunay(PLACES)
    for function, *arguments in ((d.refine,), (d.append, [(1, 1)]), (d.voronoi,), (d.nearest, 1, 1)):
        words_in(harness.raised(TypeError, function, *arguments, treads=2), "'treads'", "'threads'", f'{function.__name__}()')
    assert len(d) == 4
    for name in ('max_bits', 'threads', 'max_pairs', 'step_bits', 'max_calls'):
        words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, **{name: -1}), f'{name}=-1')
        words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, **{name: 2**70}), f'{name}={2**70}; give at most')
        words_in(harness.raised(TypeError, dyadel.delaunay, PLACES, **{name: 1.5}), f'{name}=1.5; give a whole number')
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, start_bits=-2**21), 'start_bits=', 'at least -1048576')
    for wrong in (-1, float('nan'), 'soon'):
        for function in (dyadel.delaunay, dyadel.converge, dyadel.check):
            words_in(harness.raised(ValueError, function, PLACES, timeout=wrong), f'timeout={wrong!r}; give seconds')
    harness.raised(ValueError, dyadel.delaunay, PLACES, max_bits=0)


def test_classes():
    d = dyadel.Delaunay(np.array(PLACES), radius=1e-6)
    assert d.outcome == 'decided' and d.pairs.tolist() == dyadel.delaunay(PLACES, radius='0.000001').pairs.tolist()
    assert dyadel.Delaunay().append(PLACES).legal.tolist() == LEGAL
    words_in(harness.raised(TypeError, dyadel.Voronoi, np.array(PLACES)), 'dyadel.delaunay(points).voronoi()')
    for result, call in (dyadel.Plan, 'plan'), (dyadel.Tolerance, 'tolerance'), (dyadel.Convergence, 'converge'):
        words_in(harness.raised(TypeError, result, np.array(PLACES)), f'dyadel.{call}(points)')
    assert harness.raised(ValueError, dyadel.Delaunay, [(0, 0), (1, 'x')]).result.outcome == 'none'


def test_ids():
    d = dyadel.delaunay(PLACES, ids=['a', 'b,c', 3, ''])
    assert d.ids == ['a', 'b,c', '3', ''] and d.write('csv').splitlines()[1] == '0,1,legal,a,"b,c"'
    assert dyadel.delaunay(PLACES).ids is None
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, ids=['a']), '1 ids for 4 points')
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, ids='name'), 'no such column')
    source = dyadel.Source(3, lambda i, bits: (i, i * i))
    assert dyadel.delaunay(source, ids=list('xyz')).ids == ['x', 'y', 'z']
    globe = dyadel.delaunay(np.array([*PLACES, (np.nan, 0)]), sphere=True, ids=list('abcde'), skip_missing=True)
    assert globe.ids == ['a', 'b', 'c', 'd'] and ',a,b' in globe.write('csv')
    assert copy.copy(globe).ids == globe.ids
    text = dyadel.Text('n,x,y\nA,0,0\nB,NA,1\nC,1,0\n', columns='x,y', id='n', skip_missing=True)
    d = dyadel.delaunay(text)
    assert d.ids == ['A', 'C'] and d.rows.tolist() == [0, 2]
    words_in(harness.raised(ValueError, dyadel.delaunay, text, skip_missing=True), 'Text')


def test_frames():
    if not there('pandas'):
        return
    import pandas
    df = pandas.DataFrame(PLACES, columns=['x', 'y'])
    for frame in (df, df.convert_dtypes(), df.astype(str), df.astype(object), df.astype('string'), df.set_index([[5, 5, 7, 1]]),
                  df.rename(columns={'x': 'lon', 'y': 'lat'})):
        assert dyadel.delaunay(frame).legal.tolist() == LEGAL, frame.dtypes
    for x, y in (('lat', 'lon'), ('stop_lat', 'stop_lon'), ('decimalLatitude', 'decimalLongitude'), ('Northing', 'Easting')):
        mirrored = df.rename(columns={'x': x, 'y': y})
        for globe in (True, False):
            words_in(harness.raised(ValueError, dyadel.delaunay, mirrored, sphere=globe), f"df[['{y}', '{x}']]")
        assert dyadel.delaunay(mirrored.to_numpy()).legal.tolist() == LEGAL
    assert dyadel.delaunay(df.astype(str)).rect(0)[2] == Fraction('47.1'), 'text is decimal'
    assert dyadel.delaunay(df.astype('float32')).rect(0)[2] == Fraction(float(np.float32(47.1)))
    missing = pandas.concat([df.convert_dtypes(), pandas.DataFrame({'x': [None, 1], 'y': [pandas.NA, 2]})], ignore_index=True)
    words_in(harness.raised(dyadel.Error, dyadel.delaunay, missing), 'row 4')
    for frame in (missing, missing.astype(object), missing.astype('string'), missing.convert_dtypes()):
        assert dyadel.delaunay(frame, skip_missing=True).rows.tolist() == [0, 1, 2, 3, 5], frame.dtypes
    text = df.astype(str)
    text.loc[2, 'y'] = 'N/A'
    words_in(harness.raised(dyadel.Error, dyadel.delaunay, text), 'row 2', 'skip_missing')
    text.loc[2, 'y'] = 'forty'
    words_in(harness.raised(dyadel.Error, dyadel.delaunay, text), 'element 2 of points')
    words_in(harness.raised(ValueError, dyadel.delaunay, df.assign(z=1)), 'x, y, z', "df[['x', 'y']]")
    words_in(harness.raised(ValueError, dyadel.delaunay, df.x), '(4,)')
    words_in(harness.raised(TypeError, dyadel.delaunay, df.assign(y=pandas.to_datetime('2020'))), "column 'y'")
    named = df.assign(acc=[1e-3, 2e-3, 3e-3, 4e-3], name=list('pqrs'))
    d = dyadel.delaunay(named[['x', 'y']], radius=named.acc, ids=named.name)
    assert d.ids == list('pqrs') and d.rect(3)[1] > Fraction('8.4539')
    for name, value in (('radius', named.acc), ('ids', named.name), ('carry', named[['acc']]), ('sigma', named.acc)):
        for other in (value.iloc[::-1], value.reset_index(drop=True).set_axis([1, 2, 3, 4])):
            words_in(harness.raised(ValueError, dyadel.delaunay, df, **{name: other}), f'{name}.reindex(points.index)', f'{name}.to_numpy()')
    assert dyadel.delaunay(df, radius=named.acc.iloc[::-1].to_numpy()).rect(0)[1] > Fraction('8.5039')
    for order in (['minx', 'miny', 'maxx', 'maxy'], ['minx', 'maxx', 'miny', 'maxy']):
        boxes = pandas.DataFrame({'minx': df.x, 'miny': df.y, 'maxx': df.x, 'maxy': df.y})[order]
        assert dyadel.delaunay(boxes).legal.tolist() == LEGAL
        assert dyadel.delaunay(boxes.astype(str)).legal.tolist() == LEGAL
    whole = pandas.DataFrame({'x': pandas.array([0, 2**60 + 1, 5], 'Int64'), 'y': [0, 1, 7]})
    assert dyadel.delaunay(whole).rect(1)[0] == 2**60 + 1


def test_geometries():
    if not there('shapely'):
        return
    import shapely.geometry as g
    points = [g.Point(*place) for place in PLACES]
    for given in (points, tuple(points), g.MultiPoint(points), [g.Point(x, y, 5) for x, y in PLACES]):
        assert dyadel.delaunay(given).legal.tolist() == LEGAL
    assert len(dyadel.delaunay(points[0])) == 1
    words_in(harness.raised(TypeError, dyadel.delaunay, [points[0], points[0].buffer(1)]), 'element 1', 'Polygon')
    words_in(harness.raised(dyadel.Error, dyadel.delaunay, [None, *points]), 'row 0')
    assert dyadel.delaunay([*points, g.Point(), None], skip_missing=True).legal.tolist() == LEGAL


def test_geopandas():
    if not there('geopandas', 'shapely', 'pandas'):
        return
    import geopandas
    import shapely.geometry as g
    points = [g.Point(*place) for place in PLACES]
    gdf = geopandas.GeoDataFrame({'name': list('abcd'), 'acc': [1e-6] * 4}, geometry=points, crs='EPSG:2056')
    d = dyadel.delaunay(gdf, radius='acc', ids='name')
    assert d.legal.tolist() == LEGAL and d.ids == list('abcd') and d.crs == gdf.crs and d.rect(0)[0] < d.rect(0)[1]
    frame = d.to_geodataframe('points')
    carried = dyadel.delaunay(gdf.assign(depth=[1.5, 2.5, 3.5, 4.5], of=list('wxyz')), ids='name' if 'name' in gdf else None, carry='depth')
    for table in (carried.to_geodataframe('points'), *(carried.voronoi().to_geodataframe(layer) for layer in ('cells', 'tiles'))):
        assert dict(zip(table.i, table.depth)) == {0: 1.5, 1: 2.5, 2: 3.5, 3: 4.5} and 'of' not in table
    assert harness.raised(ValueError, dyadel.delaunay, gdf, carry='nothing')
    assert frame.crs == gdf.crs and frame.id.tolist() == list('abcd') and d.to_geodataframe().geom_type[0] == 'LineString'
    assert '2056' in d.write('geojson') and '3857' in d.write('geojson', epsg=3857)
    assert dyadel.delaunay(gdf.geometry).crs == gdf.crs
    words_in(harness.raised(ValueError, d.append, gdf.to_crs(3857)), '3857', '2056', 'to_crs')
    assert len(d) == 4 and len(dyadel.delaunay(gdf).append(gdf.geometry).append([(1, 2)]).append([(3, 1)], crs=2056)) == 10
    words_in(harness.raised(ValueError, dyadel.delaunay, gdf, 'nothing'), "radius='nothing'", 'name, acc')
    for unit in '3 m', '0.5km', '1e-3in':
        words_in(harness.raised(ValueError, dyadel.delaunay, gdf, unit), unit, 'unit of the coordinates')
    for number in '1/8', '2^-3', '0x1p-3', '0.125', '125e-3':
        assert dyadel.delaunay(gdf, number).rect(0)[1] == Fraction(8.5) + Fraction(1, 8), number
    assert dyadel.delaunay(gdf.bounds).legal.tolist() == LEGAL
    words_in(harness.raised(ValueError, dyadel.delaunay, gdf.bounds.to_numpy()), "order='xyxy'")
    degrees = gdf.set_crs(4326, allow_override=True)
    words_in(harness.raised(ValueError, dyadel.delaunay, degrees), 'sphere=True', 'sphere=False')
    assert dyadel.delaunay(degrees, sphere=False).legal.tolist() == LEGAL
    assert dyadel.delaunay(degrees, sphere=True).to_geodataframe().crs == degrees.crs
    words_in(harness.raised(ValueError, dyadel.delaunay, gdf, sphere=True), 'not degrees', gdf.crs.name, 'to_crs(4326)')
    assert dyadel.delaunay(PLACES, crs=2056).crs == 2056
    words_in(harness.raised(ValueError, d.voronoi, window=(2, 2, 5, 9)), 'xlo < xhi', '(2, 2, 5, 9)')
    words_in(harness.raised(ValueError, dyadel.delaunay, PLACES, crs='EPSG:4326'), 'sphere=True')


harness.run_all(globals())
