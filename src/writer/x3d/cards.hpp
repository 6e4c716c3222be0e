// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {

enum class CardRange { Near, Far };

/// Writes clouds as crossed cards, in the scene frame: one Shape a genus. Those that `isParted` names are
/// their far puffs, the others one puff. For near viewers they have the depths of the clouds; from afar
/// nobody tells how dense a cloud is, or where within it: fewer quads to blend.
void writeCards(QuadShapes& shapes, const scene::Scene& scene, std::span<const std::uint32_t> instances,
                const std::vector<bool>& isParted, CardRange range);

}  // namespace cloudgen::writer
