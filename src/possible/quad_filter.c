/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Quad filters: the predicate layer's interval filters on outward boxes. */
#include "possible/quad_filter.h"

#include "predicate/predicate_filter.h"
#include "skeleton/rects_filter.h"

static dyd_bbox hull_box(const dyd_bbox *a, const dyd_bbox *b) {
  return (dyd_bbox){
      {dyd_min(a->e[0], b->e[0]), dyd_max(a->e[1], b->e[1]), dyd_min(a->e[2], b->e[2]), dyd_max(a->e[3], b->e[3])}};
}

bool dyd_surely_not_displaced(const dyd_skeleton *sk, uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
  const dyd_bbox *box = sk->rects.box;
  if (sk->mesh.no_filter) return false;
  dyd_bbox ij = hull_box(&box[i], &box[j]), kl = hull_box(&box[k], &box[l]);
  if (dyd_boxes_disjoint(&ij, &kl)) return true;
  dyd_sure turn = dyd_filter_orientation(box[i].e, box[j].e, box[k].e);
  if (turn == DYD_UNSURE) return false;
  return (int)dyd_filter_incircle(box[i].e, box[j].e, box[k].e, box[l].e) == -(int)turn;
}
