// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cloudgen::writer {

/// What the page holds beside the scene.
struct PageParts {
  std::uint64_t packBytes = 0;
  std::string packFile;      ///< to fetch; empty when the pack stands in the page
  std::string verification;  ///< what verify found, as JSON; empty if nobody looked
  struct Map {
    std::string name, file, png;  ///< "cover", where it lies beside the page, its bytes
  };
  std::vector<Map> maps;
};

/// What the page says about the scene (title, times, box, mapping, sun, counts by genus, how well it
/// shows its model), as JSON that is safe inside an HTML script element.
std::string pageData(const scene::Scene& scene, const PageParts& parts);

}  // namespace cloudgen::writer
