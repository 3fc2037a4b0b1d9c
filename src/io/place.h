/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Places: short decimals that stand for a box. */
#ifndef DYD_IO_PLACE_H
#define DYD_IO_PLACE_H

#include "base/prefetch.h"
#include "io/decimal.h"

/* Invariant: every point of the box it stands for is within `error` of it in x and in y. */
typedef struct dyd_place {
  char x[DYD_DECIMAL_SIZE], y[DYD_DECIMAL_SIZE];
  double error;
  unsigned char length[2]; /* of x, of y */
} dyd_place;

/* Of a box with finite ends: x lower, x upper, y lower, y upper. */
void dyd_place_set(dyd_place *out, const double box[4]);
/* Asks memory for it. */
static inline void dyd_place_fetch(const dyd_place *p) {
  dyd_prefetch(p->x);
  dyd_prefetch(p->length);
}

#endif
