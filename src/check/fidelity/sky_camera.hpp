// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "base/frame.hpp"
#include "base/progress.hpp"
#include "check/fidelity/model_columns.hpp"
#include "check/fidelity/written_scene.hpp"

namespace cloudgen::check {

/// What a camera that looks up from the ground reports.
struct SkyReport {
  double longitudeDegrees = 0, latitudeDegrees = 0;
  double skyCover = 0;    ///< share of the sky it sees that is cloudy
  double modelCover = 0;  ///< of the model's columns around it, by area
};

/// Cloud amount in eighths as an observer says it: 0 only of a clear sky, 8 only of an overcast one.
int octasOf(double cover);

/// Half the opening of the cameras, degrees from the zenith.
inline constexpr double kSkyZenithDegrees = 70;

/// All-sky cameras at places spread evenly over the box, on ground of a height. Each sees the sky down to
/// kSkyZenithDegrees, equal parts of it by one ray each; a blob as parallel rays from its centre show it;
/// what is less than 20 m above the camera not at all. The box is repeated to all sides, so that cameras near
/// its border see a sky, too. An amount from the ground is more than the cover from above where clouds have
/// sides.
std::vector<SkyReport> lookUp(const WrittenScene& scene, const base::LocalFrame& frame,
                              std::span<const ModelColumn> columns, const base::Progress& progress);

}  // namespace cloudgen::check
