/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points are called where they were read. Points added in other ways are rows of their own, without identifier. */
#include "engine/labels.h"

#include "base/alloc.h"
#include "engine/state.h"
#include <string.h>

void dyd_labels_clear(dyd_labels *l) {
  free(l->row);
  free(l->id);
  free(l->number);
  free(l->text);
  free(l->merged);
  *l = (dyd_labels){0};
}

bool dyd_labels_add(dyd_labels *l, const char *id, size_t length, const dyd_row_numbers *number) {
  if (!dyd_reserve((void **)&l->row, &l->row_cap, l->points + 1, sizeof *l->row) ||
      !dyd_reserve((void **)&l->id, &l->id_cap, l->points + 1, sizeof *l->id) ||
      !dyd_reserve((void **)&l->number, &l->number_cap, l->points + 1, sizeof *l->number) ||
      !dyd_reserve((void **)&l->text, &l->text_cap, l->used + length + 2, 1))
    return false;
  if (!l->used) l->text[l->used++] = 0; /* place 0 is the empty text of those without identifier */
  l->row[l->points] = l->rows++;
  l->number[l->points] = *number;
  l->id[l->points++] = id ? l->used : 0;
  if (!id) return true;
  memcpy(l->text + l->used, id, length);
  l->text[l->used + length] = 0;
  l->used += length + 1;
  return l->has_ids = true;
}

bool dyd_labels_merge(dyd_labels *l, size_t point) {
  if (!dyd_reserve((void **)&l->merged, &l->merged_cap, l->merges + 1, sizeof *l->merged)) return false;
  l->merged[l->merges++] = (dyd_merged_row){l->rows++, point};
  return true;
}

void dyd_labels_skip(dyd_labels *l) {
  l->rows++;
}

/* `from`, its points counted on from out->points and its rows from out->rows. */
static bool labels_append(dyd_labels *out, const dyd_labels *from) {
  size_t rows = out->rows, points = out->points;
  bool good = true;
  for (size_t i = 0; good && i < from->points; i++) {
    const char *id = from->has_ids ? from->text + from->id[i] : NULL;
    out->rows = rows + from->row[i];
    good = dyd_labels_add(out, id, id ? strlen(id) : 0, &from->number[i]);
  }
  for (size_t k = 0; good && k < from->merges; k++) {
    out->rows = rows + from->merged[k].row;
    good = dyd_labels_merge(out, points + from->merged[k].point);
  }
  out->rows = rows + from->rows;
  return good;
}

dyd_status dyd_labels_join(dyd_labels *out, const dyd_engine *e, const dyd_labels *more) {
  dyd_labels all = {0};
  bool good = labels_append(&all, &e->labels);
  while (good && all.points < dyd_sites_count(e->sites)) good = dyd_labels_add(&all, NULL, 0, &dyd_no_row_numbers);
  good = good && labels_append(&all, more);
  if (good)
    *out = all;
  else
    dyd_labels_clear(&all);
  return good ? DYD_OK : DYD_E_NOMEM;
}

dyd_status dyd_labels_cost(dyd_labels *out, const dyd_engine *e, size_t n, const double *cost) {
  dyd_labels more = {0};
  dyd_row_numbers own = dyd_no_row_numbers;
  bool good = true;
  for (size_t k = 0; good && k < n; k++) {
    own.of[DYD_ROW_COST] = cost[k];
    good = dyd_labels_add(&more, NULL, 0, &own);
  }
  dyd_status st = good ? dyd_labels_join(out, e, &more) : DYD_E_NOMEM;
  dyd_labels_clear(&more);
  return st;
}

void dyd_labels_give(dyd_engine *e, dyd_labels *l) {
  dyd_labels_clear(&e->labels);
  e->labels = *l;
  *l = (dyd_labels){0};
}

/* ---- what they tell ---- */

size_t dyd_engine_row(const dyd_engine *e, size_t i) {
  if (!e) return i;
  const dyd_labels *l = &e->labels;
  return i < l->points ? l->row[i] : l->rows + (i - l->points);
}

const char *dyd_engine_id(const dyd_engine *e, size_t i) {
  if (!e || !e->labels.has_ids) return NULL;
  const dyd_labels *l = &e->labels;
  return i < l->points ? l->text + l->id[i] : "";
}

double dyd_engine_number(const dyd_engine *e, size_t i, dyd_row_number which) {
  return (e && i < e->labels.points ? e->labels.number[i] : dyd_no_row_numbers).of[which];
}

bool dyd_engine_merged(size_t *row, size_t *point, const dyd_engine *e, size_t k) {
  if (!e || k >= e->labels.merges) return false;
  *row = e->labels.merged[k].row;
  *point = e->labels.merged[k].point;
  return true;
}
