/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines of a points file without a header: a geometry as well-known text, whose places are points, or two coordinates.
 */
#include "base/local.h"
#include "io/read/csv.h"
#include "stream/degrees.h"
#include "stream/number.h"
#include <string.h>

static const char *const words[] = {"POINT",           "LINESTRING",   "POLYGON",           "MULTIPOINT",
                                    "MULTILINESTRING", "MULTIPOLYGON", "GEOMETRYCOLLECTION"};

static bool wkt_is_letter(const char *at, const char *end) {
  return at < end && (*at & ~0x20) >= 'A' && (*at & ~0x20) <= 'Z';
}

/* "POINT Z (" and "POINT EMPTY" begin a geometry, "Point,X,Y" and "point 1 2" do not. Returns what follows the
 * parenthesis or EMPTY; NULL: none begins. */
static const char *wkt_opens(const char *at, const char *end) {
  while (wkt_is_letter(at, end)) at++;
  while (at < end && memchr(" \tZMzm", *at, 6)) at++;
  if (at < end && *at == '(') return at + 1;
  return end - at >= 5 && memcmp(at, "EMPTY", 5) == 0 ? at + 5 : NULL;
}

/* The word begins the text, in any case, and no letter follows but Z and M ("PointZ"). */
static bool wkt_has_word(const char *at, const char *end, const char *word) {
  for (; *word; word++, at++)
    if (at == end || (*word >= 'A' ? *at & ~0x20 : *at) != *word) return false;
  if (word[-1] == '=' || word[-1] == ':') return true;
  for (const char *more = "ZM"; *more; more++) at += at < end && (*at & ~0x20) == *more;
  return !wkt_is_letter(at, end);
}

/* Returns which of the words begins the text; 7: none. */
static size_t wkt_word(const char *at, const char *end) {
  size_t k = 0;
  while (k < sizeof words / sizeof *words && !wkt_has_word(at, end, words[k])) k++;
  return k;
}

bool dyd_wkt_begin(dyd_wkt *w, const dyd_span *text) {
  *w = (dyd_wkt){.text = *text, .at = text->text, .end = text->text + text->length};
  while (w->at < w->end && dyd_is_blank(*w->at)) w->at++;
  if (w->at == w->end || *w->at < 'A') return false;
  if (wkt_has_word(w->at, w->end, "SRID=") || wkt_has_word(w->at, w->end, "EPSG:")) {
    w->srid = (dyd_span){.text = w->at + 5};
    while (w->at < w->end && *w->at++ != ';') {
    }
    w->srid.length = w->at > w->srid.text ? (size_t)(w->at - w->srid.text) - 1 : 0;
  }
  const size_t k = wkt_word(w->at, w->end), count = sizeof words / sizeof *words;
  for (const char *p = w->at; p < w->end && k < count && *p != '('; p++)
    w->rings |= wkt_has_word(p, w->end, "POLYGON") || wkt_has_word(p, w->end, "MULTIPOLYGON");
  w->point = k == 0;
  return k < count && wkt_opens(w->at, w->end) != NULL;
}

static dyd_span wkt_number(dyd_wkt *w) {
  while (w->at < w->end && dyd_is_blank(*w->at)) w->at++;
  const char *begin = w->at;
  while (w->at < w->end && !dyd_is_blank(*w->at) && !strchr(",()", *w->at)) w->at++;
  dyd_span s = w->text;
  s.text = begin;
  s.at = w->text.at + (begin - w->text.text);
  s.length = (size_t)(w->at - begin);
  return s;
}

static const dyd_span wkt_empty = {.text = "EMPTY", .length = 5};

static bool wkt_same(const dyd_span *a, const dyd_span *b) {
  return a->length && a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

/* Enters the next geometry of the text; several have commas between. false: there is none. */
static bool wkt_enter(dyd_wkt *w) {
  while (w->at < w->end && (dyd_is_blank(*w->at) || (w->inside && strchr(",;", *w->at)))) w->at++;
  w->inside = true;
  if (w->at == w->end || *w->at == '#') return false;
  const bool word = wkt_word(w->at, w->end) < sizeof words / sizeof *words;
  const char *behind = word ? wkt_opens(w->at, w->end) : NULL;
  if (behind)
    w->at = behind;
  else
    w->wrong = "there is more than a geometry on this line; if it is a table, name its column of geometries twice: "
               "`columns` G,G, or without a header `no_header` `columns` 1,1";
  return behind != NULL;
}

/* The place at w->at, between a parenthesis or comma and the next. false: it is a word, or wrong. */
static bool wkt_place(dyd_span place[2], dyd_wkt *w) {
  place[0] = wkt_number(w);
  place[1] = wkt_number(w);
  while (w->at < w->end && !strchr(",()", *w->at)) w->at++; /* z and m */
  const bool letter = wkt_is_letter(place[0].text, w->end);
  if (w->at < w->end && *w->at == '(' && letter) return false;
  if (w->at == w->end || *w->at == '(')
    w->wrong = "the parentheses of this geometry do not match; complete the line, or remove it";
  else if (letter && (wkt_same(&place[0], &wkt_empty) || wkt_same(&place[1], &wkt_empty)))
    place[0].length = place[1].length = 0;
  else if (!place[1].length)
    w->wrong = "this place has one coordinate only; two have a blank between, and commas separate places";
  return !w->wrong;
}

/* A geometry without places is a point that is missing. */
static bool wkt_missing(dyd_span place[2], dyd_wkt *w) {
  place[0] = place[1] = (dyd_span){w->at, 0, w->text.at + (w->at - w->text.text), w->text.origin, w->text.line};
  return true;
}

bool dyd_wkt_next(dyd_span place[2], dyd_wkt *w) {
  for (bool opened = false; !w->wrong;) { /* opened: a parenthesis, and nothing behind it */
    if (!w->depth) {
      if (!wkt_enter(w)) return false;
      w->depth = opened = w->at[-1] == '(';
      if (!opened) return wkt_missing(place, w);
    }
    const char c = w->at < w->end ? *w->at : 'x';
    if (strchr("(), \t\r\n", c)) {
      w->at++;
      w->depth += (c == '(') - (c == ')');
      if (opened && c == ')') return wkt_missing(place, w);
      if (!dyd_is_blank(c)) opened = c == '(';
      continue;
    }
    if (!wkt_place(place, w)) continue;
    if (opened) memcpy(w->first, place, sizeof w->first);
    if (w->rings && !opened && *w->at == ')' && wkt_same(&place[0], &w->first[0]) && wkt_same(&place[1], &w->first[1]))
      continue;
    return true;
  }
  return false;
}

/* One line of a points file: two coordinates separated by blanks or one comma, and a comment.
 *
 * Blanks and commas within parentheses or brackets belong to the coordinate. */

typedef struct wkt_cursor {
  const char *at, *end;
  const dyd_text_line *line;
  char comma; /* possible separators besides blanks */
} wkt_cursor;

static dyd_status points_fail(dyd_error *err, const wkt_cursor *c, const char *message) {
  dyd_span span = {c->at, 0, c->at, c->line->text, c->line->number};
  return dyd_span_fail(err, &span, 0, message);
}

/* Skips blanks; how many commas stood among them (0, 1, or 2 for "too many"). */
static int points_separator(wkt_cursor *c, int allowed) {
  int commas = 0;
  for (; c->at < c->end && (dyd_is_gap(*c->at) || *c->at == c->comma); c->at++)
    if (*c->at == c->comma && ++commas > allowed) return commas;
  return commas;
}

/* Characters that may end a coordinate or open a parenthesis in it. */
static const bool special[256] = {
    [' '] = true, ['\t'] = true, [','] = true, ['('] = true, [')'] = true, ['['] = true, [']'] = true};

/* From c->at up to a separator outside all parentheses. */
static dyd_span points_coordinate(wkt_cursor *c) {
  const char *begin = c->at;
  int depth = 0;
  for (; c->at < c->end; c->at++) {
    if (!special[(unsigned char)*c->at]) continue;
    if (*c->at == '(' || *c->at == '[') depth++;
    if ((*c->at == ')' || *c->at == ']') && depth > 0) depth--;
    if (depth == 0 && (dyd_is_gap(*c->at) || *c->at == c->comma)) break;
  }
  return (dyd_span){begin, (size_t)(c->at - begin), begin, c->line->text, c->line->number};
}

static bool is_degrees(const char *begin, const char *end) {
  char letter;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  return dyd_degrees_read(lo, hi, &letter, begin, (size_t)(end - begin), false, NULL) != DYD_E_ARG;
}

/* Degrees with blanks between minutes and seconds: the one place where both sides are such numbers. false: there is
 * none, or there are several. */
static bool degrees_split(dyd_span coordinate[2], const dyd_text_line *line, const char *end, char comma) {
  const char *begin = line->text, *found = NULL, *next = NULL;
  while (begin < end && dyd_is_gap(*begin)) begin++;
  for (const char *at = begin; at < end && end - begin < 200; at++) {
    if (!dyd_is_gap(*at) && *at != comma) continue;
    const char *left = at;
    int commas = 0;
    for (; at < end && (dyd_is_gap(*at) || *at == comma); at++) commas += *at == comma;
    if (commas > 1 || !is_degrees(begin, left) || !is_degrees(at, end)) continue;
    if (found) return false;
    found = left;
    next = at;
  }
  if (!found) return false;
  while (end > next && dyd_is_gap(end[-1])) end--;
  coordinate[0] = (dyd_span){begin, (size_t)(found - begin), begin, line->text, line->number};
  coordinate[1] = (dyd_span){next, (size_t)(end - next), next, line->text, line->number};
  return true;
}

dyd_status dyd_points_split(dyd_span coordinate[2], size_t *count, const dyd_text_line *line, char comma,
                            dyd_error *err) {
  const char *comment = memchr(line->text, '#', line->length);
  wkt_cursor c = {line->text, comment ? comment : line->text + line->length, line, comma};
  *count = 0;
  if (dyd_line_is_comment(line)) return DYD_OK;
  if (points_separator(&c, 0))
    return points_fail(err, &c, "a coordinate is missing before this comma; give two coordinates");
  if (c.at == c.end) return DYD_OK;
  coordinate[0] = points_coordinate(&c);
  if (points_separator(&c, 1) > 1)
    return points_fail(err, &c, "two commas in a row; separate the coordinates by one comma");
  if (c.at == c.end)
    return points_fail(err, &c,
                       memchr(line->text, ';', (size_t)(c.end - line->text))
                           ? "the line has one coordinate only; give two, separated by a blank or a comma instead of "
                             "';'"
                           : "the line has one coordinate only; give two, separated by a blank or a comma");
  coordinate[1] = points_coordinate(&c);
  int commas = points_separator(&c, 0);
  if ((commas || c.at < c.end) && !degrees_split(coordinate, line, c.end, comma))
    return points_fail(err, &c,
                       "more than two coordinates on this line; give two, and write expressions without blanks "
                       "outside parentheses");
  *count = 2;
  return DYD_OK;
}
