// SPDX-License-Identifier: Apache-2.0
#include "light/shade.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "light/tone_curve.hpp"

namespace cloudgen::light {

namespace {

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// As kSkyAtNoon says.
float skyShareUnder(const glm::vec3& sunColor) {
  return glm::mix(kSkyWithoutSun, kSkyAtNoon, std::min(1.0f, luminance(sunColor)));
}

/// As kContrast says.
glm::vec3 developed(glm::vec3 color, float face) {
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
  const float skyShare = skyShareUnder(lighting.sunColor);
  const float face = luminance(kSun * lighting.sunColor + skyShare * lighting.sky.ambient) + 1e-6f;
  const float exposure = std::min(kWhite / face, kMostExposure);
  const float lift = std::pow(std::max(lighting.sunDirection.y, kLowest), -kLift);
  const float bright = std::max(cloud.bright, kFace / kBrighter);
  const Harmonics harmonics = harmonicsOf(lighting.sunDirection);

  std::vector<PuffLight> lights;
  glm::vec3 tone(0);
  float areas = 0;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    const PuffTransfer& transfer = cloud.puffs[i];
    const float below = undersideOf(cloud, transfer);
    const float sun =
        std::clamp(dot(transfer.sun, harmonics) / glm::mix(bright, kFace / kBelow, below), 0.0f, kMostSun);
    const float level = levelOf(cloud, transfer);
    const float lit =
        glm::mix(1.0f, lift, level) * glm::mix(glm::mix(kFlatSun, kFlatBelow, below), sun, shading);
    const glm::vec3 radiance =
        kSun * lighting.sunColor * cloud.once.even * lit +
        skyShare * lighting.sky.ambient * glm::mix(kFlatSky, transfer.sky, shading) +
        kGround * lighting.sky.bounce * glm::mix(kFlatGround, transfer.ground, shading);
    const float forward = std::min(kForward * std::clamp(dot(transfer.through, harmonics), 0.0f, 1.0f) +
                                       exposure * kSun * cloud.once.towards * lit,
                                   kMostForward);
    lights.push_back({developed(exposure * radiance, exposure * face / kWhite), forward});
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
  const glm::vec3 other =
      kMeanSky * skyShareUnder(sunColor) * sky.ambient + kMeanGround * kGround * sky.bounce;
  const glm::vec3 whole = kMeanSun * kSun * sunColor + other;
  return (sunlight * kMeanSun * kSun * sunColor + other) / glm::max(whole, glm::vec3(1e-6f));
}

PuffLight inShadow(const PuffLight& light, float sunlight, const glm::vec3& sunColor, const Sky& sky) {
  return {light.color * dimming(sunlight, sunColor, sky), light.forward * sunlight};
}

float weightWithin(const shape::Puff& puff, const shape::Puff& merged) {
  const glm::vec3 away = (puff.center - merged.center) / merged.sigma;
  return puff.sigma.x * puff.sigma.z * std::exp(-0.5f * std::min(glm::dot(away, away), 60.0f));
}

std::vector<PuffLight> averageLight(std::span<const shape::Puff> puffs, std::span<const PuffLight> lights,
                                    std::span<const shape::Puff> merged) {
  std::vector<PuffLight> out;
  for (const shape::Puff& into : merged) {
    glm::vec3 color(0);
    float forward = 0, weight = 0;
    for (size_t i = 0; i < puffs.size(); ++i) {
      const float near = weightWithin(puffs[i], into);
      color += near * lights[i].color;
      forward += near * lights[i].forward;
      weight += near;
    }
    out.push_back(weight > 0 ? PuffLight{color / weight, forward / weight} : PuffLight{});
  }
  return out;
}

}  // namespace cloudgen::light
