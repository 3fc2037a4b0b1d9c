/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Every place on the bisector of i and j that is as far from k as from l, every one in line with i or j and some k, and
 * both ends; each is a centre whatever it is, so the largest value is the supremum. */
#include "tolerance/brute.h"

static void set_difference(mpq_ptr out, double a, double b) {
  mpq_t t;
  mpq_init(t);
  mpq_set_d(out, a);
  mpq_set_d(t, b);
  mpq_sub(out, out, t);
  mpq_clear(t);
}

static void root_of(mpf_ptr out, mpq_srcptr q) {
  mpf_set_q(out, q);
  mpf_sqrt(out, out);
}

/* Squared distance of p_k to the centre. */
static void distance2(mpq_ptr out, mpq_t c[2], const brute_points *p, size_t k) {
  mpq_t d;
  mpq_init(d);
  mpq_set_d(out, p->x[k]);
  mpq_sub(out, out, c[0]);
  mpq_mul(out, out, out);
  mpq_set_d(d, p->y[k]);
  mpq_sub(d, d, c[1]);
  mpq_mul(d, d, d);
  mpq_add(out, out, d);
  mpq_clear(d);
}

static void keep_larger(mpf_ptr best, bool *any, mpf_srcptr now) {
  if (!*any || mpf_cmp(now, best) > 0) mpf_set(best, now);
  *any = true;
}

static void try_centre(mpf_ptr best, bool *any, mpq_t c[2], const brute_points *p, size_t i, size_t j) {
  mpq_t d, least;
  mpf_t f, g;
  bool found = false;
  mpq_inits(d, least, NULL);
  mpf_init2(f, BRUTE_BITS);
  mpf_init2(g, BRUTE_BITS);
  for (size_t k = 0; k < p->n; k++) {
    if (k == i || k == j) continue;
    distance2(d, c, p, k);
    if (!found || mpq_cmp(d, least) < 0) mpq_set(least, d);
    found = true;
  }
  root_of(f, least);
  distance2(d, c, p, i);
  distance2(least, c, p, j);
  root_of(g, mpq_cmp(d, least) > 0 ? d : least);
  mpf_sub(f, f, g);
  keep_larger(best, any, f);
  mpq_clears(d, least, NULL);
  mpf_clears(f, g, NULL);
}

/* c = (p_i + p_j) / 2 + s turned(p_j - p_i) */
static void try_place(mpf_ptr best, bool *any, mpq_srcptr s, const brute_points *p, size_t i, size_t j) {
  mpq_t c[2], d, half;
  mpq_inits(c[0], c[1], d, half, NULL);
  mpq_set_ui(half, 1, 2);
  for (int axis = 0; axis < 2; axis++) {
    const double *at = axis ? p->y : p->x, *other = axis ? p->x : p->y;
    set_difference(c[axis], at[j], at[i]);
    mpq_mul(c[axis], c[axis], half);
    mpq_set_d(d, at[i]);
    mpq_add(c[axis], c[axis], d);
    set_difference(d, axis ? other[j] : other[i], axis ? other[i] : other[j]);
    mpq_mul(d, d, s);
    mpq_add(c[axis], c[axis], d);
  }
  try_centre(best, any, c, p, i, j);
  mpq_clears(c[0], c[1], d, half, NULL);
}

/* along = (p_k - p_i).J, off = J'.(p_k - p_i), size = |p_k - p_i|^2, jj = |J|^2 */
static void measure(mpq_ptr along, mpq_ptr off, mpq_ptr size, mpq_ptr jj, const brute_points *p, size_t i, size_t j,
                    size_t k) {
  mpq_t x, y, jx, jy, t;
  mpq_inits(x, y, jx, jy, t, NULL);
  set_difference(x, p->x[k], p->x[i]);
  set_difference(y, p->y[k], p->y[i]);
  set_difference(jx, p->x[j], p->x[i]);
  set_difference(jy, p->y[j], p->y[i]);
  mpq_mul(along, x, jx);
  mpq_mul(t, y, jy);
  mpq_add(along, along, t);
  mpq_mul(off, jx, y);
  mpq_mul(t, jy, x);
  mpq_sub(off, off, t);
  mpq_mul(size, x, x);
  mpq_mul(t, y, y);
  mpq_add(size, size, t);
  mpq_mul(jj, jx, jx);
  mpq_mul(t, jy, jy);
  mpq_add(jj, jj, t);
  mpq_clears(x, y, jx, jy, t, NULL);
}

/* In line with k and i, or with k and j: s = off / (2 along), or -off / (2 (along - jj)); as far from k as from l. */
static void try_places(mpf_ptr best, bool *any, const brute_points *p, size_t i, size_t j, size_t k) {
  mpq_t a, o, z, jj, b, u, m, s;
  mpq_inits(a, o, z, jj, b, u, m, s, NULL);
  measure(a, o, z, jj, p, i, j, k);
  mpq_sub(z, z, a);
  for (size_t l = 0; l < p->n; l++) {
    if (l == i || l == j || l == k) continue;
    measure(b, u, m, jj, p, i, j, l);
    mpq_sub(m, m, b);
    mpq_sub(s, z, m);
    mpq_sub(u, o, u);
    mpq_add(u, u, u);
    if (mpq_sgn(u) == 0) continue;
    mpq_div(s, s, u);
    try_place(best, any, s, p, i, j);
  }
  mpq_add(s, a, a);
  if (mpq_sgn(s)) {
    mpq_div(s, o, s);
    try_place(best, any, s, p, i, j);
  }
  mpq_sub(s, jj, a);
  mpq_add(s, s, s);
  if (mpq_sgn(s)) {
    mpq_div(s, o, s);
    try_place(best, any, s, p, i, j);
  }
  mpq_clears(a, o, z, jj, b, u, m, s, NULL);
}

/* Towards an end |c - p_k| - |c - p_i| tends to the distance of k from the line ij, with the sign of its side. */
static void try_end(mpf_ptr best, bool *any, const brute_points *p, size_t i, size_t j, int side) {
  mpq_t a, o, z, jj, least;
  mpf_t f, g;
  bool found = false;
  mpq_inits(a, o, z, jj, least, NULL);
  for (size_t k = 0; k < p->n; k++) {
    if (k == i || k == j) continue;
    measure(a, o, z, jj, p, i, j, k);
    if (side < 0) mpq_neg(o, o);
    if (!found || mpq_cmp(o, least) < 0) mpq_set(least, o);
    found = true;
  }
  mpf_init2(f, BRUTE_BITS);
  mpf_init2(g, BRUTE_BITS);
  mpf_set_q(f, least);
  root_of(g, jj);
  mpf_div(f, f, g);
  keep_larger(best, any, f);
  mpf_clears(f, g, NULL);
  mpq_clears(a, o, z, jj, least, NULL);
}

bool brute_width(mpf_ptr out, const brute_points *p, size_t i, size_t j) {
  bool any = false;
  for (size_t k = 0; k < p->n; k++)
    if (k != i && k != j) try_places(out, &any, p, i, j, k);
  if (p->n > 2)
    for (int side = -1; side <= 1; side += 2) try_end(out, &any, p, i, j, side);
  return any;
}
