// SPDX-License-Identifier: Apache-2.0
// Any bytes given as a GRIB file are read or refused with an InputError.
// An input is used twice: as it is, and as a patch on a small good file that ecCodes makes here, so that
// the fuzzer starts deep inside the format without a corpus of model output.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "field/collect.hpp"
#include "input/grib/grib.hpp"
#include "support/made_grib.hpp"

namespace {

using namespace cloudgen;

/// Two levels with all that a cloud needs.
std::string goodFile(int edition, const char* packing) {
  using test::Variable;
  std::string bytes;
  for (const int level : {850, 700}) {
    test::GribField field{edition, level};
    field.packing = packing;
    if (level == 700) field.missing = {2};
    bytes += test::made(field.with(Variable::CloudWater, [](int i) { return i * 1e-4; }));
    bytes += test::made(field.with(Variable::Temperature, [&](int i) { return 190.0 + i + level / 10.0; }));
    bytes += test::made(field.with(Variable::Height, [&](int i) { return 9000.0 + i - 8.8 * level; }));
    bytes += test::made(field.with(Variable::Humidity, [](int i) { return 80 + i; }));
  }
  return bytes;
}

void readAll(const std::string& bytes) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("cloudgen-fuzz-" + std::to_string(::getpid()) + ".grib");
  static const bool removedAtExit = std::atexit([] { std::filesystem::remove(file); }) == 0;
  (void)removedAtExit;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  try {
    const auto source = input::openGrib({file}, {});
    const field::Grid& grid = source->grid();
    if (grid.size() > 100000) return;
    const auto cells = field::cellsTouching(grid, field::extent(grid));
    for (const field::CloudCell& cell : field::collectColumns(*source, cells).cells) {
      const float extinction = cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter;
      if (!(cell.topMeters > cell.baseMeters) || !(cell.fraction > 0 && cell.fraction <= 1) ||
          !(extinction >= 0) || !std::isfinite(extinction))
        __builtin_trap();
    }
  } catch (const base::InputError&) {
  }
}

/// Overwrites bytes of a good file: each four bytes of the input are a place (three) and a value (one).
std::string patched(std::string bytes, const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i + 3 < size; i += 4)
    bytes[(data[i] | data[i + 1] << 8 | data[i + 2] << 16) % bytes.size()] = static_cast<char>(data[i + 3]);
  return bytes;
}

}  // namespace

/// ecCodes itself leaks a little on some damaged messages.
extern "C" const char* __lsan_default_suppressions() { return "leak:libeccodes"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The order is part of the seeds: add at the end.
  static const std::string good[] = {goodFile(1, "grid_simple"),
                                     goodFile(2, "grid_simple"),
                                     goodFile(2, "grid_complex"),
                                     goodFile(2, "grid_complex_spatial_differencing"),
                                     goodFile(2, "grid_jpeg"),
                                     goodFile(2, "grid_ccsds"),
                                     goodFile(2, "grid_ieee"),
                                     goodFile(1, "grid_second_order"),
                                     goodFile(1, "grid_second_order_no_SPD"),
                                     goodFile(1, "grid_second_order_boustrophedonic")};
  readAll(std::string(reinterpret_cast<const char*>(data), size));
  if (size > 0 && size <= 256) readAll(patched(good[data[0] % std::size(good)], data + 1, size - 1));
  return 0;
}
