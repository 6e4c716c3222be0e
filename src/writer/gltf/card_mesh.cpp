// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/card_mesh.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "shape/blending.hpp"

namespace cloudgen::writer::gltf {
namespace {

constexpr float kSpriteReach = 2.2f;  ///< half-side of a sprite, in its standard deviations
/// Of the sprite's Gaussian within its border: erf(2.2 / sqrt 2) squared.
constexpr float kWithinBorder = 0.9451f;
/// Upright cards, two of them met by a level look.
constexpr float kUprightShare = 0.5f;
constexpr int kCells = 2;

/// One card of a puff.
struct Plane {
  int right = 0, up = 1;  ///< axes of the puff
  float opticalDepth = 0, widening = 1;
};

/// The three cards of a puff: facing its z, facing its x, lying. From straight above they hold together what
/// the puff holds; the share of those that stand is what a leaning one shows upwards.
std::array<Plane, 3> planesOf(const shape::Puff& puff, float opticalDepthFactor) {
  constexpr float kCovering = 0.07f;  // few overlap
  std::array<Plane, 3> planes{{{0, 1}, {2, 1}, {0, 2}}};
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  const auto shownUpwards = [&](const Plane& plane) {
    const int normal = 3 - plane.right - plane.up;
    return puff.sigma[plane.right] * puff.sigma[plane.up] * std::abs(axes[normal].y);
  };
  Plane& lying = *std::ranges::max_element(planes, {}, [&](const Plane& plane) {
    return std::abs(axes[3 - plane.right - plane.up].y);
  });
  double left = opticalDepthFactor * shape::extinctionArea(puff) / (2 * std::numbers::pi * kWithinBorder);
  for (Plane& plane : planes) {
    if (&plane == &lying) continue;
    plane.opticalDepth = kUprightShare * opticalDepthFactor * shape::frontalOpticalDepth(puff);
    left -= static_cast<double>(plane.opticalDepth * shownUpwards(plane));
  }
  const float whole = static_cast<float>(left) / shownUpwards(lying);
  lying.widening = shape::blendedWidening(whole, kCovering);
  lying.opticalDepth = whole / (lying.widening * lying.widening);
  return planes;
}

/// The colour of the light at a place: of the archetype's puffs, weighted by how much of each is there.
/// `fallback` has a small weight everywhere.
glm::vec3 lightAt(const scene::Archetype& archetype, const scene::LitArchetype& lit, glm::vec3 place,
                  float blurMeters, glm::vec3 fallback) {
  glm::vec3 sum = 1e-3f * fallback;
  float weights = 1e-3f;
  for (std::size_t i = 0; i < lit.puffs.size(); ++i) {
    const shape::Puff& puff = archetype.puffs[i];
    const glm::vec3 offset = (puff.center - place) / blurMeters;
    const float weight = shape::frontalOpticalDepth(puff) * std::exp(-0.5f * glm::dot(offset, offset));
    sum += weight * lit.puffs[i].color;
    weights += weight;
  }
  return sum / weights;
}

std::uint16_t toShort(float unit) {
  return static_cast<std::uint16_t>(std::lround(65535.0f * glm::clamp(unit, 0.0f, 1.0f)));
}

}  // namespace

CardMesh cardsOf(const scene::Archetype& archetype, const scene::LitArchetype& lit, float opticalDepthFactor,
                 const image::SpriteAtlas& atlas) {
  CardMesh mesh;
  for (std::size_t p = 0; p < archetype.farPuffs.size(); ++p) {
    const shape::Puff& puff = archetype.farPuffs[p];
    const glm::mat3 axes = glm::mat3_cast(puff.rotation);
    const glm::vec4 box = atlas.textureBox(puff.sprite % atlas.tiles());
    const float blurMeters = 0.7f * std::cbrt(puff.sigma.x * puff.sigma.y * puff.sigma.z);
    for (const auto& [right, up, opticalDepth, widening] : planesOf(puff, opticalDepthFactor)) {
      const float alpha = -std::expm1(-opticalDepth), reach = kSpriteReach * widening;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
      for (int row = 0; row <= kCells; ++row)
        for (int column = 0; column <= kCells; ++column) {
          const float u = static_cast<float>(column) / kCells, v = static_cast<float>(row) / kCells;
          const glm::vec3 place =
              puff.center + reach * ((2 * u - 1) * puff.sigma[right] * axes[right] +
                                     (2 * v - 1) * puff.sigma[up] * axes[up]);
          mesh.positions.insert(mesh.positions.end(), {place.x, place.y, place.z});
          mesh.textureBoxes.insert(mesh.textureBoxes.end(),
                                   {glm::mix(box.x, box.z, u), 1 - glm::mix(box.y, box.w, v)});
          // Light of the puff's inside: half-way out, where the card is seen.
          const glm::vec3 color =
              lightAt(archetype, lit, glm::mix(puff.center, place, 0.5f), blurMeters, lit.farPuffs[p].color);
          mesh.colors.insert(mesh.colors.end(),
                             {toShort(color.x), toShort(color.y), toShort(color.z), toShort(alpha)});
          mesh.opticalDepths.push_back(opticalDepth);
        }
      for (std::uint32_t row = 0; row < kCells; ++row)
        for (std::uint32_t column = 0; column < kCells; ++column) {
          const std::uint32_t a = first + row * (kCells + 1) + column, b = a + 1, c = a + kCells + 1,
                              d = c + 1;
          mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    }
  }
  return mesh;
}

}  // namespace cloudgen::writer::gltf
