/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of a region: what intervals leave in doubt, from exact numbers [OUTLINE-1].
 *
 * All rectangles of a cell are brought to one integer scale when the first doubt arises. Points have the form A + B
 * sqrt(C) there (surd_point.h): the ends of an arc come from its line or parabola and its pane, the
 * points in which two curves meet from the critical circles of three rectangles [CRIT-1].
 *
 * [ARC-1] Let s be the far corner of a and q the closest feature of b in a pane. With n = q - s and m = q + s, corners
 * q give the line n_x (2x - m_x) + n_y (2y - m_y) = 0; a side on the line of coordinate L along axis k (o the other
 * one) gives the parabola (t - s_k)^2 = h (2v - L - s_o), h = s_o - L, for the point with coordinates t along k, v
 * along o. The middle line of a through the far corner's axis bounds the pane, and s lies beyond it, so t - s_k has one
 * sign in the pane: the arc is one branch, monotone in both coordinates, and its part in the pane is connected. It
 * cannot run along the border of a pane, since s, the corner q or the corner opposite s would then lie in both
 * rectangles; along a side of the window it can. For singletons a and b no cut is needed. */
#include "voronoi/outline.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "predicate/circle.h"
#include "rect/rect.h"

#include <dyadel/arc.h>

typedef struct exact_point {
  dyd_surd_point at;
  struct exact_point *next;
} exact_point;

/* Coordinates are F (x - o) for the caller's x: F = man * 2^exp, even on rectangles, so that middles are integers; o is
 * the lower corner of the own rectangle. Doubles are taken of 2^-shift times them. rect: of the others, the own one,
 * the bounds and the window; middle: of each. circle[0 .. circles): of curves pair[0] and pair[1], the last that were
 * asked for. */
typedef struct dyd_outline_exact {
  size_t count;
  dyd_irect *rect;
  mpz_t *middle;
  mpz_t man, ox, oy;
  int64_t exp, shift;
  exact_point *points;
  uint64_t bytes;
  dyd_icircle circle[DYD_OUTLINE_CIRCLES];
  size_t circles;
  uint32_t pair[2];
} exact_cell;

/* ---- elementary arcs: one for each pane of the plane in which far corner and closest feature stay the same ---- */

/* { c in the pane lo .. hi (NULL: no bound) : |c - s| = distance to q }, q a corner, or the line of coordinate
 * q[1 - axis] (q[axis] = NULL); all borrowed. The coordinate `axis` is strictly monotone along the arc; end[0] is its
 * lower end, if it is not infinite. point: the arc is one point, at which the curve touches the border of the pane. */
typedef struct elementary {
  bool parabola, point, infinite[2];
  int axis, branch;
  mpz_srcptr s[2], q[2], lo[2], hi[2];
  dyd_surd_point end[2];
} elementary;

static void elementary_init(elementary *a) {
  *a = (elementary){.branch = 0};
  for (int e = 0; e < 2; e++) dyd_surd_point_init(&a->end[e]);
}

static void elementary_clear(elementary *a) {
  for (int e = 2; e-- > 0;) dyd_surd_point_clear(&a->end[e]);
}

/* ---- points of an arc ---- */

/* The coordinate n_k (2 t - m_k) + n_o (2 v - m_o) = 0 of a line: given t = num / 2^bits along k, v along o. */
static void point_of_line(dyd_surd_point *out, const elementary *a, int k, mpz_srcptr num, int64_t bits) {
  int o = 1 - k;
  mpz_ptr to[2] = {out->ax, out->ay};
  DYD_LOCAL_NUMBERS(mpz, n, m);
  mpz_sub(n, a->q[k], a->s[k]);
  mpz_add(m, a->q[k], a->s[k]);
  mpz_mul(to[o], n, m);
  mpz_sub(out->d, a->q[o], a->s[o]);
  mpz_add(m, a->q[o], a->s[o]);
  mpz_addmul(to[o], out->d, m);
  mpz_mul_2exp(to[o], to[o], (mp_bitcnt_t)bits);
  mpz_mul_2exp(n, n, 1);
  mpz_submul(to[o], n, num); /* 2^bits n.m - 2 n_k num */
  mpz_mul_2exp(out->d, out->d, 1);
  mpz_mul(to[k], num, out->d);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits);
}

/* v = ((t - s_k)^2 + h (L + s_o)) / 2h */
static void point_of_parabola(dyd_surd_point *out, const elementary *a, mpz_srcptr num, int64_t bits) {
  int k = a->axis, o = 1 - k;
  mpz_ptr to[2] = {out->ax, out->ay};
  mpz_mul_2exp(to[k], a->s[k], (mp_bitcnt_t)bits);
  mpz_sub(to[k], num, to[k]);
  mpz_sub(out->d, a->s[o], a->q[o]);
  mpz_add(to[o], a->s[o], a->q[o]);
  mpz_mul(to[o], to[o], out->d);
  mpz_mul_2exp(to[o], to[o], (mp_bitcnt_t)(2 * bits));
  mpz_addmul(to[o], to[k], to[k]);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits + 1);
  mpz_mul(to[k], num, out->d);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits);
}

static void point_make_positive(dyd_surd_point *p) {
  if (mpz_sgn(p->d) > 0) return;
  mpz_neg(p->d, p->d);
  mpz_neg(p->ax, p->ax);
  mpz_neg(p->ay, p->ay);
}

/* out = the point of the line or branch of parabola whose coordinate a->axis is num / 2^bits. */
static void elementary_at(dyd_surd_point *out, const elementary *a, mpz_srcptr num, int64_t bits) {
  dyd_surd_point_drop_root(out);
  if (a->parabola) {
    point_of_parabola(out, a, num, bits);
  } else {
    point_of_line(out, a, a->axis, num, bits);
  }
  point_make_positive(out);
}

/* The point where coordinate o = 1 - axis is z. -1, 1: there is none, all of the parabola is below, above z. */
static int point_across(dyd_surd_point *out, const elementary *a, mpz_srcptr z) {
  int k = a->axis, o = 1 - k;
  dyd_surd_point_drop_root(out);
  if (!a->parabola) {
    point_of_line(out, a, o, z, 0);
    point_make_positive(out);
    return 0;
  }
  mpz_ptr to[2] = {out->ax, out->ay}, root[2] = {out->bx, out->by};
  mpz_mul_2exp(out->c, z, 1);
  mpz_sub(out->c, out->c, a->q[o]);
  mpz_sub(out->c, out->c, a->s[o]);
  mpz_sub(out->d, a->s[o], a->q[o]);
  int opens = mpz_sgn(out->d);
  mpz_mul(out->c, out->c, out->d);
  mpz_set_ui(out->d, 1);
  if (mpz_sgn(out->c) < 0) return mpz_set_ui(out->c, 0), opens;
  mpz_set(to[k], a->s[k]);
  mpz_set(to[o], z);
  mpz_set_si(root[k], a->branch);
  return 0;
}

/* ---- clipping ---- */

/* Sign of dv/dt. */
static int arc_slope(const elementary *a) {
  int k = a->axis, o = 1 - k;
  int across = mpz_cmp(a->q[o], a->s[o]) > 0 ? 1 : -1;
  if (a->parabola) return -across * a->branch;
  int n = mpz_cmp(a->q[k], a->s[k]);
  return n > 0 ? -across : n < 0 ? across : 0;
}

/* End e = the tighter of itself and p (swapped in); e = 0: lower end. */
static void tighten_end(elementary *a, dyd_surd_point *p, int e) {
  int sign = a->infinite[e] ? 0 : dyd_surd_point_cmp(p, &a->end[e], a->axis);
  if (!a->infinite[e] && (e ? sign >= 0 : sign <= 0)) return;
  dyd_surd_point t = a->end[e];
  a->end[e] = *p;
  *p = t;
  a->infinite[e] = false;
}

/* A line along `axis`, v = m/2 everywhere: is it in the pane, and on its border only with the region inside? */
static bool level_is_inside(const elementary *a, int side) {
  int o = 1 - a->axis;
  DYD_LOCAL_NUMBERS(mpz, m, t);
  mpz_add(m, a->q[o], a->s[o]);
  bool inside = true;
  for (int e = 0; e < 2 && inside; e++) {
    mpz_srcptr bound = e ? a->hi[o] : a->lo[o];
    if (!bound) continue;
    mpz_mul_2exp(t, bound, 1);
    int beyond = mpz_cmp(m, t) * (e ? 1 : -1), region = side * (mpz_cmp(a->s[o], a->q[o]) > 0 ? 1 : -1);
    inside = beyond < 0 || (beyond == 0 && region == (e ? -1 : 1));
  }
  return inside;
}

/* Cuts by the bounds of coordinate o; false: nothing left. */
static bool clip_arc_across(elementary *a, dyd_surd_point *p, int side) {
  int o = 1 - a->axis, grows = arc_slope(a);
  if (!a->parabola && !grows) return level_is_inside(a, side);
  for (int e = 0; e < 2; e++) {
    mpz_srcptr bound = e ? a->hi[o] : a->lo[o];
    if (!bound) continue;
    int missed = point_across(p, a, bound);
    if (missed && (missed > 0) == (e == 1)) return false;
    if (!missed) tighten_end(a, p, grows > 0 ? e : 1 - e);
  }
  return true;
}

/* Sets the ends and `point`; false: nothing in the pane. Of arcs along a side of the pane, the ones with the region
 * inside: C_ab (side = 1), or its complement (-1). */
static bool elementary_clip(elementary *a, int side) {
  a->infinite[0] = a->infinite[1] = true;
  a->point = false;
  for (int e = 0; e < 2; e++) {
    mpz_srcptr bound = e ? a->hi[a->axis] : a->lo[a->axis];
    if (!bound) continue;
    elementary_at(&a->end[e], a, bound, 0);
    a->infinite[e] = false;
  }
  DYD_LOCAL(dyd_surd_point, p);
  if (!clip_arc_across(a, &p, side)) return false;
  if (a->infinite[0] || a->infinite[1]) return true;
  int order = dyd_surd_point_cmp(&a->end[0], &a->end[1], a->axis);
  a->point = order == 0;
  return order <= 0;
}

/* Which coordinate to go along: across q - s where it is longer, or along the directrix. */
static int elementary_axis(const elementary *a) {
  if (a->parabola) return a->q[0] ? 1 : 0;
  DYD_LOCAL_NUMBERS(mpz, x, y);
  mpz_sub(x, a->q[0], a->s[0]);
  mpz_sub(y, a->q[1], a->s[1]);
  return mpz_cmpabs(x, y) <= 0 ? 0 : 1;
}

/* Returns true if a point of the curve is in the closed pane. */
static bool elementary_holds(const elementary *a, const dyd_surd_point *p) {
  for (int k = 0; k < 2; k++) {
    if (a->lo[k] && dyd_surd_point_cmp_z(p, k, a->lo[k]) < 0) return false;
    if (a->hi[k] && dyd_surd_point_cmp_z(p, k, a->hi[k]) > 0) return false;
  }
  return true;
}

/* ---- scale ---- */

void dyd_outline_exact_clear(dyd_outline *o) {
  exact_cell *x = o->exact;
  if (!x) return;
  for (exact_point *p = x->points, *next; p; p = next) {
    next = p->next;
    dyd_surd_point_clear(&p->at);
    free(p);
  }
  for (size_t k = 0; k < x->count; k++) {
    dyd_irect_clear(&x->rect[k]);
    mpz_clears(x->middle[2 * k], x->middle[2 * k + 1], NULL);
  }
  for (size_t k = DYD_OUTLINE_CIRCLES; k-- > 0;) dyd_icircle_clear(&x->circle[k]);
  mpz_clears(x->man, x->ox, x->oy, NULL);
  dyd_free_all(x->rect, x->middle, x);
  o->exact = NULL;
}

static bool exact_new(dyd_outline *o, size_t count) {
  exact_cell *x = calloc(1, sizeof *x);
  if (!x) return false;
  o->exact = x;
  mpz_inits(x->man, x->ox, x->oy, NULL);
  for (size_t k = 0; k < DYD_OUTLINE_CIRCLES; k++) dyd_icircle_init(&x->circle[k]);
  x->pair[0] = x->pair[1] = DYD_NONE;
  if (!DYD_NEW(x->rect, count) || !DYD_NEW(x->middle, 2 * count)) return false;
  for (; x->count < count; x->count++) {
    dyd_irect_init(&x->rect[x->count]);
    mpz_inits(x->middle[2 * x->count], x->middle[2 * x->count + 1], NULL);
  }
  return true;
}

/* The window cut down to the bounds; elsewhere the ends of the own rectangle, which are not used. */
static dyd_status bounds_rect(dyd_rect *out, const dyd_outline *o, const dyd_rect *own) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, lo, hi, spare);
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    mpq_ptr end[2] = {lo, hi};
    for (int e = 0; e < 2; e++) {
      const dyd_rect *from = o->bounded[2 * a + e] && o->of_window[2 * a + e] ? o->rect : own;
      dyd_interval_get_q(e ? spare : lo, e ? hi : spare, a ? &from->y : &from->x);
      if (o->bounded[2 * a + e] && !o->of_window[2 * a + e]) mpq_set_d(end[e], o->bound[2 * a + e].lo);
    }
    if (mpq_cmp(lo, hi) > 0) mpq_set(o->bounded[2 * a] ? hi : lo, o->bounded[2 * a] ? lo : hi);
    st = dyd_interval_set_ends_q(a ? &out->y : &out->x, lo, hi);
  }
  return st;
}

/* Moves the origin to the own rectangle and doubles. */
static void rects_place(exact_cell *x, size_t own) {
  mpz_set(x->ox, x->rect[own].x0);
  mpz_set(x->oy, x->rect[own].y0);
  size_t bits = 0;
  for (size_t k = 0; k < x->count; k++) {
    dyd_irect *r = &x->rect[k];
    mpz_ptr end[4] = {r->x0, r->x1, r->y0, r->y1};
    for (int e = 0; e < 4; e++) {
      mpz_sub(end[e], end[e], e < 2 ? x->ox : x->oy);
      mpz_mul_2exp(end[e], end[e], 1);
      if (mpz_sizeinbase(end[e], 2) > bits) bits = mpz_sizeinbase(end[e], 2);
    }
    for (int a = 0; a < 2; a++) {
      mpz_add(x->middle[2 * k + (size_t)a], end[2 * a], end[2 * a + 1]);
      mpz_tdiv_q_2exp(x->middle[2 * k + (size_t)a], x->middle[2 * k + (size_t)a], 1);
    }
  }
  mpz_mul_2exp(x->ox, x->ox, 1);
  mpz_mul_2exp(x->oy, x->oy, 1);
  x->exp++;
  x->shift = bits > 200 ? (int64_t)bits - 200 : 0; /* products of four doubles stay below 2^1000 */
}

const dyd_rect *dyd_outline_rect(dyd_outline *o, dyd_rect *fetched, size_t k) {
  if (o->item[k].rect) return o->item[k].rect;
  dyd_status st = dyd_sites_get(fetched, o->sites, o->item[k].site);
  if (st != DYD_OK && o->status == DYD_OK) o->status = st;
  return fetched;
}

static dyd_status rects_scale(dyd_outline *o, dyd_rect *fetched, const dyd_rect **in) {
  const size_t bounds = o->count + 1;
  for (size_t k = 0; k <= o->count && o->status == DYD_OK; k++) in[k] = dyd_outline_rect(o, &fetched[k], k);
  dyd_status st = o->status;
  if (st == DYD_OK) st = bounds_rect(&fetched[bounds], o, in[o->count]);
  in[bounds] = &fetched[bounds];
  in[bounds + 1] = o->rect ? o->rect : in[o->count];
  if (st == DYD_OK) dyd_irects_scale(o->exact->rect, in, o->exact->count, o->exact->man, &o->exact->exp);
  return st;
}

/* The cell in exact numbers; NULL, and o->status: without memory. */
static exact_cell *exact_of(dyd_outline *o) {
  if (o->exact || o->status != DYD_OK) return o->status == DYD_OK ? o->exact : NULL;
  size_t n = o->count + 3;
  dyd_rect *fetched = dyd_alloc(n, sizeof *fetched);
  DYD_FREED const dyd_rect **in = dyd_alloc(n, sizeof *in);
  o->status = fetched && in && exact_new(o, n) ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; fetched && k < n; k++) dyd_rect_init(&fetched[k]);
  if (o->status == DYD_OK) o->status = rects_scale(o, fetched, in);
  for (size_t k = 0; fetched && k < n; k++) dyd_rect_clear(&fetched[k]);
  free(fetched);
  if (o->status != DYD_OK) return NULL;
  rects_place(o->exact, o->count);
  return o->exact;
}

void dyd_outline_unscale(dyd_surd_point *p, const dyd_outline *o) {
  const exact_cell *x = o->exact;
  dyd_surd_point_unscale(p, x->ox, x->oy, x->man, x->exp);
}

/* ---- arcs ---- */

/* NULL: no bound. */
static mpz_srcptr mark_of(const dyd_outline *o, size_t far, size_t near, int axis, int mark) {
  const exact_cell *x = o->exact;
  int high = mark == DYD_WINDOW_HI || mark == DYD_NEAR_HI || mark == DYD_MARKS + 1;
  if (mark == DYD_MIDDLE) return x->middle[2 * far + (size_t)axis];
  if (mark == DYD_WINDOW_LO || mark == DYD_WINDOW_HI)
    return o->bounded[2 * axis + high] ? dyd_irect_end(&x->rect[o->count + 1], axis, high) : NULL;
  return dyd_irect_end(&x->rect[mark < DYD_MARKS ? near : far], axis, high);
}

/* A mark that is bounded, in the caller's coordinates: cheaper than the whole scale, where two marks are all. */
static void mark_number(mpq_ptr out, dyd_outline *o, size_t far, size_t near, int axis, int mark) {
  bool window = mark == DYD_WINDOW_LO || mark == DYD_WINDOW_HI, of_near = mark == DYD_NEAR_LO || mark == DYD_NEAR_HI;
  bool high = mark == DYD_WINDOW_HI || mark == DYD_NEAR_HI || mark == DYD_MARKS + 1;
  if (window && !o->of_window[2 * axis + high]) {
    mpq_set_d(out, o->bound[2 * axis + high].lo);
    return;
  }
  DYD_LOCAL(dyd_rect, fetched);
  DYD_LOCAL_NUMBERS(mpq, other);
  const dyd_rect *r = window ? o->rect : dyd_outline_rect(o, &fetched, of_near ? near : far);
  dyd_interval_get_q(high ? other : out, high ? out : other, axis ? &r->y : &r->x);
  if (mark != DYD_MIDDLE) return;
  mpq_add(out, out, other);
  mpq_div_2exp(out, out, 1);
}

int dyd_outline_exact_marks(dyd_outline *o, size_t far, size_t near, int axis, int a, int b) {
  DYD_LOCAL_NUMBERS(mpq, p, q);
  for (int e = 0; e < 2; e++) { /* no bound */
    int window = e ? DYD_WINDOW_HI : DYD_WINDOW_LO, sign = e ? 1 : -1;
    if (!o->bounded[2 * axis + e] && (a == window || b == window)) return a == window ? sign : -sign;
  }
  mark_number(p, o, far, near, axis, a);
  mark_number(q, o, far, near, axis, b);
  return mpq_cmp(p, q);
}

static void arc_exactly(elementary *out, const dyd_outline *o, const dyd_outline_arc *a) {
  size_t far = o->outer ? a->curve : o->count, near = o->outer ? o->count : a->curve;
  const exact_cell *x = o->exact;
  out->parabola = a->shape.parabola;
  out->axis = a->axis;
  out->branch = a->branch;
  for (int k = 0; k < 2; k++) {
    bool fixed = a->feature < DYD_SIDE_X0 || k == (a->feature >= DYD_SIDE_Y0);
    int end = a->feature < DYD_SIDE_X0 ? a->feature >> k & 1 : a->feature & 1;
    out->s[k] = dyd_irect_end(&x->rect[far], k, a->corner >> k & 1);
    out->q[k] = fixed ? dyd_irect_end(&x->rect[near], k, end) : NULL;
    out->lo[k] = mark_of(o, far, near, k, a->mark[k][0]);
    out->hi[k] = mark_of(o, far, near, k, a->mark[k][1]);
  }
}

int dyd_outline_exact_axis(dyd_outline *o, const dyd_outline_arc *a) {
  DYD_LOCAL(elementary, e);
  if (!exact_of(o)) return 0;
  arc_exactly(&e, o, a);
  return elementary_axis(&e);
}

/* ---- points ---- */

/* A point of the cell that has the value of p, which is taken; NULL, and o->status: no memory. */
static const dyd_surd_point *keep_point(dyd_outline *o, dyd_surd_point *p) {
  enum { NUMBERS = 6, BLOCK = 16 };
  mpz_srcptr widest = mpz_size(p->ax) > mpz_size(p->ay) ? p->ax : p->ay;
  exact_cell *x = o->exact;
  x->bytes += sizeof(exact_point) + NUMBERS * (BLOCK + sizeof(mp_limb_t) * mpz_size(widest));
  bool room = !o->memory || dyd_memory_has(o->memory, x->bytes, "the boundary of a cell");
  exact_point *to = room ? malloc(sizeof *to) : NULL;
  if (!to) return o->status = DYD_E_NOMEM, NULL;
  to->at = *p;
  to->next = x->points;
  x->points = to;
  dyd_surd_point_init(p);
  return &to->at;
}

/* p->at from p->exact. */
static void spot_enclose(const dyd_outline *o, dyd_outline_spot *p) {
  const exact_cell *x = o->exact;
  const dyd_surd_point *s = p->exact;
  const dyd_icircle view = {.ax = {s->ax[0]},
                            .bx = {s->bx[0]},
                            .ay = {s->ay[0]},
                            .by = {s->by[0]},
                            .c = {s->c[0]},
                            .d = {s->d[0]}}; /* borrowed limbs */
  size_t man = mpz_sizeinbase(x->man, 2);
  double box[4];
  dyd_icircle_centre_d(box, &view, x->shift);
  const double unit[2] = {dyd_raw_get_d(x->man, -(int64_t)man, DYD_DOWN), dyd_raw_get_d(x->man, -(int64_t)man, DYD_UP)};
  dyd_outline_place_spot(p, o, box, unit, x->shift - x->exp - (int64_t)man);
}

/* Which ends of the window the coordinates of p->exact are. */
static void spot_set_sides(const dyd_outline *o, dyd_outline_spot *p) {
  for (int a = 0; a < 2; a++) {
    p->side[a] = -1;
    for (int e = 0; e < 2; e++) {
      if (!o->bounded[2 * a + e] || !o->of_window[2 * a + e]) continue;
      if (!dyd_surd_point_cmp_z(p->exact, a, dyd_irect_end(&o->exact->rect[o->count + 1], a, e))) p->side[a] = e;
    }
  }
}

bool dyd_outline_exact_clip(dyd_outline *o, dyd_outline_arc *a, uint32_t number) {
  DYD_LOCAL(elementary, e);
  if (!exact_of(o)) return false;
  arc_exactly(&e, o, a);
  if (!elementary_clip(&e, o->outer ? -1 : 1)) return false;
  a->point = e.point;
  for (int k = 0; k < 2; k++) {
    a->end[k] = (dyd_outline_spot){{DYD_IV_UNKNOWN, DYD_IV_UNKNOWN}, {-1, -1}, e.infinite[k], DYD_OUTLINE_END,
                                   2 * number + (uint32_t)k,         NULL};
    if (e.infinite[k]) continue;
    if (!(a->end[k].exact = keep_point(o, &e.end[k]))) return false;
    spot_set_sides(o, &a->end[k]);
    spot_enclose(o, &a->end[k]);
  }
  return true;
}

/* ---- meets ---- */

/* The circles of the curves of j and k. */
static void find_circles(dyd_outline *o, uint32_t j, uint32_t k) {
  exact_cell *x = o->exact;
  dyd_touch fixed = o->outer ? DYD_CLOSEST : DYD_FARTHEST, others = o->outer ? DYD_FARTHEST : DYD_CLOSEST;
  const dyd_touch touch[3] = {fixed, others, others};
  if (j > k) {
    uint32_t t = j;
    j = k;
    k = t;
  }
  if (x->pair[0] == j && x->pair[1] == k) return;
  const dyd_irect *r[3] = {&x->rect[o->count], &x->rect[j], &x->rect[k]};
  x->circles = dyd_icircles(x->circle, DYD_OUTLINE_CIRCLES, r, touch);
  DYD_INVARIANT(x->circles < DYD_OUTLINE_CIRCLES);
  x->pair[0] = j;
  x->pair[1] = k;
}

static void point_of_circle(dyd_surd_point *out, const dyd_icircle *k) {
  mpz_set(out->ax, k->ax);
  mpz_set(out->bx, k->bx);
  mpz_set(out->ay, k->ay);
  mpz_set(out->by, k->by);
  mpz_set(out->c, k->c);
  mpz_set(out->d, k->d);
}

/* The points that arcs a and b have in common, in order along a; returns how many. */
static size_t common_points(dyd_surd_point out[DYD_OUTLINE_CIRCLES], dyd_outline *o, uint32_t a, uint32_t b) {
  DYD_LOCAL(elementary, e, f);
  size_t count = 0;
  find_circles(o, o->arc[a].curve, o->arc[b].curve);
  arc_exactly(&e, o, &o->arc[a]);
  arc_exactly(&f, o, &o->arc[b]);
  for (size_t k = 0; k < o->exact->circles; k++) {
    dyd_surd_point *p = &out[count];
    point_of_circle(p, &o->exact->circle[k]);
    if (!elementary_holds(&e, p) || !elementary_holds(&f, p)) continue;
    for (size_t m = count++; m > 0 && dyd_surd_point_cmp(&out[m], &out[m - 1], e.axis) < 0; m--) {
      dyd_surd_point t = out[m];
      out[m] = out[m - 1];
      out[m - 1] = t;
    }
  }
  return count;
}

size_t dyd_outline_exact_meets(dyd_outline_spot out[DYD_OUTLINE_CIRCLES], dyd_outline *o, uint32_t a, uint32_t b) {
  uint32_t j = o->item[o->arc[a].curve].site, k = o->item[o->arc[b].curve].site;
  if ((o->pd && dyd_delaunay_status(o->pd, j, k) == DYD_ILLEGAL) || !exact_of(o)) return 0;
  DYD_LOCAL_ARRAY(dyd_surd_point, at, [DYD_OUTLINE_CIRCLES]);
  size_t count = common_points(at, o, a, b);
  for (size_t n = 0; n < count; n++) {
    out[n] = (dyd_outline_spot){.side = {-1, -1}, .kind = DYD_OUTLINE_MEET, .exact = keep_point(o, &at[n])};
    if (!out[n].exact) return 0;
    spot_enclose(o, &out[n]);
  }
  return count;
}

static void meet_exactly(dyd_outline *o, dyd_outline_meet *m) {
  DYD_LOCAL_ARRAY(dyd_surd_point, at, [DYD_OUTLINE_CIRCLES]);
  size_t count = common_points(at, o, m->arc[0], m->arc[1]);
  DYD_INVARIANT(count > 0 && count <= (size_t)m->roots);
  m->spot.exact = keep_point(o, &at[count > (size_t)m->root ? m->root : 0]);
}

/* ---- points on demand ---- */

static void corner_exactly(dyd_outline *o, dyd_outline_spot *p) {
  const dyd_irect *w = &o->exact->rect[o->count + 2];
  DYD_LOCAL(dyd_surd_point, at);
  mpz_set(at.ax, p->number == 1 || p->number == 2 ? w->x1 : w->x0);
  mpz_set(at.ay, p->number >= 2 ? w->y1 : w->y0);
  p->exact = keep_point(o, &at);
}

static void end_exactly(dyd_outline *o, dyd_outline_spot *p) {
  DYD_LOCAL(elementary, e);
  arc_exactly(&e, o, &o->arc[p->number / 2]);
  bool some = elementary_clip(&e, o->outer ? -1 : 1);
  DYD_INVARIANT(some);
  (void)some;
  p->exact = keep_point(o, &e.end[p->number & 1]);
}

const dyd_surd_point *dyd_outline_exact(dyd_outline *o, dyd_outline_spot *p) {
  if (p->exact || !exact_of(o)) return p->exact;
  switch (p->kind) {
  case DYD_OUTLINE_END:
    end_exactly(o, p);
    break;
  case DYD_OUTLINE_MEET:
    meet_exactly(o, &o->meet[p->number]);
    break;
  default:
    corner_exactly(o, p);
  }
  return p->exact;
}

int dyd_outline_exact_order(dyd_outline *o, dyd_outline_spot *p, dyd_outline_spot *q, int axis) {
  const dyd_surd_point *a = dyd_outline_exact(o, p), *b = dyd_outline_exact(o, q);
  return a && b ? dyd_surd_point_cmp(a, b, axis) : 0;
}

/* ---- samples and sides ---- */

int dyd_outline_exact_side(const dyd_outline *o, const dyd_surd_point *p, size_t k) {
  const exact_cell *x = o->exact;
  return dyd_surd_point_side(p, &x->rect[k], o->outer ? DYD_FARTHEST : DYD_CLOSEST, &x->rect[o->count],
                             o->outer ? DYD_CLOSEST : DYD_FARTHEST);
}

/* num / 2^bits strictly between two points (NULL: infinite), by enclosures of growing precision; some number when both
 * are infinite. */
static int64_t number_between(mpz_ptr num, const dyd_surd_point *low, const dyd_surd_point *high, int axis) {
  int64_t bits = 4;
  DYD_LOCAL_NUMBERS(mpz, up, down, t);
  for (;; bits *= 2) {
    if (low) dyd_surd_point_floor(t, up, low, axis, bits);
    if (high) dyd_surd_point_floor(down, t, high, axis, bits);
    if (!low && high) mpz_sub_ui(up, down, 2);
    if (!high) mpz_add_ui(down, up, 2);
    if (mpz_cmp(up, down) < 0) break;
  }
  mpz_add(num, up, down);
  return bits + 1;
}

/* Side of the window: bottom, right, top, left. The point of it with coordinate num / 2^bits. */
static void point_of_side(dyd_surd_point *out, const dyd_outline *o, int side, mpz_srcptr num, int64_t bits) {
  int axis = side & 1;
  mpz_ptr to[2] = {out->ax, out->ay};
  mpz_set(to[axis], num);
  mpz_mul_2exp(to[1 - axis], dyd_irect_end(&o->exact->rect[o->count + 2], 1 - axis, side == 1 || side == 2),
               (mp_bitcnt_t)bits);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits);
}

bool dyd_outline_exact_sample(dyd_outline_spot *out, dyd_outline *o, const dyd_outline_arc *a, int side,
                              dyd_outline_spot *low, dyd_outline_spot *high) {
  const dyd_surd_point *from = low->infinite ? NULL : dyd_outline_exact(o, low),
                       *to = high->infinite ? NULL : dyd_outline_exact(o, high);
  if (o->status != DYD_OK || !exact_of(o)) return false;
  DYD_LOCAL_NUMBERS(mpz, num);
  DYD_LOCAL(dyd_surd_point, at);
  DYD_LOCAL(elementary, e);
  int64_t bits = number_between(num, from, to, a ? a->axis : side & 1);
  if (a) {
    arc_exactly(&e, o, a);
    elementary_at(&at, &e, num, bits);
  } else {
    point_of_side(&at, o, side, num, bits);
  }
  *out = (dyd_outline_spot){.side = {-1, -1}, .exact = keep_point(o, &at)};
  if (out->exact) spot_enclose(o, out);
  return out->exact != NULL;
}

size_t dyd_outline_exact_third(dyd_outline *o, dyd_outline_spot *p, size_t curve, size_t other) {
  const dyd_surd_point *at = dyd_outline_exact(o, p);
  size_t k = 0;
  while (at && k < o->count && (k == curve || o->item[k].drop || dyd_outline_exact_side(o, at, k))) k++;
  DYD_INVARIANT(k < o->count);
  return k < o->count ? k : other;
}
