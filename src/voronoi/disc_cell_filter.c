/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The polygons of the cell of a disc, guessed in doubles, proved by signs of sums of two roots [DISC-7].
 *
 * With d = c_j - c_i, s = r_i + r_j, |d| > s, the ray c_i + t u, u a unit vector, leaves H_ij, and Int_i, when
 *   1 / t = (2 d.u + 2 s) / (|d|^2 - s^2),
 * and enters H_ji, the part where j is certainly nearer, and stays there, when
 *   1 / t = (2 d.u - 2 s) / (|d|^2 - s^2),
 * at infinity where this is not above 0. So Int_i and Pos_i are star-shaped about c_i, and their borders are envelopes:
 * the largest of a_j.u + b_j or a_j.u - b_j. A side of the window is the bisector with the image of c_i in it: s = 0.
 * The window W' has c_i and W inside; polygons are made on it and cut to W.
 *
 * Vertices are moved along their rays, inward or outward, and proved:
 *   inner: in H_ij for all partners j, hence in Int_i, which is convex, as the hull of all of them is [POLY-1];
 *   outer: both ends of each edge are in one H_ji, or beyond one side of W', which are convex, so the edge is in Ext_i
 *   or outside of W'; the edges turn left about c_i, once round: the polygon holds each segment from c_i to a point of
 *   Pos_i n W, since that lies in Pos_i n W' and meets no edge [POLY-2]. */
#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "rect/rect.h"
#include "tolerance/discs.h"
#include "tolerance/lines.h"
#include "voronoi/sample.h"
#include "voronoi/shape.h"

#include <math.h>

#define ROOM                                                                                                           \
  0x1p-48 /* as in src/tolerance/discs_filter.c: distances and sums of radii are within this of all sizes met */
#define LEAST 0x1p-900 /* no double that matters is less */
#define TURN 6.28318530717958647693
#define SAME 0x1p-40 /* angles so near are one */
enum { SIDES = 4, MARGIN = 2, FINER = 8, FIRST_TRIES = 3, TRIES = 8, COARSER = 4, DEEP = 24 };

/* A partner, or the image of the site in a side of W'. In direction u its borders are at 1 / t = a.u + b (certain) and
 * a.u - b (possible). */
typedef struct disc_rival {
  dyd_disc disc;
  mpq_t s;
  double a[2], b, x, y, sum; /* sum: s */
} disc_rival;

/* A corner of the border: its ray, 1 / t, and whose border begins there. */
typedef struct disc_corner {
  double angle, u[2], near;
  uint32_t rival;
} disc_corner;

/* Invariant: rival[0 .. partners) are sites, then come the sides of W', unless they are out of reach. own: the site;
 * side: 1: Int, -1: Pos. */
typedef struct disc_cell {
  const dyd_window *w;
  dyd_disc own;
  disc_rival *rival;
  uint32_t partners, count, made;
  bool no_filter;
  bool overlaps; /* some partner's disc meets the site's */
  double x, y, box[4];
  int side;
  int64_t bits, fine;
  disc_corner *corner;
  size_t corners, corner_cap;
  mpq_t at[2], s, t, from, to;
} disc_cell;

/* ---- the rivals ---- */

/* a and b of rival k, whose disc and s are set. false: it meets the site. */
static bool rival_finish(disc_cell *c, disc_rival *k) {
  mpq_ptr d[2] = {c->from, c->to};
  mpq_sub(d[0], k->disc.x, c->own.x);
  mpq_sub(d[1], k->disc.y, c->own.y);
  mpq_mul(c->s, d[0], d[0]);
  mpq_mul(c->t, d[1], d[1]);
  mpq_add(c->s, c->s, c->t);
  mpq_mul(c->t, k->s, k->s);
  mpq_sub(c->s, c->s, c->t); /* |d|^2 - s^2 */
  if (mpq_sgn(c->s) <= 0) return false;
  mpq_div_2exp(c->s, c->s, 1);
  for (int axis = 0; axis < 2; axis++) {
    mpq_div(d[axis], d[axis], c->s);
    k->a[axis] = mpq_get_d(d[axis]);
  }
  mpq_div(c->t, k->s, c->s);
  k->b = mpq_get_d(c->t);
  k->x = mpq_get_d(k->disc.x);
  k->y = mpq_get_d(k->disc.y);
  k->sum = mpq_get_d(k->s);
  return true;
}

static disc_rival *rival_next(disc_cell *c) {
  disc_rival *k = &c->rival[c->count];
  if (c->count == c->made) {
    dyd_disc_init(&k->disc);
    mpq_init(k->s);
    c->made++;
  }
  return k;
}

static dyd_status load_partners(disc_cell *c, const dyd_delaunay *pd, uint32_t i) {
  DYD_SCOPED(dyd_index_list) near = {0};
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  dyd_status st = dyd_disc_of_site(&c->own, sites, i);
  if (st == DYD_OK) st = dyd_delaunay_neighbours(&near, pd, i, dyd_least_bounding(pd));
  if (st == DYD_OK) c->rival = dyd_alloc(near.count + SIDES, sizeof *c->rival);
  if (st == DYD_OK && !c->rival) st = DYD_E_NOMEM;
  c->x = mpq_get_d(c->own.x);
  c->y = mpq_get_d(c->own.y);
  for (size_t k = 0; k < near.count && st == DYD_OK; k++) {
    disc_rival *r = rival_next(c);
    st = dyd_disc_of_site(&r->disc, sites, near.item[k]);
    mpq_add(r->s, r->disc.r, c->own.r);
    bool apart = rival_finish(c, r);
    c->count += apart;
    c->overlaps = c->overlaps || !apart;
  }
  c->partners = c->count;
  return st;
}

/* The sides of W': each beyond W and c_i by a sixteenth of the largest distance. */
static void load_sides(disc_cell *c) {
  double most = 0;
  for (int k = 0; k < SIDES; k++) {
    const dyd_interval *side = k < 2 ? &c->w->rect->x : &c->w->rect->y;
    dyd_dyadic_get_q(c->s, k & 1 ? &side->hi : &side->lo);
    mpq_sub(c->s, c->s, k < 2 ? c->own.x : c->own.y);
    c->box[k] = mpq_get_d(c->s);
    most = fmax(most, fabs(c->box[k]));
  }
  for (int k = 0; k < SIDES && most > LEAST && most < 1 / LEAST; k++) {
    double h = fmax(0, k & 1 ? c->box[k] : -c->box[k]) + most / 16;
    disc_rival *r = rival_next(c);
    mpq_set(r->disc.x, c->own.x);
    mpq_set(r->disc.y, c->own.y);
    mpq_set_ui(r->s, 0, 1);
    mpq_set_d(c->s, k & 1 ? 2 * h : -2 * h);
    mpq_ptr at = k < 2 ? r->disc.x : r->disc.y;
    mpq_add(at, at, c->s);
    c->count += rival_finish(c, r);
  }
}

/* ---- the border ---- */

static double rival_near(const disc_cell *c, uint32_t k, const double u[2]) {
  const disc_rival *r = &c->rival[k];
  return r->a[0] * u[0] + r->a[1] * u[1] + c->side * r->b;
}

static bool add_corner(disc_cell *c, double angle, uint32_t rival, double near) {
  if (!DYD_GROW(c->corner, c->corner_cap, c->corners + 1)) return false;
  c->corner[c->corners++] = (disc_corner){angle, {cos(angle), sin(angle)}, near, rival};
  return true;
}

/* How far rival k overtakes `now` after the angle; all round: never. */
static double overtakes(const disc_cell *c, uint32_t k, uint32_t now, double angle) {
  const disc_rival *r = &c->rival[k], *o = &c->rival[now];
  double x = r->a[0] - o->a[0], y = r->a[1] - o->a[1], rise = c->side * (r->b - o->b), size = hypot(x, y);
  if (!(size > fabs(rise))) return TURN;
  double turn = fmod(atan2(y, x) - acos(-rise / size) - angle, TURN);
  if (turn < 0) turn += TURN;
  return turn > TURN - SAME ? 0 : turn;
}

/* The breaks of the envelope, from the angle 0 on, once round; where a piece is long it is cut. false: memory. */
static bool find_breaks(disc_cell *c) {
  uint32_t now = 0;
  double angle = 0;
  const double east[2] = {1, 0};
  c->corners = 0;
  if (!c->count) return true;
  for (uint32_t k = 1; k < c->count; k++)
    if (rival_near(c, k, east) > rival_near(c, now, east)) now = k;
  if (!add_corner(c, 0, now, rival_near(c, now, east))) return false;
  for (size_t steps = 0; steps < 4 * (size_t)c->count + 2 * DEEP; steps++) {
    double least = fmin(TURN / 12, TURN - angle);
    uint32_t next = now;
    for (uint32_t k = 0; k < c->count; k++) {
      double turn = k == now ? TURN : overtakes(c, k, now, angle);
      if (turn < least) least = turn, next = k;
    }
    angle += least;
    if (angle > TURN - SAME) return true;
    const double u[2] = {cos(angle), sin(angle)};
    double near = fmax(rival_near(c, now, u), rival_near(c, next, u));
    now = next;
    if (least <= SAME)
      c->corner[c->corners - 1].rival = now;
    else if (!add_corner(c, angle, now, near))
      return false;
  }
  c->corners = 0; /* too near to each other for doubles */
  return true;
}

/* Is the triangle of the piece surely outside of W, so that its border does not matter? */
static bool piece_is_outside(const disc_cell *c, const disc_corner *p, const disc_corner *q) {
  double z[2][2] = {{p->u[0] / p->near, p->u[1] / p->near}, {q->u[0] / q->near, q->u[1] / q->near}};
  for (int k = 0; k < 2; k++) {
    double least = fmin(0, fmin(z[0][k], z[1][k])), most = fmax(0, fmax(z[0][k], z[1][k]));
    if (c->box[2 * k + 1] < least || most < c->box[2 * k]) return true;
  }
  return false;
}

/* Appends corners between p and q, on the border of p's rival, so that it is near to the chords: the height over the
 * chord is at most that on the ray in the middle times 1 / (2 share), share of the smaller part. */
static dyd_status divide(disc_cell *c, const disc_corner *p, const disc_corner *q, double enough, int depth) {
  double half = (q->angle - p->angle) / 2, angle = p->angle + half, u[2] = {cos(angle), sin(angle)};
  double near = rival_near(c, p->rival, u), straight = (p->near + q->near) / (2 * cos(half));
  double height = fabs(1 / near - 1 / straight) * (p->near + q->near) / (2 * fmin(p->near, q->near));
  if (!depth || c->rival[p->rival].b == 0 || !(near > LEAST && height > enough) || piece_is_outside(c, p, q))
    return DYD_OK;
  if (c->corners > (c->w->most ? c->w->most : DYD_MOST_SAMPLES)) return DYD_E_RANGE;
  const disc_corner m = {angle, {u[0], u[1]}, near, p->rival};
  dyd_status st = divide(c, p, &m, enough, depth - 1);
  if (st == DYD_OK && !add_corner(c, angle, p->rival, near)) st = DYD_E_NOMEM;
  return st == DYD_OK ? divide(c, &m, q, enough, depth - 1) : st;
}

/* The border, corner by corner; none where doubles do not tell. */
static dyd_status find_border(disc_cell *c) {
  if (!find_breaks(c)) return DYD_E_NOMEM;
  size_t breaks = c->corners;
  DYD_FREED disc_corner *b = dyd_alloc(breaks + 1, sizeof *b);
  dyd_status st = b ? DYD_OK : DYD_E_NOMEM;
  double enough = ldexp(1, (int)fmax(-1000, fmin(1000, -(double)c->bits - 3)));
  for (size_t k = 0; b && k < breaks; k++) b[k] = c->corner[k];
  c->corners = 0;
  for (size_t k = 0; k < breaks && st == DYD_OK; k++) {
    disc_corner next = b[(k + 1) % breaks];
    if (k + 1 == breaks) next.angle += TURN;
    if (!(b[k].near > LEAST && b[k].near < 1 / LEAST)) return c->corners = 0, DYD_OK;
    st = add_corner(c, b[k].angle, b[k].rival, b[k].near) ? divide(c, &b[k], &next, enough, DEEP) : DYD_E_NOMEM;
    if (dyd_flag_is_set(c->w->cancel)) st = DYD_CANCELLED;
  }
  return st;
}

/* ---- proofs ---- */

/* out = |z - d|^2. */
static void square_between(mpq_ptr out, disc_cell *c, const dyd_disc *d) {
  mpq_sub(out, c->at[0], d->x);
  mpq_sub(c->s, c->at[1], d->y);
  mpq_mul(out, out, out);
  mpq_mul(c->s, c->s, c->s);
  mpq_add(out, out, c->s);
}

/* Is z, which is c->at, in H of the site against rival k (inner), or of the rival against the site? */
static bool disc_is_beyond(disc_cell *c, const double z[2], uint32_t k) {
  const disc_rival *r = &c->rival[k];
  double d = c->side * (hypot(z[0] - r->x, z[1] - r->y) - hypot(z[0] - c->x, z[1] - c->y)) - r->sum;
  double size = fabs(z[0]) + fabs(z[1]) + fabs(r->x) + fabs(r->y) + fabs(c->x) + fabs(c->y) + r->sum;
  double off = ROOM * size + LEAST;
  if (!c->no_filter && (d > off || d < -off)) return d > 0;
  square_between(c->from, c, &r->disc);
  square_between(c->to, c, &c->own);
  mpq_neg(c->s, r->s);
  return dyd_roots_sign(c->s, c->side > 0 ? c->from : c->to, c->side > 0 ? c->to : c->from) > 0;
}

static void take_point(double about[2], disc_cell *c, const dyd_point *z) {
  dyd_dyadic_get_q(c->at[0], &z->x);
  dyd_dyadic_get_q(c->at[1], &z->y);
  for (int k = 0; k < 2; k++) about[k] = mpq_get_d(c->at[k]);
}

static bool is_inner(disc_cell *c, const dyd_point *z) {
  double about[2];
  take_point(about, c, z);
  for (uint32_t k = 0; k < c->partners; k++)
    if (!disc_is_beyond(c, about, k)) return false;
  return true;
}

/* *z becomes corner k, moved by `margin`, but by no more than an eighth of its distance. */
static dyd_status place_corner(dyd_point *z, disc_cell *c, size_t k, double margin) {
  const disc_corner *p = &c->corner[k];
  double t = 1 / p->near, move = fmin(margin, t / 8);
  dyd_status st = DYD_OK;
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    double d = (t - c->side * move) * p->u[axis];
    mpq_set_d(c->s, d);
    mpq_add(c->s, c->s, axis ? c->own.y : c->own.x);
    st = dyd_dyadic_round_q(axis ? &z->y : &z->x, c->s, -c->fine, DYD_DOWN);
  }
  return st;
}

/* Does the way from p to q turn left about c_i? *up: does it come from below the ray to the east? */
static bool turns_left(bool *up, disc_cell *c, const dyd_point *p, const dyd_point *q) {
  mpq_t d[2][2];
  for (int k = 0; k < 4; k++) {
    mpq_ptr v = d[k >> 1][k & 1];
    mpq_init(v);
    dyd_dyadic_get_q(v, k & 1 ? &(k > 1 ? q : p)->y : &(k > 1 ? q : p)->x);
    mpq_sub(v, v, k & 1 ? c->own.y : c->own.x);
  }
  *up = mpq_sgn(d[0][1]) < 0 && mpq_sgn(d[1][1]) >= 0;
  mpq_mul(c->s, d[0][0], d[1][1]);
  mpq_mul(c->t, d[0][1], d[1][0]);
  bool left = mpq_cmp(c->s, c->t) > 0;
  for (int k = 0; k < 4; k++) mpq_clear(d[k >> 1][k & 1]);
  return left;
}

/* Are the corners in what their edges have to be in, once round? */
static bool is_outline(disc_cell *c, const dyd_polygon *p) {
  int rounds = 0;
  for (size_t k = 0; k < p->count; k++) {
    size_t last = (k ? k : p->count) - 1;
    bool up;
    double about[2];
    take_point(about, c, &p->vertex[k]);
    if (!disc_is_beyond(c, about, c->corner[k].rival) || !disc_is_beyond(c, about, c->corner[last].rival)) return false;
    if (!turns_left(&up, c, &p->vertex[last], &p->vertex[k])) return false;
    rounds += up;
  }
  return rounds == 1 && p->count > 2;
}

/* The corners, moved by `margin`; *out is empty before. */
static dyd_status place_corners(dyd_polygon *out, disc_cell *c, double margin) {
  dyd_status st = DYD_OK;
  out->vertex = dyd_alloc(c->corners + 1, sizeof *out->vertex);
  if (!out->vertex) return DYD_E_NOMEM;
  for (; out->count < c->corners && st == DYD_OK; out->count++) {
    dyd_point_init(&out->vertex[out->count]);
    st = place_corner(&out->vertex[out->count], c, out->count, margin);
  }
  return st;
}

/* ---- the polygons ---- */

/* Steps of rounding: finer than the margin, and than the corner nearest to c_i. */
static void choose_fineness(disc_cell *c) {
  int exp = 0;
  double most = 0;
  for (size_t k = 0; k < c->corners; k++) most = fmax(most, c->corner[k].near);
  if (most > 0 && isfinite(most)) (void)frexp(most, &exp);
  c->fine = (exp > c->bits ? exp : c->bits) + FINER;
}

/* Crossings of two sides of W are rounded along one of them, to beyond the other: these become corners of W. */
static void hold_in_window(dyd_polygon_list *l, const dyd_rect *w) {
  for (size_t p = 0; p < l->count; p++)
    for (size_t k = 0; k < 2 * l->item[p].count; k++) {
      dyd_point *z = &l->item[p].vertex[k / 2];
      dyd_dyadic *at = k & 1 ? &z->y : &z->x;
      const dyd_interval *side = k & 1 ? &w->y : &w->x;
      if (dyd_dyadic_cmp(at, &side->lo) < 0) dyd_dyadic_set(at, &side->lo);
      if (dyd_dyadic_cmp(at, &side->hi) > 0) dyd_dyadic_set(at, &side->hi);
    }
}

/* Cuts a polygon inside Int_i to W; *good: the result is proved to be inside Int_i, too. */
static dyd_status cut_inner(bool *good, dyd_polygon *p, disc_cell *c) {
  DYD_SCOPED(dyd_polygon_list) l = {1, p};
  dyd_polygon one = *p;
  *p = (dyd_polygon){0};
  l.item = dyd_alloc(1, sizeof *l.item);
  if (!l.item) return dyd_polygon_clear(&one), DYD_E_NOMEM;
  l.item[0] = one;
  dyd_status st = dyd_polygons_clip(good, &l, c->w->rect, c->fine + FINER, c->w->cancel);
  *good = *good && l.count < 2;
  hold_in_window(&l, c->w->rect);
  for (size_t k = 0; st == DYD_OK && l.count && *good && k < l.item[0].count; k++)
    *good = dyd_rect_holds(c->w->rect, &l.item[0].vertex[k]) && is_inner(c, &l.item[0].vertex[k]);
  if (st == DYD_OK && *good && l.count) {
    *p = l.item[0];
    l.item[0] = (dyd_polygon){0};
  }
  return st == DYD_OK && *good && p->count ? dyd_polygon_make_convex(p) : st;
}

static dyd_status try_inner(bool *good, dyd_polygon *out, disc_cell *c, double margin) {
  dyd_status st = place_corners(out, c, margin);
  *good = st == DYD_OK;
  for (size_t k = 0; k < out->count && *good; k++) *good = is_inner(c, &out->vertex[k]);
  if (*good) st = dyd_polygon_make_convex(out);
  return st == DYD_OK && *good ? cut_inner(good, out, c) : st;
}

static dyd_status try_outer(bool *good, dyd_polygon_list *out, disc_cell *c, double margin) {
  out->item = calloc(1, sizeof *out->item);
  if (!out->item) return DYD_E_NOMEM;
  out->count = 1;
  dyd_status st = place_corners(&out->item[0], c, margin);
  *good = st == DYD_OK && is_outline(c, &out->item[0]);
  if (*good) st = dyd_polygons_clip(good, out, c->w->rect, c->fine, c->w->cancel);
  hold_in_window(out, c->w->rect);
  return st;
}

/* Makes and proves the polygons of one kind: with finer rounding where rays are nearly along the border, then with
 * larger margins where doubles are too coarse. *good = false: no proof was found. */
static dyd_status make_polygons(bool *good, dyd_shape *s, disc_cell *c, bool outer) {
  double margin = ldexp(1, (int)fmax(-1000, fmin(1000, -(double)c->bits - MARGIN)));
  c->side = outer ? -1 : 1;
  *good = false;
  dyd_status st = find_border(c);
  choose_fineness(c);
  for (int k = 0; k < TRIES && st == DYD_OK && c->corners && !*good; k++, c->fine += FINER) {
    if (k >= FIRST_TRIES) margin = ldexp(margin, COARSER);
    if (outer)
      dyd_polygon_list_clear(&s->outer_exact);
    else
      dyd_polygon_clear(&s->inner_exact);
    st = outer ? try_outer(good, &s->outer_exact, c, margin) : try_inner(good, &s->inner_exact, c, margin);
  }
  return st;
}

static void disc_cell_clear(disc_cell *c) {
  for (uint32_t k = 0; k < c->made; k++) {
    dyd_disc_clear(&c->rival[k].disc);
    mpq_clear(c->rival[k].s);
  }
  dyd_free_all(c->rival, c->corner);
  dyd_disc_clear(&c->own);
  mpq_clears(c->at[0], c->at[1], c->s, c->t, c->from, c->to, NULL);
}

dyd_status dyd_disc_shape(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w,
                          int64_t bits) {
  DYD_SCOPED(disc_cell) c = {.w = w, .bits = bits, .no_filter = pd->sk.mesh.no_filter};
  bool certain = false;
  *done = false;
  dyd_disc_init(&c.own);
  mpq_inits(c.at[0], c.at[1], c.s, c.t, c.from, c.to, NULL);
  dyd_status st = load_partners(&c, pd, i);
  if (st == DYD_OK) {
    load_sides(&c);
    st = make_polygons(done, s, &c, true);
  }
  if (!*done) dyd_polygon_list_clear(&s->outer_exact);
  if (st == DYD_OK && *done && !c.overlaps) st = make_polygons(&certain, s, &c, false);
  if (!certain) dyd_polygon_clear(&s->inner_exact);
  return st;
}
