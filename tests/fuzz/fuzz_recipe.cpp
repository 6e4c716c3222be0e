// SPDX-License-Identifier: Apache-2.0
// Whatever the text is: it is a recipe or an InputError.
#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "shape/recipe.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    cloudgen::shape::recipeFromJson(std::string(reinterpret_cast<const char*>(data), size), "fuzz.json");
  } catch (const cloudgen::base::InputError&) {
  }
  return 0;
}
