/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The curve beta = {ds_i = ds_j} of two rectangles in doubles: about where it is, and who surely blocks a place or an
 * end of it. */
#ifndef DYD_POSSIBLE_BETA_FILTER_H
#define DYD_POSSIBLE_BETA_FILTER_H

#include "skeleton/rects_filter.h"

/* a, b: the boxes of i and j; a is below b in the coordinate across, t runs along beta (0: x, 1: y). corner[up]: where
 * the outer common tangent at that end touches a and b, enclosed; rise[up] > 0: b reaches farther than a, < 0: a does,
 * 0: not known. Boxes are borrowed. */
typedef struct dyd_beta {
  const dyd_rects *rects;
  uint32_t i, j;
  const dyd_bbox *a, *b;
  int across, t;
  dyd_bbox corner[2][2];
  int rise[2];
} dyd_beta;

/* About a point of beta: its coordinates and ds^2. */
typedef struct dyd_place {
  double at[2], ds2;
} dyd_place;

/* TRUE: the boxes of i and j surely do not meet, and *q is filled in. FALSE: the rectangles surely meet. */
dyd_truth dyd_beta_start(dyd_beta *q, const dyd_rects *r, uint32_t i, uint32_t j);
/* About the point of beta at t. */
dyd_place dyd_beta_at(const dyd_beta *q, double t);
/* About dl^2 of the box at the place. */
double dyd_place_far2(const dyd_place *p, const dyd_bbox *b);
/* About where the part of beta that k blocks ends, seen from a place in it or nearby. */
double dyd_beta_guess_end(const dyd_beta *q, uint32_t k, dyd_place p);
/* Do all of k[0..count-1] surely block one and the same point of beta, which is about at t? */
bool dyd_beta_surely_blocked(const dyd_beta *q, const uint32_t *k, int count, double t);
/* DYD_SURE_PLUS: k surely blocks the end of beta at -inf (up = 0) or inf (1); DYD_SURE_MINUS: some point of its
 * rectangle is surely strictly within the tangent there, so that k blocks no place near that end; DYD_UNSURE: not
 * known. */
dyd_sure dyd_beta_blocks_end(const dyd_beta *q, uint32_t k, int up);

#endif
