// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"
#include "check/xsd/chosen_schema.hpp"

namespace cloudgen::check {

/// Checks a tileset.json of 3D Tiles 1.0 or 1.1 and what it names: members that the specification demands,
/// volumes inside those of their parents, falling geometric errors, contents that can be read, are sound
/// binary glTF, and lie inside their volumes. Files may be gzip. Rules: tiles-json, tiles-asset,
/// tiles-required, tiles-error, tiles-refine, tiles-volume, tiles-transform, tiles-content, tiles-path,
/// tiles-extension, tiles-metadata, and those of GLB files. The schema is not used. Implicit tiles and
/// contents that are no binary glTF are told (tiles-unread) and not looked into. Throws InputError if the
/// file cannot be read, InterruptedError on cancel.
ValidationResult validateTileset(const std::filesystem::path& file, const ChosenSchema& schema,
                                 const base::Progress& progress);

/// Hands over the bytes of a content by its path from the folder of the tileset. Throws InputError.
using ContentReader = std::function<std::string(const std::string& path)>;

/// The same for bytes in memory.
ValidationResult validateTilesetBytes(std::string_view bytes, const std::string& name,
                                      const ContentReader& contents, const base::Progress& progress = {});

}  // namespace cloudgen::check
