/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact distances, heights and turns of the sites of a certificate.
 *
 * ds clamps the centre to the rectangle, dl goes to the farther end on each axis; heights are u.x at a corner. */
#include "checker/faces.h"
#include <stddef.h>

void dyd_cert_fraction_init(dyd_cert_fraction *f) {
  dyd_exact_init(&f->num);
  mpz_init(f->den);
  f->whole = true;
}

void dyd_cert_fraction_clear(dyd_cert_fraction *f) {
  dyd_exact_clear(&f->num);
  mpz_clear(f->den);
}

void dyd_cert_fraction_swap(dyd_cert_fraction *a, dyd_cert_fraction *b) {
  dyd_cert_fraction t = *a;
  *a = *b;
  *b = t;
}

/* x and y, initialised here: the numerators of two fractions over the product of their denominators. */
static void init_over_common(dyd_exact *x, dyd_exact *y, const dyd_cert_fraction *a, const dyd_cert_fraction *b) {
  dyd_exact_init(x);
  dyd_exact_init(y);
  dyd_exact_set(x, &a->num);
  dyd_exact_set(y, &b->num);
  if (!b->whole) dyd_exact_mul_z(x, x, b->den);
  if (!a->whole) dyd_exact_mul_z(y, y, a->den);
}

/* The denominator of a product, one of the factors not being whole. */
static void multiply_dens(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b) {
  if (a->whole)
    mpz_set(out->den, b->den);
  else if (b->whole)
    mpz_set(out->den, a->den);
  else
    mpz_mul(out->den, a->den, b->den);
}

int dyd_cert_fraction_cmp(const dyd_cert_fraction *a, const dyd_cert_fraction *b) {
  if (a->whole && b->whole) return dyd_exact_cmp(&a->num, &b->num);
  dyd_exact x, y;
  init_over_common(&x, &y, a, b);
  int sign = dyd_exact_cmp(&x, &y);
  dyd_exact_clear(&x);
  dyd_exact_clear(&y);
  return sign;
}

void dyd_cert_fraction_sub(dyd_cert_fraction *out, const dyd_exact *a, mpz_srcptr da, const dyd_exact *b,
                           mpz_srcptr db) {
  out->whole = !da && !db;
  if (out->whole) {
    dyd_exact_sub(&out->num, a, b);
    return;
  }
  dyd_exact t;
  dyd_exact_init(&t);
  dyd_exact_set(&t, b);
  dyd_exact_set(&out->num, a);
  mpz_set_ui(out->den, 1);
  if (da) {
    dyd_exact_mul_z(&t, &t, da);
    mpz_mul(out->den, out->den, da);
  }
  if (db) {
    dyd_exact_mul_z(&out->num, &out->num, db);
    mpz_mul(out->den, out->den, db);
  }
  dyd_exact_sub(&out->num, &out->num, &t);
  dyd_exact_clear(&t);
}

/* out may be a or b. */
void dyd_cert_fraction_mul(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b) {
  bool whole = a->whole && b->whole;
  if (!whole) multiply_dens(out, a, b);
  dyd_exact_mul(&out->num, &a->num, &b->num);
  out->whole = whole;
}

void dyd_cert_fraction_add(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b) {
  if (a->whole && b->whole) {
    dyd_exact_add(&out->num, &a->num, &b->num);
    out->whole = true;
    return;
  }
  dyd_exact x, y;
  init_over_common(&x, &y, a, b);
  multiply_dens(out, a, b);
  dyd_exact_add(&out->num, &x, &y);
  out->whole = false;
  dyd_exact_clear(&x);
  dyd_exact_clear(&y);
}

/* ---- distances ---- */

/* d = c - the number the measure takes on this axis (of either sign). */
static void axis_distance(dyd_cert_fraction *d, const dyd_exact *c, const dyd_cert_site *s, int axis,
                          dyd_cert_measure measure) {
  const dyd_cert_side *side = &s->side[axis];
  mpz_srcptr den = dyd_cert_den(side);
  const dyd_exact *at = &side->lo;
  if (measure == DYD_CERT_PLACE) {
    at = dyd_cert_place(&den, s, axis);
  } else if (!side->point && measure == DYD_CERT_NEAR) {
    if (dyd_exact_cmp(c, &side->lo) > 0) at = dyd_exact_cmp(c, &side->hi) < 0 ? c : &side->hi;
  } else if (!side->point) { /* the farther end: hi unless c - lo > hi - c */
    dyd_exact twice, sum;
    dyd_exact_init(&twice);
    dyd_exact_init(&sum);
    dyd_exact_add(&sum, &side->lo, &side->hi);
    dyd_exact_add(&twice, c, c);
    if (dyd_exact_cmp(&twice, &sum) <= 0) at = &side->hi;
    dyd_exact_clear(&twice);
    dyd_exact_clear(&sum);
  }
  dyd_cert_fraction_sub(d, c, NULL, at, den);
}

void dyd_cert_distance2(dyd_cert_fraction *out, const dyd_exact c[2], const dyd_cert_site *s,
                        dyd_cert_measure measure) {
  dyd_cert_fraction d;
  dyd_cert_fraction_init(&d);
  axis_distance(&d, &c[0], s, 0, measure);
  dyd_cert_fraction_mul(out, &d, &d);
  axis_distance(&d, &c[1], s, 1, measure);
  dyd_cert_fraction_mul(&d, &d, &d);
  dyd_cert_fraction_add(out, out, &d);
  dyd_cert_fraction_clear(&d);
}

/* ---- places ---- */

dyd_cert_spot dyd_cert_place_of(const dyd_cert_sites *s, uint32_t v) {
  dyd_cert_spot spot;
  for (int axis = 0; axis < 2; axis++) spot.v[axis] = dyd_cert_place(&spot.den[axis], &s->site[v], axis);
  return spot;
}

dyd_cert_spot dyd_cert_spot_at(const dyd_exact v[2]) {
  return (dyd_cert_spot){{&v[0], &v[1]}, {NULL, NULL}};
}

static void spot_difference(dyd_cert_fraction *out, const dyd_cert_spot *a, const dyd_cert_spot *b, int axis) {
  dyd_cert_fraction_sub(out, b->v[axis], b->den[axis], a->v[axis], a->den[axis]);
}

int dyd_cert_cross(dyd_cert_spot a, dyd_cert_spot b, dyd_cert_spot c, dyd_cert_spot d) {
  dyd_cert_fraction t[4];
  for (int k = 0; k < 4; k++) dyd_cert_fraction_init(&t[k]);
  spot_difference(&t[0], &a, &b, 0);
  spot_difference(&t[1], &c, &d, 1);
  spot_difference(&t[2], &a, &b, 1);
  spot_difference(&t[3], &c, &d, 0);
  dyd_cert_fraction_mul(&t[0], &t[0], &t[1]);
  dyd_cert_fraction_mul(&t[2], &t[2], &t[3]);
  int sign = dyd_cert_fraction_cmp(&t[0], &t[2]);
  for (int k = 0; k < 4; k++) dyd_cert_fraction_clear(&t[k]);
  return sign;
}

/* Grid coordinates of a place, rounded down; false when they are not at hand. */
static bool grid_place(int64_t out[2], const dyd_cert_sites *s, uint32_t v) {
  if (!s->box || s->site[v].place) return false;
  out[0] = s->box[v].e[0];
  out[1] = s->box[v].e[2];
  return true;
}

static int64_t absolute_value(int64_t d) {
  return d < 0 ? -d : d;
}

/* Grid differences x, y, z, t are below 2^31 and within 1 of the true ones, so xt - yz is within |x| + |y| + |z| + |t|
 * + 2 of the true determinant. 0: not known. */
static int turn_on_grid(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c) {
  int64_t p[3][2];
  if (!grid_place(p[0], s, a) || !grid_place(p[1], s, b) || !grid_place(p[2], s, c)) return 0;
  int64_t x = p[1][0] - p[0][0], y = p[1][1] - p[0][1], z = p[2][0] - p[0][0], t = p[2][1] - p[0][1];
  int64_t det = x * t - y * z,
          error = absolute_value(x) + absolute_value(y) + absolute_value(z) + absolute_value(t) + 2;
  return det > error ? 1 : det < -error ? -1 : 0;
}

int dyd_cert_turn(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c) {
  int quick = turn_on_grid(s, a, b, c);
  if (quick) return quick;
  dyd_cert_spot at = dyd_cert_place_of(s, a);
  return dyd_cert_cross(at, dyd_cert_place_of(s, b), at, dyd_cert_place_of(s, c));
}

int dyd_cert_compare_places(const dyd_cert_sites *s, uint32_t a, uint32_t b) {
  int64_t p[2], q[2];
  if (grid_place(p, s, a) && grid_place(q, s, b) && p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
  dyd_cert_spot at[2] = {dyd_cert_place_of(s, a), dyd_cert_place_of(s, b)};
  dyd_cert_fraction d;
  dyd_cert_fraction_init(&d);
  int sign = 0;
  for (int axis = 0; axis < 2 && sign == 0; axis++) {
    spot_difference(&d, &at[1], &at[0], axis);
    sign = dyd_exact_sgn(&d.num);
  }
  dyd_cert_fraction_clear(&d);
  return sign;
}

/* ---- lines and circles ---- */

bool dyd_cert_on_line(const dyd_cert_sites *s, const uint32_t *site, size_t count) {
  for (size_t q = 2; q < count; q++)
    if (dyd_cert_turn(s, site[0], site[1], site[q])) return false;
  return true;
}

/* The vector from one point to another, and the square of its length: on a circle through the former, or a line, such
 * triples are on a plane through 0, and nowhere else. */
typedef struct lifted {
  dyd_cert_fraction x, y, square;
} lifted;

static void lifted_init(lifted *v) {
  dyd_cert_fraction_init(&v->x);
  dyd_cert_fraction_init(&v->y);
  dyd_cert_fraction_init(&v->square);
}

static void lifted_clear(lifted *v) {
  dyd_cert_fraction_clear(&v->x);
  dyd_cert_fraction_clear(&v->y);
  dyd_cert_fraction_clear(&v->square);
}

static void lifted_set(lifted *v, const dyd_cert_spot *from, const dyd_cert_spot *to) {
  dyd_cert_fraction t;
  dyd_cert_fraction_init(&t);
  spot_difference(&v->x, from, to, 0);
  spot_difference(&v->y, from, to, 1);
  dyd_cert_fraction_mul(&v->square, &v->x, &v->x);
  dyd_cert_fraction_mul(&t, &v->y, &v->y);
  dyd_cert_fraction_add(&v->square, &v->square, &t);
  dyd_cert_fraction_clear(&t);
}

/* out = a d - b c. */
static void fraction_cross(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b,
                           const dyd_cert_fraction *c, const dyd_cert_fraction *d) {
  dyd_cert_fraction t;
  dyd_cert_fraction_init(&t);
  dyd_cert_fraction_mul(out, a, d);
  dyd_cert_fraction_mul(&t, b, c);
  mpz_neg(t.num.man, t.num.man);
  dyd_cert_fraction_add(out, out, &t);
  dyd_cert_fraction_clear(&t);
}

/* The normal of the plane of 0, v and w. */
static void lifted_normal(lifted *out, const lifted *v, const lifted *w) {
  fraction_cross(&out->x, &v->y, &v->square, &w->y, &w->square);
  fraction_cross(&out->y, &v->square, &v->x, &w->square, &w->x);
  fraction_cross(&out->square, &v->x, &v->y, &w->x, &w->y);
}

static bool lifted_is_orthogonal(const lifted *v, const lifted *w) {
  dyd_cert_fraction sum, t;
  dyd_cert_fraction_init(&sum);
  dyd_cert_fraction_init(&t);
  dyd_cert_fraction_mul(&sum, &v->x, &w->x);
  dyd_cert_fraction_mul(&t, &v->y, &w->y);
  dyd_cert_fraction_add(&sum, &sum, &t);
  dyd_cert_fraction_mul(&t, &v->square, &w->square);
  dyd_cert_fraction_add(&sum, &sum, &t);
  bool orthogonal = dyd_exact_sgn(&sum.num) == 0;
  dyd_cert_fraction_clear(&sum);
  dyd_cert_fraction_clear(&t);
  return orthogonal;
}

bool dyd_cert_on_circle(const dyd_cert_sites *s, const uint32_t *site, size_t count) {
  bool all = true;
  dyd_cert_spot first = dyd_cert_place_of(s, site[0]), at;
  lifted v, w, normal;
  lifted_init(&v);
  lifted_init(&w);
  lifted_init(&normal);
  at = dyd_cert_place_of(s, site[1]);
  lifted_set(&v, &first, &at);
  at = dyd_cert_place_of(s, site[2]);
  lifted_set(&w, &first, &at);
  lifted_normal(&normal, &v, &w);
  for (size_t q = 3; q < count && all; q++) {
    at = dyd_cert_place_of(s, site[q]);
    lifted_set(&v, &first, &at);
    all = lifted_is_orthogonal(&normal, &v);
  }
  lifted_clear(&normal);
  lifted_clear(&w);
  lifted_clear(&v);
  return all;
}

/* ---- heights ---- */

/* out = max (upper) or min of u.x over the rectangle. */
static void site_height(dyd_cert_fraction *out, const dyd_exact u[2], const dyd_cert_site *s, bool upper) {
  dyd_cert_fraction t;
  dyd_exact zero;
  dyd_cert_fraction_init(&t);
  dyd_exact_init(&zero);
  for (int axis = 0; axis < 2; axis++) {
    const dyd_cert_side *side = &s->side[axis];
    bool high = (dyd_exact_sgn(&u[axis]) > 0) == upper;
    dyd_cert_fraction_sub(&t, high ? dyd_cert_high(side) : &side->lo, dyd_cert_den(side), &zero, NULL);
    dyd_exact_mul(&t.num, &t.num, &u[axis]);
    if (axis == 0)
      dyd_cert_fraction_swap(out, &t);
    else
      dyd_cert_fraction_add(out, out, &t);
  }
  dyd_cert_fraction_clear(&t);
  dyd_exact_clear(&zero);
}

int dyd_cert_compare_heights(const dyd_cert_sites *s, const dyd_exact u[2], uint32_t a, uint32_t b) {
  dyd_cert_fraction x, y;
  dyd_cert_fraction_init(&x);
  dyd_cert_fraction_init(&y);
  site_height(&x, u, &s->site[a], true);
  site_height(&y, u, &s->site[b], false);
  int sign = dyd_cert_fraction_cmp(&x, &y);
  dyd_cert_fraction_clear(&x);
  dyd_cert_fraction_clear(&y);
  return sign;
}
