/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Integer rectangles: the ground of every exact rung.
 *
 * All predicates are homogeneous in the coordinates, so a handful of rectangles (and points) may be scaled by one
 * common positive factor that makes every end an integer: a power of two times the least common multiple of the
 * denominators. Signs do not change. */
#ifndef DYD_RECT_IRECT_H
#define DYD_RECT_IRECT_H

#include "base/local.h"
#include <dyadel/rect.h>

/* [x0,x1] x [y0,y1]. Invariant: x0 <= x1, y0 <= y1. */
typedef struct dyd_irect {
  mpz_t x0, x1, y0, y1;
} dyd_irect;

void dyd_irect_init(dyd_irect *r);
void dyd_irect_clear(dyd_irect *r);
DYD_ARRAYS(dyd_irect)

/* The lower (upper = 0) or upper end (1) of the side along axis 0 (x) or 1 (y). */
static inline mpz_srcptr dyd_irect_end(const dyd_irect *r, int axis, int upper) {
  if (axis) return upper ? r->y1 : r->y0;
  return upper ? r->x1 : r->x0;
}

/* Scales in[0..n-1] by one common factor F = scale_man * 2^scale_exp > 0 into out[0..n-1] (initialised by the
 * caller). scale_man, scale_exp may be NULL. Exact, cannot fail. */
void dyd_irects_scale(dyd_irect *out, const dyd_rect *const *in, size_t n, mpz_ptr scale_man, int64_t *scale_exp);
/* The same with a dyadic point c and the rectangles: (cx, cy) = F c. c may be NULL: cx, cy are not used. */
void dyd_irects_scale_with(mpz_ptr cx, mpz_ptr cy, dyd_irect *out, const dyd_point *c, const dyd_rect *const *in,
                           size_t n, mpz_ptr scale_man, int64_t *scale_exp);

/* ds(c,r)^2 and dl(c,r)^2 [DIST-1]. out must not alias the inputs. */
void dyd_irect_ds2(mpz_ptr out, mpz_srcptr cx, mpz_srcptr cy, const dyd_irect *r);
void dyd_irect_dl2(mpz_ptr out, mpz_srcptr cx, mpz_srcptr cy, const dyd_irect *r);

/* Returns true if they have a common point. */
static inline bool dyd_irects_meet(const dyd_irect *a, const dyd_irect *b) {
  return mpz_cmp(a->x0, b->x1) <= 0 && mpz_cmp(b->x0, a->x1) <= 0 && mpz_cmp(a->y0, b->y1) <= 0 &&
         mpz_cmp(b->y0, a->y1) <= 0;
}

#endif
