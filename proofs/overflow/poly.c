/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/poly.c: polynomials are read where they are, exponents stay in their type, terms in
 * their lists. */
#include "terms.h"

typedef const dyd_cert_term *one_term;

#include "base/alloc.h"
#include <string.h>

/*@ requires \valid(to + (0 .. 63)) && byte == 0 && n == 128; assigns to[0 .. 63]; exits \false;
    ensures \forall integer k; 0 <= k < 64 ==> to[k] == 0; */
void memset_exponents(uint16_t *to, int byte, size_t n);
/*@ requires \valid(to + (0 .. 63)) && \valid_read(from + (0 .. 63)) && n == 128; assigns to[0 .. 63]; exits \false;
    ensures \forall integer k; 0 <= k < 64 ==> to[k] == \old(from[k]); */
void memcpy_exponents(uint16_t *to, const uint16_t *from, size_t n);

#include "base/invariant.h"

#define ITEM dyd_cert_term
#define RESERVE reserve_terms
#define ALLOC alloc_terms
#include "lists.h"
#define ITEM char
#define RESERVE reserve_chars
#define ALLOC alloc_chars
#include "lists.h"

/*@ requires \valid_read(a + (0 .. 63)) && \valid_read(b + (0 .. 63)); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1;
    ensures \result == 0 <==> \forall integer k; 0 <= k < 64 ==> a[k] == b[k]; */
static int terms_compare(const uint16_t *a, const uint16_t *b);
/*@ requires \valid(out); requires \valid_read(t) && whole(&t->c[0]); requires whole(c);
    requires \separated(out, t); requires \separated(out, c);
    requires \forall integer k; 0 <= k < 64 ==> t->e[k] <= 16384;
    requires m == \null || \valid_read(m + (0 .. 63)) && \separated(out, m + (0 .. 63)) &&
      (\forall integer k; 0 <= k < 64 ==> m[k] <= 16384);
    assigns out->c[0].value, out->e[0 .. 63]; exits \false; ensures whole(&out->c[0]);
    ensures \result ==> few(&out->e[0]); */
static bool term_scale(dyd_cert_term *out, const dyd_cert_term *t, mpz_srcptr c, const uint16_t *m);
/*@ requires \valid(text) && string(*text) && most <= 400000000;
    assigns *text; exits \false;
    ensures \result <= most && string(*text) && within(*text, \old(*text)) &&
      *text - \old(*text) <= stop(\old(*text)); */
static unsigned scan_unsigned(const char **text, unsigned most);
/*@ requires \valid(t) && \valid(text) && string(*text) && \valid_read(r) && r->count <= 64 && \separated(text, t, r);
    assigns *text, t->e[0 .. 63]; exits \false; ensures \result ==> string(*text);
    ensures within(*text, \old(*text)) && 1 <= *text - \old(*text) <= \old(stop(*text)) + 1;
    ensures \result ==> *text - \old(*text) <= \old(stop(*text)); */
static bool scan_power(dyd_cert_term *t, const char **text, const dyd_cert_relations *r);
/*@ requires \valid(r) && \valid_read(q) && held(q) && beside(q, r);
    assigns r->work; exits \false; */
static bool count_terms_of(dyd_cert_relations *r, const dyd_cert_poly *q, size_t more);
/*@ requires \valid(p) && listed(p) && numbers_in(p) && whole(z) && \valid(r) && beside(p, r) && \separated(p, z);
    requires \separated(r, z) && leaf < 64 && e <= 8192;
    assigns owned: p->term, p->count, r->nomem; exits \false; ensures listed(p); ensures numbers_in(p);
    ensures \result ==> low(p); ensures NEW(p, r); */
static bool poly_set_term(dyd_cert_poly *p, mpz_srcptr z, size_t leaf, uint16_t e, dyd_cert_relations *r);
/*@ requires \valid(r); assigns r->nomem; exits \false;
    ensures \result != \null && 0 < count ==> \valid(\result + (0 .. count - 1)); */
static dyd_cert_term *terms_alloc(size_t count, dyd_cert_relations *r);
/*@ requires \valid(c) && whole(c) && \valid(text) && string(*text) && \valid(r) && \separated(c, text, r);
    assigns owned: c->value, *text, r->nomem;
    exits \false; ensures whole(c) && (\result ==> string(*text));
    ensures within(*text, \old(*text)) && *text - \old(*text) <= \old(stop(*text));
    ensures \result && *text == \old(*text) ==> **text == 'x'; */
static bool scan_coefficient(mpz_ptr c, const char **text, dyd_cert_relations *r);
/* signs(s, n): how many of s[1], .. s[n - 1] are signs, each of which begins a term.
 * signs_none: none of none; signs_next: s[k] is one or none; signs_rise: what is among fewer is among more. */
/*@ axiomatic Signs { logic integer signs{L}(chars s, integer n) reads s[1 ..];
      axiom signs_none{L}: \forall chars s, integer n; n <= 1 ==> signs(s, n) == 0;
      axiom signs_next{L}: \forall chars s, integer k, n; 1 <= k && n == k + 1 ==>
        signs(s, n) == signs(s, k) + (s[k] == '+' || s[k] == '-' ? 1 : 0);
      axiom signs_rise{L}: \forall chars s, integer m, n; m <= n ==> 0 <= signs(s, m) <= signs(s, n); } */
/*@ requires string(text) && stop(text) < 1152921504606846976; assigns \nothing; exits \false;
    ensures 1 <= \result <= stop(text) + 1; ensures \result == 1 + signs(text, stop(text)); */
static size_t count_terms(const char *text);

/*@ predicate rests_not_in(relations r, char *b) =
      \forall integer k; 0 <= k < r->count ==> not_in(&r->leaf[k].rest, b);
    predicate apart(polynomial p, relations r) = \separated(p, r) && not_in(p, \base_addr(r)) && unlike_rests(p, r); */
/*@ requires \valid(out) && out->count == 0 && \valid(p); requires listed(p); requires numbers_in(p); requires low(p);
    requires \valid(r) && k < 64 && 0 < degree && \separated(p, out); requires beside(p, r) && beside(out, r);
    assigns owned: out->term, out->count, p->count, r->nomem; exits \false;
    ensures listed(p); ensures numbers_in(p); ensures low(p);
    ensures listed(out); ensures numbers_in(out); ensures low(out);
    ensures owned: not_in(out, \base_addr(r)) && not_in(out, \base_addr(p)) && not_in(p, \base_addr(out)) &&
      distinct(p, out);
    ensures owned: \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, p) && \separated(s, out) ==>
      not_in(s, b);
    ensures owned: \forall char *b; \old(not_in(p, b)) ==> not_in(p, b);
    ensures owned: \old(related(r)) && \separated(p, r) && \separated(out, r) ==> related(r);
    ensures owned: \old(unlike_rests(p, r)) && \separated(p, r) ==> unlike_rests(p, r); */
static bool terms_take_power(dyd_cert_poly *out, dyd_cert_poly *p, size_t k, unsigned degree, dyd_cert_relations *r);
/*@ requires related(r) && k < r->count; requires \valid(p); requires listed(p); requires numbers_in(p);
    requires low(p); requires apart(p, r); requires rests_not_in(r, \base_addr(p));
    assigns owned: p->term, p->count, r->nomem, r->work; exits \false; ensures listed(p); ensures numbers_in(p);
    ensures \result ==> low(p); ensures related(r);
    ensures \result ==> apart(p, r); ensures rests_not_in(r, \base_addr(p)); ensures NEW(p, r); */
static bool reduce_leaf(dyd_cert_poly *p, size_t k, dyd_cert_relations *r);
/*@ requires related(r); requires \valid(p); requires listed(p); requires numbers_in(p); requires low(p);
    requires apart(p, r); requires rests_not_in(r, \base_addr(p));
    assigns owned: p->term, p->count, r->nomem, r->work;
    exits \false; ensures listed(p); ensures numbers_in(p); ensures \result ==> low(p); ensures related(r);
    ensures NEW(p, r); */
bool dyd_cert_poly_reduce(dyd_cert_poly *p, dyd_cert_relations *r);
/*@ requires \valid(t) && whole(&t->c[0]) && \valid(text) && string(*text) && \valid(r) && r->count <= 64 &&
      \separated(t, text, r);
    assigns owned: t->e[0 .. 63], t->c[0].value, *text, r->nomem;
    exits \false; ensures whole(&t->c[0]); ensures \result ==> string(*text);
    ensures within(*text, \old(*text)) && *text - \old(*text) <= \old(stop(*text)) + 1;
    ensures \result ==> 1 <= *text - \old(*text) <= \old(stop(*text)); */
static bool scan_term(dyd_cert_term *t, const char **text, dyd_cert_relations *r);
/*@ predicate numbers_from(one_term s, integer k, integer n) = \forall integer t; k <= t < n ==>
      integer_of(s[t].c[0].value);
    predicate few_from(one_term s, integer k, integer n) = \forall integer t; k <= t < n ==> few(&s[t].e[0]); */
/*@ requires \valid(to) && \valid_read(from); assigns to->c[0].value, to->e[0 .. 63]; exits \false;
    ensures to->c[0].value == \old(from->c[0].value);
    ensures \old(few(&from->e[0])) ==> few(&to->e[0]);
    ensures \forall one_term s; \old(few(&s->e[0])) && \separated(s, to) ==> few(&s->e[0]);
    ensures \forall one_term s, integer k, n; \old(few_from(s, k, n)) && \separated(s + (k .. n - 1), to) ==>
      few_from(s, k, n);
    ensures \forall one_term s, integer k, n; \old(numbers_from(s, k, n)) && \separated(s + (k .. n - 1), to) ==>
      numbers_from(s, k, n);
    ensures \forall one_term s, integer k, n, m; \old(few_from(s, k, n)) && \old(few(&from->e[0])) && to == s + n &&
      m == n + 1 ==> few_from(s, k, m);
    ensures \forall one_term s, integer k, n, m; \old(numbers_from(s, k, n)) && integer_of(\old(from->c[0].value)) &&
      to == s + n && m == n + 1 ==> numbers_from(s, k, m);
    ensures \forall polynomial s; \old(numbers_in(s)) && not_in(s, \base_addr(to)) ==> numbers_in(s);
    ensures \forall polynomial s; \old(low(s)) && not_in(s, \base_addr(to)) ==> low(s);
    ensures \forall integer k; 0 <= k < 64 ==> to->e[k] == \old(from->e[k]); */
void copy_term(dyd_cert_term *to, const dyd_cert_term *from);
/*@ requires \valid(sum) && \valid(p) && p->count <= 16384; requires listed(p); requires numbers_in(p);
    requires listed(q); requires numbers_in(q); requires low(q); requires whole(c);
    requires m == \null || \valid_read(m + (0 .. 63)) && few(m);
    requires \valid(sum->term + (0 .. p->count + q->count - 1));
    requires \separated(sum, p) && \separated(sum, q) && \separated(p, q) && \separated(sum, c) && \separated(p, c);
    requires m != \null ==> \separated(sum, m + (0 .. 63));
    requires \base_addr(sum->term) != \base_addr(sum) && \base_addr(sum->term) != \base_addr(p) &&
      \base_addr(sum->term) != \base_addr(q) && \base_addr(sum->term) != \base_addr(c) &&
      (m != \null ==> \base_addr(sum->term) != \base_addr(m)) && not_in(p, \base_addr(sum->term)) && not_in(q,
      \base_addr(sum->term));
    requires distinct(p, q); requires not_in(p, \base_addr(sum)); requires not_in(p, \base_addr(q));
    requires not_in(p, \base_addr(c)); requires m != \null ==> not_in(p, \base_addr(m));
    requires not_in(q, \base_addr(sum)); requires not_in(q, \base_addr(p));
    assigns sum->count, sum->term[0 .. p->count + q->count - 1], p->term[0 .. p->count - 1].c[0].value; exits \false;
    ensures sum->count <= p->count + q->count; ensures numbers_in(sum);
    ensures \result ==> sum->count <= 16384; ensures \result && low{Pre}(p) ==> low(sum); */
static bool terms_merge(dyd_cert_poly *sum, dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires \valid(end) && string(text);
    requires stop(text) < 1152921504606846976; requires \valid(r) && r->count <= 64 && \separated(p, end, r);
    assigns owned: p->term, p->count, *end, r->nomem; exits \false; ensures listed(p); ensures numbers_in(p);
    ensures p->count <= 16384; ensures within(*end, text) && *end - text <= stop(text) + 1;
    ensures \result ==> string(*end); */
bool dyd_cert_poly_scan(dyd_cert_poly *p, const char **end, const char *text, dyd_cert_relations *r);

#include "checker/poly.c"
