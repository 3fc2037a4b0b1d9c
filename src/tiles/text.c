/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points as lines of decimals: a rank reads the lines that begin in its slice of the file, by dyd_read_records, once to
 * count them and their digits, and once for the numbers.
 *
 * Statuses do not change when all coordinates are multiplied by the same power of ten. Where that makes them whole
 * numbers of at most 15 digits, which doubles hold, points are exact; else each number becomes the interval between the
 * doubles next to it. */
#include "base/local.h"
#include "dyadic/raw.h"
#include "stream/number.h"
#include "tiles/tiles.h"

#include <dyadel/io.h>
#include <errno.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_DIGITS = 15, MOST_FIELDS = 4 };

/* mantissa / 10^after; before: its digits left of the point. */
typedef struct text_decimal {
  int64_t mantissa, before, after;
} text_decimal;

typedef struct text_field {
  const char *text;
  size_t length;
} text_field;

/* The lines that begin in a slice, being read. */
typedef struct text_slice {
  tile *t;
  FILE *in;
  int64_t at, end; /* bytes of the file read, and how many the slice goes to */
  char last;       /* the byte before `at` */
  bool begun;      /* a record has been seen */
  bool exact;      /* of tile_read_text: all numbers are whole multiples of 10^-after */
  int64_t after;
  tiles_survey own;
  uint64_t number; /* of the next point */
} text_slice;

/* ---- numbers ---- */

static bool decimal_of(text_decimal *d, const text_field *f) {
  dyd_numeral n;
  *d = (text_decimal){0};
  if (!dyd_numeral_scan(&n, f->text, f->length, DYD_NUMBER_DECIMAL)) return false;
  if (!n.few) return d->before = MOST_DIGITS + 1, true; /* too many */
  if (n.man) d->after = (int64_t)n.fraction - n.exponent;
  for (uint64_t man = n.man; man; man /= 10) d->before++;
  d->before = d->before > d->after ? d->before - d->after : 0;
  d->mantissa = n.negative ? -(int64_t)n.man : (int64_t)n.man;
  return true;
}

/* Times 10^after, a whole number of at most MOST_DIGITS digits. */
static double text_scaled(const text_decimal *d, int64_t after) {
  double value = (double)d->mantissa; /* exact, and so is each product */
  for (int64_t k = d->after; d->mantissa && k < after; k++) value *= 10;
  return value;
}

/* The double below, or above, unless it is the number; NAN beyond the range of exponents. */
static double text_rounded(const text_field *f, bool up) {
  DYD_LOCAL_NUMBERS(mpq, exact);
  const bool known = dyd_real_parse_exact(exact, f->text, f->length) == DYD_OK;
  const dyd_round side = up ? DYD_UP : DYD_DOWN;
  return known ? dyd_raw_quotient_get_d(mpq_numref(exact), 0, mpq_denref(exact), side) : NAN;
}

/* ---- lines ---- */

static dyd_status read_fail(const tile *t, dyd_error *err) {
  return dyd_fail(err, DYD_E_IO, "%s: cannot read: %s; every rank needs to see the file", t->job->input,
                  strerror(errno));
}

/* Goes to the first line that begins in the slice. */
static dyd_status slice_open(text_slice *s, dyd_error *err) {
  const int64_t n = (int64_t)s->t->job->size, ranks = (int64_t)s->t->job->ranks, r = (int64_t)s->t->rank;
  s->in = fopen(s->t->job->input, "rb");
  s->at = n / ranks * r + (r < n % ranks ? r : n % ranks);
  s->end = s->at + n / ranks + (r < n % ranks);
  s->last = '\n';
  if (!s->in) return read_fail(s->t, err);
  if (s->at == 0) return DYD_OK;
  if (fseeko(s->in, (off_t)s->at - 1, SEEK_SET) != 0) return read_fail(s->t, err);
  for (int c = getc(s->in); c != '\n' && c != EOF; s->at++) c = getc(s->in);
  return ferror(s->in) ? read_fail(s->t, err) : DYD_OK;
}

/* The bytes of those lines, for dyd_file_of_callback; the last line ends behind the slice. */
static bool slice_get(size_t *got, void *user, char *bytes, size_t room) {
  text_slice *s = user;
  const int64_t left = s->end - s->at;
  *got = left > 0 ? fread(bytes, 1, (uint64_t)left < room ? (size_t)left : room, s->in) : 0;
  for (int c; left <= 0 && s->last != '\n' && *got < room && (c = getc(s->in)) != EOF; s->last = (char)c)
    bytes[(*got)++] = (char)c;
  s->at += (int64_t)*got;
  if (*got) s->last = bytes[*got - 1];
  return !ferror(s->in);
}

/* Of the file, where *err has the line of the slice. */
static void slice_count_lines(text_slice *s, dyd_error *err) {
  text_slice before = *s;
  before.in = NULL;
  dyd_error unused;
  if (slice_open(&before, &unused) == DYD_OK) {
    rewind(before.in);
    for (int64_t k = 0; k < before.at; k++) err->line += getc(before.in) == '\n';
  }
  if (before.in) fclose(before.in);
}

/* Calls fn for each record of the slice. */
static dyd_status slice_read(text_slice *s, dyd_record_fn fn, dyd_error *err) {
  FILE *lines = NULL;
  dyd_error why;
  dyd_error_clear(&why);
  dyd_status st = slice_open(s, err);
  if (st == DYD_OK) st = dyd_file_of_callback(&lines, NULL, slice_get, s, err);
  if (st == DYD_OK) {
    st = dyd_read_records(lines, ' ', fn, s, &why);
    if (st == DYD_E_PARSE) slice_count_lines(s, &why);
    if (st == DYD_E_PARSE) dyd_fail(err, st, "%s:%zu:%zu: %s", s->t->job->input, why.line, why.column, why.message);
    if (st != DYD_OK && st != DYD_E_PARSE) dyd_fail(err, st, "%s: %s", s->t->job->input, why.message);
  }
  if (lines) fclose(lines);
  if (s->in) fclose(s->in);
  return st;
}

/* Returns true if the field is a name, and nothing that a point of some kind may have for a number. */
static bool field_is_name(const text_field *f) {
  static const char *const missing[] = {"nan", "inf", "infinity", "na", "null", "none"};
  dyd_real *real = NULL;
  if (strchr("+-.0123456789[(", *f->text)) return false;
  for (size_t k = 0; k < sizeof missing / sizeof *missing; k++)
    if (strlen(missing[k]) == f->length && strncasecmp(f->text, missing[k], f->length) == 0) return false;
  const bool number = dyd_real_parse(&real, f->text, f->length, NULL) == DYD_OK;
  if (number) dyd_real_free(real);
  return !number;
}

static dyd_status text_fail(const dyd_record *record, size_t k, dyd_error *err, const char *message) {
  dyd_record_place(err, record, k);
  return dyd_error_set(err, DYD_E_PARSE, message);
}

/* The fields of a point; *point is false for the names of columns, in the first record of the file. */
static dyd_status point_fields(bool *point, text_field field[MOST_FIELDS], text_slice *s, const dyd_record *record,
                               dyd_error *err) {
  const size_t wanted = s->t->job->boxes ? 4 : 2;
  bool names = s->t->rank == 0 && !s->begun;
  for (size_t k = 0; k < wanted && k < record->fields; k++) {
    field[k].text = dyd_record_field(&field[k].length, record, k);
    names = names && field_is_name(&field[k]);
  }
  s->begun = true;
  *point = !names;
  if (names || record->fields == wanted) return DYD_OK;
  return text_fail(record, wanted, err,
                   wanted == 4
                       ? "not as many numbers as a point has; --boxes reads xlo xhi ylo yhi"
                       : "not as many numbers as a point has; give x and y alone, or --boxes with four numbers");
}

/* ---- steps ---- */

static dyd_status survey_record(void *user, const dyd_record *record, dyd_error *err) {
  text_slice *s = user;
  text_field field[MOST_FIELDS];
  text_decimal d;
  bool point;
  dyd_status st = point_fields(&point, field, s, record, err);
  if (st != DYD_OK || !point) return st;
  for (size_t k = 0; k < record->fields; k++) {
    if (!decimal_of(&d, &field[k]))
      return text_fail(record, k, err, "not a decimal number; dyadel reads other exact numbers");
    s->own.before = d.before > s->own.before ? d.before : s->own.before;
    s->own.after = d.after > s->own.after ? d.after : s->own.after;
  }
  s->own.rows++;
  return DYD_OK;
}

dyd_status tile_survey(tile *t, dyd_error *err) {
  text_slice s = {.t = t};
  if (!t->job->text) return DYD_OK;
  dyd_status st = slice_read(&s, survey_record, err);
  for (size_t r = 0; st == DYD_OK && r < t->job->ranks; r++)
    if (!tiles_mail_put(&t->out[r], &s.own, sizeof s.own)) st = tiles_no_memory(err);
  return st;
}

/* Adds up the surveys; *first: how many points are before those of this rank. */
static dyd_status take_surveys(tiles_survey *all, uint64_t *first, tile *t, dyd_error *err) {
  *all = (tiles_survey){0};
  for (size_t r = 0; r < t->job->ranks; r++) {
    tiles_survey one;
    size_t read = 0;
    if (!tiles_mail_take(&one, sizeof one, &t->in[r], &read))
      return dyd_fail(err, DYD_E_IO, "rank %zu: the mail of rank %zu is cut short; restart", t->rank, r);
    tiles_mail_clear(&t->in[r]);
    if (r == t->rank) *first = all->rows;
    all->rows += one.rows;
    all->before = one.before > all->before ? one.before : all->before;
    all->after = one.after > all->after ? one.after : all->after;
  }
  return DYD_OK;
}

/* The ends of a point: x y, or, of boxes and where doubles do not hold all, xlo xhi ylo yhi. */
static void text_ends(double end[4], const text_slice *s, const text_field *field) {
  const unsigned given = s->t->job->boxes ? 4 : 2, dim = s->t->own.dim;
  text_decimal d;
  for (unsigned k = 0; k < dim; k++) {
    const text_field *f = &field[k * given / dim];
    if (s->exact && decimal_of(&d, f)) end[k] = text_scaled(&d, s->after);
    if (!s->exact) end[k] = text_rounded(f, k & 1);
  }
}

static dyd_status place_record(void *user, const dyd_record *record, dyd_error *err) {
  text_slice *s = user;
  tiles_sites *own = &s->t->own;
  text_field field[MOST_FIELDS];
  double end[4] = {0};
  bool point;
  dyd_status st = point_fields(&point, field, s, record, err);
  if (st != DYD_OK || !point) return st;
  text_ends(end, s, field);
  if (!isfinite(end[0] + end[1]) || !isfinite(end[2] + end[3]))
    return text_fail(record, 0, err, "a number beyond doubles; scale the points");
  if (own->dim == 4 && (end[0] > end[1] || end[2] > end[3]))
    return text_fail(record, 0, err, "the lower end is above the upper one; --boxes reads xlo xhi ylo yhi");
  return tiles_sites_add(own, s->number++, end) ? DYD_OK
                                                : dyd_error_set(err, DYD_E_NOMEM, dyd_status_text(DYD_E_NOMEM));
}

dyd_status tile_read_text(tile *t, dyd_error *err) {
  tiles_survey all;
  text_slice s = {.t = t};
  dyd_status st = take_surveys(&all, &s.number, t, err);
  s.exact = all.before + all.after <= MOST_DIGITS;
  s.after = all.after;
  t->points = all.rows;
  if (!s.exact) t->own.dim = t->ghosts.dim = t->fringe.dim = 4;
  return st == DYD_OK ? slice_read(&s, place_record, err) : st;
}
