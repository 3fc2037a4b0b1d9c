/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Witnesses: the centre of a disc that holds two rectangles and meets no other (mathematics: section 5). */
#ifndef DYD_LEGAL_WITNESS_H
#define DYD_LEGAL_WITNESS_H

#include "skeleton/work.h"

/* Looks for a witness of the pair of vertices i, j from a first guess (any doubles, NaN allowed).
 * *found: a witness was found and checked exactly against every site; c (may be NULL) is set to it.
 * Not found: half-planes that hold all witnesses have no common point (in doubles by a margin of 1e-9 of the distances
 * that bound it, else exactly), or the floor is met: every disc of witnesses has a radius below 2^-120 unit^2 / size
 * (ends of the rectangles met being multiples of unit, below size), or the exact search gave no answer in 48 + 2^17
 * / log2(size / unit) steps, at most 400, or with 1020 half-planes. across (may be NULL): two vertices on either side
 * of ij; when one circle meets all four rectangles, no witness exists, and there is no search where doubles do not
 * decide [WIT-QUAD]. */
dyd_status dyd_witness_search(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                              dyd_xy guess, const uint32_t across[2]);
/* The same with a verdict that is proved: TRUE, c is set to it; FALSE: there is none, or the floor is met, in integers
 * [LP-1] or since one circle meets all four [WIT-QUAD]; UNKNOWN: the exact search gave no answer. */
dyd_status dyd_witness_decide(dyd_truth *exists, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i,
                              uint32_t j, dyd_xy guess, const uint32_t across[2]);
/* A witness far out, for a pair on the hull: found whenever all centres far enough in some direction are witnesses. */
dyd_status dyd_witness_far(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j);
/* Returns true if c is a witness of i, j. Exact. */
bool dyd_witness_check(dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j, const dyd_point *c);
/* The same of the ends of a half-edge. */
bool dyd_witness_at(dyd_work *w, const dyd_skeleton *sk, dyd_half_edge h, dyd_xy at);

/* ---- the linear program of lp_filter.h in integers: the middle of a few half-planes ---- */

/* a x + b y + c > 0, with w = |a| + |b| > 0. */
typedef struct dyd_half_plane {
  mpz_t a, b, c, w;
} dyd_half_plane;

void dyd_half_plane_init(dyd_half_plane *h);
void dyd_half_plane_clear(dyd_half_plane *h);

/* The point (x, y) / d, d > 0, that maximises z / d = min over the half-planes of (a x + b y + c) / w. */
typedef struct dyd_exact_centre {
  mpz_t x, y, z, d;
} dyd_exact_centre;

void dyd_exact_centre_init(dyd_exact_centre *p);
void dyd_exact_centre_clear(dyd_exact_centre *p);

/* The half-planes h[0..3] must be the sides x > -m, x < m, y > -m, y < m of a square (w = |a| or |b|). z <= 0
 * afterwards says that the open half-planes have no common point [LP-1]. false: no end after many steps, or no memory,
 * or *cancel (may be NULL) is set. */
bool dyd_exact_lp(dyd_exact_centre *out, const dyd_half_plane *h, size_t count, const volatile int *cancel);

/* c: a dyadic point next to the centre of the circle through the representatives of v[0..2]. false: they are collinear,
 * or it is beyond the numbers there are. */
bool dyd_circumcentre_round(dyd_point *c, const dyd_skeleton *sk, const uint32_t v[3]);

#endif
