#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""--oracle: the example programs agree with points given as text; faults give their message, exit status 1 and the
results known before; no process is left running, however the command ends.

Usage: test_oracle.py COMMAND DATA FOLDER EXAMPLE   (tests/programs, and the example in C, compiled)
"""
import importlib.util
import os
import random
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from harness import COMMAND, count, expect, main, run

FOLDER, IN_C = (os.path.abspath(path) for path in sys.argv[3:5])
PATIENCE = '3'  # seconds, in which any program is heard that has something to say
MARK = f'DYADEL_TEST_MARK={os.getpid()}.{time.time()}'
os.environ.update([MARK.split('=')])


def marked():
    """Other processes with the mark in their environment."""
    found = []
    for pid in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open(f'/proc/{pid}/environ', 'rb') as f:
                if int(pid) != os.getpid() and MARK.encode() in f.read():
                    found.append(pid)
        except OSError:
            pass
    return found


def assert_nothing_left():
    until = time.monotonic() + 5
    while marked() and time.monotonic() < until:
        time.sleep(0.02)
    assert not marked(), subprocess.run(['ps', '-eo', 'pid,ppid,pgid,args'], stdout=subprocess.PIPE, check=False).stdout


def ask(command, *args, **options):
    result = run('delaunay', '--oracle', command, *args, **options)
    assert_nothing_left()
    return result


# ---- examples ----

def pairs(text):
    return [line for line in text.splitlines() if not line.startswith('#')]


def agree(command, points, *args):
    """The program and the points as text give the same decided result, for any number of programs and any batch."""
    wanted = run('delaunay', '-', *args, stdin=points)
    expect(wanted, 0)
    for jobs, batch in ((1, 1), (1, 7), (3, 1), (4, 5)):
        result = ask(command, '--oracle-jobs', str(jobs), '--oracle-batch', str(batch), *args)
        expect(result, 0, err=r'\A\Z')
        assert pairs(result.out) == pairs(wanted.out), (command, jobs, batch)


def script(name):
    return shlex.join([sys.executable if name.endswith('.py') else 'sh', os.path.join(FOLDER, name)])


def test_plain_python():
    choose = random.Random(5)
    lines = []
    for _ in range(25):
        two = [(choose.randint(-99, 99), -choose.randint(1, 999)) for _ in 'xy']
        lines.append(' '.join(f'(sqrt({b * b - 4 * c})-({b}))/2' for b, c in two))
    agree(script('quadratic.py') + ' 5 25', '\n'.join(lines) + '\n', '--quiet')


def test_shell_and_bc():
    if shutil.which('bc') is None:
        print('# square_roots.sh is not tried: bc is not installed')
        return
    with open(os.path.join(FOLDER, 'square_roots.sh'), encoding='utf-8') as f:
        text = f.read().split("'")[1]
    points = ''.join(f'sqrt({a}) -sqrt({b})\n' for a, b in (line.split() for line in text.splitlines()))
    assert points.count('\n') == 8
    agree(script('square_roots.sh'), points, '--quiet')


def thue_morse(a):
    """To 600 binary digits, and the middle of the remaining interval."""
    number = 0
    for k in range(1, 601):
        number = 2 * number + bin(k * a).count('1') % 2
    return f'{2 * number + 1}*2^-601'


def test_plain_c():
    points = ''.join(f'{thue_morse(2 * k + 1)} {thue_morse(2 * k + 1001)}\n' for k in range(12))
    agree(shlex.quote(IN_C), points, '--quiet')


def test_mpmath():
    if importlib.util.find_spec('mpmath') is None:
        print('# polygon.py is not tried: mpmath is not installed')
        return
    points = ''.join(f'(1+2^(-300)*{0 ** k})*cos(2*pi*{k}/4) (1+2^(-300)*{0 ** k})*sin(2*pi*{k}/4)\n' for k in range(4))
    agree(script('polygon.py') + ' 4 300', points, '--quiet')


# ---- faults ----

# Corners of a square, sqrt(2) from the centre but for the last, which is 2^-200 farther: decided at stage 3, 256 bits.
SERVER = r'''
import math, os, sys, time
SIGNS = (1, 0), (0, 1), (-1, 0), (0, -1)
def ends(sign, bits, more):
    low = math.isqrt(2 << 2 * bits) + (more << bits - 200 if bits >= 200 else 0)
    high = low + 1 + (more if bits < 200 else 0)
    low, high = sorted((sign * low, sign * high))
    return f'{low}*2^-{bits} {high}*2^-{bits}'
def fault(bits): pass
%s
print('points 4', flush=True)
while True:
    line = sys.stdin.readline()
    if not line: break
    point, bits = map(int, line.split()[1:])
    if fault(bits) if point == 3 else None: continue
    print(point, *(ends(s, bits + 2, point == 3) for s in SIGNS[point]), flush=True)
'''
KNOWN = {'legal': 4, 'indeterminate': 2}  # at 64 and 128 bits


def server(fault='pass', prefix='exec '):
    body = f'def fault(bits):\n    if bits >= 256: {fault}\n' if fault != 'pass' else ''
    return prefix + shlex.join([sys.executable, '-c', SERVER % body])


FAULTS = [
    ('sys.exit(3)', 'it ended with exit status 3; it must answer'),
    ('os.kill(os.getpid(), 9)', 'it was killed by signal 9'),
    ('time.sleep(1000)', r'silent for 3 s; flush its output .*--oracle-timeout'),
    ('print("lorem \x1b[2J ipsum", flush=True); return True', r'it wrote "lorem \?\[2J ipsum" instead of an answer for point 3'),
    ('print("3 -9 9 -9 9", flush=True); return True', 'the new x side .* is not inside the old one .*must be a subset'),
    ('print("2 0 1 0 1", flush=True); return True', 'it wrote "2 0 1 0 1" instead of an answer for point 3'),
    ('print("3 0 1 0", flush=True); return True', 'has not the five words I XLO XHI YLO YHI'),
    ('os.close(1); time.sleep(1000)', 'it has closed its standard output'),
    ('os.fork() or os.setpgid(0, 0) or time.sleep(3); sys.exit(4)', 'exit status 4'),
    ('os.fork() and sys.exit(3); time.sleep(1000)', 'exit status 3, and a process that it started was silent for 3 s'),
    ('[os.write(1, b"7" * 65536) for _ in iter(int, 1)]', 'a line of more than 1048576 bytes'),
    ('[os.write(1, b"\\n" * 65536) for _ in iter(int, 1)]', 'it wrote "" instead of an answer'),
]


def test_faults():
    for fault, message in FAULTS:
        for jobs, batch in ((1, 1), (4, 3)):
            begun = time.monotonic()
            result = ask(server(fault), '--oracle-timeout', PATIENCE if 'sleep(1000)' in fault else '60',
                         '--oracle-jobs', str(jobs), '--oracle-batch', str(batch))
            # Not at the beginning of a line: the program that dies writes there, too.
            expect(result, 1, err=rf'dyadel: point 3: the oracle program was asked "refine 3 256": .*({message})')
            assert count(result.out) == KNOWN, (fault, result)
            assert time.monotonic() - begun < 30


def test_behind_a_shell():
    """Without exec a shell stands between, and keeps the pipes open."""
    for prefix in '', 'true; ', 'cat | ':
        result = ask(server(prefix=prefix), '--quiet')
        expect(result, 0)
        assert count(result.out) == {'legal': 5}, result.out
        for fault, message in (('os.close(1); time.sleep(1000)', 'silent for 3 s'), ('sys.exit(3)', 'exit status 3|silent'),
                               ('os.kill(os.getpid(), 9)', 'exit status 137|silent')):
            result = ask(server(fault, prefix), '--oracle-timeout', PATIENCE)
            expect(result, 1, err=message)
            assert count(result.out) == KNOWN, (prefix, fault, result)


def test_good_server():
    result = ask(server(), '--quiet')
    expect(result, 0)
    assert count(result.out) == {'legal': 5}, result.out


def test_closes_its_input():
    for jobs in '1', '4':
        # After its good answer for point 3 it is deaf; the next request of the program meets that.
        fault = 'os.dup2(os.open("/dev/null", 0), 0) if point == 3 and bits >= 64 else None'
        result = ask(server().replace('    print(point', f'    {fault}\n    print(point'), '--oracle-timeout', PATIENCE,
                     '--oracle-jobs', jobs)
        expect(result, 1, err='^dyadel: point [03]: .*(ended with exit status 0|closed its standard input)')


def test_faults_at_start():
    for command, message in (('exit 7', 'was to print "points N".*exit status 7'), (' ', 'exit status 0'),
                             ('no-such-program-at-all 2>/dev/null', 'exit status 127 .the shell did not find'),
                             ('sleep 1000', 'silent for 3 s'), ('echo hello; cat', 'is "hello"; print "points N"'),
                             ('yes', 'is "y"; print'), ('cat /dev/zero', 'more than 1048576 bytes'),
                             ('echo points 1e3; cat', 'is "points 1e3"; print')):
        result = ask(command, '--oracle-timeout', PATIENCE)
        expect(result, 1, r'\A\Z', message)


def test_memory():
    """Gigabytes without a line end, and lines without end, in little memory."""
    for text in 'head -c 3000000000 /dev/zero', 'yes 0 1 2 3 4':
        result = ask(f'echo points 3; read -r x; exec {text}', '--stats', '--oracle-timeout', '60')
        expect(result, 1)
        if not os.environ.get('DYADEL_TEST_SANITIZED'):
            assert int(result.err.split('KiB of memory at most')[1].split()[0]) < 60000, result.err


def test_usage():
    for args, message in ((('--measured',), '--measured is for points files; remove it'),
                          (('--radius', '1'), '--radius is for points files'),
                          (('--columns', 'x,y'), '--columns is for points files'),
                          (('--cost-column', 'c'), 'let the oracle begin with "points N cost C ... C"'),
                          (('file.txt',), 'one argument too many'), (('--oracle-jobs', '0'), '--oracle-jobs "0"'),
                          (('--oracle-batch', '-1'), '--oracle-batch "-1"'),
                          (('--oracle-timeout', 'soon'), '--oracle-timeout "soon"')):
        expect(ask('echo points 0', *args), 2, r'\A\Z', message)


def test_small():
    expect(ask('echo points 0; cat'), 0, r'\Ai,j,status\n\Z', r'\A\Z')
    expect(ask('echo points 1; while read -r _ i b; do echo $i 0 0 1/3 1/3; done'), 0, r'\Ai,j,status\n\Z', r'\A\Z')
    # Fixed rectangles: nothing more is asked. The number of the program is in its environment.
    fixed = 'echo points 4; while read -r _ i b; do echo $i $((i%2)) $((i%2+1)) $((i/2)) $((i/2+1)) fixed; done'
    expect(ask(fixed, '--oracle-jobs', '2', '--oracle-timeout', '60'), 3, 'indeterminate', '^dyadel: [0-9]+ legal, [0-9]+ indeterminate.* pairs; ')
    for jobs, alias in ('1', '# alias 1 0'), ('2', r'\Ai,j,status\n0,1,legal\n\Z'):
        expect(ask('echo points 2; while read -r _ i b; do echo $i $DYADEL_JOB $DYADEL_JOB 0 0; done',
                   '--oracle-jobs', jobs, env={**os.environ, 'DYADEL_JOB': '7'}), 0, alias)


# ---- costs ----

# Points at the ends of crosses, sqrt(2) from their middles, but for one end of each, which is 2^-E farther away.
CROSSES = r'''
import math, os, sys
SIGNS = (1, 0), (0, 1), (-1, 0), (0, -1)
FINE = 1500
def ends(middle, sign, more, bits):
    if not sign: return f'{middle} {middle}'
    low = math.isqrt(2 << 2 * FINE) + (more and 1 << FINE - more) >> FINE - bits
    low, high = sorted((middle << bits) + sign * end for end in (low, low + 1))
    return f'{low}*2^-{bits} {high}*2^-{bits}'
print('points', 24, *os.environ.get('COSTS', '').split(), flush=True)
for line in sys.stdin:
    i, bits = map(int, line.split()[1:])
    with open('log.' + os.environ['DYADEL_JOB'], 'a') as log: log.write(line)
    cross, end = divmod(i, 4)
    more = 100 + 97 * cross if end == cross % 4 else 0
    print(i, *(ends(m, s, more, bits + 2) for m, s in zip((10 * cross, cross ** 2), SIGNS[end])), flush=True)
'''


def ask_crosses(folder, costs, *args):
    """The result and the requests, for each program."""
    for name in os.listdir(folder):
        if name.startswith('log.'):
            os.unlink(os.path.join(folder, name))
    result = run('delaunay', '--oracle', 'exec ' + shlex.join([sys.executable, '-c', CROSSES]), *args, cwd=folder,
                 env={**os.environ, 'COSTS': costs})
    expect(result, 0, err=r'')
    asked = []
    for name in sorted(os.listdir(folder)):
        if name.startswith('log.'):
            with open(os.path.join(folder, name), encoding='utf-8') as f:
                asked += f.read().splitlines()
    return result.out, asked


def test_costs():
    """Programs that report costs: expensive points are asked less often and after cheap ones, by one program or more,
    resumed or not, and the result is the same."""
    cost = [50 if i % 4 == i // 4 % 3 else 1 for i in range(24)]
    told = 'cost ' + ' '.join(map(str, cost))
    dear = [i for i in range(24) if cost[i] > 1]

    def calls(asked, points):
        return sum(int(line.split()[1]) in points for line in asked)

    with tempfile.TemporaryDirectory() as folder:
        plain, before = ask_crosses(folder, '')
        for equal in 'cost ' + '2 ' * 24, 'cost ' + '1e-3\t' * 24:
            assert ask_crosses(folder, equal) == (plain, before)
        out, after = ask_crosses(folder, told, '--trace', 'whole')
        assert out == plain
        for i in dear:
            assert 1 <= calls(after, [i]) <= calls(before, [i])
        assert calls(after, dear) * 5 < calls(before, dear) * 4, (calls(after, dear), calls(before, dear))
        spent = [sum(cost[int(line.split()[1])] for line in asked) for asked in (before, after)]
        assert spent[1] < spent[0], spent
        # Behind the first answers cheap points are asked, and expensive ones only when as much was spent on the cheap
        # ones.
        assert cost[int(after[24].split()[1])] == 1
        assert sorted(ask_crosses(folder, told, '--oracle-jobs', '3')[1]) == sorted(after)
        with open(os.path.join(folder, 'whole'), encoding='utf-8') as f:
            lines = f.readlines()
        for kept in 1, 30, len(lines) // 2:
            with open(os.path.join(folder, 'cut'), 'w', encoding='utf-8') as f:
                f.writelines(lines[:kept])
            again, rest = ask_crosses(folder, told, '--resume', 'cut', '--quiet')
            known = sum('"called":true' in line for line in lines[:kept])
            assert (again, rest) == (plain, after[known:]), kept
    for first, message in (('3 cost 1 1', '3 points and 2 costs; print one for each point'),
                           ('2 cost 1 0', 'the cost of point 1, "0", is no exact number above 0; print one such as')):
        expect(ask(f'echo points {first}; cat'), 1, r'\A\Z', message)


# ---- ends ----

def start(command, *args):
    return subprocess.Popen([COMMAND, 'delaunay', '--oracle', command, *args], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)


def wait_for_marked(least):
    until = time.monotonic() + 20
    while len(marked()) < least and time.monotonic() < until:
        time.sleep(0.02)
    time.sleep(0.7)


STUBBORN = 'import signal; [signal.signal(s, signal.SIG_IGN) for s in (1, 2, 15)]; os.fork(); time.sleep(1000)'


def test_interrupt():
    """The first Ctrl-C ends the wait for a program that hangs, and known results are written."""
    process = start(server(STUBBORN), '--oracle-timeout', '1000', '--oracle-jobs', '2')
    wait_for_marked(5)
    begun = time.monotonic()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 5 and count(out.decode()) == KNOWN, (process.returncode, err)
    assert time.monotonic() - begun < 20
    assert_nothing_left()


def test_time_limit():
    result = ask(server(STUBBORN), '--oracle-timeout', '1000', '--timeout', '2')
    expect(result, 4, err='time limit reached .raise --timeout')
    assert count(result.out) == KNOWN


def test_death():
    """Killed outright, or by a signal while programs start: no process is left."""
    for number, command in ((signal.SIGKILL, server(STUBBORN)), (signal.SIGTERM, 'trap "" TERM; sleep 1000 & sleep 1000'),
                            (signal.SIGINT, 'sleep 1000'), (signal.SIGKILL, 'sleep 1000 | sleep 1000')):
        process = start(command, '--oracle-timeout', '1000', '--oracle-jobs', '2')
        wait_for_marked(3)
        process.send_signal(number)
        process.communicate(timeout=60)
        assert process.returncode == -number, process.returncode
        assert_nothing_left()


def test_orderly_end():
    """A program that is at work and holds something elsewhere, as srun does, gets a signal to end before it is killed:
    at a limit, when another one takes its place, and when dyadel itself is killed."""
    with tempfile.TemporaryDirectory() as folder:
        freed = os.path.join(folder, 'freed')
        holder = ('import os, signal, sys, time\n'
                  f'def free(*_): os.open({freed!r}, os.O_CREAT); os._exit(1)\n'
                  'signal.signal(signal.SIGTERM, free)\n'
                  'print("points 5", flush=True)\n'
                  'while True: time.sleep(1)\n')
        command = f'exec {shlex.quote(sys.executable)} -c {shlex.quote(holder)}'
        for code, options in ((4, ('--oracle-timeout', '1000', '--timeout', '1')), (1, ('--oracle-timeout', '1')),
                              (1, ('--oracle-timeout', '1', '--oracle-retries', '1'))):
            expect(ask(command, *options), code, out=r'.*', err=r'.')
            assert os.path.exists(freed), options
            os.unlink(freed)
        process = start(command, '--oracle-timeout', '1000')
        wait_for_marked(3)
        process.kill()
        process.communicate(timeout=60)
        assert_nothing_left()
        assert os.path.exists(freed)


main(globals())
