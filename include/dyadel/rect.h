/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Partial points: closed axis-parallel rectangles with exact ends (mathematics: section 1).
 *
 * ds(c,R) and dl(c,R) are the smallest and the largest Euclidean distance from a point c to R. */
#ifndef DYADEL_RECT_H
#define DYADEL_RECT_H

#include <dyadel/dyadic.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A closed interval [lo/den, hi/den] with rational ends, such as [0,6/5]: lo = 0, hi = 3 * 2^1, den = 5.
 * Invariant: den is odd and positive; no factor > 1 of den divides both lo and hi; lo <= hi. */
typedef struct dyd_interval {
  dyd_dyadic lo, hi;
  mpz_t den;
} dyd_interval;

/* x times y. Singletons (lo = hi in both) are exact points. */
typedef struct dyd_rect {
  dyd_interval x, y;
} dyd_rect;

/* A dyadic point, such as a witness centre. */
typedef struct dyd_point {
  dyd_dyadic x, y;
} dyd_point;

DYD_API void dyd_interval_init(dyd_interval *a);
DYD_API void dyd_interval_clear(dyd_interval *a);
DYD_API void dyd_interval_set(dyd_interval *out, const dyd_interval *a);
/* DYD_E_ARG unless lo <= hi. */
DYD_API dyd_status dyd_interval_set_d(dyd_interval *out, double lo, double hi);
/* The exact interval [lo,hi] of canonical rationals, a point where they are equal. DYD_E_ARG unless lo <= hi;
 * DYD_E_RANGE when an end leaves the exponent range. */
DYD_API dyd_status dyd_interval_set_ends_q(dyd_interval *out, const mpq_t lo, const mpq_t hi);
/* [lo,hi] rounded outward to multiples of 2^exp; lo <= hi are canonical rationals. */
DYD_API dyd_status dyd_interval_set_outward(dyd_interval *out, const mpq_t lo, const mpq_t hi, int64_t exp);
/* a itself where its ends are dyadic, or it is a point; else [lo,hi] rounded outward by less than 2^-64 of its width,
 * as windows are to be. DYD_E_RANGE. */
DYD_API dyd_status dyd_interval_round(dyd_interval *out, const dyd_interval *a);
/* Ends as canonical rationals; lo, hi initialised by the caller. */
DYD_API void dyd_interval_get_q(mpq_t lo, mpq_t hi, const dyd_interval *a);

DYD_API void dyd_rect_init(dyd_rect *r);
DYD_API void dyd_rect_clear(dyd_rect *r);
DYD_API void dyd_rect_set(dyd_rect *out, const dyd_rect *r);
DYD_API dyd_status dyd_rect_set_d(dyd_rect *out, double x0, double x1, double y0, double y1);
/* The sides as enclosing doubles: x lower, x upper, y lower, y upper. */
DYD_API void dyd_rect_get_d(double out[4], const dyd_rect *r);
DYD_API bool dyd_rect_is_point(const dyd_rect *r);
DYD_API bool dyd_rect_contains(const dyd_rect *outer, const dyd_rect *inner);
DYD_API bool dyd_rect_meets(const dyd_rect *a, const dyd_rect *b);

DYD_API void dyd_point_init(dyd_point *p);
DYD_API void dyd_point_clear(dyd_point *p);

#ifdef __cplusplus
}
#endif
#endif
