/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The arrays of the table of sites. */
#include "base/alloc.h"
#include "rect/sites_table.h"

#include <string.h>

static bool resize_array(void *array, size_t cap, size_t size) {
  void *p = dyd_alloc_in_large_pages(realloc(*(void **)array, cap * size), cap * size);
  if (p) *(void **)array = p;
  return p != NULL;
}

dyd_status dyd_sites_reserve(dyd_sites *s, size_t more) {
  if (more > DYD_MAX_SITES - s->count) return DYD_E_RANGE;
  if (s->count + more <= s->cap) return DYD_OK;
  size_t cap = s->cap + s->cap / 2;
  if (cap < s->count + more) cap = s->count + more;
  for (int a = 0; a < 2; a++) {
    if (!resize_array(&s->lower[a], cap, sizeof(double))) return DYD_E_NOMEM;
    if (s->upper[a] && !resize_array(&s->upper[a], cap, sizeof(double))) return DYD_E_NOMEM;
  }
  if (s->exact && !resize_array(&s->exact, cap, sizeof *s->exact)) return DYD_E_NOMEM;
  if (s->word && !resize_array(&s->word, cap, sizeof *s->word)) return DYD_E_NOMEM;
  s->cap = cap;
  return DYD_OK;
}

dyd_status dyd_sites_split_ends(dyd_sites *s) {
  for (int a = 0; a < 2; a++) {
    if (s->upper[a]) continue;
    double *p = dyd_alloc(s->cap ? s->cap : 1, sizeof *p);
    if (!p) return DYD_E_NOMEM;
    if (s->count) memcpy(p, s->lower[a], s->count * sizeof *p);
    s->upper[a] = p;
  }
  return DYD_OK;
}
