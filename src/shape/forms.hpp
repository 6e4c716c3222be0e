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
  glm::dvec3 facing{0, 1, 0};  ///< out of the cloud: where it has room to bulge
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

/// Up to `children` on each lobe of the last level, where it faces and nothing buries them.
void growLobes(std::vector<Lobe>& lobes, int level, int children, double ratio, base::RandomStream& stream);

/// Lobes one above the other from the base to `top`, narrowing as they rise (air mixes in from the sides).
/// `foot`: where it stands; its radius there; `lean`: metres downwind a metre of height.
void raiseTurret(std::vector<Lobe>& lobes, const Lobe& foot, double top, double lean,
                 base::RandomStream& stream);

/// Draws lobes up or down by one factor, so that the highest ends at a height.
void reachTo(std::vector<Lobe>& lobes, double heightMeters);

/// Fills lobes with about `count` puffs: small ones near the outer surface, larger ones inside. Puffs that
/// other lobes bury are drawn anew. `floorMeters`: nothing sinks below; the base is flat there.
void fillLobes(std::vector<Puff>& puffs, const std::vector<Lobe>& lobes, const Recipe& recipe, int count,
               double floorMeters, base::RandomStream& stream);

/// Thin ice between filaments, as wide as they: long soft strands that bend with the shear.
void addStrands(std::vector<Puff>& puffs, const ShapeRequest& request, std::uint16_t section);

/// The rotation that turns +x into a direction.
glm::quat turnedAlong(const glm::dvec3& direction);

/// Vertical shafts of rain or snow from the base down to the ground or to where they dry up.
void addPrecipitation(std::vector<Puff>& puffs, const Recipe& recipe, const glm::dvec3& center, double radius,
                      double length, int count, base::RandomStream& stream);

}  // namespace cloudgen::shape
