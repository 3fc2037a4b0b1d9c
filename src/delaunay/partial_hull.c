/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial convex hull of the sites.
 *
 * A vertex is possible iff some choice puts it on the boundary of the hull, a pair iff for some choice all points lie
 * on one closed side of a line through both [HST-1]. A vertex is certain iff it is a corner of the hull for every
 * choice: the certain edges to the ghost say so [HUL-2]. A pair is legal iff for every choice all others are strictly
 * on one side of the line through both: iff it is an edge of the hull of the representatives, the rectangles do not
 * meet, and it is certainly oriented with every common neighbour among the possible pairs [HST-2]. Pairs of a chain
 * whose true points are proved to be on one line, a side of the hull, are ties, whatever their rectangles [TIE-3].
 *
 * A site possibly on the hull is on that of the representatives or in an unbounded undecided face [CLO-1]. */
#include "delaunay/partial_hull.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "delaunay/index_list.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "delaunay/undecided.h"
#include "rect/rect.h"

/* Sites that can be extreme in a direction u >= 0 (mathematics: section 6, step 3).
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

typedef struct hull_direction {
  int axis; /* -1: (0,1); 1: (1,0); 0: normal to from -> to */
  dyd_hull_corner from, to;
} hull_direction;

/* A normal against (0,1) or (1,0). */
static int compare_with_axis(const hull_direction *a, int axis) {
  bool same = dyd_hull_compare(axis < 0, a->from, a->to) == 0; /* horizontal or vertical */
  return same ? 0 : -axis;
}

static int compare_directions(const hull_direction *a, const hull_direction *b) {
  if (a->axis && b->axis) return a->axis - b->axis;
  if (b->axis) return compare_with_axis(a, b->axis);
  if (a->axis) return -compare_with_axis(b, a->axis);
  return dyd_hull_cross(a->from, a->to, b->from, b->to);
}

/* The directions of one extreme. */
typedef struct direction_fan {
  uint32_t of;
  hull_direction first, last;
} direction_fan;

static int compare_fans(const void *a, const void *b) {
  return compare_directions(&((const direction_fan *)a)->first, &((const direction_fan *)b)->first);
}

static dyd_hull_corner chain_low(const dyd_extreme *x) {
  return (dyd_hull_corner){x, 0};
}

static dyd_hull_corner chain_high(const dyd_extreme *x) {
  return (dyd_hull_corner){x, 1};
}

/* ---- the chain ---- */

typedef struct extreme_chain {
  const dyd_extreme **at;
  size_t count;
} extreme_chain;

static int compare_low(const void *a, const void *b) {
  const dyd_extreme *x = *(const dyd_extreme *const *)a, *y = *(const dyd_extreme *const *)b;
  int order = dyd_hull_compare(0, chain_low(x), chain_low(y));
  return order ? order : dyd_hull_compare(1, chain_low(x), chain_low(y));
}

/* The upper hull of the lower left corners, from left to right, cut to the part right of the topmost. */
static dyd_status build_chain(extreme_chain *c, const dyd_extreme *x, size_t count) {
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

/* Returns true if u.b >= g(u) for sample s: (0,1) for s = 0, the normal of edge s - 1, (1,0) for the last, s = count */
static bool reaches(const extreme_chain *c, dyd_hull_corner b, size_t s) {
  if (s == 0) return dyd_hull_compare(1, b, chain_low(c->at[0])) >= 0;
  if (s == c->count) return dyd_hull_compare(0, b, chain_low(c->at[s - 1])) >= 0;
  return dyd_hull_cross(chain_low(c->at[s - 1]), chain_low(c->at[s]), chain_low(c->at[s - 1]), b) >= 0;
}

/* The sample of the edge or ray of D above b. */
static size_t above(const extreme_chain *c, dyd_hull_corner b) {
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
static size_t last_reached(const extreme_chain *c, dyd_hull_corner b, size_t s, size_t end) {
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

static bool find_fan(direction_fan *f, const extreme_chain *c, const dyd_extreme *x) {
  dyd_hull_corner b = chain_high(x);
  size_t s = above(c, b);
  if (!reaches(c, b, s)) return false;
  size_t first = last_reached(c, b, s, 0), last = last_reached(c, b, s, c->count);
  f->first = (hull_direction){-1, b, b};
  f->last = (hull_direction){1, b, b};
  if (first > 0) f->first = (hull_direction){0, chain_low(c->at[first - 1]), b};
  if (last < c->count) f->last = (hull_direction){0, b, chain_low(c->at[last])};
  return true;
}

/* ---- pairs of fans ---- */

static dyd_status add_pair(dyd_hull_pairs *p, uint32_t i, uint32_t j) {
  p->capped = p->capped || p->count >= p->most;
  if (p->capped) return DYD_OK;
  if (!DYD_GROW(p->item, p->cap, p->count + 1)) return DYD_E_NOMEM;
  p->item[p->count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, DYD_INDETERMINATE};
  return DYD_OK;
}

/* Sweeps over the directions: pairs of fans with a common one. `active` has room for all. */
static dyd_status sweep(dyd_hull_pairs *pairs, const direction_fan *f, size_t count, uint32_t *active) {
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

/* For the directions u >= 0: marks the extremes that are possible on the hull, and appends the pairs that are possible
 * edges, some of them possibly twice [HST-1]. pairs NULL: only marks. */
static dyd_status hull_quadrant(dyd_hull_pairs *pairs, dyd_extreme *x, size_t count) {
  extreme_chain c = {0};
  size_t fans = 0;
  direction_fan *f = dyd_alloc(count, sizeof *f);
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
  dyd_free_all(c.at, active, f);
  return st;
}

typedef struct hull_work {
  const dyd_delaunay *pd;
  dyd_extreme *x; /* by vertex, ascending */
  size_t count, made;
  bool exact;           /* all are exact points */
  dyd_hull_pairs pairs; /* of indices of x, sorted */
  size_t *start;        /* neighbours of k: next[start[k] .. start[k + 1]), ascending */
  uint32_t *next;
} hull_work;

void dyd_hull_clear(dyd_hull *h) {
  dyd_index_list_clear(&h->sure_vertices);
  dyd_index_list_clear(&h->possible_vertices);
  dyd_pair_list_clear(&h->pairs);
}

static void hull_work_clear(hull_work *h) {
  for (size_t k = 0; k < h->made; k++)
    for (int n = 0; n < 4; n++) mpq_clear(h->x[k].e[n]);
  dyd_free_all(h->x, h->pairs.item, h->start, h->next);
}

/* ---- candidates ---- */

/* Vertices on the skeleton's hull and in unbounded faces, ascending. */
static dyd_status gather(dyd_index_list *out, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_index_list) some = {0};
  size_t cap = 0;
  dyd_status st = dyd_delaunay_hull(&some, pd);
  if (st == DYD_OK) st = dyd_index_list_add(out, &cap, some.item, some.count);
  for (size_t k = 0; k < out->count; k++) out->item[k] = pd->sk.vertex[out->item[k]];
  dyd_index_list_clear(&some);
  for (size_t f = 0; f < pd->open.count && st == DYD_OK; f++) {
    if (!dyd_open_is_outer(pd, f)) continue;
    st = dyd_open_vertices(&some.item, &some.count, pd, f);
    if (st == DYD_OK) st = dyd_index_list_add(out, &cap, some.item, some.count);
    if (st == DYD_OK) dyd_index_list_clear(&some);
  }
  dyd_index_list_sort(out);
  return st;
}

static void load(hull_work *h) {
  DYD_LOCAL(dyd_rect, r);
  h->exact = true;
  for (size_t k = 0; k < h->count; k++) {
    dyd_extreme *x = &h->x[h->made++];
    h->exact = h->exact && dyd_vertex_is_point(&h->pd->sk, x->vertex);
    for (int n = 0; n < 4; n++) mpq_init(x->e[n]);
    dyd_rects_get(&r, &h->pd->sk.rects, x->vertex);
    dyd_interval_get_q(x->e[0], x->e[1], &r.x);
    dyd_interval_get_q(x->e[2], x->e[3], &r.y);
    dyd_extreme_enclose(x);
  }
}

static dyd_status find_candidates(hull_work *h) {
  DYD_SCOPED(dyd_index_list) list = {0};
  dyd_status st = gather(&list, h->pd);
  h->x = st == DYD_OK ? dyd_alloc(list.count, sizeof *h->x) : NULL;
  for (; h->x && h->count < list.count; h->count++)
    h->x[h->count] = (dyd_extreme){.vertex = list.item[h->count], .chain = {DYD_NONE, DYD_NONE}};
  if (st == DYD_OK && !h->x) st = DYD_E_NOMEM;
  if (st == DYD_OK) load(h);
  return st;
}

/* Not all sites are exact points. */
static bool is_proved_chain(const dyd_delaunay *pd, size_t f) {
  if (pd->open.kind == DYD_LISTED) return pd->open.face[f].outer && pd->open.face[f].proved;
  return dyd_open_status_of(pd, f) == DYD_TIE; /* a line */
}

static dyd_status find_chains(hull_work *h) {
  for (size_t f = 0; f < h->pd->open.count && !h->exact; f++) {
    DYD_FREED uint32_t *vertex = NULL;
    size_t count = 0;
    if (!is_proved_chain(h->pd, f)) continue;
    dyd_status st = dyd_open_vertices(&vertex, &count, h->pd, f);
    if (st != DYD_OK) return st;
    for (size_t k = 0; k < count; k++) {
      dyd_extreme *x = dyd_find_index(&vertex[k], h->x, h->count, sizeof *h->x);
      if (x) x->chain[x->chain[0] != DYD_NONE] = (uint32_t)f;
    }
  }
  return DYD_OK;
}

static bool share_chain(const dyd_extreme *a, const dyd_extreme *b) {
  for (int k = 0; k < 2; k++)
    if (a->chain[k] != DYD_NONE && (a->chain[k] == b->chain[0] || a->chain[k] == b->chain[1])) return true;
  return false;
}

/* ---- possible ---- */

/* Mirrors all in the axis. */
static void mirror(hull_work *h, int axis) {
  for (size_t k = 0; k < h->count; k++) {
    dyd_extreme *x = &h->x[k];
    mpq_swap(x->e[2 * axis], x->e[2 * axis + 1]);
    dyd_iv t = x->d[2 * axis];
    x->d[2 * axis] = dyd_iv_neg(x->d[2 * axis + 1]);
    x->d[2 * axis + 1] = dyd_iv_neg(t);
    for (int n = 0; n < 2; n++) mpq_neg(x->e[2 * axis + n], x->e[2 * axis + n]);
  }
}

static void sort_pairs(dyd_hull_pairs *p) {
  size_t kept = 0;
  if (p->count) qsort(p->item, p->count, sizeof *p->item, dyd_compare_two);
  for (size_t k = 0; k < p->count; k++)
    if (k == 0 || dyd_compare_two(&p->item[kept - 1], &p->item[k])) p->item[kept++] = p->item[k];
  p->count = kept;
}

/* The four quadrants of directions; the last mirror image is the original. pairs: &h->pairs, or NULL. */
static dyd_status find_possible(hull_work *h, dyd_hull_pairs *pairs) {
  dyd_status st = DYD_OK;
  for (int quadrant = 0; quadrant < 4 && st == DYD_OK; quadrant++) {
    st = hull_quadrant(pairs, h->x, h->count);
    if (pairs) sort_pairs(pairs);
    mirror(h, quadrant & 1);
  }
  return st;
}

/* ---- certain ---- */

static bool rects_meet(const dyd_extreme *a, const dyd_extreme *b) {
  for (int n = 0; n < 4; n += 2)
    if (mpq_cmp(a->e[n + 1], b->e[n]) < 0 || mpq_cmp(b->e[n + 1], a->e[n]) < 0) return false;
  return true;
}

static void find_sure(hull_work *h) {
  for (size_t k = 0; k < h->count; k++) h->x[k].sure = dyd_corner_is_sure(h->pd, h->x[k].vertex);
}

static dyd_sure orientation(const hull_work *h, size_t i, size_t j, size_t k, dyd_rect r[3]) {
  const size_t at[3] = {i, j, k};
  for (int n = 0; n < 3; n++) dyd_rects_get(&r[n], &h->pd->sk.rects, h->x[at[n]].vertex);
  return dyd_orientation(&r[0], &r[1], &r[2]);
}

/* The status of pair p: legal when `edge` and no common neighbour is unsure; a tie when i, j and all unsure ones are
 * exact points. r: scratch. */
static dyd_pair_status decide(const hull_work *h, dyd_pair p, bool edge, dyd_rect r[3]) {
  const dyd_delaunay *pd = h->pd;
  bool legal = edge,
       tie = dyd_vertex_is_point(&pd->sk, h->x[p.i].vertex) && dyd_vertex_is_point(&pd->sk, h->x[p.j].vertex);
  bool settled = h->exact && !edge; /* a tie */
  const uint32_t *a = h->next + h->start[p.i], *a_end = h->next + h->start[p.i + 1];
  const uint32_t *b = h->next + h->start[p.j], *b_end = h->next + h->start[p.j + 1];
  while (!settled && a < a_end && b < b_end && (legal || tie)) {
    if (*a != *b) {
      if (*a < *b)
        a++;
      else
        b++;
      continue;
    }
    bool point = dyd_vertex_is_point(&pd->sk, h->x[*a].vertex);
    if ((legal || !point) && orientation(h, p.i, p.j, *a, r) == DYD_UNSURE) {
      legal = false;
      tie = tie && point;
    }
    a++, b++;
  }
  return legal ? DYD_LEGAL : tie ? DYD_TIE : DYD_INDETERMINATE;
}

/* The pairs become those of sites, with their statuses. */
static void decide_pairs(hull_work *h) {
  const dyd_delaunay *pd = h->pd;
  DYD_LOCAL_ARRAY(dyd_rect, r, [3]);
  for (size_t k = 0; k < h->pairs.count; k++) {
    dyd_pair p = h->pairs.item[k];
    uint32_t v = h->x[p.i].vertex, w = h->x[p.j].vertex, i = pd->sk.reps.site[v], j = pd->sk.reps.site[w];
    bool edge = dyd_is_hull_edge(pd, v, w) && !rects_meet(&h->x[p.i], &h->x[p.j]);
    bool tied = share_chain(&h->x[p.i], &h->x[p.j]);
    h->pairs.item[k] = (dyd_pair){i < j ? i : j, i < j ? j : i, tied ? DYD_TIE : decide(h, p, edge, r)};
  }
}

/* ---- the result ---- */

static dyd_status list_vertices(dyd_index_list *out, const hull_work *h, bool sure) {
  if (!DYD_NEW(out->item, h->count)) return DYD_E_NOMEM;
  for (size_t k = 0; k < h->count; k++)
    if (sure ? h->x[k].sure : h->x[k].possible) out->item[out->count++] = h->pd->sk.reps.site[h->x[k].vertex];
  if (out->count) qsort(out->item, out->count, sizeof *out->item, dyd_compare_index);
  return DYD_OK;
}

/* The vertices; the possible pairs are found with them, unless NULL. */
static dyd_status fill_vertices(dyd_hull *out, hull_work *h, dyd_hull_pairs *pairs) {
  dyd_status st = find_candidates(h);
  if (st == DYD_OK) st = find_possible(h, pairs);
  if (st != DYD_OK) return st;
  find_sure(h);
  st = list_vertices(&out->sure_vertices, h, true);
  return st == DYD_OK ? list_vertices(&out->possible_vertices, h, false) : st;
}

/* The statuses of the pairs found, which are sorted. */
static dyd_status fill_pairs(dyd_hull *out, hull_work *h) {
  if (h->pairs.capped) return DYD_CAPPED;
  dyd_status st = dyd_pairs_deal(&h->start, &h->next, &(dyd_pair_list){h->pairs.count, h->pairs.item}, h->count);
  if (st == DYD_OK) st = find_chains(h);
  if (st != DYD_OK) return st;
  decide_pairs(h);
  out->pairs = (dyd_pair_list){h->pairs.count, h->pairs.item};
  h->pairs.item = NULL;
  if (out->pairs.count) qsort(out->pairs.item, out->pairs.count, sizeof *out->pairs.item, dyd_compare_two);
  return DYD_OK;
}

dyd_status dyd_delaunay_partial_hull(dyd_hull *out, const dyd_delaunay *pd, bool pairs) {
  if (!pd) return DYD_E_ARG;
  DYD_SCOPED(hull_work) h = {.pd = pd, .pairs = {.most = pd->max_pairs}};
  dyd_hull found = {0};
  dyd_status st = fill_vertices(&found, &h, pairs ? &h.pairs : NULL);
  if (st == DYD_OK && pairs) st = fill_pairs(&found, &h);
  dyd_hull_clear(dyd_failed(st) ? &found : out);
  if (!dyd_failed(st)) *out = found;
  return st;
}
