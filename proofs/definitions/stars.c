/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What legal/star_filter.c says of one star, where no rectangle is fat. */
#include "legal/star_filter.c" /* functions are static */
#include "vectors.h"

enum { DEGREE = 5 };

/* v, the box of its rectangle */
static void ask_radius(answer *a, const double *x) {
  dyd_xy v = {x[0], x[1]};
  dyd_bbox b = {{x[2], x[3], x[4], x[5]}};
  dyd_skeleton sk = {.reps = {.xy = &v}, .rects = {.box = &b}};
  say_double(a, star_radius(&sk, 0));
}

/* x: v, the reach, neighbours, centres, where the ghost is (-1: nowhere). A star's edge q is half-edge 0 of triangle q,
 * its twin half-edge 1. */
enum { AROUND = 3, CENTRES = AROUND + 2 * DEGREE, GHOST = CENTRES + 2 * DEGREE };
static void star_of(star *s, const double *x) {
  *s = (star){.degree = DEGREE, .ghost = (int)x[GHOST]};
  for (int q = 0; q < DEGREE; q++) {
    s->x[q] = q == s->ghost ? (double)NAN : x[AROUND + 2 * q];
    s->y[q] = q == s->ghost ? (double)NAN : x[AROUND + 2 * q + 1];
    s->centre[q] = (dyd_xy){x[CENTRES + 2 * q], x[CENTRES + 2 * q + 1]};
    s->edge[q] = dyd_edge_of((uint32_t)q, 0);
  }
}

/* The marks of the edges after one of the two is asked. */
static void ask_marks(answer *a, const double *x, void (*certify)(const pass *, const star *)) {
  dyd_xy v = {x[0], x[1]};
  dyd_tri tri[DEGREE];
  uint8_t certain[DEGREE] = {0};
  star s;
  star_of(&s, x);
  for (uint32_t q = 0; q < DEGREE; q++) tri[q] = (dyd_tri){{0, 1, 2}, {dyd_edge_of(q, 1), 0, 0}};
  dyd_skeleton sk = {.n = 9, .reps = {.xy = &v}, .mesh = {.n = 9, .tri = tri}, .certain = certain};
  pass p = {.sk = &sk, .reach = x[2]};
  certify(&p, &s);
  for (int q = 0; q < DEGREE; q++) say_integer(a, certain[q]);
}
static void ask_edges(answer *a, const double *x) {
  ask_marks(a, x, certify_edges);
}
static void ask_hull_vertex(answer *a, const double *x) {
  ask_marks(a, x, certify_hull);
}
/* x: neighbours, the centre, the limit, q, whether there is a ghost */
static void ask_others_farther(answer *a, const double *x) {
  star s = {.degree = DEGREE, .ghost = x[2 * DEGREE + 4] > 0 ? 0 : -1};
  for (int q = 0; q < DEGREE; q++) {
    s.x[q] = x[2 * q];
    s.y[q] = x[2 * q + 1];
  }
  const double *c = x + 2 * DEGREE;
  say_integer(a, others_farther(&s, (int)c[3], (dyd_xy){c[0], c[1]}, c[2]));
}

/* Neighbours round a place, at about the distance 1; one in six somewhere. */
static void choose_neighbours(double *x, double size) {
  for (int q = 0; q < DEGREE; q++) {
    double angle = 6.2831853 * (q + 0.8 * test_unit(&shared)) / DEGREE, r = size * (0.8 + 0.4 * test_unit(&shared));
    x[2 * q] = r * cos(angle);
    x[2 * q + 1] = r * sin(angle);
    if (test_chance(&shared, 6)) x[2 * q] = size * test_unit(&shared);
  }
}
static double some_size(const kind *k) {
  return ldexp(1, k->base > 505 ? 505 : k->base < -520 ? -520 : k->base);
}
static void choose_star(double *x, unsigned inputs, const kind *k) {
  double size = some_size(k);
  (void)inputs;
  x[0] = size * 0x1p-4 * test_unit(&shared);
  x[1] = size * 0x1p-4 * test_unit(&shared);
  x[2] = ldexp(size * test_unit(&shared), -(int)test_below(&shared, 40));
  x[GHOST] = (double)test_between(&shared, -1, DEGREE - 1);
  choose_neighbours(x + AROUND, size);
  for (int q = 0; q < DEGREE; q++) {
    int next = (q + 1) % DEGREE;
    for (int e = 0; e < 2; e++) {
      double middle = 0.5 * (x[AROUND + 2 * q + e] + x[AROUND + 2 * next + e]);
      x[CENTRES + 2 * q + e] = middle + size * 0x1p-4 * test_unit(&shared);
    }
  }
}
static void choose_hull_star(double *x, unsigned inputs, const kind *k) {
  choose_star(x, inputs, k);
  if (x[GHOST] < 0) x[GHOST] = 0;
  if (test_chance(&shared, 2)) x[2] = 0;
  /* All on one side of v, the ghost on the other; by less and less. */
  double angle = 6.2831853 * test_unit(&shared), c = some_size(k) * cos(angle), s = some_size(k) * sin(angle);
  double depth = ldexp(1, -(int)test_below(&shared, 56));
  for (int q = 0; q < DEGREE; q++) {
    double along = (q - (int)x[GHOST] + DEGREE) % DEGREE - 2.5 + 0.5 * test_unit(&shared),
           below = depth * test_unit(&shared);
    x[AROUND + 2 * q] = x[0] + along * c + below * s;
    x[AROUND + 2 * q + 1] = x[1] + along * s - below * c;
  }
}
static void choose_others(double *x, unsigned inputs, const kind *k) {
  double size = some_size(k);
  (void)inputs;
  choose_neighbours(x, size);
  x[2 * DEGREE] = size * 0x1p-3 * test_unit(&shared);
  x[2 * DEGREE + 1] = size * 0x1p-3 * test_unit(&shared);
  x[2 * DEGREE + 2] = size * size * test_unit(&shared);
  x[2 * DEGREE + 3] = (double)test_below(&shared, DEGREE);
  x[2 * DEGREE + 4] = (double)test_below(&shared, 2);
  if (x[2 * DEGREE + 4] > 0) x[0] = x[1] = (double)NAN;
}

static const function of_star[] = {{"star_radius", 6, ask_radius, NULL, 0, 0},
                                   {"certify_edges", GHOST + 1, ask_edges, choose_star, 8, 1},
                                   {"certify_hull", GHOST + 1, ask_hull_vertex, choose_hull_star, 8, 1},
                                   {"others_farther", 2 * DEGREE + 5, ask_others_farther, choose_others, 8, 2}};

void vectors_of_stars(const kind *k) {
  put_vectors(of_star, sizeof of_star / sizeof *of_star, k);
}
