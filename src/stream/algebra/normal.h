/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From a form to a fraction of polynomials in the leaves. */
#ifndef DYD_STREAM_ALGEBRA_NORMAL_H
#define DYD_STREAM_ALGEBRA_NORMAL_H

#include "stream/algebra/ring.h"

/* Makes the fractions of the forms given; until then leaves are not settled. */
dyd_status dyd_ring_settle(dyd_ring *r, const uint32_t *node, size_t count);
/* The fraction of form n; NULL: not known, or beyond the limits. Borrowed. */
const dyd_fraction *dyd_ring_fraction(dyd_ring *r, uint32_t n);

#endif
