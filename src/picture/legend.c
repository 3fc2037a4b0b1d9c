/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Legends: what colours and lines mean, how long a length is, where the points are when they are too close to see.
 *
 * And how many lines cross each small square of the page: squares are shown instead of lines that would be one mass.
 * Where only full squares are drawn, lines and marks inside of them are omitted. */
#include "picture/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- squares ---- */

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

/* Returns true if the upper half of a square is left to `under`. */
static bool is_halved(const dyd_density *under, size_t square) {
  return under && under->count && density_level(under, square);
}

/* Squares side by side of one level are one box. */
static bool density_draw(dyd_canvas *c, const dyd_density *d, const dyd_density *under) {
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

/* ---- entries ---- */

#define SIZE 14.0
#define ROW 22.0
#define AXIS 46.0 /* from the frame to the middle of the first row */

const char *dyd_unit_of(unsigned epsg) {
  static const unsigned degrees[] = {4326, 4258, 4267, 4269};
  /* First and last. UTM: ED50, ETRS89, NAD83, GDA94, GDA2020, WGS 84; Web Mercator, Europe, and national grids. */
  static const unsigned metres[][2] = {{23028, 23038}, {25828, 25838}, {26901, 26923}, {28348, 28358}, {7846, 7859},
                                       {32601, 32660}, {32701, 32760}, {3857, 3857},   {3034, 3035},   {2056, 2056},
                                       {21781, 21781}, {27700, 27700}, {2154, 2154},   {28992, 28992}, {31370, 31370},
                                       {2193, 2193},   {3006, 3006},   {2180, 2180},   {3067, 3067},   {5514, 5514},
                                       {31254, 31259}, {31466, 31469}};
  for (size_t k = 0; k < sizeof degrees / sizeof *degrees; k++)
    if (degrees[k] == epsg) return "degree";
  for (size_t k = 0; k < sizeof metres / sizeof *metres; k++)
    if (metres[k][0] <= epsg && epsg <= metres[k][1]) return "m";
  return NULL;
}

/* "1 unit of EPSG:2263", "200 m (EPSG:25832)", "30 degrees". */
static void length_text(char *out, size_t size, const char *number, const dyd_view *v) {
  const char *unit = v->unit ? v->unit : dyd_unit_of(v->epsg), *plural = strcmp(number, "1") == 0 ? "" : "s";
  char of[40] = "";
  if (v->epsg) snprintf(of, sizeof of, unit ? " (EPSG:%u)" : " of EPSG:%u", v->epsg);
  snprintf(out, size, "%s %s%s%s", number, unit ? unit : "unit", unit && strcmp(unit, "m") == 0 ? "" : plural,
           unit || v->epsg ? of : " of the coordinates");
}

/* A bar of round length, at the right end. */
static void legend_bar(dyd_legend *l) {
  const dyd_view *v = l->view;
  int digit, exponent;
  double right = DYD_VIEW_LEFT + v->width, y = l->y;
  l->bar = right;
  if (!dyd_round_step(&digit, &exponent, 0.2 * v->width / v->scale)) return;
  char number[48], text[128];
  dyd_tick_text(number, sizeof number, digit, exponent);
  length_text(text, sizeof text, number, v);
  double left = right - digit * pow(10, exponent) * v->scale;
  double line[3][2][2] = {{{left, y - 4}, {left, y + 4}}, {{left, y}, {right, y}}, {{right, y - 4}, {right, y + 4}}};
  for (int k = 0; k < 3; k++) dyd_picture_line(l->canvas, line[k], 0x222222, 1.5, 0, 0);
  dyd_canvas_text(l->canvas, right, y + 20 * l->canvas->text, 1, SIZE, false, text);
  l->bar = fmin(left, right - dyd_canvas_width(l->canvas, SIZE, text));
}

void dyd_legend_begin(dyd_legend *l, dyd_canvas *c, const dyd_view *v) {
  l->canvas = c;
  l->view = v;
  l->x = DYD_VIEW_LEFT;
  l->y = DYD_VIEW_EDGE + v->height + AXIS * c->text;
  legend_bar(l);
  /* Below the bar where it leaves less than half of the width. */
  if (l->bar < DYD_VIEW_LEFT + v->width / 2) l->y += 1.7 * ROW * c->text;
}

/* Where the row at hand ends: the first two leave room for the bar and its length. */
static double legend_right(const dyd_legend *l) {
  bool beside = l->y < DYD_VIEW_EDGE + l->view->height + (AXIS + 1.5 * ROW) * l->canvas->text;
  return beside ? l->bar - 20 : DYD_VIEW_LEFT + l->view->width;
}

/* Room for an entry as wide as that. */
static void legend_room(dyd_legend *l, double wide) {
  if (l->x == DYD_VIEW_LEFT || l->x + wide <= legend_right(l)) return;
  l->x = DYD_VIEW_LEFT;
  l->y += ROW * l->canvas->text;
}

/* The text next to the mark at l->x, of width `mark`. */
static void legend_words(dyd_legend *l, double mark, const char *text) {
  dyd_canvas_text(l->canvas, l->x + mark + 6 * l->canvas->text, l->y + 5 * l->canvas->text, 0, SIZE, false, text);
  l->x += mark + 30 * l->canvas->text + dyd_canvas_width(l->canvas, SIZE, text);
}

static double entry_width(dyd_legend *l, double mark, const char *text) {
  return mark + 6 * l->canvas->text + dyd_canvas_width(l->canvas, SIZE, text);
}

static void legend_line(dyd_legend *l, const dyd_picture_style *s, const char *text) {
  legend_room(l, entry_width(l, 30 * l->canvas->text, text));
  double z[2][2] = {{l->x, l->y}, {l->x + 30 * l->canvas->text, l->y}};
  dyd_picture_line(l->canvas, z, s->stroke, 2, s->on, s->off);
  legend_words(l, 30 * l->canvas->text, text);
}

static void legend_patch(dyd_legend *l, unsigned rgb, const char *text) {
  legend_room(l, entry_width(l, 30 * l->canvas->text, text));
  dyd_canvas_box(l->canvas, l->x, l->y - 7 * l->canvas->text, 30 * l->canvas->text, 14 * l->canvas->text);
  dyd_picture_shape(l->canvas, rgb, 1, 0x555555, 0.6);
  legend_words(l, 30 * l->canvas->text, text);
}

static void legend_dot(dyd_legend *l, const dyd_picture_style *s, const char *text) {
  legend_room(l, entry_width(l, 8 * l->canvas->text, text));
  dyd_canvas_circle(l->canvas, l->x + 4 * l->canvas->text, l->y, 3.5 * l->canvas->text);
  dyd_picture_shape(l->canvas, s->fill, 1, s->stroke == DYD_NO_COLOUR ? s->fill : s->stroke, 1.2);
  legend_words(l, 8 * l->canvas->text, text);
}

void dyd_legend_put(dyd_legend *legend, const dyd_picture_layer *l, const char *text) {
  if (l->key == DYD_KEY_LINE) legend_line(legend, &l->style, text);
  if (l->key == DYD_KEY_PATCH) legend_patch(legend, l->style.patch, text);
  if (l->key == DYD_KEY_DOT) legend_dot(legend, &l->style, text);
}

/* Squares of legal pairs that are drawn, too, are shared by both. */
void dyd_squares_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const dyd_density *d = p->pairs->dense;
  bool any = density_draw(p->canvas, &d[l->kind], l->kind == DYD_KIND_LEGAL ? NULL : &d[DYD_KIND_LEGAL]);
  if (any && l->kind != DYD_KIND_OPEN) p->pairs->full = true;
}

/* An entry for each level; behind the first how many pairs are counted. */
void dyd_squares_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  const dyd_density *d = &p->pairs->dense[l->kind];
  bool seen[sizeof d->levels->level / sizeof *d->levels->level + 1] = {false}, first = true;
  char text[120], of[100];
  snprintf(of, sizeof of, " of %zu %s pairs across a square", p->pairs->shown[l->kind], l->text);
  for (size_t k = 0; d->count && k < d->columns * d->rows; k++) seen[density_level(d, k)] = true;
  for (size_t level = 1; d->count && level <= d->levels->count; level++) {
    if (!seen[level]) continue;
    snprintf(text, sizeof text, "%s%s", d->levels->level[level - 1].text, first ? of : "");
    legend_patch(legend, d->levels->level[level - 1].rgb, text);
    first = false;
  }
}

void dyd_points_text(char *out, size_t size, size_t inside, size_t count, bool window) {
  if (window)
    snprintf(out, size, "%zu of %zu points (and the lines counted) in this window", inside, count);
  else
    snprintf(out, size, "%zu points", count);
}

/* How many characters of the text fit the line: up to a blank, or the end. `line` receives them. */
static size_t legend_fit(dyd_legend *l, char *line, size_t size, const char *text) {
  size_t fits = 0;
  for (size_t at = 0; at + 1 < size; at++) {
    line[at] = 0;
    if ((text[at] == ' ' || !text[at]) &&
        (!fits || dyd_canvas_width(l->canvas, SIZE, line) <= legend_right(l) - DYD_VIEW_LEFT))
      fits = at;
    if (!text[at]) break;
    line[at] = text[at];
  }
  line[fits] = 0;
  return fits;
}

void dyd_legend_text(dyd_legend *l, const char *text) {
  char line[400];
  if (l->x > DYD_VIEW_LEFT) l->x = DYD_VIEW_LEFT, l->y += ROW * l->canvas->text;
  for (size_t fits = 1; *text && fits > 0; text += *text == ' ') {
    text += fits = legend_fit(l, line, sizeof line, text);
    dyd_canvas_text(l->canvas, l->x, l->y + 5 * l->canvas->text, 0, SIZE, false, line);
    l->y += ROW * l->canvas->text;
  }
}

/* ---- a crowd ---- */

static bool is_in(const double box[4], const double b[4]) {
  double x = b[0] / 2 + b[1] / 2, y = b[2] / 2 + b[3] / 2;
  return box[0] <= x && x <= box[1] && box[2] <= y && y <= box[3];
}

/* The k-th of n doubles, which are moved: those before are not greater, those behind not less. */
static double legend_select(double *x, size_t n, size_t k) {
  for (size_t low = 0, high = n - 1; low < high;) {
    double pivot = x[low + (high - low) / 2];
    size_t i = low, j = high;
    for (;;) {
      while (x[i] < pivot) i++;
      while (pivot < x[j]) j--;
      if (i >= j) break;
      double swap = x[i];
      x[i++] = x[j];
      x[j--] = swap;
    }
    if (k <= j)
      high = j;
    else
      low = j + 1;
  }
  return x[k];
}

/* The middles of the sites seen, x first, then y, of room for all: how many. */
static size_t crowd_middles(double *x, double *y, const dyd_view *v, const dyd_sites_shown *m) {
  size_t count = 0;
  for (size_t i = 0; i < m->count; i++) {
    double b[4];
    if (!m->box(b, m->context, i) || !dyd_view_sees(v, b)) continue;
    x[count] = b[0] / 2 + b[1] / 2;
    y[count++] = b[2] / 2 + b[3] / 2;
  }
  return count;
}

/* The interval between the tenths of n coordinates, rounded outward and a little larger. `each` is sorted in part. */
static bool crowd_side(char text[2][48], double side[2], double *each, size_t n) {
  double low = legend_select(each, n, n / 10), high = legend_select(each, n, n - 1 - n / 10);
  double more = (high - low) / 8;
  int digit, exponent;
  if (!dyd_round_step(&digit, &exponent, more)) return false;
  double step = digit * pow(10, exponent), first = floor((low - more) / step), last = ceil((high + more) / step);
  if (!(fabs(first) < 1e14 && fabs(last) < 1e14)) return false;
  dyd_tick_text(text[0], 48, (int64_t)first * digit, exponent);
  dyd_tick_text(text[1], 48, (int64_t)last * digit, exponent);
  side[0] = first * step, side[1] = last * step;
  return true;
}

void dyd_legend_crowd(dyd_legend *l, const dyd_sites_shown *m) {
  const dyd_view *v = l->view;
  size_t inside = 0, seen = 0;
  double box[4], *each = malloc((m->count + 1) * 2 * sizeof *each);
  char end[4][48], text[400];
  size_t n = each ? crowd_middles(each, each + m->count, v, m) : 0;
  bool found = n >= 20 && crowd_side(end, box, each, n) && crowd_side(end + 2, box + 2, each + m->count, n);
  free(each);
  double area = (v->frame[1] - v->frame[0]) * (v->frame[3] - v->frame[2]) / v->scale / v->scale;
  if (!found || !((box[1] - box[0]) * (box[3] - box[2]) < 0.08 * area)) return;
  for (size_t i = 0; i < m->count; i++) {
    double b[4];
    if (!m->box(b, m->context, i) || !dyd_view_sees(v, b)) continue;
    seen++;
    inside += is_in(box, b);
  }
  snprintf(text, sizeof text, "%zu of these %zu points are in a small part of the picture: window %s,%s,%s,%s shows it",
           inside, seen, end[0], end[1], end[2], end[3]);
  dyd_legend_text(l, text);
}
