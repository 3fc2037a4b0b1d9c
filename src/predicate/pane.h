/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The panes of the plane in which all three rectangles show the centre one fixed feature each.
 *
 * The far corner of an F-rectangle changes where the centre crosses a middle line of it, the closest feature of a
 * C-rectangle where it crosses the line of a side. These lines cut each axis into at most six slabs and the plane
 * into at most 36 closed panes. In a pane the far point of F is one corner, and the closest point of C is one corner,
 * or the foot on one side (the other coordinate is free), or the centre itself. */
#ifndef DYD_PREDICATE_PANE_H
#define DYD_PREDICATE_PANE_H

#include "predicate/interval_filter.h"
#include "rect/irect.h"
#include <dyadel/predicate.h>

/* A coordinate of a feature. Invariant: if `at` is not NULL, `near` encloses (at - origin) * 2^-shift. */
typedef struct dyd_mark {
  mpz_srcptr at; /* NULL: free */
  dyd_iv near;
} dyd_mark;

/* lo2 <= 2 t <= hi2 (NULL: no bound); lo, hi enclose the bounds of t, relative to the origin as above. */
typedef struct dyd_slab {
  mpz_srcptr lo2, hi2;
  dyd_iv lo, hi;
  dyd_mark mark[3];
} dyd_slab;

/* One axis cut into slabs, lowest first. The marks point into the rectangles, the bounds into line2. */
typedef struct dyd_axis {
  mpz_t line2[6];
  dyd_slab slab[7];
  size_t slabs;
} dyd_axis;

/* An enclosure of (z - origin) * 2^-shift; scratch is overwritten. */
dyd_iv dyd_filter_near(mpz_srcptr z, mpz_srcptr origin, int64_t shift, mpz_ptr scratch);

/* true: no circle through the three features has its centre in the closed pane x times y. base is the number of an
 * F-rectangle. Proved by interval arithmetic; false when in doubt. */
bool dyd_filter_pane_empty(const dyd_slab *x, const dyd_slab *y, int base);

#endif
