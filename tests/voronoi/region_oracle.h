/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Boundaries read by the oracle: its own arithmetic, its own geometry, nothing shared with src. */
#ifndef DYD_TESTS_VORONOI_REGION_H
#define DYD_TESTS_VORONOI_REGION_H

#include "delaunay/harness.h"
#include <dyadel/arc.h>

/* A boundary of case c; outer: of a Pos, whose region is on the other side of the curves; window: NULL or the window.
 */
typedef struct region {
  const dyd_boundary *b;
  const orc_case *c;
  bool outer;
  const orc_rect *window;
} region;

orc_point region_point(orc_pool *p, const dyd_surd_point *s);
/* Everything that arc.h states about chains, arcs and ends, site `site` being the one with the region. */
bool region_is_sound(char *message, orc_pool *p, const region *g, size_t site);
/* 1: strictly inside the region, 0: on the boundary, -1: strictly outside, 2: the lines through the point miss the
 * boundary, -2: the orientation of a chain is wrong. */
int region_side(orc_pool *p, const region *g, mpq_srcptr x, mpq_srcptr y);
/* A rational point strictly inside the arc (of its relative interior). */
orc_point region_sample(orc_pool *p, const region *g, const dyd_arc *a);

/* min over the others k that do not meet R_i of ds_k - dl_i (Int) or dl_k - ds_i (Pos): its sign; 1 for none. With
 * skip: others numbered skip are ignored. blocked: -1 for Int when some k meets R_i. Points outside the window: -1, on
 * its border at most 0. */
int literal_side(orc_pool *p, const region *g, size_t site, orc_point at);

#endif
