/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Small sets of points, and the questions about them. */
#ifndef DYD_TESTS_TOLERANCE_CASES_H
#define DYD_TESTS_TOLERANCE_CASES_H

#include "support/random.h"
#include "tolerance/brute.h"

#include <dyadel/tolerance.h>

typedef struct cases_answer {
  dyd_sites *sites;
  dyd_delaunay *pd;
  dyd_tolerance *t;
} cases_answer;

/* Of kind 0 to 5: flat, nearly a grid, nearly a circle, small grids with ties, anywhere, on a line. Coordinates are
 * doubles of few bits, so that ties and near ties are met. */
void cases_make(brute_points *p, test_random *r, size_t kind);
void cases_ask(cases_answer *a, const brute_points *p, const dyd_tolerance_options *o);
void cases_forget(cases_answer *a);
/* NULL: there is none. The order of rows is checked, too. */
const dyd_tolerance_row *cases_row(const dyd_tolerance *t, uint32_t i, uint32_t j);
/* Returns true if k and l are on different sides of ij. */
bool cases_parted(const brute_points *p, const dyd_tolerance_row *row);
bool cases_is_edge(const brute_points *p, uint32_t i, uint32_t j);
/* Moves by up to `share` of the radius, often by all of it. */
void cases_move(brute_points *out, const brute_points *p, const double *radius, double share, test_random *r);
/* Returns true if all statuses of p are those of a. */
bool cases_same_edges(const brute_points *p, const cases_answer *a);

#endif
