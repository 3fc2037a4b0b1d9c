/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The cover walk from the middle to both ends, in doubles.
 *
 * [COV-2] What k blocks of beta = {ds_i = ds_j} is connected if k does not block one of its ends strictly. So a chain
 * of such k, the first of which blocks the end at -inf, the last the end at inf, and each of which blocks a point of
 * beta together with the next one, covers beta: the pair is impossible. A centre to which no other vertex is nearer
 * shows that it is possible [POS-1].
 *
 * Where to look needs no bound: from the blocker of one place go to where its part of beta seems to end. Just behind
 * another vertex blocks, or none does, which the tree confirms. */
#include "possible/cover.h"

#include "base/float_filter.h"
#include "predicate/predicate_filter.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"
#include "skeleton/skeleton.h"

#include <math.h>

/* ---- beta in doubles: about where it is, and which vertex certainly blocks a place or an end of it ---- */

/* a, b: the boxes of i and j; a is below b in the coordinate across, t runs along beta (0: x, 1: y). corner[up]: where
 * the outer common tangent at that end touches a and b, enclosed; rise[up] > 0: b reaches farther than a, < 0: a does,
 * 0: not known. Boxes are borrowed. */
typedef struct dyd_beta {
  const dyd_rects *rects;
  uint32_t i, j;
  const dyd_bbox *a, *b;
  int across, t;
  dyd_bbox corner[2][2];
  int rise[2];
} dyd_beta;

/* About a point of beta: its coordinates and ds^2. */
typedef struct beta_point {
  double at[2], ds2;
} beta_point;

/* The place of beta needs no bound; its blockers do. That beta passes through a short segment across it is shown by
 * ds_i < ds_j at the one end and ds_j < ds_i at the other [BETA-1]; distances are bounded as in
 * skeleton/rects_filter.h [FLT-DST]. The end of beta at infinity is the normal of the outer common tangent, and k is
 * beyond the tangent iff the two points where it touches and every point of k turn the same way [COV-2]; turns are
 * those of predicate/predicate_filter.h. An end of an outward box lies at most a slack outside of its rectangle; twice
 * that covers the rounding of the corner, too. */

enum { ROUNDS = 3 };

static double low(const dyd_bbox *b, int axis) {
  return b->e[2 * axis];
}

static double high(const dyd_bbox *b, int axis) {
  return b->e[2 * axis + 1];
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

/* TRUE: the boxes of i and j certainly do not meet, and *q is filled in. FALSE: the rectangles certainly meet. */
static dyd_truth beta_start(dyd_beta *q, const dyd_rects *r, uint32_t i, uint32_t j) {
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

/* DYD_SURE_PLUS: k certainly blocks the end of beta at -inf (up = 0) or inf (1); DYD_SURE_MINUS: some point of its
 * rectangle is certainly strictly within the tangent there, so that k blocks no place near that end; DYD_UNSURE: not
 * known. */
static dyd_sure beta_blocks_end(const dyd_beta *q, uint32_t k, int up) {
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

/* About the point of beta at t: dx_i^2 - dx_j^2 = dy_j^2 - dy_i^2, where the left side is a piecewise quadratic
 * function of the coordinate across. */
static beta_point beta_at(const dyd_beta *q, double t) {
  double a0 = low(q->a, q->across), a1 = high(q->a, q->across), b0 = low(q->b, q->across), b1 = high(q->b, q->across);
  double ta = t - dyd_nearest_in(t, low(q->a, q->t), high(q->a, q->t)),
         tb = t - dyd_nearest_in(t, low(q->b, q->t), high(q->b, q->t));
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
  double dx = x - dyd_nearest_in(x, a0, a1);
  beta_point p = {.ds2 = dx * dx + ta * ta};
  p.at[q->across] = x;
  p.at[q->t] = t;
  return p;
}

/* About dl^2 of the box at the place. */
static double place_far2(const beta_point *p, const dyd_bbox *b) {
  double dx = p->at[0] - dyd_farther_end(p->at[0], b->e[0], b->e[1]),
         dy = p->at[1] - dyd_farther_end(p->at[1], b->e[2], b->e[3]);
  return dx * dx + dy * dy;
}

static dyd_xy nearest_point(const beta_point *p, const dyd_bbox *b) {
  return (dyd_xy){dyd_nearest_in(p->at[0], b->e[0], b->e[1]), dyd_nearest_in(p->at[1], b->e[2], b->e[3])};
}

/* About where the part of beta that k blocks ends, seen from a place in it or nearby. The circle through the features
 * that the three show, some times over. */
static double beta_guess_end(const dyd_beta *q, uint32_t k, beta_point p) {
  const dyd_bbox *b = &q->rects->box[k];
  for (int round = 0; round < ROUNDS; round++) {
    dyd_xy far = {dyd_farther_end(p.at[0], b->e[0], b->e[1]), dyd_farther_end(p.at[1], b->e[2], b->e[3])};
    dyd_xy o = dyd_circumcentre(nearest_point(&p, q->a), nearest_point(&p, q->b), far);
    p = beta_at(q, q->t ? o.y : o.x);
  }
  return p.at[q->t];
}

/* Returns true if beta certainly passes between the places x -+ width across, at t. *c: the segment. */
static bool crosses(dyd_bbox *c, const dyd_beta *q, const beta_point *p, double width) {
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

/* Returns true if all of k[0..count-1] certainly block one and the same point of beta, which is about at t. */
static bool beta_surely_blocked(const dyd_beta *q, const uint32_t *k, int count, double t) {
  beta_point p = beta_at(q, t);
  dyd_bbox c;
  double ds = sqrt(p.ds2), x = fabs(p.at[q->across]), gap = low(q->b, q->across) - high(q->a, q->across);
  if (!crosses(&c, q, &p, 0x1p-40 * ds * (1 + ds / gap) + 0x1p-48 * x)) return false;
  double near = dyd_max(dyd_ds2_lower(&c, q->a), dyd_ds2_lower(&c, q->b));
  for (int m = 0; m < count; m++)
    if (!(dyd_dl2_upper(&c, &q->rects->box[k[m]]) < near)) return false;
  return true;
}

/* MOST_LINKS: of a chain, to each side. BISECTIONS, DOUBLINGS: steps of a search for an end. */
enum { MOST_LINKS = 48, MAX_RIVALS = 48, BISECTIONS = 40, DOUBLINGS = 40, JOINTS = 5 };

/* Ends are found up to this fraction of the distance; chains are joined, and continue, within it. */
#define BESIDE 0x1p-22

/* rival: neighbours of i and j in the skeleton, once gathered. */
typedef struct cover_trial {
  const dyd_skeleton *sk;
  dyd_beta beta;
  const uint32_t *hint;
  bool gathered;
  int rivals;
  uint32_t rival[MAX_RIVALS];
} cover_trial;

/* ---- blockers of a place ---- */

static bool seems_blocked(const cover_trial *q, uint32_t k, double t) {
  beta_point p = beta_at(&q->beta, t);
  return place_far2(&p, &q->sk->rects.box[k]) < p.ds2;
}

/* The vertex that is about nearest among hints and neighbours, if nearer than i and j. */
static uint32_t likely_blocker(cover_trial *q, const beta_point *p) {
  double least = p->ds2;
  uint32_t best = DYD_NONE;
  if (!q->gathered) {
    q->gathered = true;
    q->rivals = dyd_neighbours(q->rival, MAX_RIVALS, q->sk, q->beta.i, q->beta.j);
  }
  for (int k = 0; k < q->rivals + 2; k++) {
    uint32_t v = k < 2 ? q->hint[k] : q->rival[k - 2];
    double d = v == DYD_NONE ? INFINITY : place_far2(p, &q->sk->rects.box[v]);
    if (!(d < least)) continue;
    least = d;
    best = v;
  }
  return best;
}

typedef struct cover_search {
  const cover_trial *q;
  dyd_bbox c;
  double bound;
  uint32_t found;
} cover_search;

static bool perhaps_nearer(void *context, uint32_t k) {
  cover_search *s = context;
  const dyd_beta *b = &s->q->beta;
  if (k == b->i || k == b->j || dyd_surely_not_nearer(&s->q->sk->rects, &s->c, k, s->bound)) return true;
  s->found = k;
  return false;
}

/* A vertex that is perhaps nearer than i or j; DYD_NONE: certainly none, so the pair is possible [POS-1]. */
static uint32_t any_blocker(const cover_trial *q, const beta_point *p) {
  cover_search s = {q, {{p->at[0], p->at[0], p->at[1], p->at[1]}}, 0, DYD_NONE};
  s.bound = dyd_pair_ds2_upper(&q->sk->rects, &s.c, q->beta.i, q->beta.j);
  dyd_tree_near(&q->sk->rects.tree, &s.c, &s.bound, perhaps_nearer, &s);
  return s.found;
}

static uint32_t blocker_at(cover_trial *q, const beta_point *p) {
  uint32_t k = likely_blocker(q, p);
  return k == DYD_NONE ? any_blocker(q, p) : k;
}

/* ---- the chain ---- */

/* Returns true if the part that k blocks is certainly connected. */
static bool is_link(const cover_trial *q, uint32_t k) {
  return beta_blocks_end(&q->beta, k, 0) == DYD_SURE_MINUS || beta_blocks_end(&q->beta, k, 1) == DYD_SURE_MINUS;
}

static bool is_last_link(const cover_trial *q, uint32_t k, int up) {
  return beta_blocks_end(&q->beta, k, up) == DYD_SURE_PLUS && beta_blocks_end(&q->beta, k, !up) == DYD_SURE_MINUS;
}

/* About where the part that k blocks ends, from the blocked place t on; beside: how far from it to look. NaN: not
 * found. */
static double find_end(double *beside, const cover_trial *q, uint32_t k, double t, int up) {
  beta_point p = beta_at(&q->beta, t);
  double way = up ? 1 : -1, guess = beta_guess_end(&q->beta, k, p), step = 0x1p-4 * sqrt(p.ds2), from = 0, to;
  int tries = 0;
  *beside = BESIDE * sqrt(beta_at(&q->beta, guess).ds2);
  if ((guess - t) * way > 0 && seems_blocked(q, k, guess - way * *beside) &&
      !seems_blocked(q, k, guess + way * *beside))
    return guess;
  for (to = step; seems_blocked(q, k, t + way * to); to *= 2) {
    if (tries++ == DOUBLINGS) return NAN;
    from = to;
  }
  for (tries = 0; tries < BISECTIONS && to - from > BESIDE / 4 * step; tries++) {
    double middle = from + (to - from) / 2;
    *(seems_blocked(q, k, t + way * middle) ? &from : &to) = middle;
  }
  *beside = BESIDE * sqrt(beta_at(&q->beta, t + way * from).ds2);
  return t + way * from;
}

/* Returns true if k and next certainly block one place of beta, a little before what k blocks ends. */
static bool are_joined(const cover_trial *q, uint32_t k, uint32_t next, double end, double beside) {
  const uint32_t both[2] = {k, next};
  for (int tries = 0; tries < JOINTS; tries++, beside *= 0x1p5)
    if (beta_surely_blocked(&q->beta, both, 2, end - beside)) return true;
  return false;
}

/* From the blocked place t towards an end. FALSE: all is blocked there; TRUE: *centre has been found. */
static dyd_truth extend(beta_point *centre, cover_trial *q, uint32_t k, double t, int up) {
  double way = up ? 1 : -1, beside;
  for (int link = 0; link < MOST_LINKS; link++) {
    if (is_last_link(q, k, up)) return DYD_FALSE;
    double end = find_end(&beside, q, k, t, up);
    t = end + way * beside;
    *centre = beta_at(&q->beta, t);
    if (!isfinite(centre->ds2)) return DYD_UNKNOWN;
    uint32_t next = blocker_at(q, centre);
    if (next == DYD_NONE) return DYD_TRUE;
    if (next == k || !is_link(q, next) || !are_joined(q, k, next, end, way * beside)) return DYD_UNKNOWN;
    k = next;
  }
  return DYD_UNKNOWN;
}

/* Between the ends of what the hints block, or about in the middle. */
static double first_place(const cover_trial *q) {
  const dyd_beta *b = &q->beta;
  double t = b->a->e[2 * b->t] / 4 + b->a->e[2 * b->t + 1] / 4 + b->b->e[2 * b->t] / 4 + b->b->e[2 * b->t + 1] / 4;
  beta_point middle = beta_at(b, t);
  if (q->hint[0] == DYD_NONE || q->hint[1] == DYD_NONE) return t;
  double between = beta_guess_end(b, q->hint[0], middle) / 2 + beta_guess_end(b, q->hint[1], middle) / 2;
  return isfinite(between) ? between : t;
}

/* Returns true if the two hints block everything. */
static bool hints_cover(const cover_trial *q, double t) {
  const uint32_t *k = q->hint;
  if (k[0] == DYD_NONE || k[1] == DYD_NONE || !beta_surely_blocked(&q->beta, k, 2, t)) return false;
  return (is_last_link(q, k[0], 0) && is_last_link(q, k[1], 1)) ||
         (is_last_link(q, k[0], 1) && is_last_link(q, k[1], 0));
}

static dyd_truth walk_both_ways(beta_point *centre, cover_trial *q) {
  double t = first_place(q);
  if (hints_cover(q, t)) return DYD_FALSE;
  *centre = beta_at(&q->beta, t);
  if (!isfinite(centre->ds2)) return DYD_UNKNOWN;
  uint32_t k = blocker_at(q, centre);
  if (k == DYD_NONE) return DYD_TRUE;
  dyd_truth sure = is_link(q, k) && beta_surely_blocked(&q->beta, &k, 1, t) ? DYD_FALSE : DYD_UNKNOWN;
  for (int up = 0; up < 2; up++) {
    dyd_truth side = extend(centre, q, k, t, up);
    if (side == DYD_TRUE) return side;
    if (side == DYD_UNKNOWN) sure = side;
  }
  return sure;
}

/* Of what both share, or of the gap between them. */
static dyd_xy cover_middle(const dyd_bbox *a, const dyd_bbox *b) {
  return (dyd_xy){dyd_max(a->e[0], b->e[0]) / 2 + dyd_min(a->e[1], b->e[1]) / 2,
                  dyd_max(a->e[2], b->e[2]) / 2 + dyd_min(a->e[3], b->e[3]) / 2};
}

dyd_truth dyd_filter_cover(dyd_xy *centre, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t hint[2]) {
  cover_trial q = {.sk = sk, .hint = hint};
  dyd_truth apart = beta_start(&q.beta, &sk->rects, i, j), truth = apart == DYD_FALSE ? DYD_TRUE : DYD_UNKNOWN;
  beta_point p;
  *centre = cover_middle(&sk->rects.box[i], &sk->rects.box[j]);
  if (apart != DYD_TRUE) return truth;
  truth = walk_both_ways(&p, &q);
  if (truth == DYD_TRUE) *centre = (dyd_xy){p.at[0], p.at[1]};
  return truth;
}
