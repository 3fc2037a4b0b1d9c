/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The form of plain numbers: where a literal begins and ends, and which of the plain forms a text has. */
#include "stream/number_form.h"

#include "base/error.h"
#include <stdarg.h>
#include <stdio.h>

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

bool dyd_number_scan(dyd_number_form *out, size_t *bad, const char *text, size_t length) {
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
