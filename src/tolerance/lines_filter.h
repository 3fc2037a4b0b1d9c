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

/* Loops over lines run to a multiple of a block, since few branches depend on that. */
enum { DYD_LINES_BLOCK = 4, DYD_LINES_D = 48 };
/* Of one pair: J, and P = p_k - p_i of the vertices added, none of which is i or j; up to the next multiple of a block
 * follows nobody: NaN. apex: next to the pair, one on each side, or DYD_NONE the second; both are among them. */
typedef struct dyd_lines_d {
  double jx, jy, jj, ejj, rjj; /* rjj: ejj / jj */
  uint32_t i, j, count, apex[2];
  double px[DYD_LINES_D + DYD_LINES_BLOCK], py[DYD_LINES_D + DYD_LINES_BLOCK];
  uint32_t vertex[DYD_LINES_D + DYD_LINES_BLOCK];
} dyd_lines_d;

/* One of them, with Q = p_k - p_j: em, en, ea bound the errors of m, n and along = P.J. */
typedef struct dyd_line_d {
  double px, py, qx, qy, m, n, along, em, en, ea;
  uint32_t vertex;
} dyd_line_d;

/* What binds: two vertices, or one twice; lo and hi bound the death, hi <= (1 + 2^-40) lo. */
typedef struct dyd_death_d {
  double lo, hi;
  uint32_t k, l;
  double s; /* the place, see lines.h; end: -1 or 1 for an end of the bisector */
  int end;
} dyd_death_d;

/* Begins with no vertex. false: doubles cannot hold the pair well. */
bool dyd_filter_pair(dyd_lines_d *l, const dyd_points_d *p, uint32_t i, uint32_t j);
/* Adds `count` vertices of a cyclic list of `size`, from number `first` on, which is below 2 size; false: there is no
 * room. Those whose coordinates are NaN are nobody. */
bool dyd_filter_add(dyd_lines_d *l, const dyd_points_d *p, const uint32_t *ring, uint32_t size, uint32_t first,
                    uint32_t count);
void dyd_filter_line(dyd_line_d *o, const dyd_lines_d *l, const dyd_points_d *p, uint32_t vertex);
/* The death of a strictly Delaunay pair with these others; false: not sure. `box` (may be NULL) gets a box around the
 * centre, *radius2 an upper bound of its squared distance to the sites that bind; infinite for a half-plane. */
bool dyd_filter_death(dyd_death_d *out, double box[4], double *radius2, const dyd_points_d *p, const dyd_lines_d *l);

#endif
