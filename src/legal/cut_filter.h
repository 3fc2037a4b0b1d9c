/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The half-planes of the witness search, in doubles relative to the current centre.
 *
 * They only propose the next centre, which is then checked exactly. */
#ifndef DYD_LEGAL_CUT_FILTER_H
#define DYD_LEGAL_CUT_FILTER_H

#include "delaunay/state.h"
#include "legal/exact_lp.h"
#include "legal/lp_filter.h"

/* Half-planes n.x + d > 0 for the moves x of the centre. The first `old` of them were carried along from earlier
 * centres, d in units of 2^unit; the others belong to the present centre, d * 2^exp[k] (k counts from the first of
 * them). impossible: two rectangles touch, nothing can separate them. */
typedef struct dyd_cut_list {
  dyd_cut cut[DYD_LP_CUTS];
  int64_t exp[DYD_LP_CUTS];
  size_t count, old;
  int64_t unit, size; /* size: exponent of the distances between the rectangles */
  bool impossible, empty;
  int64_t finest; /* least unit so far; 0 at first */
  int stalled;    /* noisy moves in turn that came no closer */
} dyd_cut_list;

/* An enclosure of c in doubles. */
void dyd_cut_box(dyd_bbox *box, const dyd_point *c);
/* Upper bound of max(dl_i, dl_j)^2 over the box. */
double dyd_cut_radius2(const dyd_delaunay *pd, const dyd_bbox *c, uint32_t i, uint32_t j);
/* All present cuts become old ones. */
void dyd_cut_age(dyd_cut_list *l);
/* Adds the half-plane of the farthest corner of `own` against the nearest point of `other` at c. */
void dyd_cut_add(dyd_cut_list *l, const dyd_point *c, const dyd_rect *own, const dyd_rect *other);
/* Moves c to the centre of the largest disc inside all cuts; false when there is no room for one, or at the floor. */
bool dyd_cut_move(dyd_point *c, dyd_cut_list *l, dyd_status *status);

/* The half-plane of dyd_cut_add in user coordinates, exactly; false: the two points coincide. *violated: c is not in
 * it. */
bool dyd_cut_exactly(bool *violated, dyd_half_plane *h, const dyd_point *c, const dyd_rect *own, const dyd_rect *other);
/* 2^e is less than a quarter of the radius z / d, and more than a 64th. */
int64_t dyd_cut_exponent(const dyd_exact_centre *p);
/* c = p rounded so that it stays inside the disc (in the sum norm) of radius z / d > 0. */
dyd_status dyd_cut_round(dyd_point *c, const dyd_exact_centre *p);

#endif
