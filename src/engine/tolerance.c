/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances of computable points: they are refined until the tolerances of the centres of their rectangles tell those
 * of the points [TOL-10]. */
#include "base/abi.h"
#include "base/error.h"
#include "engine/ask.h"
#include "engine/state.h"
#include "rect/sites_table.h"
#include "tolerance/state.h"

#include <math.h>

/* Wants all points at `bits`. */
typedef struct level {
  int64_t bits;
  bool begun;
} level;

static dyd_status level_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  level *l = user;
  dyd_status st = DYD_OK;
  (void)err;
  *answered = l->begun;
  for (size_t i = 0; i < e->points && st == DYD_OK && !l->begun; i++)
    if (!e->point[i].final && e->point[i].bits < l->bits) st = dyd_wants_add(wants, e->point[i].site, l->bits);
  *answered = l->begun || !dyd_wants_count(wants);
  l->begun = true;
  return st;
}

/* A rectangle that nothing narrows has no tolerance. */
static dyd_status tolerance_points_fit(bool *all, const dyd_engine *e, const dyd_tolerance_options *o, dyd_error *err) {
  size_t n = dyd_sites_count(e->sites), k = 0;
  *all = true;
  for (size_t i = 0; i < n; i++) {
    while (k < e->points && e->point[k].site < i) k++;
    bool exact = dyd_sites_is_point(e->sites, i);
    *all = *all && exact;
    if (exact || dyd_sites_joined(e->sites, i) != i || (k < e->points && e->point[k].site == i && !e->point[k].final))
      continue;
    if (err) err->point = i;
    return dyd_fail(err, DYD_E_ARG,
                    "tolerances are those of points, and this one stays a rectangle; give its exact place");
  }
  if (*all || !(o->weight || o->sigmas || o->sigma > 0)) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "weights and standard deviations are for points given by plain numbers");
}

/* Returns true if another round is needed, and sets *bits for it. */
static bool tolerance_is_coarse(int64_t *bits, double off, double least, int64_t relative) {
  if (off == 0 || least == HUGE_VAL) return false;
  if (ldexp(off, (int)relative + 2) <= least) return false;
  int from, to;
  (void)frexp(off, &from);
  (void)frexp(least, &to);
  int64_t more = least > off ? relative + 4 + from - to : *bits;
  *bits += more > 8 ? more : 8;
  return true;
}

static int64_t finest_asked(const dyd_engine *e) {
  int64_t bits = 16;
  for (size_t k = 0; k < e->points; k++)
    if (e->point[k].asked && e->point[k].bits > bits) bits = e->point[k].bits;
  return bits;
}

/* All points to at least these bits, and the result up to date. */
static dyd_status tolerance_refine(dyd_outcome *outcome, dyd_engine *e, int64_t bits, const dyd_engine_options *o,
                                   dyd_error *err) {
  level l = {.bits = bits};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = level_ask, .user = &l, .triangulate = true};
  return dyd_engine_ask(outcome, e, &question, o, err);
}

static bool tolerance_goes_on(dyd_outcome outcome) {
  return outcome == DYD_OUTCOME_DECIDED || outcome == DYD_OUTCOME_FIXPOINT;
}

dyd_status dyd_engine_tolerance(dyd_tolerance **out, dyd_outcome *outcome, dyd_engine *e,
                                const dyd_tolerance_options *options, int64_t relative_bits,
                                const dyd_engine_options *run, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_tolerance_options o;
  double off = 0, least = 0;
  *out = NULL;
  dyd_status st = dyd_engine_run(outcome, e, run, err);
  if (st == DYD_OK) st = dyd_abi_take(&o, sizeof o, options, "dyd_tolerance_options", err);
  if (st != DYD_OK || !e->pd) return st;
  if (dyd_delaunay_is_capped(e->pd))
    return dyd_fail(err, DYD_CAPPED, "there are more ties than can be stored; raise `max_pairs`");
  bool exact;
  st = tolerance_points_fit(&exact, e, &o, err);
  if (st == DYD_OK && exact) return dyd_tolerance_new(out, e->pd, &o, err);
  int64_t relative = relative_bits > 0 && relative_bits <= 40 ? relative_bits : 20, bits = finest_asked(e);
  const int64_t most = run && run->max_bits ? run->max_bits : DYD_BITS_ENOUGH;
  for (bool again = true; again && st == DYD_OK;) {
    dyd_outcome reached = *outcome;
    if (tolerance_goes_on(*outcome)) st = tolerance_refine(&reached, e, bits, run, err);
    if (st != DYD_OK) break;
    if (!tolerance_goes_on(reached)) *outcome = reached;
    dyd_tolerance_free(*out);
    st = dyd_tolerance_enclosing(out, &off, &least, e->pd, &o, err);
    again = st == DYD_OK && tolerance_goes_on(*outcome) && tolerance_is_coarse(&bits, off, least, relative);
    if (again && bits > most) *outcome = DYD_OUTCOME_BUDGET, again = false;
  }
  return st;
}
