// SPDX-License-Identifier: Apache-2.0
#include "pipeline/moving.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "input/catalogue.hpp"
#include "support/made_source.hpp"
#include "support/painted_sky.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr base::UtcTime kFirst{1'782'039'600};

/// Two degrees square of one layer, its cover another one at each time.
struct MadeForecast {
  field::StatedLayer layer;
  std::vector<float> covers;
  std::int64_t stepSeconds = 3600;

  std::vector<base::UtcTime> times() const {
    std::vector<base::UtcTime> all;
    for (std::size_t k = 0; k < covers.size(); ++k) all.push_back({kFirst.seconds + static_cast<std::int64_t>(k) * stepSeconds});
    return all;
  }
  std::unique_ptr<field::Source> at(base::UtcTime time) const {
    auto source = std::make_unique<test::MadeSource>(10, 46, 0.25, 8, 8);
    source->setTime(time);
    field::StatedLayer here = layer;
    here.coverFraction = covers[static_cast<std::size_t>((time.seconds - kFirst.seconds) / stepSeconds)];
    source->cover(here);
    return source;
  }
  MovingSky built(std::uint64_t maxPuffs = 60'000) const {
    return runTimes(times(), [this](base::UtcTime time) { return at(time); }, test::usualOptions(maxPuffs), {});
  }
};

MadeForecast stratocumulus(std::vector<float> covers) {
  field::StatedLayer layer = test::stratocumulusLayer();
  layer.windEast = 9, layer.windNorth = -4;
  return {layer, std::move(covers)};
}

scene::Scene stillAt(const scene::Scene& scene, double seconds) {
  scene::Scene still = scene;
  still.instances = scene::instancesAt(scene, seconds);
  return still;
}

test::PaintedSky::Seen seenAt(const MovingSky& sky, double seconds) {
  const scene::Scene still = stillAt(sky.scene, seconds);
  const test::PaintedSky painted(still, 500);
  test::PaintedSky::Seen all;
  for (const float depth : painted.opticalDepth) {
    all.pixels += 1;
    all.covered += depth > 0.1f;
    all.opticalDepth += depth;
  }
  return all;
}

/// How far clouds go round a place counter-clockwise (seen from above), in the mean over those that are there for a
/// stretch and its neighbours, each from the first of its moments to the last at which all of it is there.
double metersRound(const MovingSky& sky, const glm::dvec3& eye) {
  double round = 0, count = 0;
  for (std::size_t i = 0; i < sky.scene.instances.size(); ++i) {
    std::vector<glm::dvec2> way;
    for (const scene::Moment& moment : sky.scene.motions[i].moments)
      if (moment.presence > 0 && moment.growth > 0.3f) {
        const glm::dvec3 place(sky.scene.instances[i].position + moment.shift);
        way.emplace_back(place.x - eye.x, place.z - eye.z);
      }
    if (way.size() < 2) continue;
    const glm::dvec2 middle = 0.5 * (way.front() + way.back()), along = way.back() - way.front();
    round += glm::dot(along, glm::normalize(glm::dvec2(middle.y, -middle.x)));
    count += 1;
  }
  return count > 0 ? round / count : 0;
}

TEST(Moving, AtItsTimesTheSkyIsThatOfTheTime) {
  const MovingSky sky = stratocumulus({0.6f, 0.6f, 0.75f}).built();
  ASSERT_EQ(sky.scene.motions.size(), sky.scene.instances.size());
  ASSERT_EQ(sky.scene.clouds.size(), sky.scene.instances.size());
  EXPECT_EQ(sky.scene.keySeconds.front(), 0);
  EXPECT_EQ(sky.scene.keySeconds.back(), 7200);
  const auto start = scene::instancesAt(sky.scene, 0);
  const std::size_t ofFirst = sky.first.scene.instances.size();
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (i >= ofFirst) {
      EXPECT_EQ(start[i].opticalDepthFactor, 0);
      continue;
    }
    EXPECT_EQ(start[i].position, sky.first.scene.instances[i].position);
    EXPECT_EQ(start[i].scale, sky.first.scene.instances[i].scale);
    EXPECT_EQ(start[i].opticalDepthFactor, sky.first.scene.instances[i].opticalDepthFactor);
  }
}

TEST(Moving, CloudsDriftWithTheWind) {
  const MovingSky sky = stratocumulus({0.6f, 0.6f}).built();
  ASSERT_EQ(sky.hours.size(), 1u);
  EXPECT_NEAR(sky.hours[0].driftOverWind, 1, 0.15);
  EXPECT_NEAR(sky.hours[0].windMetersPerSecond, std::hypot(9, 4), 0.2);
  EXPECT_GT(sky.hours[0].matchedShare, 0.6);
  // In between they are on their way: east and south.
  const auto start = scene::instancesAt(sky.scene, 0), middle = scene::instancesAt(sky.scene, 1800);
  double east = 0, south = 0, count = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!(start[i].opticalDepthFactor > 0 && middle[i].opticalDepthFactor > 0)) continue;
    east += middle[i].position.x - start[i].position.x;
    south += middle[i].position.z - start[i].position.z;
    count += 1;
  }
  EXPECT_NEAR(east / count, 9 * 1800, 0.15 * 9 * 1800);
  EXPECT_NEAR(south / count, 4 * 1800, 0.25 * 4 * 1800);
}

TEST(Moving, CoverAndWaterGoFromOneTimeToTheNext) {
  const MovingSky sky = stratocumulus({0.5f, 0.8f}).built();
  const auto start = seenAt(sky, 0), end = seenAt(sky, 3600);
  for (const double share : {0.25, 0.5, 0.75}) {
    const auto between = seenAt(sky, 3600 * share);
    EXPECT_NEAR(between.cover(), start.cover() + share * (end.cover() - start.cover()), 0.03) << share;
    const double water = start.opticalDepth + share * (end.opticalDepth - start.opticalDepth);
    EXPECT_NEAR(between.opticalDepth / water, 1, 0.1) << share;
  }
}

// Elements of a sheet overlap: shrunk evenly they would hide for long how many have gone.
TEST(Moving, ASheetThatDissolvesOpensFromTheFirst) {
  const MovingSky sky = stratocumulus({0.95f, 0.2f}).built();
  const auto start = seenAt(sky, 0), end = seenAt(sky, 3600);
  for (const double share : {0.25, 0.5, 0.75})
    EXPECT_NEAR(seenAt(sky, 3600 * share).cover(), start.cover() + share * (end.cover() - start.cover()), 0.05) << share;
}

/// The wind beyond the box is nobody's forecast: no cloud is carried further out than it is wide.
TEST(Moving, CloudsVanishWhereTheyLeaveTheBox) {
  MadeForecast forecast = stratocumulus({0.6f, 0.6f});
  forecast.layer.windEast = 60;
  const MovingSky sky = forecast.built(20'000);
  const glm::dvec2 lower = sky.scene.frame.lowerCorner(), upper = sky.scene.frame.upperCorner();
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < sky.scene.instances.size(); ++i)
    for (const scene::Moment& moment : sky.scene.motions[i].moments) {
      const scene::Instance& cloud = sky.scene.instances[i];
      const glm::dvec3 place(cloud.position + moment.shift);
      const double width = sky.scene.archetypes[sky.scene.lit[cloud.lit].archetype].widthMeters * cloud.scale;
      if (std::max({lower.x - place.x, place.x - upper.x, lower.y - place.z, place.z - upper.y}) < 1.5 * width) continue;
      ++beyond;
      EXPECT_LE(moment.growth, 0.03f);
    }
  EXPECT_GT(beyond, 50u);
}

/// Clouds of the first time and of six hours later stand side by side: one sun lights them.
TEST(Moving, CloudsOfAllTimesAreLitAsAtTheFirst) {
  MadeForecast forecast = stratocumulus({0.3f, 0.8f});
  forecast.stepSeconds = 6 * 3600;
  const MovingSky sky = forecast.built(20'000);
  pipeline::Options alike = test::usualOptions(20'000);
  alike.sunDegrees = {sky.first.scene.sun.azimuthDegrees, sky.first.scene.sun.elevationDegrees};
  const MovingSky stated = runTimes(forecast.times(), [&](base::UtcTime time) { return forecast.at(time); }, alike, {});
  ASSERT_EQ(sky.scene.lit.size(), stated.scene.lit.size());
  EXPECT_GT(sky.scene.lit.size(), sky.first.scene.lit.size());
  for (std::size_t i = 0; i < sky.scene.lit.size(); ++i)
    for (std::size_t p = 0; p < sky.scene.lit[i].puffs.size(); ++p)
      EXPECT_LT(glm::distance(sky.scene.lit[i].puffs[p].color, stated.scene.lit[i].puffs[p].color), 1e-4f);
}

/// Nothing jumps: half a minute changes little anywhere, at the times themselves as in between.
TEST(Moving, NothingPops) {
  const MovingSky sky = stratocumulus({0.6f, 0.4f, 0.6f}).built(20'000);
  const auto changeFrom = [&](double seconds) {
    const test::PaintedSky a(stillAt(sky.scene, seconds), 1000), b(stillAt(sky.scene, seconds + 30), 1000);
    double change = 0;
    for (std::size_t i = 0; i < a.opticalDepth.size(); ++i)
      change += std::abs(std::exp(-a.opticalDepth[i]) - std::exp(-b.opticalDepth[i]));
    return change / static_cast<double>(a.opticalDepth.size());
  };
  const double within = std::max(changeFrom(1500), changeFrom(5000));
  EXPECT_LT(changeFrom(3585), 2 * within) << "at the time of the middle one";
  EXPECT_LT(changeFrom(3600), 2 * within);
}

TEST(Moving, CloudsKeepTheirNumbers) {
  const MovingSky sky = stratocumulus({0.6f, 0.6f, 0.6f}).built();
  std::uint64_t chains = 0, clouds = 0;
  for (std::size_t n = 0; n < sky.lifetimes.size(); ++n) chains += sky.lifetimes[n], clouds += (n + 1) * sky.lifetimes[n];
  EXPECT_EQ(clouds, sky.scene.clouds.size());
  EXPECT_EQ(sky.lifetimes.size(), 3u);
  EXPECT_GT(sky.lifetimes[2], 0u) << "some are there all the time";
}

TEST(Moving, IsTheSameForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    const base::ThreadLimit limit(threads);
    MadeForecast forecast = stratocumulus({0.5f, 0.6f});
    forecast.layer.windEast = 60;
    return forecast.built(20'000);
  };
  const MovingSky one = run(1), four = run(4);
  EXPECT_GT(one.hours[0].stretches, 1);
  ASSERT_EQ(one.scene.motions.size(), four.scene.motions.size());
  for (std::size_t i = 0; i < one.scene.motions.size(); ++i) {
    const auto &a = one.scene.motions[i].moments, &b = four.scene.motions[i].moments;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_TRUE(a[k].shift == b[k].shift && a[k].growth == b[k].growth);
  }
}

/// Over three hours the air of the box is another one; its clouds are not.
TEST(Moving, AStormTurnsItsClouds) {
  // Counter-clockwise, at most 30 m/s, 60 km from an eye at the north-eastern corner of the box.
  const auto open = [](base::UtcTime time) {
    auto source = std::make_unique<test::MadeSource>(10, 46, 0.125, 16, 16);
    source->setTime(time);
    field::StatedLayer layer = test::stratocumulusLayer(0.5f);
    for (std::uint32_t cell = 0; cell < source->grid().size(); ++cell) {
      const field::GeoPoint at = field::centerOf(source->grid(), cell);
      const double east = 77'500 * (at.longitudeDegrees - 12), north = 111'200 * (at.latitudeDegrees - 48);
      const double turning = 1e-3 / (1 + std::pow(std::hypot(east, north) / 60'000, 2));
      layer.cell = cell, layer.windEast = static_cast<float>(-turning * north), layer.windNorth = static_cast<float>(turning * east);
      source->layers.push_back(layer);
    }
    return source;
  };
  const MovingSky sky = runTimes({{kFirst.seconds}, {kFirst.seconds + 10'800}}, open, test::usualOptions(20'000), {});
  EXPECT_GT(sky.hours[0].stretches, 1);
  EXPECT_GT(sky.hours[0].matchedShare, 0.3);
  EXPECT_NEAR(sky.hours[0].driftOverWind, 1, 0.15);
  EXPECT_GT(metersRound(sky, glm::dvec3(sky.scene.frame.toScene(12, 48, 0))), 5000);
  for (const double seconds : {675.0, 2000.0, 5400.0, 9000.0}) EXPECT_NEAR(seenAt(sky, seconds).cover(), seenAt(sky, 0).cover(), 0.03) << seconds;
}

/// A hurricane of the northern hemisphere, three hours from one time to the next.
TEST(Moving, KatrinaTurnsCounterClockwise) {
  const std::string file = std::string(CLOUDGEN_SHARED_DIR) + "/data/wrfout_katrina_mercator_20050828.nc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto open = [&](base::UtcTime time) {
    input::OpenOptions options;
    options.time = time;
    return input::open({file}, options);
  };
  const std::vector<base::UtcTime> times{base::utcFromCivil(2005, 8, 28, 12), base::utcFromCivil(2005, 8, 28, 15)};
  const MovingSky sky = runTimes(times, open, test::usualOptions(2000), {});
  EXPECT_GT(sky.hours[0].matchedShare, 0.3);
  EXPECT_NEAR(sky.hours[0].driftOverWind, 1, 0.15);
  // The eye is where the pressure is least: at the north-eastern corner of the file.
  const base::GeoBox& box = sky.scene.frame.box();
  EXPECT_GT(metersRound(sky, glm::dvec3(sky.scene.frame.toScene(box.east - 0.2, box.north, 0))), 10'000);
}

TEST(Moving, TimesOfAnotherGridAreRefused) {
  const auto open = [](base::UtcTime time) {
    auto source = std::make_unique<test::MadeSource>(10, 46, 0.25, time.seconds == 0 ? 8 : 9, 8);
    source->setTime(time);
    source->cover(test::cumulusLayer());
    return source;
  };
  EXPECT_THROW(runTimes({{0}, {3600}}, open, test::usualOptions(10'000), {}), base::InputError);
}

}  // namespace
}  // namespace cloudgen::pipeline
