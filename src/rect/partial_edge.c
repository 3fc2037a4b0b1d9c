/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Convex hulls of two integer rectangles: area and disjointness.
 *
 * With w, h the sides of the box that bounds a and b, the hull is that box less one triangle at each of its corners
 * where neither rectangle reaches it: there the join of the two like corners cuts off a triangle with legs |dx|, |dy|.
 * At a corner of direction (s,t) the two like corners differ by (dx,dy) with s dx and t dy of opposite signs; when the
 * signs agree, one rectangle has the corner of the bounding box itself. So
 *     2 area = 2 w h - sum over corners of |dx dy| where s dx * t dy < 0.
 * The four triangles do not overlap: the legs on a side of the box lie on disjoint parts of it. */
#include "rect/irect.h"

static mpz_srcptr lesser_z(mpz_srcptr a, mpz_srcptr b) {
  return mpz_cmp(a, b) <= 0 ? a : b;
}
static mpz_srcptr larger_z(mpz_srcptr a, mpz_srcptr b) {
  return mpz_cmp(a, b) >= 0 ? a : b;
}

void dyd_irect_partial_edge_area2(mpz_ptr out, const dyd_irect *a, const dyd_irect *b) {
  mpz_t w, h;
  mpz_inits(w, h, NULL);
  mpz_sub(w, larger_z(a->x1, b->x1), lesser_z(a->x0, b->x0));
  mpz_sub(h, larger_z(a->y1, b->y1), lesser_z(a->y0, b->y0));
  mpz_mul(out, w, h);
  mpz_mul_2exp(out, out, 1);
  for (int corner = 0; corner < 4; corner++) {
    int right = corner & 1, upper = corner >> 1;
    mpz_sub(w, dyd_irect_end(b, 0, right), dyd_irect_end(a, 0, right));
    mpz_sub(h, dyd_irect_end(b, 1, upper), dyd_irect_end(a, 1, upper));
    int sign = mpz_sgn(w) * mpz_sgn(h) * (right == upper ? 1 : -1);
    if (sign >= 0) continue;
    mpz_mul(w, w, h);
    mpz_abs(w, w);
    mpz_sub(out, out, w);
  }
  mpz_clears(w, h, NULL);
}

/* out = largest value of nx x + ny y over r (side = 1) or smallest (side = 0). */
static void irect_support(mpz_ptr out, mpz_srcptr nx, mpz_srcptr ny, const dyd_irect *r, int side) {
  mpz_mul(out, nx, dyd_irect_end(r, 0, mpz_sgn(nx) >= 0 ? side : !side));
  mpz_addmul(out, ny, dyd_irect_end(r, 1, mpz_sgn(ny) >= 0 ? side : !side));
}

/* Is max n.(a u b) < min n.(c u d)?  u, v: scratch. */
static bool edge_precedes(mpz_srcptr nx, mpz_srcptr ny, const dyd_irect *const p[2], const dyd_irect *const q[2],
                          mpz_ptr u, mpz_ptr v) {
  for (int i = 0; i < 2; i++) {
    irect_support(u, nx, ny, p[i], 1);
    for (int j = 0; j < 2; j++) {
      irect_support(v, nx, ny, q[j], 0);
      if (mpz_cmp(u, v) >= 0) return false;
    }
  }
  return true;
}

static bool normal_separates(mpz_srcptr nx, mpz_srcptr ny, const dyd_irect *const p[2], const dyd_irect *const q[2],
                             mpz_ptr u, mpz_ptr v) {
  return edge_precedes(nx, ny, p, q, u, v) || edge_precedes(nx, ny, q, p, u, v);
}

/* The axes, by comparisons only. */
static bool edge_boxes_disjoint(const dyd_irect *const p[2], const dyd_irect *const q[2]) {
  return mpz_cmp(larger_z(p[0]->x1, p[1]->x1), lesser_z(q[0]->x0, q[1]->x0)) < 0 ||
         mpz_cmp(larger_z(q[0]->x1, q[1]->x1), lesser_z(p[0]->x0, p[1]->x0)) < 0 ||
         mpz_cmp(larger_z(p[0]->y1, p[1]->y1), lesser_z(q[0]->y0, q[1]->y0)) < 0 ||
         mpz_cmp(larger_z(q[0]->y1, q[1]->y1), lesser_z(p[0]->y0, p[1]->y0)) < 0;
}

bool dyd_irect_partial_edges_disjoint(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c, const dyd_irect *d) {
  const dyd_irect *p[2] = {a, b}, *q[2] = {c, d};
  if (edge_boxes_disjoint(p, q)) return true;
  mpz_t nx, ny, u, v;
  mpz_inits(nx, ny, u, v, NULL);
  bool disjoint = false;
  for (int join = 0; join < 8 && !disjoint; join++) {
    const dyd_irect *const *e = join < 4 ? p : q;
    int right = join & 1, upper = (join >> 1) & 1;
    mpz_sub(nx, dyd_irect_end(e[0], 1, upper), dyd_irect_end(e[1], 1, upper));
    mpz_sub(ny, dyd_irect_end(e[1], 0, right), dyd_irect_end(e[0], 0, right));
    disjoint = normal_separates(nx, ny, p, q, u, v);
  }
  mpz_clears(nx, ny, u, v, NULL);
  return disjoint;
}
