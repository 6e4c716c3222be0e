// SPDX-License-Identifier: Apache-2.0
// Scenes of X3D as a viewer high above draws them.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "good_scene.hpp"
#include "support/scratch.hpp"

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
    return read(
        card(kFront, alpha, true, "<MetadataFloat name='optical_depth narrowing' value='" + stated + "'/>"));
  };
  EXPECT_EQ(told(0.99999, "31.5 1").saturated, 0u);
  EXPECT_FLOAT_EQ(told(0.99999, "31.5 1").blobs.front().strength, 31.5);
  // Halved in its opacity alone, or told of another thinner card: the eye decides.
  EXPECT_NEAR(told(0.5, "31.5 1").blobs.front().strength, std::log(2), 1e-5);
  EXPECT_NEAR(told(0.9, "0 1").blobs.front().strength, std::log(10), 1e-5);
}

TEST(X3dScene, WhatIsNarrowerThanItsOpaqueCardHasTheSameExtinctionAndCover) {
  const auto cardOf = [](const std::string& stated) {
    return seen(card(kFront, 0.99999, true,
                     "<MetadataFloat name='optical_depth narrowing' value='" + stated + "'/>"))
        .front();
  };
  const Footprint wide = cardOf("20 1"), narrow = cardOf("20 0.7");
  const auto extinctionOf = [](const Footprint& footprint) {
    double sum = 0;
    for (int x = -30; x <= 30; ++x)
      for (int y = -30; y <= 30; ++y) sum += footprint.opticalDepthAt({x, y});
    return sum;
  };
  EXPECT_NEAR(extinctionOf(narrow), extinctionOf(wide), 0.01 * extinctionOf(wide));
  EXPECT_GT(narrow.opticalDepthAt({0, 0}), 1.8 * wide.opticalDepthAt({0, 0}));
  EXPECT_EQ(narrow.opacityShareAt({15, 5}), wide.opacityShareAt({15, 5}));
  // No card is wider than a multiple of what it stands for.
  EXPECT_GE(cardOf("20 0.001").narrowing, 0.3f);
}

/// Writes files into a folder of their own and reads the scene.x3d among them.
WrittenScene readFolder(const std::vector<std::pair<std::string, std::string>>& files) {
  const cloudgen::test::Scratch folder;
  for (const auto& [name, nodes] : files) {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    base::writeFile(folder.path() / name,
                    "<X3D profile='Immersive' version='4.0'><Scene>" + nodes + "</Scene></X3D>");
  }
  return readX3dScene(folder.path() / "scene.x3d", {});
}

TEST(X3dScene, ReadsTheFilesThatAreInlinedNearTheViewer) {
  const WrittenScene scene = readFolder(
      {{"scene.x3d", "<Transform translation='0 700 0'><LOD range='9'><Switch whichChoice='0'><Group>" +
                         card(kFront, 0.9, true) +
                         "</Group><Inline load='false' url='\"tiles/a.x3d\"'/></Switch></LOD></Transform>"
                         "<Inline DEF='A' url='\"tiles/a.x3d\"'/><LoadSensor><Inline USE='A'/></LoadSensor>"},
       {"tiles/a.x3d", card(kFront, 0.2, true) + "<Inline url='\"b.x3d\"'/>"},
       {"tiles/b.x3d", card(kFront, 0.3, true)}});
  ASSERT_EQ(scene.blobs.size(), 4u);
  EXPECT_FLOAT_EQ(scene.blobs[0].center.y, 700);
  EXPECT_NEAR(scene.blobs[0].opacity, 0.2, 1e-5);
  EXPECT_NEAR(scene.blobs[1].opacity, 0.3, 1e-5);
  EXPECT_FLOAT_EQ(scene.blobs[2].center.y, 0);
}

TEST(X3dScene, WhatIsDefinedWhereItIsWatchedIsDrawnWhereItIsUsed) {
  const WrittenScene scene =
      readFolder({{"scene.x3d",
                   "<LoadSensor><Inline DEF='A' load='false' url='\"a.x3d\"'/></LoadSensor>"
                   "<LOD range='9'><Switch whichChoice='0'><Group/><Inline USE='A'/></Switch><Group/></LOD>"},
                  {"a.x3d", card(kFront, 0.2, true)}});
  ASSERT_EQ(scene.blobs.size(), 1u);
  EXPECT_NEAR(scene.blobs[0].opacity, 0.2, 1e-5);
}

TEST(X3dScene, AFileIsChosenWithWhatStandsBesideIt) {
  const WrittenScene scene =
      readFolder({{"scene.x3d", "<Switch whichChoice='0'><Group>" + card(kFront, 0.9, true) +
                                    "</Group><Group><Inline url='\"a.x3d\"'/><Group/></Group></Switch>"},
                  {"a.x3d", card(kFront, 0.2, true)}});
  ASSERT_EQ(scene.blobs.size(), 1u);
  EXPECT_NEAR(scene.blobs[0].opacity, 0.2, 1e-5);
}

TEST(X3dScene, ASwitchShowsItsChoice) {
  const auto shown = [](const char* choice) {
    return read(std::string("<Switch whichChoice='") + choice + "'>" + card(kFront, 0.2) + card(kFront, 0.9) +
                "</Switch>")
        .blobs.size();
  };
  EXPECT_EQ(shown("1"), 1u);
  EXPECT_EQ(shown("-1"), 0u);
  EXPECT_EQ(shown("2"), 0u);
}

TEST(X3dScene, InlinesStayInTheirFolderAndEnd) {
  for (const char* url :
       {"../other/scene.x3d", "/etc/hostname", "https://example.org/a.x3d", "missing.x3d", ""})
    EXPECT_THROW(readFolder({{"scene.x3d", std::string("<Inline url='\"") + url + "\"'/>"}}),
                 base::InputError)
        << url;
  // One that inlines itself is there once.
  EXPECT_EQ(readFolder({{"scene.x3d", "<Inline url='\"a.x3d\"'/>"},
                        {"a.x3d", card(kFront, 0.2, true) + "<Inline url='\"a.x3d\"'/>"}})
                .blobs.size(),
            1u);
  std::vector<std::pair<std::string, std::string>> chain{{"scene.x3d", "<Inline url='\"0.x3d\"'/>"}};
  for (int i = 0; i < 40; ++i)
    chain.emplace_back(std::to_string(i) + ".x3d", "<Inline url='\"" + std::to_string(i + 1) + ".x3d\"'/>");
  EXPECT_THROW(readFolder(chain), base::InputError);
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
