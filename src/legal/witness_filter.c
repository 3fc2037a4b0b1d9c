/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cutting planes in doubles, as in witness.c, with distances bounded as in skeleton/distance_filter.h.
 *
 * A witness is stated only when ds_k^2 from below exceeds dl_i^2, dl_j^2 from above for everybody the tree names.
 * "None" is no statement about points (the pair just stays undecided), so the half-planes need no proved bound; still
 * they are trusted only when their common disc is empty by far more than their rounding errors. */
#include "legal/witness_filter.h"

#include "legal/lp_filter.h"
#include "predicate/interval_filter.h"
#include "skeleton/rects_filter.h"

#include <math.h>

enum { STEPS = 24, MAX_RIVALS = 12, MAX_NEIGHBOURS = 48 };
/* Half-planes known up to this part of the distances are good enough for an "empty" by 1e-9 of them. */
#define COARSE 0x1p-36

typedef struct quick {
  const dyd_rects *rects;
  uint32_t i, j;
  dyd_bbox c;
  double bound, reach; /* squared radius of the pair; within which rivals are looked for */
  uint32_t rival[MAX_RIVALS];
  double distance[MAX_RIVALS];
  int rivals;
  uint32_t neighbour[MAX_NEIGHBOURS]; /* of i and j in the skeleton: asked before all others */
  int neighbours;
  dyd_cut cut[DYD_LP_CUTS];
  size_t cuts;
  double size;  /* of the coordinates met */
  double slack; /* by how much boxes of the pair are wider than their rectangles */
  bool coarse;  /* some half-plane depends on that */
} quick;

/* Keeps the nearest ones; who is farther than all of them is not asked any more. */
static bool witness_keep_rival(void *context, uint32_t k) {
  quick *q = context;
  if (k == q->i || k == q->j) return true;
  double d = dyd_ds2_lower(&q->c, &q->rects->box[k]);
  int at = q->rivals < MAX_RIVALS ? q->rivals++ : MAX_RIVALS;
  for (; at > 0 && q->distance[at - 1] > d; at--)
    if (at < MAX_RIVALS) {
      q->distance[at] = q->distance[at - 1];
      q->rival[at] = q->rival[at - 1];
    }
  if (at < MAX_RIVALS) {
    q->distance[at] = d;
    q->rival[at] = k;
  }
  if (q->rivals == MAX_RIVALS) q->reach = dyd_min(q->reach, q->distance[MAX_RIVALS - 1]);
  return true;
}

static void witness_evaluate_d(quick *q, dyd_xy c) {
  q->c = (dyd_bbox){{c.x, c.x, c.y, c.y}};
  q->bound = dyd_max(dyd_dl2_upper(&q->c, &q->rects->box[q->i]), dyd_dl2_upper(&q->c, &q->rects->box[q->j]));
  q->reach = q->bound;
  q->rivals = 0;
  for (int k = 0; k < q->neighbours; k++)
    if (!(dyd_ds2_lower(&q->c, &q->rects->box[q->neighbour[k]]) > q->reach)) witness_keep_rival(q, q->neighbour[k]);
  if (q->rivals) return;
  dyd_tree_near(&q->rects->tree, &q->c, &q->reach, witness_keep_rival, q);
}

static double witness_farther_end(double c, double lo, double hi) {
  return c - lo > hi - c ? lo : hi;
}
static double witness_nearest_d(double c, double lo, double hi) {
  return c < lo ? lo : c > hi ? hi : c;
}

/* The half-plane nearer to the far corner of `own` than to the nearest point of `other`, relative to c; false: they
 * touch. */
static bool witness_add_cut(quick *q, dyd_xy c, const dyd_bbox *own, const dyd_bbox *other, double slack) {
  double sx = witness_farther_end(c.x, own->e[0], own->e[1]), sy = witness_farther_end(c.y, own->e[2], own->e[3]);
  double qx = witness_nearest_d(c.x, other->e[0], other->e[1]), qy = witness_nearest_d(c.y, other->e[2], other->e[3]);
  double ax = sx - qx, ay = sy - qy, length = hypot(ax, ay);
  if (!(length > 0)) return false;
  if (slack > length * COARSE) q->coarse = true;
  if (q->cuts == DYD_LP_CUTS) return true;
  dyd_cut *k = &q->cut[q->cuts++];
  k->nx = ax / length;
  k->ny = ay / length;
  k->d = k->nx * (c.x - (sx + qx) / 2) + k->ny * (c.y - (sy + qy) / 2);
  q->size = dyd_max(q->size, dyd_max(dyd_max(fabs(sx), fabs(sy)), dyd_max(fabs(c.x), fabs(c.y))));
  return true;
}

static bool witness_add_cuts(quick *q, dyd_xy c) {
  for (int k = 0; k < q->rivals; k++) {
    const dyd_bbox *other = &q->rects->box[q->rival[k]];
    double slack = dyd_max(q->slack, dyd_box_slack(q->rects, q->rival[k]));
    if (!witness_add_cut(q, c, &q->rects->box[q->i], other, slack) ||
        !witness_add_cut(q, c, &q->rects->box[q->j], other, slack))
      return false;
  }
  return true;
}

/* The next centre: TRUE; FALSE: no room; UNKNOWN: too close to tell in doubles. */
static dyd_truth witness_move(quick *q, dyd_xy *c) {
  double scale = 0, noise = q->size * 0x1p-46;
  for (size_t k = 0; k < q->cuts; k++) scale = dyd_max(scale, fabs(q->cut[k].d));
  dyd_lp_result r = {0};
  for (double bound = 8; bound <= 0x1p24; bound *= 128) {
    r = dyd_lp_centre(q->cut, q->cuts, bound * scale);
    if (r.z > 0 || r.bounded) break;
  }
  if (r.bounded && r.z < -1e-9 * r.active - noise) return q->coarse ? DYD_UNKNOWN : DYD_FALSE;
  if (!(r.z > noise) || !isfinite(r.x) || !isfinite(r.y)) return DYD_UNKNOWN;
  dyd_xy next = {c->x + r.x, c->y + r.y};
  double dx = next.x - c->x, dy = next.y - c->y;
  for (size_t k = 0; k < q->cuts; k++) q->cut[k].d += q->cut[k].nx * dx + q->cut[k].ny * dy;
  *c = next;
  return DYD_TRUE;
}

dyd_truth dyd_filter_witness(dyd_xy *c, const dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  quick q = {.rects = w->rects, .i = i, .j = j};
  if (!isfinite(c->x) || !isfinite(c->y)) return DYD_UNKNOWN;
  q.slack = dyd_max(dyd_box_slack(q.rects, i), dyd_box_slack(q.rects, j));
  q.neighbours = dyd_neighbours(q.neighbour, MAX_NEIGHBOURS, sk, i, j);
  for (int step = 0; step < STEPS; step++) {
    witness_evaluate_d(&q, *c);
    if (!isfinite(q.bound)) return DYD_UNKNOWN;
    if (q.rivals == 0) return DYD_TRUE;
    if (!witness_add_cuts(&q, *c)) return DYD_UNKNOWN;
    dyd_truth moved = witness_move(&q, c);
    if (moved != DYD_TRUE) return moved;
  }
  return DYD_UNKNOWN;
}

/* ---- farther ---- */

/* A lower bound of (q - c)^2 - (p - c)^2 = (q - p) (q + p - 2 c) over p in [s0,s1] and q in [k0,k1]: in p it is
 * concave, in q it is least at the place nearest to c. NaN where it is not known. */
static double farther_along(dyd_iv c, double s0, double s1, double k0, double k1) {
  dyd_iv q = {dyd_max(k0, dyd_min(c.lo, k1)), dyd_min(k1, dyd_max(c.hi, k0))}, twice = {2 * c.lo, 2 * c.hi};
  double low[2];
  for (int end = 0; end < 2; end++) {
    dyd_iv p = dyd_iv_point(end ? s1 : s0);
    low[end] = dyd_iv_mul(dyd_iv_sub(q, p), dyd_iv_sub(dyd_iv_add(q, p), twice)).lo;
  }
  return low[0] < low[1] ? low[0] : low[1] <= low[0] ? low[1] : NAN;
}

bool dyd_filter_is_farther(const dyd_bbox *c, const dyd_bbox *s, const dyd_bbox *k) {
  const double *a = c->e, *p = s->e, *q = k->e;
  double x = farther_along((dyd_iv){a[0], a[1]}, p[0], p[1], q[0], q[1]);
  double y = farther_along((dyd_iv){a[2], a[3]}, p[2], p[3], q[2], q[3]);
  return dyd_down(x + y) > 0;
}
