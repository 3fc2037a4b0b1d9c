/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A streaming writer of JSON, and the values that several results are written with. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "io/json.h"

#include "base/local.h"
#include "dyadic/numeral.h"
#include "io/decimal.h"
#include "io/output.h"
#include "voronoi/surd_point.h"
#include <stdlib.h>

const dyd_json_breaks dyd_json_forms[] = {[DYD_JSON_FLAT] = {"", ", ", "", 3},
                                          [DYD_JSON_LINES] = {"", ",\n", "", 3},
                                          [DYD_JSON_LIST] = {"\n", ",\n", "\n", 3},
                                          [DYD_JSON_ROWS] = {"\n", ",\n", "", 3},
                                          [DYD_JSON_DENSE] = {"", ",", "", 2}};

void dyd_json_begin(dyd_json *j, FILE *out) {
  dyd_sink_begin(&j->to, out);
  j->st = DYD_OK;
  j->depth = 0;
  j->level[0].before = "";
  j->level[0].form = &dyd_json_forms[DYD_JSON_FLAT];
}

dyd_status dyd_json_end(dyd_json *j, const char *end) {
  dyd_sink_text(&j->to, end);
  dyd_sink_flush(&j->to);
  return j->st;
}

bool dyd_json_good(dyd_json *j, dyd_status st) {
  if (j->st == DYD_OK) j->st = st;
  return j->st == DYD_OK;
}

FILE *dyd_json_file(dyd_json *j, const char *name) {
  dyd_json_name(j, name);
  dyd_sink_flush(&j->to);
  return j->to.out;
}

void dyd_json_break(dyd_json *j, const char *between) {
  j->level[j->depth].before = between;
}

/* ---- values ---- */

void dyd_json_signed(dyd_json *j, const char *name, int64_t n) {
  dyd_json_name(j, name);
  if (n < 0) dyd_sink_put(&j->to, "-", 1);
  dyd_sink_index(&j->to, n < 0 ? -(uint64_t)n : (uint64_t)n);
}

void dyd_json_text(dyd_json *j, const char *name, const char *text) {
  dyd_json_name(j, name);
  dyd_sink_json_text(&j->to, text);
}

void dyd_json_raw(dyd_json *j, const char *name, const char *text) {
  dyd_json_name(j, name);
  dyd_sink_text(&j->to, text);
}

void dyd_json_bool(dyd_json *j, const char *name, bool b) {
  dyd_json_raw(j, name, b ? "true" : "false");
}

void dyd_json_decimal(dyd_json *j, const char *name, double x, dyd_round dir) {
  dyd_json_name(j, name);
  dyd_sink_decimal(&j->to, x, dir, "null");
}

void dyd_json_decimals(dyd_json *j, const char *name, double lo, double hi) {
  dyd_json_name(j, name);
  dyd_sink_put(&j->to, "[", 1);
  dyd_sink_decimal(&j->to, lo, DYD_DOWN, "null");
  dyd_sink_put(&j->to, ", ", 2);
  dyd_sink_decimal(&j->to, hi, DYD_UP, "null");
  dyd_sink_put(&j->to, "]", 1);
}

void dyd_json_box(dyd_json *j, bool decimal, const double *box) {
  for (int axis = 0; axis < 2; axis++) {
    const char *name = decimal ? axis ? "y_decimal" : "x_decimal" : axis ? "y" : "x";
    if (box)
      dyd_json_decimals(j, name, box[2 * axis], box[2 * axis + 1]);
    else
      dyd_json_raw(j, name, "null");
  }
}

static void json_integer(dyd_json *j, const char *name, mpz_srcptr n) {
  enum { LONG = DYD_SINK_BLOCK / 2 };
  if (mpz_sizeinbase(n, 10) > LONG) {
    gmp_fprintf(dyd_json_file(j, name), "\"%Zd\"", n);
    return;
  }
  dyd_json_name(j, name);
  dyd_sink_put(&j->to, "\"", 1);
  j->to.end += strlen(mpz_get_str(dyd_sink_room(&j->to, LONG + 2), 10, n));
  dyd_sink_put(&j->to, "\"", 1);
}

void dyd_json_rational(dyd_json *j, const char *name, mpq_srcptr q) {
  gmp_fprintf(dyd_json_file(j, name), "\"%Qd\"", q);
}

/* A text that is released; NULL: memory is exhausted. */
static void json_release(dyd_json *j, const char *name, char *text) {
  if (dyd_json_good(j, text ? DYD_OK : DYD_E_NOMEM)) dyd_json_word(j, name, text);
  free(text);
}

void dyd_json_dyadic(dyd_json *j, const char *name, const dyd_dyadic *x) {
  json_release(j, name, dyd_dyadic_get_str(x));
}

void dyd_json_bound(dyd_json *j, const char *name, const dyd_dyadic *value) {
  if (!value) {
    dyd_json_raw(j, name, "null");
    return;
  }
  dyd_json_object(j, name, DYD_JSON_FLAT);
  dyd_json_dyadic(j, "exact", value);
  dyd_json_decimal(j, "decimal", dyd_dyadic_get_d(value, DYD_UP), DYD_UP);
  dyd_json_close(j, 1);
}

void dyd_json_sides(dyd_json *j, const dyd_rect *r) {
  for (int axis = 0; axis < 2; axis++) {
    dyd_json_array(j, axis ? "y" : "x", DYD_JSON_FLAT);
    for (int end = 0; end < 2; end++) json_release(j, NULL, dyd_end_text(axis ? &r->y : &r->x, end));
    dyd_json_close(j, 1);
  }
}

void dyd_json_rect(dyd_json *j, const char *name, const dyd_rect *r) {
  dyd_json_object(j, name, DYD_JSON_FLAT);
  dyd_json_sides(j, r);
  dyd_json_close(j, 1);
}

void dyd_json_window(dyd_json *j, const char *name, const dyd_rect *w, const char *between) {
  if (!w) {
    dyd_json_raw(j, name, "null");
    return;
  }
  dyd_json_array(j, name, DYD_JSON_FLAT);
  dyd_json_good(j, dyd_put_window(dyd_json_file(j, NULL), w, "\"", between));
  dyd_json_close(j, 1);
}

/* ---- results ---- */

void dyd_json_schedule(dyd_json *j, const dyd_engine_options *o) {
  dyd_json_word(j, "schedule", dyd_schedule_text(o->schedule));
  dyd_json_word(j, "goal", dyd_goal_text(o->goal));
  dyd_json_signed(j, "goal_bits", o->goal_bits);
  dyd_json_signed(j, "start_bits", o->start_bits);
  dyd_json_signed(j, "step_bits", o->step_bits);
  dyd_json_signed(j, "max_bits", o->max_bits);
}

void dyd_json_head(dyd_json *j, const char *format, const dyd_output *o) {
  const char *const *word = o->style.command_line;
  dyd_json_object(j, NULL, DYD_JSON_LINES);
  dyd_json_word(j, "format", format);
  dyd_json_word(j, "version", dyd_version());
  if (word) dyd_json_array(j, "command_line", DYD_JSON_FLAT);
  for (const char *const *w = word; w && *w; w++) dyd_json_text(j, NULL, *w);
  if (word) dyd_json_close(j, 1);
  if (o->epsg) fprintf(dyd_json_file(j, "crs"), "\"EPSG:%u\"", o->epsg);
}

void dyd_json_confidence(dyd_json *j, const dyd_engine *e) {
  dyd_confidence c = {DYD_SIZED(dyd_confidence)};
  if (!dyd_engine_confidence(&c, e)) return;
  dyd_json_raw(j, "confidence", c.probability);
  dyd_json_decimal(j, "k", c.k, DYD_UP);
  dyd_json_index(j, "n", c.n);
}

void dyd_json_head_outward(dyd_json *j, const char *format, const dyd_output *o, const dyd_engine *e,
                           dyd_outcome outcome) {
  dyd_json_head(j, format, o);
  dyd_json_word(j, "rounding",
                "texts are exact numbers; pairs of numbers are rounded outward: the first down, the second up");
  dyd_json_word(j, "outcome", dyd_outcome_text(outcome));
  dyd_json_confidence(j, e);
}

void dyd_json_ids(dyd_json *j, const dyd_engine *e, const uint32_t *site, size_t count) {
  static const char *const name[] = {"id_i", "id_j", "id_k"};
  for (size_t k = 0; k < (count ? count : 1) && dyd_engine_id(e, site[k]); k++)
    dyd_json_text(j, count ? name[k] : "id", dyd_engine_id(e, site[k]));
}

bool dyd_json_is_number(const char *s) {
  dyd_numeral n;
  if (!dyd_numeral_scan(&n, s, strlen(s), DYD_NUMBER_JSON)) return false;
  const size_t whole = n.digits - n.fraction;
  const bool pointed = n.mantissa_end - n.first > n.digits;
  return whole > 0 && (whole == 1 || s[n.first] != '0') && (!pointed || n.fraction > 0);
}

void dyd_json_carried(dyd_json *j, const dyd_engine *e, size_t i) {
  const char *name, *text;
  if (!dyd_engine_carried(NULL, e, 0, 0)) return;
  dyd_json_object(j, "carried", DYD_JSON_FLAT);
  for (size_t k = 0; (text = dyd_engine_carried(&name, e, i, k)); k++) {
    dyd_json_text(j, NULL, name); /* may hold quotes */
    dyd_sink_put(&j->to, ": ", 2);
    if (!*text || dyd_json_is_number(text))
      dyd_sink_text(&j->to, *text ? text : "null");
    else
      dyd_sink_json_text(&j->to, text);
  }
  dyd_json_close(j, 1);
}

void dyd_json_sites(dyd_json *j, const char *name, const dyd_engine *e, const dyd_index_list *list) {
  dyd_json_array(j, name, DYD_JSON_FLAT);
  for (size_t k = 0; k < list->count; k++) dyd_json_site(j, NULL, e, list->item[k]);
  dyd_json_close(j, 1);
}

void dyd_json_aliases(dyd_json *j, const dyd_engine *e, const dyd_sphere *s) {
  dyd_alias_walk w = {.e = e, .s = s};
  dyd_json_array(j, "aliases", DYD_JSON_FLAT);
  while (dyd_alias_next(&w)) {
    dyd_json_array(j, NULL, DYD_JSON_FLAT);
    dyd_json_index(j, NULL, w.row);
    dyd_json_index(j, NULL, w.of);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

/* Put together here, as most members of large results are of these two kinds. */
void dyd_json_pairs(dyd_json *j, const char *name, const dyd_engine *e, const dyd_pair_list *pairs) {
  dyd_sink *s = &j->to;
  dyd_json_array(j, name, DYD_JSON_LIST);
  for (size_t k = 0; k < pairs->count; k++) {
    const dyd_pair *p = &pairs->item[k];
    dyd_sink_text(s, k ? ",\n{\"i\": " : "\n{\"i\": ");
    dyd_sink_index(s, dyd_engine_row(e, p->i));
    dyd_sink_text(s, ", \"j\": ");
    dyd_sink_index(s, dyd_engine_row(e, p->j));
    dyd_sink_text(s, ", \"status\": \"");
    dyd_sink_text(s, dyd_pair_status_text(p->status));
    dyd_sink_text(s, "\"}");
  }
  dyd_json_close(j, 1);
}

void dyd_json_triangles(dyd_json *j, const dyd_engine *e, const dyd_triangle_list *list) {
  dyd_json_array(j, "triangles", DYD_JSON_FLAT);
  for (size_t k = 0; k < list->count; k++) {
    if (k) dyd_sink_text(&j->to, k % 8 ? ", " : ",\n");
    for (int c = 0; c < 3; c++) {
      dyd_sink_text(&j->to, c ? ", " : "[");
      dyd_sink_index(&j->to, dyd_engine_row(e, list->item[k].v[c]));
    }
    dyd_sink_text(&j->to, "]");
  }
  dyd_json_close(j, 1);
}

void dyd_json_counters(dyd_json *j, const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  const dyd_delaunay_counters *d = &c.delaunay;
  const dyd_tie_counters *t = &c.ties;
  const struct {
    const char *name;
    int64_t n;
  } counter[] = {{"stages", (int64_t)c.stages},
                 {"stream_calls", (int64_t)c.calls},
                 {"bits_least", c.bits_least},
                 {"bits_most", c.bits_most},
                 {"bits_total", (int64_t)c.bits_total},
                 {"undecided_faces", (int64_t)c.undecided_faces},
                 {"faces_worked_on", (int64_t)d->faces},
                 {"filter", (int64_t)d->filter},
                 {"integer", (int64_t)d->integer},
                 {"exact", (int64_t)d->exact},
                 {"witness_guess", (int64_t)d->witness_guess},
                 {"witness_search", (int64_t)d->witness_search},
                 {"cover_walks", (int64_t)d->cover_walks},
                 {"milliseconds_rounded_up", (int64_t)(c.seconds * 1000) + 1},
                 {"zero_tests", (int64_t)t->tests},
                 {"zero_by_identity", (int64_t)t->by_identity},
                 {"zero_by_bound", (int64_t)t->by_bound},
                 {"not_zero", (int64_t)t->nonzero},
                 {"zero_unknown", (int64_t)t->unknown},
                 {"zero_bits_most", t->bits_most},
                 {"zero_degree_most", t->degree_most},
                 {"zero_milliseconds_rounded_up", (int64_t)(t->seconds * 1000) + 1}};
  dyd_json_object(j, "counters", DYD_JSON_FLAT);
  for (size_t k = 0; k < sizeof counter / sizeof *counter; k++) {
    if (k == 5 || k == 10 || k == 14) dyd_json_break(j, ",\n");
    dyd_json_signed(j, counter[k].name, counter[k].n);
  }
  dyd_json_close(j, 1);
}

/* ---- exact boundaries ---- */

const char *const dyd_feature_names[8] = {"x0y0", "x1y0", "x0y1", "x1y1", "x0", "x1", "y0", "y1"};
const char *const dyd_arc_names[3] = {"line", "parabola", "window"};
const char *const dyd_end_names[5] = {"infinite", "sites", "axis", "feature", "window"};

/* The point (a + b sqrt(c)) / d with integers, and its decimal enclosure. */
static dyd_status surd_point_json(FILE *out, const dyd_surd_point *p) {
  dyd_json j;
  double box[4];
  dyd_json_begin(&j, out);
  dyd_json_object(&j, NULL, DYD_JSON_FLAT);
  for (int axis = 0; axis < 2; axis++) {
    dyd_json_object(&j, axis ? "y" : "x", DYD_JSON_FLAT);
    json_integer(&j, "a", axis ? p->ay : p->ax);
    json_integer(&j, "b", axis ? p->by : p->bx);
    dyd_json_close(&j, 1);
  }
  json_integer(&j, "c", p->c);
  json_integer(&j, "d", p->d);
  DYD_LOCAL(dyd_rect, r);
  if (dyd_json_good(&j, dyd_surd_point_enclose(&r, p, 64))) {
    dyd_rect_get_d(box, &r);
    dyd_json_box(&j, true, box);
  }
  return dyd_json_end(&j, "}");
}

void dyd_point_texts_clear(dyd_point_texts *t) {
  for (size_t k = 0; k < DYD_POINT_TEXTS; k++) {
    if (t->text[k]) dyd_surd_point_clear(&t->point[k]);
    free(t->text[k]);
    t->text[k] = NULL;
  }
}

static bool surd_point_is_same(const dyd_surd_point *p, const dyd_surd_point *q) {
  return !mpz_cmp(p->ax, q->ax) && !mpz_cmp(p->ay, q->ay) && !mpz_cmp(p->d, q->d) && !mpz_cmp(p->bx, q->bx) &&
         !mpz_cmp(p->by, q->by) && !mpz_cmp(p->c, q->c);
}

/* The text of p, made if need be; borrowed from t until 64 others were made. */
static dyd_status find_point_text(const char **out, dyd_point_texts *t, const dyd_surd_point *p) {
  char *text = NULL;
  size_t size = 0;
  for (size_t k = 0; k < DYD_POINT_TEXTS; k++)
    if (t->text[k] && surd_point_is_same(&t->point[k], p)) return *out = t->text[k], DYD_OK;
  FILE *memory = open_memstream(&text, &size);
  if (!memory) return DYD_E_NOMEM;
  dyd_status st = surd_point_json(memory, p);
  bool good = !ferror(memory);
  if (fclose(memory) != 0 || !good || !text) st = DYD_E_NOMEM;
  if (st != DYD_OK) {
    free(text);
    return st;
  }
  size_t k = t->next++ % DYD_POINT_TEXTS;
  if (!t->text[k]) dyd_surd_point_init(&t->point[k]);
  dyd_surd_point_set(&t->point[k], p);
  free(t->text[k]);
  *out = t->text[k] = text;
  return DYD_OK;
}

static void arc_end_json(dyd_json *j, const char *name, const dyd_arc_end *end, dyd_point_texts *texts) {
  const char *text;
  dyd_json_break(j, ",\n  ");
  dyd_json_object(j, name, DYD_JSON_FLAT);
  dyd_json_word(j, "kind", dyd_end_names[end->kind]);
  if (end->kind == DYD_END_SITES) dyd_json_site(j, "site", texts->engine, end->site);
  if (end->kind != DYD_END_INFINITE && dyd_json_good(j, find_point_text(&text, texts, &end->at)))
    dyd_json_raw(j, "at", text);
  dyd_json_close(j, 1);
}

static void arc_json(dyd_json *j, const dyd_arc *arc, dyd_point_texts *texts) {
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_word(j, "kind", dyd_arc_names[arc->kind]);
  if (arc->kind != DYD_ARC_WINDOW) {
    dyd_json_site(j, "far", texts->engine, arc->far_site);
    dyd_json_word(j, "corner", dyd_feature_names[arc->corner]);
    dyd_json_site(j, "near", texts->engine, arc->near_site);
    dyd_json_word(j, "feature", dyd_feature_names[arc->feature]);
  }
  arc_end_json(j, "begin", &arc->begin, texts);
  arc_end_json(j, "end", &arc->end, texts);
  dyd_json_close(j, 1);
}

void dyd_json_boundary(dyd_json *j, const char *name, const dyd_boundary *b, dyd_point_texts *texts) {
  dyd_json_object(j, name, DYD_JSON_FLAT);
  dyd_json_bool(j, "whole", b->whole);
  dyd_json_array(j, "chains", DYD_JSON_FLAT);
  for (size_t k = 0; k < b->count && j->st == DYD_OK; k++) {
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_bool(j, "closed", b->chain[k].closed);
    dyd_json_array(j, "arcs", DYD_JSON_FLAT);
    for (size_t a = 0; a < b->chain[k].count && j->st == DYD_OK; a++) {
      dyd_json_break(j, a ? ",\n " : "\n ");
      arc_json(j, &b->chain[k].arc[a], texts);
    }
    dyd_json_close(j, 2);
  }
  dyd_json_close(j, 2);
}
