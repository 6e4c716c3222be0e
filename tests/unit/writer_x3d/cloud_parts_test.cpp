// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "shape/heights.hpp"
#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

std::vector<CloudPart> fullParts(const scene::Scene& scene, const CloudLook& look) {
  return partsOf(scene, look, CloudDetail::Full, shape::kCoveringAmongMany,
                 image::SpriteAtlas{scene.archetypes[0].genus, "sprites.png", "", "", 4, 4, 128});
}

/// Optical depth times area of all quads.
double extinctionOf(const std::vector<CloudPart>& parts) {
  double sum = 0;
  for (const CloudPart& part : parts)
    for (const Quad& quad : part.mesh.quads)
      sum += static_cast<double>(quad.opticalDepth) * glm::length(quad.right) * glm::length(quad.up);
  return sum;
}

/// A cloud of flat puffs side by side, all at one height.
scene::Scene flatCloud(int puffs) {
  scene::Scene scene = test::smallScene();
  scene::Archetype& archetype = scene.archetypes[scene.lit[0].archetype];
  archetype.puffs.clear();
  for (int i = 0; i < puffs; ++i) {
    shape::Puff puff;
    puff.center = {900.0f * static_cast<float>(i), 500, 0};
    puff.sigma = {1000, 150, 1000};
    puff.extinctionPerMeter = 1e-3f;
    archetype.puffs.push_back(puff);
  }
  archetype.sectionStart = {0, static_cast<std::uint32_t>(puffs)};
  return scene;
}

TEST(CloudParts, ADenserCloudOfTheSameShapeIsDrawnDenser) {
  const scene::Scene scene = flatCloud(10);
  const double once = extinctionOf(fullParts(scene, {0, 1, 1}));
  EXPECT_GT(once, 0);
  EXPECT_NEAR(extinctionOf(fullParts(scene, {0, 1, 1.7f})), 1.7 * once, 1e-3 * once);
}

TEST(CloudParts, LevelQuadsBeginAndEndWhereFlatPuffsDo) {
  for (const int puffs : {1, 2, 5, 12, 41}) {
    const scene::Scene scene = flatCloud(puffs);
    std::vector<float> heights;
    for (const CloudPart& part : fullParts(scene, {}))
      for (const Quad& quad : part.mesh.quads) heights.push_back(part.center.y + quad.center.y);
    const auto [lowest, highest] = std::ranges::minmax(heights);
    const auto& source = scene.archetypes[scene.lit[0].archetype].puffs;
    EXPECT_NEAR(lowest, shape::heightOfShare(source, 0.05), 40) << puffs;
    EXPECT_NEAR(highest, shape::heightOfShare(source, 0.95), 40) << puffs;
  }
}

TEST(CloudParts, WhatIsWidenedToCoverAsPuffsDoStillHasTheirExtinction) {
  scene::Scene scene = flatCloud(10);
  const double thin = extinctionOf(fullParts(scene, {}));
  for (shape::Puff& puff : scene.archetypes[scene.lit[0].archetype].puffs) puff.extinctionPerMeter *= 40;
  const auto dense = fullParts(scene, {});
  EXPECT_NEAR(extinctionOf(dense), 40 * thin, 1e-3 * 40 * thin);
  for (const CloudPart& part : dense)
    for (const Quad& quad : part.mesh.quads)
      EXPECT_NEAR(glm::length(quad.right) / image::kSpriteReach / quad.widening, 1000, 1);
}

}  // namespace
}  // namespace cloudgen::writer
