/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Normal errors: how far regions reach so that all points lie in theirs with a stated probability [CNF-1].
 *
 * All roundings go up, and each function of the chain grows with its argument, so that the result is at least the exact
 * number. */
#include "io/read/twins.h"

#include "base/abi.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/labels.h"
#include "io/read/coordinate.h"
#include "stream/arb.h"
#include "stream/ball.h"

#include <inttypes.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

enum { PRECISION = 128 };

double dyd_double_above(mpq_srcptr q) {
  DYD_LOCAL_FLOATS(PRECISION, x);
  mpfr_set_q(x, q, MPFR_RNDU);
  return mpfr_get_d(x, MPFR_RNDU);
}

/* Returns at least the root of q >= 0. */
static double sigma_above(mpq_srcptr q) {
  DYD_LOCAL_FLOATS(PRECISION, x);
  mpfr_set_q(x, q, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  return mpfr_get_d(x, MPFR_RNDU);
}

double dyd_sigma_round(mpq_t sigma[2], mpq_srcptr rho) {
  if (!mpq_sgn(rho)) return dyd_double_above(sigma[mpq_cmp(sigma[0], sigma[1]) < 0]);
  DYD_LOCAL_NUMBERS(mpq, a, b, c);
  DYD_LOCAL_FLOATS(PRECISION, x);
  mpq_mul(a, sigma[0], sigma[0]);
  mpq_mul(b, sigma[1], sigma[1]);
  mpq_mul(c, sigma[0], sigma[1]);
  mpq_mul(c, c, rho);
  mpq_sub(b, a, b);
  mpq_div_2exp(b, b, 1); /* (sx^2 - sy^2) / 2 */
  mpq_sub(a, a, b);      /* (sx^2 + sy^2) / 2 */
  mpq_mul(b, b, b);
  mpq_mul(c, c, c);
  mpq_add(b, b, c);
  mpfr_set_q(x, b, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  mpfr_add_q(x, x, a, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  return mpfr_get_d(x, MPFR_RNDU);
}

/* Reads a decimal above 0 and below 1: man / 10^places. */
static bool probability_parse(int64_t *man, int *places, const char *text) {
  size_t length = strlen(text);
  dyd_plain p;
  bool percent = length && text[length - 1] == '%';
  length -= percent;
  while (length && text[length - 1] == ' ') length--;
  if (!dyd_plain_scan(&p, text, length) || p.man <= 0) return false;
  if (percent) p.exp -= 2;
  for (; p.man % 10 == 0; p.exp++) p.man /= 10;
  *man = p.man;
  *places = -p.exp;
  char digits[24];
  return snprintf(digits, sizeof digits, "%" PRId64, p.man) <= *places;
}

/* n 10^places / (10^places - man) = n / (1 - probability), rounded up, then k. */
static double k_above(int64_t man, int places, size_t n) {
  if (!n) return 0;
  DYD_LOCAL_NUMBERS(mpq, q);
  DYD_LOCAL_FLOATS(PRECISION, x);
  mpz_ui_pow_ui(mpq_numref(q), 10, (unsigned long)places);
  mpz_sub_ui(mpq_denref(q), mpq_numref(q), (unsigned long)man);
  mpz_mul_ui(mpq_numref(q), mpq_numref(q), n);
  mpq_canonicalize(q);
  mpfr_set_q(x, q, MPFR_RNDU);
  mpfr_log(x, x, MPFR_RNDU);
  mpfr_mul_2ui(x, x, 1, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  return mpfr_get_d(x, MPFR_RNDU);
}

dyd_status dyd_confidence_for(dyd_confidence *out, const dyd_engine *e, const char *probability, size_t n,
                              dyd_error *err) {
  int64_t man;
  int places;
  dyd_confidence before = {DYD_SIZED(dyd_confidence)};
  if (dyd_engine_confidence(&before, e))
    return dyd_fail(err, DYD_E_ARG, "points with a confidence were added before; add all of them at once");
  if (!probability_parse(&man, &places, probability))
    return dyd_fail(err, DYD_E_ARG,
                    "the confidence \"%.40s\" is not a decimal above 0 and below 1; give one such as 95%% or 0.95",
                    probability);
  *out = (dyd_confidence){DYD_SIZED(dyd_confidence), .k = k_above(man, places, n), .n = n};
  static const char zeros[] = "0000000000000000000000000000000000000000000000000000000000000000";
  int digits = snprintf(NULL, 0, "%" PRId64, man); /* at most `places` of at most 62 */
  snprintf(out->probability, sizeof out->probability, "0.%.*s%" PRId64, places - digits, zeros, man);
  return DYD_OK;
}

dyd_status dyd_engine_state_confidence(dyd_confidence *out, dyd_engine *e, const char *probability, size_t n,
                                       dyd_error *err) {
  dyd_confidence c;
  dyd_error own;
  if (!err) err = &own;
  dyd_error_clear(err);
  if (!e || !probability) return dyd_fail_null(err);
  dyd_status st = out ? dyd_abi_check(out, sizeof out->struct_size, "dyd_confidence", err) : DYD_OK;
  if (st == DYD_OK) st = dyd_confidence_for(&c, e, probability, n, err);
  if (st != DYD_OK) return st;
  dyd_engine_give_confidence(e, &c);
  if (out) dyd_abi_give(out, &c, sizeof c);
  return DYD_OK;
}

/* ---- rows of one point ----
 *
The point lies in the region of each of its rows, so in their intersection, which one of the smallest size holds.
 *
 * Let e[k] be independent normal errors of standard deviations s[k], and w[k] > 0 numbers that do not depend on them.
 * Then sum w e / sum w is normal with the variance sum w^2 s^2 / (sum w)^2, which grows with each s [CNF-1]. So w may
 * be rounded, and s rounded up; and one w for x and y does for ellipses that lie in discs. */

void dyd_twin_init(dyd_twin *t) {
  mpq_inits(t->lo[0], t->lo[1], t->hi[0], t->hi[1], NULL);
  t->sigma[0] = t->sigma[1] = t->kept = 0;
}

void dyd_twin_clear(dyd_twin *t) {
  mpq_clears(t->lo[0], t->lo[1], t->hi[0], t->hi[1], NULL);
}

static void twin_set(dyd_twin *out, const dyd_twin *t) {
  for (int a = 0; a < 2; a++) {
    mpq_set(out->lo[a], t->lo[a]);
    mpq_set(out->hi[a], t->hi[a]);
    out->sigma[a] = t->sigma[a];
  }
  out->kept = t->kept;
}

static void twin_width(mpq_t out, const dyd_twin *t, int axis) {
  mpq_sub(out, t->hi[axis], t->lo[axis]);
}

/* ---- boxes ---- */

/* Rows count in a coordinate where they have no error in it. false: apart. */
static bool twins_meet(dyd_twin *out, size_t apart[2], const dyd_twin *row, size_t n, int axis) {
  size_t low = n, high = n;
  for (size_t k = 0; k < n; k++) {
    if (row[k].sigma[axis] > 0) continue;
    if (low == n || mpq_cmp(row[k].lo[axis], row[low].lo[axis]) > 0) low = k;
    if (high == n || mpq_cmp(row[k].hi[axis], row[high].hi[axis]) < 0) high = k;
  }
  mpq_set(out->lo[axis], row[low].lo[axis]);
  mpq_set(out->hi[axis], row[high].hi[axis]);
  out->sigma[axis] = 0;
  apart[0] = low < high ? low : high;
  apart[1] = low < high ? high : low;
  return mpq_cmp(out->lo[axis], out->hi[axis]) <= 0;
}

/* ---- the one of the smallest size ---- */

static int twin_compare(const dyd_twin *a, const dyd_twin *b) {
  if (a->kept != b->kept) return a->kept < b->kept ? -1 : 1;
  DYD_LOCAL_NUMBERS(mpq, u, v);
  int order = 0;
  for (int axis = 1; axis >= 0 && !order; axis--) {
    twin_width(u, a, axis);
    twin_width(v, b, axis);
    order = mpq_cmp(u, v);
  }
  return order;
}

/* Of those without an error in x; the first one of several. */
static size_t twins_least(const dyd_twin *row, size_t n) {
  size_t least = n;
  for (size_t k = 0; k < n; k++)
    if (!(row[k].sigma[0] > 0) && (least == n || twin_compare(&row[k], &row[least]) < 0)) least = k;
  return least;
}

/* Returns true if the discs in two squares are apart. Of other boxes that is not asked. */
static bool discs_apart(const dyd_twin *s, const dyd_twin *t) {
  DYD_LOCAL_NUMBERS(mpq, u, v, reach, square);
  bool round = true;
  for (int k = 0; k < 2; k++) {
    const dyd_twin *of = k ? t : s;
    twin_width(u, of, 0);
    twin_width(v, of, 1);
    round = round && mpq_equal(u, v);
    mpq_add(reach, reach, u); /* twice the radii */
  }
  for (int a = 0; a < 2; a++) { /* twice the distance of the centres, squared */
    mpq_add(u, s->lo[a], s->hi[a]);
    mpq_sub(u, u, t->lo[a]);
    mpq_sub(u, u, t->hi[a]);
    mpq_mul(u, u, u);
    mpq_add(square, square, u);
  }
  mpq_mul(reach, reach, reach);
  return round && mpq_cmp(square, reach) > 0;
}

enum { BITS = 128 };

/* out = sin^2((a - b) / 2), of degrees. */
static void half_sine(arb_t out, mpq_srcptr a, mpq_srcptr b) {
  DYD_LOCAL_NUMBERS(mpq, d);
  mpq_sub(d, a, b);
  dyd_ball_set_q(out, d, BITS);
  arb_div_ui(out, out, 360, BITS);
  arb_sin_pi(out, out, BITS);
  arb_sqr(out, out, BITS);
}

/* Returns true if the way on the globe between two places is certainly longer than both radii. Half of its angle has
 * the squared sine sin^2(lat) + cos(lat of s) cos(lat of t) sin^2(lon), of halves of the differences. */
static bool grounds_apart(const dyd_twin *s, const dyd_twin *t) {
  DYD_LOCAL_NUMBERS(mpq, zero);
  DYD_LOCAL_NUMBERS(arb, way, f, reach);
  half_sine(way, s->lo[0], t->lo[0]);
  for (int k = 0; k < 2; k++) { /* cos(lat) = 1 - 2 sin^2(lat / 2); both signs change */
    half_sine(f, (k ? t : s)->lo[1], zero);
    arb_mul_2exp_si(f, f, 1);
    arb_sub_ui(f, f, 1, BITS);
    arb_mul(way, way, f, BITS);
  }
  half_sine(f, s->lo[1], t->lo[1]);
  arb_add(way, way, f, BITS);
  arb_set_d(reach, s->kept);
  arb_set_d(f, t->kept);
  arb_add(reach, reach, f, BITS);
  arb_mul_2exp_si(reach, reach, -1);
  arb_set_str(f, DYD_EARTH_RADIUS, BITS);
  arb_div(reach, reach, f, BITS);
  arb_set_d(f, 1.5); /* less than a quarter turn: below, the sine grows */
  bool apart = arb_lt(reach, f);
  arb_sin(reach, reach, BITS);
  arb_sqr(reach, reach, BITS);
  return apart && arb_gt(way, reach);
}

/* DYD_E_DOMAIN where another one has nothing in common with it. */
static dyd_status twins_choose(dyd_twin *out, size_t apart[2], const dyd_twin *row, size_t n, bool globe) {
  size_t least = twins_least(row, n);
  for (size_t k = 0; k < n; k++) {
    if (row[k].sigma[0] > 0 || k == least) continue;
    apart[0] = k < least ? k : least;
    apart[1] = k < least ? least : k;
    if (globe ? grounds_apart(&row[k], &row[least]) : discs_apart(&row[k], &row[least])) return DYD_E_DOMAIN;
  }
  twin_set(out, &row[least]);
  return DYD_OK;
}

/* ---- places on the globe ---- */

/* Returns true if the box of degrees is narrower than half a turn, and off the poles, where longitudes mean nothing. */
static bool twin_is_plain(const dyd_twin *t) {
  DYD_LOCAL_NUMBERS(mpq, width);
  twin_width(width, t, 0);
  return mpq_cmp_si(width, 180, 1) < 0 && mpq_cmp_si(t->lo[1], -90, 1) > 0 && mpq_cmp_si(t->hi[1], 90, 1) < 0;
}

/* Moves the longitudes of t by whole turns next to those of `to`. */
static void twin_turn(dyd_twin *t, const dyd_twin *to) {
  DYD_LOCAL_NUMBERS(mpq, turns);
  mpq_add(turns, to->lo[0], to->hi[0]);
  mpq_sub(turns, turns, t->lo[0]);
  mpq_sub(turns, turns, t->hi[0]);
  mpz_mul_ui(mpq_denref(turns), mpq_denref(turns), 720); /* the middles' difference / 360 */
  mpz_mul_2exp(mpq_numref(turns), mpq_numref(turns), 1);
  mpz_add(mpq_numref(turns), mpq_numref(turns), mpq_denref(turns));
  mpz_mul_2exp(mpq_denref(turns), mpq_denref(turns), 1);
  mpz_fdiv_q(mpq_numref(turns), mpq_numref(turns), mpq_denref(turns)); /* rounded */
  mpz_mul_ui(mpq_numref(turns), mpq_numref(turns), 360);
  mpz_set_ui(mpq_denref(turns), 1);
  mpq_add(t->lo[0], t->lo[0], turns);
  mpq_add(t->hi[0], t->hi[0], turns);
}

/* Boxes about a pole or half of the globe take no part; where all are such, one of them is taken. */
static dyd_status twins_merge_globe(dyd_twin *out, size_t apart[2], dyd_twin *row, size_t n) {
  size_t ground = n, box = n, plain = n;
  for (size_t k = 0; k < n; k++) {
    if (ground == n && row[k].kept > 0) ground = k;
    if (box == n && !(mpq_equal(row[k].lo[0], row[k].hi[0]) && mpq_equal(row[k].lo[1], row[k].hi[1]))) box = k;
    if (plain == n && twin_is_plain(&row[k])) plain = k;
  }
  apart[0] = ground < box ? ground : box;
  apart[1] = ground < box ? box : ground;
  if (ground < n) return box < n ? DYD_E_ARG : twins_choose(out, apart, row, n, true);
  if (plain == n) {
    twin_set(out, &row[twins_least(row, n)]);
    return DYD_OK;
  }
  for (size_t k = 0; k < n; k++) {
    if (twin_is_plain(&row[k]))
      twin_turn(&row[k], &row[plain]);
    else
      row[k].sigma[0] = row[k].sigma[1] = 1; /* it does not count */
  }
  return twins_meet(out, apart, row, n, 0) && twins_meet(out, apart, row, n, 1) ? DYD_OK : DYD_E_DOMAIN;
}

/* ---- means ---- */

/* The weight of a row, with the smallest standard deviation. */
static void twin_weigh(mpq_t w, const dyd_twin *t, int axis, double least) {
  double share = least / t->sigma[axis];
  mpq_set_d(w, share * share);
}

/* The smallest standard deviation in the coordinate; 0: there is a row without one. */
static double twins_least_sigma(const dyd_twin *row, size_t n, int axis) {
  double least = row[0].sigma[axis];
  for (size_t k = 1; k < n; k++)
    if (row[k].sigma[axis] < least) least = row[k].sigma[axis];
  return least;
}

static void twins_mean(dyd_twin *out, const dyd_twin *row, size_t n, int axis, double least) {
  DYD_LOCAL_NUMBERS(mpq, w, s, sum, variance);
  mpq_set_ui(out->lo[axis], 0, 1);
  mpq_set_ui(out->hi[axis], 0, 1);
  for (size_t k = 0; k < n; k++) {
    twin_weigh(w, &row[k], axis, least);
    mpq_add(sum, sum, w);
    mpq_mul(s, w, row[k].lo[axis]);
    mpq_add(out->lo[axis], out->lo[axis], s);
    mpq_mul(s, w, row[k].hi[axis]);
    mpq_add(out->hi[axis], out->hi[axis], s);
    mpq_set_d(s, row[k].sigma[axis]);
    mpq_mul(s, s, w);
    mpq_mul(s, s, s);
    mpq_add(variance, variance, s);
  }
  mpq_div(out->lo[axis], out->lo[axis], sum);
  mpq_div(out->hi[axis], out->hi[axis], sum);
  mpq_mul(sum, sum, sum);
  mpq_div(variance, variance, sum);
  out->sigma[axis] = sigma_above(variance);
}

dyd_status dyd_twins_merge(dyd_twin *out, size_t apart[2], dyd_twin *row, size_t n, const dyd_read_options *o) {
  if (o->degrees) return twins_merge_globe(out, apart, row, n);
  for (int a = 0; a < 2; a++) {
    double least = twins_least_sigma(row, n, a);
    if (least > 0)
      twins_mean(out, row, n, a, least);
    else if (!twins_meet(out, apart, row, n, a))
      return DYD_E_DOMAIN;
  }
  if (o->round && !(out->sigma[0] > 0)) return twins_choose(out, apart, row, n, false);
  out->kept = row[0].kept;
  for (size_t k = 1; k < n; k++)
    if (row[k].kept < out->kept) out->kept = row[k].kept;
  return DYD_OK;
}
