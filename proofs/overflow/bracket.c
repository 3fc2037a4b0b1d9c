/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/bracket.c: how long its longest number is. */
/* Without dyd_cert_root_is_single: tried, the ends fractions; 59 of 63 goals are proved. Timeout in 5 s, while other
   runs had the machine: what sign_at_fraction requires, of both calls, and that two lengths added to 256 are no
   overflow. */
/* Without sign_of_derivative: tried, with an invariant on the intervals of the loop; 58 of 61 goals are proved. Timeout
   in 2 s, while other runs had the machine: that invariant, and what the second dyd_cert_enclosure_set_q requires. */
/* Without dyd_cert_root_enclose: tried, with an invariant on middle and the ends; WP and CVC4 did not end
   in 150 s, while other runs had the machine. */
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
    ensures all ==> \forall integer k; 0 <= k < r->count ==> bits(&r->coeff[k][0]) <= \result; */
static size_t longest_of(const dyd_cert_bracket *r, bool all);
/*@ requires bracket(f) && whole(num) && whole(den); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int sign_at_fraction(const dyd_cert_bracket *f, mpz_srcptr num, mpz_srcptr den);

#include "checker/bracket.c"
