// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/turning_pictures.hpp"

#include <cmath>

#include "base/thread.hpp"
#include "writer/x3d/picture_quads.hpp"
#include "writer/x3d/shades.hpp"

namespace cloudgen::writer {
namespace {

constexpr PictureSize kSize{4e6, 256};
constexpr double kSquares = 1;  ///< that the pictures of a cloud fill, about

void tint(image::ByteImage& image, const glm::vec3& by) {
  for (std::size_t i = 0; i < image.bytes.size(); ++i)
    if (const auto channel = static_cast<int>(i % 4); channel < 3)
      image.bytes[i] = static_cast<unsigned char>(std::lround(by[channel] * static_cast<float>(image.bytes[i])));
}

}  // namespace

TurningPictures::TurningPictures(const scene::Scene& scene, std::span<const std::uint32_t> instances,
                                 std::string name)
    : scene_(scene), name_(std::move(name)) {
  std::map<std::uint32_t, std::uint32_t> litOf;  // the first of each archetype
  std::vector<std::pair<const Look, Whole>*> looks;
  for (const std::uint32_t i : instances) {
    const scene::Instance& instance = scene.instances[i];
    litOf.try_emplace(lookOf(instance).first, instance.lit);
    if (const auto [look, isNew] = wholes_.try_emplace(lookOf(instance)); isNew) looks.push_back(&*look);
  }
  const int pixels = pixelsOfEach(looks.size(), kSquares, kSize);
  base::parallelFor(looks.size(), [&](std::size_t i) {
    auto& [look, whole] = *looks[i];
    const std::uint32_t lit = litOf.at(look.first);
    whole.near = nearPicturesOf(scene, lit, pixels);
    for (CloudPicture& one : whole.near.pictures)
      tint(one.picture.image, tintOf(scene, lit, sunlightIn(look.second)));
  });
  std::vector<const image::ByteImage*> images;
  for (auto& [look, whole] : wholes_) {
    whole.first = images.size();
    for (const CloudPicture& one : whole.near.pictures) images.push_back(&one.picture.image);
  }
  if (!images.empty()) atlas_.emplace(images);
}

TurningPictures::Look TurningPictures::lookOf(const scene::Instance& instance) const {
  return {scene_.lit[instance.lit].archetype, shadeOf(instance)};
}

void TurningPictures::write(NodeWriter& nodes, QuadShapes& shapes, const scene::Instance& instance) {
  const Look look = lookOf(instance);
  Whole& whole = wholes_.at(look);
  const std::string name = fmt::format("Picture_{}_shade{}", look.first, look.second);
  if (whole.isDefined) return nodes.use("Group", "children", name);
  whole.isDefined = true;

  const glm::vec3 middle = whole.near.turns ? middleOf(whole.near.pictures.front()) : glm::vec3(0);
  QuadMesh mesh;
  appendQuads(whole.near.pictures, *atlas_, whole.first, -middle, 1, glm::vec3(1), mesh);
  nodes.open("Group", "children", name);
  if (whole.near.turns) {
    nodes.open("Transform");
    nodes.vector("translation", middle, 1);
    nodes.open("Billboard");
    nodes.vector("axisOfRotation", glm::vec3(0), 0);
  }
  shapes.writePictures("Clouds", name_, mesh);
  if (whole.near.turns) {
    nodes.close();
    nodes.close();
  }
  nodes.close();
}

void TurningPictures::texture(const std::filesystem::path& folder) const {
  if (atlas_) image::writePng(folder / "textures" / name_, atlas_->texture());
}

}  // namespace cloudgen::writer
