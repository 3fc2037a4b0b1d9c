/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Who can be extreme in a direction u >= 0 (mathematics: section 6, step 3).
 *
 * Write a_k for the lower left, b_k for the upper right corner of R_k, g(u) = max_k u.a_k. Site i can be extreme in
 * direction u iff u.b_i >= g(u), and i and j can span a hull edge with normal u iff both hold. g is the support
 * function of the points a_k, whose hull shows to these directions the chain m_0 (topmost) .. m_r-1 (rightmost). D = {x
 * : u.x <= g(u) for all u >= 0} is bounded by the chain, a ray to the left from m_0 and a ray down from m_r-1; i is
 * possible iff b_i is not inside D, which the edge or ray above b_i decides. The directions of i form a closed
 * interval, since u.b_i
 * - g(u) is concave: its ends are normals to the tangents from b_i to the chain, found by bisection [HST-1].
 *
 * A direction u is kept as the vector that it is normal to, turned to the right of it: a tangent from a corner to a
 * corner, to the right and down; (0,1) and (1,0) are kept as such. Directions are ordered clockwise. */
#include "base/alloc.h"
#include "delaunay/partial_hull.h"

typedef struct direction {
  int axis; /* -1: (0,1); 1: (1,0); 0: normal to from -> to */
  dyd_hull_corner from, to;
} direction;

/* A normal against (0,1) or (1,0). */
static int compare_with_axis(const direction *a, int axis) {
  bool same = dyd_hull_compare(axis < 0, a->from, a->to) == 0; /* horizontal or vertical */
  return same ? 0 : -axis;
}

static int compare_directions(const direction *a, const direction *b) {
  if (a->axis && b->axis) return a->axis - b->axis;
  if (b->axis) return compare_with_axis(a, b->axis);
  if (a->axis) return -compare_with_axis(b, a->axis);
  return dyd_hull_cross(a->from, a->to, b->from, b->to);
}

/* The directions of one extreme. */
typedef struct fan {
  uint32_t of;
  direction first, last;
} fan;

static int compare_fans(const void *a, const void *b) {
  return compare_directions(&((const fan *)a)->first, &((const fan *)b)->first);
}

static dyd_hull_corner chain_low(const dyd_extreme *x) {
  return (dyd_hull_corner){x, 0};
}
static dyd_hull_corner chain_high(const dyd_extreme *x) {
  return (dyd_hull_corner){x, 1};
}

/* ---- the chain ---- */

typedef struct chain {
  const dyd_extreme **at;
  size_t count;
} chain;

static int compare_low(const void *a, const void *b) {
  const dyd_extreme *x = *(const dyd_extreme *const *)a, *y = *(const dyd_extreme *const *)b;
  int order = dyd_hull_compare(0, chain_low(x), chain_low(y));
  return order ? order : dyd_hull_compare(1, chain_low(x), chain_low(y));
}

/* The upper hull of the lower left corners, from left to right, cut to what is right of the topmost. */
static dyd_status build_chain(chain *c, const dyd_extreme *x, size_t count) {
  c->at = dyd_alloc(count, sizeof(const dyd_extreme *));
  if (!c->at) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++) c->at[k] = &x[k];
  qsort(c->at, count, sizeof(const dyd_extreme *), compare_low);
  size_t top = 0, used = 0;
  for (size_t k = 0; k < count; k++) {
    const dyd_extreme *p = c->at[k];
    while (used > 1 && dyd_hull_cross(chain_low(c->at[used - 2]), chain_low(c->at[used - 1]),
                                      chain_low(c->at[used - 2]), chain_low(p)) >= 0)
      used--;
    c->at[used++] = p;
  }
  for (size_t k = 1; k < used; k++)
    if (dyd_hull_compare(1, chain_low(c->at[k]), chain_low(c->at[top])) >= 0) top = k;
  for (size_t k = top; k < used; k++) c->at[k - top] = c->at[k];
  c->count = used - top;
  if (c->count > 1 && !compare_low(&c->at[0], &c->at[1])) c->count = 1; /* equal corners */
  return DYD_OK;
}

/* ---- the fan of one ---- */

/* Is u.b >= g(u) for sample s: (0,1) for s = 0, the normal of edge s - 1, (1,0) for the last, s = count? */
static bool reaches(const chain *c, dyd_hull_corner b, size_t s) {
  if (s == 0) return dyd_hull_compare(1, b, chain_low(c->at[0])) >= 0;
  if (s == c->count) return dyd_hull_compare(0, b, chain_low(c->at[s - 1])) >= 0;
  return dyd_hull_cross(chain_low(c->at[s - 1]), chain_low(c->at[s]), chain_low(c->at[s - 1]), b) >= 0;
}

/* The sample of the edge or ray of D above b. */
static size_t above(const chain *c, dyd_hull_corner b) {
  size_t lo = 0, hi = c->count; /* m_lo-1 is not right of b, m_hi is */
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (dyd_hull_compare(0, chain_low(c->at[mid]), b) <= 0)
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo;
}

/* The last sample from `s` on towards `end` that b reaches; it reaches s. */
static size_t last_reached(const chain *c, dyd_hull_corner b, size_t s, size_t end) {
  size_t good = s, bad = end;
  if (reaches(c, b, end)) return end;
  while (good + 1 < bad || bad + 1 < good) {
    size_t mid = good < bad ? good + (bad - good) / 2 : bad + (good - bad) / 2;
    if (reaches(c, b, mid))
      good = mid;
    else
      bad = mid;
  }
  return good;
}

static bool find_fan(fan *f, const chain *c, const dyd_extreme *x) {
  dyd_hull_corner b = chain_high(x);
  size_t s = above(c, b);
  if (!reaches(c, b, s)) return false;
  size_t first = last_reached(c, b, s, 0), last = last_reached(c, b, s, c->count);
  f->first = (direction){-1, b, b};
  f->last = (direction){1, b, b};
  if (first > 0) f->first = (direction){0, chain_low(c->at[first - 1]), b};
  if (last < c->count) f->last = (direction){0, b, chain_low(c->at[last])};
  return true;
}

/* ---- pairs of fans ---- */

static dyd_status add_pair(dyd_hull_pairs *p, uint32_t i, uint32_t j) {
  p->capped = p->capped || p->count >= p->most;
  if (p->capped) return DYD_OK;
  if (!dyd_reserve((void **)&p->item, &p->cap, p->count + 1, sizeof *p->item)) return DYD_E_NOMEM;
  p->item[p->count++] = (dyd_vertex_pair){i < j ? i : j, i < j ? j : i, 0};
  return DYD_OK;
}

/* Sweeps over the directions: pairs of fans with a common one. `active` has room for all. */
static dyd_status sweep(dyd_hull_pairs *pairs, const fan *f, size_t count, uint32_t *active) {
  size_t alive = 0;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < count && st == DYD_OK && !pairs->capped; k++) {
    size_t kept = 0;
    for (size_t q = 0; q < alive; q++)
      if (compare_directions(&f[active[q]].last, &f[k].first) >= 0) active[kept++] = active[q];
    for (size_t q = 0; q < kept && st == DYD_OK; q++) st = add_pair(pairs, f[active[q]].of, f[k].of);
    alive = kept;
    active[alive++] = (uint32_t)k;
  }
  return st;
}

dyd_status dyd_hull_quadrant(dyd_hull_pairs *pairs, dyd_extreme *x, size_t count) {
  chain c = {0};
  size_t fans = 0;
  fan *f = dyd_alloc(count, sizeof *f);
  uint32_t *active = dyd_alloc(count, sizeof *active);
  dyd_status st = f && active ? build_chain(&c, x, count) : DYD_E_NOMEM;
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    if (!find_fan(&f[fans], &c, &x[k])) continue;
    f[fans++].of = (uint32_t)k;
    x[k].possible = true;
  }
  if (st == DYD_OK && pairs) {
    qsort(f, fans, sizeof *f, compare_fans);
    st = sweep(pairs, f, fans, active);
  }
  free(c.at);
  free(active);
  free(f);
  return st;
}
