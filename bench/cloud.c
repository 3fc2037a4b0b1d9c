/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Making the clouds. */
#include "cloud.h"

#include "harness.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static uint64_t next_random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

double cloud_unit(uint64_t *state) {
  return (double)(next_random(state) >> 11) * 0x1p-53;
}

double cloud_gauss(uint64_t *state) {
  double sum = -6;
  for (int k = 0; k < 12; k++) sum += cloud_unit(state);
  return sum;
}

static double *doubles(size_t n) {
  double *x = malloc((n ? n : 1) * sizeof *x);
  if (!x) bench_die("input", "out of memory");
  return x;
}

static void start(cloud *c, size_t n) {
  memset(c, 0, sizeof *c);
  c->n = n;
  c->x = doubles(n);
  c->y = doubles(n);
}

void cloud_uniform(cloud *c, size_t n) {
  uint64_t state = 1;
  start(c, n);
  for (size_t i = 0; i < n; i++) {
    c->x[i] = cloud_unit(&state);
    c->y[i] = cloud_unit(&state);
  }
}

static void swap_points(cloud *c, size_t i, size_t j) {
  double x = c->x[i], y = c->y[i];
  c->x[i] = c->x[j];
  c->y[i] = c->y[j];
  c->x[j] = x;
  c->y[j] = y;
}

void cloud_grid(cloud *c, size_t n) {
  uint64_t state = 2;
  size_t side = (size_t)sqrt((double)n);
  start(c, side * side);
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = (double)(i % side);
    c->y[i] = (double)(i / side);
  }
  for (size_t i = c->n; i > 1; i--) swap_points(c, i - 1, next_random(&state) % i);
}

/* Angles grow strictly, by about 2 pi / n with a random part: neighbours are far more than an ulp apart. */
void cloud_circle(cloud *c, size_t n) {
  uint64_t state = 3;
  start(c, n);
  for (size_t i = 0; i < n; i++) {
    double angle = ((double)i + 0.5 * cloud_unit(&state)) * (6.283185307179586 / (double)n);
    c->x[i] = cos(angle);
    c->y[i] = sin(angle);
  }
  for (size_t i = n; i > 1; i--) swap_points(c, i - 1, next_random(&state) % i);
}

void cloud_hub(cloud *c, size_t n) {
  uint64_t state = 6;
  start(c, n);
  c->x[0] = 0.01;
  c->y[0] = 0.02;
  for (size_t i = 1; i < n; i++) {
    double angle = (double)i * (6.283185307179586 / (double)(n - 1)), d = 1 + 1e-4 * cloud_unit(&state);
    c->x[i] = d * cos(angle);
    c->y[i] = d * sin(angle);
  }
}

void cloud_globe(cloud *c, size_t n) {
  uint64_t state = 7;
  start(c, n);
  for (size_t i = 0; i < n; i++) {
    c->x[i] = 360 * cloud_unit(&state) - 180;
    c->y[i] = asin(2 * cloud_unit(&state) - 1) * 57.29577951308232;
  }
}

/* Latitudes are halves, so that no pole is among them. */
void cloud_parallels(cloud *c, size_t n) {
  size_t each = (size_t)sqrt((double)n / 2);
  double step = 180. / (double)each;
  start(c, 2 * each * each);
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = (double)(i % (2 * each)) * step - 180;
    c->y[i] = ((double)(i / (2 * each)) + 0.5) * step - 90;
  }
}

/* Products of Gaussian primes: (x + iy)(a +- ib) for all that there are so far, then times the units. */
void cloud_cocircular(cloud *c, size_t primes) {
  static const int prime[10][2] = {{2, 1}, {3, 2}, {4, 1}, {5, 2}, {6, 1}, {5, 4}, {7, 2}, {6, 5}, {8, 3}, {8, 5}};
  uint64_t state = 5;
  size_t n = 1;
  start(c, (size_t)4 << primes);
  c->x[0] = 1;
  c->y[0] = 0;
  for (size_t p = 0; p < primes; p++, n *= 2)
    for (size_t i = 0; i < n; i++) {
      double x = c->x[i], y = c->y[i], a = prime[p][0], b = prime[p][1];
      c->x[i] = x * a - y * b;
      c->y[i] = x * b + y * a;
      c->x[n + i] = x * a + y * b;
      c->y[n + i] = y * a - x * b;
    }
  for (int turn = 0; turn < 2; turn++, n *= 2) /* by 180, then by 90 degrees */
    for (size_t i = 0; i < n; i++) {
      c->x[n + i] = turn ? -c->y[i] : -c->x[i];
      c->y[n + i] = turn ? c->x[i] : -c->y[i];
    }
  for (size_t i = n; i > 1; i--) swap_points(c, i - 1, next_random(&state) % i);
}

/* The end p + w rounded away from p: the error of the rounded sum is known exactly (Knuth's two-sum). */
static double outward(double p, double w) {
  double s = p + w, b = s - p, error = (p - (s - b)) + (w - b);
  return w < 0 ? (error < 0 ? nextafter(s, -INFINITY) : s) : (error > 0 ? nextafter(s, INFINITY) : s);
}

void cloud_widen_one(cloud *c, size_t i, double half_width) {
  c->x0[i] = outward(c->x[i], -half_width);
  c->x1[i] = outward(c->x[i], half_width);
  c->y0[i] = outward(c->y[i], -half_width);
  c->y1[i] = outward(c->y[i], half_width);
}

void cloud_widen(cloud *c, double half_width) {
  c->x0 = doubles(c->n);
  c->x1 = doubles(c->n);
  c->y0 = doubles(c->n);
  c->y1 = doubles(c->n);
  for (size_t i = 0; i < c->n; i++) cloud_widen_one(c, i, half_width);
}

void cloud_gps(cloud *c, size_t n) {
  uint64_t state = 16;
  double side = sqrt((double)n), x = 0, y = 0;
  start(c, n);
  c->radius = doubles(n);
  for (size_t i = 0; i < n; i++) {
    bool alone = i < n / 2;
    if (alone || (i - n / 2) % 50 == 0) {
      x = side * cloud_unit(&state);
      y = side * cloud_unit(&state);
    }
    c->x[i] = round(1000 * (alone ? x : x + 2 * cloud_gauss(&state))) / 1000;
    c->y[i] = round(1000 * (alone ? y : y + 2 * cloud_gauss(&state))) / 1000;
    c->radius[i] = round(1000 * pow(0.02, cloud_unit(&state))) / 1000;
  }
  cloud_widen(c, 0);
  for (size_t i = 0; i < n; i++) cloud_widen_one(c, i, c->radius[i]);
}

void cloud_clear(cloud *c) {
  free(c->x);
  free(c->y);
  free(c->x0);
  free(c->x1);
  free(c->y0);
  free(c->y1);
  free(c->radius);
  memset(c, 0, sizeof *c);
}
