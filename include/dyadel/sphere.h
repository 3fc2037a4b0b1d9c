/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points on a sphere, given by longitude and latitude in degrees (mathematics: section 13).
 *
 * Two points are neighbours iff some circle on the sphere passes through both and has no point inside: so are the
 * edges of the convex hull in space. All is projected stereographically from one of the points, the centre; then the
 * statuses of the other pairs are those of their images in the plane, and the neighbours of the centre are the images
 * on the convex hull [SPH-1]. The earth is taken for a sphere, not for an ellipsoid.
 *
 * Longitudes count modulo 360, a pole has any longitude, exact points at the same place are one. Ties among points
 * whose degrees are rational numbers are all proved [SPH-3]. */
#ifndef DYADEL_SPHERE_H
#define DYADEL_SPHERE_H

#include <dyadel/converge.h>
#include <dyadel/engine.h>
#include <dyadel/survey.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The mean radius of the earth (IUGG) in metres: the scale of metres on the ground. */
#define DYD_EARTH_RADIUS "6371008.8"

typedef struct dyd_sphere dyd_sphere;

typedef struct dyd_sphere_options {
  size_t struct_size; /* set by DYD_SIZED */
  /* How far points may be from their places: an exact number with a unit behind it. "0.01deg", arcmin, arcsec:
   * longitude and latitude may each be off by so much. "30m", km, cm, mm, ft, in: points lie within this distance on
   * the ground (DYD_EARTH_RADIUS). NULL: none. Borrowed for the call. */
  const char *radius;
  bool centre_set; /* project from point `centre`; else one is chosen, or a place between points */
  uint32_t centre;
  const char *radius_unit, *radius_scale; /* as in dyd_read_options; of `radius` */
  bool no_images; /* nothing is projected: only for dyd_sphere_nearest, and statements about places */
} dyd_sphere_options;

/* The sphere with the points of `places`, an engine to which longitudes (x) and latitudes (y) were added, and which is
 * never run; borrowed until dyd_sphere_free, and not to be changed. options may be NULL. Streams are narrowed to 32
 * bits. Where each point may coincide with another one, or radii are wide, so that a point would widen all images,
 * the centre of projection is a place between points, if there is one: then pairs around it may stay undecided [SPH-5].
 * A point whose row has a radius in metres (DYD_ROW_RADIUS of io.h) lies within it, in addition to options. DYD_E_ARG:
 * a radius in the options that is not understood, has no unit, or is larger than that of the earth. DYD_E_DOMAIN, with
 * the point where it is one: a latitude beyond 90 degrees, points that leave no place of the sphere free. O(N log N).
 */
DYD_API dyd_status dyd_sphere_new(dyd_sphere **out, dyd_engine *places, const dyd_sphere_options *options,
                                  dyd_error *err);
DYD_API void dyd_sphere_free(dyd_sphere *s);
/* The engine of the images: to be run, cancelled and asked for counters. Its points are called by the rows of the
 * places; its statuses are those of images alone. Owned by s. */
DYD_API dyd_engine *dyd_sphere_images(const dyd_sphere *s);
/* The engine that it was made of. */
DYD_API const dyd_engine *dyd_sphere_places(const dyd_sphere *s);
/* As dyd_engine_run of the images; start_bits 0: 40, which doubles hold; cost: of places. Decided means that all pairs
 * are. Places are asked again what images were recalled (dyd_engine_recall) for. The point of an error is a place, also
 * where the one projected from fails. */
DYD_API dyd_status dyd_sphere_run(dyd_outcome *outcome, dyd_sphere *s, const dyd_engine_options *options,
                                  dyd_error *err);

/* The same, stage by stage (dyd_converge_run): rows count pairs of places as the first eye sees them, widths are those
 * of images, and rows have no bounds. */
DYD_API dyd_status dyd_sphere_converge(dyd_convergence *out, dyd_sphere *s, const dyd_engine_options *options,
                                       dyd_error *err);

/* The outcome of the last run: as that of the images, but fixpoint where these are decided and, as no point is
 * projected from, pairs stay undecided all the same. */
DYD_API dyd_outcome dyd_sphere_outcome(const dyd_sphere *s);

/* The point projected from, and the one of which image k is; DYD_NO_PLACE where there is none. */
#define DYD_NO_PLACE UINT32_MAX
DYD_API uint32_t dyd_sphere_centre(const dyd_sphere *s);
DYD_API uint32_t dyd_sphere_place(const dyd_sphere *s, uint32_t k);
/* The lowest point at the same place; i itself unless i is an alias. */
DYD_API uint32_t dyd_sphere_alias(const dyd_sphere *s, uint32_t i);
/* Where point i is known to be: longitude x, latitude y in degrees, the radius included (for "m": the box about the
 * circle, rounded outward). DYD_E_ARG where there is no point i. */
DYD_API dyd_status dyd_sphere_rect(dyd_rect *out, const dyd_sphere *s, uint32_t i);

/* The same as vectors of length 1: a box (x, y, z, each lower and upper) that holds point i. x: longitude and latitude
 * 0; z: the north pole. DYD_E_ARG where there is no point i. */
DYD_API dyd_status dyd_sphere_vector(double box[6], const dyd_sphere *s, uint32_t i, dyd_error *err);

/* The results, by the numbers of the points. DYD_E_ARG before the first run. Pairs as dyd_delaunay_pairs; where images
 * are not points, there may be more indeterminate pairs than necessary, as each image must hold for the whole centre.
 * Triangles as dyd_delaunay_triangles, counter-clockwise from outside; of three points both sides. */
DYD_API dyd_status dyd_sphere_pairs(dyd_pair_list *out, const dyd_sphere *s);
DYD_API dyd_status dyd_sphere_triangles(dyd_triangle_list *out, const dyd_sphere *s);
/* The number of undecided faces; and the sites of face f, ascending. *tie: all its pairs are ties, so that its
 * Voronoi region is one point. */
DYD_API size_t dyd_sphere_faces(const dyd_sphere *s);
DYD_API dyd_status dyd_sphere_face(dyd_index_list *out, bool *tie, const dyd_sphere *s, size_t f);
/* Calls visit with each empty circle (DYD_GROUP_CIRCLE) that holds more than three points, counter-clockwise from
 * outside, and no others: they have one Voronoi vertex. A circle that holds all points is empty on both sides, and
 * visited twice. As dyd_delaunay_each_group; DYD_E_ARG before the first run. */
DYD_API dyd_status dyd_sphere_each_circle(const dyd_sphere *s, dyd_group_fn visit, void *user);
/* A box of degrees (longitude lower, upper, latitude lower, upper) that holds the Voronoi vertex of t, one of
 * dyd_sphere_triangles or any three points of one of dyd_sphere_each_circle in its order, for every choice of its
 * corners. Longitudes may reach beyond 180; near a pole they may be all.
 * [SPH-4] */
DYD_API dyd_status dyd_sphere_vertex(double box[4], const dyd_sphere *s, const dyd_triangle *t, dyd_error *err);

/* Which points are possibly nearest to the place `at` (longitude x, latitude y), measured along the sphere; as
 * dyd_engine_nearest, but for the engine of places, which is asked itself, and needs no run. *tied: all listed, two at
 * least, are exact and proved to be equally far; then the outcome is fixpoint. Where `at` is a region, points not
 * listed are nearest to no place of it [SPH-6]. DYD_E_DOMAIN where its latitude is beyond 90 degrees. The first call
 * sorts the points, O(N log N); others take O(sqrt N) for points all over the sphere. */
DYD_API dyd_status dyd_sphere_nearest(dyd_index_list *out, bool *sure, bool *tied, dyd_outcome *outcome, dyd_sphere *s,
                                      dyd_stream *at, const dyd_engine_options *options, dyd_error *err);
/* Bounds, in metres on the ground (DYD_EARTH_RADIUS), of the distance between point i and a place of the rectangle of
 * degrees `at`, rounded outward. DYD_E_ARG where there is no point i. */
DYD_API dyd_status dyd_sphere_distance(double *lo, double *hi, const dyd_sphere *s, uint32_t i, const dyd_rect *at);

/* Which points to measure next, after dyd_sphere_run, as dyd_survey_new: a point of a row has to be within `needed`
 * metres, on the ground, of the middle of its region; `now` is how far it may be from there. accuracy: NULL, or the
 * best possible accuracy of a measurement, a length with its unit ("5m"); of the options pairs, site, cost and cancel
 * count. Planned from one gap, and from another one for pairs around that; each row decides the pairs that the images
 * show to be decided by it and those before, and `left` are the pairs that a run on the sphere with these accuracies
 * leaves undecided [SPH-7]. DYD_E_ARG for an invalid accuracy. */
DYD_API dyd_status dyd_sphere_survey(dyd_survey **out, dyd_sphere *s, const char *accuracy,
                                     const dyd_survey_options *options, dyd_error *err);
/* dyd_survey_simulate of the plans of dyd_sphere_survey: true places are drawn in the regions, and the ball of `needed`
 * metres around one replaces its region. Cancelled between plans. */
DYD_API dyd_status dyd_sphere_simulate(dyd_survey_trial *out, dyd_sphere *s, size_t count, uint64_t seed,
                                       const char *accuracy, const dyd_survey_options *options, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
