/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyd_reserve and dyd_alloc of src/base/alloc.h for lists of ITEM, under the names RESERVE and ALLOC: what alloc.c
 * proves of bytes, said of items. Included once for every kind of item. */

/*@ requires \valid(array) && \valid(cap) && \separated(array, cap) && size == sizeof(ITEM) &&
      *cap <= 1152921504606846976;
    requires 0 < *cap ==> \valid(*array + (0 .. *cap - 1));
    assigns *array, *cap; exits \false;
    ensures !\result ==> *array == \old(*array) && *cap == \old(*cap);
    ensures \result ==> need <= *cap <= 1152921504606846976;
    ensures \result && 0 < *cap ==> \valid(*array + (0 .. *cap - 1)) &&
      \separated(*array + (0 .. *cap - 1), array, cap); */
bool RESERVE(ITEM **array, size_t *cap, size_t need, size_t size);
/*@ requires size == sizeof(ITEM); assigns \nothing; exits \false;
    ensures \result != \null ==> count <= 1152921504606846976 &&
      (0 < count ==> \valid(\result + (0 .. count - 1))); */
ITEM *ALLOC(size_t count, size_t size);
#undef ITEM
#undef RESERVE
#undef ALLOC
