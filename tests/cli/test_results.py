#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whole runs whose outcome is known, and the formats against each other.

Usage: test_results.py COMMAND DATA
"""
import csv
import json
import os
import random
import re
import tempfile
import xml.etree.ElementTree
from fractions import Fraction

from harness import DATA, count, expect, main, run

AIRPORTS = os.path.join(DATA, 'airports.csv')
LONLAT = ('--plane', '--columns', 'longitude,latitude')


def number(text):
    """An exact end of the json format."""
    match = re.fullmatch(r'(-?\d+)(?:\*2\^(-?\d+))?(?:/(\d+))?', text)
    assert match, text
    return Fraction(int(match[1])) * Fraction(2) ** int(match[2] or 0) / int(match[3] or 1)


def polygon(n, nudge=''):
    return ''.join(f'cos(2*pi*{k}/{n}){nudge if k == 0 else ""} sin(2*pi*{k}/{n})\n' for k in range(n))


def test_grid():
    grid = ''.join(f'{x / 10} {y / 10}\n' for y in range(20) for x in range(20))
    result = run('delaunay', '-', stdin=grid)
    # Ties: both diagonals of 19 * 19 squares, and the pairs on a side of the hull that are not neighbours.
    ties = 2 * 19 * 19 + 4 * (20 * 19 // 2 - 19)
    expect(result, 3, err=f'dyadel: 760 legal, 0 indeterminate, {ties} tied pairs; ties: ')
    assert count(result.out) == {'legal': 760, 'tie': ties}


def test_polygon_stays_undecided_without_proofs():
    result = run('delaunay', '-', '--max-bits', '512', '--ties', 'off', stdin=polygon(12))
    expect(result, 4, err='budget: 12 legal, 54 indeterminate pairs; precision limit reached .raise --max-bits')
    assert count(result.out) == {'legal': 12, 'indeterminate': 54}


def most_bits(result):
    return int(re.search(r'^bits asked, most +(\d+)', result.err, re.M)[1])


def test_fixed_rectangles_among_computable_points():
    # Which diagonal it is hangs on the corner that is fixed: no bit of the others tells.
    square = '0 0\nsqrt(16.5) 0\n[3.9,4.2] [3.9,4.2]\n0 sqrt(17)\n'
    result = run('delaunay', '-', '--stats', stdin=square)
    expect(result, 3, err='dyadel: 4 legal, 2 indeterminate pairs; only better measurements can decide them .see dyadel plan')
    assert most_bits(result) <= 256
    expect(run('delaunay', '-', '--schedule', 'uniform', '--step-bits', '16', stdin=square), 3, err='legal, .* pairs; ')
    # One coordinate computed, the other measured.
    for half in ('0 0\n10 0\nsqrt(26) 6+-3\n5 -6\n', '0 0\n0 10\n[3.1,9.1] root(x^5-x-4000,4,6)\n-6 5\n'):
        result = run('delaunay', '-', '--stats', stdin=half)
        expect(result, 3, err='dyadel: 4 legal, 2 indeterminate pairs; only better measurements can decide them .see dyadel plan')
        assert most_bits(result) <= 256
    # A crowd of boxes with computable points among them.
    rng = random.Random(5)
    crowd = ''.join(f'sqrt({rng.uniform(0, 9)}) sqrt({rng.uniform(0, 9)})\n' if k % 8 == 0 else
                    f'{rng.uniform(0, 3):.4f}+-0.2 {rng.uniform(0, 3):.4f}+-0.2\n' for k in range(60))
    result = run('delaunay', '-', '--stats', stdin=crowd)
    expect(result, 3, err='legal, .* pairs; ')
    assert most_bits(result) <= 1024
    # A tie of computable points is nothing of the kind; what only bits decide is decided.
    nudged = polygon(4, nudge='*(1+10^-100)') + '[20,20.5] [-0.25,0.25]\n'
    result = run('delaunay', '-', '--stats', stdin=nudged)
    expect(result, 3 if 'indeterminate' in result.out else 0)
    assert '0,2,' not in result.out and '1,3,legal' in result.out, result.out
    assert 300 < most_bits(result) < 4096
    twice = square + '30+cos(1) 0\n30+cos(1) 0\n'
    expect(run('delaunay', '-', '--max-bits', '512', '--ties', 'off', stdin=twice), 4, err='budget')
    expect(run('delaunay', '-', '--max-bits', '512', stdin=twice), 3, '^# alias 5 4$', 'legal, .* pairs; ')


def test_perturbed_polygon_is_decided():
    # Nudging every corner by its own amount leaves no four on one circle.
    text = ''.join(f'(1+{k * k}*10^-40)*cos(2*pi*{k}/12) (1+{k * k}*10^-40)*sin(2*pi*{k}/12)\n' for k in range(12))
    for schedule in ('adaptive', 'uniform'):
        result = run('delaunay', '-', '--quiet', '--schedule', schedule, stdin=text)
        expect(result, 0, err=r'\A\Z')
        assert count(result.out) == {'legal': 21}


def check_goal(goal, text):
    result = run('delaunay', '-', '--until', goal, '--format', 'json', stdin=text)
    expect(result, 0)
    answer = json.loads(result.out)
    bound = answer['bounds'][goal.split(':')[0]]
    assert answer['outcome'] == 'certified' and f"{answer['goal']}:{answer['goal_bits']}" == goal
    assert number(bound['exact']) <= Fraction(1, 2 ** 20) and Fraction(repr(bound['decimal'])) >= number(bound['exact'])


def test_goals():
    # The twelve corners stay undecided for ever; the possible area shrinks all the same.
    check_goal('area:20', polygon(12))
    check_goal('hausdorff:20', 'sqrt(2) pi\n-sqrt(3) e\n0 exp(-2)\nlog(7) -cbrt(9)\n')


def test_airports():
    exact = run('delaunay', AIRPORTS, *LONLAT, '--stats')
    expect(exact, 0, err=r'outcome +decided')
    assert count(exact.out) == {'legal': 10112}
    edges = set(exact.out.split('\n')[1:])
    for mode in (('--measured',), ('--radius', '0.01')):
        result = run('delaunay', AIRPORTS, *LONLAT, *mode)
        expect(result, 3, err='legal, .* pairs; ')
        assert count(result.out) == ({'legal': 10109, 'indeterminate': 5} if mode[0] == '--measured' else
                                     {'legal': 8925, 'indeterminate': 2490})
        # A certain statement holds for this choice; an edge of this choice is possible.
        pairs = {line.rsplit(',', 1)[0]: line.rsplit(',', 1)[1] for line in result.out.split() if line[0] != '#'}
        legal = {f'{p},legal' for p, s in pairs.items() if s == 'legal'}
        assert legal < edges | {'i,j,legal'}
        assert all(edge.rsplit(',', 1)[0] in pairs for edge in edges if edge and edge[0] != '#')


def test_random_files():
    for seed in range(60):
        r = random.Random(seed)

        def coordinate():
            a, b = r.randint(0, 300), r.choice((0, 5, 30))
            return f'{a / 10}' if r.random() < 0.5 else f'[{a / 100},{(a + b) / 100}]'

        text = ''.join(f'{coordinate()} {coordinate()}\n' for _ in range(r.randint(2, 12)))
        result = run('delaunay', '-', stdin=text)
        assert result.code in (0, 3), (seed, result.err)
        statuses_found = count(result.out)
        assert set(statuses_found) == {'legal'} or result.code == 3, (seed, text)


def test_threads_agree():
    one = run('delaunay', AIRPORTS, *LONLAT, '--radius', '0.01')
    two = run('delaunay', AIRPORTS, *LONLAT, '--radius', '0.01', '--threads', '2')
    assert one.out == two.out


POINTS = '0 0\n1/3 [1,1.25]\n0.1 2.7\nsqrt(2) 1\n0 0.0\n3 1e-3\n5 5\n'


def test_json_against_csv():
    answer = json.loads(run('delaunay', '-', '--format', 'json', stdin=POINTS).out)
    table = run('delaunay', '-', stdin=POINTS).out
    assert ''.join(f'{p["i"]},{p["j"]},{p["status"]}\n' for p in answer['pairs']) == table.split('status\n')[1]
    assert answer['aliases'] == [[4, 0]] and '# alias 4 0' in table
    assert answer['count']['sites'] == len(answer['sites']) == 7
    for axis in 'xy':
        for site in answer['sites']:
            lo, hi = map(number, site[axis])
            down, up = (Fraction(repr(v)) for v in site[axis + '_decimal'])
            assert down <= lo <= hi <= up and up - down <= hi - lo + abs(hi) / 2 ** 50
    assert answer['sites'][2]['x'] == ['1/10', '1/10']
    root = [number(v) for v in answer['sites'][3]['x']]
    assert root[0] ** 2 <= 2 <= root[1] ** 2
    for triangle in answer['triangles']:
        legal = {(p['i'], p['j']) for p in answer['pairs'] if p['status'] == 'legal'}
        i, j, k = sorted(triangle)
        assert {(i, j), (j, k), (i, k)} <= legal


def test_far_apart():
    text = '2^100000 0\n0 2^-100000\n1 0\n5 7\n'
    result = run('delaunay', '-', '--format', 'json', stdin=text)
    assert result.code in (0, 3), result.err
    answer = json.loads(result.out)
    assert number(answer['sites'][0]['x'][0]) == Fraction(2) ** 100000
    assert answer['sites'][0]['x_decimal'][1] is None and answer['sites'][1]['y_decimal'][0] == 0
    for name in ('wkt', 'geojson', 'obj', 'svg'):
        expect(run('delaunay', '-', '--format', name, stdin=text), 1, r'\A\Z',
               'point 0: the point lies beyond the largest double, which this format cannot show; use csv or json')


def statuses():
    table = run('delaunay', '-', stdin=POINTS).out
    return [line.split(',') for line in table.split('status\n')[1].split()]


def near(text, site, axis, bound):
    return all(abs(Fraction(text) - number(end)) <= Fraction(bound) for end in site[axis])


def test_places():
    sites = json.loads(run('delaunay', '-', '--format', 'json', stdin=POINTS).out)['sites']
    rows = list(csv.DictReader(run('delaunay', '-', '--format', 'wkt', stdin=POINTS).out.splitlines()))
    assert [[r['i'], r['j'], r['status']] for r in rows] == statuses()
    for row in rows:
        match = re.fullmatch(r'LINESTRING \((\S+) (\S+), (\S+) (\S+)\)', row['WKT'])
        for end, name in ((0, 'i'), (2, 'j')):
            for axis in (0, 1):
                assert near(match[1 + end + axis], sites[int(row[name])], 'xy'[axis], row['max_coordinate_error'])
    geo = json.loads(run('delaunay', '-', '--format', 'geojson', stdin=POINTS).out, parse_float=str, parse_int=str)
    assert geo['type'] == 'FeatureCollection' and 'rounding' in geo
    assert [[f['properties'][k] for k in ('i', 'j', 'status')] for f in geo['features']] == statuses()
    for feature in geo['features']:
        for end, name in ((0, 'i'), (1, 'j')):
            for axis in (0, 1):
                place = feature['geometry']['coordinates'][end][axis]
                assert near(place, sites[int(feature['properties'][name])], 'xy'[axis], geo['max_coordinate_error'])


def test_obj():
    text = run('delaunay', '-', '--format', 'obj', stdin=POINTS).out
    lines = [line.split() for line in text.splitlines()]
    assert sum(line[0] == 'v' and len(line) == 4 and line[3] == '0' for line in lines) == 7
    legal = [[str(int(i) + 1), str(int(j) + 1)] for i, j, s in statuses() if s == 'legal']
    assert [line[1:] for line in lines if line[0] == 'l'] == legal
    assert re.search(r'^# a coordinate differs .* by at most \d', text, re.M)


def test_exact_places_are_exact():
    out = run('delaunay', '-', '--format', 'wkt', stdin='1.5 -2\n0.125 1e6\n').out
    assert '"LINESTRING (1.5 -2, 0.125 1000000)",0,1,legal,0\n' in out, out


def test_svg():
    for command in ('delaunay', 'voronoi'):
        for text in ('', '1 1\n', '0 0\n1 0\n', POINTS, '1e-300 0\n-1e-300 0\n', '1e300 0\n-1e300 1\n'):
            picture = run(command, '-', '--format', 'svg', stdin=text)
            if picture.code == 1:
                assert 'too far apart or too close for a picture' in picture.err, picture.err
                continue
            tree = xml.etree.ElementTree.fromstring(picture.out)
            assert tree.tag.endswith('svg') and 'nan' not in picture.out and 'inf' not in picture.out


def test_pdf_and_png():
    for command in ('delaunay', 'voronoi'):
        for kind, magic in (('pdf', b'%PDF'), ('png', b'\x89PNG')):
            with tempfile.TemporaryDirectory() as folder:
                name = os.path.join(folder, 'x.' + kind)
                result = run(command, '-', '--format', kind, '-o', name, stdin=POINTS)
                assert result.code in (0, 3), result
                with open(name, 'rb') as f:
                    assert f.read(4) == magic


def test_picture_of_all_kinds():
    picture = run('delaunay', os.path.join(DATA, 'picture.txt'), '--format', 'svg')
    expect(picture, 3)
    with open(os.path.join(DATA, 'picture.svg'), encoding='utf-8') as f:
        assert f.read() == picture.out, 'tests/data/picture.svg is out of date'


def test_no_points_in_all_formats():
    for name in ('csv', 'json', 'wkt', 'geojson', 'obj', 'svg', 'vtk'):
        result = run('delaunay', '-', '--format', name)
        expect(result, 0, '.', r'\Adyadel: -: this file has no points\n\Z')
        if 'json' in name:
            json.loads(result.out)


def test_pairs_cap():
    result = run('delaunay', '-', '--max-pairs', '10', stdin=''.join(f'[-{k},{k}] [-{k},{k}]\n' for k in range(1, 60)))
    expect(result, 4, r'^# capped: ', 'limit of stored pairs reached .raise --max-pairs')
    assert re.search(r'^# face( \d+)+$', result.out, re.M)
    for more in ((), ('--discs',), ('--layer', 'points'), ('--until', 'area:3'), ('--sphere', '--merge')):
        text = 'x,y,r\n' + ''.join(f'{k % 8 / 2},{k // 8 / 2},{1 + k / 90}\n' for k in range(60))
        given = ('--columns', 'x,y', '--radius-column', 'r', *(('--radius-unit', 'deg') if '--sphere' in more else ()), '-')
        cut, whole = (run('delaunay', *more, *cap, *given, stdin=text) for cap in (('--max-pairs', '1'), ()))
        expect(cut, 4, '', 'not all pairs are known: one that is not listed, or not counted, may be an edge')
        assert cut.out != whole.out and 'not all pairs are known' not in whole.err, (more, cut.err, whole.err)


def test_output_file():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'result.csv')
        expect(run('delaunay', '-', '-o', path, stdin='0 0\n1 1\n'), 0, r'\A\Z', r'\A\Z')
        with open(path, encoding='utf-8') as f:
            assert f.read() == 'i,j,status\n0,1,legal\n'
        # Bad input leaves the old file, and no other file next to it.
        expect(run('delaunay', '-', '-o', path, stdin='0 0\n1\n'), 1)
        link = os.path.join(folder, 'link')
        os.symlink('result.csv', link)
        expect(run('delaunay', '-', '-o', link, stdin='0 0\n1 1\n2 5\n'), 0)
        assert os.path.islink(link) and sorted(os.listdir(folder)) == ['link', 'result.csv']
        with open(path, encoding='utf-8') as f:
            assert f.read() == 'i,j,status\n0,1,legal\n0,2,legal\n1,2,legal\n'


main(globals())
