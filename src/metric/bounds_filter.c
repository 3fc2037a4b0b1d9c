/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Upper bounds in doubles that spare the exact work for pairs that do not count.
 *
 * Squared distances are bounded as in [FLT-DST]; square roots, sums, products and quotients of those carry at most 12
 * relative errors u = 2^-53, and the factor 1 + 32 u covers them. Quotients below are taken only of denominators of at
 * least 2^-300, so that underflow cannot make a bound too small by more than DYD_TINY, which is added. */
#include "metric/bounds_filter.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "metric/bounds.h"
#include "rect/rect.h"
#include "skeleton/rects_filter.h"
#include "tolerance/discs.h"

#include <math.h>

/* ---- the second point of a cell, by boxes that cover it ----
 *
 * A box is dropped when some C_ki holds its corners, hence all of it, so that i is possible nowhere in it, or when dl_i
 * is below all other ds there, so that it is in Int_i. In a box that stays, each dl is at most its largest value, which
 * gives a bound; boxes are cut while they are large for that. Squares are bounded by [FLT-DST]; their root carries
 * three relative errors more, which SAFE covers. */

#define SAFE (1 + 32 * 0x1p-53)

/* So often a box is halved; it is small for its value when it is FINER times smaller. */
enum { DEPTH = 120, FINER = 16 };

/* cancel: the search ends once it is set. box[own]: the rectangle of the site; best: the square of the bound so far,
 * most: of those worth looking for; far: room for one number a box. */
typedef struct second_search {
  dyd_bbox *box;
  size_t count, own;
  double best, most, *far;
  const volatile int *cancel;
} second_search;

/* Returns true if some other site is certainly nearer in all of c: c is outside of Pos_i. */
static bool second_is_outside(const second_search *s, const dyd_bbox *c) {
  double near[4], far[4];
  dyd_corners_near(near, c, &s->box[s->own]);
  for (size_t k = 0; k < s->count; k++) {
    dyd_corners_far(far, c, &s->box[k]);
    if (dyd_corners_block(far, near)) return true;
  }
  return false;
}

static bool second_is_inside(const second_search *s, const dyd_bbox *c) {
  double most = dyd_dl2_upper(c, &s->box[s->own]);
  for (size_t k = 0; k < s->count; k++)
    if (k != s->own && !(most < dyd_ds2_lower(c, &s->box[k]))) return false;
  return true;
}

/* The least far[] of a rectangle disjoint from box[from]; *with: which. */
static double second_least(size_t *with, const second_search *s, size_t from) {
  double least = HUGE_VAL;
  for (size_t k = 0; k < s->count; k++)
    if (s->far[k] < least && dyd_boxes_disjoint(&s->box[from], &s->box[k])) least = s->far[k], *with = k;
  return least;
}

/* A box, and of the largest dl^2 over it: of the nearest one and the next that is disjoint from it; two points that
 * differ, none of them farther. pair: the two sites that give it, or one that is disjoint from the own, twice. */
typedef struct second_box {
  dyd_bbox c;
  double value;
  size_t pair[2];
} second_box;

static void second_find_value(second_box *b, const second_search *s) {
  size_t nearest = 0, own_with = s->own, with = s->own;
  for (size_t k = 0; k < s->count; k++) {
    s->far[k] = dyd_dl2_upper(&b->c, &s->box[k]);
    if (s->far[k] < s->far[nearest]) nearest = k;
  }
  double own = second_least(&own_with, s, s->own), least = second_least(&with, s, nearest);
  b->value = dyd_min(own, least);
  b->pair[0] = own < least ? own_with : nearest;
  b->pair[1] = own < least ? own_with : with;
}

/* One half of a box. The pair of the whole suffices where it shows that the half does not count. */
static void second_set_half(second_box *b, const second_box *whole, const second_search *s, int end, double at) {
  *b = *whole;
  b->c.e[end] = at;
  b->value = dyd_max(dyd_dl2_upper(&b->c, &s->box[b->pair[0]]), dyd_dl2_upper(&b->c, &s->box[b->pair[1]]));
  if (!(whole->value < HUGE_VAL && b->value <= s->best)) second_find_value(b, s);
}

/* The longer side is halved, so boxes stay about as high as wide, however long W is: along a strip there are about
 * FINER of them each time the distance from the site doubles. The half of the larger value comes first: it often shows
 * that the other one does not count. */
static void second_visit(second_search *s, const second_box *b, int depth) {
  const dyd_bbox *c = &b->c;
  double width = c->e[1] - c->e[0], height = c->e[3] - c->e[2];
  if (s->best > s->most || b->value <= s->best || second_is_outside(s, c) || second_is_inside(s, c)) return;
  if (dyd_flag_is_set(s->cancel)) {
    s->best = HUGE_VAL;
    return;
  }
  if (depth == 0 || !(FINER * FINER * (width * width + height * height) > b->value)) {
    s->best = b->value;
    return;
  }
  int axis = height > width ? 2 : 0;
  double middle = c->e[axis] / 2 + c->e[axis + 1] / 2;
  second_box half[2];
  for (int k = 0; k < 2; k++) second_set_half(&half[k], b, s, axis + 1 - k, middle);
  int first = half[1].value > half[0].value;
  second_visit(s, &half[first], depth - 1);
  second_visit(s, &half[1 - first], depth - 1);
}

/* *c = a box round { dl_i <= reach } n W; false: none of finite ends. */
static bool second_start(dyd_bbox *c, const dyd_bbox *own, const dyd_rect *window, double reach) {
  dyd_interval_get_d(&c->e[0], &c->e[1], &window->x);
  dyd_interval_get_d(&c->e[2], &c->e[3], &window->y);
  for (int k = 0; k < 4; k += 2) {
    c->e[k] = dyd_max(c->e[k], nextafter(own->e[k + 1] - reach, -HUGE_VAL));
    c->e[k + 1] = dyd_min(c->e[k + 1], nextafter(own->e[k] + reach, HUGE_VAL));
    if (!(c->e[k] >= -DBL_MAX && c->e[k + 1] <= DBL_MAX)) return false;
  }
  return true;
}

dyd_status dyd_filter_second(double *out, const dyd_voronoi_sums *sums, uint32_t i, double enough) {
  dyd_index_list near = {0};
  second_box b;
  dyd_status st = dyd_delaunay_neighbours(&near, sums->pd, i, dyd_least_bounding(sums->pd));
  if (st != DYD_OK) return st;
  double most = sums->most * sums->most, begin = dyd_min(enough * enough * (1 - 0x1p-50), most);
  second_search s = {.count = near.count + 1, .own = near.count, .best = begin, .most = most, .cancel = sums->cancel};
  s.box = dyd_alloc(s.count, sizeof *s.box);
  s.far = dyd_alloc(s.count, sizeof *s.far);
  if (s.box && s.far) {
    for (size_t k = 0; k < s.count; k++)
      dyd_measure_box(s.box[k].e, dyd_delaunay_sites(sums->pd), k == s.own ? i : near.item[k], sums->discs);
    *out = HUGE_VAL;
    if (second_start(&b.c, &s.box[s.own], sums->window, sums->reach[i])) {
      second_find_value(&b, &s);
      second_visit(&s, &b, DEPTH);
      if (!(s.best > s.most)) *out = s.best > begin ? sqrt(s.best) * SAFE : enough;
    }
  }
  dyd_index_list_clear(&near);
  st = s.box && s.far ? DYD_OK : DYD_E_NOMEM;
  dyd_free_all(s.box, s.far);
  return st;
}

void dyd_measure_box(double out[4], const dyd_sites *sites, uint32_t i, bool discs) {
  dyd_sites_get_d(out, sites, i);
  if (!discs) return;
  DYD_LOCAL(dyd_disc, d);
  bool good = dyd_disc_of_site(&d, sites, i) == DYD_OK;
  for (int k = 0; k < 4 && good; k++) {
    mpq_ptr c = k < 2 ? d.x : d.y;
    (k & 1 ? mpq_add : mpq_sub)(c, c, d.r);
    out[k] = nextafter(mpq_get_d(c), k & 1 ? INFINITY : -INFINITY); /* mpq_get_d cuts off */
    (k & 1 ? mpq_sub : mpq_add)(c, c, d.r);
  }
}

double dyd_filter_reach_of_shape(const dyd_shape *s, const double box[4]) {
  dyd_bbox own = {{box[0], box[1], box[2], box[3]}};
  double most = -1;
  if (s->in_doubles) {
    for (uint32_t k = 0; k < s->outer_count; k++) {
      dyd_bbox c = {{s->outer[k].x, s->outer[k].x, s->outer[k].y, s->outer[k].y}};
      most = dyd_max(most, dyd_dl2_upper(&c, &own));
    }
    return most < 0 ? most : sqrt(most) * SAFE;
  }
  for (size_t p = 0; p < s->outer_exact.count; p++)
    for (size_t k = 0; k < s->outer_exact.item[p].count; k++) {
      dyd_bbox c = dyd_point_box(&s->outer_exact.item[p].vertex[k]);
      double d = dyd_dl2_upper(&c, &own);
      most = d <= DBL_MAX ? dyd_max(most, d) : HUGE_VAL;
    }
  return most < 0 ? most : sqrt(most) * SAFE;
}

static double box_diameter_upper(const double a[4]) {
  double x = a[1] - a[0], y = a[3] - a[2];
  return sqrt(dyd_upper(x * x + y * y)) * SAFE;
}

void dyd_filter_proved_reach(double r[2], const double a[4], const double b[4]) {
  double most = dyd_max(r[0], r[1]);
  if (most >= 0) most = nextafter(most + nextafter(box_diameter_upper(a) + box_diameter_upper(b), HUGE_VAL), HUGE_VAL);
  r[0] = r[1] = most;
}

double dyd_filter_voronoi_pair(const double a[4], const double b[4], double ra, double rb) {
  dyd_bbox p = {{a[0], a[1], a[2], a[3]}}, q = {{b[0], b[1], b[2], b[3]}};
  double gap = dyd_ds2_lower(&p, &q); /* over centres in p: the distance of the boxes */
  if (!(gap >= 0x1p-600)) return HUGE_VAL;
  double value = (box_diameter_upper(a) + box_diameter_upper(b)) * (ra + rb) / (2 * sqrt(gap)) * SAFE + DYD_TINY;
  return value <= DBL_MAX ? value : HUGE_VAL;
}

double dyd_filter_extent(bool *disjoint, const dyd_sites *s, const dyd_rect *window) {
  double all[4], most_lo[2] = {-HUGE_VAL, -HUGE_VAL}, least_hi[2] = {HUGE_VAL, HUGE_VAL};
  dyd_interval_get_d(&all[0], &all[1], &window->x);
  dyd_interval_get_d(&all[2], &all[3], &window->y);
  size_t n = dyd_sites_count(s);
  for (size_t i = 0; i < n; i++) {
    double b[4];
    dyd_sites_get_d(b, s, i);
    for (int axis = 0; axis < 2; axis++) {
      all[2 * axis] = dyd_min(all[2 * axis], b[2 * axis]);
      all[2 * axis + 1] = dyd_max(all[2 * axis + 1], b[2 * axis + 1]);
      most_lo[axis] = dyd_max(most_lo[axis], b[2 * axis]);
      least_hi[axis] = dyd_min(least_hi[axis], b[2 * axis + 1]);
    }
  }
  *disjoint = most_lo[0] > least_hi[0] || most_lo[1] > least_hi[1];
  return box_diameter_upper(all);
}
