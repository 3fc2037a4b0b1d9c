/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers of 32 bits: sites, vertices, triangles, half-edges. */
#ifndef DYD_BASE_INDEX_H
#define DYD_BASE_INDEX_H

#include <stdint.h>

/* No such thing. */
#define DYD_NONE UINT32_MAX

/* For qsort and bsearch. */
static inline int dyd_compare_index(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return (x > y) - (x < y);
}

#endif
