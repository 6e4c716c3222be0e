// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "motion/lines.hpp"
#include "motion/poisson.hpp"

namespace cloudgen::motion {

/// What moves the air, SI units. Empty lists do nothing.
struct Forcing {
  std::vector<glm::vec2> wind;       ///< of each level of cells, along x and z: the level's mean is drawn to it
  float windSeconds = 300;           ///< in this time
  std::vector<float> heating;        ///< of each cell: buoyancy gained, m/s2 a second
  float stability = 0;               ///< squared Brunt-Vaisala frequency of the air at rest, 1/s2; not negative
  float viscosity = 0;               ///< m2/s; for velocity, buoyancy and smoke alike
};

/// Air in a box that closes on itself along x and z, between a floor and a lid along y without friction: "stable
/// fluids" (Stam 1999) as Jimenez de Parga moves clouds by them. Velocities stand on the faces of the cells, the
/// pressure comes from a direct solver (Poisson), what is carried goes back along the flow with the correction of
/// MacCormack within bounds (Selle et al. 2008), and the projection in the middle of a step is a reflection, which
/// keeps energy (Zehnder et al. 2018). No step is too long. The result does not depend on threads.
class Fluid {
 public:
  /// At rest. At least 2 cells along each axis; cellMeters > 0.
  Fluid(const glm::ivec3& cells, float cellMeters);

  /// Moves on: adds forces, spreads by viscosity, projects, and carries velocity, buoyancy and smoke.
  void step(float seconds, const Forcing& forcing);
  /// Takes out what the velocity has of sources and sinks.
  void project();

  /// At a place in metres from the lower corner of the box; heights beyond floor and lid count as there.
  glm::vec3 velocityAt(const glm::vec3& place) const;
  /// Of a cell, 1/s: net outflow over its volume.
  float divergence(int x, int y, int z) const;

  const glm::ivec3& cells() const { return cells_; }
  float cellMeters() const { return cellMeters_; }
  /// m/s on the lower face of each cell along an axis; along y there is one level more, for the lid.
  Lattice& velocity(int axis) { return velocity_[static_cast<std::size_t>(axis)]; }
  const Lattice& velocity(int axis) const { return velocity_[static_cast<std::size_t>(axis)]; }
  Lattice& buoyancy() { return buoyancy_; }  ///< m/s2 upwards, in the middle of the cells
  Lattice& smoke() { return smoke_; }        ///< any amount that is not negative; its sum stays

 private:
  void carryVelocity(const std::array<Lattice, 3>& wind, float seconds);
  void carryContents(const std::array<Lattice, 3>& wind, float seconds);
  /// Over what the velocity was before it was projected.
  void reflect(const std::array<Lattice, 3>& before);
  void force(float seconds, const Forcing& forcing);
  void spread(float seconds, float viscosity);

  glm::ivec3 cells_;
  float cellMeters_;
  std::array<Lattice, 3> velocity_;
  Lattice buoyancy_, smoke_;
  Poisson poisson_;
  Lattice pressure_;
};

}  // namespace cloudgen::motion
