// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/clouds.hpp"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "base/text.hpp"
#include "base/thread.hpp"
#include "writer/x3d/cards.hpp"
#include "writer/x3d/cloud_nodes.hpp"
#include "writer/x3d/tile_views.hpp"

namespace cloudgen::writer {
namespace {

/// A texel of a picture is two pixels of a screen of 720 lines and 45 degrees, from where it is seen first.
constexpr float kRadiansPerTexel = 2.0f / 869;
/// Texels of all pictures together, about: more tiles have coarser ones.
constexpr double kMostTexels = 16e6;

/// view3dscene 4.2 refuses the field `level` of VRML97's LOD, and the standard any other name for it: VRML97
/// has no LOD here but this many clouds in full, and up to this many with their far level.
constexpr std::size_t kVrml97Full = 60, kVrml97Simple = 1000;

void eachTile(const std::vector<TileNode>& tiles, const std::function<void(const TileNode&)>& visit) {
  for (const TileNode& tile : tiles) {
    visit(tile);
    eachTile(tile.children, visit);
  }
}

class Tiles {
 public:
  Tiles(const scene::Scene& scene, const Stage& stage, const std::vector<image::SpriteAtlas>& atlases,
        Encoding encoding)
      : scene_(scene), atlases_(atlases), encoding_(encoding), trees_(tileTrees(scene, stage)) {
    eachTile(trees_, [&](const TileNode& tile) { all_.push_back(&tile); });
    chooseClocked(stage);
  }

  /// Draws the tiles as they are seen from afar, and the textures of that.
  void draw(const std::filesystem::path& textures, const base::Progress& progress) {
    const SpriteSheets sprites(scene_, atlases_, textures);
    const float coarser = coarserThanSeen();
    std::vector<TileViews> views(all_.size());
    inBatches(progress, [&](std::size_t i) {
      const TileNode& tile = *all_[i];
      views[i] =
          drawViews(scene_, tile, coarser * kRadiansPerTexel * tile.range, atlases_, sprites, textures);
    });
    for (std::size_t i = 0; i < all_.size(); ++i) views_[all_[i]] = std::move(views[i]);
  }

  /// Writes the file that each tile shows when the viewer is near: its clouds, or the tiles within it.
  void files(const std::filesystem::path& folder, const base::Progress& progress) const {
    inBatches(progress, [&](std::size_t i) {
      const TileNode& tile = *all_[i];
      const auto nodes = nodeWriter(encoding_, folder / fileOf(tile));
      QuadShapes shapes(*nodes, atlases_);
      nodes->start(
          {{"title", fmt::format("Tile {} of the clouds of {}", tile.name, base::isoText(scene_.validTime))},
           {"creator", "cloudgen"},
           {"generator", "cloudgen"}});
      CloudNodes clouds(*nodes, shapes, scene_);
      if (tile.children.empty())
        for (const std::uint32_t instance : tile.instances) clouds.cloud(instance, true);
      writeTiles(*nodes, shapes, tile.children);
      nodes->finish();
    });
  }

  void writeRoots(NodeWriter& nodes, QuadShapes& shapes) const { writeTiles(nodes, shapes, trees_); }

 private:
  void inBatches(const base::Progress& progress, const std::function<void(std::size_t)>& body) const {
    constexpr std::size_t kAtOnce = 16;
    for (std::size_t start = 0; start < all_.size(); start += kAtOnce) {
      progress.step("writing X3D", static_cast<double>(start) / static_cast<double>(all_.size()));
      base::parallelFor(std::min(kAtOnce, all_.size() - start), [&](std::size_t i) { body(start + i); });
    }
  }

  /// X3DOM has no ProximitySensor. Tiles about the places that the viewpoints look at are loaded there by a
  /// clock.
  void chooseClocked(const Stage& stage) {
    std::vector<const TileNode*> leaves;
    for (const TileNode* tile : all_)
      if (tile->children.empty()) leaves.push_back(tile);
    const auto distance = [&](const TileNode* tile) { return glm::distance(tile->middle(), stage.focus); };
    std::stable_sort(leaves.begin(), leaves.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    std::size_t clouds = 0;
    for (const TileNode* leaf : leaves) {
      clouds += leaf->instances.size();
      if (clouds > kClockedClouds) break;
      clocked_.insert(leaf);
    }
    // From the back, those within come before the tile.
    for (auto tile = all_.rbegin(); tile != all_.rend(); ++tile)
      for (const TileNode& child : (*tile)->children)
        if (clocked_.contains(&child)) clocked_.insert(*tile);
  }

  /// How much coarser than is seen pictures must be to keep to kMostTexels.
  float coarserThanSeen() const {
    double texels = 0;
    for (const TileNode* tile : all_)
      for (const std::uint32_t i : tile->instances) {
        const shape::Bounds box = scene::boundsOf(scene_, scene_.instances[i]);
        const glm::vec3 size =
            glm::min((box.upper - box.lower) / (kRadiansPerTexel * tile->range), glm::vec3(kMostPictureSide));
        texels += kAzimuths * size.x * size.y + size.x * size.z;
      }
    return static_cast<float>(std::max(1.0, std::sqrt(texels / kMostTexels)));
  }

  std::string fileOf(const TileNode& tile) const {
    return fmt::format("scene.tile_{}.{}", tile.name, encoding_ == Encoding::Xml ? "x3d" : "x3dv");
  }

  void writeTiles(NodeWriter& nodes, QuadShapes& shapes, const std::vector<TileNode>& tiles) const {
    for (const TileNode& tile : tiles) writeTile(nodes, shapes, tile);
    if (std::any_of(tiles.begin(), tiles.end(),
                    [&](const TileNode& tile) { return clocked_.contains(&tile); }))
      writeClock(nodes);
    for (const TileNode& tile : tiles) writeRoutes(nodes, tile);
  }

  /// The tile from afar, until the viewer is near and its file is loaded.
  void writeTile(NodeWriter& nodes, QuadShapes& shapes, const TileNode& tile) const {
    nodes.open("ProximitySensor", "children", "Near_" + tile.name);
    nodes.vector("center", tile.middle(), 1);
    nodes.vector("size", glm::vec3(2 * kLoadAhead * tile.range), 0);
    nodes.close();
    nodes.open("IntegerTrigger", "children", "Choose_" + tile.name);
    nodes.integer("integerKey", 1);
    nodes.close();
    nodes.open("LOD", "children", "Tile_" + tile.name);
    nodes.vector("center", tile.middle(), 1);
    nodes.numbers("range", std::array{tile.range}, 1, 0);
    nodes.open("Switch", "children", "Choice_" + tile.name);
    nodes.integer("whichChoice", 0);
    nodes.open("Group", "children", "Far_" + tile.name);
    writeViews(nodes, shapes, scene_, tile, views_.at(&tile));
    nodes.close();
    nodes.open("Inline", "children", "Clouds_" + tile.name);
    nodes.boolean("load", false);
    nodes.strings("url", std::vector<std::string>{fileOf(tile)});
    nodes.close();
    nodes.close();
    nodes.use("Group", "children", "Far_" + tile.name);
    nodes.close();
    nodes.open("LoadSensor", "children", "Loaded_" + tile.name);
    nodes.use("Inline", "children", "Clouds_" + tile.name);
    nodes.close();
  }

  /// A clock whose one long cycle began in 1970: X3DOM runs it, and then stops it, as it would have the scene
  /// drawn again and again. X_ITE does not start what is to have begun in the past and not to begin anew.
  static void writeClock(NodeWriter& nodes) {
    nodes.open("TimeSensor", "children", "Clock");
    nodes.number("cycleInterval", 1e11, 0);
    nodes.number("startTime", 1, 0);
    nodes.close();
    for (const char* filter : {"Start", "Stop"}) {
      nodes.open("BooleanFilter", "children", filter);
      nodes.close();
    }
    nodes.route("Clock", "isActive", "Start", "set_boolean");
    nodes.route("Start", "inputTrue", "Stop", "set_boolean");
    nodes.route("Stop", "inputNegate", "Clock", "enabled");
  }

  void writeRoutes(NodeWriter& nodes, const TileNode& tile) const {
    const std::string clouds = "Clouds_" + tile.name, choose = "Choose_" + tile.name;
    nodes.route("Near_" + tile.name, "isActive", clouds, "load");
    nodes.route("Loaded_" + tile.name, "isLoaded", choose, "set_boolean");
    nodes.route(choose, "triggerValue", "Choice_" + tile.name, "whichChoice");
    if (!clocked_.contains(&tile)) return;
    nodes.route("Start", "inputTrue", clouds, "load");
    nodes.route("Start", "inputTrue", choose, "set_boolean");
  }

  const scene::Scene& scene_;
  const std::vector<image::SpriteAtlas>& atlases_;
  Encoding encoding_;
  std::vector<TileNode> trees_;
  std::vector<const TileNode*> all_;  ///< every tile, before those within it
  std::set<const TileNode*> clocked_;
  std::map<const TileNode*, TileViews> views_;
};

}  // namespace

void writeTiles(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                const std::filesystem::path& folder, const base::Progress& progress) {
  Tiles tiles(scene, stage, shapes.atlases(), nodes.encoding());
  tiles.draw(folder / "textures", progress);
  tiles.files(folder, progress);
  tiles.writeRoots(nodes, shapes);
}

void writeTileGroups(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                     const base::Progress& progress) {
  // Those nearest to where the viewpoints look are drawn in full, more of them as their far level.
  std::vector<std::uint32_t> order(scene.instances.size()), rank(order.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto distance = [&](std::uint32_t i) {
    return glm::distance(scene.instances[i].position, stage.focus);
  };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;

  CloudNodes clouds(nodes, shapes, scene);
  const auto trees = tileTrees(scene, stage);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    progress.step("writing VRML", static_cast<double>(i) / static_cast<double>(trees.size()));
    nodes.open("Group", "children", "Tile_" + trees[i].name);
    std::vector<std::uint32_t> others;
    for (const std::uint32_t instance : trees[i].instances) {
      if (rank[instance] < kVrml97Simple)
        clouds.cloud(instance, rank[instance] < kVrml97Full);
      else
        others.push_back(instance);
    }
    writeCards(shapes, scene, others, CardRange::Near);
    nodes.close();
  }
}

}  // namespace cloudgen::writer
