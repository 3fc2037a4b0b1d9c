/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points read but not yet given to the engine: kept back so that bad input adds nothing. */
#ifndef DYD_IO_READ_STAGE_H
#define DYD_IO_READ_STAGE_H

#include "io/read/coordinate.h"
#include <dyadel/engine.h>

typedef struct dyd_staged dyd_staged;

/* Initialise with {0}. 40 bytes per point, and what reals hold. */
typedef struct dyd_stage {
  size_t count;
  dyd_staged **piece; /* the points, in pieces of one length; of the first one, first_cap has been allocated */
  size_t pieces, piece_cap, first_cap;
  uint64_t bytes; /* that points take, here and in the engine, about */
} dyd_stage;

void dyd_stage_clear(dyd_stage *s);
/* Appends a point. Takes over reals, also on failure, and leaves both coordinates empty. */
dyd_status dyd_stage_add(dyd_stage *s, dyd_coordinate *x, dyd_coordinate *y, dyd_error *err);
/* Gives point k the coordinates that `take` names, and keeps the others. Takes over reals as above. */
dyd_status dyd_stage_replace(dyd_stage *s, size_t k, dyd_coordinate *x, dyd_coordinate *y, const bool take[2],
                             dyd_error *err);
/* Widens point k by `by` in x and y. */
dyd_status dyd_stage_widen(dyd_stage *s, size_t k, const double by[2], dyd_error *err);
/* Adds all points to e in order, doubles in bulk. The stage is empty afterwards.
 * Fails only when memory is exhausted or e has run already. */
dyd_status dyd_stage_commit(dyd_engine *e, dyd_stage *s, dyd_error *err);

/* ---- which rows of a file give the same place: a table of nominal coordinates as written, without a radius; or of
 * identifiers ---- */

/* A place where points are, or an identifier. width: of the rectangle that its first point, or the merged one, has in x
 * and y. */
typedef struct dyd_place_key {
  uint64_t hash;
  size_t text, length; /* the key */
  size_t point, count; /* its first point, and how many rows give this place */
  union {
    double width[2];
    size_t row[2]; /* of an identifier: its first and its last row, as the caller counts them */
  };
} dyd_place_key;

/* Where an item is found: its number plus 1, 0 where free, and the high half of its hash. */
typedef struct dyd_place_slot {
  uint32_t item, tag;
} dyd_place_slot;

/* Invariant: slots is 0 or a power of 2 above 1.5 count. */
typedef struct dyd_place_keys {
  dyd_place_key *item;
  size_t count, cap;
  dyd_place_slot *slot;
  size_t slots;
  char *text;
  size_t used, text_cap;
} dyd_place_keys;

void dyd_places_clear(dyd_place_keys *n);
/* Bytes that it takes. O(1) */
size_t dyd_places_bytes(const dyd_place_keys *n);
/* Finds the place of the two coordinates and raises its count; *out is borrowed until the next call. Equal exact
 * numbers (the middle of an interval, a value without its radius) are equal however they are written; other expressions
 * are when their texts are equal. A new place has count 1. DYD_E_NOMEM. */
dyd_status dyd_places_find(dyd_place_key **out, dyd_place_keys *n, const dyd_span span[2]);
/* The same of an identifier, in a table of identifiers. */
dyd_status dyd_places_find_id(dyd_place_key **out, dyd_place_keys *n, const dyd_span *id);

#endif
