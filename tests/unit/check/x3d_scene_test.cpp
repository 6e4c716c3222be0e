// SPDX-License-Identifier: Apache-2.0
// Scenes of X3D as a viewer high above draws them.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "check/fidelity/written_scene.hpp"
#include "good_scene.hpp"

namespace cloudgen::check::test {
namespace {

/// A square card of 44 m in the xy-plane (or, level, in the xz-plane) with an opacity.
std::string card(const std::string& index, double alpha, bool level = false, const std::string& beside = {}) {
  const std::string points =
      level ? "-22 0 22 22 0 22 22 0 -22 -22 0 -22" : "-22 -22 0 22 -22 0 22 22 0 -22 22 0";
  std::string colors;
  for (int i = 0; i < 4; ++i) colors += "1 1 1 " + std::to_string(alpha) + " ";
  return "<Shape><Appearance DEF='Look_Cu'><ImageTexture url='\"textures/cumulus.png\"'/></Appearance>"
         "<IndexedTriangleSet index='" +
         index + "'>" + beside + "<ColorRGBA color='" + colors + "'/><Coordinate point='" + points +
         "'/></IndexedTriangleSet></Shape>";
}

WrittenScene read(const std::string& nodes) {
  return readX3dScene("<X3D profile='Immersive' version='4.0'><Scene>" + nodes + "</Scene></X3D>",
                      "test.x3d");
}

/// What a viewer high above sees.
std::vector<Footprint> seen(const std::string& nodes, const View& view = {}) {
  const WrittenScene scene = read(nodes);
  return footprintsOf(scene.blobs, scene.pivots, view);
}

const std::string kFront = "0 1 2 0 2 3", kBack = "0 2 1 0 3 2";

TEST(X3dScene, ABillboardTurnsToTheViewer) {
  const auto footprints = seen(
      "<Transform translation='1000 500 -2000' scale='2 2 2'><Transform translation='0 50 0'>"
      "<Billboard axisOfRotation='0 0 0'><Transform translation='10 20 5'>" +
      card(kFront, 0.5) + "</Transform></Billboard></Transform></Transform>");
  ASSERT_EQ(footprints.size(), 1u);
  const Footprint& footprint = footprints.front();
  // Its x axis lies east, its y axis north; the heights are those seen from beside.
  EXPECT_FLOAT_EQ(footprint.place.x, 1020);
  EXPECT_FLOAT_EQ(footprint.place.y, -2040);
  EXPECT_FLOAT_EQ(footprint.height, 640);
  EXPECT_NEAR(footprint.heightDeviation, 20, 1e-3);
  EXPECT_NEAR(footprint.halfSides().x, 44, 1e-2);
  EXPECT_NEAR(footprint.opticalDepth, std::log(2.0), 1e-5);
}

TEST(X3dScene, UprightCardsAreNotSeenAndLevelOnesAreFromTheirFront) {
  EXPECT_EQ(seen(card(kFront, 0.5)).size(), 0u);
  EXPECT_EQ(seen(card(kFront, 0.5, true)).size(), 1u);
  EXPECT_EQ(seen(card(kBack, 0.5, true)).size(), 0u);
  EXPECT_EQ(seen(card(kFront + " " + kBack, 0.5, true)).size(), 1u);
  EXPECT_EQ(seen("<Transform rotation='1 0 0 3.14159'>" + card(kBack, 0.5, true) + "</Transform>").size(),
            1u);
}

TEST(X3dScene, OnlyTheNearLevelCountsAndNamesAreFollowed) {
  const auto footprints = seen(
      "<LOD DEF='Cloud'><Group>" + card(kFront, 0.2, true) + "</Group><Group>" + card(kFront, 0.9, true) +
      "</Group></LOD><Transform translation='100 0 0'><LOD USE='Cloud'/></Transform>");
  ASSERT_EQ(footprints.size(), 2u);
  EXPECT_FLOAT_EQ(footprints[1].place.x, 100);
  EXPECT_NEAR(footprints[1].opticalDepth, -std::log(0.8), 1e-5);
}

TEST(X3dScene, ReadsWhatACloudIs) {
  const WrittenScene scene = read(
      "<Transform translation='5 900 7'><MetadataSet name='cloud'><MetadataString name='id genus rule' "
      "value='\"42\" \"Sc\" \"low.rolls\"'/></MetadataSet>" +
      card(kFront, 0.5, true) + "</Transform>");
  ASSERT_EQ(scene.clouds.size(), 1u);
  EXPECT_EQ(scene.clouds[0].recorded, base::Genus::Stratocumulus);
  EXPECT_EQ(scene.clouds[0].drawn, base::Genus::Cumulus);
  EXPECT_FLOAT_EQ(scene.clouds[0].foot.y, 900);
}

TEST(X3dScene, OpaqueCardsHideHowDenseTheyAre) {
  const WrittenScene scene = read(card(kFront, 1, true));
  EXPECT_EQ(scene.saturated, 1u);
  EXPECT_NEAR(scene.blobs.front().strength, 7.6, 0.1);
  // Where finer opacities are told apart, 1 is more than each of them.
  const WrittenScene fine = read(card(kFront, 1, true) + card(kFront, 0.9999, true));
  EXPECT_EQ(fine.saturated, 1u);
  EXPECT_NEAR(fine.blobs[0].strength, 9.2, 0.1);
}

TEST(X3dScene, TheOpticalDepthBesideAnOpaqueCardCountsWhereItIsThatOpaque) {
  const auto told = [](double alpha, const std::string& stated) {
    return read(card(kFront, alpha, true, "<MetadataFloat name='optical_depth' value='" + stated + "'/>"));
  };
  EXPECT_EQ(told(0.99999, "31.5").saturated, 0u);
  EXPECT_FLOAT_EQ(told(0.99999, "31.5").blobs.front().strength, 31.5);
  // Halved in its opacity alone, or told of another thinner card: the eye decides.
  EXPECT_NEAR(told(0.5, "31.5").blobs.front().strength, std::log(2), 1e-5);
  EXPECT_NEAR(told(0.9, "0").blobs.front().strength, std::log(10), 1e-5);
}

TEST(X3dScene, OtherShapesAreNoClouds) { EXPECT_TRUE(readX3dScene(goodScene(), "good.x3d").blobs.empty()); }

TEST(X3dScene, RefusesWhatItCannotRead) {
  EXPECT_THROW(seen("<Group>"), base::InputError);
  EXPECT_THROW(seen(card("0 1 2 0 2 5", 0.5, true)), base::InputError);
  EXPECT_THROW(seen(card("0 1 -2", 0.5, true)), base::InputError);
  std::string nested = "<Group DEF='G0'>" + card(kFront, 0.5, true) + "</Group>";
  for (int i = 0; i < 500; ++i)
    nested += "<Group DEF='G" + std::to_string(i + 1) + "'><Group USE='G" + std::to_string(i) + "'/></Group>";
  EXPECT_THROW(seen(nested), base::InputError) << "deep nesting";
  std::string doubled = "<Group DEF='D0'>" + card(kFront, 0.5, true) + "</Group>";
  for (int i = 0; i < 60; ++i)
    doubled += "<Group DEF='D" + std::to_string(i + 1) + "'><Group USE='D" + std::to_string(i) +
               "'/><Group USE='D" + std::to_string(i) + "'/></Group>";
  EXPECT_THROW(seen(doubled), base::InputError) << "exponential growth";
  EXPECT_EQ(seen("<Group DEF='Self'><Group USE='Self'/>" + card(kFront, 0.5, true) + "</Group>").size(), 1u)
      << "a node cannot hold itself";
}

}  // namespace
}  // namespace cloudgen::check::test
