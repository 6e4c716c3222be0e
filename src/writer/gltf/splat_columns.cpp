// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat_columns.hpp"

#include <array>
#include <cstring>

#include "light/color.hpp"

namespace cloudgen::writer::gltf {
namespace {

/// One column: what it is called, how it is stored, and how it is filled from splats.
struct SplatColumn {
  std::string semantic;
  int components = 1;
  Component component = Component::Float;
  bool normalized = false;
  int bytes = 4;  ///< of a splat
  std::function<void(std::span<const Splat>, char*)> write;
};

/// Writes what `value` returns of each splat, byte for byte.
template <class Value>
std::function<void(std::span<const Splat>, char*)> each(Value value) {
  return [value](std::span<const Splat> splats, char* out) {
    for (const Splat& splat : splats) {
      const auto tuple = value(splat);
      std::memcpy(out, &tuple, sizeof tuple);
      out += sizeof tuple;
    }
  };
}

std::string splatting(std::string_view name) { return fmt::format("{}:{}", kSplatting, name); }

SplatColumn triple(std::string semantic, std::function<void(std::span<const Splat>, char*)> write) {
  return {std::move(semantic), 3, Component::Float, false, 3 * sizeof(float), std::move(write)};
}

/// COLOR_0 for viewers that draw points: linear, as core glTF wants it, with the opacity as alpha.
std::array<std::uint8_t, 4> fallbackColor(const Splat& splat) {
  const auto toByte = [](float unit) { return static_cast<std::uint8_t>(std::lround(255.0f * unit)); };
  const glm::vec3 linear = light::linearFromSrgb(splat.color);
  return {toByte(linear.x), toByte(linear.y), toByte(linear.z), toByte(splat.opacity)};
}

std::vector<SplatColumn> columnsOf(const SplatSource& source, glm::vec3 sunDirection, int degree) {
  std::vector<SplatColumn> columns{
      triple("POSITION", each([](const Splat& s) { return s.center; })),
      {splatting("ROTATION"), 4, Component::Float, false, 16,
       each([](const Splat& s) {
         return std::array{s.rotation.x, s.rotation.y, s.rotation.z, s.rotation.w};
       })},
      triple(splatting("SCALE"), each([](const Splat& s) { return s.sigma; })),
      {splatting("OPACITY"), 1, Component::Float, false, 4, each([](const Splat& s) { return s.opacity; })},
      triple(splatting("SH_DEGREE_0_COEF_0"),
             each([](const Splat& s) { return (s.color - 0.5f) / kHarmonic0; })),
      {"COLOR_0", 4, Component::UnsignedByte, true, 4, each(fallbackColor)}};
  const auto towardsSun = harmonicsTowards(sunDirection);
  for (int l = 1, coefficient = 0; l <= degree; ++l)
    for (int k = 0; k < 2 * l + 1; ++k)
      columns.push_back(triple(
          splatting(fmt::format("SH_DEGREE_{}_COEF_{}", l, k)),
          each([share = towardsSun[static_cast<std::size_t>(coefficient++)]](const Splat& s) {
            return s.towardsSun * share;
          })));
  if (source.dense)
    columns.push_back(
        {"_OPTICAL_DEPTH", 1, Component::Float, false, 4, each([](const Splat& s) { return s.opticalDepth; })});
  return columns;
}

/// Makes the splats and writes them into all columns, which follow each other.
void fill(const SplatSource& source, std::span<const SplatColumn> columns, std::span<char> out) {
  makeAll(source, [&](std::size_t first, std::span<const Splat> splats) {
    char* start = out.data();
    for (const SplatColumn& column : columns) {
      column.write(splats, start + first * static_cast<std::size_t>(column.bytes));
      start += source.count * static_cast<std::size_t>(column.bytes);
    }
  });
}

std::vector<double> threeOf(const glm::vec3& values) { return {values.x, values.y, values.z}; }

}  // namespace

const nlohmann::json& splattingExtension() {
  static const nlohmann::json kValue{{"kernel", "ellipse"},
                                     {"colorSpace", "srgb_rec709_display"},
                                     {"projection", "perspective"},
                                     {"sortingMethod", "cameraDistance"}};
  return kValue;
}

Attributes addSplats(GlbFile& file, SplatSource source, glm::vec3 sunDirection, int degree) {
  auto columns = columnsOf(source, sunDirection, degree);
  std::uint64_t bytes = 0;
  for (const SplatColumn& column : columns) bytes += source.count * static_cast<std::uint64_t>(column.bytes);
  const auto count = source.count;
  const auto lower = threeOf(source.lower), upper = threeOf(source.upper);
  std::uint64_t start = file.addBlock(
      bytes, [source = std::move(source), columns](std::span<char> out) { fill(source, columns, out); });
  Attributes attributes;
  for (const SplatColumn& column : columns) {
    Column stored{start, count, column.components, column.component, column.normalized};
    if (column.semantic == "POSITION") stored.least = lower, stored.most = upper;
    attributes.emplace_back(column.semantic, file.addColumn(stored));
    start += count * static_cast<std::uint64_t>(column.bytes);
  }
  return attributes;
}

}  // namespace cloudgen::writer::gltf
