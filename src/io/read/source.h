/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The two layouts of input: the points file and CSV. Both give points as pairs of spans of text. */
#ifndef DYD_IO_READ_SOURCE_H
#define DYD_IO_READ_SOURCE_H

#include "io/read/text.h"

/* Splits one line of a points file. *count is 2, or 0 for a line without a point. */
dyd_status dyd_points_split(dyd_span coordinate[2], size_t *count, const dyd_line *line, dyd_error *err);

/* A CSV file (RFC 4180) being read. */
typedef struct dyd_csv {
  dyd_text *text;         /* borrowed */
  char *name[2];          /* the columns wanted */
  size_t column[2];       /* where they are, from 0 */
  size_t columns;         /* how many the header has */
  char *record;           /* the current record, when it spans lines */
  size_t record_cap;      /* */
  char *plain;            /* unquoted fields of the current record */
  size_t plain_cap, used; /* */
  dyd_span *field;
  size_t fields, field_cap;
} dyd_csv;

/* Takes the two names from the text "NAME,NAME" (quoted as in RFC 4180 when they hold commas), then reads the header.
 * DYD_E_ARG when that text is not two names; DYD_E_PARSE when the header has not got each of them once. */
dyd_status dyd_csv_open(dyd_csv *csv, dyd_text *text, const char *columns, dyd_error *err);
void dyd_csv_clear(dyd_csv *csv);
/* The two fields of the next record, blanks around them removed; *count = 0 at the end. Borrowed until the next
 * call. */
dyd_status dyd_csv_next(dyd_span coordinate[2], size_t *count, dyd_csv *csv, dyd_error *err);

#endif
