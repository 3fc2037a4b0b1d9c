/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Parts side by side, then seams in rounds: 0 with 1, 2 with 3, ...; then 0 with 2, ... */
#include "skeleton/join.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "skeleton/insert.h"
#include "skeleton/mesh_exact.h"
#include "skeleton/mesh_fixed.h"
#include "skeleton/mesh_start.h"
#include "skeleton/predicates.h"

#include <math.h>

/* ---- where the parts meet ---- */

/* Some hull edge: the ghost triangle beyond which v lies. */
static dyd_half_edge hull_towards(dyd_mesh *m, uint32_t v) {
  return dyd_hull_edge(m, dyd_mesh_locate(m, v));
}

/* The hull edge that begins at the last (right) or first vertex in the order of x, then y; that order rises and falls
 * once around the hull. */
static dyd_half_edge seam_extreme(const dyd_mesh *m, dyd_half_edge h, bool right) {
  int way = right ? 1 : -1;
  while (way * dyd_mesh_compare(m, dyd_hull_target(m, h), dyd_hull_origin(m, h)) > 0) h = dyd_hull_following(m, h);
  while (way * dyd_mesh_compare(m, dyd_hull_origin(m, dyd_hull_preceding(m, h)), dyd_hull_origin(m, h)) > 0)
    h = dyd_hull_preceding(m, h);
  return h;
}

/* ---- the seam ---- */

/* Exact zeros are counted: the quad or corner may stay. */
static int seam_side(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  int sign = dyd_build_orient(m, a, b, p);
  if (!sign) m->tally.ties++;
  return sign;
}

/* Hull edges that begin at the ends a (left part) and b of the lower tangent: nothing lies below the line ab, nothing
 * on the segment between them. */
static void lower_tangent(dyd_half_edge *at_a, dyd_half_edge *at_b, dyd_mesh *m) {
  dyd_half_edge a = *at_a, b = *at_b;
  for (bool moved = true; moved;) {
    moved = false;
    while (seam_side(m, dyd_hull_origin(m, a), dyd_hull_origin(m, b), dyd_hull_origin(m, dyd_hull_preceding(m, a))) < 0)
      a = dyd_hull_preceding(m, a);
    for (; seam_side(m, dyd_hull_origin(m, a), dyd_hull_origin(m, b), dyd_hull_target(m, b)) < 0; moved = true)
      b = dyd_hull_following(m, b);
  }
  *at_a = a;
  *at_b = b;
}

/* The triangles (p i j) and (o j i) at edge h = i j become t = (p i o) and s = (o j p), vertices in this order. */
static void seam_flip(dyd_mesh *m, dyd_half_edge h) {
  dyd_half_edge twin = dyd_edge_twin(m, h);
  uint32_t t = dyd_edge_triangle(h), s = dyd_edge_triangle(twin);
  dyd_half_edge ij[2] = {dyd_edge_twin(m, dyd_edge_next(h)), dyd_edge_twin(m, dyd_edge_prev(h))};
  dyd_half_edge ji[2] = {dyd_edge_twin(m, dyd_edge_next(twin)), dyd_edge_twin(m, dyd_edge_prev(twin))};
  uint32_t p = dyd_edge_apex(m, h), i = dyd_edge_origin(m, h), j = dyd_edge_target(m, h), o = dyd_edge_apex(m, twin);
  m->tri[t] = (dyd_tri){{p, i, o}, {0, 0, 0}};
  m->tri[s] = (dyd_tri){{o, j, p}, {0, 0, 0}};
  dyd_edge_join(m, dyd_edge_of(t, 0), ji[0]);
  dyd_edge_join(m, dyd_edge_of(t, 1), dyd_edge_of(s, 1));
  dyd_edge_join(m, dyd_edge_of(t, 2), ij[1]);
  dyd_edge_join(m, dyd_edge_of(s, 0), ij[0]);
  dyd_edge_join(m, dyd_edge_of(s, 2), ji[1]);
}

/* Cuts both spheres open at a and b and puts two ghost triangles between, t and t + 1: of the hull edge a b, below, and
 * of b a, the seam's upper end, which is returned. */
static dyd_half_edge seam_glue(dyd_mesh *m, dyd_half_edge at_a, dyd_half_edge at_b, uint32_t t) {
  uint32_t a = dyd_hull_origin(m, at_a), b = dyd_hull_origin(m, at_b);
  dyd_half_edge after_a = dyd_edge_next(at_a), before_a = dyd_edge_twin(m, after_a);
  dyd_half_edge after_b = dyd_edge_next(at_b), before_b = dyd_edge_twin(m, after_b);
  m->tri[t] = (dyd_tri){{b, a, m->n}, {0, 0, 0}};
  m->tri[t + 1] = (dyd_tri){{a, b, m->n}, {0, 0, 0}};
  dyd_edge_join(m, dyd_edge_of(t, 2), dyd_edge_of(t + 1, 2));
  dyd_edge_join(m, dyd_edge_of(t, 0), before_a);
  dyd_edge_join(m, dyd_edge_of(t, 1), after_b);
  dyd_edge_join(m, dyd_edge_of(t + 1, 0), before_b);
  dyd_edge_join(m, dyd_edge_of(t + 1, 1), after_a);
  return dyd_edge_of(t + 1, 2);
}

/* The candidate on the left: the hull vertex q after a, once all edges a q whose inner triangle's apex is inside the
 * circle a b q are deleted. false: q is not above the base. */
static bool left_candidate(uint32_t *q, dyd_mesh *m, dyd_half_edge top) {
  uint32_t a = dyd_hull_target(m, top), b = dyd_hull_origin(m, top);
  for (;;) {
    dyd_half_edge edge = dyd_hull_following(m, top);
    uint32_t r = dyd_edge_across(m, edge);
    *q = dyd_hull_target(m, edge);
    if (seam_side(m, a, b, *q) <= 0) return false;
    if (r == m->n || dyd_build_incircle(m, a, b, *q, r) <= 0) return true;
    seam_flip(m, edge);
  }
}

static bool right_candidate(uint32_t *p, dyd_mesh *m, dyd_half_edge top) {
  uint32_t a = dyd_hull_target(m, top), b = dyd_hull_origin(m, top);
  for (;;) {
    dyd_half_edge edge = dyd_hull_preceding(m, top);
    uint32_t r = dyd_edge_across(m, edge);
    *p = dyd_hull_origin(m, edge);
    if (seam_side(m, a, b, *p) <= 0) return false;
    if (r == m->n || dyd_build_incircle(m, a, b, *p, r) <= 0) return true;
    seam_flip(m, edge);
  }
}

/* One edge across; *top follows. false: the base is the upper tangent. Were the triangle below on one circle with the
 * new one, a zero would have been met when it was made [JOIN-1]. */
static bool zip_one(dyd_half_edge *top, dyd_mesh *m) {
  uint32_t a = dyd_hull_target(m, *top), b = dyd_hull_origin(m, *top), p = DYD_NONE, q = DYD_NONE;
  bool left = left_candidate(&q, m, *top), right = right_candidate(&p, m, *top);
  if (!left && !right) return false;
  if (left && right) left = dyd_build_incircle(m, a, b, q, p) <= 0;
  dyd_half_edge at = left ? dyd_edge_prev(*top) : dyd_edge_next(*top), beyond = dyd_edge_twin(m, at);
  seam_flip(m, at); /* left: its triangle becomes (b, ghost, q); else the one beyond becomes (p, ghost, a) */
  *top = dyd_edge_of(dyd_edge_triangle(left ? at : beyond), 1);
  return true;
}

/* The part m grows by its right neighbour, whose predicates know too little; triangles m->count and m->count + 1 are
 * free. */
static void seam_join(dyd_mesh *m, const dyd_mesh *right) {
  dyd_fixed_join(m, right);
  m->end = right->end;
  dyd_half_edge at_a = seam_extreme(m, hull_towards(m, right->begin), true);
  m->hint = right->hint;
  dyd_half_edge at_b = seam_extreme(m, hull_towards(m, m->begin), false);
  lower_tangent(&at_a, &at_b, m);
  dyd_half_edge top = seam_glue(m, at_a, at_b, m->count);
  while (zip_one(&top, m)) continue;
  m->hint = dyd_edge_triangle(top);
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
  seam_join(m, r);
}

bool dyd_strips_are_apart(const dyd_reps *reps, const dyd_strips *strips) {
  double last = -INFINITY;
  if (strips->count < 2) return false;
  for (unsigned s = 0; s < strips->count; s++) {
    double lo = INFINITY, hi = -INFINITY;
    for (uint32_t v = strips->begin[s]; v < strips->begin[s + 1]; v++) {
      double x = reps->xy[v].x;
      if (x < lo) lo = x;
      if (x > hi) hi = x;
    }
    if (!(lo - last > 4 * reps->delta)) return false; /* an empty strip: lo is infinite */
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
    s->parts++;
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
      for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) dyd_edge_join(m, h, dyd_edge_twin(m, h));
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

static void add_tallies(dyd_mesh *m, const seams *s) {
  for (unsigned k = 0; k < s->parts; k++) {
    const dyd_tally *c = &s->part[k].tally;
    m->tally.asked += c->asked;
    m->tally.integer += c->integer;
    m->tally.exact += c->exact;
    m->tally.ties += c->ties;
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
  if (*joined) add_tallies(m, s);
  free(s);
  return st;
}
