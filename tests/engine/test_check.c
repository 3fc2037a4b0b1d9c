/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The harness of monotone refinement: quiet on good points, and finds every planted fault within 100 schedules, with a
 * schedule that shows it again. The faults of the engine are put in at link time: one comparison answers the opposite.
 */
#include "help.h"

#include "possible/patches_filter.h"
#include "predicate/circle.h"
#include <string.h>

/* ---- planted faults of the engine ---- */

static bool flip_side, flip_displaced;

int __real_dyd_icircle_side(const dyd_icircle *k, const dyd_irect *r, dyd_touch touch);
int __wrap_dyd_icircle_side(const dyd_icircle *k, const dyd_irect *r, dyd_touch touch);
int __wrap_dyd_icircle_side(const dyd_icircle *k, const dyd_irect *r, dyd_touch touch) {
  int side = __real_dyd_icircle_side(k, r, touch);
  return flip_side ? -side : side;
}

bool __real_dyd_surely_not_displaced(const dyd_delaunay *pd, uint32_t i, uint32_t j, uint32_t k, uint32_t l);
bool __wrap_dyd_surely_not_displaced(const dyd_delaunay *pd, uint32_t i, uint32_t j, uint32_t k, uint32_t l);
bool __wrap_dyd_surely_not_displaced(const dyd_delaunay *pd, uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
  return __real_dyd_surely_not_displaced(pd, i, j, k, l) != flip_displaced;
}

/* ---- points ---- */

typedef struct points {
  uint64_t seed;
  int corners;  /* of a regular polygon; 0: none */
  size_t roots; /* random ones */
  fault kind;   /* of a source of eight points more */
  uint64_t stage;
  faulty *made; /* the sources, one for each engine; released at the end of the test */
  size_t count;
} points;

static dyd_status open_points(dyd_engine **out, void *user, dyd_error *err) {
  points *p = user;
  test_random r = {p->seed};
  (void)err;
  *out = engine_new();
  if (p->corners) engine_add_polygon(*out, p->corners, NULL, 0);
  engine_add_roots(*out, &r, p->roots);
  if (p->kind != FAULT_NONE) {
    assert_true(p->count < 4096);
    faulty *f = &p->made[p->count++];
    *f = (faulty){.kind = p->kind, .point = 5, .stage = p->stage};
    dyd_source source = faulty_source(f);
    assert_int_equal(dyd_engine_add_source(*out, 8, &source, NULL), DYD_OK);
  }
  return DYD_OK;
}

/* Runs; a fault has to be of the kind `want`, and to show again from its moves, each of which is needed. */
static void run(points *p, const dyd_check_options *o, dyd_check_fault want) {
  dyd_check_report report = {DYD_SIZED(dyd_check_report)}, again = {DYD_SIZED(dyd_check_report)};
  dyd_error err;
  p->made = calloc(4096, sizeof *p->made);
  p->count = 0;
  assert_int_equal(dyd_check_run(&report, open_points, p, o, &err), DYD_OK);
  if (report.fault != want) fprintf(stderr, "# fault %s: %s\n", dyd_check_fault_text(report.fault), report.message);
  assert_int_equal(report.fault, want);
  assert_true(report.stages > 0 || want == DYD_CHECK_STREAM || want == DYD_CHECK_RATE);
  if (want != DYD_CHECK_FINE) {
    dyd_check_options same = o ? *o : (dyd_check_options){DYD_SIZED(dyd_check_options)};
    same.seed = report.seed;
    same.base_bits = report.base_bits;
    fprintf(stderr, "# %s after %u schedules, %zu moves: %s\n", dyd_check_fault_text(want), (unsigned)report.schedules,
            report.moves, report.message);
    same.move = report.move, same.moves = report.moves;
    assert_int_equal(dyd_check_run(&again, open_points, p, &same, &err), DYD_OK);
    assert_int_equal(again.fault, want);
    assert_string_equal(again.message, report.message);
    dyd_check_report_clear(&again);
    for (size_t k = 0; k < report.moves && report.moves > 1; k++) {
      dyd_check_move *less = calloc(report.moves, sizeof *less);
      memcpy(less, report.move, k * sizeof *less);
      memcpy(less + k, report.move + k + 1, (report.moves - k - 1) * sizeof *less);
      same.move = less, same.moves = report.moves - 1;
      assert_int_equal(dyd_check_run(&again, open_points, p, &same, &err), DYD_OK);
      assert_int_not_equal(again.fault, want);
      dyd_check_report_clear(&again);
      free(less);
    }
  } else {
    assert_int_equal(report.moves, 0);
  }
  dyd_check_report_clear(&report);
  free(p->made);
}

/* ---- tests ---- */

static void good_points(void **state) {
  (void)state;
  test_random r = test_random_start("check good");
  dyd_check_options o = {DYD_SIZED(dyd_check_options), .seed = test_u64(&r) >> 2, .schedules = (unsigned)test_cases(8),
                         .max_bits = 80};
  points mixed = {.seed = 7, .roots = 9, .kind = FAULT_NONE}, tied = {.seed = 8, .corners = 4, .roots = 2};
  run(&mixed, &o, DYD_CHECK_FINE);
  run(&tied, &o, DYD_CHECK_FINE);
  points none = {.seed = 1}, one = {.seed = 1, .roots = 1};
  run(&none, &o, DYD_CHECK_FINE);
  run(&one, &o, DYD_CHECK_FINE);
}

static void bad_streams(void **state) {
  (void)state;
  dyd_check_options o = {DYD_SIZED(dyd_check_options), .seed = 3, .max_bits = 120};
  points widens = {.seed = 5, .roots = 3, .kind = FAULT_WIDEN, .stage = 2};
  points drifts = {.seed = 5, .roots = 3, .kind = FAULT_DRIFT, .stage = 3};
  points stalls = {.seed = 5, .roots = 3, .kind = FAULT_STALL, .stage = 1};
  points fails = {.seed = 5, .roots = 3, .kind = FAULT_FAIL, .stage = 2};
  run(&widens, &o, DYD_CHECK_STREAM);
  run(&drifts, &o, DYD_CHECK_STREAM);
  run(&stalls, &o, DYD_CHECK_RATE);
  run(&fails, &o, DYD_CHECK_STREAM);
  points sways = {.seed = 5, .roots = 3, .kind = FAULT_SWAY};
  run(&sways, NULL, DYD_CHECK_STREAM); /* at the default precision: steps are small now and then */
}

/* Points with a side that is fixed, or as wide as a radius makes it, narrow as they should. */
static dyd_status open_half_fixed(dyd_engine **out, void *user, dyd_error *err) {
  static const char text[] = "sqrt(2) [0,1]\n[0,1] sqrt(3)\n-1 pi\n1/3 -1\nsqrt(5)+-0.25 e\n";
  dyd_read_options options = {DYD_SIZED(dyd_read_options), .radius = user};
  *out = engine_new();
  return dyd_engine_add_text(*out, text, sizeof text - 1, &options, err);
}

static void half_fixed(void **state) {
  (void)state;
  static char radius[] = "0.1";
  dyd_check_options o = {DYD_SIZED(dyd_check_options), .seed = 4, .schedules = 12};
  for (int wide = 0; wide < 2; wide++) {
    dyd_check_report report = {DYD_SIZED(dyd_check_report)};
    dyd_error err;
    assert_int_equal(dyd_check_run(&report, open_half_fixed, wide ? radius : NULL, &o, &err), DYD_OK);
    if (report.fault != DYD_CHECK_FINE) fail_msg("%s", report.message);
    dyd_check_report_clear(&report);
  }
}

/* At the time limit it reports the work done. */
static void out_of_time(void **state) {
  (void)state;
  dyd_check_options o = {DYD_SIZED(dyd_check_options), .seed = 4, .schedules = 1000000, .seconds = 0.25};
  dyd_check_report report = {DYD_SIZED(dyd_check_report)};
  dyd_error err;
  points p = {.seed = 7, .roots = 9};
  assert_int_equal(dyd_check_run(&report, open_points, &p, &o, &err), DYD_CANCELLED);
  assert_int_equal(report.fault, DYD_CHECK_FINE);
  assert_true(report.schedules < 1000000);
  dyd_check_report_clear(&report);
}

/* Which check tells depends on where the fault strikes: any but those of streams. */
static void must_tell(points *p, const dyd_check_options *o) {
  dyd_check_report report = {DYD_SIZED(dyd_check_report)};
  dyd_error err;
  assert_int_equal(dyd_check_run(&report, open_points, p, o, &err), DYD_OK);
  fprintf(stderr, "# %s after %u schedules, %zu moves: %s\n", dyd_check_fault_text(report.fault),
          (unsigned)report.schedules, report.moves, report.message);
  assert_true(report.fault >= DYD_CHECK_RETRACT);
  dyd_check_report_clear(&report);
}

/* Cells are not watched: they would be built on an invalid triangulation, which the armed build rejects. */
static void bad_engine(void **state) {
  (void)state;
  dyd_check_options o = {
      DYD_SIZED(dyd_check_options), .seed = 3, .max_bits = 60, .base_bits = 2, .schedules = 100, .no_cells = true};
  points p = {.seed = 11, .corners = 5, .roots = 4};
  flip_side = true;
  must_tell(&p, &o);
  flip_side = false;
  flip_displaced = true;
  must_tell(&p, &o);
  flip_displaced = false;
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(good_points), cmocka_unit_test(bad_streams),
                                     cmocka_unit_test(half_fixed), cmocka_unit_test(out_of_time),
                                     cmocka_unit_test(bad_engine)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
