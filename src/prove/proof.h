/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writer of certificates gathers: the sites and proofs in the form that the checker takes. */
#ifndef DYD_PROVE_PROOF_H
#define DYD_PROVE_PROOF_H

#include "base/local.h"
#include "checker/caps.h"
#include "checker/chain.h"
#include "checker/faces.h"
#include "checker/globe_near.h"
#include "checker/ties.h"
#include "checker/witness.h"
#include "tolerance/discs.h"

#include <dyadel/engine.h>

#include <stdio.h>

/* Centres, two numbers each. */
typedef struct dyd_proof_points {
  dyd_exact (*item)[2];
  size_t count, cap;
} dyd_proof_points;

/* Invariant: witness k belongs to legal pair k, centre k to bridge k; everything passes the checker. */
typedef struct dyd_proof {
  const dyd_engine *engine; /* borrowed */
  const dyd_delaunay *pd;
  dyd_cert_sites sites;
  bool rounded; /* some have rational ends, which are stated rounded outward */
  dyd_cert_tree tree;
  dyd_pair_list pairs; /* all possible pairs */
  dyd_cert_edges legal, bridges, open, chained;
  uint64_t unproved; /* once the pairs are written */
  dyd_proof_points witness, centre;
  dyd_cert_corner *corner; /* sorted by site */
  size_t corners, corner_cap;
  dyd_cert_graph graph;
  dyd_cert_faces faces;
} dyd_proof;

/* Sets the sites and the tree, which the caller clears. */
dyd_status dyd_proof_gather_sites(dyd_proof *p);
void dyd_proof_put_sites(FILE *out, const dyd_proof *p);

/* Copies a site into the checker's form. */
dyd_status dyd_proof_add_site(dyd_cert_sites *out, const dyd_rect *r);
/* Appends a centre, shortened to the fewest bits that still make it a witness; *found = false (nothing appended) when
 * it is none. */
dyd_status dyd_proof_add_witness(bool *found, dyd_proof_points *out, const dyd_proof *p, uint32_t i, uint32_t j,
                                 const dyd_point *c, bool places);
void dyd_proof_points_clear(dyd_proof_points *p);

/* Bridges that connect the legal graph, and the places they need; none when it is connected, or when they are not
 * found. */
dyd_status dyd_proof_find_bridges(dyd_proof *p);
/* The graph, the corners and the faces. */
dyd_status dyd_proof_find_faces(dyd_proof *p);
void dyd_proof_drop_corners(dyd_proof *p);
/* Looks for a direction in which site v is certainly beyond all other sites of the list; u is initialised. */
bool dyd_proof_find_direction(dyd_exact u[2], const dyd_proof *p, uint32_t v, const uint32_t *site, size_t count);
/* Looks for a chain that proves the pair of an open set illegal. Sites `near` are tried as blockers. */
dyd_status dyd_proof_find_chain(bool *found, dyd_cert_chain *out, const dyd_proof *p, uint32_t i, uint32_t j,
                                const uint32_t *near, size_t count);

/* Writes the format, and for %i a site (uint32_t), %n a number (const dyd_exact *), %p a point (of two numbers), %s a
 * side (const dyd_cert_side *). */
void dyd_proof_put(FILE *out, const char *format, ...);
DYD_ARRAYS(dyd_exact)
/* Initialises, clears `count` numbers. */
void dyd_proof_init(dyd_exact *x, size_t count);
void dyd_proof_clear(dyd_exact *x, size_t count);
/* Writes the section of the pairs; counts the proved pairs in the faces. */
dyd_status dyd_proof_put_pairs(FILE *out, dyd_proof *p);

/* Writes what points are, where ties or aliases follow from it that the checker sees. */
dyd_status dyd_proof_put_ties(FILE *out, const dyd_proof *p);

/* Which points of e are what the blocks describe: found[i], others stay as they are; *others: how many are not. */
dyd_status dyd_proof_compare_points(bool *found, size_t *others, const dyd_cert_ties *t, const dyd_engine *e);

/* A disc of dyadics that holds d. */
void dyd_proof_hold_disc(dyd_cert_disc *out, const dyd_disc *d);
/* The discs by site; *fixed: nothing narrows any of them. The caller frees them, on failure too. DYD_E_ARG: a rectangle
 * has unequal sides. */
dyd_status dyd_proof_gather_discs(dyd_cert_disc **out, bool *fixed, const dyd_proof *p);
void dyd_proof_free_discs(dyd_cert_disc *disc, const dyd_proof *p);
/* Writes the first lines of the section on discs. */
void dyd_proof_put_disc_lines(FILE *out, const dyd_cert_disc *disc, bool fixed, const dyd_proof *p);
/* Writes the section on discs, whose pairs these are: fewer are open than p->pairs. DYD_E_ARG: a rectangle is no
 * square.
 */
dyd_status dyd_proof_put_discs(FILE *out, const dyd_proof *p, const dyd_pair_list *pairs);

/* Writes the section on the diagram, of points in discs or in rectangles; nothing for a result that is capped.
 * DYD_E_ARG for a wrong window. */
dyd_status dyd_proof_put_diagram(FILE *out, dyd_proof *p, const dyd_rect *window, bool discs);

struct dyd_sphere;
struct dyd_certificate_parts;

/* Copies an interval into a side without a denominator yet. */
dyd_status dyd_proof_set_side(dyd_cert_side *out, const dyd_interval *a);

/* out = x. */
void dyd_proof_set(dyd_exact *out, const dyd_dyadic *x);
/* out = x rounded to the nearest multiple of 2^exp, without trailing zero bits. */
void dyd_proof_round(dyd_exact *out, const dyd_exact *x, int64_t exp);
void dyd_proof_trim(dyd_exact *x);

#endif
