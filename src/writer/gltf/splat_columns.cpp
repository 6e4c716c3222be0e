// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat_columns.hpp"

#include <array>

#include "light/color.hpp"

namespace cloudgen::writer::gltf {
namespace {

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

}  // namespace

const nlohmann::json& splattingExtension() {
  static const nlohmann::json kValue{{"kernel", "ellipse"},
                                     {"colorSpace", "srgb_rec709_display"},
                                     {"projection", "perspective"},
                                     {"sortingMethod", "cameraDistance"}};
  return kValue;
}

Attributes addSplats(GlbFile& file, std::span<const Splat> splats, glm::vec3 sunDirection) {
  const auto semantic = [](std::string_view name) { return fmt::format("{}:{}", kSplatting, name); };
  const auto towardsSun = harmonicsTowards(sunDirection);
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

}  // namespace cloudgen::writer::gltf
