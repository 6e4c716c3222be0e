// SPDX-License-Identifier: Apache-2.0
#include "input/model/traps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace cloudgen::input::model {
namespace {

std::optional<double> sphereRadius(const std::string& crs) {
  for (const std::string& word : base::split(crs, ' ')) {
    double radius = 0;
    if (word.starts_with("+R=") && base::parseNumber(std::string_view(word).substr(3), radius)) return radius;
  }
  return std::nullopt;
}

}  // namespace

CoverScale coverScale(const std::vector<const Field*>& covers, const field::Grid& grid) {
  constexpr double kRounding = 1.01, kSurelyPerCent = 2.0;
  CoverScale scale;
  if (covers.empty()) return scale;
  const std::vector<std::uint32_t> all = field::everyCell(grid);
  for (const Field* cover : covers) {
    for (const float value : cover->read(all))
      if (value > scale.greatest) scale.greatest = value;
    if (scale.greatest > kSurelyPerCent) break;
  }
  const bool stated = covers.front()->inPercent;
  scale.perCent = stated ? scale.greatest > kRounding : scale.greatest > kSurelyPerCent;
  if (stated && !scale.perCent && scale.greatest > 0)
    scale.warnings.push_back(
        {"cover_in_fractions",
         fmt::format("{} is defined in per cent but never passes 1 (greatest {:g}): it is taken as 0..1",
                     covers.front()->name, scale.greatest)});
  if (!stated && scale.perCent)
    scale.warnings.push_back(
        {"cover_in_percent", fmt::format("{} is defined as 0..1 but reaches {:g}: it is taken as per cent",
                                         covers.front()->name, scale.greatest)});
  return scale;
}

std::vector<field::Warning> gridWarnings(const field::Grid& grid) {
  constexpr double kUsualRadius = 6371229, kDifference = 500;
  std::vector<field::Warning> warnings;
  const base::GeoBox box = field::extent(grid);
  const bool global = box.height() > 179;
  if (!global && box.crossesAntimeridian())
    warnings.push_back({"antimeridian_inside",
                        fmt::format("the antimeridian lies inside the domain ({:g} to {:g} degrees east)",
                                    box.west, box.east + 360)});
  if (!global && (box.north == 90 || box.south == -90))
    warnings.push_back({"pole_inside", fmt::format("the {} pole lies inside the domain",
                                                   box.north == 90 ? "north" : "south")});
  const auto radius = sphereRadius(grid.crs);
  if (radius && std::abs(*radius - kUsualRadius) > kDifference)
    warnings.push_back(
        {"sphere",
         fmt::format("the grid lies on a sphere of {:.0f} m; its latitudes are taken as those of WGS84, as "
                     "the model means them",
                     *radius)});
  return warnings;
}

}  // namespace cloudgen::input::model
