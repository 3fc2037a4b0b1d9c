/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Views: which part of the plane a picture shows, where it is on the page; coordinates along its frame; cutting to it.
 *
 * Positions far outside of a page do not fit the numbers that cairo draws with: they would come back from the other
 * side. So lines and convex polygons are cut to a box before they are drawn. The box is an intersection of four
 * half-planes; cutting by one after the other keeps segments segments and convex polygons convex. */
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "io/diagram.h"
#include "picture/picture.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 1000.0 /* of the drawing */
#define EDGE DYD_VIEW_EDGE
#define SIZE 12
#define WIDEST 240.0 /* between ticks along x; along y there is more room for labels */
#define HIGHEST 140.0
#define LONGEST 80.0 /* a label wider than this says by how much it differs from the first */

/* ---- the part shown ---- */

static dyd_status beyond_doubles(dyd_error *err) {
  return dyd_fail(err, DYD_E_RANGE, "the points are too far apart or too close for a picture; use csv or json");
}

void dyd_view_hold(double box[4], const double b[4]) {
  for (int k = 0; k < 4; k++) box[k] = k & 1 ? fmax(box[k], b[k]) : fmin(box[k], b[k]);
}

dyd_status dyd_view_grow(double box[4], const dyd_rect *r, dyd_error *err) {
  double b[4];
  dyd_rect_get_d(b, r);
  if (!dyd_box_is_finite(b)) return beyond_doubles(err);
  dyd_view_hold(box, b);
  return DYD_OK;
}

dyd_status dyd_view_window(double box[4], const dyd_rect *window, dyd_error *err) {
  dyd_rect_get_d(box, window);
  return box[0] < box[1] && box[2] < box[3] ? DYD_OK : dyd_fail(err, DYD_E_ARG, "the window has no area");
}

/* A box not wider than the rounding of doubles becomes its middle: it is a point that is not a double. */
static void box_collapse(double box[4]) {
  double size = fmax(box[1] - box[0], box[3] - box[2]), far = 0;
  for (int k = 0; k < 4; k++) far = fmax(far, fabs(box[k]));
  if (!(size <= 0x1p-50 * far)) return;
  for (int k = 0; k < 4; k += 2) box[k] = box[k + 1] = box[k] / 2 + box[k + 1] / 2;
}

void dyd_view_pad(double box[4]) {
  box_collapse(box);
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
  v->epsg = 0;
  v->frame[0] = DYD_VIEW_LEFT, v->frame[2] = EDGE;
  v->frame[1] = DYD_VIEW_LEFT + v->width, v->frame[3] = EDGE + v->height;
  return DYD_OK;
}

static dyd_status view_all(dyd_view *v, const dyd_result *r, const dyd_pair_list *pairs, dyd_error *err) {
  double all[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t i = 0; i < r->count; i++) {
    double b[4];
    dyd_status st = dyd_result_box(b, r, i, err);
    if (st != DYD_OK) return st;
    dyd_view_hold(all, b);
  }
  if (r->count == 0) all[0] = all[1] = all[2] = all[3] = 0;
  box_collapse(all);
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
  DYD_SCOPED(dyd_pair_list) own = {0};
  if (pairs) return spacing_of(pd, pairs, box);
  if (dyd_delaunay_pairs(&own, pd) != DYD_OK) return 0;
  return spacing_of(pd, &own, box);
}

dyd_status dyd_view_of(dyd_view *v, const dyd_output *o, const dyd_pair_list *pairs) {
  const dyd_result *r = o->what;
  double box[4];
  dyd_status st = r->window ? dyd_view_window(box, r->window, o->err) : view_all(v, r, pairs, o->err);
  if (st == DYD_OK && r->window) st = dyd_view_fit(v, box, dyd_view_spacing(r->pd, pairs, box), o->err);
  v->epsg = o->epsg;
  v->discs = r->discs;
  return st;
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

void dyd_picture_box(dyd_canvas *c, const dyd_view *v, const double b[4]) {
  dyd_canvas_box(c, dyd_view_x(v, b[0]), dyd_view_y(v, b[3]), (b[1] - b[0]) * v->scale, (b[3] - b[2]) * v->scale);
}

void dyd_view_frame_path(dyd_canvas *c, const dyd_view *v) {
  dyd_canvas_box(c, v->frame[0], v->frame[2], v->frame[1] - v->frame[0], v->frame[3] - v->frame[2]);
}

/* ---- coordinates ---- */

bool dyd_round_step(int *digit, int *exponent, double most) {
  static const int digits[] = {5, 2, 1};
  if (!(most > 1e-300) || !isfinite(most)) return false;
  *exponent = (int)floor(log10(most));
  for (int k = 0; k < 3; k++) {
    *digit = digits[k];
    if (*digit * pow(10, *exponent) <= most) return true;
  }
  *exponent -= 1; /* log10 was rounded up */
  *digit = 5;
  return true;
}

void dyd_tick_text(char *out, size_t size, int64_t n, int exponent) {
  char digits[24];
  while (n && n % 10 == 0) n /= 10, exponent++;
  snprintf(digits, sizeof digits, "%" PRId64, n < 0 ? -n : n);
  const char *sign = n < 0 ? "-" : "";
  int count = (int)strlen(digits), point = count + exponent;
  if (n == 0)
    snprintf(out, size, "0");
  else if (exponent >= 0 && point <= 7)
    snprintf(out, size, "%s%s%.*s", sign, digits, exponent, "000000");
  else if (exponent < 0 && point > 0)
    snprintf(out, size, "%s%.*s.%s", sign, point, digits, digits + point);
  else if (exponent < 0 && point > -4)
    snprintf(out, size, "%s0.%.*s%s", sign, -point, "0000", digits);
  else
    snprintf(out, size, "%s%se%d", sign, digits, exponent);
}

/* The ticks along one side: n * digit * 10^exponent for n = first .. last. */
typedef struct ticks {
  int digit, exponent;
  int64_t first, last;
} ticks;

/* Degrees of a sphere have ticks at multiples of 30, as its graticule, instead of 50. */
static bool find_ticks(ticks *t, double low, double high, double most, bool sphere) {
  if (!dyd_round_step(&t->digit, &t->exponent, most)) return false;
  if (sphere && t->digit == 5 && t->exponent == 1) t->digit = 3;
  double step = t->digit * pow(10, t->exponent);
  if (!(fabs(low) / step < 4e15 && fabs(high) / step < 4e15)) return false;
  t->first = (int64_t)ceil(low / step);
  t->last = (int64_t)floor(high / step);
  return t->last - t->first < 40;
}

/* Whole numbers where they are short, else by how much they differ from the first. */
static void tick_label(char *out, size_t size, dyd_canvas *c, const ticks *t, int64_t n) {
  dyd_tick_text(out, size, n * t->digit, t->exponent);
  if (n == t->first || dyd_canvas_width(c, SIZE, out) <= LONGEST * c->text) return;
  *out = '+';
  dyd_tick_text(out + 1, size - 1, (n - t->first) * t->digit, t->exponent);
}

static void draw_tick(dyd_canvas *c, double x, double y, double across, double down) {
  double z[2][2] = {{x, y}, {x + across, y + down}};
  dyd_picture_line(c, z, 0x222222, 1, 0, 0);
}

static void axis_along(dyd_canvas *c, const dyd_view *v, double low, double high, bool vertical) {
  const double *f = v->frame;
  char label[48];
  ticks t;
  if (!find_ticks(&t, low, high, (vertical ? fmax(HIGHEST, 30 * c->text) : fmax(WIDEST, 100 * c->text)) / v->scale,
                  v->unit))
    return;
  double step = t.digit * pow(10, t.exponent);
  for (int64_t n = t.first; n <= t.last; n++) {
    tick_label(label, sizeof label, c, &t, n);
    double at = vertical ? dyd_view_y(v, (double)n * step) : dyd_view_x(v, (double)n * step);
    if (vertical) {
      draw_tick(c, f[0], at, -5, 0);
      bool wide = dyd_canvas_width(c, SIZE, label) > LONGEST * c->text; /* it begins at the rim of the page */
      dyd_canvas_text(c, wide ? c->box[0] + 4 : f[0] - 8, wide ? at - 6 : at + 4 * c->text, wide ? 0 : 1, SIZE, wide,
                      label);
    } else {
      draw_tick(c, at, f[3], 0, 5);
      dyd_canvas_text(c, at, f[3] + 5 + 13 * c->text, 0.5, SIZE, false, label);
    }
  }
}

void dyd_view_axes(dyd_canvas *c, const dyd_view *v) {
  const double *f = v->frame;
  dyd_view_frame_path(c, v);
  dyd_picture_stroke(c, 0x222222, 1, 0, 0);
  double left = v->left + (f[0] - DYD_VIEW_LEFT) / v->scale, top = v->top - (f[2] - DYD_VIEW_EDGE) / v->scale;
  double low = top - (f[3] - f[2]) / v->scale, pole = v->unit ? 90 : INFINITY; /* only degrees of a sphere are named */
  axis_along(c, v, left, left + (f[1] - f[0]) / v->scale, false);
  axis_along(c, v, fmax(low, -pole), fmin(top, pole), true);
}

/* ---- cutting ---- */

/* How far z is inside of side k of the box. */
static double clip_depth(const double z[2], const double box[4], int k) {
  double inside = z[k >> 1] - box[k];
  return k & 1 ? -inside : inside;
}

/* Where pq, of depths a and b of different signs, meets side k. */
static void clip_meet(double out[2], const double p[2], const double q[2], double a, double b, const double box[4],
                      int k) {
  int along = 1 - (k >> 1);
  double at = p[along] + a / (a - b) * (q[along] - p[along]);
  out[k >> 1] = box[k];
  out[along] = at;
}

bool dyd_clip_segment(double z[2][2], const double box[4]) {
  for (int k = 0; k < 4; k++) {
    double a = clip_depth(z[0], box, k), b = clip_depth(z[1], box, k);
    if (a < 0 && b < 0) return false;
    if (a < 0 || b < 0) clip_meet(z[a < 0 ? 0 : 1], z[0], z[1], a, b, box, k);
  }
  return true;
}

int dyd_clip_convex(double z[DYD_CLIP_MOST][2], int n, const double box[4]) {
  double kept[DYD_CLIP_MOST][2];
  for (int k = 0; k < 4 && n > 0; k++) {
    int count = 0;
    for (int c = 0; c < n; c++) {
      const double *p = z[c], *q = z[c + 1 < n ? c + 1 : 0];
      double a = clip_depth(p, box, k), b = clip_depth(q, box, k);
      if (a >= 0 && count < DYD_CLIP_MOST) memcpy(kept[count++], p, sizeof kept[0]);
      if ((a >= 0) != (b >= 0) && count < DYD_CLIP_MOST) clip_meet(kept[count++], p, q, a, b, box, k);
    }
    memcpy(z, kept, (size_t)count * sizeof kept[0]);
    n = count;
  }
  return n;
}
