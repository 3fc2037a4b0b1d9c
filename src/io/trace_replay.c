/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Replaying a trace: the rectangles it names are put into a table of sites, stage by stage, and triangulated as the
 * engine did; no stream is asked. That every rectangle is inside the one before is checked [NEST-1]. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "io/parts.h"
#include "io/read/text.h"
#include "io/result.h"
#include "io/trace.h"
#include "io/trace_proofs.h"
#include "io/trace_values.h"
#include <dyadel/io.h>
#include <inttypes.h>
#include <string.h>

/* A point of the trace. rect holds its first rectangle until the table of sites is made. */
typedef struct replay_point {
  dyd_rect rect;
  int64_t bits;
  bool had, asked;
} replay_point;

/* Invariant: pd = NULL until the first stage is complete; changed holds the `changes` sites narrowed since. */
typedef struct replay {
  dyd_convergence *out;
  dyd_converge_options converge;
  dyd_rect window; /* that of converge */
  dyd_error *err;
  size_t points;
  replay_point *point;
  dyd_sites *sites;
  dyd_delaunay *pd;
  uint32_t *changed;
  size_t changes, change_cap;
  uint64_t calls, sum;
  dyd_trace_proofs proofs;
  bool ended;
} replay;

static dyd_status replay_fail(const replay *r, const char *what) {
  return dyd_fail(r->err, DYD_E_PARSE, "%s; give a trace as dyadel wrote it", what);
}

/* ---- values ---- */

/* A goal or schedule by its word; false when there is none of that name. */
static bool json_get_goal(dyd_goal *out, const json_t *line) {
  int k = 0;
  while (k <= DYD_TRACE_GOAL && !dyd_trace_has_text(line, "goal", dyd_goal_text((dyd_goal)k))) k++;
  *out = (dyd_goal)k;
  return k <= DYD_TRACE_GOAL;
}

static bool json_get_schedule(dyd_schedule *out, const json_t *line) {
  int k = 0;
  while (k <= DYD_TRACE_SCHEDULE && !dyd_trace_has_text(line, "schedule", dyd_schedule_text((dyd_schedule)k))) k++;
  *out = (dyd_schedule)k;
  return k <= DYD_TRACE_SCHEDULE;
}

/* ---- lines ---- */

/* The window of the bounds of V, when one was given. */
static bool replay_window(replay *r, const json_t *line) {
  const json_t *list = json_object_get(line, "window");
  r->converge.no_voronoi = json_is_true(json_object_get(line, "no_voronoi"));
  if (!list) return true;
  r->converge.window = &r->window;
  return json_array_size(list) == 4 && dyd_trace_ends(&r->window.x, list, 0) && dyd_trace_ends(&r->window.y, list, 2) &&
         !dyd_interval_is_point(&r->window.x) && !dyd_interval_is_point(&r->window.y);
}

static dyd_status replay_head(replay *r, const json_t *line) {
  int64_t points, max_pairs;
  dyd_engine_options *o = r->out->options;
  if (!o) o = r->out->options = malloc(sizeof *o);
  if (!o) return dyd_fail_nomem(r->err);
  dyd_engine_options_init(o);
  if (!dyd_trace_has_text(line, "format", DYD_TRACE_FORMAT))
    return replay_fail(r, "this is no trace of the format \"" DYD_TRACE_FORMAT "\"");
  if (!dyd_trace_integer(&points, line, "points", 0, (int64_t)DYD_MAX_SITES) ||
      !dyd_trace_integer(&o->goal_bits, line, "goal_bits", INT64_MIN, INT64_MAX) ||
      !dyd_trace_integer(&o->start_bits, line, "start_bits", INT64_MIN, INT64_MAX) ||
      !dyd_trace_integer(&o->step_bits, line, "step_bits", 0, INT64_MAX) ||
      !dyd_trace_integer(&o->max_bits, line, "max_bits", INT64_MIN, INT64_MAX) ||
      !dyd_trace_integer(&max_pairs, line, "max_pairs", 0, INT64_MAX) || !json_get_schedule(&o->schedule, line) ||
      !json_get_goal(&o->goal, line) || !replay_window(r, line))
    return replay_fail(r, "the first line lacks a field, or has a wrong one");
  o->max_pairs = (size_t)max_pairs;
  r->points = (size_t)points;
  r->point = calloc(r->points + 1, sizeof *r->point);
  if (!r->point) {
    r->points = 0;
    return dyd_fail_nomem(r->err);
  }
  for (size_t i = 0; i < r->points; i++) dyd_rect_init(&r->point[i].rect);
  return DYD_OK;
}

/* The rectangle of a line goes into the table, or is kept until there is one. */
static dyd_status replay_rect(replay *r, size_t i, const dyd_rect *rect, bool called) {
  replay_point *p = &r->point[i];
  if (!r->pd) {
    if (p->had && !dyd_rect_contains(&p->rect, rect))
      return replay_fail(r, "this rectangle is not inside the one before");
    dyd_rect_set(&p->rect, rect);
    p->had = true;
    return DYD_OK;
  }
  dyd_status st = dyd_sites_narrow(r->sites, i, rect);
  if (st == DYD_E_NESTING) return replay_fail(r, "this rectangle is not inside the one before");
  if (st == DYD_OK && !dyd_reserve((void **)&r->changed, &r->change_cap, r->changes + 1, sizeof *r->changed))
    st = DYD_E_NOMEM;
  if (st != DYD_OK) return dyd_fail(r->err, st, "%s", dyd_status_text(st));
  if (called) r->changed[r->changes++] = (uint32_t)i;
  return DYD_OK;
}

static dyd_status replay_step(replay *r, const json_t *line) {
  int64_t point;
  if (!dyd_trace_integer(&point, line, "point", 0, (int64_t)r->points - 1))
    return replay_fail(r, "there is no such point");
  replay_point *p = &r->point[point];
  bool fixed = dyd_trace_has_text(line, "why", "fixed"), called = json_is_true(json_object_get(line, "called"));
  if (!fixed && !dyd_trace_integer(&p->bits, line, "bits", INT64_MIN, INT64_MAX))
    return replay_fail(r, "the bits asked are missing");
  if (!fixed) p->asked = true;
  if (called) r->calls++;
  dyd_rect rect;
  dyd_rect_init(&rect);
  dyd_status st = dyd_trace_side(&rect.x, line, "x") && dyd_trace_side(&rect.y, line, "y")
                      ? replay_rect(r, (size_t)point, &rect, called)
                      : replay_fail(r, "this is no rectangle");
  dyd_rect_clear(&rect);
  return st;
}

static dyd_status replay_first_result(replay *r, const dyd_delaunay_options *o) {
  dyd_status st = dyd_sites_new(&r->sites);
  for (size_t i = 0; st == DYD_OK && i < r->points; i++) {
    if (!r->point[i].had) return replay_fail(r, "the first stage ends before every point has a rectangle");
    st = dyd_sites_add_rect(r->sites, &r->point[i].rect);
    dyd_rect_clear(&r->point[i].rect);
    dyd_rect_init(&r->point[i].rect);
  }
  return st == DYD_OK ? dyd_delaunay_new(&r->pd, r->sites, o, r->err) : st;
}

/* The same figures as the engine's. */
static void replay_count_bits(dyd_stage_row *row, const replay *r) {
  bool any = false;
  for (size_t i = 0; i < r->points; i++) {
    const replay_point *p = &r->point[i];
    if (!p->asked) continue;
    if (!any || p->bits < row->bits_least) row->bits_least = p->bits;
    if (!any || p->bits > row->bits_most) row->bits_most = p->bits;
    if (p->bits > 0) row->bits_total += (uint64_t)p->bits;
    any = true;
  }
  row->calls = r->calls;
}

static bool replay_agrees(const dyd_stage_row *row, const json_t *line) {
  int64_t count;
  char digest[17];
  snprintf(digest, sizeof digest, "%016" PRIx64, row->digest);
  for (int k = DYD_TIE; k <= DYD_LEGAL; k++)
    if (!dyd_trace_integer(&count, line, dyd_pair_status_text((dyd_pair_status)k), 0, INT64_MAX) ||
        (size_t)count != row->count[k])
      return false;
  return dyd_trace_has_text(line, "statuses", digest);
}

/* Again, when points are the same. */
static dyd_status replay_triangulate(replay *r, const dyd_delaunay_options *o) {
  bool joined = true;
  dyd_status st = DYD_OK;
  while (joined && st == DYD_OK) {
    st = r->pd ? dyd_delaunay_update(r->pd, r->changed, r->changes, o, r->err) : replay_first_result(r, o);
    if (st == DYD_CAPPED) st = DYD_OK; /* a result as well */
    if (st == DYD_OK) st = dyd_trace_join(&joined, &r->proofs, r->sites);
    if (st == DYD_E_NESTING) return replay_fail(r, "points that are said to be the same are apart");
  }
  return st;
}

static dyd_status replay_proof(replay *r, const json_t *line) {
  dyd_status st = dyd_trace_proofs_read(&r->proofs, line, r->points);
  return st == DYD_E_PARSE ? replay_fail(r, "this is not what can be proved of points") : st;
}

static dyd_status replay_stage(replay *r, const json_t *line) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = r->out->options->max_pairs,
                                  .cancel = r->converge.cancel, .prove = dyd_trace_prove, .prove_user = &r->proofs};
  dyd_stage_row *row;
  dyd_status st = replay_triangulate(r, &o);
  if (st != DYD_OK) return st;
  r->changes = 0;
  st = dyd_convergence_add(&row, r->out, r->pd, &r->converge, r->err);
  if (st != DYD_OK) return st;
  replay_count_bits(row, r);
  if (r->converge.stage) r->converge.stage(r->converge.stage_user, row, r->pd);
  if (replay_agrees(row, line)) return DYD_OK;
  return dyd_fail(r->err, DYD_E_PARSE, "the statuses of this stage are not those that the trace tells of");
}

static dyd_status replay_outcome(replay *r, const json_t *line) {
  for (int k = DYD_OUTCOME_NONE; k <= DYD_OUTCOME_ERROR; k++) {
    if (!dyd_trace_has_text(line, "outcome", dyd_outcome_text((dyd_outcome)k))) continue;
    r->out->outcome = (dyd_outcome)k;
    r->ended = true;
    return DYD_OK;
  }
  return replay_fail(r, "there is no such outcome");
}

static dyd_status replay_line(replay *r, const dyd_line *text) {
  json_error_t error;
  json_t *line = json_loadb(text->text, text->length, JSON_REJECT_DUPLICATES, &error);
  dyd_status st;
  if (!line && json_error_code(&error) == json_error_out_of_memory)
    st = dyd_fail_nomem(r->err);
  else if (!json_is_object(line))
    st = replay_fail(r, "this line is no JSON object");
  else if (!r->point)
    st = replay_head(r, line);
  else if (r->ended)
    st = replay_fail(r, "the trace goes on behind its outcome");
  else if (json_object_get(line, "outcome"))
    st = replay_outcome(r, line);
  else if (json_object_get(line, "kept"))
    st = DYD_OK; /* an answer for runs to come */
  else if (json_object_get(line, "proved"))
    st = replay_proof(r, line);
  else if (json_object_get(line, "done"))
    st = replay_stage(r, line);
  else
    st = replay_step(r, line);
  json_decref(line);
  if (st == DYD_OK && !dyd_trace_is_sealed(&r->sum, text->text, text->length))
    st = replay_fail(r, "this line, or the order of lines, was changed: its digest is another");
  return st;
}

static void replay_clear(replay *r) {
  dyd_delaunay_free(r->pd);
  dyd_sites_free(r->sites);
  for (size_t i = 0; i < r->points; i++) dyd_rect_clear(&r->point[i].rect);
  free(r->point);
  free(r->changed);
  dyd_trace_proofs_clear(&r->proofs);
  dyd_rect_clear(&r->window);
}

dyd_status dyd_trace_replay(dyd_convergence *out, FILE *in, const dyd_converge_options *converge, dyd_error *err) {
  dyd_error local;
  replay r = {.out = out, .sum = DYD_TRACE_SUM_BEGIN, .err = err ? err : &local};
  dyd_status st = dyd_abi_check(out, sizeof *out, "dyd_convergence", err);
  if (st == DYD_OK) st = dyd_abi_take(&r.converge, sizeof r.converge, converge, "dyd_converge_options", err);
  if (st != DYD_OK) return st;
  r.converge.window = NULL;
  dyd_rect_init(&r.window);
  dyd_text text;
  dyd_line line = {0};
  dyd_error_clear(r.err);
  dyd_text_init(&text, in);
  do {
    st = dyd_text_next(&line, &text, r.err);
    if (st == DYD_OK && dyd_flag_is_set(r.converge.cancel)) st = DYD_CANCELLED;
    if (st == DYD_OK && line.text) st = replay_line(&r, &line);
  } while (st == DYD_OK && line.text);
  if (st == DYD_OK && !r.ended) st = replay_fail(&r, "the trace ends before its outcome");
  if (st != DYD_OK) {
    r.err->code = st;
    if (!r.err->line) r.err->line = line.text ? line.number : text.line;
    if (!r.err->column) r.err->column = 1;
    if (!r.err->message[0]) dyd_fail(r.err, st, "%s", dyd_status_text(st));
  }
  dyd_text_clear(&text);
  replay_clear(&r);
  return st;
}
