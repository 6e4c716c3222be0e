// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace cloudgen::light {

/// A cloud as it throws and meets shadows: an upright cylinder.
struct Caster {
  glm::vec3 base{0};  ///< middle of its base, scene frame
  float radiusMeters = 0, depthMeters = 0;
  float opticalDepth = 0;  ///< vertical
};

/// Optical depths between the sun and points below, thrown along the sun onto a level plane on one grid of at
/// most 1024 x 1024 cells. Suns below 8 degrees are taken there, as further shadows would fall beyond what is
/// known.
class ShadowPlane {
 public:
  ShadowPlane() = default;  ///< of no cloud
  /// A plane with room for the shadows of all of these; they are still to be added.
  ShadowPlane(std::span<const Caster> clouds, const glm::vec3& sunDirection);

  /// Adds a level slice of a cloud, of a vertical optical depth; depth times area is kept whatever the cells.
  void add(const Caster& cloud, float heightMeters, float opticalDepth);
  /// Mean over a cloud's area, at a height, of what comes through by all orders of scattering.
  float lightOn(const Caster& cloud, float heightMeters) const;
  /// Optical depth along the sun's ray from a point through everything added, bilinear; 0 beyond the plane.
  float opticalDepthTo(const glm::vec3& point) const;

 private:
  glm::vec2 fallen(const glm::vec3& point) const;
  /// Visits the cells whose middle lies in the cloud's disc at a height, or the one that holds its middle.
  template <class Do>
  void visit(const Caster& cloud, float heightMeters, Do&& does) const;

  glm::vec2 lower_{0}, shift_{0};
  float cell_ = 1, slant_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<float> depths_;
};

struct Shadows {
  std::vector<float> sunlight;  ///< per cloud, see below
  ShadowPlane whole;            ///< of all clouds, for the ground
};

/// Share of the sunlight, 0..1, that comes down to each cloud through those that lie wholly or in part above
/// its top, and the shadow of all. A sun below the horizon throws none.
Shadows shadowsOf(std::span<const Caster> clouds, const glm::vec3& sunDirection);

}  // namespace cloudgen::light
