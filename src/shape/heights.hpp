// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "shape/puff.hpp"

namespace cloudgen::shape {

/// The height below which a share (0..1) of the extinction of upright puffs lies, metres.
double heightOfShare(std::span<const Puff> puffs, double share);

/// How a cloud ends: heaps bulge towards their top; what is told by few puffs, or is a layer, is flat there,
/// so that no dense puff is seen beyond; the dome of a storm shoots a little over the top of its anvil.
enum class Ends { Round, Flat, Overshooting };

/// Moves and stretches puffs upright so that `borderShare` of their extinction lies below that share of the
/// depth, and as much above its counterpart from the top: as it does in an even layer of this depth. What
/// falls out of the cloud (centres below 0) stays where it is.
void spreadBetween(std::span<Puff> puffs, double borderShare, double depthMeters, Ends ends);

/// Moves puffs up or down, and stretches them there, so that half of their extinction lies below that share
/// of the height between those below and above which `borderShare` of it lies; these stay, near enough, where
/// they are. No puff becomes more than four times as high, or less than a quarter.
void gatherAt(std::span<Puff> puffs, double middle, double borderShare);

/// Moves puffs sideways so that the centroid of their extinction is over the origin.
void standOverCentroid(std::span<Puff> puffs);

}  // namespace cloudgen::shape
