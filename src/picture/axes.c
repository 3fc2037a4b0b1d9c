/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Coordinates along the frame of a view: ticks at round numbers. */
#include "picture/picture.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

#define SIZE 12
#define WIDEST 240.0 /* between ticks along x; along y there is more room for labels */
#define HIGHEST 140.0
#define LONGEST 80.0 /* a label wider than this says by how much it differs from the first */

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

static bool find_ticks(ticks *t, double low, double high, double most) {
  if (!dyd_round_step(&t->digit, &t->exponent, most)) return false;
  double step = t->digit * pow(10, t->exponent);
  if (!(fabs(low) / step < 4e15 && fabs(high) / step < 4e15)) return false;
  t->first = (int64_t)ceil(low / step);
  t->last = (int64_t)floor(high / step);
  return t->last - t->first < 40;
}

/* Whole numbers where they are short, else by how much they differ from the first. */
static void tick_label(char *out, size_t size, dyd_canvas *c, const ticks *t, int64_t n) {
  dyd_tick_text(out, size, n * t->digit, t->exponent);
  if (n == t->first || dyd_canvas_width(c, SIZE, out) <= LONGEST) return;
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
  if (!find_ticks(&t, low, high, (vertical ? HIGHEST : WIDEST) / v->scale)) return;
  double step = t.digit * pow(10, t.exponent);
  for (int64_t n = t.first; n <= t.last; n++) {
    tick_label(label, sizeof label, c, &t, n);
    double at = vertical ? dyd_view_y(v, (double)n * step) : dyd_view_x(v, (double)n * step);
    if (vertical) {
      draw_tick(c, f[0], at, -5, 0);
      bool wide = dyd_canvas_width(c, SIZE, label) > LONGEST; /* it begins at the rim of the page */
      dyd_canvas_text(c, wide ? 4 : f[0] - 8, wide ? at - 6 : at + 4, wide ? 0 : 1, SIZE, wide, label);
    } else {
      draw_tick(c, at, f[3], 0, 5);
      dyd_canvas_text(c, at, f[3] + 18, 0.5, SIZE, false, label);
    }
  }
}

void dyd_axes_draw(dyd_canvas *c, const dyd_view *v) {
  const double *f = v->frame;
  dyd_view_frame_path(c, v);
  dyd_picture_stroke(c, 0x222222, 1, 0, 0);
  double left = v->left + (f[0] - DYD_VIEW_LEFT) / v->scale, top = v->top - (f[2] - DYD_VIEW_EDGE) / v->scale;
  axis_along(c, v, left, left + (f[1] - f[0]) / v->scale, false);
  axis_along(c, v, top - (f[3] - f[2]) / v->scale, top, true);
}
