/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A coarse box tree for results that have no tree over single vertices: exact points, and collinear sites.
 *
 * Vertices are in spatial order, so a block of consecutive ones has a small box. Boxes are outward: those of the
 * representatives where these are the points, of the table of sites otherwise. It costs about 1.3 bytes a vertex. */
#include "base/alloc.h"
#include "skeleton/blocks.h"

static void block_widen(dyd_bbox *h, const dyd_bbox *b) {
  for (int a = 0; a < 4; a += 2) {
    h->e[a] = dyd_min(h->e[a], b->e[a]);
    h->e[a + 1] = dyd_max(h->e[a + 1], b->e[a + 1]);
  }
}

void dyd_vertex_box(dyd_bbox *out, const dyd_skeleton *sk, uint32_t v) {
  if (sk->rects.box) {
    *out = sk->rects.box[v];
  } else if (sk->all_points && dyd_reps_is_double(&sk->reps, v)) {
    dyd_xy p = sk->reps.xy[v];
    *out = (dyd_bbox){{p.x, p.x, p.y, p.y}};
  } else {
    dyd_sites_get_d(out->e, sk->rects.sites, sk->reps.site[v]);
  }
}

dyd_status dyd_blocks_build(dyd_skeleton *sk) {
  uint32_t count = sk->n / DYD_BLOCK + (sk->n % DYD_BLOCK != 0);
  uint32_t *item = dyd_alloc(count, sizeof *item);
  sk->block = dyd_alloc(count, sizeof *sk->block);
  if (!item || !sk->block) return free(item), DYD_E_NOMEM;
  for (uint32_t b = 0; b < count; b++) {
    dyd_bbox one;
    item[b] = b;
    dyd_vertex_box(&sk->block[b], sk, b * DYD_BLOCK);
    for (uint32_t v = b * DYD_BLOCK + 1; v < dyd_block_end(sk, b); v++) {
      dyd_vertex_box(&one, sk, v);
      block_widen(&sk->block[b], &one);
    }
  }
  return dyd_tree_init(&sk->blocks, item, count, sk->block);
}

void dyd_blocks_clear(dyd_skeleton *sk) {
  dyd_tree_clear(&sk->blocks);
  free(sk->block);
  sk->block = NULL;
}
