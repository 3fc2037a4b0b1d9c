/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From a form to a fraction of polynomials in the leaves. */
#ifndef DYD_STREAM_ALGEBRA_NORMAL_H
#define DYD_STREAM_ALGEBRA_NORMAL_H

#include "stream/algebra/ring.h"

/* The fraction of form n, from those of its operands; NULL: beyond the limits, or the ring is stale or failed. Owned by
 * the caller. */
dyd_fraction *dyd_normal_form(dyd_ring *r, uint32_t n);

#endif
