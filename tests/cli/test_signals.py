#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ctrl-C, broken pipes, closed streams, time limits.

Usage: test_signals.py COMMAND DATA
"""
import os
import pty
import select
import signal
import subprocess
import tempfile
import time

from harness import COMMAND, count, expect, main, run

# Two equal reals are never told apart, so the square stays undecided up to any precision.
ENDLESS = 'exp(log(6)/2) 0\n0 sqrt(6)\n-sqrt(6) 0\n0 -exp(log(6)/2)\n'
FOREVER = ('--max-bits', '1000000', '--timeout', '100')


def start(*args, text, **options):
    with tempfile.NamedTemporaryFile('w', suffix='.txt', delete=False) as f:
        f.write(text)
    options.setdefault('stdout', subprocess.PIPE)
    process = subprocess.Popen([COMMAND, 'delaunay', f.name, *args], stderr=subprocess.PIPE, **options)
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
    expect(result, 4, 'indeterminate', 'the time is used up; raise --timeout')
    assert time.monotonic() - begun < 60


def test_broken_pipe():
    grid = ''.join(f'{x} {y}\n' for x in range(100) for y in range(100))
    process = start('--quiet', text=grid)
    process.stdout.read(10)
    process.stdout.close()
    err = process.stderr.read()
    assert process.wait(timeout=60) == 1 and b'cannot write: Broken pipe' in err, (process.returncode, err)


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
