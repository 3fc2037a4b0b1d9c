/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/ties.c: points of a block are in their list, and of numbers and sites that are there. */
/* Without dyd_cert_ties_clear, side_holds_enclosure, side_is_number, side_lacks_number, side_holds_number,
   check_rectangles, enclose_difference, are_different, are_a_triangle, vector_clear, product_difference, vector_set,
   base_clear, base_set_line, base_set_circle, number_is_null, base_has, are_same, dyd_cert_fact_holds, read_members,
   read_kind, read_fact, read_points, read_block, dyd_cert_ties_read, fact_has_set, dyd_cert_ties_mark,
   dyd_cert_ties_aliases: not tried. */
#include "polys.h"

#include "base/alloc.h"
#include "base/error.h"

#include "checker/ties.h"

typedef const dyd_cert_block *block_of;

/*@ predicate block(block_of b) = \valid_read(b) && b->points <= 4294967295 &&
      (0 < b->points ==> \valid_read(b->point + (0 .. b->points - 1))); */

/*@ requires block(b); assigns \nothing; exits \false;
    ensures \result != \null ==> \subset(\result, b->point + (0 .. b->points - 1)) && \result->site == site; */
static const dyd_cert_described *find_described(const dyd_cert_block *b, uint32_t site);
/*@ requires reads(in) && string(name) && \valid(count) && most <= 4294967295 && \separated(count, in, in->err);
    exits \false; ensures \result == DYD_OK ==> *count <= most; */
static dyd_status read_count(uint32_t *count, dyd_cert_reader *in, const char *name, uint64_t most);
/*@ requires reads(in) && \valid(in->in) && \separated(in, in->err, in->in) && \valid(b) && \valid_read(s) &&
      (0 < in->cap ==> \valid(in->line + (0 .. in->cap - 1))) && 0 < s->count <= 4294967295 &&
      0 < b->algebra.count <= 4194304 && b->points < 4294967295;
    requires \valid(b->point + (0 .. b->points)) && \separated(b->point + (0 .. b->points), b, in, in->err, in->in, s);
    requires \separated(b, in, in->err, in->in, s, in->line + (0 .. in->cap - 1)) &&
      \separated(b->point + (0 .. b->points), in->line + (0 .. in->cap - 1)) &&
      \separated(in->in, in->line + (0 .. in->cap - 1));
    exits \false; */
static dyd_status read_point(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s);

#include "checker/ties.c"
