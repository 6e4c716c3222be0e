// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light/transfer.hpp"

namespace cloudgen::light {

/// Light that comes out of a thick cloud below has been scattered so often that it hardly differs from one place to the
/// next (it diffuses over about the depth of the cloud): an underside shows swells and cores, but not its single puffs.
/// Knows which puffs look down, and which of them lie about each.
class Undersides {
 public:
  Undersides(std::span<const shape::Puff> puffs, std::span<const PuffTransfer> transfers);

  /// Brings `valueOf(items[i])`, one for each puff, to the mean about it as far as the puff looks down.
  template <class Item, class ValueOf>
  void even(std::vector<Item>& items, ValueOf valueOf) const {
    std::vector<float> means;
    for (std::size_t i = 0; i < down_.size(); ++i) {
      float sum = 0;
      for (std::uint32_t k = firsts_[i]; k < firsts_[i + 1]; ++k) sum += shares_[k].weight * valueOf(items[shares_[k].puff]);
      means.push_back(sum);
    }
    for (std::size_t i = 0; i < down_.size(); ++i) {
      float& value = valueOf(items[down_[i].puff]);
      value += down_[i].weight * (means[i] - value);
    }
  }

 private:
  struct Share {
    std::uint32_t puff = 0;
    float weight = 0;
  };
  std::vector<Share> down_;  ///< puffs that look down, and how much
  std::vector<std::uint32_t> firsts_;
  std::vector<Share> shares_;  ///< of the mean about each of them, from its first to that of the next; of sum 1
};

}  // namespace cloudgen::light
