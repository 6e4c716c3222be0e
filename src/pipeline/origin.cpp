// SPDX-License-Identifier: Apache-2.0
#include "pipeline/origin.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace cloudgen::pipeline {
namespace {

/// The end of civil twilight: what is lit after it is lit by the moon.
constexpr double kNightDegrees = -6.0;

std::string boxText(const base::GeoBox& box) {
  return fmt::format("{:g},{:g},{:g},{:g}", box.west, box.south, box.east, box.north);
}

/// Sun, moon and sky.
void light(Origin& origin, base::UtcTime time, const base::GeoBox& box, const Options& options) {
  if (options.sunDegrees) {
    origin.sun = light::sunFrom(options.sunDegrees->first, options.sunDegrees->second);
    origin.sky = light::skyUnder(origin.sun);
    return;
  }
  const double longitude = box.centerLongitude(), latitude = box.centerLatitude();
  origin.sun = light::sunAt(time, longitude, latitude);
  origin.moon = light::moonAt(time, longitude, latitude);
  origin.sky = light::skyUnder(origin.sun, light::moonlightUnder(origin.moon));
  if (origin.sun.elevationDegrees < kNightDegrees)
    origin.warnings.push_back(fmt::format(
        "at {} the sun stands at {:.1f} degrees: the scene is a night, drawn in the light of {}; "
        "choose another light with --sun AZIMUTH,ELEVATION",
        base::isoText(time), origin.sun.elevationDegrees,
        origin.moon.elevationDegrees > 0
            ? fmt::format("the moon, {:.0f} degrees high and {:.0f} % lit", origin.moon.elevationDegrees,
                          100 * light::litShare(origin.moon))
            : "the stars: the moon is down"));
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
  Origin origin{frame, std::move(cells), groundOf(source, frame), {}, {}, {}, {}, {}};
  light(origin, source.info().validTime, box, options);
  origin.shading = origin.sun.direction;
  return origin;
}

}  // namespace cloudgen::pipeline
