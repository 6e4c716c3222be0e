// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "writer/format.hpp"
#include "writer/pack/pictures.hpp"

namespace cloudgen::writer {

/// Writes scene.cgpack, as schemas/runtime_pack.fbs says. Throws OutputError, also for a scene with more
/// archetypes than the format can number (65,535).
void writePack(const scene::Scene& scene, const Destination& destination);

/// The bytes of the file, with these sprites: one set a genus of the scene's archetypes.
std::string packBytes(const scene::Scene& scene, std::span<const packed::Pictures> pictures);

}  // namespace cloudgen::writer
