#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ctrl-C ends a run soon, wherever the library is, and known results are kept; handlers of one's own are obeyed."""
import os
import signal
import threading
import time

import harness
import numpy as np

import dyadel

LARGE = 4_000_000


def interrupt_after(seconds):
    """Sends SIGINT to this process later; the thread that does it, with the CPU time of it, since others may be at work on
    this machine."""
    def send():
        time.sleep(seconds)
        thread.sent = time.process_time()
        os.kill(os.getpid(), signal.SIGINT)
    thread = threading.Thread(target=send, daemon=True)
    thread.start()
    return thread


def interrupted(prepare, delay):
    """Runs what prepare() returns and interrupts it after a delay, or sooner where the machine is so quick that it ends
    before: the error, and the seconds of CPU from the signal to it."""
    for _ in range(10):
        call, over = prepare(), False
        thread = interrupt_after(delay)
        try:
            call()
            over = True
            time.sleep(60)
        except KeyboardInterrupt as error:
            if not over:
                return error, time.process_time() - thread.sent
        delay /= 2
    raise AssertionError(f'{call} ends before a signal comes')


def test_four_million_points():
    points = np.random.default_rng(1).random((LARGE, 2))
    for delay in (0.1, 0.4, 0.8, 1.6):
        made = []

        def prepare():
            made.append(dyadel.Delaunay())
            made[-1]._append(points)
            return made[-1].refine
        for _ in range(3):  # others at work on this machine slow its memory down, too
            late = interrupted(prepare, delay)[1]
            print(f'{delay} s: back after {late:.3f} s')
            if late < 0.5:
                break
        assert late < 0.5
        assert made[-1].outcome == 'cancelled' and len(made[-1]) == LARGE
    assert interrupted(lambda: lambda: dyadel.delaunay(points), 0.5)[0].result.outcome == 'cancelled'


def test_what_is_known_is_kept():
    """The second stage of one that never ends."""
    def slow(i, bits):
        if bits > 64:
            time.sleep(0.01)
        return i % 2, i % 2, i // 2 - 2.0**-bits, i // 2 + 2.0**-bits
    interrupt_after(0.3)
    error = harness.raised(KeyboardInterrupt, dyadel.delaunay, dyadel.Source(4, slow), step_bits=1)
    assert len(error.result.pairs) == 6


def test_own_handler():
    """It is called, and the run continues when it does not raise."""
    points = np.random.default_rng(2).random((600_000, 2))
    seen, delay = [], 0.1
    before = signal.signal(signal.SIGINT, lambda number, frame: seen.append(number))
    try:
        while not seen and delay > 1e-3:
            thread = interrupt_after(delay)
            d = dyadel.delaunay(points)
            within = seen[:]
            thread.join()
            seen, delay = within, delay / 2
    finally:
        signal.signal(signal.SIGINT, before)
    assert d.outcome == 'decided' and seen == [signal.SIGINT]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_ignored():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        interrupt_after(0.05)
        assert dyadel.delaunay(np.random.default_rng(2).random((300_000, 2))).outcome == 'decided'
    finally:
        signal.signal(signal.SIGINT, before)


def test_other_long_work():
    d = dyadel.delaunay(np.random.default_rng(3).random((20_000, 2)), radius=1e-3)
    for call in (lambda: dyadel.check(dyadel.Source(60, lambda i, bits: (i, i * i)), schedules=10**6),
                 lambda: d.voronoi(window=(0, 1, 0, 1)), lambda: d.plan()):
        assert interrupted(lambda call=call: call, 0.2)[1] < 3
    assert len(d.legal) > 0


def test_main_thread_only():
    """A run in another thread continues; the main thread is interrupted as ever."""
    done = []
    points = np.random.default_rng(4).random((300_000, 2))
    thread = threading.Thread(target=lambda: done.append(dyadel.delaunay(points).outcome))
    thread.start()
    interrupt_after(0.05)
    harness.raised(KeyboardInterrupt, time.sleep, 5)
    thread.join()
    assert done == ['decided']


harness.run_all(globals())
