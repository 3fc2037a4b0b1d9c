/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The exact boundary of a region from the rectangles: scaled, pruned, cut in pieces, linked. */
#include "base/alloc.h"
#include "voronoi/exact_cell.h"

#include <string.h>

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
static void cell_frame_scale(dyd_cell_frame *c, const dyd_cell_task *task, dyd_irect *r, size_t n) {
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

static void cell_frame_set_corners(dyd_cell_frame *c) {
  const dyd_irect *w = &c->window.r;
  for (int k = 0; k < 4; k++) {
    mpz_set(c->corner[k].at.ax, k == 1 || k == 2 ? w->x1 : w->x0);
    mpz_set(c->corner[k].at.ay, k >= 2 ? w->y1 : w->y0);
    dyd_filter_spot_box(&c->corner[k], c->shift);
  }
}

/* Fills fixed, window, other, site; *blocked: some other meets the fixed rectangle. */
static dyd_status cell_set_rects(bool *blocked, dyd_exact_cell *c, dyd_cell_frame *frame) {
  const dyd_cell_task *t = c->task;
  size_t n = t->count + 1 + (t->windowed ? 1 : 0);
  dyd_irect *r = dyd_alloc(n, sizeof *r);
  c->other = dyd_alloc(t->count, sizeof *c->other);
  c->site = dyd_alloc(t->count, sizeof *c->site);
  if (!r || !c->other || !c->site) return free(r), DYD_E_NOMEM;
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
  free(r);
  return DYD_OK;
}

/* ---- the whole ---- */

static void cell_frame_init(dyd_cell_frame *f, const dyd_cell_task *task) {
  memset(f, 0, sizeof *f);
  f->fixed_touch = task->outer ? DYD_CLOSEST : DYD_FARTHEST;
  f->other_touch = task->outer ? DYD_FARTHEST : DYD_CLOSEST;
  dyd_irect_init(&f->fixed.r);
  dyd_irect_init(&f->window.r);
  mpz_inits(f->man, f->ox, f->oy, NULL);
  for (int k = 0; k < 4; k++) dyd_surd_point_init(&f->corner[k].at);
}

static void cell_frame_clear(dyd_cell_frame *f) {
  for (int k = 4; k-- > 0;) dyd_surd_point_clear(&f->corner[k].at);
  mpz_clears(f->man, f->ox, f->oy, NULL);
  dyd_irect_clear(&f->window.r);
  dyd_irect_clear(&f->fixed.r);
}

/* No boundary at all: the plane, or nothing? */
static bool cell_is_whole(const dyd_exact_cell *c) {
  return !c->task->windowed && (c->task->outer || !c->task->count);
}

dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task) {
  dyd_cell_frame frame;
  dyd_exact_cell c;
  dyd_boundary b = {0};
  bool blocked = false;
  cell_frame_init(&frame, task);
  dyd_cell_init(&c, task, &frame);
  dyd_status st = cell_set_rects(&blocked, &c, &frame);
  if (st == DYD_OK && (task->outer || !blocked)) {
    st = dyd_cell_prune(&c);
    if (st == DYD_OK) st = dyd_cell_find_pieces(&c);
    if (st == DYD_OK && c.pieces) st = dyd_cell_link(&b, &c);
    if (!c.pieces) b.whole = cell_is_whole(&c);
  }
  for (size_t k = c.count; k-- > 0;) dyd_irect_clear(&c.other[k].r);
  dyd_cell_clear(&c);
  cell_frame_clear(&frame);
  if (st != DYD_OK) return dyd_boundary_clear(&b), st;
  dyd_boundary_clear(out);
  *out = b;
  return DYD_OK;
}
