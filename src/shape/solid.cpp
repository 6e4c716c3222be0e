// SPDX-License-Identifier: Apache-2.0
#include "shape/solid.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/alpha_wrap_3.h>

#include <glm/common.hpp>

#include "base/error.hpp"

namespace cloudgen::shape {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> triangles;
};

/// In a box of edge 1, so that no length below depends on the unit of the file.
Soup normalised(const base::Mesh& mesh, const std::string& where) {
  glm::dvec3 lower(1e300), upper(-1e300);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) {
      lower = glm::min(lower, mesh.points[corner]);
      upper = glm::max(upper, mesh.points[corner]);
    }
  const glm::dvec3 size = upper - lower;
  const double most = std::max({size.x, size.y, size.z});
  if (!(std::min({size.x, size.y, size.z}) > 1e-3 * most))
    throw base::InputError(where, "is flat: a cloud needs a body", "take a mesh that encloses a volume");
  Soup soup;
  for (const glm::dvec3& point : mesh.points) {
    const glm::dvec3 p = (point - lower) / most;
    soup.points.emplace_back(p.x, p.y, p.z);
  }
  for (const auto& triangle : mesh.triangles) soup.triangles.push_back({triangle.begin(), triangle.end()});
  pmp::repair_polygon_soup(soup.points, soup.triangles);
  return soup;
}

/// The soup as it is, if it bounds a volume and does not cross itself; else an empty surface.
Surface asItIs(Soup soup) {
  Surface surface;
  pmp::orient_polygon_soup(soup.points, soup.triangles);
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.triangles)) return surface;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
  if (!CGAL::is_closed(surface) || !CGAL::is_triangle_mesh(surface) || pmp::does_self_intersect(surface))
    return {};
  pmp::orient_to_bound_a_volume(surface);
  return surface;
}

/// An alpha wrap (Portaneri et al. 2022), as fine as it can be without running through the mesh's holes into
/// its inside: finer wraps of a body keep most of their volume over their area, those that run in do not.
Surface wrapped(const Soup& soup) {
  constexpr double kCoarsest = 1.6, kFinest = 0.02, kKept = 0.62;
  Surface best;
  double compactness = 0;
  for (double alpha = kCoarsest; alpha > kFinest; alpha /= 2) {
    Surface wrap;
    CGAL::alpha_wrap_3(soup.points, soup.triangles, alpha, std::min(0.01, alpha / 12), wrap);
    const double own = wrap.is_empty() ? 0 : pmp::volume(wrap) / pmp::area(wrap);
    if (own < kKept * compactness) break;
    best = std::move(wrap), compactness = own;
  }
  return best;
}

base::Mesh meshOf(const Surface& surface) {
  base::Mesh mesh;
  std::map<Surface::Vertex_index, std::uint32_t> number;
  for (const auto vertex : surface.vertices()) {
    number[vertex] = static_cast<std::uint32_t>(mesh.points.size());
    const Point& p = surface.point(vertex);
    mesh.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto face : surface.faces()) {
    std::array<std::uint32_t, 3> corners{};
    int i = 0;
    for (const auto vertex : CGAL::vertices_around_face(surface.halfedge(face), surface))
      corners[static_cast<std::size_t>(i++)] = number[vertex];
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

/// Lindstrom and Turk 1998, by edge collapse. A closed triangle mesh has three edges for two faces.
void simplify(Surface& surface, std::size_t triangles) {
  sms::edge_collapse(surface, sms::Count_stop_predicate<Surface>(triangles * 3 / 2));
  surface.collect_garbage();
}

}  // namespace

std::vector<base::Mesh> simplifiedSolids(const base::Mesh& mesh, std::size_t mostTriangles,
                                         const std::string& where) {
  constexpr std::size_t kFewestTriangles = 24;
  Surface surface;
  try {
    const Soup soup = normalised(mesh, where);
    surface = asItIs(soup);
    if (surface.is_empty()) surface = wrapped(soup);
    if (surface.is_empty() || !(pmp::volume(surface) > 1e-6))
      throw base::InputError(where, "encloses no volume", "take a mesh that encloses one");
    std::vector<base::Mesh> levels;
    for (std::size_t most = mostTriangles;; most = levels.back().triangles.size() / 2) {
      const std::size_t before = surface.number_of_faces();
      if (before > most) simplify(surface, most);
      if (!levels.empty() && surface.number_of_faces() >= before) return levels;
      levels.push_back(meshOf(surface));
      if (surface.number_of_faces() < 2 * kFewestTriangles) return levels;
    }
  } catch (const CGAL::Failure_exception& problem) {
    throw base::InputError(where, "is no mesh that can be wrapped (" + problem.message() + ")",
                           "repair the mesh, or export it again");
  }
}

}  // namespace cloudgen::shape
