// SPDX-License-Identifier: Apache-2.0
// Any bytes given as a netCDF file are read or refused with an InputError.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "input/netcdf/netcdf.hpp"

namespace {

using namespace cloudgen;

const std::filesystem::path& scratchFile() {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("cloudgen-fuzz-" + std::to_string(::getpid()) + ".nc");
  static const bool removedAtExit = std::atexit([] { std::filesystem::remove(scratchFile()); }) == 0;
  (void)removedAtExit;
  return file;
}

void readAll(const std::filesystem::path& file) {
  try {
    const auto source = input::openNetcdf({file}, {});
    const field::Grid& grid = source->grid();
    if (grid.size() == 0) __builtin_trap();
    if (grid.size() > 10000) return;
    const auto cells = field::cellsTouching(grid, field::extent(grid));
    source->visitLevels(cells, [&](const field::Level& level) {
      for (const auto& [quantity, values] : level.values)
        if (values.size() != cells.size()) __builtin_trap();
    });
    source->surface(cells);
    source->visitLayers(cells, [](const field::StatedLayer&) {});
  } catch (const base::InputError&) {
  }
}

}  // namespace

/// HDF5 and netCDF-C themselves leak a little on some damaged files.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\nleak:libnetcdf"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!input::isNetcdf(bytes)) return 0;
  std::ofstream(scratchFile(), std::ios::binary | std::ios::trunc) << bytes;
  readAll(scratchFile());
  return 0;
}
