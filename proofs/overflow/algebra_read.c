/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_read.c: operands are numbers before, operations have names. */
#include "numbers.h"

#include "base/alloc.h"
#include "base/error.h"

/* commas(s): how many there are in a text. Each axiom is true of any bytes: an empty text has none; the first byte is
 * one, or is not, and the rest is a text; of the same bytes it is the same. */
/*@ axiomatic Commas {
      logic integer commas{L}(chars s) reads s[0 ..];
      axiom commas_none{L}: \forall chars s; string(s) && s[0] == 0 ==> commas(s) == 0;
      axiom commas_next{L}: \forall chars s; string(s) && s[0] != 0 ==>
        commas(s) == commas(s + 1) + (s[0] == ',' ? 1 : 0);
      axiom commas_kept{K, L}: \forall chars s; string{K}(s) &&
        (\forall integer k; 0 <= k <= stop{K}(s) ==> \at(s[k], K) == \at(s[k], L)) ==>
        commas{L}(s) == commas{K}(s); } */
/* strchr (string.h) with a comma: that it is the first one. */
/*@ requires string(s); assigns \nothing; exits \false;
    ensures \result == \null ==> commas(s) == 0;
    ensures \result != \null ==> *\result == ',' && within(\result, s) && \result - s < stop(s);
    ensures \result != \null ==> commas(s) == 1 + commas(\result + 1); */
char *first_comma(char *s);

#define ITEM mpz_t
#define RESERVE reserve_coefficients
#define ALLOC alloc_count
#include "lists.h"
#define ITEM dyd_cert_bracket
#define RESERVE reserve_brackets
#define ALLOC alloc_1
#include "lists.h"
#define ITEM dyd_cert_number
#define RESERVE dyd_reserve
#define ALLOC alloc_numbers
#include "lists.h"
#define alloc_indices(n, size) alloc_##n(n, size) /* by how many: brackets are asked for one by one */

#undef mpz_inits
#define mpz_inits(a, b, c, d, end) (mpz_init(a), mpz_init(b), mpz_init(c), mpz_init(d))

/*@ requires 0 <= op < 29; assigns \nothing; exits \false; ensures string(\result); */
const char *dyd_cert_op_name(dyd_cert_op op);
/*@ requires 0 <= op < 29; assigns \nothing; exits \false;
    ensures \result == (op == DYD_CERT_VALUE || DYD_CERT_PI <= op ? 0 : op <= DYD_CERT_MAX ? 2 : 1); */
int dyd_cert_op_operands(dyd_cert_op op);

typedef const dyd_cert_bracket *bracket_of;
typedef const dyd_cert_number *number_of;
typedef dyd_cert_quotient *value_of;

/* Brackets, as in bracket.c; described: all but the value of number n of a block. */
/*@ predicate bracket(bracket_of r) = \valid_read(r) && 2 <= r->count <= 1001 &&
      \valid_read(r->coeff + (0 .. r->count - 1)) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) &&
      whole(&r->end[0][0]) && whole(&r->end[1][0]) && whole(&r->end[2][0]) && whole(&r->end[3][0]) &&
      sign(&r->end[1][0]) != 0 && sign(&r->end[3][0]) != 0;
    predicate rooted(bracket_of r) = bracket(r) && sign(&r->coeff[r->count - 1][0]) == 1;
    predicate four(bracket_of r) = whole(&r->end[0][0]) && whole(&r->end[1][0]) && whole(&r->end[2][0]) &&
      whole(&r->end[3][0]);
    predicate freed(bracket_of r) = \valid(r) && r->count <= 1001 &&
      (0 < r->count ==> \valid(r->coeff + (0 .. r->count - 1))) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) && four(r) &&
      \separated(r, r->coeff + (0 .. r->count - 1));
    predicate own_root(number_of n, numbers a) = \base_addr(n->root) != \base_addr(a) &&
      \base_addr(n->root) != \base_addr(a->number) && \base_addr(n->root->coeff) != \base_addr(a) &&
      \base_addr(n->root->coeff) != \base_addr(a->number) &&
      \separated(n->root, n->root->coeff + (0 .. n->root->count - 1));
    predicate described(number_of n, integer count) = 0 <= n->op < 29 &&
      (1 <= n->op <= 23 ==> n->a < count) && (1 <= n->op <= 6 ==> n->b < count) &&
      -4096 <= n->exponent <= 4096;
    predicate place(numbers a, reading r) = known(a) && angled(a) && cycled(a) && a->count <= 4194304 &&
      \separated(a, r, r->err, r->in, LINES + (..)) &&
      \separated(a->number + (0 .. a->count), r, r->err, r->in, LINES + (..)); */

/* As read.h says of dyd_cert_reject and dyd_cert_line_done, and base/error.c of dyd_fail_nomem: the error is filled
 * in. It is no part of the reader, the line, the block or a bracket. */
/*@ requires reads(r); assigns *r->err; exits \false; ensures \result == DYD_E_PARSE; ensures reads(r); */
dyd_status reject_line(const dyd_cert_reader *r);
#undef dyd_cert_reject
#define dyd_cert_reject(r, ...) reject_line(r)
/*@ requires reads(r); assigns *r->err; exits \false; ensures \result == DYD_E_NOMEM; ensures reads(r);
    ensures \forall bracket_of b; \old(freed(b)) ==> freed(b); */
dyd_status no_memory(const dyd_cert_reader *r);
#define dyd_fail_nomem(err) no_memory(in)
/*@ requires reads(r); assigns *r->err; exits \false; ensures reads(r);
    ensures \old(place(a, r)) ==> place(a, r);
    ensures n->root == \old(n->root) && a->count == \old(a->count);
    ensures \old(n->root == \null || freed(n->root)) ==> n->root == \null || freed(n->root); */
dyd_status number_done(const dyd_cert_number *n, const dyd_cert_algebra *a, dyd_cert_reader *r);
#define dyd_cert_line_done(r) number_done(n, a, r)

/*@ requires known(a) && \valid_read(q);
    assigns a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false;
    ensures \result == -1 || \result == 0 || \result == 1; */
int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires bracket(r); assigns \nothing; exits \false; */
bool dyd_cert_root_is_single(const dyd_cert_bracket *r);
/*@ requires known(a) && angled(a) && cycled(a) && n == a->number + a->count && 1 <= n->op <= 28;
    requires described(n, a->count);
    requires n->op == DYD_CERT_ROOT ==> rooted(n->root);
    requires n->op == DYD_CERT_ROOT ==> \separated(a, n->root, n->root->coeff + (0 .. n->root->count - 1)) &&
      \separated(&n->value, n->root, n->root->coeff + (0 .. n->root->count - 1)); exits \false; */
bool dyd_cert_number_value(dyd_cert_number *n, dyd_cert_algebra *a);
/*@ requires known(a) && n == a->number + a->count && described(n, a->count);
    requires n->op == DYD_CERT_SQRT || n->op == DYD_CERT_CBRT || n->op == DYD_CERT_ROOT;
    requires n->op == DYD_CERT_ROOT ==> rooted(n->root);
    requires n->op == DYD_CERT_ROOT ==> \separated(a, n->root) && \separated(a->number + (0 .. a->count), n->root);
    exits \false; */
bool dyd_cert_number_check(dyd_cert_number *n, dyd_cert_algebra *a);
/* What algebra.c asks of dyd_cert_number_clear; and that a reader is no part of a number. */
/*@ requires \valid(n) && (n->root == \null || freed(n->root)); requires reads(r); exits \false; ensures reads(r); */
void clear_number(dyd_cert_number *n, const dyd_cert_reader *r);
#define dyd_cert_number_clear(n) clear_number(n, in)
/*@ requires \valid(x); assigns *x; exits \false; */
void dyd_cert_enclosure_init(dyd_cert_enclosure *x);

/*@ requires \valid(out) && \valid_read(a) && a->count <= 4194304 && reads(in) && \separated(out, in, in->err);
    assigns in->at, in->line[0 .. in->cap - 1], *out, *in->err; exits \false;
    ensures \result == DYD_OK ==> *out < \old(a->count); */
static dyd_status read_operand(uint32_t *out, const dyd_cert_algebra *a, dyd_cert_reader *in);
/*@ requires \valid(op) && reads(in) && \separated(op, in, in->err, in->line + (0 .. in->cap - 1));
    assigns in->at, in->line[0 .. in->cap - 1], *op, *in->err; exits \false;
    ensures \result == DYD_OK ==> 0 <= *op < 29; */
static dyd_status read_op(dyd_cert_op *op, dyd_cert_reader *in);
/*@ requires \valid(num) && \valid(den) && whole(num) && whole(den) && line(text) &&
      \separated(num, den, text + (0 .. stop(text)));
    assigns num->value, den->value, text[0 .. stop(text)]; exits \false;
    ensures whole(num) && whole(den); ensures \result ==> sign(den) == 1; */
static bool scan_fraction(mpz_ptr num, mpz_ptr den, char *text);
/*@ requires \valid(r) && r->count == 0 && \valid(relations) && line(text) && \separated(r, relations);
    exits \false;
    ensures r->end[0][0].value == \old(r->end[0][0].value) && r->end[1][0].value == \old(r->end[1][0].value) &&
      r->end[2][0].value == \old(r->end[2][0].value) && r->end[3][0].value == \old(r->end[3][0].value);
    ensures \valid(r); ensures r->count <= 1001; ensures \result ==> 2 <= r->count;
    ensures 0 < r->count ==> \valid(r->coeff + (0 .. r->count - 1));
    ensures \separated(r, r->coeff + (0 .. r->count - 1));
    ensures \forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0]);
    ensures \result ==> sign(&r->coeff[r->count - 1][0]) == 1; */
static bool scan_coefficients(dyd_cert_bracket *r, char *text, dyd_cert_relations *relations);
/*@ requires \valid_read(n) && \valid_read(in); assigns \nothing; exits \false;
    ensures \result ==> n->op == DYD_CERT_VALUE || n->op == DYD_CERT_SQRT || n->op == DYD_CERT_CBRT ||
      n->op == DYD_CERT_ROOT;
    ensures !\result ==> n->op != DYD_CERT_VALUE; */
static bool has_value(const dyd_cert_number *n, const dyd_cert_reader *in);
/*@ requires known(a) && reads(in) && \valid(out) &&
      \separated(a, in, in->err, in->in, LINES + (..)) && \separated(out, a, in, in->err, in->in, LINES + (..));
    exits \false; ensures reads(in); */
static dyd_status read_value(dyd_cert_quotient *out, dyd_cert_algebra *a, dyd_cert_reader *in);
/* That reads(in) holds in the end, part by part, which CVC4 does not prove as one. */
#define READS_LEFT \
  ensures \valid(in) && \valid(in->in); \
  ensures in->err == \null || \valid(in->err); \
  ensures in->cap <= 1152921504606846976; \
  ensures \separated(in, in->err, in->in, LINES + (..)); \
  ensures 0 < in->cap ==> \valid(in->line + (0 .. in->cap - 1)) && \base_addr(in->line) == \base_addr(LINES + 0); \
  ensures in->at != \null ==> 0 < in->cap && inside(in, in->at);
/* Of what is new, or local: it is in no memory that is handed over. */
#define ELSEWHERE(x, out) (\base_addr(x) != \base_addr(out) && \base_addr(x) != \base_addr(relations) && \
  \base_addr(x) != \base_addr(in) && \base_addr(x) != \base_addr(in->err) && \
  \base_addr(x) != \base_addr(in->in) && \base_addr(x) != \base_addr(LINES + 0))
/*@ requires \valid(out) && \valid(relations) && reads(in) &&
      \separated(out, relations, in, in->err, in->in, LINES + (..));
    exits \false; READS_LEFT ensures \result == DYD_OK ==> \valid_read(*out) && 2 <= (*out)->count <= 1001;
    ensures \result == DYD_OK ==> \valid_read((*out)->coeff + (0 .. (*out)->count - 1));
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < (*out)->count ==> whole(&(*out)->coeff[k][0]);
    ensures \result == DYD_OK ==> four(*out);
    ensures \result == DYD_OK ==> sign(&(*out)->end[1][0]) == 1 && sign(&(*out)->end[3][0]) == 1;
    ensures \result == DYD_OK ==> sign(&(*out)->coeff[(*out)->count - 1][0]) == 1;
    ensures *out == \old(*out) || \valid(*out) && (*out)->count <= 1001 && four(*out);
    ensures *out == \old(*out) || (0 < (*out)->count ==> \valid((*out)->coeff + (0 .. (*out)->count - 1)));
    ensures *out == \old(*out) || \separated(*out, (*out)->coeff + (0 .. (*out)->count - 1));
    ensures *out == \old(*out) || \forall integer k; 0 <= k < (*out)->count ==> whole(&(*out)->coeff[k][0]);
    ensures \result == DYD_OK ==> \base_addr(*out) != \base_addr(out) && \base_addr(*out) != \base_addr(relations);
    ensures \result == DYD_OK ==> \base_addr((*out)->coeff) != \base_addr(out) &&
      \base_addr((*out)->coeff) != \base_addr(relations);
    ensures \result == DYD_OK ==> \separated(*out, (*out)->coeff + (0 .. (*out)->count - 1)); */
static dyd_status read_bracket(dyd_cert_bracket **out, dyd_cert_relations *relations, dyd_cert_reader *in);
/*@ requires reads(in) && \valid(out) && \separated(out, in, in->err, in->in, LINES + (..));
    assigns in->at, in->line[0 .. in->cap - 1], *out, *in->err; exits \false; READS_LEFT
    ensures \result == DYD_OK ==> -4096 <= *out <= 4096; */
static dyd_status read_exponent(long *out, dyd_cert_reader *in);
/*@ requires place(a, in) && reads(in) && n == a->number + a->count && n->exponent == 0 && n->root == \null;
    exits \false; READS_LEFT ensures n->root == \null || freed(n->root);
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==> own_root(n, a);
    ensures \result == DYD_OK ==> described(n, \old(a->count));
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==> \valid_read(n->root) && 2 <= n->root->count <= 1001;
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==>
      \valid_read(n->root->coeff + (0 .. n->root->count - 1));
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==>
      \forall integer k; 0 <= k < n->root->count ==> whole(&n->root->coeff[k][0]);
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==> four(n->root);
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==>
      sign(&n->root->end[1][0]) != 0 && sign(&n->root->end[3][0]) != 0;
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==> sign(&n->root->coeff[n->root->count - 1][0]) == 1; */
static dyd_status read_operation(dyd_cert_number *n, dyd_cert_algebra *a, dyd_cert_reader *in);
/*@ requires place(a, in) && reads(in) && n == a->number + a->count && n->exponent == 0 && n->root == \null;
    exits \false; ensures reads(in); ensures n->root == \null || freed(n->root);
    ensures \result == DYD_OK ==> place(a, in) && a->count == \old(a->count); */
static dyd_status read_number(dyd_cert_number *n, dyd_cert_algebra *a, dyd_cert_reader *in);

/* listed, and the place for one more was asked for. */
/*@ predicate room_in(numbers a) = \valid(a) && a->relations.count <= 64 && a->count < 4194304 &&
      a->count < a->cap <= 1152921504606846976 && \valid(a->number + (0 .. a->cap - 1)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number <= a->count) &&
      (\forall integer k; 0 <= k < a->count ==> a->number[k].a <= a->count); */

#include "checker/algebra_read.c"
