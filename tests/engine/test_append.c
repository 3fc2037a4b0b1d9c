/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points that come after a run, and points that are measured again: results are those of an engine that has had it all
 * from the start; refused calls give a reason and change nothing. */
#include "engine/help.h"
#include "rect/rect.h"
#include "support/compose.h"

#include <math.h>
#include <string.h>

/* ---- the same result as all at once ---- */

typedef struct cloud {
  size_t n;
  double x0[40], x1[40], y0[40], y1[40];
} cloud;

/* kind 0: integers of a small square, with repeats, ties and lines; 1: on one line; 2: doubles; 3: boxes that meet here
 * and there; 4: all of these. */
static void cloud_random(cloud *c, test_random *r, int kind) {
  c->n = (size_t)test_between(r, 1, 24);
  for (size_t k = 0; k < c->n; k++) {
    int as = kind == 4 ? (int)test_between(r, 0, 3) : kind;
    double x = (double)test_between(r, -3, 3), y = as == 1 ? 2 * x : (double)test_between(r, -3, 3), w = 0;
    if (as >= 2) x += (double)test_between(r, 0, 1000000) / 7e5;
    if (as >= 2) y += (double)test_between(r, 0, 1000000) / 7e5;
    if (as == 3) w = (double)test_between(r, 0, 4) / 4;
    c->x0[k] = x;
    c->x1[k] = x + w;
    c->y0[k] = y;
    c->y1[k] = y + w / 2;
  }
}

/* Points first .. first+n-1, as points where they are; later: appended. */
static void cloud_put(dyd_engine *e, const cloud *c, size_t first, size_t n, bool later) {
  dyd_error err;
  for (size_t k = first; k < first + n; k++) {
    bool point = c->x0[k] == c->x1[k] && c->y0[k] == c->y1[k];
    dyd_status st = !later  ? point ? dyd_engine_add_points(e, 1, &c->x0[k], &c->y0[k], NULL)
                                    : dyd_engine_add_boxes(e, 1, &c->x0[k], &c->x1[k], &c->y0[k], &c->y1[k], NULL)
                     : point ? dyd_engine_add_points(e, 1, &c->x0[k], &c->y0[k], &err)
                            : dyd_engine_add_boxes(e, 1, &c->x0[k], &c->x1[k], &c->y0[k], &c->y1[k], &err);
    assert_int_equal(DYD_OK, st);
  }
}

static dyd_outcome run_any(dyd_engine *e) {
  dyd_outcome outcome;
  dyd_error err;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, NULL, &err));
  return outcome;
}

static void assert_same_pairs(const dyd_delaunay *a, const dyd_delaunay *b) {
  dyd_pair_list p = {0}, q = {0};
  assert_int_equal(DYD_OK, dyd_delaunay_pairs(&p, a));
  assert_int_equal(DYD_OK, dyd_delaunay_pairs(&q, b));
  assert_int_equal(p.count, q.count);
  for (size_t k = 0; k < p.count; k++) {
    assert_int_equal(p.item[k].i, q.item[k].i);
    assert_int_equal(p.item[k].j, q.item[k].j);
    assert_int_equal(p.item[k].status, q.item[k].status);
  }
  for (uint32_t i = 0; i < dyd_sites_count(dyd_delaunay_sites(a)); i++)
    assert_int_equal(dyd_delaunay_alias(a, i), dyd_delaunay_alias(b, i));
  dyd_pair_list_clear(&p);
  dyd_pair_list_clear(&q);
}

/* The result of e against one made anew of the rectangles as they are. */
static void assert_as_fresh(const dyd_engine *e) {
  dyd_delaunay *pd = NULL;
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, dyd_engine_sites(e), NULL, NULL));
  assert_same_pairs(dyd_engine_delaunay(e), pd);
  dyd_delaunay_free(pd);
}

/* The cloud, `start` points at first and then `step` at a time, with a run after each. */
static void check_cloud(const cloud *c, size_t start, size_t step) {
  dyd_engine *e = engine_new(), *all = engine_new();
  cloud_put(all, c, 0, c->n, false);
  dyd_outcome want = run_any(all), got;
  cloud_put(e, c, 0, start, false);
  got = run_any(e);
  for (size_t k = start; k < c->n; k += step) {
    size_t n = c->n - k < step ? c->n - k : step;
    uint64_t stages = engine_counters(e).stages;
    cloud_put(e, c, k, n, true);
    assert_null(dyd_engine_delaunay(e));
    assert_int_equal(DYD_OUTCOME_NONE, dyd_engine_outcome(e));
    got = run_any(e);
    assert_int_equal(stages + 1, engine_counters(e).stages);
    assert_as_fresh(e);
  }
  assert_int_equal(want, got);
  assert_same_pairs(dyd_engine_delaunay(all), dyd_engine_delaunay(e));
  dyd_engine_free(e);
  dyd_engine_free(all);
}

static void test_fixed_points(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  for (size_t round = 0; round < test_cases(60); round++)
    for (int kind = 0; kind < 5; kind++) {
      cloud c;
      cloud_random(&c, &r, kind);
      check_cloud(&c, (size_t)test_between(&r, 0, (int64_t)c.n), 1);
      check_cloud(&c, 0, c.n);
      check_cloud(&c, (size_t)test_between(&r, 0, (int64_t)c.n), (size_t)test_between(&r, 1, 7));
    }
}

/* Computable points: narrowed points stay narrow, and are not requested again. */
static void test_computable_points(void **state) {
  const dyd_engine_options by_rectangles = {DYD_SIZED(dyd_engine_options), .no_ties = true};
  dyd_outcome outcome;
  (void)state;
  test_random r = test_random_start(__func__);
  for (size_t round = 0; round < test_cases(10); round++) {
    dyd_engine *e = engine_new();
    engine_add_roots(e, &r, 6);
    engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    for (int more = 0; more < 4; more++) {
      uint64_t calls = engine_counters(e).calls;
      int64_t before[40], n = (int64_t)dyd_engine_count(e);
      dyd_rect rect;
      dyd_rect_init(&rect);
      for (int64_t i = 0; i < n; i++) {
        assert_int_equal(DYD_OK, dyd_sites_get(&rect, dyd_engine_sites(e), (size_t)i));
        before[i] = dyd_rect_bits(&rect);
      }
      dyd_stream *s = NULL, *a = NULL, *b = NULL;
      assert_int_equal(DYD_OK, dyd_engine_stream(&a, e, (uint32_t)test_below(&r, 3)));
      assert_int_equal(DYD_OK, dyd_engine_stream(&b, e, 3 + (uint32_t)test_below(&r, 3)));
      assert_int_equal(DYD_OK, test_midpoint(&s, a, b));
      assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
      assert_int_equal(DYD_OK, dyd_engine_add_text(e, "sqrt(3)+1 [2,2.25]", 18, NULL, NULL));
      assert_false(dyd_engine_knows(e, (uint32_t)n));
      assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &by_rectangles, NULL));
      assert_true(engine_counters(e).calls > calls);
      for (int64_t i = 0; i < n; i++) {
        assert_int_equal(DYD_OK, dyd_sites_get(&rect, dyd_engine_sites(e), (size_t)i));
        assert_true(dyd_rect_bits(&rect) >= before[i]);
      }
      dyd_rect_clear(&rect);
      assert_as_fresh(e);
    }
    dyd_engine_free(e);
  }
}

/* Ties and aliases that are proved, of points that come one by one: as if they had been there from the start. */
static void test_proved_points(void **state) {
  (void)state;
  static const char *const text[] = {"cos(2*pi/5) sin(2*pi/5)",   "1 0",
                                     "cos(4*pi/5) sin(4*pi/5)",   "sqrt(8) sqrt(2)",
                                     "2*sqrt(2) root(x^2-2,1,2)", "cos(6*pi/5) sin(6*pi/5)",
                                     "sqrt(2) sqrt(2)/2",         "-3 0",
                                     "cos(8*pi/5) sin(8*pi/5)",   "3*sqrt(2) 3/sqrt(2)"};
  enum { N = sizeof text / sizeof *text };
  dyd_error err;
  for (size_t start = 0; start < N; start++) {
    dyd_engine *e = engine_new(), *all = engine_new();
    for (size_t k = 0; k < N; k++) {
      assert_int_equal(DYD_OK, dyd_engine_add_text(all, text[k], strlen(text[k]), NULL, &err));
      if (k < start) assert_int_equal(DYD_OK, dyd_engine_add_text(e, text[k], strlen(text[k]), NULL, &err));
    }
    dyd_outcome want = run_any(all), got = run_any(e);
    assert_int_equal(DYD_OUTCOME_FIXPOINT, want);
    for (size_t k = start; k < N; k++) {
      assert_int_equal(DYD_OK, dyd_engine_add_text(e, text[k], strlen(text[k]), NULL, &err));
      got = run_any(e);
    }
    assert_int_equal(want, got);
    assert_int_equal(3, dyd_delaunay_alias(dyd_engine_delaunay(e), 4));
    assert_same_pairs(dyd_engine_delaunay(all), dyd_engine_delaunay(e));
    dyd_engine_free(e);
    dyd_engine_free(all);
  }
}

static void test_source(void **state) {
  (void)state;
  faulty f = {.kind = FAULT_NONE}, g = {.kind = FAULT_FAIL, .point = 1};
  dyd_source good = faulty_source(&f), bad = faulty_source(&g), none = {DYD_SIZED(dyd_source)};
  dyd_engine *e = engine_new();
  dyd_error err;
  const double far = 1000, low = 3;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &far, &low, NULL));
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 5, &good, &err));
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  assert_as_fresh(e);
  assert_int_equal(DYD_E_ARG, dyd_engine_add_source(e, 5, &none, &err));
  assert_non_null(strstr(err.message, "narrow"));
  /* One that fails: the result does not exist, since it must cover all points; the engine stays usable. */
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 3, &bad, &err));
  engine_run(e, NULL, DYD_OUTCOME_ERROR);
  assert_null(dyd_engine_delaunay(e));
  g.kind = FAULT_NONE; /* its points are those of the other one: never seen to be equal */
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_bits = 200;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_as_fresh(e);
  assert_int_equal(0, f.released + g.released);
  dyd_engine_free(e);
  assert_int_equal(2, f.released + g.released);
}

/* ---- refusals ---- */

static void assert_refused(dyd_status st, const dyd_error *why, size_t point, const char *text) {
  assert_int_equal(DYD_E_ARG, st);
  assert_int_equal(DYD_E_ARG, why->code);
  assert_int_equal(point, why->point);
  if (!strstr(why->message, text)) fail_msg("'%s' lacks '%s'", why->message, text);
}

static void test_refused(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const double x[3] = {0, 1, 2}, bad[3] = {0, NAN, 2}, worse[3] = {0, 1, -INFINITY}, low[3] = {0, 0, 0};
  dyd_error err;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 3, x, low, &err));
  assert_int_equal(DYD_OK, err.code);
  assert_refused(dyd_engine_add_points(e, 3, bad, x, &err), &err, 4, "point 4: x is ");
  assert_non_null(strstr(err.message, "nan"));
  assert_refused(dyd_engine_add_points(e, 3, x, worse, &err), &err, 5, "point 5: y is -inf");
  assert_refused(dyd_engine_add_boxes(e, 3, x, low, low, low, &err), &err, 4,
                 "point 4: the lower end of x, 1, is above the upper");
  assert_refused(dyd_engine_add_boxes(e, 3, x, x, low, worse, &err), &err, 5, "point 5: y is -inf");
  assert_int_equal(3, dyd_engine_count(e));
  run_any(e);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  assert_int_equal(DYD_E_ARG, dyd_engine_add_boxes(e, 3, x, x, bad, x, &err));
  assert_non_null(strstr(err.message, "point 4: y is "));
  assert_int_equal(4, err.point);
  const dyd_column xy[2] = {{x, 8}, {low, 8}}, off[2] = {{x, 8}, {worse, 8}};
  assert_int_equal(DYD_E_ARG, dyd_engine_add_columns(e, 3, off, NULL, &err));
  assert_non_null(strstr(err.message, "point 5: y is -inf"));
  assert_int_equal(DYD_E_ARG, dyd_engine_add_columns(e, 3, xy, off, &err));
  assert_non_null(strstr(err.message, "point 5: the radius in y is -inf"));
  assert_int_equal(5, err.point);
  assert_int_equal(DYD_E_PARSE, dyd_engine_add_text(e, "1 2\n1 x", 7, NULL, &err));
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 0, x, x, &err));
  assert_ptr_equal(pd, dyd_engine_delaunay(e)); /* nothing came: the result stands */
  assert_int_equal(3, dyd_engine_count(e));
  dyd_engine_free(e);
}

static dyd_status append_inside(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  dyd_engine *same = user;
  const double x = 7;
  dyd_rect r;
  (void)wants, (void)e;
  assert_int_equal(DYD_E_ARG, dyd_engine_add_points(same, 1, &x, &x, err));
  assert_non_null(strstr(err->message, "at work"));
  dyd_rect_init(&r);
  assert_int_equal(DYD_E_ARG, dyd_engine_remeasure(same, 0, &r, err));
  assert_non_null(strstr(err->message, "at work"));
  dyd_rect_clear(&r);
  dyd_error_clear(err);
  *answered = true;
  return DYD_OK;
}

static void test_callback(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const double x[2] = {0, 1};
  const dyd_question q = {DYD_SIZED(dyd_question), .ask = append_inside, .user = e};
  dyd_outcome outcome;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x, x, NULL));
  assert_int_equal(DYD_OK, dyd_engine_ask(&outcome, e, &q, NULL, NULL));
  assert_int_equal(2, dyd_engine_count(e));
  dyd_engine_free(e);
}

/* Counters are totals since the engine was made. */
static void test_counters(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  test_random r = test_random_start(__func__);
  cloud c;
  do cloud_random(&c, &r, 3);
  while (c.n < 12);
  cloud_put(e, &c, 0, c.n, false);
  run_any(e);
  dyd_delaunay_counters one = engine_counters(e).delaunay;
  assert_true(one.faces > 0);
  cloud_put(e, &c, 0, 1, true);
  assert_int_equal(one.faces, engine_counters(e).delaunay.faces);
  run_any(e);
  dyd_delaunay_counters two = engine_counters(e).delaunay;
  assert_true(two.faces > one.faces && two.filter >= one.filter && two.witness_guess >= one.witness_guess);
  dyd_engine_free(e);
}

/* ---- measuring again ---- */

static dyd_status remeasure_d(dyd_engine *e, uint32_t i, const double b[4], dyd_error *err) {
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(DYD_OK, dyd_rect_set_d(&r, b[0], b[1], b[2], b[3]));
  dyd_status st = dyd_engine_remeasure(e, i, &r, err);
  dyd_rect_clear(&r);
  return st;
}

/* Boxes that shrink at random, around a hidden choice: no statement is taken back, results are as fresh ones. */
static void test_remeasure_boxes(void **state) {
  (void)state;
  test_random r = test_random_start(__func__);
  for (size_t round = 0; round < test_cases(40); round++) {
    cloud c;
    monotone m;
    cloud_random(&c, &r, round % 2 ? 3 : 4);
    dyd_engine *e = engine_new();
    cloud_put(e, &c, 0, c.n, false);
    run_any(e);
    monotone_init(&m, e);
    monotone_look(&m);
    for (int step = 0; step < 8; step++) {
      for (size_t k = 0; k < 3; k++) {
        uint32_t i = (uint32_t)test_below(&r, c.n);
        double w = (c.x1[i] - c.x0[i]) / (double)test_between(&r, 1, 3), box[4];
        box[0] = c.x0[i] - (double)test_between(&r, 0, 1); /* wider on this side: the narrower old end counts */
        box[1] = fmin(c.x0[i] + w, c.x1[i]);
        box[2] = c.y0[i];
        box[3] = c.y1[i] + 5;
        c.x1[i] = box[1];
        assert_int_equal(DYD_OK, remeasure_d(e, i, box, NULL));
      }
      run_any(e);
      monotone_look(&m);
      assert_as_fresh(e);
      for (size_t i = 0; i < c.n; i++) {
        double d[4];
        dyd_sites_get_d(d, dyd_engine_sites(e), i);
        assert_true(d[0] == c.x0[i] && d[1] == c.x1[i] && d[2] == c.y0[i] && d[3] == c.y1[i]);
      }
    }
    monotone_clear(&m);
    dyd_engine_free(e);
  }
}

static void test_contradiction(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_error err;
  const double x0[3] = {0, 10, 5}, x1[3] = {1, 11, 5}, y0[3] = {0, 0, 8}, y1[3] = {1, 1, 8};
  const double off[4] = {2, 3, 0, 1}, touch[4] = {1, 3, 1, 2}, all[4] = {-9, 99, -9, 99}, hit[4] = {5, 6, 7, 8};
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 3, x0, x1, y0, y1, NULL));
  run_any(e);
  assert_int_equal(DYD_E_CONTRADICTION, remeasure_d(e, 0, off, &err));
  assert_int_equal(DYD_E_CONTRADICTION, err.code);
  assert_int_equal(0, err.point);
  assert_non_null(strstr(err.message, "[2, 3] x [0, 1]"));
  assert_non_null(strstr(err.message, "point 0"));
  assert_non_null(strstr(err.message, "[0, 1] x [0, 1]"));
  assert_int_equal(DYD_E_CONTRADICTION, remeasure_d(e, 2, off, &err));
  assert_int_equal(DYD_E_ARG, remeasure_d(e, 3, off, &err));
  assert_int_equal(DYD_OK, remeasure_d(e, 2, all, &err));
  assert_int_equal(DYD_OK, remeasure_d(e, 2, hit, &err));
  assert_int_equal(DYD_OK, remeasure_d(e, 0, touch, &err)); /* a corner is left */
  assert_true(dyd_sites_is_point(dyd_engine_sites(e), 0));
  run_any(e);
  assert_as_fresh(e);
  dyd_engine_free(e);
}

/* A stream and a source stay within the measured rectangle; measured before the first run, too. */
static void test_remeasure_computable(void **state) {
  (void)state;
  for (int early = 0; early < 2; early++) {
    faulty f = {.kind = FAULT_NONE};
    dyd_source source = faulty_source(&f);
    dyd_engine *e = engine_new();
    dyd_error err;
    dyd_stream *s = NULL;
    double d[4];
    engine_add_text(e, "sqrt(2)", "sqrt(3)");
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 3, &source, NULL)); /* (k^2, k^3) / 7 */
    if (!early) engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    /* These cut close to the points: the truth is inside, most of what streams give is not. */
    const double root[4] = {1, 0x1.6a09e667f3bcdp0, 1, 0x1.bb67ae8584cabp0}, third[4] = {4. / 7, 1, 1, 2};
    assert_int_equal(DYD_OK, remeasure_d(e, 0, root, &err));
    assert_int_equal(DYD_OK, remeasure_d(e, 3, third, &err));
    assert_true(dyd_engine_knows(e, 3));
    for (uint32_t i = 0; i < 4; i += 3) {
      assert_int_equal(DYD_OK, dyd_engine_stream(&s, e, i));
      assert_int_equal(DYD_OK, dyd_stream_narrow(s, 200, 4096, &err));
      dyd_rect now;
      dyd_rect_init(&now);
      assert_int_equal(DYD_OK, dyd_sites_get(&now, dyd_engine_sites(e), i));
      assert_true(dyd_rect_contains(&now, dyd_stream_rect(s)));
      assert_true(dyd_rect_bits(dyd_stream_rect(s)) >= 199);
      dyd_rect_clear(&now);
      dyd_stream_free(s);
    }
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.goal = DYD_GOAL_HAUSDORFF;
    o.goal_bits = 30;
    engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
    dyd_sites_get_d(d, dyd_engine_sites(e), 0);
    assert_true(d[1] <= root[1] && d[3] <= root[3] && d[1] - d[0] < 1e-9);
    dyd_sites_get_d(d, dyd_engine_sites(e), 3);
    assert_true(d[0] >= third[0] && d[1] - d[0] < 1e-9);
    assert_as_fresh(e);
    dyd_engine_free(e);
  }
}

/* A measurement that the stream shows to be wrong ends the run, and names both. */
static void test_wrong_measurement(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_outcome outcome;
  dyd_error err;
  const double wrong[4] = {1.5, 2, 1, 2};
  engine_add_text(e, "sqrt(2)", "sqrt(3)");
  engine_add_text(e, "sqrt(5)", "sqrt(7)");
  assert_int_equal(DYD_OK, remeasure_d(e, 0, wrong, &err));
  assert_int_equal(DYD_E_CONTRADICTION, dyd_engine_run(&outcome, e, NULL, &err));
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  assert_int_equal(0, err.point);
  assert_non_null(strstr(err.message, "[1.5, 2] x [1, 2]"));
  assert_non_null(strstr(err.message, "1.414213"));
  dyd_engine_free(e);
}

/* What README shows. */
static void test_readme(void **state) {
  (void)state;
  dyd_engine *engine = engine_new();
  dyd_outcome outcome;
  dyd_error err;
  dyd_rect r;
  const double x[4] = {0, 3, 3, 0}, y[4] = {0, 0, 2.75, 2.7};
  assert_int_equal(DYD_OK, dyd_engine_add_points(engine, 4, x, y, NULL));
  engine_run(engine, NULL, DYD_OUTCOME_DECIDED);
  dyd_rect_init(&r);
  assert_int_equal(DYD_OK, dyd_engine_add_text(engine, "1 [2.6,2.8]", 11, NULL, &err));
  engine_run(engine, NULL, DYD_OUTCOME_FIXPOINT);
  assert_int_equal(DYD_OK, dyd_rect_set_text(&r, "1 2.71+-0.001", 13, &err));
  assert_int_equal(DYD_OK, dyd_engine_remeasure(engine, 4, &r, &err));
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, engine, NULL, &err));
  assert_int_equal(DYD_OUTCOME_DECIDED, outcome);
  assert_int_equal(3, engine_counters(engine).stages);
  dyd_rect_clear(&r);
  dyd_engine_free(engine);
}

/* dyd_delaunay_of gives what an engine with the same points gives, and leaves its output on failure. */
static void test_one_call(void **state) {
  (void)state;
  const double xy[] = {0, 0, 3, 0, 3, 2.75, 0, 2.5, 1, 1}, wrong[] = {0, NAN};
  dyd_pair_list list = {0}, same = {0};
  dyd_error err;
  for (int n = 0; n <= 5; n++)
    for (double radius = 0; radius < 1; radius += 0.25) {
      dyd_engine *e = NULL;
      dyd_outcome outcome;
      assert_int_equal(DYD_OK, dyd_delaunay_of(&list, (size_t)n, xy, radius, NULL, &err));
      assert_int_equal(DYD_OK, dyd_engine_new(&e));
      for (int k = 0; k < n; k++) {
        double x0 = xy[2 * k] - radius, x1 = xy[2 * k] + radius, y0 = xy[2 * k + 1] - radius,
               y1 = xy[2 * k + 1] + radius;
        assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &x0, &x1, &y0, &y1, NULL));
      }
      assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, NULL, &err));
      assert_int_equal(DYD_OK, dyd_delaunay_pairs(&same, dyd_engine_delaunay(e)));
      assert_int_equal(list.count, same.count);
      for (size_t k = 0; k < same.count; k++) {
        assert_int_equal(list.item[k].i, same.item[k].i);
        assert_int_equal(list.item[k].j, same.item[k].j);
        assert_int_equal(list.item[k].status, same.item[k].status);
      }
      dyd_engine_free(e);
      dyd_pair_list_clear(&same);
      if (n < 5 || radius < 0.75) dyd_pair_list_clear(&list);
    }
  size_t before = list.count;
  assert_int_equal(DYD_E_ARG, dyd_delaunay_of(&list, 1, wrong, 0, NULL, &err));
  assert_int_equal(DYD_E_ARG, dyd_delaunay_of(&list, 5, xy, -1, NULL, &err));
  assert_int_equal(DYD_E_ARG, dyd_delaunay_of(&list, 5, NULL, 0, NULL, &err));
  assert_int_equal(DYD_E_ARG, dyd_delaunay_of(NULL, 5, xy, 0, NULL, NULL));
  dyd_engine_options late = {DYD_SIZED(dyd_engine_options)};
  dyd_engine_options_init(&late);
  late.seconds = 1e-9;
  assert_true(dyd_delaunay_of(&list, 5, xy, 0.5, &late, &err) < 0);
  assert_int_equal(before, list.count);
  dyd_pair_list_clear(&list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_one_call),
      cmocka_unit_test(test_fixed_points),
      cmocka_unit_test(test_computable_points),
      cmocka_unit_test(test_proved_points),
      cmocka_unit_test(test_source),
      cmocka_unit_test(test_refused),
      cmocka_unit_test(test_callback),
      cmocka_unit_test(test_counters),
      cmocka_unit_test(test_remeasure_boxes),
      cmocka_unit_test(test_contradiction),
      cmocka_unit_test(test_remeasure_computable),
      cmocka_unit_test(test_wrong_measurement),
      cmocka_unit_test(test_readme),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
