/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What all pages tell: points, pairs stage by stage, triangles; of everything, or of a window.
 *
 * Points of a page are numbered from 0; pairs and triangles are lists of differences of these numbers, which pack well:
 * of pairs (i, j), sorted, i less that of the pair before, and j - i. */
#ifndef DYD_PICTURE_HTML_SCENE_H
#define DYD_PICTURE_HTML_SCENE_H

#include "engine/history.h"
#include "io/result.h"

#define DYD_HTML_NOT_SHOWN UINT32_MAX

/* All borrowed but number and own. */
typedef struct dyd_html_scene {
  FILE *out; /* JSON */
  const dyd_result *r;
  const dyd_history *history;
  dyd_history *own; /* one stage, where there is no history */
  double window[4]; /* counts where r has a window */
  uint32_t *number; /* of sites on the page */
  size_t points;    /* on the page */
} dyd_html_scene;

/* Finds out what is shown. Errors are told in *err; dyd_html_scene_clear comes after it in any case. */
dyd_status dyd_html_scene_init(dyd_html_scene *s, FILE *out, const dyd_result *r, dyd_error *err);
void dyd_html_scene_clear(dyd_html_scene *s);
/* The opening of the object: kind of the page, and the layer to be seen first. */
dyd_status dyd_html_scene_head(const dyd_html_scene *s, const char *kind, const char *layer);
/* Its members "points", "aliases", "triangles", "stages", the last without a comma behind. */
dyd_status dyd_html_scene_body(const dyd_html_scene *s);

#endif
