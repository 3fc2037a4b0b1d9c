/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows of fields: small tables beside the points, by the readers of lines and of separated text. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/read/source.h"
#include <string.h>

/* Fields between runs of blanks, commas and semicolons, up to a comment; quotes mean nothing. */
static dyd_status rows_split_runs(dyd_csv *csv, const dyd_line *line, dyd_error *err) {
  static const bool between[256] = {[' '] = true, ['\t'] = true, [','] = true, [';'] = true, ['\r'] = true};
  const char *at = line->text, *end = at + line->length;
  for (csv->fields = 0;; csv->fields++) {
    while (at < end && between[(unsigned char)*at]) at++;
    if (at == end || *at == '#') return DYD_OK;
    if (!dyd_reserve((void **)&csv->field, &csv->field_cap, csv->fields + 1, sizeof *csv->field))
      return dyd_fail_nomem(err);
    const char *from = at;
    while (at < end && *at != '#' && !between[(unsigned char)*at]) at++;
    csv->field[csv->fields] = (dyd_span){from, (size_t)(at - from), from, line->text, line->number};
  }
}

/* Of the line: what separates most formats of tables, the first that it holds. */
static char rows_delimiter(const dyd_line *line) {
  for (const char *c = ",;\t|"; *c; c++)
    if (memchr(line->text, *c, line->length)) return *c;
  return ' ';
}

/* The next row that has fields; csv->fields = 0 at the end. */
static dyd_status rows_next(dyd_csv *csv, dyd_error *err) {
  dyd_line line;
  for (csv->fields = 0; csv->fields == 0;) {
    dyd_status st = csv->delimiter == ' ' ? dyd_text_next(&line, csv->text, err) : dyd_csv_record(&line, csv, err);
    if (st != DYD_OK || !line.text) return st;
    if (!csv->delimiter) csv->delimiter = rows_delimiter(&line);
    st = csv->delimiter == ' ' ? rows_split_runs(csv, &line, err) : dyd_csv_split(csv, &line, err);
    if (st != DYD_OK) return st;
  }
  for (size_t k = 0; k < csv->fields; k++) dyd_span_trim(&csv->field[k]);
  return DYD_OK;
}

dyd_status dyd_read_records(FILE *in, char delimiter, dyd_record_fn row, void *user, dyd_error *err) {
  dyd_text text;
  dyd_csv csv = {.text = &text, .delimiter = delimiter, .comments = true};
  dyd_error own;
  dyd_status st;
  if (!err) err = &own;
  dyd_error_clear(err);
  dyd_text_init(&text, in);
  do {
    st = rows_next(&csv, err);
    const dyd_record now = {DYD_SIZED(dyd_record), .fields = csv.fields, .field = csv.field};
    if (st == DYD_OK && csv.fields) st = row(user, &now, err);
  } while (st == DYD_OK && csv.fields);
  dyd_csv_clear(&csv);
  dyd_text_clear(&text);
  return st;
}

const char *dyd_record_field(size_t *length, const dyd_record *row, size_t k) {
  const dyd_span *field = row->field;
  *length = k < row->fields ? field[k].length : 0;
  return k < row->fields ? field[k].text : NULL;
}

bool dyd_record_integer(int64_t *out, const dyd_record *row, size_t k, int64_t least, int64_t most) {
  size_t length, at = 0;
  const char *text = dyd_record_field(&length, row, k);
  const bool negative = length > 0 && *text == '-';
  int64_t value = 0;
  for (at = negative; at < length && text[at] >= '0' && text[at] <= '9'; at++)
    if (__builtin_mul_overflow(value, 10, &value) ||
        __builtin_add_overflow(value, negative ? '0' - text[at] : text[at] - '0', &value))
      return false;
  *out = value;
  return at == length && at > negative && value >= least && value <= most;
}

void dyd_record_place(dyd_error *err, const dyd_record *row, size_t k) {
  const dyd_span *field = row->field;
  const bool behind = k >= row->fields;
  const dyd_span *at = &field[behind ? row->fields - 1 : k];
  dyd_span_position(&err->line, &err->column, at, behind ? at->length : 0);
}
