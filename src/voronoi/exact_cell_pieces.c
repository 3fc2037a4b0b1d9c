/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of Int_i and Pos_i, piece by piece.
 *
 * On the boundary of Int_i some j has dl_i = ds_j <= ds_k for all k; on that of Pos_i some j has dl_j = ds_i <= dl_k.
 * Let D_k = ds_k (Int) or dl_k (Pos), r = dl_i or ds_i. So the boundary consists of those points of the curves r = D_j
 * where no D_k is less than r. Along a curve this can change only where D_k = r too and no other D_l is less: there j
 * and k are both possible at the point, so jk is a possible pair [CELL-2]. Such points are centres of critical circles
 * FCC (Int) or CFF (Pos) of i, j, k, which dyd_icircles finds [CRIT-1]: where the curves of j and k coincide along a
 * stretch, since both show the same feature, the end of the stretch is in a pane beyond it, in which they show
 * different ones, and different features leave finitely many circles. Between two cuts one exact sample decides. Of
 * curves that coincide the one with the lowest number counts. */
#include "base/alloc.h"
#include "base/invariant.h"
#include "predicate/icircle.h"
#include "voronoi/exact_cell.h"

#include <string.h>

/* ---- cuts of an arc ---- */

/* Adds s if it is strictly inside the arc. */
static dyd_status cut_arc(dyd_exact_cell *c, size_t *count, const dyd_elementary *a, const dyd_spot *s) {
  if (s->infinite || !dyd_elementary_holds(a, s)) return DYD_OK;
  if (!a->end[0].infinite && dyd_cell_spot_cmp(s, &a->end[0], a->axis) <= 0) return DYD_OK;
  if (!a->end[1].infinite && dyd_cell_spot_cmp(s, &a->end[1], a->axis) >= 0) return DYD_OK;
  return dyd_cell_add_cut(c, count, s);
}

/* All cuts of an arc, unsorted. */
static dyd_status arc_find_cuts(dyd_exact_cell *c, size_t *count, const dyd_elementary *a, size_t j) {
  *count = 0;
  for (size_t m = 0; m < c->meets; m++) {
    const dyd_meet *meet = &c->meet[m];
    if (meet->curve[0] != j && meet->curve[1] != j) continue;
    dyd_status st = cut_arc(c, count, a, &meet->spot);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

/* ---- pieces of an arc ---- */

/* Does k take the sample on curve j away from it? */
static bool other_takes_sample(dyd_exact_cell *c, const dyd_elementary *a, size_t j, size_t k) {
  if (k == j) return false;
  int sign = dyd_cell_side(c, &c->sample, a, 0, k);
  return sign < 0 || (!sign && k < j);
}

/* Is the sample on curve j a point of the boundary that counts for j? Who took the last one is asked first. */
static bool sample_is_kept(dyd_exact_cell *c, const dyd_elementary *a, size_t j) {
  if (c->taker < c->count && other_takes_sample(c, a, j, c->taker)) return false;
  for (size_t k = 0; k < c->count; k++)
    if (k != c->taker && other_takes_sample(c, a, j, k)) return c->taker = k, false;
  return true;
}

static dyd_status arc_pieces(dyd_exact_cell *c, size_t j, const dyd_elementary *a) {
  size_t count;
  if (a->point) return DYD_OK;
  dyd_status st = arc_find_cuts(c, &count, a, j);
  if (st != DYD_OK) return st;
  count = dyd_cell_sort_cuts(c->cut, count, a->axis);
  bool grows = (a->direction > 0) != c->task->outer;
  if (dyd_flag_is_set(c->task->cancel)) return DYD_CANCELLED;
  for (size_t k = 0; k <= count && st == DYD_OK; k++) {
    const dyd_spot *low = k ? c->cut[k - 1] : &a->end[0], *high = k < count ? c->cut[k] : &a->end[1];
    dyd_cell_sample(c, a, 0, low, high);
    if (sample_is_kept(c, a, j)) st = dyd_cell_add_piece(c, (dyd_piece){j, a, grows ? low : high, grows ? high : low});
  }
  return st;
}

/* ---- meets ---- */

static bool cell_has_room(const dyd_exact_cell *c, uint64_t bytes) {
  return !c->task->room || dyd_room_has(c->task->room, dyd_bytes_add(c->bytes, bytes), "the boundary of a cell");
}

/* For one meet more, with what reserving takes while it copies. */
static bool meets_have_room(dyd_exact_cell *c, const dyd_icircle *circle) {
  enum { NUMBERS = 6, BLOCK = 16 };
  mpz_srcptr widest = mpz_size(circle->ax) > mpz_size(circle->ay) ? circle->ax : circle->ay;
  c->bytes += NUMBERS * (BLOCK + sizeof(mp_limb_t) * mpz_size(widest));
  return c->meets < c->meet_cap || cell_has_room(c, dyd_bytes_times(3 * c->meets + 16, sizeof *c->meet));
}

static dyd_status curves_add_meet(dyd_exact_cell *c, size_t j, size_t k, dyd_icircle *circle) {
  if (!meets_have_room(c, circle)) return DYD_E_NOMEM;
  if (!dyd_reserve((void **)&c->meet, &c->meet_cap, c->meets + 1, sizeof *c->meet)) return DYD_E_NOMEM;
  dyd_meet *m = &c->meet[c->meets++];
  *m = (dyd_meet){.curve = {(uint32_t)j, (uint32_t)k}};
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

static bool curves_may_meet(const dyd_exact_cell *c, size_t j, size_t k) {
  const dyd_delaunay *pd = c->task->pd;
  return !pd || dyd_delaunay_status(pd, c->site[j], c->site[k]) != DYD_ILLEGAL;
}

static dyd_status curves_find_meets(dyd_exact_cell *c) {
  dyd_icircle circle[DYD_CELL_CIRCLES];
  for (int m = 0; m < DYD_CELL_CIRCLES; m++) dyd_icircle_init(&circle[m]);
  const dyd_touch touch[3] = {c->frame->fixed_touch, c->frame->other_touch, c->frame->other_touch};
  dyd_status st = DYD_OK;
  for (size_t j = 0; j < c->count; j++)
    for (size_t k = j + 1; k < c->count && st == DYD_OK; k++) {
      if (dyd_flag_is_set(c->task->cancel)) st = DYD_CANCELLED;
      if (st != DYD_OK || !curves_may_meet(c, j, k)) continue;
      const dyd_irect *r[3] = {&c->frame->fixed.r, &c->other[j].r, &c->other[k].r};
      size_t found = dyd_icircles(circle, DYD_CELL_CIRCLES, r, touch);
      DYD_INVARIANT(found < DYD_CELL_CIRCLES);
      for (size_t m = 0; m < found && st == DYD_OK; m++) st = curves_add_meet(c, j, k, &circle[m]);
    }
  for (int m = DYD_CELL_CIRCLES; m-- > 0;) dyd_icircle_clear(&circle[m]);
  return st;
}

/* ---- all ---- */

void dyd_cell_forget(dyd_exact_cell *c) {
  free(c->cut);
  free(c->piece);
  for (size_t m = c->meets; m-- > 0;) dyd_surd_point_clear(&c->meet[m].spot.at);
  free(c->meet);
  if (c->curve)
    for (size_t k = c->count; k-- > 0;) dyd_curve_clear(&c->curve[k]);
  free(c->curve);
  c->cut = NULL;
  c->piece = NULL;
  c->meet = NULL;
  c->curve = NULL;
  c->cut_cap = c->pieces = c->piece_cap = c->meets = c->meet_cap = 0;
}

void dyd_cell_init(dyd_exact_cell *c, const dyd_cell_task *task, const dyd_cell_frame *frame) {
  memset(c, 0, sizeof *c);
  c->task = task;
  c->frame = frame;
  mpz_init(c->sample.num);
  dyd_surd_point_init(&c->sample.spot.at);
}

void dyd_cell_clear(dyd_exact_cell *c) {
  dyd_cell_forget(c);
  free(c->other);
  free(c->site);
  dyd_surd_point_clear(&c->sample.spot.at);
  mpz_clear(c->sample.num);
}

static dyd_status cell_set_curves(dyd_exact_cell *c) {
  c->bytes = dyd_bytes_times(c->count, sizeof *c->curve);
  if (!cell_has_room(c, 0)) return DYD_E_NOMEM;
  c->curve = dyd_alloc(c->count, sizeof *c->curve);
  if (!c->curve) return DYD_E_NOMEM;
  const dyd_scaled *window = c->task->windowed ? &c->frame->window : NULL;
  for (size_t k = 0; k < c->count; k++) {
    dyd_curve_init(&c->curve[k]);
    const dyd_scaled *far = c->task->outer ? &c->other[k] : &c->frame->fixed,
                     *near = c->task->outer ? &c->frame->fixed : &c->other[k];
    dyd_curve_set(&c->curve[k], far, near, window, c->task->outer ? -1 : 1, c->frame->shift);
  }
  return DYD_OK;
}

dyd_status dyd_cell_find_pieces(dyd_exact_cell *c) {
  dyd_status st = cell_set_curves(c);
  if (st == DYD_OK) st = curves_find_meets(c);
  for (size_t j = 0; j < c->count && st == DYD_OK; j++)
    for (size_t a = 0; a < c->curve[j].count && st == DYD_OK; a++) st = arc_pieces(c, j, &c->curve[j].arc[a]);
  if (st == DYD_OK && c->task->windowed) st = dyd_cell_window_pieces(c);
  return st;
}
