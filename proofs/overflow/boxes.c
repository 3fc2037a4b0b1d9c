/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/boxes.c: regions, distances from their corners, who is kept in one. Areas are numbers
 * of 64 bits here, heights too, and doubles in box_height: Frama-C has no numbers of 128 bits. Their values are no part
 * of the proof, but that each of the two products in box_height is at most 2^92 is: no number of 128 bits overflows. */
/* Without list_region_pairs: tried. That *pairs is at most a * count (a product that grows) and that lists stay what
   they are while another is made longer stayed unknown: the invariants, the writes behind `at`, the conditions of
   dyd_reserve and dyd_cert_faces_share. */
/* Without add_left: tried. dyd_cert_edges_add, as graph.c proves it, says of a list that is longer only its last pair,
   not what else it leaves as it is: that the search and its pairs are there after a round stayed unknown. */
/* Without index_known: tried. That places in the list of partners are below its end, which rests on counting, was not
   decided in 2 s (rte_mem_access_11, 15, 27), nor loop invariants 3 and 6; the run was stopped at 52 of 139 goals. */
/* Without mark_outer_sites, keep_outer_sites: tried, with keep_region_sites promising that the search works on. What they
   promise, and the loop invariants that the search works on, were not decided in 2 s; in mark_outer_sites, that what is
   marked is in the list (rte_mem_access_2) was not either. */
/* Without look_around, look_everywhere: tried. That the search works on after a region (loop invariants 2 and 4), that
   h is what it is for its bits (an assert, and overflow of sums of it), and the conditions of look_at_region and
   keep_outer_sites were not decided in 2 s. */
/* Without look_at_region: tried. WP had not come to the first of 36 goals after 45 s. */
/* Without dyd_cert_boxes_left: tried. That the list of sites stays below their number (the first loop invariant) was not
   decided in 3 s; the run was stopped at 8 of 32 goals. */
#define __int128 long long
#include "faces.h"

#include "base/alloc.h"
#include "checker/tree.h"
#include <string.h>

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"
#define ITEM dyd_cert_edge
#define RESERVE reserve_pairs
#define ALLOC alloc_edges
#include "lists.h"
#define ITEM size_t
#define RESERVE reserve_sizes
#define ALLOC alloc_sizes
#include "lists.h"
#define ITEM bool
#define RESERVE reserve_flags
#define ALLOC alloc_flags
#include "lists.h"
#define ITEM bool
#define ALLOC zeroed_flags
#include "zeroed.h"
#define ITEM size_t
#define ALLOC zeroed_sizes
#include "zeroed.h"
#define ITEM uint64_t
#define ALLOC zeroed_stamps
#include "zeroed.h"

#define ITEM uint32_t
#define RESERVE dyd_reserve
#include "keeps.h"
#define ITEM dyd_cert_edge
#define RESERVE reserve_edges
#define KEPT(a, b) ((a).i == (b).i && (a).j == (b).j)
#include "keeps.h"
/*@ requires \valid_read(a) && \valid_read(b); assigns \nothing; exits \false; */
int compare_edges(const dyd_cert_edge *a, const dyd_cert_edge *b);

typedef const dyd_cert_box *grid_box;
typedef const int64_t *spot;

/*@ predicate box(grid_box b) = \valid_read(b);
    predicate near(spot c) = \valid_read(c + (0 .. 1)) &&
      (\forall integer k; 0 <= k < 2 ==> -1152921505143717888 <= c[k] <= 1152921505143717888); */

/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);
/*@ requires near(&c[0]) && box(b); assigns \nothing; exits \false; */
static dyd_cert_area far_from_corner(const int64_t c[2], const dyd_cert_box *b);
/*@ requires near(&c[0]) && box(b); assigns \nothing; exits \false; */
static dyd_cert_area near_from_corner(const int64_t c[2], const dyd_cert_box *b);

/*@ requires near(&corner[0]) && box(b); assigns \nothing; exits \false; */
static double box_height(const int64_t corner[2], const dyd_cert_box *b, bool upper);
/* box_height, as a number, for those who compare heights: CVC4 fails on comparisons of doubles. */
/*@ requires near(&corner[0]) && box(b); assigns \nothing; exits \false; */
long long height_of(const int64_t corner[2], const dyd_cert_box *b, bool upper);
/*@ requires 0 < count ==> \valid(item + (0 .. count - 1));
    assigns item[0 .. count - 1]; exits \false; */
void sort_edges(dyd_cert_edge *item, size_t count);
/*@ requires \valid(left) && (0 < left->count ==> \valid(left->item + (0 .. left->count - 1)) &&
      \separated(left, left->item + (0 .. left->count - 1)));
    assigns left->count, left->item[0 .. left->count - 1]; exits \false; ensures left->count <= \old(left->count); */
static void sort_left(dyd_cert_edges *left);

#include "checker/boxes.c"
