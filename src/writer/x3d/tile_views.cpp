// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/tile_views.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "light/color.hpp"
#include "light/shade.hpp"
#include "writer/copy_textures.hpp"
#include "writer/x3d/cards.hpp"
#include "writer/x3d/picture_atlas.hpp"

namespace cloudgen::writer {
namespace {

/// So far that a sphere about a point there is a plane: a LOD with this range tells on which side of its
/// middle the viewer is.
constexpr float kFarMeters = 1e6f;

/// The pictures of the lit archetypes of a tile, kViews each.
struct Pictures {
  std::map<std::uint32_t, std::size_t> first;  ///< of a lit archetype, among all
  std::vector<CardPicture> all;
};

bool turnsToViewer(const std::vector<CloudPart>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const CloudPart& part) { return part.turns; });
}

/// A cloud's picture where it stands, through the middle of the cloud.
Quad cardOf(const scene::Instance& instance, const glm::vec3& middle, const CardPicture& picture,
            const ViewAxes& axes, const glm::vec4& box, const glm::vec3& color) {
  const glm::vec2 at = 0.5f * (picture.lower + picture.upper), half = 0.5f * (picture.upper - picture.lower);
  Quad quad;
  const glm::vec3 inPlane = instance.position + instance.scale * (at.x * axes.x + at.y * axes.y);
  quad.center = inPlane + glm::dot(middle - inPlane, axes.z) * axes.z;
  quad.right = instance.scale * half.x * axes.x;
  quad.up = instance.scale * half.y * axes.y;
  quad.textureBox = box;
  quad.color = glm::vec4(color, 1);
  return quad;
}

class Sides {
 public:
  Sides(NodeWriter& nodes, QuadShapes& shapes, const TileNode& tile, const TileViews& views)
      : nodes_(nodes), shapes_(shapes), middle_(tile.middle()), name_(tile.name), views_(views) {}

  /// One of `count` azimuths from the first, halved by the plane between them; from high above the top.
  void write(int first, int count) {
    constexpr float kStep = 360.0f / kAzimuths;
    if (count > 1) {
      const float between = kStep * (static_cast<float>(first) + 0.5f * static_cast<float>(count - 1));
      openChoice(between - 90, 0);
      write(first, count / 2);
      write(first + count / 2, count / 2);
    } else {
      constexpr float kHighDegrees = 50;
      openChoice(kStep * static_cast<float>(first) + 180, 90 - kHighDegrees);
      if (first == 0)
        side(kFromAbove, "Top_" + name_);
      else
        nodes_.use("Group", "children", "Top_" + name_);
      side(first, {});
    }
    nodes_.close();
  }

 private:
  /// A LOD with two levels: for viewers on the side of the middle that lies in a direction, and the others.
  void openChoice(float azimuthDegrees, float elevationDegrees) {
    constexpr float kDegree = std::numbers::pi_v<float> / 180;
    const float azimuth = azimuthDegrees * kDegree, elevation = elevationDegrees * kDegree;
    const glm::vec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                              -std::cos(elevation) * std::cos(azimuth));
    nodes_.open("LOD");
    nodes_.vector("center", middle_ + kFarMeters * direction, 0);
    nodes_.numbers("range", std::array{kFarMeters}, 1, 0);
  }

  void side(int view, const std::string& def) {
    const QuadMesh& mesh = views_.sides[static_cast<std::size_t>(view)];
    const bool isOneShape = def.empty() && !mesh.faces.empty() && mesh.faces.size() <= kFacesPerShape;
    if (!isOneShape) nodes_.open("Group", "children", def);
    shapes_.writePictures(name_, views_.texture, mesh);
    if (!isOneShape) nodes_.close();
  }

  NodeWriter& nodes_;
  QuadShapes& shapes_;
  glm::vec3 middle_;
  std::string name_;
  const TileViews& views_;
};

}  // namespace

SpriteSheets::SpriteSheets(const scene::Scene& scene, const std::vector<image::SpriteAtlas>& atlases,
                           const std::filesystem::path& textures) {
  for (const base::Genus genus : generaOf(scene))
    sheets_.emplace(genus, SpriteSheet(image::readPng(textures / image::atlasOf(atlases, genus).file)));
}

TileViews drawViews(const scene::Scene& scene, const TileNode& tile, float metersPerPixel,
                    const std::vector<image::SpriteAtlas>& atlases, const SpriteSheets& sprites,
                    const std::filesystem::path& textures) {
  TileViews views;
  Pictures pictures;
  std::vector<std::uint32_t> pictured;
  for (const std::uint32_t i : tile.instances) {
    const scene::Instance& instance = scene.instances[i];
    if (const auto [known, isNew] = pictures.first.try_emplace(instance.lit, SIZE_MAX); isNew) {
      const base::Genus genus = scene.archetypes[scene.lit[instance.lit].archetype].genus;
      const image::SpriteAtlas& atlas = image::atlasOf(atlases, genus);
      const auto parts = fullParts(scene, instance.lit, 1, atlas);
      if (turnsToViewer(parts)) {
        known->second = pictures.all.size();
        for (int view = 0; view < kViews; ++view)
          pictures.all.push_back(pictureOf(parts, sprites.of(genus),
                                           sprites.of(genus).width() / atlas.columns, viewAxes(view),
                                           metersPerPixel / instance.scale));
      }
    }
    (pictures.first.at(instance.lit) == SIZE_MAX ? views.others : pictured).push_back(i);
  }
  if (pictured.empty()) return views;

  const PictureAtlas atlas = packed(pictures.all);
  views.texture = fmt::format("tile_{}.png", tile.name);
  image::writePng(textures / views.texture, atlas.pixels, image::PngEffort::Quick);
  for (int view = 0; view < kViews; ++view) {
    const ViewAxes axes = viewAxes(view);
    std::vector<Quad> cards;
    for (const std::uint32_t i : pictured) {
      const scene::Instance& instance = scene.instances[i];
      const std::size_t at = pictures.first.at(instance.lit) + static_cast<std::size_t>(view);
      if (pictures.all[at].pixels.bytes.empty()) continue;
      const glm::vec3 color =
          light::srgbFromLinear(light::dimming(instance.sunlight, scene.sun.color, scene.sky));
      const shape::Bounds box = scene::boundsOf(scene, instance);
      cards.push_back(
          cardOf(instance, 0.5f * (box.lower + box.upper), pictures.all[at], axes, atlas.boxes[at], color));
    }
    std::stable_sort(cards.begin(), cards.end(), [&](const Quad& a, const Quad& b) {
      return glm::dot(a.center, axes.z) < glm::dot(b.center, axes.z);
    });
    QuadMesh& mesh = views.sides[static_cast<std::size_t>(view)];
    for (const Quad& card : cards) {
      mesh.faces.push_back(static_cast<std::uint32_t>(2 * mesh.quads.size()));
      mesh.quads.push_back(card);
    }
  }
  return views;
}

void writeViews(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const TileNode& tile,
                const TileViews& views) {
  if (!views.texture.empty()) Sides(nodes, shapes, tile, views).write(0, kAzimuths);
  writeCards(shapes, scene, views.others, CardRange::Far);
}

}  // namespace cloudgen::writer
