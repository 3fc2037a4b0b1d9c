/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Does a side of the query meet Pos_i? A walk along the side, as the cover walk of the triangulation.
 *
 * On the line of the side let t be the coordinate. Site k blocks the t with f_k = dl_k^2 - ds_i^2 < 0: C_ki is open and
 * convex, so that is one open interval. Pos_i meets the side iff the intervals of all other sites do not cover it.
 * Walk: start at the lower end; nobody blocks there: it meets. Else go to the upper end of a blocker's interval, which
 * this blocker leaves free; beyond the side: it does not meet. Each step is at the end of another interval, farther on,
 * so there are at most as many as sites [NEAR-2].
 *
 * With s the farther end of R_k along the axis (the upper one for t <= the middle), and D = (distance across to the
 * farther end of R_k)^2 - (distance across to R_i)^2:
 *   f_k = 2 (e - s) t + s^2 - e^2 + D   beyond the end e of R_i along the axis,
 *   f_k = (t - s)^2 + D                 within R_i's extent along the axis.
 * So upper ends of intervals are rational or s + sqrt(-D), and signs of f_k there are those of p + q sqrt(c). */
#include "voronoi/nearest.h"

void dyd_near_work_init(dyd_near_work *w) {
  mpq_inits(w->at, w->root, w->far, w->near, w->d, w->p, w->q, w->s, w->t, w->mid, NULL);
}

void dyd_near_work_clear(dyd_near_work *w) {
  mpq_clears(w->at, w->root, w->far, w->near, w->d, w->p, w->q, w->s, w->t, w->mid, NULL);
}

/* Sign of p + q sqrt(c), c >= 0 [SQR-1]. s, t: scratch. */
static int surd_sign(mpq_t s, mpq_t t, const mpq_t p, const mpq_t q, const mpq_t c) {
  int sp = mpq_sgn(p), sq = mpq_sgn(c) ? mpq_sgn(q) : 0;
  if (!sq || sp == sq) return sp;
  if (!sp) return sq;
  mpq_mul(s, p, p);
  mpq_mul(t, q, q);
  mpq_mul(t, t, c);
  int order = mpq_cmp(s, t);
  return order > 0 ? sp : order < 0 ? sq : 0;
}

/* Sign of (the place) - x. */
static int place_compare(dyd_near_work *w, const mpq_t x) {
  mpq_sub(w->p, w->at, x);
  mpq_set_ui(w->q, 1, 1);
  return surd_sign(w->s, w->t, w->p, w->q, w->root);
}

/* w->d = D for site k against site i. */
static void side_set_across(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k,
                            const dyd_near_site *i) {
  int o = 2 - 2 * side->axis;
  mpq_sub(w->s, k->e[o + 1], side->across);
  mpq_sub(w->t, side->across, k->e[o]);
  mpq_ptr far = mpq_cmp(w->s, w->t) > 0 ? w->s : w->t;
  mpq_mul(w->d, far, far);
  if (mpq_cmp(side->across, i->e[o]) < 0)
    mpq_sub(w->s, i->e[o], side->across);
  else if (mpq_cmp(side->across, i->e[o + 1]) > 0)
    mpq_sub(w->s, side->across, i->e[o + 1]);
  else
    return;
  mpq_mul(w->s, w->s, w->s);
  mpq_sub(w->d, w->d, w->s);
}

static void side_set_middle(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k) {
  int a = 2 * side->axis;
  mpq_add(w->mid, k->e[a], k->e[a + 1]);
  mpq_div_2exp(w->mid, w->mid, 1);
}

/* Linear coefficients of f in a piece beyond an end of R_i: f = p t + q; w->far = s, w->near = e are set. */
static void side_set_linear(dyd_near_work *w) {
  mpq_sub(w->p, w->near, w->far);
  mpq_add(w->p, w->p, w->p);
  mpq_mul(w->s, w->far, w->far);
  mpq_mul(w->t, w->near, w->near);
  mpq_sub(w->q, w->s, w->t);
  mpq_add(w->q, w->q, w->d);
}

/* Sign of f at the place; D and the middle of k are set. */
static int blocker_sign_at_place(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k,
                                 const dyd_near_site *i) {
  int a = 2 * side->axis;
  mpq_set(w->far, place_compare(w, w->mid) <= 0 ? k->e[a + 1] : k->e[a]);
  bool below = place_compare(w, i->e[a])<0, above = place_compare(w, i->e[a + 1])> 0;
  if (below || above) {
    mpq_set(w->near, below ? i->e[a] : i->e[a + 1]);
    side_set_linear(w);
    mpq_mul(w->s, w->p, w->at);
    mpq_add(w->q, w->q, w->s); /* value = q + p sqrt(root) */
    mpq_swap(w->p, w->q);
  } else {
    mpq_sub(w->q, w->at, w->far);
    mpq_mul(w->p, w->q, w->q);
    mpq_add(w->p, w->p, w->root);
    mpq_add(w->p, w->p, w->d);
    mpq_add(w->q, w->q, w->q);
  }
  return surd_sign(w->s, w->t, w->p, w->q, w->root);
}

/* Sign of f at the rational x. */
static int blocker_sign_at(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k, const dyd_near_site *i,
                           const mpq_t x) {
  int a = 2 * side->axis;
  mpq_sub(w->s, x, mpq_cmp(x, w->mid) <= 0 ? k->e[a + 1] : k->e[a]);
  mpq_mul(w->s, w->s, w->s);
  mpq_add(w->s, w->s, w->d);
  bool below = mpq_cmp(x, i->e[a]) < 0;
  if (below || mpq_cmp(x, i->e[a + 1]) > 0) {
    mpq_sub(w->t, x, below ? i->e[a] : i->e[a + 1]);
    mpq_mul(w->t, w->t, w->t);
    mpq_sub(w->s, w->s, w->t);
  }
  return mpq_sgn(w->s);
}

/* Moves to the upper end of the interval of k, which holds the place; false: it has none. */
static bool place_advance(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *k, const dyd_near_site *i) {
  int a = 2 * side->axis;
  mpq_srcptr lo = i->e[a], hi = i->e[a + 1], end[3] = {lo, hi, w->mid}, stop = NULL;
  for (int n = 0; n < 3; n++) {
    if (place_compare(w, end[n]) >= 0 || blocker_sign_at(w, side, k, i, end[n]) < 0) continue;
    if (!stop || mpq_cmp(end[n], stop) < 0) stop = end[n];
  }
  /* The piece that ends at stop, or the last one. */
  mpq_set(w->far, stop && mpq_cmp(stop, w->mid) <= 0 ? k->e[a + 1] : k->e[a]);
  if (stop && mpq_cmp(stop, lo) > 0 && mpq_cmp(stop, hi) <= 0) {
    mpq_set(w->at, w->far);
    mpq_neg(w->root, w->d);
    return true;
  }
  mpq_set(w->near, stop && mpq_cmp(stop, lo) <= 0 ? lo : hi);
  side_set_linear(w);
  if (mpq_sgn(w->p) <= 0) return false;
  mpq_div(w->at, w->q, w->p);
  mpq_neg(w->at, w->at);
  mpq_set_ui(w->root, 0, 1);
  return true;
}

/* Somebody who blocks the place, with D and the middle set; count: nobody. */
static size_t side_find_blocker(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *site, size_t count,
                                size_t i, bool no_filter) {
  dyd_bbox c;
  dyd_filter_place(&c, side, w->at, w->root);
  size_t sure = no_filter ? count : dyd_filter_blocker(&c, site, count, i);
  for (size_t k = sure < count ? sure : 0; k < count; k++) {
    if (k == i || (k != sure && !no_filter && dyd_filter_blocks(&c, &site[k], &site[i]) == DYD_FALSE)) continue;
    side_set_across(w, side, &site[k], &site[i]);
    side_set_middle(w, side, &site[k]);
    if (k == sure || blocker_sign_at_place(w, side, &site[k], &site[i]) < 0) return k;
  }
  return count;
}

bool dyd_near_side_meets(dyd_near_work *w, const dyd_near_side *side, const dyd_near_site *site, size_t count, size_t i,
                         bool no_filter) {
  mpq_set(w->at, side->lo);
  mpq_set_ui(w->root, 0, 1);
  for (;;) {
    size_t k = side_find_blocker(w, side, site, count, i, no_filter);
    if (k == count) return true;
    if (!place_advance(w, side, &site[k], &site[i]) || place_compare(w, side->hi) > 0) return false;
  }
}
