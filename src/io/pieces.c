/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The part of the plane that pictures of bisectors and discs show. */
#include "io/pieces.h"

#include "base/error.h"
#include <math.h>

dyd_status dyd_pieces_grow(double box[4], const dyd_rect *r, dyd_error *err) {
  double b[4];
  dyd_interval_get_d(&b[0], &b[1], &r->x);
  dyd_interval_get_d(&b[2], &b[3], &r->y);
  for (int k = 0; k < 4; k++) {
    if (!isfinite(b[k]))
      return dyd_fail(err, DYD_E_RANGE, "the points are too far apart or too close for a picture; use csv or json");
    box[k] = k & 1 ? fmax(box[k], b[k]) : fmin(box[k], b[k]);
  }
  return DYD_OK;
}

void dyd_pieces_pad(double box[4]) {
  double w = box[1] - box[0], h = box[3] - box[2], size = fmax(w, h);
  if (size == 0) size = 1;
  double wide = (fmax(w, size) - w) / 2 + 0.1 * size, high = (fmax(h, 0.6 * size) - h) / 2 + 0.1 * size;
  box[0] -= wide, box[1] += wide;
  box[2] -= high, box[3] += high;
}
