/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rectangles by vertex: exact ones in the table of sites, boxes in doubles around them, a tree over these.
 *
 * That is all a question about discs needs: whoever is not in the tree is nobody. */
#ifndef DYD_SKELETON_RECTS_H
#define DYD_SKELETON_RECTS_H

#include "base/index.h"
#include "base/invariant.h"
#include "rect/sites_table.h"
#include "skeleton/tree.h"

/* Invariant: box[v] holds the rectangle of site[v] for every v of the tree. */
typedef struct dyd_rects {
  const dyd_sites *sites;
  const uint32_t *site; /* vertex -> site; borrowed */
  dyd_bbox *box;
  dyd_tree tree;
} dyd_rects;

/* The rectangle of vertex v, exactly. */
static inline void dyd_rects_get(dyd_rect *out, const dyd_rects *r, uint32_t v) {
  dyd_status st = dyd_sites_get(out, r->sites, r->site[v]); /* fails for sites that do not exist */
  DYD_INVARIANT(st == DYD_OK);
  (void)st;
}
static inline bool dyd_rects_is_point(const dyd_rects *r, uint32_t v) {
  return dyd_sites_is_point(r->sites, r->site[v]);
}
/* Is box[v] the rectangle itself? */
static inline bool dyd_rects_in_doubles(const dyd_rects *r, uint32_t v) {
  return dyd_sites_in_doubles(r->sites, r->site[v]);
}
/* Brings the box of v up to date. */
static inline void dyd_rects_set_box(dyd_rects *r, uint32_t v) {
  dyd_sites_get_d(r->box[v].e, r->sites, r->site[v]);
}

#endif
