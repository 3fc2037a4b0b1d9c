/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Stands in for the peers where CGAL or a C++ compiler is missing. */
#include "peer.h"

bool peer_points(bench_cost *cost, bench_edges *edges, size_t n, const double *x, const double *y) {
  (void)cost, (void)edges, (void)n, (void)x, (void)y;
  return false;
}

bool peer_roots(bench_cost *cost, bench_edges *edges, size_t n, const uint32_t *r) {
  (void)cost, (void)edges, (void)n, (void)r;
  return false;
}

bool peer_voronoi(bench_cost *cost, size_t *corners, size_t n, const double *x, const double *y) {
  (void)cost, (void)corners, (void)n, (void)x, (void)y;
  return false;
}

const char *peer_points_name(void) {
  return "none";
}
const char *peer_roots_name(void) {
  return "none";
}
