// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace cloudgen::base {

/// The folder that holds templates/, textures/ and schemas/: $CLOUDGEN_DATA, else ../share/cloudgen beside
/// the program, else the source tree it was built from. Throws InputError if none of them is there.
std::filesystem::path dataDir();

/// The folder of the bundled web viewer (viewer.html), which only builds with npm have; empty if it was not
/// built.
std::filesystem::path viewerDir();

}  // namespace cloudgen::base
