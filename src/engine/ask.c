/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The loop: ask, narrow what the question wants, triangulate if it uses the triangulation, ask again
 * (mathematics: section 7).
 *
 * Between stages the checks come in this order, and the first that holds is the outcome:
 *   cancelled; the question is answered; nothing can be narrowed (pairs, when the cap was met; bits, when a larger
 *   max_bits would allow more; otherwise fixpoint); stages, calls, seconds spent.
 * Stages, calls and seconds are counted for each ask on its own, bits and pairs are absolute.
 *
 * A stage that is cut short leaves everything valid, because rectangles only shrink:
 * - calls used up, or a stream failed: narrowed points are brought into the result, which is then complete for the
 * rectangles as they are. In the first stage the result does not exist before all points have been asked.
 *   - cancelled or out of time: narrowed sites stay listed in `changed`; the statements of the result were made for the
 *     wider rectangles of its last stage, and hold for the narrower ones as well (legal and illegal are for ever,
 *     the possible pairs listed include all that are possible now). The next run begins by bringing it up to date.
 * Points narrowed are never asked for the same again, so a later ask continues where this one stopped. */
#include "engine/ask.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/float_filter.h"
#include "base/local.h"
#include "base/parallel.h"
#include "delaunay/extend.h"
#include "delaunay/memory.h"
#include "dyadic/numeral.h"
#include "engine/points.h"
#include "engine/settle.h"
#include "engine/ties.h"
#include "engine/wants.h"
#include "stream/process.h"
#include "stream/stream.h"

#include <dyadel/oracle.h>
#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Wants changed from outside. A policy only chooses which points are narrowed: rectangles shrink whatever it answers,
 * so that no statement depends on it. Every want asks for more than its point was asked for, and wants to which a
 * policy adds nothing stay, so that runs end as without one. */

/* ---- any policy ---- */

static dyd_request *policy_requests(const dyd_wants *wants) {
  dyd_request *list = dyd_alloc(wants->count, sizeof *list);
  for (size_t k = 0; list && k < wants->count; k++)
    list[k] = (dyd_request){DYD_SIZED(dyd_request), .point = dyd_wants_point(wants, &wants->item[k])->site,
                            .bits = wants->item[k].bits, .max_bits = wants->o->max_bits, .stop = &wants->e->stop};
  return list;
}

/* Calls the policy with the wants `was`, of which *wants, empty, takes the answer. */
static dyd_status policy_call(dyd_wants *wants, const dyd_request *was, size_t count, dyd_error *err) {
  const dyd_engine_options *o = wants->o;
  dyd_status st = o->policy(wants, o->policy_user, wants->e, was, count, err);
  if (wants->failed == DYD_E_ARG)
    return dyd_fail(err, DYD_E_ARG, "the policy asks for point %lu, and there are %zu: they are numbered from 0",
                    (unsigned long)wants->missing, dyd_sites_count(wants->e->sites));
  if (st > 0 && st != DYD_CANCELLED)
    return dyd_fail(err, DYD_E_ARG, "the policy returned %d; it may be DYD_OK, DYD_CANCELLED or an error", (int)st);
  return st == DYD_OK ? wants->failed : st;
}

/* Puts *wants, not empty, to the policy of wants->o; stage: the one that it is for. What the policy adds replaces
 * them. If it adds nothing, they stay. first: points that it does not name stay in them. DYD_CANCELLED when
 * e->stop was seen. */
static dyd_status dyd_policy_apply(dyd_wants *wants, bool first, dyd_error *err) {
  const size_t count = wants->count;
  const bool blocked = wants->blocked;
  dyd_wants_sort(wants);
  DYD_FREED dyd_request *was = policy_requests(wants);
  DYD_FREED dyd_want *kept = dyd_alloc(count, sizeof *kept);
  dyd_status st = was && kept ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    memcpy(kept, wants->item, count * sizeof *kept);
    dyd_wants_empty(wants);
    wants->blocked = blocked;
    st = policy_call(wants, was, count, err);
  }
  for (size_t k = 0; st == DYD_OK && k < wants->count; k++) wants->item[k].reason = DYD_REASON_POLICY;
  const bool stays = wants->count == 0;
  for (size_t k = 0; st == DYD_OK && (stays || first) && k < count; k++) {
    const dyd_want *w = &kept[k];
    const dyd_refinable *point = dyd_wants_point(wants, w);
    if (!dyd_wants_find(wants, point)) dyd_wants_mark(wants, point, w->bits, w->reason, w->i, w->j);
  }
  return st == DYD_OK ? wants->failed : st;
}

/* ---- a program ---- */

/* Invariant: of text, `taken` bytes are lines that were read. */
struct dyd_policy {
  dyd_process process;
  int lifeline[2];
  double seconds;
  char *text;
  size_t length, taken, cap;
};

/* Until a pipe of the program can be used. */
static dyd_status policy_wait(const dyd_policy *p, int fd, short events, const volatile int *stop, dyd_error *err) {
  enum { SLICE = 50 }; /* milliseconds */
  const double until = dyd_seconds() + p->seconds;
  struct pollfd at = {.fd = fd, .events = events};
  while (poll(&at, 1, SLICE) <= 0) {
    if (dyd_flag_is_set(stop)) return DYD_CANCELLED;
    if (dyd_seconds() >= until)
      return dyd_fail(err, DYD_E_STREAM,
                      "the policy program was silent for %g seconds; it must answer each \"choose\" by a line \"go\"",
                      p->seconds);
  }
  return DYD_OK;
}

static dyd_status policy_gone(const dyd_policy *p, dyd_error *err) {
  char how[100];
  if (!dyd_process_ended(how, sizeof how, &p->process, 0.5)) strcpy(how, "it has closed a pipe");
  return dyd_fail(err, DYD_E_STREAM, "the policy program: %s; it must answer until its input ends", how);
}

static dyd_status policy_send(const dyd_policy *p, const char *text, size_t length, const volatile int *stop,
                              dyd_error *err) {
  dyd_status st = DYD_OK;
  while (length && st == DYD_OK) {
    size_t done;
    dyd_written how = dyd_process_write(&done, &p->process, text, length);
    text += done;
    length -= done;
    if (how == DYD_WRITE_BROKEN) return policy_gone(p, err);
    if (length) st = policy_wait(p, p->process.in, POLLOUT, stop, err);
  }
  return st;
}

/* The next line, without its end; borrowed until the next call. */
static dyd_status policy_hear(char **line, dyd_policy *p, const volatile int *stop, dyd_error *err) {
  enum { READ = 4096 };
  char *end;
  memmove(p->text, p->text + p->taken, p->length - p->taken);
  p->length -= p->taken;
  p->taken = 0;
  for (size_t seen = 0; !(end = memchr(p->text + seen, '\n', p->length - seen));) {
    seen = p->length;
    if (p->length > DYD_ORACLE_LINE)
      return dyd_fail(err, DYD_E_STREAM, "the policy program wrote a line of more than %zu bytes", DYD_ORACLE_LINE);
    dyd_status st = policy_wait(p, p->process.out, POLLIN, stop, err);
    if (st != DYD_OK) return st;
    if (!dyd_reserve((void **)&p->text, &p->cap, p->length + READ, 1)) return dyd_fail_nomem(err);
    ssize_t n = read(p->process.out, p->text + p->length, READ);
    if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return policy_gone(p, err);
    if (n > 0) p->length += (size_t)n;
  }
  *end = 0;
  if (end > p->text && end[-1] == '\r') end[-1] = 0;
  *line = p->text;
  p->taken = (size_t)(end - p->text) + 1;
  return DYD_OK;
}

/* The undecided pairs and the wants. */
static dyd_status policy_describe(FILE *out, const dyd_engine *e, const dyd_request *request, size_t count) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = e->pd ? dyd_delaunay_pairs(&pairs, e->pd) : DYD_OK;
  fprintf(out, "stage %" PRIu64 " points %zu\n", e->stages + 1, dyd_sites_count(e->sites));
  for (size_t k = 0; k < pairs.count; k++)
    if (pairs.item[k].status == DYD_INDETERMINATE)
      fprintf(out, "pair %" PRIu32 " %" PRIu32 "\n", pairs.item[k].i, pairs.item[k].j);
  for (size_t k = 0; k < count; k++) {
    const dyd_request *r = dyd_request_at(request, k);
    fprintf(out, "plan %zu %" PRId64 "\n", r->point, r->bits);
  }
  fputs("choose\n", out);
  return st;
}

/* Takes one line of an answer; *done: it was the last. */
static dyd_status policy_take(bool *done, dyd_wants *wants, const char *line, dyd_error *err) {
  static const char word[] = "refine";
  const size_t length = strlen(line);
  size_t from = sizeof word - 1;
  char shown[80];
  dyd_numeral site;
  int64_t bits;
  *done = strcmp(line, "go") == 0;
  if (*done) return DYD_OK;
  const bool refine = strncmp(line, word, from) == 0;
  while (refine && dyd_is_blank(line[from])) from++;
  if (refine && dyd_literal_scan(&site, line, length, from, 0) && site.digits <= 10 &&
      dyd_integer_scan(&bits, line + site.end, length - site.end, DYD_NUMBER_MINUS | DYD_NUMBER_INDENT, INT64_MIN,
                       INT64_MAX))
    return dyd_wants_add(wants, site.man < UINT32_MAX ? (uint32_t)site.man : UINT32_MAX, bits);
  return dyd_fail(err, DYD_E_STREAM, "the policy program wrote %s; a line of its answer is \"refine I B\" or \"go\"",
                  dyd_quoted(shown, sizeof shown, line, length));
}

static dyd_status policy_ask(dyd_wants *wants, void *user, const dyd_engine *e, const dyd_request *request,
                             size_t count, dyd_error *err) {
  dyd_policy *p = user;
  char *text = NULL, *line = NULL;
  size_t length = 0;
  bool done = false;
  FILE *out = open_memstream(&text, &length);
  dyd_status st = out ? policy_describe(out, e, request, count) : DYD_E_NOMEM;
  if (out && fclose(out) != 0) st = DYD_E_NOMEM;
  if (st == DYD_OK) st = policy_send(p, text, length, &e->stop, err);
  while (st == DYD_OK && !done) {
    st = policy_hear(&line, p, &e->stop, err);
    if (st == DYD_OK) st = policy_take(&done, wants, line, err);
  }
  free(text);
  return st;
}

/* Ends the program. NULL is allowed. */
static void dyd_policy_free(dyd_policy *p) {
  char how[100];
  if (!p) return;
  dyd_process_close(&p->process);
  dyd_process_ended(how, sizeof how, &p->process, 0.5);
  dyd_process_end(&p->process);
  for (int k = 0; k < 2; k++) dyd_close(&p->lifeline[k]);
  dyd_free_all(p->text, p);
}

/* Starts o->policy_program, if there is one, and makes it o's policy; *out: NULL if there is none. */
static dyd_status dyd_policy_start(dyd_policy **out, dyd_engine_options *o, dyd_error *err) {
  *out = NULL;
  if (!o->policy_program) return DYD_OK;
  if (o->policy) return dyd_fail(err, DYD_E_ARG, "`policy` and `policy_program` are mutually exclusive");
  dyd_policy *p = calloc(1, sizeof *p);
  if (!p) return dyd_fail_nomem(err);
  p->seconds = o->policy_seconds > 0 ? o->policy_seconds : DYD_ORACLE_SECONDS;
  p->process = (dyd_process){.in = -1, .out = -1};
  dyd_status st = dyd_pipe(p->lifeline) && dyd_reserve((void **)&p->text, &p->cap, 1, 1) ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_process_start(&p->process, o->policy_program, 0, p->lifeline[0], err);
  if (st != DYD_OK) {
    dyd_policy_free(p);
    return st == DYD_E_NOMEM ? dyd_fail_nomem(err) : st;
  }
  o->policy = policy_ask;
  o->policy_user = p;
  *out = p;
  return DYD_OK;
}

/* What points take in memory, now and when they are narrower. */

/* Ends that doubles do not hold are kept by the stream, and packed in the table of sites: four numbers each. */
enum { ENDS = 8, END = 24 };

static uint64_t bytes_of_ends(int64_t bits) {
  return bits > 53 ? ENDS * ((uint64_t)bits / 8 + END) : 0;
}

/* What the points take: their rectangles, records and streams. O(points). */
static uint64_t engine_point_bytes(const dyd_engine *e) {
  uint64_t bytes = dyd_sites_memory(e->sites) + e->point_cap * sizeof *e->point + e->change_cap * sizeof *e->changed +
                   dyd_labels_bytes(&e->labels);
  for (size_t k = 0; k < e->points; k++) {
    const dyd_refinable *p = &e->point[k];
    bytes += dyd_stream_bytes(p->stream) + (p->asked ? bytes_of_ends(p->bits) / 2 : 0); /* half is in the table */
  }
  return bytes;
}

/* Sets the budget of everything made of the result later: `most` bytes less the memory of the points; 0: no bound. */
static void engine_allow(dyd_engine *e, uint64_t most) {
  const dyd_memory memory = {.most = most, .beside = most ? engine_point_bytes(e) : 0};
  if (e->pd) dyd_delaunay_allow(e->pd, dyd_memory_left(&memory));
}

/* What carrying out wants will take beside that: longer ends, and the digits computed with. O(wants). */
static uint64_t wants_bytes(const dyd_wants *p) {
  uint64_t stays = dyd_bytes_times(p->count, sizeof *p->item), most = 0;
  for (size_t k = 0; k < p->count; k++) {
    const dyd_refinable *point = dyd_wants_point(p, &p->item[k]);
    uint64_t work = dyd_stream_work_bytes(point->stream, p->item[k].bits);
    stays = dyd_bytes_add(stays, bytes_of_ends(p->item[k].bits) - (point->asked ? bytes_of_ends(point->bits) : 0));
    if (work > most) most = work;
  }
  return dyd_bytes_add(stays, most);
}

/* What judging the result takes: bounds list all pairs, and those of the diagram have two numbers a cell. O(points). */
static uint64_t goal_bytes(const dyd_engine *e, const dyd_engine_options *o) {
  if (o->goal == DYD_GOAL_DECIDED) return 0;
  uint64_t bytes = dyd_pairs_bytes(e->pd, dyd_goal_is_voronoi(o->goal) ? dyd_least_bounding_true(e->pd) : DYD_TIE);
  if (dyd_goal_is_voronoi(o->goal)) bytes += 2 * sizeof(double) * dyd_sites_count(e->sites);
  return bytes + (o->goal == DYD_GOAL_VORONOI_HAUSDORFF ? dyd_triangles_bytes(e->pd) : 0);
}

/* The clock of a run, and a helper thread that raises a flag at the deadline. */

/* Longer limits than this, about thirty years, are none. */
#define LONGEST 1e9

static void *watch_wait(void *arg) {
  dyd_watch *w = arg;
  int late = 0;
  pthread_mutex_lock(&w->lock);
  while (!w->over && !late) late = pthread_cond_timedwait(&w->bell, &w->lock, &w->deadline);
  if (!w->over) __atomic_store_n(w->flag, 1, __ATOMIC_SEQ_CST);
  pthread_mutex_unlock(&w->lock);
  return NULL;
}

static bool watch_init_bell(pthread_cond_t *bell) {
  pthread_condattr_t attr;
  if (pthread_condattr_init(&attr)) return false;
  bool done = !pthread_condattr_setclock(&attr, CLOCK_MONOTONIC) && !pthread_cond_init(bell, &attr);
  pthread_condattr_destroy(&attr);
  return done;
}

static bool watch_start_helper(dyd_watch *w) {
  if (pthread_mutex_init(&w->lock, NULL)) return false;
  if (watch_init_bell(&w->bell)) {
    if (dyd_start_helpers(&w->thread, 1, watch_wait, w)) return true;
    pthread_cond_destroy(&w->bell);
  }
  pthread_mutex_destroy(&w->lock);
  return false;
}

void dyd_watch_start(dyd_watch *w, double seconds, volatile int *flag) {
  w->start = dyd_seconds();
  w->seconds = seconds;
  w->limited = seconds > 0 && seconds < LONGEST;
  w->running = w->over = false;
  w->flag = flag;
  if (!w->limited) return;
  double end = w->start + seconds;
  w->deadline.tv_sec = (time_t)end;
  w->deadline.tv_nsec = (long)((end - (double)w->deadline.tv_sec) * 1e9);
  w->running = watch_start_helper(w);
}

void dyd_watch_stop(dyd_watch *w) {
  if (!w->running) return;
  pthread_mutex_lock(&w->lock);
  w->over = true;
  pthread_cond_signal(&w->bell);
  pthread_mutex_unlock(&w->lock);
  pthread_join(w->thread, NULL);
  pthread_cond_destroy(&w->bell);
  pthread_mutex_destroy(&w->lock);
  w->running = false;
}

/* Wall-clock seconds since the start. */
static double watch_seconds(const dyd_watch *w) {
  return dyd_seconds() - w->start;
}

/* Returns true if a deadline is set and has passed. */
static bool watch_is_late(const dyd_watch *w) {
  return w->limited && watch_seconds(w) >= w->seconds;
}

/* One ask. end is DYD_OUTCOME_NONE until it is known how it ends; again: the wants just carried out asked for the
 * question before the triangulation; bits: the greatest precision asked for in this stage. */
typedef struct ask {
  dyd_engine *e;
  const dyd_question *q;
  dyd_engine_options o; /* defaults filled in */
  dyd_refinable *guest;
  dyd_wants wants;
  dyd_watch watch;
  dyd_memory memory;
  uint64_t stages, calls;
  int64_t bits;
  bool again;
  dyd_outcome end;
  dyd_budget spent;
  dyd_error err;
} ask;

/* The finest request that streams take (stream/real.c). */
#define MOST_BITS (DYD_EXP_LIMIT - 64)

#define MOST_TIE_BITS ((int64_t)1 << 26)

const char *dyd_ask_options(dyd_engine_options *o) {
  if (o->max_bits == 0) o->max_bits = DYD_BITS_ENOUGH;
  if (o->max_bits > MOST_BITS) o->max_bits = MOST_BITS;
  if (o->tie_bits == 0) o->tie_bits = DYD_TIE_BITS;
  if (o->tie_bits > MOST_TIE_BITS) o->tie_bits = MOST_TIE_BITS;
  if (o->start_bits > o->max_bits) o->start_bits = o->max_bits;
  if (o->tie_bits < 0) return "`tie_bits` is below 0; give bits from 1 on, or 0 for the default";
  if (o->start_bits < -DYD_EXP_LIMIT) return "`start_bits` is below -1048576; give that or more";
  if (!(o->seconds >= 0)) return "`seconds` is below 0 or no number; give a time above 0, or 0 for no limit";
  return o->step_bits < 0 ? "`step_bits` is below 0; give bits from 1 on, or 0 for growing steps" : NULL;
}

/* ---- how it ends ---- */

static void ask_end_budget(ask *a, dyd_budget spent) {
  a->end = DYD_OUTCOME_BUDGET;
  a->spent = spent;
}

/* Ends it when it was cancelled or is out of time. */
static bool ask_is_stopped(ask *a) {
  if (dyd_flag_get(&a->e->cancelled))
    a->end = DYD_OUTCOME_CANCELLED;
  else if (watch_is_late(&a->watch))
    ask_end_budget(a, DYD_BUDGET_SECONDS);
  return a->end != DYD_OUTCOME_NONE;
}

/* Work was interrupted: by a cancel, by a question that gave up, or because e->stop was raised at the deadline. */
static dyd_status ask_end_interrupted(ask *a) {
  if (dyd_flag_get(&a->e->cancelled) || !dyd_flag_get(&a->e->stop))
    a->end = DYD_OUTCOME_CANCELLED;
  else
    ask_end_budget(a, DYD_BUDGET_SECONDS);
  return DYD_OK;
}

static bool ask_calls_are_spent(const ask *a) {
  return a->o.max_calls && a->calls >= a->o.max_calls;
}

/* Nothing is to be narrowed: why? */
static void ask_end_exhausted(ask *a) {
  if (a->e->cut && ask_is_stopped(a)) return;
  if (a->q->triangulate && dyd_delaunay_is_capped(a->e->pd)) {
    a->err = a->e->cap_error;
    ask_end_budget(a, DYD_BUDGET_PAIRS);
  } else if (a->wants.blocked) {
    ask_end_budget(a, DYD_BUDGET_BITS);
  } else {
    a->end = DYD_OUTCOME_FIXPOINT;
  }
}

/* ---- memory ---- */

/* Checks the budget for carrying out the wants. */
static dyd_status ask_room_to_narrow(ask *a) {
  if (!a->memory.most) return DYD_OK;
  a->memory.beside = engine_point_bytes(a->e);
  a->memory.held = a->e->pd ? dyd_delaunay_memory(a->e->pd) : 0;
  return dyd_memory_has(&a->memory, wants_bytes(&a->wants), "narrowing the points") ? DYD_OK : DYD_E_NOMEM;
}

/* What the points leave for the triangulation; 0: no bound. */
static dyd_status ask_room_to_triangulate(uint64_t *left, ask *a) {
  *left = 0;
  if (!a->memory.most) return DYD_OK;
  a->memory.beside = engine_point_bytes(a->e);
  a->memory.held = a->e->pd ? dyd_delaunay_memory(a->e->pd) : 0;
  *left = a->memory.most > a->memory.beside ? a->memory.most - a->memory.beside : 1;
  return dyd_memory_has(&a->memory, 1, "the points") ? DYD_OK : DYD_E_NOMEM;
}

/* The result exists, and its peak is known; checks the budget for judging it. */
static dyd_status ask_room_to_judge(ask *a) {
  dyd_delaunay_counters c = {DYD_SIZED(dyd_delaunay_counters)};
  if (!a->memory.most) return DYD_OK;
  dyd_status st = dyd_delaunay_get_counters(&c, a->e->pd, &a->err);
  if (st != DYD_OK) return st;
  uint64_t peak = a->memory.beside + c.bytes_most;
  if (peak > a->memory.peak) a->memory.peak = peak;
  a->memory.held = dyd_delaunay_memory(a->e->pd);
  return dyd_memory_has(&a->memory, goal_bytes(a->e, &a->o), "the bound") ? DYD_OK : DYD_E_NOMEM;
}

/* ---- narrowing ---- */

/* Reports the step by which p was narrowed for w. */
static dyd_status ask_tell_step(const ask *a, const dyd_refinable *p, const dyd_want *w, bool called) {
  DYD_LOCAL(dyd_rect, rect);
  dyd_status st = dyd_sites_get(&rect, a->e->sites, p->site);
  dyd_step step = {DYD_SIZED(dyd_step), .stage = a->e->stages + 1, .site = p->site,
                   .bits = w->bits,     .reason = w->reason,       .called = called};
  step.i = w->i;
  step.j = w->j;
  step.rect = &rect;
  step.final = p->final;
  if (st == DYD_OK) a->o.trace(a->o.trace_user, &step);
  return st;
}

/* Carries out one want. *err is as dyd_engine_narrow leaves it. */
static dyd_status ask_narrow(ask *a, const dyd_want *w) {
  dyd_engine *e = a->e;
  bool guest = w->point < a->q->guests;
  dyd_refinable *p = guest ? &a->guest[w->point] : &e->point[w->point - a->q->guests];
  uint64_t calls = 0;
  dyd_status st = dyd_engine_narrow(p, &calls, e, w->bits, a->o.max_bits, &a->err);
  a->calls += calls;
  if (!guest) e->calls += calls;
  if (st == DYD_CANCELLED) return ask_end_interrupted(a);
  if (st != DYD_OK) return st;
  if (w->bits > a->bits) a->bits = w->bits;
  if (calls && !guest) dyd_engine_note_change(e, p->site);
  return a->o.trace && !guest ? ask_tell_step(a, p, w, calls != 0) : DYD_OK;
}

/* Carries out the wants; *cut: points are left because calls are used up. */
static dyd_status ask_narrow_all(bool *cut, ask *a) {
  dyd_engine *e = a->e;
  size_t need = e->pd ? e->changes + a->wants.count : 0;
  if (!DYD_GROW(e->changed, e->change_cap, need)) return DYD_E_NOMEM;
  dyd_wants_sort(&a->wants);
  dyd_status st = ask_room_to_narrow(a);
  if (st != DYD_OK) return st;
  dyd_wants_announce(&a->wants, a->o.max_calls ? a->o.max_calls - a->calls : UINT64_MAX);
  for (size_t k = 0; k < a->wants.count; k++) {
    if (ask_is_stopped(a)) return DYD_OK;
    *cut = ask_calls_are_spent(a);
    if (*cut) return DYD_OK;
    st = ask_narrow(a, &a->wants.item[k]);
    if (st != DYD_OK || a->end != DYD_OUTCOME_NONE) return st;
  }
  return DYD_OK;
}

/* ---- triangulating ---- */

/* Adds the sites of all undecided faces to those changed, so that faces given up at a cap are worked on again. */
static dyd_status ask_list_undecided(dyd_engine *e) {
  dyd_status st = DYD_OK;
  dyd_index_list sites = {0};
  size_t faces = dyd_delaunay_undecided_faces(e->pd);
  for (size_t f = 0; st == DYD_OK && f < faces; f++) {
    bool outer;
    st = dyd_delaunay_face(&sites, &outer, e->pd, f);
    size_t need = e->changes + sites.count;
    if (st == DYD_OK && !DYD_GROW(e->changed, e->change_cap, need)) st = DYD_E_NOMEM;
    for (size_t k = 0; st == DYD_OK && k < sites.count; k++) e->changed[e->changes++] = sites.item[k];
    dyd_index_list_clear(&sites);
  }
  return st;
}

static void ask_report(const ask *a) {
  const dyd_engine *e = a->e;
  dyd_progress p = {DYD_SIZED(dyd_progress), .stage = e->stages, .sites = dyd_sites_count(e->sites)};
  p.bits = a->bits == INT64_MIN ? 0 : a->bits;
  dyd_delaunay_count(p.count, e->pd);
  p.undecided_faces = dyd_delaunay_undecided_faces(e->pd);
  p.seconds = e->seconds + watch_seconds(&a->watch);
  a->o.progress(a->o.progress_user, &p);
}

/* Did the first result stop before all faces were closed? What there is counts. */
static bool ask_was_cut(const dyd_engine *e, const dyd_delaunay_options *o) {
  return o->keep_cut && dyd_flag_get(&e->stop) && dyd_delaunay_is_capped(e->pd);
}

/* The first result of these points: the one before they came, extended, or a new one. */
static dyd_status ask_begin_result(dyd_engine *e, const dyd_delaunay_options *o, dyd_error *err) {
  dyd_delaunay *former = e->former;
  bool fits = false;
  e->former = NULL;
  const bool proved = !o->prove || e->proof_bits >= e->tie_bits;
  dyd_status st = former && proved ? dyd_delaunay_extend(&fits, former, o, err) : DYD_OK;
  if (fits) return e->pd = former, st;
  dyd_delaunay_free(former);
  return dyd_delaunay_new(&e->pd, e->sites, o, err);
}

/* Makes the result, or brings it up to date; again, when sites turn out to be the same place. */
static dyd_status ask_settle(dyd_engine *e, const dyd_delaunay_options *o, dyd_error *err) {
  bool joined = true;
  dyd_status st = DYD_OK;
  while (joined && st == DYD_OK) {
    joined = false;
    dyd_error_clear(err);
    st = e->pd ? dyd_delaunay_update(e->pd, e->changed, e->changes, o, err) : ask_begin_result(e, o, err);
    if (st == DYD_CAPPED) {
      e->cap_error = *err;
      st = DYD_OK;
    }
    if (st == DYD_OK && ask_was_cut(e, o)) return st;
    if (st == DYD_OK && o->prove) st = dyd_aliases_find(&joined, e, e->pd, err);
    /* should this be cut short, the next run sees that the result is not up to date */
    if (st == DYD_OK && joined && !e->changes) st = DYD_GROW(e->changed, e->change_cap, 1) ? DYD_OK : DYD_E_NOMEM;
    if (st == DYD_OK && joined && !e->changes) e->changed[e->changes++] = 0;
  }
  return st;
}

/* Returns true if more may be asked of the site, and neither side has a core that stays wide. */
static bool ask_narrows(void *user, uint32_t site) {
  const ask *a = user;
  const dyd_refinable *p = dyd_engine_find(a->e, site);
  if (!p || p->final || p->bits >= a->o.max_bits) return false;
  DYD_LOCAL(dyd_rect, r);
  bool core[2], narrows = dyd_site_get_core(&r, core, a->e, site) == DYD_OK;
  return narrows && (!core[0] || dyd_interval_is_point(&r.x)) && (!core[1] || dyd_interval_is_point(&r.y));
}

/* Makes the result, or brings it up to date, and reports. failed: no stage follows. */
static dyd_status ask_triangulate(ask *a, bool failed, dyd_error *err) {
  dyd_engine *e = a->e;
  uint64_t max_bytes;
  const dyd_prover prover = dyd_engine_prover(e, &a->o);
  dyd_status st = ask_room_to_triangulate(&max_bytes, a);
  if (st != DYD_OK) return st;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options),
                                  .max_pairs = a->o.max_pairs,
                                  .cancel = &e->stop,
                                  .threads = a->o.threads,
                                  .no_filter = a->o.no_filter,
                                  .prove = prover.prove,
                                  .prove_user = prover.user,
                                  .keep_cut = !e->pd,
                                  .narrows = e->postpones && !failed ? ask_narrows : NULL,
                                  .narrows_user = a,
                                  .max_bytes = max_bytes};
  st = ask_settle(e, &o, err);
  if (st == DYD_CANCELLED) return ask_end_interrupted(a);
  if (st != DYD_OK) return st;
  e->max_pairs = a->o.max_pairs;
  e->cut = ask_was_cut(e, &o) || (o.narrows && dyd_delaunay_is_capped(e->pd));
  e->proof_bits = o.prove ? a->o.tie_bits : 0;
  e->changes = 0;
  e->stages++;
  a->stages++;
  if (a->o.progress) ask_report(a);
  a->bits = INT64_MIN;
  return ask_room_to_judge(a);
}

/* ---- the loop ---- */

/* Returns true if something was narrowed that is to be brought into the result before the question comes again. */
static bool ask_is_stale(const ask *a) {
  return a->q->triangulate && a->e->pd && a->e->changes && !a->again;
}

/* Calls the question. */
static dyd_status ask_question(bool *answered, ask *a) {
  *answered = false;
  dyd_wants_empty(&a->wants);
  dyd_status st = a->q->ask(answered, &a->wants, a->q->user, a->e, &a->err);
  if (a->wants.failed == DYD_E_ARG)
    return dyd_fail(&a->err, DYD_E_ARG, "the question asks for site %lu, and there are %zu: they are numbered from 0",
                    (unsigned long)a->wants.missing, dyd_sites_count(a->e->sites));
  if (st > 0 && st != DYD_CANCELLED)
    return dyd_fail(&a->err, DYD_E_ARG, "the question returned %d; it may be DYD_OK, DYD_CANCELLED or an error",
                    (int)st);
  return st == DYD_OK ? a->wants.failed : st;
}

/* Asks: ends it, or something is wanted. */
static dyd_status ask_judge(ask *a) {
  bool answered;
  dyd_status st = ask_question(&answered, a);
  if (st == DYD_CANCELLED) return ask_end_interrupted(a);
  if (st == DYD_OK && answered) a->end = DYD_OUTCOME_DECIDED;
  if (st == DYD_OK && !answered && !a->wants.count && !a->again) ask_end_exhausted(a);
  return st;
}

/* Prepares the next stage: its wants, or how it ends. */
static dyd_status ask_prepare(ask *a) {
  const dyd_engine *e = a->e;
  dyd_status st = DYD_OK;
  dyd_error_clear(&a->err);
  if (dyd_flag_get(&e->cancelled))
    a->end = DYD_OUTCOME_CANCELLED;
  else if (a->q->triangulate && !e->pd)
    dyd_wants_first(&a->wants);
  else if (!ask_is_stale(a))
    st = ask_judge(a);
  if (st == DYD_OK) st = a->wants.failed;
  if (st != DYD_OK || a->end != DYD_OUTCOME_NONE) return st;
  if (a->o.max_stages && a->stages >= a->o.max_stages)
    ask_end_budget(a, DYD_BUDGET_STAGES);
  else if (a->wants.count && ask_calls_are_spent(a) && !a->again)
    ask_end_budget(a, DYD_BUDGET_CALLS);
  else if (!ask_is_stopped(a) && a->o.policy && a->wants.count)
    st = dyd_policy_apply(&a->wants, a->q->triangulate && !e->pd, &a->err);
  return st == DYD_CANCELLED ? ask_end_interrupted(a) : st;
}

/* Carries out the wants, and triangulates if the question uses that. */
static dyd_status ask_stage(ask *a) {
  bool cut = false;
  dyd_error ignored;
  const dyd_engine *e = a->e;
  dyd_status failed = ask_narrow_all(&cut, a);
  if (a->end != DYD_OUTCOME_NONE) return DYD_OK;
  a->again = a->wants.again && !cut && failed == DYD_OK;
  dyd_wants_empty(&a->wants);
  if (!a->q->triangulate || a->again) return failed;
  if (cut && !e->pd) ask_end_budget(a, DYD_BUDGET_CALLS);
  if ((cut || failed != DYD_OK) && (!e->pd || e->changes == 0)) return failed;
  dyd_status st = ask_triangulate(a, failed != DYD_OK, failed != DYD_OK ? &ignored : &a->err);
  return failed != DYD_OK ? failed : st;
}

/* Requests the first precision of guests in any case: a question about an unknown point has no answer. */
static dyd_status ask_guests(ask *a) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < a->q->guests; k++) {
    dyd_refinable *p = &a->guest[k];
    uint64_t calls = 0;
    p->site = (uint32_t)(dyd_sites_count(a->e->sites) + k);
    p->stream = a->q->guest[k];
    p->final = dyd_stream_is_final(p->stream);
    if (!p->final) st = dyd_engine_narrow(p, &calls, a->e, dyd_bits_first(&a->o), a->o.max_bits, &a->err);
    a->calls += calls;
  }
  return st;
}

/* A question about rectangles has seen the rectangles reached, however it ends. */
static dyd_status ask_last(ask *a) {
  bool answered, stopped = a->end == DYD_OUTCOME_CANCELLED || a->spent == DYD_BUDGET_SECONDS;
  if (a->q->triangulate || !stopped) return DYD_OK;
  dyd_status st = ask_question(&answered, a);
  if (st == DYD_CANCELLED) return DYD_OK;
  if (st == DYD_OK && answered) a->end = DYD_OUTCOME_DECIDED;
  return st;
}

static dyd_status ask_loop(ask *a) {
  const dyd_engine *e = a->e;
  /* Does the cap now given, or the time, allow more than the one the result met? 0 is the default cap. Or may more ties
   * be proved? */
  bool more = e->pd && dyd_delaunay_is_capped(e->pd) && (e->cut || e->max_pairs != a->o.max_pairs);
  bool proofs = e->pd && !a->o.no_ties && e->proof_bits < a->o.tie_bits;
  dyd_status st = a->q->triangulate && (more || proofs) ? ask_list_undecided(a->e) : DYD_OK;
  if (st == DYD_OK) st = ask_guests(a);
  while (st == DYD_OK && a->end == DYD_OUTCOME_NONE) {
    st = ask_prepare(a);
    if (st == DYD_OK && a->end == DYD_OUTCOME_NONE) st = ask_stage(a);
  }
  return st == DYD_OK ? ask_last(a) : st;
}

/* The loop with the clock running and the flags set. */
static dyd_status ask_timed(ask *a) {
  dyd_engine *e = a->e;
  if (__atomic_exchange_n(&e->busy, 1, __ATOMIC_SEQ_CST)) return dyd_ask_may_begin(e, &a->err);
  dyd_flag_set(&e->stop, 0); /* where that undoes a cancel, `cancelled` is seen before any work */
  e->started = true;
  e->tie_bits = a->o.tie_bits;
  a->memory = (dyd_memory){.most = a->o.max_bytes};
  e->memory = &a->memory;
  if (a->q->triangulate) engine_allow(e, a->o.max_bytes);
  dyd_watch_start(&a->watch, a->o.seconds, &e->stop);
  dyd_status st = ask_loop(a);
  dyd_watch_stop(&a->watch);
  e->memory = NULL;
  if (a->q->triangulate) engine_allow(e, a->o.max_bytes);
  if (a->memory.peak > e->bytes_most) e->bytes_most = a->memory.peak;
  e->seconds += watch_seconds(&a->watch);
  dyd_flag_set(&e->busy, 0);
  if (st == DYD_OK && a->end == DYD_OUTCOME_CANCELLED) dyd_flag_set(&e->cancelled, 0);
  return st;
}

static dyd_status ask_run(ask *a) {
  a->guest = calloc(a->q->guests + 1, sizeof *a->guest);
  dyd_wants_init(&a->wants, a->e, &a->o, a->guest, a->q->guests);
  dyd_status st = a->guest ? ask_timed(a) : DYD_E_NOMEM;
  dyd_wants_clear(&a->wants);
  free(a->guest);
  return st;
}

dyd_status dyd_ask_may_begin(const dyd_engine *e, dyd_error *err) {
  if (!dyd_engine_is_busy(e)) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG,
                  "the engine is at work: no callback of it, and no other thread, may start another run or question");
}

dyd_status dyd_ask(dyd_outcome *outcome, dyd_budget *spent, dyd_engine *e, const dyd_question *question,
                   const dyd_engine_options *options, dyd_error *err) {
  dyd_question q;
  dyd_policy *policy = NULL;
  ask a = {.e = e, .q = &q, .bits = INT64_MIN};
  dyd_error_clear(&a.err);
  dyd_status st = dyd_ask_may_begin(e, &a.err);
  if (st == DYD_OK) st = dyd_float_check(&a.err);
  if (st == DYD_OK) st = dyd_abi_take(&q, sizeof q, question, "dyd_question", &a.err);
  if (st == DYD_OK) st = dyd_abi_take(&a.o, sizeof a.o, options, "dyd_engine_options", &a.err);
  const char *wrong = st != DYD_OK ? NULL : q.ask ? dyd_ask_options(&a.o) : "the question is empty";
  if (wrong) st = dyd_fail(&a.err, DYD_E_ARG, "%s", wrong);
  if (st == DYD_OK) st = dyd_policy_start(&policy, &a.o, &a.err);
  if (st == DYD_OK) st = ask_run(&a);
  dyd_policy_free(policy);
  if (st == DYD_E_NOMEM && a.memory.refused) dyd_fail_memory(&a.err, &a.memory);
  if (st != DYD_OK && !a.err.message[0]) dyd_fail(&a.err, st, "%s", dyd_status_text(st));
  if (st != DYD_OK) a.err.code = st;
  if (st == DYD_OK && a.spent != DYD_BUDGET_PAIRS) dyd_error_clear(&a.err);
  *outcome = st == DYD_OK ? a.end : DYD_OUTCOME_ERROR;
  *spent = st == DYD_OK ? a.spent : DYD_BUDGET_NONE;
  if (err) *err = a.err;
  return st;
}

dyd_status dyd_engine_ask(dyd_outcome *outcome, dyd_engine *e, const dyd_question *question,
                          const dyd_engine_options *options, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_budget spent;
  return dyd_ask(outcome, &spent, e, question, options, err);
}
