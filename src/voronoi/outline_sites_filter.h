/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sites of a cell in doubles, points of arcs, and the parts taken from them. */
#ifndef DYD_VORONOI_OUTLINE_SITES_FILTER_H
#define DYD_VORONOI_OUTLINE_SITES_FILTER_H

#include "voronoi/outline.h"

/* The site and its neighbours with at least the status `least`. DYD_OK or DYD_E_NOMEM. */
dyd_status dyd_outline_load(dyd_outline *o, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least);
/* The same of a site and others that are given: rect[0] the own one, rect[1 ..] the others; borrowed. */
dyd_status dyd_outline_load_rects(dyd_outline *o, uint32_t own, const dyd_rect *const *rect, const uint32_t *other,
                                  size_t count);
void dyd_outline_clear(dyd_outline *o);
/* Coordinate a of a point, not relative to the origin. */
dyd_iv dyd_outline_coordinate(const dyd_outline *o, const dyd_outline_spot *p, int a);
/* Order of a and b; equal only as numbers that are known. Sets *unsure where it is not known. */
static inline int dyd_outline_order(bool *unsure, dyd_iv a, dyd_iv b) {
  if (a.lo > b.hi) return 1;
  if (a.hi < b.lo) return -1;
  if (!(a.lo == a.hi && b.lo == b.hi)) *unsure = true;
  return 0;
}

/* The other coordinate where coordinate k is t. */
dyd_iv dyd_outline_arc_other(const dyd_filter_arc *arc, int k, dyd_iv t);
/* The point of an arc at t along its axis. */
dyd_outline_spot dyd_outline_arc_at(const dyd_outline_arc *a, dyd_iv t);

/* Only sites other than `own` take points from now on; o->count: all others. */
void dyd_outline_exclude(dyd_outline *o, size_t own);
/* Returns true if a rival certainly takes all points of the box. */
bool dyd_outline_taken(dyd_outline *o, const dyd_iv at[2]);
/* Sets the span of an arc; returns true if rivals certainly take all of it. Its boundary points are boundary of nothing
 * then, and cuts there decide nothing [PRUNE-1]. */
bool dyd_outline_arc_taken(dyd_outline *o, dyd_outline_arc *a);
/* May a rival, or other k, take a point of the box? */
bool dyd_outline_may_be_taken(const dyd_outline *o, const dyd_iv at[2]);
bool dyd_outline_may_take(const dyd_outline *o, size_t k, const dyd_iv at[2]);
/* Sets the numbers that are relative to the origin, for a window; false: some other meets the site. */
bool dyd_outline_place(dyd_outline *o, const dyd_rect *window);
/* Bounds of Pos: from a box round the site whose sides are taken, and from its pieces. */
void dyd_outline_limit_by_box(dyd_outline *o);
void dyd_outline_limit_by_parts(dyd_outline *o);
/* The window cut down to the limits. */
void dyd_outline_set_bounds(dyd_outline *o);

#endif
