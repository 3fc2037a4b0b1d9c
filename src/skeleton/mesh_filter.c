/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rungs in their order: filter, fixed-size integers, GMP. */
#include "skeleton/mesh_filter.h"

#include "base/alloc.h"
#include "base/local.h"
#include "rect/irect.h"
#include "rect/rect.h"
#include "skeleton/mesh.h"

#include <math.h>
#include <string.h>

/* ---- doubles again, with bounds for these points alone ---- */

int dyd_filter_orient_near(const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy p) {
  double left = (a.x - p.x) * (b.y - p.y), right = (a.y - p.y) * (b.x - p.x), d = left - right;
  double e = 4.01 * 0x1p-53 * (fabs(left) + fabs(right)) + 0x1p-1000;
  if (m->incircle_delta > 0) return 0;
  if (d > e) return 1;
  return d < -e ? -1 : 0;
}

int dyd_filter_incircle_near(const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy c, dyd_xy p) {
  double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y, cx = c.x - p.x, cy = c.y - p.y;
  double la = ax * ax + ay * ay, lb = bx * bx + by * by, lc = cx * cx + cy * cy;
  double a1 = bx * cy, a2 = by * cx, b1 = cx * ay, b2 = cy * ax, c1 = ax * by, c2 = ay * bx;
  double d = la * (a1 - a2) + lb * (b1 - b2) + lc * (c1 - c2);
  double e = la * (fabs(a1) + fabs(a2)) + lb * (fabs(b1) + fabs(b2)) + lc * (fabs(c1) + fabs(c2));
  e = 11.05 * 0x1p-53 * e + 0x1p-1060 * (la + lb + lc + 1);
  if (m->incircle_delta > 0) return 0;
  if (d > e) return 1;
  return d < -e ? -1 : 0;
}

bool dyd_filter_orient_small(int *sign, const dyd_mesh *m, dyd_xy a, dyd_xy b, dyd_xy p) {
  double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y;
  if (!(ax * ax + ay * ay + bx * bx + by * by <= m->exact_s)) return false;
  double d = ax * by - ay * bx;
  *sign = (d > 0) - (d < 0);
  return true;
}

/* ---- fixed-size integers ----
 *
 * Coordinates are below 2^60, so differences are below 2^61, products of two below 2^122, cross products and lifts
 * below 2^123, and the three products of the in-circle determinant below 2^246: their sum fits 256 bits [FIX-1]. */

__extension__ typedef __int128 i128;

__extension__ typedef unsigned __int128 u128;

/* Invariant: z != NULL: z[v - first] are the coordinates of v times den 2^-low; else they are xy[v] * 2^-unit, exactly,
 * and below 2^(high - unit). */
struct dyd_fixed {
  int unit, high;
  uint32_t first;
  unsigned long den;
  int64_t low, (*z)[2];
};

enum { COORDINATE_BITS = 60 };

/* With room for the coordinates of that number of vertices behind it. */
static size_t fixed_size(size_t vertices) {
  return sizeof(dyd_fixed) + vertices * sizeof(int64_t[2]);
}

/* x = man * 2^exp, man odd; x finite, not 0 and not subnormal (false otherwise). */
static bool exponent_range(int *low, int *high, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  int e = (int)(bits >> 52 & 2047);
  uint64_t man = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52;
  if (x == 0) return true;
  if (e == 0) return false;
  int l = e - 1075 + __builtin_ctzll(man), h = e - 1022;
  if (l < *low) *low = l;
  if (h > *high) *high = h;
  return true;
}

/* The same for every finite x. */
static void widen_range(int *low, int *high, double x) {
  int e;
  if (exponent_range(low, high, x)) return;
  int64_t man = (int64_t)ldexp(frexp(x, &e), 53);
  int l = e - 53 + __builtin_ctzll((uint64_t)man);
  if (l < *low) *low = l;
  if (e > *high) *high = e;
}

/* The unit is the lowest bit of all coordinates; false when they span too many bits. */
static bool set_range(dyd_fixed *f, int low, int high) {
  f->unit = low == INT32_MAX ? 0 : low;
  f->high = low == INT32_MAX ? 0 : high;
  return f->high - f->unit <= COORDINATE_BITS;
}

static bool prepare_doubles(dyd_fixed *f, const dyd_mesh *m) {
  int low = INT32_MAX, high = INT32_MIN;
  for (uint32_t v = m->begin; v < m->end; v++) {
    widen_range(&low, &high, m->xy[v].x);
    widen_range(&low, &high, m->xy[v].y);
  }
  return set_range(f, low, high);
}

dyd_status dyd_mesh_get(dyd_rect *out, const dyd_mesh *m, uint32_t v) {
  return dyd_reps_get(out, m->reps, dyd_mesh_rep(m, v));
}

/* The common denominator and the least binary exponent of all representatives; false when they are too big. */
static bool common_scale(mpz_t lcm, int64_t *low, dyd_rect *q, const dyd_mesh *m) {
  mpz_set_ui(lcm, 1);
  *low = INT64_MAX;
  for (uint32_t v = m->begin; v < m->end; v++) {
    if (dyd_mesh_get(q, m, v) != DYD_OK) return false;
    const dyd_interval *side[2] = {&q->x, &q->y};
    for (int a = 0; a < 2; a++) {
      mpz_lcm(lcm, lcm, side[a]->den);
      if (mpz_sizeinbase(lcm, 2) > COORDINATE_BITS) return false;
      if (mpz_sgn(side[a]->lo.man) && side[a]->lo.exp < *low) *low = side[a]->lo.exp;
    }
  }
  return true;
}

static bool scaled(int64_t *out, mpz_t t, const dyd_interval *a, const mpz_t lcm, int64_t low) {
  if (mpz_sgn(a->lo.man) == 0) return *out = 0, true;
  if (a->lo.exp - low > COORDINATE_BITS) return false;
  mpz_divexact(t, lcm, a->den);
  mpz_mul(t, t, a->lo.man);
  mpz_mul_2exp(t, t, (mp_bitcnt_t)(a->lo.exp - low));
  if (mpz_sizeinbase(t, 2) > COORDINATE_BITS) return false;
  *out = mpz_get_si(t);
  return true;
}

static bool prepare_rationals(dyd_fixed *f, const dyd_mesh *m) {
  DYD_LOCAL_NUMBERS(mpz, lcm, t);
  DYD_LOCAL(dyd_rect, q);
  bool good = common_scale(lcm, &f->low, &q, m);
  f->z = (int64_t(*)[2])(f + 1);
  f->first = m->begin;
  f->den = mpz_get_ui(lcm);
  for (uint32_t v = m->begin; v < m->end && good; v++) {
    int64_t *z = f->z[v - f->first];
    good =
        dyd_mesh_get(&q, m, v) == DYD_OK && scaled(&z[0], t, &q.x, lcm, f->low) && scaled(&z[1], t, &q.y, lcm, f->low);
  }
  return good;
}

static void install(dyd_mesh *m, dyd_fixed *f) {
  m->exact_s = f && !f->z && f->unit >= -240 && f->unit <= 220 ? ldexp(1, 26 + 2 * f->unit) : -1;
  m->fixed = f;
  m->no_fixed = !f;
}

void dyd_fixed_prepare(dyd_mesh *m) {
  if (m->fixed || m->no_fixed || m->no_filter) return;
  dyd_fixed *f = calloc(1, fixed_size(m->reps->code ? m->end - m->begin : 0));
  if (f && !(m->reps->code ? prepare_rationals(f, m) : prepare_doubles(f, m))) {
    free(f);
    f = NULL;
  }
  install(m, f);
}

void dyd_mesh_follow(dyd_mesh *m) {
  free(m->fixed);
  m->fixed = NULL;
  m->incircle_delta = m->no_filter ? INFINITY : m->reps->delta;
  m->orient_bound = dyd_filter_orient_bound(m->extent[0], m->extent[1], m->reps->delta);
  if (m->no_filter || isnan(m->orient_bound)) m->orient_bound = INFINITY;
}

/* *f, of m, gets the coordinates of its right neighbour. */
static bool append_rationals(dyd_fixed **f, const dyd_fixed *g, const dyd_mesh *m, const dyd_mesh *right) {
  size_t left = m->end - m->begin, more = right->end - right->begin;
  if ((*f)->den != g->den || (*f)->low != g->low) return false;
  dyd_fixed *all = realloc(*f, fixed_size(left + more));
  if (!all) return false;
  all->z = (int64_t(*)[2])(all + 1);
  memcpy(all->z + left, g->z, more * sizeof *g->z);
  *f = all;
  return true;
}

static bool join_ranges(dyd_fixed *f, const dyd_fixed *g) {
  return set_range(f, f->unit < g->unit ? f->unit : g->unit, f->high > g->high ? f->high : g->high);
}

/* Fractions that both do not know cost too much for the few questions of a seam. */
void dyd_fixed_join(dyd_mesh *m, const dyd_mesh *right) {
  dyd_fixed *f = m->fixed;
  const dyd_fixed *g = right->fixed;
  bool fractions = m->reps->code;
  if (f && g && (fractions ? append_rationals(&f, g, m, right) : join_ranges(f, g))) {
    install(m, f);
    return;
  }
  free(f);
  m->fixed = NULL;
  m->no_fixed = m->no_fixed || right->no_fixed || (f && g) || fractions;
  m->exact_s = m->no_fixed ? -1 : 0;
}

void dyd_fixed_take(dyd_mesh *m, dyd_mesh *whole) {
  m->fixed = whole->fixed;
  m->no_fixed = whole->no_fixed && !m->reps->code; /* of all fractions it was not tried */
  m->exact_s = whole->exact_s;
  whole->fixed = NULL;
}

static void coordinates(int64_t z[2], const dyd_mesh *m, uint32_t v) {
  const dyd_fixed *f = m->fixed;
  if (f->z) {
    z[0] = f->z[v - f->first][0];
    z[1] = f->z[v - f->first][1];
  } else {
    z[0] = (int64_t)ldexp(m->xy[v].x, -f->unit);
    z[1] = (int64_t)ldexp(m->xy[v].y, -f->unit);
  }
}

static void difference(int64_t d[2], const dyd_mesh *m, uint32_t v, const int64_t p[2]) {
  coordinates(d, m, v);
  d[0] -= p[0];
  d[1] -= p[1];
}

static i128 cross(const int64_t a[2], const int64_t b[2]) {
  return (i128)a[0] * b[1] - (i128)a[1] * b[0];
}

static i128 lift(const int64_t a[2]) {
  return (i128)a[0] * a[0] + (i128)a[1] * a[1];
}

int dyd_fixed_orient(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  int64_t zc[2], da[2], db[2];
  coordinates(zc, m, c);
  difference(da, m, a, zc);
  difference(db, m, b, zc);
  i128 d = cross(da, db);
  return (d > 0) - (d < 0);
}

/* A 256-bit two's complement number, low half first. */
typedef struct i256 {
  u128 low, high;
} i256;

/* lift >= 0 times cross, signed. */
static i256 product(i128 lift_value, i128 cross_value) {
  bool negative = cross_value < 0;
  u128 x = (u128)lift_value, y = negative ? -(u128)cross_value : (u128)cross_value;
  uint64_t x0 = (uint64_t)x, x1 = (uint64_t)(x >> 64), y0 = (uint64_t)y, y1 = (uint64_t)(y >> 64);
  u128 p00 = (u128)x0 * y0, p01 = (u128)x0 * y1, p10 = (u128)x1 * y0, p11 = (u128)x1 * y1;
  u128 middle = (p00 >> 64) + (uint64_t)p01 + (uint64_t)p10;
  i256 r = {(uint64_t)p00 | middle << 64, p11 + (p01 >> 64) + (p10 >> 64) + (middle >> 64)};
  if (negative) {
    r.low = -r.low;
    r.high = ~r.high + (r.low == 0);
  }
  return r;
}

static i256 sum(i256 a, i256 b) {
  i256 r = {a.low + b.low, a.high + b.high};
  r.high += r.low < a.low;
  return r;
}

/* The four points as integers on their own common scale; false when they span too many bits. */
static bool near_coordinates(int64_t z[4][2], const dyd_mesh *m, const uint32_t v[4]) {
  int low = INT32_MAX, high = INT32_MIN;
  for (unsigned k = 0; k < 4; k++)
    if (!exponent_range(&low, &high, m->xy[v[k]].x) || !exponent_range(&low, &high, m->xy[v[k]].y)) return false;
  if (low == INT32_MAX) low = high = 0;
  if (high - low > COORDINATE_BITS || low < -1000 || low > 900) return false;
  uint64_t bits = (uint64_t)(1023 - low) << 52;
  double scale;
  memcpy(&scale, &bits, sizeof scale);
  for (unsigned k = 0; k < 4; k++) {
    z[k][0] = (int64_t)(m->xy[v[k]].x * scale);
    z[k][1] = (int64_t)(m->xy[v[k]].y * scale);
  }
  return true;
}

bool dyd_fixed_incircle(int *sign, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int64_t z[4][2];
  if (m->fixed && m->fixed->z) {
    const uint32_t v[4] = {a, b, c, p};
    for (unsigned k = 0; k < 4; k++) coordinates(z[k], m, v[k]);
  } else if (m->reps->code || !near_coordinates(z, m, (const uint32_t[]){a, b, c, p}))
    return false;
  for (unsigned k = 0; k < 3; k++)
    for (unsigned i = 0; i < 2; i++) z[k][i] -= z[3][i];
  i256 d = product(lift(z[0]), cross(z[1], z[2]));
  d = sum(d, product(lift(z[1]), cross(z[2], z[0])));
  d = sum(d, product(lift(z[2]), cross(z[0], z[1])));
  if ((i128)d.high < 0)
    *sign = -1;
  else
    *sign = d.high != 0 || d.low != 0;
  return true;
}

/* ---- GMP integers on a common scale ---- */

typedef struct scaled_corners {
  dyd_irect p[4];
  size_t count;
} scaled_corners;

/* Cannot fail: every representative lies in the exponent range, since its rectangle does. */
static void points_load(scaled_corners *s, const dyd_mesh *m, const uint32_t *v, size_t count) {
  DYD_LOCAL_ARRAY(dyd_rect, r, [4]);
  const dyd_rect *in[4] = {NULL};
  s->count = count;
  for (size_t k = 0; k < count; k++) {
    dyd_irect_init(&s->p[k]);
    (void)dyd_mesh_get(&r[k], m, v[k]);
    in[k] = &r[k];
  }
  dyd_irects_scale(s->p, in, count, NULL, NULL);
}

static void scaled_corners_clear(scaled_corners *s) {
  for (size_t k = 0; k < s->count; k++) dyd_irect_clear(&s->p[k]);
}

/* Moves the origin to the last point. */
static void points_recentre(scaled_corners *s) {
  const dyd_irect *o = &s->p[s->count - 1];
  for (size_t k = 0; k + 1 < s->count; k++) {
    mpz_sub(s->p[k].x0, s->p[k].x0, o->x0);
    mpz_sub(s->p[k].y0, s->p[k].y0, o->y0);
  }
}

static void points_cross(mpz_t out, mpz_t t, const dyd_irect *a, const dyd_irect *b) {
  mpz_mul(out, a->x0, b->y0);
  mpz_mul(t, a->y0, b->x0);
  mpz_sub(out, out, t);
}

int dyd_mesh_orient_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  DYD_SCOPED(scaled_corners) s;
  DYD_LOCAL_NUMBERS(mpz, d, t);
  points_load(&s, m, (const uint32_t[]){a, b, c}, 3);
  points_recentre(&s);
  points_cross(d, t, &s.p[0], &s.p[1]);
  return mpz_sgn(d);
}

int dyd_mesh_incircle_exact(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  DYD_SCOPED(scaled_corners) s;
  DYD_LOCAL_NUMBERS(mpz, d, l, x, t);
  points_load(&s, m, (const uint32_t[]){a, b, c, p}, 4);
  points_recentre(&s);
  for (unsigned k = 0; k < 3; k++) {
    const dyd_irect *q = &s.p[k];
    mpz_mul(l, q->x0, q->x0);
    mpz_addmul(l, q->y0, q->y0);
    points_cross(x, t, &s.p[dyd_next(k)], &s.p[dyd_prev(k)]);
    mpz_addmul(d, l, x);
  }
  return mpz_sgn(d);
}

int dyd_mesh_compare(const dyd_mesh *m, uint32_t a, uint32_t b) {
  double x = m->xy[a].x - m->xy[b].x, y = m->xy[a].y - m->xy[b].y;
  if (!m->reps->code || fabs(x) > 4 * m->reps->delta) return x != 0 ? (x > 0) - (x < 0) : (y > 0) - (y < 0);
  DYD_SCOPED(scaled_corners) s;
  points_load(&s, m, (const uint32_t[]){a, b}, 2);
  int sign = mpz_cmp(s.p[0].x0, s.p[1].x0);
  if (!sign) sign = mpz_cmp(s.p[0].y0, s.p[1].y0);
  return (sign > 0) - (sign < 0);
}

static bool is_strictly_between(double a, double b, double p) {
  return a < b ? a < p && p < b : b < p && p < a;
}

bool dyd_mesh_between(const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  if (!m->reps->code && !m->no_filter) /* on one line either coordinate decides, unless it is the same for all */
    return is_strictly_between(m->xy[a].x, m->xy[b].x, m->xy[p].x) ||
           is_strictly_between(m->xy[a].y, m->xy[b].y, m->xy[p].y);
  DYD_SCOPED(scaled_corners) s;
  DYD_LOCAL_NUMBERS(mpz, d);
  points_load(&s, m, (const uint32_t[]){a, b, p}, 3);
  points_recentre(&s);
  mpz_mul(d, s.p[0].x0, s.p[1].x0);
  mpz_addmul(d, s.p[0].y0, s.p[1].y0);
  return mpz_sgn(d) < 0;
}

static int orient_slow(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  if (!m->no_filter) {
    int sign = dyd_filter_orient_near(m, m->xy[a], m->xy[b], m->xy[c]);
    if (sign || dyd_filter_orient_small(&sign, m, m->xy[a], m->xy[b], m->xy[c])) return sign;
    if (m->fixed) return tally->integer++, dyd_fixed_orient(m, a, b, c);
  }
  tally->exact++;
  return dyd_mesh_orient_exact(m, a, b, c);
}

int dyd_mesh_orient(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  tally->asked++;
  int sign = dyd_filter_orient(m, m->xy[a], m->xy[b], m->xy[c]);
  return sign ? sign : orient_slow(tally, m, a, b, c);
}

static int incircle_real(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int sign;
  if (!m->no_filter) {
    if ((sign = dyd_filter_incircle_near(m, m->xy[a], m->xy[b], m->xy[c], m->xy[p]))) return sign;
    if (dyd_fixed_incircle(&sign, m, a, b, c, p)) return tally->integer++, sign;
  }
  tally->exact++;
  return dyd_mesh_incircle_exact(m, a, b, c, p);
}

/* Counted with the in-circle test that it answers. */
static int incircle_ghost(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  int side = dyd_filter_orient(m, m->xy[a], m->xy[b], m->xy[p]);
  if (!side) side = orient_slow(tally, m, a, b, p);
  if (side) return side;
  tally->ties++;
  return dyd_mesh_between(m, a, b, p) ? 1 : 0;
}

static int incircle_slow(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  if (a == m->n) return incircle_ghost(tally, m, b, c, p);
  if (b == m->n) return incircle_ghost(tally, m, c, a, p);
  if (c == m->n) return incircle_ghost(tally, m, a, b, p);
  int sign = incircle_real(tally, m, a, b, c, p);
  if (!sign) tally->ties++;
  return sign;
}

int dyd_mesh_incircle(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int sign;
  return dyd_incircle_quick(&sign, tally, m, a, b, c, p) ? sign : incircle_slow(tally, m, a, b, c, p);
}

int dyd_mesh_beyond(dyd_tally *tally, const dyd_mesh *m, dyd_half_edge h) {
  const uint32_t *v = m->tri[dyd_edge_triangle(h)].v;
  return dyd_mesh_incircle(tally, m, v[0], v[1], v[2], dyd_edge_across(m, h));
}

bool dyd_point_edge_is_certain(dyd_tally *tally, const dyd_mesh *m, dyd_half_edge h) {
  bool hull = dyd_edge_apex(m, h) == m->n || dyd_edge_across(m, h) == m->n;
  return hull || dyd_mesh_beyond(tally, m, h) < 0;
}

/* The grid costs O(n), so it is made when the filters have said that they do not know. It may find that integers are
 * small. */
int dyd_build_orient_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  bool tried = m->fixed || m->no_fixed;
  if (!tried && !dyd_filter_orient_near(m, m->xy[a], m->xy[b], m->xy[c])) dyd_fixed_prepare(m);
  return orient_slow(&m->tally, m, a, b, c);
}

int dyd_build_incircle_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  uint32_t g = m->n, u = a == g ? b : b == g ? c : a, v = a == g ? c : b == g ? a : b;
  bool real = a != g && b != g && c != g, tried = m->fixed || m->no_fixed;
  int sign;
  if (!tried && (real || !dyd_filter_orient(m, m->xy[u], m->xy[v], m->xy[p]))) dyd_fixed_prepare(m);
  if (!tried && m->exact_s > 0 &&
      dyd_filter_incircle_small(&sign, m, dyd_incircle_of(m->xy[a], m->xy[b], m->xy[c], m->xy[p])))
    return m->tally.ties += !sign, sign;
  return incircle_slow(&m->tally, m, a, b, c, p);
}

/* ---- the invariant, edge by edge with the exact rung ---- */

static bool twins_agree(const dyd_mesh *m, dyd_half_edge h) {
  dyd_half_edge twin = dyd_edge_twin(m, h);
  return dyd_edge_triangle(twin) < m->count && dyd_edge_corner(twin) < 3 && dyd_edge_twin(m, twin) == h &&
         dyd_edge_origin(m, twin) == dyd_edge_target(m, h) && dyd_edge_target(m, twin) == dyd_edge_origin(m, h);
}

static bool edge_is_delaunay(const dyd_mesh *m, dyd_half_edge h) {
  uint32_t t = dyd_edge_triangle(h), p = dyd_edge_across(m, h);
  const uint32_t *v = m->tri[t].v;
  if (p == m->n) return true;
  if (!dyd_is_ghost_triangle(m, t)) return dyd_mesh_incircle_exact(m, v[0], v[1], v[2], p) <= 0;
  dyd_half_edge hull = dyd_hull_edge(m, t);
  return dyd_mesh_orient_exact(m, dyd_edge_origin(m, hull), dyd_edge_target(m, hull), p) <= 0;
}

/* All hull edges are in one cycle, and it goes to the right once and back once: a cycle that is convex everywhere could
 * wind twice around overlapping parts. */
static bool hull_turns_once(const dyd_mesh *m) {
  uint32_t ghosts = 0, met = 0, turns = 0;
  dyd_half_edge first = DYD_NONE;
  for (uint32_t t = 0; t < m->count; t++)
    if (dyd_is_ghost_triangle(m, t)) ghosts++, first = dyd_hull_edge(m, t);
  if (!ghosts) return false;
  dyd_half_edge h = first;
  bool before = false;
  do {
    bool right = dyd_mesh_compare(m, dyd_hull_origin(m, h), dyd_hull_target(m, h)) < 0;
    turns += met && right != before;
    before = right;
    h = dyd_hull_following(m, h);
  } while (++met <= ghosts && h != first);
  return met == ghosts && turns <= 2;
}

bool dyd_mesh_is_valid(const dyd_mesh *m) {
  if (m->count == 0) return true; /* all on one line */
  if (!hull_turns_once(m)) return false;
  for (uint32_t t = 0; t < m->count; t++) {
    const uint32_t *v = m->tri[t].v;
    if (!dyd_is_ghost_triangle(m, t) && dyd_mesh_orient_exact(m, v[0], v[1], v[2]) <= 0) return false;
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++)
      if (!twins_agree(m, h) || !edge_is_delaunay(m, h)) return false;
  }
  return true;
}
