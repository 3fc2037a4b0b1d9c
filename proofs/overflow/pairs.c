/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/pairs.c: pairs of the lists are of sites that are there. */
/* Without check_counts: a negative count is made unsigned to be compared, which C defines and which is forbidden here;
   all its other goals are proved. */
/* Without read_chain, check_chain, check_open, read_pair_line, read_pairs, dyd_cert_boxes_unproved, check_boxes,
   check_bounds, dyd_checker_pairs: not tried. */
#define __int128 long long /* of areas nothing is proved here */
#include "graph.h"

#include "checks.h"

#include "base/error.h"

/*@ requires \valid(b) && \valid_read(s) && i < s->count && j < s->count && \separated(b, s); assigns *b;
    exits \false; */
void dyd_cert_bounds_add(dyd_cert_bounds *b, const dyd_cert_sites *s, uint32_t i, uint32_t j, bool legal);
/*@ requires \valid(b) && \valid_read(c) && \separated(b, c, c->legal.item + (0 .. c->legal.count - 1),
      c->open.item + (0 .. c->open.count - 1)) && pairs(&c->legal, c->sites.count) && pairs(&c->open, c->sites.count);
    assigns *b; exits \false; */
static void add_all_pairs(dyd_cert_bounds *b, const dyd_checker *c);
/*@ requires checker(c) && \valid(present) && \valid(out) && exact(out) &&
      \separated(present, out, c, c->in.err, c->in.in, LINES + (..)) && \separated(out, &errno);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, *present, *out;
    exits \false; ensures \result == DYD_OK && *present ==> certified(out); */
static dyd_status read_bound(bool *present, dyd_exact *out, dyd_checker *c, const char *name);

#include "checker/pairs.c"
