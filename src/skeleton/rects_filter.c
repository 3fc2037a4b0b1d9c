/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Bounds for the walks: everything here is conservative, the walks decide the rest. */
#include "skeleton/rects_filter.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "base/invariant.h"
#include "skeleton/work.h"

#include <math.h>
#include <string.h>

/* Part k of a box cut both ways, as its corners are numbered. */
static dyd_bbox part_of_box(const dyd_bbox *c, int k) {
  double x = c->e[0] / 2 + c->e[1] / 2, y = c->e[2] / 2 + c->e[3] / 2;
  return (dyd_bbox){{k & 1 ? x : c->e[0], k & 1 ? c->e[1] : x, k & 2 ? y : c->e[2], k & 2 ? c->e[3] : y}};
}

dyd_status dyd_walk_parts(dyd_look look, void *context, const volatile int *cancel, dyd_plane_part p) {
  int parts = 0;
  dyd_status st = dyd_flag_is_set(cancel) ? DYD_CANCELLED : look(context, &parts, &p);
  const dyd_bbox at = p.at;
  p.depth++;
  for (int k = 0; k < parts && st == DYD_OK; k++) {
    p.at = part_of_box(&at, k);
    st = dyd_walk_parts(look, context, cancel, p);
  }
  return st;
}

/* ---- the packed box tree; its pruning tests are the bounds of the header and [FLT-DIR] below ---- */

static void fill_node(dyd_tree *t, int k, size_t q) {
  size_t first, end;
  dyd_tree_children(&first, &end, t, k, q);
  dyd_bbox h = *dyd_tree_child_box(t, k, first);
  for (size_t e = first + 1; e < end; e++) dyd_box_widen(&h, dyd_tree_child_box(t, k, e));
  t->node[t->level[k] + q] = h;
}

static void tree_set_levels(dyd_tree *t) {
  size_t width = t->count;
  t->levels = 0;
  while (t->count && (t->levels == 0 || width > 1)) {
    width = (width + DYD_TREE_FANOUT - 1) / DYD_TREE_FANOUT;
    t->level[t->levels + 1] = t->level[t->levels] + width;
    t->levels++;
  }
}

dyd_status dyd_tree_init(dyd_tree *t, uint32_t *item, uint32_t count, const dyd_bbox *box) {
  *t = (dyd_tree){.count = count, .item = item, .box = box, .ascending = true};
  for (uint32_t q = 1; q < count && t->ascending; q++) t->ascending = item[q - 1] < item[q];
  tree_set_levels(t);
  if (!DYD_NEW(t->node, t->level[t->levels])) return DYD_E_NOMEM;
  for (int k = 0; k < t->levels; k++)
    for (size_t q = 0; q < t->level[k + 1] - t->level[k]; q++) fill_node(t, k, q);
  return DYD_OK;
}

dyd_status dyd_tree_grow(dyd_tree *t, uint32_t first, uint32_t count, const dyd_bbox *box) {
  const dyd_tree old = *t;
  uint32_t *item = realloc(t->item, ((size_t)t->count + count) * sizeof *item);
  if (!item) return DYD_E_NOMEM;
  t->item = item;
  t->box = box;
  for (uint32_t q = 0; q < count; q++) item[t->count++] = first + q;
  tree_set_levels(t);
  dyd_bbox *node = realloc(t->node, t->level[t->levels] * sizeof *node);
  if (!node) return DYD_E_NOMEM;
  t->node = node;
  for (int k = old.levels - 1; k > 0; k--)
    memmove(node + t->level[k], node + old.level[k], (old.level[k + 1] - old.level[k]) * sizeof *node);
  size_t changed = old.count;
  for (int k = 0; k < t->levels; k++)
    for (size_t q = changed /= DYD_TREE_FANOUT; q < t->level[k + 1] - t->level[k]; q++) fill_node(t, k, q);
  return DYD_OK;
}

void dyd_tree_clear(dyd_tree *t) {
  dyd_free_all(t->item, t->node);
  memset(t, 0, sizeof *t);
}

uint32_t dyd_tree_entry(const dyd_tree *t, uint32_t vertex) {
  uint32_t lo = 0, hi = t->count;
  while (hi - lo > 1) {
    uint32_t mid = lo + (hi - lo) / 2;
    if (t->item[mid] <= vertex)
      lo = mid;
    else
      hi = mid;
  }
  return lo;
}

void dyd_tree_refresh(dyd_tree *t, uint32_t q) {
  size_t entry = q;
  for (int k = 0; k < t->levels; k++) fill_node(t, k, entry /= DYD_TREE_FANOUT);
}

/* A depth-first search; at most 7 waiting siblings on each level. value: distance or height of the node when it was
 * put aside; the limit may have moved meanwhile. */
typedef struct walk_level {
  int level;
  size_t node;
  double value;
} walk_level;

enum { STACK = DYD_TREE_LEVELS * DYD_TREE_FANOUT };

/* The distance across of the centre from each box, along x (k = 0) or y (k = 2), as in dyd_ds2_lower. */
static void gaps(double gap[DYD_TREE_FANOUT], const dyd_bbox *box, const dyd_bbox *c, int k) {
  double lo = c->e[k], hi = c->e[k + 1];
  for (size_t e = 0; e < DYD_TREE_FANOUT; e++) {
    double g = dyd_max(box[e].e[k] - hi, lo - box[e].e[k + 1]);
    gap[e] = dyd_max(g, 0);
  }
}

/* dyd_ds2_lower for the children of a node; in loops without branches where their boxes lie side by side. Not to be
 * inlined: the compiler would unroll the loops before it could use vectors. */
#if defined(__GNUC__)

__attribute__((noinline))
#endif
static void
distances(double value[DYD_TREE_FANOUT], const dyd_tree *t, int level, size_t first, size_t end, const dyd_bbox *c) {
  size_t count = end - first;
  bool side_by_side = level > 0 || (t->ascending && t->item[end - 1] - t->item[first] == count - 1);
  if (count == DYD_TREE_FANOUT && side_by_side) {
    double dx[DYD_TREE_FANOUT], dy[DYD_TREE_FANOUT];
    gaps(dx, dyd_tree_child_box(t, level, first), c, 0);
    gaps(dy, dyd_tree_child_box(t, level, first), c, 2);
    for (size_t e = 0; e < DYD_TREE_FANOUT; e++) value[e] = dyd_lower(dx[e] * dx[e] + dy[e] * dy[e]);
  } else {
    for (size_t e = 0; e < count; e++) value[e] = dyd_ds2_lower(c, dyd_tree_child_box(t, level, first + e));
  }
  for (size_t e = 0; e < count; e++)
    DYD_INVARIANT(value[e] == dyd_ds2_lower(c, dyd_tree_child_box(t, level, first + e)));
}

/* Upper bound of max u.x over a box [FLT-DIR]: two products and a sum of relative error u, and the bound's own
 * rounding: below 8u(|ux x| + |uy y|). */
static double reach(const dyd_bbox *b, double ux, double uy) {
  double px = ux * (ux > 0 ? b->e[1] : b->e[0]), py = uy * (uy > 0 ? b->e[3] : b->e[2]);
  double r = px + py + 8 * 0x1p-53 * (fabs(px) + fabs(py)) + DYD_TINY;
  return isnan(r) ? INFINITY : r;
}

/* Minus reach for the children of a node. */
static void depths(double value[DYD_TREE_FANOUT], const dyd_tree *t, int level, size_t first, size_t end, double ux,
                   double uy) {
  for (size_t e = first; e < end; e++) value[e - first] = -reach(dyd_tree_child_box(t, level, e), ux, uy);
}

/* Both walks over the tree: near c, or beyond a line across (ux, uy). A copy is compiled for each value of `near`. */
static inline void tree_walk(const dyd_tree *t, bool near, const dyd_bbox *c, double ux, double uy, const double *limit,
                             dyd_visit visit, void *context) {
  walk_level stack[STACK];
  double value[DYD_TREE_FANOUT];
  int depth = 0;
  if (t->levels) stack[depth++] = (walk_level){t->levels - 1, 0, -INFINITY};
  while (depth) {
    walk_level f = stack[--depth];
    size_t first, end;
    if (f.value > (near ? *limit : -*limit)) continue;
    dyd_tree_children(&first, &end, t, f.level, f.node);
    if (near)
      distances(value, t, f.level, first, end, c);
    else
      depths(value, t, f.level, first, end, ux, uy);
    for (size_t e = first; e < end; e++) {
      if (value[e - first] > (near ? *limit : -*limit)) continue;
      if (f.level > 0)
        stack[depth++] = (walk_level){f.level - 1, e, value[e - first]};
      else if (!visit(context, t->item[e]))
        return;
    }
  }
}

void dyd_tree_near(const dyd_tree *t, const dyd_bbox *c, const double *radius2, dyd_visit visit, void *context) {
  tree_walk(t, true, c, 0, 0, radius2, visit, context);
}

void dyd_tree_beyond(const dyd_tree *t, double ux, double uy, const double *height, dyd_visit visit, void *context) {
  tree_walk(t, false, NULL, ux, uy, height, visit, context);
}

dyd_bbox dyd_point_box(const dyd_point *c) {
  return (dyd_bbox){{dyd_dyadic_get_d(&c->x, DYD_DOWN), dyd_dyadic_get_d(&c->x, DYD_UP),
                     dyd_dyadic_get_d(&c->y, DYD_DOWN), dyd_dyadic_get_d(&c->y, DYD_UP)}};
}

double dyd_pair_dl2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j) {
  double a = dyd_dl2_upper(c, &r->box[i]), b = dyd_dl2_upper(c, &r->box[j]);
  return isnan(a) || isnan(b) ? INFINITY : dyd_max(a, b);
}

double dyd_pair_ds2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j) {
  double a = dyd_ds2_upper(c, &r->box[i], dyd_box_slack(r, i));
  double b = dyd_ds2_upper(c, &r->box[j], dyd_box_slack(r, j));
  return isnan(a) || isnan(b) ? INFINITY : dyd_max(a, b);
}

bool dyd_surely_not_nearer(const dyd_rects *r, const dyd_bbox *c, uint32_t k, double bound) {
  return dyd_dl2_lower(c, &r->box[k], dyd_box_slack(r, k)) >= bound;
}

typedef struct nearest {
  const dyd_rects *r;
  uint32_t i, j, best;
  dyd_bbox c;
  double least;
} nearest;

/* A site farther than `least` altogether cannot have a smaller dl, so the radius follows. */
static bool keep_nearest(void *context, uint32_t k) {
  nearest *s = context;
  if (k == s->i || k == s->j) return true;
  double d = dyd_dl2_upper(&s->c, &s->r->box[k]);
  if (d < s->least) {
    s->least = d;
    s->best = k;
  }
  return true;
}

uint32_t dyd_surely_nearest(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j) {
  nearest s = {r, i, j, DYD_NONE, *c, 0};
  s.least = dyd_min(dyd_ds2_lower(c, &r->box[i]), dyd_ds2_lower(c, &r->box[j]));
  if (s.least > 0) dyd_tree_near(&r->tree, c, &s.least, keep_nearest, &s);
  return s.best;
}

void dyd_direction_d(double u[2], const mpz_t x, const mpz_t y) {
  long e[2];
  u[0] = mpz_get_d_2exp(&e[0], x);
  u[1] = mpz_get_d_2exp(&e[1], y);
  long top = u[0] == 0 ? e[1] : u[1] == 0 || e[0] > e[1] ? e[0] : e[1];
  for (int a = 0; a < 2; a++) u[a] = e[a] - top < -900 ? 0 : ldexp(u[a], (int)(e[a] - top));
}

/* The outward box reaches at most `slack` farther than the rectangle; u is off by 2^-52 |u| + 2^-900, products and sums
 * by 4 * 2^-53, on both sides of the comparison: 32 * 2^-53 |u| |x| + 2^-898 |x| covers it all [FLT-DIR]. */
double dyd_height_lower(const dyd_rects *r, double ux, double uy, const dyd_bbox *p) {
  const dyd_bbox *all = &r->tree.node[r->tree.level[r->tree.levels - 1]];
  double mx = dyd_max(fabs(all->e[0]), fabs(all->e[1])), my = dyd_max(fabs(all->e[2]), fabs(all->e[3]));
  double x = ux > 0 ? p->e[1] : p->e[0], y = uy > 0 ? p->e[3] : p->e[2];
  double slack = 32 * 0x1p-53 * (fabs(ux) * mx + fabs(uy) * my) + 0x1p-898 * (mx + my) + DYD_TINY;
  double h = ux * x + uy * y - slack;
  return isnan(h) ? -INFINITY : h;
}

/* The least u.x of the box is off by the slack of both sides and the rounding of `reach` [FLT-DIR]; the error of u is
 * in the height. */
bool dyd_surely_not_beyond(const dyd_rects *r, double ux, double uy, uint32_t k, double height) {
  const double *e = r->box[k].e, x = ux > 0 ? e[0] : e[1], y = uy > 0 ? e[2] : e[3];
  const dyd_bbox least = {{x, x, y, y}};
  return reach(&least, ux, uy) + (fabs(ux) + fabs(uy)) * dyd_box_slack(r, k) * 2 <= height;
}

/* user = scaled / lcm, after the shift. The double nearest to lcm has a relative error of 2^-52, the division one of
 * 2^-53 (or 2^-1074 absolute): widening by 4 ulp is outward. Denominators too large for doubles leave the plane
 * [FLT-SCALE]. */
void dyd_scale_to_user(dyd_bbox *box, const dyd_scale_set *s) {
  double l = mpz_get_d(s->lcm);
  if (l == 1) return;
  for (int k = 0; k < 4; k++) {
    double x = box->e[k] / l, out = k & 1 ? INFINITY : -INFINITY;
    x += (k & 1 ? 1 : -1) * 4 * 0x1p-52 * fabs(x);
    box->e[k] = isnan(x) || !isfinite(l) ? out : nextafter(x, out);
  }
}
