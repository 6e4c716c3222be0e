// SPDX-License-Identifier: Apache-2.0
#include "light/undersides.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cloudgen::light {
namespace {

constexpr float kReach = 1.6f, kFurthest = 2.0f;  ///< in deviations of a puff, and in reaches

float breadth(const shape::Puff& puff) { return std::max(puff.sigma.x, puff.sigma.z); }

}  // namespace

Undersides::Undersides(std::span<const shape::Puff> puffs, std::span<const PuffTransfer> transfers) {
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    const float down = glm::smoothstep(0.2f, 0.6f, -transfers[p].upward);
    if (down > 0) down_.push_back({static_cast<std::uint32_t>(p), down});
  }
  // From west to east, so that those about a puff stand near it in the list.
  std::stable_sort(down_.begin(), down_.end(),
                   [&](const Share& a, const Share& b) { return puffs[a.puff].center.x < puffs[b.puff].center.x; });
  for (std::size_t i = 0; i < down_.size(); ++i) {
    const shape::Puff& own = puffs[down_[i].puff];
    const float reach = kReach * breadth(own);
    const std::size_t first = shares_.size();
    firsts_.push_back(static_cast<std::uint32_t>(first));
    const auto take = [&](const Share& other) {
      const shape::Puff& puff = puffs[other.puff];
      const glm::vec3 away = (puff.center - own.center) / reach;
      const float squared = glm::dot(away, away);
      // The underside that rain falls from is no darker for it.
      if (squared < kFurthest * kFurthest && (own.rain || !puff.rain))
        shares_.push_back(
            {other.puff, other.weight * shownArea(puff, transfers[other.puff]) * std::exp(-squared)});
      return std::abs(away.x) < kFurthest;
    };
    take(down_[i]);
    for (std::size_t k = i + 1; k < down_.size() && take(down_[k]); ++k) {}
    for (std::size_t k = i; k-- > 0 && take(down_[k]);) {}
    float sum = 1e-30f;
    for (std::size_t k = first; k < shares_.size(); ++k) sum += shares_[k].weight;
    for (std::size_t k = first; k < shares_.size(); ++k) shares_[k].weight /= sum;
  }
  firsts_.push_back(static_cast<std::uint32_t>(shares_.size()));
}

}  // namespace cloudgen::light
