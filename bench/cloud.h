/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The inputs of the benchmarks: clouds of points and boxes around them, the same on every machine. */
#ifndef DYD_BENCH_CLOUD_H
#define DYD_BENCH_CLOUD_H

#include <stddef.h>
#include <stdint.h>

/* n points; boxes [x0,x1] x [y0,y1] around them when they are there (NULL otherwise).
 * Owned: release with cloud_clear. */
typedef struct cloud {
  size_t n;
  double *x, *y;
  double *x0, *x1, *y0, *y1;
  double *radius; /* of cloud_gps alone */
} cloud;

/* The next number of a generator in [0,1), a multiple of 2^-53. */
double cloud_unit(uint64_t *state);
/* About normal, with variance 1: twelve uniform numbers, so that no function of the C library is asked. */
double cloud_gauss(uint64_t *state);

/* All end the program when memory runs out. */
/* Coordinates uniform multiples of 2^-53 in [0,1). */
void cloud_uniform(cloud *c, size_t n);
/* The integer points of a square of side floor(sqrt(n)), in random order; c->n is the number there is. */
void cloud_grid(cloud *c, size_t n);
/* Distinct doubles next to the unit circle. */
void cloud_circle(cloud *c, size_t n);
/* One point, and n - 1 in a rough circle around it, all of them its neighbours. */
void cloud_hub(cloud *c, size_t n);
/* Longitudes and latitudes in degrees: uniform on the sphere; at all crossings of k parallels and 2 k meridians, c->n =
 * 2 k^2 is the number there is. */
void cloud_globe(cloud *c, size_t n);
void cloud_parallels(cloud *c, size_t n);
/* Positions by a receiver, in a square of side sqrt(n): half of them uniform, half in clusters of 50 with deviation 2;
 * radii from 0.02 to 1, as many between 0.02 and 0.04 as between 0.5 and 1. All are thousandths. Boxes are the squares
 * of these half-widths, rounded outward. */
void cloud_gps(cloud *c, size_t n);
/* All integer points on the circle about the origin whose squared radius is the product of the first `primes` primes of
 * the form 4k + 1: 4 * 2^primes of them, in random order. At most 10 primes. */
void cloud_cocircular(cloud *c, size_t primes);
/* Boxes of the given half-width, rounded outward by at most one unit in the last place. */
void cloud_widen(cloud *c, double half_width);
/* The box of one point becomes that wide. */
void cloud_widen_one(cloud *c, size_t i, double half_width);
void cloud_clear(cloud *c);

#endif
