#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files that GDAL reads and writes, against ogr2ogr, ogrinfo and geopandas; hostile files; messages without GDAL.

Usage: test_gdal.py COMMAND DATA GDAL (the word "yes" where there is a dyadel-gdal)
"""
import contextlib
import csv
import importlib.util
import io
import json
import os
import random
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile

from harness import COMMAND, cases, expect, main, run

HERE = len(sys.argv) > 3 and sys.argv[3] == 'yes' and shutil.which('ogr2ogr') and shutil.which('ogrinfo')
TABLE = 'name,acc,cost,x,y\nanna,0.5,1,0,0\n"b, ""c""",0.25,2,10,0.1\nÄ,0.125,3,3,7\nd,0.0625,1,9,11\ne,0.3,5,4.7,3.3\n'
READ = '--columns', 'x,y'


def ogr(*words, cwd=None):
    done = subprocess.run(words, capture_output=True, check=False, text=True, cwd=cwd)
    assert done.returncode == 0, (words, done.stderr)
    return done.stdout


class Folder(tempfile.TemporaryDirectory):
    """Holds the table, and points.FORM made of it."""

    def __enter__(self):
        self.path = super().__enter__()
        self.write('t.csv', TABLE)
        return self

    def at(self, name):
        return os.path.join(self.path, name)

    def write(self, name, text):
        with open(self.at(name), 'wb') as f:
            f.write(text if isinstance(text, bytes) else text.encode())

    def make(self, name, crs='EPSG:32632', *words):
        ogr('ogr2ogr', *(['-a_srs', crs] if crs else []), '-oo', 'X_POSSIBLE_NAMES=x', '-oo', 'Y_POSSIBLE_NAMES=y', '-oo',
            'AUTODETECT_TYPE=YES', *words, self.at(name), self.at('t.csv'))
        return self.at(name)

    def run(self, *args, **options):
        return run(*args, cwd=self.path, comments=False, **options)


def info(path):
    """Of each layer: geometry, number of features, EPSG code, fields with their types."""
    found = {}
    for block in ogr('ogrinfo', '-ro', '-so', '-al', path).split('Layer name: ')[1:]:
        lines = block.splitlines()
        value = {k: v for k, _, v in (line.partition(': ') for line in lines)}
        codes = [line.strip() for line in lines if 'ID["EPSG",' in line and line.startswith('    ID')]
        found[lines[0]] = (value['Geometry'], int(value['Feature Count']), codes[-1] if codes else '',
                           {k: v.split(' ')[0] for k, v in value.items() if v.endswith(')') and v.split(' ')[0] in
                            ('Integer64', 'Real', 'String', 'Integer')})
    return found


def exact(points):
    """The same as doubles: hexadecimal."""
    return ''.join(f'{float(x).hex()} {float(y).hex()}\n' for x, y in points)


def test_formats_in():
    """Statuses, identifiers and radii are those of the table, whatever file holds it."""
    with Folder() as f:
        rows = list(csv.DictReader(io.StringIO(TABLE)))
        f.write('hex.csv', 'name,acc,cost,x,y\n' + ''.join(
            '"{}",{},{},{},{}\n'.format(r['name'].replace('"', '""'), r['acc'], r['cost'], float(r['x']).hex(),
                                        float(r['y']).hex()) for r in rows))
        for name in 'p.gpkg', 'p.shp', 'p.fgb', 'p.geojson', 'p.sqlite', 'p.gml', 'p.tab':
            crs = 'EPSG:32632'
            path = f.make(name, crs, *(['-lco', 'SPATIAL_INDEX=NO'] if name.endswith('fgb') else []))
            for options in (), ('--id', 'name'), ('--radius-column', 'acc', '--id', 'name'), ('--cost-column', 'cost'):
                want = f.run('delaunay', *READ, *options, 'hex.csv')
                got = f.run('delaunay', *options, path)
                assert (got.code, got.out) == (want.code, want.out), (name, options, got, want)
        assert json.loads(f.run('delaunay', '--format', 'json', 'p.gpkg').out)['crs'] == 'EPSG:32632'
        assert 'EPSG::32632' in f.run('voronoi', '--format', 'geojson', 'p.shp').out
        expect(f.run('delaunay', '--crs', 'EPSG:25832', '--format', 'json', 'p.gpkg'), 2, '', 'is EPSG:32632; remove --crs')
        expect(f.run('delaunay', '--measured', 'p.gpkg'), 2, '', 'doubles, not decimals')
        expect(f.run('nearest', '--queries', 'p.gpkg', 'p.fgb'), 0, '^4,4,')
        expect(f.run('plan', '--radius-column', 'acc', 'p.gpkg'), 0, '^rank,i,')
        expect(f.run('delaunay', '--radius-column', 'nothing', 'p.gpkg'), 1, '', 'no column is called "nothing"')


def test_layers_in():
    with Folder() as f:
        f.make('p.gpkg', 'EPSG:32632', '-nln', 'one')
        expect(f.run('delaunay', 'p.gpkg'), 0)
        f.make('p.gpkg', 'EPSG:32632', '-nln', 'two', '-update')
        expect(f.run('delaunay', 'p.gpkg'), 1, r'\A\Z', r'several layers have points; name one: --in-layer NAME; it has one \(Point\), two')
        expect(f.run('delaunay', '--in-layer', 'two', 'p.gpkg'), 0, '^0,')
        expect(f.run('delaunay', '--in-layer', 'three', 'p.gpkg'), 1, '', 'no layer is called "three"; it has one')
        f.make('t.gpkg', None, '-nlt', 'NONE')
        expect(f.run('delaunay', '--in-layer', 't', 't.gpkg'), 2, '', 'has no geometry; name the columns of its coordinates')
        assert f.run('delaunay', *READ, 't.gpkg').out == f.run('delaunay', *READ, 't.csv').out
        expect(f.run('delaunay', '--in-layer', 'x', 't.csv'), 1, '', 'no layer is called "x"')


def test_other_geometries():
    """An error that says what to do, and of which feature."""
    shapes = {'Polygon': [[[0, 0], [1, 0], [0, 1], [0, 0]]], 'LineString': [[0, 0], [1, 1]], 'MultiPoint': [[0, 0], [1, 1]]}
    with Folder() as f:
        for kind, places in shapes.items():
            point = {'type': 'Feature', 'properties': {}, 'geometry': {'type': 'Point', 'coordinates': [3, 4]}}
            other = {'type': 'Feature', 'properties': {}, 'geometry': {'type': kind, 'coordinates': places}}
            f.write('mixed.geojson', json.dumps({'type': 'FeatureCollection', 'features': [point, other]}))
            expect(f.run('delaunay', '--plane', 'mixed.geojson'), 1, r'\A\Z', f'feature 1 is a {kind.upper()}, not a point; .*ogr2ogr')
            f.write('all.geojson', json.dumps({'type': 'FeatureCollection', 'features': [other]}))
            expect(f.run('delaunay', '--plane', 'all.geojson'), 1, r'\A\Z', 'ogr2ogr')
        f.write('single.geojson', json.dumps({'type': 'FeatureCollection', 'features': [
            {'type': 'Feature', 'properties': {}, 'geometry': {'type': 'MultiPoint', 'coordinates': [[k, k * k]]}} for k in range(3)]}))
        expect(f.run('delaunay', '--plane', 'single.geojson'), 0, '^0,1,legal')
        f.write('gap.geojson', json.dumps({'type': 'FeatureCollection', 'features': [
            {'type': 'Feature', 'properties': {}, 'geometry': {'type': 'Point', 'coordinates': [1, 1]}},
            {'type': 'Feature', 'properties': {}, 'geometry': None},
            {'type': 'Feature', 'properties': {}, 'geometry': {'type': 'Point', 'coordinates': [2, 5]}}]}))
        expect(f.run('delaunay', '--plane', 'gap.geojson'), 1, '', r'gap\.geojson: feature 1: the coordinate is empty; .*--skip-missing')
        expect(f.run('delaunay', '--plane', '--skip-missing', 'gap.geojson'), 0, '^0,2,legal')


def test_degrees():
    with Folder() as f:
        f.make('d.gpkg', 'EPSG:4326')
        expect(f.run('delaunay', 'd.gpkg'), 2, r'\A\Z', r'degrees \(WGS 84\); .*--sphere .*--plane')
        sphere = f.run('delaunay', '--sphere', 'd.gpkg')
        f.write('hex.txt', exact([(0, 0), (10, .1), (3, 7), (9, 11), (4.7, 3.3)]))
        assert sphere.out == f.run('delaunay', '--sphere', 'hex.txt').out and sphere.code == 0
        expect(f.run('delaunay', '--plane', 'd.gpkg'), 0)
        f.make('m.gpkg')
        expect(f.run('delaunay', '--sphere', 'm.gpkg'), 2, '', 'not degrees .*ogr2ogr -t_srs EPSG:4326')
        f.make('d.gpx', None, '-nlt', 'POINT', '-select', 'name')
        expect(f.run('delaunay', 'd.gpx'), 0, '^0,', 'longitude and latitude are taken as coordinates in a plane')
        assert f.run('delaunay', '--sphere', '--id', 'name', 'd.gpx').out == f.run('delaunay', '--sphere', '--id', 'name', 'd.gpkg').out
        f.make('d.kml', 'EPSG:4326')
        assert f.run('delaunay', '--sphere', 'd.kml').out == sphere.out


def geometry(text):
    return [float(t) for t in ''.join(c if c in '0123456789.-+e' else ' ' for c in text).split() if t[-1].isdigit()]


def test_formats_out():
    """What GDAL finds in the file is what csv and geojson say."""
    with Folder() as f:
        f.make('p.gpkg')
        for command in 'delaunay', 'voronoi', 'tolerance', 'plan':
            options = ('--radius-column', 'acc', '--radius-scale', '5') if command == 'plan' else ()
            want = [r['properties'] for r in json.loads(f.run(command, *options, '--format', 'geojson', 'p.gpkg').out)['features']]
            assert want, command
            for name in 'o.gpkg', 'o.fgb', 'o.geojsonl', 'o.sqlite', 'o.shp', 'o.gml', 'o.xlsx', 'o.ods':
                result = f.run(command, *options, '-o', name, 'p.gpkg')
                assert result.code in (0, 3) and not result.out, (name, result)
                layer = [] if name[2:] not in ('gpkg', 'sqlite', 'gml', 'xlsx', 'ods') else [list(info(f.at(name)))[0]]
                rows = json.loads(ogr('ogr2ogr', '-f', 'GeoJSON', '/vsistdout/', f.at(name), *layer))['features']
                assert len(rows) == len(want), (command, name, len(rows), len(want))
                values = [row['properties'] for row in rows]
                if name == 'o.fgb':  # in an order of its own
                    for list_ in values, want:
                        list_.sort(key=lambda v: [v.get(k) for k in ('rank', 'i', 'j', 'kind') if k in v])
                for got, one in zip(values, want):
                    assert name == 'o.shp' or len(set(one) & set(got)) >= len([v for v in one.values() if v is not None]), (command, name, got, one)
                    for a, b in zip(got.values(), one.values()) if name == 'o.shp' else [(got.get(k), one[k]) for k in one]:
                        assert a == b or isinstance(b, (int, float)) and abs(float(a) - b) <= 1e-9 * (1 + abs(b)), (name, got, one)
        assert not [n for n in os.listdir(f.path) if os.path.isdir(f.at(n))], 'a folder is left'


LAYERS = {'delaunay': ('pairs', 'points', 'triangles', 'graph_nearest', 'graph_gabriel', 'graph_mst', 'aliases', 'ties'),
          'voronoi': ('cells', 'tiles', 'vertices', 'regions', 'edges', 'aliases')}


def test_geopackage_holds_all():
    """Each layer with its features, attributes and reference system, as ogrinfo sees them."""
    with Folder() as f:
        f.make('p.gpkg')
        for command, layers in LAYERS.items():
            expect(f.run(command, '--id', 'name', '-o', 'all.gpkg', 'p.gpkg'), 0, '', r'\)$' if command == 'voronoi' else r'; not hulls, exterior, which are large: name one by --layer$')
            found = info(f.at('all.gpkg'))
            assert set(layers) == set(found), found
            for layer in layers:
                shape, count, code, fields = found[layer]
                name = layer.replace('_', ':')
                table = list(csv.DictReader(io.StringIO(f.run(command, '--id', 'name', '--layer', name, *READ, 't.csv').out)))
                assert layer == 'cells' or count == len(table), (layer, count, len(table))
                assert shape == 'None' or code == 'ID["EPSG",32632]]', (layer, found[layer])
                if table:
                    assert set(table[0]) <= set(fields), (layer, fields)
                    kinds = {'i': 'Integer64', 'status': 'String', 'id_i': 'String', 'xlo': 'Real', 'hull': 'String'}
                    assert all(fields[k] == v for k, v in kinds.items() if k in fields), (layer, fields)
            expect(f.run(command, '--layer', layers[1], '-o', 'one.gpkg', 'p.gpkg'), 0)
            assert list(info(f.at('one.gpkg'))) == ['one']


def test_carried_columns_keep_their_types():
    with Folder() as f:
        f.make('p.gpkg')
        expect(f.run('delaunay', '--carry', 'acc,cost,name', '--layer', 'points', '-o', 'c.gpkg', 'p.gpkg'), 0)
        fields = info(f.at('c.gpkg'))['c'][3]
        assert [fields[k] for k in ('acc', 'cost', 'name')] == ['Real', 'Integer', 'String'], fields
        rows = json.loads(ogr('ogr2ogr', '-f', 'GeoJSON', '/vsistdout/', f.at('c.gpkg')))['features']
        assert [r['properties']['acc'] for r in rows] == [0.5, 0.25, 0.125, 0.0625, 0.3]


def test_coordinates_are_within_their_error():
    """A double stands for a decimal: max_coordinate_error bounds what that loses, too; ends are rounded outward."""
    from fractions import Fraction as Q
    with Folder() as f:
        f.write('p.txt', '0.1 0.7\n[1/3,2/3] 5\n7 1.1\n3 9.3\n')
        want = list(csv.DictReader(io.StringIO(f.run('delaunay', '--layer', 'points', 'p.txt').out)))
        run('delaunay', '--layer', 'points', '-o', 'o.gpkg', 'p.txt', cwd=f.path)
        with contextlib.closing(sqlite3.connect(f.at('o.gpkg'))) as base:
            base.row_factory = sqlite3.Row
            rows = [dict(r) for r in base.execute('SELECT * FROM o ORDER BY fid')]
        true = [(Q(1, 10), Q(7, 10)), (Q(1, 2), Q(5)), (Q(7), Q(11, 10)), (Q(3), Q(93, 10))]
        for row, csv_row, place in zip(rows, want, true):
            for c, t in zip(struct.unpack('<dd', row['geom'][-16:]), place):
                assert abs(Q(c) - t) <= Q(row['max_coordinate_error']), (row, place)
            for k in 'xlo', 'ylo':
                assert Q(row[k]) <= Q(csv_row[k])
            for k in 'xhi', 'yhi':
                assert Q(row[k]) >= Q(csv_row[k])


def test_whole_or_not_at_all():
    with Folder() as f:
        f.make('p.gpkg')
        f.write('o.gpkg', b'old')
        expect(f.run('delaunay', '-o', 'no/where/o.gpkg', 'p.gpkg'), 1, '', 'cannot write: No such file')
        expect(f.run('delaunay', '-o', 'o.gpkg', '--format', 'csv', 'p.gpkg'), 2, '', 'says the format')
        expect(f.run('delaunay', '-o', 'o.gpkg.gz', 'p.gpkg'), 2, '', 'GDAL packs no such file')
        f.write('bad.txt', '0 0\n1 x\n')
        expect(f.run('delaunay', '-o', 'o.gpkg', 'bad.txt'), 1)
        with open(f.at('o.gpkg'), 'rb') as old:
            assert old.read() == b'old'
        expect(f.run('delaunay', '-o', 'p.gpkg', 'p.gpkg'), 2, '', 'is the input file')
        expect(f.run('delaunay', '-o', 'o.gpkg', 'p.gpkg'), 0)
        assert len(info(f.at('o.gpkg'))) == 8
        f.run('delaunay', '-o', 's.shp', 'p.gpkg')
        assert os.path.exists(f.at('s.prj'))
        f.run('delaunay', '-o', 's.shp', *READ, 't.csv')
        assert not os.path.exists(f.at('s.prj')) and os.path.exists(f.at('s.dbf')), 'the old reference system stays'
        assert not [n for n in os.listdir(f.path) if os.path.isdir(f.at(n))], os.listdir(f.path)


def test_geopandas():
    if not importlib.util.find_spec('geopandas'):
        return
    import geopandas
    with Folder() as f:
        f.make('p.gpkg')
        frame = geopandas.read_file(f.at('p.gpkg'))
        frame.to_file(f.at('q.gpkg'), driver='GPKG')
        assert f.run('delaunay', '--id', 'name', 'q.gpkg').out == f.run('delaunay', '--id', 'name', 'p.gpkg').out
        expect(f.run('voronoi', '--id', 'name', '-o', 'cells.gpkg', 'q.gpkg'), 0)
        cells = geopandas.read_file(f.at('cells.gpkg'), layer='cells')
        assert cells.crs.to_epsg() == 32632 and list(cells['id']) == list(frame['name']) and cells.geometry.is_valid.all()
        assert all(cell.intersects(point) for cell, point in zip(cells.geometry, frame.geometry))


def test_hostile_files():
    """Cut, flipped, empty: an error of ours or an answer, never a crash or a hang."""
    with Folder() as f:
        rand = random.Random(int(os.environ.get('DYADEL_TEST_SEED', '1')))
        names = 'p.gpkg', 'p.shp', 'p.fgb', 'p.geojson', 'p.gml', 'p.kml', 'p.tab'
        whole = {}
        for name in names:
            f.make(name, 'EPSG:4326')
            with open(f.at(name), 'rb') as file:
                whole[name] = file.read()
        for _ in range(cases(56)):
            name = rand.choice(names)
            text = bytearray(whole[name])
            if rand.random() < 0.3:
                text = text[:rand.randrange(1, len(text))]
            else:
                for _ in range(rand.randint(1, 40)):
                    text[rand.randrange(len(text))] = rand.choice((0, 255, rand.randrange(256)))
            bad = 'x' + name[1:]
            f.write(bad, bytes(text))
            result = subprocess.run([COMMAND, 'delaunay', '--plane', bad, '--timeout', '60'], cwd=f.path, capture_output=True,
                                    timeout=100, check=False)
            assert result.returncode in (0, 1, 2, 3, 4), (name, result)
            assert result.returncode in (0, 3, 4) or result.stderr.startswith(b'dyadel: '), (name, result)
        deep = '{"type":"FeatureCollection","features":[' + '[' * 100000
        for text in ('{', '{}', '{"type":"FeatureCollection","features":[]}', '<', '<gpx>', '<?xml version="1.0"?><kml/>', deep,
                     '{"type":"Point","coordinates":[1e400,0]}', '{"type":"Point","coordinates":[]}', 'fgb\x03', 'PAR1PAR1'):
            f.write('x.file', text)
            result = f.run('delaunay', '--plane', 'x.file')
            assert result.code in (0, 1, 2) and (result.code == 0 or result.err.startswith('dyadel: ')), (text[:40], result)
        expect(f.run('delaunay', '--plane', 'PG:host=127.0.0.1 port=1 dbname=none'), 1, '', 'database')


def test_without_gdal():
    """The command alone, with no dyadel-gdal beside it: the package, and the line to type."""
    with Folder() as f:
        f.write('a.geojson', '{"type":"Point","coordinates":[1,2]}')
        f.write('p.txt', '0 0\n1 1\n2 5\n')
        shutil.copy(COMMAND, f.at('dyadel'))
        alone = os.environ | {'LD_LIBRARY_PATH': os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(COMMAND))))}

        def ask(*words):
            done = subprocess.run([f.at('dyadel'), *words], cwd=f.path, env=alone, capture_output=True, text=True, check=False)
            return type(run('--version'))(done.returncode, done.stdout, done.stderr)
        expect(ask('delaunay', 'p.txt'), 0)
        expect(ask('delaunay', 'a.geojson'), 1, r'\A\Z', r"the file is GeoJSON; give ogr2ogr -f CSV /vsistdout/ a\.geojson .* \| "
               'dyadel delaunay --columns X,Y -, or install dyadel-gdal')
        expect(ask('voronoi', 'p.txt', '-o', 'o.gpkg'), 2, r'\A\Z', r'-o o\.gpkg: .*dyadel-gdal .*-o out\.geojson && ogr2ogr o\.gpkg out\.geojson')
        for words in ('a.geojson', '--in-layer', 'x'), ('PG:dbname=x',):
            expect(ask('delaunay', *words), 2, r'\A\Z', 'dyadel-gdal .*ogr2ogr -f CSV /vsistdout/')


def test_without_proc():
    """Where /proc is not mounted, as in a plain chroot, the command finds dyadel-gdal all the same."""
    with Folder() as f:
        f.write('p.txt', '0 0\n1 1\n2 5\n')
        build = os.path.dirname(os.path.dirname(os.path.dirname(COMMAND)))
        hidden = ['unshare', '--mount', 'sh', '-c', 'mount -t tmpfs none /proc && exec "$@"', 'sh', COMMAND]
        if subprocess.run([*hidden, '--version'], env=os.environ | {'LD_LIBRARY_PATH': build}, capture_output=True, check=False).returncode:
            return  # only root may
        done = subprocess.run([*hidden, 'delaunay', 'p.txt', '-q', '-o', 'o.gpkg'], cwd=f.path, env=os.environ | {'LD_LIBRARY_PATH': build},
                              capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, ''), done
        assert os.path.exists(f.at('o.gpkg'))


if HERE:
    main(globals())
main({'test_without_gdal': test_without_gdal})
