/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas in files: polygons as well-known text, also in a table, or as GeoJSON. All polygons of the file
 * together are one area. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "stream/number.h"

#include <dyadel/io.h>
#include <gmp.h>
#include <math.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>

/* Invariant: area->offset[0 .. rings] are set; the ring at work has the vertices from there to `vertices`. place[k]:
 * where in the text vertex k is. */
typedef struct area_text {
  const char *text, *at, *end;
  dyd_area *area;
  size_t *place, vertices, place_cap, xy_cap, offset_cap;
  dyd_error *err;
} area_text;

static void area_place(const area_text *t, size_t place) {
  if (!t->err) return;
  t->err->line = t->err->column = 1;
  for (size_t k = 0; k < place; k++) {
    bool line = t->text[k] == '\n';
    t->err->line += line;
    t->err->column = line ? 1 : t->err->column + ((t->text[k] & 0xC0) != 0x80);
  }
}

static dyd_status area_refuse(const area_text *t, const char *problem) {
  area_place(t, (size_t)(t->at - t->text));
  return dyd_fail(t->err, DYD_E_PARSE, "%s", problem);
}

static bool is_any_of(char c, const char *set) {
  return c && strchr(set, c);
}

static void skip_any_of(area_text *t, const char *set) {
  while (t->at < t->end && is_any_of(*t->at, set)) t->at++;
}

/* The nearest double. */
static dyd_status area_number(double *out, area_text *t) {
  size_t length = 0;
  dyd_error why = {0};
  skip_any_of(t, " \t\r\n");
  while (t->at + length < t->end && !is_any_of(t->at[length], " \t\r\n,()[]\"")) length++;
  DYD_LOCAL_NUMBERS(mpq, q);
  DYD_LOCAL_FLOATS(53, r);
  dyd_status st = length ? dyd_parse_number(q, t->at, length, DYD_NUMBER_ANY, &why) : DYD_E_PARSE;
  mpfr_set_q(r, q, MPFR_RNDN);
  *out = mpfr_get_d(r, MPFR_RNDN);
  if (st == DYD_OK && !isfinite(*out)) st = DYD_E_PARSE;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(t->err);
  if (st != DYD_OK) return area_refuse(t, "a coordinate has to be here, a number");
  t->at += length;
  return DYD_OK;
}

/* A vertex; up to one of `close` what follows its two numbers is skipped: heights and measures. */
static dyd_status area_vertex(area_text *t, const char *close) {
  if (!DYD_GROW(t->place, t->place_cap, t->vertices + 1) || !DYD_GROW(t->area->xy, t->xy_cap, 2 * (t->vertices + 1)))
    return dyd_fail_nomem(t->err);
  skip_any_of(t, " \t\r\n");
  t->place[t->vertices] = (size_t)(t->at - t->text);
  double *z = &t->area->xy[2 * t->vertices];
  dyd_status st = area_number(&z[0], t);
  skip_any_of(t, ", \t\r\n");
  if (st == DYD_OK) st = area_number(&z[1], t);
  while (st == DYD_OK && t->at < t->end && !is_any_of(*t->at, close)) t->at++;
  size_t first = t->area->offset[t->area->rings];
  t->vertices += st == DYD_OK && (t->vertices == first || z[0] != z[-2] || z[1] != z[-1]);
  return st;
}

/* The end of a ring, which repeats its first vertex. */
static dyd_status area_ring_end(area_text *t) {
  dyd_area *a = t->area;
  size_t first = a->offset[a->rings], n = t->vertices - first;
  const double *xy = &a->xy[2 * first];
  if (n > 1 && xy[0] == xy[2 * n - 2] && xy[1] == xy[2 * n - 1]) t->vertices--, n--;
  if (n < 3) return area_refuse(t, "a ring of a polygon has at least three different vertices");
  if (!DYD_GROW(a->offset, t->offset_cap, a->rings + 2)) return dyd_fail_nomem(t->err);
  a->offset[++a->rings] = t->vertices;
  return DYD_OK;
}

/* The nested lists of a geometry, from its first bracket on. close: behind a vertex, of a list. */
static dyd_status area_lists(area_text *t, bool wkt) {
  const char open = wkt ? '(' : '[', close = wkt ? ')' : ']';
  int depth = 0, deepest = 0;
  bool ring = false;
  dyd_status st = DYD_OK;
  do {
    skip_any_of(t, ", \t\r\n");
    if (t->at == t->end) return area_refuse(t, "the polygon has no end here; a bracket is missing");
    if (*t->at == open) {
      deepest = ++depth > deepest ? depth : deepest;
      t->at++;
    } else if (*t->at == close) {
      bool vertex = !wkt && depth == deepest && ring;
      depth--;
      if (ring && !vertex && depth == deepest - (wkt ? 1 : 2)) st = area_ring_end(t), ring = false;
      t->at++;
    } else {
      if (depth < (wkt ? 2 : 3)) return area_refuse(t, "the geometry is not a polygon; give one, or several");
      ring = true;
      st = area_vertex(t, wkt ? ",)" : "]");
    }
  } while (depth > 0 && st == DYD_OK);
  return st;
}

static bool area_word(const area_text *t, const char *word) {
  size_t n = strlen(word);
  if ((size_t)(t->end - t->at) < n) return false;
  for (size_t k = 0; k < n; k++)
    if ((t->at[k] >= 'a' && t->at[k] <= 'z' ? t->at[k] - 32 : t->at[k]) != word[k]) return false;
  return true;
}

/* Every POLYGON or MULTIPOLYGON in the text, or every "coordinates" of GeoJSON. */
static dyd_status area_geometries(area_text *t, bool wkt) {
  static const char *const others[][4] = {{"\"POINT\"", "\"MULTIPOINT\"", "\"LINESTRING\"", "\"MULTILINESTRING\""},
                                          {"POINT", "LINESTRING", "CURVE", "CIRCULARSTRING"}};
  const char *word = wkt ? "POLYGON" : "\"COORDINATES\"";
  for (; t->at < t->end; t->at++) {
    for (size_t k = 0; k < 4; k++)
      if (area_word(t, others[wkt][k])) return area_refuse(t, "a polygon has to be here, not a point or line");
    if (!area_word(t, word)) continue;
    t->at += strlen(word);
    skip_any_of(t, wkt ? " ZMzm" : " \t\r\n:");
    if (wkt && area_word(t, "EMPTY")) continue;
    if (t->at == t->end || *t->at != (wkt ? '(' : '['))
      return area_refuse(t, wkt ? "a bracket is missing here" : "a list of coordinates has to be here");
    dyd_status st = area_lists(t, wkt);
    if (st != DYD_OK) return st;
    t->at--;
  }
  return DYD_OK;
}

static dyd_status area_load(char **text, size_t *count, FILE *in, dyd_error *err) {
  char part[4096];
  size_t got;
  FILE *all = open_memstream(text, count);
  if (!all) return dyd_fail_nomem(err);
  while ((got = fread(part, 1, sizeof part, in))) fwrite(part, 1, got, all);
  bool lost = ferror(all);
  if (fclose(all) != 0 || lost || !*text) return dyd_fail_nomem(err);
  return ferror(in) ? dyd_fail(err, DYD_E_IO, "the file cannot be read to its end") : DYD_OK;
}

dyd_status dyd_area_read(dyd_area *out, FILE *in, dyd_error *err) {
  char *text = NULL;
  dyd_area made = {0};
  size_t count = 0, bad[2], turned = 0;
  if (err) dyd_error_clear(err);
  dyd_status st = area_load(&text, &count, in, err);
  area_text t = {.text = text, .at = text, .end = text + count, .area = &made, .err = err};
  if (st == DYD_OK && !DYD_GROW(made.offset, t.offset_cap, 1)) st = dyd_fail_nomem(err);
  if (st == DYD_OK) {
    made.offset[0] = 0;
    skip_any_of(&t, "\xEF\xBB\xBF \t\r\n");
    if ((t.at < t.end && *t.at == '<') || memchr(text, 0, count))
      st = dyd_fail(err, DYD_E_PARSE,
                    "the file is neither well-known text nor GeoJSON; make GeoJSON of it: ogr2ogr -f GeoJSON "
                    "area.geojson FILE");
    else
      st = area_geometries(&t, t.at == t.end || *t.at != '{');
  }
  if (st == DYD_OK && !made.rings)
    st = dyd_fail(err, DYD_E_PARSE, "the file holds no polygon; give well-known text (POLYGON ((...))) or GeoJSON");
  if (st == DYD_OK) turned = (st = dyd_area_orient(&made, bad)) == DYD_E_ARG;
  if (turned) {
    area_place(&t, t.place[bad[0]]);
    st = dyd_fail(err, DYD_E_PARSE,
                  "the edge from (%.17g, %.17g) on crosses or touches another one, from (%.17g, %.17g) on; "
                  "mend the polygon first, as by ST_MakeValid",
                  made.xy[2 * bad[0]], made.xy[2 * bad[0] + 1], made.xy[2 * bad[1]], made.xy[2 * bad[1] + 1]);
  } else if (st == DYD_E_NOMEM) {
    st = dyd_fail_nomem(err);
  }
  dyd_free_all(t.place, text);
  dyd_area_clear(st == DYD_OK ? out : &made);
  if (st == DYD_OK) *out = made;
  return st;
}
