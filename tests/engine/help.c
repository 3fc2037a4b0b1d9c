/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Engines for tests: points by expressions, recording of statuses, sources that misbehave on demand. */
#include "engine/help.h"

#include <string.h>

dyd_engine *engine_new(void) {
  dyd_engine *e = NULL;
  assert_int_equal(DYD_OK, dyd_engine_new(&e));
  return e;
}

static dyd_real *real_of(const char *text) {
  dyd_real *x = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = dyd_real_parse(&x, text, strlen(text), &err);
  if (st != DYD_OK) fail_msg("%s: %s", text, err.message);
  return x;
}

void engine_add_text(dyd_engine *e, const char *x, const char *y) {
  dyd_stream *s = NULL;
  dyd_real *a = real_of(x), *b = real_of(y);
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, a, b));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
}

/* ---- callbacks known only by their answers ---- */

static dyd_status narrow_hidden(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_status st = dyd_real_narrow(user, request->bits, request->max_bits, err);
  if (st >= 0) dyd_interval_set(out, dyd_real_interval(user));
  return st;
}

static void release_hidden(void *user) {
  dyd_real_free(user);
}

static dyd_real *hidden_real(const char *text) {
  dyd_real *x = real_of(text), *hidden = NULL;
  if (dyd_real_is_final(x)) return x;
  assert_int_equal(DYD_OK, dyd_real_new(&hidden, narrow_hidden, release_hidden, x));
  return hidden;
}

void engine_add_hidden(dyd_engine *e, const char *x, const char *y) {
  dyd_stream *s = NULL;
  dyd_real *a = hidden_real(x), *b = hidden_real(y);
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, a, b));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
}

void engine_add_polygon(dyd_engine *e, int n, const int *weight, int bits) {
  for (int k = 0; k < n; k++) {
    char x[200], y[200], radius[80] = "1";
    if (weight) snprintf(radius, sizeof radius, "(1+%d*2^(-%d))", weight[k], bits);
    snprintf(x, sizeof x, "%s*cos(2*pi*%d/%d)", radius, k, n);
    snprintf(y, sizeof y, "%s*sin(2*pi*%d/%d)", radius, k, n);
    engine_add_hidden(e, x, y);
  }
}

void engine_add_roots(dyd_engine *e, test_random *r, size_t n) {
  for (size_t k = 0; k < n; k++) {
    char text[2][80];
    for (int a = 0; a < 2; a++) {
      unsigned long u = (unsigned long)test_between(r, 2, 100000), v = (unsigned long)test_between(r, 20, 40);
      snprintf(text[a], sizeof *text, "sqrt(%lu)/%lu", u, v);
    }
    engine_add_text(e, text[0], text[1]);
  }
}

void engine_run(dyd_engine *e, const dyd_engine_options *o, dyd_outcome want) {
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = dyd_engine_run(&outcome, e, o, &err);
  if (outcome != want) {
    fail_msg("outcome %s instead of %s: %s", dyd_outcome_text(outcome), dyd_outcome_text(want), err.message);
  }
  assert_int_equal(want == DYD_OUTCOME_ERROR, st < 0);
  assert_int_equal(outcome, dyd_engine_outcome(e));
}

void engine_count(size_t count[4], const dyd_engine *e) {
  dyd_delaunay_count(count, dyd_engine_delaunay(e));
}

dyd_engine_counters engine_counters(const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  return c;
}

static int rank(dyd_pair_status s) {
  return s == DYD_TIE ? DYD_INDETERMINATE : s;
}

void assert_same_statuses(const dyd_engine *e, const dyd_engine *f) {
  uint32_t n = (uint32_t)dyd_engine_count(e);
  assert_int_equal(n, dyd_engine_count(f));
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < i; j++) {
      assert_int_equal(rank(dyd_delaunay_status(dyd_engine_delaunay(e), i, j)),
                       rank(dyd_delaunay_status(dyd_engine_delaunay(f), i, j)));
    }
}

void monotone_init(monotone *m, const dyd_engine *e) {
  *m = (monotone){.e = e, .n = dyd_engine_count(e)};
  m->last = malloc(m->n * m->n + 1);
  assert_non_null(m->last);
  memset(m->last, DYD_INDETERMINATE, m->n * m->n);
}

void monotone_clear(monotone *m) {
  free(m->last);
}

void monotone_look(monotone *m) {
  for (uint32_t i = 0; i < m->n; i++)
    for (uint32_t j = 0; j < i; j++) {
      int now = rank(dyd_delaunay_status(dyd_engine_delaunay(m->e), i, j));
      unsigned char *last = &m->last[i * m->n + j];
      if (*last != DYD_INDETERMINATE) assert_int_equal(*last, now);
      *last = (unsigned char)now;
    }
}

void monotone_progress(void *user, const dyd_progress *p) {
  monotone *m = user;
  size_t count[4];
  assert_int_equal(m->n, p->sites);
  engine_count(count, m->e);
  assert_memory_equal(count, p->count, sizeof count);
  assert_true(p->stage > m->stage);
  assert_true(p->seconds >= 0);
  m->stage = p->stage;
  m->bits = p->bits;
  m->stages++;
  monotone_look(m);
}

/* ---- sources ---- */

/* [v - 2^-bits, v + 2^-bits] for v = num/7, outward by up to 2^-(bits+2) more; nested because bits grow by more than 1.
 */
static void around(dyd_interval *out, long num, int64_t bits) {
  mpq_t lo, hi, w;
  mpq_inits(lo, hi, w, NULL);
  mpq_set_ui(w, 1, 1);
  mpq_div_2exp(w, w, (mp_bitcnt_t)bits);
  mpq_set_si(lo, num, 7);
  mpq_canonicalize(lo);
  mpq_add(hi, lo, w);
  mpq_sub(lo, lo, w);
  assert_int_equal(DYD_OK, dyd_interval_set_outward(out, lo, hi, -bits - 2));
  mpq_clears(lo, hi, w, NULL);
}

/* An interval of width 2^-bits about, moved by a third of that, to the right for odd bits. */
static void sway(dyd_interval *side, int64_t bits) {
  mpq_t lo, hi, step;
  mpq_inits(lo, hi, step, NULL);
  dyd_interval_get_q(lo, hi, side);
  mpq_set_si(step, bits % 2 ? 3 : -3, 1);
  mpq_div_2exp(step, step, (mp_bitcnt_t)bits + 4);
  mpq_add(lo, lo, step);
  mpq_add(hi, hi, step);
  assert_int_equal(DYD_OK, dyd_interval_set_ends_q(side, lo, hi));
  mpq_clears(lo, hi, step, NULL);
}

static dyd_status misbehave(dyd_rect *out, const faulty *f, const dyd_request *q, dyd_error *err) {
  long k = (long)q->point;
  switch (f->kind) {
  case FAULT_WIDEN:
    around(&out->x, k * k, 1);
    return DYD_OK;
  case FAULT_DRIFT:
    around(&out->x, k * k + 1, q->bits + 2);
    return DYD_OK;
  case FAULT_SWAY: /* to the left and to the right, by a third of the width: not nested only from one bit to the next */
    around(&out->x, k * k, q->bits + 2); /* half a width of 2^-bits */
    around(&out->y, k * k * k, q->bits + 2);
    sway(&out->x, q->bits);
    return DYD_OK;
  case FAULT_FAIL:
    err->code = DYD_E_STREAM;
    snprintf(err->message, sizeof err->message, "the sensor is on fire");
    return DYD_E_STREAM;
  case FAULT_JUNK:
    dyd_dyadic_set_d(&out->x.lo, 2);
    dyd_dyadic_set_d(&out->x.hi, 1);
    around(&out->y, k, q->bits + 2);
    return DYD_OK;
  case FAULT_SILENT:
    return DYD_OK;
  case FAULT_HALF:
    around(&out->x, k * k, q->bits + 2);
    return DYD_OK;
  case FAULT_UNKNOWN:
    return (dyd_status)77;
  default:
    return DYD_OK;
  }
}

static dyd_status faulty_narrow(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  faulty *f = user;
  f->calls++;
  if (f->cancel && f->calls == f->cancel_at) dyd_engine_cancel(f->cancel);
  if (f->kind != FAULT_NONE && q->point == f->point && f->seen++ >= f->stage) return misbehave(out, f, q, err);
  long k = (long)q->point;
  around(&out->x, k * k, q->bits + 2);
  around(&out->y, k * k * k, q->bits + 2);
  return DYD_OK;
}

static void faulty_release(void *user) {
  ((faulty *)user)->released++;
}

dyd_source faulty_source(faulty *f) {
  return (dyd_source){DYD_SIZED(dyd_source), .narrow = faulty_narrow, .release = faulty_release, .user = f};
}
