/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section of a certificate on the Voronoi diagram: the window, inner polygons, bounds.
 *
 * The polygons are those of the bounds in metric.h, vertex by vertex, so that no area is lost; a polygon that the
 * checker's own tests reject is not written. */
#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "checker/checker.h"
#include "checker/parts.h"
#include "delaunay/state.h"
#include "dyadic/raw.h"
#include "metric/bounds.h"
#include "prove/proof.h"
#include "rect/rect.h"

#include <inttypes.h>

DYD_ARRAYS(dyd_cert_fraction)

/* Corners of a certificate: a direction in which a site is certainly beyond the parts of the rim on either side.
 *
 * All differences of a point of those sites and a point of the corner's rectangle must lie in an open half-plane; they
 * span a cone, and a direction at an obtuse angle to both of its sides will do. Integers only. */

/* The walk of the unbounded face as sites, and which of them may be corners. */
typedef struct outer_walk {
  uint32_t *walk, *site;
  size_t count;
  bool *corner; /* by site */
} outer_walk;

static dyd_status make_rim(outer_walk *r, const dyd_proof *p) {
  dyd_status st = dyd_cert_walk(&r->walk, &r->count, &p->graph, dyd_cert_outer(&p->graph));
  if (st != DYD_OK) return st;
  r->site = dyd_alloc(r->count, sizeof *r->site);
  if (!r->site) return DYD_E_NOMEM;
  for (size_t q = 0; q < r->count; q++) r->site[q] = dyd_cert_origin(&p->graph, r->walk[q]);
  DYD_FREED uint32_t *copy = dyd_alloc(r->count, sizeof *copy), *times = calloc(p->sites.count, sizeof *times);
  r->corner = dyd_alloc(p->sites.count, sizeof *r->corner);
  size_t kept = 0;
  if (copy && times && r->corner) {
    for (size_t q = 0; q < r->count; q++)
      if (times[r->site[q]]++ == 0) copy[kept++] = r->site[q];
    st = dyd_cert_hull(r->corner, &p->sites, copy, kept);
    for (size_t q = 0; q < r->count; q++)
      if (times[r->site[q]] > 1) r->corner[r->site[q]] = false;
  } else {
    st = DYD_E_NOMEM;
  }
  return st;
}

/* A cone of directions: all d with first x d >= 0 >= last x d. */
typedef struct cone {
  dyd_exact first[2], last[2];
  bool empty, broken; /* broken: a half-plane or more */
} cone;

/* Sign of the cross product, or of the inner one. */
static int cone_product(const dyd_exact a[2], const dyd_exact b[2], bool inner) {
  DYD_LOCAL_ARRAY(dyd_exact, s, [2]);
  dyd_exact_mul(&s[0], &a[0], &b[!inner]);
  dyd_exact_mul(&s[1], &a[1], &b[inner]);
  if (inner) mpz_neg(s[1].man, s[1].man);
  return dyd_exact_cmp(&s[0], &s[1]);
}

static int cone_cross(const dyd_exact a[2], const dyd_exact b[2]) {
  return cone_product(a, b, false);
}

static int cone_dot(const dyd_exact a[2], const dyd_exact b[2]) {
  return cone_product(a, b, true);
}

static void set_direction(dyd_exact out[2], const dyd_exact d[2]) {
  dyd_exact_set(&out[0], &d[0]);
  dyd_exact_set(&out[1], &d[1]);
}

static void cone_widen(cone *k, const dyd_exact d[2]) {
  if (k->broken) return;
  if (!dyd_exact_sgn(&d[0]) && !dyd_exact_sgn(&d[1])) {
    k->broken = true;
  } else if (k->empty) {
    set_direction(k->first, d);
    set_direction(k->last, d);
    k->empty = false;
  } else {
    int a = cone_cross(k->first, d), b = cone_cross(d, k->last);
    if (a >= 0 && b >= 0 && (a || b || cone_dot(k->first, d) > 0)) return; /* inside */
    bool before = a < 0 && cone_cross(d, k->last) > 0, after = b < 0 && cone_cross(k->first, d) > 0;
    if (before)
      set_direction(k->first, d);
    else if (after)
      set_direction(k->last, d);
    else
      k->broken = true;
  }
}

/* The cone takes in all differences of a point of w and a point of v. */
static void cone_take_in(cone *k, const dyd_cert_sites *s, uint32_t v, uint32_t w) {
  DYD_LOCAL_ARRAY(dyd_exact, d, [2]);
  DYD_LOCAL_ARRAY(dyd_cert_fraction, end, [2][2]);
  for (int a = 0; a < 2; a++) {
    const dyd_cert_side *from = &s->site[v].side[a], *to = &s->site[w].side[a];
    dyd_cert_fraction_sub(&end[a][0], &to->lo, dyd_cert_den(to), dyd_cert_high(from), dyd_cert_den(from));
    dyd_cert_fraction_sub(&end[a][1], dyd_cert_high(to), dyd_cert_den(to), &from->lo, dyd_cert_den(from));
  }
  for (int q = 0; q < 4; q++) {
    const dyd_cert_fraction *x = &end[0][q / 2], *y = &end[1][q % 2];
    dyd_exact_set(&d[0], &x->num);
    dyd_exact_set(&d[1], &y->num);
    if (!y->whole) dyd_exact_mul_z(&d[0], &d[0], y->den);
    if (!x->whole) dyd_exact_mul_z(&d[1], &d[1], x->den);
    cone_widen(k, (const dyd_exact *)d);
  }
}

/* ---- a direction ---- */

/* Scales d to about `bits` bits, rounding. */
static void cut_direction(dyd_exact out[2], const dyd_exact d[2], int64_t bits) {
  int64_t x = dyd_exact_top(&d[0]), y = dyd_exact_top(&d[1]), top = x > y ? x : y;
  for (int a = 0; a < 2; a++) {
    dyd_proof_round(&out[a], &d[a], top - bits);
    out[a].exp -= top - bits;
  }
}

/* out = d turned a quarter, counter-clockwise for sign = 1. */
static void turn_quarter(dyd_exact out[2], const dyd_exact d[2], int sign) {
  dyd_exact_set(&out[0], &d[1]);
  dyd_exact_set(&out[1], &d[0]);
  mpz_neg(out[sign > 0 ? 0 : 1].man, out[sign > 0 ? 0 : 1].man);
}

/* u = a direction at an obtuse angle to the sides of the cone, as far as `bits` bits allow. */
static void cone_choose(dyd_exact u[2], const cone *k, int64_t bits) {
  DYD_LOCAL_ARRAY(dyd_exact, all, [6]);
  dyd_exact *a = all, *b = all + 2, *t = all + 4;
  bool wide = cone_dot(k->first, k->last) <= 0;
  cut_direction(a, k->first, bits);
  cut_direction(b, k->last, bits);
  if (wide) {
    turn_quarter(t, (const dyd_exact *)a, -1);
    turn_quarter(a, (const dyd_exact *)b, 1);
  } else {
    set_direction(t, (const dyd_exact *)b);
  }
  for (int q = 0; q < 2; q++) {
    dyd_exact_add(&u[q], &a[q], &t[q]);
    if (!wide) mpz_neg(u[q].man, u[q].man);
    dyd_proof_trim(&u[q]);
  }
}

/* Two lists of sites. */
typedef struct crowds {
  const uint32_t *site[2];
  size_t count[2];
} crowds;

/* For the sites beside v: takes them into the cone (u = NULL), or asks whether v is beyond them all in direction u. */
static bool each_beside(cone *k, const dyd_exact *u, const dyd_proof *p, uint32_t v, const crowds *beside) {
  for (int way = 0; way < 2; way++) {
    for (size_t m = 0; m < beside->count[way]; m++) {
      uint32_t w = beside->site[way][m];
      if (w == v) continue;
      if (!u)
        cone_take_in(k, &p->sites, v, w);
      else if (dyd_cert_compare_heights(&p->sites, u, w, v) >= 0)
        return false;
      if (k->broken) return false;
    }
  }
  return true;
}

static bool find_direction(dyd_exact u[2], const dyd_proof *p, uint32_t v, const crowds *beside) {
  cone k = {.empty = true};
  dyd_proof_init(k.first, 2);
  dyd_proof_init(k.last, 2);
  bool found = false;
  if (each_beside(&k, NULL, p, v, beside) && !k.empty)
    for (int64_t bits = 3; bits <= (int64_t)1 << 14 && !found; bits += bits / 2 + 1) {
      cone_choose(u, &k, bits);
      found = each_beside(&k, u, p, v, beside);
    }
  dyd_proof_clear(k.first, 2);
  dyd_proof_clear(k.last, 2);
  return found;
}

bool dyd_proof_find_direction(dyd_exact u[2], const dyd_proof *p, uint32_t v, const uint32_t *site, size_t count) {
  const crowds all = {{site, NULL}, {count, 0}};
  return find_direction(u, p, v, &all);
}

/* ---- all corners ---- */

/* The sites of the two groups at the corner at position q. */
static crowds groups_beside(const outer_walk *r, const dyd_cert_parts *parts, size_t q) {
  crowds out;
  for (int way = 0; way < 2; way++) {
    uint32_t group = parts->group[way ? q : (q + r->count - 1) % r->count];
    out.site[way] = parts->site + parts->start[group];
    out.count[way] = parts->start[group + 1] - parts->start[group];
  }
  return out;
}

static dyd_status keep_corner(dyd_proof *p, uint32_t v, const dyd_exact u[2]) {
  if (!DYD_GROW(p->corner, p->corner_cap, p->corners + 1)) return DYD_E_NOMEM;
  dyd_cert_corner *c = &p->corner[p->corners++];
  c->i = v;
  dyd_proof_init(c->u, 2);
  set_direction(c->u, u);
  return DYD_OK;
}

static bool have_corner(const outer_walk *r) {
  for (size_t q = 0; q < r->count; q++)
    if (r->corner[r->site[q]]) return true;
  return false;
}

void dyd_proof_drop_corners(dyd_proof *p) {
  for (size_t q = 0; q < p->corners; q++) dyd_proof_clear(p->corner[q].u, 2);
  p->corners = 0;
}

/* Keeps the corners that have a direction; *again: some have none and are corners no more, so parts have grown. */
static dyd_status try_corners(bool *again, dyd_proof *p, outer_walk *r) {
  dyd_cert_parts parts;
  *again = false;
  dyd_proof_drop_corners(p);
  dyd_status st = dyd_cert_parts_init(&parts, &p->graph, r->walk, r->count, r->corner);
  if (st != DYD_OK) return st;
  DYD_LOCAL_ARRAY(dyd_exact, u, [2]);
  for (size_t q = 0; q < r->count && st == DYD_OK; q++) {
    if (!r->corner[r->site[q]]) continue;
    const crowds beside = groups_beside(r, &parts, q);
    if (find_direction(u, p, r->site[q], &beside)) {
      st = keep_corner(p, r->site[q], (const dyd_exact *)u);
    } else {
      r->corner[r->site[q]] = false;
      *again = true;
    }
  }
  dyd_cert_parts_clear(&parts);
  return st;
}

static dyd_status rim_corners(dyd_proof *p) {
  if (!p->graph.connected || p->graph.count == 0) return DYD_OK;
  outer_walk r = {0};
  dyd_status st = make_rim(&r, p);
  for (bool again = true; again && st == DYD_OK;) {
    again = false;
    if (have_corner(&r))
      st = try_corners(&again, p, &r);
    else
      dyd_proof_drop_corners(p);
  }
  if (p->corners) qsort(p->corner, p->corners, sizeof *p->corner, dyd_compare_index);
  dyd_free_all(r.walk, r.site, r.corner);
  return st;
}

dyd_status dyd_proof_find_faces(dyd_proof *p) {
  uint32_t bad = DYD_CERT_NONE;
  dyd_status st = dyd_cert_graph_init(&p->graph, &p->sites, &p->legal, &p->bridges);
  if (st == DYD_OK) st = rim_corners(p);
  if (st == DYD_OK) st = dyd_cert_faces_init(&p->faces, &bad, &p->graph, p->corner, p->corners);
  return st;
}

/* Bridges of a certificate.
 *
 * The strictly Delaunay edges of distinct points connect them (a shortest spanning tree consists of such
 * edges), and they do not cross legal edges, which are strictly Delaunay for these points too. So the triangulation
 * of the places, computed as of exact points, has bridges enough, each with a witness. */

/* ---- places ---- */

/* The place of a site as an exact point. */
static dyd_status place_rect(dyd_rect *out, const dyd_cert_site *s) {
  dyd_status st = DYD_OK;
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    mpz_srcptr den;
    const dyd_exact *at = dyd_cert_place(&den, s, a);
    dyd_interval *side = a ? &out->y : &out->x;
    DYD_LOCAL(dyd_dyadic, v);
    DYD_LOCAL_NUMBERS(mpq, q);
    st = dyd_dyadic_set_z_2exp(&v, at->man, at->exp);
    dyd_dyadic_get_q(q, &v);
    if (den) mpz_mul(mpq_denref(q), mpq_denref(q), den);
    if (den) mpq_canonicalize(q);
    if (st == DYD_OK) st = dyd_interval_set_q(side, q);
  }
  return st;
}

/* Moves a place that another site has too to a point of the rectangle that depends on the number of the site. */
static dyd_status move_place(dyd_cert_site *s, uint32_t i, unsigned round) {
  DYD_LOCAL_ARRAY(dyd_exact, at, [2]);
  DYD_LOCAL(dyd_exact, width);
  uint64_t part[2] = {i, (i + 1) * UINT64_C(0x9E3779B97F4A7C15) >> 32};
  dyd_status st = DYD_OK;
  for (int a = 0; a < 2; a++) {
    if (s->side[a].den) st = DYD_E_ARG; /* a place is given in dyadics */
    dyd_exact_set(&at[a], &s->side[a].lo);
    if (s->side[a].point) continue;
    dyd_exact_sub(&width, &s->side[a].hi, &s->side[a].lo);
    mpz_mul_ui(width.man, width.man, 2 * (unsigned long)(part[a] ^ round * 0x5555u) + 1);
    width.exp -= 34;
    dyd_exact_add(&at[a], &at[a], &width);
    dyd_proof_trim(&at[a]);
  }
  if (st == DYD_OK) st = dyd_cert_site_set_place(s, at);
  return st == DYD_E_ARG ? DYD_OK : st;
}

/* Some sites of a proof. */
typedef struct proof_places {
  const dyd_proof *p;
  const uint32_t *site;
} proof_places;

static dyd_status rect_of_place(dyd_rect *out, const void *user, size_t k) {
  const proof_places *of = user;
  return place_rect(out, &of->p->sites.site[of->site[k]]);
}

/* ---- bridges ---- */

static bool bridge_join(uint32_t *parent, uint32_t a, uint32_t b) {
  a = dyd_cert_root(parent, a);
  b = dyd_cert_root(parent, b);
  parent[a] = b;
  return a != b;
}

static dyd_status add_bridges(dyd_proof *p, uint32_t *parent, const dyd_delaunay *pd, const uint32_t *site) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  DYD_LOCAL(dyd_point, c);
  dyd_status st = dyd_delaunay_pairs(&pairs, pd);
  for (size_t k = 0; k < pairs.count && st == DYD_OK; k++) {
    const dyd_pair *pair = &pairs.item[k];
    uint32_t i = site[pair->i], j = site[pair->j];
    if (pair->status != DYD_LEGAL || dyd_cert_root(parent, i) == dyd_cert_root(parent, j)) continue;
    bool found = false;
    st = dyd_delaunay_witness(&c, pd, pair->i, pair->j);
    if (st == DYD_OK) st = dyd_proof_add_witness(&found, &p->centre, p, i, j, &c, true);
    if (st == DYD_E_RANGE) st = DYD_OK; /* no witness: another bridge may do */
    if (st != DYD_OK || !found) continue;
    bridge_join(parent, i, j);
    st = dyd_cert_edges_add(&p->bridges, i, j);
  }
  return st;
}

/* *apart: no two places coincide; else places are moved, and it may be tried again. */
static dyd_status try_bridges(bool *apart, dyd_proof *p, uint32_t *parent, uint32_t *site, unsigned round) {
  const proof_places of = {p, site};
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options)};
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  size_t count = 0;
  for (size_t i = 0; i < p->sites.count; i++)
    if (p->sites.site[i].alias == i) site[count++] = (uint32_t)i;
  dyd_status st = dyd_delaunay_made(&pd, count, rect_of_place, &of, &o, NULL);
  if (st == DYD_CAPPED) st = DYD_OK; /* its legal pairs will do */
  *apart = true;
  for (size_t k = 0; st == DYD_OK && k < count; k++) {
    uint32_t other = dyd_delaunay_alias(pd, (uint32_t)k);
    if (other == k) continue;
    *apart = false;
    st = move_place(&p->sites.site[site[k]], site[k], round);
    if (st == DYD_OK) st = move_place(&p->sites.site[site[other]], site[other], round);
  }
  if (st == DYD_OK && *apart) st = add_bridges(p, parent, pd, site);
  return st;
}

/* Unites what the legal edges join; returns how many parts are left. */
static size_t bridge_unite(uint32_t *parent, const dyd_proof *p) {
  size_t parts = 0;
  for (size_t v = 0; v < p->sites.count; v++) {
    parent[v] = (uint32_t)v;
    parts += p->sites.site[v].alias == v;
  }
  for (size_t e = 0; e < p->legal.count; e++) parts -= bridge_join(parent, p->legal.item[e].i, p->legal.item[e].j);
  return parts;
}

/* Two joined sites with one place are possible when the two are all there are. */
static bool have_joined_places(const dyd_proof *p) {
  for (size_t e = 0; e < p->legal.count; e++)
    if (dyd_cert_compare_places(&p->sites, p->legal.item[e].i, p->legal.item[e].j) == 0) return true;
  return false;
}

dyd_status dyd_proof_find_bridges(dyd_proof *p) {
  size_t n = p->sites.count;
  DYD_FREED uint32_t *parent = dyd_alloc(n, sizeof *parent), *site = dyd_alloc(n, sizeof *site);
  dyd_status st = parent && site ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK && (bridge_unite(parent, p) > 1 || have_joined_places(p))) {
    bool apart = false;
    for (unsigned round = 0; round < 4 && st == DYD_OK && !apart; round++)
      st = try_bridges(&apart, p, parent, site, round);
    if (st == DYD_E_RANGE || (st == DYD_OK && !apart)) {
      dyd_proof_points_clear(&p->centre);
      p->bridges.count = 0;
      st = DYD_OK;
    }
  }
  return st;
}

typedef struct section {
  FILE *out;
  dyd_proof *proof;
  dyd_cert_window window;
  dyd_cert_chain polygon;
  dyd_cert_disc *disc; /* NULL: rectangles */
  dyd_exact area2;     /* twice the area of the polygons written */
} section;

/* ---- polygons ---- */

static bool polygon_passes(const section *s, uint32_t i) {
  const dyd_proof *p = s->proof;
  if (!dyd_cert_polygon_is_convex(&s->polygon)) return false;
  for (size_t k = 0; k < s->polygon.points; k++) {
    const dyd_exact *at = s->polygon.point[k];
    const bool inside = dyd_cert_is_witness(NULL, &p->sites, &p->tree, i, i, at, false) ||
                        (s->disc && dyd_cert_is_disc_witness(NULL, &p->sites, &p->tree, s->disc, i, i, at));
    if (!inside || !dyd_cert_window_has(&s->window, at)) return false;
  }
  return true;
}

static dyd_status section_polygon(void *context, uint32_t i, const dyd_shape *shape, const double area[2]) {
  section *s = context;
  DYD_SCOPED(dyd_polygon) polygon = {0};
  (void)area;
  dyd_status st = dyd_shape_inner(&polygon, shape);
  if (st == DYD_OK) st = dyd_cert_chain_resize(&s->polygon, polygon.count);
  for (size_t k = 0; st == DYD_OK && k < polygon.count; k++) {
    dyd_proof_set(&s->polygon.point[k][0], &polygon.vertex[k].x);
    dyd_proof_set(&s->polygon.point[k][1], &polygon.vertex[k].y);
  }
  if (st != DYD_OK || !polygon_passes(s, i)) return st;
  dyd_proof_put(s->out, "%i", i);
  for (size_t k = 0; k < s->polygon.points; k++) dyd_proof_put(s->out, " %p", s->polygon.point[k]);
  putc('\n', s->out);
  dyd_cert_polygon_area2(&s->area2, &s->polygon);
  return DYD_OK;
}

/* ---- bounds ---- */

/* x is rounded up by at most 2^-60 of itself. */
static void exact_round_up(dyd_exact *x) {
  int64_t exp = dyd_exact_top(x) - 61;
  if (dyd_exact_sgn(x) == 0 || exp <= x->exp) return;
  dyd_exact_ceil(x->man, x, NULL, exp);
  x->exp = exp;
}

static void section_area(section *s) {
  DYD_LOCAL(dyd_exact, left);
  dyd_cert_window_area(&left, &s->window);
  s->area2.exp--;
  dyd_exact_sub(&left, &left, &s->area2);
  exact_round_up(&left);
  dyd_proof_put(s->out, "undetermined %n\n", &left);
}

/* *bound, or up to four times as much, is proved, within the goal if one was reached; else *proved = false. */
static dyd_status section_prove_distance(bool *proved, dyd_exact *bound, const section *s, const dyd_exact *goal) {
  static const unsigned long sixteenths[] = {16, 17, 32, 64};
  DYD_LOCAL(dyd_exact, try);
  dyd_status st = DYD_OK;
  *proved = false;
  for (int k = 0; k < 4 && st == DYD_OK && !*proved; k++) {
    mpz_mul_ui(try.man, bound->man, sixteenths[k]);
    try.exp = bound->exp - 4;
    bool last = goal && dyd_exact_cmp(&try, goal) > 0;
    if (last) dyd_exact_set(&try, goal);
    st = dyd_cert_distance_holds(proved, &s->proof->sites, &s->window, &try);
    if (last) break;
  }
  if (st == DYD_OK && *proved) dyd_exact_set(bound, &try);
  return st;
}

static dyd_status section_distance(const section *s, const dyd_voronoi_bounds *b) {
  const dyd_engine *e = s->proof->engine;
  int64_t bits;
  bool asked =
      dyd_engine_goal(&bits, e) == DYD_GOAL_VORONOI_HAUSDORFF && dyd_engine_outcome(e) == DYD_OUTCOME_CERTIFIED;
  bool proved = false;
  if (!b->finite) {
    fputs("distance none\n", s->out);
    return DYD_OK;
  }
  DYD_LOCAL(dyd_exact, bound, goal);
  dyd_proof_set(&bound, &b->hausdorff);
  mpz_set_ui(goal.man, 1);
  goal.exp = -bits;
  dyd_status st = section_prove_distance(&proved, &bound, s, asked ? &goal : NULL);
  dyd_proof_put(s->out, proved ? "distance %n\n" : "distance %n unproved\n", &bound);
  return st;
}

/* ---- all ---- */

/* Fine for the eye; where a goal on the area was reached, as fine as that takes. */
static dyd_status section_bits(int64_t *out, const dyd_proof *p, const dyd_rect *window, bool discs) {
  enum { FINER = 8, MOST_FINER = 72 };
  int64_t goal_bits;
  *out = dyd_metric_coarseness(p->pd, window) + 4;
  if (dyd_engine_goal(&goal_bits, p->engine) != DYD_GOAL_VORONOI_AREA ||
      dyd_engine_outcome(p->engine) != DYD_OUTCOME_CERTIFIED)
    return DYD_OK;
  DYD_LOCAL(dyd_dyadic, goal);
  DYD_LOCAL(dyd_voronoi_bounds, b);
  dyd_status st = dyd_dyadic_set_si_2exp(&goal, 1, -goal_bits);
  int64_t least = dyd_metric_flattening(p->pd, window, goal_bits);
  bool holds = false;
  for (int finer = 0; st == DYD_OK && !holds && finer <= MOST_FINER; finer += FINER) {
    if (least + finer > *out) *out = least + finer;
    st = dyd_voronoi_bounds_within(&b, p->pd, window, *out, 0, discs, NULL);
    holds = st == DYD_OK && dyd_dyadic_cmp(&b.area, &goal) <= 0;
  }
  return st;
}

static dyd_status section_write(section *s, const dyd_rect *window) {
  int64_t bits;
  dyd_status st = section_bits(&bits, s->proof, window, s->disc);
  if (st != DYD_OK) return st;
  DYD_LOCAL(dyd_voronoi_bounds, bounds);
  DYD_SCOPED(dyd_voronoi_sums) sums;
  st = dyd_voronoi_sums_init(&sums, s->proof->pd, window, bits);
  sums.exact = false;
  sums.discs = s->disc;
  dyd_proof_put(s->out, "window %p %p\npolygons\n", &s->window.e[0], &s->window.e[2]);
  if (st == DYD_OK) st = dyd_voronoi_sums_all(&sums, section_polygon, s);
  if (st == DYD_OK) st = dyd_voronoi_sums_bounds(&bounds, &sums);
  if (st == DYD_OK) section_area(s);
  return st == DYD_OK ? section_distance(s, &bounds) : st;
}

dyd_status dyd_proof_put_diagram(FILE *out, dyd_proof *p, const dyd_rect *window, bool discs) {
  const dyd_dyadic *end[4] = {&window->x.lo, &window->x.hi, &window->y.lo, &window->y.hi};
  section s = {.out = out, .proof = p};
  if (dyd_delaunay_is_capped(p->pd)) return DYD_OK;
  dyd_cert_window_init(&s.window);
  dyd_cert_chain_init(&s.polygon);
  dyd_exact_init(&s.area2);
  for (int k = 0; k < 4; k++) dyd_proof_set(&s.window.e[k], end[k]);
  bool fixed;
  dyd_status st = discs ? dyd_proof_gather_discs(&s.disc, &fixed, p) : DYD_OK;
  if (st == DYD_OK) st = section_write(&s, window);
  dyd_proof_free_discs(s.disc, p);
  dyd_exact_clear(&s.area2);
  dyd_cert_chain_clear(&s.polygon);
  dyd_cert_window_clear(&s.window);
  return st;
}
