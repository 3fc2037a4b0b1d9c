/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts of what src/checker/sites.h has in it. */
#ifndef DYD_PROOFS_SITES_H
#define DYD_PROOFS_SITES_H

#include "exact.h"

#include "checker/sites.h"

typedef const dyd_cert_side *side_of;

/*@ predicate side(side_of s) = \valid_read(s) && exact(&s->lo) && exact(&s->hi) &&
      (s->den == \null || whole(&(*s->den)[0]) && (*s->den)[0].sign == 1); */

/*@ requires \valid_read(s); assigns \nothing; exits \false; */
static inline bool dyd_cert_is_point(const dyd_cert_site *s);
/*@ requires \valid_read(s); assigns \nothing; exits \false; ensures \result == (s->point ? &s->lo : &s->hi); */
static inline const dyd_exact *dyd_cert_high(const dyd_cert_side *s);
/*@ requires \valid_read(s) && (s->den == \null || \valid_read(s->den)); assigns \nothing; exits \false;
    ensures s->den == \null ? \result == \null : \result == &(*s->den)[0]; */
static inline mpz_srcptr dyd_cert_den(const dyd_cert_side *s);
/*@ requires \valid_read(s) && 0 <= axis <= 1 && \valid(den) && \separated(den, s) &&
      (s->side[axis].den == \null || \valid_read(s->side[axis].den));
    assigns *den; exits \false; */
static inline const dyd_exact *dyd_cert_place(mpz_srcptr *den, const dyd_cert_site *s, int axis);
/*@ requires \valid(side) && whole(den) && (side->den == \null || \valid(side->den));
    assigns side->den, (*side->den)[0]; exits \false; ensures \result == DYD_OK || \result == DYD_E_NOMEM; */
dyd_status dyd_cert_side_set_den(dyd_cert_side *side, mpz_srcptr den);

#endif
