/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The cover walk from both ends, in doubles.
 *
 * [COV-2] Let (i,j,k) and (i,j,l) be surely oriented, k and l on opposite sides. Then k blocks exactly a ray of the
 * curve beta = {ds_i = ds_j} and the end of it, l a ray to the other end; so if both block one point of beta, the
 * pair is impossible. That beta passes through a short segment across it is shown by ds_i < ds_j at the one end and
 * ds_j < ds_i at the other [BETA-1]; distances are bounded as in skeleton/distance_filter.h [FLT-DST], orientations as
 * in predicate/predicate_filter.h.
 *
 * Where to look needs no bound: t runs along beta, lo is the end of the rays from below met so far, hi that of the
 * rays from above. Between them somebody else blocks, or nobody, which the tree confirms. */
#include "possible/cover_filter.h"

#include "predicate/predicate_filter.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"

enum { STEPS = 10, ROUNDS = 3, MAX_RIVALS = 48 };

/* a, b: boxes of i and j; a is below b in the coordinate across, t is the other one (0: x, 1: y). rival: neighbours of
 * i and j in the skeleton, once gathered. */
typedef struct quick {
  const dyd_skeleton *sk;
  uint32_t i, j;
  const dyd_bbox *a, *b;
  int across, t;
  bool gathered;
  int rivals;
  uint32_t rival[MAX_RIVALS];
} quick;

/* About a point of beta: its coordinates and ds^2. */
typedef struct place {
  double at[2], ds2;
} place;

/* The end of a ray that somebody blocks. */
typedef struct ray {
  uint32_t v;
  double t;
} ray;

static double cover_low(const dyd_bbox *b, int axis) {
  return b->e[2 * axis];
}
static double cover_high(const dyd_bbox *b, int axis) {
  return b->e[2 * axis + 1];
}
static double cover_middle(const dyd_bbox *b, int axis) {
  return cover_low(b, axis) / 2 + cover_high(b, axis) / 2;
}
static double nearest(double c, double lo, double hi) {
  return c < lo ? lo : c > hi ? hi : c;
}
static double farthest(double c, double lo, double hi) {
  return c - lo > hi - c ? lo : hi;
}

/* The point of beta at t: dx_i^2 - dx_j^2 = dy_j^2 - dy_i^2, where the left side is a piecewise quadratic function of
 * the coordinate across. */
static place place_at(const quick *q, double t) {
  double a0 = cover_low(q->a, q->across), a1 = cover_high(q->a, q->across), b0 = cover_low(q->b, q->across),
         b1 = cover_high(q->b, q->across);
  double ta = t - nearest(t, cover_low(q->a, q->t), cover_high(q->a, q->t)),
         tb = t - nearest(t, cover_low(q->b, q->t), cover_high(q->b, q->t));
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
  place p = {.ds2 = dx * dx + ta * ta};
  p.at[q->across] = x;
  p.at[q->t] = t;
  return p;
}

static double far2(const place *p, const dyd_bbox *b) {
  double dx = p->at[0] - farthest(p->at[0], b->e[0], b->e[1]), dy = p->at[1] - farthest(p->at[1], b->e[2], b->e[3]);
  return dx * dx + dy * dy;
}

/* -1: below the line from i to j, seen along t; 1: above. */
static int side_of(const quick *q, const dyd_bbox *b) {
  double t0 = cover_middle(q->a, q->t), x0 = cover_middle(q->a, q->across);
  double jt = cover_middle(q->b, q->t) - t0, jx = cover_middle(q->b, q->across) - x0;
  double kt = cover_middle(b, q->t) - t0, kx = cover_middle(b, q->across) - x0;
  return kt * jx < jt * kx ? -1 : 1;
}

static dyd_xy nearest_point(const place *p, const dyd_bbox *b) {
  return (dyd_xy){nearest(p->at[0], b->e[0], b->e[1]), nearest(p->at[1], b->e[2], b->e[3])};
}

/* About where the ray that k blocks ends: the circle through the features that the three show, some times over. */
static double ray_end(const quick *q, const dyd_bbox *k, place p) {
  for (int round = 0; round < ROUNDS; round++) {
    dyd_xy far = {farthest(p.at[0], k->e[0], k->e[1]), farthest(p.at[1], k->e[2], k->e[3])};
    dyd_xy o = dyd_circumcentre(nearest_point(&p, q->a), nearest_point(&p, q->b), far);
    p = place_at(q, q->t ? o.y : o.x);
  }
  return p.at[q->t];
}

/* ---- who blocks a place ---- */

/* About who is nearest among the neighbours, if nearer than i and j. */
static uint32_t likely_blocker(quick *q, const place *p) {
  double least = p->ds2;
  uint32_t best = DYD_NONE;
  if (!q->gathered) {
    q->gathered = true;
    q->rivals = dyd_neighbours(q->rival, MAX_RIVALS, q->sk, q->i, q->j);
  }
  for (int k = 0; k < q->rivals; k++) {
    double d = far2(p, &q->sk->rects.box[q->rival[k]]);
    if (!(d < least)) continue;
    least = d;
    best = q->rival[k];
  }
  return best;
}

typedef struct search {
  const quick *q;
  dyd_bbox c;
  double bound;
  uint32_t found;
} search;

static bool perhaps_nearer(void *context, uint32_t k) {
  search *s = context;
  if (k == s->q->i || k == s->q->j || dyd_surely_not_nearer(&s->q->sk->rects, &s->c, k, s->bound)) return true;
  s->found = k;
  return false;
}

/* Somebody who is perhaps nearer than i or j; DYD_NONE: surely nobody, so the pair is possible [POS-1]. */
static uint32_t any_blocker(const quick *q, const place *p) {
  search s = {q, {{p->at[0], p->at[0], p->at[1], p->at[1]}}, 0, DYD_NONE};
  s.bound = dyd_pair_ds2_upper(&q->sk->rects, &s.c, q->i, q->j);
  dyd_tree_near(&q->sk->rects.tree, &s.c, &s.bound, perhaps_nearer, &s);
  return s.found;
}

/* ---- proof that there is no centre ---- */

/* Does beta surely pass between the places x -+ width across, at t? *c: the segment. */
static bool crosses(dyd_bbox *c, const quick *q, const place *p, double width) {
  dyd_bbox end[2];
  for (int k = 0; k < 2; k++) {
    double x = p->at[q->across] + (k ? width : -width);
    end[k].e[2 * q->across] = end[k].e[2 * q->across + 1] = x;
    end[k].e[2 * q->t] = end[k].e[2 * q->t + 1] = p->at[q->t];
    c->e[2 * q->across + k] = x;
    c->e[2 * q->t + k] = p->at[q->t];
  }
  double slack_a = dyd_box_slack(&q->sk->rects, q->i), slack_b = dyd_box_slack(&q->sk->rects, q->j);
  return dyd_ds2_upper(&end[0], q->a, slack_a) < dyd_ds2_lower(&end[0], q->b) &&
         dyd_ds2_upper(&end[1], q->b, slack_b) < dyd_ds2_lower(&end[1], q->a);
}

/* Do k and l surely block all of beta? */
static bool surely_cover(const quick *q, uint32_t k, uint32_t l, double t) {
  const dyd_bbox *box = q->sk->rects.box;
  place p = place_at(q, t);
  dyd_bbox c;
  double ds = sqrt(p.ds2), x = fabs(p.at[q->across]), gap = cover_low(q->b, q->across) - cover_high(q->a, q->across);
  if (!crosses(&c, q, &p, 0x1p-40 * ds * (1 + ds / gap) + 0x1p-48 * x)) return false;
  double near = dyd_max(dyd_ds2_lower(&c, q->a), dyd_ds2_lower(&c, q->b));
  if (!(dyd_dl2_upper(&c, &box[k]) < near && dyd_dl2_upper(&c, &box[l]) < near)) return false;
  dyd_sure turn = dyd_filter_orientation(q->a->e, q->b->e, box[k].e);
  return turn != DYD_UNSURE && (int)dyd_filter_orientation(q->a->e, q->b->e, box[l].e) == -(int)turn;
}

/* ---- the walk ---- */

/* k blocks the place p: its ray counts from now on. false: it tells nothing new. */
static bool take(ray end[2], const quick *q, uint32_t k, place p) {
  const dyd_bbox *b = &q->sk->rects.box[k];
  int up = side_of(q, b) > 0;
  double t = ray_end(q, b, p);
  if (!(up ? t < end[1].t : t > end[0].t)) return false;
  end[up] = (ray){k, t};
  return true;
}

/* Where to look next: between the rays; just behind a single one. */
static double next_place(const quick *q, const ray end[2]) {
  if (isfinite(end[0].t) && isfinite(end[1].t)) return end[0].t / 2 + end[1].t / 2;
  int up = isfinite(end[1].t);
  place p = place_at(q, end[up].t);
  return end[up].t + (up ? -1 : 1) * 0x1p-4 * sqrt(p.ds2);
}

static dyd_truth walk(quick *q, const uint32_t hint[2]) {
  ray end[2] = {{DYD_NONE, -INFINITY}, {DYD_NONE, INFINITY}};
  double t = cover_middle(q->a, q->t) / 2 + cover_middle(q->b, q->t) / 2;
  for (int k = 0; k < 2; k++)
    if (hint[k] != DYD_NONE) take(end, q, hint[k], place_at(q, t));
  for (int step = 0; step < STEPS; step++) {
    if (isfinite(end[0].t) || isfinite(end[1].t)) t = next_place(q, end);
    if (end[0].t > end[1].t) return surely_cover(q, end[0].v, end[1].v, t) ? DYD_FALSE : DYD_UNKNOWN;
    place p = place_at(q, t);
    if (!isfinite(p.ds2)) return DYD_UNKNOWN;
    uint32_t k = likely_blocker(q, &p);
    if (k == DYD_NONE) k = any_blocker(q, &p);
    if (k == DYD_NONE) return DYD_TRUE;
    if (!take(end, q, k, p)) return DYD_UNKNOWN;
  }
  return DYD_UNKNOWN;
}

dyd_truth dyd_filter_cover(const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t hint[2]) {
  const dyd_bbox *a = &sk->rects.box[i], *b = &sk->rects.box[j];
  quick q = {.sk = sk, .i = i, .j = j, .a = a, .b = b};
  double x = dyd_max(b->e[0] - a->e[1], a->e[0] - b->e[1]), y = dyd_max(b->e[2] - a->e[3], a->e[2] - b->e[3]);
  if (!(dyd_max(x, y) > 0)) return DYD_UNKNOWN;
  q.across = y > x;
  q.t = !q.across;
  if (cover_low(b, q.across) < cover_low(a, q.across)) {
    q.a = b;
    q.b = a;
    q.i = j;
    q.j = i;
  }
  return walk(&q, hint);
}
