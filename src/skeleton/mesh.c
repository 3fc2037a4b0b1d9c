/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building the skeleton: point location by walking, insertion by cavities. */
#include "skeleton/mesh.h"

#include "base/alloc.h"
#include "skeleton/join.h"
#include "skeleton/mesh_exact.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/mesh_fixed.h"
#include "skeleton/mesh_start.h"

#include <math.h>
#include <string.h>

/* ---- predicates: filter, fixed-size integers, GMP ---- */

static int orient_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  if (!m->no_filter) {
    int sign = dyd_filter_orient_near(m, m->xy[a], m->xy[b], m->xy[c]);
    if (sign) return sign;
    if (!m->fixed && !m->no_fixed) dyd_fixed_prepare(m);
    if (dyd_filter_orient_small(&sign, m, m->xy[a], m->xy[b], m->xy[c])) return sign;
    if (m->fixed) return m->counters->integer++, dyd_fixed_orient(m, a, b, c);
  }
  m->counters->exact++;
  return dyd_mesh_orient_exact(m, a, b, c);
}

int dyd_mesh_orient(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  m->asked++;
  int sign = dyd_filter_orient(m, m->xy[a], m->xy[b], m->xy[c]);
  return sign ? sign : orient_slow(m, a, b, c);
}

static int incircle_real(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int sign;
  if (!m->no_filter) {
    if (!m->fixed && !m->no_fixed) dyd_fixed_prepare(m);
    if (dyd_filter_incircle_small(&sign, m, m->xy[a], m->xy[b], m->xy[c], m->xy[p])) return sign;
    if ((sign = dyd_filter_incircle_near(m, m->xy[a], m->xy[b], m->xy[c], m->xy[p]))) return sign;
    if (dyd_fixed_incircle(&sign, m, a, b, c, p)) return m->counters->integer++, sign;
  }
  m->counters->exact++;
  return dyd_mesh_incircle_exact(m, a, b, c, p);
}

static int incircle_ghost(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  int side = dyd_mesh_orient(m, a, b, p);
  m->asked--; /* counted with the in-circle test it answers */
  if (side) return side;
  m->ties++;
  return dyd_mesh_between(m, a, b, p) ? 1 : 0;
}

static int incircle_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  if (a == m->n) return incircle_ghost(m, b, c, p);
  if (b == m->n) return incircle_ghost(m, c, a, p);
  if (c == m->n) return incircle_ghost(m, a, b, p);
  int sign = incircle_real(m, a, b, c, p);
  if (!sign) m->ties++;
  return sign;
}

static inline int incircle(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  m->asked++;
  int sign = m->no_filter ? 0 : dyd_filter_incircle_at(m, m->xy[a], m->xy[b], m->xy[c], m->xy[p]);
  return sign ? sign : incircle_slow(m, a, b, c, p);
}

int dyd_mesh_incircle(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  return incircle(m, a, b, c, p);
}

/* ---- location and insertion ---- */

/* The walk goes over an edge only when v is strictly beyond it; it ends since the power of v decreases, or inside
 * one cocircular polygon, whose dual is a tree that is never walked back. */
uint32_t dyd_mesh_locate(dyd_mesh *m, uint32_t v) {
  uint32_t t = m->hint;
  unsigned from = 3;
  for (unsigned k = 0; k < 3; k++)
    if (m->tri[t].v[k] == m->n) {
      t = m->tri[t].n[k] >> 2;
      break;
    }
  for (;;) {
    const dyd_tri *s = &m->tri[t];
    uint32_t beyond = DYD_NONE;
    unsigned k = from == 3 ? 0 : dyd_next(from);
    for (unsigned left = from == 3 ? 3 : 2; left; left--, k = dyd_next(k))
      if (dyd_mesh_orient(m, s->v[dyd_next(k)], s->v[dyd_prev(k)], v) < 0) {
        beyond = s->n[k];
        break;
      }
    if (beyond == DYD_NONE) return t;
    t = beyond >> 2;
    from = beyond & 3;
    if (m->tri[t].v[from] == m->n) return t;
  }
}

/* Room for one more stack frame (two edges) and one more free triangle. */
static bool room(dyd_mesh *m, size_t stacked, size_t spares) {
  return dyd_reserve((void **)&m->stack, &m->stack_cap, stacked + 3, sizeof *m->stack) &&
         dyd_reserve((void **)&m->spare, &m->spare_cap, spares + 1, sizeof *m->spare);
}

/* Joins v to the rim of the cavity that grows from t. Triangles come out counter-clockwise around v, so each is linked
 * to the one before it. */
static dyd_status insert_at(dyd_mesh *m, uint32_t v, uint32_t t) {
  size_t stacked = 0, spares = 0;
  uint32_t first = DYD_NONE, before = DYD_NONE;
  for (unsigned k = 3; k-- > 0;) m->stack[stacked++] = m->tri[t].n[k];
  m->spare[spares++] = t;
  while (stacked) {
    uint32_t h = m->stack[--stacked];
    dyd_tri *o = &m->tri[h >> 2];
    unsigned k = h & 3;
    uint32_t b = o->v[dyd_next(k)], a = o->v[dyd_prev(k)];
    if (incircle(m, o->v[k], b, a, v) > 0) {
      if (!room(m, stacked, spares)) return DYD_E_NOMEM;
      m->stack[stacked++] = o->n[dyd_prev(k)];
      m->stack[stacked++] = o->n[dyd_next(k)];
      m->spare[spares++] = h >> 2;
      continue;
    }
    uint32_t q = spares ? m->spare[--spares] : m->count++;
    m->tri[q] = (dyd_tri){{v, a, b}, {h, DYD_NONE, 4 * before + 1}};
    o->n[k] = 4 * q;
    if (before == DYD_NONE)
      first = q;
    else
      m->tri[before].n[1] = 4 * q + 2;
    before = q;
  }
  m->tri[first].n[2] = 4 * before + 1;
  m->tri[before].n[1] = 4 * first + 2;
  m->hint = before;
  return DYD_OK;
}

/* The vertex of t that has the same representative as v, or DYD_NONE. */
static uint32_t twin_of(dyd_mesh *m, uint32_t v, uint32_t t) {
  for (unsigned k = 0; k < 3; k++) {
    uint32_t w = m->tri[t].v[k];
    if (w != m->n && m->xy[w].x == m->xy[v].x && m->xy[w].y == m->xy[v].y && dyd_mesh_same(m, v, w)) return w;
  }
  return DYD_NONE;
}

static dyd_status insert(dyd_mesh *m, uint32_t v) {
  for (;;) {
    uint32_t t = dyd_mesh_locate(m, v);
    uint32_t same = twin_of(m, v, t);
    if (same == DYD_NONE) return insert_at(m, v, t);
    if (dyd_mesh_is_point(m, v)) return dyd_mesh_set_alias(m, v, same);
    dyd_status st = dyd_mesh_move(m, v, m->moved + 1);
    if (st != DYD_OK) return st;
  }
}

/* ---- the whole ---- */

static dyd_status insert_all(dyd_mesh *m, const uint32_t first[3], const volatile int *cancel) {
  for (uint32_t v = m->begin; v < m->end; v++) {
    if (v == first[0] || v == first[1] || v == first[2] || dyd_mesh_alias(m, v) != DYD_NONE) continue;
    if ((v & 1023) == 0 && dyd_flag_is_set(cancel)) return DYD_CANCELLED;
    dyd_status st = insert(m, v);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

dyd_status dyd_mesh_fill(dyd_mesh *m, const volatile int *cancel) {
  uint32_t first[3];
  dyd_status st = dyd_mesh_first_triangle(first, m);
  if (st != DYD_OK || m->collinear) return st;
  if (!m->tri) m->tri = dyd_alloc(2 * (size_t)m->n + 2, sizeof *m->tri);
  if (!m->tri || !room(m, 61, 63)) return DYD_E_NOMEM;
  dyd_mesh_put_first(m, first);
  return insert_all(m, first, cancel);
}

static dyd_status prepare(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter,
                          dyd_delaunay_counters *counters) {
  *m = (dyd_mesh){.reps = reps,
                  .local = local,
                  .n = n,
                  .end = n,
                  .strips = {1, {0, n}},
                  .no_filter = no_filter,
                  .counters = counters,
                  .beyond = counters->integer + counters->exact};
  return dyd_mesh_coordinates(m);
}

dyd_status dyd_mesh_build(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter,
                          dyd_delaunay_counters *counters, const volatile int *cancel) {
  dyd_status st = prepare(m, reps, local, n, no_filter, counters);
  if (st == DYD_OK) st = dyd_mesh_fill(m, cancel);
  if (st != DYD_OK) dyd_mesh_clear(m);
  return st;
}

dyd_status dyd_mesh_build_strips(dyd_mesh *m, dyd_reps *reps, const dyd_strips *strips, bool no_filter,
                                 dyd_delaunay_counters *counters, const volatile int *cancel, unsigned threads) {
  bool joined = false;
  dyd_status st = prepare(m, reps, NULL, reps->n, no_filter, counters);
  if (st == DYD_OK && dyd_strips_are_apart(reps, strips))
    st = dyd_mesh_join_strips(&joined, m, strips, cancel, threads);
  if (st == DYD_OK && !joined) st = dyd_mesh_fill(m, cancel);
  if (st != DYD_OK) dyd_mesh_clear(m);
  return st;
}

/* Tests that were not passed on were answered by a filter. */
void dyd_mesh_count(dyd_mesh *m) {
  uint64_t beyond = m->counters->integer + m->counters->exact - m->beyond;
  if (!m->no_filter && m->asked > beyond) m->counters->filter += m->asked - beyond;
  m->beyond = m->counters->integer + m->counters->exact;
  m->asked = 0;
}

void dyd_mesh_trim(dyd_mesh *m) {
  if (m->counters) dyd_mesh_count(m);
  dyd_fixed_free(m->fixed);
  free(m->stack);
  free(m->spare);
  m->fixed = NULL;
  m->exact_s = -1;
  m->no_fixed = true; /* later questions are few, and the grid would cost O(n) */
  m->stack = m->spare = NULL;
  m->stack_cap = m->spare_cap = 0;
}

void dyd_mesh_clear(dyd_mesh *m) {
  dyd_mesh_trim(m);
  free(m->own_xy);
  free(m->tri);
  free(m->alias);
  memset(m, 0, sizeof *m);
}
