/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Traces, whose format io.h describes: written, read back into an engine (recall), and replayed.
 *
 * A line of JSON for each narrowing and for each stage, made in memory and written with the digest of all lines so far.
 * All texts are words of the library and numbers.
 *
 * Recall gives an engine the answers of a trace, which may end anywhere, also within a line: the run that wrote it may
 * have been killed. Replay puts the rectangles of a trace into a table of sites, stage by stage, and triangulates as
 * the engine did; no stream is asked. Both check that every rectangle is inside the one before [NEST-1]. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/digest.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/local.h"
#include "engine/record.h"
#include "engine/ties.h"
#include "io/json.h"
#include "io/output.h"
#include "io/read/text.h"
#include "rect/sites_table.h"

#include <dyadel/delaunay.h>
#include <dyadel/engine.h>
#include <dyadel/io.h>
#include <dyadel/stream.h>
#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FORMAT "dyadel trace 2"

/* The last goal and schedule that a trace can have. */
enum { LAST_GOAL = DYD_GOAL_VORONOI_HAUSDORFF, LAST_SCHEDULE = DYD_SCHEDULE_UNIFORM };
static const char *const relation_name[] = {
    [DYD_COINCIDENT] = "coincident", [DYD_COLLINEAR] = "collinear", [DYD_COCIRCULAR] = "cocircular"};

/* ---- writing ---- */

/* Invariant: seen[i]: point i was narrowed; NULL once the fixed points are written. json: of the line under way, which
 * is in text[0 .. size) once it is ended, without its closing bracket. sync < 0: not requested. */
struct dyd_trace {
  FILE *out, *line;
  dyd_json json;
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

/* To the disk. What cannot be synced, such as a pipe, need not be. */
static dyd_status trace_to_disk(dyd_trace *t) {
  const bool done = fflush(t->out) == 0 && (fdatasync(fileno(t->out)) == 0 || errno == EINVAL || errno == EROFS ||
                                            errno == EBADF || errno == ENOTSUP);
  t->synced = dyd_seconds();
  return done ? DYD_OK : DYD_E_IO;
}

static dyd_json *trace_open_line(dyd_trace *t) {
  dyd_json_begin(&t->json, t->line);
  dyd_json_object(&t->json, NULL, DYD_JSON_DENSE);
  return &t->json;
}

/* Ends the line. */
static dyd_status trace_line(dyd_trace *t) {
  dyd_status st = dyd_json_end(&t->json, "");
  if (st == DYD_OK && fflush(t->line) != 0) st = DYD_E_NOMEM;
  if (st != DYD_OK) return st;
  t->sum = dyd_digest(t->sum, t->text, t->size);
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
  dyd_json *j = trace_open_line(t);
  dyd_json_word(j, "format", FORMAT);
  dyd_json_index(j, "points", t->points);
  if (input) dyd_json_word(j, "input", input);
  dyd_json_schedule(j, o);
  dyd_json_index(j, "max_pairs", o->max_pairs);
  dyd_json_word(j, "of", dyd_converge_of_text(c->of));
  if (c->window) dyd_json_window(j, "window", c->window, ",");
  return trace_line(t);
}

static void trace_free(dyd_trace *t) {
  if (t->line) fclose(t->line);
  dyd_free_all(t->text, t->seen, t);
}

/* Ends the line with the rectangle. */
static dyd_status trace_rect(dyd_trace *t, const dyd_rect *r) {
  dyd_json_sides(&t->json, r);
  return trace_line(t);
}

/* An answer of an earlier trace. */
static dyd_status trace_kept(void *user, uint32_t site, int64_t bits, const dyd_rect *r, bool final) {
  dyd_json *j = trace_open_line(user);
  dyd_json_bool(j, "kept", true);
  dyd_json_index(j, "point", site);
  dyd_json_signed(j, "bits", bits);
  if (final) dyd_json_bool(j, "final", true);
  return trace_rect(user, r);
}

dyd_status dyd_trace_new(dyd_trace **out, FILE *f, const dyd_engine *e, const char *input,
                         const dyd_engine_options *options, const dyd_converge_options *converge, dyd_error *err) {
  dyd_engine_options defaults, o;
  dyd_converge_options c;
  dyd_engine_options_init(&defaults);
  dyd_status st = dyd_abi_take(&o, sizeof o, options ? options : &defaults, "dyd_engine_options", err);
  if (st == DYD_OK) st = dyd_abi_take(&c, sizeof c, converge, "dyd_converge_options", err);
  if (st != DYD_OK) return st;
  if ((unsigned)o.goal > LAST_GOAL || (unsigned)o.schedule > LAST_SCHEDULE)
    return dyd_fail(err, DYD_E_ARG, "a trace cannot hold this goal or schedule");
  dyd_trace *t = calloc(1, sizeof *t);
  if (!t) return dyd_fail_nomem(err);
  t->out = f;
  t->e = e;
  t->points = dyd_engine_count(e);
  t->sum = DYD_DIGEST_BEGIN;
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
  dyd_json *j = trace_open_line(t);
  dyd_json_index(j, "stage", step->stage);
  dyd_json_index(j, "point", step->site);
  dyd_json_signed(j, "bits", step->bits);
  dyd_json_bool(j, "called", step->called);
  dyd_json_word(j, "why", dyd_reason_text(step->reason));
  if (step->final) dyd_json_bool(j, "final", true);
  if (step->i != step->j) {
    dyd_json_array(j, "pair", DYD_JSON_FLAT);
    dyd_json_index(j, NULL, step->i);
    dyd_json_index(j, NULL, step->j);
    dyd_json_close(j, 1);
  }
  t->failed = trace_rect(t, step->rect);
}

/* Lines of the points that were not asked: they are fixed. */
static dyd_status trace_fixed(dyd_trace *t, const dyd_delaunay *pd) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, rect);
  for (size_t i = 0; st == DYD_OK && i < t->points; i++) {
    if (t->seen[i]) continue;
    st = dyd_sites_get(&rect, dyd_delaunay_sites(pd), i);
    if (st != DYD_OK) break;
    dyd_json *j = trace_open_line(t);
    dyd_json_index(j, "stage", 1);
    dyd_json_index(j, "point", i);
    dyd_json_word(j, "why", "fixed");
    st = trace_rect(t, &rect);
  }
  free(t->seen);
  t->seen = NULL;
  return st;
}

/* Writes the proofs of the stage, which rectangles do not show. */
static dyd_status trace_proofs(dyd_trace *t) {
  dyd_relation relation;
  const uint32_t *site;
  size_t count;
  for (; dyd_ties_proved(&relation, &site, &count, t->e, t->proofs); t->proofs++) {
    dyd_json *j = trace_open_line(t);
    dyd_json_word(j, "proved", relation_name[relation]);
    dyd_json_array(j, "points", DYD_JSON_FLAT);
    for (size_t k = 0; k < count; k++) dyd_json_index(j, NULL, site[k]);
    dyd_json_close(j, 1);
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
  char sum[17];
  snprintf(sum, sizeof sum, "%016" PRIx64, digest);
  dyd_json *j = trace_open_line(t);
  dyd_json_index(j, "stage", p->stage);
  dyd_json_bool(j, "done", true);
  dyd_json_index(j, "legal", p->count[DYD_LEGAL]);
  dyd_json_index(j, "indeterminate", p->count[DYD_INDETERMINATE]);
  dyd_json_index(j, "tie", p->count[DYD_TIE]);
  dyd_json_word(j, "statuses", sum);
  t->failed = trace_line(t);
}

dyd_status dyd_trace_end(dyd_trace *t, dyd_outcome outcome, dyd_error *err) {
  if (!t) return dyd_fail_null(err);
  dyd_status st = t->failed;
  dyd_json_word(trace_open_line(t), "outcome", dyd_outcome_text(outcome));
  if (st == DYD_OK) st = trace_line(t);
  if (st == DYD_OK && t->sync >= 0) st = trace_to_disk(t);
  if (st == DYD_OK)
    st = dyd_output_end(t->out, err);
  else
    dyd_fail(err, st, "%s", dyd_status_text(st));
  trace_free(t);
  return st;
}

/* ---- values in a line; each function returns false when there is none of that kind ---- */

/* Takes the sum over the line, of which it is not part, into *sum: is it the one that the line ends with? */
static bool trace_is_sealed(uint64_t *sum, const char *text, size_t length) {
  enum { SEAL = sizeof ",\"sum\":\"0123456789abcdef\"}" - 1 };
  char seal[SEAL + 1];
  if (length < SEAL) return false;
  *sum = dyd_digest(*sum, text, length - SEAL);
  snprintf(seal, sizeof seal, ",\"sum\":\"%016" PRIx64 "\"}", *sum);
  return memcmp(text + length - SEAL, seal, SEAL) == 0;
}

static bool trace_integer(int64_t *out, const json_t *line, const char *name, int64_t least, int64_t most) {
  const json_t *value = json_object_get(line, name);
  if (!json_is_integer(value)) return false;
  *out = json_integer_value(value);
  return *out >= least && *out <= most;
}

static bool trace_has_text(const json_t *line, const char *name, const char *wanted) {
  const char *text = json_string_value(json_object_get(line, name));
  return text && strcmp(text, wanted) == 0;
}

/* The rational ends of an interval, as texts. */
static bool trace_rationals(dyd_interval *out, const char *lo, const char *hi) {
  DYD_LOCAL_NUMBERS(mpq, a, b);
  return dyd_real_parse_exact(a, lo, strlen(lo)) == DYD_OK && dyd_real_parse_exact(b, hi, strlen(hi)) == DYD_OK &&
         dyd_interval_set_ends_q(out, a, b) == DYD_OK;
}

/* Texts at `from` and behind it; dyadics of any size. */
static bool trace_ends(dyd_interval *out, const json_t *list, size_t from) {
  const char *lo = json_string_value(json_array_get(list, from)),
             *hi = json_string_value(json_array_get(list, from + 1));
  if (!lo || !hi) return false;
  if (strchr(lo, '/') || strchr(hi, '/')) return trace_rationals(out, lo, hi);
  DYD_LOCAL(dyd_dyadic, a, b);
  return dyd_dyadic_set_str(&a, lo, NULL) == DYD_OK && dyd_dyadic_set_str(&b, hi, NULL) == DYD_OK &&
         dyd_interval_set_ends(out, &a, &b) == DYD_OK;
}

/* The side "x" or "y" of a rectangle. */
static bool read_side(dyd_interval *out, const json_t *line, const char *name) {
  const json_t *side = json_object_get(line, name);
  return json_array_size(side) == 2 && trace_ends(out, side, 0);
}

/* ---- proofs, which replace the expressions that are not in a trace ---- */

typedef struct trace_proof {
  dyd_relation relation;
  size_t count;
  uint32_t *site;
} trace_proof;

/* Init with {0}. Sites are below `points`; joined: the number of proofs already examined for equal points. */
typedef struct proof_list {
  trace_proof *item;
  size_t count, cap, joined;
} proof_list;

static void trace_proofs_clear(proof_list *p) {
  for (size_t k = 0; k < p->count; k++) free(p->item[k].site);
  free(p->item);
  *p = (proof_list){0};
}

static bool proof_relation(dyd_relation *out, const char *name) {
  for (int k = DYD_COINCIDENT; name && k <= DYD_COCIRCULAR; k++)
    if (strcmp(name, relation_name[k]) == 0) {
      *out = (dyd_relation)k;
      return true;
    }
  return false;
}

/* Reads the line {"proved":RELATION,"points":[...]}. DYD_E_PARSE: it is none; DYD_E_NOMEM. */
static dyd_status trace_proofs_read(proof_list *p, const json_t *line, size_t points) {
  const json_t *list = json_object_get(line, "points");
  trace_proof proof = {.count = json_array_size(list)};
  if (proof.count < 2 || !proof_relation(&proof.relation, json_string_value(json_object_get(line, "proved"))))
    return DYD_E_PARSE;
  if (!DYD_GROW(p->item, p->cap, p->count + 1)) return DYD_E_NOMEM;
  proof.site = dyd_alloc(proof.count, sizeof *proof.site);
  if (!proof.site) return DYD_E_NOMEM;
  for (size_t k = 0; k < proof.count; k++) {
    const json_t *number = json_array_get(list, k);
    json_int_t site = json_is_integer(number) ? json_integer_value(number) : -1;
    if (site < 0 || (uint64_t)site >= points) return free(proof.site), DYD_E_PARSE;
    proof.site[k] = (uint32_t)site;
  }
  p->item[p->count++] = proof;
  return DYD_OK;
}

/* A dyd_prove_fn; user is a proof_list. */
static dyd_status trace_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                              dyd_error *err) {
  const proof_list *p = user;
  (void)err;
  *proved = false;
  for (size_t k = 0; k < p->count && !*proved; k++)
    *proved = p->item[k].relation == relation && p->item[k].count == count &&
              memcmp(p->item[k].site, site, count * sizeof *site) == 0;
  return DYD_OK;
}

/* Joins sites that are the same since the last call; *any: some are. */
static dyd_status trace_join(bool *any, proof_list *p, dyd_sites *sites) {
  dyd_status st = DYD_OK;
  *any = false;
  for (; p->joined < p->count && st == DYD_OK; p->joined++) {
    const trace_proof *proof = &p->item[p->joined];
    if (proof->relation != DYD_COINCIDENT) continue;
    st = dyd_sites_join(sites, proof->site[0], proof->site[1]);
    *any = true;
  }
  return st;
}

/* ---- recall ---- */

typedef struct trace_recall {
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
} trace_recall;

static dyd_status recall_fail(const trace_recall *r, const char *what) {
  return dyd_fail(r->err, DYD_E_PARSE, "%s; give a trace that dyadel wrote of these points", what);
}

static dyd_status recall_head(trace_recall *r, const json_t *line) {
  int64_t points;
  const char *input = json_string_value(json_object_get(line, "input"));
  if (!trace_has_text(line, "format", FORMAT)) return recall_fail(r, "this is no trace of the format \"" FORMAT "\"");
  if (!trace_integer(&points, line, "points", 0, INT64_MAX)) return recall_fail(r, "the number of points is missing");
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
static dyd_status recall_answer(trace_recall *r, size_t point, int64_t bits, const dyd_rect *rect, bool final) {
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

static dyd_status recall_step(trace_recall *r, const json_t *line) {
  int64_t point, bits;
  if (!trace_integer(&point, line, "point", 0, (int64_t)r->points - 1)) return recall_fail(r, "there is no such point");
  const bool kept = json_is_true(json_object_get(line, "kept"));
  if (!kept && !json_is_true(json_object_get(line, "called"))) return DYD_OK;
  if (!trace_integer(&bits, line, "bits", INT64_MIN, INT64_MAX)) return recall_fail(r, "the bits asked are missing");
  if (!kept && bits <= r->kept[point]) return DYD_OK; /* this answer was one of those kept */
  if (kept) r->kept[point] = bits;
  DYD_LOCAL(dyd_rect, rect);
  return read_side(&rect.x, line, "x") && read_side(&rect.y, line, "y")
             ? recall_answer(r, (size_t)point, bits, &rect, json_is_true(json_object_get(line, "final")))
             : recall_fail(r, "this is no rectangle");
}

static dyd_status recall_line(trace_recall *r, const json_t *line) {
  if (!json_is_object(line)) return recall_fail(r, "this line is no JSON object");
  if (!r->had) return recall_head(r, line);
  if (r->ended) return recall_fail(r, "the trace has lines after its outcome");
  r->ended = json_object_get(line, "outcome") != NULL;
  return json_object_get(line, "point") ? recall_step(r, line) : DYD_OK;
}

/* All lines; the last one is ignored if it was cut short. */
static dyd_status recall_lines(trace_recall *r, dyd_text *text) {
  dyd_text_line line = {0};
  dyd_status st = dyd_text_next(&line, text, r->err);
  while (st == DYD_OK && line.text) {
    r->err->line = line.number;
    json_t *value = json_loadb(line.text, line.length, JSON_REJECT_DUPLICATES, NULL);
    bool cut = !value && text->ended && text->start == text->end && r->had;
    st = cut ? DYD_OK : recall_line(r, value);
    if (st == DYD_OK && !cut && !trace_is_sealed(&r->sum, line.text, line.length))
      st = recall_fail(r, "this line, or the order of lines, was changed: its digest is another");
    r->report.cut = cut;
    json_decref(value);
    if (st == DYD_OK) st = dyd_text_next(&line, text, r->err);
  }
  return st == DYD_OK && !r->had ? recall_fail(r, "the file is empty") : st;
}

dyd_status dyd_trace_recall(dyd_recall_report *out, dyd_engine *e, FILE *in, const char *input, dyd_error *err) {
  dyd_error local;
  trace_recall r = {.e = e,
                    .input = input,
                    .sum = DYD_DIGEST_BEGIN,
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
  dyd_free_all(r.last, r.had, r.kept);
  return st;
}

/* ---- replay ---- */

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
  proof_list proofs;
  bool ended;
} replay;

static dyd_status replay_fail(const replay *r, const char *what) {
  return dyd_fail(r->err, DYD_E_PARSE, "%s; give a trace as dyadel wrote it", what);
}

/* A goal and a schedule by their words; false when there is none of that name. */
static bool replay_goal(dyd_engine_options *o, const json_t *line) {
  int goal = 0, schedule = 0;
  while (goal <= LAST_GOAL && !trace_has_text(line, "goal", dyd_goal_text((dyd_goal)goal))) goal++;
  while (schedule <= LAST_SCHEDULE && !trace_has_text(line, "schedule", dyd_schedule_text((dyd_schedule)schedule)))
    schedule++;
  o->goal = (dyd_goal)goal;
  o->schedule = (dyd_schedule)schedule;
  return goal <= LAST_GOAL && schedule <= LAST_SCHEDULE;
}

/* The window of the bounds of V, when one was given. */
static bool replay_window(replay *r, const json_t *line) {
  const json_t *list = json_object_get(line, "window");
  int of = 0;
  while (of < DYD_CONVERGE_DISC && !trace_has_text(line, "of", dyd_converge_of_text((dyd_converge_of)of))) of++;
  r->converge.of = (dyd_converge_of)of;
  if (!list) return true;
  r->converge.window = &r->window;
  return json_array_size(list) == 4 && trace_ends(&r->window.x, list, 0) && trace_ends(&r->window.y, list, 2) &&
         !dyd_interval_is_point(&r->window.x) && !dyd_interval_is_point(&r->window.y);
}

static dyd_status replay_head(replay *r, const json_t *line) {
  int64_t points, max_pairs;
  dyd_engine_options *o = r->out->options;
  if (!o) o = r->out->options = malloc(sizeof *o);
  if (!o) return dyd_fail_nomem(r->err);
  dyd_engine_options_init(o);
  if (!trace_has_text(line, "format", FORMAT)) return replay_fail(r, "this is no trace of the format \"" FORMAT "\"");
  if (!trace_integer(&points, line, "points", 0, (int64_t)DYD_MAX_SITES) ||
      !trace_integer(&o->goal_bits, line, "goal_bits", INT64_MIN, INT64_MAX) ||
      !trace_integer(&o->start_bits, line, "start_bits", INT64_MIN, INT64_MAX) ||
      !trace_integer(&o->step_bits, line, "step_bits", 0, INT64_MAX) ||
      !trace_integer(&o->max_bits, line, "max_bits", INT64_MIN, INT64_MAX) ||
      !trace_integer(&max_pairs, line, "max_pairs", 0, INT64_MAX) || !replay_goal(o, line) || !replay_window(r, line))
    return replay_fail(r, "the first line lacks a field, or has a wrong one");
  if (r->converge.of >= DYD_CONVERGE_DISC)
    return dyd_fail(r->err, DYD_E_PARSE,
                    "this trace is not of a triangulation, and cannot be replayed; resume the run from it");
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
  if (st == DYD_OK && !DYD_GROW(r->changed, r->change_cap, r->changes + 1)) st = DYD_E_NOMEM;
  if (st != DYD_OK) return dyd_fail(r->err, st, "%s", dyd_status_text(st));
  if (called) r->changed[r->changes++] = (uint32_t)i;
  return DYD_OK;
}

static dyd_status replay_step(replay *r, const json_t *line) {
  int64_t point;
  if (!trace_integer(&point, line, "point", 0, (int64_t)r->points - 1)) return replay_fail(r, "there is no such point");
  replay_point *p = &r->point[point];
  bool fixed = trace_has_text(line, "why", "fixed"), called = json_is_true(json_object_get(line, "called"));
  if (!fixed && !trace_integer(&p->bits, line, "bits", INT64_MIN, INT64_MAX))
    return replay_fail(r, "the bits asked are missing");
  if (!fixed) p->asked = true;
  if (called) r->calls++;
  DYD_LOCAL(dyd_rect, rect);
  return read_side(&rect.x, line, "x") && read_side(&rect.y, line, "y") ? replay_rect(r, (size_t)point, &rect, called)
                                                                        : replay_fail(r, "this is no rectangle");
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
    if (!trace_integer(&count, line, dyd_pair_status_text((dyd_pair_status)k), 0, INT64_MAX) ||
        (size_t)count != row->count[k])
      return false;
  return trace_has_text(line, "statuses", digest);
}

/* Again, when points are the same. */
static dyd_status replay_triangulate(replay *r, const dyd_delaunay_options *o) {
  bool joined = true;
  dyd_status st = DYD_OK;
  while (joined && st == DYD_OK) {
    st = r->pd ? dyd_delaunay_update(r->pd, r->changed, r->changes, o, r->err) : replay_first_result(r, o);
    if (st == DYD_CAPPED) st = DYD_OK; /* a result as well */
    if (st == DYD_OK) st = trace_join(&joined, &r->proofs, r->sites);
    if (st == DYD_E_NESTING) return replay_fail(r, "points that are said to be the same are apart");
  }
  return st;
}

static dyd_status replay_proof(replay *r, const json_t *line) {
  dyd_status st = trace_proofs_read(&r->proofs, line, r->points);
  return st == DYD_E_PARSE ? replay_fail(r, "no such proof about points is known") : st;
}

static dyd_status replay_stage(replay *r, const json_t *line) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = r->out->options->max_pairs,
                                  .cancel = r->converge.cancel, .prove = trace_prove, .prove_user = &r->proofs};
  dyd_stage_row *row;
  dyd_status st = replay_triangulate(r, &o);
  if (st != DYD_OK) return st;
  r->changes = 0;
  st = dyd_convergence_add(&row, r->out, r->pd, &r->converge, false, r->err);
  if (st != DYD_OK) return st;
  replay_count_bits(row, r);
  if (r->converge.stage) r->converge.stage(r->converge.stage_user, row, r->pd);
  if (replay_agrees(row, line)) return DYD_OK;
  return dyd_fail(r->err, DYD_E_PARSE, "the statuses of this stage differ from those in the trace");
}

static dyd_status replay_outcome(replay *r, const json_t *line) {
  for (int k = DYD_OUTCOME_NONE; k <= DYD_OUTCOME_ERROR; k++) {
    if (!trace_has_text(line, "outcome", dyd_outcome_text((dyd_outcome)k))) continue;
    r->out->outcome = (dyd_outcome)k;
    r->ended = true;
    return DYD_OK;
  }
  return replay_fail(r, "there is no such outcome");
}

static dyd_status replay_line(replay *r, const dyd_text_line *text) {
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
    st = replay_fail(r, "the trace has lines after its outcome");
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
  if (st == DYD_OK && !trace_is_sealed(&r->sum, text->text, text->length))
    st = replay_fail(r, "this line, or the order of lines, was changed: its digest is another");
  return st;
}

static void replay_clear(replay *r) {
  dyd_delaunay_free(r->pd);
  dyd_sites_free(r->sites);
  for (size_t i = 0; i < r->points; i++) dyd_rect_clear(&r->point[i].rect);
  dyd_free_all(r->point, r->changed);
  trace_proofs_clear(&r->proofs);
  dyd_rect_clear(&r->window);
}

dyd_status dyd_trace_replay(dyd_convergence *out, FILE *in, const dyd_converge_options *converge, dyd_error *err) {
  dyd_error local;
  replay r = {.out = out, .sum = DYD_DIGEST_BEGIN, .err = err ? err : &local};
  dyd_status st = dyd_abi_check(out, sizeof *out, "dyd_convergence", err);
  if (st == DYD_OK) st = dyd_abi_take(&r.converge, sizeof r.converge, converge, "dyd_converge_options", err);
  if (st != DYD_OK) return st;
  r.converge.window = NULL;
  dyd_rect_init(&r.window);
  dyd_text text;
  dyd_text_line line = {0};
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
