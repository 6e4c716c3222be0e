// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "input/grib/level.hpp"
#include "input/grib/parameter.hpp"

namespace cloudgen::input::grib {

/// How the values of a file become those of the meaning.
enum class Conversion { None, PerGravity, MixingRatioToSpecific };

struct Meaning {
  std::variant<field::Quantity, model::Single> what;
  Conversion conversion = Conversion::None;
  /// A second best: taken only where nothing else has the same meaning at the same time.
  bool reserve = false;
};

/// What a parameter means where it lies; nothing if it is of no use there.
std::optional<Meaning> meaningOf(const Parameter& parameter, const Level& level);

/// Whether a parameter is water of a kind that makes no cloud (rain, snow).
bool falls(What what);

}  // namespace cloudgen::input::grib
