// SPDX-License-Identifier: Apache-2.0
#include "pipeline/origin.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr double kLowestSunDegrees = 8.0;

std::string boxText(const base::GeoBox& box) {
  return fmt::format("{:g},{:g},{:g},{:g}", box.west, box.south, box.east, box.north);
}

/// The same day's moment at which the mean sun stands where it does at 10 h local time.
base::UtcTime tenOClock(base::UtcTime time, double longitudeDegrees) {
  const auto dayStart = time.seconds - ((time.seconds % 86400) + 86400) % 86400;
  return {dayStart + static_cast<std::int64_t>(std::lround((10.0 - longitudeDegrees / 15.0) * 3600.0))};
}

light::Sun sunFor(const field::Source& source, const base::GeoBox& box, const Options& options,
                  std::vector<std::string>& warnings) {
  if (options.sunDegrees) return light::sunFrom(options.sunDegrees->first, options.sunDegrees->second);
  const base::UtcTime time = source.info().validTime;
  const double longitude = box.centerLongitude(), latitude = box.centerLatitude();
  const light::Sun real = light::sunAt(time, longitude, latitude);
  if (real.elevationDegrees >= kLowestSunDegrees) return real;
  light::Sun standIn = light::sunAt(tenOClock(time, longitude), longitude, latitude);
  if (standIn.elevationDegrees < kLowestSunDegrees)
    standIn = light::sunFrom(standIn.azimuthDegrees, kLowestSunDegrees);
  warnings.push_back(fmt::format(
      "at {} the sun stands at {:.1f} degrees: the scene is lit as at 10 h local solar time "
      "(azimuth {:.0f}, elevation {:.0f}); choose another light with --sun",
      base::isoText(time), real.elevationDegrees, standIn.azimuthDegrees, standIn.elevationDegrees));
  return standIn;
}

}  // namespace

Origin locateOrigin(const field::Source& source, const field::Grid& grid, const Options& options) {
  const base::GeoBox whole = field::extent(source.grid());
  const base::GeoBox box = options.box.value_or(whole);
  auto cells = field::cellsTouching(grid, box);
  if (cells.empty())
    throw base::InputError("--bbox " + boxText(box), "lies outside the model's domain " + boxText(whole),
                           "choose a box inside the domain");
  const base::LocalFrame frame(box);
  Ground ground = groundOf(source, frame, cells);
  Origin origin{frame, std::move(cells), std::move(ground), {}, {}, {}};
  origin.sun = sunFor(source, box, options, origin.warnings);
  origin.sky = light::skyUnder(origin.sun);
  return origin;
}

}  // namespace cloudgen::pipeline
