// SPDX-License-Identifier: LGPL-3.0-or-later
// The whole command as a user of CGAL would write it: FILE of points, a line each, to the edges of their triangulation
// on standard output, as numbers of lines.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fstream>
#include <iostream>
#include <utility>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Triangulation_vertex_base_with_info_2<unsigned, Kernel> Vertex;
typedef CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>> Triangulation;

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  std::ios::sync_with_stdio(false);
  std::ifstream in(argv[1]);
  std::vector<std::pair<Kernel::Point_2, unsigned>> points;
  for (double x, y; in >> x >> y;) points.emplace_back(Kernel::Point_2(x, y), unsigned(points.size()));
  Triangulation t(points.begin(), points.end());
  std::cout << "i,j\n";
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
    unsigned i = e->first->vertex(t.cw(e->second))->info(), j = e->first->vertex(t.ccw(e->second))->info();
    std::cout << std::min(i, j) << ',' << std::max(i, j) << '\n';
  }
  return in.eof() && std::cout.flush() ? 0 : 1;
}
