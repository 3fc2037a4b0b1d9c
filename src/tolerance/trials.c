/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans tried on drawn places: the trials, and those of a plane. Nothing of them is a statement about the points. */
#include "tolerance/trials.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/parallel.h"
#include "base/random.h"
#include "rect/rect.h"

#include <stdlib.h>

/* Of rounds: in all, and in a row that decide nothing. */
enum { ROUNDS_MOST = 64, ROUNDS_IDLE = 4 };

void dyd_trial_draw(mpq_ptr u, uint64_t seed, uint64_t k) {
  mpq_set_ui(u, (unsigned long)(dyd_random(seed, k) >> 11), 1);
  mpq_mul_2exp(u, u, 1);
  mpz_add_ui(mpq_numref(u), mpq_numref(u), 1);
  mpq_div_2exp(u, u, 54);
}

/* ---- all trials ---- */

typedef struct trials_work {
  dyd_trials *t;
  dyd_status *status; /* of each */
} trials_work;

static size_t trial_measure(dyd_survey_trial *out, bool *measured, const dyd_survey *plan) {
  const dyd_survey_row *row;
  const size_t rows = dyd_survey_rows(&row, plan);
  for (size_t k = 0; k < rows; k++) {
    out->points += !measured[row[k].site];
    measured[row[k].site] = true;
  }
  out->measurements += rows;
  out->rounds += rows > 0;
  return rows;
}

static dyd_status trial_follow(dyd_survey_trial *out, void *draw, const dyd_trials *t, bool *measured) {
  const dyd_survey *plan = t->first;
  DYD_OWNED(dyd_survey) *own = NULL;
  dyd_status st = DYD_OK;
  size_t fewest = plan->result.open, idle = 0;
  while (st == DYD_OK && idle < ROUNDS_IDLE && trial_measure(out, measured, plan) && out->rounds < ROUNDS_MOST) {
    dyd_survey *next = NULL;
    dyd_error err;
    dyd_error_clear(&err);
    st = t->step(&next, draw, t, plan, &err);
    dyd_survey_free(own);
    plan = own = next;
    idle = st == DYD_OK && plan->result.open >= fewest ? idle + 1 : 0;
    if (!idle && st == DYD_OK) fewest = plan->result.open;
  }
  if (st == DYD_OK) out->left = plan->result.left + plan->result.ties;
  out->done = st == DYD_OK;
  return st;
}

static void trial_task(void *context, size_t number) {
  const trials_work *w = context;
  const dyd_trials *t = w->t;
  void *draw = NULL;
  w->status[number] = DYD_CANCELLED;
  t->out[number] = (dyd_survey_trial){0};
  if (dyd_flag_is_set(t->cancel)) return;
  DYD_FREED bool *measured = calloc(t->sites + 1, sizeof *measured);
  dyd_status st = measured ? t->begin(&draw, t, dyd_random(t->seed, number)) : DYD_E_NOMEM;
  if (st == DYD_OK) st = trial_follow(&t->out[number], draw, t, measured);
  w->status[number] = st;
  if (draw) t->end(draw);
}

dyd_status dyd_trials_run(dyd_trials *t, unsigned threads, dyd_error *err) {
  trials_work w = {t, dyd_alloc(t->count, sizeof *w.status)};
  size_t cut = 0;
  dyd_status st = DYD_OK;
  if (!w.status) return dyd_fail_nomem(err);
  t->asked = (dyd_pair_list){t->first->target.count + t->first->tied, t->first->target.item};
  dyd_parallel(threads, t->count, trial_task, &w);
  for (size_t k = 0; k < t->count; k++) {
    cut += w.status[k] == DYD_CANCELLED;
    if (w.status[k] != DYD_OK && st >= 0) st = w.status[k];
  }
  free(w.status);
  if (st == DYD_CANCELLED) return dyd_fail(err, st, "%zu of %zu trials of the plan are not done", cut, t->count);
  return st == DYD_OK ? st : dyd_fail(err, st, "a trial of the plan failed: %s", dyd_status_text(st));
}

/* ---- the plane ---- */

typedef struct plane_trials {
  const dyd_delaunay *pd;
  dyd_survey_options options; /* of the plans after the first one */
} plane_trials;

/* now: the triangulation of the rectangles so far (NULL: that of `of`); needed: of each site in the plan followed, else
 * 0. */
typedef struct plane_draw {
  const plane_trials *of;
  uint64_t seed;
  dyd_delaunay *now;
  double *needed;
} plane_draw;

static dyd_status plane_begin(void **draw, const dyd_trials *t, uint64_t seed) {
  plane_draw *d = calloc(1, sizeof *d);
  if (!d) return DYD_E_NOMEM;
  *draw = d;
  d->of = t->user;
  d->seed = seed;
  d->needed = calloc(t->sites + 1, sizeof *d->needed);
  return d->needed ? DYD_OK : DYD_E_NOMEM;
}

static void plane_end(void *draw) {
  plane_draw *d = draw;
  dyd_delaunay_free(d->now);
  dyd_free_all(d->needed, d);
}

/* The place at the share u of the side. */
static void side_place(mpq_ptr at, const dyd_interval *side, mpq_srcptr u, mpq_t lo) {
  dyd_interval_get_q(lo, at, side);
  mpq_sub(at, at, lo);
  mpq_mul(at, at, u);
  mpq_add(at, at, lo);
}

/* Is (u, v) in the disc in the unit square? u^2 - u + v^2 - v < -1/4. */
static bool is_in_unit_disc(mpq_srcptr u, mpq_srcptr v) {
  DYD_LOCAL_NUMBERS(mpq, sum, part);
  mpq_mul(sum, u, u);
  mpq_sub(sum, sum, u);
  mpq_mul(part, v, v);
  mpq_add(sum, sum, part);
  mpq_sub(sum, sum, v);
  const bool inside = mpq_cmp_si(sum, -1, 4) < 0;
  return inside;
}

/* at: the true place of site i; spare: scratch. */
static dyd_status plane_truth(mpq_t at[2], const plane_draw *d, size_t i, mpq_t spare[3]) {
  const uint64_t own = dyd_random(d->seed, i);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, dyd_delaunay_sites(d->of->pd), i);
  uint64_t k = 0;
  do {
    dyd_trial_draw(spare[0], own, k++);
    dyd_trial_draw(spare[1], own, k++);
  } while (d->of->options.discs && !is_in_unit_disc(spare[0], spare[1]));
  if (st == DYD_OK) side_place(at[0], &r.x, spare[0], spare[2]);
  if (st == DYD_OK) side_place(at[1], &r.y, spare[1], spare[2]);
  return st;
}

/* All within a of the place: a disc that was measured replaces the old one. */
static dyd_status rect_replace(dyd_rect *out, mpq_t at[2], mpq_srcptr a, mpq_t end[2]) {
  dyd_status st = DYD_OK;
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    mpq_sub(end[0], at[axis], a);
    mpq_add(end[1], at[axis], a);
    const int64_t bits = dyd_interval_bits(axis ? &out->y : &out->x);
    st = dyd_interval_set_outward(axis ? &out->y : &out->x, end[0], end[1], -bits - 120);
  }
  return st;
}

static dyd_status plane_rect(dyd_rect *out, const void *draw, size_t i) {
  const plane_draw *d = draw;
  dyd_status st = dyd_sites_get(out, dyd_delaunay_sites(d->now ? d->now : d->of->pd), i);
  if (st != DYD_OK || !(d->needed[i] > 0)) return st;
  DYD_LOCAL_NUMBERS(mpq, a);
  DYD_LOCAL_ARRAY(mpq_t, at, [2]);
  DYD_LOCAL_ARRAY(mpq_t, spare, [3]);
  st = plane_truth(at, d, i, spare);
  mpq_set_d(a, d->needed[i]);
  if (st == DYD_OK && d->of->options.discs) {
    st = rect_replace(out, at, a, spare);
  } else {
    if (st == DYD_OK) st = dyd_survey_cut(&out->x, at[0], a, spare);
    if (st == DYD_OK) st = dyd_survey_cut(&out->y, at[1], a, spare);
  }
  return st;
}

static dyd_status plane_step(dyd_survey **next, void *draw, const dyd_trials *t, const dyd_survey *plan,
                             dyd_error *err) {
  plane_draw *d = draw;
  const dyd_survey_row *row;
  const size_t rows = dyd_survey_rows(&row, plan);
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = t->cancel, .threads = 1,
                                  .max_pairs = d->of->pd->options.max_pairs};
  dyd_delaunay *then = NULL;
  dyd_survey_options how = d->of->options;
  for (size_t k = 0; k < rows; k++) d->needed[row[k].site] = row[k].needed;
  dyd_status st = dyd_delaunay_made(&then, t->sites, plane_rect, d, &o, err);
  for (size_t k = 0; k < rows; k++) d->needed[row[k].site] = 0;
  if (st != DYD_OK) return st;
  dyd_delaunay_free(d->now);
  d->now = then;
  how.pairs = &t->asked;
  return dyd_survey_new(next, then, &how, err);
}

dyd_status dyd_survey_simulate(dyd_survey_trial *out, size_t count, uint64_t seed, const dyd_delaunay *pd,
                               const dyd_survey_options *options, dyd_error *err) {
  if (!pd || (count && !out)) return dyd_fail_null(err);
  plane_trials p = {.pd = pd};
  DYD_OWNED(dyd_survey) *first = NULL;
  for (size_t k = 0; k < count; k++) out[k] = (dyd_survey_trial){0};
  dyd_status st = dyd_abi_take(&p.options, sizeof p.options, options, "dyd_survey_options", err);
  if (st == DYD_OK) st = dyd_survey_new(&first, pd, &p.options, err);
  p.options.window = NULL;
  p.options.site = NULL;
  dyd_trials t = {.out = out,
                  .count = count,
                  .seed = seed,
                  .first = first,
                  .sites = dyd_sites_count(dyd_delaunay_sites(pd)),
                  .cancel = p.options.cancel,
                  .begin = plane_begin,
                  .step = plane_step,
                  .end = plane_end,
                  .user = &p};
  return st == DYD_OK ? dyd_trials_run(&t, pd->options.threads, err) : st;
}
