// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "field/grid.hpp"
#include "input/netcdf/file.hpp"

namespace cloudgen::input::netcdf {

/// The PROJ definition of a CF grid mapping (CF conventions, appendix F), for x and y in metres (degrees for
/// rotated poles; radians times the height for geostationary views). Nothing if it is none that is read.
std::optional<std::string> projection(const Variable& mapping);

/// The greatest distance in metres between where a lattice puts its cells and where they are said to be.
/// Infinite where the lattice has no place for them.
struct KnownPlace {
  double column = 0, row = 0;
  field::GeoPoint place;
};
double greatestDistanceMeters(const field::Grid& lattice, const std::vector<KnownPlace>& places);

}  // namespace cloudgen::input::netcdf
