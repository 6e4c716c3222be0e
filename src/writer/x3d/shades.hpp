// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "scene/scene.hpp"

namespace cloudgen::writer {

/// Steps of shadow from other clouds, 0 in full sun: clouds of one step share what they are drawn with.
inline constexpr int kShades = 4;

inline int shadeOf(const scene::Instance& instance) {
  return static_cast<int>(std::lround((1 - instance.sunlight) * (kShades - 1)));
}

/// The share of the sun that a step leaves.
inline float sunlightIn(int shade) { return 1 - static_cast<float>(shade) / (kShades - 1); }

inline float sunlightOf(const scene::Instance& instance) { return sunlightIn(shadeOf(instance)); }

}  // namespace cloudgen::writer
