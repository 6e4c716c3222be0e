// SPDX-License-Identifier: Apache-2.0
// Any bytes given as an OpenVDB file or as a box of netCDF are read or refused with an InputError.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "input/netcdf/netcdf.hpp"
#include "input/volume/volume_file.hpp"

namespace {

using namespace cloudgen;

/// One file for each format, gone when the program ends.
const std::filesystem::path& scratchFile(bool isNetcdf) {
  static const std::string stem =
      std::filesystem::temp_directory_path() / ("cloudgen-fuzz-volume-" + std::to_string(::getpid()));
  static const std::filesystem::path files[2]{stem + ".vdb", stem + ".nc"};
  static const bool removedAtExit = std::atexit([] {
                                      for (const auto& file : files) std::filesystem::remove(file);
                                    }) == 0;
  (void)removedAtExit;
  return files[isNetcdf ? 1 : 0];
}

}  // namespace

/// Libraries that leak a little on some damaged files.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5\nleak:libnetcdf\nleak:libopenvdb";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto& file = scratchFile(input::isNetcdf(bytes));
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  try {
    const base::Volume volume = input::readVolume(file, "", false);
    if (volume.extinction.size() >
        static_cast<std::size_t>(volume.size.x) * static_cast<std::size_t>(volume.size.y * volume.size.z))
      __builtin_trap();
    for (const float value : volume.extinction)
      if (!std::isfinite(value) || value < 0) __builtin_trap();
  } catch (const base::InputError&) {
  }
  return 0;
}
