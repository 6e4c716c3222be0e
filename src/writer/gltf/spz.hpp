// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "writer/gltf/splat.hpp"

namespace cloudgen::writer::gltf {

/// Splats packed as SPZ, version 2 of the file (Niantic Labs; gzip of columns): positions as 24-bit fixed
/// point in units of `metersPerUnit` with as many fractional bits as their reach leaves, opacity in a byte,
/// colours and deviations in a byte each (steps of 6 % of a deviation), rotations in three bytes, harmonics up to
/// `degree` (0 to 2) in three a coefficient. Opacities are rounded so that what neighbours hold of extinction stays, and make up for
/// what the rounding of deviations changes.
std::string packedSplats(std::span<const Splat> splats, glm::vec3 sunDirection, double metersPerUnit,
                         int degree);

}  // namespace cloudgen::writer::gltf
