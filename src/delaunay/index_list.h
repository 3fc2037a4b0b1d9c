/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists of sites that are put together from others. */
#ifndef DYD_DELAUNAY_INDEX_LIST_H
#define DYD_DELAUNAY_INDEX_LIST_H

#include "base/alloc.h"
#include "base/index.h"
#include <dyadel/delaunay.h>

/* Appends count items; *cap is the capacity of the list. */
static inline dyd_status dyd_index_list_add(dyd_index_list *l, size_t *cap, const uint32_t *item, size_t count) {
  if (!dyd_reserve((void **)&l->item, cap, l->count + count, sizeof *l->item)) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++) l->item[l->count++] = item[k];
  return DYD_OK;
}

/* Ascending, each once. */
static inline void dyd_index_list_sort(dyd_index_list *l) {
  size_t kept = 0;
  if (l->count) qsort(l->item, l->count, sizeof *l->item, dyd_compare_index);
  for (size_t k = 0; k < l->count; k++)
    if (!kept || l->item[kept - 1] != l->item[k]) l->item[kept++] = l->item[k];
  l->count = kept;
}

#endif
