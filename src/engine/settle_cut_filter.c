/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Four points that keep two sites apart, in doubles.
 *
 * A disc around c holds both ends and no other site if c is nearer to every corner a of theirs than to all points b of
 * the others: c is in half-planes. By Helly's theorem four of the points tell when there is no c: two a and two b on
 * crossing segments, where |a - z| |a' - z| > |b - z| |b' - z| at the crossing z, or one b among three a. Half-planes
 * are added as witnesses are searched for, for the farthest a and the nearest b, until nothing is left. */
#include "engine/settle_filter.h"
#include "legal/lp_filter.h"

#include <math.h>

/* Corners of both ends; points of others, and half-planes. */
enum { ENDS = 8, MOST = 64 };

typedef struct spot {
  double at[2];
  size_t site;
} spot;

/* Coordinates are relative to `origin`. end: corners of both ends. excess: by how much the best four, three of `inside`
 * or two of which are of ends, keep them apart; 0: nothing found. */
typedef struct cutting {
  const dyd_settle_site *site;
  size_t count, i, j;
  double origin[2];
  spot end[ENDS], other[MOST];
  dyd_cut cut[MOST];
  size_t ends, others;
  spot best[4];
  bool inside;
  double excess;
} cutting;

static double square_of(double x) {
  return x * x;
}

static double spot_distance2(const spot *a, const double c[2]) {
  return square_of(a->at[0] - c[0]) + square_of(a->at[1] - c[1]);
}

/* Twice the area of a, b, c. */
static double spot_turn(const spot *a, const spot *b, const spot *c) {
  return (b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) - (b->at[1] - a->at[1]) * (c->at[0] - a->at[0]);
}

static void cutting_add_end(cutting *q, size_t k) {
  const double *o = q->origin;
  double b[4];
  for (int n = 0; n < 4; n++) {
    const double *side = &q->site[k].box[n & 2];
    b[n] = q->site[k].core[n / 2] ? side[n & 1] : side[0] / 2 + side[1] / 2;
  }
  for (int x = 0; x < (b[0] < b[1] ? 2 : 1); x++)
    for (int y = 2; y < (b[2] < b[3] ? 4 : 3); y++) q->end[q->ends++] = (spot){{b[x] - o[0], b[y] - o[1]}, k};
}

/* Is b among a, a2 and another point of the ends? */
static void cutting_look_inside(cutting *q, const spot *a, const spot *a2, const spot *b) {
  for (const spot *a3 = a2 + 1; a3 < q->end + q->ends; a3++) {
    double t = spot_turn(a, a2, a3), least = spot_turn(a, a2, b) / t;
    least = fmin(least, fmin(spot_turn(a2, a3, b) / t, spot_turn(a3, a, b) / t));
    double excess = least * fabs(t);
    if (!(least > 0) || !(excess > q->excess)) continue;
    q->excess = excess;
    q->inside = true;
    q->best[0] = *a, q->best[1] = *a2, q->best[2] = *a3, q->best[3] = *b;
  }
}

static void cutting_look_crossed(cutting *q, const spot *a, const spot *a2, const spot *b, const spot *b2) {
  double s = spot_turn(a, a2, b), s2 = spot_turn(a, a2, b2), t = spot_turn(b, b2, a), t2 = spot_turn(b, b2, a2);
  if (!(s * s2 < 0 && t * t2 < 0)) return;
  double along = t / (t - t2), across = s / (s - s2);
  double excess = along * (1 - along) * spot_distance2(a, a2->at) - across * (1 - across) * spot_distance2(b, b2->at);
  if (!(excess > q->excess)) return;
  q->excess = excess;
  q->inside = false;
  q->best[0] = *a, q->best[1] = *a2, q->best[2] = *b, q->best[3] = *b2;
}

/* What number k of the others does with those before it. */
static void cutting_look(cutting *q, size_t k) {
  for (const spot *a = q->end; a < q->end + q->ends; a++)
    for (const spot *a2 = a + 1; a2 < q->end + q->ends; a2++) {
      cutting_look_inside(q, a, a2, &q->other[k]);
      for (size_t n = 0; n < k; n++) cutting_look_crossed(q, a, a2, &q->other[n], &q->other[k]);
    }
}

static spot farthest_end(const cutting *q, const double c[2]) {
  spot best = q->end[0];
  for (size_t k = 1; k < q->ends; k++)
    if (spot_distance2(&q->end[k], c) > spot_distance2(&best, c)) best = q->end[k];
  return best;
}

/* The point of the others that is nearest to c; site = count: there is none. */
static spot nearest_other(const cutting *q, const double c[2]) {
  spot best = {{0, 0}, q->count};
  for (size_t k = 0; k < q->count; k++) {
    spot s = {.site = k};
    if (k == q->i || k == q->j) continue;
    for (int a = 0; a < 2; a++) {
      const double *side = &q->site[k].box[2 * a];
      s.at[a] = fmin(fmax(c[a], side[0] - q->origin[a]), side[1] - q->origin[a]);
    }
    if (best.site == q->count || spot_distance2(&s, c) < spot_distance2(&best, c)) best = s;
  }
  return best;
}

/* What the search for a disc around c adds. false: there is one, or no half-plane says that there is none. */
static bool cutting_add(cutting *q, const double c[2]) {
  spot a = farthest_end(q, c), b = nearest_other(q, c);
  double n[2] = {a.at[0] - b.at[0], a.at[1] - b.at[1]}, length = hypot(n[0], n[1]);
  if (b.site == q->count || !(spot_distance2(&a, c) >= spot_distance2(&b, c)) || !(length > 0)) return false;
  double d = -(n[0] * (a.at[0] + b.at[0]) + n[1] * (a.at[1] + b.at[1])) / 2;
  q->cut[q->others] = (dyd_cut){n[0] / length, n[1] / length, d / length};
  q->other[q->others] = b;
  cutting_look(q, q->others++);
  return true;
}

/* Around the middles of i and j, whose distance is *size. */
static void cutting_begin(cutting *q, double *size) {
  const double *a = q->site[q->i].box, *b = q->site[q->j].box;
  for (int x = 0; x < 2; x++)
    q->origin[x] = (a[2 * x] / 2 + a[2 * x + 1] / 2) / 2 + (b[2 * x] / 2 + b[2 * x + 1] / 2) / 2;
  *size = hypot(fmax(a[1], b[1]) - fmin(a[0], b[0]), fmax(a[3], b[3]) - fmin(a[2], b[2]));
  cutting_add_end(q, q->i);
  cutting_add_end(q, q->j);
}

/* Where the search begins: a little to one side and the other of the middle, as a point between both ends may be on the
 * very segment. */
static void cutting_start(double c[2], const cutting *q, int side) {
  const spot *a = &q->end[0], *b = &q->end[q->ends - 1];
  c[0] = side * (b->at[1] - a->at[1]) / 16;
  c[1] = side * (a->at[0] - b->at[0]) / 16;
}

bool dyd_filter_find_cut(dyd_settle_cut *out, const dyd_settle_site *site, size_t count, size_t i, size_t j) {
  cutting q = {.site = site, .count = count, .i = i, .j = j};
  dyd_lp_result r = {.z = 1};
  double size, c[2];
  cutting_begin(&q, &size);
  for (int side = -1; side <= 1; side += 2) {
    cutting_start(c, &q, side);
    cutting_add(&q, c);
  }
  while (q.others < MOST && r.z > 0) {
    r = dyd_lp_centre(q.cut, q.others, 1e6 * size);
    c[0] = r.x;
    c[1] = r.y;
    if (r.z > 0 && !cutting_add(&q, c)) break;
  }
  for (int k = 0; k < 4; k++) {
    out->site[k] = q.best[k].site;
    for (int x = 0; x < 2; x++) out->at[k][x] = q.best[k].at[x] + q.origin[x];
  }
  out->inside = q.inside;
  return q.excess > 0;
}
