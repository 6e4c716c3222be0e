// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"

namespace cloudgen::writer {

/// The measures of a scene that viewpoints, ground and levels of detail are fitted to. Metres, scene frame.
struct Stage {
  glm::vec3 lower{0}, upper{0};       ///< box around ground and clouds
  float extent = 0;                   ///< longer horizontal side of the box
  float cloudWidth = 0;               ///< mean width of the clouds, weighted by their width
  glm::vec3 focus{0};                 ///< the middle of the clouds where they are densest (at first)
  float focusBase = 0, focusTop = 0;  ///< mean base and greatest top there
};

Stage stageOf(const scene::Scene& scene);

/// Side of the tiles: at most 8 by 8 of them, none smaller than a few clouds.
float tileSide(const Stage& stage);

}  // namespace cloudgen::writer
