/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rectangles and dyadic points: life, order and distances.
 *
 * A rectangle is a product of intervals, and inclusion, meeting and equality are those of its sides. */
#include <dyadel/rect.h>

#include "rect/interval.h"
#include "rect/irect.h"

void dyd_rect_init(dyd_rect *r) {
  dyd_interval_init(&r->x);
  dyd_interval_init(&r->y);
}

void dyd_rect_clear(dyd_rect *r) {
  dyd_interval_clear(&r->y);
  dyd_interval_clear(&r->x);
}

void dyd_rect_set(dyd_rect *out, const dyd_rect *r) {
  dyd_interval_set(&out->x, &r->x);
  dyd_interval_set(&out->y, &r->y);
}

void dyd_rect_swap(dyd_rect *a, dyd_rect *b) {
  dyd_interval_swap(&a->x, &b->x);
  dyd_interval_swap(&a->y, &b->y);
}

dyd_status dyd_rect_set_d(dyd_rect *out, double x0, double x1, double y0, double y1) {
  dyd_rect t;
  dyd_rect_init(&t);
  dyd_status st = dyd_interval_set_d(&t.x, x0, x1);
  if (st == DYD_OK) st = dyd_interval_set_d(&t.y, y0, y1);
  if (st == DYD_OK) dyd_rect_swap(out, &t);
  dyd_rect_clear(&t);
  return st;
}

dyd_status dyd_rect_set_q(dyd_rect *out, const mpq_t x, const mpq_t y) {
  dyd_rect t;
  dyd_rect_init(&t);
  dyd_status st = dyd_interval_set_q(&t.x, x);
  if (st == DYD_OK) st = dyd_interval_set_q(&t.y, y);
  if (st == DYD_OK) dyd_rect_swap(out, &t);
  dyd_rect_clear(&t);
  return st;
}

void dyd_rect_get_d(double out[4], const dyd_rect *r) {
  dyd_interval_get_d(&out[0], &out[1], &r->x);
  dyd_interval_get_d(&out[2], &out[3], &r->y);
}

bool dyd_rect_is_point(const dyd_rect *r) {
  return dyd_interval_is_point(&r->x) && dyd_interval_is_point(&r->y);
}

bool dyd_rect_contains(const dyd_rect *outer, const dyd_rect *inner) {
  return dyd_interval_contains(&outer->x, &inner->x) && dyd_interval_contains(&outer->y, &inner->y);
}

bool dyd_rect_meets(const dyd_rect *a, const dyd_rect *b) {
  return dyd_interval_meets(&a->x, &b->x) && dyd_interval_meets(&a->y, &b->y);
}

bool dyd_rect_holds(const dyd_rect *r, const dyd_point *p) {
  return dyd_dyadic_cmp(&r->x.lo, &p->x) <= 0 && dyd_dyadic_cmp(&p->x, &r->x.hi) <= 0 &&
         dyd_dyadic_cmp(&r->y.lo, &p->y) <= 0 && dyd_dyadic_cmp(&p->y, &r->y.hi) <= 0;
}

static bool interval_equal(const dyd_interval *a, const dyd_interval *b) {
  return !dyd_dyadic_cmp(&a->lo, &b->lo) && !dyd_dyadic_cmp(&a->hi, &b->hi) && !mpz_cmp(a->den, b->den);
}

bool dyd_rect_equal(const dyd_rect *a, const dyd_rect *b) {
  return interval_equal(&a->x, &b->x) && interval_equal(&a->y, &b->y);
}

int64_t dyd_rect_bits(const dyd_rect *r) {
  int64_t x = dyd_interval_bits(&r->x), y = dyd_interval_bits(&r->y);
  return x < y ? x : y;
}

void dyd_point_init(dyd_point *p) {
  dyd_dyadic_init(&p->x);
  dyd_dyadic_init(&p->y);
}

void dyd_point_clear(dyd_point *p) {
  dyd_dyadic_clear(&p->y);
  dyd_dyadic_clear(&p->x);
}

void dyd_point_set(dyd_point *out, const dyd_point *p) {
  dyd_dyadic_set(&out->x, &p->x);
  dyd_dyadic_set(&out->y, &p->y);
}

/* q = q / (man * 2^exp)^2, where q is an integer and man > 0. */
static void unscale_square(mpq_t q, mpz_srcptr man, int64_t exp) {
  mpz_mul(mpq_denref(q), man, man);
  if (exp > 0) mpz_mul_2exp(mpq_denref(q), mpq_denref(q), (mp_bitcnt_t)(2 * exp));
  if (exp < 0) mpz_mul_2exp(mpq_numref(q), mpq_numref(q), (mp_bitcnt_t)(-2 * exp));
  mpq_canonicalize(q);
}

typedef void distance_function(mpz_ptr, mpz_srcptr, mpz_srcptr, const dyd_irect *);

static void rect_distance2(mpq_t out, const dyd_point *c, const dyd_rect *r, distance_function *distance) {
  dyd_irect scaled;
  mpz_t cx, cy, man;
  int64_t exp;
  dyd_irect_init(&scaled);
  mpz_inits(cx, cy, man, NULL);
  dyd_irects_scale_with(cx, cy, &scaled, c, &r, 1, man, &exp);
  distance(mpq_numref(out), cx, cy, &scaled);
  unscale_square(out, man, exp);
  mpz_clears(cx, cy, man, NULL);
  dyd_irect_clear(&scaled);
}

void dyd_rect_ds2(mpq_t out, const dyd_point *c, const dyd_rect *r) {
  rect_distance2(out, c, r, dyd_irect_ds2);
}

void dyd_rect_dl2(mpq_t out, const dyd_point *c, const dyd_rect *r) {
  rect_distance2(out, c, r, dyd_irect_dl2);
}

void dyd_partial_edge_area2(mpq_t out, const dyd_rect *a, const dyd_rect *b) {
  const dyd_rect *in[2] = {a, b};
  dyd_irect scaled[2];
  mpz_t man;
  int64_t exp;
  dyd_irect_init(&scaled[0]);
  dyd_irect_init(&scaled[1]);
  mpz_init(man);
  dyd_irects_scale(scaled, in, 2, man, &exp);
  dyd_irect_partial_edge_area2(mpq_numref(out), &scaled[0], &scaled[1]);
  unscale_square(out, man, exp);
  mpz_clear(man);
  dyd_irect_clear(&scaled[1]);
  dyd_irect_clear(&scaled[0]);
}

bool dyd_partial_edges_disjoint(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c, const dyd_rect *d) {
  const dyd_rect *in[4] = {a, b, c, d};
  dyd_irect scaled[4];
  for (int k = 0; k < 4; k++) dyd_irect_init(&scaled[k]);
  dyd_irects_scale(scaled, in, 4, NULL, NULL);
  bool disjoint = dyd_irect_partial_edges_disjoint(&scaled[0], &scaled[1], &scaled[2], &scaled[3]);
  for (int k = 4; k-- > 0;) dyd_irect_clear(&scaled[k]);
  return disjoint;
}
