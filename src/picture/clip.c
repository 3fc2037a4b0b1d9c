/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cutting lines and convex polygons to a box before they are drawn.
 *
 * Positions far outside of a page do not fit the numbers that cairo draws with: they would come back from the other
 * side. The box is an intersection of four half-planes; cutting by one after the other keeps segments segments and
 * convex polygons convex. */
#include "picture/picture.h"

#include <string.h>

/* How far z is inside of side k of the box. */
static double clip_depth(const double z[2], const double box[4], int k) {
  double inside = z[k >> 1] - box[k];
  return k & 1 ? -inside : inside;
}

/* Where pq, of depths a and b of different signs, meets side k. */
static void clip_meet(double out[2], const double p[2], const double q[2], double a, double b, const double box[4],
                      int k) {
  int along = 1 - (k >> 1);
  double at = p[along] + a / (a - b) * (q[along] - p[along]);
  out[k >> 1] = box[k];
  out[along] = at;
}

bool dyd_clip_segment(double z[2][2], const double box[4]) {
  for (int k = 0; k < 4; k++) {
    double a = clip_depth(z[0], box, k), b = clip_depth(z[1], box, k);
    if (a < 0 && b < 0) return false;
    if (a < 0 || b < 0) clip_meet(z[a < 0 ? 0 : 1], z[0], z[1], a, b, box, k);
  }
  return true;
}

int dyd_clip_convex(double z[DYD_CLIP_MOST][2], int n, const double box[4]) {
  double kept[DYD_CLIP_MOST][2];
  for (int k = 0; k < 4 && n > 0; k++) {
    int count = 0;
    for (int c = 0; c < n; c++) {
      const double *p = z[c], *q = z[c + 1 < n ? c + 1 : 0];
      double a = clip_depth(p, box, k), b = clip_depth(q, box, k);
      if (a >= 0 && count < DYD_CLIP_MOST) memcpy(kept[count++], p, sizeof kept[0]);
      if ((a >= 0) != (b >= 0) && count < DYD_CLIP_MOST) clip_meet(kept[count++], p, q, a, b, box, k);
    }
    memcpy(z, kept, (size_t)count * sizeof kept[0]);
    n = count;
  }
  return n;
}
