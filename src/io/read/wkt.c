/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines of a points file without a header: a geometry as well-known text, whose places are points, or two coordinates.
 */
#include "base/error.h"
#include "io/read/csv.h"
#include "stream/degrees.h"
#include <string.h>

static const char *const words[] = {"POINT",           "LINESTRING",   "POLYGON",           "MULTIPOINT",
                                    "MULTILINESTRING", "MULTIPOLYGON", "GEOMETRYCOLLECTION"};

/* "POINT Z (" and "POINT EMPTY" begin a geometry, "Point,X,Y" and "point 1 2" do not. */
static bool wkt_opens(const char *at, const char *end) {
  while (at < end && ((*at & ~0x20) >= 'A' && (*at & ~0x20) <= 'Z')) at++;
  while (at < end && memchr(" \tZMzm", *at, 6)) at++;
  return at < end && (*at == '(' || (end - at >= 5 && memcmp(at, "EMPTY", 5) == 0));
}

/* The word begins the text, in any case, and no letter follows. */
static bool wkt_has_word(const char *at, const char *end, const char *word) {
  for (; *word; word++, at++)
    if (at == end || (*word >= 'A' ? *at & ~0x20 : *at) != *word) return false;
  return at == end || word[-1] == '=' || word[-1] == ':' || !((*at & ~0x20) >= 'A' && (*at & ~0x20) <= 'Z');
}

static bool wkt_is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool dyd_wkt_begin(dyd_wkt *w, const dyd_span *text) {
  size_t k = 0, count = sizeof words / sizeof *words;
  *w = (dyd_wkt){.text = *text, .at = text->text, .end = text->text + text->length};
  while (w->at < w->end && wkt_is_blank(*w->at)) w->at++;
  if (w->at == w->end || *w->at < 'A') return false;
  if (wkt_has_word(w->at, w->end, "SRID=") || wkt_has_word(w->at, w->end, "EPSG:")) {
    w->srid = (dyd_span){.text = w->at + 5};
    while (w->at < w->end && *w->at++ != ';') {
    }
    w->srid.length = w->at > w->srid.text ? (size_t)(w->at - w->srid.text) - 1 : 0;
  }
  while (k < count && !wkt_has_word(w->at, w->end, words[k])) k++;
  for (const char *p = w->at; p < w->end && k < count && *p != '('; p++)
    w->rings |= wkt_has_word(p, w->end, "POLYGON") || wkt_has_word(p, w->end, "MULTIPOLYGON");
  w->point = k == 0;
  return k < count && wkt_opens(w->at, w->end);
}

static dyd_span wkt_number(dyd_wkt *w) {
  while (w->at < w->end && wkt_is_blank(*w->at)) w->at++;
  const char *begin = w->at;
  while (w->at < w->end && !wkt_is_blank(*w->at) && !strchr(",()", *w->at)) w->at++;
  dyd_span s = w->text;
  s.text = begin;
  s.at = w->text.at + (begin - w->text.text);
  s.length = (size_t)(w->at - begin);
  return s;
}

static bool wkt_same(const dyd_span *a, const dyd_span *b) {
  return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

bool dyd_wkt_next(dyd_span place[2], dyd_wkt *w) {
  for (;;) {
    bool opened = false;
    while (w->at < w->end && (*w->at == '(' || *w->at == ',' || *w->at == ')' || !w->inside || wkt_is_blank(*w->at))) {
      opened |= *w->at == '(';
      w->inside |= *w->at++ == '(';
    }
    if (w->at == w->end) return false;
    place[0] = wkt_number(w);
    place[1] = wkt_number(w);
    while (w->at < w->end && *w->at != ',' && *w->at != ')' && *w->at != '(') w->at++; /* z and m */
    if (place[0].length && ((place[0].text[0] & ~0x20) >= 'A' && (place[0].text[0] & ~0x20) <= 'Z'))
      continue; /* a word */
    if (opened) memcpy(w->first, place, sizeof w->first);
    bool last = w->at < w->end && *w->at == ')';
    if (w->rings && !opened && last && wkt_same(&place[0], &w->first[0]) && wkt_same(&place[1], &w->first[1])) continue;
    return true;
  }
}

/* One line of a points file: two coordinates separated by blanks or one comma, and a comment.
 *
 * Blanks and commas within parentheses or brackets belong to the coordinate. */

static bool points_is_blank(char c) {
  return c == ' ' || c == '\t';
}

typedef struct cursor {
  const char *at, *end;
  const dyd_line *line;
  char comma; /* possible separators besides blanks */
} cursor;

static dyd_status points_fail(dyd_error *err, const cursor *c, const char *message) {
  dyd_span span = {c->at, 0, c->at, c->line->text, c->line->number};
  return dyd_span_fail(err, &span, 0, message);
}

/* Skips blanks; how many commas stood among them (0, 1, or 2 for "too many"). */
static int points_separator(cursor *c, int allowed) {
  int commas = 0;
  for (; c->at < c->end && (points_is_blank(*c->at) || *c->at == c->comma); c->at++)
    if (*c->at == c->comma && ++commas > allowed) return commas;
  return commas;
}

/* Characters that may end a coordinate or open a parenthesis in it. */
static const bool special[256] = {
    [' '] = true, ['\t'] = true, [','] = true, ['('] = true, [')'] = true, ['['] = true, [']'] = true};

/* From c->at up to a separator outside all parentheses. */
static dyd_span points_coordinate(cursor *c) {
  const char *begin = c->at;
  int depth = 0;
  for (; c->at < c->end; c->at++) {
    if (!special[(unsigned char)*c->at]) continue;
    if (*c->at == '(' || *c->at == '[') depth++;
    if ((*c->at == ')' || *c->at == ']') && depth > 0) depth--;
    if (depth == 0 && (points_is_blank(*c->at) || *c->at == c->comma)) break;
  }
  return (dyd_span){begin, (size_t)(c->at - begin), begin, c->line->text, c->line->number};
}

static bool is_degrees(const char *begin, const char *end) {
  mpq_t lo, hi;
  char letter;
  mpq_inits(lo, hi, NULL);
  bool is = dyd_degrees_read(lo, hi, &letter, begin, (size_t)(end - begin), false, NULL) != DYD_E_ARG;
  mpq_clears(lo, hi, NULL);
  return is;
}

/* Degrees with blanks between minutes and seconds: the one place where both sides are such numbers. false: there is
 * none, or there are several. */
static bool degrees_split(dyd_span coordinate[2], const dyd_line *line, const char *end, char comma) {
  const char *begin = line->text, *found = NULL, *next = NULL;
  while (begin < end && points_is_blank(*begin)) begin++;
  for (const char *at = begin; at < end && end - begin < 200; at++) {
    if (!points_is_blank(*at) && *at != comma) continue;
    const char *left = at;
    int commas = 0;
    for (; at < end && (points_is_blank(*at) || *at == comma); at++) commas += *at == comma;
    if (commas > 1 || !is_degrees(begin, left) || !is_degrees(at, end)) continue;
    if (found) return false;
    found = left;
    next = at;
  }
  if (!found) return false;
  while (end > next && points_is_blank(end[-1])) end--;
  coordinate[0] = (dyd_span){begin, (size_t)(found - begin), begin, line->text, line->number};
  coordinate[1] = (dyd_span){next, (size_t)(end - next), next, line->text, line->number};
  return true;
}

dyd_status dyd_points_split(dyd_span coordinate[2], size_t *count, const dyd_line *line, char comma, dyd_error *err) {
  const char *comment = memchr(line->text, '#', line->length);
  cursor c = {line->text, comment ? comment : line->text + line->length, line, comma};
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
