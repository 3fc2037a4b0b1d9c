/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The statuses of all pairs of a case, and the classical predicates of exact points. */
#include "oracle/oracle.h"
#include <string.h>

static unsigned char pair_status(orc_pool *p, const orc_case *c, size_t i, size_t j, bool points) {
  size_t mark = orc_mark(p);
  unsigned char status = ORC_ILLEGAL;
  if (orc_legal(NULL, NULL, p, c, i, j))
    status = ORC_LEGAL;
  else if (orc_possible(p, c, i, j))
    status = points ? ORC_TIE : ORC_INDETERMINATE;
  orc_release(p, mark);
  return status;
}

void orc_statuses(orc_table *out, orc_pool *p, const orc_case *c) {
  size_t order[ORC_MAX], place[ORC_MAX], n = 0;
  orc_case unique;
  orc_case_init(&unique);
  for (size_t i = 0; i < c->n; i++) {
    size_t stands = orc_case_alias(c, i);
    place[i] = stands == i ? n : place[stands];
    if (stands == i) order[n++] = i;
  }
  orc_case_permute(&unique, c, order, n);
  bool points = orc_case_all_points(c);
  unsigned char small[ORC_MAX][ORC_MAX];
  memset(small, ORC_ILLEGAL, sizeof small);
  for (size_t i = 0; i < n; i++)
    for (size_t j = i + 1; j < n; j++) small[i][j] = small[j][i] = pair_status(p, &unique, i, j, points);
  out->n = c->n;
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = 0; j < c->n; j++) out->status[i][j] = small[place[i]][place[j]];
  orc_case_clear(&unique);
}

/* ---- exact points ---- */

static mpq_srcptr dot(orc_pool *p, mpq_srcptr ax, mpq_srcptr ay, mpq_srcptr bx, mpq_srcptr by) {
  return orc_add(p, orc_mul(p, ax, bx), orc_mul(p, ay, by));
}

/* Centre c = m + t n, m the middle and n the normal of ij. |c-k|^2 - |c-i|^2 = value - t slope with
 * value = |m-k|^2 - |m-i|^2 and slope = 2 n.(k-i). */
static void half_line(mpq_srcptr *value, mpq_srcptr *slope, orc_pool *p, const orc_rect *i, const orc_rect *j,
                      const orc_rect *k) {
  mpq_srcptr mx = orc_mid(p, i->e[0], j->e[0]), my = orc_mid(p, i->e[2], j->e[2]);
  mpq_srcptr nx = orc_sub(p, i->e[2], j->e[2]), ny = orc_sub(p, j->e[0], i->e[0]);
  mpq_srcptr kx = orc_sub(p, k->e[0], mx), ky = orc_sub(p, k->e[2], my);
  mpq_srcptr ix = orc_sub(p, i->e[0], mx), iy = orc_sub(p, i->e[2], my);
  *value = orc_sub(p, dot(p, kx, ky, kx, ky), dot(p, ix, iy, ix, iy));
  *slope = orc_twice(p, dot(p, nx, ny, orc_sub(p, k->e[0], i->e[0]), orc_sub(p, k->e[2], i->e[2])));
}

/* The centres t with value - t slope >= 0 for all sites: [lo,hi], with closed ends at infinity; plus and minus
 * say if t = +-infinity is allowed; strict if some t has > 0 for all sites. */
int orc_classical(orc_pool *p, const orc_case *points, size_t i, size_t j) {
  mpq_srcptr lo = NULL, hi = NULL, value = NULL, slope = NULL;
  bool plus = true, minus = true, finite = true, strict = true;
  size_t mark = orc_mark(p);
  for (size_t k = 0; k < points->n; k++) {
    if (k == i || k == j) continue;
    half_line(&value, &slope, p, &points->rect[i], &points->rect[j], &points->rect[k]);
    int side = mpq_sgn(slope);
    if (side > 0) plus = false;
    if (side < 0) minus = false;
    if (side == 0) finite = finite && mpq_sgn(value) >= 0, strict = strict && mpq_sgn(value) > 0;
    if (side == 0) continue;
    mpq_srcptr end = orc_div(p, value, slope);
    if (side > 0 && (!hi || mpq_cmp(end, hi) < 0)) hi = end;
    if (side < 0 && (!lo || mpq_cmp(end, lo) > 0)) lo = end;
  }
  int order = lo && hi ? mpq_cmp(lo, hi) : -1;
  orc_release(p, mark);
  if (finite && strict && order < 0) return ORC_LEGAL;
  return plus || minus || (finite && order <= 0) ? ORC_TIE : ORC_ILLEGAL;
}

int orc_turn(orc_pool *p, const orc_rect *a, const orc_rect *b, const orc_rect *c) {
  mpq_srcptr bx = orc_sub(p, b->e[0], a->e[0]), by = orc_sub(p, b->e[2], a->e[2]);
  mpq_srcptr cx = orc_sub(p, c->e[0], a->e[0]), cy = orc_sub(p, c->e[2], a->e[2]);
  return mpq_cmp(orc_mul(p, bx, cy), orc_mul(p, by, cx));
}

/* The determinant of the lifted differences to d. */
int orc_in_circle(orc_pool *p, const orc_rect *a, const orc_rect *b, const orc_rect *c, const orc_rect *d) {
  const orc_rect *v[3] = {a, b, c};
  mpq_srcptr x[3], y[3], z[3], det = orc_si(p, 0, 1);
  for (size_t k = 0; k < 3; k++) {
    x[k] = orc_sub(p, v[k]->e[0], d->e[0]);
    y[k] = orc_sub(p, v[k]->e[2], d->e[2]);
    z[k] = dot(p, x[k], y[k], x[k], y[k]);
  }
  for (size_t k = 0; k < 3; k++) {
    size_t m = (k + 1) % 3, n = (k + 2) % 3;
    mpq_srcptr minor = orc_sub(p, orc_mul(p, x[m], y[n]), orc_mul(p, y[m], x[n]));
    det = orc_add(p, det, orc_mul(p, z[k], minor));
  }
  return mpq_sgn(det);
}
