// SPDX-License-Identifier: Apache-2.0
#include "writer/copy_textures.hpp"

#include <array>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

namespace cloudgen::writer {

std::vector<base::Genus> generaOf(const scene::Scene& scene) {
  std::array<bool, base::kGenusCount> present{};
  for (const scene::Instance& instance : scene.instances)
    present[static_cast<size_t>(scene.archetypes[scene.lit[instance.lit].archetype].genus)] = true;
  std::vector<base::Genus> genera;
  for (const base::Genus genus : base::allGenera())
    if (present[static_cast<size_t>(genus)]) genera.push_back(genus);
  return genera;
}

std::filesystem::path makeTexturesFolder(const std::filesystem::path& folder) {
  const auto textures = folder / "textures";
  std::error_code error;
  std::filesystem::create_directories(textures, error);
  if (error)
    throw base::OutputError(textures.string(), "cannot be made: " + error.message(), "check the output folder");
  return textures;
}

std::vector<image::SpriteAtlas> copyTextures(const scene::Scene& scene, const std::filesystem::path& folder) {
  const auto from = base::dataDir() / "textures";
  const auto atlases = image::readSpriteManifest(from);
  const auto to = makeTexturesFolder(folder);
  for (const base::Genus genus : generaOf(scene)) {
    const std::string& name = image::atlasOf(atlases, genus).file;
    base::writeFile(to / name, base::readFile(from / name));
  }
  return atlases;
}

}  // namespace cloudgen::writer
