// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {

/// Writes clouds as crossed cards with their depths, in the scene frame: one Shape a genus. Those that
/// `isParted` names are their far puffs, the others one puff.
void writeCards(QuadShapes& shapes, const scene::Scene& scene, std::span<const std::uint32_t> instances,
                const std::vector<bool>& isParted);

}  // namespace cloudgen::writer
