/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lines over a bisector: loading them, where they stand, which way f runs on them. */
#include "tolerance/lines.h"

#include "base/alloc.h"

#include <string.h>

/* ---- life ---- */

void dyd_lines_init(dyd_lines *l) {
  memset(l, 0, sizeof *l);
  mpz_inits(l->ix, l->iy, l->jx, l->jy, l->jj, l->u, l->v, l->x, l->y, NULL);
  mpq_init(l->factor);
}

void dyd_lines_clear(dyd_lines *l) {
  for (size_t k = 0; k < l->made; k++) {
    mpz_clears(l->item[k].m, l->item[k].n, l->item[k].along, NULL);
    dyd_rect_clear(&l->rect[k]);
    dyd_irect_clear(&l->grid[k]);
  }
  free(l->item);
  free(l->rect);
  free(l->grid);
  mpz_clears(l->ix, l->iy, l->jx, l->jy, l->jj, l->u, l->v, l->x, l->y, NULL);
  mpq_clear(l->factor);
}

static dyd_status lines_reserve(dyd_lines *l, size_t need) {
  size_t cap[3] = {l->made, l->made, l->made};
  if (!dyd_reserve((void **)&l->item, &cap[0], need, sizeof *l->item) ||
      !dyd_reserve((void **)&l->rect, &cap[1], need, sizeof *l->rect) ||
      !dyd_reserve((void **)&l->grid, &cap[2], need, sizeof *l->grid))
    return DYD_E_NOMEM;
  for (; l->made < need; l->made++) {
    dyd_line_over *o = &l->item[l->made];
    mpz_inits(o->m, o->n, o->along, NULL);
    dyd_rect_init(&l->rect[l->made]);
    dyd_irect_init(&l->grid[l->made]);
  }
  return DYD_OK;
}

/* ---- loading ---- */

static void line_set(dyd_line_over *o, dyd_lines *l, const dyd_irect *p) {
  mpz_sub(l->x, p->x0, l->ix);
  mpz_sub(l->y, p->y0, l->iy);
  mpz_mul(o->along, l->x, l->jx);
  mpz_addmul(o->along, l->y, l->jy);
  mpz_mul(o->m, l->x, l->x);
  mpz_addmul(o->m, l->y, l->y);
  mpz_sub(o->m, o->m, o->along);
  mpz_mul(o->n, l->y, l->jx);
  mpz_submul(o->n, l->x, l->jy);
}

static dyd_status lines_scale(dyd_lines *l, size_t count) {
  const dyd_rect **in = dyd_alloc(count, sizeof *in);
  int64_t exp;
  if (!in) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++) in[k] = &l->rect[k];
  dyd_irects_scale(l->grid, in, count, l->u, &exp);
  free(in);
  mpq_set_z(l->factor, l->u);
  if (exp >= 0)
    mpq_mul_2exp(l->factor, l->factor, (mp_bitcnt_t)exp);
  else
    mpq_div_2exp(l->factor, l->factor, (mp_bitcnt_t)-exp);
  return DYD_OK;
}

dyd_status dyd_lines_load(dyd_lines *l, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t *k,
                          size_t count) {
  l->count = 0;
  dyd_status st = lines_reserve(l, count + 2);
  if (st == DYD_OK) st = dyd_sites_get(&l->rect[count], sk->reps.sites, sk->reps.site[i]);
  if (st == DYD_OK) st = dyd_sites_get(&l->rect[count + 1], sk->reps.sites, sk->reps.site[j]);
  for (size_t q = 0; q < count && st == DYD_OK; q++)
    st = dyd_sites_get(&l->rect[q], sk->reps.sites, sk->reps.site[k[q]]);
  if (st == DYD_OK) st = lines_scale(l, count + 2);
  if (st != DYD_OK) return st;
  mpz_set(l->ix, l->grid[count].x0);
  mpz_set(l->iy, l->grid[count].y0);
  mpz_sub(l->jx, l->grid[count + 1].x0, l->ix);
  mpz_sub(l->jy, l->grid[count + 1].y0, l->iy);
  mpz_mul(l->jj, l->jx, l->jx);
  mpz_addmul(l->jj, l->jy, l->jy);
  for (size_t q = 0; q < count; q++) {
    size_t before = 0;
    while (before < l->count && l->item[before].vertex != k[q]) before++;
    if (before < l->count) continue;
    l->item[l->count].vertex = k[q];
    line_set(&l->item[l->count++], l, &l->grid[q]);
  }
  return DYD_OK;
}

/* ---- places ---- */

int dyd_line_compare(dyd_lines *l, const dyd_bisector_place *at, size_t a, size_t b) {
  const dyd_line_over *x = &l->item[a], *y = &l->item[b];
  mpz_sub(l->u, x->m, y->m);
  mpz_mul(l->v, l->u, at->q);
  mpz_sub(l->x, x->n, y->n);
  mpz_submul(l->v, l->x, at->p);
  if (mpz_sgn(l->v) || mpz_sgn(at->q)) return mpz_sgn(l->v);
  return mpz_sgn(l->u);
}

size_t dyd_line_lowest(dyd_lines *l, const dyd_bisector_place *at) {
  size_t best = 0;
  for (size_t k = 1; k < l->count; k++)
    if (dyd_line_compare(l, at, k, best) < 0) best = k;
  return best;
}

int dyd_line_height(dyd_lines *l, const dyd_bisector_place *at, size_t k) {
  mpz_mul(l->v, l->item[k].m, at->q);
  mpz_submul(l->v, l->item[k].n, at->p);
  if (mpz_sgn(l->v) || mpz_sgn(at->q)) return mpz_sgn(l->v);
  return mpz_sgn(l->item[k].m);
}

/* g' = A / R - S / r up to a positive factor, A = p jj - 2 q n, S = p jj; where A and S have one sign, A^2 r^2 - S^2
 * R^2 is p^2 (n^2 - jj m) - p q n jj + q^2 n^2 up to another. At an end q = 0 stands for an infinitely small q > 0:
 * when p^2
 * (...) is 0, the sign is that of -p n. */
int dyd_line_trend(dyd_lines *l, const dyd_bisector_place *at, size_t k) {
  const dyd_line_over *o = &l->item[k];
  mpz_mul(l->u, at->p, l->jj);
  mpz_mul(l->v, at->q, o->n);
  mpz_mul_2exp(l->v, l->v, 1);
  mpz_sub(l->v, l->u, l->v);
  int a = mpz_sgn(l->v), s = mpz_sgn(l->u);
  if (a >= 0 && s <= 0) return a > 0 || s < 0;
  if (a <= 0 && s >= 0) return -1;
  mpz_mul(l->u, o->n, o->n);
  mpz_mul(l->v, at->q, at->q);
  mpz_mul(l->v, l->v, l->u);
  mpz_submul(l->u, l->jj, o->m);
  mpz_mul(l->x, at->p, at->p);
  mpz_addmul(l->v, l->x, l->u);
  mpz_mul(l->x, at->p, at->q);
  mpz_mul(l->y, o->n, l->jj);
  mpz_submul(l->v, l->x, l->y);
  int sign = mpz_sgn(l->v);
  if (!sign && !mpz_sgn(at->q)) sign = -mpz_sgn(at->p) * mpz_sgn(o->n);
  return a > 0 ? sign : -sign;
}

bool dyd_line_summit(dyd_bisector_place *at, dyd_lines *l, size_t k) {
  const dyd_line_over *o = &l->item[k];
  mpz_neg(l->u, o->along);
  mpz_sub(l->v, o->along, l->jj);
  bool at_i = mpz_sgn(l->u) > 0, at_j = mpz_sgn(l->v) > 0;
  if (!at_i && !at_j) return false;
  mpz_neg(at->p, o->n);
  mpz_set(at->q, at_i ? l->u : l->v);
  return true;
}

bool dyd_line_cross(dyd_bisector_place *at, const dyd_lines *l, size_t a, size_t b) {
  mpz_sub(at->p, l->item[b].m, l->item[a].m);
  mpz_sub(at->q, l->item[b].n, l->item[a].n);
  if (mpz_sgn(at->q) < 0) {
    mpz_neg(at->p, at->p);
    mpz_neg(at->q, at->q);
  }
  return mpz_sgn(at->q) != 0;
}
