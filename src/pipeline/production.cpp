// SPDX-License-Identifier: Apache-2.0
#include "pipeline/production.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>
#include <tuple>

#include "base/thread.hpp"
#include "light/extinction_grid.hpp"
#include "light/shade.hpp"
#include "shape/generate.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr int kVariants = 4, kFarPuffs = 6;
constexpr double kAspectStep = 1.4142135623730951, kOpticalDepthStep = 2.0;

/// What an archetype is shared by. Classes are rounded logarithms.
struct ArchetypeKey {
  base::Genus genus{};
  int aspectClass = 0, opticalDepthClass = 0, shearClass = 0, variant = 0;
  auto operator<=>(const ArchetypeKey&) const = default;
};

int classOf(double value, double step) {
  return static_cast<int>(std::lround(std::log(value) / std::log(step)));
}

std::uint64_t cloudItem(const field::Layer& layer, const field::Cloud& cloud) {
  return (static_cast<std::uint64_t>(layer.ordinal) << 40) | cloud.ordinal;
}

/// 0 calm, 1 sheared, 2 strongly sheared: the lean of the top over the depth is a quarter of the class.
int shearClassOf(const field::Layer& layer) {
  const double shear = std::hypot(layer.shearEast, layer.shearNorth);
  return shear < 6 ? 0 : (shear < 18 ? 1 : 2);
}

ArchetypeKey keyOf(const field::Layer& layer, const field::Cloud& cloud, const Options& options) {
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudVariant, cloudItem(layer, cloud));
  ArchetypeKey key;
  key.genus = layer.genus;
  key.aspectClass = classOf(cloud.depthMeters / cloud.widthMeters, kAspectStep);
  key.opticalDepthClass = classOf(std::max(0.05f, cloud.opticalDepth), kOpticalDepthStep);
  const shape::Form form = options.recipes.of(layer.genus).form;
  key.shearClass = form == shape::Form::Heap || form == shape::Form::Tower ? shearClassOf(layer) : 0;
  key.variant = stream.index(kVariants);
  return key;
}

scene::Archetype makeArchetype(const ArchetypeKey& key, const Options& options,
                               const Generalisation& general) {
  const shape::Recipe& recipe = options.recipes.of(key.genus);
  const double aspect = std::pow(kAspectStep, key.aspectClass);
  shape::ShapeRequest request;
  request.depthMeters =
      std::sqrt(static_cast<double>(recipe.thicknessMeters.low) * recipe.thicknessMeters.high);
  request.widthMeters = request.depthMeters / aspect;
  request.opticalDepth = std::pow(kOpticalDepthStep, key.opticalDepthClass);
  request.tilt = 0.25 * key.shearClass;
  request.puffs = general.puffsPerCloud[static_cast<size_t>(key.genus)];
  request.seed = options.seed;
  request.variant = (static_cast<std::uint64_t>(key.genus) << 32) | static_cast<std::uint64_t>(key.variant);
  shape::CloudShape cloud = shape::generate(recipe, request);

  scene::Archetype archetype;
  const auto text = [](int value) {
    return value < 0 ? fmt::format("m{}", -value) : fmt::format("{}", value);
  };
  archetype.name = fmt::format("{}_a{}_t{}_s{}_v{}", base::abbreviation(key.genus), text(key.aspectClass),
                               text(key.opticalDepthClass), key.shearClass, key.variant);
  archetype.genus = key.genus;
  archetype.puffs = std::move(cloud.puffs);
  archetype.sectionStart = std::move(cloud.sectionStart);
  archetype.bounds = shape::boundsOf(archetype.puffs);
  archetype.widthMeters = static_cast<float>(request.widthMeters);
  archetype.depthMeters = static_cast<float>(request.depthMeters);
  archetype.opticalDepth = static_cast<float>(request.opticalDepth);
  archetype.farPuffs = shape::reduce(archetype.puffs, kFarPuffs);
  return archetype;
}

/// Cirrocumulus shows no shading at all, cirrus and cirrostratus next to none (WMO atlas).
float shadingOf(base::Genus genus) {
  if (genus == base::Genus::Cirrocumulus) return 0.05f;
  if (genus == base::Genus::Cirrus || genus == base::Genus::Cirrostratus) return 0.2f;
  return 1.0f;
}

/// The puffs as the light meets them: an element of a sheet stands among others that overlap it.
std::vector<shape::Puff> amongNeighbours(const scene::Archetype& archetype, const shape::Recipe& recipe) {
  std::vector<shape::Puff> puffs = archetype.puffs;
  const double layers = shape::footprintSquareMeters(archetype.widthMeters) /
                        coveredSquareMeters(recipe, archetype.widthMeters);
  for (shape::Puff& puff : puffs) puff.extinctionPerMeter *= static_cast<float>(layers);
  return puffs;
}

scene::LitArchetype lightArchetype(std::uint32_t index, int yawStep, const scene::Archetype& archetype,
                                   const shape::Recipe& recipe, const Origin& origin) {
  const glm::quat turnBack = glm::angleAxis(-scene::yawRadians(yawStep), glm::vec3(0, 1, 0));
  const light::Lighting lighting{turnBack * origin.sun.direction, origin.sun.color, origin.sky};
  const int cells =
      std::clamp(static_cast<int>(5.0 * std::cbrt(static_cast<double>(archetype.puffs.size()))), 20, 90);
  const light::ExtinctionGrid grid(amongNeighbours(archetype, recipe), cells);
  scene::LitArchetype lit;
  lit.archetype = index;
  lit.yawStep = yawStep;
  lit.puffs = light::shadePuffs(archetype.puffs, grid, lighting, shadingOf(archetype.genus));
  lit.farPuffs = light::averageLight(archetype.puffs, lit.puffs, archetype.farPuffs);
  return lit;
}

/// The heading of an element: with the wind at its level, or any quarter turn by chance.
int yawStepOf(const field::Layer& layer, const field::Cloud& cloud, const Options& options,
              const base::LocalFrame& frame) {
  if (options.recipes.of(layer.genus).alongWind && std::hypot(layer.windEast, layer.windNorth) > 0.5) {
    const glm::dvec2 east = frame.eastDirection(cloud.longitudeDegrees, cloud.latitudeDegrees);
    const double x = layer.windEast * east.x + layer.windNorth * east.y,
                 z = layer.windEast * east.y - layer.windNorth * east.x;
    const double steps = std::atan2(-z, x) / (2.0 * std::numbers::pi) * scene::kYawSteps;
    return (static_cast<int>(std::lround(steps)) + scene::kYawSteps) % scene::kYawSteps;
  }
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudYaw, cloudItem(layer, cloud));
  return 4 * stream.index(4);
}

std::uint64_t cloudId(const field::Layer& layer, const field::Cloud& cloud) {
  return (static_cast<std::uint64_t>(layer.cell) << 32) |
         (static_cast<std::uint64_t>(layer.ordinal & 0xff) << 24) | (cloud.ordinal & 0xffffff);
}

}  // namespace

scene::Scene produce(const field::CloudTable& table, const Origin& origin, const Options& options,
                     const Generalisation& general, base::UtcTime validTime, const base::Progress& progress) {
  scene::Scene scene{origin.frame, validTime, origin.sun, origin.sky, options.seed, {}, {}, {}, {}, {}, 0};
  scene.groundHeightMeters = origin.ground.lowestMeters;
  scene.terrain = origin.ground.terrain;
  std::map<ArchetypeKey, std::uint32_t> archetypeOf;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> litOf;
  std::vector<ArchetypeKey> keys;
  std::vector<std::pair<std::uint32_t, int>> lits;
  for (const field::Cloud& cloud : table.clouds) {
    const field::Layer& layer = table.layers[cloud.layer];
    const ArchetypeKey key = keyOf(layer, cloud, options);
    const auto [archetype, isNewArchetype] =
        archetypeOf.try_emplace(key, static_cast<std::uint32_t>(keys.size()));
    if (isNewArchetype) keys.push_back(key);
    const auto [lit, isNewLit] =
        litOf.try_emplace({archetype->second, yawStepOf(layer, cloud, options, origin.frame)},
                          static_cast<std::uint32_t>(lits.size()));
    if (isNewLit) lits.push_back(lit->first);

    scene::Instance instance;
    instance.lit = lit->second;
    instance.position = origin.frame.toScene(cloud.longitudeDegrees, cloud.latitudeDegrees, cloud.baseMeters);
    scene.instances.push_back(instance);
    scene.clouds.push_back({cloudId(layer, cloud), layer.genus, std::string(layer.rule), layer.cell,
                            cloud.longitudeDegrees, cloud.latitudeDegrees, cloud.baseMeters,
                            cloud.baseMeters + cloud.depthMeters, cloud.opticalDepth, layer.ordinal});
  }

  scene.archetypes.resize(keys.size());
  base::parallelFor(keys.size(), [&](size_t i) {
    if (progress.cancelled && progress.cancelled()) return;
    scene.archetypes[i] = makeArchetype(keys[i], options, general);
  });
  progress.step("production: light", 0.4);
  scene.lit.resize(lits.size());
  base::parallelFor(lits.size(), [&](size_t i) {
    if (progress.cancelled && progress.cancelled()) return;
    const scene::Archetype& archetype = scene.archetypes[lits[i].first];
    scene.lit[i] =
        lightArchetype(lits[i].first, lits[i].second, archetype, options.recipes.of(archetype.genus), origin);
  });
  progress.step("production: light", 1);

  for (size_t i = 0; i < scene.instances.size(); ++i) {
    scene::Instance& instance = scene.instances[i];
    const field::Cloud& cloud = table.clouds[i];
    const scene::Archetype& archetype = scene.archetypes[scene.lit[instance.lit].archetype];
    instance.scale = cloud.depthMeters / archetype.depthMeters;
    const double footprint = shape::footprintSquareMeters(archetype.widthMeters * instance.scale);
    instance.opticalDepthFactor =
        static_cast<float>(cloud.opticalDepth / archetype.opticalDepth *
                           shape::footprintSquareMeters(cloud.widthMeters) / footprint);
  }
  return scene;
}

}  // namespace cloudgen::pipeline
