/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where beta is needs no bound; who blocks it does. That beta passes through a short segment across it is shown by
 * ds_i < ds_j at the one end and ds_j < ds_i at the other [BETA-1]; distances are bounded as in
 * skeleton/distance_filter.h [FLT-DST]. The end of beta at infinity is the normal of the outer common tangent, and k is
 * beyond the tangent iff the two points where it touches and every point of k turn the same way [COV-2]; turns are
 * those of predicate/predicate_filter.h. An end of an outward box lies at most a slack outside of its rectangle; twice
 * that covers the rounding of the corner, too. */
#include "possible/beta_filter.h"

#include "predicate/predicate_filter.h"
#include "skeleton/mesh_filter.h"

enum { ROUNDS = 3 };

static double low(const dyd_bbox *b, int axis) {
  return b->e[2 * axis];
}
static double high(const dyd_bbox *b, int axis) {
  return b->e[2 * axis + 1];
}
static double nearest(double c, double lo, double hi) {
  return c < lo ? lo : c > hi ? hi : c;
}
static double farthest(double c, double lo, double hi) {
  return c - lo > hi - c ? lo : hi;
}

/* ---- the tangents at its ends ---- */

static double beta_reach(const dyd_bbox *b, int axis, int up) {
  return b->e[2 * axis + up];
}

static void set_side(dyd_bbox *out, int axis, double lo, double hi, double slack) {
  out->e[2 * axis] = lo - 2 * slack;
  out->e[2 * axis + 1] = hi + 2 * slack;
}

/* Where the tangent at that end touches: both boxes on the side `up` of axis t, at the corners that face a way in the
 * other axis that depends on which reaches farther; anywhere on that side where this is not known. */
static void start_tangent(dyd_beta *q, int up) {
  const dyd_bbox *box[2] = {q->a, q->b};
  const double slack[2] = {dyd_box_slack(q->rects, q->i), dyd_box_slack(q->rects, q->j)};
  double ta = beta_reach(q->a, q->t, up), tb = beta_reach(q->b, q->t, up), rise = (tb - ta) * (up ? 1 : -1);
  q->rise[up] = fabs(rise) > 4 * (slack[0] + slack[1]) ? (rise > 0) - (rise < 0) : 0;
  for (int k = 0; k < 2; k++) {
    double o0 = low(box[k], q->across), o1 = high(box[k], q->across), t = k ? tb : ta;
    set_side(&q->corner[up][k], q->across, q->rise[up] < 0 ? o1 : o0, q->rise[up] > 0 ? o0 : o1, slack[k]);
    set_side(&q->corner[up][k], q->t, t, t, slack[k]);
  }
}

dyd_truth dyd_beta_start(dyd_beta *q, const dyd_rects *r, uint32_t i, uint32_t j) {
  const dyd_bbox *a = &r->box[i], *b = &r->box[j];
  double x = dyd_max(b->e[0] - a->e[1], a->e[0] - b->e[1]), y = dyd_max(b->e[2] - a->e[3], a->e[2] - b->e[3]);
  if (!(dyd_max(x, y) > 0)) return dyd_surely_meet(r, i, j) ? DYD_FALSE : DYD_UNKNOWN;
  int across = y > x;
  bool swap = low(b, across) < low(a, across);
  *q = (dyd_beta){.rects = r, .i = swap ? j : i, .j = swap ? i : j, .across = across, .t = !across};
  q->a = &r->box[q->i];
  q->b = &r->box[q->j];
  for (int up = 0; up < 2; up++) start_tangent(q, up);
  return DYD_TRUE;
}

dyd_sure dyd_beta_blocks_end(const dyd_beta *q, uint32_t k, int up) {
  const dyd_bbox *box = &q->rects->box[k];
  const double *a = q->corner[up][0].e, *b = q->corner[up][1].e;
  int beyond = up == q->across ? -1 : 1; /* a is left of b, or below: the end at inf is on the left, or right, of ab */
  double slack = dyd_box_slack(q->rects, k);
  dyd_bbox least;
  int turn = (int)dyd_filter_orientation(a, b, box->e);
  if (turn) return turn == beyond ? DYD_SURE_PLUS : DYD_SURE_MINUS;
  double o = q->rise[up] > 0 ? high(box, q->across) : low(box, q->across), t = beta_reach(box, q->t, !up);
  set_side(&least, q->across, o, o, slack);
  set_side(&least, q->t, t, t, slack);
  return (int)dyd_filter_orientation(a, b, least.e) == -beyond ? DYD_SURE_MINUS : DYD_UNSURE;
}

/* ---- places ---- */

/* The point of beta at t: dx_i^2 - dx_j^2 = dy_j^2 - dy_i^2, where the left side is a piecewise quadratic function of
 * the coordinate across. */
dyd_place dyd_beta_at(const dyd_beta *q, double t) {
  double a0 = low(q->a, q->across), a1 = high(q->a, q->across), b0 = low(q->b, q->across), b1 = high(q->b, q->across);
  double ta = t - nearest(t, low(q->a, q->t), high(q->a, q->t)), tb = t - nearest(t, low(q->b, q->t), high(q->b, q->t));
  double k = tb * tb - ta * ta, gap = b0 - a1, x;
  if (fabs(k) <= gap * gap) {
    x = a1 + gap / 2 + k / (2 * gap);
  } else if (k > 0) {
    x = a1 + sqrt(k);
    if (x > b1) x = (k / (b1 - a1) + a1 + b1) / 2;
  } else {
    x = b0 - sqrt(-k);
    if (x < a0) x = (k / (b0 - a0) + a0 + b0) / 2;
  }
  double dx = x - nearest(x, a0, a1);
  dyd_place p = {.ds2 = dx * dx + ta * ta};
  p.at[q->across] = x;
  p.at[q->t] = t;
  return p;
}

double dyd_place_far2(const dyd_place *p, const dyd_bbox *b) {
  double dx = p->at[0] - farthest(p->at[0], b->e[0], b->e[1]), dy = p->at[1] - farthest(p->at[1], b->e[2], b->e[3]);
  return dx * dx + dy * dy;
}

static dyd_xy nearest_point(const dyd_place *p, const dyd_bbox *b) {
  return (dyd_xy){nearest(p->at[0], b->e[0], b->e[1]), nearest(p->at[1], b->e[2], b->e[3])};
}

/* The circle through the features that the three show, some times over. */
double dyd_beta_guess_end(const dyd_beta *q, uint32_t k, dyd_place p) {
  const dyd_bbox *b = &q->rects->box[k];
  for (int round = 0; round < ROUNDS; round++) {
    dyd_xy far = {farthest(p.at[0], b->e[0], b->e[1]), farthest(p.at[1], b->e[2], b->e[3])};
    dyd_xy o = dyd_circumcentre(nearest_point(&p, q->a), nearest_point(&p, q->b), far);
    p = dyd_beta_at(q, q->t ? o.y : o.x);
  }
  return p.at[q->t];
}

/* Does beta surely pass between the places x -+ width across, at t? *c: the segment. */
static bool crosses(dyd_bbox *c, const dyd_beta *q, const dyd_place *p, double width) {
  dyd_bbox end[2];
  for (int k = 0; k < 2; k++) {
    double x = p->at[q->across] + (k ? width : -width);
    end[k].e[2 * q->across] = end[k].e[2 * q->across + 1] = x;
    end[k].e[2 * q->t] = end[k].e[2 * q->t + 1] = p->at[q->t];
    c->e[2 * q->across + k] = x;
    c->e[2 * q->t + k] = p->at[q->t];
  }
  return dyd_ds2_upper(&end[0], q->a, dyd_box_slack(q->rects, q->i)) < dyd_ds2_lower(&end[0], q->b) &&
         dyd_ds2_upper(&end[1], q->b, dyd_box_slack(q->rects, q->j)) < dyd_ds2_lower(&end[1], q->a);
}

bool dyd_beta_surely_blocked(const dyd_beta *q, const uint32_t *k, int count, double t) {
  dyd_place p = dyd_beta_at(q, t);
  dyd_bbox c;
  double ds = sqrt(p.ds2), x = fabs(p.at[q->across]), gap = low(q->b, q->across) - high(q->a, q->across);
  if (!crosses(&c, q, &p, 0x1p-40 * ds * (1 + ds / gap) + 0x1p-48 * x)) return false;
  double near = dyd_max(dyd_ds2_lower(&c, q->a), dyd_ds2_lower(&c, q->b));
  for (int m = 0; m < count; m++)
    if (!(dyd_dl2_upper(&c, &q->rects->box[k[m]]) < near)) return false;
  return true;
}
