/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The html format: a page in one file, moved with the hand. What is drawn is rounded; what a page says is not. */
#ifndef DYD_PICTURE_HTML_HTML_H
#define DYD_PICTURE_HTML_HTML_H

#include "io/output.h"

dyd_writer dyd_html_pairs, dyd_html_points, dyd_html_triangles, dyd_html_convergence;
dyd_writer dyd_html_cells, dyd_html_vertices, dyd_html_regions, dyd_html_edges;

#endif
