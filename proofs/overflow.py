#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nothing overflows in src/dyadic and parts of src/checker, and no pointer goes astray: proved by Frama-C's WP and CVC4.

Usage: overflow.py ROOT   (exit status 1: a goal is not proved, or a seeded fault is; 77: Frama-C, Why3 or CVC4 is absent)

overflow/NAME.c has contracts for the functions of src/FOLDER/NAME.c, and includes it; overflow/gmp.h says what is taken for
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

FILES = {  # folder, functions left out, or all that are looked at
    'dyadic': ('dyadic', [], []), 'sqrt_sign': ('dyadic', ['dyd_sqrt2_sign'], []),
    'convert': ('dyadic', ['dyd_dyadic_round_q'], []), 'exact': ('checker', [], []),
    'tree': ('checker', [], ['spread_bits', 'key_of_box', 'enclose_child', 'dyd_cert_square', 'dyd_cert_far_upper',
                             'near_lower']),
    'read': ('checker', [], ['scan_decimal']),
    'measure': ('checker', [], ['absolute_value', 'grid_place', 'turn_on_grid']),
}
LOOPS = {  # what holds in a loop: put before it
    'tree': [
        ('for (int k = 0; k < 4; k++)\n    if (first', """/*@ loop invariant 0 <= k <= 4;
            loop assigns k, out->e[0 .. 3]; loop variant 4 - k; */ """),
        ('for (int a = 0; a < 4; a += 2) {', """/*@ loop invariant a == 0 || a == 2 || a == 4;
            loop assigns a, sum; loop variant 4 - a; */ """),
    ],
    'read': [
        ("while (*p", """/*@ loop invariant digit <= p && \\subset(p, text + (0 .. strlen(text)));
            loop assigns p; loop variant strlen(text) - (p - text); */ """),
    ],
}
FAULTS = [  # file, function, what is there, what takes its place
    ('dyadic', 'dyd_dyadic_take', 'if (exp > DYD_EXP_LIMIT || exp + dyd_bits', 'if (exp + dyd_bits'),
    ('dyadic', 'dyd_dyadic_mul_2exp', '    if (e > 2 * DYD_EXP_LIMIT || e < -2 * DYD_EXP_LIMIT) return DYD_E_RANGE;\n', ''),
    ('dyadic', 'cmp_aligned', 'bool shift_x = x->exp > y->exp;', 'bool shift_x = x->exp < y->exp;'),
    ('convert', 'dyd_dyadic_round', '  if (exp > DYD_EXP_LIMIT) exp = DYD_EXP_LIMIT;\n', ''),
    ('exact', 'exact_combine', 'x->exp > y->exp ? x : y', 'x->exp < y->exp ? x : y'),
    ('exact', 'exact_divide', 'if (den) up', 'up'),
    ('exact', 'dyd_exact_top', 'mpz_sgn(x->man) ? x->exp', 'true ? x->exp'),
    ('tree', 'near_lower', 'int64_t left = b->e[a] - c->e[a + 1]', 'int64_t left = b->e[a] - c->e[a + 2]'),
    ('read', 'scan_decimal', "*p >= '0' && *p <= '9'", "*p != ' '"),
    ('measure', 'turn_on_grid', 'int64_t det = x * t - y * z,', 'int64_t det = 4 * x * t - y * z,'),
    ('tree', 'dyd_cert_far_upper', 'dyd_cert_square(left > right ? left : right)', 'dyd_cert_square(4 * left)'),
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


def copied(root, work, name, old='', new=''):
    """The source with what holds in its loops, and a fault, in a folder that comes before src."""
    folder = FILES[name][0]
    text = (root / 'src' / folder / f'{name}.c').read_text(encoding='utf-8')
    for what, by in [(old, new)] if old else []:
        if text.count(what) != 1:
            sys.exit(f'{name}: {what!r} is not there once')
        text = text.replace(what, by)
    for what, by in LOOPS.get(name, []):
        if what not in text:
            sys.exit(f'{name}: there is no loop {what!r}')
        text = text.replace(what, by + what)
    (work / folder).mkdir(exist_ok=True)
    (work / folder / f'{name}.c').write_text(text, encoding='utf-8')
    return work / folder / f'{name}.c'


def try_file(root, work, name):
    _, left_out, only = FILES[name]
    options = ['-wp-timeout', '120'] + (['-wp-skip-fct', ','.join(left_out)] if left_out else [])
    options += ['-wp-fct', ','.join(only)] if only else []
    copy = copied(root, work, name)
    (proved, count), output = goals(root, name, [work], options)
    copy.unlink()
    print(f'{name}: {proved} of {count} goals proved', *left_out and ['without', *left_out], *only and ['of', *only],
          flush=True)
    if count and proved == count:
        return True
    print(output)
    return False


def try_fault(root, work, name, function, old, new):
    copy = copied(root, work, name, old, new)
    (proved, count), _ = goals(root, name, [work], ['-wp-timeout', '10', '-wp-fct', function])
    copy.unlink()
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
        good = [try_file(root, pathlib.Path(work), name) for name in FILES]
        good += [try_fault(root, pathlib.Path(work), *fault) for fault in FAULTS]
    sys.exit(not all(good))


main()
