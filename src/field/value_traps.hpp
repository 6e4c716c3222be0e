// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "field/source.hpp"

namespace cloudgen::field {

/// Counts values on levels that no air has, as they go by: negative condensate, humidity over 100 %, cover
/// over 1, and cover that is zero everywhere although there is water.
class ValueTraps {
 public:
  void look(const Level& level);
  /// What was met, with numbers.
  std::vector<Warning> warnings() const;
  /// True when cover was there, was zero in every cell, and some cell has cloud water.
  bool coverIsEmpty() const { return coverSeen_ && greatestCover_ <= 0 && cloudyCells_ > 0; }

 private:
  std::uint64_t negativeWater_ = 0, overSaturated_ = 0, overCovered_ = 0, cloudyCells_ = 0;
  float leastWater_ = 0, greatestHumidity_ = 0, greatestCover_ = 0;
  bool coverSeen_ = false;
};

}  // namespace cloudgen::field
