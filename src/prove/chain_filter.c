/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Looks for a chain that proves a pair illegal ([CERT-4]).
 *
 * Doubles follow the curve of the centres with ds_i = ds_j from one end to the other: from a blocker's interval to the
 * next one that overlaps it, with a point in each overlap. Rounding errors only make the search fail: a chain found is
 * shortened and kept if the exact checker takes it. */
#include "prove/proof.h"

#include "base/float_filter.h"
#include "base/local.h"
#include "skeleton/reps.h"
#include <math.h>

#define STEPS 16  /* bisections along the curve */
#define ACROSS 24 /* steps across it */
#define TURNS 36  /* bisections of an angle */
#define CANDIDATES 6
#define MOST_POINTS 64

/* A point of the curve, or an end of it (a direction): what blocks it is nearer (or farther out) than `own`; distances
 * are squared. */
typedef struct curve_point {
  bool end;
  dyd_xy at;
  double own;
} curve_point;

/* The curve: the point number t in (-1,1) lies beside m, t / (1 - t^2) along n, and then moved along d. Lengths are in
 * units of a power of two that is about the distance of the rectangles. */
typedef struct curve {
  const dyd_proof *proof;
  double box[2][4]; /* of i and j, relative to m */
  dyd_xy m, d, n;
  double unit;
  curve_point end[2];
} curve;

static void box_at(double out[4], const curve *c, uint32_t v) {
  dyd_sites_get_d(out, dyd_delaunay_sites(c->proof->pd), v);
  for (int k = 0; k < 4; k++) out[k] = (out[k] - (k < 2 ? c->m.x : c->m.y)) / c->unit;
}

static double larger_double(double a, double b) {
  return a > b ? a : b;
}

static double near_to(const double e[4], dyd_xy c) {
  double x = c.x - dyd_nearest_in(c.x, e[0], e[1]), y = c.y - dyd_nearest_in(c.y, e[2], e[3]);
  return x * x + y * y;
}

static double far_from(const double e[4], dyd_xy c) {
  double x = larger_double(c.x - e[0], e[1] - c.x), y = larger_double(c.y - e[2], e[3] - c.y);
  return x * x + y * y;
}

/* max u.x over the box, or the minimum. */
static double box_top(const double e[4], dyd_xy u) {
  return (u.x > 0 ? e[1] : e[0]) * u.x + (u.y > 0 ? e[3] : e[2]) * u.y;
}
static double box_bottom(const double e[4], dyd_xy u) {
  return (u.x > 0 ? e[0] : e[1]) * u.x + (u.y > 0 ? e[2] : e[3]) * u.y;
}

/* The gap between two sides [a0,a1], [b0,b1] from a to b, signed; 0 where they overlap. */
static double gap_between(double a0, double a1, double b0, double b1) {
  return b0 > a1 ? b0 - a1 : b1 < a0 ? b1 - a0 : 0;
}

/* A point of the curve. The square of ds_i less that of ds_j grows along d: at twice the way, along d, from the point
 * of R_i nearest to it to the one of R_j. Newton's steps, halved where they leave the interval known for the place. */
static dyd_xy point_at(const curve *c, double t) {
  const double *a = c->box[0], *b = c->box[1];
  double along = t / (1 - t * t), lo = -8 * (1 + fabs(along)), hi = -lo, s = 0;
  dyd_xy at = {0, 0};
  for (int k = 0; k < ACROSS; k++) {
    at = (dyd_xy){along * c->n.x + s * c->d.x, along * c->n.y + s * c->d.y};
    double px = dyd_nearest_in(at.x, a[0], a[1]), py = dyd_nearest_in(at.y, a[2], a[3]);
    double qx = dyd_nearest_in(at.x, b[0], b[1]), qy = dyd_nearest_in(at.y, b[2], b[3]);
    double own = (at.x - px) * (at.x - px) + (at.y - py) * (at.y - py);
    double excess = own - (at.x - qx) * (at.x - qx) - (at.y - qy) * (at.y - qy);
    if (fabs(excess) <= 0x1p-40 * own) break;
    *(excess > 0 ? &hi : &lo) = s;
    s -= excess / (2 * ((qx - px) * c->d.x + (qy - py) * c->d.y));
    if (!(s > lo && s < hi)) s = (lo + hi) / 2;
  }
  return at;
}

/* The direction of the curve's end: i and j equally far out. side = -1 or 1: of n. */
static dyd_xy end_direction(const curve *c, int side) {
  double lo = -1.5707963267948966, hi = -lo; /* angle from n towards d */
  dyd_xy u = {0, 0};
  for (int k = 0; k < TURNS; k++) {
    double angle = (lo + hi) / 2, x = side * cos(angle), y = sin(angle);
    u = (dyd_xy){x * c->n.x + y * c->d.x, x * c->n.y + y * c->d.y};
    if (box_top(c->box[1], u) > box_top(c->box[0], u))
      hi = angle;
    else
      lo = angle;
  }
  return u;
}

static curve_point end_spot(const curve *c, int side) {
  curve_point s = {.end = true, .at = end_direction(c, side)};
  s.own = larger_double(box_top(c->box[0], s.at), box_top(c->box[1], s.at));
  return s;
}

static bool make_curve(curve *c, const dyd_proof *p, uint32_t i, uint32_t j) {
  double a[4], b[4];
  int exp;
  *c = (curve){.proof = p, .unit = 1};
  box_at(a, c, i);
  box_at(b, c, j);
  dyd_xy d = {gap_between(a[0], a[1], b[0], b[1]), gap_between(a[2], a[3], b[2], b[3])};
  double length = hypot(d.x, d.y);
  if (!(length > 0) || !isfinite(length)) return false;
  c->m = (dyd_xy){(fmin(a[1], b[1]) + fmax(a[0], b[0])) / 2, (fmin(a[3], b[3]) + fmax(a[2], b[2])) / 2};
  c->d = (dyd_xy){d.x / length, d.y / length};
  c->n = (dyd_xy){-c->d.y, c->d.x};
  frexp(length, &exp);
  c->unit = ldexp(1, exp);
  if (!(c->unit > 0)) return false;
  box_at(c->box[0], c, i);
  box_at(c->box[1], c, j);
  c->end[0] = end_spot(c, -1);
  c->end[1] = end_spot(c, 1);
  return true;
}

static curve_point spot_at(const curve *c, double t) {
  if (fabs(t) >= 1) return c->end[t > 0];
  curve_point s = {.at = point_at(c, t)};
  double a = near_to(c->box[0], s.at), b = near_to(c->box[1], s.at);
  s.own = a < b ? a : b;
  return s;
}

static bool blocks_spot(const double e[4], const curve_point *s) {
  return s->end ? box_bottom(e, s->at) > s->own : far_from(e, s->at) < s->own;
}

static bool blocks_curve(const curve *c, const double e[4], double t) {
  curve_point s = spot_at(c, t);
  return blocks_spot(e, &s);
}

/* With k blocking `in` but not `out`: a point close to where it ceases, still blocked. */
static double last_blocked(const curve *c, const double e[4], double in, double out) {
  for (int k = 0; k < STEPS; k++) {
    double t = (in + out) / 2;
    if (t == in || t == out) break;
    if (blocks_curve(c, e, t))
      in = t;
    else
      out = t;
  }
  return in;
}

/* How far on from t the blocker k reaches; looked for at ever smaller steps. */
static double reach_of(const curve *c, const double e[4], double t) {
  double in = t, step = (1 - t) / 2;
  if (blocks_curve(c, e, 1) && blocks_curve(c, e, (t + 1) / 2)) return 1;
  for (int k = 0; k < 6; k++, step /= 2) {
    double out = in + step;
    if (!blocks_curve(c, e, out)) return last_blocked(c, e, in, out);
    in = out;
  }
  return in;
}

/* Blockers of one spot, the strongest first. */
typedef struct candidates {
  uint32_t site[CANDIDATES];
  double margin[CANDIDATES];
  size_t count;
} candidates;

static double margin_of(const double e[4], const curve_point *s) {
  return s->end ? box_bottom(e, s->at) - s->own : s->own - far_from(e, s->at);
}

static void candidate_consider(candidates *c, uint32_t k, double margin) {
  size_t at = c->count < CANDIDATES ? c->count++ : CANDIDATES;
  if (at == CANDIDATES) {
    if (margin <= c->margin[--at]) return;
  }
  for (; at && c->margin[at - 1] < margin; at--) {
    c->margin[at] = c->margin[at - 1];
    c->site[at] = c->site[at - 1];
  }
  c->margin[at] = margin;
  c->site[at] = k;
}

/* Of the strongest blockers of t, the one that reaches farthest. */
static bool best_blocker(uint32_t *out, double *reach, const curve *c, double t, uint32_t i, uint32_t j,
                         const uint32_t *near, size_t count) {
  double e[4];
  curve_point here = spot_at(c, t);
  candidates found = {.count = 0};
  for (size_t q = 0; q < count; q++) {
    if (near[q] == i || near[q] == j) continue;
    box_at(e, c, near[q]);
    if (blocks_spot(e, &here)) candidate_consider(&found, near[q], margin_of(e, &here));
  }
  *reach = -2;
  for (size_t q = 0; q < found.count; q++) {
    box_at(e, c, found.site[q]);
    double r = reach_of(c, e, t);
    if (r <= *reach) continue;
    *reach = r;
    *out = found.site[q];
  }
  return *reach > -2;
}

/* ---- the chain ---- */

static bool exact_from_double(dyd_exact *out, double v) {
  if (!isfinite(v)) return false;
  int exp;
  double m = frexp(v, &exp);
  mpz_set_d(out->man, ldexp(m, 53));
  out->exp = exp - 53;
  dyd_proof_trim(out);
  return true;
}

static bool chain_point(dyd_cert_chain *out, const curve *c, double t) {
  dyd_xy at = point_at(c, t);
  if (dyd_cert_chain_resize(out, out->points + 1) != DYD_OK) return false;
  dyd_exact *to = out->point[out->points - 1];
  return exact_from_double(&to[0], at.x * c->unit + c->m.x) && exact_from_double(&to[1], at.y * c->unit + c->m.y);
}

static bool chain_walk(dyd_cert_chain *out, const curve *c, uint32_t i, uint32_t j, const uint32_t *near,
                       size_t count) {
  double t = -1, reach, e[4];
  uint32_t k, next;
  dyd_cert_chain_resize(out, 0);
  if (!best_blocker(&k, &reach, c, t, i, j, near, count)) return false;
  while (reach < 1 && out->points < MOST_POINTS) {
    double here = reach, after;
    /* one that blocks the end of k too; it began earlier */
    if (!best_blocker(&next, &after, c, here, i, j, near, count) || after <= here) return false;
    box_at(e, c, next);
    double begin = blocks_curve(c, e, t) ? t : last_blocked(c, e, here, t);
    if (!chain_point(out, c, (begin + here) / 2)) return false;
    out->blocker[out->points - 1] = k;
    t = here;
    k = next;
    reach = after;
  }
  if (reach < 1) return false;
  if (out->points == 0) {
    if (!chain_point(out, c, 0)) return false;
    out->blocker[0] = k;
  }
  out->blocker[out->points] = k;
  return true;
}

/* Rounds all numbers to `bits` bits of the curve's scale, directions to `bits` bits. */
static void round_chain(dyd_cert_chain *to, const dyd_cert_chain *from, const curve *c, int bits) {
  int size;
  frexp(c->unit, &size);
  for (int k = 0; k < 4; k++) dyd_proof_round(&to->u[k / 2][k % 2], &from->u[k / 2][k % 2], -bits);
  for (size_t q = 0; q < from->points; q++)
    for (int a = 0; a < 2; a++) dyd_proof_round(&to->point[q][a], &from->point[q][a], (int64_t)size - bits);
}

static dyd_status keep_shortest(bool *found, dyd_cert_chain *out, const dyd_cert_chain *chain, const curve *c,
                                uint32_t i, uint32_t j) {
  dyd_status st = dyd_cert_chain_resize(out, chain->points);
  if (st != DYD_OK) return st;
  for (size_t q = 0; q <= chain->points; q++) out->blocker[q] = chain->blocker[q];
  for (int bits = 2; bits <= 66 && !*found; bits += 4) {
    round_chain(out, chain, c, bits);
    *found = dyd_cert_chain_holds(out, &c->proof->sites, i, j);
  }
  return DYD_OK;
}

dyd_status dyd_proof_find_chain(bool *found, dyd_cert_chain *out, const dyd_proof *p, uint32_t i, uint32_t j,
                                const uint32_t *near, size_t count) {
  curve c;
  *found = false;
  if (!make_curve(&c, p, i, j)) return DYD_OK;
  DYD_LOCAL(dyd_cert_chain, chain);
  bool good = true;
  for (int k = 0; k < 2; k++) {
    dyd_xy u = end_direction(&c, k ? 1 : -1);
    good = good && exact_from_double(&chain.u[k][0], u.x) && exact_from_double(&chain.u[k][1], u.y);
  }
  dyd_status st = DYD_OK;
  if (good && chain_walk(&chain, &c, i, j, near, count)) st = keep_shortest(found, out, &chain, &c, i, j);
  return st;
}
