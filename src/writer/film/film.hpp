// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cloudgen::writer {

/// How fast a sky that moves is played where a format has a speed of its own.
inline constexpr double kFilmSecondsPerHour = 10;

/// A cloud on its way, at the keys of the scene from `firstKey` on; before and after it is not there.
struct Track {
  std::uint32_t firstKey = 0;
  std::vector<glm::vec3> places;
  std::vector<float> scales;  ///< 0 where it is not there
};

/// A sky that moves as scene formats play it: they move and scale nodes, and share what is drawn of clouds, whose
/// opacity is that of their corners, so that no cloud can fade. It goes by size: who forms or dissolves grows or
/// shrinks as in the scene; of a pair, who comes grows within who goes, at one place, in the second quarter of their way
/// and the other shrinks in the third: what they cover stays, and only then is it up to twice as dense. At the times of
/// the forecast the sky is the scene's.
class Film {
 public:
  explicit Film(const scene::Scene& scene) : scene_(scene) {}

  bool moves() const { return !scene_.keySeconds.empty(); }
  /// How long it takes, of its own time.
  double seconds() const { return hours() * kFilmSecondsPerHour; }
  double secondsAt(std::uint32_t key) const;
  /// Of the whole film, 0 to 1.
  double shareAt(std::uint32_t key) const;
  std::uint32_t lastKey() const { return static_cast<std::uint32_t>(scene_.keySeconds.size() - 1); }
  Track trackOf(std::uint32_t instance) const;
  /// Whether a cloud is there as the film begins.
  bool isThereAtFirst(std::uint32_t instance) const;
  /// The clouds that are there at a time, in the mean; all of a sky that stands still.
  double cloudsAtOnce() const;
  /// "10 seconds an hour of the forecast, 3 hours from 2005-08-28T12:00:00Z".
  std::string description() const;

 private:
  double hours() const { return moves() ? (scene_.keySeconds.back() - scene_.keySeconds.front()) / 3600 : 0; }

  const scene::Scene& scene_;
};

}  // namespace cloudgen::writer
