/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A certificate being checked: what has been read so far. */
#ifndef DYD_CHECKER_CHECKER_H
#define DYD_CHECKER_CHECKER_H

#include "checker/bounds.h"
#include "checker/boxes.h"
#include "checker/caps.h"
#include "checker/chain.h"
#include "checker/distance.h"
#include "checker/faces.h"
#include "checker/globe.h"
#include "checker/read.h"
#include "checker/ties.h"
#include "checker/witness.h"
#include <dyadel/certificate.h>

typedef struct dyd_cert_corners {
  dyd_cert_corner *item;
  size_t count, cap;
} dyd_cert_corners;

typedef struct dyd_checker {
  dyd_cert_reader in;
  dyd_certificate_report report;
  dyd_cert_sites sites;
  dyd_cert_tree tree;
  dyd_cert_edges legal, bridges;
  dyd_cert_corners corners;
  dyd_cert_graph graph;
  dyd_cert_faces faces;
  dyd_cert_chain chain;
  dyd_cert_edges open;    /* pairs o, t, l: kept for the bounds */
  dyd_cert_edges tie;     /* pairs t */
  dyd_cert_edges bare;    /* pairs l */
  dyd_cert_edges chained; /* pairs n */
  dyd_cert_ties ties;
  dyd_cert_globe globe;
  /* The same places seen from a second eye: another certificate, which follows this one; owned. In that one: NULL. */
  struct dyd_checker *second;
  const struct dyd_checker *first; /* in that one: this one */
  dyd_exact point[2];
  bool reached;        /* a bound that is stated is as small as the goal asks */
  dyd_cert_disc *disc; /* of each site that is no alias; NULL: the points lie in no discs */
  uint32_t *near_open; /* sites that may be nearest to a place, where none certainly is */
  size_t near_count, near_cap;
  bool near_moves; /* one of these places is no exact point */
} dyd_checker;

void dyd_checker_init(dyd_checker *c, FILE *in, dyd_error *err);
void dyd_checker_clear(dyd_checker *c);
/* From the first line to the last; what is stated without a proof is settled after it. */
dyd_status dyd_checker_run(dyd_checker *c);
/* Fills in report.gaps. still[i]: point i, which is site i, or place i on a sphere, is known never to be narrowed;
 * NULL: the exact points. The gap of points is the caller's, and stays. */
dyd_status dyd_checker_settle(dyd_checker *c, const bool *still);
/* fixpoint.c, with `still` as above: can nothing that is narrowed change what the goal is about? Of the triangulation,
 * what a pair is; of a bound, anything. DYD_E_NOMEM. */
dyd_status dyd_checker_stays(bool *out, const dyd_checker *c, const bool *still);

/* The parts of a certificate, in order; each rejects what does not hold. */
dyd_status dyd_checker_head(dyd_checker *c);
dyd_status dyd_checker_sites(dyd_checker *c);
dyd_status dyd_checker_legal(dyd_checker *c);
dyd_status dyd_checker_places(dyd_checker *c);
dyd_status dyd_checker_bridges(dyd_checker *c);
dyd_status dyd_checker_corners(dyd_checker *c);
/* Up to the bounds. */
dyd_status dyd_checker_pairs(dyd_checker *c);
/* How many pairs within open sets are proved by nothing, with the boxes' help. */
dyd_status dyd_cert_boxes_unproved(uint64_t *out, const dyd_cert_sites *s, const dyd_cert_faces *f,
                                   const dyd_cert_known *known);
/* The section on the Voronoi diagram, whose first line has been read. */
dyd_status dyd_checker_diagram(dyd_checker *c);
/* The section on discs, or on a graph, whose first line has been read. */
dyd_status dyd_checker_discs(dyd_checker *c);
/* Its first lines, "discs C" or "discs C fixed", and the discs. */
dyd_status dyd_checker_read_discs(dyd_checker *c);
void dyd_checker_discs_clear(dyd_checker *c);
dyd_status dyd_checker_graph(dyd_checker *c);
/* The places of a certificate with the goal "nearest". */
dyd_status dyd_checker_places_near(dyd_checker *c);
/* sphere.c: memory for the second one, to be initialised; NULL when it is exhausted. */
dyd_checker *dyd_checker_room(void);
/* Leaves of the open pairs those that are open from the second eye, too. */
void dyd_checker_join(dyd_checker *c);
/* As dyd_checker_stays, on a sphere, from one eye; place_still as for dyd_checker_still_images. */
dyd_status dyd_checker_stays_on_sphere(bool *out, dyd_checker *c, const bool *place_still);
/* still[k]: nothing narrows the image that is site k, place_still[i] telling of place i (NULL: of exact ones). */
void dyd_checker_still_images(bool *still, const dyd_checker *c, const bool *place_still);
/* globe.c: the lines on the radius and the places. */
dyd_status dyd_checker_globe_places(dyd_checker *c);
/* The section but for its last lines. */
dyd_status dyd_checker_globe(dyd_checker *c);
/* around.c: what follows for pairs of places; reads the list of neighbours of the eye. */
dyd_status dyd_checker_around(dyd_checker *c);
/* Places i and j: may the pair be possible and no sure edge, by what is stated? */
bool dyd_checker_is_open(const dyd_checker *c, uint32_t i, uint32_t j);
/* Is no pair of the eye, or about it, open? */
bool dyd_checker_is_closed_around(const dyd_checker *c);
/* The bound that the goal `goal` is about is stated to be `bound`. */
void dyd_cert_note_bound(dyd_checker *c, const char *goal, const dyd_exact *bound);

/* Are the points of p, in this order, the vertices of a strictly convex polygon, counter-clockwise? */
bool dyd_cert_polygon_is_convex(const dyd_cert_chain *p);
/* Adds twice the area of such a polygon. */
void dyd_cert_polygon_area2(dyd_exact *out, const dyd_cert_chain *p);
bool dyd_cert_window_has(const dyd_cert_window *w, const dyd_exact at[2]);
void dyd_cert_window_area(dyd_exact *out, const dyd_cert_window *w);

/* The word must be there. */
dyd_status dyd_cert_expect_word(dyd_checker *c, const char *name);
/* The next line, which must begin with the word. */
dyd_status dyd_cert_expect_line(dyd_checker *c, const char *name);
/* The word is one of text[0 .. count-1]; *out is its number. */
dyd_status dyd_cert_read_choice(size_t *out, dyd_checker *c, const char *const *text, size_t count);
/* A site that is no alias. */
dyd_status dyd_cert_read_site(uint32_t *out, dyd_checker *c);
/* Two sites i < j, later than the pair before, which is (0,0) at first. */
dyd_status dyd_cert_read_pair(dyd_cert_edge *pair, dyd_checker *c);

void dyd_cert_corners_clear(dyd_cert_corners *c);

/* The whole check: as dyd_verify_certificate, without the points. */
dyd_status dyd_checker_verify(dyd_certificate_report *out, FILE *in, dyd_error *err);

#endif
