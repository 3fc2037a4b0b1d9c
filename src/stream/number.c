/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain numbers: exact values, and the measured half unit.
 *
 * A decimal m * 10^-k in lowest terms: only the primes 2 and 5 can cancel, so short numbers need no gcd. */
#include "stream/number.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool dyd_is_plain_number(const char *text, size_t length) {
  dyd_numeral n;
  return dyd_numeral_scan(&n, text, length, DYD_NUMBER_ANY);
}

size_t dyd_text_column(const char *text, size_t offset) {
  size_t column = 1;
  for (size_t i = 0; i < offset; i++) column += ((unsigned char)text[i] & 0xC0) != 0x80;
  return column;
}

dyd_status dyd_text_fail(dyd_error *err, dyd_status code, const char *text, size_t offset, const char *format, ...) {
  if (err) {
    char message[DYD_MESSAGE_SIZE];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    err->column = dyd_text_column(text, offset);
    dyd_fail(err, code, "%s", message);
  }
  return code;
}

dyd_status dyd_text_unexpected(dyd_error *err, const char *text, size_t length, size_t offset, const char *remedy) {
  size_t end = offset + 1;
  if (dyd_is_blank(text[offset]))
    return dyd_text_fail(err, DYD_E_PARSE, text, offset, "unexpected blank inside a number");
  while (end < length && ((unsigned char)text[end] & 0xC0) == 0x80) end++;
  return dyd_text_fail(err, DYD_E_PARSE, text, offset, "unexpected \"%.*s\"%s", (int)(end - offset), text + offset,
                       remedy);
}

/* 10^400000 and 16^400000 exceed 2^DYD_EXP_LIMIT. */
#define MAX_DIGITS ((size_t)400000)

#define SMALL_DIGITS 18

dyd_status dyd_rational_fits(mpq_srcptr q) {
  size_t limit = (size_t)DYD_EXP_LIMIT + 1;
  bool fits = mpz_sizeinbase(mpq_numref(q), 2) <= limit && mpz_sizeinbase(mpq_denref(q), 2) <= limit;
  return fits ? DYD_OK : DYD_E_RANGE;
}

static uint64_t power_of_ten(int k) {
  uint64_t p = 1;
  while (k-- > 0) p *= 10;
  return p;
}

/* *num / *den = m * 10^ten in lowest terms. */
static bool decimal_words(uint64_t *num, uint64_t *den, uint64_t m, int ten) {
  *den = 1;
  if (ten > 0) {
    if (m > UINT64_MAX / power_of_ten(ten)) return false;
    m *= power_of_ten(ten);
  } else if (ten < 0) {
    int two = -ten, five = -ten;
    if (!m) two = five = 0;
    for (; two && !(m & 1); two--) m >>= 1;
    for (; five && m % 5 == 0; five--) m /= 5;
    for (; five; five--) *den *= 5;
    *den <<= two;
  }
  *num = m;
  return true;
}

bool dyd_small_decimal(mpq_ptr out, uint64_t m, int ten) {
  uint64_t den;
  if (!decimal_words(&m, &den, m, ten) || m > ULONG_MAX || den > ULONG_MAX) return false;
  mpz_set_ui(mpq_numref(out), (unsigned long)m);
  mpz_set_ui(mpq_denref(out), (unsigned long)den);
  return true;
}

/* The power of ten that the digits as an integer are multiplied by. */
static int64_t literal_ten(const dyd_numeral *in) {
  return in->exponent - (int64_t)in->fraction;
}

static bool literal_is_small(const dyd_numeral *in) {
  int64_t ten = literal_ten(in);
  return !in->hex && in->few && ten >= -SMALL_DIGITS && ten <= SMALL_DIGITS;
}

bool dyd_literal_words(uint64_t *num, uint64_t *den, const dyd_numeral *in) {
  return literal_is_small(in) && decimal_words(num, den, in->man, (int)literal_ten(in));
}

/* By single words, where they do. */
static bool literal_small_value(mpq_ptr out, const dyd_numeral *in) {
  return literal_is_small(in) && dyd_small_decimal(out, in->man, (int)literal_ten(in));
}

/* All digits as an integer. Zeros in front make no difference to the limit. */
static dyd_status all_digits(mpz_ptr out, const dyd_numeral *in) {
  size_t zeros = 0;
  while (in->first + zeros < in->mantissa_end && memchr("0.", in->text[in->first + zeros], 2)) zeros++;
  if (in->mantissa_end - in->first - zeros > MAX_DIGITS) return DYD_E_RANGE;
  return dyd_numeral_digits(out, in);
}

/* x *= 2^two. */
static dyd_status scale_two(mpq_ptr x, int64_t two) {
  if (!mpq_sgn(x)) return DYD_OK;
  if (two > 4 * DYD_EXP_LIMIT || two < -4 * DYD_EXP_LIMIT) return DYD_E_RANGE;
  if (two >= 0) {
    mpq_mul_2exp(x, x, (mp_bitcnt_t)two);
  } else {
    mpq_div_2exp(x, x, (mp_bitcnt_t)-two);
  }
  return dyd_rational_fits(x);
}

/* x *= 10^ten. */
static dyd_status scale_ten(mpq_ptr x, int64_t ten) {
  if (!mpq_sgn(x)) return DYD_OK;
  if (ten > (int64_t)MAX_DIGITS || ten < -(int64_t)MAX_DIGITS) return DYD_E_RANGE;
  DYD_LOCAL_NUMBERS(mpq, power);
  mpz_ui_pow_ui(mpq_numref(power), 10, (unsigned long)(ten < 0 ? -ten : ten));
  if (ten < 0) {
    mpq_div(x, x, power);
  } else {
    mpq_mul(x, x, power);
  }
  return dyd_rational_fits(x);
}

dyd_status dyd_literal_value(mpq_ptr out, const dyd_numeral *in) {
  if (literal_small_value(out, in)) return DYD_OK;
  mpz_set_ui(mpq_denref(out), 1);
  dyd_status st = all_digits(mpq_numref(out), in);
  if (st != DYD_OK) return st;
  return in->hex ? scale_two(out, in->exponent - 4 * (int64_t)in->fraction) : scale_ten(out, literal_ten(in));
}

/* *at is the offset to blame on failure. */
static dyd_status numeral_value(mpq_ptr out, size_t *at, const dyd_numeral *n) {
  *at = n->first;
  dyd_status st = dyd_literal_value(out, n);
  if (st == DYD_OK && n->twos) st = scale_two(out, n->two);
  if (st == DYD_OK && n->below) {
    dyd_numeral denominator;
    DYD_LOCAL_NUMBERS(mpq, q);
    *at = n->below;
    dyd_literal_scan(&denominator, n->text, n->end, n->below, 0);
    st = dyd_literal_value(q, &denominator);
    if (st == DYD_OK && !mpq_sgn(q)) st = DYD_E_DOMAIN;
    if (st == DYD_OK) mpq_div(out, out, q);
    if (st == DYD_OK) st = dyd_rational_fits(out);
  }
  if (n->negative) mpq_neg(out, out);
  return st;
}

static dyd_status number_value_fail(dyd_error *err, dyd_status st, const char *text, size_t at) {
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_DOMAIN) return dyd_text_fail(err, st, text, at, "the denominator is 0; give a number other than 0");
  return dyd_text_fail(err, st, text, at,
                       "the number is too large or too fine: numbers reach from 2^-%lld to 2^%lld; scale the input",
                       (long long)DYD_EXP_LIMIT, (long long)DYD_EXP_LIMIT);
}

static dyd_status scan_or_fail(dyd_numeral *n, const char *text, size_t length, unsigned forms, dyd_error *err) {
  if (dyd_numeral_scan(n, text, length, forms)) return DYD_OK;
  return dyd_text_fail(err, DYD_E_PARSE, text, n->end,
                       "%s; write a number such as -3.25, 1e-3, 22/7, 0x1.8p-3 or 5*2^-20",
                       n->end < length ? "this is not part of a number" : "the number ends too early");
}

dyd_status dyd_parse_number(mpq_t out, const char *text, size_t length, unsigned forms, dyd_error *err) {
  dyd_numeral n;
  dyd_status st = scan_or_fail(&n, text, length, forms, err);
  if (st != DYD_OK) return st;
  if (!n.below && !n.twos && literal_small_value(out, &n)) {
    if (n.negative) mpq_neg(out, out);
    return DYD_OK;
  }
  size_t at = 0;
  DYD_LOCAL_NUMBERS(mpq, value);
  st = numeral_value(value, &at, &n);
  if (st == DYD_OK) mpq_swap(out, value);
  return st != DYD_OK ? number_value_fail(err, st, text, at) : DYD_OK;
}

/* lo = x - h, hi = x + h with h = 10^unit / 2. */
static dyd_status half_unit_around(mpq_ptr lo, mpq_ptr hi, mpq_srcptr x, int64_t unit) {
  DYD_LOCAL_NUMBERS(mpq, h);
  mpq_set_ui(h, 1, 2);
  dyd_status st = scale_ten(h, unit);
  if (st == DYD_OK) {
    mpq_sub(lo, x, h);
    mpq_add(hi, x, h);
    st = dyd_rational_fits(lo);
    if (st == DYD_OK) st = dyd_rational_fits(hi);
  }
  return st;
}

/* The short way: 10 m -+ 5 units of 10^(ten - 1). */
static bool small_measured(mpq_ptr lo, mpq_ptr hi, const dyd_numeral *n) {
  if (!literal_is_small(n) || n->man >= UINT64_C(100000000000000000)) return false;
  int ten = (int)literal_ten(n) - 1;
  if (ten < -SMALL_DIGITS) return false;
  uint64_t m = 10 * n->man;
  if (!dyd_small_decimal(hi, m + 5, ten) || !dyd_small_decimal(lo, m ? m - 5 : 5, ten)) return false;
  if (!m) mpq_neg(lo, lo);
  if (n->negative) {
    mpq_swap(lo, hi);
    mpq_neg(lo, lo);
    mpq_neg(hi, hi);
  }
  return true;
}

dyd_status dyd_parse_measured(mpq_t lo, mpq_t hi, const char *text, size_t length, dyd_error *err) {
  dyd_numeral n;
  dyd_status st = scan_or_fail(&n, text, length, DYD_NUMBER_ANY, err);
  if (st != DYD_OK) return st;
  bool decimal = !n.below && !n.twos && !n.hex;
  size_t at = n.first;
  DYD_LOCAL_ARRAY(mpq_t, value, [3]);
  if (!decimal || !small_measured(value[0], value[1], &n)) {
    st = numeral_value(value[2], &at, &n);
    if (st == DYD_OK && decimal) {
      st = half_unit_around(value[0], value[1], value[2], literal_ten(&n));
    } else if (st == DYD_OK) {
      mpq_set(value[0], value[2]);
      mpq_set(value[1], value[2]);
    }
  }
  if (st == DYD_OK) {
    mpq_swap(lo, value[0]);
    mpq_swap(hi, value[1]);
  }
  return st != DYD_OK ? number_value_fail(err, st, text, at) : DYD_OK;
}
