#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""--trace and --resume: wherever a run is cut, the resumed one gives the result of an undisturbed run, and asks no answer
twice."""
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

from harness import COMMAND, expect, main, run, sealed

# Serves 12 points on a circle, by integer square roots, and logs its requests. It dies before answer number
# DIE, counted over all its requests.
ORACLE = '''
import math, os, sys, time
print('points 12', flush=True)
for line in sys.stdin:
    _, i, bits = line.split()
    i, bits = int(i), int(bits)
    with open(sys.argv[1], 'a') as log:
        log.write(line)
    with open(sys.argv[1]) as log:
        if len(log.readlines()) > int(os.environ.get('DIE', 10 ** 9)):
            sys.exit(1)
    time.sleep(float(os.environ.get('SLOW', 0)))
    scale = max(bits, 0) + 2
    x = math.isqrt((i + 2) << 2 * scale)
    y = math.isqrt((25 - i) << 2 * scale)
    print(i, f'{x}*2^{-scale} {x + 1}*2^{-scale} {y}*2^{-scale} {y + 1}*2^{-scale}', flush=True)
'''
POINTS = ''.join(f'sqrt({2 + i})*cos({i}) sqrt({3 + i * i})/3\n' for i in range(9)) + '[7,7.000000001] 7\n2 -3\n'


class Folder:
    """A folder with an oracle and its log, and a points file."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        for name, text in (('oracle.py', ORACLE), ('points.txt', POINTS), ('log', '')):
            self.write(name, text)
        return self

    def __exit__(self, *args):
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), 'w', encoding='utf-8') as f:
            f.write(text)

    def read(self, name):
        with open(self.path(name), encoding='utf-8') as f:
            return f.read()

    def asked(self):
        """What the oracle was asked since the last call."""
        lines = self.read('log').splitlines()
        self.write('log', '')
        return lines

    def run(self, command, *args, **environment):
        return run(command, *args, cwd=self.folder.name, env={**os.environ, **environment})

    def oracle(self, *args, **environment):
        return self.run('delaunay', '--oracle', f'exec {sys.executable} oracle.py log', '--max-bits', '300', *args, **environment)


def answers(trace):
    return [line for line in trace.splitlines() if '"called":true' in line]


def story(trace):
    """Without what a resumed run keeps of the earlier one, and without digests, which depend on that."""
    return [re.sub(r',"sum":"[0-9a-f]{16}"\}$', '}', line) for line in trace.splitlines() if '{"kept":' not in line]


def test_whole_from_the_start():
    """A trace that continues another one has all answers of that one from the start, however soon it is cut."""
    with Folder() as f:
        f.oracle('--trace', 'whole')
        asked = f.asked()
        known = len(asked) * 2 // 3
        f.oracle('--trace', 'cut', DIE=str(known))
        f.asked()
        for options in (('--max-bits', '4'), ('--until', 'area:1'), ('--timeout', '0.001')):
            f.oracle('--resume', 'cut', '--trace', 'again', *options)
            again = f.read('again')
            assert again.count('{"kept":true,') == known, options
            assert sealed(again) == again
            third = f.oracle('--resume', 'again', '--trace', 'third')
            assert f.asked() == asked[known:], options
            assert third.out == f.oracle().out
            f.asked()
            expect(f.run('converge', '--replay', 'third'), third.code)


def test_digests():
    """A line changed, moved or removed is noticed, though it is well formed."""
    with Folder() as f:
        f.oracle('--trace', 'whole')
        whole = f.read('whole')
        lines = whole.splitlines(keepends=True)
        assert sealed(whole) == whole
        first = next(k for k, line in enumerate(lines) if '"called":true' in line)
        swapped = lines[:first] + [lines[first + 1], lines[first]] + lines[first + 2:]
        wider = re.sub(r'"x":\["(\d+)\*', lambda found: f'"x":["{int(found[1]) - 1}*', lines[first], count=1)
        assert wider != lines[first]
        for forged, line in ((swapped, first), (lines[:first] + lines[first + 1:], first),
                             (lines[:first] + [wider] + lines[first + 1:], first),
                             (lines[:first] + [lines[first].replace(',"sum":"', ',"sum":"0')] + lines[first + 1:], first)):
            f.write('bad', ''.join(forged))
            for run_again in (f.oracle('--resume', 'bad'), f.run('converge', '--replay', 'bad')):
                expect(run_again, 1, err=f'^dyadel: bad:{line + 1}:1: this line, or the order of lines, was changed')


def test_forged():
    """A forger of a trace can write its digests: --resume believes it, and verify --points detects it."""
    with Folder() as f:
        f.write('exact.txt', 'sqrt(2) 0\n0 sqrt(3)\n-1 0\n1/3 -1\n')
        honest = f.run('delaunay', '--trace', 'good', 'exact.txt')
        forged = [line if '"point":0' not in line else re.sub(r'"x":\[.*?\]', '"x":["-9","-9"]', line)
                  for line in f.read('good').splitlines(keepends=True)]
        f.write('bad', sealed(''.join(forged)))
        believed = f.run('delaunay', '--resume', 'bad', '--certificate', 'c', 'exact.txt')
        assert believed.code == 0 and believed.out != honest.out, believed
        expect(f.run('verify', 'c', '--points', 'exact.txt'), 1, err='point|site')


def test_oracle_dies_anywhere():
    with Folder() as f:
        whole = f.oracle('--trace', 'whole')
        assert whole.code in (0, 3, 4), whole.err
        asked = f.asked()
        assert len(asked) == len(answers(f.read('whole'))) > 12
        for die in list(range(0, 16)) + [len(asked) // 2, len(asked) - 1, len(asked)]:
            cut = f.oracle('--trace', 'cut', DIE=str(die))
            expect(cut, 1 if die < len(asked) else whole.code, err='died|ended|exit' if die < len(asked) else '')
            before = f.asked()
            assert len(answers(f.read('cut'))) == die
            resumed = f.oracle('--resume', 'cut', '--trace', 'again')
            assert (resumed.code, resumed.out) == (whole.code, whole.out), die
            after = f.asked()
            assert before[:die] + after == asked, die
            assert story(f.read('again')) == story(f.read('whole'))


def test_sphere():
    """Traces on a sphere are those of images; json reports the rectangles of places. Another radius is another
    input."""
    places = ''.join(f'sqrt({200 * i})-90 10*sin({i})+sqrt({3 * i})\n' for i in range(1, 12))
    with Folder() as f:
        f.write('places', places)
        ask = ('delaunay', '--sphere', 'places', '--format', 'json')
        whole = f.run(*ask, '--trace', 'whole')
        expect(whole, 0)
        lines = f.read('whole').splitlines(keepends=True)
        assert len(answers(f.read('whole'))) >= 10
        for kept in (1, 2, 5, len(lines) // 2, len(lines)):
            f.write('cut', ''.join(lines[:kept]))
            resumed = f.run(*ask, '--resume', 'cut', '--trace', 'again')
            told, expected = (run.out.partition('"counters"')[0] for run in (resumed, whole))
            assert (resumed.code, told) == (whole.code, expected), (kept, resumed)
            assert story(f.read('again')) == story(f.read('whole')), kept
        expect(f.run(*ask, '--radius', '1m', '--resume', 'whole'), 1, err='whole:1:1: ')


def test_batches_in_flight():
    with Folder() as f:
        whole = f.oracle()
        asked = f.asked()
        f.oracle('--trace', 'cut', '--oracle-batch', '5', DIE='9')
        before = f.asked()
        resumed = f.oracle('--resume', 'cut', '--oracle-batch', '5')
        assert (resumed.code, resumed.out) == (whole.code, whole.out)
        assert len(asked) <= len(before) + len(f.asked()) <= len(asked) + 6


def test_retries():
    """A program that dies every few answers is started again: the same result, and only requests in flight are
    repeated; where one request kills it each time, that many times."""
    every = "int(os.environ.get('DIE', 10 ** 9)) - 1 and len(open(sys.argv[1]).readlines()) % 7 == 0"
    dying = ORACLE.replace("int(os.environ.get('DIE', 10 ** 9))", every)
    with Folder() as f:
        whole = f.oracle()
        asked = f.asked()
        f.write('oracle.py', dying)
        for batch in ('1', '5'):
            failed = f.oracle('--oracle-batch', batch, DIE='1')
            expect(failed, 1, err='it ended with exit status 1')
            f.asked()
            result = f.oracle('--oracle-batch', batch, '--oracle-retries', '1', DIE='1')
            assert (result.code, result.out) == (whole.code, whole.out), result.err
            again = f.asked()
            assert set(again) == set(asked) and len(asked) < len(again) <= 2 * len(asked) * int(batch)
        f.write('oracle.py', ORACLE)
        assert f.oracle('--oracle-retries', '3', DIE='6').code == 1
        assert f.asked()[6:] == [asked[6]] * 4


def test_retries_of_the_silent():
    with Folder() as f:
        whole = f.oracle()
        pause = "if i == 4 and not os.path.exists('begun'):\n        open('begun', 'w')\n        time.sleep(60)\n    "
        f.write('oracle.py', ORACLE.replace('print(i, f', pause + 'print(i, f'))
        result = f.oracle('--oracle-timeout', '2', '--oracle-retries', '1', '--oracle-jobs', '3')
        assert (result.code, result.out) == (whole.code, whole.out), result.err


def test_retries_at_the_start():
    with Folder() as f:
        once = "import os, sys\nif not os.path.exists('begun'):\n    open('begun', 'w')\n    sys.exit(3)\n"
        f.write('oracle.py', once + ORACLE)
        expect(f.oracle('--oracle-retries', '1'), f.oracle().code)
        os.remove(f.path('begun'))
        expect(f.oracle(), 1, err='ended with exit status 3')


def test_killed():
    with Folder() as f:
        whole = f.oracle()
        asked = f.asked()
        with subprocess.Popen([COMMAND, 'delaunay', '--oracle', f'exec {sys.executable} oracle.py log', '--max-bits', '300',
                               '--trace', 'cut'], cwd=f.folder.name, env={**os.environ, 'SLOW': '0.02'},
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            until = time.monotonic() + 60
            while len(f.read('log').splitlines()) < 9 and time.monotonic() < until:
                time.sleep(0.01)
            process.send_signal(signal.SIGKILL)
        known = len(answers(f.read('cut')))
        assert known >= 7
        f.asked()
        resumed = f.oracle('--resume', 'cut')
        assert (resumed.code, resumed.out) == (whole.code, whole.out)
        assert f.asked() == asked[known:]


def test_every_command():
    seed = random.Random(1)
    commands = [['delaunay'], ['voronoi'], ['voronoi', '--until', 'hausdorff:20'], ['converge', '--no-times'], ['disc'],
                ['converge', '--no-times', '--of', 'voronoi', '--until', 'area:12'], ['bisector'], ['nearest', 'X', 'Y']]
    for command in commands:
        name, options, place = command[0], command[1:], []
        if name == 'nearest':
            options, place = [], ['sqrt(2)', 'pi']
        with Folder() as f:
            whole = f.run(name, *options, '--trace', 'whole', 'points.txt', *place)
            trace = f.read('whole')
            assert answers(trace), command
            for at in [0, len(trace)] + [seed.randrange(len(trace)) for _ in range(6)]:
                cut = trace[:at] if at else trace.split('\n', 1)[0] + '\n'
                if '\n' not in cut:
                    continue
                f.write('cut', cut)
                resumed = f.run(name, *options, '--resume', 'cut', '--trace', 'again', 'points.txt', *place)
                assert (resumed.code, resumed.out) == (whole.code, whole.out), (command, at, resumed.err)
                last = cut.rsplit('\n', 1)[1]
                half = bool(last) and not is_json(last)
                taken = len(answers(cut)) - (half and '"called":true' in last)
                note = ' are taken from this trace; its last line is cut short' if half else ''
                expect(resumed, whole.code, err=f'cut: {taken} answers{note}')
                assert story(f.read('again')) == story(trace), (command, at)


def is_json(text):
    try:
        json.loads(text)
        return True
    except ValueError:
        return False


def test_more_bits():
    with Folder() as f:
        coarse = f.run('converge', '--no-times', '--max-bits', '2', '--trace', 'cut', 'points.txt')
        assert coarse.code == 4, coarse.err
        fine = f.run('delaunay', 'points.txt')
        resumed = f.run('delaunay', '--resume', 'cut', 'points.txt')
        assert (resumed.code, resumed.out) == (fine.code, fine.out)


def test_refused():
    with Folder() as f:
        assert f.run('delaunay', '--trace', 'good', 'points.txt').code in (0, 3)
        good = f.read('good').splitlines()
        first = next(k for k, line in enumerate(good) if '"called":true' in line)
        step = json.loads(good[first])

        def refuse(lines, message, *options, line=None, points='points.txt'):
            f.write('bad', sealed('\n'.join(lines) + '\n'))
            result = f.run('delaunay', '--resume', 'bad', *options, points)
            expect(result, 1, err=f'^dyadel: bad:{line or len(lines)}:1: .*{message}')
            assert not result.out

        def changed(**members):
            return json.dumps({**step, **members})

        f.write('more.txt', POINTS + '1 1\n')
        f.write('other.txt', POINTS.replace('sqrt(2)', 'sqrt(5)'))
        refuse(good, 'a trace of 11 points, and there are 12', line=1, points='more.txt')
        refuse(good, 'another input', line=1, points='other.txt')
        for option in ('--radius=0.5', '--measured', '--decimal-comma', '--skip-missing', '--merge'):
            refuse(good, 'another input', option, line=1)
        refuse(['{}'], 'no trace of the format')
        refuse([''], 'no JSON|no trace')
        refuse(good[:1] + ['nonsense', good[first]], 'no JSON object', line=2)
        refuse(good[:1] + [changed(point=11)], 'no such point')
        refuse(good[:1] + [changed(point=10)], 'point 10 is none that can be narrowed')
        refuse(good[:1] + [changed(x=['1', '0'])], 'no rectangle')
        refuse(good[:1] + [changed(bits=None)], 'bits')
        refuse(good[:1] + [good[first], changed(x=['1000', '1001'])], 'not inside the one before')
        refuse(good[:1] + [good[-1], good[first]], 'after its outcome')
        f.write('bad', sealed('\n'.join(good[:1] + [changed(x=['5', '8'], y=['6', '8'])]) + '\n'))
        expect(f.run('delaunay', '--resume', 'bad', 'points.txt'), 1, err='point 0: .*nothing in common')
        expect(f.run('delaunay', '--resume', 'none', 'points.txt'), 1, err='none: cannot open')
        expect(f.run('delaunay', '--resume', 'good', '--trace', 'good', 'points.txt'), 2, err='is the input file')
        expect(f.run('delaunay', '--trace', 'no/trace', 'points.txt'), 1, err='cannot write.*choose another place')
        expect(f.run('check', '--resume', 'good', 'points.txt'), 2, err='check does not take --resume')


def test_reading_options():
    """A trace goes with the options that its points were read by. Options that do not concern the points may change."""
    table = 'a,b,c,n\n' + ''.join(f'sqrt({k}),{k * k % 7},{k % 3 + 1},p{k}\n' for k in range(2, 9))
    points = {'--measured': (), '--skip-missing': (), '--merge': (), '--decimal-comma': (), '--delimiter': (',',),
              '--radius': ('1/1000',), '--radius-column': ('c',), '--radius-scale': ('1/5000',)}
    names = {'--id': ('n',), '--cost-column': ('c',)}
    with Folder() as f:
        f.write('t.csv', table)
        def ask(*options):
            return f.run('delaunay', '--columns', 'a,b', 't.csv', '--quiet', '--ties', 'off', '--max-bits', '200', *options)
        for option, value in {**points, **names}.items():
            whole = ask(option, *value, '--trace', 'whole')
            again = ask(option, *value, '--resume', 'whole')
            assert (again.code, again.out) == (whole.code, whole.out) and whole.code in (0, 3, 4), (option, again)
            other = ask('--resume', 'whole')
            if option in points:
                expect(other, 1, r'\A\Z', 'whole:1:1: this is the trace of another input')
            else:
                assert other.code == whole.code, (option, other)
        ask('--radius', '1/8', '--trace', 'whole')
        expect(ask('--radius-scale', '1/8', '--resume', 'whole'), 1, r'\A\Z', 'the trace of another input')


main(globals())
