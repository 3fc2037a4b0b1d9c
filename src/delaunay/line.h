/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* When every choice of points is collinear, or there are at most two sites. */
#ifndef DYD_DELAUNAY_LINE_H
#define DYD_DELAUNAY_LINE_H

#include "delaunay/state.h"

/* Fills pd->line from the rectangles of the vertices that are not aliases. */
dyd_status dyd_line_build(dyd_delaunay *pd);
void dyd_line_clear(dyd_line *l);
/* Status of two different vertices that are not aliases. */
dyd_pair_status dyd_line_status(const dyd_line *l, uint32_t i, uint32_t j);
/* Number of pairs that are possible and not legal. */
size_t dyd_line_open_pairs(const dyd_line *l);
size_t dyd_line_legal_pairs(const dyd_line *l);

#endif
