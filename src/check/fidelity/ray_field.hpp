// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "check/fidelity/footprint.hpp"

namespace cloudgen::check {

/// Rays of one view, given by where they cross a plane, that gather the optical depth of blobs one after
/// the other: what is kept follows the rays, not the blobs.
class RayField {
 public:
  explicit RayField(std::vector<glm::vec2> places);

  /// Adds a blob's footprint with its centre at a place of the plane, which has so many metres a unit.
  void add(const Footprint& footprint, const glm::vec2& center, float metersPerUnit);
  /// Share of the rays that meet more than kCloudyOpticalDepth.
  double cover() const;
  double meanOpticalDepth() const;
  /// Standard error of the mean, as if the rays were independent.
  double opticalDepthError() const;

 private:
  std::vector<glm::vec2> places_;  ///< bin by bin
  std::vector<double> opticalDepths_;
  std::vector<std::uint32_t> start_;
  glm::vec2 lower_{0}, binSize_{1};
  int bins_ = 1;  ///< along each side
};

}  // namespace cloudgen::check
