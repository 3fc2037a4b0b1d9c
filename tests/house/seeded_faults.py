#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faults seeded into a copy of the sources are found by the scripts that tie code, claims and theories together.

Usage: seeded_faults.py ROOT   (exit status 1 when a fault goes unnoticed)

Each fault replaces a text, which must occur, by another; check_constants.py, check_claims.py, check_citations.py or
check_map.py must then fail and say something about it that it does not say without it. Faults in different files are
seeded together. Each change in CHANGES is
noticed by check_constants.py as well; renew_quotes.py must give the right message about it, and check_constants.py be
content then.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

MESH, DISTANCE = 'src/skeleton/mesh_filter.h', 'src/skeleton/rects_filter.h'
NEAR, INTERVAL = 'src/legal/star_filter.h', 'src/predicate/interval_filter.h'
STAR = 'src/legal/star_filter.c'
# file, text, its replacement, script that must notice, word in its complaint
FAULTS = [
    (MESH, 'extent_x * extent_y * 1.01e-15', 'extent_x * extent_y * 1.0e-15', 'constants', 'c_orient_bound'),
    (MESH, '#define DYD_INCIRCLE_BOUND 4.5e-16', '#define DYD_INCIRCLE_BOUND 4.0e-16', 'constants', 'c_incircle_bound'),
    (DISTANCE, '(1 - 10 * 0x1p-53)', '(1 - 4 * 0x1p-53)', 'constants', 'c_down_factor'),
    (MESH, 'extent_x * extent_y * 1.01e-15', '1.01e-15 * extent_x * extent_y', 'constants', 'dyd_filter_orient_bound'),
    ('src/skeleton/mesh_filter.c', 'e = 11.05 * 0x1p-53 * e', 'e = 11.0 * 0x1p-53 * e', 'constants', 'c_incircle_near'),
    (NEAR, 'k = 24.3 * reach', 'k = 24.2 * reach', 'constants', 'c_near_k'),
    (NEAR, 'k * (lv * lz) * (a1 + ea)', 'k * (lv * lz) * (a1 - ea)', 'constants', 'dyd_filter_edge_near'),
    (NEAR, 'return 48.6 * reach * sqrt(lu * lw)', 'return 48.6 * (reach * sqrt(lu * lw))', 'constants', 'dyd_filter_hull_edge_near'),
    (INTERVAL, 'if (!(b.lo > 0 || b.hi < 0))', 'if (!(b.lo >= 0 || b.hi < 0))', 'constants', 'dyd_iv_div'),
    ('src/skeleton/rects_filter.c', 'px + py + 8 * 0x1p-53', 'px + py + 2 * 0x1p-53', 'constants', 'c_reach'),
    ('src/skeleton/rects_filter.c', '* 4 * 0x1p-52 * fabs(x)', '* 1 * 0x1p-53 * fabs(x)', 'constants', 'c_scale'),
    (STAR, 'double wide = (rho + p->reach) * DYD_UP_FACTOR', 'double wide = rho + p->reach', 'constants', 'certify_edges'),
    (STAR, 'need + 8 * 0x1p-53', 'need + 2 * 0x1p-53', 'constants', 'c_star_hull'),
    (STAR, '2 * (largest + 3 * sk->reps.delta)', '2 * (largest + 2 * sk->reps.delta)', 'constants', 'z_star_three'),
    ('src/stream/expr_filter.c', 'if (b.lo <= 0 && b.hi >= 0)', 'if (b.lo < 0 && b.hi > 0)', 'constants', 'divide'),
    ('src/predicate/predicate_filter.c', 'i ? dyd_iv_sub(bl, root) : dyd_iv_add(bl, root)', 'dyd_iv_add(bl, root)', 'constants', 'point_and_line'),
    ('src/legal/star_filter.c', 'reach : 0x1p-300}', 'reach : 0x1p-500}', 'constants', 'c_near_floor'),
    ('src/skeleton/rects_filter.c', 'isnan(h) ? -INFINITY : h', 'isnan(h) ? INFINITY : h', 'constants', 'dyd_height_lower'),
    ('src/dyadic/sqrt_sign.c', 'if (nb - 3 >= na) return -1;', 'if (nb - 2 >= na) return -1;', 'constants', 'compare_squares'),
    ('src/predicate/circle.c', 'mpz_submul(out->a[k], out->b[k], out->t);', 'mpz_addmul(out->a[k], out->b[k], out->t);',
     'constants', 'point_and_line'),
    ('proofs/theories/FiltersConst.v', '(2281771080410813, -102)%Z', '(2281771080410812, -102)%Z', 'constants', 'c_incircle_bound'),
    ('proofs/SOUNDNESS.md', ', `legal/lp_filter`', '', 'constants', 'legal/lp_filter'),
    ('proofs/theories/FiltersStar.v', '(snd a + snd b) * lit c_star_half', '(snd a + snd b) * lit (1, -1)%Z', 'constants',
     'a double of its own'),
    ('proofs/theories/AreaDouble.v', 'lit c_inflate)%D).', 'b64_of_bits 42)%D).', 'constants', 'a double of its own'),
    ('proofs/definitions/areas.c', '{"two_sum", 2', '{"three_sum", 2', 'constants', 'two_sum: quoted in a theory, but neither run'),
    ('proofs/definitions/circles.c', '{"dyd_sqrt_sign", 3', '{"dyd_sqrt3_sign", 3', 'constants', 'dyd_sqrt3_sign: run by'),
    ('proofs/theories/Limits.v', 'Open Scope R_scope.', 'Open Scope R_scope.\n(* C src/rect/rect.c dyd_interval_init\n  x\n*)',
     'constants', 'dyd_interval_init: quoted in a theory, but neither run'),
    ('proofs/claims/filters.md', '`filter_incircle_at_correct`', '`filter_incircle_correct`', 'claims', 'filter_incircle_correct'),
    ('proofs/README.md', 'filter_orient_correct, ', '', 'claims', 'filter_orient_correct'),
    ('src/predicate/circle.h', '(mathematics: section 4)', '(mathematics: section 40)', 'citations', 'section 40'),
    ('include/dyadel/arc.h', 'sections 2, 3', 'sections 2, 9', 'citations', 'section 9 of KEL'),
    ('include/dyadel/rect.h', '(mathematics: section 1)', '(section 1)', 'citations', 'of what?'),
    ('tests/engine/test_outcomes.c', 'section 10, case 3', 'mathematics: section 10, case 30', 'citations', 'no item 30'),
    ('src/metric/measure_filter.c', 'Popescu 2017', 'Popescu 2018', 'citations', 'Popescu 2018'),
    ('src/stream/root.c', 'Abbott 2006', 'Abbot 2006', 'citations', 'Abbot 2006'),
    ('src/predicate/predicate_filter.c', 'predicate/circle.c', 'predicate/circles.c', 'citations', 'predicate/circles.c'),
    ('include/dyadel/compose.h', '(stream.h)', '(streams.h)', 'citations', 'streams.h in this folder'),
    ('proofs/mathematics.md', '## 9. Output', '## 8. Output', 'citations', 'used twice'),
    ('proofs/mathematics.md', '(#10-cases', '(#11-cases', 'citations', 'no such heading'),
    ('proofs/mathematics.md', '[ORI-1]: claims/predicate.md', '[ORI-1]: claims/possible.md', 'citations', '[ORI-1] is not stated'),
    ('src/README.md', '](../proofs/mathematics.md)', '](../proofs/mathematic.md)', 'citations', 'leads nowhere'),
    ('src/README.md', '`src/io/read/read.c`', '`src/io/read.c`', 'citations', 'there is no src/io/read.c'),
    ('src/README.md', '`dyd_read_points`', '`dyd_read_pionts`', 'citations', 'there is no dyd_read_pionts'),
    ('src/README.md', '  rect --> dyadic\n', '', 'map', 'rect --> dyadic'),
    ('src/README.md', '| `src/metric` |', '| `src/measure` |', 'map', 'metric is a room without a row'),
    ('src/dyadic/text.c', '#include "dyadic/raw.h"', '#include "rect/irect.h"', 'map', 'circle of folders: dyadic, rect'),
    ('src/rect/rect.c', '#include "rect/rect.h"\n', '#include "rect/rect.h"\nvoid f(void) {\n  dyd_sites_free(0);\n}\n',
     'map', 'circle of files: rect/rect.c, rect/sites.c'),
    ('src/python/dyadel/_arrays.py', 'import numpy as np\n', 'import numpy as np\nfrom ._triangulation import Delaunay\n',
     'map', 'circle of modules: python/dyadel/_arrays'),
    ('src/python/dyadel/_points.py', '    rows = list(points)\n', '    from . import _voronoi, _calls\n    rows = list(points)\n',
     'map', 'circle of modules: python/dyadel/_calls'),
    ('src/skeleton/skeleton.c', 'static int line_compare(', 'static int tied_compare(', 'sources', 'the name of one in'),
    ('src/packaging/LICENCES.md', '| `gdal` |', '| files |', 'sources', 'gdal has no licence'),
    ('src/skeleton/skeleton.c', '#include "rect/irect.h"', '#include "engine/wants.h"', 'sources', 'must not include'),
]
# file, text, its replacement (all occurrences), what renew_quotes.py says
CHANGES = [
    ('src/predicate/predicate_filter.c', 'det2', 'twice', 'names only (det2 -> twice)'),
    ('src/skeleton/mesh_filter.c', 'product(', 'fixed_product(', 'fixed_product of src/skeleton/mesh_filter.c: the place only'),
    ('src/skeleton/mesh_filter.c', 'r.low < a.low', 'r.low <= a.low', 'prove anew: fixed_incircle_correct, sum_correct'),
    ('src/metric/measure_filter.c', 'return two_sum(a, -b);', 'return two_sum(b, -a);', 'compare dd_sub_d'),
]


def run(root, script):
    """Exit status and the set of complaints of a script on root."""
    done = subprocess.run([sys.executable, str(root / f'tests/house/{script}.py'), str(root)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, set(done.stdout.splitlines())


def name_of(script):
    return script if script == 'sources' else f'check_{script}'


def batches():
    """Faults that one run of a script can be asked about: in different files, recognised by different words. Circles
    may join."""
    left = list(FAULTS)
    while left:
        batch = [left[0]]
        for fault in left[1:]:
            path, _, _, script, word = fault
            alike = script != batch[0][3] or script == 'map' or any(path == other[0] or word == other[4] for other in batch)
            if not alike:
                batch.append(fault)
        left = [fault for fault in left if fault not in batch]
        yield batch[0][3], batch


def unnoticed(root):
    before = {script: run(root, name_of(script))[1] for script in ('constants', 'claims', 'citations', 'map', 'sources')}
    for script, batch in batches():
        good = {path: (root / path).read_text(encoding='utf-8') for path, *_ in batch}
        for path, text, fault, *_ in batch:
            if text not in good[path]:
                yield f'{path}: "{text}" is not there any more'
            (root / path).write_text(good[path].replace(text, fault, 1), encoding='utf-8')
        status, said = run(root, name_of(script))
        for path, text in good.items():
            (root / path).write_text(text, encoding='utf-8')
        for path, text, fault, _, word in batch:
            new = sorted(line for line in said - before[script] if word in line)
            if status != 1 or not new:
                yield f'{path}: "{fault}" for "{text}" goes unnoticed by {name_of(script)}.py'
            else:
                print(f'noticed: {new[0]}')


def unrenewed(root):
    """Changes of the C source that the theories do not follow."""
    kept = root / 'kept'
    for name in ('theories', 'definitions'):
        shutil.copytree(root / 'proofs' / name, kept / name)
    before = run(root, 'check_constants')[1]
    for path, text, change, word in CHANGES:
        good = (root / path).read_text(encoding='utf-8')
        (root / path).write_text(good.replace(text, change), encoding='utf-8')
        noticed = run(root, 'check_constants')[1] - before
        said = '\n'.join(sorted(run(root, 'renew_quotes')[1]))
        left = run(root, 'check_constants')[1] - before
        (root / path).write_text(good, encoding='utf-8')
        shutil.copytree(kept, root / 'proofs', dirs_exist_ok=True)
        if text not in good or not noticed or left or word not in said:
            yield f'{path}: "{change}" for "{text}" is not renewed: {said} {left or ""}'
        else:
            print(f'renewed: {path}: {word}')


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name in ('src', 'include', 'proofs', 'tests'):
            shutil.copytree(source / name, root / name, ignore=shutil.ignore_patterns('data', '__pycache__'))
        found = list(unnoticed(root)) + list(unrenewed(root))
    print('\n'.join(found) or f'{len(FAULTS)} faults, all noticed; {len(CHANGES)} changes, all renewed')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
