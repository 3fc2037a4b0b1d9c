/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Writing a trace: one line of JSON for each narrowing and for each stage. All texts are our own words and numbers, so
 * nothing needs escaping. A line is made in memory, and written with the digest of all lines so far. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "engine/digest.h"
#include "engine/recall.h"
#include "engine/ties.h"
#include "io/decimal.h"
#include "io/output.h"
#include "io/parts.h"
#include "io/trace.h"
#include "io/trace_values.h"
#include <dyadel/io.h>
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Invariant: seen[i] tells whether point i was narrowed; NULL once the fixed points are written. line: what is written
 * of the line under way, in text[0 .. size) once it is flushed. sync < 0: nobody asked for it. */
struct dyd_trace {
  FILE *out, *line;
  char *text;
  size_t size;
  uint64_t sum;
  double sync, synced; /* seconds; of dyd_seconds */
  const dyd_engine *e;
  size_t proofs; /* written */
  size_t points;
  bool *seen;
  dyd_status failed;
};

/* ---- lines ---- */

/* To the disk. What cannot be synced, such as a pipe, need not be. */
static dyd_status trace_to_disk(dyd_trace *t) {
  const bool done = fflush(t->out) == 0 && (fdatasync(fileno(t->out)) == 0 || errno == EINVAL || errno == EROFS ||
                                            errno == EBADF || errno == ENOTSUP);
  t->synced = dyd_seconds();
  return done ? DYD_OK : DYD_E_IO;
}

/* Ends the line. */
static dyd_status trace_line(dyd_trace *t) {
  if (fflush(t->line) != 0) return DYD_E_NOMEM;
  t->sum = dyd_trace_sum(t->sum, t->text, t->size);
  fwrite(t->text, 1, t->size, t->out);
  fprintf(t->out, ",\"sum\":\"%016" PRIx64 "\"}\n", t->sum);
  rewind(t->line);
  return t->sync >= 0 && dyd_seconds() - t->synced >= t->sync ? trace_to_disk(t) : DYD_OK;
}

dyd_status dyd_trace_sync(dyd_trace *t, double seconds, dyd_error *err) {
  if (!t || !(seconds >= 0)) return dyd_fail(err, DYD_E_ARG, "a trace, and a number of seconds from 0 on, are needed");
  t->sync = seconds;
  return trace_to_disk(t) == DYD_OK ? DYD_OK : dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno));
}

static dyd_status trace_head(dyd_trace *t, const char *input, const dyd_engine_options *o,
                             const dyd_converge_options *c) {
  dyd_status st = DYD_OK;
  fprintf(t->line, "{\"format\":\"" DYD_TRACE_FORMAT "\",\"points\":%zu", t->points);
  if (input) fprintf(t->line, ",\"input\":\"%s\"", input);
  fprintf(t->line,
          ",\"schedule\":\"%s\",\"goal\":\"%s\",\"goal_bits\":%" PRId64 ",\"start_bits\":%" PRId64
          ",\"step_bits\":%" PRId64 ",\"max_bits\":%" PRId64 ",\"max_pairs\":%zu",
          dyd_schedule_text(o->schedule), dyd_goal_text(o->goal), o->goal_bits, o->start_bits, o->step_bits,
          o->max_bits, o->max_pairs);
  if (c->no_voronoi) fputs(",\"no_voronoi\":true", t->line);
  if (c->window) {
    fputs(",\"window\":[", t->line);
    st = dyd_put_window(t->line, c->window, "\"", ",");
    fputs("]", t->line);
  }
  return st == DYD_OK ? trace_line(t) : st;
}

static void trace_free(dyd_trace *t) {
  if (t->line) fclose(t->line);
  free(t->text);
  free(t->seen);
  free(t);
}

static dyd_status trace_side(FILE *out, const char *name, const dyd_interval *a) {
  char *lo = dyd_end_text(a, false), *hi = dyd_end_text(a, true);
  dyd_status st = lo && hi ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) fprintf(out, ",\"%s\":[\"%s\",\"%s\"]", name, lo, hi);
  free(lo);
  free(hi);
  return st;
}

/* Ends the line with the rectangle. */
static dyd_status trace_rect(dyd_trace *t, const dyd_rect *r) {
  dyd_status st = trace_side(t->line, "x", &r->x);
  if (st == DYD_OK) st = trace_side(t->line, "y", &r->y);
  return st == DYD_OK ? trace_line(t) : st;
}

/* An answer of an earlier trace. */
static dyd_status trace_kept(void *user, uint32_t site, int64_t bits, const dyd_rect *r, bool final) {
  dyd_trace *t = user;
  fprintf(t->line, "{\"kept\":true,\"point\":%" PRIu32 ",\"bits\":%" PRId64, site, bits);
  if (final) fputs(",\"final\":true", t->line);
  return trace_rect(t, r);
}

dyd_status dyd_trace_new(dyd_trace **out, FILE *f, const dyd_engine *e, const char *input,
                         const dyd_engine_options *options, const dyd_converge_options *converge, dyd_error *err) {
  dyd_engine_options defaults, o;
  dyd_converge_options c;
  dyd_engine_options_init(&defaults);
  dyd_status st = dyd_abi_take(&o, sizeof o, options ? options : &defaults, "dyd_engine_options", err);
  if (st == DYD_OK) st = dyd_abi_take(&c, sizeof c, converge, "dyd_converge_options", err);
  if (st != DYD_OK) return st;
  if ((unsigned)o.goal > DYD_TRACE_GOAL || (unsigned)o.schedule > DYD_TRACE_SCHEDULE)
    return dyd_fail(err, DYD_E_ARG, "a trace cannot tell of this goal or schedule");
  dyd_trace *t = calloc(1, sizeof *t);
  if (!t) return dyd_fail_nomem(err);
  t->out = f;
  t->e = e;
  t->points = dyd_engine_count(e);
  t->sum = DYD_TRACE_SUM_BEGIN;
  t->sync = -1;
  t->seen = calloc(t->points + 1, sizeof *t->seen);
  t->line = open_memstream(&t->text, &t->size);
  if (!t->seen || !t->line) {
    trace_free(t);
    return dyd_fail_nomem(err);
  }
  t->failed = trace_head(t, input, &o, &c);
  if (t->failed == DYD_OK) t->failed = dyd_recall_each(e->recall, trace_kept, t);
  *out = t;
  return DYD_OK;
}

void dyd_trace_step(void *trace, const dyd_step *step) {
  dyd_trace *t = trace;
  if (t->failed != DYD_OK) return;
  if (t->seen) t->seen[step->site] = true;
  fprintf(t->line, "{\"stage\":%" PRIu64 ",\"point\":%" PRIu32 ",\"bits\":%" PRId64 ",\"called\":%s,\"why\":\"%s\"",
          step->stage, step->site, step->bits, step->called ? "true" : "false", dyd_reason_text(step->reason));
  if (step->final) fputs(",\"final\":true", t->line);
  if (step->i != step->j) fprintf(t->line, ",\"pair\":[%" PRIu32 ",%" PRIu32 "]", step->i, step->j);
  t->failed = trace_rect(t, step->rect);
}

/* Lines of the points that were not asked: they are fixed. */
static dyd_status trace_fixed(dyd_trace *t, const dyd_delaunay *pd) {
  dyd_status st = DYD_OK;
  dyd_rect rect;
  dyd_rect_init(&rect);
  for (size_t i = 0; st == DYD_OK && i < t->points; i++) {
    if (t->seen[i]) continue;
    st = dyd_sites_get(&rect, dyd_delaunay_sites(pd), i);
    fprintf(t->line, "{\"stage\":1,\"point\":%zu,\"why\":\"fixed\"", i);
    if (st == DYD_OK) st = trace_rect(t, &rect);
  }
  dyd_rect_clear(&rect);
  free(t->seen);
  t->seen = NULL;
  return st;
}

const char *const dyd_trace_relations[3] = {
    [DYD_COINCIDENT] = "coincident", [DYD_COLLINEAR] = "collinear", [DYD_COCIRCULAR] = "cocircular"};

/* What was proved in the stage: rectangles do not tell. */
static dyd_status trace_proofs(dyd_trace *t) {
  dyd_relation relation;
  const uint32_t *site;
  size_t count;
  for (; dyd_ties_proved(&relation, &site, &count, t->e, t->proofs); t->proofs++) {
    fprintf(t->line, "{\"proved\":\"%s\",\"points\":[", dyd_trace_relations[relation]);
    for (size_t k = 0; k < count; k++) fprintf(t->line, k ? ",%" PRIu32 : "%" PRIu32, site[k]);
    fputs("]", t->line);
    dyd_status st = trace_line(t);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

void dyd_trace_stage(void *trace, const dyd_progress *p) {
  dyd_trace *t = trace;
  uint64_t digest;
  const dyd_delaunay *pd = dyd_engine_delaunay(t->e);
  if (t->failed == DYD_OK && t->seen) t->failed = trace_fixed(t, pd);
  if (t->failed == DYD_OK) t->failed = dyd_digest_pairs(&digest, pd);
  if (t->failed == DYD_OK) t->failed = trace_proofs(t);
  if (t->failed != DYD_OK) return;
  fprintf(t->line,
          "{\"stage\":%" PRIu64
          ",\"done\":true,\"legal\":%zu,\"indeterminate\":%zu,\"tie\":%zu,\"statuses\":\"%016" PRIx64 "\"",
          p->stage, p->count[DYD_LEGAL], p->count[DYD_INDETERMINATE], p->count[DYD_TIE], digest);
  t->failed = trace_line(t);
}

dyd_status dyd_trace_end(dyd_trace *t, dyd_outcome outcome, dyd_error *err) {
  if (!t) return dyd_fail_null(err);
  dyd_status st = t->failed;
  fprintf(t->line, "{\"outcome\":\"%s\"", dyd_outcome_text(outcome));
  if (st == DYD_OK) st = trace_line(t);
  if (st == DYD_OK && t->sync >= 0) st = trace_to_disk(t);
  if (st == DYD_OK)
    st = dyd_output_end(t->out, err);
  else
    dyd_fail(err, st, "%s", dyd_status_text(st));
  trace_free(t);
  return st;
}
