/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The trace of narrowings and its reasons, tables of convergence, traces as text, and points that are coarse for their
 * surroundings. */
#include "engine/help.h"

#include "delaunay/state.h"
#include "engine/wants.h"
#include "rect/rect.h"
#include <math.h>
#include <string.h>

/* Notes and checks all steps of a run. */
typedef struct notes {
  dyd_engine *e;
  uint64_t stages, steps, calls, of[5];
  int64_t bits[32];
  dyd_rect rect[32];
  uint64_t cancel_at; /* step */
  uint64_t ends;      /* bit i: point i was narrowed as an end */
} notes;

static void notes_init(notes *n, dyd_engine *e) {
  *n = (notes){.e = e};
  for (int k = 0; k < 32; k++) dyd_rect_init(&n->rect[k]);
}

static void notes_clear(notes *n) {
  for (int k = 0; k < 32; k++) dyd_rect_clear(&n->rect[k]);
}

static void note_step(void *user, const dyd_step *s) {
  notes *n = user;
  assert_int_equal(n->stages + 1, s->stage);
  assert_true(s->site < 32);
  n->of[s->reason]++;
  n->calls += s->called;
  assert_true((s->reason == DYD_REASON_FIRST) == (s->stage == 1));
  if (s->stage > 1) {
    assert_true(s->bits > n->bits[s->site]);
    assert_true(dyd_rect_contains(&n->rect[s->site], s->rect));
    assert_true(s->called || dyd_rect_equal(&n->rect[s->site], s->rect));
  }
  if (s->reason == DYD_REASON_END) {
    assert_true(s->i < s->j && (s->site == s->i || s->site == s->j));
    assert_int_equal(DYD_INDETERMINATE, dyd_delaunay_status(dyd_engine_delaunay(n->e), s->i, s->j));
    n->ends |= (uint64_t)1 << s->site;
  } else if (s->reason != DYD_REASON_BOUND) {
    assert_true(s->i == s->site && s->j == s->site);
  }
  n->bits[s->site] = s->bits;
  dyd_rect_set(&n->rect[s->site], s->rect);
  if (++n->steps == n->cancel_at) dyd_engine_cancel(n->e);
}

static void note_stage(void *user, const dyd_progress *p) {
  notes *n = user;
  assert_int_equal(++n->stages, p->stage);
}

static dyd_engine_options options(notes *n) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.trace = note_step;
  o.progress = note_stage;
  o.trace_user = o.progress_user = n;
  return o;
}

/* The last rectangle told is the one that the engine has. */
static void check_last(const notes *n, const dyd_engine *e) {
  dyd_rect r;
  dyd_rect_init(&r);
  const dyd_sites *sites = dyd_delaunay_sites(dyd_engine_delaunay(e));
  for (size_t i = 0; i < dyd_engine_count(e); i++) {
    assert_int_equal(DYD_OK, dyd_sites_get(&r, sites, i));
    assert_true(dyd_rect_equal(&r, &n->rect[i]));
  }
  dyd_rect_clear(&r);
  assert_int_equal(n->calls, engine_counters(e).calls);
}

static void test_ends(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  notes n;
  const int weight[6] = {3, 17, 5, 40, 1, 22};
  engine_add_polygon(e, 6, weight, 300);
  notes_init(&n, e);
  dyd_engine_options o = options(&n);
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  check_last(&n, e);
  assert_int_equal(6, n.of[DYD_REASON_FIRST]);
  assert_true(n.of[DYD_REASON_END] >= 6);
  assert_int_equal(n.steps, n.of[DYD_REASON_FIRST] + n.of[DYD_REASON_END] + n.of[DYD_REASON_BLOCKER]);
  notes_clear(&n);
  dyd_engine_free(e);
}

/* Of points 2^-300 apart among others only these two are refined. */
static void test_only_the_close_ones(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  notes n;
  const int place[8][2] = {{0, 0}, {40, 3}, {41, 44}, {-2, 39}, {20, 61}, {-31, 17}, {63, 22}, {19, -25}};
  for (int k = 0; k < 8; k++) {
    char x[60], y[60];
    snprintf(x, sizeof x, "%d+sqrt(%d)/9", place[k][0], k + 2);
    snprintf(y, sizeof y, "%d+exp(-%d)/9", place[k][1], k + 2);
    engine_add_text(e, x, y);
  }
  engine_add_text(e, "20+sqrt(2)", "20+sqrt(3)");
  engine_add_text(e, "20+sqrt(2)+7*2^-303", "20+sqrt(3)+4*2^-303");
  notes_init(&n, e);
  dyd_engine_options o = options(&n);
  o.start_bits = 4;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  check_last(&n, e);
  assert_int_equal(0x300, n.ends);
  assert_int_equal(0, n.of[DYD_REASON_BLOCKER]);
  assert_int_equal(4, engine_counters(e).bits_least);
  notes_clear(&n);
  dyd_engine_free(e);
}

/* (0,0), (10,0), a blocker near (5,0), (5,20), (5,-2^220) (as in mathematics: section 10, case 3): whatever pair is
 * open, the blocker has to be refined, be it an end or not. */
static void test_blockers(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  notes n;
  const double x[4] = {0, 10, 5, 5}, y[4] = {0, 0, 20, -0x1p220};
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x, y, NULL));
  engine_add_hidden(e, "5", "exp(log(6)/2)-sqrt(6)+2^-200");
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x + 2, y + 2, NULL));
  notes_init(&n, e);
  dyd_engine_options o = options(&n);
  o.no_ties = true; /* a candidate for a tie would be refined at once to the bits that show it */
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  printf("# blocker: %d steps, %d as end, %d as blocker\n", (int)n.steps, (int)n.of[DYD_REASON_END],
         (int)n.of[DYD_REASON_BLOCKER]);
  assert_true(n.of[DYD_REASON_BLOCKER] + n.of[DYD_REASON_END] >= 2);
  assert_int_equal(1, n.of[DYD_REASON_FIRST]);
  notes_clear(&n);
  dyd_engine_free(e);
}

static void test_bounds_and_uniform(void **state) {
  (void)state;
  for (int k = 0; k < 3; k++) {
    dyd_engine *e = engine_new();
    notes n;
    engine_add_text(e, "sqrt(2)", "sqrt(3)");
    engine_add_text(e, "-sqrt(2)", "exp(-2)");
    engine_add_text(e, "pi", "-sqrt(7)");
    notes_init(&n, e);
    dyd_engine_options o = options(&n);
    o.goal = k == 0 ? DYD_GOAL_AREA : DYD_GOAL_HAUSDORFF;
    o.goal_bits = 500;
    o.schedule = k == 2 ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
    engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
    check_last(&n, e);
    assert_true(n.of[k == 2 ? DYD_REASON_UNIFORM : DYD_REASON_BOUND] >= 3);
    assert_int_equal(n.steps, 3 + n.of[k == 2 ? DYD_REASON_UNIFORM : DYD_REASON_BOUND]);
    notes_clear(&n);
    dyd_engine_free(e);
  }
}

/* Steps of 7 bits, and no more than that. */
static void test_step_bits(void **state) {
  (void)state;
  for (int k = 0; k < 2; k++) {
    dyd_engine *e = engine_new();
    notes n;
    engine_add_polygon(e, 6, NULL, 0);
    notes_init(&n, e);
    dyd_engine_options o = options(&n);
    o.start_bits = 10;
    o.step_bits = 7;
    o.max_bits = 50;
    o.schedule = k ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
    engine_run(e, &o, DYD_OUTCOME_BUDGET);
    assert_int_equal(7, n.stages); /* 10, 17, 24, 31, 38, 45, 50 */
    assert_int_equal(50, engine_counters(e).bits_most);
    notes_clear(&n);
    dyd_outcome outcome;
    o.step_bits = -1;
    assert_int_equal(DYD_E_ARG, dyd_engine_run(&outcome, e, &o, NULL));
    dyd_engine_free(e);
  }
}

static void test_cancel_from_the_trace(void **state) {
  (void)state;
  for (uint64_t at = 1; at < 14; at += 3) {
    dyd_engine *e = engine_new();
    notes n;
    engine_add_polygon(e, 6, NULL, 0);
    notes_init(&n, e);
    n.cancel_at = at;
    dyd_engine_options o = options(&n);
    engine_run(e, &o, DYD_OUTCOME_CANCELLED);
    assert_true(n.steps == at);
    notes_clear(&n);
    dyd_engine_free(e);
  }
}

static void test_reason_texts(void **state) {
  (void)state;
  for (int k = DYD_REASON_FIRST; k <= DYD_REASON_UNIFORM; k++)
    for (int l = DYD_REASON_FIRST; l < k; l++)
      assert_string_not_equal(dyd_reason_text((dyd_reason)k), dyd_reason_text((dyd_reason)l));
}

/* ---- tables ---- */

typedef struct seen {
  const dyd_engine *e;
  size_t rows, reports;
} seen;

static void see_report(void *user, const dyd_progress *p) {
  (void)p;
  ((seen *)user)->reports++;
}

static void see_row(void *user, const dyd_stage_row *row, const dyd_delaunay *pd) {
  seen *s = user;
  dyd_engine_counters c = engine_counters(s->e);
  assert_int_equal(++s->rows, s->reports); /* the caller's progress comes first */
  assert_ptr_equal(pd, dyd_engine_delaunay(s->e));
  assert_int_equal(c.stages, row->stage);
  assert_int_equal(c.calls, row->calls);
  assert_true(c.bits_least == row->bits_least && c.bits_most == row->bits_most && c.bits_total == row->bits_total);
  assert_int_equal(c.undecided_faces, row->undecided_faces);
  assert_memory_equal(&c.delaunay, &row->rungs, sizeof row->rungs);
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  assert_true(row->bounded);
  assert_int_equal(DYD_OK, dyd_engine_bounds(&area, &hausdorff, s->e));
  assert_int_equal(0, dyd_dyadic_cmp(&area, &row->area));
  assert_int_equal(0, dyd_dyadic_cmp(&hausdorff, &row->hausdorff));
  dyd_dyadic_clear(&hausdorff);
  dyd_dyadic_clear(&area);
}

static void test_table(void **state) {
  (void)state;
  test_random r = test_random_start("table");
  for (size_t k = 0; k < test_cases(5); k++) {
    dyd_engine *e = engine_new();
    engine_add_roots(e, &r, 3 + k % 7);
    engine_add_polygon(e, 5, NULL, 0);
    seen s = {.e = e};
    dyd_convergence table = {DYD_SIZED(dyd_convergence)};
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.start_bits = 3;
    o.max_bits = 200;
    o.progress = see_report;
    o.progress_user = &s;
    dyd_converge_options c = {DYD_SIZED(dyd_converge_options), .of = DYD_CONVERGE_VORONOI, .stage = see_row,
                              .stage_user = &s};
    dyd_error err;
    assert_int_equal(DYD_OK, dyd_converge_run(&table, e, &o, &c, &err));
    assert_int_equal(s.rows, table.count);
    assert_int_equal(table.outcome, dyd_engine_outcome(e));
    assert_null(table.options->progress);
    assert_int_equal(200, table.options->max_bits);
    for (size_t i = 0; i < table.count; i++) {
      assert_true(table.row[i]->voronoi && table.row[i]->seconds >= 0);
      assert_true(dyd_dyadic_cmp(&table.row[i]->width_median, &table.row[i]->width_largest) <= 0);
      if (i == 0) continue;
      assert_true(dyd_dyadic_cmp(&table.row[i]->width_largest, &table.row[i - 1]->width_largest) <= 0);
      assert_true(table.row[i]->seconds >= table.row[i - 1]->seconds);
      assert_true(table.row[i]->count[DYD_LEGAL] >= table.row[i - 1]->count[DYD_LEGAL]);
    }
    dyd_convergence_clear(&table);
    dyd_convergence_clear(&table);
    dyd_engine_free(e);
  }
}

/* ---- traces as text ---- */

static void assert_same_rows(const dyd_convergence *a, const dyd_convergence *b) {
  assert_int_equal(a->count, b->count);
  assert_int_equal(a->outcome, b->outcome);
  for (size_t k = 0; k < a->count; k++) {
    const dyd_stage_row *r = a->row[k], *s = b->row[k];
    assert_true(r->digest == s->digest && r->stage == s->stage && r->calls == s->calls);
    assert_true(r->bits_least == s->bits_least && r->bits_most == s->bits_most && r->bits_total == s->bits_total);
    assert_memory_equal(r->count, s->count, sizeof r->count);
    assert_int_equal(0, dyd_dyadic_cmp(&r->area, &s->area));
    assert_int_equal(0, dyd_dyadic_cmp(&r->width_median, &s->width_median));
  }
}

/* A run that is cut short anywhere leaves a trace that can be replayed. */
static void test_replay_of_cut_runs(void **state) {
  (void)state;
  for (uint64_t calls = 1; calls < 40; calls += 1 + calls / 4) {
    dyd_engine *e = engine_new();
    dyd_convergence table = {DYD_SIZED(dyd_convergence)}, again = {DYD_SIZED(dyd_convergence)};
    dyd_engine_options o;
    dyd_trace *trace;
    dyd_error err;
    FILE *f = tmpfile();
    assert_non_null(f);
    engine_add_polygon(e, 7, NULL, 0);
    engine_add_text(e, "10/3", "2^-300");
    dyd_engine_options_init(&o);
    o.max_calls = calls;
    assert_int_equal(DYD_OK, dyd_trace_new(&trace, f, e, NULL, &o, NULL, NULL));
    o.trace = dyd_trace_step;
    o.progress = dyd_trace_stage;
    o.trace_user = o.progress_user = trace;
    dyd_converge_options c = {DYD_SIZED(dyd_converge_options)};
    assert_int_equal(DYD_OK, dyd_converge_run(&table, e, &o, &c, &err));
    assert_int_equal(DYD_OUTCOME_BUDGET, table.outcome);
    assert_int_equal(DYD_OK, dyd_trace_end(trace, table.outcome, &err));
    rewind(f);
    assert_int_equal(DYD_OK, dyd_trace_replay(&again, f, NULL, &err));
    assert_same_rows(&table, &again);
    fclose(f);
    dyd_convergence_clear(&again);
    dyd_convergence_clear(&table);
    dyd_engine_free(e);
  }
}

/* ---- coarse.c ---- */

/* floor(log2 |x|) + 1. */
static int64_t size_of(double x) {
  int e;
  assert_true(x > 0);
  frexp(x, &e);
  return e;
}

/* Every pair of sites taken as neighbours, in doubles that hold these numbers exactly. */
static int64_t literal_bits(double (*box)[4], size_t n, size_t i) {
  double scale = INFINITY, width = fmax(box[i][1] - box[i][0], box[i][3] - box[i][2]);
  if (width == 0) return INT64_MAX;
  for (size_t j = 0; j < n; j++) {
    if (j == i) continue;
    double s = fmax(width, fmax(box[j][1] - box[j][0], box[j][3] - box[j][2]));
    for (int a = 0; a < 4; a += 2) s = fmax(s, fmax(box[j][a] - box[i][a + 1], box[i][a] - box[j][a + 1]));
    scale = fmin(scale, s);
  }
  return size_of(scale) - size_of(width);
}

/* At most five sites: then all of a face are next to one another in x. */
static void test_coarse(void **state) {
  (void)state;
  test_random r = test_random_start("coarse");
  size_t faces = 0;
  for (size_t k = 0; k < test_cases(300); k++) {
    double box[5][4], x0[5], x1[5], y0[5], y1[5];
    size_t n = 2 + test_below(&r, 4);
    for (size_t i = 0; i < n; i++) {
      for (int a = 0; a < 4; a += 2) {
        box[i][a] = (double)test_below(&r, 40) / 4;
        box[i][a + 1] = box[i][a] + (test_chance(&r, 3) ? 0 : ldexp(1, (int)test_below(&r, 8) - 5));
      }
      x0[i] = box[i][0], x1[i] = box[i][1], y0[i] = box[i][2], y1[i] = box[i][3];
    }
    dyd_sites *sites;
    dyd_delaunay *pd;
    assert_int_equal(DYD_OK, dyd_sites_new(&sites));
    assert_int_equal(DYD_OK, dyd_sites_add_boxes(sites, n, x0, x1, y0, y1));
    assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, sites, NULL, NULL));
    for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd); f++) {
      dyd_face_precision c = {0};
      dyd_pair_list pairs = {0};
      double of_face[5][4];
      assert_int_equal(DYD_OK, dyd_delaunay_face_pairs(&pairs, pd, f));
      assert_int_equal(DYD_OK, dyd_face_precision_set(&c, pd, f, &pairs));
      for (size_t i = 0; i < c.sites.count; i++) memcpy(of_face[i], box[c.sites.item[i]], sizeof of_face[i]);
      for (size_t i = 0; i < c.sites.count; i++)
        assert_true(dyd_face_precision_bits(&c, c.sites.item[i]) == literal_bits(of_face, c.sites.count, i));
      assert_true(dyd_face_precision_bits(&c, 99) == INT64_MAX);
      dyd_face_precision_clear(&c);
      dyd_pair_list_clear(&pairs);
      faces++;
    }
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  assert_true(faces > test_least(50));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_ends),
      cmocka_unit_test(test_only_the_close_ones),
      cmocka_unit_test(test_blockers),
      cmocka_unit_test(test_bounds_and_uniform),
      cmocka_unit_test(test_step_bits),
      cmocka_unit_test(test_cancel_from_the_trace),
      cmocka_unit_test(test_reason_texts),
      cmocka_unit_test(test_table),
      cmocka_unit_test(test_replay_of_cut_runs),
      cmocka_unit_test(test_coarse),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
