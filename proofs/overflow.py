#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nothing overflows in src/dyadic and parts of src/checker, no pointer goes astray: proved by Frama-C's WP and CVC4.

Usage: overflow.py ROOT [PART]   (exit status 1: a goal is not proved, or a seeded fault is; 77: Frama-C, Why3 or CVC4
is absent). PART: one of PARTS; without it, all.

overflow/NAME.c has contracts for the functions of src/FOLDER/NAME.c, and includes it; overflow/gmp.h says what is taken
for granted of GMP, overflow/math.h of the functions on doubles, other headers there of the C library. Of each function
WP proves what it promises, the conditions of all that it calls, and that no operation is undefined: signed overflow,
memory that is not there, shifts, conversions of integers that lose something. Goals that CVC4 does not prove are named
(UNPROVED); what is put in as `admit` is assumed. Then faults are put in, one at a time: another goal has to fail, and
none that takes CVC4 long without the fault.
"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

FILES = {  # folder, functions left out, or all that are looked at
    'dyadic': ('dyadic', [], []), 'sqrt_sign': ('dyadic', ['dyd_sqrt2_sign'], []),
    'convert': ('dyadic', ['dyd_dyadic_round_q'], []), 'exact': ('checker', [], []),
    'tree': ('checker', [], ['spread_bits', 'key_of_box', 'enclose_child', 'dyd_cert_square', 'dyd_cert_far_upper',
                             'near_lower', 'size_below', 'tree_child', 'fill_level']),
    'boxes': ('checker', [], ['far_from_corner', 'near_from_corner', 'region_part', 'square_region']),
    'bracket': ('checker', [], ['longest_of']),
    'algebra_bound': ('checker', [], ['tower_degree', 'enclosure_is_below']),
    'algebra': ('checker', [], ['dyd_cert_op_operands', 'dyd_cert_op_name', 'dyd_cert_algebra_leaf']),
    'ties': ('checker', [], ['find_described', 'read_count', 'read_point']),
    'read': ('checker', ['dyd_cert_reader_clear'], []),
    'alloc': ('base', [], []),
    'text': ('dyadic', [], []),
    'graph': ('checker', [], ['sift_down', 'dyd_cert_sort', 'dyd_cert_edges_add', 'half_of_directions',
                              'have_directions', 'find_connected', 'dyd_cert_graph_init', 'dyd_cert_outer',
                              'dyd_cert_edge_of', 'dyd_cert_is_legal', 'dyd_cert_origin', 'dyd_cert_root']),
    'poly': ('checker', [], ['terms_compare', 'terms_alloc', 'term_scale', 'scan_unsigned', 'scan_power',
                             'scan_coefficient', 'count_terms']),
    'sites': ('checker', [], ['dyd_cert_sites_add', 'dyd_cert_side_set_den', 'dyd_cert_site_set_place']),
    'chain': ('checker', [], ['dyd_cert_chain_resize']),
    'checker': ('checker', [], ['dyd_cert_expect_word', 'dyd_cert_read_choice', 'dyd_cert_read_site',
                                'dyd_cert_read_pair', 'corners_add']),
    'cycle': ('checker', [], ['moebius', 'totient', 'cyclotomic', 'extend_cosines', 'dyd_cert_cycle_cosine']),
    'measure': ('checker', [], ['absolute_value', 'grid_place', 'turn_on_grid']),
    'parts': ('checker', [], ['site_on_walk', 'dyd_cert_distinct']),
    'faces': ('checker', [], ['next_common_set', 'dyd_cert_faces_common', 'dyd_cert_faces_share',
                              'dyd_cert_faces_still', 'dyd_cert_faces_cover', 'dyd_cert_faces_left', 'mark_hull_chain',
                              'corner_is_beyond']),
    'number': ('checker', [], ['is_circular', 'is_exponential', 'is_leaf_of', 'value_is_leaf', 'value_makes_leaf',
                               'make_angle']),
    'algebra_read': ('checker', [], ['read_operand', 'read_op', 'scan_fraction', 'has_value']),
    'pairs': ('checker', [], ['add_all_pairs']),
    'quotient': ('checker', [], ['dyd_cert_quotient_neg', 'dyd_cert_quotient_invert']),
    'enclosure': ('checker', [], ['dyd_cert_enclosure_init', 'dyd_cert_enclosure_set', 'dyd_cert_enclosure_set_q',
                                  'dyd_cert_enclosure_sign', 'dyd_cert_enclosure_set_si', 'enclosure_limit',
                                  'dyd_cert_enclosure_add', 'dyd_cert_enclosure_neg']),
    'inverse': ('checker', [], ['enclosure_set_at', 'is_narrower']),
    'distance': ('checker', [], ['far_on_grid', 'near_on_grid']),
    'still': ('checker', [], ['movers_count', 'movers_of', 'is_in_a_pair']),
    'diagram': ('checker', [], ['polygon_goes_on', 'polygon_spot', 'dyd_cert_window_has',
                                'dyd_cert_polygon_is_convex']),
}
PARTS = {  # tests of about four minutes at most; those but the first are of what reads and keeps the bytes of others
    'numbers': ['dyadic', 'sqrt_sign', 'convert', 'exact', 'tree', 'measure'],
    'texts': ['alloc', 'text', 'poly'], 'lines': ['read', 'checker'], 'lists': ['graph', 'sites', 'chain'],
    'sets': ['parts', 'faces', 'still', 'diagram', 'pairs', 'number', 'quotient', 'algebra_read',
             'enclosure', 'inverse', 'distance'],
    'blocks': ['algebra', 'algebra_bound', 'bracket', 'cycle', 'ties', 'boxes'],
}
EACH_EDGE = '''for (size_t e = 0; e < g->count; e++) {
    dyd_cert_edge edge = dyd_cert_edge_of(g, (uint32_t)(2 * e));
    '''
UNPROVED = {  # goals that CVC4 does not prove, and why
    'extend_cosines_assigns_exit_part1': 'CVC4 does not see that the relations are part of the block',
    'extend_cosines_assigns_normal': 'likewise',
    'dyd_cert_side_set_den_assigns_exit_part3': 'WP does not know that new memory is new',
    'dyd_cert_side_set_den_assigns_normal_part4': 'likewise',
    'dyd_cert_side_set_den_assigns_normal_part5': 'likewise',
}
LOOPS = {  # what holds in a loop: put before it
    'text': [
        ('static bool text_is_blank', '#include "text.h"\n'),
        ('while (text_is_digit(*r->at, base))', '''/*@ loop invariant reads(r);
            loop invariant \\at(r->count, Pre) <= r->count && 0 <= r->at - \\at(r->at, Pre);
            loop assigns r->at, r->count, r->digits[0 .. LENGTH]; loop variant LENGTH - (r->at - r->text); */ '''),
        ('for (; text_is_digit(*r->at, 10); r->at++)', '''/*@ loop invariant reads(r) && 0 <= e <= 10995116277769;
            loop assigns r->at, e; loop variant LENGTH - (r->at - r->text); */ '''),
        ('reader r = {text', '/*@ assert ends(text, LENGTH); */ '),
        ('if (!text_read(&r', '''/*@ admit \\separated(r.digits + (0 .. LENGTH), text + (0 .. LENGTH), out, err, &r,
            &man[0], &base, &negative); */ '''),
        ('  } else if (mpz_divisible_p', '/*@ assert whole(&power[0]); */ '),
        ('  }\n  mpz_clear(power)', '/*@ assert whole(&power[0]); */ '),
        ('if (st == DYD_E_PARSE) text_refuse', '/*@ assert dyadic(out) && whole(&man[0]); */ '),
        ('st = text_refuse(err, DYD_E_PARSE, (size_t)', '/*@ assert dyadic(out) && whole(&man[0]); */ '),
        ('if (st == DYD_E_RANGE) text_refuse', '/*@ assert dyadic(out) && whole(&man[0]); */ '),
        ('  }\n  mpz_clear(man);\n  free', '/*@ assert dyadic(out) && whole(&man[0]); */ '),
        ('  } else {\n    r.digits', '/*@ assert dyadic(out) && whole(&man[0]); */ '),
        ('mpz_set_str(man, r.digits', '/*@ assert ends(r.digits, r.count); */ '),
        ('for (const char *expected', '''/*@ loop assigns expected, r->at; loop pragma UNROLL "completely", 4; */ '''),
        ('while (text_is_blank(*r->at)) r->at++;', '''/*@ loop invariant reads(r);
            loop assigns r->at; loop variant LENGTH - (r->at - r->text); */ '''),
    ],
    'boxes': [
        ('/* ---- one site in one region', '''typedef const region *region_of;
/*@ predicate square_or_cone(region_of r) = \\valid_read(r) && 0 <= r->depth <= 64 && (r->cone ? r->corners == 2 :
      r->corners == 4) && near(&r->corner[0][0]) && near(&r->corner[1][0]) && near(&r->corner[2][0]) &&
      near(&r->corner[3][0]); */
/*@ requires \\valid(out) && square_or_cone(r) && \\separated(out, r) && 0 <= k < r->corners;
    assigns *out; exits \\false; */
static bool region_part(region *out, const region *r, int k);
/*@ requires -576460752840294400 <= x <= 576460752840294400 && -576460752840294400 <= y <= 576460752840294400 &&
      0 < side <= 288230376151711744; assigns \\nothing; exits \\false; */
static region square_region(int64_t x, int64_t y, int64_t side);
'''),
        ('for (int a = 0; a < 2; a++) {\n    int64_t left', '''/*@ loop invariant 0 <= a <= 2; loop assigns a, sum;
            loop variant 2 - a; */ '''),
        ('for (int a = 0; a < 2; a++) middle', '''/*@ loop invariant 0 <= a <= 2; loop assigns a, middle[0 .. 1];
            loop variant 2 - a; */ '''),
        ('for (int a = 0; a < 2; a++) out', '''/*@ loop invariant 0 <= a <= 2; loop assigns a, *out;
            loop variant 2 - a; */ '''),
        ('for (int c = 0; c < 4; c++)\n      for', '''/*@ loop invariant 0 <= c <= 4; loop assigns c, *out;
            loop variant 4 - c; */ '''),
        ('for (int a = 0; a < 2; a++) {\n        bool high', '''/*@ loop invariant 0 <= a <= 2; loop assigns a, *out;
            loop variant 2 - a; */ '''),
        ('for (int c = 0; c < 4; c++) {\n    r.corner', '''/*@ loop invariant 0 <= c <= 4; loop assigns c, r;
            loop variant 4 - c; */ '''),
    ],
    'bracket': [
        ('for (size_t k = 0; k < (all', '''/*@ loop invariant 0 <= most <= 137438953472 && k <= r->count &&
            (all ==> \\forall integer j; 0 <= j < k ==> r->coeff[j][0].length <= most); loop assigns k, most;
            loop variant r->count - k; */ '''),
        ('for (int k = 0; k < 4; k++) {\n    size_t', '''/*@ loop invariant 0 <= k <= 4 && most <= 137438953472 &&
            (0 < k ==> 1 <= most) &&
            (\\forall integer j; 0 <= j < k ==> r->end[j][0].length <= most) &&
            (all ==> \\forall integer j; 0 <= j < r->count ==> r->coeff[j][0].length <= most);
            loop assigns k, most; loop variant 4 - k; */ '''),
    ],
    'algebra_bound': [
        ('for (size_t t = 0; t < q->count; t++)', '''/*@ loop invariant t <= q->count; loop assigns t, uses[0 .. 63];
            loop variant q->count - t; */ '''),
        ('for (size_t k = 0; k < DYD_CERT_LEAVES; k++) uses', '''/*@ loop invariant k <= 64;
            loop assigns k, uses[0 .. 63]; loop variant 64 - k; */ '''),
        ('for (size_t l = a->relations.count; l-- > 0;)', '''/*@ loop invariant l <= a->relations.count &&
            1 <= degree <= 16384; loop assigns l, degree, uses[0 .. 63]; */ '''),
        ('for (size_t t = 0; t < r->rest.count; t++)', '''/*@ loop invariant t <= r->rest.count;
            loop assigns t, uses[0 .. 63]; loop variant r->rest.count - t; */ '''),
        ('for (size_t k = 0; k < l; k++)', '''/*@ loop invariant k <= l; loop assigns k, uses[0 .. 63];
            loop variant l - k; */ '''),
    ],
    'ties': [
        ('while (lo < hi) {', '''/*@ loop invariant lo <= hi <= b->points; loop assigns lo, hi;
            loop variant hi - lo; */ '''),
        # a new line changes the reader only
        ('if (st == DYD_OK) st = dyd_cert_read_index(&d->site', '''/*@ admit reads(in) && \\valid(b) &&
            0 < s->count <= 4294967295 && 0 < b->algebra.count <= 4194304 && b->points < 4294967295 &&
            \\valid(b->point + (0 .. b->points)) && d == b->point + b->points &&
            \\separated(b->point + (0 .. b->points), b, in, in->err, s, in->line + (0 .. in->cap - 1)) &&
            \\separated(b, in, in->err, s, in->line + (0 .. in->cap - 1)); */ '''),
        ('if (st == DYD_OK && strcmp(word, name) != 0) st', '/*@ admit string(name); */ '),  # as in checker.c
        ('for (int axis = 0; axis < 2 && st == DYD_OK; axis++)\n    st = dyd_cert_read_index', '''/*@ loop invariant
            0 <= axis <= 2 && reads(in);
            loop assigns axis, st, d->number[0 .. 1], in->at, in->line[0 .. in->cap - 1], *in->err;
            loop variant 2 - axis; */ '''),
    ],
    'tree': [
        ('for (size_t q = 0; q < children; q++)', '''/*@ loop invariant q <= children;
            loop assigns q, t->node[0 .. t->count / 4 + 11]; loop variant children - q; */ '''),
        ('for (int k = 0; k < 4; k++)\n    if (first', """/*@ loop invariant 0 <= k <= 4;
            loop assigns k, out->e[0 .. 3]; loop variant 4 - k; */ """),
        ('for (int a = 0; a < 4; a += 2) {', """/*@ loop invariant a == 0 || a == 2 || a == 4;
            loop assigns a, sum; loop variant 4 - a; */ """),
    ],
    'sites': [
        ('for (int a = 0; a < 2; a++) {', '''/*@ loop invariant 0 <= a <= 2; loop assigns a, site->side[0 .. 1];
            loop variant 2 - a; */ '''),
        ('dyd_cert_site *site = &s->site', '/*@ admit \\separated(s->site + (0 .. s->cap - 1), s); */ '),
        ('mpz_init(*side->den);', '/*@ admit \\separated(side->den, side, den); */ '),
        ('dyd_exact_init(&site->place[0]);', '/*@ admit \\separated(site->place + (0 .. 1), site, at + (0 .. 1)); */ '),
    ],
    'chain': [
        ('for (size_t q = c->cap; q < cap; q++) {', '''/*@ admit \\separated(&c->point[0][0] + (0 .. 2 * cap - 1),
            c); */ /*@ loop invariant c->cap <= q <= cap; loop assigns q, *(&c->point[0][0] + (0 .. 2 * cap - 1));
            loop variant cap - q; */ '''),
    ],
    'checker': [
        ('if (strcmp(word, text[*out])', '/*@ admit string(text[*out]); */ '),  # after a zero was written in a line
        ('for (*out = 0; *out < count; ++*out)', '''/*@ loop invariant 0 <= *out <= count; loop assigns *out;
            loop variant count - *out; */ '''),
        ('for (int a = 0; a < 2; a++) {\n    dyd_exact_init', '''/*@ admit \\separated(corner, c, u + (0 .. 1)); */
            /*@ loop invariant 0 <= a <= 2 && exact(u) && exact(u + 1); loop assigns a, corner->u[0 .. 1];
            loop variant 2 - a; */ '''),
    ],
    'cycle': [
        ('for (long q = 2; q <= n', '''/*@ loop invariant 2 <= q <= 1025 && 1 <= n <= 1024 && (sign == 1 || sign == -1);
            loop assigns q, n, sign; loop variant n + 1 - q; */ '''),
        ('for (long q = 2, rest = n; q <= rest', '''/*@ loop invariant 2 <= q <= 1025 && 1 <= rest <= 1024 &&
            1 <= count <= n; loop assigns q, rest, count; loop variant rest + 1 - q; */ '''),
        ('while (rest % q == 0)', '''/*@ loop invariant 1 <= rest <= \\at(rest, LoopEntry); loop assigns rest;
            loop variant rest; */ '''),
        ('for (long k = 0; k <= m; k++) c', '''/*@ loop invariant 0 <= k <= m + 1; loop assigns k, c[0 .. m];
            loop variant m + 1 - k; */ '''),
        ('for (long d = 1; d <= m', '''/*@ loop invariant 1 <= d <= m + 1; loop assigns d, c[0 .. m];
            loop variant m + 1 - d; */ '''),
        ('for (long k = m; sign', '''/*@ loop invariant 0 <= d - 1 <= k <= m; loop assigns k, c[0 .. m];
            loop variant k; */ '''),
        ('for (long k = d; sign', '''/*@ loop invariant d <= k <= m + 1; loop assigns k, c[0 .. m];
            loop variant m + 1 - k; */ '''),
        ('c[k] -=', '/*@ admit -1048576 <= c[k] <= 1048576 && -1048576 <= c[k - d] <= 1048576; */ '),
        ('c[k] +=', '/*@ admit -1048576 <= c[k] <= 1048576 && -1048576 <= c[k - d] <= 1048576; */ '),
        ('mpz_set_ui(two, 1);', '''/*@ admit whole(&two[0]) && whole(&k[0]) &&
            \\separated(&two[0], &k[0], value, a); */ '''),
        ('mpz_clear(two);\n  mpz_clear(k)', '/*@ admit whole(&two[0]) && whole(&k[0]); */ '),
        ('  while (a->cosines <= k', '''  /*@ loop invariant cosines(a) && a->cycle == \\at(a->cycle, Pre) &&
            a->cosine == \\at(a->cosine, Pre); loop assigns fits, *a, a->cosine[0 .. 1023];
            loop variant a->cycle - a->cosines; */ '''),
    ],
    'poly': [
        ('for (size_t k = DYD_CERT_LEAVES; k-- > 0;)', '/*@ loop invariant 0 <= k <= 64; loop assigns k; */ '),
        ('for (size_t k = 0; k < DYD_CERT_LEAVES; k++) {\n    out', '''/*@ loop invariant 0 <= k <= 64 &&
            (fits ==> \\forall integer j; 0 <= j < k ==> out->e[j] <= 8192);
            loop assigns k, fits, out->e[0 .. 63]; loop variant 64 - k; */ '''),
        ("for (; **text >= '0'", '''/*@ loop invariant string(*text) && within(*text, \\at(*text, Pre)) && n <= most &&
            *text - \\at(*text, Pre) <= stop(\\at(*text, Pre)); loop assigns n, *text; */ '''),
        ('for (size_t k = leaf;', '/*@ loop invariant leaf <= k <= 64; loop assigns k; loop variant 64 - k; */ '),
        ('memcpy(digits', '''/*@ admit \\separated(digits + (0 .. length), *text + (0 .. stop(*text)), c, text,
            r); */ '''),
        ('mpz_set_str(c, digits', '/*@ assert ends(digits, length); */ '),
        ('for (const char *c = text + 1;', '''/*@ loop invariant n <= c - text && c == text + (c - text) &&
            (*text == 0 ? n == 1 : c - text <= stop(text)) && 1 <= n && 1 <= c - text;
            loop assigns n, c; */ '''),
    ],
    'graph.h': [
        ('while (parent[v] != v)', '''/*@ loop invariant v < SITES && forest(parent);
            loop assigns v, parent[0 .. SITES - 1]; */ '''),
    ],
    'graph': [
        ('for (size_t child;', '''/*@ loop invariant root < count && below(a, count, BOUND);
            loop assigns root, child, a[0 .. count - 1]; loop variant count - root; */ '''),
        ('for (size_t q = count / 2;', '''/*@ loop invariant q <= count / 2 && below(item, count, BOUND);
            loop assigns q, item[0 .. count - 1]; */ '''),
        ('for (size_t last = count;', '''/*@ loop invariant last <= count && below(item, count, BOUND);
            loop assigns last, item[0 .. count - 1]; */ '''),
        (EACH_EDGE + 'if',
         '''/*@ loop invariant e <= g->count; loop assigns e; loop variant g->count - e; */ '''),
        ('if (!parent) return DYD_E_NOMEM;', '''/*@ admit parent == \\null || \\separated(parent + (0 .. SITES - 1), g,
            g->legal, g->bridges, g->sites, g->sites->site + (0 .. SITES - 1),
            g->legal->item + (0 .. g->legal->count - 1), g->bridges->item + (0 .. g->bridges->count - 1)); */ '''),
        ('for (size_t v = 0; v < n; v++) {\n    parent', '''/*@ loop invariant v <= n && parts <= v &&
            (\\forall integer k; 0 <= k < v ==> parent[k] < n);
            loop assigns v, parts, parent[0 .. n - 1]; loop variant n - v; */ '''),
        (EACH_EDGE + 'uint32_t a',
         '''/*@ loop invariant e <= g->count;
            loop invariant joined(g); loop invariant forest(parent);
            loop assigns e, parts, g->redundant, parent[0 .. n - 1]; loop variant g->count - e; */ '''),
        ('for (size_t v = 0; v < g->sites->count; v++)\n    if', '''/*@ loop invariant v <= g->sites->count &&
            (low == DYD_CERT_NONE || low < g->sites->count && g->start[low] < g->start[low + 1]);
            loop assigns v, low; loop variant g->sites->count - v; */ '''),
    ],
    'parts': [
        ('static uint32_t site_on_walk', '''typedef const maker *making;
/*@ requires \\valid_read(m) && joined(m->g) && 0 < m->count && \\valid_read(m->walk + (0 .. m->count - 1)) &&
      (\\forall integer k; 0 <= k < m->count ==> m->walk[k] < 2 * m->g->count);
    assigns \\nothing; exits \\false; ensures \\result < SITES; */
'''),
        ('for (size_t q = 0; q < count; q++)\n    if (kept', '''/*@ loop invariant kept <= q <= count &&
            (0 < q ==> 0 < kept); loop assigns q, kept, item[0 .. count - 1]; loop variant count - q; */ '''),
    ],
    'faces': [
        ('while (*a < f->first', '''/*@ loop assigns *a, *b; */ '''),
        ('for (uint32_t k; (k = next_common_set(f, &a, &b, i, j)) != DYD_CERT_NONE;) f', '''/*@ loop invariant
            indexed(f); loop assigns a, b, k, f->covered[0 .. f->sets - 1]; */ '''),
        ('while (next_common', '/*@ loop assigns a, b, count; */ '),
        ('for (uint32_t k; (k = next_common_set(f, &a, &b, i, j)) != DYD_CERT_NONE;)\n',
         '/*@ loop assigns a, b, k; */ '),
        ('for (size_t k = 0; k < f->sets; k++) {\n    uint64_t', '''/*@ loop invariant k <= f->sets;
            loop assigns k, left; loop variant f->sets - k; */ '''),
        ('for (size_t q = 0; q < count; q++) {\n    uint32_t v', '''/*@ loop invariant q <= count && top <= q &&
            (\\forall integer k; 0 <= k < top ==> stack[k] < SITES); loop assigns q, top, stack[0 .. count - 1];
            loop variant count - q; */ '''),
        ('static bool corner_is_beyond', '''typedef const dyd_cert_parts *group_of;
/*@ requires \\valid_read(s) && s->count == SITES && \\valid_read(corner) && corner->i < SITES && \\valid_read(p) &&
      r < 4294967295 && \\valid_read(p->start + (0 .. r + 1)) && p->start[r + 1] <= 1152921504606846976;
    requires 0 < p->start[r + 1] ==> \\valid_read(p->site + (0 .. p->start[r + 1] - 1));
    requires \\forall integer k; 0 <= k < p->start[r + 1] ==> p->site[k] < SITES;
    assigns \\nothing; exits \\false; */
'''),
        ('for (size_t q = p->start[r]; q', '''/*@ loop assigns q; */ '''),
        ('while (top > 1', '''/*@ assert v < SITES; */ /*@ loop invariant top <= \\at(top, LoopEntry);
            loop assigns top; loop variant top; */ '''),
        ('for (size_t q = 0; q < top', '''/*@ loop invariant q <= top; loop assigns q, hull[0 .. SITES - 1];
            loop variant top - q; */ '''),
    ],
    'algebra_read': [
        ('if (slash) *slash++ = 0;', '/*@ ghost size_t all = length_of(text); */ '),
        ('mpz_set_ui(den, 1);', '''/*@ assert slash != \\null ==> ends(text, slash - 1 - text) &&
            ends(slash, all - (slash - text)); */ '''),
        ('mpz_init(g);\n  mpz_gcd(g, num', '/*@ admit \\separated(&g[0], num, den); */ '),
        ('while (k < DYD_CERT_OPS', '''/*@ loop invariant 0 <= k <= 29; loop assigns k; loop variant 29 - k; */ '''),
    ],
    'pairs': [
        ('for (size_t e = 0; e < c->legal.count', '''/*@ loop invariant e <= c->legal.count; loop assigns e, *b;
            loop variant c->legal.count - e; */ '''),
        ('for (size_t e = 0; e < c->open.count', '''/*@ loop invariant e <= c->open.count; loop assigns e, *b;
            loop variant c->open.count - e; */ '''),
    ],
    'quotient': [
        ('for (size_t t = 0; t < x->num.count; t++) mpz_neg', '''/*@ loop invariant t <= x->num.count &&
            (\\forall integer k; 0 <= k < x->num.count ==> whole(&x->num.term[k].c[0]));
            loop assigns t, x->num.term[0 .. x->num.count - 1].c[0]; loop variant x->num.count - t; */ '''),
    ],
    'distance': [
        ('static dyd_cert_area far_on_grid', '''typedef const grid_box *box_of;
typedef const grid_site *site_of;
/*@ predicate box(box_of b) = \\valid_read(b) && (\\forall integer k; 0 <= k < 4 ==>
      -1152921504606846976 <= b->e[k] <= 1152921504606846976); */
/*@ requires box(q) && \\valid_read(g) && box(&g->box); assigns \\nothing; exits \\false; */
'''),
        ('static dyd_cert_area near_on_grid', '''/*@ requires box(q) && box(b); assigns \\nothing; exits \\false; */
'''),
        ('for (int a = 0; a < 4; a += 2) {', '''/*@ loop invariant a == 0 || a == 2 || a == 4;
            loop assigns a, sum; loop variant 4 - a; */ '''),
    ],
    'still': [
        ('static void movers_clear', '''typedef const movers *moving;
/*@ predicate moves(moving m) = \\valid_read(m) && (0 < SITES ==> \\valid_read(m->movable + (0 .. SITES - 1))) &&
      \\valid(m->start + (0 .. SITES + 1)) && \\separated(m, m->start + (0 .. SITES + 1)); */
'''),
        ('static void movers_count', '''/*@ requires moves(m) && pairs(edges, SITES) &&
      \\separated(m->start + (0 .. SITES + 1), m->movable + (0 .. SITES - 1), edges,
      edges->item + (0 .. edges->count - 1)); assigns m->start[0 .. SITES + 1]; exits \\false; */
'''),
        ('static size_t movers_of', '''/*@ requires moves(m) && i < SITES && \\valid(of) &&
      \\separated(of, m, m->start + (0 .. SITES + 1)) && m->start[i] <= 2147483648 &&
      \\valid_read(m->of + (0 .. m->start[i])) && m->start[i] <= m->start[i + 1]; assigns *of; exits \\false; */
'''),
        ('static bool is_in_a_pair', '''/*@ requires \\valid_read(c) && pairs(&c->legal, SITES) &&
      pairs(&c->open, SITES); assigns \\nothing; exits \\false; */
'''),
        ('for (size_t e = 0; e < edges->count; e++) {\n    const dyd_cert_edge *p = &edges->item[e];\n'
         '    if (m->movable[p->j]) m->start',
         '''/*@ loop invariant e <= edges->count; loop assigns e, m->start[0 .. SITES + 1];
            loop variant edges->count - e; */ '''),
    ],
    'diagram': [
        ('for (size_t k = 0; k < p->points; k++) {', '''/*@ loop invariant k <= p->points && begins <= k;
            loop assigns k, begins; loop variant p->points - k; */ '''),
        ('for (int a = 0; a < 2; a++)\n    if (dyd_exact_cmp', '''/*@ loop invariant 0 <= a <= 2; loop assigns a;
            loop variant 2 - a; */ '''),
    ],
    'read': [
        ('while (*p', '''/*@ loop invariant 0 <= p - text <= stop(text) && p == text + (p - text);
            loop assigns p; loop variant stop(text) - (p - text); */ '''),
        ('while (length', '''/*@ loop invariant reads_on(r, \\at(r->in, Pre), \\at(r->err, Pre)) &&
            -1 <= c <= 255 && length + 1 <= r->cap; loop assigns length, c, r->line[0 .. r->cap - 1], *r->in; */ '''),
        ('for (;;) {\n    if (!dyd_reserve', '''/*@ loop invariant length <= r->cap &&
            reads_on(r, \\at(r->in, Pre), \\at(r->err, Pre));
            */ '''),
        ('*out = r->at;', '/*@ ghost size_t all = length_of(r->at); */ '),
        ('if (blank) *blank = 0;', '/*@ assert blank != \\null ==> ends(r->at, all - (blank + 1 - *out)); */ '),
        ('return **out ?', '''/*@ assert blank != \\null ==> ends(*out, blank - *out) &&
            ends(r->at, all - (blank + 1 - *out)); */ '''),
        ('*out = strtoll', '/*@ assert ends(text, end - text); */ '),
        ('if (strncmp', '/*@ assert ends(end, stop(text) - (end - text)); */ '),
        ('if (mpz_set_str(out->man, text', '/*@ assert ends(text, end - text); */ '),
        ('word[length] = 0;', '''/*@ ghost size_t all = length_of(word); */
            /*@ assert kind != 0 ==> ends(word + length + 1, all - length - 1); */ '''),
        ('if (!scan_number(&out->lo', '''/*@ assert ends(word, length) &&
            (kind != 0 ==> ends(word + length + 1, all - length - 1)); */ '''),
        ('out->point =', '''/*@ assert kind != 0 ==> ends(word + length + 1, all - length - 1); */'''),
        ('r->line[length] = 0;', '''/*@ admit \\separated(r->line + (0 .. r->cap - 1), r, r->err, r->in); */ '''),
        ('dyd_status st =\n      good', '/*@ admit whole(&den[0]) && whole(&g[0]); */ '),
        ('mpz_clears(den', '/*@ admit whole(&den[0]) && whole(&g[0]); */ '),
        ('dyd_exact_add(&out->hi', '/*@ admit certified(&out->lo) && certified(&width); */ '),
        ('dyd_exact_clear(&width)', '/*@ admit whole(&width.man[0]); */ '),
        ('if (strlen(r->line)', '/*@ assert ends(r->line, length); */ '),
    ],
}
FAULTS = [  # file, function, what is there, what takes its place
    ('dyadic', 'dyd_dyadic_take', 'if (exp > DYD_EXP_LIMIT || exp + dyd_bits', 'if (exp + dyd_bits'),
    ('dyadic', 'dyd_dyadic_mul_2exp', '    if (e > 2 * DYD_EXP_LIMIT || e < -2 * DYD_EXP_LIMIT) return DYD_E_RANGE;\n',
     ''),
    ('dyadic', 'cmp_aligned', 'bool shift_x = x->exp > y->exp;', 'bool shift_x = x->exp < y->exp;'),
    ('convert', 'dyd_dyadic_round', '  if (exp > DYD_EXP_LIMIT) exp = DYD_EXP_LIMIT;\n', ''),
    ('exact', 'exact_combine', 'x->exp > y->exp ? x : y', 'x->exp < y->exp ? x : y'),
    ('exact', 'exact_divide', 'if (den) up', 'up'),
    ('exact', 'dyd_exact_top', 'mpz_sgn(x->man) ? x->exp', 'true ? x->exp'),
    ('tree', 'near_lower', 'int64_t left = b->e[a] - c->e[a + 1]', 'int64_t left = b->e[a] - c->e[a + 2]'),
    ('read', 'scan_decimal', "*p >= '0' && *p <= '9'", "*p != ' '"),
    ('measure', 'turn_on_grid', 'int64_t det = x * t - y * z,', 'int64_t det = 4 * x * t - y * z,'),
    ('tree', 'dyd_cert_far_upper', 'dyd_cert_square(left > right ? left : right)', 'dyd_cert_square(4 * left)'),
    ('alloc', 'dyd_alloc', '  if (size && count > SIZE_MAX / size) return NULL;\n', ''),
    ('alloc', 'dyd_reserve', '  if (want > SIZE_MAX / size) return false;\n', ''),
    ('alloc', 'dyd_reserve', '  if (want < need) want = need;\n', ''),
    ('text', 'dyd_dyadic_get_str', 'mpz_sizeinbase(t, 10) + 40', 'mpz_sizeinbase(t, 10) + 20'),
    ('text', 'dyd_dyadic_set_str', 'malloc(strlen(text) + 1)', 'malloc(strlen(text))'),
    ('text', 'text_read_exponent', 'if (e < HUGE_EXPONENT) e', 'e'),
    ('text', 'text_read', 'r->at += 2', 'r->at += 3'),
    ('read', 'dyd_cert_next_line', 'while (length + 1 < r->cap', 'while (length < r->cap'),
    ('read', 'scan_small', 'end - text > 18', 'end - text > 19'),
    ('read', 'dyd_cert_read_index', 'if ((uint64_t)value > most)', 'if ((uint64_t)value > most + 1)'),
    ('read', 'dyd_cert_word', 'blank + 1', 'blank + 2'),
    ('read', 'dyd_cert_read_side', "if (kind == 0) return DYD_OK;", ''),
    ('poly', 'scan_coefficient', 'dyd_alloc(length + 1, 1)', 'dyd_alloc(length, 1)'),
    ('poly', 'scan_power', 'for (size_t k = leaf; k < DYD_CERT_LEAVES', 'for (size_t k = leaf; k <= DYD_CERT_LEAVES'),
    ('poly', 'scan_unsigned', '    if (n > most) return 0;\n', ''),
    ('poly', 'count_terms', 'for (const char *c = text + 1; *text && *c', 'for (const char *c = text + 1; *c'),
    ('graph', 'sift_down', 'if (child + 1 < count', 'if (child < count'),
    ('graph', 'dyd_cert_edges_add', 'edges->count + 1, sizeof', 'edges->count, sizeof'),
    ('graph', 'find_connected', 'dyd_alloc(n, sizeof *parent)', 'dyd_alloc(n / 2, sizeof *parent)'),
    ('graph', 'dyd_cert_graph_init', '  if (g->count >= UINT32_MAX / 4) return DYD_E_NOMEM;\n', ''),
    ('sites', 'dyd_cert_sites_add', 's->count + 1, sizeof', 's->count, sizeof'),
    ('sites', 'dyd_cert_sites_add', 's->count >= DYD_CERT_NONE || ', ''),
    ('sites', 'dyd_cert_site_set_place', 'malloc(2 * sizeof', 'malloc(sizeof'),
    ('chain', 'dyd_cert_chain_resize', 'points + 64', 'points + 32'),
    ('checker', 'dyd_cert_read_site', 'dyd_cert_read_index(out, &c->in, c->sites.count - 1)',
     'dyd_cert_read_index(out, &c->in, c->sites.count)'),
    ('checker', 'dyd_cert_read_pair', '  if (next.i >= next.j) return', '  if (next.i > next.j) return'),
    ('checker', 'corners_add', 'c->count + 1, sizeof', 'c->count, sizeof'),
    ('tree', 'fill_level', 'children + DYD_CERT_FANOUT - 1', 'children + 2 * DYD_CERT_FANOUT'),
    ('tree', 'tree_child', 't->start[level - 1] + q', 't->start[level] + q'),
    ('algebra', 'dyd_cert_algebra_leaf', 'count == DYD_CERT_LEAVES', 'count > DYD_CERT_LEAVES'),
    ('algebra_bound', 'tower_degree', ' || degree > (unsigned long)DYD_CERT_PRECISION / r->degree', ''),
    ('algebra_bound', 'tower_degree', 'bool uses[DYD_CERT_LEAVES]', 'bool uses[DYD_CERT_LEAVES - 1]'),
    ('bracket', 'longest_of', 'r->coeff[k], 2', 'r->coeff[k + 1], 2'),
    ('cycle', 'moebius', 'n /= q;\n    if', 'n /= q - 2;\n    if'),
    ('cycle', 'cyclotomic', 'k = m; sign > 0 && k >= d', 'k = m; sign > 0 && k >= d - 1'),
    ('cycle', 'extend_cosines', 'while (a->cosines <= k', 'while (a->cosines <= k + 1'),
    ('cycle', 'dyd_cert_cycle_cosine', 'if (order - at < at) at = order - at', 'if (order - at < at) at = order + at'),
    ('ties', 'find_described', 'hi = b->points', 'hi = b->points + 1'),
    ('ties', 'read_count', 'dyd_cert_read_index(count, in, most)', 'dyd_cert_read_index(count, in, most + 1)'),
    ('ties', 'read_point', 'if (st == DYD_OK && b->points && d[-1]', 'if (st == DYD_OK && d[-1]'),
    ('boxes', 'region_part', 'out->corner[1 - k][a]', 'out->corner[4 - k][a]'),
    ('boxes', 'square_region', 'r.corner[c][1] = y', 'r.corner[c + 1][1] = y'),
    ('boxes', 'far_from_corner', 'b->e[2 * a + 1] - c[a]', 'b->e[2 * a + 3] - c[a]'),
    ('parts', 'site_on_walk', 'm->walk[q % m->count]', 'm->walk[q]'),
    ('parts', 'dyd_cert_distinct', 'item[kept - 1] != item[q]', 'item[kept - 2] != item[q]'),
    ('faces', 'next_common_set', 'uint32_t x = f->of[*a]', 'uint32_t x = f->of[*a + 1]'),
    ('faces', 'mark_hull_chain', 'stack[top - 2]', 'stack[top - 3]'),
    ('faces', 'corner_is_beyond', 'q < p->start[r + 1]', 'q <= p->start[r + 1]'),
    ('number', 'is_leaf_of', 'of = a->number[a->leaf[k].number]', 'of = a->number[a->leaf[k].number + 1]'),
    ('number', 'value_makes_leaf', 'k == DYD_CERT_LEAVES || !value_is_leaf', '!value_is_leaf'),
    ('number', 'make_angle', '  if (s == DYD_CERT_LEAVES) return DYD_CERT_LEAVES;\n', ''),
    ('algebra_read', 'read_operand', '  if (!a->count) return dyd_cert_reject(in, "there is no number before");\n', ''),
    ('algebra_read', 'read_op', 'dyd_cert_op_name((dyd_cert_op)k)',
     'dyd_cert_op_name((dyd_cert_op)(k + 1))'),
    ('pairs', 'add_all_pairs', 'c->open.item[e].i,', 'c->open.item[e + 1].i,'),
    ('quotient', 'dyd_cert_quotient_neg', 'mpz_neg(x->num.term[t].c,', 'mpz_neg(x->num.term[t + 1].c,'),
    ('enclosure', 'dyd_cert_enclosure_set_q', 'mpz_cdiv_q(x->hi, x->lo, den)', 'mpz_cdiv_q(x->hi, x->lo, x->hi)'),
    ('inverse', 'is_narrower', 'mpz_sub(wide, x->hi, x->lo)', 'mpz_sub(wide, x->hi, x[1].lo)'),
    ('distance', 'far_on_grid', 'right = g->box.e[a + 1]', 'right = g->box.e[a + 3]'),
    ('distance', 'near_on_grid', 'q->e[a + 1], right', 'q->e[2 * a + 1], right'),
    ('still', 'movers_count', 'm->start[p->i + 2]++', 'm->start[p->i + 3]++'),
    ('diagram', 'polygon_goes_on', '(k + 1) % p->points', '(k + 1)'),
]
ITEMS = {'start': 'sizes', 'term': 'terms', 'digits': 'chars', 'den': 'numbers', 'place': 'places'}  # of lists, by name
EXTRA = {'alloc': ['-warn-unsigned-overflow'], 'text': ['-wp-literals'], 'poly': ['-wp-literals'],
         'read': ['-wp-literals', '-no-warn-signed-downcast']}  # a byte becomes a char
OPTIONS = ['-wp', '-wp-rte', '-warn-special-float', 'none',  # doubles are another matter
           '-warn-signed-downcast', '-warn-unsigned-downcast', '-wp-prover', 'cvc4', '-wp-par', '1', '-wp-status-all']
MOST, FEW, SLOW = 20, 4, 2  # seconds for a goal, for one with a fault; of one that is slow


def goals(root, name, folders, options, until=lambda name: False):
    """(goals, names of those that are not proved) of a file, and the output, which ends at a goal that is not proved
    and `until` holds of. Only what is in the current folder comes before Frama-C's own headers."""
    here = root / 'proofs' / 'overflow'
    where = ' '.join(f'-I{f}' for f in ['.', *folders, root / 'src', root / 'include'])
    output = ''
    call = ['frama-c', f'-cpp-extra-args={where}', *OPTIONS, *EXTRA.get(name, []), *options, f'{name}.c']
    with subprocess.Popen(call, cwd=here, env={**os.environ, 'PWD': str(here)}, stdout=subprocess.PIPE,
                          start_new_session=True, stderr=subprocess.STDOUT, encoding='utf-8', errors='replace') as run:
        for line in run.stdout:
            output += line
            failed = re.search(r'Goal typed_(\w+) : (?!Valid)', line)
            if failed and until(failed[1]):
                os.killpg(run.pid, signal.SIGKILL)
                return 1, {failed[1]}, output
    sums = re.search(r'Proved goals: +(\d+) / (\d+)', output)
    open_goals = set(re.findall(r'Goal typed_(\w+) : (?!Valid)', output))
    if not sums or run.returncode or int(sums[2]) - int(sums[1]) != len(open_goals):
        return 0, {'all'}, output
    return int(sums[2]), open_goals, output


def with_loops(name, text):
    """The text with what holds in its loops, in the terms of overflow/lists.h."""
    for what, by in LOOPS.get(name, []):
        if what not in text:
            sys.exit(f'{name}: there is no loop {what!r}')
        text = text.replace(what, by + what)
    text = re.sub(r'dyd_reserve\(\(void \*\*\)&c->(blocker|point),', r'reserve_\1s(&c->\1,', text)
    text = text.replace('(void **)', '')
    text = re.sub(r'(\w+) = dyd_alloc\(', lambda m: f'{m[1]} = alloc_{ITEMS.get(m[1], "indices")}(', text)
    text = re.sub(r'(\w+) = malloc\((?:(\d+) \* )?(sizeof [^()]*)\)',
                  lambda m: f'{m[1]} = alloc_{ITEMS[m[1]]}({m[2] or 1}, {m[3]})', text)
    return re.sub(r'\ndyd_status dyd_cert_reject\(.*?\n}\n', '\n', text, flags=re.S)  # of any number of arguments


def copied(root, work, name, old='', new=''):
    """The source with what holds in its loops, and a fault, in a folder that comes before src."""
    folder = FILES[name][0]
    text = (root / 'src' / folder / (name + ('.h' if name == 'alloc' else '.c'))).read_text(encoding='utf-8')
    for what, by in [(old, new)] if old else []:
        if text.count(what) != 1:
            sys.exit(f'{name}: {what!r} is not there once')
        text = text.replace(what, by)
    (work / folder).mkdir(exist_ok=True)
    (work / folder / f'{name}.c').write_text(with_loops(name, text), encoding='utf-8')
    if f'{name}.h' in LOOPS:
        text = (root / 'src' / folder / f'{name}.h').read_text(encoding='utf-8')
        (work / folder / f'{name}.h').write_text(with_loops(f'{name}.h', text), encoding='utf-8')
    return work / folder


def try_file(root, work, name):
    _, left_out, only = FILES[name]
    options = ['-wp-timeout', str(MOST)] + (['-wp-skip-fct', ','.join(left_out)] if left_out else [])
    options += ['-wp-fct', ','.join(only)] if only else []
    copy = copied(root, work, name)
    count, left, output = goals(root, name, [work], options)
    shutil.rmtree(copy)
    print(f'{name}: {count - len(left)} of {count} goals proved', *left_out and ['without', *left_out],
          *only and ['of', *only], *left and ['but', *sorted(left)], flush=True)
    slow = {goal for goal, seconds in re.findall(r'Goal typed_(\w+) : Valid .*\(([0-9.]+)s\)', output)
            if float(seconds) > SLOW} | set(UNPROVED)
    if count and left <= set(UNPROVED):
        return slow
    print(output)
    return None


def try_fault(root, work, slow, name, function, old, new):
    copy = copied(root, work, name, old, new)
    count, left, output = goals(root, name, [work], ['-wp-timeout', str(FEW), '-wp-fct', function],
                                lambda goal: goal not in slow)
    shutil.rmtree(copy)
    noticed = count > 0 and bool(left - slow)
    print(f'fault in {function}, {old.strip()!r}:', f'not proved {min(left - slow)}' if noticed else output, flush=True)
    return noticed


def main():
    if not all(shutil.which(tool) for tool in ('frama-c', 'why3', 'cvc4')):
        print('needs frama-c, why3 and cvc4 (packages frama-c-base, cvc4)')
        sys.exit(77)
    root = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as work:
        os.environ['WHY3CONFIG'] = os.path.join(work, 'why3.conf')
        subprocess.run(['why3', 'config', 'detect'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        names = PARTS[sys.argv[2]] if len(sys.argv) > 2 else list(FILES)
        slow = {name: try_file(root, pathlib.Path(work), name) for name in names}
        good = [try_fault(root, pathlib.Path(work), slow[fault[0]] or set(), *fault) for fault in FAULTS
                if fault[0] in names]
    sys.exit(None in slow.values() or not all(good))


main()
