/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The html format: a page in one file, moved with the hand. Drawings are rounded, texts are not.
 *
 * The page itself is the same for all; its data are one JSON object, packed by zlib, as base64. The page is made of the
 * texts in page/ when the library is built (pack.py); its Content-Security-Policy allows the script and style in it, by
 * their digests, and nothing else: no request can leave it.
 *
 * Data hold points, pairs stage by stage and triangles, of everything or of a window. Pages of a sphere show degrees as
 * a map, and the final result. Pages of a diagram have cells as polygons, vertices, regions and edges in
 * addition. Polygons are drawn, so their vertices are rounded to multiples of a unit 2^u, from the lower left corner of
 * the window on: at most a quarter of what the polygons themselves are off their cells, or 2^-44 of the window. The
 * page tells. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#define ZLIB_CONST              /* packed data are read only */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/record.h"
#include "io/diagram.h"
#include "io/json.h"
#include "io/output.h"
#include "picture/picture.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* ---- the file ---- */

/* Made by pack.py. */
extern const unsigned char dyd_html_before[], dyd_html_after[];
extern const size_t dyd_html_before_size, dyd_html_after_size;

enum { GROUPS = 1 << 12, BLOCK = 3 * GROUPS }; /* of three bytes */

/* A line of base64 (RFC 4648). */
static void put_base64(FILE *out, const unsigned char *p, size_t size) {
  static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  char line[4 * GROUPS + 1], *to = line;
  for (size_t k = 0; k < size; k += 3) {
    unsigned a = p[k], b = k + 1 < size ? p[k + 1] : 0, c = k + 2 < size ? p[k + 2] : 0, word = a << 16 | b << 8 | c;
    *to++ = digit[word >> 18];
    *to++ = digit[word >> 12 & 63];
    *to++ = k + 1 < size ? digit[word >> 6 & 63] : '=';
    *to++ = k + 2 < size ? digit[word & 63] : '=';
  }
  *to++ = '\n';
  fwrite(line, 1, (size_t)(to - line), out);
}

/* The text is given to zlib in pieces that its counters hold. */
static dyd_status put_packed(FILE *out, const char *text, size_t size) {
  enum { PIECE = 1 << 20 };
  unsigned char block[BLOCK];
  z_stream z = {.next_out = block, .avail_out = BLOCK};
  if (deflateInit(&z, Z_BEST_COMPRESSION) != Z_OK) return DYD_E_NOMEM;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    if (z.avail_in == 0 && size) {
      z.next_in = (const unsigned char *)text;
      z.avail_in = size < PIECE ? (uInt)size : PIECE;
      text += z.avail_in;
      size -= z.avail_in;
    }
    state = deflate(&z, size || z.avail_in ? Z_NO_FLUSH : Z_FINISH);
    if (z.avail_out && state != Z_STREAM_END) continue;
    put_base64(out, block, BLOCK - z.avail_out);
    z.next_out = block;
    z.avail_out = BLOCK;
  }
  deflateEnd(&z);
  return DYD_OK;
}

/* ---- lists ---- */

/* A list of points by their numbers on the page, as differences, which pack well: of pairs (i, j), sorted, i less that
 * of the pair before, and j - i; of triangles the same of their first corners, and the others less these. */
typedef struct html_list {
  dyd_json *j;
  uint32_t before; /* the first number of the last thing */
} html_list;

static html_list html_list_begin(dyd_json *j, const char *name) {
  dyd_json_array(j, name, DYD_JSON_DENSE);
  return (html_list){.j = j};
}

/* A thing of `count` numbers. Modulo 2^32: a page has few enough points to read these as negative. */
static void html_list_put(html_list *l, const uint32_t *number, int count) {
  dyd_json_signed(l->j, NULL, (int32_t)(number[0] - l->before));
  for (int k = 1; k < count; k++) dyd_json_signed(l->j, NULL, (int32_t)(number[k] - number[0]));
  l->before = number[0];
}

/* Pairs; and changes of statuses, all stages together. A page that holds more is no longer moved with ease. */
enum { MOST_PAIRS = 300000, MOST_CHANGES = 4 * MOST_PAIRS };

#define NOT_SHOWN UINT32_MAX

/* Writes members that not every page has. */
typedef dyd_status (*html_own_fn)(dyd_json *j, const dyd_output *o);

/* All borrowed but number and made. Set r and kind, and what differs from the triangulation of a plane. */
typedef struct html_scene {
  dyd_json *j;
  const dyd_result *r;
  const char *kind; /* "delaunay", "voronoi", "converge", "plan" */
  html_own_fn own;
  const dyd_history *history; /* NULL: of a globe, whose pairs are those of r */
  dyd_history *made;          /* one stage, where none was given */
  const dyd_rect *shown;      /* the window; NULL: everything, as of a globe */
  double window[4];           /* counts where there is one */
  uint32_t *number;           /* of sites on the page */
  size_t points;              /* on the page */
} html_scene;

/* ---- the part shown ---- */

static void scene_middle(double z[2], const html_scene *s, uint32_t i) {
  double b[4];
  dyd_sites_get_d(b, s->r->sites, i);
  for (int axis = 0; axis < 2; axis++) z[axis] = b[2 * axis] / 2 + b[2 * axis + 1] / 2;
}

/* Returns true if the line of the pair meets the window. As pictures count it. */
static bool scene_sees_pair(const html_scene *s, const dyd_pair *p) {
  double z[2][2];
  if (!s->shown) return true;
  scene_middle(z[0], s, p->i);
  scene_middle(z[1], s, p->j);
  return dyd_clip_segment(z, s->window);
}

static bool scene_sees_site(const html_scene *s, uint32_t i) {
  double b[4];
  const double *w = s->window;
  if (!s->shown) return true;
  dyd_sites_get_d(b, s->r->sites, i);
  return b[0] <= w[1] && w[0] <= b[1] && b[2] <= w[3] && w[2] <= b[3];
}

/* Points in the window, and the ends of lines across it. */
static void scene_number_points(html_scene *s) {
  const dyd_history *h = s->history;
  for (uint32_t i = 0; i < s->r->count; i++) s->number[i] = scene_sees_site(s, i) ? 0 : NOT_SHOWN;
  for (size_t k = 0; s->shown && k < h->changes; k++)
    if (scene_sees_pair(s, &h->change[k])) s->number[h->change[k].i] = s->number[h->change[k].j] = 0;
  for (uint32_t i = 0; i < s->r->count; i++) {
    if ((s->r->sphere ? dyd_sphere_alias(s->r->sphere, i) : dyd_delaunay_alias(s->r->pd, i)) != i)
      s->number[i] = NOT_SHOWN;
    if (s->number[i] != NOT_SHOWN) s->number[i] = (uint32_t)s->points++;
  }
}

static size_t count_seen(const html_scene *s, const dyd_pair *pair, size_t count) {
  size_t seen = 0;
  for (size_t k = 0; k < count; k++) seen += scene_sees_pair(s, &pair[k]);
  return seen;
}

/* DYD_E_RANGE with advice where a page cannot show so many. */
static dyd_status html_check_pairs(size_t pairs, const char *where, const char *advice, dyd_error *err) {
  if (pairs <= MOST_PAIRS) return DYD_OK;
  return dyd_fail(err, DYD_E_RANGE, "html shows at most %d pairs, and there are %zu%s; give %s%sanother format",
                  MOST_PAIRS, pairs, where, advice, *advice ? ", or " : "");
}

static dyd_status scene_check_size(const html_scene *s, dyd_error *err) {
  const dyd_history *h = s->history;
  if (s->r->sphere) return html_check_pairs(s->r->pairs.count, "", "", err);
  size_t pairs = count_seen(s, h->last.item, h->last.count), changes = count_seen(s, h->change, h->changes);
  const char *where = s->shown ? " in this window" : "",
             *advice = s->shown ? "a smaller `window`" : "a part of the plane, `window` XLO,XHI,YLO,YHI";
  dyd_status st = html_check_pairs(pairs, where, advice, err);
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
  dyd_status st = dyd_history_new(&s->made);
  if (st == DYD_OK) st = dyd_history_add(s->made, s->r->pd, &pairs);
  s->history = s->made;
  dyd_pair_list_clear(&pairs);
  return st;
}

static dyd_status html_scene_init(html_scene *s, dyd_error *err) {
  double box[4];
  s->shown = s->r->sphere ? NULL : s->r->window;
  if (s->shown) dyd_rect_get_d(s->window, s->shown);
  dyd_status st = s->r->sphere ? DYD_OK : scene_find_history(s, err);
  for (size_t i = 0; i < s->r->count && !s->r->sphere && st == DYD_OK; i++) st = dyd_result_box(box, s->r, i, err);
  if (st == DYD_OK) st = scene_check_size(s, err);
  if (st != DYD_OK) return st;
  s->number = dyd_alloc(s->r->count, sizeof *s->number);
  if (!s->number) return DYD_E_NOMEM;
  scene_number_points(s);
  return DYD_OK;
}

/* ---- head ---- */

/* By the names that commands have for them; of graphs the pairs. */
static const char *layer_name(dyd_content content) {
  static const char *const name[DYD_CONTENTS] = {[DYD_CONTENT_POINTS] = "points",
                                                 [DYD_CONTENT_TRIANGLES] = "triangles",
                                                 [DYD_CONTENT_VORONOI] = "cells",
                                                 [DYD_CONTENT_VERTICES] = "vertices",
                                                 [DYD_CONTENT_REGIONS] = "regions",
                                                 [DYD_CONTENT_EDGES] = "edges",
                                                 [DYD_CONTENT_TILES] = "tiles",
                                                 [DYD_CONTENT_SPHERE_POINTS] = "points",
                                                 [DYD_CONTENT_SPHERE_TRIANGLES] = "triangles"};
  return name[content] ? name[content] : "pairs";
}

/* A member in the line of the one before. */
static const char *on_line(dyd_json *j, const char *name) {
  dyd_json_break(j, ", ");
  return name;
}

/* The opening of the object; o->content is the layer that is shown first. */
static void html_head(const html_scene *s, const dyd_output *o) {
  dyd_json *j = s->j;
  const dyd_result *r = s->r;
  const dyd_engine *e = r->sphere ? dyd_sphere_images(r->sphere) : r->engine;
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, e);
  dyd_json_head(j, "dyadel html 1", o);
  if (o->name) dyd_json_text(j, "name", o->name);
  if (dyd_unit_of(r->epsg)) dyd_json_word(j, "length_unit", dyd_unit_of(r->epsg));
  dyd_json_confidence(j, r->engine);
  dyd_json_word(j, "kind", s->kind);
  dyd_json_word(j, on_line(j, "layer"), layer_name(o->content));
  dyd_json_word(j, on_line(j, "outcome"), dyd_outcome_text(dyd_engine_outcome(e)));
  dyd_json_word(j, on_line(j, "goal"), dyd_goal_text(goal));
  dyd_json_signed(j, on_line(j, "goal_bits"), bits);
  dyd_json_bool(j, on_line(j, "capped"), dyd_delaunay_is_capped(r->pd));
  dyd_json_bool(j, on_line(j, "discs"), r->discs);
  dyd_json_index(j, "sites", r->count);
  dyd_json_window(j, on_line(j, "window"), s->shown, ", ");
  if (r->graph_name) dyd_json_word(j, "graph", r->graph_name);
}

/* ---- points ---- */

/* row: NULL on a globe, where no point is on the hull. */
static void html_point(const html_scene *s, uint32_t i, const dyd_site_row *row) {
  const double *radius = s->r->tolerance ? dyd_tolerance_get(s->r->tolerance)->points : NULL;
  dyd_json *j = s->j;
  DYD_LOCAL(dyd_rect, rect);
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_site(j, "i", s->r->engine, i);
  if (dyd_json_good(j, s->r->sphere ? dyd_sphere_rect(&rect, s->r->sphere, i) : dyd_sites_get(&rect, s->r->sites, i)))
    dyd_json_sides(j, &rect);
  dyd_json_ids(j, s->r->engine, &i, 0);
  if (row) dyd_json_word(j, "hull", row->hull);
  if (radius) {
    char text[DYD_DECIMAL_SIZE] = "null"; /* no motion changes anything */
    if (isfinite(radius[i])) dyd_decimal_directed(text, radius[i], 6, DYD_DOWN);
    dyd_json_raw(j, "rho", text);
  }
  dyd_json_close(j, 1);
}

static dyd_status html_points(const html_scene *s) {
  DYD_FREED dyd_site_row *rows = NULL;
  dyd_status st = s->r->sphere ? DYD_OK : dyd_result_sites(&rows, s->r);
  dyd_json_array(s->j, "points", DYD_JSON_ROWS);
  for (uint32_t i = 0; i < s->r->count && st == DYD_OK && s->j->st == DYD_OK; i++)
    if (s->number[i] != NOT_SHOWN) html_point(s, i, rows ? &rows[i] : NULL);
  dyd_json_close(s->j, 1);
  dyd_json_aliases(s->j, s->r->engine, s->r->sphere);
  return st;
}

/* With all its sides: from them the page finds the stage from which a triangle is certain. */
static bool scene_sees_triangle(const html_scene *s, const uint32_t v[3]) {
  bool seen = true;
  for (int c = 0; seen && c < 3; c++) seen = scene_sees_pair(s, &(dyd_pair){v[c], v[(c + 1) % 3], DYD_LEGAL});
  return seen;
}

/* Beside a graph there are none. */
static dyd_status html_triangles(const html_scene *s) {
  DYD_SCOPED(dyd_triangle_list) list = {0};
  dyd_status st = s->r->graph_name ? DYD_OK : dyd_result_triangles(&list, s->r);
  html_list l = html_list_begin(s->j, "triangles");
  for (size_t k = 0; k < list.count; k++) {
    const uint32_t *v = list.item[k].v;
    if (scene_sees_triangle(s, v))
      html_list_put(&l, (uint32_t[]){s->number[v[0]], s->number[v[1]], s->number[v[2]]}, 3);
  }
  dyd_json_close(s->j, 1);
  return st;
}

/* ---- stages ---- */

static void html_changes(const html_scene *s, size_t stage, dyd_pair_status status) {
  const dyd_history *h = s->history;
  const dyd_pair *pair = h ? h->change : s->r->pairs.item;
  size_t end = h ? dyd_history_changes_end(h, stage) : s->r->pairs.count;
  html_list l = html_list_begin(s->j, dyd_pair_status_text(status));
  for (const dyd_pair *p = pair + (h ? h->change_begin[stage] : 0); p < pair + end; p++)
    if (p->status == status && scene_sees_pair(s, p))
      html_list_put(&l, (uint32_t[]){s->number[p->i], s->number[p->j]}, 2);
  dyd_json_close(s->j, 1);
}

/* Returns true if box number k of the history is the one that its site has in the end. */
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
  dyd_json_array(s->j, last ? "final" : "boxes", DYD_JSON_DENSE);
  for (size_t k = h ? h->box_begin[stage] : 0; h && k < dyd_history_boxes_end(h, stage); k++) {
    uint32_t n = s->number[h->box[k].site];
    if (n == NOT_SHOWN || is_last_box(s, k) != last || (last && stage == 0)) continue;
    dyd_json_index(s->j, NULL, n);
    for (int e = 0; e < 4 && !last; e++) dyd_json_decimal(s->j, NULL, h->box[k].box[e], e & 1 ? DYD_UP : DYD_DOWN);
  }
  dyd_json_close(s->j, 1);
}

static dyd_status html_body(const html_scene *s) {
  dyd_status st = html_points(s);
  if (st == DYD_OK) st = html_triangles(s);
  dyd_json_array(s->j, "stages", DYD_JSON_LIST);
  for (size_t k = 0; k < (s->history ? s->history->stages : 1); k++) {
    dyd_json_object(s->j, NULL, DYD_JSON_FLAT);
    for (int status = DYD_ILLEGAL; status <= DYD_LEGAL; status++) html_changes(s, k, (dyd_pair_status)status);
    html_boxes(s, k, false);
    html_boxes(s, k, true);
    dyd_json_close(s->j, 1);
  }
  dyd_json_close(s->j, 1);
  return st;
}

/* The object of a page: its head, its own members, then "points", "aliases", "triangles", "stages". */
static dyd_status html_scene_write(html_scene *s, FILE *out, const dyd_output *o) {
  dyd_json j;
  dyd_json_begin(&j, out);
  s->j = &j;
  dyd_status st = html_scene_init(s, o->err);
  if (st == DYD_OK) {
    html_head(s, o);
    st = s->own(&j, o);
  }
  if (st == DYD_OK) st = html_body(s);
  dyd_json_good(&j, st);
  dyd_history_free(s->made);
  free(s->number);
  return dyd_json_end(&j, "}\n");
}

/* A page of r, with what `own` writes. */
static dyd_status html_write(const dyd_output *o, const dyd_result *r, const char *kind, html_own_fn own) {
  DYD_FREED char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  if (!to) return DYD_E_NOMEM;
  dyd_status st = html_scene_write(&(html_scene){.r = r, .kind = kind, .own = own}, to, o);
  if ((fclose(to) != 0 || !text) && st == DYD_OK) st = DYD_E_NOMEM;
  if (st != DYD_OK) return st;
  fwrite(dyd_html_before, 1, dyd_html_before_size, o->out);
  st = put_packed(o->out, text, size);
  fwrite(dyd_html_after, 1, dyd_html_after_size, o->out);
  return st;
}

/* ---- runs, triangulations, graphs ---- */

/* The table of convergence, as json has it; the page shows its row next to the triangulation. */
static dyd_status html_table(dyd_json *j, const dyd_output *o) {
  dyd_output table = *o;
  table.out = dyd_json_file(j, "convergence");
  table.format = DYD_FORMAT_JSON;
  return dyd_convergence_json(&table);
}

static dyd_status html_convergence(const dyd_output *o) {
  const dyd_stage_table *t = o->what;
  if (t->result->history->stages != t->stages->count)
    return dyd_fail(o->err, DYD_E_ARG, "the history has other stages than the table has rows");
  return html_write(o, t->result, "converge", html_table);
}

/* Which surface; up to which motion of all points nothing changes at all. */
static dyd_status html_whole(dyd_json *j, const dyd_output *o) {
  const dyd_result *r = o->what;
  if (r->sphere) dyd_json_word(j, "surface", "sphere");
  if (r->tolerance)
    dyd_json_decimals(j, "tolerance", dyd_tolerance_get(r->tolerance)->lo, dyd_tolerance_get(r->tolerance)->hi);
  return DYD_OK;
}

/* Its points, in order: row, half-widths now and needed, pairs decided and left; and which rank decides each pair. */
static dyd_status html_plan(dyd_json *j, const dyd_output *o) {
  const dyd_result *r = o->what;
  const dyd_survey_row *row;
  const dyd_survey_pair *pair;
  const size_t rows = dyd_survey_rows(&row, r->survey), pairs = dyd_survey_pairs(&pair, r->survey);
  char text[DYD_DECIMAL_SIZE];
  double error;
  dyd_json_object(j, "plan", DYD_JSON_FLAT);
  dyd_json_array(j, "points", DYD_JSON_DENSE);
  for (size_t k = 0; k < rows; k++) {
    dyd_json_array(j, NULL, DYD_JSON_DENSE);
    dyd_json_site(j, NULL, r->engine, row[k].site);
    dyd_json_decimal(j, NULL, row[k].now, DYD_UP);
    dyd_decimal_within(text, &error, row[k].needed, row[k].needed);
    dyd_json_raw(j, NULL, text);
    dyd_json_index(j, NULL, row[k].decided);
    dyd_json_index(j, NULL, row[k].left);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
  dyd_json_array(j, "pairs", DYD_JSON_DENSE);
  for (size_t k = 0; k < pairs; k++) {
    dyd_json_array(j, NULL, DYD_JSON_DENSE);
    dyd_json_site(j, NULL, r->engine, pair[k].i);
    dyd_json_site(j, NULL, r->engine, pair[k].j);
    dyd_json_index(j, NULL, pair[k].row == SIZE_MAX ? 0 : pair[k].row + 1);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
  dyd_json_bool(j, "finished", !dyd_survey_get(r->survey)->cut);
  dyd_json_close(j, 1);
  return html_whole(j, o);
}

static dyd_status html_plan_of(const dyd_output *o) {
  return html_write(o, o->what, "plan", html_plan);
}

static dyd_status html_triangulation(const dyd_output *o) {
  return html_write(o, o->what, "delaunay", html_whole);
}

/* ---- diagrams ---- */

/* All borrowed. */
typedef struct html_diagram {
  dyd_json *j;
  const dyd_diagram *d;
  dyd_error *err;
  double origin[2], unit;
} html_diagram;

static int diagram_unit(html_diagram *g) {
  enum { FINER = 2, DIGITS = 44, LEAST = -1000 };
  double w[4];
  dyd_rect_get_d(w, &g->d->window);
  int window = ilogb(fmax(w[1] - w[0], w[3] - w[2])) - DIGITS;
  int64_t wanted = -g->d->bits - FINER;
  int unit = wanted < window ? window : wanted > window + DIGITS ? window + DIGITS : (int)wanted;
  if (unit < LEAST) unit = LEAST;
  g->origin[0] = w[0];
  g->origin[1] = w[2];
  g->unit = ldexp(1, unit);
  return unit;
}

/* The number of units; last is that of the place before, and becomes this one. */
static void put_place(html_diagram *g, double x, double y, int64_t last[2]) {
  int64_t now[2] = {(int64_t)llround((x - g->origin[0]) / g->unit), (int64_t)llround((y - g->origin[1]) / g->unit)};
  for (int axis = 0; axis < 2; axis++) {
    dyd_json_signed(g->j, NULL, now[axis] - last[axis]);
    last[axis] = now[axis];
  }
}

static void put_polygon(html_diagram *g, const char *name, const dyd_polygon *p) {
  int64_t last[2] = {0, 0};
  dyd_json_array(g->j, name, DYD_JSON_DENSE);
  for (size_t k = 0; k < p->count; k++)
    put_place(g, dyd_dyadic_get_d(&p->vertex[k].x, DYD_DOWN), dyd_dyadic_get_d(&p->vertex[k].y, DYD_DOWN), last);
  dyd_json_close(g->j, 1);
}

static dyd_status html_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  html_diagram *g = context;
  DYD_SCOPED(dyd_polygon) inner = {0};
  DYD_SCOPED(dyd_polygon_list) outer = {0};
  dyd_json *j = g->j;
  if (!row->present) return DYD_OK;
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_site(j, "i", g->d->engine, i);
  dyd_json_decimals(j, "area", row->area[0], row->area[1]);
  dyd_json_decimal(j, "undetermined", dyd_cell_undetermined(row), DYD_UP);
  put_polygon(g, "inner", &inner);
  dyd_json_array(j, "outer", DYD_JSON_DENSE);
  for (size_t k = 0; k < outer.count; k++) put_polygon(g, NULL, &outer.item[k]);
  dyd_json_close(j, 2);
  return st;
}

/* A tile is a cell of one choice: all its rings are "outer", and none is certain. */
static dyd_status html_tiles(html_diagram *g) {
  DYD_SCOPED(dyd_tiles) t = {0};
  dyd_json *j = g->j;
  dyd_status st = dyd_diagram_tiles(&t, g->d, false, g->err);
  for (size_t r = 0, end = 0; r < t.count && st == DYD_OK;) {
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_site(j, "i", g->d->engine, t.site[r]);
    dyd_json_decimals(j, "area", t.bound[2 * r], t.bound[2 * r + 1]);
    dyd_json_decimal(j, "tile_area", dyd_diagram_tile(&end, g->d, &t), DYD_UP);
    put_polygon(g, "inner", &(dyd_polygon){0});
    dyd_json_array(j, "outer", DYD_JSON_DENSE);
    for (; r < end; r++) {
      int64_t last[2] = {0, 0};
      dyd_json_array(j, NULL, DYD_JSON_DENSE);
      for (size_t k = t.offset[r]; k < t.offset[r + 1]; k++) put_place(g, t.xy[2 * k], t.xy[2 * k + 1], last);
      dyd_json_close(j, 1);
    }
    dyd_json_close(j, 2);
  }
  return st;
}

static void html_vertices(html_diagram *g) {
  const dyd_diagram *d = g->d;
  dyd_json *j = g->j;
  dyd_json_array(j, "vertices", DYD_JSON_ROWS);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && j->st == DYD_OK; k++) {
    DYD_SCOPED(dyd_index_list) sites = {0};
    if (!dyd_diagram_vertex_in_window(d, k)) continue;
    dyd_json_good(j, dyd_diagram_vertex_sites(&sites, d, k));
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_sites(j, "sites", d->engine, &sites);
    dyd_json_box(j, false, d->vertex[k]);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static dyd_status html_region(void *context, size_t face, const double box[4]) {
  html_diagram *g = context;
  DYD_SCOPED(dyd_index_list) sites = {0};
  bool outer;
  if (!box) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, g->d->pd, face);
  dyd_json_object(g->j, NULL, DYD_JSON_FLAT);
  dyd_json_sites(g->j, "sites", g->d->engine, &sites);
  dyd_json_box(g->j, false, box);
  dyd_json_close(g->j, 1);
  return st;
}

/* Those of which both ends are known, as lines between the middles of these. */
static dyd_status html_edges(html_diagram *g) {
  DYD_FREED dyd_dual_edge *edge = NULL;
  size_t count = 0;
  double box[2][4];
  dyd_status st = dyd_diagram_edges(&edge, &count, g->d);
  dyd_json_array(g->j, "edges", DYD_JSON_DENSE);
  for (size_t k = 0; k < count; k++) {
    int64_t last[2] = {0, 0};
    double z[2][2], w[4];
    if (!dyd_diagram_edge(box, g->d, &edge[k])) continue;
    for (int c = 0; c < 4; c++) z[c >> 1][c & 1] = box[c >> 1][2 * (c & 1)] / 2 + box[c >> 1][2 * (c & 1) + 1] / 2;
    dyd_rect_get_d(w, &g->d->window);
    if (!dyd_clip_segment(z, w)) continue;
    for (int c = 0; c < 2; c++) put_place(g, z[c][0], z[c][1], last);
  }
  dyd_json_close(g->j, 1);
  return st;
}

/* Cells come first, as they give the bounds. */
static dyd_status html_diagram_parts(dyd_json *j, const dyd_output *page) {
  const dyd_diagram *d = page->what;
  html_diagram g = {.j = j, .d = d, .err = page->err};
  dyd_json_signed(j, "unit", diagram_unit(&g));
  dyd_json_array(j, on_line(j, "origin"), DYD_JSON_FLAT);
  for (int axis = 0; axis < 2; axis++) dyd_decimal_put_near(dyd_json_file(j, NULL), g.origin[axis]);
  dyd_json_close(j, 1);
  dyd_json_signed(j, on_line(j, "flatten_bits"), d->bits);
  dyd_json_array(j, "cells", DYD_JSON_ROWS);
  dyd_status st = page->content == DYD_CONTENT_TILES ? html_tiles(&g) : dyd_diagram_visit(d, html_cell, &g);
  dyd_json_close(j, 1);
  dyd_json_bound(j, "undetermined_area", &d->bounds->area);
  dyd_json_bound(j, "distance_to_true_diagram", d->bounds->finite ? &d->bounds->hausdorff : NULL);
  html_vertices(&g);
  dyd_json_array(j, "regions", DYD_JSON_ROWS);
  if (st == DYD_OK) st = dyd_diagram_regions(d, html_region, &g);
  dyd_json_close(j, 1);
  return st == DYD_OK ? html_edges(&g) : st;
}

static dyd_status html_diagram_page(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = d->discs ? DYD_OK : dyd_delaunay_pairs(&pairs, d->pd);
  const dyd_result r = {.engine = d->engine,
                        .pd = d->pd,
                        .sites = d->sites,
                        .count = d->count,
                        .window = &d->window,
                        .epsg = d->epsg,
                        .discs = d->discs,
                        .history = d->discs ? NULL : d->history,
                        .pairs = d->discs ? *d->discs : pairs};
  return st == DYD_OK ? html_write(o, &r, "voronoi", html_diagram_parts) : st;
}

dyd_writer *const dyd_html_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = html_triangulation,      [DYD_CONTENT_PLAN] = html_plan_of,
    [DYD_CONTENT_POINTS] = html_triangulation,        [DYD_CONTENT_TRIANGLES] = html_triangulation,
    [DYD_CONTENT_GRAPH_NEAREST] = html_triangulation, [DYD_CONTENT_GRAPH_GABRIEL] = html_triangulation,
    [DYD_CONTENT_GRAPH_MST] = html_triangulation,     [DYD_CONTENT_CONVERGENCE] = html_convergence,
    [DYD_CONTENT_VORONOI] = html_diagram_page,        [DYD_CONTENT_VERTICES] = html_diagram_page,
    [DYD_CONTENT_REGIONS] = html_diagram_page,        [DYD_CONTENT_TILES] = html_diagram_page,
    [DYD_CONTENT_EDGES] = html_diagram_page,          [DYD_CONTENT_SPHERE] = html_triangulation,
    [DYD_CONTENT_SPHERE_POINTS] = html_triangulation, [DYD_CONTENT_SPHERE_TRIANGLES] = html_triangulation};
