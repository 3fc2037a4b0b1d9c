/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans tried on drawn places, of a plane or of a sphere. */
#ifndef DYD_TOLERANCE_TRIALS_H
#define DYD_TOLERANCE_TRIALS_H

#include "tolerance/survey.h"

/* Shared by all trials of a plan. begin makes the state of a trial, whose places the seed draws; step
 * measures the points of a plan in it, and plans again for `asked`; end frees it. */
typedef struct dyd_trials {
  dyd_survey_trial *out;
  size_t count;
  uint64_t seed;
  const dyd_survey *first; /* the plan that all begin with */
  size_t sites;
  dyd_pair_list asked; /* all pairs of the first plan that are open; borrowed from it */
  const volatile int *cancel;
  dyd_status (*begin)(void **draw, const struct dyd_trials *t, uint64_t seed);
  dyd_status (*step)(dyd_survey **next, void *draw, const struct dyd_trials *t, const dyd_survey *plan, dyd_error *err);
  void (*end)(void *draw);
  const void *user;
} dyd_trials;

/* Runs all; the rest as dyd_survey_simulate. */
dyd_status dyd_trials_run(dyd_trials *t, unsigned threads, dyd_error *err);
/* Sets u to a number in (0, 1) that seed and k draw, a multiple of 2^-54. */
void dyd_trial_draw(mpq_ptr u, uint64_t seed, uint64_t k);

#endif
