/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/checker.c: what is read of sites and pairs is in their lists, in order. */
/* Without dyd_cert_expect_line, read_heading, read_site_and_point, dyd_cert_note_bound, check_goal, dyd_checker_head,
   read_alias, read_rectangle, dyd_checker_sites, read_witnessed, read_edges, dyd_checker_legal, side_holds_value,
   dyd_checker_places, dyd_checker_bridges, dyd_cert_corners_clear, checker_find_faces, dyd_checker_corners: not
   tried. */
#define __int128 long long /* of areas nothing is proved here */
#include "read.h"

#include "base/alloc.h"
#include "base/error.h"

#include "checker/checker.h"

#define ITEM dyd_cert_corner
#define RESERVE dyd_reserve
#define ALLOC alloc_corners
#include "lists.h"

typedef const dyd_checker *checking;

/*@ predicate checks(checking c) = \valid(c) && reads(&c->in) && c->sites.count <= 4294967295 &&
      (c->in.err != \null ==> \separated(c, c->in.err)) &&
      (0 < c->sites.count ==> \valid_read(c->sites.site + (0 .. c->sites.count - 1)) &&
        \separated(c->sites.site + (0 .. c->sites.count - 1), c, c->in.err, c->in.line + (0 .. c->in.cap - 1))); */

/*@ requires checks(c) && string(name) && \separated(c->in.line + (0 .. c->in.cap - 1), name + (0 .. stop(name)), c);
    requires \separated(c->in.err, name + (0 .. stop(name)));
    exits \false; */
dyd_status dyd_cert_expect_word(dyd_checker *c, const char *name);
/*@ requires checks(c) && count <= 64 && \valid(out) && \separated(out, c, c->in.err, text + (0 .. count - 1));
    requires \valid_read(text + (0 .. count - 1)) && \separated(c->in.err, c, text + (0 .. count - 1));
    exits \false;
    ensures \result == DYD_OK ==> *out < count; */
dyd_status dyd_cert_read_choice(size_t *out, dyd_checker *c, const char *const *text, size_t count);
/*@ requires checks(c) && \valid(out) && \separated(out, c, c->in.err, c->sites.site + (0 .. c->sites.count - 1));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *out, *c->in.err; exits \false;
    ensures \result == DYD_OK ==> reads(&c->in);
    ensures \result == DYD_OK ==> *out < c->sites.count; */
dyd_status dyd_cert_read_site(uint32_t *out, dyd_checker *c);
/*@ requires checks(c) && \valid(pair) && \separated(pair, c, c->in.err, c->sites.site + (0 .. c->sites.count - 1));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *pair, *c->in.err; exits \false;
    ensures \result == DYD_OK ==> pair->i < pair->j < c->sites.count; */
dyd_status dyd_cert_read_pair(dyd_cert_edge *pair, dyd_checker *c);
/*@ requires \valid(c) && c->count <= c->cap <= 1152921504606846976 && c->count < 4294967295 &&
      (0 < c->cap ==> \valid(c->item + (0 .. c->cap - 1))) && exact(u) && exact(u + 1);
    exits \false; ensures \result == DYD_OK ==> c->count == \old(c->count) + 1; */
static dyd_status corners_add(dyd_cert_corners *c, uint32_t i, const dyd_exact u[2]);

#include "checker/checker.c"
