// SPDX-License-Identifier: Apache-2.0
#include "runtime/timeline.hpp"

#include <algorithm>

namespace cloudgen::runtime {
namespace {

struct Motion {
  Vec3 shift;
  float growth = 1, presence = 1;
};

/// Reads the motions of a keyframe, cloud after cloud.
class Motions {
 public:
  explicit Motions(const pack::Keyframe& frame)
      : motions_(frame.motions() && frame.motions()->size() > 0 ? frame.motions() : nullptr), clouds_(frame.clouds()) {}

  /// That of a cloud after those that were asked for before; false where it is not there.
  bool of(std::uint32_t cloud, Motion& motion) noexcept {
    motion = {};
    std::uint32_t at = cloud;
    if (clouds_) {
      while (next_ < clouds_->size() && clouds_->Get(next_) < cloud) ++next_;
      if (next_ == clouds_->size() || clouds_->Get(next_) != cloud) return false;
      at = next_;
    }
    if (!motions_) return true;
    const pack::Motion& read = *motions_->Get(at);
    motion = {vec3(read.shift()), read.growth(), read.presence()};
    return true;
  }

 private:
  const flatbuffers::Vector<const pack::Motion*>* motions_;
  const flatbuffers::Vector<std::uint32_t>* clouds_;
  std::uint32_t next_ = 0;
};

}  // namespace

Timeline::Timeline(const PackView& pack) : pack_(&pack) {
  const auto* frames = pack.root().keyframes();
  if (!frames || frames->size() == 0) return;
  first_ = frames->Get(0)->seconds();
  last_ = frames->Get(frames->size() - 1)->seconds();
  moved_.assign(pack.instances().begin(), pack.instances().end());
  for (const pack::Keyframe* frame : *frames) {
    Motions motions(*frame);
    for (std::uint32_t i = 0; i < moved_.size(); ++i) {
      Motion motion;
      if (!motions.of(i, motion)) continue;
      const pack::Instance& cloud = pack.instances()[i];
      const ArchetypeInfo& info = pack.archetypes()[cloud.archetype()];
      const float grown = std::max(motion.growth - 1, 0.0f) * cloud.scale() * (info.radiusMeters + std::abs(info.middle.y));
      slack_ = std::max(slack_, length(motion.shift) + grown);
    }
  }
  setTime(0);
}

void Timeline::setTime(double seconds) noexcept {
  if (!moves()) return;
  const auto& frames = *pack_->root().keyframes();
  const double time = std::clamp(seconds, first_, last_);
  std::uint32_t after = 0;
  while (after + 1 < frames.size() && frames.Get(after)->seconds() < time) ++after;
  const pack::Keyframe &to = *frames.Get(after), &from = *frames.Get(after > 0 ? after - 1 : 0);
  const double span = to.seconds() - from.seconds();
  const float share = span > 0 ? static_cast<float>((time - from.seconds()) / span) : 1.0f;
  Motions before(from), then(to);
  for (std::uint32_t i = 0; i < moved_.size(); ++i) {
    Motion a, b;
    const bool wasThere = before.of(i, a), isThere = then.of(i, b);
    if (!wasThere || !isThere) a.presence = b.presence = 0;
    const pack::Instance& cloud = pack_->instances()[i];
    const Vec3 at = vec3(cloud.position()) + mix(a.shift, b.shift, share);
    const float growth = a.growth + share * (b.growth - a.growth), presence = a.presence + share * (b.presence - a.presence);
    moved_[i] = pack::Instance({at.x, at.y, at.z}, cloud.archetype(), cloud.yaw_step(), cloud.sunlight(),
                               cloud.scale() * growth, cloud.optical_depth_factor() * presence);
  }
}

}  // namespace cloudgen::runtime
