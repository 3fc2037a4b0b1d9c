/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Images in doubles, seen from an exact place. */
#ifndef DYD_SPHERE_IMAGE_FILTER_H
#define DYD_SPHERE_IMAGE_FILTER_H

#include "predicate/interval_filter.h"
#include "sphere/spot.h"

#include <stdint.h>

/* The place that is projected from, enclosed: degrees; sine and cosine of the latitude. */
typedef struct dyd_eye_d {
  dyd_iv lon, lat, sin, cos;
} dyd_eye_d;

/* box: x lower and upper, y lower and upper end of the image, for all of a narrow region and all that the eye
 * encloses [FLT-SPH]; at most about 2^-(bits + 1) (1 + x^2 + y^2) wide, so 2^-bits radians on the sphere.
 * Returns false where that is not known, as for a region with an angle. */
bool dyd_filter_image(double box[4], const dyd_spot_d *place, const dyd_eye_d *eye, int64_t bits);

#endif
