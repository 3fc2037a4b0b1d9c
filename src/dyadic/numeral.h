/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers in texts: which of their characters mean what. The one reader of numbers; certificates have their own. */
#ifndef DYD_DYADIC_NUMERAL_H
#define DYD_DYADIC_NUMERAL_H

#include <dyadel/dyadic.h>

/* What a place takes besides decimal digits: a row of dyd_number_form. */
enum {
  DYD_NUMBER_SIGNS = DYD_NUMBER_MINUS | DYD_NUMBER_PLUS,
  DYD_NUMBER_DECIMAL = DYD_NUMBER_SIGNS | DYD_NUMBER_POINT | DYD_NUMBER_EXPONENT,
  DYD_NUMBER_LITERAL = DYD_NUMBER_POINT | DYD_NUMBER_EXPONENT | DYD_NUMBER_HEX, /* within an expression */
  DYD_NUMBER_JSON = DYD_NUMBER_MINUS | DYD_NUMBER_POINT | DYD_NUMBER_EXPONENT
};

/* (-) m base^(exponent - fraction) 2^two / denominator, where the digits of the text as an integer are m, and the
 * base of its exponent is 10, or 2 of hexadecimal digits, of which each counts 4.
 * Invariant: mantissa_end - first = digits (+ 1 for the point); digits >= 1; the text is borrowed. */
typedef struct dyd_numeral {
  const char *text;
  size_t first, mantissa_end, end; /* offsets of the first digit, behind the mantissa, behind the number */
  size_t digits, fraction;         /* how many digits there are, and number of them after the point */
  uint64_t man;                    /* m, where `few` */
  size_t below;                    /* the offset of the denominator; 0: there is none */
  int64_t exponent, two;           /* held within +- 2^44 */
  bool negative, hex, twos, few;   /* twos: there is "*2^"; few: m < 10^18, or m < 16^15 */
  bool integer;                    /* decimal digits only, without point or exponent */
} dyd_numeral;

static inline bool dyd_is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* Reads the longest unsigned number that starts at text[pos], without denominator and "*2^". Returns false when none
 * does, with out->end = pos. */
bool dyd_literal_scan(dyd_numeral *out, const char *text, size_t length, size_t pos, unsigned forms);
/* Reads the whole text. Returns false if it is no such number: out->end is then the offset of the first character
 * behind the longest beginning that is one (the length of the text when it ends too early). */
bool dyd_numeral_scan(dyd_numeral *out, const char *text, size_t length, unsigned forms);
/* out = m. DYD_OK or DYD_E_NOMEM. */
dyd_status dyd_numeral_digits(mpz_ptr out, const dyd_numeral *in);
/* The whole number that is all of the text, if it is from least to most and below 10^18; else false, with *out
 * undefined. */
bool dyd_integer_scan(int64_t *out, const char *text, size_t length, unsigned signs, int64_t least, int64_t most);

#endif
