// SPDX-License-Identifier: Apache-2.0
// Variables, units, packing, levels and times of files made here.
#include <cmath>

#include "input/netcdf/units.hpp"
#include "netcdf_cases.hpp"

namespace cloudgen {
namespace {

using field::Quantity;
using input::model::CloudPart;
using input::model::Single;
using input::model::SingleKind;
using input::model::VerticalKind;
using test::contentsOf;
using test::fieldsOf;
using test::NetcdfFile;
using test::plainFile;

/// One value at the first cell of the first field of a quantity.
float firstValue(const input::model::Contents& contents, Quantity quantity) {
  const auto fields = fieldsOf(contents, quantity);
  if (fields.empty()) return -12345;
  return test::read(contents, *fields.front()).front();
}

TEST(NetcdfCf, EveryOrderOfDimensionsMeansTheSame) {
  std::vector<std::string> order{"lat", "level", "lon", "time"};
  do {
    const auto contents = contentsOf(plainFile(order));
    const auto fields = fieldsOf(contents, Quantity::CloudLiquid);
    ASSERT_EQ(fields.size(), 4u);
    const bool usual = order == std::vector<std::string>{"time", "level", "lat", "lon"};
    EXPECT_EQ(std::any_of(contents.warnings.begin(), contents.warnings.end(),
                          [](const auto& warning) { return warning.id == "dimension_order"; }),
              !usual);
    for (const auto* field : fields) {
      const std::size_t level = field->vertical.value == 50000 ? 0 : 1;
      const std::size_t time = field->valid == base::utcFromIso("2020-01-01T06:00:00Z") ? 1 : 0;
      const auto values = test::read(contents, *field);
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
          ASSERT_FLOAT_EQ(values[row * 4 + column],
                          static_cast<float>(test::caseValue(column, row, level, time)));
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(NetcdfCf, EveryKindOfFileMeansTheSame) {
  for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4, NC_NETCDF4 | NC_CLASSIC_MODEL}) {
    NetcdfFile file = plainFile();
    file.format = format;
    EXPECT_FLOAT_EQ(firstValue(contentsOf(file), Quantity::CloudLiquid), 1e-6f);
  }
}

TEST(NetcdfCf, OddUnitsAreUnderstood) {
  const auto factor = [](const char* from, const char* to) {
    const auto found = input::netcdf::conversion(from, to);
    return found ? found->factor : std::nan("");
  };
  EXPECT_DOUBLE_EQ(factor("(0 - 1)", "1"), 1);
  EXPECT_DOUBLE_EQ(factor("~", "1"), 1);
  EXPECT_DOUBLE_EQ(factor("kg kg**-1", "1"), 1);
  EXPECT_NEAR(factor("g kg-1", "1"), 1e-3, 1e-15);
  EXPECT_NEAR(factor("g/kg", "1"), 1e-3, 1e-15);
  EXPECT_NEAR(factor("mg/kg", "1"), 1e-6, 1e-18);
  EXPECT_NEAR(factor("mb", "Pa"), 100, 1e-9);
  EXPECT_NEAR(factor("millibars", "Pa"), 100, 1e-9);
  EXPECT_NEAR(factor("hPa", "Pa"), 100, 1e-9);
  EXPECT_NEAR(factor("m**2 s**-2", "m2 s-2"), 1, 1e-12);
  EXPECT_NEAR(factor("gpm", "m"), 1, 1e-12);
  EXPECT_NEAR(factor("km", "m"), 1000, 1e-9);
  EXPECT_NEAR(factor("Pa s**-1", "Pa s-1"), 1, 1e-12);
  EXPECT_NEAR(factor("knots", "m s-1"), 0.514444, 1e-5);
  EXPECT_NEAR(input::netcdf::conversion("C", "K")->offset, 273.15, 1e-9);
  EXPECT_NEAR(input::netcdf::conversion("degC", "K")->offset, 273.15, 1e-9);
  EXPECT_TRUE(input::netcdf::isPercent("%"));
  EXPECT_TRUE(input::netcdf::isPercent("percent"));
  EXPECT_FALSE(input::netcdf::isPercent("1"));
  EXPECT_FALSE(input::netcdf::conversion("code table 4.2", "1"));
  EXPECT_FALSE(input::netcdf::conversion("m", "Pa"));
  EXPECT_FALSE(input::netcdf::conversion(std::string(100000, '('), "Pa"));
}

TEST(NetcdfCf, UnitsOfVariablesBecomeSi) {
  NetcdfFile file = plainFile();
  file.variable("clwc").texts["units"] = "g kg-1";
  EXPECT_NEAR(firstValue(contentsOf(file), Quantity::CloudLiquid), 1e-9, 1e-15);
  file.variable("clwc").name = "t";
  file.variable("t").texts["units"] = "degC";
  EXPECT_NEAR(firstValue(contentsOf(file), Quantity::Temperature), 273.15, 1e-4);
  file.variable("t").name = "z";
  file.variable("z").texts["units"] = "m**2 s**-2";
  EXPECT_NEAR(firstValue(contentsOf(file), Quantity::GeopotentialHeight), 1e-6 / 9.80665, 1e-12);
  file.variable("z").texts["units"] = "gpm";
  EXPECT_NEAR(firstValue(contentsOf(file), Quantity::GeopotentialHeight), 1e-6, 1e-12);
  // Upward wind in m/s is no pressure velocity.
  file.variable("z").name = "w";
  file.variable("w").texts["units"] = "m s-1";
  EXPECT_TRUE(fieldsOf(contentsOf(file), Quantity::VerticalVelocity).empty());
}

TEST(NetcdfCf, UnknownUnitIsSaid) {
  NetcdfFile file = plainFile();
  file.variable("clwc").texts["units"] = "fnords";
  EXPECT_TRUE(test::warns(contentsOf(file), "unit_unknown"));
  file.variable("clwc").name = "t";
  file.variable("t").texts.clear();
  EXPECT_TRUE(test::warns(contentsOf(file), "unit_missing"));
}

TEST(NetcdfCf, CoverInPerCentIsMarked) {
  NetcdfFile file = plainFile();
  file.variable("clwc").name = "cl";
  file.variable("cl").texts["units"] = "%";
  const auto contents = contentsOf(file);
  ASSERT_FALSE(fieldsOf(contents, Quantity::CloudFraction).empty());
  EXPECT_TRUE(fieldsOf(contents, Quantity::CloudFraction).front()->inPercent);
  file.variable("cl").texts["units"] = "(0 - 1)";
  EXPECT_FALSE(fieldsOf(contentsOf(file), Quantity::CloudFraction).front()->inPercent);
}

TEST(NetcdfCf, NamesAreTriedInTurn) {
  const auto named = [](const std::string& name, const std::map<std::string, std::string>& attributes) {
    NetcdfFile file = plainFile();
    file.variable("clwc").texts.insert(attributes.begin(), attributes.end());
    file.variable("clwc").name = name;
    return contentsOf(file);
  };
  EXPECT_FALSE(
      fieldsOf(named("abc", {{"standard_name", "mass_fraction_of_cloud_ice_in_air"}}), Quantity::CloudIce)
          .empty());
  EXPECT_FALSE(fieldsOf(named("abc", {{"GRIB_shortName", "ciwc"}}), Quantity::CloudIce).empty());
  EXPECT_FALSE(fieldsOf(named("QI", {}), Quantity::CloudIce).empty());
  EXPECT_FALSE(fieldsOf(named("cli", {{"standard_name", "unknown"}}), Quantity::CloudIce).empty());
  EXPECT_FALSE(fieldsOf(named("mr_lsliq", {}), Quantity::CloudLiquid).empty());
  EXPECT_TRUE(fieldsOf(named("clwc", {{"standard_name", "age_of_stratospheric_air"}}), Quantity::CloudLiquid)
                  .empty());
  EXPECT_EQ(named("crwc", {}).unused, std::vector<std::string>{"rain: crwc"});
}

TEST(NetcdfCf, PackedAndMissingValuesAreUndone) {
  NetcdfFile file = plainFile();
  auto& water = file.variable("clwc");
  water.type = NC_SHORT;
  for (std::size_t i = 0; i < water.values.size(); ++i) water.values[i] = static_cast<double>(i);
  water.numbers = {{"scale_factor", {1e-6}},
                   {"add_offset", {5e-6}},
                   {"_FillValue", {1}},
                   {"missing_value", {2}},
                   {"valid_range", {0, 5}}};
  // A range of the type of the packed values counts packed; this one is floating: unpacked.
  water.numbers["valid_range"] = {5e-6, 10e-6};
  const auto contents = contentsOf(file);
  const auto values = test::read(contents, *fieldsOf(contents, Quantity::CloudLiquid).front());
  EXPECT_FLOAT_EQ(values[0], 5e-6f);
  EXPECT_TRUE(std::isnan(values[1])) << "_FillValue";
  EXPECT_TRUE(std::isnan(values[2])) << "missing_value";
  EXPECT_FLOAT_EQ(values[5], 10e-6f);
  EXPECT_TRUE(std::isnan(values[6])) << "over valid_range";
}

TEST(NetcdfCf, UnwrittenValuesAreMissing) {
  NetcdfFile file = plainFile();
  file.variable("clwc").values.clear();
  file.variable("clwc").type = NC_FLOAT;
  EXPECT_TRUE(std::isnan(firstValue(contentsOf(file), Quantity::CloudLiquid)));
}

TEST(NetcdfCf, LevelsWithoutUnitArePressuresIfTheyLookIt) {
  NetcdfFile file = plainFile();
  file.variable("level").texts.clear();
  auto contents = contentsOf(file);
  EXPECT_EQ(contents.fields.front().vertical.kind, VerticalKind::Pressure);
  EXPECT_EQ(contents.fields.front().vertical.value, 50000);
  EXPECT_TRUE(test::warns(contents, "level_unit_assumed"));
  file.variable("level").values = {1, 2};
  contents = contentsOf(file);
  EXPECT_EQ(contents.fields.front().vertical.kind, VerticalKind::ModelLevel);
}

TEST(NetcdfCf, HeightsAreAboveGroundOrSea) {
  NetcdfFile file = plainFile();
  auto& level = file.variable("level");
  level.texts = {{"units", "km"}, {"standard_name", "height"}, {"positive", "up"}};
  level.values = {1, 2};
  EXPECT_EQ(contentsOf(file).fields.front().vertical.kind, VerticalKind::HeightAboveGround);
  EXPECT_EQ(contentsOf(file).fields.front().vertical.value, 1000);
  level.texts["standard_name"] = "altitude";
  EXPECT_EQ(contentsOf(file).fields.front().vertical.kind, VerticalKind::HeightAboveSea);
}

TEST(NetcdfCf, HybridLevelsTakeTheirFormula) {
  NetcdfFile file = plainFile();
  file.variable("level").texts = {{"standard_name", "atmosphere_hybrid_sigma_pressure_coordinate"},
                                  {"formula_terms", "a: hyam b: hybm p0: p0 ps: aps"}};
  file.variable("level").values = {1, 2};
  file.variables.push_back({"hyam", {"level"}, {}, {0.1, 0}});
  file.variables.push_back({"hybm", {"level"}, {}, {0.5, 0.99}});
  file.variables.push_back({"p0", {}, {{"units", "hPa"}}, {1000}});
  file.variables.push_back({"aps", {"lat", "lon"}, {{"units", "hPa"}}, std::vector<double>(12, 990)});
  auto contents = contentsOf(file);
  const auto& vertical = fieldsOf(contents, Quantity::CloudLiquid)[0]->vertical;
  EXPECT_EQ(vertical.kind, VerticalKind::Hybrid);
  EXPECT_NEAR(vertical.a, 10000, 1e-6);
  EXPECT_NEAR(vertical.b, 0.5, 1e-12);
  const auto* pressure = test::singleOf(contents, Single{SingleKind::SurfacePressure});
  ASSERT_TRUE(pressure);
  EXPECT_NEAR(test::read(contents, *pressure).front(), 99000, 1e-2);
}

TEST(NetcdfCf, HybridHeightsFollowTheGround) {
  NetcdfFile file = plainFile();
  file.variable("level").texts = {{"standard_name", "atmosphere_hybrid_height_coordinate"},
                                  {"formula_terms", "a: lev_a b: lev_b orog: orog"}};
  file.variable("level").values = {1, 2};
  file.variables.push_back({"lev_a", {"level"}, {{"units", "m"}}, {20, 100}});
  file.variables.push_back({"lev_b", {"level"}, {}, {0.9, 0.5}});
  file.variables.push_back({"orog",
                            {"lat", "lon"},
                            {{"units", "m"}, {"standard_name", "surface_altitude"}},
                            std::vector<double>(12, 300)});
  const auto contents = contentsOf(file);
  const auto heights = fieldsOf(contents, Quantity::Height);
  ASSERT_EQ(heights.size(), 4u);
  EXPECT_NEAR(test::read(contents, *heights[0]).front(), 20 + 0.9 * 300, 1e-3);
  EXPECT_NEAR(test::read(contents, *heights[1]).front(), 100 + 0.5 * 300, 1e-3);
  EXPECT_TRUE(test::singleOf(contents, Single{SingleKind::SurfaceHeight}));
}

TEST(NetcdfCf, ALevelCanBeAScalarCoordinate) {
  NetcdfFile file = plainFile();
  file.drop("clwc");
  file.drop("level");
  file.variables.push_back({"plev", {}, {{"units", "hPa"}}, {700}});
  file.variables.push_back({"clwc",
                            {"time", "lat", "lon"},
                            {{"units", "1"}, {"coordinates", "plev"}},
                            test::caseValues(file, {"time", "lat", "lon"})});
  const auto contents = contentsOf(file);
  ASSERT_EQ(fieldsOf(contents, Quantity::CloudLiquid).size(), 2u);
  EXPECT_EQ(fieldsOf(contents, Quantity::CloudLiquid)[0]->vertical.value, 70000);
}

TEST(NetcdfCf, CoverOnSingleLevelsIsFound) {
  NetcdfFile file = plainFile();
  for (const char* name : {"tcc", "lcc", "mcc", "hcc"})
    file.variables.push_back({name,
                              {"time", "lat", "lon"},
                              {{"units", "(0 - 1)"}},
                              test::caseValues(file, {"time", "lat", "lon"})});
  const auto contents = contentsOf(file);
  for (const CloudPart part : {CloudPart::Total, CloudPart::Low, CloudPart::Middle, CloudPart::High})
    EXPECT_TRUE(test::singleOf(contents, Single{SingleKind::CloudCover, part}));
}

TEST(NetcdfCf, WaterPerDryAirBecomesPerMoistAir) {
  NetcdfFile file = plainFile();
  file.variable("clwc").texts["standard_name"] = "cloud_liquid_water_mixing_ratio";
  file.variables.push_back({"mixing_ratio",
                            {"time", "level", "lat", "lon"},
                            {{"units", "g/kg"}, {"standard_name", "humidity_mixing_ratio"}},
                            std::vector<double>(48, 20)});
  const auto contents = contentsOf(file);
  EXPECT_NEAR(firstValue(contents, Quantity::SpecificHumidity), 0.02 / 1.02, 1e-8);
  EXPECT_NEAR(firstValue(contents, Quantity::CloudLiquid), 1e-6 / 1.02, 1e-12);
}

TEST(NetcdfCf, PotentialTemperatureBecomesTemperature) {
  NetcdfFile file = plainFile();
  file.variables.push_back({"theta",
                            {"time", "level", "lat", "lon"},
                            {{"units", "K"}, {"standard_name", "air_potential_temperature"}},
                            std::vector<double>(48, 300)});
  EXPECT_NEAR(firstValue(contentsOf(file), Quantity::Temperature), 300 * std::pow(0.5, 2.0 / 7.0), 1e-3);
}

TEST(NetcdfCf, NewCdsNamesAndPreliminaryDataAreRead) {
  NetcdfFile file;
  file.dimensions = {
      {"valid_time", 2}, {"pressure_level", 1}, {"expver", 2}, {"latitude", 1}, {"longitude", 2}};
  const double nan = std::nan("");
  file.variables = {{"valid_time",
                     {"valid_time"},
                     {{"units", "seconds since 1970-01-01"}, {"standard_name", "time"}},
                     {1577836800, 1577840400}},
                    {"pressure_level", {"pressure_level"}, {{"units", "hPa"}}, {850}},
                    {"latitude", {"latitude"}, {{"units", "degrees_north"}}, {50}},
                    {"longitude", {"longitude"}, {{"units", "degrees_east"}}, {10, 11}},
                    {"clwc",
                     {"valid_time", "expver", "pressure_level", "latitude", "longitude"},
                     {{"units", "kg kg**-1"}},
                     {1, 2, nan, nan, nan, nan, 3, 4}}};
  const auto contents = contentsOf(file);
  const auto fields = fieldsOf(contents, Quantity::CloudLiquid);
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[1]->valid, base::utcFromIso("2020-01-01T01:00:00Z"));
  EXPECT_EQ(test::read(contents, *fields[0]), (std::vector<float>{1, 2}));
  EXPECT_EQ(test::read(contents, *fields[1]), (std::vector<float>{3, 4}));
}

TEST(NetcdfCf, SeveralFilesMakeOneGrid) {
  const test::Scratch scratch;
  NetcdfFile water = plainFile(), warmth = plainFile();
  warmth.variable("clwc").name = "t";
  warmth.variable("t").texts["units"] = "K";
  test::writeNetcdf(scratch.path() / "a.nc", water);
  test::writeNetcdf(scratch.path() / "b.nc", warmth);
  const auto contents = input::netcdf::readContents({scratch.path() / "a.nc", scratch.path() / "b.nc"}, {});
  EXPECT_EQ(contents.grids.size(), 1u);
  EXPECT_EQ(fieldsOf(contents, Quantity::CloudLiquid).size(), 4u);
  EXPECT_EQ(fieldsOf(contents, Quantity::Temperature).size(), 4u);
}

TEST(NetcdfCf, EnsembleMembersKeepTheirNumbers) {
  NetcdfFile file = plainFile();
  file.dimensions.push_back({"number", 2});
  file.variables.push_back({"number", {"number"}, {}, {7, 9}});
  file.variable("clwc").dimensions = {"number", "time", "level", "lat", "lon"};
  file.variable("clwc").values = test::caseValues(file, file.variable("clwc").dimensions);
  const auto contents = contentsOf(file);
  ASSERT_EQ(contents.fields.size(), 8u);
  EXPECT_EQ(contents.fields.front().member, 7);
  EXPECT_EQ(contents.fields.back().member, 9);
}

}  // namespace
}  // namespace cloudgen
