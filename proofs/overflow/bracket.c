/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/bracket.c: how long its longest number is. */
/* Without sign_at_fraction, dyd_cert_root_is_single: tried, the bracket admitted to stay what it is; that sums in local
   variables stay whole through the loop, that its ends are whole after two numbers were set, CVC4 does not prove. */
/* Without sign_of_derivative, dyd_cert_root_enclose: not tried; they rest on intervals and signs as those. */
#include "polys.h"

typedef const dyd_cert_bracket *bracketed;

/*@ predicate bracket(bracketed r) = \valid_read(r) && 2 <= r->count <= 1001 &&
      \valid_read(r->coeff + (0 .. r->count - 1)) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) &&
      whole(&r->end[0][0]) && whole(&r->end[1][0]) && whole(&r->end[2][0]) && whole(&r->end[3][0]);
    predicate within_bits(bracketed r, integer most) = r->end[0][0].length <= most && r->end[1][0].length <= most &&
      r->end[2][0].length <= most && r->end[3][0].length <= most; */

/*@ requires bracket(r); assigns \nothing; exits \false;
    ensures 1 <= \result <= 137438953472 && within_bits(r, \result);
    ensures all ==> \forall integer k; 0 <= k < r->count ==> r->coeff[k][0].length <= \result; */
static size_t longest_of(const dyd_cert_bracket *r, bool all);

#include "checker/bracket.c"
