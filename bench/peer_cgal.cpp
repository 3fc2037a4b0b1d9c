// SPDX-License-Identifier: LGPL-3.0-or-later
// The peers: CGAL's Delaunay triangulations, timed as their users would call them.
#include "peer.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_adaptation_policies_2.h>
#include <CGAL/Delaunay_triangulation_adaptation_traits_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel_with_sqrt.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Voronoi_diagram_2.h>
#include <CGAL/version.h>
#include <algorithm>
#include <cstdlib>
#include <unordered_map>
#include <vector>

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel Doubles;
typedef CGAL::Exact_predicates_exact_constructions_kernel_with_sqrt Roots;

// Vertices keep their handles but lose their numbers in a range insertion: find the numbers by the coordinates,
// each vertex's nearest double being enough of a key for distinct inputs that differ as doubles.
template <class Kernel> struct Numbers {
  typedef typename Kernel::Point_2 Point;
  std::vector<std::pair<std::pair<double, double>, uint32_t>> table;
  static std::pair<double, double> key(const Point &p) { return {CGAL::to_double(p.x()), CGAL::to_double(p.y())}; }
  explicit Numbers(const std::vector<Point> &points) {
    for (uint32_t i = 0; i < points.size(); i++) table.push_back({key(points[i]), i});
    std::sort(table.begin(), table.end());
  }
  uint32_t operator()(const Point &p) const {
    auto at = std::lower_bound(table.begin(), table.end(), std::make_pair(key(p), uint32_t(0)));
    if (at == table.end() || at->first != key(p)) bench_die("peer", "a vertex is none of the points");
    return at->second;
  }
};

template <class Triangulation, class Point>
void list_edges(bench_edges *edges, const Triangulation &dt, const std::vector<Point> &points) {
  Numbers<typename Triangulation::Geom_traits> number(points);
  std::unordered_map<const void *, uint32_t> of;
  for (auto v = dt.finite_vertices_begin(); v != dt.finite_vertices_end(); ++v) of[&*v] = number(v->point());
  std::vector<bench_edge> list;
  for (auto e = dt.finite_edges_begin(); e != dt.finite_edges_end(); ++e) {
    uint32_t i = of[&*e->first->vertex(dt.cw(e->second))], j = of[&*e->first->vertex(dt.ccw(e->second))];
    list.push_back({std::min(i, j), std::max(i, j)});
  }
  edges->count = list.size();
  edges->item = static_cast<bench_edge *>(std::malloc(std::max<size_t>(1, list.size()) * sizeof(bench_edge)));
  if (!edges->item) bench_die("peer", "out of memory");
  std::copy(list.begin(), list.end(), edges->item);
  bench_edges_sort(edges);
}

} // namespace

extern "C" {

bool peer_points(bench_cost *cost, bench_edges *edges, size_t n, const double *x, const double *y) {
  std::vector<Doubles::Point_2> points;
  points.reserve(n);
  for (size_t i = 0; i < n; i++) points.emplace_back(x[i], y[i]); // the peer's input: before the clock starts
  bench_meter meter = bench_start();
  CGAL::Delaunay_triangulation_2<Doubles> dt;
  dt.insert(points.begin(), points.end());
  *cost = bench_stop(&meter);
  if (edges) list_edges(edges, dt, points);
  return true;
}

bool peer_roots(bench_cost *cost, bench_edges *edges, size_t n, const uint32_t *r) {
  auto root = [](uint32_t a) { return CGAL::sqrt(Roots::FT(int(a))); };
  bench_meter meter = bench_start();
  std::vector<Roots::Point_2> points;
  for (size_t i = 0; i < n; i++, r += 4) points.emplace_back(root(r[0]) + root(r[1]), root(r[2]) + root(r[3]));
  CGAL::Delaunay_triangulation_2<Roots> dt;
  dt.insert(points.begin(), points.end());
  *cost = bench_stop(&meter);
  if (edges) list_edges(edges, dt, points);
  return true;
}

bool peer_voronoi(bench_cost *cost, size_t *corners, size_t n, const double *x, const double *y) {
  typedef CGAL::Delaunay_triangulation_2<Doubles> Triangulation;
  typedef CGAL::Voronoi_diagram_2<Triangulation, CGAL::Delaunay_triangulation_adaptation_traits_2<Triangulation>,
                                  CGAL::Delaunay_triangulation_caching_degeneracy_removal_policy_2<Triangulation>>
      Diagram;
  std::vector<Doubles::Point_2> points, corner;
  points.reserve(n);
  for (size_t i = 0; i < n; i++) points.emplace_back(x[i], y[i]);
  bench_meter meter = bench_start();
  Triangulation dt;
  dt.insert(points.begin(), points.end());
  Diagram diagram(dt);
  for (auto f = diagram.bounded_faces_begin(); f != diagram.bounded_faces_end(); ++f) {
    auto h = f->ccb(), first = h;
    do corner.push_back(h->source()->point());
    while (++h != first);
  }
  *cost = bench_stop(&meter);
  *corners = corner.size();
  return true;
}

const char *peer_points_name(void) {
  return "CGAL " CGAL_VERSION_STR " Epick";
}
const char *peer_roots_name(void) {
  return "CGAL " CGAL_VERSION_STR " CORE";
}
}
