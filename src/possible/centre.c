/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Possibly nearest sites at one dyadic point, exactly.
 *
 * If ds_i(c), ds_j(c) <= M(c), the least dl_k(c) of all k, then c is a centre of ij: possible [POS-1]. Any c will do;
 * it is rounded to a step below the widths of the rectangles it was made from, or below their last bits if they are
 * points. */
#include "possible/centre.h"

#include "base/alloc.h"
#include "legal/cut_filter.h"
#include <dyadel/predicate.h>

#include <math.h>
#include <stdlib.h>

enum { FINER = 8 };

/* Exponent of a step well below the width of a, or below the last bit of a point. */
static int64_t step_of(const dyd_interval *a) {
  if (!dyd_interval_is_point(a)) return -dyd_interval_bits(a) - FINER;
  return mpz_sgn(a->lo.man) ? a->lo.exp - (int64_t)mpz_sizeinbase(a->den, 2) - FINER : 0;
}

static int64_t least(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* floor((a / d) / 2^e) 2^e, d > 0 */
static dyd_status rounded(dyd_dyadic *out, const mpz_t a, const mpz_t d, int64_t e) {
  mpz_t t, u;
  mpz_inits(t, u, NULL);
  mpz_mul_2exp(t, a, (mp_bitcnt_t)(e < 0 ? -e : 0));
  mpz_mul_2exp(u, d, (mp_bitcnt_t)(e > 0 ? e : 0));
  mpz_fdiv_q(t, t, u);
  dyd_status st = dyd_dyadic_set_z_2exp(out, t, e);
  mpz_clears(t, u, NULL);
  return st;
}

/* *found: c is next to the centre of the circle; false: the representatives are collinear. */
static dyd_status round_centre(bool *found, dyd_point *c, const dyd_delaunay *pd, const uint32_t v[3]) {
  static const dyd_touch touch[3] = {DYD_FARTHEST, DYD_CLOSEST, DYD_CLOSEST};
  dyd_rect point[3], r;
  const dyd_rect *const at[3] = {&point[0], &point[1], &point[2]};
  dyd_circle circle;
  int64_t e = INT64_MAX;
  dyd_status st = DYD_OK;
  dyd_rect_init(&r);
  dyd_circle_init(&circle);
  for (int k = 0; k < 3; k++) dyd_rect_init(&point[k]);
  for (int k = 0; k < 3 && st == DYD_OK; k++) {
    st = dyd_reps_get(&point[k], &pd->reps, v[k]);
    if (st == DYD_OK) st = dyd_sites_get(&r, pd->sites, pd->reps.site[v[k]]);
    if (st == DYD_OK) e = least(e, least(step_of(&r.x), step_of(&r.y)));
  }
  *found = st == DYD_OK && dyd_critical_circle(&circle, at, touch) == DYD_OK && mpz_sgn(circle.c) == 0;
  if (*found) st = rounded(&c->x, circle.ax, circle.d, e);
  if (*found && st == DYD_OK) st = rounded(&c->y, circle.ay, circle.d, e);
  if (st == DYD_E_RANGE) {
    st = DYD_OK;
    *found = false;
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&point[k]);
  dyd_circle_clear(&circle);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_centre_between(bool *found, dyd_point *c, const dyd_delaunay *pd, uint32_t i, uint32_t j,
                              const uint32_t across[2]) {
  dyd_point other;
  dyd_point_init(&other);
  const uint32_t v[2][3] = {{i, j, across[0]}, {i, j, across[1]}};
  dyd_status st = round_centre(found, c, pd, v[0]);
  if (st == DYD_OK && *found) st = round_centre(found, &other, pd, v[1]);
  if (st == DYD_OK && *found) st = dyd_dyadic_add(&c->x, &c->x, &other.x);
  if (st == DYD_OK && *found) st = dyd_dyadic_add(&c->y, &c->y, &other.y);
  if (st == DYD_OK && *found) st = dyd_dyadic_mul_2exp(&c->x, &c->x, -1);
  if (st == DYD_OK && *found) st = dyd_dyadic_mul_2exp(&c->y, &c->y, -1);
  dyd_point_clear(&other);
  if (st != DYD_E_RANGE) return st;
  *found = false;
  return DYD_OK;
}

typedef struct meeting {
  uint32_t *vertex;
  size_t count, cap, most;
  bool full; /* no memory */
} meeting;

static bool meet(void *context, uint32_t k) {
  meeting *m = context;
  m->full = !dyd_reserve((void **)&m->vertex, &m->cap, m->count + 1, sizeof *m->vertex);
  if (!m->full) m->vertex[m->count++] = k;
  return !m->full && m->count <= m->most;
}

/* Everybody who may have ds <= M: not farther than dl of the vertex v. Nobody if they are too many. */
static dyd_status gather(meeting *m, const dyd_delaunay *pd, const dyd_point *c, uint32_t v) {
  dyd_bbox box;
  dyd_cut_box(&box, c);
  double radius2 = dyd_dl2_upper(&box, &pd->box[v]);
  if (isnan(radius2) || pd->options.no_filter) radius2 = INFINITY;
  dyd_tree_near(&pd->tree, &box, &radius2, meet, m);
  if (m->count > m->most) m->count = 0;
  return m->full ? DYD_E_NOMEM : DYD_OK;
}

/* Leaves those with ds <= least dl. */
static dyd_status choose(meeting *m, const dyd_delaunay *pd, const dyd_point *c) {
  dyd_rect best, r;
  dyd_status st = DYD_OK;
  size_t kept = 0;
  dyd_rect_init(&best);
  dyd_rect_init(&r);
  for (size_t k = 0; k < m->count && st == DYD_OK; k++) {
    st = dyd_sites_get(&r, pd->sites, pd->reps.site[m->vertex[k]]);
    if (st == DYD_OK && (k == 0 || dyd_compare_distance(c, &r, DYD_FARTHEST, &best, DYD_FARTHEST) < 0))
      dyd_rect_swap(&best, &r);
  }
  for (size_t k = 0; k < m->count && st == DYD_OK; k++) {
    st = dyd_sites_get(&r, pd->sites, pd->reps.site[m->vertex[k]]);
    if (st == DYD_OK && dyd_compare_distance(c, &r, DYD_CLOSEST, &best, DYD_FARTHEST) <= 0)
      m->vertex[kept++] = m->vertex[k];
  }
  m->count = kept;
  dyd_rect_clear(&r);
  dyd_rect_clear(&best);
  return st;
}

dyd_status dyd_centre_shows(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, const uint32_t v[3],
                            size_t most) {
  meeting m = {.most = most};
  dyd_point c;
  bool found;
  dyd_point_init(&c);
  dyd_status st = round_centre(&found, &c, pd, v);
  if (st == DYD_OK && found) st = gather(&m, pd, &c, v[0]);
  if (st == DYD_OK) st = choose(&m, pd, &c);
  dyd_point_clear(&c);
  if (st != DYD_OK || m.count == 0) {
    free(m.vertex);
    m = (meeting){0};
  }
  *vertex = m.vertex;
  *count = m.count;
  return st;
}
