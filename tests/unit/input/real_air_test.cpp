// SPDX-License-Identifier: Apache-2.0
// Heights and temperatures that are computed, against those that a real model tells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "field/air.hpp"
#include "field/collect.hpp"
#include "field/level_gaps.hpp"
#include "input/catalogue.hpp"

namespace cloudgen {
namespace {

namespace fs = std::filesystem;
using field::Quantity;

const fs::path kData = fs::path(CLOUDGEN_SHARED_DIR) / "data";

#define SKIP_WITHOUT(file) \
  if (!fs::exists(file)) GTEST_SKIP() << "no " << (file)

/// The air of every level over the whole grid, without a quantity where it is to be derived.
std::vector<field::AirLevel> airOf(const field::Source& source, std::optional<Quantity> without,
                                   const field::Surface& surface) {
  std::vector<std::uint32_t> cells(source.grid().size());
  std::iota(cells.begin(), cells.end(), 0u);
  std::vector<field::Level> levels;
  source.visitLevels(cells, [&](const field::Level& level) {
    levels.push_back(level);
    if (without) levels.back().values.erase(*without);
  });
  field::Derivations derivations;
  field::AirMaker maker(source.grid(), cells, surface, derivations);
  std::vector<field::AirLevel> air;
  for (std::size_t i = 0; i < levels.size(); ++i)
    air.push_back(maker.next(levels[i], i + 1 < levels.size() ? &levels[i + 1] : nullptr));
  return air;
}

struct Difference {
  double mean = 0, rms = 0, greatest = 0;
};

/// Of one quantity, at pressures from the ground up to 100 hPa.
Difference difference(const std::vector<field::AirLevel>& made, const std::vector<field::AirLevel>& told,
                      std::vector<float> field::AirLevel::*what, const std::vector<float>& surfacePressure) {
  Difference found;
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < told.size(); ++i)
    for (std::size_t c = 0; c < surfacePressure.size(); ++c) {
      const float pressure = told[i].pressurePa[c];
      if (pressure > surfacePressure[c] || pressure < 10000) continue;
      const double off = (made[i].*what)[c] - (told[i].*what)[c];
      EXPECT_TRUE(std::isfinite(off));
      sum += off, squares += off * off, ++count;
      found.greatest = std::max(found.greatest, std::abs(off));
    }
  found.mean = sum / count;
  found.rms = std::sqrt(squares / count);
  return found;
}

struct Gfs {
  std::unique_ptr<field::Source> source = input::open({kData / "gfs_2p5_20110110_f120.grib2"});
  std::vector<std::uint32_t> cells = [this] {
    std::vector<std::uint32_t> all(source->grid().size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }();
  field::Surface surface = source->surface(cells);
};

TEST(RealAir, ComputedHeightsAreTheModelsOwnWithinSixMeters) {
  SKIP_WITHOUT(kData / "gfs_2p5_20110110_f120.grib2");
  const Gfs gfs;
  ASSERT_FALSE(gfs.surface.heightMeters.empty());
  ASSERT_FALSE(gfs.surface.pressurePa.empty());
  const auto told = airOf(*gfs.source, {}, gfs.surface);
  const auto made = airOf(*gfs.source, Quantity::GeopotentialHeight, gfs.surface);
  const Difference off = difference(made, told, &field::AirLevel::heightMeters, gfs.surface.pressurePa);
  EXPECT_LT(std::abs(off.mean), 3);
  EXPECT_LT(off.rms, 6);
  EXPECT_LT(off.greatest, 60) << "mean " << off.mean << ", rms " << off.rms;
}

TEST(RealAir, TemperaturesFromThicknessAreTheModelsOwnWithinAKelvin) {
  SKIP_WITHOUT(kData / "gfs_2p5_20110110_f120.grib2");
  const Gfs gfs;
  const auto told = airOf(*gfs.source, {}, gfs.surface);
  const auto made = airOf(*gfs.source, Quantity::Temperature, gfs.surface);
  const Difference off = difference(made, told, &field::AirLevel::temperatureK, gfs.surface.pressurePa);
  EXPECT_LT(std::abs(off.mean), 0.5);
  EXPECT_LT(off.rms, 1) << "mean " << off.mean << ", greatest " << off.greatest;
}

/// Mean over the grid of the height at a pressure.
double meanHeight(const field::Source& source, double pressurePa) {
  std::vector<std::uint32_t> cells(source.grid().size());
  std::iota(cells.begin(), cells.end(), 0u);
  const field::Surface surface = source.surface(cells);
  double sum = 0, count = 0;
  for (const field::AirLevel& air : airOf(source, {}, surface))
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (air.pressurePa[c] == static_cast<float>(pressurePa) && std::isfinite(air.heightMeters[c]))
        sum += air.heightMeters[c], ++count;
  return count > 0 ? sum / count : 0;
}

TEST(RealAir, Ruc13HasNoHeightsAndGetsPlausibleOnes) {
  const fs::path ruc = kData / "ruc13_g212_2005080700_f00.grb";
  SKIP_WITHOUT(ruc);
  const auto source = input::open({ruc});
  EXPECT_NEAR(meanHeight(*source, 50000), 5860, 60) << "a summer's 500 hPa over North America";
  EXPECT_NEAR(meanHeight(*source, 85000), 1540, 60);
  const auto cells = field::cellsTouching(source->grid(), {-100, 35, -90, 45});
  const field::CloudColumns columns = field::collectColumns(*source, cells);
  ASSERT_FALSE(columns.cells.empty());
  const auto told = [&](std::string_view how) {
    return std::any_of(columns.derived.begin(), columns.derived.end(),
                       [&](const auto& line) { return line.second.find(how) != std::string::npos; });
  };
  EXPECT_TRUE(told("hypsometric"));
  EXPECT_TRUE(told("Sundqvist"));
  for (const field::CloudCell& cell : columns.cells) {
    EXPECT_LT(cell.baseMeters, cell.topMeters);
    EXPECT_GT(cell.baseMeters, -200);
    EXPECT_LT(cell.topMeters, 20000);
    EXPECT_GT(cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter, 0);
  }
}

TEST(RealAir, IfsOpenDataLacksTemperatureAndMostLevels) {
  const fs::path ifs = kData / "ifs_oper_20240101_10msgs.grib2";
  SKIP_WITHOUT(ifs);
  const auto source = input::open({ifs});
  const auto cells = field::cellsTouching(source->grid(), {-10, 45, 5, 55});
  const field::CloudColumns columns = field::collectColumns(*source, cells);
  ASSERT_FALSE(columns.cells.empty());
  for (const field::CloudCell& cell : columns.cells) {
    EXPECT_GT(cell.temperatureK, 225);
    EXPECT_LT(cell.temperatureK, 300);
  }
}

}  // namespace
}  // namespace cloudgen
