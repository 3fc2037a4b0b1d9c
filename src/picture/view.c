/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Views: which part of the plane a picture shows, where it is on the page. */
#include "base/error.h"
#include "base/index.h"
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>

#define SIDE 1000.0 /* of the drawing */
#define EDGE DYD_VIEW_EDGE

/* ---- what is shown ---- */

static dyd_status beyond_doubles(dyd_error *err) {
  return dyd_fail(err, DYD_E_RANGE, "the points are too far apart or too close for a picture; use csv or json");
}

dyd_status dyd_view_grow(double box[4], const dyd_rect *r, dyd_error *err) {
  double b[4];
  dyd_rect_get_d(b, r);
  for (int k = 0; k < 4; k++) {
    if (!isfinite(b[k])) return beyond_doubles(err);
    box[k] = k & 1 ? fmax(box[k], b[k]) : fmin(box[k], b[k]);
  }
  return DYD_OK;
}

void dyd_view_pad(double box[4]) {
  double w = box[1] - box[0], h = box[3] - box[2], size = fmax(w, h);
  if (size == 0) size = 1;
  double wide = (fmax(w, size) - w) / 2 + 0.1 * size, high = (fmax(h, 0.6 * size) - h) / 2 + 0.1 * size;
  box[0] -= wide, box[1] += wide;
  box[2] -= high, box[3] += high;
}

dyd_status dyd_view_fit(dyd_view *v, const double box[4], double spacing, dyd_error *err) {
  double w = box[1] - box[0], h = box[3] - box[2], size = fmax(w, h);
  if (!isfinite(size) || (size > 0 && !isfinite(SIDE / size))) return beyond_doubles(err);
  v->scale = size > 0 ? SIDE / size : 1;
  v->left = box[0], v->top = box[3];
  v->width = fmax(w * v->scale, 640);
  v->height = fmax(h * v->scale, 40);
  if (w * v->scale < v->width) v->left -= (v->width / v->scale - w) / 2;
  if (h * v->scale < v->height) v->top += (v->height / v->scale - h) / 2;
  double apart = spacing > 0 ? spacing * v->scale : SIDE;
  v->line = fmin(fmax(apart * 0.04, 0.2), 2.2);
  v->dot = fmin(fmax(apart * 0.09, 0.3), 4);
  v->apart = apart;
  v->dots = false;
  v->unit = NULL;
  v->frame[0] = DYD_VIEW_LEFT, v->frame[2] = EDGE;
  v->frame[1] = DYD_VIEW_LEFT + v->width, v->frame[3] = EDGE + v->height;
  return DYD_OK;
}

dyd_status dyd_view_all(dyd_view *v, const dyd_result *r, const dyd_pair_list *pairs, dyd_error *err) {
  double all[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t i = 0; i < r->count; i++) {
    double b[4];
    dyd_status st = dyd_result_box(b, r, i, err);
    if (st != DYD_OK) return st;
    for (int k = 0; k < 4; k++) all[k] = k & 1 ? fmax(all[k], b[k]) : fmin(all[k], b[k]);
  }
  if (r->count == 0) all[0] = all[1] = all[2] = all[3] = 0;
  double rim = 0.04 * fmax(all[1] - all[0], all[3] - all[2]);
  for (int k = 0; k < 4; k++) all[k] += k & 1 ? rim : -rim;
  return dyd_view_fit(v, all, dyd_view_spacing(r->pd, pairs, NULL), err);
}

/* Of the line between the middles of the rectangles; -1 when its middle is not in the box. */
static double pair_length(const dyd_delaunay *pd, const dyd_pair *pair, const double box[4]) {
  double a[4], b[4], c[2][2];
  dyd_sites_get_d(a, dyd_delaunay_sites(pd), pair->i);
  dyd_sites_get_d(b, dyd_delaunay_sites(pd), pair->j);
  for (int k = 0; k < 2; k++) {
    c[0][k] = a[2 * k] / 2 + a[2 * k + 1] / 2;
    c[1][k] = b[2 * k] / 2 + b[2 * k + 1] / 2;
    double middle = c[0][k] / 2 + c[1][k] / 2;
    if (box && !(box[2 * k] <= middle && middle <= box[2 * k + 1])) return -1;
  }
  return hypot(c[0][0] - c[1][0], c[0][1] - c[1][1]);
}

double dyd_view_median(double *length, size_t n) {
  qsort(length, n, sizeof *length, dyd_compare_double);
  return n && isfinite(length[n / 2]) ? length[n / 2] : 0;
}

static double spacing_of(const dyd_delaunay *pd, const dyd_pair_list *pairs, const double box[4]) {
  enum { SAMPLES = 1000 };
  double length[SAMPLES];
  size_t n = 0, inside = 0, seen = 0;
  for (size_t k = 0; box && k < pairs->count; k++) inside += pair_length(pd, &pairs->item[k], box) >= 0;
  size_t step = (box ? inside : pairs->count) / SAMPLES + 1;
  for (size_t k = 0; k < pairs->count; k += box ? 1 : step) {
    double one = pair_length(pd, &pairs->item[k], box);
    if (one >= 0 && (!box || seen++ % step == 0)) length[n++] = one;
  }
  return dyd_view_median(length, n);
}

double dyd_view_spacing(const dyd_delaunay *pd, const dyd_pair_list *pairs, const double box[4]) {
  dyd_pair_list own = {0};
  if (pairs) return spacing_of(pd, pairs, box);
  if (dyd_delaunay_pairs(&own, pd) != DYD_OK) return 0;
  double spacing = spacing_of(pd, &own, box);
  dyd_pair_list_clear(&own);
  return spacing;
}

double dyd_view_x(const dyd_view *v, double x) {
  return (x - v->left) * v->scale + DYD_VIEW_LEFT;
}
double dyd_view_y(const dyd_view *v, double y) {
  return (v->top - y) * v->scale + EDGE;
}

void dyd_view_middle(double z[2], const dyd_view *v, const double box[4]) {
  z[0] = dyd_view_x(v, box[0] / 2 + box[1] / 2);
  z[1] = dyd_view_y(v, box[2] / 2 + box[3] / 2);
}

bool dyd_view_sees(const dyd_view *v, const double box[4]) {
  const double *f = v->frame;
  return dyd_view_x(v, box[0]) <= f[1] && f[0] <= dyd_view_x(v, box[1]) && dyd_view_y(v, box[3]) <= f[3] &&
         f[2] <= dyd_view_y(v, box[2]);
}

void dyd_view_frame_path(dyd_canvas *c, const dyd_view *v) {
  dyd_canvas_box(c, v->frame[0], v->frame[2], v->frame[1] - v->frame[0], v->frame[3] - v->frame[2]);
}
