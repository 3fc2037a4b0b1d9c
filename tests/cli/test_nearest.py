#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel nearest: answers, outcomes, exit statuses, formats and messages.

Usage: test_nearest.py COMMAND DATA
"""
import csv
import json
import os
import re
import xml.etree.ElementTree

from harness import DATA, expect, main, run

SITES = '0 0\n2*sqrt(2) 0\n0 10\n0 0\n10 10\n'
ALIAS = r'\A# alias 3 0\ni,status\n'

# (options, X, Y, exit status, standard output, standard error)
CASES = [
    ('', '1', '1', 0, ALIAS + r'0,sure\n\Z', r'\A\Z'),
    ('', '-1', '-22/7', 0, ALIAS + r'0,sure\n\Z', r'\A\Z'),
    ('', 'sqrt(2)', 'pi', 4, ALIAS + r'0,possible\n1,possible\n\Z', r'\Adyadel: budget: 2 possibly nearest; .*--max-bits'),
    ('--quiet', 'sqrt(2)', 'pi', 4, ALIAS + r'0,possible\n1,possible\n\Z', r'\A\Z'),
    ('', 'sqrt(2)+2^-3000', 'pi', 0, ALIAS + r'1,sure\n\Z', r'\A\Z'),
    ('--max-bits 2000', 'sqrt(2)+2^-3000', 'pi', 4, ALIAS + r'0,possible\n1,possible\n\Z', ''),
    ('', '5', '123/7', 3, ALIAS + r'2,possible\n4,possible\n\Z', r'\Adyadel: fixpoint: 2 possibly nearest'),
    ('', '[0,1]', '5', 3, ALIAS + r'0,possible\n2,possible\n\Z', ''),
    ('', '0.5+-0.25', '1', 0, ALIAS + r'0,sure\n\Z', ''),
    ('', '1+', '2', 2, r'\A\Z', r'\Adyadel: X "1\+", column 3: '),
    ('', '1', 'log(0)', 2, r'\A\Z', r'\Adyadel: Y "log\(0\)", column 1: '),
    ('', '1', 'log(sqrt(2)-sqrt(2))', 1, r'\A\Z', r'\Adyadel: .*log'),
    ('--format obj', '1', '1', 2, r'\A\Z', 'nearest does not write obj'),
    ('--until area:3', '1', '1', 2, r'\A\Z', 'nearest does not take --until'),
]


def test_cases():
    for options, x, y, code, out, err in CASES:
        try:
            expect(run('nearest', *options.split(), '-', x, y, stdin=SITES), code, out, err)
        except AssertionError as problem:
            raise AssertionError(f'{options} {x} {y}: {problem}') from problem


def test_arguments():
    expect(run('nearest', '-', '1', stdin=SITES), 2, r'\A\Z', 'an argument is missing')
    expect(run('nearest', '-', '1', '2', '3', stdin=SITES), 2, r'\A\Z', 'one argument too many')
    expect(run('nearest', 'nowhere', '1', '2'), 1, r'\A\Z', 'nowhere: cannot open')
    expect(run('nearest', '-', '1', '2', stdin=''), 3, r'\Ai,status\n\Z', 'fixpoint: 0 possibly')


def test_measured():
    """A rectangle at each site: the two are as near as each other to the middle, and not elsewhere."""
    expect(run('nearest', '--measured', '-', '5', '0', stdin='0 0\n10 0\n'), 3, r'\Ai,status\n0,possible\n1,possible\n\Z')
    expect(run('nearest', '--measured', '-', '4', '0', stdin='0 0\n10 0\n'), 0, r'\Ai,status\n0,sure\n\Z')
    expect(run('nearest', '--radius', '2', '-', '4', '0', stdin='0 0\n10 0\n'), 3, r'\Ai,status\n0,possible\n1,')


def test_json():
    result = run('nearest', '--format', 'json', '-', '1/3', '0.5', stdin=SITES)
    expect(result, 0)
    answer = json.loads(result.out)
    assert answer['format'] == 'dyadel nearest 1' and answer['outcome'] == 'decided', answer
    assert answer['x'] == ['1/3', '1/3'] and answer['y'] == ['1*2^-1', '1*2^-1'], answer
    assert answer['nearest'] == [{'i': 0, 'status': 'sure'}] and answer['aliases'] == [[3, 0]], answer


def svg_of(*args, stdin):
    result = run('nearest', '--format', 'svg', *args, stdin=stdin)
    return result, xml.etree.ElementTree.fromstring(result.out)


def fills(root):
    """Whether cairo writes them as attributes or within styles."""
    text = xml.etree.ElementTree.tostring(root, encoding='unicode')
    return {rgb.replace(' ', '') for rgb in re.findall(r'fill(?:="|: ?)(rgb\([^)]*\))', text)}


def test_picture():
    """Sure ones are blue, possible ones vermillion, the band is there when it has an area."""
    blue, vermillion = 'rgb(0%,44.705882%,69.803922%)', 'rgb(83.529412%,36.862745%,0%)'
    band = 'rgb(90.196078%,62.352941%,0%)'
    result, root = svg_of('-', '1', '1', stdin=SITES)
    expect(result, 0, '', r'\A\Z')
    assert blue in fills(root) and vermillion not in fills(root), fills(root)
    result, root = svg_of('--radius', '2', '-', '5', '0', stdin='0 0\n10 0\n')
    expect(result, 3, '', 'fixpoint: 2 possibly nearest')
    assert {vermillion, band} <= fills(root), fills(root)
    for text, x, y, code in (('', '0', '0', 3), ('1 1\n', '1', '1', 0), ('[0,9] [0,9]\n1 1\n', '[2,3]', '4', 3),
                             ('1e-300 0\n-1e-300 0\n', '0', '1', 3)):
        result = run('nearest', '--quiet', '--format', 'svg', '-', x, y, stdin=text)
        expect(result, code, '</svg>', r'\A\Z')
    expect(run('nearest', '--format', 'svg', '-', '1', '1', stdin='1e300 0\n-1e308 1e308\n'), 0, '</svg>')
    expect(run('nearest', '--format', 'svg', '-', '1', '1', stdin='1e400 0\n'), 1, r'\A\Z', 'use csv or json')
    expect(run('nearest', '--format', 'pdf', '-', '1', '1', stdin=SITES, binary=True), 0, r'\A%PDF')
    expect(run('nearest', '--format', 'png', '-', '1', '1', stdin=SITES, binary=True), 0, r'\A.PNG')


def test_hull():
    """The hull in delaunay --format json: an exact point in the middle of a side is possible, its pairs are ties."""
    text = '0 0\n2 0\n1 0\n[1,3] 4\n1 1\n[0,4] [-1,-0.5]\n'
    hull = json.loads(run('delaunay', '--quiet', '--format', 'json', '-', stdin=text[:text.rindex('[0,4]')]).out)['hull']
    assert hull['sure_vertices'] == [0, 1, 3] and hull['possible_vertices'] == [0, 1, 2, 3] and not hull['capped'], hull
    edges = {(e['i'], e['j']): e['status'] for e in hull['edges']}
    assert edges == {(0, 1): 'tie', (0, 2): 'tie', (1, 2): 'tie', (0, 3): 'legal', (1, 3): 'legal'}, edges
    hull = json.loads(run('delaunay', '--quiet', '--format', 'json', '-', stdin=text).out)['hull']
    assert hull['sure_vertices'] == [0, 3, 5] and hull['possible_vertices'] == [0, 1, 3, 5], hull


def test_airports():
    """Against all distances; the coordinates are decimals, exact as integers of 10^-20 degrees."""
    path = os.path.join(DATA, 'airports.csv')
    with open(path, encoding='utf-8', newline='') as file:
        rows = list(csv.DictReader(file))

    def whole(text):
        sign = -1 if text.startswith('-') else 1
        head, _, tail = text.lstrip('-').partition('.')
        assert 'e' not in tail and len(tail) <= 20, text
        return sign * int((head or '0') + tail.ljust(20, '0'))

    sites = [(whole(row['longitude']), whole(row['latitude'])) for row in rows]
    for x, y in [('-75.5', '40.25'), ('-150', '61.2'), ('0', '0'), ('-98.35', '39.5')]:
        away = [(px - whole(x)) ** 2 + (py - whole(y)) ** 2 for px, py in sites]
        nearest = away.index(min(away))
        expect(run('nearest', '--columns', 'longitude,latitude', path, x, y), 0, rf'^{nearest},sure\n\Z')


main(globals())
