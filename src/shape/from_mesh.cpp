// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <queue>

#include "base/noise.hpp"
#include "shape/file_shape.hpp"
#include "shape/reduce.hpp"
#include "shape/solid.hpp"

namespace cloudgen::shape {
namespace {

constexpr std::size_t kMostTriangles = 3000;
constexpr double kSurfaceShare = 0.72;  ///< of the puffs

/// A triangle, and how far the body reaches behind it.
struct Facet {
  std::array<glm::dvec3, 3> corners;
  double thickness = 0;
};

/// A ball that fits into the body.
struct Ball {
  glm::dvec3 center;
  double radius;
};

/// A body in units of the file, standing on y = 0 over the middle of its box.
struct Body {
  glm::dvec3 size{0};
  std::vector<std::vector<Facet>> levels;  ///< from many facets to few
  std::vector<Ball> balls;                 ///< the first few fill it as well as so few can
};

/// Where a line meets a facet: its distance along the direction (Moeller and Trumbore 1997), or nothing.
std::optional<double> meeting(const Facet& facet, const glm::dvec3& from, const glm::dvec3& direction) {
  const glm::dvec3 e1 = facet.corners[1] - facet.corners[0], e2 = facet.corners[2] - facet.corners[0],
                   p = glm::cross(direction, e2);
  const double determinant = glm::dot(e1, p);
  if (std::abs(determinant) < 1e-14) return std::nullopt;
  const glm::dvec3 s = from - facet.corners[0], q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return glm::dot(e2, q) / determinant;
}

glm::dvec3 barycentre(const Facet& facet) {
  return (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
}

glm::dvec3 outward(const Facet& facet) {
  const glm::dvec3 normal =
      glm::cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
  const double length = glm::length(normal);
  return length > 0 ? normal / length : glm::dvec3(0, 1, 0);
}

/// To the nearest point of a facet (Ericson 2005, 5.1.5).
double distanceTo(const Facet& facet, const glm::dvec3& point) {
  const auto& [a, b, c] = facet.corners;
  const glm::dvec3 ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
               d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return glm::distance(point, a);
  if (d3 >= 0 && d4 <= d3) return glm::distance(point, b);
  if (d6 >= 0 && d5 <= d6) return glm::distance(point, c);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::distance(point, a + d1 / (d1 - d3) * ab);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::distance(point, a + d2 / (d2 - d6) * ac);
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return glm::distance(point, b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b));
  const double whole = va + vb + vc;
  return glm::distance(point, a + vb / whole * ab + vc / whole * ac);
}

double distanceToOther(const std::vector<Facet>& facets, const glm::dvec3& from,
                       const glm::dvec3& direction) {
  double nearest = 2;
  for (const Facet& other : facets)
    if (const auto at = meeting(other, from, direction); at && *at > 1e-6) nearest = std::min(nearest, *at);
  return nearest;
}

std::vector<Facet> facetsOf(const base::Mesh& mesh, const glm::dvec3& foot) {
  std::vector<Facet> facets;
  for (const auto& [a, b, c] : mesh.triangles)
    facets.push_back({{mesh.points[a] - foot, mesh.points[b] - foot, mesh.points[c] - foot}, 0});
  for (Facet& facet : facets) facet.thickness = distanceToOther(facets, barycentre(facet), -outward(facet));
  return facets;
}

/// Points inside, found along upright lines: between an odd and an even crossing of the surface.
std::vector<Ball> pointsInside(const std::vector<Facet>& facets, const glm::dvec3& size) {
  constexpr int kAcross = 28;
  const double step = std::cbrt(size.x * size.y * size.z) / kAcross;
  const int columns = static_cast<int>(std::ceil(size.x / step)),
            rows = static_cast<int>(std::ceil(size.z / step));
  std::vector<Ball> inside;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      // Off the lines on which made meshes have their edges.
      const glm::dvec3 foot((column + 0.4871) / columns * size.x - 0.5 * size.x, -1,
                            (row + 0.5133) / rows * size.z - 0.5 * size.z);
      std::vector<double> crossings;
      for (const Facet& facet : facets)
        if (const auto at = meeting(facet, foot, {0, 1, 0})) crossings.push_back(*at - 1);
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const int count = static_cast<int>((crossings[i + 1] - crossings[i]) / step);
        for (int k = 0; k < count; ++k)
          inside.push_back(
              {{foot.x, crossings[i] + (k + 0.5) / count * (crossings[i + 1] - crossings[i]), foot.z}, 0});
      }
    }
  return inside;
}

/// Balls in the order in which they fill the body best: each stands where the distance to the surface and to
/// those before it is greatest.
std::vector<Ball> ballsIn(const std::vector<Facet>& facets, const glm::dvec3& size) {
  constexpr std::size_t kMostBalls = 1500;
  std::vector<Ball> points = pointsInside(facets, size), balls;
  for (Ball& point : points) {
    point.radius = 1;
    for (const Facet& facet : facets) point.radius = std::min(point.radius, distanceTo(facet, point.center));
  }
  std::vector<double> room;
  for (const Ball& point : points) room.push_back(point.radius);
  while (balls.size() < std::min(kMostBalls, points.size())) {
    const auto widest = std::max_element(room.begin(), room.end());
    if (!(*widest > 0)) break;
    const Ball ball = points[static_cast<std::size_t>(widest - room.begin())];
    balls.push_back(ball);
    for (std::size_t i = 0; i < points.size(); ++i)
      room[i] = std::min(room[i], glm::distance(points[i].center, ball.center) - 0.3 * ball.radius);
    *widest = 0;
  }
  return balls;
}

std::shared_ptr<const Body> bodyOf(const std::vector<base::Mesh>& meshes) {
  glm::dvec3 lower(1e300), upper(-1e300);
  for (const glm::dvec3& point : meshes.front().points)
    lower = glm::min(lower, point), upper = glm::max(upper, point);
  const auto body = std::make_shared<Body>();
  body->size = upper - lower;
  const glm::dvec3 foot(0.5 * (lower.x + upper.x), lower.y, 0.5 * (lower.z + upper.z));
  for (const base::Mesh& mesh : meshes) body->levels.push_back(facetsOf(mesh, foot));
  for (const auto& level : body->levels)
    if (level.size() < 800 || &level == &body->levels.back()) {
      body->balls = ballsIn(level, body->size);
      break;
    }
  return body;
}

double longestEdge(const Facet& facet, int& at) {
  double longest = -1;
  for (int i = 0; i < 3; ++i) {
    const double length = glm::distance(facet.corners[static_cast<std::size_t>(i)],
                                        facet.corners[static_cast<std::size_t>((i + 1) % 3)]);
    if (length > longest) longest = length, at = i;
  }
  return longest;
}

/// Halves the facets of the longest edges until there are `count`.
std::vector<Facet> dividedTo(std::vector<Facet> facets, std::size_t count) {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry> longest;
  int edge = 0;
  for (std::size_t i = 0; i < facets.size(); ++i) longest.emplace(longestEdge(facets[i], edge), i);
  while (facets.size() < count) {
    const std::size_t i = longest.top().second;
    longest.pop();
    longestEdge(facets[i], edge);
    Facet other = facets[i];
    const auto from = static_cast<std::size_t>(edge), to = static_cast<std::size_t>((edge + 1) % 3);
    const glm::dvec3 middle = 0.5 * (other.corners[from] + other.corners[to]);
    facets[i].corners[to] = middle;
    other.corners[from] = middle;
    facets.push_back(other);
    longest.emplace(longestEdge(facets[i], edge), i);
    longest.emplace(longestEdge(other, edge), facets.size() - 1);
  }
  return facets;
}

/// The ellipsoid of a triangle (Jimenez de Parga 2018): at its barycentre, the distances to the corners as
/// radii, its long axis turned to the farthest corner and its short one to the outside. It is drawn inwards,
/// so that the cloud is as large as the mesh.
Puff puffOn(const Facet& facet, double softness) {
  const glm::dvec3 middle = barycentre(facet), normal = outward(facet);
  std::array<glm::dvec3, 3> to;
  for (std::size_t i = 0; i < 3; ++i) to[i] = facet.corners[i] - middle;
  std::sort(to.begin(), to.end(),
            [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, a) > glm::dot(b, b); });
  const double longest = glm::length(to[0]);
  const glm::dvec3 along = longest > 0 ? to[0] / longest : glm::dvec3(1, 0, 0);
  const glm::dmat3 axes(along, glm::cross(normal, along), normal);
  const double least = 0.25 * longest;
  const double behind = std::max(0.2 * facet.thickness, softness * 0.5 * least);
  Puff puff;
  puff.sigma = glm::vec3(softness * longest, softness * std::max(least, glm::length(to[1])),
                         std::min(softness * std::max(least, glm::length(to[2])), behind));
  puff.rotation = glm::quat(glm::normalize(glm::quat_cast(axes)));
  puff.center = middle - normal * std::min(1.3 * puff.sigma.z, 0.35 * facet.thickness);
  return puff;
}

RawShape shaped(const Body& body, const Recipe& recipe, const ShapeRequest& request) {
  constexpr double kSoftness = 0.55, kBallSoftness = 0.5;
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const double across = request.widthMeters / std::sqrt(body.size.x * body.size.z),
               up = request.depthMeters / body.size.y;
  const glm::dvec3 scale(across, up, across);
  const double fair = std::cbrt(across * across * up);
  const auto inSurface = static_cast<std::size_t>(std::max(4.0, kSurfaceShare * request.puffs));
  const auto level = std::find_if(body.levels.begin(), body.levels.end() - 1,
                                  [&](const auto& facets) { return facets.size() <= inSurface; });
  std::vector<Facet> facets = *level;
  for (Facet& facet : facets) {
    const glm::dvec3 behind = outward(facet) * facet.thickness * scale;
    for (glm::dvec3& corner : facet.corners) corner *= scale;
    facet.thickness = glm::length(behind);
  }
  facets = dividedTo(std::move(facets), inSurface);

  RawShape shape;
  const double noiseScale = 5 / request.widthMeters;
  for (const Facet& facet : facets) {
    Puff puff = puffOn(facet, kSoftness);
    // Billows as on a cauliflower, wisps where the noise is low.
    const glm::dvec3 at(puff.center);
    const double bulge = 2.2 * (base::billowNoise(at * noiseScale, 3, request.variant) - 0.7);
    const double dryness = base::fractalNoise(at * noiseScale * 1.6, 3, request.variant + 29);
    puff.center +=
        glm::vec3(outward(facet) * (bulge * std::min(0.09 * request.widthMeters, 0.3 * facet.thickness)));
    puff.sigma *= static_cast<float>(fills.uniform(0.8, 1.2));
    const double density = std::clamp(1.0 + recipe.raggedness * (1.6 * dryness - 0.15), 0.2, 1.5);
    puff.extinctionPerMeter = static_cast<float>(density / puff.sigma.z);
    shape.puffs.push_back(puff);
  }
  const std::size_t inBody =
      std::min(body.balls.size(), static_cast<std::size_t>((1 - kSurfaceShare) * std::max(0, request.puffs)));
  for (std::size_t i = 0; i < inBody; ++i) {
    const Ball& ball = body.balls[i];
    Puff puff;
    puff.center = ball.center * scale;
    puff.sigma = glm::vec3(kBallSoftness * ball.radius * scale);
    puff.extinctionPerMeter = static_cast<float>(1.3 / (kBallSoftness * ball.radius * fair));
    shape.puffs.push_back(puff);
  }
  return shape;
}

}  // namespace

FileShape shapeFromMesh(const base::Mesh& mesh, const std::string& where) {
  const auto body = bodyOf(simplifiedSolids(mesh, kMostTriangles, where));
  FileShape shape;
  shape.kind = "mesh";
  shape.widthOverDepth = std::sqrt(body->size.x * body->size.z) / body->size.y;
  shape.shape = [body](const Recipe& recipe, const ShapeRequest& request) {
    // So few facets would be long and stick out: a finer shape is merged.
    constexpr int kFewest = 300;
    if (request.puffs >= kFewest) return shaped(*body, recipe, request);
    ShapeRequest finer = request;
    finer.puffs = kFewest;
    return RawShape{reduce(shaped(*body, recipe, finer).puffs, std::max(1, request.puffs)), {}};
  };
  return shape;
}

}  // namespace cloudgen::shape
