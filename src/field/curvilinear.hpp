// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "field/grid.hpp"

/// Grids that are given by the centres of their cells.
namespace cloudgen::field {

/// Unit vector at lattice coordinates, where the cell (column, row) reaches from them to (column + 1, row +
/// 1): bilinear between the centres around, beyond the outer ones as the two next to them go on. Not a number
/// where a centre is missing.
glm::dvec3 curvilinearVector(const Grid& grid, double columnAndU, double rowAndV);

/// The corners of a cell, around it.
std::array<glm::dvec3, 4> curvilinearCorners(const Grid& grid, std::uint32_t cell);

/// True if a place lies within the great circles through the corners.
bool quadHolds(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& place);

}  // namespace cloudgen::field
