/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One line of a points file: two coordinates separated by blanks or one comma, and a comment.
 *
 * Blanks and commas within parentheses or brackets belong to the coordinate. */
#include "io/read/source.h"
#include <string.h>

typedef struct cursor {
  const char *at, *end;
  const dyd_line *line;
  char comma; /* what may separate besides blanks */
} cursor;

static dyd_status points_fail(dyd_error *err, const cursor *c, const char *message) {
  dyd_span span = {c->at, 0, c->at, c->line->text, c->line->number};
  return dyd_span_fail(err, &span, 0, message);
}

static bool is_points_blank(char c) {
  return c == ' ' || c == '\t';
}

/* Skips blanks; how many commas stood among them (0, 1, or 2 for "too many"). */
static int points_separator(cursor *c, int allowed) {
  int commas = 0;
  for (; c->at < c->end && (is_points_blank(*c->at) || *c->at == c->comma); c->at++)
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
    if (depth == 0 && (is_points_blank(*c->at) || *c->at == c->comma)) break;
  }
  return (dyd_span){begin, (size_t)(c->at - begin), begin, c->line->text, c->line->number};
}

dyd_status dyd_points_split(dyd_span coordinate[2], size_t *count, const dyd_line *line, char comma, dyd_error *err) {
  const char *comment = memchr(line->text, '#', line->length);
  cursor c = {line->text, comment ? comment : line->text + line->length, line, comma};
  *count = 0;
  if (points_separator(&c, 0))
    return points_fail(err, &c, "a coordinate is missing before this comma; give two coordinates");
  if (c.at == c.end) return DYD_OK;
  coordinate[0] = points_coordinate(&c);
  if (points_separator(&c, 1) > 1)
    return points_fail(err, &c, "two commas in a row; separate the coordinates by one comma");
  if (c.at == c.end)
    return points_fail(err, &c,
                       memchr(line->text, ';', (size_t)(c.end - line->text))
                           ? "the line has one coordinate only; give two, separated by a blank or a comma in place of "
                             "';', or a header and `columns` X,Y"
                           : "the line has one coordinate only; give two, separated by a blank or a comma");
  coordinate[1] = points_coordinate(&c);
  int commas = points_separator(&c, 0);
  if (commas || c.at < c.end)
    return points_fail(err, &c,
                       "more than two coordinates on this line; give two, and write expressions without blanks "
                       "outside parentheses");
  *count = 2;
  return DYD_OK;
}
