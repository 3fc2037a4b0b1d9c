/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What all pages tell of points, pairs and triangles, as JSON. */
#include "picture/html/scene.h"

#include "base/alloc.h"
#include "base/error.h"
#include "io/label_text.h"
#include "io/parts.h"
#include "picture/picture.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Pairs; and changes of statuses, all stages together. A page that holds more is no longer moved with ease. */
enum { MOST_PAIRS = 300000, MOST_CHANGES = 4 * MOST_PAIRS };

/* ---- what is shown ---- */

static void scene_middle(double z[2], const dyd_html_scene *s, uint32_t i) {
  double b[4];
  dyd_sites_get_d(b, s->r->sites, i);
  for (int axis = 0; axis < 2; axis++) z[axis] = b[2 * axis] / 2 + b[2 * axis + 1] / 2;
}

/* Does the line of the pair meet the window? As pictures count it. */
static bool scene_sees_pair(const dyd_html_scene *s, const dyd_pair *p) {
  double z[2][2];
  if (!s->r->window) return true;
  scene_middle(z[0], s, p->i);
  scene_middle(z[1], s, p->j);
  return dyd_clip_segment(z, s->window);
}

static bool scene_sees_site(const dyd_html_scene *s, uint32_t i) {
  double b[4];
  const double *w = s->window;
  if (!s->r->window) return true;
  dyd_sites_get_d(b, s->r->sites, i);
  return b[0] <= w[1] && w[0] <= b[1] && b[2] <= w[3] && w[2] <= b[3];
}

/* Points in the window, and the ends of lines across it. */
static void scene_number_points(dyd_html_scene *s) {
  const dyd_history *h = s->history;
  for (uint32_t i = 0; i < s->r->count; i++) s->number[i] = scene_sees_site(s, i) ? 0 : DYD_HTML_NOT_SHOWN;
  for (size_t k = 0; s->r->window && k < h->changes; k++)
    if (scene_sees_pair(s, &h->change[k])) s->number[h->change[k].i] = s->number[h->change[k].j] = 0;
  for (uint32_t i = 0; i < s->r->count; i++) {
    if (dyd_delaunay_alias(s->r->pd, i) != i) s->number[i] = DYD_HTML_NOT_SHOWN;
    if (s->number[i] != DYD_HTML_NOT_SHOWN) s->number[i] = (uint32_t)s->points++;
  }
}

static size_t count_seen(const dyd_html_scene *s, const dyd_pair *pair, size_t count) {
  size_t seen = 0;
  for (size_t k = 0; k < count; k++) seen += scene_sees_pair(s, &pair[k]);
  return seen;
}

static dyd_status scene_check_size(const dyd_html_scene *s, dyd_error *err) {
  const dyd_history *h = s->history;
  size_t pairs = count_seen(s, h->last.item, h->last.count), changes = count_seen(s, h->change, h->changes);
  const char *where = s->r->window ? " in this window" : "",
             *advice = s->r->window ? "a smaller --window" : "a part of the plane, --window XLO,XHI,YLO,YHI";
  if (pairs > MOST_PAIRS)
    return dyd_fail(err, DYD_E_RANGE, "html shows at most %d pairs, and there are %zu%s; give %s, or another format",
                    MOST_PAIRS, pairs, where, advice);
  if (changes > MOST_CHANGES)
    return dyd_fail(err, DYD_E_RANGE,
                    "html shows at most %d changes of pairs, and the stages have %zu%s; raise --start-bits, or give %s",
                    MOST_CHANGES, changes, where, advice);
  return DYD_OK;
}

static bool same_pairs(const dyd_pair_list *a, const dyd_pair_list *b) {
  size_t k = 0;
  while (a->count == b->count && k < a->count && a->item[k].i == b->item[k].i && a->item[k].j == b->item[k].j &&
         a->item[k].status == b->item[k].status)
    k++;
  return k == a->count;
}

/* The history given, or one of a single stage. */
static dyd_status scene_find_history(dyd_html_scene *s, dyd_error *err) {
  dyd_pair_list pairs = {s->r->pairs.count, NULL};
  s->history = s->r->history;
  if (s->history && same_pairs(&s->history->last, &s->r->pairs)) return DYD_OK;
  if (s->history) return dyd_fail(err, DYD_E_ARG, "the history does not end with the pairs of this result");
  pairs.item = dyd_alloc(pairs.count, sizeof *pairs.item);
  if (!pairs.item) return DYD_E_NOMEM;
  if (pairs.count) memcpy(pairs.item, s->r->pairs.item, pairs.count * sizeof *pairs.item);
  dyd_status st = dyd_history_new(&s->own);
  if (st == DYD_OK) st = dyd_history_add(s->own, s->r->pd, &pairs);
  s->history = s->own;
  dyd_pair_list_clear(&pairs);
  return st;
}

dyd_status dyd_html_scene_init(dyd_html_scene *s, FILE *out, const dyd_result *r, dyd_error *err) {
  double box[4];
  *s = (dyd_html_scene){.out = out, .r = r};
  if (r->window) dyd_rect_get_d(s->window, r->window);
  dyd_status st = scene_find_history(s, err);
  for (size_t i = 0; i < r->count && st == DYD_OK; i++) st = dyd_result_box(box, r, i, err);
  if (st == DYD_OK) st = scene_check_size(s, err);
  if (st != DYD_OK) return st;
  s->number = dyd_alloc(r->count, sizeof *s->number);
  if (!s->number) return DYD_E_NOMEM;
  scene_number_points(s);
  return DYD_OK;
}

void dyd_html_scene_clear(dyd_html_scene *s) {
  dyd_history_free(s->own);
  free(s->number);
}

/* ---- head ---- */

dyd_status dyd_html_scene_head(const dyd_html_scene *s, const char *kind, const char *layer) {
  const dyd_result *r = s->r;
  FILE *out = s->out;
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, r->engine);
  dyd_json_head(out, "dyadel html 1");
  dyd_json_crs(out, r->epsg);
  fprintf(out,
          "\"kind\": \"%s\", \"layer\": \"%s\", \"outcome\": \"%s\", \"goal\": \"%s\", \"goal_bits\": %" PRId64
          ", \"capped\": %s, \"discs\": %s,\n\"sites\": %zu, \"window\": ",
          kind, layer, dyd_outcome_text(dyd_engine_outcome(r->engine)), dyd_goal_text(goal), bits,
          dyd_delaunay_is_capped(r->pd) ? "true" : "false", r->discs ? "true" : "false", r->count);
  dyd_status st = DYD_OK;
  fputs(r->window ? "[" : "null", out);
  if (r->window) st = dyd_put_window(out, r->window, "\"", ", ");
  fputs(r->window ? "],\n" : ",\n", out);
  return st;
}

/* ---- points ---- */

static dyd_status html_point(const dyd_html_scene *s, uint32_t i, const dyd_site_row *row) {
  const double *radius = s->r->tolerance ? dyd_tolerance_points(s->r->tolerance) : NULL;
  dyd_rect rect;
  dyd_rect_init(&rect);
  dyd_status st = dyd_sites_get(&rect, s->r->sites, i);
  fprintf(s->out, "%s{\"i\": %zu, ", s->number[i] ? ",\n" : "\n", dyd_engine_row(s->r->engine, i));
  if (st == DYD_OK) st = dyd_json_sides(s->out, &rect, ", ");
  dyd_json_ids(s->out, s->r->engine, &i, 0);
  fprintf(s->out, ", \"hull\": \"%s\"", row->hull);
  if (radius) {
    char text[DYD_DECIMAL_SIZE] = "null"; /* no motion changes anything */
    if (isfinite(radius[i])) dyd_decimal_directed(text, radius[i], 6, DYD_DOWN);
    fprintf(s->out, ", \"rho\": %s", text);
  }
  fputs("}", s->out);
  dyd_rect_clear(&rect);
  return st;
}

static dyd_status html_points(const dyd_html_scene *s) {
  dyd_site_row *rows = NULL;
  dyd_status st = dyd_result_sites(&rows, s->r);
  fputs("\"points\": [", s->out);
  for (uint32_t i = 0; i < s->r->count && st == DYD_OK; i++)
    if (s->number[i] != DYD_HTML_NOT_SHOWN) st = html_point(s, i, &rows[i]);
  fputs("],\n", s->out);
  free(rows);
  dyd_json_aliases(s->out, s->r->engine, ",\n");
  return st;
}

/* With all its sides: the page tells by them from which stage on a triangle is sure. */
static bool scene_sees_triangle(const dyd_html_scene *s, const uint32_t v[3]) {
  bool seen = true;
  for (int c = 0; seen && c < 3; c++) seen = scene_sees_pair(s, &(dyd_pair){v[c], v[(c + 1) % 3], DYD_LEGAL});
  return seen;
}

static dyd_status html_triangles(const dyd_html_scene *s) {
  dyd_triangle_list list = {0};
  dyd_status st = dyd_delaunay_triangles(&list, s->r->pd);
  uint32_t before = 0;
  const char *between = "";
  fputs("\"triangles\": [", s->out);
  for (size_t k = 0; k < list.count; k++) {
    const uint32_t *v = list.item[k].v, n[3] = {s->number[v[0]], s->number[v[1]], s->number[v[2]]};
    if (!scene_sees_triangle(s, v)) continue;
    fprintf(s->out, "%s%" PRIu32 ",%" PRIu32 ",%" PRIu32, between, n[0] - before, n[1] - n[0], n[2] - n[0]);
    before = n[0];
    between = ",";
  }
  fputs("],\n", s->out);
  dyd_triangle_list_clear(&list);
  return st;
}

/* ---- stages ---- */

static void html_changes(const dyd_html_scene *s, size_t stage, dyd_pair_status status) {
  const dyd_history *h = s->history;
  uint32_t before = 0;
  const char *between = "";
  fprintf(s->out, "\"%s\": [", dyd_pair_status_text(status));
  for (size_t k = h->change_begin[stage]; k < dyd_history_changes_end(h, stage); k++) {
    const dyd_pair *p = &h->change[k];
    if (p->status != status || !scene_sees_pair(s, p)) continue;
    fprintf(s->out, "%s%" PRIu32 ",%" PRIu32, between, s->number[p->i] - before, s->number[p->j] - s->number[p->i]);
    before = s->number[p->i];
    between = ",";
  }
  fputs("], ", s->out);
}

/* Is box number k of the history the one that its site has in the end? */
static bool is_last_box(const dyd_html_scene *s, size_t k) {
  const dyd_history_box *b = &s->history->box[k];
  double now[4];
  dyd_sites_get_d(now, s->r->sites, b->site);
  return s->history->last_box[b->site] == k && memcmp(now, b->box, sizeof now) == 0;
}

/* The boxes of a stage: those of points that are narrower in the end, rounded outward; else the point alone, but for
 * the first stage, where that goes without saying. */
static void html_boxes(const dyd_html_scene *s, size_t stage, bool last) {
  const dyd_history *h = s->history;
  const char *between = "";
  fprintf(s->out, "\"%s\": [", last ? "final" : "boxes");
  for (size_t k = h->box_begin[stage]; k < dyd_history_boxes_end(h, stage); k++) {
    uint32_t n = s->number[h->box[k].site];
    if (n == DYD_HTML_NOT_SHOWN || is_last_box(s, k) != last || (last && stage == 0)) continue;
    fprintf(s->out, "%s%" PRIu32, between, n);
    for (int e = 0; e < 4 && !last; e++) {
      fputc(',', s->out);
      dyd_decimal_put(s->out, h->box[k].box[e], e & 1 ? DYD_UP : DYD_DOWN, "null");
    }
    between = ",";
  }
  fputs("]", s->out);
}

dyd_status dyd_html_scene_body(const dyd_html_scene *s) {
  dyd_status st = html_points(s);
  if (st == DYD_OK) st = html_triangles(s);
  fputs("\"stages\": [", s->out);
  for (size_t k = 0; k < s->history->stages; k++) {
    fputs(k ? ",\n{" : "\n{", s->out);
    for (int status = DYD_ILLEGAL; status <= DYD_LEGAL; status++) html_changes(s, k, (dyd_pair_status)status);
    html_boxes(s, k, false);
    fputs(", ", s->out);
    html_boxes(s, k, true);
    fputs("}", s->out);
  }
  fputs("\n]", s->out);
  return st;
}
