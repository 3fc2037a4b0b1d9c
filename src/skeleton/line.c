/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites on one line.
 *
 * Every pair is possible: the closed half-plane of the line has all points on its boundary and none in its open
 * interior. A pair is legal iff a disc holds both rectangles and meets no other, that is iff the segment hull(R_i u
 * R_j) of the line meets no other rectangle (the disc over that segment does it; any disc meets the line in a segment).
 * With two sites the pair is legal [LINE-1]. */
#include "skeleton/skeleton.h"

#include "base/alloc.h"
#include "rect/irect.h"
#include "skeleton/mesh_build.h"

#include <string.h>

/* A site's extent along the line, as scaled integers: the axis along which the sites differ orders them. */
typedef struct entry {
  uint32_t vertex;
  dyd_irect r;
  int axis;
} entry;

void dyd_line_clear(dyd_line *l) {
  dyd_free_all(l->order, l->rank, l->legal);
  memset(l, 0, sizeof *l);
}

static mpz_srcptr line_low(const entry *e) {
  return e->axis == 0 ? e->r.x0 : e->r.y0;
}
static mpz_srcptr line_high(const entry *e) {
  return e->axis == 0 ? e->r.x1 : e->r.y1;
}

static int line_compare(const void *a, const void *b) {
  const entry *x = a, *y = b;
  int c = mpz_cmp(line_low(x), line_low(y));
  if (!c) c = mpz_cmp(line_high(x), line_high(y));
  return c ? c : (x->vertex > y->vertex) - (x->vertex < y->vertex);
}

static dyd_status line_load(entry *e, const dyd_rects *rects, uint32_t count, const uint32_t *vertex) {
  dyd_rect *r = dyd_alloc(count, sizeof *r);
  const dyd_rect **in = calloc((size_t)count + 1, sizeof *in);
  dyd_irect *out = dyd_alloc(count, sizeof *out);
  dyd_status st = r && in && out ? DYD_OK : DYD_E_NOMEM;
  for (uint32_t q = 0; q < count && st == DYD_OK; q++) {
    dyd_rect_init(&r[q]);
    dyd_irect_init(&out[q]);
    dyd_rects_get(&r[q], rects, vertex[q]);
    in[q] = &r[q];
  }
  if (st == DYD_OK) {
    dyd_irects_scale(out, in, count, NULL, NULL);
    for (uint32_t q = 0; q < count; q++) {
      e[q] = (entry){.vertex = vertex[q], .r = out[q]};
      dyd_rect_clear(&r[q]);
    }
  }
  dyd_free_all(out, in, r);
  return st;
}

/* x, unless the line is vertical. */
static int line_axis(const entry *e, uint32_t count) {
  for (uint32_t q = 0; q < count; q++)
    if (mpz_cmp(e[q].r.x0, e[0].r.x0) != 0 || mpz_cmp(e[q].r.x1, e[q].r.x0) != 0) return 0;
  return 1;
}

/* Sorted by lower end. hull(R_q u R_q+1) is free of others iff no site before reaches R_q's lower end and no site after
 * starts at or before the larger upper end. */
static void line_find_legal(dyd_line *l, const entry *e) {
  uint32_t reach = 0; /* the entry with the largest upper end among 0 .. q-1 */
  for (uint32_t q = 0; q + 1 < l->count; q++) {
    mpz_srcptr top = mpz_cmp(line_high(&e[q]), line_high(&e[q + 1])) > 0 ? line_high(&e[q]) : line_high(&e[q + 1]);
    bool before = q == 0 || mpz_cmp(line_high(&e[reach]), line_low(&e[q])) < 0;
    bool after = q + 2 >= l->count || mpz_cmp(line_low(&e[q + 2]), top) > 0;
    l->legal[q] = before && after;
    if (q == 0 || mpz_cmp(line_high(&e[q]), line_high(&e[reach])) > 0) reach = q;
  }
}

/* The first is certainly an end iff it lies before the second, which has the lowest end of the others; the last iff no
 * site reaches it. Two sites need not be on a line: both are ends when they are apart. */
static void line_find_ends(dyd_line *l, const entry *e) {
  uint32_t last = l->count - 1, reach = 0;
  if (l->count == 0) return;
  for (uint32_t q = 1; q < last; q++)
    if (mpz_cmp(line_high(&e[q]), line_high(&e[reach])) > 0) reach = q;
  l->is_end[0] = last == 0 || mpz_cmp(line_high(&e[0]), line_low(&e[1])) < 0;
  l->is_end[1] = last == 0 || mpz_cmp(line_high(&e[reach]), line_low(&e[last])) < 0;
  if (l->count == 2) l->is_end[0] = l->is_end[1] = !dyd_irects_meet(&e[0].r, &e[1].r);
}

static dyd_status line_allocate(dyd_line *l, uint32_t n) {
  return DYD_NEW(l->order, n) && DYD_NEW(l->rank, n) && DYD_ZEROED(l->legal, n ? n : 1) ? DYD_OK : DYD_E_NOMEM;
}

/* Equal exact points are neighbours in the order: the later ones become aliases and leave the list. */
static void line_drop_aliases(dyd_line *l, dyd_mesh *m, const dyd_rects *rects, entry *e) {
  uint32_t kept = 0;
  for (uint32_t q = 0; q < l->count; q++) {
    bool same = kept && dyd_rects_is_point(rects, e[q].vertex) && dyd_rects_is_point(rects, e[kept - 1].vertex) &&
                mpz_cmp(e[q].r.x0, e[kept - 1].r.x0) == 0 && mpz_cmp(e[q].r.y0, e[kept - 1].r.y0) == 0;
    if (same) {
      m->alias[e[q].vertex] = e[kept - 1].vertex;
      dyd_irect_clear(&e[q].r);
    } else
      e[kept++] = e[q];
  }
  l->count = kept;
}

static void line_sort(dyd_line *l, dyd_mesh *m, const dyd_rects *rects, entry *e) {
  int axis = line_axis(e, l->count);
  for (uint32_t q = 0; q < l->count; q++) e[q].axis = axis;
  qsort(e, l->count, sizeof *e, line_compare);
  line_drop_aliases(l, m, rects, e);
  for (uint32_t q = 0; q < l->count; q++) {
    l->order[q] = e[q].vertex;
    l->rank[e[q].vertex] = q;
  }
  line_find_legal(l, e);
  line_find_ends(l, e);
  for (uint32_t q = 0; q < l->count; q++) dyd_irect_clear(&e[q].r);
}

dyd_status dyd_line_build(dyd_line *l, dyd_mesh *m, const dyd_rects *rects, uint32_t n) {
  *l = (dyd_line){0};
  dyd_status st = line_allocate(l, n);
  if (st != DYD_OK) return st;
  for (uint32_t v = 0; v < n; v++) {
    l->rank[v] = DYD_NONE;
    if (dyd_mesh_alias(m, v) == DYD_NONE) l->order[l->count++] = v;
  }
  entry *e = dyd_alloc(l->count, sizeof *e);
  if (!e) return DYD_E_NOMEM;
  st = line_load(e, rects, l->count, l->order);
  if (st == DYD_OK) line_sort(l, m, rects, e);
  free(e);
  return st;
}

bool dyd_line_is_legal(const dyd_line *l, uint32_t v, uint32_t w) {
  uint32_t a = l->rank[v], b = l->rank[w];
  return a < b ? b == a + 1 && l->legal[a] : a == b + 1 && l->legal[b];
}

bool dyd_line_is_end(const dyd_line *l, uint32_t v) {
  return (l->rank[v] == 0 && l->is_end[0]) || (l->rank[v] == l->count - 1 && l->is_end[1]);
}

size_t dyd_line_legal_pairs(const dyd_line *l) {
  size_t count = 0;
  for (uint32_t q = 0; q + 1 < l->count; q++) count += l->legal[q];
  return count;
}

size_t dyd_line_open_pairs(const dyd_line *l) {
  return l->count ? (size_t)l->count * (l->count - 1) / 2 - dyd_line_legal_pairs(l) : 0;
}
