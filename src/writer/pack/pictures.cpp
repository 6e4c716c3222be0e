// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/pictures.hpp"

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "image/sprite_atlas.hpp"
#include "writer/copy_textures.hpp"

namespace cloudgen::writer::packed {

std::vector<Pictures> picturesOf(const scene::Scene& scene) {
  const auto folder = base::dataDir() / "textures";
  const auto atlases = image::readSpriteManifest(folder);
  std::vector<Pictures> pictures;
  for (const base::Genus genus : generaOf(scene)) {
    const image::SpriteAtlas& atlas = image::atlasOf(atlases, genus);
    if (atlas.sixwayA.empty() || atlas.sixwayB.empty())
      throw base::InputError((folder / "manifest.json").string(), fmt::format("names no light maps of {}", atlas.file),
                             "make the set again with: cloudgen textures -o textures");
    pictures.push_back({genus, atlas.columns, atlas.rows, base::readFile(folder / atlas.file),
                        base::readFile(folder / atlas.sixwayA), base::readFile(folder / atlas.sixwayB)});
  }
  return pictures;
}

}  // namespace cloudgen::writer::packed
