/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/bracket.c: how long its longest number is. */
/* Unproved dyd_cert_root_enclose_assert_2: a product of two numbers of at most 19 bits; CVC4 decides it in some runs.
   */
#define SPELL_OUT
#include "enclosures.h"
#include "polys.h"

typedef const dyd_cert_bracket *bracketed;

/*@ predicate bracket(bracketed r) = \valid_read(r) && 2 <= r->count <= 1001 &&
      \valid_read(r->coeff + (0 .. r->count - 1)) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) &&
      whole(&r->end[0][0]) && whole(&r->end[1][0]) && whole(&r->end[2][0]) && whole(&r->end[3][0]);
    predicate within_bits(bracketed r, integer most) = bits(&r->end[0][0]) <= most && bits(&r->end[1][0]) <= most &&
      bits(&r->end[2][0]) <= most && bits(&r->end[3][0]) <= most; */

/*@ requires bracket(r); assigns \nothing; exits \false;
    ensures 1 <= \result <= 137438953472 && within_bits(r, \result);
    ensures !all && within_bits(r, 262144) ==> \result <= 262144;
    ensures all ==> \forall integer k; 0 <= k < r->count ==> bits(&r->coeff[k][0]) <= \result; */
static size_t longest_of(const dyd_cert_bracket *r, bool all);
/*@ requires bracket(f) && whole(num) && whole(den); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int sign_at_fraction(const dyd_cert_bracket *f, mpz_srcptr num, mpz_srcptr den);
/*@ predicate ends_divide(bracketed r) = sign(&r->end[1][0]) != 0 && sign(&r->end[3][0]) != 0; */

/*@ requires bracket(f) && ends_divide(f) && 0 <= p <= 16384; assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
static int sign_of_derivative(const dyd_cert_bracket *f, long p);
/*@ requires bracket(r) && ends_divide(r); assigns \nothing; exits \false;
    ensures \result ==> within_bits(r, 262144); */
bool dyd_cert_root_is_single(const dyd_cert_bracket *r);
/*@ requires \valid(out) && interval(out) && bracket(r) && ends_divide(r) && within_bits(r, 262144) &&
      0 <= p <= 16384 &&
      \separated(out, r, r->coeff + (0 .. r->count - 1));
    assigns ALL_OF(out); exits \false; ensures interval(out); */
void dyd_cert_root_enclose(dyd_cert_enclosure *out, const dyd_cert_bracket *r, long p);

#include "checker/bracket.c"
