/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths and births where each point has a weight: it moves by at most t times that [TOL-8].
 *
 * At any t the discs are given, and whether a pair is legal, or possible, is decided as for discs of given radii
 * (dyd_discs_ask). So t is bracketed and halved. */
#include "base/alloc.h"
#include "tolerance/discs.h"
#include "tolerance/lines.h"
#include "tolerance/state.h"

#include <math.h>

/* ---- a guess ---- */

/* About where the answer for a pair of weighted discs changes, in doubles: a guess, which exact questions on both sides
 * confirm [TOL-8].
 *
 * Caps as in discs.h, as arcs of angles: u.w > tau is acos(tau / |w|) to both sides of w. */

#define FULL 6.283185307179586

enum { STEPS = 60, MOST_SITES = 64 };

/* A site, seen from p_i. */
typedef struct guess_site {
  double x, y, weight;
} guess_site;

/* half: 0 where it is empty. */
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

static bool guess_load(guess *g, const dyd_disc_work *w, bool legal) {
  const double *i = w->about[w->i];
  g->legal = legal;
  g->weight = w->weight[w->i];
  g->count = w->count;
  if (w->count > MOST_SITES) return false;
  for (size_t k = 0; k <= w->count; k++) {
    uint32_t v = k < w->count ? w->seen[k] : w->j;
    guess_site *s = k < w->count ? &g->other[k] : &g->j;
    *s = (guess_site){w->about[v][0] - i[0], w->about[v][1] - i[1], w->weight[v]};
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

/* false: a disc meets i or j, so that the pair is not legal. */
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

/* From -pi to pi. Arcs are at most half a turn, so their common part is one arc about the first. */
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

/* Returns true if they hold all directions. Else the end of one is in none of the others. */
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
  size_t k = 0; /* the disc of i is in that of j, which no other may meet */
  while (k < g->count &&
         !(hypot(g->other[k].x - g->j.x, g->other[k].y - g->j.y) <= t * (g->other[k].weight + g->j.weight)))
    k++;
  return k == g->count;
}

/* About the t between lo and hi from which on the pair is no longer legal (or illegal) for the
 * sites that are seen, the discs of all v having radius t weight[v]. */
static double filter_guess_weight(const dyd_disc_work *w, bool legal, double lo, double hi) {
  guess g;
  if (!guess_load(&g, w, legal)) return lo / 2 + hi / 2;
  for (int k = 0; k < STEPS; k++) {
    double mid = 4 * lo >= hi ? lo + (hi - lo) / 2 : hi / 4;
    *(guess_is_below(&g, mid) ? &lo : &hi) = mid;
  }
  return lo;
}

#define WIDTH (1 + 0x1p-41)

#define SPARE 0x1p-51 /* weights may be the doubles next to the intended ones */

#define NEAR 0x1p-43 /* how far beside a guess is asked at first */

enum { MOST_STEPS = 4000, GUESSES = 12 };

typedef struct weight_work {
  dyd_tolerance *t;
  dyd_disc_work discs;
} weight_work;

/* The smaller disc first, at any t. */
static void weigh_pair(weight_work *g, uint32_t v, uint32_t w) {
  bool swap = g->t->weight[v] > g->t->weight[w];
  g->discs.i = swap ? w : v;
  g->discs.j = swap ? v : w;
  g->discs.count = 0;
}

/* legal: is the pair legal; else: is it illegal? */
static dyd_truth weights_hold_at(weight_work *g, double t, bool legal) {
  dyd_discs_weigh(&g->discs, t);
  dyd_truth shown = dyd_discs_ask(&g->discs, legal);
  return legal || shown == DYD_UNKNOWN ? shown : shown == DYD_TRUE ? DYD_FALSE : DYD_TRUE;
}

/* ---- where it changes ---- */

/* Where to ask next. First beside a guess, below and above in turn and farther off each time: mostly these are all. */
static double next_try(const weight_work *g, double lo, double hi, bool legal, int guesses) {
  double middle = 4 * lo >= hi ? lo + (hi - lo) / 2 : hi / 4, off = ldexp(NEAR, guesses / 2 * 4);
  if (guesses >= GUESSES) return middle;
  double at = filter_guess_weight(&g->discs, legal, lo, hi) * (guesses % 2 ? 1 + off : 1 - off);
  return at > lo && at < hi ? at : middle;
}

/* The question is true at *lo, or *lo is 0, and false at *hi. Until they are near to each other, or it is not known. */
static void halve(double *lo, double *hi, weight_work *g, bool legal) {
  int guesses = 0;
  for (int k = 0; k<MOST_STEPS && * hi> * lo * WIDTH; k++) {
    double mid = next_try(g, *lo, *hi, legal, guesses++);
    dyd_truth below = mid > 0 ? weights_hold_at(g, mid, legal) : DYD_UNKNOWN;
    if (below == DYD_UNKNOWN && guesses <= GUESSES) {
      guesses = GUESSES;
      continue;
    }
    if (below == DYD_UNKNOWN || mid <= *lo || mid >= *hi) return;
    *(below == DYD_TRUE ? lo : hi) = mid;
  }
}

/* From *lo on, where the pair is legal, to *hi, where it is not; infinite: nowhere. */
static void find_above(double *lo, double *hi, weight_work *g) {
  dyd_truth below = DYD_TRUE;
  for (*hi = *lo * 2; *hi < 0x1p900; *hi *= 2) {
    below = weights_hold_at(g, *hi, true);
    if (below == DYD_FALSE) return;
    if (below == DYD_TRUE) *lo = *hi;
  }
  *hi = HUGE_VAL;
}

/* The direction found is at the end of one cap: whose end is next to it? */
static size_t next_cap_to(const dyd_caps *c, size_t one) {
  size_t best = one;
  double most = -HUGE_VAL;
  for (int turn = -1; turn <= 1; turn += 2) {
    dyd_direction u = dyd_filter_cap_end(&c->item[one], turn);
    for (size_t k = 0; k < c->count; k++) {
      const dyd_cap *p = &c->item[k];
      double over = (u.x * p->w[0] + u.y * p->w[1] - p->top) / (fabs(p->w[0]) + fabs(p->w[1]) + p->top);
      if (k == one || !(over > most) || over > 0x1p-30) continue;
      most = over;
      best = k;
    }
  }
  return best;
}

/* From lo to hi; the sites that bind: the caps about the direction that is still allowed at one of them. */
static void row_weigh(weight_work *g, dyd_tolerance_row *row, double lo, double hi, bool legal) {
  const dyd_caps *c = &g->discs.caps;
  uint32_t k = DYD_NONE, l = DYD_NONE;
  g->discs.caps.count = 0;
  weights_hold_at(g, legal ? lo : hi, legal);
  if (c->count) {
    k = c->item[c->by[0]].vertex;
    l = c->item[c->by[0] == c->by[1] ? next_cap_to(c, c->by[0]) : c->by[1]].vertex;
  }
  *row = dyd_row_of(g->t, g->discs.i, g->discs.j, row->event, k, l, lo * (1 - SPARE), hi * (1 + 2 * SPARE));
}

static dyd_status see_around(weight_work *g, uint32_t v, uint32_t w) {
  dyd_tolerance *t = g->t;
  dyd_status st = dyd_others_around(&t->others, t, v, w, DYD_HUB);
  for (size_t k = 0; k < t->others.count && st == DYD_OK; k++) dyd_discs_see(&g->discs, t->others.vertex[k]);
  return st == DYD_OK && g->discs.failed ? DYD_E_NOMEM : st;
}

/* While discs are below those of equal weights, which the pair survives, it does. */
static dyd_status weigh_death(weight_work *g, dyd_tolerance_row *row) {
  const dyd_tolerance *t = g->t;
  double lo = row->lo / t->heaviest * (1 - 2 * SPARE), hi = HUGE_VAL;
  if (row->lo == HUGE_VAL) return DYD_OK;
  if (t->heaviest > 0) {
    weigh_pair(g, t->sk->vertex[row->i], t->sk->vertex[row->j]);
    dyd_status st = see_around(g, g->discs.i, g->discs.j);
    if (st != DYD_OK) return st;
    if (!(lo > 0x1p-900 && lo < 0x1p900)) lo = 0;
    if (lo > 0) find_above(&lo, &hi, g);
    if (hi < HUGE_VAL) halve(&lo, &hi, g, true);
  }
  if (hi < HUGE_VAL)
    row_weigh(g, row, lo, hi, true);
  else
    *row = (dyd_tolerance_row){row->i, row->j, row->event, DYD_NO_SITE, DYD_NO_SITE, t->heaviest > 0 ? lo : hi, hi};
  return g->discs.failed ? DYD_E_NOMEM : DYD_OK;
}

/* *late: it is above t->options.up_to for certain. */
static dyd_status weigh_birth(bool *late, weight_work *g, dyd_tolerance_row *row) {
  const dyd_tolerance *t = g->t;
  double lo = 0, hi = dyd_q_double(t->options.up_to, 1);
  weigh_pair(g, t->sk->vertex[row->i], t->sk->vertex[row->j]);
  dyd_status st = see_around(g, g->discs.i, g->discs.j);
  if (st != DYD_OK) return st;
  *late = weights_hold_at(g, hi, false) == DYD_TRUE;
  if (*late) return DYD_OK;
  halve(&lo, &hi, g, false);
  row_weigh(g, row, lo, hi, false);
  return g->discs.failed ? DYD_E_NOMEM : DYD_OK;
}

/* ---- all ---- */

/* Exact discs are made when the first row needs them. */
static dyd_status weigh_row(bool *late, dyd_tolerance_row *row, void *work) {
  weight_work *g = work;
  dyd_status st = g->discs.disc ? DYD_OK : dyd_discs_make(&g->discs, NULL);
  if (st != DYD_OK) return st;
  return row->event == DYD_EVENT_DEATH ? weigh_death(work, row) : weigh_birth(late, work, row);
}

dyd_status dyd_weigh(dyd_tolerance *t, size_t first) {
  weight_work g = {
      .t = t,
      .discs = {
          .pd = t->pd, .sites = t->sk->reps.sites, .weight = t->weight, .heaviest = t->heaviest, .tree = &t->tree}};
  dyd_caps_init(&g.discs.caps);
  dyd_status st = dyd_near_index(t);
  if (st == DYD_OK) st = dyd_rows_rework(t, first, weigh_row, &g);
  dyd_discs_clear(&g.discs);
  return st;
}
