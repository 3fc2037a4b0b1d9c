/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Walks around the circle of directions.
 *
 * Another site k and v compare by the rectangle D = R_k - R_v of differences. When 0 is not in D, the directions u with
 * u.d > 0 for all d in D (k surely farther out than v) form an open arc of at most a half turn, bounded by the normals
 * of D's two extreme corners; where v is surely farther out than k, by those of R_v - R_k. */
#ifndef DYD_SKELETON_ARCS_H
#define DYD_SKELETON_ARCS_H

#include "skeleton/work.h"

typedef struct dyd_vec {
  mpz_t x, y;
} dyd_vec;

static inline void dyd_vec_init(dyd_vec *a) {
  mpz_inits(a->x, a->y, NULL);
}
static inline void dyd_vec_clear(dyd_vec *a) {
  mpz_clears(a->x, a->y, NULL);
}
static inline void dyd_vec_set(dyd_vec *a, const dyd_vec *b) {
  mpz_set(a->x, b->x);
  mpz_set(a->y, b->y);
}

/* One walk, at the direction u. */
typedef struct dyd_arcs {
  dyd_work *w;
  const dyd_skeleton *sk;
  uint32_t own[2], found;    /* the vertices compared with all others; equal when it is one */
  dyd_vec u, from, to, d[4]; /* from, to: ends of the arc of the site found; d: scratch */
  bool outward;              /* arcs where the other site is farther out, else where v is */
  bool empty;                /* the arc found is empty */
  dyd_status status;
} dyd_arcs;

void dyd_arcs_init(dyd_arcs *t, dyd_work *w, const dyd_skeleton *sk, uint32_t v, uint32_t v2, bool outward);
void dyd_arcs_clear(dyd_arcs *t);
/* Looks for a site in whose arc u is (outward), or is not; t->found, and its arc. DYD_NONE: there is none. */
void dyd_arcs_ask(dyd_arcs *t);
/* Signs of products. */
int dyd_arcs_cross(dyd_arcs *t, const dyd_vec *a, const dyd_vec *b);
int dyd_arcs_dot(dyd_arcs *t, const dyd_vec *a, const dyd_vec *b);

#endif
