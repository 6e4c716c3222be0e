// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/source.hpp"
#include "input/cdfs/cloud_types.hpp"

namespace cloudgen::input::cdfs {

/// How often each rule applied, in layers (cells where it says so).
struct Counts {
  std::uint64_t told = 0;
  std::uint64_t staleLow = 0, staleUpper = 0, tooNew = 0, neverObserved = 0;
  std::uint64_t cumulonimbusAsCumulus = 0;
  std::uint64_t amountTooLarge = 0, withoutHeight = 0, withoutType = 0, aboveFog = 0;
  std::uint64_t baseAssumed = 0, depthAssumed = 0;
  std::uint64_t totalCells = 0, totalOff = 0;  ///< cells with a total cover; those where it does not fit
  double totalOffBy = 0;                       ///< sum of the differences, per cent
  std::array<std::uint64_t, 256> strangeCodes{};

  Counts& operator+=(const Counts& other);
};

/// One warning a rule that applied.
std::vector<field::Warning> warningsOf(const Counts& counts, TypeTable table);

}  // namespace cloudgen::input::cdfs
