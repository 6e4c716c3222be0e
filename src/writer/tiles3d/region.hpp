// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace cloudgen::writer::tiles3d {

/// A patch of the globe between two heights, as a bounding volume of 3D Tiles: radians and metres. It may
/// cross the antimeridian; where it holds a pole it goes all around.
class Region {
 public:
  /// Takes in a place (degrees, metres) and what lies within `acrossMeters` about and `upMeters` above and
  /// below it.
  void include(const glm::dvec3& geographic, double acrossMeters, double upMeters);
  /// Takes in another region, the shorter way around.
  void include(const Region& other);

  bool empty() const { return south_ > north_; }
  /// West, south, east, north, lowest, highest. West is larger than east where the antimeridian is crossed.
  std::array<double, 6> bounds() const;
  /// The middle: degrees, metres.
  glm::dvec3 center() const;

 private:
  void includeArc(double west, double width);

  double west_ = 0, width_ = 0, south_ = 1, north_ = -1, lowest_ = 0, highest_ = 0;
};

}  // namespace cloudgen::writer::tiles3d
