/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checked allocation: sizes that overflow give NULL, as exhausted memory does. */
#ifndef DYD_BASE_ALLOC_H
#define DYD_BASE_ALLOC_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/* Hints to the system that the bytes from p on, if they are many (1 MiB), should lie in large pages. Triangulations
 * jump through memory, and small pages cost them a tenth of their time. Without such pages, nothing happens. Returns p.
 */
void *dyd_alloc_in_large_pages(void *p, size_t bytes);

/* count * size bytes, not cleared; never NULL for count = 0 unless memory is exhausted. Release with free(). */
static inline void *dyd_alloc(size_t count, size_t size) {
  if (size && count > SIZE_MAX / size) return NULL;
  size_t bytes = count && size ? count * size : 1;
  return dyd_alloc_in_large_pages(malloc(bytes), bytes);
}

/* Make an array of n items, ZEROED one of zeros. false: memory is exhausted, it is NULL. */
#define DYD_NEW(array, n) (((array) = dyd_alloc((n), sizeof *(array))) != NULL)
#define DYD_ZEROED(array, n) (((array) = calloc((n), sizeof *(array))) != NULL)

/* Makes room for at least `need` items in *array (capacity *cap), growing by half. false: memory exhausted,
 * nothing changed. DYD_GROW(array, cap, need): the same of an array and its capacity. */
static inline bool dyd_reserve(void **array, size_t *cap, size_t need, size_t size) {
  if (need <= *cap) return true;
  size_t want = *cap + *cap / 2 + 16;
  if (want < need) want = need;
  if (want > SIZE_MAX / size) return false;
  void *p = dyd_alloc_in_large_pages(realloc(*array, want * size), want * size);
  if (!p) return false;
  *array = p;
  *cap = want;
  return true;
}
#define DYD_GROW(array, cap, need) dyd_reserve((void **)&(array), &(cap), (need), sizeof *(array))

/* Releases the arrays named: dyd_free_all(a, b, c). */
#define dyd_free_all(...)                                                                                              \
  dyd_free_each((void *const[]){__VA_ARGS__}, sizeof((void *const[]){__VA_ARGS__}) / sizeof(void *))
static inline void dyd_free_each(void *const array[], size_t count) {
  for (size_t k = 0; k < count; k++) free(array[k]);
}

#endif
