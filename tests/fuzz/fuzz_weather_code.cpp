// SPDX-License-Identifier: Apache-2.0
// Any text given as weather codes is read or refused with an InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/error.hpp"
#include "input/weather_code/weather_code.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cloudgen;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  input::isWeatherCode(text);
  try {
    input::OpenOptions options;
    options.place = input::Place{24.9, 60.2, {}};
    const auto sky = input::skyOfPlaces(input::readForecaJson(text, "fuzz.json"), {"fuzz.json"}, options);
    const auto cells = field::cellsTouching(sky->grid(), field::extent(sky->grid()));
    if (sky->surface(cells).heightMeters.size() != cells.size()) __builtin_trap();
    sky->visitLayers(cells, [](const field::StatedLayer& layer) {
      if (!(layer.topMeters > layer.baseMeters) || !(layer.coverFraction > 0 && layer.coverFraction <= 1) ||
          !(layer.opticalDepth > 0 && layer.opticalDepth < 1000) || layer.cloudCount < 0)
        __builtin_trap();
    });
  } catch (const base::InputError&) {
  }
  return 0;
}
