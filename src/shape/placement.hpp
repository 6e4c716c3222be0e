// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/random.hpp"

namespace cloudgen::shape {

/// The coordinate systems in which Murphy 2008 (ch. III.B.4) scatters sections and billboards.
enum class CoordinateSystem { Cubic, Cylindrical, Conical, Spherical, HalfSpherical };

/// Literal: the formulas as printed (they crowd the axis). Uniform: the same region, uniform in volume.
/// Incremental: one coordinate (radius or height) is stepped by its maximum over the count, not drawn, so
/// that billboards do not pile up.
enum class PlacementVariant { Literal, Uniform, Incremental };

/// A region and how to fill it, in metres. Every region stands on or hangs about the origin, y up.
struct Placement {
  CoordinateSystem system = CoordinateSystem::HalfSpherical;
  PlacementVariant variant = PlacementVariant::Uniform;
  double radius = 1;                         ///< M: largest radius; edge length C of the cube
  double height = 1;                         ///< H of cylinder and cone
  double angleRadians = 0.7853981633974483;  ///< alpha: opening of the "cylindrical" system
};

/// `count` points. Cubic: [0,C)^3. Cylindrical: 0 <= y < H, r <= (H - y) tan(alpha). Conical: r <= M, 0 <= y
/// < H. Spherical: |p| <= M; half-spherical: the same with y >= 0.
std::vector<glm::dvec3> place(const Placement& placement, int count, base::RandomStream& stream);

std::optional<CoordinateSystem> coordinateSystemFromName(std::string_view name);
std::optional<PlacementVariant> placementVariantFromName(std::string_view name);

/// One system a file.
std::vector<glm::dvec3> placeCubic(const Placement&, int count, base::RandomStream&);
std::vector<glm::dvec3> placeCylindrical(const Placement&, int count, base::RandomStream&);
std::vector<glm::dvec3> placeConical(const Placement&, int count, base::RandomStream&);
std::vector<glm::dvec3> placeSpherical(const Placement&, int count, base::RandomStream&);

}  // namespace cloudgen::shape
