// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <filesystem>
#include <optional>

#include "base/time.hpp"

namespace cloudgen::input {

/// Where a source without coordinates of its own stands (a weather code, a single column).
struct Place {
  double longitudeDegrees = 0, latitudeDegrees = 0;
  std::optional<double> elevationMeters;
};

/// What the user may say about the input.
struct OpenOptions {
  std::optional<base::UtcTime> time;     ///< the valid time wanted; nothing: the first
  std::optional<std::endian> byteOrder;  ///< of raw binary files; nothing: told by plausibility
  std::optional<Place> place;
  std::filesystem::path stations;  ///< a table of METAR stations beside the built-in one; may be empty
};

}  // namespace cloudgen::input
