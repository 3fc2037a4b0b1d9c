#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Every n-th allocation, and every n-th call that opens, reads, writes, names or starts something, fails, for every
command. DYADEL_TEST_SCALE multiplies how many faults are tried.

Usage: test_faults.py COMMAND SHIM
"""
import errno
import os
import re
import subprocess
import sys
import tempfile

from sweep import Case, Sweep

COMMAND, SHIM = (os.path.abspath(path) for path in sys.argv[1:3])
MOST = 5 * int(os.environ.get('DYADEL_TEST_SCALE', '1'))

POINTS = b'sqrt(2) 0\n4 [0.5,0.75]\n0 4\n5+-0.01 5\nroot(x^3-2,1,2) 7\n1e300 1\n2 2\n2 2\n'
EXACT = b'0 0\n4 0.5\n0 4\n5 5.25\n7 1\n2 2.125\n'
NEAR = b'name,x,y,r\na,0,0,0.5\nb,4,0.5,0.25\n"c, d",0,4,1\ne,5,5,0.25\nf,2,2,1\n'
COLUMNS = ('--columns', 'x,y', '--radius-column', 'r', '--id', 'name')
ORACLE = 'echo points 4; while read _ i b; do echo "$i $((i*i)) $((i*i)) $((i*7%5)) $((i*7%5))"; done'


def made(*args, inputs, output):
    """The file that a command writes."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in inputs.items():
            with open(os.path.join(folder, name), 'wb') as out:
                out.write(text)
        done = subprocess.run([COMMAND, *args], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        assert done.returncode in (0, 3), done
        with open(os.path.join(folder, output), 'rb') as f:
            return f.read()


def cases():
    points, exact, near = {'p': POINTS}, {'p': EXACT}, {'p': NEAR}
    yield Case('delaunay', 'p', '-o', 'o', '--certificate', 'c', '--stats', inputs=exact, outputs=('o', 'c'), loose=True)
    yield Case('delaunay', 'p', '-o', 'o', inputs=points, outputs=('o',))
    yield Case('delaunay', *COLUMNS, 'p', '-o', 'o', inputs=near, outputs=('o',))
    yield Case('delaunay', *COLUMNS, '--discs', '--merge', '--skip-missing', 'p', '-o', 'o', inputs=near, outputs=('o',))
    yield Case('delaunay', *COLUMNS, '--merge-by', 'id', 'p', '-o', 'o', inputs={'p': NEAR + b'a,0.25,0,0.5\nf,3,2,1\n'}, outputs=('o',))
    for ending in ('json', 'geojson', 'wkt', 'obj', 'vtk', 'svg', 'pdf', 'png'):
        yield Case('delaunay', 'p', '-o', 'o.' + ending, inputs=exact, outputs=('o.' + ending,),
                   loose=ending in ('svg', 'pdf', 'png', 'json'))
    for ending in ('csv', 'json', 'svg', 'vtk'):
        yield Case('voronoi', *COLUMNS, 'p', '-o', 'o.' + ending, inputs=near, outputs=('o.' + ending,), loose=ending == 'svg')
    yield Case('voronoi', 'p', '-o', 'o', '--certificate', 'c', '--window', '-9,9,-9,9', inputs=points, outputs=('o', 'c'))
    yield Case('voronoi', *COLUMNS, '--discs', 'p', '-o', 'o.json', inputs=near, outputs=('o.json',))
    yield Case('voronoi', *COLUMNS, 'p', '-o', 'o', '--layer', 'tiles', inputs=near, outputs=('o',))
    yield Case('converge', 'p', '-o', 'o', '--no-times', '--trace', 't', '--plot', 'x.svg', inputs=points,
               outputs=('o', 't', 'x.svg'), loose=True)
    trace = made('converge', 'p', '-o', 'o', '--trace', 't', inputs=points, output='t')
    yield Case('converge', '--replay', 't', '--no-times', '-o', 'o', inputs={'t': trace}, outputs=('o',))
    yield Case('delaunay', 'p', '-o', 'o', '--resume', 't', '--trace', 'u', inputs={'t': trace, **points}, outputs=('o',), loose=True)
    yield Case('delaunay', 'p', '-o', 'o', '--layer', 'graph:mst', inputs=points, outputs=('o',))
    yield Case('voronoi', '--sphere', '--radius-unit', 'deg', *COLUMNS, 'p', '-o', 'o', inputs=near, outputs=('o',))
    yield Case('check', 'p', '--schedules', '2', '-o', 'o', inputs=points, outputs=('o',))
    certificate = made('delaunay', 'p', '-o', 'o', '--certificate', 'c', inputs=exact, output='c')
    yield Case('verify', 'c', '-o', 'o', inputs={'c': certificate}, outputs=('o',))
    yield Case('verify', 'c', '--points', 'p', '-o', 'o', inputs={'c': certificate, **exact}, outputs=('o',))
    yield Case('disc', 'p', '-o', 'o.json', inputs=points, outputs=('o.json',))
    yield Case('bisector', 'p', '-o', 'o', inputs=points, outputs=('o',))
    yield Case('nearest', 'p', '1/3', '2', '-o', 'o', inputs=points, outputs=('o',))
    yield Case('nearest', 'p', '--queries', 'q', '-o', 'o', inputs={'q': b'0 1\n3 sqrt(3)\n', **points}, outputs=('o',))
    yield Case('tolerance', 'p', '-o', 'o', '--up-to', '2', inputs=exact, outputs=('o',))
    yield Case('plan', *COLUMNS, 'p', '-o', 'o', inputs=near, outputs=('o',))
    yield Case('delaunay', '--oracle', ORACLE, '-o', 'o', '--oracle-timeout', '5', inputs={}, outputs=('o',))
    yield Case('delaunay', 'p', '-o', 'o', '--threads', '2', inputs=exact, outputs=('o',))


# GMP, MPFR and FLINT ask the command itself for memory.
OWN = ('libdyadel', '/dyadel', 'libjansson', 'libz')
# These follow null pointers when memory is exhausted, or do not end: they draw in a process of their own.
OTHERS = ('libcairo', 'fontconfig', 'freetype', 'libc.so')
CALLS = ('open', 'fopen', 'fdopen', 'mkstemp', 'fchmod', 'fsync', 'linkat', 'rename', 'fclose', 'fread', 'read', 'write',
         'pipe2', 'posix_spawn', 'fork', 'pthread_create')


def kinds():
    """Each kind of fault as arguments of Sweep."""
    for inside in OWN:
        for on in (False, True):
            yield {'call': 'alloc', 'inside': inside, 'on': on, 'error': errno.ENOMEM}
    for inside in OTHERS:
        yield {'call': 'alloc', 'inside': inside, 'error': errno.ENOMEM}
    for call in CALLS:
        for on in (False, True):
            yield {'call': call, 'on': on, 'error': errno.EAGAIN if call == 'pthread_create' else errno.EIO}


def main(chosen=''):
    wrong, tried = [], 0
    for case in cases():
        for kind in kinds():
            if not re.search(chosen, kind['inside'] if kind['call'] == 'alloc' else kind['call']): continue
            n, verdicts = Sweep(COMMAND, SHIM, case, **kind).check(MOST)
            tried += n
            wrong += verdicts
            for v in verdicts[:3]:
                print('FAILED', v, flush=True)
    print(tried, 'faults,', len(wrong), 'wrong')
    sys.exit(1 if wrong else 0)


main(*sys.argv[3:])
