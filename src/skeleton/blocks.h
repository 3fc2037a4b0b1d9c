/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A coarse box tree over blocks of vertices, where there is no tree over single ones. */
#ifndef DYD_SKELETON_BLOCKS_H
#define DYD_SKELETON_BLOCKS_H

#include "skeleton/skeleton.h"

enum { DYD_BLOCK = 32 };

/* Builds sk->block and sk->blocks over all vertices, aliases included; needs reps and all_points. On failure
 * dyd_blocks_clear is due as well. */
dyd_status dyd_blocks_build(dyd_skeleton *sk);
void dyd_blocks_clear(dyd_skeleton *sk);
/* One beyond the last vertex of block b. */
static inline uint32_t dyd_block_end(const dyd_skeleton *sk, uint32_t b) {
  return sk->n - b * DYD_BLOCK < DYD_BLOCK ? sk->n : (b + 1) * DYD_BLOCK;
}
/* An outward box of the rectangle of v. */
void dyd_vertex_box(dyd_bbox *out, const dyd_skeleton *sk, uint32_t v);

#endif
