/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How many lines cross each small square of the page: what is shown in place of lines that would be one mass. Where
 * only full squares are drawn, lines that are in such squares alone are left out, and so is what they would hide. */
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>

#define SQUARE 4.0
#define MANY 5 /* lines in a square that are seen as a mass */

/* From light to dark, also on a grey copy; squares of fewer lines than the first says are not drawn. */
struct dyd_density_levels {
  size_t count;
  struct {
    uint32_t from;
    unsigned rgb;
    const char *text;
  } level[6];
};
const dyd_density_levels dyd_density_all = {6,
                                            {{1, 0xfdeedd, "1"},
                                             {2, 0xfbd4a8, "2-3"},
                                             {4, 0xf5b47a, "4-9"},
                                             {10, 0xe08a4a, "10-29"},
                                             {30, 0xb65f24, "30-99"},
                                             {100, 0x8c3d00, "more"}}};
const dyd_density_levels dyd_density_full = {5,
                                             {{10, 0x9cc8e2, "10-29"},
                                              {30, 0x5aa5d0, "30-99"},
                                              {100, 0x0072b2, "100-299"},
                                              {300, 0x004f7d, "300-999"},
                                              {1000, 0x002c46, "more"}}};
const dyd_density_levels dyd_density_full_grey = {5,
                                                  {{10, 0xc4c4c4, "10-29"},
                                                   {30, 0x9c9c9c, "30-99"},
                                                   {100, 0x6b6b6b, "100-299"},
                                                   {300, 0x454545, "300-999"},
                                                   {1000, 0x222222, "more"}}};

bool dyd_density_init(dyd_density *d, const dyd_view *v, const dyd_density_levels *levels) {
  d->view = v;
  d->levels = levels;
  d->columns = (size_t)((v->frame[1] - v->frame[0]) / SQUARE) + 1;
  d->rows = (size_t)((v->frame[3] - v->frame[2]) / SQUARE) + 1;
  d->count = calloc(d->columns * d->rows, sizeof *d->count);
  return d->count != NULL;
}

void dyd_density_clear(dyd_density *d) {
  free(d->count);
  d->count = NULL;
}

void dyd_density_begin(dyd_density *d) {
  d->last = SIZE_MAX;
}

void dyd_density_add(dyd_density *d, double z[2][2]) {
  const double *f = d->view->frame;
  size_t steps = (size_t)(hypot(z[1][0] - z[0][0], z[1][1] - z[0][1]) / (SQUARE / 3)) + 1;
  for (size_t k = 0; k <= steps; k++) {
    double t = (double)k / (double)steps;
    double x = (z[0][0] + t * (z[1][0] - z[0][0]) - f[0]) / SQUARE;
    double y = (z[0][1] + t * (z[1][1] - z[0][1]) - f[2]) / SQUARE;
    if (!(x >= 0 && y >= 0 && x < (double)d->columns && y < (double)d->rows)) continue;
    size_t at = (size_t)y * d->columns + (size_t)x;
    if (at != d->last) d->count[at]++;
    d->last = at;
  }
}

bool dyd_density_is_crowded(const dyd_density *d) {
  size_t some = 0, many = 0;
  for (size_t k = 0; k < d->columns * d->rows; k++) {
    some += d->count[k] > 0;
    many += d->count[k] >= MANY;
  }
  return 6 * many > some;
}

/* 0: it is not drawn. */
static size_t density_level(const dyd_density *d, size_t square) {
  size_t k = d->levels->count;
  while (k > 0 && d->count[square] < d->levels->level[k - 1].from) k--;
  return k;
}

/* Square number of a position between the ends of the frame, of n squares. */
static size_t square_at(double z, double low, size_t n) {
  double at = (z - low) / SQUARE;
  return at <= 0 ? 0 : at >= (double)n ? n - 1 : (size_t)at;
}

bool dyd_density_covers(const dyd_density *d, const double box[4]) {
  enum { MOST_SQUARES = 256 };
  if (!d->count) return false;
  const double *f = d->view->frame;
  size_t x0 = square_at(box[0], f[0], d->columns), x1 = square_at(box[1], f[0], d->columns);
  size_t y0 = square_at(box[2], f[2], d->rows), y1 = square_at(box[3], f[2], d->rows);
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > MOST_SQUARES) return false;
  for (size_t y = y0; y <= y1; y++)
    for (size_t x = x0; x <= x1; x++)
      if (!density_level(d, y * d->columns + x)) return false;
  return true;
}

/* Is the upper half of a square left to `under`? */
static bool is_halved(const dyd_density *under, size_t square) {
  return under && under->count && density_level(under, square);
}

/* Squares side by side of one level are one box. */
bool dyd_density_draw(dyd_canvas *c, const dyd_density *d, const dyd_density *under) {
  bool drawn = false;
  if (!d->count) return false;
  const double *f = d->view->frame;
  for (size_t level = 1; level <= d->levels->count; level++) {
    bool any = false;
    for (size_t y = 0; y < d->rows; y++)
      for (size_t x = 0, end; x < d->columns; x = end) {
        size_t row = y * d->columns, here = density_level(d, row + x);
        bool half = is_halved(under, row + x);
        for (end = x + 1; end < d->columns && density_level(d, row + end) == here;) {
          if (is_halved(under, row + end) != half) break;
          end++;
        }
        if (here != level) continue;
        dyd_canvas_box(c, f[0] + SQUARE * (double)x, f[2] + SQUARE * ((double)y + (half ? 0.5 : 0)),
                       SQUARE * (double)(end - x), half ? SQUARE / 2 : SQUARE);
        any = true;
      }
    if (any) dyd_picture_fill(c, d->levels->level[level - 1].rgb);
    drawn = drawn || any;
  }
  return drawn;
}

void dyd_density_legend(dyd_legend *l, const dyd_density *d, const char *what) {
  bool seen[sizeof d->levels->level / sizeof *d->levels->level + 1] = {false}, first = true;
  char text[120];
  for (size_t k = 0; d->count && k < d->columns * d->rows; k++) seen[density_level(d, k)] = true;
  for (size_t level = 1; d->count && level <= d->levels->count; level++) {
    if (!seen[level]) continue;
    snprintf(text, sizeof text, "%s%s", d->levels->level[level - 1].text, first ? what : "");
    dyd_legend_patch(l, d->levels->level[level - 1].rgb, text);
    first = false;
  }
}
