// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "light/transfer.hpp"

namespace cloudgen::light {

/// How a puff answers to light, whatever the sun, ready for dot products: what shadePuffs makes of a transfer
/// before it exposes, in the cloud's axes.
struct PuffResponse {
  Harmonics sun{};      ///< radiance under a sun of colour 1, by its direction
  Harmonics forward{};  ///< radiance added towards the sun
  float sky = 0;        ///< share of an even sky that it sees
  float ground = 0;     ///< radiance over Sky::bounce of 1
  float seen = 1;       ///< share of its own tone that it shows; the rest is the cloud's mean tone
  float weight = 0;     ///< in that mean
  float level = 0;      ///< how far it is a level top, which a slanting sun lights more than the harmonics say (kLift)
};

/// The answers of a cloud's puffs, in their order.
struct CloudResponse {
  std::vector<PuffResponse> puffs;
  float sunLeast = 0, sunMost = 0;  ///< between which the dot product of `sun` is kept; that of `forward` within 0
                                    ///< and kForward
  float beam = 0;  ///< times the exposed answer to the sun: what is added towards the sun, up to kMostForward
  float sunHeightMeters = 0;        ///< at which the cloud sees the sun (sunColorAt)
};

/// Responses of a cloud with a relief of `shading` (shadePuffs).
CloudResponse responseOf(std::span<const shape::Puff> puffs, const CloudTransfer& cloud, float shading,
                         float sunHeightMeters);

/// Responses of puffs that stand for many, as averageLight weighs; they have no weight in the mean tone.
std::vector<PuffResponse> averageResponse(std::span<const shape::Puff> puffs,
                                          std::span<const PuffResponse> responses,
                                          std::span<const shape::Puff> merged);

}  // namespace cloudgen::light
