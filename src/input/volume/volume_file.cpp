// SPDX-License-Identifier: Apache-2.0
#include "input/volume/volume_file.hpp"

#include <array>

#include "base/error.hpp"
#include "base/file.hpp"

namespace cloudgen::input {
namespace {

constexpr std::array<std::string_view, 4> kExtensions{".vdb", ".nc", ".nc4", ".cdf"};

}  // namespace

bool isVolumeFile(const std::filesystem::path& file) { return base::hasExtension(file, kExtensions); }

base::Volume readVolume(const std::filesystem::path& file, const std::string& variable, bool zUp) {
  if (!std::filesystem::is_regular_file(file))
    throw base::InputError(file.string(), "is not there, or is no file", "check the path");
  base::Volume volume =
      base::hasExtension(file, ".vdb") ? readVdb(file, variable, zUp) : readNetcdfVolume(file, variable);
  if (std::none_of(volume.extinction.begin(), volume.extinction.end(), [](float value) { return value > 0; }))
    throw base::InputError(file.string(), "has no cloud in it", "name another variable or file");
  return volume;
}

}  // namespace cloudgen::input
