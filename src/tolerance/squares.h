/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A pair of squares of half-width t about nominal places, and the others that are looked at for it [TOL-9]. */
#ifndef DYD_TOLERANCE_SQUARES_H
#define DYD_TOLERANCE_SQUARES_H

#include "skeleton/work.h"
#include "tolerance/state.h"

/* Invariant: i and j are not among seen, and no vertex is twice. While it is built, site 0 of sites is the square of i,
 * 1 that of j, 2 + k that of seen[k], each rounded outward by less than 2^exp, and the skeleton and work are theirs. */
typedef struct dyd_squares {
  dyd_tolerance *t;
  uint32_t i, j; /* vertices of t */
  dyd_others seen;
  double now; /* the half-width */
  int64_t exp;
  mpq_t half, end[2]; /* the half-width; scratch */
  dyd_sites *sites;
  dyd_skeleton sk;
  dyd_work work;
  dyd_xy guess;   /* about where a witness is likely */
  dyd_point c;    /* the witness found */
  dyd_bbox place; /* where a pair is seen to be legal, or possible; NaN: nowhere in the plane */
} dyd_squares;

/* Squares are rounded at 2^-DYD_SQUARE_BITS of their half-width. */
enum { DYD_SQUARE_BITS = 24 };

/* squares_build.c. The square of a vertex of t, exactly but for that rounding. */
dyd_status dyd_square_of(dyd_rect *out, dyd_squares *q, uint32_t v);
/* i, j and seen at half-width t. A failure leaves nothing built. */
dyd_status dyd_squares_build(dyd_squares *q, double t);
void dyd_squares_unbuild(dyd_squares *q);

/* squares_filter.c. Looks at v from now on; *more: it was not seen before. */
dyd_status dyd_squares_see(bool *more, dyd_squares *q, uint32_t v);
/* About where the circle that binds in the plane of exact points is, for a row of these. */
dyd_xy dyd_squares_guess(const dyd_squares *q, uint32_t k, uint32_t l);
/* Looks at whose squares do not surely keep out of the witness disc about q->c: a few at most. *more: there are some.
 */
dyd_status dyd_squares_see_rivals(bool *more, dyd_squares *q);
/* Looks at who is not surely too far to block the place at which the work sees a possible pair: a few at most. */
dyd_status dyd_squares_see_blockers(bool *more, dyd_squares *q);
/* Puts the two of seen first that are about nearest to q->place, one on each side of ij, by their nearest points, or
 * `far` ones; *k < *l become their vertices, DYD_NONE where there is none. Unchanged where doubles do not tell. */
void dyd_squares_bind(uint32_t *k, uint32_t *l, dyd_squares *q, bool far);

#endif
