// SPDX-License-Identifier: Apache-2.0
#include "base/data_dir.hpp"

#include <array>
#include <cstdlib>

#include "base/error.hpp"

namespace cloudgen::base {
namespace fs = std::filesystem;

namespace {

fs::path besideProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "cloudgen";
}

}  // namespace

fs::path dataDir() {
  if (const char* chosen = std::getenv("CLOUDGEN_DATA")) {
    if (fs::is_directory(fs::path(chosen) / "templates")) return chosen;
    throw InputError(chosen, "has no templates folder",
                     "point CLOUDGEN_DATA at cloudgen's data folder, or unset it");
  }
  for (const fs::path& folder : {besideProgram(), fs::path(CLOUDGEN_SOURCE_DATA_DIR)})
    if (fs::is_directory(folder / "templates")) return folder;
  throw InputError("cloudgen", "cannot find its data folder (templates, textures, schemas)",
                   "set CLOUDGEN_DATA to it");
}

fs::path viewerDir() {
  for (const fs::path& folder : {dataDir() / "viewer", fs::path(CLOUDGEN_VIEWER_DIR)})
    if (fs::exists(folder / "viewer.html")) return folder;
  return {};
}

}  // namespace cloudgen::base
