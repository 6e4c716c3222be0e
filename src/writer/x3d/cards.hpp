// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

enum class CardRange { Near, Far };

/// Writes clouds as crossed cards of their far puffs, in the scene frame: one Shape a genus. For near viewers
/// they have the depths of the clouds; from afar nobody tells where within a cloud a card lies.
void writeCards(QuadShapes& shapes, const scene::Scene& scene, std::span<const std::uint32_t> instances,
                CardRange range);

}  // namespace cloudgen::writer
