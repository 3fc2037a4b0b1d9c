/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Nearest sites of a computable point: narrow the point and the sites concerned until one is surely nearest.
 *
 * Only sites that are possibly nearest matter: where i is not listed, its distance to every point of the query is above
 * the least dl of some other site, and stays so [NEAR-3]. The result pd serves as an index; sites narrowed since it was
 * made only make its boxes wider than they need be. Precision goes up in levels, as in schedule.c: at each level
 * whoever concerned was asked for less is asked for the level. */
#include "engine/engine.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "engine/watch.h"
#include <dyadel/voronoi.h>

/* The finest request that streams take (stream/nest.c). */
#define MOST_BITS (DYD_EXP_LIMIT - 64)

/* asked: the precision `at` was asked for; level: the one worked towards. */
typedef struct query {
  dyd_engine *e;
  dyd_stream *at;
  int64_t asked, level, max_bits;
  uint64_t calls, max_calls;
  dyd_watch watch;
  dyd_index_list near;
  bool sure;
  dyd_outcome end;
  dyd_error err;
} query;

static dyd_status set_options(query *q, double *seconds, const dyd_engine_options *given) {
  dyd_engine_options o;
  dyd_status st = dyd_abi_take(&o, sizeof o, given, "dyd_engine_options", &q->err);
  if (st != DYD_OK) return st;
  q->level = o.start_bits ? o.start_bits : 64;
  q->max_bits = o.max_bits ? o.max_bits : 4096;
  q->max_calls = o.max_calls ? o.max_calls : UINT64_MAX;
  *seconds = o.seconds;
  if (q->max_bits > MOST_BITS) q->max_bits = MOST_BITS;
  if (q->level > q->max_bits) q->level = q->max_bits;
  if (q->level >= -DYD_EXP_LIMIT && o.seconds >= 0) return DYD_OK;
  return dyd_fail(&q->err, DYD_E_ARG, "an option of the query is out of its range");
}

/* Ends the query when it was cancelled, or time or calls are used up. */
static bool is_stopped(query *q) {
  if (dyd_flag_get(&q->e->cancelled))
    q->end = DYD_OUTCOME_CANCELLED;
  else if (dyd_watch_is_late(&q->watch) || q->calls >= q->max_calls)
    q->end = DYD_OUTCOME_BUDGET;
  return q->end != DYD_OUTCOME_NONE;
}

static dyd_status narrow_query(query *q) {
  uint64_t before = dyd_stream_stage(q->at);
  dyd_status status = dyd_stream_narrow(q->at, q->level, q->max_bits, &q->err);
  q->calls += dyd_stream_stage(q->at) - before;
  q->asked = q->level;
  return status < 0 ? status : DYD_OK;
}

static dyd_status narrow_site(query *q, dyd_refinable *p) {
  dyd_engine *e = q->e;
  uint64_t calls = 0;
  if (!dyd_reserve((void **)&e->changed, &e->change_cap, e->changes + 1, sizeof *e->changed)) return DYD_E_NOMEM;
  dyd_status status = dyd_engine_narrow(p, &calls, e, q->level, q->max_bits, &q->err);
  q->calls += calls;
  e->calls += calls;
  if (status == DYD_CANCELLED && !is_stopped(q)) q->end = DYD_OUTCOME_BUDGET; /* its deadline came */
  if (status == DYD_OK && calls) e->changed[e->changes++] = p->site;
  return status < 0 ? status : DYD_OK;
}

/* Brings whoever is concerned to the level. *any: somebody was below it; *open: somebody can still be narrowed. */
static dyd_status refine(bool *any, bool *open, query *q) {
  dyd_status status = DYD_OK;
  *any = *open = false;
  if (!dyd_stream_is_final(q->at) && q->asked < q->level) {
    *any = true;
    status = narrow_query(q);
  }
  *open = !dyd_stream_is_final(q->at);
  for (size_t k = 0; status >= 0 && k < q->near.count; k++) {
    dyd_refinable *p = dyd_engine_find(q->e, q->near.item[k]);
    if (!p || p->final) continue;
    if (is_stopped(q)) return status;
    *open = true;
    if (p->asked && p->bits >= q->level) continue;
    *any = true;
    status = narrow_site(q, p);
  }
  return status;
}

/* Refines until something was, or the end of the query is known. */
static dyd_status advance(query *q) {
  bool any = false, open = false;
  dyd_status status = DYD_OK;
  while (!is_stopped(q)) {
    status = refine(&any, &open, q);
    if (status < 0 || any || q->end != DYD_OUTCOME_NONE) break;
    if (q->level == q->max_bits || !open) {
      q->end = open ? DYD_OUTCOME_BUDGET : DYD_OUTCOME_FIXPOINT;
      break;
    }
    int64_t size = q->level < 0 ? -q->level : q->level;
    q->level += size < 16 ? 16 : size;
    if (q->level > q->max_bits) q->level = q->max_bits;
  }
  return status;
}

static dyd_status look(query *q) {
  const dyd_rect *r = dyd_stream_rect(q->at);
  if (!r) return dyd_fail(&q->err, DYD_E_STREAM, "the point asked about has no rectangle after it was narrowed");
  return dyd_nearest_rect(&q->near, &q->sure, q->e->pd, r);
}

static dyd_status loop(query *q) {
  dyd_status status = dyd_stream_is_final(q->at) ? DYD_OK : narrow_query(q);
  if (status >= 0) status = look(q);
  while (status >= 0 && q->end == DYD_OUTCOME_NONE && !q->sure && q->near.count) {
    status = advance(q);
    if (status >= 0) status = look(q);
  }
  if (status >= 0 && q->sure) q->end = DYD_OUTCOME_DECIDED;
  if (status >= 0 && !q->near.count) q->end = DYD_OUTCOME_FIXPOINT; /* there are no sites */
  return status;
}

static dyd_status run(query *q, double seconds) {
  dyd_engine *e = q->e;
  dyd_flag_set(&e->stop, 0);
  if (dyd_flag_get(&e->cancelled)) dyd_flag_set(&e->stop, 1);
  dyd_watch_start(&q->watch, seconds, &e->stop);
  dyd_status status = loop(q);
  dyd_watch_stop(&q->watch);
  if (q->end == DYD_OUTCOME_CANCELLED) dyd_flag_set(&e->cancelled, 0);
  if (status < 0 && !q->err.message[0]) dyd_fail(&q->err, status, "%s", dyd_status_text(status));
  return status;
}

dyd_status dyd_engine_nearest(dyd_index_list *out, bool *sure, dyd_outcome *outcome, dyd_engine *e, dyd_stream *at,
                              const dyd_engine_options *options, dyd_error *err) {
  query q = {.e = e, .at = at, .asked = INT64_MIN, .end = DYD_OUTCOME_NONE};
  double seconds = 0;
  dyd_error_clear(&q.err);
  dyd_status status = e->pd ? set_options(&q, &seconds, options)
                            : dyd_fail(&q.err, DYD_E_ARG, "there is no result yet: run the engine first");
  if (status == DYD_OK) status = run(&q, seconds);
  if (status >= 0) {
    dyd_index_list_clear(out);
    *out = q.near;
    *sure = q.sure;
    *outcome = q.end;
    dyd_error_clear(&q.err);
  } else {
    dyd_index_list_clear(&q.near);
    *outcome = DYD_OUTCOME_ERROR;
  }
  if (err) *err = q.err;
  return status < 0 ? status : DYD_OK;
}
