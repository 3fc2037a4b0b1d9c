/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers as text for output: decimals rounded in a known direction, exact ends of intervals.
 *
 * MPFR converts to decimal with directed rounding exactly. Rounding is monotone: for a decimal d <= x (a double) the
 * double nearest to d is <= x, so the direction survives reading the decimal back. */
#include "io/decimal.h"
#include "base/alloc.h"
#include "io/read/plain.h"
#include <inttypes.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

/* 0.DIGITS * 10^exp as a plain decimal, or in scientific form when that needs many zeros. */
static void decimal_layout(char *out, bool negative, const char *digits, int count, int exp) {
  while (count > 1 && digits[count - 1] == '0') count--;
  char *p = out;
  if (negative) *p++ = '-';
  if (exp < -4 || exp > 17) {
    p += snprintf(p, 8, "%c%s", digits[0], count > 1 ? "." : "");
    memcpy(p, digits + 1, (size_t)count - 1);
    snprintf(p + count - 1, 16, "e%d", exp - 1);
    return;
  }
  if (exp <= 0) {
    memcpy(p, "0.00000", 7);
    p += 2 - exp;
    memcpy(p, digits, (size_t)count);
    p[count] = 0;
    return;
  }
  for (int k = 0; k < count || k < exp; k++) {
    if (k == exp) *p++ = '.';
    *p++ = k < count ? digits[k] : '0';
  }
  *p = 0;
}

/* The same without MPFR where 128 bits hold everything, as they do for most numbers that people write: |x| = man
 * 2^-shift, and man 10^k < 10^digits * 100 * 2^63 < 2^127 for the k that leaves `digits` digits before the point; the
 * guess of k is off by one at most. */
static bool decimal_in_integers(char *text, int *exp, double x, int digits, bool up) {
  int e, spare;
  uint64_t man = (uint64_t)ldexp(frexp(fabs(x), &e), 53), least = 1;
  spare = __builtin_ctzll(man);
  int shift = 53 - e - spare, k = digits - 1 - (int)floor((e - 1) * 0.30103);
  if (shift < 0 || shift > 63 || k < 1 || digits > 17) return false;
  for (int q = 1; q < digits; q++) least *= 10;
  wide product = man >> spare;
  for (int q = 0; q < k; q++) product *= 10;
  for (; product >> shift < least; k++) product *= 10;
  for (; product >> shift >= 10 * (wide)least; k--) product /= 10;
  uint64_t whole = (uint64_t)(product >> shift);
  if (up && (wide)whole << shift != product) whole++;
  *exp = digits - k + (whole == 10 * least);
  snprintf(text, 24, "%" PRIu64, whole == 10 * least ? least : whole);
  return true;
}

void dyd_decimal_directed(char out[DYD_DECIMAL_SIZE], double x, int digits, dyd_round dir) {
  int quick;
  strcpy(out, "0");
  if (x == 0) return;
  char text[40];
  mpfr_exp_t exp;
  mpfr_t value;
  if (decimal_in_integers(text, &quick, x, digits, (dir == DYD_UP) == (x > 0))) {
    decimal_layout(out, x < 0, text, digits, quick);
    return;
  }
  mpfr_init2(value, 53);
  mpfr_set_d(value, x, MPFR_RNDN); /* exact */
  mpfr_get_str(text, &exp, 10, (size_t)digits, value, dir == DYD_UP ? MPFR_RNDU : MPFR_RNDD);
  mpfr_clear(value);
  bool negative = text[0] == '-';
  decimal_layout(out, negative, text + negative, digits, (int)exp);
}

/* Takes apart what printf made of a number with %.*e, whatever the decimal point of the locale. */
static void decimal_layout_printed(char *out, const char *printed) {
  char digits[24];
  int count = 0;
  const char *p = printed;
  for (; *p && *p != 'e'; p++)
    if (*p >= '0' && *p <= '9') digits[count++] = *p;
  decimal_layout(out, printed[0] == '-', digits, count, (int)strtol(p + 1, NULL, 10) + 1);
}

void dyd_decimal_within(char out[DYD_DECIMAL_SIZE], double *error, double lo, double hi) {
  *error = 0;
  strcpy(out, "0");
  if (lo == 0 && hi == 0) return;
  double middle = lo / 2 + hi / 2, r = 0, exact;
  if (!(middle >= lo && middle <= hi)) middle = lo;
  char printed[40];
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(printed, sizeof printed, "%.*e", digits - 1, middle);
    r = strtod(printed, NULL);
    if (r >= lo && r <= hi) break;
  }
  if (r != 0) decimal_layout_printed(out, printed);
  dyd_plain plain;
  *error = fmax(hi - r, r - lo);
  if (*error > 0) *error = nextafter(*error, INFINITY);
  if (dyd_plain_scan(&plain, out, strlen(out)) && dyd_plain_get_exact(&exact, plain) && exact == r) return;
  /* |decimal - r| is at most half the gap above |r|, the larger one; then two roundings to nearest. */
  double gap = nextafter(fabs(r), INFINITY) - fabs(r);
  *error = nextafter(nextafter(*error + gap / 2, INFINITY), INFINITY);
}

/* MPFR rounds decimals correctly, and its exponents reach far beyond DYD_EXP_LIMIT. */
void dyd_decimal_dyadic(char out[DYD_DECIMAL_SIZE], const dyd_dyadic *x, int digits, dyd_round dir) {
  strcpy(out, "0");
  if (dyd_dyadic_sgn(x) == 0) return;
  char text[DYD_DECIMAL_SIZE];
  mpfr_t exact;
  mpfr_exp_t point;
  size_t bits = mpz_sizeinbase(x->man, 2);
  mpfr_init2(exact, bits < 2 ? 2 : (mpfr_prec_t)bits);
  mpfr_set_z_2exp(exact, x->man, (mpfr_exp_t)x->exp, MPFR_RNDN);
  mpfr_get_str(text, &point, 10, (size_t)digits, exact, dir == DYD_UP ? MPFR_RNDU : MPFR_RNDD);
  mpfr_clear(exact);
  const char *digit = text + (*text == '-');
  snprintf(out, DYD_DECIMAL_SIZE, "%s%c.%se%" PRIdMAX, *text == '-' ? "-" : "", *digit, digit + 1, (intmax_t)point - 1);
}

void dyd_decimal_put(FILE *out, double x, dyd_round dir, const char *otherwise) {
  char text[DYD_DECIMAL_SIZE];
  if (isfinite(x)) dyd_decimal_directed(text, x, 17, dir);
  fputs(isfinite(x) ? text : otherwise, out);
}

void dyd_decimal_put_near(FILE *out, double x) {
  char text[DYD_DECIMAL_SIZE];
  double error;
  dyd_decimal_within(text, &error, x, x);
  fputs(text, out);
}

/* man * 2^exp / den for an odd den > 1. */
static char *rational_text(const dyd_interval *a) {
  char *text = NULL, *whole = NULL;
  if (a->lo.exp > 256 || a->lo.exp < -256) {
    whole = dyd_dyadic_get_str(&a->lo);
    size_t size = whole ? strlen(whole) + mpz_sizeinbase(a->den, 10) + 3 : 0;
    text = whole ? dyd_alloc(size, 1) : NULL;
    if (text) gmp_snprintf(text, size, "%s/%Zd", whole, a->den);
    free(whole);
    return text;
  }
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_interval_get_q(lo, hi, a);
  size_t size = mpz_sizeinbase(mpq_numref(lo), 10) + mpz_sizeinbase(mpq_denref(lo), 10) + 3;
  text = dyd_alloc(size, 1);
  if (text) mpq_get_str(text, 10, lo);
  mpq_clears(lo, hi, NULL);
  return text;
}

char *dyd_end_text(const dyd_interval *a, bool upper) {
  if (mpz_cmp_ui(a->den, 1) != 0) return rational_text(a);
  return dyd_dyadic_get_str(upper ? &a->hi : &a->lo);
}
