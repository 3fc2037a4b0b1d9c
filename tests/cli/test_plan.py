#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel plan: the statement is proved again by delaunay; parts, accuracies, messages.

Usage: test_plan.py COMMAND DATA
"""
import csv
import fractions
import json
import os
import pathlib
import random
import re
import sys
import tempfile

from harness import DATA, cases, count, expect, few, main, run

POINTS = '0 0\n10 0\n5+-0.5 3\n5 -6+-4\n'
AIRPORTS = os.path.join(DATA, 'airports.csv')


def rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))


def test_small():
    expect(run('plan', '-', stdin=POINTS), 0,
           r'\A# plan 1 points: sufficient if each new position is within half_width_needed of the old one; verified\n'
           r'rank,i,half_width_now,half_width_needed,pairs_decided,pairs_left\n1,3,4,2\.25,2,0\n\Z', r'\A\Z')
    expect(run('plan', '-', stdin='0 0\n1 0\n0 1\n'), 0, r'\A# plan 0 points: sufficient.*\nrank,[^\n]*\n\Z', r'\A\Z')
    expect(run('plan', '-', stdin=''), 0, r'\A# plan 0 points')


def test_numbers_as_typed():
    """Multiples of the accuracy are decimals of 6 digits at most, not 2.87999."""
    result = run('plan', '--columns', 'east,north', '--radius-column', 'accuracy', '--accuracy', '0.02', f'{DATA}/gps.csv')
    needed = [r['half_width_needed'] for r in rows(result.out)]
    assert needed[0] == '2.88' and all(len(n.lstrip('0.').replace('.', '')) <= 6 for n in needed), needed
    assert not any('999' in n for n in needed), needed


def test_accuracy_that_is_not_enough():
    expect(run('plan', '--accuracy', '3.9', '-', stdin=POINTS), 3, r'\A# plan \d points: not sufficient, 2 of 2 pairs stay undecided\n',
           'finer --accuracy')
    expect(run('plan', '--accuracy', '3.9', '--quiet', '-', stdin=POINTS), 3, r'\A# plan', r'\A\Z')


def test_what_rows_do_not_say():
    """A pair that ties at the centres, points that coincide there, rows that alone decide nothing."""
    tied = '39 1\n60 0\n[39,43] [57,61]\n[-1,1] [39,41]\n19 21\n'
    expect(run('plan', '-', stdin=tied), 0, '', 'the pair 0,3 ties at the centres.*measurement')
    assert 'sufficient' not in run('plan', '-', stdin=tied).err
    expect(run('plan', '--quiet', '-', stdin=tied), 0, '', r'\A\Z')
    twice = '0 0\n10 0\n5+-1 5+-1\n5+-1 5+-1\n5 12\n'
    result = run('plan', '--accuracy', '0.5', '-', stdin=twice)
    assert 'points 2 and 3 have the same centre' in result.err and '--merge' in result.err, result.err
    assert 'finer --accuracy' not in result.err
    result = run('plan', '--columns', 'east,north', '--radius-column', 'accuracy', f'{DATA}/gps.csv')
    assert '\n1,15,12,2.90625,' in result.out, result.out[:200]
    assert ('pairs_decided 0' in result.err) == any(r['pairs_decided'] == '0' for r in rows(result.out)), result.err


def test_ties():
    """A square: its diagonals tie if all are where they seem to be; nothing helps, and nothing is asked."""
    square = '0+-0.1 0\n1 0+-0.1\n1 1\n0 1\n'
    expect(run('plan', '-', stdin=square), 0, r'\A# plan 0 points: only pairs are undecided that tie at the nominal places\n# ties 2: ')


def test_costs():
    """Either of two points would do: the cheap one is chosen, whichever it is; costs that are none are refused."""
    def points(*cost):
        return 'x,y,r,c\n' + ''.join(f'{p},{c}\n' for p, c in zip(('0,0,0', '10,0,0', '5,3,1.5', '5,-4,1.5'), cost))
    options = ['plan', '--columns', 'x,y', '--radius-column', 'r', '--cost-column', 'c']
    for cost in (('1', '1', '1', '2.5'), ('1', '1', '7', '1/2')):
        plan = rows(run(*options, '-', stdin=points(*cost)).out)
        assert [r['i'] for r in plan] == ['2' if cost[2] == '1' else '3'], (cost, plan)
    for wrong in ('0', '-1', 'much', '1+-0.5'):
        expect(run(*options, '-', stdin=points('1', '1', wrong, '1')), 1, r'\A\Z', '-:4:9: the cost is not an exact number above 0')
    expect(run(*options, '-', stdin=points('1', '', '1', '1')), 1, r'\A\Z', 'the cost is empty')
    expect(run(*options, '--skip-missing', '-', stdin=points('1', '1', '1', '')), 0, r'\A# plan 0 points')
    expect(run(*options[:-1], 'd', '-', stdin=points('1', '1', '1', '1')), 1, r'\A\Z', '--cost-column')
    expect(run('plan', '--cost-column', 'c', '-', stdin=POINTS), 2, r'\A\Z', 'name those of x and y, too')
    expect(run('delaunay', '--cost-column', 'c', '-', stdin=POINTS), 2, r'\A\Z', 'cost-column')


def test_costs_of_a_run():
    """With delaunay the cheap points of a face are asked first: less is spent, the result is the same."""
    circles = [(f'{at}+cos({k})*(1+{w}*2^-{bits})', f'{at * at}+sin({k})*(1+{w}*2^-{bits})') for at, bits in ((0, 300), (10, 500), (20, 900))
               for k, w in ((1, 1), (2, 3), (4, 7), (6, 0))]
    costs = ['1', '1', '40', '1', '1', '1', '25', '1/2', '1', '60', '60', '1']
    text = 'x,y,c\n' + ''.join(f'{x},{y},{c}\n' for (x, y), c in zip(circles, costs))
    with tempfile.TemporaryDirectory() as folder:
        trace = os.path.join(folder, 'trace')
        def spent(*more):
            result = run('delaunay', '--ties', 'off', '--columns', 'x,y', '--trace', trace, *more, '-', stdin=text)
            expect(result, 0)
            steps = [json.loads(line) for line in pathlib.Path(trace).read_text().splitlines()]
            return result.out, sum(float(fractions.Fraction(costs[s['point']])) for s in steps if s.get('called'))
        plain, costly = spent()
        sparing, cheap = spent('--cost-column', 'c')
        assert sparing == plain and cheap < 0.85 * costly, (cheap, costly)
        assert spent('--cost-column', 'c') == (sparing, cheap)
        for more in (['--schedule', 'uniform'], ['--until', 'hausdorff:10'], ['--step-bits', '40']):
            assert spent('--cost-column', 'c', *more)[0] == spent(*more)[0], more
    expect(run('voronoi', '--columns', 'x,y', '--cost-column', 'c', '--window', '-2,22,-2,402', '-', stdin=text), 0)
    expect(run('converge', '--ties', 'off', '--columns', 'x,y', '--cost-column', 'c', '-', stdin=text), 0)
    expect(run('delaunay', '--columns', 'x,y', '--cost-column', 'c', '-', stdin='x,y,c\n0,0,0\n'), 1, r'\A\Z', 'the cost is not an exact number above 0')


def measured(text, plan):
    """The points file with the sites of the plan as accurate as it says."""
    half = {int(r['i']): r['half_width_needed'] for r in plan}
    out = []
    for i, line in enumerate(text.splitlines()):
        out.append(' '.join(f'{c}+-{half[i]}' for c in re.sub(r'\+-\S+', '', line).split()) if i in half else line)
    return '\n'.join(out) + '\n'


def prove_again(radius, number):
    """Squares around the first airports: measuring the rows of the plan decides all pairs, and each row decides
    the pairs it names."""
    with open(AIRPORTS, encoding='utf-8') as f:
        table = list(csv.DictReader(f))[:number]
    text = ''.join(f"{r['longitude']}+-{radius} {r['latitude']}+-{radius}\n" for r in table)
    before = run('delaunay', '-', stdin=text)
    expect(before, 3)
    result = run('plan', '-', stdin=text)
    expect(result, 0, r'\A# plan \d+ points: sufficient')
    plan = rows(result.out)
    assert plan[-1]['pairs_left'] == '0' and [int(r['rank']) for r in plan] == list(range(1, len(plan) + 1))
    left = [count(before.out)['indeterminate'], *(int(r['pairs_left']) for r in plan)]
    assert all(a - b == int(r['pairs_decided']) >= 0 for a, b, r in zip(left, left[1:], plan))
    for k in range(len(plan) // 5, len(plan), len(plan) // 5):
        assert count(run('delaunay', '-', stdin=measured(text, plan[:k])).out)['indeterminate'] == left[k], k
    with tempfile.TemporaryDirectory() as folder:
        expect(run('delaunay', '--certificate', 'proof', '-', stdin=measured(text, plan), cwd=folder), 0)
        expect(run('verify', 'proof', cwd=folder), 0)
    expect(run('delaunay', '-', stdin=measured(text, plan[:-1])), 3)
    first = rows(run('plan', '--next', '-', stdin=text).out)
    assert first == plan[:1]
    return len(plan)


def test_proved_again():
    prove_again('0.02', 100 + cases(300))


def test_crowd():
    """One face has nearly all of them, and more than can be tried one by one."""
    number = 60 + cases(240)
    rows_needed = prove_again('0.08', number)
    assert number < 300 or 200 < rows_needed < 225, rows_needed


def test_parts():
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / 'pairs').write_text('# some\ni,j,status\n1,0,indeterminate\n\n')
        (path / 'wrong').write_text('i,j\n0,1\n0,x\n')
        (path / 'far').write_text('i,j\n0,1\n\n0,7\n')
        (path / 'points').write_text(POINTS)
        expect(run('plan', '--pairs', 'pairs', 'points', cwd=folder), 0, r'\n1,3,4,\S*,1,0\n\Z')
        expect(run('plan', '--pairs', 'wrong', 'points', cwd=folder), 1, r'\A\Z', r'wrong:3:3: these are not two different points')
        expect(run('plan', '--pairs', 'none', 'points', cwd=folder), 1, r'\A\Z', 'none: cannot open')
        expect(run('plan', '--pairs', 'far', 'points', cwd=folder), 1, r'\A\Z', r'^dyadel: far:4: there is no point 7; give')
        # The names that delaunay --id writes may hold line ends and commas, and lines may be long.
        for text in ('i,j,status,id_i,id_j\n0,1,indeterminate,"n0\n3,7",n1\n',
                     '0,1,indeterminate,' + 'x' * 5000 + ' 9,9\n', 'status;j;i\nindeterminate;1;0\n', '0 1\n', '0\t1\n',
                     '\ufeffi,j\n0,1\n'):
            (path / 'pairs').write_text(text)
            expect(run('plan', '--pairs', 'pairs', 'points', cwd=folder), 0, r'\n1,3,4,\S*,1,0\n\Z')
        for text, where in (('0,1\0\n', '1:4: a NUL byte'), ('index,j\n0,1\n', '1:1: these are not two different points'),
                            ('0,1\n1,1\n', '2:3: these are not two different points'), ('0,1\n2\n', '2:2: these are not two different points'),
                            ('0,1\n0,-1\n', '2:3: these are not two different points'), ('0,1x\n', '1:3: these are not two different points'),
                            ('0,1,"n\n', '1:5: the quotes of this record do not pair up')):
            (path / 'wrong').write_text(text)
            expect(run('plan', '--pairs', 'wrong', 'points', cwd=folder), 1, r'\A\Z', f'^dyadel: wrong:{where}')
    expect(run('plan', '--site', '2', '-', stdin=POINTS), 0, r'\n1,3,4,\S*,1,0\n\Z')
    expect(run('plan', '--site', '4', '-', stdin=POINTS), 1, r'\A\Z', r'^dyadel: there is no point 4; give --site')
    expect(run('plan', '--window', '100,101,0,1', '-', stdin=POINTS), 0, r'\A# plan 0 points')
    for wrong in ('0', '-1', 'x', '1+-0.5'):
        expect(run('plan', '--accuracy', wrong, '-', stdin=POINTS), 2, r'\A\Z', '--accuracy ".*" is not understood')
    assert '"rank": 1' in run('plan', '--format', 'geojson', '-', stdin=POINTS).out
    assert run('plan', '--format', 'wkt', '-', stdin=POINTS).out.startswith('WKT,rank,i,')


def test_sphere():
    """What a plan on the sphere says decides all: seen by a run with these radii. Accuracies, parts, ties, refusals [SPH-7]."""
    chance = random.Random(3)
    points = [(round(chance.uniform(-20, 20), 3), round(chance.uniform(30, 60), 3)) for _ in range(40)]
    text = ''.join(f'{x} {y}\n' for x, y in points)
    radius = ('--sphere', '--radius', '20km')
    opened = [p for p in rows(run('delaunay', *radius, '-', stdin=text).out) if p['status'] != 'legal']
    assert len(opened) > 20, opened
    result = run('plan', *radius, '-', stdin=text)
    expect(result, 0, rf'\A# plan \d+ points: sufficient .* verified\nrank,')
    plan = rows(result.out)
    assert all(r['half_width_now'] == '20000' and 0 < float(r['half_width_needed']) <= 20000 for r in plan), plan
    assert int(plan[-1]['pairs_left']) == 0 and sum(int(r['pairs_decided']) for r in plan) == len(opened)
    half = {int(r['i']): r['half_width_needed'] for r in plan}
    table = 'lon,lat,r\n' + ''.join(f'{x},{y},{half.get(k, 20000)}m\n' for k, (x, y) in enumerate(points))
    expect(run('delaunay', '--sphere', '--columns', 'lon,lat', '--radius-column', 'r', '-', stdin=table), 0)
    near = rows(run('plan', *radius, '--accuracy', '50m', '-', stdin=text).out)
    assert min(float(r['half_width_needed']) for r in near) >= 50 and int(near[-1]['pairs_left']) == 0, near
    site = rows(run('plan', *radius, '--site', '7', '--next', '-', stdin=text).out)
    asked = [p for p in opened if '7' in (p['i'], p['j'])]
    assert len(site) == 1 and int(site[0]['pairs_decided']) + int(site[0]['pairs_left']) == len(asked), (site, asked)
    shown = json.loads(run('plan', *radius, '--format', 'geojson', '-', stdin=text).out)
    assert [f['properties']['i'] for f in shown['features']] == [int(r['i']) for r in plan]
    expect(run('plan', '--sphere', '--radius', '1km', '-', stdin='0 0\n10 0\n10 10\n0 10\n5 40\n'), 0, r'# ties \d+', 'ties at the centres')
    expect(run('plan', '--sphere', '--radius', '1km', '-', stdin='0 0\n10 0\n3 10\n3 10\n'), 3, '', 'points 2 and 3 have the same centre')
    expect(run('plan', '--sphere', '-', stdin=text), 0, r'# plan 0 points')
    for words, message in ((('--accuracy', '5'), 'is not a length above 0 with its unit'), (('--window', '0,1,0,1'), '--window of plan is about the plane'),
                           (('--discs',), '--discs is about the plane')):
        got = run('plan', *radius, *words, '-', stdin=text)
        assert got.code in (1, 2) and message in got.err, got


def test_first_rows_on_the_sphere():
    """The pairs that a plan says are decided by its first rows are decided then, whatever the others are [SPH-7]."""
    chance, some = random.Random(8), [((54.5, 63.4), (-16.2, 49.8), (62.7, 27), (-151.4, 54.3), (-151.4, 59.7), (11.9, 14.9))]
    some += [tuple((round(chance.uniform(-180, 180), 1), round(chance.uniform(-80, 80), 1)) for _ in range(chance.randint(6, 14))) for _ in range(7)]
    early = 0
    for points in few(some):
        radius = chance.choice((300, 700)) if points is not some[0] else 1112
        ask = ('plan', '--sphere', '--radius', f'{radius}km', '-')
        text = ''.join(f'{x} {y}\n' for x, y in points)
        plan, pairs = (rows(run(*ask, *layer, stdin=text).out) for layer in ((), ('--layer', 'pairs')))
        half = {}
        for n, row in enumerate(plan, 1):
            half[int(row['i'])] = row['half_width_needed']
            table = 'lon,lat,r\n' + ''.join(f'{x},{y},{half.get(k, radius * 1000)}m\n' for k, (x, y) in enumerate(points))
            found = run('delaunay', '--sphere', '--columns', 'lon,lat', '--radius-column', 'r', '--accept-fixpoint', '-', stdin=table)
            still = {(p['i'], p['j']) for p in rows(found.out) if p['status'] != 'legal'}
            said = {(p['i'], p['j']) for p in pairs if p['rank'] and int(p['rank']) <= n}
            assert not said & still, (points, radius, n, said & still)
            early += len(said) if n < len(plan) else 0
    assert early >= cases(21), early


def test_discs():
    """Plans cover the pairs that are indeterminate for the discs: all of them, or the ones given by --pairs."""
    gps = '--columns', 'east,north', '--radius-column', 'accuracy', os.path.join(DATA, 'gps.csv')
    open_pairs = [line.split(',')[:2] for line in run('delaunay', '--discs', *gps).out.split() if 'indet' in line]
    plan = [line.split(',') for line in run('plan', '--discs', *gps).out.splitlines()[2:]]
    assert int(plan[0][4]) + int(plan[0][5]) == len(open_pairs) == 32 and plan[-1][5] == '0'
    squares = run('delaunay', *gps).out.split()
    settled = next(line.split(',')[:2] for line in squares if 'indet' in line and line.split(',')[:2] not in open_pairs)
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'pairs'), 'w', encoding='utf-8') as out:
            out.write(','.join(open_pairs[3]) + '\n' + ','.join(settled) + '\n')
        some = run('plan', '--discs', '--pairs', 'pairs', *gps, cwd=folder).out.splitlines()[2:]
        assert sum(int(line.split(',')[4]) for line in some) == 1, some
        more = run('plan', '--pairs', 'pairs', *gps, cwd=folder).out.splitlines()[2:]
        assert sum(int(line.split(',')[4]) for line in more) == 2, more
    expect(run('plan', '--discs', '-', stdin='[0,1] [0,2]\n3 4\n5 9\n'), 1, r'\A\Z', 'a disc needs one radius')


GPS = '--columns', 'east,north', '--radius-column', 'accuracy', f'{DATA}/gps.csv'


GLOBE = ''.join(f'{random.Random(k).uniform(-20, 20):.3f} {random.Random(k + 100).uniform(30, 60):.3f}\n' for k in range(25))


def test_pairs():
    """Which point decides each pair: json, csv and geojson say the same; delaunay proves it for the first points."""
    with open(f'{DATA}/gps.csv', encoding='utf-8') as f:
        text = ''.join(f"{r['east']}+-{r['accuracy']} {r['north']}+-{r['accuracy']}\n" for r in csv.DictReader(f))
    whole = json.loads(run('plan', '--format', 'json', *GPS).out)
    plan, pairs = rows(run('plan', *GPS).out), rows(run('plan', '--layer', 'pairs', *GPS).out)
    assert [[p['i'], p['j'], p['rank']] for p in whole['pairs']] == [[int(p[k]) for k in ('i', 'j', 'rank')] for p in pairs]
    assert [{k: str(v) for k, v in p.items()} for p in whole['points']] == plan
    shown = json.loads(run('plan', '--layer', 'pairs', '--format', 'geojson', *GPS).out)['features']
    assert [f['properties']['rank'] for f in shown] == [p['rank'] for p in whole['pairs']]
    assert (whole['undecided'], whole['left'], whole['finished']) == (len(pairs), 0, True)
    for k in (0, 4, 9, len(plan)):
        now = rows(run('delaunay', '-', stdin=measured(text, plan[:k])).out)
        assert [[p['i'], p['j']] for p in now if p['status'] == 'indeterminate'] == [[p['i'], p['j']] for p in pairs if int(p['rank']) > k], k
    some = rows(run('plan', '--layer', 'pairs', '--accuracy', '3.9', '-', stdin=POINTS).out)
    assert [p['rank'] for p in some] == ['', ''], some
    decided = rows(run('plan', '--layer', 'pairs', '--sphere', '--radius', '40km', '-', stdin=GLOBE).out)
    points = rows(run('plan', '--sphere', '--radius', '40km', '-', stdin=GLOBE).out)
    assert decided and all([sum(p['rank'] == r['rank'] for p in decided) == int(r['pairs_decided']) for r in points]), (decided, points)


def test_simulate():
    """Trials: the same for any number of threads, others for another seed; a column for what each took. (That each is
    what following the plan comes to: tests/tolerance/test_survey.c.)"""
    for more in few(((), ('--discs',), ('--accuracy', '0.5'), ('--site', '15'))):
        one = run('plan', '--simulate', '60', '--seed', '7', *more, *GPS)
        expect(one, 0, r'^trial,rounds,points,measurements,pairs_left$')
        table = rows(one.out)
        assert [int(t['trial']) for t in table] == list(range(60)) and all(int(t['points']) <= int(t['measurements']) for t in table)
        assert run('plan', '--simulate', '60', '--seed', '7', '--threads', '3', *more, *GPS).out == one.out
        assert rows(run('plan', '--simulate', '20', '--seed', '7', *more, *GPS).out) == table[:20]
        assert more == ('--site', '15') or run('plan', '--simulate', '60', '--seed', '8', *more, *GPS).out != one.out
        whole = json.loads(run('plan', '--simulate', '60', '--seed', '7', '--format', 'json', *more, *GPS).out)
        assert [{k: str(v) for k, v in t.items()} for t in whole['trials']] == table and whole['seed'] == 7
    line = re.search('trials 60 of 60: (.*)', run('plan', '--simulate', '60', '--seed', '7', *GPS, comments=False).err)[1]
    table = rows(run('plan', '--simulate', '60', '--seed', '7', *GPS).out)
    count_of = [sum(int(t['rounds']) == k for t in table) for k in range(3)]
    assert f"2 rounds in {count_of[2]}, at most {max(int(t['rounds']) for t in table)}; " in line, line
    mean = sum(int(t['points']) for t in table) / 60
    assert abs(float(re.search(r'; (\S+) points measured on average', line)[1]) - mean) <= 0.05001, (line, mean)
    expect(run('plan', '--simulate', '5', '-', stdin='0 0\n1 0\n0 1\n'), 0, r'0,0,0,0,0\n1,0,0,0,0\n')
    square = '0+-0.1 0\n1 0+-0.1\n1 1\n0 1\n'
    expect(run('plan', '--simulate', '2', '-', stdin=square), 0, r'0,0,0,0,2\n1,0,0,0,2\n')
    # Computed discs are not square by more than their coordinates are rounded by.
    tiny = '2^-500+pi*60*2^-501 log(6)*2^-501-25*2^-499\n47*2^-499+log(18)*2^-500 39*2^-500+pi*11*2^-501\n' \
        '95*2^-500+exp(8/20)*2^-501 3*2^-499\n15*2^-499+sqrt(15+sqrt(2))*2^-501 47*2^-499+cbrt(21)*2^-500\n'
    expect(run('plan', '--discs', '--radius', '5*2^-504', '--simulate', '3', '--seed', '5', '-', stdin=tiny), 0, '2,2,2,2,0')
    globe = run('plan', '--simulate', '4', '--sphere', '--radius', '40km', '-', stdin=GLOBE)
    expect(globe, 0)
    assert len(rows(globe.out)) == 4 and all(int(t['rounds']) for t in rows(globe.out)), globe.out
    for wrong, message in ((('--seed', '3'), '--seed is about the trials'), (('--simulate', '3', '--next'), 'remove it or --next'),
                           (('--simulate', '3', '--layer', 'pairs'), 'remove it or --layer'), (('--simulate', '3', '-o', 'a.svg'), 'svg')):
        expect(run('plan', *wrong, '-', stdin=POINTS), 2, r'\A\Z', message)


def test_cut():
    """What is known when time ends is written: a plan without its last points, trials that are done."""
    chance = random.Random(5)
    text = ''.join(f'{chance.uniform(0, 100):.3f}+-{chance.uniform(0, 2):.3f} {chance.uniform(0, 100):.3f}+-{chance.uniform(0, 2):.3f}\n' for _ in range(60))
    result = run('plan', '--simulate', '1000000', '--timeout', '3', '-', stdin=text, timeout=60)
    expect(result, 4, '', 'of 1000000 trials of the plan are not done .raise --timeout')
    table = [int(t['trial']) for t in rows(result.out)]
    assert 0 < len(table) < 1000000 and table == sorted(table)
    discs = ''.join(f'{chance.uniform(0, 1000):.3f} {chance.uniform(0, 1000):.3f}\n' for _ in range(20000))
    for more in (('--discs', '--radius', '3'), ('--radius', '3'), ('--layer', 'pairs', '--radius', '3')):
        for seconds in few(('0.4', '0.8', '1.5')):
            result = run('plan', *more, '--timeout', seconds, '-', stdin=discs, timeout=60)
            assert result.code == 4 and re.search('there is no result to write|no result was written|the plan is not finished', result.err), result.err
            assert ('not finished' in result.err) == bool(rows(result.out) or 'rank' in result.out), (more, seconds, result)


PROGRAM = '''import sys
places = (-15, 10), (15, -5), (9, -1), (17, -6), (-3, 4), (3, 1)
print("points", len(places), flush=True)
for line in sys.stdin:
    i, bits = map(int, line.split()[1:])
    print(i, *(f"{end * 2**max(bits, 0) + more}*2^{-max(bits, 0)}" for end in places[i] for more in (0, 1 + (i == 1))), flush=True)
'''


def test_rectangles_below_doubles():
    """Four of these places are on a line, which no rectangle tells: all have a width of 2^-4096, which doubles take for 0."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'points.py'), 'w', encoding='utf-8') as out:
            out.write(PROGRAM)
        result = run('plan', '--comments', '--oracle', f'exec {sys.executable} points.py', cwd=folder, timeout=120)
        expect(result, 0, r'\A# plan 2 points: sufficient .*; verified\n(#.*\n)*rank,.*\n1,1,4.94065e-324,0,0,3\n')


main(globals())
