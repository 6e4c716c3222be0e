// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape/generate.hpp"

namespace cloudgen::shape {

/// A section: a soft ellipsoid that holds billboards.
struct Lobe {
  glm::dvec3 center{0};
  double radius = 1;
  std::uint16_t section = 0;
  int level = 0;  ///< 0: placed by the recipe; 1, 2: grown on another lobe
};

/// Puffs with extinction relative to each other; precipitation is kept apart because it does not count for
/// the optical depth.
struct RawShape {
  std::vector<Puff> puffs, precipitation;
};

/// One form a file.
RawShape shapeHeap(const Recipe&, const ShapeRequest&);
RawShape shapeTower(const Recipe&, const ShapeRequest&);
RawShape shapeCells(const Recipe&, const ShapeRequest&);
RawShape shapeVeil(const Recipe&, const ShapeRequest&);
RawShape shapeFilaments(const Recipe&, const ShapeRequest&);

/// Children on the upper surface of each lobe of the last level, at about half its radius.
void growLobes(std::vector<Lobe>& lobes, int level, int children, double ratio, base::RandomStream& stream);

/// Fills lobes with about `count` puffs: small ones near the outer surface, larger ones inside. Puffs that
/// other lobes bury are drawn anew. `floorMeters`: nothing sinks below; the base is flat there.
void fillLobes(std::vector<Puff>& puffs, const std::vector<Lobe>& lobes, const Recipe& recipe, int count,
               double floorMeters, base::RandomStream& stream);

/// The rotation that turns +x into a direction.
glm::quat turnedAlong(const glm::dvec3& direction);

/// Vertical shafts of rain or snow from the base down to the ground or to where they dry up.
void addPrecipitation(std::vector<Puff>& puffs, const Recipe& recipe, const glm::dvec3& center, double radius,
                      double length, int count, base::RandomStream& stream);

}  // namespace cloudgen::shape
