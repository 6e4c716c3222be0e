// SPDX-License-Identifier: Apache-2.0
#include "light/sky.hpp"

#include <libnova/solar.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "light/atmosphere.hpp"
#include "light/horizontal.hpp"

namespace cloudgen::light {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Low clouds see the sun from above the thickest air, and a little beyond the horizon.
constexpr double kCloudMeters = 1000;

/// What is left at night, display-linear: a sky under a half moon, as an eye that has got used to it.
const glm::vec3 kNight(0.010f, 0.013f, 0.022f);

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Mean over azimuth of the clear sky at an elevation, the glare about the sun left out.
glm::vec3 skyRing(double elevationDegrees, double sunElevationDegrees) {
  glm::vec3 sum(0);
  for (const double azimuth : {60.0, 100.0, 140.0, 180.0})
    sum += skyRadiance(elevationDegrees, azimuth, sunElevationDegrees);
  return 0.25f * sum;
}

}  // namespace

glm::vec3 sunColorAt(double elevationDegrees, double heightMeters) {
  // White from the zenith, so that noon is neutral.
  static const glm::vec3 zenith = sunTransmittance(90, kCloudMeters);
  return glm::min(sunTransmittance(elevationDegrees, heightMeters) / zenith, glm::vec3(1));
}

Sun sunFrom(double azimuthDegrees, double elevationDegrees) {
  Sun sun{azimuthDegrees, elevationDegrees};
  const double azimuth = radians(azimuthDegrees), elevation = radians(elevationDegrees);
  sun.direction = glm::vec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                            -std::cos(azimuth) * std::cos(elevation));
  sun.color = sunColorAt(elevationDegrees, kCloudMeters);
  return sun;
}

Sun sunAt(base::UtcTime time, double longitudeDegrees, double latitudeDegrees) {
  ln_equ_posn sun{};
  const double day = base::julianDay(time);
  ln_get_solar_equ_coords(day, &sun);
  const Horizontal place = horizontalOf(sun.ra, sun.dec, day, longitudeDegrees, latitudeDegrees);
  return sunFrom(place.azimuthDegrees, place.elevationDegrees);
}

Sky skyUnder(const Sun& sun, float moonlight) {
  const double elevation = sun.elevationDegrees;
  const float low = static_cast<float>(std::clamp(1.0 - elevation / 25.0, 0.0, 1.0));
  // How bright the sky is shown: an eye gets used to dusk, down to the end of civil twilight.
  const float day = static_cast<float>(std::clamp((elevation + 8.0) / 18.0, 0.0, 1.0));
  // By day nobody sees how much moon there is.
  const float dark = static_cast<float>(std::clamp(-elevation / 8.0, 0.0, 1.0));
  const glm::vec3 night = glm::mix(1.0f, moonlight, dark) * kNight;
  const glm::vec3 high = skyRing(65, elevation), edge = skyRing(5, elevation);
  const float scale = 0.68f * day / std::max(luminance(edge), 1e-9f);
  // Light of higher orders: it whitens the long ways at the horizon, and blue once more the air above.
  const auto evened = [](const glm::vec3& color, float share) {
    return glm::mix(color, glm::vec3(luminance(color)), share);
  };
  const glm::vec3 blue = luminance(high) * glm::vec3(0.42f, 0.96f, 2.5f);
  const auto shown = [](const glm::vec3& color) { return glm::clamp(color, 0.0f, 1.0f); };
  Sky sky;
  sky.moonlight = moonlight;
  sky.zenith = shown(1.4f * scale * glm::mix(high, blue, 0.5f) + 0.5f * night);
  sky.horizon = shown(scale * evened(edge, 0.15f) + night);
  sky.ground =
      day * glm::mix(glm::vec3(0.13f, 0.17f, 0.09f), glm::vec3(0.09f, 0.09f, 0.06f), low) + 0.15f * night;
  // Under a low sun it is the blue from high above that fills the shades; the glow is narrow.
  sky.ambient = shown(evened(glm::mix(sky.horizon, sky.zenith, 0.55f + 0.3f * low), 0.35f - 0.2f * low)) +
                0.5f * night;
  sky.bounce =
      sky.ground * glm::vec3(0.85f) * static_cast<float>(std::max(0.15, std::sin(radians(elevation)))) +
      0.12f * sky.ambient;
  return sky;
}

}  // namespace cloudgen::light
