/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the package does with an array, called from C. Usage: arrays N RUNS; prints the user time of each run in
 * seconds.
 */
#include <dyadel/dyadel.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

static double user_seconds(void) {
  struct rusage now;
  getrusage(RUSAGE_SELF, &now);
  return (double)now.ru_utime.tv_sec + 1e-6 * (double)now.ru_utime.tv_usec;
}

static dyd_status run(const double *xy, size_t n) {
  const dyd_column column[2] = {{xy, 16}, {xy + 1, 16}};
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  dyd_triangle_list triangles = {0}, beyond = {0};
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.threads = 1;
  dyd_status st = dyd_engine_new(&e);
  if (st == DYD_OK) st = dyd_engine_add_columns(e, n, column, NULL, NULL);
  if (st == DYD_OK) st = dyd_engine_run(&outcome, e, &o, NULL);
  if (st == DYD_OK) st = dyd_delaunay_triangles(&triangles, &beyond, dyd_engine_delaunay(e), DYD_TRIANGLES_AS_FOUND);
  dyd_triangle_list_clear(&triangles);
  dyd_triangle_list_clear(&beyond);
  dyd_engine_free(e);
  return st;
}

int main(int argc, char **argv) {
  size_t n = argc > 1 ? strtoul(argv[1], NULL, 10) : 0;
  int runs = argc > 2 ? atoi(argv[2]) : 1, failed = 0;
  double *xy = malloc((2 * n + 1) * sizeof *xy);
  uint64_t state = 1;
  if (!xy) return 1;
  for (size_t k = 0; k < 2 * n; k++) {
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    xy[k] = (double)(state >> 11) * 0x1p-53;
  }
  for (int r = 0; r < runs && !failed; r++) {
    double begun = user_seconds();
    failed = run(xy, n) != DYD_OK;
    printf("%.6f\n", user_seconds() - begun);
  }
  free(xy);
  return failed;
}
