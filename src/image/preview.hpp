// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "base/height_field.hpp"
#include "base/progress.hpp"
#include "image/picture.hpp"
#include "image/splat.hpp"
#include "image/view.hpp"
#include "light/sky.hpp"

namespace cloudgen::image {

/// What lies about the clouds.
struct Surroundings {
  light::Sun sun;
  light::Sky sky;
  float groundHeightMeters = 0;
  base::HeightField terrain;  ///< its border lies at groundHeightMeters; may be empty
};

struct RenderOptions {
  bool detail = true;  ///< noise finer than the puffs; off, they are smooth
  /// Gets the picture while it is still coarse, in its full size; may be empty. Called once, and only where
  /// the picture is large enough to be worth it.
  std::function<void(const Picture&)> coarse;
};

/// Clouds over sky and ground as an eye sees them: extinction along rays (volume.hpp), haze that thins with
/// height, the clouds' shadow on the ground, the sun's disc, aureole and halo through what lies before it.
/// The same pixels for any number of threads.
Picture render(std::span<const Splat> splats, const Camera& camera, const Surroundings& surroundings,
               const RenderOptions& options, const base::Progress& progress);

/// Cameras that need no thought: straight down on everything, from the ground towards the clouds, and over
/// the cloud tops towards the horizon. `view` is "top", "ground" or "horizon".
Camera cameraFor(std::string_view view, std::span<const Splat> splats, const Surroundings& surroundings,
                 int width, int height);

}  // namespace cloudgen::image
