/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers of the oracle: rationals in a pool, and the field elements a + b sqrt(c). Slow, literal, exact.
 *
 * Shares no code with src: its only ground is mpq. Values are made once and never changed, so an element may be
 * used in as many places as one likes; orc_release gives back everything made since orc_mark. */
#ifndef DYD_TESTS_ORACLE_NUM_H
#define DYD_TESTS_ORACLE_NUM_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct orc_pool {
  mpq_t **block;
  size_t blocks, used;
} orc_pool;

void orc_pool_init(orc_pool *p);
void orc_pool_clear(orc_pool *p);
size_t orc_mark(const orc_pool *p);
void orc_release(orc_pool *p, size_t mark);

/* A fresh number with any value, to be filled at once by the caller. */
mpq_ptr orc_new(orc_pool *p);
mpq_srcptr orc_si(orc_pool *p, long num, unsigned long den);
mpq_srcptr orc_add(orc_pool *p, mpq_srcptr x, mpq_srcptr y);
mpq_srcptr orc_sub(orc_pool *p, mpq_srcptr x, mpq_srcptr y);
mpq_srcptr orc_mul(orc_pool *p, mpq_srcptr x, mpq_srcptr y);
/* y must not be 0. */
mpq_srcptr orc_div(orc_pool *p, mpq_srcptr x, mpq_srcptr y);
mpq_srcptr orc_sqr(orc_pool *p, mpq_srcptr x);
mpq_srcptr orc_neg(orc_pool *p, mpq_srcptr x);
mpq_srcptr orc_twice(orc_pool *p, mpq_srcptr x);
/* (x + y) / 2 */
mpq_srcptr orc_mid(orc_pool *p, mpq_srcptr x, mpq_srcptr y);

/* a + b sqrt(c), c >= 0. Sums and products are of elements with the same c. */
typedef struct orc_alg {
  mpq_srcptr a, b, c;
} orc_alg;

orc_alg orc_alg_q(orc_pool *p, mpq_srcptr a);
orc_alg orc_alg_add(orc_pool *p, orc_alg x, orc_alg y);
orc_alg orc_alg_sub(orc_pool *p, orc_alg x, orc_alg y);
orc_alg orc_alg_sub_q(orc_pool *p, orc_alg x, mpq_srcptr y);
orc_alg orc_alg_sqr(orc_pool *p, orc_alg x);
/* x * m + y with rational m, y. */
orc_alg orc_alg_affine(orc_pool *p, orc_alg x, mpq_srcptr m, mpq_srcptr y);
int orc_alg_sgn(orc_pool *p, orc_alg x);
/* Signs of x - y; the two radicands may differ. */
int orc_alg_cmp(orc_pool *p, orc_alg x, orc_alg y);
int orc_alg_cmp_q(orc_pool *p, orc_alg x, mpq_srcptr y);
/* A rational within 2^-bits (|b| + 1) or so of x; exact when b = 0. */
mpq_srcptr orc_alg_near(orc_pool *p, orc_alg x, size_t bits);
/* A rational strictly between x < y. */
mpq_srcptr orc_alg_between(orc_pool *p, orc_alg x, orc_alg y);

/* Prints the message and aborts: the oracle caught itself contradicting itself. */
void orc_fatal(const char *message);

#endif
