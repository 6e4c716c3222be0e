// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "base/height_field.hpp"
#include "light/shadow.hpp"
#include "light/sky.hpp"

namespace cloudgen::light {

/// Colour of a point of the ground, display-linear: that of the flat ground, browner and lighter with height,
/// shaded by its slope against the sun. Slopes of model orography are too gentle to be seen: they are drawn
/// steeper for the shading, as maps do, the more the coarser the lattice.
glm::vec3 reliefColor(const base::HeightField& field, int column, int row, const Sun& sun, const Sky& sky);

/// What is left of the ground's colours behind an optical depth along the sun's ray: light of the sky, and what
/// comes through and out of the clouds. Nothing is taken once the sun is down.
glm::vec3 groundDimming(float opticalDepth, const Sun& sun, const Sky& sky);

/// reliefColor() in the shadows of the clouds, mean over the lattice's cell about the point.
glm::vec3 shadedReliefColor(const base::HeightField& field, int column, int row, const Sun& sun,
                            const Sky& sky, const ShadowPlane& shadows);

/// reliefColor() in between, bilinear.
glm::vec3 reliefColorAt(const base::HeightField& field, double x, double z, const Sun& sun, const Sky& sky);

}  // namespace cloudgen::light
