/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* When every choice of points is collinear, or there are at most two sites: the skeleton is a path. */
#ifndef DYD_SKELETON_LINE_H
#define DYD_SKELETON_LINE_H

#include "skeleton/mesh.h"
#include "skeleton/rects.h"

/* The vertices that are no aliases, along the common line. legal[q]: order[q], order[q+1] is legal. rank[order[q]] is
 * q. is_end[0], is_end[1]: the first, the last is surely an end of the line, alone. count = 0: no line. */
typedef struct dyd_line {
  uint32_t count;
  uint32_t *order, *rank;
  bool *legal, is_end[2];
} dyd_line;

/* From the rectangles of the n vertices. Those that turn out to be the same exact point become aliases in m. */
dyd_status dyd_line_build(dyd_line *l, dyd_mesh *m, const dyd_rects *rects, uint32_t n);
void dyd_line_clear(dyd_line *l);
/* Are these neighbours on the line, and legal? */
bool dyd_line_is_legal(const dyd_line *l, uint32_t v, uint32_t w);
/* Is v an end of the line, and apart from all others, for every choice? */
bool dyd_line_is_end(const dyd_line *l, uint32_t v);
size_t dyd_line_legal_pairs(const dyd_line *l);
/* Number of pairs that are possible and not legal. */
size_t dyd_line_open_pairs(const dyd_line *l);

#endif
