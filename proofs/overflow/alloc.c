/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/base/alloc.h: sizes do not overflow, and capacities are what there is. */
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/*@ assigns \nothing; exits \false; ensures \result == p; */
void *dyd_alloc_in_large_pages(void *p, size_t bytes);
/*@ assigns \nothing; exits \false;
    ensures \result != \null ==> \valid((char *)\result + (0 .. count * size - 1)) && count * size <= SIZE_MAX; */
static inline void *dyd_alloc(size_t count, size_t size);
/*@ requires \valid(array) && \valid(cap) && \separated(array, cap) && 0 < size && *cap * size <= PTRDIFF_MAX;
    assigns *array, *cap; exits \false;
    ensures !\result ==> *array == \old(*array) && *cap == \old(*cap);
    ensures \result ==> need <= *cap && *cap * size <= SIZE_MAX;
    ensures \result ==> *cap == \old(*cap) || \valid((char *)*array + (0 .. *cap * size - 1)); */
static inline bool dyd_reserve(void **array, size_t *cap, size_t need, size_t size);

#include "base/alloc.c"
