/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* calloc for lists of ITEM, under the name ALLOC. Included once for every kind of item. */

/*@ requires size == sizeof(ITEM); assigns \nothing; exits \false;
    ensures \result != \null && 0 < count ==> count <= 1152921504606846976 && \valid(\result + (0 .. count - 1)) &&
      (\forall integer k; 0 <= k < count ==> \result[k] == 0); */
ITEM *ALLOC(size_t count, size_t size);
#undef ITEM
#undef ALLOC
