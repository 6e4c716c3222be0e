// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "pipeline/pipeline.hpp"

namespace cloudgen::pipeline {

/// What became of the clouds from one time to the next.
struct HourOfMotion {
  base::UtcTime from, to;
  std::uint64_t matched = 0, splits = 0, mergers = 0, births = 0, deaths = 0;
  double matchedShare = 0;  ///< of the ground under the clouds of both times: those that are matched
  /// The drift of matched clouds along the mean wind on their way, over that wind; 0 where it is calm.
  double driftOverWind = 0;
  double windMetersPerSecond = 0;  ///< mean over matched clouds
  int stretches = 0;  ///< the time was cut into (see stretchesBetween); what is counted is counted in each
  double patternMetersPerSecond = 0;  ///< how fast the pattern of the wind moves, as a storm does
};

/// A sky that moves, from several times of a forecast.
struct MovingSky {
  Outcome first;       ///< of the first time, as a sky that stands still
  scene::Scene scene;  ///< the clouds of all times, with their motions; light as at the first time
  /// Where there are skies between: the same without them, of a fraction of the clouds, for formats that play few.
  std::optional<scene::Scene> uncut;
  std::vector<base::UtcTime> times;
  std::vector<HourOfMotion> hours;         ///< one fewer than times
  std::vector<std::uint64_t> lifetimes;    ///< [n]: chains of matched clouds that are there in n + 1 skies
};

/// Opens the source of one of the times, or its typing.
using OpenTime = std::function<std::unique_ptr<field::Source>(base::UtcTime)>;

/// Builds every time with the same detail and joins them: each cloud of a time comes from its partner at the time before
/// and goes on as that at the time after (motion::track), on the way that the wind takes it, so that at the times
/// themselves the sky is as without motion. Where the wind carries most clouds over the border of the box meanwhile, they
/// do so from sky to sky of some in between (skiesBetween). Between two times it fades from one cloud of a pair to the other at one
/// place and of one size; those without partner form and dissolve by area and optical depth, their water linear in
/// time. Throws InputError as `run`, and where the times have different grids. `times`: ascending, at least 2. A typing
/// of each time goes before Options::typing.
MovingSky runTimes(const std::vector<base::UtcTime>& times, const OpenTime& open, const Options& options,
                   const base::Progress& progress, const OpenTime& openTyping = {});

}  // namespace cloudgen::pipeline
