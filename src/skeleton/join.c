/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Parts side by side, then seams in rounds: 0 with 1, 2 with 3, ...; then 0 with 2, ... */
#include "skeleton/join.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "skeleton/mesh_fixed.h"
#include "skeleton/mesh_start.h"

#include <math.h>

/* ---- walking along a hull ----
 *
 * A hull edge, the inside on its left, is named by h = 4 t + k: its ghost triangle t, and the ghost is v[k] of it. */

static uint32_t origin(const dyd_mesh *m, uint32_t h) {
  return m->tri[h >> 2].v[dyd_prev(h & 3)];
}
static uint32_t target(const dyd_mesh *m, uint32_t h) {
  return m->tri[h >> 2].v[dyd_next(h & 3)];
}
/* The hull edge that begins where h ends, the one that ends where h begins. */
static uint32_t following(const dyd_mesh *m, uint32_t h) {
  uint32_t twin = m->tri[h >> 2].n[dyd_prev(h & 3)];
  return (twin & ~3u) | dyd_prev(twin & 3);
}
static uint32_t preceding(const dyd_mesh *m, uint32_t h) {
  uint32_t twin = m->tri[h >> 2].n[dyd_next(h & 3)];
  return (twin & ~3u) | dyd_next(twin & 3);
}
/* The third vertex of the triangle inside of h: the ghost, too, once the seam has eaten into thin parts. */
static uint32_t apex(const dyd_mesh *m, uint32_t h) {
  uint32_t twin = m->tri[h >> 2].n[h & 3];
  return m->tri[twin >> 2].v[twin & 3];
}

/* Some hull edge: the ghost triangle beyond which v lies. */
static uint32_t hull_towards(dyd_mesh *m, uint32_t v) {
  uint32_t t = dyd_mesh_locate(m, v);
  return 4 * t + dyd_mesh_ghost_corner(m, t);
}

static bool is_right_of(const dyd_mesh *m, uint32_t v, uint32_t w) {
  dyd_xy a = m->xy[v], b = m->xy[w];
  return a.x > b.x || (a.x == b.x && a.y > b.y);
}

/* The hull edge that begins at the last (right) or first vertex in the order of x, then y; that order rises and falls
 * once around the hull. */
static uint32_t extreme(const dyd_mesh *m, uint32_t h, bool right) {
  while (is_right_of(m, target(m, h), origin(m, h)) == right) h = following(m, h);
  while (is_right_of(m, origin(m, preceding(m, h)), origin(m, h)) == right) h = preceding(m, h);
  return h;
}

/* ---- the seam ---- */

/* Exact zeros are counted: the quad or corner may stay. */
static int side(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  int sign = dyd_mesh_orient(m, a, b, p);
  if (!sign) m->ties++;
  return sign;
}

/* Hull edges that begin at the ends a (left part) and b of the lower tangent: nothing lies below the line ab, nothing
 * on the segment between them. */
static void lower_tangent(uint32_t *at_a, uint32_t *at_b, dyd_mesh *m) {
  uint32_t a = *at_a, b = *at_b;
  for (bool moved = true; moved;) {
    moved = false;
    for (; side(m, origin(m, a), origin(m, b), origin(m, preceding(m, a))) < 0; moved = true) a = preceding(m, a);
    for (; side(m, origin(m, a), origin(m, b), target(m, b)) < 0; moved = true) b = following(m, b);
  }
  *at_a = a;
  *at_b = b;
}

static void join_edges(dyd_mesh *m, uint32_t h, uint32_t twin) {
  m->tri[h >> 2].n[h & 3] = twin;
  m->tri[twin >> 2].n[twin & 3] = h;
}

/* The triangles (p i j) and (o j i) at edge h = i j become t = (p i o) and s = (o j p), vertices in this order. */
static void flip(dyd_mesh *m, uint32_t h) {
  uint32_t t = h >> 2, twin = m->tri[t].n[h & 3], s = twin >> 2;
  unsigned k = h & 3, q = twin & 3;
  dyd_tri a = m->tri[t], b = m->tri[s];
  uint32_t p = a.v[k], i = a.v[dyd_next(k)], j = a.v[dyd_prev(k)], o = b.v[q];
  m->tri[t] = (dyd_tri){{p, i, o}, {0, 0, 0}};
  m->tri[s] = (dyd_tri){{o, j, p}, {0, 0, 0}};
  join_edges(m, 4 * t + 0, b.n[dyd_next(q)]);
  join_edges(m, 4 * t + 1, 4 * s + 1);
  join_edges(m, 4 * t + 2, a.n[dyd_prev(k)]);
  join_edges(m, 4 * s + 0, a.n[dyd_next(k)]);
  join_edges(m, 4 * s + 2, b.n[dyd_prev(q)]);
}

/* Cuts both spheres open at a and b and puts two ghost triangles between, t and t + 1: of the hull edge a b, below, and
 * of b a, the seam's upper end, which is returned. */
static uint32_t glue(dyd_mesh *m, uint32_t at_a, uint32_t at_b, uint32_t t) {
  uint32_t a = origin(m, at_a), b = origin(m, at_b);
  uint32_t after_a = (at_a & ~3u) | dyd_next(at_a & 3), before_a = m->tri[at_a >> 2].n[after_a & 3];
  uint32_t after_b = (at_b & ~3u) | dyd_next(at_b & 3), before_b = m->tri[at_b >> 2].n[after_b & 3];
  uint32_t low = 4 * t, top = 4 * (t + 1);
  m->tri[t] = (dyd_tri){{b, a, m->n}, {0, 0, 0}};
  m->tri[t + 1] = (dyd_tri){{a, b, m->n}, {0, 0, 0}};
  join_edges(m, low + 2, top + 2);
  join_edges(m, low + 0, before_a);
  join_edges(m, low + 1, after_b);
  join_edges(m, top + 0, before_b);
  join_edges(m, top + 1, after_a);
  return top + 2;
}

/* The candidate on the left: the hull vertex q after a, once all edges a q whose inner triangle's apex is inside the
 * circle a b q are deleted. false: q is not above the base. */
static bool left_candidate(uint32_t *q, dyd_mesh *m, uint32_t top) {
  uint32_t a = target(m, top), b = origin(m, top);
  for (;;) {
    uint32_t edge = following(m, top), r = apex(m, edge);
    *q = target(m, edge);
    if (side(m, a, b, *q) <= 0) return false;
    if (r == m->n || dyd_mesh_incircle(m, a, b, *q, r) <= 0) return true;
    flip(m, edge);
  }
}

static bool right_candidate(uint32_t *p, dyd_mesh *m, uint32_t top) {
  uint32_t a = target(m, top), b = origin(m, top);
  for (;;) {
    uint32_t edge = preceding(m, top), r = apex(m, edge);
    *p = origin(m, edge);
    if (side(m, a, b, *p) <= 0) return false;
    if (r == m->n || dyd_mesh_incircle(m, a, b, *p, r) <= 0) return true;
    flip(m, edge);
  }
}

/* One edge across; *top follows. false: the base is the upper tangent. */
static bool zip_one(uint32_t *top, dyd_mesh *m) {
  uint32_t a = target(m, *top), b = origin(m, *top), p = DYD_NONE, q = DYD_NONE;
  bool left = left_candidate(&q, m, *top), right = right_candidate(&p, m, *top);
  if (!left && !right) return false;
  if (left && right) left = dyd_mesh_incircle(m, a, b, q, p) <= 0;
  uint32_t below = apex(m, *top), t = *top >> 2, k = *top & 3;
  if (below != m->n) (void)dyd_mesh_incircle(m, a, b, left ? q : p, below); /* <= 0; counts a tie */
  if (left) {
    flip(m, 4 * t + dyd_prev(k)); /* t = (b, ghost, q) */
    *top = 4 * t + 1;
  } else {
    uint32_t s = m->tri[t].n[dyd_next(k)] >> 2;
    flip(m, 4 * t + dyd_next(k)); /* s = (p, ghost, a) */
    *top = 4 * s + 1;
  }
  return true;
}

/* The part m grows by its right neighbour, whose predicates know too little; triangles m->count and m->count + 1 are
 * free. */
static void join(dyd_mesh *m, const dyd_mesh *right) {
  dyd_fixed_join(m, right);
  m->end = right->end;
  uint32_t at_a = extreme(m, hull_towards(m, right->begin), true);
  m->hint = right->hint;
  uint32_t at_b = extreme(m, hull_towards(m, m->begin), false);
  lower_tangent(&at_a, &at_b, m);
  uint32_t top = glue(m, at_a, at_b, m->count);
  while (zip_one(&top, m)) continue;
  m->hint = top >> 2;
  m->count = right->count;
}

/* ---- the parts ---- */

/* Triangles from .. to - 1 are free: aliases have none. */
typedef struct gap {
  uint32_t from, to;
} gap;

typedef struct seams {
  dyd_mesh part[DYD_STRIPS];
  dyd_status status[DYD_STRIPS];
  dyd_delaunay_counters counters[DYD_STRIPS];
  gap gap[DYD_STRIPS]; /* before part k */
  const volatile int *cancel;
  unsigned parts, stride;
} seams;

static void fill_part(void *context, size_t k) {
  seams *s = context;
  s->status[k] = dyd_mesh_fill(&s->part[k], s->cancel);
}

static void join_pair(void *context, size_t k) {
  seams *s = context;
  size_t left = 2 * k * s->stride, right = left + s->stride;
  if (right >= s->parts) return;
  dyd_mesh *m = &s->part[left], *r = &s->part[right];
  s->gap[right] = (gap){m->count + 2, 2 * r->begin};
  join(m, r);
}

bool dyd_strips_are_apart(const dyd_reps *reps, const dyd_strips *strips) {
  double last = -INFINITY;
  if (strips->count < 2 || reps->code) return false;
  for (unsigned s = 0; s < strips->count; s++) {
    double lo = INFINITY, hi = -INFINITY;
    for (uint32_t v = strips->begin[s]; v < strips->begin[s + 1]; v++) {
      double x = reps->xy[v].x;
      if (x < lo) lo = x;
      if (x > hi) hi = x;
    }
    if (!(lo > last)) return false; /* an empty strip: lo is infinite */
    last = hi > last ? hi : last;
  }
  return true;
}

static void make_parts(seams *s, const dyd_mesh *m, const dyd_strips *strips) {
  for (unsigned k = 0; k < strips->count; k++) {
    uint32_t begin = strips->begin[k], end = strips->begin[k + 1];
    if (begin == end) continue;
    dyd_mesh *p = &s->part[s->parts];
    *p = *m;
    p->begin = begin;
    p->end = end;
    p->part = true;
    p->counters = &s->counters[s->parts++];
    p->beyond = 0;
  }
}

static dyd_status fill_parts(bool *stuck, seams *s, unsigned threads) {
  dyd_status st = DYD_OK;
  dyd_parallel(threads, s->parts, fill_part, s);
  *stuck = false;
  for (unsigned k = 0; k < s->parts; k++) {
    *stuck = *stuck || s->part[k].stuck;
    if (st == DYD_OK && !s->part[k].stuck) st = s->status[k];
  }
  return st;
}

/* Triangles from the end move into the gaps. */
static void close_gaps(dyd_mesh *m, gap *gaps, unsigned count) {
  unsigned first = 0;
  while (first < count) {
    gap *low = &gaps[first], *high = &gaps[count - 1];
    if (low->from == low->to)
      first++;
    else if (high->to == m->count) {
      m->count = high->from;
      count--;
    } else {
      uint32_t t = low->from++;
      m->tri[t] = m->tri[--m->count];
      if (m->hint == m->count) m->hint = t;
      for (unsigned k = 0; k < 3; k++) join_edges(m, 4 * t + k, m->tri[t].n[k]);
    }
  }
}

static dyd_status gather_aliases(dyd_mesh *m, const seams *s) {
  for (unsigned k = 0; k < s->parts; k++) {
    const dyd_mesh *p = &s->part[k];
    for (uint32_t v = 0; p->alias && v < m->n; v++)
      if (p->alias[v] != DYD_NONE && dyd_mesh_set_alias(m, v, p->alias[v]) != DYD_OK) return DYD_E_NOMEM;
  }
  return DYD_OK;
}

static void add_counters(dyd_mesh *m, const seams *s) {
  for (unsigned k = 0; k < s->parts; k++) {
    const dyd_delaunay_counters *c = &s->counters[k];
    m->counters->filter += c->filter;
    m->counters->integer += c->integer;
    m->counters->exact += c->exact;
    m->beyond += c->integer + c->exact;
    m->ties += s->part[k].ties;
  }
}

static void join_parts(seams *s, unsigned threads) {
  for (s->stride = 1; s->stride < s->parts; s->stride *= 2)
    dyd_parallel(threads, (s->parts + 2 * s->stride - 1) / (2 * s->stride), join_pair, s);
}

dyd_status dyd_mesh_join_strips(bool *joined, dyd_mesh *m, const dyd_strips *strips, const volatile int *cancel,
                                unsigned threads) {
  bool stuck = false;
  seams *s = calloc(1, sizeof *s);
  *joined = false;
  if (s) m->tri = dyd_alloc(2 * (size_t)m->n + 2, sizeof *m->tri);
  if (!s || !m->tri) return free(s), DYD_E_NOMEM;
  s->cancel = cancel;
  make_parts(s, m, strips);
  dyd_status st = fill_parts(&stuck, s, threads);
  if (st == DYD_OK && !stuck) {
    join_parts(s, threads);
    dyd_fixed_take(m, &s->part[0]);
    m->count = s->part[0].count;
    m->hint = s->part[0].hint;
    close_gaps(m, s->gap + 1, s->parts - 1);
    st = gather_aliases(m, s);
    *joined = st == DYD_OK;
    m->strips = *strips;
  }
  for (unsigned k = 0; k < s->parts; k++) {
    dyd_mesh_trim(&s->part[k]);
    free(s->part[k].alias);
  }
  if (*joined) add_counters(m, s);
  free(s);
  return st;
}
