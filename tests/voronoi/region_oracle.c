/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Crossing counts, samples and literal definitions in the oracle's rationals and a + b sqrt(c). */
#include "voronoi/region_oracle.h"

static mpq_srcptr quotient(orc_pool *p, const mpz_t a, const mpz_t d) {
  mpq_ptr q = orc_new(p);
  mpz_set(mpq_numref(q), a);
  mpz_set(mpq_denref(q), d);
  mpq_canonicalize(q);
  return q;
}

orc_point region_point(orc_pool *p, const dyd_surd_point *s) {
  mpz_t one;
  mpz_init_set_ui(one, 1);
  mpq_srcptr c = quotient(p, s->c, one);
  mpz_clear(one);
  return (orc_point){{quotient(p, s->ax, s->d), quotient(p, s->bx, s->d), c},
                     {quotient(p, s->ay, s->d), quotient(p, s->by, s->d), c}};
}

static orc_alg coordinate(orc_point c, int axis) {
  return axis ? c.y : c.x;
}

/* ---- the geometry of an arc ---- */

/* A segment of a line n.(2c - m) = 0, or of the parabola (t - s_k)^2 = h (2v - l - s_o), k the directrix axis (else
 * -1). dir: the way from begin to end: the sign of each coordinate's change near infinity. */
typedef struct curve {
  int k;
  mpq_srcptr n[2], m[2], s[2], l, h;
  int dir[2];
  bool infinite[2];
  orc_point end[2];
} curve;

static void set_window_side(curve *out, orc_pool *p) {
  for (int a = 0; a < 2; a++) {
    out->dir[a] = orc_alg_cmp(p, coordinate(out->end[1], a), coordinate(out->end[0], a));
    out->n[a] = orc_si(p, out->dir[a] == 0, 1);
    out->m[a] = orc_twice(p, coordinate(out->end[0], a).a);
  }
}

static void set_line(curve *out, orc_pool *p, const orc_rect *near, int feature, int turn) {
  mpq_srcptr q[2] = {near->e[feature & 1], near->e[2 + (feature >> 1)]};
  for (int a = 0; a < 2; a++) {
    out->n[a] = orc_sub(p, q[a], out->s[a]);
    out->m[a] = orc_add(p, q[a], out->s[a]);
  }
  out->dir[0] = -turn * mpq_sgn(out->n[1]);
  out->dir[1] = turn * mpq_sgn(out->n[0]);
}

static void set_parabola(curve *out, orc_pool *p, const orc_rect *near, int side, int turn) {
  int o = side < 6 ? 0 : 1;
  out->k = 1 - o;
  out->l = near->e[side - 4];
  out->h = orc_sub(p, out->s[o], out->l);
  int opens = mpq_sgn(out->h), along = turn * (out->k == 0 ? opens : -opens);
  out->dir[out->k] = along;
  out->dir[o] = 0; /* grows with h at both ends */
}

static curve read_arc(orc_pool *p, const region *g, const dyd_arc *a) {
  curve out = {.k = -1, .infinite = {a->begin.kind == DYD_END_INFINITE, a->end.kind == DYD_END_INFINITE}};
  if (!out.infinite[0]) out.end[0] = region_point(p, &a->begin.at);
  if (!out.infinite[1]) out.end[1] = region_point(p, &a->end.at);
  if (a->kind == DYD_ARC_WINDOW) return set_window_side(&out, p), out;
  const orc_rect *far = &g->c->rect[a->far_site], *near = &g->c->rect[a->near_site];
  out.s[0] = far->e[a->corner & 1];
  out.s[1] = far->e[2 + (a->corner >> 1)];
  int turn = g->outer ? -1 : 1;
  if (a->kind == DYD_ARC_LINE)
    set_line(&out, p, near, (int)a->feature, turn);
  else
    set_parabola(&out, p, near, (int)a->feature, turn);
  return out;
}

/* The other coordinate on a line or along a directrix: given t along axis u. */
static mpq_srcptr other_on(orc_pool *p, const curve *c, int u, mpq_srcptr t) {
  int v = 1 - u;
  if (c->k == u) {
    mpq_srcptr q = orc_div(p, orc_sqr(p, orc_sub(p, t, c->s[u])), c->h);
    return orc_mid(p, q, orc_add(p, c->l, c->s[v]));
  }
  mpq_srcptr w = orc_div(p, orc_mul(p, c->n[u], orc_sub(p, c->m[u], orc_twice(p, t))), c->n[v]);
  return orc_mid(p, w, c->m[v]);
}

/* ---- on the boundary ---- */

static int compare_q(mpq_srcptr a, mpq_srcptr b) {
  int s = mpq_cmp(a, b);
  return (s > 0) - (s < 0);
}

/* Returns true if t is between the ends of the arc along axis u. */
static bool between_ends(orc_pool *p, const curve *c, int u, mpq_srcptr t) {
  int sides[2];
  for (int e = 0; e < 2; e++)
    sides[e] = c->infinite[e] ? (e ? c->dir[u] : -c->dir[u]) : orc_alg_cmp_q(p, coordinate(c->end[e], u), t);
  return sides[0] * sides[1] <= 0;
}

static bool is_on(orc_pool *p, const curve *c, mpq_srcptr x, mpq_srcptr y) {
  mpq_srcptr at[2] = {x, y};
  int u = c->k >= 0 ? c->k : mpq_sgn(c->n[1]) ? 0 : 1;
  if (compare_q(other_on(p, c, u, at[u]), at[1 - u])) return false;
  return between_ends(p, c, u, at[u]);
}

/* ---- crossings ---- */

/* Sums over the crossings with the line through (at) along axis v, those above at, those below; a point exactly on it
 * counts as slightly beyond. up: 1 for arcs along which u grows. */
typedef struct tally {
  int above, below;
} tally;

/* Where an end is relative to the line u = t, shifted slightly up: 1 beyond, -1 not. from: 1 the end, 0 the beginning.
 */
static int end_beyond(orc_pool *p, const curve *c, int e, int u, mpq_srcptr t) {
  if (!c->infinite[e]) return orc_alg_cmp_q(p, coordinate(c->end[e], u), t) > 0 ? 1 : -1;
  if (c->k >= 0 && c->k != u) return mpq_sgn(c->h) > 0 ? 1 : -1;
  return e ? c->dir[u] : -c->dir[u];
}

static void count(tally *out, int from, int to, int where) {
  if (from == to) return;
  int up = to > from ? 1 : -1;
  if (where > 0) out->above += up;
  if (where < 0) out->below += up;
}

/* Parabola with its directrix along v: two branches around the apex (u0, s_v). */
static void cross_branches(tally *out, orc_pool *p, const curve *c, int u, const mpq_srcptr at[2]) {
  int v = 1 - u;
  mpq_srcptr apex = orc_mid(p, c->l, c->s[u]);
  mpq_srcptr d = orc_mul(p, c->h, orc_sub(p, orc_twice(p, at[u]), orc_add(p, c->l, c->s[u])));
  int apex_beyond = compare_q(apex, at[u]) > 0 ? 1 : -1, side[2];
  for (int e = 0; e < 2; e++)
    side[e] = c->infinite[e] ? (e ? c->dir[v] : -c->dir[v]) : orc_alg_cmp_q(p, coordinate(c->end[e], v), c->s[v]);
  for (int branch = -1; branch <= 1; branch += 2) {
    int where = 0;
    if (mpq_sgn(d) >= 0) {
      orc_alg root = {c->s[v], orc_si(p, branch, 1), d};
      where = orc_alg_cmp_q(p, root, at[v]);
    }
    bool from = side[0] * branch > 0, to = side[1] * branch > 0;
    if (!from && !to) continue;
    count(out, from ? end_beyond(p, c, 0, u, at[u]) : apex_beyond, to ? end_beyond(p, c, 1, u, at[u]) : apex_beyond,
          where);
  }
}

static void cross(tally *out, orc_pool *p, const curve *c, int u, const mpq_srcptr at[2]) {
  int v = 1 - u;
  if (c->k == v) {
    cross_branches(out, p, c, u, at);
    return;
  }
  if (c->k < 0 && !mpq_sgn(c->n[v])) return; /* u is constant */
  count(out, end_beyond(p, c, 0, u, at[u]), end_beyond(p, c, 1, u, at[u]), compare_q(other_on(p, c, u, at[u]), at[v]));
}

int region_side(orc_pool *p, const region *g, mpq_srcptr x, mpq_srcptr y) {
  const mpq_srcptr at[2] = {x, y};
  tally t[2] = {{0, 0}, {0, 0}};
  bool closed = true;
  if (!g->b->count) return g->b->whole ? 1 : -1;
  for (size_t m = 0; m < g->b->count; m++) {
    const dyd_chain *chain = &g->b->chain[m];
    closed = closed && chain->closed;
    for (size_t k = 0; k < chain->count; k++) {
      curve c = read_arc(p, g, &chain->arc[k]);
      if (is_on(p, &c, x, y)) return 0;
      for (int u = 0; u < 2; u++) cross(&t[u], p, &c, u, at);
    }
  }
  /* above: along y the region is below an arc on which x falls; along x it is before one on which y grows */
  int vote[4] = {-t[0].above, t[0].below, t[1].above, -t[1].below}, in = 0, out = 0;
  for (int k = 0; k < 4; k++) {
    if (vote[k] > 1 || vote[k] < -1 || (closed && vote[k] < 0)) return -2;
    in += vote[k] == 1 || (closed && vote[k] == 1);
    out += vote[k] == -1 || (closed && vote[k] == 0);
  }
  if (in && out) return -2;
  return in ? 1 : out ? -1 : 2;
}

/* ---- samples ---- */

orc_point region_sample(orc_pool *p, const region *g, const dyd_arc *a) {
  curve c = read_arc(p, g, a);
  int u = c.k >= 0 ? c.k : mpq_sgn(c.n[1]) ? 0 : 1;
  int lower = c.dir[u] > 0 ? 0 : 1;
  mpq_srcptr t;
  if (c.infinite[0] && c.infinite[1])
    t = orc_si(p, 0, 1);
  else if (c.infinite[lower])
    t = orc_sub(p, orc_alg_near(p, coordinate(c.end[1 - lower], u), 8), orc_si(p, 5, 1));
  else if (c.infinite[1 - lower])
    t = orc_add(p, orc_alg_near(p, coordinate(c.end[lower], u), 8), orc_si(p, 5, 1));
  else
    t = orc_alg_between(p, coordinate(c.end[lower], u), coordinate(c.end[1 - lower], u));
  orc_alg along = orc_alg_q(p, t), across = orc_alg_q(p, other_on(p, &c, u, t));
  return u ? (orc_point){across, along} : (orc_point){along, across};
}

/* ---- the definition ---- */

static int window_side(orc_pool *p, const orc_rect *w, orc_point at) {
  int least = 1;
  for (int e = 0; e < 4; e++) {
    int s = orc_alg_cmp_q(p, e < 2 ? at.x : at.y, w->e[e]);
    if (e & 1) s = -s;
    if (s < least) least = s;
  }
  return least;
}

int literal_side(orc_pool *p, const region *g, size_t site, orc_point at) {
  int least = g->window ? window_side(p, g->window, at) : 1;
  const orc_rect *r = &g->c->rect[site];
  orc_alg own = g->outer ? orc_ds2(p, at, r) : orc_dl2(p, at, r);
  for (size_t k = 0; k < g->c->n && least >= 0; k++) {
    const orc_rect *q = &g->c->rect[k];
    if (k == site || orc_case_alias(g->c, k) == orc_case_alias(g->c, site)) continue;
    if (orc_rect_meets(r, q)) {
      if (!g->outer) return -1;
      continue;
    }
    int s = orc_alg_cmp(p, g->outer ? orc_dl2(p, at, q) : orc_ds2(p, at, q), own);
    if (s < least) least = s;
  }
  return least;
}

/* ---- what arc.h states ---- */

static bool same_point(orc_pool *p, orc_point a, orc_point b) {
  return !orc_alg_cmp(p, a.x, b.x) && !orc_alg_cmp(p, a.y, b.y);
}

static bool is_low(mpq_srcptr lo, mpq_srcptr hi, bool upper) {
  return !(upper && mpq_equal(lo, hi));
}

/* Returns true if the names are those of the lower bits where sides are degenerate. */
static bool named_right(const region *g, const dyd_arc *a) {
  const orc_rect *far = &g->c->rect[a->far_site], *near = &g->c->rect[a->near_site];
  if (a->corner > DYD_CORNER_11 || (a->kind == DYD_ARC_LINE) != (a->feature <= DYD_CORNER_11)) return false;
  if (!is_low(far->e[0], far->e[1], a->corner & 1) || !is_low(far->e[2], far->e[3], a->corner >> 1 & 1)) return false;
  if (a->kind == DYD_ARC_LINE)
    return is_low(near->e[0], near->e[1], a->feature & 1) && is_low(near->e[2], near->e[3], a->feature >> 1 & 1);
  int axis = a->feature >= DYD_SIDE_Y0;
  return is_low(near->e[2 * axis], near->e[2 * axis + 1], a->feature & 1);
}

/* |at - corner|^2 = (distance to the feature)^2 = dl_far^2 = ds_near^2 */
static bool equation_holds(orc_pool *p, const region *g, const dyd_arc *a, orc_point at) {
  const orc_rect *far = &g->c->rect[a->far_site], *near = &g->c->rect[a->near_site];
  orc_alg s = orc_alg_add(p, orc_alg_sqr(p, orc_alg_sub_q(p, at.x, far->e[a->corner & 1])),
                          orc_alg_sqr(p, orc_alg_sub_q(p, at.y, far->e[2 + (a->corner >> 1)])));
  orc_alg q;
  if (a->kind == DYD_ARC_LINE)
    q = orc_alg_add(p, orc_alg_sqr(p, orc_alg_sub_q(p, at.x, near->e[a->feature & 1])),
                    orc_alg_sqr(p, orc_alg_sub_q(p, at.y, near->e[2 + (a->feature >> 1)])));
  else
    q = orc_alg_sqr(p, orc_alg_sub_q(p, a->feature < DYD_SIDE_Y0 ? at.x : at.y, near->e[a->feature - 4]));
  return !orc_alg_cmp(p, s, q) && !orc_alg_cmp(p, s, orc_dl2(p, at, far)) && !orc_alg_cmp(p, s, orc_ds2(p, at, near));
}

static bool on_window(orc_pool *p, const region *g, orc_point at) {
  return g->window && window_side(p, g->window, at) == 0;
}

/* Returns true if the point is on a middle line of the rectangle, on the line of a side of it. */
static bool on_middle(orc_pool *p, const orc_rect *r, orc_point at) {
  return !orc_alg_cmp_q(p, at.x, orc_mid(p, r->e[0], r->e[1])) || !orc_alg_cmp_q(p, at.y, orc_mid(p, r->e[2], r->e[3]));
}
static bool on_side_line(orc_pool *p, const orc_rect *r, orc_point at) {
  for (int e = 0; e < 4; e++)
    if (!orc_alg_cmp_q(p, e < 2 ? at.x : at.y, r->e[e])) return true;
  return false;
}

static bool all_are_points(const orc_case *c) {
  for (size_t k = 0; k < c->n; k++)
    if (!mpq_equal(c->rect[k].e[0], c->rect[k].e[1]) || !mpq_equal(c->rect[k].e[2], c->rect[k].e[3])) return false;
  return true;
}

/* Returns true if `site` is the lowest third site at the radius. Of exact points, on one circle perhaps, is it any of
 * them? */
static bool is_third_site(orc_pool *p, const region *g, const dyd_arc *a, orc_point at, size_t site) {
  size_t own = g->outer ? a->near_site : a->far_site, other = g->outer ? a->far_site : a->near_site;
  orc_alg r = orc_dl2(p, at, &g->c->rect[a->far_site]);
  for (size_t k = all_are_points(g->c) ? site : 0; k < g->c->n; k++) {
    if (k == own || k == other || orc_case_alias(g->c, k) != k) continue;
    const orc_rect *q = &g->c->rect[k];
    if (orc_rect_meets(q, &g->c->rect[own])) continue;
    if (!orc_alg_cmp(p, g->outer ? orc_dl2(p, at, q) : orc_ds2(p, at, q), r)) return k == site;
  }
  return false;
}

static bool end_is_right(orc_pool *p, const region *g, const dyd_arc *a, const dyd_arc_end *e, const dyd_arc *beyond) {
  if (e->kind == DYD_END_INFINITE) return !g->window;
  orc_point at = region_point(p, &e->at);
  if (a->kind == DYD_ARC_WINDOW) return e->kind == DYD_END_WINDOW && on_window(p, g, at);
  if (!equation_holds(p, g, a, at)) return false;
  bool same =
      beyond && beyond->kind != DYD_ARC_WINDOW && beyond->far_site == a->far_site && beyond->near_site == a->near_site;
  switch (e->kind) {
  case DYD_END_SITES:
    return !same && is_third_site(p, g, a, at, e->site);
  case DYD_END_AXIS:
    return same && beyond->corner != a->corner && on_middle(p, &g->c->rect[a->far_site], at);
  case DYD_END_FEATURE:
    return same && beyond->corner == a->corner && beyond->feature != a->feature &&
           on_side_line(p, &g->c->rect[a->near_site], at);
  case DYD_END_WINDOW:
    return on_window(p, g, at);
  default:
    return false;
  }
}

static bool arc_is_right(char *message, orc_pool *p, const region *g, size_t site, const dyd_chain *chain, size_t k) {
  const dyd_arc *a = &chain->arc[k];
  const dyd_arc *before = k ? a - 1 : chain->closed ? &chain->arc[chain->count - 1] : NULL;
  const dyd_arc *after = k + 1 < chain->count ? a + 1 : chain->closed ? &chain->arc[0] : NULL;
  if (a->kind != DYD_ARC_WINDOW) {
    if ((g->outer ? a->near_site : a->far_site) != site) return wrong(message, "arc %zu: wrong site", k);
    if (!named_right(g, a)) return wrong(message, "arc %zu: corner %d, feature %d", k, (int)a->corner, (int)a->feature);
  }
  if (!before != (a->begin.kind == DYD_END_INFINITE) || !after != (a->end.kind == DYD_END_INFINITE))
    return wrong(message, "arc %zu: infinite ends", k);
  if (!end_is_right(p, g, a, &a->begin, before)) return wrong(message, "arc %zu: begin of kind %d", k, a->begin.kind);
  if (!end_is_right(p, g, a, &a->end, after)) return wrong(message, "arc %zu: end of kind %d", k, a->end.kind);
  if (after && !same_point(p, region_point(p, &a->end.at), region_point(p, &after->begin.at)))
    return wrong(message, "arc %zu: a gap behind it", k);
  orc_point at = region_sample(p, g, a);
  if (a->kind != DYD_ARC_WINDOW && !equation_holds(p, g, a, at)) return wrong(message, "arc %zu: sample is off", k);
  if (literal_side(p, g, site, at)) return wrong(message, "arc %zu: sample is not on the boundary", k);
  return true;
}

bool region_is_sound(char *message, orc_pool *p, const region *g, size_t site) {
  if (!g->b->count) return true;
  for (size_t m = 0; m < g->b->count; m++) {
    const dyd_chain *chain = &g->b->chain[m];
    if (!chain->count) return wrong(message, "empty chain");
    if (g->window && !chain->closed) return wrong(message, "open chain on a window");
    for (size_t k = 0; k < chain->count; k++) {
      size_t mark = orc_mark(p);
      if (!arc_is_right(message, p, g, site, chain, k)) return false;
      orc_release(p, mark);
    }
  }
  return true;
}
