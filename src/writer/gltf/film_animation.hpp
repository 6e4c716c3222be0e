// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>

#include "writer/film/film.hpp"
#include "writer/gltf/glb_file.hpp"

namespace cloudgen::writer::gltf {

/// The one animation of a sky that moves, cloud after cloud.
class FilmAnimation {
 public:
  FilmAnimation(GlbFile& file, const Film& film);

  /// Moves and scales the node of a cloud.
  void move(std::uint32_t instance, int node);

 private:
  int timesOf(std::uint32_t firstKey, std::size_t count);

  GlbFile& file_;
  const Film& film_;
  std::map<std::pair<std::uint32_t, std::size_t>, int> times_;  ///< accessors, by first key and number of keys
};

}  // namespace cloudgen::writer::gltf
