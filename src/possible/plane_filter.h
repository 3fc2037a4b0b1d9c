/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How far rectangles are from a corner of a part of the plane, as a number to compare at that corner: the squared
 * distance [FLT-DST], or minus the height for a corner at infinity [FLT-DIR]. */
#ifndef DYD_POSSIBLE_PLANE_FILTER_H
#define DYD_POSSIBLE_PLANE_FILTER_H

#include "skeleton/distance_filter.h"

#include <math.h>
#include <stdbool.h>

/* A point, or a direction. */
typedef struct dyd_plane_corner {
  double x, y;
  bool far;
} dyd_plane_corner;

static inline double dyd_height_error(double px, double py) {
  return 8 * 0x1p-53 * (fabs(px) + fabs(py)) + DYD_TINY;
}

/* Lower bound of -u.x over a box that reaches `slack` farther. */
static inline double dyd_depth_lower(double ux, double uy, double x, double y, double slack) {
  double px = ux * x, py = uy * y, s = (fabs(ux) + fabs(uy)) * slack;
  return -(px + py + s) - dyd_height_error(px, py) - 4 * 0x1p-53 * s;
}
static inline double dyd_depth_upper(double ux, double uy, double x, double y, double slack) {
  return -dyd_depth_lower(-ux, -uy, x, y, slack);
}

/* Upper bound of the farthest of a rectangle. */
static inline double dyd_farthest_upper(const dyd_plane_corner *v, const dyd_bbox *b) {
  dyd_bbox c = {{v->x, v->x, v->y, v->y}};
  if (!v->far) return dyd_dl2_upper(&c, b);
  return dyd_depth_upper(v->x, v->y, v->x > 0 ? b->e[0] : b->e[1], v->y > 0 ? b->e[2] : b->e[3], 0);
}
/* Lower bound of the closest. */
static inline double dyd_closest_lower(const dyd_plane_corner *v, const dyd_bbox *b) {
  dyd_bbox c = {{v->x, v->x, v->y, v->y}};
  if (!v->far) return dyd_ds2_lower(&c, b);
  return dyd_depth_lower(v->x, v->y, v->x > 0 ? b->e[1] : b->e[0], v->y > 0 ? b->e[3] : b->e[2], 0);
}
/* The bounds from the other side; slack: by how much the box may be wider than the rectangle. */
static inline double dyd_farthest_lower(const dyd_plane_corner *v, const dyd_bbox *b, double slack) {
  dyd_bbox c = {{v->x, v->x, v->y, v->y}};
  if (!v->far) return dyd_dl2_lower(&c, b, slack);
  return dyd_depth_lower(v->x, v->y, v->x > 0 ? b->e[0] : b->e[1], v->y > 0 ? b->e[2] : b->e[3], slack);
}
static inline double dyd_closest_upper(const dyd_plane_corner *v, const dyd_bbox *b, double slack) {
  dyd_bbox c = {{v->x, v->x, v->y, v->y}};
  if (!v->far) return dyd_ds2_upper(&c, b, slack);
  return dyd_depth_upper(v->x, v->y, v->x > 0 ? b->e[1] : b->e[0], v->y > 0 ? b->e[3] : b->e[2], slack);
}

#endif
