// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/plan_of_quads.hpp"

#include <algorithm>

#include "shape/blending.hpp"

namespace cloudgen::writer {
namespace {

/// Of what covers, where flanks of neighbours meet. With half of it a sky covers .008 more than it does in splats, with
/// all of it .010 less (RUC, 3,000 puffs).
constexpr double kFlankShare = 2.0 / 3;

/// From above a part that has turned reaches as far to the north as it is high.
shape::PlanRaster rasterAround(std::span<const shape::Puff> puffs) {
  constexpr int kPixels = 64;
  const shape::Bounds bounds = shape::boundsOf(puffs, 4.5f);
  const float height = 0.5f * (bounds.upper.y - bounds.lower.y);
  return {{bounds.lower.x, bounds.lower.z - height}, {bounds.upper.x, bounds.upper.z + height}, kPixels};
}

}  // namespace

PlanOfQuads::PlanOfQuads(std::span<const shape::Puff> puffs) : raster_(rasterAround(puffs)) {}

void PlanOfQuads::add(const QuadMesh& mesh) {
  for (const Quad& quad : mesh.quads)
    add(quad, {quad.center.x, quad.center.z}, {quad.right.x, quad.right.z}, {quad.up.x, quad.up.z});
}

void PlanOfQuads::addTurning(const QuadMesh& mesh, const glm::vec3& origin) {
  for (const Quad& quad : mesh.quads)
    add(quad, {origin.x + quad.center.x, origin.z - quad.center.y}, {quad.right.x, -quad.right.y},
        {quad.up.x, -quad.up.y});
}

void PlanOfQuads::addBlended(std::span<const shape::Puff> puffs, float covering) {
  for (const shape::Puff& puff : puffs) {
    const shape::Puff blob = shape::widenedAcross(puff, covering);
    raster_.add(shape::planOf(blob), shape::BlendedProfile(shape::frontalOpticalDepth(blob)));
  }
}

double PlanOfQuads::coveredSquareMeters() const {
  std::ptrdiff_t covered = 0;
  for (const double share : {1.0, kFlankShare})
    covered += std::ranges::count_if(
        raster_.values(), [&](float depth) { return depth > share * shape::kCoveringOpticalDepth; });
  return 0.5 * static_cast<double>(covered) * raster_.pixel().x * raster_.pixel().y;
}

void PlanOfQuads::add(const Quad& quad, const glm::vec2& place, const glm::vec2& right, const glm::vec2& up) {
  constexpr double kLeastShown = 0.05;  // of its sides multiplied
  const double shown = std::abs(static_cast<double>(right.x) * up.y - static_cast<double>(right.y) * up.x);
  if (!(shown > kLeastShown * glm::length(quad.right) * glm::length(quad.up))) return;
  const glm::dvec2 r = glm::dvec2(right) / static_cast<double>(image::kSpriteReach),
                   u = glm::dvec2(up) / static_cast<double>(image::kSpriteReach);
  const double border = std::exp(-0.5 * image::kSpriteReach * image::kSpriteReach);
  const shape::BlendedProfile profile(quad.opticalDepth);
  raster_.add({place.x, place.y, r.x * r.x + u.x * u.x, r.x * r.y + u.x * u.y, r.y * r.y + u.y * u.y},
              [&](double gaussian) { return gaussian < border ? 0.0f : profile(gaussian); });
}

}  // namespace cloudgen::writer
