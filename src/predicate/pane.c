/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cutting an axis into the slabs of predicate/pane.h.
 *
 * Bounds are kept doubled, since the middle of an integer interval may be a half. Slabs of width 0 are left out:
 * they are part of their neighbours, which are closed. */
#include "predicate/pane.h"

void dyd_axis_init(dyd_axis *a) {
  for (int k = 0; k < 6; k++) mpz_init(a->line2[k]);
}

void dyd_axis_clear(dyd_axis *a) {
  for (int k = 0; k < 6; k++) mpz_clear(a->line2[k]);
}

/* Writes the doubled lines in ascending order without repeats; returns how many. */
static size_t set_slab_lines(dyd_axis *a, const dyd_irect *const r[3], const dyd_touch touch[3], int axis) {
  size_t n = 0;
  for (int m = 0; m < 3; m++) {
    if (touch[m] == DYD_FARTHEST) {
      mpz_add(a->line2[n++], dyd_irect_end(r[m], axis, 0), dyd_irect_end(r[m], axis, 1));
    } else {
      mpz_mul_2exp(a->line2[n++], dyd_irect_end(r[m], axis, 0), 1);
      mpz_mul_2exp(a->line2[n++], dyd_irect_end(r[m], axis, 1), 1);
    }
  }
  for (size_t i = 1; i < n; i++) {
    for (size_t j = i; j > 0 && mpz_cmp(a->line2[j - 1], a->line2[j]) > 0; j--) {
      mpz_swap(a->line2[j - 1], a->line2[j]);
    }
  }
  size_t kept = 1;
  for (size_t i = 1; i < n; i++) {
    if (mpz_cmp(a->line2[kept - 1], a->line2[i]) != 0) mpz_swap(a->line2[kept++], a->line2[i]);
  }
  return kept;
}

/* What a rectangle shows to a slab: its lower or upper end, or nothing fixed (NULL). t: scratch. */
static mpz_srcptr shown_end(const dyd_slab *s, const dyd_irect *r, dyd_touch touch, int axis, mpz_ptr t) {
  mpz_srcptr lo = dyd_irect_end(r, axis, 0), hi = dyd_irect_end(r, axis, 1);
  if (touch == DYD_FARTHEST) {
    mpz_add(t, lo, hi);
    return s->hi2 && mpz_cmp(s->hi2, t) <= 0 ? hi : lo;
  }
  mpz_mul_2exp(t, lo, 1);
  if (s->hi2 && mpz_cmp(s->hi2, t) <= 0) return lo;
  mpz_mul_2exp(t, hi, 1);
  if (s->lo2 && mpz_cmp(s->lo2, t) >= 0) return hi;
  return NULL;
}

void dyd_axis_set(dyd_axis *out, const dyd_irect *const r[3], const dyd_touch touch[3], int axis, mpz_srcptr origin,
                  int64_t shift) {
  mpz_t t, origin2;
  mpz_inits(t, origin2, NULL);
  mpz_mul_2exp(origin2, origin, 1);
  size_t lines = set_slab_lines(out, r, touch, axis);
  dyd_iv near_end[3][2];
  for (int m = 0; m < 3; m++) {
    near_end[m][0] = dyd_filter_near(dyd_irect_end(r[m], axis, 0), origin, shift, t);
    near_end[m][1] = dyd_filter_near(dyd_irect_end(r[m], axis, 1), origin, shift, t);
  }
  out->slabs = lines + 1;
  for (size_t k = 0; k <= lines; k++) {
    dyd_slab *s = &out->slab[k];
    s->lo2 = k > 0 ? out->line2[k - 1] : NULL;
    s->hi2 = k < lines ? out->line2[k] : NULL;
    s->lo = k > 0 ? out->slab[k - 1].hi : DYD_IV_UNKNOWN;
    s->hi = k < lines ? dyd_filter_near(out->line2[k], origin2, shift + 1, t) : DYD_IV_UNKNOWN;
    for (int m = 0; m < 3; m++) {
      mpz_srcptr at = shown_end(s, r[m], touch[m], axis, t);
      s->mark[m].at = at;
      s->mark[m].near = at == dyd_irect_end(r[m], axis, 1) ? near_end[m][1] : near_end[m][0];
    }
  }
  mpz_clears(t, origin2, NULL);
}
