// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace cloudgen::writer {

/// Where a writer puts its files, and whom it tells how far it is.
struct Destination {
  std::filesystem::path folder;  ///< exists; files of other formats may already be in it
  base::Progress progress;
  /// What verify found in the files that are already there, as schemas/verify.schema.json says; empty if
  /// nobody looked. Its maps are in verify/.
  std::string verification = {};
};

/// One output format. `write` throws OutputError; it writes only the named files (and textures/).
struct Format {
  std::string_view name, description;
  std::vector<std::string_view> files;
  void (*write)(const scene::Scene&, const Destination&);
  bool showsVerification = false;  ///< wants Destination::verification: written after the scene was verified
};

}  // namespace cloudgen::writer
