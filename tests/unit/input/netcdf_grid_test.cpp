// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/projection.hpp"
#include "netcdf_cases.hpp"

namespace cloudgen {
namespace {

using test::contentsOf;
using test::NetcdfFile;
using test::plainFile;

field::Grid gridOf(const NetcdfFile& file) {
  const auto contents = contentsOf(file);
  return contents.grids.at(contents.fields.at(0).grid)();
}

/// 4 columns and 3 rows along x and y with a grid mapping.
NetcdfFile mapped(const std::map<std::string, std::string>& texts,
                  const std::map<std::string, std::vector<double>>& numbers, const std::string& unit,
                  const std::vector<double>& x, const std::vector<double>& y) {
  NetcdfFile file;
  const bool rotated = unit == "degrees";
  file.dimensions = {{"time", 1}, {"level", 1}, {"y", 3}, {"x", 4}};
  file.variables = {
      {"time", {"time"}, {{"units", "hours since 2020-01-01"}}, {0}},
      {"level", {"level"}, {{"units", "hPa"}}, {850}},
      {"crs", {}, texts, {0}, numbers},
      {"x",
       {"x"},
       {{"units", unit}, {"standard_name", rotated ? "grid_longitude" : "projection_x_coordinate"}},
       x},
      {"y",
       {"y"},
       {{"units", unit}, {"standard_name", rotated ? "grid_latitude" : "projection_y_coordinate"}},
       y},
  };
  file.variables.push_back({"clwc",
                            {"time", "level", "y", "x"},
                            {{"units", "1"}, {"grid_mapping", "crs"}},
                            test::caseValues(file, {"time", "level", "y", "x"})});
  return file;
}

void expectPlace(const field::Grid& grid, int column, int row, double longitude, double latitude,
                 double tolerance = 1e-6) {
  const auto place = field::centerOf(grid, grid.index(column, row));
  EXPECT_NEAR(base::wrappedLongitude(place.longitudeDegrees - longitude), 0, tolerance);
  EXPECT_NEAR(place.latitudeDegrees, latitude, tolerance);
}

TEST(NetcdfGrid, RowsRunEitherWay) {
  const field::Grid down = gridOf(plainFile());
  EXPECT_EQ(down.stepY, -2);
  expectPlace(down, 3, 2, 16, 46);
  NetcdfFile file = plainFile();
  file.variable("lat").values = {46, 48, 50};
  expectPlace(gridOf(file), 3, 2, 16, 50);
}

TEST(NetcdfGrid, LongitudesMayPassTheDateLineOrGreenwich) {
  NetcdfFile file = plainFile();
  file.variable("lon").values = {176, 178, -180, -178};
  const field::Grid pacific = gridOf(file);
  expectPlace(pacific, 3, 0, -178, 50);
  EXPECT_GT(field::extent(pacific).west, field::extent(pacific).east);
  file.variable("lon").values = {356, 358, 0, 2};
  expectPlace(gridOf(file), 2, 0, 0, 50);
  EXPECT_FALSE(gridOf(file).wrapsLongitude);
}

TEST(NetcdfGrid, GlobalGridsWrapAndDropTheRepeatedColumn) {
  NetcdfFile file = plainFile();
  file.variable("lon").values = {0, 90, 180, 270};
  EXPECT_TRUE(gridOf(file).wrapsLongitude);
  file.variable("lon").values = {0, 120, 240, 360};
  const auto contents = contentsOf(file);
  const field::Grid grid = contents.grids.at(0)();
  EXPECT_EQ(grid.columns, 3);
  EXPECT_TRUE(grid.wrapsLongitude);
  const auto values = test::read(contents, contents.fields.front());
  ASSERT_EQ(values.size(), 9u);
  EXPECT_FLOAT_EQ(values[3], static_cast<float>(test::caseValue(0, 1, 0, 0)));
}

TEST(NetcdfGrid, GaussianRowsKeepTheirPlaces) {
  NetcdfFile file = plainFile();
  file.variable("lat").values = {88.572, 86.723, 84.862};
  const field::Grid grid = gridOf(file);
  ASSERT_EQ(grid.rowY.size(), 3u);
  expectPlace(grid, 0, 1, 10, 86.723);
}

TEST(NetcdfGrid, CornersAreMovedToTheCentres) {
  NetcdfFile file = plainFile();
  file.dimensions.push_back({"bnds", 2});
  file.variable("lat").texts["bounds"] = "lat_bnds";
  file.variables.push_back({"lat_bnds", {"lat", "bnds"}, {}, {51, 49, 49, 47, 47, 45}});
  expectPlace(gridOf(file), 0, 0, 10, 50);
  EXPECT_FALSE(test::warns(contentsOf(file), "half_cell_shift"));
  file.variable("lat").values = {51, 49, 47};
  expectPlace(gridOf(file), 0, 0, 10, 50);
  EXPECT_TRUE(test::warns(contentsOf(file), "half_cell_shift"));
}

TEST(NetcdfGrid, LambertInKilometres) {
  const NetcdfFile file = mapped({{"grid_mapping_name", "lambert_conformal_conic"}},
                                 {{"standard_parallel", {50, 50}},
                                  {"longitude_of_central_meridian", {10}},
                                  {"latitude_of_projection_origin", {50}},
                                  {"earth_radius", {6371229}}},
                                 "km", {-20, 0, 20, 40}, {-20, 0, 20});
  const field::Grid grid = gridOf(file);
  expectPlace(grid, 1, 1, 10, 50);
  // 20 km along the meridian, to second order.
  expectPlace(grid, 1, 2, 10, 50 + 20000 / 6371229.0 * 180 / M_PI, 1e-5);
  EXPECT_EQ(grid.stepX, 20000);
}

TEST(NetcdfGrid, RotatedPole) {
  // COSMO-DE: its origin lies at 50 N 10 E; of the corner, sin(latitude) = sin(-5) cos 50 + cos^2(5) sin 50.
  const NetcdfFile file = mapped({{"grid_mapping_name", "rotated_latitude_longitude"}},
                                 {{"grid_north_pole_latitude", {40}}, {"grid_north_pole_longitude", {-170}}},
                                 "degrees", {-5, 0, 5, 10}, {-5, 0, 5});
  const field::Grid grid = gridOf(file);
  expectPlace(grid, 1, 1, 10, 50, 1e-6);
  expectPlace(grid, 0, 0, 2.9759, 44.7652, 1e-3);
}

TEST(NetcdfGrid, OtherMappings) {
  const std::vector<double> x{0, 10000, 20000, 30000}, y{0, 10000, 20000};
  expectPlace(gridOf(mapped({{"grid_mapping_name", "polar_stereographic"}},
                            {{"straight_vertical_longitude_from_pole", {-80}},
                             {"latitude_of_projection_origin", {90}},
                             {"standard_parallel", {60}}},
                            "m", {-10000, 0, 10000, 20000}, {-20000, -10000, 0})),
              1, 2, 0, 90, 360);
  expectPlace(gridOf(mapped({{"grid_mapping_name", "polar_stereographic"}},
                            {{"straight_vertical_longitude_from_pole", {-80}},
                             {"latitude_of_projection_origin", {90}},
                             {"standard_parallel", {60}}},
                            "m", {-10000, 0, 10000, 20000}, {-20000, -10000, 0})),
              1, 1, -80, 89.9, 0.05);
  expectPlace(
      gridOf(mapped({{"grid_mapping_name", "mercator"}},
                    {{"longitude_of_projection_origin", {5}}, {"standard_parallel", {0}}}, "m", x, y)),
      0, 0, 5, 0);
  expectPlace(gridOf(mapped({{"grid_mapping_name", "transverse_mercator"}},
                            {{"longitude_of_central_meridian", {9}},
                             {"latitude_of_projection_origin", {0}},
                             {"scale_factor_at_central_meridian", {0.9996}},
                             {"semi_major_axis", {6378137}},
                             {"inverse_flattening", {298.257223563}}},
                            "m", x, y)),
              0, 0, 9, 0);
  expectPlace(
      gridOf(mapped({{"grid_mapping_name", "lambert_azimuthal_equal_area"}},
                    {{"longitude_of_projection_origin", {10}}, {"latitude_of_projection_origin", {52}}}, "m",
                    x, y)),
      0, 0, 10, 52);
  expectPlace(
      gridOf(mapped({{"grid_mapping_name", "geostationary"}},
                    {{"longitude_of_projection_origin", {0}}, {"perspective_point_height", {35785831}}},
                    "radian", {0, 0.001, 0.002, 0.003}, {0, 0.001, 0.002})),
      0, 0, 0, 0);
}

NetcdfFile curvilinear(const std::vector<std::string>& order) {
  NetcdfFile file;
  file.dimensions = {{"level", 1}, {"y", 3}, {"x", 4}};
  file.variables = {{"level", {"level"}, {{"units", "hPa"}}, {850}}};
  std::vector<double> latitudes, longitudes;
  const bool rowsFirst = order.front() == "y";
  for (std::size_t i = 0; i < 12; ++i) {
    const double column = static_cast<double>(rowsFirst ? i % 4 : i / 3),
                 row = static_cast<double>(rowsFirst ? i / 4 : i % 3);
    latitudes.push_back(50 + row + 0.1 * column);
    longitudes.push_back(10 + column - 0.1 * row);
  }
  file.variables.push_back({"lat", order, {{"units", "degrees_north"}}, latitudes});
  file.variables.push_back({"lon", order, {{"units", "degrees_east"}}, longitudes});
  file.variables.push_back({"clwc",
                            {"level", "y", "x"},
                            {{"units", "1"}, {"coordinates", "lon lat"}},
                            test::caseValues(file, {"level", "y", "x"})});
  return file;
}

TEST(NetcdfGrid, CellsKnownByTheirPlacesAlone) {
  for (const auto& order : {std::vector<std::string>{"y", "x"}, {"x", "y"}}) {
    const test::Scratch scratch;
    test::writeNetcdf(scratch.path() / "made.nc", curvilinear(order));
    const auto contents = input::netcdf::readContents({scratch.path() / "made.nc"}, {});
    const field::Grid grid = contents.grids.at(0)();
    ASSERT_EQ(grid.centers.size(), 12u);
    const auto values = contents.fields.at(0).read(field::everyCell(grid));
    for (std::uint32_t cell = 0; cell < 12; ++cell) {
      // The value tells column and row as the writer saw them.
      const int place = static_cast<int>(std::lround(values[cell] * 1e6)) - 1;
      const double column = place % 10, row = place / 10;
      EXPECT_NEAR(field::centerOf(grid, cell).latitudeDegrees, 50 + row + 0.1 * column, 1e-6);
      EXPECT_NEAR(field::centerOf(grid, cell).longitudeDegrees, 10 + column - 0.1 * row, 1e-6);
    }
  }
}

TEST(NetcdfGrid, AMappingThatMissesTheFilesOwnPlacesIsNotBelieved) {
  const std::map<std::string, std::vector<double>> numbers{{"standard_parallel", {50}},
                                                           {"longitude_of_central_meridian", {10}},
                                                           {"latitude_of_projection_origin", {50}},
                                                           {"earth_radius", {6371229}}};
  NetcdfFile file = mapped({{"grid_mapping_name", "lambert_conformal_conic"}}, numbers, "m",
                           {-20000, 0, 20000, 40000}, {-20000, 0, 20000});
  std::vector<double> latitudes, longitudes;
  const field::Grid lattice = gridOf(file);
  for (std::uint32_t cell = 0; cell < 12; ++cell) {
    latitudes.push_back(field::centerOf(lattice, cell).latitudeDegrees);
    longitudes.push_back(field::centerOf(lattice, cell).longitudeDegrees);
  }
  file.variables.push_back({"lat", {"y", "x"}, {{"units", "degrees_north"}}, latitudes});
  file.variables.push_back({"lon", {"y", "x"}, {{"units", "degrees_east"}}, longitudes});
  EXPECT_FALSE(test::warns(contentsOf(file), "projection_disagrees"));
  for (double& latitude : file.variable("lat").values) latitude += 0.1;
  EXPECT_TRUE(test::warns(contentsOf(file), "projection_disagrees"));
}

TEST(NetcdfGrid, PointsOfALatticeAreOne) {
  // As COSP's input: dimensions level and loc, longitude fastest or slowest.
  for (const bool longitudeFast : {true, false}) {
    NetcdfFile file;
    file.dimensions = {{"level", 2}, {"loc", 6}};
    std::vector<double> x, y, values;
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t column = longitudeFast ? i % 3 : i / 2, row = longitudeFast ? i / 3 : i % 2;
      x.push_back(10 + 2 * static_cast<double>(column));
      y.push_back(50 + static_cast<double>(row));
      values.push_back(test::caseValue(column, row, 0, 0));
    }
    for (std::size_t i = 0; i < 6; ++i) values.push_back(0);
    file.variables = {{"lat", {"loc"}, {{"units", "degrees_north"}}, y},
                      {"lon", {"loc"}, {{"units", "degrees_east"}}, x},
                      {"pf", {"level", "loc"}, {{"units", "Pa"}}, std::vector<double>(12, 90000)},
                      {"mr_lsliq", {"level", "loc"}, {{"units", "kg/kg"}}, values}};
    const auto contents = contentsOf(file);
    const auto water = test::fieldsOf(contents, field::Quantity::CloudLiquid);
    ASSERT_EQ(water.size(), 2u);
    const field::Grid grid = contents.grids.at(0)();
    EXPECT_EQ(grid.columns, 3);
    expectPlace(grid, 2, 1, 14, 51);
    EXPECT_FLOAT_EQ(test::read(contents, *water[0])[5], static_cast<float>(test::caseValue(2, 1, 0, 0)));
    EXPECT_EQ(test::fieldsOf(contents, field::Quantity::Pressure).size(), 2u);
  }
}

TEST(NetcdfGrid, AMeshIsRefusedWithAdvice) {
  NetcdfFile file;
  file.dimensions = {{"level", 1}, {"ncells", 5}};
  file.variables = {{"clat", {"ncells"}, {{"units", "degrees_north"}}, {1, 2, 4, 7, 5}},
                    {"clon", {"ncells"}, {{"units", "degrees_east"}}, {3, 1, 4, 1.5, 9}},
                    {"qc", {"level", "ncells"}, {{"units", "1"}}, {1, 2, 3, 4, 5}}};
  try {
    gridOf(file);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_NE(error.hint().find("cdo"), std::string::npos);
  }
}

TEST(NetcdfGrid, AColumnStandsWhereItSaysOrWhereItIsTold) {
  NetcdfFile file;
  file.dimensions = {{"level", 2}};
  file.variables = {{"ql", {"level"}, {{"units", "1"}}, {1e-5, 2e-5}},
                    {"height", {"level"}, {{"units", "m"}, {"standard_name", "height"}}, {100, 1000}}};
  EXPECT_THROW(gridOf(file), base::InputError);
  input::OpenOptions options;
  options.place = input::Place{25, 60, {}};
  const auto contents = contentsOf(file, options);
  const field::Grid grid = contents.grids.at(0)();
  expectPlace(grid, 0, 0, 25, 60);
  EXPECT_TRUE(test::warns(contents, "cell_size_assumed"));
}

}  // namespace
}  // namespace cloudgen
