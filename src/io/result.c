/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers of the triangulation share, and the end of every file. */
#include "io/result.h"
#include "base/alloc.h"
#include "base/error.h"
#include <errno.h>
#include <math.h>
#include <string.h>

const char *dyd_pair_status_text(dyd_pair_status status) {
  static const char *const text[] = {
      [DYD_ILLEGAL] = "illegal", [DYD_TIE] = "tie", [DYD_INDETERMINATE] = "indeterminate", [DYD_LEGAL] = "legal"};
  return text[status];
}

dyd_status dyd_result_box(double box[4], const dyd_result *r, size_t i, dyd_error *err) {
  dyd_sites_get_d(box, r->sites, i);
  if (isfinite(box[0]) && isfinite(box[1]) && isfinite(box[2]) && isfinite(box[3])) return DYD_OK;
  if (err) err->point = i;
  return dyd_fail(err, DYD_E_RANGE,
                  "point %zu lies beyond the largest double, which this format cannot show; use csv or json", i);
}

dyd_status dyd_result_places(dyd_place **out, char bound[DYD_DECIMAL_SIZE], const dyd_result *r, dyd_error *err) {
  dyd_place *places = dyd_alloc(r->count, sizeof *places);
  dyd_status st = places ? DYD_OK : DYD_E_NOMEM;
  double box[4], most = 0;
  for (size_t i = 0; i < r->count && st == DYD_OK; i++) {
    st = dyd_result_box(box, r, i, err);
    if (st != DYD_OK) break;
    dyd_place_set(&places[i], box);
    most = fmax(most, places[i].error);
  }
  dyd_decimal_directed(bound, most, 2, DYD_UP);
  if (st == DYD_OK)
    *out = places;
  else
    free(places);
  return st;
}

static void mark_hull(dyd_site_row *rows, const dyd_index_list *list, const char *hull) {
  for (size_t k = 0; k < list->count; k++) rows[list->item[k]].hull = hull;
}

static dyd_status find_hull(dyd_site_row *rows, const dyd_result *r) {
  dyd_index_list sure = {0}, possible = {0};
  dyd_status st = dyd_delaunay_hull_vertices(&sure, &possible, r->pd);
  for (size_t i = 0; i < r->count; i++) rows[i].hull = "not";
  mark_hull(rows, &possible, "possibly");
  mark_hull(rows, &sure, "surely");
  dyd_index_list_clear(&possible);
  dyd_index_list_clear(&sure);
  return st;
}

/* Each site of a group is tied with all but itself and those next to it. */
static dyd_status count_ties(void *context, dyd_group_kind kind, const dyd_index_list *sites) {
  dyd_site_row *rows = context;
  size_t count = sites->count;
  for (size_t k = 0; k < count; k++) {
    size_t near = kind == DYD_GROUP_PAIR ? 0 : kind == DYD_GROUP_CHAIN && (k == 0 || k + 1 == count) ? 1 : 2;
    rows[sites->item[k]].partners[DYD_TIE] += count - 1 - near;
  }
  return DYD_OK;
}

/* Ties come as groups, whether pairs hold them or not. */
dyd_status dyd_result_sites(dyd_site_row **out, const dyd_result *r) {
  dyd_site_row *rows = calloc(r->count ? r->count : 1, sizeof *rows);
  dyd_status st = rows ? find_hull(rows, r) : DYD_E_NOMEM;
  if (st != DYD_OK) {
    free(rows);
    return st;
  }
  if (!r->discs) st = dyd_delaunay_each_group(r->pd, count_ties, rows);
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    if (p->status == DYD_TIE && !r->discs) continue;
    rows[p->i].partners[p->status]++;
    rows[p->j].partners[p->status]++;
  }
  for (size_t i = 0; i < r->count; i++) rows[i] = rows[dyd_delaunay_alias(r->pd, (uint32_t)i)];
  if (st == DYD_OK)
    *out = rows;
  else
    free(rows);
  return st;
}

void dyd_put_rows(FILE *out, const dyd_engine *e, const dyd_index_list *list, const char *between) {
  for (size_t k = 0; k < list->count; k++) fprintf(out, "%s%zu", k ? between : "", dyd_engine_row(e, list->item[k]));
}

dyd_status dyd_result_faces(const dyd_result *r, const char *first, const char *next, const char *between,
                            const char *end) {
  dyd_index_list face = {0};
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(r->pd) && st == DYD_OK; f++) {
    bool outer;
    st = dyd_delaunay_face(&face, &outer, r->pd, f);
    if (st != DYD_OK) break;
    fputs(f ? next : first, r->out);
    dyd_put_rows(r->out, r->engine, &face, between);
    fputs(end, r->out);
  }
  dyd_index_list_clear(&face);
  return st;
}

dyd_status dyd_output_end(FILE *out, dyd_error *err) {
  if (fflush(out) == 0 && !ferror(out)) return DYD_OK;
  return dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno ? errno : EIO));
}
