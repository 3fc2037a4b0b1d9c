/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers of 32 bits: sites, vertices, triangles, half-edges. */
#ifndef DYD_BASE_INDEX_H
#define DYD_BASE_INDEX_H

#include <stdint.h>
#include <stdlib.h>

/* No such thing. */
#define DYD_NONE UINT32_MAX

/* For qsort and bsearch. */
static inline int dyd_compare_index(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return (x > y) - (x < y);
}

/* The same for items that begin with two numbers, such as pairs of sites: by the first, then by the second. */
static inline int dyd_compare_two(const void *a, const void *b) {
  const uint32_t *x = a, *y = b;
  if (x[0] != y[0]) return x[0] < y[0] ? -1 : 1;
  return (x[1] > y[1]) - (x[1] < y[1]);
}

/* The item of a sorted array that begins with the two numbers that *two begins with; NULL: there is none. */
static inline void *dyd_find_two(const void *two, const void *item, size_t count, size_t size) {
  return count ? bsearch(two, item, count, size, dyd_compare_two) : NULL;
}

/* The place of *index in an array that is sorted by the number each item begins with; NULL: there is none. */
static inline void *dyd_find_index(const uint32_t *index, const void *item, size_t count, size_t size) {
  return count ? bsearch(index, item, count, size, dyd_compare_index) : NULL;
}

/* Doubles, ascending; no NaN. */
static inline int dyd_compare_double(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

#endif
