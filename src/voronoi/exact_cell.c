/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of Int_i and Pos_i: rectangles in one integer scale, curves cut in pieces, pieces linked to chains.
 *
 * On the boundary of Int_i some j has dl_i = ds_j <= ds_k for all k; on that of Pos_i some j has dl_j = ds_i <= dl_k.
 * Let D_k = ds_k (Int) or dl_k (Pos), r = dl_i or ds_i. So the boundary consists of those points of the curves r = D_j
 * where no D_k is less than r. Along a curve this can change only where D_k = r too and no other D_l is less: there j
 * and k are both possible at the point, so jk is a possible pair [CELL-2]. Such points are centres of critical circles
 * FCC (Int) or CFF (Pos) of i, j, k, which dyd_icircles finds [CRIT-1]: where the curves of j and k coincide along a
 * stretch, since both show the same feature, the end of the stretch is in a pane beyond it, in which they show
 * different ones, and different features leave finitely many circles. Between two cuts one exact sample decides. Of
 * curves that coincide the one with the lowest number counts. */
#include "voronoi/exact_cell.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "predicate/circle.h"
#include "voronoi/sample.h"
#include "voronoi/surd_point.h"

#include <dyadel/arc.h>
#include <dyadel/voronoi.h>

#include <stdlib.h>
#include <string.h>

/* Part of an arc of curve `curve` (or of side curve - count of the window, arc = NULL), in the direction that has the
 * region on the left. begin, end: borrowed from the curves, the meets or the corners. */
typedef struct cell_piece {
  size_t curve;
  const dyd_elementary *arc;
  const dyd_spot *begin, *end;
} cell_piece;

/* Points at which the curves of two others cross. */
typedef struct cell_meet {
  uint32_t curve[2];
  dyd_spot spot;
} cell_meet;

/* Shared by all parts of the work on a cell: the rectangles of the site and of the window in one scale. */
typedef struct cell_frame {
  dyd_touch fixed_touch, other_touch;
  dyd_scaled fixed, window;
  mpz_t man, ox, oy;
  int64_t exp, shift;
  dyd_spot corner[4]; /* of the window: x0 y0, x1 y0, x1 y1, x0 y1 */
} cell_frame;

/* The curve of another site: its arcs without the ones that others cover; owned. */
typedef struct cell_curve {
  mpz_t middle[2];
  size_t count;
  dyd_elementary *arc;
} cell_curve;

/* Coordinates are F (x - o) for the caller's x: F = man * 2^exp, even on rectangles; o = the centre of `fixed`, about.
 * curve[k]: the boundary of C_ik (Int) or C_ki (Pos), count = 0 if the rectangles meet. kept: the rectangles that do
 * not meet `fixed`, the only ones that matter to Pos; Int is empty when there are others. */
typedef struct exact_cell {
  const dyd_cell_task *task;
  const cell_frame *frame; /* borrowed */
  size_t count;
  uint32_t *site;
  dyd_scaled *other;
  cell_curve *curve;
  cell_meet *meet;
  size_t meets, meet_cap;
  uint64_t bytes; /* of the curves, and of the digits of the meets */
  cell_piece *piece;
  size_t pieces, piece_cap;
  dyd_sample sample;
  size_t taker;         /* the other that took the last sample: it likely takes the next */
  const dyd_spot **cut; /* scratch: cuts of one arc */
  size_t cut_cap;
} exact_cell;

/* How many circles two curves of one rectangle can share, a circle too many included: a convex curve crosses each of
 * the at most ten lines that bound panes of the three rectangles at most twice, so it runs through at most 21 panes,
 * and each holds at most two. */
enum { CELL_CIRCLES = 43 };

/* Side of the window: bottom, right, top, left. Its axis. */
static inline int window_axis(int side) {
  return side & 1;
}

/* ---- samples and sides ---- */

static int cell_spot_side(const exact_cell *c, const dyd_spot *p, size_t k) {
  int sign = dyd_filter_side(p, &c->other[k].box, c->frame->other_touch, &c->frame->fixed.box, c->frame->fixed_touch);
  return sign ? sign
              : dyd_surd_point_side(&p->at, &c->other[k].r, c->frame->other_touch, &c->frame->fixed.r,
                                    c->frame->fixed_touch);
}

static mpz_srcptr window_level(const exact_cell *c, int side) {
  const dyd_irect *w = &c->frame->window.r;
  return side == 0 ? w->y0 : side == 1 ? w->x1 : side == 2 ? w->y1 : w->x0;
}

static void sample_make_exact(const exact_cell *c, dyd_sample *s, const dyd_elementary *arc, int window_side) {
  dyd_surd_point *p = &s->spot.at;
  s->known = true;
  if (arc) {
    dyd_elementary_at(p, arc, s->num, s->bits);
    return;
  }
  int axis = window_axis(window_side);
  mpz_set(axis ? p->ay : p->ax, s->num);
  mpz_mul_2exp(axis ? p->ax : p->ay, window_level(c, window_side), (mp_bitcnt_t)s->bits);
  dyd_surd_point_drop_root(p);
  mpz_set_ui(p->d, 1);
  mpz_mul_2exp(p->d, p->d, (mp_bitcnt_t)s->bits);
}

/* Returns -1, 0 or 1: the sample is nearer to, as far from, or farther from other k than the radius dl_i or ds_i. */
static int cell_side(const exact_cell *c, dyd_sample *s, const dyd_elementary *arc, int window_side, size_t k) {
  int sign =
      dyd_filter_side(&s->spot, &c->other[k].box, c->frame->other_touch, &c->frame->fixed.box, c->frame->fixed_touch);
  if (sign) return sign;
  if (!s->known) sample_make_exact(c, s, arc, window_side);
  return dyd_surd_point_side(&s->spot.at, &c->other[k].r, c->frame->other_touch, &c->frame->fixed.r,
                             c->frame->fixed_touch);
}

/* num / 2^bits strictly between two points, by enclosures of growing precision; some number when both are infinite. */
static void sample_between(dyd_sample *s, const dyd_spot *low, const dyd_spot *high, int axis) {
  DYD_LOCAL_NUMBERS(mpz, up, down, t);
  for (s->bits = 4;; s->bits *= 2) {
    if (!low->infinite) dyd_surd_point_floor(t, up, &low->at, axis, s->bits);
    if (!high->infinite) dyd_surd_point_floor(down, t, &high->at, axis, s->bits);
    if (low->infinite && !high->infinite) mpz_sub_ui(up, down, 2);
    if (high->infinite) mpz_add_ui(down, up, 2);
    if (mpz_cmp(up, down) < 0) break;
  }
  mpz_add(s->num, up, down);
  s->bits++;
}

/* A sample strictly between two points, on an arc or (arc = NULL) on a side of the window. */
static void cell_sample(exact_cell *c, const dyd_elementary *arc, int window_side, const dyd_spot *low,
                        const dyd_spot *high) {
  dyd_sample *s = &c->sample;
  int axis = arc ? arc->axis : window_axis(window_side);
  static const int end[4] = {2, 1, 3, 0};
  dyd_iv level = arc ? DYD_IV_UNKNOWN : c->frame->window.box.end[end[window_side]];
  if (dyd_filter_sample(s, arc ? &arc->shape : NULL, level, axis, low, high, c->frame->shift)) return;
  sample_between(s, low, high, axis);
  s->spot.infinite = false;
  sample_make_exact(c, s, arc, window_side);
  dyd_filter_spot_box(&s->spot, c->frame->shift);
}

/* ---- cuts and pieces ---- */

static dyd_status cell_add_cut(exact_cell *c, size_t *count, const dyd_spot *s) {
  if (!DYD_GROW(c->cut, c->cut_cap, *count + 1)) return DYD_E_NOMEM;
  c->cut[(*count)++] = s;
  return DYD_OK;
}

static int cell_spot_cmp(const dyd_spot *p, const dyd_spot *q, int axis) {
  int sign = dyd_filter_spot_cmp(p, q, axis);
  return sign ? sign : dyd_surd_point_cmp(&p->at, &q->at, axis);
}

static int compare_cut_x(const void *p, const void *q) {
  return cell_spot_cmp(*(const dyd_spot *const *)p, *(const dyd_spot *const *)q, 0);
}

static int compare_cut_y(const void *p, const void *q) {
  return cell_spot_cmp(*(const dyd_spot *const *)p, *(const dyd_spot *const *)q, 1);
}

/* Sorts cuts along axis, drops repeats; returns how many are left. */
static size_t cell_sort_cuts(const dyd_spot **cut, size_t count, int axis) {
  if (count > 1) qsort(cut, count, sizeof(const dyd_spot *), axis ? compare_cut_y : compare_cut_x);
  size_t kept = 0;
  for (size_t k = 0; k < count; k++)
    if (!kept || cell_spot_cmp(cut[kept - 1], cut[k], axis)) cut[kept++] = cut[k];
  return kept;
}

static dyd_status cell_add_piece(exact_cell *c, cell_piece p) {
  if (!DYD_GROW(c->piece, c->piece_cap, c->pieces + 1)) return DYD_E_NOMEM;
  c->piece[c->pieces++] = p;
  return DYD_OK;
}

/* ---- boundaries: chains of arcs ---- */

static void arc_init(dyd_arc *a) {
  *a = (dyd_arc){.kind = DYD_ARC_LINE};
  dyd_surd_point_init(&a->begin.at);
  dyd_surd_point_init(&a->end.at);
}

static void arc_clear(dyd_arc *a) {
  dyd_surd_point_clear(&a->end.at);
  dyd_surd_point_clear(&a->begin.at);
}

/* Appends a chain with room for `arcs` initialised arcs (count = arcs) to a boundary whose chain array has room for it.
 * NULL when memory is exhausted, nothing changed then. */
static dyd_chain *boundary_add_chain(dyd_boundary *b, size_t arcs) {
  dyd_arc *arc = dyd_alloc(arcs, sizeof *arc);
  if (!arc) return NULL;
  for (size_t k = 0; k < arcs; k++) arc_init(&arc[k]);
  dyd_chain *chain = &b->chain[b->count++];
  *chain = (dyd_chain){.count = arcs, .arc = arc};
  return chain;
}

void dyd_boundary_clear(dyd_boundary *b) {
  for (size_t c = b->count; c-- > 0;) {
    dyd_chain *chain = &b->chain[c];
    for (size_t k = chain->count; k-- > 0;) arc_clear(&chain->arc[k]);
    free(chain->arc);
  }
  free(b->chain);
  *b = (dyd_boundary){0};
}

/* ---- pieces of the window ----
 *
 * Inside W the boundary of the region consists of pieces of the curves, and of points at which a curve touches W from
 * outside. So along a side the region can begin or end only at an end of an arc on that side (arcs that are one point
 * included, so that no sample meets a touching point). Between two such ends a sample decides; a stretch that lies on
 * the boundary of the region itself does not count as a piece of the window (the curve's arc is one, if it has the
 * region on the side of W). */

/* Adds s if it lies strictly inside the side. */
static dyd_status cut_side(exact_cell *c, size_t *count, int side, const dyd_spot *s) {
  int axis = window_axis(side);
  const dyd_irect *w = &c->frame->window.r;
  if (s->infinite || dyd_surd_point_cmp_z(&s->at, 1 - axis, window_level(c, side))) return DYD_OK;
  if (dyd_surd_point_cmp_z(&s->at, axis, dyd_irect_end(w, axis, 0)) <= 0) return DYD_OK;
  if (dyd_surd_point_cmp_z(&s->at, axis, dyd_irect_end(w, axis, 1)) >= 0) return DYD_OK;
  return cell_add_cut(c, count, s);
}

static dyd_status side_find_cuts(exact_cell *c, size_t *count, int side) {
  *count = 0;
  for (size_t j = 0; j < c->count; j++)
    for (size_t a = 0; a < c->curve[j].count; a++)
      for (int e = 0; e < 2; e++) {
        dyd_status st = cut_side(c, count, side, &c->curve[j].arc[a].end[e]);
        if (st != DYD_OK) return st;
      }
  return DYD_OK;
}

static bool side_is_inside(exact_cell *c, int side) {
  for (size_t k = 0; k < c->count; k++)
    if (cell_side(c, &c->sample, NULL, side, k) <= 0) return false;
  return true;
}

static dyd_status side_pieces(exact_cell *c, int side) {
  size_t count;
  bool grows = side < 2;
  const dyd_spot *first = &c->frame->corner[side], *last = &c->frame->corner[(side + 1) & 3];
  const dyd_spot *lowest = grows ? first : last, *highest = grows ? last : first;
  dyd_status st = side_find_cuts(c, &count, side);
  if (st != DYD_OK) return st;
  count = cell_sort_cuts(c->cut, count, window_axis(side));
  for (size_t k = 0; k <= count && st == DYD_OK; k++) {
    const dyd_spot *low = k ? c->cut[k - 1] : lowest, *high = k < count ? c->cut[k] : highest;
    cell_sample(c, NULL, side, low, high);
    if (side_is_inside(c, side))
      st = cell_add_piece(c, (cell_piece){c->count + (size_t)side, NULL, grows ? low : high, grows ? high : low});
  }
  return st;
}

/* The pieces of the sides of the window strictly inside the region. */
static dyd_status cell_window_pieces(exact_cell *c) {
  dyd_status st = DYD_OK;
  for (int side = 0; side < 4 && st == DYD_OK; side++) st = side_pieces(c, side);
  return st;
}

/* ---- cuts of an arc ---- */

/* Adds s if it is strictly inside the arc. */
static dyd_status cut_arc(exact_cell *c, size_t *count, const dyd_elementary *a, const dyd_spot *s) {
  if (s->infinite || !dyd_elementary_holds(a, s)) return DYD_OK;
  if (!a->end[0].infinite && cell_spot_cmp(s, &a->end[0], a->axis) <= 0) return DYD_OK;
  if (!a->end[1].infinite && cell_spot_cmp(s, &a->end[1], a->axis) >= 0) return DYD_OK;
  return cell_add_cut(c, count, s);
}

/* All cuts of an arc, unsorted. */
static dyd_status arc_find_cuts(exact_cell *c, size_t *count, const dyd_elementary *a, size_t j) {
  *count = 0;
  for (size_t m = 0; m < c->meets; m++) {
    const cell_meet *meet = &c->meet[m];
    if (meet->curve[0] != j && meet->curve[1] != j) continue;
    dyd_status st = cut_arc(c, count, a, &meet->spot);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

/* ---- pieces of an arc ---- */

/* Returns true if k takes the sample on curve j away from it. */
static bool other_takes_sample(exact_cell *c, const dyd_elementary *a, size_t j, size_t k) {
  if (k == j) return false;
  int sign = cell_side(c, &c->sample, a, 0, k);
  return sign < 0 || (!sign && k < j);
}

/* Returns true if the sample on curve j is a point of the boundary that counts for j. The site that took the last one
 * is tried first. */
static bool sample_is_kept(exact_cell *c, const dyd_elementary *a, size_t j) {
  if (c->taker < c->count && other_takes_sample(c, a, j, c->taker)) return false;
  for (size_t k = 0; k < c->count; k++)
    if (k != c->taker && other_takes_sample(c, a, j, k)) return c->taker = k, false;
  return true;
}

static dyd_status arc_pieces(exact_cell *c, size_t j, const dyd_elementary *a) {
  size_t count;
  if (a->point) return DYD_OK;
  dyd_status st = arc_find_cuts(c, &count, a, j);
  if (st != DYD_OK) return st;
  count = cell_sort_cuts(c->cut, count, a->axis);
  bool grows = (a->direction > 0) != c->task->outer;
  if (dyd_flag_is_set(c->task->cancel)) return DYD_CANCELLED;
  for (size_t k = 0; k <= count && st == DYD_OK; k++) {
    const dyd_spot *low = k ? c->cut[k - 1] : &a->end[0], *high = k < count ? c->cut[k] : &a->end[1];
    cell_sample(c, a, 0, low, high);
    if (sample_is_kept(c, a, j)) st = cell_add_piece(c, (cell_piece){j, a, grows ? low : high, grows ? high : low});
  }
  return st;
}

/* ---- meets ---- */

static bool cell_has_room(const exact_cell *c, uint64_t bytes) {
  return !c->task->room || dyd_room_has(c->task->room, dyd_bytes_add(c->bytes, bytes), "the boundary of a cell");
}

/* For one meet more, with what reserving takes while it copies. */
static bool meets_have_room(exact_cell *c, const dyd_icircle *circle) {
  enum { NUMBERS = 6, BLOCK = 16 };
  mpz_srcptr widest = mpz_size(circle->ax) > mpz_size(circle->ay) ? circle->ax : circle->ay;
  c->bytes += NUMBERS * (BLOCK + sizeof(mp_limb_t) * mpz_size(widest));
  return c->meets < c->meet_cap || cell_has_room(c, dyd_bytes_times(3 * c->meets + 16, sizeof *c->meet));
}

static dyd_status curves_add_meet(exact_cell *c, size_t j, size_t k, dyd_icircle *circle) {
  if (!meets_have_room(c, circle)) return DYD_E_NOMEM;
  if (!DYD_GROW(c->meet, c->meet_cap, c->meets + 1)) return DYD_E_NOMEM;
  cell_meet *m = &c->meet[c->meets++];
  *m = (cell_meet){.curve = {(uint32_t)j, (uint32_t)k}};
  dyd_surd_point *p = &m->spot.at;
  dyd_surd_point_init(p);
  mpz_swap(p->ax, circle->ax);
  mpz_swap(p->bx, circle->bx);
  mpz_swap(p->ay, circle->ay);
  mpz_swap(p->by, circle->by);
  mpz_swap(p->c, circle->c);
  mpz_swap(p->d, circle->d);
  dyd_filter_spot_box(&m->spot, c->frame->shift);
  return DYD_OK;
}

static bool curves_may_meet(const exact_cell *c, size_t j, size_t k) {
  const dyd_delaunay *pd = c->task->pd;
  if (!c->curve[j].count || !c->curve[k].count) return false;
  return !pd || dyd_delaunay_status(pd, c->site[j], c->site[k]) != DYD_ILLEGAL;
}

static dyd_status curves_find_meets(exact_cell *c) {
  DYD_LOCAL_ARRAY(dyd_icircle, circle, [CELL_CIRCLES]);
  const dyd_touch touch[3] = {c->frame->fixed_touch, c->frame->other_touch, c->frame->other_touch};
  dyd_status st = DYD_OK;
  for (size_t j = 0; j < c->count; j++)
    for (size_t k = j + 1; k < c->count && st == DYD_OK; k++) {
      if (dyd_flag_is_set(c->task->cancel)) st = DYD_CANCELLED;
      if (st != DYD_OK || !curves_may_meet(c, j, k)) continue;
      const dyd_irect *r[3] = {&c->frame->fixed.r, &c->other[j].r, &c->other[k].r};
      size_t found = dyd_icircles(circle, CELL_CIRCLES, r, touch);
      DYD_INVARIANT(found < CELL_CIRCLES);
      for (size_t m = 0; m < found && st == DYD_OK; m++) st = curves_add_meet(c, j, k, &circle[m]);
    }
  return st;
}

/* ---- all pieces ---- */

static void ends_init(dyd_elementary *a) {
  for (int e = 0; e < 2; e++) dyd_surd_point_init(&a->end[e].at);
}

static void ends_clear(dyd_elementary *a) {
  for (int e = 2; e-- > 0;) dyd_surd_point_clear(&a->end[e].at);
}

static void cell_init(exact_cell *c, const dyd_cell_task *task, const cell_frame *frame) {
  memset(c, 0, sizeof *c);
  c->task = task;
  c->frame = frame;
  mpz_init(c->sample.num);
  dyd_surd_point_init(&c->sample.spot.at);
}

static void cell_clear(exact_cell *c) {
  dyd_free_all(c->cut, c->piece);
  for (size_t m = c->meets; m-- > 0;) dyd_surd_point_clear(&c->meet[m].spot.at);
  free(c->meet);
  if (c->curve)
    for (size_t k = c->count; k-- > 0;) {
      for (size_t a = c->curve[k].count; a-- > 0;) ends_clear(&c->curve[k].arc[a]);
      free(c->curve[k].arc);
      mpz_clears(c->curve[k].middle[0], c->curve[k].middle[1], NULL);
    }
  dyd_free_all(c->curve, c->other, c->site);
  dyd_surd_point_clear(&c->sample.spot.at);
  mpz_clear(c->sample.num);
}

/* The arcs of curve k without the ones that others cover: these have no pieces, and meets on them do not cut [PRUNE-1].
 * found: scratch. */
static dyd_status cell_set_curve(exact_cell *c, dyd_takers *takers, dyd_elementary *found, size_t k) {
  bool outer = c->task->outer;
  cell_curve *curve = &c->curve[k];
  const dyd_scaled *window = c->task->windowed ? &c->frame->window : NULL,
                   *far = outer ? &c->other[k] : &c->frame->fixed, *near = outer ? &c->frame->fixed : &c->other[k];
  size_t count = dyd_curve_set(found, curve->middle, far, near, window, outer ? -1 : 1, c->frame->shift), kept = 0;
  for (size_t m = 0; m < count; m++) {
    dyd_elementary a = found[m];
    if (!c->task->keep_all && dyd_filter_arc_taken(takers, k, &a.shape, a.axis, a.end)) continue;
    found[m] = found[kept];
    found[kept++] = a;
  }
  if (!kept) return DYD_OK;
  c->bytes += dyd_bytes_times(kept, sizeof *curve->arc);
  curve->arc = cell_has_room(c, 0) ? dyd_alloc(kept, sizeof *curve->arc) : NULL;
  if (!curve->arc) return DYD_E_NOMEM;
  for (; curve->count < kept; curve->count++) {
    curve->arc[curve->count] = found[curve->count];
    ends_init(&found[curve->count]);
  }
  return DYD_OK;
}

static dyd_status cell_set_curves(exact_cell *c) {
  dyd_takers takers = {c->other, &c->frame->fixed, c->count, c->count, c->frame->other_touch, c->frame->fixed_touch};
  dyd_elementary found[DYD_CURVE_ARCS];
  c->bytes = dyd_bytes_times(c->count, sizeof *c->curve);
  if (!cell_has_room(c, 0)) return DYD_E_NOMEM;
  c->curve = calloc(c->count ? c->count : 1, sizeof *c->curve);
  if (!c->curve) return DYD_E_NOMEM;
  for (size_t k = 0; k < c->count; k++) mpz_inits(c->curve[k].middle[0], c->curve[k].middle[1], NULL);
  for (size_t m = 0; m < DYD_CURVE_ARCS; m++) ends_init(&found[m]);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < c->count && st == DYD_OK; k++)
    st = dyd_flag_is_set(c->task->cancel) ? DYD_CANCELLED : cell_set_curve(c, &takers, found, k);
  for (size_t m = DYD_CURVE_ARCS; m-- > 0;) ends_clear(&found[m]);
  return st;
}

static dyd_status cell_find_pieces(exact_cell *c) {
  dyd_status st = cell_set_curves(c);
  if (st == DYD_OK) st = curves_find_meets(c);
  for (size_t j = 0; j < c->count && st == DYD_OK; j++)
    for (size_t a = 0; a < c->curve[j].count && st == DYD_OK; a++) st = arc_pieces(c, j, &c->curve[j].arc[a]);
  if (st == DYD_OK && c->task->windowed) st = cell_window_pieces(c);
  return st;
}

/* ---- links ----
 *
 * Each piece ends where exactly one other begins, since the region has no pinched point in the plane: Int_i is convex,
 * and near a point outside R_i the segments towards R_i, all in Pos_i, run in nearly one direction. A curve may touch
 * a side of the window; there each continues alone, so a piece is first joined to the next one of its own curve.
 * Neighbours that differ in nothing but a cut become one arc. */

#define NONE SIZE_MAX

/* next[p], last[p]: the pieces before and after p; done: written. */
typedef struct links {
  size_t *next, *last;
  bool *done;
} links;

static dyd_status links_init(links *l, size_t count) {
  l->next = dyd_alloc(count, sizeof *l->next);
  l->last = dyd_alloc(count, sizeof *l->last);
  l->done = calloc(count ? count : 1, sizeof *l->done);
  if (!l->next || !l->last || !l->done) return DYD_E_NOMEM;
  for (size_t p = 0; p < count; p++) l->next[p] = l->last[p] = NONE;
  return DYD_OK;
}

static void links_clear(links *l) {
  dyd_free_all(l->done, l->last, l->next);
}

static bool same_spot(const dyd_spot *p, const dyd_spot *q) {
  if (p == q) return true;
  for (int axis = 0; axis < 2; axis++)
    if (dyd_filter_spot_cmp(p, q, axis)) return false;
  return !dyd_surd_point_cmp(&p->at, &q->at, 0) && !dyd_surd_point_cmp(&p->at, &q->at, 1);
}

/* Joins every loose end of a finite piece to a loose beginning; own: of the same curve only. */
static void links_join(links *l, const exact_cell *c, bool own) {
  for (size_t p = 0; p < c->pieces; p++) {
    if (c->piece[p].end->infinite || l->next[p] != NONE) continue;
    for (size_t q = 0; q < c->pieces; q++) {
      if (l->last[q] != NONE || c->piece[q].begin->infinite) continue;
      if ((own && c->piece[p].curve != c->piece[q].curve) || !same_spot(c->piece[p].end, c->piece[q].begin)) continue;
      l->next[p] = q;
      l->last[q] = p;
      break;
    }
    DYD_INVARIANT(own || l->next[p] != NONE);
  }
}

/* Returns true if the cell_piece p and its successor are one arc. */
static bool links_are_smooth(const links *l, const exact_cell *c, size_t p) {
  size_t n = l->next[p];
  if (n == NONE || c->piece[p].curve != c->piece[n].curve) return false;
  const dyd_elementary *a = c->piece[p].arc, *b = c->piece[n].arc;
  return a == b || (a && b && a->corner == b->corner && a->feature == b->feature);
}

/* ---- writing ---- */

static dyd_arc_end links_end_kind(const exact_cell *c, const cell_piece *p, const cell_piece *other,
                                  const dyd_spot *at) {
  dyd_arc_end e = {.kind = DYD_END_WINDOW};
  if (!other) {
    e.kind = DYD_END_INFINITE;
  } else if (p->arc && other->arc && p->curve == other->curve) {
    e.kind = p->arc->corner != other->arc->corner ? DYD_END_AXIS : DYD_END_FEATURE;
  } else if (p->arc && other->arc) {
    size_t k = 0;
    while (k < c->count && (k == p->curve || cell_spot_side(c, at, k))) k++;
    DYD_INVARIANT(k < c->count);
    e.kind = DYD_END_SITES;
    e.site = c->site[k < c->count ? k : other->curve];
  }
  return e;
}

/* other: the piece beyond this end. */
static void links_write_end(dyd_arc_end *out, const exact_cell *c, const cell_piece *p, const cell_piece *other,
                            const dyd_spot *at) {
  dyd_arc_end e = links_end_kind(c, p, other, at);
  out->kind = e.kind;
  out->site = e.site;
  if (e.kind == DYD_END_INFINITE) return;
  dyd_surd_point_set(&out->at, &at->at);
  dyd_surd_point_unscale(&out->at, c->frame->ox, c->frame->oy, c->frame->man, c->frame->exp);
}

/* The arc made of the pieces from first to last. */
static void links_write_arc(dyd_arc *out, const exact_cell *c, const links *l, size_t first, size_t last) {
  const cell_piece *f = &c->piece[first], *t = &c->piece[last];
  const cell_piece *before = l->last[first] == NONE ? NULL : &c->piece[l->last[first]];
  const cell_piece *after = l->next[last] == NONE ? NULL : &c->piece[l->next[last]];
  out->kind = DYD_ARC_WINDOW;
  if (f->arc) {
    uint32_t i = c->task->site, j = c->site[f->curve];
    out->kind = f->arc->parabola ? DYD_ARC_PARABOLA : DYD_ARC_LINE;
    out->far_site = c->task->outer ? j : i;
    out->near_site = c->task->outer ? i : j;
    out->corner = f->arc->corner;
    out->feature = f->arc->feature;
  }
  links_write_end(&out->begin, c, f, before, f->begin);
  links_write_end(&out->end, c, t, after, t->end);
}

/* Where the chain through p starts: at infinity, or after a break. */
static size_t links_chain_start(const links *l, const exact_cell *c, size_t p) {
  size_t start = p;
  while (l->last[start] != NONE && l->last[start] != p) start = l->last[start];
  if (l->last[start] == NONE) return start;
  size_t q = p;
  while (links_are_smooth(l, c, l->last[q]) && l->last[q] != p) q = l->last[q];
  return q;
}

static dyd_status links_write_chain(dyd_boundary *out, links *l, const exact_cell *c, size_t start) {
  size_t arcs = 0, p = start;
  do {
    l->done[p] = true;
    bool smooth = links_are_smooth(l, c, p);
    p = l->next[p];
    arcs += !smooth || p == start;
  } while (p != NONE && p != start);
  dyd_chain *chain = boundary_add_chain(out, arcs);
  if (!chain) return DYD_E_NOMEM;
  chain->closed = p != NONE;
  p = start;
  for (size_t k = 0; k < arcs; k++) {
    size_t first = p;
    while (links_are_smooth(l, c, p) && l->next[p] != start) p = l->next[p];
    links_write_arc(&chain->arc[k], c, l, first, p);
    p = l->next[p];
  }
  return DYD_OK;
}

static dyd_status links_write_all(dyd_boundary *out, links *l, const exact_cell *c) {
  out->chain = dyd_alloc(c->pieces, sizeof *out->chain);
  if (!out->chain) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  bool all_window = true;
  for (size_t p = 0; p < c->pieces && st == DYD_OK; p++) {
    all_window = all_window && !c->piece[p].arc;
    if (!l->done[p]) st = links_write_chain(out, l, c, links_chain_start(l, c, p));
  }
  out->whole = all_window;
  return st;
}

/* Joins the pieces to chains. *out is empty before; on failure the caller clears it. */
static dyd_status cell_link(dyd_boundary *out, const exact_cell *c) {
  DYD_SCOPED(links) l;
  dyd_status st = links_init(&l, c->pieces);
  if (st == DYD_OK) {
    links_join(&l, c, true);
    links_join(&l, c, false);
    st = links_write_all(out, &l, c);
  }
  return st;
}

/* ---- scale ---- */

/* Moves the origin to the fixed rectangle and doubles. */
static void irect_place(dyd_irect *r, mpz_srcptr ox, mpz_srcptr oy) {
  mpz_ptr end[4] = {r->x0, r->x1, r->y0, r->y1};
  for (int k = 0; k < 4; k++) {
    mpz_sub(end[k], end[k], k < 2 ? ox : oy);
    mpz_mul_2exp(end[k], end[k], 1);
  }
}

static size_t irect_bits(const dyd_irect *r) {
  mpz_srcptr end[4] = {r->x0, r->x1, r->y0, r->y1};
  size_t bits = 0;
  for (int k = 0; k < 4; k++)
    if (mpz_sizeinbase(end[k], 2) > bits) bits = mpz_sizeinbase(end[k], 2);
  return bits;
}

/* Scales all rectangles; the doubled origin is kept for the way back. Products of four doubles stay below 2^1000. */
static void cell_frame_scale(cell_frame *c, const dyd_cell_task *task, dyd_irect *r, size_t n) {
  dyd_irects_scale(r, task->rect, n, c->man, &c->exp);
  mpz_set(c->ox, r[0].x0);
  mpz_set(c->oy, r[0].y0);
  size_t bits = 0;
  for (size_t k = 0; k < n; k++) {
    irect_place(&r[k], c->ox, c->oy);
    if (irect_bits(&r[k]) > bits) bits = irect_bits(&r[k]);
  }
  mpz_mul_2exp(c->ox, c->ox, 1);
  mpz_mul_2exp(c->oy, c->oy, 1);
  c->exp++;
  c->shift = bits > 200 ? (int64_t)bits - 200 : 0;
}

static void scaled_take(dyd_scaled *out, dyd_irect *r, int64_t shift) {
  dyd_irect t = out->r;
  out->r = *r;
  *r = t;
  dyd_filter_irect_box(&out->box, &out->r, shift);
}

static void cell_frame_set_corners(cell_frame *c) {
  const dyd_irect *w = &c->window.r;
  for (int k = 0; k < 4; k++) {
    mpz_set(c->corner[k].at.ax, k == 1 || k == 2 ? w->x1 : w->x0);
    mpz_set(c->corner[k].at.ay, k >= 2 ? w->y1 : w->y0);
    dyd_filter_spot_box(&c->corner[k], c->shift);
  }
}

/* Fills fixed, window, other, site; *blocked: some other meets the fixed rectangle. */
static dyd_status cell_set_rects(bool *blocked, exact_cell *c, cell_frame *frame) {
  const dyd_cell_task *t = c->task;
  size_t n = t->count + 1 + (t->windowed ? 1 : 0);
  DYD_FREED dyd_irect *r = dyd_alloc(n, sizeof *r);
  c->other = dyd_alloc(t->count, sizeof *c->other);
  c->site = dyd_alloc(t->count, sizeof *c->site);
  if (!r || !c->other || !c->site) return DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) dyd_irect_init(&r[k]);
  cell_frame_scale(frame, t, r, n);
  scaled_take(&frame->fixed, &r[0], frame->shift);
  if (t->windowed) {
    scaled_take(&frame->window, &r[n - 1], frame->shift);
    cell_frame_set_corners(frame);
  }
  *blocked = false;
  for (size_t k = 0; k < t->count; k++) {
    if (dyd_irects_meet(&frame->fixed.r, &r[k + 1])) {
      *blocked = true;
      continue;
    }
    dyd_irect_init(&c->other[c->count].r);
    c->site[c->count] = t->other[k];
    scaled_take(&c->other[c->count++], &r[k + 1], frame->shift);
  }
  for (size_t k = n; k-- > 0;) dyd_irect_clear(&r[k]);
  return DYD_OK;
}

/* ---- the whole ---- */

static void cell_frame_init(cell_frame *f, const dyd_cell_task *task) {
  memset(f, 0, sizeof *f);
  f->fixed_touch = task->outer ? DYD_CLOSEST : DYD_FARTHEST;
  f->other_touch = task->outer ? DYD_FARTHEST : DYD_CLOSEST;
  dyd_irect_init(&f->fixed.r);
  dyd_irect_init(&f->window.r);
  mpz_inits(f->man, f->ox, f->oy, NULL);
  for (int k = 0; k < 4; k++) dyd_surd_point_init(&f->corner[k].at);
}

static void cell_frame_clear(cell_frame *f) {
  for (int k = 4; k-- > 0;) dyd_surd_point_clear(&f->corner[k].at);
  mpz_clears(f->man, f->ox, f->oy, NULL);
  dyd_irect_clear(&f->window.r);
  dyd_irect_clear(&f->fixed.r);
}

/* No boundary at all: the plane, or nothing? */
static bool cell_is_whole(const exact_cell *c) {
  return !c->task->windowed && (c->task->outer || !c->task->count);
}

dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task) {
  DYD_SCOPED(cell_frame) frame;
  exact_cell c;
  dyd_boundary b = {0};
  bool blocked = false;
  cell_frame_init(&frame, task);
  cell_init(&c, task, &frame);
  dyd_status st = cell_set_rects(&blocked, &c, &frame);
  if (st == DYD_OK && (task->outer || !blocked)) {
    st = cell_find_pieces(&c);
    if (st == DYD_OK && c.pieces) st = cell_link(&b, &c);
    if (!c.pieces) b.whole = cell_is_whole(&c);
  }
  for (size_t k = c.count; k-- > 0;) dyd_irect_clear(&c.other[k].r);
  cell_clear(&c);
  if (st != DYD_OK) return dyd_boundary_clear(&b), st;
  dyd_boundary_clear(out);
  *out = b;
  return DYD_OK;
}

/* ---- the public calls ----
 *
 * [CELL-2] Under every choice the true cell of i is bounded by its Delaunay neighbours, which are possible neighbours.
 * So a point nearer to R_i than to all possible neighbours is in every true cell, hence in Int_i; and a point of Ext_i,
 * under the choice with p_i closest to it and all others farthest, is nearer to some Delaunay neighbour of i, hence in
 * C_ji for a possible neighbour j. No other site matters. */

/* *site = the site that i is an alias of, or i. */
static dyd_status find_cell_site(uint32_t *site, const dyd_delaunay *pd, uint32_t i) {
  if (i >= dyd_sites_count(dyd_delaunay_sites(pd))) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  *site = dyd_delaunay_alias(pd, i);
  return DYD_OK;
}

static bool window_has_area(const dyd_rect *w) {
  return dyd_dyadic_cmp(&w->x.lo, &w->x.hi) < 0 && dyd_dyadic_cmp(&w->y.lo, &w->y.hi) < 0;
}

/* The region of `site` among the sites s of its cell; window: NULL for the whole plane. */
static dyd_status cell_region_among(dyd_boundary *out, const dyd_delaunay *pd, const dyd_cell_sites *s, uint32_t site,
                                    bool outer, const dyd_rect *window, dyd_room *room, const volatile int *cancel) {
  DYD_FREED const dyd_rect **in = dyd_alloc(s->count + 2, sizeof *in);
  if (!in) return DYD_E_NOMEM;
  in[0] = &s->own;
  for (size_t k = 0; k < s->count; k++) in[k + 1] = &s->other[k];
  in[s->count + 1] = window;
  dyd_cell_task task = {site, s->site, s->count, in, outer, window != NULL, pd, false, cancel, room};
  return dyd_cell_boundary(out, &task);
}

dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, bool proved,
                           const dyd_rect *window, dyd_room *room, const volatile int *cancel) {
  uint32_t site;
  if (window && !window_has_area(window)) return DYD_E_ARG;
  if (dyd_flag_is_set(cancel)) return DYD_CANCELLED;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  DYD_SCOPED(dyd_cell_sites) s;
  dyd_pair_status least = dyd_least_at(pd, site, proved);
  st = dyd_cell_sites_init(&s, pd, site, least);
  const dyd_delaunay *complete =
      least == dyd_least_bounding(pd) ? pd : NULL; /* of some sites only: all may share one */
  return st == DYD_OK ? cell_region_among(out, complete, &s, site, outer, window, room, cancel) : st;
}

dyd_status dyd_voronoi_cell(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, dyd_cell_bound bound,
                            const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  dyd_room room = dyd_delaunay_room(pd);
  return dyd_cell_region(out, pd, i, bound == DYD_CELL_POSSIBLE, false, window, &room, NULL);
}

dyd_status dyd_bisector(dyd_boundary *out, const dyd_rect *a, const dyd_rect *b) {
  const uint32_t other = 1;
  const dyd_rect *in[2] = {a, b};
  dyd_cell_task task = {0, &other, 1, in, false, false, NULL, false, NULL, NULL};
  return dyd_cell_boundary(out, &task);
}

/* ---- points ---- */

/* TRUE unless some neighbour says otherwise. */
static dyd_truth side_of_cell(const dyd_cell_sites *s, const dyd_point *c) {
  dyd_truth answer = DYD_TRUE;
  for (size_t k = 0; k < s->count && answer != DYD_FALSE; k++) {
    dyd_truth one = dyd_nearer(c, &s->own, &s->other[k]);
    if (one != DYD_TRUE) answer = one;
  }
  return answer;
}

dyd_status dyd_cell_point_side(dyd_truth *out, const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  uint32_t site;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  DYD_SCOPED(dyd_cell_sites) s;
  st = dyd_cell_sites_init(&s, pd, site, dyd_least_bounding(pd));
  if (st == DYD_OK) *out = side_of_cell(&s, c);
  return st;
}

dyd_truth dyd_voronoi_side(const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  if (!pd) return DYD_UNKNOWN;
  dyd_truth answer = DYD_UNKNOWN;
  return dyd_cell_point_side(&answer, pd, i, c) == DYD_OK ? answer : DYD_UNKNOWN;
}
