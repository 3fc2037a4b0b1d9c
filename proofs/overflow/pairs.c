/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/pairs.c: pairs of the lists are of sites that are there. */
/* Without check_open: that the list of lines l grows like the others is not said yet. */
#define __int128 long long /* of areas nothing is proved here */
#include "faces.h"

#include "chains.h"
#include "checks.h"
#include "pairing.h"

#include "base/error.h"

#include "literals.h"

typedef const dyd_cert_bounds *sum_of;
/*@ predicate sum(sum_of b) = fraction(&b->area2, 274877906944); */
/* Sites are of numbers that certificates have, and a sum, which is a local object, is apart from them. */
/*@ predicate rectangle(site_to_read t) = \valid_read(t) && small_side(&t->side[0]) && small_side(&t->side[1]);
    predicate beside(sum_of b, site_to_read t) = \separated(b, t) && apart_from_side(b, &t->side[0]) &&
      apart_from_side(b, &t->side[1]);
    predicate bounding(sum_of b, sites_of s) =
      \forall integer i; 0 <= i < s->count ==> rectangle(s->site + i) && beside(b, s->site + i);
    predicate limited(sum_of b) = b->hausdorff == \null || small(b->hausdorff) && \separated(b, b->hausdorff); */
/*@ requires \valid(b) && sum(b) && limited(b) && \valid_read(s) && \separated(b, s) && rectangle(s->site + i) &&
      rectangle(s->site + j) && beside(b, s->site + i) && beside(b, s->site + j);
    assigns FRACTION(&b->area2), b->exceeded; exits \false; ensures sum(b); */
void dyd_cert_bounds_add(dyd_cert_bounds *b, const dyd_cert_sites *s, uint32_t i, uint32_t j, bool legal);
/*@ requires \valid(b) && \valid_read(c) && \separated(b, c, c->legal.item + (0 .. c->legal.count - 1),
      c->open.item + (0 .. c->open.count - 1)) && pairs(&c->legal, c->sites.count) && pairs(&c->open, c->sites.count);
    requires sum(b); requires limited(b); requires bounding(b, &c->sites);
    assigns FRACTION(&b->area2), b->exceeded; exits \false; ensures sum(b); */
static void add_all_pairs(dyd_cert_bounds *b, const dyd_checker *c);
/*@ requires checker(c) && \valid(present) && \valid(out) && exact(out) &&
      \separated(present, out, c, c->in.err, c->in.in, LINES + (..)) && \separated(out, &errno);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, *present, *out;
    exits \false; ensures \result == DYD_OK ==> kept(&c->in);
    ensures \result == DYD_OK && *present ==> certified(out);
    ensures \result == DYD_OK ==> exact(out); ensures whole(&out->man[0]); */
static dyd_status read_bound(bool *present, dyd_exact *out, dyd_checker *c, const char *name);

#define known_pairs(k) (pairs((k)->list[0], SITES) && pairs((k)->list[1], SITES) && pairs((k)->list[2], SITES))

/* Of boxes.c, where it is not proved: what is left is of sites that are there. */
/*@ requires \valid(left) && \valid(given_up) && \valid_read(s) && s->count == SITES && indexed(f) &&
      \valid_read(known) && known_pairs(known);
    assigns *left, *given_up; exits \false; ensures \result == DYD_OK ==> pairs(left, SITES); */
dyd_status dyd_cert_boxes_left(dyd_cert_edges *left, bool *given_up, const dyd_cert_sites *s, const dyd_cert_faces *f,
                               const dyd_cert_known *known);
/*@ requires \valid(out) && \valid_read(s) && s->count == SITES && indexed(f) && \valid_read(known) &&
      known_pairs(known) &&
      \separated(out, f, f->first + (0 .. SITES), f->of + (0 .. f->members - 1), f->start + (0 .. f->sets),
        f->covered + (0 .. f->sets - 1));
    assigns *out; exits \false; */
dyd_status dyd_cert_boxes_unproved(uint64_t *out, const dyd_cert_sites *s, const dyd_cert_faces *f,
                                   const dyd_cert_known *known);

/*@ requires checks(c);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno,
      c->report.triangles;
    exits \false; ensures \result == DYD_OK ==> kept(&c->in); */
static dyd_status check_counts(dyd_checker *c);
/* Of these and others with local objects, what is admitted in the end is asserted before: no pointer of a checker leads
 * to the objects that are gone then. */
/*@ requires begun(c) && pairing(c); exits \false;
    admit ensures apart: \result == DYD_OK ==> pairing(c);
    ensures \result == DYD_OK ==> reads(&c->in); */
static dyd_status check_boxes(dyd_checker *c);
/*@ requires pairing(c) && reads(&c->in) && \valid_read(pair) && pair->i < SITES && pair->j < SITES; exits \false;
    ensures \result == DYD_OK ==> pairing(c); */
static dyd_status check_open(dyd_checker *c, const dyd_cert_edge *pair, char kind);
/* So many points were read, and as many blockers. */
/*@ predicate small_number(exact_number x) = small(x);
    predicate point_read(chain_of c, integer k) = small_number(&c->point[k][0]) && small_number(&c->point[k][1]);
    predicate chaining(checking c, integer q) = pairing(c) && q <= c->chain.points &&
      (\forall integer k; 0 <= k < q ==> c->chain.blocker[k] < SITES) &&
      (\forall integer k; 0 <= k < q ==> point_read(&c->chain, k)) &&
      small(&c->chain.u[0][0]) && small(&c->chain.u[0][1]); */
/*@ requires pairing(c) && reads(&c->in); exits \false;
    ensures \result == DYD_OK ==> pairing(c);
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k <= c->chain.points ==> c->chain.blocker[k] < SITES;
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < c->chain.points ==> point_read(&c->chain, k);
    ensures \result == DYD_OK ==> small(&c->chain.u[0][0]) && small(&c->chain.u[0][1]);
    ensures \result == DYD_OK ==> small_number(&c->chain.u[1][0]) && small_number(&c->chain.u[1][1]); */
static dyd_status read_chain(dyd_checker *c);
/*@ requires pairing(c) && reads(&c->in) && \valid_read(pair) && pair->i < SITES && pair->j < SITES; exits \false;
    ensures \result == DYD_OK ==> pairing(c); */
static dyd_status check_chain(dyd_checker *c, const dyd_cert_edge *pair);
/*@ requires pairing(c) && reads(&c->in) && \valid(pair) &&
      \separated(pair, c, c->in.err, c->in.in, LINES + (..), c->sites.site + (0 .. c->sites.count - 1));
    exits \false; ensures \result == DYD_OK ==> pairing(c); */
static dyd_status read_pair_line(dyd_checker *c, dyd_cert_edge *pair);
/*@ requires pairing(c); exits \false;
    ensures \result == DYD_OK ==> pairing(c);
    ensures \result == DYD_OK ==> begun(c); */
static dyd_status read_pairs(dyd_checker *c);
/*@ requires pairing(c) && \valid(bound + (0 .. 1)) && exact(bound) && exact(bound + 1) &&
      \separated(bound + (0 .. 1), c, c->in.err, c->in.in, LINES + (..)) && \separated(bound + (0 .. 1), &errno);
    exits \false;
    ensures integer_of(bound[0].man[0].value);
    ensures integer_of(bound[1].man[0].value);
    admit ensures apart: \result == DYD_OK ==> pairing(c); */
static dyd_status check_bounds(dyd_checker *c, dyd_exact bound[2]);

/* What exact.h says of dyd_exact_set, for numbers of certificates. */
/*@ requires \valid(out) && small_number(x) && \separated(out, x); assigns *out; exits \false;
    ensures small_number(out); */
void copy_number(dyd_exact *out, const dyd_exact *x);
#define dyd_exact_set(out, x) copy_number(out, x)
/* What chain.c proves of dyd_cert_chain_resize, said of the checker that has the chain, of graph.c and pairing.h of
 * dyd_cert_edges_add likewise: and that all else stays, which WP does not see: new memory is new. Of a chain, points
 * and blockers before stay, and new points are numbers. */
/*@ requires pairing(c) && points <= 1152921504606846976;
    assigns c->chain.points, c->chain.cap, c->chain.point, c->chain.blocker; exits \false;
    ensures \result == DYD_OK ==> pairing(c) && c->chain.points == points <= c->chain.cap;
    ensures \result == DYD_OK && \old(reads(&c->in)) ==> reads(&c->in);
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < \old(c->chain.points) ==>
      c->chain.blocker[k] == \old(c->chain.blocker[k]);
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < points ==> exact(&c->chain.point[k][0]) &&
      exact(&c->chain.point[k][1]);
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < \old(c->chain.points) &&
      \old(point_read(&c->chain, k)) ==> point_read(&c->chain, k);
    ensures c->in.err == \null || \valid(c->in.err); */
dyd_status resize_chain(dyd_checker *c, size_t points);
#define dyd_cert_chain_resize(chain, points) resize_chain(c, points)
/*@ requires pairing(c) && (edges == &c->open || edges == &c->tie || edges == &c->chained) && i < SITES && j < SITES;
    assigns *edges, edges->item[0 .. edges->cap - 1]; exits \false; ensures \result == DYD_OK ==> pairing(c);
    ensures c->in.err == \null || \valid(c->in.err); */
dyd_status add_open_pair(dyd_checker *c, dyd_cert_edges *edges, uint32_t i, uint32_t j);
#undef dyd_cert_edges_add
#define dyd_cert_edges_add(edges, i, j) add_open_pair(c, edges, i, j)

/*@ requires \valid_read(s) && \valid_read(c) && (0 < c->points ==> certified_chain(c, s)) &&
      small_site(s->site + i) && small_site(s->site + j);
    assigns \nothing; exits \false; */
bool dyd_cert_chain_holds(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j);
/*@ requires \valid(b); assigns *b; exits \false; ensures sum(b); */
void dyd_cert_bounds_init(dyd_cert_bounds *b);
/*@ requires \valid(b) && of_parts(&b->area2); assigns b->area2; exits \false; */
void dyd_cert_bounds_clear(dyd_cert_bounds *b);
/*@ requires \valid_read(b) && exact(&b->area2.num) && small(area); assigns \nothing; exits \false; */
bool dyd_cert_bounds_area_holds(const dyd_cert_bounds *b, const dyd_exact *area);
/*@ requires pairing(c); exits \false; admit ensures apart: \result == DYD_OK ==> pairing(c); */
dyd_status dyd_checker_pairs(dyd_checker *c);

#include "checker/pairs.c"
