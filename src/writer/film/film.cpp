// SPDX-License-Identifier: Apache-2.0
#include "writer/film/film.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace cloudgen::writer {
namespace {

/// Of a cloud's size, what is shown of it at a presence: all from a half on, nothing to a quarter, and between them as
/// much of its area as goes evenly.
float shown(float presence) { return std::sqrt(std::clamp(4 * presence - 1, 0.0f, 1.0f)); }

}  // namespace

double Film::secondsAt(std::uint32_t key) const {
  return (scene_.keySeconds[key] - scene_.keySeconds.front()) / 3600 * kFilmSecondsPerHour;
}

double Film::shareAt(std::uint32_t key) const { return secondsAt(key) / seconds(); }

Track Film::trackOf(std::uint32_t i) const {
  const scene::Instance& cloud = scene_.instances[i];
  const scene::Motion& motion = scene_.motions[i];
  Track track{motion.firstKey, {}, {}};
  for (const scene::Moment& moment : motion.moments) {
    track.places.push_back(cloud.position + moment.shift);
    track.scales.push_back(cloud.scale * moment.growth * shown(moment.presence));
  }
  return track;
}

bool Film::isThereAtFirst(std::uint32_t i) const {
  if (!moves()) return true;
  const scene::Motion& motion = scene_.motions[i];
  return motion.firstKey == 0 && motion.moments.front().presence > 0;
}

double Film::cloudsAtOnce() const {
  if (!moves()) return static_cast<double>(scene_.instances.size());
  double intervals = 0;
  for (const scene::Motion& motion : scene_.motions) intervals += static_cast<double>(motion.moments.size()) - 1;
  return intervals / lastKey();
}

std::string Film::description() const {
  return fmt::format("{} seconds an hour of the forecast, {} hours from {}", base::shortest(kFilmSecondsPerHour),
                     base::shortest(hours()), base::isoText(scene_.validTime));
}

}  // namespace cloudgen::writer
