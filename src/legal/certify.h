/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which edges of the skeleton are certain: real edges legal, ghost edges certainly on the hull. */
#ifndef DYD_LEGAL_CERTIFY_H
#define DYD_LEGAL_CERTIFY_H

#include "skeleton/work.h"

/* Marks every certain edge of a fresh skeleton, in w->run->threads threads. */
dyd_status dyd_certify_all(dyd_skeleton *sk, dyd_work *w);
/* The same where all sites are exact points [TIE-1]. */
dyd_status dyd_certify_points(dyd_skeleton *sk, dyd_work *w);
/* Decides an edge, by witness or hull test, and marks it. */
dyd_status dyd_certify_edge(dyd_skeleton *sk, dyd_work *w, dyd_half_edge h);

#endif
