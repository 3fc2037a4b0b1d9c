/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/ties.c: points of a block are in their list, and of numbers and sites that are there. */
#include "numbers.h"
#include "enclosures.h"
#include "facts.h"

#include "base/alloc.h"
#include "base/error.h"

#include "checker/ties.h"

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"

#define ITEM dyd_cert_described
#define RESERVE reserve_described
#define ALLOC alloc_described
#include "lists.h"

#define ITEM uint32_t
#define RESERVE reserve_members
#include "keeps.h"
#define ITEM dyd_cert_fact
#define RESERVE reserve_facts
#define KEPT(a, b) ((a).first == (b).first && (a).count == (b).count)
#include "keeps.h"
typedef dyd_cert_block *block_pointer;
#define ITEM block_pointer
#define RESERVE reserve_blocks
#include "keeps.h"

typedef const dyd_cert_block *block_of;
typedef const dyd_cert_described *described;
typedef const dyd_cert_sites *sites_of;

/*@ predicate ascending(described d, integer count) =
      \forall integer k, l; 0 <= k < l < count ==> d[k].site < d[l].site;
    predicate block(block_of b) = \valid_read(b) && b->points <= 4294967295 &&
      (0 < b->points ==> \valid_read(b->point + (0 .. b->points - 1))) && ascending(b->point, b->points);
    predicate numbered(numbers a) = \valid(a) && a->count <= 4194304 &&
      (0 < a->count ==> \valid(a->number + (0 .. a->count - 1))) && \separated(a, a->number + (0 .. a->count - 1));
    predicate point_of(described d, numbers a) = \valid_read(d) && d->number[0] < a->count && d->number[1] < a->count &&
      \separated(d, a->number + (0 .. a->count - 1)) && \separated(d, a);
    predicate whole_block(block_of b) = block(b) && \valid(b) && numbered(&b->algebra) &&
      (\forall integer k; 0 <= k < b->points ==> point_of(b->point + k, &b->algebra)) &&
      \separated(b, b->point + (0 .. b->points - 1), b->algebra.number + (0 .. b->algebra.count - 1));
    predicate is_described(block_of b, integer site) = \exists integer k; 0 <= k < b->points &&
      b->point[k].site == site; */

/* What enclosing changes: nothing else here has the types of these, so that all else is seen to stay. ANY_OF: what a
 * check of 0 changes, as one list of numbers, which CVC4 finds again where more was assigned before. */
#define ENCLOSURES_OF(a) a->relations.work, a->number[0 .. a->count - 1].p, a->number[0 .. a->count - 1].now
#define ANY_OF(a) a->relations.work, a->relations.nomem, a->number[0 .. a->count - 1]

/* Of algebra_enclose.c, algebra_bound.c and quotient.c: what is kept of a number is its enclosure; terms of a quotient
 * are its own, and that they change is not seen from here. */
/*@ requires numbered(a) && k < a->count && 64 <= p <= 16384;
    assigns ENCLOSURES_OF(a); exits \false;
    ensures \result == &a->number[k].now && interval(\result);
    ensures \forall interval_of x; interval{Pre}(x) && \separated(x, a->number + (0 .. a->count - 1)) ==>
        interval(x); */
const dyd_cert_enclosure *dyd_cert_algebra_enclose(dyd_cert_algebra *a, uint32_t k, long p);
/*@ requires numbered(a) && \valid_read(q);
    assigns ANY_OF(a); exits \false;
    ensures \forall mpz_srcptr z; \at(whole(z), Pre) && \separated(z, a, a->number + (0 .. a->count - 1)) ==>
      whole(z); */
bool dyd_cert_poly_is_null(dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires \valid(a); assigns *a; exits \false; */
void dyd_cert_algebra_clear(dyd_cert_algebra *a);
/*@ requires \valid(x); assigns *x; exits \false; */
void negate(dyd_cert_quotient *x);
#define dyd_cert_quotient_neg(x) negate(x)
/* What exact.h says of these two, with members by name: a number as a whole would be any memory after a call. */
/*@ requires \valid(out) && exact(x) && (den == \null || whole(den) && sign(den) == 1 && \separated(out, den));
    requires -274877906944 <= exp <= 274877906944 && \separated(out, x);
    assigns out->value; exits \false; ensures whole(out); */
void round_exact(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp);
#define dyd_exact_ceil(out, x, den, exp) round_exact(out, x, den, exp)
#define dyd_exact_floor(out, x, den, exp) round_exact(out, x, den, exp)
/*@ requires 0 < n ==> \valid_read(a + (0 .. n / 4 - 1)) && \valid_read(b + (0 .. n / 4 - 1));
    assigns \nothing; exits \false; */
int compare_indices(const uint32_t *a, const uint32_t *b, size_t n);
#define memcmp(a, b, n) compare_indices(a, b, n)

/*@ requires blocks(t); exits \false; */
void dyd_cert_ties_clear(dyd_cert_ties *t);
/*@ requires side(s) && interval(x) && 64 <= p <= 16384; assigns \nothing; exits \false; */
static bool side_holds_enclosure(const dyd_cert_side *s, const dyd_cert_enclosure *x, long p);
/*@ requires side(s) && numbered(a) && number < a->count;
    assigns ANY_OF(a);
    exits \false; */
static bool side_is_number(const dyd_cert_side *s, dyd_cert_algebra *a, uint32_t number);
/*@ requires side(s) && numbered(a) && number < a->count && 64 <= p <= 16384 &&
      \separated(s, s->den, a, a->number + (0 .. a->count - 1));
    assigns ENCLOSURES_OF(a); exits \false; */
static bool side_lacks_number(const dyd_cert_side *s, dyd_cert_algebra *a, uint32_t number, long p);
/*@ requires side(s) && numbered(a) && number < a->count && 64 <= p <= 16384 &&
      \separated(s, s->den, a, a->number + (0 .. a->count - 1));
    assigns ANY_OF(a), ENCLOSURES_OF(a);
    exits \false; */
static bool side_holds_number(const dyd_cert_side *s, dyd_cert_algebra *a, uint32_t number, long p);
/*@ predicate rectangles(sites_of s) = \valid_read(s) &&
      (0 < s->count ==> \valid_read(s->site + (0 .. s->count - 1))) &&
      (\forall integer k; 0 <= k < s->count ==> side(&s->site[k].side[0]) && side(&s->site[k].side[1]));
    predicate sides_apart(block_of b, sites_of s) = \forall integer k, axis; 0 <= k < s->count && 0 <= axis <= 1 ==>
      \separated(&s->site[k].side[axis], s->site[k].side[axis].den, &b->algebra,
        b->algebra.number + (0 .. b->algebra.count - 1));
    predicate located(block_of b, sites_of s) = whole_block(b) && rectangles(s) && sides_apart(b, s) &&
      (\forall integer k; 0 <= k < b->points ==> b->point[k].site < s->count); */
/*@ requires located(b, s) && \valid_read(in) && (in->err == \null || \valid(in->err)); exits \false; */
static dyd_status check_rectangles(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s);
/*@ requires block(b); assigns \nothing; exits \false;
    ensures \result != \null ==> \exists integer k; 0 <= k < b->points && \result == b->point + k;
    ensures \result != \null ==> \result->site == site;
    ensures is_described(b, site) ==> \result != \null; */
static const dyd_cert_described *find_described(const dyd_cert_block *b, uint32_t site);
/*@ requires \valid(out) && interval(out) && numbered(a) && point_of(p, a) && point_of(q, a) && 0 <= axis <= 1 &&
      64 <= prec <= 16384 && \separated(out, a, a->number + (0 .. a->count - 1)) &&
      \separated(out, p) && \separated(out, q);
    assigns ALL_OF(out), ENCLOSURES_OF(a); exits \false;
    ensures interval(out);
    ensures \forall interval_of x; interval{Pre}(x) && \separated(x, out, a->number + (0 .. a->count - 1)) ==>
      interval(x); */
static void enclose_difference(dyd_cert_enclosure *out, dyd_cert_algebra *a, const dyd_cert_described *p,
                               const dyd_cert_described *q, int axis, long prec);
/*@ requires numbered(a) && point_of(p, a) && point_of(q, a);
    assigns ENCLOSURES_OF(a); exits \false; */
static bool are_different(dyd_cert_algebra *a, const dyd_cert_described *p, const dyd_cert_described *q);
/*@ requires numbered(a) && \valid_read(p + (0 .. 2)) && point_of(p[0], a) && point_of(p[1], a) && point_of(p[2], a) &&
      \separated(p + (0 .. 2), a, a->number + (0 .. a->count - 1));
    assigns ENCLOSURES_OF(a); exits \false; */
static bool are_a_triangle(dyd_cert_algebra *a, const dyd_cert_described *const p[3]);
/*@ requires \valid(out) && \valid_read(x) && \valid_read(y) && \valid_read(z) && \valid_read(w) && \valid(r) &&
      out != x;
    assigns *out, r->nomem, r->work; exits \false; */
static bool product_difference(dyd_cert_quotient *out, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                               const dyd_cert_quotient *z, const dyd_cert_quotient *w, dyd_cert_relations *r);
/*@ requires reads(in) && \valid(in) && \valid(kind); exits \false; ensures \result == DYD_OK ==> 0 <= *kind <= 2; */
static dyd_status read_kind(dyd_cert_relation_kind *kind, dyd_cert_reader *in);
/*@ requires numbered(a) && \valid_read(q);
    assigns ANY_OF(a);
    exits \false; */
static bool number_is_null(dyd_cert_algebra *a, const dyd_cert_poly *q, bool by_bound);
/*@ requires numbered(a) && point_of(p, a) && point_of(q, a);
    assigns ANY_OF(a);
    exits \false; */
static bool are_same(dyd_cert_algebra *a, const dyd_cert_described *p, const dyd_cert_described *q, bool by_bound);
/*@ requires \valid_read(site + (0 .. count - 1)) &&
      (kind == DYD_CERT_CIRCLE ? 3 <= count : 2 <= count) && 0 <= kind <= 2 &&
      (\forall integer k; 0 <= k < count ==> is_described(b, site[k])) &&
      whole_block(b) && \separated(site + (0 .. count - 1), b, b->algebra.number + (0 .. b->algebra.count - 1));
    exits \false; */
bool dyd_cert_fact_holds(dyd_cert_block *b, dyd_cert_relation_kind kind, const uint32_t *site, size_t count,
                         bool by_bound);
/*@ requires stated(t) && \valid_read(s) && s->count == SITES && \valid(out) &&
      \separated(out, t, s, t->fact + (0 .. t->facts - 1), s->site + (0 .. SITES - 1)) &&
      (0 < SITES ==> \valid_read(s->site + (0 .. SITES - 1))) &&
      (\forall integer i; 0 <= i < SITES ==> s->site[i].alias < SITES);
    exits \false; */
dyd_status dyd_cert_ties_aliases(size_t *out, const dyd_cert_ties *t, const dyd_cert_sites *s);

/*@ requires reads(in); requires \valid(count) && most <= 4294967295 && \separated(count, in, in->err);
    exits \false; ensures \result == DYD_OK ==> *count <= most; */
static dyd_status read_count(uint32_t *count, dyd_cert_reader *in, const char *name, uint64_t most);
/*@ predicate of_sites(block_of b) = block(b) && \forall integer k; 0 <= k < b->points ==> b->point[k].site < SITES;
    predicate room(block_of b, reading r, sites_of s, integer count) = \valid(b->point + (0 .. count - 1)) &&
      \separated(b->point + (0 .. count - 1), b, r, r->err, r->in, s, LINES + (..)) &&
      \separated(b->point + (0 .. count - 1), b->algebra.number + (0 .. b->algebra.count - 1));
    predicate block_apart(block_of b, reading r, sites_of s) = \separated(b, r, r->err, r->in, s, LINES + (..)); */
/* The block has its points so far; their list, room for `count`. */
/*@ requires kept(in); requires whole_block(b); requires of_sites(b);
    requires \valid_read(s) && s->count == SITES && 0 < SITES;
    requires 0 < b->algebra.count && b->points < 4294967295;
    requires room(b, in, s, b->points + 1); requires block_apart(b, in, s);
    assigns b->points, b->point[b->points].site, b->point[b->points].number[0 .. 1], in->number, in->line, in->cap,
      in->at, LINES[..], *in->in, *in->err, errno; exits \false; ensures \result == DYD_OK ==> kept(in);
    ensures \result == DYD_OK ==> b->points == \old(b->points) + 1;
    ensures \result == DYD_OK ==> whole_block(b); ensures \result == DYD_OK ==> of_sites(b); */
static dyd_status read_point(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s);

/* What is there while points are read: numbers, sites, a list of its own. */
/*@ predicate based(block_of b, reading r, sites_of s) = \valid(b) && numbered(&b->algebra) && block_apart(b, r, s) &&
      \separated(b, b->algebra.number + (0 .. b->algebra.count - 1)) && \valid_read(s) && s->count == SITES &&
      rectangles(s) && sides_apart(b, s); */
/*@ requires kept(in) && based(b, in, s) && b->points == 0; exits \false;
    admit ensures apart: \result == DYD_OK ==> kept(in) && based(b, in, s) && whole_block(b) &&
      of_sites(b); // asserted before it returns */
static dyd_status read_points(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s);

/* Facts are about sites that are described. */
/*@ predicate described_from(facts_of t, block_of b, integer first) =
      \forall integer k; first <= k < t->members ==> is_described(b, t->member[k]); */
/* As read.h says of dyd_cert_reject, and base/error.c of dyd_fail_nomem: the error is filled in, which is no part of
 * the reader. */
/*@ requires reads(r); assigns *r->err; exits \false; ensures \result == DYD_E_PARSE; ensures reads(r); */
dyd_status reject_line(const dyd_cert_reader *r);
/*@ requires reads(r); assigns *r->err; exits \false; ensures \result == DYD_E_NOMEM; ensures reads(r); */
dyd_status no_memory(const dyd_cert_reader *r);
/* strchr and strcmp with literals (literals.h). */
/*@ requires at == \null || string(at); assigns \nothing; exits \false; ensures \result != \null ==> at != \null; */
const char *blank_in(const char *at);
/*@ requires string(s); assigns \nothing; exits \false; */
int compare_word(const char *s);
/* Of a local object: it is none that pointers lead to. */
#define LOCAL(x) (\base_addr(&x) != \base_addr(t) && \base_addr(&x) != \base_addr(b) && \
  \base_addr(&x) != \base_addr(by_bound) && \base_addr(&x) != \base_addr(in) && \
  \base_addr(&x) != \base_addr(in->err) && \base_addr(&x) != \base_addr(in->in) && \
  \base_addr(&x) != \base_addr(LINES + 0) && \base_addr(&x) != \base_addr(b->point) && \
  \base_addr(&x) != \base_addr(t->member) && \base_addr(&x) != \base_addr(t->fact))
/*@ requires reads(in) && listing(t) && of_sites(b) && \valid(by_bound);
    requires \separated(t, b, by_bound, in, in->err, in->in, LINES + (..));
    requires \base_addr(b->point) != \base_addr(t) && \base_addr(b->point) != \base_addr(in) &&
      \base_addr(b->point) != \base_addr(in->err);
    exits \false; ensures \result == DYD_OK ==> reads(in); ensures \result == DYD_OK ==> listing(t);
    ensures \result == DYD_OK ==> \old(t->members) <= t->members && described_from(t, b, \old(t->members)); */
static dyd_status read_members(dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_block *b, bool *by_bound);

/* All that is known while facts are read: of the reader between lines, the lists, the block. */
/*@ predicate stating(facts_of t, block_of b, reading r) = kept(r) && listing(t) && whole_block(b) && of_sites(b) &&
      \separated(t, b, r, r->err, r->in, LINES + (..)) &&
      \base_addr(b->point) != \base_addr(t) && \base_addr(b->point) != \base_addr(r) &&
      \base_addr(b->point) != \base_addr(r->err) &&
      (0 < t->member_cap ==> \base_addr(t->member) != \base_addr(b) && \base_addr(t->member) != \base_addr(t) &&
        \base_addr(t->member) != \base_addr(b->point) && \base_addr(t->member) != \base_addr(b->algebra.number)); */
/* What faces.h says of dyd_cert_distinct, whose BOUND is any number, of a part of the list of members. */
/*@ requires listing(t) && first + count <= t->members && \valid(t->member + first + (0 .. count - 1));
    assigns t->member[first .. first + count - 1]; exits \false; ensures \result == count ==> listing(t); */
size_t distinct_members(dyd_cert_ties *t, size_t first, size_t count);
/* An assignment: see `copy` in overflow.py. */
/*@ requires \valid(to) && \valid_read(from) && \separated(to, from); assigns to->kind, to->first, to->count;
    exits \false; ensures to->kind == \old(from->kind); ensures to->first == \old(from->first);
    ensures to->count == \old(from->count); */
void copy_fact(dyd_cert_fact *to, const dyd_cert_fact *from);
/*@ requires stating(t, b, in); exits \false;
    admit ensures apart: \result == DYD_OK ==> stating(t, b, in); // asserted before it returns */
static dyd_status read_fact(dyd_cert_ties *t, dyd_cert_reader *in, dyd_cert_block *b);

/* What is known while a block is read, of which there are no points yet. */
/*@ predicate blocking(block_of b, facts_of t, reading r, sites_of s) = \valid(b) && b->points == 0 && listing(t) &&
      \valid_read(s) && s->count == SITES && rectangles(s) && \separated(b, t) &&
      \separated(b, r, r->err, r->in, s, LINES + (..)) && \separated(t, r, r->err, r->in, LINES + (..)) &&
      (0 < t->member_cap ==> \base_addr(t->member) != \base_addr(b) && \base_addr(t->member) != \base_addr(t)); */
/*@ requires reads(in); requires blocking(b, t, in, s);
    requires listed(&b->algebra) && b->algebra.count == 0; exits \false;
    admit ensures apart: \result == DYD_OK ==> kept(in) && listing(t); // asserted before it returns */
static dyd_status read_block(dyd_cert_block *b, dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_sites *s);

/* calloc of a block: no numbers, no points. */
/*@ assigns \nothing; exits \false; ensures \result != \null ==> \valid(\result) && \result->points == 0 &&
      \result->algebra.count == 0 && \result->algebra.cap == 0 && \result->algebra.relations.count == 0 &&
      \result->algebra.cycle == 0 && \result->algebra.cosines == 0; */
dyd_cert_block *zeroed_block(size_t count, size_t size);
/*@ requires reads(in); requires listing(t); requires blocks(t);
    requires \valid_read(s) && s->count == SITES && rectangles(s);
    requires \separated(t, in, in->err, in->in, LINES + (..));
    exits \false; ensures \result == DYD_OK ==> kept(in); ensures \result == DYD_OK ==> listing(t);
    ensures \valid(t) && t->blocks <= t->block_cap <= 1152921504606846976;
    ensures 0 < t->block_cap ==> \valid(t->block + (0 .. t->block_cap - 1)); ensures own_blocks(t); */
dyd_status dyd_cert_ties_read(dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_sites *s);

#include "checker/ties.c"
