// SPDX-License-Identifier: Apache-2.0
#include "light/response.hpp"

#include <glm/common.hpp>

#include "light/shade.hpp"
#include "light/tone_curve.hpp"

namespace cloudgen::light {
namespace {

constexpr float kConstantHarmonic = 0.28209479f;  // of degree 0, everywhere

void add(PuffResponse& sum, float weight, const PuffResponse& one) {
  for (std::size_t i = 0; i < kHarmonics; ++i) {
    sum.sun[i] += weight * one.sun[i];
    sum.forward[i] += weight * one.forward[i];
  }
  sum.sky += weight * one.sky;
  sum.ground += weight * one.ground;
  sum.seen += weight * one.seen;
  sum.level += weight * one.level;
}

}  // namespace

CloudResponse responseOf(std::span<const shape::Puff> puffs, const CloudTransfer& cloud, float shading,
                         float sunHeightMeters) {
  // As shadePuffs: thick clouds are dark below, thin ones shown brighter.
  const float thick = glm::max(0.0f, 1 - cloud.once.towards), bright = glm::max(cloud.bright, kFace / kBrighter),
              sun = kSun * cloud.once.even;
  CloudResponse response;
  response.sunLeast = sun * glm::mix(kFlatSun, kFlatBelow, thick) * (1 - shading);
  response.sunMost = sun * (kFlatSun * (1 - shading) + kMostSun * shading);
  response.beam = cloud.once.even > 0 ? cloud.once.towards / cloud.once.even : 0;
  response.sunHeightMeters = sunHeightMeters;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    const PuffTransfer& transfer = cloud.puffs[i];
    const float below = undersideOf(cloud, transfer);
    PuffResponse puff{transfer.sun, transfer.through};
    for (float& coefficient : puff.sun) coefficient *= sun * shading / glm::mix(bright, kFace / kBelow, below);
    puff.sun[0] += sun * glm::mix(kFlatSun, kFlatBelow, below) * (1 - shading) / kConstantHarmonic;
    for (float& coefficient : puff.forward) coefficient *= kForward;
    puff.sky = glm::mix(kFlatSky, transfer.sky, shading);
    puff.ground = kGround * glm::mix(kFlatGround, transfer.ground, shading);
    puff.seen = glm::smoothstep(kHidden, kSeen, transfer.visibility);
    puff.weight = seenArea(puffs[i], transfer);
    puff.level = levelOf(cloud, transfer);
    response.puffs.push_back(puff);
  }
  return response;
}

std::vector<PuffResponse> averageResponse(std::span<const shape::Puff> puffs,
                                          std::span<const PuffResponse> responses,
                                          std::span<const shape::Puff> merged) {
  std::vector<PuffResponse> out;
  for (const shape::Puff& into : merged) {
    float weights = 1e-30f;
    for (const shape::Puff& puff : puffs) weights += weightWithin(puff, into);
    PuffResponse mean;
    mean.seen = 0;
    for (std::size_t i = 0; i < puffs.size(); ++i)
      add(mean, weightWithin(puffs[i], into) / weights, responses[i]);
    out.push_back(mean);
  }
  return out;
}

}  // namespace cloudgen::light
