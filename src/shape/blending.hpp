// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "shape/puff.hpp"

namespace cloudgen::shape {

/// How much wider than its puff a soft blob is that viewers blend, so that both cover the same. A puff lets
/// exp(-optical depth) through along every ray; a blob takes the opacity of its centre, which is never over
/// 1, times the Gaussian: where a dense puff is still opaque, a blob of its deviations is not. The same
/// extinction spread so much wider has the optical depth divided by the square. Both then have `covering` at
/// the same place: 0.1 (cloudy) for one that stands alone, less among others whose flanks overlap. 1 for thin
/// ones, at 20 it is 1.5 (1.3 for 0.01), at most 2.
float blendedWidening(float opticalDepth, float covering);

/// Seen from straight above, what has more than this optical depth is covered.
inline constexpr double kCoveringOpticalDepth = 0.1;

/// `covering` of a puff among many, where nothing better is known.
inline constexpr float kCoveringAmongMany = 0.015f;

/// Optical depth of a blended blob at so much of its Gaussian (1 in its middle).
class BlendedProfile {
 public:
  explicit BlendedProfile(double opticalDepth)
      : opacity_(std::min(1 - 0x1p-20f, -std::expm1(-static_cast<float>(opticalDepth)))) {}
  float operator()(double gaussian) const { return -std::log1p(-opacity_ * static_cast<float>(gaussian)); }

 private:
  float opacity_;
};

/// A puff among others as wide as a blended blob of it must be, across alone: base and top stay where they
/// are.
Puff widenedAcross(Puff puff, float covering = kCoveringAmongMany);

/// Ground that puffs cover, m2: as they are; or as blobs that are blended, as wide as widenedAcross makes
/// them.
double coveredSquareMeters(std::span<const Puff> puffs);
double blendedSquareMeters(std::span<const Puff> puffs, float covering);

/// The `covering` (between 0.001 and 0.3) with which what is drawn covers `wanted` square metres, where
/// `coveredWith(covering)` are those that it covers, the more the more `covering` is.
template <class CoveredWith>
float coveringThat(double wanted, CoveredWith coveredWith) {
  float least = 0.001f, most = 0.3f;
  for (int pass = 0; pass < 5; ++pass) {
    const float middle = std::sqrt(least * most);
    (coveredWith(middle) > wanted ? most : least) = middle;
  }
  return std::sqrt(least * most);
}

/// The `covering` with which blended blobs of puffs cover together what the puffs do (between 0.001 and 0.3).
/// It depends on how the flanks of the puffs lie over each other.
float coveringOf(std::span<const Puff> puffs);

}  // namespace cloudgen::shape
