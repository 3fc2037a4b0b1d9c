/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact places on one circle of the sphere. */
#ifndef DYD_CHECKER_COCIRCULAR_H
#define DYD_CHECKER_COCIRCULAR_H

#include "checker/region.h"

/* Are four exact places, different from each other, seen to be on one circle? [CERT-14] */
bool dyd_cert_are_cocircular(const dyd_cert_region *const at[4]);

#endif
