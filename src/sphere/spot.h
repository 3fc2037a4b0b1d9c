/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where a point on the sphere may be: a box of degrees. */
#ifndef DYD_SPHERE_SPOT_H
#define DYD_SPHERE_SPOT_H

#include <dyadel/rect.h>

/* Longitude and latitude in degrees, each within half[] of mid[]. */
typedef struct dyd_spot {
  mpq_t mid[2], half[2];
} dyd_spot;

void dyd_spot_init(dyd_spot *s);
void dyd_spot_clear(dyd_spot *s);
/* The rectangle r of degrees, widened by `more` on each side; longitudes are taken modulo 360. Where its latitudes
 * reach beyond a pole, or are the pole, all longitudes stand for each other: beyond, the spot is all of the cap; a pole
 * itself has longitude 0. false: no latitude of r is within 90. */
bool dyd_spot_set(dyd_spot *s, const dyd_rect *r, mpq_srcptr more);
bool dyd_spot_is_exact(const dyd_spot *s);
/* Widens s to hold all places within an angle (radians) of it. */
void dyd_spot_widen(dyd_spot *s, mpq_srcptr angle);

#endif
