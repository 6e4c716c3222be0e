// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape/puff.hpp"

namespace cloudgen::test {

/// A round puff.
inline shape::Puff ball(const glm::vec3& center, float sigma, float extinction) {
  shape::Puff puff;
  puff.center = center;
  puff.sigma = glm::vec3(sigma);
  puff.extinctionPerMeter = extinction;
  return puff;
}

}  // namespace cloudgen::test
