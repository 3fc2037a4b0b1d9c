/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines of a text file, packed or not, read in blocks, and positions in them for error messages. */
#ifndef DYD_IO_READ_TEXT_H
#define DYD_IO_READ_TEXT_H

#include "io/read/kind.h"
#include <dyadel/status.h>
#include <stdbool.h>
#include <stdio.h>

/* A line (or a record of several lines) longer than this is refused: it is no points file. */
#define DYD_TEXT_LINE_MAX ((size_t)1 << 20)

typedef struct dyd_unpacker dyd_unpacker;

/* Invariant: start <= end <= cap; buffer[start .. end) is read and not yet handed out.
 * unpacker = NULL before the first read, and for files that are not packed. */
typedef struct dyd_text {
  FILE *in; /* borrowed */
  bool begun;
  dyd_unpacker *unpacker;
  char *buffer;
  size_t cap, start, end;
  size_t line; /* number of the last line handed out */
  bool ended;
  char newline; /* that ends lines, of files with CR alone the CR; 0 before the first line */
  bool data;    /* set by the caller: points or a table; other formats are refused, Windows-1252 is recoded */
  const dyd_file_kind *kind;  /* the format refused; NULL: none */
  size_t recoded, recode_cap; /* lines that were no UTF-8 */
  char *recode;
} dyd_text;

/* text = NULL means the end of the file. Borrowed until the next call of dyd_text_next. */
typedef struct dyd_text_line {
  const char *text;
  size_t length; /* without the line end (LF, CRLF or CR) */
  size_t number; /* from 1 */
} dyd_text_line;

/* A piece of a record, with the data that gives its line and column.
 * Invariant: origin <= at, both in the same buffer. */
typedef struct dyd_span {
  const char *text; /* the characters, possibly unquoted into another buffer */
  size_t length;
  const char *at;     /* where it begins in the record */
  const char *origin; /* where the record begins */
  size_t line;        /* line of the record's first character */
} dyd_span;

/* Between the fields of a line. */
static inline bool dyd_is_gap(char c) {
  return c == ' ' || c == '\t';
}

void dyd_text_init(dyd_text *t, FILE *in);
/* Lines of a copy of `text`. */
dyd_status dyd_text_init_copy(dyd_text *t, const char *text, size_t length);
void dyd_text_clear(dyd_text *t);
/* The next line. A byte order mark at the start of the file is skipped. DYD_E_PARSE for NUL bytes and over-long
 * lines, DYD_E_IO, DYD_E_NOMEM. */
dyd_status dyd_text_next(dyd_text_line *out, dyd_text *t, dyd_error *err);
/* The length of the UTF-8 character at `text`, from 1 to 4; 0 if none begins there (RFC 3629: shortest forms, no
 * surrogates). */
size_t dyd_utf8_length(const char *text, size_t length);
/* The line and column (in characters of UTF-8, both from 1) of the byte `offset` bytes after span->at. */
void dyd_span_position(size_t *line, size_t *column, const dyd_span *span, size_t offset);
/* Fails with DYD_E_PARSE and `message` at that byte. */
dyd_status dyd_span_fail(dyd_error *err, const dyd_span *span, size_t offset, const char *message);

#endif
