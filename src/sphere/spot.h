/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where a point on the sphere may be. */
#ifndef DYD_SPHERE_SPOT_H
#define DYD_SPHERE_SPOT_H

#include <dyadel/rect.h>
#include <math.h>

/* The region of a place: all points within `angle` radians of a point of a box of degrees, longitude and latitude each
 * within half[] of mid[]. `stays`: it never becomes exact, whatever a stream is asked. */
typedef struct dyd_spot {
  mpq_t mid[2], half[2], angle;
  bool stays;
} dyd_spot;

/* The same in doubles, rounded outward: longitude lower, upper, latitude lower, upper. */
typedef struct dyd_spot_d {
  double box[4], angle;
} dyd_spot_d;

void dyd_spot_init(dyd_spot *s);
void dyd_spot_clear(dyd_spot *s);
/* Sets s to the rectangle r of degrees, widened by `more` on each side, with no angle; longitudes are taken modulo 360.
 * Where its latitudes reach beyond a pole, or are the pole, all longitudes stand for each other: beyond, the spot is
 * all of the cap; a pole itself has longitude 0. Returns false if no latitude of r is within 90. */
bool dyd_spot_set(dyd_spot *s, const dyd_rect *r, mpq_srcptr more);
bool dyd_spot_is_exact(const dyd_spot *s);
/* Widens the box of s to hold all of s; the angle becomes 0. */
void dyd_spot_box(dyd_spot *s);
/* Encloses s. */
void dyd_spot_get_d(dyd_spot_d *out, const dyd_spot *s);
/* Returns true if the region may be exact: a double, or between two next to each other. */
static inline bool dyd_spot_d_is_tight(const dyd_spot_d *p) {
  return p->angle == 0 && nextafter(p->box[0], 720) >= p->box[1] && nextafter(p->box[2], 720) >= p->box[3];
}

#endif
