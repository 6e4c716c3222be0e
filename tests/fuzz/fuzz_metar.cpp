// SPDX-License-Identifier: Apache-2.0
// Any text given as METAR reports, or as a table of stations, is read or refused with an InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "input/metar/metar.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cloudgen;
  const std::string text(reinterpret_cast<const char*>(data), size);
  input::isMetar(text);
  input::StationTable stations;
  try {
    input::addStations(stations, text, "stations.csv");
  } catch (const base::InputError&) {
  }
  stations.clear();
  input::addStations(stations,
                     "KMIA,25.79,-80.32,2\nKAMW,41.99,-93.62,\nNZSP,-90,0,2835\nNFFN,-17.8,177.4,18\n",
                     "stations.csv");
  try {
    const auto sky = input::skyOfMetars({{"metar.txt", text}}, stations, {});
    const auto cells = field::cellsTouching(sky->grid(), field::extent(sky->grid()));
    if (sky->surface(cells).heightMeters.size() != cells.size()) __builtin_trap();
    sky->visitLayers(cells, [](const field::StatedLayer& layer) {
      if (!(layer.topMeters > layer.baseMeters) || !(layer.coverFraction > 0 && layer.coverFraction <= 1) ||
          !(layer.opticalDepth > 0 && layer.opticalDepth < 1000))
        __builtin_trap();
    });
  } catch (const base::InputError&) {
  }
  return 0;
}
