// SPDX-License-Identifier: Apache-2.0
#include "input/model/model_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "field/standard_atmosphere.hpp"
#include "input/model/choice.hpp"
#include "input/model/cover_layers.hpp"
#include "input/model/traps.hpp"

namespace cloudgen::input::model {
namespace {

using field::Quantity;
using Cells = std::span<const std::uint32_t>;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr double kFreezingK = 273.15;

class ModelSource : public field::Source {
 public:
  ModelSource(const Contents& contents, const OpenOptions& options)
      : choice_(choose(contents, options)), grid_(contents.grids.at(choice_.grid)()) {
    info_.files = contents.files;
    info_.format = contents.format;
    info_.model = contents.model;
    info_.run = choice_.run;
    info_.validTime = choice_.valid;
    info_.validTimes = choice_.validTimes;
    info_.warnings = contents.warnings;
    take(choice_.warnings);
    take(gridWarnings(grid_));
    orderLevels();
    settleCoverScale();
    lookForCloudlessHeights();
    lookAtHeightsAboveGround();
    info_.levels = levelList(choice_);
    info_.fields = fieldLines(choice_);
    info_.unused = contents.unused;
    info_.unused.insert(info_.unused.end(), choice_.unused.begin(), choice_.unused.end());
    info_.missing = missingLines(choice_);
  }

  const field::SourceInfo& info() const override { return info_; }
  const field::Grid& grid() const override { return grid_; }
  field::Telling telling() const override {
    return choice_.basis == Basis::Cover ? field::Telling::Layers : field::Telling::Levels;
  }

  void visitLevels(Cells cells, const std::function<void(const field::Level&)>& visit) const override {
    const std::vector<float> surfacePressure = surfacePressureAt(cells);
    const std::vector<double> angles = axisAnglesAt(cells);
    for (const ChosenLevel& chosen : choice_.levels) {
      field::Level level = levelAt(chosen, cells);
      addPressure(chosen.vertical, surfacePressure, cells.size(), level);
      splitIce(chosen, level);
      turnWind(chosen, angles, level);
      visit(level);
    }
  }

  field::Surface surface(Cells cells) const override {
    field::Surface surface;
    surface.heightMeters = singleAt({SingleKind::SurfaceHeight}, cells);
    surface.pressurePa = surfacePressureAt(cells);
    surface.seaLevelPressurePa = singleAt({SingleKind::SeaLevelPressure}, cells);
    surface.cloudBaseMeters = cloudHeightsAt(SingleKind::CloudBaseHeight, CloudPart::Total, cells);
    surface.cloudTopMeters = cloudHeightsAt(SingleKind::CloudTopHeight, CloudPart::Total, cells);
    return surface;
  }

  void visitLayers(Cells cells, const std::function<void(const field::StatedLayer&)>& visit) const override {
    if (choice_.basis != Basis::Cover) return;
    struct PartAt {
      CloudPart part;
      std::vector<float> cover, base, top;
    };
    std::vector<PartAt> parts;
    for (const auto& [single, field] : choice_.singles)
      if (single.kind == SingleKind::CloudCover)
        parts.push_back({single.part, singleAt(single, cells),
                         cloudHeightsAt(SingleKind::CloudBaseHeight, single.part, cells),
                         cloudHeightsAt(SingleKind::CloudTopHeight, single.part, cells)});
    const std::vector<float> ground = singleAt({SingleKind::SurfaceHeight}, cells);
    const auto at = [](const std::vector<float>& values, std::size_t i) {
      return values.empty() ? kMissing : values[i];
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
      CoverColumn column;
      for (const PartAt& part : parts)
        column.parts[part.part] = {std::min(1.0f, coverFactor_ * part.cover[i]), at(part.base, i),
                                   at(part.top, i)};
      column.surfaceMeters = std::isfinite(at(ground, i)) ? at(ground, i) : 0;
      column.latitudeDegrees = field::centerOf(grid_, cells[i]).latitudeDegrees;
      visitCoverLayers(column, cells[i], visit);
    }
  }

 private:
  void take(const std::vector<field::Warning>& warnings) {
    info_.warnings.insert(info_.warnings.end(), warnings.begin(), warnings.end());
  }

  std::vector<float> singleAt(const Single& single, Cells cells) const {
    const auto found = choice_.singles.find(single);
    return found == choice_.singles.end() ? std::vector<float>{} : found->second.read(cells);
  }

  std::vector<float> surfacePressureAt(Cells cells) const {
    if (choice_.has(SingleKind::SurfacePressure)) return singleAt({SingleKind::SurfacePressure}, cells);
    std::vector<float> values = singleAt({SingleKind::LogSurfacePressure}, cells);
    for (float& value : values) value = std::exp(value);
    return values;
  }

  /// Height of a cloud's base or top, from a height or a pressure field; NaN where there is no cloud. "No
  /// cloud" is missing, or a negative number that interpolation has smeared: what is not above zero is none.
  std::vector<float> cloudHeightsAt(SingleKind kind, CloudPart part, Cells cells) const {
    std::vector<float> heights = singleAt({kind, part}, cells);
    for (float& height : heights)
      if (!(height > 0)) height = kMissing;
    if (!heights.empty()) return heights;
    const bool base = kind == SingleKind::CloudBaseHeight;
    heights = singleAt({base ? SingleKind::CloudBasePressure : SingleKind::CloudTopPressure, part}, cells);
    for (float& height : heights) {
      const bool real = height > 1000 && height < 110000;
      height = real ? static_cast<float>(field::standardHeight(height)) : kMissing;
    }
    return heights;
  }

  field::Level levelAt(const ChosenLevel& chosen, Cells cells) const {
    field::Level level;
    if (chosen.vertical.kind == VerticalKind::Pressure) level.pressurePa = chosen.vertical.value;
    for (const auto& [quantity, field] : chosen.fields) {
      std::vector<float>& values = level.values[quantity] =
          cells.empty() ? std::vector<float>{} : field.read(cells);
      assert(values.size() == cells.size());
      const bool cover = quantity == Quantity::CloudFraction;
      const float factor = cover ? coverFactor_ : (field.inPercent ? 0.01f : 1.0f);
      if (factor != 1)
        for (float& value : values) value *= factor;
    }
    return level;
  }

  void addPressure(const Vertical& vertical, const std::vector<float>& surfacePressure, std::size_t count,
                   field::Level& level) const {
    const auto constant = [&](Quantity quantity) {
      if (!level.has(quantity)) level.values[quantity].assign(count, static_cast<float>(vertical.value));
    };
    if (vertical.kind == VerticalKind::HeightAboveSea) constant(Quantity::Height);
    if (vertical.kind == VerticalKind::HeightAboveGround) constant(Quantity::HeightAboveGround);
    const bool hybrid = vertical.kind == VerticalKind::Hybrid, sigma = vertical.kind == VerticalKind::Sigma;
    if ((!hybrid && !sigma) || level.has(Quantity::Pressure)) return;
    if (hybrid && vertical.a == 0 && vertical.b == 0) return;
    constexpr float kStandardPa = 101325;
    const auto a = static_cast<float>(hybrid ? vertical.a : 0),
               b = static_cast<float>(hybrid ? vertical.b : vertical.value);
    std::vector<float>& pressure = level.values[Quantity::Pressure];
    pressure.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      pressure[i] = a + b * (surfacePressure.empty() ? kStandardPa : surfacePressure[i]);
  }

  /// Simple schemes (WRF's WSM3) keep ice in the liquid's field: below freezing it is all ice.
  static void splitIce(const ChosenLevel& chosen, field::Level& level) {
    const auto liquid = chosen.fields.find(Quantity::CloudLiquid);
    if (liquid == chosen.fields.end() || !liquid->second.holdsIceBelowFreezing ||
        !level.has(Quantity::Temperature) || level.has(Quantity::CloudIce))
      return;
    std::vector<float>& water = level.values[Quantity::CloudLiquid];
    std::vector<float>& ice = level.values[Quantity::CloudIce];
    ice.assign(water.size(), 0);
    for (std::size_t i = 0; i < water.size(); ++i)
      if (level.of(Quantity::Temperature)[i] < kFreezingK) std::swap(water[i], ice[i]);
  }

  /// Angles of the grid's axes; empty where no wind needs turning.
  std::vector<double> axisAnglesAt(Cells cells) const {
    const bool turned =
        std::any_of(choice_.levels.begin(), choice_.levels.end(), [](const ChosenLevel& level) {
          const auto found = level.fields.find(Quantity::WindEast);
          return found != level.fields.end() && found->second.alongGridAxes;
        });
    std::vector<double> angles;
    if (turned)
      for (const std::uint32_t cell : cells) angles.push_back(field::axisAngle(grid_, cell));
    return angles;
  }

  static void turnWind(const ChosenLevel& chosen, const std::vector<double>& angles, field::Level& level) {
    const auto east = chosen.fields.find(Quantity::WindEast);
    if (east == chosen.fields.end() || !east->second.alongGridAxes || !level.has(Quantity::WindNorth)) return;
    std::vector<float>&u = level.values[Quantity::WindEast], &v = level.values[Quantity::WindNorth];
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double c = std::cos(angles[i]), s = std::sin(angles[i]), x = u[i], y = v[i];
      u[i] = static_cast<float>(x * c - y * s);
      v[i] = static_cast<float>(x * s + y * c);
    }
  }

  /// Model levels are numbered from the top or from the bottom, whatever the model likes: a height or
  /// pressure of the first and the last one tells.
  void orderLevels() {
    if (choice_.levels.size() < 2) return;
    const VerticalKind kind = choice_.levels.front().vertical.kind;
    if (kind != VerticalKind::ModelLevel && kind != VerticalKind::Hybrid) return;
    const auto altitude = [&](const ChosenLevel& level) -> double {
      for (const auto& [quantity, sign] : {std::pair{Quantity::Height, 1},
                                           {Quantity::GeopotentialHeight, 1},
                                           {Quantity::HeightAboveGround, 1},
                                           {Quantity::Pressure, -1}})
        if (const auto found = level.fields.find(quantity); found != level.fields.end())
          return sign * meanOf(found->second);
      return std::numeric_limits<double>::quiet_NaN();
    };
    const double lowest = altitude(choice_.levels.front()), highest = altitude(choice_.levels.back());
    if (lowest > highest) std::reverse(choice_.levels.begin(), choice_.levels.end());
    const double first = choice_.levels.front().vertical.value, last = choice_.levels.back().vertical.value;
    if (first < last)
      info_.warnings.push_back(
          {"levels_from_bottom",
           fmt::format("model levels are numbered from the bottom: {:g} is the lowest, {:g} the highest",
                       first, last)});
  }

  double meanOf(const Field& field) const {
    const std::vector<std::uint32_t> all = field::everyCell(grid_);
    double sum = 0, count = 0;
    for (const float value : field.read(all))
      if (std::isfinite(value)) sum += value, ++count;
    return sum / count;
  }

  void settleCoverScale() {
    std::vector<const Field*> covers;
    for (const ChosenLevel& level : choice_.levels)
      if (const auto found = level.fields.find(Quantity::CloudFraction); found != level.fields.end())
        covers.push_back(&found->second);
    if (choice_.basis == Basis::Cover)
      for (const auto& [single, field] : choice_.singles)
        if (single.kind == SingleKind::CloudCover) covers.push_back(&field);
    const CoverScale scale = coverScale(covers, grid_);
    coverFactor_ = scale.perCent ? 0.01f : 1.0f;
    take(scale.warnings);
  }

  void lookForCloudlessHeights() {
    for (const auto& [single, field] : choice_.singles) {
      const bool height =
          single.kind == SingleKind::CloudBaseHeight || single.kind == SingleKind::CloudTopHeight;
      const bool pressure =
          single.kind == SingleKind::CloudBasePressure || single.kind == SingleKind::CloudTopPressure;
      if (!height && !pressure) continue;
      std::size_t negative = 0;
      float least = 0;
      for (const float value : field.read(field::everyCell(grid_)))
        if (value < 0) ++negative, least = std::min(least, value);
      if (negative)
        info_.warnings.push_back(
            {"negative_cloud_height",
             fmt::format("{} is negative in {} cells (down to {:g}): that means no cloud there",
                         singleName(single), negative, least)});
    }
  }

  void lookAtHeightsAboveGround() {
    if (!choice_.has(Quantity::HeightAboveGround) &&
        (choice_.levels.empty() || choice_.levels.front().vertical.kind != VerticalKind::HeightAboveGround))
      return;
    const bool lifted = choice_.has(SingleKind::SurfaceHeight);
    info_.warnings.push_back(
        {"heights_above_ground",
         lifted ? "heights are above the ground: the orography lifts them to mean sea level"
                : "heights are above the ground, whose own height is not there: the ground is "
                  "taken to lie at sea level"});
  }

  Choice choice_;
  field::Grid grid_;
  field::SourceInfo info_;
  float coverFactor_ = 1;
};

}  // namespace

std::unique_ptr<field::Source> makeSource(Contents contents, const OpenOptions& options) {
  return std::make_unique<ModelSource>(contents, options);
}

}  // namespace cloudgen::input::model
