// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "image/sprite_atlas.hpp"
#include "scene/scene.hpp"

namespace cloudgen::writer {

/// The genera of the clouds that stand in the scene, in the order of the enumeration.
std::vector<base::Genus> generaOf(const scene::Scene& scene);

/// Makes `folder`/textures. Throws OutputError.
std::filesystem::path makeTexturesFolder(const std::filesystem::path& folder);

/// Copies the sprite atlases of the scene's genera into `folder`/textures and returns the atlases of all
/// genera. Throws InputError if the bundled textures are missing, OutputError if they cannot be copied.
std::vector<image::SpriteAtlas> copyTextures(const scene::Scene& scene, const std::filesystem::path& folder);

}  // namespace cloudgen::writer
