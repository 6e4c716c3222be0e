// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/card_mesh.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "image/sprite_atlas.hpp"
#include "shape/blending.hpp"
#include "writer/gltf/splat.hpp"

namespace cloudgen::writer::gltf {
namespace {

/// Upright cards, two of them met by a level look.
constexpr float kUprightShare = 0.5f;

std::uint16_t toShort(float unit) {
  return static_cast<std::uint16_t>(std::lround(65535.0f * glm::clamp(unit, 0.0f, 1.0f)));
}

}  // namespace

std::array<Card, 3> cardsOf(const shape::Puff& puff, float opticalDepthFactor) {
  constexpr float kCovering = 0.07f;  // few overlap
  // (right, up) axes: facing the puff's z, facing its x, lying.
  constexpr std::array<std::pair<int, int>, 3> kPlanes{{{0, 1}, {2, 1}, {0, 2}}};
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  const auto upwards = [&](std::size_t plane) {
    return std::abs(axes[3 - kPlanes[plane].first - kPlanes[plane].second].y);
  };
  const auto shownUpwards = [&](std::size_t plane) {
    return puff.sigma[kPlanes[plane].first] * puff.sigma[kPlanes[plane].second] * upwards(plane);
  };
  std::size_t lying = 0;
  for (std::size_t plane = 1; plane < 3; ++plane)
    if (upwards(plane) > upwards(lying)) lying = plane;

  const float standing = kUprightShare * opticalDepthFactor * shape::frontalOpticalDepth(puff);
  double left = opticalDepthFactor * shape::extinctionArea(puff) / (2 * std::numbers::pi * image::kWithinSprite);
  std::array<Card, 3> cards;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const auto& [right, up] = kPlanes[plane];
    constexpr float reach = image::kSpriteReach;
    cards[plane] = {puff.center, reach * puff.sigma[right] * axes[right], reach * puff.sigma[up] * axes[up],
                    standing, plane != lying};
    if (plane != lying) left -= static_cast<double>(standing * shownUpwards(plane));
  }
  Card& flat = cards[lying];
  const float whole = static_cast<float>(left) / shownUpwards(lying);
  const float widening = shape::blendedWidening(whole, kCovering);
  flat.opticalDepth = whole / (widening * widening);
  flat.right *= widening;
  flat.up *= widening;
  return cards;
}

CardColumns addCardColumns(GlbFile& file, const CardMesh& mesh) {
  std::vector<std::uint16_t> textureBoxes;
  for (const float coordinate : mesh.textureBoxes) textureBoxes.push_back(toShort(coordinate));
  CardColumns columns;
  columns.attributes = {{"POSITION", file.addFloats(3, mesh.positions, true)},
                        {"TEXCOORD_0", file.addUnitShorts(2, textureBoxes)}};
  if (std::ranges::any_of(mesh.opticalDepths, [](float depth) { return depth > kOpaqueOpticalDepth; }))
    columns.attributes.emplace_back("_OPTICAL_DEPTH", file.addFloats(1, mesh.opticalDepths));
  columns.indices = file.addIndices(mesh.indices);
  return columns;
}

int addCardMesh(GlbFile& file, const std::string& name, const CardColumns& columns, const CardMesh& mesh,
                int material) {
  Attributes attributes = columns.attributes;
  attributes.emplace_back("COLOR_0", file.addUnitShorts(4, mesh.colors));
  return file.addMesh(
      name, {.attributes = std::move(attributes), .indices = columns.indices, .material = material});
}

}  // namespace cloudgen::writer::gltf
