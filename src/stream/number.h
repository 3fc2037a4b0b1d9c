/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain exact numbers as text: decimal, integer, rational, hexadecimal float, m*2^e.
 *
 * Every value is at once an exact rational; numerators and denominators of more than DYD_EXP_LIMIT bits are
 * refused before they are computed, so no short text costs much memory. */
#ifndef DYD_STREAM_NUMBER_H
#define DYD_STREAM_NUMBER_H

#include "dyadic/numeral.h"

#include <dyadel/stream.h>

/* The exact value, but for sign, denominator and "*2^", canonical. DYD_OK, DYD_E_RANGE or DYD_E_NOMEM (out is then
 * unspecified but valid). */
dyd_status dyd_literal_value(mpq_ptr out, const dyd_numeral *in);
/* The value num / den of a short decimal literal, in lowest terms. false (nothing written) where words are too short.
 */
bool dyd_literal_words(uint64_t *num, uint64_t *den, const dyd_numeral *in);
/* out = m * 10^ten, canonical, by single words: m <= 10^18, -18 <= ten <= 18. false (out unchanged) where words
 * are too short. */
bool dyd_small_decimal(mpq_ptr out, uint64_t m, int ten);

/* DYD_E_RANGE when the numerator or the denominator has more than DYD_EXP_LIMIT + 1 bits, else DYD_OK. */
dyd_status dyd_rational_fits(mpq_srcptr q);

/* Column (from 1, in characters) of the byte at `offset` of a UTF-8 text. */
size_t dyd_text_column(const char *text, size_t offset);
/* Fills *err (may be NULL) with code, column and message; returns code. */
#if defined(__GNUC__)
__attribute__((format(printf, 5, 6)))
#endif
dyd_status
dyd_text_fail(dyd_error *err, dyd_status code, const char *text, size_t offset, const char *format, ...);

/* The same, with DYD_E_PARSE, of a character that cannot be at offset, which is before length; the message quotes it,
 * and ends with `remedy`. */
dyd_status dyd_text_unexpected(dyd_error *err, const char *text, size_t length, size_t offset, const char *remedy);

/* Returns true if the text, without blanks around it, is a plain number by its form. Computes no value: O(length). */
bool dyd_is_plain_number(const char *text, size_t length);
/* Reads a decimal as a rounded measurement: the value minus and plus half a unit of its last digit, so that 47.61
 * gives [47.605,47.615], 12 gives [11.5,12.5] and 1.2e3 gives [1150,1250]. The other plain forms are exact
 * (lo = hi). Errors as dyd_parse_number. */
dyd_status dyd_parse_measured(mpq_t lo, mpq_t hi, const char *text, size_t length, dyd_error *err);

#endif
