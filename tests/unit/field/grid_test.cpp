// SPDX-License-Identifier: Apache-2.0
#include "field/grid.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

namespace cloudgen::field {
namespace {

/// As GFS: 2.5 degrees, from the north pole, from Greenwich eastwards.
Grid global() {
  Grid grid;
  grid.columns = 144, grid.rows = 73;
  grid.firstX = 0, grid.firstY = 90, grid.stepX = 2.5, grid.stepY = -2.5;
  grid.wrapsLongitude = true;
  return grid;
}

Grid regional() {
  Grid grid;
  grid.columns = 4, grid.rows = 3;
  grid.firstX = 10, grid.firstY = 40, grid.stepX = 1, grid.stepY = 1;
  return grid;
}

/// The centre of the cell `column`, `row`, or a place halves of a cell away from it.
GeoPoint pointAt(const Grid& grid, double column, double row) {
  return pointIn(grid, 0, column + 0.5, row + 0.5);
}

std::set<double> longitudes(const Grid& grid, const std::vector<std::uint32_t>& cells) {
  std::set<double> values;
  for (const std::uint32_t cell : cells)
    values.insert(pointAt(grid, grid.column(cell), grid.row(cell)).longitudeDegrees);
  return values;
}

TEST(Grid, PointsAreWrappedAndHeldAtThePoles) {
  EXPECT_DOUBLE_EQ(pointAt(global(), 0, 0).latitudeDegrees, 90);
  EXPECT_DOUBLE_EQ(pointAt(global(), 0, -0.5).latitudeDegrees, 90);
  EXPECT_DOUBLE_EQ(pointAt(global(), 143, 36).longitudeDegrees, -2.5);
  EXPECT_DOUBLE_EQ(pointAt(global(), 72, 36).longitudeDegrees, -180);
  EXPECT_DOUBLE_EQ(pointAt(regional(), -0.5, -0.5).longitudeDegrees, 9.5);
}

TEST(Grid, CellAreasSumToTheSphere) {
  const Grid grid = global();
  double sum = 0;
  for (std::uint32_t i = 0; i < grid.size(); ++i) sum += cellAreaSquareMeters(grid, i);
  EXPECT_NEAR(sum / (4 * std::numbers::pi * kEarthRadiusMeters * kEarthRadiusMeters), 1, 1e-12);
}

TEST(Grid, CellAreaAtTheEquator) {
  Grid grid = regional();
  grid.firstY = 0;
  EXPECT_NEAR(cellAreaSquareMeters(grid, 0), 111195.0 * 111195.0, 111195.0 * 5);
}

TEST(CellsTouching, WholeEarthIsEveryCellOnce) {
  const auto cells = cellsTouching(global(), {-180, -90, 180, 90});
  ASSERT_EQ(cells.size(), global().size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i], i);
}

TEST(CellsTouching, BoxInOrderFromTheNorth) {
  const Grid grid = global();
  const auto cells = cellsTouching(grid, {-100, 25, -60, 50});
  EXPECT_EQ(cells.size(), 17u * 11u);
  EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
  EXPECT_DOUBLE_EQ(pointAt(grid, 0, grid.row(cells.front())).latitudeDegrees, 50);
  EXPECT_DOUBLE_EQ(pointAt(grid, 0, grid.row(cells.back())).latitudeDegrees, 25);
}

TEST(CellsTouching, AcrossGreenwichAndTheAntimeridian) {
  const Grid grid = global();
  EXPECT_EQ(longitudes(grid, cellsTouching(grid, {-3, 0, 3, 1})), (std::set<double>{-2.5, 0, 2.5}));
  EXPECT_EQ(longitudes(grid, cellsTouching(grid, {177, 0, -177, 1})),
            (std::set<double>{-180, -177.5, 177.5}));
}

TEST(CellsTouching, BoxSmallerThanACell) {
  EXPECT_EQ(cellsTouching(global(), {0.1, 0.1, 0.2, 0.2}).size(), 1u);
  EXPECT_EQ(cellsTouching(global(), {1.2, 0.1, 1.3, 0.2}).size(), 2u)
      << "over the border between two columns";
  EXPECT_EQ(cellsTouching(global(), {0.1, 89, 0.2, 90}).size(), 1u) << "at the pole";
}

TEST(CellsTouching, SharedBordersDoNotCount) {
  EXPECT_EQ(cellsTouching(regional(), {9.5, 39.5, 10.5, 40.5}).size(), 1u);
  EXPECT_EQ(cellsTouching(global(), {-1.25, -1.25, 1.25, 1.25}).size(), 1u);
}

TEST(CellsTouching, OutsideTheGridIsEmpty) {
  EXPECT_TRUE(cellsTouching(regional(), {20, 39, 30, 45}).empty());
  EXPECT_TRUE(cellsTouching(regional(), {10, 50, 12, 55}).empty());
  EXPECT_EQ(cellsTouching(regional(), {-180, -90, 180, 90}).size(), 12u);
}

TEST(CellsTouching, ColumnsMayRunWestwards) {
  Grid grid = regional();
  grid.firstX = 13, grid.stepX = -1;
  EXPECT_EQ(longitudes(grid, cellsTouching(grid, {10.6, 40, 12.4, 41})), (std::set<double>{11, 12}));
  EXPECT_DOUBLE_EQ(extent(grid).west, 9.5);
}

TEST(Extent, ReachesTheCellBorders) {
  const base::GeoBox box = extent(regional());
  EXPECT_DOUBLE_EQ(box.west, 9.5);
  EXPECT_DOUBLE_EQ(box.east, 13.5);
  EXPECT_DOUBLE_EQ(box.south, 39.5);
  EXPECT_DOUBLE_EQ(box.north, 42.5);
  const base::GeoBox whole = extent(global());
  EXPECT_DOUBLE_EQ(whole.width(), 360);
  EXPECT_DOUBLE_EQ(whole.north, 90);
  EXPECT_DOUBLE_EQ(whole.south, -90);
}

TEST(Extent, AcrossTheAntimeridian) {
  Grid grid = regional();
  grid.firstX = 178;
  EXPECT_DOUBLE_EQ(extent(grid).west, 177.5);
  EXPECT_DOUBLE_EQ(extent(grid).east, -178.5);
  EXPECT_EQ(cellsTouching(grid, extent(grid)).size(), 12u);
}

TEST(Neighbour, WrapsInLongitudeButNotOverThePole) {
  const Grid grid = global();
  EXPECT_THAT(neighbours(grid, grid.index(0, 5)), testing::Contains(grid.index(143, 5)));
  EXPECT_THAT(neighbours(grid, grid.index(143, 5)), testing::Contains(grid.index(0, 6)));
  EXPECT_EQ(neighbours(grid, grid.index(7, 0)).size(), 5u);
  EXPECT_EQ(neighbours(regional(), 0), (std::vector<std::uint32_t>{1, 4, 5}));
}

}  // namespace
}  // namespace cloudgen::field
