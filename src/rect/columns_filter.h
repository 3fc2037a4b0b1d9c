/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Columns of doubles in a caller's table, read as points or as points with a radius. */
#ifndef DYD_RECT_COLUMNS_FILTER_H
#define DYD_RECT_COLUMNS_FILTER_H

#include <dyadel/sites.h>

/* Entry i of a column, wherever it lies. */
double dyd_column_at(const dyd_column *c, size_t i);
/* *lo, *hi: the doubles next to x - r and x + r, on the outer sides; these themselves where they are doubles. false:
 * x or r is no finite number, r is negative, or an end is beyond the largest double. */
bool dyd_widen_d(double *lo, double *hi, double x, double r);

#endif
