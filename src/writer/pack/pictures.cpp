// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/pictures.hpp"

#include "base/data_dir.hpp"
#include "base/file.hpp"
#include "image/picture.hpp"
#include "image/sprite_atlas.hpp"
#include "image/sprite_bake.hpp"
#include "writer/copy_textures.hpp"

namespace cloudgen::writer::packed {
namespace {

/// Each pixel the mean of four.
image::ByteImage halved(const image::ByteImage& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  image::ByteImage half{image.width / 2, image.height / 2, image.channels, {}};
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < channels; ++c) {
        int sum = 2;
        for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
          sum += image.bytes[channels * static_cast<std::size_t>((2 * y + dy) * image.width + 2 * x + dx) + c];
        half.bytes.push_back(static_cast<unsigned char>(sum / 4));
      }
  return half;
}

}  // namespace

std::vector<Pictures> picturesOf(const scene::Scene& scene, const base::Progress& progress) {
  const auto folder = base::dataDir() / "textures";
  const auto atlases = image::readSpriteManifest(folder);
  const auto genera = generaOf(scene);
  std::vector<Pictures> pictures;
  for (const base::Genus genus : genera) {
    progress.step("pack: light maps", static_cast<double>(pictures.size()) / static_cast<double>(genera.size()));
    const image::SpriteAtlas& atlas = image::atlasOf(atlases, genus);
    const image::SpriteSheets sheets = image::bakeSprites(genus, true);
    pictures.push_back({genus, atlas.columns, atlas.rows, base::readFile(folder / atlas.file),
                        image::pngBytes(halved(sheets.maps->sixwayA)),
                        image::pngBytes(halved(sheets.maps->sixwayB))});
  }
  return pictures;
}

}  // namespace cloudgen::writer::packed
