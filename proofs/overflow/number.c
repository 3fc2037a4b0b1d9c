/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/number.c: leaves are of numbers that are there, and made where there is room. */
#include "numbers.h"

/*@ predicate stays{K, L}(numbers a) = known{L}(a) && \at(a->number, L) == \at(a->number, K) &&
      \at(a->count, L) == \at(a->count, K); */

typedef const dyd_cert_quotient *operand;

/*@ predicate elsewhere(polynomial p, operand x, numbers a) =
      \separated(p->term + (0 .. p->count - 1), x, a, a->cosine + (0 .. a->cycle - 1));
    predicate given(operand u, operand x, numbers a) = \valid_read(u) && poly(&u->num) && poly(&u->den) &&
      \separated(u, x, a, a->cosine + (0 .. a->cycle - 1)) && elsewhere(&u->num, x, a) && elsewhere(&u->den, x, a); */

/*@ requires \valid(a) && a->relations.count <= 64 && a->count < 4294967295;
    assigns *a; exits \false;
    ensures \result < 64 ==> \result == \old(a->relations.count) && a->relations.count == \result + 1 &&
      a->leaf[\result].number == a->count && whole(&a->leaf[\result].bound[0]);
    ensures \result <= 64 && a->relations.count <= 64;
    ensures a->number == \old(a->number) && a->count == \old(a->count);
    ensures \result == 64 ==> a->relations.count == 64;
    ensures known{Pre}(a) ==> stays{Pre, Post}(a); */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);
/*@ requires known(a) && \valid_read(q);
    assigns a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false;
    ensures \result == -1 || \result == 0 || \result == 1; */
int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires known(a) && k < a->count;
    assigns a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false;
    ensures \result == -1 || \result == 0 || \result == 1; */
int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k);

/*@ assigns \nothing; exits \false; ensures \result != 0 <==> circular(op); */
static bool is_circular(dyd_cert_op op);
/*@ assigns \nothing; exits \false; */
static bool is_exponential(dyd_cert_op op);
/*@ requires known(a) && k < a->relations.count; assigns \nothing; exits \false;
    ensures \result && circular(op) ==> angle(a, k); */
static bool is_leaf_of(const dyd_cert_algebra *a, size_t k, dyd_cert_op op);
/*@ requires known(a) && k < a->relations.count && \valid(sign) && \valid_read(u) && \separated(sign, a,
      a->number + (0 .. a->count));
    assigns *sign, a->relations.nomem, a->relations.work; exits \false; ensures -1 <= *sign <= 1; */
static bool operand_compare(int *sign, dyd_cert_algebra *a, size_t k, const dyd_cert_quotient *u);
/*@ requires known(a) && \valid(leaf) && \valid(sign) && \valid_read(u) && \separated(leaf, sign, a,
      a->number + (0 .. a->count));
    assigns *leaf, *sign, a->relations.nomem, a->relations.work; exits \false;
    ensures -1 <= *sign <= 1 && *leaf <= 64;
    ensures \result && *leaf < 64 ==> *leaf < a->relations.count;
    ensures \result && *leaf < 64 && circular(op) ==> angle(a, *leaf); */
static bool find_leaf(size_t *leaf, int *sign, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u);
/*@ requires \valid(x) && \valid(a) && k < 64 && \separated(x, a); assigns *x, a->relations.nomem, a->relations.work;
    exits \false; */
static bool value_is_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a, size_t k);
/*@ requires \valid(x) && known(a) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_makes_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a);
/*@ requires \valid(x) && \valid(a) && \separated(x, a); assigns *x, a->relations.nomem, a->relations.work;
    exits \false; */
static bool value_set_si(dyd_cert_quotient *x, long z, dyd_cert_algebra *a);
/* That what is known of the block stays is admitted where this is called (number.acsl). */
/*@ requires known(a); assigns *a; exits \false; ensures \result <= 64; ensures \result < 64 ==> \result + 1 < 64; */
static size_t make_angle(dyd_cert_algebra *a);
/*@ requires \valid(x) && known(a) && \valid_read(u) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_exponential(dyd_cert_quotient *x, dyd_cert_algebra *a, bool may, const dyd_cert_quotient *u);
/*@ requires known(a) && \valid_read(u) && (sign == 1 || sign == -1);
    assigns a->relations.nomem, a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p;
    exits \false; */
static bool is_up_to_one(dyd_cert_algebra *a, const dyd_cert_quotient *u, int sign);
/*@ requires \valid(x) && known(a) && u < a->count && \separated(x, a);
    assigns *x, a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false; */
static bool value_absolute(dyd_cert_quotient *x, dyd_cert_algebra *a, uint32_t u);
/*@ requires \valid(x) && known(a) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_e(dyd_cert_quotient *x, dyd_cert_algebra *a);
/*@ requires \valid(x) && known(a) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_pi(dyd_cert_quotient *x, dyd_cert_algebra *a);

/* Of those below, where the block is no list of them: bounds of leaves, the cycle. */
/*@ requires \valid(out) && whole(out) && \valid_read(a) && \valid_read(q);
    assigns out->value; exits \false; ensures whole(out) && 0 <= sign(out); */
bool dyd_cert_poly_bound(mpz_ptr out, const dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires \valid(a) && \valid(value) && cosines(a) && whole(num) && whole(den) && sign(den) != 0 &&
      \separated(a, value, a->cosine + (0 .. a->cycle - 1), num, den);
    assigns *value, a->relations.nomem, a->relations.work, a->cosines, a->cosine[0 .. a->cycle - 1]; exits \false;
    ensures cosines(a); */
bool dyd_cert_cycle_cosine(dyd_cert_quotient *value, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den);
/*@ requires known(a) && n == a->number + a->count; exits \false; */
bool dyd_cert_cycle_begin(dyd_cert_number *n, dyd_cert_algebra *a);

typedef const dyd_cert_number *of_block;
/*@ predicate bracketed(of_block n) = \valid_read(n->root) && 2 <= n->root->count <= 1001 &&
      \valid_read(n->root->coeff + (0 .. n->root->count - 1)) &&
      (\forall integer k; 0 <= k < n->root->count ==> whole(&n->root->coeff[k][0])) &&
      whole(&n->root->end[0][0]) && whole(&n->root->end[1][0]) && whole(&n->root->end[2][0]) &&
      whole(&n->root->end[3][0]) && sign(&n->root->end[1][0]) != 0 && sign(&n->root->end[3][0]) != 0; */

/*@ requires \valid(x) && known(a) && angled(a) && cycled(a) && given(u, x, a) &&
      \separated(x, a, a->cosine + (0 .. a->cycle - 1)) && (op == DYD_CERT_COS || op == DYD_CERT_SIN);
    assigns *x, *a, a->cosine[0 .. a->cycle - 1]; exits \false;
    ensures stays{Pre, Post}(a);
    ensures \result ==> angled(a);
    ensures a->cosine == \old(a->cosine) && a->cycle == \old(a->cycle) && cycled(a);
    ensures \forall operand y; \old(given(u, y, a)) ==> given(u, y, a); */
static bool value_circular(dyd_cert_quotient *x, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u);
/*@ requires \valid(x) && known(a) && angled(a) && cycled(a) && given(u, x, a) &&
      \separated(x, a, a->cosine + (0 .. a->cycle - 1)); exits \false; */
static bool value_tangent(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_quotient *u);
/*@ requires \valid(x) && known(a) && \valid_read(u) && \separated(x, a); exits \false; */
static bool value_hyperbolic(dyd_cert_quotient *x, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u);
/*@ requires \valid(x) && known(a) && \valid_read(u) && x != u && \separated(x, a) && \separated(u, a) && 2 <= k <= 3;
    exits \false; */
static bool value_radical(dyd_cert_quotient *x, dyd_cert_algebra *a, unsigned k, const dyd_cert_quotient *u);
/*@ requires \valid(x) && known(a) && n == a->number + a->count && n->a < a->count && \separated(x, a); exits \false; */
static bool value_inverse(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n);
/*@ requires \valid(x) && known(a) && \valid_read(y) && \separated(x, a) && x != y; exits \false; */
static bool value_extreme(dyd_cert_quotient *x, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *y);
/*@ requires known(a) && n == a->number + a->count && x == &n->value && n->a < a->count && n->b < a->count;
    exits \false; */
static bool value_operation(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n);
/*@ requires known(a) && n == a->number + a->count && x == &n->value && n->a < a->count &&
      -4096 <= n->exponent <= 4096; exits \false; */
static bool value_power(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n);
/*@ requires known(a) && angled(a) && cycled(a) && n == a->number + a->count && x == &n->value && n->a < a->count;
    exits \false; */
static bool value_function(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n);
/*@ requires \valid(x) && known(a) && \separated(x, a) && \valid_read(f) && 2 <= f->count <= 1001 &&
      \valid_read(f->coeff + (0 .. f->count - 1)) &&
      (\forall integer k; 0 <= k < f->count ==> whole(&f->coeff[k][0])) && sign(&f->coeff[f->count - 1][0]) == 1 &&
      \separated(a, f, f->coeff + (0 .. f->count - 1)) && \separated(x, f, f->coeff + (0 .. f->count - 1));
    exits \false; */
static bool value_root(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_bracket *f);
/*@ requires known(a) && angled(a) && cycled(a) && n == a->number + a->count && 1 <= n->op <= 28;
    requires 1 <= n->op <= 23 ==> n->a < a->count;
    requires 1 <= n->op <= 6 ==> n->b < a->count;
    requires n->op == DYD_CERT_POW ==> -4096 <= n->exponent <= 4096;
    requires n->op == DYD_CERT_ROOT ==> bracketed(n) && sign(&n->root->coeff[n->root->count - 1][0]) == 1 &&
      \separated(a, n->root, n->root->coeff + (0 .. n->root->count - 1)) &&
      \separated(&n->value, n->root, n->root->coeff + (0 .. n->root->count - 1)); exits \false; */
bool dyd_cert_number_value(dyd_cert_number *n, dyd_cert_algebra *a);
/*@ requires \valid_read(v) && known(a) && \valid_read(u) && \separated(a, u, v); exits \false; */
static bool is_radical(const dyd_cert_quotient *v, dyd_cert_algebra *a, unsigned k, const dyd_cert_quotient *u);
/*@ requires \valid(zero) && \valid_read(f) && f->count <= 1001 && known(a) && \valid_read(v) &&
      (0 < f->count ==> \valid_read(f->coeff + (0 .. f->count - 1))) &&
      (\forall integer k; 0 <= k < f->count ==> whole(&f->coeff[k][0])) &&
      \separated(a, f) && \separated(zero, a, f);
    assigns *zero, a->relations.nomem, a->relations.work; exits \false; ensures stays{Pre, Post}(a); */
static bool root_vanishes(bool *zero, const dyd_cert_bracket *f, dyd_cert_algebra *a, const dyd_cert_quotient *v);
/*@ requires known(a); requires \valid_read(v); requires whole(num); requires whole(den); requires sign(den) != 0;
    assigns a->relations.nomem, a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p;
    exits \false; ensures stays{Pre, Post}(a); */
static int side_of_end(const dyd_cert_quotient *v, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den);
/*@ requires known(a) && n == a->number + a->count && (n->op == DYD_CERT_ROOT ==> bracketed(n) &&
      \separated(a, n->root) && \separated(a->number + (0 .. a->count), n->root)) &&
      (n->op != DYD_CERT_ROOT ==> n->a < a->count); exits \false; */
bool dyd_cert_number_check(dyd_cert_number *n, dyd_cert_algebra *a);
/*@ requires \valid(num) && \valid(den) && whole(num) && whole(den) && known(a) && \valid_read(u) && poly(&u->num) &&
      poly(&u->den) && \separated(num, den, u) && \separated(num, u->num.term) && \separated(num, u->den.term) &&
      \separated(den, u->num.term) && \separated(den, u->den.term) && \separated(num, a) && \separated(den, a) &&
      \separated(num, a->number + (0 .. a->count)) && \separated(den, a->number + (0 .. a->count));
    assigns num->value, den->value; exits \false;
    ensures whole(num) && whole(den); ensures \result ==> sign(den) != 0; */
static bool is_part_of_turn(mpz_ptr num, mpz_ptr den, const dyd_cert_algebra *a, const dyd_cert_quotient *u);

#include "checker/number.c"
