// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/format.hpp"

namespace cloudgen::writer {

/// Writes scene.splats.ply: the splats of scene.splats.glb as the tools for captured scenes read them (Kerbl et
/// al. 2023), binary little-endian: places in metres of the scene frame (y up), harmonics channel by channel,
/// opacity as its logit, deviations as their natural logarithms, rotation as w x y z. Throws OutputError.
void writePly(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
