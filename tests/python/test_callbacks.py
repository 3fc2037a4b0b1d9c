#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points served by functions: that lie, raise, are interrupted, call back; threads; the harness on them."""
import gc
import importlib.util
import math
import os
import pickle
import re
import subprocess
import sys
import threading
import time
import weakref
from fractions import Fraction

import harness
import numpy as np

import dyadel


def half_line(i, bits):
    """Point i is (i, i^2 / 3)."""
    width = Fraction(1, 2**bits)
    return i, i, Fraction(i * i, 3) - width / 3, Fraction(i * i, 3) + width / 3


def test_answers():
    third = Fraction(1, 3)
    for answer in ((0, 1, third, third), [0, 1, '1/3', '0.5'], (0, 1, 0.25, 0.5, True), (0, 1, 0, 1, False),
                   ((0, 1), (third, 1)), (0, third), ('1/3', 5), np.array([0.0, 1.0, 0.25, 0.5])):
        d = dyadel.delaunay(dyadel.Source(1, lambda i, bits, answer=answer: answer), max_calls=20)
        low, high, bottom, top = d.rect(0)
        assert 0 <= low <= high <= 1 and bottom <= top
    d = dyadel.delaunay(dyadel.Source(5, half_line))
    assert d.outcome == 'decided' and len(d.legal) == 7
    assert all(low <= Fraction(i * i, 3) <= high for i in range(5) for low, high in [d.rect(i)[2:]])


def test_wrong_answers():
    for answer, kind in ((None, TypeError), ('0 1 0 1', TypeError), ((1, 2, 3), TypeError), ((1, 2, 3, 4, 5, 6), TypeError),
                         ((0, 1, 0, float('nan')), ValueError), ((0, 1, 0, 'x'), ValueError), ((0, 1, 0, None), TypeError),
                         ((0, 1, 0, (0, 1)), TypeError), (5, TypeError)):
        source = dyadel.Source(3, lambda i, bits, answer=answer: answer if i == 1 else (i, i, 0, 0))
        error = harness.raised(kind, dyadel.delaunay, source)
        assert isinstance(error.result, dyadel.Delaunay)


def test_lies():
    """Answers not inside the one before, and ends in the wrong order, are errors that name point and stage."""
    def drifting(i, bits):
        shift = bits if i == 2 else 0
        return i + shift, i + shift + Fraction(1, 2**bits), i * i, i * i + Fraction(1, 2**bits)
    error = harness.raised(dyadel.Error, dyadel.delaunay, dyadel.Source(4, drifting), start_bits=1, schedule='uniform')
    assert error.code == 'nesting' and error.point == 2 and error.stage >= 1, (error, error.stage)
    assert 'point 2' in str(error) and f'{error.stage}' in str(error)
    assert (pickle.loads(pickle.dumps(error)).code, str(pickle.loads(pickle.dumps(error)))) == ('nesting', str(error))
    assert error.result.outcome == 'error'
    error = harness.raised(dyadel.Error, dyadel.delaunay, dyadel.Source(1, lambda i, bits: (1, 0, 0, 0)))
    assert error.code == 'stream' and error.point == 0


def test_costs():
    """Requests cost less in total where costs are known; as many costs as points, all above 0."""
    random = harness.seeded('costs')
    spent = {None: 0.0, 50: 0.0}
    for _ in range(20):
        at = [(Fraction(i % 2) + Fraction(random.randrange(99), 100 * 2**random.randrange(8, 60)), i // 2) for i in range(4)]
        for dear in spent:
            def narrow(i, bits, dear=dear, at=at):
                spent[dear] += 1 if i else 50
                return [end + sign * Fraction(1, 2**bits) for end in at[i] for sign in (-1, 1)]
            dyadel.delaunay(dyadel.Source(4, narrow), start_bits=2, cost=dear and [dear, 1, 1, 1])
    assert 0 < spent[50] < 0.95 * spent[None], spent
    for cost, text in (([1, 2], '2 costs of 4 points'), ([1, 0, 1, 1], 'not above 0'), ([1, 1, float('nan'), 1], 'not above 0')):
        error = harness.raised(ValueError, dyadel.delaunay, dyadel.Source(4, half_line), cost=cost)
        assert text in str(error), error


class Mine(Exception):
    pass


def test_exceptions_pass_unchanged():
    mine = Mine('the instrument is off')

    def narrow(i, bits):
        if i == 3 and bits > 64:
            raise mine
        return i % 2, i % 2, i // 2, i // 2 + Fraction(1, 2**bits)
    error = harness.raised(Mine, dyadel.delaunay, dyadel.Source(4, narrow))
    assert error is mine and error.__traceback__ is not None
    d = error.result
    assert d.outcome == 'error' and len(d.pairs) == 6, 'the last complete result is kept'
    assert harness.raised(Mine, d.refine) is mine
    for kind in (SystemExit, KeyboardInterrupt, GeneratorExit, MemoryError):
        def leave(i, bits, kind=kind):
            raise kind
        harness.raised(kind, dyadel.delaunay, dyadel.Source(1, leave))


def test_policy():
    """A policy changes the way, never the statuses; what it raises or returns by mistake ends the run."""
    import random
    points = [(f'cos({k})*(1+2^-{9 + 3 * k})', f'sin({k})') for k in range(9)]
    rand, seen, plain = random.Random(4), [], dyadel.delaunay(points)

    def gamble(pairs, plan):
        seen.append((pairs, plan))
        assert all(isinstance(i, int) and i < j for i, j in pairs) and plan
        return rand.choice((None, {}, plan, {rand.randrange(9): rand.choice((-5, 0, 7, 90, 4000)) for _ in range(3)}))
    for start in range(1, 20):
        d = dyadel.delaunay(points, policy=gamble, start_bits=start)
        assert d.outcome == 'decided' and d.pairs.tolist() == plain.pairs.tolist()
    assert any(pairs for pairs, _ in seen)
    program = 'while read w a b c; do case $w in plan) p="$a $b";; choose) echo refine $p; echo go;; esac; done'
    assert dyadel.delaunay(points, policy=program, start_bits=3).pairs.tolist() == plain.pairs.tolist()
    assert dyadel.converge(points, policy=lambda pairs, plan: {k: b + 1 for k, b in plan.items()}, start_bits=3).outcome == 'decided'

    class Mine(Exception):
        pass

    def stop(pairs, plan):
        raise Mine
    harness.raised(Mine, dyadel.delaunay, points, policy=stop)
    for wrong in (7, [1], {'a': 1}, {1: 'b'}, {1: 2.5}):
        harness.raised(TypeError, dyadel.delaunay, points, policy=lambda pairs, plan: wrong)
    harness.raised(Exception, dyadel.delaunay, points, policy=lambda pairs, plan: {9: 5})
    harness.raised(TypeError, dyadel.delaunay, points, policy=7)


def test_progress():
    seen = []
    dyadel.delaunay(dyadel.Source(6, half_line), progress=seen.append, start_bits=4)
    assert [p['stage'] for p in seen] == list(range(1, len(seen) + 1)) and seen[-1]['points'] == 6

    def stop(p):
        raise Mine(p['stage'])
    error = harness.raised(Mine, dyadel.delaunay, dyadel.Source(6, half_line), progress=stop)
    assert error.args == (1,) and error.result.outcome in ('cancelled', 'decided')


def test_never_entered_twice():
    def again(i, bits):
        for call in (d.refine, lambda: d.pairs, lambda: d.append([(1, 1)]), lambda: d.rect(0), d.rects, d.certificate,
                     lambda: d.nearest(0, 0), lambda: d.outcome, d.plan):
            assert 'at work' in str(harness.raised(RuntimeError, call))
        assert 'at work' in repr(d) and len(d) == 1
        return 1, 1
    d = dyadel.Delaunay()
    d._append(dyadel.Source(1, again))
    assert d.refine().outcome == 'decided'


def test_many_engines_in_threads():
    results = []

    def work(k):
        d = dyadel.delaunay(dyadel.Source(40, half_line))
        results.append((k, len(d.legal), dyadel.delaunay(np.random.default_rng(k).random((20000, 2))).outcome))
    threads = [threading.Thread(target=work, args=(k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(results) == [(k, 2 * 40 - 3, 'decided') for k in range(6)], results


def test_gil_is_released():
    """Python continues while the library works, and another thread can cancel."""
    points = np.random.default_rng(1).random((400000, 2))
    d, ticks, done = dyadel.Delaunay(), 0, threading.Event()
    d._append(points)

    def work():
        d.refine()
        done.set()
    thread = threading.Thread(target=work)
    thread.start()
    time.sleep(0.02)
    refused = 0
    while not done.is_set():
        ticks += 1
        try:
            d.status(0, 1)
        except RuntimeError:
            refused += 1
        if ticks > 2:  # it may end within a millisecond of this
            d.cancel()
        time.sleep(0.001)
    thread.join()
    assert ticks > 1 and d.outcome in ('cancelled', 'decided'), (ticks, d.outcome)
    assert d.refine().refine().outcome == 'decided'


def test_functions_are_freed():
    """Also in a circle: the function knows the result that owns it."""
    class Instrument:
        def __call__(self, i, bits):
            return i, i * i
    instrument = Instrument()
    instrument.result = dyadel.delaunay(dyadel.Source(5, instrument))
    seen = weakref.ref(instrument)
    del instrument
    gc.collect()
    assert seen() is None


def test_functions_that_recurse():
    """A function that runs an engine of its own, of functions that do the same: Python's limit ends it, and no engine is lost."""
    depth = 0

    def deep(i, bits):
        nonlocal depth
        depth += 1
        dyadel.delaunay(dyadel.Source(1, deep))
        return 0, 0
    harness.raised(RecursionError, dyadel.delaunay, dyadel.Source(1, deep))
    assert depth > 5

    def endless(i, bits):
        return endless(i, bits)
    d = dyadel.Delaunay()
    d._append(dyadel.Source(1, endless))
    for _ in range(3):
        harness.raised(RecursionError, d.refine)

    def nested(i, bits):
        inner = dyadel.delaunay(dyadel.Source(3, half_line))
        return i + len(inner.legal), i
    assert dyadel.delaunay(dyadel.Source(4, nested)).outcome in ('decided', 'fixpoint')


def test_functions_collected_at_work():
    """The last names of the function, its result and its source go away while it is asked; another thread collects all the time."""
    over = threading.Event()

    def collect():
        while not over.is_set():
            gc.collect()
            time.sleep(0.0005)
    thread = threading.Thread(target=collect)
    thread.start()
    try:
        for _ in range(30):
            class Instrument:
                def __call__(self, i, bits):
                    held.clear()
                    gc.collect()
                    time.sleep(0.0002)  # without the lock of Python
                    return half_line(i, bits)
            held = {'instrument': Instrument(), 'd': dyadel.Delaunay()}
            seen = weakref.ref(held['instrument'])
            held['d']._append(dyadel.Source(5, held['instrument']))
            refine = held['d'].refine
            assert refine().outcome == 'decided' and not held
            del refine
            gc.collect()
            assert seen() is None
    finally:
        over.set()
        thread.join()


def test_check_to_the_cap():
    """A source that leaves its box beyond 170 bits only is found by default; a move names a point that is there."""
    asked = [0, 0, 0]

    def drifts(i, bits):
        bits = asked[i] = max(bits, asked[i])
        low = 26 + Fraction((2**bits) // 3, 2**bits) + (Fraction(1, 2**169) if i == 1 and bits > 170 else 0)
        return low, low + Fraction(1, 2**bits), i, i

    def make(i, bits):
        if bits <= 8:
            asked[i] = 0  # each schedule makes new points
        return drifts(i, bits)

    broken = harness.raised(dyadel.BrokenPromise, dyadel.check, dyadel.Source(3, make), schedules=1)
    new, old = re.findall(r'(?:from|up to) ([-0-9.]+)', str(broken))
    assert 'point 1, asked for' in str(broken) and new != old, broken
    wrong = harness.raised(dyadel.Error, dyadel.check, dyadel.Source(3, make), moves=[(1, 0, 20), (2, 99, 20)])
    assert wrong.code == 'argument' and 'there is no point 99 among these 3 points' in str(wrong), wrong


def test_reference():
    """Answers that are consistent and wrong; a reference of expressions and of exact numbers."""
    def roots(i, bits, off=Fraction(0)):
        whole = math.isqrt(i << 2 * (bits + 3))
        return i, i, Fraction(whole, 2**(bits + 3)) + off, Fraction(whole + 1, 2**(bits + 3)) + off
    true = [(k, f'sqrt({k})') for k in range(5)]
    assert dyadel.check(dyadel.Source(5, roots), schedules=2, reference=true)['schedules'] == 2

    def wrong(i, bits):
        return roots(i, bits, Fraction(i == 3, 100))
    assert dyadel.check(dyadel.Source(5, wrong), schedules=2)['schedules'] == 2, 'consistent'
    broken = harness.raised(dyadel.BrokenPromise, dyadel.check, dyadel.Source(5, wrong), schedules=2, reference=true)
    assert broken.fault == 'reference' and broken.moves[0][1] == 3 and 'point 3' in str(broken)
    again = harness.raised(dyadel.BrokenPromise, dyadel.check, dyadel.Source(5, wrong), moves=broken.moves, reference=true)
    assert again.fault == 'reference'
    halves = dyadel.Source(2, lambda i, bits: (i, Fraction(1, 2)))
    dyadel.check(halves, schedules=1, reference=[(0, 0.5), (1, Fraction(1, 2))])
    harness.raised(dyadel.BrokenPromise, dyadel.check, halves, schedules=1, reference=[(0, 0.5), (1, 0.25)])
    harness.raised(ValueError, dyadel.check, halves, reference=[(0, 0.5)])
    harness.raised(TypeError, dyadel.check, [(0, 0)], reference=[(0, 0)])


def test_moves():
    """Schedules ask one point at neighbouring precisions, which finds rounding to nearest."""
    if importlib.util.find_spec('hypothesis') is None:
        print('hypothesis is not installed: not tried')
        return
    import hypothesis

    def nearest(i, bits):
        exact, grid = Fraction(i * i + 1, 3), Fraction(1, 2**(bits + 1))
        middle = round(exact / grid) * grid
        return i, i, middle - 3 * grid / 4, middle + 3 * grid / 4
    found = 0
    for seed in range(5):
        @hypothesis.seed(seed)
        @hypothesis.settings(max_examples=60, deadline=None, database=None, phases=[hypothesis.Phase.generate])
        @hypothesis.given(dyadel.moves(4))
        def run(moves):
            assert all(1 <= stage and 0 <= point < 4 and bits >= 0 for stage, point, bits in moves)
            dyadel.check(dyadel.Source(4, nearest), moves=moves)
        try:
            run()
        except dyadel.BrokenPromise as broken:
            found += broken.fault == 'stream'
    assert found == 5, found


def test_check():
    report = dyadel.check(dyadel.Source(5, half_line), schedules=8)
    assert report['fault'] == 'fine' and report['schedules'] == 8
    assert dyadel.check(np.random.default_rng(1).random((8, 2)), radius=0.01, schedules=2)['fault'] == 'fine'
    for name, value in (('seed', -1), ('seed', 2**64), ('schedules', 0), ('schedules', 2**32), ('max_bits', -1)):
        error = harness.raised(ValueError, dyadel.check, [(0, 0), (1, 1), (0, 2)], **{name: value})
        assert str(error).startswith(f'{name}={value}; give at '), error

    def drifts(i, bits):
        return i, i, Fraction(bits, 10**6), Fraction(bits, 10**6) + Fraction(1, 2**bits)
    broken = harness.raised(dyadel.BrokenPromise, dyadel.check, dyadel.Source(4, drifts), schedules=8)
    assert isinstance(broken, AssertionError) and broken.fault == 'stream' and broken.moves
    again = harness.raised(dyadel.BrokenPromise, dyadel.check, dyadel.Source(4, drifts), moves=broken.moves)
    assert again.fault == 'stream' and len(broken.moves) <= 2, broken.moves

    def lazy(i, bits):
        return i, i, Fraction(-1, 2**min(bits, 20)), Fraction(1, 2**min(bits, 20))
    assert harness.raised(dyadel.BrokenPromise, dyadel.check, dyadel.Source(4, lazy), schedules=8).fault == 'rate'

    def raises(i, bits):
        raise Mine
    harness.raised(Mine, dyadel.check, dyadel.Source(4, raises))


def test_interpreters():
    """A second interpreter of the process is refused, whether it comes first or not; the main one goes on."""
    code = 'import dyadel; assert len(dyadel.delaunay([(0, 0), (1, 0), (0, 1)]).legal) == 3'
    for first in ('', code):
        done = subprocess.run([sys.executable, '-W', 'ignore', '-c', f'''
import _xxsubinterpreters as other
{first}
for k in range(2):
    i = other.create()
    try:
        other.run_string(i, 'import dyadel')
    except other.RunFailedError as error:
        assert 'ImportError' in str(error) and 'interpreter' in str(error), error
    else:
        raise AssertionError
    other.destroy(i)
{code}
'''], env=dict(os.environ, PYTHONPATH=os.path.dirname(os.path.dirname(dyadel.__file__))), capture_output=True, check=False)
        assert done.returncode == 0 or b"No module named '_xxsub" in done.stderr, done


harness.run_all(globals())
