/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points as lines of decimals: a rank reads the lines that begin in its slice of the file, once to count them and their
 * digits, and once for the numbers.
 *
 * Statuses stay what they are when all coordinates are multiplied by the same power of ten. Where that makes them whole
 * numbers of at most 15 digits, which doubles hold, points are exact; else each number becomes the interval between the
 * doubles next to it. */
#include "state.h"

#include <dyadel/stream.h>
#include <errno.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIGITS = 15, MOST_FIELDS = 4 };

/* mantissa / 10^after; before: its digits left of the point. Those of a longer one are wrong, but too many. */
typedef struct text_decimal {
  int64_t mantissa;
  long before, after;
} text_decimal;

/* A line that begins in the slice; where it does. */
typedef struct text_slice {
  const tile *t;
  FILE *in;
  char *line;
  size_t room;
  int64_t from, at, end;
} text_slice;

typedef struct text_field {
  const char *text;
  size_t length;
} text_field;

/* ---- numbers ---- */

static bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

static bool decimal_of(text_decimal *d, const text_field *f) {
  enum { ROOM = 18, FAR = 100000 };
  const char *c = f->text, *end = c + f->length;
  const bool negative = c < end && *c == '-';
  long digits = 0, shift = 0;
  bool point = false, any = false;
  *d = (text_decimal){0};
  for (c += c < end && (*c == '-' || *c == '+'); c < end && (is_digit(*c) || (*c == '.' && !point)); c++) {
    point |= *c == '.';
    if (*c == '.') continue;
    any = true;
    d->after += point;
    digits += digits || *c != '0';
    if (digits <= ROOM) d->mantissa = 10 * d->mantissa + (*c - '0');
  }
  if (c < end && (*c == 'e' || *c == 'E') && any) {
    const bool down = ++c < end && *c == '-';
    c += c < end && (*c == '-' || *c == '+');
    any = c < end;
    for (; c < end && is_digit(*c); c++) shift = shift < FAR ? 10 * shift + (*c - '0') : FAR;
    d->after += down ? shift : -shift;
  }
  if (digits == 0) d->after = 0;
  d->before = digits > d->after ? digits - d->after : 0;
  if (negative) d->mantissa = -d->mantissa;
  return any && c == end;
}

/* Times 10^after, a whole number of at most MOST_DIGITS digits. */
static double text_scaled(const text_decimal *d, long after) {
  double value = (double)d->mantissa; /* exact, and so is each product */
  for (long k = d->after; d->mantissa && k < after; k++) value *= 10;
  return value;
}

/* The double below, or above, unless it is the number. */
static double text_rounded(const text_field *f, bool up) {
  mpq_t exact, near;
  mpq_inits(exact, near, NULL);
  double value = NAN;
  if (dyd_real_parse_exact(exact, f->text, f->length) == DYD_OK) value = mpq_get_d(exact); /* towards 0 */
  if (isfinite(value)) {
    mpq_set_d(near, value);
    int side = mpq_cmp(near, exact);
    if (up ? side < 0 : side > 0) value = nextafter(value, up ? INFINITY : -INFINITY);
  }
  mpq_clears(exact, near, NULL);
  return value;
}

/* ---- lines ---- */

/* The line number is counted now that it matters. */
static dyd_status text_fail(const text_slice *s, const char *at, dyd_error *err, const char *what, const char *remedy) {
  unsigned long long line = 1;
  int c;
  rewind(s->in);
  for (int64_t k = 0; k < s->from && (c = getc(s->in)) != EOF; k++) line += c == '\n';
  return tiles_fail(err, DYD_E_PARSE, "%s:%llu:%zu: %s; %s", s->t->job->input, line, (size_t)(at - s->line) + 1, what,
                    remedy);
}

static dyd_status read_fail(const tile *t, dyd_error *err) {
  return tiles_fail(err, DYD_E_IO, "%s: cannot read: %s; every rank needs to see the file", t->job->input,
                    strerror(errno));
}

static dyd_status slice_open(text_slice *s, const tile *t, dyd_error *err) {
  const int64_t n = (int64_t)t->job->size, ranks = (int64_t)t->job->ranks, r = (int64_t)t->rank;
  *s = (text_slice){.t = t, .in = fopen(t->job->input, "rb")};
  s->at = n / ranks * r + (r < n % ranks ? r : n % ranks);
  s->end = s->at + n / ranks + (r < n % ranks);
  if (!s->in) return read_fail(t, err);
  if (s->at == 0) return DYD_OK;
  ssize_t got = fseeko(s->in, (off_t)s->at - 1, SEEK_SET) == 0 ? getline(&s->line, &s->room, s->in) : -1;
  if (got < 0) return read_fail(t, err);
  s->at += got - 1;
  return DYD_OK;
}

static void slice_close(text_slice *s) {
  if (s->in) fclose(s->in);
  free(s->line);
}

static size_t split_line(text_field field[MOST_FIELDS + 1], const char *line) {
  static const char between[] = ",; \t\r\n";
  size_t count = 0;
  for (line += strspn(line, between); *line && *line != '#' && count <= MOST_FIELDS; line += strspn(line, between)) {
    field[count++] = (text_field){line, strcspn(line, between)};
    line += field[count - 1].length;
  }
  return count;
}

/* The fields of the next point; *more: there is one. Empty lines, comments, and names of columns in the first line are
 * none. */
static dyd_status next_point(bool *more, text_field field[MOST_FIELDS + 1], text_slice *s, dyd_error *err) {
  const size_t wanted = s->t->job->boxes ? 4 : 2;
  for (*more = false; s->at < s->end;) {
    ssize_t got = getline(&s->line, &s->room, s->in);
    if (got < 0) return read_fail(s->t, err);
    s->from = s->at;
    s->at += got;
    size_t count = split_line(field, s->line);
    if (count == 0 || (s->from == 0 && strchr("+-.0123456789", *field[0].text) == NULL)) continue;
    *more = count == wanted;
    if (*more) return DYD_OK;
    return text_fail(s, count > wanted ? field[wanted].text : s->line, err, "not as many numbers as a point has",
                     wanted == 4 ? "--boxes reads xlo xhi ylo yhi"
                                 : "give x and y alone, or --boxes with four numbers");
  }
  return DYD_OK;
}

/* ---- steps ---- */

dyd_status tile_survey(tile *t, dyd_error *err) {
  tiles_survey own = {0};
  text_slice s = {0};
  text_field field[MOST_FIELDS + 1];
  bool more = false;
  if (!t->job->text) return DYD_OK;
  dyd_status st = slice_open(&s, t, err);
  if (st == DYD_OK) st = next_point(&more, field, &s, err);
  while (st == DYD_OK && more) {
    for (unsigned k = 0; k < (t->job->boxes ? 4 : 2); k++) {
      text_decimal d;
      if (!decimal_of(&d, &field[k])) {
        st = text_fail(&s, field[k].text, err, "not a decimal number", "dyadel reads other exact numbers");
        break;
      }
      own.before = d.before > own.before ? d.before : own.before;
      own.after = d.after > own.after ? d.after : own.after;
    }
    own.rows++;
    if (st == DYD_OK) st = next_point(&more, field, &s, err);
  }
  slice_close(&s);
  for (size_t r = 0; st == DYD_OK && r < t->job->ranks; r++)
    if (!tiles_mail_put(&t->out[r], &own, sizeof own)) st = tiles_no_memory(err);
  return st;
}

/* What all found; how many points are before those of this rank. */
static dyd_status take_surveys(tiles_survey *all, uint64_t *first, tile *t, dyd_error *err) {
  *all = (tiles_survey){0};
  for (size_t r = 0; r < t->job->ranks; r++) {
    tiles_survey one;
    size_t read = 0;
    if (!tiles_mail_take(&one, sizeof one, &t->in[r], &read))
      return tiles_fail(err, DYD_E_IO, "rank %zu: the mail of rank %zu is cut short; restart", t->rank, r);
    tiles_mail_clear(&t->in[r]);
    if (r == t->rank) *first = all->rows;
    all->rows += one.rows;
    all->before = one.before > all->before ? one.before : all->before;
    all->after = one.after > all->after ? one.after : all->after;
  }
  return DYD_OK;
}

/* The ends of a point: x y, or, of boxes and where doubles do not hold all, xlo xhi ylo yhi. */
static void text_ends(double end[4], const tile *t, const text_field *field, bool exact, long after) {
  const unsigned given = t->job->boxes ? 4 : 2;
  text_decimal d;
  for (unsigned k = 0; k < t->own.dim; k++) {
    const text_field *f = &field[k * given / t->own.dim];
    if (exact && decimal_of(&d, f)) end[k] = text_scaled(&d, after);
    if (!exact) end[k] = text_rounded(f, k & 1);
  }
}

dyd_status tile_read_text(tile *t, dyd_error *err) {
  tiles_survey all;
  uint64_t number = 0;
  text_slice s = {0};
  text_field field[MOST_FIELDS + 1];
  bool more = false;
  dyd_status st = take_surveys(&all, &number, t, err);
  const bool exact = all.before + all.after <= MOST_DIGITS;
  t->points = all.rows;
  if (!exact) t->own.dim = t->ghosts.dim = t->fringe.dim = 4;
  if (st == DYD_OK) st = slice_open(&s, t, err);
  if (st == DYD_OK) st = next_point(&more, field, &s, err);
  for (; st == DYD_OK && more; number++) {
    double end[4] = {0};
    text_ends(end, t, field, exact, all.after);
    if (!isfinite(end[0] + end[1]) || !isfinite(end[2] + end[3]))
      st = text_fail(&s, s.line, err, "a number beyond doubles", "scale the points");
    else if (t->own.dim == 4 && (end[0] > end[1] || end[2] > end[3]))
      st = text_fail(&s, s.line, err, "the lower end is above the upper one", "--boxes reads xlo xhi ylo yhi");
    else if (!tiles_sites_add(&t->own, number, end))
      st = tiles_no_memory(err);
    if (st == DYD_OK) st = next_point(&more, field, &s, err);
  }
  slice_close(&s);
  return st;
}
