/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The one loop: narrow, triangulate, look whether to stop (mathematics: section 7).
 *
 * Between stages the checks come in this order, and the first that holds is the outcome:
 *   cancelled; the goal holds (decided, certified); nothing can be narrowed (pairs, when the cap was met; bits, when a
 *   larger max_bits would allow more; otherwise fixpoint); stages, calls, seconds spent.
 * Stages, calls and seconds are counted for each run on its own, bits and pairs are absolute.
 *
 * A stage that is cut short leaves everything valid, because rectangles only shrink:
 *   - calls used up, or a stream failed: what was narrowed is brought into the result, which is then complete for
 *     the rectangles as they are. In the first stage there is no result before all points have been asked.
 *   - cancelled or out of time: narrowed sites stay listed in `changed`; the statements of the result were made for the
 *     wider rectangles of its last stage, and hold for the narrower ones as well (legal and illegal are for ever,
 *     the possible pairs listed include all that are possible now). The next run begins by bringing it up to date.
 * Points narrowed are never asked for the same again, so a later run goes on where this one stopped. */
#include "engine/engine.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "engine/scout.h"
#include "engine/watch.h"

/* One run. end is DYD_OUTCOME_NONE until it is known how the run ends. */
typedef struct run {
  dyd_engine *e;
  dyd_engine_options o; /* all defaults filled in */
  dyd_watch watch;
  uint64_t stages, calls; /* of this run */
  double seconds_before;
  dyd_outcome end;
  dyd_budget spent;
  dyd_error err;
  dyd_scouts scouts; /* of the next stage */
} run;

/* The finest request that streams take (stream/nest.c). */
#define MOST_BITS (DYD_EXP_LIMIT - 64)
#define MOST_GOAL_BITS ((int64_t)1 << 40)

/* Fills in defaults. false: an option is out of its range. */
static bool set_options(dyd_engine_options *o) {
  if (o->max_bits == 0) o->max_bits = 4096;
  if (o->max_bits > MOST_BITS) o->max_bits = MOST_BITS;
  if (o->start_bits > o->max_bits) o->start_bits = o->max_bits;
  if (o->start_bits < -DYD_EXP_LIMIT || o->goal_bits > MOST_GOAL_BITS || o->goal_bits < -MOST_GOAL_BITS) return false;
  if (!(o->seconds >= 0) || o->step_bits < 0) return false;
  if (o->goal < DYD_GOAL_DECIDED || o->goal > DYD_GOAL_VORONOI_HAUSDORFF) return false;
  if (dyd_goal_is_voronoi(o->goal) && !dyd_engine_window_is_good(o->window)) return false;
  return o->schedule == DYD_SCHEDULE_ADAPTIVE || o->schedule == DYD_SCHEDULE_UNIFORM;
}

static void end_budget(run *r, dyd_budget spent) {
  r->end = DYD_OUTCOME_BUDGET;
  r->spent = spent;
}

static void end_error(run *r, dyd_status status) {
  r->end = DYD_OUTCOME_ERROR;
  r->err.code = status;
  if (!r->err.message[0]) dyd_fail(&r->err, status, "%s", dyd_status_text(status));
}

/* Ends the run when it was cancelled or is out of time. */
static bool is_stopped(run *r) {
  if (dyd_flag_get(&r->e->cancelled))
    r->end = DYD_OUTCOME_CANCELLED;
  else if (dyd_watch_is_late(&r->watch))
    end_budget(r, DYD_BUDGET_SECONDS);
  return r->end != DYD_OUTCOME_NONE;
}

static bool calls_are_spent(const run *r) {
  return r->o.max_calls && r->calls >= r->o.max_calls;
}

/* Work was interrupted because e->stop is raised: by a cancel or at the deadline, and by nothing else. */
static void end_interrupted(run *r) {
  if (dyd_flag_get(&r->e->cancelled))
    r->end = DYD_OUTCOME_CANCELLED;
  else
    end_budget(r, DYD_BUDGET_SECONDS);
}

/* ---- a stage ---- */

/* Tells of p, just brought to p->want. */
static dyd_status tell_step(const run *r, const dyd_refinable *p, bool called) {
  dyd_rect rect;
  dyd_rect_init(&rect);
  dyd_status status = dyd_sites_get(&rect, r->e->sites, p->site);
  dyd_step step = {DYD_SIZED(dyd_step), .stage = r->e->stages + 1, .site = p->site,
                   .bits = p->want,     .reason = p->reason,       .called = called};
  step.i = p->pair[0];
  step.j = p->pair[1];
  step.rect = &rect;
  if (status >= 0) r->o.trace(r->o.trace_user, &step);
  dyd_rect_clear(&rect);
  return status;
}

/* Narrows the marked points. *bits is raised to the greatest precision asked for; *cut whether points
 * are left because calls are used up. On failure and when stopped the points after are left marked. */
static dyd_status narrow_marked(int64_t *bits, bool *cut, run *r, size_t marked) {
  dyd_engine *e = r->e;
  size_t need = e->pd ? e->changes + marked : 0;
  if (!dyd_reserve((void **)&e->changed, &e->change_cap, need, sizeof *e->changed)) return DYD_E_NOMEM;
  dyd_engine_announce(e, r->o.max_calls ? r->o.max_calls - r->calls : UINT64_MAX, r->o.max_bits);
  for (size_t k = 0; k < e->points; k++) {
    dyd_refinable *p = &e->point[k];
    if (!p->marked) continue;
    if (is_stopped(r)) return DYD_OK;
    if (calls_are_spent(r)) {
      *cut = true;
      return DYD_OK;
    }
    uint64_t calls = 0;
    dyd_status status = dyd_engine_narrow(p, &calls, e, p->want, r->o.max_bits, &r->err);
    r->calls += calls;
    e->calls += calls;
    if (status < 0) return status;
    if (status == DYD_CANCELLED) {
      end_interrupted(r);
      return DYD_OK;
    }
    p->marked = false;
    if (p->want > *bits) *bits = p->want;
    if (e->pd && calls) e->changed[e->changes++] = p->site;
    if (r->o.trace) status = tell_step(r, p, calls != 0);
    if (status < 0) return status;
  }
  return DYD_OK;
}

/* Adds the sites of all undecided faces to those changed, so that faces given up at a cap are worked on again. */
static dyd_status list_undecided(dyd_engine *e) {
  dyd_status status = DYD_OK;
  dyd_index_list sites = {0};
  size_t faces = dyd_delaunay_undecided_faces(e->pd);
  for (size_t f = 0; status >= 0 && f < faces; f++) {
    bool outer;
    status = dyd_delaunay_face(&sites, &outer, e->pd, f);
    if (status < 0) break;
    size_t need = e->changes + sites.count;
    if (!dyd_reserve((void **)&e->changed, &e->change_cap, need, sizeof *e->changed)) status = DYD_E_NOMEM;
    for (size_t k = 0; status >= 0 && k < sites.count; k++) e->changed[e->changes++] = sites.item[k];
    dyd_index_list_clear(&sites);
  }
  dyd_index_list_clear(&sites);
  return status;
}

/* Makes the result, or brings it up to date. Ends the run when that was interrupted. */
static dyd_status triangulate(run *r, dyd_error *err) {
  dyd_engine *e = r->e;
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = r->o.max_pairs, .cancel = &e->stop,
                            .threads = r->o.threads, .no_filter = r->o.no_filter};
  dyd_error_clear(err);
  dyd_status status =
      e->pd ? dyd_delaunay_update(e->pd, e->changed, e->changes, &o, err) : dyd_delaunay_new(&e->pd, e->sites, &o, err);
  if (status == DYD_CANCELLED) {
    end_interrupted(r);
    return DYD_OK;
  }
  if (status < 0) return status;
  if (status == DYD_CAPPED) e->cap_error = *err;
  e->max_pairs = r->o.max_pairs;
  e->changes = 0;
  e->stages++;
  r->stages++;
  return DYD_OK;
}

static void report(const run *r, int64_t bits) {
  if (!r->o.progress) return;
  const dyd_engine *e = r->e;
  dyd_progress p = {DYD_SIZED(dyd_progress), .stage = e->stages, .bits = bits, .sites = dyd_sites_count(e->sites)};
  dyd_delaunay_count(p.count, e->pd);
  p.undecided_faces = dyd_delaunay_undecided_faces(e->pd);
  p.seconds = r->seconds_before + dyd_watch_seconds(&r->watch);
  r->o.progress(r->o.progress_user, &p);
}

/* Lets the scouts go ahead; *marked becomes what is left to narrow after them. Ends as narrow_marked. */
static dyd_status send_scouts(size_t *marked, int64_t *bits, bool *cut, run *r) {
  dyd_status status = DYD_OK;
  size_t sent = r->scouts.count;
  while (status >= 0 && sent && !*cut && r->end == DYD_OUTCOME_NONE) {
    status = dyd_scouts_next(&sent, &r->scouts, r->e, &r->o);
    if (status >= 0 && sent) status = narrow_marked(bits, cut, r, sent);
  }
  if (r->scouts.count) dyd_scouts_finish(marked, &r->scouts, r->e, &r->o);
  dyd_scouts_clear(&r->scouts);
  return status;
}

/* One stage: narrows what is marked and triangulates. */
static dyd_status stage(run *r, size_t marked) {
  int64_t bits = INT64_MIN;
  bool cut = false;
  dyd_error ignored;
  dyd_status failed = send_scouts(&marked, &bits, &cut, r), status = DYD_OK;
  if (failed >= 0 && !cut && r->end == DYD_OUTCOME_NONE) failed = narrow_marked(&bits, &cut, r, marked);
  if (r->end != DYD_OUTCOME_NONE) return DYD_OK;
  if (cut && !r->e->pd) end_budget(r, DYD_BUDGET_CALLS);
  if ((cut || failed < 0) && (!r->e->pd || r->e->changes == 0)) return failed;
  uint64_t before = r->e->stages;
  status = triangulate(r, failed < 0 ? &ignored : &r->err);
  if (r->e->stages > before) report(r, bits == INT64_MIN ? 0 : bits);
  return failed < 0 ? failed : status;
}

/* ---- the loop ---- */

/* Nothing is marked: why? */
static void end_exhausted(run *r, const dyd_plan *plan) {
  if (dyd_delaunay_is_capped(r->e->pd)) {
    r->err = r->e->cap_error;
    end_budget(r, DYD_BUDGET_PAIRS);
  } else if (plan->bits_blocked) {
    end_budget(r, DYD_BUDGET_BITS);
  } else {
    r->end = DYD_OUTCOME_FIXPOINT;
  }
}

/* Looks at an up-to-date result: ends the run, or marks what to narrow next. */
static dyd_status judge(size_t *marked, run *r) {
  bool holds;
  dyd_plan plan = {0};
  dyd_status status = dyd_engine_goal_holds(&holds, r->e, &r->o);
  if (status < 0) return status;
  if (status == DYD_CANCELLED) {
    end_interrupted(r);
    return DYD_OK;
  }
  if (holds) {
    r->end = r->o.goal == DYD_GOAL_DECIDED ? DYD_OUTCOME_DECIDED : DYD_OUTCOME_CERTIFIED;
    return DYD_OK;
  }
  status = dyd_engine_plan(&plan, &r->scouts, r->e, &r->o);
  *marked = plan.marked;
  if (status >= 0 && plan.marked == 0) end_exhausted(r, &plan);
  return status;
}

/* Prepares the next stage: what is marked, or how the run ends. */
static dyd_status prepare(size_t *marked, run *r) {
  dyd_engine *e = r->e;
  dyd_status status = DYD_OK;
  *marked = 0;
  dyd_error_clear(&r->err);
  for (size_t k = 0; k < e->points; k++) e->point[k].marked = false;
  if (dyd_flag_get(&e->cancelled)) {
    r->end = DYD_OUTCOME_CANCELLED;
    return DYD_OK;
  }
  if (!e->pd) {
    dyd_plan plan;
    dyd_engine_plan_first(&plan, e, &r->o);
    *marked = plan.marked;
  } else if (e->changes == 0) {
    status = judge(marked, r);
  }
  if (status < 0 || r->end != DYD_OUTCOME_NONE) return status;
  if (r->o.max_stages && r->stages >= r->o.max_stages)
    end_budget(r, DYD_BUDGET_STAGES);
  else if (*marked && calls_are_spent(r))
    end_budget(r, DYD_BUDGET_CALLS);
  else
    is_stopped(r);
  return DYD_OK;
}

/* Does the cap now given allow more than the one the result met? 0 is the default cap. */
static bool cap_was_raised(const run *r) {
  const dyd_engine *e = r->e;
  return e->pd && dyd_delaunay_is_capped(e->pd) && e->max_pairs != r->o.max_pairs;
}

static dyd_status loop(run *r) {
  dyd_status status = cap_was_raised(r) ? list_undecided(r->e) : DYD_OK;
  while (status >= 0 && r->end == DYD_OUTCOME_NONE) {
    size_t marked;
    status = prepare(&marked, r);
    if (status >= 0 && r->end == DYD_OUTCOME_NONE) status = stage(r, marked);
  }
  return status;
}

static void begin(run *r, dyd_engine *e) {
  r->e = e;
  r->end = DYD_OUTCOME_NONE;
  r->spent = DYD_BUDGET_NONE;
  r->stages = r->calls = 0;
  r->seconds_before = e->seconds;
  r->scouts = (dyd_scouts){0};
  dyd_error_clear(&r->err);
  /* Clear first, look after: a cancel that comes in between is not lost. */
  dyd_flag_set(&e->stop, 0);
  if (dyd_flag_get(&e->cancelled)) dyd_flag_set(&e->stop, 1);
}

dyd_status dyd_engine_run(dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *options, dyd_error *err) {
  run r;
  begin(&r, e);
  dyd_status status = dyd_abi_take(&r.o, sizeof r.o, options, "dyd_engine_options", &r.err);
  if (status == DYD_OK && set_options(&r.o)) {
    e->started = true;
    e->goal = r.o.goal;
    e->goal_bits = r.o.goal_bits;
    dyd_watch_start(&r.watch, r.o.seconds, &e->stop);
    status = loop(&r);
    dyd_watch_stop(&r.watch);
    dyd_scouts_clear(&r.scouts);
    e->seconds += dyd_watch_seconds(&r.watch);
  } else if (status == DYD_OK) {
    status = dyd_fail(&r.err, DYD_E_ARG, "an option of the run is out of its range");
  }
  if (status < 0)
    end_error(&r, status);
  else if (r.spent != DYD_BUDGET_PAIRS)
    dyd_error_clear(&r.err);
  if (r.end == DYD_OUTCOME_CANCELLED) dyd_flag_set(&e->cancelled, 0);
  e->outcome = *outcome = r.end;
  e->spent = r.spent;
  if (err) *err = r.err;
  return status;
}
