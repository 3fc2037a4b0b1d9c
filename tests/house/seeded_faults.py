#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faults seeded into a copy of the sources are found by the scripts that tie code, claims and theories together.

Usage: seeded_faults.py ROOT   (exit status 1 when a fault goes unnoticed)

Each fault replaces a text, which must occur, by another; check_constants.py or check_claims.py must then fail and
say something about it that it does not say without the fault.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

MESH, DISTANCE = 'src/skeleton/mesh_filter.h', 'src/skeleton/distance_filter.h'
NEAR, INTERVAL = 'src/legal/near_filter.h', 'src/predicate/interval_filter.h'
STAR = 'src/legal/star_filter.c'
# file, text, its replacement, script that must notice, word in its complaint
FAULTS = [
    (MESH, 'extent_x * extent_y * 1.01e-15', 'extent_x * extent_y * 1.0e-15', 'constants', 'c_orient_bound'),
    (MESH, '#define DYD_INCIRCLE_BOUND 4.5e-16', '#define DYD_INCIRCLE_BOUND 4.0e-16', 'constants', 'c_incircle_bound'),
    (DISTANCE, '(1 - 10 * 0x1p-53)', '(1 - 4 * 0x1p-53)', 'constants', 'c_down_factor'),
    (MESH, 'extent_x * extent_y * 1.01e-15', '1.01e-15 * extent_x * extent_y', 'constants', 'dyd_filter_orient_bound'),
    (MESH, 'e = 11.05 * 0x1p-53 * e', 'e = 11.0 * 0x1p-53 * e', 'constants', 'c_incircle_near'),
    (NEAR, 'k = 24.3 * reach', 'k = 24.2 * reach', 'constants', 'c_near_k'),
    (NEAR, 'k * (lv * lz) * (a1 + ea)', 'k * (lv * lz) * (a1 - ea)', 'constants', 'dyd_filter_edge_near'),
    (NEAR, 'return 48.6 * reach * sqrt(lu * lw)', 'return 48.6 * (reach * sqrt(lu * lw))', 'constants', 'dyd_filter_hull_edge_near'),
    (INTERVAL, 'if (!(b.lo > 0 || b.hi < 0))', 'if (!(b.lo >= 0 || b.hi < 0))', 'constants', 'dyd_iv_div'),
    ('src/skeleton/tree_filter.c', 'px + py + 8 * 0x1p-53', 'px + py + 2 * 0x1p-53', 'constants', 'c_reach'),
    ('src/skeleton/scale_set_filter.c', '* 4 * 0x1p-52 * fabs(x)', '* 1 * 0x1p-53 * fabs(x)', 'constants', 'c_scale'),
    (STAR, 'double wide = (rho + p->reach) * DYD_UP_FACTOR', 'double wide = rho + p->reach', 'constants', 'certify_edges'),
    (STAR, 'need + 8 * 0x1p-53', 'need + 2 * 0x1p-53', 'constants', 'c_star_hull'),
    (STAR, '2 * (largest + 3 * sk->reps.delta)', '2 * (largest + 2 * sk->reps.delta)', 'constants', 'z_star_three'),
    ('src/stream/expr_filter.c', 'if (b.lo <= 0 && b.hi >= 0)', 'if (b.lo < 0 && b.hi > 0)', 'constants', 'divide'),
    ('src/predicate/cell_filter.c', 'i ? dyd_iv_sub(bl, root) : dyd_iv_add(bl, root)', 'dyd_iv_add(bl, root)', 'constants', 'point_and_line'),
    ('src/legal/near_filter.c', 'reach : 0x1p-300}', 'reach : 0x1p-500}', 'constants', 'c_near_floor'),
    ('src/skeleton/rects_filter.c', 'isnan(h) ? -INFINITY : h', 'isnan(h) ? INFINITY : h', 'constants', 'dyd_height_lower'),
    ('src/dyadic/sqrt_sign.c', 'if (nb - 3 >= na) return -1;', 'if (nb - 2 >= na) return -1;', 'constants', 'compare_squares'),
    ('src/predicate/solve.c', 'mpz_submul(out->a[k], out->b[k], out->t);', 'mpz_addmul(out->a[k], out->b[k], out->t);',
     'constants', 'point_and_line'),
    ('proofs/theories/FiltersConst.v', '(2281771080410813, -102)%Z', '(2281771080410812, -102)%Z', 'constants', 'c_incircle_bound'),
    ('proofs/claims/filters.md', '`filter_incircle_at_correct`', '`filter_incircle_correct`', 'claims', 'filter_incircle_correct'),
    ('proofs/README.md', 'filter_orient_correct, ', '', 'claims', 'filter_orient_correct'),
]


def run(root, script):
    """Exit status and the set of complaints of a script on root."""
    done = subprocess.run([sys.executable, str(root / f'tests/house/check_{script}.py'), str(root)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, set(done.stdout.splitlines())


def unnoticed(root):
    before = {script: run(root, script)[1] for script in ('constants', 'claims')}
    for path, text, fault, script, word in FAULTS:
        good = (root / path).read_text(encoding='utf-8')
        if text not in good:
            yield f'{path}: "{text}" is not there any more'
            continue
        (root / path).write_text(good.replace(text, fault, 1), encoding='utf-8')
        status, said = run(root, script)
        (root / path).write_text(good, encoding='utf-8')
        new = sorted(line for line in said - before[script] if word in line)
        if status != 1 or not new:
            yield f'{path}: "{fault}" for "{text}" goes unnoticed by check_{script}.py'
        else:
            print(f'noticed: {new[0]}')


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name in ('src', 'include', 'proofs', 'tests'):
            shutil.copytree(source / name, root / name, ignore=shutil.ignore_patterns('data', '__pycache__'))
        found = list(unnoticed(root))
    print('\n'.join(found) or f'{len(FAULTS)} faults, all noticed')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
