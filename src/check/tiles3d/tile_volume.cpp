// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/tile_volume.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

namespace cloudgen::check {
namespace {

constexpr double kPi = std::numbers::pi;
/// Numbers are written with some sixteen digits; angles of 1e-9 are 6 mm.
constexpr double kAngleSlack = 1e-9, kHeightSlackMeters = 0.01;
constexpr double kLeastRadiusMeters = 6'335'000;

/// Nothing if they are not so many finite numbers.
std::vector<double> numbersOf(const nlohmann::json& json, std::size_t count) {
  if (!json.is_array() || json.size() != count) return {};
  std::vector<double> out;
  for (const auto& value : json) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return {};
    out.push_back(value);
  }
  return out;
}

double eastward(double from, double longitude) {
  const double angle = longitude - from;
  return angle - 2 * kPi * std::floor(angle / (2 * kPi));
}

double widthOf(const std::array<double, 6>& region) {
  return region[2] >= region[0] ? region[2] - region[0] : region[2] - region[0] + 2 * kPi;
}

std::string readRegion(const nlohmann::json& json, TileVolume& volume) {
  const auto values = numbersOf(json, 6);
  if (values.empty()) return "is not six numbers";
  std::copy(values.begin(), values.end(), volume.region.begin());
  const auto within = [](double angle, double most) { return std::abs(angle) <= most + kAngleSlack; };
  const auto& [west, south, east, north, lowest, highest] = volume.region;
  if (!within(west, kPi) || !within(east, kPi)) return "has longitudes beyond pi: are they in radians?";
  if (!within(south, kPi / 2) || !within(north, kPi / 2)) return "has latitudes beyond half pi";
  if (south > north) return "has its south north of its north";
  if (lowest > highest) return "has its lowest height above its highest";
  return {};
}

std::string readBox(const nlohmann::json& json, const glm::dmat4& toEarth, TileVolume& volume) {
  const auto values = numbersOf(json, 12);
  if (values.empty()) return "is not twelve numbers";
  volume.center = glm::dvec3(toEarth * glm::dvec4(values[0], values[1], values[2], 1));
  for (int axis = 0; axis < 3; ++axis) {
    const double* half = &values[3 + 3 * static_cast<std::size_t>(axis)];
    volume.halfAxes[axis] = glm::dvec3(toEarth * glm::dvec4(half[0], half[1], half[2], 0));
  }
  return std::abs(glm::determinant(volume.halfAxes)) > 0 ? "" : "is a box without a volume";
}

std::string readSphere(const nlohmann::json& json, const glm::dmat4& toEarth, TileVolume& volume) {
  const auto values = numbersOf(json, 4);
  if (values.empty()) return "is not four numbers";
  if (values[3] < 0) return "has a negative radius";
  volume.center = glm::dvec3(toEarth * glm::dvec4(values[0], values[1], values[2], 1));
  double scale = 0;
  for (int axis = 0; axis < 3; ++axis) scale = std::max(scale, glm::length(glm::dvec3(toEarth[axis])));
  volume.radius = values[3] * scale;
  return {};
}

bool regionHolds(const std::array<double, 6>& outer, const std::array<double, 6>& inner) {
  const double width = widthOf(outer);
  const double start = eastward(outer[0] - kAngleSlack, inner[0]) - kAngleSlack;
  const bool around = width >= 2 * kPi - kAngleSlack;
  return (around || start + widthOf(inner) <= width + kAngleSlack) && inner[1] >= outer[1] - kAngleSlack &&
         inner[3] <= outer[3] + kAngleSlack && inner[4] >= outer[4] - kHeightSlackMeters &&
         inner[5] <= outer[5] + kHeightSlackMeters;
}

}  // namespace

std::string readVolume(const nlohmann::json& json, const glm::dmat4& toEarth, TileVolume& volume) {
  if (!json.is_object()) return "is no object";
  if (json.contains("region")) {
    volume.kind = VolumeKind::Region;
    return readRegion(json["region"], volume);
  }
  if (json.contains("box")) {
    volume.kind = VolumeKind::Box;
    return readBox(json["box"], toEarth, volume);
  }
  if (!json.contains("sphere")) return "is no region, box or sphere";
  volume.kind = VolumeKind::Sphere;
  return readSphere(json["sphere"], toEarth, volume);
}

bool VolumeTest::holds(const TileVolume& volume, const glm::dvec3& earth, double slackMeters) const {
  if (volume.kind == VolumeKind::Sphere) return glm::distance(earth, volume.center) <= volume.radius + slackMeters;
  if (volume.kind == VolumeKind::Box) {
    const glm::dvec3 along = glm::inverse(volume.halfAxes) * (earth - volume.center);
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(along[axis]) > 1 + slackMeters / glm::length(volume.halfAxes[axis])) return false;
    return true;
  }
  const glm::dvec3 place = globe_.toGeographic(earth);
  const double longitude = glm::radians(place.x), latitude = glm::radians(place.y),
               angle = slackMeters / kLeastRadiusMeters,
               across = angle / std::max(1e-12, std::cos(latitude));
  const auto& region = volume.region;
  const bool inLongitude = widthOf(region) + 2 * across >= 2 * kPi ||
                           eastward(region[0] - across, longitude) <= widthOf(region) + 2 * across;
  return inLongitude && latitude >= region[1] - angle && latitude <= region[3] + angle &&
         place.z >= region[4] - slackMeters && place.z <= region[5] + slackMeters;
}

bool VolumeTest::holds(const TileVolume& outer, const TileVolume& inner) const {
  if (outer.kind == VolumeKind::Region && inner.kind == VolumeKind::Region)
    return regionHolds(outer.region, inner.region);
  if (outer.kind == VolumeKind::Sphere && inner.kind == VolumeKind::Sphere)
    return glm::distance(outer.center, inner.center) + inner.radius <= outer.radius * (1 + 1e-6) + 0.01;
  const auto surface = surfaceOf(inner);
  double size = 0;
  for (const glm::dvec3& point : surface) size = std::max(size, glm::distance(point, surface.front()));
  const double slackMeters = 0.01 + 1e-3 * size;  // the surface of a region is rounder than its corners
  return std::all_of(surface.begin(), surface.end(),
                     [&](const glm::dvec3& point) { return holds(outer, point, slackMeters); });
}

std::vector<glm::dvec3> VolumeTest::surfaceOf(const TileVolume& volume) const {
  std::vector<glm::dvec3> points;
  constexpr int kSteps = 4;
  if (volume.kind == VolumeKind::Region)
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j)
        for (const double height : {volume.region[4], volume.region[5]})
          points.push_back(globe_.toEarth(
              {glm::degrees(volume.region[0] + widthOf(volume.region) * i / kSteps),
               glm::degrees(volume.region[1] + (volume.region[3] - volume.region[1]) * j / kSteps), height}));
  for (int corner = 0; volume.kind == VolumeKind::Box && corner < 8; ++corner)
    points.push_back(volume.center + volume.halfAxes * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1,
                                                                  corner & 4 ? 1 : -1));
  for (int axis = 0; volume.kind == VolumeKind::Sphere && axis < 3; ++axis)
    for (const double side : {-volume.radius, volume.radius}) {
      points.push_back(volume.center);
      points.back()[axis] += side;
    }
  return points;
}

}  // namespace cloudgen::check
