/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas: polygons of the user, and tiles cut to one.
 *
 * Everything is decided in rationals. The edges of a tile and of the area are cut where they meet; the pieces of the
 * tile inside the area, and those of the area inside the tile, are the edges of their intersection, a piece of both
 * once if it has the inside of both on its left, else not at all. So the areas of all tiles have the area's as their
 * sum, as those of the tiles have the window's [PART-1]. Vertices are rounded once, when a ring is done. */
#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "metric/bounds.h"
#include "metric/tiles_filter.h"

#include <dyadel/metric.h>

#include <gmp.h>
#include <math.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>

/* ---- the edges of an area in a tree of boxes, filled once, from its leaves up; parts without edges have a box that
 * meets none ---- */

typedef struct area_edge {
  double p[2], q[2];
  size_t ring;
} area_edge;

/* Edges follow each other along rings. box[k]: xlo, xhi, ylo, yhi of the edges of leaf k - leaves, or of the boxes 2 k
 * and 2 k + 1. */
typedef struct edge_tree {
  area_edge *edge;
  size_t count, leaves;
  double (*box)[4];
} edge_tree;

static const double no_box[4] = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};

static void box_join(double box[4], const double other[4]) {
  for (int k = 0; k < 4; k++)
    if (k & 1 ? other[k] > box[k] : other[k] < box[k]) box[k] = other[k];
}
static void box_take(double box[4], const double p[2]) {
  box_join(box, (const double[]){p[0], p[0], p[1], p[1]});
}
static bool boxes_touch(const double a[4], const double b[4]) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3];
}
static void area_edge_box(double box[4], const area_edge *e) {
  memcpy(box, no_box, sizeof no_box);
  box_take(box, e->p);
  box_take(box, e->q);
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

enum { LEAF = 4 };

static void edge_tree_clear(edge_tree *t) {
  dyd_free_all(t->edge, t->box);
}

static void edge_tree_fill(edge_tree *t) {
  for (size_t k = 2 * t->leaves; k-- > 1;) {
    memcpy(t->box[k], no_box, sizeof no_box);
    if (k < t->leaves) {
      box_join(t->box[k], t->box[2 * k]);
      box_join(t->box[k], t->box[2 * k + 1]);
      continue;
    }
    for (size_t e = LEAF * (k - t->leaves); e < t->count && e < LEAF * (k - t->leaves + 1); e++) {
      box_take(t->box[k], t->edge[e].p);
      box_take(t->box[k], t->edge[e].q);
    }
  }
}

/* DYD_OK or DYD_E_NOMEM; release with edge_tree_clear in either case. O(edges). */
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

/* The edges of node k, from edge[*first] to edge[*last]; it has some. */
static void edge_tree_range(size_t *first, size_t *last, const edge_tree *t, size_t k) {
  size_t end = k;
  while (k < t->leaves) k = 2 * k, end = 2 * end + 1;
  *first = LEAF * (k - t->leaves);
  *last = LEAF * (end - t->leaves + 1) - 1;
  if (*last >= t->count) *last = t->count - 1;
}

/* The next one; NULL: that was all. */
static const area_edge *tree_walk_next(tree_walk *w) {
  const edge_tree *t = w->tree;
  double box[4];
  for (;;) {
    while (w->edge < w->end) {
      const area_edge *e = &t->edge[w->edge++];
      area_edge_box(box, e);
      if (boxes_touch(box, w->box)) return e;
    }
    if (!w->depth) return NULL;
    size_t k = w->stack[--w->depth];
    if (!boxes_touch(t->box[k], w->box)) continue;
    if (k < t->leaves) {
      w->stack[w->depth++] = 2 * k;
      w->stack[w->depth++] = 2 * k + 1;
    } else {
      w->edge = LEAF * (k - t->leaves);
      w->end = w->edge + LEAF < t->count ? w->edge + LEAF : t->count;
    }
  }
}

/* ---- areas and tiles ---- */

void dyd_area_clear(dyd_area *a) {
  dyd_free_all(a->offset, a->xy);
  *a = (dyd_area){0};
}

/* ---- places ---- */

/* low: the largest doubles that are not above `at`. */
typedef struct q_place {
  mpq_t at[2];
  double low[2];
} q_place;

static void q_place_init(q_place *p) {
  mpq_inits(p->at[0], p->at[1], NULL);
}

static void q_place_clear(q_place *p) {
  mpq_clears(p->at[0], p->at[1], NULL);
}

static void q_place_set(q_place *p, const double at[2]) {
  for (int k = 0; k < 2; k++) mpq_set_d(p->at[k], p->low[k] = at[k]);
}

static void q_place_copy(q_place *p, const q_place *of) {
  for (int k = 0; k < 2; k++) {
    mpq_set(p->at[k], of->at[k]);
    p->low[k] = of->low[k];
  }
}

static double q_rounded(const mpq_t x, mpfr_rnd_t rnd) {
  DYD_LOCAL_FLOATS(53, r);
  mpfr_set_q(r, x, rnd);
  return mpfr_get_d(r, rnd);
}

/* Sets low[]. */
static void q_place_end(q_place *p) {
  for (int k = 0; k < 2; k++) p->low[k] = q_rounded(p->at[k], MPFR_RNDD);
}

static void q_place_middle(q_place *p, const q_place *a, const q_place *b) {
  for (int k = 0; k < 2; k++) {
    mpq_add(p->at[k], a->at[k], b->at[k]);
    mpq_div_2exp(p->at[k], p->at[k], 1);
  }
  q_place_end(p);
}

static int q_compare(const q_place *a, const q_place *b, int axis) {
  if (a->low[axis] != b->low[axis]) return a->low[axis] < b->low[axis] ? -1 : 1;
  return mpq_cmp(a->at[axis], b->at[axis]);
}

static int q_place_compare(const q_place *a, const q_place *b) {
  int x = q_compare(a, b, 0);
  return x ? x : q_compare(a, b, 1);
}

/* out = (b - a) x (d - c) */
static void q_cross(mpq_t out, const q_place *a, const q_place *b, const q_place *c, const q_place *d) {
  DYD_LOCAL_ARRAY(mpq_t, t, [4]);
  for (int k = 0; k < 2; k++) {
    mpq_sub(t[k], b->at[k], a->at[k]);
    mpq_sub(t[2 + k], d->at[k], c->at[k]);
  }
  mpq_mul(t[0], t[0], t[3]);
  mpq_mul(t[1], t[1], t[2]);
  mpq_sub(out, t[0], t[1]);
}

/* Sign of the turn a, b, c. */
static int q_turn(const q_place *a, const q_place *b, const q_place *c) {
  int sign = dyd_filter_low_turn(a->low, b->low, c->low);
  if (sign || !q_place_compare(a, c) || !q_place_compare(b, c)) return sign;
  DYD_LOCAL_NUMBERS(mpq, t);
  q_cross(t, a, b, a, c);
  return mpq_sgn(t);
}

/* ---- inside the area ---- */

/* Is z above the end of an edge, or as high? */
static bool place_is_above(const q_place *z, const double end[2]) {
  return end[1] <= z->low[1];
}

/* Does the ray to the left from z, which is not on the edge, pass it? Its lower end counts, its upper one does not. */
static bool ray_passes(const q_place *z, const area_edge *e) {
  bool up = place_is_above(z, e->p), left[2] = {e->p[0] <= z->low[0], e->q[0] <= z->low[0]};
  if (up == place_is_above(z, e->q) || !(left[0] || left[1])) return false;
  if (left[0] && left[1]) return true;
  DYD_LOCAL(q_place, a, b);
  q_place_set(&a, e->p);
  q_place_set(&b, e->q);
  int turn = q_turn(&a, &b, z);
  return up ? turn < 0 : turn > 0;
}

/* Is z, on none of the edges, inside of an odd number of rings but `but`? Of edges that follow each other to the left
 * of z the ray passes an odd number if their first end and the last are on both sides of it. */
static bool place_is_inside(const edge_tree *t, const q_place *z, size_t but) {
  size_t stack[64] = {1}, depth = 1, first, last;
  bool odd = false;
  while (depth) {
    size_t k = stack[--depth];
    const double *box = t->box[k];
    if (box[0] > z->low[0] || box[2] > z->low[1] || box[3] <= z->low[1]) continue;
    edge_tree_range(&first, &last, t, k);
    if (box[1] <= z->low[0] && t->edge[first].ring == t->edge[last].ring) {
      bool passes = place_is_above(z, t->edge[first].p) != place_is_above(z, t->edge[last].q);
      odd ^= passes && t->edge[first].ring != but;
    } else if (k < t->leaves) {
      stack[depth++] = 2 * k;
      stack[depth++] = 2 * k + 1;
    } else {
      for (size_t e = first; e <= last; e++) odd ^= t->edge[e].ring != but && ray_passes(z, &t->edge[e]);
    }
  }
  return odd;
}

/* ---- areas that are areas ---- */

/* Where segments a b and c d meet: in no place, in one that is an end of none, of one or of both, or in many. */
enum segment_meeting { APART, CROSS, TOUCH, SHARE, ALONG };
static enum segment_meeting area_segments_meet(q_place *at, const q_place *a, const q_place *b, const q_place *c,
                                               const q_place *d) {
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
    if (!order) q_place_copy(at, from);
    return order > 0 ? APART : order ? ALONG : SHARE;
  }
  if (side[0] * side[1] > 0 || side[2] * side[3] > 0) return APART;
  const q_place *end[4] = {c, d, a, b};
  int ends = 0;
  for (int k = 0; k < 4; k++)
    if (!side[k]) q_place_copy(at, end[k]), ends++; /* it is on the other line */
  if (ends) return ends == 1 ? TOUCH : SHARE;
  DYD_LOCAL_NUMBERS(mpq, s, t);
  q_cross(s, c, d, c, a);
  q_cross(t, c, d, b, a); /* s / t of the way from a to b */
  mpq_div(s, s, t);
  for (int k = 0; k < 2; k++) {
    mpq_sub(t, b->at[k], a->at[k]);
    mpq_mul(t, t, s);
    mpq_add(at->at[k], a->at[k], t);
  }
  q_place_end(at);
  return CROSS;
}

/* Returns true if both ends of one edge are certainly on one side of the other. */
static bool edges_are_apart(const area_edge *e, const area_edge *f) {
  for (int k = 0; k < 2; k++) {
    int side = dyd_filter_low_turn(e->p, e->q, f->p);
    if (side && side == dyd_filter_low_turn(e->p, e->q, f->q)) return true;
    const area_edge *other = e;
    e = f, f = other;
  }
  return false;
}

/* *bad: an edge that meets another one of its ring but in a vertex of both, or that crosses one; t->count: none does.
 */
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
      if (f <= e || edges_are_apart(e, f)) continue;
      q_place_set(&p[2], f->p);
      q_place_set(&p[3], f->q);
      enum segment_meeting meet = area_segments_meet(&p[4], &p[0], &p[1], &p[2], &p[3]);
      if (meet == APART || meet == SHARE || (meet == TOUCH && e->ring != f->ring)) continue;
      bad[0] = k;
      bad[1] = (size_t)(f - t->edge);
    }
  }
  for (int k = 0; k < 5; k++) q_place_clear(&p[k]);
}

/* Twice the area of a ring of doubles. */
static void ring_area2_q(mpq_t out, const double *xy, size_t n) {
  DYD_LOCAL_NUMBERS(mpq, x, y);
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
}

/* Is z on an edge of another ring? */
static bool place_is_on_edge(const edge_tree *t, const q_place *z, size_t but) {
  bool on = false;
  double up[2] = {q_rounded(z->at[0], MPFR_RNDU), q_rounded(z->at[1], MPFR_RNDU)};
  DYD_LOCAL(q_place, a, b);
  tree_walk w = tree_walk_begin(t, (const double[]){z->low[0], up[0], z->low[1], up[1]});
  for (const area_edge *e; !on && (e = tree_walk_next(&w));) {
    q_place_set(&a, e->p);
    q_place_set(&b, e->q);
    on = e->ring != but && !q_turn(&a, &b, z);
  }
  return on;
}

/* A place of the first edge of a ring that is on no other ring: these touch it here and there only. */
static void ring_free_place(q_place *out, const edge_tree *t, size_t first) {
  DYD_LOCAL(q_place, a);
  q_place_set(&a, t->edge[first].p);
  q_place_set(out, t->edge[first].q);
  do q_place_middle(out, out, &a);
  while (place_is_on_edge(t, out, t->edge[first].ring));
}

static void ring_reverse(double *xy, size_t n) {
  for (size_t k = 0; k < n / 2; k++) {
    double t[2];
    memcpy(t, &xy[2 * k], sizeof t);
    memcpy(&xy[2 * k], &xy[2 * (n - 1 - k)], sizeof t);
    memcpy(&xy[2 * (n - 1 - k)], t, sizeof t);
  }
}

/* Returns the first vertex with a coordinate that is not finite; SIZE_MAX if there is none. */
static size_t area_lost_vertex(const dyd_area *a) {
  for (size_t k = 0; a->rings && k < a->offset[a->rings]; k++)
    if (!isfinite(a->xy[2 * k]) || !isfinite(a->xy[2 * k + 1])) return k;
  return SIZE_MAX;
}

dyd_status dyd_area_orient(dyd_area *a, size_t bad[2]) {
  if (!a || !bad) return DYD_E_ARG;
  bad[0] = bad[1] = area_lost_vertex(a);
  if (bad[0] != SIZE_MAX) return DYD_E_ARG;
  DYD_SCOPED(edge_tree) t;
  dyd_status st = edge_tree_init(&t, a);
  if (st == DYD_OK) find_bad_edges(bad, &t);
  if (st == DYD_OK && bad[0] < t.count) st = DYD_E_ARG;
  DYD_LOCAL(q_place, z);
  DYD_LOCAL_NUMBERS(mpq, area2);
  for (size_t r = 0; r < a->rings && st == DYD_OK; r++) {
    size_t first = a->offset[r], n = a->offset[r + 1] - first;
    ring_free_place(&z, &t, first);
    ring_area2_q(area2, &a->xy[2 * first], n);
    if ((mpq_sgn(area2) > 0) == place_is_inside(&t, &z, r)) ring_reverse(&a->xy[2 * first], n);
  }
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

static bool clip_add_cut(clip_work *w, const q_place *z) {
  if (!DYD_GROW(w->cut, w->cut_cap, w->cuts + 1) || !DYD_GROW(w->place, w->place_cap, w->places + 1)) return false;
  q_place_init(&w->place[w->places]);
  q_place_copy(&w->place[w->places], z);
  w->cut[w->cuts++] = w->places++;
  return true;
}

/* Cuts the edge where it meets f. */
static bool clip_cut_at(clip_work *w, const q_place end[2], const area_edge *f, q_place *scratch) {
  q_place *c = scratch, *at = scratch + 2;
  q_place_set(&c[0], f->p);
  q_place_set(&c[1], f->q);
  enum segment_meeting meet = area_segments_meet(at, &end[0], &end[1], &c[0], &c[1]);
  if (meet != APART && meet != ALONG) return clip_add_cut(w, at);
  bool up = q_place_compare(&end[0], &end[1]) < 0;
  for (int k = 0; k < 2 && meet == ALONG; k++)
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
  while (good && (f = tree_walk_next(&walk)))
    if (!edges_are_apart(e, f)) good = clip_cut_at(w, p, f, &p[2]);
  if (good) clip_sort_cuts(w, q_place_compare(&p[0], &p[1]) < 0);
  for (size_t k = 0; k + 1 < w->cuts && good; k++) {
    size_t from = w->cut[k], to = w->cut[k + 1];
    if (q_place_compare(&w->place[from], &w->place[to]) == 0) continue;
    good = DYD_GROW(w->piece, w->piece_cap, w->pieces + 1);
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
  DYD_FREED const q_place **order = dyd_alloc(w->places, sizeof *order);
  DYD_FREED size_t *number = dyd_alloc(w->places, sizeof *number);
  size_t one = 0;
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
  return order && number ? DYD_OK : DYD_E_NOMEM;
}

static int compare_ends(const void *a, const void *b) {
  const edge_piece *p = a, *q = b;
  size_t low[2] = {p->from < p->to ? p->from : p->to, q->from < q->to ? q->from : q->to};
  size_t high[2] = {p->from + p->to - low[0], q->from + q->to - low[1]};
  return low[0] != low[1] ? (low[0] < low[1] ? -1 : 1) : (high[0] > high[1]) - (high[0] < high[1]);
}

/* Which pieces bound the intersection. One of the tile and one of the area at most have the same ends. */
static void clip_choose(clip_work *w, const edge_tree *tile) {
  size_t kept = 0;
  DYD_LOCAL(q_place, z);
  if (w->pieces) qsort(w->piece, w->pieces, sizeof *w->piece, compare_ends);
  for (size_t k = 0; k < w->pieces; k++) {
    edge_piece *p = &w->piece[k];
    bool both = k + 1 < w->pieces && !compare_ends(p, p + 1), keep = both && p->from == p[1].from;
    if (!both) {
      q_place_middle(&z, &w->place[p->from], &w->place[p->to]);
      keep = place_is_inside(p->tile ? w->area : tile, &z, SIZE_MAX);
    }
    if (keep) w->piece[kept++] = *p;
    k += both;
  }
  w->pieces = kept;
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

/* Loops of places: walk[start[l] .. start[l + 1]), with twice their areas, and boxes of the doubles below. */
typedef struct clip_loops {
  size_t *place, *start, count, places, place_cap, start_cap;
  mpq_t *area2;
  double (*box)[4];
  size_t area_cap, box_cap;
} clip_loops;

static void clip_loops_clear(clip_loops *l) {
  for (size_t k = 0; k < l->count; k++) mpq_clear(l->area2[k]);
  dyd_free_all(l->place, l->start, l->area2, l->box);
}

static bool loops_add(clip_loops *l, const clip_work *w, const size_t *at, size_t n) {
  if (n < 3) return true;
  if (!DYD_GROW(l->place, l->place_cap, l->places + n) || !DYD_GROW(l->start, l->start_cap, l->count + 2) ||
      !DYD_GROW(l->area2, l->area_cap, l->count + 1) || !DYD_GROW(l->box, l->box_cap, l->count + 1))
    return false;
  DYD_LOCAL_NUMBERS(mpq, t);
  mpq_init(l->area2[l->count]);
  memcpy(l->box[l->count], no_box, sizeof no_box);
  for (size_t k = 0; k < n; k++) {
    const q_place *a = &w->place[at[k]], *b = &w->place[at[(k + 1) % n]];
    l->place[l->places + k] = at[k];
    box_take(l->box[l->count], a->low);
    for (int way = 0; way < 2; way++) {
      mpq_mul(t, a->at[way], b->at[!way]);
      (way ? mpq_sub : mpq_add)(l->area2[l->count], l->area2[l->count], t);
    }
  }
  l->start[l->count++] = l->places;
  l->start[l->count] = l->places += n;
  return true;
}

/* Follows the pieces, the inside on the left, and cuts a loop out wherever the walk comes back to a place. */
static dyd_status clip_loops_find(clip_loops *l, clip_work *w) {
  DYD_FREED size_t *seen = dyd_alloc(w->places, sizeof *seen);
  bool good = seen != NULL;
  for (size_t k = 0; k < w->places && good; k++) seen[k] = SIZE_MAX;
  if (w->pieces) qsort(w->piece, w->pieces, sizeof *w->piece, compare_pieces);
  for (size_t k = 0; k < w->pieces && good; k++) {
    size_t n = 0;
    for (edge_piece *p = &w->piece[k]; p && !p->done && good; p = piece_after(w, p)) {
      p->done = true;
      good = DYD_GROW(w->walk, w->walk_cap, n + 2);
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
  return good ? DYD_OK : DYD_E_NOMEM;
}

/* ---- rings ---- */

static bool clip_reserve(clip_work *w, size_t places) {
  dyd_tiles *o = w->out;
  size_t rings = o->count + 1;
  return DYD_GROW(o->site, w->site_cap, rings) && DYD_GROW(o->offset, w->offset_cap, rings + 1) &&
         DYD_GROW(o->area, w->area_cap, rings) && DYD_GROW(o->bound, w->bound_cap, 2 * rings) &&
         DYD_GROW(o->xy, w->xy_cap, 2 * places);
}

/* A ring up to vertex `end`; the room is reserved. */
static void clip_end_ring(dyd_tiles *o, uint32_t site, size_t end, double area) {
  o->site[o->count] = site;
  o->area[o->count] = area;
  o->offset[++o->count] = end;
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
  clip_end_ring(o, site, n, 0);
  return DYD_OK;
}

/* Is loop `inner` inside of loop `outer`? They may have places in common. */
static bool loop_holds(const clip_work *w, const clip_loops *l, size_t outer, size_t inner) {
  size_t n = l->start[outer + 1] - l->start[outer], m = l->start[inner + 1] - l->start[inner];
  const size_t *o = &l->place[l->start[outer]], *i = &l->place[l->start[inner]];
  bool odd = false;
  DYD_LOCAL(q_place, z);
  q_place_middle(&z, &w->place[i[0]], &w->place[i[1 % m]]); /* of an edge: on no other one */
  for (size_t k = 0; k < n; k++) {
    const q_place *a = &w->place[o[k]], *b = &w->place[o[(k + 1) % n]];
    bool up = q_compare(a, &z, 1) <= 0;
    if (up != (q_compare(b, &z, 1) <= 0) && (up ? q_turn(a, b, &z) < 0 : q_turn(a, b, &z) > 0)) odd = !odd;
  }
  return odd;
}

/* The outer loop that hole h belongs to: the smallest that holds it. */
static size_t loop_around(const clip_work *w, const clip_loops *l, size_t h) {
  size_t found = l->count;
  for (size_t k = 0; k < l->count; k++)
    if (boxes_touch(l->box[k], l->box[h]) && mpq_sgn(l->area2[k]) > 0 &&
        (found == l->count || mpq_cmp(l->area2[k], l->area2[found]) < 0) && loop_holds(w, l, k, h))
      found = k;
  return found;
}

/* Do the rings from `first` on bound an area after rounding? */
static dyd_status clip_check(const dyd_tiles *o, size_t first) {
  dyd_area a = {.rings = o->count - first, .xy = o->xy + 2 * (o->count > first ? o->offset[first] : 0)};
  size_t bad[2];
  if (!a.rings) return DYD_OK;
  a.offset = dyd_alloc(a.rings + 1, sizeof *a.offset);
  if (!a.offset) return DYD_E_NOMEM;
  for (size_t k = 0; k <= a.rings; k++) a.offset[k] = o->offset[first + k] - o->offset[first];
  DYD_SCOPED(edge_tree) t;
  dyd_status st = edge_tree_init(&t, &a);
  if (st == DYD_OK) find_bad_edges(bad, &t);
  if (st == DYD_OK && bad[0] < t.count) st = DYD_E_RANGE;
  free(a.offset);
  return st;
}

static dyd_status clip_deliver_loops(clip_work *w, const clip_loops *l, uint32_t site) {
  size_t *around = dyd_alloc(l->count, sizeof *around), first = w->out->count;
  dyd_status st = around ? DYD_OK : DYD_E_NOMEM;
  DYD_LOCAL_NUMBERS(mpq, area);
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
  free(around);
  return st == DYD_OK ? clip_check(w->out, first) : st;
}

/* ---- tiles ---- */

static dyd_status clip_copy(clip_work *w, const dyd_tiles *t, size_t r) {
  dyd_tiles *o = w->out;
  size_t n = t->offset[r + 1] - t->offset[r], first = o->count ? o->offset[o->count] : 0;
  if (!clip_reserve(w, first + n)) return DYD_E_NOMEM;
  memcpy(&o->xy[2 * first], &t->xy[2 * t->offset[r]], 2 * n * sizeof *o->xy);
  clip_end_ring(o, t->site[r], first + n, t->area[r]);
  return DYD_OK;
}

static dyd_status clip_cut_tile(clip_work *w, uint32_t site, const edge_tree *tile) {
  DYD_SCOPED(clip_loops) loops = {0};
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
  DYD_SCOPED(edge_tree) tile;
  dyd_status st = edge_tree_init(&tile, &one);
  return st == DYD_OK ? clip_cut_tile(w, t->site[r], &tile) : st;
}

/* Adds to `whole` the area of ring r, and to `blur` how much its rounding may have changed it: its vertices were moved
 * by at most r in each coordinate, so all changes are within 2 r of its border. */
static void clip_measure(mpq_t whole, mpq_t blur, const dyd_tiles *t, size_t r) {
  size_t n = t->offset[r + 1] - t->offset[r];
  const double *xy = &t->xy[2 * t->offset[r]];
  DYD_LOCAL_NUMBERS(mpq, x, y);
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
}

/* The bounds of a cell, lo and hi, become those of its part in the area. Its certain part lies in the tile, and the
 * tile in the possible part, as they were before rounding: so `whole` - inside of the former may be lost at most, and
 * of the latter hi - whole may be inside without being in the tile. An area beyond all doubles is infinite: it bounds
 * nothing, and stays. */
static void clip_bound(double bound[2], const clip_work *w, const mpq_t whole, const mpq_t blur) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  bool bounded = isfinite(bound[1]);
  mpq_set_d(lo, bound[0]);
  mpq_sub(lo, lo, whole);
  mpq_add(lo, lo, w->inside);
  mpq_sub(lo, lo, blur);
  mpq_set_d(hi, bounded ? bound[1] : 0);
  mpq_sub(hi, hi, whole);
  if (mpq_sgn(hi) < 0) mpq_set_ui(hi, 0, 1);
  mpq_add(hi, hi, w->inside);
  mpq_add(hi, hi, blur);
  double low = q_rounded(lo, MPFR_RNDD), high = q_rounded(hi, MPFR_RNDU);
  bound[0] = low > 0 ? low : 0;
  if (bounded && high < bound[1]) bound[1] = high;
}

/* All rings of one site, from *r on. Of a tile that is inside as a whole nothing changes. */
static dyd_status clip_site(clip_work *w, const dyd_tiles *t, size_t *r) {
  size_t first = w->out->count, from = *r;
  double bound[2] = {t->bound[2 * from], t->bound[2 * from + 1]};
  bool any = false, cut, many = from + 1 < t->count && t->site[from + 1] == t->site[from];
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, whole, blur, own);
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
  return st;
}

dyd_status dyd_tiles_clip(dyd_tiles *t, const dyd_area *area, const volatile int *cancel) {
  if (!t || !area || area_lost_vertex(area) != SIZE_MAX) return DYD_E_ARG;
  dyd_tiles made = {.coincident = t->coincident, .rounding = t->rounding};
  DYD_SCOPED(edge_tree) tree;
  clip_work w = {.area = &tree, .out = &made};
  mpq_inits(w.inside, w.error, NULL);
  q_place_init(&w.corner);
  dyd_status st = edge_tree_init(&tree, area);
  if (st == DYD_OK && !clip_reserve(&w, 0)) st = DYD_E_NOMEM;
  if (st == DYD_OK) made.offset[0] = 0;
  for (size_t r = 0; r < t->count && st == DYD_OK;) st = dyd_flag_is_set(cancel) ? DYD_CANCELLED : clip_site(&w, t, &r);
  dyd_free_all(w.place, w.piece, w.cut, w.walk);
  q_place_clear(&w.corner);
  mpq_clears(w.inside, w.error, NULL);
  dyd_tiles_clear(st == DYD_OK ? t : &made);
  if (st == DYD_OK) *t = made;
  return st;
}
