/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory of boundaries. */
#ifndef DYD_VORONOI_BOUNDARY_H
#define DYD_VORONOI_BOUNDARY_H

#include <dyadel/arc.h>

/* Appends a chain with room for `arcs` initialised arcs (count = arcs) to a boundary whose chain array has room for it.
 * NULL when memory is exhausted, nothing changed then. */
dyd_chain *dyd_boundary_add_chain(dyd_boundary *b, size_t arcs);

#endif
