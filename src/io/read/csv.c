/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Records and fields of separated text (RFC 4180, any delimiter): fields may be quoted, quoted fields may hold
 * delimiters, line ends and doubled quotes.
 *
 * In a well-formed file quotes come in pairs, so a record ends at the first line end before which their number is
 * even. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/read/source.h"
#include <string.h>

void dyd_csv_clear(dyd_csv *csv) {
  for (int k = 0; k < DYD_CSV_ROLES; k++) free(csv->want[k].name);
  free(csv->record);
  free(csv->plain);
  free(csv->field);
  *csv = (dyd_csv){0};
}

/* ---- records ---- */

static bool odd_quotes(const char *text, size_t length) {
  bool odd = false;
  for (const char *end = text + length; (text = memchr(text, '"', (size_t)(end - text))); text++) odd = !odd;
  return odd;
}

static dyd_status record_append(dyd_csv *csv, size_t *length, const dyd_line *line, dyd_error *err) {
  if (*length + line->length > DYD_TEXT_LINE_MAX) {
    dyd_span span = {line->text, 0, line->text, line->text, line->number};
    return dyd_span_fail(err, &span, 0, "a quoted field goes on for more than 1048576 bytes; close its quote");
  }
  if (!dyd_reserve((void **)&csv->record, &csv->record_cap, *length + line->length + 1, 1)) return dyd_fail_nomem(err);
  if (*length) csv->record[(*length)++] = '\n';
  memcpy(csv->record + *length, line->text, line->length);
  *length += line->length;
  return DYD_OK;
}

/* Appends lines until the quotes pair up. */
static dyd_status record_join_lines(dyd_line *out, dyd_csv *csv, dyd_error *err) {
  size_t length = 0, first = out->number;
  dyd_status st = record_append(csv, &length, out, err);
  for (bool odd = true; odd && st == DYD_OK;) {
    st = dyd_text_next(out, csv->text, err);
    if (st != DYD_OK) break;
    if (!out->text) {
      dyd_span span = {csv->record, 0, csv->record, csv->record, first};
      return dyd_span_fail(err, &span, (size_t)((char *)memchr(csv->record, '"', length) - csv->record),
                           "the quotes of this record do not pair up; close the quoted field");
    }
    odd = !odd_quotes(out->text, out->length);
    st = record_append(csv, &length, out, err);
  }
  *out = (dyd_line){csv->record, length, first};
  return st;
}

dyd_status dyd_csv_record(dyd_line *out, dyd_csv *csv, dyd_error *err) {
  dyd_status st;
  do st = dyd_text_next(out, csv->text, err);
  while (st == DYD_OK && out->text && (out->length == 0 || (csv->comments && out->text[0] == '#')));
  if (st != DYD_OK || !out->text || !odd_quotes(out->text, out->length)) return st;
  return record_join_lines(out, csv, err);
}

/* ---- fields ---- */

/* Unquotes the field whose opening quote is at *at; *at is moved behind the closing one. */
static dyd_status record_quoted_field(dyd_span *field, const char **at, const char *end, dyd_csv *csv, dyd_error *err) {
  const char *p = *at + 1;
  field->at = p;
  field->text = csv->plain + csv->used;
  for (; p < end; p++) {
    if (*p == '"' && !(p + 1 < end && p[1] == '"')) break;
    if (*p == '"') p++;
    csv->plain[csv->used++] = *p;
    field->length++;
  }
  if (p == end) return dyd_span_fail(err, field, 0, "this quoted field is not closed; add a quote");
  *at = p + 1;
  if (*at == end || **at == csv->delimiter) return DYD_OK;
  return dyd_span_fail(err, field, (size_t)(*at - field->at),
                       "text behind a closing quote; double the quotes inside a quoted field");
}

static dyd_status record_field(dyd_span *field, const char **at, const char *end, dyd_csv *csv, dyd_error *err) {
  field->text = field->at = *at;
  if (*at < end && **at == '"') return record_quoted_field(field, at, end, csv, err);
  const char *stop = memchr(*at, csv->delimiter, (size_t)(end - *at));
  if (!stop) stop = end;
  field->length = (size_t)(stop - *at);
  const char *quote = memchr(*at, '"', field->length);
  *at = stop;
  if (!quote) return DYD_OK;
  return dyd_span_fail(err, field, (size_t)(quote - field->at),
                       "a quote inside a field that is not quoted; quote the whole field and double its quotes");
}

dyd_status dyd_csv_split(dyd_csv *csv, const dyd_line *line, dyd_error *err) {
  const char *at = line->text, *end = line->text + line->length;
  csv->used = csv->fields = 0;
  if (!dyd_reserve((void **)&csv->plain, &csv->plain_cap, line->length, 1)) return dyd_fail_nomem(err);
  for (;;) {
    if (!dyd_reserve((void **)&csv->field, &csv->field_cap, csv->fields + 1, sizeof *csv->field))
      return dyd_fail_nomem(err);
    dyd_span *field = &csv->field[csv->fields++];
    *field = (dyd_span){.origin = line->text, .line = line->number};
    dyd_status st = record_field(field, &at, end, csv, err);
    if (st != DYD_OK || at == end) return st;
    at++;
  }
}

void dyd_span_trim(dyd_span *s) {
  while (s->length && (*s->text == ' ' || *s->text == '\t')) s->text++, s->at++, s->length--;
  while (s->length && (s->text[s->length - 1] == ' ' || s->text[s->length - 1] == '\t')) s->length--;
}

/* ---- the next point ---- */

const char *dyd_delimiter_name(char delimiter, bool many) {
  static const struct {
    char c;
    const char *one, *many;
  } name[] = {{',', "a comma", "commas"},
              {';', "a semicolon", "semicolons"},
              {'\t', "a tab", "tabs"},
              {'|', "a bar", "bars"},
              {' ', "a blank", "blanks"}};
  for (size_t k = 0; k < sizeof name / sizeof *name; k++)
    if (name[k].c == delimiter) return many ? name[k].many : name[k].one;
  return many ? "delimiters" : "a delimiter";
}

dyd_status dyd_csv_next(dyd_span field[DYD_CSV_ROLES], size_t *count, dyd_csv *csv, dyd_error *err) {
  dyd_line line;
  *count = 0;
  dyd_status st = dyd_csv_record(&line, csv, err);
  if (st != DYD_OK || !line.text) return st;
  st = dyd_csv_split(csv, &line, err);
  if (st != DYD_OK) return st;
  if (csv->fields != csv->columns) {
    if (err) dyd_span_position(&err->line, &err->column, &csv->field[0], 0);
    return dyd_fail(err, DYD_E_PARSE, "this record has %zu fields, the header %zu; quote fields that hold %s",
                    csv->fields, csv->columns, dyd_delimiter_name(csv->delimiter, true));
  }
  for (int k = 0; k < DYD_CSV_ROLES; k++) {
    if (!csv->want[k].name) continue;
    field[k] = csv->field[csv->column[k]];
    dyd_span_trim(&field[k]);
  }
  *count = csv->columns;
  return DYD_OK;
}
