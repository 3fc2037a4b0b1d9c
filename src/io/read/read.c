/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reads points from a file into an engine, in one pass over the text. */
#include "base/abi.h"
#include "base/error.h"
#include "io/read/source.h"
#include "io/read/stage.h"
#include <dyadel/io.h>
#include <math.h>
#include <string.h>

static dyd_status manner_radius(dyd_manner *m, const char *text, dyd_error *err) {
  dyd_status st = dyd_real_parse_exact(m->radius, text, strlen(text));
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st != DYD_OK || mpq_sgn(m->radius) < 0)
    return dyd_fail(err, DYD_E_ARG, "the radius \"%.60s\" is not an exact number >= 0; give one such as 0.01 or 1/64",
                    text);
  m->widen = mpq_sgn(m->radius) > 0;
  /* mpq_get_d rounds towards zero; beyond doubles the radius goes the general way. */
  double down = mpq_get_d(m->radius);
  mpq_t back;
  mpq_init(back);
  if (isfinite(down)) mpq_set_d(back, down);
  m->radius_up = mpq_equal(back, m->radius) ? down : nextafter(down, INFINITY);
  mpq_clear(back);
  return DYD_OK;
}

/* Reads the two coordinates of a point and stages it. */
static dyd_status stage_point(dyd_stage *stage, const dyd_span span[2], const dyd_manner *manner, dyd_error *err) {
  dyd_coordinate x = {.kind = DYD_COORDINATE_DOUBLE}, y = x;
  dyd_status st = dyd_coordinate_read(&x, &span[0], manner, err);
  if (st == DYD_OK) st = dyd_coordinate_read(&y, &span[1], manner, err);
  if (st == DYD_OK) return dyd_stage_add(stage, &x, &y, err);
  dyd_coordinate_clear(&x);
  return st;
}

/* Is every field of the line a word or quoted, as in the header of a CSV file? */
static bool is_header(const dyd_line *line) {
  const char *end = line->text + line->length;
  if (!memchr(line->text, ',', line->length)) return false;
  for (const char *at = line->text; at < end; at++) {
    while (at < end && (*at == ' ' || *at == '\t')) at++;
    if (at == end || !(*at == '"' || *at == '_' || (*at >= 'A' && *at <= 'Z') || (*at >= 'a' && *at <= 'z')))
      return false;
    const char *comma = memchr(at, ',', (size_t)(end - at));
    if (!comma) return true;
    at = comma;
  }
  return false;
}

/* A first line that is not understood may be a header. */
static dyd_status hint_header(dyd_status st, const dyd_line *line, const dyd_stage *stage, dyd_error *err) {
  size_t length = strlen(err->message);
  if (st == DYD_E_PARSE && !stage->count && is_header(line))
    snprintf(err->message + length, sizeof err->message - length,
             "; if this is CSV with a header, name two of its columns: --columns X,Y");
  return st;
}

static dyd_status read_points_file(dyd_stage *stage, dyd_text *text, const dyd_manner *manner, dyd_error *err) {
  for (;;) {
    dyd_line line;
    dyd_span span[2];
    size_t count;
    dyd_status st = dyd_text_next(&line, text, err);
    if (st != DYD_OK || !line.text) return st;
    st = dyd_points_split(span, &count, &line, err);
    if (st == DYD_OK && count) st = stage_point(stage, span, manner, err);
    if (st != DYD_OK) return hint_header(st, &line, stage, err);
  }
}

static dyd_status read_csv_file(dyd_stage *stage, dyd_text *text, const dyd_manner *manner, const char *columns,
                                dyd_error *err) {
  dyd_csv csv;
  dyd_span span[2];
  size_t count = 1;
  dyd_status st = dyd_csv_open(&csv, text, columns, err);
  while (st == DYD_OK && count) {
    st = dyd_csv_next(span, &count, &csv, err);
    if (st == DYD_OK && count) st = stage_point(stage, span, manner, err);
  }
  dyd_csv_clear(&csv);
  return st;
}

/* Adds the points of text, which is ready to be read; err is not NULL. */
static dyd_status points_read_text(dyd_engine *e, dyd_text *text, const dyd_read_options *o, dyd_error *err) {
  dyd_manner manner = {.measured = o->measured};
  dyd_stage stage;
  mpq_init(manner.radius);
  dyd_stage_init(&stage);
  dyd_status st = o->radius ? manner_radius(&manner, o->radius, err) : DYD_OK;
  if (st == DYD_OK)
    st = o->columns ? read_csv_file(&stage, text, &manner, o->columns, err)
                    : read_points_file(&stage, text, &manner, err);
  if (st == DYD_OK) st = dyd_stage_commit(e, &stage, err);
  dyd_stage_clear(&stage);
  mpq_clear(manner.radius);
  return st;
}

/* The same with what the caller gave; clears text. */
static dyd_status points_read_given(dyd_engine *e, dyd_text *text, const dyd_read_options *options, dyd_error *err) {
  dyd_read_options o;
  dyd_error own;
  if (!err) err = &own;
  dyd_error_clear(err);
  dyd_status st = dyd_abi_take(&o, sizeof o, options, "dyd_read_options", err);
  if (st == DYD_OK) st = points_read_text(e, text, &o, err);
  dyd_text_clear(text);
  return st;
}

dyd_status dyd_read_points(dyd_engine *e, FILE *in, const dyd_read_options *options, dyd_error *err) {
  dyd_text text;
  dyd_text_init(&text, in);
  return points_read_given(e, &text, options, err);
}

dyd_status dyd_engine_add_text(dyd_engine *e, const char *text, size_t length, const dyd_read_options *options,
                               dyd_error *err) {
  dyd_text copy;
  if (dyd_text_init_copy(&copy, text, length) != DYD_OK) return dyd_fail_nomem(err);
  return points_read_given(e, &copy, options, err);
}

/* ---- one rectangle ---- */

static dyd_status rect_set_side(dyd_interval *out, const dyd_span *span, dyd_error *err) {
  dyd_error own;
  dyd_error_clear(&own);
  dyd_status st = dyd_interval_set_text(out, span->text, span->length, &own);
  return st == DYD_OK ? st : dyd_coordinate_fail(err, st, span, &own);
}

dyd_status dyd_rect_set_text(dyd_rect *out, const char *text, size_t length, dyd_error *err) {
  const dyd_line line = {text, length, 1};
  dyd_span span[2];
  dyd_rect r;
  size_t count;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_points_split(span, &count, &line, err);
  if (st == DYD_OK && !count) st = dyd_fail(err, DYD_E_PARSE, "there is no point in this text; give two coordinates");
  if (st != DYD_OK) return st;
  dyd_rect_init(&r);
  st = rect_set_side(&r.x, &span[0], err);
  if (st == DYD_OK) st = rect_set_side(&r.y, &span[1], err);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  dyd_rect_clear(&r);
  return st;
}
