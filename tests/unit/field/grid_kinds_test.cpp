// SPDX-License-Identifier: Apache-2.0
// What must hold for a grid of any kind.
#include <gmock/gmock.h>

#include <numbers>

#include "base/error.hpp"
#include "unit/field/trial_grids.hpp"

namespace cloudgen::field {
namespace {

bool counted(const Grid& grid, std::uint32_t cell) { return cellAreaSquareMeters(grid, cell) > 0; }

TEST(EveryGrid, FindsTheCellOfItsCenter) {
  for (const auto& [name, grid] : trial::all()) {
    const CellFinder finder(grid);
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
      if (counted(grid, cell)) {
        EXPECT_EQ(finder.at(centerOf(grid, cell)), cell) << name;
      }
  }
}

TEST(EveryGrid, FindsTheCellOfPlacesNearItsCorners) {
  for (const auto& [name, grid] : trial::all()) {
    if (!grid.southCrs.empty()) continue;  // corners of the seam belong to the other half
    const CellFinder finder(grid);
    for (std::uint32_t cell = grid.size() / 3; cell < grid.size(); cell += 7)
      for (const double u : {0.05, 0.95})
        for (const double v : {0.05, 0.95}) {
          const GeoPoint place = pointIn(grid, cell, u, v);
          if (std::abs(place.latitudeDegrees) == 90) continue;
          EXPECT_EQ(finder.at(place), cell) << name << " " << cell << " " << u << " " << v;
        }
  }
}

TEST(EveryGrid, NeighboursAreMutualAndNear) {
  for (const auto& [name, grid] : trial::all())
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
      const auto around = neighbours(grid, cell);
      EXPECT_TRUE(std::is_sorted(around.begin(), around.end()));
      EXPECT_THAT(around, testing::Not(testing::Contains(cell))) << name;
      if (counted(grid, cell)) {
        EXPECT_GE(around.size(), 2u) << name << " " << cell;
      }
      for (const std::uint32_t other : around)
        EXPECT_THAT(neighbours(grid, other), testing::Contains(cell)) << name << " " << other;
    }
}

TEST(EveryGrid, ItsExtentHoldsEveryCell) {
  for (const auto& [name, grid] : trial::all()) {
    const base::GeoBox box = extent(grid);
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
      const GeoPoint center = centerOf(grid, cell);
      if (counted(grid, cell)) {
        EXPECT_TRUE(box.contains(center.longitudeDegrees, center.latitudeDegrees)) << name << " " << cell;
      }
    }
    const auto cells = cellsTouching(grid, box);
    std::size_t expected = 0;
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell) expected += counted(grid, cell) ? 1 : 0;
    EXPECT_EQ(cells.size(), expected) << name;
    EXPECT_EQ(std::adjacent_find(cells.begin(), cells.end(), std::greater_equal<>()), cells.end()) << name;
  }
}

/// Against a brute-force look at places in every cell.
TEST(EveryGrid, CellsTouchingABox) {
  const base::GeoBox boxes[] = {{-110, 30, -90, 45}, {170, -2, -165, 12},  {-180, 70, 180, 90},
                                {0, 80, 90, 90},     {5, 48, 6, 49},       {-95.01, 35, -95, 60},
                                {-10, -5, 40, 5},    {-180, -90, 180, 90}, {-100.3, 40.1, -100.25, 40.12}};
  for (const auto& [name, grid] : trial::all())
    for (const base::GeoBox& box : boxes) {
      const auto cells = cellsTouching(grid, box);
      EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
      for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
        if (!counted(grid, cell)) continue;
        bool meets = false;
        for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9})
          for (const double v : {0.1, 0.3, 0.5, 0.7, 0.9}) {
            const GeoPoint place = pointIn(grid, cell, u, v);
            const double east = place.longitudeDegrees - box.west;
            const double along = east - 360 * std::floor(east / 360);
            meets |= along > 1e-6 && along < box.width() - 1e-6 && place.latitudeDegrees > box.south + 1e-6 &&
                     place.latitudeDegrees < box.north - 1e-6;
          }
        if (meets) {
          EXPECT_TRUE(std::binary_search(cells.begin(), cells.end(), cell)) << name << " " << cell;
        }
      }
      for (const std::uint32_t cell : cells)
        EXPECT_TRUE(counted(grid, cell)) << name << ": only cells that count";
    }
}

TEST(EveryGrid, ABoxWithinACellFindsThatCell) {
  for (const auto& [name, grid] : trial::all())
    for (std::uint32_t cell = 3; cell < grid.size(); cell += 101) {
      if (!counted(grid, cell)) continue;
      const GeoPoint p = pointIn(grid, cell, 0.37, 0.63);
      if (std::abs(p.latitudeDegrees) > 89 || std::abs(p.longitudeDegrees) > 179.9) continue;
      if (!grid.southCrs.empty() && std::abs(p.latitudeDegrees) < 10) continue;
      const base::GeoBox box{p.longitudeDegrees - 1e-3, p.latitudeDegrees - 1e-3, p.longitudeDegrees + 1e-3,
                             p.latitudeDegrees + 1e-3};
      EXPECT_EQ(cellsTouching(grid, box), std::vector<std::uint32_t>{cell}) << name;
      const double share = shareInside(grid, cell, box) * cellAreaSquareMeters(grid, cell);
      const double area = 222.4 * 222.4 * std::cos(p.latitudeDegrees * std::numbers::pi / 180);
      EXPECT_NEAR(share / area, 1, 0.01) << name;
    }
}

TEST(EveryGrid, SharesOfHalvesAddUp) {
  for (const auto& [name, grid] : trial::all())
    for (std::uint32_t cell = 1; cell < grid.size(); cell += 97) {
      if (!counted(grid, cell)) continue;
      const double middle = centerOf(grid, cell).longitudeDegrees;
      const base::GeoBox east{middle, -90, base::wrappedLongitude(middle + 180), 90},
          west{base::wrappedLongitude(middle + 180), -90, middle, 90};
      EXPECT_NEAR(shareInside(grid, cell, east) + shareInside(grid, cell, west), 1, 0.02) << name;
      EXPECT_NEAR(shareInside(grid, cell, {-180, -90, 180, 90}), 1, 1e-12) << name;
    }
}

TEST(EveryGrid, SidesAndAreaAgree) {
  for (const auto& [name, grid] : trial::all())
    for (std::uint32_t cell = 0; cell < grid.size(); cell += 13) {
      if (!counted(grid, cell) || std::abs(centerOf(grid, cell).latitudeDegrees) > 80) continue;
      const glm::dvec2 sides = cellSidesMeters(grid, cell);
      EXPECT_NEAR(sides.x * sides.y / cellAreaSquareMeters(grid, cell), 1, 0.02) << name << " " << cell;
    }
}

TEST(EveryGrid, GlobalAreasSumToTheSphere) {
  const double sphere = 4 * std::numbers::pi * kEarthRadiusMeters * kEarthRadiusMeters;
  for (const auto& [name, grid] : trial::all()) {
    double sum = 0;
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell) sum += cellAreaSquareMeters(grid, cell);
    if (name == "global" || name == "gaussian" || name == "reduced") {
      EXPECT_NEAR(sum / sphere, 1, 1e-12) << name;
    }
    if (name == "hemispheres") {
      EXPECT_NEAR(sum / sphere, 1, 0.01);
    }
  }
}

TEST(EveryGrid, AbsurdProjectionsAreNamed) {
  Grid grid = trial::lambert();
  grid.crs = "+proj=lcc +lat_1=45 +lat_2=-45 +R=6371229";
  EXPECT_THROW(extent(grid), base::InputError);
  EXPECT_THROW(cellsTouching(grid, {0, 0, 1, 1}), base::InputError);
  EXPECT_THROW(pointIn(grid, 0, 0.5, 0.5), base::InputError);
}

}  // namespace
}  // namespace cloudgen::field
