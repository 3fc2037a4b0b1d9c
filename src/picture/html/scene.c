/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What all pages tell of points, pairs and triangles, as JSON. */
#include "picture/html/scene.h"

#include "base/alloc.h"
#include "base/error.h"
#include "io/json.h"
#include "picture/html/list.h"
#include "picture/picture.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Pairs; and changes of statuses, all stages together. A page that holds more is no longer moved with ease. */
enum { MOST_PAIRS = 300000, MOST_CHANGES = 4 * MOST_PAIRS };

#define NOT_SHOWN UINT32_MAX

/* All borrowed but number and own. */
typedef struct html_scene {
  FILE *out; /* JSON */
  const dyd_result *r;
  const dyd_history *history;
  dyd_history *own; /* one stage, where there is no history */
  double window[4]; /* counts where r has a window */
  uint32_t *number; /* of sites on the page */
  size_t points;    /* on the page */
} html_scene;

/* ---- what is shown ---- */

static void scene_middle(double z[2], const html_scene *s, uint32_t i) {
  double b[4];
  dyd_sites_get_d(b, s->r->sites, i);
  for (int axis = 0; axis < 2; axis++) z[axis] = b[2 * axis] / 2 + b[2 * axis + 1] / 2;
}

/* Does the line of the pair meet the window? As pictures count it. */
static bool scene_sees_pair(const html_scene *s, const dyd_pair *p) {
  double z[2][2];
  if (!s->r->window) return true;
  scene_middle(z[0], s, p->i);
  scene_middle(z[1], s, p->j);
  return dyd_clip_segment(z, s->window);
}

static bool scene_sees_site(const html_scene *s, uint32_t i) {
  double b[4];
  const double *w = s->window;
  if (!s->r->window) return true;
  dyd_sites_get_d(b, s->r->sites, i);
  return b[0] <= w[1] && w[0] <= b[1] && b[2] <= w[3] && w[2] <= b[3];
}

/* Points in the window, and the ends of lines across it. */
static void scene_number_points(html_scene *s) {
  const dyd_history *h = s->history;
  for (uint32_t i = 0; i < s->r->count; i++) s->number[i] = scene_sees_site(s, i) ? 0 : NOT_SHOWN;
  for (size_t k = 0; s->r->window && k < h->changes; k++)
    if (scene_sees_pair(s, &h->change[k])) s->number[h->change[k].i] = s->number[h->change[k].j] = 0;
  for (uint32_t i = 0; i < s->r->count; i++) {
    if (dyd_delaunay_alias(s->r->pd, i) != i) s->number[i] = NOT_SHOWN;
    if (s->number[i] != NOT_SHOWN) s->number[i] = (uint32_t)s->points++;
  }
}

static size_t count_seen(const html_scene *s, const dyd_pair *pair, size_t count) {
  size_t seen = 0;
  for (size_t k = 0; k < count; k++) seen += scene_sees_pair(s, &pair[k]);
  return seen;
}

dyd_status dyd_html_check_pairs(size_t pairs, const char *where, const char *advice, dyd_error *err) {
  if (pairs <= MOST_PAIRS) return DYD_OK;
  return dyd_fail(err, DYD_E_RANGE, "html shows at most %d pairs, and there are %zu%s; give %s%sanother format",
                  MOST_PAIRS, pairs, where, advice, *advice ? ", or " : "");
}

static dyd_status scene_check_size(const html_scene *s, dyd_error *err) {
  const dyd_history *h = s->history;
  size_t pairs = count_seen(s, h->last.item, h->last.count), changes = count_seen(s, h->change, h->changes);
  const char *where = s->r->window ? " in this window" : "",
             *advice = s->r->window ? "a smaller `window`" : "a part of the plane, `window` XLO,XHI,YLO,YHI";
  dyd_status st = dyd_html_check_pairs(pairs, where, advice, err);
  if (st != DYD_OK || changes <= MOST_CHANGES) return st;
  return dyd_fail(err, DYD_E_RANGE,
                  "html shows at most %d changes of pairs, and the stages have %zu%s; raise `start_bits`, or give %s",
                  MOST_CHANGES, changes, where, advice);
}

static bool same_pairs(const dyd_pair_list *a, const dyd_pair_list *b) {
  size_t k = 0;
  while (a->count == b->count && k < a->count && a->item[k].i == b->item[k].i && a->item[k].j == b->item[k].j &&
         a->item[k].status == b->item[k].status)
    k++;
  return k == a->count;
}

/* The history given, or one of a single stage. */
static dyd_status scene_find_history(html_scene *s, dyd_error *err) {
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

static dyd_status html_scene_init(html_scene *s, FILE *out, const dyd_result *r, dyd_error *err) {
  double box[4];
  *s = (html_scene){.out = out, .r = r};
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

static void html_scene_clear(html_scene *s) {
  dyd_history_free(s->own);
  free(s->number);
}

/* ---- head ---- */

/* By the names that commands have for them; of graphs the pairs. */
static const char *layer_name(dyd_content content) {
  static const char *const name[DYD_CONTENTS] = {
      [DYD_CONTENT_POINTS] = "points",        [DYD_CONTENT_TRIANGLES] = "triangles",
      [DYD_CONTENT_VORONOI] = "cells",        [DYD_CONTENT_VERTICES] = "vertices",
      [DYD_CONTENT_REGIONS] = "regions",      [DYD_CONTENT_EDGES] = "edges",
      [DYD_CONTENT_SPHERE_POINTS] = "points", [DYD_CONTENT_SPHERE_TRIANGLES] = "triangles"};
  return name[content] ? name[content] : "pairs";
}

dyd_status dyd_html_head(FILE *out, const dyd_result *r, const char *kind, dyd_content content) {
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, r->engine);
  dyd_json j;
  dyd_json_begin(&j, out);
  dyd_json_head(&j, "dyadel html 1", r->epsg);
  dyd_json_end(&j, ",\n");
  fprintf(out,
          "\"kind\": \"%s\", \"layer\": \"%s\", \"outcome\": \"%s\", \"goal\": \"%s\", \"goal_bits\": %" PRId64
          ", \"capped\": %s, \"discs\": %s,\n\"sites\": %zu, \"window\": ",
          kind, layer_name(content), dyd_outcome_text(dyd_engine_outcome(r->engine)), dyd_goal_text(goal), bits,
          dyd_delaunay_is_capped(r->pd) ? "true" : "false", r->discs ? "true" : "false", r->count);
  dyd_json_begin(&j, out);
  dyd_json_window(&j, NULL, r->window, ", ");
  if (r->graph_name) dyd_json_break(&j, ",\n");
  if (r->graph_name) dyd_json_word(&j, "graph", r->graph_name);
  return dyd_json_end(&j, ",\n");
}

/* ---- points ---- */

static dyd_status html_point(const html_scene *s, uint32_t i, const dyd_site_row *row) {
  const double *radius = s->r->tolerance ? dyd_tolerance_points(s->r->tolerance) : NULL;
  dyd_rect rect;
  dyd_json j;
  dyd_rect_init(&rect);
  dyd_json_begin(&j, s->out);
  dyd_json_break(&j, s->number[i] ? ",\n" : "\n");
  dyd_json_object(&j, NULL, DYD_JSON_FLAT);
  dyd_json_site(&j, "i", s->r->engine, i);
  if (dyd_json_good(&j, dyd_sites_get(&rect, s->r->sites, i))) dyd_json_sides(&j, &rect);
  dyd_json_ids(&j, s->r->engine, &i, 0);
  dyd_json_word(&j, "hull", row->hull);
  if (radius) {
    char text[DYD_DECIMAL_SIZE] = "null"; /* no motion changes anything */
    if (isfinite(radius[i])) dyd_decimal_directed(text, radius[i], 6, DYD_DOWN);
    dyd_json_raw(&j, "rho", text);
  }
  dyd_rect_clear(&rect);
  return dyd_json_end(&j, "}");
}

static dyd_status html_points(const html_scene *s) {
  dyd_site_row *rows = NULL;
  dyd_json j;
  dyd_status st = dyd_result_sites(&rows, s->r);
  fputs("\"points\": [", s->out);
  for (uint32_t i = 0; i < s->r->count && st == DYD_OK; i++)
    if (s->number[i] != NOT_SHOWN) st = html_point(s, i, &rows[i]);
  fputs("],\n", s->out);
  free(rows);
  dyd_json_begin(&j, s->out);
  dyd_json_aliases(&j, s->r->engine, NULL);
  dyd_json_end(&j, ",\n");
  return st;
}

/* With all its sides: the page tells by them from which stage on a triangle is sure. */
static bool scene_sees_triangle(const html_scene *s, const uint32_t v[3]) {
  bool seen = true;
  for (int c = 0; seen && c < 3; c++) seen = scene_sees_pair(s, &(dyd_pair){v[c], v[(c + 1) % 3], DYD_LEGAL});
  return seen;
}

/* Beside a graph there are none. */
static dyd_status html_triangles(const html_scene *s) {
  dyd_triangle_list list = {0};
  dyd_html_list l;
  dyd_status st = s->r->graph_name ? DYD_OK : dyd_delaunay_triangles(&list, s->r->pd);
  dyd_html_list_begin(&l, s->out, "triangles");
  for (size_t k = 0; k < list.count; k++) {
    const uint32_t *v = list.item[k].v;
    if (scene_sees_triangle(s, v))
      dyd_html_list_put(&l, (uint32_t[]){s->number[v[0]], s->number[v[1]], s->number[v[2]]}, 3);
  }
  dyd_html_list_end(&l);
  fputs(",\n", s->out);
  dyd_triangle_list_clear(&list);
  return st;
}

/* ---- stages ---- */

static void html_changes(const html_scene *s, size_t stage, dyd_pair_status status) {
  const dyd_history *h = s->history;
  dyd_html_list l;
  dyd_html_list_begin(&l, s->out, dyd_pair_status_text(status));
  for (size_t k = h->change_begin[stage]; k < dyd_history_changes_end(h, stage); k++) {
    const dyd_pair *p = &h->change[k];
    if (p->status == status && scene_sees_pair(s, p))
      dyd_html_list_put(&l, (uint32_t[]){s->number[p->i], s->number[p->j]}, 2);
  }
  dyd_html_list_end(&l);
  fputs(", ", s->out);
}

/* Is box number k of the history the one that its site has in the end? */
static bool is_last_box(const html_scene *s, size_t k) {
  const dyd_history_box *b = &s->history->box[k];
  double now[4];
  dyd_sites_get_d(now, s->r->sites, b->site);
  return s->history->last_box[b->site] == k && memcmp(now, b->box, sizeof now) == 0;
}

/* The boxes of a stage: those of points that are narrower in the end, rounded outward; else the point alone, but for
 * the first stage, where that goes without saying. */
static void html_boxes(const html_scene *s, size_t stage, bool last) {
  const dyd_history *h = s->history;
  const char *between = "";
  fprintf(s->out, "\"%s\": [", last ? "final" : "boxes");
  for (size_t k = h->box_begin[stage]; k < dyd_history_boxes_end(h, stage); k++) {
    uint32_t n = s->number[h->box[k].site];
    if (n == NOT_SHOWN || is_last_box(s, k) != last || (last && stage == 0)) continue;
    fprintf(s->out, "%s%" PRIu32, between, n);
    for (int e = 0; e < 4 && !last; e++) {
      fputc(',', s->out);
      dyd_decimal_put(s->out, h->box[k].box[e], e & 1 ? DYD_UP : DYD_DOWN, "null");
    }
    between = ",";
  }
  fputs("]", s->out);
}

static dyd_status html_body(const html_scene *s) {
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

/* ---- the object ---- */

dyd_status dyd_html_scene_write(const dyd_output *o, FILE *out, const dyd_result *r, const char *kind,
                                dyd_html_own_fn own, const void *user) {
  html_scene s;
  dyd_status st = html_scene_init(&s, out, r, o->err);
  if (st == DYD_OK) st = dyd_html_head(out, r, kind, o->content);
  if (st == DYD_OK) st = own(out, user);
  if (st == DYD_OK) st = html_body(&s);
  fputs("}\n", out);
  html_scene_clear(&s);
  return st;
}
