// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tiles3d.hpp"

#include <algorithm>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/gzip.hpp"
#include "base/thread.hpp"
#include "writer/copy_textures.hpp"
#include "writer/gltf/scene_extras.hpp"
#include "writer/tiles3d/merging.hpp"
#include "writer/tiles3d/narrow.hpp"
#include "writer/tiles3d/tile_content.hpp"

namespace cloudgen::writer {
namespace {

using namespace tiles3d;
using Json = nlohmann::ordered_json;

constexpr const char* kFolder = "tiles";
constexpr std::size_t kTilesAtOnce = 16;

/// What tile.metadata says, by the 3D Metadata Specification.
Json tileSchema() {
  const auto property = [](const char* type, const char* component, const char* description) {
    Json out{{"description", description}, {"type", type}};
    if (*component) out["componentType"] = component;
    out["required"] = true;
    return out;
  };
  const Json properties{
      {"clouds", property("SCALAR", "UINT32", "Clouds that stand in the tile")},
      {"drawn", property("SCALAR", "UINT32", "Splats or cards that the tile draws")},
      {"genera", property("STRING", "", "Genera of the clouds, as WMO abbreviations")},
      {"lowestBase", property("SCALAR", "FLOAT32", "Lowest cloud base, metres above mean sea level")},
      {"highestTop", property("SCALAR", "FLOAT32", "Highest cloud top, metres above mean sea level")}};
  return {{"id", "cloudgen_tiles"},
          {"classes", {{"tile", {{"name", "Tile of clouds"}, {"properties", properties}}}}}};
}

Json metadataOf(const TileNode& node, const WrittenTile& written) {
  std::string genera;
  for (const base::Genus genus : written.genera)
    genera += fmt::format("{}{}", genera.empty() ? "" : " ", base::abbreviation(genus));
  return {{"class", "tile"},
          {"properties",
           {{"clouds", node.count},
            {"drawn", written.drawn},
            {"genera", genera},
            {"lowestBase", std::round(written.lowestBaseMeters)},
            {"highestTop", std::round(written.highestTopMeters)}}}};
}

/// Column by column.
Json matrixOf(const glm::dmat4& matrix) {
  Json out = Json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) out.push_back(matrix[column][row]);
  return out;
}

/// The tiles as written, as they stand in tileset.json.
class TilesetTree {
 public:
  TilesetTree(const TileTree& tree, const std::vector<WrittenTile>& written)
      : tree_(tree), written_(written), regions_(tree.nodes.size()) {
    // Children come after their parents: from the back, all regions of children are known.
    for (std::size_t i = regions_.size(); i-- > 0;) {
      regions_[i].include(written_[i].region);
      for (const std::uint32_t child : tree_.nodes[i].children) regions_[i].include(regions_[child]);
    }
  }

  bool empty() const { return regions_.empty() || regions_[0].empty(); }
  Json root() const { return tile(0, glm::dmat4(1)); }

 private:
  /// A tile and those below it; transforms are given from the parent's axes.
  Json tile(std::uint32_t index, const glm::dmat4& parentToEarth) const {
    const TileNode& node = tree_.nodes[index];
    const WrittenTile& written = written_[index];
    const bool hasContent = written.drawn > 0;
    const glm::dmat4 toEarth = hasContent ? written.plane.toEarth : parentToEarth;
    Json out{{"boundingVolume", {{"region", regions_[index].bounds()}}},
             {"geometricError", node.detail.errorMeters}};
    if (node.level == 0) out["refine"] = "REPLACE";
    if (hasContent) {
      out["transform"] = matrixOf(glm::inverse(parentToEarth) * toEarth);
      out["content"] = {{"uri", fmt::format("{}/{}.glb", kFolder, node.name())},
                        {"boundingVolume", {{"region", written.region.bounds()}}}};
      out["metadata"] = metadataOf(node, written);
    }
    for (const std::uint32_t child : node.children)
      if (!regions_[child].empty()) out["children"].push_back(tile(child, toEarth));
    return out;
  }

  const TileTree& tree_;
  const std::vector<WrittenTile>& written_;
  std::vector<Region> regions_;
};

/// Without clouds: a tile of nothing over the box.
Json emptyRoot(const scene::Scene& scene) {
  const base::GeoBox& box = scene.frame.box();
  Region region;
  for (const double longitude : {box.west, box.centerLongitude(), box.east})
    for (const double latitude : {box.south, box.north}) region.include({longitude, latitude, 0}, 0, 1);
  return {{"boundingVolume", {{"region", region.bounds()}}}, {"geometricError", 0}, {"refine", "REPLACE"}};
}

Json tilesetOf(const scene::Scene& scene, const TilesetTree& tree, double rootError, TileContent content,
               const Json& times) {
  const glm::dvec2 extent = scene.frame.upperCorner() - scene.frame.lowerCorner();
  const auto extensions = extensionsOf(content);
  Json tileset;
  tileset["asset"] = {{"version", "1.1"}, {"generator", "cloudgen"}, {"extras", gltf::sceneExtras(scene)}};
  if (!times.empty()) tileset["asset"]["extras"]["times"] = times;
  tileset["geometricError"] = std::max(std::hypot(extent.x, extent.y), 2 * rootError);
  tileset["extensionsUsed"] = {"3DTILES_content_gltf"};
  tileset["extensions"]["3DTILES_content_gltf"] = {{"extensionsUsed", extensions}};
  if (content == TileContent::Packed)
    tileset["extensions"]["3DTILES_content_gltf"]["extensionsRequired"] = extensions;
  tileset["schema"] = tileSchema();
  tileset["root"] = tree.empty() ? emptyRoot(scene) : tree.root();
  return tileset;
}

/// `times`: the tilesets of a sky that moves, or nothing.
void writeTileset(const scene::Scene& scene, const Destination& destination, const Json& times) {
  const auto folder = destination.folder / kFolder;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw base::OutputError(folder.string(), "cannot be made: " + error.message(), "check the output folder");
  TileStyle style{destination.tiles.content, destination.splats.degree, destination.tiles.gzip, {}};
  TileTree tree = style.content == TileContent::Splats
                      ? tileTree(scene)
                      : tileTree(scene, kMostPuffsOfTile, kVisibleSigmas * static_cast<double>(kMostSigmaMeters));
  if (style.content == TileContent::Auto) style.content = chosenContent(scene, tree);
  if (style.content == TileContent::Cards) {
    style.atlases = copyTextures(scene, destination.folder);
    tree = tileTree(scene, kMostPuffsOfCardTile);
  }
  std::vector<WrittenTile> written(tree.nodes.size());
  for (std::size_t start = 0; start < written.size(); start += kTilesAtOnce) {
    destination.progress.step("tiles", static_cast<double>(start) / static_cast<double>(written.size()));
    base::parallelFor(std::min(kTilesAtOnce, written.size() - start), [&](std::size_t i) {
      const TileNode& node = tree.nodes[start + i];
      written[start + i] = writeTile(scene, tree, node, style, folder / (node.name() + ".glb"));
    });
  }
  const double rootError = tree.nodes.empty() ? 0 : tree.nodes.front().detail.errorMeters;
  const std::string tileset =
      tilesetOf(scene, TilesetTree(tree, written), rootError, style.content, times).dump() + "\n";
  base::writeFile(destination.folder / "tileset.json", style.gzip ? base::gzipped(tileset) : tileset);
  destination.progress.step("tiles", 1);
}

/// "hours/20050828T1500Z", a folder beside the first tileset.
std::string folderOf(base::UtcTime time) {
  std::string name;
  for (const char c : base::isoText(time).substr(0, 16))
    if (c != '-' && c != ':') name += c;
  return fmt::format("hours/{}Z", name);
}

}  // namespace

void writeTiles(const scene::Scene& scene, const Destination& destination) {
  if (scene.timeSeconds.empty()) return writeTileset(scene, destination, {});
  std::vector<std::string> folders;
  Json times = Json::array();
  for (const double seconds : scene.timeSeconds) {
    const base::UtcTime time{scene.validTime.seconds + std::llround(seconds)};
    folders.push_back(folders.empty() ? "" : folderOf(time));
    times.push_back({{"valid_time", base::isoText(time)},
                     {"uri", (std::filesystem::path(folders.back()) / "tileset.json").generic_string()}});
  }
  for (std::size_t k = 0; k < folders.size(); ++k) {
    Destination there = destination;
    there.folder /= folders[k];
    writeTileset(scene::standingAt(scene, scene.timeSeconds[k]), there, k == 0 ? times : Json());
  }
}

}  // namespace cloudgen::writer
