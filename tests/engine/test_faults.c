/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [NEST-1] Streams and sources that widen, drift, fail, stall or answer nonsense: the right error, nothing lost,
 * everything released once. */
#include "engine/help.h"
#include "rect/rect.h"

#include <string.h>

/* The faulty points 0..4 of a source (or as streams), behind three exact points and before a polygon. */
static dyd_engine *faulty_engine(faulty *f, bool streams) {
  dyd_engine *e = engine_new();
  dyd_source source = faulty_source(f);
  const double x[3] = {-50, 0, 60}, y[3] = {-30, 90, -40};
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 3, x, y, NULL));
  if (!streams) {
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 5, &source, NULL));
    return e;
  }
  for (size_t k = 0; k < 5; k++) {
    dyd_stream *s = NULL;
    if (k) source.release = NULL;
    assert_int_equal(DYD_OK, dyd_stream_new(&s, &source, k, NULL));
    assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
  }
  return e;
}

static const struct {
  fault kind;
  dyd_status code;
  const char *says;
} faults[] = {
    {FAULT_WIDEN, DYD_E_NESTING, "not inside"}, {FAULT_DRIFT, DYD_E_NESTING, "not inside"},
    {FAULT_FAIL, DYD_E_STREAM, "fire"},         {FAULT_JUNK, DYD_E_STREAM, "valid"},
    {FAULT_UNKNOWN, DYD_E_STREAM, "77"},
};

/* Faults at the first, second, third answer of a point; uniform to high precision, so that all is asked. */
static void test_faults(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof faults / sizeof *faults; k++)
    for (uint64_t stage = 0; stage < 4; stage++)
      for (int streams = 0; streams < 2; streams++) {
        bool nesting = faults[k].code == DYD_E_NESTING;
        if (nesting && stage == 0) continue; /* the first answer has nothing to be nested in */
        faulty f = {.kind = faults[k].kind, .point = 2, .stage = stage};
        dyd_engine *e = faulty_engine(&f, streams);
        dyd_engine_options o;
        monotone m;
        monotone_init(&m, e);
        dyd_engine_options_init(&o);
        o.schedule = DYD_SCHEDULE_UNIFORM;
        o.goal = DYD_GOAL_HAUSDORFF;
        o.goal_bits = 3000;
        o.progress = monotone_progress;
        o.progress_user = &m;
        dyd_outcome outcome;
        dyd_error err;
        assert_int_equal(faults[k].code, dyd_engine_run(&outcome, e, &o, &err));
        assert_int_equal(DYD_OUTCOME_ERROR, outcome);
        assert_int_equal(faults[k].code, err.code);
        assert_int_equal(5, err.point);
        assert_int_equal(stage, err.stage);
        if (!strstr(err.message, faults[k].says)) fail_msg("no \"%s\" in: %s", faults[k].says, err.message);
        assert_true((dyd_engine_delaunay(e) != NULL) == (stage > 0));
        /* Points 3, 4 of the engine were narrowed before the fault; that is brought in as one more stage. */
        assert_int_equal(stage ? stage + 1 : 0, engine_counters(e).stages);
        assert_int_equal(stage ? stage + 1 : 0, m.stages);
        if (stage) monotone_look(&m);
        /* It fails again in the same place, and stays valid. */
        assert_int_equal(faults[k].code, dyd_engine_run(&outcome, e, &o, &err));
        assert_int_equal(5, err.point);
        assert_int_equal(stage, err.stage);
        if (stage) monotone_look(&m);
        monotone_clear(&m);
        dyd_engine_free(e);
        assert_int_equal(1, f.released);
      }
}

/* A fault that passes: the next run continues. */
static void test_repaired(void **state) {
  (void)state;
  faulty f = {.kind = FAULT_FAIL, .point = 3, .stage = 0};
  dyd_engine *e = faulty_engine(&f, false);
  engine_run(e, NULL, DYD_OUTCOME_ERROR);
  assert_null(dyd_engine_delaunay(e));
  f.kind = FAULT_NONE;
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  assert_int_equal(5, engine_counters(e).calls - 1); /* 4 calls, one of them failed, then the 2 that were left */
  dyd_engine_free(e);
}

/* A stream that never gets narrower: its bits grow to the limit, then the budget is spent. */
static void test_stall(void **state) {
  (void)state;
  for (int streams = 0; streams < 2; streams++) {
    faulty f = {.kind = FAULT_STALL, .point = 1, .stage = 1};
    dyd_engine *e = faulty_engine(&f, streams);
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.goal = DYD_GOAL_HAUSDORFF;
    o.goal_bits = 500;
    engine_run(e, &o, DYD_OUTCOME_BUDGET);
    dyd_engine_counters c = engine_counters(e);
    assert_int_equal(DYD_BUDGET_BITS, c.spent);
    assert_int_equal(4096, c.bits_most);
    assert_true(c.calls < 40);
    uint64_t calls = c.calls;
    engine_run(e, &o, DYD_OUTCOME_BUDGET);
    assert_int_equal(calls, engine_counters(e).calls);
    dyd_engine_free(e);
  }
}

/* An answer with a side as it was given states nothing at first: no point (0, 0). Later it repeats what is known. */
static void test_unset(void **state) {
  (void)state;
  const char *says[2][2] = {
      {"stage 0 without setting the x side of point 5", "stage 0 without setting the y side of point 5"},
      {"stage 0 without setting the x side of point 2", "stage 0 without setting the y side of point 2"}};
  for (int half = 0; half < 2; half++)
    for (int streams = 0; streams < 2; streams++)
      for (uint64_t stage = 0; stage < 2; stage++) {
        faulty f = {.kind = half ? FAULT_HALF : FAULT_SILENT, .point = 2, .stage = stage};
        dyd_engine *e = faulty_engine(&f, streams);
        dyd_engine_options o;
        dyd_outcome outcome;
        dyd_error err;
        dyd_engine_options_init(&o);
        o.max_bits = 40;
        dyd_status st = dyd_engine_run(&outcome, e, &o, &err);
        assert_int_equal(stage ? DYD_OK : DYD_E_STREAM, st);
        if (!stage && !strstr(err.message, says[streams][half])) fail_msg("%s", err.message);
        if (!stage) assert_int_equal(5, err.point);
        if (!stage) assert_int_equal(0, err.stage);
        assert_true((dyd_engine_delaunay(e) != NULL) == (stage > 0));
        dyd_engine_free(e);
      }
}

/* Adding takes ownership of its argument, also when it fails. */
static void test_release(void **state) {
  (void)state;
  faulty f = {0};
  dyd_engine *e = engine_new();
  dyd_source source = faulty_source(&f), none = faulty_source(&f);
  none.narrow = NULL;
  assert_int_equal(DYD_E_ARG, dyd_engine_add_source(e, 3, &none, NULL));
  assert_int_equal(1, f.released);
  assert_true(dyd_engine_add_source(e, SIZE_MAX / 2, &source, NULL) < 0);
  assert_int_equal(2, f.released);
  assert_int_equal(0, dyd_engine_count(e));
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 0, &source, NULL));
  assert_int_equal(2, f.released);
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  assert_int_equal(DYD_E_ARG, dyd_engine_add_source(NULL, 1, &source, NULL));
  assert_int_equal(3, f.released);
  dyd_stream *s = NULL;
  assert_int_equal(DYD_OK, dyd_stream_new(&s, &source, 0, NULL));
  assert_int_equal(DYD_E_ARG, dyd_engine_add_stream(NULL, s, NULL));
  assert_int_equal(4, f.released);
  dyd_engine_free(e);
  assert_int_equal(5, f.released);
}

/* A reference kept by the caller survives the engine. */
static void test_reference(void **state) {
  (void)state;
  faulty f = {0};
  dyd_engine *e = engine_new();
  dyd_source source = faulty_source(&f);
  dyd_stream *s = NULL;
  assert_int_equal(DYD_OK, dyd_stream_new(&s, &source, 2, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, dyd_stream_ref(s), NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, dyd_stream_ref(s), NULL));
  engine_run(e, NULL, DYD_OUTCOME_DECIDED); /* two sites are always joined */
  dyd_engine_free(e);
  assert_int_equal(0, f.released);
  assert_true(dyd_rect_bits(dyd_stream_rect(s)) >= 64);
  dyd_stream_free(s);
  assert_int_equal(1, f.released);
}

/* An expression that is undefined: the error has the point. */
static void test_undefined(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const double x[2] = {0, 1}, y[2] = {0, 2};
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x, y, NULL));
  engine_add_text(e, "sqrt(2)", "1/(sin(1)^2+cos(1)^2-1)");
  dyd_outcome outcome;
  dyd_error err;
  assert_int_equal(DYD_E_DOMAIN, dyd_engine_run(&outcome, e, NULL, &err));
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  assert_int_equal(2, err.point);
  assert_int_equal(0, err.stage);
  dyd_engine_free(e);
}

/* A first answer that is almost the whole plane is an answer. */
static dyd_status wide(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  int64_t *size = user;
  (void)err;
  dyd_interval *side[2] = {&out->x, &out->y};
  for (int a = 0; a < 2; a++) {
    if (q->bits <= 64) {
      dyd_dyadic_set_si_2exp(&side[a]->hi, 1, *size);
      dyd_dyadic_neg(&side[a]->lo, &side[a]->hi);
    } else {
      dyd_dyadic_set_si_2exp(&side[a]->hi, 3, 0);
      dyd_dyadic_set_si_2exp(&side[a]->lo, 3, 0);
    }
  }
  return q->bits <= 64 ? DYD_OK : DYD_FIXED;
}

static void test_wide(void **state) {
  (void)state;
  const int64_t sizes[] = {10, 5000, DYD_EXP_LIMIT - 1};
  for (int k = 0; k < 3; k++) {
    int64_t size = sizes[k];
    dyd_engine *e = engine_new();
    dyd_source source = {DYD_SIZED(dyd_source), .narrow = wide, .user = &size};
    const double x[3] = {0, 10, 0}, y[3] = {0, 0, 11};
    assert_int_equal(DYD_OK, dyd_engine_add_points(e, 3, x, y, NULL));
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 1, &source, NULL));
    dyd_outcome outcome;
    dyd_status status = dyd_engine_run(&outcome, e, NULL, NULL);
    /* The widest rectangle there is may be too much for the triangulation: an error then, never a wrong answer. */
    if (k == 2 && status == DYD_E_RANGE)
      assert_int_equal(DYD_OUTCOME_ERROR, outcome);
    else
      assert_int_equal(DYD_OUTCOME_DECIDED, outcome);
    if (outcome == DYD_OUTCOME_DECIDED) assert_int_equal(2, engine_counters(e).calls);
    dyd_engine_free(e);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_faults),    cmocka_unit_test(test_unset),   cmocka_unit_test(test_repaired),
      cmocka_unit_test(test_stall),     cmocka_unit_test(test_release), cmocka_unit_test(test_reference),
      cmocka_unit_test(test_undefined), cmocka_unit_test(test_wide),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
