// SPDX-License-Identifier: Apache-2.0
#include "shape/placement.hpp"

#include <array>
#include <utility>

namespace cloudgen::shape {

std::vector<glm::dvec3> place(const Placement& placement, int count, base::RandomStream& stream) {
  switch (placement.system) {
    case CoordinateSystem::Cubic:
      return placeCubic(placement, count, stream);
    case CoordinateSystem::Cylindrical:
      return placeCylindrical(placement, count, stream);
    case CoordinateSystem::Conical:
      return placeConical(placement, count, stream);
    case CoordinateSystem::Spherical:
    case CoordinateSystem::HalfSpherical:
      break;
  }
  return placeSpherical(placement, count, stream);
}

std::optional<CoordinateSystem> coordinateSystemFromName(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, CoordinateSystem>, 5> kNames{
      {{"cubic", CoordinateSystem::Cubic},
       {"cylindrical", CoordinateSystem::Cylindrical},
       {"conical", CoordinateSystem::Conical},
       {"spherical", CoordinateSystem::Spherical},
       {"half_spherical", CoordinateSystem::HalfSpherical}}};
  for (const auto& [text, system] : kNames)
    if (text == name) return system;
  return std::nullopt;
}

std::optional<PlacementVariant> placementVariantFromName(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlacementVariant>, 3> kNames{
      {{"literal", PlacementVariant::Literal},
       {"uniform", PlacementVariant::Uniform},
       {"incremental", PlacementVariant::Incremental}}};
  for (const auto& [text, variant] : kNames)
    if (text == name) return variant;
  return std::nullopt;
}

}  // namespace cloudgen::shape
