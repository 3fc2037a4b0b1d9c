/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain numbers: where a literal begins and ends, which of the plain forms a text has, exact values, and the measured
 * half unit.
 *
 * A decimal m * 10^-k in lowest terms: only the primes 2 and 5 can cancel, so short numbers need no gcd. */
#include "stream/number.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>

/* (-) literal, (-) literal / denominator, or (-) literal * 2^two.
 * Invariant: at most one of rational and dyadic; denominator counts only when rational, two only when dyadic. */
typedef struct dyd_number_form {
  bool negative, rational, dyadic;
  dyd_literal literal, denominator;
  int64_t two;
} dyd_number_form;

/* Exponents beyond this mean DYD_E_RANGE in any case. */
#define EXPONENT_CAP ((int64_t)1 << 40)

static bool is_decimal_digit(char c) {
  return c >= '0' && c <= '9';
}

static bool is_hex_digit(char c) {
  return is_decimal_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/* An optional sign and decimal digits at *pos; moves *pos behind them. false (nothing moved): no digits. */
static bool scan_exponent(int64_t *out, const char *text, size_t length, size_t *pos) {
  size_t i = *pos;
  bool negative = i < length && text[i] == '-';
  if (i < length && (text[i] == '-' || text[i] == '+')) i++;
  if (i >= length || !is_decimal_digit(text[i])) return false;
  int64_t value = 0;
  for (; i < length && is_decimal_digit(text[i]); i++) {
    if (value < EXPONENT_CAP) value = 10 * value + (text[i] - '0');
  }
  if (value > EXPONENT_CAP) value = EXPONENT_CAP;
  *out = negative ? -value : value;
  *pos = i;
  return true;
}

bool dyd_literal_scan(dyd_literal *out, const char *text, size_t length, size_t pos) {
  dyd_literal l = {.text = text, .first = pos};
  l.hex = pos + 2 < length && text[pos] == '0' && (text[pos + 1] == 'x' || text[pos + 1] == 'X') &&
          (is_hex_digit(text[pos + 2]) || text[pos + 2] == '.');
  if (l.hex) l.first = pos += 2;
  bool point = false;
  for (; pos < length; pos++) {
    if (text[pos] == '.' && !point) {
      point = true;
    } else if (l.hex ? is_hex_digit(text[pos]) : is_decimal_digit(text[pos])) {
      l.digits++;
      l.fraction += point;
    } else {
      break;
    }
  }
  if (!l.digits) return false;
  l.mantissa_end = pos;
  bool mark = pos < length && (l.hex ? text[pos] == 'p' || text[pos] == 'P' : text[pos] == 'e' || text[pos] == 'E');
  size_t behind = pos + 1;
  bool exponent = mark && scan_exponent(&l.exponent, text, length, &behind);
  l.end = exponent ? behind : pos;
  l.integer = !l.hex && !point && !exponent;
  *out = l;
  return true;
}

/* Reads "*2^e" or "/q" at *pos, if there, and moves *pos behind it; false: *pos is where it breaks off. */
static bool scan_suffix(dyd_number_form *f, const char *text, size_t length, size_t *pos) {
  size_t i = *pos;
  if (i < length && text[i] == '/' && f->literal.integer) {
    f->rational = dyd_literal_scan(&f->denominator, text, length, ++i) && f->denominator.integer;
    *pos = f->rational ? f->denominator.end : i;
    return f->rational;
  }
  if (i + 2 < length && text[i] == '*' && text[i + 1] == '2' && text[i + 2] == '^') {
    i += 3;
    f->dyadic = scan_exponent(&f->two, text, length, &i);
    *pos = i;
    return f->dyadic;
  }
  return true;
}

/* Reads the whole text, blanks around it aside. false: *bad is the offset of the first character that does not
 * fit (the length of the text when it ends too early). */
static bool dyd_number_scan(dyd_number_form *out, size_t *bad, const char *text, size_t length) {
  dyd_number_form f = {0};
  size_t i = 0;
  while (length && dyd_is_blank(text[length - 1])) length--;
  while (i < length && dyd_is_blank(text[i])) i++;
  if (i < length && (text[i] == '-' || text[i] == '+')) f.negative = text[i++] == '-';
  *bad = i;
  if (!dyd_literal_scan(&f.literal, text, length, i)) return false;
  i = f.literal.end;
  bool whole = scan_suffix(&f, text, length, &i) && i == length;
  *bad = i;
  *out = f;
  return whole;
}

bool dyd_is_plain_number(const char *text, size_t length) {
  dyd_number_form f;
  size_t bad;
  return dyd_number_scan(&f, &bad, text, length);
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

/* All digits of a literal of at most 18 decimal digits, as an integer. */
static uint64_t small_digits(const dyd_literal *in) {
  uint64_t m = 0;
  for (size_t i = in->first; i < in->mantissa_end; i++) {
    if (in->text[i] != '.') m = 10 * m + (uint64_t)(in->text[i] - '0');
  }
  return m;
}

/* The power of ten that the digits as an integer are multiplied by. */
static int64_t literal_ten(const dyd_literal *in) {
  return in->exponent - (int64_t)in->fraction;
}

static bool literal_is_small(const dyd_literal *in) {
  int64_t ten = literal_ten(in);
  return !in->hex && in->digits <= SMALL_DIGITS && ten >= -SMALL_DIGITS && ten <= SMALL_DIGITS;
}

bool dyd_literal_words(uint64_t *num, uint64_t *den, const dyd_literal *in) {
  return literal_is_small(in) && decimal_words(num, den, small_digits(in), (int)literal_ten(in));
}

/* By single words, where they do. */
static bool literal_small_value(mpq_ptr out, const dyd_literal *in) {
  return literal_is_small(in) && dyd_small_decimal(out, small_digits(in), (int)literal_ten(in));
}

/* All digits as an integer, whatever their number up to MAX_DIGITS (leading zeros aside). */
static dyd_status all_digits(mpz_t out, const dyd_literal *in) {
  size_t first = in->first, count = 0;
  while (first < in->mantissa_end && (in->text[first] == '0' || in->text[first] == '.')) first++;
  if (in->mantissa_end - first > MAX_DIGITS) return DYD_E_RANGE;
  DYD_FREED char *buffer = dyd_alloc(in->mantissa_end - first + 2, 1);
  if (!buffer) return DYD_E_NOMEM;
  for (size_t i = first; i < in->mantissa_end; i++) {
    if (in->text[i] != '.') buffer[count++] = in->text[i];
  }
  if (!count) buffer[count++] = '0';
  buffer[count] = 0;
  mpz_set_str(out, buffer, in->hex ? 16 : 10);
  return DYD_OK;
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

dyd_status dyd_literal_value(mpq_ptr out, const dyd_literal *in) {
  if (literal_small_value(out, in)) return DYD_OK;
  mpz_set_ui(mpq_denref(out), 1);
  dyd_status st = all_digits(mpq_numref(out), in);
  if (st != DYD_OK) return st;
  return in->hex ? scale_two(out, in->exponent - 4 * (int64_t)in->fraction) : scale_ten(out, literal_ten(in));
}

/* The value of a scanned form; *at is the offset to blame on failure. */
static dyd_status form_value(mpq_ptr out, size_t *at, const dyd_number_form *f) {
  *at = f->literal.first;
  dyd_status st = dyd_literal_value(out, &f->literal);
  if (st == DYD_OK && f->dyadic) st = scale_two(out, f->two);
  if (st == DYD_OK && f->rational) {
    DYD_LOCAL_NUMBERS(mpq, q);
    *at = f->denominator.first;
    st = dyd_literal_value(q, &f->denominator);
    if (st == DYD_OK && !mpq_sgn(q)) st = DYD_E_DOMAIN;
    if (st == DYD_OK) mpq_div(out, out, q);
    if (st == DYD_OK) st = dyd_rational_fits(out);
  }
  if (f->negative) mpq_neg(out, out);
  return st;
}

static dyd_status number_value_fail(dyd_error *err, dyd_status st, const char *text, size_t at) {
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_DOMAIN) return dyd_text_fail(err, st, text, at, "the denominator is 0; give a number other than 0");
  return dyd_text_fail(err, st, text, at,
                       "the number is too large or too fine: numbers reach from 2^-%lld to 2^%lld; scale the input",
                       (long long)DYD_EXP_LIMIT, (long long)DYD_EXP_LIMIT);
}

static dyd_status scan_or_fail(dyd_number_form *f, const char *text, size_t length, dyd_error *err) {
  size_t bad;
  if (dyd_number_scan(f, &bad, text, length)) return DYD_OK;
  return dyd_text_fail(err, DYD_E_PARSE, text, bad, "%s; write a number such as -3.25, 1e-3, 22/7, 0x1.8p-3 or 5*2^-20",
                       bad < length ? "this is not part of a number" : "the number ends too early");
}

dyd_status dyd_parse_number(mpq_t out, const char *text, size_t length, dyd_error *err) {
  dyd_number_form f;
  dyd_status st = scan_or_fail(&f, text, length, err);
  if (st != DYD_OK) return st;
  if (!f.rational && !f.dyadic && literal_small_value(out, &f.literal)) {
    if (f.negative) mpq_neg(out, out);
    return DYD_OK;
  }
  size_t at = 0;
  DYD_LOCAL_NUMBERS(mpq, value);
  st = form_value(value, &at, &f);
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
static bool small_measured(mpq_ptr lo, mpq_ptr hi, const dyd_number_form *f) {
  if (!literal_is_small(&f->literal) || f->literal.digits >= SMALL_DIGITS) return false;
  int ten = (int)literal_ten(&f->literal) - 1;
  if (ten < -SMALL_DIGITS) return false;
  uint64_t m = 10 * small_digits(&f->literal);
  if (!dyd_small_decimal(hi, m + 5, ten) || !dyd_small_decimal(lo, m ? m - 5 : 5, ten)) return false;
  if (!m) mpq_neg(lo, lo);
  if (f->negative) {
    mpq_swap(lo, hi);
    mpq_neg(lo, lo);
    mpq_neg(hi, hi);
  }
  return true;
}

dyd_status dyd_parse_measured(mpq_t lo, mpq_t hi, const char *text, size_t length, dyd_error *err) {
  dyd_number_form f;
  dyd_status st = scan_or_fail(&f, text, length, err);
  if (st != DYD_OK) return st;
  bool decimal = !f.rational && !f.dyadic && !f.literal.hex;
  size_t at = f.literal.first;
  DYD_LOCAL_ARRAY(mpq_t, value, [3]);
  if (!decimal || !small_measured(value[0], value[1], &f)) {
    st = form_value(value[2], &at, &f);
    if (st == DYD_OK && decimal) {
      st = half_unit_around(value[0], value[1], value[2], literal_ten(&f.literal));
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
