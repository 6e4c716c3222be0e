// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace cloudgen::writer::packed {

/// The sprites of a genus as PNG files: the colours as bundled in textures/, and the six-way light maps at half
/// their resolution (light is smooth).
struct Pictures {
  base::Genus genus{};
  int columns = 1, rows = 1;
  std::string color, sixwayA, sixwayB;
};

/// One a genus of the scene's archetypes, in the order of the enumeration. Throws InputError if the bundled
/// textures are missing.
std::vector<Pictures> picturesOf(const scene::Scene& scene, const base::Progress& progress);

}  // namespace cloudgen::writer::packed
