// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/random.hpp"
#include "scene/scene.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::test {

/// A heap of `puffs` round puffs, dark below and bright above, 1 km wide and 500 m high.
inline scene::Archetype heap(const std::string& name, base::Genus genus, int puffs) {
  scene::Archetype archetype{
      .name = name, .genus = genus, .widthMeters = 1000, .depthMeters = 1000, .opticalDepth = 12};
  base::RandomStream random(1, 2, base::Purpose::Test);
  for (int i = 0; i < puffs; ++i) {
    const glm::dvec3 direction = random.direction();
    shape::Puff puff;
    puff.center = glm::vec3(direction.x * 420, 40 + std::abs(direction.y) * 400, direction.z * 420);
    puff.sigma = glm::vec3(60, 45, 60);
    puff.extinctionPerMeter = 0.008f;
    archetype.puffs.push_back(puff);
  }
  for (int i = 0; i < 4; ++i) {
    shape::Puff puff;
    puff.center = glm::vec3(i % 2 ? 150 : -150, 150 + 100 * (i / 2), i < 2 ? 100 : -100);
    puff.sigma = glm::vec3(190, 120, 190);
    puff.extinctionPerMeter = 0.008f;
    puff.sprite = static_cast<std::uint16_t>(i);
    archetype.farPuffs.push_back(puff);
  }
  archetype.onePuff = shape::reduce(archetype.puffs, 1).front();
  archetype.sectionStart = {0, static_cast<std::uint32_t>(puffs)};
  archetype.bounds = shape::boundsOf(archetype.puffs);
  return archetype;
}

/// Two long fibres, one of them too thin to be seen.
inline scene::Archetype fibres() {
  scene::Archetype archetype{.name = "Ci_1",
                             .genus = base::Genus::Cirrus,
                             .widthMeters = 3000,
                             .depthMeters = 400,
                             .opticalDepth = 0.3f};
  shape::Puff puff;
  puff.center = glm::vec3(100, 20, -30);
  puff.sigma = glm::vec3(700, 30, 80);
  puff.rotation = glm::angleAxis(0.5f, glm::normalize(glm::vec3(0.2f, 1, 0.1f)));
  puff.extinctionPerMeter = 0.002f;
  archetype.puffs = {puff, puff};
  archetype.puffs[1].extinctionPerMeter = 1e-6f;
  archetype.farPuffs = {puff};
  archetype.onePuff = puff;
  archetype.sectionStart = {0, 2};
  archetype.bounds = shape::boundsOf(archetype.puffs);
  return archetype;
}

inline scene::LitArchetype lit(const scene::Scene& scene, std::uint32_t index, int yawStep,
                               glm::vec3 tint = glm::vec3(1)) {
  const scene::Archetype& archetype = scene.archetypes[index];
  scene::LitArchetype out{.archetype = index, .yawStep = yawStep};
  const auto lightOf = [&](const shape::Puff& puff) {
    const float height = std::min(1.0f, puff.center.y / 400);
    return light::PuffLight{tint * (0.25f + 0.65f * height), 0.2f * height};
  };
  for (const auto& puff : archetype.puffs) out.puffs.push_back(lightOf(puff));
  for (const auto& puff : archetype.farPuffs) out.farPuffs.push_back(lightOf(puff));
  out.onePuff = lightOf(archetype.onePuff);
  return out;
}

/// About 14 km east to west and 22 km north to south: a grey field of heaps in rows, a red heap in the
/// south-west corner, a green one in the north-east, a blue one high in the south-east, and fibres above the
/// middle.
inline scene::Scene gltfScene(int puffsOfHeap = 60, int rows = 4,
                              const base::GeoBox& box = {10.0, 50.0, 10.2, 50.2}) {
  scene::Scene scene{.frame = base::LocalFrame(box)};
  scene.validTime = base::utcFromCivil(2026, 6, 21, 14);
  scene.sun = light::sunFrom(225, 40);
  scene.sky = light::skyUnder(scene.sun);
  scene.seed = 0xfedcba9876543210u;
  scene.provenance = {{"model.grib2"}, "GRIB2", "ICON-D2", "2026-06-21T12:00:00Z"};
  scene.groundHeightMeters = 20;
  scene.archetypes = {heap("Cu_1", base::Genus::Cumulus, puffsOfHeap), fibres()};
  scene.lit = {lit(scene, 0, 0),
               lit(scene, 0, 3),
               lit(scene, 1, 5),
               lit(scene, 0, 1, {1, 0.15f, 0.1f}),
               lit(scene, 0, 2, {0.1f, 1, 0.15f}),
               lit(scene, 0, 7, {0.1f, 0.2f, 1})};
  const glm::dvec2 lower = scene.frame.lowerCorner(), upper = scene.frame.upperCorner();
  const auto add = [&](std::uint32_t index, double eastward, double northward, float height, float scale,
                       float factor) {
    const glm::vec3 place(lower.x + eastward * (upper.x - lower.x), height,
                          upper.y - northward * (upper.y - lower.y));
    scene.instances.push_back({index, place, scale, factor});
    const base::Genus genus = scene.archetypes[scene.lit[index].archetype].genus;
    scene.clouds.push_back({.id = 0x8000000000000001u + scene.clouds.size(),
                            .genus = genus,
                            .rule = "test",
                            .baseMeters = height,
                            .topMeters = height + 500 * scale});
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < rows; ++column)
      add((row + column) % 2, 0.3 + 0.4 * column / rows, 0.3 + 0.4 * row / rows, 1000, 0.8f + 0.1f * row,
          1 + 0.2f * column);
  add(3, 0.05, 0.05, 1000, 2, 1);
  add(4, 0.95, 0.95, 1000, 2, 1);
  add(5, 0.95, 0.05, 4000, 2, 1);
  add(2, 0.5, 0.5, 8000, 1.5f, 1);
  return scene;
}

}  // namespace cloudgen::test
