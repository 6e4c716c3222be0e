// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "pipeline/moving_clouds.hpp"

namespace cloudgen::pipeline {

/// A sky on the way from one time to the next.
struct SkyBetween {
  double share = 0;  ///< of the time between: 0 the one itself, 1 the other
  CloudsOfTime clouds;
  struct Origin {
    bool later = false;       ///< one of the later time's clouds
    std::uint32_t cloud = 0;  ///< which of them
    glm::dvec2 shift{0};      ///< metres from its place there
  };
  std::vector<Origin> origins;  ///< of each cloud
};

/// Into how many stretches the time between two skies is cut: one, unless the wind carries more than kMostLeaving of
/// their clouds out of the box, or into it, meanwhile; then as many as it takes that in each it is at most
/// kLeavingOfStretch, or kMostStretches. In a storm, or over twelve hours, the air of the box is another one at the next
/// time of a forecast: neither time knows the clouds that are on their way halfway.
inline constexpr double kMostLeaving = 0.5, kLeavingOfStretch = 0.25;
inline constexpr int kMostStretches = 8;
int stretchesBetween(const CloudsOfTime& earlier, const CloudsOfTime& later, const motion::WindBetween& wind);

/// The skies between two times at so many even steps, without the two themselves: each cell shows its clouds of the
/// earlier time until its turn has come and those of the later one from then on, where the pattern of the wind takes
/// them meanwhile. So cover and water go evenly from the one to the other, and a full sheet stays full.
std::vector<SkyBetween> skiesBetween(const CloudsOfTime& earlier, const CloudsOfTime& later, const glm::dvec2& wayOfPattern,
                                     int stretches);

}  // namespace cloudgen::pipeline
