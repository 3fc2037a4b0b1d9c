#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""However a command ends, by a signal, at a limit or on a disk that is full, the old output is kept or the new one is
whole, and nothing else is left: with files that have no name, and where the system has none (the shim sees to that).

Usage: test_endings.py COMMAND SHIM
"""
import os
import pwd
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

COMMAND, SHIM = (os.path.abspath(path) for path in sys.argv[1:3])
WAYS = {'without a name': {}, 'with a name': {'LD_PRELOAD': SHIM, 'FAULT_CALL': 'tmpfile', 'FAULT_AT': '1', 'FAULT_ON': '1'}}
SQUARE = b'0 0\n1 0\n0 1\n1 1\n'
OLD = b'old\n'
# A square of reals that no precision tells from one.
SLOW = 'exp(log(' * 4 + '6' + '))' * 4
ENDLESS = f'exp(log({SLOW})/2) 0\n0 sqrt({SLOW})\n-exp(log({SLOW})/2) 0\n0 -sqrt({SLOW})\n'.encode()


def put(path, text):
    with open(path, 'wb') as out:
        out.write(text)


def get(path):
    with open(path, 'rb') as f:
        return f.read()


def start(folder, *args, way, prepare=None, fault_signal=0, **who):
    """With signals as they are by default, whether or not the tests run under nohup or in the background of a script."""
    def prepare_all():
        for number in (signal.SIGHUP, signal.SIGINT, signal.SIGQUIT):
            signal.signal(number, signal.SIG_DFL)
        if prepare:
            prepare()
    return subprocess.Popen([COMMAND, *args], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE,
                            env=dict(os.environ, FAULT_SIGNAL=str(int(fault_signal)), **WAYS[way]), preexec_fn=prepare_all, **who)


def endless(folder, way, **options):
    """A run that takes for ever, with a trace begun."""
    put(os.path.join(folder, 'p'), ENDLESS)
    for name in 'ot':
        put(os.path.join(folder, name), OLD)
    process = start(folder, 'converge', 'p', '-o', 'o', '--trace', 't', '--max-bits', '1000000', way=way, **options)
    until = time.monotonic() + 60
    while process.poll() is None and time.monotonic() < until:
        with open(f'/proc/{process.pid}/stat', encoding='ascii') as stat:
            if int(stat.read().rsplit(')', 1)[1].split()[11]) >= 0.3 * os.sysconf('SC_CLK_TCK'):
                break
    return process


def open_files(process):
    for fd in os.listdir(f'/proc/{process.pid}/fd'):
        try:
            yield os.readlink(f'/proc/{process.pid}/fd/{fd}')
        except OSError:  # closed since
            pass


def writing(folder, name, way, **options):
    """A run whose result takes seconds to write, begun to be written."""
    chance = random.Random(1)
    put(os.path.join(folder, 'p'), ''.join(f'{chance.random()} {chance.random()}\n' for _ in range(20000)).encode())
    process = start(folder, 'voronoi', 'p', '-o', name, '--format', 'json', way=way, **options)
    place = os.path.dirname(os.path.join(os.path.realpath(folder), name)) + '/'
    while process.poll() is None and not any(
            path.startswith(place) and not path.endswith('/p') for path in open_files(process)):
        time.sleep(0.001)
    assert process.poll() is None, process.communicate()
    return process


def no_core():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


# Twelve points, and a note of each answer that was given; it stops answering after so many.
ORACLE = """import math, sys, time
print('points 12', flush=True)
for count, line in enumerate(sys.stdin):
    _, i, bits = line.split()
    i, scale = int(i), max(int(bits), 0) + 2
    if count == int(sys.argv[1]):
        open('stopped', 'w')
        time.sleep(1000)
    x, y = (math.isqrt(n << 2 * scale) for n in (i + 2, 25 - i))
    print(i, f'{x}*2^{-scale} {x + 1}*2^{-scale} {y}*2^{-scale} {y + 1}*2^{-scale}', flush=True)
"""


def synced(path, folder):
    """How much of the file is on the disk by what the shim saw; None: nothing, or the folder was never synced."""
    lines = [tuple(map(int, line.split())) for line in get(os.path.join(folder, 'synced')).splitlines()]
    if os.stat(folder).st_ino not in (inode for inode, _ in lines):
        return None
    return next((size for inode, size in reversed(lines) if inode == os.stat(path).st_ino), None)


def test_power_loss():
    """What a trace has on the disk when the machine fails is enough to continue from: with --trace-sync next to 0 all
    answers, by default at least the begin; after a run that ends, all of it."""
    for sync, answers in ((('--trace-sync', '1e-9'), 20), ((), 0), (('--trace-sync', '1e-9', '--resume', 'old'), 30)):
        with tempfile.TemporaryDirectory() as folder:
            trace = os.path.join(folder, 't')
            put(os.path.join(folder, 'oracle.py'), ORACLE.encode())
            way = dict(os.environ, LD_PRELOAD=SHIM, FAULT_SYNCED=os.path.join(folder, 'synced'))

            def command(stop, *options):
                oracle = f'exec env -u LD_PRELOAD {sys.executable} oracle.py {stop}'
                return [COMMAND, 'delaunay', '-q', '--oracle', oracle, '--max-bits', '300', *options]
            if '--resume' in sync:
                whole = subprocess.run(command(10 ** 9, '--trace', 'old'), cwd=folder, env=way, capture_output=True)
                assert synced(os.path.join(folder, 'old'), folder) == os.stat(os.path.join(folder, 'old')).st_size
                lines = get(os.path.join(folder, 'old')).splitlines(keepends=True)
                put(os.path.join(folder, 'old'), b''.join(lines[:11]))
                os.remove(os.path.join(folder, 'synced'))
            with subprocess.Popen(command(20, '--trace', 't', *sync), cwd=folder, env=way, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE) as process:
                until = time.monotonic() + 60
                while not os.path.exists(os.path.join(folder, 'stopped')) and time.monotonic() < until:
                    time.sleep(0.01)
                process.kill()
                process.stderr.close()
            size = synced(trace, folder)
            assert size, f'{sync}: nothing of the trace is on the disk'
            os.truncate(trace, size)
            known = len([line for line in get(trace).splitlines() if b'"called":true' in line])
            known = max(known, get(trace).count(b'"kept":true') + 20 * ('--resume' in sync))
            assert known >= answers, (sync, known)
            again = subprocess.run(command(10 ** 9, '--resume', 't'), cwd=folder, capture_output=True)
            whole = subprocess.run(command(10 ** 9), cwd=folder, capture_output=True)
            assert (again.returncode, again.stdout) == (whole.returncode, whole.stdout), again.stderr


def test_power_loss_of_results():
    """Power is lost before each step that makes a result last: under its name stands the old one, or the new one, and all of that is
    on the disk."""
    tried = 0
    for way, env in WAYS.items():
        for command, outputs in ((('delaunay', '-', '-o', 'o'), 'o'), (('delaunay', '-', '-o', 'o', '--certificate', 'c'), 'oc'),
                                 (('voronoi', '-', '-o', 'o', '--format', 'svg'), 'o'), (('delaunay', '-', '-o', 'o.gz'), ('o.gz',))):
            whole = None
            for old in (True, False):
                for step in range(0, 20):
                    with tempfile.TemporaryDirectory() as folder:
                        log = os.path.join(folder, 'synced')
                        put(log, b'')
                        for name in outputs if old else ():
                            put(os.path.join(folder, name), OLD)
                        done = subprocess.run([COMMAND, *command], cwd=folder, input=SQUARE, capture_output=True, check=False,
                                              env=dict(os.environ, LD_PRELOAD=SHIM, FAULT_SYNCED=log, FAULT_POWER=str(step), **{
                                                  k: v for k, v in env.items() if k != 'LD_PRELOAD'}))
                        tried += 1
                        now = {name: get(path) for name in outputs if os.path.exists(path := os.path.join(folder, name))}
                        if done.returncode == 3:
                            whole = whole or now
                            assert now == whole and all(synced(os.path.join(folder, name), folder) == len(now[name]) for name in now), way
                            if step:
                                break
                            continue
                        assert done.returncode == -signal.SIGKILL, (way, command, step, done)
                        for name in outputs:
                            text, known = now.get(name, OLD), synced(os.path.join(folder, name), folder) if name in now else None
                            sizes = [int(line.split()[1]) for line in get(log).splitlines()
                                     if name in now and int(line.split()[0]) == os.stat(os.path.join(folder, name)).st_ino]
                            assert text == OLD or (text == whole[name] and sizes and sizes[-1] == len(text)), (way, command, step, known)
                else:
                    raise AssertionError('power never lasts')
    assert tried > 50, tried


def test_signals_that_end():
    """The unfinished output is removed, the old output is there; a trace stays as far as it came."""
    for way in WAYS:
        for number in (signal.SIGQUIT, signal.SIGXCPU, signal.SIGABRT):
            with tempfile.TemporaryDirectory() as folder:
                process = endless(folder, way, prepare=no_core)
                process.send_signal(number)
                process.communicate(timeout=60)
                assert process.returncode == -number, (way, number, process.returncode)
                left = {name: get(os.path.join(folder, name)) for name in os.listdir(folder)}
                assert left.pop('t').startswith(b'{"format":"dyadel trace 2"'), (way, number)
                assert left == {'p': ENDLESS, 'o': OLD}, (way, number, sorted(left))
            with tempfile.TemporaryDirectory() as folder:
                put(os.path.join(folder, 'o'), OLD)
                process = writing(folder, 'o', way, prepare=no_core)
                assert len(os.listdir(folder)) == 2 + (way == 'with a name'), os.listdir(folder)
                process.send_signal(number)
                process.communicate(timeout=60)
                assert process.returncode == -number, (way, number, process.returncode)
                assert sorted(os.listdir(folder)) == ['o', 'p'] and get(os.path.join(folder, 'o')) == OLD, (way, number)


def test_signal_as_soon_as_there_is_a_file():
    with tempfile.TemporaryDirectory() as folder:
        put(os.path.join(folder, 'p'), SQUARE)
        put(os.path.join(folder, 'o'), OLD)
        process = start(folder, 'delaunay', 'p', '-o', 'o', way='with a name', prepare=no_core, fault_signal=signal.SIGQUIT)
        process.communicate(timeout=60)
        assert process.returncode == -signal.SIGQUIT, process.returncode
        assert sorted(os.listdir(folder)) == ['o', 'p'] and get(os.path.join(folder, 'o')) == OLD, os.listdir(folder)


def test_signals_that_cancel():
    """The first one cancels: known results are written. The second one ends; no unfinished file is left."""
    for way in WAYS:
        for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
            for times in (1, 2):
                with tempfile.TemporaryDirectory() as folder:
                    process = endless(folder, way)
                    process.send_signal(number)
                    if times == 2:
                        time.sleep(0.001)
                        process.send_signal(number)
                    err = process.communicate(timeout=120)[1]
                    whole = process.returncode == 5
                    assert whole or (times == 2 and process.returncode == -number), (way, number, process.returncode, err)
                    assert sorted(os.listdir(folder)) == ['o', 'p', 't'], (way, number, os.listdir(folder))
                    trace, table = (get(os.path.join(folder, name)) for name in 'to')
                    assert not whole or trace.endswith(b'"}\n'), (way, number, trace[-200:])
                    assert b'stage,' in table if whole else table == OLD or b'stage,' in table, (way, number, table)


def test_ignored_signal_stays_ignored():
    with tempfile.TemporaryDirectory() as folder:
        process = endless(folder, 'without a name', prepare=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        time.sleep(0.5)
        assert process.poll() is None
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=120)
        assert process.returncode == 5


def limited(size):
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return limit


def test_full_at_every_byte():
    """A file may not grow beyond a number of bytes: none, some, all but one, all."""
    for way in WAYS:
        for command in (('delaunay',), ('voronoi', '--format', 'json'), ('delaunay', '--format', 'svg')):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, 'o')
                assert start(folder, *command, '-', '-o', 'o', way=way).communicate(SQUARE) and os.path.exists(path)
                new = get(path)
                for size in (0, 1, len(new) // 2, len(new) - 1, len(new)):
                    put(path, OLD)
                    process = start(folder, *command, '-', '-o', 'o', way=way, prepare=limited(size))
                    err = process.communicate(SQUARE)[1]
                    if size == len(new):
                        assert process.returncode == 3 and get(path) == new, (way, process.returncode, err)
                    else:
                        assert process.returncode == 1 and get(path) == OLD, (way, size, process.returncode, err)
                        assert err.count(b'cannot write: File too large; choose another place with -o') == 1, (size, err)
                    assert os.listdir(folder) == ['o'], (way, size, os.listdir(folder))


def test_full_standard_output():
    with tempfile.TemporaryFile() as out:
        done = subprocess.run([COMMAND, 'delaunay', '-'], input=SQUARE, stdout=out, stderr=subprocess.PIPE, check=False,
                              preexec_fn=limited(5))
        assert done.returncode == 1 and b'cannot write: File too large' in done.stderr, done


def test_folder_that_vanishes():
    for way in WAYS:
        with tempfile.TemporaryDirectory() as folder:
            sub = os.path.join(folder, 'sub')
            process = start(folder, 'delaunay', '-', '-o', 'sub/o', way=way)
            err = process.communicate(SQUARE)[1]
            assert process.returncode == 1 and b'sub/o: cannot write: No such file or directory; choose' in err, err
            os.mkdir(sub)
            process = writing(folder, 'sub/o', way)
            shutil.rmtree(sub)
            err = process.communicate(timeout=120)[1]
            assert process.returncode == 1 and b'sub/o: cannot write: No such file or directory; choose' in err, err


def test_folder_that_is_no_place():
    """Neither a folder without permission nor a system without files that can be written."""
    for place, why in (('/proc/o', b'No such file or directory'), ('p/o', b'Not a directory')):
        with tempfile.TemporaryDirectory() as folder:
            put(os.path.join(folder, 'p'), SQUARE)
            process = start(folder, 'delaunay', 'p', '-o', place, way='without a name')
            err = process.communicate()[1]
            assert process.returncode == 1 and b'cannot write: ' + why + b'; choose' in err, err


def nobody():
    """Permissions: root has all of them, so that root runs the command as another user."""
    return {} if os.geteuid() else {'user': 'nobody', 'group': pwd.getpwnam('nobody').pw_gid, 'extra_groups': []}


def refused(folder, *args, way, why=b'Permission denied'):
    """The command ends with status 1 and says so; nothing in the folder has changed."""
    before = {name: get(os.path.join(folder, name)) for name in os.listdir(folder)}
    process = start(folder, *args, way=way, **nobody())
    err = process.communicate(SQUARE, timeout=60)[1]
    assert process.returncode == 1 and why in err, (args, process.returncode, err)
    assert {name: get(os.path.join(folder, name)) for name in os.listdir(folder)} == before, (args, os.listdir(folder))


def test_without_permission():
    """Folders that may not be written, or not even be looked into, and inputs that may not be read."""
    try:
        subprocess.run([COMMAND, '--version'], stdout=subprocess.DEVNULL, check=True, **nobody())
    except (PermissionError, subprocess.CalledProcessError):
        print('skipped: others may not look into the folder of the command')
        return
    for way in WAYS:
        with tempfile.TemporaryDirectory() as folder:
            shutil.chown(folder, *(('nobody',) if os.geteuid() == 0 else (os.geteuid(),)))
            for name in ('o', 'secret'):
                put(os.path.join(folder, name), OLD if name == 'o' else SQUARE)
            os.chmod(os.path.join(folder, 'secret'), 0)
            if os.geteuid() == 0:
                refused(folder, 'delaunay', 'secret', '-o', 'o', way=way)
            os.chmod(folder, 0o555)
            for more in ((), ('--certificate', 'c'), ('--trace', 't')):
                refused(folder, 'delaunay', '-', '-o', 'o', *more, way=way)
            for option, command in (('--certificate', 'voronoi'), ('--trace', 'converge'), ('--plot', 'converge')):
                refused(folder, command, '-', option, 'new.svg', way=way)
            os.chmod(folder, 0o700)
            os.mkdir(os.path.join(folder, 'closed'), 0)
            process = start(folder, 'delaunay', '-', '-o', 'closed/o', way=way, **nobody())
            err = process.communicate(SQUARE)[1]
            if os.geteuid() == 0:  # it is root's folder, and closed to the command
                assert process.returncode == 1 and b'closed/o: cannot write: Permission denied; choose' in err, err


def main():
    failed = 0
    for name, test in sorted(globals().items()):
        if not name.startswith('test_'):
            continue
        try:
            test()
            print('ok', name, flush=True)
        except (AssertionError, subprocess.TimeoutExpired) as problem:
            failed += 1
            print('FAILED', name, problem, flush=True)
    sys.exit(1 if failed else 0)


main()
