// SPDX-License-Identifier: Apache-2.0
// Where the cells of a GRIB grid lie, against ecCodes' own latitudes and longitudes (an independent reader of
// the same sections), and against a rotation by hand where ecCodes has none.
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "input/grib/grib.hpp"
#include "input/grib/stored_grid.hpp"
#include "support/made_grib.hpp"
#include "support/scratch.hpp"

namespace cloudgen {
namespace {

namespace fs = std::filesystem;
using test::GribMaker;

constexpr double kToleranceMeters = 10, kRadians = std::numbers::pi / 180;

double metersBetween(const field::GeoPoint& a, const field::GeoPoint& b) {
  const double dLat = (a.latitudeDegrees - b.latitudeDegrees) * kRadians,
               dLon = (a.longitudeDegrees - b.longitudeDegrees) * kRadians;
  const double s = std::sin(dLat / 2), t = std::sin(dLon / 2);
  const double h =
      s * s + std::cos(a.latitudeDegrees * kRadians) * std::cos(b.latitudeDegrees * kRadians) * t * t;
  return 2 * field::kEarthRadiusMeters * std::asin(std::min(1.0, std::sqrt(h)));
}

std::vector<field::GeoPoint> placesByEcCodes(codes_handle* handle) {
  std::size_t count = 0;
  if (codes_get_size(handle, "values", &count) != CODES_SUCCESS) return {};
  std::vector<double> latitudes(count), longitudes(count);
  std::size_t size = count;
  if (codes_get_double_array(handle, "latitudes", latitudes.data(), &size) != CODES_SUCCESS) return {};
  size = count;
  if (codes_get_double_array(handle, "longitudes", longitudes.data(), &size) != CODES_SUCCESS) return {};
  std::vector<field::GeoPoint> places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = {longitudes[i], latitudes[i]};
  return places;
}

/// Every cell (of large grids every so many) against the place of its value.
void expectAgreement(codes_handle* handle, const fs::path& file, const std::string& what) {
  const auto places = placesByEcCodes(handle);
  ASSERT_FALSE(places.empty()) << what << ": ecCodes has no places";
  const auto heads = input::grib::locateFields(file);
  ASSERT_FALSE(heads.empty());
  const input::grib::StoredGrid stored = input::grib::readGrid(heads.front());
  ASSERT_EQ(stored.size(), places.size()) << what;
  const std::uint32_t step = std::max(1u, stored.grid.size() / 2000);
  double worst = 0;
  for (std::uint32_t cell = 0; cell < stored.grid.size(); cell += step)
    worst = std::max(worst, metersBetween(field::centerOf(stored.grid, cell), places[stored.place(cell)]));
  const std::uint32_t last = stored.grid.size() - 1;
  worst = std::max(worst, metersBetween(field::centerOf(stored.grid, last), places[stored.place(last)]));
  EXPECT_LT(worst, kToleranceMeters) << what << " " << stored.grid.crs;
}

struct Case {
  const char* name;
  const char* sample;
  std::function<void(GribMaker&)> set;
  std::size_t points = 0;  ///< 0: as the sample has
};

/// A plane grid of 7 by 5 points.
void plane(GribMaker& m, long templateNumber, double latitude, double longitude) {
  m.whole("gridDefinitionTemplateNumber", templateNumber).whole("Nx", 7).whole("Ny", 5);
  m.whole("numberOfDataPoints", 35).whole("shapeOfTheEarth", 6);
  m.number("latitudeOfFirstGridPointInDegrees", latitude);
  m.number("longitudeOfFirstGridPointInDegrees", longitude);
  m.whole("iScansNegatively", 0).whole("jScansPositively", 1);
}

void conic(GribMaker& m, double latitude, double longitude, double one, double other, double upright) {
  plane(m, 30, latitude, longitude);
  m.number("LaDInDegrees", one).number("LoVInDegrees", upright);
  m.number("Latin1InDegrees", one).number("Latin2InDegrees", other);
  m.number("DxInMetres", 81271).number("DyInMetres", 81271);
}

void polar(GribMaker& m, double latitude, double longitude, double upright, double trueAt, bool south) {
  plane(m, 20, latitude, longitude);
  m.number("LaDInDegrees", trueAt).number("orientationOfTheGridInDegrees", upright);
  m.number("DxInMetres", 190500).number("DyInMetres", 190500);
  m.whole("projectionCentreFlag", south ? 128 : 0);
}

const Case kCases[] = {
    {"regular_ll across Greenwich", "regular_ll_pl_grib2",
     [](GribMaker& m) {
       m.whole("Ni", 5).whole("Nj", 3).number("latitudeOfFirstGridPointInDegrees", 52);
       m.number("latitudeOfLastGridPointInDegrees", 50).number("longitudeOfFirstGridPointInDegrees", 358);
       m.number("longitudeOfLastGridPointInDegrees", 2).number("iDirectionIncrementInDegrees", 1);
       m.number("jDirectionIncrementInDegrees", 1);
     },
     15},
    {"regular_ll edition 1 across the antimeridian", "regular_ll_pl_grib1",
     [](GribMaker& m) {
       m.whole("Ni", 5).whole("Nj", 3).number("latitudeOfFirstGridPointInDegrees", 1);
       m.number("latitudeOfLastGridPointInDegrees", -1).number("longitudeOfFirstGridPointInDegrees", 178);
       m.number("longitudeOfLastGridPointInDegrees", -178).number("iDirectionIncrementInDegrees", 1);
       m.number("jDirectionIncrementInDegrees", 1);
     },
     15},
    {"rotated_ll", "rotated_ll_pl_grib2",
     [](GribMaker& m) {
       m.whole("Ni", 6).whole("Nj", 4).number("latitudeOfFirstGridPointInDegrees", 3);
       m.number("latitudeOfLastGridPointInDegrees", -3).number("longitudeOfFirstGridPointInDegrees", -4);
       m.number("longitudeOfLastGridPointInDegrees", 6).number("iDirectionIncrementInDegrees", 2);
       m.number("jDirectionIncrementInDegrees", 2).number("latitudeOfSouthernPoleInDegrees", -40);
       m.number("longitudeOfSouthernPoleInDegrees", 10);
     },
     24},
    {"rotated_ll edition 1, tilted south", "rotated_ll_pl_grib1",
     [](GribMaker& m) {
       m.whole("Ni", 6).whole("Nj", 4).number("latitudeOfFirstGridPointInDegrees", 3);
       m.number("latitudeOfLastGridPointInDegrees", -3).number("longitudeOfFirstGridPointInDegrees", -4);
       m.number("longitudeOfLastGridPointInDegrees", 6).number("iDirectionIncrementInDegrees", 2);
       m.number("jDirectionIncrementInDegrees", 2).number("latitudeOfSouthernPoleInDegrees", -60);
       m.number("longitudeOfSouthernPoleInDegrees", 190);
     },
     24},
    {"rotated_ll over its pole", "rotated_ll_pl_grib2",
     [](GribMaker& m) {
       m.whole("Ni", 36).whole("Nj", 5).number("latitudeOfFirstGridPointInDegrees", 90);
       m.number("latitudeOfLastGridPointInDegrees", 50).number("longitudeOfFirstGridPointInDegrees", 0);
       m.number("longitudeOfLastGridPointInDegrees", 350).number("iDirectionIncrementInDegrees", 10);
       m.number("jDirectionIncrementInDegrees", 10).number("latitudeOfSouthernPoleInDegrees", -30);
       m.number("longitudeOfSouthernPoleInDegrees", -15);
     },
     180},
    {"regular_gg", "regular_gg_pl_grib2", [](GribMaker&) {}},
    {"regular_gg edition 1", "regular_gg_pl_grib1", [](GribMaker&) {}},
    {"reduced_gg", "reduced_gg_pl_32_grib2", [](GribMaker&) {}},
    {"reduced_gg edition 1", "reduced_gg_pl_48_grib1", [](GribMaker&) {}},
    {"reduced_ll", "reduced_ll_sfc_grib2", [](GribMaker&) {}},
    {"reduced_ll edition 1", "reduced_ll_sfc_grib1", [](GribMaker&) {}},
    {"mercator", "GRIB2",
     [](GribMaker& m) {
       plane(m, 10, 10, 170);
       m.number("LaDInDegrees", 20).number("latitudeOfLastGridPointInDegrees", 12.1);
       // Six steps of 50 km true at 20 degrees.
       m.number("longitudeOfLastGridPointInDegrees",
                170 + 6 * 50000 / (6371229 * std::cos(20 * kRadians)) / kRadians);
       m.number("DiInMetres", 50000).number("DjInMetres", 50000);
     },
     35},
    {"lambert with one parallel", "GRIB2", [](GribMaker& m) { conic(m, 12.19, 226.541, 25, 25, 265); }, 35},
    {"lambert with two parallels", "GRIB2", [](GribMaker& m) { conic(m, 40, 350, 33, 45, 10); }, 35},
    {"lambert across the antimeridian", "GRIB2", [](GribMaker& m) { conic(m, 50, 177, 50, 50, 180); }, 35},
    {"polar_stereographic north", "GRIB2", [](GribMaker& m) { polar(m, 80, 200, 265, 60, false); }, 35},
    {"polar_stereographic true at 70", "GRIB2", [](GribMaker& m) { polar(m, 60, 250, 315, 70, false); }, 35},
    {"polar_stereographic over the pole", "GRIB2",
     [](GribMaker& m) { polar(m, 85, -45 + 360, 0, 60, false); }, 35},
    {"polar_stereographic south", "GRIB2", [](GribMaker& m) { polar(m, -70, 225, 0, -60, true); }, 35},
    {"polar_stereographic edition 1", "polar_stereographic_pl_grib1",
     [](GribMaker& m) {
       m.whole("Nx", 7).whole("Ny", 5).number("latitudeOfFirstGridPointInDegrees", 60);
       m.number("longitudeOfFirstGridPointInDegrees", -120).number("orientationOfTheGridInDegrees", -105);
       m.number("DxInMetres", 190500).number("DyInMetres", 190500).whole("jScansPositively", 1);
     },
     35},
    {"lambert_azimuthal_equal_area", "GRIB2",
     [](GribMaker& m) {
       plane(m, 140, 48, 5);
       m.number("standardParallelInDegrees", 52).number("centralLongitudeInDegrees", 10);
       m.number("xDirectionGridLengthInMetres", 100000).number("yDirectionGridLengthInMetres", 100000);
     },
     35},
    {"one column", "regular_ll_pl_grib2",
     [](GribMaker& m) {
       m.whole("Ni", 1).whole("Nj", 3).number("latitudeOfFirstGridPointInDegrees", 52);
       m.number("latitudeOfLastGridPointInDegrees", 50).number("longitudeOfFirstGridPointInDegrees", 8);
       m.number("longitudeOfLastGridPointInDegrees", 8).number("iDirectionIncrementInDegrees", 1);
       m.number("jDirectionIncrementInDegrees", 1);
     },
     3},
    {"one row", "regular_ll_pl_grib2",
     [](GribMaker& m) {
       m.whole("Ni", 3).whole("Nj", 1).number("latitudeOfFirstGridPointInDegrees", 52);
       m.number("latitudeOfLastGridPointInDegrees", 52).number("longitudeOfFirstGridPointInDegrees", 8);
       m.number("longitudeOfLastGridPointInDegrees", 10).number("iDirectionIncrementInDegrees", 1);
       m.number("jDirectionIncrementInDegrees", 1);
     },
     3},
};

TEST(GribGeoreference, MadeGridsLieWhereEcCodesPutsThem) {
  const test::Scratch scratch;
  for (const Case& each : kCases) {
    GribMaker maker(each.sample);
    each.set(maker);
    if (each.points) maker.values(each.points, [](std::size_t i) { return static_cast<double>(i); });
    ASSERT_EQ(maker.refused(), "") << each.name;
    expectAgreement(maker.handle(), scratch.write("made.grib", maker.bytes()), each.name);
  }
}

/// ecCodes 2.28 turns cones of the south the wrong way round; Snyder (1987), equations 15-1 to 15-8.
TEST(GribGeoreference, LambertOfTheSouthFollowsSnyder) {
  const test::Scratch scratch;
  GribMaker m("GRIB2");
  conic(m, -52, 130, -30, -60, 140);
  m.values(35, [](std::size_t i) { return static_cast<double>(i); });
  const auto heads = input::grib::locateFields(scratch.write("made.grib", m.bytes()));
  const field::Grid grid = input::grib::readGrid(heads.at(0)).grid;
  const auto t = [](double degrees) { return std::tan(std::numbers::pi / 4 + degrees * kRadians / 2); };
  const double one = -30 * kRadians, other = -60 * kRadians;
  const double n = std::log(std::cos(one) / std::cos(other)) / std::log(t(-60) / t(-30));
  const double f = 6371229 * std::cos(one) * std::pow(t(-30), n) / n;
  const double rho = f / std::pow(t(-52), n), theta = n * (130 - 140) * kRadians;
  const double firstX = rho * std::sin(theta), firstY = -rho * std::cos(theta);
  for (const int row : {0, 4})
    for (const int column : {0, 6}) {
      const double x = firstX + column * 81271, y = firstY + row * 81271;
      const double distance = -std::hypot(x, y), angle = std::atan2(-x, y);
      const field::GeoPoint expected{
          140 + angle / n / kRadians,
          (2 * std::atan(std::pow(f / distance, 1 / n)) - std::numbers::pi / 2) / kRadians};
      EXPECT_LT(metersBetween(field::centerOf(grid, grid.index(column, row)), expected), kToleranceMeters)
          << column << " " << row;
    }
}

TEST(GribGeoreference, RealGridsLieWhereEcCodesPutsThem) {
  for (const char* name :
       {"gfs_2p5_20110110_f120.grib2", "eta_g211_lambert_20041208_f24.grib2", "ruc13_g212_2005080700_f00.grb",
        "ifs_oper_20240101_10msgs.grib2", "wafs_thinned_reduced_ll_20070110.grib2",
        "cfs_flux_regular_gg_20060331.grb", "icon-eu_CLCT_MOD_20220427_f047.grib2"}) {
    const fs::path path = fs::path(CLOUDGEN_SHARED_DIR) / "data" / name;
    if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
    std::FILE* file = std::fopen(path.c_str(), "rb");
    int error = 0;
    codes_handle* handle = codes_handle_new_from_file(nullptr, file, PRODUCT_GRIB, &error);
    ASSERT_TRUE(handle) << name;
    expectAgreement(handle, path, name);
    codes_handle_delete(handle);
    std::fclose(file);
  }
}

/// The same field of 4 by 3 points in every order in which a file may keep it.
TEST(GribGeoreference, AllScanningOrdersGiveTheSameFieldAtTheSamePlace) {
  const test::Scratch scratch;
  constexpr int kColumns = 4, kRows = 3;
  for (const int edition : {1, 2})
    for (int order = 0; order < 16; ++order) {
      const bool west = order & 8, north = order & 4, columnsFirst = order & 2, toAndFro = order & 1;
      if (edition == 1 && toAndFro) continue;  // edition 1 has no flag for it
      GribMaker m(edition == 2 ? "regular_ll_pl_grib2" : "regular_ll_pl_grib1");
      m.whole("Ni", kColumns).whole("Nj", kRows).text("shortName", "r").whole("level", 500);
      m.number("latitudeOfFirstGridPointInDegrees", north ? 40 : 44);
      m.number("latitudeOfLastGridPointInDegrees", north ? 44 : 40);
      m.number("longitudeOfFirstGridPointInDegrees", west ? 183 : 177);
      m.number("longitudeOfLastGridPointInDegrees", west ? 177 : 183);
      m.number("iDirectionIncrementInDegrees", 2).number("jDirectionIncrementInDegrees", 2);
      m.whole("iScansNegatively", west).whole("jScansPositively", north);
      m.whole("jPointsAreConsecutive", columnsFirst).whole("bitsPerValue", 24);
      if (edition == 2) m.whole("alternativeRowScanning", toAndFro);
      const auto valueAt = [&](std::size_t i) {
        auto column = static_cast<int>(i % kColumns), row = static_cast<int>(i / kColumns);
        if (columnsFirst) column = static_cast<int>(i / kRows), row = static_cast<int>(i % kRows);
        if (toAndFro && !columnsFirst && row % 2) column = kColumns - 1 - column;
        if (toAndFro && columnsFirst && column % 2) row = kRows - 1 - row;
        const double longitude = west ? 183 - 2 * column : 177 + 2 * column,
                     latitude = north ? 40 + 2 * row : 44 - 2 * row;
        return longitude - 170 + 10 * (latitude - 39);
      };
      m.values(12, valueAt);
      ASSERT_EQ(m.refused(), "") << order;
      const auto contents = input::grib::readContents({scratch.write("made.grib", m.bytes())});
      ASSERT_EQ(contents.fields.size(), 1u);
      const field::Grid grid = contents.grids.at(0)();
      std::vector<std::uint32_t> cells(12);
      for (std::uint32_t i = 0; i < 12; ++i) cells[i] = i;
      const std::vector<float> values = contents.fields.front().read(cells);
      for (const std::uint32_t cell : cells) {
        const auto [longitude, latitude] = field::centerOf(grid, cell);
        const double eastOf = longitude < 0 ? longitude + 360 : longitude;
        EXPECT_NEAR(values[cell], eastOf - 170 + 10 * (latitude - 39), 1e-3)
            << "edition " << edition << " order " << order << " cell " << cell;
      }
    }
}

TEST(GribGeoreference, ARepeatedLastColumnIsLeftOut) {
  const test::Scratch scratch;
  for (const bool west : {false, true}) {
    GribMaker m("regular_ll_pl_grib2");
    m.whole("Ni", 5)
        .whole("Nj", 2)
        .text("shortName", "r")
        .whole("level", 500)
        .whole("iScansNegatively", west);
    m.number("latitudeOfFirstGridPointInDegrees", 10).number("latitudeOfLastGridPointInDegrees", 0);
    m.number("longitudeOfFirstGridPointInDegrees", west ? 360 : 0);
    m.number("longitudeOfLastGridPointInDegrees", west ? 0 : 360);
    m.number("iDirectionIncrementInDegrees", 90).number("jDirectionIncrementInDegrees", 10);
    m.values(10, [&](std::size_t i) {
      const double column = static_cast<double>(i % 5);
      return std::fmod((west ? 360 - 90 * column : 90 * column), 360.0) + 1;
    });
    const auto contents = input::grib::readContents({scratch.write("made.grib", m.bytes())});
    const field::Grid grid = contents.grids.at(0)();
    EXPECT_EQ(grid.columns, 4);
    EXPECT_TRUE(grid.wrapsLongitude);
    const std::vector<std::uint32_t> cells{0, 1, 2, 3};
    const auto values = contents.fields.at(0).read(cells);
    for (const std::uint32_t cell : cells) {
      const double longitude = field::centerOf(grid, cell).longitudeDegrees;
      EXPECT_NEAR(values[cell], longitude < 0 ? longitude + 361 : longitude + 1, 0.1) << west;
    }
  }
}

/// Sections of NCEP's grid about a centre are made octet by octet: ecCodes does not know it.
std::string aboutCenter(double centerLatitude, double centerLongitude, const field::GeoPoint& first,
                        int columns, int rows, double step) {
  GribMaker m("regular_ll_pl_grib2");
  m.whole("Ni", columns).whole("Nj", rows).text("shortName", "r").whole("level", 500);
  m.values(static_cast<std::size_t>(columns * rows), [](std::size_t i) { return static_cast<double>(i); });
  std::string bytes = m.bytes();
  const std::size_t grid = 16 + 21 - 1;  // octet 1 of section 3 is octet 0 here
  const auto put = [&](std::size_t octet, double degrees) {
    auto value = static_cast<std::uint32_t>(std::lround(std::abs(degrees) * 1e6));
    if (degrees < 0) value |= 0x80000000u;
    for (int i = 0; i < 4; ++i)
      bytes[grid + octet + static_cast<std::size_t>(3 - i)] = static_cast<char>(value >> (8 * i));
  };
  bytes[grid + 13] = static_cast<char>(32769 >> 8);
  bytes[grid + 14] = static_cast<char>(32769 & 0xff);
  put(47, first.latitudeDegrees);
  put(51, first.longitudeDegrees);
  put(56, centerLatitude);
  put(60, centerLongitude);
  put(64, step);
  put(68, step);
  bytes[grid + 55] = 0x38;
  bytes[grid + 72] = 0x40;
  return bytes;
}

/// A place on the turned sphere back to the globe, by turning vectors about the y axis.
field::GeoPoint turnedBack(double centerLatitude, double centerLongitude, double x, double y) {
  const double l = x * kRadians, p = y * kRadians, tilt = centerLatitude * kRadians;
  const double a = std::cos(p) * std::cos(l), b = std::cos(p) * std::sin(l), c = std::sin(p);
  const double east = a * std::cos(tilt) - c * std::sin(tilt), up = a * std::sin(tilt) + c * std::cos(tilt);
  return {centerLongitude + std::atan2(b, east) / kRadians, std::asin(up) / kRadians};
}

TEST(GribGeoreference, NcepsGridAboutACentreIsTurnedByItsNumbers) {
  const test::Scratch scratch;
  for (const auto& [latitude, longitude] : {std::pair{54.0, 254.0}, {-35.0, 178.0}, {0.0, 10.0}}) {
    constexpr int kColumns = 21, kRows = 11;
    constexpr double kStep = 0.5;
    const field::GeoPoint first = turnedBack(latitude, longitude, -5, -2.5);
    const std::string bytes = aboutCenter(latitude, longitude, first, kColumns, kRows, kStep);
    const auto contents = input::grib::readContents({scratch.write("made.grib2", bytes)});
    const field::Grid grid = contents.grids.at(0)();
    ASSERT_EQ(grid.size(), static_cast<std::uint32_t>(kColumns * kRows));
    for (const int row : {0, 5, 10})
      for (const int column : {0, 10, 20}) {
        const field::GeoPoint expected =
            turnedBack(latitude, longitude, -5 + column * kStep, -2.5 + row * kStep);
        EXPECT_LT(metersBetween(field::centerOf(grid, grid.index(column, row)), expected), kToleranceMeters)
            << latitude << " " << column << " " << row;
      }
    std::vector<std::uint32_t> cells{0, 30, 230};
    EXPECT_NEAR(contents.fields.at(0).read(cells)[1], 30, 0.1);
  }
}

TEST(GribGeoreference, GridsThatCannotBePlacedAreNamedWithARemedy) {
  const test::Scratch scratch;
  for (const auto& [sample, says] :
       {std::pair{"sh_pl_grib2", "spherical harmonics"}, {"sh_pl_grib1", "spherical harmonics"}}) {
    GribMaker m(sample);
    try {
      const auto contents = input::grib::readContents({scratch.write("made.grib", m.bytes())});
      contents.grids.at(0)();
      ADD_FAILURE() << "placed";
    } catch (const base::InputError& error) {
      EXPECT_NE(error.problem().find(says), std::string::npos) << error.what();
      EXPECT_NE(error.hint().find("cdo sp2gpl"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace cloudgen
