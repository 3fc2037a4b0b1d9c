#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The core suites under other compilers, optimizations and machines; missing ones are skipped, and named.

Usage: machines.py [--only NAME...] [--suites SUITE...] [--jobs N] [--keep FOLDER]

Needs clang; for s390x gcc-s390x-linux-gnu and qemu-user: the libraries of that machine come by apt-get, on Debian, into
FOLDER, and leave the system as it is; so does what -m32 takes. DYADEL_TEST_SANITIZED=1 asks for a sixth of the random
cases. Takes many minutes for each: no test of a suite.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUITES = ('base', 'dyadic', 'rect', 'stream', 'predicate', 'skeleton', 'legal', 'possible', 'delaunay', 'checker')
LIBRARIES = ('libgmp-dev', 'libmpfr-dev', 'libflint-dev', 'libflint-arb-dev', 'libjansson-dev', 'zlib1g-dev',
             'libzstd-dev', 'libcmocka-dev')
CROSS = """[binaries]
c = 's390x-linux-gnu-gcc'
ar = 's390x-linux-gnu-ar'
strip = 's390x-linux-gnu-strip'
pkgconfig = 'pkg-config'
exe_wrapper = ['qemu-s390x', '-L', '{root}']
[built-in options]
c_args = ['--sysroot={root}']
c_link_args = ['--sysroot={root}']
[properties]
sys_root = '{root}'
pkg_config_libdir = '{root}/usr/lib/s390x-linux-gnu/pkgconfig'
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
    yield 's390x', 's390x-linux-gnu-gcc', ('-Dbuildtype=release', '-Dcairo=disabled')


def unpacked(folder, machine, *packages):
    """Where Debian packages of a machine are unpacked with all that they need; None: there are none to be had."""
    root, state = folder / f'root-{machine}', folder / f'apt-{machine}'
    if root.exists():
        return root
    for part in ('lists/partial', 'archives/partial'):
        (state / part).mkdir(parents=True, exist_ok=True)
    (state / 'status').touch()
    options = {'APT::Architecture': machine, 'APT::Architectures': machine, 'Dir::State': state, 'Dir::Cache': state,
               'Dir::State::status': state / 'status', 'Debug::NoLocking': 1, 'APT::Sandbox::User': 'root'}
    apt = ['apt-get', '-qq', *(word for name, value in options.items() for word in ('-o', f'{name}={value}'))]
    try:
        subprocess.run([*apt, 'update'], check=False)
        subprocess.run([*apt, 'install', '-y', '--download-only', '--no-install-recommends', *packages], check=True)
        for package in (state / 'archives').glob('*.deb'):
            subprocess.run(['dpkg-deb', '-x', package, root], check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return root


def cross_options(folder):
    """For meson; None: the libraries are not to be had."""
    root = unpacked(folder, 's390x', *LIBRARIES)
    if not root:
        return None
    (folder / 'cross.ini').write_text(CROSS.format(root=root), encoding='ascii')
    return '--cross-file', str(folder / 'cross.ini')


def chosen(build, suites, foreign):
    """The names of the tests of these suites, and the programs that they need; where these are foreign, without tests
    that start the command or link other programs."""
    tests, targets = (json.loads(subprocess.run(['meson', 'introspect', what, build], stdout=subprocess.PIPE, check=True).stdout)
                      for what in ('--tests', '--targets'))
    command = next(target['id'] for target in targets if target['name'] == 'dyadel' and target['type'] == 'executable')
    tests = [test for test in tests if any(suite.split(':')[-1] in suites for suite in test['suite'])
             and not (foreign and (command in test['depends'] or 'seeded' in test['name']))]
    wanted = {name for test in tests for name in test['depends']}
    return ([test['name'] for test in tests],
            [os.path.relpath(name, build) for target in targets if target['id'] in wanted for name in target['filename']])


def run_build(name, compiler, options, args, folder):
    build = folder / name.replace(' ', '')
    env = dict(os.environ)
    if name == 's390x':
        cross = cross_options(folder)
        if not cross or not shutil.which('qemu-s390x'):
            return 'skipped: no libraries of s390x' if not cross else 'skipped: no qemu-s390x'
        options += cross
    else:
        env['CC'] = compiler
    if not build.exists():
        setup = subprocess.run(['meson', 'setup', build, ROOT, *options, '-Dproofs=disabled', '-Dpython=disabled'],
                               env=env, stdout=subprocess.PIPE, text=True, check=False)
        if setup.returncode:
            return f'FAILED: {setup.stdout[-2000:]}'
    tests, programs = chosen(build, args.suites, name == 's390x')
    if subprocess.run(['ninja', '-C', build, f'-j{args.jobs}', *programs], check=False).returncode:
        return 'FAILED: it does not compile'
    done = subprocess.run(['meson', 'test', '-C', build, '--no-rebuild', '--num-processes', str(args.jobs),
                           '--timeout-multiplier', '20', '--print-errorlogs', *tests], check=False)
    return 'passed' if done.returncode == 0 else 'FAILED'


def refusal(flags, word):
    """A compilation that has to be refused, with this word in the message."""
    done = subprocess.run(['gcc', *flags, '-std=c11', '-fsyntax-only', f'-I{ROOT}/include', f'-I{ROOT}/src',
                           ROOT / 'src/base/float_filter.c'], stderr=subprocess.PIPE, text=True, check=False)
    if 'No such file' in done.stderr or 'unrecognized' in done.stderr:
        return 'skipped: no headers or no such option'
    return 'refused, as it has to be' if done.returncode and word in done.stderr else 'FAILED: not refused'


def refusal_of_32_bits(folder):
    root = unpacked(folder, 'i386', 'libc6-dev', 'libgmp-dev')
    headers = [f'-I{root}/usr/include', f'-I{root}/usr/include/i386-linux-gnu'] if root else []
    return refusal(('-m32', '-msse2', '-mfpmath=sse', *headers), '128-bit')


REFUSALS = {'x87': lambda folder: refusal(('-mfpmath=387',), 'rounded to double'),
            'fast-math': lambda folder: refusal(('-ffast-math',), 'fast-math'), '32 bit': refusal_of_32_bits}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--only', nargs='+')
    parser.add_argument('--suites', nargs='+', default=SUITES)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--keep')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as own:
        folder = pathlib.Path(args.keep or own).resolve()
        folder.mkdir(exist_ok=True)
        result = {name: refuse(folder) for name, refuse in REFUSALS.items() if not args.only or name in args.only}
        for name, compiler, options in builds():
            if not args.only or name in args.only:
                found = shutil.which(compiler)
                result[name] = run_build(name, compiler, options, args, folder) if found else f'skipped: no {compiler}'
                print(f'{name:20} {result[name]}', flush=True)
    for name, text in result.items():
        print(f'{name:20} {text}')
    sys.exit(any(not text.startswith(('passed', 'skipped', 'refused')) for text in result.values()))


main()
