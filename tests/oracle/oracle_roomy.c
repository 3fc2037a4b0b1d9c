/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How much room the witnesses of a legal pair have: only for judging an engine that gives up at a floor. */
#include "oracle/oracle.h"

/* The largest scale * 2^-k, k >= -2, such that the point that far from w in direction (dx,dy) is a witness;
 * 0 when none is up to k = bits. */
static mpq_srcptr reach(orc_pool *p, const orc_case *c, size_t i, size_t j, const mpq_srcptr w[2], mpq_srcptr scale,
                        long dx, long dy, long bits) {
  for (long k = -2; k <= bits; k++) {
    mpq_ptr t = orc_new(p);
    mpq_mul_2exp(t, scale, 2);
    mpq_div_2exp(t, t, (mp_bitcnt_t)(k + 2));
    mpq_srcptr x = orc_add(p, w[0], orc_mul(p, t, orc_si(p, dx, 1)));
    mpq_srcptr y = orc_add(p, w[1], orc_mul(p, t, orc_si(p, dy, 1)));
    if (orc_is_witness(p, c, i, j, x, y)) return t;
  }
  return orc_si(p, 0, 1);
}

static const long direction[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

/* A number between the distance from w to the farthest corner of R_i and half of it, or so. */
static mpq_srcptr size_of(orc_pool *p, const orc_case *c, size_t i, const mpq_srcptr w[2]) {
  mpq_srcptr best = orc_si(p, 0, 1);
  for (size_t k = 0; k < 4; k++) {
    mpq_ptr d = orc_new(p);
    mpq_sub(d, c->rect[i].e[k], w[k / 2]);
    mpq_abs(d, d);
    if (mpq_cmp(d, best) > 0) best = d;
  }
  return best;
}

bool orc_is_roomy(orc_pool *p, const orc_case *c, size_t i, size_t j, mpq_srcptr wx, mpq_srcptr wy, long bits) {
  mpq_srcptr w[2] = {wx, wy}, scale = size_of(p, c, i, w);
  for (size_t round = 0; round < 12; round++) {
    const long *d = direction[round % 4];
    mpq_srcptr up = reach(p, c, i, j, w, scale, d[0], d[1], bits + 20);
    mpq_srcptr down = reach(p, c, i, j, w, scale, -d[0], -d[1], bits + 20);
    mpq_srcptr shift = orc_mul(p, orc_sub(p, up, down), orc_si(p, 1, 2));
    mpq_srcptr x = orc_add(p, w[0], orc_mul(p, shift, orc_si(p, d[0], 1)));
    mpq_srcptr y = orc_add(p, w[1], orc_mul(p, shift, orc_si(p, d[1], 1)));
    if (orc_is_witness(p, c, i, j, x, y)) w[0] = x, w[1] = y;
  }
  for (size_t k = 0; k < 8; k++) {
    long s = k < 4 ? 1 : -1;
    if (mpq_sgn(reach(p, c, i, j, w, scale, s * direction[k % 4][0], s * direction[k % 4][1], bits)) == 0) return false;
  }
  return true;
}
