// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace cloudgen::image {

/// Sunlight that comes about the sun's direction through cloud of the given optical depths of water and ice,
/// in units of a white face square to the sun; `cosineFromSun` between the ray and the sun.
///
/// The disc of 0.53 degrees dims as exp(-depth). Light scattered n times by small angles forms an aureole
/// that is sqrt(n) times as wide as one scattering's, n after Poisson (small-angle approximation;
/// Deirmendjian 1969): narrow in ice, so that a veil shows the sun as through ground glass. Ice shows the
/// halo of 22 degrees, by refraction through 60 degree prisms (n = 1.307 in red, 1.317 in blue): sharp and
/// red within, fading outwards.
glm::vec3 glareAndHalo(double cosineFromSun, float water, float ice);

}  // namespace cloudgen::image
