/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orders for qsort and bsearch. */
#ifndef DYD_BASE_SORT_H
#define DYD_BASE_SORT_H

/* Doubles, ascending; no NaN. */
static inline int dyd_compare_double(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

#endif
