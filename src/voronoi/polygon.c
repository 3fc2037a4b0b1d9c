/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Polygons with dyadic vertices: exact work on them, and those of a cell, from its exact boundary. In a window no chain
 * means no cell: where the cell is all of the window, its chain is the window's sides.
 *
 * Samples of the boundary are moved a little off it, rounded, and proved exactly; where rounding spoils one, it is
 * taken anew with more bits. This ends: inwards, the samples move towards a point g inside the open convex set Int_i n
 * W, so that the segment's end has a disc around it inside the set; outwards, they move along the ray from their
 * nearest point of R_i, on which ds_i grows by the length of the step and every dl_k by less, unless R_k meets R_i.
 *
 * Moves are at most 2^-(bits+2), chords are within 2^-(bits+1) of their arcs. [POLY-1] [POLY-2] */
#include "voronoi/shape.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include "voronoi/exact_cell.h"
#include "voronoi/sample.h"

void dyd_polygon_clear(dyd_polygon *p) {
  for (size_t k = 0; k < p->count; k++) dyd_point_clear(&p->vertex[k]);
  free(p->vertex);
  *p = (dyd_polygon){0};
}

void dyd_polygon_list_clear(dyd_polygon_list *l) {
  for (size_t k = 0; k < l->count; k++) dyd_polygon_clear(&l->item[k]);
  free(l->item);
  *l = (dyd_polygon_list){0};
}

/* A difference of dyadics without bounds on its exponent. */
typedef struct raw {
  mpz_t man;
  int64_t exp;
} raw;

static void raw_product(raw *out, const raw *a, const raw *b) {
  mpz_mul(out->man, a->man, b->man);
  out->exp = a->exp + b->exp;
}

/* a -= b, aligned to the lower exponent. */
static void raw_subtract(raw *a, raw *b) {
  if (a->exp > b->exp) {
    mpz_mul_2exp(a->man, a->man, (mp_bitcnt_t)(a->exp - b->exp));
    a->exp = b->exp;
  } else if (b->exp > a->exp) {
    mpz_mul_2exp(b->man, b->man, (mp_bitcnt_t)(b->exp - a->exp));
  }
  mpz_sub(a->man, a->man, b->man);
}

/* r[0] = (b - a) x (c - a); r[1..5] are scratch. */
static void raw_cross(raw r[6], const dyd_point *a, const dyd_point *b, const dyd_point *c) {
  dyd_raw_add(r[2].man, &r[2].exp, &b->x, &a->x, -1);
  dyd_raw_add(r[3].man, &r[3].exp, &c->y, &a->y, -1);
  dyd_raw_add(r[4].man, &r[4].exp, &b->y, &a->y, -1);
  dyd_raw_add(r[5].man, &r[5].exp, &c->x, &a->x, -1);
  raw_product(&r[0], &r[2], &r[3]);
  raw_product(&r[1], &r[4], &r[5]);
  if (mpz_sgn(r[0].man) == 0) r[0].exp = r[1].exp;
  if (mpz_sgn(r[1].man) == 0) r[1].exp = r[0].exp;
  raw_subtract(&r[0], &r[1]);
}

static void raw_init(raw *r) {
  mpz_init(r->man);
  r->exp = 0;
}

static void raw_clear(raw *r) {
  mpz_clear(r->man);
}

DYD_ARRAYS(raw)

/* Sign of the turn a, b, c: > 0 left. */
static int turn_sign(const dyd_point *a, const dyd_point *b, const dyd_point *c) {
  DYD_LOCAL_ARRAY(raw, r, [6]);
  raw_cross(r, a, b, c);
  return mpz_sgn(r[0].man);
}

dyd_status dyd_polygon_area2(dyd_dyadic *out, const dyd_polygon *p) {
  DYD_LOCAL_ARRAY(raw, r, [6]);
  DYD_LOCAL(dyd_dyadic, sum, term);
  dyd_status st = DYD_OK;
  for (size_t k = 1; k + 1 < p->count && st == DYD_OK; k++) {
    raw_cross(r, &p->vertex[0], &p->vertex[k], &p->vertex[k + 1]);
    st = dyd_dyadic_take(&term, r[0].man, r[0].exp);
    if (st == DYD_OK) st = dyd_dyadic_add(&sum, &sum, &term);
  }
  if (st == DYD_OK) dyd_dyadic_swap(out, &sum);
  return st;
}

/* ---- hull ---- */

static int compare_vertices(const void *a, const void *b) {
  const dyd_point *p = a, *q = b;
  int c = dyd_dyadic_cmp(&p->x, &q->x);
  return c ? c : dyd_dyadic_cmp(&p->y, &q->y);
}

/* Extends the chain of `kept` borrowed points by z, popping vertices without a left turn; stays above `floor`. */
static size_t extend_chain(const dyd_point **chain, size_t kept, size_t floor, const dyd_point *z) {
  while (kept >= floor + 2 && turn_sign(chain[kept - 2], chain[kept - 1], z) <= 0) kept--;
  chain[kept++] = z;
  return kept;
}

/* Monotone chains: lower, then upper. */
dyd_status dyd_polygon_make_convex(dyd_polygon *p) {
  size_t n = p->count, kept = 0;
  DYD_FREED const dyd_point **chain = dyd_alloc(2 * n + 1, sizeof *chain);
  if (!chain) return DYD_E_NOMEM;
  qsort(p->vertex, n, sizeof *p->vertex, compare_vertices);
  for (size_t k = 0; k < n; k++) kept = extend_chain(chain, kept, 0, &p->vertex[k]);
  size_t floor = kept ? kept - 1 : 0;
  for (size_t k = n; k-- > 1;) kept = extend_chain(chain, kept, floor, &p->vertex[k - 1]);
  kept = kept ? kept - 1 : 0; /* the first point again */
  dyd_polygon hull = {0};
  if (kept >= 3) hull.vertex = dyd_alloc(kept, sizeof *hull.vertex);
  dyd_status st = kept >= 3 && !hull.vertex ? DYD_E_NOMEM : DYD_OK;
  for (size_t k = 0; st == DYD_OK && kept >= 3 && k < kept; k++) {
    dyd_point_init(&hull.vertex[k]);
    dyd_point_set(&hull.vertex[k], chain[k]);
    hull.count++;
  }
  if (st != DYD_OK) return st;
  dyd_polygon_clear(p);
  *p = hull;
  return DYD_OK;
}

/* ---- simplicity ---- */

static bool on_segment(const dyd_point *z, const dyd_point *a, const dyd_point *b) {
  return compare_vertices(z, a) * compare_vertices(z, b) <= 0; /* z is on the line ab */
}

/* Returns true if the closed segments ab and cd meet. */
static bool segments_meet(const dyd_point *a, const dyd_point *b, const dyd_point *c, const dyd_point *d) {
  int s = turn_sign(a, b, c), t = turn_sign(a, b, d), u = turn_sign(c, d, a), v = turn_sign(c, d, b);
  if (s * t < 0 && u * v < 0) return true;
  return (s == 0 && on_segment(c, a, b)) || (t == 0 && on_segment(d, a, b)) || (u == 0 && on_segment(a, c, d)) ||
         (v == 0 && on_segment(b, c, d));
}

/* Edges ab and bc: do they overlap beyond b? */
static bool folds_back(const dyd_point *a, const dyd_point *b, const dyd_point *c) {
  return turn_sign(a, b, c) == 0 && compare_vertices(a, b) * compare_vertices(b, c) < 0;
}

static void drop_repeats(dyd_polygon *p) {
  size_t kept = 0;
  for (size_t k = 0; k < p->count; k++) {
    const dyd_point *last = &p->vertex[kept ? kept - 1 : p->count - 1];
    if (compare_vertices(&p->vertex[k], last) == 0 && p->count > 1) continue;
    dyd_dyadic_swap(&p->vertex[kept].x, &p->vertex[k].x);
    dyd_dyadic_swap(&p->vertex[kept].y, &p->vertex[k].y);
    kept++;
  }
  for (size_t k = kept; k < p->count; k++) dyd_point_clear(&p->vertex[k]);
  p->count = kept;
}

/* Outward boxes of the edges: x lower, x upper, y lower, y upper. */
static void edge_box(double out[4], const dyd_point *a, const dyd_point *b) {
  for (int axis = 0; axis < 2; axis++) {
    const dyd_dyadic *s = axis ? &a->y : &a->x, *t = axis ? &b->y : &b->x;
    bool less = dyd_dyadic_cmp(s, t) < 0;
    out[2 * axis] = dyd_dyadic_get_d(less ? s : t, DYD_DOWN);
    out[2 * axis + 1] = dyd_dyadic_get_d(less ? t : s, DYD_UP);
  }
}

static bool boxes_meet(const double a[4], const double b[4]) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3];
}

/* Edges i < j, whose boxes meet. */
static bool edges_are_free(const dyd_polygon *p, size_t i, size_t j) {
  size_t n = p->count;
  const dyd_point *z = p->vertex, *a = &z[i], *b = &z[i + 1], *c = &z[j], *d = &z[(j + 1) % n];
  bool after = i + 1 == j, before = j + 1 == n && i == 0;
  if (after && folds_back(a, b, d)) return false;
  if (before && folds_back(c, d, b)) return false;
  return after || before || !segments_meet(a, b, c, d);
}

/* Boxes of the edges, from number `leaves` on, which is a power of 2, and of all below a node: 2 k and 2 k + 1 are
 * below k. Edges that follow each other are near each other, so few boxes meet. */
typedef struct edge_boxes {
  const dyd_polygon *p;
  double (*box)[4];
  size_t leaves;
  const volatile int *cancel;
} edge_boxes;

/* Returns true if no edge below a meets one below b, which come later, or the work is cancelled. */
static bool branches_are_free(const edge_boxes *t, size_t a, size_t b) {
  if (!boxes_meet(t->box[a], t->box[b]) || dyd_flag_is_set(t->cancel)) return true;
  if (a >= t->leaves) return edges_are_free(t->p, a - t->leaves, b - t->leaves);
  for (size_t k = 0; k < 4; k++)
    if (!branches_are_free(t, 2 * a + (k >> 1), 2 * b + (k & 1))) return false;
  return true;
}

static void fill_boxes(edge_boxes *t) {
  for (size_t k = 2 * t->leaves; k-- > 1;) {
    double *out = t->box[k];
    size_t j = k - t->leaves, n = t->p->count;
    for (int q = 0; q < 4; q++) out[q] = q & 1 ? -INFINITY : INFINITY;
    if (k >= t->leaves && j < n) edge_box(out, &t->p->vertex[j], &t->p->vertex[(j + 1) % n]);
    for (size_t half = 0; k < t->leaves && half < 2; half++) {
      const double *b = t->box[2 * k + half];
      for (int q = 0; q < 4; q++) out[q] = q & 1 ? fmax(out[q], b[q]) : fmin(out[q], b[q]);
    }
  }
}

dyd_status dyd_polygon_is_simple(bool *out, dyd_polygon *p, const volatile int *cancel) {
  edge_boxes t = {.p = p, .leaves = 1, .cancel = cancel};
  drop_repeats(p);
  while (t.leaves < p->count) t.leaves *= 2;
  t.box = dyd_alloc(2 * t.leaves, sizeof *t.box);
  if (!t.box) return DYD_E_NOMEM;
  fill_boxes(&t);
  *out = p->count >= 3;
  for (size_t k = 1; *out && k < t.leaves; k++) *out = branches_are_free(&t, 2 * k, 2 * k + 1);
  free(t.box);
  return dyd_flag_is_set(cancel) ? DYD_CANCELLED : DYD_OK;
}

/* ---- copies ---- */

dyd_status dyd_polygon_copy(dyd_polygon *out, const dyd_polygon *p) {
  dyd_polygon copy = {0};
  copy.vertex = dyd_alloc(p->count, sizeof *copy.vertex);
  if (!copy.vertex) return DYD_E_NOMEM;
  for (; copy.count < p->count; copy.count++) {
    dyd_point_init(&copy.vertex[copy.count]);
    dyd_point_set(&copy.vertex[copy.count], &p->vertex[copy.count]);
  }
  *out = copy;
  return DYD_OK;
}

/* ---- simple polygons cut to a window, one side after another ----
 *
 * Along the line of a side, a simple polygon is inside between the first and the second point at which its boundary
 * crosses, between the third and the fourth, and so on. The pieces of the boundary on the window's side are joined
 * along these intervals. Crossings are rational: the lower end of an interval is rounded down and the upper one up,
 * along the line, so the result holds all inner points of the polygon, and none beyond the line [POLY-3]. */

static const dyd_dyadic *coordinate_of(const dyd_point *z, int axis) {
  return axis ? &z->y : &z->x;
}

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
  DYD_LOCAL_NUMBERS(mpq, a, b, t);
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
  DYD_FREED int *side = dyd_alloc(p->count + 1, sizeof *side);
  if (!side) return DYD_E_NOMEM;
  size_t beyond = find_sides(side, p, w);
  if (!beyond) out->item[out->count++] = *p, *p = (dyd_polygon){0};
  DYD_FREED crossing *c = beyond && beyond < p->count ? find_crossings(&count, side, p, w) : NULL;
  dyd_status st = beyond && beyond < p->count && !c ? DYD_E_NOMEM : DYD_OK;
  for (size_t k = 0; k < count && st == DYD_OK; k++)
    if (!c[k].out && !c[k].used) st = take_ring(&out->item[out->count++], c, count, k, p, side, w, bits);
  for (size_t k = 0; k < count; k++) mpq_clear(c[k].at);
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
  size_t kept = 0;
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_dyadic, area2);
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

/* ---- the polygons of a cell ---- */

/* FINER: bits by which polygons that cross themselves are made finer. Parabolas take twice as many chords for two bits,
 * so coarse attempts cost less than the one that is fine enough. */
enum { FIRST_EXTRA = 8, MOST_EXTRA = 1 << 15, MOST_ANEW = 1 << 13, FINER = 2 };

typedef struct polygon_work {
  dyd_cell_sites sites;
  uint32_t own;
  const dyd_rect *window; /* W, or one that is wider */
  int64_t bits;
  const volatile int *cancel;
  dyd_memory *memory;
  dyd_boundary boundary;
  dyd_arc_samples samples;
  dyd_point goal; /* of inward moves: a point inside */
  mpq_t d[2], s, t;
} polygon_work;

/* z += d 2^-shift with shift such that the move has between 2^-(bits+5) and 2^-(bits+2), or the whole of d if that is
 * shorter and not `stretch`; rounded to multiples of 2^-fine. */
static dyd_status move_by_step(dyd_point *z, polygon_work *w, bool stretch, int64_t fine) {
  int64_t shift = dyd_log2_length(w->d[0], w->d[1]) + w->bits + 2;
  dyd_status st = DYD_OK;
  if (shift < 1 && !stretch) shift = 1;
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    mpq_ptr d = w->d[axis];
    if (shift >= 0)
      mpq_div_2exp(d, d, (mp_bitcnt_t)shift);
    else
      mpq_mul_2exp(d, d, (mp_bitcnt_t)-shift);
    dyd_dyadic_get_q(w->s, coordinate_of(z, axis));
    mpq_add(d, d, w->s);
    st = dyd_dyadic_round_q(axis ? &z->y : &z->x, d, -fine, DYD_DOWN);
  }
  return st;
}

/* ---- inward ---- */

/* goal = the mean of the samples, rounded: inside when fine is large enough. */
static dyd_status find_inner_goal(bool *out, polygon_work *w, int64_t fine) {
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_point, z);
  for (int a = 0; a < 2; a++) mpq_set_ui(w->d[a], 0, 1);
  for (size_t k = 0; k < w->samples.count && st == DYD_OK; k++) {
    if (dyd_flag_is_set(w->cancel)) st = DYD_CANCELLED;
    if (st == DYD_OK) st = dyd_sample_point(&z, &w->samples.item[k], &w->sites, w->own, fine);
    for (int a = 0; a < 2; a++) {
      dyd_dyadic_get_q(w->s, coordinate_of(&z, a));
      mpq_add(w->d[a], w->d[a], w->s);
    }
  }
  mpq_set_ui(w->s, w->samples.count, 1);
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    mpq_div(w->d[a], w->d[a], w->s);
    st = dyd_dyadic_round_q(a ? &w->goal.y : &w->goal.x, w->d[a], -fine, DYD_DOWN);
  }
  *out = st == DYD_OK && dyd_rect_holds(w->window, &w->goal) && dyd_cell_holds(&w->sites, &w->goal);
  return st;
}

static dyd_status place_inner(bool *out, dyd_point *z, polygon_work *w, const dyd_arc_sample *at, int64_t fine) {
  dyd_status st = dyd_sample_point(z, at, &w->sites, w->own, fine);
  if (st != DYD_OK) return st;
  for (int a = 0; a < 2; a++) {
    dyd_dyadic_get_q(w->s, coordinate_of(z, a));
    dyd_dyadic_get_q(w->d[a], coordinate_of(&w->goal, a));
    mpq_sub(w->d[a], w->d[a], w->s);
  }
  st = move_by_step(z, w, false, fine);
  *out = st == DYD_OK && dyd_rect_holds(w->window, z) && dyd_cell_holds(&w->sites, z);
  return st;
}

/* ---- outward ---- */

/* d = z minus its nearest point in R_i. */
static void set_away(polygon_work *w, const dyd_point *z) {
  const dyd_rect *r = &w->sites.own;
  for (int axis = 0; axis < 2; axis++) {
    mpq_ptr d = w->d[axis];
    dyd_interval_get_q(w->s, w->t, axis ? &r->y : &r->x);
    dyd_dyadic_get_q(d, axis ? &z->y : &z->x);
    if (mpq_cmp(d, w->s) <= 0)
      mpq_sub(d, d, w->s);
    else if (mpq_cmp(d, w->t) >= 0)
      mpq_sub(d, d, w->t);
    else
      mpq_set_ui(d, 0, 1);
  }
}

/* Returns true if z is in C_ki for the far site k of the arc. Window arcs ask nothing. */
static bool beyond_arc(const polygon_work *w, const dyd_arc *arc, const dyd_point *z) {
  return arc->kind == DYD_ARC_WINDOW ||
         dyd_nearer(z, dyd_cell_site(&w->sites, arc->far_site), &w->sites.own) == DYD_TRUE;
}

static dyd_status place_outer(bool *out, dyd_point *z, polygon_work *w, const dyd_arc_sample *at, int64_t fine) {
  dyd_status st = dyd_sample_point(z, at, &w->sites, w->own, fine);
  if (st != DYD_OK) return st;
  if (at->arc->kind == DYD_ARC_WINDOW && at->before->kind == DYD_ARC_WINDOW) {
    *out = true; /* a corner of W: its edges need no proof */
    return DYD_OK;
  }
  set_away(w, z);
  st = move_by_step(z, w, true, fine);
  *out = st == DYD_OK && beyond_arc(w, at->arc, z) && beyond_arc(w, at->before, z);
  return st;
}

/* ---- both ---- */

typedef dyd_status (*place_fn)(bool *out, dyd_point *z, polygon_work *w, const dyd_arc_sample *at, int64_t fine);

/* Proved points for all samples. */
static dyd_status place_samples(dyd_polygon *out, polygon_work *w, place_fn place, int64_t extra) {
  const dyd_arc_samples *all = &w->samples;
  out->vertex = dyd_alloc(all->count, sizeof *out->vertex);
  if (!out->vertex) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (; out->count < all->count && st == DYD_OK; out->count++) {
    dyd_point *z = &out->vertex[out->count];
    dyd_point_init(z);
    bool done = false;
    if (dyd_flag_is_set(w->cancel)) st = DYD_CANCELLED;
    for (int64_t e = extra; !done && st == DYD_OK; e *= 2)
      st = e > MOST_EXTRA ? DYD_E_RANGE : place(&done, z, w, &all->item[out->count], w->bits + e);
  }
  return st;
}

static dyd_status exact_inner(dyd_polygon *out, polygon_work *w) {
  bool found = false;
  dyd_status st = dyd_chain_samples(&w->samples, &w->boundary.chain[0], &w->sites, w->own, w->bits + 1, w->memory);
  for (int64_t extra = FIRST_EXTRA; !found && st == DYD_OK; extra *= 2)
    st = extra > MOST_EXTRA ? DYD_E_RANGE : find_inner_goal(&found, w, w->bits + extra);
  if (st == DYD_OK) st = place_samples(out, w, place_inner, FIRST_EXTRA);
  return st == DYD_OK ? dyd_polygon_make_convex(out) : st;
}

/* One part; taken anew with more bits while it crosses itself. Where arcs come nearer to each other than samples of
 * that number can follow, scales are too far apart for polygons: DYD_E_RANGE. */
static dyd_status exact_outer_part(dyd_polygon *out, polygon_work *w, const dyd_chain *chain) {
  int64_t bits = w->bits;
  bool simple = false;
  dyd_status st = DYD_OK;
  for (int64_t extra = 0; !simple && st == DYD_OK; extra += FINER) {
    if (extra > MOST_EXTRA) return DYD_E_RANGE;
    dyd_polygon_clear(out);
    w->samples.count = 0;
    w->bits = bits + extra;
    st = dyd_chain_samples(&w->samples, chain, &w->sites, w->own, w->bits + 1, w->memory);
    if (st == DYD_OK && extra > 0 && w->samples.count > MOST_ANEW) st = DYD_E_RANGE;
    if (st == DYD_OK) st = place_samples(out, w, place_outer, FIRST_EXTRA);
    if (st == DYD_OK) st = dyd_polygon_is_simple(&simple, out, w->cancel);
  }
  w->bits = bits;
  return st;
}

/* A polygon that comes out clockwise winds round no point of Pos_i n W: its part was outside of W, and is dropped. */
static dyd_status drop_if_clockwise(dyd_polygon_list *l) {
  DYD_LOCAL(dyd_dyadic, area2);
  dyd_status st = dyd_polygon_area2(&area2, &l->item[l->count - 1]);
  if (st == DYD_OK && dyd_dyadic_sgn(&area2) <= 0) dyd_polygon_clear(&l->item[--l->count]);
  return st;
}

static dyd_status exact_outer_parts(dyd_polygon_list *out, polygon_work *w) {
  dyd_polygon_list_clear(out);
  out->item = calloc(w->boundary.count, sizeof *out->item);
  if (!out->item) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < w->boundary.count && st == DYD_OK; k++) {
    st = exact_outer_part(&out->item[out->count++], w, &w->boundary.chain[k]);
    if (st == DYD_OK) st = drop_if_clockwise(out);
  }
  return st;
}

/* Cut to W; taken anew with more bits while that spoils one. */
static dyd_status exact_outer(dyd_polygon_list *out, polygon_work *w, const dyd_rect *window) {
  int64_t bits = w->bits;
  bool simple = false;
  dyd_status st = DYD_OK;
  for (int64_t extra = 0; !simple && st == DYD_OK; extra += FINER) {
    if (extra > MOST_EXTRA) return DYD_E_RANGE;
    w->bits = bits + extra;
    st = exact_outer_parts(out, w);
    if (st == DYD_OK) st = dyd_polygons_clip(&simple, out, window, w->bits + DYD_CLIP_EXTRA, w->cancel);
  }
  w->bits = bits;
  return st;
}

dyd_status dyd_window_enlarge(dyd_rect *out, const dyd_rect *window, int64_t bits) {
  DYD_LOCAL(dyd_dyadic, margin);
  dyd_status st = dyd_dyadic_set_si_2exp(&margin, 1, -(bits + 1));
  dyd_rect_set(out, window);
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    dyd_interval *side = axis ? &out->y : &out->x;
    st = dyd_dyadic_sub(&side->lo, &side->lo, &margin);
    if (st == DYD_OK) st = dyd_dyadic_add(&side->hi, &side->hi, &margin);
  }
  return st;
}

dyd_status dyd_exact_polygons(dyd_polygon *inner, dyd_polygon_list *outer, const dyd_delaunay *pd, uint32_t i,
                              const dyd_window *window, int64_t bits) {
  polygon_work w = {.own = i,
                    .window = window->rect,
                    .bits = bits,
                    .cancel = window->cancel,
                    .memory = window->memory,
                    .samples = {.most = window->most}};
  DYD_LOCAL(dyd_rect, wide);
  dyd_point_init(&w.goal);
  mpq_inits(w.d[0], w.d[1], w.s, w.t, NULL);
  dyd_status st = dyd_cell_sites_init(&w.sites, pd, i, dyd_least_at(pd, i, window->proved));
  if (st == DYD_OK) st = dyd_cell_sites_enclose(&w.sites);
  if (st == DYD_OK) st = dyd_cell_region(&w.boundary, pd, i, false, window->proved, w.window, w.memory, w.cancel);
  if (st == DYD_OK && w.boundary.count) st = exact_inner(inner, &w);
  if (st == DYD_OK) st = dyd_window_enlarge(&wide, window->rect, bits);
  w.window = &wide;
  if (st == DYD_OK) st = dyd_cell_region(&w.boundary, pd, i, true, window->proved, w.window, w.memory, w.cancel);
  if (st == DYD_OK && w.boundary.count) st = exact_outer(outer, &w, window->rect);
  mpq_clears(w.d[0], w.d[1], w.s, w.t, NULL);
  dyd_point_clear(&w.goal);
  free(w.samples.item);
  dyd_boundary_clear(&w.boundary);
  dyd_cell_sites_clear(&w.sites);
  return st;
}
