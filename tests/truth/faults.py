#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tries the truth harness: faults.py PROJECT COMMAND [--minutes M] [NUMBER...]

Each fault is a small change of the sources, made in a copy of the project and built. The harness has to refute a case
that it does not refute of COMMAND, built from PROJECT as it is. Rows are drawn from the part of the product that `where`
names; the table shows how many of all rows that part has."""
import argparse
import itertools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
GLOBE, DISCS, PLANE = 'geometry=sphere', 'geometry=discs', 'geometry=plane'
FAULTS = [  # where it shows, file, what stands there, what is put there
    (GLOBE, 'sphere/places.c', 'is_point(sites, i) || mpq_sgn(s->degrees) ||', 'is_point(sites, i) ||'),  # degrees ignored
    (GLOBE, 'sphere/places.c', 'mpq_add(out, out, s->angle);', 'if (!mpq_sgn(out)) mpq_add(out, out, s->angle), mpq_div_2exp(out, out, 1);'),
    (GLOBE, 'sphere/places.c', 'if (mpq_cmp_si(x, 180, 1) < 0 &&', 'if (mpq_cmp_si(x, 400, 1) < 0 &&'),
    (GLOBE, 'sphere/units.c', '{"arcmin", "arcminute", NULL, false, 1, 60}', '{"arcmin", "arcminute", NULL, false, 1, 3600}'),
    (GLOBE, 'sphere/units.c', '{"ft", "feet", "foot", true, 381, 1250}', '{"ft", "feet", "foot", true, 38, 1250}'),
    (GLOBE, 'sphere/units.c', 'true, 1000, 1}', 'true, 100, 1}'),
    (GLOBE, 'sphere/units.c', '{"cm", "centimeter", "centimetre", true, 1, 100}', '{"cm", "centimeter", "centimetre", true, 1, 1000}'),
    (GLOBE, 'sphere/units.c', 'if (!own) own = unit;', 'if (unit) own = &units[6];'),
    (GLOBE, 'sphere/places.c', 'mpq_sub(lo, lo, more);\n    mpq_add(hi, hi, more);\n  }\n  return', 'mpq_add(hi, hi, more);\n  }\n  return'),
    (GLOBE, 'sphere/places.c', 'mpq_set_si(s->half[0], pole ? 0 : 180, 1);', 'mpq_set_si(s->half[0], pole ? 0 : 90, 1);'),
    (GLOBE, 'sphere/places.c', 'arb_div(a, a, f, 64);', 'arb_mul(a, a, f, 64);'),
    (GLOBE, 'sphere/project.c', 'if (!way) mag_addmul(off, more, &p->half[k]);', 'if (!way && k) mag_addmul(off, more, &p->half[k]);'),
    (GLOBE, 'sphere/project.c', 'arb_mul_si(g->number, g->size, side, g->prec);', 'arb_mul_si(g->number, g->size, 1, g->prec);'),
    (GLOBE, 'sphere/project.c', 'arb_addmul_si(at + k, g->slope, way * side, g->prec);', 'arb_addmul_si(at + k, g->slope, way, g->prec);'),
    (GLOBE, 'sphere/nearest_filter.c', 'if (quarter == 1 || quarter == 2) *c', 'if (quarter == 1) *c'),
    (GLOBE, 'sphere/nearest_filter.c', 'double wide = MORE_THAN_DEGREE * (x.hi - x.lo)', 'double wide = 0.1 * MORE_THAN_DEGREE * (x.hi - x.lo)'),
    (GLOBE, 'sphere/sphere.c', 'if (in[face.item[k]] != IN_OPEN) in[face.item[k]] = tie ? IN_TIE : IN_OPEN;', 'in[face.item[k]] = IN_TIE;'),
    (GLOBE, 'sphere/sphere.c', 'for (size_t k = 0; k < sure->count; k++) status[sure->item[k]] = DYD_LEGAL;',
     'for (size_t k = 0; k < possible->count; k++) status[possible->item[k]] = DYD_LEGAL;'),
    (GLOBE + ' stated=vertices', 'sphere/vertex.c', 'arb_submul(n + k, v + 3 + m, v + 6 + l, PREC);', 'arb_addmul(n + k, v + 3 + m, v + 6 + l, PREC);'),
    (GLOBE + ' stated=vertices', 'sphere/vertex.c', 'half_turns(u, spot->mid[1], spot->half[1], f->at[1]);', 'half_turns(u, spot->mid[1], spot->half[0], f->at[1]);'),
    (DISCS, 'tolerance/caps.c', '(sign < 0 ? mpq_sub : mpq_add)(s, a->r, b->r);', '(sign < 0 ? mpq_sub : mpq_sub)(s, a->r, b->r);'),
    (DISCS, 'tolerance/caps.c', 'if (inside < 0 || (inside == 0 &&', 'if ((inside == 0 &&'),
    (DISCS, 'tolerance/caps.c', 'end_against(c, &c->item[e], turn, u, p) > 0) return', 'end_against(c, &c->item[e], turn, u, p) < 0) return'),
    (DISCS, 'tolerance/caps_filter.c', 'relative_disc(c->at, k->disc, -1);', 'relative_disc(c->at, k->disc, 1);'),
    ('stated=rho', 'tolerance/points_filter.c', 'double now = radius_now(radius), least = r > 0 ? r * (1 - 4 * U) : 0;',
     'double now = radius_now(radius), least = r > 0 ? r * 1.2 : 0;'),
    ('stated=rho', 'tolerance/points_filter.c', 'gap_of(&p->lines, &line, p->ring) - p->ring->half;', 'gap_of(&p->lines, &line, p->ring);'),
    ('stated=tolerance', 'tolerance/rows.c', 'dyd_roots_half(&lo, &hi, s->plus, s->minus);', 'dyd_roots_half(&lo, &hi, s->plus, s->minus), lo *= 1.0001, hi *= 1.0001;'),
    ('stated=tolerance', 'tolerance/lines.c', '<= 0)\n', '>= 0)\n'),
    ('stated=plan', 'tolerance/survey_choose.c', '*holds = st == DYD_OK && s->result.left <= before;', '*holds = st == DYD_OK;'),
    ('stated=plan', 'tolerance/survey_choose.c', 'return dyd_q_brief(a);', 'return 1.5 * dyd_q_brief(a);'),
    ('stated=graph nearest', 'graph/graph_filter.c', 'dyd_dl2_upper(a, &w->box[w->other[q]]) < dyd_ds2_lower(a, b))', 'dyd_ds2_upper(a, &w->box[w->other[q]], 0) < dyd_ds2_lower(a, b))'),
    ('stated=graph gabriel', 'graph/graph_filter.c', 'double least = 0.25 * dyd_ds2_lower(a, b), most', 'double least = 0.5 * dyd_ds2_lower(a, b), most'),
    ('stated=graph mst', 'graph/graph.c', 'length_compare(&s->largest[next], &s->least[q]) < 0', 'length_compare(&s->least[next], &s->least[q]) < 0'),
    ('stated=graph nearest', 'graph/graph.c', 'c < 4; c++) {\n    mpz_srcptr x = dyd_irect_end(&r->grid[0]', 'c < 1; c++) {\n    mpz_srcptr x = dyd_irect_end(&r->grid[0]'),
    ('stated=nearest', 'voronoi/nearest.c', 'if (mpq_cmp(d, least) <= 0) q->vertex', 'if (mpq_cmp(d, least) < 0 || k == 0) q->vertex'),
    ('stated=vertices ' + PLANE, 'voronoi/vertex.c', 'dyd_sites_get(&r[k], sites, corner[k])', 'dyd_sites_get(&r[k], sites, corner[k ? k : 1])'),
    (PLANE, 'io/read/coordinate.c', '.plain = {middle - by[0] - by[1], exp}', '.plain = {middle - by[0], exp}'),
    (PLANE, 'io/read/coordinate.c', 'lo = sum_towards(lo, -by, DYD_DOWN);', 'lo = sum_towards(lo, -0.9 * by, DYD_DOWN);'),
    (PLANE, 'io/read/coordinate.c', 'if (error * (double)dir < 0) near', 'if (error * (double)dir > 0) near'),
    ('stated=cells ' + PLANE, 'io/layers_voronoi.c', 'dyd_row_decimal(t, row->area[0], DYD_DOWN);', 'dyd_row_decimal(t, row->area[0] * 1.02, DYD_DOWN);'),
    ('kind=sigma', 'io/read/twins.c', 'mpz_mul_ui(mpq_numref(q), mpq_numref(q), n);', 'mpz_mul_ui(mpq_numref(q), mpq_numref(q), n ? 1 : n);'),
]


def run(argv, **more):
    return subprocess.run(argv, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **more)


def run_for(argv, most):
    """The output, None where it takes more than `most` seconds of the processor; and how many it took: a loaded machine
    takes longer by the clock."""
    with tempfile.TemporaryFile('w+') as out, subprocess.Popen(argv, stdout=out, stderr=subprocess.STDOUT) as p:
        used = 0
        while p.poll() is None:
            time.sleep(1)
            with open(f'/proc/{p.pid}/stat', encoding='ascii') as file:
                used = sum(map(int, file.read().rsplit(')', 1)[1].split()[11:15])) / os.sysconf('SC_CLK_TCK')
            if used > most:
                p.kill()
                return None, used
        out.seek(0)
        return out.read(), used


def share(command, where):
    """The part of random rows that `where` names."""
    sys.path.insert(0, HERE)
    import truth
    space = truth.Space(command, None, None, None)
    want = dict(w.split('=') for w in where)
    rows = list(itertools.islice(truth.random_rows(space, 1), 1000))
    return sum(all(r[a] == v for a, v in want.items()) for r in rows) / len(rows)


def wanted(where):
    """'stated=graph mst geometry=plane' -> its conditions."""
    return re.findall(r'\w+=.*?(?= \w+=|$)', where)


def attempt(number, fault, copy, a):
    where, name, old, new = fault
    path = os.path.join(copy, 'src', name)
    with open(path, encoding='utf-8') as file:
        text = file.read()
    if text.count(old) < 1:
        return 'the sources have changed: the text to be replaced is not there'
    try:
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text.replace(old, new, 1))
        built = run(['ninja', '-C', copy + '/build', 'src/cli/dyadel'])
        if built.returncode:
            return 'does not compile: ' + next((l for l in built.stdout.splitlines() if 'error' in l), '')[:150]
        argv = [sys.executable, os.path.join(HERE, 'truth.py'), copy + '/build/src/cli/dyadel', '--against', a.command, '--stop', '1',
                '--seed', str(1000 + number), '--cases', '1000000', '--limit', '10']
        for w in wanted(where):
            argv += ['--where', w]
        out, used = run_for(argv, 60 * a.minutes)
        if out is None:
            return f'not noticed within {a.minutes} minutes of the processor'
        m = re.search(r'noticed by case (\d+), the (\d+)th: (.*)', out)
        if not m:
            return 'not noticed: ' + out.strip()[-200:]
        return f'{int(m[2])} cases, {used:.0f} s: {m[3][:110]}'
    finally:
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)


def main():
    p = argparse.ArgumentParser()
    p.add_argument('project')
    p.add_argument('command')
    p.add_argument('numbers', nargs='*', type=int)
    p.add_argument('--minutes', type=float, default=10, help='of the processor')
    a = p.parse_args()
    copy, missed = tempfile.mkdtemp(prefix='faults-'), 0
    try:
        run(['git', 'clone', '-q', a.project, copy + '/p'])
        copy_of = copy + '/p'
        run(['meson', 'setup', '-Dtests=disabled', '-Dproofs=disabled', copy_of + '/build', copy_of])
        print('| fault | file | rows drawn from | part of all rows | noticed after |\n|---|---|---|---|---|', flush=True)
        for number, fault in enumerate(FAULTS):
            if a.numbers and number not in a.numbers:
                continue
            said = attempt(number, fault, copy_of, a)
            missed += not re.match(r'\d', said)
            print(f'| {number} | {fault[1]} | {fault[0]} | {share(a.command, wanted(fault[0])):.1%} | {said} |', flush=True)
    finally:
        shutil.rmtree(copy, ignore_errors=True)
    print(f'{missed} not noticed')
    return missed > 0


if __name__ == '__main__':
    sys.exit(main())
