// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "check/fidelity/blob.hpp"

namespace cloudgen::check {

/// A viewer far away, and the height at which the rays to it are counted.
struct View {
  glm::vec3 toViewer{0, 1, 0}, right{1, 0, 0}, up{0, 0, -1};  ///< unit vectors; the default is from above
  double levelMeters = 0;
};

/// A viewer in the direction of a unit vector, head up; not in the level itself (y = 0).
View viewAlong(const glm::vec3& toViewer, double levelMeters);

/// A viewer at a zenith angle under 90 degrees and an azimuth (clockwise from north), head up; at the
/// zenith its head is to the north.
View viewFrom(double zenithDegrees, double azimuthDegrees, double levelMeters);

/// What turning cards turn about: a place and the size of their metre.
struct Pivot {
  glm::vec3 place{0};
  float scale = 1;
};

/// A soft blob of a written scene as a viewer far away sees it, cast along the rays onto a level: what it
/// adds to the optical depth of a ray, and at which height. Lengths in metres of the scene frame (x east, z
/// south, y up).
struct Footprint {
  glm::vec2 place{0};         ///< x and z where the ray through the centre meets the level
  glm::mat2 toDeviations{1};  ///< from metres off it to standard deviations
  float opticalDepth = 0;     ///< of the ray through the centre
  float opacity = 0;          ///< that viewers give its centre
  float narrowing = 1;        ///< deviations of its optical depth to those of its opacity
  float reach = 4;            ///< deviations beyond which it adds nothing
  bool card = false;          ///< flat
  float height = 0;           ///< mean height of what a ray through the centre meets
  glm::vec2 heightSlope{0};   ///< metres up for a metre in x and in z
  float heightDeviation = 0;  ///< standard deviation of height along a ray

  /// Share of the opacity of its centre that it has so many metres off its place.
  float opacityShareAt(const glm::vec2& off) const {
    const glm::vec2 deviations = toDeviations * off;
    const float distance = glm::dot(deviations, deviations);
    return distance <= reach * reach ? std::exp(-0.5f * distance) : 0.0f;
  }
  /// The optical depth that it adds where it has such a share.
  float opticalDepthOf(float opacityShare) const {
    return opticalDepth *
           (narrowing < 1 ? std::pow(opacityShare, 1 / (narrowing * narrowing)) : opacityShare);
  }
  float opticalDepthAt(const glm::vec2& off) const { return opticalDepthOf(opacityShareAt(off)); }
  /// Half the sides of the box around what it covers.
  glm::vec2 halfSides() const;
};

/// What a view shows of a blob. Volumes are followed out to four deviations, or to where they fall below an
/// optical depth of 0.001; cards end at their border, and are not seen nearly edge-on or from a side that is
/// not drawn. The heights of turning cards are those that a viewer beside them sees.
Footprint footprintOf(const Blob& blob, std::span<const Pivot> pivots, const View& view);

/// True if a card or blob is seen at all: not edge-on, and every number finite.
bool isSeen(const Footprint& footprint);

/// What a view shows of all blobs, in their order; those that are not seen are left out.
std::vector<Footprint> footprintsOf(std::span<const Blob> blobs, std::span<const Pivot> pivots,
                                    const View& view);

}  // namespace cloudgen::check
