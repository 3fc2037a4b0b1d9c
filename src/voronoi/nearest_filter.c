/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Candidates for the nearest site of a point of the query rectangle, by bounds of distances in doubles [FLT-DST].
 *
 * Let B be an upper bound of min_k max_{c in q} dl_k(c)^2. A site that is possibly nearest to some c in q has ds(c)^2
 * <= min_k dl_k(c)^2 <= B, so its box comes within sqrt(B) of q. The box of a tree node that holds a site bounds that
 * site's dl from above: a descent towards q gives a first B, one search of the tree the final one and all candidates.
 */
#include "base/alloc.h"
#include "dyadic/raw.h"
#include "rect/rect.h"
#include "voronoi/nearest.h"

typedef struct nearest_search {
  const dyd_delaunay *pd;
  const dyd_tree *tree;
  dyd_bbox q;
  double bound;
  uint32_t *vertex;
  double *lower; /* of ds^2 */
  size_t count, vertex_cap, lower_cap;
  bool failed;
} nearest_search;

static void search_lower_bound(nearest_search *s, const dyd_bbox *b) {
  double upper = dyd_dl2_upper(&s->q, b);
  if (upper < s->bound) s->bound = upper;
}

/* From the root to an item, always into the child with the least upper bound. */
static void search_descend(nearest_search *s) {
  const dyd_tree *t = s->tree;
  size_t node = 0;
  for (int level = t->levels - 1; level >= 0; level--) {
    size_t first, end;
    double best = HUGE_VAL;
    dyd_tree_children(&first, &end, t, level, node);
    node = first;
    for (size_t e = first; e < end; e++) {
      double upper = dyd_dl2_upper(&s->q, dyd_tree_child_box(t, level, e));
      if (!(upper < best)) continue;
      best = upper;
      node = e;
    }
    if (best < s->bound) s->bound = best;
  }
}

static bool search_consider(nearest_search *s, uint32_t v) {
  dyd_bbox b;
  if (s->pd->sk.vertex[s->pd->sk.reps.site[v]] != v) return true; /* an alias */
  dyd_vertex_box(&b, &s->pd->sk, v);
  double lower = dyd_ds2_lower(&s->q, &b);
  if (lower > s->bound) return true;
  if (!s->pd->sk.mesh.no_filter) search_lower_bound(s, &b);
  s->failed = !DYD_GROW(s->vertex, s->vertex_cap, s->count + 1) || !DYD_GROW(s->lower, s->lower_cap, s->count + 1);
  if (s->failed) return false;
  s->vertex[s->count] = v;
  s->lower[s->count++] = lower;
  return true;
}

static bool search_visit_vertex(void *context, uint32_t v) {
  return search_consider(context, v);
}

static bool search_visit_block(void *context, uint32_t b) {
  nearest_search *s = context;
  for (uint32_t v = b * DYD_BLOCK; v < dyd_block_end(&s->pd->sk, b); v++)
    if (!search_consider(s, v)) return false;
  return true;
}

dyd_status dyd_near_candidates(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, const dyd_rect *q) {
  bool fine = pd->sk.rects.tree.count > 0;
  nearest_search s = {.pd = pd, .tree = fine ? &pd->sk.rects.tree : &pd->sk.blocks, .bound = HUGE_VAL};
  dyd_interval_get_d(&s.q.e[0], &s.q.e[1], &q->x);
  dyd_interval_get_d(&s.q.e[2], &s.q.e[3], &q->y);
  if (!pd->sk.mesh.no_filter) search_descend(&s);
  dyd_tree_near(s.tree, &s.q, &s.bound, fine ? search_visit_vertex : search_visit_block, &s);
  size_t kept = 0;
  for (size_t k = 0; k < s.count; k++)
    if (!(s.lower[k] > s.bound)) s.vertex[kept++] = s.vertex[k];
  free(s.lower);
  if (s.failed) {
    free(s.vertex);
    return DYD_E_NOMEM;
  }
  *vertex = s.vertex;
  *count = kept;
  return DYD_OK;
}

/* ---- a walk ---- */

/* Sets *next to the neighbour of v whose point is nearest to z; false: v is as near as all. *budget: neighbours that
 * may still be tested. */
static bool near_step(uint32_t *next, const dyd_mesh *m, dyd_half_edge first, dyd_xy z, int *budget) {
  dyd_xy p = m->xy[dyd_edge_origin(m, first)];
  double least = (p.x - z.x) * (p.x - z.x) + (p.y - z.y) * (p.y - z.y);
  bool found = false;
  for (dyd_half_edge h = first; h != DYD_NONE && *budget > 0; h = dyd_edge_around(m, h, first), --*budget) {
    uint32_t w = dyd_edge_target(m, h); /* distances of the ghost are NaN */
    double d = (m->xy[w].x - z.x) * (m->xy[w].x - z.x) + (m->xy[w].y - z.y) * (m->xy[w].y - z.y);
    if (!(d < least)) continue;
    least = d, *next = w, found = true;
  }
  return found;
}

/* Returns true if the point of v is nearer to z than those of its neighbours, which are the same for every choice. */
static bool near_all_around(const dyd_delaunay *pd, uint32_t v, dyd_xy z) {
  const dyd_mesh *m = &pd->sk.mesh;
  const dyd_bbox at = {{z.x, z.x, z.y, z.y}};
  dyd_bbox b;
  dyd_vertex_box(&b, &pd->sk, v);
  double most = dyd_dl2_upper(&at, &b);
  bool nearest = true;
  for (dyd_half_edge first = pd->sk.leaving[v], h = first; h != DYD_NONE && nearest; h = dyd_edge_around(m, h, first)) {
    uint32_t w = dyd_edge_target(m, h);
    nearest = pd->open.kind == DYD_TIED || dyd_triangle_is_sure(pd, dyd_edge_triangle(h));
    if (w == m->n || !nearest) continue;
    dyd_vertex_box(&b, &pd->sk, w);
    nearest = most < dyd_ds2_lower(&at, &b);
  }
  return nearest;
}

bool dyd_filter_near_walk(uint32_t *v, const dyd_delaunay *pd, dyd_xy z) {
  int budget = 1000; /* about what a search of the tree costs */
  if (pd->open.kind == DYD_LINE || pd->sk.mesh.no_filter) return false;
  while (budget > 0 && near_step(v, &pd->sk.mesh, pd->sk.leaving[*v], z, &budget)) continue;
  return budget > 0 && near_all_around(pd, *v, z);
}

/* ---- sides ---- */

dyd_truth dyd_filter_blocks(const dyd_bbox *c, const dyd_near_site *k, const dyd_near_site *i) {
  if (dyd_dl2_upper(c, &k->box) < dyd_ds2_lower(c, &i->box)) return DYD_TRUE;
  if (dyd_dl2_lower(c, &k->box, k->slack) >= dyd_ds2_upper(c, &i->box, i->slack)) return DYD_FALSE;
  return DYD_UNKNOWN;
}

size_t dyd_filter_blocker(const dyd_bbox *c, const dyd_near_site *site, size_t count, size_t i) {
  size_t best = count;
  double least = HUGE_VAL;
  for (size_t k = 0; k < count; k++) {
    double upper = dyd_dl2_upper(c, &site[k].box);
    if (k == i || !(upper < least)) continue;
    least = upper;
    best = k;
  }
  return best < count && least < dyd_ds2_lower(c, &site[i].box) ? best : count;
}

static void enclose_rational(double out[2], const mpq_t q) {
  out[0] = dyd_raw_quotient_get_d(mpq_numref(q), 0, mpq_denref(q), DYD_DOWN);
  out[1] = dyd_raw_quotient_get_d(mpq_numref(q), 0, mpq_denref(q), DYD_UP);
}

/* Roots and sums are correctly rounded; one step outward each. */
static void add_enclosed_root(double out[2], const mpq_t c) {
  double square[2];
  if (!mpq_sgn(c)) return;
  enclose_rational(square, c);
  for (int k = 0; k < 2; k++) {
    double away = k ? HUGE_VAL : -HUGE_VAL, sum = out[k] + nextafter(sqrt(square[k]), away);
    out[k] = isnan(sum) ? away : nextafter(sum, away);
  }
}

void dyd_filter_place(dyd_bbox *c, const dyd_near_side *side, const mpq_t at, const mpq_t root) {
  enclose_rational(&c->e[2 * side->axis], at);
  add_enclosed_root(&c->e[2 * side->axis], root);
  enclose_rational(&c->e[2 - 2 * side->axis], side->across);
}

double dyd_filter_slack(const dyd_bbox *b, bool in_doubles) {
  if (in_doubles) return 0;
  double m = dyd_max(dyd_max(fabs(b->e[0]), fabs(b->e[1])), dyd_max(fabs(b->e[2]), fabs(b->e[3])));
  return m * 0x1p-52 + 0x1p-1074;
}
