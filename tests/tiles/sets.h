/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Small sets of points and rectangles that are hard for tiles. */
#ifndef DYD_TESTS_TILES_SETS_H
#define DYD_TESTS_TILES_SETS_H

#include "support/random.h"
#include "tiles/tiles.h"

enum { SETS_MOST = 160 };

/* dim: 2, x y, or 4, xlo xhi ylo yhi. */
typedef struct sets_case {
  unsigned dim;
  size_t n;
  double end[SETS_MOST][4];
} sets_case;
/* least .. most of them: clusters, lines, circles, grids, flat curves, at scales of their own; points, thin, wide and
 * long rectangles; moved far from 0, stretched, tiny or huge. */
void sets_make(sets_case *s, test_random *r, size_t least, size_t most);
/* All of it, or each alone, to where squares of doubles are not doubles. */
void sets_stretch(sets_case *s, test_random *r);
/* A rectangle 0, a small one 1, and exact points about a disc that holds both, but for a gap: a point there may be far
 * from everything that the possible pairs of 0 and 1 depend on, and leaves no witness of their legal pair. */
void sets_hidden(sets_case *s, test_random *r);
/* The same in one engine; the caller frees it. NULL: pairs are so many that much of this would
 * take long. */
dyd_engine *sets_engine(const sets_case *s);
/* For the log. */
void sets_print(const sets_case *s);

#endif
