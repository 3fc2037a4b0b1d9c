/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The oracle of predicate/oracle.h.
 *
 * Candidates are first evaluated in doubles: on integers below 1000 a root is then accurate far better than 1/1000, so
 * a candidate that misses its radius by more than that (relative to its size) is not a circle. The others are checked
 * exactly. */
#include "predicate/oracle.h"

#include <math.h>
#include <stdlib.h>

typedef struct feature {
  bool has[2];
  int at[2];
} feature;

static void number_init(root_number *n) {
  mpq_inits(n->a, n->b, NULL);
}
static void number_clear(root_number *n) {
  mpq_clears(n->a, n->b, NULL);
}

void oracle_circle_init(oracle_circle *k) {
  number_init(&k->x), number_init(&k->y), number_init(&k->r2);
  mpq_init(k->c);
}

void oracle_circle_clear(oracle_circle *k) {
  mpq_clear(k->c);
  number_clear(&k->r2), number_clear(&k->y), number_clear(&k->x);
}

/* Sign of a + b sqrt(c). */
static int number_sign(const mpq_t a, const mpq_t b, const mpq_t c) {
  int sa = mpq_sgn(a), sb = mpq_sgn(c) ? mpq_sgn(b) : 0;
  if (sa >= 0 && sb >= 0) return sa || sb;
  if (sa <= 0 && sb <= 0) return -1;
  mpq_t s, t;
  mpq_inits(s, t, NULL);
  mpq_mul(s, a, a);
  mpq_mul(t, b, b);
  mpq_mul(t, t, c);
  int order = mpq_cmp(s, t);
  mpq_clears(s, t, NULL);
  return order > 0 ? sa : order < 0 ? sb : 0;
}

/* Sign of x - z. */
static int number_cmp_int(const root_number *x, const mpq_t c, long z) {
  mpq_t t;
  mpq_init(t);
  mpq_set_si(t, z, 1);
  mpq_sub(t, x->a, t);
  int sign = number_sign(t, x->b, c);
  mpq_clear(t);
  return sign;
}

/* out += (x - z)^2 */
static void add_square(root_number *out, const root_number *x, const mpq_t c, long z) {
  mpq_t s, t;
  mpq_inits(s, t, NULL);
  mpq_set_si(s, z, 1);
  mpq_sub(s, x->a, s);
  mpq_mul(t, s, x->b);
  mpq_add(out->b, out->b, t);
  mpq_add(out->b, out->b, t);
  mpq_mul(t, s, s);
  mpq_add(out->a, out->a, t);
  mpq_mul(t, x->b, x->b);
  mpq_mul(t, t, c);
  mpq_add(out->a, out->a, t);
  mpq_clears(s, t, NULL);
}

/* Sign of |o - point|^2 - r2, where a coordinate may be omitted (the foot has the coordinate of o). */
static int side_of(const oracle_circle *k, const feature *f) {
  root_number d;
  number_init(&d);
  if (f->has[0]) add_square(&d, &k->x, k->c, f->at[0]);
  if (f->has[1]) add_square(&d, &k->y, k->c, f->at[1]);
  mpq_sub(d.a, d.a, k->r2.a);
  mpq_sub(d.b, d.b, k->r2.b);
  int sign = number_sign(d.a, d.b, k->c);
  number_clear(&d);
  return sign;
}

int oracle_side(const oracle_circle *k, const small_rect *r, dyd_touch touch) {
  bool far = touch == DYD_FARTHEST;
  bool in_x = number_cmp_int(&k->x, k->c, r->end[0]) >= 0 && number_cmp_int(&k->x, k->c, r->end[1]) <= 0;
  bool in_y = number_cmp_int(&k->y, k->c, r->end[2]) >= 0 && number_cmp_int(&k->y, k->c, r->end[3]) <= 0;
  int best = 0;
  bool first = true;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      if ((i == 2 && (far || !in_x)) || (j == 2 && (far || !in_y))) continue;
      feature f = {{i < 2, j < 2}, {i < 2 ? r->end[i] : 0, j < 2 ? r->end[2 + j] : 0}};
      int side = side_of(k, &f);
      if (first || (far ? side > best : side < best)) best = side;
      first = false;
    }
  }
  return best;
}

/* The possible features: 4 corners, then for C the 4 sides. */
static feature feature_of(const small_rect *r, int number) {
  if (number < 4) return (feature){{true, true}, {r->end[number & 1], r->end[2 + (number >> 1)]}};
  feature f = {{number < 6, number >= 6}, {0, 0}};
  f.at[number >= 6] = r->end[number < 6 ? number - 4 : number - 4];
  return f;
}

/* A line of centres (ox + t dx, oy + t dy) in rationals. */
typedef struct track {
  mpq_t o[2], d[2];
} track;

/* The centres at equal distance from p and f: a bisector; from two parallel lines: the middle line. Crossing lines:
 * one of the two diagonals. false: no such line. */
static bool track_set(track *out, const feature *p, const feature *f, const feature *g, int diagonal) {
  bool f_point = f->has[0] && f->has[1];
  if (f_point) {
    int dx = f->at[0] - p->at[0], dy = f->at[1] - p->at[1];
    for (int k = 0; k < 2; k++) {
      mpq_set_si(out->o[k], f->at[k] + p->at[k], 2);
      mpq_canonicalize(out->o[k]);
    }
    mpq_set_si(out->d[0], -dy, 1);
    mpq_set_si(out->d[1], dx, 1);
    return diagonal == 0 && (dx || dy);
  }
  if (f->has[0] == g->has[0]) {
    int k = f->has[0] ? 0 : 1;
    mpq_set_si(out->o[k], f->at[k] + g->at[k], 2);
    mpq_canonicalize(out->o[k]);
    mpq_set_si(out->o[1 - k], p->at[1 - k], 1);
    mpq_set_si(out->d[k], 0, 1);
    mpq_set_si(out->d[1 - k], 1, 1);
    return diagonal == 0 && f->at[k] != g->at[k];
  }
  const feature *v = f->has[0] ? f : g, *h = f->has[0] ? g : f;
  mpq_set_si(out->o[0], v->at[0], 1);
  mpq_set_si(out->o[1], h->at[1], 1);
  mpq_set_si(out->d[0], 1, 1);
  mpq_set_si(out->d[1], diagonal ? -1 : 1, 1);
  return true;
}

/* q[0] + q[1] t + q[2] t^2 += sign * (o + t d - z)^2 */
static void add_quadratic(mpq_t q[3], const mpq_t o, const mpq_t d, long z, int sign) {
  mpq_t s, t;
  mpq_inits(s, t, NULL);
  mpq_set_si(s, z, 1);
  mpq_sub(s, o, s);
  void (*combine)(mpq_t, const mpq_t, const mpq_t) = sign > 0 ? mpq_add : mpq_sub;
  mpq_mul(t, s, s);
  combine(q[0], q[0], t);
  mpq_mul(t, s, d);
  combine(q[1], q[1], t);
  combine(q[1], q[1], t);
  mpq_mul(t, d, d);
  combine(q[2], q[2], t);
  mpq_clears(s, t, NULL);
}

/* t = ta + tb sqrt(c), a root of the quadratic; false when there is none with that number or all t are roots. */
static bool root(mpq_t ta, mpq_t tb, mpq_t c, mpq_t q[3], int which) {
  mpq_set_ui(tb, 0, 1);
  mpq_set_ui(c, 0, 1);
  if (!mpq_sgn(q[2])) {
    if (which || !mpq_sgn(q[1])) return false;
    mpq_div(ta, q[0], q[1]);
    mpq_neg(ta, ta);
    return true;
  }
  mpq_mul(c, q[1], q[1]);
  mpq_mul(ta, q[0], q[2]);
  mpq_mul_2exp(ta, ta, 2);
  mpq_sub(c, c, ta);
  if (mpq_sgn(c) < 0) return false;
  mpq_mul_2exp(ta, q[2], 1);
  mpq_inv(tb, ta);
  mpq_div(ta, q[1], ta);
  mpq_neg(ta, ta);
  if (which) mpq_neg(tb, tb);
  return true;
}

static void place(root_number *out, const mpq_t o, const mpq_t d, const mpq_t ta, const mpq_t tb) {
  mpq_mul(out->a, d, ta);
  mpq_add(out->a, out->a, o);
  mpq_mul(out->b, d, tb);
}

/* The circle through p that meets f and g by distance to the points or lines; four attempts. */
static bool attempt(oracle_circle *out, const feature *p, const feature *f, const feature *g, int number) {
  if (!(f->has[0] && f->has[1]) && g->has[0] && g->has[1]) return attempt(out, p, g, f, number);
  track line;
  mpq_t q[3], ta, tb;
  mpq_inits(q[0], q[1], q[2], ta, tb, line.o[0], line.o[1], line.d[0], line.d[1], NULL);
  bool found = track_set(&line, p, f, g, number >> 1);
  if (found) {
    for (int k = 0; k < 2; k++) {
      add_quadratic(q, line.o[k], line.d[k], p->at[k], 1);
      if (g->has[k]) add_quadratic(q, line.o[k], line.d[k], g->at[k], -1);
    }
    found = root(ta, tb, out->c, q, number & 1);
  }
  if (found) {
    place(&out->x, line.o[0], line.d[0], ta, tb);
    place(&out->y, line.o[1], line.d[1], ta, tb);
    mpq_set_ui(out->r2.a, 0, 1);
    mpq_set_ui(out->r2.b, 0, 1);
    add_square(&out->r2, &out->x, out->c, p->at[0]);
    add_square(&out->r2, &out->y, out->c, p->at[1]);
  }
  mpq_clears(q[0], q[1], q[2], ta, tb, line.o[0], line.o[1], line.d[0], line.d[1], NULL);
  return found;
}

static double value(const root_number *n, const mpq_t c) {
  return mpq_get_d(n->a) + mpq_get_d(n->b) * sqrt(mpq_get_d(c));
}

static bool surely_misses(const oracle_circle *k, const small_rect *r, dyd_touch touch) {
  double o[2] = {value(&k->x, k->c), value(&k->y, k->c)}, r2 = value(&k->r2, k->c), d2 = 0;
  for (int axis = 0; axis < 2; axis++) {
    double lo = r->end[2 * axis], hi = r->end[2 * axis + 1], s = o[axis] - lo, t = hi - o[axis];
    double d = touch == DYD_FARTHEST ? fmax(s, t) : fmax(0, fmax(-s, -t));
    d2 += d * d;
  }
  return fabs(d2 - r2) > 1e-3 * (1 + fabs(r2));
}

static int number_cmp(const root_number *x, const mpq_t c, const root_number *y, const mpq_t e) {
  /* Sign of (xa - ya) + xb sqrt c - yb sqrt e: both sides of xa + xb sqrt c = ya + yb sqrt e squared once. */
  mpq_t p, s, t, zero;
  mpq_inits(p, s, t, zero, NULL);
  mpq_sub(p, x->a, y->a);
  int left = number_sign(p, x->b, c), right = number_sign(zero, y->b, e), sign;
  if (left != right) {
    sign = left > right ? 1 : -1;
  } else if (!left) {
    sign = 0;
  } else { /* compare (p + xb sqrt c)^2 with yb^2 e */
    mpq_mul(s, p, p);
    mpq_mul(t, x->b, x->b);
    mpq_mul(t, t, c);
    mpq_add(s, s, t);
    mpq_mul(t, y->b, y->b);
    mpq_mul(t, t, e);
    mpq_sub(s, s, t);
    mpq_mul(t, p, x->b);
    mpq_mul_2exp(t, t, 1);
    sign = left * number_sign(s, t, c);
  }
  mpq_clears(p, s, t, zero, NULL);
  return sign;
}

static bool is_new(const oracle_circle *out, size_t count, const oracle_circle *k) {
  for (size_t i = 0; i < count; i++) {
    if (!number_cmp(&out[i].x, out[i].c, &k->x, k->c) && !number_cmp(&out[i].y, out[i].c, &k->y, k->c)) return false;
  }
  return true;
}

static bool is_critical(const oracle_circle *k, const small_rect r[3], const dyd_touch touch[3]) {
  if (number_sign(k->r2.a, k->r2.b, k->c) <= 0) return false;
  for (int m = 0; m < 3; m++) {
    if (surely_misses(k, &r[m], touch[m])) return false;
  }
  for (int m = 0; m < 3; m++) {
    if (oracle_side(k, &r[m], touch[m])) return false;
  }
  return true;
}

size_t oracle_circles(oracle_circle *out, size_t room, const small_rect r[3], const dyd_touch touch[3]) {
  int base = touch[0] == DYD_FARTHEST ? 0 : touch[1] == DYD_FARTHEST ? 1 : 2;
  int i = (base + 1) % 3, j = (base + 2) % 3;
  size_t count = 0;
  oracle_circle k, t;
  oracle_circle_init(&k);
  for (int combination = 0; combination < 4 * 8 * 8; combination++) {
    int nf = combination / 4 % 8, ng = combination / 32;
    if ((touch[i] == DYD_FARTHEST && nf >= 4) || (touch[j] == DYD_FARTHEST && ng >= 4)) continue;
    feature p = feature_of(&r[base], combination % 4), f = feature_of(&r[i], nf), g = feature_of(&r[j], ng);
    for (int number = 0; number < 4; number++) {
      if (!attempt(&k, &p, &f, &g, number) || !is_critical(&k, r, touch) || !is_new(out, count, &k)) continue;
      if (count == room) continue;
      t = out[count];
      out[count++] = k;
      k = t;
    }
  }
  oracle_circle_clear(&k);
  return count;
}

dyd_sure oracle_orientation(const small_rect *a, const small_rect *b, const small_rect *c) {
  int seen[3] = {0, 0, 0};
  for (int k = 0; k < 64; k++) {
    long px = a->end[k & 1], py = a->end[2 + (k >> 1 & 1)], qx = b->end[k >> 2 & 1], qy = b->end[2 + (k >> 3 & 1)];
    long rx = c->end[k >> 4 & 1], ry = c->end[2 + (k >> 5 & 1)];
    long det = (qx - px) * (ry - py) - (qy - py) * (rx - px);
    seen[(det > 0) - (det < 0) + 1]++;
  }
  return seen[2] == 64 ? DYD_SURE_PLUS : seen[0] == 64 ? DYD_SURE_MINUS : DYD_UNSURE;
}

dyd_sure oracle_con(const small_rect *r, const small_rect abc[3]) {
  if (oracle_orientation(&abc[0], &abc[1], &abc[2]) == DYD_UNSURE) return DYD_UNSURE;
  oracle_circle k[2];
  oracle_circle_init(&k[0]), oracle_circle_init(&k[1]);
  bool inside = true, outside = true;
  for (int m = 0; m < 6; m++) {
    dyd_touch odd = m < 3 ? DYD_FARTHEST : DYD_CLOSEST, even = m < 3 ? DYD_CLOSEST : DYD_FARTHEST;
    dyd_touch touch[3] = {even, even, even};
    touch[m % 3] = odd;
    if (oracle_circles(k, 2, abc, touch) != 1) abort(); /* the circle of a surely oriented triple is unique */
    if (m < 3) inside = inside && oracle_side(&k[0], r, DYD_FARTHEST) < 0;
    if (m >= 3) outside = outside && oracle_side(&k[0], r, DYD_CLOSEST) > 0;
  }
  oracle_circle_clear(&k[1]), oracle_circle_clear(&k[0]);
  return inside ? DYD_SURE_PLUS : outside ? DYD_SURE_MINUS : DYD_UNSURE;
}

static bool same_coordinate(const root_number *x, const mpq_t c, mpz_srcptr a, mpz_srcptr b, const dyd_circle *k) {
  root_number y;
  mpq_t e;
  number_init(&y);
  mpq_init(e);
  mpz_set(mpq_numref(y.a), a);
  mpz_set(mpq_denref(y.a), k->d);
  mpz_set(mpq_numref(y.b), b);
  mpz_set(mpq_denref(y.b), k->d);
  mpq_canonicalize(y.a);
  mpq_canonicalize(y.b);
  mpq_set_z(e, k->c);
  bool same = number_cmp(x, c, &y, e) == 0;
  mpq_clear(e);
  number_clear(&y);
  return same;
}

bool oracle_same_centre(const oracle_circle *k, const dyd_circle *c) {
  return same_coordinate(&k->x, k->c, c->ax, c->bx, c) && same_coordinate(&k->y, k->c, c->ay, c->by, c);
}

void small_rect_get(dyd_rect *out, const small_rect *r) {
  (void)dyd_rect_set_d(out, r->end[0], r->end[1], r->end[2], r->end[3]);
}
