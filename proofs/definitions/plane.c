/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The parts of orientation and in-circle of skeleton/mesh_filter.h, and the bounds of distances of rects_filter.h. */
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"
#include "vectors.h"

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
  put_vectors(number_of, sizeof number_of / sizeof *number_of, k);
}
