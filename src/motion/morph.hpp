// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "shape/puff.hpp"

namespace cloudgen::motion {

/// Two puffs that are one, and the share of each that goes this way.
struct PuffPair {
  std::uint32_t from = 0, to = 0;
  float fromShare = 1, toShare = 1;
};

/// Matches the puffs of two clouds: the nearest in boxes of side 1 about either, then with their partners changed where
/// that shortens the ways. Where one cloud has more, the surplus starts or ends on the nearest puff of the other, which
/// is shared out. Empty if either has none.
std::vector<PuffPair> matchPuffs(std::span<const shape::Puff> from, std::span<const shape::Puff> to);

/// The cloud on its way, `share` 0 to 1: one puff a pair. Centres and deviations go straight, rotations turn by the shorter
/// way, and the extinction of each, integrated over space, goes evenly, so that of the whole does. At the ends it is what
/// either cloud is, puffs that are shared standing in one place.
std::vector<shape::Puff> morphed(std::span<const shape::Puff> from, std::span<const shape::Puff> to,
                                 std::span<const PuffPair> pairs, float share);

}  // namespace cloudgen::motion
