/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/tree.c: what is reckoned on the grid. Areas are numbers of 64 bits here, since Frama-C has
 * none of 128; they are unsigned, and their values are no part of the proof. */
/* Without compare_keyed, sort_tree_items, dyd_cert_tree_init, dyd_cert_tree_clear, dyd_cert_centre_set, visit_node,
   dyd_cert_tree_visit: not tried. */
#define __int128 long long
#include "exact.h"

#include "checker/tree.h"

typedef const dyd_cert_box *grid_box;
typedef const dyd_cert_centre *grid_centre;

/*@ predicate box(grid_box b) = \valid_read(b) && (\forall integer k; 0 <= k < 4 ==> 0 <= b->e[k]);
    predicate centre(grid_centre c) = \valid_read(c) &&
      (\forall integer k; 0 <= k < 4 ==> -1152921504606846976 <= c->e[k] <= 1152921504606846976); */

/*@ assigns \nothing; exits \false; */
static uint64_t spread_bits(uint64_t v);
/*@ requires box(b); assigns \nothing; exits \false; */
static uint64_t key_of_box(const dyd_cert_box *b);
/*@ requires \valid(out) && \valid_read(b) && \separated(out, b); assigns *out; exits \false; */
static void enclose_child(dyd_cert_box *out, const dyd_cert_box *b, bool first);
/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);
/*@ requires centre(c) && box(b); assigns \nothing; exits \false; */
dyd_cert_area dyd_cert_far_upper(const dyd_cert_centre *c, const dyd_cert_box *b);
/*@ requires centre(c) && box(b); assigns \nothing; exits \false; */
static dyd_cert_area near_lower(const dyd_cert_centre *c, const dyd_cert_box *b);

typedef const dyd_cert_tree *tree_of;

/* Levels below `level` are filled: seven times their nodes, and those to come, are as many as the items, and seven more
 * for each level. */
/*@ predicate forest(tree_of t) = \valid(t) && t->count <= 4294967295 && \valid_read(t->item + (0 .. t->count - 1)) &&
      \valid(t->node + (0 .. t->count / 4 + 11)) && \separated(t, t->node + (0 .. t->count / 4 + 11)) &&
      \separated(t->item + (0 .. t->count - 1), t->node + (0 .. t->count / 4 + 11)) &&
      (\forall integer q; 0 <= q < t->count ==> \valid_read(t->box + t->item[q]) &&
        \separated(t->box + t->item[q], t->node + (0 .. t->count / 4 + 11)));
    logic integer below(tree_of t, integer level) = level == 0 ? t->count : t->start[level] - t->start[level - 1];
    predicate filled(tree_of t, integer level) = 0 <= below(t, level) && 0 <= t->start[level] &&
      (0 < level ==> 0 <= t->start[level - 1]) &&
      7 * t->start[level] + below(t, level) <= t->count + 7 * level; */

/*@ requires \valid_read(t) && 0 <= level <= 12 && filled(t, level); assigns \nothing; exits \false;
    ensures \result == below(t, level); */
static size_t size_below(const dyd_cert_tree *t, int level);
/*@ requires forest(t) && 0 <= level <= 11 && filled(t, level) && q < below(t, level); assigns \nothing; exits \false;
    ensures level == 0 ==> \result == t->box + t->item[q];
    ensures 0 < level ==> \result == t->node + (t->start[level - 1] + q); */
static const dyd_cert_box *tree_child(const dyd_cert_tree *t, int level, size_t q);
/*@ requires forest(t) && 0 <= level <= 11 && filled(t, level);
    assigns t->start[level + 1], t->node[0 .. t->count / 4 + 11]; exits \false;
    ensures filled(t, level + 1) && 8 * below(t, level + 1) <= below(t, level) + 7; */
static void fill_level(dyd_cert_tree *t, int level);

#include "checker/tree.c"
