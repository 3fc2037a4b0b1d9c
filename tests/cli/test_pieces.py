#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel bisector and dyadel disc.

Usage: test_pieces.py COMMAND DATA
"""
import csv
import json
import math
import os
import re
import tempfile
from fractions import Fraction

import svg
from harness import expect, main, run

FIGURE_4 = '[0,1] [0,2]\n[3,5] [5,6]\n'


def rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))


def number(text):
    """A rational exactly, a root to double precision."""
    if 'sqrt' not in text:
        return Fraction(text)
    return Fraction(eval(text, {'sqrt': math.sqrt}))  # our own output


def check_decimals(row, end):
    if row[end] == 'infinite':
        assert not any(row[end + '_' + k] for k in ('x', 'y', 'xlo', 'xhi', 'ylo', 'yhi')), row
        return
    for axis in 'xy':
        exact, low, high = (row[f'{end}_{axis}{k}'] for k in ('', 'lo', 'hi'))
        slack = Fraction(0) if 'sqrt' not in exact else abs(number(exact)) / 2**50
        assert Fraction(low) - slack <= number(exact) <= Fraction(high) + slack, row
        assert Fraction(high) - Fraction(low) <= abs(number(exact)) / 2**50 + Fraction(1, 10**300), row


def test_bisector_csv():
    result = run('bisector', '-', stdin=FIGURE_4)
    expect(result, 0, '^# .*rounded down')
    table = rows(result.out)
    kinds = {far: ''.join(r['kind'][0] for r in table if r['far'] == far) for far in '01'}
    assert kinds['0'] == 'lppllpl', kinds
    assert all(r['near'] == str(1 - int(r['far'])) for r in table)
    for far in '01':
        chain = [r for r in table if r['far'] == far]
        assert chain[0]['begin'] == chain[-1]['end'] == 'infinite'
        for a, b in zip(chain, chain[1:]):
            assert [number(a['end_' + k]) for k in 'xy'] == [number(b['begin_' + k]) for k in 'xy'], (a, b)
    for row in table:
        check_decimals(row, 'begin')
        check_decimals(row, 'end')


def test_rational_ends():
    """Ends that are not dyadic are exact: 21 times as large, they give pieces 21 times as large, to the last digit."""
    def wanted(cell):
        return None if cell == '' or 'sqrt' in cell else 21 * Fraction(cell)

    for x, whole in (('[0,6/7]', '[0,18]'), ('[1/3,2/3]', '[7,14]'), ('[-1.2e1,22/7]', '[-252,66]')):
        small, large = (rows(run('bisector', '-', stdin=t).out) for t in (
            f'{x} [-1/7,1/3]\n7 1\n', f'{whole} [-3,7]\n147 21\n'))
        assert len(small) == len(large) > 4
        for a, b in zip(small, large):
            assert (a['kind'], a['corner'], a['begin']) == (b['kind'], b['corner'], b['begin'])
            for k in 'xy':
                cell = wanted(a['begin_' + k])
                assert cell is None or cell == Fraction(b['begin_' + k]), (a, b)
        assert 'dyadic' not in run('bisector', '-', stdin=f'{x} 0\n7 1\n', comments=False).err


def test_ends_are_coordinates():
    """The exact ends can be read back as points, whatever the signs."""
    for mirrored in ('[1,2] [1,3]\n[4,6] [6,7.25]\n', '[-2,-1] [-3,-1]\n[-6,-4] [-7.25,-6]\n'):
        table = rows(run('bisector', '-', stdin=mirrored).out)
        for row in table:
            check_decimals(row, 'begin')
            check_decimals(row, 'end')
        points = sorted({r['begin_x'] + ' ' + r['begin_y'] for r in table if r['begin'] != 'infinite'})
        assert any('sqrt' in p for p in points), points
        expect(run('delaunay', '-', stdin='\n'.join(points) + '\n'), 0, '^0,')


def test_bisector_json():
    result = run('bisector', '--format', 'json', '-', stdin='sqrt(2) 0\npi pi\n')
    expect(result, 0)
    data = json.loads(result.out)
    assert data['format'] == 'dyadel bisector 1' and data['outcome'] == 'decided'
    assert [c['far'] for c in data['curves']] == [0, 1]
    assert all(len(c['boundary']['chains']) == 1 for c in data['curves'])
    assert len(data['rectangles']) == 2


def test_bisector_outcomes():
    expect(run('bisector', '-', stdin='[0,2] 0\n[1,3] 0\n'), 3, '^# the rectangles meet', '^dyadel: fixpoint')
    expect(run('bisector', '--quiet', '-', stdin='0 0\n0 0\n'), 3, '^# the rectangles meet', r'\A\Z')
    close = 'sqrt(2) 0\nsqrt(2)+2^-300 0\n'
    expect(run('bisector', '-', stdin=close), 0, '^0,1,line')
    expect(run('bisector', '--max-bits', '100', '-', stdin=close), 4, '^# the rectangles meet', '^dyadel: budget')
    expect(run('bisector', '-', stdin='0 0\n'), 1, r'\A\Z', 'dyadel: -: 2 points are needed, here are 1')
    expect(run('bisector', '-', stdin='0 0\n1\n'), 1, r'\A\Z', r'\Adyadel: -:2:2')
    expect(run('bisector', '--format', 'obj', '-', stdin=FIGURE_4), 2, r'\A\Z')


def con(*args, stdin):
    result = run('disc', '--layer', 'con', *args, '-', stdin=stdin)
    return result, {r['i']: r['con'] for r in rows(result.out)}


def test_disc_of_points():
    result, where = con(stdin='0 0\n4 0\n0 4\n4 4\n2 2\n5 5\n4 -1/8\n')
    expect(result, 3, '^# orientation of 0 1 2: counter-clockwise')
    assert where == {'3': 'unknown', '4': 'inside', '5': 'outside', '6': 'outside'}, where
    circles = rows(run('disc', '-', stdin='0 0\n4 0\n0 4\n').out)
    assert [c['circle'] for c in circles] == ['FCC', 'CFC', 'CCF', 'CFF', 'FCF', 'FFC']
    for c in circles:
        assert [c[k] for k in ('x', 'y', 'radius_squared', 'xlo', 'xhi', 'ylo', 'yhi')] == ['2', '2', '8', '2', '2', '2', '2']
        assert float(c['rlo']) ** 2 < 8 < float(c['rhi']) ** 2
    assert '# partial centre within xlo 2 xhi 2 ylo 2 yhi 2\n# con of the others: inside 1, outside 2, unknown 1\n' in result.out


def test_disc_refines():
    near = '0 0\n1 0\n0 1\ncos(1)/sqrt(2)+1/2 sin(1)/sqrt(2)+1/2+2^-%d\n'
    result, where = con(stdin=near % 400)
    expect(result, 0)
    assert where == {'3': 'outside'}, where
    result, where = con('--max-bits', '200', stdin=near % 400)
    expect(result, 4, '', '^dyadel: budget')
    assert where == {'3': 'unknown'}, where


def test_disc_of_rectangles():
    result, where = con(stdin='[0,1] 0\n4 [0,1]\n[0,1] 4\n2 2\n[-9,9] 2\n20 20\n')
    expect(result, 3, '', '^dyadel: fixpoint')
    assert where == {'3': 'inside', '4': 'unknown', '5': 'outside'}, where
    data = json.loads(run('disc', '--format', 'json', '-', stdin='[0,1] 0\n4 [0,1]\n[0,1] 4\n').out)
    assert [c['labels'] for c in data['circles']] == ['FCC', 'CFC', 'CCF', 'CFF', 'FCF', 'FFC']
    box = data['partial_centre']
    for circle in data['circles']:
        for axis in 'xy':
            low, high = circle[axis + '_decimal']
            assert box[axis + '_decimal'][0] <= low <= high <= box[axis + '_decimal'][1]
        assert circle['radius_decimal'][0] > 0
    assert data['con'] == []


def test_disc_without_orientation():
    result, where = con(stdin='0 0\n1 1\n2 2\n3 0\n')
    expect(result, 3, '^# orientation of 0 1 2: unknown', '^dyadel: fixpoint')
    assert where == {'3': 'unknown'} and not rows(run('disc', '-', stdin='0 0\n1 1\n2 2\n3 0\n').out)
    expect(run('disc', '-', stdin='0 0\n1 1\n'), 1, r'\A\Z', '3 points are needed, here are 2')
    data = json.loads(run('disc', '--format', 'json', '-', stdin='0 0\n1 1\n2 2\n').out)
    assert data['circles'] == [] and data['partial_centre'] is None and data['outcome'] == 'fixpoint'


CURVE = '#0072b2'  # what lines, parabolas, circles and dots are drawn with


def strokes(text):
    """The curves of a picture, legend included, as (dashed?, path)."""
    assert 'nan' not in text and 'inf' not in text
    return [('stroke-dasharray' in p.look, p.look['d']) for p in svg.paths(text) if p.look.get('stroke') == CURVE]


def picture(command, text):
    result = run(command, '--quiet', '--format', 'svg', '-', stdin=text)
    assert result.code in (0, 3), result
    return strokes(result.out)


def round_dots(curves):
    return [d for dashed, d in curves if not dashed and 'A' in d]


def test_svg_of_bisector():
    table = rows(run('bisector', '-', stdin=FIGURE_4).out)
    curves = picture('bisector', FIGURE_4)
    dashed = [d for dash, d in curves if dash]
    full = [d for dash, d in curves if not dash and 'A' not in d]
    parabolas = [r for r in table if r['kind'] == 'parabola']
    assert sum('C' in d for d in dashed) == len(parabolas) and len(dashed) == len(parabolas) + 1, dashed
    assert len(full) == len(table) - len(parabolas) + 1, full
    dots = sum(r['begin'] != 'infinite' for r in table)
    assert len(round_dots(curves)) == dots + 2, curves
    assert not picture('bisector', '0 0\n0 0\n')  # nothing, also in the legend
    far = run('bisector', '--format', 'svg', '-', stdin='0 0\n1*2^100000 0\n')
    expect(far, 1, r'\A\Z', 'too far apart')


def test_svg_of_disc():
    text = '[0,1] 0\n4 [0,1]\n[0,1] 4\n2 2\n20 20\n'
    curves = picture('disc', text)
    assert sum(dash and 'A' in d for dash, d in curves) == 3, curves
    assert len(round_dots(curves)) == 3 + 6 + 2, curves
    assert not round_dots(picture('disc', '0 0\n1 1\n2 2\n3 0\n'))
    flat = picture('disc', '0 0\n1 0\n2 1*2^-20\n3 0\n')  # large circles: the parts in the picture
    assert sum(dash and d.count('L') > 9 for dash, d in flat) == 3, flat
    for flatter in ('1*2^-200', '1*2^-100000'):
        result = run('disc', '--format', 'svg', '-', stdin=f'0 0\n1 0\n2 {flatter}\n')
        expect(result, 1, r'\A\Z', 'too large for a picture')


def test_pdf_and_png():
    for command in ('bisector', 'disc'):
        for kind, magic in (('pdf', b'%PDF'), ('png', b'\x89PNG')):
            with tempfile.TemporaryDirectory() as folder:
                name = os.path.join(folder, 'x.' + kind)
                result = run(command, '-', '--quiet', '--format', kind, '-o', name, stdin='[0,1] 0\n4 1\n1 4\n')
                assert result.code in (0, 3), result
                with open(name, 'rb') as f:
                    assert f.read(4) == magic


main(globals())
