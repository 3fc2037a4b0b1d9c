/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of Int_i and Pos_i, piece by piece.
 *
 * On the boundary of Int_i some j has dl_i = ds_j <= ds_k for all k; on that of Pos_i some j has dl_j = ds_i <= dl_k.
 * Let D_k = ds_k (Int) or dl_k (Pos), r = dl_i or ds_i. So the boundary consists of those points of the curves r = D_j
 * where no D_k is less than r. Along a curve this can change only where D_k = r too and no other D_l is less: there j
 * and k are both possible at the point, so jk is a possible pair [CELL-2]. Such points are centres of critical circles
 * FCC (Int) or CFF (Pos) of i, j, k, which dyd_icircles finds [CRIT-1]: where the curves of j and k coincide along a
 * stretch, since both show the same feature, the end of the stretch is in a cell beyond it, in which they show
 * different ones, and different features leave finitely many circles. Between two cuts one exact sample decides. Of
 * curves that coincide the one with the lowest number counts. */
#include "voronoi/exact_cell.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "dyadic/raw.h"
#include "predicate/icircle.h"

#include <string.h>

/* ---- samples and sides ---- */

int dyd_cell_spot_side(const dyd_exact_cell *c, const dyd_spot *p, size_t k) {
  int sign = dyd_filter_side(p, &c->other[k].box, c->other_touch, &c->fixed.box, c->fixed_touch);
  return sign ? sign : dyd_surd_point_side(&p->at, &c->other[k].r, c->other_touch, &c->fixed.r, c->fixed_touch);
}

mpz_srcptr dyd_window_level(const dyd_exact_cell *c, int side) {
  const dyd_irect *w = &c->window.r;
  return side == 0 ? w->y0 : side == 1 ? w->x1 : side == 2 ? w->y1 : w->x0;
}

static void make_exact(const dyd_exact_cell *c, dyd_sample *s, const dyd_elementary *arc, int window_side) {
  dyd_surd_point *p = &s->spot.at;
  s->known = true;
  if (arc) {
    dyd_elementary_at(p, arc, s->num, s->bits);
    return;
  }
  int axis = dyd_window_axis(window_side);
  mpz_set(axis ? p->ay : p->ax, s->num);
  mpz_mul_2exp(axis ? p->ax : p->ay, dyd_window_level(c, window_side), (mp_bitcnt_t)s->bits);
  mpz_set_ui(p->bx, 0);
  mpz_set_ui(p->by, 0);
  mpz_set_ui(p->c, 0);
  mpz_set_ui(p->d, 1);
  mpz_mul_2exp(p->d, p->d, (mp_bitcnt_t)s->bits);
}

int dyd_cell_side(const dyd_exact_cell *c, dyd_sample *s, const dyd_elementary *arc, int window_side, size_t k) {
  int sign = dyd_filter_side(&s->spot, &c->other[k].box, c->other_touch, &c->fixed.box, c->fixed_touch);
  if (sign) return sign;
  if (!s->known) make_exact(c, s, arc, window_side);
  return dyd_surd_point_side(&s->spot.at, &c->other[k].r, c->other_touch, &c->fixed.r, c->fixed_touch);
}

/* num / 2^bits strictly between two points, by enclosures of growing precision. */
static void between(dyd_sample *s, const dyd_spot *low, const dyd_spot *high, int axis) {
  mpz_t up, down, t;
  mpz_inits(up, down, t, NULL);
  for (s->bits = 4;; s->bits *= 2) {
    if (!low->infinite) dyd_surd_point_floor(t, up, &low->at, axis, s->bits);
    if (!high->infinite) dyd_surd_point_floor(down, t, &high->at, axis, s->bits);
    if (low->infinite && high->infinite) mpz_set_ui(up, 0);
    if (low->infinite && !high->infinite) mpz_sub_ui(up, down, 2);
    if (high->infinite) mpz_add_ui(down, up, 2);
    if (mpz_cmp(up, down) < 0) break;
  }
  mpz_add(s->num, up, down);
  s->bits++;
  mpz_clears(up, down, t, NULL);
}

void dyd_cell_sample(dyd_exact_cell *c, const dyd_elementary *arc, int window_side, const dyd_spot *low,
                     const dyd_spot *high) {
  dyd_sample *s = &c->sample;
  int axis = arc ? arc->axis : dyd_window_axis(window_side);
  if (arc && dyd_filter_sample(s, &arc->shape, axis, low, high, c->shift)) return;
  if (!arc) {
    static const int end[4] = {2, 1, 3, 0};
    if (dyd_filter_sample_segment(s, c->window.box.end[end[window_side]], axis, low, high, c->shift)) return;
  }
  between(s, low, high, axis);
  s->spot.infinite = false;
  make_exact(c, s, arc, window_side);
  dyd_filter_spot_box(&s->spot, c->shift);
}

/* ---- cuts ---- */

dyd_status dyd_cell_add_cut(dyd_exact_cell *c, size_t *count, const dyd_spot *s) {
  if (!dyd_reserve((void **)&c->cut, &c->cut_cap, *count + 1, sizeof *c->cut)) return DYD_E_NOMEM;
  c->cut[(*count)++] = s;
  return DYD_OK;
}

int dyd_cell_spot_cmp(const dyd_spot *p, const dyd_spot *q, int axis) {
  int sign = dyd_filter_spot_cmp(p, q, axis);
  return sign ? sign : dyd_surd_point_cmp(&p->at, &q->at, axis);
}

static int compare_x(const void *p, const void *q) {
  return dyd_cell_spot_cmp(*(const dyd_spot *const *)p, *(const dyd_spot *const *)q, 0);
}

static int compare_y(const void *p, const void *q) {
  return dyd_cell_spot_cmp(*(const dyd_spot *const *)p, *(const dyd_spot *const *)q, 1);
}

size_t dyd_cell_sort_cuts(const dyd_spot **cut, size_t count, int axis) {
  if (count > 1) qsort(cut, count, sizeof(const dyd_spot *), axis ? compare_y : compare_x);
  size_t kept = 0;
  for (size_t k = 0; k < count; k++)
    if (!kept || dyd_cell_spot_cmp(cut[kept - 1], cut[k], axis)) cut[kept++] = cut[k];
  return kept;
}

/* Adds s if it is strictly inside the arc. */
static dyd_status cut_arc(dyd_exact_cell *c, size_t *count, const dyd_elementary *a, const dyd_spot *s) {
  if (s->infinite || !dyd_elementary_holds(a, s)) return DYD_OK;
  if (!a->end[0].infinite && dyd_cell_spot_cmp(s, &a->end[0], a->axis) <= 0) return DYD_OK;
  if (!a->end[1].infinite && dyd_cell_spot_cmp(s, &a->end[1], a->axis) >= 0) return DYD_OK;
  return dyd_cell_add_cut(c, count, s);
}

/* All cuts of an arc, unsorted. */
static dyd_status find_cuts(dyd_exact_cell *c, size_t *count, const dyd_elementary *a, size_t j) {
  *count = 0;
  for (size_t m = 0; m < c->meets; m++) {
    const dyd_meet *meet = &c->meet[m];
    if (meet->curve[0] != j && meet->curve[1] != j) continue;
    dyd_status st = cut_arc(c, count, a, &meet->spot);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

/* ---- pieces ---- */

dyd_status dyd_cell_add_piece(dyd_exact_cell *c, dyd_piece p) {
  if (!dyd_reserve((void **)&c->piece, &c->piece_cap, c->pieces + 1, sizeof *c->piece)) return DYD_E_NOMEM;
  c->piece[c->pieces++] = p;
  return DYD_OK;
}

/* Does k take the sample on curve j away from it? */
static bool takes(dyd_exact_cell *c, const dyd_elementary *a, size_t j, size_t k) {
  if (k == j) return false;
  int sign = dyd_cell_side(c, &c->sample, a, 0, k);
  return sign < 0 || (!sign && k < j);
}

/* Is the sample on curve j a point of the boundary that counts for j? Who took the last one is asked first. */
static bool is_kept(dyd_exact_cell *c, const dyd_elementary *a, size_t j) {
  if (c->taker < c->count && takes(c, a, j, c->taker)) return false;
  for (size_t k = 0; k < c->count; k++)
    if (k != c->taker && takes(c, a, j, k)) return c->taker = k, false;
  return true;
}

static dyd_status arc_pieces(dyd_exact_cell *c, size_t j, const dyd_elementary *a) {
  size_t count;
  if (a->point) return DYD_OK;
  dyd_status st = find_cuts(c, &count, a, j);
  if (st != DYD_OK) return st;
  count = dyd_cell_sort_cuts(c->cut, count, a->axis);
  bool grows = (a->direction > 0) != c->task->outer;
  for (size_t k = 0; k <= count && st == DYD_OK; k++) {
    const dyd_spot *low = k ? c->cut[k - 1] : &a->end[0], *high = k < count ? c->cut[k] : &a->end[1];
    dyd_cell_sample(c, a, 0, low, high);
    if (is_kept(c, a, j)) st = dyd_cell_add_piece(c, (dyd_piece){j, a, grows ? low : high, grows ? high : low});
  }
  return st;
}

/* ---- meets ---- */

static dyd_status add_meet(dyd_exact_cell *c, size_t j, size_t k, dyd_icircle *circle) {
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
  dyd_filter_spot_box(&m->spot, c->shift);
  return DYD_OK;
}

static bool may_meet(const dyd_exact_cell *c, size_t j, size_t k) {
  const dyd_delaunay *pd = c->task->pd;
  return !pd || dyd_delaunay_status(pd, c->site[j], c->site[k]) != DYD_ILLEGAL;
}

static dyd_status find_meets(dyd_exact_cell *c) {
  dyd_icircle circle[DYD_CELL_CIRCLES];
  for (int m = 0; m < DYD_CELL_CIRCLES; m++) dyd_icircle_init(&circle[m]);
  const dyd_touch touch[3] = {c->fixed_touch, c->other_touch, c->other_touch};
  dyd_status st = DYD_OK;
  for (size_t j = 0; j < c->count; j++)
    for (size_t k = j + 1; k < c->count && st == DYD_OK; k++) {
      if (!may_meet(c, j, k)) continue;
      const dyd_irect *r[3] = {&c->fixed.r, &c->other[j].r, &c->other[k].r};
      size_t found = dyd_icircles(circle, DYD_CELL_CIRCLES, r, touch);
      DYD_INVARIANT(found < DYD_CELL_CIRCLES);
      for (size_t m = 0; m < found && st == DYD_OK; m++) st = add_meet(c, j, k, &circle[m]);
    }
  for (int m = DYD_CELL_CIRCLES; m-- > 0;) dyd_icircle_clear(&circle[m]);
  return st;
}

/* ---- scale ---- */

/* Moves the origin to the fixed rectangle and doubles. */
static void place(dyd_irect *r, mpz_srcptr ox, mpz_srcptr oy) {
  mpz_ptr end[4] = {r->x0, r->x1, r->y0, r->y1};
  for (int k = 0; k < 4; k++) {
    mpz_sub(end[k], end[k], k < 2 ? ox : oy);
    mpz_mul_2exp(end[k], end[k], 1);
  }
}

static size_t longest(const dyd_irect *r) {
  mpz_srcptr end[4] = {r->x0, r->x1, r->y0, r->y1};
  size_t bits = 0;
  for (int k = 0; k < 4; k++)
    if (mpz_sizeinbase(end[k], 2) > bits) bits = mpz_sizeinbase(end[k], 2);
  return bits;
}

/* Scales all rectangles; the doubled origin is kept for the way back. Products of four doubles stay below 2^1000. */
static void scale_all(dyd_exact_cell *c, dyd_irect *r, size_t n) {
  dyd_irects_scale(r, c->task->rect, n, c->man, &c->exp);
  mpz_set(c->ox, r[0].x0);
  mpz_set(c->oy, r[0].y0);
  size_t bits = 0;
  for (size_t k = 0; k < n; k++) {
    place(&r[k], c->ox, c->oy);
    if (longest(&r[k]) > bits) bits = longest(&r[k]);
  }
  mpz_mul_2exp(c->ox, c->ox, 1);
  mpz_mul_2exp(c->oy, c->oy, 1);
  c->exp++;
  c->shift = bits > 200 ? (int64_t)bits - 200 : 0;
}

static bool meet(const dyd_irect *a, const dyd_irect *b) {
  return mpz_cmp(a->x0, b->x1) <= 0 && mpz_cmp(b->x0, a->x1) <= 0 && mpz_cmp(a->y0, b->y1) <= 0 &&
         mpz_cmp(b->y0, a->y1) <= 0;
}

static void take(dyd_scaled *out, dyd_irect *r, int64_t shift) {
  dyd_irect t = out->r;
  out->r = *r;
  *r = t;
  dyd_filter_irect_box(&out->box, &out->r, shift);
}

static void set_corners(dyd_exact_cell *c) {
  const dyd_irect *w = &c->window.r;
  for (int k = 0; k < 4; k++) {
    mpz_set(c->corner[k].at.ax, k == 1 || k == 2 ? w->x1 : w->x0);
    mpz_set(c->corner[k].at.ay, k >= 2 ? w->y1 : w->y0);
    dyd_filter_spot_box(&c->corner[k], c->shift);
  }
}

/* Fills fixed, window, other, site; *blocked: some other meets the fixed rectangle. */
static dyd_status set_rects(dyd_exact_cell *c, bool *blocked) {
  const dyd_cell_task *t = c->task;
  size_t n = t->count + 1 + (t->windowed ? 1 : 0);
  dyd_irect *r = dyd_alloc(n, sizeof *r);
  c->other = dyd_alloc(t->count, sizeof *c->other);
  c->site = dyd_alloc(t->count, sizeof *c->site);
  if (!r || !c->other || !c->site) return free(r), DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) dyd_irect_init(&r[k]);
  scale_all(c, r, n);
  take(&c->fixed, &r[0], c->shift);
  if (t->windowed) {
    take(&c->window, &r[n - 1], c->shift);
    set_corners(c);
  }
  *blocked = false;
  for (size_t k = 0; k < t->count; k++) {
    if (meet(&c->fixed.r, &r[k + 1])) {
      *blocked = true;
      continue;
    }
    dyd_irect_init(&c->other[c->count].r);
    c->site[c->count] = t->other[k];
    take(&c->other[c->count++], &r[k + 1], c->shift);
  }
  for (size_t k = n; k-- > 0;) dyd_irect_clear(&r[k]);
  free(r);
  return DYD_OK;
}

/* ---- the whole ---- */

static void cell_init(dyd_exact_cell *c, const dyd_cell_task *task) {
  memset(c, 0, sizeof *c);
  c->task = task;
  c->fixed_touch = task->outer ? DYD_CLOSEST : DYD_FARTHEST;
  c->other_touch = task->outer ? DYD_FARTHEST : DYD_CLOSEST;
  dyd_irect_init(&c->fixed.r);
  dyd_irect_init(&c->window.r);
  mpz_inits(c->man, c->ox, c->oy, c->sample.num, NULL);
  for (int k = 0; k < 4; k++) dyd_surd_point_init(&c->corner[k].at);
  dyd_surd_point_init(&c->sample.spot.at);
}

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

static void cell_clear(dyd_exact_cell *c) {
  dyd_cell_forget(c);
  for (size_t k = c->count; k-- > 0;) dyd_irect_clear(&c->other[k].r);
  free(c->other);
  free(c->site);
  dyd_surd_point_clear(&c->sample.spot.at);
  for (int k = 4; k-- > 0;) dyd_surd_point_clear(&c->corner[k].at);
  mpz_clears(c->man, c->ox, c->oy, c->sample.num, NULL);
  dyd_irect_clear(&c->window.r);
  dyd_irect_clear(&c->fixed.r);
}

static dyd_status set_curves(dyd_exact_cell *c) {
  c->curve = dyd_alloc(c->count, sizeof *c->curve);
  if (!c->curve) return DYD_E_NOMEM;
  const dyd_scaled *window = c->task->windowed ? &c->window : NULL;
  for (size_t k = 0; k < c->count; k++) {
    dyd_curve_init(&c->curve[k]);
    const dyd_scaled *far = c->task->outer ? &c->other[k] : &c->fixed,
                     *near = c->task->outer ? &c->fixed : &c->other[k];
    dyd_curve_set(&c->curve[k], far, near, window, c->task->outer ? -1 : 1, c->shift);
  }
  return DYD_OK;
}

dyd_status dyd_cell_find_pieces(dyd_exact_cell *c) {
  dyd_status st = set_curves(c);
  if (st == DYD_OK) st = find_meets(c);
  for (size_t j = 0; j < c->count && st == DYD_OK; j++)
    for (size_t a = 0; a < c->curve[j].count && st == DYD_OK; a++) st = arc_pieces(c, j, &c->curve[j].arc[a]);
  if (st == DYD_OK && c->task->windowed) st = dyd_cell_window_pieces(c);
  return st;
}

/* No boundary at all: the plane, or nothing? */
static bool is_whole(const dyd_exact_cell *c) {
  return !c->task->windowed && (c->task->outer || !c->task->count);
}

dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task) {
  dyd_exact_cell c;
  dyd_boundary b = {0};
  bool blocked = false;
  cell_init(&c, task);
  dyd_status st = set_rects(&c, &blocked);
  if (st == DYD_OK && (task->outer || !blocked)) {
    st = dyd_cell_prune(&c);
    if (st == DYD_OK) st = dyd_cell_find_pieces(&c);
    if (st == DYD_OK && c.pieces) st = dyd_cell_link(&b, &c);
    if (!c.pieces) b.whole = is_whole(&c);
  }
  cell_clear(&c);
  if (st != DYD_OK) return dyd_boundary_clear(&b), st;
  dyd_boundary_clear(out);
  *out = b;
  return DYD_OK;
}
