// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cloudgen::writer::packed {

/// The sprites of a genus as the PNG files that are bundled in textures/: colours, and six-way light maps at half
/// their resolution.
struct Pictures {
  base::Genus genus{};
  int columns = 1, rows = 1;
  std::string color, sixwayA, sixwayB;
};

/// One a genus of the scene's archetypes, in the order of the enumeration. Throws InputError if the bundled
/// textures are missing.
std::vector<Pictures> picturesOf(const scene::Scene& scene);

}  // namespace cloudgen::writer::packed
