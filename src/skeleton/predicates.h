/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and in-circle of the skeleton's vertices, by all rungs: the answers are exact. */
#ifndef DYD_SKELETON_PREDICATES_H
#define DYD_SKELETON_PREDICATES_H

#include "skeleton/mesh.h"
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

/* The same for the builder of m: counts in the tally of m, and makes its grid of integers when first needed. */
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

/* ---- the middle rung: representatives as 64-bit integers on one common grid, products in 128 and 256 bits ---- */

/* Puts all representatives of m on a common grid with coordinates below 2^60, if there is one and that was not tried
 * yet; sets m->fixed or m->no_fixed. Never fails: without memory or grid, m->no_fixed. O(n), once per mesh. */
void dyd_fixed_prepare(dyd_mesh *m);
/* Exact signs; m->fixed is set. */
int dyd_fixed_orient(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* Exact sign on a grid of the four points' own, or on the common one; false when neither exists. */
bool dyd_fixed_incircle(int *sign, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
void dyd_fixed_free(dyd_fixed *f);
/* m, a part that grows by `right`: the grid of both, or none yet. m takes the grid of `whole`, which has none
 * afterwards. Only for meshes whose representatives are doubles. */
void dyd_fixed_join(dyd_mesh *m, const dyd_mesh *right);
void dyd_fixed_take(dyd_mesh *m, dyd_mesh *whole);

/* ---- the last rung: GMP ---- */

/* Exact signs for real vertices, by integers. */
int dyd_mesh_orient_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
int dyd_mesh_incircle_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
/* Which comes first in the order of x, then y: below 0, a. */
int dyd_mesh_compare(const dyd_mesh *m, uint32_t a, uint32_t b);
/* Returns true if p, known to be collinear with a and b, lies strictly between them. */
bool dyd_mesh_between(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p);
/* Returns true if the representatives of a and b are the same exact point. */
bool dyd_mesh_same(const dyd_mesh *m, uint32_t a, uint32_t b);

#endif
