/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Common integer scale of a growing set of rectangles, and the way back to doubles, outward. */
#include "skeleton/scale_set.h"

#include "base/alloc.h"

#include <math.h>

void dyd_scale_set_init(dyd_scale_set *s, const dyd_rects *rects) {
  *s = (dyd_scale_set){.rects = rects};
  mpz_inits(s->lcm, s->growth, s->t, NULL);
  dyd_rect_init(&s->load);
  dyd_scale_set_empty(s);
}

void dyd_scale_set_clear(dyd_scale_set *s) {
  for (size_t k = 0; k < s->made; k++) dyd_irect_clear(&s->rect[k]);
  dyd_free_all(s->rect, s->vertex);
  mpz_clears(s->lcm, s->growth, s->t, NULL);
  dyd_rect_clear(&s->load);
}

void dyd_scale_set_empty(dyd_scale_set *s) {
  s->count = 0;
  mpz_set_ui(s->lcm, 1);
  s->low = INT64_MAX;
}

static void scale_lower(int64_t *low, const dyd_dyadic *x) {
  if (mpz_sgn(x->man) && x->exp < *low) *low = x->exp;
}

/* man * 2^exp / den in the scale of the set: exact, since den divides lcm and exp >= low. */
static void scale_end(mpz_t out, const dyd_scale_set *s, const dyd_dyadic *x, const mpz_t den) {
  if (mpz_sgn(x->man) == 0) {
    mpz_set_ui(out, 0);
    return;
  }
  mpz_mul_2exp(out, x->man, (mp_bitcnt_t)(x->exp - s->low));
  if (mpz_cmp(den, s->lcm) != 0) {
    mpz_mul(out, out, s->lcm);
    mpz_divexact(out, out, den);
  }
}

/* Refines the scale for the loaded rectangle; true if members there were have to grow. */
static bool scale_refine(dyd_scale_set *s) {
  int64_t low = s->low;
  const dyd_interval *side[2] = {&s->load.x, &s->load.y};
  mpz_set(s->t, s->lcm);
  for (int a = 0; a < 2; a++) {
    scale_lower(&low, &side[a]->lo);
    scale_lower(&low, &side[a]->hi);
    mpz_lcm(s->t, s->t, side[a]->den);
  }
  bool grows = s->count > 0 && (low < s->low || mpz_cmp(s->t, s->lcm) != 0);
  if (grows) {
    mpz_divexact(s->growth, s->t, s->lcm);
    if (s->low != INT64_MAX) mpz_mul_2exp(s->growth, s->growth, (mp_bitcnt_t)(s->low - low));
  }
  mpz_set(s->lcm, s->t);
  s->low = low;
  return grows;
}

static void grow_members(dyd_scale_set *s) {
  for (size_t k = 0; k < s->count; k++) {
    mpz_mul(s->rect[k].x0, s->rect[k].x0, s->growth);
    mpz_mul(s->rect[k].x1, s->rect[k].x1, s->growth);
    mpz_mul(s->rect[k].y0, s->rect[k].y0, s->growth);
    mpz_mul(s->rect[k].y1, s->rect[k].y1, s->growth);
  }
}

static bool scale_find(size_t *index, const dyd_scale_set *s, uint32_t v) {
  for (size_t k = 0; k < s->count; k++)
    if (s->vertex[k] == v) return *index = k, true;
  return false;
}

dyd_status dyd_scale_add(size_t *index, bool *grown, dyd_scale_set *s, uint32_t v) {
  *grown = false;
  if (scale_find(index, s, v)) return DYD_OK;
  if (!DYD_GROW(s->vertex, s->vertex_cap, s->count + 1)) return DYD_E_NOMEM;
  if (!DYD_GROW(s->rect, s->rect_cap, s->count + 1)) return DYD_E_NOMEM;
  dyd_rects_get(&s->load, s->rects, v);
  if (s->made == s->count) dyd_irect_init(&s->rect[s->made++]);
  *grown = scale_refine(s);
  if (*grown) grow_members(s);
  dyd_irect *r = &s->rect[s->count];
  scale_end(r->x0, s, &s->load.x.lo, s->load.x.den);
  scale_end(r->x1, s, &s->load.x.hi, s->load.x.den);
  scale_end(r->y0, s, &s->load.y.lo, s->load.y.den);
  scale_end(r->y1, s, &s->load.y.hi, s->load.y.den);
  s->vertex[s->count] = v;
  *index = s->count++;
  return DYD_OK;
}

int64_t dyd_scale_shift(const dyd_scale_set *s) {
  return s->low == INT64_MAX ? 0 : -s->low;
}

/* user = scaled / lcm, after the shift. The double nearest to lcm has a relative error of 2^-52, the division one of
 * 2^-53 (or 2^-1074 absolute): widening by 4 ulp is outward. Denominators too large for doubles leave the plane
 * [FLT-SCALE]. */
void dyd_scale_to_user(dyd_bbox *box, const dyd_scale_set *s) {
  double l = mpz_get_d(s->lcm);
  if (l == 1) return;
  for (int k = 0; k < 4; k++) {
    double x = box->e[k] / l, out = k & 1 ? INFINITY : -INFINITY;
    x += (k & 1 ? 1 : -1) * 4 * 0x1p-52 * fabs(x);
    box->e[k] = isnan(x) || !isfinite(l) ? out : nextafter(x, out);
  }
}
