/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reads points from a file into an engine, in one pass over the text. */
#include "base/abi.h"
#include "base/error.h"
#include "engine/add.h"
#include "io/read/intake.h"
#include <dyadel/io.h>
#include <string.h>

/* Behind what is wrong with the first line, where that may be a header. */
static dyd_status hint_header(dyd_status st, const dyd_line *line, const dyd_intake *in, dyd_error *err) {
  size_t length = strlen(err->message);
  if (st == DYD_E_PARSE && in->report.rows <= 1 && !in->stage.count)
    dyd_csv_hint(err->message + length, sizeof err->message - length, line);
  return st;
}

static dyd_status read_points_file(dyd_intake *in, dyd_text *text, dyd_error *err) {
  for (;;) {
    dyd_line line;
    dyd_span span[DYD_CSV_ROLES] = {{0}};
    size_t count;
    dyd_status st = dyd_text_next(&line, text, err);
    if (st != DYD_OK || !line.text) return st;
    st = dyd_points_split(span, &count, &line, in->o->decimal_comma ? ' ' : ',', err);
    if (st == DYD_OK && count) st = dyd_intake_row(in, span, err);
    if (st != DYD_OK) return hint_header(st, &line, in, err);
  }
}

static dyd_status read_csv_file(dyd_intake *in, dyd_text *text, dyd_error *err) {
  dyd_csv csv;
  size_t count = 1;
  dyd_status st = dyd_csv_open(&csv, text, in->o, err);
  in->report.degrees = csv.degrees;
  in->report.swapped = csv.swapped;
  if (!in->unit) in->unit = csv.unit;
  while (st == DYD_OK && count) {
    dyd_span span[DYD_CSV_ROLES] = {{0}};
    st = dyd_csv_next(span, &count, &csv, err);
    if (st == DYD_OK && count) st = dyd_intake_row(in, span, err);
  }
  dyd_csv_clear(&csv);
  return st;
}

/* Adds the points of text, which is ready to be read; err is not NULL. */
static dyd_status points_read_text(dyd_engine *e, dyd_text *text, const dyd_read_options *o, dyd_error *err) {
  dyd_intake in;
  dyd_status st = dyd_intake_init(&in, o, err);
  if (st == DYD_OK && o->report) st = dyd_abi_check(o->report, sizeof o->report->struct_size, "dyd_read_report", err);
  if (st == DYD_OK) st = o->columns ? read_csv_file(&in, text, err) : read_points_file(&in, text, err);
  if (st == DYD_OK) st = dyd_intake_commit(e, &in, err);
  if (st == DYD_OK && o->report) dyd_abi_give(o->report, &in.report, sizeof in.report);
  dyd_intake_clear(&in);
  return st;
}

/* The same with what the caller gave; clears text. later: also after the first run. */
static dyd_status points_read_given(dyd_engine *e, dyd_text *text, bool later, const dyd_read_options *options,
                                    dyd_error *err) {
  dyd_read_options o;
  dyd_error own;
  if (!err) err = &own;
  dyd_error_clear(err);
  dyd_status st = dyd_engine_may_add(e, later);
  if (st != DYD_OK)
    *err = *dyd_engine_add_error(e);
  else
    st = dyd_abi_take(&o, sizeof o, options, "dyd_read_options", err);
  if (st == DYD_OK) st = points_read_text(e, text, &o, err);
  dyd_text_clear(text);
  return st;
}

dyd_status dyd_read_points(dyd_engine *e, FILE *in, const dyd_read_options *options, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_text text;
  dyd_text_init(&text, in);
  return points_read_given(e, &text, false, options, err);
}

static dyd_status points_read_copy(dyd_engine *e, const char *text, size_t length, bool later,
                                   const dyd_read_options *options, dyd_error *err) {
  dyd_text copy;
  if (dyd_text_init_copy(&copy, text, length) != DYD_OK) return dyd_fail_nomem(err);
  return points_read_given(e, &copy, later, options, err);
}

dyd_status dyd_engine_add_text(dyd_engine *e, const char *text, size_t length, const dyd_read_options *options,
                               dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  return points_read_copy(e, text, length, false, options, err);
}

dyd_status dyd_engine_append_text(dyd_engine *e, const char *text, size_t length, const dyd_read_options *options,
                                  dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  return points_read_copy(e, text, length, true, options, err);
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
  dyd_status st = dyd_points_split(span, &count, &line, ',', err);
  if (st == DYD_OK && !count) st = dyd_fail(err, DYD_E_PARSE, "there is no point in this text; give two coordinates");
  if (st != DYD_OK) return st;
  dyd_rect_init(&r);
  st = rect_set_side(&r.x, &span[0], err);
  if (st == DYD_OK) st = rect_set_side(&r.y, &span[1], err);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  dyd_rect_clear(&r);
  return st;
}
