// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "check/gltf/read_splats.hpp"

namespace cloudgen::check {

/// What the header of a PLY file of splats says.
struct PlyHeader {
  std::size_t headerBytes = 0, count = 0, floats = 0;
  /// Where in a record of floats: place, degree 0, the first coefficient above it, opacity, deviations, rotation.
  std::size_t place = 0, color = 0, rest = 0, opacity = 0, scale = 0, rotation = 0;
  std::size_t coefficients = 0;  ///< above degree 0: 0, 3, 8 or 15
};

/// Reads the header of splats in binary little-endian PLY whose properties are floats. Throws InputError, naming
/// `where`, if it is another file, if a property is missing, or if the bytes are not as many as it says.
PlyHeader readPlyHeader(std::string_view bytes, const std::string& where);

/// Hands over the splats of the file, with harmonics of degree 1 at most. The opacity is a logit, so it tells
/// optical depths however large.
void readPlySplats(std::string_view bytes, const std::string& where,
                   const std::function<void(const ReadSplat&)>& visit);

}  // namespace cloudgen::check
