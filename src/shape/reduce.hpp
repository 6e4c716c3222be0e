// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "shape/puff.hpp"

namespace cloudgen::shape {

/// Merges puffs into at most `count` (>= 1) by splitting the set at the median of its widest axis and
/// matching the moments of each part: extinction area, centroid and covariance (its diagonal in the cloud's
/// axes) are kept.
std::vector<Puff> reduce(std::span<const Puff> puffs, int count);

}  // namespace cloudgen::shape
