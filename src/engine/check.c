/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The harness of monotone refinement: random schedules, given ones, and cutting a failing one down to what matters. */
#include "engine/check.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include <string.h>

const char *dyd_check_fault_text(dyd_check_fault fault) {
  static const char *const text[] = {"fine", "stream", "rate", "retract", "cell", "path", "choice"};
  return (unsigned)fault < sizeof text / sizeof *text ? text[fault] : "unknown";
}

void dyd_check_report_clear(dyd_check_report *r) {
  const dyd_check_report none = {0};
  free(r->move);
  dyd_abi_give(r, &none, sizeof none);
}

/* Fills in *o, and clears the report and the error record. o->seconds becomes the end, by dyd_seconds. */
static dyd_status check_begin(dyd_check_options *o, dyd_check_report *out, const dyd_check_options *given,
                              dyd_error *err) {
  dyd_error_clear(err);
  dyd_status st = dyd_abi_check(out, sizeof *out, "dyd_check_report", err);
  if (st == DYD_OK) st = dyd_abi_take(o, sizeof *o, given, "dyd_check_options", err);
  if (st != DYD_OK) return st;
  dyd_check_report_clear(out);
  if (!o->schedules) o->schedules = 100;
  if (!o->base_bits) o->base_bits = 8;
  if (!o->max_bits) o->max_bits = 192;
  if (!o->slack_bits) o->slack_bits = 16;
  if (!o->stages) o->stages = 6;
  if (!o->cells) o->cells = 6;
  if (!o->tie_bits) o->tie_bits = DYD_TIE_BITS;
  if (o->base_bits > o->max_bits) o->base_bits = o->max_bits;
  if (o->seconds > 0) o->seconds += dyd_seconds();
  return DYD_OK;
}

typedef struct moves {
  dyd_check_move *item;
  size_t count, cap;
} moves;

/* ---- one schedule ---- */

/* DYD_E_ARG with the number of the first move that cannot be made. */
static dyd_status schedule_fits(const moves *m, const dyd_engine *e, dyd_error *err) {
  const size_t points = dyd_sites_count(e->sites);
  for (size_t k = 0; k < m->count; k++) {
    const dyd_check_move *move = &m->item[k];
    const bool early = move->stage < (k ? move[-1].stage : 1);
    if (!early && move->point < points) continue;
    if (err) err->line = k + 1;
    if (early) return dyd_fail(err, DYD_E_ARG, "stage %u is out of order; give stages from 1, ascending", move->stage);
    return dyd_fail(err, DYD_E_ARG, "there is no point %u among these %zu points; give points from 0 on", move->point,
                    points);
  }
  return DYD_OK;
}

/* Opens the points, starts the clock and asks all points for base_bits. */
static dyd_status schedule_start(dyd_check_state *s, dyd_check_open_fn open, void *user, const moves *m,
                                 dyd_error *err) {
  dyd_status st = open(&s->e, user, err);
  if (st == DYD_OK) st = schedule_fits(m, s->e, err);
  if (st == DYD_OK) s->e->tie_bits = s->o->tie_bits;
  double left = s->o->seconds > 0 ? s->o->seconds - dyd_seconds() : 0;
  if (st == DYD_OK && left < 0) return DYD_CANCELLED;
  if (st == DYD_OK) dyd_watch_start(&s->watch, left, &s->e->stop);
  for (size_t k = 0; st == DYD_OK && k < s->e->points && s->report->fault == DYD_CHECK_FINE; k++)
    st = dyd_check_narrow(s, s->e->point[k].site, s->o->base_bits);
  return st;
}

/* Runs a schedule; counters and the fault go to *report. */
static dyd_status schedule_play(dyd_check_report *report, dyd_check_open_fn open, void *user, const moves *m,
                                uint64_t seed, const dyd_check_options *o, dyd_error *err) {
  dyd_check_state s = {.o = o, .report = report, .random = seed};
  dyd_rect_init(&s.window);
  dyd_status st = schedule_start(&s, open, user, m, err);
  size_t k = 0;
  if (st == DYD_OK && report->fault == DYD_CHECK_FINE) st = dyd_check_stage(&s, m->count == 0);
  while (st == DYD_OK && report->fault == DYD_CHECK_FINE && k < m->count) {
    uint32_t stage = m->item[k].stage;
    for (; k < m->count && m->item[k].stage == stage && st == DYD_OK && report->fault == DYD_CHECK_FINE; k++)
      st = dyd_check_narrow(&s, m->item[k].point, m->item[k].bits);
    if (st == DYD_OK && report->fault == DYD_CHECK_FINE) st = dyd_check_stage(&s, k == m->count);
  }
  if (s.e) dyd_watch_stop(&s.watch);
  dyd_check_state_clear(&s);
  if (st == DYD_E_NOMEM) dyd_fail_nomem(err);
  return st;
}

/* ---- random schedules ---- */

static dyd_status moves_add(moves *m, uint32_t stage, uint32_t point, int64_t bits) {
  if (!dyd_reserve((void **)&m->item, &m->cap, m->count + 1, sizeof *m->item)) return DYD_E_NOMEM;
  m->item[m->count++] = (dyd_check_move){stage, point, bits};
  return DYD_OK;
}

/* The points that can be narrowed, and what each was asked for last. */
typedef struct askable {
  uint32_t *point;
  int64_t *asked;
  size_t count;
} askable;

static dyd_status add_step(moves *m, uint32_t stage, const askable *p, size_t at, int64_t bits) {
  p->asked[at] = bits;
  return moves_add(m, stage, p->point[at], bits);
}

/* A few points, each by one bit or two more again and again: what drifts is seen where steps are small. */
static dyd_status schedule_add_small_steps(moves *m, uint32_t stage, uint64_t *random, const askable *p, int64_t top) {
  dyd_status st = DYD_OK;
  size_t count = 1 + (size_t)dyd_check_below(random, 4);
  for (size_t k = 0; k < count; k++) {
    size_t at = (size_t)dyd_check_below(random, p->count), steps = 1 + (size_t)dyd_check_below(random, 8);
    for (size_t q = 0; q < steps && st == DYD_OK && p->asked[at] < top; q++)
      st = add_step(m, stage, p, at,
                    p->asked[at] + 1 + (int64_t)dyd_check_below(random, top - p->asked[at] > 1 ? 2 : 1));
  }
  return st;
}

/* Each point from what it was asked for to `top`: a source that fails at one precision is found. At the default
 * precision steps are of one bit or two; where there are more than MOST_STEPS of them, wider. */
static dyd_status schedule_add_walk(moves *m, uint32_t stage, uint64_t *random, const askable *p, int64_t top,
                                    int64_t span) {
  enum { MOST_STEPS = 256 };
  const uint64_t step = 2 * (uint64_t)((span + MOST_STEPS - 1) / MOST_STEPS);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < p->count; k++)
    while (st == DYD_OK && p->asked[k] < top) {
      const int64_t next = p->asked[k] + 1 + (int64_t)dyd_check_below(random, step);
      st = add_step(m, stage, p, k, next < top ? next : top);
    }
  return st;
}

/* One stage: one point; a few; about a tenth; all at one precision; all unevenly; small steps. Repeats happen. */
static dyd_status schedule_add_stage(moves *m, uint32_t stage, uint64_t *random, const askable *p,
                                     const dyd_check_options *o) {
  dyd_status st = DYD_OK;
  size_t n = p->count;
  uint64_t mode = dyd_check_below(random, 6);
  if (mode == 5) return schedule_add_small_steps(m, stage, random, p, o->max_bits);
  int64_t span = o->max_bits - o->base_bits + 1;
  int64_t top = o->base_bits + span * stage / o->stages,
          level = o->base_bits + (int64_t)dyd_check_below(random, (uint64_t)(top - o->base_bits) + 1);
  size_t count = mode == 0 ? 1 : mode == 1 ? 1 + (size_t)dyd_check_below(random, 8) : mode == 2 ? n / 10 + 1 : n;
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    size_t at = mode >= 3 ? k : (size_t)dyd_check_below(random, n);
    int64_t bits =
        mode == 3 ? level : o->base_bits + (int64_t)dyd_check_below(random, (uint64_t)(top - o->base_bits) + 1);
    st = add_step(m, stage, p, at, bits);
    if (st == DYD_OK && dyd_check_below(random, 16) == 0) st = add_step(m, stage, p, at, bits);
  }
  return st;
}

static dyd_status schedule_list_points(askable *out, dyd_check_open_fn open, void *user, dyd_error *err) {
  dyd_engine *e = NULL;
  dyd_status st = open(&e, user, err);
  if (st != DYD_OK) return st;
  *out = (askable){dyd_alloc(e->points, sizeof *out->point), dyd_alloc(e->points, sizeof *out->asked), e->points};
  if (!out->point || !out->asked) st = dyd_fail_nomem(err);
  for (size_t k = 0; k < e->points && st == DYD_OK; k++) out->point[k] = e->point[k].site;
  dyd_engine_free(e);
  return st;
}

/* The first one walks all points up to the cap. */
static dyd_status schedule_make(moves *m, uint64_t seed, const askable *p, bool first, const dyd_check_options *o) {
  const int64_t span = o->max_bits - o->base_bits;
  uint64_t random = seed;
  dyd_status st = DYD_OK;
  m->count = 0;
  for (size_t k = 0; k < p->count; k++) p->asked[k] = o->base_bits;
  for (uint32_t stage = 1; p->count && stage <= o->stages && st == DYD_OK; stage++)
    st = first ? schedule_add_walk(m, stage, &random, p, o->base_bits + span * stage / o->stages, span)
               : schedule_add_stage(m, stage, &random, p, o);
  return st;
}

/* ---- cutting down ---- */

/* Does m without [from, to) still show the fault? Then it is cut. */
static dyd_status schedule_try_without(bool *cut, moves *m, size_t from, size_t to, dyd_check_fault fault,
                                       dyd_check_open_fn open, void *user, uint64_t seed, const dyd_check_options *o) {
  moves less = {0};
  dyd_check_report report = {0};
  *cut = false;
  less.item = dyd_alloc(m->count, sizeof *less.item);
  if (!less.item) return DYD_E_NOMEM;
  memcpy(less.item, m->item, from * sizeof *less.item);
  memcpy(less.item + from, m->item + to, (m->count - to) * sizeof *less.item);
  less.count = m->count - (to - from);
  dyd_status st = schedule_play(&report, open, user, &less, seed, o, NULL);
  if (st == DYD_OK && report.fault == fault) {
    memcpy(m->item, less.item, less.count * sizeof *less.item);
    m->count = less.count;
    *cut = true;
  }
  free(less.item);
  dyd_check_report_clear(&report);
  return st;
}

/* Leaves out ever smaller parts while the fault stays, until no single move can be left out. */
static dyd_status schedule_cut_down(moves *m, dyd_check_fault fault, dyd_check_open_fn open, void *user, uint64_t seed,
                                    const dyd_check_options *o) {
  dyd_status st = DYD_OK;
  for (size_t size = m->count; size > 0 && st == DYD_OK;) {
    bool any = false;
    for (size_t from = 0; from < m->count && st == DYD_OK;) {
      size_t to = from + size < m->count ? from + size : m->count;
      bool cut;
      st = schedule_try_without(&cut, m, from, to, fault, open, user, seed, o);
      any |= cut;
      if (!cut) from = to;
    }
    if (size > 1)
      size = (size + 1) / 2;
    else if (!any)
      break;
  }
  return st;
}

/* ---- public ---- */

/* Keeps the shortest schedule that shows the fault found by m. */
static dyd_status report_keep_fault(dyd_check_report *out, moves *m, uint64_t seed, dyd_check_open_fn open, void *user,
                                    const dyd_check_options *o) {
  dyd_check_report again = {0};
  out->seed = seed;
  out->base_bits = o->base_bits;
  dyd_status st = schedule_cut_down(m, out->fault, open, user, seed, o);
  if (st == DYD_OK) st = schedule_play(&again, open, user, m, seed, o, NULL);
  if (st == DYD_OK && again.fault == out->fault) memcpy(out->message, again.message, sizeof out->message);
  dyd_check_report_clear(&again);
  out->move = m->item;
  out->moves = m->count;
  *m = (moves){0};
  return st;
}

dyd_status dyd_check_run(dyd_check_report *out, dyd_check_open_fn open, void *user, const dyd_check_options *given,
                         dyd_error *err) {
  dyd_check_options o;
  moves m = {0};
  askable points = {0};
  dyd_error unused;
  if (!err) err = &unused;
  dyd_status st = check_begin(&o, out, given, err);
  if (st == DYD_OK) st = schedule_list_points(&points, open, user, err);
  for (unsigned k = 0; k < o.schedules && st == DYD_OK && out->fault == DYD_CHECK_FINE; k++) {
    uint64_t seed = o.seed + k;
    if (o.progress) o.progress(o.progress_user, k, o.schedules);
    st = schedule_make(&m, seed, &points, k == 0, &o);
    if (st == DYD_OK) st = schedule_play(out, open, user, &m, seed, &o, err);
    if (st == DYD_OK) out->schedules++;
    if (st == DYD_OK && out->fault != DYD_CHECK_FINE) st = report_keep_fault(out, &m, seed, open, user, &o);
  }
  free(m.item);
  free(points.point);
  free(points.asked);
  return st;
}

dyd_status dyd_check_replay(dyd_check_report *out, dyd_check_open_fn open, void *user, const dyd_check_move *move,
                            size_t count, const dyd_check_options *given, dyd_error *err) {
  dyd_check_options o;
  dyd_error unused;
  if (!err) err = &unused;
  dyd_status st = check_begin(&o, out, given, err);
  if (st != DYD_OK) return st;
  moves m = {.item = dyd_alloc(count, sizeof *m.item), .count = count};
  if (!m.item) return dyd_fail_nomem(err);
  memcpy(m.item, move, count * sizeof *move);
  st = schedule_play(out, open, user, &m, o.seed, &o, err);
  out->schedules = 1;
  out->seed = o.seed;
  out->base_bits = o.base_bits;
  if (st == DYD_OK && out->fault != DYD_CHECK_FINE) {
    out->move = m.item;
    out->moves = count;
  } else {
    free(m.item);
  }
  return st;
}
