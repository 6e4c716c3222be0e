// SPDX-License-Identifier: Apache-2.0
#include "pipeline/archetype.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cloudgen::pipeline {
namespace {

constexpr int kVariants = 4;
constexpr double kAspectStep = 1.4142135623730951, kOpticalDepthStep = 2.0;

int classOf(double value, double step) {
  return static_cast<int>(std::lround(std::log(value) / std::log(step)));
}

/// 0 calm, 1 sheared, 2 strongly sheared: the lean of the top over the depth is a quarter of the class.
int shearClassOf(const field::Layer& layer) {
  const double shear = std::hypot(layer.shearEast, layer.shearNorth);
  return shear < 6 ? 0 : (shear < 18 ? 1 : 2);
}

}  // namespace

std::uint64_t itemOf(const field::Layer& layer, std::uint32_t ordinal) {
  return (static_cast<std::uint64_t>(layer.ordinal) << 40) | ordinal;
}

int quarterTurnOf(const field::Layer& layer, std::uint32_t ordinal, const Options& options) {
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudYaw, itemOf(layer, ordinal));
  return stream.index(4);
}

ArchetypeKey shapeKeyOf(const field::Layer& layer, std::uint32_t ordinal, double depthMeters,
                        double widthMeters, const Options& options) {
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudVariant, itemOf(layer, ordinal));
  ArchetypeKey key;
  key.genus = layer.genus;
  key.aspectClass = classOf(depthMeters / widthMeters, kAspectStep);
  const shape::Form form = options.recipes.of(layer.genus).form;
  key.shearClass = form == shape::Form::Heap || form == shape::Form::Tower ? shearClassOf(layer) : 0;
  key.variant = stream.index(kVariants);
  return key;
}

ArchetypeKey keyOf(const field::Layer& layer, const field::Cloud& cloud, const Options& options) {
  ArchetypeKey key = shapeKeyOf(layer, cloud.ordinal, cloud.depthMeters, cloud.widthMeters, options);
  key.opticalDepthClass = classOf(std::max(0.05f, cloud.opticalDepth), kOpticalDepthStep);
  return key;
}

double drawnWidthMeters(double depthMeters, double widthMeters) {
  return depthMeters / std::pow(kAspectStep, classOf(depthMeters / widthMeters, kAspectStep));
}

shape::ShapeRequest requestOf(const ArchetypeKey& key, const Options& options,
                              const Generalisation& general) {
  const shape::Recipe& recipe = options.recipes.of(key.genus);
  shape::ShapeRequest request;
  request.depthMeters =
      std::sqrt(static_cast<double>(recipe.thicknessMeters.low) * recipe.thicknessMeters.high);
  request.widthMeters = request.depthMeters / std::pow(kAspectStep, key.aspectClass);
  request.opticalDepth = std::pow(kOpticalDepthStep, key.opticalDepthClass);
  request.tilt = 0.25 * key.shearClass;
  request.puffs = general.puffsPerCloud[static_cast<size_t>(key.genus)];
  request.seed = options.seed;
  request.variant = (static_cast<std::uint64_t>(key.genus) << 32) | static_cast<std::uint64_t>(key.variant);
  return request;
}

std::string nameOf(const ArchetypeKey& key) {
  const auto text = [](int value) {
    return value < 0 ? fmt::format("m{}", -value) : fmt::format("{}", value);
  };
  return fmt::format("{}_a{}_t{}_s{}_v{}", base::abbreviation(key.genus), text(key.aspectClass),
                     text(key.opticalDepthClass), key.shearClass, key.variant);
}

}  // namespace cloudgen::pipeline
