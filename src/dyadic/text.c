/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadics as text, without loss in either direction.
 *
 * A decimal n * 10^-k is a dyadic iff 5^k divides n; then it is (n / 5^k) * 2^-k. */
#include "base/error.h"
#include "dyadic/raw.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Exponents in texts are cut at this size, far outside the range. */
#define HUGE_EXPONENT ((int64_t)1 << 40)

char *dyd_dyadic_get_str(const dyd_dyadic *x) {
  bool plain = x->exp >= 0 && x->exp <= 64;
  mpz_t t;
  mpz_init_set(t, x->man);
  if (plain) mpz_mul_2exp(t, t, (mp_bitcnt_t)x->exp);
  char *text = malloc(mpz_sizeinbase(t, 10) + 40); /* sign, "*2^", 20 digits and sign, end */
  if (text) mpz_get_str(text, 10, t);
  if (text && !plain) sprintf(text + strlen(text), "*2^%" PRId64, x->exp);
  mpz_clear(t);
  return text;
}

/* A number read so far: mantissa * 2^exp2 * 10^exp10. */
typedef struct number_reader {
  const char *text, *at; /* at: the next character */
  char *digits;          /* room for every digit of the text */
  size_t count;          /* digits stored */
  int64_t exp2, exp10;
} number_reader;

static bool text_is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
static bool text_is_digit(char c, int base) {
  bool decimal = c >= '0' && c <= '9';
  return decimal || (base == 16 && ((c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F')));
}

static void text_read_digits(number_reader *r, int base) {
  while (text_is_digit(*r->at, base)) r->digits[r->count++] = *r->at++;
}

/* A decimal exponent with sign; false when there is no digit. */
static bool text_read_exponent(number_reader *r, int64_t *out) {
  bool negative = *r->at == '-';
  if (negative || *r->at == '+') r->at++;
  if (!text_is_digit(*r->at, 10)) return false;
  int64_t e = 0;
  for (; text_is_digit(*r->at, 10); r->at++) {
    if (e < HUGE_EXPONENT) e = 10 * e + (*r->at - '0');
  }
  *out = negative ? -e : e;
  return true;
}

/* Digits with at most one point; the number of digits behind it goes to *fraction. */
static bool text_read_mantissa(number_reader *r, int base, int64_t *fraction) {
  text_read_digits(r, base);
  size_t whole = r->count;
  if (*r->at == '.') {
    r->at++;
    text_read_digits(r, base);
  }
  *fraction = (int64_t)(r->count - whole);
  return r->count > 0;
}

/* What may follow the mantissa: "p5" for base 16, "*2^5" for an integer, "e5" for a decimal. */
static bool text_read_suffix(number_reader *r, int base, int64_t fraction, bool pointed) {
  char c = *r->at;
  if (base == 16 && (c == 'p' || c == 'P')) {
    r->at++;
    if (!text_read_exponent(r, &r->exp2)) return false;
  } else if (base == 10 && (c == 'e' || c == 'E')) {
    r->at++;
    if (!text_read_exponent(r, &r->exp10)) return false;
  } else if (base == 10 && c == '*' && !pointed) {
    for (const char *expected = "*2^"; *expected; expected++, r->at++) {
      if (*r->at != *expected) return false;
    }
    if (!text_read_exponent(r, &r->exp2)) return false;
  }
  if (base == 16) r->exp2 -= 4 * fraction;
  if (base == 10) r->exp10 -= fraction;
  return true;
}

/* The whole number with surrounding blanks; false with r->at on the first bad character. */
static bool text_read(number_reader *r, int *base, bool *negative) {
  while (text_is_blank(*r->at)) r->at++;
  *negative = *r->at == '-';
  if (*r->at == '-' || *r->at == '+') r->at++;
  *base = r->at[0] == '0' && (r->at[1] == 'x' || r->at[1] == 'X') ? 16 : 10;
  if (*base == 16) r->at += 2;
  int64_t fraction;
  const char *start = r->at;
  if (!text_read_mantissa(r, *base, &fraction)) return false;
  bool pointed = memchr(start, '.', (size_t)(r->at - start)) != NULL;
  if (!text_read_suffix(r, *base, fraction, pointed)) return false;
  while (text_is_blank(*r->at)) r->at++;
  return !*r->at;
}

/* out = man * 2^exp2 * 10^exp10; man is destroyed. DYD_E_PARSE when that is no dyadic. */
static dyd_status text_value(dyd_dyadic *out, mpz_ptr man, int64_t exp2, int64_t exp10) {
  if (!mpz_sgn(man)) return dyd_dyadic_take(out, man, 0);
  if (exp10 > DYD_EXP_LIMIT) return DYD_E_RANGE;
  if (exp10 < -dyd_bits(man)) return DYD_E_PARSE; /* 5^-exp10 > |man| cannot divide it */
  if (!exp10) return dyd_dyadic_take(out, man, exp2);
  mpz_t power;
  mpz_init(power);
  mpz_ui_pow_ui(power, 5, (unsigned long)(exp10 < 0 ? -exp10 : exp10));
  dyd_status st = DYD_E_PARSE;
  if (exp10 > 0) {
    mpz_mul(man, man, power);
    st = dyd_dyadic_take(out, man, exp10);
  } else if (mpz_divisible_p(man, power)) {
    mpz_divexact(man, man, power);
    st = dyd_dyadic_take(out, man, exp10);
  }
  mpz_clear(power);
  return st;
}

/* The record for a text refused at column `column`. */
static dyd_status text_refuse(dyd_error *err, dyd_status st, size_t column, const char *what) {
  if (err) err->column = column;
  return dyd_fail(err, st, "%s", what);
}

dyd_status dyd_dyadic_set_str(dyd_dyadic *out, const char *text, dyd_error *err) {
  number_reader r = {text, text, malloc(strlen(text) + 1), 0, 0, 0};
  if (!r.digits) return dyd_fail_nomem(err);
  int base;
  bool negative;
  dyd_status st = DYD_OK;
  mpz_t man;
  mpz_init(man);
  if (!text_read(&r, &base, &negative)) {
    st = text_refuse(err, DYD_E_PARSE, (size_t)(r.at - text) + 1, "not a dyadic number: unexpected character");
  } else {
    r.digits[r.count] = 0;
    mpz_set_str(man, r.digits, base);
    if (negative) mpz_neg(man, man);
    st = text_value(out, man, r.exp2, r.exp10);
    if (st == DYD_E_PARSE) text_refuse(err, st, 1, "not a dyadic number: its denominator is no power of two");
    if (st == DYD_E_RANGE) text_refuse(err, st, 1, dyd_status_text(DYD_E_RANGE));
  }
  mpz_clear(man);
  free(r.digits);
  return st;
}
