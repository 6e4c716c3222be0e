// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat_columns.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "light/color.hpp"

namespace cloudgen::writer::gltf {
namespace {

/// Writes something of each splat, so many bytes from one to the next.
using WriteSplats = std::function<void(std::span<const Splat>, char*, std::size_t stride)>;

/// One column: what it is called, how it is stored, and how it is filled from splats.
struct SplatColumn {
  std::string semantic;
  int components = 1;
  Component component = Component::Float;
  bool normalized = false;
  int bytes = 4;  ///< of a splat
  WriteSplats write;
  std::uint64_t start = 0;  ///< in the block
};

/// Writes what `value` returns of each splat, byte for byte.
template <class Value>
WriteSplats each(Value value) {
  return [value](std::span<const Splat> splats, char* out, std::size_t stride) {
    for (const Splat& splat : splats) {
      const auto tuple = value(splat);
      std::memcpy(out, &tuple, sizeof tuple);
      out += stride;
    }
  };
}

std::string splatting(std::string_view name) { return fmt::format("{}:{}", kSplatting, name); }

SplatColumn triple(std::string semantic, WriteSplats write) {
  return {std::move(semantic), 3, Component::Float, false, 3 * sizeof(float), std::move(write)};
}

/// COLOR_0 for viewers that draw points: linear, as core glTF wants it, with the opacity as alpha.
std::array<std::uint8_t, 4> fallbackColor(const Splat& splat) {
  const auto toByte = [](float unit) { return static_cast<std::uint8_t>(std::lround(255.0f * unit)); };
  const glm::vec3 linear = light::linearFromSrgb(splat.color);
  return {toByte(linear.x), toByte(linear.y), toByte(linear.z), toByte(splat.opacity)};
}

glm::vec3 harmonic0(const Splat& splat) { return (splat.color - 0.5f) / kHarmonic0; }

/// Those of degree 1 and up.
void addHarmonics(std::vector<SplatColumn>& columns, glm::vec3 sunDirection, int degree) {
  const auto towardsSun = harmonicsTowards(sunDirection);
  for (int l = 1, coefficient = 0; l <= degree; ++l)
    for (int k = 0; k < 2 * l + 1; ++k)
      columns.push_back(triple(
          splatting(fmt::format("SH_DEGREE_{}_COEF_{}", l, k)),
          each([share = towardsSun[static_cast<std::size_t>(coefficient++)]](const Splat& s) {
            return s.towardsSun * share;
          })));
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
      triple(splatting("SH_DEGREE_0_COEF_0"), each(harmonic0)),
      {"COLOR_0", 4, Component::UnsignedByte, true, 4, each(fallbackColor)}};
  addHarmonics(columns, sunDirection, degree);
  if (source.dense)
    columns.push_back(
        {"_OPTICAL_DEPTH", 1, Component::Float, false, 4, each([](const Splat& s) { return s.opticalDepth; })});
  return columns;
}

glm::vec3 unitsFrom(const glm::vec3& place, const SplatUnit& unit) {
  return glm::clamp(glm::round((place - unit.lower) / unit.meters), 0.0f, 65535.0f);
}

template <class Whole>
Whole rounded(float value) {
  return static_cast<Whole>(std::lround(std::min(value, static_cast<float>(std::numeric_limits<Whole>::max()))));
}

/// In the order in which they lie in a record.
std::vector<SplatColumn> quantizedColumnsOf(const SplatUnit& unit, bool dense, glm::vec3 sunDirection, int degree) {
  const SplatColumn opticalDepth{"_OPTICAL_DEPTH", 1, Component::UnsignedShort, false, 2, each([](const Splat& s) {
                                   return rounded<std::uint16_t>(s.opticalDepth / kOpticalDepthStep);
                                 })};
  std::vector<SplatColumn> columns{
      {"POSITION", 3, Component::UnsignedShort, false, 6, each([unit](const Splat& s) {
         const glm::vec3 place = unitsFrom(s.center, unit);
         return std::array{rounded<std::uint16_t>(place.x), rounded<std::uint16_t>(place.y),
                           rounded<std::uint16_t>(place.z)};
       })},
      {splatting("OPACITY"), 1, Component::UnsignedShort, true, 2,
       each([](const Splat& s) { return rounded<std::uint16_t>(65535 * s.opacity); })},
      {splatting("ROTATION"), 4, Component::Byte, true, 4, each([](const Splat& s) {
         const glm::quat q = 127.0f * s.rotation;
         return std::array{rounded<std::int8_t>(q.x), rounded<std::int8_t>(q.y), rounded<std::int8_t>(q.z),
                           rounded<std::int8_t>(q.w)};
       })},
      {splatting("SCALE"), 3, Component::Short, false, 6, each([unit](const Splat& s) {
         const glm::vec3 sigma = glm::max(s.sigma / unit.meters, 1.0f);
         return std::array{rounded<std::int16_t>(sigma.x), rounded<std::int16_t>(sigma.y),
                           rounded<std::int16_t>(sigma.z)};
       })},
      opticalDepth,
      triple(splatting("SH_DEGREE_0_COEF_0"), each(harmonic0))};
  addHarmonics(columns, sunDirection, degree);
  std::uint64_t at = 0;
  for (SplatColumn& column : columns) column.start = std::exchange(at, at + static_cast<std::uint64_t>(column.bytes));
  if (!dense) std::erase_if(columns, [](const SplatColumn& column) { return column.semantic == "_OPTICAL_DEPTH"; });
  return columns;
}

/// Makes the splats and writes them into all columns. The next splat of a column is `stride` bytes on; 0: as many as
/// one has.
void fill(const SplatSource& source, std::span<const SplatColumn> columns, std::size_t stride, std::span<char> out) {
  makeAll(source, [&](std::size_t first, std::span<const Splat> splats) {
    for (const SplatColumn& column : columns) {
      const std::size_t step = stride ? stride : static_cast<std::size_t>(column.bytes);
      column.write(splats, out.data() + column.start + first * step, step);
    }
  });
}

/// Adds a block of so many bytes that the columns fill.
Attributes addColumns(GlbFile& file, SplatSource source, const std::vector<SplatColumn>& columns, std::uint64_t bytes,
                      std::size_t stride, const std::vector<double>& lower, const std::vector<double>& upper) {
  const auto count = source.count;
  const std::uint64_t start = file.addBlock(bytes, [source = std::move(source), columns, stride](std::span<char> out) {
    fill(source, columns, stride, out);
  });
  Attributes attributes;
  for (const SplatColumn& column : columns) {
    Column stored{start + column.start, count, column.components, column.component, column.normalized,
                  static_cast<int>(stride)};
    if (column.semantic == "POSITION") stored.least = lower, stored.most = upper;
    attributes.emplace_back(column.semantic, file.addColumn(stored));
  }
  return attributes;
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
  for (SplatColumn& column : columns)
    column.start = std::exchange(bytes, bytes + source.count * static_cast<std::uint64_t>(column.bytes));
  const auto lower = threeOf(source.lower), upper = threeOf(source.upper);
  return addColumns(file, std::move(source), columns, bytes, 0, lower, upper);
}

SplatUnit unitOf(const SplatSource& source) {
  constexpr float kFinestMeters = 0.001f;
  const glm::vec3 extent = source.upper - source.lower;
  return {source.lower, std::max({extent.x / 65535, extent.y / 65535, extent.z / 65535, source.mostSigma / 32767,
                                  kFinestMeters})};
}

Attributes addQuantizedSplats(GlbFile& file, SplatSource source, glm::vec3 sunDirection, int degree,
                              const SplatUnit& unit) {
  const auto columns = quantizedColumnsOf(unit, source.dense, sunDirection, degree);
  const std::size_t record = columns.back().start + static_cast<std::size_t>(columns.back().bytes);
  const auto lower = threeOf(unitsFrom(source.lower, unit)), upper = threeOf(unitsFrom(source.upper, unit));
  // The view of a column that starts within a record ends within one more.
  const std::uint64_t bytes = (source.count + 1) * record;
  return addColumns(file, std::move(source), columns, bytes, record, lower, upper);
}

}  // namespace cloudgen::writer::gltf
