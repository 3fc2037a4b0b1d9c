/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Centres of circles through a given corner and two more features, in integers. */
#ifndef DYD_PREDICATE_SOLVE_H
#define DYD_PREDICATE_SOLVE_H

#include "predicate/icircle.h"

/* A point (both coordinates) or an axis-parallel line (one, across that axis), relative to the corner. */
typedef struct dyd_feature {
  bool has[2];
  mpz_t at[2];
} dyd_feature;

void dyd_feature_init(dyd_feature *f);
void dyd_feature_clear(dyd_feature *f);

/* Centres ((a[0] + b[0] sqrt(c)) / d, (a[1] + b[1] sqrt(c)) / d), d > 0, c >= 0. */
typedef struct dyd_centre {
  mpz_t a[2], b[2], c, d;
  mpz_t s, t; /* scratch */
} dyd_centre;

void dyd_centre_init(dyd_centre *k);
void dyd_centre_clear(dyd_centre *k);

/* The centres of all circles that pass through the origin, pass through each point and touch each line; which picks
 * one of at most DYD_CENTRES_MAX = 2. false: there is none with that number, or infinitely many. */
enum { DYD_CENTRES_MAX = 2 };
bool dyd_solve(dyd_centre *out, const dyd_feature *f, const dyd_feature *g, int which);

#endif
