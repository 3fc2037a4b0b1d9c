#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The core suites under other compilers, optimizations and machines; what is absent here is skipped, and named.

Usage: machines.py [--only NAME...] [--suites SUITE...] [--jobs N] [--keep FOLDER]

DYADEL_TEST_SANITIZED=1 asks for a third of the random cases. Takes many minutes for each: no test of a suite.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUITES = ('base', 'dyadic', 'rect', 'stream', 'predicate', 'skeleton', 'legal', 'possible', 'delaunay', 'checker')
# Debian: gcc-s390x-linux-gnu, qemu-user, and of s390x libgmp-dev libmpfr-dev libflint-dev libflint-arb-dev libjansson-dev
# zlib1g-dev libzstd-dev libcmocka-dev.
CROSS = """[binaries]
c = 's390x-linux-gnu-gcc'
ar = 's390x-linux-gnu-ar'
strip = 's390x-linux-gnu-strip'
pkgconfig = 's390x-linux-gnu-pkg-config'
exe_wrapper = ['qemu-s390x', '-L', '/usr/s390x-linux-gnu']
[host_machine]
system = 'linux'
cpu_family = 's390x'
cpu = 's390x'
endian = 'big'
"""


def builds():
    """name, compiler, options of meson"""
    for compiler in ('gcc', 'clang'):
        for level in ('0', '3'):
            yield f'{compiler} -O{level}', compiler, ('-Dbuildtype=plain', f'-Doptimization={level}')
        yield f'{compiler} -march=native', compiler, ('-Dbuildtype=release', '-Dc_args=-march=native')
    yield 's390x', 's390x-linux-gnu-gcc', ('--cross-file', '@cross@', '-Dcairo=disabled')


def run_build(name, compiler, options, args, folder):
    build = pathlib.Path(folder) / name.replace(' ', '')
    cross = pathlib.Path(folder) / 'cross.ini'
    cross.write_text(CROSS, encoding='ascii')
    options = [str(cross) if option == '@cross@' else option for option in options]
    env = dict(os.environ) if str(cross) in options else dict(os.environ, CC=compiler)
    setup = subprocess.run(['meson', 'setup', build, ROOT, *options, '-Dproofs=disabled', '-Dpython=disabled'], env=env,
                           stdout=subprocess.PIPE, text=True, check=False)
    if setup.returncode:
        return f'skipped: {setup.stdout.strip().splitlines()[-1]}' if str(cross) in options else setup.stdout[-2000:]
    suites = [word for suite in args.suites for word in ('--suite', suite)]
    done = subprocess.run(['meson', 'test', '-C', build, '--num-processes', str(args.jobs), '--timeout-multiplier', '10',
                           '--print-errorlogs', *suites], check=False)
    return 'passed' if done.returncode == 0 else 'FAILED'


def refusal(flags, word):
    """A compilation that has to be refused, with this word in the message."""
    done = subprocess.run(['gcc', *flags, '-std=c11', '-fsyntax-only', f'-I{ROOT}/include', f'-I{ROOT}/src',
                           ROOT / 'src/base/float_filter.c'], stderr=subprocess.PIPE, text=True, check=False)
    if 'No such file' in done.stderr or 'unrecognized' in done.stderr:
        return 'skipped: no headers or no such option'
    return 'refused, as it has to be' if done.returncode and word in done.stderr else 'FAILED: not refused'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--only', nargs='+')
    parser.add_argument('--suites', nargs='+', default=SUITES)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--keep')
    args = parser.parse_args()
    result = {'x87': refusal(('-mfpmath=387',), 'rounded to double'), '32 bit': refusal(('-m32', '-msse2', '-mfpmath=sse'), '128-bit')}
    with tempfile.TemporaryDirectory() as folder:
        for name, compiler, options in builds():
            if not args.only or name in args.only:
                found = shutil.which(compiler)
                result[name] = run_build(name, compiler, options, args, args.keep or folder) if found else f'skipped: no {compiler}'
    for name, text in result.items():
        print(f'{name:20} {text}')
    sys.exit(any(not text.startswith(('passed', 'skipped', 'refused')) for text in result.values()))


main()
