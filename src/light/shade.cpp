// SPDX-License-Identifier: Apache-2.0
#include "light/shade.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cloudgen::light {

float scatteredShare(float opticalDepth) {
  float sum = 0, total = 0, weight = 1, thinning = 1;
  for (int octave = 0; octave < 8; ++octave) {
    sum += weight * std::exp(-thinning * opticalDepth);
    total += weight;
    weight *= 0.5f;
    thinning *= 0.5f;
  }
  return sum / total;
}

namespace {

constexpr float kSun = 0.84f, kSky = 0.40f, kSkin = 1.2f;

/// Standard deviation of a puff along a direction of the cloud.
float reachAlong(const shape::Puff& puff, const glm::vec3& direction) {
  return glm::length(puff.sigma * (glm::conjugate(puff.rotation) * direction));
}

/// As a photographer exposes: a cloud face square to the sun comes out just white, whatever the hour.
float exposureFor(const Lighting& lighting) {
  const glm::vec3 brightest = 1.05f * kSun * lighting.sunColor + kSky * lighting.sky.ambient;
  return 1.08f / glm::dot(brightest, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Highlights above 0.62 are rolled off towards 1, so that relief on the sunlit side stays visible.
glm::vec3 shoulder(glm::vec3 color) {
  constexpr float kKnee = 0.62f, kRoom = 1.0f - kKnee;
  for (int c = 0; c < 3; ++c)
    if (color[c] > kKnee) color[c] = kKnee + kRoom * (1.0f - std::exp(-(color[c] - kKnee) / kRoom));
  return color;
}

/// The light of one puff, and how much of it is seen from outside: mean transmittance along the six axes.
struct SeenLight {
  PuffLight light;
  float visibility = 0;
};

SeenLight shadeOne(const shape::Puff& puff, const ExtinctionGrid& grid, const Lighting& lighting,
                   float shading, float exposure) {
  // What is seen of a puff is its skin: its own body, out to a little over a deviation, does not shade it.
  const auto depthTowards = [&](const glm::vec3& direction) {
    return grid.opticalDepth(puff.center, direction,
                             std::max(kSkin * reachAlong(puff, direction), 0.5f * grid.cellMeters()));
  };
  const float toSun = depthTowards(lighting.sunDirection), up = depthTowards({0, 1, 0}),
              down = depthTowards({0, -1, 0});
  // Relief: how squarely the surface here faces the sun; inside the cloud, where the gradient is weak,
  // none.
  const glm::vec3 gradient = grid.gradient(puff.center);
  const float strength = glm::length(gradient), here = grid.extinction(puff.center);
  const float surface = strength / (strength + 0.8f * here + 1e-9f);
  const glm::vec3 normal = strength > 0 ? -gradient / strength : glm::vec3(0, 1, 0);
  const float facing = 0.5f + 0.5f * glm::dot(normal, lighting.sunDirection);
  const float relief = glm::mix(1.0f, 0.26f + 0.92f * facing, shading * std::min(1.0f, 1.6f * surface));
  const float open =
      glm::mix(1.0f, 0.72f + 0.38f * (0.5f + 0.5f * normal.y), shading * std::min(1.0f, 1.6f * surface));

  // Similarity (van de Hulst 1980): strongly forward scattering acts as isotropic scattering at (1 - g)
  // tau, g = 0.85.
  const float reduced = 0.15f;
  const float sun =
      glm::mix(scatteredShare(0.3f * reduced * toSun), scatteredShare(reduced * toSun), shading);
  const float sky = 0.20f + 0.80f * std::exp(-0.07f * shading * up);
  const float ground = std::exp(-0.10f * down);
  const glm::vec3 radiance = kSun * lighting.sunColor * (sun * relief) +
                             kSky * lighting.sky.ambient * (sky * open) + 0.6f * lighting.sky.bounce * ground;

  float visibility = std::exp(-up) + std::exp(-down);
  for (const glm::vec3& sideways :
       {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
    visibility += std::exp(-depthTowards(sideways));
  return {{shoulder(exposure * radiance), 0.24f * std::exp(-0.6f * toSun)}, visibility / 6.0f};
}

/// Puffs that nobody sees take the mean tone of those that are seen: viewers that order puffs roughly would
/// else show the dark inside of a cloud through its bright skin.
void toneHidden(std::vector<SeenLight>& seen, std::span<const shape::Puff> puffs) {
  constexpr float kHidden = 2e-5f,
                  kSeen = 1e-3f;  // behind an optical depth of 9 and of 5 on the clearest side
  glm::vec3 sum(0);
  float weight = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    const float area = puffs[i].sigma.x * puffs[i].sigma.z * seen[i].visibility * seen[i].visibility;
    sum += area * seen[i].light.color;
    weight += area;
  }
  if (weight <= 0) return;
  for (SeenLight& one : seen) {
    const float share = glm::smoothstep(kHidden, kSeen, one.visibility);
    one.light.color = glm::mix(sum / weight, one.light.color, share);
    one.light.forward *= share;
  }
}

}  // namespace

std::vector<PuffLight> shadePuffs(std::span<const shape::Puff> puffs, const ExtinctionGrid& grid,
                                  const Lighting& lighting, float shading) {
  const float exposure = exposureFor(lighting);
  std::vector<SeenLight> seen;
  seen.reserve(puffs.size());
  for (const shape::Puff& puff : puffs) seen.push_back(shadeOne(puff, grid, lighting, shading, exposure));
  toneHidden(seen, puffs);
  std::vector<PuffLight> lights;
  lights.reserve(seen.size());
  for (const SeenLight& one : seen) lights.push_back(one.light);
  return lights;
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
