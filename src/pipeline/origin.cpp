// SPDX-License-Identifier: Apache-2.0
#include "pipeline/origin.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace cloudgen::pipeline {
namespace {

/// The end of civil twilight: what is lit after it is lit by the stated least light of the night.
constexpr double kNightDegrees = -6.0;

std::string boxText(const base::GeoBox& box) {
  return fmt::format("{:g},{:g},{:g},{:g}", box.west, box.south, box.east, box.north);
}

light::Sun sunFor(const field::Source& source, const base::GeoBox& box, const Options& options,
                  std::vector<std::string>& warnings) {
  if (options.sunDegrees) return light::sunFrom(options.sunDegrees->first, options.sunDegrees->second);
  const base::UtcTime time = source.info().validTime;
  const light::Sun sun = light::sunAt(time, box.centerLongitude(), box.centerLatitude());
  if (sun.elevationDegrees < kNightDegrees)
    warnings.push_back(fmt::format(
        "at {} the sun stands at {:.1f} degrees: the scene is a night, drawn as under a quarter moon; "
        "choose another light with --sun AZIMUTH,ELEVATION",
        base::isoText(time), sun.elevationDegrees));
  return sun;
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
  Origin origin{frame, std::move(cells), groundOf(source, frame), {}, {}, {}, {}};
  origin.sun = sunFor(source, box, options, origin.warnings);
  origin.sky = light::skyUnder(origin.sun);
  origin.shading = origin.sun.direction;
  return origin;
}

}  // namespace cloudgen::pipeline
