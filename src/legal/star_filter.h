/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The quick pass over all vertices, in doubles. */
#ifndef DYD_LEGAL_STAR_FILTER_H
#define DYD_LEGAL_STAR_FILTER_H

#include "base/parallel.h"
#include "skeleton/skeleton.h"

#include <math.h>

/* Marking certain edges from several ranges of triangles.
 *
 * An edge is marked in both its triangles. Those inside of a range are marked at once; edges that reach into another
 * range wait in a list until all are done. */
typedef struct dyd_marks {
  size_t first, end;
  dyd_half_edge *edge;
  size_t count, cap;
  dyd_status status;
} dyd_marks;

/* Half-edge h, of a triangle in the range, is certain. Sets status on failure. */
void dyd_mark(dyd_marks *marks, dyd_skeleton *sk, dyd_half_edge h);
/* Remembers the edge for later; sets status on failure. */
void dyd_mark_later(dyd_marks *marks, dyd_half_edge h);
/* Edges that waited become certain, or uncertain; their lists are freed. The first failure of a range. */
dyd_status dyd_marks_settle(dyd_marks *marks, size_t ranges, dyd_skeleton *sk, bool certain);

/* Marks the edges whose first guess is proved a witness, and vertices that are certainly on the hull [FLT-STAR]. */
dyd_status dyd_certify_stars(dyd_skeleton *sk, unsigned threads);

/* Certifying an edge in doubles from its two triangles alone.
 *
 * Let every site lie within E of its representative p_k, ij a skeleton edge with triangles iju (left) and jiv (right)
 * of empty circles (c1,r1), (c2,r2), |ij| = 2h, m <= the distances of p_i and p_j to their nearest representatives
 * (attained on skeleton edges), r = max(r1,r2), D = |c1-c2|.
 *
 * [WIT-NEAR] If E <= m/199 and 24.25 E r^2 < m h D, then c = (c1+c2)/2 is a witness.
 *   Proof. rho = |c-p_i| <= r, as |.-p_i| is convex along the bisector of ij. If k breaks the witness, |c-p_k| - E <=
 * rho + E, so P := |c-p_k|^2 - rho^2 <= W := 4 E rho + 4 E^2 <= 4.041 E r. The power of p_k is affine along the
 * bisector, so P is the mean of its powers P1, P2 >= 0 for the two circles, and |P1-P2| = 2 D |t|, t the distance of
 * p_k from the line ij: D |t| <= P
 *   <= W, |t| <= tau := W/D. With s the coordinate of p_k along ij from the middle, P = s^2 - h^2 + t^2 - 2 t t_c,
 * |t_c| <= rho: | |s| - h | <= (W + tau^2 + 2 tau r)/h. D <= 2 r gives W = tau D <= 2 tau r; the assumption gives tau <
 * m h/(6 r) <= r (m <= 2h, h <= r), so p_k is within tau + 5 tau r/h <= 6 tau r/h < m of p_i or p_j: a contradiction.
 * [WIT-HULL] Hull edge, iju inside: if E <= m/199 and 48.5 E r1 < m h, then c = c1 + r1 n, n the outward normal, is a
 *   witness: the same proof with r = 2 r1 and P = P1 + 2 r1 t, t >= 0, that is D = r.
 *
 * With a1, a2 twice the areas, det > 0 the in-circle determinant, lu = |iu|^2, lw = |ju|^2, lv = |iv|^2, lz = |jv|^2:
 * r1^2 = |ij|^2 lu lw/(4 a1^2), r2^2 = |ij|^2 lv lz/(4 a2^2), D = det |ij|/(2 a1 a2). The conditions become 24.25 E lu
 * lw a2 < m det a1 and 24.25 E lv lz a1 < m det a2;   48.5 E sqrt(lu lw) < m a1.
 *
 * Rounding, u = 2^-53: a has an absolute error <= 4.01 u (|jx uy| + |jy ux|) <= 2.1 u (lj + lu), det one <= 4.5e-16 s^2
 * [FLT-INC]; both are moved to the safe side. Fewer than 40 factors 1+u remain: 24.3 for 24.25 and 48.6
 * for 48.5 have room. Nothing underflows: a >= 2^-100 and squares <= 2^100 make squares >= 2^-300, det >= 2^-300, E >=
 * 2^-300. NaN (the ghost) fails. */

static inline double dyd_square_distance(dyd_xy a, dyd_xy b) {
  double x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

/* reach: E >= 2^-300. m: as above, up to a relative error of 10^-12. */
static inline bool dyd_filter_edge_near(dyd_xy i, dyd_xy j, dyd_xy u, dyd_xy v, double reach, double m) {
  double jx = j.x - i.x, jy = j.y - i.y, ux = u.x - i.x, uy = u.y - i.y, vx = v.x - i.x, vy = v.y - i.y;
  double lj = jx * jx + jy * jy, lu = ux * ux + uy * uy, lv = vx * vx + vy * vy, s = lj + lu + lv;
  double a1 = jx * uy - jy * ux, a2 = vx * jy - vy * jx, cross = ux * vy - uy * vx;
  double ea = 2.1 * 0x1p-53 * s, det = (lj * cross + lu * a2 + lv * a1) - 4.5e-16 * s * s;
  double lw = dyd_square_distance(j, u), lz = dyd_square_distance(j, v), k = 24.3 * reach;
  if (!(a1 - ea >= 0x1p-100 && a2 - ea >= 0x1p-100 && s <= 0x1p98 && det >= 0x1p-300 && 200 * reach <= m)) return false;
  return k * (lu * lw) * (a2 + ea) < m * det * (a1 - ea) && k * (lv * lz) * (a1 + ea) < m * det * (a2 - ea);
}

static inline bool dyd_filter_hull_edge_near(dyd_xy i, dyd_xy j, dyd_xy u, double reach, double m) {
  double jx = j.x - i.x, jy = j.y - i.y, ux = u.x - i.x, uy = u.y - i.y;
  double lj = jx * jx + jy * jy, lu = ux * ux + uy * uy, lw = dyd_square_distance(j, u);
  double a1 = (jx * uy - jy * ux) - 2.1 * 0x1p-53 * (lj + lu);
  if (!(a1 >= 0x1p-100 && lj + lu <= 0x1p98 && 200 * reach <= m)) return false;
  return 48.6 * reach * sqrt(lu * lw) < m * a1;
}

/* The length below which a two-hundredth of the edges are, by a sample: clusters count by their vertices, not by their
 * width. A guess, for limits that may be any; 0 without edges. */
double dyd_short_edge(const dyd_mesh *m);
/* The first quick pass, for representatives that are doubles and sites within `reach` of them: marks the edges that
 * their two triangles prove legal. met (NULL: no site is farther): from dyd_fat_meet for sites that are farther. most:
 * the distance tried first, any, best dyd_short_edge. */
dyd_status dyd_certify_near(dyd_skeleton *sk, unsigned threads, double reach, const uint32_t *met, double most);

/* Which triangles a few large rectangles can spoil for the first pass [WIT-FAT]. *met, released with free(): a number
 * for each triangle, 0 when no rectangle of the vertices fat[0 .. count-1] comes within `reach` of its circle (of a
 * ghost triangle: of the half-plane beyond its hull edge). NULL when that would take too long, or count is 0.
 * Representatives are doubles. Cost: the triangles that are met. */
dyd_status dyd_fat_meet(uint32_t **met, const dyd_skeleton *sk, const uint32_t *fat, uint32_t count, double reach);

#endif
