/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* GMP as the proofs of src/dyadic see it: of an integer, its sign and the length of its absolute value in bits.
 *
 * What GMP's manual promises of both is assumed, and that no integer is longer than 2^37 bits: GMP ends the process
 * before. Preconditions are proved of every call: integers are initialised, shifts are not negative and not absurd,
 * divisors not 0. */
#ifndef DYD_PROOFS_GMP_H
#define DYD_PROOFS_GMP_H

#include <stddef.h>
#include <string.h>

typedef struct {
  long long length;
  int sign, zeros; /* zeros: bits 0 at the end */
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

/*@ predicate whole(mpz_srcptr z) = \valid_read(z) && -1 <= z->sign <= 1 && 0 <= z->length <= 137438953472 &&
      (z->sign == 0 <==> z->length == 0) && 0 <= z->zeros && (z->sign != 0 ==> z->zeros < z->length);
    predicate same{K, L}(mpz_srcptr z, mpz_srcptr x) = \at(z->sign, L) == \at(x->sign, K) &&
      \at(z->length, L) == \at(x->length, K) && \at(z->zeros, L) == \at(x->zeros, K);
    axiomatic Decimals { logic integer decimals(integer length);
      axiom decimals_few: \forall integer n; 0 <= n ==> 1 <= decimals(n) <= n + 1; } */

/*@ requires \valid(z); assigns z->sign, z->length, z->zeros; exits \false; ensures whole(z) && z->sign == 0; */
void mpz_init(mpz_ptr z);
/*@ requires \valid(z) && whole(x);
    assigns z->sign, z->length, z->zeros; exits \false; ensures whole(z) && same{Pre, Post}(z, x); */
void mpz_init_set(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z);
    assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= 64 && (z->sign == 0 <==> x == 0); */
void mpz_init_set_si(mpz_ptr z, long x);
/*@ requires \valid(z); assigns z->sign, z->length, z->zeros; exits \false; ensures whole(z) && z->length <= 1024; */
void mpz_init_set_d(mpz_ptr z, double x);
/*@ requires \valid(z) && whole(z); assigns z->sign, z->length, z->zeros; exits \false; */
void mpz_clear(mpz_ptr z);
/*@ requires \valid(z) && whole(x);
    assigns z->sign, z->length, z->zeros; exits \false; ensures whole(z) && same{Pre, Post}(z, x); */
void mpz_set(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z) && whole(z); assigns *z; exits \false; ensures whole(z) && z->length <= 64; */
void mpz_set_ui(mpz_ptr z, unsigned long x);
/*@ requires \valid(z) && \valid(x) && whole(z) && whole(x);
    assigns z->sign, z->length, z->zeros, x->sign, x->length, x->zeros; exits \false;
    ensures same{Pre, Post}(z, x) && same{Pre, Post}(x, z); */
void mpz_swap(mpz_ptr z, mpz_ptr x);
/*@ requires \valid(z) && whole(x); assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->sign == -\old(x->sign) && z->length == \old(x->length) && z->zeros == \old(x->zeros); */
void mpz_neg(mpz_ptr z, mpz_srcptr x);
/*@ requires whole(x); assigns \nothing; exits \false; ensures \result == x->sign; */
int mpz_sgn(mpz_srcptr x);
/*@ requires whole(x); assigns \nothing; exits \false; ensures \result != 0 <==> x->sign != 0 && x->zeros == 0; */
int mpz_odd_p(mpz_srcptr x);
/*@ requires whole(x) && (base == 2 || base == 10);
    assigns \nothing; exits \false; ensures base == 2 ==> \result == (x->sign == 0 ? 1 : x->length);
    ensures base == 10 ==> \result == decimals(x->length); */
size_t mpz_sizeinbase(mpz_srcptr x, int base);
/*@ requires whole(x); assigns \nothing; exits \false; ensures \result <= 2147483648; */
size_t mpz_size(mpz_srcptr x);
/*@ requires whole(x) && base == 10 && \valid(out + (0 .. decimals(x->length) + 1));
    assigns out[0 .. decimals(x->length) + 1]; exits \false;
    ensures \exists integer n; 0 <= n <= decimals(x->length) + 1 && ends(out, n); */
char *mpz_get_str(char *out, int base, mpz_srcptr x);
/*@ requires \valid(z) && whole(z) && string(text) && (base == 10 || base == 16); assigns *z; exits \false;
    ensures whole(z); */
int mpz_set_str(mpz_ptr z, const char *text, int base);
/*@ requires whole(x) && x->sign != 0 && from == 0; assigns \nothing; exits \false; ensures \result == x->zeros; */
mp_bitcnt_t mpz_scan1(mpz_srcptr x, mp_bitcnt_t from);
/*@ requires whole(x) && whole(y); assigns \nothing; exits \false; ensures -2147483647 <= \result;
    ensures \result == 0 ==> same{Here, Here}(x, y); */
int mpz_cmp(mpz_srcptr x, mpz_srcptr y);
/*@ requires whole(x); assigns \nothing; exits \false; ensures -2147483647 <= \result;
    ensures y == 1 && \result == 0 ==> x->sign == 1 && x->length == 1;
    ensures 0 < \result ==> x->sign == 1; */
int mpz_cmp_ui(mpz_srcptr x, unsigned long y);

/*@ requires \valid(z) && whole(x) && by <= 1099511627776; assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->sign == \old(x->sign) && (z->sign != 0 ==> z->length == \old(x->length) + by); */
void mpz_mul_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x); assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && (by < \old(x->length) ==> z->sign == \old(x->sign) && z->length == \old(x->length) - by);
    ensures by <= \old(x->zeros) ==> z->zeros == \old(x->zeros) - by; */
void mpz_tdiv_q_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x) && by <= 4611686018427387904; assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= \max(1, \old(x->length) - by + 1);
    ensures z->sign == 0 || z->sign == \old(x->sign); */
void mpz_fdiv_q_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x) && by <= 4611686018427387904; assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= \max(1, \old(x->length) - by + 1);
    ensures z->sign == 0 || z->sign == \old(x->sign); */
void mpz_cdiv_q_2exp(mpz_ptr z, mpz_srcptr x, mp_bitcnt_t by);
/*@ requires \valid(z) && whole(x) && whole(y); assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= \max(\old(x->length), \old(y->length)) + 1; */
void mpz_add(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y); assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= \max(\old(x->length), \old(y->length)) + 1; */
void mpz_sub(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y); assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && (\old(x->sign) == 0 ==> z->sign == 0) && z->length <= \old(x->length) + \old(y->length);
    ensures \old(x->sign) == 1 && \old(y->sign) == 1 ==> z->sign == 1; */
void mpz_mul(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(z) && whole(x) && whole(y);
    assigns z->sign, z->length, z->zeros; exits \false; ensures whole(z); */
void mpz_addmul(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(z) && whole(x) && whole(y);
    assigns z->sign, z->length, z->zeros; exits \false; ensures whole(z); */
void mpz_submul(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y) && y->sign != 0; assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= \old(x->length) + 1; */
void mpz_fdiv_q(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y) && y->sign != 0; assigns z->sign, z->length, z->zeros; exits \false;
    ensures whole(z) && z->length <= \old(x->length) + 1; */
void mpz_cdiv_q(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(z) && 0 < base; assigns *z; exits \false; ensures whole(z) && z->sign == 1; */
void mpz_ui_pow_ui(mpz_ptr z, unsigned long base, unsigned long exp);
/*@ requires whole(x) && whole(y); assigns \nothing; exits \false; */
int mpz_divisible_p(mpz_srcptr x, mpz_srcptr y);
/*@ requires \valid(z) && whole(x) && whole(y) && y->sign != 0; assigns *z; exits \false; ensures whole(z); */
void mpz_divexact(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);
/*@ requires whole(x); assigns \nothing; exits \false; */
double mpz_get_d(mpz_srcptr x);

/*@ requires \valid(z) && whole(z) && whole(x) && whole(y); assigns *z; exits \false;
    ensures whole(z) && 0 <= z->sign; */
void mpz_gcd(mpz_ptr z, mpz_srcptr x, mpz_srcptr y);

/*@ requires \valid(z); assigns *z; exits \false;
    ensures whole(z) && z->length <= 64 && (z->sign == 0 <==> x == 0) && 0 <= z->sign; */
void mpz_init_set_ui(mpz_ptr z, unsigned long x);
/*@ requires \valid(z) && whole(z); assigns *z; exits \false; ensures whole(z) && z->length <= 64; */
void mpz_set_si(mpz_ptr z, long x);
/*@ requires \valid(z) && whole(x); assigns *z; exits \false;
    ensures whole(z) && z->sign == \abs(\old(x->sign)) && z->length == \old(x->length) &&
      z->zeros == \old(x->zeros); */
void mpz_abs(mpz_ptr z, mpz_srcptr x);
/*@ requires \valid(z) && whole(x); assigns *z; exits \false;
    ensures whole(z) && z->length <= \old(x->length) * e + 1; */
void mpz_pow_ui(mpz_ptr z, mpz_srcptr x, unsigned long e);
/*@ requires \valid(z) && whole(x) && 0 < k && (k % 2 == 0 ==> 0 <= x->sign); assigns *z; exits \false;
    ensures whole(z) && z->sign == \old(x->sign) && z->length <= \old(x->length); */
int mpz_root(mpz_ptr z, mpz_srcptr x, unsigned long k);
/*@ requires \valid(z) && whole(x); assigns *z; exits \false; ensures whole(z) && z->length <= \old(x->length) + 64; */
void mpz_mul_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x); assigns *z; exits \false; ensures whole(z) && z->length <= \old(x->length) + 64; */
void mpz_mul_si(mpz_ptr z, mpz_srcptr x, long y);
/*@ requires \valid(z) && whole(x); assigns *z; exits \false;
    ensures whole(z) && z->length <= \max(\old(x->length), 64) + 1; */
void mpz_add_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x); assigns *z; exits \false;
    ensures whole(z) && z->length <= \max(\old(x->length), 64) + 1; */
void mpz_sub_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(z) && whole(x); assigns *z; exits \false; ensures whole(z); */
void mpz_submul_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires whole(x) && y != 0; assigns \nothing; exits \false; ensures \result < y; */
unsigned long mpz_fdiv_ui(mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x) && y != 0; assigns *z; exits \false;
    ensures whole(z) && z->length <= \old(x->length) + 1; */
unsigned long mpz_fdiv_q_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires \valid(z) && whole(x) && y != 0; assigns *z; exits \false;
    ensures whole(z) && z->length <= \old(x->length) + 1; */
unsigned long mpz_cdiv_q_ui(mpz_ptr z, mpz_srcptr x, unsigned long y);
/*@ requires whole(x) && whole(y); assigns \nothing; exits \false; ensures -2147483647 <= \result; */
int mpz_cmpabs(mpz_srcptr x, mpz_srcptr y);
/*@ requires whole(x); assigns \nothing; exits \false; ensures -2147483647 <= \result; */
int mpz_cmpabs_ui(mpz_srcptr x, unsigned long y);
/*@ requires whole(x); assigns \nothing; exits \false; ensures -2147483647 <= \result; */
int mpz_cmp_si(mpz_srcptr x, long y);
/*@ requires whole(x); assigns \nothing; exits \false; */
long mpz_get_si(mpz_srcptr x);

/* Those of any number of arguments, up to NULL: of two here. */
#define mpz_inits(a, b, end) (mpz_init(a), mpz_init(b))
#define mpz_clears(a, b, end) (mpz_clear(a), mpz_clear(b))

#define mpq_numref(q) (&(q)->num)
#define mpq_denref(q) (&(q)->den)
/*@ requires \valid(q) && whole(x); assigns *q; exits \false; ensures whole(&q->num) && same{Pre, Post}(&q->num, x);
    ensures whole(&q->den) && q->den.length == 1 && q->den.sign == 1 && q->den.zeros == 0; */
void mpq_set_z(mpq_ptr q, mpz_srcptr x);

#endif
