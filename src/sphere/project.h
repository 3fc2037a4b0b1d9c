/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Stereographic projection from a place on the sphere, in balls. */
#ifndef DYD_SPHERE_PROJECT_H
#define DYD_SPHERE_PROJECT_H

#include "sphere/image_filter.h"
#include "sphere/spot.h"
#include "stream/arb.h"

/* The place that is projected from, with what many images have in common at one precision. Init, then set spot, and
 * prec to 0 when it changes. */
typedef struct dyd_eye {
  dyd_spot spot;                       /* a box: its angle is 0 */
  slong prec;                          /* of what follows, 0: not known */
  arb_struct unit, lon, lat, sin, cos; /* pi / 360; degrees; of the latitude */
  const volatile int *stop;            /* NULL, or a flag that ends dyd_project early, with false */
} dyd_eye;
enum { DYD_EYE_BALLS = 5 };

void dyd_eye_init(dyd_eye *e);
void dyd_eye_clear(dyd_eye *e);

/* Encloses the images of all places of s, its angle included, seen from any place of the eye [SPH-2]: x, y. prec: bits
 * of the computation. Returns false where something of s is also in the eye, or so near that thousands of pieces do not
 * tell them apart. */
bool dyd_project(arb_ptr x, arb_ptr y, const dyd_spot *s, dyd_eye *e, slong prec);

/* The eye in doubles, where it is an exact place. */
void dyd_eye_enclose(dyd_eye_d *out, dyd_eye *e);

#endif
