/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points by their nominal coordinates: what is written, without radius. */
#ifndef DYD_IO_READ_NOMINAL_H
#define DYD_IO_READ_NOMINAL_H

#include "io/read/text.h"
#include <stdint.h>

/* A place where points are. width: of the rectangle that its first point, or the merged one, has in x and y. */
typedef struct dyd_nominal {
  uint64_t hash;
  size_t text, length; /* the key */
  size_t point, count; /* its first point, and how many rows give this place */
  double width[2];
} dyd_nominal;

/* Invariant: slot[] holds numbers of items plus 1, 0 where free; slots is 0 or a power of 2 above 1.5 count. */
typedef struct dyd_nominals {
  dyd_nominal *item;
  size_t count, cap;
  size_t *slot, slots;
  char *text;
  size_t used, text_cap;
} dyd_nominals;

void dyd_nominals_clear(dyd_nominals *n);
/* The place of the two coordinates, counted once more; *out is borrowed until the next call. Equal exact numbers (the
 * middle of an interval, a value without its radius) are equal however they are written; other expressions are when
 * their texts are equal. A new place has count 1. DYD_E_NOMEM. */
dyd_status dyd_nominals_find(dyd_nominal **out, dyd_nominals *n, const dyd_span span[2]);

#endif
