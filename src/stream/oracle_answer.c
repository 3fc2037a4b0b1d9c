/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the lines of an oracle program mean.
 *
 * An answer [lo,hi] must lie inside the rectangle K known so far [NEST-1]: that is asked of the rational ends. Only
 * then is it rounded outward to dyadics, and cut to K: K contains [lo,hi], so the cut does too, and it lies inside K
 * whatever the two roundings were [ORA-1]. */
#include "stream/oracle_answer.h"

#include "base/alloc.h"
#include "base/error.h"
#include "stream/number.h"
#include "stream/oracle_worker.h"
#include "stream/real.h"
#include <dyadel/sites.h>
#include <dyadel/stream.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A word of a line: text[begin, end). */
typedef struct word {
  size_t begin, end;
} word;

static bool answer_is_blank(char c) {
  return c == ' ' || c == '\t';
}

/* *w becomes the first word behind it; false: there is none. */
static bool next_answer_word(word *w, const char *line, size_t length) {
  size_t k = w->end;
  while (k < length && answer_is_blank(line[k])) k++;
  w->begin = k;
  while (k < length && !answer_is_blank(line[k])) k++;
  w->end = k;
  return w->begin < w->end;
}

/* The words of a line; returns their number, at most `most` + 1. */
static size_t split_answer(word *out, size_t most, const char *line, size_t length) {
  size_t n = 0;
  for (word w = {0, 0}; next_answer_word(&w, line, length);) {
    if (n == most) return most + 1;
    out[n++] = w;
  }
  return n;
}

static bool answer_word_is(const char *line, word w, const char *text) {
  return w.end - w.begin == strlen(text) && memcmp(line + w.begin, text, w.end - w.begin) == 0;
}

/* A whole number of at most nine digits. */
static bool read_answer_count(size_t *out, const char *line, word w) {
  size_t value = 0;
  if (w.end - w.begin > 9) return false;
  for (size_t k = w.begin; k < w.end; k++) {
    if (line[k] < '0' || line[k] > '9') return false;
    value = 10 * value + (size_t)(line[k] - '0');
  }
  *out = value;
  return true;
}

static dyd_status read_cost(double *out, const char *line, word w, size_t point, dyd_error *err) {
  char shown[80];
  mpq_t own;
  mpq_init(own);
  dyd_status st = dyd_parse_number(own, line + w.begin, w.end - w.begin, NULL);
  *out = st == DYD_OK ? mpq_get_d(own) : 0;
  mpq_clear(own);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (*out > 0 && isfinite(*out)) return DYD_OK;
  return dyd_fail(err, DYD_E_STREAM,
                  "the first line of the oracle program: the cost of point %zu, %s, is no exact number above 0; print "
                  "one such as 2 or 0.5",
                  point, dyd_quoted(shown, sizeof shown, line + w.begin, w.end - w.begin));
}

/* Those behind w. */
static dyd_status read_costs(double *cost, size_t count, const char *line, size_t length, word w, dyd_error *err) {
  size_t n = 0;
  for (; next_answer_word(&w, line, length); n++) {
    dyd_status st = n < count ? read_cost(&cost[n], line, w, n, err) : DYD_OK;
    if (st != DYD_OK) return st;
  }
  if (n == count) return DYD_OK;
  return dyd_fail(err, DYD_E_STREAM,
                  "the first line of the oracle program has %zu points and %zu costs; print one for each point, or "
                  "\"points %zu\" alone",
                  count, n, count);
}

dyd_status dyd_oracle_read_count(size_t *out, double **cost, const char *line, size_t length, dyd_error *err) {
  word w[3];
  size_t count, words = split_answer(w, 3, line, length);
  char shown[80];
  const bool costs = words > 2 && answer_word_is(line, w[2], "cost");
  if ((words != 2 && !costs) || !answer_word_is(line, w[0], "points") || !read_answer_count(&count, line, w[1]) ||
      count > DYD_MAX_SITES) {
    return dyd_fail(err, DYD_E_STREAM,
                    "the first line of the oracle program is %s; print \"points N\", with the number "
                    "of points",
                    dyd_quoted(shown, sizeof shown, line, length));
  }
  double *own = costs ? dyd_alloc(count < length ? count : length, sizeof *own) : NULL;
  if (costs && !own) return dyd_fail_nomem(err);
  dyd_status st = costs ? read_costs(own, count, line, length, w[2], err) : DYD_OK;
  if (st != DYD_OK) {
    free(own);
    return st;
  }
  *out = count;
  *cost = own;
  return DYD_OK;
}

/* ---- answers ---- */

static dyd_status read_answer_end(mpq_t out, const char *line, word w, dyd_error *err) {
  dyd_error own;
  char shown[80];
  dyd_error_clear(&own);
  dyd_status st = dyd_parse_number(out, line + w.begin, w.end - w.begin, &own);
  if (st == DYD_OK || st == DYD_E_NOMEM || st == DYD_E_RANGE) {
    return st != DYD_OK ? dyd_fail(err, st, "%s", own.message) : st;
  }
  return dyd_fail(err, DYD_E_STREAM, "%s, column %zu of its answer, is not an exact number: %s",
                  dyd_quoted(shown, sizeof shown, line + w.begin, w.end - w.begin), dyd_text_column(line, w.begin),
                  own.message);
}

/* Is [lo,hi] inside *known? */
static bool ends_are_inside(const mpq_t lo, const mpq_t hi, const dyd_interval *known) {
  mpq_t a, b;
  mpq_inits(a, b, NULL);
  dyd_interval_get_q(a, b, known);
  bool inside = mpq_cmp(a, lo) <= 0 && mpq_cmp(hi, b) <= 0;
  mpq_clears(a, b, NULL);
  return inside;
}

/* *side comes in as what is known (known) and goes out as the new side. */
static dyd_status set_answer_side(dyd_interval *side, bool known, const char *name, const mpq_t lo, const mpq_t hi,
                                  dyd_error *err) {
  dyd_interval next;
  dyd_interval_init(&next);
  dyd_status st = dyd_interval_fix(&next, lo, hi);
  if (st != DYD_OK)
    dyd_fail(err, st, "the %s of its answer: %s", name, dyd_status_text(st));
  else if (known && !ends_are_inside(lo, hi, side))
    st = dyd_nesting_fail(err, name, side, &next);
  else if (known && (st = dyd_interval_intersect(&next, side, &next)) != DYD_OK)
    dyd_fail(err, st, "the %s of its answer: %s", name, dyd_status_text(st));
  if (st == DYD_OK) dyd_interval_swap(side, &next);
  dyd_interval_clear(&next);
  return st;
}

static dyd_status read_answer_ends(mpq_t end[4], const char *line, const word *w, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (int k = 0; st == DYD_OK && k < 4; k++) st = read_answer_end(end[k], line, w[k], err);
  return st;
}

/* *r comes in as what is known (known) and goes out as the rectangle of the four ends, which are to be in order. */
static dyd_status take_answer_ends(dyd_rect *r, bool known, const mpq_t end[4], dyd_error *err) {
  dyd_rect next;
  for (int k = 0; k < 4; k += 2) {
    if (mpq_cmp(end[k], end[k + 1]) <= 0) continue;
    return dyd_fail(err, DYD_E_STREAM,
                    "the lower end of the %c side in its answer is above the upper end; exchange them", k ? 'y' : 'x');
  }
  dyd_rect_init(&next);
  dyd_rect_set(&next, r);
  dyd_status st = set_answer_side(&next.x, known, "x side", end[0], end[1], err);
  if (st == DYD_OK) st = set_answer_side(&next.y, known, "y side", end[2], end[3], err);
  if (st == DYD_OK) dyd_rect_swap(r, &next);
  dyd_rect_clear(&next);
  return st;
}

static dyd_status read_answer_rect(dyd_rect *r, bool known, const char *line, const word *w, dyd_error *err) {
  mpq_t end[4];
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  dyd_status st = read_answer_ends(end, line, w, err);
  if (st == DYD_OK) st = take_answer_ends(r, known, (const mpq_t *)end, err);
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  return st;
}

/* The four ends behind `before` words, and whether they are fixed. */
static dyd_status read_answer(dyd_rect *r, bool known, size_t before, const char *form, const char *line, size_t length,
                              dyd_error *err) {
  word w[6];
  char shown[80];
  size_t words = split_answer(w, before + 5, line, length);
  bool fixed = words == before + 5 && answer_word_is(line, w[before + 4], "fixed");
  if (words != before + 4 && !fixed) {
    return dyd_fail(err, DYD_E_STREAM, "its answer %s has not the %s (and \"fixed\", if it is)",
                    dyd_quoted(shown, sizeof shown, line, length), form);
  }
  dyd_status st = read_answer_rect(r, known, line, w + before, err);
  return st != DYD_OK || !fixed ? st : DYD_FIXED;
}

dyd_status dyd_oracle_read_answer(dyd_rect *r, bool known, const char *line, size_t length, dyd_error *err) {
  return read_answer(r, known, 1, "five words I XLO XHI YLO YHI", line, length, err);
}

/* A point that is known exactly is not asked for again: then r is what a callback is given at first. */
dyd_status dyd_rect_narrow_text(dyd_rect *r, const char *text, size_t length, dyd_error *err) {
  return read_answer(r, !dyd_rect_is_point(r), 0, "four words XLO XHI YLO YHI", text, length, err);
}

dyd_status dyd_rect_narrow_q(dyd_rect *r, const mpq_t end[4], dyd_error *err) {
  return take_answer_ends(r, !dyd_rect_is_point(r), end, err);
}
