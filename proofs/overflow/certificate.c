/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/certificate.c: the words that are compared are there. */
/* Without checker_ties, checker_end: 43 of 49 and 7 of 12 goals are proved; that what was read before stays while a
   block or the diagram is read (loop invariants, conditions of strncmp, dyd_cert_faces_still, dyd_cert_next_line,
   dyd_cert_expect_word, the ensures) was not decided in 5 s: these callees do not say what else stays. */
/* Without dyd_verify_certificate: 8 of 9 goals are proved, where it is admitted that a checker that was begun is empty
   and can be cleared after any outcome; open is the condition of dyd_abi_give, of void pointers cast there and back. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"
#include "pairing.h"

#include "base/error.h"

/*@ predicate reported(checking c) = \valid_read(c) && string(c->report.outcome) && string(c->report.goal); */

/*@ requires reported(c) && (c->in.err == \null || \valid(c->in.err)); assigns *c->in.err; exits \false; */
static dyd_status checker_outcome(const dyd_checker *c);
/*@ requires reported(c); assigns \nothing; exits \false; */
static bool outcome_is_proved(const dyd_checker *c, bool stays);

/* Of the other files, without what they say of sites, trees and numbers; and that what is cleared is all that changes:
 * of memory that is freed nothing is said. */
/*@ requires \valid(s); assigns *s; exits \false; */
void dyd_cert_sites_init(dyd_cert_sites *s);
/*@ requires \valid(c); assigns *c; exits \false; */
void dyd_cert_chain_init(dyd_cert_chain *c);
/*@ requires \valid(s); assigns *s; exits \false; */
void dyd_cert_sites_clear(dyd_cert_sites *s);
/*@ requires \valid(t); assigns *t; exits \false; */
void dyd_cert_tree_clear(dyd_cert_tree *t);
/*@ predicate cleared_ties(dyd_cert_ties *t) = \valid(t) && t->blocks <= 1152921504606846976 &&
      (0 < t->blocks ==> \valid(t->block + (0 .. t->blocks - 1))) &&
      (\forall integer k; 0 <= k < t->blocks ==> \valid(t->block[k]) && \separated(t, t->block[k]) &&
        \separated(t->block + (0 .. t->blocks - 1), t->block[k]));
    predicate cleared_corners(dyd_cert_corners *c) = \valid(c) && c->count <= 1152921504606846976 &&
      (0 < c->count ==> \valid(c->item + (0 .. c->count - 1)) && \separated(c, c->item + (0 .. c->count - 1))); */
/*@ requires cleared_ties(t); assigns *t; exits \false; */
void dyd_cert_ties_clear(dyd_cert_ties *t);
/*@ requires cleared_corners(c); assigns *c; exits \false; */
void dyd_cert_corners_clear(dyd_cert_corners *c);
/*@ requires \valid(f); assigns *f; exits \false; */
void dyd_cert_faces_clear(dyd_cert_faces *f);
/*@ requires \valid(c) && (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1))) && c->cap <= 1152921504606846976;
    assigns *c; exits \false; */
void dyd_cert_chain_clear(dyd_cert_chain *c);

/*@ requires \valid(c); assigns *c; exits \false; */
void dyd_checker_init(dyd_checker *c, FILE *in, dyd_error *err);
/*@ requires \valid(c) && cleared_ties(&c->ties) && cleared_corners(&c->corners) && point(c) &&
      c->chain.cap <= 1152921504606846976 && (0 < c->chain.cap ==> \valid(c->chain.point + (0 .. c->chain.cap - 1)));
    requires \separated(c, c->ties.block + (0 .. c->ties.blocks - 1));
    assigns *c; exits \false; */
void dyd_checker_clear(dyd_checker *c);

/* Of ties.c. */
typedef const dyd_cert_ties *facts_of;
/*@ predicate blocks(facts_of t) = \valid_read(t) && t->blocks <= 1152921504606846976 &&
      (0 < t->blocks ==> \valid_read(t->block + (0 .. t->blocks - 1))) &&
      (\forall integer k; 0 <= k < t->blocks ==> \valid_read(t->block[k])); */
/*@ requires \valid(t) && blocks(t) && reads(in) && \valid_read(s); exits \false;
    ensures \result == DYD_OK ==> blocks(t); ensures \result == DYD_OK ==> kept(in); */
dyd_status dyd_cert_ties_read(dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_sites *s);
/*@ requires \valid(f) && indexed(f) && \valid_read(t); assigns f->tied[0 .. f->sets - 1]; exits \false; */
void dyd_cert_ties_mark(dyd_cert_faces *f, const dyd_cert_ties *t);
/*@ requires \valid_read(t) && \valid_read(s) && \valid(out); assigns *out; exits \false; */
dyd_status dyd_cert_ties_aliases(size_t *out, const dyd_cert_ties *t, const dyd_cert_sites *s);

/*@ predicate tied(checking c) = checker(c) && c->sites.count == SITES && indexed(&c->faces) && pairs(&c->tie, SITES) &&
      blocks(&c->ties); */
/*@ requires tied(c); exits \false; ensures \result == DYD_OK ==> begun(c); */
static dyd_status checker_ties(dyd_checker *c);
/*@ requires checks(c) && \valid(&c->report); exits \false; */
dyd_status dyd_checker_diagram(dyd_checker *c);
/*@ predicate standing(checking c) = \valid_read(c) && c->sites.count == SITES && pairs(&c->legal, SITES) &&
      pairs(&c->open, SITES) && indexed(&c->faces) &&
      (0 < SITES ==> \valid_read(c->sites.site + (0 .. SITES - 1))) &&
      (\forall integer i; 0 <= i < SITES ==> c->sites.site[i].alias < SITES) && string(c->report.goal); */
/*@ requires tied(c) && reported(c); exits \false;
    ensures \result == DYD_OK ==> checker(c);
    ensures \result == DYD_OK ==> reported(c) && standing(c); */
static dyd_status checker_end(dyd_checker *c);
/* Of still.c, and that only *out changes. */
/*@ requires \valid(out) && standing(c) && (still == \null || \valid_read(still + (0 .. SITES - 1))) &&
      \separated(out, c, still + (0 .. SITES - 1), c->sites.site + (0 .. SITES - 1));
    assigns *out; exits \false; */
dyd_status dyd_checker_stays(bool *out, const dyd_checker *c, const bool *still);
/*@ requires \valid(c) && reported(c) && (c->in.err == \null || \valid(c->in.err)) && \separated(c, c->in.err) &&
      standing(c) && (still == \null || \valid_read(still + (0 .. SITES - 1)));
    assigns c->report.gaps, *c->in.err; exits \false; */
dyd_status dyd_checker_settle(dyd_checker *c, const bool *still);

/* What each part leaves to the next. */
/*@ predicate prepared(checking c) = checker(c) && point(c) && \separated(c, &errno) &&
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999;
    predicate graphed(checking c) = prepared(c) && c->sites.count == SITES && grows(&c->legal) && grows(&c->bridges) &&
      \separated(c->legal.item + (0 .. c->legal.cap - 1), c, c->in.err) &&
      \separated(c->bridges.item + (0 .. c->bridges.cap - 1), c, c->in.err); */
/*@ requires prepared(c) && c->sites.count == 0; exits \false;
    ensures \result == DYD_OK ==> prepared(c) && c->sites.count == 0; */
dyd_status dyd_checker_head(dyd_checker *c);
/*@ requires prepared(c) && c->sites.count == 0; exits \false;
    ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_sites(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_legal(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_places(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_bridges(dyd_checker *c);
/*@ requires graphed(c); exits \false;
    ensures \result == DYD_OK ==> checker(c) && open_pairs(c) && blocked(c);
    ensures \result == DYD_OK ==> -999999999999999999 <= c->report.goal_bits <= 999999999999999999; */
dyd_status dyd_checker_corners(dyd_checker *c);
/*@ requires checker(c);
    requires open_pairs(c);
    requires blocked(c) && -999999999999999999 <= c->report.goal_bits <= 999999999999999999;
    exits \false; ensures \result == DYD_OK ==> tied(c) && reported(c); */
dyd_status dyd_checker_pairs(dyd_checker *c);
/*@ requires prepared(c) && c->sites.count == 0; exits \false;
    ensures \result == DYD_OK ==> checker(c);
    ensures \result == DYD_OK ==> reported(c) && standing(c); */
dyd_status dyd_checker_run(dyd_checker *c);

#include "checker/certificate.c"
