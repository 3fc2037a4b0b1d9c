/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial disc of three rectangles, by its six critical circles.
 *
 * I is the interior of the intersection of the three F-once discs, E the complement of the union of the three F-twice
 * discs (mathematics: section 4), so a rectangle is inside I iff its farthest distance from each F-once centre is less
 * than the radius, and inside E iff its closest distance from each F-twice centre is more [CON-1]. */
#include "predicate/circle.h"

enum { F_ONCE = 3, CIRCLES = 6 };

/* FCC CFC CCF CFF FCF FFC */
static void circle_labels(dyd_touch out[3], int number) {
  dyd_touch odd = number < F_ONCE ? DYD_FARTHEST : DYD_CLOSEST, even = number < F_ONCE ? DYD_CLOSEST : DYD_FARTHEST;
  for (int k = 0; k < 3; k++) out[k] = k == number % F_ONCE ? odd : even;
}

/* Three rectangles on a common integer scale. */
typedef struct triple {
  dyd_irect r[3];
  mpz_t man;
  int64_t exp;
} triple;

static void triple_init(triple *t, const dyd_rect *const r[3]) {
  for (int k = 0; k < 3; k++) dyd_irect_init(&t->r[k]);
  mpz_init(t->man);
  dyd_irects_scale(t->r, r, 3, t->man, &t->exp);
}

static void triple_clear(triple *t) {
  mpz_clear(t->man);
  for (int k = 3; k-- > 0;) dyd_irect_clear(&t->r[k]);
}

static bool find_critical_circle(dyd_circle *out, const triple *t, const dyd_touch touch[3]) {
  const dyd_irect *r[3] = {&t->r[0], &t->r[1], &t->r[2]};
  dyd_icircle k;
  dyd_icircle_init(&k);
  bool found = dyd_icircles(&k, 1, r, touch) == 1;
  if (found) dyd_circle_unscale(out, &k, t->man, t->exp);
  dyd_icircle_clear(&k);
  return found;
}

dyd_status dyd_critical_circle(dyd_circle *out, const dyd_rect *const r[3], const dyd_touch touch[3]) {
  if (touch[0] == touch[1] && touch[1] == touch[2]) return DYD_E_ARG;
  if (dyd_orientation(r[0], r[1], r[2]) == DYD_UNSURE) return DYD_E_ARG;
  triple t;
  triple_init(&t, r);
  bool found = find_critical_circle(out, &t, touch);
  triple_clear(&t);
  return found ? DYD_OK : DYD_E_ARG;
}

void dyd_partial_disc_init(dyd_partial_disc *d) {
  d->known = false;
  for (int k = 0; k < CIRCLES; k++) dyd_circle_init(&d->circle[k]);
}

void dyd_partial_disc_clear(dyd_partial_disc *d) {
  for (int k = CIRCLES; k-- > 0;) dyd_circle_clear(&d->circle[k]);
}

void dyd_partial_disc_set(dyd_partial_disc *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  const dyd_rect *r[3] = {a, b, c};
  out->known = dyd_orientation(a, b, c) != DYD_UNSURE;
  if (!out->known) return;
  bool exact = dyd_rect_is_point(a) && dyd_rect_is_point(b) && dyd_rect_is_point(c); /* then all six are one */
  triple t;
  triple_init(&t, r);
  for (int k = 0; k < CIRCLES && out->known; k++) {
    dyd_touch touch[3];
    if (exact && k) {
      dyd_circle_set(&out->circle[k], &out->circle[0]);
      continue;
    }
    circle_labels(touch, k);
    out->known = find_critical_circle(&out->circle[k], &t, touch);
  }
  triple_clear(&t);
}

/* Is r on the side `sign` of circles first .. first + 2, in the given sense? */
static bool beyond_circles(const dyd_partial_disc *d, int first, const dyd_rect *r, dyd_touch touch, int sign) {
  for (int k = first; k < first + F_ONCE; k++) {
    if (dyd_circle_side(&d->circle[k], r, touch) != sign) return false;
  }
  return true;
}

dyd_sure dyd_partial_disc_con(const dyd_partial_disc *d, const dyd_rect *r) {
  if (!d->known) return DYD_UNSURE;
  if (beyond_circles(d, 0, r, DYD_FARTHEST, -1)) return DYD_SURE_PLUS;
  if (beyond_circles(d, F_ONCE, r, DYD_CLOSEST, 1)) return DYD_SURE_MINUS;
  return DYD_UNSURE;
}
