// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace cloudgen::field {

/// A cloud layer of one column: its cover as a share of the area, and where it stands in metres.
struct CoverLayer {
  double cover = 0, baseMeters = 0, topMeters = 0;
};

/// The distance over which the overlap of cloud decorrelates, metres: 750 + 2149 cos^2(latitude) (Shonk et
/// al. 2010, as ecRad has it).
double decorrelationMeters(double latitudeDegrees);

/// How much of the overlap of two layers is maximum, the rest being random: exp(-distance of their middles /
/// decorrelationMeters) where they touch, 0 where there is clear air between them (exponential-random
/// overlap, Hogan & Illingworth 2000).
double overlapOf(const CoverLayer& one, const CoverLayer& other, double latitudeDegrees);

/// The cover of layers together, in any order. Two of them cover alpha max(c1, c2) + (1 - alpha)(c1 + c2 -
/// c1 c2) with alpha of overlapOf; of more, each one's overlap with the next by height decides, whatever lies
/// beyond (Hogan & Illingworth 2000, equation 1, as a chain): it does not matter from which end one counts,
/// and the result lies between the greatest cover and that of random overlap.
double overlappedCover(std::span<const CoverLayer> layers, double latitudeDegrees);

}  // namespace cloudgen::field
