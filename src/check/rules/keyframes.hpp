// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace cloudgen::check {

/// Where a time lies among keys: between two of them (the same before the first and after the last), and how far.
struct Keyframe {
  std::size_t before = 0, after = 0;
  float share = 0;
};

/// Of one key or more; whatever they are, both are within them and the share is from 0 to 1.
inline Keyframe keyframeAt(std::span<const float> keys, float time) {
  const auto next = static_cast<std::size_t>(std::upper_bound(keys.begin(), keys.end(), time) - keys.begin());
  Keyframe at{next > 0 ? next - 1 : 0, std::min(std::max<std::size_t>(next, 1), keys.size() - 1)};
  const float step = keys[at.after] - keys[at.before], gone = (time - keys[at.before]) / step;
  if (step > 0 && gone > 0) at.share = std::min(gone, 1.0f);
  return at;
}

}  // namespace cloudgen::check
