/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bisector of ij cut by one half-line per other point, in 64-bit integers.
 *
 * The centre is c = (i + j)/2 + t n, n = (i.y - j.y, j.x - i.x). With K = 2k - i - j and I = i - j,
 * 4 (|c-k|^2 - |c-i|^2) = (|K|^2 - |I|^2) - 8 t n.(k-i): below 2^29 and 2^27 in size. */
#include "oracle/oracle_lattice.h"
#include <stdbool.h>

/* num / den, den > 0; den = 0: none yet. */
typedef struct bound {
  int64_t num, den;
} bound;

static bool below(bound a, bound b) {
  return a.num * b.den < b.num * a.den;
}

typedef struct cut {
  bound lo, hi;
  bool plus, minus, finite, strict;
} cut;

/* Keeps the t with value - t slope >= 0. */
static void keep(cut *s, int64_t value, int64_t slope) {
  if (slope == 0) {
    s->finite = s->finite && value >= 0;
    s->strict = s->strict && value > 0;
    return;
  }
  bound end = {slope > 0 ? value : -value, slope > 0 ? slope : -slope};
  if (slope > 0) {
    s->plus = false;
    if (!s->hi.den || below(end, s->hi)) s->hi = end;
  } else {
    s->minus = false;
    if (!s->lo.den || below(s->lo, end)) s->lo = end;
  }
}

int orc_lattice_status(const orc_lattice *point, size_t n, size_t i, size_t j) {
  cut s = {.plus = true, .minus = true, .finite = true, .strict = true};
  int64_t ix = point[i].x, iy = point[i].y, jx = point[j].x, jy = point[j].y;
  int64_t own = (ix - jx) * (ix - jx) + (iy - jy) * (iy - jy);
  for (size_t k = 0; k < n; k++) {
    if (k == i || k == j) continue;
    int64_t x = point[k].x, y = point[k].y, ax = 2 * x - ix - jx, ay = 2 * y - iy - jy;
    keep(&s, ax * ax + ay * ay - own, (iy - jy) * (x - ix) + (jx - ix) * (y - iy));
    if (s.lo.den && s.hi.den && below(s.hi, s.lo)) return 0;
  }
  bool open = !s.lo.den || !s.hi.den || below(s.lo, s.hi);
  if (s.finite && s.strict && open) return 3;
  return s.plus || s.minus || s.finite ? 1 : 0;
}
