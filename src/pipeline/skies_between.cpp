// SPDX-License-Identifier: Apache-2.0
#include "pipeline/skies_between.hpp"

#include <algorithm>

#include "base/thread.hpp"

namespace cloudgen::pipeline {
namespace {

/// How many clouds the wind carries over the border of the box in a stretch of the time.
std::int64_t crossing(const CloudsOfTime& time, const motion::WindBetween& wind, bool backwards, int stretches) {
  const double length = 1.0 / stretches;
  const motion::Stretch stretch = backwards ? motion::Stretch{1 - length, 1} : motion::Stretch{0, length};
  std::vector<char> gone(time.clouds.size());
  base::parallelFor(gone.size(), [&](std::size_t i) {
    const motion::CarriedCloud& cloud = time.clouds[i];
    const glm::dvec2 end = motion::pathOf(wind, cloud.place, cloud.middleMeters(), 6, backwards, stretch).back();
    gone[i] = end.x < time.lower.x || end.y < time.lower.y || end.x > time.upper.x || end.y > time.upper.y;
  });
  return std::count(gone.begin(), gone.end(), 1);
}

void take(const CloudsOfTime& from, std::uint32_t cloud, bool later, const glm::dvec2& shift, SkyBetween& sky) {
  motion::CarriedCloud moved = from.clouds[cloud];
  moved.place += shift;
  sky.clouds.clouds.push_back(moved);
  sky.clouds.turns.push_back(from.turns[cloud]);
  sky.clouds.fractions.push_back(from.fractions[cloud]);
  sky.origins.push_back({later, cloud, shift});
}

}  // namespace

int stretchesBetween(const CloudsOfTime& earlier, const CloudsOfTime& later, const motion::WindBetween& wind) {
  const auto clouds = static_cast<double>(earlier.clouds.size() + later.clouds.size());
  const auto leaving = [&](int stretches) {
    return static_cast<double>(crossing(earlier, wind, false, stretches) + crossing(later, wind, true, stretches)) / clouds;
  };
  if (clouds == 0 || leaving(1) <= kMostLeaving) return 1;
  for (const int stretches : {2, 3, 4, 6})
    if (leaving(stretches) <= kLeavingOfStretch) return stretches;
  return kMostStretches;
}

std::vector<SkyBetween> skiesBetween(const CloudsOfTime& earlier, const CloudsOfTime& later, const glm::dvec2& wayOfPattern,
                                     int stretches) {
  std::vector<SkyBetween> skies;
  for (int i = 1; i < stretches; ++i) {
    SkyBetween sky;
    sky.share = static_cast<double>(i) / stretches;
    sky.clouds.lower = earlier.lower, sky.clouds.upper = earlier.upper;
    for (std::uint32_t cloud = 0; cloud < earlier.clouds.size(); ++cloud)
      if (earlier.turns[cloud] >= sky.share) take(earlier, cloud, false, sky.share * wayOfPattern, sky);
    for (std::uint32_t cloud = 0; cloud < later.clouds.size(); ++cloud)
      if (later.turns[cloud] < sky.share) take(later, cloud, true, (sky.share - 1) * wayOfPattern, sky);
    skies.push_back(std::move(sky));
  }
  return skies;
}

}  // namespace cloudgen::pipeline
