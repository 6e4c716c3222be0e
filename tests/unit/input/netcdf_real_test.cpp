// SPDX-License-Identifier: Apache-2.0
// Real files against what ncdump and the files' own coordinates say.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "input/netcdf/file.hpp"
#include "netcdf_cases.hpp"

namespace cloudgen {
namespace {

using field::Quantity;
using input::model::Single;
using input::model::SingleKind;

const std::filesystem::path kData = std::filesystem::path(CLOUDGEN_SHARED_DIR) / "data";
const char* const kEra5 = "era5_cirrus_16x8x4x13.nc";
const char* const kGfs = "gfs_icmr_17x17x3x7.nc";
const char* const kIcon = "icon_ny-alesund_column_20210104.nc";
const char* const kWrf = "wrfout_katrina_mercator_20050828.nc";

#define SKIP_WITHOUT(name) \
  if (!std::filesystem::exists(kData / (name))) GTEST_SKIP() << (name) << " is not there"

input::model::Contents contentsIn(const char* name) {
  return input::netcdf::readContents({kData / name}, {});
}

/// The value of a field at one cell, level value and time.
float valueAt(const input::model::Contents& contents, Quantity quantity, double level, const char* time,
              std::uint32_t cell) {
  const std::vector<std::uint32_t> cells{cell};
  for (const auto* field : test::fieldsOf(contents, quantity))
    if (field->vertical.value == level && field->valid == base::utcFromIso(time))
      return field->read(cells).front();
  ADD_FAILURE() << "no such field";
  return 0;
}

double metersBetween(const field::GeoPoint& a, const field::GeoPoint& b) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double east = base::wrappedLongitude(b.longitudeDegrees - a.longitudeDegrees) * kDegree *
                      std::cos(a.latitudeDegrees * kDegree),
               north = (b.latitudeDegrees - a.latitudeDegrees) * kDegree;
  return field::kEarthRadiusMeters * std::hypot(east, north);
}

TEST(NetcdfReal, Era5ValuesAreThoseOfNcdump) {
  SKIP_WITHOUT(kEra5);
  const auto contents = contentsIn(kEra5);
  // (longitude 5, latitude 7, level 3, time 5): stored -32028.
  EXPECT_NEAR(valueAt(contents, Quantity::CloudIce, 30000, "2019-01-01T05:00:00Z", 7 * 16 + 5),
              2.004047625650562e-05, 1e-12);
  EXPECT_NEAR(valueAt(contents, Quantity::CloudFraction, 30000, "2019-01-01T05:00:00Z", 7 * 16 + 5),
              0.8437428471151939, 1e-6);
  EXPECT_NEAR(valueAt(contents, Quantity::Temperature, 22500, "2019-01-01T07:00:00Z", 2 * 16 + 3),
              221.0798247338229, 1e-4);
  EXPECT_NEAR(valueAt(contents, Quantity::GeopotentialHeight, 30000, "2019-01-01T12:00:00Z", 7 * 16 + 15),
              90732.71555456793 / 9.80665, 1e-2);
  const field::Grid grid = contents.grids.at(0)();
  EXPECT_NEAR(field::centerOf(grid, 16 * 7 + 5).longitudeDegrees, -33.5, 1e-9);
  EXPECT_NEAR(field::centerOf(grid, 16 * 7 + 5).latitudeDegrees, 59, 1e-9);
}

TEST(NetcdfReal, GfsIceIsFoundByItsGribName) {
  SKIP_WITHOUT(kGfs);
  const auto contents = contentsIn(kGfs);
  EXPECT_NEAR(valueAt(contents, Quantity::CloudIce, 30000, "2022-01-01T06:00:00Z", 15 * 17 + 15),
              0.00014134000230114907, 1e-10);
  EXPECT_EQ(test::fieldsOf(contents, Quantity::CloudIce).front()->run,
            base::utcFromIso("2022-01-01T00:00:00Z"));
}

TEST(NetcdfReal, CloudnetColumnHasItsPlaceAndSize) {
  SKIP_WITHOUT(kIcon);
  const auto contents = contentsIn(kIcon);
  EXPECT_NEAR(valueAt(contents, Quantity::CloudLiquid, 79, "2021-01-04T05:00:00Z", 0), 0.0005127557669766247,
              1e-9);
  EXPECT_NEAR(valueAt(contents, Quantity::HeightAboveGround, 79, "2021-01-04T05:00:00Z", 0), 1331.4265, 1e-2);
  const field::Grid grid = contents.grids.at(0)();
  ASSERT_EQ(grid.size(), 1u);
  EXPECT_NEAR(field::centerOf(grid, 0).latitudeDegrees, 78.923, 1e-5);
  EXPECT_NEAR(field::centerOf(grid, 0).longitudeDegrees, 11.921, 1e-5);
  EXPECT_NEAR(field::cellAreaSquareMeters(grid, 0), 13000.0 * 13000.0, 1e4);
  const auto* ground = test::singleOf(contents, Single{SingleKind::SurfaceHeight});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(test::read(contents, *ground).front(), 154.1755, 1e-3);
}

TEST(NetcdfReal, EveryWrfCellLiesWhereTheFileSays) {
  SKIP_WITHOUT(kWrf);
  const auto contents = contentsIn(kWrf);
  const field::Grid grid = contents.grids.at(0)();
  EXPECT_TRUE(grid.centers.empty()) << "Mercator is a lattice";
  const input::netcdf::File file(kData / kWrf);
  const auto latitudes = file.values(*file.find("XLAT")), longitudes = file.values(*file.find("XLONG"));
  double farthest = 0;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
    farthest =
        std::max(farthest, metersBetween(field::centerOf(grid, cell), {longitudes[cell], latitudes[cell]}));
  EXPECT_LT(farthest, 10);
  RecordProperty("farthest_meters", std::to_string(farthest));
}

TEST(NetcdfReal, WrfStateIsPutTogether) {
  SKIP_WITHOUT(kWrf);
  const auto contents = contentsIn(kWrf);
  const char* const time = "2005-08-28T18:00:00Z";
  const std::uint32_t cell = 10 * 48 + 20;
  const double pressure = -195.2734375 + 92542.5;
  EXPECT_NEAR(valueAt(contents, Quantity::Pressure, 6, time, cell), pressure, 0.05);
  EXPECT_NEAR(valueAt(contents, Quantity::Temperature, 6, time, cell),
              (300 + 3.7521250247955322) * std::pow(pressure / 1e5, 2.0 / 7.0), 1e-3);
  EXPECT_NEAR(valueAt(contents, Quantity::GeopotentialHeight, 6, time, cell),
              0.5 * (357.9548034667969 + 5359.25146484375 + 489.34259033203125 + 7466.8330078125) / 9.80665,
              1e-2);
  EXPECT_NEAR(valueAt(contents, Quantity::WindEast, 6, time, cell), 0.5 * (12.751112 + 13.129993), 1e-4);
  EXPECT_NEAR(valueAt(contents, Quantity::WindNorth, 6, time, cell), 0.5 * (-5.404534 - 6.255476), 1e-4);
  // Per kg of moist air.
  EXPECT_NEAR(valueAt(contents, Quantity::CloudLiquid, 10, "2005-08-28T12:00:00Z", 43 * 48 + 43),
              0.0018109717639163136 / 1.016013411805033684, 1e-8);
  EXPECT_TRUE(test::warns(contents, "liquid_holds_ice"));
  EXPECT_TRUE(test::fieldsOf(contents, Quantity::CloudLiquid).front()->holdsIceBelowFreezing);
  EXPECT_TRUE(test::fieldsOf(contents, Quantity::WindEast).front()->alongGridAxes);
}

TEST(NetcdfReal, SomeCellsReadAsAllDo) {
  for (const char* name : {kEra5, kWrf}) {
    SKIP_WITHOUT(name);
    const auto contents = contentsIn(name);
    const std::vector<std::uint32_t> some{99, 3, 40, 41, 17};
    for (const auto* field : test::fieldsOf(contents, Quantity::WindNorth)) {
      const auto all = test::read(contents, *field), few = field->read(some);
      for (std::size_t i = 0; i < some.size(); ++i) ASSERT_EQ(few[i], all[some[i]]);
    }
  }
}

TEST(NetcdfReal, CutShortAnywhereIsRefused) {
  const test::Scratch scratch;
  for (const char* name : {kEra5, kGfs, kIcon, kWrf}) {
    SKIP_WITHOUT(name);
    std::ifstream stream(kData / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t part = 0; part < 50; ++part) {
      const auto cut = scratch.write("cut.nc", std::string_view(bytes).substr(0, bytes.size() * part / 50));
      EXPECT_THROW(input::openNetcdf({cut}, {}), base::InputError) << name << " at " << part << "/50";
    }
  }
}

}  // namespace
}  // namespace cloudgen
