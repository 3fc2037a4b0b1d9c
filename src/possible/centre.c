/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Possibly nearest sites at one dyadic point, exactly.
 *
 * If ds_i(c), ds_j(c) <= M(c), the least dl_k(c) of all k, then c is a centre of ij: possible [POS-1]. Any c will do.
 */
#include "possible/centre.h"

#include "base/alloc.h"
#include "skeleton/circumcentre.h"
#include "skeleton/rects_filter.h"
#include <dyadel/predicate.h>

#include <math.h>
#include <stdlib.h>

typedef struct meeting {
  uint32_t *vertex;
  size_t count, cap, most;
  bool full; /* no memory */
} meeting;

static bool centre_meet(void *context, uint32_t k) {
  meeting *m = context;
  m->full = !dyd_reserve((void **)&m->vertex, &m->cap, m->count + 1, sizeof *m->vertex);
  if (!m->full) m->vertex[m->count++] = k;
  return !m->full && m->count <= m->most;
}

/* Everybody who may have ds <= M: not farther than dl of the vertex v. Nobody if they are too many. */
static dyd_status centre_gather(meeting *m, const dyd_skeleton *sk, const dyd_point *c, uint32_t v) {
  dyd_bbox box = dyd_point_box(c);
  double radius2 = dyd_dl2_upper(&box, &sk->rects.box[v]);
  if (isnan(radius2) || sk->mesh.no_filter) radius2 = INFINITY;
  dyd_tree_near(&sk->rects.tree, &box, &radius2, centre_meet, m);
  if (m->count > m->most) m->count = 0;
  return m->full ? DYD_E_NOMEM : DYD_OK;
}

/* Leaves those with ds <= least dl. */
static void centre_choose(meeting *m, const dyd_skeleton *sk, const dyd_point *c) {
  dyd_rect best, r;
  size_t kept = 0;
  dyd_rect_init(&best);
  dyd_rect_init(&r);
  for (size_t k = 0; k < m->count; k++) {
    dyd_rects_get(&r, &sk->rects, m->vertex[k]);
    if (k == 0 || dyd_compare_distance(c, &r, DYD_FARTHEST, &best, DYD_FARTHEST) < 0) dyd_rect_swap(&best, &r);
  }
  for (size_t k = 0; k < m->count; k++) {
    dyd_rects_get(&r, &sk->rects, m->vertex[k]);
    if (dyd_compare_distance(c, &r, DYD_CLOSEST, &best, DYD_FARTHEST) <= 0) m->vertex[kept++] = m->vertex[k];
  }
  m->count = kept;
  dyd_rect_clear(&r);
  dyd_rect_clear(&best);
}

dyd_status dyd_centre_shows(uint32_t **vertex, size_t *count, const dyd_skeleton *sk, const uint32_t v[3],
                            size_t most) {
  meeting m = {.most = most};
  dyd_point c;
  dyd_point_init(&c);
  dyd_status st = dyd_circumcentre_round(&c, sk, v) ? centre_gather(&m, sk, &c, v[0]) : DYD_OK;
  if (st == DYD_OK) centre_choose(&m, sk, &c);
  dyd_point_clear(&c);
  if (st != DYD_OK || m.count == 0) {
    free(m.vertex);
    m = (meeting){0};
  }
  *vertex = m.vertex;
  *count = m.count;
  return st;
}
