// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/frame.hpp"
#include "base/progress.hpp"
#include "check/fidelity/written_scene.hpp"

namespace cloudgen::check {

/// What parallel rays at one zenith angle see of the whole box, four azimuths together.
struct SlantedView {
  double zenithDegrees = 0;
  double cover = 0;              ///< share of the rays that meet cloud
  double opticalDepth = 0;       ///< mean along the rays, times the cosine of the zenith angle
  double opticalDepthError = 0;  ///< its standard error, at most
};

struct Slants {
  SlantedView vertical;
  std::vector<SlantedView> slanted;
  int rays = 0;  ///< of each azimuth
  /// The scene is drawn in volumes alone: then a slanted ray meets as much as a vertical one does, on the
  /// mean and for the same height. Flat cards cannot keep to that.
  bool volumes = false;
};

/// Looks at a scene along vertical rays and along rays of 30 and 60 degrees. The box is repeated to all
/// sides, as models of radiation do, so that it has no borders: a ray that leaves it comes in again opposite.
Slants lookAslant(const WrittenScene& scene, const base::LocalFrame& frame, const base::Progress& progress);

}  // namespace cloudgen::check
