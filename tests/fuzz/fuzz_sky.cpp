// SPDX-License-Identifier: Apache-2.0
// Any text given as a described sky is read or refused with an InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/error.hpp"
#include "input/described/described.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cloudgen;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto sky = input::readDescribedSky(text, "fuzz.sky.json");
    const auto cells = field::cellsTouching(sky->grid(), field::extent(sky->grid()));
    if (cells.size() != sky->grid().size()) __builtin_trap();
    const auto some = std::span(cells).first(std::min<std::size_t>(cells.size(), 100));
    sky->visitLayers(some, [](const field::StatedLayer& layer) {
      if (!(layer.topMeters > layer.baseMeters) || !(layer.coverFraction <= 1)) __builtin_trap();
    });
  } catch (const base::InputError&) {
  }
  return 0;
}
