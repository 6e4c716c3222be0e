// SPDX-License-Identifier: Apache-2.0
#include "runtime/facing.hpp"

#include <algorithm>

namespace cloudgen::runtime {

Vec3 FacingLock::facingOf(const DrawPuff& puff, const Vec3& otherwise) const noexcept {
  for (std::size_t i = 0; i < countBefore_; ++i)
    if (before_[i].puff.instance == puff.instance && before_[i].puff.puff == puff.puff) return before_[i].facing;
  return otherwise;
}

void FacingLock::update(const PackView& pack, const CloudSet& clouds, const Selection& selection,
                        const Vec3& eye) noexcept {
  std::swap(now_, before_);
  countBefore_ = count_;
  count_ = 0;
  for (const std::uint32_t instance : selection.around()) {
    const pack::Instance& cloud = clouds.instances[instance];
    const ArchetypeInfo& archetype = pack.archetypes()[cloud.archetype()];
    const std::uint32_t level = std::min(selection.levelOf(instance), archetype.levels - 1);
    const Turn turn = turnOf(cloud.yaw_step());
    for (std::uint32_t p = archetype.first[level]; p < archetype.first[level] + archetype.count[level]; ++p) {
      const pack::Puff& puff = pack.puffs()[p];
      const float radius = kReach * cloud.scale() *
                           std::max({floatOf(puff.sigma_x()), floatOf(puff.sigma_y()), floatOf(puff.sigma_z())});
      const Vec3 away = eye - placed(cloud, turn, pack.centers()[p]);
      if (!(dot(away, away) < 0.25f * radius * radius) || count_ == kMostLocked) continue;
      // In the very middle there is no direction: any will do.
      const Vec3 facing = dot(away, away) > 1e-12f ? normalized(away) : Vec3{0, 0, 1};
      now_[count_++] = {{instance, p}, facingOf({instance, p}, facing)};
    }
  }
}

}  // namespace cloudgen::runtime
