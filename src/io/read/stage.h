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

#endif
