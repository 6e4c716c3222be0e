// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/frame.hpp"
#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/options.hpp"
#include "shape/generate.hpp"

namespace cloudgen::pipeline {

inline constexpr int kVariants = 3;

/// What an archetype is shared by. Classes are logarithms in steps of the root of 2; that of the optical
/// depth is rounded by chance, so that the mean of many clouds is right where a format draws archetypes as
/// they are.
struct ArchetypeKey {
  base::Genus genus{};
  int aspectClass = 0, opticalDepthClass = 0, shearClass = 0, variant = 0;
  bool closed = false;  ///< cells without gaps between them
  int layerClass =
      0;  ///< of the optical depth of its layer (layerClassOf): decides how many puffs are seen at all
  int gatheringClass = 0;  ///< below 0: its water is gathered low in it, above 0: high
  auto operator<=>(const ArchetypeKey&) const = default;
};

/// Everything but the class of the optical depth, which a cloud has only when all of its layer stand. The
/// shape does not depend on it.
ArchetypeKey shapeKeyOf(const field::Layer& layer, std::uint32_t ordinal, double depthMeters,
                        double widthMeters, const Options& options);
ArchetypeKey keyOf(const field::Layer& layer, const field::Cloud& cloud, const Options& options);
/// The key of the same shape in the class 0 of optical depth.
ArchetypeKey shapeKeyOf(const ArchetypeKey& key);

/// The class that is nearest to an optical depth.
int opticalDepthClassOf(double opticalDepth);

/// The width nearest to `widthMeters` that an archetype of this depth has: what is drawn.
double drawnWidthMeters(double depthMeters, double widthMeters);

/// The archetype at scale 1: a twentieth of its extinction lies below 5 % and above 95 % of its depth, as in
/// an even layer, and no puff is so dense that its opacity could not be written.
struct ArchetypeShape {
  double widthMeters = 0, depthMeters = 0, opticalDepth = 0;
  shape::CloudShape cloud;
};
ArchetypeShape shapeOf(const ArchetypeKey& key, const Options& options, const Generalisation& general);

/// Optical depth of a class over that of class 0. A power of two: shapes, and depths in them, are bit by bit
/// those of class 0 times this.
double opticalDepthOver0(const ArchetypeKey& key);
/// shapeOf() of a key from that of its shapeKeyOf().
ArchetypeShape inClassOf(const ArchetypeKey& key, const ArchetypeShape& ofClass0);

/// The ground that a cloud covers, seen from above, in squares of its width, if it has an optical depth
/// there.
double groundCovered(std::span<const shape::Puff> puffs, double widthMeters, double opticalDepth);

/// The same cloud (of one puff at least) as a few puffs that cover as much ground.
std::vector<shape::Puff> fewerPuffs(std::span<const shape::Puff> puffs, int count, double widthMeters,
                                    double opticalDepth, double ground);

std::string nameOf(const ArchetypeKey& key);

/// The heading of a cloud, in steps of scene::kYawSteps: with the wind at its level where the recipe says so,
/// else any quarter turn by chance.
int yawStepOf(const field::Layer& layer, std::uint32_t ordinal, const field::GeoPoint& place,
              const Options& options, const base::LocalFrame& frame);

/// The random address of a cloud within its cell.
std::uint64_t itemOf(const field::Layer& layer, std::uint32_t ordinal);

}  // namespace cloudgen::pipeline
