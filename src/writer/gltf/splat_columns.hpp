// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "writer/gltf/glb_file.hpp"
#include "writer/gltf/splat.hpp"

namespace cloudgen::writer::gltf {

inline constexpr const char* kSplatting = "KHR_gaussian_splatting";

/// What a primitive of splats says beside its columns: kernel, colour space, projection, order.
const nlohmann::json& splattingExtension();

/// Adds the columns of KHR_gaussian_splatting as floats, harmonics up to degree 1, and COLOR_0 for viewers
/// that draw points. Where a splat is denser than its opacity tells, _OPTICAL_DEPTH of all follows.
Attributes addSplats(GlbFile& file, std::span<const Splat> splats, glm::vec3 sunDirection);

}  // namespace cloudgen::writer::gltf
