// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/geocentric.hpp"

namespace cloudgen::check {

enum class VolumeKind { Region, Box, Sphere };

/// A bounding volume of 3D Tiles in Earth-fixed coordinates, metres.
struct TileVolume {
  VolumeKind kind = VolumeKind::Sphere;
  /// Of a region: west, south, east, north (radians), lowest, highest.
  std::array<double, 6> region{};
  glm::dvec3 center{0};
  glm::dmat3 halfAxes{0};  ///< of a box
  double radius = 0;       ///< of a sphere
};

/// What is wrong with the JSON of a volume; an empty text if nothing is, and then `volume` is it. Boxes and
/// spheres are in the axes that `toEarth` leads from.
std::string readVolume(const nlohmann::json& json, const glm::dmat4& toEarth, TileVolume& volume);

/// Asks volumes of one kind or another whether they hold something, with some room for rounding. An object
/// serves one thread at a time.
class VolumeTest {
 public:
  /// True if a place is not over `slackMeters` outside.
  bool holds(const TileVolume& volume, const glm::dvec3& earth, double slackMeters) const;
  /// True if another volume is inside: regions in regions by their bounds, else by points of its surface.
  bool holds(const TileVolume& outer, const TileVolume& inner) const;

 private:
  std::vector<glm::dvec3> surfaceOf(const TileVolume& volume) const;

  base::Geocentric globe_;
};

}  // namespace cloudgen::check
