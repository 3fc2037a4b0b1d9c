/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Half-planes from exact offsets, and the move of the centre. */
#include "legal/cut_filter.h"

#include "rect/irect.h"

#include <math.h>

void dyd_cut_box(dyd_bbox *box, const dyd_point *c) {
  box->e[0] = dyd_dyadic_get_d(&c->x, DYD_DOWN);
  box->e[1] = dyd_dyadic_get_d(&c->x, DYD_UP);
  box->e[2] = dyd_dyadic_get_d(&c->y, DYD_DOWN);
  box->e[3] = dyd_dyadic_get_d(&c->y, DYD_UP);
}

double dyd_cut_radius2(const dyd_delaunay *pd, const dyd_bbox *c, uint32_t i, uint32_t j) {
  double a = dyd_dl2_upper(c, &pd->box[i]), b = dyd_dl2_upper(c, &pd->box[j]);
  return isnan(a) || isnan(b) ? INFINITY : dyd_max(a, b);
}

/* ---- one half-plane ---- */

typedef struct scaled {
  dyd_irect own, other, c;
  mpz_t factor, ax, ay, b, t, s, q;
  int64_t factor_exp;
} scaled;

static void scaled_init(scaled *z, const dyd_point *c, const dyd_rect *own, const dyd_rect *other) {
  dyd_rect at;
  const dyd_rect *in[3] = {own, other, &at};
  dyd_irect out[3];
  dyd_rect_init(&at);
  (void)dyd_interval_set_ends(&at.x, &c->x, &c->x);
  (void)dyd_interval_set_ends(&at.y, &c->y, &c->y);
  mpz_inits(z->factor, z->ax, z->ay, z->b, z->t, z->s, z->q, NULL);
  for (int k = 0; k < 3; k++) dyd_irect_init(&out[k]);
  dyd_irects_scale(out, in, 3, z->factor, &z->factor_exp);
  z->own = out[0];
  z->other = out[1];
  z->c = out[2];
  dyd_rect_clear(&at);
}

static void scaled_clear(scaled *z) {
  dyd_irect_clear(&z->own);
  dyd_irect_clear(&z->other);
  dyd_irect_clear(&z->c);
  mpz_clears(z->factor, z->ax, z->ay, z->b, z->t, z->s, z->q, NULL);
}

/* a = s - q and b += (s - q)(2c - s - q) on one axis; s the end of own farther from c, q the point of other nearest to
 * c. */
static void axis_part(scaled *z, mpz_t a, mpz_srcptr c, mpz_srcptr own0, mpz_srcptr own1, mpz_srcptr o0,
                      mpz_srcptr o1) {
  mpz_add(z->t, own0, own1);
  mpz_submul_ui(z->t, c, 2);
  mpz_set(z->s, mpz_sgn(z->t) > 0 ? own1 : own0);
  mpz_set(z->q, mpz_cmp(c, o0) < 0 ? o0 : mpz_cmp(c, o1) > 0 ? o1 : c);
  mpz_sub(a, z->s, z->q);
  mpz_mul_2exp(z->t, c, 1);
  mpz_sub(z->t, z->t, z->s);
  mpz_sub(z->t, z->t, z->q);
  mpz_addmul(z->b, a, z->t);
}

/* (ax, ay) as a unit vector, length * 2^*e. */
static double unit_vector(dyd_cut *cut, long *e, const scaled *z) {
  long ex, ey;
  double x = mpz_get_d_2exp(&ex, z->ax), y = mpz_get_d_2exp(&ey, z->ay);
  *e = x == 0 ? ey : y == 0 || ex > ey ? ex : ey;
  x = ex - *e < -1000 ? 0 : ldexp(x, (int)(ex - *e));
  y = ey - *e < -1000 ? 0 : ldexp(y, (int)(ey - *e));
  double length = hypot(x, y);
  cut->nx = x / length;
  cut->ny = y / length;
  return length;
}

void dyd_cut_add(dyd_cut_list *l, const dyd_point *c, const dyd_rect *own, const dyd_rect *other) {
  scaled z;
  long ea, eb, ef;
  if (l->count == DYD_LP_CUTS) return;
  scaled_init(&z, c, own, other);
  axis_part(&z, z.ax, z.c.x0, z.own.x0, z.own.x1, z.other.x0, z.other.x1);
  axis_part(&z, z.ay, z.c.y0, z.own.y0, z.own.y1, z.other.y0, z.other.y1);
  if (mpz_sgn(z.ax) == 0 && mpz_sgn(z.ay) == 0)
    l->impossible = true;
  else {
    dyd_cut *k = &l->cut[l->count];
    double length = unit_vector(k, &ea, &z), b = mpz_get_d_2exp(&eb, z.b), f = mpz_get_d_2exp(&ef, z.factor);
    k->d = b / (2 * length * f);
    k->noise = 0;
    l->exp[l->count - l->old] = (int64_t)eb - ea - ef - z.factor_exp;
    l->size = (int64_t)ea - ef - z.factor_exp;
    l->count++;
  }
  scaled_clear(&z);
}

bool dyd_cut_exactly(bool *violated, dyd_half_plane *h, const dyd_point *c, const dyd_rect *own,
                     const dyd_rect *other) {
  scaled z;
  scaled_init(&z, c, own, other);
  axis_part(&z, z.ax, z.c.x0, z.own.x0, z.own.x1, z.other.x0, z.other.x1);
  mpz_set(h->c, z.s);
  mpz_mul(h->c, h->c, h->c);
  mpz_submul(h->c, z.q, z.q);
  axis_part(&z, z.ay, z.c.y0, z.own.y0, z.own.y1, z.other.y0, z.other.y1);
  mpz_addmul(h->c, z.s, z.s);
  mpz_submul(h->c, z.q, z.q);
  mpz_neg(h->c, h->c); /* |q|^2 - |s|^2 + 2 F (s - q).x > 0, F = factor * 2^factor_exp */
  mpz_mul(h->a, z.ax, z.factor);
  mpz_mul(h->b, z.ay, z.factor);
  int64_t e = z.factor_exp + 1;
  mpz_mul_2exp(h->a, h->a, (mp_bitcnt_t)(e > 0 ? e : 0));
  mpz_mul_2exp(h->b, h->b, (mp_bitcnt_t)(e > 0 ? e : 0));
  mpz_mul_2exp(h->c, h->c, (mp_bitcnt_t)(e < 0 ? -e : 0));
  mpz_abs(h->w, h->a);
  mpz_abs(z.t, h->b);
  mpz_add(h->w, h->w, z.t);
  bool differ = mpz_sgn(h->w) != 0;
  *violated = mpz_sgn(z.b) <= 0;
  scaled_clear(&z);
  return differ;
}

/* floor(n 2^-e / d) 2^e */
static dyd_status rounded(dyd_dyadic *out, const mpz_t n, const mpz_t d, int64_t e) {
  mpz_t t, u;
  mpz_inits(t, u, NULL);
  mpz_mul_2exp(t, n, (mp_bitcnt_t)(e < 0 ? -e : 0));
  mpz_mul_2exp(u, d, (mp_bitcnt_t)(e > 0 ? e : 0));
  mpz_fdiv_q(t, t, u);
  dyd_status st = dyd_dyadic_set_z_2exp(out, t, e);
  mpz_clears(t, u, NULL);
  return st;
}

int64_t dyd_cut_exponent(const dyd_exact_centre *p) {
  return (int64_t)mpz_sizeinbase(p->z, 2) - (int64_t)mpz_sizeinbase(p->d, 2) - 4;
}

dyd_status dyd_cut_round(dyd_point *c, const dyd_exact_centre *p) {
  int64_t e = dyd_cut_exponent(p);
  dyd_status st = rounded(&c->x, p->x, p->d, e);
  return st == DYD_OK ? rounded(&c->y, p->y, p->d, e) : st;
}

/* ---- the move ---- */

/* x * 2^e without surprises: 0 far below, huge far above. */
static double scale(double x, int64_t e) {
  if (e < -2000) return 0;
  return ldexp(x, e > 900 ? 900 : (int)e);
}

void dyd_cut_age(dyd_cut_list *l) {
  l->old = l->count;
  size_t keep = DYD_LP_CUTS / 3;
  if (l->old > keep) { /* forget the oldest */
    for (size_t k = 0; k < keep; k++) l->cut[k] = l->cut[l->old - keep + k];
    l->old = keep;
  }
  l->count = l->old;
}

/* Exponent of the largest fresh offset. */
static int64_t fresh_exponent(const dyd_cut_list *l) {
  bool any = false;
  int64_t top = l->size;
  for (size_t k = l->old; k < l->count; k++) {
    int e;
    if (l->cut[k].d == 0) continue;
    frexp(l->cut[k].d, &e);
    int64_t exp = l->exp[k - l->old] + e;
    if (!any || exp > top) top = exp;
    any = true;
  }
  return top;
}

/* Brings all offsets to one unit; old cuts that are too noisy or too far away to matter are dropped. Returns how many
 * old ones are left, at the beginning. */
static size_t common_unit(dyd_cut_list *l) {
  int64_t unit = fresh_exponent(l);
  size_t kept = 0, old = 0;
  for (size_t k = 0; k < l->count; k++) {
    dyd_cut c = l->cut[k];
    if (k >= l->old) {
      c.d = scale(c.d, l->exp[k - l->old] - unit);
      c.noise = 0x1p-50 * fabs(c.d);
    } else {
      c.d = scale(c.d, l->unit - unit);
      c.noise = scale(c.noise, l->unit - unit);
      if (c.noise > 0x1p-10 || fabs(c.d) > 0x1p30) continue;
      old++;
    }
    l->cut[kept++] = c;
  }
  l->count = kept;
  l->unit = unit;
  return old;
}

static dyd_status shift(dyd_dyadic *x, double by, int64_t unit) {
  dyd_dyadic d;
  int e;
  double m = ldexp(nearbyint(ldexp(frexp(by, &e), 40)), -40);
  dyd_dyadic_init(&d);
  dyd_status st = dyd_dyadic_set_d(&d, m);
  if (st == DYD_OK) st = dyd_dyadic_mul_2exp(&d, &d, unit + e);
  if (st == DYD_OK) st = dyd_dyadic_add(x, x, &d);
  dyd_dyadic_clear(&d);
  return st;
}

static void carry(dyd_cut_list *l, double x, double y) {
  for (size_t k = 0; k < l->count; k++) {
    dyd_cut *c = &l->cut[k];
    c->d += c->nx * x + c->ny * y;
    c->noise += 0x1p-38 * (fabs(x) + fabs(y));
  }
}

static dyd_lp_result centre(const dyd_cut_list *l) {
  dyd_lp_result r = {0};
  for (double bound = 8; bound <= 0x1p24; bound *= 128) {
    r = dyd_lp_centre(l->cut, l->count, bound);
    if (r.z > 0 || r.bounded) break;
  }
  return r;
}

/* Is there surely no room: by more than what rounding may have taken? Not if the answer lies farther than we looked. */
static bool is_empty(const dyd_lp_result *r) {
  return r->bounded && (r->z < -1e-9 * r->active - 4 * r->noise || r->active == 0);
}

/* Leaves only the cuts that belong to the present centre. */
static void drop_old(dyd_cut_list *l, size_t old) {
  for (size_t k = old; k < l->count; k++) l->cut[k - old] = l->cut[k];
  l->count -= old;
}

bool dyd_cut_move(dyd_point *c, dyd_cut_list *l, dyd_status *status) {
  if (l->impossible || l->count == l->old) return false;
  size_t old = common_unit(l);
  dyd_lp_result r = centre(l);
  if (r.z <= 0 && !is_empty(&r) && old) { /* too noisy to tell: look closer there, or trust fresh cuts only */
    l->stalled = l->unit < l->finest - 8 ? 0 : l->stalled + 1;
    if (l->stalled > 3) {
      drop_old(l, old);
      l->stalled = 0;
      r = centre(l);
    }
  }
  if (l->unit < l->finest) l->finest = l->unit;
  if (r.z <= 0 && is_empty(&r)) {
    l->empty = true;
    return false;
  }
  *status = shift(&c->x, r.x, l->unit);
  if (*status == DYD_OK) *status = shift(&c->y, r.y, l->unit);
  if (*status == DYD_E_RANGE) { /* deeper than numbers go: the floor */
    *status = DYD_OK;
    return false;
  }
  carry(l, r.x, r.y);
  l->old = l->count;
  return true;
}
