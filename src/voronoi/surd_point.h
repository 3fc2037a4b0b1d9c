/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points with coordinates A + B sqrt(C) against integers, integer rectangles and one another. */
#ifndef DYD_VORONOI_SURD_POINT_H
#define DYD_VORONOI_SURD_POINT_H

#include "rect/irect.h"
#include <dyadel/arc.h>

void dyd_surd_point_init(dyd_surd_point *p);
void dyd_surd_point_clear(dyd_surd_point *p);
DYD_ARRAYS(dyd_surd_point)

/* Sign of (coordinate of p) - (that of q); axis 0: x, 1: y. */
int dyd_surd_point_cmp(const dyd_surd_point *p, const dyd_surd_point *q, int axis);
/* Sign of (coordinate of p) - z. */
int dyd_surd_point_cmp_z(const dyd_surd_point *p, int axis, mpz_srcptr z);
/* Sign of (distance of p to a) - (distance of p to b), each closest or farthest. Exact. */
int dyd_surd_point_side(const dyd_surd_point *p, const dyd_irect *a, dyd_touch ta, const dyd_irect *b, dyd_touch tb);
/* Only the rational parts of the coordinates stay. */
void dyd_surd_point_drop_root(dyd_surd_point *p);
/* The same point with c = 0 when it is rational, and without common factors. */
void dyd_surd_point_tidy(dyd_surd_point *p);
/* floor = the greatest integer <= 2^bits times the coordinate, ceiling = the least one >=. */
void dyd_surd_point_floor(mpz_ptr floor, mpz_ptr ceiling, const dyd_surd_point *p, int axis, int64_t bits);
/* p = (p + (ox,oy)) / (man * 2^exp), man > 0. */
void dyd_surd_point_unscale(dyd_surd_point *p, mpz_srcptr ox, mpz_srcptr oy, mpz_srcptr man, int64_t exp);

void dyd_surd_point_set(dyd_surd_point *out, const dyd_surd_point *p);
/* The partial centre O(a,b,c) = { o : some circle about o meets all three } of a certainly oriented triple: its six
 * vertices, the centres of the critical circles in the order FCC CFC CCF CFF FCF FFC. DYD_E_ARG for others. */
dyd_status dyd_partial_centre(dyd_surd_point out[6], const dyd_rect *a, const dyd_rect *b, const dyd_rect *c);

/* A rectangle that holds O(a,b,c), with ends within 2^-bits of the smallest one [CEN-1]. DYD_E_ARG as above. */
dyd_status dyd_partial_centre_enclose(dyd_rect *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c,
                                      int64_t bits);

#endif
