// SPDX-License-Identifier: Apache-2.0
#include "pipeline/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/pipeline.hpp"
#include "support/made_source.hpp"

namespace cloudgen::pipeline {
namespace {

/// A slope up to the east: 100 m a degree, with a mountain in one cell.
class HillSource : public test::MadeSource {
 public:
  using test::MadeSource::MadeSource;
  field::Surface surface(std::span<const std::uint32_t> cells) const override {
    field::Surface surface;
    for (const std::uint32_t cell : cells) {
      const double east = field::centerOf(grid(), cell).longitudeDegrees - 10;
      surface.heightMeters.push_back(cell == mountain ? 2000.0f : static_cast<float>(slope * east));
    }
    return surface;
  }
  double slope = 100;
  std::uint32_t mountain = ~0u;
};

std::vector<std::uint32_t> allCells(const field::Source& source) {
  std::vector<std::uint32_t> cells(source.grid().size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;
  return cells;
}

double heightAt(const Ground& ground, const base::LocalFrame& frame, double longitude, double latitude) {
  const glm::dvec3 place = frame.toScene(longitude, latitude, 0);
  return ground.terrain.heightAt(place.x, place.z);
}

TEST(Terrain, ASlopeStaysASlope) {
  const HillSource source(10, 44, 0.5, 12, 8);
  const base::LocalFrame frame({11, 45, 15, 47});
  const Ground ground = groundOf(source, frame, allCells(source));
  ASSERT_FALSE(ground.terrain.empty());
  EXPECT_LE(ground.terrain.columns, 129);
  EXPECT_LE(ground.terrain.rows, 129);
  for (const double longitude : {11.5, 12.3, 13.0, 14.4})
    for (const double latitude : {45.4, 46.1, 46.6})
      EXPECT_NEAR(heightAt(ground, frame, longitude, latitude), 100 * (longitude - 10), 6);
  EXPECT_NEAR(ground.lowestMeters, 100, 10);
}

TEST(Terrain, HasNoStepsBetweenCells) {
  HillSource source(10, 44, 0.5, 12, 8);
  source.slope = 0;
  source.mountain = source.grid().index(5, 4);
  const base::LocalFrame frame({11, 45, 15, 47});
  const Ground ground = groundOf(source, frame, allCells(source));
  ASSERT_FALSE(ground.terrain.empty());
  const field::GeoPoint summit = field::centerOf(source.grid(), source.mountain);
  EXPECT_NEAR(heightAt(ground, frame, summit.longitudeDegrees, summit.latitudeDegrees), 0.75 * 0.75 * 2000,
              200);
  double last = heightAt(ground, frame, 11.1, summit.latitudeDegrees);
  for (double longitude = 11.1; longitude < 14.9; longitude += 0.01) {
    const double here = heightAt(ground, frame, longitude, summit.latitudeDegrees);
    EXPECT_LT(std::abs(here - last), 60) << longitude;
    last = here;
  }
}

TEST(Terrain, ItsBorderLiesAtTheLowestGround) {
  const HillSource source(10, 44, 0.5, 12, 8);
  const Ground ground = groundOf(source, base::LocalFrame({11, 45, 15, 47}), allCells(source));
  const base::HeightField& terrain = ground.terrain;
  for (int column = 0; column < terrain.columns; ++column) {
    EXPECT_EQ(terrain.at(column, 0), ground.lowestMeters);
    EXPECT_EQ(terrain.at(column, terrain.rows - 1), ground.lowestMeters);
  }
}

TEST(Terrain, FlatOrUnknownGroundHasNone) {
  HillSource flat(10, 44, 0.5, 12, 8);
  flat.slope = 0;
  EXPECT_TRUE(groundOf(flat, base::LocalFrame({11, 45, 15, 47}), allCells(flat)).terrain.empty());
  const test::MadeSource unknown(10, 44, 0.5, 12, 8);
  const Ground ground = groundOf(unknown, base::LocalFrame({11, 45, 15, 47}), allCells(unknown));
  EXPECT_TRUE(ground.terrain.empty());
  EXPECT_EQ(ground.lowestMeters, 0);
}

TEST(Terrain, ReachesOverTheBordersOfTheGrid) {
  const HillSource source(11, 45, 0.5, 4, 4);
  const Ground ground = groundOf(source, base::LocalFrame({10, 44, 14, 48}), allCells(source));
  ASSERT_FALSE(ground.terrain.empty());
  for (const float height : ground.terrain.heights) EXPECT_TRUE(std::isfinite(height));
}

TEST(Terrain, CloudsStandOnIt) {
  HillSource source(10, 44, 0.5, 12, 8);
  source.slope = 400;
  field::StatedLayer fog = test::stratocumulusLayer(1);
  fog.genus = base::Genus::Fog;
  for (std::uint32_t cell = 0; cell < source.grid().size(); ++cell) {
    const float ground = source.surface(std::span(&cell, 1)).heightMeters[0];
    fog.cell = cell, fog.baseMeters = ground, fog.topMeters = ground + 150;
    source.layers.push_back(fog);
  }
  source.cover(test::cumulusLayer());
  Options options = test::usualOptions(30'000);
  options.box = base::GeoBox{11, 45, 15, 47};
  const Outcome outcome = run(source, options, {});
  ASSERT_FALSE(outcome.scene.terrain.empty());
  int fogs = 0;
  for (std::size_t i = 0; i < outcome.scene.clouds.size(); ++i) {
    const glm::vec3& place = outcome.scene.instances[i].position;
    const float ground = scene::groundAt(outcome.scene, place.x, place.z);
    EXPECT_GE(place.y, ground - 1);
    if (outcome.scene.clouds[i].genus != base::Genus::Fog) continue;
    EXPECT_NEAR(place.y, ground, 1);
    ++fogs;
  }
  EXPECT_GT(fogs, 10);
}

}  // namespace
}  // namespace cloudgen::pipeline
