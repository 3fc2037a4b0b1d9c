/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The quick decimals of the reader and the directed decimals of the writers, against exact rationals. */
#include "io/decimal.h"
#include "io/read/coordinate.h"
#include "rect/rect.h"
#include "stream/number.h"
#include "support/random.h"
#include <inttypes.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* A decimal of random size; often with few digits, factors of 5, an exponent, odd forms. */
static void random_decimal(char out[64], test_random *r) {
  char *p = out;
  if (test_chance(r, 3)) *p++ = test_chance(r, 4) ? '+' : '-';
  unsigned whole = (unsigned)test_below(r, test_chance(r, 4) ? 20 : 5), part = (unsigned)test_below(r, 12);
  if (whole + part == 0) whole = 1;
  for (unsigned k = 0; k < whole; k++) *p++ = (char)('0' + (test_chance(r, 3) ? 5 : test_below(r, 10)));
  if (part || test_chance(r, 4)) *p++ = '.';
  for (unsigned k = 0; k < part; k++)
    *p++ = (char)('0' + (test_chance(r, 2) ? 5 * test_below(r, 2) : test_below(r, 10)));
  *p = 0;
  if (test_chance(r, 4)) sprintf(p, "%c%d", test_chance(r, 2) ? 'e' : 'E', (int)test_between(r, -30, 30));
}

static void check_plain(const char *text, mpq_t exact, mpq_t other) {
  dyd_plain p;
  if (!dyd_plain_scan(&p, text, strlen(text))) return;
  dyd_plain_get_q(other, p);
  assert_true(mpq_equal(exact, other));
  double value;
  if (dyd_plain_get_exact(&value, p)) {
    mpq_set_d(other, value);
    assert_true(mpq_equal(exact, other));
  } else if (p.man < INT64_C(1) << 50 && p.man > -(INT64_C(1) << 50) && p.exp <= 0) {
    mpq_set_d(other, mpq_get_d(exact));
    assert_false(mpq_equal(exact, other));
  }
  for (int dir = -1; dir <= 1; dir += 2) {
    if (!dyd_plain_get_rounded(&value, p, (dyd_round)dir)) continue;
    mpq_set_d(other, value);
    assert_true(mpq_cmp(other, exact) * dir >= 0);
    mpq_set_d(other, nextafter(value, -INFINITY * dir));
    assert_true(mpq_cmp(other, exact) * dir < 0);
  }
}

/* The words are the number, in lowest terms. */
static bool check_words(dyd_plain p, mpq_t exact, mpq_t other) {
  dyd_words w;
  if (!dyd_plain_get_words(&w, p)) return false;
  mpq_set_si(other, (long)w.man, w.den);
  mpq_canonicalize(other);
  assert_true(mpz_cmp_ui(mpq_denref(other), w.den) == 0);
  assert_true(w.den % 2 == 1 && (w.man ? w.man % 2 != 0 : w.exp == 0 && w.den == 1) && abs(w.exp) <= 200);
  if (w.exp > 0)
    mpq_mul_2exp(other, other, (mp_bitcnt_t)w.exp);
  else
    mpq_div_2exp(other, other, (mp_bitcnt_t)-w.exp);
  assert_true(mpq_equal(exact, other));
  return true;
}

/* Hexadecimal floats of all sizes, few digits and many, zeros around; some do not fit into doubles, some are not
 * numbers. */
static void random_hex(char out[64], test_random *r) {
  char *p = out;
  if (test_chance(r, 2)) *p++ = test_chance(r, 4) ? '+' : '-';
  p += sprintf(p, test_chance(r, 2) ? "0x" : "0X");
  unsigned whole = (unsigned)test_below(r, 4), part = (unsigned)test_below(r, 16);
  for (unsigned k = 0; k < whole + part; k++) {
    if (k == whole) *p++ = '.';
    *p++ = test_chance(r, 3) ? '0' : "0123456789abcdefABCDEF"[test_below(r, 22)];
  }
  *p = 0;
  if (test_chance(r, 4)) return;
  p += sprintf(p, "%c%s%d", test_chance(r, 2) ? 'p' : 'P', test_chance(r, 3) ? "+" : "", (int)test_between(r, -9, 9));
  if (test_chance(r, 3)) sprintf(p, "%02d", (int)test_below(r, 100));
}

/* Returns true if the coordinate is a double that was read without big numbers. */
static bool binary_read(double *out, const char *text) {
  const dyd_manner exact = {0};
  const dyd_span span = {text, strlen(text), text, text, 1};
  dyd_coordinate c;
  if (dyd_coordinate_read(&c, &span, &exact, NULL) != DYD_OK) return false;
  const bool binary = c.kind == DYD_COORDINATE_BINARY;
  *out = c.lo;
  dyd_coordinate_clear(&c);
  return binary;
}

static void test_hex(void **state) {
  (void)state;
  test_random r = test_random_start("hexadecimal");
  mpq_t exact, other;
  mpq_inits(exact, other, NULL);
  size_t quick = 0, cases = test_cases(50000);
  for (size_t k = 0; k < cases; k++) {
    char text[64];
    double value;
    random_hex(text, &r);
    if (test_chance(&r, 2)) sprintf(text, "%a", ldexp(test_unit(&r) - 0.5, (int)test_between(&r, -1100, 800)));
    dyd_status status = dyd_parse_number(exact, text, strlen(text), DYD_NUMBER_ANY, NULL);
    if (!binary_read(&value, text)) continue;
    quick++;
    assert_int_equal(status, DYD_OK);
    mpq_set_d(other, value);
    assert_true(mpq_equal(exact, other));
    assert_false(value == 0 && signbit(value));
  }
  assert_true(quick > cases / 2);
  mpq_clears(exact, other, NULL);
}

static void test_plain(void **state) {
  (void)state;
  test_random r = test_random_start("plain");
  mpq_t exact, other;
  mpq_inits(exact, other, NULL);
  size_t quick = 0, words = 0, cases = test_cases(100000);
  for (size_t k = 0; k < cases; k++) {
    char text[64];
    dyd_plain p;
    random_decimal(text, &r);
    assert_int_equal(dyd_parse_number(exact, text, strlen(text), DYD_NUMBER_ANY, NULL), DYD_OK);
    bool scanned = dyd_plain_scan(&p, text, strlen(text));
    quick += scanned;
    check_plain(text, exact, other);
    words += scanned && check_words(p, exact, other);
  }
  assert_true(quick > cases / 2 && words > cases / 3);
  mpq_clears(exact, other, NULL);
}

static void test_plain_refuses(void **state) {
  (void)state;
  static const char *const bad[] = {"",
                                    ".",
                                    "-",
                                    "e5",
                                    "1e",
                                    "1e+",
                                    "1 ",
                                    " 1",
                                    "1.2.3",
                                    "1/3",
                                    "0x10",
                                    "inf",
                                    "1e5000",
                                    "1e+-05",
                                    "--1",
                                    "1,5",
                                    "1e5.",
                                    "5*2^3",
                                    "1234567890123456789"};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    dyd_plain p;
    assert_false(dyd_plain_scan(&p, bad[k], strlen(bad[k])));
  }
}

static double random_double(test_random *r) {
  double sign = test_chance(r, 2) ? -1 : 1;
  switch (test_below(r, 4)) {
  case 0:
    return sign * test_unit(r);
  case 1:
    return sign * (double)test_below(r, 100000) / 1000;
  case 2:
    return sign * ldexp(test_unit(r), (int)test_between(r, -1074, 1023));
  default:
    return sign * ldexp(1, (int)test_between(r, -1074, 1023));
  }
}

/* Any decimal as a rational; scientific form included. */
static void read_decimal(mpq_t out, const char *text) {
  assert_int_equal(dyd_parse_number(out, text, strlen(text), DYD_NUMBER_ANY, NULL), DYD_OK);
}

/* Infinities have words, as bounds of figures in doubles may be infinite. */
static void test_decimal_infinite(void **state) {
  (void)state;
  char text[DYD_DECIMAL_SIZE];
  for (int digits = 2; digits <= 17; digits += 5) {
    assert_int_equal(dyd_decimal_directed(text, INFINITY, digits, DYD_UP), 3);
    assert_string_equal(text, "inf");
    assert_int_equal(dyd_decimal_directed(text, -INFINITY, digits, DYD_DOWN), 4);
    assert_string_equal(text, "-inf");
  }
}

static void test_directed(void **state) {
  (void)state;
  test_random r = test_random_start("directed");
  mpq_t value, printed;
  mpq_inits(value, printed, NULL);
  for (size_t k = 0; k < test_cases(20000); k++) {
    double x = random_double(&r);
    int digits = (int)test_between(&r, 2, 17), dir = test_chance(&r, 2) ? 1 : -1;
    char text[DYD_DECIMAL_SIZE];
    dyd_decimal_directed(text, x, digits, (dyd_round)dir);
    mpq_set_d(value, x);
    read_decimal(printed, text);
    assert_true(mpq_cmp(printed, value) * dir >= 0);
    assert_true((strtod(text, NULL) - x) * dir >= 0);
    mpq_sub(printed, printed, value);
    assert_true(fabs(mpq_get_d(printed)) <= fabs(x) * pow(10, 1.001 - digits));
  }
  mpq_clears(value, printed, NULL);
}

static void test_within(void **state) {
  (void)state;
  test_random r = test_random_start("within");
  mpq_t end, place, bound;
  mpq_inits(end, place, bound, NULL);
  for (size_t k = 0; k < test_cases(20000); k++) {
    double box[2], error;
    box[0] = random_double(&r);
    box[1] = test_chance(&r, 2) ? box[0] : test_chance(&r, 2) ? nextafter(box[0], INFINITY) : random_double(&r);
    if (box[1] < box[0]) box[1] = box[0];
    char text[DYD_DECIMAL_SIZE];
    dyd_decimal_within(text, &error, box[0], box[1]);
    read_decimal(place, text);
    if (!isfinite(error)) continue;
    mpq_set_d(bound, error);
    for (int e = 0; e < 2; e++) {
      mpq_set_d(end, box[e]);
      mpq_sub(end, end, place);
      mpq_abs(end, end);
      assert_true(mpq_cmp(end, bound) <= 0);
    }
    assert_true(error <= (box[1] - box[0]) + fmax(fabs(box[0]), fabs(box[1])) * 0x1p-50 + 0x1p-1070);
  }
  mpq_clears(end, place, bound, NULL);
}

/* The fewest digits, 15 to 17, whose nearest double is in [lo,hi], as the C library rounds and reads them. */
static void read_fewest_digits(mpq_t out, double lo, double hi) {
  double middle = lo / 2 + hi / 2;
  char printed[40];
  if (!(middle >= lo && middle <= hi)) middle = lo;
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(printed, sizeof printed, "%.*e", digits - 1, middle);
    double r = strtod(printed, NULL);
    if (r >= lo && r <= hi) break;
  }
  read_decimal(out, printed);
}

/* Doubles about which one digit less or a tie of roundings is likely: few digits, few bits, next to powers. */
static double random_likely(test_random *r) {
  switch (test_below(r, 4)) {
  case 0:
    return (double)test_below(r, 1000000000) / pow(10, (double)test_below(r, 16));
  case 1:
    return ldexp((double)(2 * test_below(r, 1 << 20) + 1), -(int)test_below(r, 60));
  case 2:
    return nextafter(pow(10, (double)test_between(r, -12, 18)), test_chance(r, 2) ? 0 : INFINITY);
  default:
    return nextafter(ldexp(1, (int)test_between(r, -40, 60)), test_chance(r, 3) ? INFINITY : 0);
  }
}

static void test_fewest_digits(void **state) {
  (void)state;
  test_random r = test_random_start("fewest digits");
  mpq_t want, got;
  mpq_inits(want, got, NULL);
  for (size_t k = 0; k < test_cases(60000); k++) {
    double lo = (test_chance(&r, 2) ? 1 : -1) * (test_chance(&r, 3) ? random_double(&r) : random_likely(&r)), error;
    double hi = test_chance(&r, 2)   ? lo
                : test_chance(&r, 2) ? nextafter(lo, INFINITY)
                                     : lo + fabs(lo) * ldexp(test_unit(&r), -(int)test_below(&r, 60));
    if (!(lo <= hi && isfinite(hi)) || lo / 2 + hi / 2 == 0) continue;
    char text[DYD_DECIMAL_SIZE];
    size_t length = dyd_decimal_within(text, &error, lo, hi);
    assert_int_equal(length, strlen(text));
    read_decimal(got, text);
    read_fewest_digits(want, lo, hi);
    assert_true(mpq_equal(want, got));
  }
  mpq_clears(want, got, NULL);
}

/* How many ends of site i have a quick text; it is the one that others have. */
static size_t check_quick_ends(const dyd_sites *s, size_t i) {
  dyd_words end[4];
  dyd_rect rect;
  size_t quick = 0;
  bool words = dyd_sites_get_words(end, s, i);
  dyd_rect_init(&rect);
  assert_int_equal(dyd_sites_get(&rect, s, i), DYD_OK);
  for (int k = 0; words && k < 4; k++) {
    char text[DYD_WORDS_SIZE], *stop = dyd_words_put(text, &end[k]), *full;
    if (!stop) continue;
    full = dyd_end_text(k < 2 ? &rect.x : &rect.y, k & 1);
    assert_int_equal(stop - text, strlen(full));
    assert_memory_equal(text, full, strlen(full));
    free(full);
    quick++;
  }
  dyd_rect_clear(&rect);
  return quick;
}

static void random_words(dyd_words *w, test_random *r) {
  dyd_plain p = {0, 0};
  p.man = test_between(r, -1000000000, 1000000000) * (test_chance(r, 2) ? 1 : test_between(r, 1, 999999999));
  p.exp = (int)test_between(r, -19, 9);
  if (test_chance(r, 20)) p.man = 0;
  while (!dyd_plain_get_words(w, p)) p.exp /= 2;
  if (w->man && test_chance(r, 4)) w->exp += (int)test_between(r, -150, 150);
}

static void test_ends(void **state) {
  (void)state;
  test_random r = test_random_start("ends");
  dyd_sites *s = NULL;
  size_t cases = test_cases(5000), quick = 0;
  mpq_t x, y;
  dyd_rect rect;
  mpq_inits(x, y, NULL);
  dyd_rect_init(&rect);
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (size_t k = 0; k < cases; k++) {
    dyd_words xy[2];
    double lo[2] = {random_double(&r), random_likely(&r)}, hi[2] = {lo[0], lo[1] + fabs(lo[1])};
    for (int a = 0; a < 2; a++) random_words(&xy[a], &r);
    assert_int_equal(dyd_sites_add_words(s, 1, xy), DYD_OK);
    assert_int_equal(dyd_sites_add_boxes(s, 1, &lo[0], &hi[0], &lo[1], &hi[1]), DYD_OK);
    mpq_set_si(x, (long)test_between(&r, -99, 1), (unsigned long)test_between(&r, 1, 99));
    mpq_set_si(y, (long)test_between(&r, 100, 199), (unsigned long)test_between(&r, 1, 99));
    mpq_canonicalize(x);
    mpq_canonicalize(y);
    assert_int_equal(dyd_interval_set_outward(&rect.x, x, y, -(int64_t)test_below(&r, 80)), DYD_OK);
    mpz_ui_pow_ui(mpq_denref(y), 3, (unsigned long)test_below(&r, 80)); /* up to two limbs */
    mpq_canonicalize(y);
    assert_int_equal(dyd_interval_set_q(&rect.y, y), DYD_OK);
    assert_int_equal(dyd_sites_add_rect(s, &rect), DYD_OK);
  }
  for (size_t i = 0; i < dyd_sites_count(s); i++) quick += check_quick_ends(s, i);
  assert_true(quick > 5 * cases && quick < 12 * cases);
  dyd_sites_free(s);
  dyd_rect_clear(&rect);
  mpq_clears(x, y, NULL);
}

static void test_digits(void **state) {
  (void)state;
  for (uint64_t n = 0, power = 1; power; power = power > UINT64_MAX / 10 ? 0 : 10 * power)
    for (int k = -2; k <= 2; k++) {
      char quick[DYD_INDEX_SIZE], slow[DYD_INDEX_SIZE + 1];
      n = power == 1 ? (uint64_t)(k + 2) : power * (k == 2 ? UINT64_MAX / power : 1) + (uint64_t)(k == 2 ? 0 : k);
      int length = snprintf(slow, sizeof slow, "%" PRIu64, n);
      assert_int_equal(dyd_put_digits(quick, n) - quick, length);
      assert_memory_equal(quick, slow, (size_t)length);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_decimal_infinite), cmocka_unit_test(test_plain),    cmocka_unit_test(test_hex),
      cmocka_unit_test(test_plain_refuses),    cmocka_unit_test(test_directed), cmocka_unit_test(test_within),
      cmocka_unit_test(test_fewest_digits),    cmocka_unit_test(test_ends),     cmocka_unit_test(test_digits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
