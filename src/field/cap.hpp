// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "field/grid.hpp"

namespace cloudgen::field {

/// A round piece of the Earth that surely holds a cell or a block of cells.
struct Cap {
  GeoPoint center;
  double radiusDegrees = 0;
};

enum class Relation { Outside, Across, Inside };

/// How a cap lies to a box; Outside where they share at most a border.
Relation relationOf(const Cap& cap, const base::GeoBox& box);

/// The part of a box that a cap may reach into; nothing where it cannot.
std::optional<base::GeoBox> partWithin(const base::GeoBox& box, const Cap& cap);

/// About a cell; nothing where a part of its border has no place on Earth.
std::optional<Cap> capOf(const Grid& grid, std::uint32_t cell);

/// True if a place lies in a cell, by its geometry alone.
bool holds(const Grid& grid, std::uint32_t cell, const GeoPoint& place);

}  // namespace cloudgen::field
