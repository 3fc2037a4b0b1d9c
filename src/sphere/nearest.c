/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places are possibly nearest to a place, by angles between them.
 *
 * [SPH-6] Let u = f - f0 and d be the differences of latitudes and longitudes, |d| <= 180 degrees. The angle between
 * two places is 2 asin(sqrt h), h = sin^2(u/2) + cos f cos f0 sin^2(d/2): it grows with |d|, and so is least, and
 * largest, over a box of places where |d| is. Along a meridian h = (1 - R cos(f - g)) / 2 with R (cos g, sin g) =
 * (cos f0 cos d, sin f0): extreme at the ends, or at g, or opposite to it. A region holds all within an angle of its
 * box. Place i is listed unless its least distance is above the largest of some other one, for all of `at`. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/wants.h"
#include "sphere/state.h"
#include "stream/ball.h"

enum { FIRST_PREC = 128 };

/* ---- distances ---- */

/* Distances of a box from a place: the least and the largest, in radians, for each choice of the place in its box; and
 * the numbers behind them. */
typedef struct distance_range {
  arb_struct least, largest;
  arb_struct lat0, sin0, cos0, lon, versine, end, value, root, t;
  slong prec;
} distance_range;

enum { WAY_BALLS = 11 };

static void distance_range_init(distance_range *d, slong prec) {
  for (arb_ptr b = &d->least; b < &d->least + WAY_BALLS; b++) arb_init(b);
  d->prec = prec;
}

static void distance_range_clear(distance_range *d) {
  for (arb_ptr b = &d->least; b < &d->least + WAY_BALLS; b++) arb_clear(b);
}

/* x = q degrees, or up to `half` more or less, in units of pi. */
static void half_turn_ball(arb_t x, mpq_srcptr q, mpq_srcptr half, slong prec) {
  DYD_LOCAL_NUMBERS(arb, more);
  dyd_ball_set_q(x, q, prec);
  dyd_ball_set_q(more, half, prec);
  arb_add_error(x, more);
  arb_div_ui(x, x, 180, prec);
}

/* value = h for the latitude f, an end of the box. */
static void way_end(distance_range *d, mpq_srcptr f, const dyd_spot *at) {
  DYD_LOCAL_NUMBERS(mpq, u);
  mpq_sub(u, f, at->mid[1]);
  half_turn_ball(&d->t, u, at->half[1], d->prec);
  arb_mul_2exp_si(&d->t, &d->t, -1);
  arb_sin_pi(&d->value, &d->t, d->prec);
  arb_sqr(&d->value, &d->value, d->prec);
  mpq_set_ui(u, 0, 1);
  half_turn_ball(&d->t, f, u, d->prec);
  arb_cos_pi(&d->t, &d->t, d->prec);
  arb_nonnegative_part(&d->t, &d->t);
  arb_mul(&d->t, &d->t, &d->cos0, d->prec);
  arb_addmul(&d->value, &d->t, &d->versine, d->prec);
}

/* value = h at g, or opposite to it; t = that latitude in units of pi. */
static void way_critical(distance_range *d, bool opposite) {
  arb_cos_pi(&d->value, &d->lon, d->prec);
  arb_mul(&d->t, &d->cos0, &d->value, d->prec);
  arb_hypot(&d->root, &d->t, &d->sin0, d->prec);
  if (opposite) {
    arb_neg(&d->t, &d->t);
    arb_neg(&d->value, &d->sin0);
  } else {
    arb_set(&d->value, &d->sin0);
  }
  arb_atan2(&d->t, &d->value, &d->t, d->prec);
  arb_const_pi(&d->value, d->prec);
  arb_div(&d->t, &d->t, &d->value, d->prec);
  arb_add_ui(&d->root, &d->root, 1, d->prec);
  if (!opposite) { /* (1 - R) / 2 = (cos f0 sin d)^2 / (2 (1 + R)) */
    arb_sin_pi(&d->value, &d->lon, d->prec);
    arb_mul(&d->value, &d->value, &d->cos0, d->prec);
    arb_sqr(&d->value, &d->value, d->prec);
    arb_div(&d->root, &d->value, &d->root, d->prec);
  }
  arb_mul_2exp_si(&d->value, &d->root, -1);
}

/* The latitude t is outside for certain, -1, inside, 1, or 0. */
static int way_holds(distance_range *d, mpq_srcptr lo, mpq_srcptr hi) {
  DYD_LOCAL_NUMBERS(mpq, zero);
  int sign[2];
  for (int k = 0; k < 2; k++) {
    half_turn_ball(&d->end, k ? hi : lo, zero, d->prec);
    sign[k] = arb_lt(&d->t, &d->end) ? -1 : arb_gt(&d->t, &d->end);
  }
  return sign[0] < 0 || sign[1] > 0 ? -1 : sign[0] > 0 && sign[1] < 0;
}

/* out = the angle of h. */
static void way_angle(arb_t out, distance_range *d) {
  arb_sub_ui(&d->t, out, 1, d->prec);
  arb_neg(&d->t, &d->t);
  arb_sqrtpos(out, out, d->prec);
  arb_sqrtpos(&d->t, &d->t, d->prec);
  arb_atan2(out, out, &d->t, d->prec);
  arb_mul_2exp_si(out, out, 1);
}

/* out = the least distance of the box, with latitudes from lo to hi, or the largest; d degrees of longitude. */
static void way_reach(arb_t out, distance_range *d, mpq_srcptr degrees, mpq_srcptr lo, mpq_srcptr hi,
                      const dyd_spot *at) {
  const bool largest = out == &d->largest;
  half_turn_ball(&d->lon, degrees, at->half[0], d->prec);
  arb_mul_2exp_si(&d->t, &d->lon, -1);
  arb_sin_pi(&d->versine, &d->t, d->prec);
  arb_sqr(&d->versine, &d->versine, d->prec);
  way_end(d, lo, at);
  arb_set(out, &d->value);
  int holds = -1;
  if (!mpq_equal(lo, hi)) {
    way_end(d, hi, at);
    (largest ? arb_max : arb_min)(out, out, &d->value, d->prec);
    way_critical(d, largest);
    holds = way_holds(d, lo, hi);
  }
  if (holds >= 0) (largest ? arb_max : arb_min)(&d->value, out, &d->value, d->prec);
  if (holds == 0) arb_union(out, out, &d->value, d->prec);
  if (holds > 0) arb_set(out, &d->value);
  way_angle(out, d);
}

/* The box of the spot, without its angle. */
static void way_set(distance_range *d, const dyd_spot *spot, const dyd_spot *at) {
  DYD_LOCAL_NUMBERS(mpq, across, side, lo, hi);
  half_turn_ball(&d->lat0, at->mid[1], at->half[1], d->prec);
  arb_sin_cos_pi(&d->sin0, &d->cos0, &d->lat0, d->prec);
  arb_nonnegative_part(&d->cos0, &d->cos0);
  mpq_sub(across, spot->mid[0], at->mid[0]);
  mpq_abs(across, across);
  mpq_set_ui(side, 360, 1);
  if (mpq_cmp_si(across, 180, 1) > 0) mpq_sub(across, side, across);
  mpq_sub(lo, spot->mid[1], spot->half[1]);
  mpq_add(hi, spot->mid[1], spot->half[1]);
  mpq_sub(side, across, spot->half[0]);
  if (mpq_sgn(side) < 0) mpq_set_ui(side, 0, 1);
  way_reach(&d->least, d, side, lo, hi, at);
  mpq_add(side, across, spot->half[0]);
  if (mpq_cmp_si(side, 180, 1) > 0) mpq_set_si(side, 180, 1);
  way_reach(&d->largest, d, side, lo, hi, at);
}

/* Adds the angle `times` times. */
static void way_widen(arb_t out, const distance_range *d, mpq_srcptr angle, int times) {
  DYD_LOCAL_NUMBERS(arb, a);
  dyd_ball_set_q(a, angle, d->prec);
  arb_addmul_si(out, a, times, d->prec);
}

void dyd_spot_reach(arb_t out, const dyd_spot *spot, slong prec) {
  DYD_SCOPED(distance_range) d;
  distance_range_init(&d, prec);
  DYD_LOCAL(dyd_spot, at);
  for (int a = 0; a < 2; a++) mpq_set(at.mid[a], spot->mid[a]);
  way_set(&d, spot, &at);
  way_widen(&d.largest, &d, spot->angle, 1);
  arb_swap(out, &d.largest);
}

/* ---- the question ---- */

/* tried: how many were listed when a tie was looked for last. */
typedef struct near_question {
  dyd_sphere *s;
  dyd_stream *at;
  dyd_spot here, *spot; /* the place; the regions of those listed */
  size_t spots;
  dyd_index_list near;
  slong prec;
  size_t tried;
  bool listed, tied, exact;
} near_question;

static dyd_status near_place(near_question *q, dyd_error *err) {
  DYD_LOCAL_NUMBERS(mpq, zero);
  bool good = dyd_spot_set(&q->here, dyd_stream_rect(q->at), zero);
  if (good) return DYD_OK;
  return dyd_fail(err, DYD_E_DOMAIN,
                  "the latitude is beyond 90 degrees; places are longitude and latitude, in this order");
}

static dyd_status near_list(near_question *q, dyd_error *err) {
  dyd_spot_d at;
  dyd_spot_get_d(&at, &q->here);
  dyd_status st = dyd_sphere_near(&q->near, q->s, &at, err);
  q->spot = st == DYD_OK ? dyd_alloc(q->near.count, sizeof *q->spot) : NULL;
  if (st == DYD_OK && !q->spot) return dyd_fail_nomem(err);
  for (; st == DYD_OK && q->spots < q->near.count; q->spots++) dyd_spot_init(&q->spot[q->spots]);
  q->listed = st == DYD_OK;
  return st;
}

/* Reads the regions of those listed. */
static dyd_status near_regions(near_question *q, dyd_error *err) {
  dyd_status st = DYD_OK;
  q->exact = dyd_spot_is_exact(&q->here);
  for (size_t k = 0; k < q->near.count && st == DYD_OK; k++) {
    st = dyd_sphere_spot(&q->spot[k], q->s, q->near.item[k], err);
    q->exact = q->exact && dyd_spot_is_exact(&q->spot[k]);
  }
  return st;
}

/* Sets core to the part of region k that no refinement takes away: radii in degrees, less half of the rectangle.
 * Returns false if that is nothing. */
static bool near_core(dyd_spot *core, const near_question *q, size_t k) {
  const dyd_spot *spot = &q->spot[k];
  const bool fixed = dyd_sphere_is_fixed(q->s, q->near.item[k]);
  for (int a = 0; a < 2; a++) {
    mpq_set(core->mid[a], spot->mid[a]);
    mpq_set(core->half[a], spot->half[a]);
    if (fixed) continue;
    mpq_mul_2exp(core->half[a], q->s->degrees, 1);
    mpq_sub(core->half[a], core->half[a], spot->half[a]);
    if (mpq_sgn(core->half[a]) < 0) return false;
  }
  return true;
}

/* A bound of the least distance of each region, and in `most` the least bound of the largest ones, from outside, or,
 * with `stays`, from inside whatever is refined. NULL: memory is exhausted. */
static arf_struct *near_bounds(arf_t most, const near_question *q, bool stays) {
  arf_struct *bound = dyd_alloc(q->near.count, sizeof *bound);
  if (!bound) return NULL;
  DYD_SCOPED(distance_range) d;
  distance_range_init(&d, q->prec);
  DYD_LOCAL(dyd_spot, core);
  DYD_LOCAL_NUMBERS(arf, end);
  for (size_t k = 0; k < q->near.count; k++) {
    bool held = stays && near_core(&core, q, k);
    way_set(&d, held ? &core : &q->spot[k], &q->here);
    if (stays && !held) arb_swap(&d.least, &d.largest);
    way_widen(&d.least, &d, q->spot[k].angle, -1);
    way_widen(&d.largest, &d, q->spot[k].angle, 1);
    arf_init(&bound[k]);
    (stays ? arb_get_ubound_arf : arb_get_lbound_arf)(&bound[k], &d.least, q->prec);
    (stays ? arb_get_lbound_arf : arb_get_ubound_arf)(end, &d.largest, q->prec);
    if (!k || arf_cmp(end, most) < 0) arf_set(most, end);
  }
  return bound;
}

/* Drops places that are farther than another one for certain, or only counts the places that stay, whatever is refined.
 */
static dyd_status near_keep(size_t *kept, near_question *q, bool stays) {
  DYD_LOCAL_NUMBERS(arf, most);
  arf_struct *bound = near_bounds(most, q, stays);
  *kept = 0;
  for (size_t k = 0; bound && k < q->near.count; k++) {
    bool near = arf_cmp(&bound[k], most) <= 0;
    arf_clear(&bound[k]);
    if (near && !stays) {
      dyd_spot swap = q->spot[*kept];
      q->spot[*kept] = q->spot[k];
      q->spot[k] = swap;
      q->near.item[*kept] = q->near.item[k];
    }
    *kept += near;
  }
  if (bound && !stays) q->near.count = *kept;
  free(bound);
  return bound ? DYD_OK : DYD_E_NOMEM;
}

/* Of exact places about an exact one: until one is left, or those left are equally far; *blocked: not known at the
 * precision `most`. */
static dyd_status near_separate(bool *blocked, near_question *q, slong most, const volatile int *stop) {
  dyd_status st = DYD_OK;
  size_t kept;
  while (st == DYD_OK && q->near.count > 1) {
    if (dyd_flag_get(stop)) return DYD_CANCELLED;
    if (q->tried != q->near.count) st = dyd_spots_equidistant(&q->tied, &q->here, q->spot, q->near.count);
    q->tried = q->near.count;
    *blocked = !q->tied && q->prec > most;
    if (st != DYD_OK || q->tied || *blocked) return st;
    q->prec *= 2;
    st = near_keep(&kept, q, false);
  }
  return st;
}

/* ---- asking ---- */

static dyd_status near_look(bool *blocked, near_question *q, slong most, const volatile int *stop, dyd_error *err) {
  size_t kept;
  dyd_status st = near_place(q, err);
  if (st == DYD_OK && !q->listed) st = near_list(q, err);
  if (st != DYD_OK || q->near.count < 2) return st;
  q->prec = q->prec ? 2 * q->prec : FIRST_PREC;
  st = near_regions(q, err);
  if (st == DYD_OK) st = near_keep(&kept, q, false);
  return st == DYD_OK && q->exact ? near_separate(blocked, q, most, stop) : st;
}

static dyd_status near_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  near_question *q = user;
  bool blocked = false;
  size_t staying = 0;
  dyd_status st = near_look(&blocked, q, wants->o->max_bits, &e->stop, err);
  *answered = st == DYD_OK && q->near.count == 1;
  wants->blocked |= blocked;
  if (st != DYD_OK || *answered || q->exact || !q->near.count) return st;
  st = near_keep(&staying, q, true);
  if (st != DYD_OK || staying > 1) return st;
  for (size_t k = 0; k < q->near.count; k++) dyd_wants_add(wants, q->near.item[k], DYD_BITS_NEXT);
  dyd_wants_add(wants, (uint32_t)dyd_engine_count(e), DYD_BITS_NEXT);
  return DYD_OK;
}

dyd_status dyd_sphere_nearest(dyd_index_list *out, bool *sure, bool *tied, dyd_outcome *outcome, dyd_sphere *s,
                              dyd_stream *at, const dyd_engine_options *options, dyd_error *err) {
  if (!s || !at) return dyd_fail_null(err);
  near_question q = {.s = s, .at = at};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = near_ask, .user = &q, .guest = &at, .guests = 1};
  *outcome = DYD_OUTCOME_ERROR;
  dyd_spot_init(&q.here);
  dyd_status st = dyd_engine_ask(outcome, s->places, &question, options, err);
  if (st == DYD_OK) {
    dyd_index_list_clear(out);
    *out = q.near;
    *sure = q.near.count == 1;
    *tied = q.tied;
  } else {
    dyd_index_list_clear(&q.near);
  }
  for (size_t k = 0; k < q.spots; k++) dyd_spot_clear(&q.spot[k]);
  free(q.spot);
  dyd_spot_clear(&q.here);
  return st;
}

/* ---- bounds ---- */

void dyd_sphere_metres(arb_t x, const dyd_sphere *s, slong prec) {
  DYD_LOCAL_NUMBERS(arb, metre);
  dyd_ball_set_q(metre, s->metre, prec);
  arb_div(x, x, metre, prec);
}

static void distance_set(double *lo, double *hi, const dyd_sphere *s, const dyd_spot *spot, const dyd_spot *at) {
  DYD_SCOPED(distance_range) d;
  distance_range_init(&d, FIRST_PREC);
  way_set(&d, spot, at);
  way_widen(&d.least, &d, spot->angle, -1);
  way_widen(&d.largest, &d, spot->angle, 1);
  arb_const_pi(&d.t, FIRST_PREC);
  arb_min(&d.largest, &d.largest, &d.t, FIRST_PREC);
  dyd_sphere_metres(&d.least, s, FIRST_PREC);
  dyd_sphere_metres(&d.largest, s, FIRST_PREC);
  *lo = fmax(0, dyd_ball_ends(&d.least).lo);
  *hi = dyd_ball_ends(&d.largest).hi;
}

dyd_status dyd_sphere_distance(double *lo, double *hi, const dyd_sphere *s, uint32_t i, const dyd_rect *at) {
  if (!lo || !hi || !s || !at || i >= s->count) return DYD_E_ARG;
  DYD_LOCAL_NUMBERS(mpq, zero);
  DYD_LOCAL(dyd_spot, spot, here);
  dyd_status st = dyd_sphere_spot(&spot, s, i, NULL);
  if (st == DYD_OK && !dyd_spot_set(&here, at, zero)) st = DYD_E_DOMAIN;
  if (st == DYD_OK) distance_set(lo, hi, s, &spot, &here);
  return st;
}
