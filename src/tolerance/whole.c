/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The tolerance of the whole: the least death, and the least motion that takes a corner off the hull [TOL-5]. */
#include "tolerance/roots.h"
#include "tolerance/state.h"

/* The vectors a = u - v, b = w - u of three corners u, v, w. */
static dyd_status corner_vectors(mpq_t a[2], mpq_t b[2], const dyd_tolerance *t, const uint32_t v[3]) {
  dyd_rect r[3];
  mpq_t other, p;
  dyd_status st = DYD_OK;
  mpq_inits(other, p, NULL);
  for (int k = 0; k < 3; k++) {
    dyd_rect_init(&r[k]);
    if (st == DYD_OK) st = dyd_sites_get(&r[k], t->sk->reps.sites, t->sk->reps.site[v[k]]);
  }
  for (int axis = 0; axis < 2; axis++) {
    dyd_interval_get_q(a[axis], other, axis ? &r[0].y : &r[0].x);
    dyd_interval_get_q(p, other, axis ? &r[2].y : &r[2].x);
    mpq_sub(b[axis], p, a[axis]);
    dyd_interval_get_q(p, other, axis ? &r[1].y : &r[1].x);
    mpq_sub(a[axis], a[axis], p);
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&r[k]);
  mpq_clears(other, p, NULL);
  return st;
}

static void inner_product(mpq_ptr out, mpq_t a[2], mpq_t b[2]) {
  mpq_t x;
  mpq_init(x);
  mpq_mul(out, a[0], b[0]);
  mpq_mul(x, a[1], b[1]);
  mpq_add(out, out, x);
  mpq_clear(x);
}

/* Squared distance of v to the line uw: |a x b|^2 / |b|^2; where points move in squares, |b| is the sum norm. */
static void distance2(mpq_ptr out, mpq_t a[2], mpq_t b[2], dyd_metric metric) {
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  mpq_mul(out, a[0], b[1]);
  mpq_mul(x, a[1], b[0]);
  mpq_sub(out, out, x);
  mpq_mul(out, out, out);
  if (metric == DYD_METRIC_BOX) {
    mpq_abs(x, b[0]);
    mpq_abs(y, b[1]);
    mpq_add(x, x, y);
    mpq_mul(x, x, x);
  } else {
    inner_product(x, b, b);
  }
  mpq_div(out, out, x);
  mpq_clears(x, y, NULL);
}

static void lower_whole(dyd_tolerance *t, double lo, double hi) {
  if (lo < t->lo) t->lo = lo;
  if (hi < t->hi) t->hi = hi;
}

/* Discs about u and w, of radius t times their weights, hold between them those about a + s b, 0 <= s <= 1, of radius t
 * (r_u + s (r_w - r_u)): that of v meets one of these from t^2 = min |a + s b|^2 / L^2 on, L = p + s q, p = r_v + r_u,
 * q = r_w - r_u. Between the ends that is at s = (q a.a - p a.b) / (p b.b - q a.b); at them v meets u or w, which takes
 * an edge. */
static void weighted_corner(double *lo, double *hi, const dyd_tolerance *t, const uint32_t v[3], mpq_t a[2],
                            mpq_t b[2]) {
  mpq_t p, q, s, x, y, zero;
  mpq_inits(p, q, s, x, y, zero, NULL);
  mpq_set_d(p, t->weight[v[0]]);
  mpq_set_d(q, t->weight[v[2]]);
  mpq_sub(q, q, p);
  mpq_set_d(x, t->weight[v[1]]);
  mpq_add(p, p, x);
  inner_product(x, a, b);
  mpq_mul(y, p, x);
  mpq_mul(x, q, x);
  inner_product(zero, a, a);
  mpq_mul(s, q, zero);
  mpq_sub(s, s, y);
  inner_product(zero, b, b);
  mpq_mul(y, p, zero);
  mpq_sub(y, y, x);
  if (mpq_sgn(y)) mpq_div(s, s, y);
  if (mpq_sgn(y) && mpq_sgn(s) >= 0 && mpq_cmp_si(s, 1, 1) <= 0) {
    mpq_mul(q, q, s);
    mpq_add(p, p, q);
    for (int axis = 0; axis < 2; axis++) {
      mpq_mul(x, b[axis], s);
      mpq_add(a[axis], a[axis], x);
    }
    inner_product(x, a, a);
    mpq_mul_2exp(x, x, 2);
    mpq_mul(p, p, p);
    mpq_set_ui(zero, 0, 1);
    if (mpq_sgn(p)) {
      mpq_div(x, x, p);
      dyd_roots_half(lo, hi, x, zero);
      *lo *= 1 - 0x1p-51; /* weights may be the doubles next to what is meant */
      *hi *= 1 + 0x1p-50;
    }
  }
  mpq_clears(p, q, s, x, y, zero, NULL);
}

dyd_status dyd_hull_corner(double *lo, double *hi, const dyd_tolerance *t, dyd_half_edge h, bool weighted) {
  const dyd_mesh *m = &t->sk->mesh;
  uint32_t v[3] = {dyd_hull_origin(m, h), dyd_hull_target(m, h), dyd_hull_target(m, dyd_hull_following(m, h))};
  mpq_t a[2], b[2], d, zero;
  *lo = *hi = HUGE_VAL;
  /* uw is an edge exactly when v has no other neighbours */
  if (dyd_degree(t, v[1]) == 3) return DYD_OK;
  mpq_inits(a[0], a[1], b[0], b[1], d, zero, NULL);
  dyd_status st = corner_vectors(a, b, t, v);
  if (st == DYD_OK && weighted)
    weighted_corner(lo, hi, t, v, a, b);
  else if (st == DYD_OK) {
    distance2(d, a, b, t->options.metric);
    dyd_roots_half(lo, hi, d, zero);
  }
  mpq_clears(a[0], a[1], b[0], b[1], d, zero, NULL);
  return st;
}

dyd_status dyd_whole(dyd_tolerance *t) {
  const dyd_mesh *m = &t->sk->mesh;
  dyd_status st = DYD_OK;
  t->lo = t->hi = HUGE_VAL;
  for (size_t k = 0; k < t->rows; k++)
    if (t->row[k].event != DYD_EVENT_BIRTH) lower_whole(t, t->row[k].lo, t->row[k].hi);
  if (t->edges_left) t->lo = 0;
  if (t->edges_left || dyd_is_line(t->pd)) return DYD_OK;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  do {
    double lo, hi;
    st = dyd_hull_corner(&lo, &hi, t, h, t->weight);
    if (st == DYD_OK) lower_whole(t, lo, hi);
    h = dyd_hull_following(m, h);
  } while (st == DYD_OK && h != first);
  return st;
}
