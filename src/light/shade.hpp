// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "light/extinction_grid.hpp"
#include "light/puff_light.hpp"
#include "light/sky.hpp"

namespace cloudgen::light {

/// What lights a cloud: sun and sky in the cloud's own axes.
struct Lighting {
  glm::vec3 sunDirection{0, 1, 0};
  glm::vec3 sunColor{1};
  Sky sky;
};

/// Light of each puff inside the medium of `grid`: sunlight by optical depth to the sun with eight scattering
/// octaves (Wrenninge et al. 2013, a = b = 0.5), sky light from above and ground light from below by their
/// optical depths. `shading` 0 makes the cloud flat white (cirrocumulus shows none), 1 is full relief. Puffs
/// hidden on all sides take the mean tone of those that are seen.
std::vector<PuffLight> shadePuffs(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid,
                                  const Lighting& lighting, float shading);

/// Light of puffs that stand for many (shape::reduce): the mean of the lights about each, by area and by
/// nearness in its deviations.
std::vector<PuffLight> averageLight(std::span<const shape::Puff> puffs, std::span<const PuffLight> lights,
                                    std::span<const shape::Puff> merged);

/// Sum over octaves i < 8 of b^i exp(-a^i tau), a = b = 0.5, divided by its value at tau = 0: the share of
/// sunlight that arrives by all orders of scattering, isotropic part. 1 at tau 0, falling.
float scatteredShare(float opticalDepth);

}  // namespace cloudgen::light
