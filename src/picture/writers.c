/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What pictures can show. */
#include "picture/picture.h"

dyd_writer *const dyd_picture_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = dyd_delaunay_picture,      [DYD_CONTENT_VORONOI] = dyd_voronoi_picture,
    [DYD_CONTENT_PLOT] = dyd_convergence_picture,       [DYD_CONTENT_DISC] = dyd_disc_picture,
    [DYD_CONTENT_BISECTOR] = dyd_bisector_picture,      [DYD_CONTENT_NEAREST] = dyd_nearest_picture,
    [DYD_CONTENT_TOLERANCE] = dyd_tolerance_picture,    [DYD_CONTENT_GRAPH_NEAREST] = dyd_delaunay_picture,
    [DYD_CONTENT_GRAPH_GABRIEL] = dyd_delaunay_picture, [DYD_CONTENT_GRAPH_MST] = dyd_delaunay_picture,
    [DYD_CONTENT_SPHERE] = dyd_sphere_picture,          [DYD_CONTENT_SPHERE_VORONOI] = dyd_sphere_voronoi_picture};
