#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What files hold that leave the command: plain csv, comments and where they go, packed files, endings that no format
has, reference systems that a format cannot hold.

Usage: test_plain.py COMMAND DATA
"""
import csv
import gzip
import io
import os
import re
import shutil
import subprocess
import tempfile

from harness import expect, main, run

POINTS = '0 0\n4 0\n[1,1.5] 4\n5 5\n2 1\n2 1\n'
EXACT = '0 0\n4 0\n1 4\n5 5\n2 1\n2 1\n'
QUESTIONS = {'delaunay': ((), POINTS), 'voronoi': ((), POINTS), 'converge': ((), POINTS), 'disc': ((), EXACT),
             'bisector': ((), EXACT), 'nearest': (('1', '1'), EXACT), 'tolerance': ((), EXACT), 'plan': ((), POINTS)}
LAYERS = {'delaunay': ('pairs', 'points', 'triangles', 'graph:nearest', 'graph:gabriel', 'graph:mst', 'aliases', 'ties'),
          'voronoi': ('cells', 'vertices', 'regions', 'edges', 'aliases'), 'tolerance': ('pairs', 'points', 'barcode'), 'disc': ('circles', 'con')}


def ask(command, *options, **how):
    at, points = QUESTIONS[command]
    return run(command, *options, '-', *at, stdin=points, comments=False, **how)


def test_csv_is_plain():
    """The names come first, all records are as long, and --comments adds lines in front and nothing else."""
    for command in QUESTIONS:
        for layer in LAYERS.get(command, (None,)):
            options = ('--layer', layer) if layer else ()
            if command == 'converge':
                options += ('--no-times',)
            plain, told = ask(command, *options), ask(command, *options, '--comments')
            rows = list(csv.reader(io.StringIO(plain.out)))
            assert rows and rows[0][0].isidentifier() and {len(r) for r in rows} == {len(rows[0])}, (command, rows[:2])
            assert plain.code == told.code and told.out.endswith(plain.out), (command, layer)
            front = told.out[:len(told.out) - len(plain.out)].splitlines()
            assert all(line.startswith('# ') for line in front), (command, layer, front)


def test_summary_says_what_comments_do():
    for command in 'delaunay', 'voronoi', 'tolerance', 'plan':
        said = 'points that coincide with earlier ones: 1 '
        assert said in ask(command).err and said not in ask(command, '--comments').err, command
        assert said not in ask(command, '--quiet').err
    expect(ask('voronoi'), 0, '', r'^dyadel: window (about )?-?[0-9.e+-]+(,-?[0-9.e+-]+){3}; undetermined_area [0-9.e-]+; distance_to_true_diagram ')
    expect(run('voronoi', '-', stdin='1e308 1e308\n-1e308 1e308\n0 -1e308\n0 1\n', comments=False), 0, '', '; undetermined_area unbounded or beyond doubles; distance_to_true_diagram 0$')
    expect(ask('tolerance'), 0, '', r'^dyadel: tolerance 0\.\d+ 0\.\d+$')
    expect(ask('plan'), 0, '', r'^dyadel: plan \d+ points: sufficient')
    expect(ask('disc'), 0, '', r'^dyadel: orientation of 0 1 2: counter-clockwise; partial centre within .*; con of the others: inside \d, outside \d, unknown 0')
    expect(ask('converge'), 0, '', r'^dyadel: schedule adaptive; goal decided; ')


def timeless(text):
    """Without the times that json has."""
    return re.sub(rb'milliseconds_rounded_up": \d+', b'', text)


def test_packed():
    """Unpacked output equals output without packing; names in any case; the file is complete or missing."""
    with tempfile.TemporaryDirectory() as folder:
        for form in 'csv', 'json', 'geojson', 'wkt', 'svg', 'vtk':
            want = timeless(ask('delaunay', '--format', form).out.encode())
            for ending, unpack in PACKED:
                name = os.path.join(folder, f'x.{form}.{ending}')
                expect(ask('delaunay', '-o', name), 0)
                with open(name, 'rb') as f:
                    assert timeless(unpack(f.read())) == want, (form, ending)
        many = ''.join(f'{k} {k * k % 7919}\n' for k in range(20000))
        want = run('delaunay', '-', stdin=many, comments=False).out.encode()
        for ending, unpack in PACKED:
            name = os.path.join(folder, 'many.csv.' + ending)
            run('delaunay', '-', '-o', name, stdin=many, comments=False)
            with open(name, 'rb') as f:
                assert unpack(f.read()) == want
    expect(ask('delaunay', '-o', 'a/b/x.csv.gz'), 1, '', 'cannot write: No such file')
    if os.path.exists('/dev/full'):
        for name in '/dev/full',:
            with tempfile.TemporaryDirectory() as folder:
                os.symlink(name, os.path.join(folder, 'x.csv.gz'))
                expect(ask('delaunay', '-o', os.path.join(folder, 'x.csv.gz')), 1, '', 'cannot write')


def unzstd(packed):
    assert packed[:4] == b'\x28\xB5\x2F\xFD'
    return subprocess.run(['zstd', '-dc'], input=packed, stdout=subprocess.PIPE, check=True).stdout


PACKED = [('gz', gzip.decompress), ('GZ', gzip.decompress), *([('zst', unzstd)] if shutil.which('zstd') else [])]


def test_unknown_endings():
    with tempfile.TemporaryDirectory() as folder:
        for ending in 'xlsx2', 'doc', 'csvv', 'svgz', 'tif', 'json.bz2', 'v2':
            result = ask('delaunay', '-o', os.path.join(folder, 'x.' + ending))
            expect(result, 2, r'\A\Z', rf'no format is called {ending.split(".")[-1]}; .*formats are csv, json, .*--format')
        expect(ask('delaunay', '-o', os.path.join(folder, 'x.xls')), 2, '', r'for a table end the name in \.csv')
        assert not os.listdir(folder)
        for name, options in (('x.v2', ('--format', 'csv')), ('x', ()), ('x.txt', ()), ('.hidden/x', ()), ('a.b/c', ())):
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            expect(ask('delaunay', '-o', path, *options), 0)
            with open(path, encoding='utf-8') as f:
                assert f.read().startswith('i,j,status\n'), name


def test_reference_systems():
    """They are written, or refused; the units named are always the units written."""
    for form in 'csv', 'wkt', 'obj', 'vtk':
        expect(ask('delaunay', '--crs', 'EPSG:32632', '--format', form), 2, r'\A\Z', f'{form} has no place for a reference system')
    for form in 'geojson', 'json', 'svg':
        result = ask('delaunay', '--crs', 'EPSG:32632', '--format', form)
        expect(result, 0, '32632')
    expect(ask('voronoi', '--crs', 'EPSG:3857', '--format', 'svg'), 0, r' m \(EPSG:3857\)<')
    expect(ask('tolerance', '--crs', 'EPSG:3857', '--format', 'svg'), 0, r' m \(EPSG:3857\)<')
    expect(ask('delaunay', '--crs', 'EPSG:3857', '--sphere', '--format', 'geojson'), 2, r'\A\Z',
           'coordinates are degrees, and EPSG:3857 is not known as a system of degrees; give --crs EPSG:4326')
    result = run('delaunay', '--crs', 'EPSG:4326', '--sphere', '--format', 'geojson', '-', stdin=EXACT)
    expect(result, 0, 'EPSG::4326')


main(globals())
