// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/made_wwmca.hpp"

namespace cloudgen::input::cdfs {
namespace {

const std::vector<Hemisphere> kNorth{Hemisphere::North}, kSouth{Hemisphere::South},
    kBoth{Hemisphere::North, Hemisphere::South};

MeshHeader wwmcaHeader(bool south) {
  MeshHeader header;
  header.columns = header.rows = 1024;
  header.firstLatitude = south ? 20.826 : -20.826;
  header.firstLongitude = south ? -125 : 145;
  header.orientation = 100;
  header.stepMeters = 23813;
  header.radiusMeters = 6367470;
  header.south = south;
  return header;
}

double metersBetween(const field::GeoPoint& a, const field::GeoPoint& b) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double north = (a.latitudeDegrees - b.latitudeDegrees) * kDegree;
  const double east = std::remainder(a.longitudeDegrees - b.longitudeDegrees, 360.0) * kDegree *
                      std::cos(a.latitudeDegrees * kDegree);
  return field::kEarthRadiusMeters * std::hypot(north, east);
}

TEST(Mesh, PutsEveryPointWhereTheFormulaOfTheAirForcePutsIt) {
  for (const bool south : {false, true}) {
    const field::Grid grid = gridOf(standardMesh(), south ? kSouth : kNorth);
    for (int row = 0; row < 1024; row += 73)
      for (int column = 0; column < 1024; column += 93) {
        const auto there = field::centerOf(grid, grid.index(column, row));
        EXPECT_LT(metersBetween(there, test::meshCenter(1024, south, column, row)), 10)
            << column << " " << row;
      }
  }
}

TEST(Mesh, FollowsTheHeaderOfWwmcaWithItsOppositeMeridian) {
  for (const bool south : {false, true}) {
    const auto mesh = meshOf(wwmcaHeader(south));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(*mesh, standardMesh());
  }
}

TEST(Mesh, FollowsAHeaderWithTheMeridianThatGribAsksFor) {
  MeshHeader header = wwmcaHeader(false);
  header.orientation = 280;
  EXPECT_EQ(meshOf(header), standardMesh());
}

TEST(Mesh, FollowsAHeaderOfAnotherGrid) {
  // MET's: pole two cells off, 23.79848 km on GRIB's own sphere.
  MeshHeader header = wwmcaHeader(false);
  header.stepMeters = 23798;
  header.firstLatitude = -20.66;
  const auto mesh = meshOf(header);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->stepX, 23798);
  EXPECT_EQ(mesh->radiusMeters, 6367470);
  EXPECT_NEAR(-mesh->firstX / mesh->stepX, 510, 1.0);
}

TEST(Mesh, RefusesAHeaderWithoutThePole) {
  MeshHeader header = wwmcaHeader(false);
  header.columns = header.rows = 100;
  EXPECT_FALSE(meshOf(header));
  header.stepMeters = 0;
  EXPECT_FALSE(meshOf(header));
}

TEST(Mesh, JoinsBothHemispheresAtTheEquator) {
  const field::Grid grid = gridOf(standardMesh(64), kBoth);
  EXPECT_EQ(grid.rows, 128);
  EXPECT_FALSE(grid.southCrs.empty());
  const auto north = field::centerOf(grid, grid.index(40, 20)),
             south = field::centerOf(grid, grid.index(40, 84));
  EXPECT_LT(metersBetween(north, test::meshCenter(64, false, 40, 20)), 10);
  EXPECT_LT(metersBetween(south, test::meshCenter(64, true, 40, 20)), 10);
  EXPECT_EQ(field::cellAreaSquareMeters(grid, grid.index(0, 0)), 0);
  double area = 0;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) area += field::cellAreaSquareMeters(grid, cell);
  EXPECT_NEAR(area / (4 * std::numbers::pi * field::kEarthRadiusMeters * field::kEarthRadiusMeters), 1, 0.02);
}

}  // namespace
}  // namespace cloudgen::input::cdfs
