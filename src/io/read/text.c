/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines of a text file, read in blocks, and positions in them for error messages. */
#include "io/read/text.h"
#include "base/alloc.h"
#include "base/error.h"
#include "stream/number.h"
#include <string.h>

#define BLOCK ((size_t)1 << 17)

void dyd_text_init(dyd_text *t, FILE *in) {
  *t = (dyd_text){0};
  dyd_bytes_init(&t->bytes, in);
}

void dyd_text_clear(dyd_text *t) {
  dyd_bytes_clear(&t->bytes);
  free(t->buffer);
  *t = (dyd_text){0};
}

void dyd_span_position(size_t *line, size_t *column, const dyd_span *span, size_t offset) {
  const char *end = span->at + offset, *begin = span->origin, *newline;
  *line = span->line;
  while ((newline = memchr(begin, '\n', (size_t)(end - begin)))) {
    ++*line;
    begin = newline + 1;
  }
  *column = dyd_text_column(begin, (size_t)(end - begin));
}

dyd_status dyd_span_fail(dyd_error *err, const dyd_span *span, size_t offset, const char *message) {
  if (err) dyd_span_position(&err->line, &err->column, span, offset);
  return dyd_fail(err, DYD_E_PARSE, "%s", message);
}

/* Reads one more block behind what is there. */
static dyd_status text_fill(dyd_text *t, dyd_error *err) {
  if (t->start) memmove(t->buffer, t->buffer + t->start, t->end - t->start);
  t->end -= t->start;
  t->start = 0;
  if (!dyd_reserve((void **)&t->buffer, &t->cap, t->end + BLOCK, 1)) return dyd_fail_nomem(err);
  size_t got = 0;
  dyd_status st = dyd_bytes_read(&got, t->buffer + t->end, BLOCK, &t->bytes, err);
  if (st != DYD_OK) return st;
  t->end += got;
  t->ended = got < BLOCK;
  return DYD_OK;
}

static void text_skip_mark(dyd_text *t) {
  if (t->end - t->start >= 3 && memcmp(t->buffer + t->start, "\xEF\xBB\xBF", 3) == 0) t->start += 3;
}

dyd_status dyd_text_init_copy(dyd_text *t, const char *text, size_t length) {
  *t = (dyd_text){.buffer = dyd_alloc(length, 1), .cap = length, .end = length, .ended = true};
  if (!t->buffer) return DYD_E_NOMEM;
  if (length) memcpy(t->buffer, text, length);
  text_skip_mark(t);
  return DYD_OK;
}

/* Finds the line end in what is read, reading on as needed; *length is up to the LF or the end of the file. */
static dyd_status text_find_end(size_t *length, bool *newline, dyd_text *t, dyd_error *err) {
  for (size_t seen = 0;;) {
    size_t have = t->end - t->start;
    const char *base = have ? t->buffer + t->start : NULL;
    const char *found = have > seen ? memchr(base + seen, '\n', have - seen) : NULL;
    *newline = found != NULL;
    *length = found ? (size_t)(found - base) : have;
    if (found || t->ended || *length > DYD_TEXT_LINE_MAX) return DYD_OK;
    seen = have;
    dyd_status st = text_fill(t, err);
    if (st != DYD_OK) return st;
    if (t->line == 0 && seen == 0) text_skip_mark(t);
  }
}

static dyd_status refuse_line(const dyd_line *line, dyd_error *err) {
  dyd_span span = {line->text, line->length, line->text, line->text, line->number};
  if (line->length > DYD_TEXT_LINE_MAX)
    return dyd_span_fail(err, &span, 0, "this line is longer than 1048576 bytes; give one point per line");
  const char *nul = memchr(line->text, 0, line->length);
  if (!nul) return DYD_OK;
  return dyd_span_fail(err, &span, (size_t)(nul - line->text), "a NUL byte; give plain text in UTF-8");
}

dyd_status dyd_text_next(dyd_line *out, dyd_text *t, dyd_error *err) {
  size_t length;
  bool newline;
  dyd_status st = text_find_end(&length, &newline, t, err);
  if (st != DYD_OK) return st;
  *out = (dyd_line){0};
  if (!length && !newline) return DYD_OK;
  *out = (dyd_line){t->buffer + t->start, length, ++t->line};
  t->start += length + newline;
  if (out->length && out->text[out->length - 1] == '\r') out->length--;
  return refuse_line(out, err);
}
