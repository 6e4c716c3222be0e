// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace cloudgen::check {
namespace {

constexpr float kMostDeviations = 4;  // 0.03 % of a Gaussian lies beyond
constexpr float kFaintest = 1e-3f;    // optical depth that is followed outwards

float reachOf(float opticalDepth) {
  const float ratio = opticalDepth / kFaintest;
  return ratio > 1 ? std::min(kMostDeviations, std::sqrt(2 * std::log(ratio))) : 0;
}

}  // namespace

glm::vec2 Footprint::halfSides() const {
  const glm::mat2 axes = glm::inverse(toDeviations);
  if (square) return reach * (glm::abs(axes[0]) + glm::abs(axes[1]));
  return reach * glm::sqrt(axes[0] * axes[0] + axes[1] * axes[1]);
}

Footprint footprintOfBlob(const glm::vec3& center, const glm::mat3& halfAxes, float frontalOpticalDepth) {
  const glm::mat3 covariance = halfAxes * glm::transpose(halfAxes);
  const std::array<float, 3> lengths{glm::length(halfAxes[0]), glm::length(halfAxes[1]),
                                     glm::length(halfAxes[2])};
  const double xx = covariance[0][0], xz = covariance[0][2], zz = covariance[2][2];
  const double determinant = std::max(xx * zz - xz * xz, 1e-12);
  // The Cholesky factor of the horizontal covariance, turned round.
  const double a = std::sqrt(std::max(xx, 1e-6)), b = xz / a, c = std::sqrt(determinant) / a;
  Footprint out;
  out.place = {center.x, center.z};
  out.toDeviations =
      glm::mat2(static_cast<float>(1 / a), static_cast<float>(-b / (a * c)), 0.0f, static_cast<float>(1 / c));
  const double volume = static_cast<double>(lengths[0]) * lengths[1] * lengths[2],
               shortest = *std::min_element(lengths.begin(), lengths.end());
  out.opticalDepth = static_cast<float>(frontalOpticalDepth * volume / (shortest * std::sqrt(determinant)));
  out.reach = reachOf(out.opticalDepth);
  out.height = center.y;
  const double yx = covariance[0][1], yz = covariance[1][2];
  const double slopeX = (zz * yx - xz * yz) / determinant, slopeZ = (xx * yz - xz * yx) / determinant;
  out.heightSlope = {static_cast<float>(slopeX), static_cast<float>(slopeZ)};
  out.heightDeviation =
      static_cast<float>(std::sqrt(std::max(0.0, covariance[1][1] - slopeX * yx - slopeZ * yz)));
  return out;
}

Footprint footprintOfCard(const glm::vec3& center, const std::array<glm::vec3, 2>& halfAxes, float reach,
                          float opticalDepth) {
  const glm::mat2 axes(halfAxes[0].x, halfAxes[0].z, halfAxes[1].x, halfAxes[1].z);
  Footprint out;
  out.place = {center.x, center.z};
  out.opticalDepth = opticalDepth;
  out.reach = reach;
  out.square = true;
  out.height = center.y;
  // Under five hundredths of its area is left of a card that stands nearly upright.
  const float seen = std::abs(glm::determinant(axes)),
              whole = glm::length(glm::cross(halfAxes[0], halfAxes[1]));
  if (!(seen > 0.05f * whole)) {
    out.opticalDepth = 0;
    return out;
  }
  out.toDeviations = glm::inverse(axes);
  out.heightSlope = glm::vec2(halfAxes[0].y, halfAxes[1].y) * out.toDeviations;
  return out;
}

bool isSeen(const Footprint& footprint) {
  const glm::mat2& m = footprint.toDeviations;
  const float all = footprint.place.x + footprint.place.y + m[0][0] + m[0][1] + m[1][0] + m[1][1] +
                    footprint.opticalDepth + footprint.height + footprint.heightSlope.x +
                    footprint.heightSlope.y + footprint.heightDeviation;
  if (!std::isfinite(all) || !(footprint.opticalDepth > 0) || !(footprint.reach > 0)) return false;
  const glm::vec2 half = footprint.halfSides();
  return std::isfinite(half.x) && std::isfinite(half.y);
}

}  // namespace cloudgen::check
