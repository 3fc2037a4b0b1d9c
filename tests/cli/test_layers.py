#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Layers: what csv, wkt and geojson hold, against json; as Shapefile and GeoPackage, and in geopandas, where installed.

Usage: test_layers.py COMMAND DATA
"""
import csv
import glob
import importlib.util
import json
import os
import re
import shutil
import subprocess
import tempfile
from fractions import Fraction

from harness import DATA, expect, main, run

# Rectangles, exact points, ties (four corners of a square), an alias, a fraction.
POINTS = '0 0\n2 0\n2 2\n0 2\n[5,6] [0,1]\n[5,6] [3,4]\n9 2\n0 0\n99/7 -3\n[-4,-3] [-2,2]\n'
LAYERS = {'delaunay': {'pairs': 'LineString', 'points': 'Point', 'triangles': 'Polygon'},
          'voronoi': {'cells': 'Polygon', 'vertices': 'Point', 'regions': 'Polygon', 'edges': 'LineString'}}
COLUMNS = {'pairs': 'i,j,status', 'points': 'i,xlo,xhi,ylo,yhi,legal,indeterminate,tie,hull', 'triangles': 'i,j,k',
           'cells': 'i,xlo,xhi,ylo,yhi,area_lo,area_hi,undetermined', 'vertices': 'i,j,k,xlo,xhi,ylo,yhi',
           'regions': 'face,xlo,xhi,ylo,yhi,sites', 'edges': 'i,j,left,right'}
ALL = [(command, layer) for command, layers in LAYERS.items() for layer in layers]


def written(command, *options, points=POINTS):
    result = run(command, '--quiet', *options, '-', stdin=points)
    expect(result, 3)
    return result.out


def table(text):
    lines = [line for line in text.splitlines() if not line.startswith('#')]
    return list(csv.DictReader(lines))


def answer(command):
    return json.loads(written(command, '--format', 'json'))


def number(text):
    if '*2^' in text:
        man, exp = text.split('*2^')
        return Fraction(int(man)) * Fraction(2) ** int(exp)
    return Fraction(text)


def inside(row, site):
    """The box of the row holds the exact rectangle, and is hardly larger."""
    for axis in 'xy':
        low, high = (number(site[axis][k]) for k in (0, 1))
        assert Fraction(row[axis + 'lo']) <= low <= high <= Fraction(row[axis + 'hi']), (row, site)
        assert Fraction(row[axis + 'hi']) - Fraction(row[axis + 'lo']) <= high - low + Fraction(1, 2**40), (row, site)


def test_columns():
    for command, layer in ALL:
        text = written(command, '--layer', layer)
        head = next(line for line in text.splitlines() if not line.startswith('#'))
        assert head == COLUMNS[layer], (layer, head)
        if command == 'voronoi':
            assert re.search(r'^# window .*\n# undetermined_area,.*\n# distance_to_true_diagram,', text, re.M), layer
        assert '# alias 7 0\n' in text, layer
        wkt = written(command, '--layer', layer, '--format', 'wkt').splitlines()[0]
        own = 'kind,' if layer == 'cells' else ''
        assert wkt == f'WKT,{own}{COLUMNS[layer]},max_coordinate_error', wkt
    assert written('delaunay') == written('delaunay', '--layer', 'pairs')
    assert written('voronoi') == written('voronoi', '--layer', 'cells')


def hull(data, i):
    if i in data['hull']['sure_vertices']:
        return 'certain'
    return 'possible' if i in data['hull']['possible_vertices'] else 'no'


def test_points():
    data = answer('delaunay')
    rows = table(written('delaunay', '--layer', 'points'))
    alias = dict(data['aliases'])
    assert [int(r['i']) for r in rows] == list(range(10)) and alias == {7: 0}
    for i, row in enumerate(rows):
        of = alias.get(i, i)
        inside(row, data['sites'][i])
        for status in ('legal', 'indeterminate', 'tie'):
            count = sum(of in (p['i'], p['j']) and p['status'] == status for p in data['pairs'])
            assert int(row[status]) == count == data['sites'][i][status], (i, status)
        assert row['hull'] == hull(data, of) == data['sites'][i]['hull'], i
    assert {r['hull'] for r in rows} == {'certain', 'possible', 'no'} and any(r['tie'] != '0' for r in rows)


def test_triangles():
    rows = table(written('delaunay', '--layer', 'triangles'))
    assert [[int(r[k]) for k in 'ijk'] for r in rows] == answer('delaunay')['triangles'] and rows


def test_vertices_and_regions():
    data = answer('voronoi')
    rows = table(written('voronoi', '--layer', 'vertices'))
    assert [[int(r[k]) for k in 'ijk'] for r in rows] == [v['sites'][:3] for v in data['vertices']] and rows
    for row, vertex in zip(rows, data['vertices']):
        for axis in 'xy':
            assert [float(row[axis + end]) for end in ('lo', 'hi')] == vertex[axis], row
    rows = table(written('voronoi', '--layer', 'regions'))
    seen = [(face, r) for face, r in enumerate(data['regions']) if r['x']]
    assert [(int(r['face']), [int(t) for t in r['sites'].split(' ')]) for r in rows] == [
        (face, r['sites']) for face, r in seen] and rows
    for row, (_, region) in zip(rows, seen):
        assert [float(row[axis + end]) for axis in 'xy' for end in ('lo', 'hi')] == region['x'] + region['y'], row


def test_cells():
    data = answer('voronoi')
    cells = {c['i']: c for c in data['cells']}
    window = [number(t) for k in 'xy' for t in data['window'][k]]
    rows = table(written('voronoi'))
    assert [int(r['i']) for r in rows] == sorted(cells) and len(rows) == 9
    for row in rows:
        cell = cells[int(row['i'])]
        assert [float(row['area_lo']), float(row['area_hi'])] == cell['area']
        assert [float(row[axis + end]) for axis in 'xy' for end in ('lo', 'hi')] == cell['x'] + cell['y']
        share = 1 - Fraction(row['area_lo']) / Fraction(row['area_hi'])
        assert abs(Fraction(row['undetermined']) - share) < Fraction(1, 10**15), row
        assert float(row['undetermined']) == cell['undetermined']
        for polygon in cell['outer']:
            for x, y in polygon:
                for axis, at, low, high in (('x', number(x), *window[:2]), ('y', number(y), *window[2:])):
                    assert Fraction(row[axis + 'lo']) <= min(max(at, low), high) <= Fraction(row[axis + 'hi']), row


def end_of(data, edge, end):
    """What csv says of an end, from json."""
    if isinstance(edge[end], int):
        sites = data['vertices'][edge[end]]['sites']
        others = [k for k in sites if k not in (edge['i'], edge['j'])] if len(sites) == 3 else sites[:3]
        return ' '.join(map(str, others))
    return 'ray' if edge[end] else 'open'


def test_edges():
    data = answer('voronoi')
    rows = table(written('voronoi', '--layer', 'edges'))
    assert [[r['i'], r['j'], r['left'], r['right']] for r in rows] == [
        [str(e['i']), str(e['j']), end_of(data, e, 'from'), end_of(data, e, 'to')] for e in data['edges']]
    kinds = {r[k] if r[k] in ('ray', 'open') else 'vertex' for r in rows for k in ('left', 'right')}
    assert kinds == {'ray', 'open', 'vertex'}, kinds
    drawn = json.loads(written('voronoi', '--layer', 'edges', '--format', 'geojson'))['features']
    shown = {(f['properties']['i'], f['properties']['j']): f['geometry']['coordinates'] for f in drawn}
    for edge in data['edges']:
        whole = all(edge[end] is not None for end in ('from', 'to')) and any(
            isinstance(edge[end], int) for end in ('from', 'to'))
        assert whole == ((edge['i'], edge['j']) in shown), edge
        for k, end in enumerate(('from', 'to')):
            if not whole or isinstance(edge[end], int):
                continue  # a ray: it goes where its direction says, at least half of the window far
            line = shown[(edge['i'], edge['j'])]
            far = [line[k][a] - line[1 - k][a] for a in (0, 1)]
            middle = [sum(edge[end]['ray'][axis]) for axis in 'xy']
            assert far[0] * middle[0] + far[1] * middle[1] > 0 and max(map(abs, far)) > 10, (edge, line)


def test_places_are_as_near_as_said():
    """Each point or vertex lies within max_coordinate_error of every place that it represents."""
    for command, layer in (('delaunay', 'points'), ('voronoi', 'vertices')):
        for row in table(written(command, '--layer', layer, '--format', 'wkt')):
            place = re.fullmatch(r'POINT \((\S+) (\S+)\)', row['WKT']).groups()
            for axis, at in zip('xy', place):
                for end in ('lo', 'hi'):
                    far = abs(Fraction(at) - Fraction(row[axis + end]))
                    assert far <= Fraction(row['max_coordinate_error']) + Fraction(1, 10**12), row


def test_geojson_is_plain():
    """One kind of geometry in a file; properties are numbers and texts; no reference system unless one was named."""
    for command, layer in ALL:
        for crs in ((), ('--crs', 'EPSG:32632')):
            data = json.loads(written(command, '--layer', layer, '--format', 'geojson', *crs))
            assert {f['geometry']['type'] for f in data['features']} == {LAYERS[command][layer]}, layer
            for feature in data['features']:
                assert all(isinstance(v, (int, float, str)) for v in feature['properties'].values()), feature
                assert feature['properties']['max_coordinate_error'] <= data['max_coordinate_error']
            name = data['crs']['properties']['name']
            assert name == 'urn:ogc:def:crs:EPSG::32632' if crs else name.startswith('ENGCRS["Undefined'), name
    assert json.loads(written('delaunay', '--format', 'json', '--crs', 'epsg:25832'))['crs'] == 'EPSG:25832'
    assert json.loads(written('voronoi', '--format', 'json', '--crs', 'EPSG:25832'))['crs'] == 'EPSG:25832'


def test_vtk_holds_all():
    text = written('delaunay', '--format', 'vtk')
    data = answer('delaunay')
    numbers = text.split('POINT_DATA 10\n')[1].split('\n')
    for name in ('legal', 'indeterminate', 'tie'):
        at = numbers.index(f'SCALARS {name} int 1') + 2
        assert [int(t) for t in numbers[at:at + 10]] == [s[name] for s in data['sites']]
    at = numbers.index('SCALARS hull int 1') + 2
    assert [('no', 'possible', 'certain')[int(t)] for t in numbers[at:at + 10]] == [s['hull'] for s in data['sites']]
    text = written('voronoi', '--format', 'vtk').split('\n')
    kinds = text[text.index('SCALARS kind int 1') + 2:]
    data = answer('voronoi')
    drawn = json.loads(written('voronoi', '--layer', 'edges', '--format', 'geojson'))['features']
    assert [kinds.count(k) for k in '234'] == [
        len(data['vertices']), sum(r['x'] is not None for r in data['regions']), len(drawn)]


def test_refusals():
    expect(run('delaunay', '--layer', 'cells', '-', stdin=POINTS), 2, r'\A\Z',
           'delaunay has no layer "cells"; give pairs, points, triangles, graph:nearest, graph:gabriel, graph:mst, aliases, hulls, exterior, ties$')
    for form in ('json', 'vtk', 'obj', 'svg'):
        expect(run('delaunay', '--layer', 'points', '--format', form, '-', stdin=POINTS), 2, r'\A\Z',
               'delaunay --layer points does not write ' + form + '; give csv, wkt, geojson, html$')
    expect(run('nearest', '--layer', 'points', '-', '0', '0', stdin=POINTS), 2, r'\A\Z', 'nearest does not take --layer')


def test_no_points():
    for command, layer in ALL:
        for form in ('csv', 'wkt', 'geojson'):
            for points in ('', '1 1\n', '0 0\n1 0\n'):
                expect(run(command, '--quiet', '--layer', layer, '--format', form, '-', stdin=points), 0, '.', r'\A\Z')


def test_beyond_doubles():
    far = '2^100000 0\n0 0\n1 1\n5 -3\n'
    expect(run('delaunay', '--layer', 'points', '-', stdin=far), 0, r'^0,1.79[0-9e+]*,,0,0,')
    expect(run('delaunay', '--layer', 'points', '--format', 'wkt', '-', stdin=far), 1, r'\A\Z',
           'point 0.* beyond the largest double')


def test_airports():
    """Real data: every airport in its place, and sums that agree."""
    result = run('delaunay', '--quiet', '--columns', 'longitude,latitude', '--radius', '0.01', '--layer', 'points',
                 os.path.join(DATA, 'airports.csv'))
    rows = table(result.out)
    assert len(rows) == 3376
    assert [sum(int(r[k]) for r in rows) for k in ('legal', 'indeterminate', 'tie')] == [2 * 8925, 2 * 2490, 0]
    hulls = [r['hull'] for r in rows]
    assert hulls.count('certain') >= 3 and hulls.count('no') > 3300


# ---- other programs ----

def convert(folder, form, source, name):
    target = os.path.join(folder, name)
    done = subprocess.run(['ogr2ogr', '-f', form, target, source, '-nln', 'layer'], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0 and 'ERROR' not in done.stderr, done.stderr
    info = subprocess.run(['ogrinfo', '-so', '-al', target], capture_output=True, text=True, check=True).stdout
    return info


def test_ogr():
    if not shutil.which('ogr2ogr'):
        print('skipped: ogr2ogr is not installed')
        return
    for command, layer in ALL:
        for form in ('geojson', 'wkt'):
            with tempfile.TemporaryDirectory() as folder:
                source = os.path.join(folder, 'x.' + form)
                expect(run(command, '--quiet', '--layer', layer, '--format', form, '-o', source, '-', stdin=POINTS), 3)
                with open(source, encoding='ascii') as f:
                    text = f.read()
                count = text.count('"Feature"') if form == 'geojson' else len(text.splitlines()) - 1
                for kind, name in (('ESRI Shapefile', 'x.shp'), ('GPKG', 'x.gpkg')):
                    info = convert(folder, kind, source if form == 'geojson' else 'CSV:' + source, name)
                    assert f'Feature Count: {count}\n' in info and count, (layer, form, info)
                    assert 'WGS' not in info, (layer, form, info)
                if form == 'geojson':
                    with_crs = os.path.join(folder, 'y.geojson')
                    run(command, '--quiet', '--layer', layer, '--crs', 'EPSG:25832', '-o', with_crs, '--format', form, '-',
                        stdin=POINTS)
                    assert 'ETRS89 / UTM zone 32N' in convert(folder, 'GPKG', with_crs, 'y.gpkg')


def test_geopandas():
    if not importlib.util.find_spec('geopandas'):
        print('skipped: geopandas is not installed')
        return
    import geopandas  # pylint: disable=import-outside-toplevel
    for command, layer in ALL:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'x.geojson')
            expect(run(command, '--quiet', '--layer', layer, '--format', 'geojson', '-o', path, '-', stdin=POINTS), 3)
            frame = geopandas.read_file(path)
            assert set(frame.geom_type) == {LAYERS[command][layer]}, layer
            own = ['kind'] if layer == 'cells' else []
            assert list(frame.columns) == own + COLUMNS[layer].split(',') + ['max_coordinate_error', 'geometry']
            assert frame.crs is None or (frame.crs.to_epsg() is None and not frame.crs.is_geographic), frame.crs
            run(command, '--quiet', '--layer', layer, '--format', 'geojson', '--crs', 'EPSG:4326', '-o', path, '-',
                stdin=POINTS)
            assert geopandas.read_file(path).crs.to_epsg() == 4326
            assert not glob.glob(path + '.*')


main(globals())
