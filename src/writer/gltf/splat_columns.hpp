// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "writer/gltf/glb_file.hpp"
#include "writer/gltf/splat.hpp"
#include "writer/gltf/splat_source.hpp"

namespace cloudgen::writer::gltf {

inline constexpr const char* kSplatting = "KHR_gaussian_splatting";

/// What a primitive of splats says beside its columns: kernel, colour space, projection, order.
const nlohmann::json& splattingExtension();

/// Adds the columns of KHR_gaussian_splatting as floats, harmonics up to `degree` (0 to 2), and COLOR_0 for
/// viewers that draw points: 60 bytes a splat, and 36 and 60 more for the degrees 1 and 2. Where a splat is
/// denser than its opacity tells, _OPTICAL_DEPTH of all follows. The source must outlive the file.
Attributes addSplats(GlbFile& file, SplatSource source, glm::vec3 sunDirection, int degree);

}  // namespace cloudgen::writer::gltf
