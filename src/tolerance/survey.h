/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Working out a plan: rectangles and how they would be after measuring; faces one by one; the whole. */
#ifndef DYD_TOLERANCE_SURVEY_H
#define DYD_TOLERANCE_SURVEY_H

#include "delaunay/memory.h"
#include <dyadel/survey.h>

DYD_OWNERS(dyd_survey)

/* A site as it is, and how small it can be measured. rect: now; centre, half: of it, exactly (half of the larger
 * side). chosen: is in the plan. */
typedef struct dyd_survey_site {
  dyd_rect rect;
  mpq_t x, y, half;
  bool chosen;
  unsigned coarser; /* its accuracy is that of the common factor times 2^coarser */
} dyd_survey_site;

/* face: in which face its site was chosen, from 0. */
typedef struct dyd_face_row {
  dyd_survey_row row;
  size_t face;
} dyd_face_row;

/* Accuracies are min(scale * 2^coarser * unit, half): unit is the accuracy that was given, or each site's own half
 * (unit NULL). */
struct dyd_survey {
  dyd_survey_result result; /* left: with the plan as it is */
  dyd_survey_options options;
  dyd_memory memory; /* what the triangulation leaves of max_bytes */
  dyd_error *err;    /* of the call that makes it; borrowed, may be NULL */
  unsigned threads;
  size_t sites;
  dyd_survey_site *site;
  /* Asked for, open, and no tie; sorted; behind them `tied` more that tie at the centres. Statuses: at the centres. */
  dyd_pair_list target;
  size_t tied;
  dyd_survey_pair *pair; /* the same, with the rows that decide them */
  size_t *first, *at;    /* those with an end i: target.item[at[first[i]]] to target.item[at[first[i + 1] - 1]] */
  mpq_t scale;
  dyd_face_row *chosen; /* rows of one face after the other, each face in the order to measure */
  size_t chosens, chosen_cap, faces;
  dyd_survey_row *row;
  size_t rows;
  dyd_survey_row *draft; /* sites chosen so far, in that order, counted in a triangulation of all; while work lasts */
  size_t drafts, draft_cap;
  bool drafted; /* nothing more is added to it */
};

/* Is it said how exactly can be measured? */
static inline bool dyd_survey_is_limited(const dyd_survey *s) {
  return s->options.accuracy || s->options.accuracies;
}

/* survey_choose.c: sets side to its part within a of the centre, rounded outward; end: scratch. */
dyd_status dyd_survey_cut(dyd_interval *side, mpq_srcptr centre, mpq_srcptr a, mpq_t end[2]);
/* Chooses the plan, makes it small, and its accuracies coarse; then its rows. */
dyd_status dyd_survey_choose(dyd_survey *s, const dyd_delaunay *pd);
/* A new triangulation of all sites, the chosen ones measured; of the centres of all. */
dyd_status dyd_survey_triangulate(dyd_delaunay **pd, const dyd_survey *s, bool centres);

/* DYD_CANCELLED, with a message about the part there is, if the plan is not finished. */
dyd_status dyd_survey_tell_cut(const dyd_survey *s, dyd_error *err);

/* A trial of a plan. seed: draws its places; now: the regions so far, NULL: as they were; needed: how exactly each site
 * of the plan followed is measured, else 0. */
typedef struct dyd_trial {
  const struct dyd_trials *of;
  uint64_t seed;
  void *now;
  double *needed;
} dyd_trial;

/* Shared by all trials of a plan. step: replaces the regions by the measured ones, and plans again; end: frees them. */
typedef struct dyd_trials {
  dyd_survey_trial *out;
  size_t count;
  uint64_t seed;
  const dyd_survey *first; /* the plan that all begin with */
  size_t sites;
  dyd_pair_list asked;        /* all pairs of the first plan that are open; borrowed from it */
  dyd_survey_options options; /* of the first plan; while trials run, of those after it, which ask for `asked` */
  dyd_status (*step)(dyd_survey **next, dyd_trial *d, dyd_error *err);
  void (*end)(void *now);
  const void *user;
} dyd_trials;

/* Runs all; the rest as dyd_survey_simulate. */
dyd_status dyd_trials_run(dyd_trials *t, unsigned threads, dyd_error *err);
/* Sets u to two numbers in (0, 1) that the seed draws, multiples of 2^-54; disc: of the disc in the unit square. */
void dyd_trial_draw(mpq_t u[2], uint64_t seed, bool disc);

#endif
