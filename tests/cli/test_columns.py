#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Columns that layers take over from the points file (--carry), lengths of pairs (--length), and rows of one identifier
(--merge-by): in fractions, and compared with files in which what the rows have in common is typed.

Usage: test_columns.py COMMAND DATA
"""
import csv
import fractions
import io
import json
import math
import random
import re

from harness import cases, expect, main, run

Q = fractions.Fraction
TABLE = 'name,acc,i,"odd, ""q""",x,y\nanna,0.5,1,"a,b",0,0\nb,0.25,2,,10,0.1\nc,0.125,3,007,3,7\nd,0.1,4,"two\nlines",9,11\n'
READ = '--columns', 'x,y'
LAYERS = [('delaunay', 'points', ()), ('voronoi', 'cells', ()), ('voronoi', 'tiles', ()), ('tolerance', 'points', ()),
          ('plan', None, ('--radius', '4')), ('delaunay', 'points', ('--sphere',)), ('voronoi', 'cells', ('--sphere',))]


def table(command, layer, *options, text=TABLE):
    result = run(command, *(('--layer', layer) if layer else ()), *options, '-', stdin=text, comments=False)
    assert result.code in (0, 3), result
    return list(csv.DictReader(io.StringIO(result.out)))


def test_carried():
    """Each layer of points has them, in the order that is asked for, beside the numbers of their rows."""
    rows = list(csv.DictReader(io.StringIO(TABLE)))
    names = {'i': 'i_2'}
    for command, layer, options in LAYERS:
        for carry, wanted in (('all', ['name', 'acc', 'i', 'odd, "q"']), ('acc', ['acc']), ('"odd, ""q""",name', ['odd, "q"', 'name']),
                              ('4,1', ['odd, "q"', 'name'])):
            for ids in (), ('--id', 'name'):
                got = table(command, layer, *READ, *options, '--carry', carry, *ids)
                plain = table(command, layer, *READ, *options, *ids)
                assert got and len(got) == len(plain), (command, layer)
                for row, without in zip(got, plain):
                    of = rows[int(row['i'])]
                    assert [row[names.get(n, n)] for n in wanted] == [of[n] for n in wanted], (command, layer, carry, row)
                    assert {k: v for k, v in row.items() if k in without} == without, (command, layer, row, without)
                    assert set(row) - set(without) == {names.get(n, n) for n in wanted}
    assert table('delaunay', 'pairs', *READ, '--carry', 'all') == table('delaunay', 'pairs', *READ)


def test_carried_elsewhere():
    """geojson has numbers where the text is one; skipped, merged or headless rows keep theirs."""
    out = json.loads(run('delaunay', '--layer', 'points', '--format', 'geojson', *READ, '--carry', 'all', '-', stdin=TABLE).out)
    assert [f['properties']['acc'] for f in out['features']] == [0.5, 0.25, 0.125, 0.1]
    assert [f['properties']['odd, "q"'] for f in out['features']] == ['a,b', None, '007', 'two\nlines']
    wanted = [{'name': 'anna', 'acc': 0.5, 'i': 1, 'odd, "q"': 'a,b'}, {'name': 'b', 'acc': 0.25, 'i': 2, 'odd, "q"': None},
              {'name': 'c', 'acc': 0.125, 'i': 3, 'odd, "q"': '007'}, {'name': 'd', 'acc': 0.1, 'i': 4, 'odd, "q"': 'two\nlines'}]
    for command, places in (('delaunay', 'sites'), ('delaunay --sphere', 'sites'), ('voronoi', 'cells'), ('voronoi --sphere', 'cells')):
        for carry in ('--carry', 'all'), ():
            out = json.loads(run(*command.split(), '--format', 'json', *READ, *carry, '-', stdin=TABLE).out)
            assert [site.get('carried') for site in out[places]] == (wanted if carry else [None] * 4), (command, carry, out[places])
    out = json.loads(run('nearest', '--format', 'json', *READ, '--carry', 'name', '-', '9', '9', stdin=TABLE).out)
    assert [site['carried'] for site in out['nearest']] == [{'name': 'd'}], out
    gaps = 'n,x,y\np,1,1\nq,,2\nr,5,1\ns,1,1\nt,2,9\n'
    got = table('delaunay', 'points', *READ, '--skip-missing', '--merge', '--carry', 'n', text=gaps)
    assert [(r['i'], r['n']) for r in got] == [('0', 'p'), ('2', 'r'), ('4', 't')], got
    got = table('delaunay', 'points', '--columns', '2,3', '--no-header', '--carry', 'all', text='p,1,1,u\nq,4,2,v\n')
    assert [(r['1'], r['4']) for r in got] == [('p', 'u'), ('q', 'v')], got
    expect(run('delaunay', *READ, '--carry', 'none', '-', stdin=TABLE), 1, '', "no column is called \"none\"")
    expect(run('delaunay', '--carry', 'all', '-', stdin='1 2\n'), 2, '', '--carry is about columns; name those of x and y')


def test_lengths():
    """Bounds of the distance of all choices, at most two units in the last place apart for points."""
    rand = random.Random(7)
    sides = [(Q(rand.randint(-99, 99), 8), Q(rand.randint(0, 9), 8)) for _ in range(24)]
    points = list(zip(sides[::2], sides[1::2]))
    text = ''.join('[{},{}] [{},{}]\n'.format(*(float(e) for s in p for e in (s[0], s[0] + s[1]))) for p in points)
    for layer in 'pairs', 'graph:nearest', 'graph:gabriel', 'graph:mst':
        for form in 'csv', 'wkt':
            for row in table('delaunay', layer, '--length', '--format', form, text=text):
                a, b = points[int(row['i'])], points[int(row['j'])]
                gap = [max(a[k][0] - b[k][0] - b[k][1], b[k][0] - a[k][0] - a[k][1], 0) for k in (0, 1)]
                far = [max(a[k][0] + a[k][1] - b[k][0], b[k][0] + b[k][1] - a[k][0]) for k in (0, 1)]
                lo, hi = Q(row['length_lo']), Q(row['length_hi'])
                assert lo ** 2 <= sum(g * g for g in gap) <= (lo + Q(1, 10**12)) ** 2, row
                assert (hi - Q(1, 10**12)) ** 2 <= sum(f * f for f in far) <= hi ** 2, row
    assert 'length_lo' not in run('delaunay', '--format', 'wkt', '-', stdin='0 0\n1 1\n').out
    expect(run('delaunay', '--length', '--sphere', '-', stdin='0 0\n1 1\n'), 2, '', '--length is about the plane')



def places(text):
    return [tuple(map(Q, p.split())) for p in text[text.index('(') + 1:text.index(')')].split(', ')]


def cut(a, b, window):
    """The part of the segment in the window, by exact Liang-Barsky; None: there is none."""
    lo, hi = Q(0), Q(1)
    for k in (0, 1):
        d = b[k] - a[k]
        for side, sign in ((window[2 * k], -1), (window[2 * k + 1], 1)):
            if sign * d == 0:
                if sign * (a[k] - side) > 0:
                    return None
            elif sign * d > 0:
                hi = min(hi, (side - a[k]) / d)
            else:
                lo = max(lo, (side - a[k]) / d)
    return None if lo > hi else [tuple(a[k] + t * (b[k] - a[k]) for k in (0, 1)) for t in (lo, hi)]


def test_clipped_edges():
    """Each drawn edge is the part of the whole one that is in the window, within its error; those beyond have no row."""
    rand, seen = random.Random(11), [0, 0, 0]
    for k in range(25):
        text = ''.join(f'{rand.randint(0, 40)} {rand.randint(0, 40)}\n' for _ in range(rand.randint(3, 12)))
        x, y = sorted(rand.sample(range(-20, 60), 2)), sorted(rand.sample(range(-20, 60), 2))
        window = [Q(x[0]), Q(x[1]), Q(y[0]), Q(y[1])]
        options = '--layer', 'edges', '--window={},{},{},{}'.format(*window), '--format', 'wkt'
        whole = {(r['i'], r['j']): r for r in table('voronoi', None, *options, text=text)}
        got = {(r['i'], r['j']): r for r in table('voronoi', None, *options, '--clip', text=text)}
        for pair, row in whole.items():
            a, b = places(row['WKT'])
            part, slack = cut(a, b, window), Q(1, 10**6)
            wider = cut(a, b, [w + s * slack for w, s in zip(window, (-1, 1, -1, 1))])
            if wider is None or pair not in got:
                assert pair not in got and (part is None or part[0] == part[1] or wider is None), (text, window, row)
                seen[0] += 1
                continue
            if part is None:
                continue  # it touches the window within the error
            for p, q in zip(places(got[pair]['WKT']), part):
                error = Q(got[pair]['max_coordinate_error']) + Q(row['max_coordinate_error']) + Q(1, 10**9)
                assert error < Q(1, 10**6) and all(abs(p[m] - q[m]) <= error for m in (0, 1)), (text, window, row, got[pair])
            seen[1 if part == [a, b] else 2] += 1
        assert set(got) <= set(whole)
    assert all(seen), seen
    expect(run('voronoi', '--clip', '-', stdin='0 0\n1 1\n2 0\n'), 2, '', '--clip is about edges in the plane; give --layer edges')


# ---- rows of one identifier ----

BY_ID = *READ, '--id', 'id', '--merge-by', 'id'


def grouped(rows):
    """Numbers of the rows of each identifier; rows without one are alone."""
    groups = {}
    for k, (name, *_) in enumerate(rows):
        groups.setdefault(name or ('', k), []).append(k)
    return list(groups.values())


def named(result):
    """Points and pairs without the numbers of rows."""
    return [{k: v for k, v in row.items() if k not in ('i', 'j', 'k')} for row in csv.DictReader(io.StringIO(result.out))]


def same_as(merged, typed, *options):
    """The statements of both files: text, options of reading."""
    for layer in 'points', 'pairs':
        a, b = (run('delaunay', '--layer', layer, *options, *words, '-', stdin=text, comments=False) for text, words in (merged, typed))
        assert a.code == b.code in (0, 3) and named(a) == named(b), (merged, typed, options, a, b)


def blamed(result, rows, apart):
    """The message names two rows of one identifier, and the line of both, that are apart."""
    found = re.search(r'-:(\d+):\d+: rows (\d+) \(line (\d+)\) and (\d+) are both "(.*?)", but have nothing in common; give larger radii \(--radius', result.err)
    assert result.code == 1 and found and not result.out, result
    line, a, first, b = map(int, found.groups()[:4])
    assert (line, first) == (b + 2, a + 2) and a < b and rows[a][0] == rows[b][0] == found[5] and apart(a, b), (result, rows)


def side(rand, digits):
    """Ends, and a text that says them with a radius in a column."""
    step = Q(1, 10 ** digits) if digits else Q(1, 8)
    middle, radius = step * rand.randint(0, 60), step * rand.choice((0, 10, 20, 25, 40))
    form = rand.randrange(3)
    text = lambda q: str(q) if rand.random() < 0.3 else f'{float(q):.6g}'
    if form == 0:
        return (middle - radius, middle + radius), text(middle), text(radius)
    own = radius * Q(rand.randint(0, 4), 4)
    shown = f'{text(middle)}+-{str(own)}' if form == 1 else f'[{text(middle - own)},{str(middle + own)}]'
    return (middle - radius, middle + radius), shown, str(radius - own)


def end_text(lo, hi):
    return str(lo) if lo == hi else f'[{lo},{hi}]'


def test_boxes_of_one_identifier():
    """Boxes of any form intersect, exactly: touching ones have a point or a side in common."""
    rand, met, refused = random.Random(8), 0, 0
    for k in range(cases(60)):
        rows = []
        for _ in range(rand.randint(4, 9)):
            x, y = side(rand, k % 3), side(rand, k % 3)
            rows.append((rand.choice(('a', 'b', 'c "q"', 'd', 'e', 'f', 'g', '')), x[0], y[0], x[1], y[1], x[2], y[2]))
        lines = 'id,x,y,rx,ry\n' + ''.join('"{}","{}","{}",{},{}\n'.format(r[0].replace('"', '""'), *r[3:]) for r in rows)
        options = *BY_ID, '--radius-column', 'rx,ry'
        boxes = [[[max(rows[m][1 + a][0] for m in g), min(rows[m][1 + a][1] for m in g)] for a in (0, 1)] for g in grouped(rows)]
        if any(lo > hi for box in boxes for lo, hi in box):
            blamed(run('delaunay', *options, '-', stdin=lines), [(r[0],) for r in rows],
                   lambda a, b: any(max(rows[a][s][0], rows[b][s][0]) > min(rows[a][s][1], rows[b][s][1]) for s in (1, 2)))
            refused += 1
            continue
        alone = lines.splitlines(keepends=True)[1:]
        typed = 'id,x,y,rx,ry\n' + ''.join(alone[g[0]] if len(g) == 1 else '"{}","{}","{}",0,0\n'.format(rows[g[0]][0].replace('"', '""'), *(end_text(*b) for b in box))
                                          for g, box in zip(grouped(rows), boxes))
        met += len(boxes) < len(rows)
        same_as((lines, options), (typed, (*READ, '--id', 'id', '--radius-column', 'rx,ry')), '--quiet')
    assert met > cases(60) // 10 and refused > cases(60) // 10, (met, refused)
    touching = 'id,x,y,r\na,0,0,0.1\nb,5,0,0\na,0.3,0,0.2\nc,0,7,0\n'
    same_as((touching, (*BY_ID, '--radius-column', 'r')), ('id,x,y\na,0.1,"[-0.1,0.1]"\nb,5,0\nc,0,7\n', (*READ, '--id', 'id')), '-q')
    measured = 'id;x;y\na;1,50;0,0\na;1,5;0,04\nb;5,0;0,0\nc;0,0;7,0\n'
    same_as((measured, (*BY_ID, '--measured', '--decimal-comma')), ('id,x,y\na,"[1.495,1.505]","[0.035,0.045]"\nb,5.0,0.0\nc,0.0,7.0\n', (*READ, '--id', 'id', '--measured')), '-q')


def test_discs_of_one_identifier():
    """The smallest disc counts. Two disjoint discs are reported even where their squares meet."""
    rand, met, refused = random.Random(9), 0, 0
    for _ in range(cases(60)):
        rows = [(rand.choice('abcdefg'), *(Q(rand.randint(0, 40), 10) for _ in 'xy'), Q(rand.randint(0, 25), 10)) for _ in range(rand.randint(4, 8))]
        def apart(a, b):
            return (rows[a][1] - rows[b][1]) ** 2 + (rows[a][2] - rows[b][2]) ** 2 > (rows[a][3] + rows[b][3]) ** 2
        least = [min(g, key=lambda k: rows[k][3]) for g in grouped(rows)]
        lines = 'id,x,y,r\n' + ''.join('{},{},{},{}\n'.format(*r) for r in rows)
        options = *BY_ID, '--radius-column', 'r', '--discs'
        boxes = [[(max(rows[m][a] - rows[m][3] for m in g), min(rows[m][a] + rows[m][3] for m in g)) for a in (1, 2)] for g in grouped(rows)]
        if any(apart(m, k) for g, m in zip(grouped(rows), least) for k in g) or any(lo > hi for b in boxes for lo, hi in b):
            blamed(run('delaunay', *options, '-', stdin=lines), [(r[0],) for r in rows], apart)
            refused += 1
            continue
        met += len(least) < len(rows)
        alone = lines.splitlines(keepends=True)[1:]
        typed = 'id,x,y,r\n' + ''.join(alone[m] if len(g) == 1 else '{},"{}","{}",0\n'.format(
            rows[m][0], *(end_text(rows[m][a] - rows[m][3], rows[m][a] + rows[m][3]) for a in (1, 2))) for g, m in zip(grouped(rows), least))
        same_as((lines, options), (typed, (*READ, '--id', 'id', '--radius-column', 'r', '--discs')), '--quiet')
    assert met > cases(60) // 10 and refused > cases(60) // 10, (met, refused)


def double_above(q, root=False):
    """The smallest double that is at least q, or its root."""
    d = math.sqrt(q) if root else float(q)
    known = lambda d: (Q(d) ** 2 if root else Q(d)) >= q
    while not known(d):
        d = math.nextafter(d, math.inf)
    while known(math.nextafter(d, 0)) and d > 0:
        d = math.nextafter(d, 0)
    return d


def mean(values, sigmas):
    """Weighted by inverse variances, which are rounded as doubles; and the standard deviation of this mean."""
    least = min(sigmas)
    if least == 0:
        firm = {v for v, s in zip(values, sigmas) if s == 0}
        assert len(firm) == 1
        return firm.pop(), 0.0
    weights = [Q((least / s) ** 2) for s in sigmas]
    total = sum(weights)
    return (sum(w * v for w, v in zip(weights, values)) / total,
            double_above(sum((w * Q(s)) ** 2 for w, s in zip(weights, sigmas)) / total ** 2, root=True))


def test_means_of_one_identifier():
    """With --confidence: the mean of each coordinate; in discs one weight for both. A point counts once."""
    rand = random.Random(10)
    for k in range(cases(60)):
        shift = {}
        rows = []
        for _ in range(rand.randint(4, 9)):
            name = rand.choice('abcdef')
            sigmas = [Q(rand.choice((0, 1, 2, 3, 3, 7, 20)), 10) for _ in 'xy']
            at = [Q(rand.randint(0, 50), 10) for _ in 'xy']
            for a in (0, 1):  # an exact coordinate is exact in all rows
                at[a] = shift.setdefault((name, a), at[a]) if not sigmas[a] or (k % 2 and not sigmas[1 - a]) else at[a]
            rows.append((name, *at, *sigmas))
        discs = ('--discs',) if k % 2 else ()
        if discs:
            rows = [(*r[:3], max(r[3:]), max(r[3:])) for r in rows]
            rows = [(r[0], *(shift[r[0], a] if not r[3] and (r[0], a) in shift else r[1 + a] for a in (0, 1)), *r[3:]) for r in rows]
        groups = grouped(rows)
        if any(len({rows[m][1 + a] for m in g if not rows[m][3 + a]}) > 1 for g in groups for a in (0, 1)):
            continue
        rho = rand.choice(('', ',rho')) if not discs else ''
        lines = 'id,x,y,sx,sy,rho\n' + ''.join('{},{},{},{},{},0.5\n'.format(*r) for r in rows)
        options = *BY_ID, '--sigma-column', 'sx,sy' + rho, '--confidence', '90%', *discs
        means = [[mean([rows[m][1 + a] for m in g], [double_above(rows[m][3 + a]) for m in g]) for a in (0, 1)] for g in groups]
        typed = 'id,x,y,sx,sy\n' + ''.join('{},{},{},{},{}\n'.format(rows[g[0]][0], m[0][0], m[1][0], Q(m[0][1]), Q(m[1][1])) for g, m in zip(groups, means))
        same_as((lines, options), (typed, (*READ, '--id', 'id', '--sigma-column', 'sx,sy', '--confidence', '90%', *discs)), '--quiet')
        said = run('delaunay', *options, '-', stdin=lines).err
        uncertain = sum(any(s for _, s in m) for m in means)
        assert f'all {uncertain} points with errors' in said or not uncertain, said


def test_other_points_of_one_identifier():
    """Numbers that are not rational are merged where their rows are alike; rows of exact points that differ are refused."""
    roots = 'id,x,y,r\na,sqrt(2),1,{}\nb,3,4,0\na,sqrt(2),1,1/4\nc,0,9,0\n'
    for radius in ('1/4', '0.25'):
        got = run('delaunay', *BY_ID, '--radius-column', 'r', '-', stdin=roots.format(radius))
        if radius == '1/4':
            same_as((roots.format(radius), (*BY_ID, '--radius-column', 'r')), ('id,x,y,r\na,sqrt(2),1,1/4\nb,3,4,0\nc,0,9,0\n', (*READ, '--id', 'id', '--radius-column', 'r')), '-q')
        else:
            expect(got, 1, r'\A\Z', r'-:4:3: rows 0 \(line 2\) and 2 are both "a", but not written alike, and one has to be refined to be known; write both alike')
    expect(run('delaunay', *BY_ID, '-', stdin='id,x,y\na,1,2\na,1,2.0\nb,3,4\na,1,2.01\n'), 1, r'\A\Z', r'-:5:3: rows 0 \(line 2\) and 3 are both "a", but have nothing in common')
    expect(run('tolerance', *BY_ID, '-', stdin='id,x,y\na,1,2\nb,3,4\na,1,2.01\n'), 1, r'\A\Z', r'-:4:3: rows 0 \(line 2\) and 2 are both "a", but not the same place; give other identifiers')
    for wrong, words, why in (('id', READ, 'name the column of identifiers, too: --id NAME'), ('name', (*READ, '--id', 'id'), '"name" is not id; .*--id NAME and --merge-by id'),
                              ('id', (*READ, '--id', 'id', '--merge'), 'leave --merge or --merge-by out'),
                              ('id', (*READ, '--id', 'id', '--sphere', '--sigma-column', 'x', '--confidence', '90%'), 'give projected coordinates')):
        expect(run('delaunay', *words, '--merge-by', wrong, '-', stdin='id,x,y\n'), 2, r'\A\Z', why)
    expect(run('delaunay', '--merge-by', 'id', '-', stdin='1 2\n'), 2, r'\A\Z', '--merge-by is about columns; name those of x and y')
    rows = 'id,x,y\na,0,0\nb,9,0\na,0,0\nc,0,9\nb,9,0\n'
    got = run('delaunay', *BY_ID, '--format', 'json', '-', stdin=rows)
    assert [s['row'] for s in json.loads(got.out)['sites']] == [0, 1, 3] if 'row' in json.loads(got.out)['sites'][0] else True
    expect(got, 0, '', r'\Adyadel: -: 2 rows are merged with earlier ones of equal identifiers$')
    same_as(('id,x,y,w\na,0,0,2\na,0,0,1\nb,9,0,1\nc,0,9,1\n', (*BY_ID, '--radius-column', 'w')), ('id,x,y,w\na,0,0,1\nb,9,0,1\nc,0,9,1\n', (*READ, '--id', 'id', '--radius-column', 'w')), '-q')


def test_repeated_identifiers():
    """One note, which names two rows, the identifier and what merges them."""
    note = r'-: rows 1 and 3 are both "b"; rows with the identifier of an earlier one: 2 \(if they are one point: --merge-by id\)'
    rows = 'id,x,y\na,0,0\nb,9,0\n,5,5\nb,9,0.011\n,4,4\nNA,1,8\nb,8,8\n'
    got = run('delaunay', *READ, '--id', 'id', '-', stdin=rows)
    expect(got, 0, '', note)
    assert got.err.count('--merge-by') == 1
    for silent in (run('delaunay', *READ, '--id', 'id', '-q', '-', stdin=rows), run('delaunay', *READ, '-', stdin=rows),
                   run('delaunay', *READ, '--id', 'id', '--merge', '-', stdin='id,x,y\na,0,0\nb,9,0\na,0,0\nc,4,4\n'),
                   run('delaunay', *READ, '--id', 'id', '-', stdin=rows.replace('b,9,0.', 'd,9,0.').replace('b,8', 'e,8'))):
        assert '--merge-by' not in silent.err, silent
    long = run('delaunay', *READ, '--id', 'id', '-', stdin='id,x,y\n{0},0,0\n{0},1,0\n{0},0,1\n'.format('\x1b[1m' + 'ä' * 99))
    assert 'rows 0 and 1 are both' in long.err and '\x1b' not in long.err, long


def test_globe_of_one_identifier():
    """Longitudes are those of one turn; of radii on the ground the smallest counts; about a pole one row does."""
    def points(*rows, options=()):
        text = 'id,x,y,r\n' + ''.join(f'a,{r}\n' for r in rows) + 'b,60,20,0\nc,70,-5,0\nd,50,-9,0\n'
        return run('delaunay', '--sphere', '-q', *BY_ID, '--radius-column', 'r', *options, '--layer', 'points', '-', stdin=text, comments=False)

    def box(*rows):
        got = points(*rows)
        assert got.code in (0, 3), got
        return tuple(float(named(got)[0][k]) for k in ('xlo', 'xhi', 'ylo', 'yhi'))
    assert box('179.5,0,1deg', '-179.5,0.5,1deg', '539.5,0,2deg') == box('"[179.5,180.5]","[-0.5,1]",0deg')
    assert box('5,0,30m', '5,0.0001,20m', '5,0,40m') == box('5,0.0001,20m')
    assert box('180,0,30m', '-180,0,0') == box('180,0,0')
    assert box('10,89.5,1deg', '200,90,0.5deg') == box('200,90,0.5deg')
    assert box('10,88.5,1deg', '11,89,1.5deg') == box('10,88.5,1deg')
    for a, b in (('5,0,1deg', '7.5,0,1deg'), ('5,0,30m', '5,0.001,20m'), ('179,0,0.5deg', '-179,0,0.5deg'), ('0,89.9,5km', '180,89.9,5km')):
        expect(points(a, b), 1, r'\A\Z', r'-:3:3: rows 0 \(line 2\) and 1 are both "a", but have nothing in common')
    metre = math.degrees(1 / 6371008.8)
    assert points(f'5,0,30m', f'5,{49.999 * metre:.15f},20m').code == 0 and points('5,0,30m', f'5,{50.001 * metre:.15f},20m').code == 1
    expect(points('5,0,30m', '5,0,1deg'), 1, r'\A\Z', 'the radius of one is a length, and the other is in an interval; give lengths or degrees for both')


main(globals())
