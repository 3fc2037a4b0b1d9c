/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading the answers of a trace back into an engine. The trace may end anywhere, within a line too: the run that wrote
 * it may have been killed. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "io/read/text.h"
#include "io/trace.h"
#include "io/trace_values.h"
#include <dyadel/io.h>
#include <string.h>

typedef struct recall {
  dyd_engine *e;
  const char *input; /* may be NULL */
  dyd_recall_report report;
  dyd_error *err;
  uint64_t sum;
  dyd_rect *last; /* the last answer of each point, the whole plane before that */
  bool *had;
  int64_t *kept; /* bits of the last answer kept of an earlier trace, INT64_MIN before that */
  size_t points;
  bool ended;
} recall;

static dyd_status recall_fail(const recall *r, const char *what) {
  return dyd_fail(r->err, DYD_E_PARSE, "%s; give a trace that dyadel wrote of these points", what);
}

static dyd_status recall_head(recall *r, const json_t *line) {
  int64_t points;
  const char *input = json_string_value(json_object_get(line, "input"));
  if (!dyd_trace_has_text(line, "format", DYD_TRACE_FORMAT))
    return recall_fail(r, "this is no trace of the format \"" DYD_TRACE_FORMAT "\"");
  if (!dyd_trace_integer(&points, line, "points", 0, INT64_MAX))
    return recall_fail(r, "the number of points is missing");
  size_t count = dyd_engine_count(r->e);
  if ((uint64_t)points != count)
    return dyd_fail(r->err, DYD_E_PARSE,
                    "this is a trace of %lld points, and there are %zu here; give one of these points",
                    (long long)points, count);
  if (input && r->input && strcmp(input, r->input) != 0)
    return recall_fail(r, "this is the trace of another input, or of one that was changed since");
  r->last = dyd_alloc(count + 1, sizeof *r->last);
  r->had = calloc(count + 1, sizeof *r->had);
  r->kept = dyd_alloc(count + 1, sizeof *r->kept);
  if (!r->last || !r->had || !r->kept) return dyd_fail_nomem(r->err);
  for (; r->points < count; r->points++) {
    dyd_rect_init(&r->last[r->points]);
    r->kept[r->points] = INT64_MIN;
  }
  return DYD_OK;
}

/* An answer: of a point that can be narrowed, within its last one. */
static dyd_status recall_answer(recall *r, size_t point, int64_t bits, const dyd_rect *rect, bool final) {
  if (r->had[point] && !dyd_rect_contains(&r->last[point], rect))
    return recall_fail(r, "this rectangle is not inside the one before");
  dyd_error why;
  dyd_status st = dyd_engine_recall(r->e, (uint32_t)point, bits, rect, final, &why);
  if (st == DYD_E_ARG) return recall_fail(r, why.message);
  if (st != DYD_OK) return dyd_fail(r->err, st, "%s", why.message);
  dyd_rect_set(&r->last[point], rect);
  r->had[point] = true;
  r->report.answers++;
  return DYD_OK;
}

static dyd_status recall_step(recall *r, const json_t *line) {
  int64_t point, bits;
  if (!dyd_trace_integer(&point, line, "point", 0, (int64_t)r->points - 1))
    return recall_fail(r, "there is no such point");
  const bool kept = json_is_true(json_object_get(line, "kept"));
  if (!kept && !json_is_true(json_object_get(line, "called"))) return DYD_OK;
  if (!dyd_trace_integer(&bits, line, "bits", INT64_MIN, INT64_MAX))
    return recall_fail(r, "the bits asked are missing");
  if (!kept && bits <= r->kept[point]) return DYD_OK; /* this answer was one of those kept */
  if (kept) r->kept[point] = bits;
  dyd_rect rect;
  dyd_rect_init(&rect);
  dyd_status st = dyd_trace_side(&rect.x, line, "x") && dyd_trace_side(&rect.y, line, "y")
                      ? recall_answer(r, (size_t)point, bits, &rect, json_is_true(json_object_get(line, "final")))
                      : recall_fail(r, "this is no rectangle");
  dyd_rect_clear(&rect);
  return st;
}

static dyd_status recall_line(recall *r, const json_t *line) {
  if (!json_is_object(line)) return recall_fail(r, "this line is no JSON object");
  if (!r->had) return recall_head(r, line);
  if (r->ended) return recall_fail(r, "the trace goes on behind its outcome");
  r->ended = json_object_get(line, "outcome") != NULL;
  return json_object_get(line, "point") ? recall_step(r, line) : DYD_OK;
}

/* All lines; the last one is left out when it was cut short. */
static dyd_status recall_lines(recall *r, dyd_text *text) {
  dyd_line line = {0};
  dyd_status st = dyd_text_next(&line, text, r->err);
  while (st == DYD_OK && line.text) {
    r->err->line = line.number;
    json_t *value = json_loadb(line.text, line.length, JSON_REJECT_DUPLICATES, NULL);
    bool cut = !value && text->ended && text->start == text->end && r->had;
    st = cut ? DYD_OK : recall_line(r, value);
    if (st == DYD_OK && !cut && !dyd_trace_is_sealed(&r->sum, line.text, line.length))
      st = recall_fail(r, "this line, or the order of lines, was changed: its digest is another");
    r->report.cut = cut;
    json_decref(value);
    if (st == DYD_OK) st = dyd_text_next(&line, text, r->err);
  }
  return st == DYD_OK && !r->had ? recall_fail(r, "the file is empty") : st;
}

dyd_status dyd_trace_recall(dyd_recall_report *out, dyd_engine *e, FILE *in, const char *input, dyd_error *err) {
  dyd_error local;
  recall r = {.e = e,
              .input = input,
              .sum = DYD_TRACE_SUM_BEGIN,
              .report = {DYD_SIZED(dyd_recall_report)},
              .err = err ? err : &local};
  dyd_text text;
  dyd_error_clear(r.err);
  if (out) {
    dyd_status st = dyd_abi_check(out, 0, "dyd_recall_report", r.err);
    if (st != DYD_OK) return st;
  }
  dyd_text_init(&text, in);
  dyd_status st = recall_lines(&r, &text);
  if (st == DYD_OK) dyd_error_clear(r.err);
  if (st != DYD_OK && !r.err->column) r.err->column = 1;
  if (out) dyd_abi_give(out, &r.report, sizeof r.report);
  dyd_text_clear(&text);
  for (size_t i = 0; i < r.points; i++) dyd_rect_clear(&r.last[i]);
  free(r.last);
  free(r.had);
  free(r.kept);
  return st;
}
