// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "field/collect.hpp"
#include "field/hypsometry.hpp"
#include "field/source.hpp"

namespace cloudgen::field {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Columns at 45 N; levels are given from the ground upwards.
class MadeLevels : public Source {
 public:
  explicit MadeLevels(int columns = 1) {
    grid_.columns = columns, grid_.rows = 1;
    grid_.firstX = 10, grid_.firstY = 45, grid_.stepX = grid_.stepY = 1;
    info_.files = {"made"};
  }
  const SourceInfo& info() const override { return info_; }
  const Grid& grid() const override { return grid_; }
  Telling telling() const override { return Telling::Levels; }
  void visitLevels(std::span<const std::uint32_t>,
                   const std::function<void(const Level&)>& visit) const override {
    for (const Level& level : levels) visit(level);
  }
  Surface surface(std::span<const std::uint32_t>) const override { return ground; }

  CloudColumns collected() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t cell = 0; cell < grid_.size(); ++cell) all.push_back(cell);
    return collectColumns(*this, all);
  }
  void erase(Quantity quantity) {
    for (Level& level : levels) level.values.erase(quantity);
  }

  std::vector<Level> levels;
  Surface ground;

 private:
  SourceInfo info_;
  Grid grid_;
};

/// Dry air of a constant lapse rate over a ground of 500 m, every 25 hPa from 1000 to 200 hPa; the ground's
/// pressure lies between two levels. Cloud on four levels. Everything is told; tests erase what they like.
struct AnalyticAir : MadeLevels {
  explicit AnalyticAir(double lapse = 0.0065) : lapseRate(lapse) {
    ground.heightMeters = {500};
    ground.pressurePa = {static_cast<float>(pressureAt(geopotential(500)))};
    for (int hectopascals = 1000; hectopascals >= 200; hectopascals -= 25) {
      const double pressure = 100.0 * hectopascals, height = heightOf(pressure);
      const double kelvin = 290 - lapseRate * height;
      const bool cloudy = hectopascals >= 750 && hectopascals <= 825;
      levels.push_back({pressure,
                        {{Quantity::GeopotentialHeight, {static_cast<float>(height)}},
                         {Quantity::Temperature, {static_cast<float>(kelvin)}},
                         {Quantity::SpecificHumidity, {0}},
                         {Quantity::CloudLiquid, {cloudy ? 3e-4f : 0}},
                         {Quantity::CloudFraction, {cloudy ? 0.6f : 0}}}});
    }
  }
  /// The sphere and the ellipsoid differ by a few metres at most below 20 km: good enough for a ground.
  static double geopotential(double meters) { return meters * 6356766.0 / (6356766.0 + meters); }
  double heightOf(double pressure) const {
    const double logarithm = std::log(101000 / pressure);
    if (lapseRate == 0) return kMetersPerKelvin * 290 * logarithm;
    return 290 / lapseRate * (1 - std::exp(-logarithm * kMetersPerKelvin * lapseRate));
  }
  double pressureAt(double height) const {
    if (lapseRate == 0) return 101000 * std::exp(-height / (kMetersPerKelvin * 290));
    return 101000 * std::pow(1 - lapseRate * height / 290, 1 / (kMetersPerKelvin * lapseRate));
  }
  double lapseRate;
};

inline bool derives(const CloudColumns& columns, std::string_view what, std::string_view how) {
  return std::any_of(columns.derived.begin(), columns.derived.end(), [&](const auto& line) {
    return line.first == what && line.second.find(how) != std::string::npos;
  });
}

}  // namespace cloudgen::field
