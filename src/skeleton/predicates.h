/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and in-circle of the skeleton's vertices, by all rungs: the answers are exact. */
#ifndef DYD_SKELETON_PREDICATES_H
#define DYD_SKELETON_PREDICATES_H

#include "skeleton/mesh_filter.h"

/* Exact sign of the orientation of three real vertices: > 0 left turn. */
int dyd_mesh_orient(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* Exact sign: > 0 iff p lies strictly inside the circle of the counter-clockwise triangle abc; for a ghost triangle:
 * strictly beyond the hull edge or on it between its ends. p is real; 0 also at ties. */
int dyd_mesh_incircle(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);

/* In doubles alone: true and the sign where they know it; never without filters. Exact ties of small integers are known
 * here [FLT-SMALL]: on a grid every other test is one. */
static inline bool dyd_incircle_known(int *sign, dyd_tally *tally, const dyd_mesh *m, dyd_incircle i) {
  tally->asked++;
  if ((*sign = dyd_filter_incircle_at(m, i))) return true;
  if (!(m->exact_s > 0) || !dyd_filter_incircle_small(sign, m, i)) return false;
  tally->ties += !*sign;
  return true;
}
static inline bool dyd_incircle_quick(int *sign, dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b,
                                      uint32_t c, uint32_t p) {
  return dyd_incircle_known(sign, tally, m, dyd_incircle_of(m->xy[a], m->xy[b], m->xy[c], m->xy[p]));
}

/* The same for whoever builds m: counts in its tally, and makes its grid of integers at the first need. */
int dyd_build_orient_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* d: the cross product of a and b seen from c. */
static inline int dyd_build_turn(dyd_mesh *m, double d, uint32_t a, uint32_t b, uint32_t c) {
  m->tally.asked++;
  int sign = dyd_filter_turn(m, d);
  return sign ? sign : dyd_build_orient_slow(m, a, b, c);
}
static inline int dyd_build_orient(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  return dyd_build_turn(m, dyd_seen_cross(dyd_see(m->xy[a], m->xy[c]), dyd_see(m->xy[b], m->xy[c])), a, b, c);
}
int dyd_build_incircle_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
static inline int dyd_build_incircle(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int sign;
  return dyd_incircle_quick(&sign, &m->tally, m, a, b, c, p) ? sign : dyd_build_incircle_slow(m, a, b, c, p);
}

/* Adds what was counted to the public counters: tests that were not passed on were answered by a filter. */
void dyd_tally_add(dyd_delaunay_counters *sum, const dyd_tally *tally, bool no_filter);

#endif
