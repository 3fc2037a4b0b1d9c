#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Columns that layers take over from the points file (--carry), and lengths of pairs (--length).

Usage: test_columns.py COMMAND DATA
"""
import csv
import fractions
import io
import json
import random

from harness import expect, main, run

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
    """geojson has numbers where the text is one; rows that are left out, merged or headless keep theirs."""
    out = json.loads(run('delaunay', '--layer', 'points', '--format', 'geojson', *READ, '--carry', 'all', '-', stdin=TABLE).out)
    assert [f['properties']['acc'] for f in out['features']] == [0.5, 0.25, 0.125, 0.1]
    assert [f['properties']['odd, "q"'] for f in out['features']] == ['a,b', None, '007', 'two\nlines']
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


main(globals())
