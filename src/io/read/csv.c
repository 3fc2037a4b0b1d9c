/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Records and fields of separated text (RFC 4180, any delimiter): fields may be quoted, quoted fields may hold
 * delimiters, line ends and doubled quotes.
 *
 * In a well-formed file quotes come in pairs, so a record ends at the first line end before which their number is
 * even. */
#include "io/read/csv.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "io/read/coordinate.h"
#include "stream/number.h"

#include <string.h>

static dyd_status csv_record(dyd_text_line *out, dyd_csv *csv, dyd_error *err);
static dyd_status csv_split(dyd_csv *csv, const dyd_text_line *line, dyd_error *err);
static void span_trim(dyd_span *s);
/* The header of separated text: which delimiter it uses, and where the wanted columns are.
 *
 * A column is wanted by its name or, in digits without quotes, by its number from 1. */

static const char delimiters[] = ",;\t| ";
enum { LOOKED_AT = 20 }; /* lines that may be the header */

/* ---- columns requested ---- */

dyd_status dyd_csv_ask(dyd_csv *csv, int first, size_t least, size_t most, const char *text, const char *option,
                       dyd_error *err) {
  dyd_text_line line = {text, strlen(text), 0};
  csv->delimiter = ',';
  dyd_status split = line.length ? csv_split(csv, &line, NULL) : DYD_E_ARG;
  if (split == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (split != DYD_OK || csv->fields < least || csv->fields > most) {
    return dyd_fail(err, DYD_E_ARG, "\"%.100s\" is not %s", text,
                    least == 2  ? "two column names; give NAME,NAME (of a column of WKT points: its name twice)"
                    : most == 1 ? "one column name; give NAME"
                    : most == 2 ? "one or two column names; give NAME or NAME,NAME"
                                : "one, two or three column names; give S or SX,SY or SX,SY,RHO");
  }
  for (size_t k = 0; k < most && (k < 2 || k < csv->fields); k++) {
    dyd_span *field = &csv->field[k < csv->fields ? k : 0];
    span_trim(field);
    dyd_csv_want *want = &csv->want[(size_t)first + k];
    if (csv->roles <= first + (int)k) csv->roles = first + (int)k + 1;
    *want = (dyd_csv_want){dyd_alloc(field->length + 1, 1), field->text != field->at, option};
    if (!want->name) return dyd_fail_nomem(err);
    memcpy(want->name, field->text, field->length);
    want->name[field->length] = 0;
  }
  return DYD_OK;
}

/* 0: taken from the header. */
static dyd_status read_delimiter(char *out, const char *text, dyd_error *err) {
  *out = 0;
  if (!text) return DYD_OK;
  if (strcmp(text, "tab") == 0 || strcmp(text, "\\t") == 0) text = "\t";
  if (strcmp(text, "blank") == 0) text = " ";
  if (!text[0] || text[1] || text[0] == '"' || text[0] == '\n' || text[0] == '\r' || (unsigned char)text[0] >= 128)
    return dyd_fail(err, DYD_E_ARG, "\"%.20s\" cannot be a delimiter; give one character such as \";\", tab or blank",
                    text);
  *out = text[0];
  return DYD_OK;
}

/* ---- finding it ---- */

static char lower_letter(char c) {
  return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Blanks and ends of lines, any number of them, are equal. */
static bool is_named(const dyd_span *field, const char *name, bool fold) {
  const char *p = field->text, *end = p + field->length;
  for (; p < end && *name; p++, name++) {
    const bool space = dyd_is_blank(*p) && dyd_is_blank(*name);
    while (space && p + 1 < end && dyd_is_blank(p[1])) p++;
    while (space && dyd_is_blank(name[1])) name++;
    if (!space && *p != *name && (!fold || lower_letter(*p) != lower_letter(*name))) return false;
  }
  return p == end && !*name;
}

/* How many columns have the name; *first and *last of them. */
static size_t count_named(size_t *first, size_t *last, const dyd_csv *csv, const char *name, bool fold) {
  size_t found = 0;
  for (size_t k = 0; k < csv->fields; k++) {
    if (!is_named(&csv->field[k], name, fold)) continue;
    if (!found++) *first = k;
    *last = k;
  }
  return found;
}

/* The names of the header, cut to the buffer. */
static void list_names(char *out, size_t size, const dyd_csv *csv) {
  size_t used = 0;
  for (size_t k = 0; k < csv->fields; k++) {
    const dyd_span *f = &csv->field[k];
    if (used + f->length + 8 > size) {
      snprintf(out + used, size - used, ", ...");
      return;
    }
    used += (size_t)snprintf(out + used, size - used, "%s%.*s", k ? ", " : "", (int)f->length, f->text);
    for (char *at = out; (at = strpbrk(at, "\r\n"));) *at = ' ';
  }
}

/* A failure at column k of the header. */
static dyd_status header_fail(const dyd_csv *csv, size_t k, dyd_error *err, const char *message) {
  return dyd_span_fail(err, &csv->field[k], 0, message);
}

static dyd_status fail_missing(const dyd_csv *csv, const dyd_csv_want *want, dyd_error *err) {
  char names[180], message[DYD_MESSAGE_SIZE];
  list_names(names, sizeof names, csv);
  if (csv->fields == 1)
    snprintf(message, sizeof message,
             "the header is one column, \"%s\", and \"%.60s\" is not its name; say what separates columns: "
             "`delimiter` C",
             names, want->name);
  else
    snprintf(message, sizeof message,
             "no column is called \"%.60s\"; the header's names are: %s; give one of these, or its number, to `%s`",
             want->name, names, want->option);
  return header_fail(csv, 0, err, message);
}

/* By number; a name that is the same digits must not be meant. */
static dyd_status find_numbered(size_t *out, const dyd_csv *csv, const dyd_csv_want *want, dyd_error *err) {
  char message[DYD_MESSAGE_SIZE];
  size_t first = 0, last = 0;
  int64_t number = 0;
  const bool found = dyd_integer_scan(&number, want->name, strlen(want->name), 0, 1, (int64_t)csv->fields);
  bool named = !csv->headless && count_named(&first, &last, csv, want->name, false);
  if (named && (!found || first + 1 != (size_t)number)) {
    snprintf(message, sizeof message,
             "%s is the name of column %zu: for that one, put the name into quotes: `%s` '\"%s\"'; for column %s, give "
             "its name",
             want->name, first + 1, want->option, want->name, want->name);
    return header_fail(csv, first, err, message);
  }
  if (found) return *out = (size_t)number - 1, DYD_OK;
  snprintf(message, sizeof message, "there is no column %.20s; the %s has %zu, counted from 1", want->name,
           csv->headless ? "first line" : "header", csv->fields);
  return header_fail(csv, 0, err, message);
}

static bool is_numbered(const dyd_csv_want *want) {
  dyd_numeral n;
  return !want->quoted && dyd_numeral_scan(&n, want->name, strlen(want->name), 0);
}

static dyd_status find_column(size_t *out, const dyd_csv *csv, const dyd_csv_want *want, dyd_error *err) {
  char names[160], message[DYD_MESSAGE_SIZE];
  size_t first = 0, last = 0;
  if (is_numbered(want)) return find_numbered(out, csv, want, err);
  if (csv->headless)
    return dyd_fail(err, DYD_E_ARG,
                    "without a header columns have numbers, from 1, and no names such as \"%.60s\": `%s`", want->name,
                    want->option);
  size_t found = count_named(&first, &last, csv, want->name, false), exact = found;
  if (!found) found = count_named(&first, &last, csv, want->name, true);
  if (found == 1) return *out = first, DYD_OK;
  if (!found) return fail_missing(csv, want, err);
  list_names(names, sizeof names, csv);
  if (exact)
    snprintf(message, sizeof message,
             "%zu columns are called \"%.60s\"; rename them in the header, or give numbers; its names are: %s", found,
             want->name, names);
  else
    snprintf(message, sizeof message,
             "%zu columns are called \"%.60s\" but for capitals; write the name as the header does, whose names are: "
             "%s",
             found, want->name, names);
  return header_fail(csv, last, err, message);
}

static dyd_status find_columns(dyd_csv *csv, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (int k = 0; k < DYD_CSV_MOST && st == DYD_OK; k++)
    if (csv->want[k].name) st = find_column(&csv->column[k], csv, &csv->want[k], err);
  return st;
}

/* ---- the delimiter ---- */

/* A comment mark in front does not belong to the first name. */
static dyd_status header_split(dyd_csv *csv, const dyd_text_line *line, char delimiter, dyd_error *err) {
  csv->delimiter = delimiter;
  dyd_status st = csv_split(csv, line, err);
  for (size_t k = 0; k < csv->fields && st == DYD_OK; k++) span_trim(&csv->field[k]);
  if (st != DYD_OK || !csv->fields || csv->headless || !dyd_line_is_comment(line)) return st;
  dyd_span *first = &csv->field[0];
  csv->marked = first->length == 1;
  if (first->length > 1) first->text++, first->at++, first->length--;
  span_trim(first);
  return st;
}

/* The delimiter that makes the most columns among those by which all wanted ones are found; when there is none, the one
 * that makes the most. Blanks are tried last, commas that may be decimal before them. */
static dyd_status find_delimiter(char *best, dyd_csv *csv, const dyd_text_line *line, dyd_error *err) {
  size_t most = 0;
  bool found = false;
  *best = delimiters[0];
  for (const char *d = csv->decimal_comma ? ";\t|, " : delimiters; *d; d++) {
    if (found && (*d == ' ' || (*d == ',' && csv->decimal_comma))) break;
    dyd_status st = header_split(csv, line, *d, NULL);
    if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
    if (st != DYD_OK) continue;
    bool finds = find_columns(csv, NULL) == DYD_OK;
    if (*d == ' ' && !finds) break;
    if (finds < found || (finds == found && csv->fields <= most)) continue;
    found = finds;
    most = csv->fields;
    *best = *d;
  }
  return DYD_OK;
}

/* Returns true if the first line holds numbers in columns given by number: then it is a point, and not a header. */
static bool holds_numbers(const dyd_csv *csv) {
  dyd_plain p;
  for (int k = DYD_CSV_X; k <= DYD_CSV_Y; k++) {
    const dyd_span *f = &csv->field[csv->column[k]];
    if (!is_numbered(&csv->want[k]) || !dyd_plain_scan(&p, f->text, f->length)) return false;
  }
  return true;
}

static bool all_numbered(const dyd_csv *csv) {
  for (int k = 0; k < DYD_CSV_MOST; k++)
    if (csv->want[k].name && !is_numbered(&csv->want[k])) return false;
  return true;
}

/* Takes the line for the header, or for the first row. delimiter 0: taken from it. commented: comments precede it. */
static dyd_status header_take(dyd_csv *csv, const dyd_text_line *line, char delimiter, bool commented, dyd_error *err) {
  dyd_status st = delimiter ? DYD_OK : find_delimiter(&delimiter, csv, line, err);
  if (st == DYD_OK) st = header_split(csv, line, delimiter, err);
  if (st == DYD_OK) st = find_columns(csv, err);
  if (st != DYD_OK || csv->headless || !holds_numbers(csv)) return st;
  csv->headless = commented && all_numbered(csv);
  if (csv->headless) return DYD_OK;
  return header_fail(csv, csv->column[DYD_CSV_X], err,
                     "the first line holds numbers, not the names of columns; where no line names them, give "
                     "`no_header`, and where these are names, put them into quotes");
}

/* ---- columns that are carried ---- */

/* Column k; the names of a file without a header are numbers. */
static dyd_status carry_put(dyd_csv *csv, size_t k, dyd_error *err) {
  char number[24];
  snprintf(number, sizeof number, "%zu", k + 1);
  const char *name = csv->headless ? number : csv->field[k].text;
  size_t length = csv->headless ? strlen(number) : csv->field[k].length;
  if (!DYD_GROW(csv->carried, csv->carried_cap, csv->carries + 1) ||
      !dyd_reserve((void **)&csv->names, &csv->names_cap, csv->names_used + length + 1, 1))
    return dyd_fail_nomem(err);
  csv->carried[csv->carries++] = k;
  memcpy(csv->names + csv->names_used, name, length);
  csv->names[csv->names_used + length] = 0;
  csv->names_used += length + 1;
  return DYD_OK;
}

/* The columns named. */
static dyd_status carry_named(dyd_csv *csv, dyd_error *err) {
  DYD_SCOPED(dyd_csv) list = {.delimiter = ','};
  const dyd_text_line line = {csv->carry, strlen(csv->carry), 0};
  dyd_status st = csv_split(&list, &line, err);
  for (size_t k = 0; k < list.fields && st == DYD_OK; k++) {
    dyd_span *f = &list.field[k];
    size_t at;
    span_trim(f);
    DYD_FREED char *name = dyd_alloc(f->length + 1, 1);
    if (!name) st = dyd_fail_nomem(err);
    if (name) memcpy(name, f->text, f->length), name[f->length] = 0;
    const dyd_csv_want want = {name, f->text != f->at, "carry"};
    if (st == DYD_OK) st = find_column(&at, csv, &want, err);
    if (st == DYD_OK) st = carry_put(csv, at, err);
  }
  return st;
}

/* The fields are those of the header. */
static dyd_status carry_find(dyd_csv *csv, dyd_error *err) {
  dyd_status st = DYD_OK;
  if (!csv->carry) return DYD_OK;
  if (strcmp(csv->carry, "all") != 0) return carry_named(csv, err);
  for (size_t k = 0; k < csv->fields && st == DYD_OK; k++)
    if (k != csv->column[DYD_CSV_X] && k != csv->column[DYD_CSV_Y] && (csv->headless || csv->field[k].length))
      st = carry_put(csv, k, err);
  return st;
}

/* The delimiter in a first line such as "sep=;"; 0: it is none. */
static char delimiter_line(const dyd_text_line *line) {
  const char *at = line->text;
  bool quoted = line->length == 7 && at[0] == '"' && at[6] == '"';
  if (line->number != 1 || (line->length != 5 && !quoted)) return 0;
  return memcmp(at + quoted, "sep=", 4) == 0 || memcmp(at + quoted, "Sep=", 4) == 0 ? at[4 + quoted] : 0;
}

/* One of the next lines has all columns: the error says which. */
static void header_seek(dyd_csv *csv, char delimiter, dyd_error *err) {
  dyd_text_line line = {"", 0, 0};
  for (int k = 0; k < LOOKED_AT && err; k++) {
    if (csv_record(&line, csv, NULL) != DYD_OK || !line.text) return;
    if (header_take(csv, &line, delimiter, false, NULL) != DYD_OK) continue;
    dyd_fail(err, DYD_E_PARSE, "line %zu has the names of the columns: pass over those before it by `skip_lines` %zu",
             line.number, line.number - 1);
    return;
  }
}

/* Lines before the header that begin with # or % and have not got the columns are comments, as in files written by
 * dyadel. One that has as many fields as the line behind it, in which columns are missing as well, was the header.
 * Where all columns are numbers, all of them are comments, and a row may follow. */
static dyd_status header_read(dyd_csv *csv, char delimiter, dyd_error *err) {
  const bool numbered = all_numbered(csv);
  bool commented = false;
  size_t fields = 0; /* of the last comment, in which columns are missing, as `before` says */
  dyd_error before;
  for (;;) {
    dyd_text_line line;
    dyd_status st = csv_record(&line, csv, err);
    if (st != DYD_OK) return st;
    if (!line.text) break;
    char told = delimiter_line(&line);
    const bool comment = dyd_line_is_comment(&line);
    if (told && !delimiter) delimiter = told;
    commented = commented || comment;
    if (told || (comment && numbered)) continue;
    st = header_take(csv, &line, delimiter, commented, err);
    if (st != DYD_E_PARSE) return st;
    if (!comment) {
      if (err && fields && fields == csv->fields) *err = before;
      header_seek(csv, delimiter, err);
      return st;
    }
    if (err) before = *err;
    fields = csv->fields;
  }
  csv->fields = 0;
  if (err) err->line = err->column = 1;
  return csv->headless ? DYD_OK
                       : dyd_fail(err, DYD_E_PARSE, "the file has no header; its first line must name the columns");
}

/* Passes over the row behind the header; it may state the unit of radii. */
static dyd_status units_read(dyd_csv *csv, dyd_error *err) {
  dyd_span field[DYD_CSV_MOST];
  dyd_plain p;
  size_t count;
  dyd_status st = dyd_csv_next(field, &count, csv, err);
  if (st != DYD_OK || !count) return st;
  if (dyd_plain_scan(&p, field[DYD_CSV_X].text, field[DYD_CSV_X].length))
    return dyd_span_fail(err, &field[DYD_CSV_X], 0, "this row holds numbers, not units; remove `units_row`");
  for (int role = DYD_CSV_X; role < csv->roles; role++) {
    const dyd_span *f = csv->want[role].name ? &field[role] : NULL;
    const dyd_unit *unit = f ? dyd_unit_find(f->text, f->length) : NULL;
    if (f && !unit) unit = dyd_unit_of_column(f->text, f->length);
    if (unit && csv->unit[role] && unit != csv->unit[role])
      return dyd_span_fail(err, f, 0, "the name of this column states another unit; correct one of the two");
    if (unit) csv->unit[role] = unit;
  }
  return dyd_names_agree(&field[DYD_CSV_Y], csv->unit[DYD_CSV_X], csv->unit[DYD_CSV_Y], err);
}

dyd_status dyd_csv_open(dyd_csv *csv, const char *delimiter, bool degrees, dyd_error *err) {
  char given;
  dyd_status st = read_delimiter(&given, delimiter, err);
  csv->comments = csv->headless;
  if (st == DYD_OK) st = header_read(csv, given, err);
  csv->comments = true;
  csv->columns = csv->fields;
  csv->fresh = true;
  csv->trails = csv->fields > 1 && !csv->headless && !csv->field[csv->fields - 1].length;
  csv->held = csv->headless && csv->fields;
  if (st == DYD_OK && !csv->headless) st = dyd_names_mean(csv, degrees, err);
  if (st == DYD_OK) st = carry_find(csv, err);
  return st == DYD_OK && csv->units_row ? units_read(csv, err) : st;
}

/* ---- a file that is taken for a points file ---- */

/* Returns true if there are words, or quoted fields, and no others but empty ones. */
static bool is_header(const dyd_csv *csv) {
  size_t words = 0, others = 0;
  for (size_t k = 0; k < csv->fields; k++) {
    const dyd_span *f = &csv->field[k];
    const bool word = f->text != f->at || (f->length && !memchr("0123456789+-.([{", f->text[0], 16));
    words += word;
    others += !word && f->length;
  }
  return words && !others && csv->fields > 1;
}

/* Sets the columns of x and y by their names, else (row is not NULL) to the first two that hold numbers in the row
 * behind the header, or twice to one of WKT; false: none of these tells. */
static bool guess_columns(dyd_csv *csv, const dyd_csv *row) {
  size_t *k = csv->column, found = 0;
  dyd_plain p;
  for (int a = DYD_CSV_X; a <= DYD_CSV_Y; a++)
    for (k[a] = 0; k[a] < csv->fields && !dyd_name_is_axis(&csv->field[k[a]], a);) k[a]++;
  if (k[0] < csv->fields && k[1] < csv->fields && k[0] != k[1]) return true;
  for (size_t f = 0; row && f < csv->fields && f < row->fields && found < 2; f++) {
    const dyd_span *cell = &row->field[f];
    const bool wkt = cell->length > 5 && dyd_same_name(cell->text, "POINT", 5);
    if (wkt && dyd_kind_of_cell(cell->text, cell->length)) k[0] = k[1] = f, found = 2;
    if (found < 2 && dyd_plain_scan(&p, cell->text, cell->length)) k[found++] = f;
  }
  return found == 2;
}

/* The line, a copy, separated by d. skip: how many lines are before it. */
static bool hint_with(dyd_csv *csv, dyd_csv *row, char d, const dyd_text_line *line, const dyd_text_line *next,
                      size_t skip, dyd_text *text, dyd_error *err) {
  char names[110], two[160], lines[40] = "", message[DYD_MESSAGE_SIZE];
  size_t used = strlen(err->message);
  if (header_split(csv, line, d, NULL) != DYD_OK || !is_header(csv) || (skip && !guess_columns(csv, NULL)))
    return false;
  if (!next->text || header_split(row, next, d, NULL) != DYD_OK) row->fields = 0;
  list_names(names, sizeof names, csv);
  const bool guessed = guess_columns(csv, row);
  strcpy(two, "X,Y");
  if (guessed) dyd_names_put(two, &csv->field[csv->column[DYD_CSV_X]], &csv->field[csv->column[DYD_CSV_Y]]);
  for (size_t k = 0; k < row->fields && !guessed; k++)
    if ((text->kind = dyd_kind_of_cell(row->field[k].text, row->field[k].length)))
      return dyd_kind_fail(err, text->kind), true;
  if (skip) snprintf(lines, sizeof lines, "`skip_lines` %zu ", skip);
  if (!guessed || (csv->fields == 2 && !skip)) {
    snprintf(err->message + used, sizeof err->message - used,
             "; if this line is a header, name the columns of x and y: `columns` %s (it has: %s)", two, names);
    return guessed;
  }
  snprintf(message, sizeof message,
           "this line is a header and no point; name the columns of x and y: %s`columns` %s (it has: %s)", lines, two,
           names);
  header_fail(csv, 0, err, message);
  return true;
}

void dyd_csv_hint(dyd_error *err, const dyd_text_line *line, dyd_text *text) {
  DYD_SCOPED(dyd_csv) csv = {0}, row = {0};
  dyd_text_line next = *line;
  dyd_error own;
  const size_t used = strlen(err->message);
  bool found = false;
  if (delimiter_line(line) && dyd_text_next(&next, text, &own) != DYD_OK) next.text = NULL;
  const size_t first = next.number;
  for (int k = 0; k < LOOKED_AT && next.text && !found; k++) {
    DYD_FREED char *copy = dyd_alloc(next.length + 1, 1);
    if (!copy) break;
    memcpy(copy, next.text, next.length);
    const dyd_text_line here = {copy, next.length, next.number};
    if (dyd_text_next(&next, text, &own) != DYD_OK) next.text = NULL;
    for (const char *d = delimiters; *d && !found && (here.number > first || strlen(err->message) == used); d++)
      found = hint_with(&csv, &row, *d, &here, &next, here.number == first ? 0 : here.number - 1, text, err);
  }
}

/* Rows of fields: small tables that accompany the points, by the readers of lines and of separated text. */

/* Fields between runs of blanks, commas and semicolons, up to a comment; quotes mean nothing. */
static dyd_status rows_split_runs(dyd_csv *csv, const dyd_text_line *line, dyd_error *err) {
  static const bool between[256] = {[' '] = true, ['\t'] = true, [','] = true, [';'] = true, ['\r'] = true};
  const char *at = line->text, *end = dyd_line_is_comment(line) ? at : at + line->length;
  for (csv->fields = 0;; csv->fields++) {
    while (at < end && between[(unsigned char)*at]) at++;
    if (at == end || *at == '#') return DYD_OK;
    if (!DYD_GROW(csv->field, csv->field_cap, csv->fields + 1)) return dyd_fail_nomem(err);
    const char *from = at;
    while (at < end && *at != '#' && !between[(unsigned char)*at]) at++;
    csv->field[csv->fields] = (dyd_span){from, (size_t)(at - from), from, line->text, line->number};
  }
}

/* Of the line: what separates most formats of tables, the first that it holds. */
static char rows_delimiter(const dyd_text_line *line) {
  for (const char *c = ",;\t|"; *c; c++)
    if (memchr(line->text, *c, line->length)) return *c;
  return ' ';
}

/* The next row that has fields; csv->fields = 0 at the end. */
static dyd_status rows_next(dyd_csv *csv, dyd_error *err) {
  dyd_text_line line;
  for (csv->fields = 0; csv->fields == 0;) {
    dyd_status st = csv->delimiter == ' ' ? dyd_text_next(&line, csv->text, err) : csv_record(&line, csv, err);
    if (st != DYD_OK || !line.text) return st;
    if (!csv->delimiter) csv->delimiter = rows_delimiter(&line);
    st = csv->delimiter == ' ' ? rows_split_runs(csv, &line, err) : csv_split(csv, &line, err);
    if (st != DYD_OK) return st;
  }
  for (size_t k = 0; k < csv->fields; k++) span_trim(&csv->field[k]);
  return DYD_OK;
}

dyd_status dyd_read_records(FILE *in, char delimiter, dyd_record_fn row, void *user, dyd_error *err) {
  DYD_SCOPED(dyd_text) text;
  DYD_SCOPED(dyd_csv) csv = {.text = &text, .delimiter = delimiter, .comments = true};
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
  return st;
}

const char *dyd_record_field(size_t *length, const dyd_record *row, size_t k) {
  const dyd_span *field = row->field;
  *length = k < row->fields ? field[k].length : 0;
  return k < row->fields ? field[k].text : NULL;
}

void dyd_record_place(dyd_error *err, const dyd_record *row, size_t k) {
  const dyd_span *field = row->field;
  const bool behind = k >= row->fields;
  const dyd_span *at = &field[behind ? row->fields - 1 : k];
  dyd_span_position(&err->line, &err->column, at, behind ? at->length : 0);
}

void dyd_csv_clear(dyd_csv *csv) {
  for (int k = 0; k < DYD_CSV_MOST; k++) free(csv->want[k].name);
  dyd_free_all(csv->carried, csv->names, csv->record, csv->plain, csv->field);
  *csv = (dyd_csv){0};
}

/* ---- records ---- */

static bool is_blank_line(const dyd_text_line *line) {
  for (size_t k = 0; k < line->length; k++)
    if (!dyd_is_gap(line->text[k])) return false;
  return true;
}

bool dyd_line_is_comment(const dyd_text_line *line) {
  const char *at = line->text, *end = at + line->length;
  while (at < end && dyd_is_gap(*at)) at++;
  return at < end && (*at == '%' || (*at == '#' && !dyd_is_sheet_error(at, (size_t)(end - at))));
}

bool dyd_is_sheet_error(const char *text, size_t length) {
  static const char *const known[] = {"#N/A", "#VALUE!", "#REF!", "#DIV/0!", "#NUM!", "#NAME?", "#NULL!"};
  for (size_t k = 0; k < sizeof known / sizeof *known; k++)
    if (length >= strlen(known[k]) && memcmp(text, known[k], strlen(known[k])) == 0) return true;
  return false;
}

/* Returns true if a quoted field is open behind the text, which begins within one (inside) or with a field. */
static bool leaves_quote_open(bool inside, const char *text, size_t length, char delimiter) {
  bool begin = true;
  if (!memchr(text, '"', length)) return inside;
  for (const char *end = text + length; text < end; text++) {
    if (inside && *text == '"' && text + 1 < end && text[1] == '"')
      text++;
    else if (*text == '"' && (inside || begin))
      inside = !inside;
    begin =
        (begin && (*text == ' ' || *text == '=')) || (delimiter ? *text == delimiter : *text && strchr(",;\t|", *text));
    if (delimiter == ' ' && *text == '\t') begin = true;
  }
  return inside;
}

static dyd_status record_append(dyd_csv *csv, size_t *length, const dyd_text_line *line, dyd_error *err) {
  if (*length + line->length > DYD_TEXT_LINE_MAX) {
    dyd_span span = {line->text, 0, line->text, line->text, line->number};
    return dyd_span_fail(err, &span, 0, "a quoted field is longer than 1048576 bytes; close its quote");
  }
  if (!dyd_reserve((void **)&csv->record, &csv->record_cap, *length + line->length + 1, 1)) return dyd_fail_nomem(err);
  if (*length) csv->record[(*length)++] = '\n';
  memcpy(csv->record + *length, line->text, line->length);
  *length += line->length;
  return DYD_OK;
}

/* Appends lines until the quoted field is closed. */
static dyd_status record_join_lines(dyd_text_line *out, dyd_csv *csv, dyd_error *err) {
  size_t length = 0, first = out->number;
  dyd_status st = record_append(csv, &length, out, err);
  for (bool open = true; open && st == DYD_OK;) {
    st = dyd_text_next(out, csv->text, err);
    if (st != DYD_OK) break;
    if (!out->text) {
      dyd_span span = {csv->record, 0, csv->record, csv->record, first};
      return dyd_span_fail(err, &span, (size_t)((char *)memchr(csv->record, '"', length) - csv->record),
                           "the quotes of this record do not pair up; close the quoted field");
    }
    open = leaves_quote_open(true, out->text, out->length, csv->delimiter);
    st = record_append(csv, &length, out, err);
  }
  *out = (dyd_text_line){csv->record, length, first};
  return st;
}

/* ---- for the header ---- */

/* Counts a comment behind the header that would be a point without its mark. */
static dyd_status note_comment(dyd_csv *csv, const dyd_text_line *line, dyd_error *err) {
  dyd_plain p;
  if (!csv->columns || is_blank_line(line)) return DYD_OK;
  size_t mark = strcspn(line->text, "#%") + 1;
  const dyd_text_line rest = {line->text + mark, line->length - mark, line->number};
  dyd_status st = csv_split(csv, &rest, NULL);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  bool point = st == DYD_OK && csv->fields == csv->columns;
  for (int k = DYD_CSV_X; k <= DYD_CSV_Y && point; k++) {
    dyd_span *f = &csv->field[csv->column[k]];
    span_trim(f);
    point = dyd_plain_scan(&p, f->text, f->length);
  }
  csv->commented += point;
  return DYD_OK;
}

/* The next record that is not an empty line or a comment; text = NULL at the end. */
static dyd_status csv_record(dyd_text_line *out, dyd_csv *csv, dyd_error *err) {
  dyd_status st;
  for (;;) {
    st = dyd_text_next(out, csv->text, err);
    if (st != DYD_OK || !out->text) return st;
    if (csv->comments && dyd_line_is_comment(out))
      st = note_comment(csv, out, err);
    else if (!is_blank_line(out))
      break;
    if (st != DYD_OK) return st;
  }
  if (!leaves_quote_open(false, out->text, out->length, csv->delimiter)) return DYD_OK;
  return record_join_lines(out, csv, err);
}

/* ---- fields ---- */

static bool is_delimiter(const dyd_csv *csv, char c) {
  return c == csv->delimiter || (c == '\t' && csv->delimiter == ' ');
}

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
  for (*at = p + 1; *at < end && **at == ' ' && csv->delimiter != ' ';) ++*at;
  if (*at == end || is_delimiter(csv, **at)) return DYD_OK;
  return dyd_span_fail(err, field, (size_t)(*at - field->at),
                       "text behind a closing quote; double the quotes inside a quoted field");
}

static dyd_status record_field(dyd_span *field, const char **at, const char *end, dyd_csv *csv, dyd_error *err) {
  const char *first = *at;
  while (first < end && *first == ' ') first++;
  if (end - first > 1 && first[0] == '=' && first[1] == '"') first++; /* ="007", text to spreadsheets */
  if (first < end && *first == '"') {
    *at = first;
    return record_quoted_field(field, at, end, csv, err);
  }
  field->text = field->at = *at;
  const char *stop = csv->delimiter == ' ' ? *at : memchr(*at, csv->delimiter, (size_t)(end - *at));
  while (csv->delimiter == ' ' && stop < end && !is_delimiter(csv, *stop)) stop++;
  if (!stop) stop = end;
  field->length = (size_t)(stop - *at);
  const char *quote = memchr(*at, '"', field->length);
  while (quote && memchr("0123456789.'", quote[-1], 12)) /* seconds */
    quote = memchr(quote + 1, '"', (size_t)(stop - quote) - 1);
  *at = stop;
  if (!quote) return DYD_OK;
  return dyd_span_fail(err, field, (size_t)(quote - field->at),
                       "a quote inside a field that is not quoted; quote the whole field and double its quotes");
}

/* Splits it into csv->field. */
static dyd_status csv_split(dyd_csv *csv, const dyd_text_line *line, dyd_error *err) {
  const char *at = line->text, *end = line->text + line->length;
  csv->used = csv->fields = 0;
  if (!dyd_reserve((void **)&csv->plain, &csv->plain_cap, line->length, 1)) return dyd_fail_nomem(err);
  for (;;) {
    while (csv->delimiter == ' ' && at < end && dyd_is_gap(*at)) at++;
    if (csv->delimiter == ' ' && at == end) return DYD_OK;
    if (!DYD_GROW(csv->field, csv->field_cap, csv->fields + 1)) return dyd_fail_nomem(err);
    dyd_span *field = &csv->field[csv->fields++];
    *field = (dyd_span){.origin = line->text, .line = line->number};
    dyd_status st = record_field(field, &at, end, csv, err);
    if (st != DYD_OK || at == end) return st;
    at++;
  }
}

/* Takes off blanks at both ends, and what a spreadsheet puts around a text, as in ="007". */
static void span_trim(dyd_span *s) {
  while (s->length && dyd_is_gap(*s->text)) s->text++, s->at++, s->length--;
  while (s->length && dyd_is_gap(s->text[s->length - 1])) s->length--;
  if (s->length > 2 && s->text[0] == '=' && s->text[1] == '"' && s->text[s->length - 1] == '"')
    s->text += 2, s->at += 2, s->length -= 3;
}

/* ---- the next point ---- */

/* Static storage. */
static const char *delimiter_name(char delimiter) {
  static const char *const name[] = {"commas", "semicolons", "tabs", "bars", "blanks"};
  const char *found = strchr(delimiters, delimiter);
  return found ? name[found - delimiters] : "delimiters";
}

/* Returns true if the first record after the header has a matching number of fields. A lone comment mark in the header
 * is not a column if they are one less; the same holds for an empty last name. */
static bool fields_fit(dyd_csv *csv, bool first) {
  size_t last = 0;
  if (csv->fields == csv->columns + 1 && !csv->field[csv->columns].length) return csv->fields--, true;
  if (!first || csv->fields + 1 != csv->columns || (!csv->marked && !csv->trails)) return false;
  for (int k = 0; k < DYD_CSV_MOST; k++) {
    if (!csv->want[k].name) continue;
    csv->column[k] -= csv->marked && !is_numbered(&csv->want[k]);
    if (csv->column[k] > last) last = csv->column[k];
  }
  csv->columns = csv->fields;
  return last < csv->fields;
}

/* The record has another number of fields than the header. */
static dyd_status fail_fields(const dyd_csv *csv, bool first, dyd_error *err) {
  const dyd_span *f = csv->field, *last = &f[csv->fields - 1];
  const bool more = csv->fields > csv->columns, named = !csv->headless;
  const dyd_text_line line = {f->origin, (size_t)(last->at + last->length - f->origin), f->line};
  const char other = rows_delimiter(&line);
  char remedy[160];
  if (memchr(line.text, '\r', line.length))
    snprintf(remedy, sizeof remedy, "a CR alone ends a line in it: tr '\\r' '\\n' < FILE ends all lines alike");
  else if (more && first && csv->fields == csv->columns + 1 && named && dyd_is_gap(csv->delimiter))
    snprintf(remedy, sizeof remedy,
             "if the first column has no name, as R writes tables, give `skip_lines` %zu `no_header` and numbers to "
             "`columns`",
             f->line - 1);
  else if (csv->fields == 1 && other != ' ' && other != csv->delimiter)
    snprintf(remedy, sizeof remedy, "columns are separated by %s here, and by %s before; make all lines alike",
             delimiter_name(other), delimiter_name(csv->delimiter));
  else if (more)
    snprintf(remedy, sizeof remedy, "quote fields that hold %s%s", delimiter_name(csv->delimiter),
             named ? "" : ", or pass over lines before the table by `skip_lines`");
  else
    snprintf(remedy, sizeof remedy, "complete the line, or remove it%s",
             named ? "" : "; lines before the table are passed over by `skip_lines`");
  if (err) dyd_span_position(&err->line, &err->column, f, 0);
  return dyd_fail(err, DYD_E_PARSE, "this record has %zu field%s, the %s %zu; %s", csv->fields,
                  csv->fields == 1 ? "" : "s", named ? "header" : "first one", csv->columns, remedy);
}

/* A line below the header as |---|:--:|, ----+---- */
static bool is_rule(const dyd_text_line *line) {
  size_t run = 0, k = 0;
  for (; k < line->length && memchr("-=+|: \t", line->text[k], 7); k++)
    if (run < 3) run = memchr("-=", line->text[k], 2) ? run + 1 : 0;
  return k == line->length && run == 3;
}

static bool is_header_again(const dyd_csv *csv, const dyd_span field[DYD_CSV_MOST]) {
  for (int k = DYD_CSV_X; k <= DYD_CSV_Y; k++)
    if (csv->headless || !is_named(&field[k], csv->want[k].name, true) || is_numbered(&csv->want[k])) return false;
  return true;
}

dyd_status dyd_csv_next(dyd_span field[DYD_CSV_MOST], size_t *count, dyd_csv *csv, dyd_error *err) {
  dyd_text_line line;
  *count = 0;
  dyd_status st = csv->held ? DYD_OK : csv_record(&line, csv, err);
  if (st == DYD_OK && csv->fresh && !csv->held && line.text && is_rule(&line)) st = csv_record(&line, csv, err);
  if (st != DYD_OK || (!csv->held && !line.text)) return st;
  if (!csv->held) st = csv_split(csv, &line, err);
  const bool first = csv->fresh;
  csv->held = csv->fresh = false;
  if (st != DYD_OK) return st;
  if (csv->fields != csv->columns && !fields_fit(csv, first)) return fail_fields(csv, first, err);
  for (int k = 0; k < csv->roles; k++) {
    if (!csv->want[k].name) continue;
    field[k] = csv->field[csv->column[k]];
    span_trim(&field[k]);
  }
  *count = csv->columns;
  return is_header_again(csv, field)
             ? dyd_span_fail(err, &field[DYD_CSV_X], 0, "this line is the header again; remove it")
             : DYD_OK;
}
