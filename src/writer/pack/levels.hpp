// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace cloudgen::writer::packed {

/// An archetype in less and less detail.
struct Level {
  std::vector<shape::Puff> puffs;
  std::vector<light::PuffResponse> responses;  ///< one a puff
  float errorMeters = 0;  ///< root mean square, along an axis, of the way from a puff of the first level to the
                          ///< one that stands for it, by extinction
};

/// From all puffs to one: all (each as wide as it must be to be blended), a quarter of them (where that is more than what comes next), the archetype's far
/// puffs, its one puff. Errors rise; levels of the same number of puffs are left out.
std::vector<Level> levelsOf(const scene::Archetype& archetype);

}  // namespace cloudgen::writer::packed
