// SPDX-License-Identifier: Apache-2.0
#include "light/sky.hpp"

#include <libnova/precession.h>
#include <libnova/solar.h>
#include <libnova/transform.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <numbers>

namespace cloudgen::light {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Relative air mass, Kasten & Young 1989.
double airMass(double elevationDegrees) {
  const double elevation = std::max(elevationDegrees, 0.0);
  return 1.0 / (std::sin(radians(elevation)) + 0.50572 * std::pow(elevation + 6.07995, -1.6364));
}

}  // namespace

Sun sunFrom(double azimuthDegrees, double elevationDegrees) {
  Sun sun{azimuthDegrees, elevationDegrees};
  const double azimuth = radians(azimuthDegrees), elevation = radians(elevationDegrees);
  sun.direction = glm::vec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                            -std::cos(azimuth) * std::cos(elevation));
  // Rayleigh optical depths of one air mass at 680, 550 and 440 nm (0.042, 0.098, 0.240; Bodhaine et al.
  // 1999) plus a clear-air aerosol of 0.05, 0.06, 0.08; white at one air mass, so that noon is neutral.
  const double path = airMass(elevationDegrees) - 1.0;
  sun.color = glm::vec3(std::exp(-0.092 * path), std::exp(-0.158 * path), std::exp(-0.320 * path));
  sun.color = glm::max(sun.color, glm::vec3(0.02f, 0.012f, 0.006f));
  return sun;
}

Sun sunAt(base::UtcTime time, double longitudeDegrees, double latitudeDegrees) {
  ln_lnlat_posn observer{longitudeDegrees, latitudeDegrees};
  ln_equ_posn atJ2000{}, equatorial{};
  ln_hrz_posn horizontal{};
  const double day = base::julianDay(time);
  // libnova's sun is of the equinox J2000; the sky turns about today's pole (50 arc seconds a year).
  ln_get_solar_equ_coords(day, &atJ2000);
  ln_get_equ_prec(&atJ2000, day, &equatorial);
  ln_get_hrz_from_equ(&equatorial, &observer, day, &horizontal);
  // libnova counts azimuth from the south, westwards.
  return sunFrom(std::fmod(horizontal.az + 180.0, 360.0), horizontal.alt);
}

Sky skyUnder(const Sun& sun) {
  const float low = static_cast<float>(std::clamp(1.0 - sun.elevationDegrees / 25.0, 0.0, 1.0));
  const float day = static_cast<float>(std::clamp((sun.elevationDegrees + 6.0) / 16.0, 0.03, 1.0));
  Sky sky;
  sky.zenith = day * glm::mix(glm::vec3(0.10f, 0.26f, 0.62f), glm::vec3(0.11f, 0.19f, 0.42f), low);
  sky.horizon = day * glm::mix(glm::vec3(0.55f, 0.70f, 0.86f), glm::vec3(0.86f, 0.55f, 0.36f), low * low);
  sky.ground = day * glm::mix(glm::vec3(0.13f, 0.17f, 0.09f), glm::vec3(0.09f, 0.09f, 0.06f), low);
  sky.ambient = day * glm::mix(glm::vec3(0.36f, 0.43f, 0.53f), glm::vec3(0.26f, 0.27f, 0.35f), low);
  sky.bounce = sky.ground * glm::vec3(0.85f) *
                   static_cast<float>(std::max(0.15, std::sin(radians(sun.elevationDegrees)))) +
               0.12f * sky.ambient;
  return sky;
}

}  // namespace cloudgen::light
