// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tile_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/file.hpp"
#include "base/gzip.hpp"
#include "shape/blending.hpp"
#include "writer/gltf/splat_columns.hpp"
#include "writer/gltf/spz.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

using gltf::Attributes;
using gltf::GlbFile;
using gltf::Splat;

constexpr const char* kPacked = "KHR_gaussian_splatting_compression_spz_2";
/// Packed deviations end at 379 units.
constexpr double kMetersPerUnit = 1000;
/// Where viewers cut a splat off.
constexpr float kReach = 3;
/// Neighbours as near as this are turned alike: less than 2 minutes of arc apart.
constexpr float kAlikeMeters = 2000;

/// A puff of the scene on the globe.
struct PlacedPuff {
  LitPuff lit;  ///< in the scene frame
  glm::dvec3 geographic{0};
};

/// The visible puffs of a tile, as wide as they are drawn; takes what they reach into the region.
std::vector<PlacedPuff> placedPuffs(std::vector<LitPuff> puffs, const Placement& placement, Region& region) {
  std::vector<PlacedPuff> out;
  for (LitPuff& lit : puffs) {
    lit.puff = shape::widenedAcross(lit.puff);
    if (gltf::splatOpacity(lit.puff) < gltf::kLeastOpacity) continue;
    const shape::Bounds box = shape::boundsOf(std::span(&lit.puff, 1), kReach);
    const glm::dvec3 half = 0.5 * glm::dvec3(box.upper - box.lower);
    const glm::dvec3 geographic = placement.geographic(lit.puff.center);
    region.include(geographic, std::hypot(half.x, half.z), half.y);
    out.push_back({std::move(lit), geographic});
  }
  return out;
}

/// In Morton order of their places on the plane.
std::vector<Splat> splatsOn(const TilePlane& plane, const Placement& placement,
                            std::span<const PlacedPuff> puffs, const light::Sun& sun) {
  constexpr float kSteps = 65535;
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  std::vector<glm::dvec3> places;
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (const PlacedPuff& one : puffs) {
    places.push_back(placement.onPlane(plane, one.geographic));
    lower = glm::min(lower, glm::vec3(places.back())), upper = glm::max(upper, glm::vec3(places.back()));
  }
  const glm::vec3 extent = upper - lower;
  const float metersPerStep = std::max({extent.x, extent.y, extent.z, 1.0f}) / kSteps;
  for (std::size_t i = 0; i < places.size(); ++i)
    order.emplace_back(gltf::mortonOf(places[i], lower, metersPerStep), i);
  std::sort(order.begin(), order.end());
  glm::quat turn(1, 0, 0, 0);
  glm::vec3 turnedAt(1e30f);
  std::vector<Splat> splats;
  splats.reserve(order.size());
  for (const auto& [morton, i] : order) {
    shape::Puff puff = puffs[i].lit.puff;
    if (glm::distance(puff.center, turnedAt) > kAlikeMeters) {
      turn = placement.turn(plane, puff.center);
      turnedAt = puff.center;
    }
    puff.rotation = turn * puff.rotation;
    puff.center = places[i];
    splats.push_back(gltf::splatOf(puff, puffs[i].lit.light, sun));
  }
  return splats;
}

/// The accessors that a packed primitive has, without bytes of their own. Some viewers count those of the
/// harmonics to learn the degree, so that of degree 0, which is COLOR_0, is left out.
Attributes unpackedAttributes(GlbFile& file, std::span<const Splat> splats) {
  const auto splatting = [](std::string_view name) { return fmt::format("{}:{}", gltf::kSplatting, name); };
  glm::dvec3 lower(1e30), upper(-1e30);
  for (const Splat& splat : splats) {
    lower = glm::min(lower, glm::dvec3(splat.center) / kMetersPerUnit);
    upper = glm::max(upper, glm::dvec3(splat.center) / kMetersPerUnit);
  }
  Attributes attributes{{"POSITION", file.addUnpackedPositions(splats.size(), lower, upper)},
                        {"COLOR_0", file.addUnpacked(4, splats.size(), true)},
                        {splatting("SCALE"), file.addUnpacked(3, splats.size())},
                        {splatting("ROTATION"), file.addUnpacked(4, splats.size())}};
  for (int k = 0; k < 3; ++k)
    attributes.emplace_back(splatting(fmt::format("SH_DEGREE_1_COEF_{}", k)),
                            file.addUnpacked(3, splats.size()));
  return attributes;
}

/// Opacities in a byte tell little of what is denser than this.
constexpr float kTellingOpticalDepth = 4;

/// Where a tile is dense, the optical depth of each splat as a property (EXT_structural_metadata) in a byte:
/// its logarithm, in steps of some per cent.
void addOpticalDepths(GlbFile& file, std::span<const Splat> splats) {
  float least = 1e30f, most = kTellingOpticalDepth;
  for (const Splat& splat : splats) {
    least = std::min(least, std::log(splat.opticalDepth));
    most = std::max(most, splat.opticalDepth);
  }
  const float range = std::log(most) - least;
  std::string bytes;
  for (const Splat& splat : splats)
    bytes += static_cast<char>(std::lround(255 * (std::log(splat.opticalDepth) - least) / range));
  nlohmann::json values{{"type", "SCALAR"}, {"componentType", "UINT8"}, {"normalized", true}};
  values["description"] = "Natural logarithm of the optical depth through the centre along the shortest axis";
  values["offset"] = least;
  values["scale"] = range;
  file.addExtension("EXT_structural_metadata",
                    {{"schema",
                      {{"id", "cloudgen_splats"},
                       {"classes", {{"splat", {{"properties", {{"logOpticalDepth", values}}}}}}}}},
                     {"propertyTables",
                      {{{"class", "splat"},
                        {"count", splats.size()},
                        {"properties", {{"logOpticalDepth", {{"values", file.addBytes(bytes)}}}}}}}}});
}

void addPackedSplats(GlbFile& file, const std::string& name, std::span<const Splat> splats,
                     glm::vec3 sunDirection) {
  nlohmann::json extension = gltf::splattingExtension();
  extension["extensions"][kPacked]["bufferView"] =
      file.addBytes(gltf::packedSplats(splats, sunDirection, kMetersPerUnit));
  gltf::Primitive primitive{.attributes = unpackedAttributes(file, splats),
                            .points = true,
                            .extensions = {{gltf::kSplatting, &extension}}};
  const nlohmann::json features{{"featureIds", {{{"featureCount", splats.size()}, {"propertyTable", 0}}}}};
  const auto isDense = [](const Splat& splat) { return splat.opticalDepth > kTellingOpticalDepth; };
  if (std::ranges::any_of(splats, isDense)) {
    addOpticalDepths(file, splats);
    primitive.extensions.emplace_back("EXT_mesh_features", &features);
  }
  const int mesh = file.addMesh(name, primitive);
  file.addNode({.name = name, .mesh = mesh, .metersPerUnit = kMetersPerUnit});
}

void addPlainSplats(GlbFile& file, const std::string& name, std::span<const Splat> splats,
                    glm::vec3 sunDirection) {
  const int mesh = file.addMesh(name, {.attributes = gltf::addSplats(file, gltf::sourceOf(splats), sunDirection, 1),
                                       .points = true,
                                       .extensions = {{gltf::kSplatting, &gltf::splattingExtension()}}});
  file.addNode({.name = name, .mesh = mesh});
}

void takeRecords(const scene::Scene& scene, Clouds clouds, WrittenTile& written) {
  written.lowestBaseMeters = 1e30, written.highestTopMeters = -1e30;
  for (const std::uint32_t cloud : clouds) {
    const scene::CloudRecord& record = scene.clouds[cloud];
    written.genera.insert(record.genus);
    written.lowestBaseMeters = std::min<double>(written.lowestBaseMeters, record.baseMeters);
    written.highestTopMeters = std::max<double>(written.highestTopMeters, record.topMeters);
  }
}

}  // namespace

std::vector<std::string> extensionsOf(TileContent content) {
  if (content == TileContent::Splats) return {gltf::kSplatting};
  return {gltf::kSplatting, kPacked};
}

WrittenTile writeTile(const scene::Scene& scene, const TileTree& tree, const TileNode& node,
                      const TilesOptions& options, const std::filesystem::path& file) {
  const Placement placement(scene.frame.box());
  const Clouds clouds = tree.cloudsOf(node);
  WrittenTile written;
  takeRecords(scene, clouds, written);
  const auto puffs = placedPuffs(puffsAt(scene, clouds, node.detail), placement, written.region);
  if (puffs.empty()) return written;
  written.splats = puffs.size();
  written.plane = placement.planeAt(written.region.center());
  light::Sun sun = scene.sun;
  sun.direction = placement.turn(written.plane, placement.scene(written.plane.middle)) * sun.direction;
  const auto splats = splatsOn(written.plane, placement, puffs, sun);
  GlbFile glb(nlohmann::json{{"tile", node.name()}, {"clouds", clouds.size()}});
  for (const std::string& extension : extensionsOf(options.content))
    glb.useExtension(extension, options.content == TileContent::Packed);
  const std::string name = "tile " + node.name();
  if (options.content == TileContent::Splats)
    addPlainSplats(glb, name, splats, sun.direction);
  else
    addPackedSplats(glb, name, splats, sun.direction);
  glb.write(file);
  if (options.gzip) base::writeFile(file, base::gzipped(base::readFile(file)));
  return written;
}

}  // namespace cloudgen::writer::tiles3d
