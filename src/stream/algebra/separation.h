/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How small a value can be without being 0. */
#ifndef DYD_STREAM_ALGEBRA_SEPARATION_H
#define DYD_STREAM_ALGEBRA_SEPARATION_H

#include "stream/algebra/ring.h"

/* For a form n with numerator P and denominator Q, polynomials in algebraic integers: P = 0 or |P| > 2^-bits, and
 * |Q| <= den. degree: of the product over all conjugates. */
typedef struct dyd_separation {
  slong bits, degree;
  mag_t den;
} dyd_separation;

/* s->den is initialised. false: there is no such bound, or it is beyond `most` bits. */
bool dyd_separation_find(dyd_separation *s, dyd_ring *r, uint32_t n, slong most);

#endif
