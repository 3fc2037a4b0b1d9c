/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas: polygons of the user, and tiles cut to one.
 *
 * Everything is decided in rationals. The edges of a tile and of the area are cut where they meet; the pieces of the
 * tile inside the area, and those of the area inside the tile, are the edges of their intersection, a piece of both
 * once if it has the inside of both on its left, else not at all. So the areas of all tiles have the area's as their
 * sum, as those of the tiles have the window's [PART-1]. Vertices are rounded once, when a ring is done. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "metric/bounds.h"
#include <gmp.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>

void dyd_area_clear(dyd_area *a) {
  free(a->offset);
  free(a->xy);
  *a = (dyd_area){0};
}

/* ---- edges in a tree ---- */

typedef struct area_edge {
  double p[2], q[2];
  size_t ring;
} area_edge;

/* box[k]: xlo, xhi, ylo, yhi of the edges of leaf k - leaves, or of the boxes 2 k and 2 k + 1. */
enum { LEAF = 4 };
typedef struct edge_tree {
  area_edge *edge;
  size_t count, leaves;
  double (*box)[4];
} edge_tree;

static void box_take(double box[4], const double p[2]) {
  for (int k = 0; k < 4; k++) {
    double x = p[k >> 1];
    if (k & 1 ? x > box[k] : x < box[k]) box[k] = x;
  }
}

static bool area_boxes_meet(const double a[4], const double b[4]) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3];
}

static const double no_box[4] = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};

static void edge_tree_clear(edge_tree *t) {
  free(t->edge);
  free(t->box);
}

static void edge_tree_fill(edge_tree *t) {
  for (size_t k = 2 * t->leaves; k-- > 1;) {
    memcpy(t->box[k], no_box, sizeof no_box);
    if (k < t->leaves) {
      for (size_t c = 2 * k; c <= 2 * k + 1; c++) {
        box_take(t->box[k], (const double[]){t->box[c][0], t->box[c][2]});
        box_take(t->box[k], (const double[]){t->box[c][1], t->box[c][3]});
      }
      continue;
    }
    for (size_t e = LEAF * (k - t->leaves); e < t->count && e < LEAF * (k - t->leaves + 1); e++) {
      box_take(t->box[k], t->edge[e].p);
      box_take(t->box[k], t->edge[e].q);
    }
  }
}

static dyd_status edge_tree_init(edge_tree *t, const dyd_area *a) {
  size_t n = a->rings ? a->offset[a->rings] : 0;
  *t = (edge_tree){.leaves = 1};
  while (LEAF * t->leaves < n) t->leaves *= 2;
  t->edge = dyd_alloc(n, sizeof *t->edge);
  t->box = dyd_alloc(2 * t->leaves, sizeof *t->box);
  if (!t->edge || !t->box) return DYD_E_NOMEM;
  for (size_t r = 0; r < a->rings; r++)
    for (size_t k = a->offset[r]; k < a->offset[r + 1]; k++) {
      const double *p = &a->xy[2 * k], *q = &a->xy[2 * (k + 1 < a->offset[r + 1] ? k + 1 : a->offset[r])];
      t->edge[t->count++] = (area_edge){{p[0], p[1]}, {q[0], q[1]}, r};
    }
  edge_tree_fill(t);
  return DYD_OK;
}

/* A walk over the edges whose boxes meet `box`. */
typedef struct tree_walk {
  const edge_tree *tree;
  double box[4];
  size_t stack[64], depth, edge, end;
} tree_walk;

static tree_walk tree_walk_begin(const edge_tree *t, const double box[4]) {
  return (tree_walk){.tree = t, .box = {box[0], box[1], box[2], box[3]}, .stack = {1}, .depth = 1};
}

static void area_edge_box(double box[4], const area_edge *e) {
  memcpy(box, no_box, sizeof no_box);
  box_take(box, e->p);
  box_take(box, e->q);
}

static bool edge_meets_box(const area_edge *e, const double box[4]) {
  double own[4];
  area_edge_box(own, e);
  return area_boxes_meet(own, box);
}

/* The next one; NULL: that was all. */
static const area_edge *tree_walk_next(tree_walk *w) {
  const edge_tree *t = w->tree;
  for (;;) {
    while (w->edge < w->end)
      if (edge_meets_box(&t->edge[w->edge++], w->box)) return &t->edge[w->edge - 1];
    if (!w->depth) return NULL;
    size_t k = w->stack[--w->depth];
    if (!area_boxes_meet(t->box[k], w->box)) continue;
    if (k < t->leaves) {
      w->stack[w->depth++] = 2 * k;
      w->stack[w->depth++] = 2 * k + 1;
    } else {
      w->edge = LEAF * (k - t->leaves);
      w->end = w->edge + LEAF < t->count ? w->edge + LEAF : t->count;
    }
  }
}

/* ---- places ---- */

typedef struct q_place {
  mpq_t at[2];
} q_place;

static void q_place_init(q_place *p) {
  mpq_inits(p->at[0], p->at[1], NULL);
}

static void q_place_clear(q_place *p) {
  mpq_clears(p->at[0], p->at[1], NULL);
}

static void q_place_set(q_place *p, const double at[2]) {
  for (int k = 0; k < 2; k++) mpq_set_d(p->at[k], at[k]);
}

static int q_place_compare(const q_place *a, const q_place *b) {
  int x = mpq_cmp(a->at[0], b->at[0]);
  return x ? x : mpq_cmp(a->at[1], b->at[1]);
}

/* out = (b - a) x (d - c) */
static void q_cross(mpq_t out, const q_place *a, const q_place *b, const q_place *c, const q_place *d) {
  mpq_t t[4];
  for (int k = 0; k < 4; k++) mpq_init(t[k]);
  for (int k = 0; k < 2; k++) {
    mpq_sub(t[k], b->at[k], a->at[k]);
    mpq_sub(t[2 + k], d->at[k], c->at[k]);
  }
  mpq_mul(t[0], t[0], t[3]);
  mpq_mul(t[1], t[1], t[2]);
  mpq_sub(out, t[0], t[1]);
  for (int k = 0; k < 4; k++) mpq_clear(t[k]);
}

/* Sign of the turn a, b, c. */
static int q_turn(const q_place *a, const q_place *b, const q_place *c) {
  mpq_t t;
  mpq_init(t);
  q_cross(t, a, b, a, c);
  int sign = mpq_sgn(t);
  mpq_clear(t);
  return sign;
}

/* Doubles below and above. */
static void q_enclose(double out[2], const mpq_t x) {
  mpfr_t r;
  mpfr_init2(r, 53);
  mpfr_set_q(r, x, MPFR_RNDD);
  out[0] = mpfr_get_d(r, MPFR_RNDD);
  mpfr_set_q(r, x, MPFR_RNDU);
  out[1] = mpfr_get_d(r, MPFR_RNDU);
  mpfr_clear(r);
}

/* ---- inside the area ---- */

/* Does the ray to the left from z pass the edge? Its lower end counts, its upper one does not. */
static bool ray_passes(const q_place *z, const area_edge *e, q_place *a, q_place *b) {
  q_place_set(a, e->p);
  q_place_set(b, e->q);
  bool up = mpq_cmp(a->at[1], z->at[1]) <= 0;
  if (up == (mpq_cmp(b->at[1], z->at[1]) <= 0)) return false;
  return up ? q_turn(a, b, z) < 0 : q_turn(a, b, z) > 0;
}

/* Is z, on none of the edges, inside of an odd number of rings but `but`? */
static bool place_is_inside(const edge_tree *t, const q_place *z, size_t but) {
  double box[4], x[2];
  q_place a, b;
  bool odd = false;
  q_enclose(x, z->at[0]);
  q_enclose(&box[2], z->at[1]);
  box[0] = -HUGE_VAL;
  box[1] = x[1];
  q_place_init(&a);
  q_place_init(&b);
  tree_walk w = tree_walk_begin(t, box);
  for (const area_edge *e; (e = tree_walk_next(&w));) {
    if (e->ring == but) continue;
    bool left = box[2] == box[3] && e->p[0] < x[0] && e->q[0] < x[0]; /* then the height alone decides */
    if (left ? (e->p[1] <= box[2]) != (e->q[1] <= box[2]) : ray_passes(z, e, &a, &b)) odd = !odd;
  }
  q_place_clear(&a);
  q_place_clear(&b);
  return odd;
}

/* ---- areas that are areas ---- */

/* Where segments a b and c d meet: 0 nowhere, 1 in one place, set; 2 along a piece. */
static int area_segments_meet(q_place *at, const q_place *a, const q_place *b, const q_place *c, const q_place *d) {
  int side[4] = {q_turn(a, b, c), q_turn(a, b, d), q_turn(c, d, a), q_turn(c, d, b)};
  if (!side[0] && !side[1]) {
    const q_place *low[2] = {a, c}, *high[2] = {b, d};
    for (int k = 0; k < 2; k++)
      if (q_place_compare(low[k], high[k]) > 0) {
        const q_place *t = low[k];
        low[k] = high[k], high[k] = t;
      }
    const q_place *from = q_place_compare(low[0], low[1]) > 0 ? low[0] : low[1];
    const q_place *to = q_place_compare(high[0], high[1]) < 0 ? high[0] : high[1];
    int order = q_place_compare(from, to);
    if (!order)
      for (int k = 0; k < 2; k++) mpq_set(at->at[k], from->at[k]);
    return order > 0 ? 0 : order ? 2 : 1;
  }
  if (side[0] * side[1] > 0 || side[2] * side[3] > 0) return 0;
  mpq_t s, t;
  mpq_inits(s, t, NULL);
  q_cross(s, c, d, c, a);
  q_cross(t, c, d, b, a); /* s / t of the way from a to b */
  mpq_div(s, s, t);
  for (int k = 0; k < 2; k++) {
    mpq_sub(t, b->at[k], a->at[k]);
    mpq_mul(t, t, s);
    mpq_add(at->at[k], a->at[k], t);
  }
  mpq_clears(s, t, NULL);
  return 1;
}

/* May edges that meet at `at` do so? In a vertex of both, yes. */
static bool meeting_is_good(const area_edge *e, const area_edge *f, const q_place *at) {
  q_place v;
  int ends = 0;
  q_place_init(&v);
  for (int k = 0; k < 4; k++) {
    q_place_set(&v, k == 0 ? e->p : k == 1 ? e->q : k == 2 ? f->p : f->q);
    if (q_place_compare(&v, at) == 0) ends |= k < 2 ? 1 : 2;
  }
  q_place_clear(&v);
  return ends == 3 || (ends && e->ring != f->ring);
}

/* *bad: an edge that meets another one where it may not; t->count: none does. */
static void find_bad_edges(size_t bad[2], const edge_tree *t) {
  q_place p[5];
  bad[0] = bad[1] = t->count;
  for (int k = 0; k < 5; k++) q_place_init(&p[k]);
  for (size_t k = 0; k < t->count && bad[0] == t->count; k++) {
    const area_edge *e = &t->edge[k], *f;
    double box[4];
    area_edge_box(box, e);
    q_place_set(&p[0], e->p);
    q_place_set(&p[1], e->q);
    tree_walk w = tree_walk_begin(t, box);
    while ((f = tree_walk_next(&w)) && bad[0] == t->count) {
      if (f <= e) continue;
      q_place_set(&p[2], f->p);
      q_place_set(&p[3], f->q);
      int meet = area_segments_meet(&p[4], &p[0], &p[1], &p[2], &p[3]);
      if (meet == 0 || (meet == 1 && meeting_is_good(e, f, &p[4]))) continue;
      bad[0] = k;
      bad[1] = (size_t)(f - t->edge);
    }
  }
  for (int k = 0; k < 5; k++) q_place_clear(&p[k]);
}

/* Twice the area of a ring of doubles. */
static void ring_area2_q(mpq_t out, const double *xy, size_t n) {
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  mpq_set_ui(out, 0, 1);
  for (size_t k = 0; k < n; k++) {
    const double *a = &xy[2 * k], *b = &xy[2 * ((k + 1) % n)];
    for (int way = 0; way < 2; way++) {
      mpq_set_d(x, way ? b[0] : a[0]);
      mpq_set_d(y, way ? a[1] : b[1]);
      mpq_mul(x, x, y);
      (way ? mpq_sub : mpq_add)(out, out, x);
    }
  }
  mpq_clears(x, y, NULL);
}

/* Is z on an edge of another ring? */
static bool place_is_on_edge(const edge_tree *t, const q_place *z, size_t but) {
  double x[2], y[2];
  q_place a, b;
  bool on = false;
  q_enclose(x, z->at[0]);
  q_enclose(y, z->at[1]);
  q_place_init(&a);
  q_place_init(&b);
  tree_walk w = tree_walk_begin(t, (const double[]){x[0], x[1], y[0], y[1]});
  for (const area_edge *e; !on && (e = tree_walk_next(&w));) {
    q_place_set(&a, e->p);
    q_place_set(&b, e->q);
    on = e->ring != but && !q_turn(&a, &b, z);
  }
  q_place_clear(&a);
  q_place_clear(&b);
  return on;
}

/* A place of the first edge of a ring that is on no other ring: these touch it here and there only. */
static void ring_free_place(q_place *out, const edge_tree *t, size_t first) {
  q_place a;
  q_place_init(&a);
  q_place_set(&a, t->edge[first].p);
  q_place_set(out, t->edge[first].q);
  do {
    for (int k = 0; k < 2; k++) {
      mpq_add(out->at[k], out->at[k], a.at[k]);
      mpq_div_2exp(out->at[k], out->at[k], 1);
    }
  } while (place_is_on_edge(t, out, t->edge[first].ring));
  q_place_clear(&a);
}

static void ring_reverse(double *xy, size_t n) {
  for (size_t k = 0; k < n / 2; k++) {
    double t[2];
    memcpy(t, &xy[2 * k], sizeof t);
    memcpy(&xy[2 * k], &xy[2 * (n - 1 - k)], sizeof t);
    memcpy(&xy[2 * (n - 1 - k)], t, sizeof t);
  }
}

dyd_status dyd_area_orient(dyd_area *a, size_t bad[2]) {
  edge_tree t;
  q_place z;
  mpq_t area2;
  dyd_status st = edge_tree_init(&t, a);
  if (st == DYD_OK) find_bad_edges(bad, &t);
  if (st == DYD_OK && bad[0] < t.count) st = DYD_E_ARG;
  q_place_init(&z);
  mpq_init(area2);
  for (size_t r = 0; r < a->rings && st == DYD_OK; r++) {
    size_t first = a->offset[r], n = a->offset[r + 1] - first;
    ring_free_place(&z, &t, first);
    ring_area2_q(area2, &a->xy[2 * first], n);
    if ((mpq_sgn(area2) > 0) == place_is_inside(&t, &z, r)) ring_reverse(&a->xy[2 * first], n);
  }
  mpq_clear(area2);
  q_place_clear(&z);
  edge_tree_clear(&t);
  return st;
}

/* ---- pieces ---- */

/* A piece of an edge of the tile or of the area, between places of these numbers. */
typedef struct edge_piece {
  size_t from, to;
  bool tile, kept, done;
} edge_piece;

/* Work on one tile. place[]: ends of pieces, the first of equal ones naming all. inside: the area of the site's part in
 * the area so far. */
typedef struct clip_work {
  const edge_tree *area;
  q_place *place;
  size_t places, place_cap;
  edge_piece *piece;
  size_t pieces, piece_cap;
  size_t *cut, cuts, cut_cap; /* places on the edge that is cut */
  size_t *walk, walk_cap;
  dyd_tiles *out;
  size_t site_cap, offset_cap, xy_cap, area_cap, bound_cap;
  q_place corner;
  mpq_t inside, error;
} clip_work;

static bool clip_add_place(clip_work *w, const q_place *z) {
  if (!dyd_reserve((void **)&w->place, &w->place_cap, w->places + 1, sizeof *w->place)) return false;
  q_place *p = &w->place[w->places++];
  q_place_init(p);
  for (int k = 0; k < 2; k++) mpq_set(p->at[k], z->at[k]);
  return true;
}

static bool clip_add_cut(clip_work *w, const q_place *z) {
  if (!dyd_reserve((void **)&w->cut, &w->cut_cap, w->cuts + 1, sizeof *w->cut)) return false;
  w->cut[w->cuts++] = w->places;
  return clip_add_place(w, z);
}

/* Cuts the edge where it meets f. */
static bool clip_cut_at(clip_work *w, const q_place end[2], const area_edge *f, q_place *scratch) {
  q_place *c = scratch, *at = scratch + 2;
  q_place_set(&c[0], f->p);
  q_place_set(&c[1], f->q);
  int meet = area_segments_meet(at, &end[0], &end[1], &c[0], &c[1]);
  if (meet == 1) return clip_add_cut(w, at);
  bool up = q_place_compare(&end[0], &end[1]) < 0;
  for (int k = 0; k < 2 && meet; k++)
    if (q_place_compare(&c[k], &end[!up]) > 0 && q_place_compare(&c[k], &end[up]) < 0 && !clip_add_cut(w, &c[k]))
      return false;
  return true;
}

/* Sorts the cuts along the edge; few, but for an edge of the window. */
static void clip_sort_cuts(clip_work *w, bool up) {
  for (size_t gap = w->cuts / 2; gap; gap /= 2)
    for (size_t k = gap; k < w->cuts; k++)
      for (size_t m = k; m >= gap; m -= gap) {
        int order = q_place_compare(&w->place[w->cut[m - gap]], &w->place[w->cut[m]]);
        if (up ? order <= 0 : order >= 0) break;
        size_t t = w->cut[m];
        w->cut[m] = w->cut[m - gap];
        w->cut[m - gap] = t;
      }
}

/* The pieces of an edge, cut at all `others` in the box of the tile: those of the area, or the tile's own. */
static bool clip_edge(clip_work *w, const area_edge *e, bool tile, const edge_tree *others) {
  q_place p[5];
  double box[4];
  const area_edge *f;
  area_edge_box(box, e);
  for (int k = 0; k < 5; k++) q_place_init(&p[k]);
  q_place_set(&p[0], e->p);
  q_place_set(&p[1], e->q);
  w->cuts = 0;
  bool good = clip_add_cut(w, &p[0]) && clip_add_cut(w, &p[1]);
  tree_walk walk = tree_walk_begin(others, box);
  while (good && (f = tree_walk_next(&walk))) good = clip_cut_at(w, p, f, &p[2]);
  if (good) clip_sort_cuts(w, q_place_compare(&p[0], &p[1]) < 0);
  for (size_t k = 0; k + 1 < w->cuts && good; k++) {
    size_t from = w->cut[k], to = w->cut[k + 1];
    if (q_place_compare(&w->place[from], &w->place[to]) == 0) continue;
    good = dyd_reserve((void **)&w->piece, &w->piece_cap, w->pieces + 1, sizeof *w->piece);
    if (good) w->piece[w->pieces++] = (edge_piece){.from = from, .to = to, .tile = tile};
  }
  for (int k = 0; k < 5; k++) q_place_clear(&p[k]);
  return good;
}

static int compare_places(const void *a, const void *b) {
  return q_place_compare(*(q_place *const *)a, *(q_place *const *)b);
}

/* Ends of pieces that are one place get one number. */
static dyd_status clip_number(clip_work *w) {
  const q_place **order = dyd_alloc(w->places, sizeof *order);
  size_t *number = dyd_alloc(w->places, sizeof *number), one = 0;
  if (order && number) {
    for (size_t k = 0; k < w->places; k++) order[k] = &w->place[k];
    qsort(order, w->places, sizeof *order, compare_places);
    for (size_t k = 0; k < w->places; k++) {
      if (!k || q_place_compare(order[k - 1], order[k])) one = (size_t)(order[k] - w->place);
      number[order[k] - w->place] = one;
    }
    for (size_t k = 0; k < w->pieces; k++) {
      w->piece[k].from = number[w->piece[k].from];
      w->piece[k].to = number[w->piece[k].to];
    }
  }
  dyd_status st = order && number ? DYD_OK : DYD_E_NOMEM;
  free(number);
  free(order);
  return st;
}

/* Which pieces bound the intersection. */
static void clip_choose(clip_work *w, const edge_tree *tile) {
  q_place z;
  q_place_init(&z);
  for (size_t k = 0; k < w->pieces; k++) {
    edge_piece *p = &w->piece[k];
    if (p->done) continue;
    for (size_t m = k + 1; p->tile && m < w->pieces && !p->done; m++) {
      edge_piece *q = &w->piece[m];
      if (q->tile) continue;
      p->kept = p->from == q->from && p->to == q->to;
      p->done = q->done = p->kept || (p->from == q->to && p->to == q->from);
    }
    if (p->done) continue;
    for (int a = 0; a < 2; a++) {
      mpq_add(z.at[a], w->place[p->from].at[a], w->place[p->to].at[a]);
      mpq_div_2exp(z.at[a], z.at[a], 1);
    }
    p->kept = place_is_inside(p->tile ? w->area : tile, &z, SIZE_MAX);
  }
  q_place_clear(&z);
  size_t kept = 0;
  for (size_t k = 0; k < w->pieces; k++)
    if (w->piece[k].kept) w->piece[kept++] = w->piece[k];
  w->pieces = kept;
  for (size_t k = 0; k < kept; k++) w->piece[k].done = false;
}

/* ---- loops ---- */

static int compare_pieces(const void *a, const void *b) {
  const edge_piece *p = a, *q = b;
  return p->from != q->from ? (p->from < q->from ? -1 : 1) : (p->to > q->to) - (p->to < q->to);
}

/* 2: to the left of the direction of p, 1: ahead, 0: to the right. */
static int piece_rank(const clip_work *w, const edge_piece *p, const edge_piece *q) {
  return 1 + q_turn(&w->place[p->from], &w->place[p->to], &w->place[q->to]);
}

/* Of the pieces that begin where p ends, and are not done, the one that turns most to the left; NULL: there is none. */
static edge_piece *piece_after(clip_work *w, const edge_piece *p) {
  size_t low = 0, high = w->pieces;
  edge_piece *best = NULL;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (w->piece[middle].from < p->to)
      low = middle + 1;
    else
      high = middle;
  }
  for (edge_piece *q = &w->piece[low]; q < w->piece + w->pieces && q->from == p->to; q++) {
    if (q->done) continue;
    int rank = best ? piece_rank(w, p, q) - piece_rank(w, p, best) : 1;
    if (rank > 0 || (!rank && q_turn(&w->place[q->from], &w->place[best->to], &w->place[q->to]) > 0)) best = q;
  }
  return best;
}

/* Loops of places: walk[start[l] .. start[l + 1]), with twice their areas. */
typedef struct clip_loops {
  size_t *place, *start, count, places, place_cap, start_cap;
  mpq_t *area2;
  size_t area_cap;
} clip_loops;

static void clip_loops_clear(clip_loops *l) {
  for (size_t k = 0; k < l->count; k++) mpq_clear(l->area2[k]);
  free(l->place);
  free(l->start);
  free(l->area2);
}

static bool loops_add(clip_loops *l, const clip_work *w, const size_t *at, size_t n) {
  if (n < 3) return true;
  if (!dyd_reserve((void **)&l->place, &l->place_cap, l->places + n, sizeof *l->place) ||
      !dyd_reserve((void **)&l->start, &l->start_cap, l->count + 2, sizeof *l->start) ||
      !dyd_reserve((void **)&l->area2, &l->area_cap, l->count + 1, sizeof *l->area2))
    return false;
  mpq_t t;
  mpq_init(t);
  mpq_init(l->area2[l->count]);
  for (size_t k = 0; k < n; k++) {
    const q_place *a = &w->place[at[k]], *b = &w->place[at[(k + 1) % n]];
    l->place[l->places + k] = at[k];
    for (int way = 0; way < 2; way++) {
      mpq_mul(t, a->at[way], b->at[!way]);
      (way ? mpq_sub : mpq_add)(l->area2[l->count], l->area2[l->count], t);
    }
  }
  mpq_clear(t);
  l->start[l->count++] = l->places;
  l->start[l->count] = l->places += n;
  return true;
}

/* Follows the pieces, the inside on the left, and cuts a loop out wherever the walk comes back to a place. */
static dyd_status clip_loops_find(clip_loops *l, clip_work *w) {
  size_t *seen = dyd_alloc(w->places, sizeof *seen);
  bool good = seen != NULL;
  for (size_t k = 0; k < w->places && good; k++) seen[k] = SIZE_MAX;
  if (w->pieces) qsort(w->piece, w->pieces, sizeof *w->piece, compare_pieces);
  for (size_t k = 0; k < w->pieces && good; k++) {
    size_t n = 0;
    for (edge_piece *p = &w->piece[k]; p && !p->done && good; p = piece_after(w, p)) {
      p->done = true;
      good = dyd_reserve((void **)&w->walk, &w->walk_cap, n + 2, sizeof *w->walk);
      if (!good) break;
      if (!n) seen[p->from] = 0, w->walk[n++] = p->from;
      size_t back = seen[p->to];
      if (back == SIZE_MAX) {
        seen[p->to] = n;
        w->walk[n++] = p->to;
        continue;
      }
      good = loops_add(l, w, w->walk + back, n - back);
      for (size_t m = back + 1; m < n; m++) seen[w->walk[m]] = SIZE_MAX;
      n = back + 1;
    }
    for (size_t m = 0; m < n; m++) seen[w->walk[m]] = SIZE_MAX;
  }
  free(seen);
  return good ? DYD_OK : DYD_E_NOMEM;
}

/* ---- rings ---- */

static double q_rounded(const mpq_t x, mpfr_rnd_t rnd) {
  mpfr_t r;
  mpfr_init2(r, 53);
  mpfr_set_q(r, x, rnd);
  double d = mpfr_get_d(r, rnd);
  mpfr_clear(r);
  return d;
}

static bool clip_reserve(clip_work *w, size_t places) {
  dyd_tiles *o = w->out;
  size_t rings = o->count + 1;
  return dyd_reserve((void **)&o->site, &w->site_cap, rings, sizeof *o->site) &&
         dyd_reserve((void **)&o->offset, &w->offset_cap, rings + 1, sizeof *o->offset) &&
         dyd_reserve((void **)&o->area, &w->area_cap, rings, sizeof *o->area) &&
         dyd_reserve((void **)&o->bound, &w->bound_cap, 2 * rings, sizeof *o->bound) &&
         dyd_reserve((void **)&o->xy, &w->xy_cap, 2 * places, sizeof *o->xy);
}

/* A coordinate of a place in the nearest double; notes by how much that is off. */
static double place_round(clip_work *w, const mpq_t x) {
  double d = q_rounded(x, MPFR_RNDN);
  mpq_set_d(w->error, d);
  mpq_sub(w->error, w->error, x);
  mpq_abs(w->error, w->error);
  double off = q_rounded(w->error, MPFR_RNDU);
  if (off > w->out->rounding) w->out->rounding = off;
  return d;
}

/* Appends loop l, its places rounded; *any: it has an area after that. */
static dyd_status clip_append(bool *any, clip_work *w, const clip_loops *l, size_t loop, uint32_t site) {
  dyd_tiles *o = w->out;
  size_t first = o->count ? o->offset[o->count] : 0, n = first;
  if (!clip_reserve(w, first + l->start[loop + 1] - l->start[loop])) return DYD_E_NOMEM;
  for (size_t k = l->start[loop]; k < l->start[loop + 1]; k++) {
    const q_place *z = &w->place[l->place[k]];
    double *at = &o->xy[2 * n];
    for (int a = 0; a < 2; a++) at[a] = place_round(w, z->at[a]);
    n += n == first || at[0] != at[-2] || at[1] != at[-1];
  }
  while (n > first + 1 && o->xy[2 * first] == o->xy[2 * n - 2] && o->xy[2 * first + 1] == o->xy[2 * n - 1]) n--;
  *any = n >= first + 3;
  if (*any) { /* a loop that is thinner than the rounding has lost its area, or turned over */
    ring_area2_q(w->error, &o->xy[2 * first], n - first);
    *any = mpq_sgn(w->error) == mpq_sgn(l->area2[loop]);
  }
  if (!*any) return DYD_OK;
  o->offset[o->count] = first;
  o->site[o->count] = site;
  o->area[o->count] = 0;
  o->offset[++o->count] = n;
  return DYD_OK;
}

/* Is loop `inner` inside of loop `outer`? They may have places in common. */
static bool loop_holds(const clip_work *w, const clip_loops *l, size_t outer, size_t inner) {
  size_t n = l->start[outer + 1] - l->start[outer], m = l->start[inner + 1] - l->start[inner];
  const size_t *o = &l->place[l->start[outer]], *i = &l->place[l->start[inner]];
  q_place z;
  bool odd = false;
  q_place_init(&z);
  for (int a = 0; a < 2; a++) { /* the middle of an edge is on no other one */
    mpq_add(z.at[a], w->place[i[0]].at[a], w->place[i[1 % m]].at[a]);
    mpq_div_2exp(z.at[a], z.at[a], 1);
  }
  for (size_t k = 0; k < n; k++) {
    const q_place *a = &w->place[o[k]], *b = &w->place[o[(k + 1) % n]];
    bool up = mpq_cmp(a->at[1], z.at[1]) <= 0;
    if (up != (mpq_cmp(b->at[1], z.at[1]) <= 0) && (up ? q_turn(a, b, &z) < 0 : q_turn(a, b, &z) > 0)) odd = !odd;
  }
  q_place_clear(&z);
  return odd;
}

/* The outer loop that hole h belongs to: the smallest that holds it. */
static size_t loop_around(const clip_work *w, const clip_loops *l, size_t h) {
  size_t found = l->count;
  for (size_t k = 0; k < l->count; k++)
    if (mpq_sgn(l->area2[k]) > 0 && (found == l->count || mpq_cmp(l->area2[k], l->area2[found]) < 0) &&
        loop_holds(w, l, k, h))
      found = k;
  return found;
}

/* Do the rings from `first` on bound an area after rounding? */
static dyd_status clip_check(const dyd_tiles *o, size_t first) {
  dyd_area a = {.rings = o->count - first, .xy = o->xy + 2 * (o->count > first ? o->offset[first] : 0)};
  edge_tree t;
  size_t bad[2];
  if (!a.rings) return DYD_OK;
  a.offset = dyd_alloc(a.rings + 1, sizeof *a.offset);
  if (!a.offset) return DYD_E_NOMEM;
  for (size_t k = 0; k <= a.rings; k++) a.offset[k] = o->offset[first + k] - o->offset[first];
  dyd_status st = edge_tree_init(&t, &a);
  if (st == DYD_OK) find_bad_edges(bad, &t);
  if (st == DYD_OK && bad[0] < t.count) st = DYD_E_RANGE;
  edge_tree_clear(&t);
  free(a.offset);
  return st;
}

static dyd_status clip_deliver_loops(clip_work *w, const clip_loops *l, uint32_t site) {
  size_t *around = dyd_alloc(l->count, sizeof *around), first = w->out->count;
  mpq_t area;
  dyd_status st = around ? DYD_OK : DYD_E_NOMEM;
  mpq_init(area);
  for (size_t h = 0; h < l->count && around; h++)
    around[h] = mpq_sgn(l->area2[h]) < 0 ? loop_around(w, l, h) : SIZE_MAX;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) {
    bool any, hole;
    if (mpq_sgn(l->area2[k]) <= 0) continue;
    size_t ring = w->out->count;
    mpq_set(area, l->area2[k]);
    st = clip_append(&any, w, l, k, site);
    for (size_t h = 0; h < l->count && st == DYD_OK; h++) {
      if (around[h] != k) continue;
      mpq_add(area, area, l->area2[h]);
      if (any) st = clip_append(&hole, w, l, h, site);
    }
    mpq_div_2exp(area, area, 1);
    mpq_add(w->inside, w->inside, area);
    if (st == DYD_OK && any) w->out->area[ring] = q_rounded(area, MPFR_RNDU);
  }
  mpq_clear(area);
  free(around);
  return st == DYD_OK ? clip_check(w->out, first) : st;
}

/* ---- tiles ---- */

static dyd_status clip_copy(clip_work *w, const dyd_tiles *t, size_t r) {
  dyd_tiles *o = w->out;
  size_t n = t->offset[r + 1] - t->offset[r], first = o->count ? o->offset[o->count] : 0;
  if (!clip_reserve(w, first + n)) return DYD_E_NOMEM;
  memcpy(&o->xy[2 * first], &t->xy[2 * t->offset[r]], 2 * n * sizeof *o->xy);
  o->offset[o->count] = first;
  o->site[o->count] = t->site[r];
  o->area[o->count] = t->area[r];
  o->offset[++o->count] = first + n;
  return DYD_OK;
}

static dyd_status clip_cut_tile(clip_work *w, uint32_t site, const edge_tree *tile) {
  clip_loops loops = {0};
  const area_edge *e;
  bool good = true;
  w->pieces = w->places = 0;
  for (size_t k = 0; k < tile->count && good; k++) good = clip_edge(w, &tile->edge[k], true, w->area);
  tree_walk walk = tree_walk_begin(w->area, tile->box[1]);
  while (good && (e = tree_walk_next(&walk))) good = clip_edge(w, e, false, tile);
  dyd_status st = good ? clip_number(w) : DYD_E_NOMEM;
  if (st == DYD_OK) clip_choose(w, tile);
  if (st == DYD_OK) st = clip_loops_find(&loops, w);
  if (st == DYD_OK) st = clip_deliver_loops(w, &loops, site);
  clip_loops_clear(&loops);
  for (size_t k = 0; k < w->places; k++) q_place_clear(&w->place[k]);
  return st;
}

/* Ring r of t; *cut: the area's border meets its box. */
static dyd_status clip_ring(bool *cut, clip_work *w, const dyd_tiles *t, size_t r) {
  size_t n = t->offset[r + 1] - t->offset[r], offset[2] = {0, n};
  const dyd_area one = {1, offset, t->xy + 2 * t->offset[r]};
  double box[4];
  memcpy(box, no_box, sizeof box);
  for (size_t k = 0; k < n; k++) box_take(box, &one.xy[2 * k]);
  tree_walk walk = tree_walk_begin(w->area, box);
  *cut = tree_walk_next(&walk) != NULL;
  if (!*cut) {
    q_place_set(&w->corner, one.xy);
    return place_is_inside(w->area, &w->corner, SIZE_MAX) ? clip_copy(w, t, r) : DYD_OK;
  }
  edge_tree tile;
  dyd_status st = edge_tree_init(&tile, &one);
  if (st == DYD_OK) st = clip_cut_tile(w, t->site[r], &tile);
  edge_tree_clear(&tile);
  return st;
}

/* Adds to `whole` the area of ring r, and to `blur` how much its rounding may have changed it: its vertices were moved
 * by at most r in each coordinate, so all changes are within 2 r of its border. */
static void clip_measure(mpq_t whole, mpq_t blur, const dyd_tiles *t, size_t r) {
  size_t n = t->offset[r + 1] - t->offset[r];
  const double *xy = &t->xy[2 * t->offset[r]];
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  ring_area2_q(x, xy, n);
  mpq_div_2exp(x, x, 1);
  mpq_add(whole, whole, x);
  for (size_t k = 0; k < 2 * n; k++) {
    mpq_set_d(x, xy[k]);
    mpq_set_d(y, xy[(k + 2) % (2 * n)]);
    mpq_sub(x, x, y);
    mpq_abs(x, x);
    mpq_set_d(y, t->rounding);
    mpq_mul_2exp(y, y, 2);
    mpq_add(x, x, y); /* |dx| + |dy| of an edge, and 8 r for its ends */
    mpq_mul(x, x, y);
    mpq_add(blur, blur, x);
  }
  mpq_clears(x, y, NULL);
}

/* The bounds of a cell, lo and hi, become those of its part in the area. Its certain part lies in the tile, and the
 * tile in what is possible, as they were before rounding: so `whole` - inside of the former may be lost at most, and
 * of the latter hi - whole may be inside without being in the tile. */
static void clip_bound(double bound[2], const clip_work *w, const mpq_t whole, const mpq_t blur) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  mpq_set_d(lo, bound[0]);
  mpq_sub(lo, lo, whole);
  mpq_add(lo, lo, w->inside);
  mpq_sub(lo, lo, blur);
  mpq_set_d(hi, bound[1]);
  mpq_sub(hi, hi, whole);
  if (mpq_sgn(hi) < 0) mpq_set_ui(hi, 0, 1);
  mpq_add(hi, hi, w->inside);
  mpq_add(hi, hi, blur);
  double low = q_rounded(lo, MPFR_RNDD), high = q_rounded(hi, MPFR_RNDU);
  bound[0] = low > 0 ? low : 0;
  if (high < bound[1]) bound[1] = high;
  mpq_clears(lo, hi, NULL);
}

/* All rings of one site, from *r on. Of a tile that is inside as a whole nothing changes. */
static dyd_status clip_site(clip_work *w, const dyd_tiles *t, size_t *r) {
  mpq_t whole, blur, own;
  size_t first = w->out->count, from = *r;
  double bound[2] = {t->bound[2 * from], t->bound[2 * from + 1]};
  bool any = false, cut, many = from + 1 < t->count && t->site[from + 1] == t->site[from];
  dyd_status st = DYD_OK;
  mpq_inits(whole, blur, own, NULL);
  mpq_set_ui(w->inside, 0, 1);
  for (; *r < t->count && t->site[*r] == t->site[from] && st == DYD_OK; ++*r) {
    size_t before = w->out->count;
    st = clip_ring(&cut, w, t, *r);
    any = any || cut || w->out->count == before;
    if (!many || cut || w->out->count == before) continue;
    ring_area2_q(own, &t->xy[2 * t->offset[*r]], t->offset[*r + 1] - t->offset[*r]);
    mpq_div_2exp(own, own, 1);
    mpq_add(w->inside, w->inside, own);
  }
  for (size_t k = from; any && w->out->count > first && k < *r; k++) clip_measure(whole, blur, t, k);
  if (any && w->out->count > first) clip_bound(bound, w, whole, blur);
  for (size_t k = first; k < w->out->count; k++) memcpy(&w->out->bound[2 * k], bound, sizeof bound);
  mpq_clears(whole, blur, own, NULL);
  return st;
}

dyd_status dyd_tiles_clip(dyd_tiles *t, const dyd_area *area, const volatile int *cancel) {
  if (!t || !area) return DYD_E_ARG;
  dyd_tiles made = {.coincident = t->coincident, .rounding = t->rounding};
  edge_tree tree;
  clip_work w = {.area = &tree, .out = &made};
  mpq_inits(w.inside, w.error, NULL);
  q_place_init(&w.corner);
  dyd_status st = edge_tree_init(&tree, area);
  if (st == DYD_OK && !clip_reserve(&w, 0)) st = DYD_E_NOMEM;
  if (st == DYD_OK) made.offset[0] = 0;
  for (size_t r = 0; r < t->count && st == DYD_OK;) st = dyd_flag_is_set(cancel) ? DYD_CANCELLED : clip_site(&w, t, &r);
  free(w.place);
  free(w.piece);
  free(w.cut);
  free(w.walk);
  q_place_clear(&w.corner);
  mpq_clears(w.inside, w.error, NULL);
  edge_tree_clear(&tree);
  dyd_tiles_clear(st == DYD_OK ? t : &made);
  if (st == DYD_OK) *t = made;
  return st;
}
