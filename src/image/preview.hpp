// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "base/height_field.hpp"
#include "base/progress.hpp"
#include "image/picture.hpp"
#include "light/sky.hpp"

namespace cloudgen::image {

/// A puff as a Gaussian splat, as viewers draw it: opacity * exp(-r^2 / 2), no further than 3 deviations.
struct Splat {
  glm::vec3 center{0}, sigma{1};
  glm::quat rotation{1, 0, 0, 0};
  float opacity = 1;
  glm::vec3 color{1};       ///< display-encoded (sRGB)
  glm::vec3 towardsSun{0};  ///< added when one looks straight towards the sun, subtracted when away from it
};

struct Camera {
  glm::dvec3 eye{0}, target{0, 0, -1};
  double verticalFieldDegrees = 45;
  int width = 960, height = 540;
};

/// What lies about the clouds.
struct Surroundings {
  light::Sun sun;
  light::Sky sky;
  float groundHeightMeters = 0;
  base::HeightField terrain;  ///< its border lies at groundHeightMeters; may be empty
};

/// Draws splats over sky and ground, nearest first, with haze that thins with height and the clouds' shadow
/// on the ground. The same pixels for any number of threads.
Picture render(std::span<const Splat> splats, const Camera& camera, const Surroundings& surroundings,
               const base::Progress& progress);

/// Cameras that need no thought: straight down on everything, from the ground towards the clouds, and over
/// the cloud tops towards the horizon. `view` is "top", "ground" or "horizon".
Camera cameraFor(std::string_view view, std::span<const Splat> splats, const Surroundings& surroundings,
                 int width, int height);

}  // namespace cloudgen::image
