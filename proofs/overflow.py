#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nothing overflows in src/dyadic, and no pointer goes astray: proved by Frama-C's WP and CVC4.

Usage: overflow.py ROOT   (exit status 1: a goal is not proved, or a seeded fault is; 77: Frama-C, Why3 or CVC4 is absent)

overflow/NAME.c has contracts for the functions of src/dyadic/NAME.c, and includes it; overflow/gmp.h says what is taken for
granted of GMP, overflow/math.h of the functions on doubles. Of each function WP proves what it promises, the conditions of
all that it calls, and that no operation is undefined: signed overflow, memory that is not there, shifts, conversions of
integers that lose something. Then faults are put in, one at a time: goals have to fail.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FILES = {'dyadic': [], 'sqrt_sign': ['dyd_sqrt2_sign'], 'convert': ['dyd_dyadic_round_q']}  # and what is left out
FAULTS = [  # file, function, what is there, what takes its place
    ('dyadic', 'dyd_dyadic_take', 'if (exp > DYD_EXP_LIMIT || exp + dyd_bits', 'if (exp + dyd_bits'),
    ('dyadic', 'dyd_dyadic_mul_2exp', '    if (e > 2 * DYD_EXP_LIMIT || e < -2 * DYD_EXP_LIMIT) return DYD_E_RANGE;\n', ''),
    ('dyadic', 'cmp_aligned', 'bool shift_x = x->exp > y->exp;', 'bool shift_x = x->exp < y->exp;'),
    ('convert', 'dyd_dyadic_round', '  if (exp > DYD_EXP_LIMIT) exp = DYD_EXP_LIMIT;\n', ''),
]
OPTIONS = ['-wp', '-wp-rte', '-warn-special-float', 'none',  # doubles are another matter
           '-warn-signed-downcast', '-warn-unsigned-downcast', '-wp-prover', 'cvc4', '-wp-par', '2']


def goals(root, name, folders, options):
    """(proved, all) of a file, and the output. Only what is in the current folder comes before Frama-C's own headers."""
    here = root / 'proofs' / 'overflow'
    where = ' '.join(f'-I{f}' for f in ['.', *folders, root / 'src', root / 'include'])
    run = subprocess.run(['frama-c', f'-cpp-extra-args={where}', *OPTIONS, *options, f'{name}.c'],
                         cwd=here, env={**os.environ, 'PWD': str(here)}, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, encoding='utf-8', errors='replace', check=False)
    sums = re.search(r'Proved goals: +(\d+) / (\d+)', run.stdout)
    return (int(sums[1]), int(sums[2])) if sums and run.returncode == 0 else (0, 0), run.stdout


def try_file(root, name, left_out):
    options = ['-wp-timeout', '120'] + (['-wp-skip-fct', ','.join(left_out)] if left_out else [])
    (proved, count), output = goals(root, name, [], options)
    print(f'{name}: {proved} of {count} goals proved', *left_out and ['without', *left_out], flush=True)
    if count and proved == count:
        return True
    print(output)
    return False


def try_fault(root, work, name, function, old, new):
    text = (root / 'src' / 'dyadic' / f'{name}.c').read_text(encoding='utf-8')
    if text.count(old) != 1:
        print(f'fault in {function}: its text is not there once')
        return False
    (work / 'dyadic').mkdir(exist_ok=True)
    (work / 'dyadic' / f'{name}.c').write_text(text.replace(old, new), encoding='utf-8')
    (proved, count), _ = goals(root, name, [work], ['-wp-timeout', '10', '-wp-fct', function])
    (work / 'dyadic' / f'{name}.c').unlink()
    print(f'fault in {function}: {proved} of {count} goals proved', flush=True)
    return 0 < proved < count


def main():
    if not all(shutil.which(tool) for tool in ('frama-c', 'why3', 'cvc4')):
        print('needs frama-c, why3 and cvc4 (packages frama-c-base, cvc4)')
        sys.exit(77)
    root = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as work:
        os.environ['WHY3CONFIG'] = os.path.join(work, 'why3.conf')
        subprocess.run(['why3', 'config', 'detect'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        good = [try_file(root, *item) for item in FILES.items()]
        good += [try_fault(root, pathlib.Path(work), *fault) for fault in FAULTS]
    sys.exit(not all(good))


main()
