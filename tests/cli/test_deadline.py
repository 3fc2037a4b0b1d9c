#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""--timeout bounds the whole command: reading, one huge root, an oracle that is silent, cells, certificates.

Usage: test_deadline.py COMMAND DATA
"""
import csv
import json
import os
import subprocess
import tempfile
import time
from fractions import Fraction

import gps
from harness import COMMAND, expect, main, run

ROOT = 'root(x^3-1e300000,0,1e300000) 0\n1 1\n2 3\n'
TRACKS = gps.points(1000)
SPARE = 1.5  # a second, and what starting and collecting a process takes here


def timed(seconds, *args, **options):
    begun = time.monotonic()
    result = run(*args, '--timeout', str(seconds), **options)
    took = time.monotonic() - begun
    assert took < seconds * 1.1 + SPARE, f'{took} seconds, not {seconds}: {result.err}'
    return result


def number(text):
    if '*2^' in text:
        m, e = text.split('*2^')
        return int(m) * Fraction(2) ** int(e)
    return Fraction(text)


def test_cells_that_are_cut():
    """Every cell has its row; the window stands for those that were not worked out, and true bounds for all."""
    result = timed(3, 'voronoi', '-', stdin=TRACKS)
    expect(result, 4, '^i,xlo,', r'^dyadel: budget: the time is used up: [1-9]\d* cells or regions .*; raise --timeout')
    comments = [line for line in result.out.splitlines() if line.startswith('#')]
    window = [float(number(t)) for line in comments if line.startswith('# window ') for t in line.split()[2:]]
    cells = [r for r in csv.DictReader(line for line in result.out.splitlines() if line[0] != '#')]
    unknown = [r for r in cells if float(r['area_lo']) == 0 and
               [float(r[k]) for k in ('xlo', 'xhi', 'ylo', 'yhi')] == window]
    assert len(cells) > 900 and unknown, (len(cells), len(unknown))
    assert '# distance_to_true_diagram,' in comments, comments
    area = (window[1] - window[0]) * (window[3] - window[2])
    left, = (float(c.split(',')[1]) for c in comments if c.startswith('# undetermined_area'))
    assert area - sum(float(r['area_lo']) for r in cells) <= left * 1.000001 and left <= area * 1.000001
    assert all(float(r['area_hi']) >= area * 0.999999 for r in unknown)
    result = timed(3, 'voronoi', '--quiet', '--format', 'json', '-', stdin=TRACKS)
    expect(result, 4, '', r'\A\Z')
    assert any(c['int'] is None and c['inner'] == [] for c in json.loads(result.out)['cells'])


def test_certificate_that_is_cut():
    with tempfile.TemporaryDirectory() as folder:
        result = timed(3, 'voronoi', '-', '-o', 'out', '--certificate', 'proof', stdin=TRACKS, cwd=folder)
        expect(result, 4, r'\A\Z', '^dyadel: budget: the time is used up')
        assert os.listdir(folder) == ['out'], os.listdir(folder)


def test_one_huge_root():
    for command in ('delaunay', 'voronoi', 'converge'):
        with tempfile.TemporaryDirectory() as folder:
            result = timed(1, command, '-', '-o', 'out', stdin=ROOT, cwd=folder)
            expect(result, 4, r'\A\Z', '^dyadel: budget: the time is used up, .*; raise --timeout')
            assert not os.listdir(folder), os.listdir(folder)


def test_silent_oracle():
    expect(timed(1, 'voronoi', '--oracle', 'exec sleep 15'), 4, r'\A\Z', '^dyadel: budget: .* reading does not end')


def test_input_that_does_not_end():
    begun = time.monotonic()
    with subprocess.Popen([COMMAND, 'delaunay', '-', '--timeout', '1'], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE) as process:
        process.stdin.write(b'0 0\n1 1\n')
        process.stdin.flush()
        assert process.wait(timeout=60) == 4 and time.monotonic() - begun < 1 + SPARE
        assert b'reading does not end' in process.stderr.read() and process.stdout.read() == b''


def test_time_enough():
    for command in ('delaunay', 'voronoi', 'converge'):
        free, bounded = (run(command, '-', *how, stdin='0 0\n3 1\n1 4\n[2,3] 9\n') for how in
                         (('--quiet',), ('--quiet', '--timeout', '50')))
        assert free.code == bounded.code
        if command != 'converge':
            assert free.out == bounded.out


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


main(globals())
