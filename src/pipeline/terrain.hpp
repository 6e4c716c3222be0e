// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/frame.hpp"
#include "base/height_field.hpp"
#include "field/cloud_table.hpp"
#include "field/source.hpp"

namespace cloudgen::pipeline {

/// The ground of a scene.
struct Ground {
  float lowestMeters = 0;     ///< above mean sea level; 0 where the source does not know
  base::HeightField terrain;  ///< empty where the ground is flat or not known
};

/// The model's own orography on a lattice over the scene's rectangle, at most 129 x 129 points, about two a
/// cell of the model: a quadratic B-spline of the cells' heights, so that it has no steps. A ring of points
/// beyond the rectangle lies at the lowest height. Points outside the model's grid take the height of the
/// nearest one inside. `cells` are those of the scene.
Ground groundOf(const field::Source& source, const base::LocalFrame& frame,
                const std::vector<std::uint32_t>& cells);

/// Moves the bases of clouds to the terrain of their own place: fog keeps its height above the ground of its
/// cell, other clouds are lifted where the ground would reach into them.
void standOnTerrain(const Ground& ground, const base::LocalFrame& frame, field::CloudTable& table);

}  // namespace cloudgen::pipeline
