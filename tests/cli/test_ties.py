#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ties among points given by expressions: proved, or not claimed.

Usage: test_ties.py COMMAND DATA
"""
import itertools
import json
import math
import os
import random
import shlex
import sys
import tempfile
from fractions import Fraction

import svg
from harness import count, expect, main, run


def text(points):
    return ''.join(f'{x} {y}\n' for x, y in points)


def gon(n):
    return [(f'cos(2*pi*{k}/{n})', f'sin(2*pi*{k}/{n})') for k in range(n)]


def turned(coordinates, c, s):
    """The grid of these coordinates, turned by the angle of that cosine and sine."""
    return [(f'({a})*{c}-({b})*{s}', f'({a})*{s}+({b})*{c}') for a in coordinates for b in coordinates]


def half_angles(n):
    """The n-gon, n a power of two, by half-angle formulas."""
    def cosine_sine(t):
        if t > Fraction(1, 8):
            return cosine_sine(Fraction(1, 4) - t)[::-1]
        if t in (0, Fraction(1, 8)):
            return ('1', '0') if t == 0 else ('sqrt(2)/2', 'sqrt(2)/2')
        double = cosine_sine(2 * t)[0]
        return f'sqrt((1+{double})/2)', f'sqrt((1-{double})/2)'

    def corner(t):
        c, s = cosine_sine(t % Fraction(1, 4))
        return [(c, s), (f'-{s}', c), (f'-{c}', f'-{s}'), (s, f'-{c}')][int(4 * t)]
    return [corner(Fraction(k, n)) for k in range(n)]


def on_circle(n):
    """Rational points of the unit circle times sqrt(3)."""
    points = []
    for k in range(n):
        t = Fraction(2 * k, n) - 1 + Fraction(1, 97)
        c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        points.append((f'sqrt(3)*({c})', f'sqrt(3)*({s})'))
    return points


ROOTS = [f'{k}+sqrt({p})' for k, p in enumerate((2, 3, 5, 7))]
STEPS = [f'{k}*sqrt(2)' for k in range(20)]


def test_everything_is_decided():
    for name, points, legal, tie in (
            ('12-gon', gon(12), 12, 54), ('100-gon', gon(100), 100, 4850), ('360-gon', gon(360), 360, 64260),
            ('grid, 30 degrees', turned(ROOTS, 'cos(pi/6)', 'sin(pi/6)'), 24, 30),
            ('grid, 3 4 5', turned(ROOTS, '3/5', '4/5'), 24, 30),
            ('grid, 3 4 5 times roots', turned(ROOTS, '3/5*sqrt(2)', '4/5*sqrt(2)'), 24, 30),
            ('grid, 2 pi / 7', turned(STEPS, 'cos(2*pi/7)', 'sin(2*pi/7)'), 760, 1406),
            ('grid, one radian', turned(STEPS, 'cos(1)', 'sin(1)'), 760, 1406),
            ('circle', on_circle(30), 30, 405),
            ('line', [(f'sqrt({k})', f'2*sqrt({k})+1') for k in range(2, 12)], 9, 36),
            ('16-gon', half_angles(16), 16, 104), ('32-gon', half_angles(32), 32, 464)):
        result = run('delaunay', '-', stdin=text(points))
        expect(result, 3, err=f'dyadel: {legal} legal, 0 indeterminate, {tie} tied')
        assert count(result.out) == {'legal': legal, 'tie': tie}, name


def test_without_proofs():
    off = run('delaunay', '-', '--ties', 'off', '--max-bits', '200', stdin=text(gon(12)))
    expect(off, 4, err='12 legal, 54 indeterminate pairs')
    expect(run('delaunay', '-', '--ties', 'prove', stdin=text(gon(12))), 3)
    few = run('delaunay', '-', '--tie-bits', '16', '--max-bits', '200', '--stats',
              stdin='cbrt(2+sqrt(5))+cbrt(2-sqrt(5)) 0\n1 0\n4 5\n')
    expect(few, 4, err='^zero or not, unknown +[1-9]')


def test_aliases():
    for one, other in (('sqrt(8)', '2*sqrt(2)'), ('cbrt(2+sqrt(5))+cbrt(2-sqrt(5))', '1'), ('pi+e', 'e+pi'),
                       ('2*sin(pi/6)', '1'), ('sqrt(2)*sqrt(2)', '2'), ('root(x^4-10*x^2+1,3,4)', 'sqrt(2)+sqrt(3)'),
                       ('root(x^2-2,1,2)+1', 'root(x^2-2,1,2)+1'), ('root(x^2-2,1,2)+1', 'sqrt(2)+1'),
                       ('root(x^2-2,1,2)+1', '1+root(x^2-2,1,3/2)'), ('root(x^5-x-1,1,2)^5', '1+root(x^5-x-1,0,2)'),
                       ('root(x^2-2,1,2)*root(x^2-3,1,2)', 'sqrt(6)')):
        points = f'{one} 0\n10 10\n{other} 0\n-9 4\n'
        expect(run('delaunay', '-', stdin=points), 0, r'\A# alias 2 0\ni,j,status\n0,1,legal\n0,3,legal\n1,3,legal\n\Z')
        expect(run('voronoi', '-', stdin=points), 0, '^# alias 2 0$')
        expect(run('check', 'points', '--schedules', '2', cwd=points_folder(points)), 0, '^fine,2,')


def test_equal_points_on_common_lines():
    """Many equal radicals of large squares, on seven lines: as many aliases as there are pairs, at once."""
    count_of = 400
    points = text([(x, k % 7) for k in range(1, count_of + 1) for x in (f'sqrt({8 * k * k})', f'{2 * k}*sqrt(2)')])
    found = run('delaunay', '-', '--layer', 'aliases', stdin=points, timeout=60)
    expect(found, 3)
    rows = [tuple(map(int, line.split(','))) for line in found.out.splitlines() if line[:1].isdigit()]
    assert rows == [(2 * k + 1, 2 * k) for k in range(count_of)], rows[:9]
    points = text([(f'sqrt({8 * k * k})', k % 7) for k in range(1, 2001)])
    expect(run('delaunay', '-', '--stats', stdin=points, timeout=60), 3, err='^zero or not, unknown +0$')


def test_roots_of_large_degree():
    """Of degree 1000, and no more: products of two are the same by identity, at once."""
    one, two = 'root(x^1000-x-1,1,2)*root(x^999-x-1,1,2)', 'root(x^999-x-1,1,3/2)*root(x^1000-x-1,1,3/2)'
    expect(run('delaunay', '-', stdin=f'{one} 0\n10 10\n{two} 0\n-9 4\n', timeout=60), 0, r'\A# alias 2 0$')
    expect(run('delaunay', '-', '--max-bits', '100', stdin=f'{one} 0\n10 10\n{one}+2^-80 0\n', timeout=60), 0, r'\Ai,j')
    expect(run('delaunay', '-', stdin='root(x^1001-x-1,1,2) 0\n'), 1, r'\A\Z', ':1:7: .*: degree at most 1000, ')


def points_folder(points, keep=[]):
    """A folder with the file `points`; it stays for the life of the process."""
    folder = tempfile.TemporaryDirectory()
    keep.append(folder)
    with open(os.path.join(folder.name, 'points'), 'w', encoding='utf-8') as f:
        f.write(points)
    return folder.name


def test_nothing_is_claimed():
    """Values that are equal for an unknown reason; wrong branches; other roots."""
    for one, other, code in (('pi', '4*atan(1)', 4), ('exp(sqrt(2))*exp(sqrt(3))', 'exp(sqrt(2)+sqrt(3))', 4),
                             ('sqrt(6)', '-sqrt(2)*sqrt(3)', 0), ('root((x^2-2)*(x^2-3),1,3/2)', 'sqrt(3)', 0),
                             ('root(x^2-2,1,2)+1', 'root(x^2-3,1,2)+1', 0),
                             ('root(x^2-2,1,2)+1', 'root(x^2-2,-2,-1)+1', 0),
                             ('root(x^5-x-1,1,2)+1', 'root(x^5-x-2,1,2)+1', 0),
                             ('root(x^5-x-1,1,2)-root(x^5-x-2,1,2)', '-1/10', 0), ('sqrt(2)', 'sqrt(2+2^-3000)', 0)):
        result = run('delaunay', '-', stdin=f'{one} 0\n{other} 0\n0 10\n0 -11\n')
        expect(result, code)
        assert 'alias' not in result.out and 'tie' not in result.out, (one, other)


def test_one_corner_is_not_described():
    for corner in ('[0.99999,1.00001] 0', 'tan(atan(1)) 0', '1+-1e-9 0'):
        points = corner + '\n' + text(gon(12)[1:])
        result = run('delaunay', '-', '--max-bits', '200', stdin=points)
        assert result.code in (3, 4) and 'tie' not in count(result.out), corner


ORACLE = '''import math, sys
def cosine(part, bits):  # times 2^(bits + 2), of so many twelfths of a turn: between these
    unit = 4 << bits
    twice = {0: 2, 2: 1, 3: 0, 4: -1, 6: -2, 8: -1, 9: 0, 10: 1}.get(part % 12)
    if twice is not None:
        return twice * unit // 2 - 1, twice * unit // 2 + 1
    low = math.isqrt(3 * unit * unit // 4)
    return (low, low + 1) if part % 12 in (1, 11) else (-low - 1, -low)
print('points 12', flush=True)
for line in sys.stdin:
    point, bits = map(int, line.split()[1:])
    bits = max(bits, 0)
    print(point, *(f'{end}*2^-{bits + 2}' for k in (point, point - 3) for end in cosine(k, bits)), flush=True)
'''


def test_corners_from_a_program():
    """Points of a program have no known expressions: of its 12-gon the sides are decided, and the other pairs stay
    indeterminate."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'corners.py')
        with open(path, 'w', encoding='utf-8') as f:
            f.write(ORACLE)
        command = 'exec ' + shlex.join([sys.executable, path])
        result = run('delaunay', '--oracle', command, '--max-bits', '200')
        expect(result, 4, err='budget: 12 legal, 54 indeterminate pairs')
        assert count(result.out) == {'legal': 12, 'indeterminate': 54}
        assert 'tied' not in run('nearest', '--oracle', command, '--max-bits', '200', '0', '0').out


def test_counters():
    result = run('delaunay', '-', '--stats', stdin=text(gon(12)))
    for line in ('zero tests +9', 'zero by identity +[0-9]+', 'zero by bound +[0-9]+', 'not zero +0',
                 'zero or not, unknown +0', 'bits in tests, most +[1-9][0-9]*', 'degree in tests, most +[0-9]+',
                 r'seconds in tests +0\.[0-9]{3}'):
        expect(result, 3, err=f'^{line}$')


def test_counters_in_json():
    result = run('delaunay', '-', '--format', 'json', stdin=text(gon(12)))
    counters = json.loads(result.out)['counters']
    assert counters['zero_tests'] == 9 == counters['zero_by_identity'] + counters['zero_by_bound'], counters
    assert counters['not_zero'] == counters['zero_unknown'] == 0 < counters['zero_bits_most'], counters
    assert counters['zero_milliseconds_rounded_up'] > 0 <= counters['zero_degree_most'], counters


def test_edges_of_the_diagram():
    """The sides of a tied polygon end at its vertex, computable or exact: named as in its row, drawn as a line."""
    for n, more, corners in ((12, '', gon(12)), (5, '', gon(5)),
                             (4, '7 9\n', [('0', '0'), ('2', '0'), ('2', '2'), ('0', '2')])):
        points = text(corners) + more
        table = run('voronoi', '--layer', 'vertices', '-', stdin=points)
        expect(table, 3, '^# tie ' + ' '.join(map(str, range(n))) + '$')
        expect(table, 3, '^0,1,2,')
        result = run('voronoi', '--layer', 'edges', '-', stdin=points)
        ends = {tuple(map(int, line.split(',')[:2])): line.split(',')[2:]
                for line in result.out.splitlines() if line[0].isdigit()}
        for k in range(n):
            i, j = sorted((k, (k + 1) % n))
            inside = 0 if j == i + 1 else 1  # the polygon is on the left of k to k + 1
            assert ends[i, j][inside] == '0 1 2' and ends[i, j][1 - inside] != '0 1 2', (i, j, ends[i, j])
        assert not any('open' in e for e in ends.values()), ends
        drawn = json.loads(run('voronoi', '--layer', 'edges', '--format', 'geojson', '-', stdin=points).out)['features']
        assert len(drawn) == len(ends)
        data = json.loads(run('voronoi', '--format', 'json', '-', stdin=points).out)
        tied = next(k for k, v in enumerate(data['vertices']) if v['sites'] == list(range(n)))
        assert sum(tied in (e['from'], e['to']) for e in data['edges']) == n, data['edges']


def test_tied_vertex_in_pictures():
    """It is drawn once, as a tie."""
    for points in text(gon(12)), '0 0\n2 0\n2 2\n0 2\n':
        picture = run('voronoi', '--quiet', '--format', 'svg', '-', stdin=points).out
        titles = [e.title for e in svg.elements(picture) if e.title and 'vert' in e.title]
        assert len(titles) == 1 and titles[0].startswith('holds the vertex of a tie, of 0, 1, 2'), titles
        assert 'box: contains a certain vertex' in svg.words(picture) and 'box: undecided vertices' not in svg.words(picture)


def test_edges_of_grids():
    """Every inner side is between two tied vertices, which hold it."""
    for points, n in ((text(turned(STEPS[:4], 'cos(1)', 'sin(1)')), 4), (''.join(f'{x} {y}\n' for x in range(5) for y in range(5)), 5)):
        data = json.loads(run('voronoi', '--format', 'json', '-', stdin=points).out)
        assert len(data['vertices']) == (n - 1)**2 and all(len(v['sites']) == 4 for v in data['vertices'])
        both = 0
        for edge in data['edges']:
            ends = [edge[k] for k in ('from', 'to') if isinstance(edge[k], int)]
            assert all({edge['i'], edge['j']} <= set(data['vertices'][k]['sites']) for k in ends) and ends, edge
            both += len(set(ends)) == 2
        assert both == 2 * (n - 1) * (n - 2), both


def check_rays(places, typed, true):
    """An edge of the diagram goes to infinity on a side of i to j where no other point is, straight away from the line
    ij, and ends in a vertex on others. places: of the points, exactly; true: where a vector between them is turned to."""
    data = json.loads(run('voronoi', '--format', 'json', '-', stdin=text(typed)).out)
    for edge in data['edges']:
        (ax, ay), (bx, by) = places[edge['i']], places[edge['j']]
        turns = [(bx - ax) * (y - ay) - (by - ay) * (x - ax) for x, y in places]
        for side, end in ((1, edge['from']), (-1, edge['to'])):
            if any(side * t > 0 for t in turns):
                assert isinstance(end, int), (typed, edge)
                continue
            for axis, value in zip('xy', true(side * (ay - by), side * (bx - ax))):
                low, high = end['ray'][axis]
                assert low <= value + 1e-9 and value - 1e-9 <= high and high - low < 1e-9, (typed, edge)
    return len(data['edges'])


def test_rays():
    """Beyond tied chains of the hull, too: all sets of 2, 3 and 4 points of a grid, exact and turned, and larger ones."""
    c, s = math.cos(1), math.sin(1)
    seen = 0
    for n in (2, 3, 4):
        for k, places in enumerate(itertools.combinations(itertools.product(range(3), repeat=2), n)):
            seen += check_rays(places, places, lambda x, y: (x, y))
            if k % 5 == 0:
                typed = [(f'{x}*cos(1)-{y}*sin(1)', f'{x}*sin(1)+{y}*cos(1)') for x, y in places]
                seen += check_rays(places, typed, lambda x, y: (c * x - s * y, s * x + c * y))
    assert seen > 800, seen
    grid = [(x, y) for x in (2, 3, 5, 7) for y in (2, 3, 5, 7)]
    typed = turned([f'{k}*sqrt(3)' for k in (2, 3, 5, 7)], '3/5', '4/5')
    assert check_rays(grid, typed, lambda x, y: (3**.5 * (.6 * x - .8 * y), 3**.5 * (.8 * x + .6 * y))) == 24
    line = [(f'sqrt({k})', f'2*sqrt({k})+1') for k in range(2, 12)]
    for more, rays in (([], 18), ([('5', '0')], 11)):
        result = run('voronoi', '--layer', 'edges', '-', stdin=text(line + more))
        expect(result, 3)
        assert 'open' not in result.out and result.out.count('ray') == rays, result.out


def sets_of_points():
    """Points of the integers with many ties: a chain on the hull with points inside, a grid, and others at random."""
    yield [(0, 0), (1, 0), (3, 0), (4, 0), (1, 1), (2, 2), (3, 1)]
    yield list(itertools.product(range(4), repeat=2))
    yield [(k, 0) for k in range(5)]
    choose = random.Random(14)
    for n in range(4, 16):
        yield choose.sample(list(itertools.product(range(5), repeat=2)), n)


def turned_text(x, y):
    return f'sqrt(2)*({x}*cos(1)-{y}*sin(1))', f'sqrt(2)*({x}*sin(1)+{y}*cos(1))'


def all_answers(points, place):
    """Statements about points, without their positions."""
    data = {command: json.loads(run(command, '--quiet', '--format', 'json', '-', stdin=points).out)
            for command in ('delaunay', 'voronoi')}
    one, two = data['delaunay'], data['voronoi']
    near = json.loads(run('nearest', '--format', 'json', '-', *place, stdin=points).out)
    layer = run('delaunay', '--quiet', '--layer', 'points', '-', stdin=points).out.splitlines()
    yield 'pairs', run('delaunay', '--quiet', '-', stdin=points).out
    yield 'count', one['count'], two['count'], one['outcome'], two['outcome']
    yield 'hull', one['hull']
    yield 'aliases', one['aliases'], two['aliases']
    yield 'sites', [[s[k] for k in ('i', 'legal', 'indeterminate', 'tie', 'hull')] for s in one['sites']]
    yield 'layer', [[k for q, k in enumerate(line.split(',')) if not 1 <= q <= 4] for line in layer if line[0] != '#']
    yield 'triangles', one['triangles']
    yield 'vertices', sorted(v['sites'] for v in two['vertices'])
    yield 'edges', [[e['i'], e['j']] + [two['vertices'][e[k]]['sites'] if isinstance(e[k], int) else list(e[k])
                                        for k in ('from', 'to')] for e in two['edges']]
    drawn = svg.elements(run('delaunay', '--quiet', '--format', 'svg', '-', stdin=points).out)
    yield 'picture', sorted(e.title for e in drawn if e.title and e.title[:5] != 'point')
    yield 'nearest', near['tied'], near['outcome'], [(p['i'], p['status']) for p in near['nearest']]


def test_turned_points_answer_as_exact_ones():
    """In all formats: statements proved for points turned by one radian equal the statements for exact ones; with an
    alias, too."""
    for points in sets_of_points():
        alias = points[-1]
        exact = list(all_answers(text(points + [alias]), ('3/2', '1/2')))
        turned_ones = [turned_text(x, y) for x, y in points]
        turned_ones.append([f'{t}+sqrt(8)-2*sqrt(2)' for t in turned_ones[-1]])
        for should, found in zip(exact, all_answers(text(turned_ones), turned_text('3/2', '1/2'))):
            assert should == found, (points, should, found)


def test_traces():
    for points in (text(gon(7)), 'sqrt(8) 0\n2*sqrt(2) 0\n5 5\n1 9\n'):
        folder = points_folder(points)
        first = run('converge', 'points', '--trace', 'trace', '--no-times', cwd=folder)
        again = run('converge', '--replay', 'trace', '--no-times', cwd=folder)
        rows = [[line for line in r.out.splitlines() if not line.startswith('#')] for r in (first, again)]
        assert first.code == again.code and len(rows[0]) > 1, (first, again)
        with open(os.path.join(folder, 'trace'), encoding='utf-8') as f:
            trace = f.read()
        assert '"proved":"co' in trace
        broken = trace.replace('"proved":"co', '"proved":"no')
        expect(run('converge', '--replay', '-', stdin=broken), 1, err='no such proof about points is known')


def test_certificates():
    for points, facts in ((text(gon(7)), 1), ('sqrt(8) 0\n2*sqrt(2) 0\n5 5\n1 9\n', 1)):
        folder = points_folder(points)
        run('delaunay', 'points', '--certificate', 'cert', cwd=folder)
        expect(run('verify', 'cert', cwd=folder), 0, f'^checked: .*: {facts} identities')


main(globals())
