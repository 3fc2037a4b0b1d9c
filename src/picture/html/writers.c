/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What pages can show. */
#include "picture/html/html.h"

dyd_writer *const dyd_html_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = dyd_html_pairs,      [DYD_CONTENT_POINTS] = dyd_html_points,
    [DYD_CONTENT_TRIANGLES] = dyd_html_triangles, [DYD_CONTENT_CONVERGENCE] = dyd_html_convergence,
    [DYD_CONTENT_VORONOI] = dyd_html_cells,       [DYD_CONTENT_VERTICES] = dyd_html_vertices,
    [DYD_CONTENT_REGIONS] = dyd_html_regions,     [DYD_CONTENT_EDGES] = dyd_html_edges};
