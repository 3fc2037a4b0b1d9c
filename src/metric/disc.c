/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How far the partial disc (I,E) of three rectangles is from a disc: the area between I and the complement of E, and
 * their Hausdorff distance (mathematics: sections 4, 8).
 *
 * [AREA-D] Seen from a point o inside the three discs that make I, the boundary of I is at the least, that of the
 * complement of E at the greatest of three distances, each p + sqrt(r^2 - q^2) with p and q the parts of the way to a
 * centre along and across the ray. In each of SECTORS equal sectors both are bounded for all its rays at once, in
 * balls. The area is the sum of (greatest^2 - least^2) / 2 over the rays; no point between is farther from I than the
 * difference on its ray. */
#include <dyadel/metric.h>

#include "base/abi.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "metric/bounds.h"
#include "stream/ball.h"
#include <dyadel/predicate.h>

enum { SECTORS = 1024, CIRCLES = 6, INNER = 3, SPARE = 64 };

/* Balls that hold a circle's centre and squared radius. */
typedef struct ball_circle {
  arb_t x, y, r2;
} ball_circle;

static void ball_set_z(arb_ptr out, mpz_srcptr z) {
  DYD_LOCAL_NUMBERS(fmpz, f);
  fmpz_set_mpz(f, z);
  arb_set_fmpz(out, f);
}

/* (a + b sqrt(c)) / d; c is given by its root. */
static void ball_set_surd(arb_ptr out, mpz_srcptr a, mpz_srcptr b, arb_srcptr root, mpz_srcptr d, slong prec) {
  DYD_LOCAL_NUMBERS(arb, t);
  ball_set_z(t, b);
  arb_mul(out, t, root, prec);
  ball_set_z(t, a);
  arb_add(out, out, t, prec);
  ball_set_z(t, d);
  arb_div(out, out, t, prec);
}

static void ball_circle_set(ball_circle *out, const dyd_circle *k, slong prec) {
  DYD_LOCAL_NUMBERS(arb, root);
  ball_set_z(root, k->c);
  arb_sqrt(root, root, prec);
  ball_set_surd(out->x, k->ax, k->bx, root, k->d, prec);
  ball_set_surd(out->y, k->ay, k->by, root, k->d, prec);
  ball_set_surd(out->r2, k->ar, k->br, root, k->dr, prec);
}

/* Digits with which differences of these numbers keep SPARE bits. */
static slong disc_precision(const dyd_partial_disc *d) {
  size_t most = 0;
  for (int k = 0; k < CIRCLES; k++) {
    const dyd_circle *c = &d->circle[k];
    mpz_srcptr part[] = {c->ax, c->bx, c->ay, c->by, c->c, c->d, c->ar, c->br, c->dr};
    for (size_t m = 0; m < sizeof part / sizeof *part; m++)
      if (mpz_sizeinbase(part[m], 2) > most) most = mpz_sizeinbase(part[m], 2);
  }
  return (slong)(2 * most + SPARE);
}

/* A lower bound of how far the point is inside the discs that make I; at most 0: it may be outside. */
static void disc_margin(arf_t out, arb_srcptr x, arb_srcptr y, const ball_circle *circle, slong prec) {
  DYD_LOCAL_NUMBERS(arb, t, r);
  DYD_LOCAL_NUMBERS(arf, low);
  for (int k = 0; k < INNER; k++) {
    arb_sub(t, x, circle[k].x, prec);
    arb_sub(r, y, circle[k].y, prec);
    arb_hypot(t, t, r, prec);
    arb_sqrtpos(r, circle[k].r2, prec);
    arb_sub(t, r, t, prec);
    arb_get_lbound_arf(low, t, prec);
    if (k == 0 || arf_cmp(low, out) < 0) arf_set(out, low);
  }
}

/* The middle of one of the centres, the one farthest inside of I; false: none is inside. */
static bool disc_find_inside(arb_ptr x, arb_ptr y, const ball_circle *circle, slong prec) {
  DYD_LOCAL_NUMBERS(arf, best, margin);
  DYD_LOCAL_ARRAY(arb_t, at, [2]);
  for (int k = 0; k < INNER; k++) {
    arb_get_mid_arb(at[0], circle[k].x);
    arb_get_mid_arb(at[1], circle[k].y);
    disc_margin(margin, at[0], at[1], circle, prec);
    if (arf_cmp(margin, best) <= 0) continue;
    arf_set(best, margin);
    arb_set(x, at[0]);
    arb_set(y, at[1]);
  }
  return arf_sgn(best) > 0;
}

/* Bounds for the rays of one sector; `at` is the point they start from. */
typedef struct sector {
  arb_t at[2], turn, sine, cosine, along, across, t;
  arf_t least, greatest, end; /* below all distances to I's boundary; above all to that of the complement of E */
} sector;

static void sector_for_each(sector *s, void (*act)(arb_ptr), void (*act_end)(arf_ptr)) {
  arb_ptr ball[] = {s->at[0], s->at[1], s->turn, s->sine, s->cosine, s->along, s->across, s->t};
  arf_ptr end[] = {s->least, s->greatest, s->end};
  for (size_t k = 0; k < sizeof ball / sizeof *ball; k++) act(ball[k]);
  for (size_t k = 0; k < sizeof end / sizeof *end; k++) act_end(end[k]);
}

/* Ball functions may be inline: these are not. */
static void ball_init(arb_ptr x) {
  arb_init(x);
}
static void ball_clear(arb_ptr x) {
  arb_clear(x);
}
static void end_init(arf_ptr x) {
  arf_init(x);
}
static void end_clear(arf_ptr x) {
  arf_clear(x);
}

/* s->t: the distance to circle k along the rays. */
static void sector_distance(sector *s, const ball_circle *k, slong prec) {
  arb_sub(s->along, k->x, s->at[0], prec);
  arb_sub(s->across, k->y, s->at[1], prec);
  arb_mul(s->t, s->along, s->sine, prec);
  arb_mul(s->along, s->along, s->cosine, prec);
  arb_addmul(s->along, s->across, s->sine, prec);
  arb_submul(s->t, s->across, s->cosine, prec);
  arb_sqr(s->t, s->t, prec);
  arb_sub(s->t, k->r2, s->t, prec);
  arb_sqrtpos(s->t, s->t, prec);
  arb_add(s->t, s->t, s->along, prec);
}

static void sector_set(sector *s, slong number, const ball_circle *circle, slong prec) {
  arb_const_pi(s->turn, prec);
  arb_mul_si(s->turn, s->turn, 2 * number + 1, prec);
  arb_div_si(s->turn, s->turn, SECTORS, prec);
  mag_add_ui_2exp_si(arb_radref(s->turn), arb_radref(s->turn), 13, -12); /* pi / SECTORS < 13 / 2^12 */
  arb_sin_cos(s->sine, s->cosine, s->turn, prec);
  for (int k = 0; k < CIRCLES; k++) {
    sector_distance(s, &circle[k], prec);
    if (k < INNER) {
      arb_get_lbound_arf(s->end, s->t, prec);
      if (k == 0 || arf_cmp(s->end, s->least) < 0) arf_set(s->least, s->end);
    } else {
      arb_get_ubound_arf(s->end, s->t, prec);
      if (k == INNER || arf_cmp(s->end, s->greatest) > 0) arf_set(s->greatest, s->end);
    }
  }
  if (arf_sgn(s->least) < 0 || arf_is_nan(s->least)) arf_zero(s->least);
}

/* x >= 0 rounded up to 64 bits. */
static dyd_status end_to_dyadic(dyd_dyadic *out, arf_t x) {
  if (!arf_is_finite(x)) return DYD_E_RANGE;
  DYD_LOCAL_NUMBERS(mpz, z);
  DYD_LOCAL_NUMBERS(fmpz, man, exp);
  arf_set_round(x, x, 64, ARF_RND_CEIL);
  arf_get_fmpz_2exp(man, exp, x);
  fmpz_get_mpz(z, man);
  return fmpz_fits_si(exp) ? dyd_dyadic_set_z_2exp(out, z, fmpz_get_si(exp)) : DYD_E_RANGE;
}

/* Sums up the sectors; the point is s->at. */
static dyd_status disc_sum(dyd_voronoi_bounds *out, sector *s, const ball_circle *circle, slong prec) {
  DYD_LOCAL_NUMBERS(arf, sum, most, a, b);
  for (slong k = 0; k < SECTORS; k++) {
    sector_set(s, k, circle, prec);
    arf_sub(a, s->greatest, s->least, prec, ARF_RND_CEIL);
    if (k == 0 || arf_cmp(a, most) > 0) arf_set(most, a);
    arf_add(b, s->greatest, s->least, prec, ARF_RND_CEIL);
    arf_mul(a, a, b, prec, ARF_RND_CEIL);
    arf_add(sum, sum, a, prec, ARF_RND_CEIL);
  }
  arb_const_pi(s->t, prec); /* half of the angle 2 pi / SECTORS */
  arb_get_ubound_arf(b, s->t, prec);
  arf_mul(sum, sum, b, prec, ARF_RND_CEIL);
  arf_mul_2exp_si(sum, sum, -10);
  dyd_status st = end_to_dyadic(&out->area, sum);
  if (st == DYD_OK) st = end_to_dyadic(&out->hausdorff, most);
  out->finite = st == DYD_OK;
  return st == DYD_E_RANGE ? DYD_OK : st;
}

static dyd_status disc_measure(dyd_voronoi_bounds *out, const dyd_partial_disc *d) {
  slong prec = disc_precision(d);
  ball_circle circle[CIRCLES];
  sector s;
  sector_for_each(&s, ball_init, end_init);
  for (int k = 0; k < CIRCLES; k++) {
    arb_init(circle[k].x);
    arb_init(circle[k].y);
    arb_init(circle[k].r2);
    ball_circle_set(&circle[k], &d->circle[k], prec);
  }
  dyd_status st = disc_find_inside(s.at[0], s.at[1], circle, prec) ? disc_sum(out, &s, circle, prec) : DYD_OK;
  for (int k = 0; k < CIRCLES; k++) {
    arb_clear(circle[k].r2);
    arb_clear(circle[k].y);
    arb_clear(circle[k].x);
  }
  sector_for_each(&s, ball_clear, end_clear);
  return st;
}

/* ---- its rate ----
 *
 * [RATE-1] K = 2 sqrt(2) r (a + b + c) / D = sqrt(2) a b c (a + b + c) / D^2 at its largest, D being twice the area. */

/* The largest squared distance of points of a and b. */
static void rate_longest(mpq_t out, const dyd_rect *a, const dyd_rect *b) {
  const dyd_interval *side[2][2] = {{&a->x, &b->x}, {&a->y, &b->y}};
  DYD_LOCAL_ARRAY(mpq_t, end, [2][2]);
  mpq_set_ui(out, 0, 1);
  for (int k = 0; k < 2; k++) {
    for (int m = 0; m < 2; m++) dyd_interval_get_q(end[m][0], end[m][1], side[k][m]);
    mpq_sub(end[0][1], end[0][1], end[1][0]);
    mpq_sub(end[1][1], end[1][1], end[0][0]);
    mpq_abs(end[0][1], end[0][1]);
    mpq_abs(end[1][1], end[1][1]);
    mpq_ptr far = mpq_cmp(end[0][1], end[1][1]) > 0 ? end[0][1] : end[1][1];
    mpq_mul(far, far, far);
    mpq_add(out, out, far);
  }
}

/* The least |D| of a certainly oriented triple: D is affine in each coordinate, so it is that of corners. */
static void rate_least_area(mpq_t out, const dyd_rect *const r[3]) {
  DYD_LOCAL_NUMBERS(mpq, s, t);
  DYD_LOCAL_ARRAY(mpq_t, end, [3][2][2]);
  for (int k = 0; k < 3; k++) {
    dyd_interval_get_q(end[k][0][0], end[k][0][1], &r[k]->x);
    dyd_interval_get_q(end[k][1][0], end[k][1][1], &r[k]->y);
  }
  for (unsigned corner = 0; corner < 64; corner++) {
    mpq_srcptr p[6];
    for (unsigned k = 0; k < 6; k++) p[k] = end[k / 2][k % 2][corner >> k & 1];
    DYD_LOCAL_NUMBERS(mpq, u, v);
    mpq_sub(s, p[2], p[0]);
    mpq_sub(t, p[5], p[1]);
    mpq_mul(u, s, t);
    mpq_sub(s, p[4], p[0]);
    mpq_sub(t, p[3], p[1]);
    mpq_mul(v, s, t);
    mpq_sub(u, u, v);
    mpq_abs(u, u);
    if (corner == 0 || mpq_cmp(u, out) < 0) mpq_set(out, u);
  }
}

/* The least e with x <= 2^e, from a ball about x > 0, or one more. */
static int64_t rate_log2(arb_srcptr x) {
  DYD_LOCAL_NUMBERS(arf, end);
  DYD_LOCAL_NUMBERS(fmpz, exp);
  arb_get_ubound_arf(end, x, 64);
  arf_abs_bound_le_2exp_fmpz(exp, end);
  return fmpz_fits_si(exp) ? fmpz_get_si(exp) : INT64_MAX / 4;
}

/* The product and the sum of the longest sides. */
static void rate_sides(arb_ptr product, arb_ptr sum, const dyd_rect *const r[3], slong prec) {
  DYD_LOCAL_NUMBERS(mpq, q);
  DYD_LOCAL_NUMBERS(arb, x);
  arb_one(product);
  arb_zero(sum);
  for (int k = 0; k < 3; k++) {
    rate_longest(q, r[k], r[(k + 1) % 3]);
    dyd_ball_set_q(x, q, prec);
    arb_sqrt(x, x, prec);
    arb_mul(product, product, x, prec);
    arb_add(sum, sum, x, prec);
  }
}

dyd_status dyd_metric_disc_rate(int64_t *rate, int64_t *from, bool *known, const dyd_rect *a, const dyd_rect *b,
                                const dyd_rect *c) {
  const dyd_rect *const r[3] = {a, b, c};
  enum { PREC = 96 };
  *known = dyd_orientation(a, b, c) != DYD_UNSURE;
  if (!*known) return DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, q);
  DYD_LOCAL_NUMBERS(arb, product, sum, x);
  rate_sides(product, sum, r, PREC);
  rate_least_area(q, r);
  dyd_ball_set_q(x, q, PREC);
  arb_mul(product, product, sum, PREC);
  arb_div(sum, sum, x, PREC); /* at least 1 / r, since D / (a + b + c) is the radius of the inscribed circle */
  *from = rate_log2(sum);
  arb_sqr(x, x, PREC);
  arb_div(product, product, x, PREC);
  arb_sqrt_ui(x, 2, PREC);
  arb_mul(product, product, x, PREC);
  *rate = rate_log2(product);
  return DYD_OK;
}

dyd_status dyd_metric_disc(dyd_voronoi_bounds *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  if (dyd_abi_check(out, sizeof *out, "dyd_voronoi_bounds", NULL) != DYD_OK || !a || !b || !c) return DYD_E_ARG;
  DYD_LOCAL(dyd_partial_disc, d);
  dyd_partial_disc_set(&d, a, b, c);
  out->finite = false;
  dyd_status st = dyd_dyadic_set_si_2exp(&out->area, 0, 0);
  if (st == DYD_OK) st = dyd_dyadic_set_si_2exp(&out->hausdorff, 0, 0);
  bool exact = dyd_rect_is_point(a) && dyd_rect_is_point(b) && dyd_rect_is_point(c);
  if (st == DYD_OK && d.known && exact) out->finite = true;
  if (st == DYD_OK && d.known && !exact) st = disc_measure(out, &d);
  return st;
}
