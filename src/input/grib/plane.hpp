// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "field/grid.hpp"

namespace cloudgen::input::grib {

/// A place in a projection of PROJ, in metres. Throws InputError that names `where` if PROJ refuses either.
glm::dvec2 toPlane(const std::string& crs, const field::GeoPoint& place, const std::string& where);

/// Longitude and latitude (degrees) on a sphere turned so that `center` lies at (0, 0) and north of it stays
/// north.
field::GeoPoint aboutCenter(const field::GeoPoint& center, const field::GeoPoint& place);

}  // namespace cloudgen::input::grib
