// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "pipeline/candidates.hpp"
#include "pipeline/canvas.hpp"

namespace cloudgen::pipeline {

/// A cloud that was taken.
struct FittedCloud {
  std::uint32_t layer = 0;  ///< index in the table
  Candidate candidate;
  double widthMeters = 0, depthMeters = 0, extinctionArea = 0;
};

/// Takes candidates so that what is drawn, seen from straight above, is what the layers say, cell by cell.
/// Each is painted on a canvas as it will be drawn; it is taken if the canvas is then nearer to the cover
/// that the cells' layers want, and smaller if only that helps. Layers are filled from the highest down, and
/// of the places that clouds above cover and those that they leave open each gets its share, so that the
/// cover of all layers together follows the overlap rule. In between optical depth is moved between the
/// clouds until the mean of each layer is right (the multiplicative iteration of Richardson 1972), and clouds
/// are given back or added as that changes the cover. Deterministic: cells come in an order that only their
/// index decides.
std::vector<FittedCloud> fitClouds(const CandidateContext& context, std::span<const std::uint32_t> cells,
                                   std::span<const field::Layer> layers, FootprintBook& footprints);

}  // namespace cloudgen::pipeline
