/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries as JSON. */
#ifndef DYD_IO_ARC_JSON_H
#define DYD_IO_ARC_JSON_H

#include <dyadel/arc.h>
#include <stdio.h>

/* Words for dyd_feature_kind, dyd_arc_kind, dyd_end_kind. */
extern const char *const dyd_feature_names[8], *const dyd_arc_names[3], *const dyd_end_names[5];

/* {"x": {"a": "..", "b": "..", "c": "..", "d": ".."}, ...}: the point (a + b sqrt(c)) / d with integers, and its
 * decimal enclosure. */
dyd_status dyd_surd_point_json(FILE *out, const dyd_surd_point *p);
/* {"whole": .., "chains": [{"closed": .., "arcs": [..]}]}. */
dyd_status dyd_boundary_json(FILE *out, const dyd_boundary *b);

#endif
