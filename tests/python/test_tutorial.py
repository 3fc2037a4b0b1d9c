#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the examples of the tutorial, from the root of the checkout, as it says, and that of README."""
import doctest
import os
import pathlib
import re
import sys

import harness


def test_tutorial():
    tutorial = pathlib.Path(__file__).with_name('tutorial.md').resolve()
    os.chdir(pathlib.Path(harness.DATA).parents[1])
    failed, tried = doctest.testfile(str(tutorial), module_relative=False)
    print(f'{tried} examples')
    sys.stdout.flush()
    assert tried > 40 and failed == 0


def test_readme():
    """The lines of Python in README, which print the values they claim."""
    text = (pathlib.Path(harness.DATA).parents[1] / 'README.md').read_text(encoding='utf-8')
    blocks = re.findall(r'^```python\n(.*?)^```', text, re.M | re.S)
    assert len(blocks) == 1 and blocks[0].count('\n') == 6
    scope = {}
    exec(compile(blocks[0], 'README.md', 'exec'), scope)
    assert scope['d'].outcome == 'fixpoint' and scope['v'].area < 1


harness.run_all(globals())
