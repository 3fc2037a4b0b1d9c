# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the tests of the Python package share. Arguments of each: the folder of the package, that of tests/data."""
import importlib
import os
import random
import resource
import sys
import time

SKIPPED = 77  # what meson takes for "not run"
PACKAGE, DATA = (os.path.abspath(argument) for argument in sys.argv[1:3])
sys.path.insert(0, PACKAGE)


def need(*modules):
    """Leaves, saying so, where one of them is not installed."""
    for name in modules:
        try:
            importlib.import_module(name)
        except ImportError:
            print(f'skipped: {name} is not installed')
            sys.exit(SKIPPED)


need('numpy')


def seeded(name):
    seed = os.environ.get('DYADEL_TEST_SEED', '1')
    print(f'{name}: seed {seed}')
    return random.Random(f'{name} {seed}')


def user_cpu():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def raised(kind, function, *args, **options):
    """The exception of this kind that the call raises."""
    try:
        function(*args, **options)
    except kind as error:
        return error
    raise AssertionError(f'{function} raised nothing')


def run_all(scope):
    """Every function called test_*, in order."""
    for name, function in list(scope.items()):
        if name.startswith('test_'):
            begun = time.monotonic()
            function()
            print(f'{name}: fine, {time.monotonic() - begun:.1f} s')
