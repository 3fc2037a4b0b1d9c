/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The polygons of a cell: in doubles, else in dyadics. */
#include "voronoi/shape.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "delaunay/ties.h"
#include "dyadic/raw.h"
#include "voronoi/outline_sites_filter.h"

#include <math.h>
#include <mpfr.h>
#include <stdlib.h>

/* ---- cells of exact points in rationals: the grid ---- */

/* Multiples of 2^-grid in W have at most GRID_BITS bits, or MOST_BITS where its shorter side has less than
 * 2^DYD_GRID_FINE of them else. */
enum { GRID_BITS = 40, MOST_BITS = 50 };

void dyd_window_set_grid(dyd_window *w, int fine) {
  const dyd_interval *side[2] = {&w->rect->x, &w->rect->y};
  double most = 0, least = INFINITY;
  int exp;
  w->exact = true;
  for (int k = 0; k < 4; k++) {
    const dyd_interval *s = side[k >> 1];
    if (dyd_dyadic_get_d(k & 1 ? &s->hi : &s->lo, k & 1 ? DYD_UP : DYD_DOWN) != w->d[k]) w->exact = false;
    most = fmax(most, fabs(w->d[k]));
    if (k & 1) least = fmin(least, w->d[k] - w->d[k - 1]);
  }
  (void)frexp(most, &exp);
  w->grid = GRID_BITS - exp;
  while (w->grid < MOST_BITS - exp && ldexp(least, w->grid) < ldexp(1, DYD_GRID_FINE)) w->grid++;
  w->exact = w->exact && abs(w->grid) < 900 && ldexp(least, w->grid) >= ldexp(1, fine);
}

/* floor(x 2^grid / d + 1/2), d > 0; DYD_E_RANGE where that is beyond 2^62. */
static dyd_status grid_round(int64_t *out, const mpz_t x, const mpz_t d, int grid) {
  DYD_LOCAL_NUMBERS(mpz, n, m);
  mpz_mul_2exp(n, x, (mp_bitcnt_t)(grid > -1 ? grid + 1 : 0));
  mpz_mul_2exp(m, d, (mp_bitcnt_t)(grid > -1 ? 0 : -grid - 1));
  mpz_add(n, n, m);
  mpz_mul_2exp(m, m, 1);
  mpz_fdiv_q(n, n, m);
  bool fits = mpz_sizeinbase(n, 2) <= 62;
  if (fits) *out = mpz_get_si(n);
  return fits ? DYD_OK : DYD_E_RANGE;
}

/* ---- lines ---- */

/* The half-plane a x + b y <= c, or the line that bounds it. Coordinates are integers: those of the caller times one
 * `scale` for all that meet. */
typedef struct scaled_half_plane {
  mpz_t a, b, c;
} scaled_half_plane;

/* (x / d, y / d), d > 0; the edge from here on is on the line of half-plane `edge`. */
typedef struct corner {
  mpz_t x, y, d;
  uint32_t edge;
} corner;

/* Exact points as integers times 1 / scale. */
typedef struct scaled_points {
  mpq_t (*at)[2];
  size_t count;
  mpz_t scale, t;
} scaled_points;

static void scaled_clear(scaled_points *p) {
  for (size_t k = 0; k < p->count; k++) mpq_clears(p->at[k][0], p->at[k][1], NULL);
  free(p->at);
  mpz_clears(p->scale, p->t, NULL);
}

static dyd_status scaled_init(scaled_points *p, size_t room) {
  p->count = 0;
  mpz_inits(p->scale, p->t, NULL);
  mpz_set_ui(p->scale, 1);
  p->at = dyd_alloc(room, sizeof *p->at);
  return p->at ? DYD_OK : DYD_E_NOMEM;
}

/* Appends the lower or the upper ends of r. */
static void scaled_add(scaled_points *p, const dyd_rect *r, bool upper) {
  mpq_t *at = p->at[p->count++];
  DYD_LOCAL_NUMBERS(mpq, other);
  mpq_inits(at[0], at[1], NULL);
  for (int a = 0; a < 2; a++) {
    dyd_interval_get_q(upper ? other : at[a], upper ? at[a] : other, a ? &r->y : &r->x);
    mpz_lcm(p->scale, p->scale, mpq_denref(at[a]));
  }
}

static dyd_status scaled_add_vertex(scaled_points *p, dyd_rect *r, const dyd_delaunay *pd, uint32_t v) {
  dyd_status st = dyd_sites_get(r, pd->sk.rects.sites, pd->sk.reps.site[v]);
  if (st == DYD_OK) scaled_add(p, r, false);
  return st;
}

/* Now the numerators are the integers. */
static void scaled_finish(scaled_points *p) {
  for (size_t k = 0; k < p->count; k++)
    for (int a = 0; a < 2; a++) {
      mpz_divexact(p->t, p->scale, mpq_denref(p->at[k][a]));
      mpz_mul(mpq_numref(p->at[k][a]), mpq_numref(p->at[k][a]), p->t);
    }
}

static mpz_srcptr scaled_at(const scaled_points *p, size_t k, int axis) {
  return mpq_numref(p->at[k][axis]);
}

/* The points nearer to point p than to point q: 2 (q - p).z <= |q|^2 - |p|^2. */
static void half_plane_between(scaled_half_plane *h, scaled_points *s, size_t p, size_t q) {
  mpz_sub(h->a, scaled_at(s, q, 0), scaled_at(s, p, 0));
  mpz_sub(h->b, scaled_at(s, q, 1), scaled_at(s, p, 1));
  mpz_add(s->t, scaled_at(s, q, 0), scaled_at(s, p, 0));
  mpz_mul(h->c, s->t, h->a);
  mpz_add(s->t, scaled_at(s, q, 1), scaled_at(s, p, 1));
  mpz_addmul(h->c, s->t, h->b);
  mpz_mul_2exp(h->a, h->a, 1);
  mpz_mul_2exp(h->b, h->b, 1);
}

/* Where the lines of g and h cross: not parallel. */
static void lines_cross(corner *z, const scaled_half_plane *g, const scaled_half_plane *h) {
  mpz_mul(z->d, g->a, h->b);
  mpz_submul(z->d, g->b, h->a);
  mpz_mul(z->x, g->c, h->b);
  mpz_submul(z->x, g->b, h->c);
  mpz_mul(z->y, g->a, h->c);
  mpz_submul(z->y, g->c, h->a);
  if (mpz_sgn(z->d) > 0) return;
  mpz_neg(z->d, z->d);
  mpz_neg(z->x, z->x);
  mpz_neg(z->y, z->y);
}

static dyd_status centre_on_grid(int64_t n[2], const dyd_delaunay *pd, uint32_t t, const dyd_window *w) {
  scaled_points p;
  scaled_half_plane h[2];
  corner z;
  dyd_status st = scaled_init(&p, 3);
  DYD_LOCAL(dyd_rect, r);
  mpz_inits(z.x, z.y, z.d, h[0].a, h[0].b, h[0].c, h[1].a, h[1].b, h[1].c, NULL);
  for (int k = 0; k < 3 && st == DYD_OK; k++) st = scaled_add_vertex(&p, &r, pd, pd->sk.mesh.tri[t].v[k]);
  if (st == DYD_OK) {
    scaled_finish(&p);
    for (size_t k = 0; k < 2; k++) half_plane_between(&h[k], &p, 0, k + 1);
    lines_cross(&z, &h[0], &h[1]);
    mpz_mul(z.d, z.d, p.scale);
    st = grid_round(&n[0], z.x, z.d, w->grid);
  }
  if (st == DYD_OK) st = grid_round(&n[1], z.y, z.d, w->grid);
  mpz_clears(z.x, z.y, z.d, h[0].a, h[0].b, h[0].c, h[1].a, h[1].b, h[1].c, NULL);
  scaled_clear(&p);
  return st;
}

/* ---- partners ---- */

static bool star_add(dyd_shape *s, uint32_t n, uint32_t v) {
  if (!DYD_GROW(s->fan, s->fan_cap, n + 1)) return false;
  if (!DYD_GROW(s->key, s->key_cap, n + 1)) return false;
  if (!DYD_GROW(s->fan_box, s->box_cap, n + 1)) return false;
  s->fan[n] = v;
  s->key[n] = DYD_NONE;
  return true;
}

/* The triangle that names the vertex of t; DYD_NONE: there is none, t or its chain being beyond the hull. *known =
 * false: the face is undecided. */
static uint32_t star_key(bool *known, const dyd_delaunay *pd, uint32_t t) {
  uint32_t f = dyd_face_of(pd, t);
  if (f != DYD_NONE) {
    const dyd_face *face = pd->open.kind == DYD_LISTED ? &pd->open.face[f] : NULL;
    *known = *known && (!face || (face->polygon && face->tie && !face->proved && !face->capped));
    t = face ? pd->open.tri[face->first_tri] : dyd_tie_seed(pd, f);
  } else {
    *known = *known && dyd_triangle_is_certain(&pd->sk, t);
  }
  return dyd_is_ghost_triangle(&pd->sk.mesh, t) ? DYD_NONE : t;
}

static dyd_status star_of_mesh(bool *known, uint32_t *degree, dyd_shape *s, const dyd_delaunay *pd, uint32_t v) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = pd->sk.leaving[v], h = first;
  uint32_t n = 0;
  if (first == DYD_NONE) return *known = false, DYD_OK;
  do {
    uint32_t w = dyd_edge_target(m, h), key = star_key(known, pd, dyd_edge_triangle(h));
    bool partner = w != m->n && dyd_edge_is_certain(&pd->sk, h);
    if (!*known) return DYD_OK;
    if (partner) {
      *known = dyd_vertex_is_point(&pd->sk, w);
      if (!star_add(s, n, w)) return DYD_E_NOMEM;
      s->key[n++] = key;
    }
    h = dyd_edge_turn(m, h);
  } while (h != first && *known);
  *degree = n;
  return DYD_OK;
}

/* Fills s->fan with the legal partners of vertex v, counter-clockwise, and s->key[k] with a triangle whose
 * circumcentre is the vertex between partners k and k + 1, the same one for all cells of a tie; DYD_NONE: the cell is
 * unbounded there. *known = false unless v and all partners are exact points and nothing around v is undecided but
 * ties. */
static dyd_status point_star(bool *known, uint32_t *degree, dyd_shape *s, const dyd_delaunay *pd, uint32_t v) {
  const dyd_line *l = &pd->sk.line;
  *degree = 0;
  *known = dyd_vertex_is_point(&pd->sk, v);
  if (!*known || pd->open.kind != DYD_LINE) return *known ? star_of_mesh(known, degree, s, pd, v) : DYD_OK;
  *known = pd->sk.all_points;
  for (int k = -1; *known && k < 2; k += 2) {
    uint32_t q = l->rank[v] + (uint32_t)k;
    if (q >= l->count) continue;
    if (!star_add(s, *degree, l->order[q])) return DYD_E_NOMEM;
    ++*degree;
  }
  return DYD_OK;
}

/* ---- clipping ---- */

/* Half-planes 0 to 3 are those of W (bottom, right, top, left), then those of the partners. Points: the site, its
 * partners, the lower left and the upper right corner of W. Invariant: corners now[0 .. count - 1] of a convex polygon,
 * counter-clockwise; there is room for one more than there are half-planes. */
typedef struct clipping {
  scaled_points point;
  scaled_half_plane *plane;
  corner *now, *next;
  size_t count, room;
  int *sign;
  mpz_t t;
} clipping;

static void clipping_clear(clipping *c) {
  for (size_t k = 0; k < c->room; k++) {
    mpz_clears(c->now[k].x, c->now[k].y, c->now[k].d, c->next[k].x, c->next[k].y, c->next[k].d, NULL);
    mpz_clears(c->plane[k].a, c->plane[k].b, c->plane[k].c, NULL);
  }
  dyd_free_all(c->now, c->next, c->plane, c->sign);
  mpz_clear(c->t);
  scaled_clear(&c->point);
}

static dyd_status clipping_init(clipping *c, size_t partners) {
  size_t room = partners + 5;
  *c = (clipping){.count = 4};
  mpz_init(c->t);
  dyd_status st = scaled_init(&c->point, partners + 3);
  c->now = dyd_alloc(room, sizeof *c->now);
  c->next = dyd_alloc(room, sizeof *c->next);
  c->plane = dyd_alloc(room, sizeof *c->plane);
  c->sign = dyd_alloc(room, sizeof *c->sign);
  if (st != DYD_OK || !c->now || !c->next || !c->plane || !c->sign) return DYD_E_NOMEM;
  for (; c->room < room; c->room++) {
    mpz_inits(c->now[c->room].x, c->now[c->room].y, c->now[c->room].d, NULL);
    mpz_inits(c->next[c->room].x, c->next[c->room].y, c->next[c->room].d, NULL);
    mpz_inits(c->plane[c->room].a, c->plane[c->room].b, c->plane[c->room].c, NULL);
  }
  return DYD_OK;
}

static mpz_srcptr window_end(const clipping *c, int axis, bool upper) {
  return scaled_at(&c->point, c->point.count - (upper ? 1 : 2), axis);
}

/* The polygon becomes W. */
static void clip_begin(clipping *c) {
  for (uint32_t k = 0; k < 4; k++) {
    bool upper = k == 1 || k == 2;
    mpz_set_si(k & 1 ? c->plane[k].a : c->plane[k].b, upper ? 1 : -1);
    mpz_mul_si(c->plane[k].c, window_end(c, !(k & 1), upper), upper ? 1 : -1);
    mpz_set(c->now[k].x, window_end(c, 0, upper));
    mpz_set(c->now[k].y, window_end(c, 1, k >= 2));
    mpz_set_ui(c->now[k].d, 1);
    c->now[k].edge = k;
  }
}

static int clip_side(clipping *c, const scaled_half_plane *h, const corner *z) {
  mpz_mul(c->t, h->a, z->x);
  mpz_addmul(c->t, h->b, z->y);
  mpz_submul(c->t, h->c, z->d);
  return mpz_sgn(c->t);
}

static void corner_copy(corner *out, const corner *z) {
  mpz_set(out->x, z->x);
  mpz_set(out->y, z->y);
  mpz_set(out->d, z->d);
  out->edge = z->edge;
}

/* Cuts the polygon to the half-plane; with less than three corners it has no area, and is empty. */
static void clip_by(clipping *c, uint32_t plane) {
  size_t kept = 0;
  bool out = false;
  for (size_t k = 0; k < c->count; k++) {
    c->sign[k] = clip_side(c, &c->plane[plane], &c->now[k]);
    out = out || c->sign[k] > 0;
  }
  if (!out) return;
  for (size_t k = 0; k < c->count; k++) {
    int at = c->sign[k], next = c->sign[k + 1 == c->count ? 0 : k + 1];
    const corner *z = &c->now[k];
    if (at <= 0) corner_copy(&c->next[kept++], z);
    if (at == 0 && next > 0) c->next[kept - 1].edge = plane;
    if (at * next >= 0) continue;
    c->next[kept].edge = at < 0 ? plane : z->edge;
    lines_cross(&c->next[kept++], &c->plane[z->edge], &c->plane[plane]);
  }
  corner *was = c->now;
  c->now = c->next;
  c->next = was;
  c->count = kept < 3 ? 0 : kept;
}

/* Twice the area, of the caller's coordinates. */
static void clip_area2(mpq_t sum, const clipping *c) {
  DYD_LOCAL_NUMBERS(mpq, term);
  for (size_t k = 0; k < c->count; k++) {
    const corner *p = &c->now[k], *q = &c->now[(k + 1) % c->count];
    mpz_mul(mpq_numref(term), p->x, q->y);
    mpz_submul(mpq_numref(term), p->y, q->x);
    mpz_mul(mpq_denref(term), p->d, q->d);
    mpq_canonicalize(term);
    mpq_add(sum, sum, term);
  }
  mpq_set_z(term, c->point.scale);
  mpq_div(sum, sum, term);
  mpq_div(sum, sum, term);
}

static double area_rounded(const mpq_t twice, mpfr_rnd_t rnd) {
  DYD_LOCAL_FLOATS(53, x);
  mpfr_set_q(x, twice, rnd);
  mpfr_div_2ui(x, x, 1, rnd);
  return mpfr_get_d(x, rnd);
}

/* A coordinate of a corner as it is written: on a side of W its end, else a multiple of 2^-grid that is not beyond W.
 */
static dyd_status corner_coordinate(double *out, clipping *c, const corner *z, int axis, const dyd_window *w) {
  mpz_srcptr at = axis ? z->y : z->x;
  const double *d = &w->d[2 * axis];
  int64_t n;
  for (int k = 0; k < 2; k++) {
    mpz_mul(c->t, window_end(c, axis, k), z->d);
    if (mpz_cmp(c->t, at) == 0) return *out = d[k], DYD_OK;
  }
  mpz_mul(c->t, z->d, c->point.scale);
  dyd_status st = grid_round(&n, at, c->t, w->grid);
  if (st == DYD_OK) *out = fmin(fmax(ldexp((double)n, -w->grid), d[0]), d[1]);
  return st;
}

static dyd_status clip_deliver(dyd_shape *s, clipping *c, const dyd_window *w) {
  dyd_status st = DYD_OK;
  if (!DYD_GROW(s->inner, s->inner_cap, c->count + 1)) return DYD_E_NOMEM;
  s->inner_count = (uint32_t)c->count;
  for (size_t k = 0; k < c->count && st == DYD_OK; k++) {
    st = corner_coordinate(&s->inner[k].x, c, &c->now[k], 0, w);
    if (st == DYD_OK) st = corner_coordinate(&s->inner[k].y, c, &c->now[k], 1, w);
  }
  DYD_LOCAL_NUMBERS(mpq, area2);
  clip_area2(area2, c);
  s->area[0] = area_rounded(area2, MPFR_RNDD);
  s->area[1] = area_rounded(area2, MPFR_RNDU);
  return st;
}

/* *c, initialised, becomes the cell of v with the partners given, on W. */
static dyd_status clip_all(clipping *c, const dyd_delaunay *pd, uint32_t v, const uint32_t *partner, uint32_t degree,
                           const dyd_window *w) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = scaled_add_vertex(&c->point, &r, pd, v);
  for (uint32_t k = 0; k < degree && st == DYD_OK; k++) st = scaled_add_vertex(&c->point, &r, pd, partner[k]);
  if (st == DYD_OK) {
    scaled_add(&c->point, w->rect, false);
    scaled_add(&c->point, w->rect, true);
    scaled_finish(&c->point);
    clip_begin(c);
  }
  for (uint32_t k = 0; k < degree && c->count && st == DYD_OK; k++) {
    half_plane_between(&c->plane[k + 4], &c->point, 0, k + 1);
    clip_by(c, k + 4);
    if (dyd_flag_is_set(w->cancel)) st = DYD_CANCELLED;
  }
  return st;
}

static dyd_status clip_cell(dyd_shape *s, const dyd_delaunay *pd, uint32_t v, uint32_t degree, const dyd_window *w) {
  DYD_SCOPED(clipping) c;
  dyd_status st = clipping_init(&c, degree);
  if (st == DYD_OK) st = clip_all(&c, pd, v, s->fan, degree, w);
  return st == DYD_OK ? clip_deliver(s, &c, w) : st;
}

/* ---- the cell of a point ---- */

dyd_status dyd_shape_centre(dyd_xy *z, const dyd_delaunay *pd, uint32_t t, const dyd_window *w) {
  int64_t n[2];
  dyd_status st = centre_on_grid(n, pd, t, w);
  if (st != DYD_OK) return st;
  *z = (dyd_xy){fmin(fmax(ldexp((double)n[0], -w->grid), w->d[0]), w->d[1]),
                fmin(fmax(ldexp((double)n[1], -w->grid), w->d[2]), w->d[3])};
  return DYD_OK;
}

/* Rounds the vertices of a cell inside of W that doubles leave in doubt; those near a side may round to beyond it. */
static dyd_status settle_vertices(dyd_shape *s, const dyd_delaunay *pd, const dyd_window *w) {
  dyd_status st = DYD_OK;
  for (uint32_t k = 0; k < s->inner_count && st == DYD_OK; k++) {
    dyd_xy *z = &s->inner[k];
    if (isnan(z->x)) st = dyd_shape_centre(z, pd, s->key[k], w);
    *z = (dyd_xy){fmin(fmax(z->x, w->d[0]), w->d[1]), fmin(fmax(z->y, w->d[2]), w->d[3])};
  }
  return st;
}

static void drop_repeated(dyd_shape *s) {
  uint32_t kept = 0, n = s->inner_count;
  for (uint32_t k = 0; k < n; k++) {
    const dyd_xy *z = &s->inner[k], *last = &s->inner[kept ? kept - 1 : n - 1];
    if (z->x != last->x || z->y != last->y) s->inner[kept++] = *z;
  }
  s->inner_count = kept < 3 ? 0 : kept;
}

dyd_status dyd_shape_edges(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w) {
  uint32_t degree, v = pd->sk.vertex[i], kept = 0;
  bool known;
  dyd_status st = point_star(&known, &degree, s, pd, v);
  if (st != DYD_OK || !known || !w->exact) return st == DYD_OK ? DYD_E_RANGE : st;
  DYD_SCOPED(clipping) c;
  st = clipping_init(&c, degree);
  if (st == DYD_OK) st = clip_all(&c, pd, v, s->fan, degree, w);
  if (st == DYD_OK) st = clip_deliver(s, &c, w);
  size_t room = st == DYD_OK ? c.count : 0;
  if (!DYD_GROW(s->across, s->across_cap, room + 1)) st = DYD_E_NOMEM;
  for (size_t k = 0; k < room && st == DYD_OK; k++) {
    const dyd_xy *z = &s->inner[k], *next = &s->inner[k + 1 == room ? 0 : k + 1];
    if (z->x == next->x && z->y == next->y) continue;
    uint32_t edge = c.now[k].edge;
    s->across[kept] = edge < 4 ? DYD_NONE : pd->sk.reps.site[s->fan[edge - 4]];
    s->inner[kept++] = *z;
  }
  s->inner_count = kept;
  return st;
}

/* Makes the shape of site i on W, where the points concerned are exact; else *done = false. */
static dyd_status dyd_point_cell(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w) {
  uint32_t v = pd->sk.vertex[i], degree;
  bool known;
  *done = false;
  if (!w->exact) return DYD_OK;
  dyd_status st = point_star(&known, &degree, s, pd, v);
  if (st != DYD_OK || !known) return st;
  if (!pd->sk.mesh.no_filter && degree > 2) st = dyd_filter_point_cell(done, s, pd, v, degree, w);
  if (st == DYD_OK && *done) st = settle_vertices(s, pd, w);
  if (st == DYD_OK && !*done) st = clip_cell(s, pd, v, degree, w);
  if (st != DYD_OK) return st;
  drop_repeated(s);
  s->outer_count = s->inner_count;
  if (!DYD_GROW(s->outer, s->outer_cap, s->inner_count + 1)) return DYD_E_NOMEM;
  for (uint32_t k = 0; k < s->inner_count; k++) s->outer[k] = s->inner[k];
  s->rounding = ldexp(1, -w->grid - 1);
  *done = s->in_doubles = s->exact = true;
  return DYD_OK;
}

/* *out = its area, where it is exact; s is scratch. */
static dyd_status point_cell_area(mpq_t out, bool *exact, dyd_shape *s, const dyd_delaunay *pd, uint32_t i,
                                  const dyd_window *w) {
  uint32_t degree, v = pd->sk.vertex[i];
  dyd_status st = point_star(exact, &degree, s, pd, v);
  if (st != DYD_OK || !*exact) return st;
  DYD_SCOPED(clipping) c;
  st = clipping_init(&c, degree);
  if (st == DYD_OK) st = clip_all(&c, pd, v, s->fan, degree, w);
  if (st == DYD_OK) {
    mpq_set_ui(out, 0, 1);
    clip_area2(out, &c);
    mpq_div_2exp(out, out, 1);
  }
  return st;
}

dyd_status dyd_window_init(dyd_window *w, const dyd_rect *rect) {
  const dyd_interval *side[2] = {&rect->x, &rect->y};
  *w = (dyd_window){.rect = rect, .fan_bits = INT64_MAX};
  for (int a = 0; a < 2; a++) {
    if (mpz_cmp_ui(side[a]->den, 1) != 0 || dyd_dyadic_cmp(&side[a]->lo, &side[a]->hi) >= 0) return DYD_E_ARG;
    w->d[2 * a] = dyd_dyadic_get_d(&side[a]->lo, DYD_UP);
    w->d[2 * a + 1] = dyd_dyadic_get_d(&side[a]->hi, DYD_DOWN);
  }
  return DYD_OK;
}

void dyd_shape_clear(dyd_shape *s) {
  dyd_polygon_list_clear(&s->outer_exact);
  dyd_polygon_clear(&s->inner_exact);
  if (s->outline) dyd_outline_clear(s->outline);
  dyd_free_all(s->inner, s->outer, s->fan, s->fan_box, s->key, s->across, s->outline);
  *s = (dyd_shape){0};
}

static void shape_empty(dyd_shape *s) {
  s->in_doubles = s->on_grid = s->exact = s->loose = false;
  dyd_polygon_clear(&s->inner_exact);
  dyd_polygon_list_clear(&s->outer_exact);
}

dyd_status dyd_shape_set_unknown(dyd_shape *s, const dyd_rect *window) {
  enum { CORNERS = 4 };
  shape_empty(s);
  dyd_polygon *p = s->outer_exact.item = calloc(1, sizeof *p);
  if (!p) return DYD_E_NOMEM;
  s->outer_exact.count = 1;
  p->vertex = dyd_alloc(CORNERS, sizeof *p->vertex);
  if (!p->vertex) return DYD_E_NOMEM;
  for (; p->count < CORNERS; p->count++) {
    dyd_point *z = &p->vertex[p->count];
    dyd_point_init(z);
    dyd_dyadic_set(&z->x, p->count == 1 || p->count == 2 ? &window->x.hi : &window->x.lo);
    dyd_dyadic_set(&z->y, p->count >= 2 ? &window->y.hi : &window->y.lo);
  }
  return DYD_OK;
}

dyd_status dyd_shape_clip(bool *done, dyd_shape *s, const dyd_window *w, int64_t bits) {
  uint32_t k = 0;
  while (k < s->outer_count && w->d[0] <= s->outer[k].x && s->outer[k].x <= w->d[1] && w->d[2] <= s->outer[k].y &&
         s->outer[k].y <= w->d[3])
    k++;
  if (k == s->outer_count) return DYD_OK;
  dyd_status st = dyd_shape_inner(&s->inner_exact, s);
  if (st == DYD_OK) st = dyd_shape_outer(&s->outer_exact, s);
  if (st == DYD_OK) st = dyd_polygons_clip(done, &s->outer_exact, w->rect, bits + DYD_CLIP_EXTRA, w->cancel);
  s->in_doubles = s->on_grid = false;
  return st;
}

dyd_status dyd_shape_find(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w, int64_t bits) {
  bool done = false;
  shape_empty(s);
  if (dyd_flag_is_set(w->cancel)) return DYD_CANCELLED;
  dyd_status found = dyd_point_cell(&done, s, pd, i, w);
  if (found != DYD_OK || done) return found;
  if (w->discs) {
    found = dyd_disc_shape(&done, s, pd, i, w, bits);
    return found == DYD_OK && !done ? dyd_shape_set_unknown(s, w->rect) : found;
  }
  if (!pd->sk.mesh.no_filter) {
    dyd_status st = dyd_filter_shape(&done, s, pd, pd->sk.vertex[i], w, w->fan_bits < bits ? w->fan_bits : bits);
    if (st == DYD_OK && !done) {
      st = dyd_filter_polygons(&done, s, pd, i, w, bits);
      if (done) st = dyd_shape_clip(&done, s, w, bits);
    }
    if (st != DYD_OK || done) return st;
  }
  shape_empty(s);
  return dyd_exact_polygons(&s->inner_exact, &s->outer_exact, pd, i, w, bits);
}

/* ---- copies and areas ---- */

static dyd_status polygon_from_doubles(dyd_polygon *out, const dyd_xy *z, uint32_t count) {
  dyd_polygon p = {0};
  p.vertex = dyd_alloc(count, sizeof *p.vertex);
  if (!p.vertex) return DYD_E_NOMEM;
  for (; p.count < count; p.count++) {
    dyd_point_init(&p.vertex[p.count]);
    (void)dyd_dyadic_set_d(&p.vertex[p.count].x, z[p.count].x); /* finite: the filter has compared them */
    (void)dyd_dyadic_set_d(&p.vertex[p.count].y, z[p.count].y);
  }
  *out = p;
  return DYD_OK;
}

dyd_status dyd_shape_inner(dyd_polygon *out, const dyd_shape *s) {
  return s->in_doubles ? polygon_from_doubles(out, s->inner, s->inner_count) : dyd_polygon_copy(out, &s->inner_exact);
}

dyd_status dyd_shape_outer(dyd_polygon_list *out, const dyd_shape *s) {
  dyd_polygon_list list = {0};
  size_t parts = s->in_doubles ? s->outer_count > 0 : s->outer_exact.count;
  list.item = calloc(parts ? parts : 1, sizeof *list.item);
  if (!list.item) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (; list.count < parts && st == DYD_OK; list.count++)
    st = s->in_doubles ? polygon_from_doubles(&list.item[0], s->outer, s->outer_count)
                       : dyd_polygon_copy(&list.item[list.count], &s->outer_exact.item[list.count]);
  if (st == DYD_OK)
    *out = list;
  else
    dyd_polygon_list_clear(&list);
  return st;
}

static dyd_status polygon_list_area2(dyd_dyadic *out, const dyd_polygon_list *l) {
  DYD_LOCAL(dyd_dyadic, sum, one);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) {
    st = dyd_polygon_area2(&one, &l->item[k]);
    if (st == DYD_OK) st = dyd_dyadic_add(&sum, &sum, &one);
  }
  if (st == DYD_OK) dyd_dyadic_swap(out, &sum);
  return st;
}

static dyd_status grid_area_to_dyadic(dyd_dyadic *out, const dyd_grid_area *a) {
  bool minus = a->twice < 0;
  __extension__ unsigned __int128 size = minus ? -(unsigned __int128)a->twice : (unsigned __int128)a->twice;
  DYD_LOCAL_NUMBERS(mpz, n);
  mpz_set_ui(n, (uint64_t)(size >> 64));
  mpz_mul_2exp(n, n, 64);
  mpz_add_ui(n, n, (uint64_t)size);
  if (minus) mpz_neg(n, n);
  return dyd_dyadic_set_z_2exp(out, n, -2 * (int64_t)a->scale);
}

dyd_status dyd_shape_area2(dyd_dyadic *out, const dyd_shape *s, bool outer) {
  if (s->on_grid) return grid_area_to_dyadic(out, &s->grid_area[outer]);
  if (!s->in_doubles) return outer ? polygon_list_area2(out, &s->outer_exact) : dyd_polygon_area2(out, &s->inner_exact);
  DYD_SCOPED(dyd_polygon) p = {0};
  dyd_status st = polygon_from_doubles(&p, outer ? s->outer : s->inner, outer ? s->outer_count : s->inner_count);
  return st == DYD_OK ? dyd_polygon_area2(out, &p) : st;
}

/* ---- public ---- */

/* The inner polygon, if it has corners. */
static dyd_status shape_inner_list(dyd_polygon_list *out, const dyd_shape *s) {
  out->item = calloc(1, sizeof *out->item);
  if (!out->item) return DYD_E_NOMEM;
  dyd_status st = dyd_shape_inner(out->item, s);
  out->count = st == DYD_OK && out->item->count;
  if (!out->count) dyd_polygon_clear(out->item);
  return st;
}

dyd_status dyd_voronoi_polygons(dyd_polygon_list *out, const dyd_delaunay *pd, uint32_t i, dyd_cell_bound bound,
                                const dyd_rect *window, int64_t bits) {
  dyd_window w;
  if (!pd || i >= pd->sk.n || bits < -DYD_EXP_LIMIT / 4 || bits > DYD_EXP_LIMIT / 4) return DYD_E_ARG;
  dyd_status st = dyd_window_init(&w, window);
  if (st != DYD_OK) return st;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  dyd_memory memory = dyd_delaunay_memory_left(pd);
  DYD_SCOPED(dyd_shape) s = {0};
  dyd_polygon_list l = {0};
  w.memory = &memory;
  st = dyd_shape_find(&s, pd, dyd_delaunay_alias(pd, i), &w, bits);
  if (st == DYD_OK && bound == DYD_CELL_POSSIBLE) st = dyd_shape_outer(&l, &s);
  if (st == DYD_OK && bound == DYD_CELL_SURE) st = shape_inner_list(&l, &s);
  dyd_polygon_list_clear(st == DYD_OK ? out : &l);
  if (st == DYD_OK) *out = l;
  return st;
}

dyd_status dyd_voronoi_exact_area(mpq_t out, bool *exact, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window) {
  DYD_SCOPED(dyd_shape) s = {0};
  dyd_window w;
  if (!pd || i >= pd->sk.n) return DYD_E_ARG;
  dyd_status st = dyd_window_init(&w, window);
  return st == DYD_OK ? point_cell_area(out, exact, &s, pd, dyd_delaunay_alias(pd, i), &w) : st;
}
