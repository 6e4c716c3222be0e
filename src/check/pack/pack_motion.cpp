// SPDX-License-Identifier: Apache-2.0
#include "check/pack/pack_motion.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <optional>

namespace cloudgen::check {
namespace {

struct Moved {
  glm::vec3 shift{0};
  float growth = 1, presence = 1;
};

/// Of every cloud; nothing where it is not there.
std::vector<std::optional<Moved>> movedBy(const pack::Keyframe& frame, std::size_t clouds) {
  const auto read = [&](std::uint32_t i) {
    const pack::Motion& motion = *frame.motions()->Get(i);
    return Moved{vec3(motion.shift()), motion.growth(), motion.presence()};
  };
  if (!frame.clouds()) {
    std::vector<std::optional<Moved>> all(clouds, Moved{});
    for (std::uint32_t i = 0; frame.motions() && i < frame.motions()->size(); ++i) all[i] = read(i);
    return all;
  }
  std::vector<std::optional<Moved>> some(clouds);
  for (std::uint32_t i = 0; i < frame.clouds()->size(); ++i) some[frame.clouds()->Get(i)] = read(i);
  return some;
}

}  // namespace

std::vector<pack::Instance> cloudsAt(const pack::RuntimePack& root, double seconds) {
  std::vector<pack::Instance> clouds;
  for (const pack::Instance* cloud : *root.instances()) clouds.push_back(*cloud);
  if (!root.keyframes() || root.keyframes()->size() == 0) return clouds;
  const auto& frames = *root.keyframes();
  std::uint32_t next = 0;
  while (next + 1 < frames.size() && frames.Get(next)->seconds() < seconds) ++next;
  const pack::Keyframe &to = *frames.Get(next), &from = *frames.Get(next > 0 ? next - 1 : 0);
  const double span = to.seconds() - from.seconds();
  const auto share = span > 0 ? static_cast<float>(std::clamp((seconds - from.seconds()) / span, 0.0, 1.0)) : 1.0f;
  const auto before = movedBy(from, clouds.size()), after = movedBy(to, clouds.size());
  std::vector<pack::Instance> there;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    if (!before[i] || !after[i]) continue;
    const Moved &a = *before[i], &b = *after[i];
    const float presence = glm::mix(a.presence, b.presence, share);
    if (!(presence > 0)) continue;
    const pack::Instance& cloud = clouds[i];
    const glm::vec3 place = vec3(cloud.position()) + glm::mix(a.shift, b.shift, share);
    there.emplace_back(pack::Vec3(place.x, place.y, place.z), cloud.archetype(), cloud.yaw_step(), cloud.sunlight(),
                       cloud.scale() * glm::mix(a.growth, b.growth, share), cloud.optical_depth_factor() * presence);
  }
  return there;
}

}  // namespace cloudgen::check
