/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* legal(i,j), exactly (mathematics: section 3) [LEG-1]: is there c with max(dl_i,dl_j)(c) < ds_k(c) for all k?
 *
 * Let c be such a centre with dl_i > dl_j and only one farthest corner s of R_i. Walking straight towards s, dl_i
 * falls at rate 1 and no ds_k falls faster, so c stays good until dl_i = dl_j or the farthest corner changes, that
 * is until c is on a mid-line of R_i. (If s stays farthest all the way then R_i is a point and dl_j <= dl_i came
 * first.) Where both have the same farthest corner s, walking on keeps both. So if there is a good centre there
 * is one on a straight piece:
 *   D: where |c-s| = |c-t|, s the farthest corner of R_i, t /= s that of R_j (the bisector of s and t, cut to the
 *      cell where they are the farthest);
 *   A: on a mid-line of R_i, where dl_i >= dl_j (or with i and j exchanged).
 * On a line c = P + t V each h_k(t) = ds_k^2 - |c-s|^2 is concave (a minimum over q in R_k of functions linear in
 * c), with rational breakpoints and at most quadratic pieces, so {h_k > 0} is an open interval whose ends are
 * a + b sqrt(c). The pair is legal iff on some piece all these intervals have a common point. */
#include "oracle/oracle.h"
#include <stdlib.h>

/* The open interval (lo,hi); the flags say whether an end is finite. */
typedef struct interval {
  bool empty, has_lo, has_hi;
  orc_alg lo, hi;
} interval;

/* The points P + t V with from <= t <= to (NULL: unbounded), on which the radius is |c - s|. */
typedef struct piece {
  mpq_srcptr at[2], v[2], from, to, s[2];
} piece;

static mpq_srcptr along(orc_pool *p, const piece *l, size_t axis, mpq_srcptr t) {
  return orc_add(p, l->at[axis], orc_mul(p, l->v[axis], t));
}

/* Adds (coordinate - a)^2 * sign to the quadratic q[0] + q[1] t + q[2] t^2. */
static void add_square(mpq_srcptr q[3], orc_pool *p, const piece *l, size_t axis, mpq_srcptr a, int sign) {
  mpq_srcptr d = orc_sub(p, l->at[axis], a), v = l->v[axis];
  mpq_srcptr term[3] = {orc_sqr(p, d), orc_twice(p, orc_mul(p, d, v)), orc_sqr(p, v)};
  for (size_t k = 0; k < 3; k++) q[k] = sign > 0 ? orc_add(p, q[k], term[k]) : orc_sub(p, q[k], term[k]);
}

/* h_k as a quadratic, with the features of R_k that hold at the parameter t. */
static void quadratic_at(mpq_srcptr q[3], orc_pool *p, const piece *l, const orc_rect *r, mpq_srcptr t) {
  for (size_t k = 0; k < 3; k++) q[k] = orc_si(p, 0, 1);
  for (size_t axis = 0; axis < 2; axis++) {
    mpq_srcptr c = along(p, l, axis, t);
    add_square(q, p, l, axis, l->s[axis], -1);
    if (mpq_cmp(c, r->e[2 * axis]) <= 0)
      add_square(q, p, l, axis, r->e[2 * axis], 1);
    else if (mpq_cmp(c, r->e[2 * axis + 1]) >= 0)
      add_square(q, p, l, axis, r->e[2 * axis + 1], 1);
  }
}

static void cut_lo(interval *x, orc_pool *p, orc_alg lo) {
  if (!x->has_lo || orc_alg_cmp(p, lo, x->lo) > 0) x->lo = lo;
  x->has_lo = true;
}

static void cut_hi(interval *x, orc_pool *p, orc_alg hi) {
  if (!x->has_hi || orc_alg_cmp(p, hi, x->hi) < 0) x->hi = hi;
  x->has_hi = true;
}

static void settle(interval *x, orc_pool *p) {
  if (x->has_lo && x->has_hi && orc_alg_cmp(p, x->lo, x->hi) >= 0) x->empty = true;
}

/* Cuts *x to {q > 0}, q[2] <= 0. */
static void cut_quadratic(interval *x, orc_pool *p, const mpq_srcptr q[3]) {
  if (mpq_sgn(q[2]) > 0) orc_fatal("ds^2 - dl^2 is not concave");
  if (mpq_sgn(q[2]) == 0 && mpq_sgn(q[1]) == 0) {
    x->empty = x->empty || mpq_sgn(q[0]) <= 0;
    return;
  }
  if (mpq_sgn(q[2]) == 0) {
    orc_alg root = orc_alg_q(p, orc_neg(p, orc_div(p, q[0], q[1])));
    if (mpq_sgn(q[1]) > 0)
      cut_lo(x, p, root);
    else
      cut_hi(x, p, root);
  } else {
    mpq_srcptr disc = orc_sub(p, orc_sqr(p, q[1]), orc_mul(p, orc_si(p, 4, 1), orc_mul(p, q[2], q[0])));
    if (mpq_sgn(disc) <= 0) {
      x->empty = true;
      return;
    }
    /* 1/(2 q2) is negative: the lower root has the plus sign. */
    mpq_srcptr half = orc_div(p, orc_si(p, 1, 2), q[2]), a = orc_neg(p, orc_mul(p, q[1], half));
    cut_lo(x, p, (orc_alg){a, half, disc});
    cut_hi(x, p, (orc_alg){a, orc_neg(p, half), disc});
  }
  settle(x, p);
}

static int by_value(const void *x, const void *y) {
  return mpq_cmp(*(const mpq_srcptr *)x, *(const mpq_srcptr *)y);
}

/* The parameters at which the line crosses the lines through the sides of r, ascending. */
static size_t breakpoints(mpq_srcptr out[4], orc_pool *p, const piece *l, const orc_rect *r) {
  size_t count = 0;
  for (size_t k = 0; k < 4; k++) {
    size_t axis = k / 2;
    if (mpq_sgn(l->v[axis]) == 0) continue;
    out[count++] = orc_div(p, orc_sub(p, r->e[k], l->at[axis]), l->v[axis]);
  }
  qsort(out, count, sizeof *out, by_value);
  return count;
}

/* {t : h(t) > 0}, the union over the stretches between breakpoints. */
static interval positive(orc_pool *p, const piece *l, const orc_rect *r) {
  mpq_srcptr cut[4], one = orc_si(p, 1, 1);
  size_t n = breakpoints(cut, p, l, r);
  interval all = {.empty = true};
  for (size_t k = 0; k <= n; k++) {
    if (k > 0 && k < n && mpq_equal(cut[k - 1], cut[k])) continue;
    interval x = {0};
    mpq_srcptr inside = n == 0   ? one
                        : k == 0 ? orc_sub(p, cut[0], one)
                        : k == n ? orc_add(p, cut[n - 1], one)
                                 : orc_mid(p, cut[k - 1], cut[k]);
    if (k > 0) cut_lo(&x, p, orc_alg_q(p, cut[k - 1]));
    if (k < n) cut_hi(&x, p, orc_alg_q(p, cut[k]));
    mpq_srcptr q[3];
    quadratic_at(q, p, l, r, inside);
    cut_quadratic(&x, p, q);
    if (x.empty) continue;
    if (all.empty) all = x;
    all.has_hi = x.has_hi, all.hi = x.hi;
  }
  return all;
}

/* A rational in the open interval x and in [from,to]; false when there is none. */
static bool common_point(mpq_srcptr *out, orc_pool *p, const interval *x, mpq_srcptr from, mpq_srcptr to) {
  if (x->empty || (from && to && mpq_cmp(from, to) > 0)) return false;
  if (from && x->has_hi && orc_alg_cmp_q(p, x->hi, from) <= 0) return false;
  if (to && x->has_lo && orc_alg_cmp_q(p, x->lo, to) >= 0) return false;
  interval y = *x;
  if (from) cut_lo(&y, p, orc_alg_q(p, from));
  if (to) cut_hi(&y, p, orc_alg_q(p, to));
  mpq_srcptr one = orc_si(p, 1, 1);
  if (!y.has_lo && !y.has_hi)
    *out = orc_si(p, 0, 1);
  else if (!y.has_lo)
    *out = orc_sub(p, orc_alg_near(p, y.hi, 8), orc_add(p, one, orc_sqr(p, y.hi.b)));
  else if (!y.has_hi)
    *out = orc_add(p, orc_alg_near(p, y.lo, 8), orc_add(p, one, orc_sqr(p, y.lo.b)));
  else if (orc_alg_cmp(p, y.lo, y.hi) < 0)
    *out = orc_alg_between(p, y.lo, y.hi);
  else
    *out = from; /* from = to */
  return true;
}

/* A witness on the piece. */
static bool search_piece(mpq_srcptr w[2], orc_pool *p, const orc_case *c, size_t i, size_t j, const piece *l) {
  interval x = {0};
  mpq_srcptr t = NULL;
  for (size_t k = 0; k < c->n && !x.empty; k++) {
    if (k == i || k == j) continue;
    interval y = positive(p, l, &c->rect[k]);
    if (y.empty) return false;
    if (y.has_lo) cut_lo(&x, p, y.lo);
    if (y.has_hi) cut_hi(&x, p, y.hi);
    settle(&x, p);
  }
  if (!common_point(&t, p, &x, l->from, l->to)) return false;
  w[0] = along(p, l, 0, t), w[1] = along(p, l, 1, t);
  if (!orc_is_witness(p, c, i, j, w[0], w[1])) orc_fatal("a witness fails its test");
  return true;
}

static bool try_piece(mpq_srcptr w[2], orc_pool *p, const orc_case *c, size_t i, size_t j, const piece *l) {
  size_t mark = orc_mark(p);
  bool found = search_piece(w, p, c, i, j, l);
  if (!found) orc_release(p, mark);
  return found;
}

/* Cuts the piece to a + b t <= 0; false when nothing is left. */
static bool cut_linear(piece *l, orc_pool *p, mpq_srcptr a, mpq_srcptr b) {
  if (mpq_sgn(b) == 0) return mpq_sgn(a) <= 0;
  mpq_srcptr root = orc_neg(p, orc_div(p, a, b));
  if (mpq_sgn(b) > 0) {
    if (!l->to || mpq_cmp(root, l->to) < 0) l->to = root;
  } else if (!l->from || mpq_cmp(root, l->from) > 0) {
    l->from = root;
  }
  return !l->from || !l->to || mpq_cmp(l->from, l->to) <= 0;
}

/* lo <= coordinate <= hi. */
static bool cut_axis(piece *l, orc_pool *p, size_t axis, mpq_srcptr lo, mpq_srcptr hi) {
  if (lo && !cut_linear(l, p, orc_sub(p, lo, l->at[axis]), orc_neg(p, l->v[axis]))) return false;
  return !hi || cut_linear(l, p, orc_sub(p, l->at[axis], hi), l->v[axis]);
}

/* |c - t|^2 - |c - s|^2 <= 0 for the corner t = (e[x], e[2+y]) of r. */
static bool cut_nearer(piece *l, orc_pool *p, const orc_rect *r, size_t corner) {
  mpq_srcptr q[3] = {orc_si(p, 0, 1), orc_si(p, 0, 1), orc_si(p, 0, 1)};
  for (size_t axis = 0; axis < 2; axis++) {
    add_square(q, p, l, axis, r->e[2 * axis + (corner >> axis & 1)], 1);
    add_square(q, p, l, axis, l->s[axis], -1);
  }
  return cut_linear(l, p, q[0], q[1]);
}

/* Pieces of kind A on the mid-line of R_i across the given axis. */
static bool try_mid_line(mpq_srcptr w[2], orc_pool *p, const orc_case *c, size_t i, size_t j, size_t axis) {
  const orc_rect *r = &c->rect[i];
  if (mpq_equal(r->e[2 * axis], r->e[2 * axis + 1])) return false;
  orc_piece half[2];
  size_t other = 1 - axis, n = orc_pieces_farthest(half, p, &r->e[2 * other]);
  for (size_t m = 0; m < n; m++) {
    piece l = {.from = half[m].lo, .to = half[m].hi};
    l.at[axis] = orc_mid(p, r->e[2 * axis], r->e[2 * axis + 1]), l.at[other] = orc_si(p, 0, 1);
    l.v[axis] = orc_si(p, 0, 1), l.v[other] = orc_si(p, 1, 1);
    l.s[axis] = r->e[2 * axis], l.s[other] = half[m].at;
    bool some = true;
    for (size_t corner = 0; corner < 4 && some; corner++) some = cut_nearer(&l, p, &c->rect[j], corner);
    if (some && try_piece(w, p, c, i, j, &l)) return true;
  }
  return false;
}

/* The piece of kind D in one cell: 2 (t-s).c = |t|^2 - |s|^2. */
static bool try_bisector(mpq_srcptr w[2], orc_pool *p, const orc_case *c, size_t i, size_t j, const orc_piece si[2],
                         const orc_piece sj[2]) {
  mpq_srcptr u[2], norm = orc_si(p, 0, 1), right = orc_si(p, 0, 1);
  for (size_t axis = 0; axis < 2; axis++) {
    u[axis] = orc_sub(p, sj[axis].at, si[axis].at);
    norm = orc_add(p, norm, orc_sqr(p, u[axis]));
    right = orc_add(p, right, orc_sub(p, orc_sqr(p, sj[axis].at), orc_sqr(p, si[axis].at)));
  }
  if (mpq_sgn(norm) == 0) return false;
  mpq_srcptr scale = orc_div(p, right, orc_twice(p, norm));
  piece l = {.at = {orc_mul(p, u[0], scale), orc_mul(p, u[1], scale)},
             .v = {orc_neg(p, u[1]), u[0]},
             .s = {si[0].at, si[1].at}};
  for (size_t axis = 0; axis < 2; axis++)
    if (!cut_axis(&l, p, axis, si[axis].lo, si[axis].hi) || !cut_axis(&l, p, axis, sj[axis].lo, sj[axis].hi))
      return false;
  return try_piece(w, p, c, i, j, &l);
}

/* Every choice of the farthest corners of R_i and R_j: a bit per axis and rectangle. */
static bool try_bisectors(mpq_srcptr w[2], orc_pool *p, const orc_case *c, size_t i, size_t j) {
  orc_piece half[4][2];
  size_t n[4];
  for (size_t m = 0; m < 4; m++) n[m] = orc_pieces_farthest(half[m], p, &c->rect[m < 2 ? i : j].e[2 * (m & 1)]);
  for (size_t v = 0; v < 16; v++) {
    size_t b[4] = {v & 1, v >> 1 & 1, v >> 2 & 1, v >> 3 & 1};
    if (b[0] >= n[0] || b[1] >= n[1] || b[2] >= n[2] || b[3] >= n[3]) continue;
    orc_piece si[2] = {half[0][b[0]], half[1][b[1]]}, sj[2] = {half[2][b[2]], half[3][b[3]]};
    if (try_bisector(w, p, c, i, j, si, sj)) return true;
  }
  return false;
}

bool orc_legal(mpq_srcptr *wx, mpq_srcptr *wy, orc_pool *p, const orc_case *c, size_t i, size_t j) {
  mpq_srcptr w[2] = {NULL, NULL};
  bool found = try_bisectors(w, p, c, i, j);
  for (size_t v = 0; v < 4 && !found; v++) found = try_mid_line(w, p, c, v & 2 ? j : i, v & 2 ? i : j, v & 1);
  if (found && wx && wy) *wx = w[0], *wy = w[1];
  return found;
}
