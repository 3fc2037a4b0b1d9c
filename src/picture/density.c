/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How many lines cross each small square of the page: what is shown in place of lines that would be one mass. */
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>

#define SQUARE 4.0
#define MANY 5 /* lines in a square that are seen as a mass */

bool dyd_density_init(dyd_density *d, const dyd_view *v) {
  d->view = v;
  d->columns = (size_t)((v->frame[1] - v->frame[0]) / SQUARE) + 1;
  d->rows = (size_t)((v->frame[3] - v->frame[2]) / SQUARE) + 1;
  d->count = calloc(d->columns * d->rows, sizeof *d->count);
  return d->count != NULL;
}

void dyd_density_clear(dyd_density *d) {
  free(d->count);
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

/* From light to dark, also on a grey copy. */
static const struct {
  uint32_t from;
  unsigned rgb;
  const char *text;
} levels[] = {{1, 0xfdeedd, "1"},      {2, 0xfbd4a8, "2-3"},    {4, 0xf5b47a, "4-9"},
              {10, 0xe08a4a, "10-29"}, {30, 0xb65f24, "30-99"}, {100, 0x8c3d00, "more"}};
enum { LEVELS = sizeof levels / sizeof *levels };

static unsigned density_level(uint32_t count) {
  unsigned k = LEVELS;
  while (k > 0 && count < levels[k - 1].from) k--;
  return k;
}

/* Squares side by side of one level are one box. */
void dyd_density_draw(dyd_canvas *c, const dyd_density *d) {
  const double *f = d->view->frame;
  for (unsigned level = 1; level <= LEVELS; level++) {
    bool any = false;
    for (size_t y = 0; y < d->rows; y++)
      for (size_t x = 0, end; x < d->columns; x = end) {
        const uint32_t *row = d->count + y * d->columns;
        for (end = x + 1; end < d->columns && density_level(row[end]) == density_level(row[x]);) end++;
        if (density_level(row[x]) != level) continue;
        dyd_canvas_box(c, f[0] + SQUARE * (double)x, f[2] + SQUARE * (double)y, SQUARE * (double)(end - x), SQUARE);
        any = true;
      }
    if (any) dyd_picture_fill(c, levels[level - 1].rgb);
  }
}

void dyd_density_legend(dyd_legend *l, const dyd_density *d, const char *what) {
  bool seen[LEVELS + 1] = {false};
  char text[120];
  for (size_t k = 0; k < d->columns * d->rows; k++) seen[density_level(d->count[k])] = true;
  bool first = true;
  for (unsigned level = 1; level <= LEVELS; level++) {
    if (!seen[level]) continue;
    snprintf(text, sizeof text, "%s%s", levels[level - 1].text, first ? what : "");
    dyd_legend_patch(l, levels[level - 1].rgb, text);
    first = false;
  }
}
