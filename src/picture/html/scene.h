/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What all pages tell: points, pairs stage by stage, triangles; of everything, or of a window. */
#ifndef DYD_PICTURE_HTML_SCENE_H
#define DYD_PICTURE_HTML_SCENE_H

#include "engine/history.h"
#include "io/result.h"

/* Writes members of a page of its own, each with a comma behind. */
typedef dyd_status (*dyd_html_own_fn)(FILE *out, const void *user);

/* The object of a page of the plane: its head, what is its own, then "points", "aliases", "triangles", "stages".
 * kind: "delaunay", "voronoi", "converge". */
dyd_status dyd_html_scene_write(const dyd_output *o, FILE *out, const dyd_result *r, const char *kind,
                                dyd_html_own_fn own, const void *user);

/* ---- for pages of other surfaces ---- */

/* The opening of the object. content: the layer to be seen first. */
dyd_status dyd_html_head(FILE *out, const dyd_result *r, const char *kind, dyd_content content);
/* DYD_E_RANGE with advice where a page cannot show so many. */
dyd_status dyd_html_check_pairs(size_t pairs, const char *where, const char *advice, dyd_error *err);

#endif
