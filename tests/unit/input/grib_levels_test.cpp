// SPDX-License-Identifier: Apache-2.0
// What fields of GRIB mean: levels of every kind, cloud cover by its level, packings.
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "input/grib/grib.hpp"
#include "input/grib/handle.hpp"
#include "input/grib/messages.hpp"
#include "support/made_grib.hpp"
#include "support/scratch.hpp"

namespace cloudgen {
namespace {

namespace fs = std::filesystem;
using field::Quantity;
using input::model::CloudPart;
using input::model::Contents;
using input::model::Field;
using input::model::Single;
using input::model::SingleKind;
using input::model::VerticalKind;
using test::GribMaker;

/// A field of 16 by 31 points (ecCodes' plain sample) by numbers of discipline 0.
GribMaker& numbered(GribMaker& m, long category, long number) {
  return m.whole("discipline", 0).whole("parameterCategory", category).whole("parameterNumber", number);
}

std::string onSurfaces(long category, long number, long first, long firstValue, long second, long secondValue,
                       double value, long centre = 78) {
  GribMaker m("GRIB2");
  m.whole("centre", centre);
  numbered(m, category, number);
  m.values([&](std::size_t) { return value; });
  EXPECT_EQ(m.refused(), "");
  std::string bytes = m.bytes();
  // By hand, since ecCodes has its own mind about which types go with which values.
  constexpr std::size_t kSection4 = 16 + 21 + 72 - 1;
  const auto put = [&](std::size_t octet, long type, long surfaceValue) {
    bytes[kSection4 + octet] = static_cast<char>(type);
    bytes[kSection4 + octet + 1] = 0;
    for (std::size_t i = 0; i < 4; ++i)
      bytes[kSection4 + octet + 2 + i] = static_cast<char>(surfaceValue >> (24 - 8 * i));
  };
  put(23, first, firstValue);
  put(29, second, secondValue);
  return bytes;
}

Contents contentsOf(const std::string& bytes) {
  static const test::Scratch scratch;
  static int count = 0;
  return input::grib::readContents({scratch.write(std::to_string(++count) + ".grib", bytes)});
}

const Field* find(const Contents& contents, const std::variant<Quantity, Single>& meaning,
                  double level = -1) {
  for (const Field& field : contents.fields)
    if (field.meaning == meaning && (level < 0 || field.vertical.value == level)) return &field;
  return nullptr;
}

float firstValue(const Field& field) {
  const std::vector<std::uint32_t> cells{0};
  return field.read(cells).at(0);
}

TEST(GribLevels, HybridLevelsLieBetweenTheirHalfLevels) {
  GribMaker m("reduced_gg_ml_grib2");
  m.text("shortName", "clwc").whole("level", 2);
  const std::vector<double> pv{0, 2000, 1000, 0, 0, 0, 0.5, 1};
  m.whole("PVPresent", 1).numbers("pv", pv);
  ASSERT_EQ(m.refused(), "");
  const Contents contents = contentsOf(m.bytes());
  const Field* field = find(contents, Quantity::CloudLiquid);
  ASSERT_TRUE(field);
  EXPECT_EQ(field->vertical.kind, VerticalKind::Hybrid);
  EXPECT_EQ(field->vertical.value, 2);
  EXPECT_NEAR(field->vertical.a, 1500, 0.01);
  EXPECT_NEAR(field->vertical.b, 0.25, 1e-6);
}

TEST(GribLevels, LayersOfIconTakeTheirHeightFromTheHalfLevels) {
  std::string bytes;
  for (const int k : {1, 2, 3}) bytes += onSurfaces(3, 6, 150, k, 101, 0, 4000 - 1000 * k);
  for (const int k : {1, 2}) bytes += onSurfaces(1, 22, 150, k, 150, k + 1, 1e-4);
  const Contents contents = contentsOf(bytes);
  const Field *upper = find(contents, Quantity::Height, 1), *lower = find(contents, Quantity::Height, 2);
  ASSERT_TRUE(upper && lower);
  EXPECT_EQ(upper->vertical.kind, VerticalKind::ModelLevel);
  EXPECT_FALSE(upper->valid);
  EXPECT_NEAR(firstValue(*upper), 2500, 0.1);
  EXPECT_NEAR(firstValue(*lower), 1500, 0.1);
  EXPECT_TRUE(find(contents, Quantity::CloudCondensate, 2));
}

TEST(GribLevels, CoverBelongsToThePartThatItsLevelNames) {
  const std::string bytes =
      onSurfaces(6, 1, 214, 0, 255, 0, 10, 7) + onSurfaces(6, 1, 224, 0, 255, 0, 20, 7) +
      onSurfaces(6, 1, 234, 0, 255, 0, 30, 7) + onSurfaces(6, 1, 244, 0, 255, 0, 40, 7) +
      onSurfaces(6, 1, 200, 0, 255, 0, 50, 7) + onSurfaces(6, 1, 211, 0, 255, 0, 99, 7);
  const Contents contents = contentsOf(bytes);
  EXPECT_EQ(contents.fields.size(), 5u);  // low cover goes before that of the boundary layer
  const std::pair<CloudPart, float> kExpected[] = {{CloudPart::Low, 10.f},
                                                   {CloudPart::Middle, 20.f},
                                                   {CloudPart::High, 30.f},
                                                   {CloudPart::Convective, 40.f},
                                                   {CloudPart::Total, 50.f}};
  for (const auto& [part, cover] : kExpected) {
    const Field* field = find(contents, Single{SingleKind::CloudCover, part});
    ASSERT_TRUE(field);
    EXPECT_TRUE(field->inPercent);
    EXPECT_NEAR(firstValue(*field), cover, 0.1);
  }
}

TEST(GribLevels, CoverOfDwdBetweenPressuresIsLowMiddleAndHigh) {
  const Contents contents =
      contentsOf(onSurfaces(6, 22, 100, 80000, 1, 0, 10) + onSurfaces(6, 22, 100, 40000, 100, 80000, 20) +
                 onSurfaces(6, 22, 100, 0, 100, 40000, 30));
  EXPECT_NEAR(firstValue(*find(contents, Single{SingleKind::CloudCover, CloudPart::Low})), 10, 0.1);
  EXPECT_NEAR(firstValue(*find(contents, Single{SingleKind::CloudCover, CloudPart::Middle})), 20, 0.1);
  EXPECT_NEAR(firstValue(*find(contents, Single{SingleKind::CloudCover, CloudPart::High})), 30, 0.1);
}

TEST(GribLevels, ScreenTemperatureIsNoLevelButSeveralHeightsWithWaterAre) {
  const std::string water = onSurfaces(1, 22, 100, 85000, 255, 0, 1e-4);
  EXPECT_EQ(contentsOf(water + onSurfaces(0, 0, 103, 2, 255, 0, 280)).fields.size(), 1u);
  std::string tower;
  for (const int height : {20, 100, 500, 1000})
    tower += onSurfaces(1, 83, 103, height, 255, 0, 1e-4) + onSurfaces(0, 0, 103, height, 255, 0, 280);
  const Contents contents = contentsOf(tower);
  EXPECT_EQ(contents.fields.size(), 8u);
  EXPECT_EQ(contents.fields.front().vertical.kind, VerticalKind::HeightAboveGround);
}

TEST(GribLevels, GeopotentialAtTheGroundIsItsHeightAndRainIsUnused) {
  const Contents contents =
      contentsOf(onSurfaces(3, 4, 1, 0, 255, 0, 980.665) + onSurfaces(1, 24, 100, 50000, 255, 0, 1e-3));
  const Field* ground = find(contents, Single{SingleKind::SurfaceHeight});
  ASSERT_TRUE(ground);
  EXPECT_FALSE(ground->valid);
  EXPECT_NEAR(firstValue(*ground), 100, 0.01);
  ASSERT_EQ(contents.unused.size(), 1u);
  EXPECT_NE(contents.unused.front().find("rwmr"), std::string::npos);
}

TEST(GribPackings, GiveBackWhatWasPackedWithAndWithoutABitmap) {
  for (const auto& [edition, packing] : {std::pair{2, "grid_simple"},
                                         {2, "grid_complex"},
                                         {2, "grid_complex_spatial_differencing"},
                                         {2, "grid_jpeg"},
                                         {2, "grid_ccsds"},
                                         {2, "grid_ieee"},
                                         {1, "grid_simple"},
                                         {1, "grid_second_order"},
                                         {1, "grid_second_order_no_SPD"},
                                         {1, "grid_second_order_SPD1"},
                                         {1, "grid_second_order_boustrophedonic"}})
    for (const bool withBitmap : {false, true}) {
      // ecCodes 2.28 spoils what it packs so under a bitmap; the real GFS file has such fields.
      if (withBitmap && std::string(packing).starts_with("grid_complex")) continue;
      test::GribField field{edition, 700};
      field.packing = packing;
      field.bits = 16;
      if (withBitmap) field.missing = {3, 7};
      const Contents contents = contentsOf(
          test::made(field.with(test::Variable::Temperature, [](int i) { return 250.0 + (i * 7) % 12; })));
      std::vector<std::uint32_t> cells(12);
      for (std::uint32_t i = 0; i < 12; ++i) cells[i] = i;
      const std::vector<float> values = contents.fields.at(0).read(cells);
      for (std::uint32_t i = 0; i < 12; ++i) {
        if (withBitmap && (i == 3 || i == 7))
          EXPECT_TRUE(std::isnan(values[i])) << packing << " " << i;
        else
          EXPECT_NEAR(values[i], 250.0 + (i * 7) % 12, 0.01) << packing << " " << i;
      }
    }
}

TEST(GribPackings, PngGivesBackWhatWasPacked) {
  GribMaker m("GRIB2");
  numbered(m, 0, 0).whole("bitsPerValue", 16);
  const auto valueAt = [](std::size_t i) { return 250.0 + static_cast<double>(i % 31); };
  m.values(valueAt).text("packingType", "grid_png").values(valueAt);
  ASSERT_EQ(m.refused(), "");
  m.whole("typeOfFirstFixedSurface", 100).whole("level", 500);
  const Contents contents = contentsOf(m.bytes());
  const std::vector<std::uint32_t> cells{0, 17, 495};
  const std::vector<float> values = contents.fields.at(0).read(cells);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_NEAR(values[i], valueAt(cells[i]), 0.01);
}

TEST(GribPackings, TablesOfGroupsThatLieAreRefused) {
  test::GribField field{2, 700};
  field.packing = "grid_complex";
  const std::string good =
      test::made(field.with(test::Variable::Temperature, [](int i) { return 250.0 + (i * 7) % 12; }));
  const std::size_t section5 = 16 + 21 + 72 + 34 - 1;
  for (const std::size_t octet : {20u, 32u, 36u, 37u, 38u, 43u, 47u}) {
    std::string bad = good;
    bad[section5 + octet] = '\x7f';
    const Contents contents = contentsOf(bad);
    const std::vector<std::uint32_t> cells{0};
    EXPECT_THROW(contents.fields.at(0).read(cells), base::InputError) << octet;
  }
}

/// Fields of messages with several, bitmaps, every packing of the real files: what ecCodes reads is read.
TEST(GribPackings, RealValuesAreThoseOfEcCodes) {
  for (const char* name : {"gfs_2p5_20110110_f120.grib2", "eta_g211_lambert_20041208_f24.grib2",
                           "ruc13_g212_2005080700_f12.grb", "wafs_thinned_reduced_ll_20070110.grib2",
                           "cfs_flux_regular_gg_20060331.grb", "ifs_oper_20240101_10msgs.grib2"}) {
    const fs::path path = fs::path(CLOUDGEN_SHARED_DIR) / "data" / name;
    if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
    const auto heads = input::grib::locateFields(path);
    codes_grib_multi_support_on(nullptr);
    std::FILE* file = std::fopen(path.c_str(), "rb");
    int error = 0;
    std::size_t index = 0;
    while (codes_handle* handle = codes_handle_new_from_file(nullptr, file, PRODUCT_GRIB, &error)) {
      ASSERT_LT(index, heads.size());
      if (index % 7 == 0) {
        std::size_t count = 0;
        codes_set_double(handle, "missingValue", 1e30);
        codes_get_size(handle, "values", &count);
        std::vector<double> expected(count);
        codes_get_double_array(handle, "values", expected.data(), &count);
        const auto values = input::grib::decodedValues(heads[index].location, count);
        for (std::size_t i = 0; i < count; ++i) {
          if (std::isnan(values[i]) ? expected[i] != 1e30 : values[i] != expected[i]) {
            ADD_FAILURE() << name << " field " << index << " value " << i;
            break;
          }
        }
      }
      codes_handle_delete(handle);
      ++index;
    }
    std::fclose(file);
    codes_grib_multi_support_off(nullptr);
    EXPECT_EQ(index, heads.size()) << name;
  }
}

/// Every real file cut at every fiftieth: an error that names the place, never a crash.
TEST(GribDamage, FilesCutShortSaySo) {
  const test::Scratch scratch;
  for (const char* name : {"eta_g211_lambert_20041208_f24.grib2", "ruc13_g212_2005080700_f12.grb",
                           "wafs_thinned_reduced_ll_20070110.grib2", "cfs_flux_regular_gg_20060331.grb",
                           "ifs_oper_20240101_10msgs.grib2", "icon-eu_CLCT_MOD_20220427_f047.grib2"}) {
    const fs::path file = fs::path(CLOUDGEN_SHARED_DIR) / "data" / name;
    if (!fs::exists(file)) GTEST_SKIP() << "no " << file;
    const std::string whole = base::readFile(file);
    std::set<std::uint64_t> starts;
    for (const auto& head : input::grib::locateFields(file)) starts.insert(head.location.messageOffset);
    for (std::size_t part = 0; part < 50; ++part) {
      const std::uint64_t length = whole.size() * part / 50 + part % 7;
      // Whole messages with up to three letters of "GRIB" behind them are a file of its own.
      const auto next = starts.upper_bound(length);
      if (next != starts.begin() && length > 0 && length - *std::prev(next) < 4) continue;
      const fs::path cut = scratch.write("cut", whole.substr(0, length));
      try {
        input::grib::readContents({cut});
        ADD_FAILURE() << name << " cut at " << part << "/50 was read";
      } catch (const base::InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace cloudgen
