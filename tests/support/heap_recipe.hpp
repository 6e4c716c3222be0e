// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cloudgen::test {

/// A whole recipe of its own, so that tests do not hang on the numbers of the shipped ones.
inline constexpr const char* kHeapRecipe = R"({
  "description": "heaps of the tests",
  "genus": "Cu",
  "form": "heap",
  "sections": {"count": 14, "coordinate_system": "half_spherical", "placement": "uniform", "radius": 0.2},
  "billboards": {"count": 8, "coordinate_system": "spherical", "size": 0.3, "flattening": 0.9},
  "width_m": [500, 4000],
  "thickness_m": [250, 5000],
  "optical_depth": 30,
  "sheet": false,
  "raggedness": 0.45
})";

/// It with one piece of its text exchanged; an empty text if the piece is not in it.
inline std::string heapRecipeWith(const std::string& what, const std::string& with) {
  std::string text = kHeapRecipe;
  const std::size_t at = text.find(what);
  return at == std::string::npos ? std::string() : text.replace(at, what.size(), with);
}

}  // namespace cloudgen::test
