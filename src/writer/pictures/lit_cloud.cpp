// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/lit_cloud.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numeric>

namespace cloudgen::writer {

LitCloud::LitCloud(const scene::Scene& scene, std::uint32_t lit, float opticalDepthFactor)
    : puffs_(scene.archetypes[scene.lit[lit].archetype].puffs) {
  const scene::LitArchetype& lights = scene.lit[lit];
  const glm::quat turn = glm::angleAxis(scene::yawRadians(lights.yawStep), glm::vec3(0, 1, 0));
  for (std::size_t i = 0; i < puffs_.size(); ++i) {
    shape::Puff& puff = puffs_[i];
    puff.center = turn * puff.center;
    puff.rotation = turn * puff.rotation;
    puff.extinctionPerMeter *= opticalDepthFactor;
    lights_.push_back(light::encoded(lights.puffs[i], scene.sun.color));
  }
  box_ = shape::boundsOf(puffs_, 2);
  sun_ = scene.sun;
}

float LitCloud::width() const { return std::max(size().x, size().z); }

float LitCloud::meanOpticalDepth() const {
  double sum = 0;
  for (const shape::Puff& puff : puffs_) sum += shape::extinctionArea(puff);
  return static_cast<float>(sum / std::max(static_cast<double>(size().x * size().z), 1e-9));
}

Part LitCloud::whole() const {
  Part all(puffs_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<Part> LitCloud::layers(int axis, int count) const {
  Part order = whole();
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return puffs_[i].center[axis]; });
  double sum = 0;
  for (const shape::Puff& puff : puffs_) sum += shape::extinctionArea(puff);
  std::vector<Part> parts(static_cast<std::size_t>(count));
  double below = 0;
  for (const std::size_t i : order) {
    const double middle = below + 0.5 * shape::extinctionArea(puffs_[i]);
    parts[std::min(parts.size() - 1, static_cast<std::size_t>(count * middle / std::max(sum, 1e-9)))]
        .push_back(i);
    below += shape::extinctionArea(puffs_[i]);
  }
  std::erase_if(parts, [](const Part& part) { return part.empty(); });
  return parts;
}

CloudPicture LitCloud::seen(const Part& part, const Sight& sight, const Fineness& fineness,
                            float share) const {
  return seenAt(meanCosine(sight, sun_), part, sight, fineness, share);
}

CloudPicture LitCloud::seenAt(float cosine, const Part& part, const Sight& sight, const Fineness& fineness,
                              float share) const {
  std::vector<ColoredPuff> colored;
  for (const std::size_t i : part) {
    colored.push_back({puffs_[i], lights_[i].seenAt(cosine)});
    colored.back().puff.extinctionPerMeter *= share;
  }
  return {paintedPuffs(colored, sight, fineness.pixelsPerMeter, fineness.reliefCells), sight};
}

float meanCosine(const Sight& sight, const light::Sun& sun) {
  return -0.5f * glm::dot(sight.towards, sun.direction);
}

}  // namespace cloudgen::writer
