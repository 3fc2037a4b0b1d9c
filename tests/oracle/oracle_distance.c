/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* ds and dl by their definitions, and the pieces on which they are smooth (mathematics: section 1). */
#include "oracle/oracle.h"

size_t orc_pieces_closest(orc_piece out[3], orc_pool *p, const mpq_t *e) {
  (void)p;
  if (mpq_equal(e[0], e[1])) {
    out[0] = (orc_piece){NULL, NULL, e[0]};
    return 1;
  }
  out[0] = (orc_piece){NULL, e[0], e[0]};
  out[1] = (orc_piece){e[0], e[1], NULL};
  out[2] = (orc_piece){e[1], NULL, e[1]};
  return 3;
}

size_t orc_pieces_farthest(orc_piece out[2], orc_pool *p, const mpq_t *e) {
  if (mpq_equal(e[0], e[1])) {
    out[0] = (orc_piece){NULL, NULL, e[0]};
    return 1;
  }
  mpq_srcptr middle = orc_mid(p, e[0], e[1]);
  out[0] = (orc_piece){NULL, middle, e[1]};
  out[1] = (orc_piece){middle, NULL, e[0]};
  return 2;
}

bool orc_range_cut(mpq_srcptr *lo, mpq_srcptr *hi, orc_piece with) {
  if (with.lo && (!*lo || mpq_cmp(with.lo, *lo) > 0)) *lo = with.lo;
  if (with.hi && (!*hi || mpq_cmp(with.hi, *hi) < 0)) *hi = with.hi;
  return !*lo || !*hi || mpq_cmp(*lo, *hi) < 0;
}

static orc_alg closest2(orc_pool *p, orc_alg t, const mpq_t *e) {
  if (orc_alg_cmp_q(p, t, e[0]) <= 0) return orc_alg_sqr(p, orc_alg_sub_q(p, t, e[0]));
  if (orc_alg_cmp_q(p, t, e[1]) >= 0) return orc_alg_sqr(p, orc_alg_sub_q(p, t, e[1]));
  return orc_alg_q(p, orc_si(p, 0, 1));
}

static orc_alg farthest2(orc_pool *p, orc_alg t, const mpq_t *e) {
  bool high = orc_alg_cmp_q(p, t, orc_mid(p, e[0], e[1])) >= 0;
  return orc_alg_sqr(p, orc_alg_sub_q(p, t, high ? e[0] : e[1]));
}

orc_alg orc_ds2(orc_pool *p, orc_point c, const orc_rect *r) {
  return orc_alg_add(p, closest2(p, c.x, &r->e[0]), closest2(p, c.y, &r->e[2]));
}

orc_alg orc_dl2(orc_pool *p, orc_point c, const orc_rect *r) {
  return orc_alg_add(p, farthest2(p, c.x, &r->e[0]), farthest2(p, c.y, &r->e[2]));
}

bool orc_is_free(orc_pool *p, const orc_case *c, size_t i, size_t j, orc_point at) {
  orc_alg di = orc_ds2(p, at, &c->rect[i]), dj = orc_ds2(p, at, &c->rect[j]);
  for (size_t k = 0; k < c->n; k++) {
    if (k == i || k == j) continue;
    orc_alg dk = orc_dl2(p, at, &c->rect[k]);
    if (orc_alg_sgn(p, orc_alg_sub(p, di, dk)) > 0 || orc_alg_sgn(p, orc_alg_sub(p, dj, dk)) > 0) return false;
  }
  return true;
}

bool orc_is_witness(orc_pool *p, const orc_case *c, size_t i, size_t j, mpq_srcptr x, mpq_srcptr y) {
  size_t mark = orc_mark(p);
  orc_point at = {orc_alg_q(p, x), orc_alg_q(p, y)};
  mpq_srcptr di = orc_dl2(p, at, &c->rect[i]).a, dj = orc_dl2(p, at, &c->rect[j]).a;
  bool good = true;
  for (size_t k = 0; k < c->n && good; k++) {
    size_t stands = orc_case_alias(c, k);
    if (stands == orc_case_alias(c, i) || stands == orc_case_alias(c, j)) continue;
    mpq_srcptr dk = orc_ds2(p, at, &c->rect[k]).a;
    good = mpq_cmp(di, dk) < 0 && mpq_cmp(dj, dk) < 0;
  }
  orc_release(p, mark);
  return good;
}
