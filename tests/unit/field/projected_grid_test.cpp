// SPDX-License-Identifier: Apache-2.0
// Grids of single kinds, against numbers known from elsewhere.
#include <gmock/gmock.h>

#include <numbers>

#include "base/frame.hpp"
#include "unit/field/trial_grids.hpp"

namespace cloudgen::field {
namespace {

using trial::projected;
constexpr double kDegree = std::numbers::pi / 180;

void expectPlace(const GeoPoint& place, double longitude, double latitude, double tolerance = 1e-6) {
  EXPECT_NEAR(base::wrappedLongitude(place.longitudeDegrees - longitude), 0, tolerance);
  EXPECT_NEAR(place.latitudeDegrees, latitude, tolerance);
}

/// As ecCodes' grib_get_data tells the places of NCEP's grid 211 in eta_g211_lambert_20041208_f24.grib2.
TEST(Lambert, PlacesAsEcCodesHasThem) {
  const Grid grid = trial::lambert();
  expectPlace(centerOf(grid, 0), 226.5410000, 12.1900000);
  expectPlace(centerOf(grid, 1), 227.2426000, 12.3879344);
  expectPlace(centerOf(grid, 92), 294.9087249, 14.3346425);
  expectPlace(centerOf(grid, 2998), 237.5912488, 38.5434484);
  expectPlace(centerOf(grid, 6044), 310.6149028, 57.2894039);
}

/// As WRF 3.8.1 tells them (XLAT, XLONG) in wrfout_katrina_mercator_20050828.nc: its sphere is 6370 km.
TEST(Mercator, PlacesAsWrfHasThem) {
  const Grid grid =
      projected("+proj=merc +lat_ts=0 +lon_0=-89 +R=6370000", 48, 48, 10000, {-91.6534, 21.80395});
  expectPlace(centerOf(grid, grid.index(10, 20)), -90.75395, 23.46424, 2e-5);
  expectPlace(centerOf(grid, grid.index(47, 47)), -87.42593, 25.67273, 2e-5);
}

/// The corner that FORMATS and the GRIB headers of WWMCA give: (-20.826, 145) north, (20.826, -125) south.
TEST(Hemispheres, CornersOfWwmca) {
  Grid grid = trial::hemispheres(1024);
  grid.crs = "+proj=stere +lat_0=90 +lat_ts=60 +lon_0=100 +R=6371221.3";
  // Column 0 and row 0 lie furthest left and furthest down in this plane.
  const GeoPoint corner = centerOf(grid, 0);
  EXPECT_NEAR(corner.latitudeDegrees, -20.826, 0.002);
  EXPECT_NEAR(cellAreaSquareMeters(grid, 0), 0, 0) << "beyond the equator";
  EXPECT_EQ(extent(grid).width(), 360);
}

TEST(Hemispheres, NeighboursAcrossTheEquator) {
  const Grid grid = trial::hemispheres();
  const CellFinder finder(grid);
  int across = 0;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
    const GeoPoint center = centerOf(grid, cell);
    const double side = cellSidesMeters(grid, cell).x / 111195;
    if (cellAreaSquareMeters(grid, cell) == 0 || std::abs(center.latitudeDegrees) > 0.7 * side) continue;
    const auto mirrored = finder.at({center.longitudeDegrees, -center.latitudeDegrees});
    ASSERT_TRUE(mirrored) << cell;
    EXPECT_THAT(neighbours(grid, cell), testing::Contains(*mirrored)) << cell;
    ++across;
  }
  EXPECT_GT(across, 200);
}

TEST(Polar, ThePoleIsInside) {
  const Grid grid = trial::polar();
  const base::GeoBox box = extent(grid);
  EXPECT_EQ(box.width(), 360);
  EXPECT_EQ(box.north, 90);
  EXPECT_NEAR(box.south, centerOf(grid, 0).latitudeDegrees, 1);
  const std::uint32_t pole = grid.index(20, 20);
  EXPECT_THAT(cellsTouching(grid, {10, 89.9, 20, 90}), testing::ElementsAre(pole));
  EXPECT_THAT(cellsTouching(grid, {-180, 89.99, 180, 90}), testing::ElementsAre(pole));
  EXPECT_EQ(CellFinder(grid).at({123, 90}), pole);
  EXPECT_EQ(cellsTouching(grid, {-180, 80, 180, 90}).size(),
            cellsTouching(grid, {170, 80, 169.9999, 90}).size());
}

/// The scale of the plane tells the area: m = (1 + sin 60) / (1 + sin latitude).
TEST(Polar, AreasFollowTheScale) {
  Grid grid = trial::polar();
  grid.stepX = grid.stepY = 10000;
  grid.firstX = grid.firstY = -3000000;
  for (const std::uint32_t cell : {0u, 45u, 700u, 1600u}) {
    const double latitude = centerOf(grid, cell).latitudeDegrees * kDegree;
    const double scale = (1 + std::sin(60 * kDegree)) / (1 + std::sin(latitude));
    const double toMean = std::pow(kEarthRadiusMeters / 6371229, 2);
    EXPECT_NEAR(cellAreaSquareMeters(grid, cell) / (1e8 / scale / scale * toMean), 1, 1e-5);
  }
}

TEST(Polar, LargeCellsKeepTheirArea) {
  // One cell from the pole outwards: a quarter of a cap is not a square, but four squares around it are known
  // by the finer grid of the same reach.
  Grid coarse = trial::polar(), fine = coarse;
  coarse.columns = coarse.rows = 2, coarse.stepX = coarse.stepY = 2000000;
  coarse.firstX = coarse.firstY = -1000000;
  fine.columns = fine.rows = 400, fine.stepX = fine.stepY = 10000;
  fine.firstX = fine.firstY = -1995000;
  double whole = 0, sum = 0;
  for (std::uint32_t cell = 0; cell < coarse.size(); ++cell) whole += cellAreaSquareMeters(coarse, cell);
  for (std::uint32_t cell = 0; cell < fine.size(); ++cell) sum += cellAreaSquareMeters(fine, cell);
  EXPECT_NEAR(whole / sum, 1, 1e-4);
}

TEST(Rotated, AreasAreThoseOfTheRotatedSphere) {
  const Grid grid = trial::rotated();
  const double side = 0.5 * kDegree * kEarthRadiusMeters;
  EXPECT_NEAR(cellAreaSquareMeters(grid, grid.index(20, 14)) / (side * side), 1, 1e-4);
  EXPECT_NEAR(cellAreaSquareMeters(grid, grid.index(0, 14)) / (side * side), 1, 1e-4);
}

TEST(Mercator, AcrossTheAntimeridianAndTheMapsEdge) {
  const Grid grid = trial::mercator();
  const base::GeoBox box = extent(grid);
  EXPECT_TRUE(box.crossesAntimeridian());
  EXPECT_NEAR(box.width(), 60 * 100000 / (6370000 * std::cos(10 * kDegree)) / kDegree, 1e-6);
  const auto found = CellFinder(grid).at({-170, 5});
  ASSERT_TRUE(found);
  EXPECT_NEAR(centerOf(grid, *found).longitudeDegrees, -170, 0.5);
  EXPECT_FALSE(CellFinder(grid).at({150, 5}));
}

TEST(AxisAngle, TurnsWithTheMeridian) {
  const Grid grid = trial::lambert();
  for (const std::uint32_t cell : {0u, 1000u, 2998u, 6044u}) {
    const double longitude = base::wrappedLongitude(centerOf(grid, cell).longitudeDegrees + 95);
    // The x axis lies east at the reference meridian; west of it the cone turns it to the left (Snyder 1987,
    // 15-4).
    EXPECT_NEAR(axisAngle(grid, cell), -std::sin(25 * kDegree) * longitude * kDegree, 1e-4) << cell;
  }
  EXPECT_EQ(axisAngle(trial::global(), 5), 0);
}

TEST(Gaussian, BordersLieHalfWayAndReachThePoles) {
  const Grid grid = trial::gaussian();
  EXPECT_DOUBLE_EQ(pointIn(grid, 0, 0.5, 0.5).latitudeDegrees, 85.7606);
  EXPECT_DOUBLE_EQ(pointIn(grid, 0, 0.5, 0).latitudeDegrees, 90);
  EXPECT_DOUBLE_EQ(pointIn(grid, 0, 0.5, 1).latitudeDegrees, 0.5 * (85.7606 + 80.2688));
  EXPECT_EQ(extent(grid).north, 90);
  EXPECT_EQ(CellFinder(grid).at({1, 89.9}), 0u);
  EXPECT_THAT(cellsTouching(grid, {-1, 89, 1, 90}), testing::ElementsAre(0u));
}

TEST(Reduced, RowsMeetWhereTheyOverlap) {
  const Grid grid = trial::reduced();
  // The first row has 20 cells of 18 degrees, the second 24 of 15: cell 0 reaches from 351 to 9 degrees.
  EXPECT_EQ(neighbours(grid, 0), (std::vector<std::uint32_t>{1, 19, 20, 21, 43}));
  EXPECT_EQ(grid.row(19), 0);
  EXPECT_EQ(grid.row(20), 1);
  EXPECT_EQ(grid.column(43), 23);
  EXPECT_EQ(CellFinder(grid).at({352, 85}), 0u);
  EXPECT_EQ(extent(grid).width(), 360);
}

TEST(Thinned, ReachesOverGreenwich) {
  const Grid grid = trial::thinned();
  const auto cell = CellFinder(grid).at({10, 30});
  ASSERT_TRUE(cell);
  EXPECT_NEAR(centerOf(grid, *cell).longitudeDegrees, 10, 1.6);
  EXPECT_FALSE(CellFinder(grid).at({120, 30}));
  EXPECT_EQ(extent(grid).north, 90);
}

TEST(Curvilinear, IsAsTheProjectionItCameFrom) {
  const Grid lambert = trial::lambert(), grid = trial::curvilinear(lambert);
  for (const std::uint32_t cell : {0u, 500u, 3000u, 6044u}) {
    EXPECT_NEAR(cellAreaSquareMeters(grid, cell) / cellAreaSquareMeters(lambert, cell), 1, 5e-3) << cell;
    EXPECT_NEAR(axisAngle(grid, cell), axisAngle(lambert, cell), 5e-3);
    const GeoPoint corner = pointIn(lambert, cell, 0, 0);
    expectPlace(pointIn(grid, cell, 0, 0), corner.longitudeDegrees, corner.latitudeDegrees, 0.01);
  }
  const base::GeoBox one = extent(grid), other = extent(lambert);
  EXPECT_NEAR(one.west, other.west, 0.02);
  EXPECT_NEAR(one.north, other.north, 0.02);
  EXPECT_EQ(extent(trial::curvilinear(trial::polar())).north, 90);
}

TEST(Curvilinear, MissingCentersDoNotCount) {
  Grid grid = trial::curvilinear(trial::lambert());
  grid.centers[100].latitudeDegrees = std::nan("");
  EXPECT_EQ(cellAreaSquareMeters(grid, 100), 0);
  EXPECT_THAT(cellsTouching(grid, extent(grid)), testing::Not(testing::Contains(100u)));
  EXPECT_TRUE(CellFinder(grid).at(centerOf(grid, 3000)));
}

TEST(Curvilinear, ASingleColumnHasASize) {
  Grid grid;
  grid.columns = grid.rows = 1;
  grid.centers = {{11.9, 78.9}};
  EXPECT_GT(cellAreaSquareMeters(grid, 0), 1e7);
  EXPECT_EQ(CellFinder(grid).at({11.9, 78.9}), 0u);
  grid.rows = 3;
  grid.centers = {{10, 40}, {10, 41}, {10, 42}};
  EXPECT_NEAR(cellSidesMeters(grid, 1).x, 111195, 500);
}

TEST(Geostationary, TheEdgeOfTheDiscDoesNotCount) {
  Grid grid;
  grid.crs = "+proj=geos +h=35785831 +lon_0=0 +ellps=GRS80";
  grid.columns = grid.rows = 60;
  grid.stepX = 200000, grid.stepY = -200000;
  grid.firstX = -59 * 100000.0, grid.firstY = 59 * 100000.0;
  EXPECT_EQ(cellAreaSquareMeters(grid, 0), 0);
  const auto cells = cellsTouching(grid, {-180, -90, 180, 90});
  EXPECT_GT(cells.size(), 1800u);
  EXPECT_LT(cells.size(), 2400u);
  const base::GeoBox box = extent(grid);
  EXPECT_NEAR(box.west, -78, 4);
  EXPECT_NEAR(box.north, 78, 4);
}

/// Scenes of such domains: their box, laid out flat, has the size it should have.
TEST(Scene, FramesOfPolarAndLambertDomains) {
  const base::LocalFrame polar(extent(trial::polar()));
  const glm::dvec2 size = polar.upperCorner() - polar.lowerCorner();
  EXPECT_GT(size.x, 4.0e6);
  EXPECT_LT(size.x, 7.0e6);
  const base::LocalFrame lambert(extent(trial::lambert()));
  EXPECT_GT(lambert.upperCorner().x, 5e6);
}

}  // namespace
}  // namespace cloudgen::field
