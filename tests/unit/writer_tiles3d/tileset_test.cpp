// SPDX-License-Identifier: Apache-2.0
// What stands on the globe is where PROJ has it, and a validator that shares no code with the writer agrees.
#include <proj.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/gzip.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/tiles3d/read_tiles.hpp"
#include "check/tiles3d/validate_tileset.hpp"
#include "shape/blending.hpp"
#include "support/gltf_scene.hpp"
#include "support/moving_scene.hpp"
#include "support/scratch.hpp"
#include "writer/gltf/splat.hpp"
#include "writer/tiles3d/tiles3d.hpp"

namespace cloudgen::writer {
namespace {

using Json = nlohmann::json;

/// From the scene to Earth-fixed coordinates, by one PROJ pipeline of the frame's own definition.
class ByProj {
 public:
  explicit ByProj(const base::LocalFrame& frame) {
    std::string map = frame.definition();
    map = map.substr(0, map.find(" +type"));
    const auto proj = [](const std::string& text) { return proj_create(PJ_DEFAULT_CTX, text.c_str()); };
    map_ = proj(map);
    pipeline_ = proj("+proj=pipeline +step +inv " + map + " +step +proj=cart +ellps=WGS84");
    const PJ_COORD corner = proj_trans(
        map_, PJ_FWD, proj_coord(proj_torad(frame.box().west), proj_torad(frame.box().south), 0, 0));
    origin_ = {corner.xy.x, corner.xy.y};
  }
  ~ByProj() {
    proj_destroy(map_);
    proj_destroy(pipeline_);
  }
  glm::dvec3 operator()(const glm::dvec3& scene) const {
    const PJ_COORD there =
        proj_trans(pipeline_, PJ_FWD, proj_coord(origin_.x + scene.x, origin_.y - scene.z, scene.y, 0));
    return {there.xyz.x, there.xyz.y, there.xyz.z};
  }

 private:
  PJ *map_ = nullptr, *pipeline_ = nullptr;
  glm::dvec2 origin_{0};
};

std::string findingsOf(const std::filesystem::path& folder) {
  std::string out;
  for (const check::Finding& finding : check::validateTileset(folder / "tileset.json", {}, {}).findings)
    out += check::text(finding) + "\n";
  return out;
}

struct Box {
  const char* name;
  base::GeoBox box;
};

class TilesOnTheGlobe : public testing::TestWithParam<std::tuple<Box, TileContent>> {};

TEST_P(TilesOnTheGlobe, EveryPuffIsWithinAMeterOfTheModelsPlace) {
  const auto& [where, content] = GetParam();
  const scene::Scene scene = test::gltfScene(40, 4, where.box);
  const test::Scratch folder;
  writeTiles(scene, {.folder = folder.path(), .tiles = {content}});
  EXPECT_EQ(findingsOf(folder.path()), "") << where.name;

  std::vector<check::GlobeSplat> splats;
  check::readTiles(folder.path() / "tileset.json", {},
                   [&](const check::GlobeSplat& splat) { splats.push_back(splat); });
  const ByProj byProj(scene.frame);
  std::size_t visible = 0;
  double written = 0, expected = 0;
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& own : scene.archetypes[scene.lit[instance.lit].archetype].puffs) {
      const shape::Puff puff = scene::placed(scene, instance, own);
      if (gltf::splatOpacity(shape::widenedAcross(puff)) < gltf::kLeastOpacity) continue;
      ++visible;
      expected += shape::extinctionArea(puff);
      // What is too wide for CesiumJS is several splats around its place.
      if (content == TileContent::Packed && puff.sigma.x > 100) continue;
      const glm::dvec3 earth = byProj(puff.center);
      EXPECT_TRUE(std::ranges::any_of(splats, [&](const check::GlobeSplat& splat) {
        return glm::distance(splat.center, earth) < 1;
      })) << where.name;
    }
  if (content == TileContent::Splats) {
    EXPECT_EQ(splats.size(), visible);
  }
  for (const check::GlobeSplat& splat : splats) {
    std::array<double, 3> sigma{};
    for (int i = 0; i < 3; ++i) sigma[static_cast<std::size_t>(i)] = glm::length(splat.halfAxes[i]);
    written += 2 * std::numbers::pi * splat.opticalDepth * sigma[0] * sigma[1] * sigma[2] /
               *std::ranges::min_element(sigma);
  }
  EXPECT_NEAR(written / expected, 1, content == TileContent::Packed ? 0.02 : 1e-4);
}

constexpr Box kBoxes[]{
    {"middle", {10.0, 50.0, 10.2, 50.2}},    {"antimeridian", {179.8, -17.0, -179.9, -16.8}},
    {"north pole", {-180, 89.7, 180, 90}},   {"south pole", {-180, -90, 180, -89.7}},
    {"near the pole", {20, 89.5, 60, 89.8}}, {"half the globe", {-140, -60, 150, 70}},
    {"continent", {-130, 20, -60, 55}}};

class CardsOnTheGlobe : public testing::TestWithParam<Box> {};

/// Extinction that cards hold, seen from straight above, m2: a sprite ends at 2.2 deviations.
double heldUpwards(const check::WrittenScene& scene) {
  constexpr double kWithinBorder = 0.9111;
  double held = 0;
  for (const check::Blob& blob : scene.blobs)
    held += 2 * std::numbers::pi * kWithinBorder * static_cast<double>(blob.strength) *
            std::abs(static_cast<double>(glm::cross(blob.right(), blob.up()).y));
  return held;
}

TEST_P(CardsOnTheGlobe, HoldWhatTheirPuffsHoldAndAreSeenFromBothSides) {
  const scene::Scene scene = test::gltfScene(40, 4, GetParam().box);
  const test::Scratch folder;
  writeTiles(scene, {.folder = folder.path(), .tiles = {TileContent::Cards}});
  EXPECT_EQ(findingsOf(folder.path()), "") << GetParam().name;
  const auto read = check::readTileScene(folder.path() / "tileset.json", scene.frame, {});
  double expected = 0;
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[scene.lit[instance.lit].archetype].puffs)
      expected += shape::extinctionArea(scene::placed(scene, instance, puff));
  // Narrow upright cards of leaning puffs are left out.
  EXPECT_NEAR(heldUpwards(read) / expected, 1, 0.02) << GetParam().name;
  for (const check::Blob& blob : read.blobs) EXPECT_TRUE(blob.front && blob.back);
}

INSTANTIATE_TEST_SUITE_P(Boxes, CardsOnTheGlobe, testing::ValuesIn(kBoxes));

INSTANTIATE_TEST_SUITE_P(Boxes, TilesOnTheGlobe,
                         testing::Combine(testing::ValuesIn(kBoxes),
                                          testing::Values(TileContent::Packed, TileContent::Splats)));

TEST(Tiles, PuffsKeepTheirBearingAndStandUpright) {
  // One long fibre far from the middle of a wide map, pointing along the map's x.
  scene::Scene scene = test::gltfScene(10, 1, {-130, 20, -60, 55});
  shape::Puff puff;
  puff.sigma = {100, 5, 20};
  puff.extinctionPerMeter = 0.01f;
  scene.archetypes = {scene.archetypes[0]};
  scene.archetypes[0].puffs = {puff};
  scene.lit = {test::lit(scene, 0, 0)};
  const glm::dvec3 place = scene.frame.toScene(-70, 50, 5000);
  scene.instances = {{0, glm::vec3(place), 1, 1}};
  scene.clouds.resize(1);
  const test::Scratch folder;
  writeTiles(scene, {folder.path(), {}});
  std::vector<check::GlobeSplat> splats;
  check::readTiles(folder.path() / "tileset.json", {},
                   [&](const check::GlobeSplat& splat) { splats.push_back(splat); });
  ASSERT_EQ(splats.size(), 1u);
  const ByProj byProj(scene.frame);
  const glm::dvec3 at(scene.instances[0].position);
  const glm::dvec3 along = glm::normalize(byProj(at + glm::dvec3(100, 0, 0)) - byProj(at)),
                   up = glm::normalize(byProj(at + glm::dvec3(0, 100, 0)) - byProj(at));
  const auto pointsAlong = [&](int axis, const glm::dvec3& direction) {
    return std::abs(glm::dot(glm::normalize(splats[0].halfAxes[axis]), direction));
  };
  EXPECT_GT(pointsAlong(0, along), std::cos(0.03)) << "the map stretches angles there by a degree or so";
  EXPECT_GT(pointsAlong(1, up), std::cos(0.02)) << "packed in three bytes";
}

TEST(Tiles, CloudsTooWideForPackedSplatsAreRefusedOrCards) {
  scene::Scene scene = test::gltfScene(10, 1);
  scene.archetypes[0].puffs.assign(10, scene.archetypes[0].puffs.front());
  for (shape::Puff& puff : scene.archetypes[0].puffs) puff.sigma = glm::vec3(9000);
  const test::Scratch folder;
  EXPECT_THROW(writeTiles(scene, {.folder = folder.path(), .tiles = {TileContent::Packed}}), base::OutputError);
  writeTiles(scene, {.folder = folder.path(), .tiles = {TileContent::Auto}});
  EXPECT_NE(base::readFile(folder.path() / "tileset.json").find("KHR_materials_unlit"), std::string::npos);
}

TEST(Tiles, LargeSkiesAreTreesOfTilesAndValid) {
  const scene::Scene scene = test::gltfScene(3000, 8);
  const test::Scratch folder;
  writeTiles(scene, {folder.path(), {}});
  EXPECT_EQ(findingsOf(folder.path()), "");
  const Json tileset = Json::parse(base::readFile(folder.path() / "tileset.json"));
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  EXPECT_EQ(tileset["asset"]["extras"]["source"]["model"], "ICON-D2");
  EXPECT_EQ(tileset["root"]["refine"], "REPLACE");
  EXPECT_GT(tileset["geometricError"], tileset["root"]["geometricError"]);
  EXPECT_GT(tileset["root"]["geometricError"], 0);
  const Json& root = tileset["root"]["metadata"]["properties"];
  EXPECT_EQ(root["clouds"], scene.instances.size());
  EXPECT_EQ(root["genera"], "Ci Cu");
  std::size_t below = 0;
  for (const Json& child : tileset["root"]["children"])
    below += child["metadata"]["properties"]["clouds"].get<std::size_t>();
  EXPECT_EQ(below, scene.instances.size());
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "tiles"))
    files += entry.is_regular_file();
  EXPECT_GT(files, 4u);
}

TEST(Tiles, SameBytesAgainAndAsGzip) {
  const scene::Scene scene = test::gltfScene(2000, 6);
  const test::Scratch a, b, packed;
  writeTiles(scene, {.folder = a.path(), .tiles = {TileContent::Packed}});
  writeTiles(scene, {.folder = b.path(), .tiles = {TileContent::Packed}});
  writeTiles(scene, {.folder = packed.path(), .tiles = {TileContent::Splats, true}});
  for (const auto& entry : std::filesystem::recursive_directory_iterator(a.path())) {
    if (!entry.is_regular_file()) continue;
    const auto name = entry.path().lexically_relative(a.path());
    EXPECT_EQ(base::readFile(entry.path()), base::readFile(b.path() / name)) << name;
    EXPECT_TRUE(base::isGzip(base::readFile(packed.path() / name))) << name;
  }
  EXPECT_EQ(findingsOf(packed.path()), "");
}

TEST(Tiles, PackedSplatsAreSmall) {
  const scene::Scene scene = test::gltfScene(3000, 8);
  const test::Scratch folder;
  writeTiles(scene, {.folder = folder.path(), .tiles = {TileContent::Packed}});
  const Json tileset = Json::parse(base::readFile(folder.path() / "tileset.json"));
  std::uintmax_t bytes = 0, splats = 0;
  for (const Json& child : tileset["root"]["children"]) {
    bytes += std::filesystem::file_size(folder.path() / child["content"]["uri"].get<std::string>());
    splats += child["metadata"]["properties"]["drawn"].get<std::size_t>();
  }
  EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(splats), 16) << "with harmonics of degree 1";
}

TEST(Tiles, AreCardsWhereCesiumWouldLeaveOutSplats) {
  const auto extensionsOf = [](const scene::Scene& scene) {
    const test::Scratch folder;
    writeTiles(scene, {folder.path(), {}});
    EXPECT_EQ(findingsOf(folder.path()), "");
    EXPECT_EQ(std::filesystem::exists(folder.path() / "textures"),
              std::filesystem::exists(folder.path() / "textures" / "cumulus.png"));
    const Json tileset = Json::parse(base::readFile(folder.path() / "tileset.json"));
    return tileset["extensions"]["3DTILES_content_gltf"]["extensionsUsed"].dump();
  };
  scene::Scene scene = test::gltfScene();
  EXPECT_NE(extensionsOf(scene).find("spz"), std::string::npos);
  for (scene::Instance& cloud : scene.instances) cloud.scale *= 20;
  EXPECT_NE(extensionsOf(scene).find("unlit"), std::string::npos);
}

/// Each tileset of a sky that moves holds the puffs of its time where that has them.
TEST(Tiles, ASkyThatMovesIsATilesetATime) {
  const scene::Scene scene = test::moving(test::gltfScene(40));
  const test::Scratch folder;
  writeTiles(scene, {.folder = folder.path(), .tiles = {TileContent::Splats}});
  const ByProj byProj(scene.frame);
  const Json times = Json::parse(base::readFile(folder.path() / "tileset.json"))["asset"]["extras"]["times"];
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[1]["valid_time"], "2026-06-21T15:00:00Z");
  EXPECT_EQ(times[1]["uri"], "hours/20260621T1500Z/tileset.json");
  for (std::size_t hour = 0; hour < times.size(); ++hour) {
    const auto file = folder.path() / times[hour]["uri"].get<std::string>();
    EXPECT_EQ(findingsOf(file.parent_path()), "");
    std::vector<check::GlobeSplat> splats;
    check::readTiles(file, {}, [&](const check::GlobeSplat& splat) { splats.push_back(splat); });
    const scene::Scene still = scene::standingAt(scene, 3600.0 * static_cast<double>(hour));
    EXPECT_LT(still.instances.size(), scene.instances.size());
    std::size_t visible = 0;
    for (const scene::Instance& instance : still.instances)
      for (const shape::Puff& own : still.archetypes[still.lit[instance.lit].archetype].puffs) {
        const shape::Puff puff = scene::placed(still, instance, own);
        if (gltf::splatOpacity(shape::widenedAcross(puff)) < gltf::kLeastOpacity) continue;
        ++visible;
        const glm::dvec3 earth = byProj(puff.center);
        EXPECT_TRUE(std::ranges::any_of(splats, [&](const auto& splat) { return glm::distance(splat.center, earth) < 1; })) << hour;
      }
    EXPECT_EQ(splats.size(), visible);
  }
}

TEST(Tiles, NoCloudsAreAValidTileset) {
  const test::Scratch folder;
  writeTiles({.frame = base::LocalFrame({170, -10, -170, 10})}, {folder.path(), {}});
  EXPECT_EQ(findingsOf(folder.path()), "");
}

}  // namespace
}  // namespace cloudgen::writer
