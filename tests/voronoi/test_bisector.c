/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points A + B sqrt(C), bisectors, partial centres and discs: [ARC-1] [BIS-1] [CEN-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "predicate/circle.h"
#include "rect/rect.h"
#include "voronoi/region_oracle.h"
#include "voronoi/surd_point.h"
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

/* ---- points ---- */

static void set_random(mpz_t z, test_random *r, bool positive) {
  mpz_set_si(z, (long)test_between(r, positive ? 0 : -40, 40));
  if (test_chance(r, 3)) mpz_mul_2exp(z, z, (mp_bitcnt_t)test_below(r, 200));
  if (test_chance(r, 3)) mpz_add_ui(z, z, (unsigned long)test_below(r, 3));
}

static void random_point(dyd_surd_point *s, test_random *r) {
  set_random(s->ax, r, false);
  set_random(s->bx, r, false);
  set_random(s->ay, r, false);
  set_random(s->by, r, false);
  set_random(s->c, r, true);
  set_random(s->d, r, true);
  mpz_add_ui(s->d, s->d, 1);
}

/* lo <= t <= hi, multiples of 2^-bits, next to one another or equal to t. */
static void check_enclosure(orc_pool *p, const dyd_interval *side, orc_alg t, int64_t bits) {
  mpq_ptr lo = orc_new(p), hi = orc_new(p), unit = orc_new(p);
  dyd_interval_get_q(lo, hi, side);
  int below = orc_alg_cmp_q(p, t, lo), above = orc_alg_cmp_q(p, t, hi);
  assert_true(below >= 0 && above <= 0);
  mpq_set_ui(unit, 1, 1);
  if (bits >= 0)
    mpq_div_2exp(unit, unit, (mp_bitcnt_t)bits);
  else
    mpq_mul_2exp(unit, unit, (mp_bitcnt_t)-bits);
  assert_true(!mpz_cmp_ui(mpq_denref(orc_div(p, lo, unit)), 1));
  mpq_srcptr width = orc_sub(p, hi, lo);
  assert_true(below == 0 ? mpq_sgn(width) == 0 : mpq_equal(width, unit));
}

static void enclosures(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "surd enclosures");
  dyd_surd_point s;
  dyd_rect r;
  dyd_surd_point_init(&s);
  dyd_rect_init(&r);
  for (size_t k = 0; k < test_cases(3000); k++) {
    size_t mark = orc_mark(&h.pool);
    random_point(&s, &h.random);
    int64_t bits = test_between(&h.random, -20, 150);
    assert_int_equal(dyd_surd_point_enclose(&r, &s, bits), DYD_OK);
    orc_point at = region_point(&h.pool, &s);
    check_enclosure(&h.pool, &r.x, at.x, bits);
    check_enclosure(&h.pool, &r.y, at.y, bits);
    orc_release(&h.pool, mark);
  }
  assert_int_equal(dyd_surd_point_enclose(&r, &s, DYD_EXP_LIMIT + 1), DYD_E_RANGE);
  assert_int_equal(dyd_surd_point_enclose(&r, &s, INT64_MIN), DYD_E_RANGE);
  dyd_rect_clear(&r);
  dyd_surd_point_clear(&s);
  harness_clear(&h);
}

/* p = p * man * 2^exp. */
static void surd_point_scale(dyd_surd_point *p, mpz_srcptr man, int64_t exp) {
  mpz_ptr part[4] = {p->ax, p->bx, p->ay, p->by};
  for (int k = 0; k < 4; k++) {
    mpz_mul(part[k], part[k], man);
    dyd_shift_up(part[k], exp);
  }
  dyd_shift_up(p->d, -exp);
}

/* dyd_surd_point_side of rectangles that have a scale of their own. */
static int compare_distances(const dyd_surd_point *p, const dyd_rect *a, dyd_touch ta, const dyd_rect *b,
                             dyd_touch tb) {
  const dyd_rect *in[2] = {a, b};
  int64_t exp;
  DYD_LOCAL_NUMBERS(mpz, man);
  DYD_LOCAL_ARRAY(dyd_irect, r, [2]);
  DYD_LOCAL(dyd_surd_point, q);
  dyd_irects_scale(r, in, 2, man, &exp);
  dyd_surd_point_set(&q, p);
  surd_point_scale(&q, man, exp);
  return dyd_surd_point_side(&q, &r[0], ta, &r[1], tb);
}

static void comparisons(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "surd comparisons");
  dyd_surd_point s;
  dyd_rect r[2];
  orc_case c;
  dyd_surd_point_init(&s);
  orc_case_init(&c);
  for (int k = 0; k < 2; k++) dyd_rect_init(&r[k]);
  for (size_t k = 0; k < test_cases(3000); k++) {
    size_t mark = orc_mark(&h.pool);
    orc_generate(&c, &h.random, k % ORC_KINDS, 3);
    random_point(&s, &h.random);
    orc_point at = region_point(&h.pool, &s);
    for (int m = 0; m < 2; m++) harness_rect(&r[m], &c.rect[m]);
    for (int touch = 0; touch < 4; touch++) {
      orc_alg a = touch & 1 ? orc_dl2(&h.pool, at, &c.rect[0]) : orc_ds2(&h.pool, at, &c.rect[0]);
      orc_alg b = touch & 2 ? orc_dl2(&h.pool, at, &c.rect[1]) : orc_ds2(&h.pool, at, &c.rect[1]);
      assert_int_equal(compare_distances(&s, &r[0], (dyd_touch)(touch & 1), &r[1], (dyd_touch)(touch >> 1)),
                       orc_alg_cmp(&h.pool, a, b));
    }
    orc_release(&h.pool, mark);
  }
  for (int k = 0; k < 2; k++) dyd_rect_clear(&r[k]);
  orc_case_clear(&c);
  dyd_surd_point_clear(&s);
  harness_clear(&h);
}

/* ---- bisectors ---- */

/* Arcs, ends, at most seven of them in one chain, and sides of points near the arcs. */
static bool check_bisector(char *message, harness *h, const orc_case *c) {
  if (c->n < 2) return true;
  orc_pool *p = &h->pool;
  orc_case two;
  orc_case_init(&two);
  for (int k = 0; k < 2; k++) orc_case_add_rect(&two, &c->rect[k]);
  dyd_rect r[2];
  for (int k = 0; k < 2; k++) {
    dyd_rect_init(&r[k]);
    harness_rect(&r[k], &two.rect[k]);
  }
  dyd_boundary b = {0};
  dyd_status st = dyd_bisector(&b, &r[0], &r[1]);
  region g = {&b, &two, false, NULL};
  bool apart = !orc_rect_meets(&two.rect[0], &two.rect[1]), good = true;
  if (st != DYD_OK || b.count != (apart ? 1 : 0) || b.whole)
    good = wrong(message, "status %d, %zu chains", st, b.count);
  if (good && apart && (b.chain[0].closed || b.chain[0].count > 7)) good = wrong(message, "%zu arcs", b.chain[0].count);
  good = good && region_is_sound(message, p, &g, 0);
  for (size_t k = 0; good && apart && k < b.chain[0].count; k++) {
    orc_point at = region_sample(p, &g, &b.chain[0].arc[k]);
    for (int d = 0; d < 4 && good; d++) {
      mpq_srcptr step = orc_si(p, d & 1 ? 1 : -1, 1ul << test_below(&h->random, 40));
      mpq_srcptr x = d < 2 ? orc_add(p, at.x.a, step) : at.x.a, y = d < 2 ? at.y.a : orc_add(p, at.y.a, step);
      int side = region_side(p, &g, x, y),
          literal = literal_side(p, &g, 0, (orc_point){orc_alg_q(p, x), orc_alg_q(p, y)});
      if (side != literal && side != 2) good = wrong(message, "side %d instead of %d", side, literal);
    }
  }
  dyd_boundary_clear(&b);
  for (int k = 0; k < 2; k++) dyd_rect_clear(&r[k]);
  orc_case_clear(&two);
  return good;
}

static void random_bisectors(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "bisectors");
  harness_run_cases(&h, 3, test_cases(1500), check_bisector);
  harness_clear(&h);
}

/* All pairs of the rectangles with corners on {0,1,2,3} x {0,1,2,3}, up to a stride. */
static void small_bisectors(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "small bisectors");
  orc_case c;
  orc_case_init(&c);
  size_t step = 1 + 40 / test_cases(4), number = 0;
  for (long a = 0; a < 256; a++)
    for (long b = 0; b < 256; b++) {
      long x0 = a & 3, x1 = a >> 2 & 3, y0 = a >> 4 & 3, y1 = a >> 6, u0 = b & 3, u1 = b >> 2 & 3, v0 = b >> 4 & 3,
           v1 = b >> 6;
      if (x0 > x1 || y0 > y1 || u0 > u1 || v0 > v1 || number++ % step) continue;
      c.n = 0;
      strcpy(c.kind, "small");
      orc_case_add(&c, x0, x1, y0, y1, 1);
      orc_case_add(&c, u0, u1, v0, v1, 1);
      harness_run(&h, &c, check_bisector);
    }
  orc_case_clear(&c);
  harness_clear(&h);
}

static void kinds_of(char out[10], const double a[4], const double b[4]) {
  dyd_rect r[2];
  dyd_boundary o = {0};
  for (int k = 0; k < 2; k++) dyd_rect_init(&r[k]);
  dyd_rect_set_d(&r[0], a[0], a[1], a[2], a[3]);
  dyd_rect_set_d(&r[1], b[0], b[1], b[2], b[3]);
  assert_int_equal(dyd_bisector(&o, &r[0], &r[1]), DYD_OK);
  size_t n = o.count ? o.chain[0].count : 0;
  for (size_t k = 0; k < n; k++) out[k] = o.chain[0].arc[k].kind == DYD_ARC_LINE ? 'b' : 'p';
  out[n] = 0;
  dyd_boundary_clear(&o);
  for (int k = 0; k < 2; k++) dyd_rect_clear(&r[k]);
}

/* The kinds of arcs in the order of KEL figure 4, and the kinds that remain for points and segments. */
static void structure(void **state) {
  (void)state;
  char kinds[10];
  kinds_of(kinds, (double[]){5, 6, 3, 5}, (double[]){0, 2, 0, 1});
  assert_string_equal(kinds, "bpbbbpb");
  kinds_of(kinds, (double[]){0, 1, 0, 2}, (double[]){3, 5, 5, 6});
  assert_string_equal(kinds, "bppbbpb"); /* bisector, parabola, parabola, bisector, bisector, parabola, bisector */
  kinds_of(kinds, (double[]){0, 1, 0, 2}, (double[]){-4, -2, 5, 6}); /* its mirror image */
  assert_string_equal(kinds, "bpbbppb");
  kinds_of(kinds, (double[]){0, 0, 0, 0}, (double[]){3, 3, 5, 5});
  assert_string_equal(kinds, "b");
  kinds_of(kinds, (double[]){0, 0, 0, 0}, (double[]){3, 4, 5, 6});
  assert_string_equal(kinds, "bpbpb");
  kinds_of(kinds, (double[]){0, 0, 0, 0}, (double[]){-3, 4, 5, 5});
  assert_string_equal(kinds, "bpb");
  kinds_of(kinds, (double[]){0, 1, 0, 1}, (double[]){3, 3, 5, 5});
  assert_string_equal(kinds, "bbb");
}

/* ---- partial centres and discs ---- */

/* The circumcentre of three points (lower corners); false when they are collinear. */
static bool circumcentre(mpq_srcptr out[2], orc_pool *p, const orc_case *c) {
  mpq_srcptr n[2][2], s[2];
  for (int k = 0; k < 2; k++) {
    mpq_srcptr sum[2];
    for (int a = 0; a < 2; a++) {
      n[k][a] = orc_sub(p, c->rect[k + 1].e[2 * a], c->rect[0].e[2 * a]);
      sum[a] = orc_mul(p, n[k][a], orc_add(p, c->rect[k + 1].e[2 * a], c->rect[0].e[2 * a]));
    }
    s[k] = orc_mid(p, sum[0], sum[1]);
  }
  mpq_srcptr d = orc_sub(p, orc_mul(p, n[0][0], n[1][1]), orc_mul(p, n[0][1], n[1][0]));
  if (!mpq_sgn(d)) return false;
  out[0] = orc_div(p, orc_sub(p, orc_mul(p, s[0], n[1][1]), orc_mul(p, s[1], n[0][1])), d);
  out[1] = orc_div(p, orc_sub(p, orc_mul(p, n[0][0], s[1]), orc_mul(p, n[1][0], s[0])), d);
  return true;
}

/* Each centre: F-rectangles have dl, C-rectangles ds equal to the one radius. */
static void check_centres(orc_pool *p, const orc_case *c, const dyd_surd_point centre[6]) {
  for (int k = 0; k < 6; k++) {
    orc_point at = region_point(p, &centre[k]);
    orc_alg r[3];
    for (int m = 0; m < 3; m++) {
      bool far = (m == k % 3) == (k < 3);
      r[m] = far ? orc_dl2(p, at, &c->rect[m]) : orc_ds2(p, at, &c->rect[m]);
    }
    assert_true(!orc_alg_cmp(p, r[0], r[1]) && !orc_alg_cmp(p, r[0], r[2]));
  }
}

/* Holds all six, and each end is within 2^-bits of one. */
static void check_box(orc_pool *p, const dyd_rect *box, const dyd_surd_point centre[6], int64_t bits) {
  mpq_ptr e[4] = {orc_new(p), orc_new(p), orc_new(p), orc_new(p)};
  dyd_interval_get_q(e[0], e[1], &box->x);
  dyd_interval_get_q(e[2], e[3], &box->y);
  mpq_ptr unit = orc_new(p);
  mpq_set_ui(unit, 1, 1);
  mpq_div_2exp(unit, unit, (mp_bitcnt_t)bits);
  for (int m = 0; m < 4; m++) {
    bool reached = false;
    for (int k = 0; k < 6; k++) {
      orc_point at = region_point(p, &centre[k]);
      orc_alg t = m < 2 ? at.x : at.y;
      int side = orc_alg_cmp_q(p, t, e[m]);
      assert_true(m & 1 ? side <= 0 : side >= 0);
      mpq_srcptr inner = m & 1 ? orc_sub(p, e[m], unit) : orc_add(p, e[m], unit);
      int within = orc_alg_cmp_q(p, t, inner);
      reached = reached || (m & 1 ? within >= 0 : within <= 0);
    }
    assert_true(reached);
  }
}

/* Circles of random choices: centres in the box, and the point c on the side that the disc states. */
static size_t check_choices(harness *h, const orc_case *c, const dyd_rect *box, const dyd_point *at, dyd_truth side) {
  orc_pool *p = &h->pool;
  orc_case choice;
  orc_case_init(&choice);
  mpq_ptr q[2] = {orc_new(p), orc_new(p)}, e[4] = {orc_new(p), orc_new(p), orc_new(p), orc_new(p)};
  dyd_dyadic_get_q(q[0], &at->x);
  dyd_dyadic_get_q(q[1], &at->y);
  dyd_interval_get_q(e[0], e[1], &box->x);
  dyd_interval_get_q(e[2], e[3], &box->y);
  size_t inside = 0;
  for (int k = 0; k < 12; k++) {
    mpq_srcptr o[2];
    orc_choose(&choice, &h->random, c, 3);
    if (!circumcentre(o, p, &choice)) continue;
    for (int m = 0; m < 2; m++) assert_true(mpq_cmp(o[m], e[2 * m]) >= 0 && mpq_cmp(o[m], e[2 * m + 1]) <= 0);
    orc_point centre = {orc_alg_q(p, o[0]), orc_alg_q(p, o[1])};
    orc_alg d = orc_alg_add(p, orc_alg_sqr(p, orc_alg_sub_q(p, centre.x, q[0])),
                            orc_alg_sqr(p, orc_alg_sub_q(p, centre.y, q[1])));
    int s = orc_alg_cmp(p, orc_ds2(p, centre, &choice.rect[0]), d); /* 1: q is inside */
    inside += s > 0;
    if (side != DYD_UNKNOWN) assert_int_equal(s, side);
    if (orc_case_all_points(c)) assert_int_equal(s, side);
  }
  orc_case_clear(&choice);
  return inside;
}

/* TRUE: inside of the partial disc; FALSE: outside. */
static dyd_truth disc_side(const dyd_partial_disc *disc, const dyd_point *at) {
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_interval_set_ends(&r.x, &at->x, &at->x);
  dyd_interval_set_ends(&r.y, &at->y, &at->y);
  dyd_sure con = dyd_partial_disc_con(disc, &r);
  dyd_rect_clear(&r);
  return con == DYD_SURE_PLUS ? DYD_TRUE : con == DYD_SURE_MINUS ? DYD_FALSE : DYD_UNKNOWN;
}

static void check_disc(harness *h, const orc_case *c, const dyd_rect r[3], size_t count[3]) {
  dyd_surd_point centre[6];
  dyd_rect box;
  dyd_partial_disc disc;
  dyd_point at;
  for (int k = 0; k < 6; k++) dyd_surd_point_init(&centre[k]);
  dyd_rect_init(&box);
  dyd_partial_disc_init(&disc);
  dyd_point_init(&at);
  dyd_status st = dyd_partial_centre(centre, &r[0], &r[1], &r[2]);
  int64_t bits = test_between(&h->random, 0, 300);
  assert_int_equal(dyd_partial_centre_enclose(&box, &r[0], &r[1], &r[2], bits), st);
  dyd_partial_disc_set(&disc, &r[0], &r[1], &r[2]);
  assert_int_equal(st, dyd_orientation(&r[0], &r[1], &r[2]) ? DYD_OK : DYD_E_ARG);
  assert_int_equal(disc.known, st == DYD_OK);
  dyd_dyadic_set_si_2exp(&at.x, (long)test_between(&h->random, -100, 200), -3);
  dyd_dyadic_set_si_2exp(&at.y, (long)test_between(&h->random, -100, 200), -3);
  dyd_truth side = disc_side(&disc, &at);
  count[side + 1]++;
  if (st == DYD_OK) {
    check_centres(&h->pool, c, centre);
    check_box(&h->pool, &box, centre, bits);
    check_choices(h, c, &box, &at, side);
  } else {
    assert_int_equal(side, DYD_UNKNOWN);
  }
  dyd_point_clear(&at);
  dyd_partial_disc_clear(&disc);
  dyd_rect_clear(&box);
  for (int k = 0; k < 6; k++) dyd_surd_point_clear(&centre[k]);
}

static void discs(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "partial discs");
  orc_case c;
  orc_case_init(&c);
  dyd_rect r[3];
  for (int k = 0; k < 3; k++) dyd_rect_init(&r[k]);
  size_t count[3] = {0};
  for (size_t k = 0; k < test_cases(600); k++) {
    size_t mark = orc_mark(&h.pool);
    orc_generate(&c, &h.random, k % ORC_KINDS, 3);
    for (int m = 0; m < 3; m++) harness_rect(&r[m], &c.rect[m]);
    check_disc(&h, &c, r, count);
    orc_release(&h.pool, mark);
  }
  assert_true(count[0] > 10 && count[1] > 10 && count[2] > 5);
  for (int k = 0; k < 3; k++) dyd_rect_clear(&r[k]);
  orc_case_clear(&c);
  harness_clear(&h);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(enclosures),      cmocka_unit_test(comparisons), cmocka_unit_test(random_bisectors),
      cmocka_unit_test(small_bisectors), cmocka_unit_test(structure),   cmocka_unit_test(discs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
