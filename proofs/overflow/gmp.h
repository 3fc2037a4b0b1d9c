/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* GMP as the proofs of src/dyadic see it: of an integer, its sign, the length of its absolute value in bits, and the
 * zeros at its end.
 *
 * What GMP's manual promises of both is assumed, and that no integer is longer than 2^37 bits: GMP ends the process
 * before. Preconditions are proved of every call: integers are initialised, shifts are not negative and not absurd,
 * divisors not 0. */
#ifndef DYD_PROOFS_GMP_H
#define DYD_PROOFS_GMP_H

#include <stddef.h>
#include <string.h>

#define GMP_NUMB_BITS 64

typedef struct {
  long long value;
} __mpz_struct;
typedef __mpz_struct mpz_t[1];
typedef __mpz_struct *mpz_ptr;
typedef const __mpz_struct *mpz_srcptr;
typedef struct {
  __mpz_struct num, den;
} __mpq_struct;
typedef __mpq_struct mpq_t[1];
typedef __mpq_struct *mpq_ptr;
typedef const __mpq_struct *mpq_srcptr;
typedef unsigned long mp_bitcnt_t;

/* An integer is one place in memory, and what is there stands for its value: of the values of 2^64 integers something
 * is said, of each alone. */
/*@ axiomatic Integers {
      predicate integer_of(integer value);
      logic integer sign_of(integer value);
      logic integer bits_of(integer value); // of the absolute value
      logic integer zeros_of(integer value); // how many of them are 0 at the end
      axiom limits: \forall integer n; integer_of(n) ==> -1 <= sign_of(n) <= 1 && 0 <= bits_of(n) <= 137438953472 &&
        (sign_of(n) == 0 <==> bits_of(n) == 0) && 0 <= zeros_of(n) &&
        (sign_of(n) != 0 ==> zeros_of(n) < bits_of(n)); } */
#define whole(z) (\valid_read(z) && integer_of((z)->value))
#define sign(z) sign_of((z)->value)
#define bits(z) bits_of((z)->value)
#define zeros(z) zeros_of((z)->value)

/*@ predicate same{K, L}(mpz_srcptr z, mpz_srcptr x) = \at(z->value, L) == \at(x->value, K);
    axiomatic Decimals { logic integer decimals(integer length);
      axiom decimals_few: \forall integer n; 0 <= n ==> 1 <= decimals(n) <= n + 1; } */

/*@ requires \valid(z); assigns z->value; exits \false; ensures whole(z) && sign(z) == 0; */
void mpz_init(mpz_ptr z);
/*@ requires \valid(z) && whole(x);
    assigns z->value; exits \false; ensures whole(z) && same{Pre, Post}(z, x); */
void mpz_init_set(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z);
    assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= 64 && (sign(z) == 0 <==> x == 0); */
void mpz_init_set_si(mpz_ptr z, long x);
/*@ requires \valid(z); assigns z->value; exits \false; ensures whole(z) && bits(z) <= 1024; */
void mpz_init_set_d(mpz_ptr z, double x);
/*@ requires \valid(z) && whole(z); assigns z->value; exits \false; */
void mpz_clear(mpz_ptr z);
/*@ requires \valid(z) && whole(x);
    assigns z->value; exits \false; ensures whole(z) && same{Pre, Post}(z, x); */
void mpz_set(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z) && whole(z); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= 64 && (sign(z) == 0 <==> x == 0) && 0 <= sign(z); */
void mpz_set_ui(mpz_ptr z, unsigned long x);
/*@ requires \valid(z) && \valid(x) && whole(z) && whole(x);
    assigns z->value, x->value; exits \false;
    ensures same{Pre, Post}(z, x) && same{Pre, Post}(x, z); */
void mpz_swap(mpz_ptr z, mpz_ptr x);
/*@ requires \valid(z) && whole(x); assigns z->value; exits \false;
    ensures whole(z) && sign(z) == -\old(sign(x)) && bits(z) == \old(bits(x)) && zeros(z) == \old(zeros(x)); */
void mpz_neg(mpz_ptr z, mpz_srcptr x);
/*@ requires whole(x); assigns \nothing; exits \false; ensures \result == sign(x); */
int mpz_sgn(mpz_srcptr x);
/*@ requires whole(x); assigns \nothing; exits \false; ensures \result != 0 <==> sign(x) != 0 && zeros(x) == 0; */
int mpz_odd_p(mpz_srcptr x);
/*@ requires whole(x) && (base == 2 || base == 10);
    assigns \nothing; exits \false; ensures base == 2 ==> \result == (sign(x) == 0 ? 1 : bits(x));
    ensures base == 10 ==> \result == decimals(bits(x)); */
size_t mpz_sizeinbase(mpz_srcptr x, int base);
/*@ requires whole(x); assigns \nothing; exits \false; ensures \result <= 2147483648; */
size_t mpz_size(mpz_srcptr x);
/*@ requires whole(x) && base == 10 && \valid(out + (0 .. decimals(bits(x)) + 1));
    assigns out[0 .. decimals(bits(x)) + 1]; exits \false;
    ensures \exists integer n; 0 <= n <= decimals(bits(x)) + 1 && ends(out, n); */
char *mpz_get_str(char *out, int base, mpz_srcptr x);
/*@ requires \valid(z) && whole(z) && string(text) && (base == 10 || base == 16);
    assigns z->value; exits \false;
    ensures whole(z); */
int mpz_set_str(mpz_ptr z, const char *text, int base);
/*@ requires whole(x) && sign(x) != 0 && from == 0; assigns \nothing; exits \false; ensures \result == zeros(x); */
mp_bitcnt_t mpz_scan1(mpz_srcptr x, mp_bitcnt_t from);
/*@ requires whole(x) && whole(y); assigns \nothing; exits \false; ensures -2147483647 <= \result;
    ensures \result == 0 ==> same{Here, Here}(x, y); */
int mpz_cmp(mpz_srcptr x, mpz_srcptr y);
/*@ requires whole(x); assigns \nothing; exits \false; ensures -2147483647 <= \result;
    ensures y == 1 && \result == 0 ==> sign(x) == 1 && bits(x) == 1;
    ensures 0 < \result ==> sign(x) == 1; */
int mpz_cmp_ui(mpz_srcptr x, unsigned long y);

/*@ requires \valid(z) && whole(x) && by <= 1099511627776; assigns z->value; exits \false;
    ensures whole(z) && sign(z) == \old(sign(x)) && (sign(z) != 0 ==> bits(z) == \old(bits(x)) + by); */
void mpz_mul_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x); assigns z->value; exits \false;
    ensures whole(z) && (by < \old(bits(x)) ==> sign(z) == \old(sign(x)) && bits(z) == \old(bits(x)) - by);
    ensures by <= \old(zeros(x)) ==> zeros(z) == \old(zeros(x)) - by; */
void mpz_tdiv_q_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x) && by <= 4611686018427387904; assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \max(1, \old(bits(x)) - by + 1);
    ensures sign(z) == 0 || sign(z) == \old(sign(x)); */
void mpz_fdiv_q_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x) && by <= 4611686018427387904; assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \max(1, \old(bits(x)) - by + 1);
    ensures sign(z) == 0 || sign(z) == \old(sign(x)); */
void mpz_cdiv_q_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x) && whole(y); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \max(\old(bits(x)), \old(bits(y))) + 1; */
void mpz_add(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \max(\old(bits(x)), \old(bits(y))) + 1; */
void mpz_sub(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y); assigns z->value; exits \false;
    ensures whole(z) && (\old(sign(x)) == 0 ==> sign(z) == 0) && bits(z) <= \old(bits(x)) + \old(bits(y));
    ensures \old(sign(x)) == 1 && \old(sign(y)) == 1 ==> sign(z) == 1; */
void mpz_mul(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(z) && whole(x) && whole(y);
    assigns z->value; exits \false; ensures whole(z); */
void mpz_addmul(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(z) && whole(x) && whole(y);
    assigns z->value; exits \false; ensures whole(z); */
void mpz_submul(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y) && sign(y) != 0; assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \old(bits(x)) + 1; */
void mpz_fdiv_q(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y) && sign(y) != 0; assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \old(bits(x)) + 1; */
void mpz_cdiv_q(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(z) && 0 < base;
    assigns z->value; exits \false; ensures whole(z) && sign(z) == 1; */
void mpz_ui_pow_ui(mpz_ptr z, unsigned long base, unsigned long exp);
/*@ requires whole(x) && whole(y); assigns \nothing; exits \false; */
int mpz_divisible_p(mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y) && sign(y) != 0;
    assigns z->value; exits \false; ensures whole(z); */
void mpz_divexact(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires whole(x); assigns \nothing; exits \false; */
double mpz_get_d(mpz_srcptr x);

/*@ requires \valid(z) && whole(z) && whole(x) && whole(y); assigns z->value; exits \false;
    ensures whole(z) && 0 <= sign(z); */
void mpz_gcd(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);

/*@ requires \valid(z); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= 64 && (sign(z) == 0 <==> x == 0) && 0 <= sign(z); */
void mpz_init_set_ui(mpz_ptr z, unsigned long x);
/*@ requires \valid(z) && whole(z);
    assigns z->value; exits \false; ensures whole(z) && bits(z) <= 64; */
void mpz_set_si(mpz_ptr z, long x);
/*@ requires \valid(z) && whole(x); assigns z->value; exits \false;
    ensures whole(z) && sign(z) == \abs(\old(sign(x))) && bits(z) == \old(bits(x)) &&
      zeros(z) == \old(zeros(x)); */
void mpz_abs(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z) && whole(x); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \old(bits(x)) * e + 1; */
void mpz_pow_ui(mpz_ptr z, mpz_srcptr x, unsigned long e);
/*@ requires \valid(z) && whole(x) && 0 < k && (k % 2 == 0 ==> 0 <= sign(x));
    assigns z->value; exits \false;
    ensures whole(z) && sign(z) == \old(sign(x)) && bits(z) <= \old(bits(x)); */
int mpz_root(mpz_ptr z, mpz_srcptr x, unsigned long k);
/*@ requires \valid(z) && whole(x);
    assigns z->value; exits \false; ensures whole(z) && bits(z) <= \old(bits(x)) + 64;
    ensures y != 0 ==> sign(z) == \old(sign(x)); */
void mpz_mul_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x);
    assigns z->value; exits \false; ensures whole(z) && bits(z) <= \old(bits(x)) + 64; */
void mpz_mul_si(mpz_ptr z, mpz_srcptr x, long y);
/*@ requires \valid(z) && whole(x); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \max(\old(bits(x)), 64) + 1; */
void mpz_add_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x); assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \max(\old(bits(x)), 64) + 1; */
void mpz_sub_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(z) && whole(x); assigns z->value; exits \false; ensures whole(z); */
void mpz_submul_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires whole(x) && y != 0; assigns \nothing; exits \false; ensures \result < y; */
unsigned long mpz_fdiv_ui(mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x) && y != 0; assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \old(bits(x));
    ensures 2 <= y && 0 <= \old(sign(x)) ==> 0 <= sign(z) && bits(z) <= \max(0, \old(bits(x)) - 1); */
unsigned long mpz_fdiv_q_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x) && y != 0; assigns z->value; exits \false;
    ensures whole(z) && bits(z) <= \old(bits(x)); */
unsigned long mpz_cdiv_q_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires whole(x) && whole(y); assigns \nothing; exits \false; ensures -2147483647 <= \result; */
int mpz_cmpabs(mpz_srcptr x, mpz_srcptr y);
/*@ requires whole(x); assigns \nothing; exits \false; ensures -2147483647 <= \result;
    ensures y == 1 && 0 < \result ==> 2 <= bits(x); */
int mpz_cmpabs_ui(mpz_srcptr x, unsigned long y);
/*@ requires whole(x); assigns \nothing; exits \false; ensures -2147483647 <= \result; */
int mpz_cmp_si(mpz_srcptr x, long y);
/*@ requires whole(x); assigns \nothing; exits \false;
    ensures bits(x) <= 60 ==> -1152921504606846975 <= \result <= 1152921504606846975; */
long mpz_get_si(mpz_srcptr x);
/*@ requires whole(x); assigns \nothing; exits \false; ensures bits(x) <= 60 ==> \result <= 1152921504606846975; */
unsigned long mpz_get_ui(mpz_srcptr x);
/*@ requires \valid(z) && whole(x) && 0 <= sign(x); assigns *z; exits \false;
    ensures whole(z) && 0 <= sign(z) && bits(z) <= (\old(bits(x)) + 1) / 2; */
void mpz_sqrt(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z) && \valid(rest) && whole(z) && whole(rest) && whole(x) && 0 <= sign(x) && \separated(z, rest);
    assigns *z, *rest; exits \false; ensures whole(z) && whole(rest) && bits(z) <= (\old(bits(x)) + 1) / 2; */
void mpz_sqrtrem(mpz_ptr z, mpz_ptr rest, mpz_srcptr x);

/* Those of any number of arguments, up to NULL: of two here. */
#define mpz_inits(a, b, end) (mpz_init(a), mpz_init(b))
#define mpz_clears(a, b, end) (mpz_clear(a), mpz_clear(b))

#define mpq_numref(q) (&(q)->num)
#define mpq_denref(q) (&(q)->den)
/*@ requires \valid(q) && whole(x); assigns *q; exits \false; ensures whole(&q->num) && same{Pre, Post}(&q->num, x);
    ensures whole(&q->den) && bits(&q->den) == 1 && sign(&q->den) == 1 && zeros(&q->den) == 0; */
void mpq_set_z(mpq_ptr q, mpz_srcptr x);

#endif
