/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of a certificate that is being checked, and contracts of src/checker/checker.c and what it calls. */
#ifndef DYD_PROOFS_CHECKS_H
#define DYD_PROOFS_CHECKS_H

#include "read.h"

#include "checker/checker.h"

typedef const dyd_checker *checking;

/*@ predicate listed(checking c) = c->sites.count <= 4294967295 &&
      (0 < c->sites.count ==> \valid(c->sites.site + (0 .. c->sites.count - 1)) &&
        \separated(c->sites.site + (0 .. c->sites.count - 1), c, c->in.err, c->in.in, LINES + (..)));
    predicate checker(checking c) = \valid(c) && kept(&c->in) && \separated(c, c->in.err, c->in.in, LINES + (..)) &&
      listed(c);
    predicate checks(checking c) = checker(c) && reads(&c->in);
    predicate point(checking c) = exact(&c->point[0]) && exact(&c->point[1]); */

/* That checker(c) holds in the end, part by part, which CVC4 does not prove as one. */
#define CHECKER_LEFT \
  ensures \result == DYD_OK ==> \valid(c); \
  ensures \result == DYD_OK ==> \valid(c->in.in); \
  ensures \result == DYD_OK ==> c->in.err == \null || \valid(c->in.err); \
  ensures \result == DYD_OK ==> c->in.cap <= 1152921504606846976; \
  ensures \result == DYD_OK && 0 < c->in.cap ==> \valid(c->in.line + (0 .. c->in.cap - 1)); \
  ensures \result == DYD_OK && 0 < c->in.cap ==> \base_addr(c->in.line) == \base_addr(LINES + 0); \
  ensures \result == DYD_OK ==> \separated(c, c->in.err, c->in.in, LINES + (..)); \
  ensures \result == DYD_OK ==> \separated(&c->in, c->in.err, c->in.in, LINES + (..)); \
  ensures \result == DYD_OK ==> c->sites.count <= 4294967295; \
  ensures \result == DYD_OK && 0 < c->sites.count ==> \valid(c->sites.site + (0 .. c->sites.count - 1)); \
  ensures \result == DYD_OK && 0 < c->sites.count ==> \separated(c->sites.site + (0 .. c->sites.count - 1), c, \
    c->in.err, c->in.in, LINES + (..));

/* Of a local object: it is none of those that pointers of c lead to, which then are there when it is not. */
#define OUTSIDE(x) (\base_addr(x) != \base_addr(c) && \base_addr(x) != \base_addr(c->in.err) && \
    \base_addr(x) != \base_addr(c->in.in) && \base_addr(x) != \base_addr(LINES + 0) && \
    \base_addr(x) != \base_addr(c->sites.site))

/*@ requires checks(c);
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *c->in.err; exits \false; ensures \result == DYD_OK ==>
      checks(c); */
dyd_status dyd_cert_expect_word(dyd_checker *c, const char *name);
/*@ requires checker(c);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno; exits \false;
    ensures \result == DYD_OK ==> checks(c); */
dyd_status dyd_cert_expect_line(dyd_checker *c, const char *name);
/*@ requires checks(c) && count <= 64 && \valid(out) && \separated(out, c, c->in.err, text + (0 .. count - 1));
    requires \separated(out, c->in.in, LINES + (..));
    requires \valid_read(text + (0 .. count - 1)) && \separated(c->in.err, c, text + (0 .. count - 1));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *out, *c->in.err;
    exits \false;
    ensures \result == DYD_OK ==> checks(c);
    ensures \result == DYD_OK ==> *out < count; */
dyd_status dyd_cert_read_choice(size_t *out, dyd_checker *c, const char *const *text, size_t count);
/*@ requires checks(c) && \valid(out) && \separated(out, c, c->in.err, c->sites.site + (0 .. c->sites.count - 1));
    requires \separated(out, c->in.in, LINES + (..));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *out, *c->in.err; exits \false;
    ensures \result == DYD_OK ==> checks(c);
    ensures \result == DYD_OK ==> *out < c->sites.count; */
dyd_status dyd_cert_read_site(uint32_t *out, dyd_checker *c);
/*@ requires checks(c) && \valid(pair) && \separated(pair, c, c->in.err, c->sites.site + (0 .. c->sites.count - 1));
    requires \separated(pair, c->in.in, LINES + (..));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *pair, *c->in.err; exits \false;
    ensures \result == DYD_OK ==> checks(c);
    ensures \result == DYD_OK ==> pair->i < pair->j < c->sites.count; */
dyd_status dyd_cert_read_pair(dyd_cert_edge *pair, dyd_checker *c);
/*@ requires \valid(c) && string(c->report.goal) && certified(bound) &&
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999;
    assigns c->reached; exits \false; */
void dyd_cert_note_bound(dyd_checker *c, const char *goal, const dyd_exact *bound);
/*@ requires \valid_read(s) && \valid_read(t) && i < s->count && j < s->count && small(c) && small(c + 1) &&
      (other == \null || \valid(other));
    assigns *other; exits \false; */
bool dyd_cert_is_witness(uint32_t *other, const dyd_cert_sites *s, const dyd_cert_tree *t, uint32_t i, uint32_t j,
                         const dyd_exact c[2], bool places);

#endif
