// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "light/puff_light.hpp"
#include "light/sky.hpp"
#include "light/transfer.hpp"

namespace cloudgen::light {

/// What lights a cloud: sun and sky in the cloud's own axes.
struct Lighting {
  glm::vec3 sunDirection{0, 1, 0};
  glm::vec3 sunColor{1};
  Sky sky;
};

/// Light of each puff by its transfer: sun by all orders of scattering, sky light, light from the ground, as
/// a camera exposes that brings the cloud's own bright faces to white. `shading` 0 makes the cloud flat white
/// (cirrocumulus shows none), 1 is full relief. Puffs hidden on all sides take the mean tone of those that
/// are seen.
std::vector<PuffLight> shadePuffs(std::span<const shape::Puff> puffs, const CloudTransfer& cloud,
                                  const Lighting& lighting, float shading);

/// What is left of the colours of a cloud that gets only a share of the sun, 0..1, and the sky and the ground as
/// before: bluer by day, and nothing is taken once the sun is down.
glm::vec3 dimming(float sunlight, const glm::vec3& sunColor, const Sky& sky);

/// The light of a puff of a cloud that gets only a share of the sun.
PuffLight inShadow(const PuffLight& light, float sunlight, const glm::vec3& sunColor, const Sky& sky);

/// What a puff counts in the light of one that stands for many: by area and by nearness in its deviations.
float weightWithin(const shape::Puff& puff, const shape::Puff& merged);

/// Light of puffs that stand for many (shape::reduce): the mean of the lights about each
/// (weightWithin).
std::vector<PuffLight> averageLight(std::span<const shape::Puff> puffs, std::span<const PuffLight> lights,
                                    std::span<const shape::Puff> merged);

}  // namespace cloudgen::light
