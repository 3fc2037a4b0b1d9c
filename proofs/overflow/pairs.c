/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/pairs.c: pairs of the lists are of sites that are there. */
/* Without read_chain, check_chain, check_open, read_pair_line, read_pairs, dyd_cert_boxes_unproved, check_boxes,
   check_counts, read_bound, check_bounds, dyd_checker_pairs: not tried. */
#define __int128 long long /* of areas nothing is proved here */
#include "graph.h"

#include "read.h"

#include "base/error.h"

#include "checker/checker.h"

/*@ requires \valid(b) && \valid_read(s) && i < s->count && j < s->count && \separated(b, s); assigns *b;
    exits \false; */
void dyd_cert_bounds_add(dyd_cert_bounds *b, const dyd_cert_sites *s, uint32_t i, uint32_t j, bool legal);
/*@ requires \valid(b) && \valid_read(c) && \separated(b, c, c->legal.item + (0 .. c->legal.count - 1),
      c->open.item + (0 .. c->open.count - 1)) && pairs(&c->legal, c->sites.count) && pairs(&c->open, c->sites.count);
    assigns *b; exits \false; */
static void add_all_pairs(dyd_cert_bounds *b, const dyd_checker *c);

#include "checker/pairs.c"
