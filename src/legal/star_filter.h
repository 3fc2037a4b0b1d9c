/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The quick pass over all vertices, in doubles. */
#ifndef DYD_LEGAL_STAR_FILTER_H
#define DYD_LEGAL_STAR_FILTER_H

#include "skeleton/work.h"

/* Marks the edges whose first guess is proved a witness, and vertices that are surely on the hull [FLT-STAR]. */
dyd_status dyd_certify_stars(dyd_skeleton *sk, dyd_work *w);

#endif
