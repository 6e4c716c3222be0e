// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "base/random.hpp"
#include "image/preview.hpp"

namespace cloudgen::image {
namespace {

Surroundings morning() {
  Surroundings around;
  around.sun = light::sunFrom(120, 30);
  around.sky = light::skyUnder(around.sun);
  around.groundHeightMeters = 300;
  return around;
}

std::vector<Splat> scattered(double west, double east, double north, double south) {
  base::RandomStream random(4, 4, base::Purpose::Test);
  std::vector<Splat> splats(200);
  for (Splat& splat : splats) {
    splat.center =
        glm::dvec3(random.uniform(west, east), random.uniform(1200, 2400), random.uniform(north, south));
    splat.sigma = glm::vec3(100);
  }
  return splats;
}

/// Share of the splats whose centre is in the picture.
double shareSeen(const Camera& camera, const std::vector<Splat>& splats) {
  const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 upward = std::abs(ahead.y) > 0.9999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, upward)), up = glm::cross(right, ahead);
  const double slope = std::tan(glm::radians(0.5 * camera.verticalFieldDegrees));
  int seen = 0;
  for (const Splat& splat : splats) {
    const glm::dvec3 away = glm::dvec3(splat.center) - camera.eye;
    const double distance = glm::dot(away, ahead);
    if (distance > 0 && std::abs(glm::dot(away, up)) < slope * distance &&
        std::abs(glm::dot(away, right)) < slope * distance * camera.width / camera.height)
      ++seen;
  }
  return seen / static_cast<double>(splats.size());
}

TEST(Camera, FromAboveEverythingIsInThePicture) {
  for (const auto& splats :
       {scattered(0, 30000, -20000, 0), scattered(0, 2000, -40000, 0), scattered(0, 90000, -5000, 0)})
    EXPECT_EQ(shareSeen(cameraFor("top", splats, morning(), 960, 540), splats), 1);
}

TEST(Camera, GroundAndHorizonLookAtTheClouds) {
  for (const auto& splats : {scattered(0, 3000, -3000, 0), scattered(0, 30000, -20000, 0)}) {
    const Camera ground = cameraFor("ground", splats, morning(), 960, 540);
    EXPECT_NEAR(ground.eye.y, 320, 1);
    EXPECT_GT(shareSeen(ground, splats), 0.1);
    const Camera horizon = cameraFor("horizon", splats, morning(), 960, 540);
    EXPECT_GT(horizon.eye.y, 2400);
    EXPECT_GT(shareSeen(horizon, splats), 0.4);
  }
}

TEST(Camera, AClearSkyHasViewsToo) {
  for (const char* view : {"top", "ground", "horizon"}) {
    const Camera camera = cameraFor(view, {}, morning(), 64, 36);
    EXPECT_GT(glm::distance(camera.eye, camera.target), 1);
    for (const glm::vec3& pixel : render({}, camera, morning(), {}, {}).pixels)
      ASSERT_TRUE(std::isfinite(pixel.x));
  }
}

TEST(Camera, AnUnknownViewIsRefused) {
  EXPECT_THROW(cameraFor("sideways", {}, morning(), 64, 36), base::UsageError);
  EXPECT_THROW(cameraFor("", {}, morning(), 64, 36), base::UsageError);
}

}  // namespace
}  // namespace cloudgen::image
