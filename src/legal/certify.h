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
/* An edge in a face (or a whole) of exact points bounded by certain edges: legal iff not cocircular, a hull edge
 * always, a ghost edge iff its vertex is not on the line of its neighbours [TIE-2]. Exact. */
bool dyd_point_edge_is_certain(dyd_tally *tally, const dyd_mesh *m, dyd_half_edge h);
/* Returns true if the two triangles at an edge are cocircular, or on one line with the ghost. Exact. */
bool dyd_edge_is_tie(dyd_tally *tally, const dyd_mesh *m, dyd_half_edge h);

#endif
