// SPDX-License-Identifier: Apache-2.0
#include "pipeline/production.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>

#include "base/thread.hpp"
#include "light/extinction_grid.hpp"
#include "light/shade.hpp"
#include "pipeline/archetype.hpp"
#include "shape/generate.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr int kFarPuffs = 6;

scene::Archetype makeArchetype(const ArchetypeKey& key, const Options& options,
                               const Generalisation& general) {
  const shape::ShapeRequest request = requestOf(key, options, general);
  shape::CloudShape cloud = shape::generate(options.recipes.of(key.genus), request);

  scene::Archetype archetype;
  archetype.name = nameOf(key);
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
  return 4 * quarterTurnOf(layer, cloud.ordinal, options);
}

std::uint64_t cloudId(const field::Layer& layer, const field::Cloud& cloud) {
  return (static_cast<std::uint64_t>(layer.cell) << 28) |
         (static_cast<std::uint64_t>(layer.ordinal & 15) << 24) | (cloud.ordinal & 0xffffff);
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
                            cloud.baseMeters + cloud.depthMeters, cloud.opticalDepth});
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

  // What falls out of a cloud is a part of its optical depth.
  std::vector<double> waterOf;
  for (const scene::Archetype& archetype : scene.archetypes) {
    double water = 0;
    for (const shape::Puff& puff : archetype.puffs) water += shape::extinctionArea(puff);
    waterOf.push_back(water);
  }
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    scene::Instance& instance = scene.instances[i];
    const field::Cloud& cloud = table.clouds[i];
    const scene::Archetype& archetype = scene.archetypes[scene.lit[instance.lit].archetype];
    instance.scale = cloud.depthMeters / archetype.depthMeters;
    instance.opticalDepthFactor =
        static_cast<float>(cloud.opticalDepth * shape::footprintSquareMeters(cloud.widthMeters) /
                           (waterOf[scene.lit[instance.lit].archetype] * instance.scale * instance.scale));
  }
  return scene;
}

}  // namespace cloudgen::pipeline
