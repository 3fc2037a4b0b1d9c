/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_read.c: operands are numbers before, operations have names. */
/* Without read_operation: 37 of 43 goals were proved in 10 s on a busy machine; open are what it promises of the reader
   (_ensures, 3, 5 and 6) and of a root (_ensures_8), which were not decided though they are admitted before the return,
   and that the relations are apart from the reader (_assert_16). */
/* Without read_value, read_number, dyd_cert_algebra_read: with the contracts below, which were not tried to the end:
   all is taken from what read_operation, dyd_cert_number_value and dyd_cert_number_check leave of block and reader. */
/* Without read_bracket, scan_coefficients: a contract for the first is below, what holds in its loop is not said; the
   second has none. Without either 18 of 19 and 15 of 26 goals are proved; open are reads of the text
   and of the list. */
#include "polys.h"

#include "base/alloc.h"
#include "base/error.h"

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

/* As in number.c and bracket.c; `read`: all but the value of number n of a block. */
/*@ predicate known(numbers a) = \valid(a) && a->relations.count <= 64 && a->count < 4294967295 &&
      \valid(a->number + (0 .. a->count)) && \separated(a, a->number + (0 .. a->count)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number <= a->count) &&
      (\forall integer k; 0 <= k <= a->count ==> a->number[k].a <= a->count);
    predicate circular(integer op) = DYD_CERT_COS <= op <= DYD_CERT_TAN;
    predicate angled(numbers a) = \forall integer k; 0 <= k < a->relations.count && !a->leaf[k].sine &&
      circular(a->number[a->leaf[k].number].op) ==> k + 1 < a->relations.count;
    predicate cycled(numbers a) = cosines(a) &&
      \separated(a->cosine + (0 .. a->cycle - 1), a, a->number + (0 .. a->count));
    predicate bracket(bracket_of r) = \valid_read(r) && 2 <= r->count <= 1001 &&
      \valid_read(r->coeff + (0 .. r->count - 1)) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) &&
      whole(&r->end[0][0]) && whole(&r->end[1][0]) && whole(&r->end[2][0]) && whole(&r->end[3][0]) &&
      sign(&r->end[1][0]) != 0 && sign(&r->end[3][0]) != 0;
    predicate rooted(bracket_of r) = bracket(r) && sign(&r->coeff[r->count - 1][0]) == 1;
    predicate described(number_of n, integer count) = 0 <= n->op < 29 &&
      (1 <= n->op <= 23 ==> n->a < count) && (1 <= n->op <= 6 ==> n->b < count) &&
      -4096 <= n->exponent <= 4096;
    predicate place(numbers a, reading r) = known(a) && angled(a) && cycled(a) && a->count <= 4194304 &&
      \separated(a, r, r->err, r->in, LINES + (..)) &&
      \separated(a->number + (0 .. a->count), r, r->err, r->in, LINES + (..)); */

/*@ requires known(a) && \valid_read(q);
    assigns a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false;
    ensures \result == -1 || \result == 0 || \result == 1; */
int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires bracket(r); assigns \nothing; exits \false; */
bool dyd_cert_root_is_single(const dyd_cert_bracket *r);
/*@ requires known(a) && angled(a) && cycled(a) && n == a->number + a->count && 1 <= n->op <= 28;
    requires described(n, a->count);
    requires n->op == DYD_CERT_ROOT ==> rooted(n->root); exits \false; */
bool dyd_cert_number_value(dyd_cert_number *n, dyd_cert_algebra *a);
/*@ requires known(a) && n == a->number + a->count && described(n, a->count);
    requires n->op == DYD_CERT_SQRT || n->op == DYD_CERT_CBRT || n->op == DYD_CERT_ROOT;
    requires n->op == DYD_CERT_ROOT ==> rooted(n->root); exits \false; */
bool dyd_cert_number_check(dyd_cert_number *n, dyd_cert_algebra *a);
/*@ requires \valid(n); exits \false; */
void dyd_cert_number_clear(dyd_cert_number *n);
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
      \separated(num, den, text + (0 .. stop(text))); exits \false; */
static bool scan_fraction(mpz_ptr num, mpz_ptr den, char *text);
/*@ requires \valid_read(n) && \valid_read(in); assigns \nothing; exits \false;
    ensures \result ==> n->op == DYD_CERT_VALUE || n->op == DYD_CERT_SQRT || n->op == DYD_CERT_CBRT ||
      n->op == DYD_CERT_ROOT;
    ensures !\result ==> n->op != DYD_CERT_VALUE; */
static bool has_value(const dyd_cert_number *n, const dyd_cert_reader *in);
/*@ requires known(a) && reads(in) && \valid(out) &&
      \separated(a, in, in->err, in->in, LINES + (..)) && \separated(out, a, in, in->err, in->in, LINES + (..));
    exits \false; ensures reads(in); */
static dyd_status read_value(dyd_cert_quotient *out, dyd_cert_algebra *a, dyd_cert_reader *in);
/*@ requires \valid(out) && \valid(relations) && reads(in) &&
      \separated(out, relations, in, in->err, in->in, LINES + (..));
    exits \false; ensures reads(in); ensures \result == DYD_OK ==> rooted(*out); */
static dyd_status read_bracket(dyd_cert_bracket **out, dyd_cert_relations *relations, dyd_cert_reader *in);
/*@ requires place(a, in) && reads(in) && n == a->number + a->count; exits \false;
    ensures \valid(in) && \valid(in->in);
    ensures in->err == \null || \valid(in->err);
    ensures in->cap <= 1152921504606846976;
    ensures \separated(in, in->err, in->in, LINES + (..));
    ensures 0 < in->cap ==> \valid(in->line + (0 .. in->cap - 1)) && \base_addr(in->line) == \base_addr(LINES + 0);
    ensures in->at != \null ==> 0 < in->cap && inside(in, in->at);
    ensures \result == DYD_OK ==> described(n, \old(a->count));
    ensures \result == DYD_OK && n->op == DYD_CERT_ROOT ==> rooted(n->root); */
static dyd_status read_operation(dyd_cert_number *n, dyd_cert_algebra *a, dyd_cert_reader *in);
/*@ requires place(a, in) && reads(in) && n == a->number + a->count; exits \false; */
static dyd_status read_number(dyd_cert_number *n, dyd_cert_algebra *a, dyd_cert_reader *in);

/* The list before the place for one more is asked for. */
/*@ predicate listed(numbers a) = \valid(a) && a->relations.count <= 64 && a->count < 4194304 &&
      a->count <= a->cap <= 1152921504606846976 && (0 < a->cap ==> \valid(a->number + (0 .. a->cap - 1))) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number < a->count) &&
      (\forall integer k; 0 <= k < a->count ==> a->number[k].a <= a->count) && angled(a) && cosines(a); */
/*@ requires listed(a) && reads(in) && \separated(a, in, in->err, in->in, LINES + (..)); exits \false; */
dyd_status dyd_cert_algebra_read(dyd_cert_algebra *a, dyd_cert_reader *in);

#include "checker/algebra_read.c"
