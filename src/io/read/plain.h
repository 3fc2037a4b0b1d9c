/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain decimals of at most 18 digits and hexadecimal floats: the forms nearly all coordinates have, read without big
 * numbers. */
#ifndef DYD_IO_READ_PLAIN_H
#define DYD_IO_READ_PLAIN_H

#include "rect/sites_table.h"

/* The number man * 10^exp. Invariant: |man| < 10^18, -60 <= exp <= 60. */
typedef struct dyd_plain {
  int64_t man;
  int exp;
} dyd_plain;

/* Reads the whole text; false when it is no decimal of this size (it may still be another form of number). */
bool dyd_plain_scan(dyd_plain *out, const char *text, size_t length);
/* Is the number a double? Then *out is it. (May say no for numbers above 2^63.) */
bool dyd_plain_get_exact(double *out, dyd_plain p);
/* The largest double <= p or the smallest >= p; false where this quick way does not apply
 * (|man| >= 2^53 or |exp| > 22). */
bool dyd_plain_get_rounded(double *out, dyd_plain p, dyd_round dir);
/* The number in single words; false where they are too short. */
bool dyd_plain_get_words(dyd_words *out, dyd_plain p);
/* Reads the whole text, a hexadecimal float; false when it is none, or no double (it may still be a number). */
bool dyd_plain_scan_hex(double *out, const char *text, size_t length);
/* The exact value, canonical; q is initialised by the caller. */
void dyd_plain_get_q(mpq_t q, dyd_plain p);

#endif
