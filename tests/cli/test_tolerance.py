#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel tolerance: layers, formats, exact forms, messages, the airports.

Usage: test_tolerance.py COMMAND DATA
"""
import collections
import csv
import fractions
import json
import math
import os
import re
import xml.etree.ElementTree

import tempfile
from harness import DATA, expect, main, run

SQUARE = '0 0\n1 0\n1 1\n0 1\n0 0\n3 0.5\n'
AIRPORTS = ['--plane', '--columns', 'longitude,latitude', os.path.join(DATA, 'airports.csv')]


def rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))


def test_square():
    """Ties, touching pairs, births, an alias; a birth beyond the cap is not listed."""
    result = run('tolerance', '--up-to', '0.1', '-', stdin=SQUARE)
    expect(result, 0, r'\A# alias 4 0\n# tolerance 0 0\ni,j,event,lo,hi,k,l\n0,1,death,', r'\A\Z')
    got = {(r['i'], r['j']): r for r in rows(result.out)}
    assert got['0', '2'] == {'i': '0', 'j': '2', 'event': 'tie', 'lo': '0', 'hi': '0', 'k': '', 'l': ''}, got
    assert (got['0', '3']['lo'], got['0', '3']['hi'], got['0', '3']['k'], got['0', '3']['l']) == ('0.5', '0.5', '2', '')
    assert got['0', '5']['event'] == 'birth' and got['0', '5']['k'] == '1', got['0', '5']
    assert ('0', '5') not in {(r['i'], r['j']) for r in rows(run('tolerance', '--up-to', '0.08', '-', stdin=SQUARE).out)}
    assert all(r['event'] != 'birth' for r in rows(run('tolerance', '-', stdin=SQUARE).out))


def test_few_points():
    expect(run('tolerance', '--quiet', '-', stdin=''), 0, r'\A# tolerance inf inf\ni,j,event,lo,hi,k,l\n\Z', r'\A\Z')
    expect(run('tolerance', '-', stdin='1 2\n'), 0, r'\A# tolerance inf inf\ni,j,event,lo,hi,k,l\n\Z', r'\A\Z')
    expect(run('tolerance', '-', stdin='1 2\n3 4\n'), 0, r'inf inf\ni,j,event,lo,hi,k,l\n0,1,death,,,,\n\Z', r'\A\Z')
    expect(run('tolerance', '-', stdin='0 0\n2 0\n3 0\n'), 0, r'# tolerance 0 0\n.*\n0,1,death,0\.5,0\.5,2,\n0,2,tie,0,0,,\n')
    expect(run('tolerance', '--layer', 'points', '-', stdin='0 0\n2 0\n3 0\n'), 0, r'\ni,rho\n0,0\n1,0\n2,0\n\Z')


def test_refusals():
    expect(run('tolerance', '-', stdin='0 0\n1 0\n[1,2] 1\n'), 1, r'\A\Z', r'-: point 2: .*give its exact place')
    for wrong in ('-1', 'x', '1+-0.5', 'sqrt(2)'):
        expect(run('tolerance', '--up-to', wrong, '-', stdin=SQUARE), 2, r'\A\Z', '--up-to ".*" is not understood; give')
    for widened in ('--radius=1', '--measured'):  # tolerances are those of exact points: no such option
        expect(run('tolerance', widened, '-', stdin=SQUARE), 2, r'\A\Z', f'tolerance does not take {widened[:8]}')
    expect(run('tolerance', '--layer', 'cells', '-', stdin=SQUARE), 2, r'\A\Z', 'give pairs, points, barcode')
    expect(run('tolerance', '--format', 'obj', '-', stdin=SQUARE), 2, r'\A\Z', 'does not write obj')
    expect(run('tolerance', '--format', 'wkt', '--layer', 'barcode', '-', stdin=SQUARE), 2, r'\A\Z', 'barcode')
    expect(run('tolerance', '--up-to', '1', '--max-pairs', '1', '-', stdin=SQUARE), 1, r'\A\Z', '--max-pairs')


def test_computable_points():
    """Rows hold those of exact points nearby, widened by how near these are [TOL-10]; ties are proved; widths are as asked."""
    real = 'sqrt(2) 0\n4 sqrt(3)\n0 pi\n1 1\n9 e\n2+sqrt(3)/1000 3.1\n'
    near = '\n'.join(f'{x} {y}' for x, y in (
        ('1.41421356237309504880168872420969807857', '0'), ('4', '1.73205080756887729352744634150587236694'),
        ('0', '3.14159265358979323846264338327950288420'), ('1', '1'), ('9', '2.71828182845904523536028747135266249776'),
        ('2.00173205080756887729352744634150587237', '3.1')))
    for how in ((), ('--up-to', '0.5'), ('--metric', 'box', '--up-to', '0.25'), ('--relative-bits', '40')):
        bits = 40 if '40' in how else 20
        exact, found = (run('tolerance', '--quiet', '-', *(h for h in how if text is real or h not in ('--relative-bits', '40')),
                            stdin=text) for text in (near, real))
        assert exact.code == found.code == 0, found.err
        want, got = rows(exact.out), rows(found.out)
        assert [(r['i'], r['j'], r['event']) for r in want] == [(r['i'], r['j'], r['event']) for r in got] and got
        for a, b in zip(want, got):
            assert fractions.Fraction(b['lo']) <= fractions.Fraction(a['lo']) + fractions.Fraction(1, 10 ** 30) and fractions.Fraction(a['hi']) <= fractions.Fraction(b['hi']) + fractions.Fraction(1, 10 ** 30)
            assert fractions.Fraction(b['hi']) - fractions.Fraction(b['lo']) <= fractions.Fraction(a['hi']) - fractions.Fraction(a['lo']) + fractions.Fraction(a['hi']) / 2 ** bits
    square = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\nsqrt(8)/2 0\n'
    got = {(r['i'], r['j']): r for r in rows(run('tolerance', '-', stdin=square).out)}
    assert got['0', '2']['event'] == got['1', '3']['event'] == 'tie' and got['0', '2']['hi'] == '0' and len(got) == 6
    assert fractions.Fraction(got['0', '1']['lo']) < 1 < fractions.Fraction(got['0', '1']['hi'])
    undecided = run('tolerance', '-', '--ties', 'off', '--max-bits', '300', stdin=square)
    expect(undecided, 4, r'1,2,death', 'have no row .precision limit reached')
    assert ('0', '2') not in {(r['i'], r['j']) for r in rows(undecided.out)}
    expect(run('tolerance', '-', '--sigma', '1', stdin=real), 1, r'\A\Z', 'standard deviations are for points given by plain numbers')
    with tempfile.TemporaryDirectory() as folder:
        trace = os.path.join(folder, 'trace')
        made, again = (run('tolerance', '-', option, trace, stdin=real) for option in ('--trace', '--resume'))
        assert made.code == again.code == 0 and made.out == again.out, again.err


def test_airports():
    result = run('tolerance', *AIRPORTS)
    expect(result, 0, r'\A# tolerance 7\.68043049\d*e-7 7\.68043049\d*e-7\n', r'\A\Z')
    deaths = [float(r['lo']) for r in rows(result.out)]
    assert len(deaths) == 10112 and sum(d < 0.005 for d in deaths) == 511 and sum(d < 0.01 for d in deaths) == 964
    assert all(float(r['hi']) <= float(r['lo']) * (1 + 2 ** -40) for r in rows(result.out))
    barcode = {r['accuracy']: (int(r['certain']), int(r['open'])) for r in rows(run('tolerance', '--layer', 'barcode', *AIRPORTS).out)}
    assert barcode['5e-3'] == (9601, 511) and barcode['1e-2'] == (9148, 964), barcode


def test_boxes_agree():
    """Squares of half-width t hold the discs, and lie in those of radius sqrt(2) t: deaths and births against statuses."""
    half = 0.01
    wide = rows(run('delaunay', '--radius', str(half), *AIRPORTS).out)
    legal = {(r['i'], r['j']) for r in wide if r['status'] == 'legal'}
    possible = {(r['i'], r['j']) for r in wide}
    events = rows(run('tolerance', '--up-to', '0.015', *AIRPORTS).out)
    for r in events:
        pair, lo, hi = (r['i'], r['j']), float(r['lo']), float(r['hi'])
        if r['event'] == 'death':
            assert pair not in legal or lo >= half, r
            assert pair in legal or hi <= half * math.sqrt(2) * (1 + 1e-9), r
        else:
            assert pair not in possible or lo <= half * math.sqrt(2) * (1 + 1e-9), r
            assert pair in possible or hi >= half * (1 - 1e-9), r
    assert possible <= {(r['i'], r['j']) for r in events}


def test_squares():
    """--metric box: deaths and births are those of statuses, at two values of the radius just beside some of them; within those of discs."""
    if os.environ.get('DYADEL_TEST_SANITIZED'):
        return  # takes minutes; few points are tried below
    text = run('tolerance', '--metric', 'box', '--up-to', '0.003', *AIRPORTS)
    expect(text, 0, r'\A# tolerance 6\.0453\d*e-7 6\.0453\d*e-7\ni,j,event,lo,hi,k,l\n', r'\A\Z')
    events = rows(text.out)
    discs = {(r['i'], r['j']): r for r in rows(run('tolerance', *AIRPORTS).out)}
    deaths = [r for r in events if r['event'] == 'death']
    assert len(deaths) == 10112 and len(events) > 10150
    for r in deaths:
        lo, hi = (float(discs[r['i'], r['j']][end]) for end in ('lo', 'hi'))
        assert float(r['hi']) <= float(r['lo']) * (1 + 2 ** -20) and lo * 0.70710678 <= float(r['hi']) and float(r['lo']) <= hi, r
    middle = sorted(deaths, key=lambda r: float(r['lo']))[150]
    for radius in (float(middle['lo']) * (1 - 2 ** -30), float(middle['hi']) * (1 + 2 ** -30)):
        assert radius < 0.003
        status = {(r['i'], r['j']): r['status'] for r in rows(run('delaunay', '--radius', repr(radius), *AIRPORTS).out)}
        for r in events:
            is_so = (status.get((r['i'], r['j'])) == 'legal') if r['event'] == 'death' else (r['i'], r['j']) not in status
            assert is_so or float(r['lo']) <= radius, r
            assert not is_so or float(r['hi']) >= radius, r
        assert set(status) <= {(r['i'], r['j']) for r in events}


def test_squares_few_points():
    box = ('tolerance', '--metric', 'box', '-')
    for few in ('', '1 2\n', '1 2\n3 4\n'):
        assert run(*box, stdin=few).out == run('tolerance', '-', stdin=few).out
    expect(run(*box, stdin='0 0\n2 0\n3 0\n'), 0, r'# tolerance 0 0\n.*\n0,1,death,0\.49999\d*,0\.5,2,\n0,2,tie,0,0,,\n')
    expect(run(*box, '--up-to', '0.1', stdin=SQUARE), 0, r'\A# alias 4 0\n# tolerance 0 0\ni,j,event,lo,hi,k,l\n0,1,death,0.449\d*,0.449\d*,[25],\n'
           r'0,2,tie,0,0,,\n(.*\n)*0,5,birth,0\.0714285\d*,0\.0714286\d*,,\n')
    far = run(*box, stdin='1e100000 0\n0 0\n0 1\n1/3 0.1\n')  # beyond doubles: known facts about discs
    expect(far, 0)
    assert all(r['lo'] and float(r['lo']) >= 0 for r in rows(far.out)), far.out
    assert rows(run(*box, '--layer', 'points', stdin=SQUARE).out)[5]['rho'] != '0'
    barcode = rows(run(*box, '--layer', 'barcode', stdin=SQUARE).out)
    assert [r['certain'] for r in barcode][-1] == '0' and barcode[0]['certain'] == '6', barcode
    answer = json.loads(run(*box, '--format', 'json', stdin=SQUARE).out)
    assert answer['metric'] == 'box' and 'sqrt' not in answer['rounding'] and all('plus' not in p for p in answer['pairs'])
    picture = run(*box, '--format', 'svg', stdin=SQUARE).out
    assert 'may move, in x and y each, before' in picture and picture.count('not lost below') == 6
    assert 'probability' in run(*box, '--sigma', '0.1', stdin=SQUARE).out
    expect(run('tolerance', '--metric', 'max', '-', stdin=SQUARE), 2, r'\A\Z', '--metric "max" is not understood; give euclid or box')
    expect(run('tolerance', '--metric', 'box', '--columns', 'x,y', '--radius-column', 'r', '-', stdin='x,y,r\n'), 2, r'\A\Z', 'remove it or --radius-column')
    assert run('tolerance', '--metric', 'euclid', '-', stdin=SQUARE).out == run('tolerance', '-', stdin=SQUARE).out


def test_discs():
    """The same as deaths and births say; fewer open pairs than squares leave; what cannot be written so is refused."""
    for radius in ('0.01', '0.003'):
        discs = run('delaunay', '--discs', '--radius', radius, *AIRPORTS)
        expect(discs, 3, r'\Ai,j,status\n', r'\Adyadel: \d+ legal, \d+ indeterminate pairs; only better measurements can decide them .see dyadel plan.\n\Z')
        events = rows(run('tolerance', '--up-to', radius, *AIRPORTS).out)
        wanted = {(r['i'], r['j']): 'legal' if r['event'] == 'death' and float(r['lo']) > float(radius) else 'indeterminate'
                  for r in events}
        assert {(r['i'], r['j']): r['status'] for r in rows(discs.out)} == wanted
    expect(run('delaunay', '--discs', '-', stdin='0 0\n9 0\n4+-1 8+-1\n'), 0, r'\Ai,j,status\n(\d,\d,legal\n){3}\Z', r'\A\Z')
    expect(run('delaunay', '--discs', '-', stdin='0 0\n9 0\n4+-1 8\n'), 1, r'\A\Z', 'point 2: a disc needs one radius')
    expect(run('delaunay', '--discs', '--format', 'json', '-', stdin='0 0\n'), 2, r'\A\Z', 'does not write json')
    for layer in ('triangles', 'points'):
        of_discs, of_squares = (rows(run('delaunay', '--layer', layer, '--radius', '0.003', *how, *AIRPORTS).out)
                                for how in (('--discs',), ()))
        assert len(of_discs) > len(of_squares) or layer == 'points'
        if layer == 'triangles':
            assert all(row in of_discs for row in of_squares)
    listed = rows(run('delaunay', '--discs', '--radius', '0.003', *AIRPORTS).out)
    partners = collections.Counter((row[end], row['status']) for row in listed for end in ('i', 'j'))
    for row in of_discs:
        assert all(int(row[s]) == partners[row['i'], s] for s in ('legal', 'indeterminate', 'tie')), row
    expect(run('delaunay', '--discs', '--layer', 'hulls', '-', stdin='0 0\n'), 2, r'\A\Z', 'does not write --layer hulls')
    stats = run('delaunay', '--discs', '--stats', '--radius', '0.01', *AIRPORTS)
    for status in ('legal', 'indeterminate'):
        assert re.search(rf'^pairs {status} +{stats.out.count("," + status)}$', stats.err, re.M), stats.err
    xml.etree.ElementTree.fromstring(run('delaunay', '--discs', '--format', 'svg', '-', stdin='0+-1 0+-1\n9 0\n4 8\n').out)


def test_json():
    """The exact form is inside the bounds."""
    result = run('tolerance', '--format', 'json', '--up-to', '0.1', '-', stdin=SQUARE + '1/3 0.1\n')
    expect(result, 0)
    answer = json.loads(result.out)
    assert answer['format'] == 'dyadel tolerance 1' and answer['aliases'] == [[4, 0]] and len(answer['rho']) == 7
    for pair in answer['pairs']:
        plus, minus = fractions.Fraction(pair['plus']), fractions.Fraction(pair['minus'])
        lo, hi = map(fractions.Fraction, pair['bounds'])
        t = abs(math.sqrt(plus) - math.sqrt(minus)) / 2
        assert lo - fractions.Fraction(1e-12) <= t <= hi + fractions.Fraction(1e-12), pair


def test_sigma():
    """A column more, also in json; no edge, no probability; a certain edge has 1."""
    plain, likely = (rows(run('tolerance', '--up-to', '0.1', *more, '-', stdin=SQUARE).out) for more in ([], ['--sigma', '0.05']))
    assert [{k: v for k, v in r.items() if k != 'probability'} for r in likely] == plain
    assert all((float(r['probability']) > 0.5) == (r['event'] == 'death') and float(r['probability']) < 1 for r in likely), likely
    answer = json.loads(run('tolerance', '--format', 'json', '--sigma', '0.05', '-', stdin=SQUARE).out)
    assert [p['probability'] for p in answer['pairs']] == [float(r['probability']) for r in likely if r['event'] != 'birth']
    assert rows(run('tolerance', '--sigma', '1', '-', stdin='0 0\n1 1\n').out)[0]['probability'] == '1'
    less = [[float(r['probability']) for r in rows(run('tolerance', '--sigma', s, *AIRPORTS).out)] for s in ('0.01', '0.001')]
    assert all(a <= b + 1e-5 for a, b in zip(*less)) and sum(less[0]) < 0.99 * sum(less[1])
    for layer in ('points', 'barcode'):  # they have no place for it
        expect(run('tolerance', '--sigma', '1', '--layer', layer, '-', stdin=SQUARE), 2, r'\A\Z', 'probabilities are those of pairs; remove')
    for wrong in ('0', '-1', 'x', 'nan', '1e-400'):
        expect(run('tolerance', '--sigma', wrong, '-', stdin=SQUARE), 2, r'\A\Z', '--sigma ".*" is not understood; give')


def test_sigma_column():
    """Equal ones are --sigma; a larger one makes the edges of that point less likely, others no less."""
    places = [line.replace(' ', ',') for line in SQUARE.split('\n') if line] + ['30,30', '33,30', '31,34']
    def chances(sigma):
        text = 'x,y,s\n' + ''.join(f'{p},{s}\n' for p, s in zip(places, sigma))
        return {(int(r['i']), int(r['j'])): float(r['probability']) for r in rows(run('tolerance', '--columns', 'x,y', '--sigma-column', 's', '-', stdin=text).out)}
    equal = chances(['0.05'] * len(places))
    want = rows(run('tolerance', '--sigma', '0.05', '-', stdin='\n'.join(places).replace(',', ' ')).out)
    assert equal == {(int(r['i']), int(r['j'])): float(r['probability']) for r in want}
    last = len(places) - 1
    more = chances(['0.05'] * last + ['1.5'])
    assert all(more[p] <= equal[p] for p in equal) and any(more[p] < equal[p] - 0.01 for p in equal if last in p), (more, equal)
    less = chances(['0.05'] * last + ['1e-3'])
    assert all(less[p] >= equal[p] for p in equal)
    for wrong in ('0', '-1', 'x'):
        expect(run('tolerance', '--columns', 'x,y', '--sigma-column', 's', '-', stdin=f'x,y,s\n0,0,1\n1,0,{wrong}\n'), 1, r'\A\Z', r'-:3:5: the standard deviation is not an exact number above 0; give')
    expect(run('tolerance', '--columns', 'x,y', '--sigma-column', 's', '--sigma', '1', '-', stdin='x,y,s\n'), 2, r'\A\Z', 'contradict each other')
    expect(run('tolerance', '--sigma-column', 's', '-', stdin='0 0\n'), 2, r'\A\Z', '--sigma-column is about columns')
    expect(run('tolerance', '--sigma-column', 's', '--oracle', 'echo points 0'), 2, r'\A\Z',
           '--sigma-column is for points files; remove it, and give --sigma')


def test_weights():
    """Events in units of the column; 0 is fixed; no exact form; errors are reported with their place."""
    table = 'x,y,w\n' + ''.join(f'{line.replace(" ", ",")},{w}\n' for line, w in zip('0 0\n4 0\n5 3\n1 4\n2 1'.split('\n'), ('1/2', 2, 0, 1, '0.1')))
    plain = ('tolerance', '--columns', 'x,y', '--up-to', '3', '-')
    weighed = rows(run('tolerance', '--columns', 'x,y', '--radius-column', 'w', '--up-to', '3', '-', stdin=table).out)
    for k, w in enumerate(('1', '4', '1/4')):
        equal = 'x,y,w\n' + ''.join(','.join(line.split(',')[:2] + [w]) + '\n' for line in table.split('\n')[1:-1])
        up_to = str(3 / fractions.Fraction(w))
        got = rows(run('tolerance', '--columns', 'x,y', '--radius-column', 'w', '--up-to', up_to, '-', stdin=equal).out)
        want = rows(run(*plain, stdin=table).out)
        assert [(r['i'], r['j'], r['event'], r['k'], r['l']) for r in got] == [(r['i'], r['j'], r['event'], r['k'], r['l']) for r in want], w
        for a, b in zip(got, want):
            assert float(a['lo']) * float(fractions.Fraction(w)) <= float(b['hi']) and float(b['lo']) <= float(a['hi']) * float(fractions.Fraction(w)), (a, b)
    assert {(r['i'], r['j']) for r in weighed if r['event'] == 'death'} == {(r['i'], r['j']) for r in want if r['event'] == 'death'}
    assert all(float(r['hi']) <= float(r['lo']) * (1 + 2 ** -40) for r in weighed), weighed
    answer = json.loads(run('tolerance', '--columns', 'x,y', '--radius-column', 'w', '--format', 'json', '-', stdin=table).out)
    assert all('plus' not in p and len(p['bounds']) == 2 for p in answer['pairs'])
    fixed = rows(run('tolerance', '--columns', 'x,y', '--radius-column', 'w', '-', stdin='x,y,w\n0,0,0\n1,0,0\n0,1,0\n').out)
    assert [r['lo'] for r in fixed] == ['', '', ''] and [r['hi'] for r in fixed] == ['', '', ''], fixed
    for wrong in ('-1', 'x', '1+-2', '1e999'):
        expect(run('tolerance', '--columns', 'x,y', '--radius-column', 'w', '-', stdin=f'x,y,w\n0,0,1\n1,0,{wrong}\n'), 1, r'\A\Z', r'-:3:5: the radius is (not an exact number >= 0; give|above the range of doubles.*; give|negative; if )')
    expect(run('tolerance', '--columns', 'x,y', '--radius-column', 'x,w', '-', stdin='x,y,w\n0,0,1\n'), 1, r'\A\Z', r'-:2:5: the radii in x and in y differ')
    expect(run('tolerance', '--radius-column', 'w', '-', stdin='0 0\n'), 2, r'\A\Z', '--radius-column is about columns')


def test_geometry():
    answer = json.loads(run('tolerance', '--format', 'geojson', '--layer', 'points', '-', stdin=SQUARE).out)
    assert answer['features'][5]['geometry'] == {'type': 'Point', 'coordinates': [3, 0.5]}, answer
    assert set(answer['features'][5]['properties']) == {'i', 'rho', 'max_coordinate_error'}
    lines = run('tolerance', '--format', 'wkt', '-', stdin=SQUARE).out.splitlines()
    assert lines[0] == 'WKT,i,j,event,lo,hi,k,l,max_coordinate_error' and lines[1].startswith('"LINESTRING (0 0, 1 0)",0,1,death,')


def test_picture():
    """All classes and ties are drawn, births are not."""
    with_births = run('tolerance', '--format', 'svg', '--up-to', '1', '-', stdin=SQUARE)
    expect(with_births, 0)
    xml.etree.ElementTree.fromstring(with_births.out)
    assert with_births.out == run('tolerance', '--format', 'svg', '-', stdin=SQUARE).out
    window = run('tolerance', '--format', 'svg', '--window', '0,1,0,1', '-', stdin=SQUARE)
    expect(window, 0)
    assert window.out != with_births.out
    expect(run('tolerance', '--format', 'svg', '--window', '0,0,0,1', '-', stdin=SQUARE), 2, r'\A\Z', 'window')
    told = dict(re.findall('id="pair-([0-9]+-[0-9]+)"[^>]*><title>[0-9]+, [0-9]+: not lost below ([0-9.e-]+)<', with_births.out))
    rows = [row.split(',') for row in run('tolerance', '-', stdin=SQUARE).out.splitlines() if ',death,' in row]
    assert len(told) == len(rows) > 3
    for i, j, _, lo, *_ in rows:
        assert 0.99 * float(lo) < float(told[f'{i}-{j}']) <= float(lo), (i, j, lo, told)
    assert '>tie<' in with_births.out and with_births.out.count('id="point-') == 5  # and an alias
    assert run('tolerance', '--format', 'svg', '-', stdin='0 0\n1 0\n').out.count('not lost by any motion') == 2
    plain = run('tolerance', '--format', 'svg', '-', stdin='0 0\n8 1\n3 7\n5 3\n').out  # no tie, so no word of it
    assert '>tie<' not in plain and '>point<' in plain
    marks = [float(x) for x in re.findall('id="point-[0-9]+" d="M([0-9.]+)', plain)]
    assert marks and min(marks) > 100, marks  # none of them at the rim
    bounds = re.findall('>(?:less than ([0-9.e-]+)|([0-9.e-]+) or more)<', run('tolerance', '--format', 'svg', *AIRPORTS).out)
    (a, _), (b, _), (c, _), (_, d) = bounds
    assert float(a) < float(b) < float(c) and c == d, bounds  # no gap, no overlap
    strokes = set(re.findall(r'stroke="(#\w+)"', with_births.out))
    assert len(strokes) >= 4, strokes


main(globals())
