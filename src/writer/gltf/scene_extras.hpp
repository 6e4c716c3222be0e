// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.hpp"

namespace cloudgen::writer::gltf {

/// What a reader of the file must know about the scene, for asset.extras: source, valid time, box, frame,
/// seed, sun. 64-bit integers are texts, because JSON readers keep 53 bits of a number.
/// The lattice of heights, for readers of the file that draw the ground.
nlohmann::json terrainExtras(const base::HeightField& terrain);

nlohmann::json sceneExtras(const scene::Scene& scene);

/// Three numbers as a JSON array.
nlohmann::json arrayOf(glm::dvec3 values);

}  // namespace cloudgen::writer::gltf
