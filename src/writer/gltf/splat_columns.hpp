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

/// What whole numbers of quantised splats stand for: metres a unit, from a corner. It is a node's to undo.
struct SplatUnit {
  glm::vec3 lower{0};
  float meters = 1;
};

/// The finest unit in which places fit into unsigned and deviations into signed shorts.
SplatUnit unitOf(const SplatSource& source);

/// _OPTICAL_DEPTH of quantised splats counts in these.
inline constexpr float kOpticalDepthStep = 1.0f / 64;

/// The same, quantised (KHR_mesh_quantization): places, deviations and opacities in shorts, rotations in bytes.
/// Harmonics are floats, as the extension wants them. 32 bytes a splat in all, and 36 and 60 more for the degrees 1
/// and 2, in records; no COLOR_0.
Attributes addQuantizedSplats(GlbFile& file, SplatSource source, glm::vec3 sunDirection, int degree,
                              const SplatUnit& unit);

}  // namespace cloudgen::writer::gltf
