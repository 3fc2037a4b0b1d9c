/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* All critical circles of three integer rectangles.
 *
 * [CRIT-1] A circle that meets r[m] as touch[m] says has its centre in some pane of predicate/pane.h, where its three
 * features are known; a C-rectangle around the centre has ds = 0, which is no circle. Conversely a centre in a closed
 * pane, found from the features of that pane, has exactly these features at distance ds or dl. So the circles are the
 * solutions of predicate/solve.c, pane by pane, whose centre is in the pane. Some rectangle is F, hence some corner is
 * on the circle. */
#include "base/invariant.h"
#include "predicate/pane.h"
#include "predicate/solve.h"

/* Everything one call needs, allocated once. */
typedef struct search {
  const dyd_irect *const *r;
  const dyd_touch *touch;
  int base;
  dyd_axis axis[2];
  dyd_feature f, g;
  dyd_centre centre;
  dyd_icircle circle;
  mpz_t s, t;
} search;

static void circle_search_init(search *q) {
  for (int k = 0; k < 2; k++) dyd_axis_init(&q->axis[k]);
  dyd_feature_init(&q->f);
  dyd_feature_init(&q->g);
  dyd_centre_init(&q->centre);
  dyd_icircle_init(&q->circle);
  mpz_inits(q->s, q->t, NULL);
}

static void circle_search_clear(search *q) {
  mpz_clears(q->s, q->t, NULL);
  dyd_icircle_clear(&q->circle);
  dyd_centre_clear(&q->centre);
  dyd_feature_clear(&q->g);
  dyd_feature_clear(&q->f);
  for (int k = 2; k-- > 0;) dyd_axis_clear(&q->axis[k]);
}

/* Coordinates relative to a corner of the base, cut so that products of four stay below 2^1000. */
static int64_t circles_choose_shift(search *q) {
  const dyd_irect *o = q->r[q->base];
  size_t bits = 0;
  for (int m = 0; m < 3; m++) {
    mpz_srcptr at[4] = {q->r[m]->x0, q->r[m]->x1, q->r[m]->y0, q->r[m]->y1};
    for (int k = 0; k < 4; k++) {
      mpz_sub(q->t, at[k], k < 2 ? o->x0 : o->y0);
      size_t b = mpz_sizeinbase(q->t, 2);
      if (b > bits) bits = b;
    }
  }
  return bits > 200 ? (int64_t)bits - 200 : 0;
}

/* The feature of rectangle m in a pane, relative to the corner of the base; false: the centre itself. */
static bool circles_set_feature(dyd_feature *out, const dyd_slab *const s[2], int m, int base) {
  for (int k = 0; k < 2; k++) {
    mpz_srcptr at = s[k]->mark[m].at;
    out->has[k] = at != NULL;
    if (at) mpz_sub(out->at[k], at, s[k]->mark[base].at);
  }
  return out->has[0] || out->has[1];
}

/* circle = centre + corner of the base; false when the radius is 0. */
static bool circle_place(search *q, const dyd_slab *const s[2]) {
  dyd_centre *o = &q->centre;
  dyd_icircle *k = &q->circle;
  if (!dyd_sqrt_sign(o->a[0], o->b[0], o->c) && !dyd_sqrt_sign(o->a[1], o->b[1], o->c)) return false;
  mpz_set(k->px, s[0]->mark[q->base].at);
  mpz_set(k->py, s[1]->mark[q->base].at);
  mpz_swap(k->ax, o->a[0]);
  mpz_addmul(k->ax, k->px, o->d);
  mpz_swap(k->ay, o->a[1]);
  mpz_addmul(k->ay, k->py, o->d);
  mpz_swap(k->bx, o->b[0]);
  mpz_swap(k->by, o->b[1]);
  mpz_swap(k->c, o->c);
  mpz_swap(k->d, o->d);
  return true;
}

/* Is the coordinate (a + b sqrt c) / d within the slab? */
static bool within_slab(search *q, mpz_srcptr a, mpz_srcptr b, const dyd_slab *s) {
  const dyd_icircle *k = &q->circle;
  mpz_mul_2exp(q->s, b, 1);
  for (int side = 0; side < 2; side++) {
    mpz_srcptr bound = side ? s->hi2 : s->lo2;
    if (!bound) continue;
    mpz_mul_2exp(q->t, a, 1);
    mpz_submul(q->t, bound, k->d);
    int sign = dyd_sqrt_sign(q->t, q->s, k->c);
    if (side ? sign > 0 : sign < 0) return false;
  }
  return true;
}

static bool circle_is_new(const dyd_icircle *out, size_t count, const dyd_icircle *k) {
  for (size_t i = 0; i < count; i++) {
    if (!dyd_icircle_compare(&out[i], k, 0) && !dyd_icircle_compare(&out[i], k, 1)) return false;
  }
  return true;
}

/* Adds the circles of one pane. */
static size_t search_pane(search *q, dyd_icircle *out, size_t count, size_t room, const dyd_slab *const s[2]) {
  if (!circles_set_feature(&q->f, s, (q->base + 1) % 3, q->base)) return count;
  if (!circles_set_feature(&q->g, s, (q->base + 2) % 3, q->base)) return count;
  if (dyd_filter_pane_empty(s[0], s[1], q->base)) return count;
  for (int which = 0; which < DYD_CENTRES_MAX && count < room; which++) {
    if (!dyd_solve(&q->centre, &q->f, &q->g, which) || !circle_place(q, s)) continue;
    if (!within_slab(q, q->circle.ax, q->circle.bx, s[0]) || !within_slab(q, q->circle.ay, q->circle.by, s[1]))
      continue;
    if (circle_is_new(out, count, &q->circle)) dyd_icircle_swap(&out[count++], &q->circle);
  }
  return count;
}

size_t dyd_icircles(dyd_icircle *out, size_t room, const dyd_irect *const r[3], const dyd_touch touch[3]) {
  search q = {.r = r, .touch = touch, .base = 0};
  while (q.base < 3 && touch[q.base] != DYD_FARTHEST) q.base++;
  DYD_INVARIANT(q.base < 3);
  circle_search_init(&q);
  int64_t shift = circles_choose_shift(&q);
  dyd_axis_set(&q.axis[0], r, touch, 0, r[q.base]->x0, shift);
  dyd_axis_set(&q.axis[1], r, touch, 1, r[q.base]->y0, shift);
  size_t count = 0;
  for (size_t i = 0; i < q.axis[0].slabs; i++) {
    for (size_t j = 0; j < q.axis[1].slabs && count < room; j++) {
      const dyd_slab *s[2] = {&q.axis[0].slab[i], &q.axis[1].slab[j]};
      count = search_pane(&q, out, count, room, s);
    }
  }
  circle_search_clear(&q);
  return count;
}
