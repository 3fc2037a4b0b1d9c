/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The html format: a page in one file, moved with the hand. What is drawn is rounded; what a page says is not. */
#ifndef DYD_PICTURE_HTML_HTML_H
#define DYD_PICTURE_HTML_HTML_H

#include "io/output.h"

/* Of all layers; they differ by what is seen first, graphs by their pairs. */
dyd_writer dyd_html_triangulation, dyd_html_diagram, dyd_html_convergence, dyd_html_sphere;

#endif
