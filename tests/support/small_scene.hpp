// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/random.hpp"
#include "scene/scene.hpp"
#include "shape/reduce.hpp"

/// Scenes made by hand for the tests of the writers: no reader, no pipeline, the same at every call.
namespace cloudgen::test {

/// Light that grows with height and towards the sun, enough to tell a cloud's sides apart.
inline std::vector<light::PuffLight> simpleLight(const std::vector<shape::Puff>& puffs,
                                                 const shape::Bounds& bounds, const light::Sun& sun,
                                                 int yawStep) {
  const glm::quat turn = glm::angleAxis(scene::yawRadians(yawStep), glm::vec3(0, 1, 0));
  const glm::vec3 middle = 0.5f * (bounds.lower + bounds.upper),
                  half = 0.5f * (bounds.upper - bounds.lower) + 1.0f;
  std::vector<light::PuffLight> lights;
  for (const shape::Puff& puff : puffs) {
    const float facing = glm::dot(turn * ((puff.center - middle) / half), sun.direction);
    const float lit = glm::clamp(0.5f + 0.5f * facing, 0.0f, 1.0f);
    lights.push_back({glm::mix(glm::vec3(0.16f, 0.19f, 0.25f), glm::vec3(0.95f, 0.93f, 0.9f), lit), 0.1f});
  }
  return lights;
}

/// A heap: round puffs on a dome in `sections` sections side by side, flat below.
inline scene::Archetype heap(const std::string& name, base::Genus genus, float width, float height,
                             int sections, int puffs) {
  scene::Archetype cloud{name, genus};
  base::RandomStream random(1, static_cast<std::uint64_t>(puffs), base::Purpose::Test);
  for (int s = 0; s < sections; ++s) {
    cloud.sectionStart.push_back(static_cast<std::uint32_t>(cloud.puffs.size()));
    const double across = sections > 1 ? static_cast<double>(s) / (sections - 1) - 0.5 : 0.0;
    const float tall = height * static_cast<float>(1.0 - 1.6 * across * across);
    const glm::vec3 root(across * 0.7 * width, 0, random.uniform(-0.12, 0.12) * width);
    for (int p = 0; p < puffs / sections; ++p) {
      const glm::dvec3 direction = random.direction();
      shape::Puff puff;
      puff.center = root + glm::vec3(0.5 * width / sections * 1.4, tall, 0.3 * width) *
                               glm::vec3(direction.x, std::abs(direction.y), direction.z) *
                               static_cast<float>(random.uniform(0.5, 0.9));
      puff.center.y = std::max(puff.center.y, 0.06f * height);
      puff.sigma = glm::vec3(static_cast<float>(random.uniform(0.05, 0.09)) * std::min(width, height));
      puff.extinctionPerMeter = 0.8f / puff.sigma.x;
      puff.section = static_cast<std::uint16_t>(s);
      puff.sprite = static_cast<std::uint16_t>(random.index(16));
      cloud.puffs.push_back(puff);
    }
  }
  cloud.sectionStart.push_back(static_cast<std::uint32_t>(cloud.puffs.size()));
  for (int p = 0; p < 5; ++p) {
    shape::Puff puff;
    puff.center = glm::vec3((p - 2) * 0.16f * width, (p % 2 ? 0.35f : 0.5f) * height, 0);
    puff.sigma = glm::vec3(0.16f, 0.2f, 0.16f) * glm::vec3(width, height, width);
    puff.extinctionPerMeter = 1.5f / puff.sigma.y;
    puff.sprite = static_cast<std::uint16_t>(p);
    cloud.farPuffs.push_back(puff);
  }
  cloud.onePuff = shape::reduce(cloud.puffs, 1).front();
  cloud.bounds = shape::boundsOf(cloud.puffs);
  cloud.widthMeters = width;
  cloud.depthMeters = height;
  cloud.opticalDepth = 20;
  return cloud;
}

/// A sheet: `puffs` puffs spread over width x width; `stretch` makes them long along the wind, `flatness`
/// low.
inline scene::Archetype sheet(const std::string& name, base::Genus genus, float width, float height,
                              int puffs, float stretch, float flatness, float opticalDepth) {
  scene::Archetype cloud{name, genus};
  base::RandomStream random(2, static_cast<std::uint64_t>(puffs), base::Purpose::Test);
  const float size = 0.9f * width / std::sqrt(static_cast<float>(puffs));
  for (int p = 0; p < puffs; ++p) {
    shape::Puff puff;
    puff.center = glm::vec3(random.uniform(-0.5, 0.5) * width, random.uniform(0.2, 0.8) * height,
                            random.uniform(-0.5, 0.5) * width);
    puff.sigma =
        glm::vec3(size * stretch, size * flatness, size) * static_cast<float>(random.uniform(0.4, 0.7));
    puff.rotation = glm::angleAxis(static_cast<float>(random.uniform(-0.2, 0.2)), glm::vec3(0, 1, 0));
    puff.extinctionPerMeter = opticalDepth / (2.5f * puff.sigma.y);
    puff.sprite = static_cast<std::uint16_t>(random.index(16));
    cloud.puffs.push_back(puff);
  }
  cloud.sectionStart = {0, static_cast<std::uint32_t>(cloud.puffs.size())};
  for (int p = 0; p < 4; ++p) {
    shape::Puff puff;
    puff.center =
        glm::vec3((p % 2 ? 0.22f : -0.22f) * width, 0.5f * height, (p / 2 ? 0.22f : -0.22f) * width);
    puff.sigma = glm::vec3(0.17f * width, 0.2f * height, 0.17f * width);
    puff.extinctionPerMeter = opticalDepth / (2.5f * puff.sigma.y);
    puff.sprite = static_cast<std::uint16_t>(p);
    cloud.farPuffs.push_back(puff);
  }
  cloud.onePuff = shape::reduce(cloud.puffs, 1).front();
  cloud.bounds = shape::boundsOf(cloud.puffs);
  cloud.widthMeters = width;
  cloud.depthMeters = height;
  cloud.opticalDepth = opticalDepth;
  return cloud;
}

/// A scene of the given archetypes over a box of a quarter degree: every archetype lit under two headings,
/// `count` clouds at places that repeat, genus by genus, with their bases at 1 km for low and 6 km for high
/// genera.
inline scene::Scene sceneOf(std::vector<scene::Archetype> archetypes, int count) {
  const base::GeoBox box{7.0, 46.0, 7.25, 46.2};
  scene::Scene scene{base::LocalFrame(box)};
  scene.validTime = base::utcFromCivil(2011, 1, 15, 12);
  scene.sun = light::sunFrom(200, 35);
  scene.sky = light::skyUnder(scene.sun);
  scene.seed = 7;
  scene.provenance = {{"by-hand.grib"}, "GRIB", "<by hand> & \"quoted\"", "2011-01-15T00:00:00Z"};
  scene.groundHeightMeters = 400;
  scene.archetypes = std::move(archetypes);
  for (std::uint32_t a = 0; a < scene.archetypes.size(); ++a) {
    for (const int yaw : {0, 5}) {
      const scene::Archetype& archetype = scene.archetypes[a];
      scene.lit.push_back({a, yaw, simpleLight(archetype.puffs, archetype.bounds, scene.sun, yaw),
                           simpleLight(archetype.farPuffs, archetype.bounds, scene.sun, yaw)});
    }
  }
  base::RandomStream random(scene.seed, 0, base::Purpose::Test, 3);
  for (int i = 0; i < count; ++i) {
    const std::uint32_t lit = static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(scene.lit.size());
    const scene::Archetype& archetype = scene.archetypes[scene.lit[lit].archetype];
    const double longitude = box.west + random.uniform(0.1, 0.9) * box.width(),
                 latitude = box.south + random.uniform(0.1, 0.9) * box.height();
    const float base = archetype.genus <= base::Genus::Cirrostratus  ? 6000.0f
                       : archetype.genus <= base::Genus::Altostratus ? 3000.0f
                                                                     : 1000.0f;
    const float scale = static_cast<float>(random.uniform(0.6, 1.4));
    scene.instances.push_back({lit, glm::vec3(scene.frame.toScene(longitude, latitude, base)), scale, 1.0f});
    scene.clouds.push_back({static_cast<std::uint64_t>(1000 + i), archetype.genus, "by hand",
                            static_cast<std::uint32_t>(i), longitude, latitude, base,
                            base + scale * archetype.depthMeters, archetype.opticalDepth});
  }
  return scene;
}

/// Two archetypes (a heap and a thin sheet of long puffs) and 20 clouds.
inline scene::Scene smallScene() {
  return sceneOf({heap("Cu_1", base::Genus::Cumulus, 1500, 900, 3, 60),
                  sheet("Ci_1", base::Genus::Cirrus, 5000, 400, 24, 3, 0.15f, 0.4f)},
                 20);
}

}  // namespace cloudgen::test
