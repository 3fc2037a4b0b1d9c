/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the work on one cell has in common: sides of points, samples between points, lists of cuts and pieces. */
#include "voronoi/exact_cell.h"

#include "base/alloc.h"

#include <stdlib.h>

/* ---- samples and sides ---- */

int dyd_cell_spot_side(const dyd_exact_cell *c, const dyd_spot *p, size_t k) {
  int sign = dyd_filter_side(p, &c->other[k].box, c->frame->other_touch, &c->frame->fixed.box, c->frame->fixed_touch);
  return sign ? sign
              : dyd_surd_point_side(&p->at, &c->other[k].r, c->frame->other_touch, &c->frame->fixed.r,
                                    c->frame->fixed_touch);
}

mpz_srcptr dyd_window_level(const dyd_exact_cell *c, int side) {
  const dyd_irect *w = &c->frame->window.r;
  return side == 0 ? w->y0 : side == 1 ? w->x1 : side == 2 ? w->y1 : w->x0;
}

static void sample_make_exact(const dyd_exact_cell *c, dyd_sample *s, const dyd_elementary *arc, int window_side) {
  dyd_surd_point *p = &s->spot.at;
  s->known = true;
  if (arc) {
    dyd_elementary_at(p, arc, s->num, s->bits);
    return;
  }
  int axis = dyd_window_axis(window_side);
  mpz_set(axis ? p->ay : p->ax, s->num);
  mpz_mul_2exp(axis ? p->ax : p->ay, dyd_window_level(c, window_side), (mp_bitcnt_t)s->bits);
  dyd_surd_point_drop_root(p);
  mpz_set_ui(p->d, 1);
  mpz_mul_2exp(p->d, p->d, (mp_bitcnt_t)s->bits);
}

int dyd_cell_side(const dyd_exact_cell *c, dyd_sample *s, const dyd_elementary *arc, int window_side, size_t k) {
  int sign =
      dyd_filter_side(&s->spot, &c->other[k].box, c->frame->other_touch, &c->frame->fixed.box, c->frame->fixed_touch);
  if (sign) return sign;
  if (!s->known) sample_make_exact(c, s, arc, window_side);
  return dyd_surd_point_side(&s->spot.at, &c->other[k].r, c->frame->other_touch, &c->frame->fixed.r,
                             c->frame->fixed_touch);
}

/* num / 2^bits strictly between two points, by enclosures of growing precision; some number when both are infinite. */
static void sample_between(dyd_sample *s, const dyd_spot *low, const dyd_spot *high, int axis) {
  mpz_t up, down, t;
  mpz_inits(up, down, t, NULL);
  for (s->bits = 4;; s->bits *= 2) {
    if (!low->infinite) dyd_surd_point_floor(t, up, &low->at, axis, s->bits);
    if (!high->infinite) dyd_surd_point_floor(down, t, &high->at, axis, s->bits);
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
  static const int end[4] = {2, 1, 3, 0};
  dyd_iv level = arc ? DYD_IV_UNKNOWN : c->frame->window.box.end[end[window_side]];
  if (dyd_filter_sample(s, arc ? &arc->shape : NULL, level, axis, low, high, c->frame->shift)) return;
  sample_between(s, low, high, axis);
  s->spot.infinite = false;
  sample_make_exact(c, s, arc, window_side);
  dyd_filter_spot_box(&s->spot, c->frame->shift);
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

static int compare_cut_x(const void *p, const void *q) {
  return dyd_cell_spot_cmp(*(const dyd_spot *const *)p, *(const dyd_spot *const *)q, 0);
}

static int compare_cut_y(const void *p, const void *q) {
  return dyd_cell_spot_cmp(*(const dyd_spot *const *)p, *(const dyd_spot *const *)q, 1);
}

size_t dyd_cell_sort_cuts(const dyd_spot **cut, size_t count, int axis) {
  if (count > 1) qsort(cut, count, sizeof(const dyd_spot *), axis ? compare_cut_y : compare_cut_x);
  size_t kept = 0;
  for (size_t k = 0; k < count; k++)
    if (!kept || dyd_cell_spot_cmp(cut[kept - 1], cut[k], axis)) cut[kept++] = cut[k];
  return kept;
}

/* ---- pieces ---- */

dyd_status dyd_cell_add_piece(dyd_exact_cell *c, dyd_piece p) {
  if (!dyd_reserve((void **)&c->piece, &c->piece_cap, c->pieces + 1, sizeof *c->piece)) return DYD_E_NOMEM;
  c->piece[c->pieces++] = p;
  return DYD_OK;
}
