// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/film_animation.hpp"

namespace cloudgen::writer::gltf {

FilmAnimation::FilmAnimation(GlbFile& file, const Film& film) : file_(file), film_(film) {
  if (film_.moves()) file_.nameAnimation(film_.description());
}

int FilmAnimation::timesOf(std::uint32_t firstKey, std::size_t count) {
  const auto [found, isNew] = times_.try_emplace({firstKey, count}, -1);
  if (isNew) {
    std::vector<float> seconds;
    for (std::uint32_t k = 0; k < count; ++k) seconds.push_back(static_cast<float>(film_.secondsAt(firstKey + k)));
    found->second = file_.addKeys(1, seconds);
  }
  return found->second;
}

void FilmAnimation::move(std::uint32_t instance, int node) {
  const Track track = film_.trackOf(instance);
  std::vector<float> places, scales;
  for (const glm::vec3& place : track.places) places.insert(places.end(), {place.x, place.y, place.z});
  for (const float scale : track.scales) scales.insert(scales.end(), 3, scale);
  const int times = timesOf(track.firstKey, track.places.size());
  file_.animate(node, "translation", times, file_.addKeys(3, places));
  file_.animate(node, "scale", times, file_.addKeys(3, scales));
}

}  // namespace cloudgen::writer::gltf
