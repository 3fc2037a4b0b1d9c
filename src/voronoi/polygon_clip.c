/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Simple polygons cut to a window, one side after another.
 *
 * Along the line of a side, a simple polygon is inside between the first and the second point at which its boundary
 * crosses, between the third and the fourth, and so on. The pieces of the boundary on the window's side are joined
 * along these intervals. Crossings are rational: the lower end of an interval is rounded down and the upper one up,
 * along the line, so the result holds all inner points of the polygon, and none beyond the line [POLY-3]. */
#include "base/alloc.h"
#include "base/flag.h"
#include "rect/rect.h"
#include "voronoi/polygon.h"

/* One side of W: points with sign * (coordinate - level) > 0 are beyond it. */
typedef struct window_side {
  int axis, sign;
  const dyd_dyadic *level;
} window_side;

/* Where the boundary crosses the line: behind vertex `after`; out: it goes beyond. */
typedef struct crossing {
  mpq_t at;
  size_t after;
  bool out, used;
} crossing;

static const dyd_dyadic *coordinate_of(const dyd_point *z, int axis) {
  return axis ? &z->y : &z->x;
}

/* side[k] > 0: vertex k is beyond. Vertices on the line count as inside, unless they only touch it from beyond.
 * Returns how many are beyond. */
static size_t find_sides(int *side, const dyd_polygon *p, const window_side *w) {
  size_t n = p->count, beyond = 0, from = n;
  for (size_t k = 0; k < n; k++) {
    side[k] = w->sign * dyd_dyadic_cmp(coordinate_of(&p->vertex[k], w->axis), w->level);
    if (side[k] > 0) from = k;
  }
  for (size_t q = 1; from < n && q <= n; q++) {
    size_t k = (from + q) % n, first = q;
    if (side[k]) continue;
    while (!side[(from + q) % n]) q++;
    bool touches = side[(from + first - 1) % n] > 0 && side[(from + q) % n] > 0;
    for (size_t r = first; touches && r < q; r++) side[(from + r) % n] = 1;
  }
  for (size_t k = 0; k < n; k++) beyond += side[k] > 0;
  return beyond;
}

/* The other coordinate of the point of pq on the line. */
static void crossing_place(mpq_t out, const dyd_point *p, const dyd_point *q, const window_side *w) {
  mpq_t a, b, t;
  mpq_inits(a, b, t, NULL);
  dyd_dyadic_get_q(a, coordinate_of(p, w->axis));
  dyd_dyadic_get_q(b, coordinate_of(q, w->axis));
  dyd_dyadic_get_q(t, w->level);
  mpq_sub(t, t, a);
  mpq_sub(b, b, a);
  mpq_div(t, t, b);
  dyd_dyadic_get_q(out, coordinate_of(p, 1 - w->axis));
  dyd_dyadic_get_q(a, coordinate_of(q, 1 - w->axis));
  mpq_sub(a, a, out);
  mpq_mul(a, a, t);
  mpq_add(out, out, a);
  mpq_clears(a, b, t, NULL);
}

static int compare_crossings(const void *a, const void *b) {
  const crossing *p = a, *q = b;
  return mpq_cmp(p->at, q->at);
}

static crossing *find_crossings(size_t *count, const int *side, const dyd_polygon *p, const window_side *w) {
  crossing *c = dyd_alloc(p->count + 1, sizeof *c);
  *count = 0;
  for (size_t k = 0; c && k < p->count; k++) {
    size_t next = (k + 1) % p->count;
    if ((side[k] > 0) == (side[next] > 0)) continue;
    crossing *x = &c[(*count)++];
    *x = (crossing){.after = k, .out = side[next] > 0};
    mpq_init(x->at);
    crossing_place(x->at, &p->vertex[k], &p->vertex[next], w);
  }
  if (*count) qsort(c, *count, sizeof *c, compare_crossings);
  return c;
}

static dyd_status add_vertex(dyd_polygon *out, const dyd_point *z) {
  dyd_point *to = &out->vertex[out->count++];
  dyd_point_init(to);
  dyd_point_set(to, z);
  return DYD_OK;
}

/* The crossing, rounded along the line. */
static dyd_status add_crossing(dyd_polygon *out, const crossing *c, size_t number, const window_side *w, int64_t bits) {
  dyd_point *to = &out->vertex[out->count++];
  dyd_point_init(to);
  dyd_dyadic_set(w->axis ? &to->y : &to->x, w->level);
  return dyd_dyadic_round_q(w->axis ? &to->x : &to->y, c->at, -bits, number & 1 ? DYD_UP : DYD_DOWN);
}

/* The crossing at which the boundary that comes in at c goes out again. */
static size_t crossing_out(const crossing *c, size_t count, size_t from, size_t n, const int *side) {
  size_t k = (c[from].after + 1) % n, out = 0;
  while (side[(k + 1) % n] <= 0) k = (k + 1) % n;
  while (out < count && (c[out].after != k || !c[out].out)) out++;
  return out;
}

/* The ring that comes in at crossing `first`. */
static dyd_status take_ring(dyd_polygon *out, crossing *c, size_t count, size_t first, const dyd_polygon *p,
                            const int *side, const window_side *w, int64_t bits) {
  size_t n = p->count, in = first;
  out->vertex = dyd_alloc(n + 2 * count, sizeof *out->vertex);
  if (!out->vertex) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  do {
    size_t leaves = crossing_out(c, count, in, n, side);
    c[in].used = true;
    st = add_crossing(out, &c[in], in, w, bits);
    for (size_t k = c[in].after; st == DYD_OK && k != c[leaves].after;) {
      k = (k + 1) % n;
      st = add_vertex(out, &p->vertex[k]);
    }
    if (st == DYD_OK) st = add_crossing(out, &c[leaves], leaves, w, bits);
    in = leaves ^ 1;
  } while (st == DYD_OK && in != first && in < count && !c[in].out && !c[in].used);
  return st;
}

/* Appends what of p is not beyond the side; p is taken over. */
static dyd_status cut_polygon(dyd_polygon_list *out, dyd_polygon *p, const window_side *w, int64_t bits) {
  size_t count = 0;
  int *side = dyd_alloc(p->count + 1, sizeof *side);
  if (!side) return DYD_E_NOMEM;
  size_t beyond = find_sides(side, p, w);
  if (!beyond) out->item[out->count++] = *p, *p = (dyd_polygon){0};
  crossing *c = beyond && beyond < p->count ? find_crossings(&count, side, p, w) : NULL;
  dyd_status st = beyond && beyond < p->count && !c ? DYD_E_NOMEM : DYD_OK;
  for (size_t k = 0; k < count && st == DYD_OK; k++)
    if (!c[k].out && !c[k].used) st = take_ring(&out->item[out->count++], c, count, k, p, side, w, bits);
  for (size_t k = 0; k < count; k++) mpq_clear(c[k].at);
  free(c);
  free(side);
  return st;
}

/* One side: a polygon of n vertices becomes at most n / 2 of them. */
static dyd_status cut_list(dyd_polygon_list *l, const window_side *w, int64_t bits) {
  size_t room = 1;
  for (size_t k = 0; k < l->count; k++) room += l->item[k].count;
  dyd_polygon_list out = {.item = calloc(room, sizeof *out.item)};
  dyd_status st = out.item ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) st = cut_polygon(&out, &l->item[k], w, bits);
  dyd_polygon_list_clear(l);
  *l = out;
  return st;
}

/* Drops polygons without area; *simple: the others are simple. */
static dyd_status check_list(bool *simple, dyd_polygon_list *l, const volatile int *cancel) {
  dyd_dyadic area2;
  size_t kept = 0;
  dyd_status st = DYD_OK;
  dyd_dyadic_init(&area2);
  *simple = true;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) {
    bool good = true;
    st = dyd_polygon_area2(&area2, &l->item[k]);
    bool some = dyd_dyadic_sgn(&area2) > 0;
    if (st == DYD_OK && some) st = dyd_polygon_is_simple(&good, &l->item[k], cancel);
    if (!some) dyd_polygon_clear(&l->item[k]);
    *simple = *simple && good;
    dyd_polygon p = l->item[k];
    l->item[k] = (dyd_polygon){0};
    if (some) l->item[kept++] = p;
  }
  if (st == DYD_OK) l->count = kept;
  dyd_dyadic_clear(&area2);
  return st;
}

static bool list_is_within(const dyd_polygon_list *l, const dyd_rect *window) {
  for (size_t p = 0; p < l->count; p++)
    for (size_t k = 0; k < l->item[p].count; k++)
      if (!dyd_rect_holds(window, &l->item[p].vertex[k])) return false;
  return true;
}

dyd_status dyd_polygons_clip(bool *simple, dyd_polygon_list *l, const dyd_rect *window, int64_t bits,
                             const volatile int *cancel) {
  const window_side side[4] = {
      {0, -1, &window->x.lo}, {0, 1, &window->x.hi}, {1, -1, &window->y.lo}, {1, 1, &window->y.hi}};
  dyd_status st = DYD_OK;
  *simple = true;
  if (list_is_within(l, window)) return st;
  for (int k = 0; k < 4 && st == DYD_OK; k++)
    st = dyd_flag_is_set(cancel) ? DYD_CANCELLED : cut_list(l, &side[k], bits);
  return st == DYD_OK ? check_list(simple, l, cancel) : st;
}
