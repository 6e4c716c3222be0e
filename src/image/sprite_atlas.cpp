// SPDX-License-Identifier: Apache-2.0
#include "image/sprite_atlas.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"

namespace cloudgen::image {

glm::vec4 SpriteAtlas::textureBox(int tile) const {
  const float insetU = 0.5f / static_cast<float>(columns * tilePixels),
              insetV = 0.5f / static_cast<float>(rows * tilePixels);
  const float column = static_cast<float>(tile % columns), row = static_cast<float>(tile / columns);
  return {column / static_cast<float>(columns) + insetU, 1.0f - (row + 1) / static_cast<float>(rows) + insetV,
          (column + 1) / static_cast<float>(columns) - insetU,
          1.0f - row / static_cast<float>(rows) - insetV};
}

std::vector<SpriteAtlas> readSpriteManifest(const std::filesystem::path& texturesFolder) {
  const auto file = texturesFolder / "manifest.json";
  const auto fail = [&](const std::string& what) {
    throw base::InputError(file.string(), what,
                           "make the set again with: cloudgen textures -o " + texturesFolder.string());
  };
  std::vector<SpriteAtlas> atlases;
  try {
    const auto manifest = nlohmann::json::parse(base::readFile(file, 1 << 20));
    for (const auto& entry : manifest.at("atlases")) {
      SpriteAtlas atlas;
      const auto genus = base::genusFromName(entry.at("genus").get<std::string>());
      if (!genus) fail("names an unknown genus");
      atlas.genus = *genus;
      atlas.file = entry.at("file");
      atlas.sixwayA = entry.value("sixway_a", "");
      atlas.sixwayB = entry.value("sixway_b", "");
      atlas.columns = entry.at("columns");
      atlas.rows = entry.at("rows");
      atlas.tilePixels = entry.at("tile_pixels");
      const bool isElsewhere = (atlas.file + atlas.sixwayA + atlas.sixwayB).find_first_of("/\\") != std::string::npos;
      if (isElsewhere || atlas.columns < 1 || atlas.rows < 1 ||
          atlas.tilePixels < 2)
        fail("has an atlas with a bad file name or size");
      atlases.push_back(atlas);
    }
  } catch (const nlohmann::json::exception& error) {
    fail(std::string("is not a sprite manifest (") + error.what() + ")");
  }
  for (const auto genus : base::allGenera())
    if (std::none_of(atlases.begin(), atlases.end(), [&](const auto& a) { return a.genus == genus; }))
      fail("has no sprites for " + std::string(base::name(genus)));
  return atlases;
}

const SpriteAtlas& atlasOf(const std::vector<SpriteAtlas>& atlases, base::Genus genus) {
  return *std::find_if(atlases.begin(), atlases.end(),
                       [&](const auto& atlas) { return atlas.genus == genus; });
}

}  // namespace cloudgen::image
