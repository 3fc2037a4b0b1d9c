/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Notes on what is read: radii that are large for the spacing of the points, points that coincide.
 *
 * Rectangles that meet can be chosen as points arbitrarily near to each other, so their pair is possible: going over
 * the possible pairs finds all of them. */
#include "cli.h"
#include <stdlib.h>

static bool note_is_wide(const double b[4]) {
  return b[1] > b[0] || b[3] > b[2];
}

/* Counts rectangles (points are none), and those among them that meet another site. false: memory is exhausted. */
static bool count_meetings(size_t *rectangles, size_t *meeting, const dyd_delaunay *pd) {
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  size_t n = dyd_sites_count(sites);
  bool *meets = calloc(n ? n : 1, sizeof *meets);
  dyd_pair_list pairs = {0};
  bool good = meets && dyd_delaunay_pairs(&pairs, pd) == DYD_OK;
  for (size_t k = 0; k < pairs.count; k++) {
    double a[4], b[4];
    dyd_sites_get_d(a, sites, pairs.item[k].i);
    dyd_sites_get_d(b, sites, pairs.item[k].j);
    if (a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3])
      meets[pairs.item[k].i] = meets[pairs.item[k].j] = true;
  }
  *rectangles = *meeting = 0;
  for (size_t i = 0; good && i < n; i++) {
    double b[4];
    dyd_sites_get_d(b, sites, i);
    *rectangles += note_is_wide(b);
    *meeting += note_is_wide(b) && meets[i];
  }
  dyd_pair_list_clear(&pairs);
  free(meets);
  return good;
}

void cli_note_spacing(const dyd_delaunay *pd, const cli_options *o) {
  size_t rectangles, meeting;
  if (!pd || o->quiet || (!o->read.radius && !o->read.radius_columns)) return;
  if (!count_meetings(&rectangles, &meeting, pd) || 2 * meeting <= rectangles) return;
  cli_note(o,
           "the radius is large for the spacing of the points: %zu of %zu rectangles meet another one, so that few "
           "edges can be sure; a smaller radius decides more",
           meeting, rectangles);
}

void cli_note_aliases(const dyd_delaunay *pd, const cli_options *o) {
  bool of_points = o->content == DYD_CONTENT_DELAUNAY || o->content == DYD_CONTENT_VORONOI ||
                   o->content == DYD_CONTENT_GRAPH_NEAREST || o->content == DYD_CONTENT_GRAPH_GABRIEL ||
                   o->content == DYD_CONTENT_GRAPH_MST;
  size_t aliases = 0, n = pd ? dyd_sites_count(dyd_delaunay_sites(pd)) : 0;
  if (!of_points || (o->format != DYD_FORMAT_WKT && o->format != DYD_FORMAT_GEOJSON)) return;
  for (size_t i = 0; i < n; i++) aliases += dyd_delaunay_alias(pd, (uint32_t)i) != i;
  if (aliases)
    cli_note(o, "%zu points coincide with earlier ones and have no row of their own (list them: --layer aliases)",
             aliases);
}
