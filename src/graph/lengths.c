/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lengths of pairs, exactly. */
#include "graph/lengths.h"

/* Adds the square of what counts along one side. */
static void add_side2(mpq_ptr sum, const dyd_interval *a, const dyd_interval *b, bool largest) {
  mpq_t alo, ahi, blo, bhi;
  mpq_inits(alo, ahi, blo, bhi, NULL);
  dyd_interval_get_q(alo, ahi, a);
  dyd_interval_get_q(blo, bhi, b);
  mpq_sub(ahi, ahi, blo); /* how far a reaches beyond b, and b beyond a */
  mpq_sub(bhi, bhi, alo);
  mpq_ptr d = ahi;
  if (largest ? mpq_cmp(bhi, ahi) > 0 : mpq_cmp(bhi, ahi) < 0) d = bhi;
  if (largest || mpq_sgn(d) < 0) {
    mpq_mul(d, d, d);
    mpq_add(sum, sum, d);
  }
  mpq_clears(alo, ahi, blo, bhi, NULL);
}

static void exact_length(mpq_ptr out, const dyd_length *l) {
  const dyd_pair *p = &l->of->pairs.item[l->pair];
  dyd_rect a, b;
  dyd_rect_init(&a);
  dyd_rect_init(&b);
  dyd_sites_get(&a, l->of->sites, p->i);
  dyd_sites_get(&b, l->of->sites, p->j);
  mpq_set_ui(out, 0, 1);
  add_side2(out, &a.x, &b.x, l->largest);
  add_side2(out, &a.y, &b.y, l->largest);
  dyd_rect_clear(&b);
  dyd_rect_clear(&a);
}

int dyd_length_compare(const dyd_length *a, const dyd_length *b) {
  if (a->hi < b->lo) return -1;
  if (b->hi < a->lo) return 1;
  if (a->lo == a->hi && b->lo == b->hi) return 0;
  if (a->pair == b->pair && a->largest == b->largest) return 0;
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  exact_length(x, a);
  exact_length(y, b);
  int sign = mpq_cmp(x, y);
  mpq_clears(x, y, NULL);
  return sign;
}

int dyd_length_order(const void *a, const void *b) {
  return dyd_length_compare(a, b);
}
