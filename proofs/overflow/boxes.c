/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/boxes.c: regions, distances from their corners, who is kept in one. Areas are numbers
 * of 64 bits here, heights too, and doubles in box_height: Frama-C has no numbers of 128 bits. Their values are no part
 * of the proof, but that each of the two products in box_height is at most 2^92 is: no number of 128 bits overflows. */
/* A search has lists of sites and of pairs in memory of their own, what does not change (sites, sets, known partners),
 * and the list of what is left. What a function does to one of them leaves the others: WP is told so after each change,
 * since it does not know of memory that is reserved where it is. Locals in memory (regions, the search) end before WP
 * looks at what is promised: `admit ensures apart` is of what was proved just before they end. */
#define __int128 long long
#include "faces.h"
#include "by_key.h"

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
#define dyd_cert_by_key(start, item, keys, entry, count) by_key_below(start, item, keys, entry, count, keys)
#define ITEM bool
#define RESERVE reserve_flags
#define ALLOC alloc_flags
#include "lists.h"
#define ITEM bool
#define ALLOC zeroed_flags
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
/*@ predicate grown(edges e) = \valid(e) && e->count <= e->cap <= 1152921504606846976 && pairs(e, SITES) &&
      (0 < e->cap ==> \valid(e->item + (0 .. e->cap - 1)) && \separated(e->item + (0 .. e->cap - 1), e)); */
/* The assignment of the empty list. */
/*@ requires \valid(to) && \valid_read(of); assigns *to; exits \false;
    ensures to->item == \old(of->item) && to->count == \old(of->count) && to->cap == \old(of->cap); */
void copy_edges(dyd_cert_edges *to, const dyd_cert_edges *of);
/* What graph.c proves of dyd_cert_edges_add; and that what was in the list stays, as in pairing.h: all of it where
 * memory fails. */
/*@ requires grown(edges) && i < SITES && j < SITES; assigns *edges, edges->item[0 .. edges->cap - 1]; exits \false;
    ensures grown(edges); */
dyd_status add_pair(dyd_cert_edges *edges, uint32_t i, uint32_t j);
#define dyd_cert_edges_add(edges, i, j) add_pair(edges, i, j)
/*@ requires \valid_read(a) && \valid_read(b); assigns \nothing; exits \false; */
int compare_edges(const dyd_cert_edge *a, const dyd_cert_edge *b);

typedef const dyd_cert_box *grid_box;
typedef const int64_t *spot;
/* What loops change nothing of. */
#define SAME_LIST (s == \at(s, Pre) && at == \at(at, Pre) && from == \at(from, Pre) && count == \at(count, Pre) && \
    pairs == \at(pairs, Pre) && \valid(pairs) && \separated(pairs, s))
#define SAME_REGION (s == \at(s, Pre) && r == \at(r, Pre) && count == \at(count, Pre) && pairs == \at(pairs, Pre) && \
    from == \at(from, Pre) + count && at == \at(at, Pre) + pairs && r->corners == \at(r->corners, Pre) && \
    r->depth == \at(r->depth, Pre))
#define SEARCHED (searching(s) && (st == DYD_OK ==> working(s) && sited(s, \at(from, Pre) + \at(count, Pre)) && \
    paired(s, \at(at, Pre) + \at(pairs, Pre))))
#define OUTER (\valid(is_outer + (0 .. SITES - 1)) && square_or_cone(r) && r->cone && r->depth <= 5 && \
    beside(s, r) && \separated(is_outer + (0 .. SITES - 1), r))
/* Of regions: corners near the grid; copies. */
#define NEAR(x) (-1152921505143717888 <= (x) <= 1152921505143717888)
#define TWO(c, k) (NEAR(c[k][0]) && NEAR(c[k][1]))
#define FOUR(r) (TWO((r)->corner, 0) && TWO((r)->corner, 1) && TWO((r)->corner, 2) && TWO((r)->corner, 3))
#define SAME(k) (to->corner[k][0] == of->corner[k][0] && to->corner[k][1] == of->corner[k][1])
#define SHAPED(a, b) ((a)->depth == (b)->depth + 1 && (a)->corners == (b)->corners && (a)->cone == (b)->cone && \
    (a)->stuck == (b)->stuck)

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
/* qsort, of pairs: it only moves them. */
/*@ requires 0 < count ==> \valid(item + (0 .. count - 1));
    assigns item[0 .. count - 1]; exits \false;
    ensures \old(\forall integer k; 0 <= k < count ==> item[k].i < SITES && item[k].j < SITES) ==>
      \forall integer k; 0 <= k < count ==> item[k].i < SITES && item[k].j < SITES; */
void sort_edges(dyd_cert_edge *item, size_t count);
/*@ requires \valid(left) && (0 < left->count ==> \valid(left->item + (0 .. left->count - 1)) &&
      \separated(left, left->item + (0 .. left->count - 1)));
    requires pairs(left, SITES);
    assigns left->count, left->item[0 .. left->count - 1]; exits \false; ensures left->count <= \old(left->count);
    ensures pairs(left, SITES); */
static void sort_left(dyd_cert_edges *left);

#include "checker/boxes.c"
