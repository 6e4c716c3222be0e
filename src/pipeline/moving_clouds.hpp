// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "motion/tracking.hpp"
#include "motion/wind_field.hpp"
#include "pipeline/steps.hpp"
#include "scene/scene.hpp"

namespace cloudgen::pipeline {

/// The clouds of one time as their motion sees them; parallel to the instances of its scene.
struct CloudsOfTime {
  std::vector<motion::CarriedCloud> clouds;  ///< where they stand, not carried yet
  /// Of each cloud: the share of the time to another at which its cell shows that one's clouds (see skiesOf). Evenly
  /// spread over neighbouring cells, and the same for a cell at all times.
  std::vector<float> turns;
  std::vector<float> fractions;   ///< of each cloud: the cover of its layer
  glm::dvec2 lower{0}, upper{0};  ///< of the scene's box: nothing is known of the wind beyond
};

/// From the layers and clouds of a time.
CloudsOfTime cloudsOfTime(const field::Grid& grid, const base::LocalFrame& frame, const field::CloudTable& table);

/// The wind of a time: of the air, clear or cloudy, where its source has levels; else of its layers.
motion::WindField windOf(const Located& located);

/// The ways of the clouds of two times between them.
struct Passage {
  double seconds = 0;
  int intervals = 0;  ///< the ways have one place more
  motion::Tracking tracking;
  std::vector<std::vector<glm::dvec2>> forwards, backwards;  ///< of each earlier cloud; of each later one, in time's order
  /// Of each earlier cloud: the cover of the later ones' layer at its heights where it ends; of each later one in turn.
  std::vector<float> fractionsAhead, fractionsBefore;
};

/// Carries, matches, and cuts a stretch of the time into as many intervals as straight lines need to follow the wind, at
/// most 24.
Passage passageOf(const CloudsOfTime& earlier, const CloudsOfTime& later, const motion::WindBetween& wind,
                  const motion::Stretch& stretch);

/// The moments of an earlier cloud as it goes, shrunk away where the wind takes it out of the box, from its
/// own time to the next, and of a later one as it comes.
std::vector<scene::Moment> going(const Passage& passage, const CloudsOfTime& earlier, const CloudsOfTime& later,
                                 std::uint32_t cloud);
std::vector<scene::Moment> coming(const Passage& passage, const CloudsOfTime& earlier, const CloudsOfTime& later,
                                  std::uint32_t cloud);

}  // namespace cloudgen::pipeline
