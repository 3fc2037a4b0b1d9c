/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The csv format. */
#include "io/output.h"

dyd_writer *const dyd_csv_writers[DYD_CONTENTS] = {[DYD_CONTENT_DELAUNAY] = dyd_layer_pairs,
                                                   [DYD_CONTENT_POINTS] = dyd_layer_points,
                                                   [DYD_CONTENT_TRIANGLES] = dyd_layer_triangles,
                                                   [DYD_CONTENT_VORONOI] = dyd_layer_cells,
                                                   [DYD_CONTENT_VERTICES] = dyd_layer_vertices,
                                                   [DYD_CONTENT_REGIONS] = dyd_layer_regions,
                                                   [DYD_CONTENT_EDGES] = dyd_layer_edges,
                                                   [DYD_CONTENT_CONVERGENCE] = dyd_convergence_csv,
                                                   [DYD_CONTENT_CHECK] = dyd_check_csv,
                                                   [DYD_CONTENT_DISC] = dyd_disc_csv,
                                                   [DYD_CONTENT_BISECTOR] = dyd_bisector_csv,
                                                   [DYD_CONTENT_NEAREST] = dyd_nearest_csv,
                                                   [DYD_CONTENT_PLACES] = dyd_places_csv,
                                                   [DYD_CONTENT_TOLERANCE] = dyd_layer_tolerance,
                                                   [DYD_CONTENT_RADII] = dyd_layer_radii,
                                                   [DYD_CONTENT_BARCODE] = dyd_layer_barcode,
                                                   [DYD_CONTENT_PLAN] = dyd_plan_rows,
                                                   [DYD_CONTENT_GRAPH_NEAREST] = dyd_layer_graph,
                                                   [DYD_CONTENT_GRAPH_GABRIEL] = dyd_layer_graph,
                                                   [DYD_CONTENT_GRAPH_MST] = dyd_layer_graph,
                                                   [DYD_CONTENT_SPHERE] = dyd_sphere_layer_pairs,
                                                   [DYD_CONTENT_SPHERE_POINTS] = dyd_sphere_layer_points,
                                                   [DYD_CONTENT_SPHERE_TRIANGLES] = dyd_sphere_layer_triangles};
