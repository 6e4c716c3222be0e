// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "check/fidelity/fidelity.hpp"
#include "cli/input_options.hpp"

namespace cloudgen::cli {

/// A moment between two times of a forecast.
struct MomentBetween {
  base::UtcTime from, to, at;
  double share() const;  ///< of the time between
};

/// Where --time names a moment that the input has no clouds for, between two that it has.
std::optional<MomentBetween> momentBetween(const InputLine& input);

/// How far a sky that moves is from the model between two times, both taken linear in time: means over the box, as no
/// column of the model knows what the wind carries through it.
struct BetweenFidelity {
  MomentBetween moment;
  std::string file, format;
  double total = 0;                          ///< cover, scene minus model
  std::array<double, check::kRanges> in{};   ///< the same, low to high
  double modelOpticalDepth = 0, sceneOpticalDepth = 0;
  /// Of total cover.
  static constexpr double kTolerance = 0.03;
  bool passed() const { return std::abs(total) <= kTolerance; }
};

BetweenFidelity compareBetween(const MomentBetween& moment, const check::WrittenScene& scene, const base::LocalFrame& frame,
                               InputLine input, const base::Progress& progress);

/// As schemas/verify_between.schema.json says, and in a few lines.
nlohmann::ordered_json betweenJson(const BetweenFidelity& fidelity);
std::string betweenText(const BetweenFidelity& fidelity);

}  // namespace cloudgen::cli
