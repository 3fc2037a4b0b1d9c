/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact work on polygons with dyadic vertices: turns, hulls, areas, simplicity. */
#include "voronoi/polygon.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "dyadic/raw.h"

void dyd_polygon_clear(dyd_polygon *p) {
  for (size_t k = 0; k < p->count; k++) dyd_point_clear(&p->vertex[k]);
  free(p->vertex);
  *p = (dyd_polygon){0};
}

void dyd_polygon_list_clear(dyd_polygon_list *l) {
  for (size_t k = 0; k < l->count; k++) dyd_polygon_clear(&l->item[k]);
  free(l->item);
  *l = (dyd_polygon_list){0};
}

/* A difference of dyadics without bounds on its exponent. */
typedef struct raw {
  mpz_t man;
  int64_t exp;
} raw;

static void raw_product(raw *out, const raw *a, const raw *b) {
  mpz_mul(out->man, a->man, b->man);
  out->exp = a->exp + b->exp;
}

/* a -= b, aligned to the lower exponent. */
static void raw_subtract(raw *a, raw *b) {
  if (a->exp > b->exp) {
    mpz_mul_2exp(a->man, a->man, (mp_bitcnt_t)(a->exp - b->exp));
    a->exp = b->exp;
  } else if (b->exp > a->exp) {
    mpz_mul_2exp(b->man, b->man, (mp_bitcnt_t)(b->exp - a->exp));
  }
  mpz_sub(a->man, a->man, b->man);
}

/* r[0] = (b - a) x (c - a); r[1..5] are scratch. */
static void raw_cross(raw r[6], const dyd_point *a, const dyd_point *b, const dyd_point *c) {
  dyd_raw_add(r[2].man, &r[2].exp, &b->x, &a->x, -1);
  dyd_raw_add(r[3].man, &r[3].exp, &c->y, &a->y, -1);
  dyd_raw_add(r[4].man, &r[4].exp, &b->y, &a->y, -1);
  dyd_raw_add(r[5].man, &r[5].exp, &c->x, &a->x, -1);
  raw_product(&r[0], &r[2], &r[3]);
  raw_product(&r[1], &r[4], &r[5]);
  if (mpz_sgn(r[0].man) == 0) r[0].exp = r[1].exp;
  if (mpz_sgn(r[1].man) == 0) r[1].exp = r[0].exp;
  raw_subtract(&r[0], &r[1]);
}

static void raws_init(raw *r, size_t n) {
  for (size_t k = 0; k < n; k++) {
    mpz_init(r[k].man);
    r[k].exp = 0;
  }
}
static void raws_clear(raw *r, size_t n) {
  for (size_t k = 0; k < n; k++) mpz_clear(r[k].man);
}

/* Sign of the turn a, b, c: > 0 left. */
static int turn_sign(const dyd_point *a, const dyd_point *b, const dyd_point *c) {
  raw r[6];
  raws_init(r, 6);
  raw_cross(r, a, b, c);
  int sign = mpz_sgn(r[0].man);
  raws_clear(r, 6);
  return sign;
}

dyd_status dyd_polygon_area2(dyd_dyadic *out, const dyd_polygon *p) {
  raw r[6];
  dyd_dyadic sum, term;
  raws_init(r, 6);
  dyd_dyadic_init(&sum);
  dyd_dyadic_init(&term);
  dyd_status st = DYD_OK;
  for (size_t k = 1; k + 1 < p->count && st == DYD_OK; k++) {
    raw_cross(r, &p->vertex[0], &p->vertex[k], &p->vertex[k + 1]);
    st = dyd_dyadic_take(&term, r[0].man, r[0].exp);
    if (st == DYD_OK) st = dyd_dyadic_add(&sum, &sum, &term);
  }
  if (st == DYD_OK) dyd_dyadic_swap(out, &sum);
  dyd_dyadic_clear(&term);
  dyd_dyadic_clear(&sum);
  raws_clear(r, 6);
  return st;
}

/* ---- hull ---- */

static int compare_vertices(const void *a, const void *b) {
  const dyd_point *p = a, *q = b;
  int c = dyd_dyadic_cmp(&p->x, &q->x);
  return c ? c : dyd_dyadic_cmp(&p->y, &q->y);
}

/* Extends the chain of `kept` borrowed points by z, popping what is no left turn; stays above `floor`. */
static size_t extend_chain(const dyd_point **chain, size_t kept, size_t floor, const dyd_point *z) {
  while (kept >= floor + 2 && turn_sign(chain[kept - 2], chain[kept - 1], z) <= 0) kept--;
  chain[kept++] = z;
  return kept;
}

/* Monotone chains: lower, then upper. */
dyd_status dyd_polygon_make_convex(dyd_polygon *p) {
  size_t n = p->count, kept = 0;
  const dyd_point **chain = dyd_alloc(2 * n + 1, sizeof *chain);
  if (!chain) return DYD_E_NOMEM;
  qsort(p->vertex, n, sizeof *p->vertex, compare_vertices);
  for (size_t k = 0; k < n; k++) kept = extend_chain(chain, kept, 0, &p->vertex[k]);
  size_t floor = kept ? kept - 1 : 0;
  for (size_t k = n; k-- > 1;) kept = extend_chain(chain, kept, floor, &p->vertex[k - 1]);
  kept = kept ? kept - 1 : 0; /* the first point again */
  dyd_polygon hull = {0};
  if (kept >= 3) hull.vertex = dyd_alloc(kept, sizeof *hull.vertex);
  dyd_status st = kept >= 3 && !hull.vertex ? DYD_E_NOMEM : DYD_OK;
  for (size_t k = 0; st == DYD_OK && kept >= 3 && k < kept; k++) {
    dyd_point_init(&hull.vertex[k]);
    dyd_point_set(&hull.vertex[k], chain[k]);
    hull.count++;
  }
  free(chain);
  if (st != DYD_OK) return st;
  dyd_polygon_clear(p);
  *p = hull;
  return DYD_OK;
}

/* ---- simplicity ---- */

static bool on_segment(const dyd_point *z, const dyd_point *a, const dyd_point *b) {
  return compare_vertices(z, a) * compare_vertices(z, b) <= 0; /* z is on the line ab */
}

/* Do the closed segments ab and cd meet? */
static bool segments_meet(const dyd_point *a, const dyd_point *b, const dyd_point *c, const dyd_point *d) {
  int s = turn_sign(a, b, c), t = turn_sign(a, b, d), u = turn_sign(c, d, a), v = turn_sign(c, d, b);
  if (s * t < 0 && u * v < 0) return true;
  return (s == 0 && on_segment(c, a, b)) || (t == 0 && on_segment(d, a, b)) || (u == 0 && on_segment(a, c, d)) ||
         (v == 0 && on_segment(b, c, d));
}

/* Edges ab and bc: do they overlap beyond b? */
static bool folds_back(const dyd_point *a, const dyd_point *b, const dyd_point *c) {
  return turn_sign(a, b, c) == 0 && compare_vertices(a, b) * compare_vertices(b, c) < 0;
}

static void drop_repeats(dyd_polygon *p) {
  size_t kept = 0;
  for (size_t k = 0; k < p->count; k++) {
    const dyd_point *last = &p->vertex[kept ? kept - 1 : p->count - 1];
    if (compare_vertices(&p->vertex[k], last) == 0 && p->count > 1) continue;
    dyd_dyadic_swap(&p->vertex[kept].x, &p->vertex[k].x);
    dyd_dyadic_swap(&p->vertex[kept].y, &p->vertex[k].y);
    kept++;
  }
  for (size_t k = kept; k < p->count; k++) dyd_point_clear(&p->vertex[k]);
  p->count = kept;
}

/* Outward boxes of the edges: x lower, x upper, y lower, y upper. */
static void edge_box(double out[4], const dyd_point *a, const dyd_point *b) {
  for (int axis = 0; axis < 2; axis++) {
    const dyd_dyadic *s = axis ? &a->y : &a->x, *t = axis ? &b->y : &b->x;
    bool less = dyd_dyadic_cmp(s, t) < 0;
    out[2 * axis] = dyd_dyadic_get_d(less ? s : t, DYD_DOWN);
    out[2 * axis + 1] = dyd_dyadic_get_d(less ? t : s, DYD_UP);
  }
}

static bool boxes_meet(const double a[4], const double b[4]) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3];
}

/* Edge j against the edges before it; box holds those of edges 0 .. j. */
static bool edge_is_free(const dyd_polygon *p, double (*box)[4], size_t j) {
  size_t n = p->count;
  const dyd_point *z = p->vertex, *c = &z[j], *d = &z[(j + 1) % n];
  for (size_t i = 0; i < j; i++) {
    if (!boxes_meet(box[i], box[j])) continue;
    const dyd_point *a = &z[i], *b = &z[i + 1];
    bool after = i + 1 == j, before = j + 1 == n && i == 0;
    if (after && folds_back(a, b, d)) return false;
    if (before && folds_back(c, d, b)) return false;
    if (!after && !before && segments_meet(a, b, c, d)) return false;
  }
  return true;
}

dyd_status dyd_polygon_is_simple(bool *out, dyd_polygon *p, const volatile int *cancel) {
  drop_repeats(p);
  double(*box)[4] = dyd_alloc(p->count, sizeof *box);
  if (!box) return DYD_E_NOMEM;
  *out = p->count >= 3;
  dyd_status st = DYD_OK;
  for (size_t j = 0; *out && j < p->count && st == DYD_OK; j++) {
    edge_box(box[j], &p->vertex[j], &p->vertex[(j + 1) % p->count]);
    *out = edge_is_free(p, box, j);
    if (dyd_flag_is_set(cancel)) st = DYD_CANCELLED;
  }
  free(box);
  return st;
}

/* ---- copies ---- */

dyd_status dyd_polygon_copy(dyd_polygon *out, const dyd_polygon *p) {
  dyd_polygon copy = {0};
  copy.vertex = dyd_alloc(p->count, sizeof *copy.vertex);
  if (!copy.vertex) return DYD_E_NOMEM;
  for (; copy.count < p->count; copy.count++) {
    dyd_point_init(&copy.vertex[copy.count]);
    dyd_point_set(&copy.vertex[copy.count], &p->vertex[copy.count]);
  }
  *out = copy;
  return DYD_OK;
}
