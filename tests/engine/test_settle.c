/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that hang on fixed rectangles: a run that ends with fixpoint although points could be narrowed is right,
 * whatever these points are [SET-1] [SET-2]; every decidable pair is decided; wide streams are not narrowed more than
 * that needs. */
#include "engine/help.h"
#include "engine/settle.h"
#include "rect/rect.h"

#include <math.h>

/* Points that are known as roughly as asked, anywhere around a hidden place. */
typedef struct rough {
  test_random random;
  double at[16][2];
} rough;

static dyd_status rough_narrow(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  rough *f = user;
  double w = ldexp(1, -(int)q->bits), end[4], had[4] = {-1e9, 1e9, -1e9, 1e9};
  dyd_interval *side[2] = {&out->x, &out->y};
  (void)err;
  if (!dyd_interval_is_unset(&out->x)) dyd_rect_get_d(had, out);
  for (int a = 0; a < 2; a++) {
    double below = test_unit(&f->random) * w, v = f->at[q->point][a];
    end[2 * a] = fmax(had[2 * a], v - below);
    end[2 * a + 1] = fmin(had[2 * a + 1], v + (w - below));
    if (dyd_interval_set_d(side[a], end[2 * a], end[2 * a + 1]) != DYD_OK) return DYD_E_STREAM;
  }
  return DYD_OK;
}

/* fixed boxes, some of them points or segments, and loose points, in a square of 8; the more, the smaller. */
static void add_mixed(dyd_engine *e, rough *f, test_random *r, size_t fixed, size_t loose) {
  for (size_t k = 0; k < fixed; k++) {
    double most = fixed < 10 ? 2 : 1;
    double x = 8 * test_unit(r), y = 8 * test_unit(r), w = most * test_unit(r), h = most * test_unit(r), x1, y1;
    if (test_chance(r, 6)) w = 0;
    if (test_chance(r, 6)) h = 0;
    x1 = x + w;
    y1 = y + h;
    assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &x, &x1, &y, &y1, NULL));
  }
  for (size_t k = 0; k < loose; k++)
    for (int a = 0; a < 2; a++) f->at[k][a] = 8 * test_unit(r);
  f->random = *r;
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = rough_narrow, .user = f};
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, loose, &source, NULL));
}

/* The end of a box, or somewhere in it. */
static double anywhere(test_random *r, double lo, double hi) {
  uint64_t kind = test_below(r, 3);
  return kind == 0 ? lo : kind == 1 ? hi : fmin(hi, lo + (hi - lo) * test_unit(r));
}

/* The triangulation when the loose points are anywhere in their rectangles. */
static dyd_delaunay *narrowed(dyd_sites **then, const dyd_engine *e, test_random *r, size_t fixed) {
  const dyd_sites *now = dyd_engine_sites(e);
  dyd_delaunay *pd;
  assert_int_equal(DYD_OK, dyd_sites_new(then));
  for (size_t i = 0; i < dyd_sites_count(now); i++) {
    double d[4];
    dyd_sites_get_d(d, now, i); /* doubles hold all of them */
    if (i >= fixed) d[0] = d[1] = anywhere(r, d[0], d[1]);
    if (i >= fixed) d[2] = d[3] = anywhere(r, d[2], d[3]);
    assert_int_equal(DYD_OK, dyd_sites_add_boxes(*then, 1, &d[0], &d[1], &d[2], &d[3]));
  }
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, *then, NULL, NULL));
  return pd;
}

/* Every indeterminate pair stays one. */
static void check_settled(const dyd_engine *e, test_random *r, size_t fixed) {
  dyd_sites *then;
  dyd_delaunay *pd = narrowed(&then, e, r, fixed);
  dyd_pair_list pairs = {0};
  assert_int_equal(DYD_OK, dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)));
  for (size_t k = 0; k < pairs.count; k++)
    if (pairs.item[k].status == DYD_INDETERMINATE)
      assert_int_equal(DYD_INDETERMINATE, dyd_delaunay_status(pd, pairs.item[k].i, pairs.item[k].j));
  dyd_delaunay_free(pd);
  dyd_sites_free(then);
  dyd_pair_list_clear(&pairs);
}

static bool can_be_narrowed(const dyd_engine *e, size_t fixed) {
  for (size_t i = fixed; i < dyd_engine_count(e); i++)
    if (!dyd_sites_is_point(dyd_engine_sites(e), i)) return true;
  return false;
}

static void test_settled(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t early = 0, rounds = test_cases(120);
  for (size_t round = 0; round < rounds; round++) {
    rough f;
    size_t fixed = (size_t)test_between(&r, 2, round % 3 ? 9 : 24), loose = (size_t)test_between(&r, 1, 6), count[4];
    dyd_engine_options o;
    dyd_outcome outcome;
    dyd_error err;
    dyd_engine *e = engine_new();
    add_mixed(e, &f, &r, fixed, loose);
    dyd_engine_options_init(&o);
    o.start_bits = test_between(&r, 0, 5);
    o.step_bits = test_between(&r, 0, 2);
    o.max_bits = 40;
    if (o.start_bits == 0) o.start_bits = 1;
    o.schedule = test_chance(&r, 4) ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, &err));
    engine_count(count, e);
    if (outcome == DYD_OUTCOME_FIXPOINT) {
      early += can_be_narrowed(e, fixed);
      assert_true(count[DYD_INDETERMINATE] > 0);
      for (int k = 0; k < 20; k++) check_settled(e, &r, fixed);
    }
    dyd_engine_free(e);
  }
  fprintf(stderr, "# %zu of %zu runs ended early\n", early, rounds);
  assert_true(early > rounds * 3 / 4);
}

/* A few sites, judged without the others around them: statements about their pairs are true wherever the loose points
 * are. */
static void check_few(size_t said[2], const dyd_engine *e, test_random *r, size_t fixed) {
  enum { FEW = 5, PAIRS = FEW * (FEW - 1) / 2 };
  size_t count = 0;
  dyd_settle_work work = {SIZE_MAX, SIZE_MAX};
  uint32_t few[FEW];
  dyd_settled_pair pair[PAIRS];
  for (uint32_t k = 0; k < FEW; k++) few[k] = (uint32_t)(k * dyd_engine_count(e) / FEW);
  for (uint32_t k = 0; k < FEW * FEW; k++)
    if (k / FEW < k % FEW) pair[count++] = (dyd_settled_pair){few[k / FEW], few[k % FEW], false, false};
  const dyd_index_list face = {.item = few, .count = FEW};
  assert_int_equal(DYD_OK, dyd_settle_face(pair, &work, NULL, e, count, &face));
  for (int n = 0; n < 20; n++) {
    dyd_sites *then;
    dyd_delaunay *pd = narrowed(&then, e, r, fixed);
    for (size_t k = 0; k < count; k++) {
      dyd_pair_status status = dyd_delaunay_status(pd, pair[k].i, pair[k].j);
      assert_true(!pair[k].possible || status != DYD_ILLEGAL);
      assert_true(!pair[k].unsure || status != DYD_LEGAL);
    }
    dyd_delaunay_free(pd);
    dyd_sites_free(then);
  }
  for (size_t k = 0; k < count; k++) {
    said[0] += pair[k].possible;
    said[1] += pair[k].unsure;
  }
}

static void test_few(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  size_t said[2] = {0, 0};
  for (size_t round = 0; round < test_cases(150); round++) {
    rough f;
    size_t fixed = (size_t)test_between(&r, 3, 9), loose = (size_t)test_between(&r, 3, 9);
    dyd_engine_options o;
    dyd_outcome outcome;
    dyd_engine *e = engine_new();
    add_mixed(e, &f, &r, fixed, loose);
    dyd_engine_options_init(&o);
    o.start_bits = o.max_bits = test_between(&r, 1, 4);
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    check_few(said, e, &r, fixed);
    dyd_engine_free(e);
  }
  fprintf(stderr, "# %zu possible, %zu never legal\n", said[0], said[1]);
  assert_true(said[0] > 100 && said[1] > 100);
}

/* A crowd: boxes 0.05 wide and points that expressions give, anywhere in a unit square. Nothing but the boxes keeps
 * pairs open, and all of these are found. */
static void test_crowd(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  for (size_t round = 0; round < test_cases(2); round++) {
    dyd_engine *e = engine_new();
    char text[2][64];
    for (int k = 0; k < 60; k++) {
      double x0 = test_unit(&r), y0 = test_unit(&r), x1 = x0 + 0.05, y1 = y0 + 0.05;
      assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &x0, &x1, &y0, &y1, NULL));
    }
    for (int k = 0; k < 200; k++) {
      for (int a = 0; a < 2; a++) snprintf(text[a], sizeof text[a], "%.6f+sqrt(2)/1000", test_unit(&r));
      engine_add_text(e, text[0], text[1]);
    }
    engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
    assert_true(engine_counters(e).bits_most <= 1024);
    dyd_engine_free(e);
  }
}

/* With a bound as the goal, narrowing continues. */
static void test_bound(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_engine_options o;
  const double x0 = 3.9, x1 = 4.2, zero = 0;
  dyd_engine_options_init(&o);
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &x0, &x1, &x0, &x1, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &zero, &zero, NULL));
  engine_add_text(e, "sqrt(16.5)", "0");
  engine_add_text(e, "0", "sqrt(17)");
  engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
  assert_true(engine_counters(e).bits_most <= 128);
  o.goal = DYD_GOAL_HAUSDORFF;
  o.goal_bits = 20;
  o.max_bits = 512;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(512, engine_counters(e).bits_most);
  dyd_engine_free(e);
}

/* A pair that only bits decide, next to one that only the box could decide: the first is decided, and that is all. */
static void test_both(void **state) {
  (void)state;
  const int weights[4] = {1, 0, 0, 0};
  dyd_engine *e = engine_new();
  size_t count[4];
  const double x0[2] = {20, 3}, x1[2] = {20.5, 3}, y0[2] = {-0.25, 0}, y1[2] = {0.25, 0};
  engine_add_polygon(e, 4, weights, 300);
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 2, x0, x1, y0, y1, NULL));
  engine_add_text(e, "20+sqrt(0.06)", "4");
  engine_add_text(e, "16+sqrt(0.06)", "sqrt(0.001)");
  engine_add_text(e, "20+sqrt(0.05)", "-4");
  engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
  engine_count(count, e);
  assert_true(count[DYD_INDETERMINATE] > 0);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  assert_int_equal(DYD_ILLEGAL, dyd_delaunay_status(pd, 0, 2));
  assert_int_equal(DYD_LEGAL, dyd_delaunay_status(pd, 1, 3));
  assert_true(engine_counters(e).bits_most >= 300 && engine_counters(e).bits_most < 4096);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_settled), cmocka_unit_test(test_few),  cmocka_unit_test(test_crowd),
      cmocka_unit_test(test_bound),   cmocka_unit_test(test_both),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
