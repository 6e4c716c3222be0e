// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tile_splats.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "writer/gltf/splat_columns.hpp"
#include "writer/gltf/spz.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

using gltf::Attributes;
using gltf::GlbFile;
using gltf::Splat;

/// Packed deviations end at 379 units.
constexpr double kMetersPerUnit = 1000;
/// Neighbours as near as this are turned alike: less than 2 minutes of arc apart.
constexpr float kAlikeMeters = 2000;
/// Opacities in a byte tell little of what is denser than this.
constexpr float kTellingOpticalDepth = 4;

/// The accessors that a packed primitive has, without bytes of their own. Some viewers count those of the
/// harmonics to learn the degree, so that of degree 0, which is COLOR_0, is left out.
Attributes unpackedAttributes(GlbFile& file, std::span<const Splat> splats, int degree) {
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
  for (int l = 1; l <= degree; ++l)
    for (int k = 0; k < 2 * l + 1; ++k)
      attributes.emplace_back(splatting(fmt::format("SH_DEGREE_{}_COEF_{}", l, k)),
                              file.addUnpacked(3, splats.size()));
  return attributes;
}

/// Null where opacities tell all.
nlohmann::json opticalDepthExtras(GlbFile& file, std::span<const Splat> splats) {
  float least = 1e30f, most = 0;
  for (const Splat& splat : splats) {
    least = std::min(least, splat.opticalDepth);
    most = std::max(most, splat.opticalDepth);
  }
  if (most <= kTellingOpticalDepth) return nullptr;
  const float offset = std::log(least), scale = std::log(most) - offset;
  std::string bytes;
  for (const Splat& splat : splats)
    bytes += static_cast<char>(std::lround(255 * (std::log(splat.opticalDepth) - offset) / scale));
  return {{"opticalDepths", {{"bufferView", file.addBytes(bytes)}, {"offset", offset}, {"scale", scale}}}};
}

}  // namespace

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

void addPackedSplats(GlbFile& file, const std::string& name, std::span<const Splat> splats,
                     glm::vec3 sunDirection, int degree) {
  nlohmann::json extension = gltf::splattingExtension();
  extension["extensions"][kPackedExtension]["bufferView"] =
      file.addBytes(gltf::packedSplats(splats, sunDirection, kMetersPerUnit, degree));
  const int mesh = file.addMesh(name, {.attributes = unpackedAttributes(file, splats, degree),
                                       .points = true,
                                       .extensions = {{gltf::kSplatting, &extension}}});
  const nlohmann::json extras = opticalDepthExtras(file, splats);
  file.addNode({.name = name,
                .mesh = mesh,
                .metersPerUnit = kMetersPerUnit,
                .extras = extras.is_null() ? nullptr : &extras});
}

void addPlainSplats(GlbFile& file, const std::string& name, std::span<const Splat> splats,
                    glm::vec3 sunDirection, int degree) {
  const int mesh =
      file.addMesh(name, {.attributes = gltf::addSplats(file, gltf::sourceOf(splats), sunDirection, degree),
                          .points = true,
                          .extensions = {{gltf::kSplatting, &gltf::splattingExtension()}}});
  file.addNode({.name = name, .mesh = mesh});
}

}  // namespace cloudgen::writer::tiles3d
