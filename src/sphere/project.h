/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Stereographic projection from a place on the sphere, in balls. */
#ifndef DYD_SPHERE_PROJECT_H
#define DYD_SPHERE_PROJECT_H

#include <arb.h>
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

/* The place that is projected from, with what many images have in common at one precision. Init, then set spot, and
 * prec to 0 when it changes. */
typedef struct dyd_eye {
  dyd_spot spot;
  slong prec;                          /* of what follows, 0: not known */
  arb_struct unit, lon, lat, sin, cos; /* pi / 360; degrees; of the latitude */
} dyd_eye;
enum { DYD_EYE_BALLS = 5 };

void dyd_eye_init(dyd_eye *e);
void dyd_eye_clear(dyd_eye *e);

/* Encloses the images of all places within an angle (radians) of a place of s, seen from any place of the eye [SPH-2]:
 * x, y. prec: bits of the computation. Where something of s is also in the eye, or so near that thousands of pieces do
 * not tell them apart, false. */
bool dyd_project(arb_ptr x, arb_ptr y, const dyd_spot *s, mpq_srcptr angle, dyd_eye *e, slong prec);

#endif
