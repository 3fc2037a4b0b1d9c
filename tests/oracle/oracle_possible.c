/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* possible(i,j), exactly (mathematics: sections 3 and 5) [POS-1].
 *
 * Let R_i and R_j be disjoint. Moving a free centre c (max(ds_i,ds_j) <= dl_k for all k) towards the farther of the
 * two lowers the maximum at least as fast as any dl_k, so some free centre lies on beta = {ds_i = ds_j}, a curve
 * with two ends at infinity. The free part of beta is closed. If it is not empty, then it holds an end at
 * infinity, or it has an end in the plane: a point where ds_i = ds_j = dl_k for some k, and where the three
 * functions, each with the features that hold inside the part blocked by k, do not agree along beta. So it is
 * enough to solve, for every k and every choice of features on full-dimensional cells, the equations
 *     |c - s|^2 = d(c, feature of i)^2 = d(c, feature of j)^2,     s a corner of R_k,
 * except equations that agree on a curve, and to test each solution literally against all sites. In
 * coordinates X = c - s each equation is a line (corner feature (p,q): 2 p X + 2 q Y = p^2 + q^2) or a parabola
 * (side X = a: Y^2 + 2 a X = a^2), and two parabolas have a common line: (X-a)^2 = (X-b)^2 or (X-a)^2 = (Y-b)^2.
 *
 * At infinity the good directions are closed too; the ends of an arc of them are normal to a line through
 * a corner of R_i or R_j and a corner of another rectangle. */
#include "oracle/oracle.h"

/* Rationals: the line u X + v Y = w. */
typedef struct line {
  mpq_srcptr u, v, w;
} line;

/* A feature relative to s: x and y given: the corner; one of them NULL: the side. */
typedef struct feature {
  mpq_srcptr x, y;
} feature;

typedef struct search {
  orc_pool *p;
  const orc_case *c;
  size_t i, j, k;
  mpq_srcptr sx, sy;
  mpq_srcptr xlo, xhi, ylo, yhi; /* the cell */
} search;

static bool in_range(orc_pool *p, orc_alg t, mpq_srcptr lo, mpq_srcptr hi) {
  return (!lo || orc_alg_cmp_q(p, t, lo) >= 0) && (!hi || orc_alg_cmp_q(p, t, hi) <= 0);
}

/* Returns true if the solution (X,Y) in its cell is a free centre. */
static bool try_centre(const search *s, orc_alg x, orc_alg y) {
  orc_pool *p = s->p;
  orc_point at = {orc_alg_sub_q(p, x, orc_neg(p, s->sx)), orc_alg_sub_q(p, y, orc_neg(p, s->sy))};
  if (!in_range(p, at.x, s->xlo, s->xhi) || !in_range(p, at.y, s->ylo, s->yhi)) return false;
  orc_alg di = orc_ds2(p, at, &s->c->rect[s->i]), dj = orc_ds2(p, at, &s->c->rect[s->j]);
  orc_alg dk = orc_dl2(p, at, &s->c->rect[s->k]);
  if (orc_alg_sgn(p, orc_alg_sub(p, di, dj)) || orc_alg_sgn(p, orc_alg_sub(p, di, dk)))
    orc_fatal("a critical circle misses its rectangles");
  return orc_is_free(p, s->c, s->i, s->j, at);
}

/* a X + b Y = e and c X + d Y = f. */
static bool try_two_lines(const search *s, line l, line m) {
  orc_pool *p = s->p;
  mpq_srcptr det = orc_sub(p, orc_mul(p, l.u, m.v), orc_mul(p, l.v, m.u));
  if (mpq_sgn(det) == 0) return false;
  mpq_srcptr x = orc_div(p, orc_sub(p, orc_mul(p, l.w, m.v), orc_mul(p, l.v, m.w)), det);
  mpq_srcptr y = orc_div(p, orc_sub(p, orc_mul(p, l.u, m.w), orc_mul(p, l.w, m.u)), det);
  return try_centre(s, orc_alg_q(p, x), orc_alg_q(p, y));
}

/* The centre P + t D. */
static bool try_parameter(const search *s, const mpq_srcptr *at, const mpq_srcptr *d, orc_alg t) {
  return try_centre(s, orc_alg_affine(s->p, t, d[0], at[0]), orc_alg_affine(s->p, t, d[1], at[1]));
}

/* The roots of a2 t^2 + a1 t + a0, put into P + t D. */
static bool try_roots(const search *s, const mpq_srcptr *at, const mpq_srcptr *d, mpq_srcptr a2, mpq_srcptr a1,
                      mpq_srcptr a0) {
  orc_pool *p = s->p;
  if (mpq_sgn(a2) == 0) {
    if (mpq_sgn(a1) == 0) return false;
    return try_parameter(s, at, d, orc_alg_q(p, orc_neg(p, orc_div(p, a0, a1))));
  }
  mpq_srcptr four = orc_mul(p, orc_si(p, 4, 1), orc_mul(p, a2, a0));
  mpq_srcptr disc = orc_sub(p, orc_sqr(p, a1), four);
  if (mpq_sgn(disc) < 0) return false;
  mpq_srcptr half = orc_div(p, orc_si(p, 1, 2), a2), a = orc_neg(p, orc_mul(p, a1, half));
  return try_parameter(s, at, d, (orc_alg){a, half, disc}) ||
         try_parameter(s, at, d, (orc_alg){a, orc_neg(p, half), disc});
}

/* The line l and the parabola of a side: vertical X = a: Y^2 + 2 a X - a^2 = 0; horizontal: the same with X, Y
 * exchanged. On the line (X,Y) = w (u,v) / (u^2 + v^2) + t (-v,u). */
static bool try_line_side(const search *s, line l, feature side) {
  orc_pool *p = s->p;
  mpq_srcptr scale = orc_div(p, l.w, orc_add(p, orc_sqr(p, l.u), orc_sqr(p, l.v)));
  mpq_srcptr at[2] = {orc_mul(p, l.u, scale), orc_mul(p, l.v, scale)}, d[2] = {orc_neg(p, l.v), l.u};
  size_t along = side.x ? 1 : 0, across = 1 - along;
  mpq_srcptr a = side.x ? side.x : side.y, a_twice = orc_twice(p, a);
  mpq_srcptr a2 = orc_sqr(p, d[along]);
  mpq_srcptr a1 = orc_add(p, orc_twice(p, orc_mul(p, at[along], d[along])), orc_mul(p, a_twice, d[across]));
  mpq_srcptr a0 = orc_add(p, orc_sqr(p, at[along]), orc_mul(p, a_twice, at[across]));
  return try_roots(s, at, d, a2, a1, orc_sub(p, a0, orc_sqr(p, a)));
}

static bool is_corner(feature f) {
  return f.x && f.y;
}

/* False when the corner is s itself: the equation says nothing. */
static bool corner_line(line *out, orc_pool *p, feature f) {
  *out = (line){orc_twice(p, f.x), orc_twice(p, f.y), orc_add(p, orc_sqr(p, f.x), orc_sqr(p, f.y))};
  return mpq_sgn(f.x) || mpq_sgn(f.y);
}

static bool try_two_sides(const search *s, feature f, feature g) {
  orc_pool *p = s->p;
  mpq_srcptr one = orc_si(p, 1, 1), zero = orc_si(p, 0, 1), minus = orc_si(p, -1, 1);
  if (f.x && g.x) return !mpq_equal(f.x, g.x) && try_line_side(s, (line){one, zero, orc_mid(p, f.x, g.x)}, f);
  if (f.y && g.y) return !mpq_equal(f.y, g.y) && try_line_side(s, (line){zero, one, orc_mid(p, f.y, g.y)}, f);
  mpq_srcptr a = f.x ? f.x : g.x, b = f.y ? f.y : g.y;
  return try_line_side(s, (line){one, minus, orc_sub(p, a, b)}, f) ||
         try_line_side(s, (line){one, one, orc_add(p, a, b)}, f);
}

static bool try_features(const search *s, feature f, feature g) {
  line l = {0}, m = {0};
  if (is_corner(f) && !corner_line(&l, s->p, f)) return false;
  if (is_corner(g) && !corner_line(&m, s->p, g)) return false;
  if (is_corner(f) && is_corner(g)) return try_two_lines(s, l, m);
  if (is_corner(f)) return try_line_side(s, l, g);
  if (is_corner(g)) return try_line_side(s, m, f);
  return try_two_sides(s, f, g);
}

/* One axis of a combination: pieces of i, j (closest) and k (farthest) with a common range. */
typedef struct combination {
  mpq_srcptr lo, hi, i, j, k;
} combination;

static size_t combinations(combination out[18], const search *s, size_t axis) {
  orc_piece pi[3], pj[3], pk[2];
  size_t ni = orc_pieces_closest(pi, s->p, &s->c->rect[s->i].e[2 * axis]);
  size_t nj = orc_pieces_closest(pj, s->p, &s->c->rect[s->j].e[2 * axis]);
  size_t nk = orc_pieces_farthest(pk, s->p, &s->c->rect[s->k].e[2 * axis]);
  size_t count = 0;
  for (size_t a = 0; a < ni; a++)
    for (size_t b = 0; b < nj; b++)
      for (size_t d = 0; d < nk; d++) {
        combination m = {pi[a].lo, pi[a].hi, pi[a].at, pj[b].at, pk[d].at};
        if (orc_range_cut(&m.lo, &m.hi, pj[b]) && orc_range_cut(&m.lo, &m.hi, pk[d])) out[count++] = m;
      }
  return count;
}

static mpq_srcptr relative(orc_pool *p, mpq_srcptr x, mpq_srcptr s) {
  return x ? orc_sub(p, x, s) : NULL;
}

static bool try_cell(search *s, const combination *x, const combination *y) {
  if ((!x->i && !y->i) || (!x->j && !y->j)) return false; /* inside a rectangle: ds = 0 for that one only */
  size_t mark = orc_mark(s->p);
  s->sx = x->k, s->sy = y->k;
  s->xlo = x->lo, s->xhi = x->hi, s->ylo = y->lo, s->yhi = y->hi;
  feature f = {relative(s->p, x->i, s->sx), relative(s->p, y->i, s->sy)};
  feature g = {relative(s->p, x->j, s->sx), relative(s->p, y->j, s->sy)};
  bool found = try_features(s, f, g);
  orc_release(s->p, mark);
  return found;
}

static bool free_critical_circle(search *s) {
  combination x[18], y[18];
  size_t nx = combinations(x, s, 0), ny = combinations(y, s, 1);
  for (size_t a = 0; a < nx; a++)
    for (size_t b = 0; b < ny; b++)
      if (try_cell(s, &x[a], &y[b])) return true;
  return false;
}

/* ---- centres at infinity ---- */

/* The largest (want > 0) or smallest value of u.x over r. */
static mpq_srcptr support(orc_pool *p, const mpq_srcptr *u, const orc_rect *r, int want) {
  mpq_srcptr x = r->e[mpq_sgn(u[0]) * want > 0 ? 1 : 0], y = r->e[mpq_sgn(u[1]) * want > 0 ? 3 : 2];
  return orc_add(p, orc_mul(p, u[0], x), orc_mul(p, u[1], y));
}

static bool direction_free(orc_pool *p, const orc_case *c, size_t i, size_t j, mpq_srcptr ux, mpq_srcptr uy) {
  mpq_srcptr u[2] = {ux, uy};
  size_t mark = orc_mark(p);
  mpq_srcptr hi = support(p, u, &c->rect[i], 1), hj = support(p, u, &c->rect[j], 1);
  bool good = true;
  for (size_t k = 0; k < c->n && good; k++) {
    mpq_srcptr low = support(p, u, &c->rect[k], -1);
    good = mpq_cmp(hi, low) >= 0 && mpq_cmp(hj, low) >= 0;
  }
  orc_release(p, mark);
  return good;
}

/* Returns true if corner number v (bit 0: upper x, bit 1: upper y) is also one of a lower number. */
static bool same_corner(const orc_rect *r, size_t v) {
  return ((v & 1) && mpq_equal(r->e[0], r->e[1])) || ((v & 2) && mpq_equal(r->e[2], r->e[3]));
}

/* Both normals of every line through a corner of r and a corner of t. */
static bool normals_free(orc_pool *p, const orc_case *c, size_t i, size_t j, const orc_rect *r, const orc_rect *t) {
  for (size_t v = 0; v < 16; v++) {
    if (same_corner(t, v & 3) || same_corner(r, v >> 2)) continue;
    size_t mark = orc_mark(p);
    mpq_srcptr dx = orc_sub(p, t->e[v & 1], r->e[v >> 2 & 1]);
    mpq_srcptr dy = orc_sub(p, t->e[2 + (v >> 1 & 1)], r->e[2 + (v >> 3 & 1)]);
    bool some = mpq_sgn(dx) || mpq_sgn(dy);
    bool good =
        some && (direction_free(p, c, i, j, orc_neg(p, dy), dx) || direction_free(p, c, i, j, dy, orc_neg(p, dx)));
    orc_release(p, mark);
    if (good) return true;
  }
  return false;
}

static bool free_at_infinity(orc_pool *p, const orc_case *c, size_t i, size_t j) {
  size_t mark = orc_mark(p);
  mpq_srcptr one = orc_si(p, 1, 1), zero = orc_si(p, 0, 1), minus = orc_si(p, -1, 1);
  bool good = direction_free(p, c, i, j, one, zero) || direction_free(p, c, i, j, zero, one) ||
              direction_free(p, c, i, j, minus, zero) || direction_free(p, c, i, j, zero, minus);
  orc_release(p, mark);
  for (size_t k = 0; k < c->n && !good; k++)
    good = (k != i && normals_free(p, c, i, j, &c->rect[i], &c->rect[k])) ||
           (k != j && normals_free(p, c, i, j, &c->rect[j], &c->rect[k]));
  return good;
}

bool orc_possible(orc_pool *p, const orc_case *c, size_t i, size_t j) {
  if (orc_rect_meets(&c->rect[i], &c->rect[j])) return true;
  if (free_at_infinity(p, c, i, j)) return true;
  size_t mark = orc_mark(p);
  bool found = false;
  for (size_t k = 0; k < c->n && !found; k++) {
    if (k == i || k == j) continue;
    search s = {.p = p, .c = c, .i = i, .j = j, .k = k};
    found = free_critical_circle(&s);
    orc_release(p, mark);
  }
  return found;
}
