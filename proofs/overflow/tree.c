/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/tree.c: what is reckoned on the grid. Areas are numbers of 64 bits here, since Frama-C has
 * none of 128; they are unsigned, and their values are no part of the proof. */
#define __int128 long long
#define SPELL_OUT
#include "centres.h"

#include "base/alloc.h"

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"
#define ITEM dyd_cert_box
#define RESERVE reserve_boxes
#define ALLOC alloc_boxes
#include "lists.h"

typedef const dyd_cert_box *grid_box;

/*@ predicate box(grid_box b) = \valid_read(b) && (\forall integer k; 0 <= k < 4 ==> 0 <= b->e[k]); */

/*@ assigns \nothing; exits \false; */
static uint64_t spread_bits(uint64_t v);
/*@ requires box(b); assigns \nothing; exits \false; */
static uint64_t key_of_box(const dyd_cert_box *b);
/*@ requires \valid(out) && \valid_read(b) && \separated(out, b); assigns *out; exits \false; */
static void enclose_child(dyd_cert_box *out, const dyd_cert_box *b, bool first);
/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);
/*@ requires centre(c) && \valid_read(b); assigns \nothing; exits \false; */
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
      7 * t->start[level] + below(t, level) <= t->count + 7 * level;
    predicate filled_to(tree_of t, integer level) = \forall integer k; 0 <= k <= level ==> filled(t, k); */

/*@ requires \valid_read(t) && 0 <= level <= 12 && filled(t, level); assigns \nothing; exits \false;
    ensures \result == below(t, level); */
static size_t size_below(const dyd_cert_tree *t, int level);
/*@ requires forest(t) && 0 <= level <= 11 && filled(t, level) && q < below(t, level); assigns \nothing; exits \false;
    ensures level == 0 ==> \result == t->box + t->item[q];
    ensures 0 < level ==> \result == t->node + (t->start[level - 1] + q); */
static const dyd_cert_box *tree_child(const dyd_cert_tree *t, int level, size_t q);
/*@ requires forest(t) && 0 <= level <= 11 && filled_to(t, level);
    assigns t->start[level + 1], t->node[0 .. t->count / 4 + 11]; exits \false;
    ensures filled_to(t, level); ensures filled(t, level + 1);
    ensures 8 * below(t, level + 1) <= below(t, level) + 7; */
static void fill_level(dyd_cert_tree *t, int level);

typedef const dyd_cert_sites *list_of_sites;

/* SITES: how many there are. */
/*@ axiomatic Sizes { logic integer SITES; axiom sites: 0 <= SITES <= 4294967295; }
    predicate placed(list_of_sites s) = \valid_read(s) && s->count == SITES &&
      (0 < s->count ==> \valid_read(s->site + (0 .. s->count - 1)) && \valid_read(s->box + (0 .. s->count - 1))) &&
      (\forall integer v, integer k; 0 <= v < s->count && 0 <= k < 4 ==> 0 <= s->box[v].e[k]);
    predicate listed(tree_of t, integer sites) = t->count <= sites && t->count <= 4294967295 &&
      \valid(t->item + (0 .. sites - 1)) && (\forall integer q; 0 <= q < t->count ==> t->item[q] < sites);
    logic integer most(integer level) = level == 0 ? 4294967296 : level == 1 ? 536870912 : level == 2 ? 67108864 :
      level == 3 ? 8388608 : level == 4 ? 1048576 : level == 5 ? 131072 : level == 6 ? 16384 : level == 7 ? 2048 :
      level == 8 ? 256 : level == 9 ? 32 : level == 10 ? 4 : 1;
    predicate grown(tree_of t) = forest(t) && 1 <= t->levels <= 11 && filled_to(t, t->levels - 1); */

/*@ requires \valid(t) && t->count == 0 && placed(s) && \separated(t, s) &&
      \separated(t, s->site + (0 .. s->count - 1)) && \separated(t, s->box + (0 .. s->count - 1));
    exits \false; ensures \result == DYD_OK || \result == DYD_E_NOMEM;
    ensures placed(s) && s->count == \old(s->count) && s->box == \old(s->box);
    ensures \valid(t) && t->box == \old(t->box) && t->levels == \old(t->levels) && t->start[0] == \old(t->start[0]);
    ensures \result == DYD_OK ==> listed(t, s->count); */
static dyd_status sort_tree_items(dyd_cert_tree *t, const dyd_cert_sites *s);
/*@ requires \valid(t); assigns *t; exits \false; */
void dyd_cert_tree_clear(dyd_cert_tree *t);
/*@ requires \valid(t) && placed(s) && \separated(t, s) && \separated(t, s->site + (0 .. s->count - 1)) &&
      \separated(t, s->box + (0 .. s->count - 1));
    exits \false; ensures \result == DYD_OK ==> grown(t); */
dyd_status dyd_cert_tree_init(dyd_cert_tree *t, const dyd_cert_sites *s);

/* Who visits changes what belongs to the context, of which the tree is no part. */
extern int visited;
/*@ assigns visited; exits \false; */
bool visit_any(void *context, uint32_t site);
#define visit(context, site) visit_any(context, site)

/*@ requires grown(t) && centre(c) && 0 <= level < t->levels; assigns visited; exits \false; */
static bool visit_node(const dyd_cert_tree *t, int level, size_t q, const dyd_cert_centre *c, dyd_cert_area limit,
                       dyd_cert_visit *visit, void *context);
/*@ requires (t->count == 0 || grown(t)) && centre(c) && \valid_read(t); assigns visited; exits \false; */
bool dyd_cert_tree_visit(const dyd_cert_tree *t, const dyd_cert_centre *c, dyd_cert_area limit, dyd_cert_visit *visit,
                         void *context);

#include "checker/tree.c"
