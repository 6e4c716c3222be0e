// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "light/extinction_grid.hpp"

namespace cloudgen::light {

/// An endless level layer that is, at every height, as dense as a cloud usually is where it has anything.
class Layer {
 public:
  explicit Layer(const ExtinctionGrid& cloud);

  /// Optical depth from a height to the outside along a unit direction of this vertical component; the
  /// flattest ways are taken to rise by an eighth.
  float depthFrom(float heightMeters, float rise) const;

 private:
  float lower_ = 0, cell_ = 1;
  std::vector<float> below_;  ///< vertical optical depth below the lower border of each level, and of all
};

/// 0..1: how much a cloud is to be lit as a part of a layer: one that is wider than deep and made of flat puffs.
float layerShare(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid);
/// The same for one puff of any cloud, by how flat it is.
float layerShare(const shape::Puff& puff);

}  // namespace cloudgen::light
