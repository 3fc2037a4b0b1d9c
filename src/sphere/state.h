/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a sphere holds, for the files of this folder:
 *
 *   sphere.c         life; statuses and triangles, by the numbers of the places
 *   places.c         where the places are, and which are the same
 *   units.c          radii as text
 *   choose_filter.c  from which place is projected
 *   project.c        images of places; nearest_filter.c: in doubles
 *   ties.c           which places are on one circle
 *   vertex.c         Voronoi vertices
 *   survey.c           what to measure next
 *   nearest.c        nearest places; nearest_filter.c: in doubles */
#ifndef DYD_SPHERE_STATE_H
#define DYD_SPHERE_STATE_H

#include "engine/state.h"
#include "predicate/interval_filter.h"
#include "stream/arb.h"

#include <dyadel/sphere.h>

#include <math.h>

DYD_OWNERS(dyd_sphere)

/* ---- places.c: regions ---- */

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

/* Encloses s in doubles. */
void dyd_spot_get_d(dyd_spot_d *out, const dyd_spot *s);
void dyd_spot_init(dyd_spot *s);
void dyd_spot_clear(dyd_spot *s);
DYD_ARRAYS(dyd_spot)
/* Sets s to the rectangle r of degrees, widened by `more` on each side, with no angle; longitudes are taken modulo 360.
 * Where its latitudes reach beyond a pole, or are the pole, all longitudes are equivalent: beyond, the spot is
 * all of the cap; a pole itself has longitude 0. Returns false if no latitude of r is within 90. */
bool dyd_spot_set(dyd_spot *s, const dyd_rect *r, mpq_srcptr more);
bool dyd_spot_is_exact(const dyd_spot *s);
/* s becomes one place of it: the middle (0), or a corner of its box. */
void dyd_spot_choose(dyd_spot *s, unsigned place);
/* Widens the box of s to hold all of s; the angle becomes 0. */
void dyd_spot_box(dyd_spot *s);
/* Returns true if the region may be exact: a double, or between two next to each other. */
static inline bool dyd_spot_d_is_tight(const dyd_spot_d *p) {
  return p->angle == 0 && nextafter(p->box[0], 720) >= p->box[1] && nextafter(p->box[2], 720) >= p->box[3];
}

/* ---- project.c: images ---- */

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
 * separate them. */
bool dyd_project(arb_ptr x, arb_ptr y, const dyd_spot *s, dyd_eye *e, slong prec);

/* The ends of a ball, rounded outward. */
dyd_iv dyd_ball_ends(arb_srcptr x);
/* The eye enclosed in doubles, where it is an exact place: degrees; sine and cosine of the latitude. */
typedef struct dyd_eye_d {
  dyd_iv lon, lat, sin, cos;
} dyd_eye_d;
void dyd_eye_enclose(dyd_eye_d *out, dyd_eye *e);

/* nearest_filter.c: box: x lower and upper, y lower and upper end of the image, for all of a narrow region and all that
 * the eye encloses [FLT-SPH]; at most about 2^-(bits + 1) (1 + x^2 + y^2) wide, so 2^-bits radians on the sphere.
 * Returns false where that is not known, as for a region with an angle. */
bool dyd_filter_image(double box[4], const dyd_spot_d *place, const dyd_eye_d *eye, int64_t bits);

/* ---- the sphere ---- */

typedef struct dyd_near_index dyd_near_index;

/* Invariant: of[] ascends: the places that have an image, which are all but the centre and aliases. alias[i] <= i is
 * the lowest place at the same point as i. stream is NULL, or has an entry for each place, NULL where it is fixed. */
struct dyd_sphere {
  dyd_engine *places;
  dyd_engine *images;
  uint32_t centre; /* the place projected from; meaningless when there are no places */
  bool free;       /* no place is, but eye.spot, an exact one: all places have images; centre is DYD_NO_PLACE */
  size_t count;    /* of places */
  uint32_t *of, *alias;
  size_t with_image;
  dyd_stream **stream;
  mpq_t metre;          /* radians to a metre */
  mpq_t angle, degrees; /* the radius in the options: radians, or degrees of longitude and latitude */
  dyd_eye eye;          /* the centre, as it was asked last */
  bool centre_failed;   /* at the last try of an image: its stream, or its latitude */
  int64_t eye_bits;
  dyd_eye_d eye_d; /* the same in doubles, where first looks are in doubles */
  /* The same places, projected from another gap; made where there are regions, or a gap, and pairs stay indeterminate.
   * NULL: none. */
  dyd_sphere *second;
  bool gap_decided;     /* all pairs around a centre that is no place are known to be legal, or illegal */
  const double *within; /* of a plan: distances in metres of places from the middles of their regions; below 0: as they
                           are; NULL: all are */
  dyd_near_index *near; /* for dyd_sphere_near; NULL: not made yet */
};

static inline bool dyd_sphere_is_fixed(const dyd_sphere *s, uint32_t i) {
  return !s->stream || !s->stream[i];
}

/* places.c: the region of place i, as it is known now, with all that widens it: rectangle, stream, the radius of its
 * row and those in the options. Nothing else reads these. DYD_E_DOMAIN where its latitude is beyond a pole, or its
 * angle above 1; DYD_E_NOMEM. */
dyd_status dyd_sphere_spot(dyd_spot *out, const dyd_sphere *s, uint32_t i, dyd_error *err);
/* Encloses the same in doubles; quick for exact places. */
dyd_status dyd_sphere_spot_d(dyd_spot_d *out, const dyd_sphere *s, uint32_t i, dyd_error *err);
/* The input of place i, as narrow as known now: without radii. */
dyd_status dyd_sphere_stated(dyd_rect *out, const dyd_sphere *s, uint32_t i);
/* Makes a computable place exact where the normal forms of its coordinates are rational numbers, or its latitude is
 * that of a pole. */
dyd_status dyd_sphere_recognise(dyd_sphere *s, uint32_t i, dyd_error *err);
/* Fills in alias; examines all places, DYD_E_DOMAIN as above. */
dyd_status dyd_sphere_find_aliases(dyd_sphere *s, dyd_error *err);

/* choose_filter.c: the place to project from, which is not an alias; where each may coincide with another one, a place
 * that none of them reaches. DYD_E_ARG with a message where none exists. */
dyd_status dyd_sphere_choose(dyd_sphere *s, dyd_error *err);
/* Sets the centre to a place in a gap, `free`, far from that of the other where it is one; leaves s as it is if there
 * is none. */
dyd_status dyd_sphere_choose_gap(dyd_sphere *s, const dyd_sphere *other, dyd_error *err);

/* project.c: adds the images to s->images. */
dyd_status dyd_sphere_add_images(dyd_sphere *s, dyd_error *err);
/* Returns st; where images failed, err names the place concerned, no more the image. */
dyd_status dyd_sphere_blame(const dyd_sphere *s, dyd_status st, dyd_error *err);
/* Narrows places and centre as if images that a trace gave had been asked for, so that statements about images hold for
 * all choices in the rectangles of their places. */
dyd_status dyd_sphere_narrow_recalled(dyd_sphere *s, int64_t max_bits, dyd_error *err);

/* ---- ties.c ---- */

__extension__ typedef __int128 dyd_turns;

/* Orders below this are taken: products with small primes stay in 128 bits. */
#define DYD_CYCLIC_MOST ((dyd_turns)1 << 110)

/* c times the root of unity e / n of a turn; n is that of the sum. */
typedef struct dyd_root_term {
  dyd_turns e;
  int64_t c;
} dyd_root_term;

/* *zero: sum c exp(2 pi i e / n) over the terms is 0. Decided exactly for all 0 < n < DYD_CYCLIC_MOST, |e| < n and
 * |c| < 2^31, count < 2^31 [SPH-3]; the terms are destroyed. DYD_OK or DYD_E_NOMEM. */
dyd_status dyd_cyclic_is_zero(bool *zero, dyd_root_term *term, size_t count, dyd_turns n);
/* Proves that images are of exact places on one circle, with the centre if `centre` is set. */
dyd_status dyd_sphere_on_circle(bool *proved, const dyd_sphere *s, bool centre, const uint32_t *site, size_t count,
                                dyd_error *err);
/* Members of a dyd_prover; user is a dyd_sphere, sites are images. Where the centre has a region, the middle of it is
 * projected from. */
dyd_status dyd_sphere_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                            dyd_error *err);
dyd_status dyd_sphere_prove_places(bool *proved, void *user, dyd_relation relation, const dyd_site_place *at,
                                   size_t count);
dyd_status dyd_sphere_place_at(dyd_rect *out, void *user, const dyd_site_place *at); /* project.c */

/* Proves that the exact places spot[0 .. count - 1] are equally far from the exact place `at`. DYD_OK or DYD_E_NOMEM.
 */
dyd_status dyd_spots_equidistant(bool *proved, const dyd_spot *at, const dyd_spot *spot, size_t count);

/* nearest.c: sets out to the largest angle between the middle of the spot and a place of it, in radians. */
void dyd_spot_reach(arb_t out, const dyd_spot *spot, slong prec);

/* nearest.c: makes metres of the radians x. */
void dyd_sphere_metres(arb_t x, const dyd_sphere *s, slong prec);

/* ---- nearest_filter.c ---- */

/* Sets out to places, no aliases, ascending, among them all that are possibly nearest to some point of `at` [SPH-6]. */
dyd_status dyd_sphere_near(dyd_index_list *out, dyd_sphere *s, const dyd_spot_d *at, dyd_error *err);
void dyd_near_index_free(dyd_near_index *index);

/* ---- sphere.c ---- */

/* A sphere of the same places and radii, without images yet, projected from a gap: far from that of `other` where it
 * is one. *out is NULL if none is found. */
dyd_status dyd_sphere_new_gap(dyd_sphere **out, const dyd_sphere *other, dyd_error *err);
/* The same places, within the distances `within` (above) of the middles of their regions, projected from the place
 * that suits them; `within` is borrowed. */
dyd_status dyd_sphere_new_within(dyd_sphere **out, const dyd_sphere *s, const double *within, dyd_error *err);

/* Sets out to the radius in the options: metres on the ground, or degrees. DYD_E_ARG where it is none; DYD_E_NOMEM. */
dyd_status dyd_sphere_radius(mpq_ptr out, bool *ground, const dyd_sphere_options *o, dyd_error *err);
/* As dyd_sphere_outcome, of the statements that a certificate proves: from the first eye, and from a gap if that is not
 * one. */
dyd_outcome dyd_sphere_proved_outcome(const dyd_sphere *s);
/* The status of each image with the centre; in a gap, with a point there. */
dyd_status dyd_sphere_about_centre(dyd_pair_status *status, const dyd_sphere *s);

#endif
