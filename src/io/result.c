/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers share: the result of a plane or of a sphere, words, and the end of every file. */
#include "io/output.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "io/read/text.h"
#include <errno.h>
#include <math.h>
#include <string.h>

/* ---- a result of a plane or of a sphere ---- */

dyd_outcome dyd_result_outcome(const dyd_result *r) {
  return r->sphere ? dyd_sphere_outcome(r->sphere) : dyd_engine_outcome(r->engine);
}

/* The lowest site at the place of site i. */
static uint32_t result_alias(const dyd_result *r, uint32_t i) {
  return r->sphere ? dyd_sphere_alias(r->sphere, i) : dyd_delaunay_alias(r->pd, i);
}

dyd_status dyd_result_triangles(dyd_triangle_list *out, const dyd_result *r) {
  if (r->sphere) return dyd_sphere_triangles(out, r->sphere);
  return r->discs ? dyd_disc_triangles(out, &r->pairs, r->pd) : dyd_delaunay_triangles(out, NULL, r->pd, 0);
}

void dyd_result_count(size_t count[4], const dyd_result *r) {
  for (int k = 0; k < 4; k++) count[k] = 0;
  if (!r->sphere) dyd_delaunay_count(count, r->pd);
  for (size_t k = 0; r->sphere && k < r->pairs.count; k++) count[r->pairs.item[k].status]++;
}

dyd_status dyd_sphere_boxes(double (**out)[4], const dyd_sphere *s) {
  size_t n = dyd_engine_count(dyd_sphere_places(s));
  double(*box)[4] = dyd_alloc(n, sizeof *box);
  dyd_status st = box ? DYD_OK : DYD_E_NOMEM;
  DYD_LOCAL(dyd_rect, r);
  for (uint32_t i = 0; i < n && st == DYD_OK; i++) {
    st = dyd_sphere_rect(&r, s, i);
    if (st == DYD_OK) dyd_rect_get_d(box[i], &r);
  }
  if (st == DYD_OK)
    *out = box;
  else
    free(box);
  return st;
}

static void mark_hull(dyd_site_row *rows, const dyd_index_list *list, const char *hull) {
  for (size_t k = 0; k < list->count; k++) rows[list->item[k]].hull = hull;
}

static dyd_status find_hull(dyd_site_row *rows, const dyd_result *r) {
  DYD_SCOPED(dyd_hull) hull = {0};
  dyd_status st = r->sphere ? DYD_OK : dyd_delaunay_partial_hull(&hull, r->pd, false);
  for (size_t i = 0; i < r->count; i++) rows[i].hull = "no";
  mark_hull(rows, &hull.possible_vertices, "possible");
  mark_hull(rows, &hull.sure_vertices, "certain");
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

/* In the plane ties come as groups, whether pairs hold them or not. */
dyd_status dyd_result_sites(dyd_site_row **out, const dyd_result *r) {
  dyd_site_row *rows = calloc(r->count ? r->count : 1, sizeof *rows);
  dyd_status st = rows ? find_hull(rows, r) : DYD_E_NOMEM;
  bool groups = !r->discs && !r->sphere;
  if (st != DYD_OK) {
    free(rows);
    return st;
  }
  if (groups) st = dyd_delaunay_each_group(r->pd, count_ties, rows);
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    if (p->status == DYD_TIE && groups) continue;
    rows[p->i].partners[p->status]++;
    rows[p->j].partners[p->status]++;
  }
  for (uint32_t i = 0; i < r->count; i++) rows[i] = rows[result_alias(r, i)];
  if (st == DYD_OK)
    *out = rows;
  else
    free(rows);
  return st;
}

/* ---- of the plane ---- */

dyd_status dyd_result_box(double box[4], const dyd_result *r, size_t i, dyd_error *err) {
  dyd_sites_get_d(box, r->sites, i);
  if (isfinite(box[0]) && isfinite(box[1]) && isfinite(box[2]) && isfinite(box[3])) return DYD_OK;
  if (err) err->point = i;
  return dyd_fail(err, DYD_E_RANGE,
                  "the point lies beyond the largest double, which this format cannot show; use csv or json");
}

/* ---- words and texts ---- */

const char *dyd_group_text(dyd_group_kind kind) {
  static const char *const text[] = {"circle", "chain", "pair"};
  return text[kind];
}

const char *dyd_schedule_text(dyd_schedule schedule) {
  return schedule == DYD_SCHEDULE_UNIFORM ? "uniform" : "adaptive";
}

void dyd_put_rows(FILE *out, const dyd_engine *e, const dyd_index_list *list, const char *between) {
  for (size_t k = 0; k < list->count; k++) fprintf(out, "%s%zu", k ? between : "", dyd_engine_row(e, list->item[k]));
}

dyd_status dyd_put_window(FILE *out, const dyd_rect *w, const char *quote, const char *between) {
  const dyd_dyadic *end[] = {&w->x.lo, &w->x.hi, &w->y.lo, &w->y.hi};
  for (int k = 0; k < 4; k++) {
    DYD_FREED char *text = dyd_dyadic_get_str(end[k]);
    if (!text) return DYD_E_NOMEM;
    fprintf(out, "%s%s%s%s", k ? between : "", quote, text, quote);
  }
  return DYD_OK;
}

bool dyd_tolerance_is_cut(size_t *edges, size_t *births, const dyd_tolerance *t) {
  *edges = dyd_tolerance_get(t)->edges_left, *births = dyd_tolerance_get(t)->births_left;
  return *edges || *births;
}

static size_t alias_of(const dyd_alias_walk *w, size_t i) {
  return w->s ? dyd_sphere_alias(w->s, (uint32_t)i) : dyd_delaunay_alias(dyd_engine_delaunay(w->e), (uint32_t)i);
}

bool dyd_alias_next(dyd_alias_walk *w) {
  size_t count = w->s ? dyd_engine_count(w->e) : dyd_sites_count(dyd_delaunay_sites(dyd_engine_delaunay(w->e)));
  size_t row, point;
  while (w->i < count && alias_of(w, w->i) == w->i) w->i++;
  bool alias = w->i < count, merged = dyd_engine_merged(&row, &point, w->e, w->merged);
  if (!alias && !merged) return false;
  if (merged && (!alias || row < dyd_engine_row(w->e, w->i)))
    w->merged++;
  else
    row = dyd_engine_row(w->e, point = w->i++);
  w->row = row;
  w->site = alias_of(w, point);
  w->of = dyd_engine_row(w->e, alias_of(w, point));
  return true;
}

void dyd_csv_aliases(FILE *out, const dyd_engine *e, const dyd_sphere *s) {
  dyd_alias_walk w = {.e = e, .s = s};
  while (dyd_alias_next(&w)) fprintf(out, "# alias %zu %zu\n", w.row, w.of);
}

dyd_status dyd_output_end(FILE *out, dyd_error *err) {
  if (fflush(out) == 0 && !ferror(out)) return DYD_OK;
  return dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno ? errno : EIO));
}

/* Returns true if it is worth a place in a picture. */
static bool label_is_plain(const char *text) {
  const unsigned char *p = (const unsigned char *)text;
  if (!*p || strlen(text) >= DYD_LABEL_SIZE) return false;
  for (size_t n; *p; p += n) {
    n = dyd_utf8_length((const char *)p, 4);
    if (!n || *p < 0x20 || *p == 0x7f) return false;
  }
  return true;
}

const char *dyd_label_text(char spare[DYD_LABEL_SIZE], const dyd_engine *e, size_t site) {
  const char *id = dyd_engine_id(e, site);
  if (id && label_is_plain(id)) return id;
  snprintf(spare, DYD_LABEL_SIZE, "%zu", dyd_engine_row(e, site));
  return spare;
}
