// SPDX-License-Identifier: Apache-2.0
// Derived genera of real skies under noise of 1 % on everything that the model says.
#include <cmath>
#include <filesystem>
#include <map>

#include "base/random.hpp"
#include "field/collect.hpp"
#include "input/catalogue.hpp"
#include "pipeline/location.hpp"
#include "pipeline/type.hpp"

namespace cloudgen::pipeline {
namespace {

using field::Layer;
using field::Quantity;

/// A source of levels whose amounts are multiplied by 1 + 1 % Gaussian noise, a value of its own for each
/// cell, level and quantity; temperatures are moved by 1 % of their standard deviation over all that is read.
class NoisySource : public field::Source {
 public:
  NoisySource(const field::Source& source, std::uint64_t seed, std::span<const std::uint32_t> cells)
      : source_(source), seed_(seed) {
    double sum = 0, squares = 0, count = 0;
    source.visitLevels(cells, [&](const field::Level& level) {
      if (!level.has(Quantity::Temperature)) return;
      for (const float value : level.of(Quantity::Temperature))
        if (std::isfinite(value)) sum += value, squares += double{value} * value, ++count;
    });
    if (count > 0) spreadKelvin_ = std::sqrt(squares / count - sum / count * (sum / count));
  }
  const field::SourceInfo& info() const override { return source_.info(); }
  const field::Grid& grid() const override { return source_.grid(); }
  field::Telling telling() const override { return source_.telling(); }
  field::Surface surface(std::span<const std::uint32_t> cells) const override {
    return source_.surface(cells);
  }
  void visitLevels(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::Level&)>& visit) const override {
    std::uint64_t number = 0;
    source_.visitLevels(cells, [&](const field::Level& level) {
      field::Level noisy = level;
      for (auto& [quantity, values] : noisy.values) disturb(quantity, number, cells, values);
      ++number;
      visit(noisy);
    });
  }

 private:
  void disturb(Quantity quantity, std::uint64_t level, std::span<const std::uint32_t> cells,
               std::vector<float>& values) const {
    const bool isAmount = quantity == Quantity::CloudCondensate || quantity == Quantity::CloudLiquid ||
                          quantity == Quantity::CloudIce || quantity == Quantity::CloudFraction ||
                          quantity == Quantity::RelativeHumidity || quantity == Quantity::SpecificHumidity;
    if (!isAmount && quantity != Quantity::Temperature) return;
    for (std::size_t c = 0; c < values.size(); ++c) {
      base::RandomStream stream(seed_, cells[c], base::Purpose::Test,
                                1000 * level + static_cast<std::uint64_t>(quantity));
      const auto noise = static_cast<float>(0.01 * stream.gaussian());
      values[c] = isAmount ? values[c] * (1 + noise) : values[c] + noise * static_cast<float>(spreadKelvin_);
    }
  }

  const field::Source& source_;
  std::uint64_t seed_;
  double spreadKelvin_ = 0;
};

std::vector<Layer> typedLayers(const field::Source& source, const std::vector<std::uint32_t>& cells) {
  std::vector<Layer> layers = locateLayers(field::collectColumns(source, cells));
  joinPatches(source.grid(), layers);
  typeLayers(source.grid(), layers);
  return layers;
}

/// The layer of the same cell that shares most height with a layer; null if none shares any.
const Layer* counterpart(const Layer& layer, const std::vector<Layer>& others) {
  const Layer* best = nullptr;
  float most = 0;
  const auto first = std::partition_point(others.begin(), others.end(),
                                          [&](const Layer& other) { return other.cell < layer.cell; });
  for (auto other = first; other != others.end() && other->cell == layer.cell; ++other) {
    const float shared = field::overlapMeters(layer, *other);
    if (shared > most) best = &*other, most = shared;
  }
  return best;
}

/// Cover, km2, and how much of it keeps its genus; what changed, by the rules before and after.
struct Kept {
  double area = 0, kept = 0;
  std::map<std::string, double> changed;

  double share() const { return kept / area; }
  void compare(const field::Grid& grid, const std::vector<Layer>& before, const std::vector<Layer>& after) {
    for (const Layer& layer : before) {
      const double cover = 1e-6 * layer.fraction * field::cellAreaSquareMeters(grid, layer.cell);
      const Layer* other = counterpart(layer, after);
      area += cover;
      if (other && other->genus == layer.genus)
        kept += cover;
      else
        changed[std::string(layer.rule) + " -> " + (other ? std::string(other->rule) : "no layer")] += cover;
    }
  }
};

std::ostream& operator<<(std::ostream& stream, const Kept& kept) {
  stream << 100 * kept.share() << " % of " << kept.area << " km2 keep their genus";
  for (const auto& [rules, area] : kept.changed)
    stream << "\n  " << 100 * area / kept.area << " %: " << rules;
  return stream;
}

class Stability : public testing::Test {
 protected:
  static std::filesystem::path data(const std::string& name) {
    return std::filesystem::path(CLOUDGEN_SHARED_DIR) / "data" / name;
  }
  /// Several draws of noise over all times of a file.
  static Kept kept(const std::string& name, std::optional<base::GeoBox> box, int draws) {
    Kept kept;
    const std::vector<base::UtcTime> times = input::open({data(name)})->info().validTimes;
    for (const base::UtcTime time : times) {
      input::OpenOptions options;
      options.time = time;
      const auto source = input::open({data(name)}, options);
      const auto cells = field::cellsTouching(source->grid(), box.value_or(field::extent(source->grid())));
      const auto before = typedLayers(*source, cells);
      for (int draw = 0; draw < draws; ++draw)
        kept.compare(source->grid(), before,
                     typedLayers(NoisySource(*source, static_cast<std::uint64_t>(draw), cells), cells));
    }
    RecordProperty("kept", testing::PrintToString(kept));
    return kept;
  }
};

#define NEEDS(name) \
  if (!std::filesystem::exists(data(name))) GTEST_SKIP() << "../shared/data/" << name << " is not there"

TEST_F(Stability, OfAGlobalModel) {
  NEEDS("gfs_2p5_20110110_f120.grib2");
  EXPECT_GE(kept("gfs_2p5_20110110_f120.grib2", std::nullopt, 2).share(), 0.97);
}

TEST_F(Stability, OfEasternNorthAmerica) {
  NEEDS("gfs_2p5_20110110_f120.grib2");
  EXPECT_GE(kept("gfs_2p5_20110110_f120.grib2", base::GeoBox{-100, 25, -60, 50}, 5).share(), 0.97);
}

TEST_F(Stability, OfAHurricane) {
  NEEDS("wrfout_katrina_mercator_20050828.nc");
  EXPECT_GE(kept("wrfout_katrina_mercator_20050828.nc", std::nullopt, 2).share(), 0.97);
}

TEST_F(Stability, OfASingleColumn) {
  NEEDS("icon_ny-alesund_column_20210104.nc");
  EXPECT_GE(kept("icon_ny-alesund_column_20210104.nc", std::nullopt, 5).share(), 0.97);
}

// Where humidity is all that is known it makes the clouds: 1 % of it moves their covers by far more.
TEST_F(Stability, OfCloudsFromHumidityAlone) {
  NEEDS("ruc13_g212_2005080700_f12.grb");
  EXPECT_GE(kept("ruc13_g212_2005080700_f12.grb", std::nullopt, 1).share(), 0.95);
}

}  // namespace
}  // namespace cloudgen::pipeline
