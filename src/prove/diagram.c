/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section of a certificate on the Voronoi diagram: the window, inner polygons, bounds.
 *
 * The polygons are those of the bounds in metric.h, vertex by vertex, so that no area is lost; a polygon that the
 * checker's own tests do not take is left out. */
#include "base/alloc.h"
#include "checker/checker.h"
#include "metric/bounds.h"
#include "prove/proof.h"
#include <inttypes.h>

typedef struct section {
  FILE *out;
  dyd_proof *proof;
  dyd_cert_window window;
  dyd_cert_chain polygon;
  dyd_exact area2; /* twice the area of the polygons written */
} section;

/* ---- polygons ---- */

static bool polygon_passes(const section *s, uint32_t i) {
  const dyd_proof *p = s->proof;
  if (!dyd_cert_polygon_is_convex(&s->polygon)) return false;
  for (size_t k = 0; k < s->polygon.points; k++) {
    const dyd_exact *at = s->polygon.point[k];
    if (!dyd_cert_window_has(&s->window, at) || !dyd_cert_is_witness(NULL, &p->sites, &p->tree, i, i, at, false))
      return false;
  }
  return true;
}

static dyd_status section_polygon(void *context, uint32_t i, const dyd_shape *shape, const double area[2]) {
  section *s = context;
  dyd_polygon polygon = {0};
  (void)area;
  dyd_status st = dyd_shape_inner(&polygon, shape);
  if (st == DYD_OK) st = dyd_cert_chain_resize(&s->polygon, polygon.count);
  for (size_t k = 0; st == DYD_OK && k < polygon.count; k++) {
    dyd_proof_set(&s->polygon.point[k][0], &polygon.vertex[k].x);
    dyd_proof_set(&s->polygon.point[k][1], &polygon.vertex[k].y);
  }
  dyd_polygon_clear(&polygon);
  if (st != DYD_OK || !polygon_passes(s, i)) return st;
  fprintf(s->out, "%" PRIu32, i);
  for (size_t k = 0; k < s->polygon.points; k++) {
    putc(' ', s->out);
    dyd_proof_put_point(s->out, (const dyd_exact *)s->polygon.point[k]);
  }
  putc('\n', s->out);
  dyd_cert_polygon_area2(&s->area2, &s->polygon);
  return DYD_OK;
}

/* ---- bounds ---- */

/* x is rounded up by at most 2^-60 of itself. */
static void exact_round_up(dyd_exact *x) {
  int64_t exp = dyd_exact_top(x) - 61;
  if (dyd_exact_sgn(x) == 0 || exp <= x->exp) return;
  dyd_exact_ceil(x->man, x, NULL, exp);
  x->exp = exp;
}

static void section_area(section *s) {
  dyd_exact left;
  dyd_exact_init(&left);
  dyd_cert_window_area(&left, &s->window);
  s->area2.exp--;
  dyd_exact_sub(&left, &left, &s->area2);
  exact_round_up(&left);
  fputs("undetermined ", s->out);
  dyd_proof_put_number(s->out, &left);
  putc('\n', s->out);
  dyd_exact_clear(&left);
}

/* *bound, or up to four times as much, is proved, within the goal if one was reached; else *proved = false. */
static dyd_status section_prove_distance(bool *proved, dyd_exact *bound, const section *s, const dyd_exact *goal) {
  static const unsigned long sixteenths[] = {16, 17, 32, 64};
  dyd_exact try;
  dyd_exact_init(&try);
  dyd_status st = DYD_OK;
  *proved = false;
  for (int k = 0; k < 4 && st == DYD_OK && !*proved; k++) {
    mpz_mul_ui(try.man, bound->man, sixteenths[k]);
    try.exp = bound->exp - 4;
    bool last = goal && dyd_exact_cmp(&try, goal) > 0;
    if (last) dyd_exact_set(&try, goal);
    st = dyd_cert_distance_holds(proved, &s->proof->sites, &s->window, &try);
    if (last) break;
  }
  if (st == DYD_OK && *proved) dyd_exact_set(bound, &try);
  dyd_exact_clear(&try);
  return st;
}

static dyd_status section_distance(const section *s, const dyd_voronoi_bounds *b) {
  const dyd_engine *e = s->proof->engine;
  int64_t bits;
  bool asked =
      dyd_engine_goal(&bits, e) == DYD_GOAL_VORONOI_HAUSDORFF && dyd_engine_outcome(e) == DYD_OUTCOME_CERTIFIED;
  bool proved = false;
  if (!b->finite) {
    fputs("distance none\n", s->out);
    return DYD_OK;
  }
  dyd_exact bound, goal;
  dyd_exact_init(&bound);
  dyd_exact_init(&goal);
  dyd_proof_set(&bound, &b->hausdorff);
  mpz_set_ui(goal.man, 1);
  goal.exp = -bits;
  dyd_status st = section_prove_distance(&proved, &bound, s, asked ? &goal : NULL);
  fputs("distance ", s->out);
  dyd_proof_put_number(s->out, &bound);
  fputs(proved ? "\n" : " unproved\n", s->out);
  dyd_exact_clear(&bound);
  dyd_exact_clear(&goal);
  return st;
}

/* ---- all ---- */

/* Fine for the eye; where a goal on the area was reached, as fine as that takes. */
static dyd_status section_bits(int64_t *out, const dyd_proof *p, const dyd_rect *window) {
  enum { FINER = 8, MOST_FINER = 72 };
  int64_t goal_bits;
  dyd_dyadic goal;
  dyd_voronoi_bounds b;
  *out = dyd_metric_coarseness(p->pd, window) + 4;
  if (dyd_engine_goal(&goal_bits, p->engine) != DYD_GOAL_VORONOI_AREA ||
      dyd_engine_outcome(p->engine) != DYD_OUTCOME_CERTIFIED)
    return DYD_OK;
  dyd_dyadic_init(&goal);
  dyd_voronoi_bounds_init(&b);
  dyd_status st = dyd_dyadic_set_si_2exp(&goal, 1, -goal_bits);
  int64_t least = dyd_metric_flattening(p->pd, window, goal_bits);
  bool holds = false;
  for (int finer = 0; st == DYD_OK && !holds && finer <= MOST_FINER; finer += FINER) {
    if (least + finer > *out) *out = least + finer;
    st = dyd_metric_voronoi(&b, p->pd, window, *out, NULL);
    holds = st == DYD_OK && dyd_dyadic_cmp(&b.area, &goal) <= 0;
  }
  dyd_voronoi_bounds_clear(&b);
  dyd_dyadic_clear(&goal);
  return st;
}

static dyd_status section_write(section *s, const dyd_rect *window) {
  dyd_voronoi_sums sums;
  dyd_voronoi_bounds bounds;
  int64_t bits;
  dyd_status st = section_bits(&bits, s->proof, window);
  if (st != DYD_OK) return st;
  dyd_voronoi_bounds_init(&bounds);
  st = dyd_voronoi_sums_init(&sums, s->proof->pd, window, bits);
  sums.exact = false;
  fputs("window", s->out);
  for (int k = 0; k < 4; k++) {
    putc(' ', s->out);
    dyd_proof_put_number(s->out, &s->window.e[k]);
  }
  fputs("\npolygons\n", s->out);
  if (st == DYD_OK) st = dyd_voronoi_sums_all(&sums, section_polygon, s);
  if (st == DYD_OK) st = dyd_voronoi_sums_bounds(&bounds, &sums);
  if (st == DYD_OK) section_area(s);
  if (st == DYD_OK) st = section_distance(s, &bounds);
  dyd_voronoi_sums_clear(&sums);
  dyd_voronoi_bounds_clear(&bounds);
  return st;
}

dyd_status dyd_proof_put_diagram(FILE *out, dyd_proof *p, const dyd_rect *window) {
  const dyd_dyadic *end[4] = {&window->x.lo, &window->x.hi, &window->y.lo, &window->y.hi};
  section s = {.out = out, .proof = p};
  if (dyd_delaunay_is_capped(p->pd)) return DYD_OK;
  dyd_cert_window_init(&s.window);
  dyd_cert_chain_init(&s.polygon);
  dyd_exact_init(&s.area2);
  for (int k = 0; k < 4; k++) dyd_proof_set(&s.window.e[k], end[k]);
  dyd_status st = section_write(&s, window);
  dyd_exact_clear(&s.area2);
  dyd_cert_chain_clear(&s.polygon);
  dyd_cert_window_clear(&s.window);
  return st;
}
