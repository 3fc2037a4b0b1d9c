/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/certificate.c: the words that are compared are there. */
/* Without checker_sections, settle_sections, run_nearest: contract not written yet. */
/* Without checker_end, dyd_checker_clear, dyd_checker_settle: they call functions of sections without contracts. */
/* Without checker_clear_second, read_second, read_last_lines, checker_sphere, checker_settle_second,
   checker_settle_sphere: the second certificate has a checker of its own, of which no header says anything. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"
#include "pairing.h"

#include "base/abi.h"
#include "base/error.h"

#include "literals.h"

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
/*@ requires \valid(g); assigns *g; exits \false; */
void dyd_cert_globe_init(dyd_cert_globe *g);
/*@ requires \valid(g); assigns *g; exits \false; */
void dyd_cert_globe_clear(dyd_cert_globe *g);
/*@ requires \valid(c); assigns c->second; exits \false; */
static void checker_clear_second(dyd_checker *c);
/*@ requires \valid(s); assigns *s; exits \false; */
void dyd_cert_sites_clear(dyd_cert_sites *s);
/*@ requires \valid(t); assigns *t; exits \false; */
void dyd_cert_tree_clear(dyd_cert_tree *t);
/*@ predicate cleared_corners(dyd_cert_corners *c) = \valid(c) && c->count <= 1152921504606846976 &&
      (0 < c->count ==> \valid(c->item + (0 .. c->count - 1)) && \separated(c, c->item + (0 .. c->count - 1))); */
/*@ requires blocks(t); assigns *t; exits \false; */
void dyd_cert_ties_clear(dyd_cert_ties *t);
/*@ requires cleared_corners(c); assigns *c; exits \false; */
void dyd_cert_corners_clear(dyd_cert_corners *c);
/*@ requires \valid(f); assigns *f; exits \false; */
void dyd_cert_faces_clear(dyd_cert_faces *f);
/*@ requires \valid(c) && (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1))) && c->cap <= 1152921504606846976;
    assigns *c; exits \false; */
void dyd_cert_chain_clear(dyd_cert_chain *c);

/* Of discs.c, where it is not proved. */
/*@ requires \valid(c); assigns *c; exits \false; */
void dyd_checker_discs_clear(dyd_checker *c);

/*@ requires \valid(c); assigns *c; exits \false; */
void dyd_checker_init(dyd_checker *c, FILE *in, dyd_error *err);
/*@ requires \valid(c) && blocks(&c->ties) && cleared_corners(&c->corners) && point(c) &&
      c->chain.cap <= 1152921504606846976 && (0 < c->chain.cap ==> \valid(c->chain.point + (0 .. c->chain.cap - 1)));
    requires \separated(c, c->ties.block + (0 .. c->ties.blocks - 1));
    assigns *c; exits \false; */
void dyd_checker_clear(dyd_checker *c);

/* Of ties.c, which asks less, and proves that its lists stay; that all else which is known stays is not proved
 * there. */
/*@ requires pairing(c) && begun(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
dyd_status read_ties(dyd_checker *c);
#define dyd_cert_ties_read(t, in, s) read_ties(c)
/*@ requires \valid(f) && indexed(f) && stated(t); assigns f->tied[0 .. f->sets - 1]; exits \false; */
void dyd_cert_ties_mark(dyd_cert_faces *f, const dyd_cert_ties *t);
/*@ requires stated(t) && \valid_read(s) && s->count == SITES && \valid(out) &&
      \separated(out, t, s, t->fact + (0 .. t->facts - 1), s->site + (0 .. SITES - 1)) &&
      (0 < SITES ==> \valid_read(s->site + (0 .. SITES - 1))) &&
      (\forall integer i; 0 <= i < SITES ==> s->site[i].alias < SITES);
    assigns *out; exits \false; */
dyd_status dyd_cert_ties_aliases(size_t *out, const dyd_cert_ties *t, const dyd_cert_sites *s);

/*@ requires pairing(c); exits \false;
    ensures \result == DYD_OK ==> pairing(c); ensures \result == DYD_OK ==> begun(c); */
static dyd_status checker_ties(dyd_checker *c);
/* What they leave is not proved. */
/*@ requires pairing(c) && begun(c); exits \false; ensures \result == DYD_OK ==> pairing(c) && begun(c); */
static dyd_status checker_sections(dyd_checker *c);
/*@ requires pairing(c) && (still == \null || \valid_read(still + (0 .. SITES - 1)));
    assigns c->report.gaps, c->report.undescribed; exits \false; ensures pairing(c); */
static void settle_sections(dyd_checker *c, const bool *still);
/* Of diagram.c, which asks less; and that what is known stays, which is not proved there: of the checker, the reader,
 * the chain's points, the report and whether the goal was reached change. */
/*@ requires pairing(c) && begun(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
dyd_status dyd_checker_diagram(dyd_checker *c);
/*@ requires pairing(c) && begun(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
static dyd_status checker_sphere(dyd_checker *c);
/* Of read.h, and that what is known stays. */
/*@ requires pairing(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
dyd_status expect_end(dyd_checker *c);
#define dyd_cert_expect_end(r) expect_end(c)
/*@ predicate standing(checking c) = \valid_read(c) && c->sites.count == SITES && pairs(&c->legal, SITES) &&
      pairs(&c->open, SITES) && indexed(&c->faces) &&
      (0 < SITES ==> \valid_read(c->sites.site + (0 .. SITES - 1))) &&
      (\forall integer i; 0 <= i < SITES ==> c->sites.site[i].alias < SITES) && string(c->report.goal); */
/*@ requires pairing(c) && begun(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
static dyd_status checker_end(dyd_checker *c);
/* Of still.c, and that only *out changes. */
/*@ requires \valid(out) && standing(c) && (still == \null || \valid_read(still + (0 .. SITES - 1))) &&
      \separated(out, c, still + (0 .. SITES - 1), c->sites.site + (0 .. SITES - 1));
    assigns *out; exits \false; */
dyd_status dyd_checker_stays(bool *out, const dyd_checker *c, const bool *still);
/*@ requires pairing(c) && \valid(stays) && (still == \null || \valid_read(still + (0 .. SITES - 1)));
    assigns c->report.gaps, *c->in.err, *stays; exits \false; */
static dyd_status checker_settle_sphere(bool *stays, dyd_checker *c, const bool *still);
/*@ requires pairing(c) && (still == \null || \valid_read(still + (0 .. SITES - 1)));
    assigns c->report.gaps, c->report.undescribed, *c->in.err; exits \false; */
dyd_status dyd_checker_settle(dyd_checker *c, const bool *still);

/* What each part leaves to the next; what checker.c does not prove of them is that the rest stays, that sites which
 * were read are of numbers that certificates have, that texts are there after dyd_checker_head, and
 * dyd_checker_corners. */
/*@ predicate unpaired(checking c) = blocked(c) && grows(&c->open) && grows(&c->tie) && grows(&c->chained) &&
      listing(&c->ties) && blocks(&c->ties) && c->corners.count == 0 && c->corners.cap == 0;
    predicate prepared(checking c) = checker(c) && point(c) && \separated(c, &errno) && unpaired(c) &&
      grows(&c->legal) && grows(&c->bridges) && -999999999999999999 <= c->report.goal_bits <= 999999999999999999;
    predicate empty(checking c) = prepared(c) && c->sites.count == 0 && c->sites.cap == 0;
    predicate graphed(checking c) = prepared(c) && reported(c) && c->sites.count == SITES && certified_sites(c) &&
      \separated(c->sites.site + (0 .. SITES - 1), c->legal.item + (0 .. c->legal.cap - 1),
        c->bridges.item + (0 .. c->bridges.cap - 1), c, c->in.err); */
/*@ requires empty(c); exits \false; ensures \result == DYD_OK ==> empty(c) && reported(c); */
dyd_status dyd_checker_head(dyd_checker *c);
/*@ requires empty(c) && reported(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_sites(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
static dyd_status run_nearest(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_legal(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_places(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> graphed(c); */
dyd_status dyd_checker_bridges(dyd_checker *c);
/*@ requires graphed(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
dyd_status dyd_checker_corners(dyd_checker *c);
/*@ requires pairing(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
dyd_status dyd_checker_pairs(dyd_checker *c);
/*@ requires empty(c); exits \false; ensures \result == DYD_OK ==> pairing(c); */
dyd_status dyd_checker_run(dyd_checker *c);

/* Structs that begin with their size, of which base/error.c touches no byte beyond it: WP's memory does not follow
 * casts from pointers to void. */
typedef dyd_certificate_report *report_of;
/*@ requires \valid_read(&theirs->struct_size) && (err == \null || \valid(err)); assigns *err; exits \false; */
dyd_status check_report(const dyd_certificate_report *theirs, dyd_error *err);
#define dyd_abi_check(theirs, least, type, err) check_report(theirs, err)
/*@ requires \valid_read(&theirs->struct_size) && \valid_read(own) && \separated(theirs, own) &&
      size == sizeof(dyd_certificate_report);
    assigns *theirs; exits \false; */
void give_report(dyd_certificate_report *theirs, const dyd_certificate_report *own, size_t size);
#define dyd_abi_give(theirs, own, size) give_report(theirs, own, size)
/*@ requires \valid(err); assigns *err; exits \false; */
void dyd_error_clear(dyd_error *err);
/*@ requires \valid(out) && \valid(in) && (err == \null || \valid(err)) && \separated(out, in, err, LINES + (..));
    exits \false; */
dyd_status dyd_checker_verify(dyd_certificate_report *out, FILE *in, dyd_error *err);

#include "checker/certificate.c"
