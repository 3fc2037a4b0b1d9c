/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Predicates of partial points: statements that hold for every choice of points in the rectangles.
 *
 * Every predicate is decided: a floating filter with a proved bound answers first, an exact rung in integers
 * answers the rest. "Unsure" means that two choices really differ (or one choice is degenerate), never that
 * the computation was not precise enough. All are pure functions of the rectangles (mathematics: section 4). */
#ifndef DYADEL_PREDICATE_H
#define DYADEL_PREDICATE_H

#include <dyadel/rect.h>

#ifdef __cplusplus
extern "C" {
#endif

/* PLUS: every choice (p in a, q in b, r in c) turns left (counter-clockwise); MINUS: every choice turns right;
 * UNSURE: some line meets all three [ORI-1]. */
DYD_API dyd_sure dyd_orientation(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c);

/* Which distance to a rectangle equals the radius of a critical circle. */
typedef enum dyd_touch {
  DYD_CLOSEST = 0, /* ds: the circle touches the rectangle from outside */
  DYD_FARTHEST = 1 /* dl: the circle encloses the rectangle */
} dyd_touch;

/* A circle with centre ((ax + bx sqrt(c)) / d, (ay + by sqrt(c)) / d) and squared radius
 * (ar + br sqrt(c)) / dr. Invariant: c >= 0, d > 0, dr > 0. */
typedef struct dyd_circle {
  mpz_t ax, bx, ay, by, c, d;
  mpz_t ar, br, dr;
} dyd_circle;

/* The partial disc D(a,b,c) = (I,E) by its six critical circles, in the order FCC CFC CCF CFF FCF FFC.
 * known is false (and the circles unused) when the triple is not certainly oriented: I and E are empty then. */
typedef struct dyd_partial_disc {
  bool known;
  dyd_circle circle[6];
} dyd_partial_disc;

DYD_API void dyd_partial_disc_init(dyd_partial_disc *d);
DYD_API void dyd_partial_disc_clear(dyd_partial_disc *d);
DYD_API void dyd_partial_disc_set(dyd_partial_disc *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c);

/* Con(r; a,b,c): PLUS r certainly inside the circle through a, b, c (of either orientation); MINUS certainly outside;
 * UNSURE: some circle meets all four, or the triple is not certainly oriented [CON-1]. */
DYD_API dyd_sure dyd_con(const dyd_rect *r, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c);

#ifdef __cplusplus
}
#endif
#endif
