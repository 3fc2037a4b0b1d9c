/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation, in-circle and bounds of distances of skeleton/mesh_filter.h and rects_filter.h. */
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"
#include "vectors.h"

#include <math.h>

/* ---- signs ---- */

/* x[0]: the bound, or what belongs in its place; then x and y of points, the last one seen from. */
static dyd_xy point_of(const double *x, int k) {
  return (dyd_xy){x[2 * k + 1], x[2 * k + 2]};
}
static dyd_incircle incircle_of(const double *x) {
  return dyd_incircle_of(point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3));
}

static void ask_orient(answer *a, const double *x) {
  dyd_mesh m = {.orient_bound = x[0]};
  say_integer(a, dyd_filter_orient(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2)));
}
static void ask_turn(answer *a, const double *x) {
  dyd_mesh m = {.orient_bound = x[0]};
  say_integer(a, dyd_filter_turn(&m, x[1]));
}
static void ask_orient_near(answer *a, const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  say_integer(a, dyd_filter_orient_near(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2)));
}
static void ask_orient_small(answer *a, const double *x) {
  int sign;
  dyd_mesh m = {.exact_s = x[0]};
  if (dyd_filter_orient_small(&sign, &m, point_of(x, 0), point_of(x, 1), point_of(x, 2)))
    say_integer(a, sign);
  else
    say_none(a);
}
static void ask_incircle_at(answer *a, const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  say_integer(a, dyd_filter_incircle_at(&m, incircle_of(x)));
}
static void ask_incircle_near(answer *a, const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  say_integer(a, dyd_filter_incircle_near(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3)));
}
static void ask_incircle_small(answer *a, const double *x) {
  int sign;
  dyd_mesh m = {.exact_s = x[0]};
  if (dyd_filter_incircle_small(&sign, &m, incircle_of(x)))
    say_integer(a, sign);
  else
    say_none(a);
}

static void choose_bounded(double *x, unsigned inputs, const kind *k) {
  static const double deltas[] = {0, 0, 0x1p-60, 0x1p40, INFINITY};
  (void)inputs;
  (void)k;
  if (test_chance(&shared, 2))
    x[0] = deltas[test_below(&shared, 5)];
  else if (test_chance(&shared, 2))
    x[0] = ldexp(fabs(x[1]), -(int)test_below(&shared, 30));
}

static const function sign[] = {{"dyd_filter_orient", 7, ask_orient, choose_bounded, 12, 0},
                                {"dyd_filter_turn", 2, ask_turn, choose_bounded, 2, 0},
                                {"dyd_filter_orient_near", 7, ask_orient_near, choose_bounded, 12, 0},
                                {"dyd_filter_orient_small", 7, ask_orient_small, choose_bounded, 12, 0},
                                {"dyd_filter_incircle_at", 9, ask_incircle_at, choose_bounded, 12, 0},
                                {"dyd_filter_incircle_near", 9, ask_incircle_near, choose_bounded, 12, 0},
                                {"dyd_filter_incircle_small", 9, ask_incircle_small, choose_bounded, 12, 0}};

/* Two points whose products differ by so few last bits that the bound for three points alone has to tell. */
static void put_near_turn(void) {
  double bits = 5 + (double)test_below(&shared, 3),
         off = ldexp(test_unit(&shared) - 0.5, -(int)test_below(&shared, 30));
  double left = bits / 4.01 * (1 + off), side = test_chance(&shared, 2) ? 1 : -1;
  const double x[INPUTS] = {0, left, 1, left - side * bits * 0x1p-52, 1, 0, 0};
  put_vector(&sign[2], x);
}

/* ---- parts ---- */

static void say_seen(answer *a, dyd_seen s) {
  say_double(a, s.x);
  say_double(a, s.y);
  say_double(a, s.square);
}
static void say_incircle(answer *a, dyd_incircle i) {
  const double parts[6] = {i.la, i.lb, i.lc, i.bc, i.ca, i.ab};
  say_doubles(a, parts, 6);
}
static dyd_seen seen_at(const double *x, int k) {
  return dyd_see((dyd_xy){x[2 * k], x[2 * k + 1]}, (dyd_xy){0, 0});
}
static void ask_see(answer *a, const double *x) {
  say_seen(a, dyd_see((dyd_xy){x[0], x[1]}, (dyd_xy){x[2], x[3]}));
}
static void ask_seen_cross(answer *a, const double *x) {
  say_double(a, dyd_seen_cross(seen_at(x, 0), seen_at(x, 1)));
}
static void ask_incircle_from(answer *a, const double *x) {
  say_incircle(a, dyd_incircle_from(seen_at(x, 0), seen_at(x, 1), seen_at(x, 2)));
}
static void ask_incircle_of(answer *a, const double *x) {
  say_incircle(a,
               dyd_incircle_of((dyd_xy){x[0], x[1]}, (dyd_xy){x[2], x[3]}, (dyd_xy){x[4], x[5]}, (dyd_xy){x[6], x[7]}));
}

/* ---- bounds ---- */

static dyd_bbox box_of(const double *x, int k) {
  return (dyd_bbox){{x[4 * k], x[4 * k + 1], x[4 * k + 2], x[4 * k + 3]}};
}
static void ask_orient_bound(answer *a, const double *x) {
  say_double(a, dyd_filter_orient_bound(x[0], x[1], x[2]));
}
static void ask_min(answer *a, const double *x) {
  say_double(a, dyd_min(x[0], x[1]));
}
static void ask_max(answer *a, const double *x) {
  say_double(a, dyd_max(x[0], x[1]));
}
static void ask_lower(answer *a, const double *x) {
  say_double(a, dyd_lower(x[0]));
}
static void ask_upper(answer *a, const double *x) {
  say_double(a, dyd_upper(x[0]));
}
static void ask_ds2_lower(answer *a, const double *x) {
  dyd_bbox c = box_of(x, 0), b = box_of(x, 1);
  say_double(a, dyd_ds2_lower(&c, &b));
}
static void ask_dl2_upper(answer *a, const double *x) {
  dyd_bbox c = box_of(x, 0), b = box_of(x, 1);
  say_double(a, dyd_dl2_upper(&c, &b));
}
static void ask_ds2_upper(answer *a, const double *x) {
  dyd_bbox c = box_of(x, 0), b = box_of(x, 1);
  say_double(a, dyd_ds2_upper(&c, &b, x[8]));
}
static void ask_dl2_lower(answer *a, const double *x) {
  dyd_bbox c = box_of(x, 0), b = box_of(x, 1);
  say_double(a, dyd_dl2_lower(&c, &b, x[8]));
}

static const function number_of[] = {{"dyd_see", 4, ask_see, NULL, 0, 0},
                                     {"dyd_seen_cross", 4, ask_seen_cross, NULL, 0, 0},
                                     {"dyd_incircle_from", 6, ask_incircle_from, NULL, 0, 0},
                                     {"dyd_incircle_of", 8, ask_incircle_of, NULL, 0, 0},
                                     {"dyd_filter_orient_bound", 3, ask_orient_bound, NULL, 0, 0},
                                     {"dyd_min", 2, ask_min, NULL, 0, 0},
                                     {"dyd_max", 2, ask_max, NULL, 0, 0},
                                     {"dyd_lower", 1, ask_lower, NULL, 0, 0},
                                     {"dyd_upper", 1, ask_upper, NULL, 0, 0},
                                     {"dyd_ds2_lower", 8, ask_ds2_lower, NULL, 0, 0},
                                     {"dyd_dl2_upper", 8, ask_dl2_upper, NULL, 0, 0},
                                     {"dyd_ds2_upper", 9, ask_ds2_upper, NULL, 0, 0},
                                     {"dyd_dl2_lower", 9, ask_dl2_lower, NULL, 0, 0}};

void vectors_of_plane(const kind *k) {
  put_near_turn();
  put_vectors(sign, sizeof sign / sizeof *sign, k);
  put_vectors(number_of, sizeof number_of / sizeof *number_of, k);
}
