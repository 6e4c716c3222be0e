// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "writer/tiles3d/detail.hpp"

namespace cloudgen::writer::tiles3d {

/// A puff of the scene on the globe.
struct PlacedPuff {
  LitPuff lit;  ///< in the scene frame
  glm::dvec3 geographic{0};
};

}  // namespace cloudgen::writer::tiles3d
