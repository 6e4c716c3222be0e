// SPDX-License-Identifier: Apache-2.0
#include "image/sun_glare.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/noise.hpp"

namespace cloudgen::image {
namespace {

constexpr double kDiscDegrees = 0.265;
// What the disc is brighter than a white face: pi over its solid angle.
constexpr double kDisc = 46000;

/// Forward share of the scattering and its width for one order, degrees.
struct Forward {
  double share, degrees;
};
constexpr Forward kWater{0.15, 0.9}, kIce{0.35, 0.4};
constexpr int kOrders = 24;

/// Radiance of the aureole, all orders.
double aureole(double degrees, double depth, const Forward& forward) {
  const double mean = forward.share * depth;
  double order = std::exp(-depth), sum = 0;
  for (int n = 1; n <= kOrders; ++n) {
    order *= mean / n;
    const double variance = n * forward.degrees * forward.degrees;
    sum += order * std::exp(-0.5 * degrees * degrees / variance) / variance;
  }
  // pi / (2 pi variance) with the variance in square degrees.
  return 0.5 * glm::degrees(1.0) * glm::degrees(1.0) * sum;
}

/// One colour of the halo: nothing inside its angle, a sharp rise, a slow fall.
double ring(double degrees, double least) {
  return base::smoothStep(least - 0.5, least + 0.35, degrees) *
         std::exp(-std::max(0.0, degrees - least) / 1.6);
}

}  // namespace

glm::vec3 glareAndHalo(double cosineFromSun, float water, float ice) {
  const double degrees = glm::degrees(std::acos(std::clamp(cosineFromSun, -1.0, 1.0)));
  if (degrees > 32) return glm::vec3(0);
  const double depth = static_cast<double>(water) + ice;
  double white =
      kDisc * std::exp(-depth) * (1 - base::smoothStep(kDiscDegrees - 0.03, kDiscDegrees + 0.03, degrees));
  // Glare of the eye or lens about what is left of the disc.
  white += std::exp(-depth) * (1.1 * std::exp(-degrees / 0.9) + 0.18 * std::exp(-degrees / 4.0));
  if (water > 0.01f) white += std::exp(-static_cast<double>(ice)) * aureole(degrees, water, kWater);
  if (ice > 0.01f) white += std::exp(-static_cast<double>(water)) * aureole(degrees, ice, kIce);
  glm::dvec3 color(white);
  if (ice > 0.005f && degrees > 20) {
    // One scattering in the veil, dimmed by the way through it; water hides it.
    const double strength = 0.55 * (1 - std::exp(-1.6 * ice)) * std::exp(-0.55 * ice - water);
    const glm::dvec3 least(21.6, 21.9, 22.3);
    for (int c = 0; c < 3; ++c) color[c] += strength * ring(degrees, least[c]);
  }
  return color;
}

}  // namespace cloudgen::image
