// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>

namespace cloudgen::shape {

struct PrincipalAxes {
  glm::dmat3 axes{1};      ///< columns, of length 1, right-handed
  glm::dvec3 variance{0};  ///< along each, the greatest first
};

/// Of a covariance (symmetric), by Jacobi's rotations.
PrincipalAxes principalAxes(const glm::dmat3& covariance);

}  // namespace cloudgen::shape
