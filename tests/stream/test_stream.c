/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams: faulty callbacks are caught [NEST-1] and nothing is lost, contexts are released once on every path,
 * pairs, widened reals and affine images [AFF-1] hold the true points. */
#include "harness.h"

#include "rect/rect.h"
#include "stream/real.h"
#include "stream/stream.h"

/* ---- a source with planted faults: rectangles around (1/3, -1/7) ---- */

typedef enum fault { NONE, WIDENS, DRIFTS, FAILS, FAILS_SILENTLY, FIXED, UNKNOWN, INVALID, SLOW, SILENT } fault;

typedef struct faulty {
  fault fault;
  int64_t at; /* the fault shows from this call on */
  int64_t calls, released;
  size_t point;
  bool init_seen;
} faulty;

static void enclose(dyd_rect *out, int64_t exp, long drift) {
  mpq_t q, unit;
  mpq_inits(q, unit, NULL);
  mpq_set_ui(unit, 1, 1);
  if (exp < 0) {
    mpq_div_2exp(unit, unit, (mp_bitcnt_t)-exp);
  } else {
    mpq_mul_2exp(unit, unit, (mp_bitcnt_t)exp);
  }
  mpq_set_si(q, 1, 3);
  assert_int_equal(dyd_interval_set_outward(&out->x, q, q, exp), DYD_OK);
  mpq_set_si(q, -1, 7);
  assert_int_equal(dyd_interval_set_outward(&out->y, q, q, exp), DYD_OK);
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_interval_get_q(lo, hi, &out->y);
  for (; drift > 0; drift--) mpq_add(lo, lo, unit), mpq_add(hi, hi, unit);
  assert_int_equal(dyd_interval_set_outward(&out->y, lo, hi, exp), DYD_OK);
  mpq_clears(lo, hi, q, unit, NULL);
}

static dyd_status faulty_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  faulty *f = user;
  bool now = f->calls++ == f->at;
  f->point = request->point;
  if (f->calls == 1)
    f->init_seen = dyd_dyadic_cmp(&out->x.lo, &out->x.hi) > 0 && dyd_dyadic_cmp(&out->y.lo, &out->y.hi) > 0;
  assert_true(request->max_bits >= request->bits);
  if (now && f->fault == SILENT) return DYD_OK;
  enclose(out, -request->bits, 0);
  if (!now) return DYD_OK;
  switch (f->fault) {
  case WIDENS:
    enclose(out, -request->bits + 2, 0);
    return DYD_OK;
  case DRIFTS:
    enclose(out, -request->bits, 1);
    return DYD_OK;
  case FAILS:
    snprintf(err->message, sizeof err->message, "the instrument is off");
    return DYD_E_STREAM;
  case FAILS_SILENTLY:
    return DYD_E_IO;
  case FIXED:
    return DYD_FIXED;
  case UNKNOWN:
    return (dyd_status)-77;
  case INVALID:
    mpz_set_si(out->x.lo.man, 1000000);
    return DYD_OK;
  case SLOW:
    enclose(out, -request->bits + 1, 0);
    return DYD_OK;
  default:
    return DYD_OK;
  }
}

static void faulty_release(void *user) {
  ((faulty *)user)->released++;
}

/* Narrows bit by bit up to the call with the fault; the status of that call is returned, *s keeps living. */
static dyd_status run_faulty(dyd_stream **s, faulty *f, dyd_error *err) {
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = faulty_narrow, .release = faulty_release, .user = f};
  assert_int_equal(dyd_stream_new(s, &source, 7, NULL), DYD_OK);
  assert_null(dyd_stream_rect(*s));
  dyd_error_clear(err);
  for (int64_t bits = 0; bits < f->at; bits++) assert_int_equal(dyd_stream_narrow(*s, bits, 100, err), DYD_OK);
  assert_int_equal(dyd_stream_stage(*s), f->at);
  dyd_rect before;
  dyd_rect_init(&before);
  if (f->at) dyd_rect_set(&before, dyd_stream_rect(*s));
  dyd_status st = dyd_stream_narrow(*s, f->at, 100, err);
  if (st < 0 && f->at) assert_true(dyd_rect_equal(&before, dyd_stream_rect(*s)));
  if (st < 0 && !f->at) assert_null(dyd_stream_rect(*s));
  dyd_rect_clear(&before);
  return st;
}

static void check_faulty(fault kind, int64_t at, dyd_status want, const char *words) {
  faulty f = {.fault = kind, .at = at};
  dyd_stream *s = NULL;
  dyd_error err;
  dyd_status st = run_faulty(&s, &f, &err);
  if (st != want) fail_msg("fault %d at %d: status %d (%s)", kind, (int)at, st, err.message);
  assert_true(f.init_seen);
  assert_int_equal(f.point, 7);
  if (st < 0) {
    assert_int_equal(err.code, st);
    assert_int_equal(err.point, 7);
    assert_int_equal(err.stage, at);
    if (!strstr(err.message, words)) fail_msg("'%s' is not in '%s'", words, err.message);
    assert_false(dyd_stream_is_final(s));
    /* the fault was in one call only: the stream continues */
    if (at) assert_int_equal(dyd_stream_narrow(s, at + 1, 100, &err), DYD_OK);
  }
  if (st == DYD_FIXED) {
    assert_true(dyd_stream_is_final(s));
    assert_int_equal(dyd_stream_narrow(s, 90, 100, &err), DYD_FIXED);
    assert_int_equal(f.calls, at + 1);
  }
  assert_int_equal(f.released, 0);
  dyd_stream_ref(s);
  dyd_stream_free(s);
  assert_int_equal(f.released, 0);
  dyd_stream_free(s);
  assert_int_equal(f.released, 1);
}

static void test_faults(void **state) {
  (void)state;
  check_faulty(NONE, 60, DYD_OK, "");
  check_faulty(WIDENS, 5, DYD_E_NESTING, "x side");
  check_faulty(WIDENS, 40, DYD_E_NESTING, "not inside");
  check_faulty(DRIFTS, 40, DYD_E_NESTING, "y side");
  check_faulty(DRIFTS, 61, DYD_E_NESTING, "upper end");
  check_faulty(FAILS, 0, DYD_E_STREAM, "the instrument is off");
  check_faulty(FAILS, 12, DYD_E_STREAM, "the instrument is off");
  check_faulty(FAILS_SILENTLY, 3, DYD_E_IO, "no message");
  check_faulty(UNKNOWN, 3, DYD_E_STREAM, "-77");
  check_faulty(INVALID, 0, DYD_E_STREAM, "valid");
  check_faulty(INVALID, 4, DYD_E_STREAM, "valid");
  check_faulty(SILENT, 0, DYD_E_STREAM, "stage 0 without setting the x side of point 7");
  check_faulty(SILENT, 4, DYD_OK, "");
  check_faulty(FIXED, 0, DYD_FIXED, "");
  check_faulty(FIXED, 9, DYD_FIXED, "");
  check_faulty(SLOW, 4, DYD_OK, "");
}

static void test_arguments(void **state) {
  (void)state;
  faulty f = {.fault = NONE};
  dyd_stream *s = NULL;
  dyd_real *x = NULL;
  dyd_source no_call = {DYD_SIZED(dyd_source), .release = faulty_release, .user = &f};
  assert_int_equal(dyd_stream_new(&s, &no_call, 0, NULL), DYD_E_ARG);
  assert_int_equal(f.released, 1);
  assert_int_equal(dyd_real_new(&x, NULL, faulty_release, &f), DYD_E_ARG);
  assert_int_equal(f.released, 2);
  assert_int_equal(dyd_stream_from_reals(&s, parsed("pi"), NULL), DYD_E_ARG);
  assert_int_equal(dyd_stream_from_reals(&s, NULL, parsed("pi")), DYD_E_ARG);
  mpq_t q;
  mpq_init(q);
  mpq_set_si(q, -1, 2);
  assert_int_equal(dyd_real_widen(&x, parsed("pi"), q), DYD_E_ARG);
  assert_null(s);
  assert_null(x);
  mpq_clear(q);
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = faulty_narrow, .release = faulty_release, .user = &f};
  f = (faulty){.at = -1};
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(dyd_stream_new(&s, &source, 0, NULL), DYD_OK);
  assert_int_equal(dyd_stream_narrow(s, INT64_MAX, INT64_MAX, &err), DYD_E_RANGE);
  assert_int_equal(dyd_stream_narrow(s, INT64_MIN + 1, 0, &err), DYD_OK);
  assert_int_equal(dyd_stream_narrow(s, 10, 10, NULL), DYD_OK);
  dyd_stream_free(s);
  dyd_stream_free(NULL);
  dyd_real_free(NULL);
}

/* ---- a user's real ---- */

static dyd_status third(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  faulty *f = user;
  mpq_t q;
  if (f->fault == SILENT && f->calls++ == f->at) return DYD_OK;
  mpq_init(q);
  mpq_set_si(q, f->calls++ == f->at ? 2 : 1, 3);
  dyd_status st = dyd_interval_set_outward(out, q, q, -request->bits);
  mpq_clear(q);
  (void)err;
  return st;
}

static void test_user_real(void **state) {
  (void)state;
  faulty f = {.at = 2};
  dyd_real *x = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(dyd_real_new(&x, third, faulty_release, &f), DYD_OK);
  assert_null(dyd_real_interval(x));
  assert_int_equal(dyd_real_narrow(x, 10, 10, &err), DYD_OK);
  assert_int_equal(dyd_real_narrow(x, 5, 10, &err), DYD_OK);
  assert_int_equal(f.calls, 1);
  assert_int_equal(dyd_real_narrow(x, 20, 10, &err), DYD_OK);
  assert_int_equal(dyd_real_narrow(x, 30, 30, &err), DYD_E_NESTING);
  assert_int_equal(err.stage, 2);
  assert_int_equal(dyd_interval_bits(dyd_real_interval(x)), 20);
  dyd_stream *s = NULL;
  assert_int_equal(dyd_stream_from_reals(&s, dyd_real_ref(x), x), DYD_OK);
  assert_int_equal(dyd_stream_narrow(s, 40, 40, &err), DYD_OK);
  assert_int_equal(f.released, 0);
  dyd_stream_free(s);
  assert_int_equal(f.released, 1);
  f = (faulty){.fault = SILENT};
  assert_int_equal(dyd_real_new(&x, third, NULL, &f), DYD_OK);
  assert_int_equal(dyd_real_narrow(x, 10, 10, &err), DYD_E_STREAM);
  assert_non_null(strstr(err.message, "stage 0 without setting the interval"));
  assert_null(dyd_real_interval(x));
  dyd_real_free(x);
}

/* ---- widened reals and places ---- */

static void check_widened(const char *text, const char *lo, const char *hi) {
  dyd_real *x = parsed(text);
  mpfr_t l, h;
  mpfr_init2(l, 500);
  mpfr_init2(h, 500);
  mpfr_set_str(l, lo, 10, MPFR_RNDN);
  mpfr_set_str(h, hi, 10, MPFR_RNDN);
  for (int64_t bits = 3; bits < 80; bits += 11) {
    const dyd_interval *a = narrowed(x, bits, 200);
    mpq_t p, q, e;
    mpq_inits(p, q, e, NULL);
    assert_true(holds(a, l, 100) && holds(a, h, 100));
    dyd_interval_get_q(p, q, a);
    mpq_sub(p, q, p);
    mpfr_sub(h, h, l, MPFR_RNDN);
    mpfr_get_q(q, h);
    mpfr_add(h, h, l, MPFR_RNDN);
    mpq_sub(p, p, q);
    mpq_mul_2exp(p, p, (mp_bitcnt_t)bits);
    if (mpq_cmp_ui(p, 1, 1) > 0) fail_msg("%s at %d: excess %g", text, (int)bits, mpq_get_d(p));
    mpq_clears(p, q, e, NULL);
  }
  mpfr_clear(h);
  mpfr_clear(l);
  dyd_real_free(x);
}

static void test_widened(void **state) {
  (void)state;
  check_widened("sqrt(2)+-0.5", "0.91421356237309504880168872420969807857", "1.91421356237309504880168872420969807857");
  check_widened("pi\xC2\xB1"
                "1/4",
                "2.89159265358979323846264338327950288419", "3.39159265358979323846264338327950288419");
  check_widened("root(x^2-2,0,2) +- 2^-20", "1.4142126086987786425516887242096980785696",
                "1.4142145160474114550516887242096980785696");
}

static void test_place(void **state) {
  (void)state;
  dyd_real *x = parsed("1+tan(pi/2)");
  dyd_error err;
  dyd_error_clear(&err);
  dyd_real_place(x, 12, 30);
  assert_int_equal(dyd_real_narrow(x, 10, 100, &err), DYD_E_DOMAIN);
  assert_int_equal(err.line, 12);
  assert_int_equal(err.column, 32);
  dyd_stream *s = NULL;
  assert_int_equal(dyd_stream_from_reals(&s, parsed("sqrt(2)"), x), DYD_OK);
  dyd_error_clear(&err);
  assert_int_equal(dyd_stream_narrow(s, 10, 100, &err), DYD_E_DOMAIN);
  assert_int_equal(err.line, 12);
  assert_int_equal(err.column, 32);
  assert_null(dyd_stream_rect(s));
  dyd_stream_free(s);
}

/* ---- pairs and images ---- */

static dyd_stream *pair_of(const char *x, const char *y) {
  dyd_stream *s = NULL;
  assert_int_equal(dyd_stream_from_reals(&s, parsed(x), parsed(y)), DYD_OK);
  return s;
}

static void test_fixed_streams(void **state) {
  (void)state;
  dyd_stream *s = pair_of("0.1", "[1,2]");
  assert_true(dyd_stream_is_final(s));
  assert_true(is_exactly(&dyd_stream_rect(s)->x, "1/10"));
  dyd_stream *copy = NULL;
  assert_int_equal(dyd_stream_from_rect(&copy, dyd_stream_rect(s)), DYD_OK);
  dyd_stream_free(s);
  assert_true(dyd_stream_is_final(copy));
  assert_int_equal(dyd_stream_narrow(copy, 1000, 1000, NULL), DYD_FIXED);
  assert_int_equal(dyd_stream_stage(copy), 0);
  dyd_stream_free(copy);
}

static void set_matrix(mpq_t m[6], const char *const text[6]) {
  for (int i = 0; i < 6; i++) {
    mpq_init(m[i]);
    mpq_set_str(m[i], text[i], 10);
    mpq_canonicalize(m[i]);
  }
}

/* The image of `of` under text; takes over `of`. */
static dyd_stream *image_of(dyd_stream *of, const char *const text[6]) {
  mpq_t m[6];
  dyd_stream *s = NULL;
  set_matrix(m, text);
  assert_int_equal(dyd_stream_affine(&s, of, (const mpq_t *)m), DYD_OK);
  for (int i = 0; i < 6; i++) mpq_clear(m[i]);
  return s;
}

static void test_affine_exact(void **state) {
  (void)state;
  static const char *const shear[6] = {"1/3", "-2", "1/7", "0", "5", "-1"};
  dyd_stream *s = image_of(image_of(pair_of("0.1", "3"), shear), shear);
  assert_true(dyd_stream_is_final(s));
  /* (1/10,3) -> (1/30-6+1/7, 14) = (-1223/210, 14) -> ... */
  assert_true(is_exactly(&dyd_stream_rect(s)->x, "-18773/630"));
  assert_true(is_exactly(&dyd_stream_rect(s)->y, "69"));
  dyd_stream_free(s);
  static const char *const project[6] = {"0", "0", "1/3", "0", "0", "2"};
  s = image_of(pair_of("pi", "e"), project);
  assert_true(dyd_stream_narrow(s, 10, 10, NULL) >= 0);
  assert_true(is_exactly(&dyd_stream_rect(s)->x, "1/3") && is_exactly(&dyd_stream_rect(s)->y, "2"));
  assert_true(dyd_stream_is_final(s));
  dyd_stream_free(s);
  s = image_of(pair_of("[0,1]", "[0,3]"), shear);
  assert_true(dyd_stream_is_final(s) && !dyd_rect_is_point(dyd_stream_rect(s)));
  dyd_stream_free(s);
}

/* Random rational matrices, applied up to three times, on (sqrt 2, pi): against MPFR at 1000 bits. */
static void check_image(test_random *r) {
  dyd_stream *s = pair_of("sqrt(2)", "pi");
  mpfr_t p[2], t, u[2];
  mpfr_inits2(1000, p[0], p[1], t, u[0], u[1], (mpfr_ptr)0);
  mpfr_sqrt_ui(p[0], 2, MPFR_RNDN);
  mpfr_const_pi(p[1], MPFR_RNDN);
  for (size_t k = 1 + test_below(r, 3); k > 0; k--) {
    mpq_t m[6];
    for (int i = 0; i < 6; i++) {
      mpq_init(m[i]);
      mpq_set_si(m[i], (long)test_between(r, -20, 20), (unsigned long)test_between(r, 1, 30));
      mpq_canonicalize(m[i]);
      if (test_chance(r, 4)) mpq_mul_2exp(m[i], m[i], test_below(r, 60));
      if (test_chance(r, 4)) mpq_div_2exp(m[i], m[i], test_below(r, 60));
    }
    for (int row = 0; row < 2; row++) {
      mpfr_mul_q(u[row], p[0], m[3 * row], MPFR_RNDN);
      mpfr_mul_q(t, p[1], m[3 * row + 1], MPFR_RNDN);
      mpfr_add(u[row], u[row], t, MPFR_RNDN);
      mpfr_add_q(u[row], u[row], m[3 * row + 2], MPFR_RNDN);
    }
    mpfr_swap(p[0], u[0]);
    mpfr_swap(p[1], u[1]);
    dyd_stream *of = s;
    assert_int_equal(dyd_stream_affine(&s, of, (const mpq_t *)m), DYD_OK);
    for (int i = 0; i < 6; i++) mpq_clear(m[i]);
  }
  dyd_rect before;
  dyd_rect_init(&before);
  for (int64_t bits = -5; bits < 200; bits += test_between(r, 1, 90)) {
    assert_true(dyd_stream_narrow(s, bits, 200, NULL) >= 0);
    const dyd_rect *now = dyd_stream_rect(s);
    assert_true(dyd_rect_bits(now) >= bits);
    assert_true(holds(&now->x, p[0], 600) && holds(&now->y, p[1], 600));
    if (bits > -5) assert_true(dyd_rect_contains(&before, now));
    dyd_rect_set(&before, now);
  }
  dyd_rect_clear(&before);
  mpfr_clears(p[0], p[1], t, u[0], u[1], (mpfr_ptr)0);
  dyd_stream_free(s);
}

static void test_affine_random(void **state) {
  (void)state;
  test_random r = test_random_start("affine images");
  for (size_t n = test_cases(2000); n > 0; n--) check_image(&r);
}

/* Long chains neither recurse nor leak; faults below come through with the number of the point. */
static void test_affine_chain(void **state) {
  (void)state;
  static const char *const turn[6] = {"0", "-1", "1", "1", "0", "0"};
  dyd_stream *s = pair_of("sqrt(2)", "pi");
  for (int i = 0; i < 20000; i++) s = image_of(s, turn);
  assert_true(dyd_stream_narrow(s, 100, 100, NULL) >= 0);
  assert_true(dyd_rect_bits(dyd_stream_rect(s)) >= 100);
  dyd_stream_free(s);
  faulty f = {.fault = FAILS, .at = 1};
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = faulty_narrow, .release = faulty_release, .user = &f};
  assert_int_equal(dyd_stream_new(&s, &source, 7, NULL), DYD_OK);
  s = image_of(s, turn);
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(dyd_stream_narrow(s, 10, 100, &err), DYD_OK);
  assert_int_equal(dyd_stream_narrow(s, 20, 100, &err), DYD_E_STREAM);
  assert_int_equal(err.point, 7);
  assert_int_equal(dyd_stream_narrow(s, 20, 100, &err), DYD_OK);
  dyd_stream_free(s);
  assert_int_equal(f.released, 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_faults),       cmocka_unit_test(test_arguments),     cmocka_unit_test(test_user_real),
      cmocka_unit_test(test_widened),      cmocka_unit_test(test_place),         cmocka_unit_test(test_fixed_streams),
      cmocka_unit_test(test_affine_exact), cmocka_unit_test(test_affine_random), cmocka_unit_test(test_affine_chain)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
