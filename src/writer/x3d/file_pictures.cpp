// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/file_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "base/thread.hpp"

namespace cloudgen::writer {
namespace {

constexpr float kLeastFlatSide = 50000, kFlatness = 10;
constexpr int kSheetPixels = 256;  ///< of at most kFineSheets, else half
constexpr std::size_t kFineSheets = 64;

constexpr double kSquares = 2.5;  ///< that the pictures of a cloud fill, about

}  // namespace

bool isFlat(const TileNode& tile) {
  return tile.side > std::max(kLeastFlatSide, kFlatness * (tile.upper.y - tile.lower.y));
}

FilePictures::FilePictures(const scene::Scene& scene, const std::vector<const TileNode*>& squares,
                           const PictureSize& size, std::string name)
    : scene_(scene), name_(std::move(name)) {
  std::vector<std::pair<const TileNode*, Sheet*>> flat;
  std::set<std::uint32_t> lit;
  for (const TileNode* tile : squares) {
    if (isFlat(*tile)) {
      flat.emplace_back(tile, &sheets_[tile]);
      continue;
    }
    for (const std::uint32_t i : tile->instances) lit.insert(scene.instances[i].lit);
  }
  const int sheetPixels = flat.size() <= kFineSheets ? kSheetPixels : kSheetPixels / 2;
  base::parallelFor(flat.size(), [&](std::size_t i) {
    *flat[i].second = sheetOf(scene, flat[i].first->instances, sheetPixels);
  });
  paintClouds(lit, size);

  std::vector<const image::ByteImage*> images;
  for (const auto& [tile, sheet] : flat) {
    sheetPlaces_[tile] = images.size();
    images.push_back(&sheet->picture.image);
  }
  for (auto& [index, cloud] : clouds_) {
    cloud.first = images.size();
    for (const auto* some : {&cloud.pictures.level, &cloud.pictures.upright})
      for (const CloudPicture& one : *some) images.push_back(&one.picture.image);
  }
  isEmpty_ = images.empty();
  atlas_.emplace(images);
}

void FilePictures::paintClouds(const std::set<std::uint32_t>& lit, const PictureSize& size) {
  std::vector<Cloud*> clouds;
  for (const std::uint32_t index : lit) {
    Cloud& cloud = clouds_[index];
    cloud.lit = index;
    clouds.push_back(&cloud);
  }
  const int each = pixelsOfEach(clouds.size(), kSquares, size);
  base::parallelFor(clouds.size(),
                    [&](std::size_t i) { clouds[i]->pictures = picturesOf(scene_, clouds[i]->lit, each); });
}

void FilePictures::writeSquare(QuadShapes& shapes, const TileNode& tile) const {
  if (const auto sheet = sheets_.find(&tile); sheet != sheets_.end())
    return write(shapes, meshOf(sheet->second, *atlas_, sheetPlaces_.at(&tile)));
  QuadMesh mesh;
  for (const std::uint32_t i : tile.instances) {
    const scene::Instance& instance = scene_.instances[i];
    const Cloud& cloud = clouds_.at(instance.lit);
    const glm::vec3 tint = tintOf(scene_, instance.lit, instance.sunlight);
    appendQuads(cloud.pictures.level, *atlas_, cloud.first, instance.position, instance.scale, tint, mesh);
    appendQuads(cloud.pictures.upright, *atlas_, cloud.first + cloud.pictures.level.size(), instance.position,
                instance.scale, tint, mesh);
  }
  orderFaces(mesh, LevelFaces::First);
  write(shapes, mesh);
}

void FilePictures::write(QuadShapes& shapes, const QuadMesh& mesh) const {
  shapes.writePictures("Afar", name_, mesh);
}

void FilePictures::texture(const std::filesystem::path& folder) const {
  if (!isEmpty_) image::writePng(folder / "textures" / name_, atlas_->texture());
}

}  // namespace cloudgen::writer
