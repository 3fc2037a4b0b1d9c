/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Does a rectangle hold the image of a place? [CERT-14] */
#ifndef DYD_CHECKER_IMAGE_H
#define DYD_CHECKER_IMAGE_H

#include "checker/region.h"

/* Longitude from the eye, latitude, latitude of the eye. */
enum { DYD_CERT_ANGLES = 3 };

/* Lower end, middle and upper end of an angle. */
enum { DYD_CERT_LOW, DYD_CERT_MIDDLE, DYD_CERT_UPPER, DYD_CERT_ENDS };

/* An angle over a part of a region: within half of mid, in degrees; reach: half in radians, a number 2^-p rounded up.
 * at[] is known where `known` says so; over: of all angles of the part. */
typedef struct dyd_cert_angle_span {
  mpq_t mid, half;
  mpz_t reach;
  dyd_cert_trig at[DYD_CERT_ENDS], over;
  bool known[DYD_CERT_ENDS];
  long p; /* 0: nothing is known */
} dyd_cert_angle_span;

/* The eye, a box, and what many images have in common. */
typedef struct dyd_cert_lens {
  dyd_cert_region eye;
  long p; /* of pi; 0: not known */
  dyd_cert_enclosure pi;
  dyd_cert_angle_span span[DYD_CERT_ANGLES];
  dyd_cert_trig cap;             /* of the angle of the place */
  dyd_cert_enclosure side[2][2]; /* of the rectangle: of x, of y, lower and upper */
  size_t pieces;                 /* how many more pieces may be looked at */
} dyd_cert_lens;

void dyd_cert_lens_init(dyd_cert_lens *g);
void dyd_cert_lens_clear(dyd_cert_lens *g);

/* NO: an image is outside, seen from some place of the box of the eye; OPEN: not known. */
typedef enum dyd_cert_holds { DYD_CERT_YES, DYD_CERT_NO, DYD_CERT_OPEN } dyd_cert_holds;
/* Does the rectangle hold the images of all of the region, seen from every place of the eye? */
dyd_cert_holds dyd_cert_image_in(dyd_cert_lens *g, const dyd_cert_region *place, const dyd_cert_side rect[2]);

#endif
