/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Labels of points in their input: the number of their row, and its fields: identifier, cost, and a radius that is not
 * in the rectangle. */
#ifndef DYD_ENGINE_LABELS_H
#define DYD_ENGINE_LABELS_H

#include <dyadel/io.h>

/* The numbers of a row; without any: a cost of 1, the others 0. */
typedef struct dyd_row_numbers {
  double of[DYD_ROW_NUMBERS];
} dyd_row_numbers;
static const dyd_row_numbers dyd_no_row_numbers = {{[DYD_ROW_COST] = 1}};

/* A row that was taken as one with the row of a point. */
typedef struct dyd_merged_row {
  size_t row;
  size_t point;
} dyd_merged_row;

/* Invariant: row[0 .. points) and merged[].row ascend and are below rows; id[i] is where the terminated text of point
 * i begins, all are 0 without identifiers. */
typedef struct dyd_labels {
  size_t points, rows;
  size_t *row, *id;
  dyd_row_numbers *number;
  size_t row_cap, id_cap, number_cap;
  char *text;
  size_t used, text_cap;
  dyd_merged_row *merged;
  size_t merges, merged_cap;
  bool has_ids;
  /* Behind each identifier stand `carried` more texts, each terminated: what columns of these names hold, which are
   * terminated, too; NULL: there are none. anonymous: identifiers are empty and count for nothing. */
  size_t carried;
  char *names;
  bool anonymous;
} dyd_labels;

void dyd_labels_clear(dyd_labels *l);
/* Bytes that labels take. O(1) */
size_t dyd_labels_bytes(const dyd_labels *l);
/* The next point, of row l->rows; id (length bytes, copied, with carried texts behind a NUL
 * each) may be NULL. false: memory is exhausted. */
bool dyd_labels_add(dyd_labels *l, const char *id, size_t length, const dyd_row_numbers *number);
/* The next row, which is that of `point` again. false: memory is exhausted. */
bool dyd_labels_merge(dyd_labels *l, size_t point);
/* *out becomes the labels of e with those of `more` behind, for the points that come next. DYD_E_NOMEM. */
dyd_status dyd_labels_join(dyd_labels *out, const dyd_engine *e, const dyd_labels *more);
/* Hands *l over to e, to be called when the points were added; l is empty afterwards. */
void dyd_labels_give(dyd_engine *e, dyd_labels *l);
/* The confidence that points are added with; *e has none before. */
void dyd_engine_give_confidence(dyd_engine *e, const dyd_confidence *c);

#endif
