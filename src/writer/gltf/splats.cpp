// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "light/color.hpp"
#include "writer/gltf/glb_file.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/gltf/scene_extras.hpp"
#include "writer/gltf/splat_tiles.hpp"

namespace cloudgen::writer {
namespace {

using namespace gltf;

// Real spherical harmonics of degree 0 and 1; the Condon-Shortley sign of the basis is in harmonicsTowards.
constexpr float kHarmonic0 = 0.2820947917738781f, kHarmonic1 = 0.4886025119029199f;
constexpr std::uint64_t kBytesOfSplat = 12 + 16 + 12 + 4 + 12 + 3 * 12 + 4 + 4;
constexpr const char* kExtension = "KHR_gaussian_splatting";
/// What is denser is opaque to the eye, and its opacity, a float just below 1, says no more how dense it is.
constexpr float kOpaqueOpticalDepth = 8;

/// Factors of the degree-1 coefficients for light that grows with the cosine between view and `direction`:
/// the basis is -y, +z, -x of the direction from the camera to the splat.
std::array<float, 3> harmonicsTowards(glm::vec3 direction) {
  return {-direction.y / kHarmonic1, direction.z / kHarmonic1, -direction.x / kHarmonic1};
}

/// One column of the splats: `components` floats each, by `value`.
template <class Value>
int addColumn(GlbFile& file, std::span<const Splat> splats, std::vector<float>& column, Value value) {
  column.clear();
  for (const Splat& splat : splats)
    for (const float component : value(splat)) column.push_back(component);
  return file.addFloats(static_cast<int>(column.size() / splats.size()), column);
}

std::array<float, 3> tuple(glm::vec3 v) { return {v.x, v.y, v.z}; }

/// COLOR_0 for viewers that draw points: linear, as core glTF wants it, with the opacity as alpha.
int addFallbackColors(GlbFile& file, std::span<const Splat> splats) {
  std::vector<std::uint8_t> colors;
  colors.reserve(4 * splats.size());
  const auto toByte = [](float unit) { return static_cast<std::uint8_t>(std::lround(255.0f * unit)); };
  for (const Splat& splat : splats) {
    const glm::vec3 linear = light::linearFromSrgb(splat.color);
    colors.insert(colors.end(),
                  {toByte(linear.x), toByte(linear.y), toByte(linear.z), toByte(splat.opacity)});
  }
  return file.addUnitBytes(colors);
}

Attributes addSplats(GlbFile& file, std::span<const Splat> splats, const light::Sun& sun) {
  const auto semantic = [](std::string_view name) { return fmt::format("{}:{}", kExtension, name); };
  const auto towardsSun = harmonicsTowards(sun.direction);
  std::vector<float> column;
  column.reserve(4 * splats.size());
  for (const Splat& splat : splats)
    for (const float component : tuple(splat.center)) column.push_back(component);
  Attributes attributes{{"POSITION", file.addFloats(3, column, true)}};
  attributes.emplace_back(semantic("ROTATION"), addColumn(file, splats, column, [](const Splat& s) {
                            return std::array{s.rotation.x, s.rotation.y, s.rotation.z, s.rotation.w};
                          }));
  attributes.emplace_back(semantic("SCALE"),
                          addColumn(file, splats, column, [](const Splat& s) { return tuple(s.sigma); }));
  attributes.emplace_back(semantic("OPACITY"), addColumn(file, splats, column, [](const Splat& s) {
                            return std::array{s.opacity};
                          }));
  attributes.emplace_back(semantic("SH_DEGREE_0_COEF_0"), addColumn(file, splats, column, [](const Splat& s) {
                            return tuple((s.color - 0.5f) / kHarmonic0);
                          }));
  for (std::size_t i = 0; i < 3; ++i)
    attributes.emplace_back(
        semantic(fmt::format("SH_DEGREE_1_COEF_{}", i)),
        addColumn(file, splats, column, [&](const Splat& s) { return tuple(s.towardsSun * towardsSun[i]); }));
  attributes.emplace_back("COLOR_0", addFallbackColors(file, splats));
  if (std::ranges::any_of(splats, [](const Splat& s) { return s.opticalDepth > kOpaqueOpticalDepth; }))
    attributes.emplace_back("_OPTICAL_DEPTH", addColumn(file, splats, column, [](const Splat& s) {
                              return std::array{s.opticalDepth};
                            }));
  return attributes;
}

}  // namespace

void writeSplats(const scene::Scene& scene, const Destination& destination) {
  GlbFile file(sceneExtras(scene));
  file.reserve(scene::drawnPuffs(scene) * kBytesOfSplat);
  const nlohmann::json splatting{{"kernel", "ellipse"},
                                 {"colorSpace", "srgb_rec709_display"},
                                 {"projection", "perspective"},
                                 {"sortingMethod", "cameraDistance"}};
  const auto tiles = scene::tilesOf(scene);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    destination.progress.step("splats", static_cast<double>(t) / static_cast<double>(tiles.size()));
    const scene::Tile& tile = tiles[t];
    const auto splats = splatsOf(scene, tile);
    const nlohmann::json extras{
        {"lower", arrayOf(tile.lower)}, {"upper", arrayOf(tile.upper)}, {"clouds", tile.instances.size()}};
    for (std::size_t start = 0, part = 0; start < splats.size(); start += kMostSplatsOfTile, ++part) {
      const auto run = std::span(splats).subspan(start, std::min(kMostSplatsOfTile, splats.size() - start));
      std::string name = fmt::format("tile {} {}", tile.column, tile.row);
      if (part > 0) name += fmt::format(" part {}", part + 1);
      const int mesh = file.addMesh(name, {.attributes = addSplats(file, run, scene.sun),
                                           .points = true,
                                           .extension = kExtension,
                                           .extensionValue = &splatting});
      file.addNode({.name = name, .mesh = mesh, .translation = tileCenter(tile), .extras = &extras});
    }
  }
  if (tiles.empty()) file.useExtension(kExtension, false);
  file.write(destination.folder / "scene.splats.glb");
  destination.progress.step("splats", 1);
}

}  // namespace cloudgen::writer
