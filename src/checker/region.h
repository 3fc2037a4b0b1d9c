/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where a place of the sphere may be, and cosines and sines of degrees. */
#ifndef DYD_CHECKER_REGION_H
#define DYD_CHECKER_REGION_H

#include "checker/enclosure.h"
#include "checker/sites.h"

/* All points within `angle` radians of a point whose longitude and latitude, in degrees, are within half[] of mid[]. */
typedef struct dyd_cert_region {
  mpq_t mid[2], half[2], angle;
} dyd_cert_region;

void dyd_cert_region_init(dyd_cert_region *r);
void dyd_cert_region_clear(dyd_cert_region *r);
/* Sets r to the longitudes and latitudes of the two sides, each off by up to `degrees`. Latitudes beyond a pole are cut
 * off, and then the longitude is any; a pole alone has longitude 0. Returns false if no latitude is within 90, or the
 * angle is above 1. */
bool dyd_cert_region_set(dyd_cert_region *r, const dyd_cert_side side[2], mpq_srcptr degrees, mpq_srcptr angle);
/* Widens the box of r to hold all of r; the angle becomes 0. */
void dyd_cert_region_box(dyd_cert_region *r);
bool dyd_cert_region_is_exact(const dyd_cert_region *r);
/* Are two exact regions the same point? Longitudes count modulo 360. */
bool dyd_cert_region_is_same(const dyd_cert_region *a, const dyd_cert_region *b);
/* out = num / den (NULL: 1). */
void dyd_cert_exact_to_q(mpq_ptr out, const dyd_exact *num, mpz_srcptr den);

/* A cosine and a sine. */
typedef struct dyd_cert_trig {
  dyd_cert_enclosure c, s;
} dyd_cert_trig;

void dyd_cert_trig_init(dyd_cert_trig *t);
void dyd_cert_trig_clear(dyd_cert_trig *t);
/* Of q degrees: multiples of 90 exactly. pi to precision p. */
void dyd_cert_trig_of_degrees(dyd_cert_trig *t, mpq_srcptr q, const dyd_cert_enclosure *pi, long p);
/* Of an angle of at most 1 radian: 0 exactly. */
void dyd_cert_trig_of_radians(dyd_cert_trig *t, mpq_srcptr angle, long p);
/* x = q degrees in radians. */
void dyd_cert_radians(dyd_cert_enclosure *x, mpq_srcptr q, const dyd_cert_enclosure *pi, long p);

#endif
