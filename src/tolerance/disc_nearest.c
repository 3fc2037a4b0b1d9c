/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which discs are possibly nearest to a place [DISC-6].
 *
 * With ds = max(0, |x - c| - r) and dl = |x - c| + r, disc i is possibly nearest to x iff ds_i <= dl_k, k the disc of
 * the least dl. Distances to a place that is a rectangle are the least for ds, the largest for dl. Both comparisons are
 * signs of sqrt(A) - sqrt(B) + s [SQR-2]. */
#include "base/error.h"
#include "tolerance/discs.h"
#include "tolerance/lines.h"

#include <dyadel/tolerance.h>
#include <mpfr.h>

/* A disc seen from a place: squares of the least and the largest distance of its centre. */
typedef struct disc_view {
  dyd_disc disc;
  mpq_t least, largest;
} disc_view;

static void disc_view_init(disc_view *v) {
  dyd_disc_init(&v->disc);
  mpq_inits(v->least, v->largest, NULL);
}

static void disc_view_clear(disc_view *v) {
  mpq_clears(v->least, v->largest, NULL);
  dyd_disc_clear(&v->disc);
}

/* Adds the squares of the least and the largest distance of c from the interval. */
static void disc_view_side(disc_view *v, mpq_srcptr c, const dyd_interval *side) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, side);
  mpq_sub(lo, lo, c);
  mpq_sub(hi, hi, c);
  bool inside = mpq_sgn(lo) <= 0 && mpq_sgn(hi) >= 0;
  mpq_mul(lo, lo, lo);
  mpq_mul(hi, hi, hi);
  bool low = mpq_cmp(lo, hi) < 0;
  if (!inside) mpq_add(v->least, v->least, low ? lo : hi);
  mpq_add(v->largest, v->largest, low ? hi : lo);
}

static dyd_status disc_view_set(disc_view *v, const dyd_sites *sites, uint32_t i, const dyd_rect *at, dyd_error *err) {
  dyd_status st = dyd_disc_of_site(&v->disc, sites, i);
  mpq_set_ui(v->least, 0, 1);
  mpq_set_ui(v->largest, 0, 1);
  disc_view_side(v, v->disc.x, &at->x);
  disc_view_side(v, v->disc.y, &at->y);
  if (st == DYD_E_ARG && err) err->point = i;
  return st == DYD_E_ARG ? dyd_fail(err, st, "a disc needs one radius, the same in x and y") : st;
}

/* Sign of dl_a - dl_b. */
static int compare_largest(const disc_view *a, const disc_view *b) {
  DYD_LOCAL_NUMBERS(mpq, s);
  mpq_sub(s, a->disc.r, b->disc.r);
  return dyd_roots_sign(s, a->largest, b->largest);
}

/* Returns true if ds_i <= dl_k. */
static bool may_be_as_near(const disc_view *i, const disc_view *k) {
  DYD_LOCAL_NUMBERS(mpq, s);
  mpq_add(s, i->disc.r, k->disc.r);
  mpq_neg(s, s);
  return dyd_roots_sign(s, i->least, k->largest) <= 0;
}

dyd_status dyd_disc_nearest(dyd_index_list *found, bool *sure, const dyd_sites *sites, const dyd_rect *at,
                            dyd_error *err) {
  if (!found || !sure || !sites || !at) return dyd_fail_null(err);
  DYD_LOCAL(disc_view, best, own);
  dyd_status st = DYD_OK;
  size_t kept = 0;
  for (size_t k = 0; k < found->count && st == DYD_OK; k++) {
    st = disc_view_set(&own, sites, found->item[k], at, err);
    if (st != DYD_OK || (k && compare_largest(&own, &best) >= 0)) continue;
    disc_view other = best;
    best = own;
    own = other;
  }
  for (size_t k = 0; k < found->count && st == DYD_OK; k++) {
    st = disc_view_set(&own, sites, found->item[k], at, err);
    if (st == DYD_OK && may_be_as_near(&own, &best)) found->item[kept++] = found->item[k];
  }
  if (st != DYD_OK) return st;
  found->count = kept;
  *sure = kept == 1;
  return DYD_OK;
}

/* max(0, sqrt(square) + s), rounded. */
static double root_plus(mpq_srcptr square, mpq_srcptr s, mpfr_rnd_t rnd) {
  DYD_LOCAL_FLOATS(128, x);
  mpfr_set_q(x, square, rnd);
  mpfr_sqrt(x, x, rnd);
  mpfr_add_q(x, x, s, rnd);
  return mpfr_sgn(x) > 0 ? mpfr_get_d(x, rnd) : 0;
}

dyd_status dyd_disc_distance(double *lo, double *hi, const dyd_sites *sites, size_t i, const dyd_rect *at) {
  if (!lo || !hi || !sites || !at) return DYD_E_ARG;
  DYD_LOCAL(disc_view, v);
  dyd_status st = disc_view_set(&v, sites, (uint32_t)i, at, NULL);
  *hi = root_plus(v.largest, v.disc.r, MPFR_RNDU);
  mpq_neg(v.disc.r, v.disc.r);
  *lo = root_plus(v.least, v.disc.r, MPFR_RNDD);
  return st;
}
