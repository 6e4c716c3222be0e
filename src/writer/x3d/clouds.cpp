// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/clouds.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "base/text.hpp"
#include "base/thread.hpp"
#include "writer/x3d/cloud_nodes.hpp"
#include "writer/x3d/file_pictures.hpp"
#include "writer/x3d/film_nodes.hpp"
#include "writer/x3d/tile_tree.hpp"

namespace cloudgen::writer {
namespace {

constexpr double kLiveClouds = 250;       ///< clouds that are drawn one by one around the viewer, about
/// Clouds of all times of a sky that moves with finer pictures than coarse ones in the scene's file, at most.
constexpr std::size_t kFinelyMovingClouds = 1000;
constexpr double kNearClouds = 4;         ///< clouds that are drawn in full around the viewer, about
/// The pictures of clouds in the scene's file and in that of a tile.
constexpr PictureSize kPicturesAtHand{1.2e6, 128}, kTilePictures{1e5, 64};
/// A flat square is a sheet from so many times its side away on.
constexpr float kFlatRange = 0.75f;
/// How much further than it is drawn a tile's file is loaded: it is there when the viewer comes near.
/// But no further: X_ITE 15 waits for each texture of a file until all frames that were drawn are done
/// (gl.getParameter and gl.readPixels in ImageTexture), a fifth of a second each for sheets, four seconds
/// each for cards over all of a region. Parsing, nodes and sensors take a hundredth of that.
constexpr float kLoadAhead = 1.15f;
/// The same where clouds are loaded that are in full only around a viewer who is in them: some of a flight.
constexpr float kLoadAheadMeters = 300;

const scene::Archetype& archetypeOf(const scene::Scene& scene, std::uint32_t instance) {
  return scene.archetypes[scene.lit[scene.instances[instance].lit].archetype];
}

std::vector<std::uint32_t> widestFirst(const scene::Scene& scene) {
  std::vector<std::uint32_t> order(scene.instances.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto width = [&](std::uint32_t i) {
    return scene.instances[i].scale * archetypeOf(scene, i).widthMeters;
  };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return width(a) > width(b); });
  return order;
}

/// As nodes the widest clouds are in full, up to kPuffsInFull.
std::vector<bool> fullOf(const scene::Scene& scene) {
  std::vector<bool> full(scene.instances.size());
  std::size_t puffs = 0;
  for (const std::uint32_t i : widestFirst(scene))
    full[i] = (puffs += archetypeOf(scene, i).puffs.size()) <= kPuffsInFull;
  return full;
}

/// What one file of a scene is written with.
struct File {
  NodeWriter& nodes;
  QuadShapes& shapes;
  FilmNodes& film;
  CloudNodes clouds;
  const FilePictures& pictures;

  /// Writes clouds, those of a time together.
  void eachOf(std::span<const std::uint32_t> instances, const std::function<void(std::uint32_t)>& write) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
      const bool isFirst = i == 0 || !film.areThereTogether(instances[i - 1], instances[i]);
      if (isFirst && i > 0) film.closeWhileThere();
      if (isFirst) film.openWhileThere(instances[i]);
      write(instances[i]);
    }
    if (!instances.empty()) film.closeWhileThere();
  }
};

class Tiles {
 public:
  Tiles(const scene::Scene& scene, const Stage& stage, const std::vector<image::SpriteAtlas>& atlases,
        Encoding encoding)
      : scene_(scene),
        stage_(stage),
        atlases_(atlases),
        encoding_(encoding),
        film_(scene),
        trees_(tileTrees(scene, stage)),
        full_(fullOf(scene)),
        coverings_(scene, atlases, full_),
        meshes_(scene),
        isSmall_(film_.moves() || scene.instances.size() <= kLiveClouds),
        finestWhole_(!film_.moves()                               ? MeshFineness::Fine
                     : scene.instances.size() <= kFinelyMovingClouds ? MeshFineness::Middle
                                                                  : MeshFineness::Coarse) {
    chooseAtHand();
  }

  /// Writes the files of the tiles that are not at hand.
  void files(const std::filesystem::path& folder, const base::Progress& progress) const {
    constexpr std::size_t kAtOnce = 16;
    for (std::size_t start = 0; start < trees_.size(); start += kAtOnce) {
      progress.step("writing X3D", static_cast<double>(start) / static_cast<double>(trees_.size()));
      base::parallelFor(std::min(kAtOnce, trees_.size() - start), [&](std::size_t i) {
        if (!isAtHand_[start + i]) file(trees_[start + i], folder);
      });
    }
  }

  /// Writes the tiles into the scene's file.
  void roots(NodeWriter& nodes, QuadShapes& shapes, const std::filesystem::path& folder) const {
    std::vector<const TileNode*> squares;
    for (std::size_t i = 0; i < trees_.size() && !isSmall_; ++i) {
      squares.push_back(&trees_[i]);
      if (isAtHand_[i]) addParts(trees_[i], squares);
    }
    const FilePictures pictures(scene_, squares, kPicturesAtHand, "pictures.png");
    pictures.texture(folder);
    declareUnlit(nodes);
    FilmNodes film(nodes, film_);
    File main{nodes, shapes, film, CloudNodes(nodes, shapes, film, scene_, coverings_, meshes_, finestWhole_),
              pictures};
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      if (!isAtHand_[i])
        away(main, trees_[i]);
      else if (isSmall_)
        within(main, trees_[i]);
      else
        levels(main, "Tile_" + trees_[i].name, trees_[i]);
    }
    for (std::size_t i = 0; i < trees_.size(); ++i)
      if (!isAtHand_[i]) routes(nodes, trees_[i].name);
    film.finish();
  }

 private:
  /// Tiles about the places that the viewpoints look at, at least one.
  void chooseAtHand() {
    isAtHand_.assign(trees_.size(), false);
    std::vector<std::size_t> order(trees_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto away = [&](std::size_t i) { return glm::distance(trees_[i].middle(), stage_.focus); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return away(a) < away(b); });
    std::size_t puffs = 0;
    for (const std::size_t tile : order) {
      puffs += puffsToRead(scene_, trees_[tile].instances);
      if (puffs > (isSmall_ ? kPuffsAtHandOfFew : kPuffsAtHand) && tile != order.front()) break;
      isAtHand_[tile] = true;
    }
  }

  /// Distance within which about so many clouds stand, were they spread evenly.
  float reachOf(double clouds) const {
    const double count = std::max(film_.cloudsAtOnce(), 1.0);
    const double area =
        static_cast<double>(stage_.upper.x - stage_.lower.x) * (stage_.upper.z - stage_.lower.z);
    return static_cast<float>(std::sqrt(clouds * area / (std::numbers::pi * count)));
  }

  /// Where a viewer is who is in one of a tile's clouds, as a box about its middle.
  glm::vec3 sizeWithin(const TileNode& tile) const {
    float near = 0;
    for (const std::uint32_t i : tile.instances) {
      const scene::Instance& cloud = scene_.instances[i];
      near = std::max(near, std::max(cloud.scale, 1.0f) * nearRange(scene_, cloud, reachOf(kNearClouds)));
    }
    return tile.upper - tile.lower + 2 * near;
  }

  /// A viewer in the middle of a square always sees its clouds.
  float rangeOf(const TileNode& tile) const {
    if (isSmall_) return 0.5f * glm::length(sizeWithin(tile));
    if (isFlat(tile)) return kFlatRange * tile.side;
    return std::clamp(reachOf(kLiveClouds) + 0.5f * tile.side, 0.9f * tile.side,
                      std::max(4 * stage_.extent, tile.side));
  }

  static void openLod(NodeWriter& nodes, const std::string& def, const TileNode& tile, float range) {
    nodes.open("LOD", "children", def);
    nodes.vector("center", tile.middle(), 1);
    nodes.numbers("range", std::array{range}, 1, 0);
  }

  /// A square as LODs of those within it, or as its clouds.
  void within(File& file, const TileNode& tile) const {
    for (const TileNode& part : tile.children) {
      if (isSmall_)
        within(file, part);
      else
        levels(file, "Part_" + part.name, part);
    }
    if (!tile.children.empty()) return;
    file.eachOf(tile.instances, [&](std::uint32_t i) {
      if (full_[i])
        file.clouds.near(i, reachOf(kNearClouds), Beyond::Here);
      else
        file.clouds.fixed(i, CloudDetail::Simple);
    });
  }

  static void addParts(const TileNode& tile, std::vector<const TileNode*>& out) {
    for (const TileNode& part : tile.children) {
      out.push_back(&part);
      addParts(part, out);
    }
  }

  /// A square with its clouds and as it is from afar, both in this file.
  void levels(File& file, const std::string& def, const TileNode& tile) const {
    openLod(file.nodes, def, tile, rangeOf(tile));
    file.nodes.open("Group");
    within(file, tile);
    file.nodes.close();
    file.nodes.open("Group");
    file.pictures.writeSquare(file.shapes, tile);
    file.nodes.close();
    file.nodes.close();
  }

  /// A tile as it is until its file is there: its clouds as one picture each, or as it is from afar.
  void fromAfar(File& file, const TileNode& tile) const {
    if (!isSmall_) return file.pictures.writeSquare(file.shapes, tile);
    file.eachOf(tile.instances, [&](std::uint32_t i) { file.clouds.whole(i, std::nullopt); });
  }

  /// A tile as it is from afar until the viewer is near and its file is there. X3DOM 1.8 fetches any Inline
  /// at once, whatever `load` says, and then waits for it forever; it knows no LoadSensor and leaves out what
  /// is defined within it, and so stays with the far level.
  void away(File& file, const TileNode& tile) const {
    NodeWriter& nodes = file.nodes;
    const float range = rangeOf(tile);
    nodes.open("ProximitySensor", "children", "Near_" + tile.name);
    nodes.vector("center", tile.middle(), 1);
    nodes.vector("size", isSmall_ ? sizeWithin(tile) + 2 * kLoadAheadMeters : glm::vec3(2 * kLoadAhead * range), 0);
    nodes.close();
    nodes.open("LoadSensor", "children", "Loaded_" + tile.name);
    nodes.open("Inline", "children", "Clouds_" + tile.name);
    nodes.boolean("load", false);
    nodes.strings("url", std::vector<std::string>{fileOf(tile)});
    nodes.close();
    nodes.close();
    openLod(nodes, "Tile_" + tile.name, tile, range);
    nodes.open("Switch", "children", "Choice_" + tile.name);
    nodes.integer("whichChoice", 0);
    nodes.open("Group", "children", "Far_" + tile.name);
    fromAfar(file, tile);
    nodes.close();
    if (isSmall_) nodes.open("Group");
    nodes.use("Inline", "children", "Clouds_" + tile.name);
    if (isSmall_) {
      file.eachOf(tile.instances, [&](std::uint32_t i) { file.clouds.whole(i, reachOf(kNearClouds)); });
      nodes.close();
    }
    nodes.close();
    nodes.use("Group", "children", "Far_" + tile.name);
    nodes.close();
    nodes.open("IntegerTrigger", "children", "Choose_" + tile.name);
    nodes.integer("integerKey", 1);
    nodes.close();
  }

  static void routes(NodeWriter& nodes, const std::string& name) {
    nodes.route("Near_" + name, "isActive", "Clouds_" + name, "load");
    nodes.route("Loaded_" + name, "isLoaded", "Choose_" + name, "set_boolean");
    nodes.route("Choose_" + name, "triggerValue", "Choice_" + name, "whichChoice");
  }

  std::string fileOf(const TileNode& tile) const {
    return fmt::format("scene.tile_{}.{}", tile.name, encoding_ == Encoding::Xml ? "x3d" : "x3dv");
  }

  void file(const TileNode& tile, const std::filesystem::path& folder) const {
    const auto nodes = nodeWriter(encoding_, folder / fileOf(tile));
    QuadShapes shapes(*nodes, atlases_);
    nodes->start(
        {{"title", fmt::format("Tile {} of the clouds of {}", tile.name, base::isoText(scene_.validTime))},
         {"creator", "cloudgen"},
         {"generator", "cloudgen"}});
    std::vector<const TileNode*> squares;
    if (!isSmall_) addParts(tile, squares);
    const FilePictures pictures(scene_, squares, kTilePictures, fmt::format("pictures_{}.png", tile.name));
    pictures.texture(folder);
    declareUnlit(*nodes);
    FilmNodes film(*nodes, film_);
    File one{*nodes, shapes, film, CloudNodes(*nodes, shapes, film, scene_, coverings_, meshes_, finestWhole_),
             pictures};
    if (isSmall_)
      one.eachOf(tile.instances,
                 [&](std::uint32_t i) { one.clouds.near(i, reachOf(kNearClouds), Beyond::Elsewhere); });
    else
      within(one, tile);
    film.finish();
    nodes->finish();
  }

  const scene::Scene& scene_;
  const Stage& stage_;
  const std::vector<image::SpriteAtlas>& atlases_;
  Encoding encoding_;
  Film film_;
  std::vector<TileNode> trees_;
  std::vector<bool> full_, isAtHand_;
  Coverings coverings_;
  CloudMeshes meshes_;
  bool isSmall_;  ///< all clouds are drawn one by one wherever the viewer is: nothing is seen from afar
  MeshFineness finestWhole_;
};

}  // namespace

void writeClouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                 const std::filesystem::path& folder, const base::Progress& progress) {
  const Tiles tiles(scene, stage, shapes.atlases(), nodes.encoding());
  tiles.files(folder, progress);
  tiles.roots(nodes, shapes, folder);
}

}  // namespace cloudgen::writer
