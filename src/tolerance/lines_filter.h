/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The lines over a bisector (lines.h) in doubles, with error bounds [FLT-TOL]. */
#ifndef DYD_TOLERANCE_LINES_FILTER_H
#define DYD_TOLERANCE_LINES_FILTER_H

#include "skeleton/skeleton.h"

/* Where the points are: xy + low, low NULL where xy is exact. slack bounds the error of a difference of two
 * coordinates beyond its rounding. usable: the caller rounds to nearest. */
typedef struct dyd_points_d {
  const dyd_xy *xy, *low;
  double slack;
  bool usable;
} dyd_points_d;

enum { DYD_LINES_D = 48 };
/* Of one pair: P = p_k - p_i, Q = p_k - p_j, m and n as in lines.h, all rounded. span: the largest |P| + |Q| (sum
 * norms), so that all errors have one bound. Vertices may be named twice. */
typedef struct dyd_lines_d {
  double jx, jy, jj, ejj, span;
  uint32_t i, j, count;
  double px[DYD_LINES_D], py[DYD_LINES_D], qx[DYD_LINES_D], qy[DYD_LINES_D], m[DYD_LINES_D], n[DYD_LINES_D];
  uint32_t vertex[DYD_LINES_D];
} dyd_lines_d;

/* One of them: em, en, ea bound the errors of m, n and along = P.J; hm, hn those of m and n in units of 6 * 2^-53, so
 * they are at least the sums of the sizes of the products. */
typedef struct dyd_line_d {
  double m, n, along, em, en, ea, hm, hn;
  uint32_t vertex;
} dyd_line_d;

/* What binds: two vertices, or one twice; lo and hi bound the death, hi <= (1 + 2^-40) lo. */
typedef struct dyd_death_d {
  double lo, hi;
  uint32_t k, l;
  double s; /* the place, see lines.h; end: -1 or 1 for an end of the bisector */
  int end;
} dyd_death_d;

/* false: doubles cannot hold the pair well. */
bool dyd_filter_pair(dyd_lines_d *l, const dyd_points_d *p, uint32_t i, uint32_t j);
/* Adds lines of vertices; false: there is no room. */
bool dyd_filter_add(dyd_lines_d *l, const dyd_points_d *p, const uint32_t *k, uint32_t count);
dyd_line_d dyd_filter_line(const dyd_lines_d *l, const dyd_points_d *p, uint32_t number);
/* The death of a strictly Delaunay pair with these others; false: not sure. `box` (may be NULL) gets a box around the
 * centre, *radius2 an upper bound of its squared distance to the sites that bind; infinite for a half-plane. */
bool dyd_filter_death(dyd_death_d *out, double box[4], double *radius2, const dyd_points_d *p, const dyd_lines_d *l);

#endif
