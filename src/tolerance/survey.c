/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans [SUR-1]: targets, and the public calls. */
#include "tolerance/survey.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/local.h"
#include "base/parallel.h"
#include "base/random.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "tolerance/lines.h"

#include <dyadel/tolerance.h>

#include <stdlib.h>
#include <string.h>

/* ---- targets ---- */

static bool is_asked(const dyd_survey_options *o, const dyd_survey *s, const dyd_pair *p) {
  if (o->site && p->i != *o->site && p->j != *o->site) return false;
  return !o->window || dyd_rect_meets(&s->site[p->i].rect, o->window) || dyd_rect_meets(&s->site[p->j].rect, o->window);
}

/* Number of ties that dyd_least_bounding omits: those of the nominal places, which are the points. */
static size_t ties_left_out(const dyd_delaunay *pd) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  return dyd_least_bounding(pd) > DYD_TIE ? count[DYD_TIE] : 0;
}

/* The first pair that ties at the centres, and the first end of a pair whose centre is that of another site. */
static void note_nominal(dyd_survey_result *r, const dyd_delaunay *nominal, const dyd_pair *p) {
  const uint32_t end[2] = {p->i, p->j};
  if (p->status != DYD_INDETERMINATE) return;
  if (r->tie[0] == r->tie[1] && dyd_delaunay_status(nominal, p->i, p->j) == DYD_TIE) memcpy(r->tie, end, sizeof end);
  for (int k = 0; k < 2 && r->same[0] == r->same[1]; k++) {
    r->same[0] = dyd_delaunay_alias(nominal, end[k]);
    r->same[1] = end[k];
  }
}

/* Is the pair, open for the rectangles, open for the discs in them, too? */
static bool is_open_in_discs(const dyd_pair_list *discs, const dyd_pair *p) {
  const uint32_t key[2] = {p->i < p->j ? p->i : p->j, p->i < p->j ? p->j : p->i};
  const dyd_pair *found = dyd_find_two(key, discs->item, discs->count, sizeof *found);
  return found && found->status == DYD_INDETERMINATE;
}

/* Of the pairs asked for: those open. Cancelled: perhaps more of them. */
static dyd_status list_open(dyd_survey *s, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_pair_list) all = {0}, discs = {0};
  const dyd_survey_options *o = &s->options;
  dyd_status st = o->pairs ? DYD_OK : dyd_pairs_take(&all, pd, dyd_least_bounding(pd)), found = st;
  const dyd_pair_list *asked = o->pairs ? o->pairs : &all;
  if (!o->pairs) s->result.ties = ties_left_out(pd);
  if (st == DYD_OK && o->discs) found = dyd_disc_pairs(&discs, pd, o->cancel, s->err);
  if (found != DYD_CANCELLED) st = found;
  if (st == DYD_OK && !(s->target.item = dyd_alloc(asked->count, sizeof *s->target.item))) st = DYD_E_NOMEM;
  for (size_t k = 0; k < asked->count && st == DYD_OK; k++) {
    dyd_pair p = asked->item[k];
    p.i = dyd_delaunay_alias(pd, p.i);
    p.j = dyd_delaunay_alias(pd, p.j);
    p.status = dyd_delaunay_status(pd, p.i, p.j);
    if ((p.status != DYD_INDETERMINATE && p.status != DYD_TIE) || !is_asked(o, s, &p)) continue;
    if (!o->discs || is_open_in_discs(&discs, &p)) s->target.item[s->target.count++] = p;
  }
  return st == DYD_OK ? found : st;
}

/* Moves the ties of the nominal places behind the others, which get their statuses there. */
static void leave_out_ties(dyd_survey *s, const dyd_delaunay *nominal) {
  dyd_pair_list *t = &s->target;
  for (size_t k = 0; k < t->count; k++) note_nominal(&s->result, nominal, &t->item[k]);
  for (size_t k = 0; k < t->count;) {
    const dyd_pair p = t->item[k];
    const dyd_pair_status there = dyd_delaunay_status(nominal, p.i, p.j);
    bool tied = there == DYD_TIE || dyd_delaunay_alias(nominal, p.i) == dyd_delaunay_alias(nominal, p.j);
    if (!tied) {
      t->item[k++].status = there;
      continue;
    }
    t->item[k] = t->item[--t->count];
    t->item[t->count] = p;
    s->tied++;
  }
  s->result.ties += s->tied;
}

/* Rectangles as they are, and as they would be after measuring. */

static void load_site(dyd_survey_site *p) {
  DYD_LOCAL_NUMBERS(mpq, height);
  dyd_side_sum(p->x, p->half, &p->rect.x);
  dyd_side_sum(p->y, height, &p->rect.y);
  if (mpq_cmp(height, p->half) > 0) mpq_set(p->half, height);
  mpq_div_2exp(p->x, p->x, 1);
  mpq_div_2exp(p->y, p->y, 1);
  mpq_div_2exp(p->half, p->half, 1);
}

/* Of each site its rectangle, centre and half-width, twelve numbers: with their digits, and what allocators add. */
static bool survey_has_room(dyd_survey *s, size_t sites) {
  enum { NUMBERS = 12, BLOCK = 32 };
  uint64_t bytes = dyd_bytes_times(sites, sizeof *s->site + NUMBERS * BLOCK);
  if (!dyd_memory_has(&s->memory, bytes, "the plan")) return false;
  s->memory.held += bytes;
  return true;
}

static dyd_status survey_load(dyd_survey *s, const dyd_sites *sites) {
  if (!survey_has_room(s, dyd_sites_count(sites))) return DYD_E_NOMEM;
  s->site = dyd_alloc(dyd_sites_count(sites), sizeof *s->site);
  if (!s->site) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < dyd_sites_count(sites) && st == DYD_OK; i++) {
    dyd_survey_site *p = &s->site[s->sites++];
    dyd_rect_init(&p->rect);
    mpq_inits(p->x, p->y, p->half, NULL);
    p->chosen = false;
    p->coarser = 0;
    st = dyd_sites_get(&p->rect, sites, i);
    if (st == DYD_OK) load_site(p);
  }
  return st;
}

/* The targets of each site, to avoid searching all of them. */

/* s->at: each target at its lower end and at its upper one. */
static dyd_status index_ends(dyd_survey *s) {
  const dyd_pair_list *t = &s->target;
  if (!DYD_ZEROED(s->first, s->sites + 2) || !DYD_NEW(s->at, 2 * t->count) || !DYD_NEW(s->pair, t->count))
    return DYD_E_NOMEM;
  for (size_t k = 0; k < t->count; k++) s->pair[k] = (dyd_survey_pair){t->item[k].i, t->item[k].j, SIZE_MAX};
  size_t *next =
      s->first + 1; /* where the next target of each site goes: when all are there, where those after begin */
  for (size_t k = 0; k < t->count; k++) next[t->item[k].i + 1]++, next[t->item[k].j + 1]++;
  for (size_t i = 0; i < s->sites; i++) next[i + 1] += next[i];
  for (size_t k = 0; k < t->count; k++) s->at[next[t->item[k].i]++] = k, s->at[next[t->item[k].j]++] = k;
  return DYD_OK;
}

/* Sorts the targets, finds s->first and s->at. */
static dyd_status survey_index_targets(dyd_survey *s) {
  dyd_pair_list *t = &s->target;
  for (size_t k = 0; k < t->count; k++) {
    dyd_pair p = t->item[k];
    if (p.i > p.j) t->item[k] = (dyd_pair){p.j, p.i, p.status};
  }
  if (t->count) qsort(t->item, t->count, sizeof *t->item, dyd_compare_two);
  return index_ends(s);
}

static dyd_status find_targets(dyd_survey *s, const dyd_delaunay *pd) {
  DYD_OWNED(dyd_delaunay) *nominal = NULL;
  dyd_status st = list_open(s, pd);
  if (st == DYD_OK && s->target.count) st = dyd_survey_triangulate(&nominal, s, true);
  if (nominal) leave_out_ties(s, nominal);
  dyd_status indexed = st == DYD_OK || st == DYD_CANCELLED ? survey_index_targets(s) : st;
  return indexed == DYD_OK ? st : indexed;
}

static dyd_status survey_check(const dyd_survey *s, const dyd_delaunay *pd, dyd_error *err) {
  const dyd_survey_options *o = &s->options;
  if (dyd_delaunay_is_capped(pd))
    return dyd_fail(err, DYD_CAPPED, "more undecided pairs than can be stored; raise `max_pairs`");
  if (o->accuracy && mpq_sgn(o->accuracy) <= 0)
    return dyd_fail(err, DYD_E_ARG, "the accuracy is not above 0; give a number above 0");
  if (o->site && *o->site >= s->sites)
    return dyd_fail(err, DYD_E_ARG, "there is no such point; give the number of one, from 0");
  for (size_t k = 0; o->pairs && k < o->pairs->count; k++)
    if (o->pairs->item[k].i >= s->sites || o->pairs->item[k].j >= s->sites)
      return dyd_fail(err, DYD_E_ARG, "pair number %zu names a point that does not exist", k);
  for (size_t i = 0; o->accuracies && i < s->sites; i++)
    if (!(o->accuracies[i] > 0))
      return dyd_fail(err, DYD_E_ARG, "the accuracy of point %zu is not above 0; give a number above 0", i);
  for (size_t i = 0; o->cost && i < s->sites; i++)
    if (!(o->cost[i] > 0)) return dyd_fail(err, DYD_E_ARG, "the cost of point %zu is not above 0", i);
  return DYD_OK;
}

/* Work was cancelled when targets were known. */
static void keep_draft(dyd_survey *s) {
  free(s->row);
  s->row = s->draft;
  s->rows = s->drafts;
  s->draft = NULL;
  s->result.left = s->rows ? s->row[s->rows - 1].left : s->target.count;
  s->result.cut = true;
}

dyd_status dyd_survey_tell_cut(const dyd_survey *s, dyd_error *err) {
  if (!s->result.cut) return DYD_OK;
  return dyd_fail(err, DYD_CANCELLED,
                  "the plan is not finished: %zu of %zu pairs are undecided after its first %zu points", s->result.left,
                  s->result.open, s->rows);
}

/* Work was cancelled before, perhaps that on pd, too. */
static dyd_status survey_not_begun(dyd_survey **out, dyd_survey *s, const dyd_delaunay *pd, dyd_error *err) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  s->result.open = s->result.left = s->options.pairs ? s->options.pairs->count : count[DYD_INDETERMINATE];
  s->result.cut = true;
  s->result.struct_size = sizeof s->result;
  *out = s;
  return dyd_survey_tell_cut(s, err);
}

dyd_status dyd_survey_new(dyd_survey **out, const dyd_delaunay *pd, const dyd_survey_options *options, dyd_error *err) {
  if (!pd) return dyd_fail_null(err);
  *out = NULL;
  if (err) dyd_error_clear(err);
  dyd_survey *s = calloc(1, sizeof *s);
  if (!s) return dyd_fail_nomem(err);
  mpq_init(s->scale);
  s->memory = dyd_delaunay_memory_left(pd);
  s->threads = pd->options.threads;
  s->err = err;
  dyd_status st = dyd_abi_take(&s->options, sizeof s->options, options, "dyd_survey_options", err);
  if (st == DYD_OK && dyd_flag_is_set(s->options.cancel)) return survey_not_begun(out, s, pd, err);
  if (st == DYD_OK) st = survey_load(s, dyd_delaunay_sites(pd));
  if (st == DYD_OK) st = survey_check(s, pd, err);
  if (st == DYD_OK) st = find_targets(s, pd);
  if (st == DYD_OK) st = dyd_survey_choose(s, pd);
  s->err = NULL;
  if (st == DYD_OK || (st == DYD_CANCELLED && s->first)) {
    *out = s;
    if (st == DYD_CANCELLED) keep_draft(s);
    s->result.struct_size = sizeof s->result;
    s->result.open = s->target.count;
    return dyd_survey_tell_cut(s, err);
  }
  if (st == DYD_E_NOMEM && s->memory.refused) dyd_fail_memory(err, &s->memory);
  dyd_survey_free(s);
  return err && err->code == st ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

void dyd_survey_free(dyd_survey *s) {
  if (!s) return;
  for (size_t i = 0; i < s->sites; i++) {
    dyd_rect_clear(&s->site[i].rect);
    mpq_clears(s->site[i].x, s->site[i].y, s->site[i].half, NULL);
  }
  dyd_free_all(s->first, s->at, s->pair);
  dyd_free_all(s->site, s->chosen, s->row, s->draft);
  dyd_pair_list_clear(&s->target);
  mpq_clear(s->scale);
  free(s);
}

size_t dyd_survey_rows(const dyd_survey_row **row, const dyd_survey *s) {
  if (!s) return 0;
  *row = s->row;
  return s->rows;
}

size_t dyd_survey_pairs(const dyd_survey_pair **pair, const dyd_survey *s) {
  if (!s) return 0;
  *pair = s->pair;
  return s->target.count;
}

const dyd_survey_result *dyd_survey_get(const dyd_survey *s) {
  return s ? &s->result : NULL;
}

/* ---- plans tried on drawn places; nothing of this is a statement about the points ---- */

/* Of rounds: in all, and in a row that decide nothing. */
enum { ROUNDS_MOST = 64, ROUNDS_IDLE = 4 };

/* Is (u, v) in the disc in the unit square? u^2 - u + v^2 - v < -1/4. */
static bool is_in_unit_disc(mpq_srcptr u, mpq_srcptr v) {
  DYD_LOCAL_NUMBERS(mpq, sum, part);
  mpq_mul(sum, u, u);
  mpq_sub(sum, sum, u);
  mpq_mul(part, v, v);
  mpq_add(sum, sum, part);
  mpq_sub(sum, sum, v);
  return mpq_cmp_si(sum, -1, 4) < 0;
}

void dyd_trial_draw(mpq_t u[2], uint64_t seed, bool disc) {
  uint64_t k = 0;
  do {
    for (int a = 0; a < 2; a++) {
      mpq_set_ui(u[a], (unsigned long)(dyd_random(seed, k++) >> 11), 1);
      mpq_mul_2exp(u[a], u[a], 1);
      mpz_add_ui(mpq_numref(u[a]), mpq_numref(u[a]), 1);
      mpq_div_2exp(u[a], u[a], 54);
    }
  } while (disc && !is_in_unit_disc(u[0], u[1]));
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

/* Measures the points of a plan, and plans again. */
static dyd_status trial_step(dyd_survey **next, dyd_trial *d, const dyd_survey *plan) {
  const dyd_survey_row *row;
  const size_t rows = dyd_survey_rows(&row, plan);
  dyd_error err;
  dyd_error_clear(&err);
  for (size_t k = 0; k < rows; k++) d->needed[row[k].site] = row[k].needed;
  dyd_status st = d->of->step(next, d, &err);
  for (size_t k = 0; k < rows; k++) d->needed[row[k].site] = 0;
  return st;
}

static dyd_status trial_follow(dyd_survey_trial *out, dyd_trial *d, bool *measured) {
  const dyd_survey *plan = d->of->first;
  DYD_OWNED(dyd_survey) *own = NULL;
  dyd_status st = DYD_OK;
  size_t fewest = plan->result.open, idle = 0;
  while (st == DYD_OK && idle < ROUNDS_IDLE && trial_measure(out, measured, plan) && out->rounds < ROUNDS_MOST) {
    dyd_survey *next = NULL;
    st = trial_step(&next, d, plan);
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
  w->status[number] = DYD_CANCELLED;
  if (dyd_flag_is_set(t->options.cancel)) return;
  DYD_FREED bool *measured = calloc(t->sites + 1, sizeof *measured);
  DYD_FREED double *needed = calloc(t->sites + 1, sizeof *needed);
  dyd_trial d = {.of = t, .seed = dyd_random(t->seed, number), .needed = needed};
  w->status[number] = measured && needed ? trial_follow(&t->out[number], &d, measured) : DYD_E_NOMEM;
  t->end(d.now);
}

dyd_status dyd_trials_run(dyd_trials *t, unsigned threads, dyd_error *err) {
  trials_work w = {t, dyd_alloc(t->count, sizeof *w.status)};
  size_t cut = 0;
  dyd_status st = DYD_OK;
  if (!w.status) return dyd_fail_nomem(err);
  t->asked = (dyd_pair_list){t->first->target.count + t->first->tied, t->first->target.item};
  t->options.pairs = &t->asked;
  t->options.window = NULL;
  t->options.site = NULL;
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

/* The place at the share u of the side. */
static void side_place(mpq_ptr at, const dyd_interval *side, mpq_srcptr u, mpq_t lo) {
  dyd_interval_get_q(lo, at, side);
  mpq_sub(at, at, lo);
  mpq_mul(at, at, u);
  mpq_add(at, at, lo);
}

/* at: the true place of site i; spare: scratch. */
static dyd_status plane_truth(mpq_t at[2], const dyd_trial *d, size_t i, mpq_t spare[3]) {
  const uint64_t own = dyd_random(d->seed, i);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, dyd_delaunay_sites(d->of->user), i);
  dyd_trial_draw(spare, own, d->of->options.discs);
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

static dyd_status plane_rect(dyd_rect *out, const void *trial, size_t i) {
  const dyd_trial *d = trial;
  dyd_status st = dyd_sites_get(out, dyd_delaunay_sites(d->now ? d->now : d->of->user), i);
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

/* Discs that were not measured are as they were given. */
static dyd_status plane_kinds(dyd_sites *now, const dyd_trial *d) {
  const dyd_sites *given = dyd_delaunay_sites(d->of->user);
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < d->of->sites && st == DYD_OK; i++)
    if (!(d->needed[i] > 0)) st = dyd_sites_set_kind(now, i, 1, dyd_sites_kind(given, i));
  return st;
}

static dyd_status plane_step(dyd_survey **next, dyd_trial *d, dyd_error *err) {
  const dyd_trials *t = d->of;
  const dyd_delaunay *pd = t->user;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = t->options.cancel, .threads = 1,
                                  .max_pairs = pd->options.max_pairs};
  dyd_delaunay *then = NULL;
  dyd_status st = dyd_delaunay_made(&then, t->sites, plane_rect, d, &o, err);
  if (st != DYD_OK) return st;
  dyd_delaunay_free(d->now);
  d->now = then;
  st = plane_kinds(then->own, d);
  return st == DYD_OK ? dyd_survey_new(next, then, &t->options, err) : dyd_fail(err, st, "%s", dyd_status_text(st));
}

static void plane_end(void *now) {
  dyd_delaunay_free(now);
}

dyd_status dyd_survey_simulate(dyd_survey_trial *out, size_t count, uint64_t seed, const dyd_delaunay *pd,
                               const dyd_survey_options *options, dyd_error *err) {
  if (!pd || (count && !out)) return dyd_fail_null(err);
  DYD_OWNED(dyd_survey) *first = NULL;
  dyd_trials t = {.out = out,
                  .count = count,
                  .seed = seed,
                  .sites = dyd_sites_count(dyd_delaunay_sites(pd)),
                  .step = plane_step,
                  .end = plane_end,
                  .user = pd};
  for (size_t k = 0; k < count; k++) out[k] = (dyd_survey_trial){0};
  dyd_status st = dyd_abi_take(&t.options, sizeof t.options, options, "dyd_survey_options", err);
  if (st == DYD_OK) st = dyd_survey_new(&first, pd, &t.options, err);
  t.first = first;
  return st == DYD_OK ? dyd_trials_run(&t, pd->options.threads, err) : st;
}
