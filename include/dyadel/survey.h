/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What to measure next: which rectangles have to be smaller, and how small, so that all pairs, or those asked for, are
 * decided (mathematics: section 14). */
#ifndef DYADEL_SURVEY_H
#define DYADEL_SURVEY_H

#include <dyadel/delaunay.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Measure `site` so that it is within `needed` of its nominal place, the centre of its rectangle, in x and in y; half
 * of its larger side is `now`. Then, after the rows before, `decided` more of the pairs asked for are, and `left` are
 * not: counted in a triangulation of all, row by row. now is rounded up; needed is the double nearest to a
 * decimal of 6 digits, rounded down. */
typedef struct dyd_survey_row {
  uint32_t site;
  double now, needed;
  size_t decided, left;
} dyd_survey_row;

typedef struct dyd_survey_options {
  size_t struct_size;         /* set by DYD_SIZED */
  const dyd_pair_list *pairs; /* asked for; NULL: all. Borrowed for the call, as the others */
  const dyd_rect *window;     /* only pairs with an end whose rectangle meets it; NULL: anywhere */
  const uint32_t *site;       /* only pairs with this end; NULL: any */
  mpq_srcptr accuracy;        /* best accuracy of a measurement, above 0; NULL: no limit */
  const double *accuracies;   /* the same of each site; NULL: `accuracy` counts */
  const double *cost;         /* of measuring each site, above 0; NULL: the same for all */
  const volatile int *cancel; /* as in dyd_delaunay_options */
  bool discs; /* only pairs that are indeterminate for the discs in the squares of sites (dyd_disc_pairs) */
} dyd_survey_options;

typedef struct dyd_survey dyd_survey;

/* A plan: if the points of the rows are found where the rows place them, no requested pair is indeterminate, except for
 * ties at the nominal places. One triangulation of these rectangles proves this. No row is superfluous, and all
 * accuracies are as coarse as one common factor makes them, then each alone in powers of 2, as judged by the pairs
 * around it [SUR-1]. dyd_survey_get has the number of pairs that
 * stay undecided even so (the accuracy is not enough, or rectangles are fixed by their centres). pd is borrowed for the
 * call; options may be NULL. Returns DYD_OK; DYD_E_ARG; DYD_CAPPED when pd is; DYD_E_NOMEM: *out is NULL then.
 * DYD_CANCELLED: *out has the rows that were chosen by then, if any, with their effect, see dyd_survey_result, and err
 * names the undecided pairs. Cost: for a face of m sites at most m^2
 * triangulations of m sites, m <= 8; in larger ones some work near each row; some triangulations of all.
 * These use as many threads as the last call of pd. */
DYD_API dyd_status dyd_survey_new(dyd_survey **out, const dyd_delaunay *pd, const dyd_survey_options *options,
                                  dyd_error *err);
DYD_API void dyd_survey_free(dyd_survey *s);
/* In the order to measure them, the most telling first. Borrowed until s is freed. */
DYD_API size_t dyd_survey_rows(const dyd_survey_row **row, const dyd_survey *s);
/* A pair asked for (i < j), but for ties at the nominal places, and the number of the row, from 0, after which it is
 * decided; SIZE_MAX: the plan leaves it undecided. */
typedef struct dyd_survey_pair {
  uint32_t i, j;
  size_t row;
} dyd_survey_pair;
/* Sorted by i, then j. Borrowed until s is freed. */
DYD_API size_t dyd_survey_pairs(const dyd_survey_pair **pair, const dyd_survey *s);
/* A plan tried on drawn places: how often it was followed and made anew, how many points were measured, how many
 * measurements that took, and how many of the pairs asked for stay undecided, ties included. */
typedef struct dyd_survey_trial {
  size_t rounds, points, measurements, left;
  bool done; /* false: work was cancelled before */
} dyd_survey_trial;
/* Tries the plan of dyd_survey_new `count` times. For each trial the seed draws a true place in each rectangle (with
 * options.discs: disc), evenly. Each point of the plan is then known within `needed` of its true place, in addition to
 * its old rectangle (of discs the new disc alone counts), and the pairs that are open still are planned for, until a
 * plan has no row, or four rounds in a row decided nothing; 64 times at most. out: room for `count`. Trials are shared
 * among as many threads as pd has, which results do not depend on. Returns as dyd_survey_new; DYD_CANCELLED: trials
 * that are not done are marked, and err counts them. Cost: that of a plan for each round, of which all trials share the
 * first. */
DYD_API dyd_status dyd_survey_simulate(dyd_survey_trial *out, size_t count, uint64_t seed, const dyd_delaunay *pd,
                                       const dyd_survey_options *options, dyd_error *err);
/* What a plan comes to. */
typedef struct dyd_survey_result {
  size_t struct_size; /* set by the library */
  size_t open, ties;  /* pairs asked for that were undecided; pairs that tie at the nominal places */
  size_t left;        /* pairs that the plan leaves undecided */
  bool cut; /* the plan is not finished: points may be in it that a finished one does not need, in the order they were
               chosen; the numbers of pairs hold as they do otherwise */
  uint32_t tie[2];  /* the first pair asked for that is indeterminate and ties at the nominal places: a measurement of
                       one  of the points on that circle or line decides it unless it lies exactly there */
  uint32_t same[2]; /* the first two points of equal nominal places: pairs next to them may stay undecided, whatever the
                       accuracy. Both: two equal numbers if there are none */
} dyd_survey_result;
/* Borrowed until s is freed. */
DYD_API const dyd_survey_result *dyd_survey_get(const dyd_survey *s);

#ifdef __cplusplus
}
#endif
#endif
