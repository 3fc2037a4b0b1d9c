/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers as text: the reader of all forms, and dyadics without loss in either direction.
 *
 * A decimal n * 10^-k is a dyadic iff 5^k divides n; then it is (n / 5^k) * 2^-k. */
#include "dyadic/numeral.h"

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

/* ---- the characters of a number ---- */

enum { MOST_DECIMAL = 18, MOST_HEX = 15 }; /* how many digits, without zeros in front, 60 bits hold */
#define MOST_MAN (UINT64_C(1) << 60)

/* From '0' to 'f': one more than the value of the digit; 0: it is none. */
static const unsigned char hex_digit['f' - '0' + 1] = {
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, ['A' - '0'] = 11, 12, 13, 14, 15, 16, ['a' - '0'] = 11, 12, 13, 14, 15, 16};

/* The same of any character. */
static inline unsigned text_hex(char c) {
  return c >= '0' && c <= 'f' ? hex_digit[c - '0'] : 0;
}

static size_t text_hex_digits(uint64_t *man, const char *text, size_t length, size_t pos) {
  uint64_t m = *man;
  for (unsigned digit; pos < length && (digit = text_hex(text[pos])) > 0; pos++) m = 16 * m + (digit - 1);
  *man = m;
  return pos;
}

/* Returns the offset behind the digits at text[pos], which go to the end of *man, modulo 2^64. */
static inline size_t text_digits(uint64_t *man, const char *text, size_t length, size_t pos, bool hex) {
  if (hex) return text_hex_digits(man, text, length, pos);
  uint64_t m = *man;
  for (; pos < length && text[pos] >= '0' && text[pos] <= '9'; pos++) m = 10 * m + (uint64_t)(text[pos] - '0');
  *man = m;
  return pos;
}

/* A decimal exponent with sign; *pos moves behind it. Returns false, with *out = 0, when there is no digit. */
static bool text_exponent(int64_t *out, const char *text, size_t length, size_t *pos) {
  size_t i = *pos;
  const bool negative = i < length && text[i] == '-';
  if (i < length && (text[i] == '-' || text[i] == '+')) i++;
  const size_t begin = i;
  int64_t e = 0;
  for (; i < length && text[i] >= '0' && text[i] <= '9'; i++)
    if (e < HUGE_EXPONENT) e = 10 * e + (text[i] - '0');
  *out = negative ? -e : e;
  if (i > begin) *pos = i;
  return i > begin;
}

static bool text_is_few(const dyd_numeral *n, size_t most) {
  size_t zeros = 0, i = n->first;
  for (; i < n->mantissa_end && (n->text[i] == '0' || n->text[i] == '.'); i++) zeros += n->text[i] == '0';
  return n->digits - zeros <= most;
}

/* "0x" at text[pos], and what may be a digit. */
static bool text_starts_hex(const char *text, size_t length, size_t pos) {
  return pos + 2 < length && (text[pos + 1] == 'x' || text[pos + 1] == 'X') &&
         (text[pos + 2] == '.' || text_hex(text[pos + 2]));
}

/* Of a literal whose mantissa has been read: the letter and its exponent, if both are there. */
static void text_scale(dyd_numeral *n, size_t length) {
  const char mark = n->text[n->end];
  size_t behind = n->end + 1;
  if (n->hex ? mark != 'p' && mark != 'P' : mark != 'e' && mark != 'E') return;
  if (!text_exponent(&n->exponent, n->text, length, &behind)) return;
  n->end = behind;
  n->integer = false;
}

static inline bool text_literal(dyd_numeral *n, const char *text, size_t length, size_t pos, unsigned forms) {
  const size_t begin = pos;
  const bool hex = pos < length && text[pos] == '0' && (forms & DYD_NUMBER_HEX) && text_starts_hex(text, length, pos);
  uint64_t man = 0;
  size_t fraction = 0;
  const size_t first = hex ? pos + 2 : pos;
  pos = text_digits(&man, text, length, first, hex);
  const bool point = pos < length && text[pos] == '.' && (forms & DYD_NUMBER_POINT);
  if (point) {
    const size_t behind = pos + 1;
    pos = text_digits(&man, text, length, behind, hex);
    fraction = pos - behind;
  }
  const size_t digits = pos - first - point;
  n->text = text;
  n->first = first;
  n->mantissa_end = pos;
  n->end = digits ? pos : begin;
  n->digits = digits;
  n->fraction = fraction;
  n->man = man;
  n->below = 0;
  n->exponent = 0;
  n->two = 0;
  n->twos = false;
  n->hex = hex;
  n->few = man < MOST_MAN;
  n->integer = !hex && !point;
  const size_t most = hex ? MOST_HEX : MOST_DECIMAL;
  if (digits > most && n->few) n->few = text_is_few(n, most);
  if (digits && pos < length && (forms & DYD_NUMBER_EXPONENT)) text_scale(n, length);
  return digits > 0;
}

bool dyd_literal_scan(dyd_numeral *n, const char *text, size_t length, size_t pos, unsigned forms) {
  return text_literal(n, text, length, pos, forms);
}

/* Reads "/q" or "*2^e" behind the literal. Returns false, with n->end where it breaks off, if one is incomplete. */
static bool text_suffix(dyd_numeral *n, size_t length, unsigned forms) {
  const char *text = n->text;
  size_t i = n->end;
  if (i >= length) return true;
  if (text[i] == '/' && n->integer && (forms & DYD_NUMBER_QUOTIENT)) {
    dyd_numeral q;
    n->below = ++i;
    const bool right = dyd_literal_scan(&q, text, length, i, DYD_NUMBER_LITERAL) && q.integer;
    n->end = right ? q.end : i;
    return right;
  }
  if (text[i] != '*' || !(forms & DYD_NUMBER_TWOS)) return true;
  if (length - i < 3 || text[i + 1] != '2' || text[i + 2] != '^') return false;
  n->end += 3;
  n->twos = text_exponent(&n->two, text, length, &n->end);
  return n->twos;
}

bool dyd_numeral_scan(dyd_numeral *n, const char *text, size_t length, unsigned forms) {
  size_t pos = 0;
  if (forms & DYD_NUMBER_BLANKS)
    while (length && dyd_is_blank(text[length - 1])) length--;
  if (forms & (DYD_NUMBER_BLANKS | DYD_NUMBER_INDENT))
    while (pos < length && dyd_is_blank(text[pos])) pos++;
  const bool negative = pos < length && text[pos] == '-' && (forms & DYD_NUMBER_MINUS);
  if (negative || (pos < length && text[pos] == '+' && (forms & DYD_NUMBER_PLUS))) pos++;
  const bool right = text_literal(n, text, length, pos, forms) && text_suffix(n, length, forms) && n->end == length;
  n->negative = negative;
  return right;
}

bool dyd_integer_scan(int64_t *out, const char *text, size_t length, unsigned signs, int64_t least, int64_t most) {
  dyd_numeral n;
  if (!dyd_numeral_scan(&n, text, length, signs) || !n.few) return false;
  *out = n.negative ? -(int64_t)n.man : (int64_t)n.man;
  return *out >= least && *out <= most;
}

dyd_status dyd_numeral_digits(mpz_ptr out, const dyd_numeral *n) {
  size_t count = 0;
  char *digits = malloc(n->mantissa_end - n->first + 1);
  if (!digits) return DYD_E_NOMEM;
  for (size_t i = n->first; i < n->mantissa_end; i++)
    if (n->text[i] != '.') digits[count++] = n->text[i];
  digits[count] = 0;
  mpz_set_str(out, digits, n->hex ? 16 : 10);
  free(digits);
  return DYD_OK;
}

/* ---- dyadics ---- */

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
    st = dyd_dyadic_take(out, man, exp10 + exp2);
  } else if (mpz_divisible_p(man, power)) {
    mpz_divexact(man, man, power);
    st = dyd_dyadic_take(out, man, exp10 + exp2);
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
  dyd_numeral n;
  mpz_t man;
  if (!dyd_numeral_scan(&n, text, strlen(text), DYD_NUMBER_ANY & ~(unsigned)DYD_NUMBER_QUOTIENT))
    return text_refuse(err, DYD_E_PARSE, n.end + 1, "not a dyadic number: unexpected character");
  mpz_init(man);
  const int64_t fraction = (int64_t)n.fraction;
  dyd_status st = dyd_numeral_digits(man, &n);
  if (n.negative) mpz_neg(man, man);
  if (st == DYD_OK)
    st = text_value(out, man, n.hex ? n.two + n.exponent - 4 * fraction : n.two, n.hex ? 0 : n.exponent - fraction);
  mpz_clear(man);
  if (st == DYD_E_PARSE) text_refuse(err, st, 1, "not a dyadic number: its denominator is no power of two");
  if (st == DYD_E_RANGE) text_refuse(err, st, 1, dyd_status_text(DYD_E_RANGE));
  return st == DYD_E_NOMEM ? dyd_fail_nomem(err) : st;
}
