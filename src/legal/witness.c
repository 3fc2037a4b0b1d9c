/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The search for a witness by cutting planes.
 *
 * c is a witness of ij iff ds_k(c)^2 - dl_s(c)^2 > 0 for s = i, j and all other k. This is the least, over q in R_k and
 * corners p of R_s, of |c-q|^2 - |c-p|^2, linear in c: a concave function, so at any c its active pair (q,p) gives a
 * half-plane that holds all witnesses: the points nearer to p than to q [WIT-1]. The search keeps such half-planes,
 * moves c to the centre of the largest disc inside them, and asks again who violates. An empty intersection ends it: no
 * witness.
 *
 * First in doubles (witness_filter.c), which is enough for nearly all; else with exact half-planes. */
#include "legal/witness.h"

#include "base/flag.h"
#include "base/invariant.h"
#include "base/local.h"
#include "legal/witness_filter.h"
#include "predicate/circle.h"
#include "rect/irect.h"
#include "rect/rect.h"
#include "skeleton/hull.h"
#include "skeleton/rects_filter.h"

#include <dyadel/predicate.h>
#include <math.h>
#include <stdlib.h>

/* ---- centres of circles: rounded to a step below the widths of the rectangles they were made from, or below their
 * last bits if they are points ---- */

enum { FINER = 8 };

/* Exponent of a step well below the width of a, or below the last bit of a point. */
static int64_t centre_step(const dyd_interval *a) {
  if (!dyd_interval_is_point(a)) return -dyd_interval_bits(a) - FINER;
  return mpz_sgn(a->lo.man) ? a->lo.exp - (int64_t)mpz_sizeinbase(a->den, 2) - FINER : 0;
}

static int64_t centre_least(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* floor((a / d) / 2^e) 2^e, d > 0 */
static dyd_status centre_floor(dyd_dyadic *out, const mpz_t a, const mpz_t d, int64_t e) {
  DYD_LOCAL_NUMBERS(mpz, t, u);
  mpz_mul_2exp(t, a, (mp_bitcnt_t)(e < 0 ? -e : 0));
  mpz_mul_2exp(u, d, (mp_bitcnt_t)(e > 0 ? e : 0));
  mpz_fdiv_q(t, t, u);
  return dyd_dyadic_set_z_2exp(out, t, e);
}

/* c = (x, y) / d, d > 0, each rounded down to a multiple of 2^e. */
static dyd_status centre_round(dyd_point *c, const mpz_t x, const mpz_t y, const mpz_t d, int64_t e) {
  dyd_status st = centre_floor(&c->x, x, d, e);
  if (st == DYD_OK) st = centre_floor(&c->y, y, d, e);
  return st;
}

bool dyd_circumcentre_round(dyd_point *c, const dyd_skeleton *sk, const uint32_t v[3]) {
  static const dyd_touch touch[3] = {DYD_FARTHEST, DYD_CLOSEST, DYD_CLOSEST};
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_ARRAY(dyd_rect, point, [3]);
  const dyd_rect *const at[3] = {&point[0], &point[1], &point[2]};
  DYD_LOCAL(dyd_circle, circle);
  int64_t e = INT64_MAX;
  for (int k = 0; k < 3; k++) {
    if (dyd_reps_get(&point[k], &sk->reps, v[k]) != DYD_OK) return false;
    dyd_rects_get(&r, &sk->rects, v[k]);
    e = centre_least(e, centre_least(centre_step(&r.x), centre_step(&r.y)));
  }
  return dyd_critical_circle(&circle, at, touch) == DYD_OK && mpz_sgn(circle.c) == 0 &&
         centre_round(c, circle.ax, circle.ay, circle.d, e) == DYD_OK;
}

/* c: a dyadic point next to the middle of the centres of the circles through the representatives of i, j and each of
 * the two across: where a witness of ij is likely. false: one of the triples is collinear, or it is beyond numbers. */
static bool circumcentre_between(dyd_point *c, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                                 const uint32_t across[2]) {
  DYD_LOCAL(dyd_point, other);
  const uint32_t v[2][3] = {{i, j, across[0]}, {i, j, across[1]}};
  return dyd_circumcentre_round(c, sk, v[0]) && dyd_circumcentre_round(&other, sk, v[1]) &&
         dyd_dyadic_add(&c->x, &c->x, &other.x) == DYD_OK && dyd_dyadic_add(&c->y, &c->y, &other.y) == DYD_OK &&
         dyd_dyadic_mul_2exp(&c->x, &c->x, -1) == DYD_OK && dyd_dyadic_mul_2exp(&c->y, &c->y, -1) == DYD_OK;
}

/* c = p, which is finite. */
static void point_set_xy(dyd_point *c, dyd_xy p) {
  dyd_status x = dyd_dyadic_set_d(&c->x, p.x), y = dyd_dyadic_set_d(&c->y, p.y);
  DYD_INVARIANT(x == DYD_OK && y == DYD_OK);
  (void)x;
  (void)y;
}

/* ---- half-planes from a centre and two rectangles, and the next centre ----
 *
 * Dual simplex in three unknowns x, y, z with integers.
 * Three half-planes whose normals hold 0 in their convex hull, 0 = sum of l_k n_k, l_k >= 0, give for every point
 * sum l_k (n_k.p + c_k) = sum l_k c_k, hence min (n_k.p + c_k)/w_k <= Z/D := sum l_k c_k / sum l_k w_k: an upper bound
 * of the optimum, attained at the point where all three are equal. Exchanging a violated half-plane for one of the
 * three, the least bound first, ends at the optimum of all [LP-1]. The l_k are the 2x2 minors of the normals, and the
 * point comes by Cramer's rule. */

enum { PIVOTS = 400 };

void dyd_half_plane_init(dyd_half_plane *h) {
  mpz_inits(h->a, h->b, h->c, h->w, NULL);
}

void dyd_half_plane_clear(dyd_half_plane *h) {
  mpz_clears(h->a, h->b, h->c, h->w, NULL);
}

void dyd_exact_centre_init(dyd_exact_centre *p) {
  mpz_inits(p->x, p->y, p->z, p->d, NULL);
}

void dyd_exact_centre_clear(dyd_exact_centre *p) {
  mpz_clears(p->x, p->y, p->z, p->d, NULL);
}

static void swap_centres(dyd_exact_centre *p, dyd_exact_centre *q) {
  mpz_swap(p->x, q->x);
  mpz_swap(p->y, q->y);
  mpz_swap(p->z, q->z);
  mpz_swap(p->d, q->d);
}

/* out = p s - q r */
static void minor2(mpz_t out, const mpz_t p, const mpz_t q, const mpz_t r, const mpz_t s) {
  mpz_mul(out, p, s);
  mpz_submul(out, q, r);
}

/* out += or -= f * minor */
static void add_product(mpz_t out, const mpz_t f, const mpz_t g, int sign) {
  if (sign > 0)
    mpz_addmul(out, f, g);
  else
    mpz_submul(out, f, g);
}

/* The common value of three half-planes; false unless their normals hold 0 in their convex hull. l: scratch. */
static bool common_value(dyd_exact_centre *p, mpz_t l[3], mpz_t t, const dyd_half_plane *const h[3]) {
  int plus = 0, minus = 0;
  for (int k = 0; k < 3; k++) {
    const dyd_half_plane *u = h[(k + 1) % 3], *v = h[(k + 2) % 3];
    minor2(l[k], u->a, u->b, v->a, v->b);
    plus += mpz_sgn(l[k]) > 0;
    minus += mpz_sgn(l[k]) < 0;
  }
  if ((plus && minus) || (!plus && !minus)) return false;
  mpz_set_ui(p->x, 0);
  mpz_set_ui(p->y, 0);
  mpz_set_ui(p->z, 0);
  mpz_set_ui(p->d, 0);
  int sign = plus ? 1 : -1;
  for (int k = 0; k < 3; k++) {
    const dyd_half_plane *u = h[(k + 1) % 3], *v = h[(k + 2) % 3];
    add_product(p->d, h[k]->w, l[k], sign);
    add_product(p->z, h[k]->c, l[k], sign);
    minor2(t, u->b, u->w, v->b, v->w); /* x = -det[c b w] / D */
    add_product(p->x, h[k]->c, t, -sign);
    minor2(t, u->a, u->w, v->a, v->w); /* y = -det[a c w] / D = det[c a w] / D */
    add_product(p->y, h[k]->c, t, sign);
  }
  return true;
}

/* a x + b y + c d - w z, negative when the half-plane is violated. */
static int slack_sign(mpz_t t, const dyd_half_plane *h, const dyd_exact_centre *p) {
  mpz_mul(t, h->a, p->x);
  mpz_addmul(t, h->b, p->y);
  mpz_addmul(t, h->c, p->d);
  mpz_submul(t, h->w, p->z);
  return mpz_sgn(t);
}

/* Newest first: they were added since they are violated. Where numbers have a million bits each takes its time: any
 * one will do when work is stopped. */
static size_t violated(mpz_t t, const dyd_half_plane *h, size_t count, const dyd_exact_centre *p,
                       const volatile int *cancel) {
  for (size_t k = count; k-- > 0;)
    if (dyd_flag_is_set(cancel) || slack_sign(t, &h[k], p) < 0) return k;
  return count;
}

static bool is_less(mpz_t s, mpz_t t, const dyd_exact_centre *p, const dyd_exact_centre *q) {
  mpz_mul(s, p->z, q->d);
  mpz_mul(t, q->z, p->d);
  return mpz_cmp(s, t) < 0;
}

/* The best exchange for half-plane k; *best is its centre, basis is updated. There always is one: 0 stays in the convex
 * hull of any normal and two of the three, the one opposite to it being between these [LP-1]. */
static void exact_lp_exchange(const dyd_half_plane *basis[3], dyd_exact_centre *best, dyd_exact_centre *trial,
                              mpz_t scratch[5], const dyd_half_plane *k) {
  int leaves = -1;
  for (int out = 0; out < 3; out++) {
    const dyd_half_plane *const h[3] = {k, basis[(out + 1) % 3], basis[(out + 2) % 3]};
    if (!common_value(trial, scratch, scratch[3], h)) continue;
    if (leaves >= 0 && !is_less(scratch[3], scratch[4], trial, best)) continue;
    swap_centres(trial, best);
    leaves = out;
  }
  DYD_INVARIANT(leaves >= 0);
  basis[leaves] = k;
}

bool dyd_exact_lp(dyd_exact_centre *out, const dyd_half_plane *h, size_t count, const volatile int *cancel) {
  const dyd_half_plane *basis[3] = {&h[0], &h[1], &h[2]};
  DYD_LOCAL(dyd_exact_centre, trial, next);
  DYD_LOCAL_ARRAY(mpz_t, scratch, [5]);
  bool bounded = common_value(out, scratch, scratch[3], basis), done = false;
  DYD_INVARIANT(bounded);
  (void)bounded;
  for (int step = 0; step < PIVOTS; step++) {
    size_t k = violated(scratch[3], h, count, out, cancel);
    done = k == count;
    if (done || dyd_flag_is_set(cancel)) break;
    exact_lp_exchange(basis, &next, &trial, scratch, &h[k]);
    swap_centres(out, &next);
  }
  return done;
}

/* How far out centres are looked for, in bits above the sites: each when there is no room nearer. Far out, doubles no
 * longer distinguish the distances of sites, and all sites are tested exactly. */
static const int64_t how_far[] = {3, 24, 64, 4160};

enum { REACHES = sizeof how_far / sizeof *how_far };

enum { PLANES = 1024 };

/* Invariant: h[0..3] are a square's sides, h[4..count-1] hold all witnesses [WIT-1]; h[0..made-1] are initialised. All
 * ends of the rectangles seen are multiples of 2^low (times 1 / denominator), and less than 2^top. */
typedef struct plane_list {
  dyd_half_plane h[PLANES];
  size_t count, made;
  int64_t low, top;
  const volatile int *cancel; /* may be NULL */
} plane_list;

static void planes_init(plane_list *l, const volatile int *cancel) {
  l->cancel = cancel;
  for (l->count = 0; l->count < 4; l->count++) dyd_half_plane_init(&l->h[l->count]);
  l->made = l->count;
  l->low = DYD_EXP_LIMIT;
  l->top = -DYD_EXP_LIMIT;
}

static void planes_clear(plane_list *l) {
  for (size_t k = 0; k < l->made; k++) dyd_half_plane_clear(&l->h[k]);
}

static void planes_measure(plane_list *l, const dyd_rect *r) {
  const dyd_interval *side[2] = {&r->x, &r->y};
  for (int k = 0; k < 4; k++) {
    const dyd_interval *a = side[k / 2];
    const dyd_dyadic *end = k % 2 ? &a->hi : &a->lo;
    if (!mpz_sgn(end->man)) continue;
    int64_t low = end->exp + 1 - (int64_t)mpz_sizeinbase(a->den, 2);
    int64_t top = end->exp + (int64_t)mpz_sizeinbase(end->man, 2);
    if (low < l->low) l->low = low;
    if (top > l->top) l->top = top;
  }
}

/* On one axis: a = s - q, and q^2 - s^2 is added to sum; s the end of own farther from c, q the point of other nearest
 * to c. */
static void plane_axis(mpz_t a, mpz_t sum, mpz_t t, mpz_srcptr c, mpz_srcptr own0, mpz_srcptr own1, mpz_srcptr other0,
                       mpz_srcptr other1) {
  mpz_add(t, own0, own1);
  mpz_submul_ui(t, c, 2);
  mpz_srcptr s = mpz_sgn(t) > 0 ? own1 : own0;
  mpz_srcptr q = mpz_cmp(c, other0) < 0 ? other0 : mpz_cmp(c, other1) > 0 ? other1 : c;
  mpz_sub(a, s, q);
  mpz_add(t, s, q);
  mpz_submul(sum, a, t);
}

/* From a.x + c > 0 for x in units of 1 / (factor 2^exp) to user units, without common powers of two; w = |a| + |b|. */
static void plane_to_user(dyd_half_plane *h, const mpz_t factor, int64_t exp) {
  mpz_ptr part[3] = {h->a, h->b, h->c};
  mp_bitcnt_t zeros = ~(mp_bitcnt_t)0;
  for (int k = 0; k < 3; k++) {
    if (k < 2) mpz_mul(part[k], part[k], factor);
    int64_t up = k < 2 ? exp : -exp;
    if (up > 0) mpz_mul_2exp(part[k], part[k], (mp_bitcnt_t)up);
    mp_bitcnt_t z = mpz_scan1(part[k], 0); /* of 0: the largest number */
    if (z < zeros) zeros = z;
  }
  for (int k = 0; k < 3; k++) mpz_tdiv_q_2exp(part[k], part[k], zeros);
  mpz_abs(h->w, h->a);
  if (mpz_sgn(h->b) > 0)
    mpz_add(h->w, h->w, h->b);
  else
    mpz_sub(h->w, h->w, h->b);
}

/* The half-plane |q|^2 - |s|^2 + 2 (s - q).x > 0. Returns the sign of that at c; *differ: s != q. */
static int plane_set(bool *differ, dyd_half_plane *h, const dyd_point *c, const dyd_rect *own, const dyd_rect *other) {
  const dyd_rect *in[2] = {own, other};
  int64_t exp;
  DYD_LOCAL_NUMBERS(mpz, cx, cy, factor, t);
  DYD_LOCAL_ARRAY(dyd_irect, r, [2]);
  dyd_irects_scale_with(cx, cy, r, c, in, 2, factor, &exp);
  mpz_set_ui(h->c, 0);
  plane_axis(h->a, h->c, t, cx, r[0].x0, r[0].x1, r[1].x0, r[1].x1);
  plane_axis(h->b, h->c, t, cy, r[0].y0, r[0].y1, r[1].y0, r[1].y1);
  *differ = mpz_sgn(h->a) || mpz_sgn(h->b);
  mpz_mul(t, h->a, cx);
  mpz_addmul(t, h->b, cy);
  mpz_mul_2exp(t, t, 1);
  mpz_add(t, t, h->c);
  int sign = mpz_sgn(t);
  if (*differ) plane_to_user(h, factor, exp + 1);
  return sign;
}

/* Adds the points nearer to the corner of `own` that is farthest from c than to the point of `other` nearest to c,
 * unless c is among them. false: the list is full, or the two points are one: no half-plane. */
static bool planes_add(plane_list *l, const dyd_point *c, const dyd_rect *own, const dyd_rect *other) {
  bool differ;
  if (l->count == PLANES) return false;
  dyd_half_plane *h = &l->h[l->count];
  if (l->made == l->count) dyd_half_plane_init(&l->h[l->made++]);
  planes_measure(l, own);
  planes_measure(l, other);
  l->count += plane_set(&differ, h, c, own, other) <= 0 && differ;
  return differ;
}

/* The first four: the square |x|, |y| < 2^top. */
static void planes_square(plane_list *l, int64_t top) {
  for (int k = 0; k < 4; k++) {
    dyd_half_plane *h = &l->h[k];
    mpz_ptr n = k < 2 ? h->a : h->b, zero = k < 2 ? h->b : h->a;
    mpz_set_ui(zero, 0);
    mpz_set_ui(h->w, 1);
    mpz_set_ui(h->c, 1);
    mpz_mul_2exp(h->w, h->w, (mp_bitcnt_t)(top < 0 ? -top : 0));
    mpz_mul_2exp(h->c, h->c, (mp_bitcnt_t)(top > 0 ? top : 0));
    mpz_set(n, h->w);
    if (k & 1) mpz_neg(n, n);
  }
}

/* 2^e is less than a quarter of the radius z / d, and more than a 64th. */
static int64_t step_within(const dyd_exact_centre *p) {
  return (int64_t)mpz_sizeinbase(p->z, 2) - (int64_t)mpz_sizeinbase(p->d, 2) - 4;
}

/* The floor: exponent of a radius far below unit^2 / size, for ends that are multiples of unit = 2^low up to size =
 * 2^top. A disc of witnesses that small is not looked for; where there is none, but three rectangles touch one circle,
 * the discs of the half-planes would shrink for ever. */
static int64_t floor_exponent(const plane_list *l) {
  return 2 * l->low - l->top - 128;
}

/* *room: TRUE: c is the centre of the largest disc (in the sum norm) inside all half-planes, rounded so that it stays
 * inside; else c is unchanged or beyond use: FALSE: there is none, or none larger than the floor of witness.h; UNKNOWN:
 * no end. DYD_CANCELLED, DYD_E_NOMEM. */
static dyd_status planes_centre(dyd_truth *room, dyd_point *c, plane_list *l) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_exact_centre, p);
  *room = DYD_FALSE;
  for (int k = 0; k < REACHES && *room == DYD_FALSE; k++) {
    planes_square(l, l->top + how_far[k]);
    if (!dyd_exact_lp(&p, l->h, l->count, l->cancel))
      *room = DYD_UNKNOWN;
    else if (mpz_sgn(p.z) > 0 && step_within(&p) >= floor_exponent(l))
      *room = DYD_TRUE;
  }
  if (dyd_flag_is_set(l->cancel)) st = DYD_CANCELLED;
  if (*room == DYD_TRUE && st == DYD_OK) st = centre_round(c, p.x, p.y, p.d, step_within(&p));
  if (st != DYD_E_RANGE) return st;
  *room = DYD_UNKNOWN; /* beyond the numbers there are */
  return DYD_OK;
}

enum { MAX_RIVALS = 12, LEAST_STEPS = 48, MAX_STEPS = 400, STEP_BITS = 1 << 17, SNAP_STEPS = 8 };

/* Invariant: `rivals` counts those seen so far who violate the present c; ended: no witness exists, or no space for
 * more half-planes, or c is only asked about and violated; none: certainly none exists, or only below the floor. */
typedef struct witness_search {
  const dyd_rects *rects;
  bool no_filter;
  uint32_t i, j;
  dyd_rect own[2], rival; /* rival: the latest */
  plane_list *planes;     /* NULL: c is only asked about */
  dyd_point c;
  dyd_bbox at; /* where c is */
  size_t rivals;
  bool ended, none;
  const volatile int *cancel;
  dyd_status status;
} witness_search;

static void witness_search_init(witness_search *s, const dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  *s = (witness_search){.rects = w->rects, .no_filter = sk->mesh.no_filter, .i = i, .j = j, .cancel = w->run->cancel};
  dyd_rect_init(&s->own[0]);
  dyd_rect_init(&s->own[1]);
  dyd_rect_init(&s->rival);
  dyd_point_init(&s->c);
  dyd_rects_get(&s->own[0], s->rects, i);
  dyd_rects_get(&s->own[1], s->rects, j);
}

static void witness_search_clear(witness_search *s) {
  dyd_point_clear(&s->c);
  dyd_rect_clear(&s->rival);
  dyd_rect_clear(&s->own[1]);
  dyd_rect_clear(&s->own[0]);
}

static bool witness_search_found(const witness_search *s) {
  return s->status == DYD_OK && s->rivals == 0;
}

/* Returns true if the rectangle is certainly farther from c than all of R_i and R_j. Exact. */
static bool witness_is_outside(const witness_search *s, const dyd_rect *r) {
  for (int q = 0; q < 2; q++)
    if (dyd_compare_distance(&s->c, &s->own[q], DYD_FARTHEST, r, DYD_CLOSEST) >= 0) return false;
  return true;
}

/* The same in doubles, for nearly all where c is far away [FLT-FAR]. */
static bool witness_is_surely_outside(const witness_search *s, uint32_t k) {
  const dyd_bbox *box = s->rects->box;
  if (s->no_filter) return false;
  return dyd_filter_is_farther(&s->at, &box[s->i], &box[k]) && dyd_filter_is_farther(&s->at, &box[s->j], &box[k]);
}

/* r violates c: new half-planes. */
static void witness_add_rival(witness_search *s, const dyd_rect *r) {
  s->ended = !s->planes;
  for (int q = 0; q < 2 && !s->ended; q++) s->ended = !planes_add(s->planes, &s->c, &s->own[q], r);
  s->rivals++;
  dyd_rect_set(&s->rival, r);
}

/* A few violators are enough for one step. */
static bool witness_examine(void *context, uint32_t k) {
  witness_search *s = context;
  if (k == s->i || k == s->j || witness_is_surely_outside(s, k)) return true;
  if (dyd_flag_is_set(s->cancel)) s->status = DYD_CANCELLED; /* each that follows may take long */
  if (s->status != DYD_OK) return false;
  DYD_LOCAL(dyd_rect, r);
  dyd_rects_get(&r, s->rects, k);
  if (!witness_is_outside(s, &r)) witness_add_rival(s, &r);
  return !s->ended && s->rivals < MAX_RIVALS;
}

static bool witness_meets(void *context, uint32_t k) {
  witness_search *s = context;
  if (k == s->i || k == s->j) return true;
  DYD_LOCAL(dyd_rect, r);
  dyd_rects_get(&r, s->rects, k);
  s->ended = dyd_rect_meets(&r, &s->own[0]) || dyd_rect_meets(&r, &s->own[1]);
  return !s->ended;
}

/* A rectangle that meets R_i or R_j is never outside of a disc that holds both: then no witness exists. */
static void witness_look_at_ends(witness_search *s) {
  const double zero = 0;
  const uint32_t own[2] = {s->i, s->j};
  for (int q = 0; q < 2 && !s->ended; q++)
    dyd_tree_near(&s->rects->tree, &s->rects->box[own[q]], &zero, witness_meets, s);
  s->none = s->ended;
  if (s->ended) s->rivals = 1;
}

/* Finds the sites that violate c. All sites are tested through the tree; the result is exact. */
static void witness_evaluate(witness_search *s) {
  s->rivals = 0;
  s->at = dyd_point_box(&s->c);
  double bound = s->no_filter ? INFINITY : dyd_pair_dl2_upper(s->rects, &s->at, s->i, s->j);
  dyd_tree_near(&s->rects->tree, &s->at, &bound, witness_examine, s);
}

/* Representatives are finite doubles. */
static void witness_set_start(dyd_point *c, const dyd_skeleton *sk, uint32_t i, dyd_xy guess) {
  if (!isfinite(guess.x) || !isfinite(guess.y)) guess = sk->reps.xy[i];
  point_set_xy(c, guess);
}

/* How many steps are made: fewer where the ends of rectangles span many bits, since each then takes longer. */
static int64_t witness_steps(const plane_list *l) {
  int64_t span = l->top - l->low;
  return span > STEP_BITS / (MAX_STEPS - LEAST_STEPS) ? LEAST_STEPS + STEP_BITS / span : MAX_STEPS;
}

/* end: the end of the three sides that is nearest to x; gap: how near. */
static void witness_nearest_end(const dyd_dyadic **end, dyd_dyadic *gap, const dyd_dyadic *x,
                                const dyd_interval *const side[3]) {
  DYD_LOCAL(dyd_dyadic, d);
  *end = NULL;
  for (int k = 0; k < 6; k++) {
    const dyd_dyadic *e = k % 2 ? &side[k / 2]->hi : &side[k / 2]->lo;
    if (dyd_dyadic_sub(&d, x, e) != DYD_OK) continue;
    if (dyd_dyadic_sgn(&d) < 0) dyd_dyadic_neg(&d, &d);
    if (*end && dyd_dyadic_cmp(&d, gap) >= 0) continue;
    *end = e;
    dyd_dyadic_swap(&d, gap);
  }
}

/* Where witnesses have next to no room, the centres come nearer to it by a fixed part in each step: as many steps as
 * numbers have bits. It often lies beside ends of rectangles: there half-planes are of the right scale at once. In
 * turns the nearer coordinate moves (the other may be on its way to infinity) and both. */
static void witness_snap(witness_search *s, bool both) {
  const dyd_interval *const x[3] = {&s->own[0].x, &s->own[1].x, &s->rival.x};
  const dyd_interval *const y[3] = {&s->own[0].y, &s->own[1].y, &s->rival.y};
  const dyd_dyadic *end[2];
  DYD_LOCAL_ARRAY(dyd_dyadic, gap, [2]);
  witness_nearest_end(&end[0], &gap[0], &s->c.x, x);
  witness_nearest_end(&end[1], &gap[1], &s->c.y, y);
  if (end[0] && end[1]) {
    int order = dyd_dyadic_cmp(&gap[0], &gap[1]);
    if (both || order <= 0) dyd_dyadic_set(&s->c.x, end[0]);
    if (both || order > 0) dyd_dyadic_set(&s->c.y, end[1]);
    witness_evaluate(s);
  }
}

/* Ends with no rivals (a witness), or with some (none, the floor, or too many steps). */
static void witness_search_run(witness_search *s) {
  dyd_truth room = DYD_TRUE;
  witness_look_at_ends(s);
  if (!s->ended) witness_evaluate(s);
  for (int step = 0; s->status == DYD_OK && s->rivals && !s->ended && room == DYD_TRUE; step++) {
    if (step >= witness_steps(s->planes)) break;
    s->status = planes_centre(&room, &s->c, s->planes);
    s->none = room == DYD_FALSE;
    if (s->status == DYD_OK && room == DYD_TRUE) witness_evaluate(s);
    if (s->status == DYD_OK && room == DYD_TRUE && s->rivals && !s->ended && step % SNAP_STEPS == SNAP_STEPS - 1)
      witness_snap(s, step / SNAP_STEPS % 2);
  }
}

static dyd_status witness_search_exactly(dyd_truth *exists, dyd_point *c, dyd_work *w, const dyd_skeleton *sk,
                                         uint32_t i, uint32_t j, dyd_xy guess) {
  plane_list *planes = malloc(sizeof *planes);
  DYD_SCOPED(witness_search) s;
  witness_search_init(&s, w, sk, i, j);
  if (!planes) return DYD_E_NOMEM;
  planes_init(planes, w->run->cancel);
  s.planes = planes;
  witness_set_start(&s.c, sk, i, guess);
  witness_search_run(&s);
  *exists = witness_search_found(&s) ? DYD_TRUE : s.none ? DYD_FALSE : DYD_UNKNOWN;
  if (*exists == DYD_TRUE && c) dyd_point_set(c, &s.c);
  planes_clear(planes);
  free(planes);
  return s.status;
}

/* Returns true if some circle meets the rectangles of i, j and of both vertices across, these certainly on opposite
 * sides of ij. Then there is no witness [WIT-QUAD]. */
static bool witness_is_excluded(const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t across[2]) {
  const uint32_t v[4] = {i, j, across[0], across[1]};
  DYD_LOCAL_ARRAY(dyd_rect, r, [4]);
  for (int k = 0; k < 4; k++) dyd_rects_get(&r[k], &sk->rects, v[k]);
  dyd_sure a = dyd_orientation(&r[0], &r[1], &r[2]), b = dyd_orientation(&r[0], &r[1], &r[3]);
  bool opposite = a != DYD_UNSURE && (int)a == -(int)b;
  return opposite && dyd_con(&r[3], &r[0], &r[1], &r[2]) == DYD_UNSURE;
}

/* Before a search with big numbers: returns true if certainly none exists, or one lies between the centres of the
 * edge's two triangles. */
static bool witness_look_between(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                                 const uint32_t across[2]) {
  if (witness_is_excluded(sk, i, j, across)) return true;
  DYD_LOCAL(dyd_point, middle);
  *found = circumcentre_between(&middle, sk, i, j, across) && dyd_witness_check(w, sk, i, j, &middle);
  if (*found && c) dyd_point_set(c, &middle);
  return *found;
}

/* One search for a pair in either order. */
static void witness_order(uint32_t *i, uint32_t *j) {
  uint32_t t = *i;
  if (t <= *j) return;
  *i = *j;
  *j = t;
}

dyd_status dyd_witness_search(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                              dyd_xy guess, const uint32_t across[2]) {
  *found = false;
  witness_order(&i, &j);
  dyd_truth quick = dyd_filter_witness(&guess, w->rects, sk, i, j);
  if (quick == DYD_UNKNOWN || (quick == DYD_TRUE && sk->mesh.no_filter)) {
    dyd_truth exists = DYD_UNKNOWN;
    if (across && !sk->mesh.no_filter && witness_look_between(found, c, w, sk, i, j, across)) return DYD_OK;
    dyd_status st = witness_search_exactly(&exists, c, w, sk, i, j, guess);
    *found = exists == DYD_TRUE;
    return st;
  }
  *found = quick == DYD_TRUE;
  if (*found && c) witness_set_start(c, sk, i, guess);
  return DYD_OK;
}

dyd_status dyd_witness_decide(dyd_truth *exists, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i,
                              uint32_t j, dyd_xy guess, const uint32_t across[2]) {
  witness_order(&i, &j);
  *exists = sk->mesh.no_filter ? DYD_UNKNOWN : dyd_filter_witness(&guess, w->rects, sk, i, j);
  if (*exists == DYD_TRUE) {
    witness_set_start(c, sk, i, guess);
    return DYD_OK;
  }
  *exists = DYD_FALSE;
  if (across && witness_is_excluded(sk, i, j, across)) return DYD_OK;
  return witness_search_exactly(exists, c, w, sk, i, j, guess);
}

bool dyd_witness_check(dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j, const dyd_point *c) {
  DYD_SCOPED(witness_search) s;
  witness_search_init(&s, w, sk, i, j);
  dyd_point_set(&s.c, c);
  witness_evaluate(&s);
  return witness_search_found(&s);
}

bool dyd_witness_at(dyd_work *w, const dyd_skeleton *sk, dyd_half_edge h, dyd_xy at) {
  DYD_LOCAL(dyd_point, c);
  point_set_xy(&c, at);
  return dyd_witness_check(w, sk, dyd_edge_origin(&sk->mesh, h), dyd_edge_target(&sk->mesh, h), &c);
}

/* c = p + 2^m u for a vertex's double p. */
static dyd_status witness_far_centre(dyd_point *c, const dyd_skeleton *sk, uint32_t i, const mpz_t ux, const mpz_t uy,
                                     int64_t m) {
  DYD_LOCAL(dyd_dyadic, d);
  witness_set_start(c, sk, i, (dyd_xy){NAN, NAN});
  dyd_status st = dyd_dyadic_set_z_2exp(&d, ux, m);
  if (st == DYD_OK) st = dyd_dyadic_add(&c->x, &c->x, &d);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&d, uy, m);
  return st == DYD_OK ? dyd_dyadic_add(&c->y, &c->y, &d) : st;
}

dyd_status dyd_witness_far(bool *found, dyd_point *c, dyd_work *w, const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  DYD_LOCAL_NUMBERS(mpz, ux, uy);
  DYD_LOCAL(dyd_point, far);
  dyd_status st = dyd_hull_direction(found, ux, uy, w, sk, i, j);
  bool direction = *found;
  *found = false;
  for (int64_t step = 16, m = -64; direction && st == DYD_OK && !*found; m += step, step += step / 4) {
    st = witness_far_centre(&far, sk, i, ux, uy, m);
    *found = st == DYD_OK && dyd_witness_check(w, sk, i, j, &far);
  }
  if (st == DYD_E_RANGE) st = DYD_OK; /* farther than numbers go: the floor */
  if (*found && c) dyd_point_set(c, &far);
  return st;
}
