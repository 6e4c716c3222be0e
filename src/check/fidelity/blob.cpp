// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/blob.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace cloudgen::check {

Blob volumeBlob(const glm::vec3& center, const glm::mat3& halfAxes, float frontalOpticalDepth) {
  const glm::mat3 c = halfAxes * glm::transpose(halfAxes);
  const std::array<double, 3> lengths{glm::length(halfAxes[0]), glm::length(halfAxes[1]),
                                      glm::length(halfAxes[2])};
  Blob blob;
  blob.center = center;
  blob.shape = {c[0][0], c[0][1], c[0][2], c[1][1], c[1][2], c[2][2]};
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  blob.strength = static_cast<float>(2 * std::numbers::pi * frontalOpticalDepth * lengths[0] * lengths[1] *
                                     lengths[2] / shortest);
  blob.opacity = -std::expm1(-frontalOpticalDepth);
  return blob;
}

Blob cardBlob(const glm::vec3& center, const glm::vec3& right, const glm::vec3& up, float opticalDepth) {
  Blob blob;
  blob.center = center;
  blob.shape = {right.x, right.y, right.z, up.x, up.y, up.z};
  blob.strength = opticalDepth;
  blob.opacity = -std::expm1(-opticalDepth);
  blob.kind = BlobKind::Card;
  return blob;
}

}  // namespace cloudgen::check
