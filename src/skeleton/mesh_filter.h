/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and in-circle of representatives: in doubles, inlined into the skeleton's loops, and by all rungs, whose
 * answers are exact.
 *
 * u = 2^-53. Let every representative differ from its double by at most delta per coordinate (0 when they are doubles),
 * X, Y be the extents of all doubles, a, b, c, ... differences to the last point.
 *
 * Orientation [FLT-ORI]: d = ax by - ay bx. Each difference has relative error u, each product (1+u)^3 in all, the
 * subtraction one more u: |error| <= 4 u (1+u)^3 (|ax by| + |ay bx|) <= 8.01 u X Y < 1e-15 X Y. An error delta' <= 2
 * delta of each of four differences, each bounded by E = max(X, Y): <= 8 delta (E + 2 delta). Underflow of the two
 * products: below 2^-1073; added as 2^-1000. The bound is one number for the whole mesh; infinite or NaN: never
 * certain.
 *
 * In-circle [FLT-INC]: d = sum of la (b x c) with la = ax^2 + ay^2 and so on. la carries (1+u)^4, b x c an error of
 * at most ((1+u)^4 - 1)(|bx cy| + |by cx|), and |bx cy| + |by cx| <= sqrt(lb lc) <= (lb + lc)/2; the product one u, two
 * sums two u: |error| <= 11 u (1 + 20 u) (la lb + lb lc + lc la), and la lb + lb lc + lc la <= s^2/3, s = la + lb + lc.
 * The computed s is at least s (1 - 6u). So |error| <= 4.08e-16 s^2; 4.5e-16 leaves room for the rounding of the bound.
 * Underflow: an error of at most 2^-1074 in each product gives <= 20 * 2^-1074 (s + 1), covered by the excess 4e-17 s^2
 * when s >= 2^-400, and when s < 2^-400, |d| <= s^2 < 2^-800: so 2^-790 is added. delta: each partial derivative of d
 * by one of the six differences is at most 4 t^3 where t bounds the length of a, b, c along the way, t = sqrt(s) + 8
 * delta: 6 * 4 t^3 * 2 delta = 48 delta t^3; 60 leaves room. The ghost is NaN: not certain.
 *
 * Overflow: every term of d is at most s^2 (X Y for orientation), rounding is monotone, and the bound multiplies s s (X
 * Y) first: so if the bound is finite, no term has overflowed; if it is infinite, nothing is certain. */

/* Small integers [FLT-SMALL]: if all coordinates are multiples of a power of two q and the computed s <= 2^26 q^2, then
 * every difference is a multiple of q below 2^13 q, every lift and product of two a multiple of q^2 below 2^27 q^2,
 * every later partial sum a multiple of q^4 of size <= s^2 <= 2^52 q^4: all are doubles, nothing is rounded, d is
 * exact, given 2^-240 <= q <= 2^220 so that q^4 2^53 neither underflows nor overflows. */
#ifndef DYD_SKELETON_MESH_FILTER_H
#define DYD_SKELETON_MESH_FILTER_H

#include "skeleton/mesh.h"

#include <math.h>

#define DYD_INCIRCLE_BOUND 4.5e-16
#define DYD_INCIRCLE_TINY 0x1p-790

/* The orientation bound from the extents of the doubles [FLT-ORI]. */
static inline double dyd_filter_orient_bound(double extent_x, double extent_y, double delta) {
  double e = extent_x > extent_y ? extent_x : extent_y;
  return extent_x * extent_y * 1.01e-15 + 10 * delta * (e + 4 * delta) + 0x1p-1000;
}

/* A vertex seen from p: where it is, and its squared distance. Of two, seen from a third, the cross product is their
 * orientation; of three the squares and the cross products make the in-circle determinant. Code that tests many
 * triangles from one place computes each of them once. */
typedef struct dyd_seen {
  double x, y, square;
} dyd_seen;

static inline dyd_seen dyd_see(dyd_xy a, dyd_xy p) {
  double x = a.x - p.x, y = a.y - p.y;
  return (dyd_seen){x, y, x * x + y * y};
}
static inline double dyd_seen_cross(dyd_seen a, dyd_seen b) {
  return a.x * b.y - a.y * b.x;
}

/* The squares of a, b, c and the cross products of the other two. */
typedef struct dyd_incircle {
  double la, lb, lc, bc, ca, ab;
} dyd_incircle;

static inline dyd_incircle dyd_incircle_from(dyd_seen a, dyd_seen b, dyd_seen c) {
  double bc = dyd_seen_cross(b, c), ca = dyd_seen_cross(c, a), ab = dyd_seen_cross(a, b);
  return (dyd_incircle){a.square, b.square, c.square, bc, ca, ab};
}
static inline dyd_incircle dyd_incircle_of(dyd_xy a, dyd_xy b, dyd_xy c, dyd_xy p) {
  return dyd_incircle_from(dyd_see(a, p), dyd_see(b, p), dyd_see(c, p));
}

/* 1, -1: certain sign of a cross product; 0: not certain. */
static inline int dyd_filter_turn(const dyd_mesh *m, double d) {
  if (d > m->orient_bound) return 1;
  return d < -m->orient_bound ? -1 : 0;
}
static inline int dyd_filter_orient(const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy p) {
  return dyd_filter_turn(m, dyd_seen_cross(dyd_see(a, p), dyd_see(b, p)));
}

static inline int dyd_filter_incircle_at(const dyd_mesh *m, dyd_incircle i) {
  double d = i.la * i.bc + i.lb * i.ca + i.lc * i.ab;
  double s = i.la + i.lb + i.lc, e = s * s * DYD_INCIRCLE_BOUND + DYD_INCIRCLE_TINY;
  if (m->incircle_delta > 0) {
    double t = sqrt(s) + 8 * m->incircle_delta;
    e += 60 * m->incircle_delta * t * t * t;
  }
  if (d > e) return 1;
  return d < -e ? -1 : 0;
}

/* After the in-circle filter was unsure: true and the exact sign when small integers make doubles exact [FLT-SMALL]. */
static inline bool dyd_filter_incircle_small(int *sign, const dyd_mesh *m, dyd_incircle i) {
  if (!(i.la + i.lb + i.lc <= m->exact_s)) return false;
  double d = i.la * i.bc + i.lb * i.ca + i.lc * i.ab;
  *sign = (d > 0) - (d < 0);
  return true;
}

/* The same for orientation: then both products and their difference are exact [FLT-SMALL]. */
bool dyd_filter_orient_small(int *sign, const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy p);
/* After the mesh-wide orientation bound was unsure: the bound for these three points alone [FLT-ORI]. */
int dyd_filter_orient_near(const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy p);
/* After the in-circle filter was unsure: the permanent instead of its estimate s^2/3 [FLT-INC], for triangles with one
 * far vertex. la, bx cy, ... as before: |error| <= ((1+u)^11 - 1)(sum of la (|bx cy| + |by cx|)), computed with a
 * relative error below 20 u: 11.05 u leaves room. Underflow: <= 20 * 2^-1074 (s + 1). */
int dyd_filter_incircle_near(const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy c, dyd_xy p);

/* Circumcentre in doubles, a guess without a bound; NaN or infinite for collinear points. */
static inline dyd_xy dyd_circumcentre(dyd_xy a, dyd_xy b, dyd_xy c) {
  double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  double lb = bx * bx + by * by, lc = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  return (dyd_xy){a.x + (cy * lb - by * lc) / d, a.y + (bx * lc - cx * lb) / d};
}

/* ---- the decisions, by all rungs: filter, 64-bit integers, GMP ---- */

/* Exact sign of the orientation of three real vertices: > 0 left turn. */
int dyd_mesh_orient(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* Exact sign: > 0 iff p lies strictly inside the circle of the counter-clockwise triangle abc; for a ghost triangle:
 * strictly beyond the hull edge or on it between its ends. p is real; 0 also at ties. */
int dyd_mesh_incircle(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
/* The same for the triangle left of h and the vertex beyond h: 0 where the two triangles are cocircular, or on one line
 * with the ghost. */
int dyd_mesh_beyond(dyd_tally *tally, const dyd_mesh *m, dyd_half_edge h);
/* An edge in a face (or a whole) of exact points bounded by certain edges: legal iff not cocircular, a hull edge
 * always, a ghost edge iff its vertex is not on the line of its neighbours [TIE-2]. Exact. */
bool dyd_point_edge_is_certain(dyd_tally *tally, const dyd_mesh *m, dyd_half_edge h);

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
/* Representatives have been chosen anew: the filter constants follow, and the common grid goes. */
void dyd_mesh_follow(dyd_mesh *m);
/* m, a part that grows by `right`: the grid of both, or none yet. m takes the grid of `whole`, which has none
 * afterwards. Only for meshes whose representatives are doubles. */
void dyd_fixed_join(dyd_mesh *m, const dyd_mesh *right);
void dyd_fixed_take(dyd_mesh *m, dyd_mesh *whole);

/* ---- the last rung: GMP ---- */

/* The exact representative of vertex v as a singleton rectangle. */
dyd_status dyd_mesh_get(dyd_rect *out, const dyd_mesh *m, uint32_t v);
/* Exact signs for real vertices, by integers. */
int dyd_mesh_orient_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
int dyd_mesh_incircle_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);
/* Which comes first in the order of x, then y: below 0, a. */
int dyd_mesh_compare(const dyd_mesh *m, uint32_t a, uint32_t b);
/* Returns true if p, known to be collinear with a and b, lies strictly between them. */
bool dyd_mesh_between(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p);

/* ---- the invariant ---- */

/* Twins agree, triangles turn left, every edge is locally (weakly) Delaunay, the hull is one cycle that turns once:
 * hence the whole is a Delaunay triangulation. Exact; O(n). */
bool dyd_mesh_is_valid(const dyd_mesh *m);

#endif
