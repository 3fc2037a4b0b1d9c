/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Goals: those on pairs, run.c, and those on the Voronoi diagram. */
#ifndef DYD_ENGINE_GOAL_VORONOI_H
#define DYD_ENGINE_GOAL_VORONOI_H

#include "engine/state.h"
#include "metric/bounds.h"

static inline bool dyd_goal_is_voronoi(dyd_goal goal) {
  return goal == DYD_GOAL_VORONOI_AREA || goal == DYD_GOAL_VORONOI_HAUSDORFF;
}
/* Sets *out to whether the other goals hold for pd; m: of its sites. */
dyd_status dyd_goal_of_pairs_holds(bool *out, dyd_measure *m, const dyd_delaunay *pd, const dyd_engine_options *o);
/* Returns true if a window is given, with positive area and dyadic ends. */
bool dyd_goal_window_is_good(const dyd_rect *window);
/* Sets *out to whether the goal, one of these two, holds. If it does not, *sums, NULL before, keeps the sums found, for
 * the plan; freed by dyd_goal_sums_free, whatever is returned. */
dyd_status dyd_goal_voronoi_holds(bool *out, dyd_voronoi_sums **sums, const dyd_engine *e, const dyd_engine_options *o);
void dyd_goal_sums_free(dyd_voronoi_sums **sums);
/* What a pair contributes to the bound; infinite when its rectangles meet, unless that does no harm to the goal. */
dyd_status dyd_goal_voronoi_number(mpfr_ptr out, dyd_voronoi_sums *sums, dyd_measure *m, const dyd_pair *pair,
                                   const dyd_engine_options *o);
/* By how many bits the enclosure of the Voronoi vertex of a certain triangle is wider than 2^-M; at most 0 when it is
 * not, or lies outside of the window. */
dyd_status dyd_goal_vertex_excess(int64_t *out, const dyd_engine *e, const dyd_triangle *t,
                                  const dyd_engine_options *o);

#endif
