// SPDX-License-Identifier: Apache-2.0
// What slanted rays and cameras on the ground see of blobs that are known by hand.
#include "check/fidelity/slants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/thread.hpp"
#include "check/fidelity/sky_camera.hpp"
#include "unit/check/made_model.hpp"

namespace cloudgen::check::test {
namespace {

const base::LocalFrame kFrame({10, 50, 10.4, 50.3});

WrittenScene sceneOf(std::vector<Blob> blobs) {
  WrittenScene scene{"made", "splats", {}, {}, {}, 0};
  scene.blobs = std::move(blobs);
  return scene;
}

glm::vec3 middle(double height) { return glm::vec3(kFrame.toScene(10.2, 50.15, height)); }

glm::mat3 turned(const glm::vec3& sigma) {
  glm::mat3 axes = glm::mat3_cast(glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 0.4f, -0.5f))));
  for (int i = 0; i < 3; ++i) axes[i] *= sigma[i];
  return axes;
}

/// The optical depth of a blob along a line, step by step.
double alongLine(const glm::vec3& center, const glm::mat3& axes, double frontal, const glm::dvec3& point,
                 const glm::dvec3& direction) {
  const double shortest = glm::length(axes[1]);
  const double extinction = frontal / (std::sqrt(2 * std::numbers::pi) * shortest);
  double depth = 0;
  for (double at = -3000; at < 3000; at += 2) {
    const glm::dvec3 deviations =
        glm::inverse(glm::dmat3(axes)) * (point + at * direction - glm::dvec3(center));
    depth += 2 * extinction * std::exp(-0.5 * glm::dot(deviations, deviations));
  }
  return depth;
}

TEST(Footprint, OfASlantedViewIsTheIntegralAlongItsRays) {
  const glm::vec3 center(300, 1200, -500);
  const glm::mat3 axes = turned({200, 60, 120});
  for (const double zenith : {0.0, 30.0, 60.0})
    for (const double azimuth : {45.0, 190.0}) {
      const View view = viewFrom(zenith, azimuth, 800);
      const Footprint footprint = footprintOf(volumeBlob(center, axes, 3), {}, view);
      for (const glm::vec2 off : {glm::vec2(0), glm::vec2(80, -40), glm::vec2(-150, 90)}) {
        const glm::vec2 deviations = footprint.toDeviations * off;
        const double told = footprint.opticalDepth * std::exp(-0.5 * glm::dot(deviations, deviations));
        const glm::dvec3 point(footprint.place.x + off.x, 800, footprint.place.y + off.y);
        EXPECT_NEAR(told, alongLine(center, axes, 3, point, view.toViewer), 0.005 * footprint.opticalDepth)
            << zenith << " " << azimuth;
      }
    }
}

TEST(Slants, VolumesKeepTheirOpticalDepthAndShowTheirSides) {
  std::vector<Blob> blobs;
  for (int i = 0; i < 40; ++i)
    blobs.push_back(volumeBlob(middle(1000 + 300 * (i % 5)) + glm::vec3(500 * (i % 8), 0, 700 * (i / 8)),
                               turned({150, 250, 150}), 4));
  const Slants slants = lookAslant(sceneOf(blobs), kFrame, {});
  EXPECT_TRUE(slants.volumes);
  ASSERT_EQ(slants.slanted.size(), 2u);
  for (const SlantedView& view : slants.slanted) {
    EXPECT_NEAR(view.opticalDepth / slants.vertical.opticalDepth, 1, 0.05) << view.zenithDegrees;
    EXPECT_GT(view.cover, slants.vertical.cover);
  }
  EXPECT_GT(slants.slanted[1].cover, slants.slanted[0].cover);
}

TEST(Slants, TheBoxHasNoBorders) {
  // High clouds in its corner are cast far outside.
  const glm::dvec2 lower = kFrame.lowerCorner();
  const Slants slants =
      lookAslant(sceneOf({volumeBlob({lower.x + 100, 12000, lower.y + 100}, glm::mat3(900), 5)}), kFrame, {});
  for (const SlantedView& view : slants.slanted)
    EXPECT_NEAR(view.opticalDepth / slants.vertical.opticalDepth, 1, 0.1) << view.zenithDegrees;
}

TEST(Slants, LevelCardsAreThinnerFromBesideAndTurningOnesAreNot) {
  WrittenScene level = sceneOf({cardBlob(middle(2000), {2000, 0, 0}, {0, 0, -2000}, 2)});
  const Slants flat = lookAslant(level, kFrame, {});
  EXPECT_FALSE(flat.volumes);
  EXPECT_NEAR(flat.slanted[1].opticalDepth / flat.vertical.opticalDepth, 0.5, 0.03);
  EXPECT_NEAR(flat.slanted[1].cover / flat.vertical.cover, 1, 0.03);

  WrittenScene turning = sceneOf({cardBlob({}, {2000, 0, 0}, {0, 2000, 0}, 2)});
  turning.blobs[0].kind = BlobKind::Turning;
  turning.pivots.push_back({middle(2000), 1});
  const Slants round = lookAslant(turning, kFrame, {});
  EXPECT_NEAR(round.slanted[1].opticalDepth / round.vertical.opticalDepth, 1, 0.05);
  EXPECT_NEAR(round.slanted[1].cover / round.vertical.cover, 2, 0.08);
}

TEST(Slants, OneThreadSaysWhatManySay) {
  const MadeSky sky;
  const auto told = [&] {
    std::vector<double> numbers;
    for (const SlantedView& view : lookAslant(sky.scene, sky.frame, {}).slanted)
      numbers.insert(numbers.end(), {view.cover, view.opticalDepth});
    for (const SkyReport& report : lookUp(sky.scene, sky.frame, {}, {})) numbers.push_back(report.skyCover);
    return numbers;
  };
  const auto many = told();
  const base::ThreadLimit limit(1);
  EXPECT_EQ(told(), many);
}

TEST(SkyCamera, SaysOctasAsObserversDo) {
  EXPECT_EQ(octasOf(0), 0);
  EXPECT_EQ(octasOf(0.01), 1) << "a trace is one";
  EXPECT_EQ(octasOf(0.5), 4);
  EXPECT_EQ(octasOf(0.99), 7) << "a gap makes seven";
  EXPECT_EQ(octasOf(1), 8);
}

TEST(SkyCamera, SeesClearAndOvercastSkies) {
  for (const SkyReport& report : lookUp(sceneOf({}), kFrame, {}, {})) EXPECT_EQ(report.skyCover, 0);
  std::vector<Blob> sheet;
  const glm::dvec2 lower = kFrame.lowerCorner(), size = kFrame.upperCorner() - lower;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column)
      sheet.push_back(
          volumeBlob({lower.x + size.x * (column + 0.5) / 20, 1500, lower.y + size.y * (row + 0.5) / 20},
                     glm::mat3(1500, 0, 0, 0, 100, 0, 0, 0, 1500), 2));
  for (const SkyReport& report : lookUp(sceneOf(sheet), kFrame, {}, {}))
    EXPECT_EQ(octasOf(report.skyCover), 8);
  WrittenScene above = sceneOf(sheet);
  above.groundMeters = 1600;
  for (const SkyReport& report : lookUp(above, kFrame, {}, {})) EXPECT_EQ(report.skyCover, 0);
}

TEST(SkyCamera, SeesACloudUnderItsAngle) {
  const auto cameras = lookUp(sceneOf({}), kFrame, {}, {});
  const glm::vec3 over(kFrame.toScene(cameras[0].longitudeDegrees, cameras[0].latitudeDegrees, 2000));
  const auto seen = lookUp(sceneOf({volumeBlob(over, glm::mat3(200), 5)}), kFrame, {}, {});
  const double radius = 200 * std::sqrt(2 * std::log(5 / kCloudyOpticalDepth)),
               angle = std::atan(radius / 2000),
               whole = 1 - std::cos(kSkyZenithDegrees * std::numbers::pi / 180);
  EXPECT_NEAR(seen[0].skyCover, (1 - std::cos(angle)) / whole, 0.02);
  EXPECT_LT(seen[5].skyCover, 0.01);
}

TEST(SkyCamera, IsComparedWithTheModelAroundIt) {
  const MadeSky sky;
  for (const SkyReport& report : lookUp(sky.scene, sky.frame, modelColumns(sky.model, sky.model.box()), {})) {
    EXPECT_GT(report.modelCover, 0.15);
    EXPECT_LT(report.modelCover, 0.55);
    EXPECT_GT(report.skyCover, 0.05);
  }
}

}  // namespace
}  // namespace cloudgen::check::test
