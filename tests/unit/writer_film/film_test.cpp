// SPDX-License-Identifier: Apache-2.0
#include "writer/film/film.hpp"

#include <gtest/gtest.h>

#include "support/moving_scene.hpp"
#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

TEST(Film, GoesTenSecondsAnHour) {
  const scene::Scene scene = test::moving(test::smallScene());
  const Film film(scene);
  EXPECT_DOUBLE_EQ(film.seconds(), 20);
  EXPECT_DOUBLE_EQ(film.secondsAt(2), 10);
  EXPECT_DOUBLE_EQ(film.shareAt(3), 0.75);
  EXPECT_EQ(film.description(), "10 seconds an hour of the forecast, 2 hours from 2011-01-15T12:00:00Z");
  EXPECT_FALSE(Film(test::smallScene()).moves());
}

TEST(Film, AtTheTimesOfTheForecastCloudsAreThoseOfTheScene) {
  const scene::Scene scene = test::moving(test::smallScene());
  const Film film(scene);
  for (const std::uint32_t key : {0u, 2u, 4u}) {
    const auto stand = scene::instancesAt(scene, scene.keySeconds[key]);
    for (std::uint32_t i = 0; i < stand.size(); ++i) {
      const Track track = film.trackOf(i);
      const bool isThere = key >= track.firstKey && key < track.firstKey + track.scales.size();
      const float scale = isThere ? track.scales[key - track.firstKey] : 0;
      EXPECT_FLOAT_EQ(scale, stand[i].opticalDepthFactor > 0 ? stand[i].scale : 0) << i << " at " << key;
      EXPECT_TRUE(key > 0 || film.isThereAtFirst(i) == (scale > 0)) << i;
    }
  }
}

/// Of a pair there is always one in full.
TEST(Film, WhoComesIsWholeBeforeWhoGoesShrinks) {
  scene::Scene scene = test::smallScene();
  scene.keySeconds = {0, 900, 1800, 2700, 3600};
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    scene::Motion motion;
    for (int k = 0; k <= 4; ++k) {
      const float share = 0.25f * static_cast<float>(k);
      motion.moments.push_back({glm::vec3(0), 1, i % 2 == 0 ? 1 - share : share});
    }
    scene.motions.push_back(motion);
  }
  const Film film(scene);
  const Track going = film.trackOf(0), coming = film.trackOf(1);
  for (std::size_t k = 0; k <= 4; ++k) {
    const float a = going.scales[k] / scene.instances[0].scale, b = coming.scales[k] / scene.instances[1].scale;
    EXPECT_FLOAT_EQ(std::max(a, b), 1) << k;
  }
  EXPECT_FLOAT_EQ(going.scales[4], 0);
  EXPECT_FLOAT_EQ(coming.scales[0], 0);
}

}  // namespace
}  // namespace cloudgen::writer
