/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a sphere holds, for the files of this folder:
 *
 *   sphere.c         life: places and streams of an engine, the engine of images
 *   spot.c           where a point may be, in degrees
 *   places.c         where the places are, and which are the same
 *   units.c          radii as text
 *   choose_filter.c  from which place is projected
 *   source.c         images, as the engine of images asks for them
 *   project.c        enclosures of images; image_filter.c: in doubles
 *   ties.c           which places are on one circle
 *   cyclic.c         sums of roots of unity: are they 0?
 *   vertex.c         Voronoi vertices
 *   result.c         statuses and triangles, by the numbers of the places */
#ifndef DYD_SPHERE_STATE_H
#define DYD_SPHERE_STATE_H

#include "sphere/project.h"
#include <dyadel/sphere.h>

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
  int64_t eye_bits;
  dyd_eye_d eye_d; /* the same in doubles, where first looks are in doubles */
  /* The same places, projected from a gap; made where a wide centre leaves pairs indeterminate. NULL: none. */
  dyd_sphere *second;
};

/* places.c: the region of place i, as it is known now, with all that widens it: rectangle, stream, the radius of its
 * row and those in the options. Nothing else reads these. DYD_E_DOMAIN where its latitude is beyond a pole, or its
 * angle above 1; DYD_E_NOMEM. */
dyd_status dyd_sphere_spot(dyd_spot *out, const dyd_sphere *s, uint32_t i, dyd_error *err);
/* Encloses the same in doubles; quick for exact places. */
dyd_status dyd_sphere_spot_d(dyd_spot_d *out, const dyd_sphere *s, uint32_t i, dyd_error *err);
/* Sets out to the radius in the options: metres on the ground, or degrees. DYD_E_ARG where it is none; DYD_E_NOMEM. */
dyd_status dyd_sphere_radius(mpq_ptr out, bool *ground, const dyd_sphere_options *o, dyd_error *err);
/* What was given of place i, as it is known now: without radii. */
dyd_status dyd_sphere_stated(dyd_rect *out, const dyd_sphere *s, uint32_t i);
static inline bool dyd_sphere_is_fixed(const dyd_sphere *s, uint32_t i) {
  return !s->stream || !s->stream[i];
}

/* Fills in alias; looks at all places, DYD_E_DOMAIN as above. */
dyd_status dyd_sphere_find_aliases(dyd_sphere *s, dyd_error *err);

/* choose_filter.c: the place to project from, among those that are no aliases; where each may be the same as another
 * one, a place that none of them reaches. DYD_E_ARG with a message where there is none. */
dyd_status dyd_sphere_choose(dyd_sphere *s, dyd_error *err);
/* Sets the centre to a place in a gap, `free`; leaves s as it is if there is none. */
dyd_status dyd_sphere_choose_gap(dyd_sphere *s, dyd_error *err);
/* source.c: adds the images to s->images. */
dyd_status dyd_sphere_add_images(dyd_sphere *s, dyd_error *err);
/* source.c: narrows places and centre as if images that a trace gave had been asked for, so that what is said of images
 * holds for all choices in the rectangles of their places. */
dyd_status dyd_sphere_narrow_recalled(dyd_sphere *s, int64_t max_bits, dyd_error *err);
/* ties.c: proves that images are of exact places on one circle, with the centre if that is asked for. */
dyd_status dyd_sphere_on_circle(bool *proved, const dyd_sphere *s, bool centre, const uint32_t *site, size_t count,
                                dyd_error *err);
/* result.c: what each image is to the centre; in a gap, to a point there. */
dyd_status dyd_sphere_about_centre(dyd_pair_status *status, const dyd_sphere *s);
/* As dyd_prove_fn; user is a dyd_sphere, sites are images. */
dyd_status dyd_sphere_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                            dyd_error *err);

#endif
