/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Of the points that a face wants narrower, those that cost at most DEAR times as much as the cheapest are asked; the
 * others wait, since what is narrowed may decide the face without them. None waits longer than until as much was spent
 * beside it as it costs: so waiting at most doubles what is spent. Whoever has waited then goes at once to the finest
 * precision of the face: what one call asks for costs nothing, and it need not take the steps of the others.
 *
 * The cheapest never wait, so a plan is empty only where it was. Like all of the schedule this only chooses what to
 * narrow. */
#include "engine/thrift.h"
#include <dyadel/io.h>

#include "base/alloc.h"
#include "engine/points.h"

#include <math.h>
#include <stdlib.h>

#define DEAR 2

static double thrift_cost(const dyd_plan *p, uint32_t site) {
  return p->o->cost ? p->o->cost[site] : dyd_engine_number(p->e, site, DYD_ROW_COST);
}

bool dyd_thrift_costs_are_good(const dyd_engine *e, const dyd_engine_options *o) {
  size_t n = o->cost ? dyd_engine_count(e) : 0, k = 0;
  while (k < n && o->cost[k] > 0 && o->cost[k] < HUGE_VAL) k++;
  return k == n;
}

dyd_status dyd_thrift_init(dyd_thrift *t, const dyd_engine *e, const dyd_engine_options *o) {
  *t = (dyd_thrift){.waited = NULL};
  dyd_plan_init(&t->face, e, o, NULL, 0);
  bool differ = false;
  for (size_t k = 1; k < e->points && !differ; k++)
    differ = thrift_cost(&t->face, e->point[k].site) != thrift_cost(&t->face, e->point[0].site);
  if (differ) t->waited = calloc(e->points, sizeof *t->waited);
  return t->face.failed == DYD_OK && !t->waited == !differ ? DYD_OK : DYD_E_NOMEM;
}

void dyd_thrift_clear(dyd_thrift *t) {
  dyd_plan_clear(&t->face);
  free(t->waited);
  *t = (dyd_thrift){.waited = NULL};
}

dyd_plan *dyd_thrift_face(dyd_thrift *t, dyd_plan *plan) {
  return t->waited ? &t->face : plan;
}

/* The finest precision that one of the sites was asked for. */
static int64_t thrift_finest(const dyd_engine *e, const dyd_index_list *sites) {
  int64_t finest = INT64_MIN;
  for (size_t k = 0; k < sites->count; k++) {
    const dyd_refinable *p = dyd_engine_find(e, sites->item[k]);
    if (p && p->asked && p->bits > finest) finest = p->bits;
  }
  return finest;
}

/* The least cost of what the face wants, and what all that is not dear costs. */
static double thrift_least(double *spent, const dyd_plan *face) {
  double least = HUGE_VAL;
  for (size_t k = 0; k < face->count; k++)
    least = fmin(least, thrift_cost(face, dyd_plan_point(face, &face->item[k])->site));
  *spent = 0;
  for (size_t k = 0; k < face->count; k++) {
    double cost = thrift_cost(face, dyd_plan_point(face, &face->item[k])->site);
    if (cost <= DEAR * least) *spent += cost;
  }
  return least;
}

void dyd_thrift_choose(dyd_plan *plan, dyd_thrift *t, const dyd_index_list *sites) {
  dyd_plan *face = &t->face;
  double spent, least = thrift_least(&spent, face);
  if (!t->waited) return;
  for (size_t k = 0; k < face->count; k++) {
    const dyd_want *w = &face->item[k];
    const dyd_refinable *p = dyd_plan_point(face, w);
    double cost = thrift_cost(face, p->site), *waited = &t->waited[p - plan->e->point];
    if (cost > DEAR * least && *waited < cost) {
      *waited += spent;
      continue;
    }
    int64_t finest = *waited > 0 && !plan->o->step_bits ? thrift_finest(plan->e, sites) : w->bits;
    dyd_plan_mark(plan, p, finest > w->bits ? finest : w->bits, w->reason, w->i, w->j);
    *waited = 0;
  }
  if (face->failed) plan->failed = face->failed;
  plan->blocked = plan->blocked || face->blocked;
  dyd_plan_empty(face);
}
