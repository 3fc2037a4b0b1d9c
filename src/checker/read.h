/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading a certificate: lines, words, numbers in their only spelling. */
#ifndef DYD_CHECKER_READ_H
#define DYD_CHECKER_READ_H

#include "checker/sites.h"
#include <stdio.h>

typedef struct dyd_cert_reader {
  FILE *in;
  char *line;
  size_t cap, number; /* number of the line, from 1 */
  char *at;           /* the rest of the line; NULL: nothing is left */
  dyd_error *err;
} dyd_cert_reader;

void dyd_cert_reader_clear(dyd_cert_reader *r);
/* Rejects: fills in the error with the number of the line; returns DYD_E_PARSE. */
dyd_status dyd_cert_reject(const dyd_cert_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The next line. */
dyd_status dyd_cert_next_line(dyd_cert_reader *r);
/* Nothing may follow the line. */
dyd_status dyd_cert_expect_end(dyd_cert_reader *r);
/* The next word of the line, ended by a zero; an error when there is none. */
dyd_status dyd_cert_word(char **out, dyd_cert_reader *r);
/* Is the line used up? If not, an error. */
dyd_status dyd_cert_line_done(dyd_cert_reader *r);
bool dyd_cert_line_has_more(const dyd_cert_reader *r);

/* A count or number of a site below or equal to most. */
dyd_status dyd_cert_read_index(uint32_t *out, dyd_cert_reader *r, uint64_t most);
dyd_status dyd_cert_read_number(dyd_exact *out, dyd_cert_reader *r);
/* Two numbers. */
dyd_status dyd_cert_read_point(dyd_exact out[2], dyd_cert_reader *r);
dyd_status dyd_cert_read_side(dyd_cert_side *out, dyd_cert_reader *r);
/* An integer in its only spelling; the whole text. */
bool dyd_cert_scan_integer(mpz_ptr out, const char *text);
/* A signed decimal of at most 18 digits. */
dyd_status dyd_cert_read_integer(long long *out, dyd_cert_reader *r);

#endif
