/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/faces.c: open sets grow in their lists, and are found by sites that are there. */
/* Without dyd_cert_walk, faces_add_set, add_bounded_face, compare_place_of, dyd_cert_hull, check_places,
   compare_with_corner, check_corners, add_groups, split_rim, faces_add_outer, faces_add_all_sites, faces_find_sets,
   faces_index_sites, dyd_cert_faces_init, dyd_cert_faces_clear: not tried. */
#include "faces.h"

#include "base/alloc.h"
#include "checker/parts.h"
#include <string.h>

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"
#define ITEM size_t
#define RESERVE reserve_starts
#define ALLOC alloc_starts
#include "lists.h"
#define ITEM dyd_cert_shape
#define RESERVE reserve_shapes
#define ALLOC alloc_shapes
#include "lists.h"

/*@ requires \valid_read(s) && a < s->count && b < s->count; assigns \nothing; exits \false; */
int dyd_cert_compare_heights(const dyd_cert_sites *s, const dyd_exact u[2], uint32_t a, uint32_t b);
/*@ requires indexed(f) && i < SITES && j < SITES && \valid(a) && \valid(b);
    requires \separated(a, b, f, f->first + (0 .. SITES), f->of + (0 .. f->members - 1));
    assigns *a, *b; exits \false; ensures \result == DYD_CERT_NONE || \result < f->sets; */
static uint32_t next_common_set(const dyd_cert_faces *f, size_t *a, size_t *b, uint32_t i, uint32_t j);
/*@ requires \valid_read(item + (0 .. count - 1)) && 0 < count < 4294967295 && \valid(stack + (0 .. count - 1)) &&
      \valid(hull + (0 .. SITES - 1)) && (\forall integer k; 0 <= k < count ==> item[k] < SITES) &&
      \separated(stack + (0 .. count - 1), item + (0 .. count - 1), hull + (0 .. SITES - 1), s);
    requires \valid_read(s) && s->count == SITES && \valid_read(s->site + (0 .. SITES - 1));
    assigns hull[0 .. SITES - 1], stack[0 .. count - 1]; exits \false; */
static void mark_hull_chain(bool *hull, uint32_t *stack, const dyd_cert_sites *s, const uint32_t *item, size_t count,
                            bool back);

#include "checker/faces.c"
