/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Well-known text: the places of a geometry, as they are written. */
#include "io/read/csv.h"
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
  return at == end || word[-1] == '=' || !((*at & ~0x20) >= 'A' && (*at & ~0x20) <= 'Z');
}

static bool wkt_is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool dyd_wkt_begin(dyd_wkt *w, const dyd_span *text) {
  size_t k = 0, count = sizeof words / sizeof *words;
  *w = (dyd_wkt){.text = *text, .at = text->text, .end = text->text + text->length};
  while (w->at < w->end && wkt_is_blank(*w->at)) w->at++;
  if (wkt_has_word(w->at, w->end, "SRID="))
    while (w->at < w->end && *w->at++ != ';') {
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
