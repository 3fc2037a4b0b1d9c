/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The faces of the legal graph, and the sets of sites within which a pair can be possible. */
#include "checker/faces.h"
#include "base/alloc.h"
#include "checker/by_key.h"
#include "checker/parts.h"

#include <string.h>

dyd_status dyd_cert_walk(uint32_t **out, size_t *count, const dyd_cert_graph *g, uint32_t h) {
  size_t n = 0;
  uint32_t k = h;
  do n++;
  while ((k = dyd_cert_follow(g, k)) != h);
  uint32_t *walk = dyd_alloc(n, sizeof *walk);
  if (!walk) return DYD_E_NOMEM;
  for (size_t q = 0; q < n; q++, k = dyd_cert_follow(g, k)) walk[q] = k;
  *out = walk;
  *count = n;
  return DYD_OK;
}

/* Appends the sites as an open set, unless they are the two ends of a legal edge or less. */
static dyd_status faces_add_set(dyd_cert_faces *f, const dyd_cert_graph *g, const uint32_t *site, size_t count,
                                dyd_cert_shape shape) {
  if (!dyd_reserve((void **)&f->member, &f->member_cap, f->members + count, sizeof *f->member) ||
      !dyd_reserve((void **)&f->start, &f->set_cap, f->sets + 2, sizeof *f->start) ||
      !dyd_reserve((void **)&f->shape, &f->shape_cap, f->sets + 1, sizeof *f->shape))
    return DYD_E_NOMEM;
  if (count < 2) return DYD_OK;
  uint32_t *to = f->member + f->members;
  memcpy(to, site, count * sizeof *to);
  size_t distinct = dyd_cert_distinct(to, count);
  f->shape[f->sets] = distinct == count ? shape : DYD_CERT_ANY;
  count = distinct;
  if (count < 2 || (count == 2 && dyd_cert_edges_have(g->legal, to[0], to[1]))) return DYD_OK;
  f->start[f->sets++] = f->members;
  f->members += count;
  f->start[f->sets] = f->members;
  return DYD_OK;
}

/* ---- bounded faces ---- */

static dyd_status add_bounded_face(dyd_cert_faces *f, bool *seen, const dyd_cert_graph *g, uint32_t h) {
  uint32_t *walk = NULL;
  size_t count = 0;
  dyd_status st = dyd_cert_walk(&walk, &count, g, h);
  if (st != DYD_OK) return st;
  dyd_cert_shape shape = DYD_CERT_POLYGON;
  for (size_t q = 0; q < count; q++) {
    seen[walk[q]] = true;
    if (!dyd_cert_is_legal(g, walk[q])) shape = DYD_CERT_ANY;
    walk[q] = dyd_cert_origin(g, walk[q]);
  }
  if (count == 3) /* legal edges: a bridge is in no cycle */
    f->triangles++;
  else
    st = faces_add_set(f, g, walk, count, shape);
  free(walk);
  return st;
}

/* ---- the unbounded face ---- */

/* Its walk, as half-edges and as sites; which sites are corners. */
typedef struct rim {
  uint32_t *walk, *site;
  size_t count;
  bool *corner;
} rim;

static int compare_place_of(const void *sites, uint32_t a, uint32_t b) {
  int sign = dyd_cert_compare_places(sites, a, b);
  return sign ? sign : (a > b) - (a < b);
}

/* Marks one chain of the hull: the items are passed in order, from the lowest place or from the highest. */
static void mark_hull_chain(bool *hull, uint32_t *stack, const dyd_cert_sites *s, const uint32_t *item, size_t count,
                            bool back) {
  size_t top = 0;
  for (size_t q = 0; q < count; q++) {
    uint32_t v = item[back ? count - 1 - q : q];
    while (top > 1 && dyd_cert_turn(s, stack[top - 2], stack[top - 1], v) <= 0) top--;
    stack[top++] = v;
  }
  for (size_t q = 0; q < top; q++) hull[stack[q]] = true;
}

dyd_status dyd_cert_hull(bool *hull, const dyd_cert_sites *s, uint32_t *item, size_t count) {
  uint32_t *stack = dyd_alloc(count, sizeof *stack);
  if (!stack) return DYD_E_NOMEM;
  memset(hull, 0, s->count * sizeof *hull);
  dyd_cert_sort(item, count, compare_place_of, s);
  mark_hull_chain(hull, stack, s, item, count, false);
  mark_hull_chain(hull, stack, s, item, count, true);
  free(stack);
  return DYD_OK;
}

/* Is every corner on the rim exactly once, and a strict corner of the hull of the places? */
static dyd_status check_places(uint32_t *bad, const rim *r, const dyd_cert_sites *s, const dyd_cert_corner *corner,
                               size_t corners) {
  uint32_t *copy = dyd_alloc(r->count, sizeof *copy);
  bool *hull = dyd_alloc(s->count, sizeof *hull);
  uint32_t *times = calloc(s->count ? s->count : 1, sizeof *times);
  dyd_status st = copy && hull && times ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    memcpy(copy, r->site, r->count * sizeof *copy);
    st = dyd_cert_hull(hull, s, copy, dyd_cert_distinct(copy, r->count));
  }
  if (st == DYD_OK) {
    for (size_t q = 0; q < r->count; q++) times[r->site[q]]++;
    for (size_t c = 0; c < corners; c++)
      if (times[corner[c].i] != 1 || !hull[corner[c].i]) *bad = corner[c].i;
  }
  free(copy);
  free(hull);
  free(times);
  return st;
}

/* Is the corner surely beyond all sites of the group (itself left out), in its direction? */
static bool corner_is_beyond(const dyd_cert_sites *s, const dyd_cert_corner *corner, const dyd_cert_parts *p,
                             uint32_t r) {
  for (size_t q = p->start[r]; q < p->start[r + 1]; q++)
    if (p->site[q] != corner->i && dyd_cert_compare_heights(s, corner->u, p->site[q], corner->i) >= 0) return false;
  return true;
}

static int compare_with_corner(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = ((const dyd_cert_corner *)b)->i;
  return (x > y) - (x < y);
}

static void check_corners(uint32_t *bad, const dyd_cert_sites *s, const rim *r, const dyd_cert_parts *p,
                          const dyd_cert_corner *corner, size_t corners) {
  for (size_t q = 0; q < r->count; q++) {
    if (!r->corner[r->site[q]]) continue;
    const dyd_cert_corner *c = bsearch(&r->site[q], corner, corners, sizeof *corner, compare_with_corner);
    uint32_t after = p->group[q], before = p->group[(q + r->count - 1) % r->count];
    if (!corner_is_beyond(s, c, p, after) || (before != after && !corner_is_beyond(s, c, p, before))) *bad = c->i;
  }
}

/* Adds the groups as open sets. A path from corner to corner has one site more than edges; spare[k] counts those of
 * group k, a bridge as many more. */
static dyd_status add_groups(dyd_cert_faces *f, const dyd_cert_graph *g, const rim *r, const dyd_cert_parts *p) {
  size_t *spare = calloc(p->groups, sizeof *spare);
  dyd_status st = spare ? DYD_OK : DYD_E_NOMEM;
  for (size_t q = 0; q < r->count && spare; q++)
    spare[p->group[q]] += dyd_cert_is_legal(g, r->walk[q]) ? 1 : 2 * r->count;
  for (size_t k = 0; k < p->groups && st == DYD_OK; k++) {
    size_t count = p->start[k + 1] - p->start[k];
    st = faces_add_set(f, g, p->site + p->start[k], count, count == spare[k] + 1 ? DYD_CERT_CHAIN : DYD_CERT_ANY);
  }
  free(spare);
  return st;
}

static dyd_status split_rim(dyd_cert_faces *f, uint32_t *bad, const dyd_cert_graph *g, const rim *r,
                            const dyd_cert_corner *corner, size_t corners) {
  if (corners == 0) return faces_add_set(f, g, r->site, r->count, DYD_CERT_ANY);
  dyd_status st = check_places(bad, r, g->sites, corner, corners);
  if (st != DYD_OK || *bad != DYD_CERT_NONE) return st;
  dyd_cert_parts p;
  st = dyd_cert_parts_init(&p, g, r->walk, r->count, r->corner);
  if (st != DYD_OK) return st;
  check_corners(bad, g->sites, r, &p, corner, corners);
  if (st == DYD_OK) st = add_groups(f, g, r, &p);
  dyd_cert_parts_clear(&p);
  return st;
}

static dyd_status faces_add_outer(dyd_cert_faces *f, uint32_t *bad, bool *seen, const dyd_cert_graph *g, uint32_t h,
                                  const dyd_cert_corner *corner, size_t corners) {
  rim r = {0};
  dyd_status st = dyd_cert_walk(&r.walk, &r.count, g, h);
  if (st != DYD_OK) return st;
  r.site = dyd_alloc(r.count, sizeof *r.site);
  r.corner = calloc(g->sites->count, sizeof *r.corner);
  if (r.site && r.corner) {
    for (size_t q = 0; q < r.count; q++) {
      seen[r.walk[q]] = true;
      r.site[q] = dyd_cert_origin(g, r.walk[q]);
    }
    for (size_t c = 0; c < corners; c++) r.corner[corner[c].i] = true;
    st = split_rim(f, bad, g, &r, corner, corners);
  } else {
    st = DYD_E_NOMEM;
  }
  free(r.walk);
  free(r.site);
  free(r.corner);
  return st;
}

/* ---- all ---- */

static dyd_status faces_add_all_sites(dyd_cert_faces *f, const dyd_cert_graph *g) {
  uint32_t *all = dyd_alloc(g->sites->count, sizeof *all);
  if (!all) return DYD_E_NOMEM;
  size_t count = 0;
  for (size_t v = 0; v < g->sites->count; v++)
    if (g->sites->site[v].alias == v) all[count++] = (uint32_t)v;
  dyd_status st = faces_add_set(f, g, all, count, DYD_CERT_ANY);
  free(all);
  return st;
}

static dyd_status faces_find_sets(dyd_cert_faces *f, uint32_t *bad, const dyd_cert_graph *g,
                                  const dyd_cert_corner *corner, size_t corners) {
  uint32_t outer = g->connected ? dyd_cert_outer(g) : DYD_CERT_NONE;
  if (outer == DYD_CERT_NONE) {
    if (corners) *bad = corner[0].i;
    return faces_add_all_sites(f, g);
  }
  bool *seen = calloc(2 * g->count, sizeof *seen);
  if (!seen) return DYD_E_NOMEM;
  dyd_status st = faces_add_outer(f, bad, seen, g, outer, corner, corners);
  for (uint32_t h = 0; h < 2 * g->count && st == DYD_OK && *bad == DYD_CERT_NONE; h++)
    if (!seen[h]) st = add_bounded_face(f, seen, g, h);
  free(seen);
  return st;
}

static dyd_status faces_index_sites(dyd_cert_faces *f, const dyd_cert_sites *s) {
  dyd_cert_entry *entry = dyd_alloc(f->members, sizeof *entry);
  f->first = dyd_alloc(s->count + 1, sizeof *f->first);
  f->of = dyd_alloc(f->members, sizeof *f->of);
  f->covered = calloc(f->sets ? f->sets : 1, sizeof *f->covered);
  f->inexact = calloc(f->sets ? f->sets : 1, sizeof *f->inexact);
  f->tied = calloc(f->sets ? f->sets : 1, sizeof *f->tied);
  bool good = entry && f->first && f->of && f->covered && f->inexact && f->tied;
  for (uint32_t k = 0; k < f->sets && good; k++)
    for (size_t q = f->start[k]; q < f->start[k + 1]; q++) {
      entry[q] = (dyd_cert_entry){f->member[q], k};
      f->inexact[k] |= !dyd_cert_is_point(&s->site[f->member[q]]);
    }
  if (good) dyd_cert_by_key(f->first, f->of, s->count, entry, f->members);
  free(entry);
  return good ? DYD_OK : DYD_E_NOMEM;
}

/* Returns true if set k is a polygon of exact points on one circle, or a chain of such points on one line. */
static bool exact_set_is_tied(const dyd_cert_faces *f, const dyd_cert_sites *s, size_t k) {
  const uint32_t *site = f->member + f->start[k];
  size_t count = f->start[k + 1] - f->start[k];
  if (f->inexact[k] || f->shape[k] == DYD_CERT_ANY) return false;
  return f->shape[k] == DYD_CERT_POLYGON ? dyd_cert_on_circle(s, site, count) : dyd_cert_on_line(s, site, count);
}

dyd_status dyd_cert_faces_init(dyd_cert_faces *f, uint32_t *bad, const dyd_cert_graph *g, const dyd_cert_corner *corner,
                               size_t corners) {
  *f = (dyd_cert_faces){0};
  *bad = DYD_CERT_NONE;
  dyd_status st = faces_find_sets(f, bad, g, corner, corners);
  if (st == DYD_OK) st = faces_index_sites(f, g->sites);
  for (size_t k = 0; k < f->sets && st == DYD_OK; k++) f->tied[k] = exact_set_is_tied(f, g->sites, k);
  if (st == DYD_OK)
    for (size_t e = 0; e < g->legal->count; e++) dyd_cert_faces_cover(f, g->legal->item[e].i, g->legal->item[e].j);
  if (st != DYD_OK) dyd_cert_faces_clear(f);
  return st;
}

void dyd_cert_faces_clear(dyd_cert_faces *f) {
  free(f->start);
  free(f->member);
  free(f->covered);
  free(f->inexact);
  free(f->tied);
  free(f->shape);
  free(f->first);
  free(f->of);
  *f = (dyd_cert_faces){0};
}

/* The next set from *a and *b on that holds both sites; DYD_CERT_NONE: no more. */
static uint32_t next_common_set(const dyd_cert_faces *f, size_t *a, size_t *b, uint32_t i, uint32_t j) {
  while (*a < f->first[i + 1] && *b < f->first[j + 1]) {
    uint32_t x = f->of[*a], y = f->of[*b];
    *a += x <= y;
    *b += y <= x;
    if (x == y) return x;
  }
  return DYD_CERT_NONE;
}

void dyd_cert_faces_cover(dyd_cert_faces *f, uint32_t i, uint32_t j) {
  size_t a = f->first[i], b = f->first[j];
  for (uint32_t k; (k = next_common_set(f, &a, &b, i, j)) != DYD_CERT_NONE;) f->covered[k]++;
}

size_t dyd_cert_faces_common(const dyd_cert_faces *f, uint32_t i, uint32_t j) {
  size_t a = f->first[i], b = f->first[j], count = 0;
  while (next_common_set(f, &a, &b, i, j) != DYD_CERT_NONE) count++;
  return count;
}

bool dyd_cert_faces_share(const dyd_cert_faces *f, uint32_t i, uint32_t j) {
  size_t a = f->first[i], b = f->first[j];
  return next_common_set(f, &a, &b, i, j) != DYD_CERT_NONE;
}

bool dyd_cert_faces_tied(const dyd_cert_faces *f, uint32_t i, uint32_t j) {
  size_t a = f->first[i], b = f->first[j];
  for (uint32_t k; (k = next_common_set(f, &a, &b, i, j)) != DYD_CERT_NONE;)
    if (f->tied[k]) return true;
  return false;
}

bool dyd_cert_faces_still(const dyd_cert_faces *f, uint32_t i, uint32_t j) {
  size_t a = f->first[i], b = f->first[j];
  for (uint32_t k; (k = next_common_set(f, &a, &b, i, j)) != DYD_CERT_NONE;)
    if (f->inexact[k]) return false;
  return true;
}

uint64_t dyd_cert_faces_left(const dyd_cert_faces *f) {
  uint64_t left = 0;
  for (size_t k = 0; k < f->sets; k++) {
    uint64_t m = f->start[k + 1] - f->start[k];
    left += m * (m - 1) / 2 - f->covered[k];
  }
  return left;
}
