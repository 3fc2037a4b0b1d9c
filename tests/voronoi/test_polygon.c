/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Proved polygons against the literal definition: [POLY-1] [POLY-2] [SHAPE-1]; areas and distances against the true
 * diagrams of random choices: [AREA-V] [HAUS-V]. Everything is compared in rationals, against all sites. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "metric/bounds_filter.h"
#include "support/thin_case.h"
#include "voronoi/plane.h"
#include "voronoi/shape.h"
#include <cmocka.h>
#include <dyadel/metric.h>
#include <string.h>

enum { PROBES = 24 };

static size_t vertices, probes, fast_sites, exact_sites, exact_cells;

/* ---- cases ---- */

typedef struct setting {
  harness *h;
  const orc_case *c;
  const dyd_delaunay *pd;
  orc_rect window;
  dyd_rect rect;
  long bits;
} setting;

/* A window round some of the case, ends multiples of a power of two; polygons of a size that suits it. */
static void setting_init(setting *s, harness *h, const orc_case *c) {
  *s = (setting){.h = h, .c = c};
  mpq_t size, q;
  mpq_inits(size, q, NULL);
  for (int k = 0; k < 4; k++) mpq_init(s->window.e[k]);
  for (size_t i = 0; i < c->n; i++)
    for (int k = 0; k < 4; k++) {
      mpq_sub(q, c->rect[i].e[k], c->rect[0].e[k & 2]);
      mpq_abs(q, q);
      if (mpq_cmp(q, size) > 0) mpq_set(size, q);
    }
  if (!mpq_sgn(size)) mpq_set_ui(size, 1, 1);
  long e = (long)mpz_sizeinbase(mpq_numref(size), 2) - (long)mpz_sizeinbase(mpq_denref(size), 2) + 1;
  for (int a = 0; a < 2; a++) {
    long lo = (long)test_between(&h->random, -24, 16), hi = lo + (long)test_between(&h->random, 1, 32);
    if (strcmp(c->kind, "thin") == 0 && !test_chance(&h->random, 4)) { /* all cells but those of the hull inside */
      lo = (long)test_between(&h->random, -48, -20);
      hi = (long)test_between(&h->random, 20, 48);
    }
    for (int end = 0; end < 2; end++) {
      mpq_ptr t = s->window.e[2 * a + end];
      mpz_t floor;
      mpz_init(floor);
      mpq_set(q, c->rect[0].e[2 * a]);
      if (e - 4 >= 0)
        mpq_div_2exp(q, q, (mp_bitcnt_t)(e - 4));
      else
        mpq_mul_2exp(q, q, (mp_bitcnt_t)(4 - e));
      mpz_fdiv_q(floor, mpq_numref(q), mpq_denref(q));
      mpq_set_z(t, floor);
      mpq_set_si(q, end ? hi : lo, 1);
      mpq_add(t, t, q);
      if (e - 4 >= 0)
        mpq_mul_2exp(t, t, (mp_bitcnt_t)(e - 4));
      else
        mpq_div_2exp(t, t, (mp_bitcnt_t)(4 - e));
      mpz_clear(floor);
    }
  }
  s->bits = (long)test_between(&h->random, 2, 10) - e;
  dyd_rect_init(&s->rect);
  harness_rect(&s->rect, &s->window);
  mpq_clears(size, q, NULL);
}

static void setting_clear(setting *s) {
  dyd_rect_clear(&s->rect);
  for (int k = 0; k < 4; k++) mpq_clear(s->window.e[k]);
}

/* A point of the window, often on a coarse lattice. */
static xy somewhere(orc_pool *p, setting *s) {
  xy z;
  for (int a = 0; a < 2; a++) {
    unsigned bits = test_chance(&s->h->random, 3) ? 4 : 30;
    mpq_ptr t = orc_new(p);
    mpq_set_ui(t, (unsigned long)test_below(&s->h->random, ((uint64_t)1 << bits) + 1), 1);
    mpq_div_2exp(t, t, bits);
    mpq_srcptr lo = s->window.e[2 * a], v = orc_add(p, lo, orc_mul(p, t, orc_sub(p, s->window.e[2 * a + 1], lo)));
    *(a ? &z.y : &z.x) = v;
  }
  return z;
}

typedef bool (*member_fn)(orc_pool *p, const orc_case *c, size_t i, xy z);

/* Moves z, a member, close to the border of the set, towards a point that is not in it. */
static xy to_border(orc_pool *p, setting *s, size_t i, member_fn in, xy z) {
  xy out = somewhere(p, s);
  if (in(p, s->c, i, out)) return z;
  for (int k = 0; k < 20; k++) {
    xy middle = {orc_mid(p, z.x, out.x), orc_mid(p, z.y, out.y)};
    *(in(p, s->c, i, middle) ? &z : &out) = middle;
  }
  return z;
}

/* ---- inner ---- */

static bool check_inner_vertices(char *message, orc_pool *p, const setting *s, size_t i, const dyd_polygon *g) {
  for (size_t k = 0; k < g->count; k++) {
    size_t mark = orc_mark(p);
    xy a = of_point(p, &g->vertex[k]), b = of_point(p, &g->vertex[(k + 1) % g->count]),
       c = of_point(p, &g->vertex[(k + 2) % g->count]);
    bool held = in_int(p, s->c, i, a), within = in_window(&s->window, a), left = mpq_sgn(cross(p, a, b, c)) > 0;
    orc_release(p, mark);
    vertices++;
    if (!held) return wrong(message, "inner vertex %zu of site %zu is not in Int", k, i);
    if (!within) return wrong(message, "inner vertex %zu of site %zu is outside of the window", k, i);
    if (!left) return wrong(message, "inner polygon of site %zu is not convex at %zu", i, k);
  }
  return true;
}

/* Returns true if z is within 2^-bits of the polygon. */
static bool close_to(orc_pool *p, const setting *s, const dyd_polygon *g, xy z) {
  mpq_srcptr limit = two_to(p, -2 * s->bits);
  if (in_polygon(p, g, z)) return true;
  for (size_t k = 0; k < g->count; k++) {
    xy a = of_point(p, &g->vertex[k]), b = of_point(p, &g->vertex[(k + 1) % g->count]);
    if (mpq_cmp(segment2(p, z, a, b), limit) <= 0) return true;
  }
  return false;
}

/* Returns true if Int n W holds the square of half-side 2^-bits about z. */
static bool holds_square(orc_pool *p, const setting *s, size_t i, xy z) {
  mpq_srcptr h = two_to(p, -s->bits);
  for (int k = 0; k < 4; k++) {
    xy q = {k & 1 ? orc_add(p, z.x, h) : orc_sub(p, z.x, h), k & 2 ? orc_add(p, z.y, h) : orc_sub(p, z.y, h)};
    if (!in_window(&s->window, q) || !in_int(p, s->c, i, q)) return false;
  }
  return true;
}

static bool check_inner(char *message, orc_pool *p, setting *s, size_t i, const dyd_polygon *g) {
  if (g->count == 1 || g->count == 2) return wrong(message, "%zu vertices", g->count);
  if (!check_inner_vertices(message, p, s, i, g)) return false;
  for (int k = 0; k < PROBES; k++) {
    size_t mark = orc_mark(p);
    xy z = somewhere(p, s);
    if (g->count && in_int(p, s->c, i, z)) z = to_border(p, s, i, in_int, z);
    bool good = !in_int(p, s->c, i, z) || (g->count ? close_to(p, s, g, z) : !holds_square(p, s, i, z));
    orc_release(p, mark);
    probes++;
    if (!good) return wrong(message, "a point of Int %zu is far from the inner polygon (%zu vertices)", i, g->count);
  }
  return true;
}

/* ---- outer ---- */

/* Both ends on the same side of the window. */
static bool edge_is_on_side(const orc_rect *w, xy a, xy b) {
  for (int k = 0; k < 4; k++)
    if (mpq_equal(k < 2 ? a.x : a.y, w->e[k]) && mpq_equal(k < 2 ? b.x : b.y, w->e[k])) return true;
  return false;
}

/* [POLY-3] */
static bool is_in_window(const orc_rect *w, xy z) {
  return mpq_cmp(w->e[0], z.x) <= 0 && mpq_cmp(z.x, w->e[1]) <= 0 && mpq_cmp(w->e[2], z.y) <= 0 &&
         mpq_cmp(z.y, w->e[3]) <= 0;
}

/* Moved towards R_i by four times its error bound, the vertex is in Pos_i (or the move ends in R_i). A sliver of
 * Pos_i may be missed that way, so only cases of one scale are checked. */
static bool vertex_is_close(orc_pool *p, const setting *s, size_t i, xy z) {
  if (strcmp(s->c->kind, "thin") != 0) return true;
  const orc_rect *r = &s->c->rect[i];
  xy d = {orc_si(p, 0, 1), orc_si(p, 0, 1)};
  if (mpq_cmp(z.x, r->e[0]) < 0) d.x = orc_sub(p, r->e[0], z.x);
  if (mpq_cmp(z.x, r->e[1]) > 0) d.x = orc_sub(p, r->e[1], z.x);
  if (mpq_cmp(z.y, r->e[2]) < 0) d.y = orc_sub(p, r->e[2], z.y);
  if (mpq_cmp(z.y, r->e[3]) > 0) d.y = orc_sub(p, r->e[3], z.y);
  mpq_srcptr l2 = orc_add(p, orc_sqr(p, d.x), orc_sqr(p, d.y)), limit = two_to(p, 4 - 2 * s->bits);
  if (mpq_cmp(l2, limit) <= 0) return true;
  mpq_srcptr share = two_to(p, 0); /* halved until the move is at most 4 * 2^-bits long, so at least 2 * 2^-bits */
  while (mpq_cmp(orc_mul(p, l2, orc_sqr(p, share)), limit) > 0) share = orc_div(p, share, orc_si(p, 2, 1));
  xy q = {orc_add(p, z.x, orc_mul(p, d.x, share)), orc_add(p, z.y, orc_mul(p, d.y, share))};
  return in_pos(p, s->c, i, q);
}

static bool check_outer_edges(char *message, orc_pool *p, const setting *s, size_t i, const dyd_polygon *g) {
  for (size_t k = 0; k < g->count; k++) {
    size_t mark = orc_mark(p);
    xy a = of_point(p, &g->vertex[k]), b = of_point(p, &g->vertex[(k + 1) % g->count]);
    bool good = edge_is_on_side(&s->window, a, b), within = is_in_window(&s->window, a),
         close = edge_is_on_side(&s->window, a, a) || vertex_is_close(p, s, i, a);
    for (size_t j = 0; j < s->c->n && !good; j++) good = j != i && nearer(p, s->c, j, i, a) && nearer(p, s->c, j, i, b);
    orc_release(p, mark);
    vertices++;
    if (!within) return wrong(message, "outer vertex %zu of site %zu leaves the window", k, i);
    if (!good) return wrong(message, "outer edge %zu of site %zu is not in Ext by one site", k, i);
    if (!close) return wrong(message, "outer vertex %zu of site %zu is far from Pos", k, i);
  }
  return true;
}

static bool check_outer(char *message, orc_pool *p, setting *s, size_t i, const dyd_polygon_list *l) {
  for (size_t k = 0; k < l->count; k++)
    if (!check_outer_edges(message, p, s, i, &l->item[k])) return false;
  for (int k = 0; k < PROBES; k++) {
    size_t mark = orc_mark(p);
    xy z = somewhere(p, s);
    if (in_pos(p, s->c, i, z)) z = to_border(p, s, i, in_pos, z);
    bool held = !in_pos(p, s->c, i, z);
    for (size_t q = 0; q < l->count && !held; q++) held = in_polygon(p, &l->item[q], z);
    orc_release(p, mark);
    probes++;
    if (!held) return wrong(message, "a point of Pos %zu is in none of the %zu outer polygons", i, l->count);
  }
  return true;
}

/* ---- the rung in doubles ---- */

/* The reach that the bounds use is at least dl_i at all outer vertices. */
static bool check_reach(char *message, orc_pool *p, const setting *s, size_t i, const dyd_shape *shape) {
  double box[4];
  dyd_polygon_list outer = {0};
  dyd_sites_get_d(box, dyd_delaunay_sites(s->pd), i);
  double reach = dyd_filter_reach_of_shape(shape, box);
  bool good = dyd_shape_outer(&outer, shape) == DYD_OK;
  for (size_t q = 0; q < outer.count && good && reach < HUGE_VAL; q++)
    for (size_t k = 0; k < outer.item[q].count && good; k++) {
      size_t mark = orc_mark(p);
      mpq_ptr stated = orc_new(p);
      mpq_set_d(stated, reach);
      good = mpq_cmp(near2(p, of_point(p, &outer.item[q].vertex[k]), &s->c->rect[i], true), orc_sqr(p, stated)) <= 0 ||
             wrong(message, "the reach of site %zu is too small", i);
      orc_release(p, mark);
    }
  dyd_polygon_list_clear(&outer);
  return good;
}

/* The areas that it states lie on the safe side of the exact ones. */
static bool check_shape(char *message, orc_pool *p, const setting *s, size_t i) {
  dyd_window w;
  dyd_shape shape = {0};
  dyd_dyadic area2;
  bool good =
      dyd_window_init(&w, &s->rect) == DYD_OK && dyd_shape_find(&shape, s->pd, (uint32_t)i, &w, s->bits) == DYD_OK;
  dyd_dyadic_init(&area2);
  *(shape.in_doubles ? &fast_sites : &exact_sites) += 1;
  for (int outer = 0; outer < 2 && good && shape.in_doubles && !shape.on_grid; outer++) {
    size_t mark = orc_mark(p);
    mpq_ptr exact = orc_new(p), stated = orc_new(p);
    good = dyd_shape_area2(&area2, &shape, outer) == DYD_OK;
    dyd_dyadic_get_q(exact, &area2);
    mpq_set_d(stated, 2 * shape.area[outer]);
    if (outer ? mpq_cmp(stated, exact) < 0 : mpq_cmp(stated, exact) > 0) good = wrong(message, "area of site %zu", i);
    mpq_sub(stated, stated, exact);
    mpq_abs(stated, stated);
    mpq_mul_2exp(stated, stated, 30);
    if (good && mpq_cmp(stated, exact) > 0) good = wrong(message, "area of site %zu is not close", i);
    orc_release(p, mark);
  }
  good = good && check_reach(message, p, s, i, &shape);
  dyd_dyadic_clear(&area2);
  dyd_shape_clear(&shape);
  return good;
}

/* ---- one case ---- */

static const dyd_polygon *inner_of(const dyd_polygon_list *l) {
  static const dyd_polygon none = {0};
  return l->count ? l->item : &none;
}

static bool check_site(char *message, setting *s, size_t i) {
  dyd_polygon_list inner = {0};
  dyd_polygon_list outer = {0};
  bool good = dyd_voronoi_polygons(&inner, s->pd, (uint32_t)i, DYD_CELL_SURE, &s->rect, s->bits) == DYD_OK &&
              dyd_voronoi_polygons(&outer, s->pd, (uint32_t)i, DYD_CELL_POSSIBLE, &s->rect, s->bits) == DYD_OK;
  if (!good) wrong(message, "site %zu: no polygons", i);
  good = good && check_inner(message, &s->h->pool, s, i, inner_of(&inner)) &&
         check_outer(message, &s->h->pool, s, i, &outer);
  good = good && check_shape(message, &s->h->pool, s, i);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_list_clear(&inner);
  return good;
}

/* dist(z, true diagram of the choice) is at most the bound, for z in U. */
static bool check_distance(char *message, setting *s, const orc_case *choice, const dyd_voronoi_bounds *b) {
  orc_pool *p = &s->h->pool;
  size_t mark = orc_mark(p);
  xy z = somewhere(p, s);
  bool open = true;
  size_t a = 0;
  for (size_t i = 0; i < s->c->n; i++) {
    if (orc_case_alias(s->c, i) == i && in_int(p, s->c, i, z)) open = false;
    if (mpq_cmp(near2(p, z, &choice->rect[i], true), near2(p, z, &choice->rect[a], true)) < 0) a = i;
  }
  bool good = !open;
  mpq_srcptr least = NULL;
  for (size_t j = 0; j < s->c->n && !good; j++) {
    xy u = {choice->rect[a].e[0], choice->rect[a].e[2]}, v = {choice->rect[j].e[0], choice->rect[j].e[2]};
    mpq_srcptr apart = distance2(p, u, v);
    if (!mpq_sgn(apart)) continue;
    mpq_srcptr t = orc_sub(p, distance2(p, z, v), distance2(p, z, u));
    t = orc_div(p, orc_sqr(p, t), orc_mul(p, apart, orc_si(p, 4, 1)));
    if (!least || mpq_cmp(t, least) < 0) least = t;
  }
  if (open && least) {
    mpq_ptr q = orc_new(p);
    dyd_dyadic_get_q(q, &b->hausdorff);
    good = mpq_cmp(least, orc_sqr(p, q)) <= 0;
  }
  orc_release(p, mark);
  return good || wrong(message, "a point of U is farther from the true diagram than the bound");
}

/* W cut by the half-planes of one site: twice its area. */
static mpq_srcptr true_area2(orc_pool *p, const setting *s, const orc_case *choice, size_t i) {
  xy ring[2][64];
  size_t n = 4;
  for (int k = 0; k < 4; k++) ring[0][k] = (xy){s->window.e[k == 1 || k == 2], s->window.e[2 + (k >= 2)]};
  for (size_t j = 0; j < choice->n; j++) {
    xy u = {choice->rect[i].e[0], choice->rect[i].e[2]}, v = {choice->rect[j].e[0], choice->rect[j].e[2]};
    size_t kept = 0;
    if (!mpq_sgn(distance2(p, u, v))) continue;
    for (size_t k = 0; k < n; k++) {
      xy a = ring[0][k], b = ring[0][(k + 1) % n];
      mpq_srcptr fa = orc_sub(p, distance2(p, a, v), distance2(p, a, u)),
                 fb = orc_sub(p, distance2(p, b, v), distance2(p, b, u));
      if (mpq_sgn(fa) >= 0) ring[1][kept++] = a;
      if (mpq_sgn(fa) * mpq_sgn(fb) >= 0) continue;
      mpq_srcptr t = orc_div(p, fa, orc_sub(p, fa, fb));
      ring[1][kept++] = (xy){orc_add(p, a.x, orc_mul(p, t, orc_sub(p, b.x, a.x))),
                             orc_add(p, a.y, orc_mul(p, t, orc_sub(p, b.y, a.y)))};
    }
    n = kept;
    memcpy(ring[0], ring[1], n * sizeof *ring[0]);
    if (!n) return orc_si(p, 0, 1);
  }
  mpq_srcptr sum = orc_si(p, 0, 1);
  for (size_t k = 1; k + 1 < n; k++) sum = orc_add(p, sum, cross(p, ring[0][0], ring[0][k], ring[0][k + 1]));
  return sum;
}

/* What the bound takes for the area of a cell of exact points: all of it, exactly; else that of the inner polygon. */
static bool cell_area2(char *message, orc_pool *p, mpq_srcptr *sum, setting *s, size_t i, mpq_srcptr inner,
                       mpq_srcptr truth) {
  mpq_ptr area = orc_new(p);
  bool exact = false;
  if (dyd_voronoi_exact_area(area, &exact, s->pd, (uint32_t)i, &s->rect) != DYD_OK) return wrong(message, "no area");
  *sum = orc_add(p, *sum, exact ? truth : inner);
  exact_cells += exact;
  return !exact || mpq_equal(orc_mul(p, orc_si(p, 2, 1), area), truth) || wrong(message, "the area of cell %zu", i);
}

/* Areas: inner <= true cell <= outer, for a choice; and the bound on U is W less all inner ones. */
static bool check_areas(char *message, setting *s, const orc_case *choice, const dyd_voronoi_bounds *b) {
  orc_pool *p = &s->h->pool;
  size_t mark = orc_mark(p);
  mpq_srcptr sum = orc_si(p, 0, 1);
  bool good = true;
  dyd_dyadic d;
  dyd_dyadic_init(&d);
  for (size_t i = 0; i < s->c->n && good; i++) {
    dyd_polygon_list inner = {0};
    dyd_polygon_list outer = {0};
    if (orc_case_alias(s->c, i) != i) continue;
    mpq_srcptr truth = true_area2(p, s, choice, i), all = orc_si(p, 0, 1);
    mpq_ptr q = orc_new(p);
    good = dyd_voronoi_polygons(&inner, s->pd, (uint32_t)i, DYD_CELL_SURE, &s->rect, s->bits) == DYD_OK &&
           dyd_voronoi_polygons(&outer, s->pd, (uint32_t)i, DYD_CELL_POSSIBLE, &s->rect, s->bits) == DYD_OK &&
           dyd_polygon_area2(&d, inner_of(&inner)) == DYD_OK;
    dyd_dyadic_get_q(q, &d);
    good = good && cell_area2(message, p, &sum, s, i, q, truth);
    if (good && mpq_cmp(q, truth) > 0) good = wrong(message, "the inner polygon of %zu is larger than a true cell", i);
    for (size_t k = 0; good && k < outer.count; k++) {
      mpq_ptr t = orc_new(p);
      good = dyd_polygon_area2(&d, &outer.item[k]) == DYD_OK;
      dyd_dyadic_get_q(t, &d);
      all = orc_add(p, all, t);
    }
    if (good && mpq_cmp(all, truth) < 0)
      good = wrong(message, "the outer polygons of %zu are smaller than a true cell", i);
    dyd_polygon_list_clear(&inner);
    dyd_polygon_list_clear(&outer);
  }
  mpq_ptr bound = orc_new(p);
  dyd_dyadic_get_q(bound, &b->area);
  mpq_srcptr w = orc_mul(p, orc_sub(p, s->window.e[1], s->window.e[0]), orc_sub(p, s->window.e[3], s->window.e[2]));
  mpq_srcptr open = orc_sub(p, w, orc_div(p, sum, orc_si(p, 2, 1)));
  if (good && mpq_cmp(bound, open) < 0) good = wrong(message, "the bound on the area is too small");
  if (good && mpq_cmp(bound, orc_add(p, open, orc_div(p, w, orc_si(p, 1 << 20, 1)))) > 0)
    good = wrong(message, "the bound on the area is far above what it is made of");
  dyd_dyadic_clear(&d);
  orc_release(p, mark);
  return good;
}

static bool check_bounds(char *message, setting *s) {
  dyd_voronoi_bounds b;
  orc_case choice;
  dyd_voronoi_bounds_init(&b);
  orc_case_init(&choice);
  bool good = dyd_metric_voronoi(&b, s->pd, &s->rect, s->bits, NULL) == DYD_OK || wrong(message, "no bounds");
  for (int k = 0; k < 3 && good; k++) {
    orc_choose(&choice, &s->h->random, s->c, 3);
    good = check_areas(message, s, &choice, &b);
    for (int q = 0; q < 6 && good && b.finite; q++) good = check_distance(message, s, &choice, &b);
  }
  orc_case_clear(&choice);
  dyd_voronoi_bounds_clear(&b);
  return good;
}

static bool check_case(char *message, harness *h, const orc_case *c) {
  if (c->n < 1) return true;
  dyd_delaunay_options options = {DYD_SIZED(dyd_delaunay_options), .no_filter = test_chance(&h->random, 4)};
  dyd_sites *sites = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, sites, &options);
  setting s;
  setting_init(&s, h, c);
  s.pd = pd;
  bool good = pd != NULL;
  for (size_t i = 0; i < c->n && good; i++)
    if (orc_case_alias(c, i) == i) good = check_site(message, &s, i);
  good = good && check_bounds(message, &s);
  setting_clear(&s);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return good;
}

static void random_cases(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "polygons random");
  harness_run_cases(&h, 7, test_cases(70), check_case);
  fprintf(stderr, "# %zu vertices, %zu probes\n", vertices, probes);
  harness_clear(&h);
}

/* Thin rectangles, most of whose cells the doubles can do. */
static void thin_cases(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "polygons thin");
  orc_case c;
  orc_case_init(&c);
  for (size_t k = 0; k < test_cases(30); k++) {
    thin_case(&c, &h.random, 14, 10, 40);
    harness_run(&h, &c, check_case);
  }
  fprintf(stderr, "# cells in doubles %zu, exact %zu\n", fast_sites, exact_sites);
  assert_true(fast_sites > test_least(40) && exact_sites > test_least(40) && exact_cells > test_least(40));
  orc_case_clear(&c);
  harness_clear(&h);
}

/* Pos of site 1 meets the enlarged window, but not the window: its polygon would come out clockwise. */
static void part_outside_the_window(void **state) {
  (void)state;
  harness h;
  orc_case c;
  char message[MESSAGE_SIZE];
  harness_init(&h, "polygons outside");
  orc_case_init(&c);
  const unsigned long den = 1ul << 38;
  orc_case_add(&c, 3210061699, 3210061699, 227876600864, 227876600865, den);
  orc_case_add(&c, 220879809497, 220879809499, 91481571411, 91481571413, den);
  orc_case_add(&c, 169418678551, 169418678552, 114102413712, 114102413712, den);
  orc_case_add(&c, 267901661597, 267901661598, 92014168160, 92014168162, den);
  dyd_sites *sites = harness_sites(&c);
  dyd_delaunay *pd = harness_engine(message, sites, NULL);
  dyd_rect w;
  dyd_dyadic area2;
  dyd_dyadic_init(&area2);
  dyd_rect_init(&w);
  dyd_rect_set_d(&w, 0.9375, 1.5625, 0.875, 1.5625);
  for (uint32_t i = 0; i < 4; i++) {
    dyd_polygon_list l = {0};
    assert_int_equal(dyd_voronoi_polygons(&l, pd, i, DYD_CELL_POSSIBLE, &w, 2), DYD_OK);
    for (size_t k = 0; k < l.count; k++) {
      assert_int_equal(dyd_polygon_area2(&area2, &l.item[k]), DYD_OK);
      assert_true(dyd_dyadic_sgn(&area2) > 0);
    }
    dyd_polygon_list_clear(&l);
  }
  dyd_rect_clear(&w);
  dyd_dyadic_clear(&area2);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  orc_case_clear(&c);
  harness_clear(&h);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(random_cases), cmocka_unit_test(thin_cases),
                                     cmocka_unit_test(part_outside_the_window)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
