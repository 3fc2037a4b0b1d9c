/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Edges by their two triangles alone, and the sum of turns round a polygon. */
#include "legal/star_filter.h"
#include "vectors.h"
#include "voronoi/shape_filter.c" /* functions are static */

static dyd_xy xy_at(const double *x, int k) {
  return (dyd_xy){x[2 * k], x[2 * k + 1]};
}

static void ask_square_distance(answer *a, const double *x) {
  say_double(a, dyd_square_distance(xy_at(x, 0), xy_at(x, 1)));
}
static void ask_edge_near(answer *a, const double *x) {
  say_integer(a, dyd_filter_edge_near(xy_at(x, 0), xy_at(x, 1), xy_at(x, 2), xy_at(x, 3), x[8], x[9]));
}
static void ask_hull_edge_near(answer *a, const double *x) {
  say_integer(a, dyd_filter_hull_edge_near(xy_at(x, 0), xy_at(x, 1), xy_at(x, 2), x[6], x[7]));
}

/* Edges from a place near the origin to the right, one vertex on the left, one on the right; at the limits of the sizes
 * that are allowed too. The distance allowed for near vertices is more than needed, or about the same. */
static void choose_edge(double *x, unsigned inputs, const kind *k) {
  static const int sizes[] = {0, 0, 0, 20, -20, 44, 44, 47, 48, 49, -49, -50, -51};
  double size = ldexp(1, sizes[test_below(&shared, sizeof sizes / sizeof *sizes)]);
  double lift = ldexp(0.5 + test_unit(&shared), -(int)test_below(&shared, test_chance(&shared, 8) ? 52 : 6));
  unsigned points = inputs / 2 - 1;
  const double place[8] = {
      0, 0, 1, 0, test_unit(&shared), lift, test_unit(&shared), -lift * (0.5 + test_unit(&shared))};
  static const double square[8] = {0, 0, 4, 3, -1, 7, 3, -1}; /* on a circle, 3 4 5 */
  unsigned choice = (unsigned)test_below(&shared, 6);
  double blur = ldexp(1, -(int)test_below(&shared, 54));
  (void)k;
  for (unsigned q = 0; q < 2 * points; q++)
    x[q] = size * (choice == 0   ? floor(16 * place[q])
                   : choice == 1 ? square[q] + blur * test_unit(&shared)
                                 : place[q] + ldexp(test_unit(&shared), -(int)(3 + q)));
  x[inputs - 1] = size * (0.5 + test_unit(&shared));
  x[inputs - 2] = ldexp(x[inputs - 1] * (0.5 + test_unit(&shared)),
                        -(int)(6 + test_below(&shared, test_chance(&shared, 4) ? 55 : 6)));
}

/* ---- polygons ---- */

enum { VERTICES = 5 };
static void ask_double_turn(answer *a, const double *x) {
  double error, d = double_turn(&error, xy_at(x, 0), xy_at(x, 1), xy_at(x, 2));
  say_double(a, d);
  say_double(a, error);
}
static void ask_star(answer *a, const double *x) {
  dyd_xy z[VERTICES];
  double area, error;
  for (int k = 0; k < VERTICES; k++) z[k] = xy_at(x, k + 1);
  if (!shape_star(&area, &error, xy_at(x, 0), z, VERTICES)) {
    say_none(a);
    return;
  }
  say_double(a, area);
  say_double(a, error);
}

/* Round the first point, once or twice; now and then flat, or in some other order. */
static void choose_polygon(double *x, unsigned inputs, const kind *k) {
  double size = ldexp(1, k->base > 513    ? 513
                         : k->base < -530 ? -530
                                          : k->base),
         turns = test_chance(&shared, 8) ? 2 : 1;
  double flat = test_chance(&shared, 3) ? ldexp(1, -(int)test_below(&shared, 56)) : 1;
  x[0] = test_unit(&shared) * size;
  x[1] = test_unit(&shared) * size;
  for (unsigned q = 2; q + 1 < inputs; q += 2) {
    double angle = 6.2831853 * turns * ((q - 2) / 2.0 + 0.9 * test_unit(&shared)) / VERTICES,
           r = 1 + test_unit(&shared);
    x[q] = x[0] + size * r * cos(angle);
    x[q + 1] = x[1] + size * r * flat * sin(angle);
  }
  if (test_chance(&shared, 6)) x[3 + 2 * test_below(&shared, VERTICES)] = x[1];
}

static const function near[] = {{"dyd_square_distance", 4, ask_square_distance, NULL, 0, 0},
                                {"dyd_filter_edge_near", 10, ask_edge_near, choose_edge, 12, 0},
                                {"dyd_filter_hull_edge_near", 8, ask_hull_edge_near, choose_edge, 12, 0},
                                {"double_turn", 6, ask_double_turn, NULL, 0, 0},
                                {"shape_star", 2 * VERTICES + 2, ask_star, choose_polygon, 0, 0}};

void vectors_of_near(const kind *k) {
  put_vectors(near, sizeof near / sizeof *near, k);
}
