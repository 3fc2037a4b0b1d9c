#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faults seeded into the checker of certificates are noticed [CERT-1] [CERT-2] [CERT-3] [CERT-4] [CERT-5] [CERT-6]
[CERT-7] [CERT-8] [CERT-9] [CERT-11] [CERT-12] [CERT-13] [CERT-14].

Usage: test_seeded.py CC ROOT LIBRARY [COUNT SEED FILE...]   (exit status 1 when a fault goes unnoticed)

circles.txt has places on one circle, or not; forgeries*.txt certificates, each with its verdict: rejected, or accepted
with a list of gaps. Most are one step from a good one, counts put right. The checker has to give these verdicts; a copy
of one of its sources with a fault (a check removed or weakened, a < made <= at a tie), linked with the rest from
LIBRARY, must give another one. Each fault replaces a text, which must occur once. SURVIVORS change nothing that could
be noticed, for the reason given. With COUNT, that number of faults are drawn at random in these sources instead, as by
tests/support/mutants.py, which continues with the survivors.
"""
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

FAULTS = [
    ('chain.c', 'bool good = dyd_cert_fraction_cmp(&own, &other) < 0;', 'bool good = dyd_cert_fraction_cmp(&own, &other) <= 0;'),
    ('chain.c', 'bool good = dyd_cert_fraction_cmp(&own, &other) < 0;', 'bool good = true;'),
    ('chain.c', 'good = good && dyd_cert_fraction_cmp(&own, &other) < 0;',
     'good = good && dyd_cert_fraction_cmp(&own, &other) <= 0;'),
    ('chain.c', '  good = good && dyd_cert_fraction_cmp(&own, &other) < 0;\n', ''),
    ('chain.c', 'return dyd_cert_compare_heights(s, u, i, k) < 0 && ', 'return '),
    ('chain.c', ' && dyd_cert_compare_heights(s, u, j, k) < 0;', ';'),
    ('chain.c', 'dyd_cert_compare_heights(s, u, i, k) < 0', 'dyd_cert_compare_heights(s, u, i, k) <= 0'),
    ('chain.c', 'dyd_cert_compare_heights(s, u, j, k) < 0', 'dyd_cert_compare_heights(s, u, j, k) <= 0'),
    ('chain.c', '    if (!blocker_is_nearer(s, c->point[q], c->blocker[q], i, j) ||\n        !blocker_is_nearer(s, c->point[q], c->blocker[q + 1], i, j))',
     '    if (!blocker_is_nearer(s, c->point[q], c->blocker[q], i, j))'),
    ('chain.c', '    if (!blocker_is_nearer(s, c->point[q], c->blocker[q], i, j) ||\n        !blocker_is_nearer(s, c->point[q], c->blocker[q + 1], i, j))',
     '    if (!blocker_is_nearer(s, c->point[q], c->blocker[q + 1], i, j))'),
    ('chain.c', 'for (size_t q = 0; q < c->points; q++)\n    if (!blocker',
     'for (size_t q = 1; q < c->points; q++)\n    if (!blocker'),
    ('chain.c', 'for (size_t q = 0; q < c->points; q++)\n    if (!blocker',
     'for (size_t q = 0; q + 1 < c->points; q++)\n    if (!blocker'),
    ('chain.c', 'return blocker_is_farther_out(s, c->u[0], c->blocker[0], i, j) &&\n         ', 'return '),
    ('chain.c', 'return blocker_is_farther_out(s, c->u[0], c->blocker[0], i, j) &&\n         blocker_is_farther_out(s, c->u[1], c->blocker[c->points], i, j);',
     'return blocker_is_farther_out(s, c->u[0], c->blocker[0], i, j);'),
    ('chain.c', 'blocker_is_farther_out(s, c->u[1], c->blocker[c->points], i, j)',
     'blocker_is_farther_out(s, c->u[1], c->blocker[0], i, j)'),
    ('chain.c', 'bool crosses = end && end != here && segment_is_met(p, q, at, origin, way);',
     'bool crosses = end && end != here;'),
    ('chain.c', 'bool crosses = end && end != here && segment', 'bool crosses = end && segment'),
    ('chain.c', 'return chain_side(p, q, from) != chain_side(p, q, to) && segment', 'return segment'),
    ('chain.c', 'return c->points > 0 && chain_is_blocked(c, s, i, j) && chain_separates(c, s, i, j);',
     'return c->points > 0 && chain_is_blocked(c, s, i, j);'),
    ('chain.c', 'return c->points > 0 && chain_is_blocked(c, s, i, j) && chain_separates(c, s, i, j);',
     'return c->points > 0 && chain_separates(c, s, i, j);'),
    ('chain.c', '!= ray_crosses(p, q, c->point[c->points - 1], c->u[1]);', ';'),
    ('chain.c', 'k + 1 < c->points; k++) odd ^=', 'k + 2 < c->points; k++) odd ^='),
    ('cocircular.c', 'return mpz_cmp_ui(mpq_denref(q), 1) == 0 && ', 'return '),
    ('cocircular.c', ' || !mpq_equal(c->mid[1], d->mid[1])) return false;', ') return false;'),
    ('cocircular.c', 'is_multiple(turn, 360)', 'is_multiple(turn, 180)'),
    ('cocircular.c', '  mpq_sub(turn, turn, d->mid[0]);\n', ''),
    ('cocircular.c', 'k < 4; k++) all = all && mpq_equal', 'k < 3; k++) all = all && mpq_equal'),
    ('cocircular.c', 'all = all && is_multiple(turn, 180);', 'all = is_multiple(turn, 180);'),
    ('cocircular.c', 'chords_are_mirrored(at[0], at[2], at[1], at[3])', 'false'),
    ('cocircular.c', '(k < 3 ? dyd_cert_enclosure_add : dyd_cert_enclosure_sub)(out, &t);', 'dyd_cert_enclosure_add(out, &t);'),
    ('cocircular.c', 'dyd_cert_enclosure_sub(&v[k][a], &v[0][a]);', 'dyd_cert_enclosure_sub(&v[k][a], &v[1][a]);'),
    ('cocircular.c', 'dyd_cert_enclosure_set(&v[2], &lat.s);', 'dyd_cert_enclosure_set(&v[2], &lon.s);'),
    ('cocircular.c', 'return is_below(&det, p - bits);', 'return is_below(&det, p);'),
    ('witness.c', 'if (dyd_cert_fraction_cmp(&s->radius2, &s->here) < 0) return true;',
     'if (dyd_cert_fraction_cmp(&s->radius2, &s->here) <= 0) return true;'),
    ('witness.c', '  if (dyd_cert_fraction_cmp(&q.here, &q.radius2) > 0) dyd_cert_fraction_swap(&q.here, &q.radius2);\n', ''),
    ('witness.c', 'if (k == s->i || k == s->j) return true;', 'if (k == s->i || k == s->j || k == 0) return true;'),
    ('witness.c', 'limit = a > b ? a : b;', 'limit = a < b ? a : b;'),
    ('witness.c', 'own = places ? DYD_CERT_PLACE : DYD_CERT_FAR;', 'own = places ? DYD_CERT_PLACE : DYD_CERT_NEAR;'),
    ('witness.c', '.measure = places ? DYD_CERT_PLACE : DYD_CERT_NEAR}',
     '.measure = places ? DYD_CERT_PLACE : DYD_CERT_FAR}'),
    ('faces.c', 'dyd_cert_compare_heights(s, corner->u, p->site[q], corner->i) >= 0) return false;',
     'dyd_cert_compare_heights(s, corner->u, p->site[q], corner->i) > 0) return false;'),
    ('faces.c', 'if (!corner_is_beyond(s, c, p, after) || (before != after && !corner_is_beyond(s, c, p, before))) *bad',
     'if (before != after && !corner_is_beyond(s, c, p, before)) *bad'),
    ('faces.c', ' || (before != after && !corner_is_beyond(s, c, p, before))) *bad', ') *bad'),
    ('faces.c', 'if (times[corner[c].i] != 1 || !hull[corner[c].i]) *bad', 'if (times[corner[c].i] != 1) *bad'),
    ('faces.c', 'if (times[corner[c].i] != 1 || !hull[corner[c].i]) *bad', 'if (!hull[corner[c].i]) *bad'),
    ('faces.c', 'if (count < 2 || (count == 2 && dyd_cert_edges_have(g->legal, to[0], to[1]))) return DYD_OK;',
     'if (count <= 2) return DYD_OK;'),
    ('faces.c', 'if (count == 3)', 'if (count <= 4)'),
    ('faces.c', '    if (corners) *bad = corner[0].i;\n', ''),
    ('faces.c', 'f->inexact[k] |= ', 'f->inexact[k] &= '),
    ('parts.c', 'if (h / 2 >= m->g->legal->count && twin != DYD_CERT_NONE)', 'if (false)'),
    ('parts.c', 'if (h / 2 >= m->g->legal->count && twin != DYD_CERT_NONE)', 'if (twin != DYD_CERT_NONE)'),
    ('parts.c', '    if (m->corner[next]) m->entry[entries++] = (dyd_cert_entry){p->group[q], next};\n', ''),
    ('graph.c', 'g->redundant |= a == b && e >= g->legal->count;', ''),
    ('graph.c', 'g->connected = parts <= 1 && have_directions(g);', 'g->connected = have_directions(g);'),
    ('ties.c', '*out += dyd_cert_root(parent, i) != dyd_cert_root(parent, of);', ''),
    ('checker.c', 'if (c->sites.site[*out].alias != *out) return', 'if (false) return'),
    ('checker.c', 'if (next.i >= next.j) return', 'if (next.i > next.j) return'),
    ('checker.c', '(next.i == pair->i && next.j <= pair->j))', '(next.i == pair->i && next.j < pair->j))'),
    ('checker.c', 'if (next.i < pair->i || (next', 'if ((next'),
    ('checker.c', 'if (st == DYD_OK && !first && *i <= last)', 'if (st == DYD_OK && !first && *i < last)'),
    ('checker.c', 'c->reached = dyd_exact_cmp(bound, &most) <= 0;', 'c->reached = true;'),
    ('checker.c', 'c->reached = dyd_exact_cmp(bound, &most) <= 0;', 'c->reached = dyd_exact_cmp(bound, &most) < 0;'),
    ('checker.c', 'if (!side_holds_value(&site->side[0], &c->point[0]) || !side_holds_value(&site->side[1], &c->point[1]))',
     'if (!side_holds_value(&site->side[0], &c->point[0]))'),
    ('checker.c', 'if (!side_holds_value(&site->side[0], &c->point[0]) || !side_holds_value(&site->side[1], &c->point[1]))',
     'if (!side_holds_value(&site->side[1], &c->point[1]))'),
    ('checker.c', 'return dyd_exact_cmp(v, &s->lo) >= 0 && dyd_exact_cmp', 'return dyd_exact_cmp'),
    ('checker.c', 'dyd_exact_cmp(v, dyd_cert_high(s)) <= 0;', 'dyd_exact_cmp(v, &s->hi) <= 0 || s->point;'),
    ('checker.c', 'if (!dyd_cert_is_witness(&other, &c->sites, &c->tree, pair->i, pair->j, c->point, places))',
     'if (!places && !dyd_cert_is_witness(&other, &c->sites, &c->tree, pair->i, pair->j, c->point, places))'),
    ('checker.c', 'if (!dyd_cert_is_witness(&other, &c->sites, &c->tree, pair->i, pair->j, c->point, places))',
     'if (places && !dyd_cert_is_witness(&other, &c->sites, &c->tree, pair->i, pair->j, c->point, places))'),
    ('checker.c', 'if (bad != DYD_CERT_NONE) return', 'if (false) return'),
    ('pairs.c', 'if (dyd_cert_edges_have(&c->legal, pair->i, pair->j)) return', 'if (false) return'),
    ('certificate.c', 'c->report.ties_unproved += !dyd_cert_faces_tied(&c->faces, c->tie.item[q].i, c->tie.item[q].j);', ''),
    ('certificate.c', '!dyd_cert_faces_tied(&c->faces, c->tie.item[q].i, c->tie.item[q].j);',
     '!dyd_cert_is_point(&c->sites.site[c->tie.item[q].i]);'),
    ('certificate.c', '!dyd_cert_faces_tied(&c->faces, c->tie', '!dyd_cert_faces_still(&c->faces, c->tie'),
    ('faces.c', 'if (f->inexact[k] || f->shape[k] == DYD_CERT_ANY)', 'if (f->inexact[k])'),
    ('faces.c', 'if (f->inexact[k] || f->shape[k] == DYD_CERT_ANY)', 'if (f->shape[k] == DYD_CERT_ANY)'),
    ('faces.c', '? dyd_cert_on_circle(s, site, count) : dyd_cert_on_line(s, site, count);', '? dyd_cert_on_circle(s, site, count) : true;'),
    ('faces.c', '? dyd_cert_on_circle(s, site, count) : dyd_cert_on_line(s, site, count);', '? dyd_cert_on_circle(s, site, count) : false;'),
    ('faces.c', '? dyd_cert_on_circle(s, site, count) : dyd_cert_on_line(s, site, count);', '? true : dyd_cert_on_line(s, site, count);'),
    ('faces.c', '? dyd_cert_on_circle(s, site, count) : dyd_cert_on_line(s, site, count);', '? false : dyd_cert_on_line(s, site, count);'),
    ('faces.c', 'k < f->sets && st == DYD_OK; k++) f->tied[k] =', 'k + 1 < f->sets && st == DYD_OK; k++) f->tied[k] ='),
    ('faces.c', 'if (f->tied[k]) return true;\n  return false;', 'if (!f->tied[k]) return false;\n  return true;'),
    ('faces.c', '    if (f->tied[k]) return true;\n', '    if (f->tied[k] || !f->inexact[k]) return true;\n'),
    ('faces.c', '    if (f->inexact[k]) return false;\n', ''),
    ('fixpoint.c', 'if (!dyd_cert_faces_tied(&c->faces, p->i, p->j) && !dyd', 'if (!dyd'),
    ('fixpoint.c', '!dyd_cert_faces_still(&c->faces, p->i, p->j) &&\n        ', ''),
    ('measure.c', 'for (size_t q = 2; q < count; q++)', 'for (size_t q = 3; q < count; q++)'),
    ('measure.c', 'for (size_t q = 2; q < count; q++)', 'for (size_t q = 2; q + 1 < count; q++)'),
    ('measure.c', 'for (size_t q = 3; q < count && all; q++)', 'for (size_t q = 4; q < count && all; q++)'),
    ('measure.c', 'for (size_t q = 3; q < count && all; q++)', 'for (size_t q = 3; q + 1 < count && all; q++)'),
    ('measure.c', 'for (size_t q = 3; q < count && all; q++)', 'for (size_t q = 3; q < count; q++)'),
    ('measure.c', 'spot_difference(&v->y, from, to, 1);', 'spot_difference(&v->y, from, to, 0);'),
    ('measure.c', '  dyd_cert_fraction_add(&v->square, &v->square, &t);\n', ''),
    ('measure.c', '  mpz_neg(t.num.man, t.num.man);\n', ''),
    ('measure.c', 'dyd_cert_fraction_mul(out, a, d);', 'dyd_cert_fraction_mul(out, a, c);'),
    ('measure.c', 'fraction_cross(&out->x, &v->y, &v->square, &w->y, &w->square);', 'fraction_cross(&out->x, &v->y, &v->x, &w->y, &w->x);'),
    ('measure.c', 'fraction_cross(&out->y, &v->square, &v->x, &w->square, &w->x);', 'fraction_cross(&out->y, &v->x, &v->square, &w->x, &w->square);'),
    ('measure.c', 'dyd_cert_fraction_mul(&t, &v->y, &w->y);\n  dyd_cert_fraction_add(&sum, &sum, &t);', ''),
    ('measure.c', 'dyd_cert_fraction_mul(&t, &v->square, &w->square);\n  dyd_cert_fraction_add(&sum, &sum, &t);', ''),
    ('measure.c', 'dyd_cert_fraction_mul(&sum, &v->x, &w->x);', 'dyd_cert_fraction_mul(&sum, &v->x, &w->y);'),
    ('measure.c', 'bool orthogonal = dyd_exact_sgn(&sum.num) == 0;', 'bool orthogonal = dyd_exact_sgn(&sum.num) >= 0;'),
    ('measure.c', 'bool orthogonal = dyd_exact_sgn(&sum.num) == 0;', 'bool orthogonal = dyd_exact_sgn(&sum.num) <= 0;'),
    ('pairs.c', 'if (triangles < 0 || (uint64_t)triangles != c->faces.triangles)', 'if (false)'),
    ('pairs.c', 'if (unproved < 0 || (uint64_t)unproved != c->report.unproved)', 'if (false)'),
    ('pairs.c', 'if (c->report.capped && (present[0] || present[1])) return', 'if (false) return'),
    ('pairs.c', 'if (!area) return', 'if (false) return'),
    ('pairs.c', 'if (exceeded) return', 'if (false) return'),
    ('pairs.c', 'if (present[1] && dyd_exact_sgn(&bound[1]) < 0) exceeded = true;', ''),
    ('pairs.c', 'for (size_t e = 0; e < c->open.count; e++)\n', 'for (size_t e = 1; e < c->open.count; e++)\n'),
    ('pairs.c', 'dyd_cert_bounds_add(b, &c->sites, c->open.item[e].i, c->open.item[e].j, false);',
     'dyd_cert_bounds_add(b, &c->sites, c->open.item[e].i, c->open.item[e].j, true);'),
    ('bounds.c', 'if (dyd_cert_fraction_cmp(&t, out) > 0) dyd_cert_fraction_swap(&t, out);\n  dyd_cert_fraction_clear(&t);\n}\n\n/* man',
     'dyd_cert_fraction_clear(&t);\n}\n\n/* man'),
    ('bounds.c', 'if (sx && sx == -sy) {', 'if (sx && sy) {'),
    ('bounds.c', 'area.num.exp++;', ''),
    ('bounds.c', 'fits = dyd_cert_fraction_cmp(&d, &l) <= 0;', 'fits = dyd_cert_fraction_cmp(&d, &l) < 0;'),
    ('bounds.c', 'dyd_sqrt2_sign(one[0], minus, one[1], twice, one[2]) >= 0;',
     'dyd_sqrt2_sign(one[0], minus, one[1], twice, one[2]) > 0;'),
    ('bounds.c', 'mpz_init_set_si(twice, -2);', 'mpz_init_set_si(twice, -1);'),
    ('bounds.c', 'bool holds = dyd_exact_cmp(&b->area2.num, &twice) <= 0;',
     'bool holds = dyd_exact_cmp(&b->area2.num, &twice) < 0;'),
    ('certificate.c', 'if (strcmp(r->outcome, "decided") == 0 && open)', 'if (false)'),
    ('certificate.c', 'if (strcmp(r->outcome, "certified") == 0 && !c->reached)', 'if (false)'),
    ('certificate.c', 'bool complete = !r->unproved && !r->capped &&', 'bool complete ='),
    ('certificate.c', 'if (r->legal_unproved) r->gaps |= DYD_GAP_LEGAL;', ''),
    ('certificate.c', 'if (r->unproved && !r->capped) r->gaps |= DYD_GAP_ILLEGAL;', ''),
    ('certificate.c', 'if (r->ties_unproved) r->gaps |= DYD_GAP_TIES;', ''),
    ('certificate.c', 'if (r->aliases_unproved) r->gaps |= DYD_GAP_ALIASES;', ''),
    ('certificate.c', 'if (r->unproved && (r->area || r->hausdorff)) r->gaps |= DYD_GAP_BOUNDS;', ''),
    ('certificate.c', 'if (r->distance && !r->distance_proved) r->gaps |= DYD_GAP_DISTANCE;', ''),
    ('fixpoint.c', 'm.movable[sites->site[i].alias] = true;', ''),
    ('fixpoint.c', 'all = false;', ''),
    ('boxes.c', 'blocked = blocked && b[q].far[k] < near[k];', 'blocked = blocked && b[q].far[k] <= near[k];'),
    ('boxes.c', 'blocked = blocked && b[q].far[k] < near[k];', 'blocked = blocked && (k || b[q].far[k] < near[k]);'),
    ('boxes.c', 'if (blocked) return true;', ''),
    ('boxes.c', 'sum += dyd_cert_square(left > right ? left : right);',
     'sum += dyd_cert_square(left < right ? left : right);'),
    ('boxes.c', 'right = c[a] - b->e[2 * a + 1], d =', 'right = c[a] - b->e[2 * a], d ='),
    ('boxes.c', 'square_region(&r, MIDDLE - HALF, MIDDLE - HALF, 2 * HALF);',
     'square_region(&r, MIDDLE - HALF, MIDDLE - HALF, HALF);'),
    ('boxes.c', 'h < LAST && st == DYD_OK; h *= 2)', 'h < HALF && st == DYD_OK; h *= 2)'),
    ('boxes.c', 'if (st == DYD_OK) st = keep_outer_sites(s, &count);', 'count = 0;'),
    ('boxes.c', 'for (int k = 0; k < r->corners && st == DYD_OK; k++) {', 'for (int k = 1; k < r->corners && st == DYD_OK; k++) {'),
    ('boxes.c', 'for (int k = 0; k < r->corners && st == DYD_OK; k++) {',
     'for (int k = 0; k + 1 < r->corners && st == DYD_OK; k++) {'),
    ('boxes.c', 'if (!cut || s->given_up)\n    st = add_left(s, at, kept);', 'if (!cut || s->given_up)\n    st = DYD_OK;'),
    ('boxes.c', 'if (s->stamp[s->pair[q].i] == s->now && s->stamp[s->pair[q].j] == s->now)', 'if (false)'),
    ('boxes.c', 'entry[count].item = p->j;', 'entry[count].item = p->i;'),
    ('by_key.c', 'size_t at = --start[entry[k].key];', 'size_t at = --start[entry[k].item % keys];'),
    ('by_key.c', 'for (size_t k = count; k-- > 0;) {', 'for (size_t k = count; k-- > 1;) {'),
    ('boxes.c', 'if (x % 3 && y % 3) continue;', 'if (x % 3 || y % 3) continue;'),
    ('pairs.c', 'if (stated < 0 || (uint64_t)stated != c->report.illegal_boxes)', 'if (false)'),
    ('diagram.c', 'if (dyd_cert_cross(polygon_spot(p, k), polygon_spot(p, k + 1), polygon_spot(p, k + 1), polygon_spot(p, k + 2)) <= 0)',
     'if (dyd_cert_cross(polygon_spot(p, k), polygon_spot(p, k + 1), polygon_spot(p, k + 1), polygon_spot(p, k + 2)) < 0)'),
    ('diagram.c', 'return begins == 1;', 'return begins > 0;'),
    ('diagram.c', 'if (!dyd_cert_window_has(w, c->chain.point[k]))', 'if (false)'),
    ('diagram.c', 'dyd_exact_cmp(&at[a], &w->e[2 * a + 1]) > 0) return false;', 'false) return false;'),
    ('diagram.c', 'if (!dyd_cert_is_witness(&other, &c->sites, &c->tree, i, i, at, false) &&',
     'if (k && !dyd_cert_is_witness(&other, &c->sites, &c->tree, i, i, at, false) &&'),
    ('diagram.c', '!(c->disc && dyd_cert_is_disc_witness(&other, &c->sites, &c->tree, c->disc, i, i, at))', '!c->disc'),
    ('diagram.c', 'if (st == DYD_OK && q && i <= last)', 'if (st == DYD_OK && q && i < last)'),
    ('diagram.c', 'if (dyd_exact_cmp(area2, &all) < 0) st', 'if (false) st'),
    ('diagram.c', 'area2->exp--;', ''),
    ('diagram.c', 'if (dyd_exact_cmp(&w->e[0], &w->e[1]) >= 0 || dyd_exact_cmp(&w->e[2], &w->e[3]) >= 0)',
     'if (dyd_exact_cmp(&w->e[0], &w->e[1]) >= 0)'),
    ('diagram.c', 'if (!holds) st = ', 'if (false) st = '),
    ('distance.c', 'if (a->endless) return false;', 'if (a->endless) return true;'),
    ('distance.c', 'if (near[k] && near[l]) continue;', 'if (near[k] || near[l]) continue;'),
    ('distance.c', 'if (near[k] && near[l]) continue;', 'if (near[k]) continue;'),
    ('distance.c', 'if (near[k] && near[l]) continue;', 'if (near[l]) continue;'),
    ('distance.c', 'for (size_t l = 0; l < k; l++) {', 'for (size_t l = 1; l < k; l++) {'),
    ('distance.c', 'for (int k = 0; k < 4; k++) {\n    grid_box part',
     'for (int k = 1; k < 4; k++) {\n    grid_box part'),
    ('distance.c', 'for (int k = 0; k < 4; k++) {\n    grid_box part',
     'for (int k = 0; k < 3; k++) {\n    grid_box part'),
    ('distance.c', 'for (int k = 0; k < 4; k++) {\n    grid_box part',
     'for (int k = 0; k < 4; k += k ? 1 : 2) {\n    grid_box part'),
    ('distance.c', 'for (int k = 0; k < 4; k++) {\n    grid_box part',
     'for (int k = 0; k < 4; k += k == 1 ? 2 : 1) {\n    grid_box part'),
    ('distance.c', 'if (near <= least) {',
     'if (near < least) {'),
    ('distance.c', 'if (far < least) least = far;', 'if (k == from || far > least) least = far;'),
    ('distance.c', 'if (possible == 1 || ', 'if (possible <= 2 || '),
    ('distance.c', 'sum += dyd_cert_square(left > right ? left : right);',
     'sum += dyd_cert_square(left < right ? left : right);'),
    ('distance.c', ' && are_disjoint(s, a, &s->item[list[k]])) return true;', ') return true;'),
    ('distance.c', 'if (far_on_grid(q, &s->item[list[k]]) <= most && ', 'if ('),
    ('distance.c', 'bool holds = dyd_exact_cmp(&left, &right) <= 0;', 'bool holds = true;'),
    ('distance.c', 'if (a->diameter == 0 && b->diameter == 0) return are_disjoint(s, a, b);',
     'if (a->diameter == 0 || b->diameter == 0) return are_disjoint(s, a, b);'),
    ('distance.c', 'right.exp += s->bound->exp + 1;', 'right.exp += s->bound->exp + 3;'),
    ('distance.c', 'mpz_add_ui(s->root, s->root, far_b);', ''),
    ('distance.c', 'bool spans = disjoint && dyd_cert_fraction', 'bool spans = dyd_cert_fraction'),
    ('distance.c', 'bool spans = disjoint && dyd_cert_fraction_cmp(&sum, &s->part) <= 0;', 'bool spans = disjoint;'),
    ('distance.c', 'if (s.st == DYD_OK && dyd_exact_sgn(bound) >= 0) {', 'if (s.st == DYD_OK) {'),
    ('measure.c', 'if (dyd_exact_cmp(&twice, &sum) <= 0) at = &side->hi;',
     'if (dyd_exact_cmp(&twice, &sum) > 0) at = &side->hi;'),
    ('measure.c', 'at = dyd_exact_cmp(c, &side->hi) < 0 ? c : &side->hi;', 'at = c;'),
    ('measure.c', 'bool high = (dyd_exact_sgn(&u[axis]) > 0) == upper;', 'bool high = dyd_exact_sgn(&u[axis]) > 0;'),
    ('measure.c', 'return det > error ? 1 : det < -error ? -1 : 0;', 'return det > 0 ? 1 : det < 0 ? -1 : 0;'),
    ('tree.c', 'out->far |= mpz_sizeinbase(t, 2) > 60;', 'out->far |= mpz_sizeinbase(t, 2) > 90;'),
    ('tree.c', 'if (!c->far && near_lower(c, tree_child(t, level, child)) > limit) continue;',
     'if (near_lower(c, tree_child(t, level, child)) > limit) continue;'),
    ('tree.c', '> limit) continue;', '>= limit) continue;'),
    ('tree.c', 'sum += dyd_cert_square(left > right ? left : right);',
     'sum += dyd_cert_square(left < right ? left : right);'),
    ('sites.c', 'dyd_exact_ceil(t, dyd_cert_high(side), dyd_cert_den(side), s->unit);',
     'dyd_exact_floor(t, dyd_cert_high(side), dyd_cert_den(side), s->unit);'),
    ('sites.c', 'dyd_exact_floor(t, &side->lo, dyd_cert_den(side), s->unit);',
     'dyd_exact_ceil(t, &side->lo, dyd_cert_den(side), s->unit);'),
    ('read.c', "if (*digit == '0') return digit == text ? digit + 1 : NULL;", "if (*digit == '0') return digit + 1;"),
    ('read.c', '|| exp == 0) return false;', ') return false;'),
    ('read.c', '|| (exp && !mpz_odd_p(out->man))) return false;', ') return false;'),
    ('read.c', 'return exact_in_range(out);', 'return true;'),
    ('read.c', '|| dyd_exact_sgn(&width) <= 0)', '|| dyd_exact_sgn(&width) < 0)'),
    ('read.c', 'good = good && mpz_cmp_ui(g, 1) == 0 && ', 'good = good && '),
    ('read.c', 'mpz_cmp_ui(den, 1) > 0 && mpz_odd_p(den);', 'mpz_cmp_ui(den, 1) > 0;'),
    ('read.c', 'if (getc(r->in) != EOF) return', 'if (false) return'),
    ('read.c', 'return r->at ? dyd_cert_reject', 'return false ? dyd_cert_reject'),
    ('read.c', 'if (!end || *end || end - text > 18) return false;', 'if (!end || *end) return false;'),
    ('caps.c', 'return dyd_exact_cmp(&d, &s) <= 0;', 'return false;'),
    ('caps.c', 'bool nearer = dyd_exact_sgn(&b) > 0;', 'bool nearer = true;'),
    ('caps.c', 'return nearer && dyd_exact_cmp(&b, &a) > 0;', 'return nearer && dyd_exact_cmp(&b, &a) >= 0;'),
    ('caps.c', 'return nearer && dyd_exact_cmp(&b, &a) > 0;', 'return nearer;'),
    ('caps.c', 'a.exp += 2;', ''),
    ('caps.c', 'dyd_exact_add(&s, &i->r, &k->r);', 'dyd_exact_set(&s, &i->r);'),
    ('caps.c', 'dyd_exact_add(&s, &i->r, &k->r);', 'dyd_exact_set(&s, &k->r);'),
    ('caps.c', 'if (dyd_cert_disc_is_nearer(s->c, &d[s->i], &d[k]) && dyd', 'if (dyd'),
    ('caps.c', ' && dyd_cert_disc_is_nearer(s->c, &d[s->j], &d[k])) return true;', ') return true;'),
    ('caps.c', 'limit = a > b ? a : b;', 'limit = 0;'),
    ('caps.c', 'dyd_exact_set(&p->tau, &c->delta);', ''),
    ('caps.c', 'dyd_exact_add(&p->tau, &k->r, &c->i->r);', 'dyd_exact_set(&p->tau, &k->r);'),
    ('caps.c', 'dyd_exact_add(&p->tau, &k->r, &c->i->r);', 'dyd_exact_set(&p->tau, &c->i->r);'),
    ('caps.c', 'cap_against_pair(&p->tau, c, &c->delta, &p->n, 1);', 'cap_against_pair(&p->tau, c, &c->delta, &p->n, -1);'),
    ('caps.c', 'cap_against_pair(&p->wy, c, &c->jy, &p->n, -1);', 'cap_against_pair(&p->wy, c, &c->jy, &p->n, 1);'),
    ('caps.c', 'cap_end_sign(e, &c->item[k]) <= 0)) k++;', 'cap_end_sign(e, &c->item[k]) < 0)) k++;'),
    ('discs.c', 'return dyd_cert_fraction_cmp(&near, &r2) <= 0;', 'return true;'),
    ('discs.c', 'return dyd_cert_fraction_cmp(&near, &r2) <= 0;', 'return dyd_cert_fraction_cmp(&near, &r2) < 0;'),
    ('discs.c', 'if (dyd_exact_sgn(&d->r) < 0) return', 'if (false) return'),
    ('discs.c', 'if (count != c->report.discs) return', 'if (false) return'),
    ('discs.c', 'dyd_cert_edges_have(&c->tie, p->i, p->j) ||', ''),
    ('discs.c', 'if (!dyd_cert_edges_have(&c->open, p->i, p->j) || ', 'if ('),
    ('discs.c', ' ||\n      dyd_cert_edges_have(&c->bare, p->i, p->j))', ')'),
    ('discs.c', 'c->report.indeterminate--;', ''),
    ('discs.c', 'good = good && !dyd_cert_discs_meet(caps.i, caps.j) && dyd_cert_caps_cover(&end, &caps);', ''),
    ('discs.c', 'if (!dyd_cert_is_disc_witness(&other, &c->sites, &c->tree, c->disc, p->i, p->j, c->point))', 'if (false)'),
    ('certificate.c', 'if (r->discs_unproved) r->gaps |= DYD_GAP_DISCS;', ''),
    ('certificate.c', ' && !r->discs_unproved && !r->near_unproved &&', ' &&'),
    ('certificate.c', 'if (r->graph_unproved || (r->graph && (r->unproved || r->capped))) r->gaps |= DYD_GAP_GRAPH;', ''),
    ('certificate.c', 'if (r->near_unproved) r->gaps |= DYD_GAP_NEAREST;', ''),
    ('certificate.c', ' || r->places_certain < r->places;', ';'),
    ('fixpoint.c', '*out = r->discs_fixed && !still && !c->near_moves && !r->near_unproved;',
     '*out = r->discs && !still && !c->near_moves && !r->near_unproved;'),
    ('fixpoint.c', 'bool stay = !c->near_moves && !c->report.near_unproved;', 'bool stay = true;'),
    ('fixpoint.c', 'stay = !m->movable[c->near_open[k]];', 'stay = true;'),
    ('near.c', 'return dyd_exact_cmp(&far, &near) < 0;', 'return dyd_exact_cmp(&far, &near) <= 0;'),
    ('near.c', 'int corners = dyd_cert_span_is_point(b) ? 1 : 4;', 'int corners = 1;'),
    ('near.c', 'int corners = dyd_cert_span_is_point(b) ? 1 : 4;', 'int corners = 3;'),
    ('near.c', 'dyd_cert_corner_distance2(&far, b, q, k, true);', 'dyd_cert_corner_distance2(&far, b, q, k, false);'),
    ('near.c', 'dyd_cert_corner_distance2(&near, b, q, j, false);', 'dyd_cert_corner_distance2(&near, b, q, j, true);'),
    ('near.c', 'out->e[1] = upper.e[1];', ''),
    ('near.c', 'if (k == i || k == q->self || span', 'if (k == i || span'),
    ('near.c', 'for (int upper = 0; upper < 2 && more; upper++) {', 'for (int upper = 1; upper < 2 && more; upper++) {'),
    ('near.c', 'for (int upper = 0; upper < 2 && more; upper++) {', 'for (int upper = 0; upper < 1 && more; upper++) {'),
    ('near.c', 's->unproved++;', ''),
    ('near.c', 'if (k < s->q->count || j == s->q->self || span', 'if (k < s->q->count || span'),
    ('near.c', 'bool hold = dyd_exact_sgn(lo) <= 0 || dyd_exact_cmp(&t, &d[0]) <= 0;', 'bool hold = true;'),
    ('near.c', 'bool hold = dyd_exact_sgn(lo) <= 0 || dyd_exact_cmp(&t, &d[0]) <= 0;',
     'bool hold = dyd_exact_sgn(lo) <= 0 || dyd_exact_cmp(&t, &d[0]) < 0;'),
    ('near.c', 'hold = hold && dyd_exact_sgn(&t) >= 0;', ''),
    ('near.c', 'hold = hold && dyd_exact_cmp(&t, &d[1]) >= 0;', 'hold = hold && dyd_exact_cmp(&t, &d[1]) > 0;'),
    ('places.c', 'if (p->count != 1) return', 'if (false) return'),
    ('places.c', 'if (p->count && i <= p->list[p->count - 1]) return', 'if (false) return'),
    ('places.c', ': dyd_cert_near_is_certain(&other, &q)))', ': true))'),
    ('places.c', 'if (!point) c->near_moves = true;', ''),
    ('places.c', 'c->report.near_unproved += unproved;', ''),
    ('places.c', 'if (st == DYD_OK && !p->count && places_sites(p)) st', 'if (false) st'),
    ('places.c', 'if (!near_bounds_are_right(p, i, &c->point[0], none ? NULL : &c->point[1]))', 'if (false)'),
    ('places.c', 'if (st != DYD_OK || !p->compass.bowl[*i].alias) return st;', 'return st;'),
    ('places.c', 'if (st == DYD_OK && c->sites.count) st', 'if (false) st'),
    ('places.c', 'dyd_cert_compass_is_certain(&other, &p->compass, &p->here, p->list[0])', 'true'),
    ('places.c', 'if (p->count && globe) dyd_cert', 'if (false) dyd_cert'),
    ('near.c', '(q->disc && dyd_cert_disc_is_nearer(at, &q->disc[k], &q->disc[j]))', 'q->disc'),
    ('near.c', '    low = low || near_bounds_hold(a, &centre, &disc->r, lo, NULL);', '    low = true;'),
    ('near.c', '    high = high || near_bounds_hold(a, &centre, &disc->r, &none, hi);', '    high = true;'),
    ('near.c', 'dyd_exact_add(&t, lo, more);', 'dyd_exact_set(&t, lo);'),
    ('near.c', 'dyd_exact_sub(&t, hi, more);', 'dyd_exact_set(&t, hi);'),
    ('globe_near.c', 'mpz_cmp(v->far.hi, v->t.lo) < 0 ? 1', 'true ? 1'),
    ('globe_near.c', 'dyd_cert_enclosure_sub(&v->t, &x);', ''),
    ('globe_near.c', 'dyd_cert_enclosure_add(&v->s, &v->ball[2].cap);', ''),
    ('globe_near.c', 'boxes && k < 4; k++', 'boxes && k < 1; k++'),
    ('globe_near.c', 'for (int upper = 0; upper < 2 && good; upper++) {', 'for (int upper = 1; upper < 2 && good; upper++) {'),
    ('globe_near.c', 'for (int upper = 0; upper < 2 && good; upper++) {', 'for (int upper = 0; upper < 1 && good; upper++) {'),
    ('globe_near.c', 'if (holds || cuts == MOST_CUTS) return holds > 0;', 'return holds >= 0;'),
    ('globe_near.c', 'if (region_is_nearer(at, &c->region[i], &c->region[k], &effort)) continue;', 'continue;'),
    ('globe_near.c', '*unproved += !nowhere;', ''),
    ('globe_near.c', 'if (dyd_exact_sgn(lo) > 0 && !ground', 'if (false && !ground'),
    ('globe_near.c', 'return !hi || ground_bound_holds(a, b, hi, true);', 'return true;'),
    ('globe_near.c', '(greatest ? mpq_add : mpq_sub)(out, out, half);', ''),
    ('globe_near.c', 'if (mpq_cmp(half, out) < 0) mpq_set(out, half);', ''),
    ('globe_near.c', 'if (b->upper && mpz_cmp(v->t.lo, v->pi.hi) >= 0) return 1;', 'if (b->upper) return 1;'),
    ('globe_near.c', 'mpz_sub(v->t.lo, v->t.lo, v->ball[k].box);', ';'),
    ('globe_near.c', 'c->bowl[i].alias = alias;', 'c->bowl[i].alias = false;'),
    ('graphs.c', 'if (certain && g->count > 1) return', 'if (false) return'),
    ('graphs.c', 'if (certain && !dyd_cert_near_is_certain(&other, &q))', 'if (false)'),
    ('graphs.c', '  c->report.graph_unproved += unproved;\n  return DYD_OK;', '  return DYD_OK;'),
    ('graphs.c', '    g->c->report.graph_unproved += unproved;\n', ''),
    ('graphs.c', 'count_silent(g, k ? last.i + 1 : 0, row.i);', ''),
    ('graphs.c', 'count_silent(g, rows ? last.i + 1 : 0, (uint32_t)g->c->sites.count);', ''),
    ('graphs.c', 'if (st == DYD_OK && row->i == row->j) st', 'if (false) st'),
    ('graphs.c', 'if (k && (row.i < last.i || (row.i == last.i && row.j <= last.j)))', 'if (false)'),
    ('graphs.c', 'has_certain |= certain;', ''),
    ('graphs.c', 'return dyd_exact_sgn(&least[0]) > 0;', 'return dyd_exact_sgn(&least[0]) >= 0;'),
    ('graphs.c', 'dyd_exact_add(&least[0], &least[0], &least[1]);', ''),
    ('graphs.c', 'if (dyd_exact_cmp(&z, &side[0]) < 0) dyd_exact_set(&z, &side[0]);', ''),
    ('graphs.c', 'if (dyd_exact_cmp(&z, &side[1]) > 0) dyd_exact_set(&z, &side[1]);', ''),
    ('graphs.c', 'for (int q = 0; q < 4; q++)\n      lower_angle', 'for (int q = 0; q < 1; q++)\n      lower_angle'),
    ('graphs.c', 'for (int q = 0; q < 4; q++)\n      lower_angle', 'for (int q = 0; q < 3; q++)\n      lower_angle'),
    ('graphs.c', '&s->box[p->j]) / 4 + 1;', '&s->box[p->j]) / 40;'),
    ('graphs.c', 'inside = dyd_exact_cmp(&far, &radius) < 0;', 'inside = dyd_exact_cmp(&far, &radius) <= 0;'),
    ('graphs.c', 'dyd_cert_corner_distance2(&far, b, q, &g->span[k], true);',
     'dyd_cert_corner_distance2(&far, b, q, &g->span[k], false);'),
    ('graphs.c', '&j->e[2 * a], false);\n    if (dyd_exact_cmp(&t, &d) > 0) dyd_exact_set(&d, &t);', '&j->e[2 * a], false);'),
    ('graphs.c', '!largest]);\n    if (dyd_exact_cmp(&t, &d) > 0) dyd_exact_set(&d, &t);', '!largest]);'),
    ('graphs.c', 'for (int q = 0; q < 4 && inside; q++) {', 'for (int q = 0; q < 1 && inside; q++) {'),
    ('graphs.c', 'for (int k = 0; k < last[0] * last[1] && never; k++) {', 'for (int k = 1; k < last[0] * last[1] && never; k++) {'),
    ('graphs.c', '(row->i > row->j || dyd_cert_compare_edges(last, row) >= 0))', 'row->i > row->j)'),
    ('graphs.c', 'if (st == DYD_OK && certain && !gabriel_is_certain(&other, g, &row))', 'if (false)'),
    ('graphs.c', 'c->report.graph_unproved += !gabriel_is_never(g, p);', ';'),
]
CONES = 'what a cone holds, squares before it hold as well, and leave unless cut more often than the effort allows'
SURVIVORS = [
    ('boxes.c', 'blocked = blocked && top[k] < b[q].bottom[k];', ';', CONES),
    ('boxes.c', 'b->e[2 * a + ((u > 0) == upper)];', 'b->e[2 * a + (u > 0)];', CONES),
    ('boxes.c', 'for (int side = 0; side < 4 && st == DYD_OK; side++) {\n    cone_region(&r, side, LAST)',
     'for (int side = 0; side < 3 && st == DYD_OK; side++) {\n    cone_region(&r, side, LAST)', CONES),
    ('boxes.c', 'bool blocked = b[q].site != v;', 'bool blocked = true;',
     'the far end of a rectangle is not nearer than its near one'),
    ('caps.c', 'bool swap = dyd_exact_cmp(&a->r, &b->r) > 0;', 'bool swap = dyd_exact_cmp(&a->r, &b->r) < 0;',
     'the circles that touch both discs are the same ones'),
    ('caps.c', '*good = dyd_exact_sgn(&c->nj) > 0;', '*good = true;', 'discs in one another meet, which is refused'),
    ('chain.c', 'return dyd_cert_cross(p, q, p, at) >= 0 ? 1 : -1;',
     'return dyd_cert_cross(p, q, p, at) > 0 ? 1 : -1;',
     'the chain is moved to the right in place of the left'),
    ('chain.c', 'dyd_cert_cross(a, b, from, q) < 0;',
     'dyd_cert_cross(a, b, from, q) <= 0;',
     'no blocked line meets a place'),
    ('cocircular.c', 'is_flat(at, SPARE, 2 * SPARE) && is_flat(at, bits, bits + SPARE)', 'is_flat(at, SPARE, 2 * SPARE)',
     'no four places of an order that is taken are known to be that near to a circle'),
    ('faces.c', 'stack[top - 1], v) <= 0) top--;',
     'stack[top - 1], v) < 0) top--;',
     'nobody is surely beyond two neighbours and on the line between them'),
    ('graph.c', 'g->connected = parts <= 1 && have_directions(g);',
     'g->connected = parts <= 1;',
     'of two sites in one place, only those of two in all are joined'),
    ('measure.c', 'if (!s->box || s->site[v].place) return false;',
     'if (!s->box) return false;',
     'places stay in their rectangles; bridges are no borders, in whatever order they leave a site'),
]


def notices(program, certificates):
    """The first file with another verdict; None: there is none. A crash, or no end, is a verdict of its own."""
    for path in certificates:
        try:
            if subprocess.run([program, path], stdout=subprocess.DEVNULL, timeout=300, check=False).returncode:
                return path
        except subprocess.TimeoutExpired:
            return path
    return None


class Seeds:
    """Builds the judge with one source of the checker replaced."""

    def __init__(self, cc, root, library, folder):
        self.flags = ['-std=c11', '-O0', '-w', '-D_POSIX_C_SOURCE=200809L', '-fvisibility=hidden', '-DDYD_ARMED',
                      f'-I{root}/include', f'-I{root}/src']
        self.cc, self.root, self.library, self.folder = cc.split(), root, library, folder
        self.last = {}  # the file that noticed the last fault of a source: most likely it notices the next one
        self.compile(root / 'tests/checker/judge.c', folder / 'judge.o')

    def compile(self, source, target):
        return subprocess.run([*self.cc, *self.flags, '-c', source, '-o', target], stderr=subprocess.DEVNULL,
                              check=False).returncode == 0

    def link(self, name, objects):
        program = self.folder / name
        subprocess.run([*self.cc, self.folder / 'judge.o', *objects, self.library, '-lgmp', '-lmpfr', '-lm', '-pthread',
                        '-o', program], check=True)
        return program

    def noticed(self, number, source, text, certificates):
        """Returns None if the text is not a valid program."""
        changed, target = self.folder / f'{number}.c', self.folder / f'{number}.o'
        changed.write_text(text)
        if not self.compile(changed, target):
            return None
        program = self.link(f'judge{number}', [target])
        found = notices(program, sorted(certificates, key=lambda path: path != self.last.get(source)))
        self.last[source] = found or self.last.get(source)
        for path in (changed, target, program):
            path.unlink()
        return found is not None


def try_faults(seeds, sources, certificates):
    """The faults of this list that are not noticed, and the survivors that are."""
    def noticed(k):
        source, old, new = faults[k][:3]
        text = (sources / source).read_text()
        if text.count(old) != 1:
            raise SystemExit(f'{source} has this {text.count(old)} times, not once: {old}')
        return seeds.noticed(k, source, text.replace(old, new), certificates)

    faults = FAULTS + SURVIVORS
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for fault, found in zip(faults, pool.map(noticed, range(len(faults)))):
            if found != (len(fault) == 3):
                yield f'{"noticed after all" if found else "unnoticed"}: {fault[0]}: {fault[1]}'


def try_drawn(seeds, sources, certificates, count, seed, names):
    """The same of faults drawn at random."""
    sys.path.insert(0, str(seeds.root / 'tests/support'))
    import mutants  # pylint: disable=import-outside-toplevel,import-error
    text = {f'checker/{name}': (sources / name).read_text() for name in names}
    tried = 0
    for told, source, start, end, new in mutants.drawn(text, seed):
        found = seeds.noticed(tried, source, text[source][:start] + new + text[source][end:], certificates)
        tried += found is not None
        if found is False:
            yield f'SURVIVES: {told}'
        if tried == count:
            break
    print(f'# {tried} faults')


def main():
    cc, root, library, *drawn = sys.argv[1:]
    root = pathlib.Path(root)
    certificates = [root / 'tests/checker' / name for name in
                    ('circles.txt', 'forgeries.txt', 'forgeries_parts.txt', 'forgeries_sphere.txt')]
    sources = root / 'src/checker'
    with tempfile.TemporaryDirectory() as name:
        seeds = Seeds(cc, root, library, pathlib.Path(name))
        if notices(seeds.link('judge', []), certificates):
            raise SystemExit('noticed without a fault')
        lines = (try_drawn(seeds, sources, certificates, int(drawn[0]), int(drawn[1]), drawn[2:]) if drawn else
                 try_faults(seeds, sources, certificates))
        wrong = 0
        for line in lines:
            wrong += 1
            print(line, flush=True)
    print(f'{wrong} unnoticed')
    return wrong > 0


if __name__ == '__main__':
    sys.exit(main())
