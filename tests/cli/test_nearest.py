#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel nearest: answers, outcomes, exit statuses, formats and messages.

Usage: test_nearest.py COMMAND DATA
"""
import csv
import decimal
import gzip
import json
import math
import os
import pathlib
import random
import re
import tempfile
from fractions import Fraction

import svg
from harness import DATA, cases, expect, main, run

SITES = '0 0\n2*sqrt(2) 0\n0 10\n0 0\n10 10\n'
HEAD = r'# rounding: lo down, hi up; empty: beyond doubles\ni,status,lo,hi\n'
ALIAS = r'\A# alias 3 0\n' + HEAD
TIE = r'\A# alias 3 0\n# tie {}\n' + HEAD

# (options, X, Y, exit status, standard output, standard error)
CASES = [
    ('', '1', '1', 0, ALIAS + r'0,certain,\S+\n\Z', r'\A\Z'),
    ('', '-1', '-22/7', 0, ALIAS + r'0,certain,\S+\n\Z', r'\A\Z'),
    ('', 'sqrt(2)', 'pi', 3, TIE.format('0 1') + r'0,possible,\S+\n1,possible,\S+\n\Z',
     r'\Adyadel: fixpoint: 2 possibly nearest; .*equally far, a tie$'),
    ('--ties prove', 'sqrt(2)', 'pi', 3, TIE.format('0 1'), ''),
    ('--ties off', 'sqrt(2)', 'pi', 4, ALIAS + r'0,possible,\S+\n1,possible,\S+\n\Z', r'\Adyadel: budget: 2 possibly nearest; .*--max-bits'),
    ('--tie-bits 16', 'cbrt(2+sqrt(5))+cbrt(2-sqrt(5))-1+sqrt(2)', 'pi', 4, ALIAS + r'0,possible,\S+\n1,possible,\S+\n\Z', 'budget: 2'),
    ('--tie-bits 4096', 'cbrt(2+sqrt(5))+cbrt(2-sqrt(5))-1+sqrt(2)', '3', 3, TIE.format('0 1'), 'fixpoint: 2'),
    ('', 'tan(atan(sqrt(2)))', 'pi', 4, ALIAS + r'0,possible,\S+\n1,possible,\S+\n\Z', 'budget: 2'),
    ('--quiet --ties off', 'sqrt(2)', 'pi', 4, ALIAS + r'0,possible,\S+\n1,possible,\S+\n\Z', r'\A\Z'),
    ('', 'sqrt(2)+2^-3000', 'pi', 0, ALIAS + r'1,certain,\S+\n\Z', r'\A\Z'),
    ('--max-bits 2000', 'sqrt(2)+2^-3000', 'pi', 4, ALIAS + r'0,possible,\S+\n1,possible,\S+\n\Z', ''),
    ('', '5', '123/7', 3, TIE.format('2 4') + r'2,possible,\S+\n4,possible,\S+\n\Z', r'\Adyadel: fixpoint: 2 possibly nearest'),
    ('', '[0,1]', '5', 3, ALIAS + r'0,possible,\S+\n2,possible,\S+\n\Z', ''),
    ('', '0.5+-0.25', '1', 0, ALIAS + r'0,certain,\S+\n\Z', ''),
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
    expect(run('nearest', '-', '1', '2', stdin=''), 3, r'\A' + HEAD + r'\Z', 'fixpoint: 0 possibly')


def test_measured():
    """A rectangle at each site: the two are as near as each other to the middle, and not elsewhere."""
    expect(run('nearest', '--measured', '-', '5', '0', stdin='0 0\n10 0\n'), 3, HEAD + r'0,possible,\S+\n1,possible,\S+\n\Z')
    expect(run('nearest', '--measured', '-', '4', '0', stdin='0 0\n10 0\n'), 0, HEAD + r'0,certain,\S+\n\Z')
    expect(run('nearest', '--radius', '2', '-', '4', '0', stdin='0 0\n10 0\n'), 3, HEAD + r'0,possible,\S+\n1,')


def test_json():
    result = run('nearest', '--format', 'json', '-', '1/3', '0.5', stdin=SITES)
    expect(result, 0)
    answer = json.loads(result.out)
    assert answer['format'] == 'dyadel nearest 1' and answer['outcome'] == 'decided', answer
    assert answer['x'] == ['1/3', '1/3'] and answer['y'] == ['1*2^-1', '1*2^-1'], answer
    nearest, = answer['nearest']
    assert nearest['i'] == 0 and nearest['status'] == 'certain' and answer['aliases'] == [[3, 0]], answer
    assert answer['tied'] is False
    low, high = nearest['distance']
    assert Fraction(low)**2 <= Fraction(13, 36) <= Fraction(high)**2 and high - low < 1e-15, nearest


def test_tied():
    """The centre of regular polygons, at once; in csv and json, of one place and of many, exact or not."""
    for n in (4, 12, 100):
        gon = ''.join(f'cos(2*pi*{k}/{n})+1/3 sin(2*pi*{k}/{n})-sqrt(2)\n' for k in range(n)) + '7 8\n'
        result = run('nearest', '-', '1/3', '0-sqrt(2)', stdin=gon)
        corners = list(range(n))
        expect(result, 3, r'\A# tie ' + ' '.join(map(str, corners)) + r'\n# rounding', f'fixpoint: {n} possibly nearest; .* a tie$')
        assert [(int(r['i']), r['status']) for r in rows(result.out)] == [(k, 'possible') for k in corners]
        answer = json.loads(run('nearest', '--format', 'json', '-', '1/3', '0-sqrt(2)', stdin=gon).out)
        assert answer['outcome'] == 'fixpoint' and answer['tied'] is True, answer
        assert [(p['i'], p['status']) for p in answer['nearest']] == [(k, 'possible') for k in corners]
    places = '1/3 -sqrt(2)\n1/3 -sqrt(2)+2^-900\n7 0\n[0,1] -sqrt(2)\n'
    result = ask(places, points=gon, code=4)
    assert [line for line in result.out.splitlines() if 'tie' in line] == ['# tie 0: ' + ' '.join(map(str, corners))]
    answer = json.loads(ask(places, '--format', 'json', points=gon, code=4).out)
    assert [(p['outcome'], p['tied']) for p in answer['places']] == [
        ('fixpoint', True), ('decided', False), ('decided', False), ('budget', False)], answer['places']
    named = 'id,x,y\na,0,0\nb,2,0\nc,0,2\nd,2,2\n'
    expect(run('nearest', '--columns', 'x,y', '--id', 'id', '-', '1', '1', stdin=named), 3, r'\A# tie 0 1 2 3\n.*\n.*\n0,.*,a$')
    expect(run('nearest', '--measured', '-', '5', '0', stdin='0 0\n10 0\n'), 3, r'\A# rounding')
    expect(run('nearest', '-', '5', '0', stdin='0 0\n[10,10] 0\n'), 3, r'\A# tie 0 1\n')


def svg_of(*args, stdin):
    result = run('nearest', '--format', 'svg', *args, stdin=stdin)
    return result, {p.look['fill'] for p in svg.paths(result.out)}


def test_picture():
    """Sure ones are blue, possible ones vermillion, the band is there when it has an area."""
    blue, vermillion, band = '#0072b2', '#d55e00', '#e69f00'
    result, fills = svg_of('-', '1', '1', stdin=SITES)
    expect(result, 0, '', r'\A\Z')
    assert blue in fills and vermillion not in fills, fills
    result, fills = svg_of('--radius', '2', '-', '5', '0', stdin='0 0\n10 0\n')
    expect(result, 3, '', 'fixpoint: 2 possibly nearest')
    assert {vermillion, band} <= fills, fills
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
        expect(run('nearest', '--columns', 'longitude,latitude', path, x, y), 0, rf'^{nearest},certain,\S+\n\Z')


# ---- many places ----

def rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))


def ask(places, *options, points, code=0):
    """One run for all places; standard input has the points."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, 'places')
        with open(name, 'w', encoding='utf-8') as f:
            f.write(places)
        result = run('nearest', '--queries', name, *options, '-', stdin=points)
    expect(result, code)
    return result


def test_places_agree_with_single_questions():
    """Places of all forms: each answer is that of a run of its own, when points need no refinement."""
    places = ['1 1', '5 123/7', '[0,1] 5', '0.5+-0.25 1', '[-20,20] [-20,20]', '1e3 -1e3', '1*2^-70 5']
    points = '0 0\n3 0\n0 10\n0 0\n10 10\n'
    many = rows(ask('# places\n' + '\n'.join(places) + '\n', points=points, code=3).out)
    assert {int(r['q']) for r in many} == set(range(len(places)))
    for q, place in enumerate(places):
        alone = rows(run('nearest', '--quiet', '-', *place.split(), stdin=points).out)
        assert alone == [{k: r[k] for k in ('i', 'status', 'lo', 'hi')} for r in many if r['q'] == str(q)], place


def test_places_against_all_distances():
    """Exact points and places: brute force, ties included; bounds of the distance hold and are sharp."""
    chance = random.Random(5)
    points = [(chance.randrange(40), chance.randrange(40)) for _ in range(150)]
    places = [(Fraction(chance.randrange(160), 4), Fraction(chance.randrange(160), 4)) for _ in range(300)]
    text = ''.join(f'{x} {y}\n' for x, y in places)
    result = ask(text, points=''.join(f'{x} {y}\n' for x, y in points), code=3)
    found = {}
    for r in rows(result.out):
        found.setdefault(int(r['q']), []).append(r)
    ties = 0
    for q, (x, y) in enumerate(places):
        square = [(x - a)**2 + (y - b)**2 for a, b in points]
        least = min(square)
        nearest = {points[i]: i for i in reversed(range(len(points))) if square[i] == least}  # aliases: the lowest
        assert sorted(nearest.values()) == [int(r['i']) for r in found[q]], (q, x, y)
        ties += len(nearest) > 1
        for r in found[q]:
            assert r['status'] == ('certain' if len(nearest) == 1 else 'possible'), r
            low, high = Fraction(r['lo']), Fraction(r['hi'])
            assert low**2 <= least <= high**2 and high - low <= Fraction(1, 10**14), r
    told = [line.split()[2] for line in result.out.splitlines() if line.startswith('# tie ')]
    assert told == [f'{q}:' for q in sorted(found) if len(found[q]) > 1]
    assert ties and f'fixpoint: {ties} of 300 places have no certain nearest point' in result.err, (ties, result.err)


def test_places_as_json():
    result = ask('1 1\nsqrt(3) 1/3\n', '--format', 'json', points=SITES)
    answer = json.loads(result.out)
    assert answer['format'] == 'dyadel nearest places 1' and answer['outcome'] == 'decided', answer
    assert [p['q'] for p in answer['places']] == [0, 1] and answer['aliases'] == [[3, 0]]
    assert answer['places'][0]['x'] == ['1', '1'] and answer['places'][1]['nearest'][0]['status'] == 'certain'


def test_refined_places():
    """Points and places narrow until each is certain, or a tie; a budget leaves the others as they are."""
    places = 'sqrt(2)+2^-3000 pi\nsqrt(2) pi\n1 1\n'
    for options, code in (((), 3), (('--ties', 'off'), 4)):
        many = rows(ask(places, *options, points=SITES, code=code).out)
        assert [(r['q'], r['i'], r['status']) for r in many] == [
            ('0', '1', 'certain'), ('1', '0', 'possible'), ('1', '1', 'possible'), ('2', '0', 'certain')], many


def test_discs():
    """All discs that are possibly nearest, by brute force in decimals of 80 digits [DISC-6]; ends that touch count."""
    chance, near = random.Random(3), 0
    decimal.getcontext().prec = 80
    for case in range(cases(150)):
        span = chance.choice((3, 6, 40))
        discs = [tuple(chance.randint(-span, span) for _ in 'xy') + (chance.choice((0, 1, 1, 2, 3)),) for _ in range(chance.randint(1, 7))]
        at = chance.randint(-span, span), chance.randint(-span, span)
        far = [decimal.Decimal((x - at[0])**2 + (y - at[1])**2).sqrt() for x, y, _ in discs]
        least = min(d + r for d, (_, _, r) in zip(far, discs))
        want = {k for k, (d, (_, _, r)) in enumerate(zip(far, discs)) if max(0, d - r) <= least + decimal.Decimal('1e-60')}
        first = {}
        for k, disc in enumerate(discs):
            if disc[2] == 0:
                first.setdefault(disc, k)
        want = {first.get(discs[k], k) for k in want}  # equal exact points are one
        text = 'x,y,r\n' + ''.join('%d,%d,%d\n' % disc for disc in discs)
        words = '--columns', 'x,y', '--radius-column', 'r', '-', *map(str, at)
        answer = rows(run('nearest', '--discs', *words, stdin=text).out)
        assert {int(r['i']) for r in answer} == want, (discs, at, want, answer)
        assert all((r['status'] == 'certain') == (len(want) == 1) for r in answer)
        for r in answer:
            k = int(r['i'])
            lo, hi = max(0, far[k] - discs[k][2]), far[k] + discs[k][2]
            assert decimal.Decimal(r['lo']) <= lo <= decimal.Decimal(r['lo']) + decimal.Decimal('1e-9'), (r, lo)
            assert decimal.Decimal(r['hi']) - decimal.Decimal('1e-9') <= hi <= decimal.Decimal(r['hi']), (r, hi)
        near += len(want) < len(rows(run('nearest', *words, stdin=text).out))
    assert near > cases(150) // 20, near
    expect(run('nearest', '--discs', '-', '1', '1', stdin='[0,1] [0,2]\n3 4\n'), 1, r'\A\Z', 'a disc needs one radius')
    with tempfile.TemporaryDirectory() as folder:
        near = ('nearest', '--discs', '--radius', '1', '--certificate', 'c', '-', '1', '1')
        expect(run(*near, stdin='3 4\n6 6\n', cwd=folder), 0, 'certain')
        expect(run('verify', 'c', cwd=folder), 0, 'all of it proved(.|\n)*points in 2 discs(.|\n)*1 of 1 places')
        expect(run(*near, stdin='3 4\n4 3\n', cwd=folder), 3, 'possible')
        expect(run('verify', 'c', cwd=folder), 0, 'the outcome fixpoint')


EARTH = 6371008.8


def arc(p, q):
    """Metres along the ground, in doubles."""
    (l, f), (m, g) = (map(math.radians, x) for x in (p, q))
    return 2 * EARTH * math.asin(min(1, math.sqrt(math.sin((f - g) / 2)**2 + math.cos(f) * math.cos(g) * math.sin((l - m) / 2)**2)))


# (options, points, X, Y, exit status, points found)
GLOBE = [
    ('', '0 0\n10 0\n0 90\n', '5', '0', 3, '0 1'), ('', '0 0\n10 0\n0 90\n', '1/3', '2', 0, '0'),
    ('', '170 0\n-170 1\n', '180', '1', 0, '1'), ('', '170 0\n-170 0\n', '-180', '60', 3, '0 1'),
    ('', '0 60\n180 60\n0 0\n', '77', '90', 3, '0 1'), ('', '12 90\n0 89\n-50 90\n', '5', '89.9', 0, '0'),
    ('', '0 1\n120 1\n240 1\n0 -1\n', '9', '-90', 0, '3'), ('', '0 30\n90 0\n', '180', '-30', 0, '1'),
    ('', '1 2^-300\n-1 0\n', '0', '1', 0, '0'), ('--max-bits 90', '1 2^-300\n-1 0\n', '0', '1', 4, '0 1'),
    ('', '1 10^-40/7\n-1 10^-40/11\n', '0', '1', 0, '0'), ('', 'sqrt(4) 1\n-2 1\n', '0', '7', 3, '0 1'),
    ('', '0 0\n90 0\n180 0\n', '0', '90', 3, '0 1 2'), ('', 'sqrt(2) 0\n-sqrt(2)-2^-500 0\n', '0', '1', 0, '0'),
    ('--radius 30km', 'sqrt(2) 0\n-sqrt(2) 0\n30 0\n', '0', '0', 3, '0 1'), ('--radius 1deg', 'sqrt(2) 0\n-sqrt(2) 0\n30 0\n', '0', '0', 3, '0 1'),
    ('', '[0,350] 80\n0 -80\n', '355', '60', 0, '0'), ('', '[-170,170] [50,89]\n180 -80\n', '180', '10', 3, '0 1')]


def test_sphere():
    """Along the ground: ties that sums of roots of unity prove, poles, the date line, regions of degrees and of metres [SPH-6]."""
    for options, points, x, y, code, want in GLOBE:
        result = run('nearest', '--sphere', *options.split(), '-', x, y, stdin=points)
        expect(result, code, r'^i,status,lo,hi\n', '')
        assert ' '.join(r['i'] for r in rows(result.out)) == want, (points, x, y, result.out)
        if code == 3 and not options and '[' not in points:
            assert 'equally far, a tie' in result.err, result.err
    half = rows(run('nearest', '--sphere', '-', '180', '0', stdin='0 0\n').out)[0]
    assert float(half['lo']) <= math.pi * EARTH <= float(half['hi']) <= float(half['lo']) + 1e-6
    whole = json.loads(run('nearest', '--sphere', '--format', 'json', '-', '5', '0', stdin='0 0\n10 0\n370 0\n').out)
    assert (whole['surface'], whole['distance_unit'], whole['tied'], whole['aliases']) == ('sphere', 'm', True, [[2, 1]])


def test_regions_on_sphere():
    """Bounds hold for all samples of a region, and are reached by some of them, also between its corners."""
    chance = random.Random(5)
    for _ in range(cases(60)):
        lo, south = chance.uniform(-180, 180), chance.uniform(-90, 89)
        wide, high = chance.choice((0, 1, 50, 200, 360)), chance.choice((0, 1, 90 - south, min(40, 90 - south)))
        at = chance.uniform(-180, 180), chance.choice((chance.uniform(-90, 90), 90, south))
        box = f'[{lo!r},{lo + wide!r}] [{south!r},{min(south + high, 90)!r}]\n'
        r = rows(run('nearest', '--sphere', '-', repr(at[0]), repr(at[1]), stdin=box).out)[0]
        lon = [lo + wide * k / 100 for k in range(101)] + [x for x in (at[0] + 360 * k for k in range(-2, 3)) if lo <= x <= lo + wide]
        lat = [min(90, south + high * k / 200) for k in range(201)]
        far = [arc(at, (x, y)) for x in lon for y in lat]
        assert float(r['lo']) - 0.5 <= min(far) and max(far) <= float(r['hi']) + 0.5, (box, at, r)
        assert min(far) <= float(r['lo']) + 150000 and float(r['hi']) - 150000 <= max(far), (box, at, r, min(far), max(far))


def test_queries_on_sphere():
    """The index finds what looking at all finds; places are tables, too; traces are taken up again."""
    chance = random.Random(7)
    with open(os.path.join(DATA, 'airports.csv'), encoding='utf-8') as f:
        airports = [(float(r['longitude']), float(r['latitude'])) for r in csv.DictReader(f)][::9]
    places = [(round(chance.uniform(-180, 180), 3), round(chance.uniform(-90, 90), 3)) for _ in range(60)]
    points = ''.join(f'{x!r} {y!r}\n' for x, y in airports)
    for options, radius in (((), 0), (('--radius', '300km'), 300000)):
        found = {}
        for r in rows(ask(''.join(f'{x} {y}\n' for x, y in places), '--quiet', '--sphere', *options, points=points,
                          code=3 if radius else 0).out):
            found.setdefault(int(r['q']), set()).add(int(r['i']))
        for q, at in enumerate(places):
            far = [arc(at, p) for p in airports]
            want = {k for k, d in enumerate(far) if d - radius <= min(far) + radius}
            doubt = {k for k, d in enumerate(far) if abs(d - min(far) - 2 * radius) < 1e-3}
            assert found[q] ^ want <= doubt and found[q], (q, found[q], want)
    for words, message in ((('--discs',), '--discs is about the plane; remove --discs or --sphere'),
                           (('--plane',), 'contradict'),
                           (('--radius', '3'), 'has no unit'), (('--format', 'svg'), 'on a sphere nearest writes csv and json')):
        expect(run('nearest', '--sphere', *words, '-', '1', '1', stdin='1 1\n'), 2, r'\A\Z', message)
    expect(run('nearest', '--sphere', '-', '1', '91', stdin='1 1\n'), 1, r'\A\Z', 'the latitude is beyond 90 degrees')
    expect(ask('1 1\n1 91\n', '--sphere', points='1 1\n', code=1), 1, '', 'places:2:3: the latitude is beyond')
    expect(ask('1 1\n1 sqrt(8283)\n', '--sphere', points='1 1\n', code=1), 1, '', 'place 1 of .*places: the latitude')
    expect(run('nearest', '--sphere', '-', '1', '1', stdin='1 91\n'), 1, r'\A\Z', '-:1:3: the latitude is beyond 90 degrees')
    expect(run('nearest', '--sphere', '-', '1', '1', stdin=''), 3, r'^i,status,lo,hi\n\Z', '')


def test_wrong_places():
    expect(run('nearest', '--queries', '-', '-', stdin='1 1\n'), 2, r'\A\Z', 'cannot both come from standard input')
    expect(run('nearest', '--queries', 'nowhere', '-', stdin='1 1\n'), 1, r'\A\Z', 'nowhere: cannot open')
    expect(run('nearest', '--queries', 'nowhere', '-', '1', stdin='1 1\n'), 2, r'\A\Z', 'give dyadel nearest FILE$')
    expect(ask('1 1\n1\n', points='1 1\n', code=1), 1, r'\A\Z', r'places:2:2: ')
    expect(ask('1 1\nlog(sqrt(2)-sqrt(2)) 0\n', points='1 1\n', code=1), 1, '', 'place 1 of .*places: .*log')
    expect(ask('', points='1 1\n'), 0, r'\nq,i,status,lo,hi\n\Z', r'\Adyadel: \S+places: this file has no points\n\Z')
    expect(ask('1 1\n', points='', code=3), 3, r'\nq,i,status,lo,hi\n\Z', '1 of 1 places have no certain nearest point')


def test_hundred_thousand_places():
    """One triangulation answers them all; each found airport is nearer than its neighbours in the file."""
    chance = random.Random(1)
    places = [(round(chance.uniform(-125, -67), 4), round(chance.uniform(25, 49), 4)) for _ in range(100000)]
    with open(os.path.join(DATA, 'airports.csv'), encoding='utf-8') as f:
        airports = [(float(r['longitude']), float(r['latitude'])) for r in csv.DictReader(f)]
        f.seek(0)
        text = f.read()
    found = rows(ask(''.join(f'{x} {y}\n' for x, y in places), '--quiet', '--columns', 'longitude,latitude',
                     points=text).out)
    assert [int(r['q']) for r in found] == list(range(100000))
    for q in range(0, 100000, 997):
        x, y = places[q]
        least = min((x - a)**2 + (y - b)**2 for a, b in airports)
        assert float(found[q]['lo'])**2 <= least * (1 + 1e-12) and least <= float(found[q]['hi'])**2 * (1 + 1e-12)


def test_queries_of_any_form():
    """Places may be what points may be: tables with columns of their own, without a header, packed, with names; numbers are
    those of rows."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / 's.csv').write_text('id,x,y\nA,12,5\nB,3,8\n')
        given = ('nearest', 's.csv', '--columns', 'x,y', '--id', 'id', '--queries', '-')
        plain = run(*given, stdin='11 5\n4 7\n', cwd=folder)
        expect(plain, 0, r'^q,i,status,lo,hi,id\n0,0,certain,1,1,A\n1,1,certain,.*,B\n\Z', r'\A\Z')
        for text, options in (('x,y\n11,5\n4,7\n', ()), ('cust;y;x\nc;5;11\nd;7;4\n', ()), ('c 11 5\nd 4 7\n', ('--query-columns', '2,3')),
                              ('lat|lon\n5|11\n7|4\n', ('--query-columns', 'lon,lat')), ('# x y\n11 5\n4 7\n', ())):
            for data in (text.encode(), gzip.compress(text.encode())):
                assert run(*given, *options, stdin=data, cwd=folder) == plain, (text, options)
            (path / 'q').write_text(text)
            assert run(*given[:-1], 'q', *options, cwd=folder) == plain, (text, options)
        named = ('--query-columns', 'x,y', '--query-id', 'who')
        got = run(*given, *named, '--skip-missing', stdin='who;x;y\n"c, d";11;5\ne;-;7\n;4;7\n', cwd=folder)
        expect(got, 0, r'^q,id_q,i,status,lo,hi,id\n0,"c, d",0,certain,1,1,A\n2,"?"?,1,certain,.*,B\n\Z', r'\Adyadel: -: 1 of 3 rows are skipped')
        whole = json.loads(run(*given, *named, '-q', '--format', 'json', stdin='who;x;y\nc;11;5\n', cwd=folder).out)
        assert [(p['q'], p['id_q']) for p in whole['places']] == [(0, 'c')]
        for text, options, message in (
                ('cust;lon;lat\nc;11;5\n', (), r'-:1:1: this line is a header and no point; name the columns of x and y: --query-columns lon,lat \(it has: cust, lon, lat\)$'),
                ('cust;lon;lat\nc;11;5\n', ('--query-columns', 'lon,latt'), r'-:1:1: no column is called "latt"; .* to --query-columns$'),
                ('x;y\n11;5\n', ('--query-id', 'who'), r'-:1:1: no column is called "who"; .* to --query-id$'),
                ('x,y\n1,b\n', (), '-:2:3: the name'), ('1 2\n3 b\n', (), '-:2:3: the name'),
                ('{"type":"Feature"}', (), r'the file is GeoJSON; give ogr2ogr .* \| dyadel nearest FILE --query-columns X,Y --queries -$')):
            expect(run(*given, *options, stdin=text, cwd=folder), 1, r'\A\Z', message)
        for option in ('--query-id', '--query-columns'):
            expect(run('nearest', 's.csv', '--columns', 'x,y', '1', '2', option, 'x,y', cwd=folder), 2, '', f'{option} is about a file of places; give --queries FILE$')
        expect(run(*given[:-1], '.', cwd=folder), 1, '', 'is a directory')


main(globals())
