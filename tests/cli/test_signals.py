#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ctrl-C, broken pipes, closed streams, time limits.

Usage: test_signals.py COMMAND DATA
"""
import os
import pty
import re
import select
import signal
import subprocess
import tempfile
import time

from harness import COMMAND, count, expect, main, run

# Two equal reals are never told apart, so the square stays undecided up to any precision.
# Four points of one circle that no precision tells from others; a million bits of them take many seconds.
SLOW = 'exp(log(' * 4 + '6' + '))' * 4
ENDLESS = f'exp(log({SLOW})/2) 0\n0 sqrt({SLOW})\n-exp(log({SLOW})/2) 0\n0 -sqrt({SLOW})\n'
FOREVER = ('--max-bits', '1000000', '--timeout', '100')


# Equal reals for the commands of single answers; these take the longer the more bits are requested. That they are equal
# would be proved where ties are.
SINES = [f'sin({k})' for k in range(1, 31)]
UP, DOWN = '+'.join(SINES), '+'.join(reversed(SINES))
ENDLESS_PIECES = {
    ('bisector',): f'{UP} 0\n{DOWN} 0\n',
    ('disc',): f'0 0\n1 0\n0 1\n1+({UP})-({DOWN}) 1\n',
    ('nearest', '0', '0', '--ties', 'off'): f'{UP} 0\n0 {DOWN}\n',
}


def start(*args, text, command=('delaunay',), **options):
    with tempfile.NamedTemporaryFile('w', suffix='.txt', delete=False) as f:
        f.write(text)
    options.setdefault('stdout', subprocess.PIPE)
    process = subprocess.Popen([COMMAND, command[0], '--comments', f.name, *command[1:], *args], stderr=subprocess.PIPE, **options)
    process.points = f.name
    return process


def test_first_interrupt_writes_what_is_known():
    for number in (signal.SIGINT, signal.SIGTERM):
        process = start(*FOREVER, text=ENDLESS)
        time.sleep(1)
        process.send_signal(number)
        out, err = process.communicate(timeout=120)
        assert process.returncode == 5, (process.returncode, err)
        assert count(out.decode())['indeterminate'] == 2 and count(out.decode())['legal'] == 4
        assert b'cancelled: 4 legal' in err, err


def wait_for(process, what, seconds=60):
    """Waits until the process has used that many seconds of CPU, or ended."""
    until = time.monotonic() + seconds
    while process.poll() is None and time.monotonic() < until:
        with open(f'/proc/{process.pid}/stat', encoding='ascii') as stat:
            if int(stat.read().rsplit(')', 1)[1].split()[11]) >= what * os.sysconf('SC_CLK_TCK'):
                return


def test_first_interrupt_in_single_answers():
    """bisector, disc, nearest: stopped between two narrowings, they write known results."""
    known = {'bisector': '^# the rectangles meet', 'disc': '^FFC,1/2,1/2,1/2,', 'nearest': '^0,possible,.*\n1,possible,'}
    for command, text in ENDLESS_PIECES.items():
        process = start('--max-bits', '1000000', '--timeout', '100', text=text, command=command)
        wait_for(process, 0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=120)
        assert process.returncode == 5, (command, process.returncode, err)
        assert re.search(known[command[0]], out.decode(), re.M), (command, out)
        assert err.startswith(b'dyadel: cancelled: '), (command, err)


def test_second_interrupt_ends():
    same = f'exp(log(({DOWN})^2)/2)'  # equal to the absolute value, which is not seen
    square = f'{UP} 0\n0 {same}\n-({UP}) 0\n0 -({same})\n'
    for command, text in {('delaunay',): square, **ENDLESS_PIECES}.items():
        with tempfile.TemporaryDirectory() as folder:
            process = start('--max-bits', '1000000', '-o', os.path.join(folder, 'out'), text=text,
                            command=command)
            wait_for(process, 1)
            process.send_signal(signal.SIGINT)
            time.sleep(0.2)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            assert process.returncode in (-signal.SIGINT, 5), (command, process.returncode)
            left = os.listdir(folder)
            # The second one may come when the file is whole already; nothing else is ever left.
            assert left == ['out'] or (left == [] and process.returncode != 5), (command, left)


def test_interrupt_on_a_terminal():
    """Ctrl-C as the terminal sends it, with a bar drawn."""
    for command, text in ENDLESS_PIECES.items():
        with tempfile.NamedTemporaryFile('w', suffix='.txt') as f:
            f.write(text)
            f.flush()
            pid, master = pty.fork()
            if pid == 0:
                os.execv(COMMAND, [COMMAND, command[0], f.name, *command[1:], '--max-bits', '1000000'])
            seen = read_terminal(master, 2.5)
            os.write(master, b'\x03')
            seen += read_terminal(master, 60)
            os.close(master)
            status = os.waitpid(pid, 0)[1]
        assert os.WIFEXITED(status) and os.WEXITSTATUS(status) == 5, (command, status, seen)
        assert b'\r\x1b[K[' in seen and b'dyadel: cancelled: ' in seen.split(b'\r\x1b[K')[-1], (command, seen[-400:])


def test_interrupt_while_reading_ends():
    process = subprocess.Popen([COMMAND, 'delaunay', '-'], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=20) == -signal.SIGINT
    process.stdin.close()
    process.stdout.close()


def test_timeout():
    begun = time.monotonic()
    result = run('delaunay', '-', '--max-bits', '1000000', '--timeout', '0.5', stdin=ENDLESS)
    expect(result, 4, 'indeterminate', 'time limit reached .raise --timeout')
    assert time.monotonic() - begun < 60


def test_broken_pipe():
    grid = ''.join(f'{x} {y}\n' for x in range(100) for y in range(100))
    process = start('--quiet', text=grid)
    process.stdout.read(10)
    process.stdout.close()
    err = process.stderr.read()
    assert process.wait(timeout=60) == -signal.SIGPIPE and err == b'', (process.returncode, err)


def test_closed_output():
    for args in (('delaunay', '-'), ('--help',), ('--version',)):
        done = subprocess.run([COMMAND, *args], input=b'0 0\n1 1\n', stderr=subprocess.PIPE, timeout=60, check=False,
                              preexec_fn=lambda: os.close(1))
        assert done.returncode == 1 and b'cannot write' in done.stderr, (args, done)


def test_full_device():
    with open('/dev/full', 'wb') as full:
        done = subprocess.run([COMMAND, 'delaunay', '-'], input=b'0 0\n1 1\n', stdout=full, stderr=subprocess.PIPE,
                              timeout=60, check=False)
    assert done.returncode == 1 and b'No space left' in done.stderr, done


def read_terminal(master, seconds):
    text, until = b'', time.monotonic() + seconds
    while time.monotonic() < until:
        if not select.select([master], [], [], 0.1)[0]:
            continue
        try:
            text += os.read(master, 4096)
        except OSError:
            break
    return text


def test_bar_on_a_terminal():
    master, slave = pty.openpty()
    with tempfile.NamedTemporaryFile('w', suffix='.txt') as f:
        f.write(ENDLESS)
        f.flush()
        process = subprocess.Popen([COMMAND, 'delaunay', f.name, *FOREVER], stdout=subprocess.DEVNULL, stderr=slave)
        os.close(slave)
        text = read_terminal(master, 3)
        process.send_signal(signal.SIGINT)
        text += read_terminal(master, 1)
        assert process.wait(timeout=120) == 5
        text += read_terminal(master, 1)
    os.close(master)
    assert b'\r\x1b[K[' in text and b'4 legal, 2 undecided' in text, text
    assert b'cancelled: 4 legal' in text.split(b'\r\x1b[K')[-1], text


main(globals())
