#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel converge: the table against known facts of the run, both schedules, traces and their replay, plots.

Usage: test_converge.py COMMAND DATA
"""
import csv
import itertools
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from decimal import Decimal, localcontext
from fractions import Fraction

from harness import COMMAND, expect, main, run, sealed

# Twelve points; the last two are 2^-200 apart.
FAR = [(13, 7), (91, 12), (55, 98), (8, 77), (73, 61), (34, 42), (60, 25), (20, 95), (97, 84), (45, 70)]
NEAR_PAIR = ''.join(f'{x}+sqrt({2 + k * k})/7 {y}+exp(-{k})/11\n' for k, (x, y) in enumerate(FAR))
NEAR_PAIR += '50+sqrt(2) 50+sqrt(3)\n50+sqrt(2)+3*2^-202 50+sqrt(3)+2^-201\n'
# Twelve points; the last four on a circle but for 2^-200.
NEAR_CIRCLE = ''.join(f'{x}+sqrt({2 + k * k})/7 {y}+exp(-{k})/11\n' for k, (x, y) in enumerate(FAR[:8]))
NEAR_CIRCLE += '50+cos(1) 50+sin(1)\n50+cos(2) 50+sin(2)\n50+cos(4) 50+sin(4)\n50+(1+2^-200)*cos(5) 50+(1+2^-200)*sin(5)\n'
MIXED = '0 0\n1/3 [1,1.25]\n0.1 2.7\nsqrt(2) 1\n0 0.0\n3 1e-3\n5 5\n-sqrt(2) pi\n2^-300 -7/3\n'
SQUARE = 'exp(log(6)/2) 0\n0 sqrt(6)\n-exp(log(6)/2) 0\n0 -sqrt(6)\n'


def table(*args, text, code=0):
    result = run('converge', '-', '--no-times', *args, stdin=text)
    expect(result, code, r'^stage,bits_least')
    lines = [line for line in result.out.splitlines() if not line.startswith('#')]
    return list(csv.DictReader(lines))


def test_discs():
    """The last row counts what delaunay --discs lists, its bounds are below those of squares; exit 0 where discs are decided."""
    text = 'x,y,r\n0,0,1\n10,0,2\n5,8,1\n5,-7,0\n14,9,1\n'
    for scale, code in (('1', 3), ('0.3', 0), ('0.1', 0)):
        how = '--columns', 'x,y', '--radius-column', 'r', '--radius-scale', scale
        of = '--of', 'voronoi'
        pairs = run('delaunay', '-', *how, '--discs', comments=False, stdin=text)
        assert pairs.code == code, (scale, pairs.code)
        row, squares = table(*how, *of, '--discs', text=text, code=code)[-1], table(*how, *of, text=text, code=3 if scale != '0.1' else 0)[-1]
        status = [line.split(',')[2] for line in pairs.out.splitlines()[1:]]
        assert [int(row[k]) for k in ('legal', 'indeterminate')] == [status.count(k) for k in ('legal', 'indeterminate')], row
        assert float(row['v_area']) < float(squares['v_area']) and float(row['v_hausdorff']) <= float(squares['v_hausdorff'])
    expect(run('converge', '-', '--discs', stdin='[0,1] [0,3]\n3 4\n'), 1, r'\A\Z', 'point 0: a disc needs one radius')
    expect(run('converge', '-', '--discs', '--of', 'bisector', stdin='0 0\n3 4\n'), 2, r'\A\Z', 'is about rectangles')
    expect(run('converge', '-', '--discs', '--format', 'html', stdin='0 0\n3 4\n'), 2, r'\A\Z', 'html shows rectangles')


def test_columns_agree_with_delaunay():
    for text in (NEAR_PAIR, NEAR_CIRCLE, MIXED):
        last = table('--start-bits', '64', text=text, code=run('delaunay', '-', stdin=text).code)[-1]
        answer = json.loads(run('delaunay', '-', '--format', 'json', stdin=text).out)
        for name in ('legal', 'indeterminate', 'tie'):
            assert int(last[name]) == answer['count'][name]
        assert int(last['possible']) == len(answer['pairs'])
        assert int(last['stage']) == answer['counters']['stages'] and int(last['calls']) == answer['counters']['stream_calls']
        for name in ('bits_least', 'bits_most', 'bits_total', 'filter', 'integer', 'exact'):
            assert int(last[name]) == answer['counters'][name], name
        for name in ('area', 'hausdorff'):
            exact = number(answer['bounds'][name]['exact'])
            assert exact <= Fraction(last[name]) <= exact * (1 + Fraction(1, 10 ** 5)), name


def number(text):
    match = re.fullmatch(r'(-?\d+)(?:\*2\^(-?\d+))?(?:/(\d+))?', text)
    return Fraction(int(match[1])) * Fraction(2) ** int(match[2] or 0) / int(match[3] or 1)


def test_widths():
    # Fixed intervals of many widths, one of them a number of 101 bits.
    boxes = ''.join(f'[{k},{k}.{k}] {k * k}\n' for k in range(1, 7)) + f'[0,{2 ** 100 + 1}*2^-97] 50\n'
    for text in (MIXED, MIXED + boxes, boxes):
        how = ('--format', 'json', '--max-bits', '40', '--start-bits', '40', '--quiet')
        answer = json.loads(run('delaunay', '-', *how, stdin=text).out)
        widths = sorted(max(number(s[a][1]) - number(s[a][0]) for a in 'xy') for s in answer['sites'])
        row = json.loads(run('converge', '-', *how, stdin=text).out)['stages'][-1]
        for name, width in (('width_largest', widths[-1]), ('width_median', widths[len(widths) // 2])):
            assert width <= number(row[name]['exact']) <= width * (1 + Fraction(1, 2 ** 62)), name
            assert Fraction(row[name]['decimal']) >= number(row[name]['exact'])


def test_bounds_fall_by_half_per_bit():
    # Uniform steps of 8 bits: widths and area fall by 2^-8 a stage, while the near-tie stays open until about bit 200.
    for text in (NEAR_PAIR, NEAR_CIRCLE):
        rows = table('--schedule', 'uniform', '--step-bits', '8', text=text)
        for before, row in zip(rows[2:], rows[3:]):
            assert int(row['bits_most']) == int(before['bits_most']) + 8 == int(row['bits_least'])
            for name in ('width_largest', 'width_median', 'area'):
                ratio = Fraction(before[name]) / Fraction(row[name])
                assert 2 ** 7 < ratio < 2 ** 9, (name, before[name], row[name])
        opened = [int(row['bits_most']) for row in rows if row['indeterminate'] != '0']
        assert 180 <= max(opened) <= 216, max(opened)
        assert rows[-1]['indeterminate'] == '0' and int(rows[-1]['bits_most']) <= 220


def test_hausdorff_falls_by_half_per_bit():
    rows = table('--schedule', 'uniform', '--step-bits', '8', '--until', 'hausdorff:300', text=NEAR_PAIR)
    decided = [row for row in rows if row['indeterminate'] == '0']
    assert len(decided) > 10
    for before, row in zip(decided, decided[1:]):
        assert 2 ** 7 < Fraction(before['hausdorff']) / Fraction(row['hausdorff']) < 2 ** 9
    assert Fraction(rows[-1]['hausdorff']) <= Fraction(1, 2 ** 300) * (1 + Fraction(1, 10 ** 5))


def test_voronoi_bounds():
    # Four nearly cocircular points: T stays open, the bounds of V fall with the widths all the same.
    rows = table('--of', 'voronoi', '--schedule', 'uniform', '--step-bits', '8', '--max-bits', '90', text=NEAR_CIRCLE, code=4)
    for before, row in zip(rows[2:], rows[3:-1]):
        for name in ('v_area', 'v_hausdorff'):
            assert 2 ** 7 < Fraction(before[name]) / Fraction(row[name]) < 2 ** 9, (name, before[name], row[name])
    # With --window; the undetermined area is at most the window.
    text = ''.join(f'[{x - 0.1},{x + 0.1}] {y}\n' for x, y in FAR)
    small, large = (table('--of', 'voronoi', '--window', w, text=text)[-1] for w in ('40,60,40,60', '0,100,0,100'))
    assert 0 < Fraction(small['v_area']) < 400 and Fraction(small['v_area']) < Fraction(large['v_area']) < 10000
    assert 'window 40,50,40,50\n' in run('converge', '-', '--of', 'voronoi', '--window', '40,50,40,50', stdin=text).out
    answer = json.loads(run('converge', '-', '--of', 'voronoi', '--format', 'json', '--window', '40,50,40,50', stdin=text).out)
    assert answer['window'] == ['40', '50', '40', '50']
    row = table(text=text)[-1]
    assert row['v_area'] == row['v_hausdorff'] == ''
    # Exact points: nothing is undetermined but for the flattening of cells, which have straight edges.
    row = table('--of', 'voronoi', text='0 0\n1 0\n1 1\n0 1\n5 7\n', code=3)[-1]
    assert Fraction(row['v_hausdorff']) == 0 and Fraction(row['v_area']) < Fraction(1, 2 ** 40)


def test_adaptive_asks_for_a_fifth():
    for steps in ((), ('--step-bits', '8')):
        adaptive, uniform = (table('--schedule', s, *steps, text=NEAR_PAIR)[-1] for s in ('adaptive', 'uniform'))
        assert adaptive['indeterminate'] == uniform['indeterminate'] == '0'
        assert adaptive['statuses'] == uniform['statuses']
        assert 5 * int(adaptive['bits_total']) <= int(uniform['bits_total']), (adaptive['bits_total'], uniform['bits_total'])
        # Of four nearly cocircular points each has to be known: a third of the bits, and little more.
        adaptive, uniform = (table('--schedule', s, *steps, text=NEAR_CIRCLE)[-1] for s in ('adaptive', 'uniform'))
        assert adaptive['statuses'] == uniform['statuses']
        assert int(adaptive['bits_total']) <= 0.4 * int(uniform['bits_total']), (adaptive['bits_total'], uniform['bits_total'])


def test_same_bytes_every_time():
    for text in (NEAR_PAIR, MIXED):
        for how in (('--format', 'csv'), ('--format', 'json'), ('--schedule', 'uniform')):
            runs = [run('converge', '-', '--no-times', *how, '--threads', t, stdin=text) for t in '1124']
            assert all(r.out == runs[0].out for r in runs)
            timed = run('converge', '-', *how, stdin=text).out
            assert timed != runs[0].out and 'seconds' in timed


def test_outcomes():
    expect(run('converge', '-', '--max-bits', '100', stdin=SQUARE), 4, 'outcome budget', 'precision limit reached')
    expect(run('converge', '-', stdin='0 0\n1 0\n1 1\n0 1\n'), 3, 'outcome fixpoint', '2 tied pairs; ties')
    expect(run('converge', '-', '--until', 'area:30', stdin=SQUARE), 0, 'goal area 2.-30; .*outcome certified', r'\A\Z')
    expect(run('converge', '-', stdin=''), 0, r'^1,0,0,0,0,0,0,0,0,0,0,', 'this file has no points')


# The corners of a square, nearly; no more than 60 bits are to be had.
ORACLE = '''
import sys
print("points 4", flush=True)
for line in sys.stdin:
    word, i, bits = line.split()
    if int(bits) > 60:
        sys.exit(1)
    x, y = [(2, 0), (0, 2), (-2, 0), (0, -2)][int(i)]
    print(i, *(f"{v * 2 ** 70 + s}*2^-70" for v in (x, y) for s in (-5, 5)), flush=True)
'''


def test_a_point_that_fails_later():
    with tempfile.TemporaryDirectory() as folder:
        path, trace = os.path.join(folder, 'oracle.py'), os.path.join(folder, 'trace')
        with open(path, 'w', encoding='utf-8') as f:
            f.write(ORACLE)
        command = ('--oracle', f'{sys.executable} {path}')
        result = run('converge', '--no-times', '--trace', trace, *command)
        expect(result, 1, 'outcome error(.*\n)+3,', 'point [0-3]: (.*\n)*.*a point failed; the result is the one before it')
        expect(run('delaunay', '--start-bits', '20', *command), 1, '0,2,indeterminate', 'point [0-3]: ')
        expect(run('converge', '--replay', trace, '--no-times'), 1, re.escape(result.out), r'\A\Z')


def test_capped():
    boxes = ''.join(f'[-{k},{k}] [-{k},{k}]\n' for k in range(1, 30))
    rows = table('--max-pairs', '10', text=boxes, code=4)
    assert rows[-1]['area'] == rows[-1]['hausdorff'] == ''
    stages = json.loads(run('converge', '-', '--format', 'json', '--max-pairs', '10', stdin=boxes).out)['stages']
    assert stages[-1]['area'] is None


def trace_of(folder, text, *args):
    path = os.path.join(folder, 'trace')
    result = run('converge', '-', '--no-times', '--trace', path, *args, stdin=text)
    with open(path, encoding='utf-8') as f:
        return result, f.read()


def test_trace_and_replay():
    cases = [(text, how) for text in (NEAR_PAIR, NEAR_CIRCLE, MIXED, SQUARE, '', '1 1\n', 'pi e\n0 0\n')
             for how in (('--schedule', 'adaptive'), ('--schedule', 'uniform'), ('--until', 'area:20'), ('--of', 'voronoi'), ('--of', 'voronoi', '--window', '-1,1/3,0,2'),
                         ('--until', 'hausdorff:20'), ('--step-bits', '30'), ('--format', 'json'))]
    with tempfile.TemporaryDirectory() as folder:
        for text, how in cases:
            result, trace = trace_of(folder, text, '--max-bits', '300', *how)
            steps = [json.loads(line) for line in trace.splitlines()]
            assert steps[0]['format'] == 'dyadel trace 2' and 'outcome' in steps[-1]
            assert {s['why'] for s in steps if 'why' in s} <= {'first', 'end', 'blocker', 'bound', 'uniform', 'fixed'}
            again = run('converge', '--no-times', '--replay', '-', *(how if how[0] == '--format' else ()), stdin=trace)
            assert (again.code, again.out) == (result.code, result.out), (text, how, again.err)
            # Rectangles only shrink, and every pair named is there for a reason.
            seen = {}
            for s in steps:
                if 'x' not in s:
                    continue
                now = [number(v) if '2^' in v or '/' not in v else Fraction(v) for v in s['x'] + s['y']]
                old = seen.get(s['point'], now)
                assert old[0] <= now[0] <= now[1] <= old[1] and old[2] <= now[2] <= now[3] <= old[3]
                assert s['point'] in s.get('pair', [s['point']])
                seen[s['point']] = now
            assert len(seen) == steps[0]['points'] == sum('x' in s and s['stage'] == 1 for s in steps)


def test_bad_traces():
    with tempfile.TemporaryDirectory() as folder:
        _, trace = trace_of(folder, NEAR_CIRCLE, '--of', 'voronoi')
    lines = trace.splitlines(keepends=True)

    def replay(text, code, message):
        expect(run('converge', '--replay', '-', '-o', '/dev/null', stdin=sealed(text)), code, r'\A\Z', message)

    replay(trace, 0, r'\A\Z')
    for _ in range(20):  # a limit that ends before its thread begins
        expect(run('converge', '--replay', '-', '-o', '/dev/null', '--timeout', '1e-9', stdin=trace), 4, r'\A\Z', 'time limit')
    replay('', 1, 'the trace ends before its outcome')
    replay('0 0\n', 1, r'\Adyadel: -:1:1: this line is no JSON object; give a trace as dyadel wrote it')
    replay('{}\n', 1, '-:1:1: this is no trace of the format "dyadel trace 2"')
    for k in range(1, len(lines)):
        replay(''.join(lines[:k]), 1, 'the trace ends before its outcome')
    replay(trace + lines[1], 1, 'has lines after its outcome')
    for field in ('points', 'schedule', 'goal', 'start_bits', 'max_pairs'):
        replay(re.sub(rf',"{field}":[^,}}]*', '', trace, count=1), 1, ':1:1: the first line lacks a field')
    replay(trace.replace('"stage":1,"point":3', '"stage":1,"point":99', 1), 1, 'there is no such point')
    replay(trace.replace('"stage":1,"point":3', '"stage":1,"point":4', 1), 1, 'not inside the one before|before every point')
    replay(re.sub(r'("stage":2.*"x":\[)"[^"]*"', r'\1"-1000"', trace, count=1), 1, 'not inside the one before')
    replay(re.sub(r'("stage":1.*"x":\[)"[^"]*"', r'\1"pi"', trace, count=1), 1, 'this is no rectangle')
    replay(re.sub(r'"legal":(\d+)', r'"legal":1', trace, count=1), 1, 'differ from those in the trace')
    replay(re.sub(r'"statuses":"(.)', r'"statuses":"x', trace, count=1), 1, 'differ from those in the trace')
    # Other rectangles, other statuses: without the last refinement the pairs stay open.
    last = [k for k, line in enumerate(lines) if '"why":"end"' in line][-4:]
    replay(''.join(line for k, line in enumerate(lines) if k not in last), 1, 'differ from those in the trace')
    expect(run('converge', '--replay', 'nowhere'), 1, r'\A\Z', 'nowhere: cannot open')
    expect(run('converge', '--replay', '-', '-', stdin=trace), 2, r'\A\Z', 'one argument too many')
    expect(run('converge', '--replay', '-', '--timeout', '60', '-o', '/dev/null', stdin=trace), 0, r'\A\Z', r'\A\Z')
    expect(run('converge', '--replay', '-', '--timeout', '1e-9', stdin=trace), 4, '', 'time limit reached after 0 stages')
    for option in ('--measured', '--max-bits=5', '--schedule=uniform'):
        expect(run('converge', '--replay', '-', option, stdin=trace), 2, r'\A\Z', 'from the trace; remove --')


def test_points_far_smaller_than_the_first_boxes():
    """Polygons are as fine as it helps: the window is that of the first boxes, and arcs have an end."""
    tiny = '(-33*2^-79)+(cbrt(17))*2^-81 7*2^-77\n(43*2^-79)+(e*11)*2^-81 (-85*2^-80)+(atan(24))*3*2^-81\n' \
           '(47*2^-79)+(log(17))*2^-80 (-43*2^-79)+(sqrt(26))*3*2^-81\n'
    stages = table('--of', 'voronoi', '--timeout', '60', text=tiny)
    assert stages[-1]['legal'] == '3' and all(stage['v_area'] for stage in stages), stages
    assert all(Fraction(a['v_area']) >= Fraction(b['v_area']) for a, b in zip(stages, stages[1:])), stages


def test_goals_of_the_diagram():
    """--of says whose bound --until means: each stops as soon as its own column is small enough."""
    steps = ('--schedule', 'uniform', '--step-bits', '1', '--max-bits', '60')
    apart = ''.join(NEAR_CIRCLE.splitlines(True)[:8])
    for of, until, column in ((('--of', 'voronoi'), 'hausdorff', 'v_hausdorff'), (('--of', 'voronoi'), 'area', 'v_area'),
                              (('--of', 'delaunay'), 'hausdorff', 'hausdorff'), ((), 'area', 'area')):
        for window in ((), ('--window', '-20,120,-20,120')):
            rows = table('--until', until + ':12', *of, *steps, *window, text=apart)
            assert len(rows) > 6 and Fraction(rows[-1][column]) <= Fraction(1, 2 ** 12), (of, until, rows[-1])
            if until == 'area':  # that of hausdorff also asks for narrow vertices
                assert Fraction(rows[-2][column]) > Fraction(1, 2 ** 12), (of, until, rows[-2])
    # Nearly cocircular points: the diagram is known well where the triangulation is not decided.
    goal = ('--max-bits', '60', '--until', 'hausdorff:30', '--of')
    diagram = table(*goal, 'voronoi', text=NEAR_CIRCLE)[-1]
    assert diagram['indeterminate'] != '0' and 2 ** 30 * Fraction(diagram['v_hausdorff']) < 1
    last = table(*goal, 'delaunay', text=NEAR_CIRCLE, code=4)[-1]
    assert 2 * Fraction(last['hausdorff']) > 1 and last['v_hausdorff'] == ''
    result = run('converge', '-', '--of', 'voronoi', '--until', 'area:30', '--max-bits', '9', stdin=NEAR_CIRCLE)
    expect(result, 4, '^# .*goal voronoi area 2', r'area of the diagram is at most 2\^\d.*; --until area:-?\d+ holds')
    expect(run('converge', '-', '--no-voronoi', stdin=SQUARE), 2, r'\A\Z', '--of voronoi computes the bounds')
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'trace')
        made = run('converge', '-', '--no-times', '--of', 'voronoi', '--until', 'area:9', '--trace', path, stdin=NEAR_CIRCLE)
        again = run('converge', '--no-times', '--replay', path)
        assert made.code == again.code == 0 and made.out == again.out, made.err + again.err


def circle(a, b, c):
    """Centre and radius, to 60 digits."""
    (x0, y0), (x1, y1), (x2, y2) = a, b, c
    ax, ay, bx, by = x1 - x0, y1 - y0, x2 - x0, y2 - y0
    d, l, m = 2 * (ax * by - ay * bx), ax * ax + ay * ay, bx * bx + by * by
    x, y = (by * l - ay * m) / d, (ax * m - bx * l) / d
    return tuple(Decimal(q.numerator) / q.denominator for q in (x0 + x, y0 + y, x * x + y * y))


def test_disc():
    """Discs through corners lie between I and E [AREA-D]: areas and distances of any two are within the bounds, and not far below."""
    for seed in range(12):
        draw = random.Random(seed)
        width = Fraction(1, draw.choice((16, 64, 1024, 2 ** 20)))
        low = [(Fraction(draw.randrange(64)), Fraction(draw.randrange(64))) for _ in range(3)]
        boxes = [((x, x + width), (y, y + width * draw.choice((1, 0, 3)))) for x, y in low]
        text = ''.join(f'[{x[0]},{x[1]}] [{y[0]},{y[1]}]\n' for x, y in boxes) + '32 33\n[0,90] -7/3\n'
        row = json.loads(run('converge', '-', '--of', 'disc', '--format', 'json', stdin=text).out)['stages'][-1]
        if row['area'] is None:
            assert row['orientation'] == 'unknown' or width > Fraction(1, 1024), (seed, row)
            continue
        with localcontext() as context:
            context.prec = 60
            discs = [circle(*p) for p in itertools.product(*(list(itertools.product(x, y)) for x, y in boxes))]
            area, far = (Decimal(q.numerator) / q.denominator for q in (number(row[k]['exact']) for k in ('area', 'hausdorff')))
            pi = Decimal('3.14159265358979323846264338327950288419716939937510582097494')
            spread = [((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2).sqrt() + abs(a[2].sqrt() - b[2].sqrt())
                      for a, b in itertools.combinations(discs, 2)]
            assert max(spread) <= far <= 2 * max(spread), (seed, far, max(spread))
            assert pi * (max(d[2] for d in discs) - min(d[2] for d in discs)) <= area
            assert area <= Decimal('6.4') * far * max(d[2] for d in discs).sqrt() + 4 * far * far


def test_disc_stages():
    text = 'sqrt(2) 0\n4 sqrt(3)\n0 pi\n1 1\n9 e\n2+sqrt(3)/1000 3.1\n'
    rows = table('--of', 'disc', '--until', 'hausdorff:60', '--step-bits', '8', text=text)
    for before, row in zip(rows[1:], rows[2:]):
        for name in ('area', 'hausdorff', 'width_largest'):
            assert 2 ** 7 < Fraction(before[name]) / Fraction(row[name]) < 2 ** 9
    assert Fraction(rows[-1]['hausdorff']) * 2 ** 60 <= 1 < Fraction(rows[-2]['hausdorff']) * 2 ** 60
    assert all(row['con'] == '3:inside 4:outside 5:inside' and row['unknown'] == '0' for row in rows)
    # A point on the circle stays unknown, and is asked up to the limit; the others are not.
    square = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n0 0\n'
    last = table('--of', 'disc', '--max-bits', '40', text=square, code=4)[-1]
    assert last['con'] == '3:unknown 4:inside' and last['bits_most'] == '40'
    assert table('--of', 'disc', text='0 0\n1 1\n2 2\n5 1\n', code=3)[-1]['area'] == ''
    assert [table('--of', 'disc', text='0 0\n1 0\n0 1\n')[-1][k] for k in ('area', 'hausdorff', 'con')] == ['0', '0', '']
    expect(run('converge', '-', '--of', 'disc', stdin='0 0\n1 1\n'), 1, r'\A\Z', '3 points are needed, here are 2')
    expect(run('converge', '-', '--of', 'disc', '--format', 'html', stdin=text), 2, r'\A\Z', 'remove --of disc')
    expect(run('converge', '--replay', '-', '--of', 'disc', stdin=text), 2, r'\A\Z', 'remove --of')
    with tempfile.TemporaryDirectory() as folder:
        result, trace = trace_of(folder, text, '--of', 'disc', '--until', 'area:30')
        again = run('converge', '-', '--no-times', '--of', 'disc', '--until', 'area:30', '--resume', os.path.join(folder, 'trace'), stdin=text)
        assert again.out == result.out and again.code == 0
        expect(run('converge', '--replay', '-', stdin=trace), 1, r'\A\Z', 'not of a triangulation')
        plot = os.path.join(folder, 'disc.svg')
        assert run('converge', '-', '--of', 'disc', '--plot', plot, stdin=text).code == 0
        with open(plot, encoding='utf-8') as f:
            drawn = f.read()
        assert 'disc' in drawn and 'legal' not in drawn and 'triangulation' not in drawn


def test_bisector_stages():
    """The same bounds as the diagram of the two points alone."""
    two = 'sqrt(2) 0\n4 sqrt(3)\n'
    how = ('--until', 'area:30', '--step-bits', '5', '--window', '0,6,-1,3')
    rows = table('--of', 'bisector', *how, text=two + '0 pi\n')
    diagram = table('--of', 'voronoi', *how, text=two)
    assert [(r['area'], r['hausdorff']) for r in rows] == [(r['v_area'], r['v_hausdorff']) for r in diagram] and len(rows) > 3
    assert {r['disjoint'] for r in rows} == {'yes'} and rows[-1]['calls'] == str(2 * len(rows))
    meeting = table('--of', 'bisector', text='[0,2] 0\n[1,3] 0\n', code=3)[-1]
    assert meeting['disjoint'] == 'no'
    expect(run('converge', '-', '--of', 'bisector', stdin='0 0\n'), 1, r'\A\Z', '2 points are needed, here are 1')


def test_few_stages_of_a_plot():
    """The note says which steps make a curve of it, and they do."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'plot.svg')
        note = re.search(r'the plot has (\d+) stages, .*; --step-bits (\d+) draws up to (\d+)$',
                         run('converge', '-', '--plot', path, stdin=NEAR_PAIR).err, re.M)
        assert note and int(note[1]) < 12 <= int(note[3]) <= 30, note
        stages = run('converge', '-', '--plot', path, '--step-bits', note[2], '--no-times', stdin=NEAR_PAIR)
        rows = [line for line in stages.out.splitlines() if line[0].isdigit()]
        assert 12 <= len(rows) <= int(note[3]), (len(rows), note[3])
        for quiet in (('--quiet', '--plot', path), ()):
            expect(run('converge', '-', *quiet, stdin=NEAR_PAIR), 0, '', r'\A\Z')


def test_plots():
    with tempfile.TemporaryDirectory() as folder:
        for kind, magic in (('svg', b'<?xml'), ('pdf', b'%PDF'), ('png', b'\x89PNG')):
            for text in (NEAR_PAIR, SQUARE, '', '1 1\n', '0 0\n1 0\n1 1\n0 1\n'):
                path = os.path.join(folder, 'plot.' + kind)
                result = run('converge', '-', '--max-bits', '100', '--quiet', '--plot', path, stdin=text)
                assert result.code in (0, 3, 4), result.err
                with open(path, 'rb') as f:
                    data = f.read()
                assert data.startswith(magic) and b'nan' not in data.lower()[:2000]
                os.remove(path)
    expect(run('converge', '-', '--plot', 'nowhere/x.svg', stdin=SQUARE, ), 1, '^stage', 'nowhere/x.svg: cannot write')



def test_sweep():
    """Tables of several runs, put behind each other, are one."""
    table, json_labels = '', []
    for n in range(3, 6):
        for seed in 'ab':
            points = ''.join(f'sqrt({k}) {ord(seed)}*sin({k})\n' for k in range(n))
            label = f'n={n},name of the seed={seed}'
            how = ['--no-times', '--label', label, '-']
            result = run('converge', *how, *(['--rows-only'] if table else []), stdin=points)
            expect(result, 0)
            table += result.out
            json_labels.append(json.loads(run('converge', '--format', 'json', *how, stdin=points).out)['label'])
    rows = list(csv.DictReader(line for line in table.splitlines() if not line.startswith('#')))
    assert [(row['n'], row['name of the seed']) for row in rows if row['stage'] == '1'] == [
        (str(n), seed) for n in range(3, 6) for seed in 'ab']
    assert [(label['n'], label['name of the seed']) for label in json_labels] == [(str(n), s) for n in range(3, 6) for s in 'ab']
    assert all(len(row) == len(rows[0]) and None not in row and None not in row.values() for row in rows)
    for wrong in ('n', 'n=1,', '=3', 'a"=3', 'a=1=2', 'a=\\', ',', 'a=1,,b=2', 'a=b,a=b', 'a=1,b=2,a=3', 'stage=1', 'b=2,seconds=4'):
        expect(run('converge', '--label', wrong, 'none'), 2, err='--label .*NAME=VALUE,NAME=VALUE')


def test_scales_far_apart():
    """Points near 2^-500 in wide boxes of the first stages: polygons of such small arcs would have too many corners."""
    text = ('-5*2^-496 sqrt(5)*sqrt(5)*(-33*2^-500)/5\nsqrt(8)*sqrt(8)*(29*2^-499)/8 (-9*2^-499)+sqrt(81)-9\n'
            '-25*2^-500 min(13*2^-500,13*2^-500)\n(87*2^-500)+pi-pi (17*2^-499)*(sin(5)^2+cos(5)^2)\n')
    table = run('converge', '--of', 'voronoi', '--no-times', '--quiet', '-', stdin=text)
    assert table.code == 0
    last = [line for line in table.out.splitlines() if line[0].isdigit()][-1].split(',')
    assert last[7] == '5' and last[13], 'five legal pairs, a bound of the diagram'


def test_sweeps_of_the_guide():
    """The commands that the guide hands to GNU parallel and to Slurm, for two seeds, as these run them: braces filled in;
    by sh, with the number of the task in the environment."""
    with open(os.path.join(os.path.dirname(__file__), '../guide/convergence.md'), encoding='utf-8') as f:
        (one, array) = re.findall(r"^    (?:parallel|sbatch [^']*) '(dyadel converge [^']*)'", f.read(), re.MULTILINE)
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(os.path.abspath(COMMAND), os.path.join(folder, 'dyadel'))
        where = {**os.environ, 'PATH': f'{folder}:{os.environ["PATH"]}'}
        for seed in '12':
            with open(os.path.join(folder, f'points-10-{seed}.txt'), 'w', encoding='utf-8') as f:
                f.writelines(f'sqrt({k + 2}) {seed}*sin({k})\n' for k in range(10))
        by_one, by_array = '', ''
        for seed in '12':
            by_one += subprocess.run(['sh', '-c', one.replace('{1}', '10').replace('{2}', seed)], cwd=folder, env=where,
                                     stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout
            subprocess.run(['sh', '-c', array], cwd=folder, env={**where, 'SLURM_ARRAY_TASK_ID': seed}, check=True,
                           stderr=subprocess.DEVNULL)
            with open(os.path.join(folder, f'row.{seed}'), encoding='utf-8') as f:
                by_array += f.read()
    rows = [[line.split(',')[:-1] for line in text.splitlines() if line[0].isdigit()] for text in (by_one, by_array)]
    assert {tuple(row[:2]) for row in rows[0]} == {('10', '1'), ('10', '2')} and [row[1:] for row in rows[0]] == rows[1]


main(globals())
