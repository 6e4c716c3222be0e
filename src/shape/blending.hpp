// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape/puff.hpp"

namespace cloudgen::shape {

/// How much wider than its puff a soft blob is that viewers blend, so that both cover the same. A puff lets
/// exp(-optical depth) through along every ray; a blob takes the opacity of its centre, which is never over
/// 1, times the Gaussian: where a dense puff is still opaque, a blob of its deviations is not. The same
/// extinction spread so much wider has the optical depth divided by the square. Both then have `covering` at
/// the same place: 0.1 (cloudy) for one that stands alone, less among others whose flanks overlap. 1 for thin
/// ones, at 20 it is 1.5 (1.3 for 0.01), at most 2.
float blendedWidening(float opticalDepth, float covering);

/// A puff among many as wide as a blended blob of it must be, across alone: base and top stay where they are.
Puff widenedAcross(Puff puff);

}  // namespace cloudgen::shape
