// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "field/cloud_table.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/options.hpp"
#include "shape/generate.hpp"

namespace cloudgen::pipeline {

/// What an archetype is shared by. Classes are rounded logarithms: of the aspect in steps of the root of 2,
/// of the optical depth in steps of 2.
struct ArchetypeKey {
  base::Genus genus{};
  int aspectClass = 0, opticalDepthClass = 0, shearClass = 0, variant = 0;
  auto operator<=>(const ArchetypeKey&) const = default;
};

/// Everything but the class of the optical depth, which a cloud has only when all of its layer stand. The
/// shape does not depend on it.
ArchetypeKey shapeKeyOf(const field::Layer& layer, std::uint32_t ordinal, double depthMeters,
                        double widthMeters, const Options& options);
ArchetypeKey keyOf(const field::Layer& layer, const field::Cloud& cloud, const Options& options);

/// The width nearest to `widthMeters` that an archetype of this depth has: what is drawn.
double drawnWidthMeters(double depthMeters, double widthMeters);

/// The archetype's own shape, at scale 1.
shape::ShapeRequest requestOf(const ArchetypeKey& key, const Options& options, const Generalisation& general);

std::string nameOf(const ArchetypeKey& key);

/// The heading of a cloud that does not follow the wind, in quarter turns.
int quarterTurnOf(const field::Layer& layer, std::uint32_t ordinal, const Options& options);

/// The random address of a cloud within its cell.
std::uint64_t itemOf(const field::Layer& layer, std::uint32_t ordinal);

}  // namespace cloudgen::pipeline
