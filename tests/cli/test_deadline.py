#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""--timeout bounds the whole command: reading, one huge root, an oracle that is silent, cells, certificates.

Usage: test_deadline.py COMMAND DATA
"""
import csv
import json
import math
import os
import re
import signal
import subprocess
import tempfile
import time
from fractions import Fraction

import gps
from harness import COMMAND, count, expect, main, run

ROOT = '+'.join(f'root(x^3-1e{300000 - k},0,1e{300000 - k})' for k in range(60)) + ' 0\n1 1\n2 3\n'
TRACKS = gps.points(1000)
SPARE = 6 if os.environ.get('DYADEL_TEST_SANITIZED') else 1.5  # a second, and what starting and collecting a process takes


def in_time(seconds, what):
    """Returns the result of what(), which must end within that many seconds; tries again in case the machine was
    busy."""
    for _ in range(3):
        begun = time.monotonic()
        result = what()
        took = time.monotonic() - begun
        if took < seconds:
            return result
    raise AssertionError(f'{took} seconds, not {seconds}: {result}')


def timed(seconds, *args, **options):
    return in_time(seconds * 1.1 + SPARE, lambda: run(*args, '--timeout', str(seconds), **options))


def cut_between(attempt, place, first):
    """What attempt(seconds) gives where place(result) is 0: cut neither too early (-1) nor too late (1); the last one if
    there is none. Seconds are doubled and halved until both sides are known, then bisected; sides that others at work on
    this machine have brought together move apart again."""
    early, late, seconds = 0, math.inf, first
    for _ in range(12):
        result = attempt(seconds)
        where = place(result)
        if where == 0 or seconds > 32:
            break
        early, late = (seconds, late) if where < 0 else (early, seconds)
        if late < 1.1 * early:
            early, late = early / 2, late * 2
        seconds = 2 * early if late == math.inf else late / 2 if early == 0 else math.sqrt(early * late)
    return result


def rows_of(result):
    return list(csv.DictReader(line for line in result.out.splitlines() if line[0] != '#'))


def number(text):
    if '*2^' in text:
        m, e = text.split('*2^')
        return int(m) * Fraction(2) ** int(e)
    return Fraction(text)


def test_cells_that_are_cut():
    """Every cell has its row; the window replaces cells that were not computed, and all bounds are true."""
    def place(result):
        return 1 if result.code != 4 else 0 if 'cells or regions' in result.err else -1

    result = cut_between(lambda seconds: timed(seconds, 'voronoi', '-', stdin=TRACKS), place, 2)
    expect(result, 4, '^i,xlo,', r'^dyadel: budget: time limit reached: [1-9]\d* cells or regions .*\(raise --timeout\)')
    comments = [line for line in result.out.splitlines() if line.startswith('#')]
    window = [float(number(t)) for line in comments if line.startswith('# window ') for t in line.split()[2:]]
    cells = rows_of(result)
    unknown = [r for r in cells if float(r['area_lo']) == 0 and
               [float(r[k]) for k in ('xlo', 'xhi', 'ylo', 'yhi')] == window]
    assert len(cells) > 900 and unknown, (len(cells), len(unknown))
    assert '# distance_to_true_diagram,' in comments, comments
    area = (window[1] - window[0]) * (window[3] - window[2])
    left, = (float(c.split(',')[1]) for c in comments if c.startswith('# undetermined_area'))
    assert area - sum(float(r['area_lo']) for r in cells) <= left * 1.000001 and left <= area * 1.000001
    assert all(float(r['area_hi']) >= area * 0.999999 for r in unknown)

    def unknown_cells(result):
        return [c for c in json.loads(result.out or '{"cells":[]}')['cells'] if c['int'] is None and c['inner'] == []]

    result = cut_between(lambda seconds: timed(seconds, 'voronoi', '--quiet', '--format', 'json', '-', stdin=TRACKS),
                         lambda result: 1 if result.code != 4 else 0 if unknown_cells(result) else -1, 2)
    assert unknown_cells(result), result
    expect(result, 4, '', r'\A\Z')


def test_certificate_that_is_cut():
    """The diagram is there, and its certificate is not."""
    def attempt(seconds):
        with tempfile.TemporaryDirectory() as folder:
            result = timed(seconds, 'voronoi', '-', '-o', 'out', '--certificate', 'proof', stdin=TRACKS, cwd=folder)
            return result, os.listdir(folder)

    result, files = cut_between(attempt, lambda got: 1 if 'proof' in got[1] else 0 if got[1] else -1, 2)
    expect(result, 4, r'\A\Z', '^dyadel: budget: time limit reached')
    assert files == ['out'], files


def test_hull_that_is_cut():
    """Rectangles in a row: each is asked whether it can be on the hull, which takes longest. What is known is written."""
    row = ''.join(f'{i} 0\n' for i in range(4000))
    result = cut_between(lambda seconds: timed(seconds, 'delaunay', '--radius', '0.01', '-', stdin=row),
                         lambda result: 1 if result.code != 4 else 0 if rows_of(result) else -1, 3)
    expect(result, 4, '^0,1,legal$', '^dyadel: budget: 3999 legal, .*time limit reached')


def test_huge_roots():
    for command in ('delaunay', 'voronoi', 'converge'):
        with tempfile.TemporaryDirectory() as folder:
            result = timed(1, command, '-', '-o', 'out', stdin=ROOT, cwd=folder)
            expect(result, 4, r'\A\Z', '^dyadel: budget(: time limit reached during reading| before the first (triangulation|stage) was complete: there is no)')
            assert not os.listdir(folder), os.listdir(folder)


def test_silent_oracle():
    expect(timed(1, 'voronoi', '--oracle', 'exec sleep 15'), 4, r'\A\Z', '^dyadel: budget: .* during reading')


def test_oracle_that_is_slow_to_end():
    """The programs get a second to end; the message about slow writing must not appear in that time."""
    result = timed(1, 'delaunay', '--oracle', 'echo points 3; exec sleep 100')
    expect(result, 4, r'\A\Z', r'\Adyadel: budget before the first [^\n]*\n\Z')


def test_input_that_does_not_end():
    for command, text, phase in (('delaunay', b'0 0\n1 1\n', b'reading'), ('tolerance', b'0 0\n', b'reading'),
                                 ('verify', b'dyadel certificate 1\n', b'checking the certificate')):
        def fed(command=command, text=text):
            with subprocess.Popen([COMMAND, command, '-', '--timeout', '1'], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE) as process:
                process.stdin.write(text)
                process.stdin.flush()
                return process.wait(timeout=60), process.stdout.read(), process.stderr.read()
        code, out, err = in_time(1 + SPARE, fed)
        assert code == 4 and b'during ' + phase in err and out == b'', (code, out, err)


def test_long_numbers():
    """Ten rationals of a million bits, and an argument beyond any table of pi."""
    number = '7' * 300000
    rationals = ''.join(f'{number}/3{number[k:]} {k}\n' for k in range(10))
    for text in (rationals, 'exp(exp(exp(2))) 0\nsin(10^300000) 1\n2 3\n'):
        for command in ('delaunay', 'bisector'):
            assert timed(1, command, '-', stdin=text).code in (0, 3, 4)


def test_time_enough():
    for command in ('delaunay', 'voronoi', 'converge'):
        free, bounded = (run(command, '-', *how, stdin='0 0\n3 1\n1 4\n[2,3] 9\n') for how in
                         (('--quiet',), ('--quiet', '--timeout', '50')))
        assert free.code == bounded.code
        if command != 'converge':
            assert free.out == bounded.out


CROWD = ''.join(f'{x}+-5e-3 {y}+-5e-3\n' for x, y in (
    (round(k * 0.6180339887 % 1, 6), round(k * k * 0.4142135623 % 1, 6)) for k in range(6000)))


def test_first_closure_that_is_cut():
    """Results known before all undecided faces are closed are written; the remaining faces are named, as with a cap."""
    whole = run('delaunay', '-', stdin=CROWD)
    status = {(row['i'], row['j']): row['status'] for row in rows_of(whole)}

    def place(result):
        return 0 if result.out.startswith('# capped:') else 1 if result.out else -1

    result = cut_between(lambda seconds: timed(seconds, 'delaunay', '-', stdin=CROWD), place, 0.5)
    expect(result, 4, '^# capped: .*\n(# face [0-9 ]+\n)+', r'^dyadel: budget: .* time limit reached \(raise --timeout\)')
    faces = [set(line.split()[2:]) for line in result.out.splitlines() if line.startswith('# face')]
    listed = {(row['i'], row['j']): row['status'] for row in rows_of(result)}
    assert listed and listed != status
    for pair, known in listed.items():
        assert known == 'indeterminate' or status[pair] == known, (pair, known)
    for pair, truth in status.items():
        assert listed.get(pair) or any(face.issuperset(pair) for face in faces), (pair, truth)
        assert truth != 'legal' or listed.get(pair), pair


def test_bounds_that_are_cut():
    """A table whose last bounds took too long is written without these."""
    def place(result):
        row = next(iter(rows_of(result)), None)
        return -1 if not row or not row['area'] else 1 if row['v_area'] else 0

    result = cut_between(lambda seconds: timed(seconds, 'converge', '-', '--of', 'voronoi', stdin=TRACKS), place, 1)
    expect(result, 4, '^stage,', r'^dyadel: budget: time limit reached: no bounds of stage 1 \(raise --timeout\)')
    row = rows_of(result)[0]
    assert row['legal'] and row['area'] and not row['v_area'] and not row['v_hausdorff'], row
    expect(run('converge', '-', '--of', 'voronoi', stdin=TRACKS), 3, '^stage,')


# A circle of 57 corners of polygons, of an order too large to compute; a power of nine roots, once multiplied out.
ROOTS = '+'.join(f'sqrt({p})' for p in (2, 3, 5, 7, 11, 13, 17, 19, 23))
PROOFS = (''.join(f'cos(2*pi/{k}) sin(2*pi/{k})\n' for k in range(3, 60)),
          f'({ROOTS})^200 0\n({ROOTS})^199*({ROOTS}) 0\n1 1\n0 5\n')


def test_proofs_that_are_cut():
    """Results known before a proof that takes too long are written."""
    for text in PROOFS:
        result = cut_between(lambda seconds, text=text: timed(seconds, 'delaunay', '-', stdin=text),
                             lambda result: 0 if result.out else -1, 1)
        assert result.code in (0, 3, 4) and count(result.out) and 'time limit reached during' not in result.err, result


def test_one_message():
    """Of points beyond doubles, and of polygons, one line tells, and names the points."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'far.txt')
        with open(path, 'w', encoding='ascii') as out:
            out.write('1e320 0\n1 1\n2 3\n')
        result = run('voronoi', path)
        expect(result, 1, r'\A\Z', r'\Adyadel: the points span more than doubles hold; give --window [^\n]*\n\Z')
        with open(path, 'w', encoding='ascii') as out:
            out.write('[0,1] 0\n5 1\n2 7\n')
        result = run('voronoi', '--quiet', '--flatten', '60', path)
        expect(result, 1, r'\A\Z', r'\Adyadel: [^\n]*far.txt: polygons within [^\n]*--flatten\n\Z')


SCATTER = [(k * k % 997, f'{k * k * k % 991}.{k}', 1 + k * 7 % 23) for k in range(400)]
WEIGHED = 'x,y,r\n' + ''.join(f'{x},{y},{r}\n' for x, y, r in SCATTER)
MANY = 'x,y,r\n' + ''.join(f'{k * k % 99991},{k * k * k % 99971}.{k},{1 + k * 7 % 23}\n' for k in range(5000))


def place_of_cut(result):
    return 1 if result.code != 4 else 0 if rows_of(result) and '\n# cut: ' in '\n' + result.out else -1


def test_tolerances_that_are_cut():
    """Rows that were reached are those of the whole, and the comment counts the others."""
    for how in (('--radius-column', 'r'), ('--radius-column', 'r', '--up-to', '1'), ('--metric', 'box'),
                ('--metric', 'box', '--up-to', '1'), ('--up-to', '1000')):
        given = ('tolerance', '--columns', 'x,y', *how, '-')
        points = WEIGHED if '--up-to' in how else MANY
        cut = cut_between(lambda seconds, given=given, points=points: timed(seconds, *given, stdin=points), place_of_cut, 0.05)
        expect(cut, 4, '^# tolerance .*\n# cut: ', r'^dyadel: budget: .*(no row|not all looked for) \(raise --timeout\)$')
        if how == ('--up-to', '1000'):  # all pairs are born
            continue
        whole = run(*given, stdin=points)
        rows, reached = rows_of(whole), rows_of(cut)
        assert reached and {str(row) for row in reached} <= {str(row) for row in rows}, how
        edges, births = re.search('^# cut: ([0-9]+) edges have no row; (.*)$', cut.out, re.M).groups()
        assert int(edges) == sum(row['event'] == 'death' for row in rows) - sum(row['event'] == 'death' for row in reached)
        assert int(edges) or births[0] != '0', cut.out
        lo, hi = (float(x) for x in re.search('^# tolerance (.*) (.*)$', cut.out, re.M).groups())
        assert (lo == 0 or not int(edges)) and hi >= float(re.search('^# tolerance (.*) ', whole.out, re.M).group(1)), how
    for how in (('--radius-column', 'r', '--up-to', '20'), ('--metric', 'box', '--up-to', '300')):  # deaths come first
        given = ('tolerance', '--columns', 'x,y', *how, '-')

        def before_births(result):
            return 1 if result.code != 4 else 0 if '\n# cut: 0 edges have no row' in result.out else -1

        cut = cut_between(lambda seconds, given=given: timed(seconds, *given, stdin=MANY), before_births, 0.3)
        expect(cut, 4, 'birth' if 'not all looked for' not in cut.out else '^# cut: 0 edges', r'^dyadel: budget: 0 edges')
        assert len(rows_of(cut)) >= len(rows_of(run(*given[:-3], '-', stdin=MANY)))
    given = ('tolerance', '--columns', 'x,y', '--radius-column', 'r', '--format', 'json', '-')
    cut = cut_between(lambda seconds: timed(seconds, *given, stdin=MANY),
                      lambda result: 1 if result.code != 4 else 0 if '"death"' in result.out else -1, 0.05)
    found = json.loads(cut.out)
    assert found['without_row']['edges'] > 0 and found['pairs'] and not found['rho'], cut.out[:300]


def test_counts_that_are_cut():
    """How many edges are certain at an accuracy, and radii, are known from all edges: nothing is written of them."""
    for layer in ('barcode', 'points'):
        result = timed(0.02, 'tolerance', '--layer', layer, '--columns', 'x,y', '--radius-column', 'r', '-', stdin=MANY)
        expect(result, 4, r'\A\Z', r'^dyadel: budget: (.*\n)*.*there is no result to write \(raise --timeout\)$')


def test_plans_that_are_cut():
    """The first points of a plan: pairs it calls undecided stay undecided when these are measured, and it claims no
    sufficiency."""
    points = [(Fraction(x), Fraction(y)) for x, y, _ in SCATTER]
    half = 12
    text = ''.join(f'{x}+-{half} {y}+-{half}\n' for x, y in map(lambda p: (p[0], float(p[1])), points))
    cut = cut_between(lambda seconds: timed(seconds, 'plan', '-', stdin=text), place_of_cut, 0.5)
    expect(cut, 4, '^# cut: the plan is not finished', r'^dyadel: budget: the plan is not finished: .* \(raise --timeout\)$')
    assert 'sufficient' not in cut.out and 'verified' not in cut.out
    rows = rows_of(cut)
    left, after = re.search('not finished: ([0-9]+) of [0-9]+ pairs are undecided after its first ([0-9]+) points', cut.out).groups()
    assert int(after) == len(rows) and rows[-1]['pairs_left'] == left
    size = {int(row['i']): row['half_width_needed'] for row in rows}
    text = ''.join(f'{x}+-{size.get(k, half)} {float(y)}+-{size.get(k, half)}\n' for k, (x, y) in enumerate(points))
    now = rows_of(run('delaunay', '-', stdin=text))
    assert sum(row['status'] == 'indeterminate' for row in now) == int(left), left


def test_discs_and_graphs_that_are_cut():
    """Pairs of discs that were not reached have the statuses of squares; a graph that is not known is not written."""
    given = ('--columns', 'x,y', '--radius-column', 'r', '-')
    text = 'x,y,r\n' + ''.join(f'{k * k % 997},{k * k * k % 991}.{k},{1 + k * 7 % 23}\n' for k in range(1500))
    whole, squares = run('delaunay', '--discs', *given, stdin=text), run('delaunay', *given, stdin=text)
    status = {(row['i'], row['j']): row['status'] for row in rows_of(whole)}
    outer = {(row['i'], row['j']): row['status'] for row in rows_of(squares)}

    def place(result):
        return 1 if result.code != 4 else 0 if rows_of(result) and 'not reached' in result.err else -1

    result = cut_between(lambda seconds: timed(seconds, 'delaunay', '--discs', *given, stdin=text), place, 0.3)
    expect(result, 4, '', r'pairs were not reached: they have the statuses of squares \(raise --timeout\)')
    assert '--max-pairs' not in result.err, result.err
    listed = {(row['i'], row['j']): row['status'] for row in rows_of(result)}
    for pair, known in listed.items():
        assert known == status.get(pair, 'illegal') or known == outer[pair] == 'indeterminate', (pair, known)
    for seconds in (0.02, 0.1):
        result = timed(seconds, 'delaunay', '--layer', 'graph:mst', *given, stdin=text)
        assert result.code in (3, 4) and '--max-pairs' not in result.err, result.err
        assert result.code == 3 or not result.out, result.out
    expect(run('delaunay', '--layer', 'graph:mst', '--max-pairs', '100', *given, stdin=text), 4, r'\A\Z', 'raise --max-pairs')
    result = run('delaunay', '--discs', '--max-pairs', '100', *given, stdin=text)
    expect(result, 4, '^# capped: ', 'raise --max-pairs')
    assert all(row['status'] != 'legal' or status[row['i'], row['j']] == 'legal' for row in rows_of(result))


def test_discs_without_a_result():
    """Where the time is used up before a first triangulation, the exit status says so."""
    expect(run('delaunay', '--discs', '--radius', '0.1', '--timeout', '0.000001', '-', stdin='1 2\n3 4\n5 7\n'), 4, r'\A\Z', 'no result')


def catches_interrupts(process):
    with open(f'/proc/{process.pid}/status', encoding='ascii') as status:
        caught = next(int(line.split()[1], 16) for line in status if line.startswith('SigCgt'))
    return caught >> (signal.SIGINT - 1) & 1


def interrupted_after(seconds, command, *args, text):
    """Code and output of a run that gets SIGINT the given time after it listens."""
    with subprocess.Popen([COMMAND, command, '-', *args], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True) as process:
        process.stdin.write(text)
        process.stdin.close()
        process.stdin = None
        while process.poll() is None and not catches_interrupts(process):
            time.sleep(0.01)
        time.sleep(seconds)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err


def test_tolerances_and_plans_interrupted():
    """As at a deadline, with exit status 5: known results are written, and called cut."""
    points = ''.join(f'{k * k % 9973} {k * k * k % 9967}.{k}\n' for k in range(5000))
    many = ''.join(f'{k * k % 499979} {k * k * k % 499969}.{k}\n' for k in range(100000))
    for command, extra in (('tolerance', ('--metric', 'box')), ('plan', ())):
        text = many if command == 'tolerance' else re.sub('( |\n)', '+-60\\1', points)
        code, out, err = in_time(1 + SPARE, lambda: interrupted_after(1, command, '--comments', *extra, text=text))
        assert code == 5 and 'cancelled' in err, (command, code, err)
        assert not out or '# cut: ' in out, out[:300]


main(globals())
