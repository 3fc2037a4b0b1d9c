#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the examples of the tutorial, from the root of the checkout, as it says."""
import doctest
import os
import pathlib
import sys

import harness


def test_tutorial():
    tutorial = pathlib.Path(__file__).with_name('tutorial.md').resolve()
    os.chdir(pathlib.Path(harness.DATA).parents[1])
    failed, tried = doctest.testfile(str(tutorial), module_relative=False)
    print(f'{tried} examples')
    sys.stdout.flush()
    assert tried > 40 and failed == 0


harness.run_all(globals())
