// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/region.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace cloudgen::writer::tiles3d {
namespace {

constexpr double kPi = std::numbers::pi, kAround = 2 * std::numbers::pi;
/// Of the ellipsoid, the smallest radius of curvature (along the meridian at the equator), so that angles
/// are large enough everywhere.
constexpr double kLeastRadiusMeters = 6'335'000;
/// A disc that lies flat rises over the curved ground towards its border.
constexpr double kDropMeters = 2 * kLeastRadiusMeters;

/// Longitude in [-pi, pi).
double wrapped(double longitude) { return longitude - kAround * std::floor((longitude + kPi) / kAround); }

/// How far east of `from` a longitude is, in [0, 2 pi).
double eastward(double from, double longitude) {
  const double angle = longitude - from;
  return angle - kAround * std::floor(angle / kAround);
}

}  // namespace

void Region::includeArc(double west, double width) {
  if (width_ >= kAround || width >= kAround) {
    west_ = -kPi, width_ = kAround;
    return;
  }
  const double widthFromOwn = std::max(width_, eastward(west_, west) + width),
               widthFromOther = std::max(width, eastward(west, west_) + width_);
  if (widthFromOther < widthFromOwn) west_ = west;
  width_ = std::min(widthFromOwn, widthFromOther);
  if (width_ >= kAround) west_ = -kPi, width_ = kAround;
}

void Region::include(const glm::dvec3& geographic, double acrossMeters, double upMeters) {
  const double longitude = glm::radians(geographic.x), latitude = glm::radians(geographic.y),
               reach = acrossMeters / kLeastRadiusMeters,
               rise = acrossMeters * acrossMeters / kDropMeters;
  const bool holdsPole = std::abs(latitude) + reach >= 0.5 * kPi;
  // A circle about a place touches meridians farther off than its radius: Snyder (1987), sin = sin / cos.
  const double across = holdsPole ? kPi : std::asin(std::min(1.0, std::sin(std::min(reach, 0.5 * kPi)) / std::cos(latitude)));
  const double west = wrapped(longitude - across), width = 2 * across;
  const double south = std::max(-0.5 * kPi, latitude - reach), north = std::min(0.5 * kPi, latitude + reach);
  const double lowest = geographic.z - upMeters, highest = geographic.z + upMeters + rise;
  if (empty()) {
    west_ = width >= kAround ? -kPi : west;
    width_ = width;
    south_ = south, north_ = north, lowest_ = lowest, highest_ = highest;
    return;
  }
  includeArc(west, width);
  south_ = std::min(south_, south), north_ = std::max(north_, north);
  lowest_ = std::min(lowest_, lowest), highest_ = std::max(highest_, highest);
}

void Region::include(const Region& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  includeArc(other.west_, other.width_);
  south_ = std::min(south_, other.south_), north_ = std::max(north_, other.north_);
  lowest_ = std::min(lowest_, other.lowest_), highest_ = std::max(highest_, other.highest_);
}

std::array<double, 6> Region::bounds() const {
  if (width_ >= kAround) return {-kPi, south_, kPi, north_, lowest_, highest_};
  const double east = west_ + width_;
  return {west_, south_, east > kPi ? east - kAround : east, north_, lowest_, highest_};
}

glm::dvec3 Region::center() const {
  return {glm::degrees(wrapped(west_ + 0.5 * width_)), glm::degrees(0.5 * (south_ + north_)),
          0.5 * (lowest_ + highest_)};
}

}  // namespace cloudgen::writer::tiles3d
