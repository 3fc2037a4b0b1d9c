/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Making points files. */
#include "real.h"

#include "bench_config.h"
#include "cloud.h"
#include "harness.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

static double between(uint64_t *state, double lo, double hi) {
  return lo + (hi - lo) * cloud_unit(state);
}

static FILE *start_file(void) {
  FILE *f = tmpfile();
  if (!f) bench_die("input", "no temporary file");
  return f;
}

static FILE *end_file(FILE *f) {
  if (fflush(f)) bench_die("input", "writing failed");
  rewind(f);
  return f;
}

FILE *real_airports(size_t n) {
  (void)n;
  FILE *f = fopen(BENCH_AIRPORTS, "r");
  if (!f) bench_die("airports", "cannot read " BENCH_AIRPORTS);
  return f;
}

FILE *real_outliers(size_t n) {
  uint64_t state = 11;
  FILE *f = start_file();
  for (size_t k = 0; k < n; k++) {
    double far = k % (n / 20) == 0 ? 50 : 1;
    fprintf(f, "%.6f+-0.05 %.6f+-0.05\n", far * cloud_gauss(&state), far * cloud_gauss(&state));
  }
  return end_file(f);
}

FILE *real_clusters(size_t n) {
  enum { CLUSTERS = 30, ALONE = 100 };
  uint64_t state = 12;
  double x[CLUSTERS], y[CLUSTERS], width[CLUSTERS];
  FILE *f = start_file();
  for (int c = 0; c < CLUSTERS; c++) {
    x[c] = between(&state, -20, 20);
    y[c] = between(&state, -20, 20);
    width[c] = 0.01 * (1 + c % 5);
  }
  for (size_t k = 0; k < n; k++) {
    size_t c = k % CLUSTERS;
    if (k < ALONE)
      fprintf(f, "%.2f+-0.01 %.2f+-0.01\n", between(&state, -1000, 1000), between(&state, -1000, 1000));
    else
      fprintf(f, "%.7f+-0.002 %.7f+-0.002\n", x[c] + width[c] * cloud_gauss(&state),
              y[c] + width[c] * cloud_gauss(&state));
  }
  return end_file(f);
}

FILE *real_tracks(size_t n) {
  static const int accuracy[6] = {3, 5, 5, 8, 12, 30};
  uint64_t state = 13;
  double side = 100 * sqrt((double)n), x = 0, y = 0, heading = 0;
  FILE *f = start_file();
  for (size_t k = 0; k < n; k++) {
    bool jumps = k % 60 == 0, stays = cloud_unit(&state) < 0.15;
    int r = accuracy[(size_t)(6 * cloud_unit(&state))];
    if (jumps) {
      x = between(&state, 0, side);
      y = between(&state, 0, side);
      heading = between(&state, 0, 2 * PI);
    }
    heading += 0.2 * cloud_gauss(&state);
    if (!stays) {
      x += 8 * cos(heading);
      y += 8 * sin(heading);
    }
    fprintf(f, "%.1f+-%d %.1f+-%d\n", x, r, y, r);
  }
  return end_file(f);
}

/* Harmonics with amplitudes like 1 / frequency and random phases, down to bays of eight steps. */
FILE *real_coast(size_t n) {
  enum { MOST = 100 };
  uint64_t state = 14;
  double often[MOST], phase[MOST], step = 2 * PI / (double)n;
  int bays = 0;
  FILE *f = start_file();
  for (double w = 2; bays < MOST && 8 * w < (double)n; w *= 1.25) {
    often[bays] = floor(w);
    phase[bays++] = between(&state, 0, 2 * PI);
  }
  for (size_t k = 0; k < n; k++) {
    double angle = (double)k * step, r = 3;
    for (int b = 0; b < bays; b++) r += 0.5 / often[b] * sin(often[b] * angle + phase[b]);
    fprintf(f, "%.8f+-%.8f %.8f+-%.8f\n", r * cos(angle), 0.01 * step, r * sin(angle), 0.01 * step);
  }
  return end_file(f);
}

FILE *real_gps(size_t n) {
  cloud c;
  FILE *f = start_file();
  cloud_gps(&c, n);
  fprintf(f, "east,north,accuracy\n");
  for (size_t i = 0; i < n; i++) fprintf(f, "%.3f,%.3f,%.3f\n", c.x[i], c.y[i], c.radius[i]);
  cloud_clear(&c);
  return end_file(f);
}
