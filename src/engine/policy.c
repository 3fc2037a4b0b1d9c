/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans changed from outside. A policy only chooses which points are narrowed: rectangles shrink whatever it answers,
 * so that no statement depends on it. Every want asks for more than its point was asked for, and a plan to which a
 * policy adds nothing stays, so that runs end as without one. */
#include "engine/policy.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/flag.h"
#include "stream/oracle_worker.h"

#include <dyadel/oracle.h>
#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- any policy ---- */

static dyd_request *policy_requests(const dyd_plan *plan) {
  dyd_request *list = dyd_alloc(plan->count, sizeof *list);
  for (size_t k = 0; list && k < plan->count; k++)
    list[k] = (dyd_request){DYD_SIZED(dyd_request), .point = dyd_plan_point(plan, &plan->item[k])->site,
                            .bits = plan->item[k].bits, .max_bits = plan->o->max_bits, .stop = &plan->e->stop};
  return list;
}

/* Calls the policy with the plan `was`, of which *plan, empty, takes the answer. */
static dyd_status policy_call(dyd_plan *plan, const dyd_request *was, size_t count, dyd_error *err) {
  const dyd_engine_options *o = plan->o;
  dyd_status st = o->policy(plan, o->policy_user, plan->e, was, count, err);
  if (plan->failed == DYD_E_ARG)
    return dyd_fail(err, DYD_E_ARG, "the policy asks for point %lu, and there are %zu: they are numbered from 0",
                    (unsigned long)plan->missing, dyd_sites_count(plan->e->sites));
  if (st > 0 && st != DYD_CANCELLED)
    return dyd_fail(err, DYD_E_ARG, "the policy returned %d; it may be DYD_OK, DYD_CANCELLED or an error", (int)st);
  return st == DYD_OK ? plan->failed : st;
}

dyd_status dyd_policy_apply(dyd_plan *plan, bool first, dyd_error *err) {
  const size_t count = plan->count;
  const bool blocked = plan->blocked;
  dyd_plan_sort(plan);
  dyd_request *was = policy_requests(plan);
  dyd_want *kept = dyd_alloc(count, sizeof *kept);
  dyd_status st = was && kept ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    memcpy(kept, plan->item, count * sizeof *kept);
    dyd_plan_empty(plan);
    plan->blocked = blocked;
    st = policy_call(plan, was, count, err);
  }
  for (size_t k = 0; st == DYD_OK && k < plan->count; k++) plan->item[k].reason = DYD_REASON_POLICY;
  const bool stays = plan->count == 0;
  for (size_t k = 0; st == DYD_OK && (stays || first) && k < count; k++) {
    const dyd_want *w = &kept[k];
    const dyd_refinable *point = dyd_plan_point(plan, w);
    if (!dyd_plan_find(plan, point)) dyd_plan_mark(plan, point, w->bits, w->reason, w->i, w->j);
  }
  dyd_free_all(kept, was);
  return st == DYD_OK ? plan->failed : st;
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

/* The undecided pairs and the plan. */
static dyd_status policy_describe(FILE *out, const dyd_engine *e, const dyd_request *request, size_t count) {
  dyd_pair_list pairs = {0};
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
  dyd_pair_list_clear(&pairs);
  return st;
}

/* Takes one line of an answer; *done: it was the last. */
static dyd_status policy_take(bool *done, dyd_plan *plan, const char *line, dyd_error *err) {
  char shown[80], site[11], bits[20], *left = bits;
  int end = 0;
  *done = strcmp(line, "go") == 0;
  if (*done) return DYD_OK;
  if (sscanf(line, "refine %10[0-9] %19[-0-9]%n", site, bits, &end) == 2 && !line[end]) {
    unsigned long long i = strtoull(site, NULL, 10);
    long long b = strtoll(bits, &left, 10);
    if (!*left) return dyd_plan_add(plan, i < UINT32_MAX ? (uint32_t)i : UINT32_MAX, b);
  }
  return dyd_fail(err, DYD_E_STREAM, "the policy program wrote %s; a line of its answer is \"refine I B\" or \"go\"",
                  dyd_quoted(shown, sizeof shown, line, strlen(line)));
}

static dyd_status policy_ask(dyd_plan *plan, void *user, const dyd_engine *e, const dyd_request *request, size_t count,
                             dyd_error *err) {
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
    if (st == DYD_OK) st = policy_take(&done, plan, line, err);
  }
  free(text);
  return st;
}

void dyd_policy_free(dyd_policy *p) {
  char how[100];
  if (!p) return;
  dyd_process_close(&p->process);
  dyd_process_ended(how, sizeof how, &p->process, 0.5);
  dyd_process_end(&p->process);
  for (int k = 0; k < 2; k++) dyd_close(&p->lifeline[k]);
  dyd_free_all(p->text, p);
}

dyd_status dyd_policy_start(dyd_policy **out, dyd_engine_options *o, dyd_error *err) {
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
