// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "base/height_field.hpp"
#include "light/sky.hpp"

namespace cloudgen::light {

/// Colour of a point of the ground, display-linear: that of the flat ground, browner and lighter with height,
/// shaded by its slope against the sun. Slopes of model orography are too gentle to be seen: they are drawn
/// steeper for the shading, as maps do, the more the coarser the lattice.
glm::vec3 reliefColor(const base::HeightField& field, int column, int row, const Sun& sun, const Sky& sky);

/// The same in between, bilinear.
glm::vec3 reliefColorAt(const base::HeightField& field, double x, double z, const Sun& sun, const Sky& sky);

}  // namespace cloudgen::light
