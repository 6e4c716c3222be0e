// SPDX-License-Identifier: Apache-2.0
#include "pipeline/production.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>

#include "base/thread.hpp"
#include "light/extinction_grid.hpp"
#include "light/genus_light.hpp"
#include "light/shade.hpp"
#include "light/shadow.hpp"
#include "pipeline/archetype.hpp"
#include "pipeline/canvas.hpp"
#include "shape/blending.hpp"
#include "shape/generate.hpp"

namespace cloudgen::pipeline {
namespace {

/// `footprint`: of the shape, whatever its class of optical depth.
scene::Archetype makeArchetype(const ArchetypeKey& key, ArchetypeShape shape, const Footprint& footprint) {
  scene::Archetype archetype;
  archetype.name = nameOf(key);
  archetype.genus = key.genus;
  archetype.puffs = std::move(shape.cloud.puffs);
  archetype.sectionStart = std::move(shape.cloud.sectionStart);
  archetype.bounds = shape::boundsOf(archetype.puffs);
  archetype.widthMeters = static_cast<float>(shape.widthMeters);
  archetype.depthMeters = static_cast<float>(shape.depthMeters);
  archetype.opticalDepth = static_cast<float>(shape.opticalDepth);
  archetype.covering = shape::coveringOf(archetype.puffs);
  constexpr int kFarPuffs = 6;
  const double width = shape.widthMeters, depth = shape.opticalDepth,
               ground = footprint.coveredAlone(depth, kCoveringOpticalDepth);
  archetype.farPuffs = fewerPuffs(archetype.puffs, kFarPuffs, width, depth, ground);
  archetype.farCovering = shape::coveringOf(archetype.farPuffs);
  archetype.onePuff = fewerPuffs(archetype.puffs, 1, width, depth, ground).front();
  return archetype;
}

/// The puffs as the light meets them: an element of a sheet stands among others that overlap it.
std::vector<shape::Puff> amongNeighbours(const ArchetypeShape& shape, const shape::Recipe& recipe) {
  std::vector<shape::Puff> puffs = shape.cloud.puffs;
  const auto width = static_cast<float>(shape.widthMeters);
  const double layers = shape::footprintSquareMeters(width) / coveredSquareMeters(recipe, width);
  for (shape::Puff& puff : puffs) puff.extinctionPerMeter *= static_cast<float>(layers);
  return puffs;
}

light::CloudDepths depthsOf(const ArchetypeShape& shape, const shape::Recipe& recipe) {
  const auto& puffs = shape.cloud.puffs;
  const int cells = light::cellsAlongLongestFor(puffs.size());
  return light::depthsIn(puffs, light::ExtinctionGrid(amongNeighbours(shape, recipe), cells));
}

scene::LitArchetype lightArchetype(std::uint32_t index, int yawStep, const scene::Archetype& archetype,
                                   const light::CloudTransfer& transfer, const Origin& origin) {
  const glm::quat turnBack = glm::angleAxis(-scene::yawRadians(yawStep), glm::vec3(0, 1, 0));
  const light::KeyLight key = light::keyLight(origin.sun, origin.moon, light::lightHeightOf(archetype.genus));
  const light::Lighting lighting{turnBack * key.direction, key.color, origin.sky};
  scene::LitArchetype lit;
  lit.archetype = index;
  lit.yawStep = yawStep;
  lit.puffs = light::shadePuffs(archetype.puffs, transfer, lighting, light::shadingOf(archetype.genus));
  lit.farPuffs = light::averageLight(archetype.puffs, lit.puffs, archetype.farPuffs);
  lit.onePuff = light::averageLight(archetype.puffs, lit.puffs, std::span(&archetype.onePuff, 1)).front();
  return lit;
}

std::uint64_t cloudId(const field::Layer& layer, const field::Cloud& cloud) {
  return (static_cast<std::uint64_t>(layer.cell) << 32) |
         (static_cast<std::uint64_t>(layer.ordinal & 0xff) << 24) | (cloud.ordinal & 0xffffff);
}

}  // namespace

scene::Scene produce(const field::CloudTable& table, const Origin& origin, const Options& options,
                     const Generalisation& general, base::UtcTime validTime, const base::Progress& progress) {
  scene::Scene scene{origin.frame, validTime, origin.sun, origin.sky, options.seed};
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
    const auto [lit, isNewLit] = litOf.try_emplace(
        {archetype->second, yawStepOf(layer, cloud.ordinal, {cloud.longitudeDegrees, cloud.latitudeDegrees},
                                      options, origin.frame)},
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
  scene.lit.resize(lits.size());
  std::vector<std::vector<std::uint32_t>> litsOf(keys.size());
  for (std::uint32_t i = 0; i < lits.size(); ++i) litsOf[lits[i].first].push_back(i);
  // One shape, and one set of sweeps through it, for all classes of optical depth that it stands in.
  std::map<ArchetypeKey, std::vector<std::uint32_t>> sharing;
  for (std::uint32_t i = 0; i < keys.size(); ++i) sharing[shapeKeyOf(keys[i])].push_back(i);
  const std::vector<std::pair<ArchetypeKey, std::vector<std::uint32_t>>> shapes(sharing.begin(), sharing.end());
  progress.step("production: light", 0.4);
  base::parallelFor(shapes.size(), [&](size_t i) {
    if (progress.cancelled && progress.cancelled()) return;
    const auto& [shapeKey, members] = shapes[i];
    const ArchetypeShape shape = shapeOf(shapeKey, options, general);
    const Footprint footprint(shape.cloud.puffs, shape.widthMeters);
    const light::CloudDepths depths =
        depthsOf(shape, options.recipes.of(shapeKey.genus, isThin(shapeKey.layerClass)));
    for (const std::uint32_t a : members) {
      scene::Archetype& archetype = scene.archetypes[a] = makeArchetype(keys[a], inClassOf(keys[a], shape), footprint);
      const light::CloudTransfer transfer =
          light::bakeTransfer(archetype.puffs, depths, light::asymmetryOf(archetype.genus),
                              static_cast<float>(opticalDepthOver0(keys[a])));
      archetype.response = light::responseOf(archetype.puffs, transfer, light::shadingOf(archetype.genus),
                                             static_cast<float>(light::lightHeightOf(archetype.genus)));
      for (const std::uint32_t k : litsOf[a])
        scene.lit[k] = lightArchetype(lits[k].first, lits[k].second, archetype, transfer, origin);
    }
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
  std::vector<light::Caster> casters;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const field::Cloud& cloud = table.clouds[i];
    casters.push_back({scene.instances[i].position, static_cast<float>(0.5 * cloud.widthMeters),
                       static_cast<float>(cloud.depthMeters), static_cast<float>(cloud.opticalDepth)});
  }
  light::Shadows shadows = light::shadowsOf(casters, origin.shading);
  for (size_t i = 0; i < shadows.sunlight.size(); ++i) scene.instances[i].sunlight = shadows.sunlight[i];
  scene.shadows = std::move(shadows.whole);
  return scene;
}

}  // namespace cloudgen::pipeline
