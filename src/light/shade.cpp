// SPDX-License-Identifier: Apache-2.0
#include "light/shade.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cloudgen::light {

namespace {

/// Irradiance of the sun and of the ground on a white surface, as radiances: sunlight of colour 1 and
/// Sky::bounce of 1.
constexpr float kSun = 0.92f, kGround = 0.75f;
/// And of an even sky, Sky::ambient of 1: a seventh of what the high sun gives. The sky is shown brighter
/// than that (an eye gets used to it), the more the lower the sun, whose light it then must not drown.
constexpr float kSkyAtNoon = 0.45f, kSkyWithoutSun = 0.16f;

/// What a thick cloud's bright faces answer. Those of thinner ones are shown brighter, as the sky behind them
/// is, but by no more than this; what comes out below is not.
constexpr float kFace = 0.8f, kBrighter = 2.1f;
/// Level tops take a slanting sun by the sine of its height; they reflect more of it then than of a high one,
/// and an eye that looks down on a deck gets used to the rest, down to this sine.
constexpr float kLift = 0.9f, kLowest = 0.3f;
/// Undersides of thick clouds beside faces that a camera is set for.
constexpr float kBelow = 0.6f;

/// Three stops more than at noon.
constexpr float kMostExposure = 9.0f;

constexpr float kMostForward = 0.95f;

/// Puffs behind an optical depth of 9 on the clearest side are hidden, before one of 5 seen.
constexpr float kHidden = 2e-5f, kSeen = 1e-3f;

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// A photograph's contrast: darks go darker about the tone of a bright face, and highlights above 0.8 are
/// rolled off towards 1, so that relief on the sunlit side stays visible.
glm::vec3 developed(glm::vec3 color, float face) {
  constexpr float kContrast = 1.8f, kKnee = 0.8f, kRoom = 1.08f - kKnee;
  color *= std::pow(luminance(color) / face, kContrast - 1.0f);
  const float most = std::max({color.r, color.g, color.b});
  // All channels alike, so that the evening keeps its colour.
  if (most > kKnee) color *= (kKnee + kRoom * (1.0f - std::exp(-(most - kKnee) / kRoom))) / most;
  return color;
}

}  // namespace

std::vector<PuffLight> shadePuffs(std::span<const shape::Puff> puffs, const CloudTransfer& cloud,
                                  const Lighting& lighting, float shading) {
  // As a photographer exposes: a bright face comes out just white, whatever the hour and the cloud; but night
  // stays night.
  const float skyShare = glm::mix(kSkyWithoutSun, kSkyAtNoon, std::min(1.0f, luminance(lighting.sunColor)));
  const float face = luminance(kSun * lighting.sunColor + skyShare * lighting.sky.ambient) + 1e-6f;
  const float exposure = std::min(1.38f / face, kMostExposure);
  const float lift = std::pow(std::max(lighting.sunDirection.y, kLowest), -kLift);
  const float thick = std::max(0.0f, 1 - cloud.once.towards);
  const float bright = std::max(cloud.bright, kFace / kBrighter);
  const Harmonics harmonics = harmonicsOf(lighting.sunDirection);

  std::vector<PuffLight> lights;
  glm::vec3 tone(0);
  float areas = 0;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    const PuffTransfer& transfer = cloud.puffs[i];
    const float below = thick * glm::smoothstep(0.0f, 0.7f, -transfer.upward);
    const float sun =
        std::clamp(dot(transfer.sun, harmonics) / glm::mix(bright, kFace / kBelow, below), 0.0f, 1.15f);
    const float level = thick * glm::smoothstep(0.75f, 1.0f, transfer.upward);
    const float lit = glm::mix(1.0f, lift, level) * glm::mix(glm::mix(0.9f, 0.4f, below), sun, shading);
    const glm::vec3 radiance = kSun * lighting.sunColor * cloud.once.even * lit +
                               skyShare * lighting.sky.ambient * glm::mix(1.0f, transfer.sky, shading) +
                               kGround * lighting.sky.bounce * glm::mix(0.5f, transfer.ground, shading);
    const float forward = std::min(0.24f * std::clamp(dot(transfer.through, harmonics), 0.0f, 1.0f) +
                                       exposure * kSun * cloud.once.towards * lit,
                                   kMostForward);
    lights.push_back({developed(exposure * radiance, exposure * face / 1.38f), forward});
    const float area = seenArea(puffs[i], transfer);
    tone += area * lights.back().color;
    areas += area;
  }
  // Puffs that nobody sees take the mean tone of those that are seen: viewers that order puffs roughly would
  // else show the dark inside of a cloud through its bright skin.
  if (areas > 0)
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const float share = glm::smoothstep(kHidden, kSeen, cloud.puffs[i].visibility);
      lights[i].color = glm::mix(tone / areas, lights[i].color, share);
      lights[i].forward *= share;
    }
  return lights;
}

glm::vec3 dimming(float sunlight, const glm::vec3& sunColor, const Sky& sky) {
  // Mean answers of what is seen of a cloud to the three.
  const float skyShare = glm::mix(kSkyWithoutSun, kSkyAtNoon, std::min(1.0f, luminance(sunColor)));
  constexpr float kMeanSun = 0.75f, kMeanSky = 0.8f, kMeanGround = 0.3f;
  const glm::vec3 other = kMeanSky * skyShare * sky.ambient + kMeanGround * kGround * sky.bounce;
  const glm::vec3 whole = kMeanSun * kSun * sunColor + other;
  return (sunlight * kMeanSun * kSun * sunColor + other) / glm::max(whole, glm::vec3(1e-6f));
}

PuffLight inShadow(const PuffLight& light, float sunlight, const glm::vec3& sunColor, const Sky& sky) {
  return {light.color * dimming(sunlight, sunColor, sky), light.forward * sunlight};
}

std::vector<PuffLight> averageLight(std::span<const shape::Puff> puffs, std::span<const PuffLight> lights,
                                    std::span<const shape::Puff> merged) {
  std::vector<PuffLight> out;
  for (const shape::Puff& into : merged) {
    glm::vec3 color(0);
    float forward = 0, weight = 0;
    for (size_t i = 0; i < puffs.size(); ++i) {
      const glm::vec3 away = (puffs[i].center - into.center) / into.sigma;
      const float near =
          puffs[i].sigma.x * puffs[i].sigma.z * std::exp(-0.5f * std::min(glm::dot(away, away), 60.0f));
      color += near * lights[i].color;
      forward += near * lights[i].forward;
      weight += near;
    }
    out.push_back(weight > 0 ? PuffLight{color / weight, forward / weight} : PuffLight{});
  }
  return out;
}

}  // namespace cloudgen::light
