/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cutting planes in doubles, as in witness.c, with distances bounded as in skeleton/rects_filter.h.
 *
 * A witness is reported only if ds_k^2 from below exceeds dl_i^2 and dl_j^2 from above for every k that the tree names.
 *
 * "None" is reported only if three of the half-planes have no common point, in intervals [WIT-FLT]: the linear program
 * proposes three, and their points are enclosed anew. With a_k = p_k - q_k, p_k in R_i or R_j and q_k in another
 * rectangle, a witness x has a_k.(2 x - p_k - q_k) > 0 [WIT-1]. If l_k > 0 and sum l_k a_k = 0, then a witness implies
 * sum l_k a_k.(p_k + q_k) < 0. The l_k are the cross products of the other two a_k. */
#include "legal/witness_filter.h"

#include "base/float_filter.h"
#include "legal/lp_filter.h"
#include "predicate/interval_filter.h"
#include "skeleton/rects_filter.h"

#include <math.h>

enum { STEPS = 24, MAX_RIVALS = 12, MAX_NEIGHBOURS = 48 };

/* The two points of a half-plane, enclosed: p of R_i or R_j, q of the other rectangle. */
typedef struct cut_points {
  dyd_iv p[2], q[2];
} cut_points;

/* Invariant: from[k] has the points of cut[k], for k < cuts. */
typedef struct witness_trial {
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
  cut_points *from;
  size_t cuts;
  double size; /* of the coordinates met */
} witness_trial;

/* Keeps the nearest ones; a site farther than all of them is not tested any more. */
static bool witness_keep_rival(void *context, uint32_t k) {
  witness_trial *q = context;
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

static void witness_evaluate_d(witness_trial *q, dyd_xy c) {
  q->c = (dyd_bbox){{c.x, c.x, c.y, c.y}};
  q->bound = dyd_max(dyd_dl2_upper(&q->c, &q->rects->box[q->i]), dyd_dl2_upper(&q->c, &q->rects->box[q->j]));
  q->reach = q->bound;
  q->rivals = 0;
  for (int k = 0; k < q->neighbours; k++)
    if (!(dyd_ds2_lower(&q->c, &q->rects->box[q->neighbour[k]]) > q->reach)) witness_keep_rival(q, q->neighbour[k]);
  if (q->rivals) return;
  dyd_tree_near(&q->rects->tree, &q->c, &q->reach, witness_keep_rival, q);
}

/* The lower or upper end of a rectangle on one axis, at most `slack` inside of its box. */
static dyd_iv witness_end(double lo, double hi, bool upper, double slack) {
  if (slack == 0) return dyd_iv_point(upper ? hi : lo);
  return upper ? (dyd_iv){dyd_max(lo, dyd_down(hi - slack)), hi} : (dyd_iv){lo, dyd_min(hi, dyd_up(lo + slack))};
}

/* The point of a rectangle that is nearest to c, on one axis: between the ends it is c. */
static dyd_iv witness_nearest_point(double c, double lo, double hi, double slack) {
  dyd_iv low = witness_end(lo, hi, false, slack), high = witness_end(lo, hi, true, slack);
  return (dyd_iv){dyd_min(dyd_max(c, low.lo), high.lo), dyd_max(dyd_min(c, high.hi), low.hi)};
}

/* The half-plane nearer to the far corner of rectangle `own` than to the nearest point of `other`, relative to c;
 * false: they touch. */
static bool witness_add_cut(witness_trial *q, dyd_xy c, uint32_t own, uint32_t other) {
  const double *a = q->rects->box[own].e, *b = q->rects->box[other].e, at[2] = {c.x, c.y};
  double n[2], middle[2], slack[2] = {dyd_box_slack(q->rects, own), dyd_box_slack(q->rects, other)};
  if (q->cuts == DYD_LP_CUTS) return true;
  cut_points *from = &q->from[q->cuts];
  for (int k = 0; k < 2; k++) {
    double lo = a[2 * k], hi = a[2 * k + 1];
    double s = dyd_farther_end(at[k], lo, hi), t = dyd_nearest_in(at[k], b[2 * k], b[2 * k + 1]);
    from->p[k] = witness_end(lo, hi, s == hi, slack[0]);
    from->q[k] = witness_nearest_point(at[k], b[2 * k], b[2 * k + 1], slack[1]);
    n[k] = s - t;
    middle[k] = (s + t) / 2;
    q->size = dyd_max(q->size, dyd_max(fabs(s), fabs(at[k])));
  }
  double length = hypot(n[0], n[1]);
  if (!(length > 0)) return false;
  dyd_cut *cut = &q->cut[q->cuts++];
  *cut = (dyd_cut){n[0] / length, n[1] / length, 0};
  cut->d = cut->nx * (c.x - middle[0]) + cut->ny * (c.y - middle[1]);
  return true;
}

static bool witness_add_cuts(witness_trial *q, dyd_xy c) {
  for (int k = 0; k < q->rivals; k++)
    if (!witness_add_cut(q, c, q->i, q->rival[k]) || !witness_add_cut(q, c, q->j, q->rival[k])) return false;
  return true;
}

static dyd_iv witness_cross(const dyd_iv u[2], const dyd_iv v[2]) {
  return dyd_iv_sub(dyd_iv_mul(u[0], v[1]), dyd_iv_mul(u[1], v[0]));
}

/* a = p - q, and a.(p + q - 2 c). */
static dyd_iv witness_offset(dyd_iv a[2], const cut_points *f, const double c[2]) {
  dyd_iv along[2];
  for (int k = 0; k < 2; k++) {
    dyd_iv at = dyd_iv_point(c[k]);
    a[k] = dyd_iv_sub(f->p[k], f->q[k]);
    along[k] = dyd_iv_mul(a[k], dyd_iv_add(dyd_iv_sub(f->p[k], at), dyd_iv_sub(f->q[k], at)));
  }
  return dyd_iv_add(along[0], along[1]);
}

/* Returns true if the three half-planes certainly have no common point [WIT-FLT]. */
static bool witness_is_excluded_d(const witness_trial *q, dyd_xy c, const int three[3]) {
  const double at[2] = {c.x, c.y};
  dyd_iv a[3][2], offset[3], sum = dyd_iv_point(0);
  for (int k = 0; k < 3; k++) offset[k] = witness_offset(a[k], &q->from[three[k]], at);
  int sign = 0;
  for (int k = 0; k < 3; k++) {
    dyd_iv l = witness_cross(a[(k + 1) % 3], a[(k + 2) % 3]);
    int s = dyd_iv_sign(l);
    if (s == 0 || (sign != 0 && s != sign)) return false;
    sign = s;
    sum = dyd_iv_add(sum, dyd_iv_mul(l, offset[k]));
  }
  return dyd_iv_sign(sum) == sign;
}

/* Sets the next centre and returns TRUE; FALSE if certainly no witness exists; UNKNOWN if doubles are too coarse. */
static dyd_truth witness_move(witness_trial *q, dyd_xy *c) {
  double scale = 0, noise = q->size * 0x1p-46;
  for (size_t k = 0; k < q->cuts; k++) scale = dyd_max(scale, fabs(q->cut[k].d));
  dyd_lp_result r = {0};
  for (double bound = 8; bound <= 0x1p24; bound *= 128) {
    r = dyd_lp_centre(q->cut, q->cuts, bound * scale);
    if (r.z > 0 || r.bounded) break;
  }
  if (r.bounded && r.z < 0 && witness_is_excluded_d(q, *c, r.basis)) return DYD_FALSE;
  if (!(r.z > noise) || !isfinite(r.x) || !isfinite(r.y)) return DYD_UNKNOWN;
  dyd_xy next = {c->x + r.x, c->y + r.y};
  double dx = next.x - c->x, dy = next.y - c->y;
  for (size_t k = 0; k < q->cuts; k++) q->cut[k].d += q->cut[k].nx * dx + q->cut[k].ny * dy;
  *c = next;
  return DYD_TRUE;
}

dyd_truth dyd_filter_witness(dyd_xy *c, const dyd_rects *rects, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  cut_points from[DYD_LP_CUTS];
  witness_trial q = {.rects = rects, .i = i, .j = j, .from = from};
  if (!isfinite(c->x) || !isfinite(c->y)) return DYD_UNKNOWN;
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
