/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A coarse box tree over blocks of vertices, where there is no tree over single ones. */
#ifndef DYD_SKELETON_BLOCKS_H
#define DYD_SKELETON_BLOCKS_H

#include "delaunay/state.h"

enum { DYD_BLOCK = 32 };

/* Builds pd->block and pd->blocks over all vertices, aliases included; needs reps and all_points. On failure
 * dyd_blocks_clear is due as well. */
dyd_status dyd_blocks_build(dyd_delaunay *pd);
void dyd_blocks_clear(dyd_delaunay *pd);
/* One beyond the last vertex of block b. */
static inline uint32_t dyd_block_end(const dyd_delaunay *pd, uint32_t b) {
  return pd->n - b * DYD_BLOCK < DYD_BLOCK ? pd->n : (b + 1) * DYD_BLOCK;
}
/* An outward box of the rectangle of v. */
void dyd_vertex_box(dyd_bbox *out, const dyd_delaunay *pd, uint32_t v);

#endif
