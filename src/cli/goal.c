/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of a bound that was asked for and not reached.
 *
 * A bound m * 2^e > 0 with k bits in m is at most 2^(k+e), or 2^(k+e-1) when m = 1: bounds are told as such powers,
 * which is also how goals are given. */
#include "cli.h"
#include <inttypes.h>

static const char *goal_subject(dyd_goal goal) {
  static const char *const subject[] = {[DYD_GOAL_AREA] = "the undetermined area of the triangulation",
                                        [DYD_GOAL_HAUSDORFF] = "the distance to the true triangulation",
                                        [DYD_GOAL_VORONOI_AREA] = "the undetermined area of the diagram",
                                        [DYD_GOAL_VORONOI_HAUSDORFF] = "the distance to the true diagram"};
  return subject[goal];
}

dyd_goal cli_voronoi_goal(dyd_goal goal) {
  if (goal == DYD_GOAL_AREA) return DYD_GOAL_VORONOI_AREA;
  return goal == DYD_GOAL_HAUSDORFF ? DYD_GOAL_VORONOI_HAUSDORFF : goal;
}

static bool goal_is_area(dyd_goal goal) {
  return goal == DYD_GOAL_AREA || goal == DYD_GOAL_VORONOI_AREA;
}

/* The bound reached; false when none is known. */
static bool goal_reached(dyd_dyadic *out, const cli_session *s, dyd_goal goal) {
  bool known = false;
  dyd_dyadic other;
  dyd_dyadic_init(&other);
  if (goal == DYD_GOAL_AREA)
    known = dyd_engine_bounds(out, &other, s->engine) == DYD_OK;
  else if (goal == DYD_GOAL_HAUSDORFF)
    known = dyd_engine_bounds(&other, out, s->engine) == DYD_OK;
  else if (s->bounds)
    known = goal_is_area(goal) || s->bounds->finite;
  if (known && goal == DYD_GOAL_VORONOI_AREA) dyd_dyadic_set(out, &s->bounds->area);
  if (known && goal == DYD_GOAL_VORONOI_HAUSDORFF) dyd_dyadic_set(out, &s->bounds->hausdorff);
  dyd_dyadic_clear(&other);
  return known && dyd_dyadic_sgn(out) > 0;
}

/* The least e with bound <= 2^e. */
static int64_t power_above(const dyd_dyadic *bound) {
  int64_t top = bound->exp + (int64_t)mpz_sizeinbase(bound->man, 2);
  return mpz_cmp_ui(bound->man, 1) == 0 ? top - 1 : top;
}

bool cli_note_goal(const cli_session *s, const char *advice) {
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, s->engine);
  if (goal == DYD_GOAL_DECIDED) return false;
  const char *outcome = dyd_outcome_text(dyd_engine_outcome(s->engine)),
             *name = goal_is_area(goal) ? "area" : "hausdorff";
  dyd_dyadic bound;
  dyd_dyadic_init(&bound);
  if (goal_reached(&bound, s, goal)) {
    int64_t power = power_above(&bound);
    cli_complain("%s: %s is at most 2^%" PRId64 ", not 2^%" PRId64 " as asked; %s; --until %s:%" PRId64 " holds",
                 outcome, goal_subject(goal), power, -bits, advice, name, -power);
  } else {
    cli_complain("%s: %s is not known to be at most 2^%" PRId64 ", as asked; no bound is known; %s", outcome,
                 goal_subject(goal), -bits, advice);
  }
  dyd_dyadic_clear(&bound);
  return true;
}
