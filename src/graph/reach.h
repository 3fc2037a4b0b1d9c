/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a few rectangles decide exactly about neighbours of the first of them [NNG-1] [GAB-1].
 *
 * "For some choice" is a place in a box where no third rectangle is surely too near. For the nearest neighbour that
 * is a place x in R_i with ds_j(x) <= dl_k(x) for all k; for the Gabriel graph, whose edges have nobody in the disc
 * they are a diameter of, a middle m of points of R_i and R_j with r(m) <= dl_k(m), r(m) half the least distance of two
 * points with that middle: by each coordinate the larger of the distances of m to both sides. So both ask whether
 *
 *     min over k of dl_k(x)^2 - rho(x),   rho = rho_x + rho_y,   rho_a = max over one or two sides of ds^2
 *
 * is anywhere in a box at least 0. Cut along the ends of the sides, and where those of two are equally far, rho_a is 0
 * or (x_a - e)^2. There dl_k^2 - rho is convex: a k that is too near at four corners is so in between. Cut through the
 * middles of the k as well, each dl_k is the distance of one corner; where that of k is the least of all, a convex
 * polygon, the convex function dl_k^2 - rho is largest at one of its corners, which are rational. */
#ifndef DYD_GRAPH_REACH_H
#define DYD_GRAPH_REACH_H

#include "rect/irect.h"
#include <dyadel/sites.h>

/* Invariant: rect, grid, mark are initialised up to made; grid[0 .. count-1] are the rectangles asked about, all
 * multiplied by one factor, so that all ends are multiples of 4. */
typedef struct dyd_reach {
  dyd_rect *rect;
  const dyd_rect **in;
  dyd_irect *grid;
  bool *mark;
  size_t count, made;
  mpz_t rho, d, e; /* scratch */
} dyd_reach;

void dyd_reach_init(dyd_reach *r);
void dyd_reach_clear(dyd_reach *r);
/* grid[0] becomes site i, grid[1 ..] the others. DYD_E_NOMEM, DYD_E_RANGE as dyd_sites_get. */
dyd_status dyd_reach_load(dyd_reach *r, const dyd_sites *sites, uint32_t i, const uint32_t *other, size_t count);

/* Is number j (from 1) the nearest one to number 0 for some choice (ties included), for every choice (alone)? */
bool dyd_reach_may_be_nearest(dyd_reach *r, size_t j);
bool dyd_reach_is_nearest(dyd_reach *r, size_t j);
/* Is the open disc with 0 and j as ends of a diameter free of the others for some choice; is the closed one for every
 * choice? */
bool dyd_reach_may_be_gabriel(dyd_reach *r, size_t j);
bool dyd_reach_is_gabriel(dyd_reach *r, size_t j);

#endif
