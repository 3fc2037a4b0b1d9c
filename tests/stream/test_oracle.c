/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Programs as sources: [ORA-2] results whatever jobs, batch and time; every fault of a
 * program gives the right error, in little memory and time, keeps known results, and leaves no process, descriptor or
 * signal behind. The programs are this test, started with "serve" (oracle_serve.c). */
#define _GNU_SOURCE /* usleep, NSIG */
#include "rect/rect.h"
#include "stream/harness.h"
#include "stream/leftover.h"
#include "stream/oracle_serve.h"

#include <dyadel/dyadel.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define POINTS 5
#define EXACT 3 /* exact points before those of the oracle */

static const char *self;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void assert_says(const dyd_error *err, const char *words) {
  if (!strstr(err->message, words)) fail_msg("no \"%s\" in: %s", words, err->message);
}

/* ---- engines ---- */

static void start(dyd_source *out, const char *fault, int stage, const char *more, const dyd_oracle_options *o,
                  dyd_status want, const char *says) {
  size_t points = 0;
  char command[1000];
  dyd_error err;
  dyd_error_clear(&err);
  snprintf(command, sizeof command, "exec '%s' serve %s %d %d %s", self, fault, POINTS, stage, more);
  dyd_status status = dyd_oracle_source(out, &points, command, o, &err);
  if (status != want) fail_msg("%s: status %d: %s", fault, status, err.message);
  assert_int_equal(want == DYD_OK ? POINTS : 0, points);
  assert_says(&err, says);
}

/* Points of the engine: EXACT exact ones, then those of the oracle, or the same points by a callback. */
static dyd_engine *engine_of(const dyd_source *source) {
  dyd_engine *e = NULL;
  const double x[EXACT] = {-50, 0, 60}, y[EXACT] = {-30, 90, -40};
  assert_int_equal(DYD_OK, dyd_engine_new(&e));
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, EXACT, x, y, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, POINTS, source, NULL));
  return e;
}

static dyd_engine *engine_with(const char *fault, int stage, const char *more, const dyd_oracle_options *o) {
  dyd_source source = {DYD_SIZED(dyd_source)};
  start(&source, fault, stage, more, o, DYD_OK, "");
  return engine_of(&source);
}

/* All points are asked again and again, up to 1600 bits. */
static dyd_engine_options long_run(void) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.schedule = DYD_SCHEDULE_UNIFORM;
  o.goal = DYD_GOAL_HAUSDORFF;
  o.goal_bits = 1500;
  return o;
}

static dyd_outcome run_long(dyd_engine *e, dyd_error *err) {
  dyd_engine_options o = long_run();
  dyd_outcome outcome;
  dyd_engine_run(&outcome, e, &o, err);
  return outcome;
}

static dyd_status in_process(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  dyd_interval *side[2] = {&out->x, &out->y};
  mpz_t m;
  mpz_init(m);
  (void)user, (void)err;
  for (int axis = 0; axis < 2; axis++) {
    oracle_floor(m, (unsigned long)q->point, axis, q->bits);
    assert_int_equal(DYD_OK, dyd_dyadic_set_z_2exp(&side[axis]->lo, m, -q->bits));
    mpz_add_ui(m, m, 1);
    assert_int_equal(DYD_OK, dyd_dyadic_set_z_2exp(&side[axis]->hi, m, -q->bits));
  }
  mpz_clear(m);
  return DYD_OK;
}

static void assert_same_rects(const dyd_engine *e, const dyd_engine *f) {
  const dyd_sites *s = dyd_delaunay_sites(dyd_engine_delaunay(e)), *t = dyd_delaunay_sites(dyd_engine_delaunay(f));
  dyd_rect a, b;
  dyd_rect_init(&a);
  dyd_rect_init(&b);
  for (size_t k = 0; k < EXACT + POINTS; k++) {
    assert_int_equal(DYD_OK, dyd_sites_get(&a, s, k));
    assert_int_equal(DYD_OK, dyd_sites_get(&b, t, k));
    assert_true(dyd_rect_equal(&a, &b));
  }
  for (uint32_t i = 0; i < EXACT + POINTS; i++)
    for (uint32_t j = 0; j < i; j++)
      assert_int_equal(dyd_delaunay_status(dyd_engine_delaunay(e), i, j),
                       dyd_delaunay_status(dyd_engine_delaunay(f), i, j));
  dyd_rect_clear(&b);
  dyd_rect_clear(&a);
}

/* [ORA-2] The same rectangles, statuses and calls as without a program. */
static void test_same(void **state) {
  (void)state;
  const unsigned jobs[] = {1, 2, 3, 20}, batch[] = {1, 2, 3, 100};
  dyd_source plain = {DYD_SIZED(dyd_source), .narrow = in_process};
  dyd_engine *want = engine_of(&plain);
  assert_int_equal(DYD_OUTCOME_CERTIFIED, run_long(want, NULL));
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)}, d = c;
  dyd_engine_get_counters(&c, want, NULL);
  for (int k = 0; k < 16; k++) {
    dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = jobs[k / 4], .batch = batch[k % 4]};
    dyd_engine *e = engine_with(k == 7 ? "slow" : "none", 0, "", &o);
    dyd_error err;
    if (run_long(e, &err) != DYD_OUTCOME_CERTIFIED) fail_msg("%s", err.message);
    assert_same_rects(want, e);
    dyd_engine_get_counters(&d, e, NULL);
    assert_int_equal(c.calls, d.calls);
    assert_int_equal(c.stages, d.stages);
    dyd_engine_free(e);
    assert_nothing_left();
  }
  dyd_engine_free(want);
}

/* Three programs that wait for each other at their first request; a program that reads four before it answers one. */
static void test_side_by_side(void **state) {
  (void)state;
  char folder[] = "/tmp/dyadel-oracle-XXXXXX", mark[100];
  assert_non_null(mkdtemp(folder));
  dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = 3, .seconds = 60};
  dyd_engine *e = engine_with("meet", 3, folder, &o);
  assert_int_equal(DYD_OUTCOME_CERTIFIED, run_long(e, NULL));
  dyd_engine_free(e);
  for (int k = 0; k < 3; k++) {
    snprintf(mark, sizeof mark, "%s/%d", folder, k);
    assert_int_equal(0, unlink(mark));
  }
  assert_int_equal(0, rmdir(folder));
  o = (dyd_oracle_options){DYD_SIZED(dyd_oracle_options), .batch = 4, .seconds = 60};
  e = engine_with("gather", 99, "4", &o);
  assert_int_equal(DYD_OUTCOME_CERTIFIED, run_long(e, NULL));
  dyd_engine_free(e);
  assert_nothing_left();
}

/* ---- faults ---- */

/* next: the answer itself is good, and the next request meets the fault. slow: meets the time limit. */
static const struct {
  const char *name;
  dyd_status code;
  bool next, slow;
  const char *says;
} faults[] = {
    {"exit", DYD_E_STREAM, false, false, "ended with exit status 3"},
    {"kill", DYD_E_STREAM, false, false, "killed by signal 9"},
    {"half", DYD_E_STREAM, false, false, "in the middle of a line"},
    {"mute", DYD_E_STREAM, false, true, "closed its standard output"},
    {"hang", DYD_E_STREAM, false, true, "silent for 0.4 s; flush"},
    {"stubborn", DYD_E_STREAM, false, true, "silent for 0.4 s; flush"},
    {"child", DYD_E_STREAM, false, true, "a process that it started was silent"},
    {"flood", DYD_E_STREAM, false, false, "a line of more than 1048576 bytes"},
    {"rubbish", DYD_E_STREAM, false, false, "it wrote \"lorem ipsum\" instead of an answer for point 2"},
    {"empty", DYD_E_STREAM, false, false, "it wrote \"\" instead of an answer for point 2"},
    {"bytes", DYD_E_STREAM, false, false, "it wrote \"?[2J?? 1 2\" instead of an answer for point 2"},
    {"nul", DYD_E_STREAM, false, false, "is not an exact number"},
    {"number", DYD_E_STREAM, false, false, "it wrote \"22 0 1 0 1\" instead of an answer for point 2"},
    {"four", DYD_E_STREAM, false, false, "five words"},
    {"seven", DYD_E_STREAM, false, false, "five words"},
    {"sixth", DYD_E_STREAM, false, false, "five words"},
    {"exchanged", DYD_E_STREAM, false, false, "lower end of the x side"},
    {"word", DYD_E_STREAM, false, false, "\"one\", column 9 of its answer, is not an exact number"},
    {"root", DYD_E_STREAM, false, false, "\"sqrt(2)\""},
    {"zero", DYD_E_STREAM, false, false, "\"1/0\""},
    {"infinite", DYD_E_STREAM, false, false, "\"-inf\""},
    {"range", DYD_E_RANGE, false, false, ""},
    {"bare", DYD_E_STREAM, false, false, "it wrote \"2\" instead of an answer for point 2"},
    {"negative", DYD_E_STREAM, false, false, "instead of an answer for point 2"},
    {"glued", DYD_E_STREAM, false, false, "instead of an answer for point 2"},
    {"other", DYD_E_STREAM, false, false, "it wrote \"3 0 1 0 1\" instead of an answer for point 2"},
    {"wide", DYD_E_NESTING, false, false, "is not inside the old one"},
    {"drift", DYD_E_NESTING, false, false, "is not inside the old one"},
    {"twice", DYD_E_STREAM, true, false, "it wrote \"2 "},
    {"lines", DYD_E_STREAM, true, false, "it wrote \"2 0 1 0 1\""},
    {"blank", DYD_E_STREAM, true, false, "it wrote \"\""},
    {"last", DYD_E_STREAM, true, false, "ended with exit status 0"},
    {"deaf", DYD_E_STREAM, true, true, "closed its standard input"},
};

static long peak_kib(void) {
  struct rusage u;
  getrusage(RUSAGE_SELF, &u);
  return u.ru_maxrss;
}

/* The error a run ended with. Where the next request of the faulty program is for the same point, in the next stage, a
 * line too many may come in time to pass for its answer, and fail for not being nested. */
static void check_error(size_t k, size_t stage, const dyd_error *err, const dyd_oracle_options *o) {
  assert_says(err, "the oracle program was asked \"refine ");
  if (faults[k].next && o->jobs > 2) {
    assert_true(err->code == DYD_E_STREAM || err->code == DYD_E_NESTING);
    assert_int_equal(EXACT + BAD_POINT, err->point);
    assert_int_equal(stage + 1, err->stage);
    return;
  }
  if (faults[k].code != err->code) fail_msg("%s: code %d: %s", faults[k].name, err->code, err->message);
  assert_says(err, faults[k].says);
  assert_int_equal(EXACT + BAD_POINT + faults[k].next, err->point);
  assert_int_equal(stage, err->stage);
}

static void check_fault(size_t k, int stage, const dyd_oracle_options *o, const dyd_engine *good) {
  double begun = now();
  dyd_engine *e = engine_with(faults[k].name, stage, "", o);
  dyd_error err;
  dyd_outcome outcome = run_long(e, &err);
  if (outcome != DYD_OUTCOME_ERROR) fail_msg("%s: %s", faults[k].name, dyd_outcome_text(outcome));
  check_error(k, (size_t)stage, &err, o);
  assert_true((dyd_engine_delaunay(e) != NULL) == (err.stage > 0));
  /* Earlier results stay, and are true. */
  for (uint32_t i = 0; dyd_engine_delaunay(e) && i < EXACT + POINTS; i++)
    for (uint32_t j = 0; j < i; j++) {
      dyd_pair_status s = dyd_delaunay_status(dyd_engine_delaunay(e), i, j);
      if (s != DYD_INDETERMINATE) assert_int_equal(dyd_delaunay_status(dyd_engine_delaunay(good), i, j), s);
    }
  /* A program that failed stays so; one that gave a bad answer may continue. */
  run_long(e, &err);
  dyd_engine_free(e);
  assert_nothing_left();
  if (now() - begun > 20) fail_msg("%s: %g s", faults[k].name, now() - begun);
}

static void test_faults(void **state) {
  (void)state;
  dyd_source plain = {DYD_SIZED(dyd_source), .narrow = in_process};
  dyd_engine *good = engine_of(&plain);
  assert_int_equal(DYD_OUTCOME_CERTIFIED, run_long(good, NULL));
  long before = peak_kib();
  for (size_t k = 0; k < sizeof faults / sizeof *faults; k++)
    for (int way = 0; way < 4; way++) {
      int stage = way % 2 * 2;
      if (faults[k].code == DYD_E_NESTING && stage == 0) continue; /* the first answer has nothing to be nested in */
      if (faults[k].slow && way > 1) continue;
      /* A good answer for the same point is an answer, if it comes late enough. */
      if (way > 1 && strcmp(faults[k].name, "twice") == 0) continue;
      dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = way < 2 ? 1 : 3, .batch = way < 2 ? 1 : 4,
                              .seconds = faults[k].slow ? 0.4 : 60};
      check_fault(k, stage, &o, good);
    }
  dyd_engine_free(good);
  if (test_environment("DYADEL_TEST_SANITIZED", 0) == 0) assert_in_range(peak_kib() - before, 0, 30000);
}

static const struct {
  const char *name, *says;
} starts[] = {
    {"start-exit", "ended with exit status 5"},
    {"start-hang", "silent for 0.4 s"},
    {"start-flood", "a line of more than 1048576 bytes"},
    {"start-rubbish", "is \"hello, world\"; print \"points N\""},
    {"start-minus", "is \"points -3\"; print"},
    {"start-many", "is \"points 999999999999\"; print"},
    {"start-more", "is \"points 5 or so\"; print"},
    {"start-huge", "is \"points 999999999\"; print"},
    {"start-child", "a process that it started was silent"},
    {"start-differ", "program 0 has 5 points, program 1 has 6"},
};

static void test_starts(void **state) {
  (void)state;
  dyd_source source = {DYD_SIZED(dyd_source)};
  size_t points;
  dyd_error err;
  for (size_t k = 0; k < sizeof starts / sizeof *starts; k++) {
    dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = 2, .seconds = 0.4};
    if (strstr("start-flood start-differ start-exit", starts[k].name)) o.seconds = 60;
    start(&source, starts[k].name, 0, "", &o, DYD_E_STREAM, starts[k].says);
    assert_null(source.user);
    assert_nothing_left();
  }
  assert_int_equal(DYD_E_STREAM, dyd_oracle_source(&source, &points, "/nowhere/nothing 2>/dev/null", NULL, &err));
  assert_says(&err, "did not find the command");
  assert_int_equal(DYD_E_STREAM, dyd_oracle_source(&source, &points, "", NULL, NULL));
  dyd_oracle_options bad[] = {{.jobs = 5000}, {.batch = 100000}, {.seconds = -1}, {.seconds = (double)NAN}};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    bad[k].struct_size = sizeof bad[k];
    assert_int_equal(DYD_E_ARG, dyd_oracle_source(&source, &points, "echo points 3", &bad[k], &err));
    assert_says(&err, k < 2 ? "`batch` above" : "`seconds` is below 0");
  }
  assert_int_equal(DYD_E_ARG, dyd_oracle_source(&source, &points, NULL, NULL, &err));
  volatile int stop = 1;
  dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .stop = &stop};
  start(&source, "start-hang", 0, "", &o, DYD_CANCELLED, "");
  assert_null(source.user);
  assert_nothing_left();
}

/* No descriptors to be had: an error, and nothing left. */
static void test_no_descriptors(void **state) {
  (void)state;
  struct rlimit old, few;
  dyd_source source = {DYD_SIZED(dyd_source)};
  size_t points;
  dyd_error err;
  int open_now = count_descriptors();
  assert_int_equal(0, getrlimit(RLIMIT_NOFILE, &old));
  for (int more = 0; more <= 12; more++) {
    few = old;
    few.rlim_cur = (rlim_t)(open_now + more);
    assert_int_equal(0, setrlimit(RLIMIT_NOFILE, &few));
    dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = 2};
    dyd_status status = dyd_oracle_source(&source, &points, "echo points 3; cat >/dev/null", &o, &err);
    assert_int_equal(0, setrlimit(RLIMIT_NOFILE, &old));
    if (more < 4) assert_int_equal(DYD_E_STREAM, status);
    if (more == 12) assert_int_equal(DYD_OK, status);
    if (status == DYD_OK) source.release(source.user);
    assert_nothing_left();
  }
}

/* ---- cancel, time, death ---- */

static void *cancel_soon(void *engine) {
  usleep(200000);
  dyd_engine_cancel(engine);
  return NULL;
}

/* A program that hangs is no longer waited for when the run is cancelled or out of time. */
static void test_interrupted(void **state) {
  (void)state;
  for (int timed = 0; timed < 2; timed++) {
    dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = 2, .seconds = 100};
    dyd_engine *e = engine_with("hang", 1, "", &o);
    dyd_engine_options run = long_run();
    run.seconds = timed ? 0.3 : 0;
    pthread_t thread;
    double begun = now();
    if (!timed) assert_int_equal(0, pthread_create(&thread, NULL, cancel_soon, e));
    dyd_outcome outcome;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &run, NULL));
    if (!timed) pthread_join(thread, NULL);
    assert_int_equal(timed ? DYD_OUTCOME_BUDGET : DYD_OUTCOME_CANCELLED, outcome);
    assert_non_null(dyd_engine_delaunay(e));
    dyd_engine_free(e);
    assert_true(now() - begun < 10);
    assert_nothing_left();
  }
}

/* After a run that was stopped, late answers to old requests are not taken for new ones. */
static void test_resumed(void **state) {
  (void)state;
  dyd_source plain = {DYD_SIZED(dyd_source), .narrow = in_process};
  dyd_engine *want = engine_of(&plain);
  assert_int_equal(DYD_OUTCOME_CERTIFIED, run_long(want, NULL));
  for (int k = 0; k < 4; k++) {
    dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = k % 2 ? 2 : 1, .batch = k / 2 ? 3 : 1};
    dyd_engine *e = engine_with("slow", 0, "", &o);
    dyd_engine_options run = long_run();
    dyd_outcome outcome = DYD_OUTCOME_NONE;
    run.seconds = 0.02;
    for (int tries = 0; tries < 1000 && outcome != DYD_OUTCOME_CERTIFIED; tries++)
      assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &run, NULL));
    assert_same_rects(want, e);
    dyd_engine_free(e);
  }
  dyd_engine_free(want);
  assert_nothing_left();
}

/* The process that uses the library is killed: its programs, even stubborn ones and their children, are too. */
static void test_orphans(void **state) {
  (void)state;
  int ready[2];
  char byte;
  assert_int_equal(0, pipe(ready));
  pid_t child = fork();
  if (child == 0) {
    dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = 2, .seconds = 2};
    dyd_engine *e = engine_with("stubborn", 0, "", &o);
    write(ready[1], "x", 1);
    run_long(e, NULL);
    pause();
  }
  assert_int_equal(1, read(ready[0], &byte, 1));
  usleep(200000);
  assert_true(count_marked() > 2);
  kill(child, SIGKILL);
  assert_int_equal(child, waitpid(child, NULL, 0));
  close(ready[0]);
  close(ready[1]);
  assert_nothing_left();
}

/* Without an engine: points asked in any order. */
static void test_requests(void **state) {
  (void)state;
  dyd_source source = {DYD_SIZED(dyd_source)};
  dyd_rect rect[POINTS];
  bool asked[POINTS] = {false};
  dyd_oracle_options o = {DYD_SIZED(dyd_oracle_options), .jobs = 2, .batch = 3};
  dyd_error err;
  start(&source, "none", 0, "", &o, DYD_OK, "");
  for (size_t k = 0; k < POINTS; k++) {
    dyd_rect_init(&rect[k]);
    dyd_rect_unset(&rect[k]);
  }
  test_random r = test_random_start("oracle streams");
  for (size_t k = test_cases(200); k; k--) {
    size_t p = (size_t)test_below(&r, POINTS);
    int64_t bits = test_between(&r, 0, 300);
    if (asked[p] && dyd_rect_bits(&rect[p]) >= bits) continue;
    asked[p] = true;
    dyd_request list[POINTS], one = {DYD_SIZED(dyd_request), .point = p, .bits = bits, .max_bits = 4096};
    for (size_t j = 0; j < POINTS; j++)
      list[j] = (dyd_request){DYD_SIZED(dyd_request), .point = test_below(&r, POINTS + 1), .bits = bits};
    if (test_chance(&r, 3)) source.announce(source.user, list, (size_t)test_below(&r, POINTS));
    dyd_status status = source.narrow(&rect[p], source.user, &one, &err);
    if (status < 0) fail_msg("%s", err.message);
    assert_true(status == DYD_FIXED || dyd_rect_bits(&rect[p]) >= bits);
  }
  const dyd_request beyond = {DYD_SIZED(dyd_request), .point = POINTS, .bits = 3, .max_bits = 4096};
  assert_int_equal(DYD_E_ARG, source.narrow(&rect[0], source.user, &beyond, &err));
  assert_says(&err, "has 5 points only");
  for (size_t k = 0; k < POINTS; k++) dyd_rect_clear(&rect[k]);
  source.release(source.user);
  assert_nothing_left();
}

/* ---- fork ---- */

/* A forked copy may not use the program, nor does it end it: it says so, frees its memory, and the parent continues
 * undisturbed. Without a program the copy works. */
static void test_forked(void **state) {
  (void)state;
  dyd_error err;
  dyd_outcome outcome;
  dyd_source callback = {DYD_SIZED(dyd_source), .narrow = in_process};
  dyd_engine *e = engine_with("none", 0, "", NULL), *f = engine_of(&callback);
  dyd_engine_options once = long_run();
  once.max_stages = 1;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &once, &err));
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, f, &once, &err));
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    dyd_engine_options o = long_run();
    bool good =
        dyd_engine_run(&outcome, f, &o, &err) == DYD_OK && dyd_engine_run(&outcome, e, &o, &err) == DYD_E_STREAM;
    good &= strstr(err.message, "the process that started it") != NULL;
    dyd_engine_free(f);
    dyd_engine_free(e);
    _exit(!good);
  }
  int status = -1;
  assert_int_equal(child, waitpid(child, &status, 0));
  assert_int_equal(0, status);
  assert_int_equal(run_long(f, &err), run_long(e, &err));
  assert_same_rects(e, f);
  dyd_engine_free(f);
  dyd_engine_free(e);
}

int main(int argc, char **argv) {
  if (argc > 4 && strcmp(argv[1], "serve") == 0) return oracle_serve(argc, argv);
  self = argv[0];
  leftover_mark();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_same),        cmocka_unit_test(test_forked),  cmocka_unit_test(test_side_by_side),
      cmocka_unit_test(test_faults),      cmocka_unit_test(test_starts),  cmocka_unit_test(test_no_descriptors),
      cmocka_unit_test(test_interrupted), cmocka_unit_test(test_resumed), cmocka_unit_test(test_orphans),
      cmocka_unit_test(test_requests),
  };
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
