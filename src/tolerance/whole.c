/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The tolerance of the whole: the least death, and the least motion that takes a corner off the hull [TOL-5]. */
#include "tolerance/roots.h"
#include "tolerance/state.h"

/* |cross|^2 / |w - u|^2 of three points, in their own units: the squared distance of v to the line uw. */
static dyd_status distance2(mpq_ptr out, const dyd_tolerance *t, const uint32_t v[3]) {
  dyd_rect r[3];
  mpq_t p[3][2], other, x, y;
  dyd_status st = DYD_OK;
  mpq_inits(other, x, y, NULL);
  for (int k = 0; k < 3; k++) {
    mpq_inits(p[k][0], p[k][1], NULL);
    dyd_rect_init(&r[k]);
    if (st == DYD_OK) st = dyd_sites_get(&r[k], t->sk->reps.sites, t->sk->reps.site[v[k]]);
    dyd_interval_get_q(p[k][0], other, &r[k].x);
    dyd_interval_get_q(p[k][1], other, &r[k].y);
  }
  for (int k = 1; k >= -1; k -= 2) /* relative to u */
    for (int axis = 0; axis < 2; axis++) mpq_sub(p[k > 0 ? 1 : 2][axis], p[k > 0 ? 1 : 2][axis], p[0][axis]);
  mpq_mul(x, p[1][0], p[2][1]);
  mpq_mul(y, p[1][1], p[2][0]);
  mpq_sub(out, x, y);
  mpq_mul(out, out, out);
  mpq_mul(x, p[2][0], p[2][0]);
  mpq_mul(y, p[2][1], p[2][1]);
  mpq_add(x, x, y);
  mpq_div(out, out, x);
  for (int k = 0; k < 3; k++) {
    dyd_rect_clear(&r[k]);
    mpq_clears(p[k][0], p[k][1], NULL);
  }
  mpq_clears(other, x, y, NULL);
  return st;
}

static void lower_whole(dyd_tolerance *t, double lo, double hi) {
  if (lo < t->lo) t->lo = lo;
  if (hi < t->hi) t->hi = hi;
}

dyd_status dyd_hull_corner(double *lo, double *hi, const dyd_tolerance *t, dyd_half_edge h) {
  const dyd_mesh *m = &t->sk->mesh;
  uint32_t v[3] = {dyd_hull_origin(m, h), dyd_hull_target(m, h), dyd_hull_target(m, dyd_hull_following(m, h))};
  mpq_t d, zero;
  *lo = *hi = HUGE_VAL;
  /* uw is an edge exactly when v has no other neighbours */
  if (t->degree[v[1]] == 3) return DYD_OK;
  mpq_inits(d, zero, NULL);
  dyd_status st = distance2(d, t, v);
  if (st == DYD_OK) dyd_roots_half(lo, hi, d, zero);
  mpq_clears(d, zero, NULL);
  return st;
}

dyd_status dyd_whole(dyd_tolerance *t) {
  const dyd_mesh *m = &t->sk->mesh;
  dyd_status st = DYD_OK;
  t->lo = t->hi = HUGE_VAL;
  for (size_t k = 0; k < t->rows; k++)
    if (t->row[k].event != DYD_EVENT_BIRTH) lower_whole(t, t->row[k].lo, t->row[k].hi);
  if (dyd_is_line(t->pd)) return DYD_OK;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  do {
    double lo, hi;
    st = dyd_hull_corner(&lo, &hi, t, h);
    if (st == DYD_OK) lower_whole(t, lo, hi);
    h = dyd_hull_following(m, h);
  } while (st == DYD_OK && h != first);
  return st;
}
