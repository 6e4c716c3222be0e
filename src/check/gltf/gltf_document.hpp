// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "base/progress.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

using Json = nlohmann::json;

/// Checks the parts of a glTF document against each other and against the bytes of its first buffer. Rules:
/// gltf-asset, gltf-reference, gltf-buffer, gltf-buffer-view, gltf-accessor, gltf-index-range, gltf-position,
/// gltf-attribute, gltf-extension.
void checkGltfDocument(const Json& document, std::string_view binary, bool hasBinary, FindingList& findings,
                       const base::Progress& progress);

}  // namespace cloudgen::check
