/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Degrees, minutes and seconds as people write them, as exact rationals.
 *
 * [letter] [sign] number mark [number mark [number mark]] [letter], with blanks between them. Either a mark or a letter
 * identifies this form: marks may be replaced by blanks or colons, so that "47 36 18.3" alone is not read. */
#include "stream/degrees.h"

#include "base/local.h"
#include "stream/number.h"

#include <string.h>

enum { PARTS = 3 };

/* Marks after degrees, minutes and seconds; longer ones first. */
static const char *const marks[PARTS][8] = {{"\xC2\xB0", "\xC2\xBA", "\xCB\x9A", "d"},
                                            {"'", "\xE2\x80\xB2", "\xE2\x80\x99", "\xE2\x80\x98", "\xC2\xB4", "`"},
                                            {"\"", "''", "\xE2\x80\xB3", "\xE2\x80\x9D", "\xE2\x80\x9C",
                                             "\xE2\x80\xB2\xE2\x80\xB2", "\xE2\x80\x99\xE2\x80\x99",
                                             "\xC2\xB4\xC2\xB4"}};

/* The parts read so far: parts[] in the order of the text, each in 60^-unit degrees. */
typedef struct degrees {
  const char *text, *at, *end;
  char letter;
  bool negative, marked, colon, gap; /* a part ended by a mark; by a colon; by nothing but blanks */
  size_t count, unit[PARTS];
  dyd_numeral number[PARTS];
} degrees;

static bool degrees_take(degrees *d, const char *word) {
  size_t n = strlen(word);
  if ((size_t)(d->end - d->at) < n || memcmp(d->at, word, n) != 0) return false;
  d->at += n;
  return true;
}

static void degrees_blanks(degrees *d) {
  while (degrees_take(d, " ") || degrees_take(d, "\t") || degrees_take(d, "\xC2\xA0")) continue;
}

/* A letter, in small only behind marks, which no name is. */
static void degrees_letter(degrees *d) {
  const char *found = d->letter || d->at == d->end || !*d->at ? NULL : strchr(d->marked ? "NSEWnsew" : "NSEW", *d->at);
  if (!found) return;
  d->letter = (char)(*found & ~0x20);
  d->at++;
  degrees_blanks(d);
}

/* The unit of the mark here; PARTS: no mark. */
static size_t degrees_mark(degrees *d) {
  for (size_t u = PARTS; u-- > 0;)
    for (size_t k = 0; k < sizeof marks[u] / sizeof *marks[u] && marks[u][k]; k++)
      if (degrees_take(d, marks[u][k])) return u;
  return PARTS;
}

/* Digits with at most one point, and the mark after them. */
static bool degrees_part(degrees *d) {
  const size_t least = d->count ? d->unit[d->count - 1] + 1 : 0;
  if (d->count == PARTS || least == PARTS) return false;
  dyd_numeral *n = &d->number[d->count];
  if (!dyd_literal_scan(n, d->text, (size_t)(d->end - d->text), (size_t)(d->at - d->text), DYD_NUMBER_POINT))
    return false;
  const char *behind = d->at = d->text + n->end;
  degrees_blanks(d);
  size_t unit = degrees_mark(d);
  if (unit < PARTS)
    d->marked = true;
  else if (degrees_take(d, ":"))
    d->colon = true;
  else
    d->gap = d->gap || (d->at > behind && d->at < d->end && *d->at >= '0' && *d->at <= '9');
  d->unit[d->count++] = unit < PARTS ? unit : least;
  degrees_blanks(d);
  return d->unit[d->count - 1] >= least && d->unit[0] == 0;
}

/* Returns true if the text is of this form, whatever its numbers are. */
static bool degrees_scan(degrees *d) {
  degrees_blanks(d);
  degrees_letter(d);
  d->negative = degrees_take(d, "-") || degrees_take(d, "\xE2\x88\x92");
  if (!d->negative) degrees_take(d, "+");
  degrees_blanks(d);
  do {
    if (!degrees_part(d)) return false;
  } while (d->at < d->end && ((*d->at >= '0' && *d->at <= '9') || *d->at == '.'));
  degrees_letter(d);
  if (d->count == 1 && d->marked && memchr(d->text, 'd', (size_t)(d->end - d->text))) return false;
  bool colons = d->colon && d->count > 1 && !d->gap;
  return d->at == d->end && (d->marked || d->letter || colons) && (!d->colon || (!d->marked && colons));
}

/* Appends part k to the sum; sets half to half a unit of its last digit. */
static dyd_status degrees_add(mpq_t sum, mpq_t half, const degrees *d, size_t k, dyd_error *err) {
  static const unsigned long in_degree[PARTS] = {1, 60, 3600};
  static const char *const name[PARTS] = {"degrees", "minutes", "seconds"};
  const dyd_numeral *n = &d->number[k];
  const size_t at = n->first, unit = d->unit[k];
  if (k + 1 < d->count && !n->integer)
    return dyd_text_fail(err, DYD_E_PARSE, d->text, at, "only the last number may have decimals: write whole %s",
                         name[unit]);
  DYD_LOCAL_NUMBERS(mpq, part);
  dyd_status st = dyd_literal_value(part, n);
  if (st == DYD_OK && unit && mpq_cmp_ui(part, 60, 1) >= 0)
    st = dyd_text_fail(err, DYD_E_PARSE, d->text, at, "%s are below 60", name[unit]);
  else if (st != DYD_OK)
    st = dyd_text_fail(err, st, d->text, at, "%s", dyd_status_text(st));
  mpz_mul_ui(mpq_denref(part), mpq_denref(part), in_degree[unit]);
  mpq_canonicalize(part);
  mpq_add(sum, sum, part);
  mpz_ui_pow_ui(mpq_denref(half), 10, n->fraction);
  mpz_mul_ui(mpq_denref(half), mpq_denref(half), 2 * in_degree[unit]);
  mpz_set_ui(mpq_numref(half), 1);
  return st;
}

static dyd_status degrees_range(const mpq_t sum, const degrees *d, dyd_error *err) {
  bool latitude = d->letter == 'N' || d->letter == 'S';
  if (d->negative && d->letter)
    return dyd_text_fail(err, DYD_E_PARSE, d->text, 0, "a minus and the letter %c: remove one of them", d->letter);
  if (d->letter && mpq_cmp_ui(sum, latitude ? 90 : 360, 1) > 0)
    return dyd_text_fail(err, DYD_E_PARSE, d->text, 0, "beyond %d degrees; correct it", latitude ? 90 : 360);
  return DYD_OK;
}

dyd_status dyd_degrees_read(mpq_t lo, mpq_t hi, char *letter, const char *text, size_t length, bool measured,
                            dyd_error *err) {
  degrees d = {.text = text, .at = text, .end = text + length};
  if (!degrees_scan(&d)) return DYD_E_ARG;
  DYD_LOCAL_NUMBERS(mpq, half);
  mpq_set_ui(lo, 0, 1);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < d.count && st == DYD_OK; k++) st = degrees_add(lo, half, &d, k, err);
  if (st == DYD_OK) st = degrees_range(lo, &d, err);
  if (d.negative || d.letter == 'S' || d.letter == 'W') mpq_neg(lo, lo);
  mpq_set(hi, lo);
  if (measured) mpq_sub(lo, lo, half);
  if (measured) mpq_add(hi, hi, half);
  *letter = d.letter;
  return st;
}
