/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadic points next to the centres of circles through representatives, at any depth. */
#ifndef DYD_SKELETON_CIRCUMCENTRE_H
#define DYD_SKELETON_CIRCUMCENTRE_H

#include "skeleton/skeleton.h"

/* c = (x, y) / d, d > 0, each rounded down to a multiple of 2^e. */
dyd_status dyd_centre_round(dyd_point *c, const mpz_t x, const mpz_t y, const mpz_t d, int64_t e);
/* c: a dyadic point next to the centre of the circle through the representatives of v[0..2]. false: they are collinear,
 * or it is beyond the numbers there are. */
bool dyd_circumcentre_round(dyd_point *c, const dyd_skeleton *sk, const uint32_t v[3]);
/* c: a dyadic point next to the middle of the centres of the circles through the representatives of i, j and each of
 * the two across: where a witness of ij is likely. false: one of the triples is collinear, or it is beyond numbers. */
bool dyd_circumcentre_between(dyd_point *c, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t across[2]);
/* c = p, which is finite. */
void dyd_point_set_xy(dyd_point *c, dyd_xy p);

#endif
