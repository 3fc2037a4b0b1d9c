/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Invariants of intervals and rectangles. */
#ifndef DYD_RECT_RECT_H
#define DYD_RECT_RECT_H

#include "base/local.h"
#include "dyadic/raw.h"
#include <dyadel/rect.h>

DYD_ARRAYS(dyd_rect)
DYD_ARRAYS(dyd_dyadic)

bool dyd_interval_is_valid(const dyd_interval *a);
/* Returns true if the point is in the closed rectangle, whose ends are dyadic. */
bool dyd_rect_holds(const dyd_rect *r, const dyd_point *p);
/* What a callback is given at stage 0: no interval, its lower end is above the upper one. So a side that the callback
 * does not set is noticed. */
void dyd_interval_unset(dyd_interval *out);
bool dyd_interval_is_unset(const dyd_interval *a);
void dyd_rect_unset(dyd_rect *out);
/* Both ends as doubles, when they are doubles; else false. */
bool dyd_interval_get_exact_d(double *lo, double *hi, const dyd_interval *a);

void dyd_interval_swap(dyd_interval *a, dyd_interval *b);
/* out becomes the point x/den; x and den may be parts of it. */
void dyd_interval_set_over(dyd_interval *out, const dyd_dyadic *x, const mpz_t den);
/* a becomes its middle, exactly. DYD_E_RANGE. */
dyd_status dyd_interval_halve(dyd_interval *a);
/* The intersection; DYD_E_ARG (out unchanged) when it is empty. */
dyd_status dyd_interval_intersect(dyd_interval *out, const dyd_interval *a, const dyd_interval *b);
void dyd_rect_swap(dyd_rect *a, dyd_rect *b);
/* ds(c,R)^2 and dl(c,R)^2, exact canonical rationals (attained at the clamped point and at the corner
 * opposite c's quadrant [DIST-1]); out is initialised by the caller. */
void dyd_rect_ds2(mpq_t out, const dyd_point *c, const dyd_rect *r);
void dyd_rect_dl2(mpq_t out, const dyd_point *c, const dyd_rect *r);
/* Bounds of the distances of a point of a and a point of b: the least one rounded down, the largest one rounded up
 * (infinite beyond the range of doubles). */
void dyd_rect_distance(double *lo, double *hi, const dyd_rect *a, const dyd_rect *b);
/* Twice the area of the partial edge Ed(a,b), the convex hull of two rectangles. Exact. */
void dyd_partial_edge_area2(mpq_t out, const dyd_rect *a, const dyd_rect *b);
/* Returns true if Ed(a,b) and Ed(c,d) are disjoint as closed sets. Exact, touching counts as meeting [HULL-1]. */
bool dyd_partial_edges_disjoint(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c, const dyd_rect *d);
void dyd_point_set(dyd_point *out, const dyd_point *p);

bool dyd_rect_equal(const dyd_rect *a, const dyd_rect *b);
bool dyd_interval_meets(const dyd_interval *a, const dyd_interval *b);
/* Returns true if inner is a subset of outer. Exact. */
bool dyd_interval_contains(const dyd_interval *outer, const dyd_interval *inner);
/* The least b >= -DYD_EXP_LIMIT with hi - lo > 2^-b, minus 1: the width is at most 2^-(bits).
 * INT64_MAX for a point. */
int64_t dyd_interval_bits(const dyd_interval *a);
dyd_status dyd_rect_set_q(dyd_rect *out, const mpq_t x, const mpq_t y);
/* Enclosing doubles, rounded outward (infinite beyond the range of doubles). */
void dyd_interval_get_d(double *lo, double *hi, const dyd_interval *a);

/* DYD_E_ARG unless lo <= hi. */
dyd_status dyd_interval_set_ends(dyd_interval *out, const dyd_dyadic *lo, const dyd_dyadic *hi);
bool dyd_interval_is_point(const dyd_interval *a);
/* The most bits for which both widths are at most 2^-bits; INT64_MAX for a point. */
int64_t dyd_rect_bits(const dyd_rect *r);

/* dyd_interval_set_ends_q of [q,q]. */
dyd_status dyd_interval_set_q(dyd_interval *out, const mpq_t q);

#endif
