/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Text on its way to a file, in blocks: large results are millions of short pieces, over each of which stdio takes
 * longer than it takes to make it. Text put after a failure is dropped; the failure is reported at the end of the file
 * (output.h). */
#ifndef DYD_IO_SINK_H
#define DYD_IO_SINK_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { DYD_SINK_BLOCK = 1 << 15, DYD_INDEX_SIZE = 20 };

/* Between begin and flush no other code writes to out. Invariant: end is in the block or behind its last byte. */
typedef struct dyd_sink {
  FILE *out; /* borrowed */
  char *end, block[DYD_SINK_BLOCK];
} dyd_sink;

static inline void dyd_sink_begin(dyd_sink *s, FILE *out) {
  s->out = out;
  s->end = s->block;
}
/* Hands over all that was put. The sink is empty then, and can be used on. */
void dyd_sink_flush(dyd_sink *s);

/* Where `size` <= DYD_SINK_BLOCK bytes can be written, after which the caller moves s->end behind them. */
static inline char *dyd_sink_room(dyd_sink *s, size_t size) {
  if ((size_t)(s->block + DYD_SINK_BLOCK - s->end) < size) dyd_sink_flush(s);
  return s->end;
}

void dyd_sink_put_long(dyd_sink *s, const char *text, size_t length);
static inline void dyd_sink_put(dyd_sink *s, const char *text, size_t length) {
  if (length > DYD_SINK_BLOCK) {
    dyd_sink_put_long(s, text, length);
    return;
  }
  memcpy(dyd_sink_room(s, length), text, length);
  s->end += length;
}
/* Inline, so that the length of a literal is a constant. */
static inline void dyd_sink_text(dyd_sink *s, const char *text) {
  dyd_sink_put(s, text, strlen(text));
}

/* The digits of n, at most DYD_INDEX_SIZE, without a terminator; returns their end. */
char *dyd_put_digits(char *to, uint64_t n);
static inline void dyd_sink_index(dyd_sink *s, uint64_t n) {
  s->end = dyd_put_digits(dyd_sink_room(s, DYD_INDEX_SIZE), n);
}
/* A line of numbers, each more by `more`, behind a word. */
void dyd_sink_line(dyd_sink *s, const char *word, const uint32_t *n, size_t count, uint32_t more);
/* A text as csv has it. */
void dyd_sink_csv_text(dyd_sink *s, const char *text);
/* A text in JSON syntax; bytes that are not UTF-8 become U+FFFD. */
void dyd_sink_json_text(dyd_sink *s, const char *text);

#endif
