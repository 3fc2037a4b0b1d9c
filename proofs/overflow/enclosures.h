/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of intervals. */
#ifndef DYD_PROOFS_ENCLOSURES_H
#define DYD_PROOFS_ENCLOSURES_H

#include "exact.h"

#include "checker/enclosure.h"

typedef const dyd_cert_enclosure *interval_of;

/*@ predicate interval(interval_of x) = \valid_read(x) && whole(&x->lo[0]) && whole(&x->hi[0]); */

#endif
