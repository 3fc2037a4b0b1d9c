/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How far each point may be from its place, rounded down [TOL-6].
 *
 * For every legal edge ij there is a circle about c(s) (lines.h), between i, j and all others: its radius is r + half,
 * where half is about half of f(s). Any double s will do. While no point comes to that circle, the edge stays. With D
 * the line of k at s, k is g = D / (sqrt(r^2 + D) + r) - half away from it: nothing cancels that is as large as r, so
 * errors are a few u of the distances between the points. At an end (half-planes) g is -p n / |J|.
 *
 * D has an error e_D (height_bound); g grows with D at most by 1 / (sqrt(r^2 + D) + r); the rest of the formula has a
 * relative error below 8 u. The search is for points that the circle may limit below the radius known so far: a branch
 * of the tree is skipped when it is farther from the circle, less errors, than the largest radius in it. Circles within
 * a window do not limit a point that is farther from the window than its radius, so the tree is searched once for each
 * window.
 *
 * In the max norm, with (a, b) the sizes of the coordinates of c - p, a >= b, and m the radius of the circle, the
 * square of half-width h about p comes to it by a corner, (a -+ h)^2 + (b -+ h)^2 = m^2: h = |a^2 + b^2 - m^2| / (a + b
 * + sqrt(2 m^2 - (a - b)^2)); from outside, where a - b >= m, by a side: h = a - m. That is at least distance /
 * sqrt(2), and a - m is never more than h. a, b, m are off by less than 2^-48 of a + m. */
#include "base/alloc.h"
#include "base/invariant.h"
#include "base/local.h"
#include "base/parallel.h"
#include "tolerance/state.h"

#include <float.h>
#include <math.h>
#include <mpfr.h>

/* The probability of an edge for Gaussian errors, from below [TOL-7].
 *
 * Any disc will do: with i and j in it and all others outside, ij is an edge. About the centre of the largest empty
 * annulus, which is rounded to doubles, and half way between its circles. Errors are independent, sigma in each
 * coordinate (of each point its own), so the probability is at least the product of
 *
 *   outside   Phi(x), x = (|c - p_k| - m) / sigma: beyond the tangent;
 *   inside    a sum over slabs across the direction from c: what the slab holds, times what of it is in a rectangle
 *             within the disc; or a square within a disc about p_i.
 *
 * Each point farther than REACH sigma outside counts as MISS. Phi is concave above 0: between two entries of a table,
 * rounded down, the chord is below it, by at most Phi'' h^2 / 8 < 0.242 / 8 / 512^2 < 1.16e-7. Entries are lowered by
 * 1e-13, which covers roundings (|x| < 10: a few 2^-50), and UP leaves as much. Distances are bounded as [FLT-DST] has
 * it; quotients and products, each off by 2^-53 of itself, are lowered by LESS. */

enum { PER_UNIT = 512, REACH = 9, ENTRIES = PER_UNIT * REACH + 2, SLABS = 48 };

#define MISS 1.2e-19 /* above 1 - Phi(9) */

#define UP 1.2e-7

#define LESS (1 - 0x1p-45)

#define FAR 0x1p20 /* a half-plane is a disc this many times as large as all */

#define NEVER 0x1p-40

/* ---- the normal distribution ---- */

/* 1 - erfc(x / sqrt 2) / 2, rounded down. */
static double phi_rounded(double x) {
  DYD_LOCAL_FLOATS(80, y, root);
  mpfr_sqrt_ui(root, 2, MPFR_RNDU);
  mpfr_set_d(y, x, MPFR_RNDD);
  mpfr_div(y, y, root, MPFR_RNDD);
  mpfr_erfc(y, y, MPFR_RNDU);
  mpfr_div_2ui(y, y, 1, MPFR_RNDU);
  mpfr_ui_sub(y, 1, y, MPFR_RNDD);
  return mpfr_get_d(y, MPFR_RNDD);
}

/* Below Phi(x), x >= 0. */
static double phi_table(const double *table, double x) {
  if (!(x < REACH)) return table[PER_UNIT * REACH];
  int k = (int)(x * PER_UNIT);
  return table[k] + (table[k + 1] - table[k]) * (x * PER_UNIT - k);
}

static double phi_lower(const double *table, double x) {
  return x >= 0 ? phi_table(table, x) : 1 - (phi_table(table, -x) + UP);
}

static double phi_upper(const double *table, double x) {
  return x >= 0 ? phi_table(table, x) + UP : 1 - phi_table(table, -x);
}

/* ---- one edge ---- */

typedef struct chance_pass {
  dyd_tolerance *t;
  const double *phi;
  const dyd_ring_d *ring;
  dyd_bbox at;
  double middle, product;
} chance_pass;

/* In units of sigma: p_i at `d` from the centre of a disc of radius `m`; slabs get thicker from its rim, or from 9, to
 * 8 on the other side of p_i. */
static double chance_inside(const double *phi, double m, double d) {
  double rim = fmin(m - d, REACH) * LESS, all = fmin(rim + 8, m + d + rim), sum = 0;
  for (int q = 0; q < SLABS && rim > 0; q++) {
    double depth = all * q * q / (SLABS * SLABS), next = all * (q + 1) * (q + 1) / (SLABS * SLABS);
    double outer = rim - depth, inner = rim - next, half2 = depth * (m + d + outer);
    if (d + inner < 0) half2 = fmin(half2, (m + d + inner - 0x1p-48 * (m + d)) * (m - d - inner));
    double mass = phi_lower(phi, outer) - phi_upper(phi, inner);
    if (half2 > 0 && mass > 0) sum += mass * fmax(0, 2 * phi_lower(phi, sqrt(half2) * LESS) - 1);
  }
  double side = 2 * phi_lower(phi, fmax(rim, 0) * 0.7071067811865 * LESS) - 1;
  return fmax(sum, side * side) * LESS;
}

static bool chance_outside(void *context, uint32_t k) {
  chance_pass *p = context;
  if (k == p->ring->i || k == p->ring->j) return true;
  double d = sqrt(fmax(dyd_ds2_lower(&p->at, &p->t->box[k]), 0)) * LESS, x = (d - p->middle) / p->t->sigma[k];
  p->product *= x > 0 ? phi_lower(p->phi, x * LESS) * LESS : 0;
  return p->product > NEVER;
}

static void set_chance_centre(chance_pass *p) {
  const dyd_xy *xy = p->t->points.xy;
  dyd_xy a = xy[p->ring->i], b = xy[p->ring->j];
  double jx = b.x - a.x, jy = b.y - a.y, s = p->ring->s;
  if (p->ring->end)
    s = p->ring->end * FAR * (p->t->sk->mesh.extent[0] + p->t->sk->mesh.extent[1]) / sqrt(jx * jx + jy * jy);
  double x = a.x + (jx / 2 - s * jy), y = a.y + (jy / 2 + s * jx);
  p->at = (dyd_bbox){{x, x, y, y}};
}

static double chance_of_ring(chance_pass *p) {
  double d[2], most = 0;
  set_chance_centre(p);
  for (int e = 0; e < 2; e++) {
    d[e] = sqrt(dyd_dl2_upper(&p->at, &p->t->box[e ? p->ring->j : p->ring->i])) * (1 + 0x1p-45);
    most = fmax(most, d[e]);
  }
  p->middle = most + p->ring->half;
  double reach = p->middle + REACH * p->t->widest, radius2 = dyd_upper(reach * reach) * (1 + 0x1p-45);
  if (!(radius2 < 1e300) || !(most > 0)) return 0;
  p->product = 1 - (double)p->t->sk->n * MISS;
  for (int e = 0; e < 2; e++) {
    double sigma = p->t->sigma[e ? p->ring->j : p->ring->i];
    p->product *= chance_inside(p->phi, p->middle / sigma, d[e] / sigma) * LESS;
  }
  if (p->product > NEVER) dyd_tree_near(&p->t->tree, &p->at, &radius2, chance_outside, p);
  return p->product > NEVER ? p->product : 0;
}

/* ---- all ---- */

dyd_status dyd_chances(dyd_tolerance *t) {
  dyd_status st = dyd_near_index(t);
  DYD_FREED double *phi = dyd_alloc(ENTRIES, sizeof *phi);
  t->chance = dyd_alloc(t->rows, sizeof *t->chance);
  if (!phi || !t->chance) st = DYD_E_NOMEM;
  for (int k = 0; k < ENTRIES && st == DYD_OK; k++) phi[k] = phi_rounded((double)k / PER_UNIT) - 1e-13;
  for (size_t r = 0; r < t->rows && st == DYD_OK; r++) {
    bool lasts = t->row[r].lo == HUGE_VAL;
    t->chance[r] = t->row[r].event != DYD_EVENT_DEATH ? 0 : lasts ? 1 : NAN; /* each NaN has its ring */
  }
  chance_pass p = {.t = t, .phi = phi};
  for (size_t k = 0; k < t->rings && st == DYD_OK; k++) {
    p.ring = &t->ring[k];
    if (dyd_flag_is_set(t->options.cancel)) st = DYD_CANCELLED;
    if (st == DYD_OK) t->chance[dyd_row_find(t, p.ring->i, p.ring->j)] = chance_of_ring(&p);
  }
  return st;
}

#define U 0x1p-53

enum { NEAR_MOST = 128 };

/* Half the width of a window, in radii of the circle in its middle. In the armed build it is as narrow as can be. */
#ifdef DYD_ARMED

#define WINDOW 1

#else

#define WINDOW 4

#endif

/* Of each range a copy, which has the circle at hand; radii belong to all. */
typedef struct radius_pass {
  dyd_tolerance *t;
  double *radius; /* by vertex */
  double *most;   /* by node of the tree: the largest radius in it; NULL: only ends are updated */
  dyd_lines_d lines;
  const dyd_ring_d *ring;
  double c[2], middle, doubt; /* centre, radius of the circle, bound of their errors; at an end: direction, offset */
  /* A window, and the points that circles within it may concern: circles that follow each other are near each other. */
  dyd_bbox window;
  uint32_t near[NEAR_MOST], count;
  bool open;
} radius_pass;

/* ---- radii ---- */

static double radius_now(double *radius) {
  double now;
  __atomic_load(radius, &now, __ATOMIC_RELAXED);
  return now;
}

/* The least of all circles, which does not depend on their order. */
static void keep_least(double *radius, double r) {
  double now = radius_now(radius), least = r > 0 ? r * (1 - 4 * U) : 0;
  while (least < now && !__atomic_compare_exchange(radius, &now, &least, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
}

/* ---- one point, one circle ---- */

static double height_bound(const dyd_line_d *o, double s) {
  return o->em + 2 * fabs(s) * o->en + 4 * U * (fabs(o->m) + 2 * fabs(o->n * s));
}

/* A lower bound of g; NaN counts as 0. */
static double gap_of(const dyd_lines_d *l, const dyd_line_d *o, const dyd_ring_d *ring) {
  double g;
  if (ring->end) {
    g = (-ring->end * o->n - o->en) / sqrt(l->jj) - fabs(o->n / sqrt(l->jj)) * (l->ejj / l->jj + 8 * U);
  } else {
    double r = sqrt(l->jj * (0.25 + ring->s * ring->s)) * (1 + l->ejj / l->jj + 8 * U);
    double D = o->m - 2 * o->n * ring->s - height_bound(o, ring->s) * (1 + 0x1p-20);
    g = D > 0 ? D / (sqrt(r * r + D) + r) * (1 - 16 * U) : 0;
  }
  return g > 0 ? g : 0;
}

/* Of the point at (x, y) from p_i, which is `gap` away from the circle, or more: how far in the max norm. */
static double square_gap(const radius_pass *p, double x, double y, double gap, bool inside) {
  const dyd_lines_d *l = &p->lines;
  double s = p->ring->s, size = sqrt(l->jj) * (1 - 0x1p-40);
  if (p->ring->end) return gap * (size / (fabs(l->jx) + fabs(l->jy)));
  double c = fabs(l->jx / 2 - s * l->jy - x), d = fabs(l->jy / 2 + s * l->jx - y), a = fmax(c, d), b = fmin(c, d);
  double m = sqrt(l->jj * (0.25 + s * s)) + p->ring->half, D = gap * (inside ? 2 * m - gap : 2 * m + gap);
  if (!inside && !(a - b < m * (1 - 0x1p-30))) return fmax(gap * 0.7071, a - m - 0x1p-46 * (a + m));
  return D / (a + b + sqrt(2 * m * m - (a - b) * (a - b))) * (1 - 0x1p-40);
}

/* The radius that the circle allows k, which is not one of its ends. */
static double radius_beside(const radius_pass *p, uint32_t k) {
  dyd_line_d line;
  dyd_filter_line(&line, &p->lines, &p->t->points, k);
  double gap = gap_of(&p->lines, &line, p->ring) - p->ring->half;
  return gap > 0 && p->t->options.metric == DYD_METRIC_BOX ? square_gap(p, line.px, line.py, gap, false) : gap;
}

static bool look_at(radius_pass *p, uint32_t k) {
  if (k != p->lines.i && k != p->lines.j) keep_least(&p->radius[k], radius_beside(p, k));
  return true;
}

/* ---- all points of one circle ---- */

/* The circle in plain coordinates; for branches only, so that a generous doubt will do. */
static void place_ring(radius_pass *p) {
  const dyd_lines_d *l = &p->lines;
  dyd_xy i = p->t->points.xy[l->i];
  double size = sqrt(l->jj), s = p->ring->s;
  if (p->ring->end) {
    p->c[0] = p->ring->end * l->jy / size; /* towards the others: against end J' */
    p->c[1] = -p->ring->end * l->jx / size;
    p->middle = p->c[0] * i.x + p->c[1] * i.y + p->ring->half;
    p->doubt = 0x1p-40 * (fabs(i.x) + fabs(i.y) + p->ring->half);
    return;
  }
  p->c[0] = i.x + (l->jx / 2 - s * l->jy);
  p->c[1] = i.y + (l->jy / 2 + s * l->jx);
  p->middle = size * sqrt(0.25 + s * s) + p->ring->half;
  p->doubt = 0x1p-40 * (fabs(i.x) + fabs(i.y) + p->middle);
}

/* What distances are compared with: in the max norm, whatever is farther than sqrt(2) times the radius is clear. */
static double clear_reach(const radius_pass *p, const dyd_bbox *b, double radius) {
  const double *e = b->e, wide = p->t->options.metric == DYD_METRIC_BOX ? 0x1.6a1p0 : 1;
  double far = dyd_max(dyd_max(fabs(e[0]), fabs(e[1])), dyd_max(fabs(e[2]), fabs(e[3])));
  return radius * wide + p->doubt + 0x1p-40 * far;
}

/* Returns true if whatever lies in the box is farther from the circle than `radius`, beyond all errors. */
static bool is_clear_of_circle(const radius_pass *p, const dyd_bbox *b, double radius) {
  const double *e = b->e, reach = clear_reach(p, b, radius) + p->middle;
  if (p->ring->end) return p->c[0] * e[p->c[0] > 0 ? 0 : 1] + p->c[1] * e[p->c[1] > 0 ? 2 : 3] > reach;
  double x = dyd_max(dyd_max(e[0] - p->c[0], p->c[0] - e[1]), 0);
  double y = dyd_max(dyd_max(e[2] - p->c[1], p->c[1] - e[3]), 0);
  return x * x + y * y > reach * reach;
}

/* The same of the window. */
static bool is_clear_of_window(const radius_pass *p, const dyd_bbox *b, double radius) {
  const double *e = b->e, *w = p->window.e, reach = clear_reach(p, b, radius);
  return e[0] - w[1] > reach || w[0] - e[1] > reach || e[2] - w[3] > reach || w[2] - e[3] > reach;
}

typedef bool clear_test(const radius_pass *p, const dyd_bbox *b, double radius);

/* Visits all points that are not clear; false: the visitor ended it. */
static bool visit_branch(radius_pass *p, clear_test *clear, bool (*visit)(radius_pass *p, uint32_t k), int level,
                         size_t node) {
  const dyd_tree *t = &p->t->tree;
  size_t at = t->level[level] + node, first, end;
  if (clear(p, &t->node[at], p->most[at])) return true;
  dyd_tree_children(&first, &end, t, level, node);
  for (size_t q = first; q < end; q++) {
    uint32_t k = level ? 0 : t->item[q];
    if (level ? !visit_branch(p, clear, visit, level - 1, q)
              : !clear(p, &t->box[k], radius_now(&p->radius[k])) && !visit(p, k))
      return false;
  }
  return true;
}

static bool visit_all(radius_pass *p, clear_test *clear, bool (*visit)(radius_pass *p, uint32_t k)) {
  return visit_branch(p, clear, visit, p->t->tree.levels - 1, 0);
}

static bool keep_near(radius_pass *p, uint32_t k) {
  if (p->count < NEAR_MOST) p->near[p->count++] = k;
  return p->count < NEAR_MOST;
}

static bool is_in_window(const radius_pass *p) {
  const double *w = p->window.e, r = p->middle + p->doubt;
  return p->c[0] - r >= w[0] && p->c[0] + r <= w[1] && p->c[1] - r >= w[2] && p->c[1] + r <= w[3];
}

/* A new window, unless too many are in it. */
static void open_window(radius_pass *p) {
  double r = WINDOW * (p->middle + p->doubt);
  p->window = (dyd_bbox){{p->c[0] - r, p->c[0] + r, p->c[1] - r, p->c[1] + r}};
  p->count = 0;
  p->open = !p->ring->end && visit_all(p, is_clear_of_window, keep_near);
}

static void visit_others(radius_pass *p) {
  if (p->ring->end || !p->open || !is_in_window(p)) open_window(p);
  if (!p->open) visit_all(p, is_clear_of_circle, look_at);
  for (uint32_t q = 0; p->open && q < p->count; q++)
    if (!is_clear_of_circle(p, &p->t->box[p->near[q]], radius_now(&p->radius[p->near[q]]))) look_at(p, p->near[q]);
}

/* Checks that the circle does not limit a point that the tree skipped. */
static void check_others(const radius_pass *p) {
#ifdef DYD_ARMED
  enum { FEW = 2000 };
  for (uint32_t k = 0; k < p->t->sk->n && p->t->sk->n <= FEW; k++)
    if (k != p->lines.i && k != p->lines.j && dyd_mesh_alias(&p->t->sk->mesh, k) == DYD_NONE)
      DYD_INVARIANT(!(radius_beside(p, k) < radius_now(&p->radius[k])));
#else
  (void)p;
#endif
}

/* ---- all circles ---- */

static bool make_most(radius_pass *p) {
  const dyd_tree *t = &p->t->tree;
  p->most = dyd_alloc(t->level[t->levels], sizeof *p->most);
  if (!p->most) return false;
  for (int k = 0; k < t->levels; k++)
    for (size_t q = 0; q < t->level[k + 1] - t->level[k]; q++) {
      size_t first, end;
      double most = 0;
      dyd_tree_children(&first, &end, t, k, q);
      for (size_t e = first; e < end; e++)
        most = dyd_max(most, k ? p->most[t->level[k - 1] + e] : p->radius[t->item[e]]);
      p->most[t->level[k] + q] = most;
    }
  return true;
}

/* Its ends, or, in the second pass, all other points. Where doubles cannot hold the pair, all radii become 0. */
static void pass_ring(radius_pass *p, const dyd_ring_d *ring) {
  const dyd_tolerance *t = p->t;
  dyd_lines_d *l = &p->lines;
  bool good = dyd_filter_pair(l, &t->points, ring->i, ring->j) && ring->half > 0 && ring->half <= DBL_MAX;
  p->ring = ring;
  if (!good) {
    for (uint32_t v = 0; v < t->sk->n; v++) keep_least(&p->radius[v], 0);
  } else if (!p->most) {
    bool box = t->options.metric == DYD_METRIC_BOX;
    keep_least(&p->radius[ring->i], box ? square_gap(p, 0, 0, ring->half, true) : ring->half);
    keep_least(&p->radius[ring->j], box ? square_gap(p, l->jx, l->jy, ring->half, true) : ring->half);
  } else {
    place_ring(p);
    visit_others(p);
    check_others(p);
  }
}

static void pass_range(void *context, size_t number) {
  const radius_pass *all = context;
  radius_pass p = {.t = all->t, .radius = all->radius, .most = all->most};
  size_t end = dyd_range_begin(p.t->rings, number + 1);
  for (size_t k = dyd_range_begin(p.t->rings, number); k < end && !dyd_flag_is_set(p.t->options.cancel); k++)
    pass_ring(&p, &p.t->ring[k]);
}

static void pass_rings(radius_pass *p) {
  dyd_parallel(p->t->pd->options.threads, dyd_ranges(p->t->rings), pass_range, p);
}

/* A tie may be decided by the least motion of any point of the face. */
static dyd_status clear_tied(radius_pass *p) {
  const dyd_delaunay *pd = p->t->pd;
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < pd->open.count && st == DYD_OK; f++) {
    DYD_FREED uint32_t *v = NULL;
    size_t count = 0;
    st = dyd_open_vertices(&v, &count, pd, f);
    for (size_t q = 0; q < count && st == DYD_OK; q++) p->radius[v[q]] = 0;
  }
  return st;
}

static dyd_status pass_hull(radius_pass *p) {
  const dyd_mesh *m = &p->t->sk->mesh;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  dyd_status st = DYD_OK;
  do {
    double lo, hi;
    dyd_half_edge next = dyd_hull_following(m, h);
    st = dyd_hull_corner(&lo, &hi, p->t, h, false);
    keep_least(&p->radius[dyd_hull_origin(m, h)], lo);
    keep_least(&p->radius[dyd_hull_target(m, h)], lo);
    keep_least(&p->radius[dyd_hull_target(m, next)], lo);
    h = next;
  } while (st == DYD_OK && h != first);
  return st;
}

static dyd_status pass_all(radius_pass *p) {
  dyd_tolerance *t = p->t;
  for (uint32_t v = 0; v < t->sk->n; v++) p->radius[v] = HUGE_VAL;
  pass_rings(p);
  dyd_status st = clear_tied(p);
  if (st == DYD_OK && !dyd_is_line(t->pd)) st = pass_hull(p);
  if (st == DYD_OK) st = dyd_near_index(t);
  if (st != DYD_OK || t->tree.count == 0) return st;
  if (!make_most(p)) return DYD_E_NOMEM;
  pass_rings(p);
  return dyd_flag_is_set(t->options.cancel) ? DYD_CANCELLED : DYD_OK;
}

dyd_status dyd_points_radius(dyd_tolerance *t) {
  radius_pass p = {.t = t, .radius = dyd_alloc(t->sk->n, sizeof *p.radius)};
  t->radius = dyd_alloc(t->sk->n, sizeof *t->radius);
  dyd_status st = p.radius && t->radius ? pass_all(&p) : DYD_E_NOMEM;
  for (uint32_t i = 0; st == DYD_OK && i < t->sk->n; i++) t->radius[i] = p.radius[t->sk->vertex[i]];
  dyd_free_all(p.radius, p.most);
  return st;
}
