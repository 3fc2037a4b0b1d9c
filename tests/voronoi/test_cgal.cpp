// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact points against CGAL: the same triangles, and each circumcentre (in rationals) in the enclosure of its vertex.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <dyadel/voronoi.h>
#include <fstream>
#include <gmp.h>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Triangulation_vertex_base_with_info_2<uint32_t, Kernel> Vertex;
typedef CGAL::Triangulation_data_structure_2<Vertex, CGAL::Triangulation_face_base_2<Kernel>> Structure;
typedef CGAL::Delaunay_triangulation_2<Kernel, Structure> Triangulation;
typedef std::array<uint32_t, 3> Corners;

constexpr int64_t BITS = 60;

void require(bool good, const char *what) {
  if (good) return;
  std::fprintf(stderr, "FAILED: %s\n", what);
  std::exit(1);
}

Corners sorted(uint32_t a, uint32_t b, uint32_t c) {
  Corners t = {a, b, c};
  std::sort(t.begin(), t.end());
  return t;
}

// Longitude and latitude, the last two fields of a line in the other order; points given twice are left out.
std::vector<Kernel::Point_2> read_airports(const char *path) {
  std::ifstream in(path);
  std::vector<Kernel::Point_2> points;
  std::set<std::pair<double, double>> known;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    size_t last = line.rfind(','), before = line.rfind(',', last - 1);
    double x = std::strtod(line.c_str() + last + 1, nullptr), y = std::strtod(line.c_str() + before + 1, nullptr);
    if (known.insert({x, y}).second) points.emplace_back(x, y);
  }
  return points;
}

// x[k] = the coordinate of the circumcentre of p[0], p[1], p[2]; in rationals, from the definition.
void circumcentre(mpq_t x[2], const Kernel::Point_2 p[3]) {
  mpq_t u[2][2], s[2], t, d;
  mpq_inits(u[0][0], u[0][1], u[1][0], u[1][1], s[0], s[1], t, d, NULL);
  for (int k = 0; k < 2; k++) {
    mpq_set_ui(s[k], 0, 1);
    for (int a = 0; a < 2; a++) {
      mpq_set_d(u[k][a], p[k + 1][a]);
      mpq_set_d(t, p[0][a]);
      mpq_sub(u[k][a], u[k][a], t);
      mpq_mul(t, u[k][a], u[k][a]);
      mpq_add(s[k], s[k], t);
    }
  }
  mpq_mul(d, u[0][0], u[1][1]);
  mpq_mul(t, u[0][1], u[1][0]);
  mpq_sub(d, d, t);
  mpq_mul_2exp(d, d, 1);
  for (int a = 0; a < 2; a++) {
    mpq_mul(x[a], s[a], u[1 - a][1 - a]);
    mpq_mul(t, s[1 - a], u[a][1 - a]);
    mpq_sub(x[a], x[a], t);
    mpq_div(x[a], x[a], d);
    mpq_set_d(t, p[0][a]);
    mpq_add(x[a], x[a], t);
  }
  mpq_clears(u[0][0], u[0][1], u[1][0], u[1][1], s[0], s[1], t, d, NULL);
}

// Inside, and at most 2^(1-BITS) wide.
bool encloses(const dyd_interval *i, mpq_t x) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  dyd_dyadic_get_q(lo, &i->lo);
  dyd_dyadic_get_q(hi, &i->hi);
  bool good = mpq_cmp(lo, x) <= 0 && mpq_cmp(x, hi) <= 0;
  mpq_sub(hi, hi, lo);
  mpq_mul_2exp(hi, hi, BITS - 1);
  good = good && mpq_cmp_ui(hi, 1, 1) <= 0;
  mpq_clears(lo, hi, NULL);
  return good;
}

void check_vertex(const dyd_delaunay *pd, const dyd_triangle *t, const std::vector<Kernel::Point_2> &points) {
  const Kernel::Point_2 p[3] = {points[t->v[0]], points[t->v[1]], points[t->v[2]]};
  mpq_t x[2];
  dyd_rect r;
  dyd_rect_init(&r);
  mpq_inits(x[0], x[1], NULL);
  circumcentre(x, p);
  require(dyd_voronoi_vertex(&r, pd, t, BITS) == DYD_OK, "a vertex is given");
  require(encloses(&r.x, x[0]) && encloses(&r.y, x[1]), "the circumcentre is in a narrow enclosure");
  mpq_clears(x[0], x[1], NULL);
  dyd_rect_clear(&r);
}

} // namespace

int main(int argc, char **argv) {
  require(argc == 2, "one argument: airports.csv");
  const std::vector<Kernel::Point_2> points = read_airports(argv[1]);
  std::vector<std::pair<Kernel::Point_2, uint32_t>> numbered;
  std::vector<double> x, y;
  for (uint32_t i = 0; i < points.size(); i++) {
    numbered.emplace_back(points[i], i);
    x.push_back(points[i].x());
    y.push_back(points[i].y());
  }
  Triangulation peer(numbered.begin(), numbered.end());
  std::set<Corners> theirs, ours;
  for (auto f = peer.finite_faces_begin(); f != peer.finite_faces_end(); ++f)
    theirs.insert(sorted(f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()));

  dyd_sites *sites = nullptr;
  dyd_delaunay *pd = nullptr;
  dyd_triangle_list list = {};
  dyd_error err;
  require(dyd_sites_new(&sites) == DYD_OK && dyd_sites_add_points(sites, x.size(), x.data(), y.data()) == DYD_OK,
          "the points are sites");
  require(dyd_delaunay_new(&pd, sites, nullptr, &err) == DYD_OK, "there is a triangulation");
  require(dyd_delaunay_triangles(&list, nullptr, pd, 0) == DYD_OK, "there are triangles");
  for (size_t k = 0; k < list.count; k++) {
    const uint32_t *v = list.item[k].v;
    ours.insert(sorted(v[0], v[1], v[2]));
    check_vertex(pd, &list.item[k], points);
  }
  std::fprintf(stderr, "# %zu points, %zu triangles of ours, %zu of the peer\n", points.size(), ours.size(),
               theirs.size());
  require(points.size() > 3000 && ours == theirs, "the triangles are the same");
  dyd_triangle_list_clear(&list);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return 0;
}
