/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The peers: CGAL's Delaunay triangulations. Without CGAL at build time every call answers false. */
#ifndef DYD_BENCH_PEER_H
#define DYD_BENCH_PEER_H

#include "edges.h"
#include "harness.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Delaunay_triangulation_2 over Exact_predicates_inexact_constructions_kernel, range insertion (which sorts along a
 * space-filling curve). edges: NULL, or filled with the finite edges, sorted, after the clock has stopped; the points
 * must then be distinct. */
bool peer_points(bench_cost *cost, bench_edges *edges, size_t n, const double *x, const double *y);
/* The same over Exact_predicates_exact_constructions_kernel_with_sqrt (CORE::Expr), for the points
 * (sqrt(r[4i]) + sqrt(r[4i+1]), sqrt(r[4i+2]) + sqrt(r[4i+3])); making the numbers is part of the cost. */
bool peer_roots(bench_cost *cost, bench_edges *edges, size_t n, const uint32_t *r);
/* The triangulation of peer_points and, by Voronoi_diagram_2, the vertices of all bounded cells: *corners in all. */
bool peer_voronoi(bench_cost *cost, size_t *corners, size_t n, const double *x, const double *y);
/* Names for the table. Static storage. */
const char *peer_points_name(void);
const char *peer_roots_name(void);

#ifdef __cplusplus
}
#endif
#endif
