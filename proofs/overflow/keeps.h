/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyd_reserve for lists of ITEM that keep what is in them, under the name RESERVE: as lists.h has it, and more than
 * alloc.c proves. KEPT: of two items, that they are the same. Included once for every kind of item. */
#ifndef KEPT
#define KEPT(a, b) ((a) == (b))
#endif

/*@ requires \valid(array) && \valid(cap) && \separated(array, cap) && size == sizeof(ITEM) &&
      *cap <= 1152921504606846976;
    requires 0 < *cap ==> \valid(*array + (0 .. *cap - 1));
    assigns *array, *cap; exits \false;
    ensures !\result ==> *array == \old(*array) && *cap == \old(*cap);
    ensures \result ==> need <= *cap <= 1152921504606846976;
    ensures \result && 0 < *cap ==> \valid(*array + (0 .. *cap - 1));
    ensures \result ==> \forall integer q; 0 <= q < \old(*cap) ==> KEPT((*array)[q], \old((*array)[q])); */
bool RESERVE(ITEM **array, size_t *cap, size_t need, size_t size);
#undef ITEM
#undef RESERVE
#undef KEPT
