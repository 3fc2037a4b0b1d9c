/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Discs of a certificate, exactly: witnesses by two square roots, caps by ends a + b sqrt(c). */
#include "checker/caps.h"
#include "base/alloc.h"
#include "base/local.h"

void dyd_cert_disc_init(dyd_cert_disc *d) {
  dyd_exact_init(&d->x);
  dyd_exact_init(&d->y);
  dyd_exact_init(&d->r);
}

void dyd_cert_disc_clear(dyd_cert_disc *d) {
  dyd_exact_clear(&d->x);
  dyd_exact_clear(&d->y);
  dyd_exact_clear(&d->r);
}

/* ---- distances ---- */

/* out = x^2 + y^2; out is neither. */
static void square_norm(dyd_exact *out, const dyd_exact *x, const dyd_exact *y) {
  DYD_LOCAL(dyd_exact, t);
  dyd_exact_mul(out, x, x);
  dyd_exact_mul(&t, y, y);
  dyd_exact_add(out, out, &t);
}

/* The square of the distance of (x, y) and the centre of d. */
static void centre_distance2(dyd_exact *out, const dyd_exact *x, const dyd_exact *y, const dyd_cert_disc *d) {
  DYD_LOCAL(dyd_exact, dx, dy);
  dyd_exact_sub(&dx, x, &d->x);
  dyd_exact_sub(&dy, y, &d->y);
  square_norm(out, &dx, &dy);
}

bool dyd_cert_discs_meet(const dyd_cert_disc *a, const dyd_cert_disc *b) {
  DYD_LOCAL(dyd_exact, d, s);
  centre_distance2(&d, &a->x, &a->y, b);
  dyd_exact_add(&s, &a->r, &b->r);
  dyd_exact_mul(&s, &s, &s);
  return dyd_exact_cmp(&d, &s) <= 0;
}

/* sqrt(A) + s < sqrt(B), s = r_i + r_k >= 0, A and B the squared distances: D = B - A - s^2 is positive, and D^2 > 4
 * s^2 A. */
bool dyd_cert_disc_is_nearer(const dyd_exact c[2], const dyd_cert_disc *i, const dyd_cert_disc *k) {
  DYD_LOCAL(dyd_exact, a, b, s);
  centre_distance2(&a, &c[0], &c[1], i);
  centre_distance2(&b, &c[0], &c[1], k);
  dyd_exact_add(&s, &i->r, &k->r);
  dyd_exact_mul(&s, &s, &s);
  dyd_exact_sub(&b, &b, &a);
  dyd_exact_sub(&b, &b, &s);
  bool nearer = dyd_exact_sgn(&b) > 0;
  dyd_exact_mul(&b, &b, &b);
  dyd_exact_mul(&a, &a, &s);
  a.exp += 2;
  return nearer && dyd_exact_cmp(&b, &a) > 0;
}

/* ---- witnesses ---- */

typedef struct disc_search {
  const dyd_cert_disc *disc;
  const dyd_exact *c;
  uint32_t i, j, other;
} disc_search;

static bool is_beyond_discs(void *context, uint32_t k) {
  disc_search *s = context;
  const dyd_cert_disc *d = s->disc;
  if (k == s->i || k == s->j) return true;
  if (dyd_cert_disc_is_nearer(s->c, &d[s->i], &d[k]) && dyd_cert_disc_is_nearer(s->c, &d[s->j], &d[k])) return true;
  s->other = k;
  return false;
}

bool dyd_cert_is_disc_witness(uint32_t *other, const dyd_cert_sites *s, const dyd_cert_tree *t,
                              const dyd_cert_disc *disc, uint32_t i, uint32_t j, const dyd_exact c[2]) {
  dyd_cert_centre centre;
  dyd_cert_centre_set(&centre, s, c);
  disc_search q = {.disc = disc, .c = c, .i = i, .j = j};
  dyd_cert_area limit = 0;
  if (!centre.far) {
    dyd_cert_area a = dyd_cert_far_upper(&centre, &s->box[i]), b = dyd_cert_far_upper(&centre, &s->box[j]);
    limit = a > b ? a : b;
  }
  bool good = dyd_cert_tree_visit(t, &centre, limit, is_beyond_discs, &q);
  if (!good && other) *other = q.other;
  return good;
}

/* ---- caps ---- */

static void init_cap(dyd_cert_cap *p) {
  dyd_exact *all[] = {&p->wx, &p->wy, &p->tau, &p->ww, &p->c, &p->n};
  for (int k = 0; k < 6; k++) dyd_exact_init(all[k]);
}

static void clear_cap(dyd_cert_cap *p) {
  dyd_exact *all[] = {&p->wx, &p->wy, &p->tau, &p->ww, &p->c, &p->n};
  for (int k = 0; k < 6; k++) dyd_exact_clear(all[k]);
}

void dyd_cert_caps_init(dyd_cert_caps *c) {
  *c = (dyd_cert_caps){0};
  dyd_exact_init(&c->jx);
  dyd_exact_init(&c->jy);
  dyd_exact_init(&c->delta);
  dyd_exact_init(&c->nj);
}

void dyd_cert_caps_clear(dyd_cert_caps *c) {
  for (size_t k = 0; k < c->made; k++) clear_cap(&c->item[k]);
  free(c->item);
  dyd_exact_clear(&c->jx);
  dyd_exact_clear(&c->jy);
  dyd_exact_clear(&c->delta);
  dyd_exact_clear(&c->nj);
  *c = (dyd_cert_caps){0};
}

static dyd_cert_cap *next_cert_cap(dyd_cert_caps *c) {
  if (!dyd_reserve((void **)&c->item, &c->cap, c->count + 1, sizeof *c->item)) return NULL;
  dyd_cert_cap *p = &c->item[c->count];
  if (c->count == c->made) {
    init_cap(p);
    c->made++;
  }
  c->count++;
  return p;
}

/* c from w and tau. */
static void finish_cert_cap(dyd_cert_cap *p) {
  DYD_LOCAL(dyd_exact, t);
  square_norm(&p->ww, &p->wx, &p->wy);
  dyd_exact_mul(&t, &p->tau, &p->tau);
  dyd_exact_sub(&p->c, &p->ww, &t);
}

/* x, y = P_k; n = |P_k|^2 - r^2. */
static void invert_disc(dyd_exact *x, dyd_exact *y, dyd_exact *n, const dyd_cert_disc *i, const dyd_cert_disc *k,
                        const dyd_exact *r) {
  DYD_LOCAL(dyd_exact, t);
  dyd_exact_sub(x, &k->x, &i->x);
  dyd_exact_sub(y, &k->y, &i->y);
  square_norm(n, x, y);
  dyd_exact_mul(&t, r, r);
  dyd_exact_sub(n, n, &t);
}

dyd_status dyd_cert_caps_begin(bool *good, dyd_cert_caps *c, const dyd_cert_disc *a, const dyd_cert_disc *b) {
  bool swap = dyd_exact_cmp(&a->r, &b->r) > 0;
  c->i = swap ? b : a;
  c->j = swap ? a : b;
  c->count = 0;
  dyd_cert_cap *p = next_cert_cap(c);
  if (!p) return DYD_E_NOMEM;
  dyd_exact_sub(&c->delta, &c->j->r, &c->i->r);
  invert_disc(&c->jx, &c->jy, &c->nj, c->i, c->j, &c->delta);
  *good = dyd_exact_sgn(&c->nj) > 0;
  dyd_exact_sub(&p->wx, &c->i->x, &c->j->x);
  dyd_exact_sub(&p->wy, &c->i->y, &c->j->y);
  dyd_exact_set(&p->tau, &c->delta);
  dyd_exact_set(&p->n, &c->nj);
  finish_cert_cap(p);
  return DYD_OK;
}

/* out = N_j out + sign N_k at_j. */
static void cap_against_pair(dyd_exact *out, const dyd_cert_caps *c, const dyd_exact *at_j, const dyd_exact *n_k,
                             int sign) {
  DYD_LOCAL(dyd_exact, t);
  dyd_exact_mul(out, out, &c->nj);
  dyd_exact_mul(&t, at_j, n_k);
  sign > 0 ? dyd_exact_add(out, out, &t) : dyd_exact_sub(out, out, &t);
}

dyd_status dyd_cert_caps_add(bool *added, dyd_cert_caps *c, const dyd_cert_disc *k) {
  *added = !dyd_cert_discs_meet(c->i, k) && !dyd_cert_discs_meet(c->j, k);
  if (!*added) return DYD_OK;
  dyd_cert_cap *p = next_cert_cap(c);
  if (!p) return DYD_E_NOMEM;
  dyd_exact_add(&p->tau, &k->r, &c->i->r);
  invert_disc(&p->wx, &p->wy, &p->n, c->i, k, &p->tau);
  cap_against_pair(&p->wx, c, &c->jx, &p->n, -1);
  cap_against_pair(&p->wy, c, &c->jy, &p->n, -1);
  cap_against_pair(&p->tau, c, &c->delta, &p->n, 1);
  finish_cert_cap(p);
  return DYD_OK;
}

/* ---- ends ---- */

/* Sign of a + b sqrt(c), c > 0 [SQR-1]. */
static int root_sum_sign(const dyd_exact *a, const dyd_exact *b, const dyd_exact *c) {
  int x = dyd_exact_sgn(a), y = dyd_exact_sgn(b);
  if (x == y || !y) return x;
  if (!x) return y;
  DYD_LOCAL(dyd_exact, s, t);
  dyd_exact_mul(&s, a, a);
  dyd_exact_mul(&t, b, b);
  dyd_exact_mul(&t, &t, c);
  int larger = dyd_exact_cmp(&s, &t);
  return larger > 0 ? x : larger < 0 ? y : 0;
}

/* out = a b + sign c d. */
static void product_sum(dyd_exact *out, const dyd_exact *a, const dyd_exact *b, int sign, const dyd_exact *c,
                        const dyd_exact *d) {
  DYD_LOCAL(dyd_exact, t);
  dyd_exact_mul(&t, c, d);
  dyd_exact_mul(out, a, b);
  sign > 0 ? dyd_exact_add(out, out, &t) : dyd_exact_sub(out, out, &t);
}

/* The counter-clockwise end of cap e is u = (tau w + sqrt(c) w') / ww, w' the left turn of w. The sign of u.w_k -
 * tau_k.
 */
static int cap_end_sign(const dyd_cert_cap *e, const dyd_cert_cap *k) {
  DYD_LOCAL(dyd_exact, a, b);
  product_sum(&b, &e->wx, &k->wx, 1, &e->wy, &k->wy);
  product_sum(&a, &b, &e->tau, -1, &k->tau, &e->ww);
  product_sum(&b, &e->wx, &k->wy, -1, &e->wy, &k->wx);
  return root_sum_sign(&a, &b, &e->c);
}

/* A part of the circle that open caps hold, but for all of it, ends counter-clockwise where one of them does, and none
 * holds that end. */
bool dyd_cert_caps_cover(size_t *end, const dyd_cert_caps *c) {
  bool any = false;
  for (*end = 0; *end < c->count; ++*end) {
    const dyd_cert_cap *e = &c->item[*end];
    if (dyd_exact_sgn(&e->c) <= 0) continue;
    size_t k = 0;
    any = true;
    while (k < c->count && (dyd_exact_sgn(&c->item[k].c) <= 0 || cap_end_sign(e, &c->item[k]) <= 0)) k++;
    if (k == c->count) return false;
  }
  return any;
}
