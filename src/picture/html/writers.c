/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What pages can show. The diagram of a sphere is for files and pictures: what is undecided of it has no place. */
#include "picture/html/html.h"

dyd_writer *const dyd_html_writers[DYD_CONTENTS] = {[DYD_CONTENT_DELAUNAY] = dyd_html_triangulation,
                                                    [DYD_CONTENT_POINTS] = dyd_html_triangulation,
                                                    [DYD_CONTENT_TRIANGLES] = dyd_html_triangulation,
                                                    [DYD_CONTENT_GRAPH_NEAREST] = dyd_html_triangulation,
                                                    [DYD_CONTENT_GRAPH_GABRIEL] = dyd_html_triangulation,
                                                    [DYD_CONTENT_GRAPH_MST] = dyd_html_triangulation,
                                                    [DYD_CONTENT_CONVERGENCE] = dyd_html_convergence,
                                                    [DYD_CONTENT_VORONOI] = dyd_html_diagram,
                                                    [DYD_CONTENT_VERTICES] = dyd_html_diagram,
                                                    [DYD_CONTENT_REGIONS] = dyd_html_diagram,
                                                    [DYD_CONTENT_EDGES] = dyd_html_diagram,
                                                    [DYD_CONTENT_SPHERE] = dyd_html_sphere,
                                                    [DYD_CONTENT_SPHERE_POINTS] = dyd_html_sphere,
                                                    [DYD_CONTENT_SPHERE_TRIANGLES] = dyd_html_sphere};
