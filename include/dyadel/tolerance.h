/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How far points may move before the Delaunay triangulation changes (mathematics: section 12).
 *
 * All points move at once, each within a disc of radius t about its nominal place, or t times its weight. A Delaunay
 * edge dies at the t from which some choice of points may lose it; a pair that is no edge is born at the t from which
 * some choice makes it one. So each pair has one number, and the statuses for discs of radius t are read off it.
 * Measured in the max norm, each point moves in a square of half-width t instead. */
#ifndef DYADEL_TOLERANCE_H
#define DYADEL_TOLERANCE_H

#include <dyadel/delaunay.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DYD_NO_SITE UINT32_MAX

typedef enum dyd_tolerance_event {
  DYD_EVENT_DEATH = 0, /* an edge: legal for every t below */
  DYD_EVENT_BIRTH,     /* no edge: illegal for every t below */
  DYD_EVENT_TIE        /* an edge only weakly: lost and found by the least motion; lo = hi = 0 */
} dyd_tolerance_event;
/* "death", "birth", "tie". Static storage. */
DYD_API const char *dyd_tolerance_event_text(dyd_tolerance_event event);

/* The event of i, j (i < j) is at a t in [lo, hi], hi <= (1 + 2^-40) lo within the range of doubles; both are infinite
 * where nothing ever happens. k < l: the sites that bind: the largest empty annulus about the pair has them on its
 * outer circle (birth: on its inner one). l = DYD_NO_SITE: k alone binds, k too: none does, or a tie. Where more
 * sites bind, two of them. */
typedef struct dyd_tolerance_row {
  uint32_t i, j;
  dyd_tolerance_event event;
  uint32_t k, l;
  double lo, hi;
} dyd_tolerance_row;

/* How far a point moves: by the Euclidean distance, in a disc; or by the larger of x and y, in a square. */
typedef enum dyd_metric { DYD_METRIC_EUCLID = 0, DYD_METRIC_BOX } dyd_metric;
typedef struct dyd_tolerance_options {
  size_t struct_size;         /* set by DYD_SIZED */
  mpq_srcptr up_to;           /* births up to here are found, too; NULL: none. Borrowed for the call */
  bool points;                /* also how far each point may be from its place */
  size_t max_pairs;           /* cap on pairs examined for births; 0: default, see dyd_delaunay_options */
  const volatile int *cancel; /* as in dyd_delaunay_options */
  bool no_filter;             /* decide everything on the exact rung (for tests) */
  double sigma;               /* also probabilities, for normal errors of this standard deviation; 0: none */
  /* Of each site, >= 0: it moves by at most t times its weight, 0: not at all; of aliases the largest counts. Results
   * hold for these numbers and for all that they are next to as doubles. NULL: 1 each. Borrowed for the call. */
  const double *weight;
  const double
      *sigmas; /* of each site, above 0: standard deviations instead of sigma; NULL: sigma. Borrowed as above */
  /* DYD_METRIC_BOX [TOL-9]: [lo,hi] holds the half-width of all squares from which on an edge is not legal, or another
   * pair possible; hi <= (1 + 2^-20) lo, but where the search for witnesses gives no answer; k and l are about nearest
   * to the disc that shows the edge at lo (the birth at hi), one on each side of it; there is no exact form. Radii are
   * half-widths of squares, too; probabilities are the same. No weights. */
  dyd_metric metric;
} dyd_tolerance_options;

typedef struct dyd_tolerance dyd_tolerance;

/* The tolerances of the exact points of pd, which is borrowed until dyd_tolerance_free and must not change. options may
 * be NULL. Returns DYD_OK; DYD_E_ARG with a message when a site is no exact point, or for a negative up_to; DYD_CAPPED
 * when there are too many pairs for births; DYD_E_NOMEM: *out is NULL then. DYD_CANCELLED: *out holds the rows that
 * were reached, see dyd_tolerance_result, and err says how many were not.
 * With weights, or in the max norm, a death takes about ten microseconds [TOL-11]; edges that only the end of their
 * bisector binds, as many of the hull, and births, take half a millisecond or more. With weights [TOL-8] hi - lo may be
 * more where doubles do not place a circle: where one disc grows to be all but in another one.
 * Cost: O(N log N) for deaths [TOL-4]; births take the partial triangulation of squares of half-width up_to, and a few
 * searches for each of its pairs; points a search for each edge, which takes several times as long as the deaths. Both
 * are shared among as many threads as the options of pd name; results do not depend on it. */
DYD_API dyd_status dyd_tolerance_new(dyd_tolerance **out, const dyd_delaunay *pd, const dyd_tolerance_options *options,
                                     dyd_error *err);
DYD_API void dyd_tolerance_free(dyd_tolerance *t);

/* All rows: every possible pair of pd, and the births; sorted by i, then j. Borrowed until t is freed. */
DYD_API size_t dyd_tolerance_rows(const dyd_tolerance_row **row, const dyd_tolerance *t);
/* Results apart from the rows. */
typedef struct dyd_tolerance_result {
  size_t struct_size; /* set by the library */
  dyd_metric metric;
  /* The t in [lo, hi] up to which nothing changes at all: no edge is lost, no pair becomes one. 0 where there are ties;
   * infinite for fewer than three points [TOL-5]. Where edges have no row, lo is 0. */
  double lo, hi;
  /* For each site a radius, rounded down: if every point is within its radius of its place, legal edges are edges, and
   * others are none, as at the nominal places [TOL-6]. An alias is one point with its site: it has its
   * radius, and moves with it. NULL unless options.points was set, and where work was cancelled. */
  const double *points;
  /* For each row a lower bound of the probability that the pair is an edge, when every coordinate of every point has a
   * normal error of standard deviation options.sigma, or sigmas, all independent [TOL-7]. 0 for births and ties. NULL
   * unless options.sigma, or sigmas, was set. NaN where work was cancelled before. */
  const double *chances;
  /* After DYD_CANCELLED: edges that have no row, and pairs that may be born and have none; SIZE_MAX births: they were
   * not all looked for. Both 0: rows are complete. */
  size_t edges_left, births_left;
  uint64_t filter, exact; /* how many deaths doubles decided, and how many integers */
} dyd_tolerance_result;
/* Borrowed until t is freed, as its contents. */
DYD_API const dyd_tolerance_result *dyd_tolerance_get(const dyd_tolerance *t);
/* The exact event of row number `row`: |sqrt(plus) - sqrt(minus)| / 2; both are initialised by the caller. DYD_E_ARG
 * where lo is infinite, or there is no such row, or there are weights, or points are not exact: no such form is known
 * then. O(1) */
DYD_API dyd_status dyd_tolerance_exact(mpq_ptr plus, mpq_ptr minus, const dyd_tolerance *t, size_t row);
/* ---- discs ---- */

/* Statuses of the pairs when each point lies in a disc: the one in its square, the site of pd. Discs are in squares, so
 * only pairs that squares leave indeterminate can change: to legal (a disc holds both and meets no other), to illegal
 * (a disc that meets both always holds another one), or they stay. Sorted; *out is replaced. Sound for every choice in
 * the discs. Rectangles of dyd_sites_add_rect are taken as they are, but for 2^-60 of their width; others, or narrowed
 * ones, as squares rounded outward, so pairs that depend on 2^-48 of all sizes may stay indeterminate [DISC-1].
 * DYD_E_ARG for a site that is not a square (err names it); DYD_CAPPED when pd is: *out holds the pairs that pd lists.
 * A few searches for each such pair. When *cancel (may be NULL) becomes non-zero, DYD_CANCELLED: *out is valid, and
 * pairs that were not reached have their statuses in pd, which hold for discs, too. err says how many these are. */
DYD_API dyd_status dyd_disc_pairs(dyd_pair_list *out, const dyd_delaunay *pd, const volatile int *cancel,
                                  dyd_error *err);
/* Of sites that are possibly nearest to a point of `at` when they are rectangles (dyd_nearest_rect), *found keeps the
 * sites whose discs are possibly nearest [DISC-6]: for a point exactly these, for a rectangle perhaps more. *sure:
 * one site is left, which is nearest for every choice. Returns DYD_E_ARG for a site that is not a square (err names
 * it). O(found) */
DYD_API dyd_status dyd_disc_nearest(dyd_index_list *found, bool *sure, const dyd_sites *sites, const dyd_rect *at,
                                    dyd_error *err);
/* Bounds, rounded outward, of the distance from points of `at` to points of the disc of site i. */
DYD_API dyd_status dyd_disc_distance(double *lo, double *hi, const dyd_sites *sites, size_t i, const dyd_rect *at);
/* Triangles that are Delaunay for every choice in the discs: those of the centres with three pairs that are legal in
 * `pairs`, which dyd_disc_pairs listed for pd [DISC-3]. Sorted; *out is replaced. DYD_E_ARG for a site that is no
 * square. O(N log N) */
DYD_API dyd_status dyd_disc_triangles(dyd_triangle_list *out, const dyd_pair_list *pairs, const dyd_delaunay *pd);

#ifdef __cplusplus
}
#endif
#endif
