/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Invariants of intervals and rectangles. */
#ifndef DYD_RECT_RECT_H
#define DYD_RECT_RECT_H

#include <dyadel/rect.h>

bool dyd_interval_is_valid(const dyd_interval *a);
/* Is the point in the closed rectangle, whose ends are dyadic? */
bool dyd_rect_holds(const dyd_rect *r, const dyd_point *p);
/* Both ends as doubles, when they are doubles; else false. */
bool dyd_interval_get_exact_d(double *lo, double *hi, const dyd_interval *a);

#endif
