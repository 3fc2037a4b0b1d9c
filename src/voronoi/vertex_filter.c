/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of Voronoi vertices in doubles [VERT-1].
 *
 * Let z be any point, q_0, q_1, q_2 a choice, a = q_1 - q_0, b = q_2 - q_0, c the circumcentre, h = c - z. From
 * 2 a.c = |q_1|^2 - |q_0|^2 follows 2 a.h = |q_1 - z|^2 - |q_0 - z|^2 =: A, likewise 2 b.h = B, so
 *   h_x = (A b_y - B a_y) / (2 a x b),   h_y = (B a_x - A b_x) / (2 a x b).
 * A, B are bounded by ds, dl at z [FLT-DST], a and b by the corners of the boxes, a x b from below by its value at the
 * middles less its variation. All quantities are sums, products and quotients of at most 20 operations each, so the
 * factors 1 +- 32 u put them on the safe side; a denominator below 2^-400 is refused, so that underflow (at most
 * 2^-1075 an operation) is covered by the same factors. */
#include "voronoi/vertex_filter.h"

#include "base/alloc.h"
#include "predicate/interval_filter.h"
#include "voronoi/shape.h"

#include <math.h>
#include <string.h>

#define SAFE (1 + 32 * 0x1p-53)

/* A vector known up to its radius in each coordinate. */
typedef struct ball2 {
  double x, y, rx, ry;
} ball2;

/* q_k - q_0 by boxes: middle of the representatives' difference, radius to the farthest corner. */
static ball2 ball_difference(const dyd_bbox *p, const dyd_bbox *q, dyd_xy mp, dyd_xy mq) {
  ball2 d = {mq.x - mp.x, mq.y - mp.y, 0, 0};
  d.rx = dyd_max(d.x - (q->e[0] - p->e[1]), (q->e[1] - p->e[0]) - d.x);
  d.ry = dyd_max(d.y - (q->e[2] - p->e[3]), (q->e[3] - p->e[2]) - d.y);
  double size = fabs(p->e[0]) + fabs(p->e[1]) + fabs(q->e[0]) + fabs(q->e[1]);
  d.rx = dyd_max(d.rx, 0) * SAFE + 8 * 0x1p-53 * size;
  size = fabs(p->e[2]) + fabs(p->e[3]) + fabs(q->e[2]) + fabs(q->e[3]);
  d.ry = dyd_max(d.ry, 0) * SAFE + 8 * 0x1p-53 * size;
  return d;
}

/* A lower bound of |a x b|; not positive when the sign is not certain. */
static double ball_cross_lower(const ball2 *a, const ball2 *b) {
  double p = a->x * b->y, q = a->y * b->x, value = fabs(p - q);
  double vary = a->rx * (fabs(b->y) + b->ry) + fabs(a->x) * b->ry + a->ry * (fabs(b->x) + b->rx) + fabs(a->y) * b->rx;
  return value - (vary * SAFE + 32 * 0x1p-53 * (fabs(p) + fabs(q)));
}

/* An upper bound of | |q_k - z|^2 - |q_0 - z|^2 |. */
static double circle_gap2(const dyd_bbox *z, const dyd_bbox *p, const dyd_bbox *q) {
  return dyd_max(dyd_dl2_upper(z, q) - dyd_ds2_lower(z, p), dyd_dl2_upper(z, p) - dyd_ds2_lower(z, q)) * SAFE;
}

static dyd_xy box_middle(const dyd_bbox *b) {
  return (dyd_xy){b->e[0] + (b->e[1] - b->e[0]) / 2, b->e[2] + (b->e[3] - b->e[2]) / 2};
}

bool dyd_filter_vertex(dyd_bbox *out, const dyd_delaunay *pd, const uint32_t v[3]) {
  dyd_bbox box[3];
  dyd_xy m[3];
  for (int k = 0; k < 3; k++) {
    dyd_sites_get_d(box[k].e, pd->sk.rects.sites, pd->sk.reps.site[v[k]]);
    m[k] = box_middle(&box[k]);
  }
  ball2 a = ball_difference(&box[0], &box[1], m[0], m[1]), b = ball_difference(&box[0], &box[2], m[0], m[2]);
  double det = 2 * (a.x * b.y - a.y * b.x), la = a.x * a.x + a.y * a.y, lb = b.x * b.x + b.y * b.y;
  double least = ball_cross_lower(&a, &b);
  if (!(least >= 0x1p-400)) return false;
  dyd_xy z = {m[0].x + (b.y * la - a.y * lb) / det, m[0].y + (a.x * lb - b.x * la) / det};
  dyd_bbox c = {{z.x, z.x, z.y, z.y}};
  double ga = circle_gap2(&c, &box[0], &box[1]), gb = circle_gap2(&c, &box[0], &box[2]);
  double hx = (ga * (fabs(b.y) + b.ry) + gb * (fabs(a.y) + a.ry)) / (2 * least) * SAFE + DYD_TINY;
  double hy = (gb * (fabs(a.x) + a.rx) + ga * (fabs(b.x) + b.rx)) / (2 * least) * SAFE + DYD_TINY;
  hx += 4 * 0x1p-53 * (fabs(z.x) + hx);
  hy += 4 * 0x1p-53 * (fabs(z.y) + hy);
  *out = (dyd_bbox){{z.x - hx, z.x + hx, z.y - hy, z.y + hy}};
  return out->e[0] >= -DBL_MAX && out->e[1] <= DBL_MAX && out->e[2] >= -DBL_MAX && out->e[3] <= DBL_MAX;
}

/* ---- cells of exact points ----
 *
 * Each vertex lies in a box [VERT-1]. Where all of the box rounds to one multiple of 2^-grid, so does the vertex; where
 * it does not, x is NaN, and the exact rung rounds that vertex. A cell whose boxes are all strictly inside W is the
 * polygon of its vertices; one whose boxes are all beyond one side of W does not meet W. The area is enclosed by the
 * shoelace formula over the boxes in interval arithmetic: it holds the area of every polygon with one vertex in each
 * box. */

/* *out = floor(x 2^grid + 1/2) for both ends; true where it is one number, which has few bits. x 2^grid is exact, and
 * so is the sum: both are below 2^50. */
static bool round_to_grid(double *out, double lo, double hi, int grid) {
  double a = floor(ldexp(lo, grid) + 0.5), b = floor(ldexp(hi, grid) + 0.5);
  *out = ldexp(a, -grid);
  return a == b && fabs(a) < 0x1p50;
}

/* The circumcentre of points that are doubles, in a box. With a = p1 - p0, b = p2 - p0, D = 2 a x b, N the numerators
 * b_y |a|^2 - a_y |b|^2 and a_x |b|^2 - b_x |a|^2, it is p0 + N / D. Differences carry a relative error u, so products
 * in N at most (1 + u)^7, those in D (1 + u)^3: N is off by less than 9 u (|b_y| |a|^2 + |a_y| |b|^2), D by less than
 * 10 u (|a_x b_y| + |a_y b_x|), for which 16 u suffice, also for their own rounding. What underflows is below 2^-1070
 * in N, and 2^-600 covers that, as |D| >= 2^-400. */
static bool points_vertex(dyd_bbox *out, dyd_xy p, dyd_xy q, dyd_xy r) {
  const double u = 0x1p-53;
  double ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
  double la = ax * ax + ay * ay, lb = bx * bx + by * by, d = 2 * (ax * by - ay * bx);
  double least = fabs(d) - 16 * u * (fabs(ax * by) + fabs(ay * bx)), blur = fabs(d) - least;
  if (!(least >= 0x1p-400)) return false;
  double x = (by * la - ay * lb) / d, y = (ax * lb - bx * la) / d;
  double ex = (16 * u * (fabs(by) * la + fabs(ay) * lb) + fabs(x) * blur * 2) / least * SAFE + 0x1p-600;
  double ey = (16 * u * (fabs(ax) * lb + fabs(bx) * la) + fabs(y) * blur * 2) / least * SAFE + 0x1p-600;
  double zx = p.x + x, zy = p.y + y;
  ex += 4 * u * (fabs(x) + fabs(zx));
  ey += 4 * u * (fabs(y) + fabs(zy));
  *out = (dyd_bbox){{zx - ex, zx + ex, zy - ey, zy + ey}};
  return ex < HUGE_VAL && ey < HUGE_VAL;
}

static bool box_is_inside(const dyd_bbox *b, const double w[4]) {
  return w[0] < b->e[0] && b->e[1] < w[1] && w[2] < b->e[2] && b->e[3] < w[3];
}

/* Returns true if all boxes are beyond one side of W. */
static bool boxes_are_beyond(const dyd_bbox *b, uint32_t n, const double w[4]) {
  for (int side = 0; side < 4; side++) {
    uint32_t k = 0;
    while (k < n && (side & 1 ? b[k].e[side - 1] >= w[side] : b[k].e[side + 1] <= w[side])) k++;
    if (k == n) return true;
  }
  return false;
}

/* Twice the area of the polygon with a vertex in each box; o is any point near. */
static dyd_iv boxes_area2(const dyd_bbox *b, uint32_t n, dyd_xy o) {
  dyd_iv sum = dyd_iv_point(0), x[2], y[2];
  for (uint32_t k = 0; k <= n; k++) {
    const double *e = b[k % n].e;
    x[k & 1] = dyd_iv_sub((dyd_iv){e[0], e[1]}, dyd_iv_point(o.x));
    y[k & 1] = dyd_iv_sub((dyd_iv){e[2], e[3]}, dyd_iv_point(o.y));
    int was = 1 - (int)(k & 1), is = (int)(k & 1);
    if (k) sum = dyd_iv_add(sum, dyd_iv_sub(dyd_iv_mul(x[was], y[is]), dyd_iv_mul(y[was], x[is])));
  }
  return sum;
}

/* As round_to_grid; scaling by a power of two is exact. */
static bool rounds_alike(double lo, double hi, double scale) {
  double a = lo * scale + 0.5, b = hi * scale + 0.5;
  if (!(fabs(a) < 0x1p50 && fabs(b) < 0x1p50)) return false;
  int64_t n = (int64_t)a, m = (int64_t)b;
  return n - ((double)n > a) == m - ((double)m > b);
}

bool dyd_filter_grid_centre(dyd_grid_centre *c, const dyd_delaunay *pd, uint32_t t, const dyd_window *w, double scale) {
  dyd_bbox b;
  const uint32_t *v = pd->sk.mesh.tri[t].v;
  const dyd_xy *xy = pd->sk.reps.xy;
  c->error = (double)NAN;
  if (pd->sk.reps.code ? !dyd_filter_vertex(&b, pd, v) : !points_vertex(&b, xy[v[0]], xy[v[1]], xy[v[2]])) return true;
  if (!box_is_inside(&b, w->d)) return true;
  if (!rounds_alike(b.e[0], b.e[1], scale) || !rounds_alike(b.e[2], b.e[3], scale)) return false;
  c->z = (dyd_xy){b.e[0] / 2 + b.e[1] / 2, b.e[2] / 2 + b.e[3] / 2};
  c->error = dyd_max(b.e[1] - b.e[0], b.e[3] - b.e[2]); /* twice the bound, less rounding */
  return true;
}

dyd_status dyd_filter_point_cell(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, uint32_t degree,
                                 const dyd_window *w) {
  *done = false;
  for (uint32_t k = 0; k < degree; k++)
    if (s->key[k] == DYD_NONE || !dyd_filter_vertex(&s->fan_box[k], pd, pd->sk.mesh.tri[s->key[k]].v)) return DYD_OK;
  s->inner_count = 0;
  s->area[0] = s->area[1] = 0;
  if (boxes_are_beyond(s->fan_box, degree, w->d)) return *done = true, DYD_OK;
  for (uint32_t k = 0; k < degree; k++)
    if (!box_is_inside(&s->fan_box[k], w->d)) return DYD_OK;
  dyd_iv area2 = boxes_area2(s->fan_box, degree, pd->sk.reps.xy[v]);
  if (!(area2.hi - area2.lo <= 0x1p-20 * area2.lo)) return DYD_OK;
  s->area[0] = dyd_down(area2.lo / 2);
  s->area[1] = dyd_up(area2.hi / 2);
  if (!DYD_GROW(s->inner, s->inner_cap, degree)) return DYD_E_NOMEM;
  for (; s->inner_count < degree; s->inner_count++) {
    const double *e = s->fan_box[s->inner_count].e;
    dyd_xy *z = &s->inner[s->inner_count];
    if (!round_to_grid(&z->x, e[0], e[1], w->grid) || !round_to_grid(&z->y, e[2], e[3], w->grid)) z->x = (double)NAN;
  }
  *done = true;
  return DYD_OK;
}

/* ---- boxes round the part of the diagram that belongs to an undecided face, by bisection [REGION-1] ----
 *
 * Every vertex of the diagram, for any choice, except those of certain triangles, is the circumcentre of a triangle
 * ijl of some face with an edge ij that is not legal, so it lies in Pos_i n Pos_j n Pos_l, and l is a possible
 * neighbour of i. For a box of centres Q, site i is removed when some k blocks it: dl_k < ds_i in all of Q, by ranges
 * over Q or, since C_ki is convex, at its four corners, with the bounds of [FLT-DST]. A removed site blocks no
 * site that k does not block, so the list of sites shrinks from box to part, and with it the list of pairs. Q is
 * dropped when no pair or fewer than three sites are left. The boxes left after bisection are enclosed, and the
 * enclosure bisected again while that pays. */

/* BLOCKERS: how many sites of a box are tried as blockers at corners; fewer of them only make the box larger. */
enum { COARSE = 3, FINE = 5, BLOCKERS = 64 };

/* Ends as places in site[]. */
typedef struct region_pair {
  uint32_t i, j;
} region_pair;

/* The sites of a part are in list[], its pairs in pair[]. in[]: is a site in the list at hand? All false between uses.
 * depth: how often boxes are cut. */
typedef struct region_search {
  dyd_bbox *site;
  uint32_t *list;
  region_pair *pair;
  bool *in;
  size_t list_cap, pair_cap;
  dyd_bbox found;
  bool any;
  int depth;
} region_search;

static bool box_is_within(const dyd_bbox *a, const dyd_bbox *b) {
  return b->e[0] <= a->e[0] && a->e[1] <= b->e[1] && b->e[2] <= a->e[2] && a->e[3] <= b->e[3];
}

/* ---- sites possible in a box ---- */

/* Keeps the sites of list[from .. from+count) that ranges do not exclude; returns how many. */
static size_t region_keep_near(region_search *s, const dyd_bbox *c, size_t from, size_t count) {
  double least = HUGE_VAL;
  size_t kept = from;
  for (size_t k = from; k < from + count; k++) least = dyd_min(least, dyd_dl2_upper(c, &s->site[s->list[k]]));
  for (size_t k = from; k < from + count; k++)
    if (!(dyd_ds2_lower(c, &s->site[s->list[k]]) > least)) s->list[kept++] = s->list[k];
  return kept - from;
}

/* Keeps the sites that no other blocks at the corners. No site blocks itself, as far >= near. */
static size_t region_keep_open(region_search *s, const dyd_bbox *c, size_t from, size_t count) {
  double far[BLOCKERS][4], near[4];
  size_t kept = from, blockers = count < BLOCKERS ? count : BLOCKERS;
  for (size_t k = 0; k < blockers; k++) dyd_corners_far(far[k], c, &s->site[s->list[from + k]]);
  for (size_t k = from; k < from + count; k++) {
    size_t m = 0;
    dyd_corners_near(near, c, &s->site[s->list[k]]);
    while (m < blockers && !dyd_corners_block(far[m], near)) m++;
    if (m == blockers) s->list[kept++] = s->list[k];
  }
  return kept - from;
}

/* Keeps the pairs of pair[from .. from+count) whose ends are in the list. */
static size_t region_keep_pairs(region_search *s, const dyd_plane_part *p) {
  size_t kept = p->first_pair;
  for (size_t k = 0; k < p->count; k++) s->in[s->list[p->first + k]] = true;
  for (size_t k = p->first_pair; k < p->first_pair + p->pairs; k++)
    if (s->in[s->pair[k].i] && s->in[s->pair[k].j]) s->pair[kept++] = s->pair[k];
  for (size_t k = 0; k < p->count; k++) s->in[s->list[p->first + k]] = false;
  return kept - p->first_pair;
}

/* Cuts the lists down to the sites and pairs possible in the box. */
static void region_cut(region_search *s, dyd_plane_part *p) {
  p->count = region_keep_near(s, &p->at, p->first, p->count);
  p->count = region_keep_open(s, &p->at, p->first, p->count);
  p->pairs = p->count < 3 ? 0 : region_keep_pairs(s, p);
}

/* ---- bisection ---- */

/* Copies the lists of the box around p behind them. */
static bool region_copy_lists(region_search *s, dyd_plane_part *p) {
  const size_t first = p->first + p->count, first_pair = p->first_pair + p->pairs;
  if (!DYD_GROW(s->list, s->list_cap, first + p->count) || !DYD_GROW(s->pair, s->pair_cap, first_pair + p->pairs))
    return false;
  if (p->count) memcpy(s->list + first, s->list + p->first, p->count * sizeof *s->list);
  if (p->pairs) memcpy(s->pair + first_pair, s->pair + p->first_pair, p->pairs * sizeof *s->pair);
  p->first = first;
  p->first_pair = first_pair;
  return true;
}

/* Boxes inside the enclosure found so far add nothing. */
static dyd_status region_look(void *context, int *parts, dyd_plane_part *p) {
  region_search *s = context;
  if (s->any && box_is_within(&p->at, &s->found)) return DYD_OK;
  if (!region_copy_lists(s, p)) return DYD_E_NOMEM;
  region_cut(s, p);
  if (p->pairs && p->depth < s->depth) {
    *parts = 4;
  } else if (p->pairs) {
    if (!s->any) s->found = p->at;
    s->any = true;
    dyd_box_widen(&s->found, &p->at);
  }
  return DYD_OK;
}

/* Returns true if one side becomes a good deal shorter. */
static bool box_shrinks(const dyd_bbox *from, const dyd_bbox *to) {
  return to->e[1] - to->e[0] < 0.75 * (from->e[1] - from->e[0]) ||
         to->e[3] - to->e[2] < 0.75 * (from->e[3] - from->e[2]);
}

/* Coarse rounds as long as they pay, then fine ones; s->any = false: nothing is possible in all->at. */
static dyd_status region_shrink(dyd_plane_part *all, region_search *s) {
  bool pays = true;
  for (s->depth = COARSE; pays || s->depth == COARSE;) {
    if (!pays) s->depth = FINE;
    region_cut(s, all);
    s->any = false;
    dyd_status st = dyd_walk_parts(region_look, s, NULL, *all);
    if (st != DYD_OK || !s->any) return st;
    pays = box_shrinks(&all->at, &s->found);
    all->at = s->found;
  }
  return DYD_OK;
}

/* ---- the lists of a face ---- */

static uint32_t place_in_list(const dyd_index_list *sites, uint32_t site) {
  const uint32_t *found = dyd_find_index(&site, sites->item, sites->count, sizeof site);
  return (uint32_t)(found - sites->item);
}

static void region_load(region_search *s, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                        const dyd_index_list *sites) {
  for (size_t k = 0; k < sites->count; k++) {
    dyd_sites_get_d(s->site[k].e, pd->sk.rects.sites, sites->item[k]);
    s->list[k] = (uint32_t)k;
    s->in[k] = false;
  }
  for (size_t k = 0; k < pairs->count; k++)
    s->pair[k] = (region_pair){place_in_list(sites, pairs->item[k].i), place_in_list(sites, pairs->item[k].j)};
}

dyd_status dyd_filter_region(dyd_bbox *box, bool *any, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                             const dyd_index_list *sites) {
  region_search s = {0};
  dyd_plane_part all = {.at = *box, .count = sites->count, .pairs = pairs->count};
  dyd_status st = DYD_E_NOMEM;
  s.site = dyd_alloc(sites->count, sizeof *s.site);
  s.in = dyd_alloc(sites->count, sizeof *s.in);
  if (s.site && s.in && DYD_GROW(s.list, s.list_cap, sites->count) && DYD_GROW(s.pair, s.pair_cap, pairs->count)) {
    region_load(&s, pd, pairs, sites);
    st = region_shrink(&all, &s);
  }
  if (st == DYD_OK) *any = s.any;
  if (st == DYD_OK && s.any) *box = all.at;
  dyd_free_all(s.pair, s.list, s.in, s.site);
  return st;
}
