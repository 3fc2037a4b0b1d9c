#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Memory that ends: a limit of the process (ulimit -v) from 32 MB up, for each command and format; --max-bytes; fonts that are
never found. Whatever the limit: the command ends by itself, with the status that it has without a limit, with 1 and a message, or
with 4 where --max-bytes is met; a result is whole, or the one before.

Usage: test_memory.py COMMAND SHIM
"""
import concurrent.futures
import json
import os
import random
import re
import resource
import subprocess
import sys
import tempfile

COMMAND = os.path.abspath(sys.argv[1])
SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))
OLD = b'what was there before\n'
MB = 1 << 20
# The loader and the libraries alone take so much: below, the loader says so itself, with status 127.
LIMITS = [32 * MB, 48 * MB, 64 * MB, 96 * MB] + [k * MB for k in range(100, 400, 8 if SCALE > 1 else 40)]

rand = random.Random(1)
POINTS = ''.join(f'{rand.uniform(0, 100):.6f} {rand.uniform(0, 100):.6f}\n' for _ in range(3000))
BOXES = ''.join(f'{rand.uniform(0, 100):.5f}+-0.4 {rand.uniform(0, 100):.5f}+-0.4\n' for _ in range(300))
GLOBE = 'lon,lat\n' + ''.join(f'{rand.uniform(-180, 180):.5f},{rand.uniform(-90, 90):.5f}\n' for _ in range(500))
REAL = 'sqrt(2) 0\n4 exp(1)\n0 pi\nroot(x^5-x-1,1,2) 7\n3 sqrt(3)\n' + ''.join(f'sqrt({k}) cbrt({k * k + 1})\n' for k in range(20, 90))
FILES = {'points': POINTS, 'boxes': BOXES, 'globe': GLOBE, 'real': REAL, 'places': POINTS[:4000].rsplit('\n', 1)[0] + '\n'}
SPHERE = ('--sphere', '--columns', 'lon,lat', 'globe')
CASES = [('delaunay', 'points', '-o', f'o.{f}') for f in ('csv', 'json', 'geojson', 'wkt', 'obj', 'vtk', 'svg', 'tikz', 'pdf', 'png', 'html', 'csv.gz', 'csv.zst')]
CASES += [('voronoi', 'boxes', '-o', f'o.{f}') for f in ('csv', 'json', 'svg', 'png', 'html')]
CASES += [('delaunay', 'real', '-o', 'o.csv'), ('delaunay', 'boxes', '--discs', '-o', 'o.csv'), ('voronoi', 'points', '--layer', 'tiles', '-o', 'o.csv'),
          ('delaunay', *SPHERE, '-o', 'o.csv'), ('voronoi', *SPHERE, '-o', 'o.svg'), ('converge', 'real', '--no-times', '-o', 'o.csv'),
          ('delaunay', 'boxes', '--layer', 'graph:mst', '-o', 'o.csv'), ('check', 'real', '--schedules', '1', '-o', 'o.json'),
          ('disc', 'real', '-o', 'o.json'), ('bisector', 'real', '-o', 'o.svg'), ('nearest', 'points', '1', '2', '-o', 'o.csv'),
          ('nearest', 'boxes', '--queries', 'places', '-o', 'o.csv'), ('tolerance', 'points', '-o', 'o.csv'), ('plan', 'boxes', '-o', 'o.csv'),
          ('verify', 'certificate', '-o', 'o.txt')]
DRAWN = ('svg', 'pdf', 'png')


def run(folder, *args, limit=None, env=None, timeout=300):
    done = subprocess.run([COMMAND, *args], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=timeout,
                          preexec_fn=limit and (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))), env={**os.environ, **(env or {})},
                          check=False)
    return done.returncode, done.stderr.decode(errors='replace')


def prepare(folder):
    for name, text in FILES.items():
        with open(os.path.join(folder, name), 'w') as out:
            out.write(text)
    assert run(folder, 'delaunay', 'boxes', '-q', '-o', os.devnull, '--certificate', 'certificate')[0] == 3


def outcome(case, *more, limit=None, env=None):
    """Status, messages, and what the output holds afterwards; other files left over are an error."""
    name = case[case.index('-o') + 1]
    with tempfile.TemporaryDirectory() as folder:
        for path in os.listdir(HOME):
            os.symlink(os.path.join(HOME, path), os.path.join(folder, path))
        before = set(os.listdir(folder)) | {name}
        with open(os.path.join(folder, name), 'wb') as out:
            out.write(OLD)
        status, err = run(folder, *case, *more, limit=limit, env=env)
        assert set(os.listdir(folder)) == before, (case, limit, 'leaves', set(os.listdir(folder)) - before)
        with open(os.path.join(folder, name), 'rb') as f:
            return status, err, f.read()


def is_whole(name, text):
    """Of formats that hold times, or texts as wide as the fonts found."""
    if name.endswith('json'):
        return json.loads(text)
    ends = {'svg': b'</svg>', 'tikz': b'tikzpicture}', 'html': b'</html>', 'pdf': b'%%EOF', 'png': b'IEND\xaeB`\x82'}
    return text.rstrip().endswith(ends.get(name.rsplit('.', 1)[1], b'\0'))


def judge(case, *more, limit=None, fails=(1,)):
    """How a run with less memory ends: True if with a result."""
    what = (*case, *more, limit)
    status, _, result = REFERENCE[case]
    code, err, now = outcome(case, *more, limit=limit)
    assert code in (status, *fails, *([127] if limit else [])), (what, code, err[-400:])
    assert now in (OLD, result) or is_whole(case[case.index('-o') + 1], now) or (now and 'this much was known before' in err), (
        what, code, err[-400:], len(now))
    if now == OLD:
        assert code in (*fails, 127) and re.search('^dyadel: .|error while loading shared libraries|cannot allocate memory', err, re.M), (what, code, err[-400:])
    return now != OLD


def test_limits():
    """A process that may not grow."""
    enough = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for case, good in zip([c for c in CASES for _ in LIMITS], pool.map(lambda t: judge(t[0], limit=t[1]), [(c, k) for c in CASES for k in LIMITS])):
            enough += good
    total = len(CASES) * len(LIMITS)
    assert total // 4 < enough < total, enough
    print(total, 'runs under a limit,', enough, 'with a result')


def test_max_bytes():
    """--max-bytes refuses in time: status 4 and the option's name; the more there is, the more is written."""
    tried = 0
    for case in CASES:
        if case[0] in ('check', 'disc', 'bisector', 'verify'): continue
        results = []
        for size in ('1K', '64K', '300K', '1M', '4M', '64M', '4G'):
            results.append(judge(case, '--max-bytes', size, fails=(4,)))
            tried += 1
            if not results[-1]:
                assert '--max-bytes' in outcome(case, '--max-bytes', size)[1], (case, size)
        assert results == sorted(results) and not results[0] and results[-1], (case, results)
    for wrong in ('0', '1.5', '-1', '3X', 'M', '2GB', '99999999T', '1e9', '9' * 80):
        assert run(HOME, 'delaunay', 'points', '--max-bytes', wrong) == (2, f'dyadel: --max-bytes "{wrong}" is not understood; give a number of bytes, '
                                                                         'such as 500M or 2G\n'), wrong
    print(tried, 'runs with --max-bytes')


def most_held(*args):
    """Status, messages, and the most bytes that the process held."""
    with tempfile.TemporaryFile() as err:
        pid = os.fork()
        if not pid:
            os.dup2(err.fileno(), 2)
            os.execv(COMMAND, [COMMAND, *args])
        _, status, used = os.wait4(pid, 0)
        err.seek(0)
        return os.waitstatus_to_exitcode(status), err.read().decode(), 1024 * used.ru_maxrss


def test_reading_is_bounded():
    """--max-bytes ends reading, of points and of places, before more is held."""
    with tempfile.TemporaryDirectory() as folder:
        many, few = os.path.join(folder, 'many'), os.path.join(folder, 'few')
        with open(many, 'w') as out:
            for _ in range(600000): out.write(f'{rand.uniform(0, 100):.6f} {rand.uniform(0, 100):.6f}\n')
        with open(few, 'w') as out:
            out.write('0 0\n3 1\n1 4\n')
        for case in (('delaunay', many), ('nearest', few, '--queries', many)):
            status, err, held = most_held(*case, '--max-bytes', '8M', '-o', os.devnull)
            code, _, least = most_held('delaunay', few, '-q', '-o', os.devnull)
            assert code == 0 and status == 4 and 'reading the points' in err and '--max-bytes' in err, (case, code, status, err)
            assert held < least + 16 * MB, (case, held, least)


def test_fonts_never_come():
    """A picture that is never done: the deadline holds, and outputs other than pictures are written."""
    with tempfile.TemporaryDirectory() as folder:
        fonts = os.path.join(folder, 'fonts.conf')
        os.mkfifo(fonts)
        for ending in DRAWN:
            status, err, now = outcome(('delaunay', 'points', '-o', 'o.' + ending), '--timeout', '1', env={'FONTCONFIG_FILE': fonts})
            assert (status, now) == (4, OLD) and '--timeout' in err, (ending, status, err)
        with open(os.path.join(folder, 'p'), 'w') as out:
            out.write('0 0\n3 1\n1 4\n')
        status, err = run(folder, 'converge', 'p', '--no-times', '-o', 'table.csv', '--plot', 'plot.pdf', env={'FONTCONFIG_FILE': fonts})
        assert status == 1 and 'no picture was written, since it takes too long' in err, (status, err)
        assert 'table.csv' in os.listdir(folder) and 'plot.pdf' not in os.listdir(folder)


with tempfile.TemporaryDirectory() as HOME:
    prepare(HOME)
    REFERENCE = {case: outcome(case) for case in CASES}
    assert all(r[0] in (0, 3) and r[2] != OLD for r in REFERENCE.values()), [(c, r[:2]) for c, r in REFERENCE.items() if r[0] not in (0, 3)]
    for name, test in list(globals().items()):
        if name.startswith('test_') and re.search(sys.argv[3] if len(sys.argv) > 3 else '', name):
            test()
            print('ok', name, flush=True)
