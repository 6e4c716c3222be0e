// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/quads.hpp"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "light/color.hpp"
#include "support/small_scene.hpp"
#include "writer/x3d/viewpoints.hpp"

namespace cloudgen::writer {
namespace {

const image::SpriteAtlas kAtlas{
    .genus = base::Genus::Cumulus, .file = "cumulus.png", .columns = 4, .rows = 4, .tilePixels = 128};

LitPuff puffAt(const glm::vec3& center, const glm::vec3& sigma, float opticalDepth = 1) {
  LitPuff lit;
  lit.puff.center = center;
  lit.puff.sigma = sigma;
  lit.puff.extinctionPerMeter = opticalDepth / (sigma.y * std::sqrt(2 * 3.14159265f));
  return lit;
}

glm::vec3 frontOf(const Quad& quad) { return glm::normalize(glm::cross(quad.right, quad.up)); }

TEST(FacingQuads, LookAtTheViewerFromBackToFront) {
  const auto cloud = test::heap("Cu", base::Genus::Cumulus, 1500, 900, 3, 60);
  std::vector<LitPuff> puffs;
  for (const auto& puff : cloud.puffs) puffs.push_back({puff, glm::vec3(0.5f)});
  const QuadMesh mesh = facingQuads(puffs, glm::vec3(0), kAtlas);
  ASSERT_EQ(mesh.faces.size(), mesh.quads.size());
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    EXPECT_EQ(mesh.faces[i], 2 * i);
    EXPECT_NEAR(frontOf(mesh.quads[i]).z, 1, 1e-5);
    EXPECT_LE(mesh.quads[i > 0 ? i - 1 : 0].center.z, mesh.quads[i].center.z);
  }
}

TEST(FacingQuads, ShowTheEllipseOfATurnedPuff) {
  LitPuff lit = puffAt(glm::vec3(0), {100, 20, 20});
  lit.puff.rotation = glm::angleAxis(0.5f, glm::vec3(0, 0, 1));
  const QuadMesh mesh = facingQuads({lit}, glm::vec3(0), kAtlas);
  ASSERT_EQ(mesh.quads.size(), 1u);
  EXPECT_NEAR(glm::length(mesh.quads[0].right) / glm::length(mesh.quads[0].up), 5, 1e-3);
  EXPECT_NEAR(std::atan2(mesh.quads[0].right.y, mesh.quads[0].right.x), 0.5, 1e-4);
}

TEST(FacingQuads, OpacityFollowsOpticalDepth) {
  const auto mesh = facingQuads({puffAt(glm::vec3(0), glm::vec3(50), 1.0f)}, glm::vec3(0), kAtlas);
  // What the sprite, a Gaussian cut at 2.2 deviations all around, shows of it over all of the quad is the whole puff.
  const double side = glm::length(mesh.quads[0].right) / 2.2,
               shown = 1 - std::exp(-0.5 * 2.2 * 2.2);
  EXPECT_NEAR(-std::log1p(-mesh.quads[0].color.a) * side * side * shown, 50.0 * 50.0, 5);
  EXPECT_TRUE(facingQuads({puffAt(glm::vec3(0), glm::vec3(50), 0.001f)}, glm::vec3(0), kAtlas).quads.empty());
}

TEST(CrossedQuads, ARoundPuffHasThreeCardsAFlatOneOne) {
  EXPECT_EQ(crossedQuads({puffAt(glm::vec3(0), glm::vec3(50))}, glm::vec3(0), kAtlas).quads.size(), 3u);
  const QuadMesh flat = crossedQuads({puffAt(glm::vec3(0), {500, 50, 400})}, glm::vec3(0), kAtlas);
  ASSERT_EQ(flat.quads.size(), 1u);
  EXPECT_NEAR(std::abs(frontOf(flat.quads[0]).y), 1, 1e-5);
}

/// Optical depth times area that level quads show from straight above.
double shownFromAbove(const QuadMesh& mesh) {
  const double withinBorder = 1 - std::exp(-0.5 * 2.2 * 2.2);
  double sum = 0;
  for (const Quad& quad : mesh.quads) {
    const double area = std::abs(glm::cross(quad.right, quad.up).y) / (2.2 * 2.2);
    if (std::abs(frontOf(quad).y) >= 0.5) sum += withinBorder * quad.opticalDepth * 2 * 3.14159265 * area;
  }
  return sum;
}

TEST(CrossedQuads, FromAboveAPuffHoldsWhatItDoesHoweverTallOrTilted) {
  for (const glm::vec3& sigma : {glm::vec3(50), glm::vec3(80, 20, 60), glm::vec3(30, 90, 35), glm::vec3(70, 60, 20)})
    for (const float tilt : {0.0f, 0.4f, 0.75f, 1.2f}) {
      LitPuff lit = puffAt(glm::vec3(0), sigma);
      lit.puff.rotation = glm::angleAxis(tilt, glm::normalize(glm::vec3(1, 0.3f, 0.5f)));
      const double wanted = shape::extinctionArea(lit.puff);
      EXPECT_NEAR(shownFromAbove(crossedQuads({lit}, glm::vec3(0), kAtlas)), wanted, 1e-3 * wanted)
          << sigma.x << " " << sigma.y << " " << tilt;
    }
}

TEST(CrossedQuads, FromAboveHighCardsComeLastAndFromBelowLowOnes) {
  const QuadMesh mesh = crossedQuads(
      {puffAt({0, 300, 0}, {500, 50, 500}), puffAt({0, 100, 0}, {500, 50, 500})}, glm::vec3(0), kAtlas);
  std::vector<float> fromAbove, fromBelow;
  for (const std::uint32_t face : mesh.faces) {
    const Quad& quad = mesh.quads[face / 2];
    const float up = frontOf(quad).y * (face % 2 == 0 ? 1.0f : -1.0f);
    (up > 0 ? fromAbove : fromBelow).push_back(quad.center.y);
  }
  EXPECT_EQ(fromAbove, (std::vector<float>{100, 300}));
  EXPECT_EQ(fromBelow, (std::vector<float>{300, 100}));
}

TEST(Srgb, KnownValuesAndClamp) {
  const glm::vec3 encoded = light::srgbFromLinear({0.0f, 0.2140f, 3.0f});
  EXPECT_FLOAT_EQ(encoded.x, 0);
  EXPECT_NEAR(encoded.y, 0.5, 1e-3);
  EXPECT_FLOAT_EQ(encoded.z, 1);
  EXPECT_NEAR(light::srgbFromLinear(glm::vec3(0.001f)).x, 0.01292, 1e-6);
}

TEST(Viewpoints, LookAtTheirTargets) {
  const scene::Scene scene = test::smallScene();
  const auto views = viewsOf(scene, stageOf(scene));
  EXPECT_EQ(views.size(), 4u);
  for (const View& view : views) {
    const glm::quat turn = glm::angleAxis(view.rotation.w, glm::vec3(view.rotation));
    const glm::vec3 looking = turn * glm::vec3(0, 0, -1), wanted = glm::normalize(view.target - view.eye);
    EXPECT_NEAR(glm::dot(looking, wanted), 1, 1e-5) << view.name;
    EXPECT_GE(view.eye.y, scene.groundHeightMeters) << view.name;
  }
}

}  // namespace
}  // namespace cloudgen::writer
