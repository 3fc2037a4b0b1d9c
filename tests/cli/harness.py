# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the built command and checks its results."""
import collections
import os
import re
import subprocess
import sys
import tempfile

COMMAND = os.path.abspath(sys.argv[1])
DATA = os.path.abspath(sys.argv[2])  # tests/data

Run = collections.namedtuple('Run', 'code out err')


TABLES = 'delaunay', 'voronoi', 'converge', 'disc', 'bisector', 'nearest', 'tolerance', 'plan'


def run(*args, stdin=b'', binary=False, comments=True, **options):
    """Runs the command in an empty folder (or options['cwd']). binary: returns the output as bytes.
    comments: a table begins with them."""
    if comments and args and args[0] in TABLES:
        args = (args[0], '--comments', *args[1:])
    if isinstance(stdin, str):
        stdin = stdin.encode()
    options.setdefault('timeout', 240)
    with tempfile.TemporaryDirectory() as folder:
        options.setdefault('cwd', folder)
        done = subprocess.run([COMMAND, *args], input=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              check=False, **options)
    return Run(done.returncode, done.stdout.decode('latin-1' if binary else 'utf-8'), done.stderr.decode())


def sealed(trace):
    """The trace with the digests of its lines as they are now; lines that have none stay as they are."""
    total, lines = 14695981039346656037, []
    for line in trace.splitlines(keepends=True):
        found = re.fullmatch(r'(.*)(, ?"sum": ?"[0-9a-f]{16}"\})(\n?)', line)
        for byte in (found[1] if found else '').encode():
            total = (total ^ byte) * 1099511628211 % 2**64
        lines.append(f'{found[1]},"sum":"{total:016x}"}}{found[3]}' if found else line)
    return ''.join(lines)


def cases(count):
    """How many random cases are run: so many, and a share of them with sanitizers, which make each many times as slow."""
    return count // 8 if os.environ.get('DYADEL_TEST_SANITIZED') else count


def share(values, turn=0):
    """All of them, which take much the same way through the program; with sanitizers, one in four, others at each turn."""
    return list(values)[turn % 4::4] if os.environ.get('DYADEL_TEST_SANITIZED') else values


def few(values):
    """All of them; with sanitizers, two."""
    return values[:2] if os.environ.get('DYADEL_TEST_SANITIZED') else values


def count(text):
    """Statuses counted in csv output; checks its form: header, i < j, sorted."""
    lines = [line for line in text.splitlines() if not line.startswith('#')]
    assert lines[0] == 'i,j,status', lines[:1]
    pairs = [tuple(line.split(',')) for line in lines[1:]]
    keys = [(int(i), int(j)) for i, j, _ in pairs]
    assert keys == sorted(set(keys)) and all(i < j for i, j in keys), 'pairs are not sorted'
    assert {s for _, _, s in pairs} <= {'legal', 'indeterminate', 'tie'}
    return dict(collections.Counter(s for _, _, s in pairs))


def expect(result, code, out='', err=''):
    """The exit status, and regular expressions that the two streams must contain."""
    assert result.code == code, f'exit {result.code}, not {code}: {result.err[:600]}'
    assert re.search(out, result.out, re.M), f'standard output lacks {out!r}: {result.out[:600]!r}'
    assert re.search(err, result.err, re.M), f'standard error lacks {err!r}: {result.err[:600]!r}'


def nearer_part(ring, site, other):
    """The part of a convex ring that is no farther from site than from other."""
    normal = (other[0] - site[0], other[1] - site[1])
    level = (other[0] ** 2 + other[1] ** 2 - site[0] ** 2 - site[1] ** 2) / 2
    side = [z[0] * normal[0] + z[1] * normal[1] - level for z in ring]
    out = []
    for k, z in enumerate(ring):
        m = (k + 1) % len(ring)
        if side[k] <= 0:
            out.append(z)
        if side[k] * side[m] < 0:
            t = side[k] / (side[k] - side[m])
            out.append(tuple(z[a] + t * (ring[m][a] - z[a]) for a in (0, 1)))
    return out


def main(tests):
    """Runs functions (named test_...) and ends the process."""
    failed = 0
    for name, test in sorted(tests.items()):
        if not name.startswith('test_'):
            continue
        try:
            test()
            print('ok', name)
        except (AssertionError, subprocess.TimeoutExpired) as problem:
            failed += 1
            print('FAILED', name, problem)
    sys.exit(1 if failed else 0)
