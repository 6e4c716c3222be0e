// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/slants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "base/thread.hpp"
#include "check/fidelity/even_places.hpp"
#include "check/fidelity/ray_field.hpp"

namespace cloudgen::check {
namespace {

constexpr int kRays = 10'000;
constexpr int kAzimuths = 4;
constexpr std::array<double, 2> kZeniths{30, 60};
constexpr int kMostRepeats = 4;  ///< of the box to each side, for blobs wider than it

/// Not yet times the cosine.
SlantedView look(const WrittenScene& scene, const View& view, const glm::dvec2& lower,
                 const glm::dvec2& size) {
  std::vector<glm::vec2> places;
  for (int i = 0; i < kRays; ++i) places.emplace_back(evenPlace(i) * size);
  RayField field(std::move(places));
  const auto repeats = [](double low, double high, double side) {
    return std::pair{static_cast<int>(std::clamp(std::ceil(-high / side), -1.0 * kMostRepeats, 0.0)),
                     static_cast<int>(std::clamp(std::floor((side - low) / side), 0.0, 1.0 * kMostRepeats))};
  };
  for (const Blob& blob : scene.blobs) {
    const Footprint footprint = footprintOf(blob, scene.pivots, view);
    if (!isSeen(footprint)) continue;
    const glm::dvec2 half(footprint.halfSides());
    glm::dvec2 place = (glm::dvec2(footprint.place) - lower) / size;
    place = (place - glm::floor(place)) * size;
    const auto [west, east] = repeats(place.x - half.x, place.x + half.x, size.x);
    const auto [north, south] = repeats(place.y - half.y, place.y + half.y, size.y);
    for (int row = north; row <= south; ++row)
      for (int column = west; column <= east; ++column)
        field.add(footprint, glm::vec2(place + glm::dvec2(column, row) * size), 1);
  }
  return {0, field.cover(), field.meanOpticalDepth(), field.opticalDepthError()};
}

/// Share of the rectangle around the box that lies in the box.
double shareInBox(const base::LocalFrame& frame, const glm::dvec2& lower, const glm::dvec2& size) {
  constexpr int kPlaces = 2000;
  int inside = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const glm::dvec2 place = lower + evenPlace(i) * size;
    const glm::dvec3 geographic = frame.toGeographic({place.x, 0, place.y});
    if (std::isfinite(geographic.x) && frame.box().contains(geographic.x, geographic.y)) ++inside;
  }
  return std::max(1, inside) / static_cast<double>(kPlaces);
}

}  // namespace

Slants lookAslant(const WrittenScene& scene, const base::LocalFrame& frame, const base::Progress& progress) {
  Slants slants;
  slants.rays = kRays;
  slants.volumes =
      std::ranges::all_of(scene.blobs, [](const Blob& blob) { return blob.kind == BlobKind::Volume; });
  const glm::dvec2 lower = frame.lowerCorner(), size = glm::max(frame.upperCorner() - lower, glm::dvec2(1));
  double level = 0;
  for (const Blob& blob : scene.blobs) {
    const double height = blob.kind == BlobKind::Turning ? scene.pivots[blob.pivot].place.y : blob.center.y;
    if (std::isfinite(height)) level += height / static_cast<double>(scene.blobs.size());
  }
  std::vector<View> views{viewFrom(0, 180, level)};
  for (const double zenith : kZeniths)
    for (int i = 0; i < kAzimuths; ++i) views.push_back(viewFrom(zenith, 45 + i * 360.0 / kAzimuths, level));
  progress.step("verify: slanted rays", 0);
  std::vector<SlantedView> seen(views.size());
  base::parallelFor(views.size(), [&](std::size_t i) { seen[i] = look(scene, views[i], lower, size); });

  const double inBox = shareInBox(frame, lower, size);
  const auto mean = [&](double zenithDegrees, std::span<const SlantedView> azimuths) {
    SlantedView view{zenithDegrees};
    const auto count = static_cast<double>(azimuths.size());
    const double upright = std::cos(zenithDegrees * std::numbers::pi / 180) / (inBox * count);
    for (const SlantedView& one : azimuths) {
      view.cover += std::min(1.0, one.cover / inBox) / count;
      view.opticalDepth += upright * one.opticalDepth;
      view.opticalDepthError = std::hypot(view.opticalDepthError, upright * one.opticalDepthError);
    }
    return view;
  };
  const std::span<const SlantedView> all(seen);
  slants.vertical = mean(0, all.first(1));
  for (std::size_t z = 0; z < kZeniths.size(); ++z)
    slants.slanted.push_back(mean(kZeniths[z], all.subspan(1 + z * kAzimuths, kAzimuths)));
  progress.step("verify: slanted rays", 1);
  return slants;
}

}  // namespace cloudgen::check
