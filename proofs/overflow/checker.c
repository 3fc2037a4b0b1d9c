/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/checker.c: what is read of sites and pairs is in their lists, in order. */
/* Without dyd_checker_head: of four lines one after another, that the reader is still what it was at the calls of
   dyd_cert_expect_line, dyd_cert_read_choice and check_goal stays unknown (six goals, of 5 s each). */
/* Without read_alias, read_rectangle, dyd_checker_sites, read_witnessed, read_edges, dyd_checker_legal,
   dyd_checker_places, dyd_checker_bridges, checker_find_faces, dyd_checker_corners: not tried. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"

#include "base/alloc.h"
#include "base/error.h"

#define ITEM dyd_cert_corner
#define RESERVE dyd_reserve
#define ALLOC alloc_corners
#include "lists.h"

/*@ requires checker(c) && \valid(count) && most <= 4294967295 &&
      \separated(count, c, c->in.err, c->in.in, LINES + (..));
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, *count; exits \false;
    ensures \result == DYD_OK ==> reads(&c->in) && *count <= most; */
static dyd_status read_heading(uint32_t *count, dyd_checker *c, const char *name, uint64_t most);
/*@ requires checker(c) && point(c) && \separated(c, &errno) && \valid(i) && \separated(i, c, c->in.err, c->in.in, LINES + (..)) &&
      \separated(i, c->sites.site + (0 .. c->sites.count - 1));
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, *i, c->point[0 .. 1];
    exits \false;
    ensures \result == DYD_OK ==> kept(&c->in);
    ensures \result == DYD_OK ==> *i < c->sites.count && certified(&c->point[0]) && certified(&c->point[1]); */
static dyd_status read_site_and_point(uint32_t *i, dyd_checker *c, bool first, const char *list);
/*@ requires \valid_read(s) && exact(&s->lo) && exact(&s->hi) && exact(v); assigns \nothing; exits \false; */
static bool side_holds_value(const dyd_cert_side *s, const dyd_exact *v);
/*@ requires checker(c);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno,
      c->report.goal_bits, c->report.goal; exits \false;
    ensures \result == DYD_OK ==> \old(-999999999999999999 <= c->report.goal_bits <= 999999999999999999) ==>
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999; */
static dyd_status check_goal(dyd_checker *c);
/*@ requires \valid(c) && c->count <= 1152921504606846976 &&
      (0 < c->count ==> \valid(c->item + (0 .. c->count - 1)) && \separated(c, c->item + (0 .. c->count - 1)));
    exits \false; */
void dyd_cert_corners_clear(dyd_cert_corners *c);
/*@ requires \valid(c) && c->count <= c->cap <= 1152921504606846976 && c->count < 4294967295 &&
      (0 < c->cap ==> \valid(c->item + (0 .. c->cap - 1))) && exact(u) && exact(u + 1);
    exits \false; ensures \result == DYD_OK ==> c->count == \old(c->count) + 1; */
static dyd_status corners_add(dyd_cert_corners *c, uint32_t i, const dyd_exact u[2]);

#include "checker/checker.c"
