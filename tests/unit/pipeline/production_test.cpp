// SPDX-License-Identifier: Apache-2.0
#include "pipeline/production.hpp"

#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "shape/generate.hpp"
#include "support/made_table.hpp"

namespace cloudgen::pipeline {
namespace {

struct Produced {
  test::MadeTable made;
  scene::Scene scene;
};

test::MadeSource mixedSky() {
  test::MadeSource source(10, 46, 0.5, 2, 2);
  field::StatedLayer heaps = test::cumulusLayer();
  heaps.shearEast = 10;
  source.cover(heaps);
  field::StatedLayer sheet = test::stratocumulusLayer();
  sheet.baseMeters = 4000, sheet.topMeters = 4500, sheet.genus = base::Genus::Altocumulus;
  source.cover(sheet);
  source.cover({.genus = base::Genus::Cirrus,
                .coverFraction = 0.3f,
                .baseMeters = 9000,
                .topMeters = 9800,
                .opticalDepth = 0.3f,
                .windEast = 40});
  return source;
}

Produced produced(const test::MadeSource& source, const Options& options) {
  test::MadeTable made(source, options);
  scene::Scene scene = produce(made.table, locateOrigin(source, source.grid(), options), options,
                               made.general, source.info().validTime, {});
  return {std::move(made), std::move(scene)};
}

const scene::Archetype& archetypeOf(const scene::Scene& scene, const scene::Instance& instance) {
  return scene.archetypes[scene.lit[instance.lit].archetype];
}

TEST(Production, EveryCloudIsAnInstanceOfItsOwnPlaceAndGenus) {
  const auto [made, scene] = produced(mixedSky(), test::usualOptions(10'000));
  ASSERT_EQ(scene.instances.size(), made.table.clouds.size());
  ASSERT_EQ(scene.clouds.size(), made.table.clouds.size());
  std::set<std::uint64_t> ids;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const field::Cloud& cloud = made.table.clouds[i];
    const glm::dvec3 place =
        scene.frame.toScene(cloud.longitudeDegrees, cloud.latitudeDegrees, cloud.baseMeters);
    EXPECT_LT(glm::distance(glm::dvec3(scene.instances[i].position), place), 0.1);
    EXPECT_EQ(archetypeOf(scene, scene.instances[i]).genus, scene.clouds[i].genus);
    EXPECT_EQ(scene.clouds[i].rule, "stated");
    EXPECT_FLOAT_EQ(scene.clouds[i].topMeters, cloud.baseMeters + cloud.depthMeters);
    EXPECT_TRUE(ids.insert(scene.clouds[i].id).second);
  }
}

TEST(Production, CloudsOfManyLayersHaveIdsOfTheirOwn) {
  test::MadeSource source(10, 46, 0.1, 1, 1);
  for (int i = 0; i < 40; ++i) {
    field::StatedLayer layer = test::cumulusLayer();
    layer.baseMeters = 400.0f * static_cast<float>(i), layer.topMeters = layer.baseMeters + 300;
    source.cover(layer);
  }
  const auto [made, scene] = produced(source, test::usualOptions(20'000));
  std::set<std::uint64_t> ids;
  std::set<std::uint16_t> layers;
  for (const scene::CloudRecord& cloud : scene.clouds) {
    EXPECT_TRUE(ids.insert(cloud.id).second);
    layers.insert(cloud.layer);
  }
  EXPECT_GT(layers.size(), 16u);
}

TEST(Production, DepthAndWaterOfEveryCloudAreExact) {
  const auto [made, scene] = produced(mixedSky(), test::usualOptions(10'000));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const field::Cloud& cloud = made.table.clouds[i];
    const scene::Instance& instance = scene.instances[i];
    const scene::Archetype& archetype = archetypeOf(scene, instance);
    EXPECT_NEAR(instance.scale * archetype.depthMeters / cloud.depthMeters, 1, 1e-4);
    const double wanted = cloud.opticalDepth * shape::footprintSquareMeters(cloud.widthMeters);
    const double nominal = archetype.opticalDepth * instance.opticalDepthFactor *
                           shape::footprintSquareMeters(archetype.widthMeters * instance.scale);
    EXPECT_NEAR(nominal / wanted, 1, 1e-4);
    // And what is drawn: the puffs' extinction (Cu, Ac and Ci do not rain).
    double area = 0;
    for (const shape::Puff& puff : archetype.puffs)
      area += shape::extinctionArea(scene::placed(scene, instance, puff));
    EXPECT_NEAR(area / wanted, 1, 2e-3);
  }
}

TEST(Production, WidthsAreRightWithinAnAspectClass) {
  const auto [made, scene] = produced(mixedSky(), test::usualOptions(10'000));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const double width = archetypeOf(scene, scene.instances[i]).widthMeters * scene.instances[i].scale;
    EXPECT_NEAR(std::log(width / made.table.clouds[i].widthMeters), 0, 0.5 * std::log(std::sqrt(2.0)) + 1e-4);
  }
}

TEST(Production, ElementsAreTurnedIntoTheWind) {
  const auto headingOf = [](float east, float north) {
    test::MadeSource source(10, 46, 0.2, 1, 1);
    source.cover({.genus = base::Genus::Cirrus,
                  .coverFraction = 0.9f,
                  .baseMeters = 9000,
                  .topMeters = 9800,
                  .opticalDepth = 0.3f,
                  .windEast = east,
                  .windNorth = north});
    const scene::Scene scene = produced(source, test::usualOptions(5'000)).scene;
    EXPECT_FALSE(scene.instances.empty());
    const float yaw = scene::yawRadians(scene.lit[scene.instances.at(0).lit].yawStep);
    return glm::vec2(std::cos(yaw), -std::sin(yaw));  // (x, z) of the element's own x axis
  };
  EXPECT_LT(glm::distance(headingOf(30, 0), glm::vec2(1, 0)), 0.01f);    // westerly: east
  EXPECT_LT(glm::distance(headingOf(-30, 0), glm::vec2(-1, 0)), 0.01f);  // easterly
  EXPECT_LT(glm::distance(headingOf(0, 30), glm::vec2(0, -1)), 0.01f);   // southerly: north is -z
  EXPECT_LT(glm::distance(headingOf(20, -20), std::sqrt(0.5f) * glm::vec2(1, 1)), 0.01f);
}

TEST(Production, EveryPuffHasItsLight) {
  const scene::Scene scene = produced(mixedSky(), test::usualOptions(10'000)).scene;
  std::set<std::string> names;
  for (const scene::Archetype& archetype : scene.archetypes) {
    EXPECT_TRUE(names.insert(archetype.name).second) << archetype.name;
    EXPECT_LE(archetype.farPuffs.size(), 8u);
    EXPECT_FALSE(archetype.puffs.empty());
    EXPECT_EQ(archetype.sectionStart.back(), archetype.puffs.size());
  }
  for (const scene::LitArchetype& lit : scene.lit) {
    EXPECT_EQ(lit.puffs.size(), scene.archetypes[lit.archetype].puffs.size());
    EXPECT_EQ(lit.farPuffs.size(), scene.archetypes[lit.archetype].farPuffs.size());
    EXPECT_TRUE(lit.yawStep >= 0 && lit.yawStep < scene::kYawSteps);
    for (const light::PuffLight& light : lit.puffs)
      ASSERT_TRUE(std::isfinite(light.color.r + light.color.g + light.color.b));
  }
  EXPECT_LT(scene.archetypes.size(), scene.instances.size());
}

TEST(Production, TheSameSceneForAnyNumberOfThreads) {
  const auto make = [](int threads) {
    const base::ThreadLimit limit(threads);
    return produced(mixedSky(), test::usualOptions(10'000)).scene;
  };
  const scene::Scene one = make(1), two = make(2);
  ASSERT_EQ(one.archetypes.size(), two.archetypes.size());
  for (std::size_t i = 0; i < one.archetypes.size(); ++i) {
    EXPECT_EQ(one.archetypes[i].name, two.archetypes[i].name);
    ASSERT_EQ(one.archetypes[i].puffs.size(), two.archetypes[i].puffs.size());
    for (std::size_t p = 0; p < one.archetypes[i].puffs.size(); ++p)
      ASSERT_EQ(one.archetypes[i].puffs[p].center, two.archetypes[i].puffs[p].center);
  }
  ASSERT_EQ(one.lit.size(), two.lit.size());
  for (std::size_t i = 0; i < one.lit.size(); ++i)
    for (std::size_t p = 0; p < one.lit[i].puffs.size(); ++p)
      ASSERT_EQ(one.lit[i].puffs[p].color, two.lit[i].puffs[p].color);
  ASSERT_EQ(one.instances.size(), two.instances.size());
  for (std::size_t i = 0; i < one.instances.size(); ++i) {
    ASSERT_EQ(one.instances[i].position, two.instances[i].position);
    ASSERT_EQ(one.instances[i].lit, two.instances[i].lit);
  }
}

TEST(Production, StopsWhenTheUserWants) {
  const test::MadeSource source = mixedSky();
  const Options options = test::usualOptions(10'000);
  const test::MadeTable made(source, options);
  base::Progress progress;
  progress.cancelled = [] { return true; };
  EXPECT_THROW(
      produce(made.table, locateOrigin(source, source.grid(), options), options, made.general, {}, progress),
      base::InterruptedError);
}

}  // namespace
}  // namespace cloudgen::pipeline
