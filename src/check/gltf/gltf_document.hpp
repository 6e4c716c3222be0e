// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// Checks a glTF document (JSON text): its parts against each other and against the bytes of its first
/// buffer. Rules: gltf-json, gltf-asset, gltf-reference, gltf-buffer, gltf-buffer-view, gltf-accessor,
/// gltf-index-range, gltf-position, gltf-attribute, gltf-extension, gltf-instancing, and those of
/// gltf_rules.hpp.
void checkGltfDocument(std::string_view json, std::string_view binary, bool hasBinary, FindingList& findings,
                       const base::Progress& progress);

}  // namespace cloudgen::check
