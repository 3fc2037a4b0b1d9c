/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pieces that several formats or contents share. All texts are our own ASCII words and numbers, so nothing needs
 * escaping; those of users are in label_text.c. */
#include "io/parts.h"

#include "io/decimal.h"
#include <stdlib.h>

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

static void csv_aliases(FILE *out, dyd_alias_walk w) {
  while (dyd_alias_next(&w)) fprintf(out, "# alias %zu %zu\n", w.row, w.of);
}

static void json_aliases(FILE *out, dyd_alias_walk w, const char *after) {
  fputs("\"aliases\": [", out);
  for (const char *between = ""; dyd_alias_next(&w); between = ", ") fprintf(out, "%s[%zu, %zu]", between, w.row, w.of);
  fprintf(out, "]%s", after);
}

void dyd_csv_aliases(FILE *out, const dyd_engine *e) {
  csv_aliases(out, (dyd_alias_walk){.e = e});
}

void dyd_json_aliases(FILE *out, const dyd_engine *e, const char *after) {
  json_aliases(out, (dyd_alias_walk){.e = e}, after);
}

void dyd_csv_sphere_aliases(FILE *out, const dyd_sphere *s) {
  csv_aliases(out, (dyd_alias_walk){.e = dyd_sphere_places(s), .s = s});
}

void dyd_json_sphere_aliases(FILE *out, const dyd_sphere *s, const char *after) {
  json_aliases(out, (dyd_alias_walk){.e = dyd_sphere_places(s), .s = s}, after);
}

const char *dyd_schedule_text(dyd_schedule schedule) {
  return schedule == DYD_SCHEDULE_UNIFORM ? "uniform" : "adaptive";
}

void dyd_json_head(FILE *out, const char *format) {
  fprintf(out, "{\"format\": \"%s\",\n\"version\": \"%s\",\n", format, dyd_version());
}

void dyd_json_crs(FILE *out, unsigned epsg) {
  if (epsg) fprintf(out, "\"crs\": \"EPSG:%u\",\n", epsg);
}

void dyd_json_head_outward(FILE *out, const char *format, dyd_outcome outcome) {
  dyd_json_head(out, format);
  fprintf(out,
          "\"rounding\": \"texts are exact numbers; pairs of numbers are rounded outward: the first down, the second "
          "up\",\n\"outcome\": \"%s\",\n",
          dyd_outcome_text(outcome));
}

dyd_status dyd_json_bound(FILE *out, const char *name, const dyd_dyadic *value) {
  fprintf(out, "\"%s\": ", name);
  if (!value) {
    fputs("null", out);
    return DYD_OK;
  }
  char *exact = dyd_dyadic_get_str(value);
  if (!exact) return DYD_E_NOMEM;
  fprintf(out, "{\"exact\": \"%s\", \"decimal\": ", exact);
  dyd_decimal_put(out, dyd_dyadic_get_d(value, DYD_UP), DYD_UP, "null");
  fputs("}", out);
  free(exact);
  return DYD_OK;
}

static dyd_status json_side(FILE *out, const char *name, const dyd_interval *a) {
  char *lo = dyd_end_text(a, false), *hi = dyd_interval_is_point(a) ? lo : dyd_end_text(a, true);
  dyd_status st = lo && hi ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) fprintf(out, "\"%s\": [\"%s\", \"%s\"]", name, lo, hi);
  if (hi != lo) free(hi);
  free(lo);
  return st;
}

dyd_status dyd_json_sides(FILE *out, const dyd_rect *r, const char *between) {
  dyd_status st = json_side(out, "x", &r->x);
  fputs(between, out);
  return st == DYD_OK ? json_side(out, "y", &r->y) : st;
}

dyd_status dyd_json_rect(FILE *out, const dyd_rect *r) {
  fputs("{", out);
  dyd_status st = dyd_json_sides(out, r, ", ");
  fputs("}", out);
  return st;
}

static void sink_decimals(dyd_sink *s, double lo, double hi) {
  dyd_sink_text(s, "[");
  dyd_sink_decimal(s, lo, DYD_DOWN, "null");
  dyd_sink_text(s, ", ");
  dyd_sink_decimal(s, hi, DYD_UP, "null");
  dyd_sink_text(s, "]");
}

void dyd_json_decimals(FILE *out, double lo, double hi) {
  dyd_sink s;
  dyd_sink_begin(&s, out);
  sink_decimals(&s, lo, hi);
  dyd_sink_flush(&s);
}

void dyd_sink_json_box(dyd_sink *s, const char *suffix, const double box[4]) {
  for (int a = 0; a < 2; a++) {
    dyd_sink_text(s, a ? ", \"y" : "\"x");
    dyd_sink_text(s, suffix);
    dyd_sink_text(s, "\": ");
    sink_decimals(s, box[2 * a], box[2 * a + 1]);
  }
}

void dyd_json_box(FILE *out, const char *suffix, const double box[4]) {
  dyd_sink s;
  dyd_sink_begin(&s, out);
  dyd_sink_json_box(&s, suffix, box);
  dyd_sink_flush(&s);
}

dyd_status dyd_put_window(FILE *out, const dyd_rect *w, const char *quote, const char *between) {
  const dyd_dyadic *end[] = {&w->x.lo, &w->x.hi, &w->y.lo, &w->y.hi};
  for (int k = 0; k < 4; k++) {
    char *text = dyd_dyadic_get_str(end[k]);
    if (!text) return DYD_E_NOMEM;
    fprintf(out, "%s%s%s%s", k ? between : "", quote, text, quote);
    free(text);
  }
  return DYD_OK;
}
