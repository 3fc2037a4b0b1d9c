/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* About where the answer for a pair of weighted discs changes, in doubles: a guess. What is stated of it is asked
 * exactly on both sides [TOL-8].
 *
 * Caps as in caps.h, as arcs of angles: u.w > tau is acos(tau / |w|) to both sides of w. */
#include "tolerance/discs.h"

#include <math.h>

#define FULL 6.283185307179586
enum { STEPS = 60, MOST_SITES = 64 };

/* A site, seen from p_i. */
typedef struct guess_site {
  double x, y, weight;
} guess_site;

/* half: 0 where there is no direction. */
typedef struct guess_arc {
  double middle, half;
} guess_arc;

typedef struct guess {
  bool legal;
  double weight; /* of i */
  guess_site j, other[MOST_SITES];
  size_t count, arcs;
  guess_arc arc[MOST_SITES + 1];
} guess;

static bool guess_load(guess *g, const dyd_disc_work *w, const double *weight, bool legal) {
  const dyd_disc *i = &w->disc[w->i];
  double x = mpq_get_d(i->x), y = mpq_get_d(i->y);
  g->legal = legal;
  g->weight = weight[w->i];
  g->count = w->count;
  if (w->count > MOST_SITES) return false;
  for (size_t k = 0; k <= w->count; k++) {
    uint32_t v = k < w->count ? w->seen[k] : w->j;
    guess_site *s = k < w->count ? &g->other[k] : &g->j;
    *s = (guess_site){mpq_get_d(w->disc[v].x) - x, mpq_get_d(w->disc[v].y) - y, weight[v]};
  }
  return true;
}

/* ---- arcs at t ---- */

static void guess_add_arc(guess *g, double x, double y, double tau) {
  double size = hypot(x, y);
  g->arc[g->arcs++] = (guess_arc){atan2(y, x), size > tau ? acos(tau / size) : 0};
}

/* The disc of s and radius r, inverted: centre and radius. */
static void guess_invert(double out[3], const guess_site *s, double r) {
  double n = s->x * s->x + s->y * s->y - r * r;
  out[0] = s->x / n;
  out[1] = s->y / n;
  out[2] = r / n;
}

static bool guess_meets(const guess *g, const guess_site *s, double t) {
  return hypot(s->x, s->y) <= t * (s->weight + g->weight) ||
         hypot(s->x - g->j.x, s->y - g->j.y) <= t * (s->weight + g->j.weight);
}

/* false: somebody meets i or j, so that nothing is legal. */
static bool guess_arcs(guess *g, double t) {
  double q[3], p[3], sign = g->legal ? -1 : 1;
  guess_invert(q, &g->j, t * (g->j.weight - g->weight));
  g->arcs = 0;
  guess_add_arc(g, -sign * q[0], -sign * q[1], q[2]);
  for (size_t k = 0; k < g->count; k++) {
    bool meets = guess_meets(g, &g->other[k], t);
    if (meets && g->legal) return false;
    if (meets) continue;
    guess_invert(p, &g->other[k], t * (g->other[k].weight + g->weight));
    guess_add_arc(g, sign * (p[0] - q[0]), sign * (p[1] - q[1]), p[2] + q[2]);
  }
  return true;
}

/* ---- answers ---- */

/* From -pi to pi. Arcs are at most half a turn, so what all have in common is one arc about the first. */
static bool guess_have_common(const guess *g) {
  double lo = -g->arc[0].half, hi = g->arc[0].half;
  for (size_t k = 1; k < g->arcs; k++) {
    double turn = remainder(g->arc[k].middle - g->arc[0].middle, FULL);
    lo = fmax(lo, turn - g->arc[k].half);
    hi = fmin(hi, turn + g->arc[k].half);
    if (g->arc[k].half == 0) return false;
  }
  return lo < hi;
}

/* Do they hold all directions? Else the end of one is in none of the others. */
static bool guess_cover_all(const guess *g) {
  for (size_t e = 0; e < 2 * g->arcs; e++) {
    const guess_arc *a = &g->arc[e / 2];
    double end = e % 2 ? a->middle + a->half : a->middle - a->half;
    size_t k = 0;
    if (a->half == 0) continue;
    while (k < g->arcs && (k == e / 2 || !(fabs(remainder(end - g->arc[k].middle, FULL)) < g->arc[k].half))) k++;
    if (k == g->arcs) return false;
  }
  return true;
}

/* Legal for these sites; or illegal, where that is asked. */
static bool guess_is_below(guess *g, double t) {
  double size = hypot(g->j.x, g->j.y);
  if (!g->legal) return size > t * (g->j.weight + g->weight) && guess_arcs(g, t) && guess_cover_all(g);
  if (size > t * (g->j.weight - g->weight)) return guess_arcs(g, t) && guess_have_common(g);
  size_t k = 0; /* the disc of i is in that of j, which nobody may meet */
  while (k < g->count &&
         !(hypot(g->other[k].x - g->j.x, g->other[k].y - g->j.y) <= t * (g->other[k].weight + g->j.weight)))
    k++;
  return k == g->count;
}

double dyd_filter_guess_weight(const dyd_disc_work *w, const double *weight, bool legal, double lo, double hi) {
  guess g;
  if (!guess_load(&g, w, weight, legal)) return lo / 2 + hi / 2;
  for (int k = 0; k < STEPS; k++) {
    double mid = 4 * lo >= hi ? lo + (hi - lo) / 2 : hi / 4;
    *(guess_is_below(&g, mid) ? &lo : &hi) = mid;
  }
  return lo;
}
