/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Questions of users, answered by the loop of the engine. */
#include "engine/help.h"
#include "rect/rect.h"
#include "stream/stream.h"

#include <string.h>

/* A question that compares x of sites 0 and 1, and notes how it was asked. */
typedef struct left {
  int64_t bits;      /* wanted of both; DYD_BITS_NEXT: as the options grow */
  bool left, right;  /* answers */
  unsigned asked;    /* how often */
  size_t wanted;     /* points wanted last */
  double width;      /* of site 0 when last asked */
  dyd_engine *enter; /* entered from within, and cancelled before asking number cancel_at returns */
  unsigned cancel_at;
  dyd_stream *guest;   /* compared instead of site 1 */
  uint32_t also;       /* wanted besides, when not 0 */
  bool boast, ignores; /* says that it is answered; ignores what dyd_wants_add returns */
  dyd_status give;     /* returned instead of DYD_OK, with a message unless mute */
  bool mute;
} left;

static void enter_from_within(dyd_engine *e);

static dyd_status ask_left(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  left *q = user;
  double a[4], b[4];
  assert_false(*answered);
  assert_int_equal(0, dyd_wants_count(wants));
  assert_int_equal(0, err->message[0]);
  if (q->enter && q->cancel_at == 0) enter_from_within(q->enter);
  if (++q->asked == q->cancel_at) dyd_engine_cancel(q->enter);
  uint32_t other = q->guest ? (uint32_t)dyd_engine_count(e) : 1;
  dyd_sites_get_d(a, dyd_engine_sites(e), 0);
  dyd_sites_get_d(b, dyd_engine_sites(e), 1);
  if (q->guest) {
    assert_non_null(dyd_stream_rect(q->guest));
    dyd_interval_get_d(&b[0], &b[1], &dyd_stream_rect(q->guest)->x);
  }
  q->left = a[1] < b[0];
  q->right = b[1] < a[0];
  q->width = a[1] - a[0];
  *answered = q->left || q->right || q->boast;
  dyd_status st = dyd_wants_add(wants, 0, q->bits);
  if (st == DYD_OK) st = dyd_wants_add(wants, other, q->bits);
  if (st == DYD_OK && q->also) st = dyd_wants_add(wants, q->also, q->bits);
  q->wanted = dyd_wants_count(wants);
  if (q->give && !q->mute) snprintf(err->message, sizeof err->message, "the question is foolish");
  return q->give ? q->give : q->ignores ? DYD_OK : st;
}

static dyd_outcome put(dyd_engine *e, left *q, const dyd_engine_options *o, dyd_error *err) {
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_error own;
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = ask_left, .user = q, .guest = &q->guest,
                                 .guests = q->guest != NULL};
  dyd_status st = dyd_engine_ask(&outcome, e, &question, o, err ? err : &own);
  assert_int_equal(outcome == DYD_OUTCOME_ERROR, st < 0);
  assert_true(st <= 0);
  assert_int_equal(st, (err ? err : &own)->code);
  return outcome;
}

static dyd_engine_options options(void) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  return o;
}

/* Two points that doubles tell apart at about `bits` bits, near 0; and one more, that fails when it is asked. */
static dyd_engine *engine_of_two(int bits) {
  char x[80];
  dyd_engine *e = engine_new();
  snprintf(x, sizeof x, "(sqrt(2)-exp(log(2)/2))+2^(-%d)*sqrt(3)", bits);
  engine_add_text(e, "sqrt(2)-exp(log(2)/2)", "sqrt(3)");
  engine_add_text(e, x, "sqrt(5)");
  engine_add_text(e, "log(sqrt(2)-sqrt(2))", "0");
  return e;
}

/* ---- outcomes ---- */

/* It is answered, by the points that it asks for alone, with the bits that it needs. */
static void test_answered(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  left q = {.bits = DYD_BITS_NEXT};
  assert_false(dyd_engine_knows(e, 0) || dyd_engine_knows(e, 3));
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, NULL, NULL));
  assert_true(q.left && !q.right);
  assert_int_equal(6, q.asked); /* nothing, 64, 128, 256, 512, 1024 bits */
  assert_true(dyd_engine_knows(e, 0) && dyd_engine_knows(e, 1) && !dyd_engine_knows(e, 2));
  dyd_engine_counters c = engine_counters(e);
  assert_int_equal(10, c.calls);
  assert_int_equal(1024, c.bits_least);
  assert_int_equal(1024, c.bits_most);
  assert_int_equal(2048, c.bits_total);
  assert_int_equal(0, c.stages);
  assert_true(c.seconds > 0);
  assert_int_equal(DYD_OUTCOME_NONE, dyd_engine_outcome(e));
  assert_null(dyd_engine_delaunay(e));
  q.asked = 0;
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, NULL, NULL));
  assert_int_equal(1, q.asked);
  assert_int_equal(10, engine_counters(e).calls);
  dyd_engine_free(e);
}

/* None of the sites it requests can be narrowed, or it requests none. */
static void test_fixpoint(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const double x0[2] = {0, 1}, x1[2] = {2, 3};
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 2, x0, x1, x0, x1, NULL));
  engine_add_text(e, "sqrt(2)", "0");
  left q = {.bits = 500};
  assert_true(dyd_engine_knows(e, 1));
  assert_int_equal(DYD_OUTCOME_FIXPOINT, put(e, &q, NULL, NULL));
  assert_int_equal(1, q.asked);
  assert_int_equal(0, q.wanted);
  assert_int_equal(0, engine_counters(e).calls);
  q.also = 2; /* narrower once, to the end of the budget */
  assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, NULL, NULL));
  dyd_engine_free(e);
}

static void test_bits(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  dyd_engine_options o = options();
  o.max_bits = 600;
  left q = {.bits = DYD_BITS_NEXT};
  assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
  assert_int_equal(0, q.wanted);
  assert_int_equal(600, engine_counters(e).bits_least);
  assert_int_equal(DYD_BUDGET_NONE, engine_counters(e).spent); /* of no run */
  o.max_bits = 1000;
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, &o, NULL));
  assert_int_equal(1000, engine_counters(e).bits_most);
  dyd_engine_free(e);
}

/* Precision of requests: the options' first precision and steps; the question's own where that is finer; the finest. */
static void test_steps(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(400);
  dyd_engine_options o = options();
  o.start_bits = 10;
  o.step_bits = 7;
  o.max_calls = 2;
  left q = {.bits = DYD_BITS_NEXT};
  const int64_t want[] = {10, 17, 24};
  for (int k = 0; k < 3; k++) {
    assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
    assert_int_equal(want[k], engine_counters(e).bits_least);
    assert_int_equal(want[k], engine_counters(e).bits_most);
  }
  q.bits = 24; /* not less than it has */
  assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
  assert_int_equal(31, engine_counters(e).bits_most);
  q.bits = 100;
  assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
  assert_int_equal(200, engine_counters(e).bits_total);
  dyd_engine_free(e);
}

static dyd_status ask_twice(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  int64_t *bits = user;
  (void)err;
  *answered = dyd_engine_knows(e, 0);
  for (int k = 0; k < 3; k++) assert_int_equal(DYD_OK, dyd_wants_add(wants, 0, bits[k]));
  assert_int_equal(1, dyd_wants_count(wants));
  return DYD_OK;
}

static void test_finest_counts(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(400);
  dyd_outcome outcome;
  int64_t bits[3] = {70, 90, 80};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = ask_twice, .user = bits};
  assert_int_equal(DYD_OK, dyd_engine_ask(&outcome, e, &question, NULL, NULL));
  assert_int_equal(DYD_OUTCOME_DECIDED, outcome);
  assert_int_equal(90, engine_counters(e).bits_most);
  dyd_engine_free(e);
}

static void test_calls(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  dyd_engine_options o = options();
  left q = {.bits = DYD_BITS_NEXT};
  for (uint64_t most = 1, calls = 0; most < 4; most++) {
    o.max_calls = most;
    assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
    calls += most;
    assert_int_equal(calls, engine_counters(e).calls);
  }
  dyd_engine_free(e);
}

/* The end of time: the question has seen the rectangles reached, and its last request was not carried out. */
static void test_seconds(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(900000);
  dyd_engine_options o = options();
  double box[4];
  left q = {.bits = DYD_BITS_NEXT};
  o.max_bits = 1000000;
  o.seconds = 1e-9;
  assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
  assert_int_equal(0, engine_counters(e).calls);
  o.seconds = 0.1;
  assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
  assert_true(engine_counters(e).calls > 0);
  assert_int_equal(2, q.wanted);
  dyd_sites_get_d(box, dyd_engine_sites(e), 0);
  assert_true(q.width == box[1] - box[0]);
  o.seconds = -1;
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, &o, NULL));
  dyd_engine_free(e);
}

/* ---- cancelling ---- */

static void test_cancel(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  left q = {.bits = DYD_BITS_NEXT};
  dyd_engine_cancel(e);
  assert_int_equal(DYD_OUTCOME_CANCELLED, put(e, &q, NULL, NULL));
  assert_int_equal(1, q.asked); /* to see what there is */
  assert_int_equal(0, engine_counters(e).calls);
  q = (left){.bits = DYD_BITS_NEXT, .enter = e, .cancel_at = 3}; /* from within; it was sticky for one ask only */
  assert_int_equal(DYD_OUTCOME_CANCELLED, put(e, &q, NULL, NULL));
  assert_int_equal(128, engine_counters(e).bits_most);
  assert_int_equal(4, engine_counters(e).calls);
  assert_int_equal(4, q.asked);
  q = (left){.bits = DYD_BITS_NEXT};
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, NULL, NULL));
  /* Answered all the same; the cancel is not lost. */
  dyd_engine_cancel(e);
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, NULL, NULL));
  engine_run(e, NULL, DYD_OUTCOME_CANCELLED);
  dyd_engine_free(e);
}

/* A source cancels within each call in turn: the ask stops after that call, and continues later. */
static void test_cancel_inside(void **state) {
  (void)state;
  for (uint64_t at = 1; at <= 4; at++) {
    faulty f = {.cancel_at = at};
    dyd_source source = faulty_source(&f);
    dyd_engine *e = engine_new();
    f.cancel = e;
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 2, &source, NULL));
    dyd_engine_options o = options();
    o.start_bits = -2;
    left q = {.bits = DYD_BITS_NEXT};
    assert_int_equal(at == 4 ? DYD_OUTCOME_DECIDED : DYD_OUTCOME_CANCELLED, put(e, &q, &o, NULL));
    assert_int_equal(at, f.calls);
    f.cancel = NULL;
    if (at < 4) assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, &o, NULL));
    assert_true(q.left);
    dyd_engine_free(e);
  }
}

/* ---- questions that fail ---- */

static void test_no_such_site(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  dyd_error err;
  for (int k = 0; k < 4; k++) {
    left q = {.bits = DYD_BITS_NEXT, .also = 3, .boast = k & 1, .ignores = k & 2};
    assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, NULL, &err));
    assert_int_equal(DYD_E_ARG, err.code);
    assert_non_null(strstr(err.message, "site 3, and there are 3"));
  }
  assert_int_equal(0, engine_counters(e).calls);
  assert_false(dyd_engine_knows(e, 3));
  left q = {.bits = DYD_BITS_NEXT};
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, NULL, &err));
  dyd_engine_free(e);
}

static void test_errors(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  dyd_error err;
  left q = {.bits = DYD_BITS_NEXT, .give = DYD_E_RANGE};
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, NULL, &err));
  assert_int_equal(DYD_E_RANGE, err.code);
  assert_string_equal("the question is foolish", err.message);
  q.mute = true;
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, NULL, &err));
  assert_string_equal(dyd_status_text(DYD_E_RANGE), err.message);
  q.give = DYD_CANCELLED;
  assert_int_equal(DYD_OUTCOME_CANCELLED, put(e, &q, NULL, &err));
  q.give = DYD_CAPPED;
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, NULL, &err));
  assert_int_equal(DYD_E_ARG, err.code);
  /* A point that fails. */
  q = (left){.bits = DYD_BITS_NEXT, .also = 2};
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, NULL, &err));
  assert_int_equal(DYD_E_DOMAIN, err.code);
  assert_int_equal(2, err.point);
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  const dyd_question empty = {DYD_SIZED(dyd_question), .ask = NULL};
  assert_int_equal(DYD_E_ARG, dyd_engine_ask(&outcome, e, &empty, NULL, NULL));
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  dyd_engine_free(e);
}

/* ---- calls from within ---- */

static dyd_stream *stream_of(const char *x, const char *y) {
  dyd_engine *e = engine_new();
  dyd_stream *s = NULL;
  engine_add_text(e, x, y);
  assert_int_equal(DYD_OK, dyd_engine_stream(&s, e, 0));
  dyd_engine_free(e);
  return s;
}

static void enter_from_within(dyd_engine *e) {
  dyd_outcome outcome = DYD_OUTCOME_NONE, before = dyd_engine_outcome(e);
  dyd_error err;
  left q = {.bits = DYD_BITS_NEXT};
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, NULL, &err));
  assert_int_equal(DYD_E_ARG, err.code);
  assert_non_null(strstr(err.message, "at work"));
  assert_int_equal(0, q.asked);
  assert_int_equal(DYD_E_ARG, dyd_engine_run(&outcome, e, NULL, &err));
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  assert_non_null(strstr(err.message, "at work"));
  assert_int_equal(before, dyd_engine_outcome(e));
  bool sure;
  dyd_index_list near = {0};
  dyd_stream *at = stream_of("sqrt(2)", "1");
  assert_int_equal(DYD_E_ARG, dyd_engine_nearest(&near, &sure, &outcome, e, at, NULL, &err));
  if (dyd_engine_delaunay(e)) assert_non_null(strstr(err.message, "at work"));
  dyd_stream_free(at);
  const double x = 1;
  assert_int_equal(DYD_E_ARG, dyd_engine_add_points(e, 1, &x, &x, NULL));
}

static void enter_from_progress(void *user, const dyd_progress *p) {
  (void)p;
  enter_from_within(user);
}

static void enter_from_trace(void *user, const dyd_step *step) {
  (void)step;
  enter_from_within(user);
}

static dyd_status enter_from_source(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  (void)err;
  enter_from_within(user);
  dyd_dyadic x;
  dyd_dyadic_init(&x);
  dyd_dyadic_set_d(&x, (double)q->point);
  assert_int_equal(DYD_OK, dyd_interval_set_ends(&out->x, &x, &x));
  assert_int_equal(DYD_OK, dyd_interval_set_ends(&out->y, &x, &x));
  dyd_dyadic_clear(&x);
  return DYD_FIXED;
}

static void test_entering(void **state) {
  (void)state;
  dyd_engine *e = engine_of_two(700);
  left q = {.bits = DYD_BITS_NEXT, .enter = e};
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, NULL, NULL));
  assert_int_equal(6, q.asked);
  dyd_engine_free(e);
  e = engine_new();
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = enter_from_source, .user = e};
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 3, &source, NULL));
  engine_add_text(e, "sqrt(2)", "sqrt(3)");
  dyd_engine_options o = options();
  o.progress = enter_from_progress;
  o.trace = enter_from_trace;
  o.progress_user = o.trace_user = e;
  o.max_stages = 1;
  dyd_outcome outcome;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
  assert_int_equal(1, engine_counters(e).stages);
  assert_int_equal(4, engine_counters(e).calls);
  dyd_engine_free(e);
}

/* ---- guests ---- */

static void count_step(void *user, const dyd_step *step) {
  unsigned *count = user;
  assert_int_equal(0, step->site);
  assert_int_equal(DYD_REASON_QUESTION, step->reason);
  assert_true(step->i == 0 && step->j == 0 && step->stage == 1);
  ++*count;
}

static void test_guests(void **state) {
  (void)state;
  unsigned steps = 0;
  dyd_engine *e = engine_of_two(700);
  dyd_engine_options o = options();
  o.trace = count_step;
  o.trace_user = &steps;
  left q = {.bits = DYD_BITS_NEXT, .guest = stream_of("sqrt(2)-exp(log(2)/2)-2^(-300)*pi", "0")};
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, &o, NULL));
  assert_true(q.right);
  assert_int_equal(4, steps); /* 64, 128, 256, 512 bits of site 0; the guest is one step ahead */
  assert_int_equal(4, engine_counters(e).calls);
  assert_int_equal(5, q.asked);
  assert_true(dyd_rect_bits(dyd_stream_rect(q.guest)) >= 512);
  dyd_stream_free(q.guest);
  /* One that is exact from the start is not asked; one that fails ends it. */
  q.guest = stream_of("-5", "0");
  assert_int_equal(DYD_OUTCOME_DECIDED, put(e, &q, &o, NULL));
  dyd_stream_free(q.guest);
  q.guest = stream_of("log(sqrt(2)-sqrt(2))", "0");
  q.asked = 0;
  assert_int_equal(DYD_OUTCOME_ERROR, put(e, &q, &o, NULL));
  assert_int_equal(0, q.asked);
  dyd_stream_free(q.guest);
  /* Calls of guests count for the budget. */
  for (o.max_calls = 1; o.max_calls <= 2; o.max_calls++) {
    q.guest = stream_of("sqrt(2)-exp(log(2)/2)", "0");
    assert_int_equal(DYD_OUTCOME_BUDGET, put(e, &q, &o, NULL));
    assert_int_equal(o.max_calls, dyd_stream_stage(q.guest));
    assert_int_equal(4, engine_counters(e).calls);
    dyd_stream_free(q.guest);
  }
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_answered),     cmocka_unit_test(test_fixpoint),      cmocka_unit_test(test_bits),
      cmocka_unit_test(test_steps),        cmocka_unit_test(test_finest_counts), cmocka_unit_test(test_calls),
      cmocka_unit_test(test_seconds),      cmocka_unit_test(test_cancel),        cmocka_unit_test(test_cancel_inside),
      cmocka_unit_test(test_no_such_site), cmocka_unit_test(test_errors),        cmocka_unit_test(test_entering),
      cmocka_unit_test(test_guests),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
