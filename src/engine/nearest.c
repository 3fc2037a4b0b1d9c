/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Nearest sites of a computable point: narrow the point and the sites concerned until one is surely nearest.
 *
 * Only sites that are possibly nearest matter: where i is not listed, its distance to every point of the query is above
 * the least dl of some other site, and stays so [NEAR-3]. The result pd serves as an index; sites narrowed since it was
 * made only make its boxes wider than they need be. Precision goes up in levels, as in run.c: at each level
 * each site concerned that was asked for less is asked for the level.
 *
 * The nearest sites are listed. If all that are listed are equally far from the point, all of them are nearest, and no
 * refinement changes that: a tie. It is looked for when the list has changed [NEAR-4]. */
#include "base/alloc.h"
#include "base/error.h"
#include "engine/plan.h"
#include "engine/points.h"
#include "engine/settle.h"
#include "engine/ties.h"
#include <dyadel/voronoi.h>

#include <stdlib.h>

/* level: the precision worked towards, INT64_MIN at first; the point asked about is the only guest. tried: how many
 * were listed when a tie was looked for last. */
typedef struct nearest_question {
  dyd_engine *e;
  dyd_stream *at;
  int64_t level;
  dyd_index_list near;
  size_t tried;
  bool sure, tied;
} nearest_question;

/* Wants of p what is missing at the level. *open: p can be narrowed still. */
static void nearest_mark(bool *open, dyd_plan *plan, const dyd_refinable *p, int64_t level) {
  if (!p || p->final) return;
  *open = true;
  if (!p->asked || p->bits < level) dyd_plan_mark_alone(plan, p, level, DYD_REASON_QUESTION);
}

/* Raises the level until some site is below it. */
static void nearest_plan(nearest_question *q, dyd_plan *plan) {
  if (q->level == INT64_MIN) q->level = dyd_bits_first(plan->o);
  for (bool open = false;; q->level = dyd_bits_grown(q->level, plan->o)) {
    if (q->level > plan->o->max_bits) q->level = plan->o->max_bits;
    nearest_mark(&open, plan, plan->guest, q->level);
    for (size_t k = 0; k < q->near.count; k++)
      nearest_mark(&open, plan, dyd_engine_find(plan->e, q->near.item[k]), q->level);
    plan->blocked = open;
    if (plan->count || plan->failed || !open || q->level == plan->o->max_bits) return;
  }
}

/* Exact points about an exact point are listed when none is nearer. */
static bool all_are_exact(const nearest_question *q) {
  bool exact = dyd_rect_is_point(dyd_stream_rect(q->at));
  for (size_t k = 0; k < q->near.count && exact; k++) exact = dyd_sites_is_point(q->e->sites, q->near.item[k]);
  return exact;
}

/* Are those listed equally far, for good? Where it is seen that they are not, the level is raised to where rectangles
 * show it. */
static dyd_status nearest_try_tie(nearest_question *q, const dyd_engine_options *o, dyd_error *err) {
  int64_t needed = 0;
  q->tied = all_are_exact(q);
  if (q->tied || o->no_ties || q->tried == q->near.count) return DYD_OK;
  q->tried = q->near.count;
  dyd_status st = dyd_ties_equidistant(&q->tied, &needed, q->e, q->at, &q->near, err);
  if (needed > q->level && !o->step_bits) q->level = needed;
  return st;
}

/* Counts the firm sites that may be nearest to some point of `at`, by a triangulation of the sites listed, as they are
 * in the problem of [NEAR-5]. */
static dyd_status nearest_count_firm(size_t *count, const nearest_question *q, const dyd_rect *at,
                                     const dyd_dyadic *eps) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_index_list near = {0};
  bool sure, *firm = dyd_alloc(q->near.count, sizeof *firm);
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &q->e->stop};
  dyd_status st = firm ? dyd_sites_new(&sites) : DYD_E_NOMEM;
  *count = 0;
  for (size_t k = 0; st == DYD_OK && k < q->near.count; k++)
    st = dyd_firm_add(sites, &firm[k], q->e, eps, q->near.item[k]);
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, NULL);
  if (st == DYD_OK) st = dyd_nearest_rect(&near, &sure, pd, at);
  for (size_t k = 0; st == DYD_OK && k < near.count; k++) *count += firm[near.item[k]];
  dyd_index_list_clear(&near);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  free(firm);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* Do two sites stay possible, whatever is refined [NEAR-5]? */
static dyd_status nearest_is_settled(bool *out, const nearest_question *q) {
  size_t count = 0;
  dyd_dyadic eps;
  dyd_rect at;
  dyd_dyadic_init(&eps);
  dyd_rect_init(&at);
  dyd_status st = dyd_firm_place(&at, &eps, q->at);
  for (size_t k = 0; st == DYD_OK && k < q->near.count; k++) st = dyd_firm_raise(&eps, q->e, q->near.item[k]);
  for (int k = 0; st == DYD_OK && k < 2; k++) st = dyd_dyadic_add(&eps, &eps, &eps);
  if (st == DYD_OK) st = nearest_count_firm(&count, q, &at, &eps);
  *out = count > 1;
  dyd_rect_clear(&at);
  dyd_dyadic_clear(&eps);
  return st;
}

static dyd_status nearest_ask(bool *answered, dyd_plan *plan, void *user, const dyd_engine *e, dyd_error *err) {
  nearest_question *q = user;
  dyd_status st = dyd_nearest_rect(&q->near, &q->sure, e->pd, dyd_stream_rect(q->at));
  *answered = st == DYD_OK && q->sure;
  if (st == DYD_OK && q->near.count > 1) st = nearest_try_tie(q, plan->o, err);
  bool settled = q->sure || q->tied || q->near.count == 0;
  if (st == DYD_OK && !settled && q->near.count > 1) st = nearest_is_settled(&settled, q);
  if (st == DYD_OK && !settled) nearest_plan(q, plan);
  return st;
}

dyd_status dyd_engine_nearest(dyd_index_list *out, bool *sure, dyd_outcome *outcome, dyd_engine *e, dyd_stream *at,
                              const dyd_engine_options *options, dyd_error *err) {
  if (!e || !at) return dyd_fail_null(err);
  nearest_question q = {.e = e, .at = at, .level = INT64_MIN};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = nearest_ask, .user = &q, .guest = &at, .guests = 1};
  *outcome = DYD_OUTCOME_ERROR;
  e->nearest_tied = false;
  if (err) dyd_error_clear(err);
  if (!e->pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet: run the engine first");
  dyd_status st = dyd_engine_ask(outcome, e, &question, options, err);
  if (st != DYD_OK) {
    dyd_index_list_clear(&q.near);
    return st;
  }
  dyd_index_list_clear(out);
  *out = q.near;
  *sure = q.sure;
  e->nearest_tied = q.tied;
  return DYD_OK;
}

bool dyd_engine_nearest_tied(const dyd_engine *e) {
  if (!e) return false;
  return e->nearest_tied;
}
