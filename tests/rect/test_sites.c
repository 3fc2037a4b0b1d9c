/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of sites against a plain list of exact rectangles: values put in come out, whatever doubles hold of it. */
#include <setjmp.h>
#include <stdarg.h>

#include "rect/literal.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include <cmocka.h>
#include <dyadel/sites.h>
#include <float.h>
#include <math.h>

enum { MOST = 48 };

/* A table and its expected contents. */
typedef struct pairing {
  dyd_sites *s;
  dyd_rect want[MOST];
  size_t n;
} pairing;

static void start(pairing *p) {
  *p = (pairing){0};
  assert_int_equal(dyd_sites_new(&p->s), DYD_OK);
  for (size_t i = 0; i < MOST; i++) dyd_rect_init(&p->want[i]);
}

static void finish(pairing *p) {
  for (size_t i = 0; i < MOST; i++) dyd_rect_clear(&p->want[i]);
  dyd_sites_free(p->s);
}

/* lo, hi are the doubles next to the ends of a, on the outer side. */
static void outward_and_tight(double lo, double hi, const dyd_interval *a) {
  mpq_t q[2], d;
  mpq_inits(q[0], q[1], d, NULL);
  dyd_interval_get_q(q[0], q[1], a);
  const double end[2] = {lo, hi};
  for (int k = 0; k < 2; k++) {
    int side = k ? 1 : -1;
    assert_false(isnan(end[k]) || (end[k] == 0 && signbit(end[k])));
    if (isfinite(end[k])) {
      mpq_set_d(d, end[k]);
      assert_true(side * mpq_cmp(d, q[k]) >= 0);
    } else
      assert_int_equal(end[k] > 0, side > 0);
    double inner = nextafter(end[k], side > 0 ? -INFINITY : INFINITY);
    if (!isfinite(inner)) continue;
    mpq_set_d(d, inner);
    assert_true(side * mpq_cmp(d, q[k]) < 0);
  }
  mpq_clears(q[0], q[1], d, NULL);
}

static void agree(const pairing *p) {
  dyd_rect r;
  double e[4];
  dyd_rect_init(&r);
  assert_int_equal(dyd_sites_count(p->s), p->n);
  for (size_t i = 0; i < p->n; i++) {
    assert_int_equal(dyd_sites_get(&r, p->s, i), DYD_OK);
    assert_true(dyd_rect_equal(&r, &p->want[i]));
    assert_int_equal(dyd_sites_is_point(p->s, i), dyd_rect_is_point(&p->want[i]));
    dyd_sites_get_d(e, p->s, i);
    outward_and_tight(e[0], e[1], &p->want[i].x);
    outward_and_tight(e[2], e[3], &p->want[i].y);
  }
  dyd_rect_clear(&r);
}

/* ---- random rectangles ---- */

static long random_exponent(test_random *r) {
  static const long exps[] = {-5000, -1074, -1060, -1022, -300, -53, 0, 0, 0, 40, 900, 970, 1024, 6000};
  return exps[test_below(r, sizeof exps / sizeof *exps)] + (long)test_between(r, -3, 3);
}

static void random_q(mpq_t q, test_random *r) {
  static const unsigned long dens[] = {1, 2, 3, 10, 7 * 9, 1000003, 64};
  mpq_set_si(q, (long)test_between(r, -1000, 1000), dens[test_below(r, 7)]);
  mpq_canonicalize(q);
  for (uint64_t k = test_below(r, 4); k; k--) { /* long numerators */
    mpz_mul_2exp(mpq_numref(q), mpq_numref(q), 61);
    mpz_add_ui(mpq_numref(q), mpq_numref(q), 1 + test_below(r, 1000));
    mpq_canonicalize(q);
  }
  long e = random_exponent(r);
  if (e > 0)
    mpq_mul_2exp(q, q, (mp_bitcnt_t)e);
  else
    mpq_div_2exp(q, q, (mp_bitcnt_t)-e);
}

static void random_dyadic(dyd_dyadic *out, test_random *r) {
  mpz_t man;
  mpz_init_set_si(man, (long)test_between(r, -9, 9));
  for (uint64_t k = test_below(r, 4); k; k--) {
    mpz_mul_2exp(man, man, 40);
    mpz_add_ui(man, man, test_below(r, 1u << 20));
  }
  assert_int_equal(dyd_dyadic_set_z_2exp(out, man, random_exponent(r)), DYD_OK);
  mpz_clear(man);
}

static void random_side(dyd_interval *out, test_random *r) {
  dyd_dyadic a, b;
  mpq_t q;
  dyd_dyadic_init(&a);
  dyd_dyadic_init(&b);
  mpq_init(q);
  if (test_chance(r, 3)) {
    random_q(q, r);
    assert_int_equal(dyd_interval_set_q(out, q), DYD_OK);
  } else if (test_chance(r, 2)) {
    double x = ldexp(test_unit(r) - 0.5, (int)test_between(r, -1080, 1020)), y = ldexp(test_unit(r), -1070);
    assert_int_equal(dyd_interval_set_d(out, x, x + y), DYD_OK);
  } else {
    random_dyadic(&a, r);
    random_dyadic(&b, r);
    if (dyd_dyadic_cmp(&a, &b) > 0) dyd_dyadic_swap(&a, &b);
    if (test_chance(r, 4)) dyd_dyadic_set(&b, &a);
    assert_int_equal(dyd_interval_set_ends(out, &a, &b), DYD_OK);
  }
  mpq_clear(q);
  dyd_dyadic_clear(&b);
  dyd_dyadic_clear(&a);
}

static void add_one(pairing *p, test_random *r) {
  dyd_rect *w = &p->want[p->n];
  if (test_chance(r, 3)) {
    double x = ldexp(test_unit(r), 40), y = -ldexp(test_unit(r), -1040), x1 = x + 1, y1 = 0;
    bool box = test_chance(r, 2);
    assert_int_equal(dyd_rect_set_d(w, x, box ? x1 : x, y, box ? y1 : y), DYD_OK);
    dyd_status st = box ? dyd_sites_add_boxes(p->s, 1, &x, &x1, &y, &y1) : dyd_sites_add_points(p->s, 1, &x, &y);
    assert_int_equal(st, DYD_OK);
  } else {
    random_side(&w->x, r);
    random_side(&w->y, r);
    assert_int_equal(dyd_sites_add_rect(p->s, w), DYD_OK);
  }
  p->n++;
}

/* man * 2^exp / den in lowest terms, man and den of up to one word, often next to a double or a power of two. */
static void random_words(dyd_words *w, dyd_interval *want, test_random *r) {
  mpq_t q;
  mpq_init(q);
  uint64_t man = test_below(r, UINT64_MAX) >> 1 >> test_below(r, 63), den = 1;
  if (test_chance(r, 3)) man = (((uint64_t)1 << 53) - 2 + test_below(r, 4)) << test_below(r, 10);
  for (uint64_t k = test_below(r, 28); k; k--) den *= 5;
  if (test_chance(r, 4)) den = test_below(r, UINT64_MAX) >> test_below(r, 63) | 1;
  if (test_chance(r, 20)) man = 0;
  mpz_set_ui(mpq_numref(q), man);
  mpz_set_ui(mpq_denref(q), den);
  mpq_canonicalize(q);
  mp_bitcnt_t twos = man ? mpz_scan1(mpq_numref(q), 0) : 0;
  mpz_tdiv_q_2exp(mpq_numref(q), mpq_numref(q), twos);
  int sign = test_chance(r, 2) ? 1 : -1, exp = man ? (int)test_between(r, -200, 200) : 0;
  *w = (dyd_words){sign * (int64_t)mpz_get_ui(mpq_numref(q)), mpz_get_ui(mpq_denref(q)), exp};
  if (sign < 0) mpq_neg(q, q);
  if (exp > 0)
    mpq_mul_2exp(q, q, (mp_bitcnt_t)exp);
  else
    mpq_div_2exp(q, q, (mp_bitcnt_t)-exp);
  assert_int_equal(dyd_interval_set_q(want, q), DYD_OK);
  mpq_clear(q);
}

static void expect_words(const dyd_sites *s, size_t i, const dyd_words xy[2]) {
  dyd_words end[4];
  assert_true(dyd_sites_get_words(end, s, i));
  for (int k = 0; k < 4; k++) {
    const dyd_words *w = &xy[k / 2];
    assert_true(end[k].man == w->man && end[k].den == w->den && end[k].exp == w->exp);
  }
}

/* It may be narrowed to itself, and to nothing else. */
static void expect_point_stays(dyd_sites *s, size_t i, dyd_rect *want) {
  dyd_rect other;
  dyd_rect_init(&other);
  assert_int_equal(dyd_rect_set_d(&other, 0.75, 0.75, 1, 1), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, i, want), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, i, &other), dyd_rect_equal(want, &other) ? DYD_OK : DYD_E_NESTING);
  dyd_rect_clear(&other);
}

static void test_words(void **state) {
  (void)state;
  test_random r = test_random_start("words");
  for (size_t k = test_cases(1000); k; k--) {
    pairing p;
    dyd_words xy[2 * MOST];
    start(&p);
    while (p.n < MOST) {
      size_t n = (size_t)test_below(&r, MOST - p.n) + 1, first = p.n;
      if (test_chance(&r, 4)) add_one(&p, &r), n = 0;
      for (size_t i = 0; i < n; i++) {
        random_words(&xy[2 * i], &p.want[p.n + i].x, &r);
        random_words(&xy[2 * i + 1], &p.want[p.n + i].y, &r);
      }
      assert_int_equal(dyd_sites_add_words(p.s, n, xy), DYD_OK);
      p.n += n;
      for (size_t i = 0; i < n; i++) expect_words(p.s, first + i, xy + 2 * i);
      if (n) expect_point_stays(p.s, first, &p.want[first]);
    }
    agree(&p);
    finish(&p);
  }
}

/* Rectangles in words are what their corners say, and may be narrowed. */
static void test_word_boxes(void **state) {
  (void)state;
  test_random r = test_random_start("word boxes");
  dyd_rect corner[2], got;
  dyd_rect_init(&corner[0]), dyd_rect_init(&corner[1]), dyd_rect_init(&got);
  mpq_t end[4];
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  for (size_t k = test_cases(1000); k; k--) {
    dyd_sites *s;
    dyd_words words[4], back[4];
    for (int a = 0; a < 2; a++) {
      for (int c = 0; c < 2; c++) random_words(&words[2 * c + a], a ? &corner[c].y : &corner[c].x, &r);
      for (int c = 0; c < 2; c++) dyd_interval_get_q(end[2 * a + c], end[2 * a + c], a ? &corner[c].y : &corner[c].x);
      if (mpq_cmp(end[2 * a], end[2 * a + 1]) <= 0) continue;
      mpq_swap(end[2 * a], end[2 * a + 1]);
      dyd_words t = words[a];
      words[a] = words[2 + a], words[2 + a] = t;
    }
    assert_int_equal(dyd_sites_new(&s), DYD_OK);
    assert_int_equal(dyd_sites_add_word_boxes(s, 1, words), DYD_OK);
    assert_int_equal(dyd_sites_get(&got, s, 0), DYD_OK);
    assert_true(dyd_interval_is_valid(&got.x) && dyd_interval_is_valid(&got.y));
    assert_int_equal(dyd_sites_is_point(s, 0), mpq_equal(end[0], end[1]) && mpq_equal(end[2], end[3]));
    for (int a = 0; a < 2; a++) {
      mpq_t lo, hi;
      mpq_inits(lo, hi, NULL);
      dyd_interval_get_q(lo, hi, a ? &got.y : &got.x);
      assert_true(mpq_equal(lo, end[2 * a]) && mpq_equal(hi, end[2 * a + 1]));
      mpq_set_d(lo, dyd_sites_lo(s, a, 0));
      mpq_set_d(hi, dyd_sites_hi(s, a, 0));
      assert_true(mpq_cmp(lo, end[2 * a]) <= 0 && mpq_cmp(hi, end[2 * a + 1]) >= 0);
      mpq_clears(lo, hi, NULL);
    }
    if (dyd_sites_get_words(back, s, 0))
      for (int e = 0; e < 4; e++) assert_memory_equal(&back[e].man, &words[e % 2 * 2 + e / 2].man, sizeof back[e].man);
    dyd_interval_set_over(&got.x, &got.x.hi, got.x.den);
    assert_int_equal(dyd_sites_narrow(s, 0, &got), DYD_OK);
    dyd_rect_swap(&got, &corner[0]);
    assert_int_equal(dyd_sites_get(&got, s, 0), DYD_OK);
    assert_true(dyd_rect_equal(&got, &corner[0]));
    dyd_sites_free(s);
  }
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  dyd_rect_clear(&got), dyd_rect_clear(&corner[1]), dyd_rect_clear(&corner[0]);
}

/* Both ends move inward by eighths, or to a rational point inside. */
static void shrink_side(dyd_interval *a, test_random *r) {
  mpq_t lo, hi, d;
  if (dyd_interval_is_point(a)) return;
  mpq_inits(lo, hi, d, NULL);
  dyd_interval_get_q(lo, hi, a);
  mpq_sub(d, hi, lo);
  mpq_div_2exp(d, d, 3);
  if (test_chance(r, 4)) {
    mpq_set_ui(hi, test_below(r, 25), 3);
    mpq_canonicalize(hi);
    if (mpq_cmp_ui(hi, 8, 1) > 0) mpq_set_ui(hi, 8, 1);
    mpq_mul(d, d, hi);
    mpq_add(lo, lo, d);
    assert_int_equal(dyd_interval_set_q(a, lo), DYD_OK);
  } else {
    dyd_dyadic x, y, e;
    dyd_dyadic_init(&x);
    dyd_dyadic_init(&y);
    dyd_dyadic_init(&e);
    long up = (long)test_below(r, 5), down = (long)test_below(r, 5);
    assert_int_equal(dyd_dyadic_sub(&e, &a->hi, &a->lo), DYD_OK);
    assert_int_equal(dyd_dyadic_mul_2exp(&e, &e, -3), DYD_OK);
    assert_int_equal(dyd_dyadic_set_si_2exp(&x, up, 0), DYD_OK);
    assert_int_equal(dyd_dyadic_mul(&x, &x, &e), DYD_OK);
    assert_int_equal(dyd_dyadic_add(&x, &x, &a->lo), DYD_OK);
    assert_int_equal(dyd_dyadic_set_si_2exp(&y, down, 0), DYD_OK);
    assert_int_equal(dyd_dyadic_mul(&y, &y, &e), DYD_OK);
    assert_int_equal(dyd_dyadic_sub(&y, &a->hi, &y), DYD_OK);
    assert_int_equal(dyd_interval_set_ends(a, &x, &y), DYD_OK);
    dyd_dyadic_clear(&e);
    dyd_dyadic_clear(&y);
    dyd_dyadic_clear(&x);
  }
  mpq_clears(lo, hi, d, NULL);
}

/* A rectangle that is not inside, often only by far less than the doubles show. */
static void refuse_one(pairing *p, test_random *r, size_t i) {
  dyd_rect bad;
  dyd_dyadic tiny;
  dyd_rect_init(&bad);
  dyd_dyadic_init(&tiny);
  dyd_rect_set(&bad, &p->want[i]);
  dyd_interval *side = test_chance(r, 2) ? &bad.x : &bad.y;
  mpz_set_ui(side->den, 1); /* lo/1 .. lo/1 of a rational point is another point */
  bool was_rational = !dyd_rect_equal(&bad, &p->want[i]);
  assert_int_equal(dyd_dyadic_set_si_2exp(&tiny, 1, test_chance(r, 2) ? -9000 : -60), DYD_OK);
  if (!was_rational && test_chance(r, 2))
    assert_int_equal(dyd_dyadic_sub(&side->lo, &side->lo, &tiny), DYD_OK);
  else if (!was_rational)
    assert_int_equal(dyd_dyadic_add(&side->hi, &side->hi, &tiny), DYD_OK);
  bool zero = was_rational && dyd_dyadic_sgn(&side->lo) == 0;
  if (!zero) assert_int_equal(dyd_sites_narrow(p->s, i, &bad), DYD_E_NESTING);
  dyd_dyadic_clear(&tiny);
  dyd_rect_clear(&bad);
}

static void test_random_tables(void **state) {
  (void)state;
  test_random r = test_random_start("sites");
  for (size_t k = test_cases(400); k; k--) {
    pairing p;
    start(&p);
    while (p.n < MOST) {
      add_one(&p, &r);
      size_t i = (size_t)test_below(&r, p.n);
      if (test_chance(&r, 3)) refuse_one(&p, &r, i);
      if (test_chance(&r, 2)) continue;
      shrink_side(&p.want[i].x, &r);
      shrink_side(&p.want[i].y, &r);
      assert_int_equal(dyd_sites_narrow(p.s, i, &p.want[i]), DYD_OK);
    }
    agree(&p);
    finish(&p);
  }
}

/* ---- bulk ---- */

static void test_bulk_mixed(void **state) {
  (void)state;
  pairing p;
  start(&p);
  double x[3] = {1, 2, -0.0}, y[3] = {DBL_MAX, -0x1p-1074, 0}, x1[3] = {1, 3, 0}, y1[3] = {DBL_MAX, 5, 7};
  assert_int_equal(dyd_sites_add_points(p.s, 3, x, y), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(p.s, 0, NULL, NULL, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_sites_add_points(p.s, 0, NULL, NULL), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(p.s, 3, x, x1, y, y1), DYD_OK);
  assert_int_equal(dyd_sites_add_points(p.s, 3, x1, y1), DYD_OK);
  for (size_t k = 0; k < 3; k++) {
    assert_int_equal(dyd_rect_set_d(&p.want[k], x[k], x[k], y[k], y[k]), DYD_OK);
    assert_int_equal(dyd_rect_set_d(&p.want[3 + k], x[k], x1[k], y[k], y1[k]), DYD_OK);
    assert_int_equal(dyd_rect_set_d(&p.want[6 + k], x1[k], x1[k], y1[k], y1[k]), DYD_OK);
  }
  p.n = 9;
  agree(&p);
  x[0] = 99; /* copied, not borrowed */
  agree(&p);
  finish(&p);
}

/* Errors in the middle or at the end of a bulk: nothing is appended. */
static void test_bad_doubles(void **state) {
  (void)state;
  const double bad[3] = {NAN, INFINITY, -INFINITY};
  pairing p;
  start(&p);
  double lo[2][3] = {{0, 1, 2}, {0, 1, 2}}, hi[2][3] = {{1, 2, 3}, {1, 2, 3}};
  assert_int_equal(dyd_sites_add_points(p.s, 1, lo[0], lo[1]), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&p.want[0], 0, 0, 0, 0), DYD_OK);
  p.n = 1;
  for (int place = 0; place < 3; place++)
    for (int side = 0; side < 4; side++)
      for (int b = 0; b < 4; b++) {
        double *at = side < 2 ? &lo[side][place] : &hi[side - 2][place], keep = *at;
        *at = b < 3 ? bad[b] : side < 2 ? nextafter(hi[side][place], 9) : nextafter(lo[side - 2][place], -9);
        assert_int_equal(dyd_sites_add_boxes(p.s, 3, lo[0], hi[0], lo[1], hi[1]), DYD_E_ARG);
        if (b < 3 && side < 2) assert_int_equal(dyd_sites_add_points(p.s, 3, lo[0], lo[1]), DYD_E_ARG);
        *at = keep;
        agree(&p);
      }
  finish(&p);
}

/* -0.0 is 0: the bits are equal, too. */
static void test_negative_zero(void **state) {
  (void)state;
  pairing p;
  start(&p);
  double m = -0.0, one = 1, e[4];
  assert_int_equal(dyd_sites_add_points(p.s, 1, &m, &m), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(p.s, 1, &m, &one, &m, &m), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&p.want[0], 0, 0, 0, 0), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&p.want[1], 0, 1, 0, 0), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&p.want[2], -0.0, 0.0, -0.0, -0.0), DYD_OK);
  assert_int_equal(dyd_sites_add_rect(p.s, &p.want[2]), DYD_OK);
  assert_int_equal(dyd_sites_narrow(p.s, 1, &p.want[2]), DYD_OK);
  dyd_rect_set(&p.want[1], &p.want[2]);
  p.n = 3;
  agree(&p);
  for (size_t i = 0; i < 3; i++) {
    dyd_sites_get_d(e, p.s, i);
    for (int k = 0; k < 4; k++) assert_false(signbit(e[k]));
    assert_true(dyd_sites_is_point(p.s, i));
  }
  finish(&p);
}

static void test_numbers_out_of_range(void **state) {
  (void)state;
  pairing p;
  start(&p);
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_sites_get(&r, p.s, 0), DYD_E_ARG);
  assert_int_equal(dyd_sites_narrow(p.s, 0, &r), DYD_E_ARG);
  assert_int_equal(dyd_sites_add_rect(p.s, &r), DYD_OK);
  assert_int_equal(dyd_sites_get(&r, p.s, 1), DYD_E_ARG);
  assert_int_equal(dyd_sites_narrow(p.s, 1, &r), DYD_E_ARG);
  p.n = 1;
  agree(&p);
  dyd_rect_clear(&r);
  finish(&p);
  dyd_sites_free(NULL);
}

/* What doubles cannot hold costs memory, and gives it back when it is narrowed to values they hold. */
static void test_memory(void **state) {
  (void)state;
  pairing p;
  start(&p);
  size_t empty = dyd_sites_memory(p.s);
  double zero = 0, one = 1;
  assert_int_equal(dyd_sites_add_points(p.s, 1, &zero, &zero), DYD_OK);
  size_t point = dyd_sites_memory(p.s);
  assert_int_equal(dyd_sites_add_boxes(p.s, 1, &zero, &one, &zero, &one), DYD_OK);
  size_t boxes = dyd_sites_memory(p.s);
  assert_true(empty < point && point < boxes);
  dyd_rect *w = &p.want[0];
  assert_int_equal(dyd_dyadic_set_si_2exp(&w->x.hi, 1, 0), DYD_OK);
  assert_int_equal(dyd_dyadic_set_si_2exp(&w->y.hi, 1, -2000), DYD_OK);
  assert_int_equal(dyd_sites_narrow(p.s, 1, w), DYD_OK);
  size_t exact = dyd_sites_memory(p.s);
  assert_true(exact > boxes);
  assert_int_equal(dyd_dyadic_set_si_2exp(&w->y.hi, 0, 0), DYD_OK);
  assert_int_equal(dyd_sites_narrow(p.s, 1, w), DYD_OK);
  size_t again = dyd_sites_memory(p.s);
  assert_true(again < exact && again >= boxes);
  assert_int_equal(dyd_sites_narrow(p.s, 1, w), DYD_OK);
  assert_int_equal(dyd_sites_memory(p.s), again);
  finish(&p);
}

/* Unbounded sites contain the whole plane, are not points, and shrink to doubles or to numbers doubles do not hold,
 * whatever their neighbours in the table. */
static void check_planes(bool exact_beside) {
  pairing p;
  start(&p);
  const double box[4] = {-0.5, 1e300, 0, 0x1p-1074}, inside[4] = {-0.5, 0.25, 0, 0},
               *const outside[] = {(const double[]){-0.75, 0, 0, 0}, (const double[]){0, 0, 0, 0x1p-1073}};
  dyd_rect *tiny = &p.want[0], *now = &p.want[1];
  assert_int_equal(dyd_dyadic_set_si_2exp(&tiny->x.hi, 1, -5000), DYD_OK);
  if (exact_beside) assert_int_equal(dyd_sites_add_rect(p.s, tiny), DYD_OK);
  size_t first = dyd_sites_count(p.s);
  assert_int_equal(dyd_sites_add_planes(p.s, 3, DYD_SITE_BARE), DYD_OK);
  assert_int_equal(dyd_sites_count(p.s), first + 3);
  for (size_t i = first; i < first + 3; i++) {
    assert_false(dyd_sites_is_point(p.s, i));
    assert_int_equal(dyd_sites_get(now, p.s, i), DYD_OK);
    assert_true(dyd_rect_contains(now, tiny) && dyd_rect_bits(now) < -1000000);
  }
  assert_int_equal(dyd_sites_narrow_d(p.s, first, box), DYD_OK);
  for (int k = 0; k < 2; k++) assert_int_equal(dyd_sites_narrow_d(p.s, first, outside[k]), DYD_E_NESTING);
  assert_int_equal(dyd_sites_get(now, p.s, first), DYD_OK);
  assert_int_equal(dyd_rect_set_d(&p.want[2], box[0], box[1], box[2], box[3]), DYD_OK);
  assert_true(dyd_rect_equal(now, &p.want[2]));
  assert_int_equal(dyd_sites_narrow_d(p.s, first, inside), DYD_OK);
  assert_int_equal(dyd_sites_narrow_d(p.s, first, box), DYD_E_NESTING);
  assert_int_equal(dyd_sites_narrow(p.s, first + 1, tiny), DYD_OK);
  /* Now an exact rectangle is there; doubles around it, and inside of it. */
  assert_int_equal(dyd_sites_narrow_d(p.s, first + 1, inside), DYD_E_NESTING);
  assert_int_equal(dyd_sites_narrow_d(p.s, first + 1, (const double[]){0, 0, 0, 0}), DYD_OK);
  assert_true(dyd_sites_is_point(p.s, first + 1));
  assert_int_equal(dyd_sites_get(now, p.s, first + 2), DYD_OK);
  assert_true(dyd_rect_bits(now) < -1000000);
  assert_int_equal(dyd_sites_narrow_d(p.s, first + 3, inside), DYD_E_ARG);
  finish(&p);
}

static void test_planes(void **state) {
  (void)state;
  check_planes(false);
  check_planes(true);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_tables), cmocka_unit_test(test_bulk_mixed),
                                     cmocka_unit_test(test_words),         cmocka_unit_test(test_word_boxes),
                                     cmocka_unit_test(test_bad_doubles),   cmocka_unit_test(test_negative_zero),
                                     cmocka_unit_test(test_memory),        cmocka_unit_test(test_numbers_out_of_range),
                                     cmocka_unit_test(test_planes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
