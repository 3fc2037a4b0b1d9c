/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Working out a plan: rectangles and how they would be after measuring; faces one by one; the whole. */
#ifndef DYD_TOLERANCE_SURVEY_H
#define DYD_TOLERANCE_SURVEY_H

#include "delaunay/memory.h"
#include "delaunay/steps.h"
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
  dyd_room room;  /* what the triangulation leaves of max_bytes */
  dyd_error *err; /* of the call that makes it; borrowed, may be NULL */
  unsigned threads;
  size_t sites;
  dyd_survey_site *site;
  dyd_pair_list target; /* asked for, open, and no tie; sorted; behind them `tied` more that tie at the centres */
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

/* survey_face.c: sets side to its part within a of the centre, rounded outward; end: scratch. */
dyd_status dyd_survey_cut(dyd_interval *side, mpq_srcptr centre, mpq_srcptr a, mpq_t end[2]);
dyd_status dyd_survey_load(dyd_survey *s, const dyd_sites *sites);
/* A new triangulation of all sites, the chosen ones measured; of the centres of all. */
dyd_status dyd_survey_triangulate(dyd_delaunay **pd, const dyd_survey *s, bool centres);
bool dyd_survey_is_open(const dyd_delaunay *pd, const dyd_pair *p);
/* How many of the targets are open in it. */
size_t dyd_survey_open(const dyd_survey *s, const dyd_delaunay *pd);
/* The accuracy of site i, rounded down. */
double dyd_survey_needed(const dyd_survey *s, uint32_t i);
double dyd_survey_now(const dyd_survey *s, uint32_t i);
/* How often its accuracy can be doubled and still asks for a measurement. */
unsigned dyd_survey_doublings(const dyd_survey *s, uint32_t i);

/* survey_face.c: sorts the targets, finds s->first and s->at. */
dyd_status dyd_survey_index_targets(dyd_survey *s);

/* A face of more sites than these is large. */
enum { DYD_SURVEY_LARGE = 8 };

/* survey_face.c: sites are measured one by one in a triangulation of all. open[k]: is target k; degree[i]: how many
 * open ones end at site i. Without steps it is made anew each time. */
typedef struct dyd_measuring {
  dyd_survey *s;
  dyd_survey_pair *pair; /* where the targets that `row` decides are noted; NULL: nowhere */
  size_t row;
  dyd_delaunay *now;
  dyd_steps steps;
  bool *open;
  size_t *degree, left;
} dyd_measuring;

/* Sites as they are chosen now. To be ended, whatever it returns. */
dyd_status dyd_measuring_begin(dyd_measuring *m, dyd_survey *s);
void dyd_measuring_end(dyd_measuring *m);
/* The same; it is the next site of the draft. */
dyd_status dyd_measuring_draft(size_t *decided, dyd_measuring *m, uint32_t i);

/* survey_face.c: chooses in large faces of the triangulation, as sites are chosen now, until they are small or nothing
 * in them is open or can be measured; appends to s->chosen, and to the draft. */
dyd_status dyd_survey_crowds(dyd_measuring *m);
/* Chooses among the sites of face f of pd so that its targets are decided; appends to s->chosen. */
dyd_status dyd_survey_face(dyd_survey *s, const dyd_delaunay *pd, size_t f);
/* Site i is wider in the survey than where it is measured one by one: *holds if no more targets are open so; then it is
 * as wide there, else nothing has changed. */
dyd_status dyd_measuring_loosens(bool *holds, dyd_measuring *m, uint32_t i);

/* DYD_CANCELLED, with a message about what is there, if the plan is not finished. */
dyd_status dyd_survey_tell_cut(const dyd_survey *s, dyd_error *err);

/* survey_face.c: sets how many pairs each row decides after the rows before it. */
dyd_status dyd_survey_count_left(dyd_survey *s);

#endif
