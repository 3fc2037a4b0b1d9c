/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* If ds_i(c), ds_j(c) <= M(c), the least dl_k(c) of all k, then c is a centre of ij [POS-1]. Any c will do; the bounds
 * are those of skeleton/distance_filter.h [FLT-DST]. NaN proves nothing. */
#include "possible/clique_filter.h"

#include "skeleton/rects_filter.h"

#include <math.h>

/* least: a lower bound of the least dl^2 of those visited; bound: an upper one, of all. */
typedef struct search {
  const dyd_rects *rects;
  dyd_bbox c;
  double least, bound;
} search;

static bool lower_least(void *context, uint32_t k) {
  search *m = context;
  const dyd_bbox *box = &m->rects->box[k];
  double value = dyd_dl2_lower(&m->c, box, dyd_box_slack(m->rects, k));
  m->least = isnan(value) ? -INFINITY : dyd_min(value, m->least);
  m->bound = dyd_min(dyd_dl2_upper(&m->c, box), m->bound);
  return true;
}

void dyd_filter_clique(bool *near, const dyd_rects *r, dyd_xy c, const uint32_t *vertex, size_t count) {
  search m = {r, {{c.x, c.x, c.y, c.y}}, INFINITY, INFINITY};
  dyd_tree_near(&r->tree, &m.c, &m.bound, lower_least, &m);
  for (size_t k = 0; k < count; k++)
    near[k] = dyd_ds2_upper(&m.c, &r->box[vertex[k]], dyd_box_slack(r, vertex[k])) <= m.least;
}
