/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Hulls of rectangles, and the exterior of T: the complement of the union of the partial edges, by exact polygons.
 *
 * The boundary of the union consists of the parts of edges of hulls that are in the interior of no hull. Along an edge,
 * p + t (q - p), each side of another hull has an affine value, so the t inside that hull are an interval, found by
 * signs and quotients of integers: all corners are scaled by one denominator. The ends of these intervals cut the edge
 * into pieces, and each piece is inside of a hull, or not; on its left, and on its right, there is a hull, or the
 * exterior.
 *
 * Pieces that have the exterior on their left are joined to rings [EXT-1]: behind a piece comes the first one clockwise
 * from its way back, since the angle between the two is exterior. All possible pairs hold a Delaunay triangulation of a
 * choice, so the union is connected: each component of the exterior has one ring, and all but one are bounded.
 * Hulls of exact points are segments, which have the exterior on both sides. */
#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "rect/sites_table.h"
#include "skeleton/rects_filter.h"
#include "skeleton/reps.h"
#include <dyadel/metric.h>

#include <string.h>

enum { HULL_MOST = 12, CORNERS = 4 };

/* ---- corners ---- */

/* Times the common denominator. */
typedef struct ext_spot {
  mpz_t at[2];
} ext_spot;

/* Twice the signed area of a, b, c, points (x, y): positive if they turn left. */
static void ext_turn(mpz_ptr out, mpz_ptr scratch, const ext_spot *a, const ext_spot *b, const ext_spot *c) {
  DYD_LOCAL_ARRAY(mpz_t, d, [2]);
  mpz_sub(out, b->at[0], a->at[0]);
  mpz_sub(d[0], c->at[1], a->at[1]);
  mpz_mul(out, out, d[0]);
  mpz_sub(d[0], b->at[1], a->at[1]);
  mpz_sub(d[1], c->at[0], a->at[0]);
  mpz_mul(scratch, d[0], d[1]);
  mpz_sub(out, out, scratch);
}

static int ext_turn_sign(const ext_spot *a, const ext_spot *b, const ext_spot *c) {
  DYD_LOCAL_NUMBERS(mpz, out, scratch);
  ext_turn(out, scratch, a, b, c);
  return mpz_sgn(out);
}

static int ext_compare(const ext_spot *a, const ext_spot *b) {
  int by_x = mpz_cmp(a->at[0], b->at[0]);
  return by_x ? by_x : mpz_cmp(a->at[1], b->at[1]);
}

/* One monotone chain of the sorted corners v[0..n-1], forwards or backwards, behind the chain so far. */
static size_t ext_chain(uint32_t *out, size_t count, const uint32_t *v, size_t n, bool back, const ext_spot *z) {
  size_t first = count;
  for (size_t k = 0; k < n; k++) {
    uint32_t next = v[back ? n - 1 - k : k];
    while (count >= first + 2 && ext_turn_sign(&z[out[count - 2]], &z[out[count - 1]], &z[next]) <= 0) count--;
    out[count++] = next;
  }
  return count - 1; /* the last one begins the other chain */
}

/* The hull of corners z[v[k]], k < n <= HULL_MOST, counter-clockwise from the least in x, then y: v becomes its
 * vertices; returns how many. */
static size_t ext_hull(uint32_t v[HULL_MOST], size_t n, const ext_spot *z) {
  uint32_t out[2 * HULL_MOST];
  size_t kept = 0;
  for (size_t k = 1; k < n; k++)
    for (size_t m = k; m > 0 && ext_compare(&z[v[m]], &z[v[m - 1]]) < 0; m--) {
      uint32_t swap = v[m];
      v[m] = v[m - 1], v[m - 1] = swap;
    }
  for (size_t k = 0; k < n; k++)
    if (!kept || ext_compare(&z[v[k]], &z[v[kept - 1]])) v[kept++] = v[k];
  if (kept < 3 && kept > 0) return kept;
  size_t count = ext_chain(out, 0, v, kept, false, z);
  count = ext_chain(out, count, v, kept, true, z);
  memcpy(v, out, count * sizeof *v);
  return count;
}

/* Corner k of a rectangle: bit 0 chooses x1 over x0, bit 1 y1 over y0. */
static void ext_corner(mpq_t out[2], const dyd_rect *r, int k) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  for (int a = 0; a < 2; a++) {
    dyd_interval_get_q(lo, hi, a ? &r->y : &r->x);
    mpq_set(out[a], k >> a & 1 ? hi : lo);
  }
}

static void ext_scale(ext_spot *out, mpq_t in[2], const mpz_t den) {
  for (int a = 0; a < 2; a++) {
    mpz_divexact(out->at[a], den, mpq_denref(in[a]));
    mpz_mul(out->at[a], out->at[a], mpq_numref(in[a]));
  }
}

size_t dyd_rect_hull(mpq_t out[24], const dyd_rect *const *r, size_t count) {
  mpq_t corner[HULL_MOST][2];
  ext_spot z[HULL_MOST];
  uint32_t v[HULL_MOST];
  size_t n = count > 3 ? 0 : CORNERS * count;
  DYD_LOCAL_NUMBERS(mpz, den);
  mpz_set_ui(den, 1);
  for (uint32_t k = 0; k < HULL_MOST; k++) {
    v[k] = k;
    for (int a = 0; a < 2; a++) mpq_init(corner[k][a]), mpz_init(z[k].at[a]);
    if (k < n) ext_corner(corner[k], r[k / CORNERS], k % CORNERS);
    for (int a = 0; a < 2; a++) mpz_lcm(den, den, mpq_denref(corner[k][a]));
  }
  for (size_t k = 0; k < n; k++) ext_scale(&z[k], corner[k], den);
  if (n) n = ext_hull(v, n, z);
  for (size_t k = 0; k < n; k++)
    for (int a = 0; a < 2; a++) mpq_set(out[2 * k + (size_t)a], corner[v[k]][a]);
  for (size_t k = 0; k < HULL_MOST; k++)
    for (int a = 0; a < 2; a++) mpq_clear(corner[k][a]), mpz_clear(z[k].at[a]);
  return n;
}

/* ---- the hulls of all pairs ---- */

typedef struct ext_face {
  uint32_t n, v[8]; /* two rectangles have at most eight vertices */
} ext_face;

typedef struct ext_place {
  mpq_t at[2];
} ext_place;

/* A part of an edge, from its lesser end: at[0] < at[1]; open[s]: the exterior is on its left (s = 0), its right. */
typedef struct ext_piece {
  ext_place end[2];
  mpz_t way[2];
  uint32_t at[2];
  bool open[2];
} ext_piece;

typedef struct ext_work {
  ext_spot *z; /* corner CORNERS * site + k, times den */
  mpz_t den;
  size_t corners;
  ext_face *hull;
  dyd_bbox *box;
  size_t count, around;
  dyd_tree tree;
  uint32_t *near;
  size_t near_count, near_cap;
  ext_piece *piece;
  size_t pieces, cap;
  bool failed; /* memory ran out */
} ext_work;

static void ext_piece_clear(ext_piece *p) {
  for (int e = 0; e < 2; e++) {
    mpz_clear(p->way[e]);
    for (int a = 0; a < 2; a++) mpq_clear(p->end[e].at[a]);
  }
}

static void ext_work_clear(ext_work *w) {
  for (size_t k = 0; k < w->pieces; k++) ext_piece_clear(&w->piece[k]);
  for (size_t k = 0; k < w->corners; k++) mpz_clears(w->z[k].at[0], w->z[k].at[1], NULL);
  dyd_tree_clear(&w->tree);
  dyd_free_all(w->piece, w->near, w->box, w->hull, w->z);
  mpz_clear(w->den);
}

/* The common denominator first, then the corners. */
static dyd_status ext_corners(ext_work *w, const dyd_sites *sites) {
  size_t n = CORNERS * dyd_sites_count(sites);
  dyd_status st = DYD_OK;
  w->z = dyd_alloc(n, sizeof *w->z);
  if (!w->z) return DYD_E_NOMEM;
  DYD_LOCAL_ARRAY(mpq_t, at, [2]);
  DYD_LOCAL(dyd_rect, r);
  for (int pass = 0; pass < 2; pass++)
    for (size_t k = 0; k < n && st == DYD_OK; k++) {
      if (k % CORNERS == 0) st = dyd_sites_get(&r, sites, k / CORNERS);
      ext_corner(at, &r, k % CORNERS);
      for (int a = 0; a < 2 && !pass; a++) mpz_lcm(w->den, w->den, mpq_denref(at[a]));
      if (!pass) continue;
      mpz_inits(w->z[k].at[0], w->z[k].at[1], NULL);
      w->corners++;
      ext_scale(&w->z[k], at, w->den);
    }
  return st;
}

static void ext_hull_of(ext_work *w, size_t k, const dyd_pair *pair, const dyd_sites *sites) {
  uint32_t v[HULL_MOST];
  dyd_bbox other;
  for (uint32_t c = 0; c < 2 * CORNERS; c++) v[c] = CORNERS * (c < CORNERS ? pair->i : pair->j) + c % CORNERS;
  w->hull[k].n = (uint32_t)ext_hull(v, 2 * CORNERS, w->z);
  memcpy(w->hull[k].v, v, sizeof w->hull[k].v);
  dyd_sites_get_d(w->box[k].e, sites, pair->i);
  dyd_sites_get_d(other.e, sites, pair->j);
  dyd_box_widen(&w->box[k], &other);
}

/* Where the pairs of each site begin in *first, if the sites are in spatial order: rank becomes that. */
static void ext_rank(uint32_t *rank, const uint32_t *order, size_t sites, const dyd_pair_list *pairs) {
  uint32_t at = 0;
  for (size_t k = 0; k < sites; k++) rank[k] = 0;
  for (size_t k = 0; k < pairs->count; k++) rank[pairs->item[k].i]++;
  for (size_t k = 0; k < sites; k++) {
    uint32_t count = rank[order[k]];
    rank[order[k]] = at;
    at += count;
  }
}

static dyd_status ext_tree(ext_work *w, const dyd_pair_list *pairs, const dyd_sites *sites) {
  size_t n = dyd_sites_count(sites);
  DYD_FREED uint32_t *order = dyd_alloc(n, sizeof *order), *rank = dyd_alloc(n, sizeof *rank);
  DYD_FREED uint32_t *item = dyd_alloc(pairs->count, sizeof *item);
  dyd_strips strips;
  dyd_status st = order && rank && item ? dyd_spatial_order(order, &strips, sites, 1) : DYD_E_NOMEM;
  if (st == DYD_OK) {
    ext_rank(rank, order, n, pairs);
    for (size_t k = 0; k < pairs->count; k++) item[rank[pairs->item[k].i]++] = (uint32_t)k;
    st = dyd_tree_init(&w->tree, item, (uint32_t)pairs->count, w->box);
    item = NULL;
  }
  return st;
}

static dyd_status ext_hulls(ext_work *w, const dyd_delaunay *pd) {
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_delaunay_pairs(&pairs, pd);
  if (st == DYD_OK && pairs.count >= UINT32_MAX) st = DYD_E_RANGE;
  if (st == DYD_OK) st = ext_corners(w, sites);
  w->hull = dyd_alloc(pairs.count, sizeof *w->hull);
  w->box = dyd_alloc(pairs.count, sizeof *w->box);
  if (st == DYD_OK && (!w->hull || !w->box)) st = DYD_E_NOMEM;
  for (size_t k = 0; k < pairs.count && st == DYD_OK; k++) ext_hull_of(w, k, &pairs.item[k], sites);
  w->count = pairs.count;
  if (st == DYD_OK && pairs.count) st = ext_tree(w, &pairs, sites);
  return st;
}

/* ---- an edge among the other hulls ---- */

/* Where the edge is inside of a hull (side 2), or has one on its left (0) or its right (1), for lo < t < hi; lo = hi:
 * it is only met there. */
typedef struct ext_cover {
  mpq_t lo, hi;
  int side;
} ext_cover;

typedef struct ext_edge {
  const ext_spot *p, *q;
  ext_cover *cover;
  size_t count, cap;
} ext_edge;

/* The covers so far are kept for the next edge: at least `count` are initialised. */
static ext_cover *ext_cover_next(ext_work *w, ext_edge *e, size_t *made) {
  if (!DYD_GROW(e->cover, e->cap, e->count + 1)) {
    w->failed = true;
    return NULL;
  }
  if (e->count == *made) {
    mpq_inits(e->cover[e->count].lo, e->cover[e->count].hi, NULL);
    ++*made;
  }
  return &e->cover[e->count];
}

/* Cuts [lo, hi] to the t with f + t (g - f) >= 0; false: none is left. */
static bool ext_cut(ext_cover *c, const mpz_t f, const mpz_t g) {
  if (mpz_sgn(f) >= 0 && mpz_sgn(g) >= 0) return true;
  if (mpz_sgn(f) < 0 && mpz_sgn(g) < 0) return false;
  DYD_LOCAL_NUMBERS(mpq, t);
  mpz_set(mpq_numref(t), f);
  mpz_sub(mpq_denref(t), f, g);
  mpq_canonicalize(t);
  if (mpz_sgn(f) < 0 ? mpq_cmp(t, c->lo) > 0 : mpq_cmp(t, c->hi) < 0) mpq_set(mpz_sgn(f) < 0 ? c->lo : c->hi, t);
  return mpq_cmp(c->lo, c->hi) <= 0;
}

/* The products (u - p).(q - p) of both ends of a side on the edge's line: its place along the edge. */
static void ext_along(mpz_t out, const ext_edge *e, const ext_spot *u) {
  DYD_LOCAL_NUMBERS(mpz, a, b);
  mpz_set_ui(out, 0);
  for (int k = 0; k < 2; k++) {
    mpz_sub(a, u->at[k], e->p->at[k]);
    mpz_sub(b, e->q->at[k], e->p->at[k]);
    mpz_addmul(out, a, b);
  }
}

/* Cuts to the side u v, which is on the edge's line. */
static bool ext_cut_along(ext_cover *c, const ext_edge *e, const ext_spot *u, const ext_spot *v, bool *same) {
  DYD_LOCAL_NUMBERS(mpz, other);
  DYD_LOCAL_ARRAY(mpz_t, at, [3]);
  ext_along(at[0], e, u);
  ext_along(at[1], e, v);
  ext_along(at[2], e, e->q); /* |q - p|^2 */
  *same = mpz_cmp(at[0], at[1]) < 0;
  if (!*same) mpz_swap(at[0], at[1]);
  /* t >= at[0] / at[2], t <= at[1] / at[2] */
  mpz_neg(at[0], at[0]);
  mpz_add(other, at[0], at[2]);
  bool left = ext_cut(c, at[0], other);
  mpz_sub(other, at[1], at[2]);
  return left && ext_cut(c, at[1], other);
}

/* Notes how the hull covers the edge. */
static void ext_meet(ext_work *w, ext_edge *e, const ext_face *h, size_t *made) {
  ext_cover *c = ext_cover_next(w, e, made);
  bool left = c, same;
  if (!c) return;
  mpq_set_ui(c->lo, 0, 1);
  mpq_set_ui(c->hi, 1, 1);
  c->side = h->n > 2 ? 2 : 3; /* 3: a segment covers nothing */
  DYD_LOCAL_NUMBERS(mpz, f, g, scratch);
  for (uint32_t k = 0; k < h->n && left; k++) {
    const ext_spot *u = &w->z[h->v[k]], *v = &w->z[h->v[(k + 1) % h->n]];
    ext_turn(f, scratch, u, v, e->p);
    ext_turn(g, scratch, u, v, e->q);
    if (mpz_sgn(f) || mpz_sgn(g)) {
      left = ext_cut(c, f, g);
    } else {
      left = ext_cut_along(c, e, u, v, &same);
      if (c->side == 2) c->side = same ? 0 : 1;
    }
  }
  if (left && h->n == 2 && c->side == 3) { /* a segment that crosses: its own ends bound it, too */
    const ext_spot *u = &w->z[h->v[0]], *v = &w->z[h->v[1]];
    int a = ext_turn_sign(e->p, e->q, u), b = ext_turn_sign(e->p, e->q, v);
    left = a * b <= 0;
  }
  e->count += left;
}

/* ---- pieces ---- */

static void ext_locate(mpq_t out, const ext_work *w, const ext_edge *e, int axis, const mpq_t t) {
  DYD_LOCAL_NUMBERS(mpq, span);
  mpz_sub(mpq_numref(span), e->q->at[axis], e->p->at[axis]);
  mpq_mul(out, span, t);
  mpz_set(mpq_numref(span), e->p->at[axis]);
  mpq_add(out, out, span);
  mpz_set(mpq_numref(span), w->den);
  mpq_div(out, out, span);
}

static void ext_piece_add(ext_work *w, const ext_edge *e, const mpq_t from, const mpq_t to, const bool open[2]) {
  if (!DYD_GROW(w->piece, w->cap, w->pieces + 1)) {
    w->failed = true;
    return;
  }
  ext_piece *p = &w->piece[w->pieces++];
  *p = (ext_piece){.at = {0, 0}};
  bool turned = ext_compare(e->p, e->q) > 0;
  for (int s = 0; s < 2; s++) {
    p->open[s] = open[turned ? 1 - s : s];
    mpz_init(p->way[s]);
    mpz_sub(p->way[s], turned ? e->p->at[s] : e->q->at[s], turned ? e->q->at[s] : e->p->at[s]);
    for (int a = 0; a < 2; a++) {
      mpq_init(p->end[s].at[a]);
      ext_locate(p->end[s].at[a], w, e, a, (s == 0) == turned ? to : from);
    }
  }
}

static int ext_compare_q(const void *a, const void *b) {
  return mpq_cmp(*(const mpq_srcptr *)a, *(const mpq_srcptr *)b);
}

/* The parts between neighbouring ends of covers. */
static void ext_pieces_of(ext_work *w, const ext_edge *e) {
  DYD_FREED mpq_srcptr *t = dyd_alloc(2 * e->count, sizeof *t);
  if (!t) {
    w->failed = true;
    return;
  }
  for (size_t k = 0; k < e->count; k++) t[2 * k] = e->cover[k].lo, t[2 * k + 1] = e->cover[k].hi;
  if (e->count) qsort(t, 2 * e->count, sizeof *t, ext_compare_q);
  for (size_t k = 0; k + 1 < 2 * e->count; k++) {
    bool open[2] = {true, true};
    if (mpq_equal(t[k], t[k + 1])) continue;
    for (size_t c = 0; c < e->count; c++) {
      const ext_cover *cover = &e->cover[c];
      if (cover->side > 2 || mpq_cmp(cover->lo, t[k]) > 0 || mpq_cmp(cover->hi, t[k + 1]) < 0) continue;
      for (int s = 0; s < 2; s++) open[s] = open[s] && cover->side != s && cover->side != 2;
    }
    if (open[0] || open[1]) ext_piece_add(w, e, t[k], t[k + 1], open);
  }
}

static bool ext_visit(void *context, uint32_t hull) {
  ext_work *w = context;
  if (!DYD_GROW(w->near, w->near_cap, w->near_count + 1)) w->failed = true;
  if (!w->failed) w->near[w->near_count++] = hull;
  return !w->failed;
}

static dyd_status ext_pieces(ext_work *w, const volatile int *cancel) {
  ext_edge e = {0};
  size_t made = 0;
  const double touching = 0;
  for (size_t k = 0; k < w->count && !w->failed && !dyd_flag_is_set(cancel); k++) {
    const ext_face *h = &w->hull[k];
    w->near_count = 0;
    dyd_tree_near(&w->tree, &w->box[k], &touching, ext_visit, w);
    for (uint32_t c = 0; c < (h->n > 2 ? h->n : 1); c++) {
      e.p = &w->z[h->v[c]], e.q = &w->z[h->v[(c + 1) % h->n]];
      e.count = 0;
      for (size_t m = 0; m < w->near_count; m++) ext_meet(w, &e, &w->hull[w->near[m]], &made);
      if (!w->failed) ext_pieces_of(w, &e);
    }
  }
  while (made > 0) --made, mpq_clears(e.cover[made].lo, e.cover[made].hi, NULL);
  free(e.cover);
  return w->failed ? DYD_E_NOMEM : dyd_flag_is_set(cancel) ? DYD_CANCELLED : DYD_OK;
}

/* ---- rings ---- */

static int ext_compare_place(const ext_place *a, const ext_place *b) {
  int by_x = mpq_cmp(a->at[0], b->at[0]);
  return by_x ? by_x : mpq_cmp(a->at[1], b->at[1]);
}

static int ext_compare_piece(const void *a, const void *b) {
  const ext_piece *p = a, *q = b;
  int first = ext_compare_place(&p->end[0], &q->end[0]);
  return first ? first : ext_compare_place(&p->end[1], &q->end[1]);
}

/* Equal pieces become one: each knows all hulls. */
static void ext_unite(ext_work *w) {
  size_t kept = 0;
  if (w->pieces) qsort(w->piece, w->pieces, sizeof *w->piece, ext_compare_piece);
  for (size_t k = 0; k < w->pieces; k++) {
    if (kept && ext_compare_piece(&w->piece[k], &w->piece[kept - 1]) == 0)
      ext_piece_clear(&w->piece[k]);
    else
      w->piece[kept++] = w->piece[k];
  }
  w->pieces = kept;
}

/* A piece from one of its ends: the exterior is on its left if it is open there. */
typedef struct ext_dart {
  const ext_piece *piece;
  bool back, used;
} ext_dart;

static const ext_place *ext_from(const ext_dart *d) {
  return &d->piece->end[d->back];
}

/* 0: the way goes up, or to the right; 1: down, or to the left. */
static int ext_half(const ext_dart *d) {
  int y = mpz_sgn(d->piece->way[1]), x = mpz_sgn(d->piece->way[0]);
  bool upper = y > 0 || (y == 0 && x > 0);
  return upper == d->back;
}

/* Around one place: counter-clockwise from the right. */
static int ext_compare_way(const ext_dart *a, const ext_dart *b) {
  int half = ext_half(a) - ext_half(b);
  if (half) return half;
  DYD_LOCAL_NUMBERS(mpz, left, right);
  mpz_mul(left, a->piece->way[0], b->piece->way[1]);
  mpz_mul(right, a->piece->way[1], b->piece->way[0]);
  int turn = mpz_cmp(right, left); /* both ways are turned, or none */
  return a->back == b->back ? turn : -turn;
}

static int ext_compare_dart(const void *a, const void *b) {
  int place = ext_compare_place(ext_from(a), ext_from(b));
  return place ? place : ext_compare_way(a, b);
}

/* The dart that leads back. */
static size_t ext_twin(const ext_dart *dart, size_t count, const ext_dart *d) {
  const ext_dart back = {d->piece, !d->back, false};
  return (size_t)((const ext_dart *)bsearch(&back, dart, count, sizeof back, ext_compare_dart) - dart);
}

/* The next one clockwise around the place that the dart leads to. */
static size_t ext_next(const ext_dart *dart, size_t count, const ext_dart *d) {
  size_t at = ext_twin(dart, count, d), last = at;
  if (at > 0 && ext_compare_place(ext_from(&dart[at - 1]), ext_from(&dart[at])) == 0) return at - 1;
  while (last + 1 < count && ext_compare_place(ext_from(&dart[last + 1]), ext_from(&dart[at])) == 0) last++;
  return last;
}

static bool ext_ring_add(dyd_exterior *out, size_t *cap, const ext_place *at) {
  size_t n = out->offset[out->rings];
  if (!dyd_reserve((void **)&out->xy, cap, 2 * n + 2, sizeof *out->xy)) return false;
  for (size_t a = 0; a < 2; a++) {
    mpq_init(out->xy[2 * n + a]);
    mpq_set(out->xy[2 * n + a], at->at[a]);
  }
  out->offset[out->rings]++;
  return true;
}

/* Returns true if both darts have one direction. */
static bool ext_straight(const ext_dart *a, const ext_dart *b) {
  return ext_half(a) == ext_half(b) && ext_compare_way(a, b) == 0;
}

/* The ring from this dart: its first place, and all where it turns. */
static bool ext_ring(dyd_exterior *out, size_t caps[2], ext_dart *dart, size_t count, size_t first) {
  if (!DYD_GROW(out->offset, caps[0], out->rings + 3)) return false;
  out->offset[out->rings + 1] = out->offset[out->rings];
  out->rings++;
  for (size_t at = first, before = count; !dart[at].used; at = ext_next(dart, count, &dart[before])) {
    dart[at].used = true;
    bool turns = before == count || !ext_straight(&dart[before], &dart[at]);
    if (turns && !ext_ring_add(out, &caps[1], ext_from(&dart[at]))) return false;
    before = at;
  }
  return true;
}

/* The dart from the least place of all that has the unbounded component on its left: the plane to the left of that
 * place is in it, so of all ways from there it is the last one before the way to the left. */
static size_t ext_outermost(const ext_dart *dart, size_t count) {
  size_t end = 1, upper = 0;
  while (end < count && ext_compare_place(ext_from(&dart[end]), ext_from(&dart[0])) == 0) end++;
  while (upper < end && ext_half(&dart[upper]) == 0) upper++;
  return (upper ? upper : end) - 1;
}

static dyd_status ext_rings(dyd_exterior *out, ext_work *w) {
  DYD_FREED ext_dart *dart = dyd_alloc(2 * w->pieces, sizeof *dart);
  size_t caps[2] = {0}, count = 2 * w->pieces;
  bool good = dart && DYD_GROW(out->offset, caps[0], 2);
  if (good) out->offset[0] = out->offset[1] = 0;
  for (size_t k = 0; good && k < count; k++) dart[k] = (ext_dart){&w->piece[k / 2], k & 1, false};
  if (good && count) qsort(dart, count, sizeof *dart, ext_compare_dart);
  if (good && count) good = ext_ring(out, caps, dart, count, ext_outermost(dart, count));
  for (size_t k = 0; good && k < count; k++)
    if (!dart[k].used && dart[k].piece->open[dart[k].back]) good = ext_ring(out, caps, dart, count, k);
  return good ? DYD_OK : DYD_E_NOMEM;
}

void dyd_exterior_clear(dyd_exterior *e) {
  for (size_t k = 0; e->rings && k < 2 * e->offset[e->rings]; k++) mpq_clear(e->xy[k]);
  dyd_free_all(e->xy, e->offset);
  *e = (dyd_exterior){0};
}

dyd_status dyd_delaunay_exterior(dyd_exterior *out, const dyd_delaunay *pd, const volatile int *cancel) {
  DYD_SCOPED(ext_work) w = {0};
  dyd_exterior made = {0};
  mpz_init_set_ui(w.den, 1);
  dyd_status st = dyd_delaunay_is_capped(pd) ? DYD_CAPPED : ext_hulls(&w, pd);
  if (st == DYD_OK) st = ext_pieces(&w, cancel);
  if (st == DYD_OK) ext_unite(&w);
  if (st == DYD_OK) st = ext_rings(&made, &w);
  dyd_exterior_clear(st == DYD_OK ? out : &made);
  if (st == DYD_OK) *out = made;
  return st;
}
