#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""check() as pytest and hypothesis use it: a good stream passes, one that is not nested fails with a small schedule."""
import os
import pathlib
import subprocess
import sys
import tempfile

import harness

harness.need('pytest', 'hypothesis')

TESTS = '''
import dyadel, hypothesis
from fractions import Fraction

def good(i, bits):
    return i, i, Fraction(i * i) - Fraction(1, 2**bits), Fraction(i * i) + Fraction(1, 2**bits)

def bad(i, bits):
    low = Fraction(bits, 100) if i == 2 and bits > 90 else 0
    return i, i, low, low + Fraction(1, 2**bits)

def test_good():
    dyadel.check(dyadel.Source(5, good), schedules=3)

def test_bad():
    dyadel.check(dyadel.Source(5, bad), schedules=30)

@hypothesis.settings(max_examples=10, deadline=None)
@hypothesis.given(dyadel.moves(5))
def test_good_moves(moves):
    dyadel.check(dyadel.Source(5, good), moves=moves)

@hypothesis.settings(max_examples=200, deadline=None, derandomize=True, database=None)
@hypothesis.given(dyadel.moves(5))
def test_bad_moves(moves):
    dyadel.check(dyadel.Source(5, bad), moves=moves)
'''


def test_pytest():
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, 'test_streams.py').write_text(TESTS, encoding='utf-8')
        done = subprocess.run([sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', folder], capture_output=True,
                              text=True, check=False, cwd=folder, env={**os.environ, 'PYTHONPATH': harness.PACKAGE})
    assert done.returncode == 1 and '2 failed, 2 passed' in done.stdout, done.stdout + done.stderr
    assert done.stdout.count('BrokenPromise: stream: ') >= 2 and 'point 2' in done.stdout, done.stdout


harness.run_all(globals())
